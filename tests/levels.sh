#!/bin/sh
# The levels of vectors that the compiler and this machine have, of AVX-512, AVX2, SSE2, NEON and plain C. On each, 16 lanes
# are 16 floats (test_vectors.c), and `svcd check` answers problems as in plain C: those of tests/data, 200 of bodies at rest
# and 100 of a body on itself; on NEON, which is slow where it is emulated, the last. By proof verdicts and statuses are the
# same. By the network, where rounding may choose other pairs of patches, a verdict may be another one where a logit is
# within 1 of 0, and of a file one in 100. Measured on 8,000: 3 are, at logits up to 0.52.
# svcd is compiled as users do, in GNU C: there gcc joins products and sums where the processor can.
# Needs build/problems; run from the repository root. Ends with 1 if anything is not as it should be.
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
levels=
others=0
fail() {
  echo "levels: $*" >&2
  exit 1
}
# supports FEATURE...: can this machine do it? By what the compiler knows.
supports() {
  for feature in "$@"; do
    echo "int main(void) { return !__builtin_cpu_supports(\"$feature\"); }" >"$dir/can.c"
    "${CC:-cc}" -o "$dir/can" "$dir/can.c" 2>/dev/null && "$dir/can" || return 1
  done
}
# level NAME LANES FILES RUN COMPILER FLAG...
level() {
  name=$1 lanes=$2 files=$3 run=$4 cc=$5
  shift 5
  "$cc" -O1 "$@" -std=c99 -Wall -Wextra -Werror -Wno-unused-function -DTEST_ALONE -I. -o "$dir/vectors" tests/test_vectors.c -lm
  $run "$dir/vectors" >"$dir/out" || { cat "$dir/out"; fail "$name: lanes are not floats"; }
  grep -q "^  $lanes lanes at a time" "$dir/out" || fail "$name: not $lanes lanes at a time"
  "$cc" -O1 "$@" -o "$dir/svcd" examples/svcd.c -lm
  for file in $files; do
    ask proof --method proof
    ask network --method network
    ask int8 --method network --int8
  done
  levels="$levels $name"
}
# ask HOW OPTION...: the answers to a file, against those of plain C.
ask() {
  how=$1 out=$dir/$(basename "$file").$1
  shift
  $run "$dir/svcd" check "$@" --repeat 1 "$file" 2>"$dir/err" | cut -f2,3,7 >"$out.$name"
  test "$(wc -l <"$out.$name")" = "$(grep -c '^problem' "$file")" || fail "$name: $(tail -1 "$dir/err")"
  other=$(paste "$out.plain" "$out.$name" | awk -F'\t' -v how="$how" '
    { sub(/limit/, "ok", $3); sub(/limit/, "ok", $6); near = $1 ^ 2 < 1 && $4 ^ 2 < 1 }
    $3 != $6 || ($2 != $5 && (how == "proof" || !near)) { print NR ": " $0 >"/dev/stderr"; bad = 1 }
    $2 != $5 { other++ }
    END { print other + 0; exit bad || other > NR / 100 }') || fail "$name, $file, $how: not as in plain C"
  others=$((others + other))
}
make_set() {  # SET COUNT
  build/problems --set "$1" --meshes procedural --count "$2" --pool 4 --seed 907 --out "$dir/$1.txt" >/dev/null 2>&1 ||
    fail "no problems of $1"
}
make_set rest 200
make_set same 100
all="tests/data/problems.txt $dir/rest.txt $dir/same.txt"
level plain 1 "$all" '' "${CC:-cc}" -DNSVCD_NO_SIMD
case $(uname -m) in
  x86_64)
    level sse2 4 "$all" '' "${CC:-cc}" -DNSVCD_NO_DISPATCH
    level chosen 4 "$all" '' "${CC:-cc}"  # by the processor, at each call
    if supports avx2 fma; then level avx2 8 "$all" '' "${CC:-cc}" -mavx2 -mfma
    else echo "levels: no AVX2: not tested"; fi
    if supports avx512f avx512vnni; then level avx512 16 "$all" '' "${CC:-cc}" -mavx512f -mavx512vnni
    elif supports avx512f; then level avx512 16 "$all" '' "${CC:-cc}" -mavx512f
    else echo "levels: no AVX-512: not tested"; fi ;;
  aarch64) level neon 4 "$all" '' "${CC:-cc}" ;;
esac
if test "$(uname -m)" != aarch64; then  # Debian: gcc-aarch64-linux-gnu, libc6-dev-arm64-cross, qemu-user
  if command -v aarch64-linux-gnu-gcc >/dev/null && command -v qemu-aarch64 >/dev/null; then
    level neon 4 "$dir/same.txt" qemu-aarch64 aarch64-linux-gnu-gcc -static
  else echo "levels: no aarch64-linux-gnu-gcc, or no qemu-aarch64: NEON not tested"; fi
fi
echo "levels:$levels: the same by proof; by the network $others other verdicts, at logits within 1 of 0"
