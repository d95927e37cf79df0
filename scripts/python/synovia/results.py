"""Results of a run: history and lines as arrays, fields as meshes, plots."""

from __future__ import annotations

import html
import os
import pathlib
from typing import TYPE_CHECKING, Any

import numpy as np

from synovia.case import Case
from synovia.errors import suggestion
from synovia.output import Output, OutputError, Table

if TYPE_CHECKING:
    import pyvista
    from matplotlib.axes import Axes

BODIES = "bodies"   # the ParaView collection of all elements


class Result:
    """What a run has left in its output directory.

    Nothing is kept: all is read when it is asked for, so that the results of a
    run at work can be looked at.
    """

    def __init__(self, directory: str | os.PathLike[str]):
        self._output = Output(pathlib.Path(directory))

    @property
    def directory(self) -> pathlib.Path:
        """Where the run left its results."""
        return self._output.directory

    @property
    def history(self) -> Table:
        """Columns by name, shape (steps,)."""
        return self._output.history()

    @property
    def t(self) -> np.ndarray:
        """The times of the steps, shape (steps,)."""
        return self.history["t"]

    @property
    def case(self) -> Case:
        """As it ran, with all defaults."""
        return Case(self.directory / "case.toml")

    @property
    def log(self) -> str:
        """Of all runs that have written to the directory."""
        return self._output.text("run.log") or ""

    @property
    def warnings(self) -> list[str]:
        """What the log warns of."""
        return [line.partition("warning: ")[2]
                for line in self.log.splitlines() if "warning: " in line]

    @property
    def lines(self) -> dict[str, list[float]]:
        """Names of sampled lines, and the times of each."""
        return {name: [t for t, _ in files]
                for name, files in self._output.lines().items()}

    def line(self, name: str, t: float | None = None) -> Table:
        """A sampled line, by default at its last time: columns by name."""
        return self._output.line(name, self._line_times(name)[-1]
                                 if t is None else t)

    def _line_times(self, name: str) -> list[float]:
        lines = self.lines
        if name not in lines:
            raise OutputError(f"there is no line '{name}'; there are: "
                              + (", ".join(lines) or "none"))
        return lines[name]

    @property
    def fields(self) -> dict[str, list[float]]:
        """Names of saved meshes with fields, and the times of each.

        "bodies", and a surface for each contact pair.
        """
        return {name: self._output.field_times(name)
                for name in self._output.collections()}

    def force(self, name: str) -> np.ndarray:
        """Of a contact pair on its destination, or the reaction of a boundary.

        Shape (steps, 3).
        """
        history = self.history
        for prefix in (f"contact.{name}.force_", f"reaction.{name}."):
            if prefix + "x" in history:
                return np.stack([history[prefix + axis] for axis in "xyz"],
                                axis=1)
        raise OutputError(f"'{name}' is no contact pair and no boundary with "
                          f"a condition; there are: {', '.join(self._names())}")

    def _names(self) -> list[str]:
        """Of contact pairs and of boundaries that have forces."""
        columns = list(self.history)
        return [column.removeprefix(start).removesuffix(end)
                for start, end in (("contact.", ".force_x"),
                                   ("reaction.", ".x"))
                for column in columns
                if column.startswith(start) and column.endswith(end)]

    def mesh(self, t: float | None = None, name: str = BODIES, *,
             deformed: bool = False) -> pyvista.UnstructuredGrid:
        """Mesh and fields at a time that was saved, by default the last.

        name: one of fields; deformed: points are moved by the displacement.
        """
        times = self.fields.get(name)
        if not times:
            raise OutputError(f"'{self.directory}' has no fields '{name}'"
                              + suggestion(name, self.fields))
        grid = self._output.fields(name, times[-1] if t is None else t)
        if deformed:
            grid.points = grid.points + grid["displacement"]
        return grid

    def plot(self, *columns: str, ax: Axes | None = None) -> Axes:
        """Columns of the history in time; names may be patterns, as *.z."""
        from synovia import plots
        history = self.history
        return plots.curves(history["t"], {name: history[name] for name in
                                           history.matching(*columns)}, ax)

    def plot_forces(self, ax: Axes | None = None) -> Axes:
        """Contact forces or, without contact, reactions: largest components."""
        from synovia import plots
        return plots.forces(self.history, ax)

    def plot_pressures(self, ax: Axes | None = None) -> Axes:
        """Peak pressures of the fluid and in contacts."""
        from synovia import plots
        return plots.pressures(self.history, ax)

    def plot_line(self, name: str, column: str = "p",
                  ax: Axes | None = None) -> Axes:
        """A column of a sampled line at all its times."""
        from synovia import plots
        return plots.profiles([(t, self.line(name, t)) for t in
                               self._line_times(name)], name, column, ax)

    def picture(self, field: str = "fluid_pressure", t: float | None = None,
                **look: Any) -> Any:
        """The deformed bodies in the colors of a field: a static picture.

        look: arguments of pyvista's add_mesh. A component of a vector or of a
        tensor is chosen by component=0, 1, ...
        """
        from synovia import pictures
        return pictures.draw(self.mesh(t, deformed=True), field, look)

    def _repr_html_(self) -> str:
        from synovia import plots
        history = self.history
        said = [f"<b>{html.escape(self.case.title or '')}</b>",
                f"{html.escape(str(self.directory))}: {history['t'].size} "
                f"steps to t = {history['t'][-1]:g}"]
        said += [f"warning: {html.escape(text)}" for text in self.warnings]
        return "<p>" + "<br>".join(said) + "</p>" \
            + plots.as_html(lambda ax: plots.forces(history, ax),
                            lambda ax: plots.pressures(history, ax))

    def __repr__(self) -> str:
        return f"Result({str(self.directory)!r})"
