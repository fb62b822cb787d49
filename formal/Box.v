(* Box.v - a test of Statement.v's words: a closed box, at rest, encloses each point within. From none
   is there a `free_way`. So `never_inside` does say that a body is not in a box. And of Answers.v's: it `winds` once about
   each point within, and about none without. *)
From Coq Require Import Reals Lra List ZArith QArith Qreals.
From Coquelicot Require Import Coquelicot.
From Svcd Require Import Winding.
Import ListNotations.
Local Open Scope R_scope.

(* two triangles of each of three sides, at -1 or at 1 *)
Definition sides (s : Z) := [
  mkZT (mkZ s (-1) (-1)) (mkZ s 1 (-1)) (mkZ s 1 1); mkZT (mkZ s (-1) (-1)) (mkZ s (-1) 1) (mkZ s 1 1);
  mkZT (mkZ (-1) s (-1)) (mkZ 1 s (-1)) (mkZ 1 s 1); mkZT (mkZ (-1) s (-1)) (mkZ (-1) s 1) (mkZ 1 s 1);
  mkZT (mkZ (-1) (-1) s) (mkZ 1 (-1) s) (mkZ 1 1 s); mkZT (mkZ (-1) (-1) s) (mkZ (-1) 1 s) (mkZ 1 1 s)].
Definition still := mkPose 0 0 0 0 0 0 1.
Definition the_box := mkBody 1 (sides 1 ++ sides (-1)) 1 [mkQP 0 1 still still].
Definition width p := Rmax (Rabs (vx p)) (Rmax (Rabs (vy p)) (Rabs (vz p))).

Lemma still_place t y : place (pieceR 1 (mkQP 0 1 still still)) t y = y.
Proof.
  assert (Z : Q2R 0 = 0) by (unfold Q2R; simpl; lra). assert (O : Q2R 1 = 1) by (unfold Q2R; simpl; lra).
  assert (U : quatR still = mkQ 0 0 0 1) by (unfold quatR; simpl; rewrite Z, O; reflexivity).
  assert (I : unitq (mkQ 0 0 0 1) = mkQ 0 0 0 1).
  { unfold unitq. replace (qdot _ _) with 1 by (unfold qdot; simpl; ring). rewrite sqrt_1.
    unfold qscale; simpl; f_equal; field. }
  assert (S : shorter (mkQ 0 0 0 1) (mkQ 0 0 0 1) = mkQ 0 0 0 1)
    by (unfold shorter; destruct Rlt_dec as [L|]; auto; unfold qdot in L; simpl in L; lra).
  assert (L : forall u, slerp (mkQ 0 0 0 1) (mkQ 0 0 0 1) u = mkQ 0 0 0 1).
  { intros u. unfold slerp, angle. replace (qdot _ _) with 1 by (unfold qdot; simpl; ring).
    rewrite acos_1, sin_0. destruct (Req_EM_T 0 0); [auto|contradiction]. }
  unfold place, origin, pieceR, posR. cbn [scale q0 q1 p0 p1 pose_from pose_to].
  rewrite U, S, I, L, rot_unit by (unfold qdot; simpl; ring). cbn [px py pz still]. rewrite Z, O.
  apply V_eq; unfold vadd, vscale, turned, qdot; simpl; ring.
Qed.

Lemma width_is p : Rabs (vx p) <= width p /\ Rabs (vy p) <= width p /\ Rabs (vz p) <= width p /\
  (width p = Rabs (vx p) \/ width p = Rabs (vy p) \/ width p = Rabs (vz p)).
Proof.
  unfold width. generalize (Rabs (vx p)) (Rabs (vy p)) (Rabs (vz p)). intros a b c.
  unfold Rmax. destruct (Rle_dec b c); destruct Rle_dec; repeat split; auto; lra.
Qed.

