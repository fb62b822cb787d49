"""Tests of mujoco_scene.py: with MuJoCo's own library where it is (Debian: libmujoco-dev), through the names and shapes that its
Python bindings have; and of shapes against their formulas."""
from __future__ import annotations

import ctypes
import io
import re
import subprocess
import tempfile
import types
import unittest
from contextlib import redirect_stdout
from pathlib import Path
from typing import Any

import numpy as np

import mujoco_scene
import neuralsvcd as nsvcd

# The arrays of a model and its data by name, as MuJoCo's own list of them has it.
SHIM = r"""
#include <mujoco/mujoco.h>
#include <mujoco/mjxmacro.h>
#include <string.h>
#define FOUND(owner, kind, name, rows, columns) \
  if (!strcmp(wanted, #name)) return shape[0] = m->rows, shape[1] = columns, *type = #kind, owner->name;
const void *field(const mjModel *m, const mjData *d, const char *wanted, int shape[2], const char **type) {
  MJMODEL_POINTERS_PREAMBLE(m)
#define X(kind, name, rows, columns) FOUND(m, kind, name, rows, columns)
  MJMODEL_POINTERS
#undef X
#define X(kind, name, rows, columns) FOUND(d, kind, name, rows, columns)
  if (d) { int njmax = m->njmax; MJDATA_POINTERS }
  return 0;
}
double now(const mjData *d) { return d->time; }
double step_of(const mjModel *m) { return m->opt.timestep; }
int count(const mjData *d) { return d->ncon; }
double contact(const mjData *d, int k, int geoms[2]) {
  return geoms[0] = d->contact[k].geom1, geoms[1] = d->contact[k].geom2, d->contact[k].dist;
}
"""
KINDS = {"mjtNum": ctypes.c_double, "float": ctypes.c_float, "int": ctypes.c_int, "mjtByte": ctypes.c_ubyte}

SCENE = """<mujoco>
  <option timestep="0.004" gravity="0 0 -9.81"/>
  <asset><mesh name="wedge" vertex="0 0 0  .3 0 0  0 .2 0  .3 .2 0  0 .1 .2  .1 .1 .05"/>
    <hfield name="dune" nrow="9" ncol="7" size=".6 .8 .2 .1"/></asset>
  <worldbody>
    <geom name="floor" type="plane" size="0 0 1"/>
    <geom name="dune" type="hfield" hfield="dune" pos="2 0 0"/>
    <geom name="tilted" type="box" size=".4 .3 .05" pos="0 0 .2" euler="0 25 10"/>
    <body pos="0 0 .8"><freejoint/><geom name="ball" type="sphere" size=".08"/></body>
    <body pos=".05 .1 1.1" euler="30 20 0"><freejoint/><geom name="pill" type="capsule" size=".05 .12"/></body>
    <body pos="-.1 0 1.4" euler="10 40 70"><freejoint/><geom name="wedge" type="mesh" mesh="wedge"/></body>
    <body pos="-.9 .3 .6" euler="50 0 0"><freejoint/><geom name="can" type="cylinder" size=".1 .15"/></body>
    <body pos="1.9 .1 .8" euler="0 60 0"><freejoint/><geom name="egg" type="ellipsoid" size=".1 .15 .2"/></body>
    <body pos="-1.6 0 1"><joint type="hinge" axis="0 1 0" damping=".01"/>
      <geom name="upper" type="capsule" fromto="0 0 0 .4 0 0" size=".04"/>
      <body pos=".4 0 0"><joint type="hinge" axis="0 1 0"/><geom name="lower" type="box" size=".2 .03 .03" pos=".2 0 0"/></body>
    </body>
    <body pos="-1 0 .35"><freejoint/><geom name="block" type="box" size=".08 .08 .08"/></body>
  </worldbody>
</mujoco>"""


