#!/usr/bin/env python3
# processors: 1
"""Links of the READMEs.

Requirements: files and pictures that they name are there, and so are headings
that they point to; the first README is a page of at most 150 lines.
"""

from __future__ import annotations

import os
import pathlib
import re
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
sys.dont_write_bytecode = True

import commands  # noqa: E402

SOURCE = pathlib.Path(os.environ.get("SYNOVIA_SOURCE_DIR", HERE.parents[1]))
LINK = re.compile(r"\]\((?!https?:)([^)#]*)(?:#([^)]*))?\)")


def anchors(file: pathlib.Path) -> set[str]:
    """Of the headings, as GitHub and others make them."""
    titles = re.findall(r"^#+ (.*)$", file.read_text(encoding="utf-8"),
                        re.MULTILINE)
    return {re.sub(r"[^\w -]", "", title).lower().replace(" ", "-")
            for title in titles}


class Links(unittest.TestCase):
    def test_all_lead_somewhere(self):
        count = 0
        for name in commands.readmes(SOURCE):
            file = SOURCE / name
            text = re.sub(r"^```.*?^```", "", file.read_text(encoding="utf-8"),
                          flags=re.MULTILINE | re.DOTALL)
            for path, anchor in LINK.findall(text):
                count += 1
                target = file.parent / path if path else file
                with self.subTest(f"{name}: {path}#{anchor}"):
                    self.assertTrue(target.exists())
                    if anchor:
                        self.assertIn(anchor, anchors(target))
        self.assertGreater(count, 30)

    def test_every_folder_is_linked_from_the_first(self):
        text = (SOURCE / "README.md").read_text(encoding="utf-8")
        for name in commands.readmes(SOURCE)[1:6]:
            self.assertIn(f"({name}", text)

    def test_the_first_is_a_page(self):
        text = (SOURCE / "README.md").read_text(encoding="utf-8")
        self.assertLessEqual(len(text.splitlines()), 150)


if __name__ == "__main__":
    unittest.main()
