# SPDX-License-Identifier: MIT
"""Bodies of a World that move by themselves, as arrays."""
from __future__ import annotations

import ctypes
import operator
import sys
from typing import TYPE_CHECKING, Any, NamedTuple, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .words import Code
from ._structs import _SlideAnswer, _SlideOptions, _WorldContact, _WorldMover
from .errors import Error
from ._arrays import Floats, _numeric
from .answers import Contact, _contact_of, _packed

if TYPE_CHECKING:
    from .worlds import World


class WorldContact(NamedTuple):
    """nsvcd_world_contact: a contact of a mover, which is `a` of it, with a body of the world, by its id.

    impulse  newton seconds, along the normal: what a slide took from the mover's momentum; without a mass, metres a second
    """
    body: int
    contact: Contact
    impulse: float


class Step(NamedTuple):
    """What became of all movers in a frame: nsvcd_step_answer. Of all: how many

    awake      moved, or could have
    asleep     sleep at the end
    caught     could not get out of the way of a driven body
    contacts, questions, work  of their slides
    """
    awake: int
    asleep: int
    caught: int
    contacts: int
    questions: int
    work: int


def _columns(struct: Any, start: int = 0) -> dict[str, tuple[Any, int]]:
    """The numbers of a struct that starts there in a row of Movers: of which kind, and where."""
    columns = {}
    for name, kind in struct._fields_:
        whole, place = np.dtype(kind), start + getattr(struct, name).offset
        if whole == np.intc:  # a truth: its lowest byte
            whole, place = np.dtype(bool), place + (whole.itemsize - 1 if sys.byteorder == "big" else 0)
        columns[name] = whole, place
    return columns


_TOLD_OF_MOVERS = ("caught", "ground", "ground_normal", "contact_count")
_GIVEN_OF_MOVERS = ("velocity", "mass", "inertia", "friction", "restitution", "push_mass", "damping", "spin_damping", "asleep",
                    "sleepless", "clearance", "margin", "up", "step", "slope", "rounds", "work")


def _mover_rows() -> Any:
    """A type of numpy's: an nsvcd_world_mover by the names that Movers have."""
    columns = {**_columns(_SlideAnswer, _WorldMover.answer.offset), **_columns(_WorldMover),
               **_columns(_SlideOptions, _WorldMover.how.offset),
               "velocity": (np.dtype((np.float32, 6)), _WorldMover.velocity.offset)}
    names = ["id", *_GIVEN_OF_MOVERS, *_TOLD_OF_MOVERS]
    formats, offsets = zip(*(columns[name] for name in names))
    return np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": ctypes.sizeof(_WorldMover)})


_MOVER_ROWS = _mover_rows()


