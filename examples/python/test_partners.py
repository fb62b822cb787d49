"""Tests of what others' packages have: their poses and meshes, by the names that they have there. With the packages where they are,
with stand-ins of the same names everywhere."""
from __future__ import annotations

import importlib
import types
import unittest
import warnings
from pathlib import Path
from typing import Any, Optional

import numpy as np

import neuralsvcd as nsvcd
import nsvcd_verify
from neuralsvcd import Body, Mesh

ASSETS = Path(__file__).resolve().parent.parent / "assets"
Named = types.SimpleNamespace


def module(name: str) -> Optional[Any]:
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return importlib.import_module(name)
    except ImportError:
        return None


class Se3:
    """pinocchio.SE3, of old; a vector of these has only the methods of a sequence."""

    def __init__(self, matrix: np.ndarray) -> None:
        self.homogeneous, self.translation, self.rotation = matrix, matrix[:3, 3], matrix[:3, :3]


class NewSe3(Se3):
    def __array__(self, dtype: Any = None, copy: Any = None) -> np.ndarray:
        return self.homogeneous


class StdVec:
    def __init__(self, items: list[Any]) -> None:
        self.items = items

    def __len__(self) -> int:
        return len(self.items)

    def __getitem__(self, k: int) -> Any:
        return self.items[k]

    def __iter__(self) -> Any:
        return iter(self.items)


class SpatialSe3(StdVec):
    """spatialmath.SE3: a list, of which numpy sees the first one."""

    @property
    def A(self) -> Any:
        return self.items[0] if len(self.items) == 1 else self.items

    def __getitem__(self, k: int) -> Any:
        return SpatialSe3([self.items[k]])

    def __iter__(self) -> Any:
        return (SpatialSe3([item]) for item in self.items)

    @property
    def __array_interface__(self) -> Any:
        return self.items[0].__array_interface__


def ros(row: np.ndarray, place: str, turn: str) -> Any:
    return Named(**{place: Named(x=row[0], y=row[1], z=row[2]), turn: Named(x=row[3], y=row[4], z=row[5], w=row[6])})


