"""Flat sections through deformed bodies, with their initial outlines."""

from __future__ import annotations

import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.ticker import MaxNLocator

import figure_style as style
from figure_style import plt
from synovia_output import OutputError

BEFORE = {"color": style.RED, "linewidth": 1.0}
AFTER = {"color": "black", "linewidth": 0.8}

AXES = "xyz"
MOST_SPLITS, MANY_TRIANGLES = 4, 100_000


def require_fields(grid, names: tuple[str, ...], where: object) -> None:
    """The fields must be in the grid."""
    for name in names:
        if name not in grid.array_names:
            raise OutputError(f"the fields of '{where}' lack {name}")


def bodies_of(grid) -> list:
    """The regions of a grid of elements, each a grid."""
    return [grid.extract_cells(grid["attribute"] == region)
            for region in np.unique(grid["attribute"])]


def merged(body):
    """A body without its elements' copies of shared nodes."""
    # Its elements' faces within would be taken for its surface.
    return body.clean(tolerance=1e-7 * body.length)


def cut(bodies: list, normal: int, at: float) -> list:
    """Triangles of the bodies' sections by the plane x[normal] = at.

    A plane in the boundary itself would cut nothing: it is moved inside by a
    little. Bodies that it misses are left out.
    """
    low = min(body.bounds[2 * normal] for body in bodies)
    high = max(body.bounds[2 * normal + 1] for body in bodies)
    margin = 1e-5 * (high - low)
    origin = np.zeros(3)
    origin[normal] = np.clip(at, low + margin, high - margin)
    sections = [body.slice(normal=AXES[normal], origin=origin).triangulate()
                for body in bodies]
    sections = [section for section in sections if section.n_cells > 0]
    if not sections:
        raise OutputError(f"no body meets the plane {AXES[normal]} = {at:g}")
    return sections


def triangles_of(section) -> np.ndarray:
    return section.faces.reshape(-1, 4)[:, 1:]


def draw_outlines(axes: plt.Axes, sections: list, plane: list[int]) -> None:
    """The sections' edges before and after the displacement."""
    for section in sections:
        edges = section.extract_feature_edges(
            boundary_edges=True, feature_edges=False, manifold_edges=False,
            non_manifold_edges=False)
        segments = edges.lines.reshape(-1, 3)[:, 1:]
        for points, look in (
                (edges.points, BEFORE),
                (edges.points + edges["displacement"], AFTER)):
            axes.add_collection(LineCollection(
                points[:, plane][segments], capstyle="round", **look))


def draw_section(axes: plt.Axes, sections: list, plane: list[int],
                 values: list[np.ndarray], label: str, **colors):
    """Values at the sections' points, on their deformed shapes, with a bar.

    plane: the two coordinates to draw, horizontal and vertical; colors:
    arguments of tripcolor (cmap, vmin, vmax). Gives the mappable.
    """
    mappable = draw_values(axes, sections, plane, values, **colors)
    add_bar(axes, mappable, values, colors, label)
    return mappable


def add_bar(axes: plt.Axes, mappable, values: list[np.ndarray], colors: dict,
            label: str, **look) -> None:
    """A horizontal color bar below the axes.

    Where values go beyond the colors, it has arrows, and says how far.
    """
    plt.colorbar(mappable, ax=axes, orientation="horizontal",
                 extend=extent(values, colors), aspect=40, pad=0.02,
                 ticks=MaxNLocator(5),
                 label=label + beyond_in_words(values, colors), **look)


def beyond_in_words(values: list[np.ndarray], colors: dict) -> str:
    """For the label of a color bar: the extremes that its colors leave out."""
    every = np.concatenate(values)
    ends = extent(values, colors)
    extremes = [f"{value:.3g}".replace("-", "\N{MINUS SIGN}")
                for end, value in (("min", every.min()), ("max", every.max()))
                if ends in (end, "both")]
    if not extremes:
        return ""
    return f"; beyond the arrow{'s' * (len(extremes) - 1)} to " \
        + " and ".join(extremes)


