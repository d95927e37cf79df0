#!/usr/bin/env python3
"""Each header of the library compiles alone, and includes what it names.

The build's target synovia_headers compiles those that changed, after mfem.hpp.
So that nobody has to include that first, each header that names something of
MFEM or MPI must reach mfem.hpp by its includes, and each that names something
of the standard library that library's header.
"""

from __future__ import annotations

import json
import os
import pathlib
import re
import subprocess
import sys

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


def build(target: str) -> str:
    """What the compiler says of a target; empty if it is built."""
    run = subprocess.run(
        ["cmake", "--build", BUILD, "--target", target], text=True,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return "" if run.returncode == 0 else run.stdout


def compile_all(names: list[str]) -> list[str]:
    """What is wrong with headers, each included twice on its own."""
    entries = json.loads((BUILD / "compile_commands.json").read_text())
    files = {entry["file"] for entry in entries}
    errors = [f"{name} is not compiled by the target synovia_headers"
              for name in names if str(
                  BUILD / "tests" / "headers"
                  / f"{name.removeprefix('synovia/')}.cpp") not in files]
    errors += filter(None, [build("synovia_headers")])
    if "Undeclared" not in build("synovia_broken_header"):
        errors.append("a header that can't be compiled was not noticed")
    return errors


def main() -> None:
    names = headers()
    seen: dict[str, set[str]] = {}
    errors = compile_all(names)
    errors += [error for name in names for error in missing_includes(name, seen)]
    for error in errors:
        print("FAILED ", error)
    if errors:
        sys.exit(1)
    print(f"ok      {len(names)} headers")


if __name__ == "__main__":
    main()
