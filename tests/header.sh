#!/bin/sh
# The header alone, and the checker of certificates: every standard and compiler at hand with strict warnings, included twice; then what it leaves in the
# namespace (functions, macros) and whether it has mutable data. Ends with 1 at the first thing that is wrong.
set -eu
strict="-Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wcast-qual -Wdouble-promotion -Werror"
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
here=$(pwd)

cat >"$dir/twice.c" <<END
#include "$here/neuralsvcd.h"
#include "$here/neuralsvcd.h"
#ifndef NSVCD_NO_PROOF
#include "$here/extras/neuralsvcd_robot.h"
#include "$here/extras/neuralsvcd_world.h"
#endif
#define NEURALSVCD_IMPLEMENTATION
#define NEURALSVCD_CERTIFY_IMPLEMENTATION
#define NEURALSVCD_ROBOT_IMPLEMENTATION
#define NEURALSVCD_WORLD_IMPLEMENTATION
#include "$here/neuralsvcd.h"
#include "$here/neuralsvcd.h"
#ifndef NSVCD_NO_PROOF
#include "$here/extras/neuralsvcd_certify.h"
#include "$here/extras/neuralsvcd_robot.h"
#include "$here/extras/neuralsvcd_world.h"
#include "$here/extras/neuralsvcd_certify.h"
#include "$here/extras/neuralsvcd_robot.h"
#include "$here/extras/neuralsvcd_world.h"
#endif
END
printf '#include "%s/examples/verify/nsvcd_verify_claim.h"\n' "$here" "$here" >"$dir/checker.c"
cp "$dir/checker.c" "$dir/checker.cc"
printf '#include "%s/extras/neuralsvcd_certify.h"\n#include "%s/extras/neuralsvcd_robot.h"\n#include "%s/extras/neuralsvcd_world.h"\n' "$here" "$here" "$here" >"$dir/user.c"  # declarations only, in a second file
cp "$dir/twice.c" "$dir/twice.cc"
cp "$dir/user.c" "$dir/user.cc"

fail() {
  echo "header: $*" >&2
  exit 1
}
compile() {  # compiler, suffix, standard, further flags
  "$1" "-std=$3" $strict $4 -c "$dir/twice.$2" -o "$dir/twice.o" || fail "$1 -std=$3 $4"
  "$1" "-std=$3" $strict -fsyntax-only "$dir/user.$2" || fail "$1 -std=$3, declarations"
  "$1" "-std=$3" $strict $4 -c "$dir/checker.$2" -o "$dir/checker.o" || fail "$1 -std=$3 $4, the checker"
  echo "header: $1 -std=$3 $4"
}

# The compilers there are, each once, whatever its names.
compilers() {
  for name in "$@"; do
    path=$(command -v "$name") && echo "$(readlink -f "$path") $name"
  done | sort -u -k1,1 | cut -d' ' -f2
}
# Only the first standard of each compiler is optimised: for warnings that follow the data, and for the symbols.
objects=0
keep() {
  objects=$((objects + 1))
  cp "$dir/twice.o" "$dir/kept_$objects.o"
}
for cc in $(compilers "${CC:-cc}" gcc clang); do
  compile "$cc" c c99 "-O2 -fPIC"
  keep
  compile "$cc" c c11 -O0
  compile "$cc" c c17 "-DNSVCD_NO_DISPATCH -O0"  # the three copies of a query are one text
  compile "$cc" c c99 "-DNSVCD_STATIC -O0"  # no warning of what nobody calls
done
for cxx in $(compilers "${CXX:-c++}" g++ clang++); do
  compile "$cxx" cc c++11 "-O2 -fPIC"
  keep
  compile "$cxx" cc c++17 "-DNSVCD_NO_DISPATCH -O0"
  compile "$cxx" cc c++11 "-DNSVCD_STATIC -O0"
done
test "$objects" -gt 0 || fail "no compiler"

