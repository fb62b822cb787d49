"""Tests of the modules: `make check-python`, or, after `make python build/svcd`, `python3 -m unittest` here."""
from __future__ import annotations

import copy
import functools
import gc
import hashlib
import importlib
import io
import os
import pickle
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import threading
import time
import types
import unittest
import warnings
import weakref
import zipfile
from concurrent.futures import ThreadPoolExecutor
from contextlib import redirect_stdout
from pathlib import Path

import numpy as np

import neuralsvcd as nsvcd
import nsvcd_verify
from neuralsvcd import Answer, Ask, Body, By, Code, Error, Method, PlanStatus, Stage, Verdict, Why

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
ASSETS = HERE.parent / "assets"
SVCD = ROOT / "build" / "svcd"
PROBLEMS = ROOT / "tests" / "data" / "problems.txt"

REST = [[0, 0, 0, 0, 0, 0, 1]]
LOW = [[0, -0.4, 0.3, 0, 0, 0, 1], [0, 0, 0, 0, 0, 0, 1]]  # the mug meets the rack
HIGH = [[0, -0.4, 0.5, 0, 0, 0, 1], [0, 0.4, 0.5, 0, 0, 0, 1]]  # it does not
BY_NETWORK = {"method": Method.NETWORK}

CUBE = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
FACES = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6],
                  [0, 6, 4], [1, 5, 7], [1, 7, 3]])


def setUpModule() -> None:
    global MUG, RACK, BOX
    MUG, RACK = (Body(ASSETS / name, latents=True) for name in ("mug.obj", "dish_rack.obj"))
    BOX = Body(CUBE, FACES)


def at(*position: float) -> list[list[float]]:
    return [[*position, 0, 0, 0, 1]]


def line(start: float, end: float) -> list[list[float]]:
    """Along x."""
    return at(start, 0, 0) + at(end, 0, 0)


def word_of(answer: Answer) -> str:
    """As `svcd check` has it: undecided also where a first contact is asked for, and only some contact known."""
    if answer.verdict == Verdict.UNDECIDED or answer.verdict == Verdict.HIT and answer.why != Why.NOTHING:
        return "undecided"
    if answer.inside:
        return "inside"
    if answer.by == By.NETWORK:
        return "limit" if answer.opinion.limited else "ok"
    return "certified-free" if answer.verdict == Verdict.FREE else "witness"


def raised(function, *arguments, **named) -> Error:
    """The Error that a call raises."""
    try:
        function(*arguments, **named)
    except Error as error:
        return error
    raise AssertionError("no Error")


def problems_of(path: Path) -> tuple[dict[str, Path], list[tuple]]:
    """Meshes by name, and problems (id, mesh, scale, other mesh, scale, poses, pose) of a problem file."""
    meshes, problems = {}, []
    for fields in (line.split() for line in path.read_text().split("\n")[1:] if line and line[0] != "#"):
        if fields[0] == "mesh":
            meshes[fields[1]] = path.parent / fields[2]
        elif fields[0] == "problem":
            problems.append((fields[1], fields[2], float(fields[3]), fields[4], float(fields[5]), [],
                             [[float(x) for x in fields[6:13]]]))
        else:
            problems[-1][5].append([float(x) for x in fields])
    return meshes, problems


