#!/bin/sh
# What compiler flags cost: the medians of a query on problem files, by proof and by the network, and of the game's frame.
# All builds are asked in turn, ROUNDS times; a figure is the median of these. Ratios are to -O3 -march=native.
#   tests/bench/flags.sh FILE...     ALL=1: more builds, and queries alone; ROUNDS=5
set -eu
CC=${CC:-cc}
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cat >"$dir/builds" <<'LIST'
best|-O3 -march=native
default|-O2
LIST
test -z "${ALL:-}" || cat >>"$dir/builds" <<'LIST'
O0|-O0
O1|-O1
O3|-O3
Os|-Os
native_O0|-O0 -march=native
native_O2|-O2 -march=native
avx2_O2|-O2 -march=x86-64-v3
avx2_O3|-O3 -march=x86-64-v3
sse2_O0|-O0 -DNSVCD_NO_DISPATCH
sse2_O2|-O2 -DNSVCD_NO_DISPATCH
sse2_O3|-O3 -DNSVCD_NO_DISPATCH
plain_O2|-O2 -DNSVCD_NO_SIMD
plain_O3|-O3 -DNSVCD_NO_SIMD
LIST
while IFS='|' read -r name flags; do
  $CC -std=c99 $flags -o "$dir/svcd_$name" examples/svcd.c -lm &
  test -n "${ALL:-}" || $CC -std=c99 $flags -o "$dir/game_$name" examples/game.c -lm &
done <"$dir/builds"
wait

median() { sort -n | awk '{ x[NR] = $1 } END { print x[int((NR + 1) / 2)] }'; }
for round in $(seq "${ROUNDS:-5}"); do
  while IFS='|' read -r name _; do
    for method in proof network; do
      for file in "$@"; do
        "$dir/svcd_$name" check --method $method --repeat 3 "$file" 2>&1 >/dev/null |
          sed -n 's/^a query: median \([0-9.]*\), mean \([0-9.]*\),.*/\1 \2/p' >>"$dir/$name.$method.$(basename "$file" .txt)"
      done
    done
    test -n "${ALL:-}" || (cd "$dir" && mkdir -p build && "./game_$name" --frames 300 |
      sed -n 's/^a frame: median \([0-9.]*\), mean \([0-9.]*\),.*/\1 \2/p' >>"$dir/$name.game.frame")
  done <"$dir/builds"
done

echo "$($CC --version | head -1); medians, and means: queries in microseconds, the game's frame in milliseconds"
while IFS='|' read -r name flags; do
  for kept in "$dir/$name".*.*; do
    what=${kept#"$dir/$name".}
    best=$(cut -d' ' -f1 "$dir/best.$what" | median)
    mean_of_best=$(cut -d' ' -f2 "$dir/best.$what" | median)
    printf '%-26s %-20s' "$flags" "$what"
    echo "$(cut -d' ' -f1 "$kept" | median) $best $(cut -d' ' -f2 "$kept" | median) $mean_of_best" |
      awk '{ printf "%8.4g  %5.2f times   mean %8.4g  %5.2f times\n", $1, $1 / $2, $3, $3 / $4 }'
  done
done <"$dir/builds"
