"""Writes neuralsvcd.h, and the headers of extras/, from the rooms of this folder.

    python3 src/make_header.py          writes them
    python3 src/make_header.py --check  are they what would be written? Exit status 1 if not
    python3 src/make_header.py --lines  with #line, so that errors and debuggers name the rooms

header.h is the plan of neuralsvcd.h: it names the rooms, floor by floor, in the order in which data flows. Each room
takes its place in the file under a line with its name. What a room includes of this folder is left out, since it stands
above already: a room that includes what stands below is refused, and so is a macro that is defined twice: compilers take
that without a word where both are the same, and then whoever changes one changes neither or both.

certify.h, robot.h and world.h are the plans of headers that use what neuralsvcd.h shows to programs, its interface, and nothing
else of it. Rooms that several headers have, as the vectors of ground/, stand in each behind a guard, so that a file that
implements two of them has these rooms once. Two lists are made here:

  the contents       the rooms with what header.h says of them, where it has a line `// CONTENTS`
  names of a set     entry/processor.h compiles the rooms between `#endif  // NSVCD__ISA` and `#ifndef NSVCD__ISA` once more
                     for each set of instructions; what they define must then be called otherwise
"""

import re
import sys
from pathlib import Path

SRC = Path(__file__).parent
PLANS = {
    "header": "neuralsvcd.h",
    "certify": "extras/neuralsvcd_certify.h",
    "robot": "extras/neuralsvcd_robot.h",
    "world": "extras/neuralsvcd_world.h",
}
WIDTH = 100
ROOM = re.compile(r'#include "(?P<path>[\w/]+)\.h"  +// (?P<says>.+)')
FLOOR = re.compile(r"// ={20,} (?P<name>\w+): (?P<says>.+)")
INCLUDE = re.compile(r'#include "([\w./]+\.h)"')
FROM_ROOMS = re.compile(r"#define NSVCD__FROM_ROOMS\b")
NAMES = "// ---- the names, as src/make_header.py writes them\n"


class Refused(Exception):
    pass


def rooms_of(src: Path, plan: str) -> list[str]:
    text = (src / f"{plan}.h").read_text(encoding="ascii")
    return [room["path"] for line in text.splitlines() if (room := ROOM.match(line))]


def room_text(src: Path, path: str, above: list[str], lines_count: bool) -> str:
    """A room as it stands in the header: without what it includes of this folder, all of which must be above."""
    file = src / f"{path}.h"
    lines = []
    for line in file.read_text(encoding="ascii").splitlines():
        include = INCLUDE.match(line)
        is_room = include and (file.parent / include[1]).exists()
        if is_room:
            needed = (file.parent / include[1]).resolve().relative_to(src.resolve()).with_suffix("").as_posix()
            if needed not in above:
                raise Refused(f"src/{path}.h includes {needed}, which does not stand above it")
        if not is_room and line != "#pragma once":
            lines.append(line)
        elif lines_count:
            lines.append("")
    return "\n".join(lines) + "\n"


def guarded(path: str, text: str) -> str:
    """A room that several headers have: who implements two of them has it once."""
    guard = "NSVCD__HAS_" + path.replace("/", "_").upper()
    return f"#ifndef {guard}\n#define {guard}\n{text.strip(chr(10))}\n#endif  // {guard}\n"


def defined_twice(text: str) -> list[str]:
    """Macros that are defined where they are already: no #undef stands between, and the two are not in different branches
    of one #if. In one room they may stand under different #ifs, for who reads one sees the other."""
    room = ""
    branches: list[tuple[int, int]] = []  # the #ifs around a line: where, and which of their branches
    places: dict[str, list[tuple[str, dict[int, int]]]] = {}
    twice: set[str] = set()
    for n, line in enumerate(text.split("\n")):
        directive = re.match(r"\s*#\s*(if|elif|else|endif|define|undef)(?:n?def)?\b\s*(\w*)", line)
        word, name = directive.groups() if directive else ("", "")
        if line.startswith("// ------------"):
            room = line
        elif word == "if":
            branches.append((n, 0))
        elif word in ("elif", "else"):
            branches[-1] = (branches[-1][0], branches[-1][1] + 1)
        elif word == "endif":
            branches.pop()
        elif word == "undef":
            places[name] = []
        elif word == "define":
            here = dict(branches)
            for where, other in places.setdefault(name, []):
                both = all(here.get(at, branch) == branch for at, branch in other.items())
                if both and (where != room or here == other):
                    twice.add(name)
            places[name].append((room, here))
    return sorted(twice)


def contents(plan: list[str]) -> list[str]:
    """The rooms, floor by floor, with what the plan says of them."""
    out = ["// CONTENTS: a room's name ends a line of dashes. Each uses only those above it."]
    for line in plan:
        if floor := FLOOR.match(line):
            out.append(f"//   {floor['name']}: {floor['says']}")
        elif room := ROOM.match(line):
            out.append(f"//     {room['path'].split('/')[1]:16}{room['says']}")
    return out