class AgainstC(unittest.TestCase):
    """The same questions to build/svcd, another program in C."""

    def setUp(self) -> None:
        if not SVCD.exists() or not PROBLEMS.exists():
            self.skipTest("no build/svcd: not tested")

    def compare(self, arguments: list[str], options: dict, **encoding) -> None:
        command = [str(SVCD), "check", "--repeat", "1", *arguments, str(PROBLEMS)]
        lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
        meshes, problems = problems_of(PROBLEMS)
        bodies = {name: Body(path, **encoding) for name, path in meshes.items()}
        self.assertEqual(len(lines), len(problems))
        self.assertGreater(len(lines), 400)
        same_patches = 0
        for line, (name, a, scale_a, b, scale_b, poses, pose) in zip(lines, problems):
            answer = nsvcd.sweep(bodies[a], bodies[b], poses, pose, scale_a=scale_a, scale_b=scale_b, **options)
            expected = line.split("\t")
            named = answer.nearest if answer.nearest.triangle_a is not None or not answer.opinion else answer.opinion
            certain = -100 if answer.verdict == Verdict.FREE else 100
            logit = answer.opinion.logit if answer.opinion else certain
            self.assertEqual([name, str(int(logit > 0)), word_of(answer)], [expected[0], expected[2], expected[6]])
            # A compiler may round otherwise in another program.
            self.assertAlmostEqual(logit, float(expected[1]), delta=0.05)
            self.assertAlmostEqual(named.time, float(expected[3]), delta=1e-4)
            same_patches += [str(named.patch_a), str(named.patch_b)] == expected[4:6]
        self.assertGreater(same_patches, 0.98 * len(lines))

    def test_proof(self) -> None:
        self.compare([], {})

    def test_first_contacts(self) -> None:
        self.compare(["--first", "0.01", "--clearance", "0.002"], dict(ask="first", to_time=0.01, clearance=0.002))

    def test_network(self) -> None:
        self.compare(["--method", "network", "--model", "small", "--int8", "--pairs", "4", "--recall", "0.99"],
                     dict(method=Method.NETWORK, model=nsvcd.Model.SMALL, precision=nsvcd.Precision.INT8, pairs=4,
                             recall=0.99), no_triangles=True)

    def test_bodies(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "mug.body"
            subprocess.run([SVCD, "encode", ASSETS / "mug.obj", path], check=True, capture_output=True)
            self.assertEqual(path.read_bytes(), bytes(Body(ASSETS / "mug.obj")))
            self.assertEqual(nsvcd.sweep(Body.load(path), RACK, LOW).verdict, "hit")


class Queries(unittest.TestCase):
    def test_quickstart(self) -> None:
        hit, clear = nsvcd.sweep(MUG, RACK, LOW), nsvcd.sweep(MUG, RACK, HIGH)
        self.assertEqual((hit.verdict, hit.by, hit.why, bool(hit)), ("hit", "proof", "nothing", True))
        self.assertEqual((clear.verdict, clear.by, clear.why, bool(clear)), ("free", "proof", "nothing", False))
        self.assertEqual((clear.nearest.triangle_a, clear.nearest.triangle_b), (None, None))
        self.assertEqual((clear.time, clear.contacts, clear.opinion), ((1, 1), [], None))
        self.assertEqual((hit.opinion, hit.inside, hit.time.low), (None, False, 0))
        self.assertEqual(hit.contacts, [hit.nearest])
        self.assertLess(hit.nearest.triangle_a, MUG.facts.triangles)
        self.assertIs(hit.verdict, Verdict.HIT)
        self.assertEqual(f"{hit.verdict} {hit.by!s}", "hit proof")

    def test_every_field(self) -> None:
        # Boxes of side 2: that at -5 moves by 6 along x, and meets the other at x = -1, when it has gone a half.
        answer = nsvcd.sweep(BOX, BOX, line(-5, 1), ask="first", to_time=0.001)
        self.assertAlmostEqual(answer.time.high, 0.5, delta=0.002)
        self.assertTrue(answer.time.high - 0.0011 <= answer.time.low <= 0.5)
        contact, = answer.contacts
        self.assertEqual((contact, contact.gap, contact.time), (answer.nearest, 0, answer.time.high))
        self.assertEqual((contact.id, answer.depth), (0, 0))
        self.assertAlmostEqual(contact.point[0], -1, delta=0.02)
        self.assertAlmostEqual(np.linalg.norm(contact.normal), 1, delta=1e-5)
        self.assertTrue(0 <= contact.triangle_a < 12 and 0 <= contact.triangle_b < 12)
        self.assertGreater(answer.work, 0)
        self.assertLess(max(contact.patch_a, contact.patch_b), BOX.facts.patches)
        self.assertLessEqual(answer.safe.time, answer.time.low)
        self.assertAlmostEqual(answer.safe.time, answer.time.low, delta=0.0011)
        np.testing.assert_allclose(answer.safe.a, [-5 + 6 * answer.safe.time, 0, 0, 0, 0, 0, 1], atol=1e-5)
        self.assertEqual(answer.safe.b, (0, 0, 0, 0, 0, 0, 1))
        self.assertEqual(nsvcd.sweep(BOX, BOX, line(-5, 0)[:1] + [answer.safe.a], [answer.safe.b]).verdict, "free")
        # No point moves farther than 0.01 m of the 6.
        answer = nsvcd.sweep(BOX, BOX, line(-5, 1), ask="first", to=0.01)
        self.assertTrue(answer.time.low <= 0.5 and answer.time.high - answer.time.low <= 0.0101 / 6)
        answer = nsvcd.sweep(BOX, BOX, line(-5, -3), ask="distance", to=0.001)
        self.assertTrue(1 - 0.0011 <= answer.distance.low <= 1 <= answer.distance.high <= 1.0011)
        self.assertAlmostEqual(answer.nearest.time, 1, delta=0.01)
        self.assertAlmostEqual(answer.nearest.gap, 1, delta=0.01)
        self.assertEqual((answer.verdict, answer.contacts), ("free", []))
        self.assertEqual(nsvcd.sweep(BOX, BOX, line(-5, -3), clearance=1.1).verdict, "hit")
        self.assertEqual(nsvcd.sweep(BOX, BOX, line(-5, -3), clearance=0.9).verdict, "free")
        # A box stands on another, 0.01 in it, and slides along.
        slide = at(0, 0, 1.99) + at(0.5, 0, 1.99)
        self.assertEqual(nsvcd.sweep(BOX, BOX, slide).verdict, "hit")
        answer = nsvcd.sweep(BOX, BOX, slide, slop=0.02)
        self.assertEqual(answer.verdict, "free")
        self.assertAlmostEqual(answer.depth, 0.01, delta=1e-4)
        np.testing.assert_allclose(answer.push_out, [0, 0, 0.02], atol=1e-3)
        np.testing.assert_allclose(answer.safe.a, [0.5, 0, 2, 0, 0, 0, 1], atol=1e-3)  # set down on it
        inside = nsvcd.sweep(BOX, BOX, REST, scale_a=0.1)
        self.assertEqual((inside.verdict, inside.inside, inside.time), ("hit", True, (0, 0)))
        undecided = nsvcd.sweep(MUG, RACK, at(0.05, -0.4, 0.2) + at(0.05, 0, 0.1), work=1)
        self.assertEqual((undecided.verdict, undecided.why, bool(undecided)), ("undecided", Why.WORK, True))
        network = nsvcd.sweep(MUG, RACK, LOW, **BY_NETWORK)
        self.assertEqual((network.verdict, network.by, network.contacts), ("hit", "network", []))
        self.assertEqual(network.time.high, network.opinion.time)
        self.assertGreater(network.opinion.logit, 0)
        self.assertGreater(network.opinion.candidates, 0)
        every_pair = nsvcd.sweep(MUG, RACK, LOW, method="network", pairs=256)
        self.assertIs(every_pair.opinion.limited, False)

    def test_contacts(self) -> None:
        found, is_partial = nsvcd.contacts(BOX, BOX, (0, 0, 2.001, 0, 0, 0, 1), clearance=0.01)
        self.assertEqual((len(found), is_partial), (4, False))
        for contact in found:
            self.assertAlmostEqual(contact.normal[2], 1, 5)
            self.assertAlmostEqual(contact.gap, 0.001, 5)
        self.assertEqual(nsvcd.contacts(BOX, BOX, (0, 0, 2.1, 0, 0, 0, 1), clearance=0.01), ([], False))
        self.assertEqual(raised(nsvcd.contacts, BOX, BOX, (0, 0, 3, 0, 0, 0, 1), clearance=0).code, Code.CLEARANCE)

    def test_manifold(self) -> None:
        """A box of side 1 is set down flat on one of side 2: it stands on its corners."""
        options = dict(ask="first", to=0.001, manifold=True)
        ids = []
        for x in (0.1, 0.101):
            answer = nsvcd.sweep(BOX, BOX, at(x, 0.2, 2) + at(x, 0.2, 1), scale_a=0.5, **options)
            self.assertEqual((answer.verdict, answer.depth), ("hit", 0))
            ids.append([contact.id for contact in answer.contacts])
            points = sorted((contact.point for contact in answer.contacts), key=lambda p: (p[0] > x, p[1] > 0.2))
            corners = [(x + i, 0.2 + j, 1) for i in (-0.5, 0.5) for j in (-0.5, 0.5)]
            np.testing.assert_allclose(points, corners, atol=0.0011)
            for contact in answer.contacts:
                np.testing.assert_allclose(contact.normal, [0, 0, 1], atol=1e-4)
                self.assertEqual(contact.time, answer.time.high)
                self.assertLess(contact.gap, 0.0011)
        self.assertEqual(ids[0], sorted(set(ids[0])))
        self.assertEqual(ids[0], ids[1])
        answer = nsvcd.sweep(BOX, BOX, at(0, 0, 3) + at(0, 0, 2), scale_a=0.5, **options)
        self.assertEqual((answer.verdict, answer.depth, answer.contacts), ("free", 0, []))
        self.assertEqual(raised(nsvcd.sweep, BOX, BOX, line(-5, 1), manifold=True).code, Code.MANIFOLD)

    def test_depth(self) -> None:
        """Of a box that rests on another, pressed into it by a part of the skin."""
        for share in (0.25, 0.5, 0.75):
            answer = nsvcd.sweep(BOX, BOX, at(0, 0, 2 - 0.02 * share), slop=0.02)
            self.assertEqual(answer.verdict, "free")
            self.assertAlmostEqual(answer.depth, 0.02 * share, delta=1e-4)
        self.assertEqual(nsvcd.sweep(BOX, BOX, at(0, 0, 1.97), slop=0.02).depth, np.inf)
        self.assertEqual(nsvcd.sweep(BOX, BOX, at(0, 0, 2.03), slop=0.02).depth, 0)

    def test_poses_and_scales(self) -> None:
        self.assertFalse(nsvcd.sweep(BOX, BOX, at(2.5, 0, 0)))
        self.assertTrue(nsvcd.sweep(BOX, BOX, at(2.5, 0, 0), scale_a=2))
        self.assertTrue(nsvcd.sweep(BOX, BOX, at(2.5, 0, 0), scale_b=2))
        half = np.sqrt(0.5)  # an eighth of a turn about z: the corner is at x = sqrt 2
        self.assertTrue(nsvcd.sweep(BOX, BOX, [[2.3, 0, 0, 0, 0, np.sin(np.pi / 8), np.cos(np.pi / 8)]]))
        self.assertFalse(nsvcd.sweep(BOX, BOX, [[2.3, 0, 0, 0, 0, half, half]]))
        self.assertTrue(nsvcd.sweep(BOX, BOX, line(-5, 0), line(5, 0)))
        self.assertFalse(nsvcd.sweep(BOX, BOX, line(-5, 0), line(0, 5)))
        three = at(-3, 0, 0) + at(0, 10, 0) + at(3, 0, 0)
        self.assertFalse(nsvcd.sweep(BOX, BOX, three, at(0, 0, 0) + at(0, 0, 0)))

    def test_times(self) -> None:
        """A stop on the way, and the same with poses in its place."""
        gate = at(0, 0, 0) + at(0, 3, 0) + at(0, 3, 0)
        for times, verdict in (([0, 0.3, 1], "free"), ([0, 0.9, 1], "hit")):
            for given in (times, np.array(times), tuple(times)):
                self.assertEqual(nsvcd.sweep(BOX, BOX, line(-10, 10), gate, times_b=given).verdict, verdict)
                self.assertEqual(nsvcd.sweep(BOX, BOX, gate, line(-10, 10), times_a=given).verdict, verdict)
        even = [at(x, 0, 0)[0] for x in (-5, -4, -3, 0, 3)]
        first = dict(ask="first", to=1e-4)
        expected = nsvcd.sweep(BOX, BOX, even, **first).time
        found = nsvcd.sweep(BOX, BOX, even[::2], times_a=[0, 0.5, 1], **first).time
        np.testing.assert_allclose(found, expected, atol=1e-4)
        late = nsvcd.sweep(BOX, BOX, even[::2], times_a=[0, 0.9, 1], **first).time
        self.assertTrue(0.9 < late.low <= late.high < 0.95)
        gradients = [nsvcd.sweep_gradient(MUG, RACK, LOW, times_a=times)
                     for times in (None, [0, 1])]
        np.testing.assert_array_equal(gradients[0].by_a, gradients[1].by_a)

    def test_times_refused(self) -> None:
        path = [at(x, 0, 0)[0] for x in (-5, 0, 5)]
        for times in ([0, 0.5, 0.9], [0.1, 0.5, 1], [0, 0, 1], [0, 1.5, 1], [0, np.nan, 1], [0, 0.5, 0.5]):
            self.assertEqual(raised(nsvcd.sweep, BOX, RACK, path, times_a=times).code, Code.TIMES, times)
            self.assertEqual(raised(nsvcd.sweep, BOX, RACK, None, path, times_b=times).code, Code.TIMES, times)
        for times in ([0, 1], [0, 0.3, 0.6, 1], [], [[[0, 0.5, 1]]]):
            with self.assertRaises(ValueError):
                nsvcd.sweep(BOX, RACK, path, times_a=times)
        with self.assertRaises(ValueError):
            nsvcd.sweep(BOX, RACK, times_a=[0, 1])
        with self.assertRaises(TypeError):
            nsvcd.sweep(BOX, RACK, path, times_a=["0", "1", "2"])

    def test_gradient(self) -> None:
        """Of the logit and of the distance, against differences, by where the bodies are."""
        path, rest = np.array(LOW, float), np.array(at(0.01, 0.02, 0))
        path[:, :3] += np.random.default_rng(5).normal([0, 0, 0.05], 0.03, (2, 3))
        for ask in Ask.HIT, Ask.DISTANCE:
            options = dict(method=Method.NETWORK, ask=ask)
            gradient = nsvcd.sweep_gradient(MUG, RACK, path, rest, ask=ask)
            self.assertEqual((gradient.by_a.shape, gradient.by_b.shape), ((2, 6), (1, 6)))
            self.assertEqual(gradient.answer, nsvcd.sweep(MUG, RACK, path, rest, **options))
            found = np.concatenate([gradient.by_a[:, :3].ravel(), gradient.by_b[:, :3].ravel()])
            differences = []
            for poses in (path, rest):
                for place in np.ndindex(len(poses), 3):
                    told = []
                    for step in (2e-5, -4e-5):
                        poses[place] += step
                        opinion = nsvcd.sweep(MUG, RACK, path, rest, **options).opinion
                        told.append(opinion.logit if ask is Ask.HIT else opinion.distance)
                    poses[place] += 2e-5
                    differences.append((told[0] - told[1]) / 4e-5)
            np.testing.assert_allclose(differences, found, atol=0.05 * np.abs(found).max())
        self.assertEqual(nsvcd.sweep_gradient(MUG, RACK).by_a.shape, (1, 6))

    def test_the_same_twice(self) -> None:
        path = np.array(LOW)
        self.assertEqual(raised(nsvcd.sweep, MUG, MUG).code, Code.SAME)
        self.assertEqual(raised(nsvcd.sweep, MUG, MUG, path, path).code, Code.SAME)

    def test_answers_are_values(self) -> None:
        answer = nsvcd.sweep(MUG, RACK, LOW)
        self.assertEqual(answer, pickle.loads(pickle.dumps(answer)))
        self.assertEqual(answer, nsvcd.sweep(MUG, RACK, LOW))


class Batches(unittest.TestCase):
    def setUp(self) -> None:
        random = np.random.default_rng(5)
        self.paths = np.tile(np.array(LOW), (60, 1, 1))
        self.paths[:, :, :3] += random.normal(0, 0.2, (60, 2, 3))

    def same(self, row: np.void, answer: tuple) -> None:
        """Field by field, as a NamedTuple has them."""
        for name, value in answer._asdict().items():
            if name == "opinion":
                self.assertEqual(row[name]["asked"], value is not None)
            if name == "contacts":
                self.assertEqual(row["contact_count"], len(value))
                for contact, one in zip(row[name], value):
                    self.same(contact, one)
            elif name == "safe":
                self.assertEqual(row[name]["time"], value.time)
                for pose, one in ((row[name]["a"], value.a), (row[name]["b"], value.b)):
                    np.testing.assert_array_equal([*pose["position"], *pose["rotation"]], one)
            elif hasattr(value, "_asdict"):
                self.same(row[name], value)
            elif name != "opinion":
                value = nsvcd.NO_TRIANGLE if value is None else value
                np.testing.assert_array_equal(row[name], np.asarray(value, row[name].dtype), name)

    def test_answers_are_those_of_sweep(self) -> None:
        for options in ({}, dict(ask="first", to_time=0.01), dict(ask="distance", to=0.001),
                        dict(ask="first", to=0.001, manifold=True, slop=0.01), dict(work=1)):
            answers = nsvcd.sweep(MUG, RACK, self.paths, **options)
            self.assertEqual(answers.shape, (60,))
            for row, path in zip(answers, self.paths):
                self.same(row, nsvcd.sweep(MUG, RACK, path, **options))
        answers = nsvcd.sweep(MUG, RACK, self.paths)
        hits = answers["verdict"] == "hit"
        self.assertTrue(0 < hits.sum() < 60)
        np.testing.assert_array_equal(hits, answers["verdict"] == Verdict.HIT)
        self.assertEqual(hits.sum() + (answers["verdict"] == "free").sum(), 60)
        np.testing.assert_array_equal(answers[hits]["time"]["high"], answers[hits]["nearest"]["time"])
        self.assertEqual((answers["inside"].dtype, answers["opinion"]["limited"].dtype), (bool, bool))
        self.assertEqual(answers["contacts"]["point"].shape, (60, 4, 3))
        # By the network, one after another may differ in what it looked at.
        answers = nsvcd.sweep(MUG, RACK, self.paths[:1], **BY_NETWORK)
        self.same(answers[0], nsvcd.sweep(MUG, RACK, self.paths[0], **BY_NETWORK))

    def test_each_its_own(self) -> None:
        bodies, scales = [MUG, BOX] * 30, np.linspace(0.5, 2, 60)
        other = np.tile(np.array(HIGH + LOW[::-1]), (60, 1, 1))
        answers = nsvcd.sweep(bodies, RACK, self.paths, other, scale_a=scales, scale_b=2)
        for k, row in enumerate(answers):
            self.same(row, nsvcd.sweep(bodies[k], RACK, self.paths[k], other[k], scale_a=scales[k], scale_b=2))
        times = np.zeros((60, 4))
        times[:, 1:] = np.sort(np.random.default_rng(6).uniform(0.1, 0.9, (60, 3)))
        times[:, 3] = 1
        answers = nsvcd.sweep(MUG, RACK, self.paths, other, times_b=times)
        for k, row in enumerate(answers):
            self.same(row, nsvcd.sweep(MUG, RACK, self.paths[k], other[k], times_b=times[k]))
        answers = nsvcd.sweep(MUG, RACK, self.paths, other[0], times_b=times)
        for k, row in enumerate(answers):
            self.same(row, nsvcd.sweep(MUG, RACK, self.paths[k], other[0], times_b=times[k]))
        answers = nsvcd.sweep(MUG, RACK, self.paths, other, times_a=[0, 1], times_b=times[0])
        for k, row in enumerate(answers):
            self.same(row, nsvcd.sweep(MUG, RACK, self.paths[k], other[k], times_a=[0, 1], times_b=times[0]))
        answers = nsvcd.sweep(RACK, tuple(bodies), poses_b=LOW)
        for body, row in zip(bodies, answers):
            self.same(row, nsvcd.sweep(RACK, body, None, LOW))
        self.assertEqual(len(nsvcd.sweep(RACK, MUG, scale_b=[1, 2, 3])), 3)

    def test_none(self) -> None:
        for k in (1, 2):
            answers = nsvcd.sweep(MUG, RACK, np.zeros((0, k, 7)))
            self.assertEqual((answers.shape, answers["push_out"].shape), ((0,), (0, 3)))
        self.assertEqual(len(nsvcd.sweep([], RACK)), 0)

    def test_strides(self) -> None:
        expected = nsvcd.sweep(MUG, RACK, self.paths)
        wide = np.zeros((120, 2, 9), np.float32)
        wide[::2, :, 1:8] = self.paths
        for paths in (wide[::2, :, 1:8], np.asfortranarray(self.paths), self.paths.tolist(), self.paths[::-1][::-1]):
            np.testing.assert_array_equal(nsvcd.sweep(MUG, RACK, paths), expected)

    def test_refused(self) -> None:
        self.paths[37, 1, 4] = np.nan
        self.paths[50, 0, 6] = 2
        error = raised(nsvcd.sweep, MUG, RACK, self.paths)
        self.assertEqual((error.code, error.index), (Code.QUATERNION, 37))
        self.assertIn("index 37", str(error))
        same = self.paths[:9]
        self.assertEqual(raised(nsvcd.sweep, MUG, MUG, same, same).code, Code.SAME)
        error = raised(nsvcd.sweep, [MUG, RACK, MUG], MUG, scale_a=[2, 1, 1])
        self.assertEqual((error.code, error.index), (Code.SAME, 2))
        for arguments in ((MUG, RACK, self.paths, self.paths[1:]), ([MUG], RACK, self.paths),
                          (MUG, RACK, self.paths[:, :0]), (MUG, RACK, self.paths[:, :, :6]),
                          (MUG, RACK, self.paths[None])):
            with self.assertRaises(ValueError):
                nsvcd.sweep(*arguments)
        for times in ([0, 0.5, 1], np.zeros((59, 2)), np.zeros((60, 2, 1))):
            with self.assertRaises(ValueError):
                nsvcd.sweep(MUG, RACK, self.paths, times_a=times)
        backwards = np.tile([0, 1], (60, 1))
        backwards[5] = [1, 0]
        error = raised(nsvcd.sweep, MUG, RACK, self.paths[:30], times_a=backwards[:30])
        self.assertEqual((error.code, error.index), (Code.TIMES, 5))
        for scale in (0, [1] * 59 + [0], [1, 2], [[1]]):
            with self.assertRaises(ValueError):
                nsvcd.sweep(MUG, RACK, self.paths, scale_a=scale)
        for bodies in ([MUG] * 59 + [None], 1, None):
            with self.assertRaises(TypeError):
                nsvcd.sweep(bodies, RACK, self.paths)


class Arrays(unittest.TestCase):
    def test_all_that_numpy_has(self) -> None:
        expected = nsvcd.sweep(MUG, RACK, LOW)
        wide = np.zeros((4, 14))
        wide[::2, ::2] = LOW
        locked = np.array(LOW, np.float32)
        locked.flags.writeable = False
        for path in (np.array(LOW), np.array(LOW, np.float32), np.array(LOW, ">f8"), np.asfortranarray(LOW),
                     wide[::2, ::2], np.array(LOW)[::-1][::-1], locked, tuple(map(tuple, LOW)),
                     np.array(LOW, np.longdouble)):
            self.assertEqual(nsvcd.sweep(MUG, RACK, path), expected)
        self.assertEqual(nsvcd.sweep(BOX, RACK, np.array(REST, np.int8)), nsvcd.sweep(BOX, RACK, REST))
        vertices, faces = nsvcd.Mesh.load(ASSETS / "mug.obj")
        for kind in (np.int8 if len(vertices) < 128 else np.int16, np.uint16, np.int64, np.uint64, ">i4"):
            body = Body(vertices.astype(float), np.asfortranarray(faces.astype(kind)), latents=True)
            self.assertEqual(bytes(body), bytes(MUG))
        self.assertEqual(bytes(Body(vertices.tolist(), faces.tolist(), latents=True)), bytes(MUG))

    def test_matrices(self) -> None:
        """Rigid ones are poses, in every place where poses are."""
        random = np.random.default_rng(3)
        poses = np.concatenate([random.normal(size=(50, 3)), random.normal(size=(50, 4))], 1)
        poses[:5, 3:] = np.eye(4)[[0, 1, 2, 3, 3]]  # half turns, where three of the four ways divide by 0
        poses[:, 3:] /= np.linalg.norm(poses[:, 3:], axis=1, keepdims=True)
        x, y, z, w = poses[:, 3:].T
        matrices = np.zeros((50, 4, 4))
        matrices[:, :3, 3], matrices[:, 3, 3] = poses[:, :3], 1
        matrices[:, 0, :3] = np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)], 1)
        matrices[:, 1, :3] = np.stack([2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)], 1)
        matrices[:, 2, :3] = np.stack([2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)], 1)
        back = nsvcd.poses(matrices)
        back[:, 3:] *= np.sign(np.sum(back[:, 3:] * poses[:, 3:], axis=1, keepdims=True))
        self.assertLess(np.abs(back - poses).max(), 1e-12)
        self.assertEqual(nsvcd.poses(np.eye(4)).tolist(), REST[0])

        low = np.tile(np.eye(4), (2, 1, 1))
        low[:, :3, 3] = np.array(LOW)[:, :3]
        self.assertEqual(nsvcd.sweep(MUG, RACK, low), nsvcd.sweep(MUG, RACK, LOW))
        self.assertEqual(nsvcd.sweep(MUG, RACK, low[0].tolist()), nsvcd.sweep(MUG, RACK, LOW[:1]))
        answers = nsvcd.sweep(MUG, RACK, np.stack([low, low[::-1]]))
        self.assertEqual(str(answers), str(nsvcd.sweep(MUG, RACK, [LOW, LOW[::-1]])))
        robots = [nsvcd.Robot([nsvcd.Joint(0, origin)], [nsvcd.Part(BOX, 1, origin), nsvcd.Part(BOX)])
                  for origin in (low[0], LOW[0])]
        self.assertEqual(*(robot.forward_kinematics([0.3]).tolist() for robot in robots))

        def refused(change, words: str) -> None:
            matrix = np.eye(4)
            change(matrix)
            with self.assertRaisesRegex(ValueError, "poses_a: .*" + words):
                nsvcd.sweep(MUG, RACK, np.stack([np.eye(4), matrix]))
        refused(lambda m: m.__setitem__((slice(3), slice(3)), 0.001 * np.eye(3)), "scales, by 0.001: .*scale_a")
        refused(lambda m: m.__setitem__((0, 0), 1.001), "must be rigid")
        refused(lambda m: m.__setitem__((0, 1), 0.001), "must be rigid")
        refused(lambda m: m.__setitem__((0, 0), -1), "mirrors")
        refused(lambda m: m.__setitem__((slice(3), slice(3)), 0), "must be rigid")
        refused(lambda m: m.__setitem__((3, 0), 0.1), "last row.*transpose")
        refused(lambda m: m.__setitem__((0, 3), np.nan), "not finite")

    def test_what_is_given_stays_as_it_is(self) -> None:
        vertices, faces = CUBE.astype(np.float32), FACES.astype(np.uint32)
        body, before = Body(vertices, faces), bytes(BOX)
        vertices[:] = 7
        faces[:] = 0
        self.assertEqual(bytes(body), before)
        self.assertEqual(nsvcd.sweep(body, MUG), nsvcd.sweep(BOX, MUG))

    def test_shapes(self) -> None:
        for path in ([], [[]], [[LOW]], np.zeros((2, 6)), np.zeros((2, 8)), np.zeros((0, 7)), 1, [[1, 2], [3]]):
            with self.assertRaises(ValueError, msg=str(path)):
                nsvcd.sweep(MUG, RACK, path)
            with self.assertRaises(ValueError, msg=str(path)):
                nsvcd.sweep(MUG, RACK, None, path)
        for vertices, faces in ((CUBE[:, :2], FACES), (CUBE, FACES[:, :2]), (CUBE[0], FACES), (CUBE, FACES[0]),
                                ([], [])):
            with self.assertRaises(ValueError):
                Body(vertices, faces)

    def test_types(self) -> None:
        for path in ("path", [["0"] * 7], np.array(LOW, complex), np.array(LOW, object), np.ones((2, 7), bool), [None]):
            with self.assertRaises(TypeError, msg=str(path)):
                nsvcd.sweep(MUG, RACK, path)
        with self.assertRaises(TypeError):
            Body(CUBE, FACES.astype(float))
        for body in (None, bytes(MUG), 1, (CUBE, FACES, CUBE)):
            with self.assertRaises(TypeError):
                nsvcd.sweep(body, RACK)
            with self.assertRaises(TypeError):
                nsvcd.sweep(MUG, body)

    def test_numbers(self) -> None:
        for bad in (np.nan, np.inf, -np.inf):
            for column in range(7):
                path = np.array(LOW)
                path[1, column] = bad
                code = Code.POSE if column < 3 else Code.QUATERNION
                for side, poses in (("a", (path,)), ("b", (LOW, path))):
                    error = raised(nsvcd.sweep, MUG, RACK, *poses)
                    self.assertEqual((error.code, error.where), (code, f"poses_{side}"))
            vertices = CUBE.copy()
            vertices[3, 1] = bad
            self.assertEqual(raised(Body, vertices, FACES).code, Code.NUMBER)
        path = np.array(LOW)
        path[0, 3:] = [0, 0, 0, 1.01]
        self.assertRegex(str(raised(nsvcd.sweep, MUG, RACK, path)), "^poses_a: .*quaternion")

    def test_one_tolerance_of_length(self) -> None:
        """Of quaternions, and of the scale of matrices, as svcd has it."""
        for length in (1.0002, 0.9998, 1.00005, 0.99995):
            is_unit = abs(length - 1) < 1e-4
            path, matrices = np.array(LOW), np.array([np.diag([length, length, length, 1])] * 2)
            path[0, 3:] = [0, 0, 0, length]
            if is_unit:
                nsvcd.sweep(MUG, RACK, path)
                nsvcd.sweep(MUG, RACK, matrices)
            else:
                self.assertEqual(raised(nsvcd.sweep, MUG, RACK, path).code, Code.QUATERNION)
                with self.assertRaisesRegex(ValueError, "scales"):
                    nsvcd.sweep(MUG, RACK, matrices)

    def test_messages_name_the_field(self) -> None:
        path = np.array(LOW)
        three = np.concatenate([path, path[:1]])
        for words, arguments, named in (
                ("^times_a: times ", (three,), {"times_a": [0, 0.7, 0.3]}),
                ("^times_b: times ", (None, path), {"times_b": [0, 2]}),
                ("^poses_a: poses and count .* 65536", (np.repeat(path[:1], 65537, 0),), {}),
                ("^scale_b: a scale ", (path,), {"scale_b": 1e9}),
                ("^to is .* HIT", (path,), {"to": 0.01}),
                ("^segments ", (path,), {"segments": 17}),
                ("^a body holds no latents", (path,), {"method": "network"})):
            self.assertRegex(str(raised(nsvcd.sweep, BOX, BOX, *arguments, **named)), words)
        error = raised(nsvcd.sweep, BOX, BOX, np.array([path] * 3), times_a=[[0, 1], [0, 1], [1, 0]])
        self.assertEqual((error.code, error.where, error.index), (Code.TIMES, "times_a", 2))

    def test_indices(self) -> None:
        for bad in (-1, 8, 2**32, 2**32 + 1, 2**63 - 1):  # 2**32 is 0 in 32 bits
            faces = FACES.copy()
            faces[5, 1] = bad
            self.assertEqual(raised(Body, CUBE, faces).code, Code.INDEX)
        self.assertEqual(raised(Body, CUBE, FACES[:0]).code, Code.EMPTY)
        self.assertIn(raised(Body, CUBE[:0], FACES[:0]).code, (Code.EMPTY, Code.INDEX))
        self.assertEqual(raised(Body, CUBE[:0], FACES).code, Code.INDEX)

    def test_scales(self) -> None:
        for name in ("scale_a", "scale_b"):
            for bad in (-1, np.nan, np.inf, 1e-9, 1e9):
                self.assertEqual(raised(nsvcd.sweep, MUG, RACK, LOW, **{name: bad}).code, Code.SCALE)
            for bad in (0, 1e-60):  # which is 1 in C
                with self.assertRaises(ValueError):
                    nsvcd.sweep(MUG, RACK, LOW, **{name: bad})
            with self.assertRaises(TypeError):
                nsvcd.sweep(MUG, RACK, LOW, **{name: "1"})
        self.assertEqual(nsvcd.sweep(MUG, RACK, LOW, scale_a=np.float32(2)), nsvcd.sweep(MUG, RACK, LOW, scale_a=2))

    def test_options(self) -> None:
        for named in ({"work": -1}, {"pairs": 2**64}, {"segments": -16}, {"model": "huge"}, {"to_time": 1e-60},
                      {"ask": "last"}, {"ask": ""}, {"ask": 1}, {"method": 7}, {"method": None},
                      {"precision": Ask.HIT}):
            with self.assertRaises(ValueError, msg=str(named)):
                nsvcd.sweep(MUG, RACK, LOW, **named)
        for named in ({"work": 1.5}, {"to": "0.1"}, {"pairs": 1.5}, {"recall": "0.99"}):
            with self.assertRaises(TypeError, msg=str(named)):
                nsvcd.sweep(MUG, RACK, LOW, **named)
        first, distance = {"ask": "first"}, {"ask": "distance"}
        for named, code in (({"pairs": 257}, Code.PAIRS), ({"segments": 17}, Code.SEGMENTS),
                            ({"recall": 0.5}, Code.RECALL), ({**first, "to_time": 2}, Code.TO_TIME),
                            ({**first, "to": -1}, Code.TO), ({**first, "to_time": np.nan}, Code.TO_TIME),
                            ({"clearance": -1}, Code.CLEARANCE), ({"slop": np.nan}, Code.SLOP),
                            ({**distance, "to": 1e300}, Code.TO), ({"tolerance": -1}, Code.TOLERANCE),
                            ({"to": 0.1}, Code.TO), ({"to_time": 0.1}, Code.TO_TIME),
                            ({**distance, "to_time": 0.1}, Code.TO_TIME),
                            ({**first, "method": "network"}, Code.METHOD),
                            ({**distance, "to": 0.1, "method": "network"}, Code.METHOD)):
            self.assertEqual(raised(nsvcd.sweep, MUG, RACK, LOW, **named).code, code, named)
        self.assertRaises(TypeError, nsvcd.sweep_gradient, MUG, RACK, LOW, method=Method.PROOF)
        for given in (np.float32(0.5), np.array(0.5), 0.5):  # of whatever can be one
            self.assertEqual(nsvcd.sweep(BOX, BOX, line(-5, -2.6), clearance=given).verdict, "free")
            self.assertEqual(nsvcd.sweep(BOX, BOX, line(-5, -2.4), clearance=given).verdict, "hit")
        self.assertEqual(nsvcd.sweep(BOX, BOX, REST, scale_a=0.1, surfaces=True).verdict, "free")
        self.assertEqual(nsvcd.sweep(BOX, BOX, REST, scale_a=0.1, surfaces=False).verdict, "hit")
        for named in ({"patches": -1}, {"patches": 2**64}):
            with self.assertRaises(ValueError):
                Body(CUBE, FACES, **named)
        self.assertEqual(raised(Body, CUBE, FACES, patches=65537).code, Code.PATCHES)


