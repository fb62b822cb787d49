(* Ray_law.v - one triangle, and a point that leaves along a ray: the angle of Solid.v goes on continuously, also where the ray
   crosses the triangle. *)
From Coq Require Import Reals Lra Lia Psatz List ZArith.
From Coquelicot Require Import Coquelicot.
From Svcd Require Export Solid.
Import ListNotations.
Local Open Scope R_scope.

(* ---- half an angle, as `turns` has it, turned by a half turn of it *)
Lemma half_angle_turned k X Y r : k = 1 \/ k = -1 -> r * r = X * X + Y * Y -> 0 < r -> 0 < r - X ->
  let th := - k * (PI / 2) - atan (Y / (r - X)) in cos (2 * th) = X / r /\ sin (2 * th) = Y / r.
Proof.
  intros K E R P th. destruct (half_angle (- X) Y r) as [C S]; [lra|lra|lra|].
  replace (- X + r) with (r - X) in C, S by ring. set (a := atan (Y / (r - X))) in *.
  assert (B : cos (PI + 2 * a) = - cos (2 * a) /\ sin (PI + 2 * a) = - sin (2 * a)).
  { rewrite (Rplus_comm PI), neg_cos, neg_sin. auto. }
  destruct B as [B1 B2]. destruct K; subst k.
  - replace (2 * th) with (- (PI + 2 * a)) by (unfold th; fold a; field). rewrite cos_neg, sin_neg, B1, B2, C, S. split; field; lra.
  - replace (2 * th) with (PI - 2 * a) by (unfold th; fold a; field).
    rewrite cos_minus, sin_minus, cos_PI, sin_PI, C, S. split; field; lra.
Qed.
(* atan t + atan (1 / t) is a quarter turn: past the crossing the two angles are the same, before it they differ by k half turns *)
Lemma half_angle_past X Y r : r * r = X * X + Y * Y -> 0 < r -> 0 < Y ->
  0 < r - X /\ 0 < X + r /\ atan (Y / (r - X)) = PI / 2 - atan (Y / (X + r)).
Proof.
  intros E R P. assert (P2 : 0 < Y * Y) by (apply Rmult_lt_0_compat; auto). assert (N : (r - X) * (r + X) = Y * Y) by lra.
  assert (A : Rabs X < r). { rewrite <- (Rabs_pos_eq r) by lra. apply Rsqr_lt_abs_0. unfold Rsqr. lra. }
  apply Rabs_lt_between in A. split; [lra|split; [lra|]]. rewrite <- atan_inv by (apply Rdiv_lt_0_compat; lra). f_equal.
  transitivity (Y * Y / ((r - X) * Y)); [field; lra|rewrite <- N; field; lra].
Qed.
Lemma half_angle_same k X Y r : k = 1 \/ k = -1 -> r * r = X * X + Y * Y -> 0 < r -> k * Y < 0 ->
  - k * (PI / 2) - atan (Y / (r - X)) = atan (Y / (X + r)).
Proof.
  intros [-> | ->] E R K.
  - destruct (half_angle_past X (- Y) r) as (A & B & H); [lra|lra|lra|]. unfold Rdiv in *.
    rewrite !Ropp_mult_distr_l_reverse, !atan_opp in H. lra.
  - destruct (half_angle_past X Y r) as (A & B & H); lra.
Qed.
Lemma half_angle_before k X Y r : k = 1 \/ k = -1 -> r * r = X * X + Y * Y -> 0 < r -> 0 < k * Y ->
  - k * (PI / 2) - atan (Y / (r - X)) = atan (Y / (X + r)) - k * PI.
Proof.
  intros K E R P. pose proof (half_angle_same (- k) X Y r) as H.
  assert (- - k * (PI / 2) - atan (Y / (r - X)) = atan (Y / (X + r))) by (apply H; auto; lra). lra.
Qed.

