"""Plots of the history of a run, for a report."""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

import figure_style as style
from figure_style import plt
from report_history import (
    AXES, LARGE_STRAIN, SMALL_DET_F, balance_error, boundary_names,
    force_error, has_balance, largest, main_component, pair_force,
    pair_names)
from report_units import Units
from synovia_output import Table

# Curves of one plot differ in color first, and in their strokes when the
# colors are used up.
STROKES = ("-", (0, (5, 1.5)), (0, (1, 1)), (0, (5, 1, 1, 1)))
# A legend within the plot hides curves when it is longer.
LONG_LEGEND = 2
WIDTH, HEIGHT = 3.6, 2.5    # of a plot, inches
LIMIT = {"color": style.RED, "linewidth": 0.8, "linestyle": (0, (4, 2)),
         "zorder": 0}

Curve = tuple[str, np.ndarray]


def plot_curves(time: np.ndarray, curves: list[Curve], title: str,
                quantity: str, units: Units, *, log: bool = False,
                steps: bool = False, limits: tuple[float, ...] = ()):
    """A figure of quantities against time; None if there is none to show.

    log: a logarithmic scale, which leaves out zeros; steps: the values
    belong to steps, not to times; limits: values to be marked, where the
    curves come near them.
    """
    if log:
        curves = [(name, np.where(values > 0, values, np.nan))
                  for name, values in curves]
    curves = [(name, values) for name, values in curves
              if np.isfinite(values).any()]
    if not curves:
        return None
    long = len(curves) > LONG_LEGEND
    columns = 1 if max(len(name) for name, _ in curves) > 24 else 2
    legend = 0.17 * -(-len(curves) // columns) if long else 0.0
    figure, axes = plt.subplots(figsize=(WIDTH, HEIGHT + legend))
    colors = plt.rcParams["axes.prop_cycle"].by_key()["color"]
    # Few points may be all there is; a curve of one would not be seen.
    marker = "o" if time.size <= 3 else ("." if log or steps else None)
    for i, (name, values) in enumerate(curves):
        axes.plot(time, values, label=name, color=colors[i % len(colors)],
                  linestyle="none" if steps
                  else STROKES[i // len(colors) % len(STROKES)],
                  linewidth=0.8 if log else 1.6,
                  marker=marker, markersize=4 if marker == "o" else 3)
    if log:
        axes.set_yscale("log")
        # Whole decades: within one, all ticks would be labeled.
        low, high = np.log10(axes.get_ylim())
        axes.set_ylim(10 ** np.floor(low), 10 ** np.ceil(high))
    elif steps:
        # Zeros are to be seen, too.
        top = max(largest(v) for _, v in curves) or 1.0
        axes.set_ylim(-0.04 * top, 1.06 * top)
    else:
        axes.axhline(0, color=style.GRAY, linewidth=0.6, zorder=0)
    low, high = axes.get_ylim()
    for limit in limits:
        if low <= limit <= high:
            axes.axhline(limit, **LIMIT)
            axes.text(0.99, limit, "limit of small strains", ha="right",
                      va="bottom", fontsize=7, color=LIMIT["color"],
                      transform=axes.get_yaxis_transform())
    axes.set(title=title, xlabel=units.label("time", "time"),
             ylabel=quantity, xlim=(min(0.0, time.min()), None))
    if len(curves) > 1 or curves[0][0]:
        if long:
            figure.legend(loc="outside lower center", ncols=columns)
        else:
            axes.legend(loc="best")
    return figure


def plots(history: Table, units: Units) -> Iterable[tuple[str, object]]:
    """Names and figures of all plots that this history allows."""
    time = history["t"]
    pairs = pair_names(history)

    def of_pairs(name: str, factor: float = 1.0) -> list[Curve]:
        return [(pair, factor * history[f"contact.{pair}.{name}"])
                for pair in pairs if f"contact.{pair}.{name}" in history]

    def columns(prefix: str, *names: str) -> list[Curve]:
        return [(name.replace("_", " "), history[prefix + name])
                for name in names if prefix + name in history]

    def forces() -> list[Curve]:
        return [(f"{pair} ({AXES[d]})", pair_force(history, pair))
                for pair in pairs
                for d in [main_component(history, f"contact.{pair}.force_")]]

    def reactions() -> list[Curve]:
        found = []
        for boundary in boundary_names(history):
            prefix = f"reaction.{boundary}."
            d = main_component(history, prefix)
            found.append((f"{boundary} ({AXES[d]})", history[prefix + AXES[d]]))
        most = max((largest(v) for _, v in found), default=0.0)
        return [(n, v) for n, v in found if largest(v) > 1e-9 * most]

    def relative_balance() -> list[Curve]:
        return [("", balance_error(history))] if has_balance(history) else []

    def force_errors() -> list[Curve]:
        return [(pair, force_error(history, pair)) for pair in pairs
                if f"contact.{pair}.force_error" in history]

    # What is drawn, its title, quantity and kind of unit, and how
    wanted: list[tuple[Callable[[], list[Curve]], str, str, str, dict]] = [
        (forces, "Contact force on the destination", "force", "force", {}),
        (reactions, "Reactions of the supports", "force", "force", {}),
        (lambda: of_pairs("area"), "Contact area", "area", "area", {}),
        (lambda: columns("fluid.", "peak_pressure"), "Peak fluid pressure",
         "pressure", "pressure", {}),
        (lambda: of_pairs("peak_traction"), "Peak contact traction",
         "traction", "pressure", {}),
        (lambda: [("", v) for _, v in columns("strain.", "max_principal")],
         "Largest principal strain", "strain", "",
         {"limits": (-LARGE_STRAIN, LARGE_STRAIN)}),
        (lambda: [("", v) for _, v in columns("strain.", "min_det_F")],
         "Smallest volume ratio", "det F", "",
         {"limits": (SMALL_DET_F,)}),
        (lambda: columns("fluid.", "outflow", "growth")
         + [(f"exchange, {n}", v) for n, v in of_pairs("fluid_exchange")],
         "Fluid: rates of all bodies", "volume rate", "flow", {}),
        (lambda: of_pairs("penetration"), "Worst penetration",
         "penetration", "length", {"log": True}),
        (lambda: of_pairs("pressure_jump"), "Worst pressure jump in contact",
         "jump", "pressure", {"log": True}),
        (force_errors, "Force imbalance",
         "of the peak force", "", {"log": True}),
        (relative_balance, "Error of the fluid balance",
         "of the exchanged volume", "", {"log": True}),
        (lambda: columns("solver.", "newton", "augmentations"),
         "Iterations of each step", "iterations", "", {"steps": True}),
        (lambda: columns("solver.", "linear"),
         "Linear iterations of each step", "iterations", "", {"steps": True}),
        (lambda: [("", v) for _, v in columns("", "dt")],
         "Step length", "step", "time", {"steps": True}),
        (lambda: [("", v) for _, v in columns("solver.", "seconds")],
         "Wall time of each step", "wall time (s)", "", {"steps": True})]
    for curves, title, quantity, kind, how in wanted:
        drawn = curves()
        # With one pair, the title says it all.
        if len(drawn) == 1 and len(pairs) <= 1:
            drawn = [("", drawn[0][1])] if "(" not in drawn[0][0] else drawn
        figure = plot_curves(time, drawn, title,
                             units.label(quantity, kind), units, **how)
        if figure is not None:
            yield title, figure
