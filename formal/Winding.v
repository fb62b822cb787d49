(* Winding.v - what `winding` of Answers.v is worth, for triangles each edge of which goes there as often as back (`balanced`),
   wherever their corners are put: a whole number about each point that they do not touch; the same all along a motion that
   never touches it; 0 about a point with a way out; and the number of crossings of a ray. No topology is taken for granted. *)
From Coq Require Import Reals Lra Lia Psatz List ZArith Permutation.
From Coquelicot Require Import Coquelicot.
From Svcd Require Export Solid.
From Svcd Require Import Ray_law.
Import ListNotations.
Local Open Scope R_scope.

(* `balanced` can be computed: only edges that there are have to be counted *)
Lemma balanced_by l : (let E := flat_map edges l in
  List.Forall (fun e => count_occ edge_dec E e = count_occ edge_dec E (snd e, fst e)) E) -> balanced l.
Proof.
  cbv zeta. intros H p q. unfold evenly. rewrite Forall_forall in H. set (E := flat_map edges l) in *.
  destruct (in_dec edge_dec (p, q) E) as [I|I]; [apply (H _ I)|].
  destruct (in_dec edge_dec (q, p) E) as [J|J]; [symmetry; apply (H _ J)|].
  apply (count_occ_not_In edge_dec) in I. apply (count_occ_not_In edge_dec) in J. congruence.
Qed.

(* 1. a whole number *)
Lemma not_touched f l x T : ~ touches x (map (image f) l) -> In T l -> ~ of_tri x (image f T).
Proof. intros N I O. apply N. exists (image f T). split; [apply in_map; exact I|exact O]. Qed.

Theorem winding_integer f l x : balanced l -> ~ touches x (map (image f) l) ->
  exists k : Z, winding x (map (image f) l) = IZR k.
Proof.
  intros B N. pose proof PI_RGT_0 as P. destruct (angles_whole f l x (fun T => wound_by x (image f T) * PI) B) as (k & K).
  - intros T I. apply off_tri_edges. eapply not_touched; eassumption.
  - intros T I. apply turns. eapply not_touched; eassumption.
  - exists k. apply Rmult_eq_reg_r with PI; [|lra]. rewrite <- K. clear. induction l as [|T l IH]; simpl; [ring|].
    rewrite <- IH. unfold winding. ring.
Qed.

(* 2. the corners and the point move, from s to e, and never touch: the number stays *)
Theorem winding_steady (f : R -> zv -> V) (x : R -> V) l s e : balanced l ->
  (forall p, steadyV (fun u => f u p)) -> steadyV x -> s <= e ->
  (forall u, s <= u <= e -> ~ touches (x u) (map (image (f u)) l)) ->
  winding (x s) (map (image (f s)) l) = winding (x e) (map (image (f e)) l).
