(* Closed.v - components of meshes, and which are closed, as they are computed and as Answers.v means it; and why what is never
   touched is never wound about, if not at first. *)
From Coq Require Import Reals Lra Lia Psatz List ZArith QArith Qreals Bool Permutation Classical.
From Coq Require Import OrderedType OrderedTypeEx FMapAVL FMapFacts.
From Coquelicot Require Import Coquelicot.
From Svcd Require Export Meeting Winding.
Import ListNotations.
Local Open Scope R_scope.

(* ---- maps from places, and from edges *)
Module Place <: OrderedType.
  Definition t := zv.
  Definition eq := @Logic.eq zv.
  Definition lt p q := (zx p < zx q \/ zx p = zx q /\ (zy p < zy q \/ zy p = zy q /\ zz p < zz q))%Z.
  Definition eq_refl := @Logic.eq_refl zv.
  Definition eq_sym := @Logic.eq_sym zv.
  Definition eq_trans := @Logic.eq_trans zv.
  Lemma lt_trans p q r : lt p q -> lt q r -> lt p r.
  Proof. unfold lt; lia. Qed.
  Lemma lt_not_eq p q : lt p q -> ~ eq p q.
  Proof. unfold lt. intros H E. rewrite E in H. lia. Qed.
  Definition compare p q : Compare lt eq p q.
  Proof.
    destruct (Z_as_OT.compare (zx p) (zx q)) as [H|H|H]; [apply LT; left; exact H| |apply GT; left; exact H].
    destruct (Z_as_OT.compare (zy p) (zy q)) as [K|K|K]; [apply LT; right; auto| |apply GT; right; split; auto].
    destruct (Z_as_OT.compare (zz p) (zz q)) as [L|L|L]; [apply LT; right; auto| |apply GT; right; split; auto; right; auto].
    apply EQ. destruct p, q. unfold Z_as_OT.eq in *. simpl in *. subst. reflexivity.
  Defined.
  Definition eq_dec := zv_dec.
End Place.
Module Edge := PairOrderedType Place Place.
Module Places := FMapAVL.Make Place.
Module Edges := FMapAVL.Make Edge.
Module PF := FMapFacts.WFacts_fun Place Places.
Module EF := FMapFacts.WFacts_fun Edge Edges.

Definition times (m : Edges.t nat) e := match Edges.find e m with Some n => n | None => 0%nat end.
Definition tally es := fold_right (fun e m => Edges.add e (S (times m e)) m) (Edges.empty nat) es.
Lemma tally_ok es e : times (tally es) e = count_occ edge_dec es e.
Proof.
  induction es as [|f es IH]; [reflexivity|]. simpl. unfold times at 1. rewrite EF.add_o.
  destruct (EF.eq_dec f e) as [[A B]|N], (edge_dec f e) as [F|F]; unfold Edge.eq, Place.eq in *.
  - subst f. rewrite <- IH. reflexivity.
  - exfalso. apply F. destruct f, e. simpl in *. congruence.
  - exfalso. apply N. subst f. split; reflexivity.
  - exact IH.
Qed.
(* where edges begin that go there not as often as back *)
Definition uneven l := let es := flat_map edges l in let m := tally es in
  map fst (filter (fun e => negb (times m e =? times m (snd e, fst e))%nat) es).
