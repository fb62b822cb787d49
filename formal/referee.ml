(* referee.ml - build/referee: the checkers that Checker.v, Meeting.v and Rays.v prove sound, on the
   files that build/verify reads (examples/FORMATS.md), by code that shares no line with it.

     referee PROBLEMS.txt FOLDER [--clearance METRES] [--only ID,ID] [--exact] [--coq]

   A line for each problem, as verify prints them:
     ID accepted|refused|uncovered REASON BYTES MICROSECONDS
   uncovered: the theorem does not speak of it. --exact: on integers, not on the processor's doubles,
   and thousands of times slower. --coq: prints what accepts_Z takes, as Coq terms, in place of checks.
   To be believed, beside Coq and OCaml, is this file: that the scene is the one which the files hold.
   Exit status: 0 none is refused, 1 one is, 2 a file cannot be read, or usage. *)
type real = float
open Extracted
open Stdlib  (* Coq has a float, a max and a sqrt of its own *)

exception Uncovered of string
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
    let text = really_input_string file (in_channel_length file) in
    close_in file; Some text
let blank c = String.contains " \t\011\012" c
(* the words of each line that has any *)
let lines_of path =
  let text = match read_file path with None -> fail path "it cannot be read" | Some text -> text in
  let words line =
    let line = match String.index_opt line '#' with Some i -> String.sub line 0 i | None -> line in
    List.filter (( <> ) "") (String.split_on_char ' ' (String.map (fun c -> if blank c then ' ' else c) line)) in
  let lines = String.split_on_char '\n' (String.map (fun c -> if c = '\r' then '\n' else c) text) in
  if List.exists (fun l -> l <> "" && l.[String.length l - 1] = '\\') lines then raise (Uncovered "lines that continue");
  List.filter (( <> ) []) (List.map words lines)

(* ---- digests, which tell mix-ups and prove nothing *)

let mixed hash word =
  let hash = (hash lxor word) * 0x9e3779b1 land 0xffffffff in
  hash lxor (hash lsr 15)
let hash seed words = List.fold_left mixed seed words
let fold_16 digest = (digest lxor (digest lsr 16)) land 0xffff
let fold_8 digest = let d = digest lxor (digest lsr 16) in (d lxor (d lsr 8)) land 0xff

(* ---- meshes *)

type mesh = { name : string; digest : int; unit_ : int; triangles : ztri list; ways_in : zv list option; corner_of : int -> zv option }

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

let read_mesh name path =
  if Filename.check_suffix (String.lowercase_ascii path) ".stl" then raise (Uncovered "STL");
  let vertices = ref [] and faces = ref [] and count = ref 0 in
  let corner text =
    let text = match String.index_opt text '/' with Some i -> String.sub text 0 i | None -> text in
    match int_of_string_opt text with
    | Some k when k > 0 -> k - 1
    | Some k when k < 0 && k + !count >= 0 -> k + !count
    | _ -> fail path "a corner of a face is none" in
  List.iter (function
    | "v" :: x :: y :: w :: _ -> incr count; vertices := List.map (fun t -> single (number path t)) [x; y; w] :: !vertices
    | "v" :: _ -> fail path "a vertex has fewer than three numbers"
    | ["f"; a; b; c] -> faces := (corner a, corner b, corner c) :: !faces
    | "f" :: _ -> raise (Uncovered "faces of more than three corners")
    | _ -> ()) (lines_of path);
  let vertices = Array.of_list (List.rev !vertices) and faces = List.rev !faces in
  let all = List.concat (Array.to_list vertices) in
  if faces = [] then fail path "a mesh has no triangles, or too many";
  if List.exists (fun (a, b, c) -> max a (max b c) >= !count) faces then fail path "an index is out of range";
  if List.exists (fun x -> not (Float.abs x <= 1e6)) all then fail path "a mesh has a coordinate out of range";
  let unit_ = List.fold_left (fun k x -> max k (snd (dyadic x))) 0 all in
  let exact x = let n, k = dyadic x in shifted n (unit_ - k) in
  let point k = match List.map exact vertices.(k) with [x; y; w] -> { zx = x; zy = y; zz = w } | _ -> assert false in
  let points = Array.init (Array.length vertices) point in
  let ways_in, corner_of = hints points faces in
  { name; unit_; ways_in; corner_of; triangles = List.map (fun (a, b, c) -> { za = points.(a); zb = points.(b); zc = points.(c) }) faces;
    digest = hash (hash !count (List.map word all)) (List.concat_map (fun (a, b, c) -> [a; b; c]) faces) }

(* ---- motions *)

