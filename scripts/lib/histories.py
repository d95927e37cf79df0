"""How two histories of one case differ."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

History = dict[str, list[float]]

WORK = re.compile(r"solver\.")
# Residuals of the equations, which depend on the last iteration.
REMAINDER = re.compile(
    r"\.(force_error|moment_error|penetration|pressure_jump|volume_balance)$")
COMPONENT = re.compile(r"[._][xyz]$")
# Of the largest value of all columns: below it a column is round-off.
ROUND_OFF = 1e-13


@dataclass
class Comparison:
    """Of an old history with a new one."""

    rows: int = 0
    # Largest difference of each column that counts, over its scale.
    differences: dict[str, float] = field(default_factory=dict)
    # What can't be compared.
    errors: list[str] = field(default_factory=list)
    added: list[str] = field(default_factory=list)
    # Sums over all steps that differ: name, old, new.
    work: list[tuple[str, float, float]] = field(default_factory=list)

    @property
    def columns(self) -> int:
        return len(self.differences)

    def worst(self) -> tuple[float, str]:
        return max(((difference, name) for name, difference
                    in self.differences.items()), default=(0.0, ""))

    def beyond(self, tolerance: float) -> list[tuple[str, float]]:
        return [(name, difference) for name, difference
                in self.differences.items() if not difference <= tolerance]


def read(rows: Iterable[Mapping[str, str]]) -> History:
    history: History = {}
    for row in rows:
        for name, value in row.items():
            history.setdefault(name, []).append(float(value))
    return history


def seconds(history: History) -> float:
    return sum(history.get("solver.seconds", []))


def scales(history: History) -> dict[str, float]:
    """The largest value of each column, or of the vector it belongs to."""
    largest: dict[str, float] = {}
    for name, values in history.items():
        vector = COMPONENT.sub("", name)
        largest[vector] = max([largest.get(vector, 0.0), *map(abs, values)])
    return {name: largest[COMPONENT.sub("", name)] for name in history}


def compare(old: History, new: History) -> Comparison:
    result = Comparison(rows=len(old.get("t", [])))
    result.added = [name for name in new if name not in old]
    missing = [name for name in old if name not in new]
    if missing:
        result.errors.append("columns are missing: " + ", ".join(missing))
    if len(new.get("t", [])) != result.rows:
        result.errors.append(f"{result.rows} steps became "
                             f"{len(new.get('t', []))}")
        return result
    scale = scales(old)
    results = [name for name in old
               if not WORK.match(name) and not REMAINDER.search(name)]
    floor = ROUND_OFF * max((scale[name] for name in results
                             if name not in ("t", "dt")), default=0.0)
    for name in results:
        if name in new and scale[name] > floor:
            result.differences[name] = max(
                (abs(a - b) if a == a and b == b else float("inf"))
                / scale[name] for a, b in zip(old[name], new[name]))
    for name in old:
        if WORK.match(name) and name != "solver.seconds" and name in new \
                and old[name] != new[name]:
            result.work.append((name, sum(old[name]), sum(new[name])))
    return result