class Meshes(unittest.TestCase):
    def test_obj(self) -> None:
        text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"
        for given in (text, text.encode()):
            vertices, triangles = nsvcd.Mesh.parse(given)
            self.assertEqual((vertices.dtype, triangles.dtype), (np.float32, np.uint32))
            self.assertEqual((vertices.shape, triangles.shape), ((4, 3), (2, 3)))
            self.assertEqual(set(triangles.ravel().tolist()), {0, 1, 2, 3})
        triangles[0, 0] = 0  # one's own

    def test_obj_errors(self) -> None:
        error = raised(nsvcd.Mesh.parse, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "mug")
        self.assertEqual((error.code, error.line), (Code.INDEX, 4))
        self.assertTrue(str(error).startswith("mug: line 4: "), str(error))
        self.assertEqual(raised(nsvcd.Mesh.parse, "v 0 0 0\nv 0 0 zero\nf 1 2 1\n").line, 2)
        self.assertEqual(raised(nsvcd.Mesh.parse, "").code, Code.EMPTY)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "bad ö.obj"
            path.write_text("v 0 0 0\nf 1\n")
            error = raised(nsvcd.Mesh.load, path)
            self.assertEqual((error.code, error.line, error.where), (Code.SYNTAX, 2, str(path)))
            with self.assertRaises(FileNotFoundError):
                nsvcd.Mesh.load(Path(folder) / "none.obj")
            with self.assertRaises(OSError):
                nsvcd.Mesh.load(folder)

    def test_files(self) -> None:
        """One cube as OBJ, PLY, STL and GLB, by name and by what they are."""
        corners, faces = CUBE.astype("<f4"), FACES.astype("<u4")
        obj = "".join("v {} {} {}\n".format(*row) for row in CUBE) + "".join("f {} {} {}\n".format(*row) for row in FACES + 1)
        ply = (b"ply\nformat binary_little_endian 1.0\nelement vertex 8\nproperty float x\nproperty float y\n"
               b"property float z\nelement face 12\nproperty list uchar uint vertex_indices\nend_header\n"
               + corners.tobytes() + b"".join(b"\3" + row.tobytes() for row in faces))
        stl = bytes(80) + struct.pack("<I", 12) + b"".join(bytes(12) + corners[row].tobytes() + bytes(2) for row in FACES)
        json = (b'{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":'
                b'[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":8,'
                b'"type":"VEC3"},{"bufferView":1,"componentType":5125,"count":36,"type":"SCALAR"}],"bufferViews":[{"buffer":0,'
                b'"byteLength":96},{"buffer":0,"byteOffset":96,"byteLength":144}],"buffers":[{"byteLength":240}]}')
        json += b" " * (-len(json) % 4)
        glb = (struct.pack("<4sIIII", b"glTF", 2, 28 + len(json) + 240, len(json), 0x4E4F534A) + json
               + struct.pack("<II", 240, 0x004E4942) + corners.tobytes() + faces.tobytes())
        with tempfile.TemporaryDirectory() as folder:
            for ending, data in (("obj", obj.encode()), ("ply", ply), ("STL", stl), ("glb", glb)):
                mesh = nsvcd.Mesh.parse(data)
                self.assertEqual(mesh.vertices[mesh.faces].tolist(), CUBE[FACES].tolist(), ending)
                path = Path(folder) / f"cube ö.{ending}"
                path.write_bytes(data)
                self.assertEqual(nsvcd.Mesh.load(path).faces.shape, (12, 3))
                self.assertEqual(bytes(Body(path)), bytes(Body(mesh)))
                self.assertEqual(bytes(Body(str(path), scale=0.5)), bytes(Body(mesh.vertices * 0.5, mesh.faces)))
            with self.assertWarnsRegex(UserWarning, r"cube ö.obj: a body of 2000 m: .* millimetres\? try scale=1$") as warned:
                Body(path.with_suffix(".obj"), scale=1000)
            self.assertEqual(warned.filename, __file__)
            with self.assertWarnsRegex(UserWarning, r"a body of 0.0002 m: .*try scale=0.1$"):
                nsvcd.Mesh.load(path, 1e-4)
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                Body(path, scale=0.001)
            for scale in (0, -1, float("nan"), float("inf")):
                with self.assertRaisesRegex(ValueError, "scale"):
                    Body(path, scale=scale)
            for arguments, named in (((path, FACES), {}), ((CUBE,), {}), ((CUBE, FACES), {"scale": "1"})):
                with self.assertRaises(TypeError):
                    Body(*arguments, **named)
            with self.assertRaises(FileNotFoundError):
                Body(Path(folder) / "none.ply")

    def test_maps_and_millimetres(self) -> None:
        """A limit of a million metres is one of metres, and a map's offset is taken off before numbers are float32."""
        map_text = b"v 500000.10 5400000.00 0\nv 500001.10 5400000.00 0\nv 500000.10 5400001.00 0\nf 1 2 3\n"
        part = b"v 2000000 0 0\nv 2001000 0 0\nv 2000000 1000 0\nf 1// 2// 3//\n"
        for text in (map_text, part):
            self.assertEqual(raised(nsvcd.Mesh.parse, text, "a.obj").code, Code.NUMBER)
        np.testing.assert_allclose(nsvcd.Mesh.parse(part, "a.obj", scale=0.001).vertices,
                                   [[2000, 0, 0], [2001, 0, 0], [2000, 1, 0]])
        wanted = np.array([[0.1, 0, 0], [1.1, 0, 0], [0.1, 1, 0]])
        mesh = nsvcd.Mesh.parse(map_text, "a.obj", origin=(500000, 5400000, 0))
        np.testing.assert_allclose(mesh.vertices, wanted, atol=1e-7)
        ply = (b"ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
               b"element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
               + b"".join(line[2:] + b"\n" for line in map_text.splitlines()[:3]) + b"4 0 1 2 -1\n")
        mesh = nsvcd.Mesh.parse(ply, "a.ply", scale=10, origin=(500000, 5400000, 0))
        np.testing.assert_allclose(mesh.vertices, 10 * wanted, atol=1e-6)
        self.assertEqual(mesh.faces.tolist(), [[0, 1, 2]])
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "map.obj"
            path.write_bytes(map_text)
            self.assertAlmostEqual(Body(path, origin=(500000, 5400000, 0)).facts.centre[0], 0.6, 4)
            body = Body(np.add(CUBE, (500000, 5400000, 0)), FACES, origin=(500000, 5400000, 0), scale=0.5)
            self.assertEqual(bytes(body), bytes(Body(0.5 * CUBE, FACES)))
            for origin in ((1, 2), (np.nan, 0, 0)):
                with self.assertRaisesRegex(ValueError, "origin"):
                    nsvcd.Mesh.load(path, origin=origin)

    def test_what_files_refuse(self) -> None:
        for data, name, code, said in (
                (b"v 0 0 0\nf 1\n", "a.obj", Code.SYNTAX, "^a.obj: line 2: [^(]*$"),
                (b"solid\nfacet\n", "a.obj", Code.FORMAT, "^a.obj: line 1: .* another format"),
                (b"ply\nnot\n", "a.ply", Code.SYNTAX, "^a.ply: line 2: "),
                (b"glTF", "a.glb", Code.SYNTAX, "^a.glb: "),
                (b"", "a.stl", Code.SYNTAX, "^a.stl: "),
                (b"", "a.step", Code.SYNTAX, "OBJ, STL, PLY and GLB are read, and no other"),
                (b"", "", Code.EMPTY, r"^there is .* \(read as OBJ\)$")):
            error = raised(nsvcd.Mesh.parse, data, name)
            self.assertRegex(str(error), said)
            self.assertEqual(error.code, code)
            self.assertEqual(str(pickle.loads(pickle.dumps(error))), str(error))

    def test_cut(self) -> None:
        part = nsvcd.Mesh(CUBE, FACES).cut([-2, -2, -2], [0, 2, 2])
        self.assertEqual((part.vertices[:, 0].min(), part.vertices[:, 0].max()), (-1, 0))
        self.assertFalse(nsvcd.sweep(Body(part, open=True), BOX, at(2.5, 0, 0), scale_b=0.5))
        self.assertEqual(raised(nsvcd.Mesh(CUBE, FACES).cut, [2, 2, 2], [3, 3, 3]).code, Code.EMPTY)
        with self.assertRaises(ValueError):
            nsvcd.Mesh(CUBE, FACES).cut([0, 0], [1, 1, 1])

    def test_hull(self) -> None:
        draw = np.random.default_rng(5)
        grid = np.stack(np.meshgrid(*[np.linspace(-1, 1, 5)] * 3), -1).reshape(-1, 3)
        for points, corners in ((draw.normal(size=(500, 3)), None), (grid, 8), (np.repeat(CUBE, 3, axis=0), 8)):
            hull = nsvcd.Mesh.hull(points)
            points = np.float32(points).astype(float)
            self.assertTrue({*map(tuple, hull.vertices.tolist())} <= {*map(tuple, points.tolist())})
            self.assertEqual(corners or len(hull.vertices), len(hull.vertices))
            a, b, c = np.moveaxis(hull.vertices[hull.faces].astype(float), 1, 0)
            normals = np.cross(b - a, c - a)
            beyond = np.einsum("mk,mnk->mn", normals, points - a[:, None]) / np.linalg.norm(normals, axis=1)[:, None]
            self.assertLess(beyond.max(), 1e-7)
            edges = {(int(t[k]), int(t[k - 1])) for t in hull.faces for k in range(3)}
            self.assertEqual(len(edges), 3 * len(hull.faces))
            self.assertEqual(edges, {(b, a) for a, b in edges})  # it is closed
            self.assertEqual(len(hull.faces), 2 * len(hull.vertices) - 4)
            self.assertEqual(Body(hull).facts.open_edges, 0)
        for code, points in ((Code.EMPTY, grid[grid[:, 0] == 1]), (Code.EMPTY, [[0, 0, 0]] * 9), (Code.NUMBER, [[0, 0, np.nan]] * 9),
                             (Code.NUMBER, 1e30 * CUBE)):
            self.assertEqual(raised(nsvcd.Mesh.hull, points).code, code)
        for points in ([1, 2, 3], np.zeros((4, 2)), [[1, 2, 3], [4, 5]]):
            self.assertRaises(ValueError, nsvcd.Mesh.hull, points)
        self.assertRaises(TypeError, nsvcd.Mesh.hull, [["a", "b", "c"]])

    def test_heights(self) -> None:
        draw = np.random.default_rng(6)
        for shape, holes in (((7, 11), 0), ((7, 11), 9), ((2, 2), 1)):
            field = draw.normal(size=shape)
            field.flat[draw.choice(field.size, holes, replace=False)] = np.nan
            mesh = nsvcd.Mesh.heights(field[::-1], (0.5, 0.25))
            rows, columns = np.indices(shape)
            samples = np.float32(np.stack([0.5 * columns, 0.25 * rows, field[::-1]], -1))
            wanted = set()
            for row in range(shape[0] - 1):
                for column in range(shape[1] - 1):
                    cell = [samples[row + k, column + n] for k, n in ((0, 0), (0, 1), (1, 1), (1, 0))]
                    there = [tuple(corner) for corner in cell if not np.isnan(corner[2])]
                    if len(there) == 3:
                        wanted.add(frozenset(there))
                    if len(there) == 4:
                        wanted |= {frozenset(there[:3]), frozenset([there[0], *there[2:]])}
            corners = mesh.vertices[mesh.faces]
            self.assertEqual({frozenset(map(tuple, triangle)) for triangle in corners}, wanted)
            self.assertEqual(len(corners), len(wanted))
            self.assertTrue((np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2] > 0).all())
        flat = Body(nsvcd.Mesh.heights(np.zeros((3, 3))), open=True)
        self.assertEqual([bool(nsvcd.sweep(Body.sphere(0.1), flat, at(1.5, 1.5, z))) for z in (0.09, 0.11)], [True, False])
        for code, where, call in ((Code.EMPTY, "", ([[np.nan, 0], [np.nan, 0]],)), (Code.EMPTY, "", (np.zeros((1, 9)),)),
                                  (Code.SCALE, "step", (field, 0)), (Code.SCALE, "step", (field, (1, -1))),
                                  (Code.NUMBER, "", ([[np.inf, 0], [0, 0]],)), (Code.EMPTY, "", (np.zeros((0, 5)),))):
            error = raised(nsvcd.Mesh.heights, *call)
            self.assertEqual((error.code, error.where), (code, where))
        for call in (([1, 2, 3],), (field, (1, 2, 3)), (np.zeros((2, 2, 2)),)):
            self.assertRaises(ValueError, nsvcd.Mesh.heights, *call)

    def test_mass(self) -> None:
        """Against a box, and against covariances of tetrahedra."""
        box = nsvcd.Mesh(CUBE * [0.5, 1, 1.5] + [3, 4, 5], FACES).mass()
        self.assertAlmostEqual(box.volume, 6, places=5)
        np.testing.assert_allclose(box.centre, [3, 4, 5], rtol=1e-6)
        np.testing.assert_allclose(box.inertia, [13 / 12, 10 / 12, 5 / 12], rtol=1e-5)
        self.assertEqual((box.is_of_box, box.inertia.dtype), (False, np.float32))
        for mesh in (nsvcd.Mesh.load(ASSETS / "mug.obj"), nsvcd.Mesh.hull(np.random.default_rng(7).normal(size=(40, 3)))):
            corners = mesh.vertices[mesh.faces].astype(float)
            volumes = np.linalg.det(corners) / 6
            centre = (volumes[:, None] * corners.sum(1) / 4).sum(0) / volumes.sum()
            squares = volumes / 20 @ ((corners**2).sum(1) + corners.sum(1)**2) / volumes.sum() - centre**2
            mass = mesh.mass()
            self.assertFalse(mass.is_of_box)
            self.assertAlmostEqual(mass.volume / volumes.sum(), 1, places=5)
            np.testing.assert_allclose(mass.centre, centre, atol=1e-6)
            np.testing.assert_allclose(mass.inertia, squares.sum() - squares, rtol=1e-4)
        for faces in (FACES[:-1], FACES[:, ::-1]):
            mass = nsvcd.Mesh(CUBE, faces).mass()
            self.assertEqual((mass.is_of_box, mass.volume), (True, 8))
        for code, mesh in ((Code.INDEX, (CUBE, FACES + 1)), (Code.NUMBER, (CUBE * np.nan, FACES)), (Code.EMPTY, (CUBE, np.zeros((0, 3), int)))):
            self.assertEqual(raised(nsvcd.Mesh(*mesh).mass).code, code)


