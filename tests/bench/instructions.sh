#!/bin/sh
# Instructions of a query, counted by callgrind: a number that does not depend on the machine's mood. For AVX2 and FMA,
# because valgrind knows no AVX-512, and for plain C. On the first 100 problems of a file; the difference between asking
# each once more and not.
#   tests/bench/instructions.sh FILE [N...]
set -eu
problems=$1
shift
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
count=100
awk -v most=$count '/^problem / { if (++seen > most) exit } { print }' "$problems" >"$dir/problems.txt"
ln -s "$(cd "$(dirname "$problems")" && pwd)"/*meshes "$dir/"
collected() {  # program, N, repetitions
  valgrind --tool=callgrind --callgrind-out-file="$dir/out" \
    "$1" check --points "$2" --repeat "$3" "$dir/problems.txt" 2>&1 >/dev/null | sed -n 's/.*Collected : \([0-9]*\).*/\1/p'
}
for flags in "-mavx2 -mfma -mpopcnt -mbmi2" "-DNSVCD_NO_SIMD"; do
  ${CC:-cc} -O3 $flags -std=c99 -Wall -Wextra -o "$dir/svcd" examples/svcd.c -lm
  for points in "${@:-512}"; do
    once=$(collected "$dir/svcd" "$points" 1)
    twice=$(collected "$dir/svcd" "$points" 2)
    echo "N = $points, $flags: $(((twice - once) / count)) instructions a query, mean of $count"
  done
done
