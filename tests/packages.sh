#!/bin/sh
# What `make install` puts where, and that pkg-config, CMake and a project with a copy of its own find it there: each way
# compiles examples/packages/project/main.c and asks it. Ends with 1 at the first thing that is wrong.
set -eu
CC=${CC:-cc}
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
here=$(pwd)
main=$here/examples/packages/project/main.c
mug=$here/examples/assets/mug.obj

fail() {
  echo "packages: $*" >&2
  exit 1
}
# A mug is 0.095 m high: they touch at 0.81, and no later than 0.01 after that is asked for.
runs() {  # title, program
  said=$("$2" "$mug") || fail "$1: ends with $?"
  case $said in "hits at 0.81" | "hits at 0.82") ;; *) fail "$1: says $said" ;; esac
  echo "packages: $1"
}

# One version: in the header's first line, in its macros, in CHANGELOG; and one version of the blob.
version=$(sed -n '1s/.* v\([0-9.]*\) .*/\1/p' neuralsvcd.h)
minor=${version%.*}
printf '#include "neuralsvcd.h"\nNSVCD_VERSION NSVCD_VERSION_MAJOR NSVCD_VERSION_MINOR NSVCD_VERSION_PATCH\n' >"$dir/version.c"
macros=$("$CC" -E -P -I"$here" "$dir/version.c" | tail -1)
test "$macros" = "\"$version\" $(echo "$version" | tr . ' ')" || fail "the macros say $macros, the first line $version"
changes=$(sed -n '/^## /{s/^## \([0-9.]*\).*/\1/p;q;}' CHANGELOG.md)
test "$changes" = "$version" || fail "CHANGELOG begins with $changes, not $version"
blob=$(sed -n 's/^#define NSVCD__BODY_VERSION \([0-9]*\).*/\1/p' neuralsvcd.h)
named=$(sed -n "/^## $version/,/^## 0.1/s/.*blob's version is \([0-9]*\).*/\1/p" CHANGELOG.md)
test -n "$blob" && test "$named" = "$blob" || fail "the blob's version is $blob; CHANGELOG: $named"

prefix=$dir/usr
${MAKE:-make} -s install PREFIX="$prefix" LIBRARY_CFLAGS=-O0 CC="$CC" || fail "make install"
export LD_LIBRARY_PATH="$prefix/lib"

if command -v pkg-config >/dev/null; then
  export PKG_CONFIG_PATH="$prefix/lib/pkgconfig"
  test "$(pkg-config --modversion neuralsvcd)" = "$version" || fail "pkg-config's version"
  "$CC" -std=c99 -O1 -DNEURALSVCD_IMPLEMENTATION $(pkg-config --cflags neuralsvcd) "$main" -o "$dir/header" $(pkg-config --libs neuralsvcd)
  runs "pkg-config neuralsvcd" "$dir/header"
  "$CC" -std=c99 -O1 $(pkg-config --cflags neuralsvcd-library) "$main" -o "$dir/library" $(pkg-config --libs neuralsvcd-library)
  runs "pkg-config neuralsvcd-library" "$dir/library"
else
  echo "packages: no pkg-config: not tested"
fi

# One file, and nothing beside it; all functions static, nothing unused said.
${MAKE:-make} -s release
cp build/release/neuralsvcd.h "$dir/"
"$CC" -std=c99 -O1 -Wall -Wextra -Werror -I"$dir" -DNEURALSVCD_IMPLEMENTATION "$main" -o "$dir/single" -lm
runs "one file" "$dir/single"

if command -v cmake >/dev/null; then
  project=$here/examples/packages/project
  cmake_runs() {  # title, cmake's arguments: both programs
    title=$1
    shift
    cmake -S "$project" -B "$dir/cmake" -DCMAKE_C_COMPILER="$CC" -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_FLAGS_RELEASE=-O0 "$@" >"$dir/cmake.txt" 2>&1 &&
      cmake --build "$dir/cmake" >>"$dir/cmake.txt" 2>&1 || { cat "$dir/cmake.txt" >&2; fail "$title"; }
    runs "$title, header" "$dir/cmake/with_header"
    runs "$title, library" "$dir/cmake/with_library"
    rm -rf "$dir/cmake"
  }
  # Before 1.0 a minor version is a promise of its own.
  asks() {  # prefix, version wanted, 0: found, 1: refused
    mkdir -p "$dir/ask"
    printf 'cmake_minimum_required(VERSION 3.14)\nproject(ask LANGUAGES C)\nfind_package(neuralsvcd %s REQUIRED)\n' "$2" >"$dir/ask/CMakeLists.txt"
    got=0
    cmake -S "$dir/ask" -B "$dir/ask/build" -DCMAKE_C_COMPILER="$CC" -DCMAKE_PREFIX_PATH="$1" >"$dir/ask.txt" 2>&1 || got=1
    test "$got" = "$3" || fail "find_package(neuralsvcd $2) in $1: $(test "$3" = 0 && echo refused || echo accepted)"
    rm -rf "$dir/ask"
  }
  versions() {  # prefix
    asks "$1" '' 0
    asks "$1" "$version EXACT" 0
    asks "$1" "$minor" 0
    asks "$1" 0.2 1
    asks "$1" 0.4 1
    asks "$1" "$minor.99" 1
    asks "$1" 1.0 1
  }
  versions "$prefix"
  cmake_runs "find_package after make install, static" -DCMAKE_PREFIX_PATH="$prefix"
  cmake_runs "find_package after make install, shared" -DCMAKE_PREFIX_PATH="$prefix" -DBUILD_SHARED_LIBS=ON
  cmake_runs "add_subdirectory, shared" -DSOURCE="$here" -DBUILD_SHARED_LIBS=ON
  cmake -S "$here" -B "$dir/own" -DCMAKE_C_COMPILER="$CC" -DCMAKE_INSTALL_PREFIX="$dir/cmake_usr" -DCMAKE_C_FLAGS=-O0 >"$dir/own.txt" 2>&1 &&
    cmake --build "$dir/own" >>"$dir/own.txt" 2>&1 && cmake --install "$dir/own" >>"$dir/own.txt" 2>&1 || { cat "$dir/own.txt" >&2; fail "cmake --install"; }
  cmake_runs "find_package after cmake --install" -DCMAKE_PREFIX_PATH="$dir/cmake_usr"
  versions "$dir/cmake_usr"
  echo "packages: find_package takes $minor, $version EXACT, and no other"
else
  echo "packages: no cmake: not tested"
fi

${MAKE:-make} -s uninstall PREFIX="$prefix"
left=$(find "$prefix" -type f -o -type l)
test -z "$left" || fail "make uninstall leaves $left"
echo "packages: make uninstall leaves nothing"
