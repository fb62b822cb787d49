# SPDX-License-Identifier: MIT
"""Checks certificates that bodies never meet, or that they do: examples/verify for Python, by ctypes.

    report = verify(certificate, (vertices, faces), rack, path)   # as given to neuralsvcd.certify
    if report.kind == "free": ...

Nothing here is shared with the module neuralsvcd or with neuralsvcd.h, which make certificates. Poses, times and scales are as
there, and copied as float32, with a warning where that moves them far; what is proven is about these. Threads may share meshes.
Wrong input is raised as ValueError and TypeError; a certificate may be any bytes.
"""
from __future__ import annotations

import ctypes
import enum
import warnings
from ctypes import c_char, c_char_p, c_double, c_float, c_size_t, c_void_p
from pathlib import Path
from typing import Any, NamedTuple, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["Kind", "Mesh", "Report", "claim", "verify"]


class Kind(str, enum.Enum):
    """What is proven: nsvcd_verify_kind. The statement is in nsvcd_verify.h.

    FREE    the meshes never come within the clearance, and nothing is inside of anything
    HIT     an edge of one passes through a triangle of the other
    NEAR    points of two triangles are nearer than the clearance
    INSIDE  a corner of one is inside of the other
    """
    FREE = "free"
    HIT = "hit"
    NEAR = "near"
    INSIDE = "inside"

    def __str__(self) -> str:
        return str.__str__(self)

    def __format__(self, form: str) -> str:
        return str.__format__(self, form)


_KINDS = tuple(Kind)  # from 1
_PROTOTYPES = {
    "verifier_mesh_size": (c_size_t, c_size_t, c_size_t),
    "verifier_mesh_init": (c_char_p, c_void_p, c_size_t, c_void_p, c_size_t, c_void_p),
    "verifier_mover_size": (c_size_t, c_size_t),
    "verifier_mover_init": (c_char_p, c_void_p, c_float, c_void_p, c_void_p, c_size_t, c_void_p),
    "verifier_workspace_size": (c_size_t, c_void_p, c_void_p),
    "verifier_verify": (c_char_p, c_void_p, c_void_p, c_float, c_char_p, c_size_t, c_void_p, c_void_p),
    "verifier_claim": (None, c_void_p, c_void_p, c_float, c_void_p),
}


def _load_library() -> ctypes.CDLL:
    """The library beside this file, as a wheel has it, or the one that `make python` has built."""
    here = Path(__file__).resolve().parent
    places = [here / "_nsvcd_verify.abi3.so", here.parents[2] / "build" / "_nsvcd_verify.so"]
    path = next((place for place in places if place.exists()), None)
    if path is None:
        raise ImportError(f"nsvcd_verify: the library is not built: make python; looked for {places[0]}, {places[1]}")
    library = ctypes.CDLL(str(path))
    for name, (result, *arguments) in _PROTOTYPES.items():
        function = getattr(library, name)
        function.restype = result
        function.argtypes = arguments
    return library


_library = _load_library()


def _array(value: ArrayLike, columns: tuple[int, ...], name: str, kind: Any = np.float32) -> NDArray[Any]:
    """A copy (n, columns) in C order, so that nothing changes it."""
    array = np.asarray(value)
    if array.dtype.kind not in ("iu" if kind is np.uint32 else "fiu"):
        raise TypeError(f"{name}: an array of numbers is needed, not of {array.dtype}")
    if array.ndim != 1 + len(columns) or array.shape[1:] != columns:
        hint = ": neuralsvcd.poses(path) makes it" if columns == (7,) else ""
        raise ValueError(f"{name}: an array ({', '.join(map(str, ('n', *columns)))}) is needed, not {array.shape}{hint}")
    if kind is np.uint32 and array.size and not (0 <= array.min() and array.max() <= 0xffffffff):
        raise ValueError(f"{name}: an index is out of range")
    return np.array(array, kind, order="C")


def _address(array: Any) -> int:
    return ctypes.addressof(c_char.from_buffer(array)) if array.size else int(array.ctypes.data)