class Errors(unittest.TestCase):
    def test_texts(self) -> None:
        for code in Code:
            self.assertGreater(len(str(Error(code))), 5)
        self.assertEqual(len({str(Error(code)) for code in Code}), len(Code))

    def test_pickle(self) -> None:
        error = pickle.loads(pickle.dumps(Error(Code.POSE, "file", 3, 4)))
        self.assertEqual((error.code, error.where, error.line, error.index), (Code.POSE, "file", 3, 4))
        self.assertIs(type(error), Error)


class Bodies(unittest.TestCase):
    def test_a_face_is_missing(self) -> None:
        self.assertEqual((BOX.facts.components, BOX.facts.open_components, BOX.facts.open_edges), (1, 0, 0))
        small = Body(0.1 * np.asarray(CUBE), FACES)
        for is_open in (False, True):
            facts = (body := Body(CUBE, FACES[:-1], open=is_open)).facts
            self.assertEqual((facts.open_components, facts.open_edges, facts.open), (1, 3, is_open))
            answer = nsvcd.sweep(small, body, [[0, 0, 0, 0, 0, 0, 1]])
            self.assertEqual((answer.verdict, answer.why),
                             ("free", "nothing") if is_open else ("undecided", "open"))

    def test_facts(self) -> None:
        facts = BOX.facts
        self.assertEqual((facts.triangles, facts.latents, facts.size), (12, False, len(bytes(BOX))))
        self.assertTrue(3**0.5 <= facts.radius and max(map(abs, facts.centre)) < 0.1)
        self.assertLess(Body(CUBE, FACES, patches=192).facts.radius, 2)
        self.assertTrue(facts.stored_triangles >= 12 and facts.quantization_error == 0 and facts.mean_patch_radius > 0)
        self.assertTrue(0 < Body(CUBE, FACES, coarse=True).facts.quantization_error < 1e-3)
        self.assertEqual(Body(CUBE, FACES, patches=50).facts.patches, 50)
        self.assertGreater(Body(CUBE, FACES, patch_radius=0.1).facts.patches, 192)
        alone = Body(CUBE, FACES, no_triangles=True).facts
        self.assertEqual((alone.triangles, alone.latents), (0, True))
        self.assertTrue(Body(CUBE, FACES, patches=600, latents=True).facts.latents)
        self.assertTrue(nsvcd.sweep(BOX, BOX, scale_b=0.1))
        self.assertFalse(nsvcd.sweep(Body(CUBE, FACES, open=True), BOX, scale_b=0.1))
        self.assertIn(f"{facts.patches} patches", repr(BOX))

    def test_round(self) -> None:
        ball = Body.sphere(0.25)
        pole = Body.capsule((0, 0, -1), (0, 0, 1), 0.5)
        cloud = Body.cloud(np.array([[x, 0, 0] for x in range(100)]), 0.125)
        self.assertEqual((ball.facts.convex_radius, pole.facts.convex_radius, cloud.facts.triangles), (0.25, 0.5, 100))
        self.assertFalse(cloud.facts.latents)
        for body, reach in ((pole, 0.5), (cloud, 0.125)):
            for gap in (1e-4, -1e-4):
                answer = nsvcd.sweep(ball, body, [[0, 3, 0, 0, 0, 0, 1], [0, 0.25 + reach + gap, 0, 0, 0, 0, 1]])
                self.assertEqual(answer.verdict, nsvcd.Verdict.FREE if gap > 0 else nsvcd.Verdict.HIT)
        self.assertEqual(raised(Body, CUBE, FACES, convex_radius=-1).code, Code.RADIUS)
        self.assertEqual(raised(Body.sphere, 0).code, Code.RADIUS)

    def test_patches(self) -> None:
        centre, radius = BOX.patch(0)
        self.assertAlmostEqual(max(map(abs, centre)), 1, delta=radius)
        for index in (-1, BOX.facts.patches, 2**32):
            with self.assertRaises(IndexError):
                BOX.patch(index)

    def test_bytes(self) -> None:
        data = bytes(MUG)
        aligned = np.frombuffer(b"1234567" + data, np.uint8)
        for given in (data, bytearray(data), memoryview(data), aligned[7:], np.frombuffer(data, np.uint64),
                      data + b"more"):
            body = Body.from_bytes(given)
            self.assertEqual(bytes(body), data)
            self.assertEqual(nsvcd.sweep(body, RACK, LOW), nsvcd.sweep(MUG, RACK, LOW))
        given = bytearray(data)
        body = Body.from_bytes(given)
        given[:] = bytes(len(given))
        self.assertEqual(bytes(body), data)
        with tempfile.TemporaryDirectory() as folder:
            MUG.save(Path(folder) / "mug.body")
            self.assertEqual(bytes(Body.load(Path(folder) / "mug.body")), data)
            with self.assertRaises(FileNotFoundError):
                Body.load(Path(folder) / "none.body")
        for body in (pickle.loads(pickle.dumps(MUG)), copy.copy(MUG), copy.deepcopy(MUG)):
            self.assertEqual(bytes(body), data)

    def test_damaged(self) -> None:
        data = bytes(MUG)
        changed = bytearray(data)
        changed[5000] ^= 1
        for given in (b"", b"x", data[:-1], data[1:], changed, bytes(len(data))):
            self.assertEqual(raised(Body.from_bytes, given).code, Code.BODY)
        for given in (5, "body", None):
            with self.assertRaises(TypeError):
                Body.from_bytes(given)

    def test_scaled(self) -> None:
        double = BOX.scaled(2)
        self.assertAlmostEqual(double.facts.radius, 2 * BOX.facts.radius, places=5)
        for x, hits in ((2.9, True), (3.1, False)):
            self.assertEqual(bool(nsvcd.sweep(double, BOX, at(x, 0, 0))), hits)
        for bad in (0, np.nan, 1e30, (1, 0, 1), (1, 1, np.nan)):
            self.assertEqual(raised(BOX.scaled, bad).code, Code.SCALE)
        for bad in ((1, 2), [[1, 2, 3]], (), np.ones(4)):
            self.assertRaises(ValueError, BOX.scaled, bad)
        self.assertRaises(TypeError, BOX.scaled, "2")

    def test_stretched(self) -> None:
        for factors in ((1, 2, 3), (1, -2, 3), np.array([2, 2, -2])):
            body, mesh = BOX.scaled(factors), Body(CUBE * factors, FACES[:, ::-1] if np.prod(factors) < 0 else FACES)
            np.testing.assert_allclose([body.facts.low, body.facts.high], [mesh.facts.low, mesh.facts.high], atol=1e-5)
            self.assertEqual(body.facts.open_edges, 0)
            for axis in range(3):
                for gap in (-1e-3, 1e-3):
                    place = np.zeros(3)
                    place[axis] = abs(factors[axis]) + 0.1 + gap
                    self.assertEqual(bool(nsvcd.sweep(body, BOX, at(0, 0, 0), at(*place), scale_b=0.1)), gap < 0)
        self.assertEqual(bytes(MUG.scaled((2, 2, 2))), bytes(MUG.scaled(2)))
        self.assertEqual((MUG.scaled(2).facts.latents, MUG.scaled((2, 2, 1)).facts.latents), (True, False))
        self.assertEqual(raised(Body.sphere(1).scaled, (1, 1, 2)).code, Code.SCALE)
        self.assertEqual(raised(Body(CUBE, FACES, no_triangles=True).scaled, (1, 1, 2)).code, Code.TRIANGLES)

    def test_cannot_be_changed(self) -> None:
        with self.assertRaises(ValueError):
            BOX._memory[0] = 1

    def test_progress(self) -> None:
        told = []
        vertices, faces = nsvcd.Mesh.load(ASSETS / "mug.obj")
        self.assertEqual(bytes(Body(vertices, faces, latents=True, progress=told.append)), bytes(MUG))
        self.assertTrue(told and all(0 <= done <= 1 for done in told))
        self.assertEqual(raised(Body, vertices, faces, progress=lambda done: True).code, Code.CANCELLED)
        for kind in (ZeroDivisionError, KeyboardInterrupt):
            def fail(done: float) -> None:
                raise kind
            with self.assertRaises(kind):
                Body(vertices, faces, progress=fail)

    def test_nothing_leaks(self) -> None:
        def resident() -> int:
            gc.collect()
            return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
        if not Path("/proc/self/statm").exists():
            self.skipTest("no /proc: not tested")
        text = (ASSETS / "mug.obj").read_bytes()

        def work() -> None:
            for _ in range(60):
                Body(CUBE, FACES)
                raised(Body.from_bytes, b"x")
                for _ in range(10):
                    nsvcd.Mesh.parse(text)
        work()
        before = resident()
        work()
        self.assertLess(resident() - before, 30 * len(bytes(BOX)))


class Threads(unittest.TestCase):
    def test_share_bodies(self) -> None:
        paths = np.tile(np.array(LOW), (200, 1, 1))
        paths[:, :, :3] += np.random.default_rng(7).normal(0, 0.2, (200, 2, 3))
        for options in (dict(ask="first", to_time=0.01), BY_NETWORK):
            expected = [nsvcd.sweep(MUG, RACK, path, **options) for path in paths]

            def ask(_: int) -> bool:
                batch = nsvcd.sweep(MUG, RACK, paths, ask="first", to_time=0.01)
                return ([nsvcd.sweep(MUG, RACK, path, **options) for path in paths] == expected and
                        len(batch) == len(paths))
            with ThreadPoolExecutor(16) as pool:
                self.assertEqual(list(pool.map(ask, range(32))), [True] * 32)

    def test_others_run_meanwhile(self) -> None:
        """A thread that counts, while another one is in the library. Were the GIL kept, there were a gap as long."""
        paths = np.tile(np.array(LOW), (5000, 1, 1))
        options = dict(ask="first", to_time=0.001)
        calls = {"sweep": lambda: nsvcd.sweep(MUG, RACK, paths, **options),
                 "Body": lambda: Body(ASSETS / "dish_rack.obj", patches=4000)}
        for name, call in calls.items():
            for _ in range(5):  # the machine may have been busy
                start = time.perf_counter()
                call()
                alone = time.perf_counter() - start
                thread = threading.Thread(target=call)
                gap, last = 0.0, time.perf_counter()
                thread.start()
                while thread.is_alive():
                    now = time.perf_counter()
                    gap, last = max(gap, now - last), now
                if gap < alone / 3:
                    break
            self.assertLess(gap, alone / 3, f"{name}, which takes {alone:.3f} s")

    def test_bodies_live_as_long_as_they_are_used(self) -> None:
        paths = np.tile(np.array(LOW), (3000, 1, 1))
        expected = nsvcd.sweep(MUG, RACK, paths)
        results = []
        for _ in range(5):
            mug = copy.copy(MUG)
            gone = weakref.ref(mug)
            threads = [threading.Thread(target=lambda *given: results.append(nsvcd.sweep(*given)),
                                        args=(body, RACK, paths)) for body in (mug, [mug] * len(paths))]
            for thread in threads:
                thread.start()
            del mug, threads[:-1]
            gc.collect()
            thread.join()
            del thread, threads
            while threading.active_count() > 1:
                time.sleep(0.001)
            gc.collect()
            self.assertIsNone(gone())
        self.assertEqual(len(results), 10)
        for found in results:
            np.testing.assert_array_equal(found, expected)


def place(joints: np.ndarray) -> np.ndarray:
    """A gantry that carries the mug; the rack rests: examples/plan.c."""
    return np.array([[*joints, 0, 0, 0, 1], [0, 0, 0, 0, 0, 0, 1]])


def gantry(**named) -> nsvcd.Plan:
    given = {"bodies": [MUG, RACK], "pairs": [[0, 1]], "kinematics": place, "start": [0, -0.5, 0], "goal": [0, 0.5, 0],
             "low": [-1, -1, 0], "high": [1, 1, 1]}
    return nsvcd.plan(**{**given, **named})


class Planning(unittest.TestCase):
    def test_gantry(self) -> None:
        plan = gantry()
        self.assertEqual((plan.status, plan.collides, plan.joint), (PlanStatus.CONVERGED, False, None))
        self.assertEqual(plan.control.shape, (12, 3))
        np.testing.assert_array_equal(plan.control[[0, -1]], np.float32([[0, -0.5, 0], [0, 0.5, 0]]))
        joints = nsvcd.spline(plan.control, np.linspace(0, 1, 89))
        self.assertEqual(nsvcd.sweep(MUG, RACK, [place(row)[0] for row in joints]).verdict, "free")
        self.assertTrue(plan.sweeps > 0 and plan.seeds == 1 and plan.iterations > 0)
        self.assertTrue(plan.cost >= plan.smoothness > 0)

    def test_jacobian(self) -> None:
        moves = np.zeros((2, 6, 3))
        moves[0, :3] = np.eye(3)
        np.testing.assert_allclose(gantry(jacobian=lambda joints: moves).control, gantry().control, atol=1e-2)

    def test_options_and_progress(self) -> None:
        told = []
        plan = gantry(progress=told.append, seed=3, explore=Stage(iterations=nsvcd.LEAVE_OUT), refine=Stage(via_points=4),
                      sweep={"clearance": 0.01})
        self.assertEqual(plan.control.shape, (6, 3))
        self.assertTrue(told and all(one.refining and one.control.shape == (6, 3) for one in told))
        joints = nsvcd.spline(plan.control, np.linspace(0, 1, 89))
        path = [place(row)[0] for row in joints]
        self.assertEqual(plan.status, PlanStatus.CONVERGED)
        self.assertGreater(nsvcd.sweep(MUG, RACK, path, ask="distance", to=0.001).distance.high,
                           0.0095)
        self.assertEqual(gantry(progress=lambda now: True).status, PlanStatus.CANCELLED)
        self.assertEqual(gantry(start=[0, 0, 0]).status, PlanStatus.START)
        plan = gantry(goal=[0, 0.5, 3])
        self.assertEqual((plan.status, plan.joint), (PlanStatus.GOAL, 2))

    def test_callbacks_that_raise(self) -> None:
        def after(calls: int, kind: type[BaseException]):
            left = [calls]

            def fail(*_) -> np.ndarray:
                left[0] -= 1
                if left[0] < 0:
                    raise kind
                return place(*_)
            return fail
        for kind in (ZeroDivisionError, KeyboardInterrupt):
            for calls in (0, 1, 500):
                with self.assertRaises(kind):
                    gantry(kinematics=after(calls, kind))
            with self.assertRaises(kind):
                gantry(jacobian=after(0, kind))
            with self.assertRaises(kind):
                gantry(progress=after(0, kind))
        with self.assertRaises(ValueError):
            gantry(kinematics=lambda joints: place(joints)[0])  # which numpy would repeat
        with self.assertRaises(TypeError):
            gantry(kinematics=lambda joints: None)
        self.assertEqual(raised(gantry, kinematics=lambda joints: np.zeros((2, 7))).code, Code.QUATERNION)

    def test_refused(self) -> None:
        for named in ({"goal": [0, 0]}, {"start": [[0, 0, 0]]}, {"pairs": [0, 1]}):
            with self.assertRaises(ValueError):
                gantry(**named)
        for named in ({"bodies": [MUG, 1]}, {"pairs": [[0.0, 1.0]]}):
            with self.assertRaises(TypeError):
                gantry(**named)
        for named, code in (({"pairs": [[0, 2]]}, Code.PAIR), ({"pairs": [[0, -1]]}, Code.INDEX),
                            ({"bodies": [MUG, None]}, Code.ARGUMENT), ({"low": [np.nan] * 3}, Code.VALUE),
                            ({"low": [2, 2, 2]}, Code.LIMITS),
                            ({"seeds": 2000}, Code.PLAN)):
            self.assertEqual(raised(gantry, **named).code, code, named)

    def test_bodies_live_as_long_as_they_are_used(self) -> None:
        bodies, seen = [copy.copy(MUG), copy.copy(RACK)], []
        gone = [weakref.ref(body) for body in bodies]

        def forget(joints: np.ndarray) -> np.ndarray:
            if bodies:
                bodies.clear()
                gc.collect()
            seen.append(all(ref() is not None for ref in gone))
            return place(joints)
        gantry(bodies=bodies, kinematics=forget, seeds=1, explore=Stage(iterations=nsvcd.LEAVE_OUT),
               refine=Stage(iterations=1, draws=1))
        self.assertTrue(seen and all(seen))
        gc.collect()
        self.assertEqual([ref() for ref in gone], [None, None])

    def test_spline(self) -> None:
        control = np.array([[0, 1], [2, 3], [5, -1], [1, 1]])
        np.testing.assert_allclose(nsvcd.spline(control, [0, 1 / 3, 2 / 3, 1]), control, atol=1e-5)
        self.assertEqual(nsvcd.spline(control, 0.5).shape, (2,))
        self.assertEqual(nsvcd.spline(control, np.zeros((3, 4))).shape, (3, 4, 2))
        np.testing.assert_allclose(nsvcd.spline(control, [0, 1], 1), 0, atol=1e-5)
        rate = (nsvcd.spline(control, 0.4 + 1e-3) - nsvcd.spline(control, 0.4 - 1e-3)) / 2e-3
        np.testing.assert_allclose(nsvcd.spline(control, 0.4, 1), rate, rtol=1e-2)
        for bad in (control[:1], np.zeros((35, 2)), control[0]):
            with self.assertRaises(ValueError):
                nsvcd.spline(bad, 0)
        with self.assertRaises(ValueError):
            nsvcd.spline(control, 0, 4)


