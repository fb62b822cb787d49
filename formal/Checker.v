(* Checker.v - an executable checker of FREE certificates (the bytes that nsvcd_certify writes, up to
   the rays), over any interval arithmetic of the Interval library, and the proof that what it accepts
   is free of collision. No rounding error is argued about: each number is an interval, and Interval
   proves that the true one is in it. Decisions that are no proof (which node opens, how it is cut, the
   shorter way round) are exact, or rounded as the C rounds. *)
From Coq Require Import Reals Lra Psatz List ZArith QArith Qreals Bool Permutation Mergesort Orders.
From Interval Require Import Real.Xreal Float.Basic Interval.Interval Missing.Stdlib.
From Svcd Require Export Inside.
Import ListNotations.
Local Open Scope R_scope.

(* ---- bits *)
Fixpoint bits_of_byte (k : nat) (z : Z) : list bool :=
  match k with O => [] | S k => Z.testbit z (Z.of_nat k) :: bits_of_byte k z end.
Definition bits_of (bytes : list Z) := flat_map (bits_of_byte 8) bytes.

Fixpoint read (k : nat) (acc : Z) (l : list bool) : option (Z * list bool) :=
  match k, l with
  | O, _ => Some (acc, l)
  | S _, [] => None
  | S k, b :: l => read k (2 * acc + if b then 1 else 0)%Z l
  end.

Fixpoint zeros (k : nat) (l : list bool) : option (nat * list bool) :=   (* at most k, then a 1 *)
  match k, l with
  | O, _ => Some (O, l)
  | S _, [] => None
  | S _, true :: l => Some (O, l)
  | S k, false :: l => match zeros k l with Some (n, l) => Some (S n, l) | None => None end
  end.

Definition copysign (m x : Z) : Z := if (x <? 0)%Z then (- Z.abs m)%Z else Z.abs m.
Definition unfolded (half x y : Z) : zv :=
  let z := (half - Z.abs x - Z.abs y)%Z in
  if (z <? 0)%Z then mkZ (copysign (half - Z.abs y) x) (copysign (half - Z.abs x) y) z else mkZ x y z.

Definition read_normal (ns : list zv) (l : list bool) : option (list zv * list bool) :=
  match zeros 7 l with
  | None => None
  | Some (k, l) =>
    if (k <? 7)%nat then let k := S k in
      Some (nth k ns (mkZ 0 0 0) :: firstn k ns ++ skipn (S k) ns, l)
    else
      let size := match l with
        | false :: l => Some (8%nat, l) | true :: false :: l => Some (16%nat, l)
        | true :: true :: l => Some (24%nat, l) | _ => None end in
      match size with
      | None => None
      | Some (n, l) =>
        match read n 0 l with
        | None => None
        | Some (x, l) => match read n 0 l with
          | None => None
          | Some (y, l) => let half := (2 ^ Z.of_nat (pred n) - 1)%Z in
            Some (unfolded half (x - half) (y - half) :: firstn 7 ns, l)
          end
        end
      end
  end.

(* ---- what a double holds of an integer, in units of any power of two: 53 bits, ties to even *)
Definition nearest (z : Z) : Z :=
  let m := Z.abs z in
  if (m <? 9007199254740992)%Z then z else
    let unit := (2 ^ (Z.log2 m - 52))%Z in
    let q := (m / unit)%Z in
    let twice := (2 * (m mod unit))%Z in
    let up := (if twice =? unit then Z.odd q else unit <? twice)%Z in
    (Z.sgn z * ((if up then q + 1 else q) * unit))%Z.

(* ---- what it answers *)
Inductive reason := Unfit | NotFree | EndsEarly | NotSeparated | TooDeep | OpensTriangles | Follows
  | NoTriangle | NotNear | NoEdge | NotPierced | TooNear | NotOutside | NoCorner | NotInside.
Inductive answer (A : Type) := Yes (a : A) | No (why : reason) (rest : list bool).
Arguments Yes {A}.
Arguments No {A}.

(* ---- sorting, for trees *)
Module Keyed <: TotalLeBool.
  Definition t := (Z * Z * ztri)%type.
  Definition leb (x y : t) := let '(k, i, _) := x in let '(l, j, _) := y in
    if (k =? l)%Z then (i <=? j)%Z else (k <=? l)%Z.
  Infix "<=?" := leb.
  Theorem leb_total : forall x y, leb x y = true \/ leb y x = true.
  Proof.
    intros [[k i] T] [[l j] U]. unfold leb. rewrite (Z.eqb_sym l k).
    destruct (k =? l)%Z; rewrite !Z.leb_le; lia.
  Qed.
End Keyed.
Module Sorted := Sort Keyed.

Module Make (I : IntervalOps).
Section Prec.
Variable prec : I.precision.

Definition inI i r := contains (I.convert i) (Xreal r).

Lemma in_Z z : inI (I.fromZ prec z) (IZR z).
Proof. apply I.fromZ_correct. Qed.
Lemma in_add i j x y : inI i x -> inI j y -> inI (I.add prec i j) (x + y).
Proof. apply (I.add_correct prec i j (Xreal x) (Xreal y)). Qed.
Lemma in_sub i j x y : inI i x -> inI j y -> inI (I.sub prec i j) (x - y).
Proof. apply (I.sub_correct prec i j (Xreal x) (Xreal y)). Qed.
Lemma in_mul i j x y : inI i x -> inI j y -> inI (I.mul prec i j) (x * y).
Proof. apply (I.mul_correct prec i j (Xreal x) (Xreal y)). Qed.
Lemma in_sqr i x : inI i x -> inI (I.sqr prec i) (x * x).
Proof. apply (I.sqr_correct prec i (Xreal x)). Qed.
Lemma nan_in i : contains (I.convert i) Xnan -> forall r, inI i r.
Proof. unfold inI. destruct (I.convert i); simpl; tauto. Qed.
Lemma in_div i j x y : inI i x -> inI j y -> inI (I.div prec i j) (x / y).
Proof.
  intros A B. pose proof (I.div_correct prec i j (Xreal x) (Xreal y) A B) as H. simpl in H.
  unfold Xdiv' in H. destruct (is_zero y); [apply nan_in|]; exact H.
Qed.
Lemma in_sqrt i x : inI i x -> inI (I.sqrt prec i) (sqrt x).
Proof.
  intros A. pose proof (I.sqrt_correct prec i (Xreal x) A) as H. simpl in H.
  unfold Xsqrt' in H. try (destruct (is_negative x)); try (apply nan_in; exact H); exact H.
Qed.
Lemma in_sin i x : inI i x -> inI (I.sin prec i) (sin x).
Proof. apply (I.sin_correct prec i (Xreal x)). Qed.
Lemma in_atan i x : inI i x -> inI (I.atan prec i) (atan x).
Proof. apply (I.atan_correct prec i (Xreal x)). Qed.
Lemma in_nai r : inI I.nai r.
Proof. unfold inI. rewrite I.nai_correct. exact Logic.I. Qed.
Lemma in_join_l i j r : inI i r -> inI (I.join i j) r.
Proof. intros; apply I.join_correct; auto. Qed.
Lemma in_join_r i j r : inI j r -> inI (I.join i j) r.
Proof. intros; apply I.join_correct; auto. Qed.
Lemma in_between i x y z : inI i x -> inI i y -> x <= z <= y -> inI i z.
Proof. intros A B. apply (contains_connected (I.convert i) x y A B). Qed.
Lemma in_mix i x y z a b c : inI i x -> inI i y -> inI i z ->
  0 <= a -> 0 <= b -> 0 <= c -> a + b + c = 1 -> inI i (a * x + (b * y + c * z)).
Proof.
  intros X Y Z A B C S.
  set (lo := Rmin x (Rmin y z)). set (hi := Rmax x (Rmax y z)).
  assert (inI i lo) by (unfold lo, Rmin; repeat destruct Rle_dec; auto).
  assert (inI i hi) by (unfold hi, Rmax; repeat destruct Rle_dec; auto).
  apply (in_between i lo hi); auto.
  assert (lo <= x /\ lo <= y /\ lo <= z /\ x <= hi /\ y <= hi /\ z <= hi) as (?&?&?&?&?&?).
  { unfold lo, hi, Rmin, Rmax; repeat destruct Rle_dec; lra. }
  split.
  - replace lo with (a * lo + (b * lo + c * lo)) by (replace a with (1 - b - c) by lra; ring). nra.
  - replace hi with (a * hi + (b * hi + c * hi)) by (replace a with (1 - b - c) by lra; ring). nra.
Qed.

Definition positive_i i := match I.sign_strict i with Xgt => true | _ => false end.
Lemma positive_ok i r : positive_i i = true -> inI i r -> 0 < r.
Proof.
  unfold positive_i. pose proof (I.sign_strict_correct i) as H. destruct (I.sign_strict i); try discriminate.
  intros _ A. apply (H _ A).
Qed.

Definition iQ (q : Q) := I.div prec (I.fromZ prec (Qnum q)) (I.fromZ prec (Zpos (Qden q))).
Lemma in_Q q : inI (iQ q) (Q2R q).
Proof. apply in_div; apply in_Z. Qed.

Create HintDb iv.
Hint Resolve in_Z in_add in_sub in_mul in_sqr in_div in_sqrt in_sin in_atan in_Q : iv.

(* ---- vectors of intervals *)
Record IV := mkIV { ix : I.type; iy : I.type; iz : I.type }.
Definition inV i v := inI (ix i) (vx v) /\ inI (iy i) (vy v) /\ inI (iz i) (vz v).
Definition idot a b := I.add prec (I.add prec (I.mul prec (ix a) (ix b)) (I.mul prec (iy a) (iy b))) (I.mul prec (iz a) (iz b)).
Definition iadd a b := mkIV (I.add prec (ix a) (ix b)) (I.add prec (iy a) (iy b)) (I.add prec (iz a) (iz b)).
Definition isub a b := mkIV (I.sub prec (ix a) (ix b)) (I.sub prec (iy a) (iy b)) (I.sub prec (iz a) (iz b)).
Definition iscale k a := mkIV (I.mul prec k (ix a)) (I.mul prec k (iy a)) (I.mul prec k (iz a)).
Definition icross a b := mkIV
  (I.sub prec (I.mul prec (iy a) (iz b)) (I.mul prec (iz a) (iy b)))
  (I.sub prec (I.mul prec (iz a) (ix b)) (I.mul prec (ix a) (iz b)))
  (I.sub prec (I.mul prec (ix a) (iy b)) (I.mul prec (iy a) (ix b))).