def names_of(text: str) -> list[str]:
    """What a text defines at its left margin, but macros: functions, types, enumerators, constants; without prefix."""
    names: set[str] = set()
    for enum in re.findall(r"^(?:typedef )?enum[^{;]*\{(.*?)\}", text, flags=re.MULTILINE | re.DOTALL):
        code = re.sub(r"//.*", "", enum)
        names.update(re.findall(r"\b(?:nsvcd|NSVCD)__(\w+)\b(?=\s*(?:,|=|$))", code))
    for pattern in (
        r"^typedef char\s+nsvcd__(\w+)",
        r"^(?:static|NSVCD__INLINE)\b[^(=;\n]*\bnsvcd__(\w+)\(",
        r"^static const [^(=;\n]*\bnsvcd__(\w+)(?:\[.*\])* =",
        r"^typedef [^;{\n]*\bnsvcd__(\w+)(?:\(.*\))?;",
        r"^typedef struct nsvcd__(\w+) \{",
        r"^\} nsvcd__(\w+);",
    ):
        names.update(re.findall(pattern, text, flags=re.MULTILINE))
    return sorted(names)


def renamed(names: list[str]) -> str:
    """The names as macros that add the set of instructions to each."""
    lines = [
        f"#define NSVCD__{name} NSVCD__NUMBER_AT({name})" if name.isupper() else f"#define nsvcd__{name} NSVCD__AT({name})"
        for name in names
    ]
    return "\n".join(lines) + "\n"


def numbered(text: str, name: str) -> str:
    """Where the plan goes on after a room: the number of the line itself."""
    lines = text.split("\n")
    return "\n".join(f'#line {n + 2} "{name}"' if line == "#line" else line for n, line in enumerate(lines))


def made_of(src: Path, plan: str = "header", shared: frozenset[str] = frozenset(), lines_count: bool = False) -> str:
    name = PLANS[plan]
    text_of_plan = (src / f"{plan}.h").read_text(encoding="ascii").splitlines()
    out: list[str] = []
    above: list[str] = [plan]
    if plan != "header":  # programs see these, whichever header they stand in
        above += [room for other in PLANS if other != plan for room in rooms_of(src, other) if room.startswith("interface/")]
    by_set: list[str] = []  # the texts of rooms that are compiled for each set
    once = True  # what stands before the implementation is
    for line in text_of_plan:
        room = ROOM.match(line)
        if line == "// CONTENTS":
            out += contents(text_of_plan)
        elif line == '#include "header.h"':
            out.append('#include "../neuralsvcd.h"')
        elif room:
            path = room["path"]
            text = room_text(src, path, above, lines_count)
            above.append(path)
            if not once:
                by_set.append(text)
            if lines_count:
                text = f'#line 1 "src/{path}.h"\n{text}#line'
            if path in shared:
                text = guarded(path, text)
            out += ["", f"// {'-' * (WIDTH - 4 - len(path))} {path}", text.rstrip("\n")]
        elif not FROM_ROOMS.match(line):
            once = (once or line == "#ifndef NSVCD__ISA") and line != "#endif  // NSVCD__ISA"
            out.append(line)
    text = "\n".join(out) + "\n"
    if plan == "header":
        if text.count(NAMES) != 1:
            raise Refused(f"there must be one line {NAMES.strip()}")
        names = NAMES + renamed(names_of("\n".join(by_set)))
        if lines_count:
            processor = (src / "entry/processor.h").read_text(encoding="ascii")
            names += f'#line {processor[: processor.index(NAMES)].count(chr(10)) + 2} "src/entry/processor.h"\n'
        text = text.replace(NAMES, names)
    if twice := defined_twice(text):
        raise Refused(f"defined twice: {', '.join(twice)}")
    return numbered(text, name) if lines_count else re.sub(r"\n{3,}", "\n\n", text)


def main() -> int:
    try:
        of_plans = [rooms_of(SRC, plan) for plan in PLANS]
        shared = frozenset(room for rooms in of_plans for room in rooms if sum(room in other for other in of_plans) > 1)
        texts = {name: made_of(SRC, plan, shared, "--lines" in sys.argv) for plan, name in PLANS.items()}
    except (Refused, OSError) as refused:
        print(f"make_header: {refused}")
        return 1
    for name, text in texts.items():
        header = SRC.parent / name
        if "--check" not in sys.argv:
            header.parent.mkdir(exist_ok=True)
            header.write_text(text, encoding="ascii")
        elif not header.exists() or header.read_text(encoding="ascii") != text:
            print(f"{name} is stale: make header")
            return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
