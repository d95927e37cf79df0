#!/usr/bin/env python3
"""Pictures of the knee under body weight, beside published measurements.

Reads OUT, the output directory of miniapps/cases/knee_body_weight.toml, and
draws

  pressure_loaded.png   contact pressure on the tibia and below the menisci, from
                        above, when the load is whole
  pressure_held.png     the same at the end
  area.png              contact area on the tibia against time, all of it and
                        the menisci's part
  peak.png              peak contact stress there against time; single peaks
                        that are far above all others leave the picture
  shares.png            the parts of the force that go through the menisci and
                        the medial side, and that the fluid bears, against time
  approach.png          how far the femur came down against time
  knee_body_weight.png  all of them

Areas and stresses are those on the tibia: of the cartilages that the femur
touches, and below the menisci. Units are mm, N, s, MPa.
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
import knee_run  # noqa: E402
import plot_script  # noqa: E402
import tibial_contact as tibia  # noqa: E402
from figure_style import plt  # noqa: E402
from knee_run import SIDES, Knee  # noqa: E402
from synovia_output import Output  # noqa: E402

LOADED = 1.0                # s
BODY = "rigid_body.femur."
# Fukubayashi & Kurosawa, Acta Orthop Scand 51:871-879, 1980: seven knees,
# 1000 N, extended, with menisci
MEASURED_AREA, MEASURED_PEAK = 1150.0, 3.0
MEASURED = "1000 N, Fukubayashi & Kurosawa 1980"


def pressure(axes: plt.Axes, knee: Knee, time: float) -> None:
    tibia.draw_pressure(
        axes, knee, time,
        tibia.largest_pressure(knee, [knee.time, knee.times[-1]]))
    axes.set_title(f"Contact pressure, {in_words(time)}", pad=14)


def in_words(time: float) -> str:
    return f"{time:.3g} s" if time < 60 else f"{time / 60:.3g} min"


def against_time(axes: plt.Axes, knee: Knee, label: str) -> None:
    """On a scale that shows the loading and the holding."""
    axes.axvline(LOADED, color=style.GRAY, linewidth=0.7,
                 linestyle=(0, (1, 2)))
    axes.set_xscale("log")
    if knee.history["t"][-1] < 10 * knee.history["t"][0]:
        # Powers of ten would stand upon each other.
        axes.xaxis.set_major_formatter("{x:g}")
        axes.xaxis.set_minor_formatter("{x:g}")
    axes.set(xlabel="time (s)", ylabel=label, ylim=(0, None),
             xlim=(knee.history["t"][0], knee.history["t"][-1]))


def areas(axes: plt.Axes, knee: Knee) -> None:
    t = knee.history["t"]
    axes.plot(t, tibia.area(knee), color="black", label="all")
    axes.plot(t, tibia.area(knee, ("tibia-meniscus",)), color=style.ORANGE,
              label="below the menisci")
    axes.plot(t, tibia.area(knee, ("femur-tibia",)), color=style.BLUE,
              label="femur on tibia")
    axes.axhline(MEASURED_AREA, **style.REFERENCE)
    against_time(axes, knee, "contact area (mm²)")
    axes.set_title("Contact area on the tibia")


def peak(axes: plt.Axes, knee: Knee) -> None:
    peaks = [np.max([knee.history[f"contact.{kind}-{side}.peak_traction"]
                     for side in SIDES], axis=0) for kind in tibia.ON_TIBIA]
    for values, color in zip(peaks, (style.BLUE, style.ORANGE)):
        axes.plot(knee.history["t"], values, color=color)
    axes.axhline(MEASURED_PEAK, **style.REFERENCE)
    against_time(axes, knee, "peak contact stress (MPa)")
    # The needle of a single vertex at a single time would hide all else.
    axes.set_ylim(0, 1.2 * max(MEASURED_PEAK, np.percentile(peaks, 95)))
    axes.set_title("Peak contact stress")


def shares(axes: plt.Axes, knee: Knee) -> None:
    t = knee.history["t"]
    axes.plot(t, tibia.fluid_share(knee), color=style.SKY, label="by the fluid")
    axes.plot(t, knee.share(knee.force(sides=("medial",))), color=style.RED,
              label="on the medial side")
    axes.plot(t, tibia.meniscal_share(knee), color=style.ORANGE,
              label="by way of the menisci")
    against_time(axes, knee, "share of the force (%)")
    axes.set_ylim(0, 105)
    axes.set_title("Who bears the force")
    axes.legend(loc="center left", bbox_to_anchor=(0.0, 0.62))


def approach(axes: plt.Axes, knee: Knee) -> None:
    t = knee.history["t"]
    axes.plot(t, -knee.history[f"{BODY}translation_z"], color="black")
    against_time(axes, knee, "femur's way down (mm)")
    axes.set_title("Approach")


def area_legend(figure: FigureBase) -> None:
    figure.legend(handles=[
        Line2D([], [], color="black", label="all"),
        Line2D([], [], color=style.BLUE, label="femur on tibia"),
        Line2D([], [], color=style.ORANGE, label="below the menisci"),
        Line2D([], [], label=MEASURED, **style.REFERENCE)],
        loc="outside lower center", ncols=4)


def panels_of(knee: Knee) -> dict:
    return {
        "pressure_loaded": lambda axes: pressure(axes, knee, knee.time),
        "pressure_held": lambda axes: pressure(axes, knee, knee.times[-1]),
        "area": lambda axes: areas(axes, knee),
        "peak": lambda axes: peak(axes, knee),
        "shares": lambda axes: shares(axes, knee),
        "approach": lambda axes: approach(axes, knee)}


def findings(knee: Knee) -> str:
    t = knee.history["t"]
    lines = []
    for time in sorted({LOADED, 10.0, 60.0, float(t[-1])}):
        i = int(np.argmin(np.abs(t - time)))
        medial = knee.share(knee.force(sides=("medial",)))[i]
        lines.append(
            f"t = {t[i]:.4g} s: {knee.force()[i]:.5g} N, medial {medial:.0f} "
            f"%, by way of the menisci {tibia.meniscal_share(knee)[i]:.0f} %; "
            f"{tibia.area(knee)[i]:.0f} mm^2, of these "
            f"{tibia.area(knee, ('tibia-meniscus',))[i]:.0f} below the menisci; "
            f"peak stress {tibia.peak_stress(knee)[i]:.2f} MPa, peak pressure "
            f"{knee.history['fluid.peak_pressure'][i]:.2f} MPa, borne by the "
            f"fluid {tibia.fluid_share(knee)[i]:.0f} %; down by "
            f"{-knee.history[BODY + 'translation_z'][i]:.2f} mm")
    return "\n".join(lines)


def pictures(out: Output, folder: pathlib.Path) -> str:
    knee = Knee(out, LOADED)
    tibia.draw_panels(panels_of(knee), folder, "knee_body_weight", 11.0,
                      area_legend, ("area", "peak"))
    return findings(knee)


def main(argv: list[str] | None = None) -> int:
    return plot_script.run(argv, __doc__, "knee_body_weight", pictures)


if __name__ == "__main__":
    sys.exit(main())
