(* Geometry.v - over the reals: rigid motions between two poses (position linear, rotation a slerp),
   how far a point leaves its chord, and what a plane at two instants proves of all times between.
   No rounding here; nothing but the standard reals and Coquelicot. *)
From Coq Require Import Reals Lra Psatz.
From Coquelicot Require Import Coquelicot.
From Svcd Require Export Answers.
Local Open Scope R_scope.

(* ---- vectors *)

Lemma V_eq a b : vx a = vx b -> vy a = vy b -> vz a = vz b -> a = b.
Proof. destruct a, b; simpl; intros; subst; reflexivity. Qed.

Lemma dot_pos a : 0 <= dot a a.
Proof. unfold dot; nra. Qed.

Lemma norm_pos a : 0 <= norm a.
Proof. apply sqrt_pos. Qed.

Lemma cauchy a b : Rabs (dot a b) <= norm a * norm b.
Proof.
  unfold norm. rewrite <- sqrt_mult by apply dot_pos.
  rewrite <- sqrt_Rsqr_abs. apply sqrt_le_1_alt. unfold Rsqr, dot.
  pose proof (pow2_ge_0 (vx a * vy b - vy a * vx b)).
  pose proof (pow2_ge_0 (vx a * vz b - vz a * vx b)).
  pose proof (pow2_ge_0 (vy a * vz b - vz a * vy b)). nra.
Qed.

(* ---- rotations *)
Lemma qdot_pos q : 0 <= qdot q q.
Proof. unfold qdot; nra. Qed.

Lemma turned_norm q v : norm (turned q v) = qdot q q * norm v.
Proof.
  unfold norm. replace (dot (turned q v) (turned q v)) with (Rsqr (qdot q q) * dot v v)
    by (unfold Rsqr, dot, turned, qdot; simpl; ring).
  rewrite sqrt_mult by (apply Rle_0_sqr || apply dot_pos).
  rewrite sqrt_Rsqr by apply qdot_pos. reflexivity.
Qed.

Lemma turned_scale k q v : turned (qscale k q) v = vscale (k * k) (turned q v).
Proof. apply V_eq; unfold turned, qscale, qdot, vscale; simpl; ring. Qed.

Lemma rot_scale k q v : k <> 0 -> qdot q q <> 0 -> rot (qscale k q) v = rot q v.
Proof.
  intros K Q. unfold rot. rewrite turned_scale.
  assert (H : qdot (qscale k q) (qscale k q) = k * k * qdot q q)
    by (unfold qdot, qscale; simpl; ring).
  rewrite H. apply V_eq; unfold vscale; simpl; field; auto.
Qed.

Lemma rot_unit q v : qdot q q = 1 -> rot q v = turned q v.
Proof. intros H. unfold rot. rewrite H. apply V_eq; unfold vscale; simpl; field. Qed.

(* ---- slerp *)
Lemma unit_dot a b : qdot a a = 1 -> qdot b b = 1 -> -1 <= qdot a b <= 1.
Proof.
  intros A B.
  pose proof (qdot_pos (qcomb 1 a 1 b)) as P. pose proof (qdot_pos (qcomb 1 a (-1) b)) as M.
  assert (EP : qdot (qcomb 1 a 1 b) (qcomb 1 a 1 b) = qdot a a + qdot b b + 2 * qdot a b)
    by (unfold qdot, qcomb; simpl; ring).
  assert (EM : qdot (qcomb 1 a (-1) b) (qcomb 1 a (-1) b) = qdot a a + qdot b b - 2 * qdot a b)
    by (unfold qdot, qcomb; simpl; ring).
  lra.
Qed.

(* a slerp is a turn at a constant rate in the plane of a and of e, which is across it *)
Lemma slerp_plane a b : qdot a a = 1 -> qdot b b = 1 -> sin (angle a b) <> 0 ->
  exists e, qdot e e = 1 /\ qdot a e = 0 /\
    b = qcomb (cos (angle a b)) a (sin (angle a b)) e /\
    forall u, slerp a b u = qcomb (cos (u * angle a b)) a (sin (u * angle a b)) e.
Proof.
  intros A B S. set (h := angle a b) in *.
  assert (C : cos h = qdot a b) by (apply cos_acos, unit_dot; auto).
  assert (T : sin h * sin h = 1 - cos h * cos h).
  { pose proof (sin2_cos2 h) as X. unfold Rsqr in X. lra. }
  exists (qcomb (/ sin h) b (- cos h / sin h) a). split; [|split; [|split]].
  - replace (qdot _ _) with ((qdot b b - 2 * cos h * qdot a b + cos h * cos h * qdot a a) / (sin h * sin h))
      by (unfold qdot, qcomb; simpl; field; auto).
    rewrite A, B, <- C, T. field. rewrite <- T. nra.
  - replace (qdot _ _) with ((qdot a b - cos h * qdot a a) / sin h)
      by (unfold qdot, qcomb; simpl; field; auto).
    rewrite A, <- C. field. auto.
  - destruct b. unfold qcomb; simpl; f_equal; field; auto.
  - intros u. unfold slerp. fold h. destruct (Req_EM_T (sin h) 0) as [Z|_]; [contradiction|].
    replace ((1 - u) * h) with (h - u * h) by ring. rewrite sin_minus.
    unfold qcomb; simpl; f_equal; field; auto.
Qed.