class Movers:
    """n bodies of a World that World.step moves: nsvcd_world_mover, as arrays, one row for each body.

        movers = Movers(ids, mass=2, inertia=2 * box.mass().inertia, friction=0.5)
        movers.velocity[0] = 3, 0, 0, 0, 0, 0
        while not movers.asleep.all():
            world.step(movers, 1 / 60)

    Each argument is for all bodies, or has a row for each, and so it becomes an array of that name, which holds what the library
    has: what is written there counts at the next step. Zero is the default of everything.

    ids          (n) uint64, of bodies that are not fixed, each once. Not to be written
    velocity     (n, 6) float32, metres a second of the pivot, then radians a second, in the world; or (3), which does not turn
    push_mass    (n) float32, kilograms: what a character pushes with; 0: it pushes nothing
    damping, spin_damping  (n) float32, a second: the share of its speed, and of its spin, that it loses everywhere
    asleep       (n) bool: it stays where it is until something wakes it, and costs nothing
    sleepless    (n) bool: it never falls asleep, as characters do not
    mass, inertia, friction, restitution, clearance, margin, up, step, slope, rounds, work  as World.slide says; inertia and up
                 (n, 3), rounds and work uint64, else (n) float32. What has no mass is a character

    What became of each in its last frame, to be read:
    caught         (n) uint64: the driven body that it could not get out of the way of; 0: none
    ground, ground_normal  (n) uint64 and (n, 3): the body that a character stands on, 0: none, and the ground's normal
    contact_count  (n) uint64; `contacts(k)` tells them

    movers[mask], [slice] or [numbers] is a copy of some, and `a + b` of both, with all that they are: for bodies that come and go.
    """
    ids: NDArray[np.uint64]
    velocity: Floats
    mass: Floats
    inertia: Floats
    friction: Floats
    restitution: Floats
    push_mass: Floats
    damping: Floats
    spin_damping: Floats
    asleep: NDArray[np.bool_]
    sleepless: NDArray[np.bool_]
    clearance: Floats
    margin: Floats
    up: Floats
    step: Floats
    slope: Floats
    rounds: NDArray[np.uint64]
    work: NDArray[np.uint64]
    caught: NDArray[np.uint64]
    ground: NDArray[np.uint64]
    ground_normal: Floats
    contact_count: NDArray[np.uint64]
    _memory: NDArray[np.uint8]
    _world: Optional[World]

    def __init__(self, ids: ArrayLike, *, velocity: ArrayLike = 0, mass: ArrayLike = 0, inertia: ArrayLike = 0,
                 friction: ArrayLike = 0, restitution: ArrayLike = 0, push_mass: ArrayLike = 0, damping: ArrayLike = 0,
                 spin_damping: ArrayLike = 0, asleep: ArrayLike = False, sleepless: ArrayLike = False, clearance: ArrayLike = 0,
                 margin: ArrayLike = 0, up: ArrayLike = 0, step: ArrayLike = 0, slope: ArrayLike = 0, rounds: ArrayLike = 0,
                 work: ArrayLike = 0) -> None:
        given = locals()
        wanted = _numeric(ids, (None,), "ids")
        if wanted.size and wanted.dtype.kind == "f":
            raise TypeError(f"ids: an array of integers is needed, not of {wanted.dtype}")
        if wanted.size and wanted.min() < 1:
            raise Error(Code.INDEX, "ids")
        memory = np.zeros((len(wanted), _MOVER_ROWS.itemsize), np.uint8)
        memory.view(_MOVER_ROWS)[:, 0]["id"] = wanted
        self._keep(memory, None)
        for name in _GIVEN_OF_MOVERS:
            setattr(self, name, given[name])

    def _keep(self, memory: NDArray[np.uint8], world: Optional[World]) -> None:
        rows = memory.view(_MOVER_ROWS)[:, 0]
        views = {"ids": rows["id"], **{name: rows[name] for name in (*_GIVEN_OF_MOVERS, *_TOLD_OF_MOVERS)}}
        for name in ("ids", *_TOLD_OF_MOVERS):
            views[name].flags.writeable = False
        self.__dict__.update(views, _memory=memory, _world=world)

    @classmethod
    def _of(cls, memory: NDArray[np.uint8], world: Optional[World]) -> Movers:
        self = cls.__new__(cls)
        self._keep(memory, world)
        return self

    def __setattr__(self, name: str, value: Any) -> None:
        """Writes into the array of that name."""
        array = self.__dict__.get(name)
        if name[:1] == "_" or array is None:
            raise AttributeError(f"Movers have no {name}")
        numbers = np.asarray(value)
        if numbers.dtype.kind not in {"b": "biu", "u": "iu", "f": "fiu"}[array.dtype.kind]:
            raise TypeError(f"{name}: numbers as {array.dtype} are needed, not {numbers.dtype}")
        if array.dtype.kind == "u" and numbers.size and numbers.min() < 0:
            raise ValueError(f"{name}: {value} is less than 0")
        if name == "velocity" and numbers.ndim and numbers.shape[-1] == 3:
            numbers = np.concatenate([numbers, np.zeros_like(numbers)], axis=-1)
        try:
            numbers = np.broadcast_to(numbers, array.shape)
        except ValueError:
            raise ValueError(f"{name}: an array {array.shape} is needed, not {numbers.shape}") from None
        array[...] = numbers

    def __reduce__(self) -> tuple[Any, ...]:
        raise TypeError("Movers cannot be pickled; movers[:] is a copy")

    def __len__(self) -> int:
        return len(self._memory)

    def __getitem__(self, which: Any) -> Movers:
        return Movers._of(np.atleast_2d(self._memory[which]).copy(), self._world)

    def __add__(self, others: Movers) -> Movers:
        worlds = {self._world, others._world} - {None}
        if len(worlds) > 1:
            raise ValueError("movers of two Worlds")
        return Movers._of(np.concatenate([self._memory, others._memory]), next(iter(worlds), None))

    def contacts(self, k: int) -> list[WorldContact]:
        """Where the k-th touched at the end of its last frame, or within the margin; with which impulses."""
        answer = _SlideAnswer.from_buffer_copy(self._memory[operator.index(k)], _WorldMover.answer.offset)
        return _world_contacts(answer, answer.contact_count)


_WORLD_CONTACT = _packed(_WorldContact)


def _world_contacts(c: Any, count: int) -> list[WorldContact]:
    first = type(c).contacts.offset
    rows: Any = [_WORLD_CONTACT.unpack_from(c, first + k * _WORLD_CONTACT.size) for k in range(count)]
    return [WorldContact(v[0], _contact_of(v[1:14]), v[14]) for v in rows]
