#!/bin/sh
# The examples as their users run them: the quickstart, the planners, `svcd` on good files and on bad ones. Needs
# `make all build/make_assets`; run from the repository root. Ends with 1 if anything is not as it should be.
set -u
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
failures=0
fail() {
  echo "examples: $*"
  failures=$((failures + 1))
}
# expect STATUS TEXT COMMAND...: exit status, and a text (basic regular expression) that its messages contain.
expect() {
  status=$1 text=$2
  shift 2
  "$@" >"$dir/out" 2>"$dir/err" </dev/null
  got=$?
  test "$got" = "$status" || fail "exit status $got, not $status: $* $(tail -1 "$dir/err")"
  test -z "$text" || grep -q -e "$text" "$dir/err" || fail "no '$text' in the messages of: $*: $(tail -1 "$dir/err")"
}

# line TEXT: what a command printed contains it.
line() { grep -q -e "$1" "$dir/out" || fail "no '$1': $(cat "$dir/out")"; }

# Assets are what make_assets makes, and the quickstart runs on them.
mkdir "$dir/assets"
build/make_assets "$dir/assets" >/dev/null || fail "make_assets"
for asset in mug dish_rack plate; do
  cmp -s "$dir/assets/$asset.obj" "examples/assets/$asset.obj" || echo "examples: note: $asset.obj differs (another libm?)"
done
rm -f build/demo.svg
build/quickstart >"$dir/out" || fail "quickstart"
grep -q 'carried low  -> HITS (witness' "$dir/out" || fail "the mug carried low hits the rack: $(grep low "$dir/out")"
grep -q 'carried high -> clears (certified-free' "$dir/out" || fail "the mug carried high clears the rack: $(grep high "$dir/out")"
# The time that it says is that of the first contact: up to the pose before, the same motion, made anew, is free; two
# poses later it hits.
first=$(sed -n 's/^carried low .* first at t = \([0-9.]*\),.*/\1/p' "$dir/out")
awk -v first="${first:-1}" -v assets="$PWD/examples/assets" 'BEGIN {
  print "nsvcd-problems 1\nmesh mug " assets "/mug.obj\nmesh rack " assets "/dish_rack.obj"
  for (late = 0; late < 2; late++) {
    count = int(64 * first) + 3 * late
    print "problem " (late ? "hit" : "free"), "mug 1 rack 1  0 0 0  0 0 0 1", late, "nan", count
    for (i = 0; i < count; i++) {
      t = i / 64; s = 1 - t; yaw = (0.5 * s - 1.5708) / 2; tilt = 0.45 * s * s
      print 0.04 * s^3, -0.46 * s^3 - 1.08 * s * s * t - 0.03 * s * t * t,
        0.03 * s^3 + 0.45 * s * s * t + 0.45 * s * t * t + 0.02 * t^3,
        sin(tilt) * cos(yaw), -sin(tilt) * sin(yaw), cos(tilt) * sin(yaw), cos(tilt) * cos(yaw)
    }
  }
}' >"$dir/first.txt"
expect 0 'accuracy *100.00' build/svcd check "$dir/first.txt"
tail -1 build/demo.svg | grep -q '^</svg>$' || fail "build/demo.svg is not whole"
if command -v xmllint >/dev/null; then xmllint --noout build/demo.svg || fail "build/demo.svg is not XML"; fi

# One motion, planned: it ends with 0 if it is certified free, with how far it strays from that, and begins and ends
# where it should.
expect 0 '' build/plan
sed -n 1p "$dir/out" | grep -qx 'converged: certified free by 1.0 mm, from which the spline strays 0.0[0-9]* mm' || fail "plan says: $(sed -n 1p "$dir/out")"
test "$(sed -n 2p "$dir/out")" = ' 0.00 -0.50  0.00' || fail "plan begins at: $(sed -n 2p "$dir/out")"
test "$(tail -1 "$dir/out")" = ' 0.00  0.50  0.00' || fail "plan ends at: $(tail -1 "$dir/out")"
(cd "$dir" && "$OLDPWD/build/plan") 2>"$dir/err" && fail "plan without its meshes ends with 0"
grep -q 'mug.obj:0: the file is missing' "$dir/err" || fail "plan without its meshes says: $(cat "$dir/err")"

# The game: no two things overlap by the oracle's word (the exit status), the character arrives, and the pile sleeps.
rm -f build/game.svg
expect 0 '' build/game --frames 540 --check
grep -q '^overlaps: 0 of [0-9]* pairs' "$dir/out" || fail "the game says: $(cat "$dir/out")"
grep -q 'the character is past 5 of 5 stops' "$dir/out" || fail "the character does not arrive: $(sed -n 3p "$dir/out")"
asleep=$(sed -n 's/^\([0-9]*\) of 50 props asleep.*/\1/p' "$dir/out")
test "${asleep:-0}" -ge 35 || fail "the game's pile does not sleep: $(sed -n 3p "$dir/out")"
tail -1 build/game.svg | grep -q '^</svg>$' || fail "build/game.svg is not whole"
expect 1 'cannot be written there' build/game --problems "$dir/none"
for bad in '--frames 0' '--frames' '--seed x' '--speed 3' '--problems'; do
  # shellcheck disable=SC2086
  expect 2 'what is that' build/game $bad
done

# The loop of examples/README.md, word by word, as C99 and C++11: a box on a floor, beside a wall, in a corner, on an elevator.
awk '/^## Ask, go there, respond/ { part = 1 } part && /^```c$/ { on = 1; next } /^```/ { on = part = part && !on } on' \
  examples/README.md >"$dir/loop.inc"
test "$(wc -l <"$dir/loop.inc")" -eq 8 || fail "the loop of examples/README.md has $(wc -l <"$dir/loop.inc") lines, not 8"
for language in 'c99 -x c' 'c++11 -x c++'; do
  # shellcheck disable=SC2086
  ${CC:-cc} -std=$language -O1 -Wall -Wextra -Werror -Wno-unused-function -I. -I"$dir" tests/loop.c -o "$dir/loop" -lm &&
    "$dir/loop" >"$dir/out" || fail "the loop of examples/README.md, $language: $(cat "$dir/out")"
done

# The planners: free motions by the oracle's word (the exit status), and a whole picture.
for planner in dish_insertion bimanual_insertion mining_site; do
  rm -f build/$planner.svg
  expect 0 '' build/$planner
  grep -q 'the oracle:  free, within the limits, at the goal' "$dir/out" || fail "$planner says: $(tail -2 "$dir/out")"
  ! grep -q DISAGREE "$dir/out" || fail "$planner: the network and the oracle disagree: $(cat "$dir/out")"
  tail -1 build/$planner.svg | grep -q '^</svg>$' || fail "build/$planner.svg is not whole"
  if command -v xmllint >/dev/null; then xmllint --noout build/$planner.svg || fail "build/$planner.svg is not XML"; fi
  for seed in x -1 1x '' 99999999999999999999; do expect 2 'usage: ' build/$planner "$seed"; done
  expect 2 'usage: ' build/$planner 1 --help
  expect 2 'usage: ' build/$planner 1 "$dir/x.svg" 1 2
  expect 1 'cannot be written' build/$planner 1 "$dir/no folder/x.svg"
done
expect 2 'usage: ' build/dish_insertion 1 "$dir/x.svg" 1
expect 2 'usage: ' build/mining_site 1 "$dir/x.svg" soon
expect 1 '' build/mining_site 1 "$dir/x.svg" 0  # cancelled by the progress callback
grep -q 'cancelled' "$dir/out" || fail "mining_site is not cancelled: $(cat "$dir/out")"

# Bodies for one method alone, and for both.
expect 0 '' build/svcd encode examples/assets/mug.obj "$dir/proof.body"
expect 0 '' build/svcd info "$dir/proof.body"
expect 0 '' build/svcd encode examples/assets/mug.obj "$dir/both.body" --latents
expect 0 '' build/svcd sweep "$dir/both.body" "$dir/both.body" --to 1,0,0 --method network

# A level, and a flight through it that keeps its distance, by the oracle's word (the exit status).
expect 0 '' build/fly_through 60000
grep -q 'in 0 it waited' "$dir/out" || fail "fly_through says: $(cat "$dir/out")"
tail -1 build/fly_through.svg | grep -q '^</svg>$' || fail "build/fly_through.svg is not whole"
expect 2 'usage: ' build/fly_through 10
expect 2 'usage: ' build/fly_through 1000 1000

# The program of which README shows the middle, line by line, as C99 and C++11.
awk '/^```c$/ { on = 1; next } /^```/ { on = 0 } on' README.md >"$dir/shown"
sed 's/^  //' examples/hello.c >"$dir/lines"
grep -q nsvcd_sweep "$dir/shown" || fail "README shows no question"
grep -vxFf "$dir/lines" "$dir/shown" >"$dir/others" && fail "examples/hello.c has not what README shows: $(head -1 "$dir/others")"
cp examples/hello.c "$dir/hello.cc"
hello() {  # COMPILER AND FLAGS
  "$@" -O2 -Wall -Wextra -Werror -Iexamples -o "$dir/hello" -lm && "$dir/hello" >"$dir/out" || fail "README's program: $*"
  head -1 "$dir/out" | grep -q '^hit, t = 0.60$' || fail "README's program says: $(cat "$dir/out")"
  (cd "$dir" && ./hello) 2>"$dir/err" && fail "README's program ends with 0 without its meshes"
  grep -q '^examples/assets/mug.obj: the file is missing' "$dir/err" || fail "README's program, without its meshes: $(cat "$dir/err")"
}
hello "${CC:-cc}" -std=c99 examples/hello.c
if command -v "${CXX:-c++}" >/dev/null; then hello "${CXX:-c++}" -std=c++11 "$dir/hello.cc"; fi
# The world of hello_game.c: the crate fell and slept, the character goes along the wall and pushes it.
cp examples/hello_game.c "$dir/hello_game.cc"
hello_game() {  # COMPILER AND FLAGS
  "$@" -O0 -Wall -Wextra -Werror -Iexamples -o "$dir/hello_game" -lm && "$dir/hello_game" >"$dir/out" || fail "hello_game.c: $*"
  awk '{ gsub(",", "") } /^1.0/ { slept = $0 ~ /0.30[0-9] asleep/ } { gsub("asleep ", "") }
    END { exit !(slept && NR == 7 && $5 > 1.5 && $7 < 0.32 && $10 > 1.3 && $11 > 1.57 && $11 <= 1.6 && $12 > 0.9 && $12 < 0.92) }' "$dir/out" ||
    fail "hello_game.c says: $(cat "$dir/out")"
}
hello_game "${CC:-cc}" -std=c99 examples/hello_game.c
if command -v "${CXX:-c++}" >/dev/null; then hello_game "${CXX:-c++}" -std=c++11 "$dir/hello_game.cc"; fi
# 0.60 is the first contact: until 0.59 it is free. Any other is not called the first.
expect 0 '' build/svcd sweep examples/assets/mug.obj examples/assets/dish_rack.obj --from 0,-0.4,0.3 --to 0,-0.164,0.123
line '^free'
expect 0 '' build/svcd sweep examples/assets/mug.obj examples/assets/dish_rack.obj --from 0,-0.4,0.3 --to 0,0,0 --first 0
line '^hit at t = 0.[0-9]*, perhaps not the first contact: proven'

# svcd encode, info.
expect 0 '' build/svcd encode examples/assets/mug.obj "$dir/mug.body"
expect 0 '' build/svcd info "$dir/mug.body"
points=$(sed -n 's/^#define NSVCD_DEFAULT_PATCHES \([0-9]*\).*/\1/p' neuralsvcd.h)
grep -q " $points points" "$dir/out" || fail "svcd info says: $(cat "$dir/out")"
expect 0 '' build/svcd encode examples/assets/mug.obj "$dir/9 mug-2.h" --points 40
expect 0 '' build/svcd encode examples/assets/mug.obj "$dir/rough.body" --radius 0.03
expect 0 '' build/svcd encode examples/assets/mug.obj "$dir/latents.body" --no-triangles
expect 0 '' build/svcd info "$dir/latents.body"
! grep -q triangles "$dir/out" || fail "--no-triangles leaves triangles: $(cat "$dir/out")"
printf 'bad' >"$dir/bad.body"
expect 1 'bad.body: this is not a body: .*damaged' build/svcd info "$dir/bad.body"
expect 1 'none.body: No such file' build/svcd info "$dir/none.body"
case $(head -c 4 "$dir/mug.body") in NSVB) mark=BVSN ;; *) mark=NSVB ;; esac
{ printf $mark; tail -c +5 "$dir/mug.body"; } >"$dir/other.body"
expect 1 'other.body: encoded on a machine of the other byte order' build/svcd info "$dir/other.body"
expect 1 'none.obj: No such file' build/svcd encode "$dir/none.obj" "$dir/x.body"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n' >"$dir/bad.obj"
expect 1 'bad.obj:4: an index' build/svcd encode "$dir/bad.obj" "$dir/x.body"
test ! -e "$dir/x.body" || fail "a refused mesh left a body behind"

# svcd info on meshes by hand, and what is wrong with each. cube FILE FLIP SIZE X FACES: FACES of a cube's six, added.
cube() {
  first=$(grep -c '^v' "$1" 2>/dev/null)
  awk -v flip="$2" -v s="$3" -v x="$4" -v faces="$5" -v first="$first" 'BEGIN {
    for (i = 0; i < 8; i++) print "v", x + s * (i % 2), s * (int(i / 2) % 2), s * int(i / 4)
    split("1342 5687 1265 3784 1573 2486", face, " ")
    for (f = 1; f <= faces; f++) {
      line = "f"
      for (k = 1; k <= 4; k++) line = line " " first + substr(face[f], flip ? 5 - k : k, 1)
      print line
    } }' >>"$1"
}
cube "$dir/cube.obj" 0 1 0 6
cube "$dir/open.obj" 0 1 0 5
cube "$dir/inside_out.obj" 1 1 0 6
cube "$dir/mm.obj" 0 184 0 6
cube "$dir/two.obj" 0 1 0 6
cube "$dir/two.obj" 0 1 3 6
cube "$dir/cavity.obj" 0 4 0 6
cube "$dir/cavity.obj" 1 1 1 6
cp "$dir/cube.obj" "$dir/degenerate.obj"
echo 'f 1 2 2' >>"$dir/degenerate.obj"
cp "$dir/cube.obj" "$dir/fin.obj"
printf 'v 5 5 5\nf 1 2 9\n' >>"$dir/fin.obj"
sed 's/^f 1 3 4 2/f 2 4 3 1/' "$dir/cube.obj" >"$dir/turned.obj"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n' >"$dir/flat.obj"
# says FILE COUNT TEXT...: of an OBJ `info` prints so many faults, and these texts; `encode` warns of as many.
says() {
  file=$1 count=$2
  shift 2
  expect 0 '' build/svcd info "$dir/$file.obj"
  test "$(grep -c '^wrong: ' "$dir/out")" = "$count" || fail "info $file, not $count faults: $(grep '^wrong' "$dir/out")"
  for text; do grep -q "$text" "$dir/out" || fail "info $file, no '$text': $(cat "$dir/out")"; done
  expect 0 '' build/svcd encode "$dir/$file.obj" "$dir/x.body"
  test "$(grep -c 'warning: ' "$dir/err")" = "$count" || fail "encode $file, not $count warnings: $(cat "$dir/err")"
}
says cube 0 'cube.obj: an OBJ: 12 triangles, 8 vertices' 'box: 1 x 1 x 1 m' 'components: 1, 1 of them closed$' \
  'area: 6 m2, volume of what is closed: 1 m3' 'nothing is wrong with it' 'as a body: 12 points'
says open 1 'wrong: not a closed surface: 4 open edges in 1 of 1 component' 'components: 1, 0 of them closed' 'area: 5 m2$'
says inside_out 1 'wrong: inside out: its volume is -1 m3' '1 of these turned inwards'
says mm 1 'wrong: a body of 184 m: are these millimetres? try --scale 0.001'
says two 0 'components: 2, 2 of them closed$' 'volume of what is closed: 2 m3'
says cavity 0 'components: 2, 2 of them closed, 1 of these turned inwards' 'volume of what is closed: 63 m3'
says degenerate 1 'wrong: 1 degenerate triangle: no area, as of faces with corners in a line: harmless$'
says fin 1 'wrong: 1 non-manifold edge:' 'components: 1, 1 of them closed'
says turned 1 'wrong: 4 edges of inconsistent winding' 'components: 1, 1 of them closed'
says flat 1 'wrong: flat' 'components: 1, 1 of them closed'
expect 0 '' build/svcd info --scale 0.001 "$dir/mm.obj"
grep -q 'box: 0.184 x 0.184 x 0.184 m' "$dir/out" || fail "info --scale: $(cat "$dir/out")"
grep -q 'nothing is wrong' "$dir/out" || fail "184 mm are wrong: $(cat "$dir/out")"
expect 0 '' build/svcd info --scale 1e-6 "$dir/mm.obj"
grep -q 'wrong: a body of 0.000184 m: .*--scale 0.001$' "$dir/out" || fail "info of 0.2 mm: $(cat "$dir/out")"
expect 0 '' build/svcd encode --scale=0.001 "$dir/mm.obj" "$dir/x.body"
grep -q 'radius 0.1[0-9]* m' "$dir/out" || fail "encode --scale: $(cat "$dir/out")"
for scale in 0 -1 x 1e7 nan 1,2; do expect 2 'scale' build/svcd info "$dir/cube.obj" --scale $scale; done
# A floor of two triangles, and small ones: patches follow the area.
{ printf 'v 0 0 0\nv 99 0 0\nv 99 99 0\nv 0 99 0\nf 1 2 3 4\n'
  awk 'BEGIN { for (i = 0; i < 4000; i++) print "v", i % 64 / 64, int(i / 64) / 64, 1 "\nv", i % 64 / 64 + .01, int(i / 64) / 64, \
    1 "\nv", i % 64 / 64, int(i / 64) / 64 + .01, 1 "\nf -1 -2 -3" }'; } >"$dir/floor.obj"