class Poses(unittest.TestCase):
    def setUp(self) -> None:
        random = np.random.default_rng(4)
        turns = random.normal(size=(2, 5, 4))
        turns /= np.where(turns[..., 3:] < 0, -1, 1) * np.linalg.norm(turns, axis=-1, keepdims=True)
        self.rows = np.concatenate([random.normal(size=(2, 5, 3)), turns], -1)
        x, y, z, w = np.moveaxis(turns, -1, 0)
        self.matrices = np.zeros((2, 5, 4, 4))
        self.matrices[..., :3, :3] = np.moveaxis(np.array([
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]), (0, 1), (-2, -1))
        self.matrices[..., :3, 3], self.matrices[..., 3, 3] = self.rows[..., :3], 1

    def same(self, found: Any, rows: Any) -> None:
        found = nsvcd.poses(found) if not isinstance(found, np.ndarray) else found
        found = found * np.where(np.sign(found[..., 6:]) < 0, [1, 1, 1, -1, -1, -1, -1], 1)
        self.assertEqual(found.shape, np.shape(rows))
        np.testing.assert_allclose(found, rows, atol=1e-12)

    def test_rotations_apart(self) -> None:
        places, turns, matrices = self.rows[..., :3], self.rows[..., 3:], self.matrices[..., :3, :3]
        for k in ((), 0, (0, 0)):
            rows = self.rows[k]
            for given, order in ((turns, "xyzw"), (turns[..., [3, 0, 1, 2]], "wxyz"), (matrices, "xyzw"), (matrices, "wxyz"),
                                 (matrices.reshape(2, 5, 9), "xyzw")):
                self.same(nsvcd.poses(places[k], order, rotations=given[k]), rows)
                self.same(nsvcd.poses(places[k].tolist(), order, rotations=given[k].tolist()), rows)
            np.testing.assert_array_equal(nsvcd.poses(places[k], rotations=turns[k], to="wxyz")[..., 3], turns[k][..., 3])
        one = nsvcd.poses(places, rotations=matrices[0, 0])
        self.same(one[1, 4], [*places[1, 4], *turns[0, 0]])
        self.same(nsvcd.poses(places, "wxyz", rotations=[1, 0, 0, 0])[1, 2], [*places[1, 2], 0, 0, 0, 1])
        scipy = module("scipy.spatial.transform")
        if scipy:
            self.same(nsvcd.poses(places[0], rotations=scipy.Rotation.from_quat(turns[0])), self.rows[0])
            self.same(nsvcd.poses(places[0], rotations=list(scipy.Rotation.from_quat(turns[0]))), self.rows[0])
            self.same(nsvcd.poses(places[0, 0], rotations=scipy.Rotation.from_quat(turns[0, 0])), self.rows[0, 0])
        for wrong, words in (((places, turns[:1]), r"\\(2, 5, 3\\) and \\(1, 5, 4\\)"), ((places, turns[..., :3]), "as many"),
                             ((self.rows, turns), "positions"), ((places, np.eye(4)), "4, 4"), ((places[0], matrices[1, :4]), "as many"),
                             ((places, 2 * matrices), "scales, by 2"), ((places, -matrices), "mirrors")):
            with self.assertRaisesRegex(ValueError, words.replace("\\\\", "\\")):
                nsvcd.poses(wrong[0], rotations=wrong[1])

    def test_objects(self) -> None:
        for kind in (Se3, NewSe3):
            poses = [[kind(matrix) for matrix in motion] for motion in self.matrices]
            self.same(poses[0][1], self.rows[0, 1])
            for motion in (poses[0], tuple(poses[0]), StdVec(poses[0])):
                self.same(motion, self.rows[0])
            for many in (poses, [StdVec(motion) for motion in poses], StdVec([StdVec(motion) for motion in poses])):
                self.same(many, self.rows)
        spatial = [SpatialSe3(list(motion)) for motion in self.matrices]
        self.assertEqual(np.asarray(spatial[0]).shape, (4, 4))  # of five
        self.same(spatial[0], self.rows[0])
        self.same(spatial, self.rows)
        self.same(SpatialSe3([self.matrices[1, 2]]), self.rows[1, 2])
        self.same(list(spatial[0]), self.rows[0])
        self.same(Named(as_matrix=lambda: self.matrices[0]), self.rows[0])
        for names in (("position", "orientation"), ("translation", "rotation")):
            poses = [[ros(row, *names) for row in rows] for rows in self.rows]
            self.same(poses[1][1], self.rows[1, 1])
            self.same(poses, self.rows)
            for stamped in ("pose", "transform"):
                self.same([Named(**{stamped: pose}) for pose in poses[1]], self.rows[1])
        messages = module("geometry_msgs.msg")
        if messages:
            pose, stamped, transform = messages.Pose(), messages.PoseStamped(), messages.TransformStamped()
            for point, turn in ((pose.position, pose.orientation), (stamped.pose.position, stamped.pose.orientation),
                                (transform.transform.translation, transform.transform.rotation)):
                (point.x, point.y, point.z), (turn.x, turn.y, turn.z, turn.w) = self.rows[0, 3, :3], self.rows[0, 3, 3:]
            self.same([pose, stamped, transform, transform.transform], [self.rows[0, 3]] * 4)

    def test_questions(self) -> None:
        """Wherever a pose or a motion is."""
        path = np.tile(np.eye(4), (2, 1, 1))
        path[:, :3, 3] = [[-3, 0, 0], [3, 0, 0]]
        ball, world = Body.sphere(0.5), nsvcd.World(3)
        still = world.add(ball, Se3(path[0]))
        for given in ([Se3(matrix) for matrix in path], StdVec([Se3(matrix) for matrix in path]), SpatialSe3(list(path)),
                      [ros(row, "position", "orientation") for row in nsvcd.poses(path)]):
            self.assertEqual(nsvcd.sweep(ball, ball, given).verdict, "hit")
            self.assertEqual(nsvcd.sweep(ball, ball, given[1]).verdict, "free")
            self.assertEqual(nsvcd.sweep(ball, ball, [given, given], [0, 0, 2]).verdict.tolist(), ["free", "free"])
            self.assertEqual(world.sweep(ball, given).body, still)
            self.assertEqual(nsvcd.certify(Mesh.box([1, 1, 1]), Mesh.box([0.5, 0.7, 0.3]), given).verdict, "hit")

    def test_refused(self) -> None:
        for wrong, kind, words in ((([1, 2, 3], [0, 0, 0, 1]), ValueError, "poses.positions, rotations=rotations"),
                                   ([[1, 2, 3], [4, 5]], ValueError, "rows of one length"),
                                   (["a", "b"], TypeError, "not <U1"), ([object()], TypeError, "not object"), (None, TypeError, "NoneType"),
                                   ([None, None], TypeError, "not NoneType"), (b"abc", TypeError, "numbers"),
                                   (Named(as_matrix=lambda: np.eye(3)), ValueError, "a rotation with its positions: poses"),
                                   ([0, 0, 0, 1], ValueError, "lacks its position: poses")):
            with self.assertRaisesRegex(kind, words):
                nsvcd.poses(wrong)
        self.assertEqual(nsvcd.poses(memoryview(np.arange(7.0))).tolist(), list(range(7)))
        self.assertEqual(nsvcd.poses(range(7)).tolist(), list(range(7)))


