"""Tests of what someone meets first who comes from numpy: help, types, whatever can stand for a mesh or a pose."""
from __future__ import annotations

import copy
import io
import json
import os
import pickle
import pydoc
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import warnings
from contextlib import redirect_stdout
from pathlib import Path

import numpy as np

import neuralsvcd as nsvcd
import nsvcd_verify
from neuralsvcd import Body, Code, Error, Mesh, motions, pictures

HERE = Path(__file__).resolve().parent
ASSETS = HERE.parent / "assets"
SVCD = HERE.parents[1] / "build" / "svcd"
IDENTITY = [0, 0, 0, 0, 0, 0, 1]


class Tracked(np.ndarray):
    """As trimesh has them: arrays of a class of their own."""


class Trimesh:
    """What a trimesh.Trimesh is to others: float64 vertices and int64 faces."""

    def __init__(self, mesh: Mesh) -> None:
        self.vertices = mesh.vertices.astype(np.float64).view(Tracked)
        self.faces = mesh.faces.astype(np.int64).view(Tracked)


class Scene:
    """And a trimesh.Scene."""
    geometry: dict[str, Trimesh] = {}


def page(thing: object) -> list[str]:
    """What help() prints."""
    return pydoc.plain(pydoc.render_doc(thing)).splitlines()


class Help(unittest.TestCase):
    def test_a_page(self) -> None:
        """The guide, not every field of every class."""
        self.assertLessEqual(len(page(nsvcd)), 300)
        for room in (HERE / "neuralsvcd").glob("*.py"):
            self.assertLessEqual(len(room.read_text().splitlines()), 600, room.name)


class MeshLikes(unittest.TestCase):
    """Whatever stands for a mesh, wherever a mesh or a body is."""

    def setUp(self) -> None:
        self.mug = Mesh.load(ASSETS / "mug.obj")
        self.kinds = [ASSETS / "mug.obj", str(ASSETS / "mug.obj"), self.mug, tuple(self.mug), list(self.mug),
                      (self.mug.vertices.tolist(), self.mug.faces.tolist()), Trimesh(self.mug)]

    def test_bodies_and_trees(self) -> None:
        body = bytes(Body(self.mug))
        for kind in self.kinds:
            self.assertEqual(bytes(Body(kind)), body)
            moved = Body((self.mug.vertices.astype(float) - [0.01, 0, 0]) * 2, self.mug.faces).facts
            found = Body(kind, scale=2, origin=(0.01, 0, 0)).facts
            np.testing.assert_allclose([found.low, found.high], [moved.low, moved.high], atol=1e-6)

    def test_questions(self) -> None:
        low, high = ([[0, -0.4, z, 0, 0, 0, 1], [0, 0, z - 0.3, 0, 0, 0, 1]] for z in (0.3, 1))
        rack = Body(ASSETS / "dish_rack.obj")
        joint = nsvcd.Joint(0, kind=nsvcd.JointKind.PRISMATIC)
        for kind in self.kinds:
            self.assertEqual([nsvcd.sweep(kind, rack, path).verdict for path in (low, high)], ["hit", "free"])
            self.assertEqual(nsvcd.sweep(kind, kind, [[0.01, 0, 0, 0, 0, 0, 1]], None, scale_a=2).verdict, "hit")
            self.assertEqual(nsvcd.sweep([kind, rack], [rack, kind], [low, high])["verdict"].tolist(), ["hit", "free"])
            proof = nsvcd.certify(kind, ASSETS / "dish_rack.obj", high)
            self.assertEqual(nsvcd.certify(Body(kind), rack, high), proof)
            self.assertEqual(proof.verdict, "free")
            if not isinstance(kind, (str, Path)):  # the checker reads no files
                dish_rack = Mesh.load(ASSETS / "dish_rack.obj")
                self.assertEqual(nsvcd_verify.verify(proof.bytes, kind, dish_rack, high).kind, "free")
            self.assertEqual(nsvcd.contacts(kind, rack, high[0], clearance=0.01), ([], False))
            world = nsvcd.World(2)
            self.assertEqual(world.list(kind, low), ())
            world.add(kind)
            self.assertEqual(world.sweep(kind, IDENTITY).body, 1)
            robot = nsvcd.Robot([joint], [nsvcd.Part(kind, 1), nsvcd.Part(rack, 0, [0, 0, -2, 0, 0, 0, 1])], [[0, 1]])
            self.assertEqual([robot.check([z]).verdict for z in (0, -2)], ["free", "hit"])

    def test_refused(self) -> None:
        for wrong, words in ((1, "^a: a Body or a mesh is needed: a mesh is a path, .*not int"), (None, "not NoneType"), (Scene(), r"not Scene: .*scene.to_mesh\(\)"),
                             (b"v 0 0 0", "not bytes"), (self.mug.vertices, "not ndarray")):
            with self.assertRaisesRegex(TypeError, words):
                nsvcd.sweep(wrong, self.mug)
        for wrong in (Body.sphere(1), Body.from_bytes(bytes(Body(self.mug)))):
            with self.assertRaisesRegex(TypeError, "b: a Body that came from bytes, or is round, has no mesh"):
                nsvcd.certify(self.mug, wrong)
        with self.assertRaisesRegex(TypeError, "b: a Tree or a mesh is needed: a mesh is a path"):
            nsvcd.certify(self.mug, 1)
        with tempfile.TemporaryDirectory() as folder:
            Body(self.mug).save(Path(folder) / "mug.body")
            with self.assertRaisesRegex(ValueError, "mug.body: an encoded body, no mesh: Body.load"):
                nsvcd.sweep(Path(folder) / "mug.body", self.mug)
        with self.assertRaisesRegex(ValueError, r"^faces: an array \(n, 3\) is needed, not \(2, 4\)"):
            Body(self.mug.vertices, [[0, 1, 2, 3], [4, 5, 6, 7]])