Lemma slerp_unit a b u : qdot a a = 1 -> qdot b b = 1 -> qdot (slerp a b u) (slerp a b u) = 1.
Proof.
  intros A B. destruct (Req_EM_T (sin (angle a b)) 0) as [Z|Z].
  - unfold slerp. destruct (Req_EM_T (sin (angle a b)) 0); [auto|contradiction].
  - destruct (slerp_plane a b A B Z) as (e & E & O & _ & H). rewrite H.
    set (c := cos _). set (s := sin _).
    replace (qdot _ _) with (c * c * qdot a a + s * s * qdot e e + 2 * c * s * qdot a e)
      by (unfold qdot, qcomb; simpl; ring).
    rewrite A, E, O. pose proof (sin2_cos2 (u * angle a b)) as X. unfold Rsqr in X.
    fold c s in X. lra.
Qed.

(* ---- the axis of a turn from a to b, not made unit: as the body has it, and as the world does *)
Definition body_axis a b := mkV
  (qw a * qx b - qw b * qx a - (qy a * qz b - qz a * qy b))
  (qw a * qy b - qw b * qy a - (qz a * qx b - qx a * qz b))
  (qw a * qz b - qw b * qz a - (qx a * qy b - qy a * qx b)).
Definition world_axis a b := mkV
  (qw a * qx b - qw b * qx a + (qy a * qz b - qz a * qy b))
  (qw a * qy b - qw b * qy a + (qz a * qx b - qx a * qz b))
  (qw a * qz b - qw b * qz a + (qx a * qy b - qy a * qx b)).

Lemma body_axis_square a b :
  dot (body_axis a b) (body_axis a b) = qdot a a * qdot b b - qdot a b * qdot a b.
Proof. unfold dot, body_axis, qdot; simpl; ring. Qed.

Lemma world_axis_square a b :
  dot (world_axis a b) (world_axis a b) = qdot a a * qdot b b - qdot a b * qdot a b.
Proof. unfold dot, world_axis, qdot; simpl; ring. Qed.

(* all along the turn the body's axis is at the world's *)
Lemma axis_stays a e c s : let q := qcomb c a s e in
  turned q (body_axis a e) = vscale (qdot q q) (world_axis a e).
Proof. apply V_eq; unfold turned, body_axis, world_axis, vscale, qdot, qcomb; simpl; ring. Qed.

Lemma turned_cross q u v : cross (turned q u) (turned q v) = vscale (qdot q q) (turned q (cross u v)).
Proof. apply V_eq; unfold cross, turned, vscale, qdot; simpl; ring. Qed.

(* a quaternion across q is half a turn on, about the axis w: what is along it is where it was *)
Lemma half_turn q r x : qdot q q = 1 -> qdot r r = 1 -> qdot q r = 0 ->
  let w := body_axis q r in vsub (turned q x) (turned r x) = vscale 2 (turned q (cross w (cross x w))).
Proof.
  intros Q R O w.
  assert (W : dot w w = 1) by (unfold w; rewrite body_axis_square, Q, R, O; ring).
  set (y := vsub (vscale 2 (vscale (dot w x) w)) (vscale (dot w w) x)).
  assert (G : vscale (qdot q q * qdot q q) (turned r x) = turned q (vadd y
      (vadd (vscale (qdot q r * qdot q r) x) (vscale (2 * qdot q r) (cross w x)))))
    by (unfold y, w; apply V_eq; unfold turned, vadd, vsub, vscale, cross, dot, body_axis, qdot; simpl; ring).
  assert (E : turned r x = turned q y).
  { rewrite Q, O in G. transitivity (vscale (1 * 1) (turned r x)).
    - apply V_eq; unfold vscale; simpl; ring.
    - rewrite G. f_equal. apply V_eq; unfold vadd, vscale; simpl; ring. }
  rewrite E. unfold y. rewrite W.
  replace (cross w (cross x w)) with (vsub (vscale (dot w w) x) (vscale (dot w x) w))
    by (apply V_eq; unfold cross, vsub, vscale, dot; simpl; ring).
  rewrite W. apply V_eq; unfold turned, vsub, vscale; simpl; ring.
Qed.

Lemma cross_norm a b : norm (cross a b) <= norm a * norm b.
Proof.
  unfold norm. rewrite <- sqrt_mult by apply dot_pos. apply sqrt_le_1_alt.
  replace (dot (cross a b) (cross a b)) with (dot a a * dot b b - dot a b * dot a b)
    by (unfold dot, cross; simpl; ring).
  pose proof (pow2_ge_0 (dot a b)). lra.
Qed.

Lemma norm_vadd a b : norm (vadd a b) <= norm a + norm b.
Proof.
  pose proof (norm_pos a). pose proof (norm_pos b). apply Rsqr_incr_0_var; [|lra].
  pose proof (cauchy a b) as C. pose proof (Rle_abs (dot a b)).
  unfold norm in *. rewrite Rsqr_plus, !Rsqr_sqrt by apply dot_pos.
  replace (dot (vadd a b) (vadd a b)) with (dot a a + dot b b + 2 * dot a b)
    by (unfold dot, vadd; simpl; ring). lra.
Qed.

Lemma norm_vscale k a : 0 <= k -> norm (vscale k a) = k * norm a.
Proof.
  intros K. unfold norm. replace (dot (vscale k a) (vscale k a)) with (Rsqr k * dot a a)
    by (unfold Rsqr, dot, vscale; simpl; ring).
  rewrite sqrt_mult, sqrt_Rsqr by (auto || apply Rle_0_sqr || apply dot_pos). reflexivity.
Qed.

(* no point of a triangle is farther from an axis than a corner *)
Lemma cross_mix a b c T w : 0 <= a -> 0 <= b -> 0 <= c ->
  norm (cross (mix a b c T) w) <= a * norm (cross (c0 T) w) + (b * norm (cross (c1 T) w) + c * norm (cross (c2 T) w)).