says floor 3 'wrong: 2 triangles are too large for the patches'
printf 'v 0 0 0\nv 1 0 0\nv 0 1e9 0\nf 1 2 3\n' >"$dir/large.obj"
expect 1 "large.obj:3: .*NSVCD_MAX_COORDINATE.*--scale 0.001.*--recentre.*: 'v 0 1e9 0'" build/svcd info "$dir/large.obj"
# A limit of a million metres is one of metres; a map's offset is taken off in double. Two squares of a map, 1 m wide, 0.25 m
# apart, where floats are 0.5 m apart. Poses stay as they are for the files.
expect 0 '' build/svcd info "$dir/large.obj" --scale 1e-6
line 'box: 1e-06 x 1000 x 0 m'
map() { printf 'v %s %s0 0\nv %s %s0 0\nv %s %s1 0\nv %s %s1 0\nf 1// 2// 3// 4//\n' "$1" "$3" "$2" "$3" "$2" "$3" "$1" "$3"; }
map 500000.1 500001.1 540000 >"$dir/map_a.obj"
map 500001.35 500002.35 540000 >"$dir/map_b.obj"
map 4.5 5.5 '' >"$dir/own.obj"  # in coordinates of its own
expect 1 'map_a.obj:1: a coordinate.*--recentre' build/svcd info "$dir/map_a.obj"
expect 0 '' build/svcd info --recentre "$dir/map_a.obj"
line 'origin: 50000[01] 540000[01] 0, in'
line 'box: 1 x 1 x 0 m'
moved() {  # VERDICT A FROM: straight down through map_b
  expect 0 '' build/svcd sweep "$dir/$2.obj" "$dir/map_b.obj" --recentre --from="$3,1" --to="$3,-1"
  line "^$1"
}
moved free map_a 0,0
moved free map_a 0.24,0
moved hit map_a 0.26,0
moved hit map_a 2.24,0
moved free map_a 2.26,0
moved free own 499995.8,5400000
moved hit own 499995.9,5400000
moved free own 499996,5400001.1
expect 2 'without --skin and --recentre' build/svcd sweep "$dir/map_a.obj" "$dir/map_b.obj" --recentre --certificate "$dir/x.cert"
printf 'v 500000 0 0\nv 500001 0 0\nv 500001 1 0\nf 1 2 3\n' >"$dir/far.obj"
expect 0 '' build/svcd info "$dir/far.obj"
line 'wrong: 5e+05 m from its origin, where floats are 0.06 m apart: .*--recentre'
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n' >"$dir/line.obj"
expect 1 'line.obj: there is no triangle, or no area' build/svcd info "$dir/line.obj"
grep -q 'wrong: 1 degenerate triangle' "$dir/out" || fail "info of no area: $(cat "$dir/out")"

