"""The table of a sweep: a CSV file that is added to, row by row."""

from __future__ import annotations

import csv
import html
import os
import pathlib
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from synovia.errors import SynoviaError, suggestion


class SweepTable(Mapping[str, np.ndarray]):
    """Named columns: numbers, or text where not all are numbers."""

    def __init__(self, file: str | os.PathLike[str]):
        self.file = pathlib.Path(file)
        head, *rows = csv.reader(_lines(self.file)[1:])
        rows.sort(key=lambda row: int(row[0]))
        self._columns = {name: _array([row[i] for row in rows])
                         for i, name in enumerate(head)}

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self._columns:
            raise SynoviaError(f"'{self.file}' has no column '{name}'"
                               + suggestion(name, self._columns))
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def _ipython_key_completions_(self) -> list[str]:
        return list(self)

    def _rows(self) -> list[list[str]]:
        texts = [[f"{value:.6g}" if isinstance(value, float) else str(value)
                  for value in column.tolist()]
                 for column in self._columns.values()]
        return [list(self), *(list(row) for row in zip(*texts))]

    def __repr__(self) -> str:
        rows = self._rows()
        widths = [max(map(len, column)) for column in zip(*rows)]
        return "\n".join("  ".join(text.rjust(width) for text, width
                                   in zip(row, widths)) for row in rows)

    def _repr_html_(self) -> str:
        head, *rows = self._rows()
        return "<table><tr>" + "".join(
            f"<th>{html.escape(text)}</th>" for text in head) + "</tr>" \
            + "".join("<tr>" + "".join(
                f"<td>{html.escape(text)}</td>" for text in row) + "</tr>"
                for row in rows) + "</table>"


def _lines(file: pathlib.Path) -> list[str]:
    """Those that are whole: the last one of a killed process may not be."""
    text = file.read_text(encoding="utf-8")
    return text[:text.rfind("\n") + 1].splitlines()


def _array(texts: list[str]) -> np.ndarray:
    for kind in (int, float):
        try:
            return np.array([kind(text) for text in texts])
        except ValueError:
            continue
    return np.array(texts)


def key_of(point: Sequence[Any]) -> tuple[str, ...]:
    """Values as the table has them."""
    return tuple(map(str, point))


class SweepFile:
    """Where rows are added; begins it, or takes up what is there."""

    def __init__(self, file: pathlib.Path, parameters: Sequence[str],
                 quantities: Sequence[str], digest: str):
        self.file = file
        self.is_new = not file.exists()
        head = ["run", *parameters, *quantities, "error"]
        mark = f"# case {digest}"
        if self.is_new:
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(mark + "\n", encoding="utf-8")
            self.append(head)
        lines = _lines(file)
        rows = list(csv.reader(lines[1:]))
        if lines[:1] != [mark] or rows[:1] != [head]:
            raise SynoviaError(f"'{file}' is of another case, or of other "
                               "parameters or quantities; remove it, or name "
                               "another table")
        self.done = {tuple(row[1:1 + len(parameters)]) for row in rows[1:]}
        file.write_text("\n".join(lines) + "\n", encoding="utf-8")

    def append(self, row: Sequence[Any]) -> None:
        """On the disk when it returns."""
        with open(self.file, "a", newline="", encoding="utf-8") as stream:
            csv.writer(stream, lineterminator="\n").writerow(row)
            stream.flush()
            os.fsync(stream.fileno())
