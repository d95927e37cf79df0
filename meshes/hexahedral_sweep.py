"""Hexahedra from a plane mesh of quadrangles and a column of nodes on each."""

from __future__ import annotations

import numpy as np

from gmsh_bodies import PRISM, Body
from lagrange_element import (
    HEXAHEDRON, HEXAHEDRON_NODES, QUADRANGLE, QUADRANGLE_NODES, turned_over)
from quad_plane import QuadMesh


def sweep(mesh: QuadMesh, columns: np.ndarray, lower: str, upper: str,
          prefix: str) -> Body:
    """A body whose surfaces are the lower and the upper one and the sides.

    The elements are of the mesh's order. columns is n x (order * layers + 1)
    x 3, from the lower side to the upper one; seen from above the mesh is
    counter-clockwise. Sides are named as the edges of the mesh, all surfaces
    after the prefix but those that bodies have in common: planes of symmetry
    and the axis of a wedge.
    """
    n, levels = columns.shape[:2]
    points = columns.transpose(1, 0, 2).reshape(-1, 3)
    order, quads = mesh.order, mesh.quads
    layers = np.arange(0, levels - 1, order)
    in_quad = {tuple(ij): k for k, ij in enumerate(QUADRANGLE_NODES[order])}
    hexahedra = np.stack(
        [quads[:, in_quad[i, j]] + (layers[:, None] + k) * n
         for i, j, k in HEXAHEDRON_NODES[order]], axis=-1)
    faces = {lower: turned_over(quads), upper: quads + (levels - 1) * n}
    for name, edges in mesh.edges.items():
        along = edges[:, [0, 2, 1][::3 - order]]
        faces[name] = np.stack(
            [along[:, i] + (layers[:, None] + k) * n
             for i, k in QUADRANGLE_NODES[order]], axis=-1)
    return Body(points, [(HEXAHEDRON[order], (hexahedra + 1).ravel())],
                {_surface(prefix, name):
                 [(QUADRANGLE[order], (these + 1).ravel())]
                 for name, these in faces.items()})


def _surface(prefix: str, side: str) -> str:
    common = side == "axis" or side.startswith("symmetry")
    return side if common else f"{prefix}_{side}"


def _elements(body: Body, parts: list, dim: int) -> np.ndarray:
    """Nodes of the quadrangles or hexahedra, m x nodes x 3."""
    kinds = QUADRANGLE if dim == 2 else HEXAHEDRON
    (kind, nodes), = [part for part in parts if part[0] in kinds.values()]
    order = 1 if kind == kinds[1] else 2
    return body.points[nodes.reshape(-1, (order + 1)**dim) - 1]


def quads_of(body: Body, surface: str) -> np.ndarray:
    """Nodes of a surface's quadrangles, m x 4 or 9 x 3, without triangles."""
    return _elements(body, body.surfaces[surface], 2)


def hexahedra_of(body: Body) -> np.ndarray:
    """Nodes of the hexahedra, m x 8 or 27 x 3."""
    return _elements(body, body.volume, 3)


def prisms_of(body: Body) -> np.ndarray:
    """Nodes of the prisms of first order, m x 6 x 3."""
    parts = [nodes for kind, nodes in body.volume if kind == PRISM]
    nodes = np.concatenate([np.empty(0, dtype=np.int64), *parts])
    return body.points[nodes.reshape(-1, 6) - 1]


_HEXAHEDRAL_CORNERS = [(0, 1, 3, 4), (1, 2, 0, 5), (2, 3, 1, 6), (3, 0, 2, 7),
                       (4, 7, 5, 0), (5, 4, 6, 1), (6, 5, 7, 2), (7, 6, 4, 3)]
_PRISMATIC_CORNERS = [(0, 1, 2, 3), (1, 2, 0, 4), (2, 0, 1, 5),
                      (3, 5, 4, 0), (4, 3, 5, 1), (5, 4, 3, 2)]


def scaled_jacobian(x: np.ndarray) -> np.ndarray:
    """The smallest of each element's corners, from them alone: 1 for a cube,
    0.87 for a prism of equal sides. x are nodes of hexahedra or prisms.
    """
    worst = np.full(len(x), np.inf)
    corners = _PRISMATIC_CORNERS if x.shape[1] == 6 else _HEXAHEDRAL_CORNERS
    for corner, *neighbors in corners:
        edges = x[:, neighbors] - x[:, [corner]]
        size = np.prod(np.linalg.norm(edges, axis=2), axis=1)
        worst = np.minimum(worst, np.linalg.det(edges) / size)
    return worst
