"""From a URDF to a planning file for `svcd plan` and `svcd path` (examples/FORMATS.md).

    python3 examples/robot/urdf.py ROBOT.urdf [--srdf ROBOT.srdf] [--scene NAME WORLD.urdf]... OUT.txt

Joints that are fixed vanish: what is on them is on the link before. Collision shapes are written as OBJ
files beside OUT.txt, in the frame that follows their joint; boxes, cylinders, spheres, OBJ and STL are
known. Pairs are all links but those that one joint parts and those that the SRDF disables. A WORLD has no
joints but fixed ones: its links are the obstacles of a scene.
"""
from __future__ import annotations

import argparse
import math
import os
import struct
import sys
import xml.etree.ElementTree as xml

Vector = tuple[float, float, float]
Matrix = tuple[Vector, Vector, Vector]
Triangle = tuple[Vector, Vector, Vector]
Frame = tuple[Matrix, Vector]  # a rotation, then a move
HERE: Frame = (((1, 0, 0), (0, 1, 0), (0, 0, 1)), (0, 0, 0))
SIDES = 32  # of what is round


def numbers(text: str | None, default: str) -> Vector:
    x, y, z = (float(part) for part in (text or default).split())
    return x, y, z


def apply(frame: Frame, point: Vector) -> Vector:
    turn, move = frame
    x, y, z = (sum(row[k] * point[k] for k in range(3)) + off for row, off in zip(turn, move))
    return x, y, z


def within(outer: Frame, inner: Frame) -> Frame:
    columns = [apply((outer[0], (0, 0, 0)), tuple(row[k] for row in inner[0])) for k in range(3)]
    return tuple(tuple(column[k] for column in columns) for k in range(3)), apply(outer, inner[1])


