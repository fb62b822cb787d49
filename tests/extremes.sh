#!/bin/sh
# The sets of the extremes, as a user meets them: `svcd check` on 60 problems of each. No NaN, the statuses that there can
# be, and accuracy near that of the standard set (99.6 % of 4,000): at most 3 of 60 wrong. `make bench` measures them.
# Needs build/problems and build/svcd; run from the repository root. Ends with 1 if anything is not as it should be.
set -u
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
failures=0
fail() {
  echo "extremes: $*"
  failures=$((failures + 1))
}
check() {  # check SET WRONG_AT_MOST
  build/problems --set "$1" --meshes procedural --count 60 --pool 30 --seed 901 --out "$dir/$1.txt" >/dev/null 2>&1 || fail "$1"
  build/svcd check --repeat 1 "$dir/$1.txt" >"$dir/out" 2>"$dir/err" || fail "$1: $(tail -1 "$dir/err")"
  awk 'NF != 8 || $2 !~ /^-?[0-9.e+-]+$/ || $7 !~ /^(ok|certified-free|inside|limit)$/ || ($3 == 1) != ($2 > 0) { bad = 1 }
    END { exit bad || NR != 60 }' "$dir/out" || fail "$1: an answer that cannot be"
  right=$(sed -n 's/^accuracy .* \([0-9]*\) of 60 right$/\1/p' "$dir/err")
  test "${right:-0}" -ge $((60 - $2)) || fail "$1: ${right:-0} of 60 right"
  printf 'extremes: %-9s %s of 60 right\n' "$1" "${right:-0}"
}
for set in standard thin spin still tiny huge offset hollow; do check $set 3; done
check far 0
cut -f7 "$dir/out" | grep -qv certified-free && fail "far: not all are certified free"
check inside 1
test "$(grep -c '0 of 30 collisions missed' "$dir/err")" = 1 || fail "inside: $(grep missed "$dir/err")"
exit $((failures > 0))
