# SPDX-License-Identifier: MIT
"""Triangles: of files, of points, of height fields; and whatever else can stand for them."""
from __future__ import annotations

import math
import os
import sys
import warnings
from ctypes import byref, c_char_p, c_float, c_size_t, c_uint32
from pathlib import Path
from typing import Any, NamedTuple, Optional, Protocol, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .words import Code
from ._structs import _Mass, _Mesh
from ._library import _library
from .errors import _check, _check_of, Error
from ._arrays import _address, FilePath, Floats, _floats, _indices, _numeric

_OF_POINTS = {Code.SCALE: "step"}


class Mass(NamedTuple):
    """A mesh as a solid of one density: nsvcd_mass.

    volume     cubic metres
    centre     (3) float32, of mass: the pivot of what moves freely
    inertia    (3) float32, of a kilogram, square metres, about the mesh's axes through that centre; times the mass, and the scale
               squared, it is that of World.slide and Movers
    is_of_box  the mesh is open, inside out or flat, and all of this is that of its box
    """
    volume: float
    centre: Floats
    inertia: Floats
    is_of_box: bool


class Surface(Protocol):
    """What has vertices and faces: a trimesh.Trimesh, a Mesh. Of an open3d mesh, `triangles` are faces."""
    @property
    def vertices(self) -> Any: ...
    @property
    def faces(self) -> Any: ...


