#!/usr/bin/env python3
# processors: 1
"""Every C++ block of the READMEs, compiled against the library.

Requirements: each compiles without a warning, with the flags of the miniapps;
blocks of one README make one source file, but for those with a file of their
own, which the commands build and run; a law that is shown as a header has at
most 60 lines.

A comment before a block says what it is: <!-- file: NAME -->, or
<!-- in: void F(...) --> for what stands in the body of that function. Others
stand for themselves.
"""

from __future__ import annotations

import concurrent.futures
import json
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "support")]
sys.dont_write_bytecode = True

import commands  # noqa: E402
from commands import Block, DocumentationError  # noqa: E402
from program_checks import SOURCE, check, finish  # noqa: E402

BUILD = pathlib.Path(os.environ["SYNOVIA_BUILD_DIR"])
PROGRAM = SOURCE / "miniapps" / "synovia.cpp"
LONGEST_HEADER = 60     # lines


def compiler() -> list[str]:
    """The command that compiles a miniapp, up to its output and input."""
    entries = json.loads((BUILD / "compile_commands.json").read_text())
    words, = [shlex.split(entry["command"]) for entry in entries
              if pathlib.Path(entry["file"]) == PROGRAM]
    return words[:words.index("-o")]


def source_of(blocks: list[Block]) -> str:
    """Lines keep their numbers in the README for the compiler's messages."""
    parts = ['#include "synovia/synovia.hpp"']
    for block in blocks:
        lines = f'#line {block.line} "{block.file}"\n{block.text}'
        kind, _, what = block.note.partition(": ")
        if kind == "in":
            lines = f"{what}\n{{\n{lines}}}"
        elif kind not in ("", "file"):
            raise DocumentationError(f"{block.place}: <!-- {block.note} -->")
        parts.append(lines)
    return "\n".join(parts) + "\n"


def is_header(block: Block) -> bool:
    return block.language == "cpp" and block.note.endswith(".hpp")


def write_headers(folder: pathlib.Path) -> None:
    """For programs that include them."""
    count = 0
    for file in commands.readmes(SOURCE):
        for block in filter(is_header, commands.readme_blocks(SOURCE, file)):
            name = pathlib.PurePath(block.note).name
            (folder / name).write_text(block.text, encoding="utf-8")
            lines = block.text.count("\n")
            check(lines <= LONGEST_HEADER, f"{block.place}: {lines} lines")
            count += 1
    check(count > 0, f"{count} headers")


def sources() -> dict[str, str]:
    """By what they are made of."""
    found = {}
    for file in commands.readmes(SOURCE):
        blocks = [block for block in commands.readme_blocks(SOURCE, file)
                  if block.language == "cpp" and not is_header(block)]
        joined = []
        for block in blocks:
            if block.note.startswith("file: "):
                found[block.place] = source_of([block])
            else:
                joined.append(block)
        if joined:
            found[" ".join(block.place for block in joined)] = \
                source_of(joined)
    return found


def main() -> None:
    command = compiler() + ["-Wno-unused-function", "-fsyntax-only"]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write_headers(folder)

        def compile_source(number: int, text: str) -> str:
            file = folder / f"block{number}.cpp"
            file.write_text(text, encoding="utf-8")
            run = subprocess.run([*command, str(file)], text=True,
                                 stdout=subprocess.PIPE,
                                 stderr=subprocess.STDOUT)
            return run.stdout if run.returncode else ""

        found = sources()
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            errors = pool.map(compile_source, range(len(found)),
                              found.values())
            for place, error in zip(found, errors):
                print(error)
                check(not error, f"compiles: {place}")
    check(len(found) > 0, f"{len(found)} sources")
    finish()


if __name__ == "__main__":
    main()
