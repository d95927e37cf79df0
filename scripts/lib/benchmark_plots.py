"""Plots of scripts/benchmark, and what they show in numbers."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable

import numpy as np
from matplotlib.ticker import LogLocator, NullFormatter

import figure_style as style
from benchmark_runs import Row, Store
from benchmark_sweeps import FLAT, Sweep
from figure_style import plt

MOST = 40            # iterations that a linear system may take
MOST_GROWTH = 1.5    # along an axis
PHASES = (("assembly", "assembly"), ("search", "contact search"),
          ("setup", "set-up"), ("solve", "solution"), ("rest", "the rest"))
PANEL = (3.1, 2.4)   # inches
STROKES = ("-", (0, (5, 1.5)), (0, (1, 1)))


@dataclasses.dataclass
class Curve:
    """The rows of one series that came to an end, by x."""

    name: str
    x: np.ndarray
    rows: list[Row]
    failed: int
    failed_x: list[float]

    def column(self, name: str) -> np.ndarray:
        return np.array([float(row[name]) for row in self.rows])


def curves(sweep: Sweep, store: Store) -> list[Curve]:
    found: dict[str, list[tuple[float, Row]]] = {}
    for point in sweep.points:
        if point.run.key in store:
            found.setdefault(point.series, []).append(
                (point.x, store[point.run.key]))
    result = []
    for name, places in found.items():
        good = [(x, row) for x, row in places if row["status"] == "ok"]
        if sweep.measured_by:
            good = [(float(row[sweep.measured_by]), row) for _, row in good]
        good.sort(key=lambda place: place[0])
        bad = [x for x, row in places if row["status"] != "ok"]
        result.append(Curve(name, np.array([x for x, _ in good]),
                            [row for _, row in good], len(bad),
                            [] if sweep.measured_by else bad))
    return result


@dataclasses.dataclass(frozen=True)
class Growth:
    """How the iterations of one series change along its axis."""

    sweep: str
    series: str
    least: int
    base: int      # at the base point, or at the smallest x if it isn't there
    most: int
    failed: int

    @property
    def factor(self) -> float:
        return self.most / max(1, self.base)

    @property
    def good(self) -> bool:
        return (self.failed == 0 and self.most <= MOST
                and self.factor <= MOST_GROWTH)


def growths(sweeps: Iterable[Sweep], store: Store) -> list[Growth]:
    found = []
    for sweep in sweeps:
        for curve in curves(sweep, store) if sweep.name in FLAT else ():
            most = curve.column("most_linear") if curve.rows else np.zeros(1)
            at_base = np.flatnonzero(curve.x == sweep.base)
            base = most[at_base[0] if len(at_base) else 0]
            found.append(Growth(sweep.name, curve.name, int(most.min()),
                                int(base), int(most.max()), curve.failed))
    return found


def seconds(row: Row, phase: str) -> float:
    if phase != "rest":
        return float(row[f"seconds_{phase}"])
    known = sum(seconds(row, name) for name, _ in PHASES[:-1])
    return max(0.0, float(row["seconds_total"]) - known)


def look(i: int) -> dict:
    colors = plt.rcParams["axes.prop_cycle"].by_key()["color"]
    return {"color": colors[i % len(colors)],
            "linestyle": STROKES[i // len(colors) % len(STROKES)],
            "marker": "osD^vP"[i % 6], "markersize": 3.5}


def set_axis(axes, sweep: Sweep) -> None:
    axes.set_xlabel(sweep.label)
    if sweep.logarithmic:
        axes.set_xscale("log")
    if sweep.label == "unknowns":
        set_size_ticks(axes)
    if sweep.label == "ranks":
        set_rank_ticks(axes, sorted({p.x for p in sweep.points}))


def set_size_ticks(axes) -> None:
    """Unknowns, as 1k, 2k, 5k and so on."""
    axes.set_xscale("log")
    axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes.xaxis.set_major_formatter(lambda x, _: f"{1e-3 * x:g}k")
    axes.xaxis.set_minor_formatter(NullFormatter())


def set_rank_ticks(axes, ranks: list[float]) -> None:
    axes.set_xscale("log", base=2)
    axes.set_xticks(ranks, [f"{r:g}" for r in ranks])
    axes.minorticks_off()


def draw_iterations(axes, sweep: Sweep, store: Store) -> None:
    """The most that a linear system took, the mean as a thin line."""
    highest = MOST
    for i, curve in enumerate(curves(sweep, store)):
        if curve.rows:
            most = curve.column("most_linear")
            highest = max(highest, most.max())
            axes.plot(curve.x, most, label=curve.name, **look(i))
            axes.plot(curve.x, curve.column("mean_linear"),
                      color=look(i)["color"], linewidth=0.7)
        if curve.failed_x:
            axes.plot(curve.failed_x, [0.0] * len(curve.failed_x), "x",
                      color=style.RED, clip_on=False)
    axes.axhline(MOST, **style.REFERENCE)
    axes.set_ylim(0, 1.15 * highest)
    set_axis(axes, sweep)


def panels(count: int, columns: int = 3):
    rows = -(-count // columns)
    columns = min(columns, count)
    figure, axes = plt.subplots(
        rows, columns, figsize=(PANEL[0] * columns, PANEL[1] * rows),
        squeeze=False)
    for spare in axes.flat[count:]:
        spare.set_axis_off()
    return figure, list(axes.flat)


def iterations_figure(sweeps: list[Sweep], store: Store):
    flat = [sweep for sweep in sweeps
            if sweep.name in FLAT and curves(sweep, store)]
    if not flat:
        return None
    figure, axes = panels(len(flat) + 1)
    key = axes[len(flat)]
    key.set_axis_off()
    handles = {}
    for panel, sweep in zip(axes, flat):
        draw_iterations(panel, sweep, store)
        own = dict(zip(*reversed(panel.get_legend_handles_labels())))
        if len(own) > 2:
            panel.legend(fontsize=6.5, ncols=2, loc="upper left",
                         handlelength=1.6, columnspacing=0.8,
                         borderaxespad=0.0).set_in_layout(False)
            panel.set_ylim(top=1.6 * panel.get_ylim()[1])
        else:
            handles |= {name: handle for name, handle in own.items()
                        if name not in ("strong", "weak")}
        panel.set_title({"strong": "same problem", "weak": "same share"}
                        .get(sweep.name, ""))
    for i in range(0, len(flat), 3):
        axes[i].set_ylabel("iterations")
    handles["mean"] = plt.Line2D([], [], color=style.BLUE, linewidth=0.7)
    handles["limit"] = plt.Line2D([], [], **style.REFERENCE)
    key.legend(handles.values(), handles.keys(), loc="center left",
               title="most of a linear system").set_in_layout(False)
    return figure


def stack_phases(axes, places: np.ndarray, rows: list[Row]) -> None:
    """Bars of the share of each phase in the time."""
    bottom = np.zeros(len(rows))
    total = np.array([float(row["seconds_total"]) for row in rows])
    colors = (style.GREEN, style.ORANGE, style.SKY, style.BLUE, "#bbbbbb")
    for (name, label), color in zip(PHASES, colors):
        share = np.array([seconds(row, name) for row in rows]) / total
        axes.bar(places, share, 0.7, bottom, label=label, color=color)
        bottom += share
    axes.set_ylim(0, 1)


def costs_figure(sweep: Sweep, store: Store):
    """Time by phase, unknowns a second and memory against the unknowns."""
    found = [curve for curve in curves(sweep, store) if curve.rows]
    if not found:
        return None
    figure, (left, middle, right) = plt.subplots(
        1, 3, figsize=(3 * PANEL[0], 1.35 * PANEL[1]))
    shown = next((c for c in found if c.name in ("hex, order 2", "block_amg")),
                 found[0])
    places = np.arange(len(shown.rows))
    stack_phases(left, places, shown.rows)
    left.set_xticks(places, [f"{x:,.0f}" for x in shown.x], rotation=30)
    left.set_xlabel(f"unknowns ({shown.name})")
    left.set_ylabel("part of the time")
    for i, curve in enumerate(found):
        middle.plot(curve.x, curve.column("dofs_per_second"),
                    label=curve.name, **look(i))
        right.plot(curve.x, curve.column("memory_sum"), **look(i))
    for axes, name in ((middle, "unknowns × steps / s"), (right, "memory (MiB)")):
        axes.set_xlabel("unknowns")
        axes.set_ylabel(name)
        set_size_ticks(axes)
        axes.set_yscale("log")
        axes.yaxis.set_minor_formatter(NullFormatter())
    figure.legend(*left.get_legend_handles_labels(), ncols=2,
                  loc="outside upper left")
    figure.legend(*middle.get_legend_handles_labels(), ncols=3,
                  loc="outside upper right")
    return figure


def ranks_figure(strong: Sweep, weak: Sweep, store: Store):
    """Speed-up, efficiency at the same share, and the strong one's phases."""
    found = [c for sweep in (strong, weak) for c in curves(sweep, store)
             if c.rows]
    if len(found) != 2:
        return None
    figure, (left, middle, right) = plt.subplots(
        1, 3, figsize=(3 * PANEL[0], 1.35 * PANEL[1]))
    for curve, axes in zip(found, (left, middle)):
        ideal = per_rank = curve.x
        axes.set_ylabel("speed-up")
        if axes is middle:
            ideal = np.ones(len(curve.x))
            axes.set_ylabel("efficiency")
            axes.set_ylim(0, 1.2)
        else:
            per_rank = np.ones(len(curve.x))
        axes.plot(curve.x, ideal, label="ideal", **style.REFERENCE)
        # Finer meshes take more of Newton's steps to find the contact, which
        # says nothing about ranks.
        iteration = (curve.column("dofs") * curve.column("linear")
                     / curve.column("seconds_solve"))
        for i, (label, rate) in enumerate(
                (("whole run", curve.column("dofs_per_second")),
                 ("a linear iteration", iteration))):
            gain = rate / rate[0] * curve.x[0] / per_rank
            axes.plot(curve.x, gain, label=label, **look(i))
        axes.set_xlabel("ranks")
        set_rank_ticks(axes, list(curve.x))
        axes.legend()
    size = found[0].rows[0]["dofs"]
    left.set_title(f"{float(size):,.0f} unknowns")
    share = np.mean(found[1].column("dofs") / found[1].x)
    middle.set_title(f"{share:,.0f} unknowns a rank")
    places = np.arange(len(found[0].rows))
    stack_phases(right, places, found[0].rows)
    right.set_xticks(places, [f"{x:g}" for x in found[0].x])
    right.set_xlabel("ranks (same problem)")
    right.set_ylabel("part of the time")
    figure.legend(*right.get_legend_handles_labels(), ncols=5,
                  loc="outside upper right")
    return figure
