#!/bin/sh
# Every check of the Makefile, one after the other, those that could take hours on a part of what they can do, and then one
# table: check, what it ran, seconds, result. check_all.sh [CHECK...], from the repository's root; names are without
# `check-`, and `tests` is the test binary. What was printed lies in build/check_all. Ends with 1 if a check fails.
set -u
MAKE=${MAKE:-make}
out=build/check_all
mkdir -p $out
rm -f $out/table.part
# What is bounded, and by what.
bounds() {
  case "$1" in
    sanitizers) echo "TESTS=${SANITIZED:-mesh body facets encoding query}" ;;
    cross) echo "PROBLEMS=${PROBLEMS:-40}" ;;
  esac
}
# Of each check its name, and what the Makefile says of it behind the target.
checks() {
  awk '/^check-[a-z0-9-]+:/ {
      name = $1
      sub(/:.*/, "", name)
      if (name == "check-all" || name in seen) next
      seen[name] = 1
      print substr(name, 7) "|" (match($0, /  ##? /) ? substr($0, RSTART + RLENGTH) : "")
    }' Makefile
  echo "tests|all tests of the test binary, as compiled for users"
}
checks | while IFS='|' read -r name said; do
  case " ${*:-$name} " in *" $name "*) ;; *) continue ;; esac
  target=check-$name
  test "$name" != tests || target=run-tests
  bound=$(bounds "$name")
  test "$name" != cross || test -z "${ARCHS:-}" || said="$ARCHS, under QEMU"
  begin=$(date +%s)
  $MAKE $target ${bound:+"$bound"} >"$out/$name.txt" 2>&1 </dev/null
  status=$?
  why=$(grep 'not tested' "$out/$name.txt" | sed 's/^check-[a-z0-9-]*: //; s/: not tested.*//' | paste -sd';' | cut -c1-80)
  result=ok
  test -z "$why" || result="ok, but not tested: $why"
  # Where nothing else was said, nothing else was done.
  test "$(grep -cv -E 'not tested|^make|^CC=|^cc |^$' "$out/$name.txt")" != 0 || test -z "$why" || result="not tested: $why"
  test $status = 0 || result="FAILED: $out/$name.txt"
  printf '%-11s %-72.72s %5d s  %s\n' "$name" "${bound:+$bound: }$said" $(($(date +%s) - begin)) "$result" | tee -a $out/table.part
done
mv $out/table.part $out/table.txt
echo
cat $out/table.txt
! grep -q FAILED $out/table.txt
