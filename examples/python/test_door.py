"""Tests of what someone meets first who comes from numpy: help, types, whatever can stand for a mesh or a pose."""
from __future__ import annotations

import os
import pydoc
import shutil
import subprocess
import unittest
from pathlib import Path

import neuralsvcd as nsvcd

HERE = Path(__file__).resolve().parent


def page(thing: object) -> list[str]:
    """What help() prints."""
    return pydoc.plain(pydoc.render_doc(thing)).splitlines()


class Help(unittest.TestCase):
    def test_a_page(self) -> None:
        """The guide, not every field of every class."""
        self.assertLessEqual(len(page(nsvcd)), 300)
        for room in (HERE / "neuralsvcd").glob("*.py"):
            self.assertLessEqual(len(room.read_text().splitlines()), 600, room.name)


class Types(unittest.TestCase):
    def test_strict(self) -> None:
        if not shutil.which("mypy"):
            self.skipTest("no mypy: not tested")
        done = subprocess.run(["mypy", "--strict", "--cache-dir", os.devnull, "neuralsvcd", "nsvcd_verify"], cwd=HERE,
                              capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)


if __name__ == "__main__":
    unittest.main()
