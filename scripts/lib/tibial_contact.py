"""What lies on the tibia of a knee: areas, stresses, shares, and maps.

That is the cartilages that the femur touches, and what is below the menisci.
Units are mm, N, MPa.
"""

from __future__ import annotations

import pathlib
from collections.abc import Callable

import numpy as np
from matplotlib.figure import FigureBase
from matplotlib.tri import Triangulation

import figure_style as style
import section
from figure_style import plt
from knee_run import SIDES, Knee

ON_TIBIA = ("femur-tibia", "tibia-meniscus")
LEVELS = 12
# What is less bears nothing that could be seen (of the largest pressure).
FAINT = 0.01
TIBIA = {"color": "#E4EDF3"}
MENISCUS = {"color": style.GRAY, "linewidth": 0.7}


def on_tibia(knee: Knee, column: str) -> np.ndarray:
    """A column of what lies on the tibia, by pair and time."""
    return np.array([knee.history[f"contact.{kind}-{side}.{column}"]
                     for kind in ON_TIBIA for side in SIDES])


def area(knee: Knee, kinds: tuple[str, ...] = ON_TIBIA) -> np.ndarray:
    return np.sum([knee.history[f"contact.{kind}-{side}.area"]
                   for kind in kinds for side in SIDES], axis=0)


def peak_stress(knee: Knee) -> np.ndarray:
    return on_tibia(knee, "peak_traction").max(axis=0)


def fluid_share(knee: Knee) -> np.ndarray:
    """Of the force on the tibia, in %."""
    forces = np.abs(on_tibia(knee, "force_z"))
    borne = forces * on_tibia(knee, "fluid_load_support")
    return 100 * borne.sum(axis=0) / np.maximum(forces.sum(axis=0), 1e-12)


def meniscal_share(knee: Knee) -> np.ndarray:
    return knee.share(knee.force(("meniscus-femur",)))


def pressure_maps(knee: Knee, time: float,
                  kinds: tuple[str, ...] = ON_TIBIA) -> dict[str, tuple]:
    """By pair: where its destination is, triangles, and contact pressure."""
    found = {}
    for kind in kinds:
        for side in SIDES:
            surface = knee.deformed_surface(f"{kind}-{side}", time)
            found[f"{kind}-{side}"] = (
                surface.points[:, :2], section.triangles_of(surface),
                surface["contact_pressure"])
    return found


def largest_pressure(knee: Knee, times: list[float],
                     kinds: tuple[str, ...] = ON_TIBIA) -> float:
    return max(float(values.max()) for time in times
               for _, _, values in pressure_maps(knee, time, kinds).values())


def draw_pressure(axes: plt.Axes, knee: Knee, time: float,
                  most: float) -> None:
    """Contact pressure at a time, in steps of color up to the most, on the
    deformed surfaces."""
    levels = np.linspace(0, most, LEVELS + 1)
    levels[0] = FAINT * most
    maps = pressure_maps(knee, time)
    beyond = any(values.max() > most * (1 + 1e-9)
                 for _, _, values in maps.values())
    for side in SIDES:
        points, triangles, _ = maps[f"femur-tibia-{side}"]
        axes.tripcolor(Triangulation(*points.T, triangles),
                       np.zeros(len(triangles)), rasterized=True,
                       cmap=style.plt.matplotlib.colors.ListedColormap(
                           [TIBIA["color"]]))
    for points, triangles, values in maps.values():
        # Folded edges have no area from above.
        filled = axes.tricontourf(
            Triangulation(*points.T, upright(points, triangles)), values,
            levels, cmap="viridis_r", extend="max" if beyond else "neither")
    for side in SIDES:
        for line in knee.outline(f"tibia-meniscus-{side}", time):
            axes.plot(line[:, 0], line[:, 1], **MENISCUS)
        x = knee.bodies[f"tibial_cartilage_{side}"].center[0]
        axes.annotate(side, (x, 1.0), xytext=(0, 2), ha="center", va="bottom",
                      xycoords=axes.get_xaxis_transform(), fontsize=8,
                      textcoords="offset points", color=style.GRAY)
    axes.set(xlabel="$x$ (mm)", ylabel="$y$ (mm), anterior up",
             aspect="equal")
    plt.colorbar(filled, ax=axes, label="contact pressure (MPa)",
                 ticks=levels[1:][1::2], format="%.2f", aspect=25, pad=0.02)


def upright(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Triangles that have an area."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    doubled = ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    return triangles[np.abs(doubled) > 1e-6 * np.abs(doubled).max()]


def draw_panels(panels: dict[str, Callable[[plt.Axes], None]],
                folder: pathlib.Path, whole: str, width: float,
                legend: Callable[[FigureBase], None],
                with_legend: tuple[str, ...]) -> None:
    """A picture of each panel, and one of all, as wide as given (inches).

    Two maps, whose names begin with "pressure", come first; the others stand
    below them with the legend, which some have of their own, too.
    """
    style.use_style()
    for name, panel in panels.items():
        figure, axes = plt.subplots(figsize=(5.0, 3.6) if is_map(name)
                                    else (3.4, 3.0))
        panel(axes)
        if name in with_legend:
            legend(figure)
        figure.savefig(folder / f"{name}.png", bbox_inches="tight")
        plt.close(figure)
    figure = plt.figure(figsize=(width, 7.0))
    maps, curves = figure.subfigures(2, 1, height_ratios=(3.9, 3.1))
    places = [*maps.subplots(1, 2), *curves.subplots(1, len(panels) - 2)]
    for i, (name, axes) in enumerate(zip(panels, places)):
        panels[name](axes)
        axes.set_title(f"({'abcdefgh'[i]}) {axes.get_title(loc='left')}",
                       pad=14 if is_map(name) else None)
    legend(curves)
    figure.savefig(folder / f"{whole}.png", dpi=200)
    plt.close(figure)


def is_map(panel: str) -> bool:
    return panel.startswith("pressure")
