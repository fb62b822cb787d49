#!/bin/sh
# The sets of the extremes and of what bodies do, as a user meets them: `svcd check` on 60 problems of each. By proof every
# answer is right, and but for *mixed* (5 cm against 20 m: floats) none is undecided. By the network: no NaN, the statuses
# that there can be, and accuracy near that of the standard set (99.6 % of 4,000): at most 3 of 60 wrong. `make bench`
# measures them. Needs build/problems and build/svcd; run from the repository root. Ends with 1 if anything is not as it
# should be.
set -u
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
failures=0
fail() {
  echo "extremes: $*"
  failures=$((failures + 1))
}
# ask METHOD SET STATUSES: the answers into $dir/out, how many are right into $right.
ask() {
  build/svcd check --method "$1" --repeat 1 "$dir/$2.txt" >"$dir/out" 2>"$dir/err" || fail "$2: $(tail -1 "$dir/err")"
  awk -v statuses="^($3)$" 'NF != 8 || $2 !~ /^-?[0-9.e+-]+$/ || $7 !~ statuses || ($3 == 1) != ($2 > 0) { bad = 1 }
    END { exit bad || NR != 60 }' "$dir/out" || fail "$2, $1: an answer that cannot be"
  right=$(sed -n 's/^accuracy .* \([0-9]*\) of 60 right$/\1/p' "$dir/err")
}
check() {  # check SET UNDECIDED_AT_MOST [WRONG_AT_MOST by the network]
  build/problems --set "$1" --meshes procedural --count 60 --pool 30 --seed 901 --out "$dir/$1.txt" >/dev/null 2>&1 || fail "$1"
  ask proof "$1" 'witness|certified-free|inside|undecided'
  undecided=$(cut -f7 "$dir/out" | grep -c undecided)
  test "${right:-0}" = 60 || test "$undecided" -gt 0 || fail "$1: ${right:-0} of 60 right by proof"
  test "$undecided" -le "$2" || fail "$1: $undecided of 60 undecided"
  proven=${right:-0}
  by_network=
  if test -n "${3:-}"; then
    ask network "$1" 'ok|certified-free|inside|limit'
    by_network=", ${right:-0} by the network"
    test "${right:-0}" -ge $((60 - $3)) || fail "$1: ${right:-0} of 60 right by the network"
  fi
  printf 'extremes: %-9s %s of 60 right, %s undecided%s\n' "$1" "$proven" "$undecided" "$by_network"
}
for set in standard thin spin still tiny huge offset hollow; do check $set 0 3; done
for set in cavity rest nested soup one same; do check $set 0; done
check mixed 2
check far 0 0
cut -f7 "$dir/out" | grep -qv certified-free && fail "far: not all are certified free"
check inside 0 1
test "$(grep -c '0 of 30 collisions missed' "$dir/err")" = 1 || fail "inside: $(grep missed "$dir/err")"
exit $((failures > 0))