Proof.
  intros A B C. rewrite <- !norm_vscale by auto.
  replace (cross (mix a b c T) w) with (vadd (vscale a (cross (c0 T) w))
    (vadd (vscale b (cross (c1 T) w)) (vscale c (cross (c2 T) w))))
    by (apply V_eq; unfold cross, mix, vadd, vscale; simpl; ring).
  eapply Rle_trans; [apply norm_vadd|]. apply Rplus_le_compat_l, norm_vadd.
Qed.

(* ---- what leaves its chord *)
Lemma concave_above (h h1 h2 : R -> R) a b :
  (forall v, derivable_pt_lim h v (h1 v)) -> (forall v, derivable_pt_lim h1 v (h2 v)) ->
  (forall v, a <= v <= b -> h2 v <= 0) -> h a = 0 -> h b = 0 -> forall v, a <= v <= b -> 0 <= h v.
Proof.
  intros D1 D2 N A B v [L U].
  destruct (Req_dec v a) as [->|Na]; [lra|]. destruct (Req_dec v b) as [->|Nb]; [lra|].
  destruct (MVT_cor2 h h1 a v) as (c1 & E1 & I1); [lra|auto|].
  destruct (MVT_cor2 h h1 v b) as (c2 & E2 & I2); [lra|auto|].
  destruct (MVT_cor2 h1 h2 c1 c2) as (c3 & E3 & I3); [lra|auto|].
  specialize (N c3 ltac:(lra)). assert (h1 c2 <= h1 c1) by nra.
  destruct (Rle_dec 0 (h v)) as [|M]; [auto|exfalso].
  assert (h1 c1 < 0) by nra. assert (0 < h1 c2) by nra. lra.
Qed.

Lemma trig_chord A B C D w K u0 u1 u :
  (forall p, C * cos p + D * sin p <= K) -> 0 <= K -> u0 <= u <= u1 -> u0 < u1 ->
  let f v := A + B * v + C * cos (w * v) + D * sin (w * v) in
  ((u1 - u) * f u0 + (u - u0) * f u1) / (u1 - u0) - K * (w * (u1 - u0)) ^ 2 / 8 <= f u.
