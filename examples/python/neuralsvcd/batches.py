# SPDX-License-Identifier: MIT
"""Many questions in one call: what sweep does with them."""
from __future__ import annotations

import operator
import os
import threading
from concurrent.futures import ThreadPoolExecutor
from typing import Any, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .words import _BYS, _VERDICTS, _WHYS
from ._structs import _Answer, _Question
from ._library import _library
from .errors import _check_question
from ._arrays import _address, Floats, _floats, _memory
from .bodies import Body, _body_of
from .meshes import Mesh
from .motions import _Motion, _warn_of_rounding


class _Workspace(threading.local):
    """Memory for any question, of each thread."""

    def __init__(self) -> None:
        self.size = _library.nsvcd_sweep_workspace_size(None)
        self.memory = _memory(self.size)
        self.address = _address(self.memory)


_workspace = _Workspace()
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


def _bytes_of(rows: NDArray[Any]) -> NDArray[np.uint8]:
    """(n, itemsize): copied so, rows take a fraction of the time."""
    return rows.view((np.uint8, (rows.itemsize,)))


def _worded(c: NDArray[Any]) -> NDArray[Any]:
    """The library's answers, with words."""
    answers = np.empty(len(c), _ANSWERS)
    _bytes_of(answers)[:, :c.itemsize] = _bytes_of(c)
    for name, words in _WORDS.items():
        answers[name] = words[c[name]]
    return answers.view(np.recarray)


def _are_many(bodies: Any) -> bool:
    """A sequence of bodies, and no (vertices, faces)."""
    if not isinstance(bodies, (list, tuple)) or isinstance(bodies, Mesh):
        return False
    return len(bodies) != 2 or any(isinstance(body, (Body, str, os.PathLike)) or hasattr(body, "vertices") for body in bodies)


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

    def size(self) -> float:
        """Of the smallest."""
        bodies = [self.bodies] if isinstance(self.bodies, Body) else self.bodies
        return min((body._size for body in bodies), default=0.0) * float(np.abs(self.scales).min(initial=np.inf))

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


def _side(name: str, bodies: Any, motion: _Motion, scale: ArrayLike) -> _Side:
    given = np.asarray(scale)
    scales = _floats(given, (None,) * min(given.ndim, 1), f"scale_{name}")
    if not scales.all():
        raise ValueError(f"scale_{name}: 0")
    kept: Union[Body, list[Body]] = ([_body_of(body, name) for body in bodies] if _are_many(bodies)
                                     else _body_of(bodies, name))
    return _Side(name, kept, motion, scales)


def _first_fault(questions: NDArray[Any]) -> int:
    start, step = _address(questions), questions.itemsize
    return next(k for k in range(len(questions)) if not _library.nsvcd_sweep_workspace_size(start + k * step))


def _sweep_many(a: Any, b: Any, motions: tuple[_Motion, _Motion], scales: tuple[ArrayLike, ArrayLike], asked: Any,
                threads: int) -> NDArray[Any]:
    if operator.index(threads) < 1:
        raise ValueError(f"threads: {threads}")
    side_a = _side("a", a, motions[0], scales[0])
    side_b = _side("b", side_a.bodies if b is a else b, motions[1], scales[1])
    lengths = side_a.lengths() | side_b.lengths()
    if len(lengths) != 1:
        raise ValueError(f"how many motions are there? {sorted(lengths)}")
    questions = np.empty(lengths.pop(), _QUESTIONS)
    answers = np.empty(len(questions), _C_ANSWERS)
    if not len(questions):
        return _worded(answers)
    _bytes_of(questions)[:] = np.frombuffer(asked, np.uint8)
    side_a.write(questions["a"])
    side_b.write(questions["b"])
    size = min(side_a.size(), side_b.size())
    for side in (side_a, side_b):
        _warn_of_rounding(side.motion.given, side.motion.poses, size, f"poses_{side.name}")
    ends = np.linspace(0, len(questions), 8 * threads + 1 if threads > 1 else 2).astype(int).tolist()

    def answer(first: int, last: int) -> int:
        code = _library.nsvcd_sweep_batch(_address(questions) + first * questions.itemsize, last - first,
                                          _workspace.address, _workspace.size, _address(answers) + first * answers.itemsize)
        return int(code)
    parts = [(first, last) for first, last in zip(ends, ends[1:]) if first < last]
    if threads > 1:
        with ThreadPoolExecutor(threads) as pool:
            codes = list(pool.map(answer, *zip(*parts)))
    else:
        codes = [answer(*part) for part in parts]
    code = next(filter(None, codes), 0)
    if code:
        index = _first_fault(questions)
        _check_question(code, questions[index:index + 1], index)
    return _worded(answers)
