#!/bin/bash
# Each way from nothing to a first verdict on one's own mesh, word by word by its README: ways.sh [WAY...]; --mutants: are mistakes
# noticed? In an empty folder and HOME and a clean environment with the tools of this machine: a bare root for each would take
# minutes. pip, npm and cargo are offline. What is not published yet is taken from what `make npm` and `make crate` make.
# 1. The commands are the first block of commands of the README, each by itself, as newcomer.sh reads it.
# 2. The program is its first block fenced in its language, in the file that stands in `program`, below.
# 3. The newcomer has A and B, .obj and binary .stl. The program must say hit, and with A's end above B free.
# 4. All before the first verdict must take less than `bound` seconds of a processor. Wall seconds are printed, and not held:
#    other work runs beside it.
# Prints a row of a table for each way: wall seconds, processor seconds, bytes of what is fetched. Ends with 1 if a way fails.
. "$(dirname "$0")/newcomer.sh"
version=$(sed -n '1s/.* v\([0-9.]*\) .*/\1/p' neuralsvcd.h)
PATH=$PATH:$HOME/.cargo/bin
root= readme= sum=0 busy=0
rows=$dir/rows
ALL='svcd c release installed cmake meson python npm rust page firmware trajectory'
declare -A title=([svcd]='`svcd`, from a clone' [c]='C, two files copied' [release]='C, the one file of `make release`'
  [installed]='C, `make install` and pkg-config' [cmake]='CMake, `add_subdirectory`' [meson]='Meson, a subproject'
  [python]='Python, `pip install` from a clone' [npm]='npm' [rust]='Rust' [page]='the page' [firmware]='firmware, under QEMU'
  [trajectory]='trajectories, the robot of the repository')
declare -A bound=([python]=90 [npm]=30 [rust]=90 [page]=20)
declare -A text=([python]=examples/python/README.md [npm]=packages/npm/README.md [rust]=packages/rust/README.md
  [firmware]=examples/firmware/README.md [trajectory]=packages/trajectory/README.md)
declare -A program=([python]='python first.py' [npm]='js first.mjs' [rust]='rust,no_run src/main.rs')
# How the newcomer writes that A ends above B.
declare -A higher=([python]='s/\[0, 0, 0\]/[0, 0, 1.5]/' [npm]='s/\[0, 0, 0, 0, 0, 0, 1\]/[0, 0, 1.5, 0, 0, 0, 1]/'
  [rust]='s/at(\[0.0, 0.0, 0.0\])/at([0.0, 0.0, 1.5])/' [firmware]='s/TO=0,0,0/TO=0,0,1.5/')