def origin_of(element: xml.Element) -> Frame:
    """The origin of a joint or a shape: fixed axes x, y, z, then the move."""
    origin = element.find("origin")
    if origin is None:
        return HERE
    r, p, y = numbers(origin.get("rpy"), "0 0 0")
    cr, sr, cp, sp, cy, sy = math.cos(r), math.sin(r), math.cos(p), math.sin(p), math.cos(y), math.sin(y)
    turn = ((cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
            (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
            (-sp, cp * sr, cp * cr))
    return turn, numbers(origin.get("xyz"), "0 0 0")


def quaternion(turn: Matrix) -> tuple[float, ...]:
    """x y z w, by the largest (Shepperd)."""
    trace = turn[0][0] + turn[1][1] + turn[2][2]
    sizes = [turn[0][0], turn[1][1], turn[2][2], trace]
    i = sizes.index(max(sizes))
    q = [0.0] * 4
    if i == 3:
        q = [turn[2][1] - turn[1][2], turn[0][2] - turn[2][0], turn[1][0] - turn[0][1], 1 + trace]
    else:
        j, k = (i + 1) % 3, (i + 2) % 3
        q[i] = 1 + turn[i][i] - turn[j][j] - turn[k][k]
        q[j] = turn[i][j] + turn[j][i]
        q[k] = turn[i][k] + turn[k][i]
        q[3] = turn[k][j] - turn[j][k]
    length = math.sqrt(sum(part * part for part in q))
    return tuple(part / length for part in q)


# ---- shapes

def quad(a: Vector, b: Vector, c: Vector, d: Vector) -> list[Triangle]:
    return [(a, b, c), (a, c, d)]


def box(size: Vector) -> list[Triangle]:
    corner = [((i % 2 - 0.5) * size[0], (i // 2 % 2 - 0.5) * size[1], (i // 4 - 0.5) * size[2]) for i in range(8)]
    faces = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    return [t for face in faces for t in quad(*(corner[i] for i in face))]


def lathe(profile: list[tuple[float, float]]) -> list[Triangle]:
    """Turns points (radius, z), from below to above, about z. Flat sides stand about the round shape."""
    out = []
    grown = 1 / math.cos(math.pi / SIDES)
    ring = [[(r * grown * math.cos(2 * math.pi * k / SIDES), r * grown * math.sin(2 * math.pi * k / SIDES), z)
             for k in range(SIDES)] for r, z in profile]
    for low, high in zip(ring, ring[1:]):
        for k in range(SIDES):
            out += quad(low[k], low[(k + 1) % SIDES], high[(k + 1) % SIDES], high[k])
    return [t for t in out if len(set(t)) == 3]


def cylinder(radius: float, length: float) -> list[Triangle]:
    return lathe([(0, -length / 2), (radius, -length / 2), (radius, length / 2), (0, length / 2)])


def sphere(radius: float) -> list[Triangle]:
    rings = SIDES // 2
    grown = radius / math.cos(math.pi / SIDES)
    angles = [math.pi * (k / rings - 0.5) for k in range(rings + 1)]
    return lathe([(grown * math.cos(a) if 0 < k < rings else 0, grown * math.sin(a)) for k, a in enumerate(angles)])


def stl(data: bytes) -> list[Triangle]:
    count = struct.unpack_from("<I", data, 80)[0] if len(data) >= 84 else 0
    if len(data) == 84 + 50 * count:
        rows = [struct.unpack_from("<9f", data, 84 + 50 * t + 12) for t in range(count)]
        return [(r[0:3], r[3:6], r[6:9]) for r in rows]
    words = data.decode("ascii", "replace").split()
    corners = [tuple(float(x) for x in words[i + 1:i + 4]) for i, word in enumerate(words) if word == "vertex"]
    return list(zip(corners[0::3], corners[1::3], corners[2::3]))


def obj(text: str) -> list[Triangle]:
    points: list[Vector] = []
    out: list[Triangle] = []
    for line in text.splitlines():
        words = line.split("#")[0].split()
        if words[:1] == ["v"]:
            points.append((float(words[1]), float(words[2]), float(words[3])))
        elif words[:1] == ["f"]:
            corner = [int(word.split("/")[0]) for word in words[1:]]
            face = [points[i - 1 if i > 0 else len(points) + i] for i in corner]
            out += [(face[0], face[k], face[k + 1]) for k in range(1, len(face) - 1)]
    return out


def mesh(element: xml.Element, folder: str) -> list[Triangle]:
    name = element.get("filename", "")
    for prefix in ("package://", "file://"):
        name = name[len(prefix):] if name.startswith(prefix) else name
    path = name if os.path.isabs(name) else os.path.join(folder, name)
    if not path.lower().endswith((".obj", ".stl")):
        raise ValueError(f"{path}: neither OBJ nor STL")
    with open(path, "rb") as file:
        data = file.read()
    triangles = stl(data) if path.lower().endswith(".stl") else obj(data.decode("utf-8", "replace"))
    scale = numbers(element.get("scale"), "1 1 1")
    return [tuple(tuple(p[k] * scale[k] for k in range(3)) for p in t) for t in triangles]


def shape(geometry: xml.Element, folder: str) -> list[Triangle]:
    element = geometry[0]
    if element.tag == "box":
        return box(numbers(element.get("size"), ""))
    if element.tag == "cylinder":
        return cylinder(float(element.get("radius", "")), float(element.get("length", "")))
    if element.tag == "sphere":
        return sphere(float(element.get("radius", "")))
    if element.tag == "mesh":
        return mesh(element, folder)
    raise ValueError(f"no such shape: {element.tag}")


def write_obj(path: str, triangles: list[Triangle]) -> None:
    numbers_of: dict[Vector, int] = {}
    for t in triangles:
        for p in t:
            numbers_of.setdefault(p, len(numbers_of) + 1)
    with open(path, "w", encoding="ascii") as file:
        file.writelines("v %.9g %.9g %.9g\n" % p for p in numbers_of)
        file.writelines("f %d %d %d\n" % tuple(numbers_of[p] for p in t) for t in triangles)


# ---- robots

class Robot:
    """A URDF: what is on each link, and in which frame of which joint the link is."""

    def __init__(self, path: str) -> None:
        self.folder = os.path.dirname(path)
        root = xml.parse(path).getroot()
        self.links = {link.get("name", ""): link for link in root.findall("link")}
        above = {joint.find("child").get("link"): joint for joint in root.findall("joint")}
        self.joints: list[tuple[str, str, Frame, xml.Element]] = []  # name, parent, frame, element
        self.place: dict[str, tuple[str, Frame]] = {}  # of a link: the joint before it, its frame there
        self.parent: dict[str, str] = {}
        for name in self.links:
            self.settle(name, above)

    def settle(self, link: str, above: dict[str, xml.Element]) -> tuple[str, Frame]:
        if link in self.place:
            return self.place[link]
        joint = above.get(link)
        if joint is None:
            self.place[link] = ("world", HERE)
            return self.place[link]
        self.parent[link] = joint.find("parent").get("link", "")
        before, frame = self.settle(self.parent[link], above)
        frame = within(frame, origin_of(joint))
        kind = joint.get("type", "")
        name = joint.get("name", "")
        if joint.find("mimic") is not None:
            print(f"urdf.py: warning: {name}: mimic is not followed: a joint of its own", file=sys.stderr)
        if kind == "fixed":
            self.place[link] = (before, frame)
        elif kind in ("revolute", "continuous", "prismatic"):
            self.joints.append((name, before, frame, joint))
            self.place[link] = (name, HERE)
        else:
            raise ValueError(f"{name}: a joint that is {kind}")
        return self.place[link]

    def shapes(self, link: str) -> list[Triangle]:
        """All collision shapes of a link, in the frame that follows its joint."""
        out = []
        for collision in self.links[link].findall("collision"):
            frame = within(self.place[link][1], origin_of(collision))
            triangles = shape(collision.find("geometry"), self.folder)
            out += [tuple(apply(frame, p) for p in t) for t in triangles]
        return out


def joint_line(name: str, parent: str, frame: Frame, joint: xml.Element) -> str:
    kind = joint.get("type", "")
    limit = joint.find("limit")
    given = {} if limit is None else limit.attrib
    if kind != "continuous" and limit is None:
        raise ValueError(f"{name}: no limits")
    axis = joint.find("axis")
    numbers_of = [*frame[1], *quaternion(frame[0]), *numbers(None if axis is None else axis.get("xyz"), "1 0 0")]
    speed = float(given.get("velocity", 1)) or 1
    acceleration = float(given.get("acceleration", 0)) or 3 * speed  # no word of URDF's own
    ends = [float(given.get("lower", 0)), float(given.get("upper", 0)), speed, acceleration]
    return " ".join(["joint", name, parent, *("%.9g" % x for x in numbers_of), kind, *("%.9g" % x for x in ends)])


def disabled(path: str | None) -> set[frozenset[str]]:
    if path is None:
        return set()
    found = xml.parse(path).getroot().findall("disable_collisions")
    return {frozenset((pair.get("link1", ""), pair.get("link2", ""))) for pair in found}


def convert(urdf: str, srdf: str | None, scenes: list[tuple[str, str]], out: str) -> None:
    robot = Robot(urdf)
    stem = os.path.splitext(out)[0]
    lines = ["nsvcd-plans 1", *(joint_line(*joint) for joint in robot.joints)]

    def write(name: str, triangles: list[Triangle]) -> str:
        path = f"{stem}_{name}.obj"
        write_obj(path, triangles)
        return os.path.basename(path)

    bodies = {link: robot.shapes(link) for link in robot.links}
    bodies = {link: triangles for link, triangles in bodies.items() if triangles}
    lines += [f"body {link} {robot.place[link][0]} {write(link, triangles)}" for link, triangles in bodies.items()]
    parents = {name: parent for name, parent, _, _ in robot.joints}
    skipped = disabled(srdf)
    for index, a in enumerate(bodies):
        for b in list(bodies)[index + 1:]:
            joint_a, joint_b = robot.place[a][0], robot.place[b][0]
            is_near = joint_a == joint_b or parents.get(joint_a) == joint_b or parents.get(joint_b) == joint_a
            if not is_near and frozenset((a, b)) not in skipped:
                lines.append(f"pair {a} {b}")
    for scene, path in scenes:
        world = Robot(path)
        if world.joints:
            raise ValueError(f"{path}: a world with joints that move")
        lines.append(f"scene {scene}")
        for link in world.links:
            triangles = world.shapes(link)
            if triangles:
                lines.append(f"obstacle {link} {write(f'{scene}_{link}', triangles)} 0 0 0 0 0 0 1")
    with open(out, "w", encoding="ascii") as file:
        file.write("\n".join(lines) + "\n")


def main() -> int:
    parser = argparse.ArgumentParser(description="From a URDF to a planning file")
    parser.add_argument("urdf")
    parser.add_argument("out")
    parser.add_argument("--srdf")
    parser.add_argument("--scene", nargs=2, action="append", default=[], metavar=("NAME", "WORLD.urdf"))
    given = parser.parse_args()
    try:
        convert(given.urdf, given.srdf, [tuple(scene) for scene in given.scene], given.out)
    except (ValueError, OSError, AttributeError, xml.ParseError) as error:
        print(f"urdf.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
