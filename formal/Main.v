(* Main.v - the theorems, of the checker over two arithmetics: big floats on Coq's integers, which is
   what is to be believed, and the machine's doubles, rounded outwards, which is fast. *)
From Coq Require Import ZArith.
From Interval Require Import Float.Specific_ops Float.Specific_stdz Float.Primitive_ops Interval.Float_full.
From Svcd Require Export Rays.
Module ZF := SpecificFloat StdZRadix2.
Module ZI := FloatIntervalFull ZF.
Module ByZ := Rays.Make ZI.
Module DI := FloatIntervalFull PrimitiveFloat.
Module ByDouble := Rays.Make DI.
Definition accepts_Z := ByZ.accepts (ZF.PtoP 60).
Definition accepts_double := ByDouble.accepts (PrimitiveFloat.PtoP 53).
Definition meets_Z := ByZ.meets (ZF.PtoP 60).
Definition meets_double := ByDouble.meets (PrimitiveFloat.PtoP 53).
Definition frees_Z := ByZ.frees (ZF.PtoP 60).
Definition frees_double := ByDouble.frees (PrimitiveFloat.PtoP 53).
Definition insides_Z := ByZ.insides (ZF.PtoP 60).
Definition insides_double := ByDouble.insides (PrimitiveFloat.PtoP 53).

(* Of classical reals, four axioms; nothing else. *)
Theorem accepts_Z_sound : sound accepts_Z.
Proof. apply ByZ.accepts_sound. Qed.
Theorem meets_Z_sound : sound_meeting meets_Z.
Proof. apply ByZ.meets_sound. Qed.
Theorem frees_Z_sound : sound_free frees_Z.
Proof. apply ByZ.frees_sound. Qed.
Theorem insides_Z_sound : sound_inside insides_Z.
Proof. apply ByZ.insides_sound. Qed.

(* And that the processor's doubles and integers are what Coq's FloatAxioms and Uint63 say. *)
Theorem accepts_double_sound : sound accepts_double.
Proof. apply ByDouble.accepts_sound. Qed.
Theorem meets_double_sound : sound_meeting meets_double.
Proof. apply ByDouble.meets_sound. Qed.
Theorem frees_double_sound : sound_free frees_double.
Proof. apply ByDouble.frees_sound. Qed.
Theorem insides_double_sound : sound_inside insides_double.
Proof. apply ByDouble.insides_sound. Qed.
