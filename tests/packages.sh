#!/bin/sh
# What `make install` puts where, and that pkg-config, CMake, Meson and a project with a copy of its own find it there: each
# way compiles packages/project/main.c and asks it. Ends with 1 at the first thing that is wrong.
set -eu
CC=${CC:-cc}
dir=$(mktemp -d)
# What is compiled in haste here must not be what `make install` finds afterwards.
hasty="build/installed build/library.o build/libneuralsvcd.a build/libneuralsvcd.so build/libneuralsvcd.dylib"
rm -rf $hasty
trap 'rm -rf "$dir" $hasty' EXIT
here=$(pwd)
main=$here/packages/project/main.c
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

CC="$CC" tests/version.sh
version=$(sed -n '1s/.* v\([0-9.]*\) .*/\1/p' neuralsvcd.h)
minor=${version%.*}

prefix=$dir/usr
${MAKE:-make} -s install PREFIX="$prefix" LIBRARY_CFLAGS=-O0 CC="$CC" || fail "make install"
export LD_LIBRARY_PATH="$prefix/lib"
case $("$prefix/bin/svcd" --version) in *"$version"*) ;; *) fail "svcd --version: $("$prefix/bin/svcd" --version)" ;; esac
head -1 "$prefix/share/man/man1/svcd.1" | grep -q '^\.TH' || fail "svcd.1 is no manual"
# The checker's headers, of which a program needs no other; what every way of installing brings.
cat >"$dir/checks.c" <<'END'
#include <nsvcd_verify.h>
#include <nsvcd_verify_claim.h>
int main(void) { return sizeof(nsvcd_verify_report) == 0; }
END
is_whole() {  # prefix, title
  "$CC" -std=c99 -O0 -w -I"$1/include/neuralsvcd" "$dir/checks.c" -o "$dir/checks" -lm && "$dir/checks" || fail "$2: the checker's headers"
  cmp -s LICENSE "$1/share/doc/neuralsvcd/LICENSE" || fail "$2: no LICENSE"
  cmp -s examples/FORMATS.md "$1/share/doc/neuralsvcd/FORMATS.md" || fail "$2: no FORMATS.md"
}
is_whole "$prefix" "make install"
if command -v man >/dev/null; then
  for page in svcd svcd-verify; do
    man -M "$prefix/share/man" "$page" | grep -q 'svcd-verify \[--pairs\] FILE.txt FOLDER' || fail "man $page has no svcd-verify"
  done
fi
test -s "$prefix/share/bash-completion/completions/svcd" && test -x "$prefix/bin/svcd-verify" || fail "make install: no completions, or no svcd-verify"

if command -v pkg-config >/dev/null; then
  export PKG_CONFIG_PATH="$prefix/lib/pkgconfig"
  test "$(pkg-config --modversion neuralsvcd)" = "$version" || fail "pkg-config's version"
  pkg-config --exists "neuralsvcd >= $minor neuralsvcd < $minor.99" || fail "pkg-config refuses $minor"
  ! pkg-config --exists "neuralsvcd >= $minor.99" || fail "pkg-config accepts $minor.99"
  "$CC" -std=c99 -O0 -DNEURALSVCD_IMPLEMENTATION $(pkg-config --cflags neuralsvcd) "$main" -o "$dir/header" $(pkg-config --libs neuralsvcd)
  runs "pkg-config neuralsvcd" "$dir/header"
  "$CC" -std=c99 -O0 $(pkg-config --cflags neuralsvcd-library) "$main" -o "$dir/library" $(pkg-config --libs neuralsvcd-library)
  runs "pkg-config neuralsvcd-library" "$dir/library"
else
  echo "packages: no pkg-config: not tested"
fi

# One file, and nothing beside it; all functions static, nothing unused said.
${MAKE:-make} -s release
cp build/release/neuralsvcd.h "$dir/"
"$CC" -std=c99 -O0 -Wall -Wextra -Werror -I"$dir" -DNEURALSVCD_IMPLEMENTATION "$main" -o "$dir/single" -lm
runs "one file" "$dir/single"

if command -v cmake >/dev/null; then
  project=$here/packages/project
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
  cmake -S "$here" -B "$dir/own" -DCMAKE_C_COMPILER="$CC" -DCMAKE_INSTALL_PREFIX="$dir/cmake_usr" -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_FLAGS_RELEASE=-O0 -DNEURALSVCD_PROGRAMS=ON >"$dir/own.txt" 2>&1 &&
    cmake --build "$dir/own" >>"$dir/own.txt" 2>&1 && cmake --install "$dir/own" >>"$dir/own.txt" 2>&1 || { cat "$dir/own.txt" >&2; fail "cmake --install"; }
  cmake_runs "find_package after cmake --install" -DCMAKE_PREFIX_PATH="$dir/cmake_usr"
  versions "$dir/cmake_usr"
  is_whole "$dir/cmake_usr" "cmake --install"
  "$dir/cmake_usr/bin/svcd" --version >/dev/null && test -x "$dir/cmake_usr/bin/svcd-verify" || fail "cmake --install: no svcd, or no svcd-verify"
  # The portfile, as far as it goes without vcpkg: what that gives it, in short, on what is built already.
  cat >"$dir/port.cmake" <<'END'
