#!/bin/sh
# make formal: proves all, looks at what the theorem assumes, makes build/referee and compares it with build/verify. Ends with
# 1 if anything is not as it should be. Where a tool is not there, it says so and leaves that out.
set -u
out=build/formal
mkdir -p $out
fail() { echo "formal: $*"; exit 1; }

echo 'From Coquelicot Require Import Coquelicot. From Interval Require Import Tactic.' >$out/tools.v
coqc -q -noglob -w -all -o $out/tools.vo $out/tools.v 2>/dev/null ||
  { echo "formal: coqc with coquelicot and interval: not tested"; exit 0; }
! grep -nwE 'Admitted|admit|give_up|Axioms?|Parameters?|Conjecture|Unset' formal/*.v || fail "something is taken for granted"
${MAKE:-make} -j2 --no-print-directory formal-proofs || fail "a proof fails"

# Classical reals are built on these four axioms.
theorems="accepts_Z_sound meets_Z_sound frees_Z_sound insides_Z_sound near_free shaft_free lies_within through_hits close_near
  box_encloses winds_inside winds_outside motion_leaves_chord parts_apart axis_keeps"
{
  echo 'From Svcd Require Import Scenes Box Chains.'
  for what in $theorems; do echo "Redirect \"$out/assumed_$what\" Print Assumptions $what."; done
} >$out/assumptions.v
rm -f $out/assumed_*
coqc -q -noglob -w -all -R $out Svcd -o $out/assumptions.vo $out/assumptions.v || fail "what is assumed cannot be printed"
for what in $theorems; do
  awk '/^[^ ]/ && $1 != "Axioms:" { sub(/.*[.]/, "", $1); print $1 }' $out/assumed_$what.out | sort >$out/assumptions.txt
  printf '%s\n' classic functional_extensionality_dep sig_forall_dec sig_not_dec |
    cmp -s - $out/assumptions.txt || fail "$what assumes other things: $(cat $out/assumptions.txt)"
done
echo "formal: proven, from the four axioms of classical reals"

ocamlfind query -qe zarith coq-core.kernel >/dev/null 2>&1 || { echo "formal: ocamlfind with zarith and coq-core: not tested"; exit 0; }
${MAKE:-make} --no-print-directory build/referee build/verify build/svcd build/problems || fail "the referee is not made"
formal/compare.sh && python3 formal/boundary.py $out/boundary