def _memory(size: int) -> NDArray[np.uint64]:
    return np.empty(size // 8 + 1, np.uint64)


def _check(reason: Optional[bytes], where: str = "") -> None:
    if reason is not None:
        raise ValueError(where + reason.decode())


class Mesh:
    """A mesh, prepared once. It does not change; it can be pickled and copied.

    mesh   (vertices, faces), (n, 3) metres and (m, 3) integers, counter-clockwise seen from outside; or what has these,
           like a trimesh.Trimesh or a neuralsvcd.Mesh
    faces  where vertices are given before: Mesh(vertices, faces)
    """

    def __init__(self, mesh: Any, faces: Optional[ArrayLike] = None) -> None:
        if faces is not None:
            vertices = mesh
        elif hasattr(mesh, "vertices") and (hasattr(mesh, "faces") or hasattr(mesh, "triangles")):
            vertices, faces = mesh.vertices, mesh.faces if hasattr(mesh, "faces") else mesh.triangles
        elif isinstance(mesh, (tuple, list)) and len(mesh) == 2:
            vertices, faces = mesh
        else:
            hint = ": its mesh is body.mesh" if hasattr(mesh, "mesh") else ": neuralsvcd.Mesh.load reads files" if isinstance(mesh, str) else ""
            raise TypeError(f"a mesh is (vertices, faces), or what has these, not {type(mesh).__name__}{hint}")
        self._kept = _array(vertices, (3,), "vertices"), _array(faces, (3,), "faces", np.uint32)
        counts = tuple(map(len, self._kept))
        self._memory = _memory(_library.verifier_mesh_size(*counts))
        _check(_library.verifier_mesh_init(_address(self._kept[0]), counts[0], _address(self._kept[1]), counts[1],
                                           _address(self._memory)))

    def __reduce__(self) -> tuple[Any, ...]:
        return Mesh, self._kept


class Report(NamedTuple):
    """nsvcd_verify_report. As a condition it is kind == "free": also a proof that they meet is accepted.

    accepted  the certificate proves what kind says of these meshes, motions, scales and this clearance
    reason    why it is refused, else ""
    position  of the byte that was read last
    kind      what is proven; None: nothing is
    time      of hit, near and inside, in [0, 1], else 0
    a, b      of hit and near: triangles; of inside: a corner, and whose (0: a's, 1: b's); else 0
    """
    accepted: bool
    reason: str
    position: int
    kind: Optional[Kind]
    time: float
    a: int
    b: int

    def __bool__(self) -> bool:
        return self.kind is Kind.FREE


def _mover(given: Any, poses: Optional[ArrayLike], times: Optional[ArrayLike], scale: float,
           side: str) -> tuple[NDArray[Any], ...]:
    """A mover of C's, and what it points to."""
    try:
        mesh = given if isinstance(given, Mesh) else Mesh(given)
    except TypeError as error:
        raise TypeError(f"{side}: {error}") from None
    rows = [[0, 0, 0, 0, 0, 0, 1]] if poses is None else np.atleast_2d(np.asarray(poses))
    kept_poses = _array(rows, (7,), f"poses_{side}")
    kept_times = _array(np.empty(0) if times is None else times, (), f"times_{side}")
    size = abs(scale) * float(np.ptp(mesh._kept[0], axis=0).max())
    with np.errstate(invalid="ignore"):
        off = float(np.abs(kept_poses[:, :3] - np.asarray(rows)[:, :3]).max(initial=0))
    if off > 1e-4 * size and np.asarray(rows).dtype != np.float32:
        warnings.warn(f"poses_{side}: what is proven is of float32, to which rounding moves them by {off:.2g} m, which is much for "
                      f"a mesh of {size:.2g} m: subtract a common origin from all poses first, as for certify", stacklevel=3)
    if times is not None and len(kept_times) != len(kept_poses):
        raise ValueError(f"times_{side}: {len(kept_times)} of {len(kept_poses)} poses")
    out = _memory(_library.verifier_mover_size(len(mesh._kept[0])))
    _check(_library.verifier_mover_init(_address(mesh._memory), c_float(scale), _address(kept_poses),
                                        None if times is None else _address(kept_times), len(kept_poses),
                                        _address(out)), f"{side}: ")
    return out, kept_poses, kept_times, mesh._memory, *mesh._kept


def verify(certificate: Any, a: Any, b: Any, poses_a: Optional[ArrayLike] = None,
           poses_b: Optional[ArrayLike] = None, *, times_a: Optional[ArrayLike] = None,
           times_b: Optional[ArrayLike] = None, scale_a: float = 1, scale_b: float = 1, clearance: float = 0) -> Report:
    """Does a certificate, bytes or another buffer, or what has them as `bytes`, prove something of two meshes that move?

    a, b              each a Mesh, or what one is made of
    poses_a, poses_b  (k, 7) x y z in metres, unit quaternion x y z w; k may differ; one pose: it rests there; None: it
                      rests at the origin
    times_a, times_b  (k) when a mesh is at each pose, from 0 to 1, rising; None: uniform
    scale_a, scale_b  of the meshes, about their origins, 1e-6 to 1e6
    clearance         metres: what is free is never as near as this
    """
    data = memoryview(getattr(certificate, "bytes", certificate)).tobytes()
    movers = _mover(a, poses_a, times_a, scale_a, "a"), _mover(b, poses_b, times_b, scale_b, "b")
    first, second = (_address(mover[0]) for mover in movers)
    workspace = _memory(_library.verifier_workspace_size(first, second))
    told = (c_double * 5)()
    reason = _library.verifier_verify(first, second, c_float(clearance), data, len(data), _address(workspace), told)
    kind, time, named_a, named_b, position = told
    if reason is not None:
        return Report(False, reason.decode(), int(position), None, 0, 0, 0)
    return Report(True, "", int(position), _KINDS[int(kind) - 1], time, int(named_a), int(named_b))


def claim(a: Any, b: Any, poses_a: Optional[ArrayLike] = None, poses_b: Optional[ArrayLike] = None, *,
          times_a: Optional[ArrayLike] = None, times_b: Optional[ArrayLike] = None, scale_a: float = 1,
          scale_b: float = 1, clearance: float = 0) -> bytes:
    """The name of what a certificate is about, for a log of proofs: the SHA-256 of meshes, motions, scales and the
    clearance, as nsvcd_verify_claim.h has it and `verify --claims` prints it. Arguments are those of verify."""
    movers = _mover(a, poses_a, times_a, scale_a, "a"), _mover(b, poses_b, times_b, scale_b, "b")
    told = _memory(32)
    _library.verifier_claim(*(_address(mover[0]) for mover in movers), c_float(clearance), _address(told))
    return told.tobytes()[:32]
