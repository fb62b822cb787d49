(* Solid.v - the angle of a triangle as seen from a point, and what angles add up to: for triangles each edge of which goes there
   as often as back, seen from a point off their edges, the half solid angles sum to a whole number of half turns. *)
From Coq Require Import Reals Lra Lia Psatz List ZArith Permutation.
From Coquelicot Require Import Coquelicot.
From Svcd Require Export Inside.
Import ListNotations.
Local Open Scope R_scope.

(* each edge goes there as often as back *)
Definition balanced l := forall p q, evenly l p q.
Definition image (f : zv -> V) T := mkTri (f (za T)) (f (zb T)) (f (zc T)).
Definition touches x (l : list tri) := exists T, In T l /\ of_tri x T.

(* ---- the complex number d + y i of a triangle whose corners are at a, b, c as seen from a point, and its size *)
Definition dee a b c := norm a * norm b * norm c + dot a b * norm c + dot b c * norm a + dot c a * norm b.
Definition arr a b c := sqrt (dee a b c * dee a b c + det a b c * det a b c).
(* th is its half angle, up to half turns *)
Definition angle_of x T th := let a := vsub (c0 T) x in let b := vsub (c1 T) x in let c := vsub (c2 T) x in
  cos (2 * th) = dee a b c / arr a b c /\ sin (2 * th) = det a b c / arr a b c.
(* a point that is on no edge *)
Definition off_edge a b := 0 < norm a * norm b + dot a b.
Definition off_edges x T := let a := vsub (c0 T) x in let b := vsub (c1 T) x in let c := vsub (c2 T) x in
  off_edge a b /\ off_edge b c /\ off_edge c a.

Lemma wound_is x T : wound_by x T = let a := vsub (c0 T) x in let b := vsub (c1 T) x in let c := vsub (c2 T) x in
  atan (det a b c / (dee a b c + arr a b c)) / PI.
Proof. reflexivity. Qed.

Lemma norm_sq a : norm a * norm a = dot a a.
Proof. unfold norm. apply sqrt_sqrt, dot_pos. Qed.
Lemma gram a b c : det a b c * det a b c = dot a a * dot b b * dot c c + 2 * dot a b * dot b c * dot c a
  - dot a a * (dot b c * dot b c) - dot b b * (dot c a * dot c a) - dot c c * (dot a b * dot a b).
Proof. unfold det, dot, cross. simpl. ring. Qed.
Lemma arr2 a b c : arr a b c * arr a b c = dee a b c * dee a b c + det a b c * det a b c.
Proof. apply sqrt_sqrt. pose proof (Rle_0_sqr (dee a b c)). pose proof (Rle_0_sqr (det a b c)). unfold Rsqr in *. lra. Qed.
Lemma arr_sq a b c : dee a b c * dee a b c + det a b c * det a b c =
  2 * (norm a * norm b + dot a b) * (norm b * norm c + dot b c) * (norm c * norm a + dot c a).
Proof. rewrite gram, <- !norm_sq. unfold dee. ring. Qed.
Lemma arr_pos a b c : off_edge a b -> off_edge b c -> off_edge c a -> 0 < arr a b c.
Proof.
  unfold off_edge. intros A B C. apply sqrt_lt_R0. rewrite arr_sq. repeat apply Rmult_lt_0_compat; lra.
Qed.
Lemma off_edges_arr x T : off_edges x T -> 0 < arr (vsub (c0 T) x) (vsub (c1 T) x) (vsub (c2 T) x).
Proof. intros (A & B & C). apply arr_pos; auto. Qed.

(* ---- a vector's spinor: s = (vx, vy + vz i), with s s^* = stretch (|a| + a sigma), of Pauli's matrices *)
Definition spin a := if Rlt_dec 0 (norm a + vz a) then mkV (norm a + vz a) (vx a) (vy a) else mkV 0 1 0.
Definition stretch a := if Rlt_dec 0 (norm a + vz a) then norm a + vz a else / (2 * norm a).
Definition spins n k a s := vx s * vx s = k * (n + vz a) /\ vx s * vy s = k * vx a /\ vx s * vz s = k * vy a /\
  vy s * vy s + vz s * vz s = k * (n - vz a).
