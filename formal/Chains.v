(* Chains.v - robots: what a chain of joints carries, how far that leaves its chord, and that a plane at two instants separates
   two parts at all times between. It is the law of nsvcd_verify_robot.h, over the reals. Nothing here reads a plan's bytes. *)
From Coq Require Import Reals Lra List.
From Coquelicot Require Import Coquelicot.
From Svcd Require Export Geometry Bezier.
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
Lemma by_unit a p q r : dot a a = 1 -> p - q = r * (dot a a - 1) -> p = q.
Proof. intros A. rewrite A. lra. Qed.
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
  assert (D : 1 - (c * c - s * s) = 2 * (s * s)) by lra. rewrite D.
  apply V_eq; unfold turned, vadd, vscale, cross, dot; simpl;
    [apply (by_unit a _ _ (- (s * s) * vx y))|apply (by_unit a _ _ (- (s * s) * vy y))|apply (by_unit a _ _ (- (s * s) * vz y))];
    auto; unfold dot; ring.
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
  change plus with Rplus. change mult with Rmult.
  unfold about. set (c := cos _). set (s := sin _).
  apply V_eq; unfold vadd, vscale, cross, dot, plus, mult; simpl;
    [apply (by_unit a _ _ (q1 * s * vx (y u)))|apply (by_unit a _ _ (q1 * s * vy (y u)))|apply (by_unit a _ _ (q1 * s * vz (y u)))];
    auto; unfold dot; ring.
Qed.

Lemma norm_0 : norm (mkV 0 0 0) = 0.
Proof. unfold norm, dot. simpl. replace (0 * 0 + 0 * 0 + 0 * 0) with 0 by ring. apply sqrt_0. Qed.

(* ---- a curve on a stretch, by its share u from 0 to 1: never farther than L from 0, its speed W at most, its bend B *)
Definition tame (y : R -> V) L W B := exists y1 y2, forall u, 0 <= u <= 1 ->
  derives y u (y1 u) /\ derives y1 u (y2 u) /\ norm (y u) <= L /\ norm (y1 u) <= W /\ norm (y2 u) <= B.
Definition tame_value (q : R -> R) M V A := exists q1 q2, forall u, 0 <= u <= 1 ->
  is_derive q u (q1 u) /\ is_derive q1 u (q2 u) /\ Rabs (q u) <= M /\ Rabs (q1 u) <= V /\ Rabs (q2 u) <= A.
Lemma tame_const y L : norm y <= L -> tame (fun _ => y) L 0 0.
Proof.
  intros H. exists (fun _ => mkV 0 0 0), (fun _ => mkV 0 0 0). intros u _. rewrite norm_0.
  split; [|split; [|split; [|split]]]; try lra; exact (derives_const _ u).
Qed.
Lemma norm_scaled k v K N : Rabs k <= K -> norm v <= N -> norm (vscale k v) <= K * N.
Proof.
  intros A B. replace (norm (vscale k v)) with (Rabs k * norm v).
  - apply Rmult_le_compat; auto; [apply Rabs_pos|apply norm_pos].
  - unfold norm. rewrite <- sqrt_Rsqr_abs, <- sqrt_mult by (apply Rle_0_sqr || apply dot_pos).
    f_equal. unfold Rsqr, dot, vscale; simpl; ring.
Qed.
Lemma norm_sum v w A B : norm v <= A -> norm w <= B -> norm (vadd v w) <= A + B.
Proof. intros. pose proof (norm_vadd v w). lra. Qed.
Lemma norm_across a v N : dot a a = 1 -> norm v <= N -> norm (cross a v) <= N.
Proof. intros A H. pose proof (cross_norm a v) as C. unfold norm at 2 in C. rewrite A, sqrt_1 in C. lra. Qed.

(* a joint that turns adds V L to the speed and A L + V (2 W + V L) to the bend *)
Lemma tame_turn a q y M V A L W B : dot a a = 1 -> tame_value q M V A -> tame y L W B ->
  tame (fun u => rot (turn a (q u)) (y u)) L (W + V * L) (B + A * L + V * (2 * W + V * L)).
Proof.
  intros N (q1 & q2 & Q) (y1 & y2 & Y).
  set (w := fun u => vadd (y1 u) (vscale (q1 u) (cross a (y u)))).
  set (w1 := fun u => vadd (y2 u) (vadd (vscale (q2 u) (cross a (y u))) (vscale (q1 u) (cross a (y1 u))))).
  exists (fun u => about a (q u) (w u)), (fun u => about a (q u) (vadd (w1 u) (vscale (q1 u) (cross a (w u))))).
  intros u I. destruct (Q u I) as (Q1 & Q2 & _ & HV & HA). destruct (Y u I) as (Y1 & Y2 & HL & HW & HB).
  assert (Hw : norm (w u) <= W + V * L) by (apply norm_sum; [|apply norm_scaled; [|apply norm_across]]; auto).
  split; [|split; [|split; [|split]]].
  - eapply derives_ext; [intros v; symmetry; apply turn_about, N|apply derives_about; auto].
  - apply derives_about; auto. apply derives_vadd; [exact Y2|apply derives_vscale; [exact Q2|apply derives_cross, Y1]].
  - rewrite turn_about, norm_about; auto.
  - rewrite norm_about; auto.
  - rewrite norm_about by auto. replace (B + A * L + V * (2 * W + V * L)) with ((B + (A * L + V * W)) + V * (W + V * L)) by ring.
    apply norm_sum; [apply norm_sum; [exact HB|apply norm_sum]|];
      (apply norm_scaled; [assumption|apply norm_across; assumption]).
Qed.
(* one that slides adds V to the speed and A to the bend, and as far as it slides to the distance *)
Lemma tame_slide a q y M V A L W B : dot a a = 1 -> tame_value q M V A -> tame y L W B ->
  tame (fun u => vadd (y u) (vscale (q u) a)) (L + M) (W + V) (B + A).
Proof.
  intros N (q1 & q2 & Q) (y1 & y2 & Y).
  assert (N1 : forall k K, Rabs k <= K -> norm (vscale k a) <= K).
  { intros k K H. rewrite <- (Rmult_1_r K). apply norm_scaled; auto. unfold norm. rewrite N, sqrt_1. lra. }
  assert (D : forall (k : R -> R) u k1, is_derive k u k1 -> derives (fun v => vscale (k v) a) u (vscale k1 a)).
  { intros k u k1 K. pose proof (derives_vscale k (fun _ => a) u k1 _ K (derives_const a u)) as D.
    replace (vscale k1 a) with (vadd (vscale k1 a) (vscale (k u) (mkV 0 0 0))); [exact D|].
    apply V_eq; unfold vadd, vscale; simpl; ring. }
  exists (fun u => vadd (y1 u) (vscale (q1 u) a)), (fun u => vadd (y2 u) (vscale (q2 u) a)).
  intros u I. destruct (Q u I) as (Q1 & Q2 & HM & HV & HA). destruct (Y u I) as (Y1 & Y2 & HL & HW & HB).
  split; [|split; [|split; [|split]]]; try (apply derives_vadd; auto); apply norm_sum; auto.
Qed.
Lemma tame_frame q o y L W B : 0 < qdot q q -> tame y L W B -> tame (fun u => vadd (rot q (y u)) o) (L + norm o) W B.
Proof.
  intros Q (y1 & y2 & Y). exists (fun u => rot q (y1 u)), (fun u => rot q (y2 u)).
  intros u I. destruct (Y u I) as (Y1 & Y2 & HL & HW & HB). rewrite !(norm_rot q _ Q).
  split; [|split; [|split; [|split]]]; auto.
  - pose proof (derives_vadd _ _ _ _ _ (derives_rot q _ _ _ Y1) (derives_const o u)) as D.
    replace (rot q (y1 u)) with (vadd (rot q (y1 u)) (mkV 0 0 0)); [exact D|].
    apply V_eq; unfold vadd; simpl; ring.
  - apply derives_rot, Y2.
  - apply norm_sum; [rewrite (norm_rot q _ Q)|]; auto. apply Rle_refl.
Qed.
Lemma tame_ext y z L W B : (forall u, y u = z u) -> tame y L W B -> tame z L W B.
Proof.
  intros E (y1 & y2 & Y). exists y1, y2. intros u I. destruct (Y u I) as (Y1 & Y'). split; [|rewrite <- E; exact Y'].
  eapply derives_ext; [exact E|exact Y1].
Qed.

(* ---- a chain on a stretch: each joint's value, with what that, its speed and its bend are at most *)
Record link := mkLink { the : joint; value : R -> R; most : R; speed : R; bend : R }.
Definition ok g := well_made (the g) /\ tame_value (value g) (most g) (speed g) (bend g).
Definition chain (l : list link) u := carried (map (fun g => (the g, value g u)) l).

(* The law, DEVIATION in the head of nsvcd_verify_robot.h; `out` is the part of the chain that is outside of a joint, and what is
   carried is never farther than L from the last link's origin. `rate`: the sum of V_k L_k; `acceleration`: the sum that bounds |y''| *)
Fixpoint reaches l L := match l with
  | [] => L | g :: out => reaches out L + norm (offset (the g)) + (if slides (the g) then most g else 0) end.
Definition arm g out L := if slides (the g) then 1 else reaches out L.
Fixpoint rate l L := match l with [] => 0 | g :: out => rate out L + speed g * arm g out L end.
Fixpoint acceleration l L := match l with
  | [] => 0
  | g :: out => acceleration out L + bend g * arm g out L +
      (if slides (the g) then 0 else speed g * (2 * rate out L + speed g * arm g out L)) end.

Lemma unit_axis_unit j : well_made j -> dot (unit_axis j) (unit_axis j) = 1.
Proof.
  intros [_ A]. unfold unit_axis. replace (dot _ _) with (/ norm (axis j) * / norm (axis j) * dot (axis j) (axis j))
    by (unfold dot, vscale; simpl; ring).
  replace (dot (axis j) (axis j)) with (norm (axis j) * norm (axis j)) by (apply sqrt_sqrt, dot_pos). field. lra.
Qed.
Lemma tame_chain l y L : List.Forall ok l -> norm y <= L -> tame (fun u => chain l u y) (reaches l L) (rate l L) (acceleration l L).
Proof.
  intros F H. induction F as [|g out [O T] F IH]; simpl.
  - exact (tame_const y L H).
  - pose proof (unit_axis_unit _ O) as U. destruct O as [O _]. unfold arm, chain, carried, carry. simpl.
    destruct (slides (the g)).
    + pose proof (tame_frame _ (offset (the g)) _ _ _ _ O (tame_slide _ _ _ _ _ _ _ _ _ U T IH)) as X.
      rewrite !Rmult_1_r, Rplus_0_r. rewrite Rplus_assoc, (Rplus_comm (norm _)), <- Rplus_assoc. exact X.
    + pose proof (tame_frame _ (offset (the g)) _ _ _ _ O (tame_turn _ _ _ _ _ _ _ _ _ U T IH)) as X.
      rewrite Rplus_0_r. exact X.
Qed.

(* ---- a curve whose bend is B at most leaves its chord by an eighth of that *)
Lemma tame_above y L W B n u : tame y L W B -> 0 <= u <= 1 ->
  (1 - u) * dot n (y 0) + u * dot n (y 1) - norm n * (B / 8) <= dot n (y u).
Proof.
  intros (y1 & y2 & Y) I. set (f := fun v => dot n (y v)). set (f1 := fun v => dot n (y1 v)). set (K := norm n * B).
  assert (P : 0 <= K / 2 * u * (1 - u) + (f u - ((1 - u) * f 0 + u * f 1))).
  { apply (concave_above (fun v => K / 2 * v * (1 - v) + (f v - ((1 - v) * f 0 + v * f 1)))
      (fun v => K / 2 * (1 - 2 * v) + (f1 v - (f 1 - f 0))) (fun v => dot n (y2 v) - K) 0 1); auto; try (field; fail).
    - intros v J. destruct (Y v J) as (Y1 & _). pose proof (derives_dot n _ _ _ Y1) as D. fold f in D.
      assert (D1 : Derive (fun v => f v) v = f1 v) by (apply is_derive_unique, D).
      apply is_derive_Reals. generalize (f 0) (f 1). intros. auto_derive; [exists (f1 v); exact D|rewrite D1; field].
    - intros v J. destruct (Y v J) as (_ & Y2 & _). pose proof (derives_dot n _ _ _ Y2) as D. fold f1 in D.
      assert (D1 : Derive (fun v => f1 v) v = dot n (y2 v)) by (apply is_derive_unique, D).
      apply is_derive_Reals. generalize (f 0) (f 1). intros. auto_derive; [eexists; exact D|rewrite D1; field].
    - intros v J. destruct (Y v J) as (_ & _ & _ & _ & Y2). pose proof (cauchy n (y2 v)) as C.
      pose proof (Rle_abs (dot n (y2 v))). pose proof (norm_pos n). unfold K. nra. }
  assert (0 <= K).
  { destruct (Y u I) as (_ & _ & _ & _ & Y2). pose proof (norm_pos (y2 u)). apply Rmult_le_pos; [apply norm_pos|lra]. }
  unfold f in P. replace (norm n * (B / 8)) with (K / 8) by (unfold K; field). pose proof (pow2_ge_0 (2 * u - 1)). nra.
Qed.
Lemma tame_chord y L W B n u : tame y L W B -> 0 <= u <= 1 ->
  Rabs (dot n (y u) - ((1 - u) * dot n (y 0) + u * dot n (y 1))) <= norm n * (B / 8).
Proof.
  intros T I. pose proof (tame_above y L W B n u T I) as A. pose proof (tame_above y L W B (vscale (-1) n) u T I) as M.
  assert (D : forall v, dot (vscale (-1) n) v = - dot n v) by (intros; unfold dot, vscale; simpl; ring).
  assert (N : norm (vscale (-1) n) = norm n) by (unfold norm; f_equal; unfold dot, vscale; simpl; ring).
  rewrite !D, N in M. apply Rabs_le. lra.
Qed.

(* ---- THE LAW. A point x of a part, which is on the last link: scaled by s, turned by q, put at p. u: the stretch's share *)
Definition on_link s q p x := vadd (vscale s (rot q x)) p.
Lemma on_link_norm s q p x : 0 <= s -> 0 < qdot q q -> norm (on_link s q p x) <= norm p + s * norm x.
Proof.
  intros S Q. rewrite Rplus_comm. apply norm_sum; [|apply Rle_refl]. rewrite norm_vscale, norm_rot by auto. apply Rle_refl.
Qed.
Theorem chain_leaves_chord l s q p x n u : List.Forall ok l -> 0 <= s -> 0 < qdot q q -> 0 <= u <= 1 ->
  let f v := dot n (chain l v (on_link s q p x)) in
  Rabs (f u - ((1 - u) * f 0 + u * f 1)) <= norm n / 8 * acceleration l (norm p + s * norm x).
Proof.
  intros F S Q I f. replace (norm n / 8 * _) with (norm n * (acceleration l (norm p + s * norm x) / 8)) by field.
  exact (tame_chord _ _ _ _ n u (tame_chain l _ _ F (on_link_norm s q p x S Q)) I).
Qed.

(* ---- the C's loop, verify__part_deviation, from the part's link towards the base: one round of it, and all. Metres, and what
   r, the largest s |x|, is multiplied by. Its 0.1250001 is an eighth, and a bit *)
Definition eighth := 1250001 / 10000000.
Record sums := mkSums { reach : R; outer0 : R; outer1 : R; deviation0 : R; deviation1 : R }.
Definition round g z :=
  let arm0 := if slides (the g) then 1 else reach z in
  let arm1 := if slides (the g) then 0 else 1 in
  mkSums (reach z + (norm (offset (the g)) + (if slides (the g) then most g else 0)))
    (outer0 z + speed g * arm0) (outer1 z + speed g * arm1)
    (deviation0 z + eighth * bend g * arm0 + (if slides (the g) then 0 else eighth * speed g * (2 * outer0 z + speed g * arm0)))
    (deviation1 z + eighth * bend g * arm1 + (if slides (the g) then 0 else eighth * speed g * (2 * outer1 z + speed g * arm1))).
Definition loop l p := fold_right round (mkSums (norm p) 0 0 0 0) l.
Lemma loop_is_law l p r : reaches l (norm p + r) = reach (loop l p) + r /\
  rate l (norm p + r) = outer0 (loop l p) + outer1 (loop l p) * r /\
  eighth * acceleration l (norm p + r) = deviation0 (loop l p) + deviation1 (loop l p) * r.
Proof.
  induction l as [|g out (A & B & C)]; simpl; [repeat split; ring|].
  unfold arm. destruct (slides (the g)); rewrite A, B, !Rmult_plus_distr_l, C; repeat split; ring.
Qed.

(* ---- THE MOTION. On a piece, from time b to e, joint values are Bezier curves of one degree n. A part: its joints with their
   points, the one at its base first; its scale and its pose on the last link (nsvcd_verify_part, verify__part_place) *)
Record part := mkPart { joints : list (joint * (nat -> R)); grown : R; posed : quat; put : V }.
Definition fit m := List.Forall (fun g => well_made (fst g)) (joints m) /\ 0 <= grown m /\ 0 < qdot (posed m) (posed m).
Definition where_is n b e m t x := carried (map (fun g => (fst g, bez n (snd g) ((t - b) / (e - b)))) (joints m))
  (on_link (grown m) (posed m) (put m) x).

(* as verify__curve and verify__part_deviation have it from t0 to t1: the points of that part of each curve, and what they say.
   `o` times the largest of a curve's points is added to each for roundings: the C has 5e-13; here it is any from 0 on *)
Definition measured o n b e t0 t1 (g : joint * (nat -> R)) :=
  let to := (t1 - b) / (e - b) in let from := (t0 - b) / (e - b) / to in
  let p := cut n from to (snd g) in let off := o * largest n (snd g) in
  mkLink (fst g) (bez n p) (largest n p + off) (INR n * largest (pred n) (diff p) + off)
    (INR n * INR (pred n) * largest (pred (pred n)) (diff (diff p)) + off).
Definition chain_deviation o n b e t0 t1 m r :=
  let z := loop (map (measured o n b e t0 t1) (joints m)) (put m) in deviation0 z + deviation1 z * r.

Lemma measured_ok o n b e t0 t1 g : 0 <= o -> well_made (fst g) -> ok (measured o n b e t0 t1 g).
Proof.
  intros P W. split; [exact W|]. unfold measured. cbv zeta. cbn [value most speed bend].
  assert (Off : 0 <= o * largest n (snd g)).
  { apply Rmult_le_pos; [exact P|]. eapply Rle_trans; [apply Rabs_pos|apply (largest_is n (snd g) 0)]. apply Nat.le_0_l. }
  assert (More : forall x y, x <= y -> x <= y + o * largest n (snd g)) by (intros; lra).
  set (p := cut _ _ _ _). clearbody p. pose proof (pos_INR n) as N. pose proof (pos_INR (pred n)) as N'.
  exists (fun u => INR n * bez (pred n) (diff p) u), (fun u => INR n * (INR (pred n) * bez (pred (pred n)) (diff (diff p)) u)).
  intros u I. split; [apply bez_derives|]. split; [apply is_derive_scal, bez_derives|]. split; [apply More, bez_bounds, I|].
  rewrite !Rabs_mult, (Rabs_pos_eq (INR n)), (Rabs_pos_eq (INR (pred n))) by auto. rewrite <- Rmult_assoc.
  split; apply More, Rmult_le_compat_l; auto; try apply bez_bounds, I. apply Rmult_le_pos; auto.
Qed.
Lemma measured_all o n b e t0 t1 l : 0 <= o -> List.Forall (fun g => well_made (fst g)) l ->
  List.Forall ok (map (measured o n b e t0 t1) l).
Proof.
  intros P F. apply Forall_forall. intros g H. apply in_map_iff in H. destruct H as (h & <- & H).
  apply measured_ok; [exact P|]. rewrite Forall_forall in F. apply F, H.
Qed.
Lemma share_within t0 t1 t : t0 < t1 -> t0 <= t <= t1 -> 0 <= (t - t0) / (t1 - t0) <= 1.
Proof.
  intros L T. split; [apply Rmult_le_pos; [lra|apply Rlt_le, Rinv_0_lt_compat; lra]|].
  apply Rmult_le_reg_r with (t1 - t0); [lra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra.
Qed.
(* at a share of the stretch, a measured chain is where the part is *)
Lemma measured_is o n b e t0 t1 m t x : b < e -> b <= t0 < t1 ->
  chain (map (measured o n b e t0 t1) (joints m)) ((t - t0) / (t1 - t0)) (on_link (grown m) (posed m) (put m) x) =
  where_is n b e m t x.
Proof.
  intros E I. unfold chain, where_is. rewrite map_map. f_equal. apply map_ext. intros g.
  unfold measured. cbv zeta. cbn [the value]. f_equal. rewrite cut_is. f_equal. field. lra.
Qed.

(* A point of a part leaves its chord from t0 to t1, which are in one piece, by `chain_deviation` at most along a direction v of length 1 *)
Theorem motion_leaves_chord o n b e m t0 t1 t x r v : 0 <= o -> fit m -> norm (vscale (grown m) x) <= r ->
  b <= t0 < t1 -> t1 <= e -> t0 <= t <= t1 ->
  let f w := dot v (where_is n b e m w x) in
  Rabs (f t - ((t1 - t) * f t0 + (t - t0) * f t1) / (t1 - t0)) <= norm v * chain_deviation o n b e t0 t1 m r.
Proof.
  intros Po (F & G & Q) R I J T f. assert (E : b < e) by lra.
  set (l := map (measured o n b e t0 t1) (joints m)). rewrite norm_vscale in R by auto.
  assert (O : List.Forall ok l) by (apply measured_all; auto).
  pose proof (share_within t0 t1 t ltac:(lra) T) as U.
  assert (Y : norm (on_link (grown m) (posed m) (put m) x) <= norm (put m) + r)
    by (pose proof (on_link_norm (grown m) (posed m) (put m) x G Q); lra).
  pose proof (tame_chain l _ _ O Y) as Tm. pose proof (tame_chord _ _ _ _ v _ Tm U) as C.
  pose proof (measured_is o n b e t0 t1 m t0 x E I) as M0. pose proof (measured_is o n b e t0 t1 m t1 x E I) as M1.
  replace ((t0 - t0) / (t1 - t0)) with 0 in M0 by (field; lra). replace ((t1 - t0) / (t1 - t0)) with 1 in M1 by (field; lra).
  cbv beta in C. unfold l in C. rewrite measured_is, M0, M1 in C by auto. fold l (f t) (f t0) (f t1) in C.
  replace (((t1 - t) * f t0 + (t - t0) * f t1) / (t1 - t0)) with
    ((1 - (t - t0) / (t1 - t0)) * f t0 + (t - t0) / (t1 - t0) * f t1) by (field; lra).
  eapply Rle_trans; [exact C|]. apply Rmult_le_compat_l; [apply norm_pos|].
  unfold chain_deviation. fold l. cbv zeta. destruct (loop_is_law l (put m) r) as (_ & _ & <-).
  assert (S : 0 <= acceleration l (norm (put m) + r)).
  { destruct Tm as (y1 & y2 & Y'). destruct (Y' 0 ltac:(lra)) as (_ & _ & _ & _ & B).
    pose proof (norm_pos (y2 0)). lra. }
  unfold eighth. lra.
Qed.

(* and an arm of 1 m that turns steadily from -h to h: its tip leaves its chord by 1 - cos h, and the law says h^2 / 2, and a bit *)
Example arm_deviates h : 0 <= h -> chain_deviation 0 1 0 1 0 1 (mkPart [(upright origin0, fun i => match i with O => - h | _ => h end)]
  1 still (mkV 1 0 0)) 0 = eighth * (2 * h) ^ 2.
Proof.
  intros H. assert (S : norm (mkV 1 0 0) = 1).
  { unfold norm, dot. simpl. replace (1 * 1 + 0 * 0 + 0 * 0) with 1 by ring. apply sqrt_1. }
  unfold chain_deviation, loop, measured, round, cut, diff. simpl. rewrite S.
  replace ((1 - 0) / (1 - 0)) with 1 by field. replace ((0 - 0) / (1 - 0) / 1) with 0 by field.
  replace ((1 - 1) * - h + 1 * h - ((1 - 0) * - h + 0 * ((1 - 1) * - h + 1 * h))) with (2 * h) by ring.
  rewrite (Rabs_pos_eq (2 * h)) by lra. ring.
Qed.

(* ---- nsvcd_verify's step for two parts of one motion, seen from one base: a plane of normal v that separates a point of each at
   two instants of a piece, by more than the clearance and both deviations, separates them at all times between *)
Theorem parts_apart o n b e ma mb t0 t1 x y rx ry v c : 0 <= o -> fit ma -> fit mb ->
  norm (vscale (grown ma) x) <= rx -> norm (vscale (grown mb) y) <= ry -> b <= t0 < t1 -> t1 <= e ->
  let least := norm v * c + (norm v * chain_deviation o n b e t0 t1 ma rx + norm v * chain_deviation o n b e t0 t1 mb ry) in
  least < dot v (vsub (where_is n b e ma t0 x) (where_is n b e mb t0 y)) ->
  least < dot v (vsub (where_is n b e ma t1 x) (where_is n b e mb t1 y)) ->
  forall t, t0 <= t <= t1 -> c < norm (vsub (where_is n b e ma t x) (where_is n b e mb t y)).
Proof.
  intros Po Fa Fb Rx Ry I J least Hs He t T.
  assert (Sub : forall p q, dot v (vsub p q) = dot v p - dot v q) by (intros; unfold dot, vsub; simpl; ring).
  pose proof (motion_leaves_chord o n b e ma t0 t1 t x rx v Po Fa Rx I J T) as A.
  pose proof (motion_leaves_chord o n b e mb t0 t1 t y ry v Po Fb Ry I J T) as B.
  cbv beta zeta in A, B. apply Rabs_le_between in A. apply Rabs_le_between in B.
  assert (Main : norm v * c < dot v (vsub (where_is n b e ma t x) (where_is n b e mb t y))).
  { rewrite Sub in *. unfold least in *.
    apply (chords_apart (fun w => dot v (where_is n b e ma w x)) (fun w => dot v (where_is n b e mb w y)) t0 t1 t
      (norm v * chain_deviation o n b e t0 t1 ma rx) (norm v * chain_deviation o n b e t0 t1 mb ry)); auto; lra. }
  pose proof (cauchy v (vsub (where_is n b e ma t x) (where_is n b e mb t y))) as X.
  pose proof (Rle_abs (dot v (vsub (where_is n b e ma t x) (where_is n b e mb t y)))). pose proof (norm_pos v).
  set (d := norm (vsub _ _)) in *. nra.
Qed.

(* ---- verify__keeps: an axis of a part only turns. It leaves its chord by deviation[1], of which the rest is no part *)
Definition aim j q a := rot (frame j) (if slides j then a else rot (turn (unit_axis j) q) a).
Definition aimed (l : list (joint * R)) a := fold_right (fun g a => aim (fst g) (snd g) a) a l.
Definition points_to n b e m t a := aimed (map (fun g => (fst g, bez n (snd g) ((t - b) / (e - b)))) (joints m)) (rot (posed m) a).
Lemma carried_aimed l x y : vsub (carried l x) (carried l y) = aimed l (vsub x y).
Proof.
  assert (S : forall q v w, vsub (rot q v) (rot q w) = rot q (vsub v w))
    by (intros; unfold rot; apply V_eq; unfold vsub, vscale, turned; simpl; ring).
  assert (O : forall v w o, vsub (vadd v o) (vadd w o) = vsub v w)
    by (intros; apply V_eq; unfold vsub, vadd; simpl; ring).
  induction l as [|[j q] l IH]; [reflexivity|]. simpl. rewrite <- IH. unfold carry, aim. rewrite O, S. f_equal.
  destruct (slides j); [apply O|apply S].
Qed.
Lemma tame_aimed l p a : List.Forall ok l -> norm a <= 1 -> exists B, eighth * B = deviation1 (loop l p) /\
  tame (fun u => aimed (map (fun g => (the g, value g u)) l) a) 1 (outer1 (loop l p)) B.
Proof.
  assert (F0 : forall q y W B, 0 < qdot q q -> tame y 1 W B -> tame (fun u => rot q (y u)) 1 W B).
  { intros q y W B Q T. pose proof (tame_frame q (mkV 0 0 0) y 1 W B Q T) as X. rewrite norm_0, Rplus_0_r in X.
    eapply tame_ext; [|exact X]. intros u. apply V_eq; unfold vadd; simpl; ring. }
  intros F H. induction F as [|g out [O T] F (B & E & IH)]; simpl.
  - exists 0. split; [ring|exact (tame_const a 1 H)].
  - pose proof (unit_axis_unit _ O) as U. destruct O as [O _]. unfold aim. destruct (slides (the g)).
    + exists B. split; [rewrite E; ring|]. rewrite Rmult_0_r, Rplus_0_r. exact (F0 _ _ _ _ O IH).
    + exists (B + bend g * 1 + speed g * (2 * outer1 (loop out p) + speed g * 1)). split.
      * rewrite !Rmult_plus_distr_l, E. ring.
      * exact (F0 _ _ _ _ O (tame_turn _ _ _ _ _ _ _ _ _ U T IH)).
Qed.
(* so where it is within an angle of a direction v at two instants, by deviation[1] and more, it is so at all times between *)
Theorem axis_keeps o n b e m t0 t1 t a v least : 0 <= o -> fit m -> norm a <= 1 -> norm v <= 1 ->
  b <= t0 < t1 -> t1 <= e -> t0 <= t <= t1 ->
  let most1 := deviation1 (loop (map (measured o n b e t0 t1) (joints m)) (put m)) in
  least + most1 <= dot v (points_to n b e m t0 a) -> least + most1 <= dot v (points_to n b e m t1 a) ->
  least <= dot v (points_to n b e m t a).
Proof.
  intros Po (F & _ & Q) Ha Hv I J T most1 H0 H1. assert (E : b < e) by lra. set (l := map _ (joints m)) in most1.
  assert (O : List.Forall ok l) by (apply measured_all; auto).
  destruct (tame_aimed l (put m) (rot (posed m) a) O) as (B & EB & Tm); [rewrite norm_rot; auto|].
  assert (M : forall w, aimed (map (fun g => (the g, value g ((w - t0) / (t1 - t0)))) l) (rot (posed m) a) = points_to n b e m w a).
  { intros w. unfold points_to, l. rewrite map_map. f_equal. apply map_ext. intros g.
    unfold measured. cbv zeta. cbn [the value]. f_equal. rewrite cut_is. f_equal. field. lra. }
  pose proof (tame_above _ _ _ _ v _ Tm (share_within t0 t1 t ltac:(lra) T)) as C. cbv beta in C.
  pose proof (M t0) as M0. pose proof (M t1) as M1.
  replace ((t0 - t0) / (t1 - t0)) with 0 in M0 by (field; lra). replace ((t1 - t0) / (t1 - t0)) with 1 in M1 by (field; lra).
  rewrite M, M0, M1 in C. pose proof (share_within t0 t1 t ltac:(lra) T) as U. set (u := (t - t0) / (t1 - t0)) in *.
  assert (S : 0 <= B).
  { destruct Tm as (y1 & y2 & Y'). destruct (Y' 0 ltac:(lra)) as (_ & _ & _ & _ & X). pose proof (norm_pos (y2 0)). lra. }
  fold most1 in EB. pose proof (norm_pos v). assert (norm v * (B / 8) <= most1) by (rewrite <- EB; unfold eighth; nra). nra.
Qed.
