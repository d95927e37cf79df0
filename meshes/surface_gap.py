"""How far surfaces of quadrangles are apart, along z and in all directions."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

# Where on a quadrangle gaps are measured, in its coordinates.
_GRID = np.linspace(0.0, 1.0, 4)


def bilinear(quads: np.ndarray, s: np.ndarray, t: np.ndarray) -> np.ndarray:
    """Points of quadrangles (m x 4 x 3) at s, t (m, or broadcast to it)."""
    s, t = s[..., None], t[..., None]
    return ((1 - s) * (1 - t) * quads[:, 0] + s * (1 - t) * quads[:, 1]
            + s * t * quads[:, 2] + (1 - s) * t * quads[:, 3])


def points_on(quads: np.ndarray) -> np.ndarray:
    """Sixteen points of each quadrangle, its corners among them."""
    found = [bilinear(quads, np.full(len(quads), s), np.full(len(quads), t))
             for s in _GRID for t in _GRID]
    return np.concatenate(found)


class Heights:
    """z over (x, y) on a surface, which may not overhang much."""

    def __init__(self, quads: np.ndarray):
        self.quads = quads
        centres = quads[:, :, :2].mean(axis=1)
        radius = np.linalg.norm(quads[:, :, :2] - centres[:, None], axis=2)
        self._radius = float(radius.max())
        self._tree = cKDTree(centres)

    def __call__(self, points: np.ndarray, neighbours: int = 12
                 ) -> np.ndarray:
        """z above or below the points (n x 2), NaN beside the surface.

        Of several values it is that of the quadrangle with the nearest centre.
        """
        k = min(neighbours, len(self.quads))
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
            s, t, inside = _invert(quads, points[open_])
            z = bilinear(quads, s, t)[:, 2]
            found[open_[inside]] = z[inside]
        return found


def _invert(quads: np.ndarray, xy: np.ndarray
            ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Coordinates s, t of points in quadrangles, by Newton's method."""
    s = np.full(len(quads), 0.5)
    t = s.copy()
    for _ in range(8):
        p = bilinear(quads, s, t)[:, :2] - xy
        ds = ((1 - t)[:, None] * (quads[:, 1] - quads[:, 0])
              + t[:, None] * (quads[:, 2] - quads[:, 3]))[:, :2]
        dt = ((1 - s)[:, None] * (quads[:, 3] - quads[:, 0])
              + s[:, None] * (quads[:, 2] - quads[:, 1]))[:, :2]
        det = ds[:, 0] * dt[:, 1] - ds[:, 1] * dt[:, 0]
        det = np.where(np.abs(det) < 1e-12, 1e-12, det)
        s = s - np.clip((p[:, 0] * dt[:, 1] - p[:, 1] * dt[:, 0]) / det, -2, 2)
        t = t - np.clip((ds[:, 0] * p[:, 1] - ds[:, 1] * p[:, 0]) / det, -2, 2)
    tiny = 1e-6
    inside = ((s > -tiny) & (s < 1 + tiny) & (t > -tiny) & (t < 1 + tiny)
              & (np.linalg.norm(bilinear(quads, s, t)[:, :2] - xy, axis=1)
                 < 1e-6))
    return s, t, inside


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
    """Angles (degrees) between the normals of faces that share an edge."""
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
                  neighbours: int = 12) -> np.ndarray:
    """Which points are inside of straight-edged hexahedra (m x 8 x 3)."""
    centres = hexahedra.mean(axis=1)
    reach = np.linalg.norm(hexahedra - centres[:, None], axis=2).max()
    low, high = centres.min(axis=0) - reach, centres.max(axis=0) + reach
    near = np.flatnonzero(((points > low) & (points < high)).all(axis=1))
    found = np.zeros(len(points), dtype=bool)
    if not len(near):
        return found
    k = min(neighbours, len(hexahedra))
    _, candidates = cKDTree(centres).query(points[near], k=k,
                                           distance_upper_bound=reach)
    candidates = candidates.reshape(len(near), k)
    for column in candidates.T:
        known = np.flatnonzero((column < len(hexahedra)) & ~found[near])
        if len(known):
            found[near[known]] = _in_hexahedron(
                hexahedra[column[known]], points[near[known]])
    return found


# Corners of the reference hexahedron.
_UNIT = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0),
                  (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)], dtype=float)


def _in_hexahedron(corners: np.ndarray, points: np.ndarray) -> np.ndarray:
    xi = np.full((len(points), 3), 0.5)
    for _ in range(10):
        side = np.where(_UNIT[None] > 0, xi[:, None], 1 - xi[:, None])
        slope = np.where(_UNIT > 0, 1.0, -1.0)
        shape = side.prod(axis=2)
        gradient = np.stack([slope[:, d] * np.delete(side, d, axis=2)
                             .prod(axis=2) for d in range(3)], axis=2)
        rest = points - np.einsum("nk,nkx->nx", shape, corners)
        jacobian = np.einsum("nkd,nkx->nxd", gradient, corners)
        step = np.linalg.solve(jacobian + 1e-12 * np.eye(3), rest[..., None])
        xi = xi + np.clip(step[..., 0], -1, 1)
    tiny = 1e-6
    return (np.linalg.norm(rest, axis=1) < 1e-6) & \
        ((xi > -tiny) & (xi < 1 + tiny)).all(axis=1)
