"""Are the rooms of src/ a text as they want to be, and do the links of all .md files lead somewhere? Prints what is not so,
and how much text there is; exit status 1 if something is not. That a room uses none below it, src/make_header.py sees to.

  lines      100 columns at most
  rooms      500 lines at most; each says first what comes in and what goes out
  functions  60 lines at most
  statements one a line: none joined by commas, but in the head of a for loop
  width      a line of code has 39.4 characters at most, on average, without indentation and comments
  names      no private name is a public one but for an underscore
  paths      the files that it names are there, of .md files too
  links      of .md files: the file is there, and so is the heading that is named behind a #
  counts     the lines of the checker, without its contracts for formal/wp.sh, are as many as README says, to a hundred
  README     is a page: 110 lines at most, and 25 numbers in its text
  tables     no row of a comment's table is cut, as a formatter does: a word or two at the margin, and the rest below
"""

import re
import sys
from pathlib import Path

SRC = Path(__file__).parent.parent / "src"
COLUMNS = 100
ROOM = 500
LINES = 60
WIDTH = 39.4
PAGE = 110
NUMBERS = 25


def code_of(line: str) -> str:
    """The line without its comment; strings of the library hold no slashes."""
    return line.split("//")[0].rstrip()


def long_lines(lines: list[str]) -> list[str]:
    return [f"{n + 1}: {len(line)} columns" for n, line in enumerate(lines) if len(line) > COLUMNS]


def room_faults(lines: list[str]) -> list[str]:
    faults = [f"{ROOM}: a room of {len(lines)} lines"] if len(lines) > ROOM else []
    top = " ".join(lines[: next(n for n, line in enumerate(lines) if not line.startswith("//"))])
    if not re.search(r"\bIn(, out)?: ", top) or not re.search(r"[Oo]ut: ", top):
        faults.append("1: what comes in, and what goes out?")
    return faults


def functions_of(lines: list[str]) -> list[tuple[int, int]]:
    """First and last lines of the functions."""
    found = []
    start = None
    for n, line in enumerate(lines):
        if re.match(r"[A-Za-z].*\(", line) and not line.startswith(("typedef", "#")):
            start = n
        if line and not line[0].isspace() and code_of(line).endswith((";", "}")) and line != "}":
            start = None  # a prototype
        if line == "}" and start is not None:
            found.append((start, n))
            start = None
    return found


def long_functions(lines: list[str]) -> list[str]:
    return [f"{a + 1}: a function of {b - a + 1} lines" for a, b in functions_of(lines) if b - a + 1 > LINES]


def at_depth_0(text: str) -> list[str]:
    """The parts of a text between commas outside of brackets."""
    parts, depth = [""], 0
    for letter in text:
        depth += (letter in "([{") - (letter in ")]}")
        if letter == "," and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return parts


def joined_statements(lines: list[str]) -> list[str]:
    faults = []
    statement, first = "", 0
    for n, line in enumerate(lines):
        code = code_of(line).strip()
        if not line.startswith(" ") or code.startswith("#") or line.endswith("\\"):
            statement = ""
            continue
        first = first if statement else n
        statement = f"{statement} {code}".strip()
        if not statement.endswith((";", "{", "}", ":")) or statement.count("(") > statement.count(")"):
            continue
        if statement.endswith(";"):
            bare = statement[:-1]
            for head in re.finditer(r"^(?:else )?(?:if|for|while) \(", bare):
                depth, at = 1, head.end()
                while depth:
                    depth += (bare[at] == "(") - (bare[at] == ")")
                    at += 1
                bare = bare[at:].strip()
            parts = at_depth_0(bare)
            if len(parts) > 1 and sum("=" in part or "++" in part for part in parts) > 0:
                faults.append(f"{first + 1}: joined by commas: {statement[:60]}")
        statement = ""
    return faults


def code_lines(lines: list[str]) -> list[str]:
    """Code alone: no blank lines, comments, indentation, and nothing that only ties rooms together."""
    ties = re.compile(r'#pragma once|#include "[\w./]+"$')
    code = [re.sub(r"\s+// .*", "", line).strip() for line in lines]
    return [line for line in code if line and not line.startswith("//") and not ties.match(line)]


def missing_paths(lines: list[str]) -> list[str]:
    faults = []
    for n, line in enumerate(lines):
        for path in re.findall(r"\b(?:src|tests|examples|train)/[\w/]*\w+\.\w+", line):
            if not Path(path).exists():
                faults.append(f"{n + 1}: there is no {path}")
    return faults


def prose_of(text: str) -> str:
    """What is not code: neither a block nor a word in backticks."""
    return re.sub(r"`[^`\n]*(?:\n[^`\n]+)?`", "", re.sub(r"(?ms)^```.*?^```", "", text))


def anchors_of(text: str) -> set[str]:
    """Of the headings, as GitHub makes them: words in small letters, joined by hyphens; the second of a name ends in -1."""
    found: set[str] = set()
    for heading in re.findall(r"(?m)^#{1,6} +(.*?) *$", re.sub(r"(?ms)^```.*?^```", "", text)):
        words = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).lower()
        name = again = re.sub(r"[^\w\- ]", "", words).replace(" ", "-")
        for k in range(1, 100):
            if again not in found:
                break
            again = f"{name}-{k}"
        found.add(again)
    return found


