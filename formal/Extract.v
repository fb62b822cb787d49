(* Extract.v - the checkers as OCaml: over the processor's doubles, and over Zarith's integers. *)
From Coq Require Import ZArith Extraction ExtrOcamlBasic ExtrOcamlZBigInt ExtrOCamlInt63 ExtrOCamlFloats ExtrOcamlNatInt.
From Interval Require Import Float.Primitive_ops.
From Svcd Require Import Main.
Definition tree_double b := ByDouble.tree_of b.
Definition free_double := ByDouble.free_of (PrimitiveFloat.PtoP 53).
Definition meeting_double := ByDouble.meeting (PrimitiveFloat.PtoP 53).
Definition inside_double := ByDouble.inside_of (PrimitiveFloat.PtoP 53).
Definition tree_Z b := ByZ.tree_of b.
Definition free_Z := ByZ.free_of (ZF.PtoP 60).
Definition meeting_Z := ByZ.meeting (ZF.PtoP 60).
Definition inside_Z := ByZ.inside_of (ZF.PtoP 60).
Extraction "checker.ml" mkScene surface_of tree_double free_double meeting_double inside_double tree_Z free_Z meeting_Z inside_Z.