(* ---- where the ray goes through a triangle *)
Lemma edge_passed d a b : det d a b <> 0 -> off_edge a b.
Proof.
  unfold off_edge. intros N. assert (W : 0 < dot (cross a b) (cross a b)).
  { destruct (dot_pos (cross a b)) as [W|W]; auto. exfalso. apply N. pose proof (cauchy d (cross a b)) as C. unfold norm in C at 2.
    rewrite <- W, sqrt_0, Rmult_0_r in C. fold (det d a b) in C. destruct (Req_dec (det d a b) 0); auto.
    pose proof (Rabs_pos_lt _ H). lra. }
  assert (L : dot a a * dot b b = dot a b * dot a b + dot (cross a b) (cross a b)) by (unfold dot, cross; cbn [vx vy vz]; ring).
  pose proof (norm_pos a). pose proof (norm_pos b).
  assert (S : Rabs (dot a b) < Rabs (norm a * norm b)).
  { apply Rsqr_lt_abs_0. unfold Rsqr. replace (_ * _ * (_ * _)) with (norm a * norm a * (norm b * norm b)) by ring.
    rewrite !norm_sq. lra. }
  rewrite (Rabs_pos_eq (norm a * norm b)) in S by (apply Rmult_le_pos; auto). apply Rabs_lt_between in S. lra.
Qed.
Lemma three_sides p q t : 0 < p -> 0 < q -> 0 < t -> t * t - p * p - q * q + 2 * p * q > 0 -> p - q < t /\ q - p < t.
Proof.
  intros P Q T H. assert (A : Rabs (p - q) < Rabs t) by (apply Rsqr_lt_abs_0; unfold Rsqr; lra).
  rewrite (Rabs_pos_eq t) in A by lra. apply Rabs_lt_between in A. lra.
Qed.
Lemma re_within a b c A B C : 0 < A -> 0 < B -> 0 < C -> vadd (vscale A a) (vadd (vscale B b) (vscale C c)) = mkV 0 0 0 ->
  off_edge a b -> off_edge b c -> off_edge c a -> dee a b c < 0.
Proof.
  intros PA PB PC S Oab Obc Oca. pose proof (off_edge_norm _ _ Oab) as Na.
  pose proof (off_edge_norm _ _ Obc) as Nb. pose proof (off_edge_norm _ _ Oca) as Nc.
  assert (X : A * vx a + B * vx b + C * vx c = 0) by (apply (f_equal vx) in S; simpl in S; lra).
  assert (Y : A * vy a + B * vy b + C * vy c = 0) by (apply (f_equal vy) in S; simpl in S; lra).
  assert (Z : A * vz a + B * vz b + C * vz c = 0) by (apply (f_equal vz) in S; simpl in S; lra). clear S.
  set (p := A * norm a). set (q := B * norm b). set (t := C * norm c).
  assert (Pp : 0 < p) by (apply Rmult_lt_0_compat; auto). assert (Pq : 0 < q) by (apply Rmult_lt_0_compat; auto).
  assert (Pt : 0 < t) by (apply Rmult_lt_0_compat; auto).
  assert (Ep : p * p = A * A * dot a a) by (rewrite <- norm_sq; unfold p; ring).
  assert (Eq : q * q = B * B * dot b b) by (rewrite <- norm_sq; unfold q; ring).
  assert (Et : t * t = C * C * dot c c) by (rewrite <- norm_sq; unfold t; ring).
  assert (D : forall v, A * dot v a + B * dot v b + C * dot v c = 0).
  { intros v. unfold dot. transitivity (vx v * (A * vx a + B * vx b + C * vx c) + vy v * (A * vy a + B * vy b + C * vy c) +
      vz v * (A * vz a + B * vz b + C * vz c)); [ring|rewrite X, Y, Z; ring]. }
  assert (K : forall v w, dot v w = dot w v) by (intros; unfold dot; ring).
  pose proof (D a) as Da. pose proof (D b) as Db. pose proof (D c) as Dc. rewrite (K b a) in Db. rewrite (K a c) in Da.
  rewrite (K c b) in Dc.
  assert (Fa : A * (A * dot a a + B * dot a b + C * dot c a) = 0) by (rewrite Da; ring).
  assert (Fb : B * (A * dot a b + B * dot b b + C * dot b c) = 0) by (rewrite Db; ring).
  assert (Fc : C * (A * dot c a + B * dot b c + C * dot c c) = 0) by (rewrite Dc; ring).
  assert (E1 : 2 * (A * B * dot a b) = t * t - p * p - q * q) by (rewrite Ep, Eq, Et; lra).
  assert (E2 : 2 * (B * C * dot b c) = p * p - q * q - t * t) by (rewrite Ep, Eq, Et; lra).
  assert (E3 : 2 * (C * A * dot c a) = q * q - t * t - p * p) by (rewrite Ep, Eq, Et; lra).
  assert (T1 : 0 < A * B * (norm a * norm b + dot a b)) by (repeat apply Rmult_lt_0_compat; auto).
  assert (T2 : 0 < B * C * (norm b * norm c + dot b c)) by (repeat apply Rmult_lt_0_compat; auto).
  assert (T3 : 0 < C * A * (norm c * norm a + dot c a)) by (repeat apply Rmult_lt_0_compat; auto).
  assert (Q1 : A * B * (norm a * norm b) = p * q) by (unfold p, q; ring).
  assert (Q2 : B * C * (norm b * norm c) = q * t) by (unfold t, q; ring).
  assert (Q3 : C * A * (norm c * norm a) = t * p) by (unfold p, t; ring).
  rewrite Rmult_plus_distr_l in T1, T2, T3.
  destruct (three_sides p q t); auto; [lra|]. destruct (three_sides q t p); auto; [lra|]. clear D K Da Db Dc Fa Fb Fc.
  assert (R : 2 * (A * B * C * dee a b c) = - ((p + q - t) * (q + t - p) * (t + p - q))).
  { transitivity (2 * p * q * t + 2 * (A * B * dot a b) * t + 2 * (B * C * dot b c) * p + 2 * (C * A * dot c a) * q).
    - unfold dee, p, q, t. ring.
    - rewrite E1, E2, E3. ring. }
  assert (0 < (p + q - t) * (q + t - p) * (t + p - q)) by (repeat apply Rmult_lt_0_compat; lra).
  assert (P3 : 0 < A * B * C) by (repeat apply Rmult_lt_0_compat; auto).
  destruct (Rlt_dec (dee a b c) 0) as [|N]; auto. exfalso.
  assert (0 <= A * B * C * dee a b c) by (apply Rmult_le_pos; lra). lra.
