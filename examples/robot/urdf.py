"""From a URDF to a planning file for `svcd plan` and `svcd path` (examples/FORMATS.md).

    python3 examples/robot/urdf.py ROBOT.urdf [--srdf ROBOT.srdf] [--scene NAME WORLD.urdf]... OUT.txt

Meshes are named as they are: svcd reads them. Boxes, cylinders, spheres and capsules become OBJ files
beside OUT.txt, in the frame that follows their joint; what is round is inside of its mesh. So do DAE files
where Python has pycollada, and xacro is run where it is installed. Fixed joints vanish: what is on them is on the link before. A WORLD has no joints but fixed ones: its links are the
obstacles of a scene. What is not understood is refused, by file, link or joint: nothing is left out.
"""
from __future__ import annotations

import argparse
import contextlib
import math
import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as xml
from collections.abc import Iterator
from typing import NamedTuple

Vector = tuple[float, float, float]
Matrix = tuple[Vector, Vector, Vector]
Triangle = tuple[Vector, Vector, Vector]
Frame = tuple[Matrix, Vector]  # a rotation, then a move
HERE: Frame = (((1, 0, 0), (0, 1, 0), (0, 0, 1)), (0, 0, 0))
SIDES, MOST_SIDES = 32, 512  # of what is round, multiples of 4; corners of 32 stand out by 0.5 % of the radius
MOST = 1e6  # of any number, as svcd has it
MOVES = ("revolute", "continuous", "prismatic")
NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")
NAME = re.compile(r"[^\s#\x00-\x1f\x7f]+")

# Of each element that is read: its attributes (None: any), the elements that are read, those that may
# stand there and change nothing here. MANY may stand there more than once.
URDF: dict[str, tuple[str | None, str, str]] = {
    "robot": (None, "link joint", "material transmission gazebo ros2_control sensor"),
    "link": (None, "collision visual", "inertial contact sensor self_collision_checking"),
    "collision": (None, "origin geometry", "material verbose contact_coefficients"),
    "geometry": ("", "box cylinder sphere capsule mesh", ""),
    "box": ("size", "", ""),
    "cylinder": ("radius length", "", ""),
    "sphere": ("radius", "", ""),
    "capsule": ("radius length", "", ""),
    "mesh": ("filename scale", "", ""),
    "origin": ("xyz rpy", "", ""),
    "joint": ("name type", "origin parent child axis limit mimic safety_controller", "dynamics calibration"),
    "parent": ("link", "", ""),
    "child": ("link", "", ""),
    "axis": ("xyz", "", ""),
    "limit": ("lower upper velocity acceleration effort", "", ""),
    "mimic": ("joint multiplier offset", "", ""),
    "safety_controller": ("soft_lower_limit soft_upper_limit k_position k_velocity", "", ""),
}
PAIR = ("link1 link2 reason", "", "")
SRDF: dict[str, tuple[str | None, str, str]] = {
    "robot": (None, "disable_collisions enable_collisions disable_default_collisions passive_joint virtual_joint group",
              "group_state end_effector link_sphere_approximation joint_property"),
    "group": ("name", "joint link chain group", ""),
    "joint": ("name", "", ""),
    "link": ("name", "", ""),
    "chain": ("base_link tip_link", "", ""),
    "disable_collisions": PAIR,
    "enable_collisions": PAIR,
    "disable_default_collisions": ("link reason", "", ""),
    "passive_joint": ("name", "", ""),
    "virtual_joint": ("name type parent_frame child_link", "", ""),
}
MANY = set("link joint chain collision visual".split()) | set(SRDF["robot"][1].split())


class Given(NamedTuple):
    """Of the command line."""
    held: dict[str, float]
    packages: dict[str, str]
    ignored: set[str]
    velocity: float | None
    finest: float | None  # metres that corners of what is round may stand out


class Body(NamedTuple):
    """Triangles, each shape by itself, in the frame that follows the joint; or a mesh, where it is."""
    name: str
    shapes: list[list[Triangle]]
    mesh: str = ""
    frame: Frame = HERE
    scale: Vector = (1, 1, 1)


def warn(text: str) -> None:
    print(f"urdf.py: warning: {text}", file=sys.stderr)


@contextlib.contextmanager
def about(place: str) -> Iterator[None]:
    """What is wrong within is wrong of this place."""
    try:
        yield
    except ValueError as error:
        raise ValueError(f"{place}: {error}") from None


# ---- what a file says

def is_xacro(root: xml.Element) -> bool:
    for element in root.iter():
        texts = [element.tag, *element.keys(), *element.attrib.values()]
        if any("xacro}" in text or "${" in text or "$(" in text for text in texts):
            return True
    return False


def run_xacro(path: str) -> xml.Element:
    program = shutil.which("xacro")
    if program is None:
        raise ValueError("this is xacro, not yet a URDF: install xacro (`pip install xacro`, or ROS's), or run "
                         "`xacro IN.xacro -o ROBOT.urdf` first")
    done = subprocess.run([program, path], capture_output=True, text=True, check=False)
    lines = done.stderr.strip().splitlines() or [f"it ended with {done.returncode}"]
    if done.returncode:
        raise ValueError(f"xacro: {lines[-1]}")
    root = xml.fromstring(done.stdout)
    if is_xacro(root):
        raise ValueError("this is xacro, and so is what xacro makes of it")
    return root


