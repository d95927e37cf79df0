#!/usr/bin/env python3
# processors: 1
"""Which builds of MFEM will do, and what is said of the others.

Requirements: MPI and METIS, double precision, and MUMPS or SuiteSparse; one of
the two is enough.
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
        if good != (complaint is None) or (complaint and complaint not in text):
            print(f"FAILED  {features}: {text}")
            sys.exit(1)
        print(f"ok      {features}: {complaint or 'will do'}")


if __name__ == "__main__":
    main()
