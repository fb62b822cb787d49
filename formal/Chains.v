(* Chains.v - robots: what a chain of joints carries, how far that leaves its chord, and that a plane at two instants separates
   two parts at all times between. It is the law of nsvcd_verify_robot.h, over the reals. Nothing here reads a plan's bytes. *)
From Coq Require Import Reals Lra Psatz List Lia.
From Coquelicot Require Import Coquelicot.
From Svcd Require Export Geometry.
Import ListNotations.
Local Open Scope R_scope.

(* ---- joints. A joint stands in the link that it is on: turned by a quaternion, which need not be of length 1, and moved by an
   offset. Its axis may be of any length but 0 (verify__part_place) *)
Record joint := mkJoint { slides : bool; frame : quat; offset : V; axis : V }.
Definition well_made j := 0 < qdot (frame j) (frame j) /\ 0 < norm (axis j).
Definition unit_axis j := vscale (/ norm (axis j)) (axis j).
Definition turn a q := mkQ (vx a * sin (q / 2)) (vy a * sin (q / 2)) (vz a * sin (q / 2)) (cos (q / 2)).
Definition carry j q y := vadd (rot (frame j)
  (if slides j then vadd y (vscale q (unit_axis j)) else rot (turn (unit_axis j) q) y)) (offset j).
(* T_1 (T_2 (... y)): joints with their values, the one at the base first *)
Definition carried (l : list (joint * R)) y := fold_right (fun g y => carry (fst g) (snd g) y) y l.

(* ---- the words say what they should: an arm of two joints in a plane, and a slide along its axis *)
Definition still := mkQ 0 0 0 1.
Definition origin0 := mkV 0 0 0.
Definition upright at_ := mkJoint false still at_ (mkV 0 0 1).
Example arm_of_two q r : carried [(upright origin0, q); (upright (mkV 1 0 0), r)] (mkV 1 0 0) =
  mkV (cos q + cos (q + r)) (sin q + sin (q + r)) 0.
Proof.
  assert (S : / norm (mkV 0 0 1) = 1).
  { unfold norm, dot. simpl. replace (0 * 0 + 0 * 0 + 1 * 1) with 1 by ring. rewrite sqrt_1. field. }
  assert (T : forall x p, rot (turn (unit_axis (upright x)) p) = rot (mkQ 0 0 (sin (p / 2)) (cos (p / 2)))).
  { intros. f_equal. unfold turn, unit_axis, upright, vscale. simpl. rewrite S. f_equal; ring. }
  assert (U : forall p v, rot (mkQ 0 0 (sin (p / 2)) (cos (p / 2))) v =
    mkV (cos p * vx v - sin p * vy v) (sin p * vx v + cos p * vy v) (vz v)).
  { intros p v. assert (P : p = 2 * (p / 2)) by field. pose proof (sin2_cos2 (p / 2)) as C. unfold Rsqr in C.
    assert (C' : sin (p / 2) * sin (p / 2) = 1 - cos (p / 2) * cos (p / 2)) by lra.
    rewrite P at 3 4 5 6. rewrite cos_2a, sin_2a. set (c := cos _) in *. set (s := sin _) in *.
    rewrite rot_unit by (unfold qdot; simpl; lra). apply V_eq; unfold turned; simpl; ring_simplify; try ring.
    replace (s ^ 2) with (1 - c * c) by (simpl; lra). ring. }
  assert (I : forall v, rot still v = v).
  { intros. rewrite rot_unit by (unfold qdot; simpl; ring). apply V_eq; unfold turned; simpl; ring. }
  unfold carried, carry. cbn [fold_right fst snd slides]. rewrite !T, !U. cbn [frame upright]. rewrite !I, cos_plus, sin_plus.
  apply V_eq; simpl; ring.
Qed.
Example slide_of_one q : carried [(mkJoint true still (mkV 0 0 1) (mkV 0 3 4), q)] (mkV 1 0 0) = mkV 1 (q * 3 / 5) (1 + q * 4 / 5).
Proof.
  assert (S : norm (mkV 0 3 4) = 5).
  { unfold norm, dot. simpl. replace (0 * 0 + 3 * 3 + 4 * 4) with (5 * 5) by ring. apply sqrt_square. lra. }
  unfold carried, carry, unit_axis. simpl. rewrite S, rot_unit by (unfold qdot; simpl; ring).
  apply V_eq; unfold turned, vadd, vscale; simpl; field.
Qed.

(* ---- curves of points and their derivatives, coordinate by coordinate *)
Definition derives (f : R -> V) u d := is_derive (fun v => vx (f v)) u (vx d) /\
  is_derive (fun v => vy (f v)) u (vy d) /\ is_derive (fun v => vz (f v)) u (vz d).
Lemma derives_ext f g u d : (forall v, f v = g v) -> derives f u d -> derives g u d.
Proof.
  intros E (A & B & C). split; [|split]; (eapply is_derive_ext; [|eassumption]); intros v; simpl; rewrite E; reflexivity.
Qed.
Lemma derives_const k u : derives (fun _ => k) u (mkV 0 0 0).
Proof. split; [|split]; apply (is_derive_const (K := R_AbsRing) (V := R_NormedModule)). Qed.
Lemma derives_vadd f g u d e : derives f u d -> derives g u e -> derives (fun v => vadd (f v) (g v)) u (vadd d e).
Proof.
  intros (A & B & C) (D & E & F).
  split; [exact (is_derive_plus _ _ _ _ _ A D)|split; [exact (is_derive_plus _ _ _ _ _ B E)|exact (is_derive_plus _ _ _ _ _ C F)]].
Qed.
Lemma derives_vscale k f u k1 d : is_derive k u k1 -> derives f u d ->
  derives (fun v => vscale (k v) (f v)) u (vadd (vscale k1 (f u)) (vscale (k u) d)).
Proof.
  intros K (A & B & C). split; [|split];
    [exact (is_derive_mult _ _ _ _ _ K A Rmult_comm)|exact (is_derive_mult _ _ _ _ _ K B Rmult_comm)|
     exact (is_derive_mult _ _ _ _ _ K C Rmult_comm)].
Qed.
Lemma derives_dot n f u d : derives f u d -> is_derive (fun v => dot n (f v)) u (dot n d).
Proof.
  intros (A & B & C). unfold dot.
  exact (is_derive_plus _ _ _ _ _ (is_derive_plus _ _ _ _ _ (is_derive_scal _ _ (vx n) _ A) (is_derive_scal _ _ (vy n) _ B))
           (is_derive_scal _ _ (vz n) _ C)).
Qed.
Lemma derives_cross a f u d : derives f u d -> derives (fun v => cross a (f v)) u (cross a d).
Proof.
  intros (A & B & C). split; [|split];
    [exact (is_derive_minus _ _ _ _ _ (is_derive_scal _ _ (vy a) _ C) (is_derive_scal _ _ (vz a) _ B))|
     exact (is_derive_minus _ _ _ _ _ (is_derive_scal _ _ (vz a) _ A) (is_derive_scal _ _ (vx a) _ C))|
     exact (is_derive_minus _ _ _ _ _ (is_derive_scal _ _ (vx a) _ B) (is_derive_scal _ _ (vy a) _ A))].
Qed.
Lemma derives_rot q f u d : derives f u d -> derives (fun v => rot q (f v)) u (rot q d).
Proof.
  intros D. rewrite rot_rows. eapply derives_ext; [intros v; symmetry; apply rot_rows|].
  split; [|split]; apply derives_dot, D.
Qed.

(* ---- a turn, as Rodrigues has it; its derivative is the turn of what y' and q' a x y are together *)
Definition about a q y := vadd (vscale (cos q) y) (vadd (vscale (sin q) (cross a y)) (vscale ((1 - cos q) * dot a y) a)).
Lemma turn_unit a q : dot a a = 1 -> qdot (turn a q) (turn a q) = 1.
Proof.
  intros A. pose proof (sin2_cos2 (q / 2)) as C. unfold Rsqr in C.
  replace (qdot _ _) with (sin (q / 2) * sin (q / 2) * dot a a + cos (q / 2) * cos (q / 2))
    by (unfold qdot, turn, dot; simpl; ring). rewrite A. lra.
Qed.
Lemma turn_about a q y : dot a a = 1 -> rot (turn a q) y = about a q y.
Proof.
  intros A. rewrite rot_unit by (apply turn_unit, A). pose proof (sin2_cos2 (q / 2)) as C. unfold Rsqr in C.
  unfold about. replace q with (2 * (q / 2)) at 2 3 4 by field. rewrite cos_2a, sin_2a.
  unfold turn. set (c := cos _) in *. set (s := sin _) in *.
  assert (D : 1 - (c * c - s * s) = 2 * (s * s)) by lra. rewrite D. unfold dot in A.
  destruct a as [x y' z]. simpl in A.
  assert (E : forall p q r : R, p - q = r * (x * x + y' * y' + z * z - 1) -> p = q) by (intros p p' r H; rewrite A in H; lra).
  apply V_eq; unfold turned, vadd, vscale, cross, dot; simpl;
    [apply (E _ _ (- (s * s) * vx y))|apply (E _ _ (- (s * s) * vy y))|apply (E _ _ (- (s * s) * vz y))]; ring.
Qed.
Lemma norm_rot q v : 0 < qdot q q -> norm (rot q v) = norm v.
Proof.
  intros Q. unfold rot. rewrite norm_vscale by (apply Rlt_le, Rinv_0_lt_compat, Q). rewrite turned_norm. field. lra.
Qed.
Lemma norm_about a q y : dot a a = 1 -> norm (about a q y) = norm y.
Proof. intros A. rewrite <- turn_about by auto. apply norm_rot. rewrite turn_unit by auto. lra. Qed.
Lemma derives_about a q y u q1 y1 : dot a a = 1 -> is_derive q u q1 -> derives y u y1 ->
  derives (fun v => about a (q v) (y v)) u (about a (q u) (vadd y1 (vscale q1 (cross a (y u))))).
Proof.
  intros A Q Y. assert (D1 : Derive (fun v => q v) u = q1) by (apply is_derive_unique, Q).
  assert (C : is_derive (fun v => cos (q v)) u (- q1 * sin (q u)))
    by (auto_derive; [exists q1; exact Q|rewrite D1; ring]).
  assert (C' : is_derive (fun v => 1 - cos (q v)) u (q1 * sin (q u)))
    by (auto_derive; [exists q1; exact Q|rewrite D1; ring]).
  assert (S : is_derive (fun v => sin (q v)) u (q1 * cos (q u)))
    by (auto_derive; [exists q1; exact Q|rewrite D1; ring]).
  pose proof (derives_vadd _ _ _ _ _ (derives_vscale _ _ _ _ _ C Y) (derives_vadd _ _ _ _ _
    (derives_vscale _ _ _ _ _ S (derives_cross a _ _ _ Y)) (derives_vscale _ _ _ _ _
      (is_derive_mult _ _ _ _ _ C' (derives_dot a _ _ _ Y) Rmult_comm) (derives_const a u)))) as D.
  match type of D with derives _ _ ?e => replace (about a (q u) _) with e; [exact D|] end.
  change plus with Rplus. change mult with Rmult. unfold dot in A. destruct a as [x y' z]. simpl in A.
  assert (E : forall p q r : R, p - q = r * (x * x + y' * y' + z * z - 1) -> p = q) by (intros p p' r H; rewrite A in H; lra).
  unfold about. set (c := cos _). set (s := sin _).
  apply V_eq; unfold vadd, vscale, cross, dot, plus, mult; simpl;
    [apply (E _ _ (q1 * s * vx (y u)))|apply (E _ _ (q1 * s * vy (y u)))|apply (E _ _ (q1 * s * vz (y u)))]; ring.
Qed.