bytes() { cat "$@" | wc -c; }
clone() { git archive HEAD 2>/dev/null | gzip -c | wc -c; }  # as a download of the repository
lacks() {  # a tool of this way that is not there
  local tool
  case $1 in
    python) /usr/bin/python3 -c 'import numpy, setuptools, wheel, venv, ensurepip' 2>/dev/null || echo "python3 with numpy, setuptools, wheel and venv" ;;
    npm) test -e "build/release/neuralsvcd-$version.tgz" || echo "archive of make npm" ;;
    rust) test -e "build/release/neuralsvcd-$version.crate" || echo "archive of make crate" ;;
    page) test -e build/web/index.html || echo "page of make web"
      /usr/bin/python3 -c 'import selenium' 2>/dev/null || echo "python3-selenium" ;;
  esac
  for tool in $(case $1 in
    installed) echo make pkg-config ;; cmake) echo cmake ;; meson) echo meson ninja ;; npm) echo node npm ;; rust) echo cargo rustc ;;
    page) echo chromedriver ;; firmware) echo arm-none-eabi-gcc qemu-system-arm ;; trajectory) echo python3 ;;
  esac); do command -v "$tool" >/dev/null || echo "$tool"; done
}
# What the way is followed in: $copy, and how many bytes have been fetched for it: $fetched.
prepare() {
  local archive=$here/build/release/neuralsvcd-$version
  copy=$dir/own
  environment=(PATH=/usr/bin:/bin PIP_NO_INDEX=1 PIP_NO_BUILD_ISOLATION=0 PIP_DISABLE_PIP_VERSION_CHECK=1 npm_config_offline=true CARGO_NET_OFFLINE=true)
  rm -rf "$copy" && mkdir -p "$copy"
  case $1 in
    npm) fetched=$(bytes "$archive.tgz") ;;
    rust) fetched=$(bytes "$archive.crate")
      environment+=("PATH=$(rustc --print sysroot)/bin:/usr/bin:/bin")
      tar xzf "$archive.crate" -C "$dir" ;;
    page) fetched=$(bytes build/web/index.html) ;;
    c) fetched=$(bytes neuralsvcd.h weights.h); cp neuralsvcd.h weights.h "$copy/" ;;
    release) make -s release && fetched=$(bytes build/release/neuralsvcd.h); cp build/release/neuralsvcd.h "$copy/" ;;
    *) fetched=$(clone); fresh_copy README.md ;;
  esac
  own_files
}
# What is typed in the place of a command, for nothing is published.
typed() {
  case $1 in
    'npm install neuralsvcd') echo "npm install $here/build/release/neuralsvcd-$version.tgz" ;;
    'cargo add neuralsvcd') echo "cargo add --path ../neuralsvcd-$version" ;;
    *) echo "$1" ;;
  esac
}
# hello.c on the newcomer's meshes and path; with a compiled library it has no implementation.
hello() {
  sed -e "$(case $1 in installed | cmake | meson) echo /NEURALSVCD_IMPLEMENTATION/d ;; esac)" -e 's,examples/assets/mug,A,; s,examples/assets/dish_rack,B,; s,"../neuralsvcd.h",<neuralsvcd.h>,' -e 's/{0, -0.4f, 0.3f}/{0, 0, 2}/' "$here/examples/hello.c"
}
# The lines of what a way does; the README's own where there are any.
commands() {
  local build='cp -r packages/project own'
  case $1 in
    svcd) echo 'cc -O2 examples/svcd.c -o svcd -lm'; echo './svcd sweep A.stl B.obj' ;;
    c | release) echo 'cc -O2 -I. hello.c -lm'; echo ./a.out ;;
    installed) echo "make install PREFIX=$dir/usr"
      echo "PKG_CONFIG_PATH=$dir/usr/lib/pkgconfig; export PKG_CONFIG_PATH; cc hello.c \$(pkg-config --cflags --libs neuralsvcd-library)"
      echo "LD_LIBRARY_PATH=$dir/usr/lib ./a.out" ;;
    cmake) echo "$build && cp hello.c own/main.c"
      echo 'cmake -S own -B made -DSOURCE=$PWD -DCMAKE_BUILD_TYPE=Release && cmake --build made --target with_library'; echo 'made/with_library' ;;
    meson) echo "$build && cp hello.c own/main.c && mkdir own/subprojects && git clone -q $here own/subprojects/neuralsvcd"
      echo 'meson setup made own && meson compile -C made with_library'; echo 'made/with_library' ;;
    *) awk -F'\t' '$1 == "run" { if (last && $2 > last + 1) exit; print $3; last = $2 }' "$dir/parts" ;;
  esac
}
# follow WAY: all its commands; what the last says is the verdict. Then again the last, or what compiles and it, with A higher.
follow_way() {
  local way=$1 line last='' file=''
  sum=0 busy=0
  prepare "$way"
  readme=${text[$way]:-$way}
  if test -n "${text[$way]:-}"; then
    read_readme "${README:-$readme}" "$dir/unused.c" >"$dir/parts"
    if test -n "${program[$way]:-}"; then
      file=$copy/${program[$way]#* }
      mkdir -p "$(dirname "$file")"
      awk -v begin="\`\`\`${program[$way]% *}" '$0 == begin && !done { on = 1; next } /^```/ { done = done || on; on = 0 } on' \
        "${README:-$readme}" >"$file"
      test -s "$file" || { fail "$readme: no program"; return; }
      test "$(grep -c . "$file")" -le 10 || fail "$readme: its first program has more than 10 lines"
      grep -q "$(basename "$file")" "${README:-$readme}" || fail "$readme: does not name $(basename "$file")"
    fi
  else
    hello "$way" >"$copy/hello.c"
  fi
  commands "$way" >"$dir/commands"
  test -s "$dir/commands" || { fail "$readme: no command"; return; }
  while IFS= read -r line; do
    step "" "$(typed "$line")" || return
    last=$line
  done <"$dir/commands"
  local seconds=$sum processor=$busy
  case $way in
    trajectory) grep -q ' stops: left_finger, person' "$dir/said" || fail "$readme: no verdict: $(head -1 "$dir/said")" ;;
    *) grep -q '^hit' "$dir/said" || fail "$readme: no hit: $(tail -n 3 "$dir/said")"
      free "$way" "$file" "$last" ;;
  esac
  row "$way" "$seconds" "$processor"
}
free() {  # WAY FILE LAST: with A ending above B it is free
  local other=$3
  case $1 in
    svcd) other="./svcd sweep A.stl B.obj --from 0,0,2 --to 0,0,1.5" ;;
    firmware) other=$(echo "$3" | sed "${higher[$1]}"); test "$other" != "$3" || fail "$readme: no TO" ;;
    c | release | installed | cmake | meson) return ;;  # the same library, of which svcd, Python and others have said it
    *) cp "$2" "$dir/before"
      sed -i "${higher[$1]}" "$2"
      ! cmp -s "$2" "$dir/before" || fail "$readme: A's end is not found" ;;
  esac
  step "" "$other" && grep -q '^free' "$dir/said" || fail "$readme: not free: $(tail -n 3 "$dir/said")"
}
row() {  # WAY SECONDS PROCESSOR
  echo "| ${title[$1]} | $2 | $3 | $(awk -v n="$fetched" 'BEGIN { printf n < 1e6 ? "%.0f KB" : "%.1f MB", n < 1e6 ? n / 1e3 : n / 1e6 }') |" >>"$rows"
  test -z "${bound[$1]:-}" || awk -v a="$3" -v b="${BOUND:-${bound[$1]}}" 'BEGIN { exit !(a < b) }' ||
    fail "$1: the first verdict takes $3 s of a processor, not below ${BOUND:-${bound[$1]}}"
}
# The page, in Chromium: from opening it, from the disk, to the verdict on two dropped files.
follow_page() {
  sum=0 busy=0 readme=build/web/index.html
  prepare page
  environment=(PATH=/usr/bin:/bin)
  step "" "/usr/bin/python3 $here/tests/ways_page.py ${PAGE:-$here/build/web/index.html} A.stl B.obj" || return
  tail -n 3 "$dir/said"
  grep -q '^hit' "$dir/said" && grep -q '^free' "$dir/said" || fail "page: $(cat "$dir/said")"
  row page $(sed -n 's/^first verdict after \([0-9.]*\) s, \([0-9.]*\) of a processor.*/\1 \2/p' "$dir/said")
}

