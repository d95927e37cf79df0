"""The tables in logs/ of a run, which are those of FEBio's log file."""

from __future__ import annotations

import pathlib
from dataclasses import dataclass, field


@dataclass
class Block:
    """A step: by number of the node, element or body, and by name."""

    time: float = 0.0
    rows: dict[int, dict[str, float]] = field(default_factory=dict)


def read_blocks(path: pathlib.Path) -> list[Block]:
    blocks: list[Block] = []
    names: list[str] = []
    for line in path.read_text().splitlines():
        value = line.partition("=")[2].strip()
        if line.startswith("*Step"):
            blocks.append(Block())
        elif line.startswith("*Time"):
            blocks[-1].time = float(value)
        elif line.startswith("*Data"):
            names = value.split(";")
        else:
            number, *values = line.split()
            blocks[-1].rows[int(number)] = dict(zip(names, map(float, values)))
    return blocks
