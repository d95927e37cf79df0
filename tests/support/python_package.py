"""For tests of the Python package: importing this lets them import synovia.

The program is that of the build, the cases are the shipped ones.
"""

from __future__ import annotations

import os
import pathlib
import sys

SOURCE = pathlib.Path(os.environ["SYNOVIA_SOURCE_DIR"])
CASES = SOURCE / "miniapps" / "cases"
PACKAGE = SOURCE / "scripts" / "python"

os.environ.setdefault("MPLBACKEND", "Agg")
sys.dont_write_bytecode = True
sys.path.insert(0, str(PACKAGE))

import synovia  # noqa: E402


def coarse_columns(folder: pathlib.Path) -> synovia.Case:
    """Two columns in contact on a mesh of a few elements, 40 steps."""
    case = synovia.Case(CASES / "two_columns.toml")
    case.mesh.file = str(folder / "two_columns.msh")
    case.mesh.generator = ["boxes.py", "two_columns", "--size", "3"]
    case.output.directory = str(folder / "out")
    if not case.mesh_file.exists():
        case.make_mesh()
    return case
