#!/bin/sh
# Microsoft's compiler cannot be run here. What can be told without it is: clang for its targets, with its extensions and its
# preprocessor, on the header alone and the checker of certificates; first as clang-cl, then with what cl says of itself and no
# more (tests/msvc/as_cl.h), so that the header goes cl's ways. tests/msvc holds what is used of the C library, as Microsoft
# declares it: fopen is called unsafe, M_PI and GNU's functions are not there. Then what cl refuses and clang does not: GNU's
# words, minus on unsigned (C4146, an error with /sdl). Where there are MinGW and wine, that build runs.
set -eu
here=$(pwd)
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
fail() {
  echo "msvc: $*" >&2
  exit 1
}
command -v clang >/dev/null || { echo "msvc: no clang: not tested"; exit 0; }
cat >"$dir/twice.c" <<END
#include "$here/neuralsvcd.h"
#define NEURALSVCD_IMPLEMENTATION
#include "$here/neuralsvcd.h"
END
printf '#include "%s/examples/verify/nsvcd_verify_robot.h"\n' "$here" >"$dir/checker.c"
cp "$dir/twice.c" "$dir/twice.cc"
cp "$dir/checker.c" "$dir/checker.cc"

ms="-fms-compatibility -fms-extensions -fms-compatibility-version=19.38 -isystem $here/tests/msvc"
strict="-Wall -Wextra -Wpedantic -Wgnu -Wvla -Wconversion -Wsign-conversion -Wshadow -Wcast-qual -Wunknown-attributes \
  -Wunknown-pragmas -Wmicrosoft -Wzero-length-array -Wmissing-prototypes -Wno-language-extension-token \
  -Werror -Wno-unknown-warning-option"  # of extensions, __forceinline is meant
vectors="-mavx512f -mavx512vl -mavx512vnni -mfma -mbmi2 -mxsave"
# compile TARGET STANDARD FLAG...: the header, and the checker
compile() {
  target=$1 standard=$2
  shift 2
  case $standard in c++*) ends=cc ;; *) ends=c ;; esac
  for file in twice checker; do
    # shellcheck disable=SC2086
    clang "--target=$target-pc-windows-msvc" $ms "-std=$standard" $strict "$@" -fsyntax-only "$dir/$file.$ends" ||
      fail "$target, -std=$standard $*: $file"
  done
}
as_cl() {
  target=$1 standard=$2
  shift 2
  case $target in *64) flags= ;; *) flags=-msse2 ;; esac
  case $target in aarch64) ;; *) flags="$flags $vectors" ;; esac
  # shellcheck disable=SC2086
  compile "$target" "$standard" $flags -include "$here/tests/msvc/as_cl.h" "$@"
}
for target in x86_64 i686 aarch64; do
  for standard in c11 c17 c++14; do
    compile $target $standard
    as_cl $target $standard
  done
  clang --driver-mode=cl "--target=$target-pc-windows-msvc" -fmsc-version=1938 /imsvc"$here/tests/msvc" /W4 /WX /sdl /Zs \
    /std:c11 "$dir/twice.c" || fail "clang-cl /W4, $target"
done
for target in x86_64 i686; do
  compile $target c11 -mavx2 -mfma
  compile $target c11 -mavx512f
  as_cl $target c11 -DARCH_AVX2
  as_cl $target c++14 -DARCH_AVX512
done
for without in NSVCD_NO_DISPATCH NSVCD_NO_SIMD NSVCD_NO_PROOF NSVCD_NO_NETWORK NSVCD_NO_STDIO \
  "NSVCD_NO_SMALL -DNSVCD_NO_BASE" "NSVCD_ONE_PATH -Wno-unknown-pragmas"; do  # clang does not know fp_contract
  # shellcheck disable=SC2086
  as_cl x86_64 c11 -D$without
done
echo "msvc: clang takes the header and the checker for x86_64, i686 and aarch64, as clang-cl and as cl: C11, C17, C++14"

# What cl sees of the header and the checker: no word of GNU's.
for file in twice.c checker.cc; do
  # shellcheck disable=SC2086
  clang --target=x86_64-pc-windows-msvc $ms $vectors -include tests/msvc/as_cl.h -E "$dir/$file" >"$dir/seen"
  awk '/^# [0-9]+ "/ { ours = $3 ~ /neuralsvcd.h|weights.h|nsvcd_verify/; next } ours' "$dir/seen" |
    sed 's/__builtin_offsetof//g; s/__builtin_ia32_//g' >"$dir/ours"  # what clang's own headers have as macros
  test "$(wc -l <"$dir/ours")" -gt 1000 || fail "this check checks nothing: $file"
  ! grep -nE '__attribute__|__builtin_|__asm|\basm\b|typeof|__extension__|__restrict|\b(alloca|M_PI|ssize_t)\b|#pragma (GCC|clang|STDC)' \
    "$dir/ours" >&2 || fail "what cl does not know"
  ! grep -q 'avx2' "$dir/ours" && test "$file" = twice.c && fail "cl's ways have no AVX2"
done
echo "msvc: no word that cl does not know"

query=$(command -v clang-query || command -v clang-query-14 || true)
if test -n "$query"; then
  # shellcheck disable=SC2086
  "$query" -c 'set bind-root true' -c 'set output diag' \
    -c 'match unaryOperator(isExpansionInFileMatching("neuralsvcd.h|nsvcd_verify"), hasOperatorName("-"), hasUnaryOperand(expr(hasType(isUnsignedInteger()))))' \
    "$dir/twice.c" -- -std=c11 >"$dir/found" 2>&1
  grep -q '^0 matches' "$dir/found" || { grep -A2 '"root" binds' "$dir/found" >&2; fail "minus on unsigned: C4146"; }
  echo "msvc: no minus on unsigned"
else
  echo "msvc: no clang-query: minus on unsigned not tested"
fi

wine=$(command -v wine64 || ls /usr/lib/wine/wine64 2>/dev/null || true)
if test -n "$wine" && command -v x86_64-w64-mingw32-gcc >/dev/null && grep -q avx512_vnni /proc/cpuinfo; then
  # shellcheck disable=SC2086
  clang --target=x86_64-pc-windows-msvc $ms $vectors -include tests/msvc/as_cl.h -O0 -c tests/msvc/run.c -o "$dir/run.obj"
  x86_64-w64-mingw32-gcc "$dir/run.obj" -o "$dir/run.exe" -Wl,--defsym,__chkstk=___chkstk_ms
  said=$(HOME=$dir WINEPREFIX=$dir/wine WINEDEBUG=-all timeout 60 "$wine" "$dir/run.exe" 2>/dev/null | tr -d '\r')
  cc -O0 tests/msvc/run.c -o "$dir/run" -lm
  here_said=$("$dir/run")
  case $said in "level 2, self test ok, hit, t = 0."*) ;; *) fail "under wine: $said" ;; esac
  test "$said" = "$here_said" || fail "under wine: $said; as compiled here: $here_said"
  echo "msvc: under wine, by cl's ways: $said"
else
  echo "msvc: no wine64, no MinGW or no AVX-512: not run"
fi
