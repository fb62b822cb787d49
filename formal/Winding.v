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
Proof. Admitted.

(* 1. a whole number *)
Theorem winding_integer f l x : balanced l -> ~ touches x (map (image f) l) ->
  exists k : Z, winding x (map (image f) l) = IZR k.
Proof. Admitted.

(* 2. the corners and the point move, from s to e, and never touch: the number stays *)
Theorem winding_steady (f : R -> zv -> V) (x : R -> V) l s e : balanced l ->
  (forall p, steadyV (fun u => f u p)) -> steadyV x -> s <= e ->
  (forall u, s <= u <= e -> ~ touches (x u) (map (image (f u)) l)) ->
  winding (x s) (map (image (f s)) l) = winding (x e) (map (image (f e)) l).
Proof. Admitted.

(* if all corners are on one side of the point, it is 0 *)
Theorem winding_aside f l x m : balanced l ->
  (forall T p, In T l -> In p [za T; zb T; zc T] -> 0 < dot m (vsub (f p) x)) -> winding x (map (image f) l) = 0.
Proof. Admitted.

(* 3. so it is far away *)
Theorem winding_far f l : balanced l -> exists bound, forall x, bound < norm x -> winding x (map (image f) l) = 0.
Proof. Admitted.

(* 4. and where a way begins that leads there *)
Theorem winding_free f l way : balanced l -> steadyV way -> (forall u, 0 <= u -> ~ touches (way u) (map (image f) l)) ->
  (forall bound, exists u, forall v, u <= v -> bound < norm (way v)) -> winding (way 0) (map (image f) l) = 0.
Proof. Admitted.

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
  - apply follows_missed. intros h. apply (missed_aside d x T m h D A B C).
  - apply follows_missed. intros h _. apply missed_beside, O.
  - apply follows_missed. intros h H. apply missed_behind; auto.
  - apply follows_crossed; [auto|]. cbv zeta. lra.
  - apply follows_crossed; [auto|]. cbv zeta. lra.
Qed.
Theorem winding_ray f l x d (count : ztri -> Z) : balanced l -> 0 < norm d ->
  (forall T, In T l -> crosses d x (image f T) (count T)) ->
  winding x (map (image f) l) = IZR (fold_right (fun T n => count T + n)%Z 0%Z l).
Proof.
  intros B D C. assert (D2 : 0 < dot d d) by (rewrite <- norm2; apply Rmult_lt_0_compat; exact D).
  destruct (followed f l x d count B) as (H & F); [intros T I; apply crosses_follows, C, I|].
  destruct (from_some_on l (fun T h => forall p, In p [za T; zb T;
    zc T] -> 0 < dot (vscale (-1) d) (vsub (f p) (ray x d h)))) as (H' & A).
  { intros T _. apply (from_some_on [za T; zb T; zc T] (fun p h => 0 < dot (vscale (-1) d) (vsub (f p) (ray x d h)))).
    intros p _. exists (dot d (vsub (f p) x) / dot d d + 1). intros h L.
    replace (dot _ _) with (dot d d * (h - dot d (vsub (f p) x) / dot d d)).
    - apply Rmult_lt_0_compat; lra.
    - transitivity (h * dot d d - dot d (vsub (f p) x)); [field; lra|]. unfold ray, dot, vsub, vadd, vscale; cbn [vx vy vz]; ring. }
  rewrite (F (Rmax H H')), (winding_aside f l _ (vscale (-1) d)); [ring|exact B| |apply Rmax_l].
  intros T p I P. apply (A (Rmax H H') (Rmax_r H H') T I p P).
Qed.