Lemma on_side p : width p = 1 -> exists T, In T (sides 1 ++ sides (-1)) /\ of_tri p (triR 1 T).
Proof.
  intros W. pose proof (width_is p) as (X & Y & Z & F). rewrite W in *. destruct p as [x y z]. cbn [vx vy vz] in *.
  assert (S : forall r, 1 = Rabs r -> r = 1 \/ r = -1) by (intros r; unfold Rabs; destruct Rcase_abs; [right|left]; lra).
  apply Rabs_le_between in X, Y, Z.
  assert (On : forall T a b c, In T (sides 1 ++ sides (-1)) -> 0 <= a -> 0 <= b -> 0 <= c -> a + b + c = 1 ->
    mkV x y z = mix a b c (triR 1 T) -> exists T, In T (sides 1 ++ sides (-1)) /\ of_tri (mkV x y z) (triR 1 T))
    by (intros T a b c; exists T; split; auto; exists a, b, c; auto).
  Ltac at_ on n p q := let T := eval cbv in (nth n (sides 1 ++ sides (-1)) (mkZT (mkZ 0 0 0) (mkZ 0 0 0) (mkZ 0 0 0))) in
    apply (on T ((1 - p) / 2) ((p - q) / 2) ((1 + q) / 2)); try lra; [simpl; tauto|];
    apply V_eq; unfold mix, triR, pointR, vadd, vscale; simpl; lra.
  destruct F as [F|[F|F]]; apply S in F as [-> | ->].
  - destruct (Rle_dec z y); [at_ On 0%nat y z|at_ On 1%nat z y].
  - destruct (Rle_dec z y); [at_ On 6%nat y z|at_ On 7%nat z y].
  - destruct (Rle_dec z x); [at_ On 2%nat x z|at_ On 3%nat z x].
  - destruct (Rle_dec z x); [at_ On 8%nat x z|at_ On 9%nat z x].
  - destruct (Rle_dec y x); [at_ On 4%nat x y|at_ On 5%nat y x].
  - destruct (Rle_dec y x); [at_ On 10%nat x y|at_ On 11%nat y x].
Qed.

Lemma steady_max f g : steady f -> steady g -> steady (fun u => Rmax (f u) (g u)).
Proof.
  intros F G. assert (H : steady (fun u => / 2 * (f u + g u + Rabs (f u - g u)))) by steady.
  intros u. apply (continuity_pt_ext (fun u => / 2 * (f u + g u + Rabs (f u - g u)))); [|apply H].
  intros v. unfold Rmax, Rabs. destruct Rle_dec, Rcase_abs; lra.
Qed.

