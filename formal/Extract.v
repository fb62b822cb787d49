(* Extract.v - the checkers as OCaml: over the processor's doubles, and over Zarith's integers. *)
From Coq Require Import ZArith Extraction ExtrOcamlBasic ExtrOcamlZBigInt ExtrOCamlInt63 ExtrOCamlFloats ExtrOcamlNatInt.
From Interval Require Import Float.Primitive_ops.
From Svcd Require Import Main.
Definition tree_double b := ByDouble.tree_of b.
Definition check_double := ByDouble.check_trees (PrimitiveFloat.PtoP 53).
Definition tree_Z b := ByZ.tree_of b.
Definition check_Z := ByZ.check_trees (ZF.PtoP 60).
Definition meeting_double := ByDouble.meeting (PrimitiveFloat.PtoP 53).
Definition meeting_Z := ByZ.meeting (ZF.PtoP 60).
Extraction "checker.ml" mkScene tree_double check_double tree_Z check_Z meeting_double meeting_Z.
