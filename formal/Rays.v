(* Rays.v - an executable checker of what FREE and INSIDE certificates say of insides: rays, which count how often closed
   components wind about a point. Its numbers are intervals, as those of Meeting.v, of which it is the rest. *)
From Coq Require Import Reals Lra Psatz List ZArith QArith Qreals Bool Permutation.
From Interval Require Import Real.Xreal Float.Basic Interval.Interval.
From Svcd Require Export Closed.
Import ListNotations.
Local Open Scope R_scope.

Module Make (I : IntervalOps).
Include Meeting.Make I.
Section Rays.
Variable prec : I.precision.

(* ---- a ray, from y along d *)
Definition sign i : Z := match I.sign_strict i with Xgt => 1 | Xlt => -1 | _ => 0 end.
Lemma sign_ok i r : inI i r -> sign i = 0%Z \/ sign i = 1%Z /\ 0 < r \/ sign i = (-1)%Z /\ r < 0.
Proof.
  intros H. unfold sign. pose proof (I.sign_strict_correct i) as S. destruct (I.sign_strict i); auto; specialize (S _ H);
    simpl in S; tauto.
Qed.
(* the line misses a box, and then all triangles in it, if it misses it seen along an axis *)
Definition misses y d bx := let w := icross prec d (isub prec bx y) in
  negb ((sign (ix w) =? 0) && (sign (iy w) =? 0) && (sign (iz w) =? 0))%Z.
(* Sides are told along the triangle's own edges: how wide the interval of y is then counts for no more than an edge's length.
   With u, v, w in their place a triangle much smaller than far would be told less well than the C tells it *)
Definition crossing y d T : option Z :=
  let u := isub prec (ia T) y in let v := isub prec (ib T) y in let w := isub prec (ic T) y in
  if ((sign (idot prec d u) =? -1) && (sign (idot prec d v) =? -1) && (sign (idot prec d w) =? -1))%Z then Some 0%Z else
  let uv := isub prec (ib T) (ia T) in let vw := isub prec (ic T) (ib T) in let wu := isub prec (ia T) (ic T) in
  let i := sign (idet prec d u uv) in let j := sign (idet prec d v vw) in let k := sign (idet prec d w wu) in
  if ((i * j =? -1) || (j * k =? -1) || (k * i =? -1))%Z then Some 0%Z else
  if (i * j * k =? 0)%Z then None else
  let vol := sign (idet prec u uv vw) in if (vol =? 0)%Z then None else Some (if (vol =? i)%Z then i else 0%Z).
Lemma same_sign i a b c : (sign i =? 0)%Z = false -> inI i a -> inI i b -> inI i c -> 0 < a /\ 0 < b /\ 0 < c \/ a < 0 /\
  b < 0 /\ c < 0.
Proof.
  intros N A B C. apply Z.eqb_neq in N. apply sign_ok in A, B, C.
  destruct A as [|[[S L]|[S L]]]; [contradiction|left|right]; rewrite S in B, C; intuition discriminate.
Qed.
Lemma aside_either d x T m : dot m d = 0 -> (let f p := dot m (vsub p x) in
  0 < f (c0 T) /\ 0 < f (c1 T) /\ 0 < f (c2 T) \/ f (c0 T) < 0 /\ f (c1 T) < 0 /\ f (c2 T) < 0) -> crosses d x T 0.
Proof.
  cbv zeta. assert (E : forall v, dot (vscale (-1) m) v = - dot m v) by (intros; unfold dot, vscale; cbn [vx vy vz]; ring).
  intros Z0 [(A & B & C)|(A & B & C)]; [apply (Winding.aside d x T m)|apply (Winding.aside d x T (vscale (-1) m))]; rewrite ?E; lra.
Qed.
Lemma misses_ok y d bx yR dR T : inV y yR -> inV d dR -> inV bx (c0 T) -> inV bx (c1 T) -> inV bx (c2 T) ->
  misses y d bx = true -> crosses dR yR T 0.
