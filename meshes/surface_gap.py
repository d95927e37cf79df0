"""How far surfaces of quadrangles are apart, along z and in all directions.

Quadrangles are m x 4 x 3 or, of second order, m x 9 x 3, see lagrange_element.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from lagrange_element import evaluate, order_of

# Where on a quadrangle gaps are measured, in its coordinates, by its order.
_GRID = {1: np.linspace(0.0, 1.0, 4), 2: np.linspace(0.0, 1.0, 5)}


def points_on(quads: np.ndarray) -> np.ndarray:
    """Some points of each quadrangle, its nodes among them."""
    grid = _GRID[order_of(quads)]
    found = [evaluate(quads, np.tile([s, t], (len(quads), 1)))[0]
             for s in grid for t in grid]
    return np.concatenate(found)


class Heights:
    """z over (x, y) on a surface, which may not overhang much."""

    def __init__(self, quads: np.ndarray):
        self.quads = quads
        centers = quads[:, :, :2].mean(axis=1)
        radius = np.linalg.norm(quads[:, :, :2] - centers[:, None], axis=2)
        self._radius = float(radius.max())
        self._tree = cKDTree(centers)

    def __call__(self, points: np.ndarray, neighbors: int = 12
                 ) -> np.ndarray:
        """z above or below the points (n x 2), NaN beside the surface.

        Of several values it is that of the quadrangle with the nearest center.
        """
        k = min(neighbors, len(self.quads))
        _, candidates = self._tree.query(
            points, k=k, distance_upper_bound=1.01 * self._radius)
        candidates = candidates.reshape(len(points), k)
        found = np.full(len(points), np.nan)
        for column in candidates.T:
            open_ = np.flatnonzero((column < len(self.quads))
                                   & np.isnan(found))
            if not len(open_):
                continue
            quads = self.quads[column[open_]]
            at, inside = _invert(quads, points[open_])
            found[open_[inside]] = evaluate(quads, at)[0][inside, 2]
        return found


def _invert(quads: np.ndarray, xy: np.ndarray
            ) -> tuple[np.ndarray, np.ndarray]:
    """Coordinates of points in quadrangles, by Newton's method."""
    quads = quads[:, :, :2]
    at = np.full((len(quads), 2), 0.5)
    for _ in range(8):
        place, slopes = evaluate(quads, at)
        (a, b), (c, d) = slopes[:, 0].T, slopes[:, 1].T
        det = a * d - b * c
        det = np.where(np.abs(det) < 1e-12, 1e-12, det)
        x, y = (place - xy).T
        at = at - np.clip(np.column_stack([d * x - b * y, a * y - c * x])
                          / det[:, None], -2, 2)
    tiny = 1e-6
    inside = ((at > -tiny) & (at < 1 + tiny)).all(axis=1) \
        & (np.linalg.norm(evaluate(quads, at)[0] - xy, axis=1) < 1e-6)
    return at, inside


def vertical_gaps(lower: np.ndarray, upper: np.ndarray) -> np.ndarray:
    """z of the upper surface less that of the lower one, wherever both are.

    Sampled on both; negative where they overlap.
    """
    on_lower, on_upper = points_on(lower), points_on(upper)
    gaps = np.concatenate([
        Heights(upper)(on_lower[:, :2]) - on_lower[:, 2],
        on_upper[:, 2] - Heights(lower)(on_upper[:, :2])])
    return gaps[np.isfinite(gaps)]


def normal_turns(quads: np.ndarray) -> np.ndarray:
    """Angles (degrees) between the normals of faces that share an edge, from
    their corners.
    """
    quads = quads[:, :4]
    normals = np.cross(quads[:, 2] - quads[:, 0], quads[:, 3] - quads[:, 1])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    flat = np.rint(quads.reshape(-1, 3) * 1e7).astype(np.int64)
    node = np.unique(flat, axis=0, return_inverse=True)[1].reshape(-1, 4)
    edges = np.sort(np.stack([node, np.roll(node, -1, axis=1)], axis=2),
                    axis=2).reshape(-1, 2)
    faces = np.repeat(np.arange(len(quads)), 4)
    order = np.lexsort(edges.T)
    edges, faces = edges[order], faces[order]
    pair = np.flatnonzero((edges[1:] == edges[:-1]).all(axis=1))
    cosine = np.einsum("ij,ij->i", normals[faces[pair]],
                       normals[faces[pair + 1]])
    return np.degrees(np.arccos(np.clip(cosine, -1, 1)))


def points_inside(points: np.ndarray, hexahedra: np.ndarray,
                  neighbors: int = 12) -> np.ndarray:
    """Which points are inside of hexahedra, m x 8 or 27 x 3."""
    centers = hexahedra.mean(axis=1)
    reach = np.linalg.norm(hexahedra - centers[:, None], axis=2).max()
    low, high = centers.min(axis=0) - reach, centers.max(axis=0) + reach
    near = np.flatnonzero(((points > low) & (points < high)).all(axis=1))
    found = np.zeros(len(points), dtype=bool)
    if not len(near):
        return found
    k = min(neighbors, len(hexahedra))
    _, candidates = cKDTree(centers).query(points[near], k=k,
                                           distance_upper_bound=reach)
    candidates = candidates.reshape(len(near), k)
    for column in candidates.T:
        known = np.flatnonzero((column < len(hexahedra)) & ~found[near])
        if len(known):
            found[near[known]] = _in_hexahedron(
                hexahedra[column[known]], points[near[known]])
    return found


def _in_hexahedron(nodes: np.ndarray, points: np.ndarray) -> np.ndarray:
    at = np.full((len(points), 3), 0.5)
    for _ in range(10):
        place, slopes = evaluate(nodes, at)
        rest = points - place
        step = np.linalg.solve(slopes + 1e-12 * np.eye(3), rest[..., None])
        at = at + np.clip(step[..., 0], -1, 1)
    tiny = 1e-6
    return (np.linalg.norm(rest, axis=1) < 1e-6) & \
        ((at > -tiny) & (at < 1 + tiny)).all(axis=1)
