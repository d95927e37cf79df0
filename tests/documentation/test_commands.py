#!/usr/bin/env python3
"""Every command of the documentation, in a short version.

Requirements: all shell blocks of the READMEs, the sample runs of miniapps and
mesh scripts and the commands of the case files run from a copy of the sources,
in the order of reading, as short_versions.py shortens them; none is left out
but those that it lists with a reason, all of which are there.
"""

from __future__ import annotations

import concurrent.futures
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "support"),
                str(HERE.parents[1] / "meshes")]
sys.dont_write_bytecode = True

import commands  # noqa: E402
import short_versions  # noqa: E402
from commands import Block  # noqa: E402
from program_checks import (  # noqa: E402
    SOURCE, check, finish, make_mesh)
from short_versions import ShortCommand  # noqa: E402
from synthetic_knee import (  # noqa: E402
    synthetic_labels, write_nrrd)

BUILD = pathlib.Path(os.environ["SYNOVIA_BUILD_DIR"])
COPIED = ("CHANGELOG.md", "LICENSE", "README.md", "meshes", "miniapps",
          "plugin", "scripts", "tests")
MARK = "@@@ "   # before each command, in what a shell prints


def make_copy(root: pathlib.Path) -> None:
    """The sources, with a build directory whose contents are the real one's."""
    root.mkdir()
    for name in COPIED:
        if (SOURCE / name).is_dir():
            shutil.copytree(SOURCE / name, root / name,
                            ignore=shutil.ignore_patterns("__pycache__",
                                                          "*.msh"))
        else:
            shutil.copy(SOURCE / name, root / name)
    (root / "build" / "meshes").mkdir(parents=True)
    for entry in BUILD.iterdir():
        if entry.name not in ("lock", "meshes"):
            (root / "build" / entry.name).symlink_to(entry)
    for file in commands.readmes(root):
        for block in commands.readme_blocks(root, file):
            if block.note.startswith("file: "):
                target = root / block.note.removeprefix("file: ")
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_text(block.text, encoding="utf-8")


def environment(root: pathlib.Path) -> dict[str, str]:
    """A home of its own, and the build and the Python of this test."""
    programs = root / "build" / "miniapps"
    return os.environ | {
        "HOME": str(root / "home"), "SYNOVIA_CACHE": str(root / "cache"),
        "SYNOVIA_BUILD_DIR": str(root / "build"),
        "SYNOVIA_PYTHON": sys.executable,
        "PATH": f"{programs}{os.pathsep}{os.environ['PATH']}"}


class Shell:
    """Runs blocks in a copy of the sources, until one fails."""

    def __init__(self, root: pathlib.Path, image: pathlib.Path):
        make_copy(root)
        self.root = root
        self.image = image
        self.environment = environment(root)
        make_mesh("indentation.py", root / "build/meshes/indentation.msh",
                  "--size", short_versions.COARSE["indentation.py"])

    def __call__(self, block: Block) -> list[ShortCommand]:
        short = short_versions.shorten(block, self.root, self.image)
        wanted = [command for command in short if command.short is not None]
        script = "".join(f"echo {shlex.quote(MARK + command.text)}\n"
                         f"{command.short}\n" for command in wanted)
        start = time.monotonic()
        run = subprocess.run(
            ["bash", "-euo", "pipefail", "-c", script], cwd=self.root,
            env=self.environment, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, text=True, errors="replace")
        seconds = time.monotonic() - start
        started = re.findall(f"^{MARK}(.*)$", run.stdout, re.MULTILINE)
        lines = [f"        not run, {command.why}: {command.text}"
                 if command.why else f"        {command.short}"
                 for command in short]
        if run.returncode != 0:
            lines.append(run.stdout[-6000:])
        print("\n".join(lines), flush=True)
        check(run.returncode == 0 and len(started) == len(wanted),
              f"{block.place}: {len(started)} of {len(wanted)} commands, "
              f"exit status {run.returncode}, {seconds:.1f} s")
        return short


def run_all(root: pathlib.Path, blocks: list[Block], image: pathlib.Path
            ) -> list[ShortCommand]:
    """Runs blocks one after the other."""
    shell = Shell(root, image)
    short = []
    for block in blocks:
        if not block.file.endswith("README.md"):
            # They find no output of each other.
            shutil.rmtree(root / "out", ignore_errors=True)
        short += shell(block)
    return short


def count_lines() -> int:
    """Commands in the READMEs' shell blocks, counted in another way."""
    count = 0
    for file in commands.readmes(SOURCE):
        text = (SOURCE / file).read_text(encoding="utf-8")
        for block in re.findall(r"^```sh\n(.*?)^```", text,
                                re.MULTILINE | re.DOTALL):
            for line in block.replace("\\\n", "").splitlines():
                count += sum(bool(part.strip())
                             for part in line.split("#")[0].split("&&"))
    return count


def check_tables(all_short: list[ShortCommand]) -> None:
    """Nothing in the tables that the documentation doesn't have any more."""
    texts = {command.text for command in all_short}
    for text, why in short_versions.NOT_RUN.items():
        check(text in texts, f"listed, {why}: {text}")
    programs = {command.program for command in all_short}
    for table in (short_versions.INSTEAD, short_versions.SMALL,
                  short_versions.COARSE, short_versions.AS_THEY_ARE):
        for program in table:
            check(program.split()[0] in programs, f"listed: {program}")
    for case in short_versions.LIGHT:
        check(any(case.removesuffix(".toml") in text for text in texts),
              f"listed: {case}")


def main() -> None:
    """Arguments are parts of the names of files to look at, for trying out."""
    only = sys.argv[1:]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name).resolve()
        image = folder / "image.nrrd"
        write_nrrd(str(image), *synthetic_labels())
        blocks = [block for block in commands.shell_blocks(SOURCE)
                  if not only or any(word in block.file for word in only)]
        # READMEs are read as a whole, but for that of the programs, which
        # needs nothing of others and takes as long as all of these.
        programs = [b for b in blocks if b.file == "miniapps/README.md"]
        read = [b for b in blocks
                if b.file.endswith("README.md") and b not in programs]
        others = [b for b in blocks if not b.file.endswith("README.md")]
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            runs = [pool.submit(run_all, folder / place, part, image)
                    for place, part in (("programs", programs),
                                        ("read", read), ("run", others))]
            from_programs, from_read, short = (run.result() for run in runs)
            from_readmes = from_programs + from_read
    if not only:
        check(len(from_readmes) == count_lines(),
              f"{len(from_readmes)} commands in READMEs")
        check_tables(from_readmes + short)
    not_run = sum(bool(command.why) for command in from_readmes + short)
    check(len(from_readmes + short) > not_run,
          f"{len(from_readmes + short)} commands in all, {not_run} of them "
          "listed as those that can't run")
    finish()


if __name__ == "__main__":
    main()
