# SPDX-License-Identifier: MIT
"""Answers that are proven to others."""
from __future__ import annotations

import contextlib
import ctypes
from collections.abc import Sequence
from ctypes import byref, c_void_p
from typing import Any, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike

from .words import NO_TRIANGLE, _number_of, Verdict, _VERDICTS, Why, _WHYS
from ._structs import _Answer, _Certificate, _CertifyOptions
from ._library import _library
from .errors import _check, Error
from ._arrays import _address, _filled, _memory
from .bodies import Body
from .meshes import _c_mesh, Mesh, MeshLike, _surface_of
from .answers import Answer
from .motions import _Motion
from .sweeps import _motions, _question, _question_of, sweep


class Tree:
    """A mesh as certify takes it: nsvcd_tree. It does not change; threads may share it; it can be pickled and copied.

    mesh, faces  as Body has them: a path, (vertices, faces), or what has these
    """

    __slots__ = ("_mesh", "_memory", "_address", "_size", "_body")

    def __init__(self, mesh: Union[MeshLike, ArrayLike], faces: Optional[ArrayLike] = None) -> None:
        self._mesh = _c_mesh(*_surface_of(mesh, faces))
        vertices = self._mesh.kept[0]
        self._size = float(np.linalg.norm(np.ptp(vertices, axis=0))) if len(vertices) else 0.0
        size = _library.nsvcd_tree_size(byref(self._mesh))
        self._memory = _memory(size)
        tree = c_void_p()
        _check(_library.nsvcd_tree_build(byref(self._mesh), _address(self._memory), size, byref(tree)))
        self._address = tree.value
        self._body: Optional[Body] = None  # encoded when it is asked about

    def __reduce__(self) -> tuple[Any, ...]:
        return Tree, self._mesh.kept


TreeLike = Union[Tree, Body, MeshLike]


def _tree_of(given: Any, name: str) -> Tree:
    if isinstance(given, Tree):
        return given
    if isinstance(given, Body):
        if given.mesh is None or given.facts.convex_radius:
            raise TypeError(f"{name}: a Body that came from bytes, or is round, has no mesh to prove something of")
        return Tree(given.mesh)
    try:
        return Tree(given)
    except TypeError as error:
        raise TypeError(f"{name}: a Tree or a mesh is needed: {error}") from None


def _body_to_ask(given: Any) -> Optional[Body]:
    """None: it cannot be asked about, and a Tree says why."""
    try:
        if isinstance(given, Tree):
            given._body = body = given._body or Body(Mesh(*given._mesh.kept))
        else:
            body = given if isinstance(given, Body) else Body(given)
    except (Error, TypeError):
        return None
    return body if body.facts.stored_triangles else None


def _looked_at(bodies: Sequence[Optional[Body]], motions: tuple[_Motion, _Motion], scale_a: float, scale_b: float,
                  clearance: float) -> Optional[Answer]:
    """Where certify looks first. What is refused, it refuses itself."""
    if bodies[0] is None or bodies[1] is None:
        return None
    poses, times = ([motion[k] for motion in motions] for k in (0, 1))
    with contextlib.suppress(Error):
        answer: Answer = sweep(bodies[0], bodies[1], *poses, times_a=times[0], times_b=times[1], scale_a=scale_a, scale_b=scale_b,
                               clearance=clearance)
        return answer
    return None


class Certificate(NamedTuple):
    """What was proven: nsvcd_certificate.

    verdict  free or hit: the bytes prove it; undecided: there are none
    why      ... since the visits were spent, or they come too near to tell
    inside   a hit, for a corner of one is inside of the other
    time     in [0, 1], of a hit: a contact, which need not be the first
    bytes    the proof, for nsvcd_verify and examples/verify
    visits   steps that were taken
    """
    verdict: Verdict
    why: Why
    inside: bool
    time: float
    bytes: bytes
    visits: int


def certify(a: TreeLike, b: TreeLike, poses_a: Optional[ArrayLike] = None, poses_b: Optional[ArrayLike] = None, *,
            times_a: Optional[ArrayLike] = None, times_b: Optional[ArrayLike] = None, scale_a: float = 1,
            scale_b: float = 1, clearance: float = 0, answer: Optional[Answer] = None, visits: int = 0) -> Certificate:
    """Do two meshes hit each other? Poses, times and scales as sweep has them; what is answered is proven to others.

    a, b       each a Tree, a Body that was made of a mesh, or what stands for a mesh; whoever checks needs body.mesh
    clearance  metres: to come as near as this is a hit
    answer     of sweep, where a hit is looked for first; it is not believed, but if its why is open, nothing is free.
               None: certify asks first, of meshes that are encoded for that: to certify many motions, give Bodies or
               Trees
    visits     steps that may be taken; 1000000
    """
    bodies = [None if answer is not None else _body_to_ask(given) for given in (a, b)]
    trees = [_tree_of(given if body is None or isinstance(given, Tree) else body, name)
             for given, body, name in zip((a, b), bodies, "ab")]
    motions = _motions(poses_a, poses_b, times_a, times_b)
    question = _question(trees, motions, scale_a, scale_b, _question_of(clearance=clearance))
    options = _filled(_CertifyOptions, visits=visits)
    if answer is None:
        answer = _looked_at(bodies, motions, scale_a, scale_b, clearance)
    if answer is not None:
        named = answer.nearest
        triangles = (NO_TRIANGLE if k is None else k for k in (named.triangle_a, named.triangle_b))
        told = _Answer(verdict=_number_of(answer.verdict), why=_number_of(answer.why), inside=answer.inside)
        told.time.low, told.time.high = answer.time
        told.nearest.time, (told.nearest.triangle_a, told.nearest.triangle_b) = named.time, triangles
        options.answer = ctypes.addressof(told)
    size = _library.nsvcd_certify_workspace_size(byref(question), trees[0]._address, trees[1]._address)
    workspace = _memory(size)
    made = _Certificate(size=1 << 20)  # more than most take
    room = 0
    while room < made.size:
        room = made.size
        data = _memory(room)
        _check(_library.nsvcd_certify(byref(question), trees[0]._address, trees[1]._address, byref(options), _address(workspace),
                                      size, _address(data), room, byref(made)))
    return Certificate(_VERDICTS[made.verdict], _WHYS[made.why], bool(made.inside), made.time,
                       data[:made.size].tobytes(), made.visits)
