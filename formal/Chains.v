(* Chains.v - the law by which nsvcd_verify_robot.h bounds what a robot's links do: how far a point that joints carry leaves
   its chord while their values follow Bezier curves. `link_leaves_chord` is the law, `links_stay_apart` what a plane at two
   instants proves by it. No rounding here. *)
From Coq Require Import Reals Lra Lia Psatz List.
From Coquelicot Require Import Coquelicot.
From Svcd Require Export Geometry.
Import ListNotations.
Local Open Scope R_scope.

(* ---- Bezier curves: of n + 1 points, by de Casteljau's recursion *)
Fixpoint bezier n (p : nat -> R) u := match n with
  | O => p O
  | S m => (1 - u) * bezier m p u + u * bezier m (fun i => p (S i)) u end.
Definition steps (p : nat -> R) i := p (S i) - p i.

Lemma bezier_ext n : forall p q u, (forall i, (i <= n)%nat -> p i = q i) -> bezier n p u = bezier n q u.
Proof.
  induction n; intros p q u H; cbn [bezier]; [apply H; lia|].
  rewrite (IHn p q), (IHn (fun i => p (S i)) (fun i => q (S i))) by (intros; apply H; lia). reflexivity.
Qed.
Lemma bezier_linear n : forall a p b q u,
  bezier n (fun i => a * p i + b * q i) u = a * bezier n p u + b * bezier n q u.
Proof.
  induction n; intros; cbn [bezier]; [reflexivity|].
  rewrite (IHn a p b q), (IHn a (fun i => p (S i)) b (fun i => q (S i))). ring.
Qed.
Lemma bezier_steps n p u : bezier n (steps p) u = bezier n (fun i => p (S i)) u - bezier n p u.
Proof.
  rewrite (bezier_ext n _ (fun i => 1 * p (S i) + -1 * p i)) by (intros; unfold steps; ring).
  rewrite (bezier_linear n 1 (fun i => p (S i)) (-1) p). ring.
Qed.

(* the derivative is n times the curve of the steps *)
Lemma bezier_derive n : forall p u, is_derive (bezier n p) u (INR n * bezier (pred n) (steps p) u).
Proof.
  induction n; intros p u; cbn [bezier pred].
  - rewrite Rmult_0_l. apply @is_derive_const.
  - pose proof (IHn p u) as A. pose proof (IHn (fun i => p (S i)) u) as B.
    evar_last.
    + apply (is_derive_plus (fun u => (1 - u) * bezier n p u) (fun u => u * bezier n (fun i => p (S i)) u)).
      * apply (is_derive_mult (fun u => 1 - u) (bezier n p)); [|exact A|intros; apply Rmult_comm].
        auto_derive; [exact I|]. instantiate (1 := -1). ring.
      * apply (is_derive_mult (fun u => u) (bezier n (fun i => p (S i)))); [|exact B|intros; apply Rmult_comm].
        apply (is_derive_id (K := R_AbsRing)).
    + unfold plus, mult, one; simpl. destruct n as [|n].
      * simpl. unfold steps. ring.
      * cbn [Init.Nat.pred bezier].
        change (fun i => steps p (S i)) with (steps (fun i => p (S i))).
        rewrite !bezier_steps. ring.
Qed.

(* it stays within the bounds of its points *)
Lemma bezier_within n : forall p M u, 0 <= u <= 1 -> (forall i, (i <= n)%nat -> Rabs (p i) <= M) -> Rabs (bezier n p u) <= M.
Proof.
  induction n; intros p M u U H; cbn [bezier]; [apply H; lia|].
  eapply Rle_trans; [apply Rabs_triang|]. rewrite !Rabs_mult, (Rabs_pos_eq u), (Rabs_pos_eq (1 - u)) by lra.
  pose proof (IHn p M u U ltac:(intros; apply H; lia)). pose proof (IHn (fun i => p (S i)) M u U ltac:(intros; apply H; lia)). nra.
Qed.

(* what verify__curve's two loops leave: the points of the curve up to a share, and of that from a share on *)
Definition cut_to c (p : nat -> R) i := bezier i p c.
Definition cut_from n c (p : nat -> R) i := bezier (n - i) (fun k => p (i + k)%nat) c.
Lemma bezier_cut_to c u n : forall p, bezier n (cut_to c p) u = bezier n p (c * u).
Proof.
  induction n; intros p; [reflexivity|]. cbn [bezier]. rewrite IHn.
  rewrite (bezier_ext n (fun i => cut_to c p (S i)) (fun i => (1 - c) * cut_to c p i + c * cut_to c (fun k => p (S k)) i))
    by (intros; reflexivity).
  rewrite bezier_linear, !IHn. ring.
Qed.
Lemma bezier_cut_from c u n : forall p, bezier n (cut_from n c p) u = bezier n p (c + (1 - c) * u).
Proof.
  induction n; intros p; [reflexivity|]. cbn [bezier].
  rewrite (bezier_ext n (cut_from (S n) c p) (fun i => (1 - c) * cut_from n c p i + c * cut_from n c (fun k => p (S k)) i)).
  2:{ intros i L. unfold cut_from. replace (S n - i)%nat with (S (n - i)) by lia. cbn [bezier]. f_equal.
      f_equal. apply bezier_ext. intros. f_equal. lia. }
  rewrite (bezier_ext n (fun i => cut_from (S n) c p (S i)) (cut_from n c (fun k => p (S k)))) by (intros; reflexivity).
  rewrite bezier_linear, !IHn. ring.
Qed.
Definition part n from to p := cut_from n (from / to) (cut_to to p).
Lemma bezier_part n from to p u : to <> 0 -> bezier n (part n from to p) u = bezier n p (from + (to - from) * u).
Proof. intros T. unfold part. rewrite bezier_cut_from, bezier_cut_to. f_equal. field. exact T. Qed.

(* ---- points that move: at most L from the origin, at a speed of W, bending by B, for shares u from 0 to 1 *)
Definition deriveV (y : R -> V) u d := is_derive (fun v => vx (y v)) u (vx d) /\ is_derive (fun v => vy (y v)) u (vy d) /\
  is_derive (fun v => vz (y v)) u (vz d).
Definition within (y : R -> V) L W B := exists y1 y2 : R -> V,
  (forall u, deriveV y u (y1 u)) /\ (forall u, deriveV y1 u (y2 u)) /\
  forall u, 0 <= u <= 1 -> norm (y u) <= L /\ norm (y1 u) <= W /\ norm (y2 u) <= B.

Lemma deriveV_eq y z u d e : deriveV y u d -> (forall v, y v = z v) -> d = e -> deriveV z u e.
Proof. intros (A & B & C) Y <-. split; [|split]; (eapply is_derive_ext; [intros; rewrite <- Y; reflexivity|assumption]). Qed.
Lemma deriveV_plus y z u d e : deriveV y u d -> deriveV z u e -> deriveV (fun v => vadd (y v) (z v)) u (vadd d e).
Proof. intros (A & B & C) (A' & B' & C'). split; [|split]; simpl; apply @is_derive_plus; assumption. Qed.
Lemma deriveV_const c u : deriveV (fun _ => c) u (mkV 0 0 0).
Proof. split; [|split]; simpl; apply @is_derive_const. Qed.
Lemma deriveV_rows a b c y u d : deriveV y u d ->
  deriveV (fun v => mkV (dot a (y v)) (dot b (y v)) (dot c (y v))) u (mkV (dot a d) (dot b d) (dot c d)).
Proof.
  intros (A & B & C). unfold dot. split; [|split]; simpl; repeat apply @is_derive_plus; apply is_derive_scal; assumption.
Qed.
Lemma deriveV_rot q y u d : deriveV y u d -> deriveV (fun v => rot q (y v)) u (rot q d).
Proof. intros D. eapply deriveV_eq; [apply (deriveV_rows (row0 q) (row1 q) (row2 q)), D|intros; symmetry; apply rot_rows|symmetry; apply rot_rows]. Qed.
Lemma deriveV_scale f g y u d : is_derive f u g -> deriveV y u d ->
  deriveV (fun v => vscale (f v) (y v)) u (vadd (vscale g (y u)) (vscale (f u) d)).
Proof.
  intros F (A & B & C).
  split; [|split]; simpl; apply (is_derive_mult f); auto; intros; apply Rmult_comm.
Qed.
Lemma deriveV_cross a y u d : deriveV y u d -> deriveV (fun v => cross a (y v)) u (cross a d).
Proof.
  intros D. eapply deriveV_eq;
    [apply (deriveV_rows (mkV 0 (- vz a) (vy a)) (mkV (vz a) 0 (- vx a)) (mkV (- vy a) (vx a) 0)), D|intros|];
    apply V_eq; unfold cross, dot; simpl; ring.
Qed.

(* the chord: a curve that bends by B leaves it, along n, by an eighth of that *)
Lemma within_chord y L W B n u : within y L W B -> 0 <= u <= 1 ->
  (1 - u) * dot n (y 0) + u * dot n (y 1) - norm n * B / 8 <= dot n (y u).
Proof.
  intros (y1 & y2 & D1 & D2 & H) U. set (K := norm n * B). set (f := fun v => dot n (y v)).
  assert (N : forall v, 0 <= v <= 1 -> Rabs (dot n (y2 v)) <= K).
  { intros v Iv. destruct (H v Iv) as (_ & _ & E). eapply Rle_trans; [apply cauchy|]. apply Rmult_le_compat_l; [apply norm_pos|exact E]. }
  assert (K0 : 0 <= K) by (pose proof (N 0 ltac:(lra)); pose proof (Rabs_pos (dot n (y2 0))); lra).
  assert (F1 : forall v, is_derive f v (dot n (y1 v))) by (intros v; apply (deriveV_rows n n n y v _ (D1 v))).
  assert (F2 : forall v, is_derive (fun v => dot n (y1 v)) v (dot n (y2 v))) by (intros v; apply (deriveV_rows n n n y1 v _ (D2 v))).
  set (g := fun v => K / 2 * v * (1 - v) - ((1 - v) * f 0 + v * f 1)).
  assert (G : forall v, is_derive g v (K / 2 * (1 - 2 * v) - (f 1 - f 0))).
  { intros v. unfold g. generalize (f 0) (f 1). intros f0 f1. auto_derive; [exact I|field]. }
  assert (P : 0 <= (fun v => f v + g v) u).
  { apply (concave_above (fun v => f v + g v) (fun v => dot n (y1 v) + (K / 2 * (1 - 2 * v) - (f 1 - f 0))) (fun v => dot n (y2 v) + - K) 0 1); auto.
    - intros v. apply is_derive_Reals. exact (is_derive_plus f g v _ _ (F1 v) (G v)).
    - intros v. apply is_derive_Reals. apply (is_derive_plus (fun v => dot n (y1 v)) (fun v => K / 2 * (1 - 2 * v) - (f 1 - f 0)) v _ _ (F2 v)).
      generalize (f 0) (f 1). intros f0 f1. auto_derive; [exact I|field].
    - intros v Iv. pose proof (N v Iv) as A. apply Rabs_le_between in A. lra.
    - unfold g. ring.
    - unfold g. ring. }
  unfold g in P. fold (f 0) (f 1) (f u). assert (u * (1 - u) <= 1 / 4) by (pose proof (pow2_ge_0 (2 * u - 1)); lra).
  assert (K / 2 * (u * (1 - u)) <= K / 2 * (1 / 4)) by (apply Rmult_le_compat_l; lra). lra.
Qed.

(* ---- joints *)
Definition is_unit v := dot v v = 1.
Lemma unit_z a : is_unit a -> vz a * vz a = 1 - vx a * vx a - vy a * vy a.
Proof. unfold is_unit, dot. lra. Qed.
(* v turned by an angle about a is_unit axis (Rodrigues): as the quaternion axis sin q/2, cos q/2 does it *)
Definition turn a q v := vadd (vscale (cos q) v) (vadd (vscale (sin q) (cross a v)) (vscale ((1 - cos q) * dot a v) a)).
Lemma turn_rot a q v : is_unit a ->
  rot (mkQ (sin (q / 2) * vx a) (sin (q / 2) * vy a) (sin (q / 2) * vz a) (cos (q / 2))) v = turn a q v.
Proof.
  intros U. set (s := sin (q / 2)). set (c := cos (q / 2)).
  assert (One : c * c = 1 - s * s) by (pose proof (sin2_cos2 (q / 2)) as E; unfold Rsqr in E; fold s c in E; lra).
  assert (S : sin q = 2 * s * c) by (replace q with (2 * (q / 2)) by field; apply sin_2a).
  assert (C : cos q = 1 - 2 * s * s) by (replace q with (2 * (q / 2)) at 1 by field; rewrite cos_2a_sin; reflexivity).
  assert (Q : qdot (mkQ (s * vx a) (s * vy a) (s * vz a) c) (mkQ (s * vx a) (s * vy a) (s * vz a) c) = 1).
  { unfold qdot; simpl. ring [One (unit_z a U)]. }
  rewrite rot_unit by exact Q. unfold turn. rewrite S, C.
  apply V_eq; unfold turned, vadd, vscale, cross, dot; simpl; ring [One (unit_z a U)].
Qed.
Lemma turn_norm a q v : is_unit a -> norm (turn a q v) = norm v.
Proof.
  intros U. unfold norm. f_equal. pose proof (sin2_cos2 q) as E. unfold Rsqr in E.
  assert (One : cos q * cos q = 1 - sin q * sin q) by lra.
  unfold turn, dot, vadd, vscale, cross. simpl. ring [One (unit_z a U)].
Qed.
Lemma turn_add a q v w : turn a q (vadd v w) = vadd (turn a q v) (turn a q w).
Proof. unfold turn, dot. apply V_eq; unfold vadd, vscale, cross; simpl; ring. Qed.
Lemma turn_derive a q q1 y d u : is_unit a -> is_derive q u q1 -> deriveV y u d ->
  deriveV (fun v => turn a (q v) (y v)) u (turn a (q u) (vadd d (vscale q1 (cross a (y u))))).
Proof.
  intros U Q D.
  assert (Cos : is_derive (fun v => cos (q v)) u (- sin (q u) * q1)).
  { evar_last; [apply (is_derive_comp cos q); [apply is_derive_cos|exact Q]|]. unfold scal; simpl. unfold mult; simpl. ring. }
  assert (Sin : is_derive (fun v => sin (q v)) u (cos (q u) * q1)).
  { evar_last; [apply (is_derive_comp sin q); [apply is_derive_sin|exact Q]|]. unfold scal; simpl. unfold mult; simpl. ring. }
  assert (Along : is_derive (fun v => (1 - cos (q v)) * dot a (y v)) u (sin (q u) * q1 * dot a (y u) + (1 - cos (q u)) * dot a d)).
  { evar_last; [apply (is_derive_mult (fun v => 1 - cos (q v)) (fun v => dot a (y v)))|].
    - apply (is_derive_minus (fun _ => 1)); [apply @is_derive_const|exact Cos].
    - pose proof (deriveV_rows a a a y u d D) as (A & _). exact A.
    - intros; apply Rmult_comm.
    - unfold plus, mult, minus, opp, zero, plus; simpl. unfold plus; simpl. ring. }
  eapply deriveV_eq; [|reflexivity|].
  - apply deriveV_plus; [apply (deriveV_scale _ _ _ _ _ Cos D)|apply deriveV_plus].
    + apply (deriveV_scale _ _ _ _ _ Sin (deriveV_cross a y u d D)).
    + apply (deriveV_scale _ _ _ _ _ Along (deriveV_const a u)).
  - apply V_eq; unfold turn, dot, vadd, vscale, cross; simpl; ring [(unit_z a U)].
Qed.

Record joint := mkJoint { slides : bool; axis : V; frame : quat; offset : V }.
Definition sound_joint j := is_unit (axis j) /\ qdot (frame j) (frame j) = 1.
(* where a joint with the value q takes a point of its link, in the frame of the link that it is on *)
Definition moved j q y := vadd (rot (frame j) (if slides j then vadd y (vscale q (axis j)) else turn (axis j) q y)) (offset j).

(* ---- what is known of a value, or of a point: it is at most `most`, its first derivative `fast`, its second `bend` *)
Record bounds := mkBounds { most : R; fast : R; bend : R }.
Definition inside y b := within y (most b) (fast b) (bend b).
Definition takes q m := exists q1 q2, (forall u, is_derive q u (q1 u)) /\ (forall u, is_derive q1 u (q2 u)) /\
  forall u, 0 <= u <= 1 -> Rabs (q u) <= most m /\ Rabs (q1 u) <= fast m /\ Rabs (q2 u) <= bend m.

(* the loop of verify__part_deviation: from the bounds of a point, those of it carried by one joint more. There `most` is
   reach + r, `fast` outer[0] + outer[1] r, and an eighth of `bend` deviation[0] + deviation[1] r *)
Definition carried_by j m b := let arm := if slides j then 1 else most b in
  mkBounds (most b + norm (offset j) + if slides j then most m else 0) (fast b + fast m * arm)
    (bend b + bend m * arm + if slides j then 0 else fast m * (2 * fast b + fast m * arm)).

Lemma norm_times k v : norm (vscale k v) = Rabs k * norm v.
Proof.
  unfold norm. replace (dot (vscale k v) (vscale k v)) with (Rsqr k * dot v v) by (unfold Rsqr, dot, vscale; simpl; ring).
  rewrite sqrt_mult, sqrt_Rsqr_abs by (apply Rle_0_sqr || apply dot_pos). reflexivity.
Qed.
Lemma norm_rot q v : qdot q q = 1 -> norm (rot q v) = norm v.
Proof. intros Q. rewrite rot_unit, turned_norm, Q by exact Q. ring. Qed.
Lemma norm_unit a : is_unit a -> norm a = 1.
Proof. unfold is_unit, norm. intros ->. apply sqrt_1. Qed.
Lemma norm_cross_unit a v : is_unit a -> norm (cross a v) <= norm v.
Proof. intros U. pose proof (cross_norm a v) as C. rewrite (norm_unit a U) in C. lra. Qed.

Lemma joint_carries j q m y b : sound_joint j -> takes q m -> inside y b ->
  inside (fun u => moved j (q u) (y u)) (carried_by j m b).
Proof.
  intros (U & F) (q1 & q2 & Q1 & Q2 & QB) (y1 & y2 & Y1 & Y2 & YB). unfold inside, within, carried_by, moved. cbn [most fast bend].
  set (a := axis j) in *. destruct (slides j) eqn:S.
  - exists (fun u => rot (frame j) (vadd (y1 u) (vscale (q1 u) a))), (fun u => rot (frame j) (vadd (y2 u) (vscale (q2 u) a))).
    assert (D : forall f g, (forall u, is_derive f u (g u)) -> forall u, deriveV (fun v => vscale (f v) a) u (vscale (g u) a)).
    { intros f g D u. eapply deriveV_eq; [apply (deriveV_scale f (g u) (fun _ => a) u (mkV 0 0 0)); [apply D|apply deriveV_const]|reflexivity|].
      apply V_eq; unfold vadd, vscale; simpl; ring. }
    split; [|split].
    + intros u. eapply deriveV_eq; [apply deriveV_plus; [apply deriveV_rot, deriveV_plus; [apply Y1|apply (D q q1 Q1)]|apply deriveV_const]|reflexivity|].
      apply V_eq; unfold vadd; simpl; ring.
    + intros u. apply deriveV_rot, deriveV_plus; [apply Y2|apply (D q1 q2 Q2)].
    + intros u I. specialize (QB u I). specialize (YB u I).
      assert (N : forall v k, norm (vadd v (vscale k a)) <= norm v + Rabs k).
      { intros v k. eapply Rle_trans; [apply norm_vadd|]. rewrite norm_times, (norm_unit a U). lra. }
      rewrite !norm_rot by exact F. pose proof (N (y u) (q u)). pose proof (N (y1 u) (q1 u)). pose proof (N (y2 u) (q2 u)).
      pose proof (norm_vadd (rot (frame j) (vadd (y u) (vscale (q u) a))) (offset j)) as O. rewrite norm_rot in O by exact F. lra.
  - set (z := fun u => vadd (y1 u) (vscale (q1 u) (cross a (y u)))).
    set (z1 := fun u => vadd (y2 u) (vadd (vscale (q2 u) (cross a (y u))) (vscale (q1 u) (cross a (y1 u))))).
    assert (Z1 : forall u, deriveV z u (z1 u)).
    { intros u. apply deriveV_plus; [apply Y2|]. apply deriveV_scale; [apply Q2|apply deriveV_cross, Y1]. }
    exists (fun u => rot (frame j) (turn a (q u) (z u))),
      (fun u => rot (frame j) (turn a (q u) (vadd (z1 u) (vscale (q1 u) (cross a (z u)))))).
    split; [|split].
    + intros u. eapply deriveV_eq; [apply deriveV_plus; [apply deriveV_rot, turn_derive; [exact U|apply Q1|apply Y1]|apply deriveV_const]|reflexivity|].
      fold (z u). apply V_eq; unfold vadd; simpl; ring.
    + intros u. apply deriveV_rot, turn_derive; [exact U|apply Q1|apply Z1].
    + intros u I. specialize (QB u I). specialize (YB u I). destruct QB as (_ & V1 & V2), YB as (L & W & B).
      assert (N : forall k v K M, Rabs k <= K -> norm v <= M -> norm (vscale k (cross a v)) <= K * M).
      { intros k v K M HK HM. rewrite norm_times. pose proof (norm_cross_unit a v U).
        apply Rmult_le_compat; [apply Rabs_pos|apply norm_pos|exact HK|lra]. }
      assert (Z : norm (z u) <= fast b + fast m * most b).
      { eapply Rle_trans; [apply norm_vadd|]. pose proof (N _ _ _ _ V1 L). lra. }
      rewrite !norm_rot, !turn_norm by (exact F || exact U). split; [|split].
      * pose proof (norm_vadd (rot (frame j) (turn a (q u) (y u))) (offset j)) as O.
        rewrite norm_rot, turn_norm in O by (exact F || exact U). lra.
      * exact Z.
      * eapply Rle_trans; [apply norm_vadd|]. pose proof (N _ _ _ _ V1 Z).
        pose proof (norm_vadd (y2 u) (vadd (vscale (q2 u) (cross a (y u))) (vscale (q1 u) (cross a (y1 u))))).
        pose proof (norm_vadd (vscale (q2 u) (cross a (y u))) (vscale (q1 u) (cross a (y1 u)))).
        pose proof (N _ _ _ _ V2 L). pose proof (N _ _ _ _ V1 W). unfold z1. lra.
Qed.

(* ---- a chain, from the link towards the base: joints, each with the n + 1 points of its value *)
Definition chain := list (joint * (nat -> R)).
Fixpoint carried n (js : chain) (x : V) u := match js with
  | [] => x
  | (j, p) :: js => carried n js (moved j (bezier n p u) x) u end.
Fixpoint largest n (p : nat -> R) := match n with O => Rabs (p O) | S m => Rmax (Rabs (p O)) (largest m (fun i => p (S i))) end.
Definition bounds_of n p := mkBounds (largest n p) (INR n * largest (pred n) (steps p))
  (INR n * INR (pred n) * largest (pred (pred n)) (steps (steps p))).
Fixpoint law n (js : chain) b := match js with
  | [] => b
  | (j, p) :: js => law n js (carried_by j (bounds_of n p) b) end.
Definition sound_chain (js : chain) := List.Forall (fun jp => sound_joint (fst jp)) js.

Lemma largest_ok n : forall p i, (i <= n)%nat -> Rabs (p i) <= largest n p.
Proof.
  induction n; intros p i L; cbn [largest]; [assert (i = O) as -> by lia; apply Rle_refl|].
  destruct i; [apply Rmax_l|]. eapply Rle_trans; [apply (IHn (fun i => p (S i)) i); lia|apply Rmax_r].
Qed.
Lemma bezier_takes n p : takes (bezier n p) (bounds_of n p).
Proof.
  exists (fun u => INR n * bezier (pred n) (steps p) u), (fun u => INR n * (INR (pred n) * bezier (pred (pred n)) (steps (steps p)) u)).
  split; [apply bezier_derive|split].
  - intros u. apply (is_derive_scal (bezier (pred n) (steps p)) u (INR n)), bezier_derive.
  - intros u I. cbn [most fast bend bounds_of]. rewrite !Rabs_mult, !(Rabs_pos_eq (INR _)) by apply pos_INR.
    assert (B : forall m q, Rabs (bezier m q u) <= largest m q) by (intros; apply bezier_within; [exact I|apply largest_ok]).
    split; [apply B|split; [apply Rmult_le_compat_l; [apply pos_INR|apply B]|]].
    rewrite Rmult_assoc. repeat (apply Rmult_le_compat_l; [apply pos_INR|]). apply B.
Qed.
Lemma chain_carries n js : forall y b, sound_chain js -> inside y b -> inside (fun u => carried n js (y u) u) (law n js b).
Proof.
  induction js as [|[j p] js IH]; intros y b S Y; cbn [carried law]; [exact Y|]. inversion S as [|? ? Sj Sjs]; subst.
  apply (IH (fun u => moved j (bezier n p u) (y u))); [exact Sjs|]. apply joint_carries; [exact Sj|apply bezier_takes|exact Y].
Qed.

(* THE LAW. A point of a link, no farther than L from the link's origin, leaves its chord from u = 0 to 1 along a direction n by
   no more than an eighth of the chain's bend *)
Theorem link_leaves_chord n js x L d u : sound_chain js -> norm x <= L -> 0 <= u <= 1 ->
  (1 - u) * dot d (carried n js x 0) + u * dot d (carried n js x 1) - norm d * (bend (law n js (mkBounds L 0 0)) / 8)
  <= dot d (carried n js x u).
Proof.
  intros S X U. assert (I : inside (fun _ => x) (mkBounds L 0 0)).
  { exists (fun _ => mkV 0 0 0), (fun _ => mkV 0 0 0). split; [|split]; [intros; apply deriveV_const|intros; apply deriveV_const|].
    intros _ _. cbn [most fast bend]. replace (norm (mkV 0 0 0)) with 0; [lra|].
    unfold norm, dot; simpl. rewrite !Rmult_0_l, !Rplus_0_l. symmetry. apply sqrt_0. }
  pose proof (within_chord _ _ _ _ d u (chain_carries n js _ _ S I) U). lra.
Qed.

(* the same from one share of a piece to another: the joints' points are those of the part between *)
Definition stretch n from to (js : chain) : chain := map (fun jp => (fst jp, part n from to (snd jp))) js.
Lemma carried_stretch n from to js : forall x u, to <> 0 ->
  carried n (stretch n from to js) x u = carried n js x (from + (to - from) * u).
Proof.
  induction js as [|[j p] js IH]; intros x u T; cbn [stretch map carried fst snd]; [reflexivity|].
  rewrite bezier_part by exact T. apply IH, T.
Qed.
Lemma sound_stretch n from to js : sound_chain js -> sound_chain (stretch n from to js).
Proof. unfold sound_chain, stretch. rewrite Forall_map. exact (fun S => S). Qed.
Definition link_deviation n from to js L := bend (law n (stretch n from to js) (mkBounds L 0 0)) / 8.
Theorem piece_leaves_chord n js x L d from to t : sound_chain js -> norm x <= L -> 0 <= from < to -> from <= t <= to ->
  ((to - t) * dot d (carried n js x from) + (t - from) * dot d (carried n js x to)) / (to - from)
    - norm d * link_deviation n from to js L <= dot d (carried n js x t).
Proof.
  intros S X F T. set (u := (t - from) / (to - from)).
  assert (U : 0 <= u <= 1) by (unfold u; split; apply Rmult_le_reg_r with (to - from); unfold Rdiv; rewrite ?Rmult_assoc, ?Rinv_l; lra).
  pose proof (link_leaves_chord n (stretch n from to js) x L d u (sound_stretch n from to js S) X U) as H.
  rewrite !carried_stretch in H by lra.
  replace (from + (to - from) * u) with t in H by (unfold u; field; lra).
  replace (from + (to - from) * 0) with from in H by ring. replace (from + (to - from) * 1) with to in H by ring.
  fold (link_deviation n from to js L) in H.
  replace ((to - t) * dot d (carried n js x from) + _) with
    ((to - from) * ((1 - u) * dot d (carried n js x from) + u * dot d (carried n js x to))) by (unfold u; field; lra).
  unfold Rdiv. rewrite Rmult_comm, <- Rmult_assoc, Rinv_l, Rmult_1_l by lra. exact H.
Qed.

(* a plane that separates points of two links at two shares of a piece, by more than the clearance c and what both deviate,
   separates them at all shares between. Both links follow the same joints' motion *)
Theorem links_stay_apart n ja jb x y La Lb d c from to : sound_chain ja -> sound_chain jb -> norm x <= La -> norm y <= Lb ->
  0 <= from < to ->
  let least := norm d * (c + link_deviation n from to ja La + link_deviation n from to jb Lb) in
  least < dot d (vsub (carried n ja x from) (carried n jb y from)) ->
  least < dot d (vsub (carried n ja x to) (carried n jb y to)) ->
  forall t, from <= t <= to -> c < norm (vsub (carried n ja x t) (carried n jb y t)).
Proof.
  intros Sa Sb X Y F least H0 H1 t T.
  assert (Sub : forall a b, dot d (vsub a b) = dot d a - dot d b) by (intros; unfold dot, vsub; simpl; ring).
  assert (Neg : forall v, dot (vscale (-1) d) v = - dot d v) by (intros; unfold dot, vscale; simpl; ring).
  pose proof (piece_leaves_chord n ja x La d from to t Sa X F T) as A.
  pose proof (piece_leaves_chord n jb y Lb (vscale (-1) d) from to t Sb Y F T) as B.
  rewrite !Neg, norm_times in B. replace (Rabs (-1)) with 1 in B by (rewrite Rabs_left; lra). rewrite Rmult_1_l in B. rewrite !Sub in *.
  set (a0 := dot d (carried n ja x from)) in *. set (a1 := dot d (carried n ja x to)) in *.
  set (b0 := dot d (carried n jb y from)) in *. set (b1 := dot d (carried n jb y to)) in *.
  set (u := (t - from) / (to - from)).
  assert (U : 0 <= u <= 1) by (unfold u; split; apply Rmult_le_reg_r with (to - from); unfold Rdiv; rewrite ?Rmult_assoc, ?Rinv_l; lra).
  replace (((to - t) * a0 + (t - from) * a1) / (to - from)) with ((1 - u) * a0 + u * a1) in A by (unfold u; field; lra).
  replace (((to - t) * - b0 + (t - from) * - b1) / (to - from)) with ((1 - u) * - b0 + u * - b1) in B by (unfold u; field; lra).
  assert (M : norm d * c < dot d (carried n ja x t) - dot d (carried n jb y t)).
  { assert (least < (1 - u) * (a0 - b0) + u * (a1 - b1)) by (destruct (Req_dec u 0) as [->|]; nra). unfold least in *. lra. }
  pose proof (cauchy d (vsub (carried n ja x t) (carried n jb y t))) as K. rewrite Sub in K.
  pose proof (Rle_abs (dot d (carried n ja x t) - dot d (carried n jb y t))). pose proof (norm_pos d). nra.
Qed.

(* verify__keeps: an axis of a link is turned as by a chain without offsets and slides, and leaves its chord by that chain's law,
   where L is 1: deviation[1] of the C *)
Definition directions (js : chain) : chain := map (fun jp => let j := fst jp in
  (mkJoint false (axis j) (frame j) (mkV 0 0 0), if slides j then fun _ => 0 else snd jp)) js.
Lemma bezier_0 n u : bezier n (fun _ => 0) u = 0.
Proof. induction n; cbn [bezier]; [reflexivity|]. rewrite IHn. ring. Qed.
Lemma carried_directions n js u : forall x y, vsub (carried n js x u) (carried n js y u) = carried n (directions js) (vsub x y) u.
Proof.
  induction js as [|[j p] js IH]; intros x y; cbn [directions map carried fst snd]; [reflexivity|]. rewrite IH. f_equal.
  unfold moved. cbn [slides axis frame offset]. rewrite !rot_rows. destruct (slides j).
  - rewrite bezier_0. apply V_eq; unfold turn, dot, vadd, vsub, vscale, cross; simpl; rewrite cos_0, sin_0; ring.
  - apply V_eq; unfold turn, dot, vadd, vsub, vscale, cross; simpl; ring.
Qed.

(* ---- do the words say what they should? The tip of an arm in a plane, its one joint turning; and a slide *)
Example tip p u : carried 1 [(mkJoint false (mkV 0 0 1) (mkQ 0 0 0 1) (mkV 0 0 0), p)] (mkV 1 0 0) u =
  mkV (cos (bezier 1 p u)) (sin (bezier 1 p u)) 0.
Proof. apply V_eq; unfold carried, moved, rot, turned, turn, qdot, dot, cross, vadd, vscale; cbn -[bezier cos sin]; field. Qed.
Example slide p u : carried 1 [(mkJoint true (mkV 0 0 1) (mkQ 0 0 0 1) (mkV 0 0 0), p)] (mkV 1 0 0) u = mkV 1 0 (bezier 1 p u).
Proof. apply V_eq; unfold carried, moved, rot, turned, qdot, vadd, vscale; cbn -[bezier]; field. Qed.
