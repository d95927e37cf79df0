"""Layers between two smooth surfaces z(x, y), swept from a plane mesh.

A disc, or the quarter x, y >= 0 of it, is triangulated in the plane and swept
from the lower surface to the upper one. The tetrahedra are of second order,
and all their nodes lie on the surfaces themselves, or in the same proportion
between them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Callable

import gmsh
import numpy as np

from gmsh_bodies import Body

Surface = Callable[[np.ndarray, np.ndarray], np.ndarray]

TRIANGLE6, TETRAHEDRON10 = 9, 11   # gmsh's types
_TRIANGLE_EDGES = ((0, 1), (1, 2), (2, 0))
_TETRAHEDRON_EDGES = ((0, 1), (1, 2), (2, 0), (3, 0), (2, 3), (1, 3))


@dataclass
class Disc:
    """A plane triangulation: corners, and triangles, counter-clockwise."""

    points: np.ndarray      # n x 2
    triangles: np.ndarray   # m x 3, from 0
    radius: float
    full: bool


def disc(radius: float, full: bool, size: Callable[[float], float]) -> Disc:
    """Triangles of the given size, which depends on the radius."""
    gmsh.model.add("disc")
    geo = gmsh.model.geo
    center = geo.addPoint(0, 0, 0)
    quarters = 4 if full else 1
    rim = [geo.addPoint(radius * math.cos(k * math.pi / 2),
                        radius * math.sin(k * math.pi / 2), 0)
           for k in range(4 if full else 2)]
    spokes = [geo.addLine(center, point) for point in rim]
    arcs = [geo.addCircleArc(rim[k], center, rim[(k + 1) % len(rim)])
            for k in range(quarters)]
    for k in range(quarters):
        geo.addPlaneSurface([geo.addCurveLoop(
            [spokes[k], arcs[k], -spokes[(k + 1) % len(rim)]])])
    geo.synchronize()
    for name in ("MeshSizeFromPoints", "MeshSizeFromCurvature",
                 "MeshSizeExtendFromBoundary"):
        gmsh.option.setNumber("Mesh." + name, 0)
    gmsh.model.mesh.setSizeCallback(
        lambda dim, tag, x, y, z, *old: size(math.hypot(x, y)))
    gmsh.model.mesh.generate(2)
    gmsh.model.mesh.removeSizeCallback()
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    row = np.zeros(int(max(tags)) + 1, dtype=np.int64)
    row[np.asarray(tags, dtype=np.int64)] = np.arange(len(tags))
    points = np.asarray(coordinates).reshape(-1, 3)[:, :2]
    _, nodes = gmsh.model.mesh.getElementsByType(2)
    triangles = row[np.asarray(nodes, dtype=np.int64)].reshape(-1, 3)
    gmsh.model.remove()
    used = np.unique(triangles)
    new = np.zeros(len(points), dtype=np.int64)
    new[used] = np.arange(len(used))
    points, triangles = points[used], new[triangles]
    a, b, c = (points[triangles[:, k]] for k in range(3))
    area = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    triangles[area < 0] = triangles[area < 0][:, ::-1]
    return Disc(points, triangles, radius, full)


class _Nodes:
    """Corners and middles of edges of a sweep, by (x, y, level).

    Level is 0 on the lower surface and the number of layers on the upper one.
    """

    def __init__(self, plane: Disc, layers: int):
        self.plane, self.layers = plane, layers
        n = len(plane.points)
        level = np.repeat(np.arange(layers + 1.0), n)
        self.places = [np.column_stack([np.tile(plane.points, (layers + 1, 1)),
                                        level])]
        self.count = n * (layers + 1)
        self.middles: dict[tuple[int, int], int] = {}
        r = np.hypot(*plane.points.T)
        self.on_rim = np.tile(r > plane.radius * (1 - 1e-9), layers + 1)
        self._corners = self.places[0]

    def middle(self, a: int, b: int) -> int:
        key = (min(a, b), max(a, b))
        if key not in self.middles:
            place = 0.5 * (self._corners[a] + self._corners[b])
            if self.on_rim[a] and self.on_rim[b]:
                place[:2] *= self.plane.radius / np.hypot(*place[:2])
            self.middles[key] = self.count
            self.places.append(place[None, :])
            self.count += 1
        return self.middles[key]

    def with_middles(self, corners: np.ndarray, edges: tuple) -> np.ndarray:
        return np.array([[*element, *(self.middle(element[i], element[j])
                                      for i, j in edges)]
                         for element in corners.tolist()], dtype=np.int64)


def _tetrahedra(triangles: np.ndarray, n: int, layers: int) -> np.ndarray:
    """Three to a prism; the smaller number leads, so that neighbors fit."""
    lowest = np.argmin(triangles, axis=1)
    turned = np.take_along_axis(
        triangles, (lowest[:, None] + np.arange(3)) % 3, axis=1)
    found = []
    for k in range(layers):
        a, b, c = (turned + k * n).T
        d, e, f = a + n, b + n, c + n
        first = b < c
        found.append(np.concatenate([
            np.column_stack([a, b, c, f])[first],
            np.column_stack([a, b, f, e])[first],
            np.column_stack([a, b, c, e])[~first],
            np.column_stack([a, e, c, f])[~first],
            np.column_stack([a, e, f, d])]))
    return np.concatenate(found)


def _outer_faces(tetrahedra: np.ndarray) -> np.ndarray:
    """Triangles of one tetrahedron only, seen from outside."""
    sides = np.concatenate([tetrahedra[:, list(side)] for side in
                            ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))])
    _, first, count = np.unique(np.sort(sides, axis=1), axis=0,
                                return_index=True, return_counts=True)
    return sides[first[count == 1]]


def sweep(plane: Disc, lower: Surface, upper: Surface, layers: int,
          names: dict[str, str]) -> Body:
    """Second-order tetrahedra between the surfaces.

    names maps lower, upper, rim, symmetry_x and symmetry_y (of a quarter) to
    the names of the surfaces.
    """
    n = len(plane.points)
    corners = _tetrahedra(plane.triangles, n, layers)
    nodes = _Nodes(plane, layers)
    volume = nodes.with_middles(corners, _TETRAHEDRON_EDGES)
    faces = _outer_faces(corners)
    place = nodes.places[0]
    x, y, level = (place[faces][:, :, d] for d in range(3))
    tiny = 1e-9 * plane.radius
    sides = {"lower": (level == 0).all(axis=1),
             "upper": (level == layers).all(axis=1),
             "rim": nodes.on_rim[faces].all(axis=1)}
    if not plane.full:
        sides["symmetry_x"] = (np.abs(x) < tiny).all(axis=1)
        sides["symmetry_y"] = (np.abs(y) < tiny).all(axis=1)
    # A triangle of the lower or upper surface may have its corners on the rim.
    sides["rim"] &= ~sides["lower"] & ~sides["upper"]
    surfaces = {names[side]: nodes.with_middles(faces[chosen], _TRIANGLE_EDGES)
                for side, chosen in sides.items()}
    places = np.concatenate(nodes.places)
    x, y, share = places[:, 0], places[:, 1], places[:, 2] / layers
    z = (1 - share) * lower(x, y) + share * upper(x, y)
    return Body(np.column_stack([x, y, z]),
                [(TETRAHEDRON10, (volume + 1).ravel())],
                {name: [(TRIANGLE6, (these + 1).ravel())]
                 for name, these in surfaces.items()})


def sphere(radius: float, lowest: float) -> Surface:
    """The lower half of a sphere whose lowest point is at z = lowest."""
    return lambda x, y: lowest + radius - np.sqrt(radius**2 - x**2 - y**2)


def plane_at(z: float) -> Surface:
    return lambda x, y: np.full_like(x, z)
