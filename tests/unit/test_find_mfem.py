#!/usr/bin/env python3
# processors: 1
"""Which builds of MFEM will do, and what is said of the others.

Requirements: MPI and METIS, double precision, and MUMPS or SuiteSparse; one of
the two is enough. CMake's MFEMConfig.cmake says which, or the config.mk that
make leaves in share/mfem or, where it was not installed, in config.
"""

from __future__ import annotations

import os
import pathlib
import subprocess
import sys
import tempfile

PROBE = pathlib.Path(os.environ["SYNOVIA_SOURCE_DIR"]) / "scripts/lib/find_mfem"


def configure(directory: pathlib.Path, features: str) -> tuple[bool, str]:
    """Whether an MFEM with those features will do, and what CMake prints."""
    mfem = directory / "mfem"
    mfem.mkdir(parents=True)
    (mfem / "MFEMConfig.cmake").write_text("".join(
        f"set(MFEM_USE_{feature} ON)\n" for feature in features.split()))
    (mfem / "MFEMConfigVersion.cmake").write_text(
        "set(PACKAGE_VERSION 4.9)\nset(PACKAGE_VERSION_COMPATIBLE TRUE)\n")
    run = subprocess.run(
        ["cmake", "-S", PROBE, "-B", directory / "build", f"-DMFEM_DIR={mfem}"],
        text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    return run.returncode == 0, " ".join(run.stdout.split())


def configure_from_make(directory: pathlib.Path, folder: str,
                        settings: dict[str, str]) -> tuple[bool, str]:
    """The same for an MFEM that make built, whose config.mk is in a folder."""
    mfem = directory / "mfem"
    (mfem / folder).mkdir(parents=True)
    # As MFEM's own: some values are variables, two of them of who includes it.
    values = {"VERSION_STRING": "4.9", "USE_MPI": "YES", "USE_METIS": "YES",
              "USE_MUMPS": "YES", "USE_SUITESPARSE": "NO", "USE_SINGLE": "NO",
              "BUILD_DIR": "$(MFEM_DIR)", "INC_DIR": "$(MFEM_BUILD_DIR)",
              "LIB_DIR": "$(MFEM_BUILD_DIR)", "TPLFLAGS": "-I/somewhere",
              "EXT_LIBS": "-L/elsewhere -lHYPRE -lmetis",
              "LIB_FILE": "$(MFEM_LIB_DIR)/libmfem.so"} | settings
    (mfem / folder / "config.mk").write_text("".join(
        f"MFEM_{name} = {value}\n" for name, value in values.items()))
    (mfem / "libmfem.so").touch()
    run = subprocess.run(
        ["cmake", "-S", PROBE, "-B", directory / "build", f"-DMFEM_DIR={mfem}"],
        text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    text = run.stdout
    if run.returncode == 0:
        # It has to be found the second time, too.
        text = subprocess.run(
            ["cmake", directory / "build"], text=True, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, check=True).stdout
        cache = (directory / "build/CMakeCache.txt").read_text()
        if f"MFEM_DIR:PATH={mfem}\n" not in cache:
            return False, "MFEM_DIR was lost"
    return run.returncode == 0, " ".join(text.split())


def from_make() -> None:
    cases = [
        ("config", {}, None),
        ("share/mfem", {"INC_DIR": "/usr/include", "LIB_FILE":
                        str(PROBE / "CMakeLists.txt")}, None),
        ("share/mfem", {"LIB_FILE": "/nowhere/libmfem.a"},
         "names the library /nowhere/libmfem.a, which isn't there"),
        ("config", {"VERSION_STRING": "4.8.1"},
         "Found but not used:"),
        ("config", {"USE_MPI": "NO"}, "was built without MPI"),
        ("config", {"USE_MUMPS": "NO"}, "has no direct solver"),
        ("config", {"USE_SINGLE": "YES"}, "is of single precision"),
        ("config", {"INC_DIR": "$(error made up)"}, "can't be read")]
    for number, (folder, settings, complaint) in enumerate(cases):
        with tempfile.TemporaryDirectory() as name:
            good, text = configure_from_make(
                pathlib.Path(name) / str(number), folder, settings)
        report(f"{folder}/config.mk {settings}", good, text, complaint)


def report(what: str, good: bool, text: str, complaint: str | None) -> None:
    if good != (complaint is None) or (complaint and complaint not in text):
        print(f"FAILED  {what}: {text}")
        sys.exit(1)
    print(f"ok      {what}: {complaint or 'will do'}")


def main() -> None:
    cases = {
        "MPI METIS MUMPS SUITESPARSE": None,
        "MPI METIS MUMPS": None,
        "MPI METIS SUITESPARSE": None,
        "MPI METIS": "has no direct solver. Build it with -DMFEM_USE_MUMPS=ON, "
                     "or, which does for one rank, with "
                     "-DMFEM_USE_SUITESPARSE=ON",
        "METIS MUMPS": "was built without MPI",
        "MPI METIS MUMPS SINGLE": "is of single precision",
    }
    for number, (features, complaint) in enumerate(cases.items()):
        with tempfile.TemporaryDirectory() as name:
            good, text = configure(pathlib.Path(name) / str(number), features)
        report(features, good, text, complaint)
    from_make()


if __name__ == "__main__":
    main()
