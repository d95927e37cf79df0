"""The Python package's reader of output directories, and the references."""

from __future__ import annotations

import pathlib
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
REFERENCE = SOURCE / "tests/reference"

sys.path.append(str(SOURCE / "scripts/python"))

from synovia.output import (  # noqa: E402,F401
    Output, OutputError, Table, interpolate, require_whole)


def reference(name: str) -> Table:
    """A table of tests/reference."""
    return Table(REFERENCE / name)