class Shapes(unittest.TestCase):
    """Between what is closed enough to meet and what is not, by a micrometre."""

    def gap(self, a: Body, b: Body, place: list[float], touches_at: float) -> None:
        for off, verdict in ((-1e-6, "hit"), (1e-6, "free")):
            pose = [*(np.array(place) * (touches_at + off)).tolist(), 0, 0, 0, 1]
            self.assertEqual(nsvcd.sweep(a, b, [pose]).verdict, verdict)

    def test_where_they_end(self) -> None:
        ball = Body.sphere(0.25)
        self.gap(ball, Body.box([2, 3, 4]), [1, 0, 0], 1.25)
        self.gap(ball, Body.box([2, 3, 4]), [0, 0, 1], 2.25)
        self.gap(ball, Body.box([2, 3, 4], convex_radius=0.5), [0, 1, 0], 1.75)
        self.gap(ball, Body.capsule([0, 0, 0], [0, 0, 1], 0.5), [1, 0, 0], 0.75)
        self.gap(ball, Body.cloud([[0, 0, 0], [0, 1, 0]], 0.5), [0, 1, 0], 1.75)
        corner = np.full(3, 3 ** -0.5)
        self.gap(ball, Body.hull([[1, 0, 0], [-1, -1, -1], [0, 1, 0], [0, 0, 1]]), corner.tolist(), 3 ** -0.5 + 0.25)
        rounded = nsvcd.sweep(ball, Body.box([2, 2, 2], convex_radius=0.5), [[1.15, 1.15, 1.15, 0, 0, 0, 1]])
        self.assertEqual((rounded.verdict, bool(nsvcd.sweep(ball, Body.box([2, 2, 2]), [[1.1, 1.1, 1.1, 0, 0, 0, 1]]))),
                         ("free", True))
        self.assertEqual(Body.box((1, 2, 3)).facts[5:7], Body(Mesh.box((1, 2, 3))).facts[5:7])
        self.assertAlmostEqual(Mesh.box((1, 2, 3)).mass().volume, 6, 5)

    def test_refused(self) -> None:
        for code, call in ((Code.RADIUS, lambda: Body.sphere(-1)), (Code.RADIUS, lambda: Body.box([1, 1, 1], 0.6)),
                           (Code.EMPTY, lambda: Body.hull(np.zeros((5, 3)))), (Code.NUMBER, lambda: Body.box([1, np.inf, 1])),
                           (Code.RADIUS, lambda: Body.cloud([[0, 0, 0]], 0))):
            with self.assertRaises(Error) as raised:
                call()
            self.assertEqual(raised.exception.code, code)
        for extents in ([1, 1], 1, [0, 1, 1], [-1, 1, 1], [np.nan, 1, 1]):
            self.assertRaises(ValueError, Body.box, extents)
            self.assertRaises(ValueError, Mesh.box, extents)
        self.assertRaises(ValueError, Body.capsule, [0, 0], [0, 1], 1)


