"""What examples/robot/urdf.py writes is what the URDF says, as svcd answers it; the rest it refuses, by name.

    python3 tests/urdf_test.py            # from the repository's root; needs build/svcd and build/verify
"""
from __future__ import annotations

import contextlib
import importlib.util
import io
import itertools
import json
import math
import os
import struct
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
SCRIPT = os.path.join(ROOT, "examples", "robot", "urdf.py")
SPEC = importlib.util.spec_from_file_location("urdf", SCRIPT)
assert SPEC and SPEC.loader
URDF = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(URDF)
LIMIT = '<limit lower="-3" upper="3" velocity="1" effort="1"/>'
FACES = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))


def shape(text: str, origin: str = "") -> str:
    return f"<collision>{origin}<geometry>{text}</geometry></collision>"


def link(name: str, *inner: str) -> str:
    return f'<link name="{name}">{"".join(inner)}</link>'


def joint(name: str, parent: str, child: str, inner: str = LIMIT, kind: str = "revolute", axis: str = "0 0 1") -> str:
    return (f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
            f'<axis xyz="{axis}"/>{inner}</joint>')


def robot(*inner: str) -> str:
    return f'<robot name="r">{"".join(inner)}</robot>'


def box(size: str, at: str = "0 0 0", rpy: str = "0 0 0") -> str:
    return shape(f'<box size="{size}"/>', f'<origin xyz="{at}" rpy="{rpy}"/>')


CUBE = box("0.1 0.1 0.1")


def slider(*collisions: str) -> str:
    """A robot of one link, which its only joint moves along z."""
    return robot(link("base"), link("arm", *collisions), joint("j", "base", "arm", LIMIT, "prismatic"))