Lemma uneven_ok l p : In p (uneven l) <-> exists q, In (p, q) (flat_map edges l) /\ ~ evenly l p q.
Proof.
  unfold uneven. cbv zeta. rewrite in_map_iff. unfold evenly. split.
  - intros ([p' q] & E & H). simpl in E. subst p'. apply filter_In in H as [H N]. rewrite !tally_ok in N. exists q. split; auto.
    apply negb_true_iff, Nat.eqb_neq in N. exact N.
  - intros (q & H & N). exists (p, q). split; auto. apply filter_In. rewrite !tally_ok. split; auto.
    apply negb_true_iff, Nat.eqb_neq, N.
Qed.

(* the triangles at each place; from some places all that is joined to them is taken out *)
Definition found_at p m : list ztri := match Places.find p m with Some l => l | None => [] end.
Definition by_place l := fold_right (fun T m => fold_right (fun p m => Places.add p (T :: found_at p m) m) m (corners_of T))
  (Places.empty (list ztri)) l.
Lemma by_place_ok l : forall p T, In T (found_at p (by_place l)) <-> In T l /\ In p (corners_of T).
Proof.
  induction l as [|U l IH]; intros p T; [simpl; tauto|]. cbn [by_place fold_right]. fold (by_place l).
  assert (H : forall ps m, In T (found_at p (fold_right (fun p m => Places.add p (U :: found_at p m) m) m ps)) <->
    U = T /\ In p ps \/ In T (found_at p m)).
  { induction ps as [|q ps IHp]; intros m; [simpl; tauto|]. cbn [fold_right]. unfold found_at at 1. rewrite PF.add_o.
    destruct (Place.eq_dec q p) as [E|N]; unfold Place.eq in *.
    - subst q. cbn [In]. rewrite IHp. tauto.
    - fold (found_at p (fold_right (fun p m => Places.add p (U :: found_at p m) m) m ps)). rewrite IHp. cbn [In]. tauto. }
  rewrite H, IH. cbn [In]. split; [intros [[-> X]|[X Y]]; auto|intros [[->|X] Y]; auto].
Qed.

Fixpoint flood (fuel : nat) (todo : list zv) (m : Places.t (list ztri)) := match todo with
  | [] => Some m
  | p :: todo => match fuel with O => None | S fuel => match Places.find p m with
    | None => flood fuel todo m
    | Some l => flood fuel (flat_map corners_of l ++ todo) (Places.remove p m) end end end.
Definition gone p (m : Places.t (list ztri)) := Places.find p m = None.
Lemma flood_ok l fuel : forall todo m m', (forall p k, Places.find p m = Some k -> forall T, In T k <-> In T l /\
  In p (corners_of T)) ->
  (forall T p q, In T l -> In p (corners_of T) -> In q (corners_of T) -> gone p m -> gone q m \/ In q todo) ->
  flood fuel todo m = Some m' ->
  (forall p, In p todo \/ gone p m -> gone p m') /\
  (forall T p q, In T l -> In p (corners_of T) -> In q (corners_of T) -> gone p m' -> gone q m') /\
  forall P : zv -> Prop, (forall p, In p todo -> P p) ->
    (forall T p q, In T l -> In p (corners_of T) -> In q (corners_of T) -> P p -> P q) -> forall p, gone p m' -> gone p m \/ P p.
Proof.
  induction fuel as [|fuel IH]; intros todo m m' Has Inv H; destruct todo as [|p todo]; simpl in H; try discriminate;
    try (injection H as <-; split; [simpl; tauto|split; [|auto]]; intros T p q I A B G; destruct (Inv T p q I A B G) as [|[]];
      auto).
  destruct (Places.find p m) as [k|] eqn:F.
  - assert (R : forall q, gone q (Places.remove p m) <-> q = p \/ gone q m).
    { intros q. unfold gone. rewrite PF.remove_o. destruct (Place.eq_dec p q) as [E|N]; unfold Place.eq in *;
      intuition congruence. }
    apply IH in H.
    + destruct H as (A & B & C). split; [|split; [exact B|]].
      * intros q [[<-|I]|G]; apply A; rewrite R, in_app_iff; auto.
      * intros P Q St q G. destruct (C P) with (p := q) as [D|D]; auto.
        -- intros r I. apply in_app_iff in I as [I|I]; [|apply Q; right; exact I].
           apply in_flat_map in I as (T & I & J). apply (Has p k F) in I as [I K]. apply (St T p); auto. apply Q. left. reflexivity.
        -- apply R in D as [->|D]; auto. right. apply Q. left. reflexivity.
    + intros q j G. rewrite PF.remove_o in G. destruct (Place.eq_dec p q); [discriminate|]. apply Has, G.
    + intros T q r I Q Q' G. rewrite R, in_app_iff. apply R in G as [->|G].
      * right. left. apply in_flat_map. exists T. split; auto. apply (Has p k F). auto.
      * destruct (Inv T q r I Q Q' G) as [|[<-|]]; auto.
  - apply IH in H; auto.
    + destruct H as (A & B & C). split; [|split; [exact B|]].
      * intros q [[<-|I]|G]; apply A; auto.
      * intros P Q St q G. apply (C P); auto. intros r I. apply Q. right. exact I.
    + intros T q r I Q Q' G. destruct (Inv T q r I Q Q' G) as [|[<-|]]; auto.
Qed.

(* ---- of a mesh: which triangles are of closed components, where rays begin, and which places are corners *)
Record surface := mkSurface { kept : ztri -> bool; starts : list zv; is_corner : zv -> bool }.
Definition surface_of l (hint : list zv) := let m := by_place l in let from todo := flood (length todo + 12 * length l) todo m in
  match from (uneven l), from hint with
  | Some open, Some none =>
    if forallb (fun T => negb (Places.mem (za T) none)) l
    then Some (mkSurface (fun T => Places.mem (za T) open) hint (fun p => Places.mem p m)) else None
  | _, _ => None end.
Lemma mem_gone p m : Places.mem p m = false <-> gone p m.
Proof. unfold gone. rewrite PF.mem_find_b. destruct (Places.find p m); split; congruence. Qed.
Lemma from_ok l todo m' : flood (length todo + 12 * length l) todo (by_place l) = Some m' ->
  (forall p, In p todo -> gone p m') /\
  (forall T p q, In T l -> In p (corners_of T) -> In q (corners_of T) -> gone p m' -> gone q m') /\
  forall P : zv -> Prop, (forall p, In p todo -> P p) ->
    (forall T p q, In T l -> In p (corners_of T) -> In q (corners_of T) -> P p -> P q) ->
    forall T p, In T l -> In p (corners_of T) -> gone p m' -> P p.
Proof.
  intros H.
  assert (There : forall T p, In T l -> In p (corners_of T) -> ~ gone p (by_place l)).
  { intros T p I J G. assert (X : In T (found_at p (by_place l))) by (apply by_place_ok; auto).
    unfold found_at in X. rewrite G in X. destruct X. }
  apply (flood_ok l) in H.
  - destruct H as (A & B & C). split; [auto|split; [exact B|]]. intros P Q St T p I J G.
    destruct (C P Q St p G); auto. exfalso. eapply There; eauto.
  - intros p k F T. rewrite <- by_place_ok. unfold found_at. rewrite F. tauto.
  - intros T p q I J _ G. exfalso. eapply There; eauto.
Qed.
Lemma edge_corners T p q : In (p, q) (edges T) -> In p (corners_of T) /\ In q (corners_of T).
Proof. unfold edges, corners_of. simpl. intros [E|[E|[E|[]]]]; injection E as <- <-; auto. Qed.
Lemma za_corner T : In (za T) (corners_of T).
Proof. left. reflexivity. Qed.

Lemma joined_before l T U W p : In U l -> In p (corners_of T) -> In p (corners_of U) -> joined l U W -> joined l T W.
Proof.
  intros I A B J. induction J as [|X W r J IH K C D].
  - apply next with T p; auto. apply itself.
  - apply next with X r; auto.
Qed.

Lemma surface_ok l hint f : surface_of l hint = Some f ->
  (forall T, In T l -> (kept f T = true <-> closed l T)) /\
  (forall P : zv -> Prop, (forall p, In p (starts f) -> P p) ->
    (forall T p q, In T l -> In p (corners_of T) -> In q (corners_of T) -> P p -> P q) ->
    forall T p, In T l -> In p (corners_of T) -> P p) /\
  (forall p, is_corner f p = true -> exists T, In T l /\ In p (corners_of T)).
Proof.
  unfold surface_of. cbv zeta. destruct (flood _ (uneven l) _) as [m|] eqn:A; [|discriminate].
  destruct (flood _ hint _) as [m'|] eqn:B; [|discriminate]. destruct (forallb _ l) eqn:C; [|discriminate].
  intros H. injection H as <-. cbn [kept starts is_corner]. apply from_ok in A as (A1 & A2 & A3).
    apply from_ok in B as (_ & B2 & B3).
  split; [|split].
  - intros T I. split.
    + intros K U p q J E. destruct (classic (evenly l p q)) as [|N]; auto. exfalso.
      assert (D : In U l /\ forall r, In r (corners_of U) -> ~ gone r m).
      { clear E. induction J as [|U W r J IH IW Hr Hr'].
        - split; auto. intros r R G. assert (Z : gone (za T) m) by (apply (A2 T r); auto using za_corner).
          apply mem_gone in Z. congruence.
        - split; auto. destruct IH as [IU IH]. intros r' R G. apply (IH r Hr), (A2 W r'); auto. }
      destruct D as [IU D]. apply (D p); [apply (edge_corners U p q E)|]. apply A1, uneven_ok. exists q. split; auto.
      apply in_flat_map. eauto.
    + intros K. destruct (Places.mem (za T) m) eqn:M; auto. apply mem_gone in M.
      destruct (A3 (fun r => exists U W p q, In W l /\ In r (corners_of W) /\ joined l W U /\ In (p, q) (edges U) /\
        ~ evenly l p q))
        with (T := T) (p := za T) as (U & W & p & q & IW & R & J & E & N); auto using za_corner.
      * intros p I'. apply uneven_ok in I' as (q & E & N). apply in_flat_map in E as (U & IU & E).
        exists U, U, p, q. repeat split; auto; [apply (edge_corners U p q E)|apply itself].
      * intros V p q IV P Q (U & W & p' & q' & IW & R & J & E). exists U, V, p', q'. split; auto. split; auto. split; auto.
        apply (joined_before l V W U p); auto.
      * exfalso. apply N, (K U p q); auto. apply (joined_before l T W U (za T)); auto using za_corner.
  - intros P Q St T p I J. apply (B3 P Q St T p I J). rewrite forallb_forall in C. specialize (C T I).
    apply negb_true_iff, mem_gone in C. apply (B2 T (za T)); auto using za_corner.
  - intros p H. rewrite PF.mem_find_b in H. destruct (Places.find p (by_place l)) as [k|] eqn:F; [|discriminate].
    assert (K : k <> []).
    { intros ->. clear - F. revert F. induction l as [|T l IH]; [discriminate|]. cbn [by_place fold_right]. fold (by_place l).
      generalize (corners_of T). induction l0 as [|q ps IHp]; [exact IH|]. cbn [fold_right]. rewrite PF.add_o.
      destruct (Place.eq_dec q p); [discriminate|exact IHp]. }
    destruct k as [|T k]; [contradiction|]. exists T. apply by_place_ok. unfold found_at. rewrite F. left. reflexivity.
Qed.

Definition tri_dec (T U : ztri) : {T = U} + {T <> U}.
Proof. decide equality; apply zv_dec. Defined.
Lemma part_exists l : exists c, closed_part l c.
Proof.
  assert (H : forall k, exists keep : ztri -> bool, forall T, In T k -> (keep T = true <-> closed l T)).
  { induction k as [|U k (keep & IH)]; [exists (fun _ => true); intros T []|].
    assert (K : exists b : bool, b = true <-> closed l U) by (destruct (classic (closed l U)); [exists true|exists false];
      intuition congruence).
    destruct K as (b & K). exists (fun T => if tri_dec T U then b else keep T). intros T I.
    destruct (tri_dec T U) as [->|N]; [exact K|]. apply IH. destruct I as [<-|I]; [contradiction|exact I]. }
  destruct (H l) as (keep & K). exists (filter keep l), keep. auto.
Qed.
Lemma part_one l c c' : closed_part l c -> closed_part l c' -> c = c'.
Proof.
  intros (keep & -> & H) (keep' & -> & H'). apply filter_ext_in. intros T I. specialize (H T I). specialize (H' T I).
  destruct (keep T), (keep' T); intuition congruence.
Qed.
Lemma count_filter keep l e : (forall T, In T l -> In e (edges T) -> keep T = true) ->
  count_occ edge_dec (flat_map edges (filter keep l)) e = count_occ edge_dec (flat_map edges l) e.
Proof.
  induction l as [|T l IH]; intros H; [reflexivity|]. cbn [filter flat_map]. rewrite count_occ_app, <- IH by (intros; apply H;
    simpl; auto).
  destruct (keep T) eqn:K; [cbn [flat_map]; apply count_occ_app|].
  rewrite (proj1 (count_occ_not_In edge_dec (edges T) e)); [reflexivity|]. intros I. rewrite H in K by (simpl; auto). discriminate.
Qed.
Lemma part_balanced l c : closed_part l c -> balanced c.
Proof.
  intros (keep & -> & H) p q. unfold evenly.
  destruct (classic (exists T, In T l /\ keep T = true /\ In p (corners_of T))) as [(T & I & K & P)|N].
  - assert (C : forall U, In U l -> In p (corners_of U) -> keep U = true).
    { intros U IU Q. apply H; auto. apply H in K; auto. intros W r r' J. apply K.
      apply (joined_before l T U W p); auto. }
    assert (D : forall r U, In r [(p, q); (q, p)] -> In U l -> In r (edges U) -> keep U = true).
    { intros r U R IU E. apply C; auto. destruct R as [<-|[<-|[]]]; apply edge_corners in E; tauto. }
    rewrite !count_filter by (intros; eapply D; eauto; simpl; auto).
    destruct (in_dec edge_dec (p, q) (flat_map edges l)) as [E|E].
    + apply in_flat_map in E as (U & IU & E). apply (proj1 (H U IU) (D (p, q) U (or_introl eq_refl) IU E) U p q (itself l U) E).
    + destruct (in_dec edge_dec (q, p) (flat_map edges l)) as [F|F].
      * apply in_flat_map in F as (U & IU & F). symmetry.
        apply (proj1 (H U IU) (D (q, p) U (or_intror (or_introl eq_refl)) IU F) U q p (itself l U) F).
      * rewrite !(proj1 (count_occ_not_In _ _ _)); auto.
  - rewrite !(proj1 (count_occ_not_In _ _ _)); auto; intros E; apply in_flat_map in E as (U & IU & E);
    apply filter_In in IU as [IU K];
      apply N; exists U; apply edge_corners in E; tauto.
Qed.
Lemma part_in l c T : closed_part l c -> In T c -> In T l.
Proof. intros (keep & -> & _) I. apply filter_In in I. tauto. Qed.

(* ---- windings as another frame has them; crossings have one number *)
Lemma winding_placed m t y l : well_formed m -> 0 < scale m -> winding (place m t y) (map (placed m t) l) = winding y l.
Proof.
  intros W S. unfold winding. induction l as [|T l IH]; [reflexivity|]. cbn [map fold_right]. f_equal; [|exact IH].
  pose proof (attitude_unit m W t) as Q. set (q := attitude m t) in *. set (s := scale m) in *.
  assert (E : forall p, vsub (place m t p) (place m t y) = vscale s (turned q (vsub p y))).
  { intros p. rewrite !place_turned by exact W. fold q s. rewrite <- turned_vsub. apply V_eq; unfold vsub, vscale, vadd; simpl;
    ring. }
  assert (N : forall v, norm (vscale s (turned q v)) = s * norm v) by (intros; rewrite norm_vscale, turned_norm, Q by lra; ring).
  assert (D : forall v w, dot (turned q v) (turned q w) = dot v w).
  { intros v w. transitivity (qdot q q * qdot q q * dot v w); [unfold dot, turned, qdot; simpl; ring|rewrite Q; ring]. }
  assert (D' : forall v w, dot (vscale s (turned q v)) (vscale s (turned q w)) = s * s * dot v w).
  { intros v w. rewrite <- (D v w). unfold dot, vscale; simpl; ring. }
  assert (X : forall u v w, det (vscale s (turned q u)) (vscale s (turned q v)) (vscale s (turned q w)) = s * s * s * det u v w).
  { intros u v w. unfold det. rewrite <- (D u (cross v w)).
    replace (turned q (cross v w)) with (cross (turned q v) (turned q w))
      by (rewrite turned_cross, Q; apply V_eq; unfold vscale; simpl; ring).
    unfold dot, cross, vscale; simpl; ring. }
  unfold wound_by. cbn [c0 c1 c2 placed]. rewrite !E, !N, !D', X.
  set (u := vsub (c0 T) y). set (v := vsub (c1 T) y). set (w := vsub (c2 T) y). set (z := det u v w).
  set (d := norm u * norm v * norm w + dot u v * norm w + dot v w * norm u + dot w u * norm v).
  set (k := s * s * s). assert (K : 0 < k) by (unfold k; repeat apply Rmult_lt_0_compat; auto).
  replace (s * norm u * (s * norm v) * (s * norm w) + s * s * dot u v * (s * norm w) + s * s * dot v w * (s * norm u) +
    s * s * dot w u * (s * norm v)) with (k * d) by (unfold k, d; ring).
  replace (k * d * (k * d) + k * z * (k * z)) with (k * k * (d * d + z * z)) by ring.
  rewrite sqrt_mult_alt by nra. rewrite sqrt_square by lra. f_equal. f_equal.
  replace (k * d + k * sqrt (d * d + z * z)) with (k * (d + sqrt (d * d + z * z))) by ring.
  unfold Rdiv. rewrite Rinv_mult. transitivity (k * / k * (z * / (d + sqrt (d * d + z * z)))); [ring|rewrite Rinv_r by lra; ring].
Qed.

Lemma crosses_one d x T j k : crosses d x T j -> crosses d x T k -> j = k.
Proof.
  intros J K.
  assert (E : forall u v w m, det u v w * dot m d = det d v w * dot m u + det d w u * dot m v + det d u v * dot m w)
    by (intros; unfold det, dot, cross; cbn [vx vy vz]; ring).
  specialize (E (vsub (c0 T) x) (vsub (c1 T) x) (vsub (c2 T) x)).
  destruct J as [m A B C D|J|J|J|J], K as [m' A' B' C' D'|K|K|K|K]; auto; cbv zeta in *; exfalso;
    try (specialize (E m)); try (specialize (E m')); revert E; generalize dependent (det (vsub (c0 T) x) (vsub (c1 T) x) (vsub (c2
      T) x));
    intros; nra.
Qed.

(* ---- what is never touched is never wound about later on, if not at first *)
Lemma of_way x y T u : of_tri x T -> of_tri y T -> 0 <= u <= 1 -> of_tri (vadd (vscale (1 - u) x) (vscale u y)) T.
Proof.
  intros (a & b & c & A & B & C & S & ->) (a' & b' & c' & A' & B' & C' & S' & ->) U.
  exists ((1 - u) * a + u * a'), ((1 - u) * b + u * b'), ((1 - u) * c + u * c').
  split; [nra|split; [nra|split; [nra|split]]].
  - transitivity ((1 - u) * (a + b + c) + u * (a' + b' + c')); [ring|rewrite S, S'; ring].
  - apply V_eq; unfold mix, vadd, vscale; simpl; ring.
Qed.
Lemma of_corner d T p : In p (corners_of T) -> of_tri (pointR d p) (triR d T).
Proof.
  intros [<-|[<-|[<-|[]]]]; [exists 1, 0, 0|exists 0, 1, 0|exists 0, 0, 1]; (split; [lra|split; [lra|split; [lra|split; [lra|]]]]);
    apply V_eq; unfold mix, vadd, vscale; simpl; ring.
Qed.

Lemma steady_now b c y : rigid b -> steady c -> (forall u, 0 <= c u <= 1) -> steadyV (fun u => place (now b (c u)) (c u) y).
Proof.
  intros R C In01. pose proof R as ((Cv & _) & F).
  set (g := fun m u => vadd (vscale (scale (pieceR (size b) m)) (turned (attitude (pieceR (size b) m) (c u)) y)) (origin (pieceR
    (size b) m) (c u))).
  assert (Open : forall m u, ~ during m (c u) -> locally u (fun v => ~ during m (c v))).
  { intros m u N. apply (outside_open _ _ _ _ C N). }
  assert (Some_ : forall u, exists m, In m (pieces b) /\ during m (c u)) by (intros u; apply (Cv _ (In01 u))).
  assert (Same : forall m u, In m (pieces b) -> during m (c u) -> place (now b (c u)) (c u) y = g m u).
  { intros m u I D. rewrite (now_is b m) by auto. apply place_turned, F, I. }
  assert (Steady : forall m, In m (pieces b) -> steadyV (g m)) by (intros m I; apply steady_place; auto; apply steady_fixed).
  split; [|split]; [apply (paste (pieces b) (fun m u => during m (c u)) (fun m u => vx (g m u)))
    |apply (paste (pieces b) (fun m u => during m (c u)) (fun m u => vy (g m u)))
    |apply (paste (pieces b) (fun m u => during m (c u)) (fun m u => vz (g m u)))]; auto;
    try (intros i I; apply (Steady i I)); intros m u I O; rewrite (Same m u I O); reflexivity.
Qed.

Definition stands b t p := place (now b t) t (pointR (den b) p).
Lemma touches_now b t x c : rigid b -> 0 <= t <= 1 -> (forall T, In T c -> In T (tris b)) ->
  touches x (map (image (stands b t)) c) -> at_time b t x.
Proof.
  intros R T I (U & J & X). apply in_map_iff in J as (W & <- & J). apply now_points; auto.
  destruct X as (k & l & n & K & L & N & S & ->). exists W, (mix k l n (triR (den b) W)). split; [auto|split; [exists k, l, n;
    auto|]].
  symmetry. apply (place_mix (now b t) t (triR (den b) W)); auto.
Qed.
Lemma winds_now b t x : rigid b -> 0 <= t <= 1 -> forall c, closed_part (tris b) c ->
  winds b t x (winding x (map (image (stands b t)) c)).
Proof.
  intros R T c C. pose proof R as ((Cv & _) & _). destruct (piece_at_ok (pieces b) t (Cv t T)) as [I D].
  exists (piece_at (pieces b) t), c. auto.
Qed.
Lemma winds_is b t x n c : rigid b -> 0 <= t <= 1 -> closed_part (tris b) c -> winds b t x n ->
  n = winding x (map (image (stands b t)) c).
Proof.
  intros R T C (m & c' & I & D & C' & ->). rewrite (part_one _ _ _ C C'). f_equal. apply map_ext. intros U. unfold image, stands.
  rewrite !(now_is b m) by auto. reflexivity.
Qed.
(* `winds` is of one number *)
Theorem winds_once b t x : rigid b -> 0 <= t <= 1 -> exists n, forall k, winds b t x k <-> k = n.
Proof.
  intros R T. destruct (part_exists (tris b)) as (c & C). exists (winding x (map (image (stands b t)) c)). intros k.
  split; [apply winds_is; auto|intros ->; apply winds_now; auto].
Qed.

(* a way out of triangles is one out of closed components *)
Lemma free_winds b t x : rigid b -> 0 <= t <= 1 -> free_way b t x -> winds b t x 0.
Proof.
  intros R T (way & <- & X & Y & Z & N & Out). destruct (part_exists (tris b)) as (c & C).
  pose proof (winds_now b t (way 0) R T c C) as H. rewrite winding_free in H; auto; [apply (part_balanced _ _ C)|split; auto|].
  intros u U Q. apply (N u U), (touches_now b t _ c); auto. intros V. apply part_in, C.
Qed.

Section Stays.
Variables (a b : body) (c : list ztri).
Hypothesis Ra : rigid a.
Hypothesis Rb : rigid b.
Hypothesis Never : forall t x, 0 <= t <= 1 -> at_time a t x -> ~ at_time b t x.
Hypothesis Part : closed_part (tris b) c.
Let number t y := winding (place (now a t) t y) (map (image (stands b t)) c).

Lemma untouched t y T : 0 <= t <= 1 -> In T (tris a) -> of_tri y (triR (den a) T) ->
  ~ touches (place (now a t) t y) (map (image (stands b t)) c).
Proof.
  intros Rt I Y X. apply touches_now in X; auto; [|intros U; apply part_in, Part]. revert X. apply Never; auto. apply now_points;
    eauto.
Qed.
(* at one time: all over a triangle *)
Lemma over_triangle t T x y : 0 <= t <= 1 -> In T (tris a) -> of_tri x (triR (den a) T) -> of_tri y (triR (den a) T) ->
  number t x = number t y.
Proof.
  intros Rt I X Y. set (m := now a t). assert (W : well_formed m) by (apply now_formed; auto).
  set (way u := vadd (vscale (1 - u) x) (vscale u y)).
  set (z u := vadd (vscale (scale m) (turned (attitude m t) (way u))) (origin m t)).
  assert (E : forall u, z u = place m t (way u)) by (intros; symmetry; apply place_turned, W).
  assert (H : winding (z 0) (map (image (stands b t)) c) = winding (z 1) (map (image (stands b t)) c)).
  { apply (winding_steady (fun _ => stands b t) z); try lra.
    - apply (part_balanced _ _ Part).
    - intros p. apply steady_fixed.
    - apply (steady_place m (fun _ => t)); [steady|]. apply steady_vadd; apply steady_vscale; try apply steady_fixed; steady.
    - intros u U. rewrite E. apply (untouched t _ T); auto. apply of_way; auto. }
  rewrite !E in H. unfold number. fold m. replace x with (way 0); [replace y with (way 1)|]; auto;
    apply V_eq; unfold way, vadd, vscale; simpl; ring.
Qed.
(* at one point: all the time *)
Lemma over_time t T y : 0 <= t <= 1 -> In T (tris a) -> of_tri y (triR (den a) T) -> number t y = number 0 y.
Proof.
  intros Rt I Y. set (k u := clamped u * t).
  assert (K : forall u, 0 <= k u <= 1) by (intros u; unfold k; pose proof (clamped_range u); nra).
  assert (S : steady k) by (unfold k, clamped; steady).
  assert (H : number (k 0) y = number (k 1) y).
  { apply (winding_steady (fun u => stands b (k u)) (fun u => place (now a (k u)) (k u) y)); try lra.
    - apply (part_balanced _ _ Part).
    - intros p. apply steady_now; auto.
    - apply steady_now; auto.
    - intros u _. apply (untouched (k u) y T); auto. }
  assert (E : k 0 = 0 /\ k 1 = t) by (unfold k; rewrite clamped_0, (proj1 (past_1 1 (Rle_refl 1))); split; ring).
  destruct E as [E E']. rewrite E, E' in H. auto.
Qed.
Lemma never_winds f hint : surface_of (tris a) hint = Some f -> (forall p, In p (starts f) -> number 0 (pointR (den a) p) = 0) ->
  forall t x, 0 <= t <= 1 -> at_time a t x -> winds b t x 0.
Proof.
  intros F H t x T X. apply now_points in X as (U & y & I & Y & ->); auto.
  apply surface_ok in F as (_ & F & _). pose proof (winds_now b t (place (now a t) t y) Rb T c Part) as Q. fold (number t y) in Q.
  assert (Z0 : 0 <= 0 <= 1) by lra.
  assert (E : number t y = 0); [|rewrite E in Q; exact Q].
  rewrite (over_time t U y T I Y), (over_triangle 0 U y (pointR (den a) (za U)) Z0 I Y (of_corner _ _ _ (za_corner U))).
  apply (F (fun p => number 0 (pointR (den a) p) = 0)) with (T := U); [exact H| |exact I|apply za_corner].
  intros V p q IV Hp Hq E. transitivity (number 0 (pointR (den a) p)); [|exact E].
  apply (over_triangle 0 V); [exact Z0|exact IV|apply of_corner, Hq|apply of_corner, Hp].
Qed.
End Stays.
