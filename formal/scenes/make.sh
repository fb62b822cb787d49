#!/bin/sh
# Writes formal/Scenes.v anew: the scenes of scenes.txt, with certificates by build/svcd, as Coq terms by build/referee.
# From the repository's root.
set -eu
mkdir -p build/formal/scenes
build/svcd check --certificates build/formal/scenes formal/scenes/scenes.txt >/dev/null 2>&1
{
  cat <<'END'
(* Scenes.v - three certificates that nsvcd_certify made, checked by Coq's kernel: of formal/scenes, written by
   formal/scenes/make.sh. *)
From Coq Require Import List ZArith QArith.
From Svcd Require Export Main.
Import ListNotations.
Local Open Scope Q_scope.

END
  build/referee formal/scenes/scenes.txt build/formal/scenes --coq
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

(* a shaft in a bore: its deviation goes with the distance from its axis *)
Theorem shaft_free : never_meet shaft.
Proof.
  apply (accepts_Z_sound shaft shaft_bytes false). vm_cast_no_check (eq_refl (Some false)).
Qed.
END
} >formal/Scenes.v