# All that clang can say, but for what is meant so: declarations where a value is known (C99), padding, numbers compared
# for being the same, (size_t)ceilf(x); in C++ also what makes it C: casts, NULL, and names with two underscores, which
# tell what is private and no other library has. A name of entry/processor becomes itself, with an ending or without.
meant="-Wno-declaration-after-statement -Wno-padded -Wno-float-equal -Wno-bad-function-cast -Wno-disabled-macro-expansion"
meant_in_cxx="-Wno-old-style-cast -Wno-zero-as-null-pointer-constant -Wno-reserved-identifier -Wno-reserved-macro-identifier"
if clang --version 2>/dev/null | grep -q 'version 14'; then  # others know other warnings
  compile clang c c99 "-Weverything $meant -O0"
  compile clang++ cc c++11 "-Weverything -Wno-c++98-compat-pedantic $meant $meant_in_cxx -O0"
else
  echo "header: no clang 14: -Weverything not tested"
fi
compile "${CC:-cc}" c c99 "-DNSVCD_NO_ENCODER -DNSVCD_NO_READERS -O0"
! nm "$dir/twice.o" | grep -E ' U .*(alloc|free|brk|mmap)' >&2 || fail "a query can allocate"
compile "${CC:-cc}" c c99 "-Dnear= -Dfar= -O0"  # as windows.h does
compile "${CC:-cc}" c c99 "-DNSVCD_NO_SIMD -O0"
if test "$(uname -m)" = x86_64; then
  compile "${CC:-cc}" c c99 "-mavx2 -mfma -O0"
  compile "${CXX:-c++}" cc c++11 "-mavx512f -O0"
fi
for without in STDIO PROOF NETWORK "NETWORK ENCODER" "PROOF ENCODER" ENCODER READERS SMALL BASE INT8 FLOAT GRADIENT OPTIMIZER "GRADIENT OPTIMIZER" "SMALL BASE" "ENCODER SMALL BASE FLOAT STDIO"; do
  compile "${CC:-cc}" c c99 "$(printf ' -DNSVCD_NO_%s' DISPATCH $without) -O0"
done
compile "${CC:-cc}" c c99 "-DNSVCD_NO_ENCODER -DNSVCD_NO_SMALL -DNSVCD_NO_INT8 -O0"  # and with all three copies

# The header's first example is a program as it stands.
sed -n '/^\/\/ This is a whole program/,/^\/\/ A larger program/{/^\/\/   /s/^\/\/   //p;/^\/\/$/s/.*//p;}' neuralsvcd.h >"$dir/example.c"
grep -q 'int main' "$dir/example.c" || fail "the header has no first example"
"${CC:-cc}" -std=c99 -Wall -Wextra -Werror -I"$here" -O0 "$dir/example.c" -o "$dir/example" -lm || fail "the header's first example, in C"
"${CXX:-c++}" -std=c++11 -Wall -I"$here" -O0 -x c++ "$dir/example.c" -o "$dir/example_cc" -lm || fail "the header's first example, in C++"
said=$(cd "$dir" && ./example 2>&1) && fail "the header's first example ends with 0 without its mesh"
case $said in "mug.obj: the file is missing"*) ;; *) fail "the header's first example, without its mesh: $said" ;; esac
cp examples/assets/mug.obj "$dir/"
said=$(cd "$dir" && ./example)
case $said in "hits at t = "*) ;; *) fail "the header's first example says: $said" ;; esac
echo "header: the first example, $said"

# The proof alone needs no weights.h.
mkdir "$dir/alone"
cp "$here/neuralsvcd.h" "$dir/alone/"
printf '#define NEURALSVCD_IMPLEMENTATION\n#define NSVCD_NO_NETWORK\n#include "neuralsvcd.h"\n' >"$dir/alone/proof.c"
"${CC:-cc}" -std=c99 $strict -O0 -c "$dir/alone/proof.c" -o "$dir/alone/proof.o" || fail "NSVCD_NO_NETWORK without weights.h"
echo "header: NSVCD_NO_NETWORK without weights.h"

