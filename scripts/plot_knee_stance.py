#!/usr/bin/env python3
"""Pictures of a knee in gait, cycle by cycle.

Reads OUT, the output directory of miniapps/cases/knee_stance.toml, and draws

  load.png              force and flexion of a cycle
  area.png              contact area on the tibia, of the first and the last cycle,
                        all of it and the menisci's part
  peak.png              peak contact stress where the femur touches the tibia, of
                        both cycles
  shares.png            the parts of the force that go through the menisci and
                        the medial side, and that the fluid bears, of both
  approach.png          how far the femur came down, of all cycles
  pressure_first.png    contact pressure on the tibia and below the menisci, from
                        above, at the first peak of the force in the last cycle
  pressure_second.png   the same at the second one
  knee_stance.png       all of them

A cycle that the run has not been through is left out. Units are mm, N, s, MPa.
"""

from __future__ import annotations

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "lib"))

import missing_module  # noqa: E402,F401

import numpy as np  # noqa: E402
from matplotlib.figure import FigureBase  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402

import figure_style as style  # noqa: E402
import plot_script  # noqa: E402
import tibial_contact as tibia  # noqa: E402
from figure_style import plt  # noqa: E402
from knee_run import SIDES, Knee  # noqa: E402
from synovia_output import Output, OutputError  # noqa: E402

BEGIN, PERIOD = 0.2, 1.0            # of the first cycle, s
STANCE = 0.6                        # its part, s
PEAKS = (0.15, 0.45)                # of the force, in a cycle
BODY = "rigid_body.femur."
FIRST = {"linestyle": (0, (4, 1.5))}
LAST = {"linestyle": "-"}


class Gait:
    """A run, cut into cycles."""

    def __init__(self, out: Output):
        self.knee = Knee(out, BEGIN)
        self.t = self.knee.history["t"]
        self.cycles = int(np.floor((self.t[-1] - BEGIN) / PERIOD + 1e-6))
        if self.cycles < 1:
            raise OutputError(f"'{out.directory}' ends at t = {self.t[-1]:g}, "
                              "within the first cycle")

    def phase(self, cycle: int, values: np.ndarray) -> tuple:
        """Times since a cycle's beginning, and values; cycles count from 0."""
        begin = BEGIN + cycle * PERIOD
        inside = ((self.t > begin - 1e-6)
                  & (self.t < begin + PERIOD + 1e-6))
        return self.t[inside] - begin, values[inside]

    def shown(self) -> list[tuple[int, dict]]:
        """The first cycle and the last one, with their line styles."""
        last = self.cycles - 1
        return [(0, FIRST), (last, LAST)] if last > 0 else [(0, LAST)]

    def field_time(self, peak: float) -> float:
        """Of the fields next to a peak of the last cycle."""
        at = BEGIN + (self.cycles - 1) * PERIOD + peak
        return min(self.knee.times, key=lambda t: abs(t - at))


def on_cycle(axes: plt.Axes, label: str, title: str) -> None:
    axes.axvline(STANCE, color=style.GRAY, linewidth=0.7,
                 linestyle=(0, (1, 2)))
    axes.set(xlabel="time in the cycle (s)", ylabel=label, xlim=(0, PERIOD),
             ylim=(0, None))
    axes.set_title(title)


def load(axes: plt.Axes, gait: Gait) -> None:
    """Where the run recorded them: they are prescribed."""
    axes.plot(*gait.phase(0, gait.knee.force()), color="black")
    on_cycle(axes, "force (N)", "Force and flexion")
    turned = np.degrees(gait.knee.history[f"{BODY}rotation_x"])
    beside = axes.twinx()
    beside.plot(*gait.phase(0, turned), color=style.GREEN)
    beside.set_ylabel("flexion (degrees)", color=style.GREEN)
    beside.set_ylim(0, None)
    beside.grid(False)


def cycles(axes: plt.Axes, gait: Gait, values: np.ndarray,
           color: str) -> None:
    for cycle, line in gait.shown():
        axes.plot(*gait.phase(cycle, values), color=color, **line)


def areas(axes: plt.Axes, gait: Gait) -> None:
    cycles(axes, gait, tibia.area(gait.knee), "black")
    cycles(axes, gait, tibia.area(gait.knee, ("tibia-meniscus",)),
           style.ORANGE)
    on_cycle(axes, "contact area (mm²)", "Contact area on the tibia")


