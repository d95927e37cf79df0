"""Quadrangles and hexahedra of first and second order: nodes and functions.

Nodes are in gmsh's order; reference coordinates go from 0 to 1.
"""

from __future__ import annotations

import numpy as np

# gmsh's types, by order.
QUADRANGLE = {1: 3, 2: 10}
HEXAHEDRON = {1: 5, 2: 12}

_SQUARE = np.array([(0, 0), (1, 0), (1, 1), (0, 1)])
_SIDES = [(0, 1), (1, 2), (2, 3), (3, 0)]
_CUBE = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0),
                  (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)])
_EDGES = [(0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7),
          (4, 5), (4, 7), (5, 6), (6, 7)]
_FACES = [(0, 1, 2, 3), (0, 1, 4, 5), (0, 3, 4, 7), (1, 2, 5, 6),
          (2, 3, 6, 7), (4, 5, 6, 7)]


def _lattice(corners: np.ndarray, *parts: list[tuple]) -> dict[int, np.ndarray]:
    """Places of the nodes by order, in units of 1 / order."""
    middles = [2 * corners[list(part)].mean(axis=0)
               for among in parts for part in among]
    second = np.concatenate([2 * corners, middles,
                             [np.ones(corners.shape[1])]])
    return {1: corners, 2: np.rint(second).astype(int)}


QUADRANGLE_NODES = _lattice(_SQUARE, _SIDES)
HEXAHEDRON_NODES = _lattice(_CUBE, _EDGES, _FACES)


# The nodes in the order of one that is seen from the other side.
_BACK = {1: [0, 3, 2, 1], 2: [0, 3, 2, 1, 7, 6, 5, 4, 8]}


def turned_over(quads: np.ndarray) -> np.ndarray:
    """The same quadrangles (m x nodes), going round the other way."""
    return quads[:, _BACK[order_of(quads)]]


def order_of(nodes: np.ndarray) -> int:
    """Of elements with as many nodes as the array's second axis is long."""
    return 1 if nodes.shape[1] in (4, 8) else 2


def _along_line(order: int, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Lagrange's polynomials on [0, 1] and their slopes, in a last axis."""
    if order == 1:
        values, slopes = [1 - x, x], [-np.ones_like(x), np.ones_like(x)]
    else:
        values = [(1 - x) * (1 - 2 * x), 4 * x * (1 - x), x * (2 * x - 1)]
        slopes = [4 * x - 3, 4 - 8 * x, 4 * x - 1]
    return np.stack(values, axis=-1), np.stack(slopes, axis=-1)


def evaluate(nodes: np.ndarray, at: np.ndarray
             ) -> tuple[np.ndarray, np.ndarray]:
    """A point of each element, and there the derivatives.

    nodes is m x nodes x c; at is m x 2 for quadrangles, m x 3 for hexahedra.
    The results are m x c, and m x c x 2 or 3.
    """
    order, dim = order_of(nodes), at.shape[1]
    places = (QUADRANGLE_NODES if dim == 2 else HEXAHEDRON_NODES)[order]
    lines = [_along_line(order, at[:, d]) for d in range(dim)]

    def product(slope_along: int | None) -> np.ndarray:
        return np.prod([lines[d][1 if d == slope_along else 0][:, places[:, d]]
                        for d in range(dim)], axis=0)

    point = np.einsum("mk,mkc->mc", product(None), nodes)
    slopes = [np.einsum("mk,mkc->mc", product(d), nodes) for d in range(dim)]
    return point, np.stack(slopes, axis=-1)


def middle(nodes: np.ndarray) -> np.ndarray:
    """The points in the middle of quadrangles, m x c."""
    return evaluate(nodes, np.full((len(nodes), 2), 0.5))[0]