class Poses(unittest.TestCase):
    """Whatever stands for a pose, a motion or many."""

    def setUp(self) -> None:
        self.ball = Body.sphere(0.5)
        self.random = np.random.default_rng(8)

    def test_shapes(self) -> None:
        """Positions, poses and matrices that are the same; one, a motion, and many."""
        places = self.random.normal(size=(6, 4, 3))
        poses = np.concatenate([places, np.zeros((6, 4, 3)), np.ones((6, 4, 1))], -1)
        matrices = np.tile(np.eye(4), (6, 4, 1, 1))
        matrices[..., :3, 3] = places
        expected = [nsvcd.sweep(self.ball, self.ball, pose, [[0, 0, 1, 0, 0, 0, 1]]) for pose in poses]
        self.assertEqual({answer.verdict for answer in expected}, {"hit", "free"})
        for given in (places, poses, matrices, places.tolist(), np.float32(places)):
            many = nsvcd.sweep(self.ball, self.ball, given, [0, 0, 1])
            self.assertEqual(many.verdict.tolist(), [answer.verdict for answer in expected])
            for k in range(6):
                self.assertEqual(nsvcd.sweep(self.ball, self.ball, given[k], [0, 0, 1]).verdict, expected[k].verdict)
                one = nsvcd.sweep(self.ball, self.ball, given[k][0], [0, 0, 1])
                self.assertEqual(one, nsvcd.sweep(self.ball, self.ball, poses[k, :1], [0, 0, 1]))
        self.assertEqual(nsvcd.certify((places[0], [[0, 1, 2]]), (places[1], [[0, 1, 2]]), [9, 9, 9]).verdict, "free")
        world = nsvcd.World(2)
        id = world.add(self.ball, [1, 2, 3])
        np.testing.assert_array_equal(world.poses([id]), [[1, 2, 3, 0, 0, 0, 1]])
        self.assertEqual(world.sweep(self.ball, [[3, 2, 3], [2.1, 2, 3]]).verdict, "free")
        self.assertEqual(nsvcd.contacts(self.ball, self.ball, [1.001, 0, 0], clearance=0.01)[1], False)
        plan = nsvcd.plan([Body(Mesh.box((1, 1, 1)), latents=True)] * 2, [[0, 1]], lambda joints: [[*joints, 0], [0, 0, 0]],
                          [-3, 0], [3, 0], [-4, -4], [4, 4])
        self.assertEqual(plan.status, nsvcd.PlanStatus.CONVERGED)

    def test_converted(self) -> None:
        quaternions = self.random.normal(size=(9, 4))
        quaternions /= np.linalg.norm(quaternions, axis=1, keepdims=True)
        xyzw = np.concatenate([self.random.normal(size=(9, 3)), quaternions], 1)
        wxyz = xyzw[:, [0, 1, 2, 6, 3, 4, 5]]
        np.testing.assert_array_equal(nsvcd.poses(wxyz, order="wxyz"), xyzw)
        np.testing.assert_array_equal(nsvcd.poses(wxyz[2], order="wxyz"), xyzw[2])
        np.testing.assert_array_equal(nsvcd.poses(xyzw, to="wxyz"), wxyz)
        np.testing.assert_array_equal(nsvcd.poses(wxyz, "wxyz", to="wxyz"), wxyz)
        for order in ("xyzw", "wxyz"):
            np.testing.assert_array_equal(nsvcd.poses([[1, 2, 3]], order), [[1, 2, 3, 0, 0, 0, 1]])
            np.testing.assert_array_equal(nsvcd.poses(np.eye(4), order), IDENTITY)
        self.assertEqual(nsvcd.poses(np.eye(4, dtype=int), to="wxyz").tolist(), [0, 0, 0, 1, 0, 0, 0])
        # a quarter turn about x, as MuJoCo writes it, is not one about z
        rod = Body.capsule([0, 0, 0], [0, 0, 1], 0.1)
        turned = [0, 0, 0, 0.5 ** 0.5, 0.5 ** 0.5, 0, 0]
        probe = Body.sphere(0.1)
        self.assertTrue(nsvcd.sweep(rod, probe, nsvcd.poses(turned, order="wxyz"), [0, -1, 0]))
        self.assertFalse(nsvcd.sweep(rod, probe, nsvcd.poses(turned, order="wxyz"), [0, 0, 1]))
        given = xyzw.copy()
        nsvcd.poses(given)[:] = 0
        np.testing.assert_array_equal(given, xyzw)

    def test_refused(self) -> None:
        turn = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]])
        for wrong, words in ((turn, "a rotation matrix, or three positions"), (np.eye(3), "rotation matrix"),
                             (np.tile(turn, (5, 1, 1)), "rotation matrix"), (np.zeros((3, 4)), "lacks its row"),
                             (np.zeros((2, 6)), "a twist, or Euler"), (np.zeros(4), "lacks its position"), (np.zeros(()), r"not \(\)"),
                             (np.zeros((2, 3, 4, 7)), r"at most \(n, k, 7\)"), (np.diag([2.0, 2, 2, 1]), "scales, by 2"),
                             (np.eye(4)[:, [0, 1, 2, 2]], "last row")):
            with self.assertRaisesRegex(ValueError, "^poses_b: .*" + words):
                nsvcd.sweep(self.ball, self.ball, None, wrong)
        self.assertEqual(nsvcd.sweep(self.ball, self.ball, 3 * np.eye(3)).verdict, "free")  # three positions
        many = np.zeros((2, 3, 7)) + IDENTITY
        world, robot = nsvcd.World(1), nsvcd.Robot([nsvcd.Joint(0)], [])
        for call in (lambda: nsvcd.certify(Mesh.box([1, 1, 1]), Mesh.box([1, 1, 1]), many), lambda: world.sweep(self.ball, many),
                     lambda: nsvcd.contacts(self.ball, self.ball, many[0], clearance=1), lambda: world.add(self.ball, many[0]),
                     lambda: nsvcd.sweep_gradient(self.ball, self.ball, many), lambda: robot.reach([0], many, 1),
                     lambda: nsvcd.poses(many, order="wzyx"), lambda: nsvcd.sweep(self.ball, self.ball, many, threads=0)):
            self.assertRaises(ValueError, call)
        self.assertRaises(TypeError, nsvcd.poses, ["a", "b", "c"])
        self.assertRaises(TypeError, nsvcd.sweep, self.ball, self.ball, many, threads=1.5)

    def test_records(self) -> None:
        """What many answers are: by name, by attribute, by row; pickled and chosen from."""
        mug, rack = (Body(ASSETS / f"{name}.obj") for name in ("mug", "dish_rack"))
        paths = np.zeros((50, 2, 3)) + [[0, -0.4, 0.3], [0, 0, 0]]
        paths[:, :, 0] = np.linspace(-0.5, 0.5, 50)[:, None]
        answers = nsvcd.sweep(mug, rack, paths, ask="first", to_time=0.01)
        again = pickle.loads(pickle.dumps(answers))
        for found in (answers, again, answers[:], copy.copy(answers)):
            hits = found.verdict == nsvcd.Verdict.HIT
            self.assertTrue(0 < hits.sum() < 50)
            np.testing.assert_array_equal(found.time.high, found["time"]["high"])
            first = int(np.flatnonzero(hits)[0])
            one = nsvcd.sweep(mug, rack, paths[first], ask="first", to_time=0.01)
            self.assertEqual((found[first].verdict, found[first].time.high, found[hits][0].contact_count),
                             (one.verdict, one.time.high, len(one.contacts)))
            self.assertEqual(found[first].safe.a.position.tolist(), list(one.safe.a[:3]))

    def test_threads(self) -> None:
        mug, rack = (Body(ASSETS / f"{name}.obj") for name in ("mug", "dish_rack"))
        paths = self.random.normal(0, 0.2, (1001, 2, 3))
        alone = nsvcd.sweep(mug, rack, paths, ask="first", to=0.001)
        for threads in (2, 5):
            np.testing.assert_array_equal(nsvcd.sweep(mug, rack, paths, ask="first", to=0.001, threads=threads), alone)
        self.assertEqual(len(nsvcd.sweep(mug, rack, paths[:3], threads=4)), 3)
        self.assertEqual(len(nsvcd.sweep(mug, rack, paths[:0], threads=4)), 0)
        times = np.tile([0.0, 1.0], (1001, 1))
        times[700, 0], paths[800, 1, 1] = 0.5, np.nan
        for threads in (1, 3):
            with self.assertRaises(Error) as raised:
                nsvcd.sweep(mug, rack, paths, times_a=times, threads=threads)
            self.assertEqual((raised.exception.code, raised.exception.index), (Code.TIMES, 700))