# A compiler known to be wrong is refused; and the self test sees why, as it sees a slip in the header.
cat >"$dir/self.c" <<END
#define NEURALSVCD_IMPLEMENTATION
#define NSVCD_NO_NETWORK
#include "self.h"
#include <stdio.h>
int main(void) {
  return puts(nsvcd_result_string(nsvcd_self_test())) < 0;
}
END
self() {  # what the self test says: sed's change of the header, compiler and flags
  sed -e 's/^#include "neuralsvcd.h"$/#include "self.h"/' -e "$1" neuralsvcd.h >"$dir/self.h"
  shift
  "$@" "$dir/self.c" -o "$dir/self" -lm || fail "the self test does not compile: $*"
  "$dir/self"
}
for flags in -O0 "-O1 -DNSVCD_NO_SIMD" "-O3 -ffast-math -w"; do  # the library of promises/queries.c is -O3
  test "$(self '' "${CC:-cc}" -std=c99 $flags)" = ok || fail "the self test refuses ${CC:-cc} $flags"
done
slip='/ nsvcd__vquat_mul(/,/^}/s/nsvcd__v_sub(/nsvcd__v_add(/'
case $(self "$slip" "${CC:-cc}" -std=c99 -O0) in "this build computes wrongly"*) ;; *) fail "the self test sees no slip" ;; esac
if command -v tcc >/dev/null; then
  ! tcc -c "$dir/twice.c" -o "$dir/tcc.o" 2>"$dir/tcc.txt" && grep -q 'error.*tcc passes arguments wrongly' "$dir/tcc.txt" || fail "tcc is not refused"
  case $(self '/^#error "neuralsvcd.h: tcc/d' tcc -w) in "this build computes wrongly"*) ;; *) fail "the self test passes tcc" ;; esac
  echo "header: tcc is refused"
else
  echo "header: no tcc: not tested"
fi

# The checker of certificates is not compiled where NaN could pass or sums are reordered; where that has no macro, or none
# any more, it says so as it runs.
cat >"$dir/unfit.c" <<END
#include "$here/examples/verify/nsvcd_verify_claim.h"
#include <stdio.h>
int main(void) {
  static const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  static const uint32_t triangle[3] = {0, 1, 2};
  uint32_t memory[NSVCD_VERIFY_MESH_BYTES(3, 1) / 4 + 1];
  nsvcd_verify_mesh mesh;
  const char *why = nsvcd_verify_mesh_init(corners, 3, triangle, 1, memory, &mesh);
  return puts(why ? why : "accepted") < 0;
}
END
not_compiled() {
  ! "$@" -c "$dir/unfit.c" -o "$dir/unfit.o" 2>"$dir/unfit.txt" && grep -q 'error.*nsvcd_verify: not with' "$dir/unfit.txt" || fail "the checker is compiled by $*"
}
says() {  # what it says, compiler and flags
  expected=$1
  shift
  "$@" -O2 "$dir/unfit.c" -o "$dir/unfit" -lm || fail "the checker does not compile: $*"
  said=$("$dir/unfit")
  case $said in "$expected"*) ;; *) fail "the checker says, by $*: $said" ;; esac
}
reorders="-fassociative-math -fno-signed-zeros -fno-trapping-math"
for cc in $(compilers gcc clang); do
  for flags in -ffast-math -ffinite-math-only "-O2 -ffast-math" -D_M_FP_FAST=1; do not_compiled "$cc" $flags; done
  for flags in -O2 -O3 -ffp-contract=fast -fno-signed-zeros; do says accepted "$cc" $flags; done
  says "this build takes NaN" "$cc" -ffinite-math-only -U__FINITE_MATH_ONLY__
  says "this build reorders sums" "$cc" $reorders -U__ASSOCIATIVE_MATH__
  says "this build divides by" "$cc" -freciprocal-math -U__RECIPROCAL_MATH__
  if "$cc" $reorders -dM -E -x c /dev/null | grep -q __ASSOCIATIVE_MATH__; then  # of gcc 12 and later
    for flags in "$reorders" -freciprocal-math -funsafe-math-optimizations; do not_compiled "$cc" $flags; done
  fi
  echo "header: the checker of certificates refuses $cc -ffast-math and its parts"
done

