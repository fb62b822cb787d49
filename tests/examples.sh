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

# Assets are what make_assets makes, and the quickstart runs on them.
mkdir "$dir/assets"
build/make_assets "$dir/assets" >/dev/null || fail "make_assets"
for asset in mug dish_rack; do
  cmp -s "$dir/assets/$asset.obj" "examples/assets/$asset.obj" || echo "examples: note: $asset.obj differs (another libm?)"
done
rm -f build/demo.svg
build/quickstart >"$dir/out" || fail "quickstart"
grep -q 'carried low  -> HITS (witness' "$dir/out" || fail "the mug carried low hits the rack: $(grep low "$dir/out")"
grep -q 'carried high -> clears (certified-free' "$dir/out" || fail "the mug carried high clears the rack: $(grep high "$dir/out")"
tail -1 build/demo.svg | grep -q '^</svg>$' || fail "build/demo.svg is not whole"
if command -v xmllint >/dev/null; then xmllint --noout build/demo.svg || fail "build/demo.svg is not XML"; fi

# One motion, planned: it ends with 0 if it is certified free, and begins and ends where it should.
expect 0 '' build/plan
test "$(sed -n 1p "$dir/out")" = 'converged: certified free' || fail "plan says: $(sed -n 1p "$dir/out")"
test "$(sed -n 2p "$dir/out")" = ' 0.00 -0.50  0.00' || fail "plan begins at: $(sed -n 2p "$dir/out")"
test "$(tail -1 "$dir/out")" = ' 0.00  0.50  0.00' || fail "plan ends at: $(tail -1 "$dir/out")"
(cd "$dir" && "$OLDPWD/build/plan") 2>"$dir/err" && fail "plan without its meshes ends with 0"
grep -q 'mug.obj:0: the file is missing' "$dir/err" || fail "plan without its meshes says: $(cat "$dir/err")"

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

# Bodies for one method alone, and a body for none.
expect 0 '' build/svcd encode examples/assets/mug.obj "$dir/proof.body" --no-latents
expect 0 '' build/svcd info "$dir/proof.body"
expect 2 'nothing would be left' build/svcd encode examples/assets/mug.obj "$dir/none.body" --no-latents --no-triangles

# A level, and a flight through it that keeps its distance, by the oracle's word (the exit status).
expect 0 '' build/fly_through 60000
grep -q 'in 0 it waited' "$dir/out" || fail "fly_through says: $(cat "$dir/out")"
tail -1 build/fly_through.svg | grep -q '^</svg>$' || fail "build/fly_through.svg is not whole"
expect 2 'usage: ' build/fly_through 10
expect 2 'usage: ' build/fly_through 1000 1000

# The program in README, as it stands there, as C99 and C++11.
awk '/^```c$/ { on = 1; next } /^```/ { on = 0 } on' README.md >"$dir/readme.c"
cp "$dir/readme.c" "$dir/readme.cc"
readme() {  # COMPILER AND FLAGS
  "$@" -O2 -Wall -Wextra -Werror -I. -o "$dir/readme" -lm && "$dir/readme" >"$dir/out" || fail "the program in README: $*"
  head -1 "$dir/out" | grep -q '^hit, witness, ' || fail "the program in README says: $(cat "$dir/out")"
}
readme "${CC:-cc}" -std=c99 "$dir/readme.c"
if command -v "${CXX:-c++}" >/dev/null; then readme "${CXX:-c++}" -std=c++11 "$dir/readme.cc"; fi

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
expect 1 'bad.body: the body is damaged' build/svcd info "$dir/bad.body"
expect 1 'none.body: No such file' build/svcd info "$dir/none.body"
case $(head -c 4 "$dir/mug.body") in NSVB) mark=BVSN ;; *) mark=NSVB ;; esac
{ printf $mark; tail -c +5 "$dir/mug.body"; } >"$dir/other.body"
expect 1 'other.body: encoded on a machine of the other byte order' build/svcd info "$dir/other.body"
expect 1 'none.obj: the file is missing' build/svcd encode "$dir/none.obj" "$dir/x.body"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n' >"$dir/bad.obj"
expect 1 'bad.obj:4: an index' build/svcd encode "$dir/bad.obj" "$dir/x.body"
test ! -e "$dir/x.body" || fail "a refused mesh left a body behind"

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
expect 2 'not in 0..1' build/svcd check --first 2 "$dir/two.txt"
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
refused 2 'none.obj: the file is missing' 'nsvcd-problems 1\nmesh m none.obj\n'
refused 2 'bad.obj:4: an index' 'nsvcd-problems 1\nmesh m bad.obj\n'
printf "$head\000" >"$dir/zero.txt"
expect 1 'zero byte' build/svcd check "$dir/zero.txt"
expect 1 'none.txt: No such file' build/svcd check "$dir/none.txt"
expect 1 "$dir: Is a directory" build/svcd check "$dir"

# Usage.
expect 2 'svcd check' build/svcd
expect 2 'svcd check' build/svcd frobnicate
expect 2 'svcd check' build/svcd check
expect 2 'svcd check' build/svcd info
expect 2 'svcd check' build/svcd encode "$dir/my.obj"
expect 2 'neither .body nor .h' build/svcd encode "$dir/my.obj" "$dir/my.txt"
expect 2 'not together' build/svcd encode "$dir/my.obj" "$dir/my.body" --points 3 --radius 1
expect 2 'no such option' build/svcd encode "$dir/my.obj" "$dir/my.body" --speed 3
expect 2 'one problem file' build/svcd check "$dir/good.txt" "$dir/good.txt"
for option in '--points 0' '--points 65537' '--pairs 257' '--pairs x' '--model huge' '--recall 0.5' '--recall nan' \
  '--repeat 0' '--speed 3' '--points' '--method both' '--work 0' '--work x'; do
  # shellcheck disable=SC2086
  expect 2 "$(echo "$option" | cut -d' ' -f1)" build/svcd check "$dir/good.txt" $option
done

test "$failures" = 0 || exit 1
echo "examples: the quickstart, the planners and svcd do as they should"
