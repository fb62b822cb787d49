"""Does src/make_header.py make of a small house what it should, and refuse what it must?"""

import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "src"))
import make_header  # noqa: E402

PLAN = """// small.h
// CONTENTS
//
// ============================== ground: what all stand on
#include "ground/sums.h"  // adds
#ifndef NSVCD__ISA
#include "ground/once.h"  // compiled once
#endif  // NSVCD__ISA
// ============================== upper: what uses it
#include "upper/means.h"  // halves sums
#include "upper/names.h"  // where the names stand
"""
ROOMS = {
    "ground/sums": "// In: two numbers. Out: their sum.\n#pragma once\n\nstatic int nsvcd__sum(int a, int b) {\n  return a + b;\n}\n",
    "ground/once": '#pragma once\n#include "sums.h"\n\nstatic int nsvcd__once(void) {\n  return 1;\n}\n',
    "upper/means": '#pragma once\n#include "../ground/sums.h"\n#include <math.h>\n#include "weights.h"\n\n'
    "typedef struct nsvcd__mean {\n  int of;\n} nsvcd__mean;\nenum { NSVCD__ONE, NSVCD__TWO = 2 };\n"
    "static const float nsvcd__half[2] = {0};\n#define NSVCD__NOT_THIS 1\n",
    "upper/names": make_header.NAMES + "\n",
}


class MakeHeader(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = tempfile.TemporaryDirectory()
        self.src = Path(self.folder.name)
        self.write("header", PLAN)
        for path, text in ROOMS.items():
            self.write(path, text)

    def tearDown(self) -> None:
        self.folder.cleanup()

    def write(self, path: str, text: str) -> None:
        file = self.src / f"{path}.h"
        file.parent.mkdir(exist_ok=True)
        file.write_text(text)

    def test_rooms_stand_in_their_order_under_their_names(self) -> None:
        text = make_header.made_of(self.src)
        places = [text.index(f" {path}\n") for path in ROOMS]
        self.assertEqual(places, sorted(places))
        self.assertIn("static int nsvcd__sum(int a, int b) {\n  return a + b;\n}\n", text)

    def test_of_includes_only_those_of_the_house_go(self) -> None:
        text = make_header.made_of(self.src)
        self.assertNotIn("#pragma once", text)
        self.assertNotIn('"../ground/sums.h"', text)
        self.assertIn("#include <math.h>\n", text)
        self.assertIn('#include "weights.h"\n', text)

    def test_contents_name_floors_and_rooms(self) -> None:
        text = make_header.made_of(self.src)
        self.assertRegex(text, r"//   ground: what all stand on\n//     sums +adds\n//     once +compiled once\n//   upper")

    def test_names_are_those_of_rooms_that_each_set_has(self) -> None:
        text = make_header.made_of(self.src)
        names = text.split(make_header.NAMES)[1].strip().splitlines()
        functions = [f"#define nsvcd__{name} NSVCD__AT({name})" for name in ("half", "mean")]
        numbers = [f"#define NSVCD__{name} NSVCD__NUMBER_AT({name})" for name in ("ONE", "TWO")]
        self.assertEqual(sorted(names), sorted(functions + numbers))

    def test_what_stands_below_is_refused(self) -> None:
        self.write("ground/sums", '#pragma once\n#include "../upper/means.h"\n')
        with self.assertRaisesRegex(make_header.Refused, "upper/means"):
            make_header.made_of(self.src)

    def test_macros_are_defined_once(self) -> None:
        self.write("ground/once", "#pragma once\n#define NSVCD__MANY 2\n")
        for text in (
            "#define NSVCD__MANY 2",
            "#define NSVCD__MANY 3",
            "#ifdef OTHER\n#define NSVCD__MANY 2\n#endif",
            "#  define NSVCD__MANY  // nothing",
            "#if A\n#define NSVCD__MANY(x) x\n#elif B\n#endif",
        ):
            self.write("upper/means", f"#pragma once\n{text}\n")
            with self.assertRaisesRegex(make_header.Refused, "defined twice: NSVCD__MANY"):
                make_header.made_of(self.src)
        self.write("upper/means", "#pragma once\n" + 2 * "#define NSVCD__TWO 2\n")
        with self.assertRaisesRegex(make_header.Refused, "defined twice: NSVCD__TWO$"):
            make_header.made_of(self.src)

    def test_macros_may_have_branches_and_ends(self) -> None:
        self.write("ground/once", "#pragma once\n#ifdef A\n#define NSVCD__MANY 2\n#elif B\n#define NSVCD__MANY 3\n#else\n"
                   "#if C\n#define NSVCD__MANY 4\n#endif\n#endif\n#if D\n#define NSVCD__MANY 5\n#endif\n")
        self.write("upper/means", "#pragma once\n#undef NSVCD__MANY\n#define NSVCD__MANY 2\n// #define NSVCD__MANY 5\n")
        make_header.made_of(self.src)

    def test_names_must_have_one_place(self) -> None:
        self.write("upper/names", "\n")
        with self.assertRaises(make_header.Refused):
            make_header.made_of(self.src)


if __name__ == "__main__":
    unittest.main(verbosity=0)
