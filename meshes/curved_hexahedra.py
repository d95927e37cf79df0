"""Hexahedra of second order between two smooth surfaces z(x, y).

A plane mesh of a disc, or of the quarter x, y >= 0 of it, is swept from the
lower surface to the upper one. All nodes lie on the surfaces themselves, or in
the same proportion between them.
"""

from __future__ import annotations

import numpy as np

import quad_plane
from curved_layer import Surface
from gmsh_bodies import Body
from hexahedron27 import (
    FACES, HEXAHEDRON_27, NODES, QUADRANGLE_9, face_nodes)
from quad_plane import QuadMesh

# Which of a quadrangle's nodes is where, in halves of its edges: corners,
# edges, centre.
_PLACES = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1),
           (1, 1)]


def disc(radius: float, full: bool, core: int, rings: int) -> QuadMesh:
    """A square of core x core quadrangles in each quarter, in rings of them."""
    mesh = (quad_plane.disc(2 * core, rings) if full else
            quad_plane.quarter_disc(core, rings))
    return QuadMesh(radius * mesh.points, mesh.quads, mesh.edges)


class _Plane:
    """Nodes of second order: edges of the rim are arcs, all others straight.
    """

    def __init__(self, mesh: QuadMesh):
        ends = np.stack([mesh.quads, np.roll(mesh.quads, -1, axis=1)], axis=2)
        edges, which = np.unique(np.sort(ends.reshape(-1, 2), axis=1), axis=0,
                                 return_inverse=True)
        corners = len(mesh.points)
        self._number = {tuple(edge): corners + k
                        for k, edge in enumerate(edges.tolist())}
        middles = mesh.points[edges].mean(axis=1)
        rim = np.array([self.middle(a, b) - corners
                        for a, b in mesh.edges["rim"]])
        radius = np.linalg.norm(mesh.points[mesh.edges["rim"][0, 0]])
        middles[rim] *= radius / np.linalg.norm(middles[rim], axis=1,
                                                keepdims=True)
        around = which.reshape(-1, 4)
        centres = 0.5 * middles[around].sum(axis=1) \
            - 0.25 * mesh.points[mesh.quads].sum(axis=1)
        self.points = np.concatenate([mesh.points, middles, centres])
        first_centre = corners + len(edges)
        self.quads = np.column_stack(
            [mesh.quads, corners + around,
             first_centre + np.arange(len(mesh.quads))])

    def middle(self, a: int, b: int) -> int:
        return self._number[min(a, b), max(a, b)]


def sweep(mesh: QuadMesh, lower: Surface, upper: Surface, layers: int,
          names: dict[str, str]) -> Body:
    """Second-order hexahedra between the surfaces.

    names maps lower, upper, and the edges of the mesh, rim among them, to the
    names of the surfaces.
    """
    plane = _Plane(mesh)
    n = len(plane.points)

    def nodes(places, layer: int) -> np.ndarray:
        """Of all elements of a layer, at these places in halves of edges."""
        return np.column_stack(
            [plane.quads[:, _PLACES.index((i, j))] + (2 * layer + k) * n
             for i, j, k in places])

    volume = np.concatenate([nodes(NODES.tolist(), layer)
                             for layer in range(layers)])
    faces = {"lower": nodes(face_nodes(FACES[2, 0]), 0),
             "upper": nodes(face_nodes(FACES[2, 1]), layers - 1)}
    for name, edges in mesh.edges.items():
        a, b = edges.T
        m = np.array([plane.middle(*edge) for edge in edges.tolist()])
        side = [(a, 0), (b, 0), (b, 2), (a, 2), (m, 0), (b, 1), (m, 2), (a, 1),
                (m, 1)]
        faces[name] = np.concatenate(
            [np.column_stack([node + (2 * layer + k) * n for node, k in side])
             for layer in range(layers)])
    x, y = np.tile(plane.points, (2 * layers + 1, 1)).T
    share = np.repeat(np.linspace(0, 1, 2 * layers + 1), n)
    z = (1 - share) * lower(x, y) + share * upper(x, y)
    return Body(np.column_stack([x, y, z]),
                [(HEXAHEDRON_27, (volume + 1).ravel())],
                {names[name]: [(QUADRANGLE_9, (these + 1).ravel())]
                 for name, these in faces.items()})
