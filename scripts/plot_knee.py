#!/usr/bin/env python3
"""Pictures of the knee (Guo and Spilker 2014, section 3.3).

Reads OUT, the output directory of miniapps/cases/knee.toml, and draws

  model_posterior.png   the bodies seen from behind, before and at 100 s
  model_superior.png    menisci and tibial cartilages before, from above
  meniscal_slices.png   fluid pressure and total stress sigma_zz in a frontal
                        slice through the body of each meniscus, 100 s
  tibial_surfaces.png   fluid pressure and total normal stress on the tibial
                        cartilages, from above, 100 s
  femoral_surface.png   likewise on the femoral cartilage, from below
  force.png             compressive force against time, and its parts
  contact_area.png      contact area of each pair against time
  peak_pressure.png     peak fluid pressure against time, and each pair's (or
                        its peak contact traction, in older histories)
  knee.png              all of them
  knee.gif              fluid pressure in the front half, at all saved times

Of a run that has not come to 100 s yet, the latest fields are drawn. The total
stress is the effective stress minus the fluid pressure; normal stress is
n.sigma.n with the surface's normal n. Units are mm, N, s, MPa; tension is
positive, and so is the compressive force.
"""

from __future__ import annotations

import functools
import pathlib
import sys
from collections.abc import Callable
from typing import NamedTuple

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "lib"))

import missing_module  # noqa: E402,F401

import numpy as np  # noqa: E402
from matplotlib.figure import FigureBase  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402
from matplotlib.patches import Patch  # noqa: E402
from matplotlib.ticker import MaxNLocator  # noqa: E402

import figure_style as style  # noqa: E402
import knee_film  # noqa: E402
import knee_run  # noqa: E402
import knee_views  # noqa: E402
import plot_script  # noqa: E402
import section  # noqa: E402
import solid_view  # noqa: E402
from figure_style import plt  # noqa: E402
from knee_run import LOADED, SIDES, Knee  # noqa: E402
from solid_view import Picture, View  # noqa: E402
from synovia_output import Output  # noqa: E402

WIDTH = 1600                # of a view, pixels
AROUND = 1.0                # what is shown around a meniscus' section, mm
# Of the surfaces, this part may go beyond the colors.
BEYOND = 0.002
BESIDE = 0.75               # axes to scale, for labels, inches
NOTE = 0.3                  # height of the note below the sheet, inches
TISSUES = {"femoral_cartilage": "femoral cartilage", "meniscus": "meniscus",
           "tibial_cartilage": "tibial cartilage"}
PRESSURE = "fluid pressure $p$ (MPa)"
STRESS = r"total stress $\sigma_{zz}$ (MPa)"
# Labels, and the signs of what presses
SURFACE_FIELDS = {
    "fluid_pressure": (PRESSURE, 1),
    "normal_stress": (r"total normal stress $\sigma_{nn}$ (MPa)", -1)}
NEIGHBOR = {"cmap": "Greys", "vmin": -1.0, "vmax": 8.0}
RIM = {"color": "#AAAAAA", "linewidth": 1.0}
KIND_COLORS = dict(zip(knee_run.KINDS,
                        (style.BLUE, style.ORANGE, style.GREEN)))
SIDE_STROKES = {"medial": "-", "lateral": (0, (4, 1.5))}


def horizontal(view: View) -> tuple[int, float]:
    """Which axis runs across a picture, and whether to its right or left."""
    right = view.axes()[0]
    axis = int(np.argmax(np.abs(right)))
    return axis, float(np.sign(right[axis]))


def show(axes: plt.Axes, picture: Picture, view: View) -> None:
    """A picture in coordinates."""
    left, right, bottom, top = picture.extent
    axis, sign = horizontal(view)
    axes.imshow(picture.pixels,
                extent=(sign * left, sign * right, bottom, top))
    vertical = int(np.argmax(np.abs(view.axes()[1])))
    axes.set(xlabel=f"${'xyz'[axis]}$ (mm)",
             ylabel=f"${'xyz'[vertical]}$ (mm)")


def name_sides(axes: plt.Axes, knee: Knee) -> None:
    """Over the panel, in the right order from wherever it is seen."""
    for side in SIDES:
        x = knee.bodies[f"tibial_cartilage_{side}"].center[0]
        axes.annotate(side, (x, 1.0), xytext=(0, 2), ha="center", va="bottom",
                      xycoords=axes.get_xaxis_transform(), fontsize=8,
                      textcoords="offset points", color=style.GRAY)