Lemma spin_ok a : 0 < norm a -> 0 < stretch a /\ spins (norm a) (stretch a) a (spin a).
Proof.
  intros P. pose proof (norm_sq a) as N. unfold dot in N. unfold spins, spin, stretch.
  destruct Rlt_dec as [L|L]; cbn [vx vy vz].
  - split; [exact L|]. repeat split; try ring. transitivity (norm a * norm a - vz a * vz a); [rewrite N|]; ring.
  - assert (Z : vz a <= - norm a) by lra. set (n := norm a) in *.
    assert (n * n <= vz a * vz a) by nra. pose proof (Rle_0_sqr (vx a)). pose proof (Rle_0_sqr (vy a)). unfold Rsqr in *.
    assert (X : vx a = 0) by (apply Rsqr_0_uniq; unfold Rsqr; lra).
    assert (Y : vy a = 0) by (apply Rsqr_0_uniq; unfold Rsqr; lra).
    assert (W : (n - vz a) * (n + vz a) = 0) by (rewrite X, Y in N; lra).
    apply Rmult_integral in W as [W|W]; [lra|]. replace (vz a) with (- n) by lra. rewrite X, Y.
    split; [apply Rinv_0_lt_compat; lra|]. repeat split; try ring. field. lra.
Qed.

(* complex numbers are pairs *)
Definition times z w := (fst z * fst w - snd z * snd w, fst z * snd w + snd z * fst w).
Lemma times_assoc z w v : times z (times w v) = times (times z w) v.
Proof. unfold times. simpl. f_equal; ring. Qed.
Lemma times_comm z w : times z w = times w z.
Proof. unfold times. f_equal; ring. Qed.
Lemma times_1 z : times (1, 0) z = z.
Proof. unfold times. destruct z. simpl. f_equal; ring. Qed.
(* an edge's: s^* t *)
Definition pass s t := (vx s * vx t + vy s * vy t + vz s * vz t, vy s * vz t - vz s * vy t).
Lemma pass_back s t : times (pass s t) (pass t s) =
  (fst (pass s t) * fst (pass s t) + snd (pass s t) * snd (pass s t), 0).
Proof. unfold times, pass. simpl. f_equal; ring. Qed.
Lemma pass_size n k a s m l b t : spins n k a s -> spins m l b t ->
  fst (pass s t) * fst (pass s t) + snd (pass s t) * snd (pass s t) = 2 * k * l * (n * m + dot a b).
Proof.
  intros (A & B & C & D) (E & F & G & H). unfold pass. cbn [fst snd].
  transitivity ((vx s * vx s) * (vx t * vx t) + 2 * (vx s * vy s) * (vx t * vy t) + 2 * (vx s * vz s) * (vx t * vz t)
    + (vy s * vy s + vz s * vz s) * (vy t * vy t + vz t * vz t)); [ring|].
  rewrite A, B, C, D, E, F, G, H. unfold dot. ring.
Qed.
Lemma pass_round n k a s m l b t o j c r : spins n k a s -> spins m l b t -> spins o j c r ->
  times (pass s t) (times (pass t r) (pass r s)) =
  (2 * k * l * j * (n * m * o + dot a b * o + dot b c * n + dot c a * m), 2 * k * l * j * det a b c).
Proof.
  intros (A0 & A1 & A2 & A3) (B0 & B1 & B2 & B3) (C0 & C1 & C2 & C3). unfold times, pass. cbn [fst snd].
  f_equal.
  - transitivity (let a0 := vx s * vx s in let a1 := vx s * vy s in let a2 := vx s * vz s in let a3 := vy s * vy s + vz s * vz s in
      let b0 := vx t * vx t in let b1 := vx t * vy t in let b2 := vx t * vz t in let b3 := vy t * vy t + vz t * vz t in
      let e0 := vx r * vx r in let e1 := vx r * vy r in let e2 := vx r * vz r in let e3 := vy r * vy r + vz r * vz r in
      a0 * b0 * e0 + (a1 * b1 + a2 * b2) * e0 + (b1 * e1 + b2 * e2) * a0 + (e1 * a1 + e2 * a2) * b0
      + (b1 * e1 + b2 * e2) * a3 + (e1 * a1 + e2 * a2) * b3 + (a1 * b1 + a2 * b2) * e3 + a3 * b3 * e3); [cbv zeta; ring|].
    cbv zeta. rewrite A0, A1, A2, A3, B0, B1, B2, B3, C0, C1, C2, C3. unfold dot. ring.
  - transitivity (let a0 := vx s * vx s in let a1 := vx s * vy s in let a2 := vx s * vz s in let a3 := vy s * vy s + vz s * vz s in
      let b0 := vx t * vx t in let b1 := vx t * vy t in let b2 := vx t * vz t in let b3 := vy t * vy t + vz t * vz t in
      let e0 := vx r * vx r in let e1 := vx r * vy r in let e2 := vx r * vz r in let e3 := vy r * vy r + vz r * vz r in
      (a1 * b2 - a2 * b1) * (e0 - e3) + (b1 * e2 - b2 * e1) * (a0 - a3) + (e1 * a2 - e2 * a1) * (b0 - b3)); [cbv zeta; ring|].
    cbv zeta. rewrite A0, A1, A2, A3, B0, B1, B2, B3, C0, C1, C2, C3. unfold det, dot, cross. cbn [vx vy vz]. ring.
Qed.

(* ---- the product over edges that go there as often as back is real, and positive *)
Section Product.
Variable z : zv * zv -> R * R.
Hypothesis Twice : forall p q, times (z (p, q)) (z (q, p)) =
  (fst (z (p, q)) * fst (z (p, q)) + snd (z (p, q)) * snd (z (p, q)), 0).
Hypothesis Same : forall p, 0 <= fst (z (p, p)) /\ snd (z (p, p)) = 0.
Definition some (w : R * R) := 0 < fst w * fst w + snd w * snd w.
Definition product := fold_right (fun e w => times (z e) w) (1, 0).
Lemma product_app l m : product (l ++ m) = times (product l) (product m).
Proof.
  induction l as [|e l IH]; simpl; [symmetry; apply times_1|]. rewrite IH. apply times_assoc.
Qed.
Lemma product_even n : forall E, (length E <= n)%nat ->
  (forall p q, count_occ edge_dec E (p, q) = count_occ edge_dec E (q, p)) ->
  (forall e, In e E -> some (z e)) -> exists P, 0 < P /\ product E = (P, 0).
Proof.
  induction n as [|n IH]; intros [|[p q] E] L C S; simpl in L; try (exists 1; split; [lra|reflexivity]); [lia|].
  assert (Sp : some (z (p, q))) by (apply S; left; reflexivity).
  destruct (zv_dec p q) as [<-|D].
  - destruct (IH E) as (P & HP & EP); [lia| |intros e I; apply S; right; exact I|].
    { intros u v. pose proof (C u v) as K. cbn [count_occ] in K.
      destruct (edge_dec (p, p) (u, v)) as [A|A], (edge_dec (p, p) (v, u)) as [B|B]; try lia; exfalso;
        [apply B|apply A]; congruence. }
    destruct (Same p) as [F Z]. unfold some in Sp. rewrite Z in Sp.
    exists (fst (z (p, p)) * P). split.
    + apply Rmult_lt_0_compat; [|exact HP]. destruct F as [F|F]; [exact F|]. rewrite <- F in Sp. lra.
    + simpl. fold product. rewrite EP. unfold times. cbn [fst snd]. rewrite Z. f_equal; ring.
  - assert (I : In (q, p) E).
    { pose proof (C p q) as K. cbn [count_occ] in K. destruct (edge_dec (p, q) (p, q)) as [_|X]; [|congruence].
      destruct (edge_dec (p, q) (q, p)) as [X|_]; [congruence|]. apply (count_occ_In edge_dec). lia. }
    apply in_split in I as (l & m & ->). rewrite app_length in L. simpl in L.
    destruct (IH (l ++ m)) as (P & HP & EP).
    { rewrite app_length. lia. }
    { intros u v. pose proof (C u v) as K. cbn [count_occ] in K.
      rewrite !count_occ_app in K. cbn [count_occ] in K. rewrite !count_occ_app.
      destruct (edge_dec (p, q) (u, v)) as [A|A], (edge_dec (p, q) (v, u)) as [B|B],
        (edge_dec (q, p) (u, v)) as [A'|A'], (edge_dec (q, p) (v, u)) as [B'|B']; try lia; exfalso; congruence. }
    { intros e J. apply S. right. apply in_app_iff in J. apply in_app_iff. simpl. tauto. }
    exists ((fst (z (p, q)) * fst (z (p, q)) + snd (z (p, q)) * snd (z (p, q))) * P).
    split; [apply Rmult_lt_0_compat; auto|]. rewrite product_app in EP. simpl. fold product. rewrite product_app. simpl.
    fold product. rewrite (times_assoc (product l)), (times_comm (product l)), <- (times_assoc (z (q, p))), EP.
    rewrite times_assoc, Twice. unfold times. cbn [fst snd]. f_equal; ring.
Qed.
End Product.

Lemma off_edge_norm a b : off_edge a b -> 0 < norm a.
Proof.
  unfold off_edge. intros H. pose proof (norm_pos a) as [P|Z]; [exact P|]. exfalso. pose proof (cauchy a b) as C.
  rewrite <- Z, Rmult_0_l in *. apply Rabs_le_between in C. lra.
Qed.

(* ---- edges that go there as often as back: whatever angles the triangles are given, they sum to half turns *)
Lemma angles_whole f l x (th : ztri -> R) : balanced l -> (forall T, In T l -> off_edges x (image f T)) ->
  (forall T, In T l -> angle_of x (image f T) (th T)) ->
  exists k : Z, fold_right (fun T s => th T + s) 0 l = IZR k * PI.
Proof.
  intros B O A. set (g p := vsub (f p) x). set (z (e : zv * zv) := pass (spin (g (fst e))) (spin (g (snd e)))).
  assert (N : forall T, In T l -> off_edge (g (za T)) (g (zb T)) /\ off_edge (g (zb T)) (g (zc T)) /\
    off_edge (g (zc T)) (g (za T))) by (intros T I; apply (O T I)).
  assert (S : forall T, In T l -> 0 < norm (g (za T)) /\ 0 < norm (g (zb T)) /\ 0 < norm (g (zc T))).
  { intros T I. destruct (N T I) as (X & Y & Z). repeat split; eapply off_edge_norm; eassumption. }
  destruct (product_even z) with (n := length (flat_map edges l)) (E := flat_map edges l) as (P & HP & EP).
  { intros p q. apply pass_back. }
  { intros p. unfold z, pass. cbn [fst snd]. split; [|ring]. set (s := spin (g p)).
    pose proof (Rle_0_sqr (vx s)). pose proof (Rle_0_sqr (vy s)). pose proof (Rle_0_sqr (vz s)). unfold Rsqr in *. lra. }
  { reflexivity. }
  { exact B. }
  { intros e I. apply in_flat_map in I as (T & IT & I).
    assert (G : forall a b, 0 < norm a -> 0 < norm b -> off_edge a b -> some (pass (spin a) (spin b))).
    { intros a b Pa Pb E. destruct (spin_ok a Pa) as (Ka & Sa), (spin_ok b Pb) as (Kb & Sb). unfold some.
      rewrite (pass_size _ _ _ _ _ _ _ _ Sa Sb). unfold off_edge in E. repeat apply Rmult_lt_0_compat; lra. }
    destruct (N T IT) as (X & Y & Z), (S T IT) as (Sa & Sb & Sc).
    destruct I as [<-|[<-|[<-|[]]]]; apply G; auto. }
  assert (Q : exists Q, 0 < Q /\ product z (flat_map edges l) =
    (Q * cos (2 * fold_right (fun T s => th T + s) 0 l), Q * sin (2 * fold_right (fun T s => th T + s) 0 l))).
  { clear B P HP EP O. induction l as [|T k IH].
    - exists 1. split; [lra|]. simpl. rewrite Rmult_0_r, cos_0, sin_0. f_equal; ring.
    - destruct IH as (Q & HQ & EQ); try (intros U I; first [apply A|apply N|apply S]; right; exact I).
      destruct (N T) as (X & Y & Z); [left; reflexivity|]. destruct (S T) as (Sa & Sb & Sc); [left; reflexivity|].
      destruct (spin_ok _ Sa) as (Ka & Ta), (spin_ok _ Sb) as (Kb & Tb), (spin_ok _ Sc) as (Kc & Tc).
      destruct (A T) as [C D]; [left; reflexivity|]. pose proof (arr_pos _ _ _ X Y Z) as R.
      pose proof (pass_round _ _ _ _ _ _ _ _ _ _ _ _ Ta Tb Tc) as M. fold (dee (g (za T)) (g (zb T)) (g (zc T))) in M.
      change (vsub (c0 (image f T)) x) with (g (za T)) in *. change (vsub (c1 (image f T)) x) with (g (zb T)) in *.
      change (vsub (c2 (image f T)) x) with (g (zc T)) in *. cbv zeta in C, D.
      set (K := 2 * stretch (g (za T)) * stretch (g (zb T)) * stretch (g (zc T))) in *.
      set (r := arr _ _ _) in *.
      assert (HK : 0 < K) by (clear - Ka Kb Kc; unfold K; clear K; repeat apply Rmult_lt_0_compat; lra).
      exists (K * r * Q). split; [repeat (apply Rmult_lt_0_compat; auto)|].
      change (flat_map edges (T :: k)) with (edges T ++ flat_map edges k). rewrite product_app, EQ.
      replace (product z (edges T)) with (K * r * cos (2 * th T), K * r * sin (2 * th T)).
      + simpl. rewrite Rmult_plus_distr_l, cos_plus, sin_plus. unfold times. simpl. f_equal; ring.
      + unfold edges. simpl. unfold z at 1 2 3. cbn [fst snd]. rewrite (times_comm _ (1, 0)), times_1, M, C, D.
        f_equal; field; lra. }
  destruct Q as (Q & HQ & EQ). set (s := fold_right _ _ _) in *. rewrite EP in EQ. injection EQ as E1 E2.
  assert (Z : sin (2 * s) = 0) by (symmetry in E2; apply Rmult_integral in E2 as [E2|E2]; lra).
  assert (C : 0 < cos (2 * s)) by (apply Rmult_lt_reg_l with Q; [exact HQ|rewrite <- E1; lra]).
  destruct (sin_eq_0_0 s) as (k & E); [|exists k; exact E].
  pose proof (sin2_cos2 (2 * s)) as U. rewrite Z in U. unfold Rsqr in U.
  assert (V : (cos (2 * s) - 1) * (cos (2 * s) + 1) = 0) by lra. apply Rmult_integral in V as [V|V]; [|lra].
  rewrite cos_2a_sin in V. assert (W : sin s * sin s = 0) by lra. apply Rmult_integral in W as [W|W]; exact W.
Qed.

(* ---- a point off a triangle *)
Lemma mixed x T p q r : 0 <= p -> 0 <= q -> 0 <= r -> 0 < p + q + r ->
  vadd (vscale p (vsub (c0 T) x)) (vadd (vscale q (vsub (c1 T) x)) (vscale r (vsub (c2 T) x))) = mkV 0 0 0 -> of_tri x T.
Proof.
  intros P Q R S E. set (s := p + q + r) in *. assert (I : 0 < / s) by (apply Rinv_0_lt_compat; exact S).
  exists (p / s), (q / s), (r / s). unfold Rdiv. repeat (split; [apply Rmult_le_pos; lra|]).
  split; [unfold s; field; unfold s in S; lra|].
  injection E as X Y Z. apply V_eq; unfold mix, vadd, vscale; cbn [vx vy vz].
  - apply Rmult_eq_reg_l with s; [|lra]. transitivity (p * vx (c0 T) + q * vx (c1 T) + r * vx (c2 T)); [|field; lra].
    unfold s. lra.
  - apply Rmult_eq_reg_l with s; [|lra]. transitivity (p * vy (c0 T) + q * vy (c1 T) + r * vy (c2 T)); [|field; lra].
    unfold s. lra.
  - apply Rmult_eq_reg_l with s; [|lra]. transitivity (p * vz (c0 T) + q * vz (c1 T) + r * vz (c2 T)); [|field; lra].
    unfold s. lra.
Qed.

Lemma dot_zero a : dot a a <= 0 -> a = mkV 0 0 0.
Proof.
  unfold dot. intros H. pose proof (Rle_0_sqr (vx a)). pose proof (Rle_0_sqr (vy a)). pose proof (Rle_0_sqr (vz a)).
  unfold Rsqr in *. apply V_eq; cbn [vx vy vz]; apply Rsqr_0_uniq; unfold Rsqr; lra.
Qed.

Lemma on_edge a b : ~ off_edge a b -> exists p q, 0 <= p /\ 0 <= q /\ 0 < p + q /\ vadd (vscale p a) (vscale q b) = mkV 0 0 0.
Proof.
  unfold off_edge. intros N. pose proof (norm_pos a) as A. pose proof (norm_pos b) as B.
  destruct (Req_dec (norm a) 0) as [Z|Z].
  - exists 1, 0. repeat (split; [lra|]). pose proof (norm_sq a) as E. rewrite Z in E.
    assert (X : a = mkV 0 0 0) by (apply dot_zero; lra). rewrite X. apply V_eq; unfold vadd, vscale; simpl; ring.
  - exists (norm b), (norm a). repeat (split; [lra|]). apply dot_zero.
    replace (dot _ _) with (norm b * norm b * dot a a + 2 * (norm a * norm b) * dot a b + norm a * norm a * dot b b)
      by (unfold dot, vadd, vscale; simpl; ring).
    rewrite <- !norm_sq.
    replace (_ + _ + _) with (2 * ((norm a * norm b) * (norm a * norm b + dot a b))) by ring.
    assert (0 <= norm a * norm b) by (apply Rmult_le_pos; auto). assert (norm a * norm b + dot a b <= 0) by lra. nra.
Qed.

Lemma off_tri_edges x T : ~ of_tri x T -> off_edges x T.
Proof.
  intros N. set (a := vsub (c0 T) x). set (b := vsub (c1 T) x). set (c := vsub (c2 T) x).
  assert (D : forall e f, {off_edge e f} + {~ off_edge e f}) by (intros; apply Rlt_dec).
  assert (Z : forall e f, vadd e f = mkV 0 0 0 -> forall g, vadd e (vadd f (vscale 0 g)) = mkV 0 0 0 /\
    vadd (vscale 0 g) (vadd e f) = mkV 0 0 0 /\ vadd f (vadd (vscale 0 g) e) = mkV 0 0 0).
  { intros e f E g. injection E as X Y W. repeat split; apply V_eq; unfold vadd, vscale; cbn [vx vy vz]; lra. }
  split; [|split].
  - destruct (D a b) as [H|H]; [exact H|]. exfalso. apply N. apply on_edge in H as (p & q & P & Q & S & E).
    apply (mixed x T p q 0); try lra. apply Z, E.
  - destruct (D b c) as [H|H]; [exact H|]. exfalso. apply N. apply on_edge in H as (p & q & P & Q & S & E).
    apply (mixed x T 0 p q); try lra. apply Z, E.
  - destruct (D c a) as [H|H]; [exact H|]. exfalso. apply N. apply on_edge in H as (p & q & P & Q & S & E).
    apply (mixed x T q 0 p); try lra. apply Z, E.
Qed.

Lemma crosses_dot a b c : norm c * dee a b c =
  (norm b * norm c + dot b c) * (norm c * norm a + dot c a) - dot (cross b c) (cross c a).
Proof.
  replace (dot (cross b c) (cross c a)) with (dot b c * dot c a - dot a b * dot c c) by (unfold dot, cross; simpl; ring).
  rewrite <- norm_sq. unfold dee. ring.
Qed.
Lemma dee_round a b c : dee b c a = dee a b c.
Proof. unfold dee. ring. Qed.

Lemma heart x T : ~ of_tri x T -> let a := vsub (c0 T) x in let b := vsub (c1 T) x in let c := vsub (c2 T) x in
  0 < arr a b c /\ 0 < dee a b c + arr a b c.
Proof.
  intros N a b c. pose proof (off_tri_edges x T N) as O. split; [apply off_edges_arr, O|].
  destruct (Rlt_dec 0 (dee a b c + arr a b c)) as [H|H]; [exact H|]. exfalso. apply N.
  pose proof (arr2 a b c) as S.
  pose proof (off_edges_arr x T O) as R. fold a b c in R.
  assert (D : dee a b c < 0) by lra.
  assert (Y : det a b c = 0).
  { apply Rsqr_0_uniq. pose proof (Rle_0_sqr (det a b c)). unfold Rsqr in *.
    assert (arr a b c * arr a b c <= dee a b c * dee a b c) by nra. lra. }
  destruct O as (Oa & Ob & Oc). fold a b c in Oa, Ob, Oc.
  pose proof (off_edge_norm a b Oa) as Na. pose proof (off_edge_norm b c Ob) as Nb. pose proof (off_edge_norm c a Oc) as Nc.
  unfold off_edge in *.
  assert (P : 0 < dot (cross b c) (cross c a)).
  { pose proof (crosses_dot a b c). assert (norm c * dee a b c < 0) by nra.
    assert (0 < (norm b * norm c + dot b c) * (norm c * norm a + dot c a)) by (apply Rmult_lt_0_compat; auto). lra. }
  assert (Q : 0 < dot (cross a b) (cross b c)).
  { pose proof (crosses_dot c a b) as E. rewrite (dee_round b c a), (dee_round a b c) in E.
    assert (norm b * dee a b c < 0) by nra.
    assert (0 < (norm a * norm b + dot a b) * (norm b * norm c + dot b c)) by (apply Rmult_lt_0_compat; auto).
    lra. }
  apply (mixed x T (dot (cross b c) (cross b c)) (dot (cross b c) (cross c a)) (dot (cross a b) (cross b c))); fold a b c;
    try lra; try apply dot_pos; [pose proof (dot_pos (cross b c)); lra|].
  transitivity (vscale (det a b c) (cross b c)); [apply V_eq; unfold det, dot, cross, vadd, vscale; simpl; ring|].
  rewrite Y. apply V_eq; unfold vscale; simpl; ring.
Qed.

(* half the angle of X + Y i is an arctangent *)
Lemma half_angle X Y r : r * r = X * X + Y * Y -> 0 < r -> 0 < X + r ->
  cos (2 * atan (Y / (X + r))) = X / r /\ sin (2 * atan (Y / (X + r))) = Y / r.
Proof.
  intros E R P. set (t := Y / (X + r)). assert (T : t * (X + r) = Y) by (unfold t; field; lra).
  assert (T0 : 0 <= t²) by apply Rle_0_sqr. assert (Q : 0 < sqrt (1 + t²)) by (apply sqrt_lt_R0; lra).
  assert (Q2 : sqrt (1 + t²) * sqrt (1 + t²) = 1 + t * t) by (rewrite sqrt_sqrt by lra; reflexivity).
  rewrite cos_2a_cos, sin_2a, cos_atan, sin_atan.
  assert (W : (1 + t * t) * (X + r) = 2 * r).
  { apply Rmult_eq_reg_r with (X + r); [|lra].
    replace ((1 + t * t) * (X + r) * (X + r)) with ((X + r) * (X + r) + (t * (X + r)) * (t * (X + r))) by ring. rewrite T.
    ring [E]. }
  assert (N : 1 + t * t <> 0) by (intros N; rewrite N in W; lra).
  assert (I : 1 / (1 + t * t) = (X + r) / (2 * r)).
  { apply Rmult_eq_reg_l with (1 + t * t); [|exact N]. transitivity 1; [field; exact N|].
    transitivity ((1 + t * t) * (X + r) / (2 * r)); [rewrite W; field; lra|field; lra]. }
  split.
  - replace (2 * _ * _ - 1) with (2 * (1 / (sqrt (1 + t²) * sqrt (1 + t²))) - 1) by (field; lra).
    rewrite Q2, I. field. lra.
  - replace (2 * _ * _) with (2 * t * (1 / (sqrt (1 + t²) * sqrt (1 + t²)))) by (field; lra).
    rewrite Q2, I. transitivity (t * (X + r) / r); [field; lra|rewrite T; reflexivity].
Qed.
Lemma turns x T : ~ of_tri x T -> angle_of x T (wound_by x T * PI).
Proof.
  intros N. destruct (heart x T N) as [R S]. rewrite wound_is. unfold angle_of. cbv zeta.
  replace (atan _ / PI * PI) with (atan (det (vsub (c0 T) x) (vsub (c1 T) x) (vsub (c2 T) x) /
    (dee (vsub (c0 T) x) (vsub (c1 T) x) (vsub (c2 T) x) + arr (vsub (c0 T) x) (vsub (c1 T) x) (vsub (c2 T) x))))
    by (field; apply PI_neq0).
  apply half_angle; [apply arr2|exact R|exact S].
Qed.

(* ---- and how it goes where the corners and the point move *)
Lemma steady_sqrt g : (forall u, 0 <= g u) -> steady g -> steady (fun u => sqrt (g u)).
Proof. intros P G u. apply (continuity_pt_comp g sqrt); [apply G|]. apply continuity_pt_sqrt, P. Qed.
Lemma steady_dot f g : steadyV f -> steadyV g -> steady (fun u => dot (f u) (g u)).
Proof. intros (A & B & C) (D & E & F). unfold dot. steady. Qed.
Lemma steady_cross f g : steadyV f -> steadyV g -> steadyV (fun u => cross (f u) (g u)).
Proof. intros (A & B & C) (D & E & F). repeat split; simpl; steady. Qed.
Lemma steady_norm f : steadyV f -> steady (fun u => norm (f u)).
Proof. intros F. apply steady_sqrt; [intros; apply dot_pos|]. apply steady_dot; exact F. Qed.
Lemma steady_det a b c : steadyV a -> steadyV b -> steadyV c -> steady (fun u => det (a u) (b u) (c u)).
Proof. intros A B C. unfold det. apply steady_dot; [exact A|]. apply steady_cross; auto. Qed.
Lemma steady_dee a b c : steadyV a -> steadyV b -> steadyV c -> steady (fun u => dee (a u) (b u) (c u)).
Proof.
  intros A B C. unfold dee. pose proof (steady_norm a A). pose proof (steady_norm b B). pose proof (steady_norm c C).
  pose proof (steady_dot a b A B). pose proof (steady_dot b c B C). pose proof (steady_dot c a C A). steady.
Qed.
Lemma steady_arr a b c : steadyV a -> steadyV b -> steadyV c -> steady (fun u => arr (a u) (b u) (c u)).
Proof.
  intros A B C. pose proof (steady_dee a b c A B C). pose proof (steady_det a b c A B C). apply steady_sqrt; [|steady].
  intros u. pose proof (Rle_0_sqr (dee (a u) (b u) (c u))). pose proof (Rle_0_sqr (det (a u) (b u) (c u))). unfold Rsqr in *. lra.
Qed.

Lemma wound_steady (f : R -> zv -> V) (x : R -> V) T u : (forall p, steadyV (fun u => f u p)) -> steadyV x ->
  ~ of_tri (x u) (image (f u) T) -> continuity_pt (fun u => wound_by (x u) (image (f u) T)) u.
Proof.
  intros F X N. destruct (heart _ _ N) as [_ S].
  assert (G : forall p, steadyV (fun u => vsub (f u p) (x u))) by (intros p; apply steady_vsub; auto).
  pose proof (steady_dee _ _ _ (G (za T)) (G (zb T)) (G (zc T)) u) as D.
  pose proof (steady_arr _ _ _ (G (za T)) (G (zb T)) (G (zc T)) u) as A.
  pose proof (steady_det _ _ _ (G (za T)) (G (zb T)) (G (zc T)) u) as Y.
  set (d := fun u => dee (vsub (f u (za T)) (x u)) (vsub (f u (zb T)) (x u)) (vsub (f u (zc T)) (x u))) in *.
  set (r := fun u => arr (vsub (f u (za T)) (x u)) (vsub (f u (zb T)) (x u)) (vsub (f u (zc T)) (x u))) in *.
  set (y := fun u => det (vsub (f u (za T)) (x u)) (vsub (f u (zb T)) (x u)) (vsub (f u (zc T)) (x u))) in *.
  change (continuity_pt (fun u => atan (y u / (d u + r u)) * / PI) u).
  apply (continuity_pt_mult (fun u => atan (y u / (d u + r u))) (fun _ => / PI)); [|apply steady_const].
  apply (continuity_pt_comp (fun u => y u / (d u + r u)) atan).
  - apply (continuity_pt_div y (fun u => d u + r u)); [exact Y|apply continuity_pt_plus; [exact D|exact A]|].
    apply Rgt_not_eq. exact S.
  - apply derivable_continuous_pt, derivable_pt_atan.
Qed.

(* what is continuous and a whole number all along stays what it is *)
Lemma whole_stays g s e : s <= e -> (forall u, s <= u <= e -> continuity_pt g u) ->
  (forall u, s <= u <= e -> exists k : Z, g u = IZR k) -> g s = g e.
Proof.
  intros L C W. set (c u := s + clamped u * (e - s)).
  assert (Rc : forall u, s <= c u <= e) by (intros u; unfold c; pose proof (clamped_range u); nra).
  assert (K : steady c) by (unfold c, clamped; steady).
  assert (G : steady (fun u => g (c u))) by (intros u; apply (continuity_pt_comp c g); [apply K|apply C, Rc]).
  assert (C0 : c 0 = s) by (unfold c; rewrite clamped_0; ring).
  assert (C1 : c 1 = e) by (unfold c; destruct (past_1 1) as [-> _]; [lra|ring]).
  destruct (Req_dec (g s) (g e)) as [E|E]; [exact E|exfalso].
  destruct (W s) as (j & J); [lra|]. destruct (W e) as (k & H); [lra|].
  assert (No : forall y n, y = IZR n + / 2 -> Rmin (g s) (g e) <= y <= Rmax (g s) (g e) -> False).
  { intros y n Y B. destruct (IVT_gen (fun u => g (c u)) 0 1 y G) as (v & _ & V); [rewrite C0, C1; exact B|].
    destruct (W (c v) (Rc v)) as (i & I). rewrite I, Y in V.
    assert (X : IZR (2 * i) = IZR (2 * n + 1)) by (rewrite plus_IZR, !mult_IZR; lra). apply eq_IZR in X. lia. }
  rewrite J, H in *. assert (D : (j < k \/ k < j)%Z) by (destruct (Z.lt_total j k) as [|[->|]]; auto; contradiction).
  destruct D as [D|D]; pose proof (IZR_lt _ _ D); apply Zlt_le_succ, IZR_le in D; rewrite succ_IZR in D;
    [apply (No (IZR j + / 2) j eq_refl); rewrite Rmin_left, Rmax_right
      |apply (No (IZR k + / 2) k eq_refl); rewrite Rmin_right, Rmax_left];
    lra.
Qed.