# A build that lacks something scales a body whole or not at all.
cat >"$dir/scale.c" <<END
#define NEURALSVCD_IMPLEMENTATION
#include "$here/neuralsvcd.h"
#include <stdio.h>
static uint64_t memory[1 << 17];
int main(int argc, char **argv) {
  const nsvcd_body *body = NULL;
#ifdef ENCODES
  nsvcd_mesh mesh;
  if (argc != 3 || nsvcd_obj_load(argv[1], NULL, &mesh, NULL)) return 1;
  nsvcd_encode_options options = {0};
  options.latents = 1;
  if (nsvcd_encode(&mesh, &options, NULL, memory, sizeof memory, &body)) return 1;
#else
  FILE *from = fopen(argv[1], "rb");
  const size_t size = argc == 3 && from ? fread(memory, 1, sizeof memory, from) : 0;
  if (nsvcd_body_load(memory, size, &body)) return 1;
  const nsvcd_result result = nsvcd_body_scale(body, (const float[3]){3, 3, 3}, memory, sizeof memory, &body);
  if (result) return puts(nsvcd_result_string(result)) < 0;
#endif
  FILE *to = fopen(argv[2], "wb");
  return fwrite(body, 1, nsvcd_body_describe(body).size, to) == 0 || fclose(to);
}
END
scale() {  # flags, from, to
  "${CC:-cc}" -std=c99 -Wall -Wextra -DNSVCD_NO_DISPATCH -O0 $1 "$dir/scale.c" -o "$dir/scale" -lm || fail "bodies that are scaled, $1"
  (cd "$dir" && ./scale "$2" "$3") || fail "a body is not scaled, $1"
}
scale -DENCODES mug.obj mug.body
scale "" mug.body full.body
scale -DNSVCD_NO_NETWORK mug.body proof.body
cmp "$dir/full.body" "$dir/proof.body" || fail "without the network another body comes out"
said=$(scale -DNSVCD_NO_PROOF mug.body network.body)
test ! -e "$dir/network.body" && test -n "$said" || fail "triangles that keep their size in a scaled body"
echo "header: bodies are scaled whole, or refused"

# Mutable data, and with -fPIC tables of constant pointers as well (.data.rel.ro), for a loader writes into these: there
# are none, and so constants stay in flash, and processes share them.
for object in "$dir"/kept_*.o; do
  bad=$(nm -g --defined-only "$object" | awk '$3 !~ /^_?nsvcd_[a-z]/ || $3 ~ /^_?nsvcd__/ { print $3 }')
  test -z "$bad" || fail "symbols that are not public ones of ours: $bad"
  bad=$(nm --defined-only "$object" | awk '$2 ~ /^[bBdDcCsSgG]$/ { print $3 }')
  test -z "$bad" || fail "mutable data: $bad"
  size -A "$object" >"$dir/sizes" 2>/dev/null || echo "header: no size -A: data without a name not tested"
  bad=$(awk '$1 ~ /^\.(data|bss|tdata|tbss)/ && $2 > 0 { print $1 " of " $2 " bytes" }' "$dir/sizes")
  test -z "$bad" || fail "mutable data: $bad"
  nm -g --defined-only "$object" | grep -q nsvcd_sweep || fail "nm shows no nsvcd_sweep: this check checks nothing"
done
echo "header: no unprefixed symbol, no mutable data"

# Macros: what is there after the header and not after what it includes.
# Not what the header includes for other processors and compilers.
case $(uname -m) in x86_64) other='arm_neon|<intrin|wasm' ;; *) other='intrin|wasm' ;; esac
includes=$(sed -n 's/^ *#include <\(.*\)>/#include <\1>/p' neuralsvcd.h | grep -Ev "$other")
printf '%s\n' "$includes" >"$dir/none.c"
"${CC:-cc}" -std=c99 -dM -E "$dir/none.c" | sort >"$dir/before"
"${CC:-cc}" -std=c99 -dM -E "$dir/twice.c" | sort >"$dir/after"
bad=$(comm -13 "$dir/before" "$dir/after" | awk '$2 !~ /^(NSVCD|NEURALSVCD|nsvcd__)/ { print $2 }')
test -z "$bad" || fail "macros without our prefix: $bad"
echo "header: no unprefixed macro"
