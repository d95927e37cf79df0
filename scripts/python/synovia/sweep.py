"""Runs over parameters, with a table that goes on where it stopped."""

from __future__ import annotations

import hashlib
import itertools
import os
import pathlib
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from synovia.case import Case
from synovia.errors import RunError, Stopped, SynoviaError
from synovia.pool import Job, cores, run_all
from synovia.progress import line
from synovia.results import Result
from synovia.sweep_table import SweepFile, SweepTable, key_of
from synovia.values import plain

Quantity = str | Callable[[Result], float]


def sweep(case: Case, parameters: Mapping[str, Sequence[Any]],
          quantities: Mapping[str, Quantity] | Sequence[str],
          table: str | os.PathLike[str] = "sweep.csv", *,
          combine: str = "grid", ranks: int = 1, processes: int | None = None,
          folder: str | os.PathLike[str] | None = None,
          progress: bool | None = None) -> SweepTable:
    """Runs the case for values of parameters, and tables what came of them.

    parameters: values by path, such as {"material.0.solid.E": [0.4, 0.5]}.
    combine: "grid" for all combinations, "zip" for one value of each at a time.
    quantities: columns of the history, of which the last row counts; or names
    with columns, or with functions of a Result that give a number.
    table: a CSV file with a row for each run that ended. Called again, it adds
    the rows that it lacks, and goes on with unfinished runs at their
    checkpoints. A run that failed has NaN and its message; it is tried again
    when its row is removed.
    folder: of the runs' outputs, by default TABLE's name without its ending.
    processes: runs at once, by default as many as the cores hold.
    """
    file = pathlib.Path(table)
    outputs = pathlib.Path(folder) if folder else file.with_suffix("")
    named = dict(quantities) if isinstance(quantities, Mapping) \
        else {name: name for name in quantities}
    points = _points(parameters, combine)
    cases = [case.copy(dict(zip(parameters, point))) for point in points]
    rows = SweepFile(file, list(parameters), list(named), _digest(case))
    missing = [number for number, point in enumerate(points)
               if key_of(point) not in rows.done]
    # A new table has no use for what another sweep left in its folder.
    jobs = [(number, Job(cases[number], outputs / f"{number:04d}", ranks,
                         resume=not rows.is_new)) for number in missing]
    done = len(points) - len(missing)
    shown = line(progress)
    try:
        shown.write(f"{done} of {len(points)} runs")
        for number, result in run_all(
                jobs, processes or max(1, cores() // ranks)):
            error = str(result) if isinstance(result, RunError) else ""
            rows.append([number, *points[number],
                         *(_value(result, quantity)
                           for quantity in named.values()),
                         " ".join(error.split())])
            done += 1
            shown.write(f"{done} of {len(points)} runs")
    except KeyboardInterrupt as stopped:
        raise Stopped(f"stopped with {done} of {len(points)} runs in "
                      f"'{file}'; the same call goes on") from stopped
    finally:
        shown.close()
    return SweepTable(file)


def _points(parameters: Mapping[str, Sequence[Any]], combine: str
            ) -> list[tuple[Any, ...]]:
    columns = [plain(list(values)) for values in parameters.values()]
    if combine == "grid":
        return list(itertools.product(*columns))
    if combine != "zip":
        raise SynoviaError(f"combine = '{combine}' is neither grid nor zip")
    if len({len(column) for column in columns}) > 1:
        raise SynoviaError("combine = 'zip' needs as many values of each: "
                           + ", ".join(f"{name} has {len(values)}" for
                                       name, values in parameters.items()))
    return list(zip(*columns))


def _digest(case: Case) -> str:
    """Of the case and its mesh: rows of others must not be mixed."""
    mesh = case.mesh_file
    content = mesh.read_bytes() if mesh.exists() else b""
    return hashlib.sha256(str(case).encode() + content).hexdigest()[:16]


def _value(result: Result | RunError, quantity: Quantity) -> float:
    if isinstance(result, RunError):
        return float("nan")
    if callable(quantity):
        return float(quantity(result))
    return float(result.history[quantity][-1])
