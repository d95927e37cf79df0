#!/usr/bin/env python3
"""Pictures of the knee under body weight, beside published measurements.

Reads OUT, the output directory of miniapps/cases/knee_body_weight.toml, and
draws

  tibial_surfaces.png   fluid pressure on the tibial cartilages, from above,
                        when the load is whole and at the end
  curves.png            contact area on the tibia, peak contact traction there,
                        the menisci's share of the force and the fluid's share
                        of it, against time
  knee_body_weight.png  both

Areas and tractions are those of the tibial side: of the cartilages that the
femur touches, and below the menisci. Units are mm, N, s, MPa.
"""

from __future__ import annotations

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "lib"))

import missing_module  # noqa: E402,F401

import numpy as np  # noqa: E402
from matplotlib.figure import FigureBase  # noqa: E402

import figure_style as style  # noqa: E402
import knee_run  # noqa: E402
import knee_views  # noqa: E402
import plot_script  # noqa: E402
import section  # noqa: E402
import solid_view  # noqa: E402
from figure_style import plt  # noqa: E402
from knee_run import SIDES, Knee  # noqa: E402
from synovia_output import Output  # noqa: E402

LOADED = 1.0                # s
WIDTH = 1200                # of a view, pixels
# What lies on the tibia
ON_TIBIA = ("femur-tibia", "tibia-meniscus")
# Fukubayashi & Kurosawa, Acta Orthop Scand 51:871-879, 1980: seven knees,
# 1000 N, extended, with menisci
MEASURED_LOAD, MEASURED_AREA, MEASURED_PEAK = 1000.0, 1150.0, 3.0
MEASURED = "1000 N, Fukubayashi & Kurosawa 1980"


def area(knee: Knee) -> np.ndarray:
    return np.sum([knee.history[f"contact.{kind}-{side}.area"]
                   for kind in ON_TIBIA for side in SIDES], axis=0)


def peak_traction(knee: Knee) -> np.ndarray:
    return np.max([knee.history[f"contact.{kind}-{side}.peak_traction"]
                   for kind in ON_TIBIA for side in SIDES], axis=0)


def fluid_load_support(knee: Knee) -> np.ndarray:
    """Of all that lies on the tibia, in %."""
    forces = [np.abs(knee.history[f"contact.{kind}-{side}.force_z"])
              for kind in ON_TIBIA for side in SIDES]
    parts = [np.nan_to_num(
        knee.history[f"contact.{kind}-{side}.fluid_load_support"]) * force
        for (kind, side), force in zip(
            [(kind, side) for kind in ON_TIBIA for side in SIDES], forces)]
    return 100 * np.sum(parts, axis=0) / np.maximum(np.sum(forces, axis=0),
                                                    1e-12)


def at(knee: Knee, time: float) -> int:
    return int(np.argmin(np.abs(knee.history["t"] - time)))


def curves(figure: FigureBase, knee: Knee) -> None:
    t = knee.history["t"]
    panels = figure.subplots(1, 4)
    for axes, label, values, color in zip(panels, (
            "contact area (mm²)", "peak contact traction (MPa)",
            "share of the menisci (%)", "borne by the fluid (%)"), (
            area(knee), peak_traction(knee),
            knee.share(knee.force(("meniscus-femur",))),
            fluid_load_support(knee)),
            (style.BLUE, style.RED, style.ORANGE, style.SKY)):
        axes.semilogx(t, values, color=color)
        axes.axvline(LOADED, color=style.GRAY, linewidth=0.7,
                     linestyle=(0, (1, 2)))
        axes.set(xlabel="time (s)", ylabel=label,
                 ylim=(0, 105 if "%" in label else None))
    for axes, value in zip(panels, (MEASURED_AREA, MEASURED_PEAK)):
        line = axes.axhline(value, label=MEASURED, **style.REFERENCE)
        axes.set_ylim(0, 1.15 * max(value, axes.get_ylim()[1] / 1.1))
    figure.legend(handles=[line], loc="outside lower left")


def tibial_surfaces(figure: FigureBase, knee: Knee) -> None:
    """Of two times, in the same colors."""
    end = float(knee.times[-1])
    first = min(knee.times, key=lambda time: abs(time - LOADED))
    surfaces = [[knee_run.surface_of(knee.bodies_at(time)[body])
                 for body in knee_run.TIBIAE] for time in (first, end)]
    colors = knee_run.load_colors(
        surfaces[0] + surfaces[1],
        [surface["fluid_pressure"] for both in surfaces for surface in both],
        1, 0.002)
    look = {"scalars": "fluid_pressure", "cmap": colors["cmap"],
            "lighting": False, "clim": (colors["vmin"], colors["vmax"])}
    panels = figure.subplots(1, 2, sharey=True)
    for axes, time, both in zip(panels, (first, end), surfaces):
        picture = solid_view.draw([(surface, look) for surface in both],
                                  knee_views.SUPERIOR, WIDTH)
        axes.imshow(picture.pixels, extent=picture.extent)
        axes.set(title=f"{time:.4g} s", xlabel="$x$ (mm), lateral to the right")
    panels[0].set_ylabel("$y$ (mm), anterior up")
    figure.colorbar(
        plt.cm.ScalarMappable(plt.Normalize(colors["vmin"], colors["vmax"]),
                              colors["cmap"]),
        ax=list(panels), label="fluid pressure (MPa)",
        extend=section.extent([surface["fluid_pressure"] for both in surfaces
                               for surface in both], colors))


PANELS = {"tibial_surfaces": (tibial_surfaces, 10.0, 4.0),
          "curves": (curves, 10.0, 2.8)}


def draw(knee: Knee, folder: pathlib.Path) -> None:
    style.use_style()
    for name, (panel, width, height) in PANELS.items():
        figure = plt.figure(figsize=(width, height))
        panel(figure, knee)
        figure.savefig(folder / f"{name}.png")
        plt.close(figure)
    heights = [height for _, _, height in PANELS.values()]
    figure = plt.figure(figsize=(10.0, sum(heights)))
    for part, (panel, _, _) in zip(
            figure.subfigures(len(PANELS), 1, height_ratios=heights),
            PANELS.values()):
        panel(part, knee)
    figure.savefig(folder / "knee_body_weight.png", dpi=200)
    plt.close(figure)


def findings(knee: Knee) -> str:
    t = knee.history["t"]
    lines = []
    for time in (LOADED, 10.0, 60.0, float(t[-1])):
        i = at(knee, time)
        menisci = knee.share(knee.force(("meniscus-femur",)))[i]
        medial = knee.share(knee.force(sides=("medial",)))[i]
        lines.append(
            f"t = {t[i]:.4g} s: {knee.force()[i]:.5g} N, medial {medial:.0f} "
            f"%, by the menisci {menisci:.0f} %; {area(knee)[i]:.0f} mm^2, "
            f"peak traction {peak_traction(knee)[i]:.2f} MPa, peak pressure "
            f"{knee.history['fluid.peak_pressure'][i]:.2f} MPa, borne by the "
            f"fluid {fluid_load_support(knee)[i]:.0f} %")
    return "\n".join(lines)


def pictures(out: Output, folder: pathlib.Path) -> str:
    knee = Knee(out, LOADED)
    draw(knee, folder)
    return findings(knee)


def main(argv: list[str] | None = None) -> int:
    return plot_script.run(argv, __doc__, "knee_body_weight", pictures)


if __name__ == "__main__":
    sys.exit(main())
