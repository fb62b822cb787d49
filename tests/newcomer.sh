#!/bin/bash
# One newcomer: README.md, word by word, on a Debian that has nothing. newcomer.sh [README.md]; --mutants: are mistakes noticed?
# What of README is run, in its order, each line by itself by sh, in the root of a fresh copy; all must end with 0:
# 1. The lines of blocks indented by four blanks or fenced as ```sh, and `cc ...` in backticks; # after a blank begins a comment.
#    A block with a line that ends in ; { or } is an excerpt of C. So is what is fenced otherwise, but for the one of 2.
# 2. The block fenced as ```c that has a main is main.c from the start, and a command that compiles it is followed by ./a.out.
# 3. There are gcc, libc6-dev, make, and what a line with `needs` or `apt-get install` names of $OFFERED (no command before).
# 4. The newcomer has A and B, .obj and binary .stl, that meet; problems.txt about them; folders `proofs` and `folder`.
# 5. `make X`, `build/X` in backticks are not run, but must exist. What takes long is in `instead`, below, with the reason.
# 6. The first `svcd sweep A.` must say hit, for .stl too, within 60 s of a processor, with all before. README_LINES=110: no more lines.
set -uo pipefail
OFFERED='python3 python3-numpy g++ clang cmake pkg-config git xxd'
FIRST=${FIRST:-60}
STEP=${STEP:-600}  # CPU seconds that one program may take
here=$(cd "$(dirname "$0")/.." && pwd)
cd "$here" || exit 1
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
failures=0
small=  # set: of a small README that is tested
environment=(PATH=/usr/bin:/bin)  # where there is no bare root
fail() {
  echo "newcomer: $*" >&2
  failures=$((failures + 1))
}
now() { date +%s.%N; }
since() { awk -v a="$1" -v b="$(now)" 'BEGIN { printf "%.1f", b - a }'; }

# What is run in the place of a command: `- REASON`, or the shorter command. Nothing: the command itself.
instead() {
  case $1 in
    'git clone '* | 'cd neuralsvcd'*) echo "- done: this is a fresh copy" ;;
    'apt-get '* | 'apt '* | 'sudo apt'*) echo "- done: they are there" ;;
    # Minutes; .ci/run runs it. Here all of it is built, without -march=native, and the promises hold.
    'make test'*) if test -n "$small"; then echo "- minutes"; else echo "make PORTABLE=1 build/tests && build/tests promises"; fi ;;
    'make bench'* | 'make race'* | 'make accuracy'*) echo "- minutes: what is measured" ;;
    'make web'* | 'make firmware'*) echo "- other tools: check-web, check-firmware" ;;
    make) echo "make build/svcd build/verify build/quickstart" ;;  # two minutes otherwise
    'make demo') echo "make demo DEMOS=build/quickstart" ;;        # the same
    'make install' | 'sudo make install') test -n "$root" && echo "make install" || echo "make install DESTDIR=$dir/installed" ;;
  esac
}