Theorem box_encloses t x : 0 <= t <= 1 -> width x < 1 -> ~ free_way the_box t x.
Proof.
  intros T X (way & S & Cx & Cy & Cz & Clear & Away). destruct (Away 2) as (u & U).
  set (v := Rmax 1 u). assert (L : 1 <= v) by apply Rmax_l. specialize (U v (Rmax_r 1 u)).
  destruct (IVT (fun u => width (way u) - 1) 0 v) as (w & [Wl Wh] & E).
  - apply (steady_minus (fun u => width (way u)) (fun _ => 1)); [|apply steady_const].
    unfold width. repeat apply steady_max; apply steady_abs; assumption.
  - lra.
  - rewrite S. lra.
  - destruct (Rle_dec (width (way v)) 1) as [N|]; [exfalso|lra].
    assert (norm (way v) <= sqrt (2 * 2)); [|rewrite sqrt_square in H; lra].
    assert (Q : forall r, Rabs r <= 1 -> r * r <= 1) by (intros r; unfold Rabs; destruct Rcase_abs; intros; nra).
    apply sqrt_le_1_alt. unfold dot.
    pose proof (width_is (way v)) as (X' & Y' & Z' & _).
    assert (vx (way v) * vx (way v) <= 1) by (apply Q; lra). assert (vy (way v) * vy (way v) <= 1) by (apply Q; lra).
    assert (vz (way v) * vz (way v) <= 1) by (apply Q; lra). lra.
  - destruct (on_side (way w)) as (F & I & O); [lra|]. apply (Clear w Wl).
    exists (mkQP 0 1 still still), F, (way w). split; [left; reflexivity|]. split; [unfold Q2R; simpl; lra|].
    split; [exact I|split; [exact O|]]. symmetry. apply still_place.
Qed.

(* ---- a box whose triangles are all counter-clockwise as seen from outside *)
Definition shut := mkBody 1 [
  mkZT (mkZ 1 (-1) (-1)) (mkZ 1 1 (-1)) (mkZ 1 1 1); mkZT (mkZ 1 (-1) (-1)) (mkZ 1 1 1) (mkZ 1 (-1) 1);
  mkZT (mkZ (-1) (-1) (-1)) (mkZ (-1) 1 1) (mkZ (-1) 1 (-1)); mkZT (mkZ (-1) (-1) (-1)) (mkZ (-1) (-1) 1) (mkZ (-1) 1 1);
  mkZT (mkZ (-1) 1 (-1)) (mkZ 1 1 1) (mkZ 1 1 (-1)); mkZT (mkZ (-1) 1 (-1)) (mkZ (-1) 1 1) (mkZ 1 1 1);
  mkZT (mkZ (-1) (-1) (-1)) (mkZ 1 (-1) (-1)) (mkZ 1 (-1) 1); mkZT (mkZ (-1) (-1) (-1)) (mkZ 1 (-1) 1) (mkZ (-1) (-1) 1);
  mkZT (mkZ (-1) (-1) 1) (mkZ 1 (-1) 1) (mkZ 1 1 1); mkZT (mkZ (-1) (-1) 1) (mkZ 1 1 1) (mkZ (-1) 1 1);
  mkZT (mkZ (-1) (-1) (-1)) (mkZ 1 1 (-1)) (mkZ 1 (-1) (-1)); mkZT (mkZ (-1) (-1) (-1)) (mkZ (-1) 1 (-1)) (mkZ 1 1 (-1))]
  1 [mkQP 0 1 still still].
Lemma shut_balanced : balanced (tris shut).
Proof. apply balanced_by. cbv zeta. repeat (apply List.Forall_cons; [reflexivity|]). apply List.Forall_nil. Qed.
Lemma shut_winds t x n : 0 <= t <= 1 -> winding x (map (image (pointR 1)) (tris shut)) = n -> winds shut t x n.
Proof.
  intros T E. exists (mkQP 0 1 still still), (tris shut). split; [left; reflexivity|]. split; [unfold Q2R; simpl; lra|]. split.
  - exists (fun _ => true). split; [reflexivity|]. intros U _. split; auto. intros _ W p q _ _. apply shut_balanced.
  - rewrite <- E. f_equal. apply map_ext. intros U. unfold placed. change (size shut) with 1%Q. rewrite !still_place. reflexivity.
Qed.
Theorem winds_outside t x : 0 <= t <= 1 -> 1 < width x -> winds shut t x 0.
Proof.
  intros T W. apply shut_winds; auto. pose proof (width_is x) as (_ & _ & _ & F).
  assert (E : exists m, (forall T p, In T (tris shut) -> In p [za T; zb T; zc T] -> 0 < dot m (vsub (pointR 1 p) x))).
  { assert (A : forall r, 1 < Rabs r -> 1 < r \/ r < -1) by (intros r; unfold Rabs; destruct Rcase_abs; lra).
    assert (C : forall m, (forall a b c, (a = 1 \/ a = -1) -> (b = 1 \/ b = -1) -> (c = 1 \/ c = -1) ->
      0 < dot m (vsub (mkV a b c) x)) ->
      forall T p, In T (tris shut) -> In p [za T; zb T; zc T] -> 0 < dot m (vsub (pointR 1 p) x)).
    { intros m H U p I P. cbn [tris shut In] in I. repeat (destruct I as [<-|I]); try contradiction; cbn [za zb zc In] in P;
        repeat (destruct P as [<-|P]); try contradiction; unfold pointR; cbn [zx zy zz]; apply H; lra. }
    destruct F as [F|[F|F]]; rewrite F in W; apply A in W as [W|W]; [exists (mkV (-1) 0 0)|exists (mkV 1 0 0)|exists (mkV 0 (-1) 0)|
      exists (mkV 0 1 0)|exists (mkV 0 0 (-1))|exists (mkV 0 0 1)]; apply C; intros a b c A' B' C'; unfold dot, vsub;
        cbn [vx vy vz]; lra. }
  destruct E as (m & E). apply (winding_aside (pointR 1) (tris shut) x m shut_balanced E).
Qed.
Definition front := mkZT (mkZ 1 (-1) (-1)) (mkZ 1 1 (-1)) (mkZ 1 1 1).
Lemma front_dec T : {front = T} + {front <> T}.
Proof. decide equality; apply zv_dec. Defined.
Theorem winds_inside t x : 0 <= t <= 1 -> width x < 1 -> winds shut t x 1.
Proof.
  intros T W. apply shut_winds; auto. pose proof (width_is x) as (X & Y & Z & _). destruct x as [x y z]. cbn [vx vy vz] in *.
  assert (Lx : -1 < x < 1) by (apply Rabs_lt_between; lra). assert (Ly : -1 < y < 1) by (apply Rabs_lt_between; lra).
  assert (Lz : -1 < z < 1) by (apply Rabs_lt_between; lra). clear X Y Z W.
  (* to the middle of the triangle in front *)
  set (d := mkV (1 - x) (/ 3 - y) (- / 3 - z)).
  assert (P : forall r s, 0 < r -> 0 < s -> 0 < r * s) by apply Rmult_lt_0_compat.
  rewrite (winding_ray (pointR 1) (tris shut) _ d (fun T => if front_dec T then 1%Z else 0%Z));
    [reflexivity|apply shut_balanced| |].
  - apply sqrt_lt_R0. unfold dot, d; cbn [vx vy vz]. pose proof (P (1 - x) (1 - x)). pose proof (Rle_0_sqr (/ 3 - y)).
    pose proof (Rle_0_sqr (- / 3 - z)). unfold Rsqr in *. lra.
  - assert (Px : 0 < (1 - x) * (1 - x)) by (apply P; lra).
    assert (Py : 0 < (1 - x) * (1 - y)) by (apply P; lra). assert (Py' : 0 < (1 - x) * (1 + y)) by (apply P; lra).
    assert (Pz : 0 < (1 - x) * (1 - z)) by (apply P; lra). assert (Pz' : 0 < (1 - x) * (1 + z)) by (apply P; lra).
    assert (Q : forall r, r <= 0 \/ 0 < r /\ 0 < r * (1 + x))
      by (intros r; destruct (Rlt_dec 0 r); [right; split; [|apply P]|left]; lra).
    assert (A : forall m U, dot m d <= 0 -> 0 < dot m (vsub (c0 U) (mkV x y z)) -> 0 < dot m (vsub (c1 U) (mkV x y z)) ->
      0 < dot m (vsub (c2 U) (mkV x y z)) -> crosses d (mkV x y z) U 0) by (intros m U; apply (aside _ _ _ m)).
    Ltac at_m A a b c := apply (A (mkV a b c)); unfold image, pointR, dot, vsub; cbn [vx vy vz c0 c1 c2 za zb zc zx zy zz]; lra.
    intros U I. cbn [tris shut In] in I. subst d.
    destruct I as [<-|[<-|[<-|[<-|[<-|[<-|[<-|[<-|[<-|[<-|[<-|[<-|[]]]]]]]]]]]]]; destruct front_dec as [E|E]; try discriminate E;
      try (contradiction E; reflexivity); clear E.
    + apply up. unfold image, pointR, det, dot, cross, vsub; cbn [vx vy vz c0 c1 c2 za zb zc zx zy zz]. repeat split; lra.
    + at_m A (z - y + / 3) (x - 1) (1 - x).
    + at_m A (-1) 0 0.
    + at_m A (-1) 0 0.
    + destruct (Q (/ 3 - y)); [at_m A 0 1 0|at_m A (y - / 3) (1 - x) 0].
    + destruct (Q (/ 3 - y)); [at_m A 0 1 0|at_m A (y - / 3) (1 - x) 0].
    + destruct (Q (y - / 3)); [at_m A 0 (-1) 0|at_m A (/ 3 - y) (x - 1) 0].
    + destruct (Q (y - / 3)); [at_m A 0 (-1) 0|at_m A (/ 3 - y) (x - 1) 0].
    + destruct (Q (- / 3 - z)); [at_m A 0 0 1|at_m A (z + / 3) 0 (1 - x)].
    + destruct (Q (- / 3 - z)); [at_m A 0 0 1|at_m A (z + / 3) 0 (1 - x)].
    + destruct (Q (z + / 3)); [at_m A 0 0 (-1)|at_m A (- / 3 - z) 0 (x - 1)].
    + destruct (Q (z + / 3)); [at_m A 0 0 (-1)|at_m A (- / 3 - z) 0 (x - 1)].
Qed.
