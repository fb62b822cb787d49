#!/bin/sh
# One version everywhere: the header's first line, its macros, CHANGELOG, Python's package, the recipes, and the tag vX.Y.Z of
# this commit if it has one. And one version of the blob. Ends with 1 at the first that differs.
set -eu
fail() {
  echo "version: $*" >&2
  exit 1
}
version=$(sed -n '1s/.* v\([0-9.]*\) .*/\1/p' neuralsvcd.h)
minor=${version%.*}
test -n "$version" || fail "none in the header's first line"
macros=$(printf '#include "neuralsvcd.h"\nNSVCD_VERSION NSVCD_VERSION_MAJOR NSVCD_VERSION_MINOR NSVCD_VERSION_PATCH\n' | "${CC:-cc}" -E -P -I. -x c - | tail -1)
test "$macros" = "\"$version\" $(echo "$version" | tr . ' ')" || fail "the macros say $macros, the first line $version"
changes=$(sed -n '/^## /{s/^## \([0-9.]*\).*/\1/p;q;}' CHANGELOG.md)
test "$changes" = "$version" || fail "CHANGELOG begins with $changes, not $version"
blob=$(sed -n 's/^#define NSVCD__BODY_VERSION \([0-9]*\).*/\1/p' neuralsvcd.h)
named=$(sed -n "/^## $version/,/^## 0.1/s/.*blob's version is \([0-9]*\).*/\1/p" CHANGELOG.md)
test -n "$blob" && test "$named" = "$blob" || fail "the blob's version is $blob; CHANGELOG: $named"

# What cannot read the header names it. CMakeLists.txt, setup.py and packages/conan read it.
says() {  # file, text
  grep -qF -- "$2" "$1" || fail "$1 does not say $2"
}
says meson.build "version: '$version'"
says examples/FORMATS.md "## Body files, version $blob"
says examples/FORMATS.md "| 4 | uint32 | version, $blob |"
says packages/meson/neuralsvcd.wrap "revision = v$version"
says packages/vcpkg/neuralsvcd/vcpkg.json "\"version\": \"$version\""
says packages/npm/package.json "\"version\": \"$version\""
says packages/rust/Cargo.toml "version = \"$version\""
says packages/vcpkg/neuralsvcd/usage "find_package(neuralsvcd $minor "
says packages/project/CMakeLists.txt "find_package(neuralsvcd $minor "
says packages/project/meson.build "'>=$minor', '<${version%%.*}.$((${minor#*.} + 1))'"
if python3 -c 'import setuptools' 2>/dev/null; then
  python=$(cd examples/python && python3 -B setup.py --version 2>/dev/null)
  test "$python" = "$version" || fail "setup.py says $python"
fi
# A tag is a release: its changes are no longer `unreleased`.
for tag in $(git tag --points-at HEAD 'v*' 2>/dev/null); do
  test "$tag" = "v$version" || fail "the tag is $tag, the header's first line says $version"
  ! grep -q "^## $version.*unreleased" CHANGELOG.md || fail "the tag is $tag, and CHANGELOG says unreleased"
done
for file in neuralsvcd.h weights.h examples/svcd.c examples/quickstart.c examples/plan.c examples/verify/*.[ch] \
  examples/python/_*.c examples/python/*/*.py packages/project/main.c packages/npm/neuralsvcd.js packages/npm/neuralsvcd.d.ts packages/npm/glue.c \
  packages/rust/src/*.[cr]* packages/trajectory/*.[ch]*; do
  head -2 "$file" | grep -qE '^(//|#) SPDX-License-Identifier: MIT$' || fail "no SPDX line in $file"
done
echo "version: $version everywhere; SPDX lines"
