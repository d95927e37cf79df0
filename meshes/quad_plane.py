"""Plane meshes of quadrangles, in blocks, for sweeps into hexahedra."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass
class QuadMesh:
    """Quadrangles, counter-clockwise, and their outer edges by name."""

    points: np.ndarray             # n x 2
    quads: np.ndarray              # m x 4, from 0
    edges: dict[str, np.ndarray]   # k x 2, the mesh to their left

    def outer(self) -> np.ndarray:
        """Which points are on the outline."""
        found = np.zeros(len(self.points), dtype=bool)
        for edges in self.edges.values():
            found[edges] = True
        return found

    def turned_over(self) -> QuadMesh:
        """The same seen from below."""
        return QuadMesh(self.points, self.quads[:, ::-1],
                        {n: e[:, ::-1] for n, e in self.edges.items()})


def resample(curve: np.ndarray, count: int) -> np.ndarray:
    """count + 1 points at equal distances along a polyline, ends kept."""
    length = np.concatenate(
        [[0], np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=1))])
    at = np.linspace(0, length[-1], count + 1)
    return np.column_stack([np.interp(at, length, x) for x in curve.T])


def patch(south: np.ndarray, north: np.ndarray, west: np.ndarray,
          east: np.ndarray) -> np.ndarray:
    """Coons' patch between four curves, (n + 1) x (m + 1) x 2.

    South and north run from west to east, west and east from south to north.
    """
    s = np.linspace(0, 1, len(south))[:, None, None]
    t = np.linspace(0, 1, len(west))[None, :, None]
    corners = ((1 - s) * (1 - t) * south[0] + s * (1 - t) * south[-1]
               + (1 - s) * t * north[0] + s * t * north[-1])
    return ((1 - t) * south[:, None] + t * north[:, None]
            + (1 - s) * west[None] + s * east[None] - corners)


def join(patches: list[np.ndarray], name) -> QuadMesh:
    """One mesh of patches that share nodes where these coincide.

    name(patch, side) is that of an outer edge on side south, east, north or
    west of a patch.
    """
    points = np.concatenate([p.reshape(-1, 2) for p in patches])
    scale = 1e-7 * np.ptp(points)
    _, first, same = np.unique(np.rint(points / scale), axis=0,
                               return_index=True, return_inverse=True)
    same = same.ravel()
    quads, sides, start = [], [], 0
    for number, p in enumerate(patches):
        n, m = p.shape[0], p.shape[1]
        node = same[start:start + n * m].reshape(n, m)
        start += n * m
        quads.append(np.stack([node[:-1, :-1], node[1:, :-1], node[1:, 1:],
                               node[:-1, 1:]], axis=-1).reshape(-1, 4))
        for side, line in (("south", node[:, 0]), ("east", node[-1]),
                           ("north", node[::-1, -1]), ("west", node[0, ::-1])):
            sides.append((number, side,
                          np.column_stack([line[:-1], line[1:]])))
    every = np.concatenate([edges for *_, edges in sides])
    keys, count = np.unique(np.sort(every, axis=1), axis=0, return_counts=True)
    single = {tuple(key) for key in keys[count == 1].tolist()}
    outer: dict[str, list] = {}
    for number, side, edges in sides:
        for a, b in edges.tolist():
            if (min(a, b), max(a, b)) in single:
                outer.setdefault(name(number, side), []).append((a, b))
    return QuadMesh(points[first], np.concatenate(quads),
                    {n: np.array(e) for n, e in outer.items()})


def _core(line: np.ndarray) -> np.ndarray:
    """Takes a square to something between a square and a disc.

    So that no angle is flat where rings go on to a circle.
    """
    u, v = np.meshgrid(line, line, indexing="ij")
    return np.stack([0.40 * u + 0.13 * u * np.sqrt(1 - v**2 / 2),
                     0.40 * v + 0.13 * v * np.sqrt(1 - u**2 / 2)], axis=-1)


def _ring(line: np.ndarray, rings: int) -> np.ndarray:
    """Rings from the unit circle in to a line, n x (rings + 1) x 2."""
    angle = np.arctan2(line[:, 1], line[:, 0])
    rim = np.column_stack([np.cos(angle), np.sin(angle)])
    share = np.linspace(1, 0, rings + 1)[None, :, None]
    return (1 - share) * line[:, None] + share * rim[:, None]


def disc(core: int, rings: int) -> QuadMesh:
    """The unit disc: core x core quadrangles, and rings around them."""
    square = _core(np.linspace(-1, 1, core + 1))
    sides = (square[:, 0], square[-1], square[::-1, -1], square[0, ::-1])
    return join([square, *(_ring(side, rings) for side in sides)],
                lambda patch, side: "rim")


def quarter_disc(core: int, rings: int) -> QuadMesh:
    """The quarter x, y >= 0 of it; edges symmetry_x (x = 0), symmetry_y, rim.
    """
    square = _core(np.linspace(0, 1, core + 1))
    names = {(0, "south"): "symmetry_y", (0, "west"): "symmetry_x",
             (1, "west"): "symmetry_y", (2, "east"): "symmetry_x"}
    return join([square, _ring(square[-1], rings),
                 _ring(square[::-1, -1], rings)],
                lambda patch, side: names.get((patch, side), "rim"))


def _worst_corner(points: np.ndarray, quads: np.ndarray) -> np.ndarray:
    """The smallest sine at a corner, of each point's quadrangles."""
    x = points[quads]
    ahead = np.roll(x, -1, axis=1) - x
    back = np.roll(x, 1, axis=1) - x
    sine = (ahead[..., 0] * back[..., 1] - ahead[..., 1] * back[..., 0]) \
        / (np.linalg.norm(ahead, axis=2) * np.linalg.norm(back, axis=2))
    worst = np.full(len(points), np.inf)
    np.minimum.at(worst, quads, sine.min(axis=1)[:, None])
    return worst


def relax(mesh: QuadMesh, rounds: int = 60) -> QuadMesh:
    """Moves inner points towards the middle of their neighbours.

    A point stays where moving would make a sharp angle sharper; beside a notch
    it would leave the mesh otherwise.
    """
    n = len(mesh.points)
    edges = np.concatenate([mesh.quads[:, [k, (k + 1) % 4]] for k in range(4)])
    edges = np.unique(np.sort(edges, axis=1), axis=0)
    a = np.concatenate([edges[:, 0], edges[:, 1]])
    b = np.concatenate([edges[:, 1], edges[:, 0]])
    degree = np.bincount(a, minlength=n)[:, None]
    free = ~mesh.outer()
    points = mesh.points.copy()
    quality = _worst_corner(points, mesh.quads)
    for _ in range(rounds):
        mean = np.column_stack([np.bincount(a, points[b, k], minlength=n)
                                for k in (0, 1)]) / degree
        trial = np.where(free[:, None], mean, points)
        # What spoils a corner goes back, with the neighbours that it met.
        for _ in range(5):
            new = _worst_corner(trial, mesh.quads)
            worse = (new < 0.8) & (new < quality - 1e-3)
            if not worse.any():
                break
            trial[worse] = points[worse]
        points, quality = trial, _worst_corner(trial, mesh.quads)
    return QuadMesh(points, mesh.quads, mesh.edges)
