"""The rounded inner edge of a meniscus as a fan of prisms.

In a section triangles go around a point in front of the wedge's upright end. No
corner of a triangle can fold by itself, as those of quadrangles do whose angles
open: the edge may be squeezed farther than that of meniscus_tip, which has
angles of 120 degrees where three hexahedra meet.
"""

from __future__ import annotations

import numpy as np

import meniscus_tip
from gmsh_bodies import PRISM, TRIANGLE, Body
from lagrange_element import QUADRANGLE

# Nodes of a prism's faces, seen from outside: the triangles, and the side
# across from the first edge.
BOTTOM, TOP, SIDE = [0, 2, 1], [3, 4, 5], [1, 2, 5, 4]


def add_fan(body: Body, rows: np.ndarray, order: int, prefix: str) -> Body:
    """The body with a rounded edge; see meniscus_tip.add_tip()."""
    if order != 1:
        raise ValueError("a fan of prisms is of first order: leave "
                         "--geometry-order out, or take --inner-face round")
    end = rows[:, 0]
    sections, around = len(rows), end.shape[1] - 1
    first = len(body.points)
    center = first + np.arange(sections)
    arc = np.concatenate([
        end[:, :1], first + sections
        + np.arange(sections * (around - 1)).reshape(sections, -1),
        end[:, -1:]], axis=1)
    points = np.concatenate([body.points, np.zeros((sections * around, 3))])
    points[arc] = meniscus_tip.outline(points, rows, around)
    points[center] = 0.5 * (points[end].mean(axis=1)
                            + points[arc[:, 1:-1]].mean(axis=1))

    ring = np.concatenate([arc, end[:, -2::-1]], axis=1)
    triangles = np.stack([np.repeat(center[:, None], ring.shape[1] - 1, axis=1),
                          ring[:, :-1], ring[:, 1:]], axis=-1)
    prisms = np.concatenate([triangles[:-1], triangles[1:]], axis=-1)
    x = points[prisms[0, 0]]
    if np.linalg.det(x[1:4] - x[0]) < 0:
        prisms = prisms[:, :, [0, 2, 1, 3, 5, 4]]
    surfaces = dict(body.surfaces)
    surfaces[f"{prefix}_inner"] = [
        (QUADRANGLE[1], (prisms[:, :around, SIDE] + 1).ravel())]
    for name, faces in (("horn_anterior", prisms[0][:, BOTTOM]),
                        ("horn_posterior", prisms[-1][:, TOP])):
        surfaces[f"{prefix}_{name}"] = [*surfaces[f"{prefix}_{name}"],
                                        (TRIANGLE, (faces + 1).ravel())]
    return Body(points, [*body.volume, (PRISM, (prisms + 1).ravel())], surfaces)
