#!/usr/bin/env python3
# processors: 1
"""The Debian package, and the recipes that install it or build Synovia.

Requirements: the package has the program, MFEM's library for it alone, cases and
scripts, and nothing for developers; unpacked anywhere, the program runs with the
library beside it, and depends on the packages of the others; definitions of
containers have the environment of runs; scripts are free of errors of syntax.
"""

from __future__ import annotations

import ast
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))

from program_checks import (  # noqa: E402
    PROGRAMS, SOURCE, check, finish)

BUILD = PROGRAMS.parent
PACKAGING = SOURCE / "scripts" / "packaging"


def output(*command: object) -> str:
    run = subprocess.run([str(word) for word in command], text=True,
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if run.returncode != 0:
        print(run.stdout)
    check(run.returncode == 0, f"{command[0]} {command[1]} succeeds")
    return run.stdout


def copy_program(build: pathlib.Path) -> None:
    """Gives another build the program, with the run path that the other would
    have linked it with: padded to the length of the one it installs."""
    program = build / "miniapps/synovia"
    shutil.copy2(BUILD / "miniapps/synovia", program)
    paths = [re.search(r'bin/synovia"\s+OLD_RPATH "(.*?)"',
                       (directory / "miniapps/cmake_install.cmake").read_text(
                           encoding="utf-8"))[1].encode()
             for directory in (BUILD, build)]
    binary = program.read_bytes()
    check(binary.count(paths[0] + b"\0") == 1 and len(paths[1]) <= len(paths[0]),
          "the program has one run path")
    program.write_bytes(binary.replace(
        paths[0] + b"\0", paths[1].ljust(len(paths[0]) + 1, b"\0")))


def make_package(work: pathlib.Path) -> pathlib.Path:
    """From the program that is built, as make_deb would build it."""
    cache = (BUILD / "CMakeCache.txt").read_text(encoding="utf-8")
    settings = [f"-D{name}={re.search(rf'^{name}:.*?=(.*)$', cache, re.M)[1]}"
                for name in ("MFEM_DIR", "CMAKE_CXX_COMPILER", "CMAKE_C_COMPILER",
                             "SYNOVIA_PYTHON")]
    output("cmake", "-S", SOURCE, "-B", work / "build", "-G", "Ninja",
           "-DSYNOVIA_BUNDLE_MFEM=ON", "-DSYNOVIA_BUILD_MINIAPPS=ON",
           "-DSYNOVIA_BUILD_TESTS=OFF", *settings)
    copy_program(work / "build")
    os.environ["SYNOVIA_BUILD_DIR"] = str(work / "build")
    output(PACKAGING / "make_deb", work / "packages")
    package, = (work / "packages").glob("*.deb")
    return package


def check_package(work: pathlib.Path) -> None:
    package = make_package(work)
    check(re.fullmatch(r"synovia_[\d.]+_\w+\.deb", package.name) is not None,
          f"its name is {package.name}")
    root = work / "root"
    output("dpkg-deb", "--extract", package, root)
    files = {str(file.relative_to(root)) for file in root.rglob("*")
             if not file.is_dir()}
    for name in ("usr/bin/synovia", "usr/share/doc/synovia/copyright",
                 "usr/share/synovia/cases/indentation.toml",
                 "usr/share/synovia/meshes/indentation.py",
                 "usr/share/synovia/scripts/run_python",
                 "usr/share/synovia/scripts/report",
                 "usr/share/synovia/scripts/requirements.txt",
                 "usr/share/synovia/scripts/lib/run.env",
                 "usr/share/synovia/scripts/python/pyproject.toml",
                 "usr/share/synovia/tests/reference/indent_force.csv"):
        check(name in files, f"it has {name}")
    wrong = [name for name in files if name.endswith((".hpp", ".a", ".cmake"))
             or "__pycache__" in name
             or name.startswith("usr/bin/") and name != "usr/bin/synovia"]
    check(not wrong, f"it has nothing for developers: {wrong}")

    os.environ.pop("LD_LIBRARY_PATH", None)
    libraries = output("ldd", root / "usr/bin/synovia")
    check(f"{root}/usr/lib/synovia/libmfem" in libraries.replace(
        "/usr/bin/..", "/usr"), "the program finds the MFEM beside it")
    check("not found" not in libraries, "and all other libraries")
    run_path = output("objdump", "-p", root / "usr/bin/synovia")
    paths = re.findall(r"(?:RPATH|RUNPATH)\s+(\S+)", run_path)
    check(paths == ["$ORIGIN/../lib/synovia"], f"it looks nowhere else: {paths}")
    check("MFEM" in output(root / "usr/bin/synovia", "--version"), "it runs")

    fields = output("dpkg-deb", "--field", package, "Depends")
    for name in ("libhypre", "libmumps", "libhdf5-openmpi", "libpugixml",
                 "libopenmpi", "openmpi-bin", "python3"):
        check(name in fields, f"it depends on {name}")
    check("mfem" not in fields, "but on no package of MFEM")


def run_environment() -> dict[str, str]:
    text = (SOURCE / "scripts/lib/run.env").read_text(encoding="utf-8")
    return dict(re.findall(r"^([A-Z]\w*)=(.*)$", text, re.M))


def check_recipes() -> None:
    wanted = run_environment()
    check(len(wanted) > 5, "runs have an environment")
    for name, pattern in (("Dockerfile", r"^(?:ENV| +) (\w+)=([^\s\\]+)"),
                          ("synovia.def", r"^ +export (\w+)=(\S+)")):
        text = (PACKAGING / name).read_text(encoding="utf-8")
        found = dict(re.findall(pattern, text, re.M))
        found.pop("SYNOVIA_CACHE")
        check(found == wanted, f"{name} has the environment of runs: {found}")
        for file in re.findall(r"scripts/\S+", text):
            check((SOURCE / file.rstrip(".")).is_file(), f"{name}: {file} is there")
    for file in (*PACKAGING.iterdir(), *(SOURCE / "scripts").glob("*.slurm")):
        if file.is_file() and file.read_bytes().startswith(b"#!"):
            output("bash", "-n", file)
            check(file.suffix == ".slurm" or os.access(file, os.X_OK),
                  f"{file.name} can be executed")
    recipe, = PACKAGING.glob("spack_repo/*/packages/*/package.py")
    tree = ast.parse(recipe.read_text(encoding="utf-8"))
    check(any(isinstance(node, ast.ClassDef) for node in tree.body),
          "Spack's recipe is a class")
    version = re.search(r"project\(synovia VERSION (\S+)",
                        (SOURCE / "CMakeLists.txt").read_text(encoding="utf-8"))
    check(f'version("{version[1]}")' in recipe.read_text(encoding="utf-8"),
          "of this version")


def main() -> None:
    check_recipes()
    with tempfile.TemporaryDirectory(prefix="synovia package ") as name:
        check_package(pathlib.Path(name))
    finish()


if __name__ == "__main__":
    main()
