# SPDX-License-Identifier: MIT
"""Bodies: meshes, encoded for questions."""
from __future__ import annotations

import ctypes
import functools
import operator
import os
from collections.abc import Callable
from ctypes import byref, c_float, c_void_p
from pathlib import Path
from typing import Any, cast, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .words import Code
from ._structs import _EncodeOptions, _PROGRESS
from ._library import _library
from .errors import _check, _check_of, Error
from ._arrays import _address, _cancels, FilePath, _filled, _floats, _memory, _number, _numeric, _vector, Vector
from .meshes import _c_mesh, Mesh, MeshLike, _surface_of, _warn, _warn_if_far


def _check_radius(radius: float) -> None:
    if not radius > 0:
        raise Error(Code.RADIUS, "radius")


class Facts(NamedTuple):
    """What a body is: nsvcd_body_facts.

    size               bytes
    patches            parts of its surface
    centre, radius     of a sphere that contains it, metres
    extent             no point of the mesh is farther from the origin, metres
    low, high          a box that contains the mesh, metres; zeros: no triangles are stored
    mean_patch_radius  metres
    triangles          of the mesh; 0: none are stored
    stored_triangles           triangles and parts of them that are stored
    quantization_error            0: answers are about the mesh's own floats; else triangles are within this of its, metres
    convex_radius              how far it goes beyond its mesh, metres
    balls              that cover it, for routes; 0: none are stored
    ball_error         no point of a ball is farther than this from the body, metres
    latents            the network can answer
    components         parts of the surface
    open_components    of these: not closed, once what does no harm is mended; 0: it is a solid
    open_edges         of these
    open               it was said to be open
    """
    size: int
    patches: int
    centre: Vector
    radius: float
    extent: float
    low: Vector
    high: Vector
    mean_patch_radius: float
    triangles: int
    stored_triangles: int
    quantization_error: float
    convex_radius: float
    balls: int
    ball_error: float
    latents: bool
    components: int
    open_components: int
    open_edges: int
    open: bool


