"""Plane meshes of quadrangles, in blocks, for sweeps into hexahedra."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lagrange_element import (
    QUADRANGLE_NODES, evaluate, order_of, turned_over)


@dataclass
class QuadMesh:
    """Quadrangles, counter-clockwise, and their outer edges by name.

    Those of second order have nine nodes, their edges three: the ends, then
    the middle.
    """

    points: np.ndarray             # n x 2
    quads: np.ndarray              # m x 4 or 9, from 0
    edges: dict[str, np.ndarray]   # k x 2 or 3, the mesh to their left

    @property
    def order(self) -> int:
        return order_of(self.quads)

    def outer(self) -> np.ndarray:
        """Which points are on the outline."""
        found = np.zeros(len(self.points), dtype=bool)
        for edges in self.edges.values():
            found[edges] = True
        return found

    def turned_over(self) -> QuadMesh:
        """The same seen from below."""
        return QuadMesh(self.points, turned_over(self.quads),
                        {n: np.column_stack([e[:, 1], e[:, 0], e[:, 2:]])
                         for n, e in self.edges.items()})


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


def join(patches: list[np.ndarray], name, order: int = 1) -> QuadMesh:
    """One mesh of patches that share nodes where these coincide.

    name(patch, side) is that of an outer edge on side south, east, north or
    west of a patch. For order 2 patches have all the nodes: an odd number of
    them along each side.
    """
    points = np.concatenate([p.reshape(-1, 2) for p in patches])
    scale = 1e-7 * np.ptp(points)
    _, first, same = np.unique(np.rint(points / scale), axis=0,
                               return_index=True, return_inverse=True)
    # In the order of the patches, which round-off does not change.
    order_of_patches = np.argsort(first)
    first = first[order_of_patches]
    same = np.argsort(order_of_patches)[same.ravel()]
    quads, sides, start = [], [], 0
    for number, p in enumerate(patches):
        n, m = p.shape[0], p.shape[1]
        node = same[start:start + n * m].reshape(n, m)
        start += n * m
        quads.append(np.stack(
            [node[i:n - order + i:order, j:m - order + j:order].ravel()
             for i, j in QUADRANGLE_NODES[order]], axis=-1))
        for side, line in (("south", node[:, 0]), ("east", node[-1]),
                           ("north", node[::-1, -1]), ("west", node[0, ::-1])):
            sides.append((number, side, np.column_stack(
                [line[:-order:order], line[order::order],
                 *([line[1::2]] if order == 2 else [])])))
    every = np.concatenate([edges[:, :2] for *_, edges in sides])
    keys, count = np.unique(np.sort(every, axis=1), axis=0, return_counts=True)
    single = {tuple(key) for key in keys[count == 1].tolist()}
    outer: dict[str, list] = {}
    for number, side, edges in sides:
        for edge in edges.tolist():
            if (min(edge[:2]), max(edge[:2])) in single:
                outer.setdefault(name(number, side), []).append(edge)
    return QuadMesh(points[first], np.concatenate(quads),
                    {n: np.array(e) for n, e in outer.items()})


def _core(line: np.ndarray) -> np.ndarray:
    """Takes a square to something between a square and a disc.

    So that no angle is flat where rings go on to a circle.
    """
    u, v = np.meshgrid(line, line, indexing="ij")
    return np.stack([0.40 * u + 0.13 * u * np.sqrt(1 - v**2 / 2),
                     0.40 * v + 0.13 * v * np.sqrt(1 - u**2 / 2)], axis=-1)


def _ring(line: np.ndarray, rings: int, circles: np.ndarray) -> np.ndarray:
    """From the last circle in to the unit circle, and by rings to a line.

    n x (circles + rings + 1) x 2.
    """
    angle = np.arctan2(line[:, 1], line[:, 0])
    rim = np.column_stack([np.cos(angle), np.sin(angle)])[:, None]
    share = np.linspace(1, 0, rings + 1)[None, :, None]
    return np.concatenate([np.asarray(circles)[::-1, None] * rim,
                           (1 - share) * line[:, None] + share * rim], axis=1)


def radii_of_disc(core: int, rings: int, order: int = 1) -> np.ndarray:
    """Of the nodes of a quarter_disc that are on an axis."""
    middle = _core(np.array([0.0, 1.0]))[1, 0, 0]
    return np.concatenate([
        np.linspace(0, middle, order * core + 1),
        np.linspace(middle, 1, order * rings + 1)[1:]])


def disc(core: int, rings: int, order: int = 1, circles: np.ndarray = ()
         ) -> QuadMesh:
    """The unit disc: core x core quadrangles, and rings around them.

    Nodes go on on circles beyond it, if their radii are given.
    """
    square = _core(np.linspace(-1, 1, order * core + 1))
    sides = (square[:, 0], square[-1], square[::-1, -1], square[0, ::-1])
    return join([square, *(_ring(side, order * rings, circles)
                           for side in sides)],
                lambda patch, side: "rim", order)


def quarter_disc(core: int, rings: int, order: int = 1,
                 circles: np.ndarray = ()) -> QuadMesh:
    """The quarter x, y >= 0 of it; edges symmetry_x (x = 0), symmetry_y, rim.
    """
    square = _core(np.linspace(0, 1, order * core + 1))
    names = {(0, "south"): "symmetry_y", (0, "west"): "symmetry_x",
             (1, "west"): "symmetry_y", (2, "east"): "symmetry_x"}
    return join([square, _ring(square[-1], order * rings, circles),
                 _ring(square[::-1, -1], order * rings, circles)],
                lambda patch, side: names.get((patch, side), "rim"), order)


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
    """Moves inner points towards the middle of their neighbors.

    A point stays where moving would make a sharp angle sharper; beside a notch
    it would leave the mesh otherwise. The middles of edges and quadrangles move
    with their corners.
    """
    n = len(mesh.points)
    quads = mesh.quads[:, :4]
    edges = np.concatenate([quads[:, [k, (k + 1) % 4]] for k in range(4)])
    edges = np.unique(np.sort(edges, axis=1), axis=0)
    a = np.concatenate([edges[:, 0], edges[:, 1]])
    b = np.concatenate([edges[:, 1], edges[:, 0]])
    degree = np.maximum(np.bincount(a, minlength=n), 1)[:, None]
    free = ~mesh.outer()
    points = mesh.points.copy()
    quality = _worst_corner(points, quads)
    for _ in range(rounds):
        mean = np.column_stack([np.bincount(a, points[b, k], minlength=n)
                                for k in (0, 1)]) / degree
        trial = np.where(free[:, None], mean, points)
        # What spoils a corner goes back, with the neighbors that it met.
        for _ in range(5):
            new = _worst_corner(trial, quads)
            worse = (new < 0.8) & (new < quality - 1e-3)
            if not worse.any():
                break
            trial[worse] = points[worse]
        points, quality = trial, _worst_corner(trial, quads)
    if mesh.order == 2:
        move = (points - mesh.points)[quads]
        at = QUADRANGLE_NODES[2] / 2
        for k in range(4, 9):
            points[mesh.quads[:, k]] = mesh.points[mesh.quads[:, k]] \
                + evaluate(move, np.tile(at[k], (len(move), 1)))[0]
    return QuadMesh(points, mesh.quads, mesh.edges)
