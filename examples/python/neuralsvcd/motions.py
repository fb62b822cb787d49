# SPDX-License-Identifier: MIT
"""Poses and motions: (k, 7), positions, rigid matrices, and what is a pose elsewhere."""
from __future__ import annotations

import math
from ctypes import c_float
from typing import Any, Literal, NamedTuple, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._structs import _Pose
from ._arrays import Doubles, _floats, Floats
from .meshes import _warn


_ORDERS = ("xyzw", "wxyz")
_Order = Literal["xyzw", "wxyz"]


def poses(given: Any, order: _Order = "xyzw", *, rotations: Any = None, to: _Order = "xyzw") -> Doubles:
    """Poses (..., 7), as all functions here take and return them: x y z in metres, unit quaternion x y z w.

    given      (..., 7), (..., 3) positions, or (..., 4, 4) rigid matrices, which take points as columns; or what is a pose
               elsewhere, and lists of it: an SE3 of pinocchio or spatialmath, a Pose or a Transform of ROS, stamped or not, a
               RigidTransform of scipy
    order      of the quaternions given: "xyzw" is that of scipy, pinocchio, ROS and PyBullet; "wxyz" that of MuJoCo and
               Eigen's constructor: sweep(a, b, poses(qpos, order="wxyz"))
    rotations  apart from positions: (..., 4) quaternions, (..., 3, 3) or (..., 9) matrices, row by row, a Rotation of scipy; one
               for each position, or one for all: poses(data.geom_xpos, rotations=data.geom_xmat) of MuJoCo's geoms,
               poses(data.xpos, "wxyz", rotations=data.xquat) of its bodies
    to         of those returned: poses(answer.safe.a, to="wxyz")

    ValueError where a matrix is not rigid to 1e-4, and for other shapes. Quaternions are not normalized.
    """
    for name, word in (("order", order), ("to", to)):
        if word not in _ORDERS:
            raise ValueError(f"{name}: {word!r} is none of {', '.join(_ORDERS)}")
    array = _numbers(given, "poses")
    if rotations is not None:
        array = _joined(array, _numbers(rotations, "rotations"))
    rows = np.array(_rows(array, "poses"), np.float64)
    if order != "xyzw" and array.shape[-1:] == (7,):
        rows = rows[..., [0, 1, 2, 4, 5, 6, 3]]
    return rows if to == "xyzw" else rows[..., [0, 1, 2, 6, 3, 4, 5]]


def _numbers(given: Any, name: str) -> NDArray[Any]:
    leaf = given
    while isinstance(leaf, (list, tuple)) and leaf:
        leaf = leaf[0]
    try:
        array = np.asarray(given if isinstance(leaf, (float, int, np.ndarray)) else _plain(given))
    except ValueError:
        raise ValueError(f"{name}: rows of one length are needed; positions and rotations apart are "
                         "poses(positions, rotations=rotations)") from None
    if array.dtype.kind not in "fiu":
        kind = type(leaf).__name__ if array.dtype.kind == "O" else array.dtype
        hint = ": the order is sweep(a, b, poses_a, poses_b)" if kind == "Body" else ""
        raise TypeError(f"{name}: numbers are needed, or what is a pose elsewhere, as help(neuralsvcd.poses) lists, not {kind}{hint}")
    if array.shape == (0,):
        raise ValueError(f"{name}: no pose; None is at rest at the origin")
    return array


def _plain(given: Any) -> Any:
    """Numbers in place of what is a pose elsewhere, by the names that it has there."""
    if hasattr(given, "A"):  # spatialmath.SE3; of several a list, of which numpy would see the first one
        return given.A
    if hasattr(given, "homogeneous"):  # pinocchio.SE3
        return given.homogeneous
    if hasattr(given, "as_matrix"):  # of scipy
        return given.as_matrix()
    given = getattr(given, "pose", getattr(given, "transform", given))  # of ROS, stamped; a Pose, a Transform
    for place, turn in (("position", "orientation"), ("translation", "rotation")):
        if hasattr(given, place) and hasattr(given, turn):
            p, q = getattr(given, place), getattr(given, turn)
            return [p.x, p.y, p.z, q.x, q.y, q.z, q.w]
    if hasattr(given, "__array__"):
        return np.asarray(given)
    if isinstance(given, (str, bytes, memoryview)) or not hasattr(given, "__iter__"):
        return given
    return [_plain(each) for each in given]


