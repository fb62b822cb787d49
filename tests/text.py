"""Is neuralsvcd.h a text as it wants to be? Prints what is not, and the length of its lines; exit
status 1 if something is not.

  lines      100 columns at most
  functions  60 lines at most
  statements one a line: none joined by commas, but in the head of a for loop
  contents   the list of contents names the sections, all of them, in their order
  order      a section uses nothing that a later one makes
  width      a line of code has 38 characters at most, on average, its indentation left out
  paths      the files that it names are there
"""

import re
import sys
from pathlib import Path

COLUMNS = 100
LINES = 60
WIDTH = 38


def is_listed_name(line: str) -> bool:
    """Is the line one of the names that tests/isa.py writes?"""
    return re.match(r"#define \w+ NSVCD__(?:NUMBER_)?AT\(\w+\)$", line) is not None


def code_of(line: str) -> str:
    """The line without its comment; strings of the header hold no slashes."""
    return "" if is_listed_name(line) else line.split("//")[0].rstrip()


def sections_of(lines: list[str]) -> list[tuple[str, int, int]]:
    """Names, first lines and ends of the sections."""
    starts = [(match.group(1), n) for n, line in enumerate(lines) if (match := re.match(r"// -{20,} (.+)$", line))]
    ends = [start for _, start in starts[1:]] + [len(lines)]
    return [(name, start, end) for (name, start), end in zip(starts, ends)]


def long_lines(lines: list[str]) -> list[str]:
    return [f"{n + 1}: {len(line)} columns" for n, line in enumerate(lines) if len(line) > COLUMNS]


def long_functions(lines: list[str]) -> list[str]:
    faults = []
    start = None
    for n, line in enumerate(lines):
        if re.match(r"[A-Za-z].*\(", line) and not line.startswith(("typedef", "#")):
            start = n
        if line and not line[0].isspace() and code_of(line).endswith((";", "}")) and line != "}":
            start = None  # a prototype, or a function of one line
        if line == "}" and start is not None:
            if n - start + 1 > LINES:
                faults.append(f"{start + 1}: a function of {n - start + 1} lines")
            start = None
    return faults


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


def contents_faults(lines: list[str], names: list[str]) -> list[str]:
    start = next(n for n, line in enumerate(lines) if line.startswith("// CONTENTS"))
    listed = []
    for line in lines[start + 1 :]:
        if line == "//":
            break
        listed.append(re.match(r"//   (\S+(?: \S+)*)", line).group(1))
    return [] if listed == names else [f"{start + 1}: the contents list {listed}, the sections are {names}"]


def order_faults(lines: list[str], sections: list[tuple[str, int, int]]) -> list[str]:
    """What is private is made where its name first stands in code as a function's, a type's or a macro's."""
    made: dict[str, int] = {}
    for index, (_, start, end) in enumerate(sections):
        for line in lines[start:end]:
            code = code_of(line)
            for pattern in (
                r"^(?:static|NSVCD__INLINE|NSVCD__APART|inline| |\w|\*)*?\b(nsvcd__\w+)\(.*",
                r"^} (nsvcd__\w+);",
                r"^typedef .*\b(nsvcd__\w+)(?:\(.*\))?;",
                r"^ *#define (NSVCD__\w+)",
            ):
                match = re.match(pattern, code)
                if match and (not line[0].isspace() or "#define" in line):
                    made.setdefault(match.group(1), index)
    del made["NSVCD__ISA"]  # says in every section whether it is compiled for the first time
    faults = []
    for index, (name, start, end) in enumerate(sections):
        for n in range(start, end):
            for word in re.findall(r"\b(?:nsvcd|NSVCD)__\w+", code_of(lines[n])):
                if made.get(word, 0) > index:
                    faults.append(f"{n + 1}: section {name} uses {word}, of section {sections[made[word]][0]}")
    return faults


def code_lines(lines: list[str]) -> list[str]:
    """Without blank lines and those that are a comment; without indentation."""
    stripped = [line.strip() for line in lines if not is_listed_name(line)]
    return [line for line in stripped if line and not line.startswith("//")]


def width_faults(lines: list[str]) -> list[str]:
    code = code_lines(lines)
    mean = sum(map(len, code)) / len(code)
    return [f"1: {mean:.2f} characters a line of code"] if mean > WIDTH else []


def missing_paths(lines: list[str]) -> list[str]:
    faults = []
    for n, line in enumerate(lines):
        for path in re.findall(r"\b(?:tests|examples|train)/[\w/]*\w+\.\w+", line):
            if not Path(path).exists():
                faults.append(f"{n + 1}: there is no {path}")
    return faults


def main() -> int:
    path = sys.argv[1] if len(sys.argv) > 1 else "neuralsvcd.h"
    with open(path, encoding="ascii") as file:
        lines = file.read().split("\n")
    sections = sections_of(lines)
    faults = long_lines(lines) + long_functions(lines) + joined_statements(lines)
    faults += contents_faults(lines, [name for name, _, _ in sections]) + order_faults(lines, sections)
    faults += width_faults(lines) + missing_paths(lines)
    for fault in faults:
        print(f"{path}:{fault}")
    code = code_lines(lines)
    mean = sum(map(len, code)) / len(code)
    print(f"text: {len(code)} lines of code, {mean:.2f} characters on average; {len(sections)} sections")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
