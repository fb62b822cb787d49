"""Tests of what someone meets first who comes from numpy: help, types, whatever can stand for a mesh or a pose."""
from __future__ import annotations

import os
import pydoc
import shutil
import subprocess
import unittest
from pathlib import Path

import numpy as np

import neuralsvcd as nsvcd
import nsvcd_verify
from neuralsvcd import Body, Code, Error, Mesh

HERE = Path(__file__).resolve().parent
ASSETS = HERE.parent / "assets"
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
            self.assertEqual(nsvcd.sweep_batch([kind, rack], [rack, kind], [low, high])["verdict"].tolist(), ["hit", "free"])
            proof = nsvcd.certify(kind, ASSETS / "dish_rack.obj", high)
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
        with self.assertRaisesRegex(TypeError, "b: a Tree or a mesh is needed: a Body no longer"):
            nsvcd.certify(self.mug, Body(self.mug))
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


class Types(unittest.TestCase):
    def test_strict(self) -> None:
        if not shutil.which("mypy"):
            self.skipTest("no mypy: not tested")
        done = subprocess.run(["mypy", "--strict", "--cache-dir", os.devnull, "neuralsvcd", "nsvcd_verify"], cwd=HERE,
                              capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)


if __name__ == "__main__":
    unittest.main()
