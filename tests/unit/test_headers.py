#!/usr/bin/env python3
"""Each header of the library compiles alone, and includes what it names.

A header that its own source includes first compiles alone if the library does,
unless folders are compiled as one file; the others are compiled here. All come after MFEM's, which is precompiled:
parsing it 200 times would take a quarter of an hour. So that nobody has to
include mfem.hpp first, each header that names something of MFEM or MPI must
reach mfem.hpp by its includes, and each that names something of the standard
library that library's header.
"""

from __future__ import annotations

import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(os.environ["SYNOVIA_SOURCE_DIR"])
BUILD = pathlib.Path(os.environ["SYNOVIA_BUILD_DIR"])
PLUGIN = SOURCE / "plugin"
INCLUDE = re.compile(r'^ *#include [<"]([^>"]+)[>"]', re.MULTILINE)
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/|\"(?:[^\"\\\n]|\\.)*\"", re.DOTALL)

# What names need; any of several headers will do.
HEADERS = {
    "algorithm": "max min sort find any_of all_of clamp",
    "array": "array",
    "chrono": "chrono",
    "cmath": "sqrt abs pow exp log isfinite isnan",
    "functional": "function",
    "iosfwd|ostream|sstream|fstream|iostream": "ostream istream",
    "fstream": "ofstream ifstream",
    "initializer_list|vector": "initializer_list",
    "limits": "numeric_limits",
    "map": "map multimap",
    "memory": "unique_ptr shared_ptr weak_ptr make_unique make_shared",
    "optional": "optional nullopt",
    "set": "set multiset",
    "sstream": "ostringstream istringstream stringstream",
    "stdexcept": "runtime_error logic_error",
    "string": "string to_string",
    "type_traits": "enable_if_t is_same_v decay_t conditional_t",
    "utility|map|vector|memory": "move pair forward swap",
    "variant": "variant monostate",
    "vector": "vector",
}
MFEM = re.compile(r"\bmfem::|\bHYPRE_\w")
MPI = re.compile(r"\bMPI_[A-Z]\w+")


def headers() -> list[str]:
    """As they are included, synovia/..."""
    return sorted("synovia/" + file.relative_to(PLUGIN).as_posix()
                  for file in PLUGIN.rglob("*.hpp"))


def text_of(header: str) -> str:
    return (PLUGIN / header.removeprefix("synovia/")).read_text()


def reached(header: str, seen: dict[str, set[str]]) -> set[str]:
    """All that a header of the library includes, by way of others of it."""
    if header not in seen:
        seen[header] = set()
        for other in INCLUDE.findall(text_of(header)):
            seen[header].add(other)
            if other.startswith("synovia/"):
                seen[header] |= reached(other, seen)
    return seen[header]


def missing_includes(header: str, seen: dict[str, set[str]]) -> list[str]:
    """What a header names and doesn't include."""
    code = COMMENT.sub("", INCLUDE.sub("", text_of(header)))
    has = reached(header, seen)
    errors = []
    for pattern, providers in ((MFEM, {"mfem.hpp"}),
                               (MPI, {"mpi.h", "mfem.hpp"})):
        name = pattern.search(code)
        if name and not has & providers:
            errors.append(f"{header} names {name.group()} and doesn't reach "
                          f"{min(providers)} by its includes")
    used = set(re.findall(r"\bstd::(\w+)", code))
    for needed, names in HEADERS.items():
        named = sorted(used & set(names.split()))
        if named and not has & set(needed.split("|")):
            errors.append(f"{header} names std::{named[0]} and doesn't reach "
                          f"<{needed}> by its includes")
    return errors


def is_first_of_source(header: str) -> bool:
    """Whether the source of that name begins with it."""
    source = (PLUGIN / header.removeprefix("synovia/")).with_suffix(".cpp")
    return source.exists() and \
        INCLUDE.findall(source.read_text())[:1] == [header]


def compile_commands() -> dict[str, str]:
    """Of the build, by source."""
    entries = json.loads((BUILD / "compile_commands.json").read_text())
    return {entry["file"]: entry["command"] for entry in entries}


def compiler(commands: dict[str, str]) -> list[str]:
    """The command that checks a source of the library, without the source."""
    words = shlex.split(next(
        command for file, command in commands.items()
        if "CMakeFiles/synovia.dir/cmake_pch.hxx" in command
        and not file.endswith("cmake_pch.hxx.cxx")))
    keep = []
    skip = False
    for word in words[:words.index("-c")]:
        if skip or word == "-o":
            skip = not skip
        else:
            keep.append(word)
    return keep + ["-fsyntax-only", "-Werror"]


def compile_alone(command: list[str], directory: pathlib.Path,
                  number: int, header: str) -> str:
    """What the compiler says of a header, twice included; empty if nothing."""
    file = directory / f"header{number}.cpp"
    file.write_text(f'#include "{header}"\n' * 2)
    run = subprocess.run(command + [file], text=True, cwd=BUILD,
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return "" if run.returncode == 0 else f"{header}:\n{run.stdout}"


def main() -> None:
    commands = compile_commands()
    command = compiler(commands)
    by_folders = any("/Unity/" in file for file in commands)
    names = headers()
    alone = [name for name in names
             if by_folders or not is_first_of_source(name)]
    seen: dict[str, set[str]] = {}
    errors = [error for name in names for error in missing_includes(name, seen)]
    with tempfile.TemporaryDirectory() as directory, \
            concurrent.futures.ThreadPoolExecutor(2) as pool:
        place = pathlib.Path(directory)
        errors += filter(None, pool.map(
            lambda item: compile_alone(command, place, *item),
            enumerate(alone)))
        # The check can fail.
        broken = place / "broken.hpp"
        broken.write_text("inline Undeclared f() { return {}; }\n")
        if not compile_alone(command, place, len(alone), str(broken)):
            errors.append("a header that can't be compiled was not noticed")
    for error in errors:
        print("FAILED ", error)
    if errors:
        sys.exit(1)
    print(f"ok      {len(names)} headers, {len(alone)} of them compiled here")


if __name__ == "__main__":
    main()