let read_pose path words =
  match List.map (number path) words with
  | [x; y; w; a; b; c; d] ->
    let length = sqrt (a *. a +. b *. b +. c *. c +. d *. d) in
    List.map single ([x; y; w] @ List.map (fun k -> k /. length) [a; b; c; d])
  | _ -> fail path "a line has too few words"
let rec first n list = if n = 0 then [] else match list with [] -> [] | x :: rest -> x :: first (n - 1) rest
let fit scale poses =
  let unit_length = function
    | [_; _; _; a; b; c; d] -> Float.abs (a *. a +. b *. b +. c *. c +. d *. d -. 1.) < 2.1e-4
    | _ -> false in
  if not (scale >= 1e-6 && scale <= 1e6) then Some "a scale is out of range"
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
  let usage () = prerr_endline "referee PROBLEMS.txt FOLDER [--clearance METRES] [--only ID,ID] [--exact] [--coq]"; exit 2 in
  let clearance = ref 0. and only = ref [] and exact = ref false and coq = ref false and refused = ref false in
  let rec options = function
    | "--clearance" :: x :: rest -> clearance := single (number "--clearance" x); options rest
    | "--only" :: ids :: rest -> only := String.split_on_char ',' ids; options rest
    | "--exact" :: rest -> exact := true; options rest
    | "--coq" :: rest -> coq := true; options rest
    | [] -> ()
    | _ -> usage () in
  let path, folder = match Array.to_list Sys.argv with
    | _ :: path :: folder :: rest -> options rest; (path, folder)
    | _ -> usage () in
  if not (!clearance >= 0. && !clearance <= 1e6) then fail "--clearance" "a clearance is out of range";
  let meshes = Hashtbl.create 16 in
  let say id verdict reason size taken =
    if verdict = "refused" then refused := true;
    Printf.printf "%s\t%s\t%s\t%d\t%.1f\n%!" id verdict reason size taken in
  let check id a b =
    match read_file (Printf.sprintf "%s/%s.cert" folder id) with
    | None -> say id "refused" "there is no certificate" 0 0.
    | Some bytes when !coq -> print_coq id !clearance a b bytes
    | Some bytes ->
      let start = Sys.time () in
      let verdict, reason = judge !exact !clearance a b bytes in
      say id verdict reason (String.length bytes) (1e6 *. (Sys.time () -. start)) in
  let problem id mesh_a scale_a mesh_b scale_b poses_a poses_b =
    let side mesh scale poses = match Hashtbl.find_opt meshes mesh with
      | None -> fail path "a problem names a mesh that is not above it"
      | Some (Error why) -> raise (Uncovered why)
      | Some (Ok mesh) -> { mesh; scale = single (number path scale); poses } in
    try
      let a = side mesh_a scale_a poses_a and b = side mesh_b scale_b poses_b in
      match fit a.scale a.poses, fit b.scale b.poses with
      | Some why, _ | None, Some why -> say id "refused" why 0 0.
      | None, None when not (same_way a.poses && same_way b.poses) -> raise (Uncovered "a turn of 180 degrees to a rounding")
      | None, None -> check id a b
    with Uncovered why -> say id "uncovered" why 0 0. in
  let rec run = function
    | [] -> ()
    | ["mesh"; name; file] :: rest ->
      let file = if file.[0] = '/' then file else Filename.concat (Filename.dirname path) file in
      Hashtbl.replace meshes name (try Ok (read_mesh name file) with Uncovered why -> Error why);
      run rest
    | ("problem" :: id :: a :: scale_a :: b :: scale_b :: more) :: rest when List.length more >= 10 ->
      let count k = if k >= List.length more then 0 else match int_of_string_opt (List.nth more k) with
        | Some n when n >= 0 && n <= 65536 -> n | _ -> fail path "a COUNT is out of range" in
      let n = count 9 and m = count 10 in
      if n < 1 then fail path "a COUNT is out of range";
      let rec split k list = if k = 0 then ([], list) else match list with
        | [] -> fail path "a line has too few words"
        | line :: list -> let x, y = split (k - 1) list in (read_pose path (first 7 line) :: x, y) in
      let poses_a, rest = split n rest in
      let poses_b, rest = split m rest in
      if !only = [] || List.mem id !only then
        problem id a scale_a b scale_b poses_a (if m > 0 then poses_b else [read_pose path (first 7 more)]);
      run rest
    | _ -> fail path "a line is neither a mesh nor a problem" in
  match lines_of path with
  | ("nsvcd-problems" :: _) :: rest -> run rest; exit (if !refused then 1 else 0)
  | _ -> fail path "its first line is not nsvcd-problems 1"
