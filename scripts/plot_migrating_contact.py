#!/usr/bin/env python3
"""Pictures of friction under a contact that migrates, and one that rests.

Reads OUT, the output directory of miniapps/cases/migrating_contact.toml, and, if
it is there, RESTING, that of miniapps/cases/resting_contact.toml, and draws

  load_support.png      the part of the load that the fluid bears against time
  friction.png          effective coefficient of friction against time
  correlation.png       the one against the other
  pressure_migrating.png  fluid pressure in the deformed layer, below the sphere
  pressure_resting.png    likewise
  migrating_contact.png all of them

Points are the middles of the strokes, where all of the contact slides. Units are
mm, N, s, MPa.
"""

from __future__ import annotations

import functools
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "lib"))

import missing_module  # noqa: E402,F401

import numpy as np  # noqa: E402

import figure_style as style  # noqa: E402
import plot_script  # noqa: E402
import section  # noqa: E402
from figure_style import plt  # noqa: E402
from synovia_output import Output, OutputError  # noqa: E402

PAIR = "contact.sphere."
BODY = "rigid_body.sphere."
COLORS = {"migrating": style.BLUE, "resting": style.RED}


class Run:
    """Of a sphere that goes to and fro."""

    def __init__(self, name: str, out: Output):
        self.name = name
        self.color = COLORS[name]
        self.out = out
        self.history = out.history()
        self.time = self.history["t"]
        self.support = self.history[f"{PAIR}fluid_load_support"]
        self.friction = self.history[f"{PAIR}friction_coefficient"]
        self.place = self.history[f"{BODY}translation_x"]

    @functools.cached_property
    def law(self) -> tuple[float, float]:
        """Coefficient without fluid pressure, and the solid's fraction."""
        try:
            keys = self.out.case()["contact"][0]["friction"]
            return keys["coefficient"], keys["solid_fraction"]
        except (KeyError, IndexError) as error:
            raise OutputError(f"case.toml of '{self.out.directory}' has no "
                              "contact with friction") from error

    @functools.cached_property
    def middles(self) -> np.ndarray:
        """Rows in the middle of a stroke."""
        x = self.place
        farthest = np.abs(x).max()
        turns = np.flatnonzero(np.diff(np.sign(np.diff(x))) != 0) + 1
        strokes = np.split(np.arange(len(x)), turns)
        rows = [rows[np.argmin(np.abs(x[rows]))] for rows in strokes]
        return np.array([i for i in rows if abs(x[i]) < 0.2 * farthest
                         and i > 0 and x[i] != x[i - 1]], dtype=int)

    def last_middle(self) -> int:
        if len(self.middles) == 0:
            raise OutputError(f"the sphere of '{self.out.directory}' makes no "
                              "stroke")
        return int(self.middles[-1])


def against_time(axes: plt.Axes, runs: list[Run], values: str,
                 label: str) -> None:
    for run in runs:
        y = getattr(run, values)
        axes.plot(run.time, y, color=run.color, linewidth=0.8, alpha=0.5)
        axes.plot(run.time[run.middles], y[run.middles], "o-",
                  color=run.color, markersize=3.5, label=run.name)
    axes.set(xlabel="time (s)", ylabel=label,
             xlim=(0, max(run.time.max() for run in runs)))


def load_support(axes: plt.Axes, runs: list[Run]) -> None:
    against_time(axes, runs, "support", "fluid load support")
    axes.set(ylim=(0, 1), title="Part of the load that the fluid bears")
    axes.legend(loc="lower left")


def friction(axes: plt.Axes, runs: list[Run]) -> None:
    against_time(axes, runs, "friction", r"friction coefficient $\mu$")
    mu, _ = runs[0].law
    axes.axhline(mu, label="without fluid pressure", **style.REFERENCE)
    axes.set(ylim=(0, 1.08 * mu), title="Effective friction")
    axes.legend(loc="lower right")


def correlation(axes: plt.Axes, runs: list[Run]) -> None:
    mu, solid = runs[0].law
    support = np.array([0.0, 1.0])
    axes.plot(support, mu * (1 - (1 - solid) * support),
              label=r"$\mu\,[1-(1-\varphi)W]$", **style.REFERENCE)
    for run in runs:
        axes.plot(run.support[run.middles], run.friction[run.middles], "o",
                  color=run.color, markersize=3.5, label=run.name)
    axes.set(xlabel="fluid load support $W$",
             ylabel=r"friction coefficient $\mu$", xlim=(0, 1),
             ylim=(0, 1.08 * mu), title="One against the other")
    axes.legend(loc="upper right")


