"""The history of a run in a report: a summary in numbers, and its plots."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Callable, Iterable

import numpy as np

import figure_style as style
from figure_style import plt
from synovia_output import Table

AXES = "xyz"
# Curves of one plot differ in colour first, and in their strokes when the
# colours are used up.
STROKES = ("-", (0, (5, 1.5)), (0, (1, 1)), (0, (5, 1, 1, 1)))
# A legend within the plot hides curves when it is longer.
LONG_LEGEND = 2
WIDTH, HEIGHT = 3.6, 2.5    # of a plot, inches


@dataclasses.dataclass(frozen=True)
class Units:
    """Names of the case's units of length, force and time, or none."""

    length: str = ""
    force: str = ""
    time: str = ""

    @staticmethod
    def parse(text: str) -> Units:
        """From "mm,N,s"; a ValueError for anything else."""
        parts = [part.strip() for part in text.split(",")]
        if len(parts) != 3 or not all(parts):
            raise ValueError(f"'{text}' is not LENGTH,FORCE,TIME, such as "
                             "mm,N,s")
        return Units(*parts)

    def of(self, kind: str) -> str:
        """The unit of a kind of quantity; empty if it has or we know none."""
        if not self.length:
            return ""
        if kind == "pressure":
            known = {("mm", "N"): "MPa", ("m", "N"): "Pa"}
            return known.get((self.length, self.force),
                             f"{self.force}/{self.length}²")
        return {"length": self.length, "force": self.force, "time": self.time,
                "area": f"{self.length}²",
                "flow": f"{self.length}³/{self.time}"}.get(kind, "")

    def label(self, name: str, kind: str) -> str:
        """The label of an axis."""
        unit = self.of(kind)
        return f"{name} ({unit})" if unit else name

    def value(self, number: float, kind: str) -> str:
        unit = self.of(kind)
        return f"{number:.4g}" + (f" {unit}" if unit else "")


def pair_names(history: Table) -> list[str]:
    return [match[1] for match in
            (re.fullmatch(r"contact\.(.+)\.force_x", c) for c in history)
            if match]


def boundary_names(history: Table) -> list[str]:
    return [match[1] for match in
            (re.fullmatch(r"reaction\.(.+)\.x", c) for c in history) if match]


def peak(values: np.ndarray) -> int:
    """The row of the greatest absolute value."""
    size = np.abs(values)
    return int(np.argmax(np.where(np.isfinite(size), size, -1.0)))


def largest(values: np.ndarray) -> float:
    """The greatest absolute value that is a number."""
    return abs(float(values[peak(values)]))


def main_component(history: Table, prefix: str) -> int:
    """The component with the greatest value: 0, 1 or 2."""
    return int(np.argmax([largest(history[prefix + axis]) for axis in AXES]))


def pair_force(history: Table, pair: str) -> np.ndarray:
    """The force on the destination along its main component."""
    prefix = f"contact.{pair}.force_"
    return history[prefix + AXES[main_component(history, prefix)]]


def key_time(history: Table) -> float:
    """When the contact forces, or else the fluid pressure, are greatest."""
    pairs = pair_names(history)
    if pairs:
        load = np.sum([np.abs(pair_force(history, p)) for p in pairs], axis=0)
    else:
        load = history["fluid.peak_pressure"] \
            if "fluid.peak_pressure" in history else history["t"]
    return float(history["t"][peak(load)])


def main_direction(case: dict, history: Table) -> int:
    """The direction in which the case is loaded, or else z: 0, 1 or 2.

    The greatest prescribed displacement decides, then the greatest force.
    """
    sizes = np.zeros(3)
    for boundary in case.get("boundary", ()):
        components = boundary.get("displacement", ())
        for d, value in enumerate(components[:3]):
            values = value.get("values", ()) if isinstance(value, dict) \
                else [value]
            sizes[d] = max([sizes[d]] + [abs(v) for v in values
                                         if isinstance(v, (int, float))])
    if not sizes.any():
        for pair in pair_names(history):
            d = main_component(history, f"contact.{pair}.force_")
            sizes[d] += largest(pair_force(history, pair))
    return int(np.argmax(sizes)) if sizes.any() else 2


def balance_error(history: Table) -> np.ndarray:
    """What is missing of the fluid over what was exchanged in each step."""
    exchanged = np.maximum(np.abs(history["fluid.growth"]),
                           np.abs(history["fluid.outflow"]))
    # Where nothing moves any more, round-off would be compared with itself.
    floor = 1e-9 * largest(exchanged)
    return np.divide(np.abs(history["fluid.volume_balance"]), exchanged,
                     out=np.zeros_like(exchanged), where=exchanged > floor)


def force_error(history: Table, pair: str) -> np.ndarray:
    """The sum of both sides' forces over the pair's peak force."""
    peak_force = largest(pair_force(history, pair))
    error = history[f"contact.{pair}.force_error"]
    return error / peak_force if peak_force > 0 else error