Definition inorm a := I.sqrt prec (I.add prec (I.add prec (I.sqr prec (ix a)) (I.sqr prec (iy a))) (I.sqr prec (iz a))).
Definition ijoin a b := mkIV (I.join (ix a) (ix b)) (I.join (iy a) (iy b)) (I.join (iz a) (iz b)).
Lemma in_dot i j a b : inV i a -> inV j b -> inI (idot i j) (dot a b).
Proof. intros (A & B & C) (D & E & F). unfold idot, dot. auto 10 with iv. Qed.
Lemma in_vadd i j a b : inV i a -> inV j b -> inV (iadd i j) (vadd a b).
Proof. intros (A & B & C) (D & E & F). repeat split; simpl; auto with iv. Qed.
Lemma in_vsub i j a b : inV i a -> inV j b -> inV (isub i j) (vsub a b).
Proof. intros (A & B & C) (D & E & F). repeat split; simpl; auto with iv. Qed.
Lemma in_vscale k i r a : inI k r -> inV i a -> inV (iscale k i) (vscale r a).
Proof. intros K (A & B & C). repeat split; simpl; auto with iv. Qed.
Lemma in_cross i j a b : inV i a -> inV j b -> inV (icross i j) (cross a b).
Proof. intros (A & B & C) (D & E & F). repeat split; simpl; auto with iv. Qed.
Lemma in_norm i a : inV i a -> inI (inorm i) (norm a).
Proof. intros (A & B & C). unfold inorm, norm, dot. auto 10 with iv. Qed.
Hint Resolve in_dot in_vadd in_vsub in_vscale in_cross in_norm : iv.

(* ---- nodes *)
Definition iZ d z := I.div prec (I.fromZ prec z) (I.fromZ prec (Zpos d)).
Definition ipoint d p := mkIV (iZ d (zx p)) (iZ d (zy p)) (iZ d (zz p)).
Lemma in_point d p : inV (ipoint d p) (pointR d p).
Proof. repeat split; apply in_div; apply in_Z. Qed.

Definition corners (l : list ztri) := flat_map (fun T => [za T; zb T; zc T]) l.
Definition low (f : zv -> Z) (l : list zv) := match l with [] => 0%Z | p :: l => fold_left (fun m q => Z.min m (f q)) l (f p) end.
Definition high (f : zv -> Z) (l : list zv) := match l with [] => 0%Z | p :: l => fold_left (fun m q => Z.max m (f q)) l (f p) end.

Lemma fold_min (f : zv -> Z) l m : (fold_left (fun m q => Z.min m (f q)) l m <= m)%Z /\
  forall p, In p l -> (fold_left (fun m q => Z.min m (f q)) l m <= f p)%Z.
Proof.
  revert m. induction l as [|q l IH]; simpl; intros m; [split; [lia|tauto]|].
  destruct (IH (Z.min m (f q))) as [A B]. split; [lia|]. intros p [->|H]; [lia|apply B; auto].
Qed.
Lemma fold_max (f : zv -> Z) l m : (m <= fold_left (fun m q => Z.max m (f q)) l m)%Z /\
  forall p, In p l -> (f p <= fold_left (fun m q => Z.max m (f q)) l m)%Z.
Proof.
  revert m. induction l as [|q l IH]; simpl; intros m; [split; [lia|tauto]|].
  destruct (IH (Z.max m (f q))) as [A B]. split; [lia|]. intros p [->|H]; [lia|apply B; auto].
Qed.
Lemma low_ok (f : zv -> Z) l p : In p l -> (low f l <= f p)%Z.
Proof. destruct l as [|q l]; simpl; [tauto|]. destruct (fold_min f l (f q)) as [A B]. intros [->|H]; auto. Qed.
Lemma high_ok (f : zv -> Z) l p : In p l -> (f p <= high f l)%Z.
Proof. destruct l as [|q l]; simpl; [tauto|]. destruct (fold_max f l (f q)) as [A B]. intros [->|H]; auto. Qed.

Record node := mkNode { of_tris : list ztri; in_units : positive; lowest : zv; highest : zv; side : Q }.
Definition box (n : node) := ijoin (ipoint (in_units n) (lowest n)) (ipoint (in_units n) (highest n)).
Definition few (l : list ztri) := (length l <=? 24)%nat.
(* of few triangles the corners count, of more the box *)
Definition points (n : node) := if few (of_tris n) then map (ipoint (in_units n)) (corners (of_tris n)) else [box n].
Definition node_of (d : positive) (scale : Q) (l : list ztri) : node :=
  let c := corners l in
  let lo := mkZ (low zx c) (low zy c) (low zz c) in
  let hi := mkZ (high zx c) (high zy c) (high zz c) in
  mkNode l d lo hi
    (nearest (Qnum scale * nearest (Z.max (zx hi - zx lo) (Z.max (zy hi - zy lo) (zz hi - zz lo)))) # (Qden scale * d))%Q.

Inductive tree := Leaf (n : node) | Fork (n : node) (l r : tree).
Definition root t := match t with Leaf n => n | Fork n _ _ => n end.

Definition key (f : zv -> Z) (T : ztri) : Z := nearest (nearest (f (za T) + f (zb T)) + f (zc T)).
Definition keyed (f : zv -> Z) (l : list (Z * ztri)) : list Keyed.t :=
  map (fun e => (key f (snd e), fst e, snd e)) l.
Definition spread (l : list Keyed.t) : Z := match l with
  | [] => 0%Z
  | (k, _, _) :: l => let '(a, b) := fold_left (fun m e => let '(k, _, _) := e in (Z.min (fst m) k, Z.max (snd m) k)) l (k, k) in nearest (b - a)
  end.
