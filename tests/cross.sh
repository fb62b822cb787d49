#!/bin/sh
# The library on other processors, under QEMU's user mode: cross.sh [ARCH...], from the repository's root; all of
# aarch64 (NEON), armhf, riscv64, ppc64le, s390x (big-endian) without an argument. Of each: examples/quickstart.c, the
# verdicts of `svcd check` by proof and by the network on PROBLEMS problems, which must be the host's, a body that the host
# has encoded, certificates that it has made, and the tests of TESTS. An ARCH whose tools are not there is not tested, and that is no error. Ends with 1 if
# anything is not as on the host.
set -u
CC=${CC:-cc}
PROBLEMS=${PROBLEMS:-120}
TESTS=${TESTS:-results mesh body motion spline latent_rotation winding_number encoder decoder}
flags="-O2 -std=c99 -w -DNSVCD_NO_DISPATCH -I."
out=build/cross
failed=0
fail() {
  echo "cross: $*"
  failed=1
}
tools() {  # of an architecture: the prefix of its compiler, its emulator
  case "$1" in
    aarch64) echo aarch64-linux-gnu- qemu-aarch64 ;;
    armhf) echo arm-linux-gnueabihf- qemu-arm ;;
    riscv64) echo riscv64-linux-gnu- qemu-riscv64 ;;
    ppc64le) echo powerpc64le-linux-gnu- qemu-ppc64le ;;
    s390x) echo s390x-linux-gnu- qemu-s390x ;;
    *) echo none none ;;
  esac
}

# What is asked of each, in a folder of its own: compiler, flags, emulator or nothing. ID, verdict and status count: what is
# rounded otherwise may differ.
answers() {
  here=$1 cc=$2 extra=$3 run=$4
  mkdir -p "$here/build"
  rm -rf "$here/examples"
  mkdir "$here/examples" && cp -r examples/assets "$here/examples" || return 1
  for program in quickstart svcd; do
    $cc $flags $extra -o "$here/$program" examples/$program.c -lm || return 1
  done
  $cc $flags $extra -o "$here/verify" examples/verify/verify.c -lm || return 1
  (cd "$here" && $run ./quickstart) | grep carried | sed 's/;.*us)/)/; s/ first at .*//' >"$here/quickstart.txt"
  for method in proof network; do
    $run "$here/svcd" check --method $method --repeat 1 "$out/problems.txt" 2>"$here/$method.err" |
      cut -f 1,3,7 >"$here/$method.txt"
  done
}

rm -rf $out
mkdir -p $out
cp -r tests/data/meshes $out
awk -v most="$PROBLEMS" '/^problem/ && ++n > most { exit } { print }' tests/data/problems.txt >$out/problems.txt
answers $out/host "$CC" '' '' || { fail "the host's programs"; exit 1; }
$out/host/svcd encode examples/assets/mug.obj $out/host.body >$out/host/body.txt || fail "no body of the host"
$out/host/svcd info $out/host.body >$out/host/info.txt || fail "a body of the host's"
test "$(grep -c HITS $out/host/quickstart.txt)" = 1 || fail "the quickstart of the host: $(cat $out/host/quickstart.txt)"
test "$(wc -l <$out/host/proof.txt)" = "$PROBLEMS" || fail "the host answers $(wc -l <$out/host/proof.txt) problems"

# Certificates are the same bytes everywhere, and what the host has proven is accepted everywhere.
mkdir -p $out/certs
$out/host/svcd check --repeat 1 --certificates $out/certs $out/problems.txt >$out/host/proven.txt 2>&1 || fail "no certificates: $(tail -1 $out/host/proven.txt)"
$out/host/verify $out/problems.txt $out/certs | cut -f 1-4 >$out/host/verified.txt
test "$(grep -c accepted $out/host/verified.txt)" = "$PROBLEMS" || fail "the host's certificates: $(grep -m 1 refused $out/host/verified.txt)"

same() {  # ARCH, what
  here=$out/$1
  cmp -s "$here/$2.txt" "$out/host/$2.txt" && return
  fail "$1: $2 is not as on the host:"
  diff "$out/host/$2.txt" "$here/$2.txt" | head -10
}
bodies() {  # a body of little-endian bytes is one everywhere, or is refused
  if test "$1" = s390x; then
    $2 $out/s390x/svcd info $out/host.body >/dev/null 2>&1 && fail "s390x takes a body of another byte order"
  else
    $2 "$out/$1/svcd" info $out/host.body >"$out/$1/info.txt" 2>&1
    same "$1" info
  fi
}
tests_of() {  # ARCH, compiler, emulator
  for test in $TESTS; do
    program=$out/$1/test_$test
    if ! "$2" $flags -static -pthread -DTEST_ALONE -o "$program" "tests/test_$test.c" -lm; then
      fail "$1: test_$test.c does not compile"
    elif ! $3 "$program" >"$program.txt" 2>&1; then
      fail "$1: test_$test.c"
      grep -E 'failed$|FAILED' "$program.txt" | head -10
    fi
  done
}
for arch in ${*:-aarch64 armhf riscv64 ppc64le s390x}; do
  set -- $(tools "$arch")
  missing=
  command -v "${1}gcc" >/dev/null || missing="no ${1}gcc"
  command -v "$2" >/dev/null || missing="${missing:+$missing, }no $2"
  if test -n "$missing"; then
    echo "check-cross: $arch: $missing: not tested"
    continue
  fi
  before=$failed
  if answers "$out/$arch" "${1}gcc" -static "$2"; then
    for what in quickstart proof network; do same "$arch" $what; done
    bodies "$arch" "$2"
    $2 "$out/$arch/verify" $out/problems.txt $out/certs | cut -f 1-4 >"$out/$arch/verified.txt"
    same "$arch" verified
    tests_of "$arch" "${1}gcc" "$2"
  else
    fail "$arch: its programs"
  fi
  test $failed != "$before" || echo "cross: $arch: $PROBLEMS problems by proof and by network, and tests ($TESTS), as on the host"
done
exit $failed