def tissue_legend(figure: FigureBase, tissues: list[str]) -> None:
    figure.legend(handles=[
        Patch(facecolor=knee_views.COLORS[tissue], label=TISSUES[tissue],
              edgecolor="#303030", linewidth=0.5) for tissue in tissues],
        loc="outside lower center", ncols=3)


@functools.cache
def posterior_pictures(knee: Knee) -> tuple[Picture, Picture]:
    """Before and after, of the same part of space."""
    after = {name: knee_run.deformed(body)
             for name, body in knee.bodies.items()}
    view = knee_views.POSTERIOR
    extent = view.extent([*knee.bodies.values(), *after.values()])
    return (knee_views.mesh(knee.bodies, view, WIDTH, extent),
            knee_views.mesh(after, view, WIDTH, extent))


@functools.cache
def superior_picture(knee: Knee) -> Picture:
    return knee_views.mesh(knee_views.without_femur(knee.bodies),
                           knee_views.SUPERIOR, WIDTH)


@functools.cache
def field_picture(knee: Knee, bodies: tuple[str, ...], view: View,
                  name: str) -> Picture:
    """A field on the deformed surfaces, in the very colors of its bar."""
    colors = surface_colors(knee, name)
    look = {"scalars": name, "cmap": colors["cmap"], "lighting": False,
            "clim": (colors["vmin"], colors["vmax"])}
    return solid_view.draw([(knee.surfaces[body], look) for body in bodies],
                           view, WIDTH)


def model_posterior(figure: FigureBase, knee: Knee) -> None:
    panels = figure.subplots(1, 2, sharey=True)
    for axes, picture, title in zip(panels, posterior_pictures(knee),
                                    ("before", f"{knee.time:g} s")):
        show(axes, picture, knee_views.POSTERIOR)
        axes.set_title(title, pad=14)
        name_sides(axes, knee)
    panels[1].set_ylabel("")
    tissue_legend(figure, list(TISSUES))


def model_superior(figure: FigureBase, knee: Knee) -> None:
    axes = figure.subplots()
    show(axes, superior_picture(knee), knee_views.SUPERIOR)
    name_sides(axes, knee)
    axes.set_ylabel("$y$ (mm), anterior up")
    tissue_legend(figure, ["meniscus", "tibial_cartilage"])


def meniscal_slices(figure: FigureBase, knee: Knee) -> None:
    parts = [knee.slices[side].meniscus for side in SIDES]
    panels = figure.subplots(2, 2)
    for column, (label, values, load) in zip(panels.T, (
            (PRESSURE, [part["fluid_pressure"] for part in parts], 1),
            (STRESS, [part["total_stress"][:, 2] for part in parts], -1))):
        colors = knee_run.load_colors(parts, values, load)
        for axes, side, value in zip(column, SIDES, values):
            at = knee.slices[side].at
            mappable = draw_slice(axes, knee, side, value, colors)
            axes.set_title(f"{side} meniscus, $y$ = {at:.3g} mm")
        column[1].set_xlabel("$x$ (mm)")
        figure.colorbar(mappable, ax=list(column), orientation="horizontal",
                        aspect=40, pad=0.02, label=label,
                        ticks=MaxNLocator(5),
                        extend=section.extent(values, colors))
    for axes in panels[:, 0]:
        axes.set_ylabel("$z$ (mm)")
    figure.legend(handles=[Line2D([], [], label="before", **section.BEFORE),
                           Line2D([], [], label="after", **section.AFTER)],
                  loc="outside upper right", ncols=2)


def draw_slice(axes: plt.Axes, knee: Knee, side: str, values: np.ndarray,
               colors: dict):
    """The meniscus in colors between its neighbors in gray."""
    cut = knee.slices[side]
    section.draw_values(axes, cut.others, [0, 2],
                        [np.zeros(part.n_points) for part in cut.others],
                        **NEIGHBOR)
    mappable = section.draw_values(axes, [cut.meniscus], [0, 2], [values],
                                   **colors)
    # Both sides to the same scale
    bounds = slice_bounds(knee)
    size = np.ptp(list(bounds.values()), axis=1).max(axis=0)
    middle = bounds[side].mean(axis=0)
    low, high = middle - size / 2, middle + size / 2
    axes.set_xlim(low[0], high[0], auto=True)
    axes.set_ylim(low[1], high[1], auto=True)
    # On the sheet there may be more room: show more of the neighbors.
    axes.set_aspect("equal", adjustable="datalim")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(MaxNLocator(6, integer=True))
    return mappable


