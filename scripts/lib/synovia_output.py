"""Reads what a run leaves in its output directory, and the references."""

from __future__ import annotations

import csv
import pathlib
from collections.abc import Mapping

import numpy as np

REFERENCE = pathlib.Path(__file__).resolve().parents[2] / "tests/reference"


class OutputError(Exception):
    """Says which file is missing or wrong."""


class Table(Mapping):
    """Named columns of numbers; an unknown name is an OutputError."""

    def __init__(self, file: pathlib.Path):
        self.file = file
        try:
            with open(file, newline="", encoding="utf-8") as stream:
                lines = [line for line in stream if not line.startswith("#")]
        except OSError as error:
            raise OutputError(f"cannot read '{file}': {error.strerror}") \
                from error
        rows = list(csv.reader(lines))
        if len(rows) < 2:
            raise OutputError(f"'{file}' has no rows")
        # The last line of a run at work, or killed, may be cut short.
        whole = [row for row in rows[1:] if len(row) == len(rows[0])]
        try:
            values = np.array(whole, dtype=float)
        except ValueError as error:
            raise OutputError(f"'{file}': {error}") from error
        self._columns = dict(zip(rows[0], values.T))

    def __getitem__(self, name: str) -> np.ndarray:
        try:
            return self._columns[name]
        except KeyError:
            raise OutputError(f"'{self.file}' has no column '{name}'; "
                              f"there are: {', '.join(self)}") from None

    def __iter__(self):
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def where(self, name: str, value: float) -> dict[str, np.ndarray]:
        """The rows in which the column has this value."""
        rows = np.isclose(self[name], value, rtol=1e-9, atol=1e-12)
        if not rows.any():
            raise OutputError(f"'{self.file}' has no row with "
                              f"{name} = {value:g}")
        return {column: values[rows] for column, values in self.items()}


def interpolate(x: float, table: Mapping, along: str, name: str) -> float:
    """A column's value where another one, in any order, is x."""
    order = np.argsort(table[along])
    if not table[along].min() <= x <= table[along].max():
        raise OutputError(f"{along} = {x:g} is outside the table of {name}")
    return float(np.interp(x, table[along][order], table[name][order]))


def reference(name: str) -> Table:
    """A table of tests/reference."""
    return Table(REFERENCE / name)


class Output:
    """The output directory of a run."""

    def __init__(self, directory: pathlib.Path):
        self.directory = directory
        if not directory.is_dir():
            raise OutputError(f"there is no directory '{directory}'")

    def history(self) -> Table:
        return Table(self.directory / "history.csv")

    def line(self, name: str, time: float) -> Table:
        """A profile that was sampled at this time."""
        file = self.directory / "lines" / f"{name}_t{time:.10g}.csv"
        if not file.exists():
            there = sorted(p.name for p in file.parent.glob("*.csv"))
            raise OutputError(f"there is no '{file}'; there are: "
                              f"{', '.join(there) or 'no lines at all'}")
        return Table(file)

    def fields(self, name: str, time: float):
        """The pyvista grid of a ParaView collection at this time."""
        import pyvista

        file = self.directory / "fields" / name / f"{name}.pvd"
        if not file.exists():
            raise OutputError(f"there is no '{file}'")
        reader = pyvista.get_reader(str(file))
        times = np.asarray(reader.time_values)
        if not np.isclose(times, time, rtol=1e-5).any():
            raise OutputError(f"'{file}' has no fields at t = {time:g}, only "
                              f"at {', '.join(f'{t:g}' for t in times)}")
        reader.set_active_time_value(
            float(times[np.argmin(np.abs(times - time))]))
        return reader.read().combine()
