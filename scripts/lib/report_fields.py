"""Pictures of the fields and the sampled lines of a run, for a report."""

from __future__ import annotations

import pathlib
from collections.abc import Callable, Iterable

import numpy as np

import section
from figure_style import plt
from report_history import AXES
from report_units import Units
from synovia_output import OutputError, Table

# Voigt's order: xx, yy, zz, ...
BODY_FIELDS = ("displacement", "fluid_pressure", "total_stress",
               "effective_stress", "attribute")
# A plane of symmetry this close, as a part of the width, is where to cut.
NEAR = 0.2
MOST_IN_LEGEND = 7


def loaded_point(grid) -> np.ndarray:
    """Where the fluid pressure, or else the effective stress, is greatest."""
    load = np.abs(grid["fluid_pressure"])
    if not load.any():
        load = np.linalg.norm(grid["effective_stress"], axis=1)
    return grid.points[np.argmax(load)]


def section_plane(grid, up: int) -> tuple[int, float]:
    """The normal and the place of the section: through the loaded point.

    Models of a half or a quarter are cut where they are cut anyway. Of the two
    planes along the axis, the one in which the bodies are wider.
    """
    x = loaded_point(grid)
    bounds = np.reshape(grid.bounds, (3, 2))
    widths = bounds[:, 1] - bounds[:, 0]
    across = [d for d in range(3) if d != up]
    normal = min(across, key=lambda d: (round(widths[d], 9), -d))
    low, high = bounds[normal]
    for side in (low, high):
        if abs(x[normal] - side) < NEAR * widths[normal]:
            return normal, side
    return normal, x[normal]


def sections_figure(grid, up: int, cut: tuple[int, float], time: float,
                    units: Units):
    """Displacement, pressure and axial stresses in the section cut."""
    normal, at = cut
    plane = [d for d in range(3) if d not in (normal, up)] + [up]
    parts = section.cut(section.bodies_of(grid), normal, at)
    a = AXES[up]
    panels = (
        (f"displacement $u_{a}$", "length",
         [part["displacement"][:, up] for part in parts]),
        ("fluid pressure $p$", "pressure",
         [part["fluid_pressure"] for part in parts]),
        (rf"total stress $\sigma_{{{a}{a}}}$", "pressure",
         [part["total_stress"][:, up] for part in parts]),
        (rf"effective stress $\sigma^E_{{{a}{a}}}$", "pressure",
         [part["effective_stress"][:, up] for part in parts]))
    points = np.vstack([part.points for part in parts])[:, plane]
    width, height = np.ptp(points, axis=0)
    # Each panel has its own axes' and color bar's labels around it.
    rows, columns = (1, 4) if height > width else (2, 2)
    panel_height = np.clip(8.8 / columns * height / width, 0.5, 5.5) + 1.25
    figure, axes = plt.subplots(rows, columns, squeeze=False,
                                figsize=(10, rows * panel_height + 0.3))
    for axis, (name, kind, values) in zip(axes.flat, panels):
        section.draw_section(axis, parts, plane, values,
                             units.label(name, kind),
                             **section.color_range(parts, values))
        axis.set(xlabel=units.label(f"${AXES[plane[0]]}$", "length"),
                 ylabel=units.label(f"${a}$", "length"))
    axes[0, 0].plot([], [], label="before", **section.BEFORE)
    axes[0, 0].plot([], [], label="after", **section.AFTER)
    figure.legend(loc="outside upper right", ncols=2)
    place = f"{at:.4g} {units.length}" if units.known else f"{at:.4g}"
    figure.suptitle(f"{units.at(time)}, section at {AXES[normal]} = {place}, "
                    "true displacement", x=0.01, ha="left", fontsize=9.5)
    return figure


def contact_figure(grid, name: str, time: float, units: Units):
    """The contact pressure on the destination, seen along its normal."""
    section.require_fields(grid, ("contact_pressure", "contact_status"), name)
    surface = grid.extract_surface().triangulate()
    triangles = section.triangles_of(surface)
    corners = surface.points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0],
                       corners[:, 2] - corners[:, 0])
    away = int(np.argmax(np.abs(normals).sum(axis=0)))
    plane = [d for d in range(3) if d != away]
    x, y = surface.points[:, plane].T
    touching = (surface["contact_status"] > 0.5)[triangles].any(axis=1)
    values = surface["contact_pressure"]
    figure, axes = plt.subplots(figsize=(4.6, 4.4))
    axes.tripcolor(x, y, triangles, np.zeros(len(triangles)), cmap="Greys",
                   vmin=-1, vmax=8, rasterized=True)
    found = "" if touching.any() else ": no contact"
    axes.set(title=f"{name}, {units.at(time)}{found}",
             aspect="equal",
             xlabel=units.label(f"${AXES[plane[0]]}$", "length"),
             ylabel=units.label(f"${AXES[plane[1]]}$", "length"))
    if not touching.any():
        return figure
    part = surface.extract_cells(touching).extract_surface()
    colors = section.color_range([part], [part["contact_pressure"]])
    colors["vmin"] = min(colors["vmin"], 0.0)
    mappable = section.draw_triangles(axes, surface.points[:, plane],
                                      triangles[touching], values, **colors)
    bounds = np.reshape(part.bounds, (3, 2))[plane]
    margin = 0.2 * np.ptp(bounds, axis=1).max()
    whole = np.reshape(surface.bounds, (3, 2))[plane]
    low = np.maximum(bounds[:, 0] - margin, whole[:, 0])
    high = np.minimum(bounds[:, 1] + margin, whole[:, 1])
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
    section.add_bar(axes, mappable, [part["contact_pressure"]], colors,
                    units.label("contact pressure", "pressure"))
    return figure


