# SPDX-License-Identifier: MIT
"""What the library refuses, as an exception."""
from __future__ import annotations

from ctypes import byref
from typing import Any, Mapping, Optional, Union

from .words import Code
from ._structs import _Question
from ._library import _library


class Error(Exception):
    """What the library refuses.

    code   why
    where  of a file its name, of an argument that, or ""
    line   of a file that is text, from 1; 0: none is at fault
    index  of many motions: the first at fault; of World.step: the mover; else None
    reason in words, where a reader knows more than the code says, else ""
    """

    def __init__(self, code: int, where: str = "", line: int = 0, index: Optional[int] = None,
                 reason: str = "") -> None:
        super().__init__(code, where, line, index, reason)
        self.code = Code(code)
        self.where = where
        self.line = line
        self.index = index
        self.reason = reason

    def __str__(self) -> str:
        place = [self.where] if self.where else []
        if self.line:
            place.append(f"line {self.line}")
        if self.index is not None:
            place.append(f"index {self.index}")
        return ": ".join([*place, self.reason or _library.nsvcd_result_string(self.code).decode()])


def _check(code: int) -> None:
    if code:
        raise Error(code)


_Names = Mapping[Code, Union[str, tuple[str, str]]]


def _fault_of(code: int, names: _Names, index: Optional[int] = None) -> Error:
    """Which argument is at fault is told by the code, for each call; and why, where the library's words are about others."""
    where = names.get(Code(code), "")
    return Error(code, where, index=index) if isinstance(where, str) else Error(code, where[0], index=index, reason=where[1])


def _check_of(code: int, names: _Names) -> None:
    """As _check, of named arguments."""
    if code:
        raise _fault_of(code, names)


_OF_MOVERS = {Code.POSES: "poses", Code.POSE: "poses", Code.QUATERNION: "poses", Code.TIMES: "times", Code.SCALE: "scale"}


def _check_question(code: int, question: Any, index: Optional[int] = None) -> None:
    """As _check. Of what a and b both have it names the one at fault: a, if the question is refused with b at rest."""
    if code in _OF_MOVERS:
        resting = _Question.from_buffer_copy(question)
        resting.b = resting.b.body, None, 0, None, 2 if resting.a.scale == 1 else 1  # or it is the same twice
        side = "b" if _library.nsvcd_sweep_workspace_size(byref(resting)) else "a"
        raise Error(code, f"{_OF_MOVERS[Code(code)]}_{side}", index=index)
    if code:
        raise Error(code, index=index)
