"""The rounded inner edge of a meniscus, in front of a swept wedge.

In a section the wedge's upright end is the flat side of half a disc: a layer of
elements goes around it, from the lowest ones of the wedge to its uppermost
ones, and the rest is a block. So no hexahedron has its corner at the edge,
where the outline would bend within it as the edge is squeezed.
"""

from __future__ import annotations

import numpy as np

from gmsh_bodies import Body
from lagrange_element import (
    HEXAHEDRON, HEXAHEDRON_NODES, QUADRANGLE, QUADRANGLE_NODES, turned_over)

# Depth over half the thickness of the end: 1 is nearly half a circle.
DEPTH = 1.0
# Points of a curve on which lengths are measured.
FINE = 200


def add_tip(body: Body, rows: np.ndarray, order: int, prefix: str) -> Body:
    """The body with a rounded edge.

    rows are its nodes, (along + 1) x (across + 1) x (layers + 1), from 0:
    along the inner edge, away from it, and up. What was the inner face is
    inside then; that of the tip gets its name.
    """
    end = rows[:, 0]
    layers = end.shape[1] - 1
    # Elements of the block, away from the wedge; those of the layer are as many
    # as there are around it.
    depth = order * max(1, round(layers / order / 3))
    block = np.full((len(rows), depth + 1, layers + 1 - 2 * order), -1)
    count = len(body.points) + np.arange(len(rows))[:, None, None] \
        * (depth * block.shape[2])
    block[:, 0] = end[:, order:layers + 1 - order]
    block[:, 1:] = count + np.arange(depth * block.shape[2]).reshape(depth, -1)
    inside = np.concatenate([block[:, :, 0], block[:, -1, 1:-1],
                             block[:, ::-1, -1]], axis=1)
    around = inside.shape[1] - 1
    layer = np.full((len(rows), order + 1, around + 1), -1)
    layer[:, 0] = inside
    layer[:, :, 0] = end[:, order::-1]
    layer[:, :, -1] = end[:, layers - order:]
    first = block.max() + 1
    layer[:, 1:, 1:-1] = first + np.arange(
        len(rows) * order * (around - 1)).reshape(len(rows), order, -1)

    points = np.concatenate([body.points,
                             np.zeros((layer.max() + 1 - len(body.points), 3))])
    points[layer[:, -1]] = outline(points, rows, around)
    _fill(points, [block, layer], len(body.points), layer[:, -1].ravel())
    kind, wedge = body.volume[0]
    tip = np.concatenate([_hexahedra(nodes, order, points)
                          for nodes in (block, layer)])
    surfaces = dict(body.surfaces)
    surfaces[f"{prefix}_inner"] = [(QUADRANGLE[order], _outward(
        _quadrangles(layer[:, -1], order), points, tip))]
    for number, name in ((0, "horn_anterior"), (-1, "horn_posterior")):
        quads = _outward(np.concatenate(
            [_quadrangles(nodes[number], order) for nodes in (block, layer)]),
            points, tip)
        (_, horn), = surfaces[f"{prefix}_{name}"]
        surfaces[f"{prefix}_{name}"] = [
            (QUADRANGLE[order], np.concatenate([horn, quads]))]
    return Body(points, [(kind, np.concatenate([wedge, (tip + 1).ravel()]))],
                surfaces)


def outline(points: np.ndarray, rows: np.ndarray, around: int) -> np.ndarray:
    """Points of curves that leave the lower and the upper surface smoothly, a
    row a section, around pieces each.
    """
    low, high = points[rows[:, 0, 0]], points[rows[:, 0, -1]]
    leaving = []
    for side in (0, -1):
        along = points[rows[:, 0, side]] - points[rows[:, 1, side]]
        leaving.append(along / np.linalg.norm(along, axis=1)[:, None])
    reach = DEPTH * 2 / 3 * np.linalg.norm(high - low, axis=1)[:, None]
    t = np.linspace(0, 1, FINE + 1)[:, None, None]
    curve = (1 - t)**3 * low + 3 * (1 - t)**2 * t * (low + reach * leaving[0]) \
        + 3 * (1 - t) * t**2 * (high + reach * leaving[1]) + t**3 * high
    found = np.empty((len(rows), around + 1, 3))
    for line, places in zip(curve.transpose(1, 0, 2), found):
        length = np.concatenate([[0], np.cumsum(
            np.linalg.norm(np.diff(line, axis=0), axis=1))])
        at = np.linspace(0, length[-1], around + 1)
        places[:] = np.column_stack([np.interp(at, length, x) for x in line.T])
    return found


def _fill(points: np.ndarray, parts: list[np.ndarray], first: int,
          edge: np.ndarray) -> None:
    """Each new node within an outline goes to the middle of its neighbors."""
    section = [part[0] for part in parts]
    links = np.concatenate([np.stack([a.ravel(), b.ravel()], axis=1)
                            for part in section
                            for a, b in ((part[1:], part[:-1]),
                                         (part[:, 1:], part[:, :-1]))])
    links = np.unique(np.sort(links, axis=1), axis=0)
    nodes, numbers = np.unique(links, return_inverse=True)
    numbers = numbers.reshape(-1, 2)
    # Of all sections alike
    every = np.empty((len(parts[0]), len(nodes)), dtype=np.int64)
    for part in parts:
        every[:, np.searchsorted(nodes, part[0])] = part
    laplacian = np.zeros((len(nodes), len(nodes)))
    np.add.at(laplacian, (numbers[:, 0], numbers[:, 1]), -1.0)
    np.add.at(laplacian, (numbers[:, 1], numbers[:, 0]), -1.0)
    laplacian -= np.diag(laplacian.sum(axis=1))
    free = (nodes >= first) & ~np.isin(nodes, edge)
    known = points[every[:, ~free]]
    points[every[:, free]] = np.linalg.solve(
        laplacian[np.ix_(free, free)],
        -laplacian[np.ix_(free, ~free)] @ known)


def _hexahedra(nodes: np.ndarray, order: int, points: np.ndarray
               ) -> np.ndarray:
    n, m, k = (size - order for size in nodes.shape)
    found = np.stack([nodes[a:n + a:order, b:m + b:order, c:k + c:order].ravel()
                      for a, b, c in HEXAHEDRON_NODES[order]], axis=-1)
    x = points[found[0]]
    if np.linalg.det(x[[1, 3, 4]] - x[0]) > 0:
        return found
    return np.stack([nodes[a:n + a:order, b:m + b:order, c:k + c:order].ravel()
                     for b, a, c in HEXAHEDRON_NODES[order]], axis=-1)


def _quadrangles(nodes: np.ndarray, order: int) -> np.ndarray:
    n, m = (size - order for size in nodes.shape)
    return np.stack([nodes[a:n + a:order, b:m + b:order].ravel()
                     for a, b in QUADRANGLE_NODES[order]], axis=-1)


def _outward(quads: np.ndarray, points: np.ndarray, hexahedra: np.ndarray
             ) -> np.ndarray:
    """From 1, and turned over if the hexahedron behind is in front of them."""
    behind = hexahedra[np.isin(hexahedra[:, :8], quads[0, :4]).sum(axis=1) == 4]
    x = points[quads[0, :4]]
    normal = np.cross(x[2] - x[0], x[3] - x[1])
    inwards = points[behind[0, :8]].mean(axis=0) - x.mean(axis=0)
    if normal @ inwards > 0:
        quads = turned_over(quads)
    return (quads + 1).ravel()
