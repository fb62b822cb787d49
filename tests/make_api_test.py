"""Is all that a program sees on the page that src/make_api.py makes, once, and do its links lead somewhere?"""

import re
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT / "src"))
import make_api  # noqa: E402


class MakeApi(unittest.TestCase):
    def setUp(self) -> None:
        self.page = make_api.page_of(ROOT / "src")
        self.ids = re.findall(r'id="([^"]+)"', self.page)

    def test_public_names(self) -> None:
        seen = (ROOT / "neuralsvcd.h").read_text().partition("// ===== IMPLEMENTATION".replace("=====", "=" * 82))
        self.assertTrue(seen[1])
        code = re.sub(r"//.*", "", seen[0])
        names = re.findall(r"\b(nsvcd_\w+)\(", code)  # functions, and the types of callbacks
        names += re.findall(r"^\} (nsvcd_\w+);|^typedef struct \w+ (nsvcd_\w+);", code, flags=re.MULTILINE)
        names += re.findall(r"\b(NSVCD_\w+)(?: = \w+)?,?\s*(?:\n\}|(?<=,)\n)", code)  # enumerators
        names += re.findall(r"^#define (NSVCD_(?!NO_[A-TV-Z]|_)\w+)", code, flags=re.MULTILINE)
        found = {"".join(name) for name in names if "__" not in "".join(name)}
        self.assertGreater(len(found), 150)
        self.assertEqual(sorted(found - set(self.ids)), [])

    def test_anchors_and_links(self) -> None:
        self.assertEqual(len(self.ids), len(set(self.ids)))
        self.assertEqual(sorted(set(re.findall(r'href="#([^"]+)"', self.page)) - set(self.ids)), [])

    def test_comments_are_there(self) -> None:
        for words in ("a certificate that the surfaces never do", "aligned as malloc's", "<dt>errors</dt>"):
            self.assertIn(words, self.page)
        self.assertNotIn("<p></p>", self.page)
        self.assertNotRegex(self.page, r"<p>\s*//")


if __name__ == "__main__":
    unittest.main(verbosity=0)