def slice_bounds(knee: Knee) -> dict[str, np.ndarray]:
    """Of each side: the least and the greatest x and z that are shown."""
    bounds = {}
    for side in SIDES:
        part = knee.slices[side].meniscus
        both = np.vstack([part.points, part.points + part["displacement"]])
        both = both[:, [0, 2]]
        bounds[side] = np.stack([both.min(axis=0) - AROUND,
                                 both.max(axis=0) + AROUND])
    return bounds


def surface_colors(knee: Knee, name: str) -> dict:
    """The same for all articular surfaces."""
    surfaces = [knee.surfaces[body] for body in knee.bodies
                if not body.startswith("meniscus")]
    return knee_run.load_colors(surfaces, [s[name] for s in surfaces],
                                 SURFACE_FIELDS[name][1], BEYOND)


def surface_fields(figure: FigureBase, knee: Knee, bodies: tuple[str, ...],
                   view: View, pairs: str) -> None:
    """Pressure and normal stress on bodies, with their menisci's outlines.

    pairs: of which the destinations are the menisci's surfaces there.
    """
    panels = figure.subplots(1, 2, sharey=True)
    for axes, (name, (label, _)) in zip(panels, SURFACE_FIELDS.items()):
        show(axes, field_picture(knee, bodies, view, name), view)
        for side in SIDES:
            for line in knee.outline(f"{pairs}-{side}"):
                axes.plot(line[:, 0], line[:, 1], **RIM)
        name_sides(axes, knee)
        colors = surface_colors(knee, name)
        mappable = plt.cm.ScalarMappable(
            plt.Normalize(colors["vmin"], colors["vmax"]), colors["cmap"])
        values = [knee.surfaces[body][name] for body in bodies]
        figure.colorbar(mappable, ax=axes, orientation="horizontal",
                        aspect=40, pad=0.02, label=label,
                        ticks=MaxNLocator(5),
                        extend=section.extent(values, colors))
    panels[1].set_ylabel("")
    figure.legend(handles=[Line2D([], [], label="edge of the menisci", **RIM)],
                  loc="outside upper right")


def tibial_surfaces(figure: FigureBase, knee: Knee) -> None:
    surface_fields(figure, knee, knee_run.TIBIAE, knee_views.SUPERIOR,
                   "tibia-meniscus")


def femoral_surface(figure: FigureBase, knee: Knee) -> None:
    surface_fields(figure, knee, (knee_run.FEMUR,), knee_views.INFERIOR,
                   "meniscus-femur")


def against_time(axes: plt.Axes, knee: Knee, label: str) -> None:
    axes.axvline(LOADED, color=style.GRAY, linewidth=0.7,
                 linestyle=(0, (1, 2)))
    axes.set(xlabel="time (s)", ylabel=label,
             xlim=(0, knee.history["t"].max()), ylim=(0, None))


def curve(axes: plt.Axes, knee: Knee, values: np.ndarray, **look) -> None:
    """From rest."""
    axes.plot(np.r_[0, knee.history["t"]], np.r_[0, values], **look)


def force(figure: FigureBase, knee: Knee) -> None:
    forces, shares = figure.subplots(1, 2)
    curve(forces, knee, knee.force(), label="all", color="black")
    parts = force_parts(knee)
    for (name, part), color in zip(parts.items(), (
            style.BLUE, style.SKY, style.RED, style.ORANGE)):
        stroke = "-" if name in SIDES else (0, (4, 1.5))
        curve(forces, knee, part, label=name, color=color, linestyle=stroke)
        if name in ("medial", "menisci"):
            shares.plot(knee.history["t"], knee.share(part), color=color,
                        linestyle=stroke)
    against_time(forces, knee, "compressive force (N)")
    against_time(shares, knee, "share of the force (%)")
    shares.set_ylim(0, 105)
    figure.legend(*forces.get_legend_handles_labels(), ncols=5,
                  loc="outside lower center", columnspacing=1.2)


def force_parts(knee: Knee) -> dict[str, np.ndarray]:
    """By side, and by what the femoral cartilage touches."""
    return {"medial": knee.force(sides=("medial",)),
            "lateral": knee.force(sides=("lateral",)),
            "menisci": knee.force(("meniscus-femur",)),
            "cartilage on cartilage": knee.force(("femur-tibia",))}


