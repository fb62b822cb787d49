# SPDX-License-Identifier: MIT
"""From Python to C, checked: arrays, numbers and structs."""
from __future__ import annotations

import ctypes
import operator
import os
from collections.abc import Callable
from ctypes import c_char, c_float, c_int
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .words import Code, _number_of, _Word
from ._structs import _struct
from .errors import Error

Floats = NDArray[np.float32]
FilePath = Union[str, os.PathLike[str]]
Doubles = NDArray[np.float64]
Vector = tuple[float, float, float]


def _numeric(value: ArrayLike, shape: tuple[Optional[int], ...], name: str) -> NDArray[Any]:
    """As an array of real numbers of this shape, where None stands for any length."""
    array = np.asarray(value)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name}: an array of numbers is needed, not of {array.dtype}")
    fits = array.ndim == len(shape)
    for want, have in zip(shape, array.shape):
        fits = fits and want in (None, have)
    if not fits:
        wanted = ", ".join("n" if length is None else str(length) for length in shape)
        raise ValueError(f"{name}: an array ({wanted}) is needed, not {array.shape}")
    return array


def _floats(value: ArrayLike, shape: tuple[Optional[int], ...], name: str) -> Floats:
    """A copy in C order, so that nothing changes it while the library reads it."""
    return np.array(_numeric(value, shape, name), np.float32, order="C")


def _indices(value: ArrayLike, columns: int, name: str) -> NDArray[np.uint32]:
    array = _numeric(value, (None, columns), name)
    if array.dtype.kind == "f":
        raise TypeError(f"{name}: an array of integers is needed, not of {array.dtype}")
    if array.size and not (0 <= array.min() and array.max() <= 0xffffffff):
        raise Error(Code.INDEX, name)
    return np.array(array, np.uint32, order="C")


def _address(array: Any) -> int:
    """Of a numpy array that can be written. array.ctypes.data takes three times as long."""
    return ctypes.addressof(c_char.from_buffer(array)) if array.size else int(array.ctypes.data)


def _memory(size: int) -> NDArray[np.uint8]:
    """Bytes, aligned as the library wants them."""
    return np.empty(size // 8 + 1, np.uint64).view(np.uint8)[:size]


def _number(kind: Any, value: Any, name: str) -> Any:
    """A number of a C type. ctypes itself would cut off what does not fit."""
    if kind is c_float:
        rounded = c_float(value)
        if value and not rounded.value:
            raise ValueError(f"{name}: {value} is 0 as a float")
        return rounded
    if isinstance(value, _Word):
        return _number_of(value)
    most = 0x7fffffff if kind is c_int else kind(-1).value
    number = operator.index(value)
    if not 0 <= number <= most:
        raise ValueError(f"{name}: {number} is not in 0..{most}")
    return number


def _filled(structure: Any, **values: Any) -> Any:
    """A struct with these numbers; its other fields are 0."""
    out = structure()
    for name, kind in structure._fields_:
        if name in values:
            setattr(out, name, _number(kind, values[name], name))
    return out


def _vector(c: Any) -> Vector:
    return c[0], c[1], c[2]


def _pose_tuple(c: Any) -> Pose:
    p, q = c.position, c.rotation
    return p[0], p[1], p[2], q[0], q[1], q[2], q[3]


def _cancels(progress: Callable[[Any], Any], caught: list[BaseException], done: Any, _: Any) -> int:
    """For C: 1 if the callback wants an end. ctypes would swallow what it raises."""
    try:
        return 1 if caught or progress(done) else 0
    except BaseException as error:  # KeyboardInterrupt too
        caught.append(error)
        return 1


Pose = tuple[float, float, float, float, float, float, float]
_IDENTITY = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)


def _doubles(value: ArrayLike, shape: tuple[Optional[int], ...], name: str) -> Doubles:
    return np.array(_numeric(value, shape, name), np.float64, order="C")
