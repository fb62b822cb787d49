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
  moves (body_a s) /\ moves (body_b s) /\ proper (body_a s) /\ proper (body_b s).

(* ---- how often triangles wind about a point: the signed solid angles that they fill, as seen from it, over that of the whole sphere.
   A triangle counts up where its corners are counter-clockwise as seen from its side away from the point. Its half solid angle is that of
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
Definition evenly l p q := count_occ edge_dec (flat_map edges l) (p, q) = count_occ edge_dec (flat_map edges l) (q, p).

(* ---- components are triangles joined by corners at the same place. One is closed if each of its edges goes there as often as
   back. `closed_part l c`: c are those triangles of l that are of closed components *)
Definition corners_of T := [za T; zb T; zc T].
Inductive joined l T : ztri -> Prop :=
  | itself : joined l T T
  | next U W p : joined l T U -> In W l -> In p (corners_of U) -> In p (corners_of W) -> joined l T W.
Definition closed l T := forall U p q, joined l T U -> In (p, q) (edges U) -> evenly l p q.
Definition closed_part l c := exists keep, c = filter keep l /\ forall T, In T l -> (keep T = true <-> closed l T).

(* at t the closed components of b, together, wind about x so often. There is one such number, of what moves: `winds_once` *)
Definition placed m t T := mkTri (place m t (c0 T)) (place m t (c1 T)) (place m t (c2 T)).
Definition winds b t x number := exists m c, In m (pieces b) /\ Q2R (t_from m) <= t <= Q2R (t_to m) /\
  closed_part (tris b) c /\ number = winding x (map (fun T => placed (pieceR (size b) m) t (triR (den b) T)) c).

(* FREE, of insides once more, where a plane separates the bodies at some time and where none does: at no time do the closed components
   of one wind about a point of the other's triangles. Nothing is inside of what is not closed: that has a hole, a triangle that faces
   the other way than its neighbours, one that is there twice, or a stray one at a corner; nor of walls that are there both ways round *)
Definition never_wound s := forall t x, 0 <= t <= 1 -> (at_time (body_a s) t x -> winds (body_b s) t x 0) /\
  (at_time (body_b s) t x -> winds (body_a s) t x 0).
(* INSIDE, at one time: about a corner of one they do, and it is on none of the other's triangles *)
Definition corner_at b t x := exists m T p, In m (pieces b) /\ Q2R (t_from m) <= t <= Q2R (t_to m) /\
  In T (tris b) /\ In p (corners_of T) /\ x = place (pieceR (size b) m) t (pointR (den b) p).
Definition within a b t := exists x number, corner_at a t x /\ ~ at_time b t x /\ winds b t x number /\ number <> 0.

(* ---- THE STATEMENTS OF INSIDES. `frees` answers true of a FREE; `insides` Some (false, t) if a corner of a is inside of b at t,
   Some (true, t) if a corner of b is inside of a. The theorems are about any hint that both are given. *)
Definition sound_free {hint} (frees : scene -> hint -> list Z -> bool) := forall s h bytes, frees s h bytes = true ->
  never_meet s /\ never_wound s /\ moves (body_a s) /\ moves (body_b s) /\ well_posed s.
Definition sound_inside {hint} (insides : scene -> hint -> list Z -> option (bool * Q)) := forall s h bytes of_b t,
  insides s h bytes = Some (of_b, t) ->
  0 <= Q2R t <= 1 /\ (if of_b then within (body_b s) (body_a s) (Q2R t) else within (body_a s) (body_b s) (Q2R t)) /\
  moves (body_a s) /\ moves (body_b s) /\ proper (body_a s) /\ proper (body_b s).