class Rounding(unittest.TestCase):
    """Poses are rounded to float32: where that moves them far, it is said."""
    BOX = Mesh.box([0.1, 0.1, 0.1])
    A = np.array([500000.014, 300000, 100, 0, 0, 0, 1])
    B = A + [0.096, 0, 0, 0, 0, 0, 0]  # they overlap by 4 mm
    ORIGIN = np.array([500000, 300000, 100, 0, 0, 0, 0])

    def setUp(self) -> None:
        self.box = Body(self.BOX)

    def asked(self, a: np.ndarray, b: np.ndarray) -> dict[str, str]:
        """What is warned of, by what is asked."""
        world, robot = nsvcd.World(3), nsvcd.Robot([nsvcd.Joint(0)], [nsvcd.Part(self.box, 1)])
        id, at_origin = world.add(self.box, np.float32(a)), np.zeros(7) + IDENTITY
        proof = nsvcd.certify(self.BOX, self.BOX, np.float32([at_origin + [9, 0, 0, 0, 0, 0, 0]]))
        many = np.stack([[b, b]] * 5)
        part, latents = nsvcd.Part(self.box, 1), Body(self.BOX, latents=True)
        asks = {
            "sweep": lambda: nsvcd.sweep(self.box, self.box, a, b), "of lists": lambda: nsvcd.sweep(self.box, self.box, a.tolist(), b.tolist()),
            "many": lambda: nsvcd.sweep(self.box, self.box, None, many), "large": lambda: nsvcd.sweep(Body.box([999, 999, 999]), self.box, a),
            "small": lambda: nsvcd.sweep(self.box, Body.box([999, 999, 999]), None, a, scale_a=0.5),
            "contacts": lambda: nsvcd.contacts(self.box, self.box, a, clearance=0.01),
            "gradient": lambda: nsvcd.sweep_gradient(latents, latents, [a]), "certify": lambda: nsvcd.certify(self.BOX, self.BOX, None, [a]),
            "verify": lambda: nsvcd_verify.verify(proof, self.BOX, self.BOX, [a]), "claim": lambda: nsvcd_verify.claim(self.BOX, self.BOX, [a]),
            "add": lambda: world.add(self.box, a), "move": lambda: world.move(id, a), "drive": lambda: world.drive(id, a),
            "of a world": lambda: world.sweep(self.box, a), "of an id": lambda: world.sweep(id, a), "list": lambda: world.list(id, a),
            "joint": lambda: nsvcd.Robot([nsvcd.Joint(0, a)], [part]), "part": lambda: nsvcd.Robot([nsvcd.Joint(0)], [part._replace(pose=a)]),
            "reach": lambda: robot.reach([0], a, 1, starts=1),
            "plan": lambda: nsvcd.plan([latents] * 2, [[0, 1]], lambda joints: np.stack([a, b]), [0], [1], [0], [1], seeds=1)}
        said = {}
        for name, ask in asks.items():
            with warnings.catch_warnings(record=True) as caught:
                warnings.simplefilter("always")
                ask()
            self.assertTrue(all(each.filename == __file__ for each in caught), name)
            said[name] = " ".join(str(each.message) for each in caught)
        return said

    def test_warned(self) -> None:
        self.assertEqual(nsvcd.sweep(self.box, self.box, self.A - self.ORIGIN, self.B - self.ORIGIN).verdict, "hit")
        with self.assertWarnsRegex(UserWarning, "^poses_a: rounding to float32 moves them by 0.014 m, .* a body of 0.17 m: subtract a common"):
            self.assertEqual(nsvcd.sweep(self.box, self.box, self.A, self.B).verdict, "free")  # of the rounded ones
        for name, words in self.asked(self.A, self.B).items():
            self.assertRegex(words, "subtract a common origin", name)

    def test_not_warned(self) -> None:
        """Of what is near enough, and of float32, whatever it was before; of what needs no rounding, or rests."""
        for aside in (0, 30):
            offset = np.array([aside, aside, aside, 0, 0, 0, 0])
            self.assertEqual(set(self.asked(self.A - self.ORIGIN + offset, self.B - self.ORIGIN + offset).values()), {""})
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            for whole in (np.float32(self.A), self.ORIGIN.astype(int) + IDENTITY, np.float32(self.A).astype(float), np.float32(self.A).tolist()):
                nsvcd.sweep(self.box, self.box, whole)
            nsvcd.sweep(Body.box([9999, 9999, 9999]), Body.box([9999, 9999, 9999]), self.A, self.B)
            tiny = Body.box([1e-5, 1e-5, 1e-5])
            nsvcd.sweep(tiny, tiny, [1e-5 / 3, 0, 0, 0.6, 0, 0, 0.8])
            for wrong in (np.nan, np.inf):
                self.assertRaises(Error, nsvcd.sweep, self.box, self.box, [wrong, 0, 0])
        far = np.stack([[self.A, self.B]] * 1000)
        far[:999] -= self.ORIGIN
        with self.assertWarnsRegex(UserWarning, "^poses_b: .* by 0.015 m"):  # one of many
            nsvcd.sweep(self.box, self.box, None, far)