Proof.
  intros Y D A B C H. unfold misses in H. apply negb_true_iff in H. rewrite !andb_false_iff in H.
  assert (K : forall p, inV bx p -> inV (icross prec d (isub prec bx y)) (cross dR (vsub p yR))) by (intros; apply in_cross; auto;
    apply in_vsub; auto).
  destruct (K _ A) as (A1 & A2 & A3), (K _ B) as (B1 & B2 & B3), (K _ C) as (C1 & C2 & C3). clear K.
  destruct H as [[H|H]|H]; [apply (aside_either _ _ _ (mkV 0 (- vz dR) (vy dR)))|apply (aside_either _ _ _ (mkV (vz dR) 0 (- vx
    dR)))
    |apply (aside_either _ _ _ (mkV (- vy dR) (vx dR) 0))]; try (unfold dot; cbn [vx vy vz]; ring); cbv zeta;
    assert (E : forall a b c a' b' c', a = a' -> b = b' -> c = c' -> 0 < a /\ 0 < b /\ 0 < c \/ a < 0 /\ b < 0 /\ c < 0 ->
      0 < a' /\ 0 < b' /\ 0 < c' \/ a' < 0 /\ b' < 0 /\ c' < 0) by (intros; subst; auto);
    [eapply E; [| | |apply (same_sign _ _ _ _ H A1 B1 C1)]|eapply E; [| | |apply (same_sign _ _ _ _ H A2 B2 C2)]
    |eapply E; [| | |apply (same_sign _ _ _ _ H A3 B3 C3)]]; unfold dot, cross; cbn [vx vy vz]; ring.
Qed.
Lemma crossing_ok y d T yR dR TR k : inV y yR -> inV d dR -> inT T TR -> crossing y d T = Some k -> crosses dR yR TR k.
Proof.
  intros Y D (A & B & C). unfold crossing. cbv zeta.
  pose proof (in_vsub prec _ _ _ _ A Y) as U. pose proof (in_vsub prec _ _ _ _ B Y) as V.
    pose proof (in_vsub prec _ _ _ _ C Y) as W.
  assert (Det : forall a b c aR bR cR, inV a aR -> inV b bR -> inV c cR -> inI (idet prec a b c) (det aR bR cR))
    by (intros; apply in_dot; auto; apply in_cross; auto).
  pose proof (sign_ok _ _ (in_dot prec _ _ _ _ D U)) as Su. pose proof (sign_ok _ _ (in_dot prec _ _ _ _ D V)) as Sv.
  pose proof (sign_ok _ _ (in_dot prec _ _ _ _ D W)) as Sw.
  destruct (_ && _)%bool eqn:E.
  { rewrite !andb_true_iff, !Z.eqb_eq in E. intros H. injection H as <-. apply (Winding.aside _ _ _ (vscale (-1) dR)).
    - pose proof (dot_pos dR). unfold dot, vscale in *; cbn [vx vy vz] in *; lra.
    - unfold dot, vscale in *; cbn [vx vy vz] in *; intuition lia || lra.
    - unfold dot, vscale in *; cbn [vx vy vz] in *; intuition lia || lra.
    - unfold dot, vscale in *; cbn [vx vy vz] in *; intuition lia || lra. }
  pose proof (in_vsub prec _ _ _ _ B A) as UV. pose proof (in_vsub prec _ _ _ _ C B) as VW.
  pose proof (in_vsub prec _ _ _ _ A C) as WU.
  pose proof (sign_ok _ _ (Det _ _ _ _ _ _ D U UV)) as Si. pose proof (sign_ok _ _ (Det _ _ _ _ _ _ D V VW)) as Sj.
  pose proof (sign_ok _ _ (Det _ _ _ _ _ _ D W WU)) as Sk. pose proof (sign_ok _ _ (Det _ _ _ _ _ _ U UV VW)) as Sl.
  assert (Along : forall p q r, det r (vsub p yR) (vsub q p) = det r (vsub p yR) (vsub q yR) /\
      det (vsub p yR) (vsub q p) (vsub r q) = det (vsub p yR) (vsub q yR) (vsub r yR))
    by (intros; split; unfold det, dot, cross, vsub; cbn [vx vy vz]; ring).
  rewrite (proj1 (Along _ _ _)) in Si. rewrite (proj1 (Along _ _ _)) in Sj. rewrite (proj1 (Along _ _ _)) in Sk.
  rewrite (proj2 (Along _ _ _)) in Sl.
  destruct Si as [Si|[[Si Li]|[Si Li]]], Sj as [Sj|[[Sj Lj]|[Sj Lj]]], Sk as [Sk|[[Sk Lk]|[Sk Lk]]], Sl as [Sl|[[Sl Ll]|[Sl Ll]]];
    rewrite Si, Sj, Sk, Sl; simpl; intros H; try discriminate; injection H as <-;
    solve [apply beside; cbv zeta; nra | apply behind; cbv zeta; nra | apply up; auto | apply down; auto].
Qed.

(* ---- all triangles of a tree. Those that are kept count *)
Section Cast.
Variables (keep : ztri -> bool) (den_ : positive) (y d : IV).
Definition add_crossing T sum := match sum with None => None | Some n =>
  match crossing y d (mkIT (ipoint prec den_ (za T)) (ipoint prec den_ (zb T)) (ipoint prec den_ (zc T))) with
  | None => None | Some k => Some ((if keep T then k else 0) + n)%Z end end.
