"""Reads what a run leaves in its output directory."""

from __future__ import annotations

import csv
import fnmatch
import os
import pathlib
import re
import tomllib
import warnings
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree

import numpy as np

from synovia.errors import SynoviaError, suggestion

if TYPE_CHECKING:
    from pyvista import UnstructuredGrid


class OutputError(SynoviaError):
    """Says which file is missing or wrong."""


class Table(Mapping[str, np.ndarray]):
    """Named columns of numbers; an unknown name is an OutputError."""

    def __init__(self, file: str | os.PathLike[str]):
        self.file = pathlib.Path(file)
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
        if not whole:
            raise OutputError(f"'{file}' has no whole row")
        try:
            values = np.array(whole, dtype=float)
        except ValueError as error:
            raise OutputError(f"'{file}': {error}") from error
        self._columns: dict[str, np.ndarray] = dict(zip(rows[0], values.T))

    def __getitem__(self, name: str) -> np.ndarray:
        try:
            return self._columns[name]
        except KeyError:
            raise OutputError(f"'{self.file}' has no column '{name}'; "
                              f"there are: {', '.join(self)}") from None

    def __contains__(self, name: object) -> bool:
        return name in self._columns

    def __repr__(self) -> str:
        rows = len(next(iter(self._columns.values())))
        return f"Table({str(self.file)!r}): {rows} rows of {', '.join(self)}"

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def matching(self, *patterns: str) -> list[str]:
        """Names of columns that match any of the patterns, such as *.z.

        A pattern that matches none is an OutputError.
        """
        found: list[str] = []
        for pattern in patterns:
            names = fnmatch.filter(self, pattern)
            if not names:
                raise OutputError(f"'{self.file}' has no column '{pattern}'"
                                  + suggestion(pattern, self))
            found += [name for name in names if name not in found]
        return found

    def _ipython_key_completions_(self) -> list[str]:
        return list(self)

    def where(self, name: str, value: float) -> dict[str, np.ndarray]:
        """The rows in which the column has this value."""
        rows = np.isclose(self[name], value, rtol=1e-9, atol=1e-12)
        if not rows.any():
            raise OutputError(f"'{self.file}' has no row with "
                              f"{name} = {value:g}")
        return {column: values[rows] for column, values in self.items()}


def interpolate(x: float, table: Mapping[str, np.ndarray], along: str, name: str) -> float:
    """A column's value where another one, in any order, is x."""
    order = np.argsort(table[along])
    if not table[along].min() <= x <= table[along].max():
        raise OutputError(f"{along} = {x:g} is outside the table of {name}")
    return float(np.interp(x, table[along][order], table[name][order]))


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

    def lines(self) -> dict[str, list[tuple[float, pathlib.Path]]]:
        """Names of sampled lines with the times and files of each."""
        found: dict[str, list[tuple[float, pathlib.Path]]] = {}
        for file in (self.directory / "lines").glob("*.csv"):
            match = re.fullmatch(r"(.+)_t(-?[0-9.]+(?:e[-+]?\d+)?)",
                                 file.stem)
            if match:
                found.setdefault(match[1], []).append((float(match[2]), file))
        return {name: sorted(found[name]) for name in sorted(found)}

    def text(self, name: str) -> str | None:
        """A text file of the directory; None where there is none."""
        file = self.directory / name
        try:
            return file.read_text(encoding="utf-8", errors="replace")
        except FileNotFoundError:
            return None
        except OSError as error:
            raise OutputError(f"cannot read '{file}': {error.strerror}") \
                from error

    def case(self) -> dict[str, Any]:
        """The keys of case.toml; empty where there is none."""
        text = self.text("case.toml")
        try:
            return tomllib.loads(text) if text else {}
        except tomllib.TOMLDecodeError as error:
            raise OutputError(f"'{self.directory / 'case.toml'}': {error}") \
                from error

    def collections(self) -> list[str]:
        """Names of the ParaView collections."""
        return sorted(file.stem for file in
                      (self.directory / "fields").glob("*/*.pvd")
                      if file.stem == file.parent.name)

    def _saved(self, name: str) -> dict[float, pathlib.Path]:
        """The times of a collection and the file of each."""
        file = self.directory / "fields" / name / f"{name}.pvd"
        if not file.exists():
            raise OutputError(f"there is no '{file}'")
        try:
            return {float(item.attrib["timestep"]):
                    file.parent / item.attrib["file"]
                    for item in ElementTree.parse(file).iter("DataSet")}
        except (ElementTree.ParseError, KeyError, ValueError) as error:
            raise OutputError(f"'{file}' is damaged: {error}") from error

    def field_times(self, name: str) -> list[float]:
        """The times at which a collection was written, ascending."""
        return sorted(self._saved(name))

    def fields(self, name: str, time: float) -> UnstructuredGrid:
        """The pyvista grid of a ParaView collection at this time."""
        import pyvista

        saved = self._saved(name)
        if not saved:
            raise OutputError(f"the collection '{name}' of "
                              f"'{self.directory}' has no times")
        times = np.array(sorted(saved))
        nearest = float(times[np.argmin(np.abs(times - time))])
        if not np.isclose(nearest, time, rtol=1e-5):
            raise OutputError(
                f"'{self.directory / 'fields' / name}' has no fields at t = "
                f"{time:g}, only at {', '.join(f'{t:g}' for t in times)}")
        file = saved[nearest]
        parts = (list(file.parent.glob("*.vtu")) if file.suffix == ".pvtu"
                 else [])
        for part in [file, *parts]:
            require_whole(part)
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            grid = pyvista.read(str(file))
        # VTK gives what it could read.
        errors = [str(warning.message) for warning in said
                  if "error" in str(warning.message)]
        if errors:
            reason = errors[0].splitlines()[-1].strip('\t "')
            raise OutputError(f"'{file}' is damaged: {reason}")
        if not isinstance(grid, pyvista.UnstructuredGrid):
            raise OutputError(f"'{file}' holds no mesh of elements")
        if grid.n_cells == 0 or not np.isfinite(grid.bounds).all():
            raise OutputError(f"'{file}' holds no elements")
        return grid


def require_whole(file: pathlib.Path) -> None:
    """A VTK file whose end is missing was cut short."""
    try:
        with open(file, "rb") as stream:
            stream.seek(0, 2)
            stream.seek(max(0, stream.tell() - 64))
            end = stream.read()
    except OSError as error:
        raise OutputError(f"cannot read '{file}': {error.strerror}") from error
    if b"</VTKFile>" not in end:
        raise OutputError(f"'{file}' is cut short")
