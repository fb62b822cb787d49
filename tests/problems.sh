#!/bin/sh
# The generator of problems: every set comes out as FORMATS.md wants it and is what it says it is. The labels themselves
# are the oracle's (test_oracle.c). Needs build/problems and build/svcd; run from the repository root. Ends with 1 if
# anything is not as it should be.
set -u
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
failures=0
fail() {
  echo "problems: $*"
  failures=$((failures + 1))
}
make_set() {  # make_set SET FILE COUNT
  build/problems --set "$1" --meshes procedural --count "$3" --pool 8 --seed 7 --out "$dir/$2.txt" >/dev/null 2>&1 ||
    fail "$1: exit status $?"
}
# holds SET TEXT PROGRAM: an awk program over the file that ends with 0. Fields of a problem: 4 and 6 are the scales, 7
# to 9 the fixed position, 14 label, 15 margin, 16 count.
holds() {
  awk "$3" "$dir/$1.txt" || fail "$1: $2"
}

sets="standard hollow inside cavity thin spin still tiny huge offset mixed far"
for set in $sets; do
  make_set "$set" "$set" 8
  build/svcd check --repeat 1 "$dir/$set.txt" >"$dir/out" 2>"$dir/err" || fail "$set: svcd: $(tail -1 "$dir/err")"
  test "$(wc -l <"$dir/out")" = 8 || fail "$set: 8 problems, but these lines: $(cat "$dir/out")"
  test "$set" = far || test "$set" = inside ||
    holds "$set" 'label and margin disagree' '$1 == "problem" && ($14 == 1) != ($15 < 0) { bad = 1 } END { exit bad }'
done
make_set standard again 8
sed 's/again_meshes/standard_meshes/' "$dir/again.txt" | cmp -s - "$dir/standard.txt" || fail "the same seed, another file"

holds far 'not all free, or not far' '$1 == "problem" && ($14 != 0 || $15 < 0.1) { bad = 1 } END { exit bad }'
holds spin 'not 129 poses' '$1 == "problem" && $16 != 129 { bad = 1 } END { exit bad }'
holds still 'not a single pose and 33 in turn' '$1 == "problem" && $16 != ($2 % 2 ? 1 : 33) { bad = 1 } END { exit bad }'
holds offset 'not 10 km away' '$1 == "problem" { d = sqrt($7 * $7 + $8 * $8 + $9 * $9); if (d < 9990 || d > 10010) bad = 1 }
  END { exit bad }'
# Positions are floats: multiples of their last binary digit, to the nine decimal ones that are written. (A compiler may
# drop the rounding: round_position in problems.c.)
holds offset 'positions are not rounded to float' '
  function unlike(x) { x = x < 0 ? -x : x; u = x < 4096 ? 2 ^ -12 : x < 8192 ? 2 ^ -11 : 2 ^ -10
    return x > 2048 && (x / u - int(x / u + 0.5)) ^ 2 > (6e-6 / u) ^ 2 }
  $1 == "problem" && unlike($7) + unlike($8) + unlike($9) { bad = 1 }
  NF == 7 && unlike($1) + unlike($2) + unlike($3) { bad = 1 }
  END { exit bad }'
holds mixed 'not 5 cm against 20 m' '$1 == "problem" && ($4 > 0.21 || $6 < 49) { bad = 1 } END { exit bad }'  # meshes: 0.3 m

# tiny and huge are the scenes of standard: equal labels, scales and margins in proportion.
fields() { awk -v s="$2" '$1 == "problem" { printf "%s %s %s %.4f %.4f %.4f\n", $3, $5, $14, $4 / s, $6 / s, $15 / s }' "$dir/$1.txt"; }
fields standard 1 >"$dir/normal"
fields tiny 0.005 | cmp -s - "$dir/normal" || fail "tiny is not standard / 200"
fields huge 400 | cmp -s - "$dir/normal" || fail "huge is not standard times 400"

build/problems >/dev/null 2>"$dir/err"
test $? = 2 || fail "usage does not end with 2"
for set in $sets; do
  grep -q "^  $set " "$dir/err" || fail "usage does not name $set"
done
build/problems --set wide --meshes procedural --count 1 --out "$dir/x.txt" 2>/dev/null
test $? = 2 || fail "an unknown set is not refused"

test "$failures" = 0 || exit 1
echo "problems: all sets are as they should be"