function(vcpkg_cmake_configure)
  cmake_parse_arguments(with "" SOURCE_PATH "" ${ARGN})
  if(NOT EXISTS "${with_SOURCE_PATH}/CMakeLists.txt")
    message(FATAL_ERROR "no CMakeLists.txt in ${with_SOURCE_PATH}")
  endif()
endfunction()
function(vcpkg_cmake_install)
  execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILT} --prefix ${CURRENT_PACKAGES_DIR} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endfunction()
function(vcpkg_cmake_config_fixup)
  cmake_parse_arguments(with "" CONFIG_PATH "" ${ARGN})
  if(NOT EXISTS "${CURRENT_PACKAGES_DIR}/${with_CONFIG_PATH}/neuralsvcdConfig.cmake")
    message(FATAL_ERROR "no neuralsvcdConfig.cmake in ${with_CONFIG_PATH}")
  endif()
endfunction()
function(vcpkg_fixup_pkgconfig)
endfunction()
function(vcpkg_copy_pdbs)
endfunction()
function(vcpkg_install_copyright)
  cmake_parse_arguments(with "" "" FILE_LIST ${ARGN})
  file(INSTALL ${with_FILE_LIST} DESTINATION ${CURRENT_PACKAGES_DIR}/share/${PORT} RENAME copyright)
endfunction()
include(${PORT_FILE})
END
  cmake -DCURRENT_PACKAGES_DIR="$dir/port" -DPORT=neuralsvcd -DBUILT="$dir/own" -DPORT_FILE="$here/packages/vcpkg/neuralsvcd/portfile.cmake" \
    -P "$dir/port.cmake" >"$dir/port.txt" 2>&1 || { cat "$dir/port.txt" >&2; fail "the portfile"; }
  test -f "$dir/port/share/neuralsvcd/copyright" && test -f "$dir/port/share/neuralsvcd/usage" || fail "the portfile installs no licence, or no usage"
  echo "packages: the portfile of vcpkg, on stand-ins for its functions"
  echo "packages: find_package takes $minor, $version EXACT, and no other"
else
  echo "packages: no cmake: not tested"
fi

if command -v meson >/dev/null; then
  meson_runs() {  # title, folder: both programs
    { CC="$CC" meson setup "$dir/meson" "$2" -Doptimization=0 && ninja -C "$dir/meson"; } >"$dir/meson.txt" 2>&1 || { cat "$dir/meson.txt" >&2; fail "$1"; }
    runs "$1, header" "$dir/meson/with_header"
    runs "$1, library" "$dir/meson/with_library"
    rm -rf "$dir/meson"
  }
  meson_runs "Meson, by pkg-config" "$here/packages/project"
  cp -r packages/project "$dir/wrapped"
  mkdir -p "$dir/wrapped/subprojects/neuralsvcd/packages"
  cp packages/meson/neuralsvcd.wrap "$dir/wrapped/subprojects/"
  cp -r meson.build neuralsvcd.h weights.h extras "$dir/wrapped/subprojects/neuralsvcd/"  # as git would have fetched it
  cp packages/neuralsvcd.c "$dir/wrapped/subprojects/neuralsvcd/packages/"
  unset PKG_CONFIG_PATH
  meson_runs "Meson, as a subproject" "$dir/wrapped"
  { CC="$CC" meson setup "$dir/meson" "$here" --prefix="$dir/meson_usr" -Doptimization=0 && meson install -C "$dir/meson"; } >"$dir/meson.txt" 2>&1 ||
    { cat "$dir/meson.txt" >&2; fail "meson install"; }
  found=$(PKG_CONFIG_PATH=$(dirname "$(find "$dir/meson_usr" -name neuralsvcd.pc)") pkg-config --modversion neuralsvcd-library)
  test "$found" = "$version" || fail "meson install: pkg-config finds $found"
  is_whole "$dir/meson_usr" "meson install"
else
  echo "packages: no meson: not tested"
fi

${MAKE:-make} -s uninstall PREFIX="$prefix"
left=$(find "$prefix" -type f -o -type l)
test -z "$left" || fail "make uninstall leaves $left"
echo "packages: make uninstall leaves nothing"
