#!/usr/bin/env python3
# processors: 1
"""Every Python block of the READMEs runs.

Requirements: the blocks of one README run one after the other, as they are, in
a directory that has the cases and the references, and leave what they save.
"""

from __future__ import annotations

import contextlib
import os
import pathlib
import shutil
import sys
import tempfile
import warnings

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "support")]

import python_package  # noqa: E402,F401
import commands  # noqa: E402
from program_checks import SOURCE, check, finish  # noqa: E402

# What the blocks of scripts/python/README.md leave.
SAVED = ("mine.toml", "pressures.png", "pressure.png", "stiffness.csv",
         "fit.png", "sensitivities.png", "out/columns/history.csv")


def run_blocks(file: str, folder: pathlib.Path) -> int:
    """How many there are; they share their names."""
    names: dict[str, object] = {"__name__": "__main__"}
    blocks = [block for block in commands.readme_blocks(SOURCE, file)
              if block.language == "python"]
    with contextlib.chdir(folder):
        for block in blocks:
            # The lines of the README in what an error says.
            code = "\n" * (block.line - 1) + block.text
            exec(compile(code, block.place, "exec"), names)
            check(True, f"{block.place} runs")
    return len(blocks)


def main() -> None:
    warnings.simplefilter("error", SyntaxWarning)
    with tempfile.TemporaryDirectory(prefix="synovia blocks ") as name:
        folder = pathlib.Path(name)
        shutil.copytree(SOURCE / "miniapps" / "cases",
                        folder / "miniapps" / "cases",
                        ignore=shutil.ignore_patterns("*.msh"))
        (folder / "tests").mkdir()
        os.symlink(SOURCE / "tests" / "reference",
                   folder / "tests" / "reference")
        count = sum(run_blocks(file, folder)
                    for file in commands.readmes(SOURCE))
        check(count >= 5, f"{count} blocks")
        for file in SAVED:
            check((folder / file).exists(), f"{file} is there")
    finish()


if __name__ == "__main__":
    main()
