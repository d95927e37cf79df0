"""Hexahedra of second order as gmsh numbers their nodes."""

from __future__ import annotations

import numpy as np

QUADRANGLE_9, HEXAHEDRON_27 = 10, 12   # gmsh's types

# Where gmsh's 27 nodes are in an element, in halves of its edges: corners,
# edges, faces, centre.
NODES = np.array([
    (0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0),
    (0, 0, 2), (2, 0, 2), (2, 2, 2), (0, 2, 2),
    (1, 0, 0), (0, 1, 0), (0, 0, 1), (2, 1, 0), (2, 0, 1), (1, 2, 0),
    (2, 2, 1), (0, 2, 1), (1, 0, 2), (0, 1, 2), (2, 1, 2), (1, 2, 2),
    (1, 1, 0), (1, 0, 1), (0, 1, 1), (2, 1, 1), (1, 2, 1), (1, 1, 2),
    (1, 1, 1)])
# Corners of its faces, outward, by the direction in which they look.
FACES = {(0, 0): (0, 4, 7, 3), (0, 1): (1, 2, 6, 5), (1, 0): (0, 1, 5, 4),
         (1, 1): (3, 7, 6, 2), (2, 0): (0, 3, 2, 1), (2, 1): (4, 5, 6, 7)}


def face_nodes(corners: tuple[int, ...]) -> list[tuple[int, int, int]]:
    """The nine nodes of a face in gmsh's order, in halves of edges."""
    c = NODES[list(corners)]
    middles = [(c[i] + c[(i + 1) % 4]) // 2 for i in range(4)]
    return [tuple(p) for p in [*c, *middles, (c[0] + c[2]) // 2]]