Definition cut (l : list (Z * ztri)) : list (Z * ztri) * list (Z * ztri) :=
  let x := keyed zx l in let y := keyed zy l in let z := keyed zz l in
  let sx := spread x in let sy := spread y in let sz := spread z in
  let widest := if (sy >? sx)%Z then (if (sz >? sy)%Z then z else y) else (if (sz >? sx)%Z then z else x) in
  let s := map (fun e => let '(_, i, T) := e in (i, T)) (Sorted.sort widest) in
  let half := Nat.div2 (length s) in (firstn half s, skipn half s).
Fixpoint build (fuel : nat) (d : positive) (scale : Q) (l : list (Z * ztri)) : tree :=
  let n := node_of d scale (map snd l) in
  match fuel, l with
  | S fuel, _ :: _ :: _ => let '(a, b) := cut l in Fork n (build fuel d scale a) (build fuel d scale b)
  | _, _ => Leaf n
  end.

Inductive good (d : positive) (scale : Q) : tree -> Prop :=
  | good_leaf l : good d scale (Leaf (node_of d scale l))
  | good_fork l a b : good d scale a -> good d scale b ->
      (forall T, In T l -> In T (of_tris (root a)) \/ In T (of_tris (root b))) ->
      good d scale (Fork (node_of d scale l) a b).

Lemma keyed_in (f : zv -> Z) l i T : In (i, T) l -> exists k, In (k, i, T) (keyed f l).
Proof.
  intros H. exists (key f T). apply (in_map (fun e => (key f (snd e), fst e, snd e)) l (i, T) H).
Qed.

Lemma cut_ok l i T : In (i, T) l -> In (i, T) (fst (cut l)) \/ In (i, T) (snd (cut l)).
Proof.
  intros H. unfold cut. match goal with |- context [Sorted.sort ?v] => set (w := v) end.
  assert (exists k, In (k, i, T) w) as [k K] by (unfold w; destruct (_ >? _)%Z; destruct (_ >? _)%Z; apply keyed_in; auto).
  simpl. apply in_app_or. rewrite firstn_skipn. apply in_map_iff. exists (k, i, T). split; auto.
  eapply Permutation_in; [apply Sorted.Permuted_sort|auto].
Qed.

Lemma build_root fuel d scale l : root (build fuel d scale l) = node_of d scale (map snd l).
Proof.
  destruct fuel, l as [|p [|q l]]; reflexivity.
Qed.

Lemma build_good fuel d scale l : good d scale (build fuel d scale l).
Proof.
  revert l. induction fuel; intros l.
  - destruct l as [|? [|? ?]]; apply good_leaf.
  - destruct l as [|p [|q l]]; try apply good_leaf.
    cbn [build]. pose proof (cut_ok (p :: q :: l)) as C. destruct (cut _) as [a b].
    apply good_fork; auto. intros T H. rewrite !build_root. cbn [of_tris node_of].
    apply in_map_iff in H as ([i U] & E & H). simpl in E; subst U.
    destruct (C i T H); [left|right]; apply in_map_iff; exists (i, T); auto.
Qed.

Definition is_of d l x := exists T, In T l /\ of_tri x (triR d T).

Lemma corners_in l T p : In T l -> p = za T \/ p = zb T \/ p = zc T -> In p (corners l).
Proof.
  intros H E. apply in_flat_map. exists T. split; auto. simpl. intuition.
Qed.

Lemma in_join_box d lo hi z : (lo <= z <= hi)%Z -> inI (I.join (iZ d lo) (iZ d hi)) (IZR z / IZR (Zpos d)).
Proof.
  intros [A B]. apply (in_between _ (IZR lo / IZR (Zpos d)) (IZR hi / IZR (Zpos d))).
  - apply in_join_l, in_div; apply in_Z.
  - apply in_join_r, in_div; apply in_Z.
  - assert (0 < / IZR (Zpos d)) by (apply Rinv_0_lt_compat, IZR_lt; lia).
    apply IZR_le in A, B. split; apply Rmult_le_compat_r; lra.
Qed.

Lemma in_box d scale l x : is_of d l x -> inV (box (node_of d scale l)) x.
Proof.
  intros (T & H & a & b & c & A & B & C & S & ->).
  pose proof (corners_in l T (za T) H (or_introl eq_refl)) as Ha.
  pose proof (corners_in l T (zb T) H (or_intror (or_introl eq_refl))) as Hb.
  pose proof (corners_in l T (zc T) H (or_intror (or_intror eq_refl))) as Hc.
  unfold box; repeat split; cbn; apply in_mix; auto; apply in_join_box; split;
    solve [apply (low_ok zx); auto | apply (low_ok zy); auto | apply (low_ok zz); auto
         | apply (high_ok zx); auto | apply (high_ok zy); auto | apply (high_ok zz); auto].
Qed.

(* what holds a number for each of some points holds all numbers between: how far a node reaches along
   a direction, and how far it is from an axis through the origin *)
Definition joins (f : IV -> I.type) (l : list IV) : I.type := match l with
  | [] => I.nai
  | p :: l => fold_left (fun m q => I.join m (f q)) l (f p)
  end.
Definition heights (w : IV) := joins (idot w).
Definition aside (axis : IV) (l : list IV) := I.join (I.fromZ prec 0) (joins (fun p => inorm (icross p axis)) l).
Lemma joins_fold (f : IV -> I.type) l m r : inI m r \/ (exists q, In q l /\ inI (f q) r) ->
  inI (fold_left (fun m q => I.join m (f q)) l m) r.
Proof.
  revert m. induction l as [|q l IH]; simpl; intros m.
  - intros [H|(q & [] & _)]; auto.
  - intros [H|(p & [->|H] & E)]; apply IH.
    + left; apply in_join_l; auto.
    + left; apply in_join_r; auto.
    + right; exists p; auto.
Qed.
Lemma joins_in (f : IV -> I.type) l r q : In q l -> inI (f q) r -> inI (joins f l) r.
Proof.
  destruct l as [|p l]; simpl; [tauto|]. intros [->|H] E; apply joins_fold; eauto.
Qed.
(* of few triangles a number at the corners, of more one of the box *)
Lemma joins_corner (f : IV -> I.type) d scale l T p r : few l = true -> In T l -> p = za T \/ p = zb T \/ p = zc T ->
  inI (f (ipoint d p)) r -> inI (joins f (points (node_of d scale l))) r.
Proof.
  intros F H E. unfold points. cbn [of_tris in_units node_of]. rewrite F. apply joins_in.
  apply in_map_iff. exists p. split; auto. apply (corners_in l T); auto.
Qed.
Lemma joins_box (f : IV -> I.type) d scale l r : few l = false ->
  inI (f (box (node_of d scale l))) r -> inI (joins f (points (node_of d scale l))) r.
Proof. intros F. unfold points. cbn [of_tris node_of]. rewrite F. apply joins_in. left; reflexivity. Qed.

Lemma in_heights d scale l w wR x : inV w wR -> is_of d l x ->
  inI (heights w (points (node_of d scale l))) (dot wR x).
Proof.
  intros W H. destruct (few l) eqn:F.
  - destruct H as (T & H & a & b & c & A & B & C & S & ->).
    replace (dot wR _) with (a * dot wR (c0 (triR d T)) + (b * dot wR (c1 (triR d T)) + c * dot wR (c2 (triR d T))))
      by (unfold mix, dot, vadd, vscale; simpl; ring).
    apply in_mix; auto; [apply (joins_corner _ d scale l T (za T))|apply (joins_corner _ d scale l T (zb T))
      |apply (joins_corner _ d scale l T (zc T))]; auto; apply (in_dot w _ wR (pointR d _)); auto; apply in_point.
  - apply joins_box; auto. apply in_dot; auto. apply in_box; auto.
Qed.

Lemma in_aside d scale l w wR x : inV w wR -> is_of d l x ->
  inI (aside w (points (node_of d scale l))) (norm (cross x wR)).
Proof.
  intros W H. unfold aside. destruct (few l) eqn:F.
  - destruct H as (T & H & a & b & c & A & B & C & S & ->).
    eapply in_between; [apply in_join_l, in_Z|apply in_join_r|split; [apply norm_pos|apply (cross_mix a b c (triR d T) wR); auto]].
    apply in_mix; auto; [apply (joins_corner _ d scale l T (za T))|apply (joins_corner _ d scale l T (zb T))
      |apply (joins_corner _ d scale l T (zc T))]; auto; apply in_norm, (in_cross _ _ (pointR d _)); auto; apply in_point.
  - apply in_join_r, joins_box; auto. apply in_norm, in_cross; auto. apply in_box; auto.
Qed.

(* ---- where a body is *)
Record IQ4 := mkI4 { i1 : I.type; i2 : I.type; i3 : I.type; i4 : I.type }.
Definition inQ4 i q := inI (i1 i) (qx q) /\ inI (i2 i) (qy q) /\ inI (i3 i) (qz q) /\ inI (i4 i) (qw q).
Definition i4sqr a := I.add prec (I.add prec (I.add prec (I.sqr prec (i1 a)) (I.sqr prec (i2 a))) (I.sqr prec (i3 a))) (I.sqr prec (i4 a)).
Definition i4comb s a t b := mkI4 (I.add prec (I.mul prec s (i1 a)) (I.mul prec t (i1 b))) (I.add prec (I.mul prec s (i2 a)) (I.mul prec t (i2 b)))
  (I.add prec (I.mul prec s (i3 a)) (I.mul prec t (i3 b))) (I.add prec (I.mul prec s (i4 a)) (I.mul prec t (i4 b))).
Definition i4scale s a := mkI4 (I.mul prec s (i1 a)) (I.mul prec s (i2 a)) (I.mul prec s (i3 a)) (I.mul prec s (i4 a)).
Lemma in_4sqr i q : inQ4 i q -> inI (i4sqr i) (qdot q q).
Proof. intros (A & B & C & D). unfold i4sqr, qdot. auto 10 with iv. Qed.
Lemma in_4comb s a t b sr ar tr br : inI s sr -> inQ4 a ar -> inI t tr -> inQ4 b br -> inQ4 (i4comb s a t b) (qcomb sr ar tr br).
Proof. intros ? (A & B & C & D) ? (E & F & G & H). repeat split; simpl; auto with iv. Qed.
Lemma in_4scale s a sr ar : inI s sr -> inQ4 a ar -> inQ4 (i4scale s a) (qscale sr ar).
Proof. intros ? (A & B & C & D). repeat split; simpl; auto with iv. Qed.

Definition i4_of p := mkI4 (iQ (hx p)) (iQ (hy p)) (iQ (hz p)) (iQ (hw p)).
Lemma in_4_of p : inQ4 (i4_of p) (quatR p).
Proof. repeat split; apply in_Q. Qed.
Definition one := I.fromZ prec 1.
Definition i4unit a := i4scale (I.div prec one (I.sqrt prec (i4sqr a))) a.
Lemma in_4unit i q : inQ4 i q -> inQ4 (i4unit i) (unitq q).
Proof.
  intros H. apply in_4scale; auto. replace (/ sqrt (qdot q q)) with (1 / sqrt (qdot q q)) by (unfold Rdiv; ring).
  apply in_div; [apply in_Z|]. apply in_sqrt, in_4sqr, H.
Qed.

(* exact decisions on quaternions *)
Definition qdotQ a b := (hx a * hx b + hy a * hy b + hz a * hz b + hw a * hw b)%Q.
Lemma qdotQ_R a b : Q2R (qdotQ a b) = qdot (quatR a) (quatR b).
Proof. unfold qdotQ, qdot; simpl. rewrite !Q2R_plus, !Q2R_mult. reflexivity. Qed.
Definition negQ p := mkPose (px p) (py p) (pz p) (- hx p) (- hy p) (- hz p) (- hw p).
Definition shorterQ a b := if Qle_bool 0 (qdotQ a b) then b else negQ b.
Lemma Q2R_0 : Q2R 0 = 0. Proof. unfold Q2R; simpl; lra. Qed.
Lemma Q2R_1 : Q2R 1 = 1. Proof. unfold Q2R; simpl; lra. Qed.
Lemma shorterQ_R a b : quatR (shorterQ a b) = shorter (quatR a) (quatR b).
Proof.
  unfold shorterQ, shorter. rewrite <- qdotQ_R. destruct (Qle_bool 0 (qdotQ a b)) eqn:E.
  - apply Qle_bool_iff, Qle_Rle in E. rewrite Q2R_0 in E. destruct Rlt_dec; auto; lra.
  - assert (qdotQ a b < 0)%Q.
    { apply Qnot_le_lt. intros H. apply Qle_bool_iff in H. congruence. }
    apply Qlt_Rlt in H. rewrite Q2R_0 in H. destruct Rlt_dec; [|lra].
    unfold quatR, qscale; simpl. rewrite !Q2R_opp. f_equal; ring.
Qed.

(* a piece, made ready *)
Record axes := mkAxes { in_body : IV; in_world : IV; square : I.type }.
Record ready := mkReady { of_piece : qpiece; rests : bool; from : IQ4; to : IQ4; half : I.type;
  turn : option axes; at0 : IV; at1 : IV }.
Definition axes_of a b :=
  let d x y := I.sub prec (I.mul prec (i4 a) (x b)) (I.mul prec (i4 b) (x a)) in
  let l := mkIV (d i1 i1) (d i2 i2) (d i3 i3) in
  let v := icross (mkIV (i1 a) (i2 a) (i3 a)) (mkIV (i1 b) (i2 b) (i3 b)) in
  let w := isub l v in
  let n := I.add prec (I.add prec (I.sqr prec (ix w)) (I.sqr prec (iy w))) (I.sqr prec (iz w)) in
  if positive_i n then Some (mkAxes w (iadd l v) n) else None.
Lemma in_axes a b aR bR o : inQ4 a aR -> inQ4 b bR -> axes_of a b = Some o ->
  inV (in_body o) (body_axis aR bR) /\ inV (in_world o) (world_axis aR bR) /\
  inI (square o) (dot (body_axis aR bR) (body_axis aR bR)).
Proof.
  intros (A & B & C & D) (E & F & G & H) S. unfold axes_of in S. destruct (positive_i _); [|discriminate].
  injection S as <-. cbn [in_body in_world square].
  assert (Body : inV (isub (mkIV (I.sub prec (I.mul prec (i4 a) (i1 b)) (I.mul prec (i4 b) (i1 a)))
      (I.sub prec (I.mul prec (i4 a) (i2 b)) (I.mul prec (i4 b) (i2 a)))
      (I.sub prec (I.mul prec (i4 a) (i3 b)) (I.mul prec (i4 b) (i3 a))))
      (icross (mkIV (i1 a) (i2 a) (i3 a)) (mkIV (i1 b) (i2 b) (i3 b)))) (body_axis aR bR))
    by (repeat split; simpl; auto 10 with iv).
  split; [exact Body|split].
  - repeat split; simpl; auto 10 with iv.
  - destruct Body as (X & Y & Z). unfold dot. auto 10 with iv.
Qed.
Definition same_turn a b := Qeq_bool (hx a) (hx b) && Qeq_bool (hy a) (hy b) && Qeq_bool (hz a) (hz b) && Qeq_bool (hw a) (hw b).
Lemma same_turn_R p q : same_turn p q = true -> quatR p = quatR q.
Proof.
  unfold same_turn. rewrite !andb_true_iff. intros (((A & B) & C) & D).
  apply Qeq_bool_iff, Qeq_eqR in A, B, C, D. unfold quatR. f_equal; auto.
Qed.
Definition ipos p := mkIV (iQ (px p)) (iQ (py p)) (iQ (pz p)).
Definition two := I.fromZ prec 2.
Definition minus_one := I.fromZ prec (-1).
Definition make_ready m :=
  let a := i4unit (i4_of (pose_from m)) in
  let b := i4unit (i4_of (shorterQ (pose_from m) (pose_to m))) in
  let d := i4comb one b minus_one a in
  let s := i4comb one b one a in
  mkReady m (same_turn (pose_from m) (pose_to m)) a b
    (I.mul prec two (I.atan prec (I.div prec (I.sqrt prec (i4sqr d)) (I.sqrt prec (i4sqr s)))))
    (axes_of a b) (ipos (pose_from m)) (ipos (pose_to m)).

Definition Qlt_bool a b := negb (Qle_bool b a).
Definition sound_piece m := Qlt_bool (t_from m) (t_to m) && Qlt_bool 0 (qdotQ (pose_from m) (pose_from m))
  && Qlt_bool 0 (qdotQ (pose_to m) (pose_to m)).

Lemma Qlt_bool_R a b : Qlt_bool a b = true -> Q2R a < Q2R b.
Proof.
  unfold Qlt_bool. rewrite negb_true_iff. intros E. apply Qlt_Rlt, Qnot_le_lt.
  intros H. apply Qle_bool_iff in H. congruence.
Qed.

Lemma sound_R s m : Qle_bool 0 s = true -> sound_piece m = true -> well_formed (pieceR s m) /\
  0 <= qdot (unitq (quatR (pose_from m))) (unitq (shorter (quatR (pose_from m)) (quatR (pose_to m)))) /\
  0 < qdot (quatR (pose_from m)) (quatR (pose_from m)).
Proof.
  unfold sound_piece. rewrite !andb_true_iff. intros S ((T & A) & B).
  apply Qlt_bool_R in T, A, B. rewrite qdotQ_R, Q2R_0 in A, B. apply Qle_bool_iff, Qle_Rle in S. rewrite Q2R_0 in S.
  repeat split; simpl; auto; try apply unitq_unit; auto.
  - rewrite shorter_norm; auto.
  - apply shorter_dot; auto.
Qed.

Lemma in_4_to m : inQ4 (to (make_ready m)) (unitq (shorter (quatR (pose_from m)) (quatR (pose_to m)))).
Proof. simpl. rewrite <- shorterQ_R. apply in_4unit, in_4_of. Qed.

Lemma in_half s m : Qle_bool 0 s = true -> sound_piece m = true ->
  inI (half (make_ready m)) (angle (q0 (pieceR s m)) (q1 (pieceR s m))).
Proof.
  intros S M. destruct (sound_R s m S M) as ((_ & _ & A & B) & D & _). simpl in A, B.
  rewrite angle_atan by auto.
  apply in_mul; [apply in_Z|]. apply in_atan, in_div; apply in_sqrt, in_4sqr, in_4comb; try apply in_Z;
    try apply in_4_to; apply in_4unit, in_4_of.
Qed.

(* the rows of scale R, and the origin *)
Record ipose := mkIP { r0 : IV; r1 : IV; r2 : IV; org : IV }.
Definition inPose ip m t := exists R0 R1 R2, inV (r0 ip) R0 /\ inV (r1 ip) R1 /\ inV (r2 ip) R2 /\
  inV (org ip) (origin m t) /\
  forall x, place m t x = vadd (mkV (dot R0 x) (dot R1 x) (dot R2 x)) (origin m t).

Definition nai3 := mkIV I.nai I.nai I.nai.

Definition i2mul a b := I.mul prec two (I.add prec a b).
Definition i2sub a b := I.mul prec two (I.sub prec a b).
Definition irows (s : I.type) (q : IQ4) (o : IV) : ipose :=
  let n := i4sqr q in
  if positive_i n then
    let k := I.div prec s n in
    let '(mkI4 x y z w) := q in
    let mul := I.mul prec in let sqr := I.sqr prec in
    mkIP (iscale k (mkIV (I.sub prec n (i2mul (sqr y) (sqr z))) (i2sub (mul x y) (mul z w)) (i2mul (mul x z) (mul y w))))
         (iscale k (mkIV (i2mul (mul x y) (mul z w)) (I.sub prec n (i2mul (sqr x) (sqr z))) (i2sub (mul y z) (mul x w))))
         (iscale k (mkIV (i2sub (mul x z) (mul y w)) (i2mul (mul y z) (mul x w)) (I.sub prec n (i2mul (sqr x) (sqr y))))) o
  else mkIP nai3 nai3 nai3 o.

Lemma in_rows s sR q qR o : inI s sR -> inQ4 q qR ->
  org (irows s q o) = o /\
  (0 < qdot qR qR -> inV (r0 (irows s q o)) (vscale sR (row0 qR)) /\ inV (r1 (irows s q o)) (vscale sR (row1 qR)) /\
    inV (r2 (irows s q o)) (vscale sR (row2 qR))) /\
  (~ 0 < qdot qR qR -> forall v, inV (r0 (irows s q o)) v /\ inV (r1 (irows s q o)) v /\ inV (r2 (irows s q o)) v).
Proof.
  intros S Q. pose proof (in_4sqr q qR Q) as N. unfold irows.
  destruct (positive_i (i4sqr q)) eqn:P.
  - pose proof (positive_ok _ _ P N) as L. destruct q as [x y z w]. destruct Q as (X & Y & Z & W). simpl in X, Y, Z, W.
    split; [reflexivity|split; [intros _|intros H; contradiction]].
    assert (E : forall v, vscale sR (vscale (/ qdot qR qR) v) = vscale (sR / qdot qR qR) v)
      by (intros; apply V_eq; unfold vscale; simpl; unfold Rdiv; ring).
    unfold row0, row1, row2. rewrite !E.
    assert (K : inI (I.div prec s (i4sqr (mkI4 x y z w))) (sR / qdot qR qR)) by (apply in_div; auto).
    assert (M : forall a b c d, inI a c -> inI b d -> inI (i2mul a b) (2 * (c + d))) by (intros; unfold i2mul; apply in_mul; [apply in_Z|auto with iv]).
    assert (B : forall a b c d, inI a c -> inI b d -> inI (i2sub a b) (2 * (c - d))) by (intros; unfold i2sub; apply in_mul; [apply in_Z|auto with iv]).
    split; [|split]; cbn [r0 r1 r2]; apply in_vscale; auto; (split; [|split]); cbn [ix iy iz vx vy vz];
      first [apply in_sub; auto; apply M | apply M | apply B]; auto with iv.
  - split; [reflexivity|split; intros; repeat split; apply in_nai].
Qed.

Definition ipose_at (s : Q) (rd : ready) (t : Q) : ipose :=
  let m := of_piece rd in
  let u := Qred ((t - t_from m) / (t_to m - t_from m)) in
  let iu := iQ u in let iv := iQ (Qred (1 - u)) in
  let q := if rests rd then from rd else
    i4comb (I.sin prec (I.mul prec iv (half rd))) (from rd) (I.sin prec (I.mul prec iu (half rd))) (to rd) in
  irows (iQ s) q (iadd (iscale iv (at0 rd)) (iscale iu (at1 rd))).

Lemma Q2R_red q : Q2R (Qred q) = Q2R q.
Proof. apply Qeq_eqR, Qred_correct. Qed.

Lemma share_R s m t : Q2R (t_from m) < Q2R (t_to m) ->
  Q2R (Qred ((t - t_from m) / (t_to m - t_from m))) = share (pieceR s m) (Q2R t).
Proof.
  intros L. rewrite Q2R_red, Q2R_div, !Q2R_minus; [reflexivity|].
  intros E. apply Qeq_eqR in E. rewrite Q2R_minus, Q2R_0 in E. lra.
Qed.

Lemma in_pos p : inV (ipos p) (posR p).
Proof. repeat split; apply in_Q. Qed.

Lemma rows_of_rot p q : (forall v, rot p v = rot q v) -> row0 p = row0 q /\ row1 p = row1 q /\ row2 p = row2 q.
Proof.
  intros H. pose proof (H (mkV 1 0 0)) as X. pose proof (H (mkV 0 1 0)) as Y. pose proof (H (mkV 0 0 1)) as Z.
  rewrite !rot_rows in X, Y, Z. unfold dot in X, Y, Z.
  pose proof (f_equal vx X). pose proof (f_equal vy X). pose proof (f_equal vz X).
  pose proof (f_equal vx Y). pose proof (f_equal vy Y). pose proof (f_equal vz Y).
  pose proof (f_equal vx Z). pose proof (f_equal vy Z). pose proof (f_equal vz Z).
  clear X Y Z. cbn [vx vy vz] in *.
  split; [|split]; apply V_eq; lra.
Qed.

Lemma rests_R s m u : sound_piece m = true -> Qle_bool 0 s = true -> rests (make_ready m) = true ->
  slerp (q0 (pieceR s m)) (q1 (pieceR s m)) u = q0 (pieceR s m).
Proof.
  intros M S E. destruct (sound_R s m S M) as ((_ & _ & A & _) & _ & P). simpl in *.
  apply same_turn_R in E. rewrite <- E. assert (T : shorter (quatR (pose_from m)) (quatR (pose_from m)) = quatR (pose_from m)).
  { unfold shorter. destruct Rlt_dec; auto. lra. }
  rewrite T. unfold slerp, angle. rewrite A, acos_1, sin_0. destruct (Req_EM_T 0 0); [auto|contradiction].
Qed.

Lemma in_pose s m t : sound_piece m = true -> Qle_bool 0 s = true ->
  inPose (ipose_at s (make_ready m) t) (pieceR s m) (Q2R t).
Proof.
  intros M S. destruct (sound_R s m S M) as ((L & S0 & A & B) & D & _).
  pose proof (share_R s m t L) as U. simpl in A, B, D.
  set (u := share (pieceR s m) (Q2R t)) in *.
  assert (IU : inI (iQ (Qred ((t - t_from m) / (t_to m - t_from m)))) u) by (rewrite <- U; apply in_Q).
  assert (IV' : inI (iQ (Qred (1 - Qred ((t - t_from m) / (t_to m - t_from m))))) (1 - u)).
  { replace (1 - u) with (Q2R (Qred (1 - Qred ((t - t_from m) / (t_to m - t_from m)))));
      [apply in_Q|]. rewrite Q2R_red, Q2R_minus, U, Q2R_1. reflexivity. }
  set (a := unitq (quatR (pose_from m))) in *.
  set (b := unitq (shorter (quatR (pose_from m)) (quatR (pose_to m)))) in *.
  set (sl := slerp a b u).
  assert (SU : qdot sl sl = 1) by (apply slerp_unit; auto).
  (* what the quaternion's enclosure holds *)
  assert (HQ : exists qR, inQ4 (if rests (make_ready m) then from (make_ready m) else
      i4comb (I.sin prec (I.mul prec (iQ (Qred (1 - Qred ((t - t_from m) / (t_to m - t_from m))))) (half (make_ready m)))) (from (make_ready m))
             (I.sin prec (I.mul prec (iQ (Qred ((t - t_from m) / (t_to m - t_from m)))) (half (make_ready m)))) (to (make_ready m))) qR
    /\ (0 < qdot qR qR -> forall v, rot qR v = rot sl v)).
  { destruct (rests (make_ready m)) eqn:R.
    - exists a. split; [apply in_4unit, in_4_of|]. intros _ v.
      pose proof (rests_R s m u M S R) as E. cbn [q0 q1 pieceR] in E. fold a b sl in E. rewrite E. reflexivity.
    - exists (slerp_raw a b u). split.
      + apply in_4comb; [apply in_sin, in_mul; auto; apply (in_half s m S M)|apply in_4unit, in_4_of|
                         apply in_sin, in_mul; auto; apply (in_half s m S M)|apply in_4_to].
      + intros P v. apply slerp_raw_rot; auto. lra. }
  destruct HQ as (qR & HQ & HR).
  pose proof (in_rows (iQ s) (Q2R s) _ qR
    (iadd (iscale (iQ (Qred (1 - Qred ((t - t_from m) / (t_to m - t_from m))))) (at0 (make_ready m)))
          (iscale (iQ (Qred ((t - t_from m) / (t_to m - t_from m)))) (at1 (make_ready m)))) (in_Q s) HQ) as (O & Pos & Neg).
  exists (vscale (Q2R s) (row0 sl)), (vscale (Q2R s) (row1 sl)), (vscale (Q2R s) (row2 sl)).
  unfold ipose_at. cbn [of_piece make_ready] in *.
  assert (Rows : inV (r0 (ipose_at s (make_ready m) t)) (vscale (Q2R s) (row0 sl)) /\
                 inV (r1 (ipose_at s (make_ready m) t)) (vscale (Q2R s) (row1 sl)) /\
                 inV (r2 (ipose_at s (make_ready m) t)) (vscale (Q2R s) (row2 sl))).
  { destruct (Rlt_dec 0 (qdot qR qR)) as [P|P].
    - destruct (rows_of_rot qR sl (HR P)) as (E0 & E1 & E2). rewrite <- E0, <- E1, <- E2. apply (Pos P).
    - split; [|split]; apply (Neg P). }
  destruct Rows as (Ra & Rb & Rc).
  split; [exact Ra|split; [exact Rb|split; [exact Rc|split]]].
  - rewrite O. apply in_vadd; apply in_vscale; auto; apply in_pos.
  - intros x. unfold place. fold u. cbn [scale q0 q1 pieceR]. fold a b sl. rewrite rot_rows. f_equal.
    apply V_eq; unfold vscale, dot; cbn [vx vy vz]; ring.
Qed.

(* ---- a stretch of time without a knot, and planes *)
Record stretch := mkS { a_s : ipose; a_e : ipose; b_s : ipose; b_e : ipose;
  bulge_a : I.type; bulge_b : I.type; turn_a : option axes; turn_b : option axes }.
Definition ibulge (s : Q) (rd : ready) (f e : Q) : I.type :=
  let m := of_piece rd in
  I.div prec (I.mul prec (iQ s) (I.sqr prec (I.mul prec (I.mul prec two (half rd))
    (iQ (Qred ((e - f) / (t_to m - t_from m))))))) (I.fromZ prec 8).
Lemma in_bulge s m f e : sound_piece m = true -> Qle_bool 0 s = true ->
  inI (ibulge s (make_ready m) f e) (bulge (pieceR s m) (Q2R f) (Q2R e)).
Proof.
  intros M S. destruct (sound_R s m S M) as ((L & _) & _). cbn [k0 k1 pieceR] in L.
  unfold ibulge, bulge.
  match goal with |- inI _ (_ * ?x ^ 2 / 8) => replace (x ^ 2) with (x * x) by ring end.
  apply in_div; [|apply in_Z]. apply in_mul; [apply in_Q|]. apply in_sqr. apply in_mul.
  - apply in_mul; [apply in_Z|apply (in_half s m S M)].
  - cbn [of_piece make_ready k0 k1 pieceR].
    replace ((Q2R e - Q2R f) / (Q2R (t_to m) - Q2R (t_from m)))
      with (Q2R (Qred ((e - f) / (t_to m - t_from m)))); [apply in_Q|].
    rewrite Q2R_red, Q2R_div, !Q2R_minus; [reflexivity|].
    intros E. apply Qeq_eqR in E. rewrite Q2R_minus, Q2R_0 in E. lra.
Qed.

Definition inormal n := mkIV (I.fromZ prec (zx n)) (I.fromZ prec (zy n)) (I.fromZ prec (zz n)).
Definition normalR n := mkV (IZR (zx n)) (IZR (zy n)) (IZR (zz n)).
Lemma in_normal n : inV (inormal n) (normalR n).
Proof. repeat split; apply in_Z. Qed.
Definition way (n : IV) (p : ipose) := iadd (iadd (iscale (ix n) (r0 p)) (iscale (iy n) (r1 p))) (iscale (iz n) (r2 p)).
Definition gap (n : IV) (pa pb : ipose) (la lb : list IV) :=
  I.sub prec (I.add prec (idot n (isub (org pa) (org pb))) (heights (way n pa) la)) (heights (way n pb) lb).
(* what the points of a node deviate along n *)
Definition ideviation (bulge : I.type) (t : option axes) (n : IV) (l : list IV) (radius : I.type) := match t with
  | Some o => I.mul prec bulge (I.div prec (I.mul prec (inorm (icross n (in_world o))) (aside (in_body o) l)) (square o))
  | None => I.mul prec bulge (I.mul prec (inorm n) radius) end.
Definition plane (c : I.type) (n : IV) (la lb : list IV) (ra rb : I.type) (st : stretch) : bool :=
  let least := I.add prec (I.mul prec (inorm n) c) (I.add prec
    (ideviation (bulge_a st) (turn_a st) n la ra) (ideviation (bulge_b st) (turn_b st) n lb rb)) in
  positive_i (I.sub prec (gap n (a_s st) (b_s st) la lb) least) && positive_i (I.sub prec (gap n (a_e st) (b_e st) la lb) least).

(* the axes that a stretch has are those of its piece, if it has any *)
Definition in_turn t m := match t with None => True | Some o =>
  inV (in_body o) (body_axis (q0 m) (q1 m)) /\ inV (in_world o) (world_axis (q0 m) (q1 m)) /\
  inI (square o) (dot (body_axis (q0 m) (q1 m)) (body_axis (q0 m) (q1 m))) end.
Lemma turn_ok s m : in_turn (turn (make_ready m)) (pieceR s m).
Proof.
  unfold in_turn. destruct (turn (make_ready m)) as [o|] eqn:E; auto.
  eapply in_axes; [apply in_4unit, in_4_of| |exact E]. apply in_4_to.
Qed.
Lemma in_deviation i t n nR m s e d sc l x : well_formed m -> inI i (bulge m s e) -> in_turn t m -> inV n nR -> is_of d l x ->
  exists r, inI (ideviation i t n (points (node_of d sc l)) (inorm (box (node_of d sc l)))) r /\ deviation m s e nR x <= r.
Proof.
  intros W B T N X. destruct t as [o|].
  - destruct T as (Tb & Tw & Ts). exists (deviation m s e nR x). split; [|lra].
    apply in_mul; auto. apply in_div; auto. apply in_mul; [apply in_norm, in_cross|apply in_aside]; auto.
  - exists (bulge m s e * (norm nR * norm x)). split; [|apply deviation_radius, W].
    apply in_mul; auto. apply in_mul; apply in_norm; auto. apply in_box, X.
Qed.

Lemma in_gap n nR pa pb ma mb t da sa la db sb lb x y : inV n nR -> inPose pa ma t -> inPose pb mb t ->
  is_of da la x -> is_of db lb y ->
  inI (gap n pa pb (points (node_of da sa la)) (points (node_of db sb lb))) (dot nR (vsub (place ma t x) (place mb t y))).
Proof.
  intros N (A0 & A1 & A2 & HA0 & HA1 & HA2 & HAo & HA) (B0 & B1 & B2 & HB0 & HB1 & HB2 & HBo & HB) X Y.
  pose proof N as (Nx & Ny & Nz).
  rewrite HA, HB.
  set (wa := vadd (vadd (vscale (vx nR) A0) (vscale (vy nR) A1)) (vscale (vz nR) A2)).
  set (wb := vadd (vadd (vscale (vx nR) B0) (vscale (vy nR) B1)) (vscale (vz nR) B2)).
  replace (dot nR _) with (dot nR (vsub (origin ma t) (origin mb t)) + dot wa x - dot wb y)
    by (unfold wa, wb, dot, vsub, vadd, vscale; cbn [vx vy vz]; ring).
  apply in_sub; [apply in_add|].
  - apply in_dot; auto. apply in_vsub; auto.
  - apply in_heights; auto. repeat apply in_vadd; apply in_vscale; auto.
  - apply in_heights; auto. repeat apply in_vadd; apply in_vscale; auto.
Qed.

Lemma plane_ok c cR n da sa la db sb lb ma mb st s e x y t :
  inI c cR -> well_formed ma -> well_formed mb -> s <= e ->
  inPose (a_s st) ma s -> inPose (a_e st) ma e -> inPose (b_s st) mb s -> inPose (b_e st) mb e ->
  inI (bulge_a st) (bulge ma s e) -> inI (bulge_b st) (bulge mb s e) -> in_turn (turn_a st) ma -> in_turn (turn_b st) mb ->
  is_of da la x -> is_of db lb y ->
  plane c (inormal n) (points (node_of da sa la)) (points (node_of db sb lb)) (inorm (box (node_of da sa la)))
    (inorm (box (node_of db sb lb))) st = true -> s <= t <= e ->
  norm (normalR n) * cR < dot (normalR n) (vsub (place ma t x) (place mb t y)) /\ cR < norm (vsub (place ma t x) (place mb t y)).
Proof.
  intros C Wa Wb L As Ae Bs Be Sa Sb Ta Tb X Y P T. unfold plane in P. apply andb_true_iff in P as [Ps Pe].
  pose proof (in_normal n) as N.
  destruct (in_deviation _ _ _ _ ma s e da sa la x Wa Sa Ta N X) as (ra & Ra & La).
  destruct (in_deviation _ _ _ _ mb s e db sb lb y Wb Sb Tb N Y) as (rb & Rb & Lb).
  pose proof (in_add _ _ _ _ (in_mul _ _ _ _ (in_norm _ _ N) C) (in_add _ _ _ _ Ra Rb)) as Least.
  apply (plane_separates ma mb (normalR n) cR s e x y); auto; eapply Rle_lt_trans.
  2:{ eapply Rminus_gt_0_lt, (positive_ok _ _ Ps), in_sub; [apply in_gap; eauto|exact Least]. }
  3:{ eapply Rminus_gt_0_lt, (positive_ok _ _ Pe), in_sub; [apply in_gap; eauto|exact Least]. }
  all: lra.
Qed.

(* ---- stretches *)
Definition qmax a b := if Qle_bool a b then b else a.
Definition qmin a b := if Qle_bool a b then a else b.
Lemma qmax_le a b x : Q2R a <= x -> Q2R b <= x -> Q2R (qmax a b) <= x.
Proof. unfold qmax. destruct Qle_bool; auto. Qed.
Lemma qmin_ge a b x : x <= Q2R a -> x <= Q2R b -> x <= Q2R (qmin a b).
Proof. unfold qmin. destruct Qle_bool; auto. Qed.

Section Scene.
Variables (da db : positive) (sa sb : Q) (ma mb : list qpiece) (c : Q).
Hypothesis Sa : Qle_bool 0 sa = true.
Hypothesis Sb : Qle_bool 0 sb = true.
Hypothesis Ma : forallb sound_piece ma = true.
Hypothesis Mb : forallb sound_piece mb = true.

Definition stretch_of (ra rb : ready) (s e : Q) : stretch :=
  mkS (ipose_at sa ra s) (ipose_at sa ra e) (ipose_at sb rb s) (ipose_at sb rb e) (ibulge sa ra s e) (ibulge sb rb s e) (turn ra) (turn rb).
Definition stretches (ras rbs : list ready) (s e : Q) : list stretch :=
  flat_map (fun ra => flat_map (fun rb =>
    let s := qmax s (qmax (t_from (of_piece ra)) (t_from (of_piece rb))) in
    let e := qmin e (qmin (t_to (of_piece ra)) (t_to (of_piece rb))) in
    if Qle_bool s e then [stretch_of ra rb s e] else []) rbs) ras.

(* what is claimed of two nodes from t0 to t1 *)
Definition separated (t0 t1 : Q) (na nb : node) := forall pa pb t x y, In pa ma -> In pb mb ->
  Q2R t0 <= t <= Q2R t1 -> Q2R (t_from pa) <= t <= Q2R (t_to pa) -> Q2R (t_from pb) <= t <= Q2R (t_to pb) ->
  is_of da (of_tris na) x -> is_of db (of_tris nb) y ->
  Q2R c < norm (vsub (place (pieceR sa pa) t x) (place (pieceR sb pb) t y)).

Definition separates (n : zv) (sts : list stretch) (na nb : node) :=
  let ni := inormal n in let ci := iQ c in let la := points na in let lb := points nb in
  let ra := inorm (box na) in let rb := inorm (box nb) in forallb (plane ci ni la lb ra rb) sts.

Lemma separates_both n t0 t1 la lb :
  separates n (stretches (map make_ready ma) (map make_ready mb) t0 t1) (node_of da sa la) (node_of db sb lb) = true ->
  forall pa pb t x y, In pa ma -> In pb mb ->
  Q2R t0 <= t <= Q2R t1 -> Q2R (t_from pa) <= t <= Q2R (t_to pa) -> Q2R (t_from pb) <= t <= Q2R (t_to pb) ->
  is_of da la x -> is_of db lb y ->
  norm (normalR n) * Q2R c < dot (normalR n) (vsub (place (pieceR sa pa) t x) (place (pieceR sb pb) t y)) /\
  Q2R c < norm (vsub (place (pieceR sa pa) t x) (place (pieceR sb pb) t y)).
Proof.
  unfold separates. rewrite forallb_forall. intros H pa pb t x y A B T TA TB X Y.
  rewrite forallb_forall in Ma, Mb.
  set (s := qmax t0 (qmax (t_from pa) (t_from pb))). set (e := qmin t1 (qmin (t_to pa) (t_to pb))).
  assert (Ls : Q2R s <= t) by (repeat apply qmax_le; tauto).
  assert (Le : t <= Q2R e) by (repeat apply qmin_ge; tauto).
  assert (I : In (stretch_of (make_ready pa) (make_ready pb) s e) (stretches (map make_ready ma) (map make_ready mb) t0 t1)).
  { apply in_flat_map. exists (make_ready pa). split; [apply in_map; auto|].
    apply in_flat_map. exists (make_ready pb). split; [apply in_map; auto|].
    cbn [of_piece make_ready]. fold s e.
    replace (Qle_bool s e) with true; [left; reflexivity|]. symmetry. apply Qle_bool_iff, Rle_Qle. lra. }
  specialize (H _ I).
  destruct (sound_R sa pa Sa (Ma _ A)) as (Wa & _). destruct (sound_R sb pb Sb (Mb _ B)) as (Wb & _).
  eapply plane_ok with (s := Q2R s) (e := Q2R e) (st := stretch_of (make_ready pa) (make_ready pb) s e); eauto;
    cbn [a_s a_e b_s b_e bulge_a bulge_b turn_a turn_b stretch_of]; try apply in_Q; try apply turn_ok; try (apply in_pose; auto); try (apply in_bulge; auto); lra.
Qed.
Lemma separates_ok n t0 t1 la lb :
  separates n (stretches (map make_ready ma) (map make_ready mb) t0 t1) (node_of da sa la) (node_of db sb lb) = true ->
  separated t0 t1 (node_of da sa la) (node_of db sb lb).
Proof. intros H pa pb t x y A B T TA TB X Y. eapply separates_both; eauto. Qed.

(* all the while on two sides of one plane *)
Definition on_sides (n : zv) (t0 t1 : Q) (na nb : node) := forall pa pb t x y, In pa ma -> In pb mb ->
  Q2R t0 <= t <= Q2R t1 -> Q2R (t_from pa) <= t <= Q2R (t_to pa) -> Q2R (t_from pb) <= t <= Q2R (t_to pb) ->
  is_of da (of_tris na) x -> is_of db (of_tris nb) y ->
  0 < dot (normalR n) (vsub (place (pieceR sa pa) t x) (place (pieceR sb pb) t y)).
Lemma separates_by n t0 t1 la lb : 0 <= Q2R c ->
  separates n (stretches (map make_ready ma) (map make_ready mb) t0 t1) (node_of da sa la) (node_of db sb lb) = true ->
  on_sides n t0 t1 (node_of da sa la) (node_of db sb lb).
Proof.
  intros C H pa pb t x y A B T TA TB X Y. destruct (separates_both n t0 t1 la lb H pa pb t x y) as [P _]; auto.
  pose proof (norm_pos (normalR n)). nra.
Qed.

(* ---- the walk *)
Definition state := (list bool * list zv * bool)%type.
Definition opens_a (a b : tree) := match a, b with
  | Leaf _, _ => false | _, Leaf _ => true
  | _, _ => Qle_bool (side (root b)) (side (root a)) end.

Fixpoint walk (fuel : nat) (ras rbs : list ready) (sts : list stretch) (t0 t1 : Q) (roots : bool) (a b : tree)
    (l : list bool) (ns : list zv) (ap : bool) : answer state :=
  match fuel with
  | O => No TooDeep l
  | S fuel =>
    match l with
    | false :: l =>
      if opens_a a b then
        match a with
        | Leaf _ => No OpensTriangles l
        | Fork _ x y => match walk fuel ras rbs sts t0 t1 false x b l ns ap with
          | Yes (l, ns, ap) => walk fuel ras rbs sts t0 t1 false y b l ns ap
          | No r l => No r l end
        end
      else
        match b with
        | Leaf _ => No OpensTriangles l
        | Fork _ x y => match walk fuel ras rbs sts t0 t1 false a x l ns ap with
          | Yes (l, ns, ap) => walk fuel ras rbs sts t0 t1 false a y l ns ap
          | No r l => No r l end
        end
    | true :: false :: false :: l =>
      if Qlt_bool (t1 - t0) (1 # 1000000000000) then No TooDeep l else
      let m := Qred ((t0 + t1) * (1 # 2)) in
      match walk fuel ras rbs (stretches ras rbs t0 m) t0 m roots a b l ns ap with
      | Yes (l, ns, ap) => walk fuel ras rbs (stretches ras rbs m t1) m t1 roots a b l ns ap
      | No r l => No r l end
    | true :: true :: l =>
      if separates (List.hd (mkZ 0 0 0) ns) sts (root a) (root b) then Yes (l, ns, (ap || roots)%bool) else No NotSeparated l
    | true :: false :: true :: l =>
      match read_normal ns l with
      | Some (ns, l) => if separates (List.hd (mkZ 0 0 0) ns) sts (root a) (root b) then Yes (l, ns, (ap || roots)%bool) else No NotSeparated l
      | None => No EndsEarly [] end
    | _ => No EndsEarly []
    end
  end.

Lemma good_root d s t : good d s t -> exists l, root t = node_of d s l.
Proof. intros []; eexists; reflexivity. Qed.

Lemma separated_a t0 t1 n x y nb : (forall T, In T (of_tris n) -> In T (of_tris x) \/ In T (of_tris y)) ->
  separated t0 t1 x nb -> separated t0 t1 y nb -> separated t0 t1 n nb.
Proof.
  intros H X Y pa pb t p q A B T TA TB (U & IU & P) Q.
  destruct (H U IU) as [J|J]; [apply X|apply Y]; auto; exists U; auto.
Qed.
Lemma separated_b t0 t1 n x y na : (forall T, In T (of_tris n) -> In T (of_tris x) \/ In T (of_tris y)) ->
  separated t0 t1 na x -> separated t0 t1 na y -> separated t0 t1 na n.
Proof.
  intros H X Y pa pb t p q A B T TA TB P (U & IU & Q).
  destruct (H U IU) as [J|J]; [apply X|apply Y]; auto; exists U; auto.
Qed.
Lemma separated_halves t0 m t1 na nb : separated t0 m na nb -> separated m t1 na nb -> separated t0 t1 na nb.
Proof.
  intros X Y pa pb t p q A B T TA TB P Q.
  destruct (Rle_dec t (Q2R m)); [apply X|apply Y]; auto; lra.
Qed.

Theorem walk_sound fuel : forall t0 t1 roots a b l ns ap out, good da sa a -> good db sb b ->
  walk fuel (map make_ready ma) (map make_ready mb) (stretches (map make_ready ma) (map make_ready mb) t0 t1) t0 t1 roots a b l ns ap
    = Yes out ->
  separated t0 t1 (root a) (root b).
Proof.
  induction fuel as [|fuel IH]; [discriminate|]. intros t0 t1 roots a b l ns ap out A B H.
  cbn [walk] in H. destruct l as [|[] l]; [discriminate| |].
  - destruct l as [|[] l]; [discriminate| |].
    + (* the last plane *)
      destruct (good_root _ _ _ A) as [la Ea]. destruct (good_root _ _ _ B) as [lb Eb].
      rewrite Ea, Eb in *. destruct (separates _ _ _ _) eqn:P in H; [|discriminate]. eapply separates_ok; eauto.
    + destruct l as [|[] l]; [discriminate| |].
      * (* a new plane *)
        destruct (read_normal ns l) as [[ns' l']|]; [|discriminate].
        destruct (good_root _ _ _ A) as [la Ea]. destruct (good_root _ _ _ B) as [lb Eb].
        rewrite Ea, Eb in *. destruct (separates _ _ _ _) eqn:P in H; [|discriminate]. eapply separates_ok; eauto.
      * (* halves *)
        destruct (Qlt_bool _ _); [discriminate|].
        set (m := Qred ((t0 + t1) * (1 # 2))) in *.
        destruct (walk fuel _ _ _ t0 m roots a b l ns ap) as [[[l' ns'] ap']|] eqn:W; [|discriminate].
        apply separated_halves with m; [eapply (IH t0 m)|eapply (IH m t1)]; eauto.
  - (* children *)
    destruct (opens_a a b).
    + inversion A as [la Ea|la x y X Y In_ Ea]; subst a; [discriminate|].
      destruct (walk fuel _ _ _ t0 t1 false x b l ns ap) as [[[l' ns'] ap']|] eqn:W; [|discriminate].
      cbn [root]. apply separated_a with (root x) (root y); auto; [eapply IH with (a := x)|eapply IH with (a := y)]; eauto.
    + inversion B as [lb Eb|lb x y X Y In_ Eb]; subst b; [discriminate|].
      destruct (walk fuel _ _ _ t0 t1 false a x l ns ap) as [[[l' ns'] ap']|] eqn:W; [|discriminate].
      cbn [root]. apply separated_b with (root x) (root y); auto; [eapply IH with (b := x)|eapply IH with (b := y)]; eauto.
Qed.

Lemma Q2R_half t0 t1 : Q2R (Qred ((t0 + t1) * (1 # 2))) = (Q2R t0 + Q2R t1) / 2.
Proof. rewrite Q2R_red, Q2R_mult, Q2R_plus. unfold Q2R at 3; simpl; lra. Qed.

(* if the walk says so, the roots are on two sides of one plane for a while *)
Theorem walk_apart fuel : 0 <= Q2R c -> forall t0 t1 roots a b l ns ap rest ns' , good da sa a -> good db sb b ->
  Q2R t0 <= Q2R t1 ->
  walk fuel (map make_ready ma) (map make_ready mb) (stretches (map make_ready ma) (map make_ready mb) t0 t1) t0 t1 roots a b l ns ap
    = Yes (rest, ns', true) ->
  ap = true \/ roots = true /\ exists n s e, Q2R t0 <= Q2R s /\ Q2R s <= Q2R e /\ Q2R e <= Q2R t1 /\ on_sides n s e (root a) (root b).
Proof.
  intros C. induction fuel as [|fuel IH]; [discriminate|]. intros t0 t1 roots a b l ns ap rest ns' A B L H.
  assert (Plane : forall n, separates n (stretches (map make_ready ma) (map make_ready mb) t0 t1) (root a) (root b) = true ->
    (ap || roots)%bool = true -> ap = true \/ roots = true /\ exists n s e, Q2R t0 <= Q2R s /\ Q2R s <= Q2R e /\
      Q2R e <= Q2R t1 /\ on_sides n s e (root a) (root b)).
  { intros n P R. destruct ap; [left; reflexivity|right]. split; [exact R|]. exists n, t0, t1.
    split; [lra|split; [lra|split; [lra|]]].
    destruct (good_root _ _ _ A) as [la Ea]. destruct (good_root _ _ _ B) as [lb Eb]. rewrite Ea, Eb in *.
    apply separates_by; auto. }
  cbn [walk] in H. destruct l as [|[] l]; [discriminate| |].
  - destruct l as [|[] l]; [discriminate| |].
    + destruct (separates _ _ _ _) eqn:P in H; [|discriminate]. injection H as _ _ R. eapply Plane; eauto.
    + destruct l as [|[] l]; [discriminate| |].
      * destruct (read_normal ns l) as [[n2 l2]|]; [|discriminate].
        destruct (separates _ _ _ _) eqn:P in H; [|discriminate]. injection H as _ _ R. eapply Plane; eauto.
      * destruct (Qlt_bool _ _); [discriminate|]. pose proof (Q2R_half t0 t1) as M. set (m := Qred ((t0 + t1) * (1 # 2))) in *.
        destruct (walk fuel _ _ _ t0 m roots a b l ns ap) as [[[l2 n2] ap2]|] eqn:W; [|discriminate].
        apply IH in H; auto; [|lra]. destruct H as [E|(R & n & s & e & S1 & S2 & S3 & P)].
        -- subst ap2. apply IH in W; auto; [|lra]. destruct W as [E|(R & n & s & e & S1 & S2 & S3 & P)]; [left; auto|].
           right. split; auto. exists n, s, e. repeat split; auto; lra.
        -- right. split; auto. exists n, s, e. repeat split; auto; lra.
  - destruct (opens_a a b).
    + inversion A as [la Ea|la x y X Y In_ Ea]; subst a; [discriminate|].
      destruct (walk fuel _ _ _ t0 t1 false x b l ns ap) as [[[l2 n2] ap2]|] eqn:W; [|discriminate].
      apply IH in H; auto. destruct H as [E|[E _]]; [subst ap2|discriminate].
      apply IH in W; auto. destruct W as [E|[E _]]; [left; auto|discriminate].
    + inversion B as [lb Eb|lb x y X Y In_ Eb]; subst b; [discriminate|].
      destruct (walk fuel _ _ _ t0 t1 false a x l ns ap) as [[[l2 n2] ap2]|] eqn:W; [|discriminate].
      apply IH in H; auto. destruct H as [E|[E _]]; [subst ap2|discriminate].
      apply IH in W; auto. destruct W as [E|[E _]]; [left; auto|discriminate].
Qed.
End Scene.

(* ---- a certificate *)
Fixpoint number (i : Z) (l : list ztri) : list (Z * ztri) := match l with [] => [] | T :: l => (i, T) :: number (i + 1) l end.
Lemma number_snd i l : map snd (number i l) = l.
Proof. revert i. induction l; simpl; intros; f_equal; auto. Qed.
Definition tree_of (b : body) := build 64 (den b) (size b) (number 0 (tris b)).
Definition same_pose p q := Qeq_bool (px p) (px q) && Qeq_bool (py p) (py q) && Qeq_bool (pz p) (pz q) && same_turn p q.
Fixpoint chained (t : Q) (l : list qpiece) : bool := match l with
  | [] => Qeq_bool t 1
  | m :: l => Qeq_bool (t_from m) t &&
      match l with [] => true | m' :: _ => same_pose (pose_to m) (pose_from m') end && chained (t_to m) l end.
Lemma chained_ok l : forall f t, chained f l = true -> Q2R f <= t <= 1 -> Q2R f < 1 ->
  exists m, In m l /\ Q2R (t_from m) <= t <= Q2R (t_to m).
Proof.
  induction l as [|m l IH]; cbn [chained]; intros f t H T F.
  - apply Qeq_bool_iff, Qeq_eqR in H. rewrite Q2R_1 in H. lra.
  - rewrite !andb_true_iff in H. destruct H as [[E _] C]. apply Qeq_bool_iff, Qeq_eqR in E.
    destruct (Rle_dec t (Q2R (t_to m))) as [L|L].
    + exists m. split; [left; reflexivity|]. lra.
    + destruct (IH (t_to m) t C) as (p & I & P); [lra|lra|]. exists p. split; [right|]; auto.
Qed.

Lemma same_pose_R p q : same_pose p q = true -> posR p = posR q /\ quatR p = quatR q.
Proof.
  unfold same_pose. rewrite !andb_true_iff. intros (((A & B) & C) & D). split; [|apply same_turn_R, D].
  apply Qeq_bool_iff, Qeq_eqR in A, B, C. unfold posR. f_equal; auto.
Qed.

Lemma knots_agree s m m' x : sound_piece m = true -> sound_piece m' = true ->
  same_pose (pose_to m) (pose_from m') = true -> Q2R (t_to m) = Q2R (t_from m') ->
  place (pieceR s m) (Q2R (t_to m)) x = place (pieceR s m') (Q2R (t_to m)) x.
Proof.
  unfold sound_piece. rewrite !andb_true_iff. intros ((T & A) & B) ((T' & _) & _) P K.
  apply same_pose_R in P as [P1 P2]. apply Qlt_bool_R in T, T', A, B. rewrite qdotQ_R, Q2R_0 in A, B. rewrite K.
  assert (S1 : share (pieceR s m) (Q2R (t_from m')) = 1) by (unfold share; simpl; rewrite K; field; lra).
  assert (S0 : share (pieceR s m') (Q2R (t_from m')) = 0) by (unfold share; simpl; field; lra).
  unfold place, origin. rewrite S1, S0. cbn [scale q0 q1 p0 p1 pieceR].
  rewrite slerp_0, slerp_1;
    [|apply unitq_unit; auto|apply unitq_unit; rewrite shorter_norm; auto|apply shorter_dot; auto].
  rewrite rot_shorter, <- P1, <- P2 by auto.
  apply V_eq; unfold vadd, vscale; simpl; ring.
Qed.

(* all pieces of a chain begin no earlier than it does *)
Lemma chained_after l : forall f, forallb sound_piece l = true -> chained f l = true ->
  forall m, In m l -> Q2R f <= Q2R (t_from m).
Proof.
  induction l as [|m l IH]; cbn [chained forallb]; intros f S H p I; [destruct I|].
  apply andb_true_iff in S as [S S'], H as [H C]. apply andb_true_iff in H as [E _]. apply Qeq_bool_iff, Qeq_eqR in E.
  destruct I as [<-|I]; [lra|]. specialize (IH (t_to m) S' C p I).
  unfold sound_piece in S. rewrite !andb_true_iff in S. destruct S as ((T & _) & _). apply Qlt_bool_R in T. lra.
Qed.

Lemma chained_one s l : forall f, forallb sound_piece l = true -> chained f l = true ->
  forall m m' t x, In m l -> In m' l -> Q2R (t_from m) <= t <= Q2R (t_to m) -> Q2R (t_from m') <= t <= Q2R (t_to m') ->
  place (pieceR s m) t x = place (pieceR s m') t x.
Proof.
  induction l as [|h l IH]; intros f S H m m' t x I I' T T'; [destruct I|].
  cbn [chained forallb] in S, H. apply andb_true_iff in S as [S S'], H as [H C]. apply andb_true_iff in H as [_ N].
  assert (Next : forall p, In p l -> Q2R (t_from h) <= t <= Q2R (t_to h) -> Q2R (t_from p) <= t <= Q2R (t_to p) ->
    place (pieceR s h) t x = place (pieceR s p) t x).
  { intros p Ip Th Tp. pose proof (chained_after l (t_to h) S' C p Ip) as L.
    assert (E : t = Q2R (t_to h)) by lra. assert (K : Q2R (t_to h) = Q2R (t_from p)) by lra. subst t.
    destruct l as [|n l]; [destruct Ip|]. cbn [chained forallb] in S', C.
    apply andb_true_iff in S' as [Sn Sl], C as [C Cn]. apply andb_true_iff in C as [En _]. apply Qeq_bool_iff, Qeq_eqR in En.
    destruct Ip as [<-|Ip]; [apply knots_agree; auto|exfalso].
    pose proof (chained_after l (t_to n) Sl Cn p Ip).
    unfold sound_piece in Sn. rewrite !andb_true_iff in Sn. destruct Sn as ((Q & _) & _). apply Qlt_bool_R in Q. lra. }
  destruct I as [<-|I], I' as [<-|I']; auto; [symmetry; auto|]. eapply IH; eauto.
Qed.
Definition sound_body b := Qle_bool 0 (size b) && forallb sound_piece (pieces b) && chained 0 (pieces b).

(* Yes (_, _, true): surfaces never meet, and a plane has had all of one body on each side. Yes (l, ns, false):
   surfaces never meet, and l are the bits of rays, of which Rays.v has more; ns are the last normals. *)
Definition check_trees (s : scene) (ta tb : tree) (bytes : list Z) : answer state :=
  let bits := bits_of bytes in
  if negb (sound_body (body_a s) && sound_body (body_b s) && Qle_bool 0 (clearance s)) then No Unfit bits else
  match read 8 0 bits with
  | Some (4%Z, l) =>
    let ras := map make_ready (pieces (body_a s)) in
    let rbs := map make_ready (pieces (body_b s)) in
    match walk (size (body_a s)) (size (body_b s)) (clearance s) 129 ras rbs (stretches (size (body_a s)) (size (body_b s)) ras rbs 0 1) 0 1 true ta tb
      (skipn 32 l) (repeat (mkZ 0 0 0) 8) false with
    | Yes (rest, ns, ap) => if (ap && (8 <=? length rest)%nat)%bool then No Follows rest else Yes (rest, ns, ap)
    | No r l => No r l end
  | _ => No NotFree bits end.
Definition check (s : scene) (bytes : list Z) := check_trees s (tree_of (body_a s)) (tree_of (body_b s)) bytes.
Definition accepts s bytes := match check s bytes with Yes (_, _, ap) => Some ap | No _ _ => None end.

(* what an accepted certificate has been through *)
Lemma accepts_walk s bytes ap : accepts s bytes = Some ap ->
  sound_body (body_a s) = true /\ sound_body (body_b s) = true /\ Qle_bool 0 (clearance s) = true /\
  exists l rest ns, walk (size (body_a s)) (size (body_b s)) (clearance s) 129
    (map make_ready (pieces (body_a s))) (map make_ready (pieces (body_b s)))
    (stretches (size (body_a s)) (size (body_b s)) (map make_ready (pieces (body_a s))) (map make_ready (pieces (body_b s))) 0 1)
    0 1 true (tree_of (body_a s)) (tree_of (body_b s)) l (repeat (mkZ 0 0 0) 8) false = Yes (rest, ns, ap).
Proof.
  unfold accepts, check, check_trees. destruct (negb _) eqn:E; [discriminate|]. apply negb_false_iff in E.
  rewrite !andb_true_iff in E. destruct E as ((A & B) & C).
  destruct (read 8 0 _) as [[z l]|]; [|discriminate].
  destruct z as [|p|p]; try discriminate. repeat (destruct p as [p|p|]; try discriminate).
  match goal with |- context [walk ?b ?c ?d ?f ?r1 ?r2 ?sts ?t0 ?t1 ?ro ?ta ?tb ?bits ?ns ?ap] =>
    destruct (walk b c d f r1 r2 sts t0 t1 ro ta tb bits ns ap) as [[[rest ns'] ap']|] eqn:W end; [|discriminate].
  destruct (_ && _)%bool; [discriminate|]. intros H. injection H as <-.
  split; [exact A|split; [exact B|split; [exact C|]]]. eexists _, rest, ns'. exact W.
Qed.

(* all triangles are of the roots *)
Lemma is_of_root b x T : In T (tris b) -> of_tri x (triR (den b) T) -> is_of (den b) (of_tris (root (tree_of b))) x.
Proof.
  intros H P. unfold tree_of. rewrite build_root. cbn [of_tris node_of]. rewrite number_snd. exists T. auto.
Qed.

Lemma accepts_never_meet s bytes ap : accepts s bytes = Some ap -> never_meet s.
Proof.
  intros H. apply accepts_walk in H as (A & B & _ & l & rest & ns & W).
  unfold sound_body in A, B. rewrite !andb_true_iff in A, B. destruct A as ((Sa & Ma) & _), B as ((Sb & Mb) & _).
  intros t x y T (pa & Ta & x' & Ia & TIa & ITa & Xa & ->) (pb & Tb & y' & Ib & TIb & ITb & Xb & ->).
  eapply (walk_sound (den (body_a s)) (den (body_b s)) (size (body_a s)) (size (body_b s))
           (pieces (body_a s)) (pieces (body_b s)) (clearance s) Sa Sb Ma Mb) in W;
    [|apply build_good|apply build_good].
  apply (W pa pb t x' y'); eauto using is_of_root. rewrite Q2R_0, Q2R_1. auto.
Qed.

Lemma accepts_apart s bytes : accepts s bytes = Some true -> once_apart s.
Proof.
  intros H. apply accepts_walk in H as (A & B & C & l & rest & ns & W).
  unfold sound_body in A, B. rewrite !andb_true_iff in A, B. destruct A as ((Sa & Ma) & _), B as ((Sb & Mb) & _).
  apply Qle_bool_iff, Qle_Rle in C. rewrite Q2R_0 in C.
  eapply (walk_apart (den (body_a s)) (den (body_b s)) (size (body_a s)) (size (body_b s))
           (pieces (body_a s)) (pieces (body_b s)) (clearance s) Sa Sb Ma Mb) in W;
    [|auto|apply build_good|apply build_good|rewrite Q2R_0, Q2R_1; lra].
  destruct W as [D|(_ & n & f & e & L1 & L2 & L3 & P)]; [discriminate|]. rewrite Q2R_0 in L1. rewrite Q2R_1 in L3.
  exists (Q2R f), (normalR n). split; [lra|].
  intros x y (pa & Ta & x' & Ia & TIa & ITa & Xa & ->) (pb & Tb & y' & Ib & TIb & ITb & Xb & ->).
  apply (P pa pb (Q2R f) x' y'); eauto using is_of_root; lra.
Qed.

Lemma accepts_covers s bytes ap : accepts s bytes = Some ap -> covers (body_a s) /\ covers (body_b s).
Proof.
  intros H. apply accepts_walk in H as (A & B & _).
  unfold sound_body in A, B. rewrite !andb_true_iff in A, B. destruct A as (_ & Ca), B as (_ & Cb).
  split; intros t T; [apply (chained_ok _ 0 t Ca)|apply (chained_ok _ 0 t Cb)]; rewrite Q2R_0; lra.
Qed.

Lemma accepts_one s bytes ap : accepts s bytes = Some ap -> one_place (body_a s) /\ one_place (body_b s).
Proof.
  intros H. apply accepts_walk in H as (A & B & _).
  unfold sound_body in A, B. rewrite !andb_true_iff in A, B. destruct A as ((_ & Ma) & Ca), B as ((_ & Mb) & Cb).
  split; intros m m' t x; eapply chained_one; eauto.
Qed.

Lemma proper_of b : sound_body b = true -> proper b /\ forall m, In m (pieces b) -> well_formed (pieceR (size b) m).
Proof.
  unfold sound_body. rewrite !andb_true_iff, forallb_forall. intros ((S & M) & _). split; [split|intros m I; apply sound_R; auto].
  - apply Qle_bool_iff, Qle_Rle in S. rewrite Q2R_0 in S. exact S.
  - intros m I. specialize (M m I). unfold sound_piece in M. rewrite !andb_true_iff in M.
    destruct M as ((T & A) & B). apply Qlt_bool_R in T, A, B. rewrite qdotQ_R, Q2R_0 in A, B. auto.
Qed.

Lemma accepts_well_posed s bytes ap : accepts s bytes = Some ap -> well_posed s /\
  (forall m, In m (pieces (body_a s)) -> well_formed (pieceR (size (body_a s)) m)) /\
  (forall m, In m (pieces (body_b s)) -> well_formed (pieceR (size (body_b s)) m)).
Proof.
  intros H. apply accepts_walk in H as (A & B & C & _). apply Qle_bool_iff, Qle_Rle in C. rewrite Q2R_0 in C.
  apply proper_of in A as [A Fa], B as [B Fb]. split; [split|]; auto.
Qed.

Theorem accepts_sound : sound accepts.
Proof.
  intros s bytes ap H. destruct (accepts_covers s bytes ap H), (accepts_one s bytes ap H), (accepts_well_posed s bytes ap H) as (W & Fa & Fb).
  pose proof (accepts_never_meet s bytes ap H) as M. destruct (W) as (C & _).
  split; [exact M|split; [intros ->|split; [split; auto|split; [split; auto|exact W]]]].
  pose proof (accepts_apart s bytes H) as P. split; [exact P|]. apply inside_never; auto; split; auto; split; auto.
Qed.
End Prec.
End Make.