Proof.
  intros H K0 I L f.
  (* -f'' = w^2 (C cos + D sin) is needed from the other side: K bounds both, by p + pi *)
  assert (H' : forall p, - K <= C * cos p + D * sin p).
  { intros p. specialize (H (p + PI)). rewrite neg_cos, neg_sin in H. lra. }
  set (chord := fun v => ((u1 - v) * f u0 + (v - u0) * f u1) / (u1 - u0)).
  set (h := fun v => f v - chord v + K * w ^ 2 / 2 * (v - u0) * (u1 - v)).
  set (h1 := fun v => B - C * w * sin (w * v) + D * w * cos (w * v) - (f u1 - f u0) / (u1 - u0)
                      + K * w ^ 2 / 2 * (u0 + u1 - 2 * v)).
  set (h2 := fun v => - w ^ 2 * (C * cos (w * v) + D * sin (w * v)) - K * w ^ 2).
  assert (P : 0 <= h u).
  { apply (concave_above h h1 h2 u0 u1); auto.
    - intros v. apply is_derive_Reals. unfold h, h1, chord.
      generalize (f u0) (f u1); intros; unfold f. auto_derive; [lra|field; lra].
    - intros v. apply is_derive_Reals. unfold h1, h2.
      generalize (f u0) (f u1); intros. auto_derive; [auto|field].
    - intros v _. unfold h2. specialize (H' (w * v)). pose proof (pow2_ge_0 w). nra.
    - unfold h, chord. field. lra.
    - unfold h, chord. field. lra. }
  unfold h in P. fold (chord u).
  assert ((u - u0) * (u1 - u) <= (u1 - u0) ^ 2 / 4) by (pose proof (pow2_ge_0 (2 * u - u0 - u1)); nra).
  pose proof (pow2_ge_0 w). assert (0 <= K * w ^ 2) by nra.
  replace (K * (w * (u1 - u0)) ^ 2 / 8) with (K * w ^ 2 / 2 * ((u1 - u0) ^ 2 / 4)) by field.
  nra.
Qed.

(* ---- a piece of a motion: between the times k0 < k1, from one pose to the next *)
Definition well_formed m := k0 m < k1 m /\ 0 <= scale m /\ qdot (q0 m) (q0 m) = 1 /\ qdot (q1 m) (q1 m) = 1.
(* how far, at most, x leaves its chord from s to e along n: an eighth of the square of the turn, for
   each metre from the axis w, and of n what is across that. Without a turn w and this are 0. *)
Definition bulge m s e := scale m * (2 * angle (q0 m) (q1 m) * ((e - s) / (k1 m - k0 m))) ^ 2 / 8.
Definition across a b n x :=
  norm (cross n (world_axis a b)) * norm (cross x (body_axis a b)) / dot (body_axis a b) (body_axis a b).
Definition deviation m s e n x := bulge m s e * across (q0 m) (q1 m) n x.

Lemma bulge_pos m s e : 0 <= scale m -> 0 <= bulge m s e.
Proof. intros. unfold bulge. pose proof (pow2_ge_0 (2 * angle (q0 m) (q1 m) * ((e - s) / (k1 m - k0 m)))). nra. Qed.

Lemma turned_wave a e phi x n : qdot a a = 1 -> qdot e e = 1 -> qdot a e = 0 ->
  dot n (turned (qcomb (cos phi) a (sin phi) e) x) =
  (dot n (turned a x) + dot n (turned e x)) / 2
  + (dot n (turned a x) - dot n (turned e x)) / 2 * cos (2 * phi)
  + (dot n (turned (qcomb 1 a 1 e) x) - dot n (turned a x) - dot n (turned e x)) / 2 * sin (2 * phi).
Proof.
  intros A E O. rewrite cos_2a, sin_2a.
  set (c := cos phi). set (s := sin phi).
  assert (CS : c * c + s * s = 1) by (pose proof (sin2_cos2 phi) as X; unfold Rsqr in X; unfold c, s; lra).
  replace (dot n (turned (qcomb c a s e) x)) with
    (c * c * dot n (turned a x) + s * s * dot n (turned e x)
     + c * s * (dot n (turned (qcomb 1 a 1 e) x) - dot n (turned a x) - dot n (turned e x)))
    by (unfold dot, turned, qdot, qcomb; simpl; ring).
  assert (X : s * s = 1 - c * c) by lra. rewrite X. field.
Qed.

Lemma across_pos a b n x : 0 <= across a b n x.
Proof.
  unfold across. destruct (dot_pos (body_axis a b)) as [P|Z].
  - apply Rmult_le_pos; [apply Rmult_le_pos; apply norm_pos|apply Rlt_le, Rinv_0_lt_compat, P].
  - replace (norm (cross x (body_axis a b))) with 0; [unfold Rdiv; lra|].
    pose proof (cross_norm x (body_axis a b)) as X. pose proof (norm_pos (cross x (body_axis a b))).
    replace (norm (body_axis a b)) with 0 in X; [lra|]. unfold norm. rewrite <- Z, sqrt_0. reflexivity.
Qed.

(* the axis from a to b = cos h a + sin h e is sin h times that from a to e *)
Lemma across_plane a b e h n x : qdot a a = 1 -> qdot e e = 1 -> qdot a e = 0 -> sin h <> 0 ->
  b = qcomb (cos h) a (sin h) e ->
  across a b n x = norm (cross n (world_axis a e)) * norm (cross x (body_axis a e)).
Proof.
  intros A E O S ->. unfold across.
  assert (B : body_axis a (qcomb (cos h) a (sin h) e) = vscale (sin h) (body_axis a e))
    by (apply V_eq; unfold body_axis, vscale, qcomb; simpl; ring).
  assert (W : world_axis a (qcomb (cos h) a (sin h) e) = vscale (sin h) (world_axis a e))
    by (apply V_eq; unfold world_axis, vscale, qcomb; simpl; ring).
  assert (K : forall v w, norm (cross v (vscale (sin h) w)) = Rabs (sin h) * norm (cross v w)).
  { intros v w. unfold norm. rewrite <- sqrt_Rsqr_abs, <- sqrt_mult by (apply Rle_0_sqr || apply dot_pos).
    f_equal. unfold Rsqr, dot, cross, vscale; simpl; ring. }
  rewrite B, W, !K.
  replace (dot (vscale (sin h) (body_axis a e)) (vscale (sin h) (body_axis a e)))
    with (Rabs (sin h) * Rabs (sin h) * dot (body_axis a e) (body_axis a e)).
  2:{ rewrite <- Rabs_mult, Rabs_pos_eq by nra. unfold dot, vscale; simpl; ring. }
  rewrite body_axis_square, A, E, O. field. apply Rabs_no_R0, S.
Qed.

(* the part along the axis does not move: n . R x differs from what it is half a turn on by no more *)
Lemma wave_bound a e phi n x : qdot a a = 1 -> qdot e e = 1 -> qdot a e = 0 ->
  dot n (turned (qcomb (cos phi) a (sin phi) e) x) - dot n (turned (qcomb (- sin phi) a (cos phi) e) x)
    <= 2 * (norm (cross n (world_axis a e)) * norm (cross x (body_axis a e))).
Proof.
  intros A E O. set (c := cos phi). set (s := sin phi).
  assert (CS : c * c + s * s = 1) by (pose proof (sin2_cos2 phi) as X; unfold Rsqr in X; unfold c, s; lra).
  set (q := qcomb c a s e). set (r := qcomb (- s) a c e). set (w := body_axis a e).
  assert (Q : qdot q q = 1).
  { replace (qdot q q) with (c * c * qdot a a + s * s * qdot e e + 2 * (c * s) * qdot a e)
      by (unfold q, qdot, qcomb; simpl; ring). rewrite A, E, O. lra. }
  assert (R : qdot r r = 1).
  { replace (qdot r r) with (s * s * qdot a a + c * c * qdot e e - 2 * (c * s) * qdot a e)
      by (unfold r, qdot, qcomb; simpl; ring). rewrite A, E, O. lra. }
  assert (QR : qdot q r = 0).
  { replace (qdot q r) with (c * s * (qdot e e - qdot a a) + (c * c - s * s) * qdot a e)
      by (unfold q, r, qdot, qcomb; simpl; ring). rewrite A, E, O. ring. }
  assert (W : body_axis q r = w).
  { transitivity (vscale (c * c + s * s) w).
    - unfold q, r, w. apply V_eq; unfold body_axis, vscale, qcomb; simpl; ring.
    - rewrite CS. apply V_eq; unfold vscale; simpl; ring. }
  assert (Sub : dot n (turned q x) - dot n (turned r x) = dot n (vsub (turned q x) (turned r x)))
    by (unfold dot, vsub; simpl; ring).
  rewrite Sub, half_turn, W by auto.
  assert (T : turned q (cross w (cross x w)) = cross (world_axis a e) (turned q (cross x w))).
  { assert (S : turned q w = world_axis a e).
    { transitivity (vscale (qdot q q) (world_axis a e)); [apply axis_stays|].
      rewrite Q. apply V_eq; unfold vscale; simpl; ring. }
    rewrite <- S, turned_cross, Q. apply V_eq; unfold vscale; simpl; ring. }
  rewrite T. set (d := turned q (cross x w)).
  replace (dot n (vscale 2 (cross (world_axis a e) d))) with (2 * dot (cross n (world_axis a e)) d)
    by (unfold dot, cross, vscale; simpl; ring).
  pose proof (cauchy (cross n (world_axis a e)) d) as C.
  pose proof (Rle_abs (dot (cross n (world_axis a e)) d)).
  replace (norm d) with (norm (cross x w)) in C by (unfold d; rewrite turned_norm, Q; ring).
  lra.
Qed.

Theorem leaves_chord m n x s e t : well_formed m -> s < e -> s <= t <= e ->
  ((e - t) * dot n (place m s x) + (t - s) * dot n (place m e x)) / (e - s)
    - deviation m s e n x <= dot n (place m t x).
Proof.
  intros (K & S & A & B) L I.
  set (f := fun v => dot n (vadd (vscale (scale m) (turned (slerp (q0 m) (q1 m) v) x))
                                 (vadd (vscale (1 - v) (p0 m)) (vscale v (p1 m))))).
  assert (F : forall v, dot n (place m v x) = f (share m v)).
  { intros v. unfold place, origin. rewrite rot_unit by (apply slerp_unit; auto). reflexivity. }
  rewrite !F. set (d := k1 m - k0 m).
  assert (D : 0 < d) by (unfold d; lra).
  assert (U : forall v w, share m v - share m w = (v - w) / d) by (intros; unfold share, d; field; unfold d in D; lra).
  set (us := share m s). set (ue := share m e). set (u := share m t).
  assert (Lu : us < ue). { assert (0 < ue - us); [unfold ue, us; rewrite U|lra]. apply Rdiv_lt_0_compat; lra. }
  assert (Iu : us <= u <= ue).
  { split; [assert (0 <= u - us)|assert (0 <= ue - u)]; try lra; unfold ue, us, u; rewrite U;
    apply Rmult_le_pos; try lra; apply Rlt_le, Rinv_0_lt_compat; lra. }
  replace (((e - t) * f us + (t - s) * f ue) / (e - s))
    with (((ue - u) * f us + (u - us) * f ue) / (ue - us)).
  2:{ unfold ue, us, u. rewrite !U. fold us ue. field. lra. }
  unfold deviation.
  replace (bulge m s e) with (scale m * (2 * angle (q0 m) (q1 m) * (ue - us)) ^ 2 / 8)
    by (unfold bulge, ue, us; rewrite U; reflexivity).
  set (h := angle (q0 m) (q1 m)) in *. set (a := q0 m) in *.
  pose proof (pow2_ge_0 (2 * h * (ue - us))) as Sq.
  destruct (Req_EM_T (sin h) 0) as [Z|Z].
  - (* no turn: straight *)
    assert (E : forall v, slerp a (q1 m) v = a).
    { intros v. unfold slerp. fold a h. destruct (Req_EM_T _ 0); [auto|contradiction]. }
    assert (G : ((ue - u) * f us + (u - us) * f ue) / (ue - us) = f u).
    { unfold f. rewrite !E. unfold dot, vadd, vscale; simpl. field. lra. }
    rewrite G. pose proof (across_pos a (q1 m) n x).
    assert (0 <= scale m * (2 * h * (ue - us)) ^ 2 / 8 * across a (q1 m) n x); [|lra].
    apply Rmult_le_pos; [nra|auto].
  - destruct (slerp_plane a (q1 m) A B Z) as (w & W & O & Eb & P). fold h in Eb, P.
    rewrite (across_plane a (q1 m) w h n x A W O Z Eb).
    set (K0 := norm (cross n (world_axis a w)) * norm (cross x (body_axis a w))).
    assert (K0p : 0 <= K0) by (apply Rmult_le_pos; apply norm_pos).
    set (al := (dot n (turned a x) + dot n (turned w x)) / 2).
    set (be := (dot n (turned a x) - dot n (turned w x)) / 2).
    set (ga := (dot n (turned (qcomb 1 a 1 w) x) - dot n (turned a x) - dot n (turned w x)) / 2).
    assert (W1 : forall phi, dot n (turned (qcomb (cos phi) a (sin phi) w) x)
                            = al + be * cos (2 * phi) + ga * sin (2 * phi))
      by (intros; apply turned_wave; auto).
    (* the wave alone is half the difference of what is there now and half a turn on *)
    assert (Wv : forall p, be * cos p + ga * sin p <= K0).
    { intros p. pose proof (wave_bound a w (p / 2) n x A W O) as X. fold K0 in X.
      replace (- sin (p / 2)) with (cos (p / 2 + PI / 2)) in X by (rewrite cos_plus, cos_PI2, sin_PI2; ring).
      replace (qcomb (cos (p / 2 + PI / 2)) a (cos (p / 2)) w)
        with (qcomb (cos (p / 2 + PI / 2)) a (sin (p / 2 + PI / 2)) w) in X
        by (f_equal; rewrite sin_plus, cos_PI2, sin_PI2; ring).
      rewrite !W1 in X. replace (2 * (p / 2)) with p in X by field.
      replace (2 * (p / 2 + PI / 2)) with (p + PI) in X by field.
      rewrite neg_cos, neg_sin in X. lra. }
    set (c0 := dot n (p0 m)). set (c1 := dot n (p1 m)).
    assert (G : forall v, f v = (scale m * al + c0) + (c1 - c0) * v
        + scale m * be * cos (2 * h * v) + scale m * ga * sin (2 * h * v)).
    { intros v. unfold f. rewrite P.
      replace (dot n _) with (scale m * dot n (turned (qcomb (cos (v * h)) a (sin (v * h)) w) x)
         + (1 - v) * c0 + v * c1) by (unfold c0, c1, dot, vadd, vscale; simpl; ring).
      rewrite W1. replace (2 * (v * h)) with (2 * h * v) by ring. ring. }
    rewrite !G.
    pose proof (trig_chord (scale m * al + c0) (c1 - c0) (scale m * be) (scale m * ga) (2 * h)
                  (scale m * K0) us ue u) as T.
    cbv zeta in T.
    replace (scale m * (2 * h * (ue - us)) ^ 2 / 8 * K0) with (scale m * K0 * (2 * h * (ue - us)) ^ 2 / 8) by field.
    apply T; auto; [|apply Rmult_le_pos; auto].
    intros p. specialize (Wv p). nra.
Qed.

(* not about an axis: the bound by the distance from the origin, for turns too small to have one *)
Lemma deviation_radius m s e n x : well_formed m ->
  deviation m s e n x <= bulge m s e * (norm n * norm x).
Proof.
  intros (_ & S & A & B). unfold deviation. apply Rmult_le_compat_l; [apply bulge_pos, S|].
  unfold across. set (a := q0 m) in *. set (b := q1 m) in *.
  assert (N : norm (world_axis a b) = norm (body_axis a b))
    by (unfold norm; rewrite world_axis_square, body_axis_square; reflexivity).
  pose proof (cross_norm n (world_axis a b)) as X. pose proof (cross_norm x (body_axis a b)) as Y.
  rewrite N in X. pose proof (norm_pos n). pose proof (norm_pos x). pose proof (norm_pos (body_axis a b)) as [P|Z].
  - assert (E : dot (body_axis a b) (body_axis a b) = norm (body_axis a b) * norm (body_axis a b))
      by (unfold norm; rewrite sqrt_sqrt by apply dot_pos; reflexivity).
    rewrite E. set (w := norm (body_axis a b)) in *.
    apply Rmult_le_reg_r with (w * w); [nra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by nra.
    pose proof (norm_pos (cross n (world_axis a b))). pose proof (norm_pos (cross x (body_axis a b))).
    rewrite Rmult_1_r. replace (norm n * norm x * (w * w)) with ((norm n * w) * (norm x * w)) by ring.
    apply Rmult_le_compat; auto.
  - pose proof (norm_pos (cross x (body_axis a b))). rewrite <- Z, Rmult_0_r in Y.
    replace (norm (cross x (body_axis a b))) with 0 by lra. unfold Rdiv. rewrite Rmult_0_r, Rmult_0_l.
    apply Rmult_le_pos; auto.
Qed.

(* ---- a plane of normal n at two instants separates two points at all times between, by more than c *)
Theorem plane_separates ma mb n c s e x y :
  well_formed ma -> well_formed mb -> s <= e ->
  let least := norm n * c + (deviation ma s e n x + deviation mb s e n y) in
  least < dot n (vsub (place ma s x) (place mb s y)) ->
  least < dot n (vsub (place ma e x) (place mb e y)) ->
  forall t, s <= t <= e -> norm n * c < dot n (vsub (place ma t x) (place mb t y)) /\
    c < norm (vsub (place ma t x) (place mb t y)).
Proof.
  intros Wa Wb SE least Hs He t I.
  assert (Pa : 0 <= deviation ma s e n x) by (apply Rmult_le_pos; [apply bulge_pos, Wa|apply across_pos]).
  assert (Pb : 0 <= deviation mb s e n y) by (apply Rmult_le_pos; [apply bulge_pos, Wb|apply across_pos]).
  assert (Sub : forall a b, dot n (vsub a b) = dot n a - dot n b)
    by (intros; unfold dot, vsub; simpl; ring).
  assert (Main : norm n * c < dot n (vsub (place ma t x) (place mb t y))).
  { destruct (Req_dec s e) as [E|E].
    - assert (t = s) by lra. subst t. unfold least in Hs. lra.
    - assert (L : s < e) by lra.
      pose proof (leaves_chord ma n x s e t Wa L I) as A.
      pose proof (leaves_chord mb (vscale (-1) n) y s e t Wb L I) as B.
      assert (M : forall v, dot (vscale (-1) n) v = - dot n v)
        by (intros; unfold dot, vscale; simpl; ring).
      assert (Nm : deviation mb s e (vscale (-1) n) y = deviation mb s e n y).
      { unfold deviation, across. do 3 f_equal.
        unfold norm; f_equal; unfold dot, cross, vscale; simpl; ring. }
      rewrite !M, Nm in B. rewrite Sub in *.
      set (as_ := dot n (place ma s x)) in *. set (ae := dot n (place ma e x)) in *.
      set (bs := dot n (place mb s y)) in *. set (be := dot n (place mb e y)) in *.
      assert (C : least < ((e - t) * (as_ - bs) + (t - s) * (ae - be)) / (e - s)).
      { apply Rmult_lt_reg_r with (e - s); [lra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra.
        rewrite Rmult_1_r. destruct (Req_dec t s) as [->|]; nra. }
      replace (((e - t) * (as_ - bs) + (t - s) * (ae - be)) / (e - s)) with
        (((e - t) * as_ + (t - s) * ae) / (e - s) + ((e - t) * - bs + (t - s) * - be) / (e - s)) in C
        by (field; lra).
      unfold least in C. lra. }
  pose proof (cauchy n (vsub (place ma t x) (place mb t y))) as X.
  pose proof (Rle_abs (dot n (vsub (place ma t x) (place mb t y)))). pose proof (norm_pos n).
  split; [exact Main|]. set (d := norm (vsub _ _)) in *. nra.
Qed.

(* ---- the angle, as a checker reckons it *)
Lemma angle_atan a b : qdot a a = 1 -> qdot b b = 1 -> 0 <= qdot a b ->
  angle a b = 2 * atan (sqrt (qdot (qcomb 1 b (-1) a) (qcomb 1 b (-1) a))
                        / sqrt (qdot (qcomb 1 b 1 a) (qcomb 1 b 1 a))).
Proof.
  intros A B D. pose proof (unit_dot a b A B) as U.
  replace (qdot (qcomb 1 b (-1) a) _) with (qdot b b + qdot a a - 2 * qdot a b)
    by (unfold qdot, qcomb; simpl; ring).
  replace (qdot (qcomb 1 b 1 a) _) with (qdot b b + qdot a a + 2 * qdot a b)
    by (unfold qdot, qcomb; simpl; ring).
  rewrite A, B. unfold angle. set (d := qdot a b) in *.
  set (r := sqrt (1 + 1 - 2 * d) / sqrt (1 + 1 + 2 * d)).
  assert (S : 0 < sqrt (1 + 1 + 2 * d)) by (apply sqrt_lt_R0; lra).
  assert (R0 : 0 <= r) by (apply Rmult_le_pos; [apply sqrt_pos|apply Rlt_le, Rinv_0_lt_compat; auto]).
  assert (R2 : r * r = (1 - d) / (1 + d)).
  { unfold r. replace (_ / _ * (_ / _)) with
      ((sqrt (1 + 1 - 2 * d) * sqrt (1 + 1 - 2 * d)) / (sqrt (1 + 1 + 2 * d) * sqrt (1 + 1 + 2 * d)))
      by (field; lra).
    rewrite !sqrt_sqrt by lra. field. lra. }
  assert (P : 0 <= atan r < PI / 2).
  { split; [|apply atan_bound]. rewrite <- atan_0. destruct R0 as [L|E].
    - apply Rlt_le, atan_increasing; auto.
    - rewrite <- E. lra. }
  rewrite <- (acos_cos (2 * atan r)) by lra. f_equal.
  rewrite cos_2a_cos, cos_atan. replace (r²) with (r * r) by reflexivity. rewrite R2.
  assert (Q : 0 < 1 + (1 - d) / (1 + d)).
  { replace (1 + (1 - d) / (1 + d)) with (2 / (1 + d)) by (field; lra). apply Rdiv_lt_0_compat; lra. }
  replace (2 * (1 / sqrt (1 + (1 - d) / (1 + d))) * (1 / sqrt (1 + (1 - d) / (1 + d))))
    with (2 / (sqrt (1 + (1 - d) / (1 + d)) * sqrt (1 + (1 - d) / (1 + d))))
    by (field; apply Rgt_not_eq, sqrt_lt_R0; auto).
  rewrite sqrt_sqrt by lra. field. split; lra.
Qed.

Lemma angle_range a b : qdot a a = 1 -> qdot b b = 1 -> 0 <= qdot a b -> 0 <= angle a b <= PI / 2.
Proof.
  intros A B D. pose proof (unit_dot a b A B) as U. unfold angle.
  split; [apply acos_bound|].
  destruct (Rle_dec (acos (qdot a b)) (PI / 2)); auto. exfalso.
  assert (cos (acos (qdot a b)) < 0).
  { apply cos_lt_0; pose proof (acos_bound (qdot a b)); pose proof PI_RGT_0; lra. }
  rewrite cos_acos in H by lra. lra.
Qed.

(* slerp without its division: the rotation is the same wherever it is not 0 *)
Definition slerp_raw a b u := let h := angle a b in
  qcomb (sin ((1 - u) * h)) a (sin (u * h)) b.

Lemma slerp_raw_rot a b u v : qdot a a = 1 -> qdot b b = 1 -> 0 <= qdot a b ->
  qdot (slerp_raw a b u) (slerp_raw a b u) <> 0 ->
  rot (slerp_raw a b u) v = rot (slerp a b u) v.
Proof.
  intros A B D N. pose proof (angle_range a b A B D) as [L U].
  set (h := angle a b) in *.
  assert (S : sin h <> 0).
  { intros Z. assert (h = 0).
    { destruct L as [L|]; auto. exfalso. pose proof (sin_gt_0 h L). pose proof PI_RGT_0. lra. }
    apply N. unfold slerp_raw. fold h. rewrite H.
    replace ((1 - u) * 0) with 0 by ring. replace (u * 0) with 0 by ring. rewrite sin_0.
    unfold qdot, qcomb; simpl; ring. }
  replace (slerp_raw a b u) with (qscale (sin h) (slerp a b u)).
  - apply rot_scale; auto. rewrite slerp_unit by auto; lra.
  - unfold slerp, slerp_raw. fold h. destruct (Req_EM_T (sin h) 0); [contradiction|].
    unfold qscale, qcomb; simpl; f_equal; field; auto.
Qed.

(* ---- from quaternions as they are given *)
Lemma unitq_unit q : 0 < qdot q q -> qdot (unitq q) (unitq q) = 1.
Proof.
  intros H. unfold unitq. set (r := sqrt (qdot q q)).
  replace (qdot _ _) with (/ r * / r * qdot q q) by (unfold qdot, qscale; simpl; ring).
  assert (0 < r) by (apply sqrt_lt_R0; auto).
  assert (E : qdot q q = r * r) by (unfold r; rewrite sqrt_sqrt; lra).
  rewrite E. field. lra.
Qed.

Lemma shorter_norm a b : qdot (shorter a b) (shorter a b) = qdot b b.
Proof. unfold shorter. destruct Rlt_dec; auto. unfold qdot, qscale; simpl; ring. Qed.

Lemma shorter_dot a b : 0 < qdot a a -> 0 < qdot b b -> 0 <= qdot (unitq a) (unitq (shorter a b)).
Proof.
  intros A B. unfold unitq. rewrite shorter_norm.
  assert (0 < / sqrt (qdot a a)) by (apply Rinv_0_lt_compat, sqrt_lt_R0; auto).
  assert (0 < / sqrt (qdot b b)) by (apply Rinv_0_lt_compat, sqrt_lt_R0; auto).
  set (x := / sqrt (qdot a a)) in *. set (y := / sqrt (qdot b b)) in *.
  replace (qdot _ _) with (x * y * qdot a (shorter a b)) by (unfold qdot, qscale; simpl; ring).
  apply Rmult_le_pos; [nra|]. unfold shorter. destruct Rlt_dec; [|lra].
  replace (qdot a (qscale (-1) b)) with (- qdot a b) by (unfold qdot, qscale; simpl; ring). lra.
Qed.

(* ---- a slerp is where it ought to be at both ends, so that pieces that share a pose agree at the knot *)
Lemma quat_eq a b : qx a = qx b -> qy a = qy b -> qz a = qz b -> qw a = qw b -> a = b.
Proof. destruct a, b; simpl; intros; subst; reflexivity. Qed.

Lemma slerp_0 a b : slerp a b 0 = a.
Proof.
  unfold slerp. destruct (Req_EM_T (sin (angle a b)) 0) as [Z|Z]; auto.
  replace ((1 - 0) * angle a b) with (angle a b) by ring. rewrite Rmult_0_l, sin_0.
  apply quat_eq; unfold qcomb; simpl; field; auto.
Qed.

Lemma slerp_1 a b : qdot a a = 1 -> qdot b b = 1 -> 0 <= qdot a b -> slerp a b 1 = b.
Proof.
  intros A B D. pose proof (angle_range a b A B D) as [L U].
  unfold slerp. destruct (Req_EM_T (sin (angle a b)) 0) as [Z|Z].
  - assert (H : angle a b = 0).
    { destruct L as [L|]; auto. pose proof (sin_gt_0 _ L). pose proof PI_RGT_0. lra. }
    assert (E : qdot a b = 1).
    { rewrite <- cos_0, <- H. symmetry. apply cos_acos, unit_dot; auto. }
    assert (N : qdot (qcomb 1 a (-1) b) (qcomb 1 a (-1) b) = 0).
    { replace (qdot _ _) with (qdot a a + qdot b b - 2 * qdot a b)
        by (unfold qdot, qcomb; simpl; ring). lra. }
    unfold qdot, qcomb in N; simpl in N.
    pose proof (Rle_0_sqr (1 * qx a + -1 * qx b)) as N1. pose proof (Rle_0_sqr (1 * qy a + -1 * qy b)) as N2.
    pose proof (Rle_0_sqr (1 * qz a + -1 * qz b)) as N3. pose proof (Rle_0_sqr (1 * qw a + -1 * qw b)) as N4.
    assert (forall r, r * r = 0 -> r = 0) as S by (intros r; apply Rsqr_0_uniq). unfold Rsqr in *.
    apply quat_eq; [assert (X := S (1 * qx a + -1 * qx b))|assert (X := S (1 * qy a + -1 * qy b))|
      assert (X := S (1 * qz a + -1 * qz b))|assert (X := S (1 * qw a + -1 * qw b))]; lra.
  - replace ((1 - 1) * angle a b) with 0 by ring. rewrite Rmult_1_l, sin_0.
    apply quat_eq; unfold qcomb; simpl; field; auto.
Qed.

Lemma rot_shorter a b v : 0 < qdot b b -> rot (unitq (shorter a b)) v = rot (unitq b) v.
Proof.
  intros P. unfold shorter. destruct Rlt_dec; auto.
  replace (unitq (qscale (-1) b)) with (qscale (-1) (unitq b)).
  - apply rot_scale; [lra|]. rewrite unitq_unit; auto; lra.
  - unfold unitq. replace (qdot (qscale (-1) b) (qscale (-1) b)) with (qdot b b)
      by (unfold qdot, qscale; simpl; ring).
    apply quat_eq; unfold qscale; simpl; ring.
Qed.

(* ---- a height along a normal, by the rows of the rotation *)
Definition row0 q := vscale (/ qdot q q) (mkV (qdot q q - 2 * (qy q * qy q + qz q * qz q))
  (2 * (qx q * qy q - qz q * qw q)) (2 * (qx q * qz q + qy q * qw q))).
Definition row1 q := vscale (/ qdot q q) (mkV (2 * (qx q * qy q + qz q * qw q))
  (qdot q q - 2 * (qx q * qx q + qz q * qz q)) (2 * (qy q * qz q - qx q * qw q))).
Definition row2 q := vscale (/ qdot q q) (mkV (2 * (qx q * qz q - qy q * qw q))
  (2 * (qy q * qz q + qx q * qw q)) (qdot q q - 2 * (qx q * qx q + qy q * qy q))).

Lemma rot_rows q v : rot q v = mkV (dot (row0 q) v) (dot (row1 q) v) (dot (row2 q) v).
Proof.
  unfold rot, row0, row1, row2. generalize (/ qdot q q). intros k.
  apply V_eq; unfold turned, qdot, dot, vscale; cbn [vx vy vz]; ring.
Qed.
