(* referee.ml - build/referee: the checkers that Checker.v, Meeting.v and Rays.v prove sound, on the
   files that build/verify reads (examples/FORMATS.md), by code that shares no line with it.

     referee PROBLEMS.txt FOLDER [--clearance METRES] [--only ID,ID] [--claims] [--exact] [--coq]
     referee --sha256 FILE

   A line for each problem, as verify prints them:
     ID accepted|refused|uncovered REASON BYTES MICROSECONDS
   uncovered: the theorem does not speak of it. --claims: a sixth field, the claim of what is accepted.
   --exact: on integers, not on the processor's doubles, and thousands of times slower. --coq: prints what
   accepts_Z takes, as Coq terms, in place of checks. --sha256: the SHA-256 of a file, for tests.
   To be believed, beside Coq and OCaml, is this file: that the scene is the one which the files hold.
   Exit status: 0 none is refused, 1 one is, 2 a file cannot be read, or usage. *)
type real = float
module Zarith = Z
open Extracted
open Stdlib  (* Coq has a float, a max and a sqrt of its own *)

let fail path reason = Printf.eprintf "referee: %s: %s\n" path reason; exit 2
let z = Big_int_Z.big_int_of_int
let shifted n k = Big_int_Z.shift_left_big_int n k

(* ---- numbers: floats, and their exact values *)

let single x = Int32.float_of_bits (Int32.bits_of_float x)
let word x = Int32.to_int (Int32.bits_of_float x) land 0xffffffff
let number path text =
  match if String.contains text '_' then None else float_of_string_opt text with
  | Some x when Float.abs x <= 3e38 -> x
  | _ -> fail path "a number is none"
