(* Ray_law.v - one triangle, and a point that leaves along a ray: the angle of Solid.v goes on continuously, also where the ray
   crosses the triangle. *)
From Coq Require Import Reals Lra Lia Psatz List ZArith.
From Coquelicot Require Import Coquelicot.
From Svcd Require Export Inside.
Import ListNotations.
Local Open Scope R_scope.

(* ---- half the angle of X + Y i, as an arctangent, and turned by a half turn of it *)
Lemma half_angle X Y r : r * r = X * X + Y * Y -> 0 < r -> 0 < X + r ->
  cos (2 * atan (Y / (X + r))) = X / r /\ sin (2 * atan (Y / (X + r))) = Y / r.
Proof.
  intros E R P. set (t := Y / (X + r)). assert (T : t * (X + r) = Y) by (unfold t; field; lra).
  assert (T0 : 0 <= t²) by apply Rle_0_sqr. assert (Q : 0 < sqrt (1 + t²)) by (apply sqrt_lt_R0; lra).
  assert (Q2 : sqrt (1 + t²) * sqrt (1 + t²) = 1 + t * t) by (rewrite sqrt_sqrt by lra; reflexivity).
  rewrite cos_2a_cos, sin_2a, cos_atan, sin_atan.
  assert (W : (1 + t * t) * (X + r) = 2 * r).
  { apply Rmult_eq_reg_r with (X + r); [|lra].
    replace ((1 + t * t) * (X + r) * (X + r)) with ((X + r) * (X + r) + (t * (X + r)) * (t * (X + r))) by ring. rewrite T.
    ring [E]. }
  assert (N : 1 + t * t <> 0) by (intros N; rewrite N in W; lra).
  assert (I : 1 / (1 + t * t) = (X + r) / (2 * r)).
  { apply Rmult_eq_reg_l with (1 + t * t); [|exact N]. transitivity 1; [field; exact N|].
    transitivity ((1 + t * t) * (X + r) / (2 * r)); [rewrite W; field; lra|field; lra]. }
  split.
  - replace (2 * _ * _ - 1) with (2 * (1 / (sqrt (1 + t²) * sqrt (1 + t²))) - 1) by (field; lra).
    rewrite Q2, I. field. lra.
  - replace (2 * _ * _) with (2 * t * (1 / (sqrt (1 + t²) * sqrt (1 + t²)))) by (field; lra).
    rewrite Q2, I. transitivity (t * (X + r) / r); [field; lra|rewrite T; reflexivity].
Qed.
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
  - destruct (half_angle_past X (- Y) r) as (A & B & H); [lra|lra|lra|]. unfold Rdiv in *. rewrite !Ropp_mult_distr_l_reverse, !atan_opp in H. lra.
  - destruct (half_angle_past X Y r) as (A & B & H); lra.
Qed.
Lemma half_angle_before k X Y r : k = 1 \/ k = -1 -> r * r = X * X + Y * Y -> 0 < r -> 0 < k * Y ->
  - k * (PI / 2) - atan (Y / (r - X)) = atan (Y / (X + r)) - k * PI.
Proof.
  intros K E R P. pose proof (half_angle_same (- k) X Y r) as H.
  assert (- - k * (PI / 2) - atan (Y / (r - X)) = atan (Y / (X + r))) by (apply H; auto; lra). lra.
Qed.
