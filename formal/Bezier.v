(* Bezier.v - Bezier curves over the reals: what bounds them and their derivatives, and how verify__curve of
   nsvcd_verify_robot.h cuts them. *)
From Coq Require Import Reals Lra Lia.
From Coquelicot Require Import Coquelicot.
Local Open Scope R_scope.

(* ---- of any degree n, by their points 0 to n, as de Casteljau has them *)
Fixpoint bez n (p : nat -> R) x := match n with
  | O => p O | S m => bez m (fun i => (1 - x) * p i + x * p (S i)) x end.
Definition diff (p : nat -> R) i := p (S i) - p i.
Lemma bez_ext n x : forall p q, (forall i, (i <= n)%nat -> p i = q i) -> bez n p x = bez n q x.
Proof.
  induction n as [|n IH]; intros p q E; simpl; [apply E; lia|]. apply IH. intros i I. rewrite !E by lia. reflexivity.
Qed.
Lemma bez_linear n x a b : forall p q, bez n (fun i => a * p i + b * q i) x = a * bez n p x + b * bez n q x.
Proof.
  induction n as [|n IH]; intros p q; simpl; [reflexivity|]. rewrite <- IH. apply bez_ext. intros. ring.
Qed.
Lemma bez_outer n p x : bez (S n) p x = (1 - x) * bez n p x + x * bez n (fun i => p (S i)) x.
Proof. exact (bez_linear n x (1 - x) x p (fun i => p (S i))). Qed.

(* it stays within what bounds its points; and its derivative is the curve of their differences, times the degree *)
Lemma bez_within n x M : 0 <= x <= 1 -> forall p, (forall i, (i <= n)%nat -> Rabs (p i) <= M) -> Rabs (bez n p x) <= M.
Proof.
  intros I. induction n as [|n IH]; intros p H; simpl; [apply H; lia|]. apply IH. intros i J.
  pose proof (H i ltac:(lia)) as A. pose proof (H (S i) ltac:(lia)) as B.
  apply Rabs_le_between in A. apply Rabs_le_between in B. apply Rabs_le. nra.
Qed.
Lemma bez_derives n x : forall p, is_derive (bez n p) x (INR n * bez (pred n) (diff p) x).
Proof.
  induction n as [|n IH]; intros p.
  - simpl. rewrite Rmult_0_l. apply (is_derive_const (K := R_AbsRing) (V := R_NormedModule)).
  - eapply is_derive_ext; [intros; symmetry; apply bez_outer|].
    pose proof (IH p) as A. pose proof (IH (fun i => p (S i))) as B.
    set (f := bez n p) in *. set (g := bez n (fun i => p (S i))) in *.
    assert (DA : Derive (fun v => f v) x = INR n * bez (pred n) (diff p) x) by (apply is_derive_unique, A).
    assert (DB : Derive (fun v => g v) x = INR n * bez (pred n) (diff (fun i => p (S i))) x) by (apply is_derive_unique, B).
    auto_derive; [split; [eexists; exact A|split; [eexists; exact B|exact I]]|]. rewrite DA, DB, S_INR. simpl pred.
    assert (E : bez n (diff p) x = g x - f x).
    { unfold f, g. transitivity (1 * bez n (fun i => p (S i)) x + -1 * bez n p x); [|ring].
      rewrite <- bez_linear. apply bez_ext. intros. unfold diff. ring. }
    assert (E' : INR n * bez n (diff p) x = INR n *
      ((1 - x) * bez (pred n) (diff p) x + x * bez (pred n) (diff (fun i => p (S i))) x)).
    { destruct n as [|n]; [simpl; ring|]. f_equal. apply bez_outer. }
    replace ((INR n + 1) * bez n (diff p) x) with (INR n * bez n (diff p) x + bez n (diff p) x) by ring.
    rewrite E', E. ring.
Qed.

(* ---- verify__curve: cutting in place, level by level. After the first loop point i is the curve of points 0 to i at the
   cut, after the second that of points i to n *)
Fixpoint left_loop x l (p : nat -> R) i := match l with
  | O => p i
  | S m => if Nat.leb l i then (1 - x) * left_loop x m p (pred i) + x * left_loop x m p i else left_loop x m p i end.