class Meshes(unittest.TestCase):
    def setUp(self) -> None:
        self.mug = Mesh.load(ASSETS / "mug.obj")

    def test_triangles(self) -> None:
        """An open3d mesh, and a certificate of it; two of them are two bodies, not (vertices, faces)."""
        other = Named(vertices=self.mug.vertices.astype(float), triangles=self.mug.faces.astype(np.int32))
        kinds, open3d = [other], module("open3d")
        if open3d:
            kinds += [open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(other.vertices),
                                                   open3d.utility.Vector3iVector(other.triangles))]
        for kind in kinds:
            self.assertEqual(bytes(Body(kind)), bytes(Body(self.mug)))
            self.assertEqual(nsvcd.sweep([kind, kind], self.mug, [1, 0, 0]).verdict.tolist(), ["free", "free"])
            proof = nsvcd.certify(kind, self.mug, [1, 0, 0])
            self.assertEqual(nsvcd_verify.verify(proof.bytes, kind, self.mug, nsvcd.poses([1, 0, 0])).kind, "free")

    def test_hints(self) -> None:
        """What is not taken says what to write; and that works."""
        points, faces = self.mug.vertices.astype(float), self.mug.faces.astype(int)
        given: dict[str, Any] = {
            "trimesh.Scene": Named(geometry={}), "meshio.Mesh": Named(points=points, cells_dict={"triangle": faces}),
            "numpy-stl": Named(vectors=points[faces]), "open3d.t": Named(to_legacy=None),
            "ConvexHull": Named(points=points, simplices=faces),
            "pyvista": Named(points=points, triangulate=lambda: Named(faces=np.insert(faces, 0, 3, 1).ravel()))}
        if module("meshio"):
            given["meshio.Mesh "] = module("meshio").read(ASSETS / "mug.obj")
        if module("stl"):
            given["numpy-stl, "] = module("stl").mesh.Mesh(np.zeros(len(faces), module("stl").mesh.Mesh.dtype))
            given["numpy-stl, "].vectors[:] = points[faces]
        if module("scipy.spatial"):
            given["ConvexHull, "] = module("scipy.spatial").ConvexHull(points)
        for name, mesh in given.items():
            with self.assertRaises(TypeError) as raised:
                nsvcd.sweep(mesh, self.mug)
            text = str(raised.exception)
            self.assertIn(": of ", text)
            self.assertIn(name.rstrip(" ,"), text)
            advice = text[text.rindex(": of ") + 5:].split(", ", 1)[1]
            if "scene" not in advice and "legacy" not in advice:
                found = Body(eval(advice, {"mesh": mesh, "hull": mesh, "np": np, "Mesh": Mesh})).facts
                np.testing.assert_allclose([found.low, found.high], [points.min(0), points.max(0)], atol=1e-4)


if __name__ == "__main__":
    unittest.main()
