(* Answers.v - the statements about what a certificate says besides Statement.v's FREE. *)
From Coq Require Import Reals List ZArith QArith Qreals.
From Svcd Require Export Statement.
Import ListNotations.
Local Open Scope R_scope.

(* HIT, and NEAR, at one time: a point is of both bodies; points of them are nearer than d *)
Definition meet s t := exists x, at_time (body_a s) t x /\ at_time (body_b s) t x.
Definition meet_within s d t := exists x y, at_time (body_a s) t x /\ at_time (body_b s) t y /\ norm (vsub x y) < d.

(* ---- THE STATEMENT OF MEETINGS. `meets` answers Some (true, t) of a HIT, Some (false, t) of a NEAR. *)
Definition sound_meeting (meets : scene -> list Z -> option (bool * Q)) := forall s bytes hit t,
  meets s bytes = Some (hit, t) ->
  0 <= Q2R t <= 1 /\ (if hit then meet s (Q2R t) else meet_within s (Q2R (clearance s)) (Q2R t)) /\
  moves (body_a s) /\ moves (body_b s).

(* ---- how often triangles wind about a point: the solid angles that they fill, as seen from it, over that of the whole sphere.
   A triangle counts up where its corners are counter-clockwise as seen from the other side. Its half solid angle is that of
   the complex number d + y i (Van Oosterom, Strackee 1983), and the angle of that is 2 atan (y / (d + |d + y i|)) *)
Definition cross a b := mkV (vy a * vz b - vz a * vy b) (vz a * vx b - vx a * vz b) (vx a * vy b - vy a * vx b).
Definition det a b c := dot a (cross b c).
Definition wound_by x T :=
  let a := vsub (c0 T) x in let b := vsub (c1 T) x in let c := vsub (c2 T) x in
  let d := norm a * norm b * norm c + dot a b * norm c + dot b c * norm a + dot c a * norm b in
  let y := det a b c in atan (y / (d + sqrt (d * d + y * y))) / PI.
Definition winding x l := fold_right (fun T sum => wound_by x T + sum) 0 l.

(* each edge goes there as often as back *)
Definition zv_dec (p q : zv) : {p = q} + {p <> q}.
Proof. decide equality; apply Z.eq_dec. Defined.
Definition edge_dec (e f : zv * zv) : {e = f} + {e <> f}.
Proof. decide equality; apply zv_dec. Defined.
Definition edges T := [(za T, zb T); (zb T, zc T); (zc T, za T)].
Definition balanced l := forall p q, count_occ edge_dec (flat_map edges l) (p, q) = count_occ edge_dec (flat_map edges l) (q, p).