def pressure(axes: plt.Axes, run: Run) -> None:
    """In the plane y = 0, at the last fields in the middle of a stroke."""
    times = run.out.field_times("bodies")
    ends = run.time[run.middles]
    found = [t for t in times if np.abs(ends - t).min() < 1e-6]
    if not found:
        raise OutputError(f"'{run.out.directory}' has no fields in the middle "
                          "of a stroke")
    grid = run.out.fields("bodies", found[-1])
    section.require_fields(grid, ("displacement", "fluid_pressure",
                                  "attribute"), run.out.directory)
    # The sphere is above the layer.
    layer = min(section.bodies_of(grid), key=lambda body: body.bounds[4])
    sections = section.cut([layer], normal=1, at=0.0)
    values = 1e3 * sections[0]["fluid_pressure"]
    section.draw_section(axes, sections, [0, 2], [values],
                         "fluid pressure (kPa)", cmap="viridis",
                         vmin=min(0.0, values.min()), vmax=values.max())
    shape = run.out.case()["rigid_body"][0]["shape"]
    row = int(np.argmin(np.abs(run.time - found[-1])))
    center = np.array(shape["center"]) + [
        run.history[f"{BODY}translation_{axis}"][row] for axis in "xyz"]
    angles = np.linspace(-0.3, 0.3, 61)
    axes.plot(center[0] + shape["radius"] * np.sin(angles),
              center[2] - shape["radius"] * np.cos(angles),
              color=style.GRAY, linewidth=1.2)
    x_low, x_high, _, _, z_low, z_high = layer.bounds
    axes.set(xlim=(x_low, x_high), ylim=(z_low - 0.02, z_high + 0.4),
             xlabel="$x$ (mm)", ylabel="$z$ (mm)",
             title=f"Fluid pressure, {run.name}, {found[-1]:g} s")


def panels_of(runs: list[Run]) -> dict:
    panels = {panel.__name__: functools.partial(panel, runs=runs)
              for panel in (load_support, friction, correlation)}
    return panels | {f"pressure_{run.name}": functools.partial(pressure,
                                                               run=run)
                     for run in runs}


def draw(runs: list[Run], folder: pathlib.Path) -> None:
    style.use_style()
    panels = panels_of(runs)
    for name, panel in panels.items():
        size = (6.4, 2.4) if name.startswith("pressure") else (3.6, 2.9)
        figure, axes = plt.subplots(figsize=size)
        panel(axes)
        figure.savefig(folder / f"{name}.png", bbox_inches="tight")
        plt.close(figure)
    figure = plt.figure(figsize=(10.5, 3.2 + 2.1 * len(runs)))
    rows = figure.add_gridspec(1 + len(runs), 3,
                               height_ratios=(3.2,) + (2.1,) * len(runs))
    places = [rows[0, j] for j in range(3)]
    places += [rows[1 + i, :] for i in range(len(runs))]
    for letter, place, panel in zip("abcde", places, panels.values()):
        axes = figure.add_subplot(place)
        panel(axes)
        axes.set_title(f"({letter}) {axes.get_title(loc='left')}")
    figure.savefig(folder / "migrating_contact.png")
    plt.close(figure)


def findings(runs: list[Run]) -> str:
    lines = []
    for run in runs:
        for which, i in (("first", int(run.middles[0])),
                         ("last", run.last_middle())):
            lines.append(
                f"{run.name}, {which} middle, {run.time[i]:g} s: the fluid "
                f"bears {100 * run.support[i]:.1f} % of the load, friction "
                f"coefficient {run.friction[i]:.4f}")
    return "\n".join(lines)


def pictures(outs: list[Output], folder: pathlib.Path) -> str:
    runs = [Run(name, out) for name, out in zip(COLORS, outs)]
    for run in runs:
        run.last_middle()
    draw(runs, folder)
    return findings(runs)


def main(argv: list[str] | None = None) -> int:
    return plot_script.run_beside(argv, __doc__, "migrating_contact",
                                  "resting_contact", pictures)


if __name__ == "__main__":
    sys.exit(main())