Qed.

(* ---- the complex number of a triangle, and the angle as it goes on: k is how often the ray crosses it *)
Definition re x T := dee (vsub (c0 T) x) (vsub (c1 T) x) (vsub (c2 T) x).
Definition im x T := det (vsub (c0 T) x) (vsub (c1 T) x) (vsub (c2 T) x).
Definition rad x T := arr (vsub (c0 T) x) (vsub (c1 T) x) (vsub (c2 T) x).
Definition turn k x T := if Z.eq_dec k 0 then wound_by x T * PI else - IZR k * (PI / 2) - atan (im x T / (rad x T - re x T)).
Lemma rad2 x T : rad x T * rad x T = re x T * re x T + im x T * im x T.
Proof. apply arr2. Qed.
Lemma rad_pos x T : 0 <= rad x T.
Proof. apply sqrt_pos. Qed.
Lemma rad_off x T : im x T <> 0 \/ re x T < 0 -> 0 < rad x T /\ 0 < rad x T - re x T.
Proof.
  intros H. pose proof (rad_pos x T) as P. pose proof (rad2 x T) as E. pose proof (Rle_0_sqr (im x T)) as I.
  pose proof (Rle_0_sqr (re x T)) as J.
  assert (N : 0 < rad x T).
  { destruct P as [|Z]; auto. exfalso. rewrite <- Z in E. unfold Rsqr in *.
    destruct H as [H|H]; apply Rsqr_pos_lt in H || apply Rlt_not_eq, Rsqr_pos_lt in H; unfold Rsqr in H; lra. }
  split; [exact N|]. destruct (Rlt_dec (re x T) 0); [lra|]. destruct H as [H|H]; [|contradiction]. apply Rsqr_pos_lt in H.
  assert (A : Rabs (re x T) < Rabs (rad x T)) by (apply Rsqr_lt_abs_0; unfold Rsqr in *; lra).
  rewrite !Rabs_pos_eq in A by lra. lra.
Qed.

Definition ray x d h := vadd x (vscale h d).
Section Crossed.
Variables (x d : V) (T : tri) (k : R).
Let u := vsub (c0 T) x. Let v := vsub (c1 T) x. Let w := vsub (c2 T) x.
Hypothesis K : k = 1 \/ k = -1.
Hypothesis S1 : 0 < k * det d u v.
Hypothesis S2 : 0 < k * det d v w.
Hypothesis S3 : 0 < k * det d w u.
Hypothesis Vol : 0 < k * det u v w.
Lemma ray_im h : k * im (ray x d h) T = k * det u v w - h * (k * det d u v + k * det d v w + k * det d w u).
Proof. unfold im, ray, u, v, w, det, dot, cross, vsub, vadd, vscale; cbn [vx vy vz]; ring. Qed.
Lemma ray_det h a b : det d (vsub a (ray x d h)) (vsub b (ray x d h)) = det d (vsub a x) (vsub b x).
Proof. unfold ray, det, dot, cross, vsub, vadd, vscale; cbn [vx vy vz]; ring. Qed.
Lemma ray_edges h : off_edges (ray x d h) T.
Proof.
  assert (N : forall r, 0 < k * r -> r <> 0) by (intros r P ->; lra).
  split; [|split]; apply (edge_passed d); rewrite ray_det; auto.
