"""Hexahedra from a plane mesh of quadrangles and a column of nodes on each."""

from __future__ import annotations

import numpy as np

from gmsh_bodies import Body
from quad_plane import QuadMesh

QUADRANGLE, HEXAHEDRON = 3, 5   # gmsh's types


def sweep(mesh: QuadMesh, columns: np.ndarray, lower: str, upper: str,
          prefix: str) -> Body:
    """A body whose surfaces are the lower and the upper one and the sides.

    columns is n x (layers + 1) x 3, from the lower side to the upper one; seen
    from above the mesh is counter-clockwise. Sides are named as the edges of
    the mesh, all surfaces after the prefix.
    """
    n, levels = columns.shape[:2]
    points = columns.transpose(1, 0, 2).reshape(-1, 3)
    quads = mesh.quads
    hexahedra = np.concatenate(
        [np.column_stack([quads + k * n, quads + (k + 1) * n])
         for k in range(levels - 1)])
    faces = {lower: quads[:, ::-1], upper: quads + (levels - 1) * n}
    for name, edges in mesh.edges.items():
        a, b = edges.T
        faces[name] = np.concatenate(
            [np.column_stack([a + k * n, b + k * n, b + (k + 1) * n,
                              a + (k + 1) * n]) for k in range(levels - 1)])
    return Body(points, [(HEXAHEDRON, (hexahedra + 1).ravel())],
                {f"{prefix}_{name}": [(QUADRANGLE, (these + 1).ravel())]
                 for name, these in faces.items()})


def quads_of(body: Body, surface: str) -> np.ndarray:
    """Corners of a surface's quadrangles, m x 4 x 3."""
    (_, nodes), = body.surfaces[surface]
    return body.points[nodes.reshape(-1, 4) - 1]


def corners_of(body: Body) -> np.ndarray:
    """Corners of the hexahedra, m x 8 x 3."""
    (_, nodes), = body.volume
    return body.points[nodes.reshape(-1, 8) - 1]


_CORNERS = np.array([(0, 1, 3, 4), (1, 2, 0, 5), (2, 3, 1, 6), (3, 0, 2, 7),
                     (4, 7, 5, 0), (5, 4, 6, 1), (6, 5, 7, 2), (7, 6, 4, 3)])


def scaled_jacobian(body: Body) -> np.ndarray:
    """The smallest of each element's corners: 1 for a cube."""
    x = corners_of(body)
    worst = np.full(len(x), np.inf)
    for corner, *neighbours in _CORNERS:
        edges = x[:, neighbours] - x[:, [corner]]
        size = np.prod(np.linalg.norm(edges, axis=2), axis=1)
        worst = np.minimum(worst, np.linalg.det(edges) / size)
    return worst
