"""What scripts/run needs to know of a case file."""

from __future__ import annotations

import pathlib
import tomllib
from dataclasses import dataclass


@dataclass
class CaseSettings:
    """Files are relative to the working directory; none: it isn't said."""

    folder: pathlib.Path        # of the case file
    mesh: pathlib.Path | None
    generator: object           # as it is written
    output: pathlib.Path


def _table(of: dict, key: str) -> dict:
    value = of.get(key)
    return value if isinstance(value, dict) else {}


def read(file: pathlib.Path, overrides: list[str]) -> CaseSettings | None:
    """The settings of a case with what --set says, in order.

    None of a file that can't be read or isn't TOML, and no complaint about
    values: synovia says what is wrong, and where.
    """
    try:
        case = tomllib.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    mesh, output = _table(case, "mesh"), _table(case, "output")
    if isinstance(mesh.get("file"), str):
        mesh["file"] = file.parent / mesh["file"]
    for assignment in overrides:
        try:
            change = tomllib.loads(assignment)
        except ValueError:
            continue
        mesh |= _table(change, "mesh")
        output |= _table(change, "output")
    name = mesh.get("file")
    directory = output.get("directory", "out")
    return CaseSettings(
        file.parent,
        pathlib.Path(name) if isinstance(name, (str, pathlib.Path)) else None,
        mesh.get("generator"), pathlib.Path(str(directory)))
