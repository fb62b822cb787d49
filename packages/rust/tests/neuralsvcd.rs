//! Answers against what is known by hand, and what is refused.
use neuralsvcd::*;
use std::sync::atomic::AtomicBool;

const CORNERS: [[f32; 3]; 8] = [
    [-1., -1., -1.],
    [1., -1., -1.],
    [1., 1., -1.],
    [-1., 1., -1.],
    [-1., -1., 1.],
    [1., -1., 1.],
    [1., 1., 1.],
    [-1., 1., 1.],
];
const FACES: [[u32; 4]; 6] = [[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];

fn close(a: f32, b: f32) {
    assert!((a - b).abs() <= 2e-3, "{a}, not {b}");
}
fn at(x: f32, y: f32, z: f32) -> Pose {
    Pose::at([x, y, z])
}
fn asked(question: Question) -> Answer {
    question.sweep(&mut Workspace::new()).unwrap()
}
fn refused<T: std::fmt::Debug>(result: Result<T, Error>, kind: ErrorKind) {
    let error = result.unwrap_err();
    assert_eq!(error.kind(), kind, "{error}");
    assert!(error.to_string().len() > 5);
}
fn cube_mesh() -> Mesh {
    Mesh::from_faces(&CORNERS, &FACES).unwrap()
}

#[test]
fn a_ball_flies_against_a_cube() {
    self_test().unwrap();
    let ball = Body::sphere(0.5).unwrap();
    let cube = Body::encode(&cube_mesh()).unwrap();
    let path = [at(-5., 0.2, 0.1), at(5., 0.2, 0.1)]; // they touch at x = -1.5
    let a = Mover::new(&ball, &path);
    let b = Mover::resting(&cube);
    let question = Question { ask: Ask::First, ..Question::new(a, b) };
    let first = asked(question);
    assert_eq!((first.verdict, first.by, first.why, first.inside), (Verdict::Hit, By::Proof, None, false));
    close(first.time.low, 0.35);
    close(first.time.high, 0.35);
    assert!(first.time.low < first.time.high && first.work > 0 && first.depth == 0.0 && first.opinion.is_none());
    let contact = first.contacts()[0];
    assert_eq!(first.contacts().len(), 1);
    close(contact.normal[0], -1.0);
    close(contact.point[0], -1.0);
    close(contact.point[1], 0.2);
    assert!(contact.triangle_b.unwrap() < 12);
    close(first.safe.a.position[0], -1.5);
    assert_eq!(first.safe.b, Pose::IDENTITY);
    close(asked(Question { a: Mover { scale: 2.0, ..a }, ..question }).time.high, 0.3);
    close(asked(Question { clearance: 0.5, ..question }).time.high, 0.3);
    let exact = asked(Question { to_time: 1e-5, ..question }).time;
    assert!(exact.high - exact.low < 1.1e-5);
    let slow = [path[0], at(0., 0.2, 0.1), path[1]];
    close(
        asked(Question { a: Mover { times: Some(&[0.0, 0.75, 1.0]), ..Mover::new(&ball, &slow) }, ..question }).time.high,
        0.525,
    );
    let past = Mover::new(&ball, &[at(-5., 2., 0.), at(5., 2., 0.)]).poses.to_vec();
    let by = Question { a: Mover::new(&ball, &past), ..question };
    let distance = asked(Question { ask: Ask::Distance, to: 1e-3, ..by });
    close(distance.distance.low, 0.5);
    close(distance.distance.high, 0.5);
    close(distance.nearest.gap, 0.5);
    assert_eq!((distance.verdict, distance.time), (Verdict::Free, Range { low: 1.0, high: 1.0 }));
    assert_eq!(asked(Question { ask: Ask::Hit, clearance: 0.6, ..by }).verdict, Verdict::Hit);
    // Turned by 180 degrees about z about a pivot at x = 1, which stays: its centre goes from 0 to 2.
    let turn = [Pose::IDENTITY, Pose::new([2., 0., 0.], [0., 0., 1., 0.])];
    let rests = [at(2., 0., 0.)];
    let a = Mover { pivot: [1., 0., 0.], ..Mover::new(&ball, &turn) };
    close(asked(Question { a, b: Mover::new(&ball, &rests), ..question }).time.high, 2.0 / 3.0);
}

#[test]
fn cubes_rest_and_leave() {
    let cube = Body::cuboid([1.; 3], 0.0).unwrap();
    let small = Body::cuboid([0.1; 3], 0.01).unwrap();
    let inside = Question::new(Mover::resting(&small), Mover::resting(&cube));
    assert!(asked(inside).inside);
    assert_eq!(asked(Question { surfaces: true, ..inside }).verdict, Verdict::Free);
    let up = [at(0., 0., 1.99), at(0., 0., 3.)];
    let leaves = Question { ask: Ask::First, ..Question::new(Mover::new(&cube, &up), Mover::resting(&cube)) };
    let held = asked(leaves);
    assert_eq!((held.verdict, held.time.high), (Verdict::Hit, 0.0));
    let left = asked(Question { slop: 0.02, ..leaves });
    assert_eq!(left.verdict, Verdict::Free);
    close(left.depth, 0.01);
    assert!(left.push_out[2] >= 0.009 && left.push_out[2] < 0.021);
    let down = [at(0., 0., 5.), Pose::IDENTITY];
    let lands = asked(Question { manifold: true, a: Mover::new(&cube, &down), ..leaves });
    assert_eq!(lands.contacts().len(), 4);
    assert!(lands.contacts().windows(2).all(|two| two[0].id < two[1].id));
    let rod = Body::capsule([0., 0., -1.], [0., 0., 1.], 0.25).unwrap();
    let dots = Body::cloud(&[[0., 0., 1.], [0., 0., 9.]], 0.25).unwrap();
    let across = [at(-5., 0., 0.), at(5., 0., 0.)];
    close(asked(Question { a: Mover::new(&rod, &across), b: Mover::resting(&dots), ..leaves }).time.high, 0.45);
}

#[test]
fn work_and_stop_end_a_proof() {
    let cube = Body::encode(&cube_mesh()).unwrap();
    let other =
        Body::encode_with(&Mesh::hull(&CORNERS).unwrap(), &EncodeOptions { patches: 512, ..Default::default() }).unwrap();
    let spin: Vec<Pose> = (0..4000)
        .map(|i| (i as f32 * 0.05).sin_cos())
        .map(|(s, c)| Pose::new([3.46, 0., 0.], [s * 0.6, s * 0.8, 0., c]))
        .collect();
    let question = Question { ask: Ask::Distance, to: 1e-6, ..Question::new(Mover::new(&cube, &spin), Mover::resting(&other)) };
    let little = asked(Question { work: 1, ..question });
    assert_eq!(little.why, Some(Why::Work));
    let stop = AtomicBool::new(true);
    let stopped = asked(Question { stop: Some(&stop), ..question });
    let whole = asked(Question { stop: Some(&AtomicBool::new(false)), ..question });
    assert_eq!(stopped.why, Some(Why::Work));
    assert!(stopped.work < whole.work);
    assert_eq!(whole, asked(question));
}

#[test]
fn the_network_has_an_opinion() {
    let mesh = cube_mesh();
    let cube = Body::encode_with(&mesh, &EncodeOptions { latents: true, no_triangles: true, ..Default::default() }).unwrap();
    assert!(cube.facts().latents && cube.facts().triangles == 0);
    let path = [at(-5., 0.2, 0.1), at(0., 0.2, 0.1)];
    let question = Question::new(Mover::new(&cube, &path), Mover::resting(&cube));
    let network = NetworkOptions { model: Model::Tiny, precision: Precision::Int8, pairs: 4, ..Default::default() };
    for answer in [asked(question), asked(Question { method: Method::Network, network, ..question })] {
        assert_eq!((answer.verdict, answer.by), (Verdict::Hit, By::Network));
        assert!(answer.opinion.unwrap().logit > 0.0);
    }
    refused(Question { method: Method::Proof, ..question }.sweep(&mut Workspace::new()), ErrorKind::Triangles);
    let network = NetworkOptions { recall: 0.5, ..network };
    refused(Question { network, ..question }.sweep(&mut Workspace::new()), ErrorKind::Recall);
}

#[test]
fn meshes_and_bodies() {
    let mesh = cube_mesh();
    assert_eq!((mesh.vertices.len(), mesh.triangles.len()), (8, 12));
    let obj = "v 0 0 0\nv 1000 0 0\nv 0 1000 0\nv 0 0 1000\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    let millimetres = MeshOptions { scale: 0.001, origin: [1000., 0., 0.], ..Default::default() };
    assert_eq!(Mesh::parse(obj.as_bytes(), &millimetres).unwrap().vertices[1..3], [[0., 0., 0.], [-1., 1., 0.]]);
    let body = Body::encode(&Mesh::from_obj(obj.as_bytes()).unwrap()).unwrap();
    assert_eq!((body.facts().triangles, body.facts().open_components, body.facts().high[0].round()), (4, 0, 1000.));
    let stl = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";
    assert_eq!(Mesh::from_stl(stl.as_bytes()).unwrap().triangles, [[0, 1, 2]]);
    let field = Mesh::from_heights(&[0., 1., 2., f32::NAN], 2, [0.5, 3.]).unwrap();
    assert_eq!(field.vertices, [[0., 0., 0.], [0.5, 0., 1.], [0., 3., 2.]]);
    let sheet = Body::encode_with(&field, &EncodeOptions { open: true, convex_radius: 0.1, ..Default::default() }).unwrap();
    assert!(sheet.facts().open && sheet.facts().convex_radius == 0.1 && sheet.facts().open_edges == 3);
    let coarse = Body::encode_with(&mesh, &EncodeOptions { coarse: true, ..Default::default() }).unwrap();
    assert_eq!(coarse.facts().quantization_error > 0.0, coarse.as_bytes() != Body::encode(&mesh).unwrap().as_bytes());
    let same = Body::from_bytes(body.as_bytes()).unwrap();
    assert_eq!((same.as_bytes(), same.facts()), (body.as_bytes(), body.facts()));
    let half = body.scaled([0.5, 1., -1.]).unwrap();
    assert_eq!((half.facts().low[2].round(), half.facts().high[0].round()), (-1000., 500.));
    assert_eq!(half.facts().size, half.as_bytes().len());
    assert_eq!(format!("{:?}", body.clone()), format!("{:?}", body));
}

#[test]
fn errors_name_what_is_wrong() {
    let error = Mesh::from_obj(b"v 0 0 0\nf 1 2\n").unwrap_err();
    assert_eq!((error.kind(), error.line()), (ErrorKind::Syntax, Some(2)));
    assert!(error.to_string().starts_with("line 2: a line cannot be understood"), "{error}");
    refused(Mesh::from_obj(b"hello"), ErrorKind::Format);
    refused(Mesh::from_stl(b"solid"), ErrorKind::Empty);
    refused(Mesh::from_faces(&CORNERS, &[[0, 1]]), ErrorKind::Sizes);
    refused(Mesh::from_faces(&CORNERS, &[[0, 1, 8]]), ErrorKind::Index);
    refused(Mesh::from_heights(&[0.; 5], 2, [1.; 2]), ErrorKind::Sizes);
    refused(Mesh::hull(&[]), ErrorKind::Empty);
    refused(Body::encode(&Mesh::default()), ErrorKind::Empty);
    refused(Body::encode(&Mesh { vertices: vec![[0.; 3]], triangles: vec![[0, 0, 7]] }), ErrorKind::Index);
    refused(Body::sphere(-1.0), ErrorKind::Radius);
    refused(Body::cloud(&[], 1.0), ErrorKind::Empty);
    refused(Body::from_bytes(&[]), ErrorKind::Body);
    refused(Body::from_bytes(&[7; 1000]), ErrorKind::Body);
    let ball = Body::sphere(1.0).unwrap();
    let mut bytes = ball.as_bytes().to_vec();
    bytes.pop();
    refused(Body::from_bytes(&bytes), ErrorKind::Body);
    refused(ball.scaled([0.; 3]), ErrorKind::Scale);
    refused(ball.scaled([1., 2., 1.]), ErrorKind::Scale);
    let (far, bent) = ([at(f32::NAN, 0., 0.)], [Pose::new([0.; 3], [0., 0., 0., 2.])]);
    let two = [Pose::IDENTITY, at(1., 0., 0.)];
    let question = Question::new(Mover::new(&ball, &two), Mover::resting(&ball));
    for (wrong, kind) in [
        (Question { a: question.b, ..question }, ErrorKind::Same),
        (Question { a: Mover::new(&ball, &far), ..question }, ErrorKind::Pose),
        (Question { a: Mover::new(&ball, &bent), ..question }, ErrorKind::Quaternion),
        (Question { a: Mover { times: Some(&[0.0]), ..question.a }, ..question }, ErrorKind::Times),
        (Question { a: Mover { times: Some(&[0.0, 0.5]), ..question.a }, ..question }, ErrorKind::Times),
        (Question { a: Mover { scale: -1.0, ..question.a }, ..question }, ErrorKind::Scale),
        (Question { a: Mover { pivot: [f32::INFINITY; 3], ..question.a }, ..question }, ErrorKind::Pivot),
        (Question { to: 1.0, ..question }, ErrorKind::To),
        (Question { to_time: 1.0, ..question }, ErrorKind::ToTime),
        (Question { clearance: -1.0, ..question }, ErrorKind::Clearance),
        (Question { slop: -1.0, ..question }, ErrorKind::Slop),
        (Question { tolerance: -1.0, ..question }, ErrorKind::Tolerance),
        (Question { manifold: true, ..question }, ErrorKind::Manifold),
        (Question { segments: 7, ..question }, ErrorKind::Segments),
        (Question { method: Method::Network, ..question }, ErrorKind::Latents),
    ] {
        refused(wrong.sweep(&mut Workspace::new()), kind);
    }
}

#[test]
fn threads_share_bodies() {
    fn shared<T: Send + Sync>() {}
    shared::<(Body, Mesh, Question, Answer, Error, Workspace)>();
    let cube = Body::encode(&cube_mesh()).unwrap();
    let question = |x: f32| {
        let path = [at(-5., 0., 0.), at(x, 0., 0.)];
        asked(Question { ask: Ask::First, ..Question::new(Mover::new(&cube, &path), Mover::resting(&cube)) })
    };
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| (0..50).for_each(|i| close(question(i as f32).time.high, 3.0 / (5.0 + i as f32))));
        }
    });
}