Qed.
Lemma ray_re h : im (ray x d h) T = 0 -> re (ray x d h) T < 0.
Proof.
  intros Z. pose proof (ray_im h) as I. rewrite Z, Rmult_0_r in I. destruct (ray_edges h) as (E1 & E2 & E3).
  apply (re_within _ _ _ (k * det d v w) (k * det d w u) (k * det d u v)); auto.
  assert (H : forall p q, p = q * (k * det u v w - h * (k * det d u v + k * det d v w + k * det d w u)) -> p = 0)
    by (intros p q ->; rewrite <- I; ring).
  apply V_eq; [apply (H _ (vx d))|apply (H _ (vy d))|apply (H _ (vz d))];
    unfold ray, u, v, w, det, dot, cross, vsub, vadd, vscale; cbn [vx vy vz]; ring.
Qed.
Lemma ray_off h : 0 < rad (ray x d h) T /\ 0 < rad (ray x d h) T - re (ray x d h) T.
Proof. apply rad_off. destruct (Req_dec (im (ray x d h) T) 0) as [Z|]; auto. right. apply ray_re, Z. Qed.
Lemma ray_far : exists H, forall h, H <= h -> k * im (ray x d h) T < 0.
Proof.
  set (s := k * det d u v + k * det d v w + k * det d w u). assert (P : 0 < s) by (unfold s; lra).
  exists (k * det u v w / s + 1). intros h L. rewrite ray_im. fold s.
  assert (k * det u v w < h * s); [|lra]. replace (k * det u v w) with (k * det u v w / s * s) by (field; lra).
  apply Rmult_lt_compat_r; lra.
Qed.
End Crossed.

(* ---- continuity along a way *)
Lemma steady_atan p q : steady p -> steady q -> (forall u, 0 < q u) -> steady (fun u => atan (p u / q u)).
Proof.
  intros P Q N u. apply (continuity_pt_comp (fun u => p u / q u) atan); [|apply derivable_continuous_pt, derivable_pt_atan].
  apply (continuity_pt_div p q); [apply P|apply Q|]. apply Rgt_not_eq, N.
Qed.
Section Way.
Variables (way : R -> V) (T : tri).
Hypothesis Way : steadyV way.
Lemma steady_from p : steadyV (fun u => vsub p (way u)).
Proof. apply steady_vsub; auto. apply steady_fixed. Qed.
Lemma steady_re : steady (fun u => re (way u) T).
Proof. apply steady_dee; apply steady_from. Qed.
Lemma steady_im : steady (fun u => im (way u) T).
Proof. apply steady_det; apply steady_from. Qed.
Lemma steady_rad : steady (fun u => rad (way u) T).
Proof. apply steady_arr; apply steady_from. Qed.
Lemma steady_turn k : (forall u, if Z.eq_dec k 0 then 0 < re (way u) T + rad (way u) T else 0 < rad (way u) T - re (way u) T) ->
  steady (fun u => turn k (way u) T).
Proof.
  pose proof steady_re. pose proof steady_im. pose proof steady_rad. unfold turn. destruct Z.eq_dec; intros P.
  - apply (steady_mult (fun u => atan (im (way u) T / (re (way u) T + rad (way u) T)) / PI)); steady. apply steady_atan; steady.
  - apply (steady_minus (fun _ => - IZR k * (PI / 2))); steady. apply steady_atan; steady.
Qed.
End Way.

(* ---- a ray that misses a triangle never touches it *)
Section Missed.
Variables (x d : V) (T : tri) (h : R).
Let u := vsub (c0 T) x. Let v := vsub (c1 T) x. Let w := vsub (c2 T) x.
Hypothesis Hp : 0 <= h.
(* shares of a point on the ray are to each other as the three determinants *)
Lemma shares a b c : a + b + c = 1 -> ray x d h = mix a b c T ->
  b * det d u v = c * det d w u /\ a * det d u v = c * det d v w /\ a * det d w u = b * det d v w /\
  c * det u v w = h * det d u v /\ a * det u v w = h * det d v w /\ b * det u v w = h * det d w u.
