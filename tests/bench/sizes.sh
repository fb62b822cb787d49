#!/bin/sh
# What each compile-time switch leaves out, in KB: code and constant data of the implementation alone, -Os, for the host
# and, where arm-none-eabi-gcc is installed, for a Cortex-M4 and a Cortex-M7. Run from the repository root.
set -u
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
printf '#define NEURALSVCD_IMPLEMENTATION\n#include "%s/neuralsvcd.h"\n' "$(pwd)" >"$dir/one.c"
measure() {  # compiler and flags -> KB of code and constants, or -
  if "$@" -std=c99 -Os -ffunction-sections -c "$dir/one.c" -o "$dir/one.o" 2>"$dir/err"; then
    size -A "$dir/one.o" | awk '/^\.text/ { code += $2 } /^\.rodata/ { data += $2 } END { printf "%.0f + %.0f", code / 1024, data / 1024 }'
  else
    printf -- '-'
  fi
}
echo '| without | host | Cortex-M4 | Cortex-M7 |'
echo '|---|---|---|---|'
row() {  # title, flags
  title=$1
  shift
  printf '| %s | %s |' "$title" "$(measure "${CC:-cc}" "$@")"
  for core in cortex-m4:fpv4-sp-d16 cortex-m7:fpv5-sp-d16; do
    flags="-mthumb -mcpu=${core%:*} -mfpu=${core#*:} -mfloat-abi=hard"
    if command -v arm-none-eabi-gcc >/dev/null; then
      printf ' %s |' "$(measure arm-none-eabi-gcc $flags "$@")"
    else
      printf ' - |'
    fi
  done
  echo
}
row 'nothing: all there is'
row 'the network (`NSVCD_NO_NETWORK`)' -DNSVCD_NO_NETWORK
row '... and the encoder: proofs of bodies made elsewhere (`NSVCD_NO_ENCODER`)' -DNSVCD_NO_NETWORK -DNSVCD_NO_ENCODER
row 'the proof (`NSVCD_NO_PROOF`)' -DNSVCD_NO_PROOF
row 'the OBJ reader (`NSVCD_NO_READERS`)' -DNSVCD_NO_READERS
row 'encoder and OBJ reader (`NSVCD_NO_ENCODER`)' -DNSVCD_NO_ENCODER
row '... and float arithmetic in the decoders (`NSVCD_NO_FLOAT`)' -DNSVCD_NO_ENCODER -DNSVCD_NO_FLOAT
row '... and the base decoder (`NSVCD_NO_BASE`)' -DNSVCD_NO_ENCODER -DNSVCD_NO_FLOAT -DNSVCD_NO_BASE
row '... and the small one (`NSVCD_NO_SMALL`)' -DNSVCD_NO_ENCODER -DNSVCD_NO_FLOAT -DNSVCD_NO_BASE -DNSVCD_NO_SMALL
row 'int8 arithmetic (`NSVCD_NO_INT8`)' -DNSVCD_NO_INT8
row 'the base decoder (`NSVCD_NO_BASE`)' -DNSVCD_NO_BASE
row 'the trajectory optimizer (`NSVCD_NO_OPTIMIZER`)' -DNSVCD_NO_OPTIMIZER
row 'the gradient, and with it the optimizer (`NSVCD_NO_GRADIENT`)' -DNSVCD_NO_GRADIENT