def view_figure(grid, up: int, time: float, units: Units):
    """The deformed bodies with the fluid pressure, and their initial edges."""
    surfaces = [section.merged(body).extract_surface(nonlinear_subdivision=2)
                .triangulate() for body in section.bodies_of(grid)]
    values = [surface["fluid_pressure"] for surface in surfaces]
    colors = section.color_range(surfaces, values)
    picture = render(surfaces, direction_of_view(grid, up), up, colors)
    height, width = picture.shape[:2]
    scale = min(8 / width, 5.5 / height)
    figure, axes = plt.subplots(figsize=(max(scale * width, 4),
                                         scale * height + 0.8))
    axes.imshow(picture)
    axes.set_axis_off()
    axes.set_title(f"{units.at(time)}, edges before in red")
    mappable = plt.cm.ScalarMappable(
        plt.Normalize(colors["vmin"], colors["vmax"]), colors["cmap"])
    section.add_bar(axes, mappable, values, colors,
                    units.label("fluid pressure $p$", "pressure"), shrink=0.6)
    return figure


def direction_of_view(grid, up: int) -> np.ndarray:
    """From the sides where the load is, which a symmetric model shows cut."""
    x = loaded_point(grid)
    bounds = np.reshape(grid.bounds, (3, 2))
    direction = np.where(x - bounds[:, 0] <= bounds[:, 1] - x, -1.0, 1.0)
    direction[min(d for d in range(3) if d != up)] *= 0.55
    direction[up] = 0.45
    return direction


def render(surfaces: list, direction: np.ndarray, up: int,
           colors: dict) -> np.ndarray:
    """Pixels, with the empty margins cut off."""
    import solid_view

    plotter = solid_view.pv.Plotter(off_screen=True, window_size=(1400, 1000))
    plotter.set_background("white")
    for before in surfaces:
        after = before.copy()
        after.points = before.points + before["displacement"]
        plotter.add_mesh(after, scalars="fluid_pressure",
                         cmap=colors["cmap"],
                         clim=(colors["vmin"], colors["vmax"]),
                         smooth_shading=True, split_sharp_edges=True,
                         ambient=0.45, diffuse=0.6, show_scalar_bar=False)
        edges = before.extract_feature_edges(
            feature_angle=40, boundary_edges=False, non_manifold_edges=False,
            manifold_edges=False)
        if edges.n_cells > 0:
            plotter.add_mesh(edges, color=section.BEFORE["color"],
                             line_width=2)
    plotter.view_vector(direction, viewup=np.eye(3)[up])
    plotter.enable_anti_aliasing("ssaa")
    picture = plotter.screenshot(return_img=True)
    plotter.close()
    solid_view.require_drawn(picture)
    rows, columns = np.nonzero((picture < 255).any(axis=2))
    return picture[rows.min():rows.max() + 1, columns.min():columns.max() + 1]


def picture_times(times: list[float], key: float) -> list[float]:
    """Of the saved times, the one nearest to the key time, and the last."""
    if not times:
        return []
    nearest = min(times, key=lambda t: abs(t - key))
    return sorted({nearest, times[-1]})


def line_figures(lines: dict[str, list[tuple[float, pathlib.Path]]], up: int,
                 units: Units, complain: Callable[[str], None]
                 ) -> Iterable[tuple[str, object]]:
    """Names and figures of the sampled lines, of times and files by name.

    complain(text) of damage.
    """
    a = AXES[up]
    quantities = (("p", "fluid pressure $p$", "pressure"),
                  (f"u{a}", f"displacement $u_{a}$", "length"),
                  (f"s{a}{a}", rf"total stress $\sigma_{{{a}{a}}}$",
                   "pressure"),
                  (f"es{a}{a}", rf"effective stress $\sigma^E_{{{a}{a}}}$",
                   "pressure"))
    for name, files in lines.items():
        tables = []
        for time, file in files:
            try:
                table = Table(file)
                for column in ("s", *(q[0] for q in quantities)):
                    table[column]
            except OutputError as error:
                complain(str(error))
            else:
                tables.append((time, table))
        if not tables:
            continue
        figure, axes = plt.subplots(1, 4, figsize=(11.2, 2.7))
        colors = plt.get_cmap("viridis")(np.linspace(0, 0.9, len(tables)))
        for axis, (column, label, kind) in zip(axes.flat, quantities):
            for (time, table), color in zip(tables, colors):
                axis.plot(table["s"], table[column], color=color,
                          marker="o" if table["s"].size == 1 else None)
            axis.axhline(0, color="#666666", linewidth=0.6, zorder=0)
            axis.set(xlabel=units.label("distance $s$", "length"),
                     ylabel=units.label(label, kind))
        step = max(1, -(-len(tables) // MOST_IN_LEGEND))
        shown = sorted({*range(0, len(tables), step), len(tables) - 1})
        handles = [plt.Line2D([], [], color=colors[i],
                              label=units.at(tables[i][0])) for i in shown]
        figure.legend(handles=handles, loc="outside upper right",
                      ncols=len(handles))
        yield name, figure
