(* Statement.v - all that must be read to know what is proven of FREE: bodies that move, over the reals, and `sound`, which
   says what the answer of a checker of certificates is worth. Main.v proves it of the checker of Checker.v. How that reads
   a certificate's bytes and computes need not be known. What makes a `scene` of files, and what runs the checker, is to be
   believed besides. Answers.v has the other answers: HIT, NEAR, INSIDE, and FREE where no plane ever separates the bodies. *)
From Coq Require Import Reals List ZArith QArith Qreals.
Local Open Scope R_scope.

(* ---- vectors *)
Record V := mkV { vx : R; vy : R; vz : R }.
Definition dot a b := vx a * vx b + vy a * vy b + vz a * vz b.
Definition vadd a b := mkV (vx a + vx b) (vy a + vy b) (vz a + vz b).
Definition vsub a b := mkV (vx a - vx b) (vy a - vy b) (vz a - vz b).
Definition vscale k a := mkV (k * vx a) (k * vy a) (k * vz a).
Definition norm a := sqrt (dot a a).

(* ---- quaternions x y z w. `rot q` is v -> q v q^-1, for any q but 0, and `turned q` |q|^2 times that *)
Record quat := mkQ { qx : R; qy : R; qz : R; qw : R }.
Definition qdot a b := qx a * qx b + qy a * qy b + qz a * qz b + qw a * qw b.
Definition qcomb s a t b := mkQ (s * qx a + t * qx b) (s * qy a + t * qy b) (s * qz a + t * qz b) (s * qw a + t * qw b).
Definition qscale s a := mkQ (s * qx a) (s * qy a) (s * qz a) (s * qw a).
Definition turned q v := let x := qx q in let y := qy q in let z := qz q in let w := qw q in mkV
  ((w*w + x*x - y*y - z*z) * vx v + 2 * (x*y - z*w) * vy v + 2 * (x*z + y*w) * vz v)
  (2 * (x*y + z*w) * vx v + (w*w - x*x + y*y - z*z) * vy v + 2 * (y*z - x*w) * vz v)
  (2 * (x*z - y*w) * vx v + 2 * (y*z + x*w) * vy v + (w*w - x*x - y*y + z*z) * vz v).
Definition rot q v := vscale (/ qdot q q) (turned q v).

(* of unit quaternions: half the angle of the turn; and the great arc, at a share u of the way. sin h is 0 only where a = b,
   if b is the `shorter` way round *)
Definition angle a b := acos (qdot a b).
Definition slerp a b u := let h := angle a b in
  if Req_EM_T (sin h) 0 then a else qcomb (sin ((1 - u) * h) / sin h) a (sin (u * h) / sin h) b.
(* -b turns as b does. At a half turn, qdot 0, b stays as it is given: its sign picks the way round *)
Definition unitq q := qscale (/ sqrt (qdot q q)) q.
Definition shorter a b := if Rlt_dec (qdot a b) 0 then qscale (-1) b else b.