def _joined(positions: NDArray[Any], rotations: NDArray[Any]) -> NDArray[Any]:
    """(..., 7) of quaternions in their order, or (..., 4, 4)."""
    if rotations.shape[-1:] == (9,):
        rotations = rotations.reshape(*rotations.shape[:-1], 3, 3)
    are_quaternions = rotations.shape[-1:] == (4,)
    each = positions.shape[:-1]
    if positions.shape[-1:] == (3,) and (are_quaternions or rotations.shape[-2:] == (3, 3)):
        end = rotations.shape[-1:] if are_quaternions else (3, 3)
        if rotations.shape[:-len(end)] in (each, ()):
            turns = np.broadcast_to(rotations, (*each, *end))
            if are_quaternions:
                return np.concatenate([positions, turns], -1)
            matrices = np.zeros((*each, 4, 4))
            matrices[..., :3, :3], matrices[..., :3, 3], matrices[..., 3, 3] = turns, positions, 1
            return matrices
    raise ValueError(f"rotations: (..., 3) positions and as many (..., 4), (..., 3, 3) or (..., 9) are needed, not "
                     f"{positions.shape} and {rotations.shape}")


def _rows(poses: Any, name: str) -> NDArray[Any]:
    """Poses (..., 7), also where they are given as positions, as matrices, or as what is a pose elsewhere."""
    given = _numbers(poses, name)
    shape = given.shape
    if shape[-1:] == (7,):
        return given
    if shape[-2:] == (4, 4):
        return _of_matrices(given, name)
    if shape[-1:] == (3,):
        if shape[-2:] == (3, 3) and np.allclose(given @ np.swapaxes(given, -1, -2), np.eye(3), atol=1e-4):
            raise ValueError(f"{name}: {shape}: a rotation matrix, or three positions? Give a rotation with its positions: "
                             "poses(positions, rotations=...); positions as poses (3, 7)")
        rows = np.zeros((*shape[:-1], 7), given.dtype if given.dtype.kind == "f" else np.float64)
        rows[..., :3], rows[..., 6] = given, 1
        return rows
    hint = {(3, 4): "a 3x4 matrix lacks its row 0 0 0 1", (6,): "6 numbers are a twist, or Euler angles: a pose has a quaternion",
            (4,): "a quaternion alone lacks its position: poses(positions, rotations=...)"}
    why = next((text for end, text in hint.items() if shape[-len(end):] == end), "")
    raise ValueError(f"{name}: (..., 7), (..., 3) or (..., 4, 4) is needed, not {shape}" + (f": {why}" if why else ""))


