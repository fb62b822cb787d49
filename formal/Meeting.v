(* Meeting.v - an executable checker of NEAR and HIT certificates: that at one time a point of one body
   is near one of the other, or that an edge of one passes through a triangle of the other. Its numbers
   are intervals, as those of Checker.v, of which it is the rest. *)
From Coq Require Import Reals Lra Psatz List ZArith QArith Qreals Bool.
From Interval Require Import Real.Xreal Float.Basic Interval.Interval.
From Svcd Require Export Checker.
Import ListNotations.
Local Open Scope R_scope.

(* ---- triangles where a body is *)
Lemma place_mix m t T a b c : a + b + c = 1 -> place m t (mix a b c T) = mix a b c (placed m t T).
Proof.
  intros S. replace a with (1 - b - c) by lra. unfold placed, mix, place. rewrite !rot_rows.
  apply V_eq; unfold vadd, vscale, dot; cbn [vx vy vz c0 c1 c2]; ring.
Qed.

(* ---- an edge from p to q passes through a triangle, if these are above 0: on which side of each edge it
   passes; and on which sides of the triangle its ends are *)
Definition sides p q T :=
  let d := vsub q p in
  let u := vsub (c0 T) p in let v := vsub (c1 T) p in let w := vsub (c2 T) p in
  [det d u v; det d v w; det d w u; det u v w; det (vsub (c0 T) q) (vsub (c2 T) q) (vsub (c1 T) q)].
Lemma passes p q T : Forall (Rlt 0) (sides p q T) ->
  exists l, 0 <= l <= 1 /\ of_tri (vadd (vscale (1 - l) p) (vscale l q)) T.
Proof.
  unfold sides. set (d := vsub q p). set (u := vsub (c0 T) p). set (v := vsub (c1 T) p). set (w := vsub (c2 T) p).
  intros H. do 5 (apply Forall_cons_iff in H as [? H]). clear H.
  assert (E : det (vsub (c0 T) q) (vsub (c2 T) q) (vsub (c1 T) q) = det d u v + det d v w + det d w u - det u v w)
    by (unfold d, u, v, w, det, dot, cross, vsub; cbn [vx vy vz]; ring).
  rewrite E in *. set (s := det d u v + det d v w + det d w u) in *. assert (0 < s) by (unfold s; lra).
  exists (det u v w / s). split; [split; apply Rmult_le_reg_r with s; auto; unfold Rdiv; rewrite ?Rmult_assoc, ?Rinv_l; lra|].
  exists (det d v w / s), (det d w u / s), (det d u v / s).
  split; [|split; [|split; [|split]]]; try (apply Rlt_le, Rdiv_lt_0_compat; auto).
  - unfold s. field. fold s. lra.
  - assert (K : forall a b, s * a = s * b -> a = b) by (intros a b P; apply Rmult_eq_reg_l with s; lra).
    assert (L : forall z, s * (z / s) = z) by (intros; field; lra).
    apply V_eq; apply K; unfold mix, vadd, vscale; cbn [vx vy vz];
      rewrite !Rmult_plus_distr_l, <- !Rmult_assoc, Rmult_minus_distr_l, !L;
      unfold s, d, u, v, w, det, dot, cross, vsub; cbn [vx vy vz]; ring.
Qed.

(* the triangle, its corners one after the other *)
Definition rolled T := mkTri (c1 T) (c2 T) (c0 T).
Lemma of_rolled x T : of_tri x (rolled T) -> of_tri x T.
Proof.
  intros (a & b & c & A & B & C & S & ->). exists c, a, b. repeat split; auto; [lra|].
  apply V_eq; unfold mix, vadd, vscale; simpl; ring.
Qed.
Lemma of_edge l T : 0 <= l <= 1 -> of_tri (vadd (vscale (1 - l) (c0 T)) (vscale l (c1 T))) T.
Proof.
  intros L. exists (1 - l), l, 0. repeat split; try lra. apply V_eq; unfold mix, vadd, vscale; simpl; ring.
Qed.

