"""The names that section *processor* of neuralsvcd.h changes: all that is private in sections that
are compiled once for each instruction set, but macros. Prints what is missing or too much there, exit status
1; with --write, writes them anew.
"""

import re
import sys
from pathlib import Path

BY_ISA = (
    "vectors", "latent rotation", "motion", "broad phase", "proof", "winding number", "decoder", "query", "gradient"
)
BEGIN = "// ---- the names, as tests/isa.py writes them"
END = "// ---- the passes"


def names_of(text: str) -> list[str]:
    """Functions, types, enumerators and constants at the left margin of those sections."""
    parts = re.split(r"^// -{20,} (.+)$", text, flags=re.MULTILINE)
    names: set[str] = set()
    for title, body in zip(parts[1::2], parts[2::2]):
        if title not in BY_ISA:
            continue
        for enum in re.findall(r"^(?:typedef )?enum[^{;]*\{(.*?)\}", body, flags=re.MULTILINE | re.DOTALL):
            code = re.sub(r"//.*", "", enum)
            names.update(re.findall(r"\b(?:nsvcd|NSVCD)__(\w+)\b(?=\s*(?:,|=|$))", code))
        names.update(re.findall(r"^typedef char\s+nsvcd__(\w+)", body, flags=re.MULTILINE))
        for line in body.splitlines():
            for pattern in (
                r"(?:static|NSVCD__INLINE)\b[^(=;]*\bnsvcd__(\w+)\(",
                r"static const [^(=;]*\bnsvcd__(\w+)(?:\[.*\])* =",
                r"typedef [^;{]*\bnsvcd__(\w+)(?:\(.*\))?;",
                r"typedef struct nsvcd__(\w+) \{",
                r"\} nsvcd__(\w+);",
            ):
                match = re.match(pattern, line)
                if match:
                    names.add(match.group(1))
    return sorted(names)


def main() -> int:
    path = Path(__file__).parent.parent / "neuralsvcd.h"
    text = path.read_text()
    begin = text.index(BEGIN) + len(BEGIN) + 1
    end = text.index(END)
    lines = [
        f"#define NSVCD__{name} NSVCD__NUMBER_AT({name})\n" if name.isupper() else f"#define nsvcd__{name} NSVCD__AT({name})\n"
        for name in names_of(text)
    ]
    block = "".join(lines) + "\n"
    if "--write" in sys.argv:
        path.write_text(text[:begin] + block + text[end:])
        return 0
    wanted, found = set(block.splitlines()), set(text[begin:end].splitlines())
    for line in sorted(wanted ^ found):
        print(f"isa: {'missing' if line in wanted else 'too much'}: {line}")
    print(f"isa: {len(lines)} names")
    return int(wanted != found)


if __name__ == "__main__":
    sys.exit(main())
