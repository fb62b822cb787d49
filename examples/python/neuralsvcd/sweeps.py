# SPDX-License-Identifier: MIT
"""Questions about two bodies."""
from __future__ import annotations

import functools
from collections.abc import Sequence
from ctypes import byref, c_float, c_int, c_size_t
from typing import Any, NamedTuple, Optional, Union, cast, overload

import numpy as np
from numpy.typing import ArrayLike

from .words import Ask, _AskWord, Method, _MethodWord, Model, _ModelWord, Precision, _PrecisionWord
from ._structs import _Answer, _Contact, _MAX_CONTACTS, _NetworkOptions, _Question
from ._library import _library
from .errors import _check_question
from ._arrays import _address, _filled, Floats, _memory
from .bodies import Body, _body_of, BodyLike
from .motions import _Motion, _motion, _warn_of_rounding
from .batches import _are_many, _sweep_many, _workspace
from .answers import Answer, _answer_of, Contact, _CONTACT, _contact_of


def _question_of(ask: str = "hit", to: float = 0, to_time: float = 0, clearance: float = 0, slop: float = 0,
                 tolerance: float = 0, manifold: bool = False, surfaces: bool = False, method: str = "default",
                 work: int = 0, segments: int = 0, pairs: int = 0, model: str = "default", precision: str = "float",
                 recall: float = 0, inflate: float = 0) -> Any:
    """nsvcd_question but for its movers. It is shared, and to be copied."""
    words: dict[str, Any] = {}
    for name, kind, given in (("ask", Ask, ask), ("method", Method, method), ("model", Model, model),
                              ("precision", Precision, precision)):
        if given not in set(kind):
            raise ValueError(f"{name}: {given!r} is none of {', '.join(kind)}")
        words[name] = kind(given)
    question = _filled(_Question, ask=words["ask"], to=to, to_time=to_time, clearance=clearance, slop=slop,
                       tolerance=tolerance, manifold=bool(manifold), surfaces=bool(surfaces), method=words["method"],
                       work=work, segments=segments)
    question.network = _filled(_NetworkOptions, pairs=pairs, model=words["model"], precision=words["precision"],
                               recall=recall, inflate=inflate)
    return question


_kept = functools.lru_cache(maxsize=256, typed=True)(_question_of)


def _asked(*given: Any) -> Any:
    """As _question_of; most ask the same again and again."""
    try:
        return _kept(*given)
    except TypeError:  # what has no hash, or is no number
        return _question_of(*given)


def _mover(address: Any, motion: _Motion, scale: float, side: str) -> Any:
    factor = c_float(scale)
    if not factor.value:
        raise ValueError(f"scale_{side}: {scale}")  # in C that is 1
    if motion.poses is None:
        return address, None, 0, None, factor
    times = None if motion.times is None else _address(motion.times)
    return address, _address(motion.poses), len(motion.poses), times, factor


def _motions(poses_a: Optional[ArrayLike], poses_b: Optional[ArrayLike], times_a: Optional[ArrayLike],
             times_b: Optional[ArrayLike], one: bool = True) -> tuple[_Motion, _Motion]:
    motion = _motion(poses_a, times_a, "_a", one=one)
    # The same arrays twice are the same motion, which the library refuses of one body.
    return motion, (motion if poses_b is poses_a and times_b is times_a else _motion(poses_b, times_b, "_b", one=one))


def _question(bodies: Sequence[Any], motions: tuple[_Motion, _Motion], scale_a: float, scale_b: float, asked: Any) -> Any:
    """bodies: two, or Trees, which are none of the library's."""
    question = _Question.from_buffer_copy(asked)
    a, b = (body._address if isinstance(body, Body) else None for body in bodies)
    question.a = _mover(a, motions[0], scale_a, "a")
    question.b = _mover(b, motions[1], scale_b, "b")
    size = min(bodies[0]._size * abs(scale_a), bodies[1]._size * abs(scale_b))
    _warn_of_rounding(motions[0].given, motions[0].poses, size, "poses_a")
    _warn_of_rounding(motions[1].given, motions[1].poses, size, "poses_b")
    question.kept = motions, bodies
    return question


def _two_bodies(a: Any, b: Any) -> tuple[Body, Body]:
    first = _body_of(a, "a")
    return first, first if b is a else _body_of(b, "b")


_One = Union[None, Sequence[float], Sequence[Sequence[float]]]  # of which a type tells that it is no more than one motion