Proof.
  intros B F X L N. apply (whole_stays (fun u => winding (x u) (map (image (f u)) l)) s e L).
  - intros u U. specialize (N u U). clear B. induction l as [|T l IH]; [apply (steady_const 0 u)|]. unfold winding. simpl.
    apply continuity_pt_plus.
    + apply wound_steady; auto. eapply not_touched; [exact N|left; reflexivity].
    + apply IH. intros (U' & I & O). apply N. exists U'. split; [right; exact I|exact O].
  - intros u U. apply winding_integer; auto.
Qed.

(* if all corners are on one side of the point, it is 0: they may all go to the same place, on that side *)
Lemma aside_off m x T : 0 < dot m (vsub (c0 T) x) -> 0 < dot m (vsub (c1 T) x) -> 0 < dot m (vsub (c2 T) x) -> ~ of_tri x T.
Proof.
  intros A B C (a & b & c & Pa & Pb & Pc & S & E).
  assert (Z : a * dot m (vsub (c0 T) x) + b * dot m (vsub (c1 T) x) + c * dot m (vsub (c2 T) x) = 0).
  { transitivity (dot m (vsub (mix a b c T) x) + (1 - (a + b + c)) * dot m x).
    - unfold dot, vsub, mix, vadd, vscale. simpl. ring.
    - rewrite <- E, S. unfold dot, vsub. simpl. ring. }
  set (p := dot m (vsub (c0 T) x)) in *. set (q := dot m (vsub (c1 T) x)) in *. set (r := dot m (vsub (c2 T) x)) in *.
  assert (0 <= a * p) by (apply Rmult_le_pos; lra). assert (0 <= b * q) by (apply Rmult_le_pos; lra).
  assert (0 <= c * r) by (apply Rmult_le_pos; lra).
  assert (a * p = 0) as Ea by lra. assert (b * q = 0) as Eb by lra. assert (c * r = 0) as Ec by lra.
  apply Rmult_integral in Ea, Eb, Ec. lra.
Qed.

Theorem winding_aside f l x m : balanced l ->
  (forall T p, In T l -> In p [za T; zb T; zc T] -> 0 < dot m (vsub (f p) x)) -> winding x (map (image f) l) = 0.
Proof.
  intros B H. set (g u p := vadd (f p) (vscale u (vsub (vadd x m) (f p)))).
  assert (G0 : forall T, image (g 0) T = image f T).
  { assert (E : forall p, g 0 p = f p) by (intros p; apply V_eq; unfold g, vadd, vscale, vsub; simpl; ring).
    intros T. unfold image. rewrite !E. reflexivity. }
  assert (G1 : winding x (map (image (g 1)) l) = 0).
  { assert (E : forall p, vsub (g 1 p) x = m) by (intros p; apply V_eq; unfold g, vadd, vscale, vsub; simpl; ring).
    clear - E. induction l as [|T l IH]; [reflexivity|]. unfold winding in *. cbn [map fold_right]. rewrite IH, wound_is. cbv zeta.
    cbn [image c0 c1 c2]. rewrite !E. replace (det m m m) with 0 by (unfold det, dot, cross; simpl; ring).
    unfold Rdiv. rewrite Rmult_0_l, atan_0. ring. }
  rewrite <- G1. transitivity (winding x (map (image (g 0)) l)); [f_equal; apply map_ext; symmetry; apply G0|].
  apply (winding_steady g (fun _ => x) l 0 1 B); [| |lra|].
  - intros p. unfold g. apply steady_vadd; [apply steady_fixed|]. apply steady_vscale; [steady|apply steady_fixed].
  - apply steady_fixed.
  - intros u U (S & I & O). apply in_map_iff in I as (T & <- & I).
    assert (P : forall p, In p [za T; zb T; zc T] -> 0 < dot m (vsub (g u p) x)).
    { intros p J. pose proof (H T p I J) as K.
      replace (dot m (vsub (g u p) x)) with ((1 - u) * dot m (vsub (f p) x) + u * dot m m)
        by (unfold g, dot, vsub, vadd, vscale; simpl; ring).
      assert (M : 0 < dot m m).
      { pose proof (dot_pos m) as [M|M]; [exact M|]. exfalso. rewrite (dot_zero m) in K by lra. unfold dot in K. simpl in K. lra. }
      destruct (Rle_dec u (/ 2)); nra. }
    revert O. apply (aside_off m); apply P; simpl; auto.
Qed.

(* 3. so it is far away *)
Theorem winding_far f l : balanced l -> exists bound, forall x, bound < norm x -> winding x (map (image f) l) = 0.
Proof.
  intros B. assert (M : exists bound, 0 <= bound /\ forall T p, In T l -> In p [za T; zb T; zc T] -> norm (f p) <= bound).
  { clear. induction l as [|T l (M & P & H)]; [exists 0; split; [lra|intros T p []]|].
    pose proof (norm_pos (f (za T))). pose proof (norm_pos (f (zb T))). pose proof (norm_pos (f (zc T))).
    exists (M + norm (f (za T)) + norm (f (zb T)) + norm (f (zc T))). split; [lra|]. intros S p [<-|I] J.
    - destruct J as [<-|[<-|[<-|[]]]]; lra.
    - pose proof (H S p I J). lra. }
  destruct M as (M & P & H). exists M. intros x L. apply (winding_aside f l x (vscale (-1) x) B). intros T p I J.
  pose proof (H T p I J) as K. pose proof (cauchy x (f p)) as C. apply Rabs_le_between in C.
  replace (dot _ _) with (dot x x - dot x (f p)) by (unfold dot, vsub, vscale; simpl; ring).
  rewrite <- norm_sq. assert (norm x * norm (f p) < norm x * norm x) by (apply Rmult_lt_compat_l; lra). lra.
Qed.

(* 4. and where a way begins that leads there *)
Theorem winding_free f l way : balanced l -> steadyV way -> (forall u, 0 <= u -> ~ touches (way u) (map (image f) l)) ->
  (forall bound, exists u, forall v, u <= v -> bound < norm (way v)) -> winding (way 0) (map (image f) l) = 0.
Proof.
  intros B S N F. destruct (winding_far f l B) as (M & H). destruct (F M) as (u & U).
  transitivity (winding (way (Rmax 0 u)) (map (image f) l)); [|apply H, U, Rmax_r].
  apply (winding_steady (fun _ => f) way l 0 (Rmax 0 u) B); auto; [intros p; apply steady_fixed|apply Rmax_l|].
  intros v [V _]. apply N, V.
Qed.

(* 5. how often a triangle counts that a ray from x along d crosses or misses. u, v, w lead from x to its corners. It is missed
   where something points from x to all corners but not along d, or where the ray's line passes one edge on the one side
   and another one on the other, the triangle lies behind where the line goes through it there; else it counts up or down *)
Inductive crosses (d x : V) (T : tri) : Z -> Prop :=
  | aside m : dot m d <= 0 -> 0 < dot m (vsub (c0 T) x) -> 0 < dot m (vsub (c1 T) x) -> 0 < dot m (vsub (c2 T) x) ->
      crosses d x T 0
  | beside : (let u := vsub (c0 T) x in let v := vsub (c1 T) x in let w := vsub (c2 T) x in
      det d u v * det d v w < 0 \/ det d v w * det d w u < 0 \/ det d w u * det d u v < 0) -> crosses d x T 0
  | behind : (let u := vsub (c0 T) x in let v := vsub (c1 T) x in let w := vsub (c2 T) x in let vol := det u v w in
      det d u v * vol < 0 /\ det d v w * vol < 0 /\ det d w u * vol < 0) -> crosses d x T 0
  | up : (let u := vsub (c0 T) x in let v := vsub (c1 T) x in let w := vsub (c2 T) x in
      0 < det d u v /\ 0 < det d v w /\ 0 < det d w u /\ 0 < det u v w) -> crosses d x T 1
  | down : (let u := vsub (c0 T) x in let v := vsub (c1 T) x in let w := vsub (c2 T) x in
      det d u v < 0 /\ det d v w < 0 /\ det d w u < 0 /\ det u v w < 0) -> crosses d x T (-1).

Lemma crosses_follows d x T k : crosses d x T k -> follows d x T k.
Proof.
  intros [m D A B C|O|O|(A & B & C & V)|(A & B & C & V)].
  - apply follows_missed. intros h H.
    assert (E : forall p, 0 < dot m (vsub p x) -> 0 < dot m (vsub p (ray x d h))); [|apply (aside_off m); auto].
    intros p P. assert (h * dot m d <= 0) by (rewrite <- (Rmult_0_r h); apply Rmult_le_compat_l; auto).
    unfold ray, dot, vsub, vadd, vscale in *; cbn [vx vy vz] in *. lra.
  - apply follows_missed. intros h _. apply missed_beside, O.
  - apply follows_missed. intros h H. apply missed_behind; auto.
  - apply follows_crossed; [auto|]. cbv zeta. lra.
  - apply follows_crossed; [auto|]. cbv zeta. lra.
Qed.
(* and the point is on none of them *)
Lemma crosses_off d x T n : crosses d x T n -> ~ of_tri x T.
Proof.
  intros K O. assert (Flat : det (vsub (c0 T) x) (vsub (c1 T) x) (vsub (c2 T) x) = 0).
  { destruct O as (a & b & c & _ & _ & _ & S & ->). replace a with (1 - b - c) by lra.
    unfold det, dot, cross, vsub, mix, vadd, vscale. cbn [vx vy vz]. ring. }
  destruct K as [m _ A B C|H|H|H|H]; cbv zeta in *.
  - exact (aside_off m x T A B C O).
  - replace x with (ray x d 0) in O by (apply V_eq; unfold ray, vadd, vscale; simpl; ring). exact (missed_beside x d T 0 H O).
  - rewrite Flat in H. lra.
  - rewrite Flat in H. lra.
  - rewrite Flat in H. lra.
Qed.
Theorem winding_ray f l x d (count : ztri -> Z) : balanced l -> 0 < norm d ->
  (forall T, In T l -> crosses d x (image f T) (count T)) ->
  winding x (map (image f) l) = IZR (fold_right (fun T n => count T + n)%Z 0%Z l).
Proof.
  intros B D C. assert (D2 : 0 < dot d d) by (rewrite <- norm_sq; apply Rmult_lt_0_compat; exact D).
  destruct (followed f l x d count B) as (H & F); [intros T I; apply crosses_follows, C, I|].
  destruct (from_some_on l (fun T h => forall p, In p [za T; zb T; zc T] ->
    0 < dot (vscale (-1) d) (vsub (f p) (ray x d h)))) as (H' & A).
  { intros T _. apply (from_some_on [za T; zb T; zc T] (fun p h => 0 < dot (vscale (-1) d) (vsub (f p) (ray x d h)))).
    intros p _. exists (dot d (vsub (f p) x) / dot d d + 1). intros h L.
    replace (dot _ _) with (dot d d * (h - dot d (vsub (f p) x) / dot d d)).
    - apply Rmult_lt_0_compat; lra.
    - transitivity (h * dot d d - dot d (vsub (f p) x)); [field; lra|]. unfold ray, dot, vsub, vadd, vscale; cbn [vx vy vz]; ring. }
  rewrite (F (Rmax H H')), (winding_aside f l _ (vscale (-1) d)); [ring|exact B| |apply Rmax_l].
  intros T p I P. apply (A (Rmax H H') (Rmax_r H H') T I p P).
Qed.