def _of_matrices(given: NDArray[Any], name: str) -> Doubles:
    m = given.astype(np.float64)
    if not np.isfinite(m).all() or (np.abs(m[..., 3, :] - [0, 0, 0, 1]) > 1e-4).any():
        raise ValueError(f"{name}: not finite, or a last row that is not 0 0 0 1: are points rows here? transpose it")
    r = m[..., :3, :3]
    metric = np.swapaxes(r, -1, -2) @ r
    square = np.trace(metric, axis1=-2, axis2=-1) / 3  # of the scale
    even = np.abs(metric - square[..., None, None] * np.eye(3)).max((-2, -1)) <= 2e-4 * square
    if not even.all() or (np.linalg.det(r) <= 0).any():
        raise ValueError(f"{name}: a matrix that shears, mirrors or stretches: it must be rigid")
    if (np.abs(square - 1) > 2e-4).any():  # of lengths, to 1e-4
        worst = math.sqrt(square.flat[np.abs(square - 1).argmax()])
        raise ValueError(f"{name}: a matrix that scales, by {worst:.6g}: give the scale as scale_a, scale_b or to the body")
    # The products of a quaternion's numbers, times 4: its row with the largest square is that quaternion, scaled.
    products = np.empty((*m.shape[:-2], 4, 4))
    products[..., :3, :3] = r + np.swapaxes(r, -1, -2)
    trace = np.trace(r, axis1=-2, axis2=-1)
    for i, (j, k) in enumerate(((1, 2), (2, 0), (0, 1))):
        products[..., i, i] = 1 + 2 * r[..., i, i] - trace
        products[..., i, 3] = products[..., 3, i] = r[..., k, j] - r[..., j, k]
    products[..., 3, 3] = 1 + trace
    largest = np.diagonal(products, axis1=-2, axis2=-1).argmax(-1)
    rotation = np.take_along_axis(products, largest[..., None, None], -2)[..., 0, :]
    return np.concatenate([m[..., :3, 3], rotation / np.linalg.norm(rotation, axis=-1, keepdims=True)], -1)


class _Motion(NamedTuple):
    """(k, 7), and (k) or None; of many motions (n, k, 7) or (n, k). poses None: at rest at the origin. given: rounded to poses."""
    poses: Optional[Floats]
    times: Optional[Floats]
    given: Any = None

    def are_many(self) -> bool:
        return self.poses is not None and (self.poses.ndim > 2 or self.times is not None and self.times.ndim > 1)


def _motion(poses: Optional[ArrayLike], times: Optional[ArrayLike], suffix: str = "", *, one: bool = False) -> _Motion:
    """suffix: of the names of both. one: there are not to be many."""
    if poses is None:
        if times is not None:
            raise ValueError(f"times{suffix}: there are no poses")
        return _Motion(None, None)
    rows = _rows(poses, f"poses{suffix}")
    kept = np.array(rows if rows.ndim > 1 else rows[None], np.float32, order="C")
    if kept.ndim > (2 if one else 3):
        raise ValueError(f"poses{suffix}: {'one motion (k, 7) is' if one else 'at most (n, k, 7) are'} needed, not {rows.shape}")
    if not kept.shape[-2]:
        raise ValueError(f"poses{suffix}: no pose; None is at rest at the origin")
    if times is None:
        return _Motion(kept, None, rows)
    each = () if one or np.ndim(times) == 1 else (None,)
    return _Motion(kept, _floats(times, (*each, kept.shape[-2]), f"times{suffix}"), rows)


def _warn_of_rounding(given: Any, kept: Optional[Floats], size: float, name: str) -> None:
    """Poses as they were given, and as float32, which moves them by little against a body of so many metres, unless it is far
    from the origin."""
    if kept is None or given.dtype == np.float32 or not kept.size:
        return
    flat = kept.ravel()
    most = math.sqrt(flat.dot(flat)) if flat.size < 100 else max(flat.max(), -flat.min())  # no less than any; the first costs less
    if most * 2.0 ** -24 <= 1e-4 * size:
        return
    with np.errstate(invalid="ignore"):  # the library refuses what is not finite
        off = float(np.abs(kept[..., :3] - given[..., :3]).max())
    if off > 1e-4 * size:
        _warn(f"{name}: rounding to float32 moves them by {off:.2g} m, which is much for a body of {size:.2g} m: subtract a common "
              "origin from all poses first")


def _pose_of(pose: ArrayLike, name: str, size: float = math.inf) -> Any:
    """size: of the body that it places."""
    given = _rows(pose, name)
    kept = _floats(given, (7,), name)
    _warn_of_rounding(given, kept, size, name)
    row = kept.tolist()
    return _Pose((c_float * 3)(*row[:3]), (c_float * 4)(*row[3:]))