class FarMeshes(unittest.TestCase):
    """Whose corners floats cannot tell apart any more."""

    def test_warned(self) -> None:
        box = Mesh.box([0.2, 0.3, 0.1])
        place = np.array([5e5, 3e5, 0])
        far = box.vertices + place, box.faces
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "far.obj"
            path.write_text("\n".join([*("v %.9f %.9f %.9f" % tuple(corner) for corner in far[0]), *("f %d %d %d" % tuple(row + 1) for row in box.faces)]))
            for call in (lambda: Body(*far), lambda: Body(far), lambda: Body(path), lambda: Mesh.load(path), lambda: nsvcd.certify(box, nsvcd.Tree(far)),
                         lambda: Body((far[0] * 1000, far[1]), scale=0.001), lambda: nsvcd.sweep(far, box), lambda: Body(Mesh(*far)),
                         lambda: nsvcd.certify(box, path), lambda: Body.capsule(place, place + [0, 0, 1], 0.1)):
                with warnings.catch_warnings(record=True) as caught:
                    warnings.simplefilter("always")
                    call()
                said = [str(each.message) for each in caught if "not a closed" not in str(each.message)]
                self.assertEqual(len(said), 1)
                self.assertRegex(said[0], "5e[+]05 m from its origin, where floats are 0.06 m apart: of a map[?] try origin=.*, of Body")
                self.assertEqual(caught[0].filename, __file__)
                origin = json.loads(said[0].split("origin=")[1].split(", of")[0])
                self.assertTrue(np.abs(np.array(origin) / (1000 if origin[0] > 1e6 else 1) - place).max() < 1)
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                for body in (Body(path, origin=place), Body(*far, origin=place), Body(far[0] * 1000, far[1], scale=0.001, origin=place * 1000)):
                    np.testing.assert_allclose(body.mesh.vertices, box.vertices, atol=1e-8)
                Body(box.vertices + [200, 0, 0], box.faces)
                Body.cloud([[5, 0, 0]], 0.1)
                Body(Mesh.box([1e6, 1e6, 10]))
        with self.assertWarnsRegex(UserWarning, "try origin"):  # a millimetre's hundredth apart, and a millimetre large
            Body(box.vertices / 100 + [100, 0, 0], box.faces)


