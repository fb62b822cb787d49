"""Writes build/api.html, a page of what a program sees: the comments and declarations of interface/, and what header.h
says before them, and of the headers of extras/. Nothing is said there that is not said in these files.

    python3 src/make_api.py [OUT]
"""

import html
import re
import sys
from dataclasses import dataclass
from pathlib import Path

from make_header import PLANS

SRC = Path(__file__).parent
ROOM = re.compile(r'#include "interface/(?P<name>\w+)\.h"  +// (?P<says>.+)')
NAME = re.compile(r"\b(?:nsvcd|NSVCD)_[a-zA-Z0-9]\w*")
CODE = re.compile(r"\s*#(define|include)|.*[;{}]$|.*;  // ")
HEADING = re.compile(r"([A-Z]{4}[A-Z ]+)(?:, (.*))?$", re.DOTALL)


@dataclass
class Item:
    comment: list[str]
    code: list[str]
    without: list[str]  # switches that leave it out

    def names(self) -> list[str]:
        """What it declares, the most important first."""
        text = re.sub(r"//.*", "", "\n".join(self.code))
        found = re.findall(r"^NSVCDDEF [^;(]*?\b(nsvcd_\w+)\(", text, flags=re.MULTILINE)
        found += re.findall(r"^typedef (?:(?:struct|enum) (nsvcd_\w+)|\w+ (nsvcd_\w+)\()", text, flags=re.MULTILINE)
        found += re.findall(r"^#define (NSVCD_[A-Z0-9]\w*)|^  (NSVCD_\w+)(?=,| =|\s*$)", text, flags=re.MULTILINE)
        return ["".join(name) for name in found]


def items_of(lines: list[str]) -> tuple[list[str], list[Item]]:
    """The comment at the top of a room, and what it declares."""
    top = next(n for n, line in enumerate(lines) if not line.startswith("//"))
    found: list[Item] = []
    switches: list[str] = []
    comment: list[str] = []
    code: list[str] = []
    for line in [*lines[top:], ""]:
        is_whole = not code or not line.startswith((" ", "}")) and not code[-1].endswith(("\\", ","))
        switch = re.match(r"#(if|endif|else|include|pragma|error)", line)
        if line.startswith("#define") and comment and comment[0][0].islower():  # a note on this constant alone
            code, comment = [f"// {note}" for note in comment], []
        if re.match(r"// [a-z]", line) and code and re.match(r"#define|// ", code[-1]):
            code.append(line)
            continue
        if code and is_whole and (not line or line.startswith("//") or switch):
            if not re.search(r"(?<!!)defined\(", " ".join(switches)):  # what is for some settings alone is no interface
                found.append(Item(comment, code, re.findall(r"NSVCD_NO_\w+", " ".join(switches))))
            comment, code = [], []
        if switch:
            if switch[1] == "if":
                switches.append(line.replace("#ifdef ", "defined("))
            elif switch[1] == "endif":
                switches.pop()
        elif line.startswith("//") and not code:
            comment.append(line[3:])
        elif line:
            code.append(line)
        elif not code:
            comment = []
    return [line[3:] for line in lines[:top]], [item for item in found if item.names()]


class Page:
    def __init__(self) -> None:
        self.known: set[str] = set()
        self.parts: list[str] = []
        self.contents: list[str] = []

    def linked(self, text: str, own: tuple[str, ...] = ()) -> str:
        def link(name: re.Match[str]) -> str:
            is_link = name[0] in self.known and name[0] not in own
            return f'<a href="#{name[0]}">{name[0]}</a>' if is_link else name[0]
        return NAME.sub(link, html.escape(text, quote=False))

    def prose(self, text: str, own: tuple[str, ...]) -> str:
        return re.sub(r"`(.+?)`", r"<code>\1</code>", self.linked(text, own))

    def comment(self, lines: list[str], own: tuple[str, ...] = ()) -> str:
        """Paragraphs, programs, and tables of a word and what it means, which are indented."""
        groups: list[list[str]] = [[]]
        for line in lines:
            if not line or groups[-1] and line.startswith("  ") != groups[-1][-1].startswith("  "):
                groups.append([])
            if line:
                groups[-1].append(line)
        out = ""
        for group in filter(None, groups):
            if 2 * sum(bool(CODE.match(line)) for line in group) > len(group) and group[0].startswith(" "):
                out += f"<pre>{self.linked(chr(10).join(line[2:] for line in group), own)}</pre>\n"
            elif group[0].startswith("  "):
                out += self.table(group, own)
            elif heading := HEADING.match(" ".join(group)):
                says = heading[2] or ""
                out += self.heading(heading[1].capitalize())
                out += f"<p>{self.prose(says[0].upper() + says[1:], own)}</p>\n" if says else ""
            else:
                out += f"<p>{self.prose(' '.join(group), own)}</p>\n"
        return out.replace("</pre>\n<pre>", "\n\n")

    def table(self, group: list[str], own: tuple[str, ...]) -> str:
        places = [wide.end() for line in group if (wide := re.match(r"  +\S+(?: \S+)*?  +(?=\S)", line))]
        column = max(places, key=places.count, default=0)
        rows: list[tuple[str, str]] = []
        for line in group:
            wide = re.match(r"  +(\S+(?: \S+)*?)  +(\S.*)", line)
            if wide:
                rows.append((wide[1], wide[2]))
            elif column and line[column - 1 :column] == " " and line[column:] and line[:column].strip():
                rows.append((line[:column].strip(), line[column:]))
            elif rows and (line.startswith(" " * 6) or not rows[-1][0]):
                rows[-1] = (rows[-1][0], f"{rows[-1][1]} {line.strip()}")
            else:
                rows.append(("", line.strip()))
        out = ""
        for term, says in rows:
            said = self.prose(says, own)
            out += f"<dl><dt>{self.linked(term)}</dt><dd>{said}</dd></dl>\n" if term else f"<p>{said}</p>\n"
        return out.replace("</dl>\n<dl>", "\n")

    def heading(self, title: str, level: int = 3) -> str:
        anchor = f"{title.lower().replace(' ', '-')}-{level}"
        self.contents.append(f'<a class="h{level}" href="#{anchor}">{title}</a>')
        return f'<h{level} id="{anchor}">{title}</h{level}>\n'

    def item(self, item: Item) -> None:
        own = tuple(item.names())
        functions = [name for name in own if name.islower()] or own[:1]
        self.contents += [f'<a href="#{name}">{name}</a>' for name in functions]
        code = "\n".join(item.code).replace("NSVCDDEF ", "")
        code = re.sub(r"\n {9}(?= *\w)", "\n", code) if "NSVCDDEF" in item.code[0] else code
        code = re.sub(r"//.*", r"<i>\g<0></i>", self.linked(code, own))
        for name in own:  # where it is declared
            code = re.sub(rf'(?<![\w"#]){name}\b(?=[({{ ,;]|$)', f'<b id="{name}">{name}</b>', code, count=1, flags=re.MULTILINE)
        without = f"<p><small>Not with {', '.join(item.without)}.</small></p>\n" if item.without else ""
        self.parts.append(f"<section>\n<pre>{code}</pre>\n{self.comment(item.comment, own)}{without}</section>\n")


