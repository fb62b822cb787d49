(* Main.v - the theorems, of the checker over two arithmetics: big floats on Coq's integers, which is
   what is to be believed, and the machine's doubles, rounded outwards, which is fast. *)
From Coq Require Import ZArith.
From Interval Require Import Float.Specific_ops Float.Specific_stdz Float.Primitive_ops Interval.Float_full.
From Svcd Require Export Meeting.
Module ZF := SpecificFloat StdZRadix2.
Module ZI := FloatIntervalFull ZF.
Module ByZ := Meeting.Make ZI.
Module DI := FloatIntervalFull PrimitiveFloat.
Module ByDouble := Meeting.Make DI.
Definition accepts_Z := ByZ.accepts (ZF.PtoP 60).
Definition accepts_double := ByDouble.accepts (PrimitiveFloat.PtoP 53).
Definition meets_Z := ByZ.meets (ZF.PtoP 60).
Definition meets_double := ByDouble.meets (PrimitiveFloat.PtoP 53).

(* Of classical reals, four axioms; nothing else. *)
Theorem accepts_Z_sound : sound accepts_Z.
Proof. apply ByZ.accepts_sound. Qed.
Theorem meets_Z_sound : sound_meeting meets_Z.
Proof. apply ByZ.meets_sound. Qed.

(* And that the processor's doubles and integers are what Coq's FloatAxioms and Uint63 say. *)
Theorem accepts_double_sound : sound accepts_double.
Proof. apply ByDouble.accepts_sound. Qed.
Theorem meets_double_sound : sound_meeting meets_double.
Proof. apply ByDouble.meets_sound. Qed.