(* ---- a piece of a motion, from k0 to k1: the position linear, the rotation a slerp about the mesh's origin *)
Record piece := mkPiece { k0 : R; k1 : R; scale : R; p0 : V; p1 : V; q0 : quat; q1 : quat }.
Definition share m t := (t - k0 m) / (k1 m - k0 m).
Definition origin m t := let u := share m t in vadd (vscale (1 - u) (p0 m)) (vscale u (p1 m)).
Definition place m t x := vadd (vscale (scale m) (rot (slerp (q0 m) (q1 m) (share m t)) x)) (origin m t).

(* ---- triangles, and their points *)
Record tri := mkTri { c0 : V; c1 : V; c2 : V }.
Definition mix a b c T := vadd (vscale a (c0 T)) (vadd (vscale b (c1 T)) (vscale c (c2 T))).
Definition of_tri x T := exists a b c, 0 <= a /\ 0 <= b /\ 0 <= c /\ a + b + c = 1 /\ x = mix a b c T.

(* ---- a scene as a checker has it: exact numbers, corners in units of 1 / den. The whole motion is from time 0 to 1 *)
Record zv := mkZ { zx : Z; zy : Z; zz : Z }.
Record ztri := mkZT { za : zv; zb : zv; zc : zv }.
Record pose := mkPose { px : Q; py : Q; pz : Q; hx : Q; hy : Q; hz : Q; hw : Q }.  (* a position; a quaternion *)
Record qpiece := mkQP { t_from : Q; t_to : Q; pose_from : pose; pose_to : pose }.
Record body := mkBody { den : positive; tris : list ztri; size : Q; pieces : list qpiece }.
Record scene := mkScene { body_a : body; body_b : body; clearance : Q }.

(* ---- and what it means *)
Definition pointR d z := mkV (IZR (zx z) / IZR (Zpos d)) (IZR (zy z) / IZR (Zpos d)) (IZR (zz z) / IZR (Zpos d)).
Definition triR d T := mkTri (pointR d (za T)) (pointR d (zb T)) (pointR d (zc T)).
Definition posR p := mkV (Q2R (px p)) (Q2R (py p)) (Q2R (pz p)).
Definition quatR p := mkQ (Q2R (hx p)) (Q2R (hy p)) (Q2R (hz p)) (Q2R (hw p)).
Definition pieceR s m := mkPiece (Q2R (t_from m)) (Q2R (t_to m)) (Q2R s)
  (posR (pose_from m)) (posR (pose_to m)) (unitq (quatR (pose_from m)))
  (unitq (shorter (quatR (pose_from m)) (quatR (pose_to m)))).

(* x is a point of the body's triangles at the time t *)
Definition at_time b t x := exists m T y, In m (pieces b) /\ Q2R (t_from m) <= t <= Q2R (t_to m) /\
  In T (tris b) /\ of_tri y (triR (den b) T) /\ x = place (pieceR (size b) m) t y.

(* FREE, of surfaces: at no time does a point of a's triangles come within the clearance of one of b's *)
Definition never_meet s := forall t x y, 0 <= t <= 1 ->
  at_time (body_a s) t x -> at_time (body_b s) t y -> Q2R (clearance s) < norm (vsub x y).

(* at some time a plane has all of one body on one side and all of the other on the other *)
Definition once_apart s := exists t n, 0 <= t <= 1 /\ forall x y,
  at_time (body_a s) t x -> at_time (body_b s) t y -> 0 < dot n (vsub x y).

(* FREE, of insides: at no time is a point of one body enclosed by the other's triangles, be these closed or not. From it a
   continuous way goes beyond every bound and touches none of them, as they are at that time. *)
Definition free_way b t x := exists way : R -> V, way 0 = x /\
  continuity (fun u => vx (way u)) /\ continuity (fun u => vy (way u)) /\ continuity (fun u => vz (way u)) /\
  (forall u, 0 <= u -> ~ at_time b t (way u)) /\ (forall bound, exists u, forall v, u <= v -> bound < norm (way v)).
Definition never_inside s := forall t x, 0 <= t <= 1 -> (at_time (body_a s) t x -> free_way (body_b s) t x) /\
  (at_time (body_b s) t x -> free_way (body_a s) t x).

(* at each time a body is somewhere, and at one place only: never_meet is about one motion, and all of it *)
Definition covers b := forall t, 0 <= t <= 1 -> exists m, In m (pieces b) /\ Q2R (t_from m) <= t <= Q2R (t_to m).
Definition one_place b := forall m m' t x, In m (pieces b) -> In m' (pieces b) ->
  Q2R (t_from m) <= t <= Q2R (t_to m) -> Q2R (t_from m') <= t <= Q2R (t_to m') ->
  place (pieceR (size b) m) t x = place (pieceR (size b) m') t x.
Definition moves b := covers b /\ one_place b.

(* and nothing is degenerate but what may be: a mesh without triangles, triangles without area, a size of 0 *)
Definition proper b := 0 <= Q2R (size b) /\ forall m, In m (pieces b) -> Q2R (t_from m) < Q2R (t_to m) /\
  0 < qdot (quatR (pose_from m)) (quatR (pose_from m)) /\ 0 < qdot (quatR (pose_to m)) (quatR (pose_to m)).
Definition well_posed s := 0 <= Q2R (clearance s) /\ proper (body_a s) /\ proper (body_b s).

(* ---- THE STATEMENT. `accepts` answers Some apart where it accepts a certificate's bytes. Of None nothing is
   said; of Some false not whether one body is inside of the other. *)
Definition sound (accepts : scene -> list Z -> option bool) := forall s bytes apart,
  accepts s bytes = Some apart ->
  never_meet s /\ (apart = true -> once_apart s /\ never_inside s) /\ moves (body_a s) /\ moves (body_b s) /\ well_posed s.
