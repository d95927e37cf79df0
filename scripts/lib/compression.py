"""Pictures of columns and discs that are compressed, beside references."""

from __future__ import annotations

import dataclasses
import functools
import pathlib
from collections.abc import Callable, Mapping

import numpy as np

import figure_style as style
import plot_script
from figure_style import plt
from synovia_output import Output, OutputError

# Coordinates and values, at points where they are known.
Profile = tuple[np.ndarray, np.ndarray]


def is_finite(out: Output) -> bool:
    """Whether the run was of finite deformation."""
    return out.case().get("physics", {}).get("deformation") == "finite"


@dataclasses.dataclass(frozen=True)
class Course:
    """A stress against time: a column of the history times a factor."""

    column: str
    factor: float
    exact: Profile

    def __call__(self, axes: plt.Axes, out: Output) -> list[str]:
        history = out.history()
        time = np.r_[0, history["t"]]
        stress = np.r_[0, self.factor * history[self.column]]
        known = self.exact[0] <= time[-1]
        exact_time, exact = (values[known] for values in self.exact)
        axes.plot(time, 1e3 * stress, label="Synovia")
        axes.plot(exact_time, 1e3 * exact, label="reference",
                  **style.REFERENCE)
        axes.set(xlabel="time (s)", ylabel="compressive stress (kPa)",
                 xlim=(0, time.max()), ylim=(0, None),
                 title="Stress on the platen")
        axes.legend(loc="lower right")
        error = np.abs(np.interp(exact_time, time, stress) - exact).max()
        return [f"stress: {stress.max():.6f} MPa at most, "
                f"{100 * error / exact.max():.2f} % of that from the reference"]


@dataclasses.dataclass(frozen=True)
class Profiles:
    """A column of a sampled line at all its times, over the points as meshed."""

    line: str
    along: str
    column: str
    where: str
    what: str
    factor: float
    exact: Callable[[float], Profile]

    def __call__(self, axes: plt.Axes, out: Output) -> list[str]:
        said = []
        for time, _ in out.lines()[self.line]:
            line = out.line(self.line, time)
            axes.plot(line[self.along], self.factor * line[self.column],
                      label=f"{time:g} s")
            said += self._compare(axes, line, time)
        axes.plot([], [], label="reference", **style.POINTS)
        axes.axhline(0, color=style.GRAY, linewidth=0.6)
        axes.set(xlabel=self.where, ylabel=self.what,
                 xlim=(0, line[self.along].max()))
        axes.set_title(self.what.split("$")[0].strip().capitalize())
        axes.legend()
        return said

    def _compare(self, axes: plt.Axes, line: Mapping[str, np.ndarray],
                 time: float) -> list[str]:
        try:
            places, exact = self.exact(time)
        except OutputError:
            return []   # the reference has other times
        axes.plot(places, self.factor * exact, clip_on=False,
                  **style.POINTS)
        found = np.interp(places, line[self.along], line[self.column])
        return [f"{self.column} at {time:g} s: differs by "
                f"{np.abs(found - exact).max():.2e} from up to "
                f"{np.abs(exact).max():.4g}"]


def draw(folder: pathlib.Path, case: str,
         panels: Mapping[str, Course | Profiles], out: Output) -> str:
    """Draws each panel by its name, and all of them by that of the case."""
    said = {}

    def draw_panel(name: str, axes: plt.Axes) -> None:
        said[name] = panels[name](axes, out)
    plot_script.draw_row(folder, case, {
        name: functools.partial(draw_panel, name) for name in panels})
    return "\n".join(line for lines in said.values() for line in lines)