def block(low: tuple[float, ...], high: tuple[float, ...]) -> list[tuple[tuple[float, ...], ...]]:
    x, y, z = zip(low, high)
    corner = [(x[i], y[j], z[k]) for k in (0, 1) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
    return [(corner[f[0]], corner[f[k]], corner[f[k + 1]]) for f in FACES for k in (1, 2)]


def binary_stl(triangles: list[tuple[tuple[float, ...], ...]]) -> bytes:
    body = b"".join(struct.pack("<12fH", 0, 0, 0, *a, *b, *c, 0) for a, b, c in triangles)
    return bytes(80) + struct.pack("<I", len(triangles)) + body


def text_stl(triangles: list[tuple[tuple[float, ...], ...]]) -> str:
    corners = ("facet normal 0 0 0\nouter loop\n" + "".join("vertex %r %r %r\n" % p for p in t)
               + "endloop\nendfacet\n" for t in triangles)
    return "solid x\n" + "".join(corners) + "endsolid x\n"


def obj(triangles: list[tuple[tuple[float, ...], ...]]) -> str:
    points = "".join("v %r %r %r\n" % p for t in triangles for p in t)
    return points + "".join(f"f {3 * k + 1} {3 * k + 2} {3 * k + 3}\n" for k in range(len(triangles)))


class Urdf(unittest.TestCase):
    def setUp(self) -> None:
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = holder.name

    def file(self, name: str, content: str | bytes) -> str:
        path = os.path.join(self.folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as file:
            file.write(content.encode() if isinstance(content, str) else content)
        return path

    def svcd(self, *words: str, program: str = "svcd") -> tuple[int, str, str]:
        command = [os.path.join(ROOT, "build", program), *words]
        done = subprocess.run(command, capture_output=True, text=True, cwd=self.folder, check=False)
        return done.returncode, done.stdout, done.stderr

    def urdf(self, *words: str) -> tuple[int, str]:
        here = os.getcwd()
        said = io.StringIO()
        os.chdir(self.folder)
        try:
            with mock.patch.object(sys, "argv", ["urdf.py", *words]), contextlib.redirect_stderr(said):
                return URDF.main(), said.getvalue()
        finally:
            os.chdir(here)

    def convert(self, text: str, *options: str, name: str = "r.urdf") -> tuple[int, str]:
        self.file(name, text)
        return self.urdf(name, "out.txt", *options)

    def lines(self, text: str, *options: str) -> list[list[str]]:
        status, said = self.convert(text, *options)
        self.assertEqual((status, said if status else ""), (0, ""))
        with open(os.path.join(self.folder, "out.txt"), encoding="utf-8") as file:
            return [line.split() for line in file]

    def refused(self, said: str, text: str, *options: str) -> None:
        status, message = self.convert(text, *options)
        self.assertEqual(status, 1, message)
        self.assertRegex(message, said)

    def verdicts(self, text: str, scenes: list[str], *rows: str, options: tuple[str, ...] = ()) -> list[str]:
        """Of a path of the robot in each scene; `refused` where either program says no."""
        words = list(options)
        for k, scene in enumerate(scenes):
            words += ["--scene", f"s{k}", self.file(f"s{k}.urdf", scene)]
        status, self.said = self.convert(text, *words)
        if status:
            return ["refused"] * len(scenes)
        with open(os.path.join(self.folder, "out.txt"), "a", encoding="utf-8") as file:
            for k in range(len(scenes)):
                file.write(f"path p s{k} {len(rows)}\n" + "\n".join(rows) + "\n")
        status, out, self.said = self.svcd("path", "out.txt")
        return ["refused"] * len(scenes) if status else [line.split("\t")[1] for line in out.splitlines()]

    def verdict(self, text: str, scene: str, *rows: str) -> str:
        return self.verdicts(text, [scene], *rows)[0]

    def hits(self, text: str, points: list[tuple[float, ...]], options: tuple[str, ...] = ()) -> list[bool]:
        """Is a cube of 2 mm at each of these in the robot, where all joints are at 0?"""
        scenes = [robot(link("probe", box("0.002 0.002 0.002", "%r %r %r" % point))) for point in points]
        found = self.verdicts(text, scenes, "0", "0", options=options)
        self.assertLessEqual(set(found), {"hit", "free"}, self.said)
        return [verdict == "hit" for verdict in found]


class Meshes(Urdf):
    def test_urdf_no_mesh_is_lost(self) -> None:
        """Kinds of files of one block: taken for what they are, or refused with the link's name."""
        triangles = block((-0.1, -0.1, -0.1), (0.1, 0.1, 0.1))
        binary, text = binary_stl(triangles), text_stl(triangles)
        good = {"a.stl": binary, "tail.stl": binary + b"\n", "b.STL": text, "upper.stl": text.upper(),
                "cr.stl": text.replace("\n", "\r\n"),
                "a.obj": obj(triangles), "quads.obj": "".join("v %r %r %r\n" % p for p in
                                                               itertools.product((-0.1, 0.1), repeat=3)) +
                "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n"}
        good["a.ply"] = ("ply\nformat ascii 1.0\nelement vertex 36\nproperty float x\nproperty float y\nproperty float z\n"
                         "element face 12\nproperty list uchar int vertex_indices\nend_header\n"
                         + "".join("%r %r %r\n" % p for t in triangles for p in t)
                         + "".join(f"3 {k} {k + 1} {k + 2}\n" for k in range(0, 36, 3)))
        bad = {"lfs.stl": "version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 1\n",
               "lfs.obj": "version https://git-lfs.github.com/spec/v1\n",
               "page.stl": "<!DOCTYPE html><html></html>", "page.obj": "\n<html>404</html>", "short.stl": binary[:-60],
               "cut.stl": binary[:70], "empty.stl": "", "empty.obj": "",
               "utf16.obj": obj(triangles).encode("utf-16"), "utf16.stl": text.encode("utf-16"),
               "points.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\n",
               "lines.obj": "v 0 0 0\nv 1 0 0\nl 1 2\n", "words.stl": "solid x\nendsolid x\n", "x.dae": "<COLLADA/>",
               "x.step": "ISO-10303-21;", "index.obj": "v 0 0 0\nf 1 2 3\n"}
        wall = robot(link("wall", box("0.5 0.5 0.1", "0 0 0.5")))
        for name, content in {**good, **bad}.items():
            self.file(name, content)
            text = slider(shape(f'<mesh filename="{name}"/>'))
            with self.subTest(name):
                self.assertEqual(self.verdict(text, wall, "0", "1"), "hit" if name in good else "refused")
                self.assertTrue(name in good or f"arm: {name}:" in self.said, self.said)
                scene = robot(link("post", shape(f'<mesh filename="{name}"/>', '<origin xyz="0 0 0.5"/>')))
                self.assertEqual(self.verdict(slider(CUBE), scene, "0", "1"), "hit" if name in good else "refused")
        self.refused(r"r.urdf: link arm: none.stl: No such file", slider(shape('<mesh filename="none.stl"/>')))

    def test_urdf_meshes_lie_where_they_should(self) -> None:
        """A block, scaled, mirrored, turned and moved, behind a fixed joint: probes just inside and outside of each face."""
        low, high = (0.1, 0.2, -0.1), (0.4, 0.3, 0.2)
        self.file("m.stl", binary_stl(block(low, high)))
        for scale in ((1, 1, 1), (0.5, 2, 1), (-1, 1, 1), (-0.5, -1, 2), (-1, -1, -1)):
            words = "%r %r %r" % scale
            text = robot(link("base"), link("arm"), link("tool", shape(f'<mesh filename="m.stl" scale="{words}"/>',
                                                                       '<origin xyz="0 0.1 0" rpy="0 0 0.7"/>')),
                         joint("j", "base", "arm"), joint("f", "arm", "tool", '<origin xyz="0.3 0 0.2" rpy="1.5707963267948966 0 0"/>',
                                                          "fixed"))
            ends = [sorted((a * s, b * s)) for a, b, s in zip(low, high, scale)]
            middle = [(a + b) / 2 for a, b in ends]
            probes, expected = [], []
            for axis, side, out in itertools.product(range(3), (0, 1), (-1, 1)):
                p = list(middle)
                p[axis] = ends[axis][side] + (0.003 if side else -0.003) * out
                x, y, z = p[0] * math.cos(0.7) - p[1] * math.sin(0.7), p[0] * math.sin(0.7) + p[1] * math.cos(0.7) + 0.1, p[2]
                probes.append((x + 0.3, -z, y + 0.2))  # a quarter turn about x: y to z, z to -y
                expected.append(out < 0)
            with self.subTest(scale=scale):
                self.assertEqual(self.hits(text, probes), expected)

    def test_urdf_certificates_of_scaled_meshes(self) -> None:
        self.file("m.stl", binary_stl(block((0, 0, 0), (100, 50, 20))))
        os.makedirs(os.path.join(self.folder, "proof"))
        self.file("s.urdf", robot(link("post", shape('<mesh filename="m.stl" scale="0.001 -0.001 0.001"/>', '<origin xyz="0 -0.2 0"/>'))))
        status, said = self.convert(slider(shape('<mesh filename="m.stl" scale="-0.001 0.001 0.002"/>', '<origin rpy="0.3 0 0"/>')),
                                    "--scene", "s", "s.urdf")
        self.assertEqual(status, 0, said)
        with open(os.path.join(self.folder, "out.txt"), "a", encoding="utf-8") as file:
            file.write("plan p s 0 0.5\n")
        _, out, said = self.svcd("plan", "out.txt", "--certificates", "proof")
        self.assertIn("\tcertified\t", out, said)
        status, out, said = self.svcd("out.txt", "proof", program="verify")
        self.assertEqual((status, out.split("\t")[1:3]), (0, ["accepted", "free"]), said)

    def test_urdf_concave_faces(self) -> None:
        """An L of faces of six corners, however they begin and are told: its notch is free, its arms are not."""
        points = "".join(f"v {x} {y} {z}\n" for z in (0, 0.1) for x, y in ((0, 0), (0.3, 0), (0.3, 0.05), (0.05, 0.05), (0.05, 0.3),
                                                                           (0, 0.3)))
        sides = "".join(f"f {k} {k % 6 + 1} {k % 6 + 7} {k + 6}\n" for k in range(1, 7))
        files: dict[str, str] = {}
        for k in range(6):
            ends = [[(k - i) % 6 + 1 for i in range(6)], [(k + i) % 6 + 7 for i in range(6)]]
            files[f"from{k}.obj"] = points + "".join("f %d %d %d %d %d %d\n" % tuple(end) for end in ends) + sides
        files["negative.obj"] = points + "f -12 -7 -8 -9 -10 -11\nf 7 8 9 10 11 12\n" + sides
        files["before.obj"] = "f 6 5 4 3 2 1\nf 7 8 9 10 11 12\n" + sides + points
        files["continued.obj"] = points + "f 6 5 4 \\\n 3 2 1\nf 7 8 9 10 \\\n11 12\n" + sides
        for name, content in files.items():
            self.file(name, content)
            text = slider(shape(f'<mesh filename="{name}"/>'))
            scenes = [robot(link("post", box("0.01 0.01 0.02", at + " 0.2"))) for at in ("0.15 0.15", "0.06 0.06", "0.15 0.025",
                                                                                         "0.025 0.25")]
            with self.subTest(name):
                self.assertEqual(self.verdicts(text, scenes, "0", "0.3"), ["free", "free", "hit", "hit"])

    def test_urdf_packages(self) -> None:
        self.file("x/my_robot/meshes/a.stl", binary_stl(block((0, 0, 0), (0.1, 0.1, 0.1))))
        mesh = slider(shape('<mesh filename="package://my_robot/meshes/a.stl"/>'))
        for place in ("x/my_robot/urdf/deep/r.urdf", "x/my_robot/r.urdf", "x/r.urdf", "x/other/urdf/r.urdf"):
            with self.subTest(place):
                self.assertEqual(self.convert(mesh, name=place)[0], 0)
                with open(os.path.join(self.folder, "out.txt"), encoding="utf-8") as file:
                    self.assertIn("body arm j x/my_robot/meshes/a.stl\n", file.read())
        self.refused(r"link arm: package://my_robot/meshes/a.stl: .*--package my_robot=", mesh)
        self.assertEqual(self.convert(mesh, "--package", "my_robot=x/my_robot")[0], 0)
        self.file("x/checkout/package.xml", "<package><name>my_robot2</name></package>")
        self.file("x/checkout/a.stl", binary_stl(block((0, 0, 0), (0.1, 0.1, 0.1))))
        self.assertEqual(self.convert(slider(shape('<mesh filename="package://my_robot2/a.stl"/>')), name="x/checkout/urdf/r.urdf")[0], 0)
        self.refused("only files", slider(shape('<mesh filename="http://x/a.stl"/>')))
        path = self.file("a b.stl", binary_stl(block((0, 0, 0), (0.1, 0.1, 0.1))))
        self.refused("a b.stl: a planning file cannot name it", slider(shape(f'<mesh filename="file://{path}"/>')))


class Shapes(Urdf):
    def test_urdf_simple_shapes(self) -> None:
        """All of a link's collision elements, each where it is: probes inside and outside of it."""
        text = slider(box("0.2 0.1 0.1", "0 0 1"), shape('<cylinder radius="0.1" length="0.4"/>',
                                                         '<origin xyz="1 0 0" rpy="0 1.5707963 0"/>'),
                      shape('<sphere radius="0.2"/>', '<origin xyz="0 1 0"/>'), shape('<capsule radius="0.1" length="0.2"/>',
                                                                                      '<origin xyz="0 -1 0"/>'))
        probes = (((0.098, 0, 1), 1), ((0.102, 0, 1), 0), ((0, 0.052, 1), 0), ((1.198, 0, 0), 1), ((1.202, 0, 0), 0), ((1, 0, 0.098), 1),
                  ((1, 0, 0.102), 0),
                             ((1.07, 0.073, 0.073), 0), ((0, 0.802, 0), 1), ((0, 0.798, 0), 0), ((0, 1, 0.202), 0), ((0, 1, 0.198), 1),
                             ((0, -1, 0.198), 1), ((0, -1, -0.202), 0), ((0.098, -1, 0.1), 1))
        self.assertEqual(self.hits(text, [at for at, _ in probes]), [bool(expected) for _, expected in probes])

    def test_urdf_round_is_inside_of_its_mesh(self) -> None:
        """No plane of a side cuts the true shape, by its support; and no corner is far outside."""
        for radius, length, finest in ((0.05, 0.2, None), (0.5, 0.1, 1e-4), (0.01, 1, 1e-5), (3.0, 3.0, None)):
            sides = URDF.sides_of(radius, finest)
            far = 0.005 * radius if finest is None else 1.01 * finest
            kinds = {"cylinder": (URDF.cylinder(radius, length, sides), length / 2, 0.0),
                     "capsule": (URDF.capsule(radius, length, sides), length / 2, radius),
                     "sphere": (URDF.capsule(radius, 0, sides), 0.0, radius)}
            for name, (triangles, half, ball) in kinds.items():
                with self.subTest(name, radius=radius):
                    volume = 0.0
                    for a, b, c in triangles:
                        u, v = ([q - p for p, q in zip(a, end)] for end in (b, c))
                        n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
                        size = math.hypot(*n)
                        side = math.hypot(n[0], n[1]) / size
                        # how far the true shape goes along the normal
                        support = half * abs(n[2]) / size + (ball if ball else radius * side)
                        offset = sum(p * q for p, q in zip(a, n)) / size
                        volume += offset * size / 6
                        self.assertGreater(offset, support - 1e-9 * (radius + length))
                        for p in (a, b, c):
                            beyond = math.hypot(p[0], p[1], max(0.0, abs(p[2]) - half)) if ball else math.hypot(p[0], p[1])
                            self.assertLess(beyond, radius + (2 if ball else 1) * far)
                    true = math.pi * radius ** 2 * 2 * half + math.pi * 4 / 3 * ball ** 3
                    self.assertLess(true, volume)
                    self.assertLess(volume, 1.02 * true)
                    edges = [(t[k], t[(k + 1) % 3]) for t in triangles for k in range(3)]
                    self.assertEqual(sorted(edges), sorted((b, a) for a, b in edges), "it is not closed")

    def test_urdf_cylinders_pass(self) -> None:
        """Two, side by side, 0.3 mm apart, that turn about the line between them."""
        drum = shape('<cylinder radius="0.05" length="0.2"/>')
        for gap, expected in ((0.0003, "free"), (-0.0003, "hit")):
            text = robot(link("base"), link("a", drum), link("b", drum), joint("ja", "base", "a", axis="0 1 0"),
                         joint("jb", "base", "b", f'<origin xyz="0 {0.1 + gap} 0"/>' + LIMIT, axis="0 1 0"))
            self.assertEqual(self.verdict(text, robot(), "-1 1", "1 -1"), expected)
            turned = text.replace('axis xyz="0 1 0"', 'axis xyz="0 0 1"')  # now corner against corner as well
            self.assertEqual(self.verdicts(turned, [robot()], "-1 1", "1 -1", options=("--round", "1e-4"))[0], expected)

    def test_urdf_boxes_side_by_side_enclose(self) -> None:
        """Two that share a face, and one whose edges lie on those of another: what is within is hit."""
        text = slider(box("0.2 0.2 0.2", "-0.1 0 0"), box("0.2 0.2 0.2", "0.1 0 0"), box("0.2 0.2 0.2", "0.1 0.2 0.2"))
        probes = [(-0.1, 0, 0), (0.1, 0, 0), (0.1, 0.2, 0.2), (-0.1, 0.2, 0.2)]
        self.assertEqual(self.hits(text, probes), [True, True, True, False])

    def test_urdf_names_of_files(self) -> None:
        """No body's file is another's: not in letter case, not across scenes; no input is written over."""
        self.file("s.urdf", robot(link("c", box("0.2 0.2 0.2", "9 0 0"))))
        lines = self.lines(robot(link("base"), link("s_c", CUBE), link("S_C", CUBE), link("s/c", CUBE), joint("j", "base", "s_c"),
                                 joint("k", "base", "S_C"),
                                 joint("l", "base", "s/c")), "--scene", "s", "s.urdf")
        files = [line[3] if line[0] == "body" else line[2] for line in lines if line[0] in ("body", "obstacle")]
        self.assertEqual(len({name.lower() for name in files}), 4)
        for name in files:
            self.assertTrue(os.path.isfile(os.path.join(self.folder, name)))
        self.file("out_arm.obj", obj(block((0, 0, 0), (0.1, 0.1, 0.1))))
        self.refused("out_arm.obj: it would be written over", robot(link("base", shape('<mesh filename="out_arm.obj"/>')),
                                                                    link("arm", CUBE), joint("j", "base", "arm")))
        self.file("r.urdf", slider(CUBE))
        status, said = self.urdf("r.urdf", "r.urdf")
        self.assertEqual(status, 1)
        self.assertIn("it would be written over", said)

    def test_urdf_old_output_goes(self) -> None:
        """What is refused leaves no planning file of an earlier run, which svcd would answer."""
        self.lines(slider(CUBE))
        self.refused("size", slider(box("0 1 1")))
        self.assertFalse(os.path.exists(os.path.join(self.folder, "out.txt")))


class Refusals(Urdf):
    def test_urdf_refuses_files(self) -> None:
        base, arm, good = link("base"), link("arm", CUBE), joint("j", "base", "arm")
        xacro = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:include filename="x"/></robot>'
        for said, text in (
                ("this is xacro", xacro),
                ("this is xacro", slider(box("${a} 1 1"))),
                ("this is xacro", slider(shape('<mesh filename="$(find x)/a.stl"/>'))),
                ("no link", robot()),
                ("no XML", "<robot"),
                ("begins with <sdf>", "<sdf/>"),
                ("no joint that moves", robot(arm)),
                ("no collision element", robot(base, link("arm"), good)),
                ("robot r: what is <Link>", robot(base, arm, good, "<Link/>")),
                ("two links named arm", robot(base, arm, arm, good)),
                ("two joints named j", robot(base, arm, link("b"), good, joint("j", "arm", "b"))),
                ("joint k: arm is the child of j already", robot(base, arm, good, joint("k", "base", "arm"))),
                ("joint j: its child, x, is no link", robot(base, arm, joint("j", "base", "x"))),
                ("joint j: its parent, x, is no link", robot(base, arm, joint("j", "x", "arm"))),
                ("no joint reaches the link b", robot(base, arm, link("b", CUBE), good)),
                ("link arm: joints go round", robot(base, arm, link("b"), joint("j", "b", "arm"), joint("k", "arm", "b"))),
                ("a link named 'a b'", robot(base, link("a b"))),
                ("a link named 'a#b'", robot(base, link("a#b"))),
                ("a link named ''", robot(base, "<link/>")),
                ("a joint named 'world'", robot(base, arm, joint("world", "base", "arm")))):
            with self.subTest(said):
                self.refused("r.urdf: " + said, text)

    def test_urdf_refuses_shapes(self) -> None:
        self.file("m.stl", binary_stl(block((0, 0, 0), (1, 1, 1))))
        for said, inner in (
                ("a <geometry> of 2 shapes", shape('<box size="1 1 1"/><sphere radius="1"/>')),
                (".*more than one <geometry>", "<collision><geometry/><geometry/></collision>"),
                ("no <geometry>", "<collision/>"),
                (".*<ellipsoid>", shape('<ellipsoid radii="1 1 1"/>')),
                (".*<capsule>", shape('<d:capsule xmlns:d="x"/>')),
                (".*more than one <origin>", shape('<box size="1 1 1"/>', "<origin/><origin/>")),
                (".*<colision>", "<colision/>"),
                (".*attribute quat_xyzw", shape('<box size="1 1 1"/>', '<origin quat_xyzw="0 0 0 1"/>')),
                *((".*size", box(size)) for size in ("1 1", "", "1 0 1", "1 -1 1", "1 1 1 1")),
                *((".*xyz", box("1 1 1", at)) for at in ("0,0,0", "nan 0 0", "1e999 0 0", "1_0 0 0", "", "0 0 0x1")),
                (".*rpy", box("1 1 1", "0 0 0", "0 0")),
                (".*radius", shape('<sphere radius="-1"/>')),
                (".*radius", shape('<sphere radius="1e12"/>')),
                (".*radius", shape("<sphere/>")),
                (".*length", shape('<cylinder radius="1" length="0"/>')),
                (".*length", shape('<capsule radius="1"/>')),
                (".*filename", shape("<mesh/>")),
                (".*scale", shape('<mesh filename="m.stl" scale="1"/>')),
                (".*scale", shape('<mesh filename="m.stl" scale="1 0 1"/>'))):
            with self.subTest(said, inner=inner):
                self.refused("r.urdf: link arm: " + said, slider(inner))

    def test_urdf_refuses_joints(self) -> None:
        for said, kind, inner in (
                ("it is 'floating'.*--fixed j", "floating", ""),
                ("it is 'planar'.*--fixed j", "planar", ""),
                ("it is 'hinge'", "hinge", ""),
                ("no limits", "revolute", ""),
                ("no limits", "prismatic", '<limit velocity="1" effort="1"/>'),
                ("its lower limit", "revolute", '<limit lower="1" upper="-1" velocity="1"/>'),
                (".*lower=.nan", "revolute", '<limit lower="nan" upper="1" velocity="1"/>'),
                ("its velocity is 0.*--velocity", "revolute", '<limit lower="-1" upper="1" velocity="0"/>'),
                ("its velocity is 0.*--velocity", "continuous", '<limit velocity="0"/>'),
                ("its velocity is -1", "revolute", '<limit lower="-1" upper="1" velocity="-1"/>'),
                (".*acceleration", "revolute", '<limit lower="-1" upper="1" velocity="1" acceleration="0"/>'),
                (".*attribute jerk", "revolute", '<limit lower="-1" upper="1" velocity="1" jerk="1"/>'),
                (".*more than one <axis>", "revolute", LIMIT + '<axis xyz="1 0 0"/>'),
                (".*<spring>", "revolute", LIMIT + "<spring/>")):
            with self.subTest(said, kind=kind):
                self.refused("r.urdf: joint j: " + said, robot(link("base"), link("arm", CUBE), joint("j", "base", "arm", inner, kind)))
        for axis in ("0 0 0", "0 0", "z"):
            self.refused("r.urdf: joint j: .*axis", robot(link("base"), link("arm", CUBE), joint("j", "base", "arm", axis=axis)))

    def test_urdf_says_what_may_be_left_out(self) -> None:
        spring = slider(CUBE).replace("<axis", "<spring k='1'/><axis")
        self.refused("--ignore spring", spring)
        self.assertEqual(self.convert(spring, "--ignore", "spring")[0], 0)
        status, said = self.convert(robot(link("base"), link("arm", CUBE), link("hood", "<visual/>"), joint("j", "base", "arm"),
                                          joint("f", "arm", "hood", "", "fixed")))
        self.assertEqual(status, 0)
        self.assertRegex(said, "warning: .*without a collision element.*: hood")
        known = slider(CUBE, "<inertial/>", "<visual><x/></visual>")
        known = known.replace("</robot>", '<gazebo><y/></gazebo><transmission name="t"/><material name="m"/></robot>')
        self.assertEqual(self.convert(known), (0, ""))

    def test_urdf_of_another_namespace(self) -> None:
        lines = self.lines(slider(CUBE).replace("<robot", '<robot xmlns="http://www.ros.org"'))
        self.assertEqual([line[0] for line in lines], ["nsvcd-plans", "joint", "body"])


class Joints(Urdf):
    def test_urdf_mimic_follows_or_is_held(self) -> None:
        """Fingers that close together: held half way they leave 2 cm between them."""
        finger = box("0.02 0.02 0.1", "0 0 0.55")
        limit = '<limit lower="0" upper="0.06" velocity="1" effort="1"/>'
        text = robot(link("base"), link("hand"), link("l", finger), link("r", finger), joint("j", "base", "hand", kind="prismatic"),
                     joint("jl", "hand", "l", '<origin xyz="0.05 0 0"/>' + limit, "prismatic", "-1 0 0"),
                     joint("jr", "hand", "r", '<origin xyz="-0.05 0 0"/>' + limit + '<mimic joint="jl" multiplier="1.5" offset="-0.015"/>',
                           "prismatic", "2 0 0"))
        lines = [" ".join(line) for line in self.lines(text)]
        self.assertIn("mimic jr jl 1.5 -0.015", lines)
        # chains come down to the one that moves; what is no factor is a joint that stands
        chain = text.replace('mimic joint="jl" multiplier="1.5"', 'mimic joint="jk" multiplier="3"').replace(
            "</robot>", link("k", finger) + joint("jk", "hand", "k", LIMIT + '<mimic joint="jl" multiplier="0.5" offset="0.1"/>', "prismatic")
            + "</robot>")
        lines = [" ".join(line) for line in self.lines(chain)]
        self.assertIn("mimic jk jl 0.5 0.1", lines)
        self.assertIn(f"mimic jr jl 1.5 {repr(3 * 0.1 - 0.015)}", lines)
        self.assertNotIn("jr", sum(self.lines(text.replace('"1.5" offset="-0.015"', '"0" offset="0.02"')), []))
        self.refused("joint jr: it mimics jl, 1e-09 times", text.replace("1.5", "1e-9"))
        turning = robot(link("base"), link("a", CUBE), link("b", CUBE), joint("ja", "base", "a", "", "continuous"),
                        joint("jb", "base", "b", '<mimic joint="ja" multiplier="-2"/>', "continuous"))
        self.assertIn(["mimic", "jb", "ja", "-2", "0"], self.lines(turning, "--velocity", "1"))
        self.refused("joint jb: it mimics ja, which is continuous like it, 2.5 times", turning.replace("-2", "2.5"), "--velocity", "1")
        held = ("--fixed", "jl=0.03")
        probes = [(x, 0, 0.55) for x in (0.012, 0.028, 0.032, 0.008, -0.008, -0.012, -0.028, -0.032)]
        self.assertEqual(self.hits(text, probes, held), [True, True, False, False, False, True, True, False])
        self.refused("joint jl: held at 0.1, which is not within its limits", text, "--fixed", "jl=0.1")
        self.refused("joint jr: held at -0.015", text, "--fixed", "jl")
        self.refused("--fixed x: there is no such joint", text, *held, "--fixed", "x")
        self.refused("joint jr: it mimics no, which is no joint", text.replace('mimic joint="jl"', 'mimic joint="no"'))
        self.refused("joint j.: it mimics", text.replace(limit, limit + '<mimic joint="jr"/>', 1))

    def test_urdf_joints_are_held(self) -> None:
        text = robot(link("base"), link("arm"), link("tip", box("0.02 0.02 0.02", "1 0 0")), joint("j", "base", "arm", kind="prismatic"),
                     joint("k", "arm", "tip", '<origin xyz="0 0 0.5" rpy="0 0 1"/>' + LIMIT, axis="0 0 -2"))
        at = [(math.cos(a), math.sin(a), 0.5) for a in (0.6, 1)]
        floating = text.replace('name="k" type="revolute"', 'name="k" type="floating"')
        self.assertEqual(self.hits(text, at, ("--fixed", "k=0.4")), [True, False])
        self.assertEqual(self.hits(text, at, ("--fixed", "k")), [False, True])
        self.assertEqual(self.hits(floating, at, ("--fixed", "k")), [False, True])
        self.refused("joint k: it is 'floating', and stands", floating, "--fixed", "k=1")

    def test_urdf_limits(self) -> None:
        def ends(inner: str, *options: str, kind: str = "revolute") -> list[float]:
            lines = self.lines(robot(link("base"), link("arm", CUBE), joint("j", "base", "arm", inner, kind)), *options)
            return [float(word) for word in lines[1][14:]]
        self.assertEqual(ends('<limit lower="-2.718281828459045" upper="1" velocity="2" acceleration="5"/>'), [-2.718281828459045, 1, 2, 5])
        self.assertEqual(ends('<limit upper="1" velocity="2"/>')[:3], [0, 1, 2])
        soft = '<safety_controller soft_lower_limit="-1" soft_upper_limit="3" k_velocity="1"/>'
        self.assertEqual(ends('<limit lower="-2" upper="1" velocity="2"/>' + soft)[:3], [-1, 1, 2])
        self.assertEqual(ends('<limit lower="-2" upper="1" velocity="2"/><safety_controller k_velocity="1"/>')[:2], [-2, 1])
        self.assertEqual(ends('<limit lower="-2" upper="1" velocity="0"/>', "--velocity", "0.5")[2], 0.5)
        self.assertEqual(ends('<limit lower="-2" upper="1"/>', "--velocity", "0.5")[2], 0.5)
        self.assertEqual(ends('<limit lower="-2" upper="1" velocity="2"/>', "--velocity", "0.5")[2], 2)
        self.assertEqual(ends("", kind="continuous")[2], 1)
        self.assertIn("warning: joint j: no velocity", self.convert(robot(link("base"), link("arm", CUBE),
                                                                          joint("j", "base", "arm", "", "continuous")))[1])


class Others(Urdf):
    """What is optional: xacro and pycollada, by programs and modules that stand for them."""

    def test_urdf_runs_xacro(self) -> None:
        self.file("made.urdf", slider(CUBE))
        self.file("bin/xacro", '#!/bin/sh\ngrep -q broken "$1" && { echo one >&2; echo "no such macro" >&2; exit 2; }\n'
                               'grep -q again "$1" && cat "$1" || cat made.urdf\n')
        os.chmod(os.path.join(self.folder, "bin", "xacro"), 0o755)
        xacro = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:include filename="%s"/></robot>'
        with mock.patch.dict(os.environ, {"PATH": os.path.join(self.folder, "bin") + os.pathsep + os.environ["PATH"]}):
            self.assertEqual([line[0] for line in self.lines(xacro % "x")], ["nsvcd-plans", "joint", "body"])
            self.refused("r.urdf: xacro: no such macro", xacro % "broken")
            self.refused("r.urdf: this is xacro, and so is what xacro makes of it", xacro % "again")
        with mock.patch.dict(os.environ, {"PATH": self.folder}):
            self.refused("r.urdf: this is xacro, .*pip install xacro", xacro % "x")

    def test_urdf_converts_dae(self) -> None:
        """A block in millimetres, in two pieces that share corners: welded, scaled, mirrored, where it should be."""
        triangles = block((100, 200, -100), (400, 300, 200))
        kinds = {name: type(name, (), {}) for name in ("BoundTriangleSet", "BoundPolylist", "BoundLineSet")}

        def primitive(kind: str, part: list[tuple[tuple[float, ...], ...]]) -> object:
            made = kinds[kind]()
            made.vertex = [p for t in part for p in t]
            made.vertex_index = [(3 * k, 3 * k + 1, 3 * k + 2) for k in range(len(part))]
            made.triangleset = lambda: primitive("BoundTriangleSet", part)
            return made

        def collada(axis: str, skins: list[object], *primitives: object) -> mock.Mock:
            dae = mock.Mock()
            dae.assetInfo.unitmeter, dae.assetInfo.upaxis = 0.001, axis
            dae.scene.objects = lambda what: iter(skins if what == "controller" else [mock.Mock(primitives=lambda: iter(primitives))])
            module = mock.Mock(DaeError=type("DaeError", (Exception,), {}))
            module.Collada = lambda path: dae
            return module

        pieces = primitive("BoundTriangleSet", triangles[:5]), primitive("BoundPolylist", triangles[5:]), primitive("BoundLineSet", [])
        self.file("m.dae", "<COLLADA/>")
        mesh = shape('<mesh filename="m.dae" scale="-1 1 1"/>', '<origin xyz="0 0 0.5"/>')
        with mock.patch.dict(sys.modules, {"collada": collada("Z_UP", [], *pieces)}):
            lines = self.lines(slider(CUBE, mesh))
            self.assertEqual([line[1:] for line in lines if line[0] == "body"], [["arm", "j", "out_arm.obj"], ["arm.2", "j", "out_arm.2.obj"]])
            status, said, _ = self.svcd("info", "out_arm.2.obj", "--json")
            self.assertEqual(status, 0)
            facts = json.loads(said)
            self.assertEqual((facts["triangles"], facts["vertices"], facts["components"], facts["closed"], facts["wrong"]), (12, 8, 1, 1, []))
            for name, expected in (("low", (-0.4, 0.2, 0.4)), ("high", (-0.1, 0.3, 0.7))):
                for a, b in zip(facts[name], expected):
                    self.assertAlmostEqual(a, b, places=6)
            self.assertAlmostEqual(facts["volume"], 0.3 * 0.1 * 0.3, places=7)
        with mock.patch.dict(sys.modules, {"collada": collada("Y_UP", [], *pieces)}):
            self.assertIn("m.dae: Y_UP: its axes stay", self.convert(slider(mesh))[1])
        with mock.patch.dict(sys.modules, {"collada": collada("Z_UP", ["skin"], *pieces)}):
            self.refused("link arm: m.dae: a DAE with a skin", slider(mesh))
        with mock.patch.dict(sys.modules, {"collada": collada("Z_UP", [])}):
            self.refused("link arm: m.dae: no triangles", slider(mesh))
        with mock.patch.dict(sys.modules, {"collada": None}):
            self.refused("link arm: m.dae: a DAE: `pip install pycollada`", slider(mesh))


class Pairs(Urdf):
    CHAIN = (link("base", CUBE), link("a", CUBE), link("b", CUBE), link("c", CUBE), joint("j1", "base", "a"), joint("j2", "a", "b"),
             joint("j3", "b", "c"))

    def pairs(self, text: str, srdf: str | None = None, *options: str) -> set[frozenset[str]]:
        if srdf is not None:
            self.file("r.srdf", f'<robot name="r">{srdf}</robot>')
            options += ("--srdf", "r.srdf")
        return {frozenset(line[1:]) for line in self.lines(text, *options) if line[0] == "pair"}

    def test_urdf_srdf(self) -> None:
        text = robot(*self.CHAIN)
        ac, ab, basec, baseb = (frozenset(names) for names in (("a", "c"), ("a", "b"), ("base", "c"), ("base", "b")))
        self.assertEqual(self.pairs(text), {ac, basec, baseb})
        self.assertEqual(self.pairs(text, '<disable_collisions link1="c" link2="a" reason="Never"/>'), {basec, baseb})
        self.assertEqual(self.pairs(text, '<disable_default_collisions link="c"/>'), {baseb})
        self.assertEqual(self.pairs(text, '<disable_default_collisions link="c"/><enable_collisions link1="a" link2="c"/>'), {baseb, ac})
        self.assertEqual(self.pairs(text, '<enable_collisions link1="a" link2="b"/><group name="g"><joint name="j1"/></group>'),
                         {ac, basec, baseb, ab})
        for said, srdf in (("disabled, and enabled", '<enable_collisions link1="a" link2="b"/><disable_collisions link1="b" link2="a"/>'),
                           ("no link2", '<disable_collisions link1="a"/>'),
                           ("what is <disable_collision>", '<disable_collision link1="a" link2="c"/>'),
                           ("passive_joint j2.*--fixed j2", '<passive_joint name="j2"/>'),
                           ("virtual_joint v.*--fixed v", '<virtual_joint name="v" type="floating" parent_frame="w" child_link="base"/>'),
                           ("this is xacro", '<group name="${x}"/>')):
            self.file("r.srdf", f'<robot name="r">{srdf}</robot>')
            with self.subTest(said):
                self.refused("r.srdf: .*" + said, text, "--srdf", "r.srdf")
        self.assertEqual(len(self.pairs(text, '<passive_joint name="j2"/><virtual_joint name="v" type="planar"/>', "--fixed", "j2",
                                        "--fixed", "v")), 3)
        self.file("r.srdf", '<robot name="other"><disable_collisions link1="a" link2="x"/></robot>')
        self.assertRegex(self.convert(text, "--srdf", "r.srdf")[1], "(?s)it is of 'other'.*no link x")
        self.file("r.srdf", '<robot name="r"><passive_joint name="y"/></robot>')
        self.assertIn("passive_joint: no joint y", self.convert(text, "--srdf", "r.srdf")[1])

    def test_urdf_srdf_of_svcd_pairs(self) -> None:
        """With what `svcd pairs --srdf` writes, just those pairs are asked that it does not prove: of the example, and of
        links of several bodies, of which one alone meets what is beside it."""
        with open(os.path.join(ROOT, "examples", "robot", "arm.urdf"), encoding="utf-8") as file:
            arm = file.read()
        self.file("far.obj", obj(block((0.9, -0.05, -0.05), (1.0, 0.05, 0.05))))
        self.file("near.obj", obj(block((0.3, -0.05, -0.05), (0.4, 0.05, 0.05))))
        both = shape('<mesh filename="far.obj"/>') + shape('<mesh filename="near.obj"/>')
        names = robot(link("base"), link("post&amp;co", box("0.1 0.1 0.1", "0.95 0 0")), link("arm", CUBE, both), link("tip", both),
                      joint("j", "base", "arm"), joint("k", "arm", "tip", '<origin xyz="0 0 0.5"/>' + LIMIT),
                      joint("f", "base", "post&amp;co", "", "fixed"))
        for text in (arm, names):
            self.pairs(text)
            status, out, said = self.svcd("pairs", "out.txt", "--srdf", "r.srdf", "--json")
            self.assertEqual((status, said), (0, ""))
            proven: dict[frozenset[str], bool] = {}
            for answer in map(json.loads, out.splitlines()):
                links = frozenset(answer[key].removesuffix(".2").removesuffix(".3") for key in "ab")
                proven[links] = proven.get(links, True) and answer["kind"] in ("never", "always")
            self.assertGreater(sum(proven.values()), 0)
            found = {frozenset(name.removesuffix(".2").removesuffix(".3") for name in pair)
                     for pair in self.pairs(text, None, "--srdf", "r.srdf")}
            self.assertEqual(found, {links for links, is_proven in proven.items() if not is_proven})
        self.assertIn(frozenset(("arm", "post&co")), found)
        self.assertNotIn(frozenset(("arm", "tip")), found)

    def test_urdf_groups(self) -> None:
        """Of joints, links, chains and groups, in the order of the joints; what is held is in none."""
        text = robot(*self.CHAIN)

        def groups(srdf: str, *options: str) -> dict[str, list[str]]:
            self.file("r.srdf", f'<robot name="r">{srdf}</robot>')
            lines = self.lines(text, "--srdf", "r.srdf", *options)
            return {line[1]: line[2:] for line in lines if line[0] == "group"}

        inner = '<group name="in"><joint name="j3"/><joint name="j1"/></group>'
        self.assertEqual(groups(inner), {"in": ["j1", "j3"]})
        self.assertEqual(groups(inner, "--fixed", "j1"), {"in": ["j3"]})
        self.assertEqual(groups('<group name="g"><link name="b"/><link name="base"/></group>'), {"g": ["j2"]})
        self.assertEqual(groups('<group name="g"><chain base_link="a" tip_link="c"/></group>'), {"g": ["j2", "j3"]})
        self.assertEqual(groups('<group name="g"><group name="in"/><link name="b"/></group>' + inner), {"g": ["j1", "j2", "j3"], "in": ["j1", "j3"]})
        self.assertEqual(groups('<group name="g"><group name="h"/><joint name="j1"/></group><group name="h"><group name="g"/></group>'),
                         {"g": ["j1"], "h": ["j1"]})
        for said, srdf in (("group g: no joint x", '<joint name="x"/>'), ("group g: no link x", '<link name="x"/>'),
                           ("group g: no chain c to a", '<chain base_link="c" tip_link="a"/>'), ("group g: no group x", '<group name="x"/>'),
                           ("group g: none of its joints moves", "")):
            self.file("r.srdf", f'<robot name="r"><group name="g">{srdf}</group></robot>')
            status, message = self.convert(text, "--srdf", "r.srdf")
            self.assertEqual(status, 0)
            self.assertIn("warning: r.srdf: " + said, message)
        self.file("r.srdf", '<robot name="r"><group name="a b"><joint name="j1"/></group></robot>')
        self.refused("group a b: a name in a planning file has no blanks", text, "--srdf", "r.srdf")
        # and svcd takes them
        self.file("r.srdf", f'<robot name="r">{inner}</robot>')
        self.assertEqual(self.convert(text, "--srdf", "r.srdf")[0], 0)
        with open(os.path.join(self.folder, "out.txt"), "a", encoding="utf-8") as file:
            file.write("scene s\nplan p s 0 0 0 0.1 0 0.2 group in\n")
        self.assertEqual(self.svcd("plan", "out.txt")[0], 0)

    def test_urdf_what_is_fixed_beside_a_joint_is_asked(self) -> None:
        """A mast on the base may meet the first link, though one joint parts them; links with nothing on them do not count."""
        text = robot(*self.CHAIN, link("mast", CUBE), link("frame"), link("tool", CUBE), joint("f", "base", "mast", "", "fixed"),
                     joint("j4", "c", "frame"), joint("g", "frame", "tool", "", "fixed"))
        found = self.pairs(text)
        self.assertIn(frozenset(("mast", "a")), found)
        self.assertNotIn(frozenset(("mast", "base")), found)
        self.assertNotIn(frozenset(("c", "tool")), found)
        self.assertIn(frozenset(("b", "tool")), found)

    def test_urdf_meshes_of_one_link(self) -> None:
        """Each is a body, and each is asked."""
        self.file("m.stl", binary_stl(block((0, 0, 0), (0.1, 0.1, 0.1))))
        mesh = shape('<mesh filename="m.stl"/>')
        lines = self.lines(robot(link("base", CUBE), link("a", CUBE), link("b", CUBE, mesh, mesh), joint("j1", "base", "a"),
                                 joint("j2", "a", "b")))
        self.assertEqual([line[1] for line in lines if line[0] == "body"], ["base", "a", "b", "b.2", "b.3"])
        self.assertEqual([line[1:] for line in lines if line[0] == "pair"], [["base", "b"], ["base", "b.2"], ["base", "b.3"]])
        self.refused("two bodies of one name", robot(link("base", CUBE), link("b.2", CUBE), link("b", CUBE, mesh),
                                                     joint("j1", "base", "b.2"), joint("j2", "b.2", "b")))

    def test_urdf_scenes(self) -> None:
        self.file("s.urdf", robot(link("arm", CUBE)))
        self.refused("s.urdf: link arm: .*has a body of this name", slider(CUBE), "--scene", "s", "s.urdf")
        self.file("s.urdf", robot(link("x"), link("door", CUBE), joint("hinge", "x", "door")))
        self.refused("s.urdf: joint hinge: .*--fixed hinge=VALUE", slider(CUBE), "--scene", "s", "s.urdf")
        self.assertEqual(self.convert(slider(CUBE), "--scene", "s", "s.urdf", "--fixed", "hinge=1")[0], 0)
        self.assertEqual(self.convert(slider(CUBE), "--scene", "s", "s.urdf", "--scene", "s", "s.urdf", "--fixed", "hinge=1")[0], 1)
        self.file("s.urdf", robot(link("x", "<visual/>")))
        self.assertRegex(self.convert(slider(CUBE), "--scene", "s", "s.urdf")[1], "(?s)without a collision element.*scene s is empty")
        self.refused("s.urdf: .*xacro", slider(CUBE), "--scene", "s", self.file("s.urdf", robot(link("${x}"))))


if __name__ == "__main__":
    unittest.main()
