#!/bin/sh
# `make -C examples/firmware own`: what it refuses, in one line and before anything is built; and meshes in millimetres, which
# must be answered as README says of them in metres. Ends with 1 at the first thing that is wrong.
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
fail() {
  echo "firmware: $*" >&2
  exit 1
}
own() {
  ${MAKE:-make} -s --no-print-directory -C examples/firmware own "$@" >"$dir/said" 2>&1
}
mistakes=0
refused() {  # WORDS GIVEN...
  mistakes=$((mistakes + 1))
  words=$1
  shift
  ! own "$@" || fail "$*: not refused"
  test "$(wc -l <"$dir/said")" = 1 && grep -q "own: $words" "$dir/said" || fail "$*: $(cat "$dir/said")"
}
refused 'FROM without TO' FROM=0,0,1
refused 'TO without FROM' TO=0,0,1
refused 'A without B' A=A.stl
refused 'B without A' B=B.obj
refused 'FROM=0,0: not three' FROM=0,0 TO=0,0,1
refused 'FROM=0, 0,1: not three' 'FROM=0, 0,1' TO=0,0,1
refused 'TO=0,0,x: not three' FROM=0,0,1 TO=0,0,x
refused 'TO=0,0,1,2: not three' FROM=0,0,1 TO=0,0,1,2
for scale in 0 -1 x 0.001, 1,2,3; do refused "SCALE=$scale: not" "SCALE=$scale"; done

if ! command -v arm-none-eabi-gcc >/dev/null || ! command -v qemu-system-arm >/dev/null; then
  echo "firmware: own: $mistakes mistakes refused; no arm-none-eabi-gcc or no qemu-system-arm: no more tested"
  exit
fi
expected=$(grep '^hit, at' examples/firmware/README.md)
for mesh in mug dish_rack; do
  awk '$1 == "v" { print "v", 1000 * $2, 1000 * $3, 1000 * $4; next } 1' "examples/assets/$mesh.obj" >"$dir/$mesh.obj"
done
answers() {  # B SCALE
  own "A=$dir/mug.obj" "B=$1" FROM=0,-0.4,0.3 TO=0,0,0 "SCALE=$2" || fail "SCALE=$2: $(cat "$dir/said")"
  test "$(head -n 1 "$dir/said")" = "$expected" || fail "SCALE=$2: $(head -n 1 "$dir/said"), not $expected"
}
answers "$dir/dish_rack.obj" 0.001
answers "$PWD/examples/assets/dish_rack.obj" 0.001,1
echo "firmware: own: $mistakes mistakes refused; meshes in millimetres: $expected"