class Robots(unittest.TestCase):
    """Two joints: a slide along x, and on it an arm of a metre that turns about z, past a post."""

    def setUp(self) -> None:
        kind = nsvcd.JointKind
        joints = [nsvcd.Joint(0, axis=[1, 0, 0], kind=kind.PRISMATIC, low=-2, high=2, speed=1, acceleration=2),
                  nsvcd.Joint(1, low=-3, high=3, speed=2, acceleration=4)]
        arm = Body.capsule([0, 0, 0], [1, 0, 0], 0.05)
        post = Body.sphere(0.2)
        self.robot = nsvcd.Robot(joints, [nsvcd.Part(arm, 2), nsvcd.Part(post, 0, [0, 0.8, 0, 0, 0, 0, 1])], [[0, 1]])

    def test_checks(self) -> None:
        self.assertEqual(self.robot.check([0, 0]).verdict, "free")
        found = self.robot.check([0, np.pi / 2])
        self.assertEqual((found.verdict, found.pair, found.joint), ("hit", 0, None))
        # ends that are free, and a post between; the arm's tip goes by it at 0.75 m
        edge = self.robot.check([[0, 0], [0, 3]])
        self.assertEqual((edge.verdict, edge.piece), ("hit", 0))
        self.assertTrue(0 < edge.fraction < 1)
        self.assertEqual(self.robot.check([[2, 0], [2, 3]], clearance=0.5).verdict, "free")
        self.assertEqual(self.robot.check([[0, 0], [0, 0.3], [0, 0.5]], degree=2, times=[0, 2]).verdict, "free")
        self.assertEqual(self.robot.check([0, 3.1]).joint, 1)
        turned = [1, 0, 0, 0, 0, 0.5 ** 0.5, 0.5 ** 0.5]
        self.assertLess(np.abs(self.robot.forward_kinematics([1, np.pi / 2])[0] - turned).max(), 1e-6)

    def test_mimics(self) -> None:
        """The arm turns as it slides, and in no other way."""
        kind = nsvcd.JointKind
        joints = [nsvcd.Joint(0, axis=[1, 0, 0], kind=kind.PRISMATIC, low=-2, high=2),
                  nsvcd.Joint(1, low=-3, high=3, mimic=0, multiplier=2, offset=0.5)]
        arm = Body.capsule([0, 0, 0], [1, 0, 0], 0.05)
        robot = nsvcd.Robot(joints, [nsvcd.Part(arm, 2), nsvcd.Part(Body.sphere(0.2), 0, [0, 3, 0, 0, 0, 0, 1])], [[0, 1]])
        self.assertEqual(robot.check([[-1, -1.5], [1, 2.5]]).verdict, "free")
        with self.assertRaisesRegex(nsvcd.Error, "mimic"):
            robot.check([[-1, -1.5], [1, 2.4]])
        self.assertEqual(robot.check([1.3, 3.1]).joint, 0)
        at = robot.route([-1, -1.5], [1, 2.5]).points
        np.testing.assert_array_equal(at[:, 1], 2 * at[:, 0] + 0.5)
        with self.assertRaisesRegex(nsvcd.Error, "mimic"):
            nsvcd.Robot([joints[0], joints[1]._replace(mimic=1)], [])

    def test_postures(self) -> None:
        self.assertEqual(self.robot.proximities([0, 0]), [])
        # the arm along y = 0.5 x: how near the post is, and how that changes
        gap, = self.robot.proximities([0, 0], max_distance=1, to=2e-5)
        self.assertAlmostEqual(gap.distance.low, 0.8 - 0.25, delta=5e-5)
        self.assertLess(gap.distance.high - gap.distance.low, 4e-5)
        np.testing.assert_allclose(gap.normal, [0, -1, 0], atol=1e-3)
        turned = [self.robot.proximities([0, a], max_distance=1, to=2e-5)[0].distance.low for a in (0.499, 0.501)]
        gap, = self.robot.proximities([0, 0.5], max_distance=1, to=2e-5)
        self.assertAlmostEqual(gap.slope[1], (turned[1] - turned[0]) / 0.002, delta=0.05)
        gap, = self.robot.proximities([-0.1, np.pi / 2], max_depth=1)
        self.assertEqual((gap.pair, gap.verdict, gap.distance.low), (0, "hit", 0))
        self.assertAlmostEqual(gap.depth, 0.15, delta=0.01)
        out = self.robot.nearest_free([-0.1, np.pi / 2], clearance=0.01)
        assert out is not None
        self.assertEqual(self.robot.check(out, clearance=0.01).verdict, "free")
        self.assertIsNone(self.robot.nearest_free([0, np.pi / 2], farthest=0.01))

    def test_reaches(self) -> None:
        # the tip, half a metre beside where it is with the arm along x: in front, or behind by the other elbow
        tip = [1, 0, 0, 0, 0, 0, 1]
        found = self.robot.reach([0, 0], [0.5, -0.6, 0, 0, 0, 0, 1], 2, tip, free_axis=[0, 0, 1])
        self.assertEqual(found.solutions.shape, (2, 2))
        for x, turn in found.solutions:
            self.assertLess(np.hypot(x + np.cos(turn) - 0.5, np.sin(turn) + 0.6), 1e-5)
            self.assertEqual(self.robot.check([x, turn]).verdict, "free")
        np.testing.assert_array_equal(found.best, found.solutions[0])
        self.assertIsNone(found.check)
        self.assertEqual(len(self.robot.reach([0, 0], [0.5, -0.6, 0, 0, 0, 0, 1], 2, tip, free_axis=[0, 0, 1], most=1).solutions), 1)
        # the tip in the post; a metre too far along x, or, in a box, half of that
        found = self.robot.reach([0, 0], [0, 0.8, 0, 0, 0, 0, 1], 2, tip, free_axis=[0, 0, 1])
        self.assertEqual((len(found.solutions), found.touching), (0, found.reached))
        assert found.check is not None
        self.assertEqual((found.check.verdict, found.check.pair), ("hit", 0))
        self.assertEqual(len(self.robot.reach([0, 0], [0, 0.8, 0, 0, 0, 0, 1], 2, tip, free_axis=[0, 0, 1], may_touch=True).solutions), 2)
        for half in (0, 0.5):
            found = self.robot.reach([0, 0], [4, 0, 0, 0, 0, 0, 1], 2, tip, half=[half, 0, 0])
            self.assertEqual((len(found.solutions), found.reached), (0, 0))
            self.assertAlmostEqual(found.position_error, 1 - half, delta=1e-6)
        with self.assertRaises(Error):
            self.robot.reach([0, 0], tip, 3)
        with self.assertRaises(ValueError):
            self.robot.reach([0], tip, 2)

    def test_pairs(self) -> None:
        kind = nsvcd.JointKind
        joints = [nsvcd.Joint(0, axis=[1, 0, 0], kind=kind.PRISMATIC, low=-2, high=2), nsvcd.Joint(1), nsvcd.Joint(2)]
        ball = Body.sphere(0.2)
        parts = [nsvcd.Part(ball, link) for link in range(4)] + [nsvcd.Part(ball, 3, [1, 0, 0, 0, 0, 0, 1])]
        robot = nsvcd.Robot(joints, parts)
        asked, adjacent, touching = (pairs.tolist() for pairs in robot.find_pairs())
        self.assertEqual(adjacent, [[1, 2], [2, 3], [2, 4]])
        self.assertEqual(touching, [[1, 3]])
        self.assertEqual(asked, [[0, 1], [0, 2], [0, 3], [0, 4], [1, 4]])
        self.assertEqual(robot.pairs.tolist(), asked + touching)
        # link 3 takes hold of the ball in the world
        held = robot.handed_over([0.5, 0.3, 0.2], 0, 3)
        self.assertEqual(held.link, 3)
        carried = nsvcd.Robot(joints, [held, *parts[1:]])
        np.testing.assert_allclose(carried.forward_kinematics([0.5, 0.3, 0.2])[0], robot.forward_kinematics([0.5, 0.3, 0.2])[0], atol=1e-6)
        with self.assertRaises(Error):
            robot.handed_over([0, 0, 0], 9, 0)

    def test_routes(self) -> None:
        route = self.robot.route([0, 0], [[0, np.pi / 2], [0, 3]], clearance=0.01)
        self.assertEqual((route.status, route.goal, route.stops), (nsvcd.RouteStatus.FOUND, 1, 0))
        self.assertGreater(route.duration, route.unhindered)
        times = np.linspace(0, route.duration, 2000)
        way = route.at(times)
        self.assertEqual(way.shape, (2000, 2))
        np.testing.assert_allclose(way[[0, -1]], [[0, 0], [0, 3]], atol=1e-12)
        speeds = np.diff(way, axis=0) / (times[1] - times[0])
        self.assertTrue((np.abs(speeds) < [1 + 1e-9, 2 + 1e-9]).all())
        # the arm is a segment, and the post a point: their distance in closed form
        tip = np.stack([np.cos(way[:, 1]), np.sin(way[:, 1])], 1)
        off = np.stack([-way[:, 0], np.full(2000, 0.8)], 1)
        along = np.clip((off * tip).sum(1), 0, 1)[:, None]
        self.assertGreater(np.linalg.norm(off - along * tip, axis=1).min(), 0.26 - 1e-9)
        self.assertEqual(self.robot.check(route.points, degree=2, times=route.times, clearance=0.01).verdict, "free")
        again = self.robot.route([0, 0], [0, 3], guess=route.at(times[100:-100:100]), nodes=1)
        self.assertEqual(again.status, nsvcd.RouteStatus.FOUND)
        here = self.robot.route([0, 3], [0, 3])
        self.assertEqual((here.status, here.duration), (nsvcd.RouteStatus.FOUND, 0))
        np.testing.assert_array_equal(here.at([0, 1]), [[0, 3], [0, 3]])

    def test_looks_and_clearances(self) -> None:
        # a cart along x, a box of 1 m on it, and a post in its way; up is the way round
        joints = [nsvcd.Joint(0, axis=[1, 0, 0], kind=nsvcd.JointKind.PRISMATIC, low=-9, high=9),
                  nsvcd.Joint(1, kind=nsvcd.JointKind.PRISMATIC, low=-9, high=9)]
        box = Body(CUBE, FACES, balls=40)
        self.assertTrue(0 < box.facts.balls <= 40 and 0 < box.facts.ball_error < box.facts.radius)
        self.assertEqual(Body(CUBE, FACES).facts.balls, 0)
        parts = [nsvcd.Part(box, 2), nsvcd.Part(Body(CUBE, FACES), 0)]
        robot = nsvcd.Robot(joints, parts, [[0, 1]])
        route = robot.route([-4, 0], [4, 0])
        self.assertEqual(route.status, nsvcd.RouteStatus.FOUND)
        self.assertGreater(route.looks, 0)
        self.assertEqual(robot.check(route.points, degree=2, times=route.times).verdict, "free")
        self.assertEqual(robot.route([-4, 0], [4, 0], looks=nsvcd.LEAVE_OUT).looks, 0)
        size = box.facts.high[0] - box.facts.low[0]
        for clearance, verdict in ((0.4, "free"), (0.6, "hit")):
            careful = nsvcd.Robot(joints, parts, [[0, 1]], clearances=[clearance])
            self.assertEqual(careful.check([size + 0.5, 0]).verdict, verdict)
        with self.assertRaises(Error):
            nsvcd.Robot(joints, parts, [[0, 1]], clearances=[-1])
        self.assertRaises(TypeError, nsvcd.Robot, joints, parts, clearances=[0])
        with self.assertRaises(Error):
            Body(CUBE, FACES, balls=1025)
        # until when it is free; and contact where it starts
        checked = robot.check([[-size - 1, 0], [0, 0]], to_time=1e-6)
        self.assertAlmostEqual(checked.free_until, 1 / (size + 1), delta=1e-5)
        self.assertEqual(robot.check([[0.001 - size, 0], [-size - 1, 0]]).verdict, "hit")
        near = nsvcd.Robot(joints, parts, [[0, 1]], allowances=[(0, [-size, 0], 2e-3)])
        self.assertEqual(near.check([[0.001 - size, 0], [-size - 1, 0]]).verdict, "free")
        with self.assertRaises(Error):
            nsvcd.Robot(joints, parts, [[0, 1]], allowances=[(1, [0, 0], 1e-3)])

    def test_merge(self) -> None:
        joints = [nsvcd.Joint(0, axis=axis, kind="prismatic", low=-9, high=9) for axis in ((1, 0, 0), (0, 1, 0))]
        box = Body(CUBE, FACES)
        side = box.facts.high[0] - box.facts.low[0]
        robot = nsvcd.Robot(joints, [nsvcd.Part(box, 1), nsvcd.Part(box, 2)], [[0, 1]])
        moves = [nsvcd.Motion([0], [[-2 * side], [2 * side]], times=[0, 4]),
                 nsvcd.Motion([1], [[-2 * side], [0], [2 * side]], degree=2, times=[0, 4])]

        def conflict(delay: float) -> nsvcd.Checked:
            merged = robot.merge([moves[0], moves[1]._replace(delay=delay)])
            return robot.check(merged.points, degree=merged.degree, times=merged.times, to_time=1e-3)
        self.assertEqual(conflict(0).verdict, "hit")
        self.assertAlmostEqual(conflict(0).free_until, 1, delta=2e-3)
        self.assertAlmostEqual(conflict(1.99).free_until, 2.99, delta=2e-3)
        self.assertEqual(conflict(2.01).verdict, "free")
        still = robot.merge([moves[0]], rest=[0, 3 * side])
        self.assertEqual(still.points.tolist(), [[-2 * side, 3 * side], [2 * side, 3 * side]])
        self.assertIsNone(robot.merge([], rest=[1, 2]).times)
        for wrong, code in (([moves[0], moves[0]], Code.JOINT), ([moves[0]._replace(times=[1, 1])], Code.TIMES)):
            with self.assertRaises(Error) as raised:
                robot.merge(wrong, rest=[0, 0])
            self.assertEqual(raised.exception.code, code)
        self.assertRaises(ValueError, robot.merge, [moves[0]], [0])
        named = nsvcd.Robot([joint._replace(name=name) for joint, name in zip([*joints, nsvcd.Joint(0)], ("rail", "lift", ""))], [])
        for motion, words in ((moves[1], "^rest: nobody moves rail, 2: "), (moves[0], "nobody moves lift, 2: ")):
            with self.assertRaisesRegex(Error, words) as raised:
                named.merge([motion])
            self.assertEqual((raised.exception.code, raised.exception.where), (Code.ARGUMENT, "rest"))

    def test_cones(self) -> None:
        # two joints about y: the box tilts by their sum
        joints = [nsvcd.Joint(k, axis=[0, 1, 0], low=-3, high=3) for k in range(2)]
        parts = [nsvcd.Part(Body(CUBE, FACES, balls=40), 2)]
        robot = nsvcd.Robot(joints, parts, cones=[(0, [0, 0, 2], [0, 0, 1], 0.2)])
        self.assertEqual(robot.check([[0, 0], [1, -1.1]])[:3], ("free", "nothing", None))
        tilted = robot.check([[0, 0], [1, -0.5]], to_time=1e-6)
        self.assertEqual((tilted.verdict, tilted.cone, tilted.pair, tilted.point), ("hit", 0, None, None))
        self.assertAlmostEqual(tilted.free_until, 0.4, delta=1e-5)
        route = robot.route([2, -2], [-2, 2.1])
        self.assertEqual((route.status, route.check.cone), (nsvcd.RouteStatus.FOUND, None))
        self.assertLessEqual(np.abs(route.at(np.linspace(0, route.duration, 500)).sum(axis=1)).max(), 0.2)
        self.assertEqual(robot.route([0, 0.3], [0, 0]).check.cone, 0)
        for cone, code in (((1, [0, 0, 1], [0, 0, 1], 1), Code.LINK), ((0, [0, 0, 0], [0, 0, 1], 1), Code.AXIS),
                           ((0, [0, 0, 1], [0, 0, 1], 4), Code.CONE)):
            with self.assertRaises(Error) as raised:
                nsvcd.Robot(joints, parts, cones=[cone])
            self.assertEqual(raised.exception.code, code)

    def test_ends(self) -> None:
        status = nsvcd.RouteStatus
        stuck = self.robot.route([0, np.pi / 2], [0, 0])
        self.assertEqual((stuck.status, stuck.check.verdict, stuck.points), (status.START, "hit", None))
        self.assertRaises(ValueError, stuck.at, 0)
        self.assertEqual(self.robot.route([0, 0], [0, np.pi / 2]).status, status.GOAL)
        self.assertEqual(self.robot.route([0, 0], [0, 3], stop=lambda: True).status, status.STOPPED)
        self.assertEqual(self.robot.route([0, 0], [0, 3], nodes=2).status, status.LIMIT)
        with self.assertRaises(ZeroDivisionError):
            self.robot.route([0, 0], [0, 3], stop=lambda: 1 // 0)
        with self.assertRaises(Error):
            self.robot.check([0, np.nan])
        self.assertRaises(ValueError, self.robot.check, [[0, 0], [0, 1]], degree=2)
        self.assertRaises(ValueError, self.robot.check, [0, 0, 0])
        with self.assertRaises(Error) as raised:
            nsvcd.Robot([nsvcd.Joint(0, axis=[0, 0, 0])], [], np.empty((0, 2), int))
        self.assertEqual(raised.exception.code, Code.AXIS)

    def test_stl(self) -> None:
        text = "solid\n" + "".join("outer loop\n" + "".join(f"vertex {x} {y} {z}\n" for x, y, z in CUBE[face])
                                   + "endloop\n" for face in FACES)
        mesh = nsvcd.Mesh.parse(text, "a.stl")
        self.assertEqual((mesh.vertices.shape, mesh.faces.shape), ((8, 3), (12, 3)))
        np.testing.assert_array_equal(mesh.vertices[mesh.faces], CUBE[FACES])
        with self.assertRaises(Error) as raised:
            nsvcd.Mesh.parse("solid\nvertex 1 2 x", "a.stl")
        self.assertEqual((raised.exception.code, raised.exception.line), (Code.SYNTAX, 2))


class Worlds(unittest.TestCase):
    """A floor, whose top is at 0, and cubes of 0.2 m."""

    def setUp(self) -> None:
        self.world = nsvcd.World(8)
        self.floor = self.world.add(BOX, at(0, 0, -1)[0], fixed=True)
        self.cube = self.world.add(BOX, at(0, 0, 0.5)[0], scale=0.1)

    def fall(self, id: int, frames: int = 120, **named) -> nsvcd.Slide:
        velocity = np.zeros(6)
        for _ in range(frames):
            velocity[2] -= 9.81 / 60
            slide = self.world.slide(id, velocity, 1 / 60, **named)
            velocity = slide.velocity
        return slide

    def test_bodies_at_their_places(self) -> None:
        world = self.world
        got = world.get(self.cube)
        self.assertIs(got.body, BOX)
        self.assertEqual((got.pose, got.groups, got.passes, got.fixed, got.sensor), (tuple(at(0, 0, 0.5)[0]), 1, 0, False, False))
        self.assertAlmostEqual(got.scale, 0.1)
        self.assertEqual((len(world), world.ids, self.floor in world, 3 in world), (2, (1, 2), True, False))
        world.move(self.cube, [[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]])
        np.testing.assert_array_equal(world.poses(), [at(0, 0, -1)[0], at(1, 2, 3)[0]])
        np.testing.assert_array_equal(world.poses([np.int64(self.cube)]), at(1, 2, 3))
        lamp = world.add(MUG, at(0.1, 0, 4)[0], pivot=[0, 0, 0.05], groups=2, passes=4, sensor=True)
        got = world.get(lamp)
        self.assertEqual((got.groups, got.passes, got.sensor), (2, 4, True))
        np.testing.assert_allclose(got.pivot, [0, 0, 0.05])
        world.remove(self.cube)
        self.assertEqual(world.ids, (self.floor, lamp))
        self.assertEqual(world.add(RACK), self.cube)

    def test_sweeps(self) -> None:
        first = dict(ask="first", to=1e-4)
        down = at(0, 0, 0.5) + at(0, 0, -0.5)
        for mover, named in ((self.cube, {}), (BOX, {"scale": 0.1, "ignore": self.cube})):
            answer = self.world.sweep(mover, down, **first, **named)
            self.assertEqual((answer.verdict, answer.why, answer.body), (Verdict.HIT, Why.NOTHING, self.floor))
            self.assertTrue(answer)
            alone = nsvcd.sweep(BOX, BOX, down, at(0, 0, -1), scale_a=0.1, **first)
            self.assertAlmostEqual(answer.time.high, alone.time.high, places=3)
            self.assertAlmostEqual(answer.safe[2], 0.1, delta=2e-4)
            self.assertEqual([contact.body for contact in answer.contacts], [self.floor])
            self.assertAlmostEqual(answer.contacts[0].contact.normal[2], 1, places=5)
        self.assertFalse(self.world.sweep(self.cube))
        self.assertIsNone(self.world.sweep(self.cube).body)
        self.assertEqual(self.world.sweep(BOX, at(0, 0, 0.5)[0], scale=0.1).body, self.cube)
        # later, on clocks of its own
        late = self.world.sweep(self.cube, [down[0], down[0], down[1]], times=[0, 0.5, 1], **first)
        self.assertAlmostEqual(late.time.high, 0.5 + 0.5 * alone.time.high, places=3)
        pushed = self.world.sweep(self.cube, at(0, 0, 0.095), ask="first", slop=0.01)
        self.assertGreaterEqual(pushed.push_out[2], 0.005)
        manifold = self.world.sweep(self.cube, down, ask="first", to=1e-4, manifold=True)
        self.assertEqual(len(manifold.contacts), 4)

    def test_who_is_met(self) -> None:
        world = self.world
        gate = world.add(BOX, at(0, 0, 0.2)[0], scale=0.05, sensor=True)
        ghost = world.add(BOX, at(0, 0, 0.2)[0], scale=0.05, passes=1)
        down = at(0, 0, 0.5) + at(0, 0, 0)
        self.assertEqual(world.list(self.cube, down), (self.floor, gate))
        self.assertEqual(world.list(BOX, down, scale=0.1), (self.floor, self.cube, gate))
        self.assertEqual(world.list(BOX, down, scale=0.1, groups=8), (self.floor, self.cube, gate, ghost))
        self.assertEqual(world.list(BOX, down, scale=0.1, passes=1), ())
        self.assertEqual(world.pairs().tolist(), [])
        within = {tuple(pair) for pair in world.pairs(0.5).tolist()}
        self.assertEqual(within, {(self.floor, self.cube), (self.floor, gate), (self.cube, gate)})
        self.assertEqual(world.pairs(0.5).dtype, np.uint32)
        crowd = nsvcd.World(20)
        for _ in range(20):  # more pairs than there is room for at first
            crowd.add(BOX)
        self.assertEqual(len(crowd.pairs()), 190)
        self.assertEqual(nsvcd.World(1).pairs().shape, (0, 2))

    def test_slides(self) -> None:
        options = dict(mass=2, inertia=(0.01, 0.01, 0.01), friction=0.5, clearance=0.001, margin=0.001)
        slide = self.fall(self.cube, **options)
        self.assertTrue(slide.rests)
        self.assertEqual(slide.questions, 0)  # what the slide before told was handed back
        np.testing.assert_array_equal(slide.velocity, np.zeros(6))
        self.assertEqual(slide.pose, self.world.get(self.cube).pose)
        self.assertTrue(0.101 < slide.pose[2] < 0.1021, slide.pose)
        self.assertEqual({contact.body for contact in slide.contacts}, {self.floor})
        self.assertGreater(sum(contact.impulse for contact in slide.contacts), 0)
        distance = nsvcd.sweep(BOX, BOX, [slide.pose], at(0, 0, -1), scale_a=0.1, ask="distance").distance
        self.assertGreater(distance.high, 0.001)
        # it is moved, and falls again
        self.world.move(self.cube, at(0, 0, 0.3)[0])
        again = self.world.slide(self.cube, [0, 0, -1], 0.1, **options)
        self.assertFalse(again.rests)
        self.assertAlmostEqual(again.pose[2], 0.2, places=5)
        np.testing.assert_allclose(again.velocity, [0, 0, -1, 0, 0, 0], atol=1e-6)
        given = np.array([0, 0, -1, 0, 0, 1.5])
        turned = self.world.slide(self.cube, given, 0.01, **options)
        self.assertAlmostEqual(turned.pose[5], np.sin(0.0075), places=5)
        np.testing.assert_array_equal(given, [0, 0, -1, 0, 0, 1.5])

    def test_characters_ride(self) -> None:
        walker = dict(up=(0, 0, 1), step=0.3)
        self.assertEqual(self.fall(self.cube, 60, **walker).ground, self.floor)
        lift = self.world.add(BOX, at(0, 0, -0.05)[0], scale=0.04, fixed=True)
        self.world.move(self.cube, at(0, 0, 0.2)[0])
        self.fall(self.cube, 60, **walker)
        before = self.world.get(self.cube).pose[2]
        self.world.drive(lift, at(0, 0, 0.15)[0])
        slide = self.world.slide(self.cube, [0, 0, -0.1], 0.2, **walker)
        self.world.arrive()
        self.assertIsNone(slide.caught)
        self.assertGreater(slide.pose[2], max(before, 0.29))
        self.assertFalse(self.world.sweep(self.cube))
        np.testing.assert_array_equal(self.world.poses([lift])[0, 2], np.float32(0.15))

    def test_caught(self) -> None:
        self.fall(self.cube, mass=1)
        press = self.world.add(BOX, at(0, 0, 0.5)[0], scale=0.1, fixed=True)
        self.world.drive(press, at(0, 0, 0.15)[0])
        self.assertEqual(self.world.slide(self.cube, np.zeros(3), 1 / 60, mass=1).caught, press)

    def test_refused(self) -> None:
        world, turned = self.world, [0, 0, 0, 0, 0, 0, 1.1]
        down = at(0, 0, 0.5) + at(0, 0, 0)
        network = Body(CUBE, FACES, no_triangles=True)
        rest = np.zeros(6)
        for code, where, call in (
                (Code.COUNT, "most", lambda: nsvcd.World(0)),
                (Code.QUATERNION, "pose", lambda: world.add(BOX, turned)),
                (Code.POSE, "pose", lambda: world.add(BOX, [np.nan, 0, 0, 0, 0, 0, 1])),
                (Code.SCALE, "scale", lambda: world.add(BOX, scale=1e9)),
                (Code.PIVOT, "pivot", lambda: world.add(BOX, pivot=[np.inf, 0, 0])),
                (Code.TRIANGLES, "body", lambda: world.add(network)),
                (Code.INDEX, "id", lambda: world.move(7, REST[0])),
                (Code.QUATERNION, "pose", lambda: world.move(1, turned)),
                (Code.INDEX, "id", lambda: world.remove(0)),
                (Code.INDEX, "id", lambda: world.get(9)),
                (Code.INDEX, "id", lambda: world.poses([1, 9])),
                (Code.QUATERNION, "to", lambda: world.drive(1, turned)),
                (Code.INDEX, "mover", lambda: world.sweep(9)),
                (Code.INDEX, "mover", lambda: world.sweep(0)),
                (Code.QUATERNION, "poses", lambda: world.sweep(2, turned)),
                (Code.TIMES, "times", lambda: world.sweep(2, down, times=[1, 0])),
                (Code.ASK, "ask", lambda: world.sweep(2, ask="distance")),
                (Code.CLEARANCE, "", lambda: world.sweep(2, clearance=-1)),
                (Code.DISTANCE, "distance", lambda: world.pairs(-1)),
                (Code.INDEX, "id", lambda: world.slide(9, rest, 1)),
                (Code.SPEED, "velocity", lambda: world.slide(2, [np.nan, 0, 0], 1)),
                (Code.TIMES, "seconds", lambda: world.slide(2, rest, 0)),
                (Code.AXIS, "up", lambda: world.slide(2, rest, 1, up=(0, 0, 2))),
                (Code.DISTANCE, "step", lambda: world.slide(2, rest, 1, step=-1))):
            error = raised(call)
            self.assertEqual((error.code, error.where), (code, where))
        for kind, call in (
                (TypeError, lambda: world.add(2)), (TypeError, lambda: world.sweep(True)),
                (FileNotFoundError, lambda: world.add("none.obj")),
                (TypeError, lambda: world.sweep(2, scale=2)), (ValueError, lambda: world.add(BOX, scale=0)),
                (ValueError, lambda: world.add(BOX, [0, 0])), (ValueError, lambda: world.sweep(2, [down, down])), (ValueError, lambda: world.slide(2, [0, 0], 1)),
                (ValueError, lambda: world.move(-1, REST[0])), (TypeError, lambda: world.move("a", REST[0])),
                (ValueError, lambda: world.slide(2, rest, 1, up=(0, 1))), (TypeError, lambda: world.sweep(2, **BY_NETWORK)),
                (TypeError, lambda: world.list(2, ask="first")), (ValueError, lambda: world.add(BOX, groups=1 << 32)),
                (TypeError, lambda: copy.copy(world)), (TypeError, lambda: copy.deepcopy(world)),
                (TypeError, lambda: pickle.dumps(world))):
            self.assertRaises(kind, call)
        for _ in range(6):
            world.add(BOX)
        self.assertEqual(raised(world.add, BOX).code, Code.COUNT)
        # nothing has changed by all that
        np.testing.assert_array_equal(world.poses([1, 2]), at(0, 0, -1) + at(0, 0, 0.5))

    def test_bodies_live_as_long_as_they_are_used(self) -> None:
        body = copy.copy(BOX)
        gone = weakref.ref(body)
        id = self.world.add(body, at(0, 0, 2)[0], scale=0.1)
        del body
        gc.collect()
        self.assertEqual(self.world.sweep(BOX, at(0, 0, 2), scale=0.1).body, id)
        self.world.remove(id)
        gc.collect()
        self.assertIsNone(gone())
        body = copy.copy(BOX)
        gone = weakref.ref(body)
        self.world.add(body)
        del body, self.world
        gc.collect()
        self.assertIsNone(gone())

    def test_nothing_leaks(self) -> None:
        if not Path("/proc/self/statm").exists():
            self.skipTest("no /proc: not tested")

        def work() -> None:
            for _ in range(300):
                self.setUp()
                self.fall(self.cube, 2, mass=1)
                raised(self.world.move, 7, REST[0])
                self.world.list(self.cube)
                self.world.add(copy.copy(BOX))

        def resident() -> int:
            gc.collect()
            return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
        work()
        before = resident()
        work()
        self.assertLess(resident() - before, 100 * len(bytes(BOX)))

    def test_threads_ask_while_one_changes(self) -> None:
        """In the library, a question during a change is refused as Code.WORLD. Here it waits."""
        world, path = self.world, at(0, 0, 0.5) + at(0, 0, -0.5)
        over = threading.Event()

        def ask() -> int:
            count = 0
            while not over.is_set() or not count:
                self.assertEqual(world.sweep(self.cube, path, ask="first").body, self.floor)
                self.assertEqual(world.list(self.cube, path)[0], self.floor)
                count += 1 + len(world.pairs(9))
            return count
        with ThreadPoolExecutor(4) as pool:
            asked = [pool.submit(ask) for _ in range(4)]
            try:
                for k in range(200):
                    id = world.add(copy.copy(BOX), at(5, 0, k)[0], scale=0.1)
                    world.slide(id, [0, 0, -1], 0.1)
                    world.remove(id)
            finally:
                over.set()
            self.assertTrue(all(future.result() for future in asked))


class Steps(unittest.TestCase):
    """A floor, whose top is at 0, and cubes of 0.2 m."""

    def setUp(self) -> None:
        self.world = nsvcd.World(16)
        self.floor = self.world.add(BOX, at(0, 0, -1)[0], fixed=True)

    def cube(self, *place: float, **named) -> int:
        return self.world.add(BOX, at(*place)[0], scale=0.1, **named)

    def movers(self, ids: list[int], **named) -> nsvcd.Movers:
        inertia = 2 * 0.1**2 * nsvcd.Mesh(CUBE, FACES).mass().inertia
        return nsvcd.Movers(ids, **{"mass": 2, "inertia": inertia, "friction": 0.5, **named})

    def test_a_stack(self) -> None:
        box = nsvcd.Mesh.hull(CUBE)
        world = nsvcd.World(6)
        floor = world.add(Body(box), at(0, 0, -1)[0], fixed=True)
        ids = [world.add(BOX, at(0.01 * k, 0, 0.3 + 0.25 * k)[0], scale=0.1) for k in range(5)]
        movers = nsvcd.Movers(ids, mass=2, inertia=2 * 0.1**2 * box.mass().inertia, friction=0.5)
        fastest = 0.0
        for frame in range(300):
            step = world.step(movers, 1 / 60)
            fastest = max(fastest, -movers.velocity[:, 2].min())
            if movers.asleep.all():
                break
        self.assertGreater(fastest, 1)
        self.assertLess(frame, 120)
        self.assertEqual((step.asleep, step.caught), (5, 0))
        np.testing.assert_array_equal(movers.velocity, np.zeros((5, 6)))
        rest = world.poses(ids)
        np.testing.assert_allclose(rest[:, 2], [0.1 + 0.2 * k for k in range(5)], atol=0.01)
        self.assertTrue((np.diff(rest[:, 2]) > 0.2).all() and rest[0, 2] > 0.1)
        self.assertFalse(any(world.sweep(id) for id in ids))
        self.assertEqual({contact.body for contact in movers.contacts(0)}, {floor, ids[1]})
        self.assertEqual(world.step(movers, 1 / 60), (0, 5, 0, 0, 0, 0))
        np.testing.assert_array_equal(world.poses(ids), rest)

    def test_rows(self) -> None:
        """Each body has its own, and what is written counts."""
        ids = [self.cube(0, 0, 5), self.cube(2, 0, 5), self.cube(4, 0, 5)]
        movers = self.movers(ids, mass=[1, 2, 3], damping=[0, 1, 0], velocity=[[1, 0, 0]] * 3)
        self.assertEqual((len(movers), movers.ids.tolist(), movers.mass.tolist()), (3, ids, [1, 2, 3]))
        self.assertEqual((movers.velocity.shape, movers.inertia.shape, movers.up.shape), ((3, 6), (3, 3), (3, 3)))
        self.assertEqual((movers.asleep.dtype, movers.rounds.dtype, movers.mass.dtype), (bool, np.uint64, np.float32))
        np.testing.assert_array_equal(movers.velocity[:, 3:], 0)
        movers.asleep[2] = True
        movers.velocity[2] = 0
        movers.velocity[:2, 5] += 1
        step = self.world.step(movers, 0.1)
        self.assertEqual((step.awake, step.asleep), (2, 1))
        np.testing.assert_allclose(movers.velocity[0], [1, 0, -0.981, 0, 0, 1], rtol=1e-5)
        np.testing.assert_allclose(movers.velocity[1], [1 / 1.1, 0, -0.981 / 1.1, 0, 0, 1], rtol=1e-5)
        places = self.world.poses(ids)
        np.testing.assert_allclose(places[:, 0], [0.1, 2 + 0.1 / 1.1, 4], rtol=1e-5)
        np.testing.assert_allclose(places[:2, 5], np.sin(0.05), rtol=1e-4)
        movers.velocity = 0
        movers.sleepless = [True, False, False]
        self.world.step(movers, 0.1, gravity=(0, 0, 0))
        np.testing.assert_array_equal(self.world.poses(ids), places)
        self.assertEqual(self.world.step(self.movers([]), 0.1), (0, 0, 0, 0, 0, 0))
        for kind, call in (
                (AttributeError, lambda: setattr(movers, "masses", 1)), (AttributeError, lambda: setattr(movers, "_memory", 1)),
                (ValueError, lambda: setattr(movers, "ids", [1, 2, 3])), (ValueError, lambda: setattr(movers, "ground", 1)),
                (ValueError, lambda: setattr(movers, "mass", [1, 2])), (ValueError, lambda: setattr(movers, "velocity", [1, 2])),
                (ValueError, lambda: setattr(movers, "work", -1)), (TypeError, lambda: setattr(movers, "work", 1.5)),
                (TypeError, lambda: setattr(movers, "mass", "1")), (TypeError, lambda: setattr(movers, "asleep", 0.5)),
                (TypeError, lambda: nsvcd.Movers([1.5])), (ValueError, lambda: nsvcd.Movers(2)),
                (TypeError, lambda: nsvcd.Movers([2], weight=1)), (TypeError, lambda: copy.deepcopy(movers))):
            self.assertRaises(kind, call)
        self.assertEqual(raised(nsvcd.Movers, [0]).code, Code.INDEX)
        self.assertEqual((movers.mass.tolist(), movers.ids.tolist()), ([1, 2, 3], ids))

    def test_they_come_and_go(self) -> None:
        ids = [self.cube(0, 0, 0.102), self.cube(0, 0, 0.31)]
        movers = self.movers(ids)
        while not movers.asleep.all():
            self.world.step(movers, 1 / 60)
        movers = movers + self.movers([self.cube(0, 0, 1)], mass=4)
        self.assertEqual((len(movers), movers.asleep.tolist(), movers.mass.tolist()), (3, [True, True, False], [2, 2, 4]))
        self.world.step(movers, 1 / 60)
        self.assertEqual(movers.asleep.tolist(), [True, True, False])
        self.world.remove(ids[0])  # from under the others
        before = movers[:]
        error = raised(self.world.step, movers, 1 / 60)
        self.assertEqual((error.code, error.where, error.index), (Code.INDEX, "ids", 0))
        movers = movers[movers.ids != ids[0]]
        self.world.step(movers, 1 / 60)
        self.assertEqual((movers.asleep.tolist(), before.asleep.tolist()), ([False, False], [True, True, False]))
        self.assertEqual([len(movers[which]) for which in (0, slice(1, None), [1, 0], movers.mass > 3)], [1, 1, 2, 1])
        self.assertRaises(ValueError, nsvcd.World(3).step, movers, 1)
        other = nsvcd.World(3)
        stranger = nsvcd.Movers([other.add(BOX)], mass=1)
        other.step(stranger, 0.1)
        self.assertRaises(ValueError, lambda: movers + stranger)

    def test_they_push_each_other(self) -> None:
        """Momentum is kept, on ice."""
        ids = [self.cube(-0.5, 0, 2), self.cube(0, 0, 2)]
        movers = self.movers(ids, mass=[1, 3], inertia=0, friction=0, restitution=0.5, velocity=[[2, 0, 0], [0, 0, 0]])
        for _ in range(30):
            self.world.step(movers, 1 / 60, gravity=(0, 0, 0))
        self.assertAlmostEqual(float(movers.mass @ movers.velocity[:, 0]), 2, places=4)
        self.assertGreater(movers.velocity[1, 0], 0.4)
        self.assertGreaterEqual(movers.velocity[1, 0], movers.velocity[0, 0])

    def test_characters(self) -> None:
        """One walks up a lift's side, rides it, and shoves a crate."""
        lift = self.world.add(BOX, at(0, 0, -0.05)[0], scale=0.06, fixed=True)
        walker, crate = self.cube(0, 0, 0.2), self.cube(0.5, 0, 0.102)
        movers = self.movers([walker, crate], mass=[0, 1], inertia=0, friction=[0, 0.2], up=(0, 0, 1), step=0.1, push_mass=[80, 0])
        for _ in range(20):
            self.world.step(movers, 1 / 60)
        self.assertEqual((movers.ground[0], movers.ground_normal[0].round(3).tolist()), (lift, [0, 0, 1]))
        before = self.world.get(walker).pose[2]
        self.world.drive(lift, at(0, 0, 0)[0])
        self.assertEqual(self.world.step(movers, 1 / 10).caught, 0)
        self.assertGreater(self.world.get(walker).pose[2], before + 0.04)
        self.assertEqual(self.world.get(lift).pose, tuple(at(0, 0, 0)[0]))  # it has arrived
        for _ in range(36):
            movers.velocity[0, :2] = 1, 0
            self.world.step(movers, 1 / 60)
        self.assertGreater(self.world.get(crate).pose[0], 0.6)
        self.assertFalse(any(self.world.sweep(id) for id in (walker, crate)))
        press = self.world.add(BOX, [self.world.get(crate).pose[0], 0, 0.5, 0, 0, 0, 1], scale=0.1)
        self.world.drive(press, [self.world.get(crate).pose[0], 0, 0.15, 0, 0, 0, 1])
        self.assertEqual((self.world.step(movers, 1 / 60).caught, movers.caught.tolist()), (1, [0, press]))

    def test_refused(self) -> None:
        world, ids = self.world, [self.cube(0, 0, 0.5), self.cube(0, 0, 1)]
        movers, before = self.movers(ids, velocity=(1, 2, 3)), self.world.poses()
        for code, where, index, step in (
                (Code.TIMES, "seconds, calm", None, lambda: world.step(movers, 0)),
                (Code.TIMES, "seconds, calm", None, lambda: world.step(movers, 1, calm=-1)),
                (Code.SPEED, "quiet", None, lambda: world.step(movers, 1, quiet=-1)),
                (Code.VALUE, "gravity", None, lambda: world.step(movers, 1, gravity=(0, 0, np.nan))),
                (Code.INDEX, "ids", 0, lambda: world.step(self.movers([ids[0], ids[0]]), 1)),
                (Code.INDEX, "ids", 1, lambda: world.step(self.movers([ids[0], self.floor]), 1)),
                (Code.INDEX, "ids", 0, lambda: world.step(self.movers([9]), 1)),
                (Code.INDEX, "ids", None, lambda: world.step(self.movers(range(1, 40)), 1)),
                (Code.SPEED, "velocity", 1, lambda: world.step(self.movers(ids, velocity=[[0, 0, 0], [np.nan, 0, 0]]), 1))):
            error = raised(step)
            self.assertEqual((error.code, error.where, error.index), (code, where, index))
        for name, value, code in (("mass", -1, Code.VALUE), ("inertia", np.nan, Code.VALUE), ("friction", -1, Code.VALUE),
                                  ("restitution", 2, Code.VALUE), ("slope", 2, Code.VALUE), ("push_mass", -1, Code.VALUE),
                                  ("damping", np.inf, Code.VALUE), ("spin_damping", -1, Code.VALUE), ("clearance", -1, Code.CLEARANCE),
                                  ("margin", np.nan, Code.CLEARANCE), ("up", 2, Code.AXIS), ("step", -1, Code.DISTANCE)):
            bad = movers[:]
            getattr(bad, name)[1] = value
            error = raised(world.step, bad, 1 / 60)
            self.assertEqual((error.code, error.index, name in error.where), (code, 1, True), name)
            self.assertIn("index 1", str(error))
        for kind, step in ((TypeError, lambda: world.step(ids, 1)), (ValueError, lambda: world.step(movers, 1, gravity=9.81)),
                           (TypeError, lambda: world.step(movers, "1"))):
            self.assertRaises(kind, step)
        np.testing.assert_array_equal(world.poses(), before)
        np.testing.assert_array_equal(movers.velocity, [[1, 2, 3, 0, 0, 0]] * 2)
        # one is about to leave the coordinates: all but it have moved
        world.move(ids[1], at(0, 0, 999990)[0])
        movers.velocity = [[0, 0, 0], [0, 0, 3000]]
        error = raised(world.step, movers, 1 / 60)
        self.assertEqual((error.code, error.where, error.index), (Code.POSE, "movers", 1))
        self.assertEqual((world.get(ids[1]).pose[2], world.get(ids[0]).pose[2] < 0.5), (999990, True))


class Certificates(unittest.TestCase):
    """Made by neuralsvcd, checked by nsvcd_verify."""

    def setUp(self) -> None:
        self.meshes = {name: nsvcd.Mesh.load(ASSETS / f"{name}.obj") for name in ("mug", "dish_rack")}
        self.meshes["box"] = nsvcd.Mesh(CUBE, FACES)
        self.trees = {name: nsvcd.Tree(mesh) for name, mesh in self.meshes.items()}
        self.checked = {name: nsvcd_verify.Mesh(mesh) for name, mesh in self.meshes.items()}

    def certify(self, a: str, b: str, *poses, **named) -> nsvcd.Certificate:
        return nsvcd.certify(self.trees[a], self.trees[b], *poses, **named)

    def verify(self, proof: bytes, a: str, b: str, *poses, **named) -> nsvcd_verify.Report:
        return nsvcd_verify.verify(proof, self.checked[a], self.checked[b], *poses, **named)

    def test_open(self) -> None:
        """Something is inside of what is not quite closed: nothing is free, whether certify asks or is told."""
        inner, outer = nsvcd.Mesh(0.2 * CUBE, FACES), nsvcd.Mesh(CUBE, FACES[:-1])
        answer = nsvcd.sweep(nsvcd.Body(inner), nsvcd.Body(outer))
        self.assertEqual((answer.verdict, answer.why), ("undecided", "open"))
        for told in (answer, None):
            made = nsvcd.certify(inner, outer, answer=told)
            self.assertEqual((made.verdict, made.why, made.bytes), ("undecided", "open", b""))

    def both(self, *scene, **named) -> tuple[nsvcd.Certificate, nsvcd_verify.Report]:
        """What is made is accepted."""
        made = self.certify(*scene, **named)
        named.pop("answer", None)
        report = self.verify(made.bytes, *scene, **named)
        self.assertEqual((report.accepted, report.reason, report.position >= len(made.bytes) - 1), (True, "", True))
        self.assertEqual((made.verdict == "free", made.inside), (bool(report), report.kind == "inside"))
        self.assertEqual(report.time, made.time)
        return made, report

    def test_claim(self) -> None:
        """By hashlib, from the bytes that nsvcd_verify_claim.h describes."""
        def mesh_of(name: str) -> bytes:
            vertices, triangles = self.meshes[name]
            return hashlib.sha256(b"nsvcd mesh 1" + struct.pack("<II", len(vertices), len(triangles)) +
                                  np.asarray(vertices, "<f4").tobytes() + np.asarray(triangles, "<u4").tobytes()).digest()
        turning = np.array([[0, 0, 1, 0, 0, 0, 1], [0, 0, 1, 0, 0, 0.6, 0.8], [0, 0.5, 1, 0, 0, 0, 1]])
        expected = hashlib.sha256(
            b"nsvcd claim 1" + struct.pack("<f", 0.01) +
            mesh_of("mug") + struct.pack("<fBIB", 2, 1, 3, 1) + turning.astype("<f4").tobytes() +
            struct.pack("<fff", 0, 0.25, 1) +
            mesh_of("dish_rack") + struct.pack("<fBIB7f", 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 1)).digest()
        scene = self.checked["mug"], self.checked["dish_rack"], turning
        named = {"times_a": [0, 0.25, 1], "scale_a": 2, "clearance": 0.01}
        self.assertEqual(nsvcd_verify.claim(*scene, **named), expected)
        self.assertNotEqual(nsvcd_verify.claim(*scene, **{**named, "clearance": 0}), expected)
        with self.assertRaises(ValueError):
            nsvcd_verify.claim(*scene, times_a=[0, 1])

    def test_kinds(self) -> None:
        made, report = self.both("mug", "dish_rack", HIGH)
        self.assertEqual((made.verdict, report.kind, report.time), (Verdict.FREE, nsvcd_verify.Kind.FREE, 0))
        self.assertGreater(made.visits, 0)
        self.assertEqual(self.both("mug", "dish_rack", LOW, answer=nsvcd.sweep(MUG, RACK, LOW))[0].visits, 0)
        made, report = self.both("box", "box", line(-5, 0), scale_a=0.5)
        self.assertEqual((made.verdict, report.kind), ("hit", "hit"))
        self.assertGreaterEqual(report.time, 0.7)
        self.assertTrue(2 <= report.a < 12 and report.b < 2)  # at x = -1 of b
        made, report = self.both("box", "box", REST, scale_a=0.1)
        self.assertEqual((made.verdict, report.kind, report.time), ("hit", "inside", 0))
        self.assertTrue(report.a < 8 and report.b == 0)
        # the nearest that the boxes come is 1 m
        self.assertEqual(self.both("box", "box", line(-5, -3), clearance=0.99)[1].kind, "free")
        made, report = self.both("box", "box", line(-5, -3), clearance=1.01)
        self.assertEqual((made.verdict, report.kind), ("hit", "near"))
        self.assertGreaterEqual(report.time, 0.99)

    def test_two_movers(self) -> None:
        """With times and scales: a box waits until the other, of half its size, has passed its gate."""
        gate = at(0, 3, 0) + at(0, 3, 0) + at(0, 0, 0)
        for wait, verdict in ((0.7, "free"), (0.1, "hit")):
            named = {"times_b": [0, wait, 1], "scale_a": 0.5}
            made, report = self.both("box", "box", line(-9, 9), gate, **named)
            self.assertEqual((made.verdict, report.kind), (verdict, verdict))
            swapped = {"times_a": [0, wait, 1], "scale_b": 0.5}
            self.assertEqual(self.both("box", "box", gate, line(-9, 9), **swapped)[0].verdict, verdict)
        self.assertEqual(self.both("box", "box", None, [[3, 0, 0, 0, 0, 0, 1]] * 2, scale_a=1.9)[0].verdict, "free")

    def test_as_sweep_says(self) -> None:
        random = np.random.default_rng(5)
        seen = set()
        for _ in range(60):
            path = np.array(LOW + HIGH, float)
            path[:, :3] += random.normal(0, 0.2, (4, 3))
            path[:, 3:] += random.normal(0, 0.3, (4, 4))
            path[:, 3:] /= np.linalg.norm(path[:, 3:], axis=1)[:, None]
            answer = nsvcd.sweep(MUG, RACK, path)
            made = self.both("mug", "dish_rack", path, answer=answer)[0]
            self.assertEqual(made.verdict, answer.verdict)
            seen.add(made.verdict)
        self.assertEqual(len(seen), 2)

    def test_about_something_else(self) -> None:
        proof = self.certify("mug", "dish_rack", HIGH).bytes
        for reason, scene, named in (
                ("it is about another mesh a", ("box", "dish_rack", HIGH), {}),
                ("it is about another mesh b", ("mug", "box", HIGH), {}),
                ("it is about another motion, scale or clearance", ("mug", "dish_rack", LOW), {}),
                ("it is about another motion, scale or clearance", ("mug", "dish_rack", HIGH), {"scale_b": 1.1}),
                ("it is about another motion, scale or clearance", ("mug", "dish_rack", HIGH), {"clearance": 0.1}),
                ("a clearance is out of range", ("mug", "dish_rack", HIGH), {"clearance": np.nan})):
            report = self.verify(proof, *scene, **named)
            self.assertEqual((report.accepted, report.reason, report.kind, bool(report)), (False, reason, None, False))
        for proof, reason in ((b"", "it is no certificate of version 1"), (proof + b"\0", "something follows its end"),
                              (proof[:-1], "it ends early")):
            report = self.verify(proof, "mug", "dish_rack", HIGH)
            self.assertEqual((report.accepted, report.reason), (False, reason))

    def test_flipped_bits(self) -> None:
        """Of a free motion's certificate, with the head that one of a colliding motion has: never is that free."""
        free, hit = ([[0, -0.4, 0.3, *np.array([1, 2, 3, 4]) / 30 ** 0.5], [0, 0, z, 0, 0, 0, 1]] for z in (0.09, 0.07))
        proof = self.both("mug", "dish_rack", free)[0].bytes
        made = self.both("mug", "dish_rack", hit)[0]
        self.assertEqual(made.verdict, "hit")
        self.assertGreater(len(proof), 60)
        forged = bytes([made.bytes[0] & 0xfc]) + made.bytes[1:5] + proof[5:]
        self.assertEqual(self.verify(forged, "mug", "dish_rack", hit).reason, "a plane does not part its nodes")
        random = np.random.default_rng(7)
        flips = [[k] for k in range(8 * len(proof))]
        flips += [random.integers(40, 8 * len(proof), random.integers(2, 9)).tolist() for _ in range(2000)]
        for given in (proof, forged):
            for places in flips:
                bits = bytearray(given)
                for place in places:
                    bits[place // 8] ^= 0x80 >> place % 8
                self.assertNotEqual(self.verify(bits, "mug", "dish_rack", hit).kind, "free")
                self.assertIn(self.verify(bits, "mug", "dish_rack", free).kind, (None, "free"))

    def test_undecided(self) -> None:
        made = self.certify("mug", "dish_rack", [[0, -0.4, 0.3, *np.array([1, 2, 3, 4]) / 30 ** 0.5], [0, 0, 0.09, 0, 0, 0, 1]], visits=1)
        self.assertEqual((made.verdict, made.bytes, made.inside), ("undecided", b"", False))

    def test_asks_first(self) -> None:
        """Where it is not told an answer it asks for one, so that a hit takes next to no visits; symmetric ones took the most."""
        wide = nsvcd.Tree(CUBE * [1.5, 0.5, 1], FACES)
        side, turned = [*at(0, 4, 0), *at(0, 0, 0)], {"times_a": [0, 0.1, 1], "scale_a": 2}
        for a, b, path, named in ((self.trees["mug"], self.trees["dish_rack"], LOW, {}), (wide, self.trees["box"], side, {}),
                                  (wide, self.trees["box"], [*side, *at(0, 9, 0)], turned),
                                  (wide, self.trees["box"], at(0, 1.51, 0), {"clearance": 0.02})):
            for given in ((a, b), [Body(nsvcd.Mesh(*tree._mesh.kept)) for tree in (a, b)], [tree._mesh.kept for tree in (a, b)]):
                made = nsvcd.certify(*given, path, visits=99, **named)
                self.assertEqual(made.verdict, "hit")
                report = nsvcd_verify.verify(made, a._mesh.kept, b._mesh.kept, path, **named)
                self.assertEqual(report.kind, "near" if named.get("clearance") else "hit")
        missed = nsvcd.certify(wide, self.trees["box"], side, answer=nsvcd.sweep(BOX, BOX, at(9, 0, 0)), visits=99)
        self.assertEqual(missed.verdict, "undecided")  # of an answer that is of no use
        bare = Body(CUBE, FACES, no_triangles=True, latents=True)  # the network is not asked
        self.assertEqual(nsvcd.certify(bare, bare, at(0.5, 0.3, 0.1)).verdict, "hit")
        self.assertEqual(nsvcd.certify(bare, bare, at(9, 0, 0)).verdict, "free")

    def test_refused(self) -> None:
        """As sweep refuses it; by nsvcd_verify it is a ValueError with its reason."""
        box, checked = self.trees["box"], self.checked["box"]
        for code, path, named in ((Code.POSE, at(np.nan, 0, 0), {}), (Code.QUATERNION, [[0, 0, 0, 0, 0, 0, 2]], {}),
                                  (Code.TIMES, line(0, 1), {"times_a": [0, 0.5]}),
                                  (Code.SCALE, REST, {"scale_a": -1}), (Code.SCALE, REST, {"scale_b": 1e9})):
            self.assertEqual(raised(nsvcd.certify, box, box, path, **named).code, code)
            with self.assertRaisesRegex(ValueError, "^[ab]: (a|times) "):
                nsvcd_verify.verify(b"", checked, checked, path, **named)
        for clearance in (-1, np.nan, 1e9):
            self.assertEqual(raised(nsvcd.certify, box, box, clearance=clearance).code, Code.CLEARANCE)
        for path, named in (([[1, 2]], {}), ([], {}), (np.zeros((0, 7)), {}), (REST, {"scale_b": 0}),
                            (line(0, 1), {"times_a": [0, 0.5, 1]})):
            for call in (nsvcd.certify, functools.partial(nsvcd_verify.verify, b"")):
                mesh = box if call is nsvcd.certify else checked
                with self.assertRaises(ValueError, msg=str(path)):
                    call(mesh, mesh, path, **named)
        for path, named in (("path", {}), ([["0"] * 7], {}), (REST, {"scale_a": "1"}), (REST, {"clearance": "1"})):
            with self.assertRaises(TypeError):
                nsvcd.certify(box, box, path, **named)
            with self.assertRaises(TypeError):
                nsvcd_verify.verify(b"", checked, checked, path, **named)
        for a, b in ((Body.sphere(1), box), (box, None), (1, box)):
            with self.assertRaises(TypeError):
                nsvcd.certify(a, b)
        for a, b in ((checked, box), (None, checked), (checked, (CUBE, FACES, CUBE))):
            with self.assertRaises(TypeError):
                nsvcd_verify.verify(b"", a, b)
        for proof in ("", 5, None):
            with self.assertRaises(TypeError):
                nsvcd_verify.verify(proof, checked, checked)
        with self.assertRaises(ValueError):
            nsvcd.certify(box, box, visits=-1)

    def test_meshes_refused(self) -> None:
        for code, vertices, faces in ((Code.EMPTY, CUBE, FACES[:0]), (Code.INDEX, CUBE, FACES + 1),
                                      (Code.INDEX, CUBE, FACES - 1), (Code.INDEX, CUBE, FACES + 2**32),
                                      (Code.NUMBER, np.where(CUBE < 0, np.nan, CUBE), FACES)):
            self.assertEqual(raised(nsvcd.Tree, vertices, faces).code, code)
            self.assertRaises(ValueError, nsvcd_verify.Mesh, vertices, faces)
        for kind in (nsvcd.Tree, nsvcd_verify.Mesh):
            self.assertRaises(ValueError, kind, CUBE[:, :2], FACES)
            self.assertRaises(TypeError, kind, CUBE, FACES.astype(float))

    def test_copies(self) -> None:
        made = self.both("mug", "dish_rack", HIGH)[0]
        for copied in (copy.copy, copy.deepcopy, lambda mesh: pickle.loads(pickle.dumps(mesh))):
            mug, checked = copied(self.trees["mug"]), copied(self.checked["mug"])
            gc.collect()
            self.assertEqual(nsvcd.certify(mug, self.trees["dish_rack"], HIGH), made)
            self.assertTrue(nsvcd_verify.verify(made.bytes, checked, self.checked["dish_rack"], HIGH))
        self.assertEqual(pickle.loads(pickle.dumps(made)), made)

    def test_threads(self) -> None:
        """They share meshes, of which rays take notes: a box in a torus, and one in its hole."""
        turns = np.stack(np.meshgrid(np.arange(80), np.arange(40), indexing="ij"), -1).reshape(-1, 2)
        u, v = (turns * [2 * np.pi / 80, 2 * np.pi / 40]).T
        torus = np.stack([(2 + np.cos(v)) * np.cos(u), (2 + np.cos(v)) * np.sin(u), np.sin(v)], 1)
        corner = [((turns + step) % [80, 40]) @ [40, 1] for step in ([0, 0], [1, 0], [1, 1], [0, 1])]
        mesh = torus, np.concatenate([np.stack(corner[:3], 1), np.stack(corner[::2] + corner[3:], 1)])
        tree, checked = nsvcd.Tree(mesh), nsvcd_verify.Mesh(mesh)
        scenes = [(nsvcd.certify(self.trees["box"], tree, place, scale_a=0.1).bytes, place)
                  for place in (at(2.01, 0.02, 0.03), at(0.01, 0.02, 0.03))]

        def kind_of(scene) -> str:
            return nsvcd_verify.verify(scene[0], self.checked["box"], checked, scene[1], scale_a=0.1).kind
        self.assertEqual(list(map(kind_of, scenes)), ["inside", "free"])
        with ThreadPoolExecutor(8) as pool:
            self.assertEqual(list(pool.map(kind_of, scenes * 50)), ["inside", "free"] * 50)

    def test_the_checker_shares_nothing(self) -> None:
        run = "import sys, nsvcd_verify; sys.exit('neuralsvcd' in sys.modules)"
        self.assertEqual(subprocess.run([sys.executable, "-B", "-c", run], cwd=HERE).returncode, 0)
        for file in [HERE / "_nsvcd_verify.c", *(HERE.parent / "verify").glob("nsvcd_verify*.h")]:
            for name in re.findall(r'#include "(.*)"', file.read_text()):
                self.assertTrue(Path(name).name.startswith("nsvcd_verify"), name)


class Layouts(unittest.TestCase):
    """The module as it stands, but for one mistake, does not load."""

    def load(self, old: str, new: str) -> None:
        with tempfile.TemporaryDirectory() as folder:
            package = Path(folder) / "changed"
            shutil.copytree(Path(nsvcd.__file__).parent, package, ignore=shutil.ignore_patterns("__pycache__"))
            shutil.copy(nsvcd._library._library._name, package / "_neuralsvcd.abi3.so")
            texts = {file: file.read_text() for file in package.glob("*.py")}
            self.assertEqual(sum(text.count(old) for text in texts.values()), 1, old)
            for file, text in texts.items():
                file.write_text(text.replace(old, new))
            sys.path.insert(0, folder)
            try:
                importlib.import_module("changed")
            finally:
                sys.path.remove(folder)
                for name in [name for name in sys.modules if name.split(".")[0] == "changed"]:
                    del sys.modules[name]
                importlib.invalidate_caches()

    def test_mistakes(self) -> None:
        self.load("verdict=c_int, by=c_int", "verdict=c_int, by=c_int")
        for old, new, name in (
                ("verdict=c_int, by=c_int", "by=c_int, verdict=c_int", "nsvcd_answer.by"),
                ("opinion=_Opinion, work=c_size_t", "opinion=_Opinion", "nsvcd_answer.work"),
                ("surfaces=c_int, stop", "surfaces=c_int, next=c_size_t, stop", "nsvcd_question.next"),
                ("limited=c_int", "limited=c_uint64", "nsvcd_opinion.limited"),
                ("count=c_size_t, times=c_void_p", "count=c_uint32, times=c_void_p", "nsvcd_mover.count"),
                ("discrete=c_int", "apart=c_int", "nsvcd_plan_options.apart"),
                ('    UNDECIDED = "undecided"\n    FREE = "free"', '    FREE = "free"\n    UNDECIDED = "undecided"',
                 "NSVCD_UNDECIDED"),
                ('    TOO_NEAR = "too near"\n', "", "NSVCD_WHY_TOO_NEAR"),
                ("_MAX_CONTACTS = 4", "_MAX_CONTACTS = 5", "NSVCD_MAX_CONTACTS"),
                ("spent=c_float, rests=c_int", "rests=c_int, spent=c_float", "nsvcd_slide_answer.rests"),
                ("sleepless=c_int, calm=c_float", "calm=c_float, sleepless=c_int", "nsvcd_world_mover.calm"),
                ("_WORLD_CONTACTS = 32", "_WORLD_CONTACTS = 33", "NSVCD_WORLD_CONTACTS"),
                ("inside=c_int, time=c_double", "time=c_double, inside=c_int", "nsvcd_certificate.inside"),
                ("    CANCELLED = 5\n", "", "NSVCD_ERROR_CANCELLED"),
                ("_MAX_VIA_POINTS = 32", "_MAX_VIA_POINTS = 33", "NSVCD_MAX_VIA_POINTS")):
            with self.assertRaisesRegex(ImportError, f"another neuralsvcd.h.*{name}", msg=new):
                self.load(old, new)


class Readme(unittest.TestCase):
    def test_example(self) -> None:
        text = (HERE / "README.md").read_text()
        _, example = re.findall(r"^```python\n(.*?)^```", text, re.M | re.S)  # the first is run by tests/ways.sh
        expected, = re.findall(r"# of all: (.*)", example)
        folder = os.getcwd()
        os.chdir(ROOT)
        try:
            with redirect_stdout(io.StringIO()) as printed:
                exec(example, {})
        finally:
            os.chdir(folder)
        self.assertEqual(printed.getvalue().splitlines(), re.split(", (?=[^ )]+ )", expected))
        self.assertLessEqual(text.count("\n"), 60)

    def test_docstring(self) -> None:
        """What the guide's first lines print is when the mug meets the rack first: until shortly before it is free. All of its
        code runs, and all names are named."""
        example = "\n".join(re.findall(r"^    (.*)", nsvcd.__doc__, re.M))
        folder = os.getcwd()
        os.chdir(ASSETS)
        try:
            with redirect_stdout(io.StringIO()) as printed:
                exec(example, names := {**vars(nsvcd), "np": np})
        finally:
            os.chdir(folder)
        before = float(printed.getvalue()) - 0.01
        until = np.add(LOW[0], before * np.subtract(LOW[1], LOW[0]))
        self.assertEqual(nsvcd.sweep(MUG, RACK, [LOW[0], until]).verdict, "free")
        self.assertAlmostEqual(names["earliest"], 0.6, delta=0.1)
        self.assertEqual(names["checked"].verdict, "free")
        self.assertTrue(names["movers"].asleep.all())
        listed = re.findall(r"\w+", nsvcd.__doc__[nsvcd.__doc__.index("\nNAMES\n"):])
        public = [name for name, value in vars(nsvcd).items() if name[0] != "_" and not isinstance(value, types.ModuleType)]
        self.assertEqual([name for name in public if name not in listed], [])


class Newcomers(unittest.TestCase):
    """What they do first, and what they are told."""

    def test_beyond_limits(self) -> None:
        joint = nsvcd.Joint(0, low=-3, high=3)
        robot = nsvcd.Robot([joint], [nsvcd.Part(BOX, 1), nsvcd.Part(BOX, 0, pose=(5, 0, 0, 0, 0, 0, 1))], [(0, 1)])
        within, beyond = robot.check([[0], [2]]), robot.check([[0], [90]])
        self.assertEqual((within.verdict, bool(within), beyond.verdict, beyond.joint, bool(beyond)), ("free", False, "free", 0, True))

    def test_set_down_flat(self) -> None:
        """Faces on faces at the first contact: with its answer, with none, the hit is proven; the certificate itself is taken."""
        ground, random = nsvcd.Mesh.box([1, 1, 0.5]), np.random.default_rng(52)
        for _ in range(40):
            sizes, place = random.uniform(0.05, 0.3, 3), random.uniform(-0.2, 0.2, 2)
            thing = nsvcd.Mesh.box(sizes)
            path = nsvcd.poses([[*place, 2], [*place, 0.25 + sizes[2] / 2 - random.uniform(0.005, 0.05)]])
            for answer in None, nsvcd.sweep(thing, ground, path, ask="first"):
                certificate = nsvcd.certify(thing, ground, path, answer=answer)
                # of meshes that are nobody's but this call's: what it makes of them must live as long as it
                report = nsvcd_verify.verify(certificate, tuple(thing), tuple(ground), path)
                self.assertEqual((certificate.verdict, report.kind, report.reason), ("hit", "hit", ""))

    def test_told(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "open.obj"
            file.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n")
            with self.assertWarnsRegex(UserWarning, "open.obj: not a closed surface: 3 open edges; .* open=True") as warned:
                nsvcd.Body(file)
            self.assertEqual(warned.filename, __file__)
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                nsvcd.Body(file, open=True)
        world = nsvcd.World(1)
        world.add(BOX)
        for told, wrong in (("the world is full", lambda: world.add(BOX)),
                            ("the order is sweep", lambda: nsvcd.sweep(BOX, [[0, 0, 0]], BOX)),
                            ("no pose; None is at rest", lambda: nsvcd.sweep(BOX, BOX, [])),
                            (r"neuralsvcd.poses\(path\) makes it", lambda: nsvcd_verify.verify(b"", BOX.mesh, BOX.mesh, [[0, 0, 0]])),
                            ("its mesh is body.mesh", lambda: nsvcd_verify.Mesh(BOX))):
            with self.assertRaisesRegex(Exception, told):
                wrong()


class Wheel(unittest.TestCase):
    def test_from_a_clean_checkout(self) -> None:
        """Only what the build needs is copied, into an sdist; a wheel of that runs in an environment of its own."""
        tools = subprocess.run([sys.executable, "-c", "import setuptools, wheel, pip, venv"], capture_output=True)
        if tools.returncode or not (ROOT / "neuralsvcd.h").exists():
            self.skipTest("no setuptools, wheel, pip or venv: not tested")
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            sources = folder / "checkout" / "examples" / "python"
            sources.mkdir(parents=True)
            for part in ("verify", "scenery"):
                shutil.copytree(HERE.parent / part, folder / "checkout" / "examples" / part,
                                ignore=lambda _, names: [name for name in names if not name.endswith(".h")])
            shutil.copytree(HERE.parent / "robot", folder / "checkout" / "examples" / "robot")
            shutil.copytree(ROOT / "extras", folder / "checkout" / "extras")
            for file in ("neuralsvcd.h", "weights.h", "LICENSE"):
                shutil.copy(ROOT / file, folder / "checkout")
            for file in ("_neuralsvcd.c", "_nsvcd_verify.c", "setup.py", "pyproject.toml", "README.md"):
                shutil.copy(HERE / file, sources)
            for package in ("neuralsvcd", "nsvcd_verify"):
                shutil.copytree(HERE / package, sources / package, ignore=shutil.ignore_patterns("__pycache__"))

            def run(*command: object, cwd: Path = folder, **variables: str) -> str:
                environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
                done = subprocess.run([str(word) for word in command], cwd=cwd, capture_output=True, text=True,
                                      env={**environment, **variables})
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                return done.stdout
            pip = ["-m", "pip", "--disable-pip-version-check"]
            run(sys.executable, "setup.py", "-q", "sdist", "-d", folder, cwd=sources)
            shutil.rmtree(folder / "checkout")
            archive, = folder.glob("*.tar.gz")
            run(sys.executable, *pip, "wheel", archive, "--no-deps", "--no-build-isolation", "--no-index", "-w", folder,
                CFLAGS="-O1")
            wheel, = folder.glob("*.whl")
            self.assertIn("-abi3-", wheel.name)
            names = zipfile.ZipFile(wheel).namelist()
            for part in ("neuralsvcd/__init__.py", "neuralsvcd/sweeps.py", "neuralsvcd/_urdf.py", "neuralsvcd/_neuralsvcd.abi3.so", "neuralsvcd/py.typed",
                         "nsvcd_verify/__init__.py", "nsvcd_verify/_nsvcd_verify.abi3.so", "nsvcd_verify/py.typed"):
                self.assertIn(part, names)
            self.assertTrue(any(part.endswith("LICENSE") for part in names))
            run(sys.executable, "-m", "venv", "--system-site-packages", "--without-pip", "own")
            python = folder / "own" / "bin" / "python"
            run(python, *pip, "install", "--no-deps", "--no-index", wheel)
            shutil.copy(ASSETS / "mug.obj", folder)
            run(python, "-c", "import neuralsvcd as n; assert n.Robot.from_urdf('arm.urdf').check([0] * 6).verdict == 'free'; "
                f"assert n.__version__ == {nsvcd.__version__!r}; assert '-{nsvcd.__version__}-' in {wheel.name!r}",
                cwd=shutil.copytree(HERE.parent / "robot", folder / "robot"))
            printed = run(python, "-c", "import nsvcd_verify, neuralsvcd as n; mug = n.Body('mug.obj');"
                          "print(n.__file__, n.sweep(mug, mug, [[0.01, 0, 0, 0, 0, 0, 1]]).verdict)")
            self.assertRegex(printed, rf"^{re.escape(str(folder.resolve() / 'own'))}/\S*neuralsvcd/__init__\.py hit\n$")


if __name__ == "__main__":
    unittest.main()