def dead_links(path: Path) -> list[str]:
    faults = []
    for link in re.findall(r"\]\(([^)\s]+)\)", prose_of(path.read_text(encoding="utf-8"))):
        if re.match(r"[a-z]+:", link):
            continue
        file, _, anchor = link.partition("#")
        target = path.parent / file if file else path
        if not target.exists():
            faults.append(f" there is no {link}")
        elif anchor and target.suffix == ".md" and anchor not in anchors_of(target.read_text(encoding="utf-8")):
            faults.append(f" there is no heading for {link}")
    return faults


def miscounted() -> list[str]:
    said = re.search(r"([\d,]+) lines in four headers", (SRC.parent / "README.md").read_text(encoding="utf-8"))
    headers = sorted((SRC.parent / "examples/verify").glob("nsvcd_verify*.h"))
    headers = [path for path in headers if path.stem != "nsvcd_verify_claim"]  # no proof rests on it
    contracts = re.compile(r"^ */\*@.*?\*/\n|^ *//@[^\n]*\n", re.S | re.M)
    lines = sum(contracts.sub("", path.read_text(encoding="utf-8")).count("\n") for path in headers)
    if said and len(headers) == 4 and abs(int(said[1].replace(",", "")) - lines) <= 100:
        return []
    return [f"the checker has {lines} lines in {len(headers)} headers, README says {said and said[1]} in four"]


def too_much() -> list[str]:
    text = (SRC.parent / "README.md").read_text(encoding="utf-8")
    prose = re.sub(r"```.*?^```|^    .*?$|\]\([^)]*\)|`[^`]*`|<[^>]*>", "", text, flags=re.S | re.M)
    lines = text.count("\n")
    numbers = len(re.findall(r"(?<![\w.-])\d", prose))
    faults = [f"{lines} lines, not at most {PAGE}"] if lines > PAGE else []
    return faults + ([f"{numbers} numbers, not at most {NUMBERS}"] if numbers > NUMBERS else [])


def cut_rows(lines: list[str]) -> list[str]:
    """A row is a name, two blanks or more, and text, which goes on below itself."""
    faults = []
    column = 0  # where the text of the row above begins; 0: there is none
    for n, line in enumerate(lines):
        comment = line.lstrip().removeprefix("//")
        below = lines[n + 1].lstrip().removeprefix("//") if n + 1 < len(lines) else ""
        if not line.lstrip().startswith("//") or not comment.strip():
            column = 0
        elif row := re.match(r" +\S.*?  +(?=\S)", comment):
            column = row.end()
        elif column > len(comment) - len(comment.lstrip()) and len(comment.split()) < 3:
            if len(below) - len(below.lstrip()) == column:
                faults.append(f"{n + 1}: a row of a table is cut: {comment.strip()}")
    return faults


def twins(texts: list[str]) -> list[str]:
    """Private names of functions, types and constants that are public ones but for an underscore."""
    names = {name for text in texts for name in re.findall(r"\b(?:nsvcd|NSVCD)_\w+", re.sub(r"//.*", "", text))}
    private = {name for name in names if re.match(r"nsvcd__|NSVCD__", name)}
    return sorted(name for name in private if name.replace("__", "_", 1) in names)


def main() -> int:
    broken = False
    code: list[str] = []
    functions = 0
    rooms = sorted(SRC.glob("*/*.h"))
    for path in [*sorted(SRC.glob("*.h")), *rooms]:
        lines = path.read_text(encoding="ascii").rstrip("\n").split("\n")
        faults = long_lines(lines) + long_functions(lines) + joined_statements(lines)
        faults += missing_paths(lines) + cut_rows(lines)
        if path in rooms:
            faults += room_faults(lines)
        for fault in faults:
            print(f"{path.relative_to(SRC.parent)}:{fault}")
        broken = broken or bool(faults)
        code += code_lines(lines)
        functions += len(functions_of(lines))
    for path in sorted(SRC.parent.rglob("*.md")):
        name = path.relative_to(SRC.parent)
        if "build" in name.parts or name.parts[0] == ".git":
            continue
        lines = path.read_text(encoding="utf-8").split("\n")
        faults = dead_links(path) + ([] if name.name == "CHANGELOG.md" else missing_paths(lines))
        for fault in faults:
            print(f"{name}:{fault}")
        broken = broken or bool(faults)
    for name in twins([path.read_text(encoding="ascii") for path in [*SRC.glob("*.h"), *rooms]]):
        print(f"src: {name} is a public name but for an underscore")
        broken = True
    for fault in miscounted() + too_much():
        print(f"README.md: {fault}")
        broken = True
    mean = sum(map(len, code)) / len(code)
    print(f"text: {len(code)} lines of code, {mean:.2f} characters on average; {functions} functions in {len(rooms)} rooms")
    return int(broken or mean > WIDTH)


if __name__ == "__main__":
    sys.exit(main())
