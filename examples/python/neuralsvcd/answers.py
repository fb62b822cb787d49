# SPDX-License-Identifier: MIT
"""What a question is answered."""
from __future__ import annotations

import ctypes
import struct
from typing import Any, NamedTuple, Optional

from numpy.typing import ArrayLike

from .words import By, _BYS, NO_TRIANGLE, Verdict, _VERDICTS, Why, _WHYS
from ._structs import _Answer, _Contact
from ._arrays import Pose, Vector
from .bodies import BodyLike


class Range(NamedTuple):
    """What is known of a number: nsvcd_range. inf: it is not known."""
    low: float
    high: float


class Contact(NamedTuple):
    """Two triangles, and where they meet or are nearest: nsvcd_contact.

    point    world, metres
    normal   unit, from b to a, world; or 0
    gap      metres between the triangles; 0: they meet
    time     in [0, 1]
    triangle_a, triangle_b  as numbered in the meshes; None: none are named
    patch_a, patch_b        that list them
    id       of a manifold: of the corner, or the two edges, that touch; the same as long as they do
    """
    point: Vector
    normal: Vector
    gap: float
    time: float
    triangle_a: Optional[int]
    triangle_b: Optional[int]
    patch_a: int
    patch_b: int
    id: int


class SafePlace(NamedTuple):
    """Where the bodies may go: nsvcd_safe_pose. Poses x y z, quaternion x y z w, lifted off what they touch."""
    time: float
    a: Pose
    b: Pose


class Opinion(NamedTuple):
    """What the network thinks: nsvcd_opinion.

    logit       of collision, positive is yes
    distance    metres, of the same pair: by how much it misses, or, negative, how deep it is; inf: no decoder was needed
    time        in [0, 1]: when the most suspicious pair comes closest
    patch_a, patch_b  that pair
    candidates  pairs of patches whose spheres meet, and that no plane parts
    limited     there were more than options.pairs let through
    """
    logit: float
    distance: float
    time: float
    patch_a: int
    patch_b: int
    candidates: int
    limited: bool


class Answer(NamedTuple):
    """nsvcd_answer. As a condition it is answer.verdict != "free": what is undecided counts.

    verdict   free, hit or undecided
    by        proof or network: who says so
    why       not all that was asked is answered: too near, work, or open: one seems to be inside of what is
              nearly a solid; or nothing: all of it is
    inside    a hit, for one lies inside the other at the start
    time      in [0, 1], of the first contact: free before low, in contact at high. Only "first" brings these together:
              else low is 0, and high the time of a contact, before which there may be others
    distance  metres: the least; of a hit, up to time.high
    safe      where the bodies may go: poses at time.low
    depth     metres: of a contact at the start, the smallest push_out of a off b, up to options.slop or so, that ends it;
              0: there is no such contact; inf: it is not known
    push_out      metres, world: by what a was lifted off b for options.slop
    contacts  of a hit whose triangles are known, at time.high: one, or a manifold, in the order of their ids
    nearest   the triangles that distance.high is about, whatever the verdict
    opinion   of the network, where it was asked
    work      units that the proof took
    """
    verdict: Verdict
    by: By
    why: Why
    inside: bool
    time: Range
    distance: Range
    safe: SafePlace
    depth: float
    push_out: Vector
    contacts: list[Contact]
    nearest: Contact
    opinion: Optional[Opinion]
    work: int

    def __bool__(self) -> bool:
        return self.verdict is not Verdict.FREE

    def plot(self, a: BodyLike, b: BodyLike, poses_a: Optional[ArrayLike] = None, poses_b: Optional[ArrayLike] = None, *,
             times_a: Optional[ArrayLike] = None, times_b: Optional[ArrayLike] = None, scale_a: float = 1, scale_b: float = 1,
             axes: Any = None) -> Any:
        """Draws the question and the answer into axes of matplotlib, projection="3d"; None: into a new figure. The arguments
        are those of sweep. a is blue, where it hits b, or as far as it is free; what it passes through is pale; contacts are red.

        Returns the axes: axes.figure.savefig("hit.png"). ImportError: there is no matplotlib.
        """
        from .pictures import _plot_answer
        return _plot_answer(self, (a, b), (poses_a, poses_b), (times_a, times_b), (scale_a, scale_b), axes)


def _leaves(kind: Any, offset: int = 0) -> list[tuple[int, str]]:
    """The numbers of a struct: offset and format of each, vectors as one."""
    if not issubclass(kind, ctypes.Structure):
        return [(offset, f"{kind._length_}{kind._type_._type_}" if issubclass(kind, ctypes.Array) else kind._type_)]
    return [leaf for name, member in kind._fields_ if name != "contacts"
            for leaf in _leaves(member, offset + getattr(kind, name).offset)]


def _packed(kind: Any) -> struct.Struct:
    """All fields at once but for `contacts`: field by field takes twice the time."""
    layout = ""
    for offset, leaf in [*_leaves(kind), (ctypes.sizeof(kind), "")]:
        layout += f"{offset - struct.calcsize(layout)}x{leaf}"
    return struct.Struct(layout)


_FIELDS, _CONTACT = _packed(_Answer), _packed(_Contact)
_CONTACTS = _Answer.contacts.offset


def _contact_of(v: Any) -> Contact:
    return Contact(v[0:3], v[3:6], v[6], v[7], None if v[8] == NO_TRIANGLE else v[8],
                   None if v[9] == NO_TRIANGLE else v[9], v[10], v[11], v[12])


def _answer_of(c: Any) -> Answer:
    v: Any = _FIELDS.unpack(c)
    contacts = [_contact_of(_CONTACT.unpack_from(c, _CONTACTS + k * _CONTACT.size)) for k in range(v[27])]
    opinion = Opinion(v[42], v[43], v[44], v[45], v[46], v[47], bool(v[48])) if v[41] else None
    return Answer(_VERDICTS[v[0]], _BYS[v[1]], _WHYS[v[2]], bool(v[3]), Range(v[4], v[5]), Range(v[6], v[7]),
                  SafePlace(v[8], v[9:12] + v[12:16], v[16:19] + v[19:23]), v[23], v[24:27], contacts,
                  _contact_of(v[28:41]), opinion, v[49])
