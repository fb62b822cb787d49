#!/bin/sh
# Checks of tests/checks.mk, CORES at a time, and one table of what each is, how many seconds it took and how it ended. What it
# printed is in build/check/NAME.txt. check.sh CORES NAME..., from the repository's root; a name is that of `make check-NAME`.
# A check that says `not tested` has lacked a tool: it counts as skipped, and the table says which one.
# Ends with 1 if a check fails; the last line is `N passed, N failed, N skipped`.
set -u
MAKE=${MAKE:-make}
out=build/check
mkdir -p $out

if test "${1:-}" = --one; then
  name=$2
  said=$(sed -n "s/^check-$name:.*[^#]##* *//p" tests/*.mk tests/*/*.mk | head -1)
  begin=$(date +%s)
  if $MAKE --no-print-directory "check-$name" >"$out/$name.txt" 2>&1 </dev/null; then result=ok; else result=FAILED; fi
  lacks=$(grep 'not tested' "$out/$name.txt" | sed 's/^[a-z0-9-]*: //; s/: not tested.*//' | sort -u | paste -sd';' | cut -c1-100)
  test -z "$lacks" || test $result = FAILED || result="skipped, or a part of it: $lacks"
  test $result != FAILED || tail -n 25 "$out/$name.txt"
  printf '%-10s %5d s  %-72.72s %s\n' "$name" $(($(date +%s) - begin)) "$said" "$result" | tee "$out/$name.result"
  exit 0
fi

jobs=$1
shift
for name in "$@"; do rm -f "$out/$name.result"; done
printf '%s\n' "$@" | MAKE="$MAKE" xargs -P "$jobs" -n 1 "$0" --one
echo
for name in "$@"; do cat "$out/$name.result" 2>/dev/null || echo "$name FAILED: it did not end"; done | tee $out/table.txt
failed=$(grep -c FAILED $out/table.txt)
skipped=$(grep -c ' skipped, ' $out/table.txt)
echo "$(($# - failed - skipped)) passed, $failed failed, $skipped skipped"
test "$failed" = 0