Proof.
  intros S E. assert (F : vscale h d = vadd (vscale a u) (vadd (vscale b v) (vscale c w))).
  { transitivity (vsub (ray x d h) (vscale (a + b + c) x)).
    - rewrite S. apply V_eq; unfold ray, vsub, vadd, vscale; cbn [vx vy vz]; ring.
    - rewrite E. apply V_eq; unfold mix, u, v, w, vsub, vadd, vscale; cbn [vx vy vz]; ring. }
  clearbody u v w. pose proof (fun p q => f_equal (det p q) F) as G.
  assert (Lin : forall p q, det p q (vadd (vscale a u) (vadd (vscale b v) (vscale c w))) =
    a * det p q u + b * det p q v + c * det p q w)
    by (intros; unfold det, dot, cross, vadd, vscale; cbn [vx vy vz]; ring).
  assert (Ld : forall p q, det p q (vscale h d) = h * det p q d) by (intros; unfold det, dot, cross, vscale; cbn [vx vy vz]; ring).
  assert (Cyc : forall p q r, det p q r = det q r p) by (intros; unfold det, dot, cross; cbn [vx vy vz]; ring).
  assert (Sw : forall p q r, det p q r = - det p r q) by (intros; unfold det, dot, cross; cbn [vx vy vz]; ring).
  assert (Z0 : forall p q, det p q q = 0) by (intros; unfold det, dot, cross; cbn [vx vy vz]; ring).
  assert (Z1 : forall p q, det p q p = 0) by (intros; unfold det, dot, cross; cbn [vx vy vz]; ring).
  pose proof (G d u) as G1. pose proof (G d v) as G2. pose proof (G d w) as G3.
  pose proof (G u v) as G4. pose proof (G v w) as G5. pose proof (G w u) as G6. clear G.
  rewrite Lin, Ld, ?Z0, ?Z1 in G1, G2, G3, G4, G5, G6.
  rewrite (Sw d u w) in G1. rewrite (Sw d v u) in G2. rewrite (Sw d w v) in G3.
  rewrite <- (Cyc d u v) in G4. rewrite <- (Cyc d v w), <- (Cyc u v w) in G5. rewrite <- (Cyc d w u), (Cyc w u v) in G6.
  repeat split; lra.
Qed.
Lemma missed_beside : det d u v * det d v w < 0 \/ det d v w * det d w u < 0 \/ det d w u * det d u v < 0 -> ~ of_tri (ray x d h) T.
Proof.
  intros O (a & b & c & A & B & C & S & E). destruct (shares a b c S E) as (E1 & E2 & E3 & _). clear E.
  assert (P : forall p q r s, 0 <= p -> 0 <= q -> p * r = q * s -> r * s < 0 -> p = 0 /\ q = 0).
  { intros p q r s P Q F N. destruct P as [P|<-], Q as [Q|<-]; auto; exfalso.
    - pose proof (Rmult_lt_0_compat _ _ P Q). assert (p * r * (q * s) = p * q * (r * s)) by ring.
      rewrite F in H0. pose proof (Rle_0_sqr (q * s)). unfold Rsqr in *.
      assert (0 < p * q * - (r * s)) by (apply Rmult_lt_0_compat; lra). lra.
    - rewrite Rmult_0_l in F. apply Rmult_integral in F. destruct F as [->| ->]; lra.
    - rewrite Rmult_0_l in F. symmetry in F. apply Rmult_integral in F. destruct F as [->| ->]; lra. }
  assert (N : forall p q, p * q < 0 -> p <> 0 /\ q <> 0) by (intros p q L; split; intros ->; lra).
  destruct O as [O|[O|O]]; destruct (N _ _ O) as [N1 N2].
  - destruct (P a c _ _ A C E2 O) as [-> ->]. rewrite Rmult_0_l in E1. apply Rmult_integral in E1. destruct E1; lra.
  - destruct (P b a (det d v w) (det d w u)) as [-> ->]; auto. rewrite Rmult_0_l in E2. symmetry in E2.
    apply Rmult_integral in E2. destruct E2; lra.
  - destruct (P c b (det d w u) (det d u v)) as [-> ->]; auto. rewrite Rmult_0_l in E2. apply Rmult_integral in E2.
    destruct E2; lra.
