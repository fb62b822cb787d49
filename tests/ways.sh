#!/bin/bash
# The ways in beside README's own (newcomer.sh): from nothing to a verdict on two files of one's own. What a way's README holds,
# up to its first program and the commands behind it, is done word by word, in an empty folder, with an empty home; the last line
# said must be the verdict. Then the package's own tests. A table of what each way took; one that takes more seconds of a processor
# than its bound fails. ways.sh [NAME ...]: some of python npm rust firmware page. --mutants: are mistakes in a README noticed?
#
# Nothing here is published, and nothing is fetched: `instead` says what is done in the place of a command.
set -uo pipefail
here=$(cd "$(dirname "$0")/.." && pwd)
cd "$here" || exit 1
version=$(sed -n '1s/.* v\([0-9.]*\) .*/\1/p' neuralsvcd.h)
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
make=${MAKE:-make}
failures=0
fail() {
  echo "ways: $*" >&2
  failures=$((failures + 1))
}
skip() {
  echo "ways: $*: not tested"
}
quietly() {  # title, command: what it says is shown if it fails
  local title=$1
  shift
  "$@" >"$dir/log" 2>&1 || { tail -n 20 "$dir/log" >&2; fail "$title"; return 1; }
}
bytes() { cat "$@" | wc -c | tr -d ' '; }

# A, a box of 0 to 0.25 m as STL, and B, one of 0 to 1 m as OBJ: from 2 m aside to 0 they meet half way.
own_files() {
  local corner quad one
  for corner in 0 1 2 3 4 5 6 7; do
    echo "v $((corner & 1)) $((corner >> 1 & 1)) $((corner >> 2 & 1))"
  done >"$1/B.obj"
  for quad in '1 3 4 2' '5 6 8 7' '1 2 6 5' '3 7 8 4' '1 5 7 3' '2 4 8 6'; do echo "f $quad"; done >>"$1/B.obj"
  {
    echo solid A
    awk '$1 == "v" { n++; v[n] = "vertex " $2 / 4 " " $3 / 4 " " $4 / 4 }
      $1 == "f" { for (i = 3; i < 5; i++) printf "facet normal 0 0 0\nouter loop\n%s\n%s\n%s\nendloop\nendfacet\n", v[$2], v[$i], v[$(i + 1)] }' "$1/B.obj"
    echo endsolid A
  } >"$1/A.stl"
}

# What is done in the place of a command that needs what is not here.
instead() {
  case $1 in
    'python3 -m venv '*) echo "${1/venv/venv --system-site-packages}" ;;  # Debian's numpy
    'pip install '*) echo "$1 --quiet --no-index --no-build-isolation --disable-pip-version-check" ;;
    'npm install neuralsvcd') echo "npm install --silent --no-audit --no-fund --offline $package" ;;
    'cargo add neuralsvcd') echo "cargo add --quiet --offline --path $dir/crate" ;;
    'cargo run'*) echo "$1 --quiet --offline" ;;
    'git clone '*) echo "cp -r $dir/clone neuralsvcd.h" ;;
    *) echo "$1" ;;
  esac
}

