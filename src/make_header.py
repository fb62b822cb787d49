"""Writes neuralsvcd.h from the rooms of this folder.

    python3 src/make_header.py          writes it
    python3 src/make_header.py --check  is it what would be written? Exit status 1 if not

header.h is the plan: it names the rooms, floor by floor, in the order in which data flows. Each room takes its
place in the file under a line with its name. What a room includes of this folder is left out, since it stands above
already: a room that includes what stands below is refused, and so is a macro that is defined twice: compilers take that
without a word where both are the same, and then whoever changes one changes neither or both. Two lists are made here:

  the contents       the rooms with what header.h says of them, where it has a line `// CONTENTS`
  names of a set     entry/processor.h compiles the rooms between `#endif  // NSVCD__ISA` and `#ifndef NSVCD__ISA` once more
                     for each set of instructions; what they define must then be called otherwise
"""

import re
import sys
from pathlib import Path

SRC = Path(__file__).parent
HEADER = SRC.parent / "neuralsvcd.h"
WIDTH = 100
ROOM = re.compile(r'#include "(?P<path>[\w/]+)\.h"  +// (?P<says>.+)')
FLOOR = re.compile(r"// ={20,} (?P<name>\w+): (?P<says>.+)")
INCLUDE = re.compile(r'#include "([\w./]+\.h)"')
NAMES = "// ---- the names, as src/make_header.py writes them\n"


class Refused(Exception):
    pass


def room_text(src: Path, path: str, above: list[str]) -> str:
    """A room as it stands in the header: without what it includes of this folder, all of which must be above."""
    file = src / f"{path}.h"
    lines = []
    for line in file.read_text(encoding="ascii").splitlines():
        include = INCLUDE.match(line)
        if include and (file.parent / include[1]).exists():
            needed = (file.parent / include[1]).resolve().relative_to(src.resolve()).with_suffix("").as_posix()
            if needed not in above:
                raise Refused(f"src/{path}.h includes {needed}, which does not stand above it")
        elif line != "#pragma once":
            lines.append(line)
    return "\n".join(lines) + "\n"


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


def made_of(src: Path) -> str:
    plan = (src / "header.h").read_text(encoding="ascii").splitlines()
    out: list[str] = []
    above: list[str] = ["header"]
    by_set: list[str] = []  # the texts of rooms that are compiled for each set
    once = True  # what stands before the implementation is
    for line in plan:
        room = ROOM.match(line)
        if line == "// CONTENTS":
            out += contents(plan)
        elif room:
            text = room_text(src, room["path"], above)
            above.append(room["path"])
            if not once:
                by_set.append(text)
            out += ["", f"// {'-' * (WIDTH - 4 - len(room['path']))} {room['path']}", text.rstrip("\n")]
        else:
            once = (once or line == "#ifndef NSVCD__ISA") and line != "#endif  // NSVCD__ISA"
            out.append(line)
    names = renamed(names_of("\n".join(by_set)))
    text = "\n".join(out) + "\n"
    if text.count(NAMES) != 1:
        raise Refused(f"there must be one line {NAMES.strip()}")
    if twice := defined_twice(text):
        raise Refused(f"defined twice: {', '.join(twice)}")
    return re.sub(r"\n{3,}", "\n\n", text.replace(NAMES, NAMES + names))


def main() -> int:
    try:
        text = made_of(SRC)
    except (Refused, OSError) as refused:
        print(f"make_header: {refused}")
        return 1
    if "--check" not in sys.argv:
        HEADER.write_text(text, encoding="ascii")
    elif not HEADER.exists() or HEADER.read_text(encoding="ascii") != text:
        print("neuralsvcd.h is stale: make header")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