Fixpoint right_loop n x l (p : nat -> R) i := match l with
  | O => p i
  | S m => if Nat.leb (i + l) n then (1 - x) * right_loop n x m p i + x * right_loop n x m p (S i) else right_loop n x m p i end.
Lemma left_loop_is x l p : forall i, left_loop x l p i = bez (Nat.min i l) (fun k => p (i - Nat.min i l + k)%nat) x.
Proof.
  induction l as [|l IH]; intros i.
  - rewrite Nat.min_0_r. simpl. f_equal. lia.
  - cbn [left_loop]. destruct (Nat.leb_spec (S l) i) as [H|H]; rewrite !IH.
    + replace (Nat.min i (S l)) with (S l) by lia. replace (Nat.min (pred i) l) with l by lia.
      replace (Nat.min i l) with l by lia. rewrite bez_outer. f_equal; f_equal; apply bez_ext; intros; f_equal; lia.
    + replace (Nat.min i (S l)) with i by lia. replace (Nat.min i l) with i by lia. reflexivity.
Qed.
Lemma right_loop_is n x l p : forall i, (i <= n)%nat ->
  right_loop n x l p i = bez (Nat.min l (n - i)) (fun k => p (i + k)%nat) x.
Proof.
  induction l as [|l IH]; intros i I.
  - simpl. f_equal. lia.
  - cbn [right_loop]. destruct (Nat.leb_spec (i + S l) n) as [H|H].
    + rewrite !IH by lia. replace (Nat.min (S l) (n - i)) with (S l) by lia. replace (Nat.min l (n - i)) with l by lia.
      replace (Nat.min l (n - S i)) with l by lia. rewrite bez_outer. f_equal. f_equal. apply bez_ext. intros; f_equal; lia.
    + rewrite IH by lia. f_equal. lia.
Qed.
Lemma cut_left x t n : forall p, bez n (fun i => bez i p t) x = bez n p (x * t).
Proof.
  induction n as [|n IH]; intros p; [reflexivity|]. rewrite !bez_outer, IH. simpl. rewrite IH, bez_linear. ring.
Qed.
Lemma cut_right x f n : forall p, bez n (fun i => bez (n - i) (fun k => p (i + k)%nat) f) x = bez n p (f + (1 - f) * x).
Proof.
  induction n as [|n IH]; intros p; [reflexivity|].
  transitivity ((1 - x) * bez n (fun i => (1 - f) * p i + f * p (S i)) (f + (1 - f) * x) +
    x * bez n (fun i => p (S i)) (f + (1 - f) * x)).
  - rewrite <- (IH (fun i => (1 - f) * p i + f * p (S i))), <- (IH (fun i => p (S i))), bez_outer. f_equal. f_equal.
    apply bez_ext. intros i I. replace (S n - i)%nat with (S (n - i)) by lia. simpl. apply bez_ext. intros k _.
    f_equal. f_equal. f_equal. lia.
  - rewrite bez_linear, bez_outer. ring.
Qed.
Definition cut n from to p := right_loop n from n (left_loop to n p).
Theorem cut_is n from to p x : bez n (cut n from to p) x = bez n p ((from + (1 - from) * x) * to).
Proof.
  rewrite <- cut_left, <- cut_right. apply bez_ext. intros i I. unfold cut. rewrite right_loop_is by auto.
  replace (Nat.min n (n - i)) with (n - i)%nat by lia. apply bez_ext. intros k K. rewrite left_loop_is.
  replace (Nat.min (i + k) n) with (i + k)%nat by lia. apply bez_ext. intros; f_equal; lia.
Qed.

(* verify__part_deviation's most, speed and bend of the points of a curve of degree n *)
Fixpoint largest n (p : nat -> R) := match n with O => Rabs (p O) | S m => Rmax (largest m p) (Rabs (p n)) end.
Lemma largest_is n p : forall i, (i <= n)%nat -> Rabs (p i) <= largest n p.
Proof.
  induction n as [|n IH]; intros i I; simpl; [replace i with O by lia; apply Rle_refl|].
  destruct (Nat.eq_dec i (S n)) as [->|]; [apply Rmax_r|]. eapply Rle_trans; [apply IH; lia|apply Rmax_l].
Qed.
Lemma bez_bounds n p x : 0 <= x <= 1 -> Rabs (bez n p x) <= largest n p.
Proof. intros I. apply bez_within; [exact I|apply largest_is]. Qed.