def peak(axes: plt.Axes, gait: Gait) -> None:
    for side, color in zip(SIDES, (style.RED, style.BLUE)):
        cycles(axes, gait, gait.knee.history[
            f"contact.femur-tibia-{side}.peak_traction"], color)
    on_cycle(axes, "peak stress, femur on tibia (MPa)", "Peak contact stress")


def shares(axes: plt.Axes, gait: Gait) -> None:
    knee = gait.knee
    for values, color in ((tibia.fluid_share(knee), style.SKY),
                          (knee.share(knee.force(sides=("medial",))),
                           style.RED),
                          (tibia.meniscal_share(knee), style.ORANGE)):
        cycles(axes, gait, values, color)
    on_cycle(axes, "share of the force (%)", "Who bears the force")
    axes.set_ylim(0, 105)


def approach(axes: plt.Axes, gait: Gait) -> None:
    axes.plot(gait.t, -gait.knee.history[f"{BODY}translation_z"],
              color="black", linewidth=0.9)
    axes.set(xlabel="time (s)", ylabel="femur's way down (mm)",
             xlim=(0, gait.t[-1]))
    axes.set_title("Approach, all cycles")


def pressure(axes: plt.Axes, gait: Gait, peak_time: float) -> None:
    times = [gait.field_time(peak) for peak in PEAKS]
    time = gait.field_time(peak_time)
    tibia.draw_pressure(axes, gait.knee, time, tibia.largest_pressure(
        gait.knee, times, ("femur-tibia",)))
    axes.set_title(f"Contact pressure, cycle {gait.cycles}, "
                   f"{time - BEGIN - (gait.cycles - 1) * PERIOD:.2f} s",
                   pad=14)


def legend(figure: FigureBase, gait: Gait) -> None:
    handles = [Line2D([], [], color="black", label="all"),
               Line2D([], [], color=style.ORANGE, label="menisci"),
               Line2D([], [], color=style.RED, label="medial"),
               Line2D([], [], color=style.BLUE, label="lateral"),
               Line2D([], [], color=style.SKY, label="fluid")]
    if gait.cycles > 1:
        handles += [
            Line2D([], [], color=style.GRAY, label="first cycle", **FIRST),
            Line2D([], [], color=style.GRAY, label=f"cycle {gait.cycles}",
                   **LAST)]
    figure.legend(handles=handles, loc="outside lower center",
                  ncols=len(handles))


def panels_of(gait: Gait) -> dict:
    return {
        "pressure_first": lambda axes: pressure(axes, gait, PEAKS[0]),
        "pressure_second": lambda axes: pressure(axes, gait, PEAKS[1]),
        "load": lambda axes: load(axes, gait),
        "area": lambda axes: areas(axes, gait),
        "peak": lambda axes: peak(axes, gait),
        "shares": lambda axes: shares(axes, gait),
        "approach": lambda axes: approach(axes, gait)}


def findings(gait: Gait) -> str:
    knee = gait.knee
    lines = []
    for cycle, _ in gait.shown():
        for time in PEAKS:
            def at(values: np.ndarray) -> float:
                return float(np.interp(time, *gait.phase(cycle, values)))
            stress = [knee.history[f"contact.femur-tibia-{side}.peak_traction"]
                      for side in SIDES]
            lines.append(
                f"cycle {cycle + 1}, {time:g} s: {at(knee.force()):.0f} N, "
                f"medial {at(knee.share(knee.force(sides=('medial',)))):.0f} "
                f"%, by way of the menisci {at(tibia.meniscal_share(knee)):.0f}"
                f" %; {at(tibia.area(knee)):.0f} mm^2, of these "
                f"{at(tibia.area(knee, ('tibia-meniscus',))):.0f} below the "
                f"menisci; peak stress of femur on tibia "
                f"{at(np.max(stress, axis=0)):.2f} MPa, borne by the fluid "
                f"{at(tibia.fluid_share(knee)):.0f} %; down by "
                f"{-at(knee.history[BODY + 'translation_z']):.2f} mm")
    return "\n".join(lines)


def pictures(out: Output, folder: pathlib.Path) -> str:
    gait = Gait(out)
    tibia.draw_panels(panels_of(gait), folder, "knee_stance", 12.5,
                      lambda figure: legend(figure, gait),
                      ("area", "peak", "shares"))
    return findings(gait)


def main(argv: list[str] | None = None) -> int:
    return plot_script.run(argv, __doc__, "knee_stance", pictures)


if __name__ == "__main__":
    sys.exit(main())