class Urdf(unittest.TestCase):
    """The arm of examples/robot among its shelf, against svcd, which reads what urdf.py writes, and against tests/place.py."""
    FOLDER = HERE.parent / "robot"
    LOW = [-2.649, -0.708, -1.763, 2.470, 1.078, -1.057]
    UP = [-0.493, 0.360, 0.877, 1.905, 1.078, 0.076]

    @classmethod
    def setUpClass(cls) -> None:
        cls.arm = nsvcd.Robot.from_urdf(cls.FOLDER / "arm.urdf", srdf=cls.FOLDER / "arm.srdf", obstacles=cls.FOLDER / "shelf.urdf")

    def written(self, folder: Path, text: str) -> Path:
        path = folder / "robot.urdf"
        path.write_text(f"<robot name='r'>{text}</robot>")
        return path

    def test_as_svcd_has_it(self) -> None:
        self.assertEqual(self.arm.joint_names, ("pan", "lift", "elbow", "wrist_1", "wrist_2", "wrist_3"))
        self.assertEqual(self.arm.part_names[6:10], ("palm", "left_finger", "right_finger", "floor"))
        self.assertEqual(len(self.arm.pairs), 24 + 8 * 7)
        straight = self.arm.check([self.LOW, self.UP])
        self.assertEqual((straight.verdict, self.arm.pair_names(straight.pair)), ("hit", ("wrist_a", "board_2")))
        route = self.arm.route(self.LOW, self.UP)
        self.assertEqual(route.status, nsvcd.RouteStatus.FOUND)
        self.assertEqual((route.status, f"{route.status} {bool(route)}"), ("found", "found True"))
        stuck = self.arm.route(self.arm.nearest_free(self.LOW), straight.fraction * np.subtract(self.UP, self.LOW) + self.LOW)
        self.assertEqual((str(stuck.status), bool(stuck)), ("goal", False))
        if not SVCD.exists():
            self.skipTest("no build/svcd: not tested")
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "robot.txt"
            subprocess.run([sys.executable, "urdf.py", "arm.urdf", "--srdf", "arm.srdf", "--scene", "shelf", "shelf.urdf", file],
                           cwd=self.FOLDER, check=True)
            with file.open("a") as text:
                text.write((self.FOLDER / "plans.txt").read_text())
            said = [subprocess.run([SVCD, word, file], capture_output=True, text=True).stdout.splitlines()[0].split("\t")
                    for word in ("path", "plan")]
            joints = [1, 2, 0.5, 0.1, 0.2, 0.3]
            place = subprocess.run([sys.executable, HERE.parents[1] / "tests" / "place.py", file, "palm", *map(str, joints)],
                                   capture_output=True, text=True, check=True).stdout.split()
        self.assertEqual(said[0][:2] + said[0][4:6], ["straight", "hit", "wrist_a", "board_2"])
        self.assertAlmostEqual(float(said[0][3]), straight.fraction, 6)
        self.assertAlmostEqual(float(said[1][3]), route.duration, 5)
        palm = self.arm.forward_kinematics(joints)[6]
        np.testing.assert_allclose(palm * np.sign(palm[6] * float(place[6])), np.float64(place), atol=1e-6)

    def test_by_name(self) -> None:
        low, up = (dict(zip(self.arm.joint_names, joints)) for joints in (self.LOW, self.UP))
        self.assertEqual(self.arm.check(low), self.arm.check(self.LOW))
        both = {name: [low[name], up[name]] for name in reversed(self.arm.joint_names)}
        self.assertEqual(self.arm.check(both), self.arm.check([self.LOW, self.UP]))
        self.assertEqual(self.arm.check([low, up]), self.arm.check([self.LOW, self.UP]))
        self.assertEqual(self.arm.check({**low, "pan": [0, 1]}), self.arm.check([[0, *self.LOW[1:]], [1, *self.LOW[1:]]]))
        self.assertEqual(self.arm.route(low, [low, up]).goal, 0)
        np.testing.assert_array_equal(self.arm.forward_kinematics(up), self.arm.forward_kinematics(self.UP))
        self.assertEqual(len(self.arm.proximities(low, max_distance=0.1)), len(self.arm.proximities(self.LOW, max_distance=0.1)))
        there = self.arm.reach(self.UP, self.arm.forward_kinematics(up)[6], "palm", most=3, held=["pan"])
        again = self.arm.reach(self.UP, self.arm.forward_kinematics(up)[6], 6, most=3, held=[True] + [False] * 5)
        np.testing.assert_array_equal(there.solutions, again.solutions)
        self.assertGreater(len(there.solutions), 0)
        np.testing.assert_array_equal(there.solutions[:, 0], self.UP[0])
        taken = self.arm.handed_over(up, "board_1", "wrist_3")
        self.assertEqual((taken.link, taken.name), (6, "board_1"))
        for call in (lambda: self.arm.reach(self.UP, [0, 0, 0], "hand"), lambda: self.arm.handed_over(up, "cup", "palm"),
                     lambda: self.arm.route(low, up, held=["hand"])):
            self.assertRaisesRegex(ValueError, "hand|cup", call)
        for wrong, words in (({**low, "wrist": 0}, "^points: no joint wrist$"), ({"lift": 0, "palm": 1}, "no joint palm, pan is missing"),
                             ({}, "pan is missing, lift is missing")):
            with self.assertRaisesRegex(ValueError, words):
                self.arm.check(wrong)

    def test_what_a_urdf_has(self) -> None:
        """A gripper of two fingers, one of which mimics the other, a mesh mirrored, and a warning."""
        fingers = "".join(f"<link name='{name}'><collision><geometry>{shape}</geometry></collision></link>" for name, shape in (
            ("hand", "<box size='1 0.1 0.1'/>"), ("left", "<mesh filename='left.obj' scale='-1 0.5 1'/>"), ("right", "<sphere radius='0.1'/>")))
        joint = ("<joint name='{0}' type='prismatic'><parent link='hand'/><child link='{0}'/><origin xyz='0 0 0.5'/><axis xyz='{1} 0 0'/>"
                 "<limit lower='0' upper='1' velocity='{2}'/>{3}</joint>")
        mimic = "<mimic joint='left' multiplier='2' offset='0.1'/>"
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            mesh = Mesh.box([0.4, 0.4, 0.4])
            lines = [*("v {} {} {}".format(*(corner + [1, 0, 0])) for corner in mesh.vertices), *("f {} {} {}".format(*row + 1) for row in mesh.faces)]
            (folder / "left.obj").write_text("\n".join(lines))
            path = self.written(folder, fingers + joint.format("left", -1, 3, "") + joint.format("right", 1, 3, mimic))
            hand = nsvcd.Robot.from_urdf(path, obstacles=[nsvcd.Part(Body.sphere(0.1), 0, [9, 0, 0], name="far")])
            self.assertEqual((hand.joint_names, hand.part_names), (("left", "right"), ("hand", "left", "right", "far")))
            self.assertEqual({hand.pair_names(k) for k in range(len(hand.pairs))}, {("left", "right"), ("left", "far"), ("right", "far")})
            at = hand.forward_kinematics({"left": 0.2})
            np.testing.assert_allclose(at[1:3, :3], [[-0.2, 0, 0.5], [0.5, 0, 0.5]], atol=1e-6)
            # the mirrored box ends at x = -0.8, the ball, which is a mesh of 32 sides, begins at 0
            found, = hand.proximities({"left": 0}, max_distance=2, to=1e-5)
            self.assertAlmostEqual(found.distance.low, 0.8, delta=0.002)
            with self.assertRaisesRegex(ValueError, "no joint that moves"):
                nsvcd.Robot.from_urdf(path, fixed={"left": 0.2})
        self.assertEqual(hand.check({"left": [0, 0.4]}).verdict, "free")

    def test_millimetres(self) -> None:
        """A mesh of 400 m, warned of as Mesh.load does."""
        fore = "<link name='base'/><link name='fore'><collision><geometry><mesh filename='fore.obj'{}/></geometry></collision></link>"
        joint = "<joint name='j' type='continuous'><parent link='base'/><child link='fore'/><limit velocity='1'/></joint>"
        with tempfile.TemporaryDirectory() as name:
            folder, mesh = Path(name), Mesh.box([400, 50, 50])
            lines = [*("v {} {} {}".format(*corner) for corner in mesh.vertices), *("f {} {} {}".format(*row + 1) for row in mesh.faces)]
            (folder / "fore.obj").write_text("\n".join(lines))
            for scale in ("", " scale='1 -1 1'"):
                with self.assertWarnsRegex(UserWarning, "fore: .*fore.obj: a body of 400 m: .*millimetres[?] try the URDF's scale 0.001$"):
                    nsvcd.Robot.from_urdf(self.written(folder, fore.format(scale) + joint))
            with self.assertWarnsRegex(UserWarning, "a body of 400 m"):
                nsvcd.Robot.from_urdf(self.FOLDER / "arm.urdf", obstacles=self.written(folder, fore.format("")))
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                nsvcd.Robot.from_urdf(self.written(folder, fore.format(" scale='0.001 0.001 0.001'") + joint))

    def test_two_roots(self) -> None:
        link = "<link name='{}'><collision><geometry><box size='1 1 1'/></geometry></collision></link>"
        text = "".join(map(link.format, "abc")) + "<joint name='j' type='continuous'><parent link='b'/><child link='c'/><limit velocity='1'/></joint>"
        with tempfile.TemporaryDirectory() as name:
            path = self.written(Path(name), text)
            with self.assertRaisesRegex(ValueError, "robot.urdf: no joint reaches the link b, nor a: a robot has one root"):
                nsvcd.Robot.from_urdf(path)
            done = subprocess.run([sys.executable, self.FOLDER / "urdf.py", path, Path(name) / "out.txt"], capture_output=True, text=True)
            self.assertRegex(done.stderr, "no joint reaches the link b, nor a: a robot has one root")

    def test_refused(self) -> None:
        link = "<link name='a'><collision><geometry><box size='1 1 1'/></geometry></collision></link>"
        floating = link + link.replace("'a'", "'b'") + "<joint name='j' type='{}'><parent link='a'/><child link='b'/>{}</joint>"
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            for text, words in ((floating.format("floating", ""), "joint j: it is 'floating'.*--fixed j holds it"),
                                (link + "<gizmo/>", "what is.*gizmo"), ("", "no link"),
                                (floating.format("revolute", ""), "joint j: no limits")):
                with self.assertRaisesRegex(ValueError, words):
                    nsvcd.Robot.from_urdf(self.written(folder, text))
            turning = self.written(folder, floating.format("continuous", ""))
            with self.assertWarnsRegex(UserWarning, "joint j: no velocity"):
                nsvcd.Robot.from_urdf(turning)
            taken = self.arm.handed_over(self.UP, "board_1", "wrist_3")
            with self.assertRaisesRegex(ValueError, "obstacles: board_1 is on link 6: an obstacle rests on link 0"):
                nsvcd.Robot.from_urdf(self.FOLDER / "arm.urdf", obstacles=[taken])
            with self.assertRaisesRegex(ValueError, "no joint k"):
                nsvcd.Robot.from_urdf(turning, velocity=1, fixed={"k": 0})
            with self.assertRaises(ValueError):
                nsvcd.Robot.from_urdf(folder / "none.urdf")