class Owner:
    """A model or its data, with the arrays of both by name, as those of MuJoCo's bindings."""

    def __init__(self, shim: Any, model: int, data: int = 0) -> None:
        self.shim, self.model, self.data = shim, model, data

    def __getattr__(self, name: str) -> Any:
        shape, kind = (ctypes.c_int * 2)(), ctypes.c_char_p()
        place = self.shim.field(self.model, self.data or None, name.encode(), shape, ctypes.byref(kind))
        if not place:
            raise AttributeError(name)
        length = shape[0] * shape[1]
        array = np.frombuffer((KINDS[kind.value.decode()] * length).from_address(place), KINDS[kind.value.decode()])
        return array if shape[1] == 1 else array.reshape(tuple(shape))


def bindings(folder: Path) -> Any:
    """Of MuJoCo's module what mujoco_scene uses; None: there is no such library."""
    (folder / "shim.c").write_text(SHIM)
    command = ["cc", "-w", "-shared", "-fPIC", "-Wl,--no-as-needed", "-o", folder / "shim.so", folder / "shim.c", "-lmujoco"]
    try:
        if subprocess.run(command, capture_output=True).returncode:
            return None
    except FileNotFoundError:
        return None
    shim = ctypes.CDLL(str(folder / "shim.so"))  # and what it needs
    shim.field.restype = ctypes.c_void_p
    shim.field.argtypes = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_char_p, ctypes.c_void_p, ctypes.c_void_p]
    for name, result, arguments in (("now", ctypes.c_double, 1), ("step_of", ctypes.c_double, 1), ("count", ctypes.c_int, 1),
                                    ("mj_makeData", ctypes.c_void_p, 1), ("mj_step", None, 2), ("mj_forward", None, 2)):
        function = getattr(shim, name)
        function.restype, function.argtypes = result, [ctypes.c_void_p] * arguments
    shim.mj_loadXML.restype, shim.mj_id2name.restype = ctypes.c_void_p, ctypes.c_char_p
    shim.mj_id2name.argtypes = [ctypes.c_void_p, ctypes.c_int, ctypes.c_int]
    shim.contact.restype, shim.contact.argtypes = ctypes.c_double, [ctypes.c_void_p, ctypes.c_int, ctypes.c_void_p]

    class Model(Owner):
        @classmethod
        def from_xml_path(cls, path: str) -> Any:
            error = ctypes.create_string_buffer(1000)
            address = shim.mj_loadXML(path.encode(), None, error, len(error))
            if not address:
                raise ValueError(error.value.decode())
            model = cls(shim, address)
            model.ngeom, model.opt = len(model.geom_type), types.SimpleNamespace(timestep=shim.step_of(address))
            return model

    class Data(Owner):
        def __init__(self, model: Model) -> None:
            super().__init__(shim, model.model, shim.mj_makeData(model.model))

        @property
        def time(self) -> float:
            return float(shim.now(self.data))

        def contacts(self) -> list[tuple[int, int, float]]:
            found = []
            for k in range(shim.count(self.data)):
                geoms = (ctypes.c_int * 2)()
                distance = shim.contact(self.data, k, geoms)
                found.append((*sorted(geoms), distance))
            return found
    return types.SimpleNamespace(
        MjModel=Model, MjData=Data, mj_step=lambda model, data: shim.mj_step(model.model, data.data),
        mj_forward=lambda model, data: shim.mj_forward(model.model, data.data), mjtObj=types.SimpleNamespace(mjOBJ_GEOM=5),
        mj_id2name=lambda model, kind, id: (shim.mj_id2name(model.model, kind, id) or b"").decode())