# README's commands and its first program of a language, as a script. A program's file is named in backticks just before it.
script_of() {  # README, language
  local kind text
  awk -v begin="^\`\`\`$2(,.*)?$" '
    function comment_off(s) { sub(/(^|[ \t]+)#( .*|$)/, "", s); sub(/[ \t]+$/, "", s); return s }
    fence == "program" { if (/^```/) { print "end"; fence = ""; done = 1 } else print "text\t" $0; next }
    fence != "" && /^```/ { fence = ""; next }
    fence == "sh" || fence == "" && /^    [^ ]/ { s = comment_off($0); sub(/^    /, "", s); if (s != "") { print "run\t" s; runs += done }; next }
    fence != "" { next }
    $0 ~ begin { fence = "program"; print "write\t" file; next }
    /^```/ { fence = substr($0, 4) "?"; sub(/^sh\?$/, "sh", fence); next }
    done && runs && /[^ ]/ { exit }
    match($0, /`[A-Za-z_\/]+\.(py|mjs|rs)`/) { file = substr($0, RSTART + 1, RLENGTH - 2) }' "$1" |
    while IFS=$'\t' read -r kind text; do
      case $kind in
        run) instead "$text" ;;
        write) echo "cat >${text/#main.rs/src/main.rs} <<'END OF PROGRAM'" ;;
        text) printf '%s\n' "$text" ;;
        end) echo 'END OF PROGRAM' ;;
      esac
    done
}

run() {
  (cd "$dir/own" && env -i HOME="$dir/home" PATH="$(dirname "${cargo:-/usr/bin/cargo}"):/usr/local/bin:/usr/bin:/bin" \
    RUSTUP_HOME="${RUSTUP_HOME:-$HOME/.rustup}" CARGO_HOME="$dir/cargo" bash -eu "$dir/script") >"$dir/said" 2>"$dir/errors"
}
# A way: from an empty folder to its verdict.
follow() {  # name, bound, README, language, bytes of what is fetched, what the verdict's line must hold
  local name=$1 bound=$2 readme=$3 language=$4 fetched=$5 said=$6 seconds user system busy status TIMEFORMAT='%1R %1U %1S'
  rm -rf "$dir/own" && mkdir -p "$dir/own" "$dir/home"
  own_files "$dir/own"
  script_of "$readme" "$language" >"$dir/script"
  { time run; } 2>"$dir/time"
  status=$?
  read -r seconds user system <"$dir/time"
  busy=$(awk -v a="$user" -v b="$system" 'BEGIN { printf "%.0f", a + b }')
  test "$status" = 0 || { fail "$readme ends with $status: $(tail -n 4 "$dir/said" "$dir/errors")"; return 1; }
  grep -q -- "$said" "$dir/said" || { fail "$readme: no '$said' in what it says: $(cat "$dir/said" "$dir/errors")"; return 1; }
  test "$busy" -le "$bound" || fail "$name takes $busy s of a processor, more than $bound"
  echo "| $name | $fetched | $seconds | $busy of $bound |" >>"$dir/table"
}

can_wasm() {
  echo 'int main(void) { return 0; }' | "${WASM_CC:-clang}" --target=wasm32-wasi -x c - -o "$dir/can.wasm" 2>/dev/null
}

python() {
  /usr/bin/python3 -c 'import numpy, setuptools, wheel, pip, ensurepip' 2>/dev/null || { skip "python: no numpy, setuptools, wheel, pip or venv"; return; }
  # what a clone has, and no more
  rm -rf "$dir/clone" && mkdir "$dir/clone"
  git ls-files -z | while IFS= read -r -d '' file; do ! test -f "$file" || printf '%s\0' "$file"; done |
    tar --null --files-from=- -cf - | tar -C "$dir/clone" -xf -
  (cd examples/python && quietly "sdist" /usr/bin/python3 setup.py -q sdist -d "$dir") || return
  follow Python 90 examples/python/README.md python "$(bytes "$dir"/*.tar.gz)" '^hit 0.50$'
}

npm() {
  command -v node >/dev/null && command -v npm >/dev/null || { skip "npm: no node or no npm"; return; }
  can_wasm || { skip "npm: ${WASM_CC:-clang} cannot link for wasm32-wasi"; return; }
  quietly "make npm" "$make" -s npm || return
  package=$here/build/release/neuralsvcd-$version.tgz
  follow npm 30 packages/npm/README.md js "$(bytes "$package")" '^hit, t = 0.50$' || return
  cp examples/assets/mug.obj examples/assets/dish_rack.obj tests/npm.mjs "$dir/own/"
  (cd "$dir/own" && node --expose-gc npm.mjs) || fail "npm.mjs"
}

rust() {
  cargo=$(command -v cargo || echo "$HOME/.cargo/bin/cargo")
  test -x "$cargo" || { skip "rust: no cargo"; return; }
  export PATH=$(dirname "$cargo"):$PATH
  # In haste, but for the first verdict.
  local hasty="-O0 -DNSVCD_NO_DISPATCH"
  CFLAGS="$hasty" CARGO_TARGET_DIR="$dir/target" quietly "make crate" "$make" -s crate || return
  package=$here/build/release/neuralsvcd-$version.crate
  tar xzf "$package" -C "$dir" && mv "$dir/neuralsvcd-$version" "$dir/crate"
  follow Rust 90 packages/rust/README.md rust "$(bytes "$package")" '^hit, t = 0.50$' || return
  cd "$dir/crate" || return
  CFLAGS="$hasty" CARGO_TARGET_DIR="$dir/target" quietly "cargo test" cargo test --quiet --offline &&
    echo "ways: Rust: $(sed -n 's/.* \([0-9]*\) passed.*/\1/p' "$dir/log" | awk '{n += $1} END {print n}') tests"
  ! cargo clippy --version >/dev/null 2>&1 ||
    CFLAGS="$hasty" CARGO_TARGET_DIR="$dir/target" quietly clippy cargo clippy --quiet --offline --all-targets -- -D warnings
  cd "$here" || exit 1
}

page() {  # the first verdict: its tests are check-web
  local seconds
  /usr/bin/python3 -c 'import selenium' 2>/dev/null && command -v chromedriver >/dev/null || { skip "page: no chromedriver or python3-selenium"; return; }
  can_wasm || { skip "page: ${WASM_CC:-clang} cannot link for wasm32-wasi"; return; }
  quietly "make web" "$make" -s web || return
  rm -rf "$dir/own" && mkdir -p "$dir/own" && own_files "$dir/own"
  seconds=$(/usr/bin/python3 tests/ways_page.py build/web/index.html "$dir/own/A.stl" "$dir/own/B.obj" 2>"$dir/errors") ||
    { fail "page: $(tail -n 3 "$dir/errors")"; return; }
  awk -v a="$seconds" 'BEGIN { exit !(a < 20) }' || fail "page takes $seconds s, more than 20"
  echo "| page | $(bytes build/web/index.html) | $seconds | |" >>"$dir/table"
}

# A small README that passes, and mistakes in it, each of which must be noticed.
mutants() {
  local name text change status ends=0
  cat >"$dir/small.md" <<'MD'
# A small one

    cp A.stl C.stl     # any file

This is `first.py`:

```python
import os
print("hit 0.50" if os.path.exists("C.stl") and os.path.exists("B.obj") else "free")
```

    /usr/bin/python3 first.py

Later:

    a command that is not run
MD
  while IFS='|' read -r name text change; do
    sed -e "$change" "$dir/small.md" >"$dir/mutant.md"
    (failures=0; follow small 3 "$dir/mutant.md" python 0 '^hit 0.50$'; exit $((failures > 0))) >"$dir/mutant" 2>&1
    status=$?
    if test "$name" = none; then
      test $status = 0 || { echo "ways: the small README fails:"; cat "$dir/mutant"; ends=1; }
    elif cmp -s "$dir/small.md" "$dir/mutant.md" || test $status = 0 || ! grep -q -- "$text" "$dir/mutant"; then
      echo "ways: not noticed: $name"; cat "$dir/mutant"; ends=1
    else
      echo "ways: noticed: $name"
    fi
  done <<'MUTANTS'
none||
a command that is not there|not found|s,^    cp A,    cq A,
a file that is not there|No such file|s,cp A.stl,cp D.stl,
a program of another name|first.py|s,`first.py`,`second.py`,
a typo in the program|NameError|s,os.path,so.path,
another verdict|no .^hit|s,hit 0.50,hit 0.60,
a program that no command runs|no .^hit|s,^    /usr/bin/python3 first.py,    true,
too slow|more than 3|s,^    cp,    (ulimit -t 6; while true; do true; done) || true; cp,
MUTANTS
  return $ends
}

if test "${1:-}" = --mutants; then
  mutants
  exit
fi
for way in "${@:-python npm rust page}"; do
  for one in $way; do "$one"; done
done
if test -s "$dir/table"; then
  echo "| way | bytes | seconds | of a processor |"
  echo "|---|---|---|---|"
  cat "$dir/table"
fi
test "$failures" = 0 || { echo "ways: $failures failed"; exit 1; }
echo "ways: each README does what it says"
