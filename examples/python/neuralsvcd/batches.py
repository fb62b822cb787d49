# SPDX-License-Identifier: MIT
"""Many questions in one call."""
from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .words import _BYS, _VERDICTS, _WHYS
from ._structs import _Answer, _Question
from ._library import _library
from .errors import _check_question
from ._arrays import _address, Floats, _floats
from .bodies import Body, _body_of, BodyLike
from .meshes import Mesh
from .motions import _Motion, _motion
from .sweeps import _asked, _workspace

_WORDS = {"verdict": np.array(_VERDICTS, str), "by": np.array(_BYS, str), "why": np.array(_WHYS, str)}
_FLAGS = ("inside", "asked", "limited")


def _with_flags(plain: np.dtype[Any]) -> np.dtype[Any]:
    """With a bool for ints that are 0 or 1: their first byte on a little-endian machine, as bodies demand one. So they
    can choose rows."""
    if plain.subdtype:
        return np.dtype((_with_flags(plain.subdtype[0]), plain.shape))
    if not plain.names or not plain.fields:
        return plain
    formats = ["?" if name in _FLAGS else _with_flags(plain.fields[name][0]) for name in plain.names]
    return np.dtype({"names": plain.names, "formats": formats, "itemsize": plain.itemsize,
                     "offsets": [plain.fields[name][1] for name in plain.names]})


def _answers_type() -> np.dtype[Any]:
    """nsvcd_answer for numpy, and behind it the words for its first numbers."""
    plain = _with_flags(np.dtype(_Answer))
    assert plain.names and plain.fields
    formats, offsets, size = [], [], plain.itemsize
    for name in plain.names:
        if name in _WORDS:
            formats.append(_WORDS[name].dtype)
            offsets.append(size)
            size += formats[-1].itemsize
        else:
            formats.append(plain.fields[name][0])
            offsets.append(plain.fields[name][1])
    return np.dtype({"names": plain.names, "formats": formats, "offsets": offsets, "itemsize": -(-size // 8) * 8})


_QUESTIONS = np.dtype(_Question)
_C_ANSWERS = np.dtype(_Answer)
_ANSWERS = _answers_type()


def _worded(c: NDArray[Any]) -> NDArray[Any]:
    """The library's answers, with words."""
    answers = np.zeros(len(c), _ANSWERS)
    if len(c):
        size = _C_ANSWERS.itemsize
        answers.view(np.uint8).reshape(len(c), -1)[:, :size] = c.view(np.uint8).reshape(len(c), size)
    for name, words in _WORDS.items():
        answers[name] = words[c[name]]
    return answers


Bodies = Union[BodyLike, Sequence[BodyLike]]


def _are_many(bodies: Any) -> bool:
    """A sequence of bodies, and no (vertices, faces)."""
    if not isinstance(bodies, (list, tuple)) or isinstance(bodies, Mesh):
        return False
    return len(bodies) != 2 or any(isinstance(body, (Body, str, os.PathLike)) or hasattr(body, "faces") for body in bodies)


class _Side(NamedTuple):
    """Body a or body b of all questions of a batch; each one, or one for each question."""
    name: str
    bodies: Union[Body, list[Body]]
    motion: _Motion
    scales: Floats

    def lengths(self) -> set[int]:
        lengths = set() if isinstance(self.bodies, Body) else {len(self.bodies)}
        lengths.update(len(each) for each, one in zip(self.motion, (2, 1)) if each is not None and each.ndim > one)
        if self.scales.ndim == 1:
            lengths.add(len(self.scales))
        return lengths

    def write(self, movers: NDArray[Any]) -> None:
        bodies = [self.bodies] if isinstance(self.bodies, Body) else self.bodies
        movers["body"] = [body._address for body in bodies]
        movers["scale"] = self.scales
        for field, given, one in zip(("poses", "times"), self.motion, (2, 1)):
            if given is not None:
                step = given.strides[0] if given.ndim > one else 0
                movers[field] = _address(given) + step * np.arange(len(movers), dtype=np.uintp)
        if self.motion.poses is not None:
            movers["count"] = self.motion.poses.shape[-2]


def _side(name: str, bodies: Any, poses: Optional[ArrayLike], times: Optional[ArrayLike],
          scale: ArrayLike) -> _Side:
    given = np.asarray(scale)
    scales = _floats(given, (None,) * min(given.ndim, 1), f"scale_{name}")
    if not scales.all():
        raise ValueError(f"scale_{name}: 0")
    kept: Union[Body, list[Body]] = ([_body_of(body, name) for body in bodies] if _are_many(bodies)
                                     else _body_of(bodies, name))
    return _Side(name, kept, _motion(poses, times, name, batch=True), scales)


def _first_fault(questions: NDArray[Any]) -> int:
    start, step = _address(questions), questions.itemsize
    return next(k for k in range(len(questions)) if not _library.nsvcd_sweep_workspace_size(start + k * step))


def sweep_batch(a: Bodies, b: Bodies, poses_a: Optional[ArrayLike] = None, poses_b: Optional[ArrayLike] = None, *,
                times_a: Optional[ArrayLike] = None, times_b: Optional[ArrayLike] = None,
                scale_a: ArrayLike = 1, scale_b: ArrayLike = 1,
                ask: str = "hit", to: float = 0, to_time: float = 0, clearance: float = 0, slop: float = 0,
                tolerance: float = 0, manifold: bool = False, surfaces: bool = False, method: str = "default",
                work: int = 0, segments: int = 0, pairs: int = 0, model: str = "default", precision: str = "float",
                recall: float = 0, inflate: float = 0) -> NDArray[Any]:
    """Answers n questions in one call of the library, one after the other.

    a, b              a body, or what stands for a mesh, for all, or a sequence of n
    poses_a, poses_b  (n, k, 7), or (k, 7) for all, or None
    times_a, times_b  (n, k), or (k) for all, or None
    scale_a, scale_b  (n), or a number for all

    Returns a structured array (n) with the fields of nsvcd_answer: answers["verdict"] == "hit" is an array of bool,
    answers["time"]["high"] one of floats, of the first contacts of ask="first". Of answers["contacts"],
    (n, 4), each has contact_count; triangles may be NO_TRIANGLE; answers["opinion"]["asked"] says whether there is one.
    One after another on the same two bodies: the network is first asked where the motion before collided; see
    nsvcd_sweep_batch.
    """
    side_a, side_b = _side("a", a, poses_a, times_a, scale_a), _side("b", b, poses_b, times_b, scale_b)
    if poses_b is poses_a and times_b is times_a:
        side_b = side_b._replace(motion=side_a.motion)  # as in _question
    lengths = side_a.lengths() | side_b.lengths()
    if len(lengths) != 1:
        raise ValueError(f"lengths differ: {sorted(lengths)}" if lengths else "nothing says how many motions there are")
    questions = np.empty(lengths.pop(), _QUESTIONS)
    answers = np.zeros(len(questions), _C_ANSWERS)
    if not len(questions):
        return _worded(answers)
    questions[:] = np.frombuffer(_asked(
        ask, to, to_time, clearance, slop, tolerance, manifold, surfaces, method, work, segments, pairs, model,
        precision, recall, inflate), _QUESTIONS)[0]
    side_a.write(questions["a"])
    side_b.write(questions["b"])
    code = _library.nsvcd_sweep_batch(_address(questions), len(questions), _workspace.address, _workspace.size,
                                      _address(answers))
    if code:
        index = _first_fault(questions)
        _check_question(code, questions[index:index + 1], index)
    return _worded(answers)