Module Make (I : IntervalOps).
Include Checker.Make I.
Section Meeting.
Variable prec : I.precision.

Record itri := mkIT { ia : IV; ib : IV; ic : IV }.
Definition inT i T := inV (ia i) (c0 T) /\ inV (ib i) (c1 T) /\ inV (ic i) (c2 T).
Definition iplace ip x := iadd prec (mkIV (idot prec (r0 ip) x) (idot prec (r1 ip) x) (idot prec (r2 ip) x)) (org ip).
Lemma in_place ip m t x xR : inPose ip m t -> inV x xR -> inV (iplace ip x) (place m t xR).
Proof.
  intros (A & B & C & HA & HB & HC & O & E) X. rewrite E. apply in_vadd; auto.
  repeat split; apply in_dot; auto.
Qed.

(* a body's triangle of a number, at a time *)
Definition during t m := Qle_bool (t_from m) t && Qle_bool t (t_to m).
Definition triangle b i := if (i <? Z.of_nat (length (tris b)))%Z then nth_error (tris b) (Z.to_nat i) else None.
Definition found b t i := match find (during t) (pieces b), triangle b i with
  | Some m, Some T =>
    let ip := ipose_at prec (size b) (make_ready prec m) t in
    let f p := iplace ip (ipoint prec (den b) p) in Some (mkIT (f (za T)) (f (zb T)) (f (zc T)))
  | _, _ => None end.
Lemma found_ok b t i T : sound_body b = true -> found b t i = Some T ->
  exists TR, inT T TR /\ forall x, of_tri x TR -> at_time b (Q2R t) x.
Proof.
  unfold sound_body. rewrite !andb_true_iff, forallb_forall. intros ((S & M) & _). unfold found.
  destruct (find _ _) as [m|] eqn:F; [|discriminate]. apply find_some in F as [F D].
  destruct (triangle b i) as [U|] eqn:E; [|discriminate]. intros H. injection H as <-.
  assert (IU : In U (tris b)) by (revert E; unfold triangle; destruct (_ <? _)%Z; [apply nth_error_In|discriminate]).
  pose proof (in_pose prec (size b) m t (M m F) S) as P.
  exists (placed (pieceR (size b) m) (Q2R t) (triR (den b) U)). split.
  - split; [|split]; apply in_place; auto; apply in_point.
  - intros x (a & c & e & A & C & E' & Sum & ->). rewrite <- place_mix by auto.
    apply andb_true_iff in D as [D D']. apply Qle_bool_iff, Qle_Rle in D, D'.
    exists m, U, (mix a c e (triR (den b) U)). repeat split; auto. exists a, c, e. auto.
Qed.

(* ---- NEAR: points that are shares of ways: from the first corner to the second, and from there to the third *)
Definition is_share q := Qle_bool 0 q && Qle_bool q 1.
Lemma is_share_R q : is_share q = true -> 0 <= Q2R q <= 1.
Proof.
  intros H. apply andb_true_iff in H as [A B]. apply Qle_bool_iff, Qle_Rle in A, B.
  rewrite Q2R_0 in A. rewrite Q2R_1 in B. auto.
Qed.
Definition ipoint_of v w T := iadd prec (iscale prec (iQ prec (1 - v)) (ia T))
  (iadd prec (iscale prec (iQ prec (v * (1 - w))) (ib T)) (iscale prec (iQ prec (v * w)) (ic T))).
Lemma in_point_of v w T TR : is_share v = true -> is_share w = true -> inT T TR ->
  exists x, of_tri x TR /\ inV (ipoint_of v w T) x.
Proof.
  intros V W (A & B & C). apply is_share_R in V, W.
  exists (mix (Q2R (1 - v)) (Q2R (v * (1 - w))) (Q2R (v * w)) TR). split.
  - do 3 eexists. rewrite !Q2R_mult, !Q2R_minus, Q2R_1. repeat split; try lra; nra.
  - repeat apply in_vadd; apply in_vscale; auto; apply in_Q.
Qed.
Definition nearer c x y := positive_i (I.sub prec (iQ prec c) (inorm prec (isub prec x y))).
Lemma nearer_ok c x y xR yR : inV x xR -> inV y yR -> nearer c x y = true -> norm (vsub xR yR) < Q2R c.
Proof.
  intros X Y H. apply Rminus_gt_0_lt, (positive_ok _ _ H), in_sub; [apply in_Q|apply in_norm, in_vsub; auto].
Qed.

(* ---- HIT: the first edge of one, either way, passes through the other *)
Definition idet u v w := idot prec u (icross prec v w).
Definition isides p q T :=
  let d := isub prec q p in
  let u := isub prec (ia T) p in let v := isub prec (ib T) p in let w := isub prec (ic T) p in
  [idet d u v; idet d v w; idet d w u; idet u v w; idet (isub prec (ia T) q) (isub prec (ic T) q) (isub prec (ib T) q)].
Lemma isides_ok p q T pR qR TR : inV p pR -> inV q qR -> inT T TR ->
  forallb positive_i (isides p q T) = true -> Forall (Rlt 0) (sides pR qR TR).
Proof.
  intros P Q (A & B & C) H. unfold isides in H. cbn [forallb] in H. rewrite !andb_true_iff in H. destruct H as (H1 & H2 & H3 & H4 & H5 & _).
  repeat apply Forall_cons;
    [apply (positive_ok _ _ H1)|apply (positive_ok _ _ H2)|apply (positive_ok _ _ H3)|apply (positive_ok _ _ H4)
    |apply (positive_ok _ _ H5)|apply Forall_nil]; apply in_dot; try apply in_cross; apply in_vsub; auto.
Qed.
Definition pierces A B := forallb positive_i (isides (ia A) (ib A) B) || forallb positive_i (isides (ib A) (ia A) B).
Lemma pierces_ok A B AR BR : inT A AR -> inT B BR -> pierces A B = true -> exists x, of_tri x AR /\ of_tri x BR.
Proof.
  intros (P & Q & _) HB H. apply orb_true_iff in H as [H|H]; eapply isides_ok, passes in H as (l & L & X); eauto.
  - eexists. split; [apply of_edge; eauto|exact X].
  - exists (vadd (vscale (1 - l) (c1 AR)) (vscale l (c0 AR))). split; [|exact X].
    replace (vadd _ _) with (vadd (vscale (1 - (1 - l)) (c0 AR)) (vscale (1 - l) (c1 AR))); [apply of_edge; lra|].
    apply V_eq; unfold vadd, vscale; simpl; ring.
Qed.
Definition irolled T := mkIT (ib T) (ic T) (ia T).
Definition from_edge k T := if (k =? 0)%Z then T else if (k =? 1)%Z then irolled T else irolled (irolled T).
Lemma from_edge_ok k T TR : inT T TR -> exists UR, inT (from_edge k T) UR /\ forall x, of_tri x UR -> of_tri x TR.
Proof.
  intros (A & B & C). unfold from_edge. destruct (k =? 0)%Z; [|destruct (k =? 1)%Z].
  - exists TR. split; [split; [|split]|]; auto.
  - exists (rolled TR). split; [split; [|split]; auto|]. intros x. apply of_rolled.
  - exists (rolled (rolled TR)). split; [split; [|split]; auto|]. intros x H. apply of_rolled, of_rolled, H.
Qed.

(* ---- a certificate. Behind its end are zeros. *)
Definition field bits at_ k := match read k 0 (skipn at_ bits ++ repeat false k) with Some (z, _) => z | None => 0%Z end.
Definition meeting (s : scene) (bytes : list Z) : answer (bool * Q) :=
  let bits := bits_of bytes in
  let no why at_ := No why (skipn at_ bits) in
  let t := Qred (field bits 40 32 # 4294967295) in
  if negb (sound_body (body_a s) && sound_body (body_b s) && is_share t) then no Unfit 0%nat else
  match found (body_a s) t (field bits 72 32), found (body_b s) t (field bits 104 32) with
  | Some A, Some B =>
    let ends at_ hit := if (length bits <? at_)%nat then no EndsEarly at_ else
      if (8 <=? length (skipn at_ bits))%nat then no Follows at_ else Yes (hit, t) in
    if (field bits 0 8 =? 6)%Z then
      let f at_ := (field bits at_ 16 # 65535)%Q in
      let v := f 136%nat in let w := f 152%nat in let v' := f 168%nat in let w' := f 184%nat in
      if is_share v && is_share w && is_share v' && is_share w' &&
        nearer (clearance s) (ipoint_of v w A) (ipoint_of v' w' B) then ends 200%nat false else no NotNear 200%nat
    else if (field bits 0 8 =? 5)%Z then
      let k := field bits 137 2 in
      let '(E, F) := if (field bits 136 1 =? 0)%Z then (A, B) else (B, A) in
      if (k =? 3)%Z then no NoEdge 139%nat else if pierces (from_edge k E) F then ends 139%nat true else no NotPierced 139%nat
    else no NotFree 0%nat
  | _, _ => no NoTriangle 136%nat end.
Definition meets s bytes := match meeting s bytes with Yes r => Some r | No _ _ => None end.

Lemma sound_body_moves b : sound_body b = true -> moves b.
Proof.
  unfold sound_body. rewrite !andb_true_iff. intros ((_ & M) & C). split.
  - intros t T. apply (chained_ok _ 0 t C); rewrite Q2R_0; lra.
  - intros m m' t x. eapply chained_one; eauto.
Qed.

Theorem meets_sound : sound_meeting meets.
Proof.
  intros s bytes hit t. unfold meets, meeting. cbv zeta. destruct (negb _) eqn:E; [discriminate|]. apply negb_false_iff in E.
  rewrite !andb_true_iff in E. destruct E as ((Sa & Sb) & U).
  destruct (found (body_a s) _ _) as [A|] eqn:FA; [|discriminate].
  destruct (found (body_b s) _ _) as [B|] eqn:FB; [|discriminate].
  apply found_ok in FA as (AR & IA & PA); auto. apply found_ok in FB as (BR & IB & PB); auto.
  pose proof (sound_body_moves _ Sa). pose proof (sound_body_moves _ Sb). apply is_share_R in U.
  pose proof (proj1 (proper_of _ Sa)). pose proof (proj1 (proper_of _ Sb)).
  destruct (_ =? 6)%Z.
  - destruct (_ && nearer _ _ _)%bool eqn:N; [|discriminate]. rewrite !andb_true_iff in N. destruct N as ((((V & W) & V') & W') & N).
    destruct (_ <? _)%nat; [discriminate|]. destruct (_ <=? _)%nat; [discriminate|]. intros Y. injection Y as <- <-.
    split; [auto|split; [|auto]].
    destruct (in_point_of _ _ _ _ V W IA) as (x & X & IX). destruct (in_point_of _ _ _ _ V' W' IB) as (y & Y & IY).
    exists x, y. repeat split; auto. eapply nearer_ok; eauto.
  - destruct (_ =? 5)%Z; [|discriminate].
    destruct (if (field (bits_of bytes) 136 1 =? 0)%Z then (A, B) else (B, A)) as [E F] eqn:Of.
    destruct (_ =? 3)%Z; [discriminate|]. destruct (pierces _ _) eqn:N; [|discriminate].
    destruct (_ <? _)%nat; [discriminate|]. destruct (_ <=? _)%nat; [discriminate|]. intros Y. injection Y as <- <-.
    split; [auto|split; [|auto]].
    destruct (_ =? 0)%Z; injection Of as <- <-.
    + destruct (from_edge_ok (field (bits_of bytes) 137 2) A AR IA) as (UR & IU & PU).
      destruct (pierces_ok _ _ _ _ IU IB N) as (x & X & X'). exists x. auto.
    + destruct (from_edge_ok (field (bits_of bytes) 137 2) B BR IB) as (UR & IU & PU).
      destruct (pierces_ok _ _ _ _ IU IA N) as (x & X & X'). exists x. auto.
Qed.
End Meeting.
End Make.