class Mesh(NamedTuple):
    """Triangles, counter-clockwise seen from outside. trimesh.Trimesh(*mesh) is the same there.

    vertices  (n, 3) float32, metres
    faces     (m, 3) uint32, of vertices
    """
    vertices: Floats
    faces: NDArray[np.uint32]

    @classmethod
    def load(cls, path: FilePath, scale: float = 1, origin: ArrayLike = (0, 0, 0)) -> Mesh:
        """The mesh in an OBJ, STL, PLY or GLB file. OSError if it cannot be read. Warns of what is larger than 30 m, or
        smaller than 1 mm, or far from its origin.

        scale   to metres: 0.001 of millimetres
        origin  (3) in the file's units: the place that becomes the mesh's origin, taken off in double; of a map
        """
        name = os.fspath(path)
        mesh = cls.parse(Path(path).read_bytes(), name, scale, origin)
        _warn_of_size(mesh, scale, name)
        _warn_if_far(mesh.vertices, 0, scale, origin, name)
        return mesh

    @classmethod
    def parse(cls, data: Union[str, bytes, Any], name: str = "", scale: float = 1, origin: ArrayLike = (0, 0, 0)) -> Mesh:
        """The mesh in the bytes of an OBJ, STL, PLY or GLB file, as svcd reads it: by what they are, and by the name.

        name           of the file; in an Error, which has the line at fault
        scale, origin  as `load` has them
        """
        placed = _placed(scale, origin)
        given = data.encode() if isinstance(data, str) else memoryview(data).tobytes()
        if given[:4] == b"NSVB":
            raise ValueError(f"{name}: an encoded body, no mesh: Body.load or Body.from_bytes reads it")
        mesh, form, line = _Mesh(), c_char_p(), c_size_t()
        why = _library.neuralsvcd_mesh_parse(os.fsencode(name).replace(b"\0", b""), given, len(given), _address(placed),
                                             byref(mesh), byref(form), byref(line))
        if why is None:
            return _taken(mesh)
        reason, taken_for = why.decode(), bytes(form.value or b"").decode()
        is_plain = name.lower().endswith("." + taken_for.lower())
        raise Error(_CODES.get(reason, Code.SYNTAX), name, line.value,
                    reason=reason if is_plain else f"{reason} (read as {taken_for})")

    @classmethod
    def box(cls, extents: ArrayLike) -> Mesh:
        """Of 12 triangles, about the origin. extents: (3) its lengths, metres."""
        sizes = _numeric(extents, (3,), "extents")
        if not (np.asarray(sizes) > 0).all():
            raise ValueError(f"extents: {extents!r}: they must be greater than 0")
        corners = [[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]
        faces = [[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7], [2, 7, 6], [0, 2, 6],
                 [0, 6, 4], [1, 5, 7], [1, 7, 3]]
        return cls(np.array(corners * sizes, np.float32), np.array(faces, np.uint32))

    @classmethod
    def hull(cls, points: ArrayLike) -> Mesh:
        """The convex hull of (n, 3) points, metres: a closed mesh, whose vertices are points among these: nsvcd_mesh_hull.
        Error: EMPTY (all are in one plane), NUMBER, TOO_LARGE."""
        given, mesh = _floats(points, (None, 3), "points"), _Mesh()
        _check_of(_library.nsvcd_mesh_hull(_address(given), len(given), None, byref(mesh)), _OF_POINTS)
        return _taken(mesh)

    @classmethod
    def heights(cls, heights: ArrayLike, step: ArrayLike = 1) -> Mesh:
        """A height field, to be encoded as `open`: nsvcd_mesh_of_heights. Sample [row, column] is the vertex (column * step,
        row * step, height), z up.

        heights  (rows, columns) metres; NaN: there is no sample, and so a hole
        step     metres between samples, along x and y or (2) along each
        Error: EMPTY (there is no triangle), SCALE (step), NUMBER, TOO_LARGE.
        """
        given, mesh = _floats(heights, (None, None), "heights"), _Mesh()
        steps = _floats(np.repeat(step, 2) if np.ndim(step) == 0 else step, (2,), "step")
        _check_of(_library.nsvcd_mesh_of_heights(_address(given), *given.shape, _address(steps), None, byref(mesh)), _OF_POINTS)
        return _taken(mesh)

    def mass(self) -> Mass:
        """Its volume, centre of mass and moments of inertia, exact, to rounding, if it is closed: nsvcd_mesh_mass.
        Error: EMPTY, INDEX, NUMBER."""
        mesh, mass = _c_mesh(*self), _Mass()
        _check(_library.nsvcd_mesh_mass(byref(mesh), byref(mass)))
        return Mass(mass.volume, np.array(mass.centre, np.float32), np.array(mass.inertia, np.float32), bool(mass.is_of_box))

    def cut(self, low: ArrayLike, high: ArrayLike) -> Mesh:
        """The part within a box from low (3) to high (3), metres; to be encoded as `open`. Error: EMPTY."""
        corners = _floats(low, (3,), "low"), _floats(high, (3,), "high")
        mesh, part = _c_mesh(*self), _Mesh()
        _check(_library.nsvcd_mesh_cut(byref(mesh), *map(_address, corners), None, byref(part)))
        return _taken(part)


MeshLike = Union[FilePath, Surface, tuple[ArrayLike, ArrayLike]]


def _c_mesh(vertices: ArrayLike, faces: ArrayLike) -> Any:
    kept = _floats(vertices, (None, 3), "vertices"), _indices(faces, 3, "faces")
    mesh = _Mesh(_address(kept[0]), _address(kept[1]), len(kept[0]), len(kept[1]))
    mesh.kept = kept
    return mesh


def _taken(mesh: Any) -> Mesh:
    """A copy of a mesh of the library's, which is given back."""
    def copied(address: int, rows: int, kind: Any) -> NDArray[Any]:
        return np.frombuffer((kind * (3 * rows)).from_address(address), kind).reshape(rows, 3).copy()
    try:
        return Mesh(copied(mesh.positions, mesh.vertex_count, c_float),
                    copied(mesh.indices, mesh.triangle_count, c_uint32))
    finally:
        _library.nsvcd_mesh_free(byref(mesh), None)


_CODES = {_library.nsvcd_result_string(code).decode(): code for code in Code}


def _placed(scale: float, origin: ArrayLike) -> NDArray[np.float64]:
    placed = np.array([*_numeric(origin, (3,), "origin"), scale], np.float64)
    if not np.isfinite(placed).all():
        raise ValueError(f"origin: {origin!r}" if math.isfinite(scale) else f"scale: {scale}")
    if not scale > 0:
        raise ValueError(f"scale: {scale}")
    return placed


# What others have that are no meshes here: an attribute of theirs, and what to write.
_HINTS = {"geometry": "of a trimesh.Scene, scene.to_mesh()",
          "cells_dict": "of a meshio.Mesh, (mesh.points, mesh.cells_dict['triangle'])",
          "vectors": "of numpy-stl, (mesh.vectors.reshape(-1, 3), np.arange(3 * len(mesh.vectors)).reshape(-1, 3))",
          "to_legacy": "of open3d.t, mesh.to_legacy()",
          "simplices": "of a scipy.spatial.ConvexHull, Mesh.hull(hull.points)",
          "triangulate": "of pyvista, (mesh.points, mesh.triangulate().faces.reshape(-1, 4)[:, 1:])"}


def _surface_of(given: Any, faces: Optional[ArrayLike] = None, scale: float = 1,
                origin: ArrayLike = (0, 0, 0)) -> tuple[Any, Any]:
    """Vertices and faces of what stands for a mesh."""
    if isinstance(given, (str, os.PathLike)) and faces is None:
        return Mesh.load(given, scale, origin)
    if faces is not None:
        vertices = given
    elif hasattr(given, "vertices") and (hasattr(given, "faces") or hasattr(given, "triangles")):
        vertices, faces = given.vertices, given.faces if hasattr(given, "faces") else given.triangles
    elif isinstance(given, (tuple, list)) and len(given) == 2:
        vertices, faces = given
    else:
        hint = next((f": {text}" for name, text in _HINTS.items() if hasattr(given, name)), "")
        raise TypeError(f"a mesh is a path, (vertices, faces), or what has these, like a trimesh; not {type(given).__name__}{hint}")
    placed = _placed(scale, origin)
    if (placed != [0, 0, 0, 1]).any():
        vertices = (_numeric(vertices, (None, 3), "vertices") - placed[:3]) * placed[3]
    return vertices, faces


def _warn_of_size(mesh: Mesh, scale: float, name: str, word: str = "scale=") -> None:
    """What is larger than 30 m or smaller than 1 mm is hardly meant: warned of as by `svcd info`."""
    extent = float(np.ptp(mesh.vertices, axis=0).max())
    if 0.001 <= extent <= 30:
        return
    is_large = extent > 30
    question = "are these millimetres? try" if is_large else "is it too small by a thousand? try"
    _warn(f"{name}: a body of {extent:.4g} m: {question} {word}{scale / 1000 if is_large else scale * 1000:g}")


def _warn_if_far(vertices: Floats, size: float, scale: float, origin: ArrayLike, name: str) -> None:
    """So far from its origin that floats are a millimetre apart there, as `svcd info` warns, or by much of its size, metres."""
    low, high = vertices.min(0).astype(np.float64), vertices.max(0).astype(np.float64)
    off, extent = float(np.maximum(high, -low).max()), max(float((high - low).max()), size)
    apart = off / 2 ** 23
    if (apart >= 0.001 and off >= 4 * extent) or apart > 2e-4 * extent:
        centre = np.rint((low + high) / 2 / scale + origin).tolist()
        _warn(f"{name}: {off:.4g} m from its origin, where floats are {apart:.2g} m apart: of a map? try origin={centre}, of Body "
              "or Mesh.load")


def _warn(text: str) -> None:
    """A warning about the line that called this package."""
    level, frame = 2, sys._getframe(1)
    while frame.f_back and frame.f_globals.get("__package__") == __package__:
        level, frame = level + 1, frame.f_back
    warnings.warn(text, stacklevel=level)