def read(path: str, known: dict[str, tuple[str | None, str, str]], ignored: set[str]) -> xml.Element:
    """The root of a file in which every element is known."""
    with about(path):
        try:
            root = xml.parse(path).getroot()
            root = run_xacro(path) if is_xacro(root) else root
        except xml.ParseError as error:
            raise ValueError(f"no XML: {error}") from None
        except OSError as error:
            raise ValueError(error.strerror) from None
        space = root.tag[:root.tag.find("}") + 1]
        for element in root.iter():
            if space and element.tag.startswith(space):
                element.tag = element.tag[len(space):]
        if root.tag != "robot":
            raise ValueError(f"begins with <{root.tag}>, not with <robot>")
        check(root, known, ignored)
        return root


def check(element: xml.Element, known: dict[str, tuple[str | None, str, str]], ignored: set[str]) -> None:
    attributes, wanted, harmless = known[element.tag]
    name = " ".join((element.tag, *filter(None, [element.get("name")])))
    for attribute in element.keys() if attributes is not None else ():
        word = attribute.split("}")[-1]
        if attribute not in (attributes or "").split() and word not in ignored:
            raise ValueError(f"{name}: what is the attribute {word}? --ignore {word} leaves it out")
    for child in list(element):
        tag = child.tag.split("}")[-1]
        if tag in ignored or child.tag in harmless.split():
            element.remove(child)
        elif child.tag not in wanted.split():
            raise ValueError(f"{name}: what is <{tag}>? --ignore {tag} leaves it out")
        elif child.tag not in MANY and len(element.findall(child.tag)) > 1:
            raise ValueError(f"{name}: more than one <{child.tag}>")
        elif child.tag != "visual":
            with about(name) if element.tag in ("link", "joint") else contextlib.nullcontext():
                check(child, known, ignored)


def text_of(element: xml.Element, attribute: str) -> str:
    text = element.get(attribute)
    if not text:
        raise ValueError(f"<{element.tag}> has no {attribute}")
    return text


def inner(element: xml.Element, tag: str) -> xml.Element:
    found = element.find(tag)
    if found is None:
        raise ValueError(f"no <{tag}>")
    return found


def numbers(element: xml.Element, attribute: str, default: tuple[float, ...] = ()) -> tuple[float, ...]:
    """So many as the default has; without one, as the attribute has."""
    text = element.get(attribute)
    if text is None and default:
        return default
    words = text_of(element, attribute).split() if text != "" else []
    values = [float(word) if NUMBER.fullmatch(word) else math.nan for word in words]
    if not values or not all(abs(value) <= MOST for value in values) or (default and len(values) != len(default)):
        raise ValueError(f'<{element.tag} {attribute}="{text}">: expected numbers up to {MOST:g}'
                         + (f", {len(default)} of them" if default else ""))
    return tuple(values)


def number(element: xml.Element, attribute: str, default: float | None = None) -> float:
    if default is None:
        text_of(element, attribute)
    return numbers(element, attribute, (default or 0.0,))[0]


def three(element: xml.Element | None, attribute: str, default: Vector) -> Vector:
    x, y, z = default if element is None else numbers(element, attribute, default)
    return x, y, z


def positive(element: xml.Element, attribute: str) -> float:
    value = number(element, attribute)
    if value <= 0:
        raise ValueError(f"<{element.tag}>: {attribute} is not positive")
    return value


# ---- frames

def apply(frame: Frame, point: Vector) -> Vector:
    turn, move = frame
    x, y, z = (sum(row[k] * point[k] for k in range(3)) + off for row, off in zip(turn, move))
    return x, y, z


def within(outer: Frame, inside: Frame) -> Frame:
    columns = [apply((outer[0], (0, 0, 0)), (row[0], row[1], row[2])) for row in zip(*inside[0])]
    x, y, z = zip(*columns)
    return (x, y, z), apply(outer, inside[1])


