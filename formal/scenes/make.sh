#!/bin/sh
# Writes formal/Scenes.v anew: the scenes of scenes.txt, with certificates by build/svcd, as Coq terms by build/referee.
# From the repository's root.
set -eu
mkdir -p build/formal/scenes build/formal/scenes/within
build/svcd check --certificates build/formal/scenes formal/scenes/scenes.txt >/dev/null 2>&1
build/svcd check --clearance 0.2 --certificates build/formal/scenes/within formal/scenes/scenes.txt >/dev/null 2>&1
{
  cat <<'END'
(* Scenes.v - six certificates that nsvcd_certify made, checked by Coq's kernel: of formal/scenes, written by
   formal/scenes/make.sh. *)
From Coq Require Import Reals List ZArith QArith Qreals.
From Svcd Require Export Main.
Import ListNotations.
Local Open Scope Q_scope.

END
  build/referee formal/scenes/scenes.txt build/formal/scenes --coq --only near,both,shaft,through,lies
  build/referee formal/scenes/scenes.txt build/formal/scenes/within --coq --clearance 0.2 --only close
  cat <<'END'

Theorem near_free : never_meet near /\ never_inside near.
Proof.
  destruct (accepts_Z_sound near near_bytes true) as (A & B & _); [|split; [exact A|apply B, eq_refl]].
  vm_cast_no_check (eq_refl (Some true)).
Qed.

Theorem both_free : never_meet both /\ never_inside both.
Proof.
  destruct (accepts_Z_sound both both_bytes true) as (A & B & _); [|split; [exact A|apply B, eq_refl]].
  vm_cast_no_check (eq_refl (Some true)).
Qed.

(* a shaft in a bore: its deviation goes with the distance from its axis; no plane is ever between them, so rays follow. Each is
   one component, of which any corner will do *)
Definition a_corner b := match tris b with T :: _ => za T | _ => mkZ 0 0 0 end.
Definition hint s := ([a_corner (body_a s)], [a_corner (body_b s)]).
Theorem shaft_free : never_meet shaft /\ never_wound shaft.
Proof.
  destruct (frees_Z_sound shaft (hint shaft) shaft_bytes) as (A & B & _); [|split; [exact A|exact B]].
  vm_cast_no_check (eq_refl true).
Qed.

Theorem lies_within : exists t, (0 <= Q2R t <= 1)%R /\ within (body_a lies) (body_b lies) (Q2R t).
Proof.
  assert (H : match insides_Z lies (hint lies, fun _ _ => Some (a_corner (body_a lies))) lies_bytes with
    Some (false, _) => True | _ => False end) by vm_cast_no_check Logic.I.
  destruct (insides_Z _ _ _) as [[[|] t]|] eqn:E; [destruct H| |destruct H]. apply insides_Z_sound in E. exists t. tauto.
Qed.

Theorem through_hits : exists t, (0 <= Q2R t <= 1)%R /\ meet through (Q2R t).
Proof.
  assert (H : match meets_Z through through_bytes with Some (true, _) => True | _ => False end)
    by vm_cast_no_check Logic.I.
  destruct (meets_Z _ _) as [[[|] t]|] eqn:E; [|destruct H|destruct H]. apply meets_Z_sound in E. exists t. tauto.
Qed.

Theorem close_near : exists t, (0 <= Q2R t <= 1)%R /\ meet_within close (Q2R (clearance close)) (Q2R t).
Proof.
  assert (H : match meets_Z close close_bytes with Some (false, _) => True | _ => False end)
    by vm_cast_no_check Logic.I.
  destruct (meets_Z _ _) as [[[|] t]|] eqn:E; [destruct H| |destruct H]. apply meets_Z_sound in E. exists t. tauto.
Qed.
END
} >formal/Scenes.v