# Other formats, each a square; standard input; what is no mesh at all.
printf 'ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n' >"$dir/x.ply"
expect 0 '' build/svcd info "$dir/x.ply"
line 'x.ply: a PLY: 2 triangles, 4 vertices'
sed 's/^element face 1/element tristrips 1/;s/^4 0 1 2 3/5 0 1 3 2 -1/' "$dir/x.ply" >"$dir/strips.ply"
expect 0 '' build/svcd info "$dir/strips.ply"
line 'strips.ply: a PLY: 2 triangles, 4 vertices'
line '^area: 1 m2'
sed 's/^4 0 1 2 3/4 0 1 2 4/' "$dir/x.ply" >"$dir/index.ply"
expect 1 'index.ply: an index' build/svcd info "$dir/index.ply"
sed 's/^0 1 0$/0 x 0/' "$dir/x.ply" >"$dir/letter.ply"
expect 1 "letter.ply:13: a number is wanted: '0 x 0'" build/svcd info "$dir/letter.ply"
json='{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"scale":[2,2,2]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36}]}'
while test $((${#json} % 4)) != 0; do json="$json "; done
octal() { printf "\\$(printf %o $(($1 % 256)))\\$(printf %o $(($1 / 256)))\\0\\0"; }
{ printf 'glTF\002\0\0\0'; octal $((12 + 8 + ${#json} + 8 + 36)); octal ${#json}; printf 'JSON%s' "$json"
  octal 36; printf 'BIN\0'
  printf '\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\077\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200\077\0\0\0\0'; } >"$dir/x.glb"
expect 0 '' build/svcd info "$dir/x.glb"
line 'x.glb: a GLB: 1 triangle, 3 vertices'
line 'box: 2 x 2 x 0 m'
sed 's/"count":3/"count":4/' "$dir/x.glb" >"$dir/long.glb"
expect 1 'long.glb: an accessor that ends outside of its data (read as GLB)' build/svcd info "$dir/long.glb"
printf 'solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 9 0 0\nvertex 0 9 0\nendloop\nendfacet\nendsolid a\n' >"$dir/x.stl"
expect 0 '' build/svcd info "$dir/x.stl"
line 'x.stl: an STL: 1 triangle'
line 'wrong: a body of 9 m: are these millimetres? try --scale 0.001'
cp "$dir/cube.obj" "$dir/a cube.obj"
expect 2 'no blank' build/svcd sweep "$dir/a cube.obj" "$dir/cube.obj" --certificate "$dir/x.cert"
expect 1 'certificates are of OBJ and STL' build/svcd sweep "$dir/x.ply" "$dir/cube.obj" --certificate "$dir/x.cert"
expect 0 '' build/svcd info "$dir/cube.obj" "$dir/x.ply" "$dir/x.glb"
test "$(grep -c ' vertices$' "$dir/out")" = 3 || fail "info of three files: $(cat "$dir/out")"
expect 1 'none.obj: No such file' build/svcd info "$dir/none.obj" "$dir/cube.obj"
line 'nothing is wrong'
build/svcd info - <"$dir/cube.obj" | grep -q '^standard input: an OBJ: 12 triangles' || fail "info - of an OBJ"
build/svcd info - <"$dir/x.glb" | grep -q '^standard input: a GLB: 1 triangle' || fail "info - of a GLB"
build/svcd sweep - "$dir/cube.obj" --repeat 1 <"$dir/cube.obj" | grep -q '^hit' || fail "sweep - B"
expect 2 'only one of the files may be -' build/svcd sweep - -
expect 1 'Is a directory' build/svcd info "$dir"
head -c 200000000 /dev/zero >"$dir/zeros.obj"
expect 1 'zeros.obj: it begins with zeros' build/svcd info "$dir/zeros.obj"
expect 1 'larger than 512 MB' build/svcd info /dev/urandom
rm "$dir/zeros.obj"
# Nothing of a broken file reaches the terminal as it is; words of UTF-8 do.
printf 'v 0 0 0\n\033]0;x\007 \377 \302\205 gr\303\274n\n' >"$dir/raw.obj"
expect 1 "raw.obj:2: .*: '?]0;x? ? ?? grün'" build/svcd info "$dir/raw.obj"
printf 'nsvcd-problems 1\nmesh \033[31m x.obj\n' >"$dir/raw.txt"
expect 1 'raw.txt: not a text file: it has a control character' build/svcd check "$dir/raw.txt"

# For scripts: JSON that a reader of JSON reads, of each command; a manual and completions that shells take.
if command -v python3 >/dev/null; then
  json() { expect 0 '' build/svcd "$@" --json; python3 -c 'import json, sys
for line in open(sys.argv[1]): json.loads(line, parse_constant=lambda word: sys.exit(word))' "$dir/out" || fail "no JSON: svcd $*"; }
  json sweep "$dir/cube.obj" "$dir/open.obj"
  json sweep "$dir/cube.obj" "$dir/cube.obj" --from 2,0,5 --to 2,0,-5
  json info "$dir/open.obj" "$dir/x.ply" "$dir/mug.body"
  test "$(wc -l <"$dir/out")" = 3 || fail "info --json of three files: $(cat "$dir/out")"
  json encode "$dir/cube.obj" "$dir/x.body"
else
  json() { :; }
fi
expect 0 '' build/svcd --version
line "^svcd $(sed -n '1s/.* v\([0-9.]*\) .*/\1/p' neuralsvcd.h)$"
expect 0 '' build/svcd --manual man
if command -v man >/dev/null; then man --warnings -l "$dir/out" 2>&1 >/dev/null | grep . && fail "the man page"; fi
# Of svcd-verify too, with all options that its usage names.
build/verify >/dev/null 2>"$dir/usage"
for word in FILE FOLDER $(grep -o -e '--[a-z]*' "$dir/usage"); do
  sed 's/\\-/-/g' "$dir/out" | grep '^.fBsvcd-verify' | grep -q -e "$word" || fail "the man page has no $word of svcd-verify"
done
for shell in bash zsh fish; do
  expect 0 '' build/svcd --manual $shell
  if command -v $shell >/dev/null; then $shell -n "$dir/out" || fail "completions for $shell"; fi
done
build/svcd --manual bash >"$dir/complete"
completed=$(bash -c '. "$0"; COMP_WORDS=(svcd sweep a.obj --method ""); COMP_CWORD=4; _svcd; echo "${COMPREPLY[@]}"
  COMP_WORDS=(svcd sweep --meas); COMP_CWORD=2; _svcd; echo "${COMPREPLY[@]}"; COMP_WORDS=(svcd pl); COMP_CWORD=1; _svcd; echo "${COMPREPLY[@]}"' "$dir/complete" | paste -sd,)
test "$completed" = 'proof network,--measure,plan' || fail "bash completes: $completed"
expect 2 'man, bash, zsh or fish' build/svcd --manual

# svcd sweep: verdicts that are known. verdict TEXT ARGUMENTS...: what the first line says.
verdict() {
  wanted=$1
  shift
  expect 0 '' build/svcd sweep --repeat 1 "$@"
  head -1 "$dir/out" | grep -q -e "$wanted" || fail "no '$wanted': sweep $*: $(cat "$dir/out" "$dir/err")"
}
verdict '^hit at t = 0.4[0-9]*, the first contact: proven, two triangles meet$' "$dir/cube.obj" "$dir/cube.obj" \
  --scale .5,1 --from .25,.25,5 --to .25,.25,-5
awk 'NR == 1 { sub(",", "", $5); exit !($5 >= 0.4 && $5 <= 0.401) }' "$dir/out" || fail "the first contact: $(cat "$dir/out")"
line '^normal *0 0 1, from B to A$'
line '^triangles *[0-9]* of A, [23] of B, counted from 0$'
line '^point *[0-9.]* [0-9.]* [01][0-9.]* m$'
line '^motion *A from 0.25 0.25 5 to 0.25 0.25 -5$'
line '^time *[0-9.]* us, and [0-9.]* us for the first contact (median of 1); encoding [0-9.]* ms$'
verdict '^free: proven, the surfaces never meet$' "$dir/cube.obj" "$dir/cube.obj" --from 2,0,5 --to=2,0,-5 --measure 0.001
awk '/^clearance/ { good = $2 <= 1 && $4 >= 1 && $4 - $2 < 0.0021 } END { exit !good }' "$dir/out" || fail "they pass at 1 m: $(cat "$dir/out")"
verdict '^free, never as near as 0.9 m: ' "$dir/cube.obj" "$dir/cube.obj" --from 2,0,5 --to 2,0,-5 --clearance 0.9
verdict '^hit .* as near as 1.1 m: ' "$dir/cube.obj" "$dir/cube.obj" --from 2,0,5 --to 2,0,-5 --clearance 1.1
verdict '^hit at t = 0.0000, .*one is inside of the other' "$dir/cube.obj" "$dir/mm.obj" --from 5,5,5 --to 6,6,6
verdict '^free' "$dir/cube.obj" "$dir/cube.obj" --from 0,0,1 --to 0,0,5 --skin 0.001
verdict '^hit at t = 0.0000' "$dir/cube.obj" "$dir/cube.obj" --from 0,0,1 --to 0,0,5
# Faces that slide along each other at 30 um.
verdict '^free' "$dir/cube.obj" "$dir/cube.obj" \
  --from -3,0,1.00003 --to 3,0,1.00003 --rotate z,30
# Poses are metres, whatever the scale of files: what is never near is told, and nothing is where A comes near, or could.
way() { verdict '^free' "$dir/mm.obj" "$dir/mm.obj" --scale 0.001 --from "$1" --to "$2"; }
way 800,500,1500 800,500,0
grep -q 'warning: A is never nearer than 942 m to B: are the poses in millimetres' "$dir/err" || fail "poses in mm: $(cat "$dir/err")"
way 800,1,0 -800,1,0
test ! -s "$dir/err" || fail "a way past B is warned of: $(cat "$dir/err")"
way 0.8,0.5,1.5 0.8,0.5,0
test ! -s "$dir/err" || fail "poses in metres are warned of: $(cat "$dir/err")"
# By a table of poses: the same answer as by --from and --to; its own times, and lines; all contacts, each as a sweep of that
# stretch says.
printf '.25 .25 5\n.25 .25 -5\n' >"$dir/two.csv"
verdict '^hit at t = 0.40[01][0-9]* (after line 1), the first contact: proven' "$dir/cube.obj" "$dir/cube.obj" --scale .5,1 --poses "$dir/two.csv"
printf 't, x,y,z, qx,qy,qz,qw\n10,2,0,5,0,0,0,1 # a\n\n20;2;0;-5;0;0;0;1\n30,.25,.25,-5,0,0,0,1\n70,.25,.25,5,0,0,0,1\n72,2,0,5,0,0,0,1\n74,.25,.25,5,0,0,0,1\n76,.25,.25,1,0,0,0,1\n78,.25,.25,.9,0,0,0,1\n' >"$dir/table.csv"
verdict '^hit at t = 48[.0-9]* (after line 5), the first contact: proven' "$dir/cube.obj" "$dir/cube.obj" --scale .5,1 --poses "$dir/table.csv" --all
line '^contact *lines 5 to 6, first at t = 48[.0-9]* (after line 5): '
line '^contact *lines 8 to 10, first at t = 7[56][.0-9]* (after line [89]): '
line '^stretches *7: 4 free, 3 with a contact, 0 undecided$'
test "$(grep -c ^contact "$dir/out")" = 2 || fail "all contacts: $(cat "$dir/out")"
verdict '^hit' "$dir/cube.obj" "$dir/cube.obj" --scale .5,1 --poses "$dir/table.csv" --all --picture "$dir/table.svg" --clearance .1
expect 2 'needs --poses' build/svcd sweep "$dir/cube.obj" "$dir/cube.obj" --all
expect 2 'not together with --from' build/svcd sweep "$dir/cube.obj" "$dir/cube.obj" --poses "$dir/table.csv" --to 0,0,0
# B rests, so the proof of a table with times is one without them; a note of a line stands behind its contact.
timed() {
  verdict "^$1" "$dir/cube.obj" "$dir/cube.obj" --scale .5,1 --poses "$dir/timed.csv" --certificate "$dir/timed.cert"
  line 'timed.txt, without times: B rests$'
  expect 0 '' build/verify "$dir/timed.txt" "$dir"
  line "^timed	accepted	$1	"
}
head -4 "$dir/table.csv" >"$dir/timed.csv"
timed free
printf '0,.25,.25,5\n1,.25,.25,4\n100,.25,.25,-5 # part.nc 7, down \r\n' >"$dir/timed.csv"
timed hit
verdict '^hit at t = 3[34][.0-9]* (after line 2)' "$dir/cube.obj" "$dir/cube.obj" --scale .5,1 --poses "$dir/timed.csv" --all
line '^contact *lines 2 to 3, first at t = 3[34][.0-9]* (after line 2): .* m  # part.nc 7, down$'
build/svcd sweep "$dir/cube.obj" "$dir/cube.obj" --scale .5,1 --poses "$dir/timed.csv" --all --json | grep -q '"note": *"part.nc 7, down"' ||
  fail "a note in JSON"
# The first contact is found in its stretch, of which 4,000 are shorter than a thousandth of the motion; drawn or not.
awk 'BEGIN { for (i = 0; i <= 4000; i++) print 0.25, 0.25, 5 - i / 400 }' >"$dir/long.csv"
for drawn in '' "--picture $dir/long.svg"; do
  # shellcheck disable=SC2086
  verdict '^hit at t = 0.40[0-9]* (after line 1600), the first' "$dir/cube.obj" "$dir/cube.obj" --scale .5,1 --poses "$dir/long.csv" --all $drawn
  head -1 "$dir/out" >>"$dir/drawn"
  line '^contact *lines 1600 to [0-9]*, first at t = 0.40[0-9]* (after line 1600): '
done
test "$(sort -u "$dir/drawn" | wc -l)" = 1 || fail "a picture changes the answer: $(cat "$dir/drawn")"
# table REASON TEXT: refused.
table() {
  printf "$2" >"$dir/bad.csv"
  expect 1 "$1" build/svcd sweep "$dir/cube.obj" "$dir/cube.obj" --poses "$dir/bad.csv"
}
table 'bad.csv: no poses' 'x y z\n'
table 'bad.csv:2: not a finite number' '0 0 0\n0 0 nan\n'
table 'bad.csv:2: expected 3 numbers, as in the lines before, not 4' '0 0 0\n0 0 0 1\n'
table "bad.csv:1: not a finite number: 'nan'" '0,nan\n'
table 'bad.csv:1: expected .t. x y z .*, not 2 numbers' '0 0\n'
table 'bad.csv:3: times do not rise' '0 0 0 1\n1 0 0 1\n1 0 0 2\n'
table 'line 2: its time is too near' '0 0 0 1\n1 0 0 1\n1e9 0 0 2\n'
table 'bad.csv:1: the quaternion is not of unit length' '0 0 0 1 0 0 1\n'
table 'bad.csv:1: a coordinate is out of range' '0 0 2e6\n'
# Of G-code: lines, arcs by their centre and by their radius, a full circle, inches; and what it refuses.
printf 'G21 G90 G17 (mm)\nG0 X0 Y0 Z5\nG1 Z0 F300\nG2 X10 Y10 I10 J0\nG2 X20 Y0 R10\nG3 X20 Y0 I-10\nG91 G20 G1 X-1 ; an inch\n' |
  python3 examples/gcode.py - >"$dir/way.csv" || fail "gcode.py"
awk -F '[ ,#]+' '
  NR == 2 { exit_if($0 != "0, 0, 0, 0  # line 0") }
  NR > 2 && $6 > 3 && $6 < 7 { r = sqrt(($2 - .01)^2 + $3^2); exit_if(r < .01 - 1e-9 || r > .01 + 1e-9) }
  NR > 2 && $6 == 6 && $3 < low { low = $3 }
  NR > 2 && $6 == 5 { exit_if($2 < .01 - 1e-9 || $3 < -1e-9) }
  { t = $1; x = $2 }
  function exit_if(bad) { if (bad) { print "line " NR ": " $0; failed = 1 } }
  END { exit_if(low > -.0099 || x > -.0053999 || x < -.0054001)
    exit_if(t < 24.97 || t > 25.01 || NR < 40); exit failed }' "$dir/way.csv" ||
  fail "gcode.py makes: $(cat "$dir/way.csv")"
verdict '^hit at t = .* (after line [0-9]*), the first contact' "$dir/cube.obj" "$dir/cube.obj" --scale .001 --poses "$dir/way.csv"
printf 'G28\n' | python3 examples/gcode.py - 2>&1 | grep -q -e '--skip G28' || fail "gcode.py names no --skip G28"
printf 'X1\n' | python3 examples/gcode.py - 2>&1 | grep -q 'line 1: a place before' || fail "gcode.py takes: X1"
printf 'G0 X1\n' | python3 examples/gcode.py --start=-300,0,0 - | grep '^0, -0.3, 0, 0 ' >/dev/null || fail "gcode.py --start="
awk 'BEGIN { for (i = 1; i < 20000; i++) print "G0 X" i % 2 }' >"$dir/way.nc"
{ python3 examples/gcode.py "$dir/way.nc"; echo "status $?" >&2; } 2>"$dir/err" | head -1 >/dev/null
grep -q 'Broken pipe' "$dir/err" && grep -qx 'status 1' "$dir/err" && ! grep -q 'Traceback\|Exception' "$dir/err" ||
  fail "gcode.py of a broken pipe: $(cat "$dir/err")"
for bad in 'G28' 'G1 X1 F0' 'G1 X1 A3 F1' 'G1 X#1 F1' 'G2 X1 F1' 'G2 X1 I9 F1'; do
  printf 'G0 Z5\n%s\n' "$bad" | python3 examples/gcode.py - >"$dir/out" 2>"$dir/err" && fail "gcode.py takes: $bad"
  test ! -s "$dir/out" || fail "gcode.py prints a part of a table: $bad"
  grep -q 'gcode.py: line 2: ' "$dir/err" || fail "gcode.py says of $bad: $(cat "$dir/err")"
done
printf 'G28 Z9\nG1 X1 F1\n' | python3 examples/gcode.py - --skip G28 2>"$dir/err" | tail -1 | grep -q '^60, 0.001, 0, 0  # line 2$' || fail "gcode.py --skip"
grep -q 'line 1 is skipped' "$dir/err" || fail "gcode.py --skip says: $(cat "$dir/err")"
# For scripts: the answer as exit status, which no failure has. answers STATUS ARGUMENTS...
answers() {
  wanted=$1
  shift
  expect "$wanted" '' build/svcd sweep --repeat 1 --exit-code "$@"
}
answers 0 "$dir/cube.obj" "$dir/cube.obj" --from 2,0,5 --to 2,0,-5
answers 0 "$dir/cube.obj" "$dir/cube.obj" --from 2,0,5 --to 2,0,-5 --clearance 0.9 --json
answers 0 "$dir/cube.obj" "$dir/cube.obj" --from 2,0,5 --to 2,0,-5 --method network
answers 1 "$dir/cube.obj" "$dir/cube.obj" --scale .5,1 --from .25,.25,5 --to .25,.25,-5 --picture "$dir/x.svg"
answers 1 "$dir/cube.obj" "$dir/cube.obj" --from 2,0,5 --to 2,0,-5 --clearance 1.1
answers 1 "$dir/cube.obj" "$dir/mm.obj" --from 5,5,5 --to 6,6,6 --first 0
answers 1 "$dir/cube.obj" "$dir/cube.obj" --method network
answers 3 "$dir/cube.obj" "$dir/cube.obj" --from -3,0,1.00003 --to 3,0,1.00003 --rotate z,30 --work 1
answers 2 "$dir/none.obj" "$dir/cube.obj"
answers 2 "$dir/bad.obj" "$dir/cube.obj"
answers 2 "$dir/cube.obj"
answers 2 "$dir/cube.obj" "$dir/cube.obj" --from 1,2
answers 2 "$dir/cube.obj" "$dir/cube.obj" --picture "$dir/no folder/x.svg"
answers 2 "$dir/cube.obj" "$dir/cube.obj" --certificate "$dir/no folder/x.cert"
answers 2 "$dir/cube.obj" "$dir/latents.body" --method proof
if test -w /dev/full; then
  build/svcd sweep --exit-code "$dir/cube.obj" "$dir/cube.obj" --from 2,0,5 --to 2,0,-5 >/dev/full 2>"$dir/err"
  test $? = 2 || fail "--exit-code: nothing can be written, and yet it is free"
  build/svcd sweep --exit-code "$dir/cube.obj" "$dir/cube.obj" >/dev/full 2>"$dir/err"
  test $? = 2 || fail "--exit-code: nothing can be written, and yet it is hit"
fi
build/svcd sweep --exit-code "$dir/cube.obj" "$dir/cube.obj" --help >"$dir/out" || fail "--exit-code --help"
line '--exit-code'
verdict '^hit' "$dir/cube.obj" "$dir/open.obj"
! grep -q 'from B to A' "$dir/out" || fail "the side of a sheet is not known: $(cat "$dir/out")"
# A turns on its way, and reaches B where it turns far enough that way; a whole turn is not none.
verdict '^free' "$dir/cube.obj" "$dir/cube.obj" --from 0.5,2.2,0 --to 0.5,2.2,0
verdict '^hit' "$dir/cube.obj" "$dir/cube.obj" --from 0.5,2.2,0 --to 0.5,2.2,0 --rotate z,-135
line 'turning -135 degrees about z'
verdict '^free' "$dir/cube.obj" "$dir/cube.obj" --from 0.5,2.2,0 --to 0.5,2.2,0 --rotate z,45
verdict '^hit' "$dir/cube.obj" "$dir/cube.obj" --from 0.5,2.2,0 --to 0.5,2.2,0 --rotate z,360
verdict '^hit' "$dir/cube.obj" "$dir/cube.obj" --from 0.5,2.2,0 --to 0.5,2.2,0,0,0,-0.9239,0.3827
line 'turning 135 degrees about'
# Without a motion: through B where it is thinnest, from outside to outside; two cubes side by side leave a way.
verdict '^free' "$dir/cube.obj" "$dir/two.obj"
line '^motion *A from 1.5 1.9 0 to 1.5 -1.9 0: straight through B along y, where it is thinnest$'
verdict '^hit' "$dir/cube.obj" "$dir/two.obj" --scale 2.1,1
verdict '^hit' "$dir/mm.obj" "$dir/cube.obj" --scale 0.001,1
test ! -s "$dir/err" || fail "184 mm are warned of: $(cat "$dir/err")"
verdict '^hit' "$dir/mm.obj" "$dir/cube.obj"
grep -q 'warning: .*mm.obj: a body of 184 m: .*--scale 0.001,1$' "$dir/err" || fail "no warning of 184 m: $(cat "$dir/err")"
verdict '^hit' "$dir/cube.obj" "$dir/mm.obj" --scale 1,2
grep -q 'warning: .*mm.obj: a body of 368 m: .*--scale 1,0.002$' "$dir/err" || fail "no warning of 368 m: $(cat "$dir/err")"
verdict '^hit' "$dir/mm.obj" "$dir/mm.obj"
test "$(grep -c 'mm.obj: a body of 184 m: .*--scale 0.001$' "$dir/err")" = 2 || fail "no warning of both: $(cat "$dir/err")"
# What is not closed is told, of a body as well; and --open says that it is a sheet.
sed '$d' "$dir/cube.obj" >"$dir/bin.obj"
sed 's/^f 1 3 4 2/f 1 3 4/' "$dir/cube.obj" >"$dir/missing.obj"
awk '/^v/ { print "v", 0.1 * $2, 0.1 * $3, 0.1 * $4; next } { print }' "$dir/cube.obj" >"$dir/tenth.obj"
expect 0 '' build/svcd encode "$dir/missing.obj" "$dir/missing.body"
for file in missing.obj missing.body; do
  verdict '^undecided.*nearly a solid' "$dir/tenth.obj" "$dir/$file" --from 0.3,0.4,0.5 --to 0.31,0.4,0.5
  grep -q "warning: .*$file: not a closed surface: 3 open edges in 1 of 1 component; " "$dir/err" || fail "$file: $(cat "$dir/err")"
done
verdict '^free: proven' "$dir/tenth.obj" "$dir/missing.obj" --from 0.3,0.4,0.5 --to 0.31,0.4,0.5 --open
test ! -s "$dir/err" || fail "a sheet is warned of: $(cat "$dir/err")"
verdict '^free: proven' "$dir/tenth.obj" "$dir/bin.obj" --from 0.3,0.4,0.5 --to 0.31,0.4,0.5
verdict '^hit at t = 0.*inside' "$dir/tenth.obj" "$dir/fin.obj" --from 0.3,0.4,0.5 --to 0.31,0.4,0.5
printf 'nsvcd-plans 1\njoint j world 0 0 0 0 0 0 1 1 0 0 prismatic -1 1 1\nbody a j tenth.obj\nscene s\nobstacle b missing.obj -0.4 -0.4 -0.4 0 0 0 1\nplan p s 0 0.1\npath q s 2\n0\n0.1\n' >"$dir/nearly.txt"
for command in plan path; do
  expect 0 'a part of a or b seems to be inside the other' build/svcd $command "$dir/nearly.txt"
  grep -q 'warning: .*missing.obj: not a closed surface' "$dir/err" || fail "$command: $(cat "$dir/err")"
  expect 0 '' build/svcd $command --open "$dir/nearly.txt"
  grep -q 'certified\|free' "$dir/out" || fail "$command --open: $(cat "$dir/out")"
done
# .body files, and the network.
expect 0 '' build/svcd encode "$dir/cube.obj" "$dir/cube.body"
verdict '^free: proven' "$dir/cube.body" "$dir/cube.obj" --from -2,0,5 --to -2,0,-5 --scale 1.9,1
verdict '^hit .*proven' "$dir/cube.body" "$dir/cube.obj" --from -2,0,5 --to -2,0,-5 --scale 2.1,1
verdict '^free: proven' "$dir/cube.obj" "$dir/cube.body" --from 2,0,5 --to 2,0,-5 --scale 1,1.9
verdict '^hit .*proven' "$dir/cube.obj" "$dir/cube.body" --from 2,0,5 --to 2,0,-5 --scale 1,2.1
verdict "^hit .*: the network's opinion, logit" "$dir/latents.body" "$dir/cube.obj"
verdict "^hit .*: the network's opinion, logit" "$dir/cube.obj" "$dir/cube.obj" --method network
expect 1 'latents.body: the network knows neither' build/svcd sweep "$dir/latents.body" "$dir/cube.obj" --measure 0.1
expect 1 'latents.body: it holds no triangles' build/svcd sweep "$dir/latents.body" "$dir/cube.obj" --method proof
expect 1 'proof.body: it holds nothing for the network' build/svcd sweep "$dir/proof.body" "$dir/cube.obj" --method network
expect 2 'network knows neither' build/svcd sweep "$dir/cube.obj" "$dir/cube.obj" --method network --skin 0.1
# Pictures are XML, whatever the names are: of a hit, of what is free, of what is not closed, of bodies.
cp "$dir/cube.obj" "$dir/a&<b>.obj"
picture() {
  rm -f "$dir/x.svg"
  expect 0 '' build/svcd sweep --repeat 1 "$@" --picture "$dir/x.svg"
  line '^picture *.*x.svg$'
  tail -1 "$dir/x.svg" | grep -q '^</svg>$' || fail "the picture is not whole: sweep $*"
  if command -v xmllint >/dev/null; then xmllint --noout "$dir/x.svg" || fail "the picture is not XML: sweep $*"; fi
}
picture "$dir/a&<b>.obj" "$dir/cube.obj"
grep -q '>contact<' "$dir/x.svg" || fail "no contact in the picture"
picture "$dir/cube.obj" "$dir/two.obj"
grep -q '>half way<' "$dir/x.svg" || fail "no 'half way' in the picture"
picture "$dir/cube.obj" "$dir/two.obj" --measure 0.01
grep -q '>nearest<' "$dir/x.svg" || fail "no 'nearest' in the picture"
picture "$dir/open.obj" "$dir/mug.body" --scale 0.05,1
picture "$dir/flat.obj" "$dir/flat.obj"
expect 1 'cannot be written' build/svcd sweep "$dir/cube.obj" "$dir/cube.obj" --picture "$dir/no folder/x.svg"
# What is there is written over only by its like, so no input is, by whatever name; pictures are .svg.
for name in sweep.obj sweep.png svg; do
  expect 2 '--picture: .*does not end in .svg' build/svcd sweep "$dir/cube.obj" "$dir/cube.obj" --picture "$dir/$name"
  test ! -e "$dir/$name" || fail "a picture in $name"
done
kept() {  # FILE COMMAND...: refused, and the file as it was
  file=$1
  shift
  cp "$file" "$dir/before"
  expect 1 'is there already, and is no' "$@"
  cmp -s "$file" "$dir/before" || { fail "an input was written over: $*"; cp "$dir/before" "$file"; }
}
cp "$dir/cube.obj" "$dir/mesh.svg"
cp "$dir/cube.obj" "$dir/mesh.h"
ln -s cube.obj "$dir/soft.svg"
ln "$dir/cube.obj" "$dir/hard.svg"
ln "$dir/cube.obj" "$dir/hard.body"
kept "$dir/mesh.svg" build/svcd sweep "$dir/mesh.svg" "$dir/cube.obj" --picture "$dir/./mesh.svg"
kept "$dir/mesh.h" build/svcd encode "$dir/mesh.h" "$dir/mesh.h"
for name in soft.svg hard.svg; do
  kept "$dir/cube.obj" build/svcd sweep "$dir/cube.obj" "$dir/cube.obj" --picture "$dir/$name"
done
kept "$dir/cube.obj" build/svcd encode "$dir/cube.obj" "$dir/hard.body"
kept "$dir/cube.obj" build/dish_insertion 1 "$dir/soft.svg"
expect 0 '' build/svcd encode "$dir/cube.obj" "$dir/again.h" --points 3
expect 0 '' build/svcd encode "$dir/cube.obj" "$dir/again.h" --points 3
# A disk that is full: of a limit of files, and of standard output.
(trap '' XFSZ; ulimit -f 1; expect 1 'cannot be written' build/svcd sweep "$dir/cube.obj" "$dir/cube.obj" --picture "$dir/full.svg"; exit "$failures") ||
  failures=$((failures + 1))
(trap '' XFSZ; ulimit -f 1; expect 1 'full.body: cannot be written' build/svcd encode examples/assets/mug.obj "$dir/full.body"; exit "$failures") ||
  failures=$((failures + 1))
if test -c /dev/full; then
  build/svcd info "$dir/cube.obj" >/dev/full 2>"$dir/err"
  test $? = 1 && grep -q 'standard output cannot be written' "$dir/err" || fail "a full standard output: $(cat "$dir/err")"
fi

# What is wrong is named.
expect 1 'none.obj: No such file' build/svcd sweep "$dir/cube.obj" "$dir/none.obj"
expect 1 "bad.obj:4: an index .*: 'f 1 2 4'" build/svcd sweep "$dir/bad.obj" "$dir/cube.obj"
expect 1 'bad.body: this is not a body: .*damaged' build/svcd sweep "$dir/cube.obj" "$dir/bad.body"
expect 2 'did you mean --from' build/svcd sweep "$dir/cube.obj" "$dir/cube.obj" --form 1,2,3
expect 2 'clearance 5mm: expected metres, as 0.005$' build/svcd sweep "$dir/cube.obj" "$dir/cube.obj" --clearance 5mm
expect 2 'first 5mm: expected metres, as 0.005m, or a fraction' build/svcd sweep "$dir/cube.obj" "$dir/cube.obj" --first 5mm
expect 0 '' build/svcd sweep --help
line 'whatever --scale says'
expect 2 'did you mean --from' build/svcd sweep "$dir/cube.obj" "$dir/cube.obj" --form=1,2,3
expect 2 'the length 2, not 1' build/svcd sweep "$dir/cube.obj" "$dir/cube.obj" --to 1,2,3,0,0,0,2
# one tolerance, that of the library and of files
expect 2 'the length 1.0002, not 1 to 0.0001' build/svcd sweep "$dir/cube.obj" "$dir/cube.obj" --to 1,2,3,0,0,0,1.0002
expect 0 '' build/svcd sweep "$dir/cube.obj" "$dir/cube.obj" --to 1,2,3,0,0,0,1.00005
expect 2 'not together with another rotation' build/svcd sweep "$dir/cube.obj" "$dir/cube.obj" --to 1,2,3,0,0,1,0 --rotate z,9
for option in --from=1,2 --from=1,2,x --from=1,2,nan --from=1,2,3,4 --from=1,2,2e6 '--from=1,2,3,' --to= --rotate=w,9 '--rotate=z,' \
  --rotate=z,99999 --scale=1,2,3 --scale=0 --measure=0 --measure=-1 --clearance=2e6 --skin=-1 --points=0 --method=magic --picture; do
  expect 2 "${option%%=*}" build/svcd sweep "$dir/cube.obj" "$dir/cube.obj" "$option"
done

# The baked array, as C and C++.
cat >"$dir/baked.c" <<END
#define NSVCD_STATIC
#define NEURALSVCD_IMPLEMENTATION
#include "$(pwd)/neuralsvcd.h"
#include "9 mug-2.h"
int main(void) {
  const nsvcd_body *body;
  if (nsvcd_body_load(_9_mug_2_body, sizeof _9_mug_2_body, &body) != NSVCD_OK) return 1;
  return nsvcd_body_describe(body).patches != 40;
}
END
cp "$dir/baked.c" "$dir/baked.cc"
"${CC:-cc}" -std=c99 "$dir/baked.c" -o "$dir/baked" -lm && "$dir/baked" || fail "the baked array, as C99"
if command -v "${CXX:-c++}" >/dev/null; then
  "${CXX:-c++}" -std=c++11 "$dir/baked.cc" -o "$dir/baked" -lm && "$dir/baked" || fail "the baked array, as C++11"
fi

# svcd check on a good file: CRLF, tabs, comments, no final newline, every LABEL, one pose and several.
cp examples/assets/mug.obj "$dir/my.obj"
pose='0 0 0 0 0 0 1'
printf 'nsvcd-problems 1\r\n# a comment\r\n\r\nmesh\tmug  my.obj # here\nproblem a mug 1 mug 2 %s 1 nan 1\n%s\n' "$pose" "$pose" >"$dir/good.txt"
printf 'problem b mug 1 mug 1 5 0 0 0 0 0 1 0 4.9 2\n%s\n\n# between\n0 1 0 0 0 0 -1\n' "$pose" >>"$dir/good.txt"
printf 'problem c mug 1e-1 mug 1 %s -1 -nan 1\n5 5 5 0 0 .7071068 .7071068' "$pose" >>"$dir/good.txt"
expect 0 '3 problems (1 collide, 1 free, 1 without a label)' build/svcd check --repeat 1 "$dir/good.txt"
test "$(wc -l <"$dir/out")" = 3 || fail "3 problems, but these lines: $(cat "$dir/out")"
awk -F '\t' 'NF != 8 || $3 != ($2 > 0) || $4 < 0 || $4 > 1 || $8 <= 0 { exit 1 }' "$dir/out" || fail "not TSV: $(cat "$dir/out")"
test "$(cut -f1 "$dir/out" | tr -d '\n')" = abc || fail "identifiers"
test "$(sed -n 2p "$dir/out" | cut -f2,3,7)" = "$(printf -- '-100\t0\tcertified-free')" || fail "b is certified free"
cut -f1-7 "$dir/out" >"$dir/first"
for options in '--method proof' '--method network' '--method network --model tiny' '--model small --pairs 32' \
  '--recall 0.999' '--points 512 --pairs 1' --int8 '--work 1' '--first 0.01' '--clearance 0.01'; do
  # shellcheck disable=SC2086
  expect 0 '3 problems' build/svcd check $options --repeat 1 "$dir/good.txt"
done
(cd "$dir" && "$OLDPWD/build/svcd" check --repeat 2 good.txt 2>/dev/null) | cut -f1-7 | cmp -s - "$dir/first" ||
  fail "another folder or --repeat, another answer"

# Two movers: they meet half way, and the first contact is before that; a clearance is met sooner.
printf 'nsvcd-problems 1\nmesh m my.obj\nproblem two m 1 m 1 %s 1 nan 2 2\n0 0 0 0 0 0 1\n1 0 0 0 0 0 1\n1 0 0 0 0 0 1\n0 0 0 0 0 0 1\n' "$pose" >"$dir/two.txt"
for options in '' '--first 0.001' '--first 0.001 --clearance 0.05'; do
  # shellcheck disable=SC2086
  expect 0 '1 of 1 right' build/svcd check --repeat 1 $options "$dir/two.txt"
  cut -f4 "$dir/out" >>"$dir/times"
done
awk '{ t[NR] = $1 } END { exit !(NR == 3 && t[2] <= t[1] && t[3] < t[2] && t[2] < 0.5 && t[3] > 0.3) }' "$dir/times" ||
  fail "times of contact: $(cat "$dir/times")"
expect 2 'out of range' build/svcd check --clearance -1 "$dir/two.txt"
# What stands on another, its top at 1, slides along it, and is stopped only without a skin.
printf 'nsvcd-problems 1\nmesh m cube.obj\nproblem slide m 1 m 1 %s 0 nan 2 1\n0 0 1 0 0 0 1\n0.3 0 0.9999 0 0 0 1\n0 0 0 0 0 0 1\n' "$pose" >"$dir/slide.txt"
expect 0 '0 of 1 right' build/svcd check --repeat 1 "$dir/slide.txt"
expect 0 '1 of 1 right' build/svcd check --repeat 1 --skin 0.001 "$dir/slide.txt"
expect 2 'neither' build/svcd check --method network --skin 0.1 "$dir/slide.txt"
# All that is known of it, in a line: free all the way, in contact by no more than its triangles are stored to.
expect 0 '1 of 1 right' build/svcd check --repeat 1 --skin 0.001 --first 0.001m --details "$dir/slide.tsv" "$dir/slide.txt"
awk -F '\t' '{ good = NF == 16 && $1 == "slide" && $2 == "free" && $3 == 1 && $4 == 1 && $7 < 4e-5 && $8 == 1 && $9 > 0.299 &&
  $11 > 0.99999 && $11 < 1.0002 && $16 == 0 } END { exit !good }' "$dir/slide.tsv" || fail "the slide in detail: $(cat "$dir/slide.tsv")"
# A cube set down on another one, to a tenth of a millimetre: four contacts, at the corners of what they share, with normals upwards.
printf 'nsvcd-problems 1\nmesh m cube.obj\nproblem down m 1 m 1 %s 1 nan 2 1\n0.2 0.3 2 0 0 0 1\n0.2 0.3 0.5 0 0 0 1\n0 0 0 0 0 0 1\n' "$pose" >"$dir/down.txt"
expect 0 '1 of 1 right' build/svcd check --repeat 1 --first 0.0001m --details "$dir/down.tsv" "$dir/down.txt"
awk -F '\t' '{ good = NF == 44 && $2 == "hit" && $4 - $3 < 0.0001 && $3 <= 0.6667 && $4 >= 0.6666 && $7 == 0 && $11 > 0.99999 && $16 == 4
  for (n = 17; n < 44; n += 7) good = good && $(n + 2) > 0.999 && $(n + 2) < 1.001 && $(n + 5) > 0.999 && $(n + 6) <= 0.0002 &&
    ($n < 0.21 || $n > 0.99) && ($(n + 1) < 0.31 || $(n + 1) > 0.99) } END { exit !good }' "$dir/down.tsv" ||
  fail "a cube set down: $(cat "$dir/down.tsv")"
expect 2 'ends in .tsv' build/svcd check --details "$dir/x.txt" "$dir/two.txt"
expect 1 'x.tsv: ' build/svcd check --details "$dir/no folder/x.tsv" "$dir/two.txt"
expect 2 'or metres' build/svcd check --first 1e9m "$dir/two.txt"
expect 2 'or metres' build/svcd check --first m "$dir/two.txt"
expect 2 'not a number in 0..1' build/svcd check --first 2 "$dir/two.txt"
expect 2 'neither' build/svcd check --method network --first 0.1 "$dir/two.txt"

# Problem files that must be refused, with file, line and reason. refused LINE REASON TEXT
head='nsvcd-problems 1\nmesh m my.obj\n'
refused() {
  printf "$3" >"$dir/bad.txt"
  expect 1 "bad.txt:$1: .*$2" build/svcd check "$dir/bad.txt"
  test ! -s "$dir/out" || fail "a refused file printed answers: $3"
}
good="problem p m 1 m 1 $pose 0 nan 1\n"
refused 1 'nsvcd-problems' ''
refused 1 'nsvcd-problems' 'mesh m my.obj\n'
refused 1 'version' 'nsvcd-problems 2\n'
refused 3 "expected 'mesh' or 'problem'" "${head}meshes a b\n"
refused 3 "expected 'mesh' or 'problem'" "${head}0 0 0 0 0 0 1\n"
refused 3 'mesh NAME PATH' "${head}mesh a\n"
refused 3 'second mesh' "${head}mesh m my.obj\n"
refused 3 'no mesh of this name' "${head}problem p m 1 other 1 $pose 0 nan 1\n$pose\n"
refused 3 'expected: problem' "${head}problem p m 1 m 1 $pose 0 nan\n$pose\n"
refused 3 'expected: problem' "${head}problem p m 1 m 1 $pose 0 nan 1 1 1\n$pose\n"
refused 3 'has 1 of its 2 poses' "${head}problem p m 1 m 1 $pose 0 nan 1 1\n$pose\n"
refused 3 'FIXED_COUNT' "${head}problem p m 1 m 1 $pose 0 nan 1 0\n$pose\n"
refused 3 'scale' "${head}problem p m 0 m 1 $pose 0 nan 1\n$pose\n"
refused 3 'scale' "${head}problem p m 1 m nan $pose 0 nan 1\n$pose\n"
refused 3 'scale' "${head}problem p m 1 m 1e30 $pose 0 nan 1\n$pose\n"
refused 3 'label' "${head}problem p m 1 m 1 $pose 2 nan 1\n$pose\n"
refused 3 'label' "${head}problem p m 1 m 1 $pose 0.0 nan 1\n$pose\n"
refused 3 'margin' "${head}problem p m 1 m 1 $pose 0 inf 1\n$pose\n"
refused 3 'margin' "${head}problem p m 1 m 1 $pose 0 1mm 1\n$pose\n"
for count in 0 -1 1.5 65537 x 99999999999999999999; do
  refused 3 'COUNT' "${head}problem p m 1 m 1 $pose 0 nan $count\n$pose\n"
done
refused 3 'has 1 of its 2 poses' "${head}problem p m 1 m 1 $pose 0 nan 2\n$pose\n"
refused 3 'has 0 of its 1 poses' "$head$good$good$pose\n"
refused 5 "expected 'mesh' or 'problem'" "$head$good$pose\n$pose\n"
refused 4 'expected a pose' "${head}${good}0 0 0 0 0 1\n"
refused 4 'expected a pose' "${head}${good}0 0 0 0 0 0 1 0\n"
for number in nan inf 1e999 1e39 0,5 x 1x; do
  refused 4 'finite' "${head}${good}0 $number 0 0 0 0 1\n"
  refused 4 'finite' "${head}${good}0 0 0 0 $number 0 1\n"
done
for q in '0 0 0 0' '0 0 0 1.0002' '1 0 0 1' '0 0 0 .999'; do refused 4 'unit' "${head}${good}0 0 0 $q\n"; done
refused 3 'unit' "${head}problem p m 1 m 1 0 0 0 0 0 0 1.01 0 nan 1\n$pose\n"
refused 2 'none.obj: No such file' 'nsvcd-problems 1\nmesh m none.obj\n'
refused 2 'bad.obj:4: an index' 'nsvcd-problems 1\nmesh m bad.obj\n'
printf "$head\000" >"$dir/zero.txt"
expect 1 'zero byte' build/svcd check "$dir/zero.txt"
expect 1 'none.txt: No such file' build/svcd check "$dir/none.txt"
expect 1 "$dir: Is a directory" build/svcd check "$dir"

# A robot, from its URDF: what urdf.py writes and refuses; plans and paths, and what planning files refuse.
python3 tests/urdf_test.py 2>"$dir/err" || fail "urdf_test.py: $(cat "$dir/err")"
shelf="--srdf examples/robot/arm.srdf --scene shelf examples/robot/shelf.urdf"
# shellcheck disable=SC2086
python3 examples/robot/urdf.py examples/robot/arm.urdf $shelf "$dir/arm.txt" || fail "urdf.py"
cp "$dir/arm.txt" "$dir/robot.txt"
cat examples/robot/plans.txt >>"$dir/robot.txt"
expect 0 'stuck: the start: forearm and left_side meet' build/svcd plan "$dir/robot.txt" --samples 50 --joints "$dir/joints.tsv"
awk -F '\t' 'NF != 5 || ($1 == "stuck" ? $2 != "start" : $2 != "certified" || !($4 > 1 && $4 < 3 && $5 > 2)) { exit 1 }
  END { exit NR != 3 }' "$dir/out" || fail "svcd plan says: $(cat "$dir/out")"
# the motion as it is given out begins and ends where it is to, and is free as a path too
awk -F '\t' 'NF != 8 { exit 1 } END { exit NR != 100 }' "$dir/joints.tsv" || fail "joints.tsv"
awk '$1 == "up" && $2 == 0 { good += $3 == -2.649 && $8 == -1.057 } $1 == "up" && $2 == 49 { good += $3 == -0.493 && $8 == 0.076 }
  END { exit good != 2 }' "$dir/joints.tsv" || fail "the ends of joints.tsv"
# --threads: of three seeds the motion that takes the least time, to the last digit, whichever thread is first
for seed in 0 1 2; do
  expect 0 '' build/svcd plan "$dir/robot.txt" --seed $seed --only up,turned
  cut -f 1,2,4,5 "$dir/out" >"$dir/seed_$seed"
done
cat "$dir"/seed_[012] | sort -k1,1 -k3,3g -s | awk '!seen[$1]++' >"$dir/best"
for k in 1 2; do
  expect 0 '' build/svcd plan "$dir/robot.txt" --threads 3 --only up,turned
  cut -f 1,2,4,5 "$dir/out" | sort -k1,1 | cmp -s - "$dir/best" || fail "plans by threads: $(cat "$dir/out" "$dir/best")"
done
expect 0 '' build/svcd plan "$dir/robot.txt" --threads 2 --seconds 0.001 --only stuck
expect 2 '' build/svcd plan "$dir/robot.txt" --threads 0
{ cat "$dir/arm.txt"; echo "path given shelf 50"; awk -F '\t' '$1 == "up" { print $3, $4, $5, $6, $7, $8 }' "$dir/joints.tsv"; } >"$dir/given.txt"
expect 0 '' build/svcd path "$dir/given.txt"
grep -q '^given	free	-1	nan	-	-	' "$dir/out" || fail "the motion as a path: $(cat "$dir/out")"
expect 0 '' build/svcd path "$dir/robot.txt"
grep -q '^straight	hit	0	0[.][0-9]*	wrist_a	board_2	' "$dir/out" || fail "svcd path says: $(cat "$dir/out")"
grep -q '^aside	free	-1	nan	-	-	' "$dir/out" || fail "svcd path says: $(cat "$dir/out")"
expect 0 '' build/svcd plan "$dir/robot.txt" --only turned --clearance 0.001 --seed 7
grep -q '^turned	certified' "$dir/out" || fail "svcd plan --only says: $(cat "$dir/out")"
test "$(wc -l <"$dir/out")" = 1 || fail "--only turned: $(cat "$dir/out")"
expect 0 '' build/svcd plan "$dir/robot.txt" --only up --picture "$dir/up.svg" --film "$dir/film.svg"
grep -q '1.[0-9]* s, proven free at all times; orange: the start' "$dir/up.svg" || fail "the picture of a plan"
test "$(grep -c '<animate' "$dir/film.svg")" = 40 || fail "the film of a plan"
expect 2 "--picture: --only one plan" build/svcd plan "$dir/robot.txt" --picture "$dir/up.svg"
echo x >"$dir/other.svg"
expect 1 'is there already, and is no SVG' build/svcd plan "$dir/robot.txt" --only up --film "$dir/other.svg"
# the way out is one: planned from there it is certified
expect 0 'stuck: the start: forearm and left_side meet, 7.3[0-9] mm deep' build/svcd plan "$dir/robot.txt" --only stuck
{ cat "$dir/arm.txt"; sed -n 's/.*free near by:/plan out shelf/p' "$dir/err" | tr '\n' ' '; echo '-0.493 0.360 0.878 1.903 1.078 -2.038'; } >"$dir/way_out.txt"
expect 0 '' build/svcd plan "$dir/way_out.txt"
grep -q '^out	certified' "$dir/out" || fail "the way out: $(cat "$dir/out")"
# all are decided: those that meet sometimes are asked, and the others proven
expect 0 '' build/svcd pairs "$dir/robot.txt"
grep -q unknown "$dir/out" && fail "svcd pairs leaves open: $(cat "$dir/out")"
for line in '# always base shoulder: proven' '# never base upper_arm: proven' 'pair base forearm  # sometimes free at .* hit at .*'; do
  grep -qx "$line" "$dir/out" || fail "svcd pairs does not say $line: $(cat "$dir/out")"
done
# Goals as poses of a body: the motion is certified, and ends where the body is there, in all the places a region allows,
# or at a goal by joints. What cannot be reached, or is reached in contact alone, is told.
start='-2.649 -0.708 -1.763 2.470 1.078 -1.057'
there=$(python3 tests/place.py "$dir/arm.txt" palm -0.493 0.360 0.877 1.905 1.078 0.076)
{ cat "$dir/arm.txt"
  printf "plan posed shelf $start\\ngoal posed pose $there palm\\nplan spun shelf $start\\nplan boxed shelf $start\\n"
  printf "goal boxed pose $there palm box 0.05 0.05 0\\ngoal spun pose $there palm free z\\n"
  printf "plan two shelf $start 0.5 1.2 0.3 0 0 0\\ngoal two pose 9 0 0 0 0 0 1 palm\\ngoal two -0.493 0.360 0.878 1.903 1.078 -2.038\\n"
  printf "plan far shelf $start\\ngoal far pose 5 0 0 0 0 0 1 palm\\nplan low shelf $start\\ngoal low pose 0.5 0 0.05 0 0 0 1 palm\\n"
} >"$dir/poses.txt"
expect 0 'far: the goal: out of reach: palm is [0-9.]* mm and [0-9.]* degrees off, at best' build/svcd plan "$dir/poses.txt" --samples 2 --joints "$dir/poses.tsv"
test "$(cut -f 1,2 "$dir/out" | tr '\t\n' '  ')" = 'posed certified spun certified boxed certified two certified far goal low goal ' || fail "goals by poses: $(cat "$dir/out")"
grep -q 'low: the goal: palm is there only in configurations that are not free' "$dir/err" || fail "a goal in contact: $(cat "$dir/err")"
grep -q 'low: the goal: palm and board_1 meet, [0-9.]* mm deep' "$dir/err" || fail "what a goal in contact meets: $(cat "$dir/err")"
end_of() { # ID: where palm is at the end of its motion, and then where it was to be
  # shellcheck disable=SC2046
  python3 tests/place.py "$dir/arm.txt" palm $(awk -v id="$1" '$1 == id && $2 == 1 { for (k = 3; k <= 8; k++) print $k }' "$dir/poses.tsv")
  echo "$there"
}
end_of posed | awk '{ for (k = 1; k <= 7; k++) p[NR, k] = $k }
  END { s = p[1, 7] * p[2, 7] < 0 ? -1 : 1
    for (k = 1; k <= 7; k++) { d = p[1, k] - (k > 3 ? s : 1) * p[2, k]; if (d > 1e-6 || d < -1e-6) exit 1 } }' || fail "posed ends at $(end_of posed)"
end_of spun | awk '{ for (k = 1; k <= 3; k++) p[NR, k] = $k; z[NR, 1] = 2 * ($4 * $6 + $5 * $7); z[NR, 2] = 2 * ($5 * $6 - $4 * $7); z[NR, 3] = 1 - 2 * ($4 * $4 + $5 * $5) }
  END { for (k = 1; k <= 3; k++) { d = p[1, k] - p[2, k]; e = z[1, k] - z[2, k]; if (d * d > 1e-12 || e * e > 1e-11) exit 1 } }' || fail "spun ends at $(end_of spun)"
awk '$1 == "two" && $2 == 1 { good = $4 == 0.360 && $8 == -2.038 } END { exit !good }' "$dir/poses.tsv" || fail "a goal by joints: $(cat "$dir/poses.tsv")"
# A pin on a turning arm, in a ring that has a slot: it separates from the ring there, in a hundredth of its joint's
# range, which no sample hits. What pairs prints into the file leaves nothing out: the pin in the ring is no goal.
awk 'function point(a, r, z) { printf "v %.6f %.6f %g\n", r * cos(a), r * sin(a), z }
  function side(k, l) { printf "f %d %d %d %d\n", 4 * i + l, 4 * i + 4 + l, 4 * i + 4 + k, 4 * i + k }
  BEGIN { n = 120; slot = 0.05
    for (i = 0; i <= n; i++) { a = slot + (6.283185307 - 2 * slot) * i / n
      point(a, 0.29, -0.01); point(a, 0.29, 0.01); point(a, 0.31, -0.01); point(a, 0.31, 0.01) }
    for (i = 0; i < n; i++) { side(1, 2); side(2, 4); side(4, 3); side(3, 1) }
    print "f 1 2 4 3"; printf "f %d %d %d %d\n", 4 * n + 1, 4 * n + 3, 4 * n + 4, 4 * n + 2 }' >"$dir/ring.obj"
{ for x in 0.28 0.32; do for y in -0.012 0.012; do for z in -0.02 0.02; do echo "v $x $y $z"; done; done; done
  printf 'f %s\n' '1 2 4 3' '5 7 8 6' '1 5 6 2' '3 4 8 7' '1 3 7 5' '2 6 8 4'; } >"$dir/pin.obj"
turned='joint j world 0 0 0 0 0 0 1 0 0 1 revolute -3.1 3.1 1\nbody ring world ring.obj\nbody pin j pin.obj'
printf "nsvcd-plans 1\n$turned\n" >"$dir/slot.txt"
expect 0 '' build/svcd pairs "$dir/slot.txt"
grep -q '^pair ring pin  # sometimes free at .* hit at ' "$dir/out" || fail "svcd pairs of the slot: $(cat "$dir/out")"
{ cat "$dir/slot.txt" "$dir/out"; printf 'scene s\nplan in s -0.005 0.005\nplan out s 0 1.5\n'; } >"$dir/slot_plan.txt"
expect 0 'out: the goal: ring and pin meet' build/svcd plan "$dir/slot_plan.txt"
test "$(cut -f 1,2 "$dir/out" | tr '\t\n' '  ')" = 'in certified out goal ' || fail "plans by pairs: $(cat "$dir/out")"
# A cube on slides in a hollow one, whose goal is in another one, ends by time; what is planned before is there to be
# read while it is sought. A scene that is not asked about may lack its mesh.
{ for x in -1 1; do for y in -1 1; do for z in -1 1; do echo "v $x $y $z"; done; done; done
  printf 'f %s\n' '1 2 4 3' '5 7 8 6' '1 5 6 2' '3 4 8 7' '1 3 7 5' '2 6 8 4'; } >"$dir/solid.obj"
awk '$1 == "v" { print "v", 0.9 * $2, 0.9 * $3, 0.9 * $4; next } { print }' "$dir/solid.obj" >"$dir/cube.obj"
{ awk '$1 == "v" { print "v", 1.1 * $2, 1.1 * $3, 1.1 * $4; next } { print }' "$dir/solid.obj"
  awk '$1 == "f" { print "f", $5 + 8, $4 + 8, $3 + 8, $2 + 8; next } { print }' "$dir/solid.obj"; } >"$dir/closed.obj"
slide='prismatic -9 9 1\njoint'
{ printf "nsvcd-plans 1\njoint x world 0 0 0 0 0 0 1 1 0 0 $slide y x 0 0 0 0 0 0 1 0 1 0 $slide z y 0 0 0 0 0 0 1 0 0 1 prismatic -9 9 1\n"
  printf 'body cube z cube.obj\nscene open\nobstacle far closed.obj 5 0 0 0 0 0 1\nplan quick open 0 0 0 1 0 0\n'
  printf 'scene rooms\nobstacle a closed.obj 0 0 0 0 0 0 1\nobstacle b closed.obj 4 0 0 0 0 0 1\nplan shut rooms 0 0 0 4 0 0\n'
  printf 'scene other\nobstacle none none.obj 0 0 0 0 0 0 1\nplan lacks other 0 0 0 1 0 0\n'; } >"$dir/rooms.txt"
expect 1 'rooms.txt:14: .*none.obj: No such file' build/svcd plan "$dir/rooms.txt" --only lacks
expect 0 ': 2 meshes encoded' build/svcd plan "$dir/rooms.txt" --only quick,shut --seconds 0.1
test "$(cut -f 1,2 "$dir/out" | tr '\t\n' '  ')" = 'quick certified shut limit ' || fail "plans with --seconds: $(cat "$dir/out")"
build/svcd plan "$dir/rooms.txt" --only quick,shut --seconds 1e6 >"$dir/flushed" 2>"$dir/err" &
touch "$dir/flushed"
until grep -q '^quick	certified' "$dir/flushed" || ! kill -0 $! 2>"$dir/none"; do sleep 0.1; done
grep -q shut "$dir/flushed" && fail "the first plan is told with the last: $(cat "$dir/flushed")"
kill $! 2>"$dir/none"
wait $! 2>"$dir/none"
expect 2 'not a number in' build/svcd plan "$dir/rooms.txt" --seconds 0
for command in plan path pairs; do json $command "$dir/robot.txt"; done
robot_refused() {  # TEXT LINE: a planning file that ends in this line is refused with this text, and its line is named
  { cat "$dir/arm.txt"; echo "plan p shelf 0 0 0 0 0 0 0 0 0 0 0 0"; printf '%b\n' "$2"; } >"$dir/bad_robot.txt"
  expect 1 "bad_robot.txt:$(wc -l <"$dir/bad_robot.txt"): $1" build/svcd plan "$dir/bad_robot.txt"
}
robot_refused "no scene of this name" 'plan x nowhere 0 0 0 0 0 0 0 0 0 0 0 0'
robot_refused "expected: plan ID SCENE, then 6 joints" 'plan x shelf 0 0 0 0 0'
robot_refused "plan x has no goal" 'plan x shelf 0 0 0 0 0 0'
robot_refused "no plan of this ID above: 'x'" 'goal x 0 0 0 0 0 0'
robot_refused "expected: goal ID pose .*, or goal ID and 6 joints" 'goal p 0 0 0 0 0'
robot_refused "expected: goal ID pose .*, or goal ID and 6 joints" 'goal p pose 0 0 0 0 0 0 1'
robot_refused "not a finite number" 'goal p 0 0 0 0 0 nan'
robot_refused "not a finite number" 'goal p pose 0 0 nan 0 0 0 1 palm'
robot_refused "the quaternion is not of unit length" 'goal p pose 0 0 0 0 0 0 2 palm'
robot_refused "no body of this name: 'thumb'" 'goal p pose 0 0 0 0 0 0 1 thumb'
robot_refused "this body follows no joint: 'board_1'" 'goal p pose 0 0 0 0 0 0 1 board_1'
robot_refused "this body follows no joint: 'base'" 'goal p pose 0 0 0 0 0 0 1 base'
robot_refused "expected: allow NAME NAME" 'allow palm'
robot_refused "no body of this name above: 'thumb'" 'allow palm thumb'
robot_refused "a distance is negative: '-1'" 'allow palm board_1 -1'
robot_refused "expected: attach NAME JOINT" 'attach board_1'
robot_refused "no obstacle of this name above: 'palm'" 'attach palm wrist'
robot_refused "no joint of this name above, nor world: 'thumb'" 'attach board_1 thumb'
robot_refused "expected: release NAME" 'release'
robot_refused "expected: keep NAME x|y|z X Y Z DEGREES" 'keep palm z 0 0 1'
robot_refused "expected: keep NAME x|y|z X Y Z DEGREES" 'keep palm up 0 0 1 5'
robot_refused "no body of this name above: 'thumb'" 'keep thumb z 0 0 1 5'
robot_refused "this body follows no joint: 'base'" 'keep base z 0 0 1 5'
robot_refused "not a finite number, or beyond NSVCD_MAX_COORDINATE: 'nan'" 'keep palm z 0 0 nan 5'
robot_refused "the direction has no length" 'keep palm z 0 0 0 5'
for degrees in 0 -1 180 nan; do
  robot_refused "DEGREES are not 0.01 or more, and less than 180: '$degrees'" "keep palm z 0 0 1 $degrees"
done

# A cup is taken from its table, over a rack, and set down: it touches the table there, and nothing on its way.
expect 0 '' build/svcd plan examples/robot/pick.txt --samples 500 --joints "$dir/pick.tsv"
test "$(cut -f 1,2 "$dir/out" | tr '\t\n' '  ')" = 'reach certified grip certified carry certified open certified away certified ' ||
  fail "a cup is taken: $(cat "$dir/out" "$dir/err")"
awk '$1 == "carry" { above = $5 + 0.515; x = $3 < 0 ? -$3 : $3; y = $4 < 0 ? -$4 : $4
    if (x < 0.0895 && y < 0.1895 && above < 0.25) bad = bad " in the rack at " $2
    if (above < -1e-6) bad = bad " in the table at " $2
    dx = $3 + ($2 < 250 ? 0.3 : -0.3); dy = $4 + ($2 < 250 ? -0.1 : 0.2)
    if (dx * dx + dy * dy > 0.005 ^ 2 && above <= 0) bad = bad " slides at " $2
    if ($7 != -0.0007) bad = bad " lets go at " $2
    end = $3 - 0.3 < 1e-5 && 0.3 - $3 < 1e-5 && above < 1e-5 && above > -1e-5 }
  END { if (bad || !end) { print bad; exit 1 } }' "$dir/pick.tsv" >"$dir/out" || fail "a cup is carried: $(head -c 300 "$dir/out")"
sed 's/^allow cup table//' examples/robot/pick.txt >"$dir/no_allow.txt"
expect 1 'carry: the start: table and cup meet' build/svcd plan "$dir/no_allow.txt"
expect 1 'open: not asked: it starts where no plan above has ended' build/svcd plan examples/robot/pick.txt --only open
sed 's/^plan open.*/plan open kitchen 0 0 0 0 0/' examples/robot/pick.txt >"$dir/late.txt"
expect 1 'what was attached above is not known' build/svcd plan "$dir/late.txt" --only open
# a jaw that reaches into the palm: allowed above the scenes it is so in all, and without that line no start is free
sed 's/^scene/pair palm left_jaw\nallow palm left_jaw 0.1\nscene/; s/^body left_jaw.*/body left_jaw jaw box: 0.02 0.01 0.03  pose 0 0 0.0325 0 0 0 1/' examples/robot/pick.txt >"$dir/jaw.txt"
expect 0 '' build/svcd plan "$dir/jaw.txt" --only reach
sed 's/^allow palm.*//' "$dir/jaw.txt" >"$dir/no_jaw.txt"
expect 0 'reach: the start: palm and left_jaw meet' build/svcd plan "$dir/no_jaw.txt" --only reach
# its certificates are accepted, and what is forged of them is not
expect 0 '' python3 tests/forge.py
for words in 'allow cup' 'allow cup table -1' 'allow cup thumb' 'attach cup' 'attach cup thumb' 'attach thumb turn' 'release cup turn'; do
  sed "s/^attach cup turn/$words/" examples/robot/pick.txt >"$dir/bad_step.txt"
  expect 2 'bad_step.txt: ' build/verify "$dir/bad_step.txt" "$dir"
done
sed 's/^scene kitchen/release cup\n&/' examples/robot/pick.txt >"$dir/bad_step.txt"
expect 2 'not where it may stand' build/verify "$dir/bad_step.txt" "$dir"
# An arm of three joints in a plane, whose hand tilts by their sum, about a ball that stands in the straight way: what is kept
# is, also of a cup that is attached, until it is released; so a certificate says, of the hand, and of no smaller angle.
tilts() {  # LINES above the scene, LINES in it
  printf 'nsvcd-plans 1\njoint a world 0 0 0.3 0 0 0 1 0 1 0 revolute -2 2 1\njoint b a 0 0 0.4 0 0 0 1 0 1 0 revolute -2.5 2.5 1\n'
  printf 'joint c b 0 0 0.4 0 0 0 1 0 1 0 revolute -2.5 2.5 1\nbody upper a box: 0.05 0.05 0.3 pose 0 0 0.2 0 0 0 1\n'
  printf 'body fore b box: 0.04 0.04 0.3 pose 0 0 0.2 0 0 0 1\nbody hand c box: 0.04 0.04 0.04 pose 0 0 0.03 0 0 0 1\n%b' "$1"
  printf 'scene s\nobstacle ball sphere: 0.1  0 0 1.1 0 0 0 1\nobstacle cup cylinder: 0.03 0.1  -0.5284 0 0.987 0 0 0 1\n%b' "$2"
}
way='-1 0.5 0.5  1 -0.5 -0.5\n'
dip='path dip s 3\n-1 0.5 0.5\n-1.1 0.5 0.6\n-1.1 0.5 0.9\n'
tilts '' "keep cup z 0 0 2 10\nattach cup c\nplan carry s $way${dip}plan tilted s -1 0.5 0.75 1 -0.5 -0.5\ngoal tilted 1 -0.5 -0.25\nrelease cup\nplan empty s -1 0.5 0.75 1 -0.5 -0.2\n" >"$dir/tilt.txt"
expect 0 'tilted: the start: cup is 14.3[0-9]* degrees off, and is to keep within 10' build/svcd plan "$dir/tilt.txt" --samples 500 --joints "$dir/tilt.tsv"
grep -q 'tilted: the start: free near by' "$dir/err" || fail "no way out of a tilt: $(cat "$dir/err")"
test "$(cut -f 1,2 "$dir/out" | tr '\t\n' '  ')" = 'carry certified tilted start empty certified ' || fail "a cup is kept upright: $(cat "$dir/out")"
awk '$1 == "carry" { tilt = $3 + $4 + $5; if (tilt * tilt > 0.174533 ^ 2) bad = bad " " $2 } END { if (bad) print bad; exit bad != "" }' "$dir/tilt.tsv" ||
  fail "the cup tilts: $(tail -1 "$dir/tilt.tsv")"
expect 0 '' build/svcd path "$dir/tilt.txt"
cut -f 2,3,5,6 "$dir/out" | grep -qx 'hit	1	cup	keep' || fail "the cup dips: $(cat "$dir/out")"
expect 0 '' build/svcd path "$dir/tilt.txt" --json
line '"verdict": "hit", "edge": 1, .*"a": "cup", "b": "keep"'
for place in above in; do
  kept='keep hand z 0 0 1 8\n'
  test $place = in || { tilts "$kept" "plan go s $way" && printf 'scene other\nplan far other -1 0.5 0.5 -1 0.5 0.9\n'; } >"$dir/tilt.txt"
  test $place = above || { tilts '' "plan free s -1 0.5 0.9 -1 0.5 1.2\n${kept}plan go s $way" && printf 'scene other\nplan far other -1 0.5 0.5 -1 0.5 0.9\n'; } >"$dir/tilt.txt"
  rm -rf "$dir/tilt"
  mkdir "$dir/tilt"
  build/svcd plan "$dir/tilt.txt" --certificates "$dir/tilt" >"$dir/out" 2>"$dir/err"
  test $place = above && expected='go certified far goal ' || expected='free certified go certified far certified '
  test "$(cut -f 1,2 "$dir/out" | tr '\t\n' '  ')" = "$expected" || fail "keep $place the scene: $(cat "$dir/out" "$dir/err")"
  expect 0 '' build/verify "$dir/tilt.txt" "$dir/tilt" --only go,free$(test $place = above || echo ,far)
  for other in 'z 0 0 1 0.05' 'z 0 0 -1 179.95' 'x 0 0 1 8' 'z 0.2 0 1 8'; do
    sed "s/^keep hand.*/keep hand $other/" "$dir/tilt.txt" >"$dir/other_tilt.txt"
    expect 1 '' build/verify "$dir/other_tilt.txt" "$dir/tilt" --only go
    line 'refused	an axis leaves what it is to keep'
  done
done
robot_refused "expected 'free x|y|z' or 'box HX HY HZ', each once: 'free'" 'goal p pose 0 0 0 0 0 0 1 palm free w'
robot_refused "expected .*, each once: 'free'" 'goal p pose 0 0 0 0 0 0 1 palm free x free y'
robot_refused "expected .*, each once: 'box'" 'goal p pose 0 0 0 0 0 0 1 palm box 0 0'
robot_refused "half a side is negative, or too large: '-1'" 'goal p pose 0 0 0 0 0 0 1 palm box 0 0 -1'
robot_refused "not a finite number" 'plan x shelf 0 0 0 0 0 0 0 0 0 0 0 nan'
robot_refused "a second scene of this name" 'scene shelf'
robot_refused "a joint after the first scene" 'joint x world 0 0 0 0 0 0 1 0 0 1 revolute -1 1 1'
printf 'nsvcd-plans 1\njoint world world 0 0 0 0 0 0 1 0 0 1 revolute -1 1 1\n' >"$dir/named.txt"
expect 1 'named.txt:2: a joint of the name world' build/svcd plan "$dir/named.txt"
robot_refused "the quaternion is not of unit length" 'obstacle x shelf_shelf_floor.obj 0 0 0 0 0 0 2'
robot_refused "a second body of this name" 'obstacle palm arm_shelf_floor.obj 0 0 0 0 0 0 1'
robot_refused "expected 'scale SX SY SZ', once: 'x'" 'obstacle x arm_shelf_floor.obj 0 0 0 0 0 0 1 x'
robot_refused "expected 'scale SX SY SZ', once: 'pose'" 'obstacle x arm_shelf_floor.obj 0 0 0 0 0 0 1 pose 0 0 0 0 0 0 1'
robot_refused "expected 'scale SX SY SZ', once: 'scale'" 'obstacle x arm_shelf_floor.obj 0 0 0 0 0 0 1 scale 1 1'
robot_refused "a scale, or minus one, is not in 1e-6..1e6: '0'" 'obstacle x arm_shelf_floor.obj 0 0 0 0 0 0 1 scale 1 0 1'
robot_refused "obstacle x: $dir/none.obj: No such file" 'obstacle x none.obj 0 0 0 0 0 0 1 scale 1 1 1'
for words in 'pose 0 0 0 0 0 0' 'scale 1 1 1 scale 1 1 1' 'pose 0 0 0 0 0 0 1 pose 0 0 0 0 0 0 1' 'scale 1 1 nan' 'scale 1 1 1e7'; do
  printf 'nsvcd-plans 1\nbody a world one.obj %s\n' "$words" >"$dir/words.txt"
  expect 1 'words.txt:2: ' build/svcd plan "$dir/words.txt"
  expect 2 'words.txt: ' build/verify "$dir/words.txt" "$dir"
done
robot_refused "expected 'joint', 'mimic', 'body'" 'link x'
{ cat "$dir/arm.txt"; printf 'path x shelf 2\n0 0 0 0 0 0\n1 1\n'; } >"$dir/bad_robot.txt"
expect 1 "path x has 1 of its 2 lines of 6 joints" build/svcd path "$dir/bad_robot.txt"
printf 'nsvcd-plans 1\njoint a a 0 0 0 0 0 0 1 0 0 1 revolute -1 1 1\n' >"$dir/cycle.txt"
expect 1 "cycle.txt:2: no joint of this name above, nor world: 'a'" build/svcd plan "$dir/cycle.txt"
printf 'nsvcd-plans 1\njoint a world 0 0 0 0 0 0 1 0 0 1 revolute 1 -1 1\n' >"$dir/cross.txt"
expect 1 'cross.txt:2: LOW is above HIGH' build/svcd plan "$dir/cross.txt"
printf 'nsvcd-plans 1\njoint a world 0 0 0 0 0 0 1 0 0 0 revolute -1 1 1\nscene s\nplan x s 0 0\n' >"$dir/axis.txt"
expect 1 'axis.txt: scene s: ' build/svcd plan "$dir/axis.txt"
expect 2 'together with --joints' build/svcd plan "$dir/robot.txt" --samples 5
expect 2 'ends in .tsv' build/svcd plan "$dir/robot.txt" --samples 5 --joints "$dir/x.txt"
# STL, as OBJ
printf 'solid a\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n' >"$dir/one.STL"
expect 0 '' build/svcd info "$dir/one.STL"
grep -q 'an STL: 1 triangle, 3 vertices' "$dir/out" || fail "svcd info of an STL: $(cat "$dir/out")"

# The certificates that svcd writes, verify accepts, which reads the files and meshes by itself: free, hit, inside,
# near; faces of many corners, STL; a sweep; plans of a robot. And what it refuses, it names.
mkdir "$dir/certs"
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv .5 .2 0\nv 0 1 0\nv 0 0 .1\nv 1 0 .1\nv 1 1 .1\nv .5 .2 .1\nv 0 1 .1\nf 5 4 3 2 1\nf 6 7 8 9 10\nf 1 2 7 6\nf 2 3 8 7\nf -8 -7 -2 -3\nf -7 -6 -1 -2\nf 5 1 6 10\n' >"$dir/arrow.obj"
{ echo 'nsvcd-problems 1'; for mesh in mug dish_rack; do echo "mesh $mesh $PWD/examples/assets/$mesh.obj"; done
  echo "mesh arrow arrow.obj"; echo "mesh one one.STL"
  echo "problem high mug 1 dish_rack 1  0 0 0 0 0 0 1  0 nan 2"; echo "0 -0.4 0.3 0 0 0 1"; echo "0 0.4 0.3 0 0 0.6 0.8"
  echo "problem low mug 1 dish_rack 1  0 0 0 0 0 0 1  1 nan 2"; echo "0 -0.4 0.3 0 0 0 1"; echo "0 0 0 0 0 0 1"
  echo "problem within mug 0.05 arrow 1  0 0 0 0 0 0 1  1 nan 1"; echo "0.2 0.1 0.05 0 0 0 1"
  echo "problem notch one 0.1 arrow 1  0 0 0 0 0 0 1  0 nan 2 2"; echo "0.45 0.5 0.05 0 0 0 1"; echo "0.45 0.6 0.05 0 0 1 0"
  echo "0 0 0 0 0 0 1"; echo "0 0.1 0 0 0 0 1"
} >"$dir/proofs.txt"
expect 0 'certificates: 4, of 4 answers' build/svcd check "$dir/proofs.txt" --certificates "$dir/certs"
expect 0 '' build/verify "$dir/proofs.txt" "$dir/certs"
for line in 'high free' 'low hit' 'within inside' 'notch free'; do
  awk -F '\t' -v id="${line% *}" -v kind="${line#* }" '$1 == id && $2 == "accepted" && $3 == kind && $4 > 5 && NF == 5 { found++ }
    END { exit found != 1 }' "$dir/out" || fail "verify of $line says: $(cat "$dir/out")"
done
# The claims of what is accepted: by Python's hashlib, from the bytes that nsvcd_verify_claim.h describes; of others nothing.
expect 0 '' build/verify "$dir/proofs.txt" "$dir/certs" --claims --only high,low
python3 - "$dir/out" examples/assets <<'END' || fail "claims: $(cat "$dir/out")"
import hashlib, struct, sys
def mesh(name):
    rows = [line.split() for line in open(f"{sys.argv[2]}/{name}.obj")]
    corners = [float(x) for row in rows if row[:1] == ["v"] for x in row[1:4]]
    faces = [int(x.split("/")[0]) - 1 for row in rows if row[:1] == ["f"] for x in row[1:]]
    return hashlib.sha256(b"nsvcd mesh 1" + struct.pack(f"<II{len(corners)}f{len(faces)}I", len(corners) // 3, len(faces) // 3,
                                                        *corners, *faces)).digest()
def claim(end):
    return hashlib.sha256(b"nsvcd claim 1" + struct.pack("<f", 0) +
                          mesh("mug") + struct.pack("<fBIB14f", 1, 1, 2, 0, 0, -0.4, 0.3, 0, 0, 0, 1, *end) +
                          mesh("dish_rack") + struct.pack("<fBIB7f", 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 1)).hexdigest()
told = {line.split("\t")[0]: line.rstrip("\n").split("\t")[5] for line in open(sys.argv[1])}
sys.exit(told != {"high": claim((0, 0.4, 0.3, 0, 0, 0.6, 0.8)), "low": claim((0, 0, 0, 0, 0, 0, 1))})
END
expect 1 '' build/verify "$dir/proofs.txt" "$dir/certs" --clearance 0.001
test "$(grep -c '	refused	it is about another motion, scale or clearance, at byte 5	' "$dir/out")" = 4 || fail "another clearance: $(cat "$dir/out")"
sed 's/0 -0.4 0.3 0/0 -0.4 0.31 0/' "$dir/proofs.txt" >"$dir/moved.txt"
expect 1 '' build/verify "$dir/moved.txt" "$dir/certs"
test "$(grep -c '	refused	it is about another motion' "$dir/out")" = 2 || fail "another motion: $(cat "$dir/out")"
cp "$dir/certs/high.cert" "$dir/certs/low.cert"
expect 1 '' build/verify "$dir/proofs.txt" "$dir/certs"
rm "$dir/certs/low.cert"
expect 1 '' build/verify "$dir/proofs.txt" "$dir/certs"
grep -q '^low	refused	there is no certificate	' "$dir/out" || fail "no certificate: $(cat "$dir/out")"
expect 0 '' build/svcd check "$dir/proofs.txt" --certificates "$dir/certs" --clearance 0.02
expect 0 '' build/verify "$dir/proofs.txt" "$dir/certs" --clearance 0.02
expect 0 '' build/svcd sweep "$PWD/examples/assets/mug.obj" "$PWD/examples/assets/dish_rack.obj" --rotate z,100 --certificate "$dir/sweep.cert"
expect 0 '' build/verify "$dir/sweep.txt" "$dir"
cp "$dir/sweep.txt" "$dir/zero" && printf '\0' >>"$dir/zero"
for wrong in '' "$dir/none.txt $dir" "$dir/sweep.cert $dir" "examples/assets/mug.obj $dir" "/dev/null $dir" "$dir/zero $dir"; do
  # shellcheck disable=SC2086
  expect 2 'FOLDER holds the proofs' build/verify $wrong
done
expect 0 '' build/verify "$dir/sweep.txt" "$dir"
grep -q '^sweep	accepted	hit	' "$dir/out" || fail "a sweep's certificate: $(cat "$dir/out")"
expect 2 'ends in .cert' build/svcd sweep a.obj b.obj --certificate x.txt
expect 1 'unproven.cert: not written' build/svcd sweep "$PWD/examples/assets/mug.obj" "$PWD/examples/assets/dish_rack.obj" \
  --from 0,-0.4,0.16 --to 0,0.4,0.16 --rotate z,90 --certificate "$dir/unproven.cert" --visits 1
grep -q certificate "$dir/out" && fail "a certificate that is none: $(cat "$dir/out")"
expect 2 'nor with --skin' build/svcd check "$dir/proofs.txt" --certificates "$dir/certs" --skin 0.001
# a certificate that is asked for and not made is no success
expect 1 'certificates: [0-3] written, of 4 answers' build/svcd check "$dir/proofs.txt" --certificates "$dir/certs" --visits 1
build/svcd check "$dir/proofs.txt" --certificates "$dir/certs" >/dev/null 2>&1
# Who asks one question waits for its answer: a shaft that turns in a bore, 50 um wider, takes more work than usual.
awk -v pi=3.14159265358979 'BEGIN {
  for (bore = 0; bore < 2; bore++) {
    file = ARGV[1] (bore ? "/bore.obj" : "/shaft.obj")
    inner = bore ? 10.05 / cos(pi / 48) : 0
    for (k = 0; k < 48; k++) {
      a = 2 * pi * k / 48; x = cos(a); y = sin(a); outer = bore ? 20 : 10; z = bore ? 20 : 30
      printf "v %.9g %.9g %g\nv %.9g %.9g %g\n", outer * x, outer * y, -z, outer * x, outer * y, z > file
      printf "v %.9g %.9g %g\nv %.9g %.9g %g\n", inner * x, inner * y, -z, inner * x, inner * y, z > file
    }
    for (k = 0; k < 48; k++) {
      i = 4 * k; j = 4 * ((k + 1) % 48)
      printf "f %d %d %d %d\nf %d %d %d %d\n", i + 1, j + 1, j + 2, i + 2, i + 2, j + 2, j + 4, i + 4 > file
      printf "f %d %d %d %d\n", i + 1, i + 3, j + 3, j + 1 > file
      if (bore) printf "f %d %d %d %d\n", i + 3, i + 4, j + 4, j + 3 > file
    }
  }
}' "$dir"
turn="build/svcd sweep $dir/shaft.obj $dir/bore.obj --scale 0.001 --from 0,0,0 --rotate z,90 --repeat 1 --exit-code"
expect 0 '' $turn --seconds 100
expect 3 '' $turn --work 1000
grep -q 'more work than --work or --seconds' "$dir/out" || fail "why nothing is decided: $(cat "$dir/out")"
expect 1 'No such file' build/svcd check "$dir/proofs.txt" --certificates "$dir/no folder"
expect 2 'FILE.txt FOLDER' build/verify
expect 2 'FILE.txt FOLDER' build/verify "$dir/proofs.txt" "$dir/certs" --only
expect 2 'FILE.txt FOLDER' build/verify "$dir/proofs.txt" "$dir/certs" --none 1
expect 2 'none of these' build/verify "$dir/proofs.txt" "$dir/certs" --only none
printf 'nsvcd-problems 1\nmesh m bad_index.obj\n' >"$dir/bad_index.txt"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n' >"$dir/bad_index.obj"
expect 2 'none.txt: No such file' build/verify "$dir/none.txt" "$dir"
expect 2 'index out of range\|index is out of range' build/verify "$dir/bad_index.txt" "$dir"
printf 'v 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >"$dir/bad_index.obj"
expect 2 'fewer than three numbers' build/verify "$dir/bad_index.txt" "$dir"
printf 'solid\nvertex 0 0 0 0\nvertex 1 0 0 0\nvertex 0 1 0 0\nvertex 0 0 1\nvertex 1 0 1\nvertex 0 1 1\nendsolid\n' >"$dir/bad_index.stl"
printf 'nsvcd-problems 1\nmesh m bad_index.stl\n' >"$dir/bad_index.txt"
expect 2 'other than three numbers' build/verify "$dir/bad_index.txt" "$dir"
for number in nan NaN inf -INF 'nan(0)' 1e39; do
  printf 'nsvcd-problems 1\nmesh m cube.obj\nproblem x m 1 m 1 0 0 0 0 0 0 1 -1 nan 1\n%s 0 0 0 0 0 1\n' "$number" >"$dir/bad_number.txt"
  expect 2 'a number is none' build/verify "$dir/bad_number.txt" "$dir"
done
# As svcd, no other version, count or second mesh of a name; STL is what ends in stl, which rust1 does not.
cp "$dir/cube.obj" "$dir/rust1"
while read -r fault mesh version counts; do
  printf 'nsvcd-problems %s\nmesh m cube.obj\nmesh %s rust1\nproblem x m 1 m 1 0 0 0 0 0 0 1 -1 nan %s\n0 0 0 0 0 0 1\n' $version $mesh "$counts" >"$dir/bad_count.txt"
  expect 2 "$fault" build/verify "$dir/bad_count.txt" "$dir"
done <<'END'
version n 2 1
name m 1 1
COUNT n 1 1a
COUNT n 1 +1
COUNT n 1 1 0
COUNT n 1 65537
END
printf 'nsvcd-problems 1\nmesh n rust1\nproblem x n 1 n 1 0 0 0 0 0 0 1 -1 nan 1\n0 0 0 0 0 0 1\n' >"$dir/bad_count.txt"
expect 1 '' build/verify "$dir/bad_count.txt" "$dir"
# what is not certified, or takes more steps than are allowed, has none; the other plans are answered
echo old >"$dir/certs/stuck.cert"
echo old >"$dir/certs/up.cert"
expect 1 'stuck.cert: not written: no motion is certified' build/svcd plan "$dir/robot.txt" --certificates "$dir/certs" --visits 1
grep -q 'up: no certificate for .* and .*: undecided, for want of --visits' "$dir/err" || fail "no --visits: $(cat "$dir/err")"
test "$(cut -f 1,2 "$dir/out" | tr '\t\n' '  ')" = 'up certified turned certified stuck start ' || fail "plans with --visits 1: $(cat "$dir/out")"
ls "$dir/certs" | grep -q 'up\|stuck\|turned' && fail "certificates that are none: $(ls "$dir/certs")"
expect 0 '' build/svcd plan "$dir/robot.txt" --only up,turned --certificates "$dir/certs"
for plan in up turned; do
  grep -q "$plan.cert: certificates of 80 pairs, $(($(wc -c <"$dir/certs/$plan.cert"))) bytes" "$dir/err" || fail "the bytes of $plan.cert: $(cat "$dir/err")"
done
expect 1 '' build/verify "$dir/robot.txt" "$dir/certs"
test "$(grep -c '	accepted	free	' "$dir/out")" = 2 || fail "plans: $(cat "$dir/out")"
grep -q '^stuck	refused	there is no certificate	' "$dir/out" || fail "a plan without one: $(cat "$dir/out")"
# goals by poses: each motion ends at one of them, to two micrometres
expect 0 '' build/svcd plan "$dir/poses.txt" --only posed,spun,boxed,two --certificates "$dir/certs"
expect 0 '' build/verify "$dir/poses.txt" "$dir/certs" --only posed,spun,boxed,two
test "$(grep -c '	accepted	free	' "$dir/out")" = 4 || fail "goals by poses: $(cat "$dir/out")"
not_that_goal() {  # ID SED: a planning file of which the motion of this plan ends elsewhere
  sed "$2" "$dir/poses.txt" >"$dir/other_poses.txt"
  expect 1 '' build/verify "$dir/other_poses.txt" "$dir/certs" --only "$1"
  grep -q "^$1	refused	its motion has another start or goal" "$dir/out" || fail "another goal: $2: $(cat "$dir/out")"
}
not_that_goal posed "/^goal posed/s/pose [^ ]*/pose 0.50971/"
not_that_goal posed "/^goal posed/s/[^ ]* palm/-0.02706 palm/"
not_that_goal posed "s/^goal posed.*/plan posed shelf $start\\n&/"
not_that_goal spun '/^goal spun/s/free z/free y/'
not_that_goal boxed '/^goal boxed/s/box .*/box 0 0 0/'
not_that_goal two '/^goal two/s/ -2.038/ -2.037/'
not_of_a_plan() {  # TEXT SED: a planning file that verify does not take, whatever certificates there are
  sed "$2" "$dir/robot.txt" >"$dir/other_robot.txt"
  cmp -s "$dir/robot.txt" "$dir/other_robot.txt" && fail "the same planning file: $2"
  expect 2 "$1" build/verify "$dir/other_robot.txt" "$dir/certs"
}
first=$(grep '^obstacle' "$dir/robot.txt" | head -1 | sed 's,/,.,g')
not_of_a_plan 'not where it may stand' "/^scene/a body late world $(awk '$1 == "body" { print $4; exit }' "$dir/robot.txt")"
not_of_a_plan 'something follows a body' "s,^plan turned.*,&\n$first x,"
not_of_a_plan 'not where it may stand' 's/^plan up shelf/plan up hall/'
not_of_a_plan 'a joint is of no kind' '1,/ revolute /s/ revolute / fixed /'
not_of_a_plan 'two bodies of one name' 's/^body forearm /body palm /'
not_of_a_plan 'a path ends early' 's/^path aside shelf 3/path aside shelf 99999999/'
# A robot's own pairs keep 0, pairs with obstacles --clearance, or as `clearance` says; and so their certificates say.
distances() {  # LINE, LINE: two cubes on joints, 10 mm apart, one 20 mm beside them, and one far off; lines for all scenes and for one
  printf 'nsvcd-plans 1\njoint x world 0 0 0 0 0 0 1 1 0 0 prismatic -9 9 1\njoint y x 0 1.01 0 0 0 0 1 0 1 0 prismatic -9 9 1\n'
  printf 'body a x own.obj\nbody b y own.obj\nbody stand world own.obj pose 0 50 0 0 0 0 1\npair a b\n%b' "$1"
  printf 'scene s\nobstacle c own.obj 0 -1.02 0 0 0 0 1\nobstacle far own.obj 0 -9 0 0 0 0 1\n%bplan p s -1 0 1 0\n' "$2"
  printf 'scene other\nobstacle c own.obj 0 -1.02 0 0 0 0 1\nplan o other -1 0 1 0\n'
}
cube "$dir/own.obj" 0 1 0 6
keeps() {  # STATUS OF p, OF o, CLEARANCE, LINE, LINE: so they are planned; a certificate is accepted for that, and for no other distance
  distances "$4" "$5" >"$dir/own.txt"
  rm -f "$dir/certs/p.cert" "$dir/certs/o.cert"
  build/svcd plan "$dir/own.txt" --clearance "$3" --certificates "$dir/certs" >"$dir/out" 2>"$dir/err"
  test "$(cut -f 1,2 "$dir/out" | tr '\t\n' '  ')" = "p $1 o $2 " || fail "$3, '$4', '$5': $(cat "$dir/out" "$dir/err")"
  for plan in p o; do
    ! grep -q "^$plan	certified" "$dir/out" || build/verify "$dir/own.txt" "$dir/certs" --clearance "$3" --only $plan >"$dir/said" || fail "$plan, $3, '$4', '$5': $(cat "$dir/said")"
  done
}
keeps certified certified 0.015 '' ''
keeps start start 0.03 '' ''
grep -q 'a and c are 20.00 mm apart' "$dir/err" || fail "20 mm are 30: $(cat "$dir/err")"
keeps start start 0 'clearance a b 0.02\n' ''
grep -q 'a and b are 10.00 mm apart' "$dir/err" || fail "10 mm are 20: $(cat "$dir/err")"
keeps certified certified 0.015 'clearance b a 0.005\n' ''
keeps start certified 0 '' 'clearance b a 0.02\n'
keeps certified start 0 'clearance a b 0.02\n' 'clearance a b 0.002\n'
keeps certified start 0.03 '' 'clearance c a 0.01\n'
keeps start certified 0.01 '' 'clearance a c 0.03\n'
keeps certified certified 0.01 '' 'clearance a far 0.03\n'
keeps start start 0 'clearance obstacles 0.03\n' ''
keeps certified start 0 'clearance obstacles 0.03\n' 'clearance obstacles 0.01\n'
keeps start start 0.03 'clearance obstacles 0.01\n' ''
keeps certified start 0.01 'clearance obstacles 0.03\n' 'clearance a c 0.01\n'
expect 0 '' build/svcd path "$dir/own.txt"
distances 'clearance a b 0.005\nclearance obstacles 0.015\n' '' >"$dir/own.txt"
expect 0 '' build/svcd plan "$dir/own.txt" --certificates "$dir/certs"
expect 0 '' build/verify "$dir/own.txt" "$dir/certs" --clearance 0.01
expect 1 '' build/verify "$dir/own.txt" "$dir/certs" --clearance 0.016
for lines in 'clearance a b 0.006\nclearance obstacles 0.015\n' 'clearance a b 0.005\n' 'clearance a b 0.005\nclearance obstacles 0.02\n'; do
  distances "$lines" '' >"$dir/own.txt"
  expect 1 '' build/verify "$dir/own.txt" "$dir/certs"
done
{ distances '' '' | sed '/^plan o/d'; printf 'path q other 2\n-1 0\n1 0\npath r s 2\n-1 0\n1 0\n'; } >"$dir/own.txt"
for clearance in 0.01 0.03; do
  expect 0 '' build/svcd path "$dir/own.txt" --clearance $clearance
  test "$(cut -f 1,2 "$dir/out" | sort -u | wc -l) $(cut -f 2 "$dir/out" | sort -u)" = "2 $(test $clearance = 0.01 && echo free || echo hit)" || fail "paths: $(cat "$dir/out")"
done
for line in 'a b -1' 'a b nan' 'a b x' 'a b' 'a b 0.1 0.1' 'b 0.1' 'obstacles' 'obstacles -1' 'a none 0.1' 'a c 0.1' 'a stand 0.1'; do
  distances "clearance $line\n" '' >"$dir/bad_own.txt"
  expect 1 'bad_own.txt:8: ' build/svcd plan "$dir/bad_own.txt"
  expect 2 'bad_own.txt: ' build/verify "$dir/bad_own.txt" "$dir/certs"
done
# Fingers that close on a post: the second one mimics the first, in plans of groups too, and in what is proven.
gripper() {  # LINE, LINE: after the joints, and after the scene
  printf 'nsvcd-plans 1\njoint t world 0 0 0 0 0 0 1 1 0 0 prismatic -1 1 1\n'
  printf 'joint l t 0 0.1 0 0 0 0 1 0 1 0 prismatic -0.2 0.2 1\njoint r t 0 -0.1 0 0 0 0 1 0 1 0 prismatic -0.1 0.05 1\n%b' "$1"
  printf 'body left l box: 0.05 0.05 0.05\nbody right r box: 0.05 0.05 0.05\npair left right\ngroup fingers l\ngroup hand t\n'
  printf 'scene s\nobstacle post box: 0.04 0.04 0.04 0 0 0 0 0 0 1\n%b' "$2"
}
mimic='mimic r l -1 0\n'
plans='plan over s -0.5 0 0 0.5 -0.02 0.02\nplan close s 0 0.06 -0.06 0 -0.05 0.05 group fingers\nplan on s 0 0.1 -0.1 0.3 0.1 -0.1 group hand\n'
gripper "$mimic" "$plans" >"$dir/gripper.txt"
expect 0 '' build/svcd plan "$dir/gripper.txt" --certificates "$dir/certs" --samples 50 --joints "$dir/gripper.tsv"
test "$(cut -f 1,2 "$dir/out" | tr '\t\n' '  ')" = 'over certified close certified on certified ' || fail "fingers: $(cat "$dir/out" "$dir/err")"
awk '{ d = $4 + $5; if (d > 1e-12 || d < -1e-12) exit 1; moved[$1] += ($4 - last) ^ 2; last = $4 } END { exit !(NR == 150 && moved["close"] > 0) }' "$dir/gripper.tsv" ||
  fail "fingers that part: $(cat "$dir/gripper.tsv")"
expect 0 '' build/verify "$dir/gripper.txt" "$dir/certs" --only over,close,on
gripper 'mimic r l -1 1e-9\n' "$plans" >"$dir/other.txt"
expect 1 '' build/verify "$dir/other.txt" "$dir/certs" --only over,close,on
test "$(grep -c 'refused	a joint is not where the one that it mimics drives it' "$dir/out")" = 3 || fail "another mimic: $(cat "$dir/out")"
gripper '' "$plans" >"$dir/other.txt"
expect 1 '' build/verify "$dir/other.txt" "$dir/certs" --only close
line 'refused	a joint moves that is not of the plan.s group'
# together they stay apart, which is proven; each by itself could come to the other
expect 0 '' build/svcd pairs "$dir/gripper.txt"
line '^# never left right: proven'
gripper "joint u world 0 0 0 0 0 0 1 1 0 0 prismatic 0 1 1\nbody none u box: 1 1 1 pose 0 9 0 0 0 0 1\n" '' >"$dir/other.txt"
expect 0 '' build/svcd pairs "$dir/other.txt"
line '^# never none left: proven'
line '^pair left right  # sometimes free at .* hit at '
not_a_gripper() {  # LINE TEXT TEXT MIMIC PLAN: the line at which svcd refuses, why, and why verify does, if it does
  gripper "$4" "$5" >"$dir/bad_gripper.txt"
  expect 1 "bad_gripper.txt:$1: $2" build/svcd plan "$dir/bad_gripper.txt"
  test -z "$3" || expect 2 "bad_gripper.txt: $3" build/verify "$dir/bad_gripper.txt" "$dir/certs"
}
not_a_gripper 13 'joint r is 0.02, and by l, which it mimics, 0' '' "$mimic" 'plan x s 0 0 0.02 0 0 0\n'
not_a_gripper 13 'joint r is -0.0499, and by l, which it mimics, -0.05' '' "$mimic" 'plan x s 0 0 0 0 0.05 -0.0499\n'
not_a_gripper 14 'joint r is 0, and by l' '' "$mimic" 'plan x s 0 0 0\ngoal x 0 0.01 0\n'
not_a_gripper 15 'joint r is 0, and by l' '' "$mimic" 'path x s 2\n0 0 0\n0 0.01 0\n'
not_a_gripper 15 'joint r is 0, and by l' '' "$mimic" 'curve x s 2 3\n0 0 0\n0 0.01 0\n0 0 0\n'
not_a_gripper 5 'expected: mimic NAME LEADER MULTIPLIER OFFSET' 'a line is not one' 'mimic r l 1\n' ''
not_a_gripper 5 "no joint of this name above, nor world: 'x'" 'a joint is named that is not above' 'mimic r x 1 0\n' ''
not_a_gripper 5 'the world is no joint' 'the world is no joint' 'mimic r world 1 0\n' ''
not_a_gripper 5 "it mimics a joint: 'r'" 'a joint mimics itself' 'mimic r r 1 0\n' ''
not_a_gripper 6 "it mimics a joint: 'r'" 'a joint mimics itself, two' 'mimic r l 1 0\nmimic r t 1 0\n' ''
not_a_gripper 6 "it mimics a joint: 'r'" 'a joint mimics itself, two, or one' 'mimic r l 1 0\nmimic t r 1 0\n' ''
not_a_gripper 6 "a leader: 'l'" 'a joint mimics itself, two, or one' 'mimic r l 1 0\nmimic l t 1 0\n' ''
not_a_gripper 5 "MULTIPLIER is 0, or nearly: '0'" '' 'mimic r l 0 0\n' ''
not_a_gripper 5 "not a finite number" '' 'mimic r l nan 0\n' ''
not_a_gripper 12 'a mimic after the first scene' 'a line is not one' '' "$mimic"
# Two pairs whose names differ only by where a dash is have certificates of their own, which end with --seconds.
printf 'nsvcd-plans 1\njoint j world 0 0 0 0 0 0 1 0 0 1 revolute -0.5 0.5 1\n' >"$dir/dashes.txt"
for body in 'a world box: 1 1 1' 'a-b world box: 1 1 1 pose 3 0 0 0 0 0 1' 'c j box: 1 1 1 pose 0 6 0 0 0 0 1' \
  'b-c j box: 1 1 1 pose 0 -6 0 0 0 0 1'; do echo "body $body"; done >>"$dir/dashes.txt"
mkdir "$dir/dashes"
expect 0 '' build/svcd pairs "$dir/dashes.txt" --certificates "$dir/dashes"
expect 0 '' build/verify --pairs "$dir/dashes.txt" "$dir/dashes"
test "$(cut -f 1 "$dir/out" | tr '\n' ' ')" = 'a-c a-b%2dc a%2db-c a%2db-b%2dc ' || fail "pairs by name: $(cat "$dir/out")"
expect 0 '' build/verify --pairs "$dir/dashes.txt" "$dir/dashes" --only 'a%2db-c'
line '^a%2db-c	accepted'
printf 'nsvcd-plans 1\njoint k world 0 0 0 0 0 0 1 0 0 1 revolute -3 3 1\njoint l k 1 0 0 0 0 0 1 0 0 1 revolute -3 3 1\n' >"$dir/long.txt"
printf 'joint m l 1 0 0 0 0 0 1 0 0 1 revolute -3 3 1\nbody post world box: 0.1 0.1 0.1 pose 2.454 0 0 0 0 0 1\n' >>"$dir/long.txt"
printf 'body hand m box: 0.8 0.1 0.1\n' >>"$dir/long.txt"
expect 1 'post-hand.cert: not written: for want of --seconds' build/svcd pairs "$dir/long.txt" --certificates "$dir/dashes" --seconds 0.5
# An obstacle below a plan is one of the scene's: for svcd as for verify.
gripper "$mimic" "${plans}obstacle block box: 0.2 0.2 0.2 0.9 0 0 0 0 0 1\n" >"$dir/late.txt"
expect 0 '' build/svcd plan "$dir/late.txt" --certificates "$dir/certs"
expect 0 '' build/verify "$dir/late.txt" "$dir/certs" --only over,close,on
expect 1 '' build/verify "$dir/gripper.txt" "$dir/certs" --only over
gripper "$mimic" "${plans}obstacle block box: 0.2 0.2 0.2 0.5 0 0 0 0 0 1\n" >"$dir/late.txt"
expect 0 '' build/svcd plan "$dir/late.txt" --only over
line '^over	goal'
# What svcd pairs proves, as an SRDF; of two with a clearance, that they keep it.
expect 2 'ends in .srdf' build/svcd pairs "$dir/gripper.txt" --srdf "$dir/x.xml"
expect 1 'no folder' build/svcd pairs "$dir/gripper.txt" --srdf "$dir/no folder/x.srdf"
expect 0 '' build/svcd pairs "$dir/other.txt" --srdf "$dir/x.srdf"
grep -q '<robot name="x">' "$dir/x.srdf" && grep -q '<disable_collisions link1="none" link2="left" reason="Never"/>' "$dir/x.srdf" &&
  grep -q '<enable_collisions link1="left" link2="right"/>' "$dir/x.srdf" || fail "an SRDF: $(cat "$dir/x.srdf")"
{ sed '/^scene/,$d' "$dir/other.txt"; echo 'clearance left right 5'; echo 'pair left none'; echo 'clearance left none 9'; } >"$dir/wide.txt"
expect 0 '' build/svcd pairs "$dir/wide.txt" --srdf "$dir/x.srdf" --seconds 1
line '^pair left right  # unknown hit at .* open .*, for want of time'
line '^pair none left  # '
grep -q '<enable_collisions link1="none" link2="left"/>' "$dir/x.srdf" || fail "an SRDF of clearances: $(cat "$dir/x.srdf")"
for line in 'stand c' 'c far' 'a a'; do
  distances '' "clearance $line 0.1\n" >"$dir/bad_own.txt"
  expect 1 'bad_own.txt:11: neither a pair above' build/svcd plan "$dir/bad_own.txt"
  expect 2 'a clearance of two bodies that are no pair' build/verify "$dir/bad_own.txt" "$dir/certs"
done
distances 'clearance a b 0.1\nclearance b a 0.1\n' '' >"$dir/bad_own.txt"
expect 1 'bad_own.txt:9: a second clearance of these' build/svcd plan "$dir/bad_own.txt"
distances 'pair a b 0.1\n' '' >"$dir/bad_own.txt"
expect 1 'bad_own.txt:8: expected: pair NAME NAME$' build/svcd plan "$dir/bad_own.txt"
expect 2 'not where it may stand' build/verify "$dir/bad_own.txt" "$dir/certs"
# Shapes without a mesh: how near they come to each other is known, and they have certificates.
echo '# x y z
0 0 0 and what follows
' >"$dir/dust.xyz"
printf 'ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n' >"$dir/dust.ply"
# A ball that may turn by just so much, whose radius is no float; and a plan that starts where its goal is.
printf 'nsvcd-plans 1\njoint t world 0 0 0 0 0 0 1 0 0 1 revolute -3 3 1\nbody a t sphere: 0.0584116\nscene s\nobstacle b sphere: 0.05 1 0 0 0 0 0 1\n%b' \
  'allow a b 0.02\nplan p s -1 1\nplan q s 1 1\nplan r s 1\ngoal r pose 0 0 0 0 0 0 1 a free z\n' >"$dir/shape.txt"
expect 0 '' build/svcd plan "$dir/shape.txt" --certificates "$dir/certs"
expect 0 '' build/verify "$dir/shape.txt" "$dir/certs"
test "$(grep -c 'accepted	free' "$dir/out")" = 3 || fail "what may touch, and what rests: $(cat "$dir/out")"
passes() {  # SHAPE, POSE, OBSTACLE, GAP: a body that slides past an obstacle on the y axis keeps the gap, and no more where it is nearest
  printf 'nsvcd-plans 1\njoint x world 0 0 0 0 0 0 1 1 0 0 prismatic -9 9 1\nbody a x %s pose %s\nscene s\nobstacle b %s\nplan p s -3 3\npath q s 2\n-3\n3\npath r s 1\n0\n' "$1" "$2" "$3" >"$dir/shape.txt"
  expect 0 '' build/svcd path "$dir/shape.txt" --clearance "$(awk "BEGIN { print $4 - 1e-5 }")" --only q
  grep -q "^q	free	" "$dir/out" || fail "$1 at $4: $(cat "$dir/out")"
  expect 0 '' build/svcd path "$dir/shape.txt" --clearance "$(awk "BEGIN { print $4 + 1e-5 }")" --only r
  grep -q "^r	hit	" "$dir/out" || fail "$1 at $4: $(cat "$dir/out")"
  expect 0 '' build/svcd plan "$dir/shape.txt" --clearance "$(awk "BEGIN { print $4 - 2e-4 }")" --certificates "$dir/certs"
  expect 0 '' build/verify "$dir/shape.txt" "$dir/certs" --clearance "$(awk "BEGIN { print $4 - 2e-4 }")"
}
here='0 0 0 0 0 0 1'
passes 'sphere: 0.1' "$here" 'sphere: 0.2 0 0.5 0 0 0 0 1' 0.2
passes 'capsule: 0.05 0.4' '0 0 0 0.70710678 0 0 0.70710678' 'box: 1 1 1 0 1 0 0 0 0 1' 0.25
passes 'cylinder: 0.3 0.2' "$here" 'box: 1 1 1 0 1 0 0 0 0 1' 0.2
passes 'cylinder: 0.3 0.2' '0 0 0 0.70710678 0 0 0.70710678' 'box: 1 1 1 0 1 0 0 0 0 1' 0.4
passes 'box: 0.2 0.6 0.2' "$here" 'cloud: dust.xyz 0.1 0 1 0 0 0 0 1' 0.6
passes 'cloud: dust.xyz 0.1' "$here" 'cylinder: 0.1 1 0 0.5 0 0 0 0 1' 0.3
# a certificate is of these sizes, and of no others
passes 'capsule: 0.05 0.4' '0 0 0 0.70710678 0 0 0.70710678' 'cylinder: 0.2 1 0 1 0 0 0 0 1' 0.55
for change in 's/: 0.05 0.4/: 0.050001 0.4/' 's/: 0.05 0.4/: 0.05 0.400001/' 's/: 0.2 1/: 0.200001 1/' 's/: 0.2 1/: 0.2 1.00001/' 's/capsule: 0.05 0.4/sphere: 0.05/'; do
  sed "$change" "$dir/shape.txt" >"$dir/other_shape.txt"
  expect 1 '' build/verify "$dir/other_shape.txt" "$dir/certs" --clearance 0.5498
  line 'refused	it is about another'
done
# half way between two of its sides a cylinder is no smaller than round
passes 'sphere: 0.1' "$here" "cylinder: 0.1 1 0 0.5 0 0 0 $(awk 'BEGIN { a = 3.14159265358979 / 64; print sin(a), cos(a) }')" "$(awk 'BEGIN { print 0.4 - 0.1 / cos(3.14159265358979 / 32) }')"
expect 0 '' build/svcd plan "$dir/shape.txt" --only p --picture "$dir/shape.svg"
tail -1 "$dir/shape.svg" | grep -q '^</svg>$' || fail "the picture of shapes"
# a ball in a box, or a box in a ball, is a hit
for inside in 'sphere: 1 0 0 0 0 0 0 1' 'box: 3 3 3 0 0 0 0 0 0 1'; do
  printf 'nsvcd-plans 1\njoint x world 0 0 0 0 0 0 1 1 0 0 prismatic -9 9 1\nbody a x sphere: 0.1\nscene s\nobstacle b %s\npath q s 1\n0\n' "$inside" >"$dir/shape.txt"
  expect 0 '' build/svcd path "$dir/shape.txt"
  grep -q '^q	hit	' "$dir/out" || fail "a ball in $inside: $(cat "$dir/out")"
done
printf 'nsvcd-plans 1\njoint x world 0 0 0 0 0 0 1 1 0 0 prismatic -9 9 1\nbody a x sphere: 0.1\nscene s\nobstacle b cloud: dust.ply 0.1 0 1 0 0 0 0 1\nplan p s -1 1\n' >"$dir/shape.txt"
expect 1 'dust.ply: a PLY: certificates are of clouds in text' build/svcd plan "$dir/shape.txt" --certificates "$dir/certs"
grep -q '^p	certified' "$dir/out" || fail "a cloud of a PLY: $(cat "$dir/out")"
for shape in 'sphere: 0' 'sphere: x' 'sphere:' 'capsule: 1' 'box: 1 2' 'box: 1 -2 3' 'cylinder: 1' 'cloud: 0.1' 'sphere: 0.1 scale 1 1 1' 'sphere: 0.1 0.2' 'cone: 1' 'sphere: 1e7'; do
  printf 'nsvcd-plans 1\njoint x world 0 0 0 0 0 0 1 1 0 0 prismatic -9 9 1\nbody a x %s\nscene s\nplan p s -1 1\n' "$shape" >"$dir/shape.txt"
  expect 1 'shape.txt:3: ' build/svcd plan "$dir/shape.txt"
  expect 2 'shape.txt: ' build/verify "$dir/shape.txt" "$dir/certs"
  sed "s/^body a x \(.*\)/scene t\nobstacle a \1/" "$dir/shape.txt" >"$dir/shapes.txt"
  expect 1 'shapes.txt:4: ' build/svcd plan "$dir/shapes.txt"
done
for cloud in '' '1 2\n' '1 2 x\n' '1 2 nan\n' '# 1 2 3\n'; do
  printf "$cloud" >"$dir/bad.xyz"
  printf 'nsvcd-plans 1\njoint x world 0 0 0 0 0 0 1 1 0 0 prismatic -9 9 1\nbody a x cloud: bad.xyz 0.1\nscene s\nplan p s -1 1\n' >"$dir/shape.txt"
  expect 1 'shape.txt:3: body a: .*bad.xyz' build/svcd plan "$dir/shape.txt"
  expect 2 '' build/verify "$dir/shape.txt" "$dir/certs"
done
# Groups: only their joints move; a certificate of a motion in which another one does is refused.
groups() {  # LINES, LINE: three slides, and a post between the start and the goal
  printf 'nsvcd-plans 1\njoint x world 0 0 0 0 0 0 1 1 0 0 prismatic -9 9 1\njoint y x 0 0 0 0 0 0 1 0 1 0 prismatic -9 9 1\njoint z y 0 0 0 0 0 0 1 0 0 1 prismatic -9 9 1\n'
  printf 'body a z sphere: 0.1\n%bscene s\nobstacle b box: 0.2 2 2  0 0 0 0 0 0 1\nplan p s -1 0 0.5 1 0 0.5 %s\n' "$1" "$2"
}
grouped() {  # LINES, LINE, STATUS, COLUMNS of joints that stay
  groups "$1" "$2" >"$dir/group.txt"
  expect 0 '' build/svcd plan "$dir/group.txt" --seconds 2 --samples 100 --joints "$dir/group.tsv"
  test "$(cut -f 2 "$dir/out")" = "$3" || fail "group '$1' '$2': $(cat "$dir/out")"
  for column in $4; do
    test "$(cut -f "$column" "$dir/group.tsv" | sort -u | wc -l)" = 1 || fail "joint $column is held: $1, $2"
  done
}
grouped 'group flat x y\n' 'group flat' certified 5
grouped 'group flat x y\ngroup tall z x\n' 'group tall' certified 4
grouped 'group lone x\n' 'group lone' limit ''
grouped 'group flat x y\ngroup tall z x\n' 'group tall' certified 4
expect 0 '' build/svcd plan "$dir/group.txt" --certificates "$dir/certs"
expect 0 '' build/verify "$dir/group.txt" "$dir/certs"
sed 's/group tall$/group flat/' "$dir/group.txt" >"$dir/other_group.txt"
expect 1 '' build/verify "$dir/other_group.txt" "$dir/certs"
line 'refused	a joint moves that is not of the plan.s group'
group_refused() {  # TEXT, LINES, LINE
  groups "$2" "$3" >"$dir/group.txt"
  expect 1 "$1" build/svcd plan "$dir/group.txt"
}
group_refused 'group.txt:6: expected: group NAME JOINT' 'group flat\n' ''
group_refused "group.txt:6: no joint of this name above, nor world: 'w'" 'group flat x w\n' ''
group_refused 'group.txt:6: the world is no joint' 'group flat x world\n' ''
group_refused "group.txt:7: a second group of this name: 'flat'" 'group flat x\ngroup flat y\n' ''
group_refused "group.txt:9: no group of this name above: 'tall'" 'group flat x\n' 'group tall'
group_refused 'group.txt:9: expected: plan ID SCENE' 'group flat x\n' 'flat'
group_refused 'group.txt:9: joint x is not of group flat, but its goal is not its start' 'group flat y\n' 'group flat'
{ groups '' ''; echo 'group flat x'; } >"$dir/group.txt"
expect 1 'group.txt:9: a group after the first scene' build/svcd plan "$dir/group.txt"
expect 2 'not where it may stand' build/verify "$dir/group.txt" "$dir/certs"
# Curves: past a wall by a detour, which the polyline of their control points cuts; with times, and without.
curve() {  # WORDS, LINES: a ball on two slides, and a wall
  printf 'nsvcd-plans 1\njoint x world 0 0 0 0 0 0 1 1 0 0 prismatic -9 9 1\njoint y x 0 0 0 0 0 0 1 0 1 0 prismatic -9 9 1\n'
  printf 'body a y sphere: 0.1\nscene s\nobstacle b box: 0.2 2 1  0 -0.5 0 0 0 0 1\nplan p s -1 0 1 0\ncurve q s %s\n%bplan late s -1 0 1 0\n' "$1" "$2"
}
curved() {  # WORDS, LINES, VERDICT, EDGE
  curve "$1" "$2" >"$dir/curve.txt"
  expect 0 '' build/svcd path "$dir/curve.txt"
  test "$(cut -f 1-3 "$dir/out" | tr '\t' ' ')" = "q $3 $4" || fail "curve $1 $2: $(cat "$dir/out")"
  expect 0 '' build/svcd plan "$dir/curve.txt" --certificates "$dir/certs"
  expect 0 '' build/verify "$dir/curve.txt" "$dir/certs"
  json path "$dir/curve.txt"
}
curved '2 3' '-1 0\n0 1.9\n1 0\n' free -1      # it reaches 0.95
curved '2 3' '-1 0\n0 1.0\n1 0\n' hit 0
curved '2 5' '-1 0\n-0.5 1.9\n0 1.9\n0.5 1.9\n1 0\n' free -1
curved '2 5 timed' '0 -1 0\n-0.5 1.9\n1 0 1.9\n0.5 1.9\n5 1 0\n' free -1
curved '1 3 timed' '0 -1 0\n2 -1 2\n2.5 1 0\n' free -1
curved '1 3 timed' '0 -1 0\n2 -1 1\n2.5 1 0\n' hit 1
curved '5 6' '-1 0\n-1 3\n0 3\n0 3\n1 3\n1 0\n' free -1
curved '2 3 timed' '0 -1 0\n0 1.9\n1e-3 1 0\n' free -1
curve_refused() {  # LINE, TEXT, WORDS, LINES: a curve that is refused there
  curve "$3" "$4" >"$dir/curve.txt"
  expect 1 "curve.txt:$1: $2" build/svcd path "$dir/curve.txt"
}
curve_refused 8 'expected: curve ID SCENE DEGREE COUNT' '2' ''
curve_refused 8 'expected: curve ID SCENE DEGREE COUNT' '2 3 slow' '-1 0\n0 1.9\n1 0\n'
curve_refused 8 'DEGREE is not in 1..5' '6 7' ''
curve_refused 8 'DEGREE is not in 1..5' '0 7' ''
curve_refused 8 'COUNT is not a multiple' '2 4' ''
curve_refused 8 'COUNT is not a multiple' '2 1' ''
curve_refused 9 'curve q: its line 0 is not one of 3 numbers' '2 3 timed' '-1 0\n0 1.9\n1 0\n'
curve_refused 11 'times do not rise' '2 3 timed' '1 -1 0\n0 1.9\n1 1 0\n'
curve_refused 11 'not a finite number' '2 3 timed' '1 -1 0\n0 1.9\nnan 1 0\n'
curve_refused 11 'curve q: its line 2 is not one of 2 numbers' '2 3' '-1 0\n0 1.9\n'
# Motions on clocks of their own: two balls on slides that cross, and one that a belt carries, taken along from an obstacle.
together() {  # LINES
  printf 'nsvcd-plans 1\njoint x world 0 0 0 0 0 0 1 1 0 0 prismatic -9 9 1\njoint y world 0 0 0 0 0 0 1 0 1 0 prismatic -9 9 1\n'
  printf 'body a x sphere: 0.1\nbody b y sphere: 0.1\npair a b\ngroup left x\ngroup right y\nscene s\nplan p s -1 -1 1 -1\n%b' "$1" >"$dir/in"
  cat "$dir/in"
}
ways='curve l s 1 2 timed group left\n0 -1\n2 1\npath r s 3 group right\n-1\n0\n1\npath rest s 1 group right\n0\n'
met() {  # LINE, VERDICT, T, NAMES [--first]: T to 1 ms
  together "$ways$1\nplan late s -1 -1 1 -1\n" >"$dir/together.txt"
  expect 0 '' build/svcd path "$dir/together.txt" ${5:+--first "$5"}
  awk -F '\t' -v v="$2" -v t="$3" -v n="$4" 'NR > 1 || $2 != v || $5 " " $6 != n || (v == "free" ? $3 != -1 : $3 != 0 || $4 < t - 1e-6 || $4 > t + 1.1e-3) { exit 1 }' "$dir/out" || fail "together $1: $(cat "$dir/out")"
  json path "$dir/together.txt"
}
met 'together q s l r' hit 0.858579 'a b'
met 'together q s l r' hit 0.858579 'a b' 1e-6
met 'together q s l at -0.2 r at 0' hit 0.8 'a b'
met 'together q s l r at 0.3' free - '- -'
met 'together q s r at 100 l' free - '- -'
met 'together q s l at 50 rest' hit 50.8 'a b'
expect 0 '' build/svcd plan "$dir/together.txt" --certificates "$dir/certs"
expect 0 '' build/verify "$dir/together.txt" "$dir/certs"
met 'obstacle c sphere: 0.1 0 0.5 0 0 0 0 1\npath up s 2 group right\n0\n-1\nattach c y\ntogether q s l up at 0.5' hit 0.858579 'a c'
# What is taken along from a `together` on is not known to verify, and a path of a group is nothing by itself: a plan after it
# goes on from the plan above.
together 'scene r\nobstacle c sphere: 0.1 0 2 0 0 0 0 1\npath l r 2 group left\n-1\n1\nplan o r -1 -1 1 -1\npath k r 1 group right\n1\nplan u r\ngoal u 2 -1\nattach c y\npath n r 1 group left\n0\nplan w r -1 -1 1 -1\n' >"$dir/group.txt"
expect 0 '' build/svcd plan "$dir/group.txt" --certificates "$dir/certs"
expect 0 '' build/verify "$dir/group.txt" "$dir/certs" --only p,o,u,w
sed 's/^plan w/together q r l k\n&/' "$dir/group.txt" >"$dir/together.txt"
expect 1 '' build/verify "$dir/together.txt" "$dir/certs" --only w
line 'w	refused	what was attached or released above is not known'
# the example of FORMATS.md
{ echo 'nsvcd-plans 1'; sed -n '/^    joint belt world/,/^    together late/p' examples/FORMATS.md; } >"$dir/together.txt"
expect 0 '' build/svcd path "$dir/together.txt"
line '^soon	hit	0	1.60[0-9]*	palm	box	'
line '^late	free	'
together_refused() {  # LINE, TEXT, LINES
  together "$ways$3\n" >"$dir/together.txt"
  expect 1 "together.txt:$1: $2" build/svcd path "$dir/together.txt"
}
together_refused 20 'expected: together ID SCENE  ID' 'together q s'
together_refused 20 "no scene of this name above: 't'" 'together q t l r'
together_refused 20 "no path or curve of a group above, in this scene: 'k'" 'together q s l k'
together_refused 20 "no path or curve of a group above, in this scene: 'at'" 'together q s l r at'
together_refused 20 "not a finite number" 'together q s l at soon r'
together_refused 20 "two of these move one joint: 'y'" 'together q s l r rest'
together_refused 20 "none of these moves a joint; where it rests, a path of one line says: 'y'" 'together q s l'
together_refused 20 "no group of this name above: 'both'" 'path o s 1 group both'
together_refused 20 'path o has 0 of its 1 lines of 1 joints' 'path o s 1 group left\n0 0'
together_refused 23 'times do not rise, .* of merged motions not by 1e-12 of all' 'curve o s 1 2 timed group left\n0 0\n1e-13 1\ntogether q s o r'
# A snake of 128 joints, which is as many as there may be.
snake() {  # JOINTS: cubes along x, one beside the 100th joint, past which it swings
  awk -v n="$1" 'BEGIN { print "nsvcd-plans 1"
    for (i = 1; i <= n; i++) print "joint j" i, (i > 1 ? "j" i - 1 : "world"), "1.5 0 0 0 0 0 1", 0, i % 2, 1 - i % 2, "revolute -2 2 1"
    for (i = 1; i <= n; i++) print "body b" i, "j" i, "own.obj scale 0.5 0.5 0.5"
    for (i = 3; i <= n; i++) print "pair b1 b" i
    print "scene s\nobstacle c own.obj 155 9 0 0 0 0 1 scale 2 2 2"; printf "plan p s"
    for (i = 1; i <= 2 * n; i++) printf " %s", i == 100 ? -0.3 : i == n + 100 ? 1.2 : 0
    print "" }'
}
snake 128 >"$dir/snake.txt"
expect 0 '' build/svcd plan "$dir/snake.txt" --certificates "$dir/certs"
grep -q '^p	certified' "$dir/out" || fail "a snake: $(cat "$dir/out")"
expect 0 '' build/verify "$dir/snake.txt" "$dir/certs"
snake 129 >"$dir/snake.txt"
expect 1 'snake.txt:130: more joints than NSVCD_MAX_JOINTS' build/svcd plan "$dir/snake.txt"
expect 2 'too many joints' build/verify "$dir/snake.txt" "$dir/certs"
mv "$dir/certs/up.cert" "$dir/certs/turned.cert"
expect 1 '' build/verify "$dir/robot.txt" "$dir/certs"
grep -q '^turned	refused	its motion has another start or goal' "$dir/out" || fail "another plan's: $(cat "$dir/out")"

# Usage.
expect 2 'svcd check' build/svcd
expect 2 "no command 'frobnicate'" build/svcd frobnicate
expect 2 "no command 'swep'; did you mean 'svcd sweep'" build/svcd swep a.obj b.obj
expect 2 "did you mean 'svcd sweep A B'" build/svcd a.obj b.obj
expect 2 'svcd check' build/svcd check
expect 2 'svcd info' build/svcd info
expect 2 'svcd encode' build/svcd encode "$dir/my.obj"
expect 2 'svcd sweep' build/svcd sweep "$dir/my.obj"
for help in --help -h help 'help sweep' 'sweep --help' 'info -h' 'encode --help' 'check --help'; do
  # shellcheck disable=SC2086
  expect 0 '' build/svcd $help
  test ! -s "$dir/err" || fail "svcd $help on standard error: $(head -1 "$dir/err")"
  grep -q '^svcd ' "$dir/out" || fail "svcd $help says: $(head -1 "$dir/out")"
done
expect 2 'neither .body nor .h' build/svcd encode "$dir/my.obj" "$dir/my.txt"
expect 2 'not together' build/svcd encode "$dir/my.obj" "$dir/my.body" --points 3 --radius 1
expect 2 'no such option' build/svcd encode "$dir/my.obj" "$dir/my.body" --speed 3
expect 2 'one file too many' build/svcd check "$dir/good.txt" "$dir/good.txt"
for option in '--points 0' '--points 65537' '--pairs 257' '--pairs x' '--model huge' '--recall 0.5' '--recall nan' \
  '--repeat 0' '--speed 3' '--points' '--method both' '--work 0' '--work x'; do
  # shellcheck disable=SC2086
  expect 2 "$(echo "$option" | cut -d' ' -f1)" build/svcd check "$dir/good.txt" $option
done

# Pictures are for pages: what is seen is what they hold. A film has 40 of them.
for picture in build/demo.svg build/game.svg build/fly_through.svg build/dish_insertion.svg build/bimanual_insertion.svg \
  build/mining_site.svg "$dir/up.svg" "$dir/x.svg"; do
  size=$(wc -c <"$picture")
  test "$size" -lt 400000 || fail "$picture: $size bytes"
done

test "$failures" = 0 || exit 1
echo "examples: the quickstart, the planners and svcd do as they should"