def matplotlib() -> bool:
    """Is it there? It draws into memory."""
    try:
        import matplotlib
    except ImportError:
        return False
    matplotlib.use("Agg")
    return True


class Pictures(unittest.TestCase):
    def setUp(self) -> None:
        if not matplotlib():
            self.skipTest("no matplotlib: not tested")

    def tearDown(self) -> None:
        from matplotlib import pyplot
        pyplot.close("all")

    def sizes(self, axes) -> list[int]:
        """What is drawn: triangles of each."""
        axes.figure.savefig(io.BytesIO(), dpi=30)
        return [len(collection.get_facecolor()) for collection in axes.collections]

    def test_an_answer(self) -> None:
        mug = Body(ASSETS / "mug.obj")
        rack = Mesh.load(ASSETS / "dish_rack.obj")
        path = [[0, -0.4, 0.3], [0, 0, 0]]
        answer = nsvcd.sweep(mug, rack, path, ask="first", to_time=0.01)
        axes = answer.plot(mug, rack, path)
        triangles = mug.facts.triangles
        self.assertEqual(self.sizes(axes)[:8], [triangles] * 7 + [len(rack.faces)])
        self.assertEqual(axes.get_title(), f"hit at {answer.time.high:.3g}, by proof")
        limits = np.array([axes.get_xlim(), axes.get_ylim(), axes.get_zlim()])
        for body, pose in ((mug, path[0]), (mug, path[1]), (Body(rack), [0, 0, 0])):  # all is within
            self.assertTrue((body.facts.low + np.array(pose) > limits[:, 0] - 1e-3).all())
            self.assertTrue((body.facts.high + np.array(pose) < limits[:, 1] + 1e-3).all())
        # what came from bytes is drawn as balls, what is round as that, and a scale is applied
        bare, ball = Body.from_bytes(bytes(mug)), Body.sphere(0.1)
        self.assertIsNone(bare.mesh)
        answer = nsvcd.sweep(bare, ball, [1, 0, 0], scale_b=5)
        axes = answer.plot(bare, ball, [1, 0, 0], scale_b=5)
        self.assertEqual((axes.get_title(), len(self.sizes(axes))), ("free, by proof", 2))
        self.assertAlmostEqual(axes.get_xlim()[0], -0.5, 2)
        network = Body(ASSETS / "mug.obj", no_triangles=True)
        undecided = nsvcd.sweep(mug, Body(rack), [[0.05, -0.4, 0.2], [0.05, 0, 0.1]], work=1)
        self.assertEqual(undecided.plot(network, rack, path).get_title(), "undecided, by proof")
        again = answer.plot(bare, ball, [1, 0, 0], axes=axes)
        self.assertIs(again, axes)

    def test_where_bodies_are(self) -> None:
        """As the library has it, between poses."""
        motion = motions._motion([[0, 0, 0, 0, 0, 0, 1], [1, 0, 0, 0, 0, 1, 0], [2, 1, 0, 0, 0.6, 0.8, 0]], [0, 0.3, 1])
        box = Body.box([1, 0.01, 0.01])
        answer = nsvcd.sweep(box, Body.box([0.1, 9, 9]), motion.poses, [1.6, 0, 0], times_a=motion.times, ask="first", to_time=1e-4)
        self.assertTrue(0.01 < answer.safe.time < 0.99)
        place = pictures._pose_at(motion, answer.safe.time)
        np.testing.assert_allclose(place * np.sign(place[6] * answer.safe.a[6] + place[5] * answer.safe.a[5]), answer.safe.a, atol=1e-3)
        np.testing.assert_allclose(pictures._placed(np.array([[[1, 0, 0], [0, 2, 0], [0, 0, 0]]], float), np.array([5, 0, 0, 0, 0, 1, 1]), 2),
                                   [[[5, 2, 0], [1, 0, 0], [5, 0, 0]]], atol=1e-12)

    def test_a_route(self) -> None:
        arm = nsvcd.Robot.from_urdf(Urdf.FOLDER / "arm.urdf", srdf=Urdf.FOLDER / "arm.srdf", obstacles=Urdf.FOLDER / "shelf.urdf")
        route = arm.route(Urdf.LOW, Urdf.UP)
        axes = route.plot(arm, 4)
        self.assertEqual(len(self.sizes(axes)), 8 * 4 + 1 + 7)  # the base does not move
        self.assertRegex(axes.get_title(), r"^1\.\d+ s, ")
        with self.assertRaisesRegex(ValueError, "no route"):
            route._replace(points=None).plot(arm)

    def test_without_matplotlib(self) -> None:
        run = ("import sys; sys.modules['matplotlib'] = None; import neuralsvcd as n; ball = n.Body.sphere(1); "
               "n.sweep(ball, n.Body.sphere(2)).plot(ball, ball)")
        done = subprocess.run([sys.executable, "-B", "-c", run], cwd=HERE, capture_output=True, text=True)
        self.assertRegex(done.stderr, "ImportError: plot needs matplotlib: pip install matplotlib")


