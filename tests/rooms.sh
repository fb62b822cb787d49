#!/bin/sh
# Each room of src/ compiles by itself, with what it includes and nothing else.
cd "$(dirname "$0")/.." || exit 1
CC=${CC:-cc}
count=0 failed=0

compiles() {
  case $1 in certificate/* | robot/* | world/*) static= ;; *) static=-DNSVCD_STATIC ;; esac  # what stands on neuralsvcd.h calls it
  printf '#include "src/%s"\n' "$1" |
    $CC -std=c99 -Wall -Wextra -Werror -Wno-unused-function -fsyntax-only $static -DNSVCD_NO_DISPATCH -I. -x c -
}
plans="src/header.h src/certify.h src/robot.h src/world.h"
for room in $(sed -n 's/^#include "\([a-z_/]*\.h\)".*/\1/p' $plans | sort -u); do
  compiles "$room" || { echo "rooms: src/$room does not compile by itself"; failed=1; }
  count=$((count + 1))
done
for room in src/*/*.h; do
  grep -q "\"${room#src/}\"" $plans || { echo "rooms: no plan names $room"; failed=1; }
done
# the plans, without the headers that are made of them
printf '#define %s_IMPLEMENTATION\n' NEURALSVCD NEURALSVCD_CERTIFY NEURALSVCD_ROBOT NEURALSVCD_WORLD |
  sed '$a #include "src/header.h"\n#include "src/certify.h"\n#include "src/robot.h"\n#include "src/world.h"' |
  $CC -std=c99 -Wall -Wextra -Werror -fsyntax-only -I. -x c - || failed=1
echo "rooms: $count, each by itself"
exit $failed
