#!/bin/sh
# The packages for other languages, as they are published: each is made, put into an empty folder, and its own tests are run.
# What their READMEs say, tests/ways.sh does after this. Ends with 1 at the first thing that is wrong.
set -eu
here=$(pwd)
version=$(sed -n '1s/.* v\([0-9.]*\) .*/\1/p' neuralsvcd.h)
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
fail() {
  echo "bindings: $*" >&2
  exit 1
}

can_wasm() {
  echo 'int main(void) { return 0; }' | "${WASM_CC:-clang}" --target=wasm32-wasi -x c - -o "$dir/can.wasm" 2>/dev/null
}
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  echo "bindings: no node or no npm: not tested"
elif ! can_wasm; then
  echo "bindings: ${WASM_CC:-clang} cannot link for wasm32-wasi: not tested"
else
  ${MAKE:-make} -s npm >"$dir/npm.txt" 2>&1 || { cat "$dir/npm.txt" >&2; fail "make npm"; }
  package=$here/build/release/neuralsvcd-$version.tgz
  mkdir "$dir/node" && cd "$dir/node"
  cp "$here/examples/assets/mug.obj" "$here/examples/assets/dish_rack.obj" .
  npm install --silent --no-audit --no-fund --offline "$package" >/dev/null || fail "npm install"
  cp "$here/tests/bindings.mjs" . && node --expose-gc bindings.mjs || fail "bindings.mjs"
  cd "$here"
fi

cargo=$(command -v cargo || echo "$HOME/.cargo/bin/cargo")
if ! test -x "$cargo"; then
  echo "bindings: no cargo: not tested"
else
  PATH=$(dirname "$cargo"):$PATH
  export CARGO_TARGET_DIR="$dir/target"
  # In haste.
  export CFLAGS="-O0 -DNSVCD_NO_DISPATCH"
  ${MAKE:-make} -s crate >"$dir/crate.txt" 2>&1 || { cat "$dir/crate.txt" >&2; fail "make crate"; }
  tar xzf "$here/build/release/neuralsvcd-$version.crate" -C "$dir" && cd "$dir/neuralsvcd-$version"
  cargo test --quiet --offline >"$dir/rust.txt" 2>&1 || { cat "$dir/rust.txt" >&2; fail "cargo test"; }
  echo "bindings: Rust: $(sed -n 's/.* \([0-9]*\) passed.*/\1/p' "$dir/rust.txt" | awk '{n += $1} END {print n}') tests"
  ! cargo clippy --version >/dev/null 2>&1 || cargo clippy --quiet --offline --all-targets -- -D warnings || fail "clippy"
fi