def curves_of_pairs(axes: plt.Axes, knee: Knee,
                    values: dict[str, np.ndarray]) -> None:
    for kind, color in KIND_COLORS.items():
        for side, stroke in SIDE_STROKES.items():
            curve(axes, knee, values[f"{kind}-{side}"], color=color,
                  linestyle=stroke)


def pair_legend(figure: FigureBase, what: str = "", *others: Line2D) -> None:
    """Colors for what touches, strokes for the sides."""
    kinds = [Line2D([], [], color=color, label=what + kind)
             for kind, color in KIND_COLORS.items()]
    sides = [Line2D([], [], color=style.GRAY, linestyle=stroke, label=side)
             for side, stroke in SIDE_STROKES.items()]
    figure.legend(handles=[*kinds, *sides, *others],
                  loc="outside lower center", ncols=2)


def contact_area(figure: FigureBase, knee: Knee) -> None:
    axes = figure.subplots()
    curves_of_pairs(axes, knee, knee.of_pairs("area"))
    against_time(axes, knee, "contact area (mm²)")
    pair_legend(figure)


def peak_pressure(figure: FigureBase, knee: Knee) -> None:
    axes = figure.subplots()
    pressures = knee.peak_pressures()
    curves_of_pairs(axes, knee, pressures or knee.of_pairs("peak_traction"))
    curve(axes, knee, knee.history["fluid.peak_pressure"], color="black")
    against_time(axes, knee, "peak fluid pressure (MPa)" if pressures else
                 "peak pressure, traction (MPa)")
    pair_legend(figure, "" if pressures else "traction, ", Line2D(
        [], [], color="black",
        label="all bodies" if pressures else "fluid pressure"))


class Panel(NamedTuple):
    """A picture; its height is that of its axes to scale and the rest."""

    draw: Callable[[FigureBase, Knee], None]
    title: str
    width: float                # inches
    rest: float
    at_time: bool = False       # of the fields, to be said in the title
    rows: int = 0               # of axes to scale
    columns: int = 1
    shown: Callable[[Knee], tuple[float, float]] | None = None

    def height(self, knee: Knee, width: float) -> float:
        if not self.shown:
            return self.rest
        across, up = self.shown(knee)
        return self.rest + self.rows * up / across * (
            width / self.columns - BESIDE)


def size_of(picture: Picture) -> tuple[float, float]:
    left, right, bottom, top = picture.extent
    return right - left, top - bottom


def size_of_slices(knee: Knee) -> tuple[float, float]:
    width, height = np.ptp(list(slice_bounds(knee).values()),
                           axis=1).max(axis=0)
    return width, height


PANELS = {
    "model_posterior": Panel(
        model_posterior, "Seen from behind", 7.2, 1.65, False, 1, 2,
        lambda knee: size_of(posterior_pictures(knee)[0])),
    "model_superior": Panel(
        model_superior, "Seen from above, before", 4.2, 1.2, False, 1, 1,
        lambda knee: size_of(superior_picture(knee))),
    "meniscal_slices": Panel(
        meniscal_slices, "Frontal slices", 7.2, 1.9, True, 2, 2,
        size_of_slices),
    "tibial_surfaces": Panel(
        tibial_surfaces, "Tibial cartilages from above", 7.2, 1.5, True, 1, 2,
        lambda knee: size_of(field_picture(
            knee, knee_run.TIBIAE, knee_views.SUPERIOR, "fluid_pressure"))),
    "femoral_surface": Panel(
        femoral_surface, "Femoral cartilage from below", 7.2, 1.5, True, 1, 2,
        lambda knee: size_of(field_picture(
            knee, (knee_run.FEMUR,), knee_views.INFERIOR, "fluid_pressure"))),
    "force": Panel(force, "Force through the joint", 7.2, 3.2),
    "contact_area": Panel(contact_area, "Contact area", 3.7, 3.5),
    "peak_pressure": Panel(peak_pressure, "Peak pressure", 3.7, 3.5)}

# Of the sheet, by row: columns of panels below each other, and their widths
SHEET: tuple[tuple[tuple[tuple[str, ...], float], ...], ...] = (
    ((("model_posterior",), 7.5), (("model_superior",), 3.7)),
    ((("meniscal_slices",), 5.6), (("tibial_surfaces", "femoral_surface"),
                                   5.6)),
    ((("force",), 5.1), (("contact_area",), 2.8), (("peak_pressure",), 3.3)))