def draw_values(axes: plt.Axes, sections: list, plane: list[int],
                values: list[np.ndarray], **colors):
    """What draw_section draws, without the bar."""
    mappable = None
    for section, value in zip(sections, values):
        x = section.points + section["displacement"]
        triangles = triangles_of(section)
        mappable = draw_triangles(axes, x[:, plane],
                                  triangles[~slivers(section, triangles)],
                                  value, **colors)
    draw_outlines(axes, sections, plane)
    axes.autoscale_view()
    axes.set_aspect("equal")
    return mappable


def draw_triangles(axes: plt.Axes, points: np.ndarray, triangles: np.ndarray,
                   values: np.ndarray, **colors):
    """Values that are linear in each triangle, in the colors of the map.

    Matplotlib mixes the colors of a triangle's corners, which gives others
    than the map's between values far apart: triangles are split until they
    are many.
    """
    for _ in range(MOST_SPLITS):
        if 4 * len(triangles) > MANY_TRIANGLES:
            break
        points, triangles, values = split(points, triangles, values)
    return axes.tripcolor(points[:, 0], points[:, 1], triangles, values,
                          shading="gouraud", rasterized=True, **colors)


def split(points: np.ndarray, triangles: np.ndarray, values: np.ndarray
          ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Each triangle in four, with linear values."""
    ends = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]],
                                   triangles[:, [2, 0]]]), axis=1)
    edges, number = np.unique(ends, axis=0, return_inverse=True)
    a, b, c = triangles.T
    ab, bc, ca = np.reshape(number, (3, -1)) + len(points)
    parts = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return (np.concatenate([points, points[edges].mean(axis=1)]),
            np.concatenate([np.stack(part, axis=1) for part in parts]),
            np.concatenate([values, values[edges].mean(axis=1)]))


def extent(values: list[np.ndarray], colors: dict) -> str:
    """On which sides values go beyond the colors."""
    every = np.concatenate(values)
    # Round-off in a uniform field is not beyond them.
    tolerance = 1e-3 * (colors["vmax"] - colors["vmin"])
    low = every.min() < colors["vmin"] - tolerance
    high = every.max() > colors["vmax"] + tolerance
    return {(False, False): "neither", (True, False): "min",
            (False, True): "max", (True, True): "both"}[low, high]


def color_range(sections: list, values: list[np.ndarray],
                 beyond: float = 0.01) -> dict:
    """A map and limits for values at the sections' points.

    Values of that part of the area may go beyond them: the singularity at an
    edge doesn't determine the colors. Values of both signs get a map with
    white at zero; where one sign is no more than noise, the map is for the
    other one only.
    """
    every = np.concatenate(values)
    order = np.argsort(every)
    share = np.cumsum(np.concatenate(
        [areas_of_points(section) for section in sections])[order])
    low, high = every[order[np.searchsorted(
        share, np.array([beyond, 1 - beyond]) * share[-1])]]
    size = max(abs(low), abs(high))
    if not size > 0:
        return {"cmap": "viridis", "vmin": -1.0, "vmax": 1.0}
    if low < -0.05 * size and high > 0.05 * size:
        return {"cmap": "RdBu_r", "vmin": -size, "vmax": size}
    low, high = (0.0, high) if high > -low else (low, 0.0)
    return {"cmap": "viridis", "vmin": low, "vmax": high}


def areas_of_points(section) -> np.ndarray:
    """The area of the section that belongs to each point."""
    triangles = triangles_of(section)
    return np.bincount(triangles.ravel(),
                       np.repeat(areas(section, triangles) / 3, 3),
                       section.n_points)


def areas(section, triangles: np.ndarray) -> np.ndarray:
    a, b, c = (section.points[triangles[:, i]] for i in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def slivers(section, triangles: np.ndarray) -> np.ndarray:
    """Which triangles are of elements that the plane hardly touches.

    They would be drawn one pixel wide over their neighbors.
    """
    corners = section.points[triangles]
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1),
                             axis=2).max(axis=1)
    return 2 * areas(section, triangles) < 2e-3 * longest**2