@overload
def sweep(a: BodyLike, b: BodyLike, poses_a: _One = ..., poses_b: _One = ..., *, times_a: Optional[Sequence[float]] = ...,
          times_b: Optional[Sequence[float]] = ..., scale_a: float = ..., scale_b: float = ..., ask: _AskWord = ..., to: float = ...,
          to_time: float = ..., clearance: float = ..., slop: float = ..., tolerance: float = ..., manifold: bool = ...,
          surfaces: bool = ..., method: _MethodWord = ..., work: int = ..., segments: int = ..., pairs: int = ...,
          model: _ModelWord = ..., precision: _PrecisionWord = ..., recall: float = ..., inflate: float = ...,
          threads: int = ...) -> Answer: ...


@overload
def sweep(a: Union[BodyLike, Sequence[BodyLike]], b: Union[BodyLike, Sequence[BodyLike]], poses_a: Optional[ArrayLike] = ...,
          poses_b: Optional[ArrayLike] = ..., *, times_a: Optional[ArrayLike] = ..., times_b: Optional[ArrayLike] = ...,
          scale_a: ArrayLike = ..., scale_b: ArrayLike = ..., ask: _AskWord = ..., to: float = ..., to_time: float = ...,
          clearance: float = ..., slop: float = ..., tolerance: float = ..., manifold: bool = ..., surfaces: bool = ...,
          method: _MethodWord = ..., work: int = ..., segments: int = ..., pairs: int = ..., model: _ModelWord = ...,
          precision: _PrecisionWord = ..., recall: float = ..., inflate: float = ..., threads: int = ...) -> Any: ...


def sweep(a: Union[BodyLike, Sequence[BodyLike]], b: Union[BodyLike, Sequence[BodyLike]],
          poses_a: Optional[ArrayLike] = None, poses_b: Optional[ArrayLike] = None, *,
          times_a: Optional[ArrayLike] = None, times_b: Optional[ArrayLike] = None, scale_a: ArrayLike = 1,
          scale_b: ArrayLike = 1,
          ask: _AskWord = "hit", to: float = 0, to_time: float = 0, clearance: float = 0, slop: float = 0,
          tolerance: float = 0, manifold: bool = False, surfaces: bool = False, method: _MethodWord = "default",
          work: int = 0, segments: int = 0, pairs: int = 0, model: _ModelWord = "default", precision: _PrecisionWord = "float",
          recall: float = 0, inflate: float = 0,
          threads: int = 1) -> Any:
    """Do two bodies hit each other? And when first: ask="first". Of many motions at once: the same, in one call.

    a, b              each a Body, or what stands for a mesh, which is encoded for this call alone: see Body
    poses_a, poses_b  how it moves: (k, 7) x y z in metres, unit quaternion x y z w; (k, 3) positions; or rigid matrices
                      (k, 4, 4); k may differ. One pose, (7), (3) or (4, 4): it rests there; None: it rests at the origin
    times_a, times_b  (k) when it is at each pose, from 0 to 1, rising; None: uniform
    scale_a, scale_b  of the bodies, about their origins, 1e-6 to 1e6

    What is asked, and how; of what is 0 the default is behind the semicolon:
    ask         hit: do they hit at all? first: and when first? distance: and how near do they come? These take some 4 and
                15 times as long
    to          metres. first: nothing moves farther than this from time.low to time.high; distance: how wide the
                bracket may be, to float rounding, some 2e-6 of how large and how far apart they are; a thousandth of the
                smaller body's radius
    to_time     first: the same as a share of the motion, up to 1
    clearance   metres: to come as near as this is a hit
    slop        metres: a contact at the start that is no deeper does not count
    tolerance   metres: what comes closer and does not meet may be left undecided
    manifold    first: up to four contacts, which hold the body, are told, where else one is
    surfaces    of the surfaces alone: what lies inside the other body, off its surface, is free of it
    method      proof where both bodies have triangles, else network, which knows neither first, nor a clearance or a
                slop, and of a distance, where it is named, has an opinion: Answer.opinion.distance
    work        units that a proof may take; 10000000, of a distance 100000
    segments    a motion is cut into at most so many, a multiple of 16 up to 64; 64
    pairs       network: of patches that it looks at, 1 to 256; 8
    model       network: its decoder: tiny, small or base; precision: float or int8; recall: 0, 0.99, 0.999 or 0.9999
    inflate     network: of patches, a share of their radii, so that the logit rises before contact; of a distance 1

    Returns an Answer. Many motions are (n, k, 7), (n, k, 3) or (n, k, 4, 4), times (n, k), scales (n), bodies a sequence of
    n; what there is one of goes with each. The answer is then an array of n records with the fields of Answer, by name or
    as attributes: (answers.verdict == "hit").sum(), answers.time.high, answers[0].safe.a. What differs: of contacts,
    (n, 4), each has contact_count; a pose is position and rotation; triangles may be NO_TRIANGLE;
    answers.opinion.asked says whether there is one. All are answered in one call of the library, without the
    interpreter's lock, one after the other or by so many `threads`. By the network, what a motion before collided with is
    looked at first, so that opinions may depend on how many there are.

    Error: what is refused, with `where`, of many with the `index` of the first. ValueError: shapes.
    """
    asked = _asked(ask, to, to_time, clearance, slop, tolerance, manifold, surfaces, method, work, segments, pairs, model,
                   precision, recall, inflate)
    motions = _motions(poses_a, poses_b, times_a, times_b, one=False)
    if any(motion.are_many() for motion in motions) or any(_are_many(body) for body in (a, b)) or any(
            not isinstance(scale, (int, float)) and np.ndim(scale) for scale in (scale_a, scale_b)):
        return _sweep_many(a, b, motions, (scale_a, scale_b), asked, threads)
    question = _question(_two_bodies(a, b), motions, cast(float, scale_a), cast(float, scale_b), asked)
    answer = _Answer()
    code = _library.nsvcd_sweep(byref(question), _workspace.address, _workspace.size, byref(answer))
    _check_question(code, question)
    return _answer_of(answer)