Qed.
Lemma missed_behind : (let vol := det u v w in det d u v * vol < 0 /\ det d v w * vol < 0 /\ det d w u * vol < 0) ->
  ~ of_tri (ray x d h) T.
Proof.
  intros (O1 & O2 & O3) (a & b & c & A & B & C & S & E). destruct (shares a b c S E) as (_ & _ & _ & E1 & E2 & E3). clear E.
  set (vol := det u v w) in *. assert (N : vol <> 0) by (intros N; rewrite N in O1; lra). apply Rsqr_pos_lt in N. unfold Rsqr in N.
  assert (P : forall p r, p * vol = h * r -> r * vol < 0 -> p <= 0).
  { intros p r F L. destruct (Rle_dec p 0) as [|Q]; auto. exfalso. assert (0 < p * (vol * vol)) by (apply Rmult_lt_0_compat; lra).
    assert (0 <= h * - (r * vol)) by (apply Rmult_le_pos; lra).
    assert (p * (vol * vol) = h * (r * vol)) by (rewrite <- Rmult_assoc, F; ring). lra. }
  pose proof (P _ _ E1 O1). pose proof (P _ _ E2 O2). pose proof (P _ _ E3 O3). lra.
Qed.
End Missed.

(* ---- one triangle, all along the ray *)
Definition onward u := / 2 * (u + Rabs u).   (* 0, from 0 on u *)
Lemma onward_pos u : 0 <= onward u.
Proof. unfold onward, Rabs. destruct Rcase_abs; lra. Qed.
Lemma onward_is u : 0 <= u -> onward u = u.
Proof. unfold onward, Rabs. destruct Rcase_abs; lra. Qed.
Lemma ray_0 x d : ray x d 0 = x.
Proof. apply V_eq; unfold ray, vadd, vscale; cbn [vx vy vz]; ring. Qed.
Lemma steady_ray x d : steadyV (fun u => ray x d (onward u)).
Proof. apply steady_vadd; [apply steady_fixed|]. apply steady_vscale; [unfold onward; steady|apply steady_fixed]. Qed.
Record follows d x T k := {
  goes_off h : 0 <= h -> off_edges (ray x d h) T /\ angle_of (ray x d h) T (turn k (ray x d h) T);
  goes_on : steady (fun u => turn k (ray x d (onward u)) T);
  goes_from : turn k x T = wound_by x T * PI - IZR k * PI;
  goes_to : exists H, forall h, H <= h -> turn k (ray x d h) T = wound_by (ray x d h) T * PI }.
Lemma follows_missed d x T : (forall h, 0 <= h -> ~ of_tri (ray x d h) T) -> follows d x T 0.
Proof.
  intros N. assert (E : forall y, turn 0 y T = wound_by y T * PI) by reflexivity. split.
  - intros h H. rewrite E. split; [apply off_tri_edges|apply turns]; apply N, H.
  - apply steady_turn; [apply steady_ray|]. intros u. apply (heart (ray x d (onward u)) T), N, onward_pos.
  - rewrite E. ring.
  - exists 0. intros h _. apply E.
Qed.
Lemma follows_crossed d x T k : (k = 1 \/ k = -1)%Z ->
  (let u := vsub (c0 T) x in let v := vsub (c1 T) x in let w := vsub (c2 T) x in
  0 < IZR k * det d u v /\ 0 < IZR k * det d v w /\ 0 < IZR k * det d w u /\ 0 < IZR k * det u v w) -> follows d x T k.
Proof.
  intros K (A & B & C & W). assert (KR : IZR k = 1 \/ IZR k = -1) by (destruct K as [-> | ->]; auto).
  assert (E : forall y, turn k y T = - IZR k * (PI / 2) - atan (im y T / (rad y T - re y T)))
    by (intros y; unfold turn; destruct Z.eq_dec; [destruct K; lia|reflexivity]).
  pose proof (ray_off x d T (IZR k) A B C) as Off. split.
  - intros h H. split; [apply (ray_edges x d T (IZR k)); auto|]. rewrite E. destruct (Off h).
    apply half_angle_turned; auto. apply rad2.
  - apply steady_turn; [apply steady_ray|]. intros u. destruct Z.eq_dec; [destruct K; lia|]. apply Off.
  - rewrite E. pose proof (Off 0) as O. rewrite ray_0 in O. replace (wound_by x T * PI) with (atan (im x T / (re x T + rad x T)))
      by (rewrite wound_is; unfold im, re, rad; cbv zeta; field; apply PI_neq0).
    apply half_angle_before; [exact KR|apply rad2|apply O|exact W].
  - destruct (ray_far x d T (IZR k) A B C) as (H & F). exists H. intros h L. rewrite E.
    replace (wound_by (ray x d h) T * PI) with (atan (im (ray x d h) T / (re (ray x d h) T + rad (ray x d h) T)))
      by (rewrite wound_is; unfold im, re, rad; cbv zeta; field; apply PI_neq0).
    apply half_angle_same; [exact KR|apply rad2|apply Off|apply F, L].