class Geoms(unittest.TestCase):
    """Of a model that is none of MuJoCo's, but has its names."""

    def body(self, kind: int, size: list[float], **named: Any) -> nsvcd.Body:
        model = types.SimpleNamespace(geom_type=np.array([kind]), geom_size=np.array([size]), geom_dataid=np.array([0]), **named)
        return mujoco_scene.body_of(model, 0)

    def test_where_they_end(self) -> None:
        """By a micrometre; or, of hulls, by no more than is said."""
        probe = nsvcd.Body.sphere(0.1)
        for kind, size, along, excess in (
                (mujoco_scene.SPHERE, [0.3, 0, 0], [0.3] * 3, 0), (mujoco_scene.CAPSULE, [0.2, 0.5, 0], [0.2, 0.2, 0.7], 0),
                (mujoco_scene.BOX, [0.1, 0.2, 0.3], [0.1, 0.2, 0.3], 0), (mujoco_scene.CYLINDER, [0.2, 0.5, 0], [0.2, 0.2, 0.5], 0.001),
                (mujoco_scene.ELLIPSOID, [0.1, 0.2, 0.3], [0.1, 0.2, 0.3], 0.006)):
            body = self.body(kind, size)
            for axis, end in enumerate(along):
                for side in (-1, 1):
                    place = np.zeros(3)
                    place[axis] = side * (end + 0.1 - 1e-6)
                    self.assertEqual(nsvcd.sweep(probe, body, place).verdict, "hit", (kind, axis))
                    place[axis] = side * (end + 0.1 + excess + 1e-6)
                    self.assertEqual(nsvcd.sweep(probe, body, place).verdict, "free", (kind, axis))
        random = np.random.default_rng(3).normal(size=(200, 3))
        for kind, length in ((mujoco_scene.ELLIPSOID, lambda p: np.linalg.norm(p / [0.1, 0.2, 0.3])),
                             (mujoco_scene.CYLINDER, lambda p: max(np.linalg.norm(p[:2]) / 0.1, abs(p[2]) / 0.2))):
            body, dot = self.body(kind, [0.1, 0.2, 0.3]), nsvcd.Body.sphere(1e-4)
            for point in random:
                on = point / length(point)
                self.assertEqual(nsvcd.sweep(dot, body, on).verdict, "hit")
                self.assertEqual(nsvcd.sweep(dot, body, on * 1.02 + 2e-4 * np.sign(on)).verdict, "free")
        plane = self.body(mujoco_scene.PLANE, [0, 0, 1])
        self.assertEqual([nsvcd.sweep(probe, plane, [50, -90, z]).verdict for z in (0.0999, 0.1001, -5)], ["hit", "free", "hit"])

    def test_meshes(self) -> None:
        two = nsvcd.Mesh.box([1, 1, 1]), nsvcd.Mesh(np.float32([[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 2], [0.2, 0.2, 0.2]]),
                                                    np.uint32([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 4], [2, 3, 4], [3, 1, 4]]))
        model = types.SimpleNamespace(
            geom_type=[7, 7], geom_size=np.zeros((2, 3)), geom_dataid=[1, 0], mesh_vertadr=[0, 8], mesh_vertnum=[8, 5],
            mesh_vert=np.concatenate([mesh.vertices for mesh in two]), mesh_faceadr=[0, 12], mesh_facenum=[12, 6],
            mesh_face=np.concatenate([mesh.faces for mesh in two]).astype(np.int32))
        dot = nsvcd.Body.sphere(0.01)
        for hulls, verdict in ((True, "hit"), (False, "free")):  # its hull covers what is above the hollow
            body = mujoco_scene.body_of(model, 0, hulls=hulls)
            self.assertEqual(nsvcd.sweep(dot, body, [0.4, 0.4, 0.4]).verdict, verdict)
        np.testing.assert_allclose(mujoco_scene.body_of(model, 1).facts.high, [0.5, 0.5, 0.5], atol=1e-5)
        field = self.body(mujoco_scene.HEIGHTS, [0, 0, 0], hfield_nrow=[3], hfield_ncol=[2], hfield_adr=[0],
                          hfield_size=np.array([[1, 2, 0.5, 0.25]]), hfield_data=np.float32([0, 0, 1, 1, 0, 0]))
        np.testing.assert_allclose([field.facts.low, field.facts.high], [[-1, -2, -0.25], [1, 2, 0.5]], atol=1e-4)
        self.assertEqual(field.facts.open_components, 0)
        places = [[0, 0, 0.52], [0, 1, 0.27], [0, 0, 0], [1.02, 0, 0], [0.5, 0.5, 0.37]]
        self.assertEqual([nsvcd.sweep(dot, field, place).verdict for place in places], ["free", "free", "hit", "free", "hit"])
        self.assertRaises(ValueError, self.body, 100, [0, 0, 0])


