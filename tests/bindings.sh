#!/bin/sh
# The packages for other languages, as they are published: each is made, put into an empty folder, and asked hello.c's question
# by the program of its own README; then its own tests. Ends with 1 at the first thing that is wrong.
set -eu
here=$(pwd)
version=$(sed -n '1s/.* v\([0-9.]*\) .*/\1/p' neuralsvcd.h)
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
fail() {
  echo "bindings: $*" >&2
  exit 1
}
# readme LANGUAGE FILE: its first program.
readme() {
  awk -v begin="\`\`\`$1" '$0 == begin && !done {on = 1; next} /^```/ {done = done || on; on = 0} on' "$2"
}
said() {  # title, what it says, seconds when it began, bytes
  test "$(echo "$2" | head -1)" = 'hit, t = 0.60' || fail "$1 says: $2"
  echo "bindings: $1: hit, t = 0.60 after $(($(date +%s) - $3)) s, from a package of $4 bytes"
}
bytes() {
  wc -c <"$1" | tr -d ' '
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
  start=$(date +%s)
  npm install --silent --no-audit --no-fund --offline "$package" >/dev/null || fail "npm install"
  readme js node_modules/neuralsvcd/README.md >hello.mjs
  said "npm" "$(node hello.mjs)" "$start" "$(bytes "$package")"
  cp "$here/tests/bindings.mjs" . && node --expose-gc bindings.mjs || fail "bindings.mjs"
  cd "$here"
fi

cargo=$(command -v cargo || echo "$HOME/.cargo/bin/cargo")
if ! test -x "$cargo"; then
  echo "bindings: no cargo: not tested"
else
  PATH=$(dirname "$cargo"):$PATH
  export CARGO_TARGET_DIR="$dir/target"
  # In haste, but for the first verdict.
  CFLAGS="-O0 -DNSVCD_NO_DISPATCH" ${MAKE:-make} -s crate >"$dir/crate.txt" 2>&1 || { cat "$dir/crate.txt" >&2; fail "make crate"; }
  package=$here/build/release/neuralsvcd-$version.crate
  mkdir -p "$dir/rust/src" && cd "$dir/rust"
  tar xzf "$package" && mv neuralsvcd-* neuralsvcd
  cp "$here/examples/assets/mug.obj" "$here/examples/assets/dish_rack.obj" .
  printf '[package]\nname = "hello"\nversion = "0.1.0"\nedition = "2021"\n[dependencies]\nneuralsvcd = { path = "neuralsvcd" }\n' >Cargo.toml
  readme rust,no_run neuralsvcd/README.md >src/main.rs
  start=$(date +%s)
  said "Rust" "$(unset CFLAGS; cargo run --quiet --offline)" "$start" "$(bytes "$package")"
  cd neuralsvcd
  CFLAGS="-O0 -DNSVCD_NO_DISPATCH" cargo test --quiet --offline >"$dir/rust.txt" 2>&1 || { cat "$dir/rust.txt" >&2; fail "cargo test"; }
  echo "bindings: Rust: $(sed -n 's/.* \([0-9]*\) passed.*/\1/p' "$dir/rust.txt" | awk '{n += $1} END {print n}') tests"
  ! cargo clippy --version >/dev/null 2>&1 || CFLAGS="-O0 -DNSVCD_NO_DISPATCH" cargo clippy --quiet --offline --all-targets -- -D warnings || fail "clippy"
fi