_MOST_CONTACTS = 6 * _MAX_CONTACTS  # NSVCD_MAX_SIDES


def contacts(a: BodyLike, b: BodyLike, pose_a: Optional[ArrayLike] = None, pose_b: Optional[ArrayLike] = None, *, clearance: float,
             scale_a: float = 1, scale_b: float = 1) -> tuple[list[Contact], bool]:
    """Where are two bodies at rest near each other, on all sides? Up to four contacts on each of six, those of the nearest side
    first; and whether some may be missing.

    pose_a, pose_b  (7), (3) or (4, 4), as of sweep; None: it is at the origin
    clearance       metres: how near counts
    """
    motions = _motions(pose_a, pose_b, None, None)
    if any(motion.poses is not None and len(motion.poses) > 1 for motion in motions):
        raise ValueError("pose_a, pose_b: one pose is needed, not a motion")
    question = _question(_two_bodies(a, b), motions, scale_a, scale_b, _question_of(clearance=clearance))
    rows, count, is_partial = (_Contact * _MOST_CONTACTS)(), c_size_t(), c_int()
    code = _library.nsvcd_contacts(byref(question), _workspace.address, _workspace.size, rows, _MOST_CONTACTS, byref(count),
                                   byref(is_partial))
    _check_question(code, question)
    return [_contact_of(_CONTACT.unpack_from(rows, k * _CONTACT.size)) for k in range(count.value)], bool(is_partial.value)


class Gradient(NamedTuple):
    """The network's answer, and the derivatives of opinion.distance, or of the logit, by the poses.

    by_a, by_b  (k, 6) float32, one row for a body without poses: by a displacement of the body's origin (metres,
                world), then by a small rotation about it (rotation vector, radians, world, applied on the left)
    """
    answer: Answer
    by_a: Floats
    by_b: Floats


def sweep_gradient(a: BodyLike, b: BodyLike, poses_a: Optional[ArrayLike] = None, poses_b: Optional[ArrayLike] = None, *,
                   times_a: Optional[ArrayLike] = None, times_b: Optional[ArrayLike] = None, scale_a: float = 1,
                   scale_b: float = 1, ask: _AskWord = "hit", segments: int = 0, pairs: int = 0, model: _ModelWord = "default",
                   precision: _PrecisionWord = "float", recall: float = 0, inflate: float = 0) -> Gradient:
    """As sweep, by the network, with derivatives of the logit, or of the distance: ask="distance". They are zero where
    the network had nothing to look at. Both bodies need latents."""
    question = _question(_two_bodies(a, b), _motions(poses_a, poses_b, times_a, times_b), scale_a, scale_b, _asked(
        ask, 0, 0, 0, 0, 0, False, False, Method.NETWORK, 0, segments, pairs, model, precision, recall, inflate))
    answer = _Answer()
    by_a, by_b = (np.zeros((1 if motion.poses is None else len(motion.poses), 6), np.float32) for motion in question.kept[0])
    code = _library.nsvcd_sweep_gradient(byref(question), _workspace.address, _workspace.size, byref(answer),
                                         _address(by_a), _address(by_b))
    _check_question(code, question)
    return Gradient(_answer_of(answer), by_a, by_b)
