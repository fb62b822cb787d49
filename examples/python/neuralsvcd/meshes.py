# SPDX-License-Identifier: MIT
"""Triangles: of files, of points, of height fields."""
from __future__ import annotations

import math
import os
import warnings
from ctypes import byref, c_char_p, c_float, c_size_t, c_uint32
from pathlib import Path
from typing import Any, NamedTuple, Union

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


class Mesh(NamedTuple):
    """Triangles, counter-clockwise seen from outside.

    vertices   (n, 3) float32, metres
    triangles  (m, 3) uint32, of vertices
    """
    vertices: Floats
    triangles: NDArray[np.uint32]

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


def _c_mesh(vertices: ArrayLike, triangles: ArrayLike) -> Any:
    kept = _floats(vertices, (None, 3), "vertices"), _indices(triangles, 3, "triangles")
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


def _parsed(parse: Any, text: Union[str, bytes], where: str) -> Mesh:
    data = text.encode() if isinstance(text, str) else bytes(text)
    mesh, line = _Mesh(), c_size_t()
    code = parse(data, len(data), None, byref(mesh), byref(line))
    if code:
        raise Error(code, where, line.value)
    return _taken(mesh)


def parse_obj(text: Union[str, bytes], where: str = "") -> Mesh:
    """The mesh that OBJ text describes. `where` names it in an Error, which has the line at fault."""
    return _parsed(_library.nsvcd_obj_parse, text, where)


def parse_stl(data: Union[str, bytes], where: str = "") -> Mesh:
    """The mesh in STL data, binary or text."""
    return _parsed(_library.nsvcd_stl_parse, data, where)


_CODES = {_library.nsvcd_result_string(code).decode(): code for code in Code}


def parse_mesh(data: Any, where: str = "", scale: float = 1, origin: ArrayLike = (0, 0, 0)) -> Mesh:
    """The mesh in the bytes of an OBJ, STL, PLY or GLB file, as svcd reads it: by what they are, and by the name.

    scale, origin  as load_mesh has them
    """
    placed = np.array([*_numeric(origin, (3,), "origin"), scale], np.float64)
    if not np.isfinite(placed).all():
        raise ValueError(f"origin: {origin!r}" if math.isfinite(scale) else f"scale: {scale}")
    if not scale > 0:
        raise ValueError(f"scale: {scale}")
    given = memoryview(data).tobytes()
    mesh, form, line = _Mesh(), c_char_p(), c_size_t()
    name = os.fsencode(where).replace(b"\0", b"")
    why = _library.neuralsvcd_mesh_parse(name, given, len(given), _address(placed), byref(mesh), byref(form),
                                         byref(line))
    if why is None:
        return _taken(mesh)
    reason, taken_for = why.decode(), bytes(form.value or b"").decode()
    is_plain = where.lower().endswith("." + taken_for.lower())
    raise Error(_CODES.get(reason, Code.SYNTAX), where, line.value,
                reason=reason if is_plain else f"{reason} (read as {taken_for})")


def load_mesh(path: FilePath, scale: float = 1, origin: ArrayLike = (0, 0, 0)) -> Mesh:
    """The mesh in an OBJ, STL, PLY or GLB file. OSError if it cannot be read.

    scale   to metres: 0.001 of millimetres
    origin  (3) in the file's units: the place that becomes the mesh's origin, taken off in double; of a map
    """
    where = os.fspath(path)
    mesh = parse_mesh(Path(path).read_bytes(), where, scale, origin)
    _warn_of_size(mesh, scale, where)
    return mesh


def _warn_of_size(mesh: Mesh, scale: float, where: str) -> None:
    """What is larger than 30 m or smaller than 1 mm is hardly meant: warned of as by `svcd info`."""
    extent = float(np.ptp(mesh.vertices, axis=0).max())
    if extent > 30:
        warnings.warn(f"{where}: a body of {extent:.4g} m: are these millimetres? try scale={scale / 1000:g}",
                      stacklevel=3)
    elif extent < 0.001:
        warnings.warn(f"{where}: a body of {extent:.4g} m: is it too small by a thousand? try scale={scale * 1000:g}",
                      stacklevel=3)


def load_stl(path: FilePath) -> Mesh:
    """The mesh in an STL file. OSError if it cannot be read."""
    return parse_stl(Path(path).read_bytes(), os.fspath(path))


def load_obj(path: FilePath) -> Mesh:
    """The mesh in an OBJ file. OSError if it cannot be read."""
    return parse_obj(Path(path).read_bytes(), os.fspath(path))


def cut_mesh(vertices: ArrayLike, triangles: ArrayLike, low: ArrayLike, high: ArrayLike) -> Mesh:
    """The part of a mesh within a box from low (3) to high (3), metres; to be encoded as `open`."""
    corners = _floats(low, (3,), "low"), _floats(high, (3,), "high")
    mesh, part = _c_mesh(vertices, triangles), _Mesh()
    _check(_library.nsvcd_mesh_cut(byref(mesh), *map(_address, corners), None, byref(part)))
    return _taken(part)
