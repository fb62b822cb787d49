(* Inside.v - nothing is ever inside of a body that a plane once separated it from, if they never meet.
   A point of a that is at x at the time t leaves b, as b is at that time, on its own way in time to the
   plane, as b sees it, and from there straight on. b's triangles need not be closed. *)
From Coq Require Import Reals Lra List Qreals Classical.
From Coquelicot Require Import Coquelicot.
From Svcd Require Export Geometry.
Local Open Scope R_scope.

(* ---- continuity, coordinate by coordinate *)
Definition steady (f : R -> R) := continuity f.
Definition steadyV (f : R -> V) := steady (fun u => vx (f u)) /\ steady (fun u => vy (f u)) /\ steady (fun u => vz (f u)).
Definition steadyQ (f : R -> quat) := steady (fun u => qx (f u)) /\ steady (fun u => qy (f u)) /\
  steady (fun u => qz (f u)) /\ steady (fun u => qw (f u)).
Lemma steady_const k : steady (fun _ => k).
Proof. apply continuity_const. intros x y. reflexivity. Qed.
Lemma steady_id : steady (fun u => u).
Proof. apply derivable_continuous, derivable_id. Qed.
Lemma steady_plus f g : steady f -> steady g -> steady (fun u => f u + g u).
Proof. apply continuity_plus. Qed.
Lemma steady_minus f g : steady f -> steady g -> steady (fun u => f u - g u).
Proof. apply continuity_minus. Qed.
Lemma steady_opp f : steady f -> steady (fun u => - f u).
Proof. apply continuity_opp. Qed.
Lemma steady_mult f g : steady f -> steady g -> steady (fun u => f u * g u).
Proof. apply continuity_mult. Qed.
Lemma steady_sin f : steady f -> steady (fun u => sin (f u)).
Proof. intros F. apply (continuity_comp f sin F continuity_sin). Qed.
Lemma steady_abs f : steady f -> steady (fun u => Rabs (f u)).
Proof. intros F. apply (continuity_comp f Rabs F Rcontinuity_abs). Qed.
Ltac steady := unfold Rdiv; repeat first [assumption | apply steady_const | apply steady_id | apply steady_plus
  | apply steady_minus | apply steady_opp | apply steady_mult | apply steady_sin | apply steady_abs].

Lemma steady_vadd f g : steadyV f -> steadyV g -> steadyV (fun u => vadd (f u) (g u)).
Proof. intros (A & B & C) (D & E & F). repeat split; simpl; steady. Qed.
Lemma steady_vsub f g : steadyV f -> steadyV g -> steadyV (fun u => vsub (f u) (g u)).
Proof. intros (A & B & C) (D & E & F). repeat split; simpl; steady. Qed.
Lemma steady_vscale k f : steady k -> steadyV f -> steadyV (fun u => vscale (k u) (f u)).
Proof. intros K (A & B & C). repeat split; simpl; steady. Qed.
Lemma steady_fixed x : steadyV (fun _ => x).
Proof. repeat split; steady. Qed.
Lemma steady_turned q f : steadyQ q -> steadyV f -> steadyV (fun u => turned (q u) (f u)).
Proof. intros (A & B & C & D) (E & F & G). unfold turned, qdot. repeat split; simpl; steady. Qed.
Lemma steady_slerp a b c : steady c -> steadyQ (fun u => slerp a b (c u)).
Proof. intros C. unfold slerp. destruct Req_EM_T; repeat split; simpl; steady. Qed.
Lemma steady_share m c : steady c -> steady (fun u => share m (c u)).
Proof. intros C. unfold share. steady. Qed.
Lemma steady_origin m c : steady c -> steadyV (fun u => origin m (c u)).
Proof. intros C. pose proof (steady_share m c C). unfold origin. repeat split; simpl; steady. Qed.

(* continuous on each of finitely many closed sets, continuous on what they cover *)
Lemma paste {A} (l : list A) (on : A -> R -> Prop) (g : A -> R -> R) f :
  (forall i u, ~ on i u -> locally u (fun v => ~ on i v)) -> (forall i, In i l -> steady (fun u => g i u)) ->
  (forall u, exists i, In i l /\ on i u) -> (forall i u, In i l -> on i u -> f u = g i u) -> steady f.
Proof.
  intros O G C E u. apply continuity_pt_locally. intros eps.
  assert (H : forall k, incl k l -> locally u (fun v => forall i, In i k -> on i v -> Rabs (f v - f u) < eps)).
  { induction k as [|i k IH]; intros I; [apply filter_forall; intros v i []|].
    assert (Ii : In i l) by (apply I; left; reflexivity).
    assert (Hi : locally u (fun v => on i v -> Rabs (f v - f u) < eps)).
    { destruct (classic (on i u)) as [U|U].
      - pose proof (proj1 (continuity_pt_locally (g i) u) (G i Ii u) eps) as L. revert L. apply filter_imp.
        intros v L V. rewrite !(E i) by auto. exact L.
      - generalize (O i u U). apply filter_imp. intros v N V. contradiction. }
    generalize (filter_and _ _ Hi (IH (fun j J => I j (or_intror J)))). apply filter_imp.
    intros v (X & Y) j J. destruct J as [J|J]; [subst j; exact X|exact (Y j J)]. }
  generalize (H l (incl_refl l)). apply filter_imp. intros v X. destruct (C v) as (i & I & V). eauto.
Qed.

(* times where a continuous clock is outside of a closed interval have a neighbourhood of such *)
Lemma outside_open c lo hi u : steady c -> ~ lo <= c u <= hi -> locally u (fun v => ~ lo <= c v <= hi).
Proof.
  intros C N. pose proof (proj1 (continuity_pt_locally c u) (C u)) as L.
  assert (P : 0 < Rmax (lo - c u) (c u - hi)).
  { destruct (Rlt_dec (c u) lo); [eapply Rlt_le_trans; [|apply Rmax_l]; lra|].
    eapply Rlt_le_trans; [|apply Rmax_r]. destruct (Rle_dec (c u) hi); [exfalso; apply N|]; lra. }
  generalize (L (mkposreal _ P)). apply filter_imp. simpl. intros v A [B D].
  apply Rabs_lt_between in A. unfold Rmax in A. destruct Rle_dec; lra.
Qed.

(* ---- a rotation's inverse, and a point as a body sees it *)
Definition conj q := mkQ (- qx q) (- qy q) (- qz q) (qw q).
Lemma conj_unit q : qdot (conj q) (conj q) = qdot q q.
Proof. unfold qdot, conj; simpl; ring. Qed.
Lemma turned_back q v : qdot q q = 1 -> turned (conj q) (turned q v) = v.
Proof.
  intros Q. transitivity (vscale (qdot q q * qdot q q) v).
  - apply V_eq; unfold turned, conj, vscale, qdot; simpl; ring.
  - rewrite Q. apply V_eq; unfold vscale; simpl; ring.
Qed.
Lemma turned_forth q v : qdot q q = 1 -> turned q (turned (conj q) v) = v.
Proof.
  intros Q. transitivity (vscale (qdot q q * qdot q q) v).
  - apply V_eq; unfold turned, conj, vscale, qdot; simpl; ring.
  - rewrite Q. apply V_eq; unfold vscale; simpl; ring.
Qed.
Lemma turned_vsub q v w : vsub (turned q v) (turned q w) = turned q (vsub v w).
Proof. apply V_eq; unfold vsub, turned; simpl; ring. Qed.

Definition attitude m t := slerp (q0 m) (q1 m) (share m t).
Definition seen m t p := vscale (/ scale m) (turned (conj (attitude m t)) (vsub p (origin m t))).

Section Placed.
Variable m : piece.
Hypothesis W : well_formed m.
Lemma attitude_unit t : qdot (attitude m t) (attitude m t) = 1.
Proof. destruct W as (_ & _ & A & B). apply slerp_unit; auto. Qed.
Lemma place_turned t y : place m t y = vadd (vscale (scale m) (turned (attitude m t) y)) (origin m t).
Proof. unfold place. fold (attitude m t). rewrite rot_unit by apply attitude_unit. reflexivity. Qed.
Lemma seen_place t y : scale m <> 0 -> seen m t (place m t y) = y.
Proof.
  intros S. rewrite place_turned. unfold seen. transitivity (turned (conj (attitude m t)) (turned (attitude m t) y)).
  - apply V_eq; unfold vscale, vadd, vsub, turned; simpl; field; auto.
  - apply turned_back, attitude_unit.
Qed.
Lemma place_seen t p : scale m <> 0 -> place m t (seen m t p) = p.
Proof.
  intros S. rewrite place_turned. unfold seen.
  transitivity (vadd (turned (attitude m t) (turned (conj (attitude m t)) (vsub p (origin m t)))) (origin m t)).
  - apply V_eq; unfold vscale, vadd, turned; simpl; field; auto.
  - rewrite turned_forth by apply attitude_unit. apply V_eq; unfold vadd, vsub; simpl; ring.
Qed.
Lemma place_far t v w : norm (vsub (place m t v) (place m t w)) = scale m * norm (vsub v w).
Proof.
  rewrite !place_turned. replace (vsub _ _) with (vscale (scale m) (turned (attitude m t) (vsub v w)))
    by (rewrite <- turned_vsub; apply V_eq; unfold vsub, vscale, vadd; simpl; ring).
  rewrite norm_vscale by apply W. rewrite turned_norm, attitude_unit. ring.
Qed.
Lemma seen_far t v w : scale m <> 0 -> norm (vsub v w) = scale m * norm (vsub (seen m t v) (seen m t w)).
Proof. intros S. rewrite <- place_far with (t := t), !place_seen; auto. Qed.
Lemma steady_place c f : steady c -> steadyV f ->
  steadyV (fun u => vadd (vscale (scale m) (turned (attitude m (c u)) (f u))) (origin m (c u))).
Proof.
  intros C F. apply steady_vadd; [|apply steady_origin, C]. apply steady_vscale; [steady|].
  apply steady_turned; auto. apply steady_slerp, steady_share, C.
Qed.
Lemma steady_seen c f : steady c -> steadyV f -> steadyV (fun u => seen m (c u) (f u)).
Proof.
  intros C F. apply steady_vscale; [steady|]. apply steady_turned.
  - destruct (steady_slerp (q0 m) (q1 m) _ (steady_share m c C)) as (X & Y & Z & A).
    unfold conj, attitude. repeat split; simpl; steady.
  - apply steady_vsub; auto. apply steady_origin, C.
Qed.
End Placed.

(* ---- ways *)
Definition clamped u := / 2 * (1 + Rabs u - Rabs (u - 1)).   (* 0, then u, then 1 *)
Definition beyond u := / 2 * (u - 1 + Rabs (u - 1)).           (* 0, from 1 on u - 1 *)
Lemma clamped_range u : 0 <= clamped u <= 1.
Proof. unfold clamped. unfold Rabs. repeat destruct Rcase_abs; lra. Qed.
Lemma clamped_0 : clamped 0 = 0.
Proof. unfold clamped. unfold Rabs. repeat destruct Rcase_abs; lra. Qed.
Lemma beyond_1 u : u <= 1 -> beyond u = 0.
Proof. unfold beyond, Rabs. destruct Rcase_abs; lra. Qed.
Lemma past_1 u : 1 <= u -> clamped u = 1 /\ beyond u = u - 1.
Proof. unfold clamped, beyond, Rabs. repeat destruct Rcase_abs; lra. Qed.

Lemma vsub_norm a b : norm (vsub a b) <= norm a + norm b.
Proof.
  replace (norm b) with (norm (vscale (-1) b)) by (unfold norm, dot, vscale; f_equal; simpl; ring).
  replace (vsub a b) with (vadd a (vscale (-1) b)) by (apply V_eq; unfold vsub, vadd, vscale; simpl; ring).
  apply norm_vadd.
Qed.
Lemma goes_away (way : R -> V) p k : 0 < k -> (forall u, 1 <= u -> norm (vsub (way u) p) = (u - 1) * k) ->
  forall bound, exists u, forall v, u <= v -> bound < norm (way v).
Proof.
  intros K H bound. set (s := Rabs bound + norm p + 1). exists (s / k + 1). intros v L.
  pose proof (Rle_abs bound). pose proof (Rabs_pos bound). pose proof (norm_pos p).
  assert (0 < s / k) by (apply Rdiv_lt_0_compat; unfold s; lra).
  pose proof (vsub_norm (way v) p) as X. rewrite H in X by lra.
  assert (s <= (v - 1) * k). { replace s with (s / k * k) by (field; lra). apply Rmult_le_compat_r; lra. }
  unfold s in *. lra.
Qed.
Lemma norm_zero a b : norm (vsub a b) = 0 -> a = b.
Proof.
  intros H. unfold norm in H. apply sqrt_eq_0 in H; [|apply dot_pos]. unfold dot, vsub in H. simpl in H.
  pose proof (Rle_0_sqr (vx a - vx b)). pose proof (Rle_0_sqr (vy a - vy b)). pose proof (Rle_0_sqr (vz a - vz b)).
  unfold Rsqr in *. apply V_eq; apply Rminus_diag_uniq, Rsqr_0_uniq; unfold Rsqr; lra.
Qed.
Lemma straight b t x d : 0 < norm d -> (forall u, 0 <= u -> ~ at_time b t (vadd x (vscale u d))) -> free_way b t x.
Proof.
  intros D H. exists (fun u => vadd x (vscale u d)). split; [apply V_eq; unfold vadd, vscale; simpl; ring|].
  assert (C : steadyV (fun u => vadd x (vscale u d)))
    by (apply steady_vadd; [|apply steady_vscale; [steady|]]; apply steady_fixed).
  destruct C as (Cx & Cy & Cz). split; [exact Cx|split; [exact Cy|split; [exact Cz|split; [exact H|]]]].
  apply (goes_away _ (vadd x d) (norm d) D). intros u U. rewrite <- norm_vscale by lra. f_equal.
  apply V_eq; unfold vadd, vsub, vscale; simpl; ring.
Qed.

(* ---- a body's piece at a time *)
Definition during m t := Q2R (t_from m) <= t <= Q2R (t_to m).
Lemma during_dec m t : {during m t} + {~ during m t}.
Proof.
  unfold during. destruct (Rle_dec (Q2R (t_from m)) t), (Rle_dec t (Q2R (t_to m))); [left; auto|right|right|right]; tauto.
Defined.
Fixpoint piece_at (l : list qpiece) (t : R) : qpiece := match l with
  | nil => mkQP 0 0 (mkPose 0 0 0 0 0 0 0) (mkPose 0 0 0 0 0 0 0)
  | m :: l => if during_dec m t then m else piece_at l t end.
Lemma piece_at_ok l t : (exists m, In m l /\ during m t) -> In (piece_at l t) l /\ during (piece_at l t) t.
Proof.
  induction l as [|h l IH]; simpl; intros (m & I & D); [destruct I|].
  destruct (during_dec h t) as [H|H]; [auto|]. destruct IH; [|auto]. exists m. destruct I as [<-|I]; [contradiction|auto].
Qed.

Definition rigid b := moves b /\ forall m, In m (pieces b) -> well_formed (pieceR (size b) m).
Definition now b t := pieceR (size b) (piece_at (pieces b) t).
Lemma now_is b m t y : rigid b -> In m (pieces b) -> during m t -> 0 <= t <= 1 ->
  place (now b t) t y = place (pieceR (size b) m) t y.
Proof. intros ((C & O) & _) I D T. destruct (piece_at_ok (pieces b) t (C t T)). apply O; auto. Qed.
Lemma now_formed b t : rigid b -> 0 <= t <= 1 -> well_formed (now b t).
Proof. intros ((C & _) & F) T. apply F, (piece_at_ok (pieces b) t (C t T)). Qed.
Lemma now_points b t z : rigid b -> 0 <= t <= 1 -> at_time b t z <->
  exists T y, In T (tris b) /\ of_tri y (triR (den b) T) /\ z = place (now b t) t y.
Proof.
  intros R T. pose proof R as ((C & _) & _). destruct (piece_at_ok (pieces b) t (C t T)) as [I D]. split.
  - intros (m & U & y & Im & Dm & IU & Y & ->). exists U, y. rewrite (now_is b m); auto.
  - intros (U & y & IU & Y & ->). exists (piece_at (pieces b) t), U, y. auto 10.
Qed.

Section Escape.
Variables a b : body.
Hypothesis Ra : rigid a.
Hypothesis Rb : rigid b.
Hypothesis Never : forall t x, 0 <= t <= 1 -> at_time a t x -> ~ at_time b t x.

(* a body as small as a point is left straight away from it *)
Lemma away_from_point t x : 0 <= t <= 1 -> at_time a t x -> Q2R (size b) = 0 -> free_way b t x.
Proof.
  intros T X S. set (o := origin (now b t) t).
  assert (O : forall z, at_time b t z -> z = o).
  { intros z Z. apply now_points in Z as (U & y & _ & _ & ->); auto. unfold place. fold o.
    replace (scale (now b t)) with 0 by (symmetry; exact S). apply V_eq; unfold vadd, vscale; simpl; ring. }
  destruct (classic (exists z, at_time b t z)) as [(z & Z)|N].
  - assert (Zo := O z Z). subst z. destruct (Req_dec (norm (vsub x o)) 0) as [E|E].
    + exfalso. apply norm_zero in E. apply (Never t x T X). rewrite E. exact Z.
    + pose proof (norm_pos (vsub x o)). apply straight with (vsub x o); [lra|]. intros u L A. apply O in A. apply E.
      assert (F : norm (vscale (1 + u) (vsub x o)) = norm (vsub o o)).
      { rewrite <- A at 2. f_equal. apply V_eq; unfold vadd, vsub, vscale; simpl; ring. }
      replace (vsub o o) with (vscale 0 o) in F by (apply V_eq; unfold vsub, vscale; simpl; ring).
      rewrite !norm_vscale in F by lra. rewrite Rmult_0_l in F. apply Rmult_integral in F as [F|F]; lra.
  - apply straight with (mkV 1 0 0); [|intros u _ A; eauto]. unfold norm, dot; simpl.
    replace (1 * 1 + 0 * 0 + 0 * 0) with 1 by ring. rewrite sqrt_1. lra.
Qed.

Section Way.
Variables (t e : R) (n y : V).
Hypothesis T : 0 <= t <= 1.
Hypothesis E : 0 <= e <= 1.
Hypothesis Plane : forall p q, at_time a e p -> at_time b e q -> 0 < dot n (vsub p q).
Hypothesis Y : forall s, 0 <= s <= 1 -> at_time a s (place (now a s) s y).
Hypothesis Far : 0 < norm n.
Hypothesis S : Q2R (size b) <> 0.

(* in time from t to e, where the plane is, and on from there along its normal: as b sees it, put where b is at t *)
Definition clock u := t + clamped u * (e - t).
Definition way u := let s := clock u in
  place (now b t) t (seen (now b s) s (vadd (place (now a s) s y) (vscale (beyond u) n))).

Lemma clock_range u : 0 <= clock u <= 1.
Proof. unfold clock. pose proof (clamped_range u). nra. Qed.

Lemma way_starts : way 0 = place (now a t) t y.
Proof.
  unfold way, clock. rewrite clamped_0, beyond_1 by lra. replace (t + 0 * (e - t)) with t by ring.
  rewrite place_seen; [|apply (now_formed b t Rb T)|exact S]. apply V_eq; unfold vadd, vscale; simpl; ring.
Qed.

Lemma way_clear u : 0 <= u -> ~ at_time b t (way u).
Proof.
  intros U A. apply now_points in A as (F & z & IF & Z & A); auto. unfold way in A.
  set (s := clock u) in *. assert (Rs : 0 <= s <= 1) by apply clock_range.
  apply (f_equal (seen (now b t) t)) in A. rewrite !seen_place in A by (apply (now_formed b t Rb T) || exact S).
  apply (f_equal (place (now b s) s)) in A. rewrite place_seen in A by (apply (now_formed b s Rb Rs) || exact S).
  assert (B : at_time b s (place (now b s) s z)) by (apply now_points; eauto).
  rewrite <- A in B. destruct (Rle_dec u 1) as [L|L].
  - rewrite beyond_1 in B by auto. apply (Never s _ Rs (Y s Rs)).
    replace (vadd _ _) with (place (now a s) s y) in B by (apply V_eq; unfold vadd, vscale; simpl; ring). exact B.
  - destruct (past_1 u) as [C D]; [lra|]. assert (Es : s = e) by (unfold s, clock; rewrite C; ring).
    rewrite Es in *. pose proof (Plane _ _ (Y e E) B) as P. rewrite D in P.
    replace (dot n _) with (- ((u - 1) * dot n n)) in P by (unfold dot, vsub, vadd, vscale; simpl; ring).
    pose proof (dot_pos n). nra.
Qed.

Lemma way_unbounded : forall bound, exists u, forall v, u <= v -> bound < norm (way v).
Proof.
  apply (goes_away _ (way 1) (norm n) Far). intros u U. unfold way, clock.
  destruct (past_1 u U) as [-> ->]. destruct (past_1 1) as [-> ->]; [lra|]. replace (t + 1 * (e - t)) with e by ring.
  rewrite place_far by apply (now_formed b t Rb T). change (scale (now b t)) with (scale (now b e)).
  rewrite <- seen_far by (apply (now_formed b e Rb E) || exact S).
  rewrite <- norm_vscale by lra. f_equal. apply V_eq; unfold vadd, vsub, vscale; simpl; ring.
Qed.

Lemma way_steady : steadyV way.
Proof.
  destruct Ra as ((Ca & _) & Fa), Rb as ((Cb & _) & Fb).
  set (l := list_prod (pieces a) (pieces b)).
  set (on := fun (i : qpiece * qpiece) u => during (fst i) (clock u) /\ during (snd i) (clock u)).
  set (att := fun m s v => vadd (vscale (scale m) (turned (attitude m s) v)) (origin m s)).
  set (g := fun (i : qpiece * qpiece) u => att (now b t) t (seen (pieceR (size b) (snd i)) (clock u)
    (vadd (att (pieceR (size a) (fst i)) (clock u) y) (vscale (beyond u) n)))).
  assert (K : steady clock) by (unfold clock, clamped; steady).
  assert (Open : forall i u, ~ on i u -> locally u (fun v => ~ on i v)).
  { intros i u N. apply not_and_or in N as [N|N]; generalize (outside_open _ _ _ _ K N); apply filter_imp;
      intros v M [B C]; auto. }
  assert (Some_ : forall u, exists i, In i l /\ on i u).
  { intros u. destruct (Ca _ (clock_range u)) as (m & I & D), (Cb _ (clock_range u)) as (m' & I' & D').
    exists (m, m'). split; [apply in_prod; auto|split; auto]. }
  assert (Same : forall i u, In i l -> on i u -> way u = g i u).
  { intros [m m'] u I [D D']. apply in_prod_iff in I as [I I']. cbn [fst snd] in D, D'.
    pose proof (clock_range u) as R. unfold g, att, way. cbn [fst snd].
    rewrite <- !place_turned by (auto; apply (now_formed b t Rb T)). rewrite <- (now_is a m) by auto. f_equal.
    set (p := vadd _ _). rewrite <- (seen_place (pieceR (size b) m') (Fb m' I') (clock u) (seen (now b _) _ p)) by exact S.
    rewrite <- (now_is b m') by auto. rewrite place_seen; auto. apply (now_formed b _ Rb R). }
  assert (Steady : forall i, In i l -> steadyV (g i)).
  { intros [m m'] I. apply in_prod_iff in I as [I I'].
    apply (steady_place (now b t) (fun _ => t)); [steady|]. cbn [fst snd].
    apply steady_seen; auto. apply steady_vadd; [apply steady_place; auto; apply steady_fixed|].
    apply steady_vscale; [unfold beyond; steady|apply steady_fixed]. }
  split; [|split]; [apply (paste l on (fun i u => vx (g i u)))|apply (paste l on (fun i u => vy (g i u)))
    |apply (paste l on (fun i u => vz (g i u)))]; auto;
    try (intros i I; apply (Steady i I)); intros i u I O; rewrite (Same i u I O); reflexivity.
Qed.
End Way.

Theorem escapes : (exists t n, 0 <= t <= 1 /\ forall p q, at_time a t p -> at_time b t q -> 0 < dot n (vsub p q)) ->
  forall t x, 0 <= t <= 1 -> at_time a t x -> free_way b t x.
Proof.
  intros (e & n & E & P) t x T X. destruct (Req_dec (Q2R (size b)) 0) as [S|S]; [apply away_from_point; auto|].
  destruct X as (m & F & y & I & D & IF & Y & ->).
  assert (A : forall s, 0 <= s <= 1 -> at_time a s (place (now a s) s y)).
  { intros s Rs. apply now_points; eauto. }
  rewrite <- (now_is a m) by auto.
  destruct (classic (exists z, at_time b e z)) as [(z & Z)|N].
  - assert (Far : 0 < norm n).
    { pose proof (P _ _ (A e E) Z) as L. pose proof (cauchy n (vsub (place (now a e) e y) z)) as C.
      pose proof (Rle_abs (dot n (vsub (place (now a e) e y) z))). pose proof (norm_pos n) as [|Q]; auto.
      rewrite <- Q in C. lra. }
    exists (way t e n y). split; [apply way_starts; auto|].
    destruct (way_steady t e n y T E S) as (Cx & Cy & Cz).
    repeat split; auto; [intros u U; apply way_clear; auto|apply way_unbounded; auto].
  - apply straight with (mkV 1 0 0).
    + unfold norm, dot; simpl. replace (1 * 1 + 0 * 0 + 0 * 0) with 1 by ring. rewrite sqrt_1. lra.
    + intros u _ Z. apply now_points in Z as (G & z & IG & Z & _); auto. apply N.
      exists (place (now b e) e z). apply now_points; eauto.
Qed.
End Escape.

(* both ways: what never meets and was once apart *)
Theorem inside_never s : rigid (body_a s) -> rigid (body_b s) -> 0 <= Q2R (clearance s) ->
  never_meet s -> once_apart s -> never_inside s.
Proof.
  intros A B C M (e & n & E & P).
  assert (N : forall t x, 0 <= t <= 1 -> at_time (body_a s) t x -> ~ at_time (body_b s) t x).
  { intros t x T X Y. pose proof (M t x x T X Y) as L. replace (vsub x x) with (vscale 0 x) in L
      by (apply V_eq; unfold vsub, vscale; simpl; ring). rewrite norm_vscale in L by lra. lra. }
  intros t x T. split; intros X; [apply (escapes (body_a s) (body_b s))|apply (escapes (body_b s) (body_a s))]; auto.
  - exists e, n. auto.
  - intros r y L Y Z. apply (N r y L Z Y).
  - exists e, (vscale (-1) n). split; auto. intros p q Hp Hq.
    replace (dot _ _) with (dot n (vsub q p)) by (unfold dot, vsub, vscale; simpl; ring). auto.
Qed.