STYLE = """
:root { color-scheme: light dark; font: 16px/1.5 system-ui, sans-serif }
body { margin: 0; display: grid; grid-template-columns: 19rem minmax(0, 1fr) }
nav { position: sticky; top: 0; height: 100vh; overflow: auto; padding: 1rem; box-sizing: border-box; font-size: 13px }
nav a { display: block; overflow-wrap: anywhere } nav .h2 { font-weight: bold; margin-top: .7rem } nav .h3 { margin-left: .7rem }
main { padding: 1rem 2rem; max-width: 54rem } a { color: light-dark(#0b57a4, #8fc1ff); text-decoration: none }
a:hover { text-decoration: underline } section { border-top: 1px solid #8886; margin-top: 1.5rem; padding-top: 1rem }
pre { background: #8881; padding: .7rem; border-radius: 6px; font-size: 13.5px; white-space: pre-wrap; overflow-wrap: anywhere }
pre i { color: light-dark(#5a6b5a, #9fb59f) } :target { background: light-dark(#ffec99, #665200) } small { opacity: .7 }
dl { display: grid; grid-template-columns: minmax(7rem, max-content) 1fr; gap: .15rem 1rem } dd { margin: 0 }
dt { font-family: ui-monospace, monospace; font-size: 13.5px; max-width: 14rem }
@media (max-width: 50rem) {
  body { display: block } nav { position: static; height: auto; columns: 2 } nav a:not(.h2) { display: none }
  main { padding: 0 1rem } dl { display: block } dd { margin: 0 0 .4rem 1rem }
}
"""


def page_of(src: Path) -> str:
    plan = (src / "header.h").read_text(encoding="ascii").splitlines()
    rooms = []
    for line in "\n".join((src / f"{name}.h").read_text(encoding="ascii") for name in PLANS).splitlines():
        if room := ROOM.match(line):
            lines = (src / "interface" / f"{room['name']}.h").read_text(encoding="ascii").splitlines()
            rooms.append((room["name"], room["says"], *items_of(lines)))
    page = Page()
    page.known = {name for _, _, _, items in rooms for item in items for name in item.names()}
    title = plan[0][3:]
    first = [line[3:] for line in plan[1 : plan.index("#ifndef NEURALSVCD_H")] if not line.startswith(("// CONTENTS", "// SPDX"))]
    page.parts.append(f"<h1>{title.partition(' - does')[0]}</h1>\n<p>Does{title.partition(' - does')[2]}</p>\n")
    page.parts.append(page.heading("Overview", 2) + page.comment(first))
    for name, says, top, items in rooms:
        page.parts.append(page.heading(name.capitalize(), 2) + page.comment([f"{says[0].upper()}{says[1:]}. {top[0]}", *top[1:]]))
        for item in items:
            page.item(item)
    return (f'<!DOCTYPE html>\n<html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">\n'
            f"<title>{title}</title>\n<style>{STYLE}</style>\n<nav>{chr(10).join(page.contents)}</nav>\n"
            f"<main>\n{''.join(page.parts)}</main>\n</html>\n")


if __name__ == "__main__":
    out = Path(sys.argv[1] if len(sys.argv) > 1 else SRC.parent / "build" / "api.html")
    out.parent.mkdir(exist_ok=True)
    out.write_text(page_of(SRC), encoding="ascii")