Fixpoint cast (t : tree) : option Z := if misses y d (box prec (root t)) then Some 0%Z else match t with
  | Leaf n => fold_right add_crossing (Some 0%Z) (of_tris n)
  | Fork _ a b => match cast a with None => None | Some n => match cast b with None => None | Some k => Some (n + k)%Z end end end.

Variables (yR dR : V).
Hypothesis Y : inV y yR.
Hypothesis D : inV d dR.
Inductive counted : list ztri -> Z -> Prop :=
  | counted_none : counted [] 0
  | counted_one T l k n : crosses dR yR (triR den_ T) k -> counted l n -> counted (T :: l) ((if keep T then k else 0) + n).
Lemma counted_app l l' n n' : counted l n -> counted l' n' -> counted (l ++ l') (n + n').
Proof. induction 1; intros; simpl; auto. rewrite <- Z.add_assoc. apply counted_one; auto. Qed.
Lemma counted_permuted l l' : Permutation l l' -> forall n, counted l n -> counted l' n.
Proof.
  induction 1 as [|T l l' P IH|T U l|l l' l'' P IH P' IH']; intros n H; auto.
  - inversion H; subst. apply counted_one; auto.
  - inversion H as [|? ? ? ? ? H']; subst. inversion H'; subst. rewrite Z.add_shuffle3. repeat apply counted_one; auto.
Qed.
Lemma counted_all l n : counted l n -> exists count : ztri -> Z,
  (forall T, In T l -> crosses dR yR (triR den_ T) (count T)) /\ n = fold_right (fun T n => count T + n)%Z 0%Z (filter keep l).
Proof.
  induction 1 as [|T l k n C H (count & A & ->)]; [exists (fun _ => 0%Z); split; [intros T []|reflexivity]|].
  exists (fun U => if tri_dec T U then k else count U). split.
  - intros U I. destruct (tri_dec T U) as [<-|N]; [exact C|]. apply A. destruct I; [contradiction|auto].
  - assert (S : fold_right (fun U n => (if tri_dec T U then k else count U) + n)%Z 0%Z (filter keep l) =
        fold_right (fun U n => count U + n)%Z 0%Z (filter keep l)).
    { clear H. induction l as [|U l IH]; [reflexivity|]. cbn [filter].
      assert (A' : forall V, In V l -> crosses dR yR (triR den_ V) (count V)) by (intros; apply A; right; auto).
      destruct (keep U); cbn [fold_right]; rewrite IH by exact A'; auto.
      destruct (tri_dec T U) as [<-|]; auto. rewrite (crosses_one _ _ _ _ _ C (A T (or_introl eq_refl))). reflexivity. }
    cbn [filter]. destruct (keep T); cbn [fold_right]; rewrite S; auto. destruct (tri_dec T T); [reflexivity|contradiction].
Qed.

Lemma in_box_corners scale l T : In T l -> inV (box prec (node_of den_ scale l)) (c0 (triR den_ T)) /\
  inV (box prec (node_of den_ scale l)) (c1 (triR den_ T)) /\ inV (box prec (node_of den_ scale l)) (c2 (triR den_ T)).
Proof.
  intros I. split; [|split]; apply in_box; exists T; (split; [exact I|]);
    [apply (of_corner den_ T (za T))|apply (of_corner den_ T (zb T))
    |apply (of_corner den_ T (zc T))]; simpl; auto.
Qed.
Lemma cut_permuted l : Permutation (map snd (fst (cut l)) ++ map snd (snd (cut l))) (map snd l).
Proof.
  unfold cut. match goal with |- context [Sorted.sort ?v] => set (w := v) end. cbn [fst snd]. rewrite <- map_app, firstn_skipn,
    map_map.
  assert (E : map (fun e : Keyed.t => snd (let '(_, i, T) := e in (i, T))) w = map snd l)
    by (unfold w; destruct (_ >? _)%Z; destruct (_ >? _)%Z; unfold keyed; rewrite map_map; apply map_ext; intros [i T];
      reflexivity).
  rewrite <- E. apply Permutation_map, Permutation_sym, Sorted.Permuted_sort.
Qed.
Lemma counted_missed scale l : misses y d (box prec (node_of den_ scale l)) = true -> counted l 0.
Proof.
  intros M. assert (H : forall k, incl k l -> counted k 0).
  { induction k as [|T k IH]; intros I; [apply counted_none|].
    replace 0%Z with ((if keep T then 0 else 0) + 0)%Z by (destruct (keep T); reflexivity).
    apply counted_one; [|apply IH; intros U J; apply I; right; exact J].
    destruct (in_box_corners scale l T) as (A & B & C); [apply I; left; reflexivity|]. apply (misses_ok _ _ _ _ _ _ Y D A B C M). }
  apply H, incl_refl.
Qed.
Lemma counted_leaf l n : fold_right add_crossing (Some 0%Z) l = Some n -> counted l n.
Proof.
  revert n. induction l as [|T l IH]; simpl; intros n H; [injection H as <-; apply counted_none|].
  unfold add_crossing in H at 1. destruct (fold_right add_crossing _ l) as [n'|]; [|discriminate].
  destruct (crossing _ _ _) as [k|] eqn:C; [|discriminate]. injection H as <-. apply counted_one; auto.
  eapply crossing_ok; eauto. split; [|split]; apply in_point.
Qed.
Lemma cast_ok fuel scale : forall l n, cast (build fuel den_ scale l) = Some n -> counted (map snd l) n.
Proof.
  assert (Leaves : forall (l : list (Z * ztri)) n, cast (Leaf (node_of den_ scale (map snd l))) = Some n -> counted (map snd l) n).
  { intros l n. cbn [cast root]. destruct (misses _ _ _) eqn:M; [|apply counted_leaf]. intros H. injection H as <-.
    eapply counted_missed, M. }
  induction fuel as [|fuel IH]; intros l n H; [apply Leaves; destruct l as [|? [|? ?]]; exact H|].
  destruct l as [|p [|q l]]; try (apply Leaves; exact H). cbn [build] in H. pose proof (cut_permuted (p :: q :: l)) as C.
  destruct (cut (p :: q :: l)) as [a b]. cbn [fst snd] in C. cbn [cast root] in H. destruct (misses _ _ _) eqn:M.
  - injection H as <-. eapply counted_missed, M.
  - destruct (cast (build fuel den_ scale a)) as [i|] eqn:A; [|discriminate].
    destruct (cast (build fuel den_ scale b)) as [j|] eqn:B; [|discriminate]. injection H as <-.
    apply (counted_permuted _ _ C), counted_app; auto.
Qed.
End Cast.

(* ---- a corner of one body as another sees it, and how often that one's closed components wind about it *)
Definition iseen sz ip x := iscale prec (I.div prec (I.fromZ prec 1) (I.sqr prec (iQ prec sz))) (way prec (isub prec x (org ip))
  ip).
Lemma in_seen sz ip qm t x xR : let m := pieceR sz qm in well_formed m -> 0 < Q2R sz -> inPose ip m t -> inV x xR ->
  inV (iseen sz ip x) (seen m t xR).
Proof.
  intros m W S (A & B & C & HA & HB & HC & O & E) X. set (v := vsub xR (origin m t)).
  assert (L : inV (way prec (isub prec x (org ip)) ip) (vadd (vadd (vscale (vx v) A) (vscale (vy v) B)) (vscale (vz v) C))).
  { destruct (in_vsub prec _ _ _ _ X O) as (Vx & Vy & Vz). repeat apply in_vadd; apply in_vscale; auto. }
  assert (K : inI (I.div prec (I.fromZ prec 1) (I.sqr prec (iQ prec sz))) (1 / (Q2R sz * Q2R sz)))
    by (apply in_div; [apply in_Z|apply in_sqr, in_Q]).
  pose proof (in_vscale prec _ _ _ _ K L) as H. unfold iseen.
  assert (Rows : forall y, mkV (dot A y) (dot B y) (dot C y) = vscale (Q2R sz) (turned (attitude m t) y)).
  { intros y. pose proof (E y) as F. rewrite place_turned in F by exact W. change (scale m) with (Q2R sz) in F.
    pose proof (f_equal vx F) as F1. pose proof (f_equal vy F) as F2. pose proof (f_equal vz F) as F3.
    unfold vadd in F1, F2, F3. cbn [vx vy vz] in *. apply V_eq; cbn [vx vy vz]; lra. }
  replace (seen m t xR) with (vscale (1 / (Q2R sz * Q2R sz)) (vadd (vadd (vscale (vx v) A) (vscale (vy v) B)) (vscale (vz v) C)));
    [exact H|].
  unfold seen. change (scale m) with (Q2R sz). fold v. set (q := attitude m t) in *.
  pose proof (Rows (mkV 1 0 0)) as X1. pose proof (Rows (mkV 0 1 0)) as X2. pose proof (Rows (mkV 0 0 1)) as X3. clear - S X1 X2 X3.
  destruct A as [a1 a2 a3], B as [b1 b2 b3], C as [d1 d2 d3].
  assert (Dot : forall k l n x y z, dot (mkV k l n) (mkV x y z) = k * x + l * y + n * z) by reflexivity. rewrite !Dot in X1, X2, X3.
  rewrite !Rmult_1_r, !Rmult_0_r, !Rplus_0_l in X3. rewrite !Rmult_1_r, !Rmult_0_r, !Rplus_0_r, !Rplus_0_l in X2.
  rewrite !Rmult_1_r, !Rmult_0_r, !Rplus_0_r in X1. injection X1 as -> -> ->. injection X2 as -> -> ->. injection X3 as -> -> ->.
  apply V_eq; unfold vadd, vscale, turned, conj; cbn [vx vy vz qx qy qz qw]; field; lra.
Qed.

Definition pose_of b t := match find (during t) (pieces b) with
  | Some m => Some (ipose_at prec (size b) (make_ready prec m) t) | None => None end.
Definition rays_end (of by_ : body) t p := match pose_of of t, pose_of by_ t with
  | Some i, Some j => Some (iseen (size by_) j (iplace prec i (ipoint prec (den of) p))) | _, _ => None end.
Definition shot of by_ keep tree t n p := match rays_end of by_ t p with
  | Some y => if ((zx n =? 0) && (zy n =? 0) && (zz n =? 0))%Z then None else cast keep (den by_) y (inormal prec n) tree
  | None => None end.

Lemma normal_pos n : ((zx n =? 0) && (zy n =? 0) && (zz n =? 0))%Z = false -> 0 < norm (normalR n).
Proof.
  intros N. destruct (norm_pos (normalR n)) as [|E]; auto. exfalso. symmetry in E. unfold norm in E.
  apply sqrt_eq_0 in E; [|apply dot_pos]. unfold dot, normalR in E. cbn [vx vy vz] in E.
  assert (P : forall z, 0 <= IZR z * IZR z) by (intros; apply Rle_0_sqr).
  assert (Z : forall z, IZR z * IZR z = 0 -> (z =? 0)%Z = true).
  { intros z Q. apply Z.eqb_eq, eq_IZR. apply Rmult_integral in Q. tauto. }
  pose proof (P (zx n)). pose proof (P (zy n)). pose proof (P (zz n)).
  rewrite (Z (zx n)), (Z (zy n)), (Z (zz n)) in N by lra. discriminate.
Qed.
Lemma pose_of_ok b t i : sound_body b = true -> pose_of b t = Some i -> exists m, In m (pieces b) /\
  Q2R (t_from m) <= Q2R t <= Q2R (t_to m) /\ inPose i (pieceR (size b) m) (Q2R t) /\ well_formed (pieceR (size b) m).
Proof.
  unfold sound_body. rewrite !andb_true_iff, forallb_forall. intros ((S & M) & _). unfold pose_of.
  destruct (find _ _) as [m|] eqn:F; [|discriminate]. apply find_some in F as [F D]. intros H. injection H as <-.
  exists m. apply andb_true_iff in D as [D D']. apply Qle_bool_iff, Qle_Rle in D, D'.
  split; [exact F|split; [auto|split; [apply in_pose; auto|]]]. apply (sound_R (size b) m S (M m F)).
Qed.
(* what it is made with is kept out of sight: Coq would count it down *)
Lemma tree_is b : exists fuel, tree_of b = build fuel (den b) (size b) (number 0 (tris b)).
Proof. exists 64%nat. reflexivity. Qed.
Lemma cast_winds by_ hint f t n b k y x : surface_of (tris by_) hint = Some f -> let m := pieceR (size by_) b in
  well_formed m -> 0 < scale m -> 0 < norm (normalR n) -> inV y (seen m t x) ->
    cast (kept f) (den by_) y (inormal prec n) (tree_of by_) = Some k ->
  (forall T, In T (tris by_) -> ~ of_tri (seen m t x) (triR (den by_) T)) /\
  winding x (map (fun T => placed m t (triR (den by_) T)) (filter (kept f) (tris by_))) = IZR k.
Proof.
  intros F m W S N Y H. destruct (tree_is by_) as (fuel & E0). rewrite E0 in H.
  apply (cast_ok (kept f) (den by_) y (inormal prec n) (seen m t x) (normalR n) Y (in_normal prec n)) in H.
  rewrite number_snd in H. apply counted_all in H as (count & C & ->).
  split; [intros T J; apply (crosses_off _ _ _ _ (C T J))|].
  assert (Part : closed_part (tris by_) (filter (kept f) (tris by_))) by (exists (kept f); split;
    [reflexivity|apply (surface_ok _ _ _ F)]).
  assert (E : winding (place m t (seen m t x)) (map (placed m t) (map (triR (den by_)) (filter (kept f) (tris by_)))) =
    winding (seen m t x) (map (triR (den by_)) (filter (kept f) (tris by_)))) by (apply winding_placed; assumption).
  rewrite map_map, place_seen in E by (try apply Rgt_not_eq; assumption). rewrite E.
  apply (winding_ray (pointR (den by_)) (filter (kept f) (tris by_)) (seen m t x) (normalR n) count);
    [apply (part_balanced _ _ Part)|exact N|]. intros T J. apply C. apply filter_In in J as [J _]. exact J.
Qed.
Lemma shot_ok of by_ hint f t n p k : sound_body of = true -> sound_body by_ = true -> 0 < Q2R (size by_) ->
  surface_of (tris by_) hint = Some f -> shot of by_ (kept f) (tree_of by_) t n p = Some k ->
  exists m, In m (pieces of) /\ Q2R (t_from m) <= Q2R t <= Q2R (t_to m) /\
    ~ at_time by_ (Q2R t) (place (pieceR (size of) m) (Q2R t) (pointR (den of) p)) /\
    winds by_ (Q2R t) (place (pieceR (size of) m) (Q2R t) (pointR (den of) p)) (IZR k).
Proof.
  intros So Sb Z0 F. unfold shot, rays_end. destruct (pose_of of t) as [i|] eqn:Pi; [|discriminate].
  destruct (pose_of by_ t) as [j|] eqn:Pj; [|discriminate]. destruct (_ && _)%bool eqn:N; [discriminate|]. intros H.
  apply pose_of_ok in Pi as (m & Im & Dm & Pm & Wm); auto. apply pose_of_ok in Pj as (b & Ib & Db & Pb & Wb); auto.
  exists m. split; [exact Im|split; [exact Dm|]].
  assert (X : inV (iplace prec i (ipoint prec (den of) p)) (place (pieceR (size of) m) (Q2R t) (pointR (den of) p))) by (apply
    in_place; auto; apply in_point).
  pose proof (in_seen (size by_) j b (Q2R t) _ _ Wb Z0 Pb X) as Y.
  destruct (cast_winds by_ hint f (Q2R t) n b k _ _ F Wb Z0 (normal_pos n N) Y H) as [Off E]. split.
  { intros (b' & T & y & Ib' & Db' & IT & IY & EX). apply (Off T IT). rewrite EX.
    rewrite (proj2 (sound_body_moves _ Sb) b' b (Q2R t) y Ib' Ib Db' Db), seen_place; auto. apply Rgt_not_eq, Z0. }
  exists b, (filter (kept f) (tris by_)).
  split; [exact Ib|split; [exact Db|split; [exists (kept f); split; [reflexivity|apply (surface_ok _ _ _ F)]|]]].
  symmetry. exact E.
Qed.

(* ---- FREE: rays behind the walk, from each body's components *)
Fixpoint rays (shoot : zv -> zv -> option Z) (from : list zv) (l : list bool) (ns : list zv) : answer (list bool * list zv) :=
  match from with
  | [] => Yes (l, ns)
  | p :: from =>
    match match l with [] => None | true :: l => Some (ns, l) | false :: l => read_normal ns l end with
    | None => No EndsEarly []
    | Some (ns, l) => match shoot (List.hd (mkZ 0 0 0) ns) p with
      | None => No TooNear l
      | Some k => if (k =? 0)%Z then rays shoot from l ns else No NotOutside l end end end.
Lemma rays_ok shoot from : forall l ns out, rays shoot from l ns = Yes out -> forall p, In p from -> exists n, shoot n p = Some 0%Z.
Proof.
  induction from as [|q from IH]; intros l ns out H p I; [destruct I|]. cbn [rays] in H.
  destruct (match l with [] => None | true :: l => Some (ns, l) | false :: l => read_normal ns l end) as [[ns' l']|];
    [|discriminate].
  destruct (shoot _ q) as [k|] eqn:E; [|discriminate]. destruct (k =? 0)%Z eqn:K; [|discriminate]. apply Z.eqb_eq in K.
  destruct I as [<-|I]; [subst k; eauto|eauto].
Qed.

(* trees and surfaces are made once for a mesh; fa, fb: None, if a hint is of no use *)
Definition free_of (s : scene) (ta tb : tree) (fa fb : option surface) (bytes : list Z) : answer unit :=
  let a := body_a s in let b := body_b s in
  match check_trees prec s ta tb bytes with
  | No why rest => No why rest
  | Yes (_, _, true) => Yes tt
  | Yes (rest, ns, false) => match fa, fb with
    | Some fa, Some fb => if negb (Qlt_bool 0 (size a) && Qlt_bool 0 (size b)) then No Unfit rest else
      match rays (shot a b (kept fb) tb 0) (starts fa) rest ns with
      | No why rest => No why rest
      | Yes (rest, ns) => match rays (shot b a (kept fa) ta 0) (starts fb) rest ns with
        | No why rest => No why rest
        | Yes (rest, _) => if (8 <=? length rest)%nat then No Follows rest else Yes tt end end
    | _, _ => No Unfit rest end end.
Definition frees (s : scene) (hint : list zv * list zv) bytes := match free_of s (tree_of (body_a s)) (tree_of (body_b s))
  (surface_of (tris (body_a s)) (fst hint)) (surface_of (tris (body_b s)) (snd hint)) bytes with Yes _ => true | No _ _ => false
    end.

Lemma rays_never a b hint f hint' f' from l ns out : sound_body a = true -> sound_body b = true -> rigid a -> rigid b ->
  0 < Q2R (size b) -> (forall t x, 0 <= t <= 1 -> at_time a t x -> ~ at_time b t x) ->
  surface_of (tris a) hint = Some f -> surface_of (tris b) hint' = Some f' -> from = starts f ->
  rays (shot a b (kept f') (tree_of b) 0) from l ns = Yes out -> forall t x, 0 <= t <= 1 -> at_time a t x -> winds b t x 0.
Proof.
  intros Sa Sb Ra Rb Z0 N F F' -> H. destruct (part_exists (tris b)) as (c & C).
  apply (never_winds a b c Ra Rb N C f hint F). intros p I. apply (rays_ok _ _ _ _ _ H) in I as (n & E).
  apply (shot_ok a b hint' f') in E as (m & Im & D & _ & W); auto. rewrite Q2R_0 in *.
  rewrite <- (now_is a m) in W by (auto; lra). symmetry. apply (winds_is b 0 _ 0 c); auto. lra.
Qed.

Theorem frees_sound : sound_free frees.
Proof.
  intros s [ha hb] bytes H. unfold frees, free_of in H. cbn [fst snd] in H.
  destruct (check_trees _ _ _ _ _) as [[[rest ns] ap]|] eqn:E; [|discriminate].
  assert (A : accepts prec s bytes = Some ap) by (unfold accepts, check; rewrite E; reflexivity).
  destruct (accepts_sound prec s bytes ap A) as (M & I & Ma & Mb & W). destruct (accepts_well_posed prec s bytes ap A) as (_ & Fa & Fb).
  split; [exact M|split; [|auto]].
  assert (Ra : rigid (body_a s)) by (split; auto). assert (Rb : rigid (body_b s)) by (split; auto).
  destruct ap.
  - destruct (I eq_refl) as (_ & Never). intros t x T. destruct (Never t x T) as [P Q]. split; intros X; apply free_winds; auto.
  - destruct (surface_of (tris (body_a s)) ha) as [fa|] eqn:Ea; [|discriminate].
    destruct (surface_of (tris (body_b s)) hb) as [fb|] eqn:Eb; [|discriminate].
    destruct (negb _) eqn:Z0; [discriminate|]. apply negb_false_iff, andb_true_iff in Z0 as [Za Zb].
    apply Qlt_bool_R in Za, Zb. rewrite Q2R_0 in Za, Zb. apply accepts_walk in A as (Sa & Sb & C & _).
    apply Qle_bool_iff, Qle_Rle in C. rewrite Q2R_0 in C.
    assert (N : forall t x, 0 <= t <= 1 -> at_time (body_a s) t x -> ~ at_time (body_b s) t x).
    { intros t x T X Y. pose proof (M t x x T X Y) as L. replace (vsub x x) with (vscale 0 x) in L
        by (apply V_eq; unfold vsub, vscale; simpl; ring). rewrite norm_vscale in L by lra. lra. }
    destruct (rays _ (starts fa) rest ns) as [[rest' ns']|] eqn:Ga; [|discriminate].
    destruct (rays _ (starts fb) rest' ns') as [[rest'' ns'']|] eqn:Gb; [|discriminate].
    intros t x T. split; intros X.
    + apply (rays_never (body_a s) (body_b s) ha fa hb fb _ _ _ _ Sa Sb Ra Rb Zb N Ea Eb eq_refl Ga); auto.
    + apply (rays_never (body_b s) (body_a s) hb fb ha fa _ _ _ _ Sb Sa Rb Ra Za) with (t := t) (x := x) in Gb; auto.
      intros u y U P Q. apply (N u y U Q P).
Qed.

(* ---- INSIDE: whose corner, its number, and a ray. `corner` tells which place has a number. Behind the end are zeros *)
Definition inside_of (s : scene) (ta tb : tree) (fa fb : option surface) (corner : bool -> Z -> option zv) (bytes : list Z)
    : answer (bool * Q) :=
  let bits := bits_of bytes in
  let no why at_ := No why (skipn at_ bits) in
  let t := Qred (field bits 40 32 # 4294967295) in
  let of_b := (field bits 72 1 =? 1)%Z in
  let behind := skipn 105 bits ++ repeat false 64 in
  let '(of, by_, fo, fb, tree) := if of_b then (body_b s, body_a s, fb, fa, ta) else (body_a s, body_b s, fa, fb, tb) in
  if negb (sound_body of && sound_body by_ && is_share t && Qlt_bool 0 (size by_)) then no Unfit 0%nat else
  match fo, fb, read_normal (repeat (mkZ 0 0 0) 8) behind with
  | Some fo, Some fb, Some (ns, rest) =>
    let end_ := (105 + (length behind - length rest))%nat in
    match corner of_b (field bits 73 32) with
    | None => no NoCorner end_
    | Some p => if negb (is_corner fo p) then no NoCorner end_ else
      match shot of by_ (kept fb) tree t (List.hd (mkZ 0 0 0) ns) p with
      | None => no TooNear end_
      | Some k => if (k =? 0)%Z then no NotInside end_ else if (length bits <? end_)%nat then no EndsEarly end_ else
        if (8 <=? length (skipn end_ bits))%nat then no Follows end_ else Yes (of_b, t) end end
  | _, _, _ => no Unfit 0%nat end.
Definition insides s (hint : list zv * list zv * (bool -> Z -> option zv)) bytes := let '(ha, hb, corner) := hint in
  match inside_of s (tree_of (body_a s)) (tree_of (body_b s)) (surface_of (tris (body_a s)) ha) (surface_of (tris (body_b s)) hb)
    corner bytes with Yes r => Some r | No _ _ => None end.

Lemma shot_within of by_ ho fo hb fb t n p k : sound_body of = true -> sound_body by_ = true -> 0 < Q2R (size by_) ->
  surface_of (tris of) ho = Some fo -> is_corner fo p = true -> surface_of (tris by_) hb = Some fb ->
  shot of by_ (kept fb) (tree_of by_) t n p = Some k -> (k =? 0)%Z = false -> within of by_ (Q2R t).
Proof.
  intros So Sb Z0 Fo C Fb E K. apply (shot_ok of by_ hb fb) in E as (m & I & D & Off & W); auto.
  apply surface_ok in Fo as (_ & _ & Fo). apply Fo in C as (T & IT & IP). eexists _, (IZR k). split; [|split; [exact Off|split; [exact W|]]].
  - exists m, T, p. auto.
  - intros Q. apply eq_IZR in Q. subst k. discriminate.
Qed.
Theorem insides_sound : sound_inside insides.
Proof.
  intros s [[ha hb] corner] bytes of_b t. unfold insides, inside_of. cbv zeta.
  destruct (field (bits_of bytes) 72 1 =? 1)%Z;
    (destruct (negb _) eqn:E; [discriminate|]; apply negb_false_iff in E; rewrite !andb_true_iff in E;
      destruct E as (((So & Sb) & U) & Z0);
    apply Qlt_bool_R in Z0; rewrite Q2R_0 in Z0; apply is_share_R in U;
    destruct (surface_of (tris (body_a s)) ha) as [fa|] eqn:Ea; destruct (surface_of (tris (body_b s)) hb) as [fb|] eqn:Eb;
      try discriminate;
    destruct (read_normal _ _) as [[ns rest]|]; [|discriminate]; destruct (corner _ _) as [p|]; [|discriminate];
    destruct (negb _) eqn:C; [discriminate|]; apply negb_false_iff in C; destruct (shot _ _ _ _ _ _ _) as [k|] eqn:S;
      [|discriminate];
    destruct (k =? 0)%Z eqn:K; [discriminate|]; destruct (_ <? _)%nat; [discriminate|]; destruct (_ <=? _)%nat; [discriminate|];
    intros H; injection H as <- <-; split; [exact U|split; [|split; [|split; [|split]]; (apply sound_body_moves || apply proper_of);
      assumption]]).
  - apply (shot_within _ _ _ _ _ _ _ _ _ _ So Sb Z0 Eb C Ea S K).
  - apply (shot_within _ _ _ _ _ _ _ _ _ _ So Sb Z0 Ea C Eb S K).
Qed.
End Rays.
End Make.