def draw_panel(figure: FigureBase, knee: Knee, name: str,
               letter: str = "") -> None:
    panel = PANELS[name]
    panel.draw(figure, knee)
    title = panel.title + (f", {knee.time:g} s" if panel.at_time else "")
    figure.suptitle(letter + title, x=0.01, ha="left", fontsize=10.5)


def draw(knee: Knee, folder: pathlib.Path) -> None:
    style.use_style()
    for name, panel in PANELS.items():
        figure = plt.figure(figsize=(panel.width,
                                     panel.height(knee, panel.width)))
        draw_panel(figure, knee, name)
        figure.savefig(folder / f"{name}.png")
        plt.close(figure)
    draw_sheet(knee, folder / "knee.png")
    knee_film.write(knee, folder / "knee.gif")


def strain_note(knee: Knee) -> str:
    """What the strains mean for the pictures; empty where they are small."""
    strains = knee.strains()
    if strains is None or abs(strains[0]) <= knee_run.LARGE_STRAIN:
        return ""
    if knee.finite:
        return ("Finite deformation: the largest logarithmic principal strain "
                f"is {strains[0]:.2f}, the smallest det F {strains[1]:.2f}.")
    return ("Infinitesimal strain beyond its limits: the largest principal "
            f"strain is {strains[0]:.2f}, the smallest det F {strains[1]:.2f}. "
            "Shapes, pressures and stresses of the menisci are estimates.")


def draw_sheet(knee: Knee, file: pathlib.Path) -> None:
    heights = [max(sum(PANELS[name].height(knee, width) for name in column)
                   for column, width in row) for row in SHEET]
    note = strain_note(knee)
    heights += [NOTE] if note else []
    figure = plt.figure(figsize=(sum(width for _, width in SHEET[0]),
                                 sum(heights)))
    letters = iter("abcdefgh")
    rows = figure.subfigures(len(heights), 1, height_ratios=heights)
    if note:
        rows[-1].text(0.01, 0.5, note, va="center", fontsize=9)
    for place, row in zip(rows, SHEET):
        columns = place.subfigures(1, len(row), squeeze=False,
                                   width_ratios=[width for _, width in row])
        for part, (names, width) in zip(columns[0], row):
            cells = part.subfigures(
                len(names), 1, squeeze=False,
                height_ratios=[PANELS[name].height(knee, width)
                               for name in names])
            for cell, name in zip(cells[:, 0], names):
                draw_panel(cell, knee, name, f"({next(letters)}) ")
    figure.savefig(file, dpi=200)
    plt.close(figure)


def findings(knee: Knee) -> str:
    """What the pictures show, in numbers."""
    lines = []
    if knee.stopped_early():
        lines.append(f"there are no fields at t = {knee.loaded:g} s yet: the "
                     f"pictures are of t = {knee.time:g} s, the latest")
    history = knee.history
    t = history["t"]
    parts = force_parts(knee)
    for time in sorted({knee.time, float(t[-1])}):
        i = int(np.argmin(np.abs(t - time)))
        medial, menisci = (knee.share(parts[name])[i]
                           for name in ("medial", "menisci"))
        area = sum(areas[i] for areas in knee.of_pairs("area").values())
        lines.append(f"t = {t[i]:g} s: force {knee.force()[i]:.6g} N, medial "
                     f"{medial:.1f} %, through the menisci {menisci:.1f} %; "
                     f"contact area {area:.5g} mm^2, peak pressure "
                     f"{history['fluid.peak_pressure'][i]:.5g} MPa")
    for side in SIDES:
        cut = knee.slices[side]
        p, stress = (cut.meniscus["fluid_pressure"],
                     cut.meniscus["total_stress"][:, 2])
        lines.append(f"slice of the {side} meniscus, y = {cut.at:.4g} mm: "
                     f"pressure {p.min():.4g} to {p.max():.4g} MPa, the peak "
                     f"at {100 * cut.share_of_width(p.argmax()):.0f} % of the "
                     f"width from the inner edge, sigma_zz "
                     f"{stress.min():.4g} to {stress.max():.4g} MPa")
    if strain_note(knee):
        lines.append(strain_note(knee))
    return "\n".join(lines)


def pictures(out: Output, folder: pathlib.Path) -> str:
    knee = Knee(out)
    draw(knee, folder)
    return findings(knee)


def main(argv: list[str] | None = None) -> int:
    return plot_script.run(argv, __doc__, "knee", pictures)


if __name__ == "__main__":
    sys.exit(main())
