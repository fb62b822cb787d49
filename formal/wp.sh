#!/bin/bash
# Has Frama-C's WP prove that the checker of certificates has no runtime error, whatever the bytes: the contracts are the
# comments /*@ ... */ in examples/verify; SOUNDNESS.md says what they assume. One line a function: goals proven / all.
#   formal/wp.sh [FUNCTION ...]    those listed here, or these
#   formal/wp.sh --mutants         each of three mistakes, with which its function must not be proven
cd "$(dirname "$0")/.." || exit 1
for tool in frama-c why3 cvc4; do
  command -v $tool >/dev/null || { echo "wp: $tool: not tested"; exit 0; }
done
# Two lists, at the same time.
first="verify__min verify__max verify__stored verify__corner verify__sum verify__before verify__children verify__read verify__read_normal
verify__dot verify__radius verify__lengths verify__side verify__misses verify__descend"
# What reads a motion, which is behind a void *: with the casts of the memory model.
casts="verify__path_place verify__path_next verify__path_deviation"
second="verify__seen verify__crosses verify__extent_of verify__most verify__aside verify__deviation_along verify__parts
verify__knot verify__pose_before verify__share verify__turn verify__matrix verify__wound verify__corner_seen verify__extent_in verify__near"
here=$(mktemp -d) && trap 'rm -rf "$here"' EXIT

# Debian's CVC4 has no floating-point numbers: here it knows nothing about them, so that nothing rests on their values.
drivers=$(why3 --print-datadir)/drivers
cp "$drivers"/*.gen "$here" && sed -i '/smt-libv2-floats/d' "$here/cvc4_16.gen"
cp "$drivers/cvc4_17.drv" "$here/no_floats.drv" && echo >>"$here/no_floats.drv"
for theory in GenericFloat Float32 Float64 FloatConverter; do
  printf 'theory ieee_float.%s\n  remove allprops\nend\n' $theory >>"$here/no_floats.drv"
done
printf '[main]\nmagic = 14\nmemlimit = 2000\ntimelimit = 20\nrunning_provers_max = 1\n
[prover]\nname = "CVC4"\nalternative = "no floats"\nversion = "1.8"\ndriver = "%s"
command = "%s --stats --tlimit=%%t000 --lang=smt2 %%f"\neditor = ""\nin_place = false\ninteractive = false\n' \
  "$here/no_floats.drv" "$(command -v cvc4)" >"$here/why3.conf"

# prove FOLDER FUNCTIONS [MODEL]: of the checker in FOLDER; the log to stdout.
prove() {
  WHY3CONFIG=$here/why3.conf nice -n 15 frama-c -machdep gcc_x86_64 -warn-special-float none -cpp-extra-args="-I$1" formal/wp/all.c \
    -instantiate -then -wp -wp-model ${3:-Typed} -wp-rte -wp-fct "$(echo $2 | tr ' ' ',')" -wp-prover "CVC4:1.8:no floats" -wp-timeout 20 -wp-par 1 2>&1
}
# lines LOG FUNCTIONS: a line for each function; 1 if one is not proven.
lines() {
  local bad=0 name
  grep -q '^\[wp\] Proved goals' "$1" || { cat "$1"; return 1; }
  for name in $2; do
    # goals are named typed_verify_NAME_... and typed_verify__NAME_call_...
    awk -v name="${name#verify__}" '
      match($0, /Goal typed_[a-z_]*/) {
        goal = substr($0, RSTART + 5)
        sub(/^typed_(cast_)?verify__?/, "", goal)
        if (goal ~ "^" name "_(call|assert|assigns|ensures|exits|loop|terminates)") { all++; proven += / : Valid/ }
      }
      END { print "wp: verify__" name ": " proven + 0 " / " all + 0; exit !(all && proven == all) }' "$1" || bad=1
  done
  return $bad
}
if [ "$1" = --mutants ]; then
  survived=0
  while IFS='|' read -r name file from to; do
    rm -rf "$here/mutant" && cp -r examples/verify "$here/mutant"
    sed -i "s|$from|$to|" "$here/mutant/$file"
    cmp -s "$here/mutant/$file" "examples/verify/$file" && { echo "wp: $name: the line is not there"; survived=1; continue; }
    prove "$here/mutant" "$name" >"$here/log"
    lines "$here/log" "$name" && { echo "wp: $name is proven with a mistake"; survived=1; }
  done <<'END'
verify__read|nsvcd_verify_rays.h|r->at < r->bits;|r->at <= r->bits;
verify__children|nsvcd_verify_scene.h|node->first + half, node->count - half|node->first + half, node->count - half + 1
verify__most|nsvcd_verify.h|m->order\[node->first + i / 3\], i % 3);|m->order[node->first + i / 2], i % 3);
END
  exit $survived
fi
if [ $# -gt 0 ]; then
  case " $casts " in *" $1 "*) model=Typed+Cast ;; esac
  prove examples/verify "$*" $model >"$here/log"
  lines "$here/log" "$*"
  exit
fi
prove examples/verify "$second" >"$here/second" &
prove examples/verify "$first" >"$here/first"
prove examples/verify "$casts" Typed+Cast >"$here/casts"
wait
bad=0
lines "$here/first" "$first" || bad=1
lines "$here/second" "$second" || bad=1
lines "$here/casts" "$casts" || bad=1
exit $bad