# KIND, line, text of what README holds: run, name (5 above), code (an excerpt, its first line); main.c is written.
read_readme() {
  awk -v main="$2" '
    function comment_off(s) { sub(/(^|[ \t]+)#( .*|$)/, "", s); sub(/[ \t]+$/, "", s); return s }
    function names(s, line,  inline) {
      while (match(s, /`[^`]+`/)) {
        inline = substr(s, RSTART + 1, RLENGTH - 2)
        s = substr(s, RSTART + RLENGTH)
        if (inline ~ /^cc .*\.c( |$)/) print "run\t" line "\t" inline
        else if (inline ~ /^(make [a-z]|build\/[a-z])/) print "name\t" line "\t" inline
      }
    }
    function flush(  i, is_code, s, from) {
      for (i = 1; i <= held; i++) if (block[i] ~ /[;{}][ \t]*$/) is_code = 1
      if (is_code) print "code\t" at[1] "\t" block[1]
      for (i = 1; i <= held && !is_code; i++) {
        if (block[i] ~ /#/) names(block[i], at[i])
        s = s comment_off(block[i])
        if (!from) from = at[i]
        if (sub(/\\$/, "", s)) continue
        if (s != "") print "run\t" from "\t" s
        s = ""; from = 0
      }
      if (s != "") print "run\t" from "\t" s
      held = 0
    }
    function hold(s) { block[++held] = s; at[held] = NR }
    fence != "" {
      if ($0 ~ /^```/) {
        if (fence == "sh") flush()
        else if (fence == "c" && program ~ /int main\(/) {
          printf "%s", program >main; close(main); mains++
        } else print "code\t" NR "\tfenced as " fence
        fence = ""; program = ""
      } else if (fence == "sh") hold($0)
      else program = program $0 "\n"
      next
    }
    /^```/ { flush(); fence = substr($0, 4); if (fence == "") fence = "nothing"; next }
    /^    / && (blank || held) { hold(substr($0, 5)); next }
    held && $0 ~ /^[ \t]*$/ { flush() }
    held { flush() }
    { blank = $0 ~ /^[ \t]*$/ }
    { names($0, NR) }
    END { flush(); if (mains > 1) print "bad\t" NR "\tmore than one program with a main" }' "$1"
}

# What README asks for, of what is offered.
needed() {
  sed -n 's/.*\(needs\|apt\(-get\)\{0,1\} install\)\(.*\)/ \3 /p' "$1" | tr -c 'a-z0-9+-' ' ' >"$dir/words"
  for package in $OFFERED; do ! grep -q -- " $package " "$dir/words" || printf ',%s' "$package"; done
}

# A bare Debian (or Ubuntu, where this is one) of these packages, in build/newcomer, made once a day; else it says why not.
# Of what README did there the last time, /root and /usr/local are emptied.
bare_root() {
  local place=build/newcomer/$1 suite
  suite=$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release 2>/dev/null)
  test -z "${NO_ROOT:-}" || { echo "NO_ROOT is set"; return; }
  test "$(id -u)" = 0 || { echo "not root"; return; }
  command -v chroot >/dev/null && test -n "$suite" || { echo "no chroot, or no Debian"; return; }
  mkdir -p build/newcomer
  if ! test -f "$place/made" || test -n "$(find "$place/made" -mmin +1440)"; then
    rm -rf --one-file-system "$place"
    if command -v mmdebstrap >/dev/null; then
      mmdebstrap --quiet --variant=minbase --include="$1" "$suite" "$place" >"$dir/bootstrap.txt" 2>&1
    elif command -v debootstrap >/dev/null; then
      debootstrap --variant=minbase --include="$1" "$suite" "$place" >"$dir/bootstrap.txt" 2>&1
    else
      echo "no mmdebstrap, no debootstrap"; return
    fi || { grep -v '^$' "$dir/bootstrap.txt" | tail -1; return; }
    touch "$place/made"
  fi
  rm -rf --one-file-system "${place:?}"/root "${place:?}"/usr/local
  mkdir -p "$place/root" "$place/usr/local"
  chroot "$place" /bin/true || echo "chroot does not run"
}

# The files of the repository, as they are here, in $copy: those that git knows, or, without git, all that was not built.
fresh_copy() {
  rm -rf "$copy"
  mkdir -p "$copy"
  if git ls-files -z >"$dir/files" 2>/dev/null; then
    while IFS= read -r -d '' file; do ! test -f "$file" || printf '%s\0' "$file"; done <"$dir/files" |
      tar --null --files-from=- -cf - | tar -C "$copy" -xf -
  else
    tar --exclude=./build --exclude=./.git -cf - . | tar -C "$copy" -xf -
  fi
  cp "$1" "$copy/README.md"
}

# A box from 0 to $2, as OBJ and as binary STL; $3 is the number's four bytes.
own_box() {
  local file=$1 zero='\000\000\000\000' corner quad at
  local quads='0264 1573 0451 2376 0132 4675'  # corners xyz as bits 0, 1, 2; two triangles each
  quads='0 2 3 1  4 5 7 6  0 1 5 4  2 6 7 3  0 4 6 2  1 3 7 5'
  for corner in 0 1 2 3 4 5 6 7; do
    echo "v $((corner & 1 ? 1 : 0)) $((corner & 2 ? 1 : 0)) $((corner & 4 ? 1 : 0))" | sed "s/1/$2/g"
  done >"$file.obj"
  printf '%-80s\014\000\000\000' "a box of a newcomer" >"$file.stl"
  # shellcheck disable=SC2086
  set -- "$3" $quads
  local one=$1
  shift
  while test $# -gt 0; do
    for quad in "$1 $2 $3" "$1 $3 $4"; do
      echo "f $quad" | awk '{ print $1, $2 + 1, $3 + 1, $4 + 1 }' >>"$file.obj"
      printf "$zero$zero$zero" >>"$file.stl"
      for corner in $quad; do
        for at in 1 2 4; do
          if ((corner & at)); then printf "$one"; else printf "$zero"; fi >>"$file.stl"
        done
      done
      printf '\000\000' >>"$file.stl"
    done
    shift 4
  done
}
own_files() {
  own_box "$copy/A" 0.25 '\000\000\200\076'
  own_box "$copy/B" 1 '\000\000\200\077'
  mkdir "$copy/proofs" "$copy/folder"
  printf '%s\n' 'nsvcd-problems 1' 'mesh a A.obj' 'mesh b B.stl' 'problem past a 1 b 1  0 0 0 0 0 0 1  0 nan 2' \
    '2 0 0 0 0 0 1' '2 2 0 0 0 0 1' 'problem into a 1 b 1  0 0 0 0 0 0 1  1 nan 2' '2 0.3 0.3 0 0 0 1' '0 0.3 0.3 0 0 0 1' \
    >"$copy/problems.txt"
}

# The command in the copy; what it said is in $dir/said.
run() {
  if test -n "$root"; then
    printf 'cd /root/neuralsvcd.h\n%s\n' "$1" >"$root/root/command"
    (ulimit -t "$STEP" && chroot "$root" /usr/bin/env -i HOME=/root PATH=/usr/local/bin:/usr/bin:/bin sh -e /root/command)
  else
    printf 'cd %s\n%s\n' "'$copy'" "$1" >"$dir/command"
    (ulimit -t "$STEP" && env -i HOME="$dir" "${environment[@]}" sh -e "$dir/command")
  fi >"$dir/said" 2>&1 </dev/null
}
# step LINE COMMAND [NOTE]: runs it, and adds a row to the table.
step() {
  local seconds user system status why= TIMEFORMAT='%1R %1U %1S'
  { time run "$2"; } 2>"$dir/time"
  status=$?
  read -r seconds user system <"$dir/time"
  sum=$(awk -v a="$sum" -v b="$seconds" 'BEGIN { printf "%.1f", a + b }')
  busy=$(awk -v a="$busy" -v b="$user" -v c="$system" 'BEGIN { printf "%.1f", a + b + c }')
  test $status = 0 || why=" FAILED: $status"
  printf '%7s  %5s  %s\n' "$seconds" "$1" "$2${3:-}$why"
  test $status = 0 || fail "$readme:$1: $2: ends with $status, says: $(tail -n 20 "$dir/said")"
  return $status
}
makefiles=$(echo Makefile packages/packages.mk tests/*.mk tests/*/*.mk train/train.mk)
# Is this a target of the Makefile, or a program of it?
known() {
  local what=${1#make } what
  what=${what%% *}
  case $1 in
    make*) grep -qE "^\.PHONY:.* $what( |\$)|^$what:" $makefiles ;;
    *) what=${what#build/}
      test -e "examples/$what.c" || test -e "tests/bench/$what.c" || grep -q "build/$what\( .*\)*:" $makefiles || test -e "build/$what" ;;
  esac
}

follow() {  # README
  readme=$1 sum=0 busy=0
  root= copy=$dir/neuralsvcd.h
  local begin packages why kind line text other verdict='' was_there=''
  rm -f "$dir/main.c"
  read_readme "$readme" "$dir/main.c" >"$dir/parts"
  packages=gcc,libc6-dev,make$(needed "$readme")
  ! test -f "build/newcomer/$packages/made" || was_there=yes
  begin=$(now)
  why=$(bare_root "$packages")
  if test -z "$why"; then
    root=$here/build/newcomer/$packages copy=$root/root/neuralsvcd.h
    echo "newcomer: a bare $(sed -n 's/^PRETTY_NAME="\(.*\)"/\1/p' "$root/etc/os-release") with $packages: $(since "$begin") s${was_there:+, there already}"
  else
    echo "newcomer: no bare root: $why: what a bare Debian lacks is not tested"
  fi
  fresh_copy "$readme"
  own_files
  if test -f "$dir/main.c"; then cp "$dir/main.c" "$copy/"; fi
  echo "seconds   line  command"
  while IFS=$'\t' read -r kind line text; do
    case $kind in
      code) echo "      -  $(printf '%5s' "$line")  (an excerpt) $text"; continue ;;
      bad) fail "$readme: $text"; continue ;;
      name) known "$text" || fail "$readme:$line: the Makefile knows no '$text'"; continue ;;
    esac
    other=$(instead "$text")
    case $other in
      '- done'*) echo "      -  $(printf '%5s' "$line")  $text (not run ${other})"; continue ;;
      -*) known "$text" || fail "$readme:$line: the Makefile knows no '$text'"
        echo "      -  $(printf '%5s' "$line")  $text (not run ${other})"; continue ;;
      '') step "$line" "$text" ;;
      *) step "$line" "$other" " (for: $text)" ;;
    esac || { test -z "${STOP:-}" || return; continue; }
    case $text in
      *'svcd sweep A.'*)
        test -z "$verdict" || continue
        verdict=hit
        head -1 "$dir/said" | grep -q '^hit' || fail "$readme:$line: $text: no hit: $(head -1 "$dir/said")"
        case $text in
          *.stl*) ;;
          *) step "$line" "${text//.obj/.stl}" " (his own STL)" && head -1 "$dir/said" | grep -q '^hit' ||
              fail "$readme:$line: no hit of STL: $(head -1 "$dir/said")" ;;
        esac
        first=$sum first_busy=$busy ;;
      *main.c*)
        local program=./a.out
        case $text in *' -o '*) program=./$(echo "$text" | sed 's/.* -o *\([^ ]*\).*/\1/') ;; esac
        step "$line" "$program" && grep -q . "$dir/said" || fail "$readme:$line: the program says nothing" ;;
    esac
  done <"$dir/parts"
  grep -q '^run' "$dir/parts" || fail "$readme: no command found"
  ! test -f "$dir/main.c" || grep -q '^run.*main\.c' "$dir/parts" || fail "$readme: its program is compiled by no command"
  echo "newcomer: $(grep -c '^run' "$dir/parts") commands of $readme, $sum s"
  if test -n "$verdict"; then
    echo "newcomer: first verdict on one's own STL: $first s after the clone, $first_busy s of a processor"
    awk -v a="$first_busy" -v b="$FIRST" 'BEGIN { exit !(a < b) }' || fail "the first verdict takes $first_busy s, not below $FIRST"
  else
    fail "$readme: no command 'svcd sweep A...': no verdict on one's own mesh"
  fi
  lines=$(wc -l <"$readme")
  echo "newcomer: README has $lines lines"
  test -z "${README_LINES:-}" || test "$lines" -le "$README_LINES" || fail "README has $lines lines, not at most $README_LINES"
}

# A small README that passes, and mistakes in it, each of which must be noticed.
mutants() {
  local name change text status
  small=yes
  cat >"$dir/small.md" <<'END'
# A small one. `make bench-flags COUNT=100` measures, `build/problems` makes.

This is main.c: `cc main.c`. It needs nothing else.

```c
#include <stdio.h>
int main(void) {
  return puts("free") < 0;
}
```

In a program of yours:

    for (;;) {
      respond();
    }

On your own files:

    make build/verify CFLAGS="-O0"
    cc -O0 -DNSVCD_NO_DISPATCH \
      examples/svcd.c -o svcd -lm
    ./svcd sweep A.obj B.obj     # do they hit?
    ./svcd check --certificates proofs problems.txt && build/verify problems.txt proofs
    make test     # all; `make help`
END
  local ends=0 bare=
  while IFS='|' read -r name text change; do
    sed -e "$change" "$dir/small.md" >"$dir/README.md"
    test "$name" = none || ! cmp -s "$dir/small.md" "$dir/README.md" || { echo "newcomer: $name changes nothing"; ends=1; }
    test "$name" = none || export STOP=1
    (failures=0; follow "$dir/README.md"; exit $((failures > 0))) >"$dir/mutant" 2>&1
    status=$?
    if test "$name" = none; then
      test $status = 0 || { echo "newcomer: the small README fails:"; cat "$dir/mutant"; return 1; }
      bare=$(grep -v 'no bare root' "$dir/mutant" | grep 'a bare ')
    elif test $status = 0 && test "$text" = 'python3: not found' && test -z "$bare"; then
      echo "newcomer: no bare root: not tested: $name"
    elif test $status = 0 || ! grep -qE -- "$text" "$dir/mutant"; then
      echo "newcomer: not noticed: $name"; cat "$dir/mutant"; ends=1
    else
      echo "newcomer: noticed: $name"
    fi
  done <<'END'
none||
a command that is not there|not found|s,^    make build/verify,    maek build/verify,
a target that is not there|No rule to make target|s,build/verify CF,build/verifier CF,
a target in the text that is not there|knows no .make bench-flag|s,make bench-flags,make bench-flag,
a program in the text that is not there|knows no .build/problem|s,build/problems,build/problem,
a target in a comment that is not there|knows no .make halp|s,make help,make halp,
a typo in the program|pust|s,puts,puts + pust,
a program that says nothing|says nothing|s,puts("free") < 0,0 \* sizeof(puts("")),
a program that no command compiles|compiled by no command|s,`cc main.c`,cc main.c,
python3, not named|python3: not found|s,^    make build/verify,    python3 --version\n&,
an option that is not there|--frobnicate A.obj B.obj: ends with|s,sweep A.obj,sweep --frobnicate A.obj,
a file that is not there|No such file|s,examples/svcd.c,svcd.c,
a mesh that is not there|A.obj C.obj: ends with|s,A.obj B.obj,A.obj C.obj,
no verdict|no verdict on one|s,sweep A.obj,info A.obj #,
a program before it is built|build/verify: not found|s,^    make build/verify.*,    build/verify problems.txt proofs,
END
  return $ends
}

test "$0" = "${BASH_SOURCE[0]}" || return 0  # ways.sh takes the functions
if test "${1:-}" = --mutants; then
  mutants
  exit
fi
follow "${1:-README.md}"
test "$failures" = 0 || { echo "newcomer: $failures failed"; exit 1; }
echo "newcomer: README does what it says"
