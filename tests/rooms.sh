#!/bin/sh
# Each room of src/ compiles by itself, with what it includes and nothing else.
cd "$(dirname "$0")/.." || exit 1
CC=${CC:-cc}
count=0 failed=0

compiles() {
  printf '#include "src/%s"\n' "$1" |
    $CC -std=c99 -Wall -Wextra -Werror -Wno-unused-function -fsyntax-only -DNSVCD_STATIC -DNSVCD_NO_DISPATCH -I. -x c -
}
for room in $(sed -n 's/^#include "\([a-z_/]*\.h\)".*/\1/p' src/header.h); do
  compiles "$room" || { echo "rooms: src/$room does not compile by itself"; failed=1; }
  count=$((count + 1))
done
for room in src/*/*.h; do
  grep -q "\"${room#src/}\"" src/header.h || { echo "rooms: src/header.h does not name $room"; failed=1; }
done
echo "rooms: $count, each by itself"
exit $failed
