(* Solid.v - the angle of a triangle as seen from a point, and what angles add up to: for triangles each edge of which goes there
   as often as back, seen from a point off their edges, the half solid angles sum to a whole number of half turns. *)
From Coq Require Import Reals Lra Lia Psatz List ZArith Permutation.
From Coquelicot Require Import Coquelicot.
From Svcd Require Export Inside.
Import ListNotations.
Local Open Scope R_scope.

Definition image (f : zv -> V) T := mkTri (f (za T)) (f (zb T)) (f (zc T)).
Definition touches x (l : list tri) := exists T, In T l /\ of_tri x T.

(* ---- the complex number d + y i of a triangle whose corners are at a, b, c as seen from a point, and its size *)
Definition dee a b c := norm a * norm b * norm c + dot a b * norm c + dot b c * norm a + dot c a * norm b.
Definition arr a b c := sqrt (dee a b c * dee a b c + det a b c * det a b c).
(* th is its half angle, up to half turns *)
Definition angle_of x T th := let a := vsub (c0 T) x in let b := vsub (c1 T) x in let c := vsub (c2 T) x in
  cos (2 * th) = dee a b c / arr a b c /\ sin (2 * th) = det a b c / arr a b c.
(* a point that is on no edge *)
Definition off_edge a b := 0 < norm a * norm b + dot a b.
Definition off_edges x T := let a := vsub (c0 T) x in let b := vsub (c1 T) x in let c := vsub (c2 T) x in
  off_edge a b /\ off_edge b c /\ off_edge c a.

Lemma wound_is x T : wound_by x T = let a := vsub (c0 T) x in let b := vsub (c1 T) x in let c := vsub (c2 T) x in
  atan (det a b c / (dee a b c + arr a b c)) / PI.
Proof. reflexivity. Qed.

Lemma off_edges_arr x T : off_edges x T -> 0 < arr (vsub (c0 T) x) (vsub (c1 T) x) (vsub (c2 T) x).
Proof. Admitted.

(* ---- edges that go there as often as back: whatever angles the triangles are given, they sum to half turns *)
Lemma angles_whole f l x (th : ztri -> R) : balanced l -> (forall T, In T l -> off_edges x (image f T)) ->
  (forall T, In T l -> angle_of x (image f T) (th T)) ->
  exists k : Z, fold_right (fun T s => th T + s) 0 l = IZR k * PI.
Proof. Admitted.

(* ---- a point off a triangle *)
Lemma off_tri_edges x T : ~ of_tri x T -> off_edges x T.
Proof. Admitted.

Lemma heart x T : ~ of_tri x T -> let a := vsub (c0 T) x in let b := vsub (c1 T) x in let c := vsub (c2 T) x in
  0 < arr a b c /\ 0 < dee a b c + arr a b c.
Proof. Admitted.

Lemma turns x T : ~ of_tri x T -> angle_of x T (wound_by x T * PI).
Proof. Admitted.

(* ---- and how it goes where the corners and the point move *)
Lemma wound_steady (f : R -> zv -> V) (x : R -> V) T u : (forall p, steadyV (fun u => f u p)) -> steadyV x ->
  ~ of_tri (x u) (image (f u) T) -> continuity_pt (fun u => wound_by (x u) (image (f u) T)) u.
Proof. Admitted.