Qed.

(* ---- all triangles *)
Lemma whole_steady f s e : s <= e -> steady f -> (forall u, exists k : Z, f u = IZR k * PI) -> f s = f e.
Proof.
  intros L F W. pose proof PI_neq0 as P. apply Rmult_eq_reg_r with (/ PI); [|apply Rinv_neq_0_compat, P].
  apply (whole_stays (fun u => f u * / PI) s e L).
  - intros u _. apply (steady_mult f (fun _ => / PI) F). steady.
  - intros u _. destruct (W u) as (k & ->). exists k. field. exact P.
Qed.
Lemma from_some_on {A} (l : list A) (P : A -> R -> Prop) : (forall a, In a l -> exists H, forall h, H <= h -> P a h) ->
  exists H, forall h, H <= h -> forall a, In a l -> P a h.
Proof.
  induction l as [|b l IH]; intros E; [exists 0; intros h _ a []|]. destruct (E b (or_introl eq_refl)) as (H & B).
  destruct IH as (H' & B'); [intros a I; apply E; right; exact I|]. exists (Rmax H H'). intros h L.
  pose proof (Rmax_l H H'). pose proof (Rmax_r H H'). intros a [<-|I]; [apply B|apply B'; auto]; lra.
Qed.
Theorem followed f l x d (count : ztri -> Z) : balanced l -> (forall T, In T l -> follows d x (image f T) (count T)) ->
  exists H, forall h, H <= h -> winding x (map (image f) l) =
    winding (ray x d h) (map (image f) l) + IZR (fold_right (fun T n => count T + n)%Z 0%Z l).
Proof.
  intros B F. set (sum := fun y => fold_right (fun T s => turn (count T) y (image f T) + s) 0 l).
  assert (S : forall h, 0 <= h -> sum (ray x d (onward 0)) = sum (ray x d (onward h))).
  { intros h L. apply (whole_steady (fun u => sum (ray x d (onward u))) 0 h L).
    - unfold sum. clear B. induction l as [|T l' IH]; simpl; [steady|].
      apply steady_plus; [|apply IH; intros; apply F; right; auto].
      apply (F T). left; reflexivity.
    - intros u. apply (angles_whole f l (ray x d (onward u))); auto; intros T I;
        apply (goes_off _ _ _ _ (F T I)), onward_pos. }
  assert (S0 : sum x = (winding x (map (image f) l) - IZR (fold_right (fun T n => count T + n)%Z 0%Z l)) * PI).
  { unfold sum, winding. clear B S sum. induction l as [|T l' IH]; [simpl; ring|]. cbn [map fold_right].
    rewrite IH by (intros; apply F; right; auto). rewrite (goes_from _ _ _ _ (F T (or_introl eq_refl))), plus_IZR. ring. }
  destruct (from_some_on l (fun T h => turn (count T) (ray x d h) (image f T) = wound_by (ray x d h) (image f T) * PI)) as (H & E).
  { intros T I. apply (F T I). }
  exists (Rmax 0 H). intros h L. pose proof (Rmax_l 0 H). pose proof (Rmax_r 0 H).
  assert (Sh : sum (ray x d h) = winding (ray x d h) (map (image f) l) * PI).
  { specialize (E h ltac:(lra)). unfold sum, winding. clear - E. induction l as [|T l' IH]; [simpl; ring|]. cbn [map fold_right].
    rewrite IH by (intros; apply E; right; auto). rewrite (E T (or_introl eq_refl)). ring. }
  specialize (S h ltac:(lra)). rewrite !onward_is, ray_0, S0, Sh in S by lra. apply Rmult_eq_reg_r in S; [lra|apply PI_neq0].
Qed.