class Tour(unittest.TestCase):
    def test_cells(self) -> None:
        """The notebook's cells, one after the other, as they stand; it is kept without outputs."""
        cells = json.loads((HERE / "tour.ipynb").read_text())["cells"]
        codes = [cell for cell in cells if cell["cell_type"] == "code"]
        self.assertTrue(all(cell["outputs"] == [] and cell["execution_count"] is None for cell in codes))
        draws = matplotlib()
        folder, printed, names = os.getcwd(), io.StringIO(), {}
        os.chdir(HERE)
        try:
            with redirect_stdout(printed):
                for cell in codes:
                    lines = [line for line in cell["source"] if draws or ".plot(" not in line]
                    exec("".join(lines), names)
        finally:
            os.chdir(folder)
            if draws:
                from matplotlib import pyplot
                pyplot.close("all")
        self.assertRegex(printed.getvalue(), "^" + "\n".join((
            "hit: free before 0.59, in contact at 0.60", "free: 197.4 mm", "4880 of 10000 hit, the first at 0.6",
            "straight: hit wrist_a board_2", r"route: found, 1.\d s", r"asleep, at heights \[0.1 0.3 0.5 0.7 0.9\]",
            r"free \d+ bytes; accepted: True")) + "\n$")
        self.assertLess(names["seconds"], 10)


class Types(unittest.TestCase):
    def test_readme(self) -> None:
        """Its programs, as they stand."""
        if not shutil.which("mypy"):
            self.skipTest("no mypy: not tested")
        programs = re.findall(r"^```python\n(.*?)^```", (HERE / "README.md").read_text(), re.M | re.S)
        self.assertEqual(len(programs), 2)
        with tempfile.TemporaryDirectory() as folder:
            files = [Path(folder) / f"program_{k}.py" for k in range(2)]
            for file, text in zip(files, programs):
                file.write_text(text)
            done = subprocess.run(["mypy", "--strict", "--cache-dir", os.devnull, *files], capture_output=True, text=True,
                                  env={**os.environ, "MYPYPATH": str(HERE)})
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)

    def test_strict(self) -> None:
        if not shutil.which("mypy"):
            self.skipTest("no mypy: not tested")
        done = subprocess.run(["mypy", "--strict", "--cache-dir", os.devnull, "neuralsvcd", "nsvcd_verify", "mujoco_scene.py"], cwd=HERE,
                              capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)

    def test_of_those_who_call(self) -> None:
        """What a caller writes is found to be right, and what is wrong is found; so far as the oldest Python knows."""
        if not shutil.which("mypy"):
            self.skipTest("no mypy: not tested")
        right = """
            from typing import Any
            import numpy as np
            import neuralsvcd as nsvcd
            vertices, faces = np.zeros((3, 3)), np.array([[0, 1, 2]])
            mug = nsvcd.Body("mug.obj", latents=True)
            other = nsvcd.Body(vertices, faces)
            path = np.zeros((2, 7))
            answer = nsvcd.sweep(mug, (vertices, faces), path, [[0, 0, 1]], ask=nsvcd.Ask.FIRST, clearance=0.01)
            when: float = answer.time.high
            one: nsvcd.Answer = nsvcd.sweep(mug, "rack.obj", [[0, 0, 1], [0, 0, 0]], ask="first", method="proof")
            known = nsvcd.sweep(mug, other, [0, 0, 1])
            hits: int = (nsvcd.sweep(mug, other, np.zeros((2, 5, 7))).verdict == "hit").sum()
            earliest = nsvcd.sweep([mug, other], mug, [[0, 0, 1]]).time.high[0]
            proof: nsvcd.Certificate = nsvcd.certify(mug, "rack.obj", path, answer=answer)
            answers: Any = nsvcd.sweep([mug, other], mug, np.zeros((2, 5, 7)), threads=2)
            count: int = (answers.verdict == "hit").sum()
            arm = nsvcd.Robot.from_urdf("arm.urdf", fixed={"gripper": 0.1})
            checked = arm.check({"elbow": [0, 1]})
            names: tuple[str, str] = arm.pair_names(checked.pair or 0)
            route = arm.route({"elbow": 0}, [[1.0], [2.0]])
            world = nsvcd.World(9)
            if world.sweep(world.add(nsvcd.Mesh.box((1, 1, 1)), [0, 0, 1])).body is None: world.list(mug, nsvcd.poses(path))
        """
        wrong = ("nsvcd.sweep(mug, mug, path, ask=1)", "nsvcd.sweep(mug, mug, path, clearence=1)", "nsvcd.Body.sphere('1')",
                 "nsvcd.sweep(1, mug)", "arm.route()", "known.verdikt", "proof.time.high", "nsvcd.sweep(mug, mug, path, ask='frist')", "known.verdict.sum()",
                 "nsvcd.sweep(mug, mug, method='prove')", "nsvcd.World(1).sweep(1, path, ask='frist')", "nsvcd.poses(path, 'zyx')",
                 "nsvcd.Joint(0, kind='revolve')")
        lines = [line.strip() for line in right.strip().splitlines()]
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "caller.py"
            file.write_text("\n".join([*lines, *wrong, ""]))
            done = subprocess.run(["mypy", "--strict", "--python-version", "3.9", "--cache-dir", os.devnull, file], capture_output=True,
                                  text=True, env={**os.environ, "MYPYPATH": str(HERE)})
        found = {int(line.split(":")[1]) for line in done.stdout.splitlines() if ": error: " in line}
        self.assertEqual(found, set(range(len(lines) + 1, len(lines) + 1 + len(wrong))), done.stdout)


if __name__ == "__main__":
    unittest.main()
