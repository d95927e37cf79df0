"""The history of a run in a report: what it says in numbers."""

from __future__ import annotations

import re

import numpy as np

from report_log import RunLog
from report_units import Units
from synovia_output import Table

AXES = "xyz"
# Beyond these the theory of small strains is in doubt.
LARGE_STRAIN = 0.1
SMALL_DET_F = 0.5


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


def has_balance(history: Table) -> bool:
    return {"fluid.growth", "fluid.outflow",
            "fluid.volume_balance"} <= set(history)


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


Row = tuple[str, str]


def balance_in_words(error: float) -> str:
    """What a relative error of a balance means."""
    if error <= 1e-6:
        return "balanced"
    if error <= 1e-3:
        return "balanced well enough for any purpose"
    if error <= 1e-2:
        return "balanced roughly"
    return "not balanced: what depends on it can't be relied on"


def strain_rows(history: Table, units: Units) -> list[Row]:
    """The largest strains, and what they mean where they are large."""
    rows = []
    time = history["t"]
    if "strain.max_principal" in history:
        strain = history["strain.max_principal"]
        i = peak(strain)
        text = f"{100 * strain[i]:.3g} % at {units.at(time[i])}"
        if abs(strain[i]) > LARGE_STRAIN:
            text += (f"; beyond {100 * LARGE_STRAIN:g} %, where the theory of "
                     "small strains begins to deviate from what bodies do")
        rows.append(("Largest principal strain", text))
    if "strain.min_det_F" in history:
        volume = history["strain.min_det_F"]
        i = int(np.argmin(np.where(np.isfinite(volume), volume, np.inf)))
        text = f"{volume[i]:.3g} at {units.at(time[i])}"
        if volume[i] <= 0:
            text += ("; below zero, a body is turned inside out there: what is "
                     "computed around it has no physical meaning")
        elif volume[i] <= SMALL_DET_F:
            text += (f"; below {SMALL_DET_F:g}, a body is pressed to half its "
                     "volume or less there, which the theory of small strains "
                     "is not for")
        rows.append(("Smallest volume ratio det F", text))
    return rows


def work_rows(history: Table, log: RunLog) -> list[Row]:
    """What the run took."""
    rows = []
    if log:
        failed, inaccurate = log.tried_again()
        rows.append(("Steps tried again",
                     f"{failed} failed, {inaccurate} inaccurate"))
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
        rows.append(("Wall time of the steps (s)", f"{seconds.sum():.4g} in "
                     f"all, {seconds.max():.3g} at most for one"))
    phases = log.phases()
    if phases:
        total, parts = phases
        rows.append(("Wall time of the run (s)", f"{total:g}: " + ", ".join(
            f"{name} {seconds:g} ({100 * seconds / max(total, 1e-9):.0f} %)"
            for name, seconds in parts.items())))
    return rows


def run_rows(history: Table, case: dict, log: RunLog,
             units: Units) -> list[Row]:
    """The summary of the run, as names and values."""
    time = history["t"]
    end = case.get("time", {}).get("end")
    reached = f"{time[-1]:.4g}"
    if end is not None and time[-1] < end * (1 - 1e-9):
        reached += f" of {end:g}: not finished"
    rows = [("Steps", str(time.size)),
            (units.label("Reached t", "time"), reached)]
    if "dt" in history:
        dt = history["dt"]
        same = np.isclose(dt.min(), dt.max())
        rows.append((units.label("Step length", "time"),
                     ("" if same else f"{dt.min():.4g} to ")
                     + f"{dt.max():.4g}"))
    if "fluid.peak_pressure" in history:
        i = peak(history["fluid.peak_pressure"])
        rows.append((units.label("Peak fluid pressure", "pressure"),
                     f"{history['fluid.peak_pressure'][i]:.4g}"
                     f" at {units.at(time[i])}"))
    rows += strain_rows(history, units)
    if has_balance(history):
        error = balance_error(history)
        i = peak(error)
        rows.append(("Worst fluid balance", f"{error[i]:.1e} of the exchanged "
                     f"volume, at {units.at(time[i])}: "
                     f"{balance_in_words(error[i])}"))
    return rows + work_rows(history, log)


def pair_headings(units: Units) -> list[str]:
    return ["Pair", units.label("Peak force on the destination", "force"),
            units.label("Largest area", "area"),
            units.label("Peak traction", "pressure"),
            units.label("Worst penetration", "length"),
            units.label("Worst pressure jump", "pressure"),
            "Worst imbalance, of the peak force"]


def pair_rows(history: Table, units: Units) -> list[tuple[str, ...]]:
    """One row of the table of pair_headings() for each pair."""
    rows = []
    time = history["t"]
    for pair in pair_names(history):
        def worst(name: str, pair: str = pair) -> str:
            column = f"contact.{pair}.{name}"
            if column not in history:
                return "not recorded"
            i = peak(history[column])
            return f"{history[column][i]:.4g} at {units.at(time[i])}"

        force = pair_force(history, pair)
        i = peak(force)
        d = main_component(history, f"contact.{pair}.force_")
        imbalance = "not recorded"
        if f"contact.{pair}.force_error" in history:
            error = largest(force_error(history, pair))
            imbalance = f"{error:.1e}: {balance_in_words(error)}"
        rows.append((pair, f"{force[i]:.4g} along {AXES[d]} at "
                     f"{units.at(time[i])}", worst("area"),
                     worst("peak_traction"), worst("penetration"),
                     worst("pressure_jump"), imbalance))
    return rows
