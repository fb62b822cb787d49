(* Main.v - the theorem, of the checker over two arithmetics: big floats on Coq's integers, which is
   what is to be believed, and the machine's doubles, rounded outwards, which is fast. *)
From Coq Require Import ZArith.
From Interval Require Import Float.Specific_ops Float.Specific_stdz Float.Primitive_ops Interval.Float_full.
From Svcd Require Export Checker.
Module ZF := SpecificFloat StdZRadix2.
Module ZI := FloatIntervalFull ZF.
Module ByZ := Make ZI.
Module DI := FloatIntervalFull PrimitiveFloat.
Module ByDouble := Make DI.
Definition accepts_Z := ByZ.accepts (ZF.PtoP 60).
Definition accepts_double := ByDouble.accepts (PrimitiveFloat.PtoP 53).

(* Of classical reals, four axioms; nothing else. *)
Theorem accepts_Z_sound : sound accepts_Z.
Proof. apply ByZ.accepts_sound. Qed.

(* And that the processor's doubles and integers are what Coq's FloatAxioms and Uint63 say. *)
Theorem accepts_double_sound : sound accepts_double.
Proof. apply ByDouble.accepts_sound. Qed.
