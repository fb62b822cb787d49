#!/bin/sh
# The generator of problems: every set comes out as examples/FORMATS.md wants it and is what it says it is. The labels
# themselves are the oracle's (tests/test_oracle.c). Needs build/problems, build/svcd and build/verify; run from the repository root.
# Ends with 1 if anything is not as it should be.
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

sets="standard hollow inside cavity thin spin still tiny huge offset mixed far rest nested slivers soup one same"
for set in $sets; do
  count=8
  test "$set" = rest && count=12  # the first six gaps, free and colliding
  make_set "$set" "$set" $count
  mkdir -p "$dir/certs"
  build/svcd check --repeat 1 --certificates "$dir/certs" "$dir/$set.txt" >"$dir/out" 2>"$dir/err" || fail "$set: svcd: $(tail -1 "$dir/err")"
  test "$(wc -l <"$dir/out")" = $count || fail "$set: $count problems, but these lines: $(cat "$dir/out")"
  # a second opinion on each answer, and it is accepted
  grep -q "^certificates: $count, of $count answers" "$dir/err" || fail "$set: $(grep -e certificate "$dir/err")"
  build/verify "$dir/$set.txt" "$dir/certs" >"$dir/verified" || fail "$set: verify: $(grep refused "$dir/verified")"
  echo far inside rest nested | grep -qw "$set" ||
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

# rest: the oracle found the gaps that were asked for, 0.1 mm more at most; what is wholly inside has no margin.
holds rest 'a margin that is not a gap' '
  function gap(m) { return m == "nan" || (m > 0.19e-3 && m < 0.31e-3) || (m > 0.49e-3 && m < 0.61e-3) ||
    (m > 0.99e-3 && m < 1.11e-3) || (m > 1.99e-3 && m < 2.11e-3) || (m > 4.99e-3 && m < 5.11e-3) }
  $1 == "problem" && !gap($14 == 1 && $15 != "nan" ? -$15 : $15) { bad = 1 }
  $1 == "problem" && ($14 == 0) != ($15 != "nan" && $15 > 0) { bad = 1 }
  END { exit bad }'
holds rest 'not in turn, or nothing is wholly inside' '
  $1 == "problem" { turn += $14 == $2 % 2; inside += $15 == "nan" } END { exit turn != 12 || !inside }'
holds rest 'not both z up and turned' '
  $1 == "problem" { if ($13 == 1) up = 1; else turned = 1 } END { exit !up || !turned }'
holds nested 'not both labels, or margins of what is inside' '
  $1 == "problem" { n[$14]++; if (($14 == 1) != ($15 == "nan")) bad = 1 } END { exit bad || n[0] != 4 || n[1] != 4 }'
holds nested 'a body of one part, or not both bodies have parts' '
  $1 == "problem" { moving += $3 ~ /^group/; fixed += $5 ~ /^group/ } END { exit !moving || !fixed || moving + fixed != 8 }'
# parts OBJ: how many connected parts a mesh has, vertices at the same place being one.
parts() {
  awk 'function find(i) { while (p[i] != i) i = p[i]; return i }
    $1 == "v" { key = $2 " " $3 " " $4; if (!(key in at)) { at[key] = ++n; p[n] = n } id[++v] = at[key] }
    $1 == "f" { p[find(id[$2])] = find(id[$3]); p[find(id[$3])] = find(id[$4]); used[id[$2]] = 1 }
    END { for (i in used) root[find(i)] = 1; for (i in root) count++; print count }' "$1"
}
for mesh in "$dir"/nested_meshes/group*.obj; do
  case $(parts "$mesh") in [23]) ;; *) fail "nested: $mesh has $(parts "$mesh") parts" ;; esac
done
# triangles OBJ: how many there are, are needles of 1 to 1000 or worse, have no area, are doubles of another.
triangles() {
  awk 'function edge(a, b) { return sqrt((x[a] - x[b]) ^ 2 + (y[a] - y[b]) ^ 2 + (z[a] - z[b]) ^ 2) }
    function least(a, b) { return a < b ? a : b }
    function most(a, b) { return a > b ? a : b }
    $1 == "v" { n++; x[n] = $2; y[n] = $3; z[n] = $4 }
    $1 == "f" {
      u1 = x[$3] - x[$2]; u2 = y[$3] - y[$2]; u3 = z[$3] - z[$2]
      v1 = x[$4] - x[$2]; v2 = y[$4] - y[$2]; v3 = z[$4] - z[$2]
      area = sqrt((u2 * v3 - u3 * v2) ^ 2 + (u3 * v1 - u1 * v3) ^ 2 + (u1 * v2 - u2 * v1) ^ 2)
      long = most(edge($2, $3), most(edge($3, $4), edge($4, $2)))
      all++; flat += area <= 1e-8 * long; needles += area > 1e-8 * long && area < long ^ 2 / 1000
      low = least($2, least($3, $4)); high = most($2, most($3, $4))
      doubles += seen[low " " $2 + $3 + $4 - low - high " " high]++ > 0
    }
    END { print all + 0, needles + 0, flat + 0, doubles + 0 }' "$1"
}
for mesh in "$dir"/slivers_meshes/*.obj; do
  triangles "$mesh" | awk '{ exit $2 < $1 / 5 }' || fail "slivers: $mesh: $(triangles "$mesh")"
done
for mesh in "$dir"/soup_meshes/*.obj; do
  triangles "$mesh" | awk '{ exit $3 < 3 || $4 < 3 }' || fail "soup: $mesh: $(triangles "$mesh")"
done
holds one 'no single triangle' '$1 == "problem" && $3 $5 !~ /triangle/ { bad = 1 } END { exit bad }'
for mesh in "$dir"/one_meshes/triangle*.obj; do
  test "$(grep -c '^f' "$mesh")" = 1 || fail "one: $mesh has not one triangle"
done
holds same 'not the same mesh and scale' '$1 == "problem" && ($3 != $5 || $4 != $6) { bad = 1 } END { exit bad }'
holds same 'not both labels' '$1 == "problem" { n[$14]++ } END { exit !n[0] || !n[1] }'

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
build/problems --set soup --meshes "$dir" --count 1 --out "$dir/x.txt" 2>/dev/null
test $? = 2 || fail "soup of other meshes than its own is not refused"

test "$failures" = 0 || exit 1
echo "problems: all sets are as they should be"