def run_rows(history: Table, case: dict, log: str,
             units: Units) -> list[tuple[str, str]]:
    """The summary of the run, as names and values."""
    time = history["t"]
    end = case.get("time", {}).get("end")
    reached = units.value(time[-1], "time")
    if end is not None and time[-1] < end * (1 - 1e-9):
        reached += f" of {end:g}: not finished"
    rows = [("Steps", str(time.size)), ("Reached t", reached)]
    if "dt" in history:
        dt = history["dt"]
        same = np.isclose(dt.min(), dt.max())
        rows.append(("Step length", ("" if same else f"{dt.min():.4g} to ")
                     + units.value(dt.max(), "time")))
    tries = sum(int(n) for n in re.findall(r"failed tries (\d+)", log))
    inaccurate = sum(int(n) for n in re.findall(r", inaccurate (\d+)", log))
    if log:
        rows.append(("Steps tried again",
                     f"{tries} failed, {inaccurate} inaccurate"))
    if "fluid.peak_pressure" in history:
        i = peak(history["fluid.peak_pressure"])
        rows.append(("Peak fluid pressure", units.value(
            history["fluid.peak_pressure"][i], "pressure")
            + f" at t = {time[i]:.4g}"))
    if "fluid.volume_balance" in history:
        error = balance_error(history)
        i = peak(error)
        rows.append(("Worst fluid balance", f"{error[i]:.1e} of the exchanged "
                     f"volume, at t = {time[i]:.4g}"))
    for name, title in (("newton", "Newton iterations"),
                        ("augmentations", "Augmentations"),
                        ("linear", "Linear iterations")):
        if f"solver.{name}" in history:
            count = history[f"solver.{name}"]
            rows.append((f"{title} per step",
                         f"{count.mean():.1f} on average, {count.max():.0f} "
                         f"at most, {count.sum():.0f} in all"))
    if "solver.seconds" in history:
        seconds = history["solver.seconds"]
        rows.append(("Wall time of the steps", f"{seconds.sum():.4g} s, "
                     f"{seconds.max():.3g} s at most for one"))
    totals = re.findall(r"total ([0-9.]+) s: (.+)", log)
    if totals:
        rows.append(("Wall time in all",
                     f"{totals[-1][0]} s: {totals[-1][1]}"))
    return rows


PAIR_HEADINGS = ("Pair", "Peak force on the destination", "Largest area",
                 "Peak traction", "Worst penetration", "Worst pressure jump",
                 "Worst imbalance, of the peak force")


def pair_rows(history: Table, units: Units) -> list[tuple[str, ...]]:
    """One row of the table of PAIR_HEADINGS for each pair."""
    rows = []
    time = history["t"]
    for pair in pair_names(history):
        def worst(name: str, kind: str, pair: str = pair) -> str:
            column = f"contact.{pair}.{name}"
            if column not in history:
                return "not recorded"
            i = peak(history[column])
            return (f"{units.value(history[column][i], kind)} "
                    f"at t = {time[i]:.4g}")

        force = pair_force(history, pair)
        i = peak(force)
        d = main_component(history, f"contact.{pair}.force_")
        error = f"{largest(force_error(history, pair)):.1e}" \
            if f"contact.{pair}.force_error" in history else "not recorded"
        rows.append((pair, f"{units.value(force[i], 'force')} along {AXES[d]}"
                     f" at t = {time[i]:.4g}",
                     worst("area", "area"), worst("peak_traction", "pressure"),
                     worst("penetration", "length"),
                     worst("pressure_jump", "pressure"), error))
    return rows


Curve = tuple[str, np.ndarray]


def plot_curves(time: np.ndarray, curves: list[Curve], title: str,
                quantity: str, units: Units, *, log: bool = False,
                steps: bool = False):
    """A figure of quantities against time; None if there is none to show.

    log: a logarithmic scale, which leaves out zeros; steps: the values
    belong to steps, not to times.
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
    colours = plt.rcParams["axes.prop_cycle"].by_key()["color"]
    # Few points may be all there is; a curve of one would not be seen.
    marker = "o" if time.size <= 3 else ("." if log or steps else None)
    for i, (name, values) in enumerate(curves):
        axes.plot(time, values, label=name, color=colours[i % len(colours)],
                  linestyle="none" if steps
                  else STROKES[i // len(colours) % len(STROKES)],
                  linewidth=0.8 if log else 1.6,
                  marker=marker, markersize=4 if marker == "o" else 3)
    if log:
        axes.set_yscale("log")
    elif steps:
        # Zeros are to be seen, too.
        top = max(largest(v) for _, v in curves) or 1.0
        axes.set_ylim(-0.04 * top, 1.06 * top)
    else:
        axes.axhline(0, color=style.GREY, linewidth=0.6, zorder=0)
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
        return [("", balance_error(history))] \
            if {"fluid.growth", "fluid.outflow",
                "fluid.volume_balance"} <= set(history) else []

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
        (lambda: columns("fluid.", "outflow", "growth")
         + [(f"exchange, {n}", v) for n, v in of_pairs("fluid_exchange")],
         "Fluid: rates of all bodies", "volume rate", "flow", {}),
        (lambda: of_pairs("penetration"), "Worst penetration",
         "penetration", "length", {"log": True}),
        (lambda: of_pairs("pressure_jump"), "Worst pressure jump in contact",
         "jump", "pressure", {"log": True}),
        (force_errors, "Force imbalance, over the peak force",
         "relative error", "", {"log": True}),
        (relative_balance, "Fluid balance, over the exchanged volume",
         "relative error", "", {"log": True}),
        (lambda: columns("solver.", "newton", "augmentations"),
         "Iterations of each step", "iterations", "", {"steps": True}),
        (lambda: columns("solver.", "linear"),
         "Linear iterations of each step", "iterations", "", {"steps": True}),
        (lambda: [("", v) for _, v in columns("", "dt")],
         "Step length", "step", "time", {"steps": True}),
        (lambda: [("", v) for _, v in columns("solver.", "seconds")],
         "Wall time of each step", "seconds", "", {"steps": True})]
    for curves, title, quantity, kind, how in wanted:
        drawn = curves()
        # With one pair, the title says it all.
        if len(drawn) == 1 and len(pairs) <= 1:
            drawn = [("", drawn[0][1])] if "(" not in drawn[0][0] else drawn
        figure = plot_curves(time, drawn, title,
                             units.label(quantity, kind), units, **how)
        if figure is not None:
            yield title, figure