# Mistakes in the READMEs: each must be noticed. One way each at least; what compiles for long is not tried twice.
mutants() {
  local way name said change ends=0
  while IFS='|' read -r way name said change; do
    test -z "$(lacks "$way")" || { echo "ways: $way: $(lacks "$way" | head -1): not tested: $name"; continue; }
    sed -e "$change" "${text[$way]}" >"$dir/README.md"
    ! cmp -s "${text[$way]}" "$dir/README.md" || { echo "ways: $name changes nothing"; ends=1; }
    if (failures=0; README=$dir/README.md follow_way "$way"; exit $((failures > 0))) >"$dir/mutant" 2>&1 ||
      ! grep -qE -- "$said" "$dir/mutant"; then
      echo "ways: not noticed: $way, $name"; cat "$dir/mutant"; ends=1
    else
      echo "ways: noticed: $way, $name"
    fi
  done <<'END'
npm|a command that is not there|not found|s/^    npm install/    nmp install/
npm|a file that is not there|Cannot find module|s/node first.mjs/node frist.mjs/
npm|a name that is not exported|does not provide|s/init, parseMesh/init, parseMeshes/
npm|a mesh that is not there|ENOENT|s/'A.stl'/'C.stl'/
npm|a field that does not exist|pose|s/poses: path/pose: path/
npm|A ends elsewhere|no hit|s/\[0, 0, 0, 0, 0, 0, 1\]\]/[0, 0, 1.5, 0, 0, 0, 1]]/
npm|no program|no program|s/^```js/```javascript/
python|no such folder|examples/pyton: ends with|s,pip install examples/python,pip install examples/pyton,
rust|a command that is not there|no such command|s/^cargo add/cargo ad/
END
  BOUND=0.01 && (failures=0; follow_way npm; exit $((failures > 0))) >"$dir/mutant" 2>&1
  grep -q 'the first verdict takes' "$dir/mutant" && echo "ways: noticed: a bound that is too short" || { echo "ways: not noticed: slow"; ends=1; }
  unset BOUND
  return $ends
}

if test "${1:-}" = --mutants; then mutants; exit; fi
: >"$rows"
for way in ${*:-$ALL}; do
  why=$(lacks "$way" | head -1)
  test -z "$why" || { echo "ways: $way: no $why: not tested"; continue; }
  echo "ways: ${title[$way]}"
  case $way in page) follow_page ;; *) follow_way "$way" ;; esac
done
printf '\n%s\n%s\n' '| way | seconds | of a processor | fetched |' '|---|---|---|---|'
cat "$rows"
test "$failures" = 0 || { echo "ways: $failures failed"; exit 1; }
