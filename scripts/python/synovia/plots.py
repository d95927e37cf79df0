"""Curves of results, in Matplotlib."""

from __future__ import annotations

import base64
import io
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

import numpy as np

from synovia.output import Table

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MOST_CURVES = 8     # of a plot that chooses its own


def axes_or_new(ax: Axes | None) -> Axes:
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt
    return plt.subplots(layout="constrained", figsize=(5.5, 3.4))[1]


def curves(t: np.ndarray, values: Mapping[str, np.ndarray],
           ax: Axes | None = None, ylabel: str = "") -> Axes:
    """Named curves in time."""
    ax = axes_or_new(ax)
    for name, value in values.items():
        ax.plot(t, value, label=name)
    ax.axhline(0, color="#666666", linewidth=0.6, zorder=0)
    ax.set(xlabel="t", ylabel=ylabel or ("" if len(values) > 1
                                         else next(iter(values), "")))
    if len(values) > 1 or ylabel:
        ax.legend(frameon=False, fontsize="small")
    return ax


def largest_components(history: Table, start: str, ends: tuple[str, ...]
                       ) -> dict[str, np.ndarray]:
    """Of each vector start + NAME + end the component that gets largest."""
    vectors: dict[str, list[str]] = {}
    for column in history:
        for end in ends:
            if column.startswith(start) and column.endswith(end):
                vectors.setdefault(column.removesuffix(end), []).append(column)
    largest = [max(columns, key=lambda name: np.abs(history[name]).max())
               for columns in vectors.values()]
    largest.sort(key=lambda name: -np.abs(history[name]).max())
    return {name: history[name] for name in largest[:MOST_CURVES]
            if history[name].any()}


def forces(history: Table, ax: Axes | None = None) -> Axes:
    """Contact forces or, without contact, reactions."""
    found = largest_components(history, "contact.",
                               (".force_x", ".force_y", ".force_z"))
    found = found or largest_components(history, "reaction.",
                                        (".x", ".y", ".z"))
    return curves(history["t"], found, ax, "force")


def pressures(history: Table, ax: Axes | None = None) -> Axes:
    """Peak pressures of the fluid, and peak tractions of contacts."""
    names = [name for name in history
             if name.endswith((".peak_pressure", ".peak_traction"))]
    return curves(history["t"], {name: history[name] for name in names}, ax,
                  "pressure")


def profiles(tables: list[tuple[float, Table]], name: str, column: str,
             ax: Axes | None = None) -> Axes:
    """A column of a line, sampled at several times."""
    import matplotlib
    ax = axes_or_new(ax)
    shades = matplotlib.colormaps["viridis"](np.linspace(0, 0.9, len(tables)))
    for (t, table), color in zip(tables, shades):
        ax.plot(table["s"], table[column], color=color, label=f"t = {t:g}")
    ax.set(xlabel=f"s along {name}", ylabel=column)
    ax.legend(frameon=False, fontsize="small")
    return ax


def as_html(*draw: Callable[[Axes], object]) -> str:
    """Plots beside each other, as an image within a page."""
    from matplotlib.figure import Figure
    figure = Figure(figsize=(5.0 * len(draw), 3.2), layout="constrained")
    for plot, ax in zip(draw, figure.subplots(1, len(draw), squeeze=False)[0]):
        plot(ax)
    stream = io.BytesIO()
    figure.savefig(stream, format="png", dpi=80)
    data = base64.b64encode(stream.getvalue()).decode("ascii")
    return f'<img src="data:image/png;base64,{data}">'