class Body:
    """An encoded mesh, or a shape: Body.box, sphere, capsule, cloud, hull. It does not change; threads may share it; it
    can be pickled and copied.

    mesh          the path of an OBJ, STL, PLY or GLB file; (vertices, faces), (n, 3) metres and (m, 3) integers; what has
                  these, like a Mesh or a trimesh.Trimesh
    faces         (m, 3), where vertices are given before: Body(vertices, faces)
    scale         to metres: 0.001 of millimetres
    origin        (3) before scaling: the place that becomes the mesh's origin, taken off in double; of a map
    patches       1 to 65536; 0: by the number of triangles
    patch_radius  metres; with patches = 0: as many as have about this radius; 0: unasked
    convex_radius  the body is all that is within so many metres of the mesh. If > 0, triangles may be points (one vertex
                  thrice) and segments, and there are no latents
    open          the mesh is not closed: nothing counts as inside it
    latents       for the network, the planner and gradients too
    no_triangles  for them alone
    balls         up to 1024 of them cover the mesh, for routes by looks: 128 suit a robot's link; 0: none
    coarse        in fewer bytes: answers are then about triangles within facts.quantization_error of the mesh's
    progress      called now and then with what is done, in [0, 1]. If it returns something true, Error(CANCELLED);
                  what it raises ends the encoding

    Encoding takes far longer than a question: what is asked about again is to be kept. The mesh is kept too, as `mesh`.
    """

    __slots__ = ("_memory", "_address", "_mesh", "_size", "__weakref__")
    _memory: NDArray[np.uint8]
    _address: int
    _mesh: Optional[Mesh]
    _size: float  # metres, of a ball about it

    def __init__(self, mesh: Union[MeshLike, ArrayLike], faces: Optional[ArrayLike] = None, *, scale: float = 1,
                 origin: ArrayLike = (0, 0, 0), patches: int = 0, patch_radius: float = 0, convex_radius: float = 0,
                 open: bool = False, latents: bool = False, no_triangles: bool = False, coarse: bool = False,
                 balls: int = 0, progress: Optional[Callable[[float], Any]] = None) -> None:
        c_mesh = _c_mesh(*_surface_of(mesh, faces, scale, origin))
        options = _filled(_EncodeOptions, patches=patches, patch_radius=patch_radius, convex_radius=convex_radius, open=open,
                          latents=latents, no_triangles=no_triangles, coarse=coarse, balls=balls)
        caught: list[BaseException] = []
        if progress:
            options.progress = _PROGRESS(functools.partial(_cancels, progress, caught))
        body = c_void_p()
        code = _library.nsvcd_encode(byref(c_mesh), byref(options), None, None, 0, byref(body))
        if caught:
            raise caught[0]
        _check(code)
        self._take(body, Mesh(*c_mesh.kept))
        is_file = isinstance(mesh, (str, os.PathLike))
        if not is_file:
            _warn_if_far(c_mesh.kept[0], self._size, scale, origin, "mesh")
        if is_file and not open and self.facts.open_edges:
            _warn(f"{os.fspath(cast(FilePath, mesh))}: not a closed surface: {self.facts.open_edges} open edges; what is inside of it is not known "
                  "to be inside; open=True says that it is a sheet")

    @classmethod
    def box(cls, extents: ArrayLike, convex_radius: float = 0) -> Body:
        """A box about the origin. extents: (3) its lengths, metres; convex_radius: of its edges, which are rounded within
        that. One with latents or balls is Body(Mesh.box(extents), ...). Error: RADIUS, NUMBER."""
        half, body = _floats(np.divide(_numeric(extents, (3,), "extents"), 2), (3,), "extents"), c_void_p()
        if not (half > 0).all():
            raise ValueError(f"extents: {extents!r}: they must be greater than 0")
        _check_of(_library.nsvcd_encode_box(_address(half), _number(c_float, convex_radius, "convex_radius"), None,
                                            byref(body)), {Code.RADIUS: "convex_radius"})
        self = cls.__new__(cls)
        self._take(body, Mesh.box(extents) if not convex_radius else None)
        return self

    @classmethod
    def sphere(cls, radius: float) -> Body:
        """A ball about the origin; metres. Error: RADIUS."""
        _check_radius(radius)
        return cls([[0, 0, 0]], [[0, 0, 0]], convex_radius=radius)

    @classmethod
    def capsule(cls, start: ArrayLike, end: ArrayLike, radius: float) -> Body:
        """All that is within a radius of a segment, metres. start, end: (3). Error: RADIUS, NUMBER."""
        _check_radius(radius)
        ends = [_numeric(end, (3,), name) for end, name in ((start, "start"), (end, "end"))]
        return cls(np.array(ends), [[0, 1, 1]], convex_radius=radius)

    @classmethod
    def cloud(cls, points: ArrayLike, radius: float) -> Body:
        """All that is within a radius of (n, 3) points, metres. Error: RADIUS, NUMBER, EMPTY."""
        _check_radius(radius)
        count = len(_numeric(points, (None, 3), "points"))
        return cls(points, np.repeat(np.arange(count), 3).reshape(-1, 3), convex_radius=radius)

    @classmethod
    def hull(cls, points: ArrayLike) -> Body:
        """The convex hull of (n, 3) points, metres; as Mesh.hull."""
        return cls(Mesh.hull(points))

    def _take(self, body: Any, mesh: Optional[Mesh]) -> None:
        """A copy of a body of the library's, which is given back."""
        try:
            size = _library.nsvcd_body_describe(body).size
            memory = _memory(size)
            ctypes.memmove(_address(memory), body, size)
        finally:
            _library.nsvcd_body_free(body, None)
        self._keep(memory, mesh)

    def _keep(self, memory: NDArray[np.uint8], mesh: Optional[Mesh] = None) -> None:
        for array in mesh or ():
            array.flags.writeable = False
        self._mesh = mesh
        self._address = _address(memory)
        memory.flags.writeable = False
        self._memory = memory
        self._size = 2 * _library.nsvcd_body_describe(self._address).radius

    @classmethod
    def from_bytes(cls, data: Any) -> Body:
        """A body from what bytes(body) gave, or any other buffer. Every byte is checked; the buffer is not kept."""
        given = memoryview(data).cast("B")
        memory = _memory(len(given))
        memory[:] = given
        body = c_void_p()
        _check(_library.nsvcd_body_load(_address(memory), len(memory), byref(body)))
        self = cls.__new__(cls)
        self._keep(memory[:_library.nsvcd_body_describe(body).size])
        return self

    @classmethod
    def load(cls, path: FilePath) -> Body:
        """A body from a file of save, or of `svcd encode`."""
        return cls.from_bytes(Path(path).read_bytes())

    def save(self, path: FilePath) -> None:
        """Writes the body into a file."""
        Path(path).write_bytes(self._memory.data)

    def __bytes__(self) -> bytes:
        return self._memory.tobytes()

    def __reduce__(self) -> tuple[Any, ...]:
        return Body.from_bytes, (bytes(self),)

    def __repr__(self) -> str:
        return f"<neuralsvcd.Body: {self.facts.patches} patches, {self.facts.size} bytes>"

    def scaled(self, scale: ArrayLike) -> Body:
        """A copy, scaled about the origin: by one factor, of which a question needs no copy, or by (3), one along each axis.
        Factors that differ stretch it, and negative ones mirror; then it has no latents.
        Error: SCALE (a 0, too small or large; or a stretched body has a convex radius), TRIANGLES (it has none)."""
        memory = _memory(len(self._memory))
        scaled = c_void_p()
        factors = _floats(np.repeat(scale, 3) if np.ndim(scale) == 0 else scale, (3,), "scale")
        _check(_library.nsvcd_body_scale(self._address, _address(factors), _address(memory), len(memory), byref(scaled)))
        body = Body.__new__(Body)
        mesh = self._mesh
        if mesh:
            mesh = Mesh(mesh.vertices * factors, mesh.faces[:, ::-1] if np.prod(factors) < 0 else mesh.faces)
        body._keep(memory, mesh)
        return body

    @property
    def mesh(self) -> Optional[Mesh]:
        """What it was made of, as float32, to be drawn or certified; None: it came from bytes, or has rounded edges."""
        return self._mesh

    @property
    def facts(self) -> Facts:
        facts = _library.nsvcd_body_describe(self._address)
        return Facts(facts.size, facts.patches, _vector(facts.centre), facts.radius, facts.extent,
                     _vector(facts.low), _vector(facts.high), facts.mean_patch_radius,
                     facts.triangles, facts.stored_triangles, facts.quantization_error, facts.convex_radius,
                     facts.balls, facts.ball_error, bool(facts.latents), facts.components, facts.open_components, facts.open_edges,
                     bool(facts.open))

    def patch(self, index: int) -> tuple[Vector, float]:
        """Centre and radius of the sphere about a patch, metres, body frame."""
        if not 0 <= operator.index(index) < self.facts.patches:
            raise IndexError(f"no patch {index}")
        centre, radius = (c_float * 3)(), c_float()
        _library.nsvcd_body_patch(self._address, index, byref(centre), byref(radius))
        return _vector(centre), radius.value


BodyLike = Union[Body, MeshLike]


def _body_of(given: Any, name: str) -> Body:
    """A body, or one of what stands for a mesh; encoded here."""
    if isinstance(given, Body):
        return given
    try:
        return Body(given)
    except TypeError as error:
        raise TypeError(f"{name}: a Body or a mesh is needed: {error}") from None