class WithMujoco(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.mujoco = bindings(Path(self.folder.name))
        if self.mujoco is None:
            self.skipTest("no MuJoCo, or no cc: not tested")

    def load(self, text: str) -> tuple[Any, Any]:
        self.path = str(Path(self.folder.name) / "scene.xml")
        Path(self.path).write_text(text)
        model = self.mujoco.MjModel.from_xml_path(self.path)
        return model, self.mujoco.MjData(model)

    def test_contacts(self) -> None:
        """What falls and lands: each contact of MuJoCo's is a hit at that sample. What hits is a contact there, but for the hulls
        around cylinders and ellipsoids."""
        model, data = self.load(SCENE)
        model.hfield_data[:] = np.random.default_rng(1).random(len(model.hfield_data))
        pairs = mujoco_scene.pairs_of(model)
        bodies = [mujoco_scene.body_of(model, geom) for geom in range(model.ngeom)]
        is_hull = np.isin(model.geom_type, (mujoco_scene.CYLINDER, mujoco_scene.ELLIPSOID))
        a, b = np.array(pairs).T
        met, checked = set(), 0
        for _ in range(500):
            self.mujoco.mj_step(model, data)
            contacts: dict[tuple[int, int], float] = {}
            for i, j, distance in data.contacts():
                contacts[i, j] = min(distance, contacts.get((i, j), np.inf))
            self.assertLessEqual(set(contacts), set(pairs))
            poses = mujoco_scene.poses_of(data)[:, None]
            answers = nsvcd.sweep([bodies[i] for i in a], [bodies[j] for j in b], poses[a], poses[b])
            for pair, verdict in zip(pairs, answers.verdict):
                if abs(contacts.get(pair, 1)) < 1e-6:
                    continue
                if pair in contacts:
                    self.assertEqual(verdict, "hit", (pair, contacts[pair]))
                    met.add(pair)
                elif not is_hull[list(pair)].any():
                    self.assertEqual(verdict, "free", pair)
                checked += 1
        self.assertGreater(checked, 25000)
        self.assertGreaterEqual(len(met), 12)
        # Bodies' frames: of quaternions as of matrices, but for a quaternion's sign.
        given, turned = nsvcd.poses(data.xpos, "wxyz", rotations=data.xquat), nsvcd.poses(data.xpos, rotations=data.xmat)
        turned[:, 3:] *= np.sign((turned[:, 3:] * given[:, 3:]).sum(1, keepdims=True))
        np.testing.assert_allclose(given, turned, atol=1e-6)

    def test_between_samples(self) -> None:
        """A ball goes through a sheet between two steps. MuJoCo sees no contact."""
        model, data = self.load("""<mujoco><option timestep="0.01" gravity="0 0 0"/><worldbody>
          <geom name="sheet" type="box" size=".5 .5 .001"/><body pos="0 0 1.05"><freejoint/><geom name="ball" size=".02"/></body>
          </worldbody></mujoco>""")
        data.qvel[2] = -50
        seen = 0
        samples = []
        for _ in range(6):
            self.mujoco.mj_step(model, data)
            seen += len(data.contacts())
            samples.append(mujoco_scene.poses_of(data))
        self.assertEqual(seen, 0)
        sheet, ball = (mujoco_scene.body_of(model, geom) for geom in (0, 1))
        answer = nsvcd.sweep(ball, sheet, np.array(samples)[:, 1], ask="first", to=1e-4)
        self.assertEqual(answer.verdict, "hit")
        self.assertAlmostEqual(answer.time.high * 5 * 0.01, (1.05 - 0.021) / 50, delta=1e-4)

    def test_program(self) -> None:
        self.load(SCENE)
        printed = io.StringIO()
        with redirect_stdout(printed):
            mujoco_scene.main(self.mujoco, self.path, 0.4)
        lines = printed.getvalue().splitlines()
        self.assertRegex(lines[0], r"^0\.\d{4} s: hit: floor, block$")
        self.assertRegex(lines[-1], r"^\d+ of 51 pairs never meet, \d+ samples$")
        block = float(re.match(r"[\d.]+", lines[0])[0])
        self.assertAlmostEqual(block, (2 * (0.35 - 0.08) / 9.81) ** 0.5, delta=0.005)


if __name__ == "__main__":
    unittest.main()
