# SPDX-License-Identifier: MIT
"""A robot's joints, parts and pairs from a URDF, by examples/robot/urdf.py, which svcd's planning files are made by."""
from __future__ import annotations

import importlib.util
import os
import warnings
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple, Optional, Union, cast

import numpy as np

from .words import JointKind
from ._arrays import FilePath, Vector
from .bodies import Body
from .meshes import Mesh, _warn_of_size


class _Scene(NamedTuple):
    """What a Robot is made of."""
    joints: list[dict[str, Any]]
    parts: list[dict[str, Any]]
    pairs: list[tuple[int, int]]


def _reader() -> Any:
    """urdf.py beside this file, as a wheel has it, or where the repository has it."""
    here = Path(__file__).resolve().parent
    path = next(place for place in (here / "_urdf.py", here.parents[1] / "robot" / "urdf.py") if place.exists())
    spec = importlib.util.spec_from_file_location(f"{__package__}._urdf", path)
    assert spec and spec.loader
    module: Any = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    module.warn = lambda text: warnings.warn(text, stacklevel=2)
    return module


class _Output:
    """In place of urdf.py's, which writes files: bodies, by their numbers."""

    def __init__(self) -> None:
        self.bodies: list[Any] = []

    def reference(self, body: Any, prefix: str) -> str:
        self.bodies.append(body)
        return str(len(self.bodies) - 1)


def _encoded(reader: Any, body: Any, balls: int) -> Body:
    """As svcd has it."""
    if not body.mesh:
        return Body(Mesh.parse(reader.obj_text(body.shapes), f"{body.name}.obj"), balls=balls)
    scale: Vector = body.scale
    data = Path(body.mesh).read_bytes()
    if scale[0] == scale[1] == scale[2] > 0:
        mesh = Mesh.parse(data, body.mesh, scale[0])
    else:
        mesh = Mesh.parse(data, body.mesh)
        mesh = Mesh(np.asarray(mesh.vertices * np.array(scale), np.float32), mesh.faces[:, ::-1] if np.prod(scale) < 0 else mesh.faces)
    _warn_of_size(mesh, scale[0], f"{body.name}: {body.mesh}", "the URDF's scale ")
    return Body(mesh, balls=balls)


def _read_urdf(path: FilePath, srdf: Optional[FilePath], obstacles: Union[FilePath, Sequence[Any]], fixed: Mapping[str, float],
               package: Mapping[str, FilePath], ignore: Sequence[str], velocity: Optional[float], round: Optional[float],
               balls: int) -> _Scene:
    reader, output = _reader(), _Output()
    given = reader.Given(dict(fixed), {name: os.fspath(folder) for name, folder in package.items()}, set(ignore), velocity, round)
    robot = reader.Robot(os.fspath(path), given)
    rules = reader.Semantics(None if srdf is None else os.fspath(srdf), robot, given)
    with reader.about(os.fspath(path)):
        lines = [line.split() for line in reader.robot_lines(robot, rules, output)]
    for name in set(given.held) - set(robot.elements) - rules.virtual:
        raise ValueError(f"fixed: there is no joint {name}")
    links = {"world": 0}
    joints: list[dict[str, Any]] = []
    parts: list[dict[str, Any]] = []
    named: dict[str, int] = {}
    pairs: list[tuple[int, int]] = []
    for word, name, *rest in lines:
        if word == "joint":
            numbers = [float(text) for text in rest[1:11]]
            low, high, speed, acceleration = map(float, rest[12:16])
            joints.append({"parent": links[rest[0]], "origin": numbers[:7], "axis": numbers[7:], "kind": JointKind(rest[11]),
                           "low": low, "high": high, "speed": speed, "acceleration": acceleration, "name": name})
            links[name] = len(joints)
        elif word == "mimic":
            joints[links[name] - 1].update(mimic=links[rest[0]] - 1, multiplier=float(rest[1]), offset=float(rest[2]))
        elif word == "body":
            body, link = output.bodies[int(rest[1])], links[rest[0]]
            place = rest.index("pose") + 1 if "pose" in rest else 0
            pose = [float(text) for text in rest[place:place + 7]] if place else [0, 0, 0, 0, 0, 0, 1]
            named[name] = len(parts)
            parts.append({"body": _encoded(reader, body, balls if link else 0), "link": link, "pose": pose, "name": name})
        elif word == "pair":
            pairs.append((named[name], named[rest[0]]))
    moving = [k for k, part in enumerate(parts) if part["link"]]
    if isinstance(obstacles, (str, os.PathLike)):
        world, found = reader.Robot(os.fspath(obstacles), given), _Output()
        texts = reader.scene_lines("scene", world, {part["name"] for part in parts}, found)[1:]
        rows = [{"body": _encoded(reader, found.bodies[int(text.split()[2])], 0), "link": 0, "name": text.split()[1],
                 "pose": [float(number) for number in text.split()[3:10]]} for text in texts]
    else:
        if not all(hasattr(part, "_asdict") for part in obstacles):
            raise TypeError("obstacles: a URDF's path, or Parts: [Part(body, 0, pose=...)]")
        rows = [part._asdict() for part in cast(Sequence[Any], obstacles)]
        for row in rows:
            if row["link"]:
                raise ValueError(f"obstacles: {row['name'] or 'a Part'} is on link {row['link']}: an obstacle rests on link 0, the world; "
                                 "what a link carries is one of the parts of Robot(joints, parts, pairs)")
    pairs += [(k, len(parts) + n) for k in moving for n in range(len(rows))]
    return _Scene(joints, parts + rows, pairs)