(* as strtoll reads them: OCaml's own reader takes 0x10 and 1_0 too *)
let integer text =
  if String.for_all (String.contains "+-0123456789") text then int_of_string_opt text else None
(* x = n 2^-k, of the least k that is no less than 0 *)
let dyadic x =
  let m, e = Float.frexp x in
  let rec even n k = if k <= 0 || Int64.rem n 2L <> 0L then (n, k) else even (Int64.div n 2L) (k - 1) in
  let n, k = if x = 0. then (0L, 0) else even (Int64.of_float (Float.ldexp m 53)) (53 - e) in
  (shifted (Big_int_Z.big_int_of_int64 n) (max 0 (- k)), max 0 k)
let rational x = let n, k = dyadic x in { qnum = n; qden = shifted (z 1) k }

(* ---- texts *)

let read_file path =
  match open_in_bin path with
  | exception Sys_error _ -> None
  | file ->
    let text = Buffer.create 65536 in
    let rec read () = match Buffer.add_channel text file 65536 with
      | () -> read ()
      | exception End_of_file -> Some (Buffer.contents text)
      | exception Sys_error _ -> None in
    let all = read () in
    close_in file; all
let need path = match read_file path with None -> fail path "it cannot be read" | Some text -> text
let is_blank = String.contains " \t\011\012"
(* The words of each line that has any. A backslash at its end continues a line, but for one with a comment. *)
let lines_of path most text =
  if String.contains text '\000' then fail path "a zero byte in a text";
  let plain = Buffer.create (String.length text) in
  let follows k c = k + 1 < String.length text && text.[k + 1] = c in
  String.iteri (fun k c -> if c <> '\r' then Buffer.add_char plain c
    else if not (follows k '\n') then Buffer.add_char plain '\n') text;
  let words line =
    let line = match String.index_opt line '#' with Some i -> String.sub line 0 i | None -> line in
    let words = List.filter (( <> ) "") (String.split_on_char ' ' (String.map (fun c -> if is_blank c then ' ' else c) line)) in
    if List.length words > most then fail path "a line has too many words";
    words in
  let rec join found = function
    | line :: next :: rest when line <> "" && line.[String.length line - 1] = '\\' && not (String.contains line '#') ->
      join found ((String.sub line 0 (String.length line - 1) ^ " " ^ next) :: rest)
    | line :: rest -> join (match words line with [] -> found | words -> words :: found) rest
    | [] -> List.rev found in
  join [] (String.split_on_char '\n' (Buffer.contents plain))

(* ---- digests, which tell mix-ups and prove nothing *)

let mixed hash word =
  let hash = (hash lxor word) * 0x9e3779b1 land 0xffffffff in
  hash lxor (hash lsr 15)
let hash seed words = List.fold_left mixed seed words
let fold_16 digest = (digest lxor (digest lsr 16)) land 0xffff
let fold_8 digest = let d = digest lxor (digest lsr 16) in (d lxor (d lsr 8)) land 0xff

(* ---- SHA-256 (FIPS 180-4): a claim names what is proven, and proves nothing *)

let bytes_of add words =
  let bytes = Buffer.create 1024 in
  List.iter (fun x -> add bytes (Int32.of_int x)) words;
  Buffer.contents bytes
let little words = bytes_of Buffer.add_int32_le words
(* the first 32 bits behind the point of roots of primes *)
let fractions root count =
  let is_prime n = List.for_all (fun d -> n mod d <> 0) (List.init (n - 2) (fun k -> k + 2)) in
  let primes = List.filteri (fun k _ -> k < count) (List.filter is_prime (List.init 310 (fun k -> k + 2))) in
  let bits p = Zarith.root (shifted (z p) (32 * root)) root in
  List.map (fun p -> Zarith.to_int (bits p) land 0xffffffff) primes
let keys = Array.of_list (fractions 3 64)
let sha_256 text =
  let size = String.length text in
  let padded = Bytes.make ((size + 72) / 64 * 64) '\000' in
  Bytes.blit_string text 0 padded 0 size;
  Bytes.set padded size '\x80';
  Bytes.set_int64_be padded (Bytes.length padded - 8) (Int64.of_int (8 * size));
  let state = ref (fractions 2 8) in
  let turned x n = (x lsr n) lor (x lsl (32 - n)) and low x = x land 0xffffffff in
  for block = 0 to Bytes.length padded / 64 - 1 do
    let word i = low (Int32.to_int (Bytes.get_int32_be padded (64 * block + 4 * i))) in
    let w = Array.init 64 (fun i -> if i < 16 then word i else 0) in
    for i = 16 to 63 do
      let x = w.(i - 15) and y = w.(i - 2) in
      w.(i) <- low (w.(i - 16) + low (turned x 7 lxor turned x 18 lxor (x lsr 3))
                    + w.(i - 7) + low (turned y 17 lxor turned y 19 lxor (y lsr 10)))
    done;
    let round state i = match state with
      | [a; b; c; d; e; f; g; h] ->
        let one = h + low (turned e 6 lxor turned e 11 lxor turned e 25) + ((e land f) lxor (lnot e land g)) + keys.(i) + w.(i) in
        let two = low (turned a 2 lxor turned a 13 lxor turned a 22) + ((a land b) lxor (a land c) lxor (b land c)) in
        [low (one + two); a; b; c; low (d + one); e; f; g]
      | _ -> assert false in
    state := List.map2 (fun x y -> low (x + y)) !state (List.fold_left round !state (List.init 64 Fun.id))
  done;
  bytes_of Buffer.add_int32_be !state
let hexadecimal text = String.concat "" (List.map (fun c -> Printf.sprintf "%02x" (Char.code c)) (List.of_seq (String.to_seq text)))

(* ---- meshes *)

type mesh = { name : string; digest : int; unit_ : int; triangles : ztri list; sum : string Lazy.t; ways_in : zv list option; corner_of : int -> zv option }

(* Hints, which the checker does not believe: where rays begin, a corner of each component, in the order of the components' lowest
   vertices. None: where a vertex of no triangle is at the place of another, it may be what stands for that *)
let hints points faces =
  let part = Array.init (Array.length points) (fun v -> v) and used = Array.make (Array.length points) false in
  let rec root v = if part.(v) = v then v else (part.(v) <- part.(part.(v)); root part.(v)) in
  let unite v w = let v = root v and w = root w in part.(max v w) <- min v w in
  List.iter (fun (a, b, c) -> unite a b; unite b c; List.iter (fun v -> used.(v) <- true) [a; b; c]) faces;
  let places = Hashtbl.create 1000 and clear = ref true in
  let key p = List.map Big_int_Z.string_of_big_int [p.zx; p.zy; p.zz] in
  Array.iteri (fun v p -> match Hashtbl.find_opt places (key p) with
    | None -> Hashtbl.add places (key p) v
    | Some w -> if used.(v) <> used.(w) then clear := false; if used.(v) && used.(w) then unite v w) points;
  let starts = List.filter (fun v -> used.(v) && root v = v) (List.init (Array.length points) (fun v -> v)) in
  ((if !clear then Some (List.map (fun v -> points.(v)) starts) else None),
   fun v -> if v < Array.length points && used.(v) then Some points.(v) else None)

(* A face as triangles, numbered in the order in which ears are cut off it (Meisters 1975). It is seen along the
   axis that its normal is nearest to. One that crosses itself may have no ear: then the next corner is cut off. *)
let cut_ears path points face =
  let n = Array.length face in
  if n < 3 then fail path "a face has fewer than three corners";
  if Array.exists (fun v -> v >= Array.length points) face then fail path "an index is out of range";
  let at k = points.(face.(k)) in
  let normal axis =
    let u = (axis + 1) mod 3 and v = (axis + 2) mod 3 and o = at 0 in
    let add sum k = let p = at k and q = at ((k + 1) mod n) in
      sum +. ((p.(u) -. o.(u)) *. (q.(v) -. o.(v)) -. (p.(v) -. o.(v)) *. (q.(u) -. o.(u))) in
    List.fold_left add 0. (List.init n Fun.id) in
  let longer i j = if Float.abs (normal j) > Float.abs (normal i) then j else i in
  let axis = longer (longer 0 1) 2 in
  let u, v = if normal axis < 0. then (axis + 2, axis + 1) else (axis + 1, axis + 2) in
  let x k = (at k).(u mod 3) and y k = (at k).(v mod 3) in
  let turn a b c = (x b -. x a) *. (y c -. y a) -. (y b -. y a) *. (x c -. x a) in
  let before = Array.init n (fun k -> (k + n - 1) mod n) and after = Array.init n (fun k -> (k + 1) mod n) in
  let is_ear b =
    let a = before.(b) and c = after.(b) in
    let same p q = x p = x q && y p = y q in
    let in_the_way p = turn before.(p) p after.(p) < 0. && not (same p a || same p b || same p c)
      && turn a b p >= 0. && turn b c p >= 0. && turn c a p >= 0. in
    let rec any p = p <> a && (in_the_way p || any after.(p)) in
    turn a b c > 0. && not (any after.(c)) in
  let queue = Queue.of_seq (List.to_seq (List.init n Fun.id)) and waits = Array.make n true in
  let rec cut found left next =
    if left = 3 then List.rev ((face.(next), face.(after.(next)), face.(before.(next))) :: found)
    else let waited = Queue.take_opt queue in
      let b = Option.value waited ~default:next in
      if waited <> None then waits.(b) <- false;
      if waited <> None && not (is_ear b) then cut found left next
      else
        let a = before.(b) and c = after.(b) in
        after.(a) <- c; before.(c) <- a;
        List.iter (fun k -> if not waits.(k) then Queue.add k queue; waits.(k) <- true) [a; c];
        cut ((face.(a), face.(b), face.(c)) :: found) (left - 1) c in
  cut [] n 0

let starts_with start text = String.length text >= String.length start && String.sub text 0 (String.length start) = start
let read_obj path text =
  let points = ref [] and count = ref 0 and faces = ref [] in
  let corner word = match integer (List.hd (String.split_on_char '/' word)) with
    | Some k when k > 0 -> k - 1
    | Some k when k < 0 && k + !count >= 0 -> k + !count
    | _ -> fail path "a corner of a face is none" in
  let text = if starts_with "\xef\xbb\xbf" text then String.sub text 3 (String.length text - 3) else text in
  List.iter (function
    | "v" :: x :: y :: w :: _ -> incr count; points := Array.map (fun t -> single (number path t)) [| x; y; w |] :: !points
    | "v" :: _ -> fail path "a vertex has fewer than three numbers"
    | "f" :: corners -> faces := Array.of_list (List.map corner corners) :: !faces
    | _ -> ()) (lines_of path 65536 text);
  let points = Array.of_list (List.rev !points) in
  (points, List.concat_map (cut_ears path points) (List.rev !faces))

(* Corners at one place are one vertex, numbered as they first occur. *)
let read_stl path text =
  let size = String.length text in
  let count = if size < 84 then 0 else Int32.to_int (String.get_int32_le text 80) land 0xffffffff in
  let rec start k = if k < size && (is_blank text.[k] || text.[k] = '\n' || text.[k] = '\r') then start (k + 1) else k in
  let first = start 0 in
  let is_text = starts_with "solid" (String.lowercase_ascii (String.sub text first (min 5 (size - first)))) && size <> 84 + 50 * count in
  if not is_text && (size < 84 || (size - 84) / 50 < count) then fail path "it ends early";
  let corners = if is_text then List.filter_map (function
      | word :: numbers when Char.lowercase_ascii word.[0] = 'v' ->
        if List.length numbers <> 3 then fail path "a vertex has other than three numbers";
        Some (List.map (fun t -> single (number path t)) numbers)
      | _ -> None) (lines_of path 300 text)
    else List.init (3 * count) (fun k -> List.init 3 (fun i ->
      Int32.float_of_bits (String.get_int32_le text (84 + 50 * (k / 3) + 12 + 12 * (k mod 3) + 4 * i)))) in
  let known = Hashtbl.create 1024 and points = ref [] in
  let vertex corner =
    let place = List.map (fun x -> x +. 0.) corner in  (* -0 is 0 *)
    match Hashtbl.find_opt known place with
    | Some v -> v
    | None -> let v = Hashtbl.length known in Hashtbl.add known place v; points := Array.of_list place :: !points; v in
  let rec faces found = function
    | a :: b :: c :: rest -> let a = vertex a in let b = vertex b in faces ((a, b, vertex c) :: found) rest
    | [] -> List.rev found
    | _ -> fail path "it ends within a triangle" in
  let faces = faces [] corners in
  (Array.of_list (List.rev !points), faces)

let read_mesh name path =
  let is_stl = Filename.check_suffix (String.lowercase_ascii path) "stl" in
  let points, faces = (if is_stl then read_stl else read_obj) path (need path) in
  let all = List.concat_map Array.to_list (Array.to_list points) in
  if faces = [] then fail path "a mesh has no triangles, or too many";
  if List.exists (fun x -> not (Float.abs x <= 1e6)) all then fail path "a mesh has a coordinate out of range";
  let unit_ = List.fold_left (fun k x -> max k (snd (dyadic x))) 0 all in
  let exact x = let n, k = dyadic x in shifted n (unit_ - k) in
  let point v = let p = Array.map exact v in { zx = p.(0); zy = p.(1); zz = p.(2) } in
  let corners = Array.map point points in
  let triangle (a, b, c) = { za = corners.(a); zb = corners.(b); zc = corners.(c) } in
  let count = Array.length points and words = List.rev (List.rev_map word all) in
  let indices = List.concat_map (fun (a, b, c) -> [a; b; c]) faces in
  let ways_in, corner_of = hints corners faces in
  { name; unit_; ways_in; corner_of; triangles = List.rev (List.rev_map triangle faces); digest = hash (hash count words) indices;
    sum = lazy (sha_256 ("nsvcd mesh 1" ^ little [count; List.length faces] ^ little words ^ little indices)) }

(* ---- motions *)

let rec first n list = if n = 0 then [] else match list with [] -> [] | x :: rest -> x :: first (n - 1) rest
let read_pose path words =
  match List.map (number path) (first 7 words) with
  | [x; y; w; a; b; c; d] ->
    let length = sqrt (a *. a +. b *. b +. c *. c +. d *. d) in
    List.map single ([x; y; w] @ List.map (fun k -> k /. length) [a; b; c; d])
  | _ -> fail path "a line has too few words"
let fit scale poses =
  let unit_length = function
    | [_; _; _; a; b; c; d] -> Float.abs (a *. a +. b *. b +. c *. c +. d *. d -. 1.) < 2.1e-4
    | _ -> false in
  if not (scale >= single 1e-6 && scale <= 1e6) then Some "a scale is out of range"
  else if List.exists (List.exists (fun x -> not (Float.abs x <= 1e6))) poses then Some "a pose is out of range"
  else if not (List.for_all unit_length poses) then Some "a quaternion is not of unit length"
  else None
(* Of two ways round that are as long to a rounding, the sum in double decides for verify, and the exact
   one for the theorem: where these differ in sign, the motions do. *)
let rec same_way = function
  | (_ :: _ :: _ :: p) :: ((_ :: _ :: _ :: q) :: _ as rest) ->
    let rounded = List.fold_left2 (fun sum x y -> sum +. x *. y) 0. p q in
    let exact = List.fold_left2 (fun sum x y -> qplus sum (qmult (rational x) (rational y))) (rational 0.) p q in
    (rounded < 0.) = (Big_int_Z.sign_big_int exact.qnum < 0) && same_way rest
  | _ -> true
let body mesh scale poses =
  let exact pose = match List.map rational pose with
    | [x; y; w; a; b; c; d] -> { px = x; py = y; pz = w; hx = a; hy = b; hz = c; hw = d } | _ -> assert false in
  let poses = Array.of_list (List.map exact poses) in
  let last = Array.length poses - 1 in
  let knot k = rational (if last = 0 then float_of_int k else float_of_int k /. float_of_int last) in
  let piece k = { t_from = knot k; t_to = knot (k + 1); pose_from = poses.(k); pose_to = poses.(min last (k + 1)) } in
  { den = shifted (z 1) mesh.unit_; tris = mesh.triangles; size1 = rational scale; pieces = List.init (max 1 last) piece }
let motion_digest scale poses = hash (hash (List.length poses) (List.map word (List.concat poses))) [word scale]

(* ---- one certificate *)

let text_of = function
  | EndsEarly -> "it ends early" | NotSeparated -> "a plane does not part its nodes" | TooDeep -> "it is too deep"
  | OpensTriangles -> "it opens triangles" | Follows -> "something follows its end" | Unfit -> "a motion is unfit"
  | NotFree -> "it is no certificate of version 1" | NoTriangle -> "it names a triangle that there is not"
  | NotNear -> "two points are not as near as that" | NoEdge -> "it names an edge that there is not"
  | NotPierced -> "an edge does not pass through a triangle" | TooNear -> "a ray passes too near to an edge"
  | NotOutside -> "a ray does not show that a component is outside" | NoCorner -> "it names a corner that there is not"
  | NotInside -> "a ray does not show that a corner is inside"

type side = { mesh : mesh; scale : real; poses : real list list }

(* trees are built once for a mesh and a scale *)
let kept make = let table = Hashtbl.create 16 in fun s b ->
  let key = (s.mesh.name, s.scale) in
  match Hashtbl.find_opt table key with
  | Some tree -> tree
  | None -> let tree = make b in Hashtbl.add table key tree; tree
let kept_double = kept tree_double
let kept_Z = kept tree_Z
let surfaces = Hashtbl.create 16
let surface_kept mesh = match Hashtbl.find_opt surfaces mesh.name with
  | Some surface -> surface
  | None ->
    let surface = Option.bind mesh.ways_in (surface_of mesh.triangles) in
    Hashtbl.add surfaces mesh.name surface; surface

(* examples/verify/nsvcd_verify_claim.h: the bytes *)
let claim clearance a b =
  let side s = Lazy.force s.mesh.sum ^ little [word s.scale] ^ "\001" ^ little [List.length s.poses] ^ "\000"
    ^ little (List.concat_map (List.map word) s.poses) in
  hexadecimal (sha_256 ("nsvcd claim 1" ^ little [word clearance] ^ side a ^ side b))

let judge exact clearance a b bytes =
  let size = String.length bytes in
  let at k = if k < size then Char.code bytes.[k] else 0 in
  let motion = mixed ((motion_digest a.scale a.poses + 31 * motion_digest b.scale b.poses) land 0xffffffff) (word clearance) in
  let refused why byte = ("refused", if size = 0 then why else Printf.sprintf "%s, at byte %d" why (min byte size)) in
  if at 0 lsr 2 <> 1 then refused "it is no certificate of version 1" 5
  else if at 1 <> fold_8 a.mesh.digest then refused "it is about another mesh a" 5
  else if at 2 <> fold_8 b.mesh.digest then refused "it is about another mesh b" 5
  else if 256 * at 3 + at 4 <> fold_16 motion then refused "it is about another motion, scale or clearance" 5
  else
    let kind = at 0 land 3 in
    let ba = body a.mesh a.scale a.poses and bb = body b.mesh b.scale b.poses in
    let scene = { body_a = ba; body_b = bb; clearance = rational clearance } in
    let list = List.init size (fun k -> z (at k)) in
    let refused_at why rest = refused (text_of why) ((8 * size - List.length rest) / 8) in
    let sides = surface_kept a.mesh, surface_kept b.mesh in
    let unclear = a.mesh.ways_in = None || b.mesh.ways_in = None in
    if kind = 0 then match let fa, fb = sides in
        if exact then free_Z scene (kept_Z a ba) (kept_Z b bb) fa fb list
        else free_double scene (kept_double a ba) (kept_double b bb) fa fb list with
      | Yes () -> ("accepted", "free")
      | No (Unfit, _) when unclear -> ("uncovered", "vertices of no triangle at corners")
      | No (why, rest) -> refused_at why rest
    else if kind = 3 then match let fa, fb = sides in
        let corner of_b n = (if of_b then b else a).mesh.corner_of (Big_int_Z.int_of_big_int n) in
        if exact then inside_Z scene (kept_Z a ba) (kept_Z b bb) fa fb corner list
        else inside_double scene (kept_double a ba) (kept_double b bb) fa fb corner list with
      | Yes _ -> ("accepted", "inside")
      | No (Unfit, _) when unclear -> ("uncovered", "vertices of no triangle at corners")
      | No (why, rest) -> refused_at why rest
    else match if exact then meeting_Z scene list else meeting_double scene list with
      | Yes (hit, _) -> ("accepted", if hit then "hit" else "near")
      | No (why, rest) -> refused_at why rest

(* ---- as Coq terms: the scenes of Scenes.v *)

let print_coq id clearance a b bytes =
  let number n = let s = Big_int_Z.string_of_big_int n in if s.[0] = '-' then "(" ^ s ^ ")" else s in
  let q x = Printf.sprintf "(%s # %s)" (number x.qnum) (number x.qden) in
  let point p = Printf.sprintf "(mkZ %s %s %s)" (number p.zx) (number p.zy) (number p.zz) in
  let triangle t = Printf.sprintf "mkZT %s %s %s" (point t.za) (point t.zb) (point t.zc) in
  let pose p = "(mkPose " ^ String.concat " " (List.map q [p.px; p.py; p.pz; p.hx; p.hy; p.hz; p.hw]) ^ ")" in
  let piece p = Printf.sprintf "mkQP %s %s\n    %s\n    %s" (q p.t_from) (q p.t_to) (pose p.pose_from) (pose p.pose_to) in
  let body s = let b = body s.mesh s.scale s.poses in
    Printf.sprintf "(mkBody %s [\n  %s] %s [\n  %s])" (number b.den) (String.concat ";\n  " (List.map triangle b.tris))
      (q b.size1) (String.concat ";\n  " (List.map piece b.pieces)) in
  Printf.printf "Definition %s := mkScene\n  %s\n  %s\n  %s.\n" id (body a) (body b) (q (rational clearance));
  Printf.printf "Definition %s_bytes := [%s]%%Z.\n" id
    (String.concat "; " (List.init (String.length bytes) (fun k -> string_of_int (Char.code bytes.[k]))))

(* ---- files *)

let () =
  let usage () = prerr_endline "referee PROBLEMS.txt FOLDER [--clearance METRES] [--only ID,ID] [--claims] [--exact] [--coq]"; exit 2 in
  let clearance = ref 0. and only = ref None and exact = ref false and coq = ref false and claims = ref false in
  let refused = ref false and found = ref false in
  let rec options = function
    | "--clearance" :: x :: rest -> clearance := single (number "--clearance" x); options rest
    | "--only" :: ids :: rest -> only := Some (String.split_on_char ',' ids); options rest
    | "--claims" :: rest -> claims := true; options rest
    | "--exact" :: rest -> exact := true; options rest
    | "--coq" :: rest -> coq := true; options rest
    | [] -> ()
    | _ -> usage () in
  let path, folder = match Array.to_list Sys.argv with
    | [_; "--sha256"; path] -> print_endline (hexadecimal (sha_256 (need path))); exit 0
    | _ :: path :: folder :: rest -> options rest; (path, folder)
    | _ -> usage () in
  if not (!clearance >= 0. && !clearance <= 1e6) then fail "--clearance" "a clearance is out of range";
  let meshes = Hashtbl.create 16 in
  let say ?(claim = "") id verdict reason size taken =
    if verdict = "refused" then refused := true;
    Printf.printf "%s\t%s\t%s\t%d\t%.1f%s\n%!" id verdict reason size taken (if !claims then "\t" ^ claim else "") in
  let check id a b =
    match read_file (Printf.sprintf "%s/%s.cert" folder id) with
    | None -> say id "refused" "there is no certificate" 0 0.
    | Some bytes when !coq -> print_coq id !clearance a b bytes
    | Some bytes ->
      let start = Sys.time () in
      let verdict, reason = try judge !exact !clearance a b bytes
        with Stack_overflow -> ("uncovered", "it takes more stack than there is (ulimit -s)") in
      let taken = 1e6 *. (Sys.time () -. start) in
      let claim = if !claims && verdict = "accepted" then claim !clearance a b else "" in
      say ~claim id verdict reason (String.length bytes) taken in
  let problem id a b =
    match fit a.scale a.poses, fit b.scale b.poses with
    | Some why, _ | None, Some why -> say id "refused" why 0 0.
    | None, None when same_way a.poses && same_way b.poses -> check id a b
    | None, None -> say id "uncovered" "a turn of 180 degrees to a rounding" 0 0. in
  let side mesh scale poses = match Hashtbl.find_opt meshes mesh with
    | None -> fail path "a problem names a mesh that is not above it"
    | Some mesh -> { mesh; scale = single (number path scale); poses } in
  let rec run = function
    | [] -> ()
    | ["mesh"; name; file] :: rest ->
      let file = if file.[0] = '/' then file else Filename.concat (Filename.dirname path) file in
      if Hashtbl.mem meshes name then fail path "a mesh has the name of another";
      Hashtbl.add meshes name (read_mesh name file);
      run rest
    | ("problem" :: id :: mesh_a :: scale_a :: mesh_b :: scale_b :: more) :: rest when List.length more >= 10 ->
      let count word = match integer word with
        | Some n when n >= 1 && n <= 65536 && word.[0] <> '+' -> n | _ -> fail path "a COUNT is out of range" in
      let rec poses k found lines = match lines with
        | _ when k = 0 -> (List.rev found, lines)
        | line :: rest -> poses (k - 1) (read_pose path line :: found) rest
        | [] -> fail path "a line has too few words" in
      let resting = read_pose path more in
      let poses_a, rest = poses (count (List.nth more 9)) [] rest in
      let poses_b, rest = if List.length more = 10 then ([resting], rest) else poses (count (List.nth more 10)) [] rest in
      let a = side mesh_a scale_a poses_a and b = side mesh_b scale_b poses_b in
      if (match !only with None -> true | Some ids -> List.mem id ids) then (found := true; problem id a b);
      run rest
    | _ -> fail path "a line is neither a mesh nor a problem" in
  match lines_of path 300 (need path) with
  | ("nsvcd-problems" :: "1" :: _) :: rest ->
    run rest;
    if !only <> None && not !found then fail "--only" "the file has none of these";
    exit (if !refused then 1 else 0)
  | _ -> fail path "its first line is not nsvcd-problems 1"
