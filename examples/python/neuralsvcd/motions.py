# SPDX-License-Identifier: MIT
"""Poses and motions, as arrays (k, 7) or rigid matrices."""
from __future__ import annotations

import math
from ctypes import c_float
from typing import Any, NamedTuple, Optional

import numpy as np
from numpy.typing import ArrayLike

from ._structs import _Pose
from ._arrays import Doubles, _floats, Floats, _numeric


def poses_from_matrices(matrices: ArrayLike) -> Doubles:
    """Poses (..., 7) of rigid matrices (..., 4, 4), which take points as columns; nsvcd_verify is to be given these too.

    ValueError where one is not rigid to 1e-4.
    """
    return np.asarray(_posed(_numeric(matrices, (None,) * (np.ndim(matrices) - 2) + (4, 4), "matrices"), "matrices"))


def _posed(poses: Any, name: str) -> Any:
    """Poses, also where they are given as matrices."""
    given = np.asarray(poses)
    if given.shape[-2:] != (4, 4) or given.dtype.kind not in "fiu":
        return given
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
    """(k, 7), and (k) or None; of a batch there may be (n, k, 7) and (n, k). poses None: at rest at the origin."""
    poses: Optional[Floats]
    times: Optional[Floats]


def _motion(poses: Optional[ArrayLike], times: Optional[ArrayLike], side: str, batch: bool = False) -> _Motion:
    if poses is None:
        if times is not None:
            raise ValueError(f"times_{side}: there are no poses")
        return _Motion(None, None)
    given = np.asarray(poses)
    if given.shape[-2:] == (4, 4):
        given = _posed(given if given.ndim > 2 else given[None], f"poses_{side}")
    each = (None,) if batch and given.ndim != 2 else ()
    kept = _floats(given, (*each, None, 7), f"poses_{side}")
    if not kept.shape[-2]:
        raise ValueError(f"poses_{side}: no pose; None is at rest at the origin")
    if times is None:
        return _Motion(kept, None)
    each = (None,) if batch and np.ndim(times) != 1 else ()
    return _Motion(kept, _floats(times, (*each, kept.shape[-2]), f"times_{side}"))


def _pose_of(pose: ArrayLike, name: str) -> Any:
    row = _floats(_posed(pose, name), (7,), name).tolist()
    return _Pose((c_float * 3)(*row[:3]), (c_float * 4)(*row[3:]))