def origin_of(element: xml.Element) -> Frame:
    """The origin of a joint or a shape: fixed axes x, y, z, then the move."""
    origin = element.find("origin")
    r, p, y = three(origin, "rpy", (0, 0, 0))
    cr, sr, cp, sp, cy, sy = math.cos(r), math.sin(r), math.cos(p), math.sin(p), math.cos(y), math.sin(y)
    turn = ((cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
            (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
            (-sp, cp * sr, cp * cr))
    return turn, three(origin, "xyz", (0, 0, 0))


def axis_of(joint: xml.Element) -> Vector:
    axis = joint.find("axis")
    x, y, z = (1.0, 0.0, 0.0) if axis is None else three(axis, "xyz", (0, 0, 0))
    length = math.hypot(x, y, z)
    if length < 1e-9:
        raise ValueError("its axis has no length")
    return x / length, y / length, z / length


def moved(joint: xml.Element, value: float) -> Frame:
    """What a joint does where it stands at a value (Rodrigues)."""
    if joint.get("type") not in MOVES:
        return HERE
    x, y, z = axis_of(joint)
    if joint.get("type") == "prismatic":
        return HERE[0], (x * value, y * value, z * value)
    c, s = math.cos(value), math.sin(value)
    d = 1 - c
    return ((c + x * x * d, x * y * d - z * s, x * z * d + y * s),
            (y * x * d + z * s, c + y * y * d, y * z * d - x * s),
            (z * x * d - y * s, z * y * d + x * s, c + z * z * d)), (0, 0, 0)


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


def words_of(*values: float) -> str:
    """The shortest texts that are these numbers."""
    return " ".join(repr(float(value)).removesuffix(".0") for value in values)


def pose_of(frame: Frame) -> str:
    return words_of(*frame[1], *quaternion(frame[0]))


# ---- shapes

def quad(a: Vector, b: Vector, c: Vector, d: Vector) -> list[Triangle]:
    return [(a, b, c), (a, c, d)]


def box(size: Vector) -> list[Triangle]:
    corner = [((i % 2 - 0.5) * size[0], (i // 2 % 2 - 0.5) * size[1], (i // 4 - 0.5) * size[2]) for i in range(8)]
    faces = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    return [t for face in faces for t in quad(*(corner[i] for i in face))]


def sides_of(radius: float, finest: float | None) -> int:
    if finest is None:
        return SIDES
    sides = math.pi / max(1e-9, math.acos(radius / (radius + finest)))
    return min(MOST_SIDES, max(SIDES, 4 * math.ceil(sides / 4)))


def lathe(profile: list[tuple[float, float]], sides: int) -> list[Triangle]:
    """Turns points (radius, z), from below to above, about z. Flat sides touch the round shape from
    outside, along x and y too: there it is as far out as it should be."""
    out: list[Triangle] = []
    grown = 1 / math.cos(math.pi / sides)
    angles = [2 * math.pi * (k + 0.5) / sides for k in range(sides)]
    ring: list[list[Vector]] = [[(r * grown * math.cos(a), r * grown * math.sin(a), z) for a in angles]
                                for r, z in profile]
    for low, high in zip(ring, ring[1:]):
        for k in range(sides):
            out += quad(low[k], low[(k + 1) % sides], high[(k + 1) % sides], high[k])
    return [t for t in out if len(set(t)) == 3]


def cylinder(radius: float, length: float, sides: int) -> list[Triangle]:
    return lathe([(0, -length / 2), (radius, -length / 2), (radius, length / 2), (0, length / 2)], sides)


def capsule(radius: float, length: float, sides: int) -> list[Triangle]:
    """Half a ball at each end of a cylinder of this length; a ball if it is 0. Edges of the profile touch
    the circle from outside, at its poles and its equator too."""
    grown = radius / math.cos(math.pi / sides)
    arc = [2 * math.pi * (k + 0.5) / sides for k in range(sides // 4)]
    upper = [(grown * math.cos(a), length / 2 + grown * math.sin(a)) for a in arc] + [(0, length / 2 + radius)]
    return lathe([(r, -z) for r, z in reversed(upper)] + upper, sides)


def obj_text(shapes: list[list[Triangle]]) -> str:
    """No two shapes share a corner: each is closed by itself."""
    lines: list[str] = []
    count = 0
    for triangles in shapes:
        places: dict[Vector, int] = {}
        for p in (p for t in triangles for p in t):
            places.setdefault(p, count + len(places) + 1)
        lines += ["v %.9g %.9g %.9g" % p for p in places]
        lines += ["f %d %d %d" % (places[a], places[b], places[c]) for a, b, c in triangles]
        count += len(places)
    return "\n".join(lines) + "\n"


# ---- meshes

def in_package(package: str, rest: str, folder: str, packages: dict[str, str]) -> str:
    """Where package://PACKAGE/REST is: as --package says; else in a folder of this name at or beside one
    that holds the URDF, or that has a package.xml of this name; else where ROS has it."""
    if package in packages:
        return os.path.join(packages[package], rest)
    tried: list[str] = []
    above = os.path.abspath(folder)
    while True:
        named = os.path.join(above, "package.xml")
        with contextlib.suppress(OSError, xml.ParseError):
            if xml.parse(named).getroot().findtext("name", "").strip() == package:
                tried.append(above)
        tried += [above] if os.path.basename(above) == package else []
        tried.append(os.path.join(above, package))
        if os.path.dirname(above) == above:
            break
        above = os.path.dirname(above)
    for variable, inside in (("ROS_PACKAGE_PATH", ""), ("AMENT_PREFIX_PATH", "share")):
        places = filter(None, os.environ.get(variable, "").split(os.pathsep))
        tried += [os.path.join(place, inside, package) for place in places]
    for place in tried:
        if os.path.isfile(os.path.join(place, rest)):
            return os.path.join(place, rest)
    raise ValueError(f"package://{package}/{rest}: not at, beside or above the URDF: --package {package}=FOLDER")


def mesh_path(name: str, folder: str, packages: dict[str, str]) -> str:
    scheme, colon, rest = name.partition("://")
    if colon and scheme == "package":
        package, _, rest = rest.partition("/")
        path = in_package(package, rest, folder, packages)
    elif colon and scheme != "file":
        raise ValueError(f"{name}: only files, and package:// and file://, are read")
    else:
        path = os.path.join(folder, rest if colon else name)
    try:
        with open(path, "rb") as file:
            begin = file.read(512).lstrip()
    except OSError as error:
        raise ValueError(f"{path}: {error.strerror}") from None
    if not begin:
        raise ValueError(f"{path}: it is empty")
    if begin.startswith(b"version https://git-lfs"):
        raise ValueError(f"{path}: a pointer of Git LFS, not the mesh: git lfs pull")
    if begin[:9].lower().startswith((b"<!doctype", b"<html")):
        raise ValueError(f"{path}: a web page, not a mesh")
    if not path.lower().endswith((".obj", ".stl", ".ply", ".glb", ".dae")):
        raise ValueError(f"{path}: svcd reads OBJ, STL, PLY and GLB: convert it")
    if path.lower().endswith(".glb"):
        warn(f"{path}: the y axis of a GLB stays y")
    return path


def dae_triangles(path: str, scale: Vector) -> list[Triangle]:
    """Of a COLLADA file, in metres: axes stay what they are, as ROS has it, and the unit counts."""
    try:
        import collada  # optional
    except ImportError:
        raise ValueError(f"{path}: a DAE: `pip install pycollada`, and it is converted; or convert it to OBJ") from None
    try:
        dae = collada.Collada(path)
        if next(iter(dae.scene.objects("controller")), None) is not None:
            raise ValueError(f"{path}: a DAE with a skin or a morph: convert it to OBJ")
        if dae.assetInfo.upaxis != "Z_UP":
            warn(f"{path}: {dae.assetInfo.upaxis}: its axes stay what they are")
        unit = dae.assetInfo.unitmeter or 1
        out: list[Triangle] = []
        for geometry in dae.scene.objects("geometry"):
            for primitive in geometry.primitives():
                kind = type(primitive).__name__
                if kind == "BoundLineSet":
                    continue  # no surface
                surface = primitive if kind == "BoundTriangleSet" else primitive.triangleset()
                for corners in surface.vertex_index:
                    a, b, c = ([float(x) * unit * s for x, s in zip(surface.vertex[k], scale)] for k in corners)
                    out.append(((a[0], a[1], a[2]), (b[0], b[1], b[2]), (c[0], c[1], c[2])))
    except (collada.DaeError, AttributeError, IndexError, xml.ParseError) as error:
        raise ValueError(f"{path}: no DAE that pycollada reads: {error}") from None
    if not out:
        raise ValueError(f"{path}: no triangles")
    return [(a, c, b) for a, b, c in out] if scale[0] * scale[1] * scale[2] < 0 else out


# ---- robots

class Robot:
    """A URDF: what is on each link, and in which frame of which joint the link is."""

    def __init__(self, path: str, given: Given) -> None:
        self.path = path
        self.given = given
        root = read(path, URDF, given.ignored)
        self.name = root.get("name", "")
        with about(path):
            self.links = self.named(root, "link")
            self.elements = self.named(root, "joint")
            self.above = self.tree()
            self.joints: list[tuple[str, str, Frame, xml.Element]] = []  # name, parent, frame, element
            self.place: dict[str, tuple[str, Frame]] = {}  # of a link: the joint before it, its frame there
            for link in self.links:
                self.settle(link)
            self.bodies = {name: self.collisions(name) for name in self.links}
        seen = [name for name, link in self.links.items() if link.find("visual") is not None]
        hollow = [name for name in seen if not self.bodies[name]]
        if hollow:
            warn(f"{path}: seen, but without a collision element, so nothing hits them: {', '.join(hollow)}")

    def named(self, root: xml.Element, tag: str) -> dict[str, xml.Element]:
        found: dict[str, xml.Element] = {}
        for element in root.findall(tag):
            name = element.get("name", "")
            if not NAME.fullmatch(name) or (tag == "joint" and name == "world"):
                raise ValueError(f"a {tag} named '{name}': a name in a planning file has no blanks and no #")
            if name in found:
                raise ValueError(f"two {tag}s named {name}")
            found[name] = element
        return found

    def tree(self) -> dict[str, str]:
        """The joint above each link that has one."""
        above: dict[str, str] = {}
        for name, joint in self.elements.items():
            with about(f"joint {name}"):
                for end in ("parent", "child"):
                    link = text_of(inner(joint, end), "link")
                    if link not in self.links:
                        raise ValueError(f"its {end}, {link}, is no link of this file")
                if link in above:
                    raise ValueError(f"{link} is the child of {above[link]} already")
                above[link] = name
        return above

    def parent(self, link: str) -> str:
        return text_of(inner(self.elements[self.above[link]], "parent"), "link")

    def settle(self, link: str) -> None:
        chain: list[str] = []
        while link not in self.place and link in self.above:
            if link in chain:
                raise ValueError(f"link {link}: joints go round in a loop")
            chain.append(link)
            link = self.parent(link)
        self.place.setdefault(link, ("world", HERE))
        for link in reversed(chain):
            name = self.above[link]
            with about(f"joint {name}"):
                before, frame = self.place[self.parent(link)]
                frame = within(frame, origin_of(self.elements[name]))
                value = self.held(name)
                if value is None:
                    self.joints.append((name, before, frame, self.elements[name]))
                    self.place[link] = (name, HERE)
                else:
                    self.place[link] = (before, within(frame, moved(self.elements[name], value)))

    def held(self, name: str, followers: tuple[str, ...] = ()) -> float | None:
        """Where a joint stands that does not move; None: it moves."""
        joint = self.elements[name]
        kind = joint.get("type", "")
        mimic = joint.find("mimic")
        value = None
        if name in self.given.held:
            value = self.given.held[name]
        elif kind == "fixed":
            value = 0.0
        elif kind not in MOVES:
            raise ValueError(f"it is '{kind}'; revolute, continuous, prismatic and fixed are known; "
                             f"--fixed {name} holds it where it is")
        elif mimic is not None:
            leader = text_of(mimic, "joint")
            if leader not in self.elements or leader in (*followers, name):
                raise ValueError(f"it mimics {leader}, which is no joint, or mimics it")
            stands = self.held(leader, (*followers, name))
            multiplier = number(mimic, "multiplier", 1)
            if stands is not None or multiplier == 0:
                value = multiplier * (stands or 0) + number(mimic, "offset", 0)
        if value is not None and kind in ("revolute", "prismatic") and has_limits(joint):
            low, high = limits(joint)
            if not low - 1e-9 <= value <= high + 1e-9:
                raise ValueError(f"held at {value:g}, which is not within its limits, {low:g} to {high:g}")
        if value and kind not in MOVES:
            raise ValueError(f"it is '{kind}', and stands where it is: --fixed {name}, without a value")
        return value

    def driver(self, name: str) -> tuple[str, float, float]:
        """The joint that drives one that moves, or itself; multiplier and offset, over joints between."""
        mimic = self.elements[name].find("mimic")
        if mimic is None:
            return name, 1.0, 0.0
        leader, multiplier, offset = self.driver(text_of(mimic, "joint"))
        factor = number(mimic, "multiplier", 1)
        return leader, factor * multiplier, factor * offset + number(mimic, "offset", 0)

    def mimic_line(self, name: str) -> str:
        """Empty: it mimics none."""
        leader, multiplier, offset = self.driver(name)
        if leader == name:
            return ""
        with about(f"joint {name}"):
            if not 1e-6 <= abs(multiplier) <= MOST or abs(offset) > MOST:
                raise ValueError(f"it mimics {leader}, {multiplier:g} times that and {offset:g}: too little, or too much")
            is_endless = all(self.elements[joint].get("type") == "continuous" for joint in (name, leader))
            if is_endless and multiplier != round(multiplier):
                raise ValueError(f"it mimics {leader}, which is continuous like it, {multiplier:g} times: no whole number, "
                                 f"so a turn of {leader} does not bring both back; limits of one would do")
        return f"mimic {name} {leader} {words_of(multiplier, offset)}"

    def collisions(self, link: str) -> list[Body]:
        """The first has the link's name; simple shapes are one body."""
        shapes: list[list[Triangle]] = []
        meshes: list[tuple[str, Frame, Vector]] = []
        with about(f"link {link}"):
            for collision in self.links[link].findall("collision"):
                frame = within(self.place[link][1], origin_of(collision))
                geometry = inner(collision, "geometry")
                if len(geometry) != 1:
                    raise ValueError(f"a <geometry> of {len(geometry)} shapes: one is expected")
                element = geometry[0]
                if element.tag == "mesh":
                    name = text_of(element, "filename")
                    path = mesh_path(name, os.path.dirname(self.path), self.given.packages)
                    scale = three(element, "scale", (1, 1, 1))
                    if not all(1e-6 <= abs(factor) <= 1e6 for factor in scale):
                        raise ValueError(f"{path}: a scale, or minus one, is not in 1e-6..1e6")
                    meshes.append((path, frame, scale))
                else:
                    triangles = shape(element, self.given.finest)
                    shapes.append([(apply(frame, a), apply(frame, b), apply(frame, c)) for a, b, c in triangles])
            bodies = [Body(link, shapes)] if shapes else []
            for path, frame, scale in meshes:
                name = f"{link}.{len(bodies) + 1}" if bodies else link
                if path.lower().endswith(".dae"):
                    triangles = dae_triangles(path, scale)
                    own = [[(apply(frame, a), apply(frame, b), apply(frame, c)) for a, b, c in triangles]]
                    bodies.append(Body(name, own))
                else:
                    bodies.append(Body(name, [], path, frame, scale))
            return bodies

    def beside(self, link: str) -> set[str]:
        """Links with bodies that one joint that moves, and no other body, parts from a link."""
        moves = {name for name, _, _, _ in self.joints}
        ends = [(child, self.parent(child), joint in moves) for child, joint in self.above.items()]
        found: set[str] = set()
        waiting = [(link, 0)]
        seen: set[tuple[str, int]] = set(waiting)
        while waiting:
            at, crossed = waiting.pop()
            for child, parent, is_moving in ends:
                if at not in (child, parent):
                    continue
                step = (parent if at == child else child, crossed + is_moving)
                if step in seen or step[1] > 1:
                    continue
                seen.add(step)
                if not self.bodies[step[0]]:
                    waiting.append(step)
                elif step[1] == 1:
                    found.add(step[0])
        return found


def shape(element: xml.Element, finest: float | None) -> list[Triangle]:
    if element.tag == "box":
        size = three(element, "size", (0, 0, 0))
        if not min(size) > 0:
            raise ValueError("<box>: size is not positive")
        return box(size)
    radius = positive(element, "radius")
    sides = sides_of(radius, finest)
    if element.tag == "cylinder":
        return cylinder(radius, positive(element, "length"), sides)
    return capsule(radius, positive(element, "length") if element.tag == "capsule" else 0, sides)


def has_limits(joint: xml.Element) -> bool:
    limit = joint.find("limit")
    return limit is not None and not (limit.get("lower") is None and limit.get("upper") is None)


def limits(joint: xml.Element) -> tuple[float, float]:
    """Soft ones as well."""
    if not has_limits(joint):
        raise ValueError("no limits")
    limit = inner(joint, "limit")
    low, high = number(limit, "lower", 0), number(limit, "upper", 0)
    soft = joint.find("safety_controller")
    if soft is not None:
        low = max(low, number(soft, "soft_lower_limit", low))
        high = min(high, number(soft, "soft_upper_limit", high))
    if low > high:
        raise ValueError(f"its lower limit, {low:g}, is above the upper one, {high:g}")
    return low, high


def joint_line(name: str, parent: str, frame: Frame, joint: xml.Element, velocity: float | None) -> str:
    with about(f"joint {name}"):
        kind = joint.get("type", "")
        limit = joint.find("limit")
        low, high = (0.0, 0.0) if kind == "continuous" else limits(joint)
        speed = None if limit is None or limit.get("velocity") is None else number(limit, "velocity")
        if speed is None and velocity is None:
            warn(f"joint {name}: no velocity: 1 is taken, or what --velocity says")
        if speed is None or (speed == 0 and velocity is not None):
            speed = velocity or 1.0
        if speed <= 0:
            raise ValueError(f"its velocity is {speed:g}: it could not move; --velocity V is for joints that have 0")
        acceleration = 3 * speed  # no word of URDF's own
        if limit is not None and limit.get("acceleration") is not None:
            acceleration = positive(limit, "acceleration")
        turn = words_of(*axis_of(joint))
        ends = words_of(low, high, speed, acceleration)
        return f"joint {name} {parent} {pose_of(frame)} {turn} {kind} {ends}"


class Semantics:
    """An SRDF: which pairs are not asked, and which joints nobody drives."""

    def __init__(self, path: str | None, robot: Robot, given: Given) -> None:
        self.off: set[frozenset[str]] = set()
        self.on: set[frozenset[str]] = set()
        self.silent: set[str] = set()
        self.virtual: set[str] = set()
        self.groups: dict[str, list[str]] = {}  # joints that move, in their order
        if path is None:
            return
        root = read(path, SRDF, given.ignored)
        moves = {name for name, _, _, _ in robot.joints if robot.driver(name)[0] == name}
        if root.get("name", "") != robot.name:
            warn(f"{path}: it is of '{root.get('name', '')}', the URDF of '{robot.name}'")
        with about(path):
            for element in root:
                if element.tag in ("disable_collisions", "enable_collisions"):
                    links = [text_of(element, "link1"), text_of(element, "link2")]
                    (self.off if element.tag[0] == "d" else self.on).add(frozenset(links))
                elif element.tag == "disable_default_collisions":
                    links = [text_of(element, "link")]
                    self.silent.update(links)
                elif element.tag == "group":
                    links = []
                else:
                    links = []
                    name = text_of(element, "name")
                    is_free = name in moves
                    if element.tag == "virtual_joint":
                        self.virtual.add(name)
                        is_free = text_of(element, "type") != "fixed" and name not in given.held
                    elif name not in robot.elements:
                        warn(f"{path}: {element.tag}: no joint {name}")
                    if is_free:
                        raise ValueError(f"{element.tag} {name}: no motor drives it; --fixed {name} holds it")
                for link in links:
                    if link not in robot.links:
                        warn(f"{path}: {element.tag}: no link {link}")
            for both in self.off & self.on:
                raise ValueError(f"collisions of {' and '.join(sorted(both))} are disabled, and enabled")
            known = {text_of(element, "name"): element for element in root.findall("group")}
        for name in known:
            self.take_group(name, known, robot, f"{path}: group {name}")

    def take_group(self, name: str, known: dict[str, xml.Element], robot: Robot, place: str) -> None:
        found: set[str] = set()
        waiting = [name]
        seen: set[str] = set()
        while waiting:
            group = waiting.pop()
            for element in known[group] if group not in seen else ():
                with about(place):
                    joints = self.joints_of(element, robot)
                inside = element.get("name", "") if element.tag == "group" else ""
                if inside in known:
                    waiting.append(inside)
                elif joints is None:
                    ends = [element.get(key, "") for key in ("name", "base_link", "tip_link") if key in element.keys()]
                    warn(f"{place}: no {element.tag} {' to '.join(ends)}")
                found.update(joints or ())
            seen.add(group)
        self.groups[name] = [joint for joint, _, _, _ in robot.joints if joint in found]
        if not self.groups[name]:
            warn(f"{place}: none of its joints moves, so it is left out")
        elif not NAME.fullmatch(name):
            raise ValueError(f"{place}: a name in a planning file has no blanks and no #")

    def joints_of(self, element: xml.Element, robot: Robot) -> set[str] | None:
        """Of a line of a group; None: it names what is not there, or another group."""
        if element.tag == "joint":
            joint = text_of(element, "name")
            return {joint} if joint in robot.elements or joint in self.virtual else None
        if element.tag == "link":
            link = text_of(element, "name")
            return {robot.above.get(link, "")} if link in robot.links else None
        if element.tag == "group":
            text_of(element, "name")
            return None
        base, link = text_of(element, "base_link"), text_of(element, "tip_link")
        found: set[str] = set()
        while link != base:
            if link not in robot.above:
                return None
            found.add(robot.above[link])
            link = robot.parent(link)
        return found

    def asks(self, a: str, b: str) -> bool | None:
        """None: as without an SRDF."""
        pair = frozenset((a, b))
        if pair in self.on or pair in self.off:
            return pair in self.on
        return False if self.silent & pair else None


# ---- the planning file

class Output:
    """Files to be written, all or none; none of them over an input."""

    def __init__(self, out: str) -> None:
        self.out = out
        self.folder = os.path.dirname(out)
        self.files: dict[str, str] = {}
        self.inputs: set[str] = set()
        self.taken: set[str] = set()

    def reference(self, body: Body, prefix: str) -> str:
        """The file of a body, as the planning file names it."""
        if not body.mesh:
            stem = os.path.splitext(os.path.basename(self.out))[0]
            base = re.sub(r"[^\w.+-]", "_", f"{stem}_{prefix}{body.name}", flags=re.ASCII)
            name = f"{base}.obj"
            for k in range(2, 2 + len(self.taken)):
                name = f"{base}~{k}.obj" if name.lower() in self.taken else name
            self.taken.add(name.lower())
            self.files[os.path.join(self.folder, name)] = obj_text(body.shapes)
            return name
        path = os.path.realpath(body.mesh)
        self.inputs.add(path)
        with contextlib.suppress(ValueError):  # on another drive
            path = os.path.relpath(path, os.path.realpath(self.folder or "."))
        path = path.replace(os.sep, "/")
        if not NAME.fullmatch(path):
            raise ValueError(f"{path}: a planning file cannot name it: no blanks, no #")
        return path

    def write(self, inputs: list[str], text: str) -> None:
        self.files[self.out] = text
        self.inputs.update(os.path.realpath(path) for path in inputs)
        for path in self.files:
            if os.path.realpath(path) in self.inputs:
                raise ValueError(f"{path}: it would be written over: another name of OUT.txt, please")
        for path, content in self.files.items():
            with open(path, "w", encoding="utf-8") as file:
                file.write(content)


def scaled(body: Body) -> str:
    return "" if body.scale == (1, 1, 1) else f" scale {words_of(*body.scale)}"


def robot_lines(robot: Robot, rules: Semantics, output: Output) -> list[str]:
    if not robot.links:
        raise ValueError("no link; xacro files are to be run through xacro first")
    roots = [link for link in robot.links if link not in robot.above]
    if len(roots) > 1:
        raise ValueError(f"no joint reaches the link {roots[1]}, nor {roots[0]}: a robot has one root")
    lines = [joint_line(*joint, robot.given.velocity) for joint in robot.joints]
    lines += filter(None, (robot.mimic_line(name) for name, _, _, _ in robot.joints))
    owners = {body.name: link for link, bodies in robot.bodies.items() for body in bodies}
    if not lines:
        raise ValueError("no joint that moves")
    if not owners:
        raise ValueError("no collision element: nothing would be asked")
    if len(owners) < sum(map(len, robot.bodies.values())):
        raise ValueError("two bodies of one name: a link is named as the second shape of another, NAME.2")
    for bodies in robot.bodies.values():
        for body in bodies:
            pose = f" pose {pose_of(body.frame)}" if body.mesh and body.frame != HERE else ""
            joint = robot.place[owners[body.name]][0]
            lines.append(f"body {body.name} {joint} {output.reference(body, '')}{pose}{scaled(body)}")
    near = {link: robot.beside(link) for link in owners.values()}
    names = list(owners)
    for index, first in enumerate(names):
        for second in names[index + 1:]:
            a, b = owners[first], owners[second]
            asked = rules.asks(a, b)
            if robot.place[a][0] != robot.place[b][0] and (b not in near[a] if asked is None else asked):
                lines.append(f"pair {first} {second}")
    lines += [f"group {name} {' '.join(joints)}" for name, joints in rules.groups.items() if joints]
    return lines


def scene_lines(name: str, world: Robot, taken: set[str], output: Output) -> list[str]:
    if not NAME.fullmatch(name):
        raise ValueError(f"--scene '{name}': blanks and # are no part of a name")
    for joint, _, _, _ in world.joints:
        raise ValueError(f"joint {joint}: an obstacle that moves: --fixed {joint}=VALUE holds it")
    lines = [f"scene {name}"]
    for body in (body for bodies in world.bodies.values() for body in bodies):
        if body.name in taken:
            raise ValueError(f"link {body.name}: the robot, or this scene, has a body of this name")
        taken.add(body.name)
        path = output.reference(body, f"{name}_")
        lines.append(f"obstacle {body.name} {path} {pose_of(body.frame)}{scaled(body)}")
    if len(lines) == 1:
        warn(f"{world.path}: no collision element: scene {name} is empty")
    return lines


def convert(urdf: str, srdf: str | None, scenes: list[tuple[str, str]], out: str, given: Given) -> None:
    robot = Robot(urdf, given)
    rules = Semantics(srdf, robot, given)
    worlds = [(name, Robot(path, given)) for name, path in scenes]
    known = set(robot.elements) | rules.virtual | {name for _, world in worlds for name in world.elements}
    for name in set(given.held) - known:
        raise ValueError(f"--fixed {name}: there is no such joint")
    output = Output(out)
    with about(urdf):
        lines = ["nsvcd-plans 1", *robot_lines(robot, rules, output)]
    bodies = {body.name for found in robot.bodies.values() for body in found}
    if len(set(name for name, _ in scenes)) < len(scenes):
        raise ValueError("two scenes of one name")
    for name, world in worlds:
        with about(world.path):
            lines += scene_lines(name, world, set(bodies), output)
    inputs = [urdf, *(path for _, path in scenes), *([srdf] if srdf else [])]
    output.write(inputs, "\n".join(lines) + "\n")


def pairs_of(option: str, texts: list[str], default: str | None) -> dict[str, str]:
    """NAME=VALUE each; default: of NAME alone."""
    found: dict[str, str] = {}
    for text in texts:
        name, equals, value = text.partition("=")
        if not equals and default is None:
            raise ValueError(f"{option} {text}: expected NAME=VALUE")
        found[name] = value if equals else default or ""
    return found


def value_of(option: str, text: str) -> float:
    if not NUMBER.fullmatch(text):
        raise ValueError(f"{option} {text}: not a number")
    return float(text)


def remove_old(out: str) -> None:
    """A planning file of an earlier run is not to be taken for that of this one."""
    with contextlib.suppress(OSError):
        with open(out, "rb") as file:
            is_old = file.read(11) == b"nsvcd-plans"
        if is_old:
            os.remove(out)


def main() -> int:
    parser = argparse.ArgumentParser(description="From a URDF to a planning file")
    parser.add_argument("urdf")
    parser.add_argument("out")
    parser.add_argument("--srdf")
    parser.add_argument("--scene", nargs=2, action="append", default=[], metavar=("NAME", "WORLD.urdf"))
    parser.add_argument("--package", action="append", default=[], metavar="NAME=FOLDER",
                        help="where package://NAME is")
    parser.add_argument("--fixed", action="append", default=[], metavar="JOINT[=VALUE]",
                        help="a joint that stands at this value (0), and so do those that mimic it")
    parser.add_argument("--round", metavar="METRES", help="by how much corners of what is round may stand out, "
                        "instead of 32 sides (0.5 %% of the radius, of balls 1 %%)")
    parser.add_argument("--velocity", metavar="V", help="of joints that have none, or 0; 1 if not given")
    parser.add_argument("--ignore", action="append", default=[], metavar="WORD",
                        help="an element or attribute that is not known, and may be left out")
    asked = parser.parse_args()
    try:
        held = {name: value_of("--fixed", value) for name, value in pairs_of("--fixed", asked.fixed, "0").items()}
        sizes = [None if text is None else value_of(option, text)
                 for option, text in (("--velocity", asked.velocity), ("--round", asked.round))]
        if any(value is not None and value <= 0 for value in sizes):
            raise ValueError("--velocity or --round is not positive")
        given = Given(held, pairs_of("--package", asked.package, None), set(asked.ignore), *sizes)
        convert(asked.urdf, asked.srdf, [tuple(scene) for scene in asked.scene], asked.out, given)
    except (ValueError, OSError) as error:
        said = f"{error.filename}: {error.strerror}" if isinstance(error, OSError) else error
        print(f"urdf.py: {said}", file=sys.stderr)
        remove_old(asked.out)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
