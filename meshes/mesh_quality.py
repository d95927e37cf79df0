"""Quality of the volume elements of the current gmsh model."""

from __future__ import annotations

from dataclasses import dataclass

import gmsh
import numpy as np

# Corners of an element and, for each, its three neighbors in right-handed
# order, so that the triple product of the edges to them is positive.
_TETRAHEDRON = [(0, 1, 2, 3), (1, 2, 0, 3), (2, 0, 1, 3), (3, 0, 2, 1)]
_HEXAHEDRON = [(0, 1, 3, 4), (1, 2, 0, 5), (2, 3, 1, 6), (3, 0, 2, 7),
               (4, 7, 5, 0), (5, 4, 6, 1), (6, 5, 7, 2), (7, 6, 4, 3)]
_PRISM = [(0, 1, 2, 3), (1, 2, 0, 4), (2, 0, 1, 5),
          (3, 5, 4, 0), (4, 3, 5, 1), (5, 4, 3, 2)]

# The determinant of three unit edges at a corner of the regular element.
_SHAPES = {"Tetrahedron": (4, _TETRAHEDRON, 1.0 / np.sqrt(2.0)),
           "Hexahedron": (8, _HEXAHEDRON, 1.0),
           "Prism": (6, _PRISM, np.sqrt(3.0) / 2.0)}


@dataclass
class Quality:
    """What a report says about a mesh."""

    elements: int
    nodes: int
    min_scaled_jacobian: float
    median_scaled_jacobian: float
    min_jacobian_ratio: float
    min_edge: float
    max_edge: float

    def __str__(self) -> str:
        return (f"{self.elements} elements, {self.nodes} nodes, "
                f"scaled Jacobian min {self.min_scaled_jacobian:.3f} "
                f"median {self.median_scaled_jacobian:.3f}, "
                f"det J min/max {self.min_jacobian_ratio:.3f}, "
                f"edges {self.min_edge:.4g} to {self.max_edge:.4g}")


def measure(volume_tags: list[int]) -> Quality:
    """Measures the elements of these volumes.

    The scaled Jacobian is that of the straight-sided element, the smallest of
    its corners, and 1 for a regular one; det J min/max is the worst element's,
    taken at the nodes, and tells of curved elements that fold.
    """
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    position = np.full(int(np.max(tags)) + 1, -1, dtype=np.int64)
    position[np.asarray(tags, dtype=np.int64)] = np.arange(len(tags))
    points = np.asarray(coordinates).reshape(-1, 3)

    scaled, ratios, edges, used = [], [], [], []
    for volume in volume_tags:
        types, _, node_tags = gmsh.model.mesh.getElements(3, volume)
        for element_type, nodes in zip(types, node_tags):
            name, _, _, per_element, local, _ = \
                gmsh.model.mesh.getElementProperties(element_type)
            shape = _SHAPES.get(name.split()[0])
            if shape is None:
                raise ValueError(f"no quality measure for '{name}'")
            corners, stencil, regular = shape
            nodes = position[np.asarray(nodes, dtype=np.int64)]
            nodes = nodes.reshape(-1, per_element)
            used.append(np.unique(nodes))
            x = points[nodes[:, :corners]]
            worst = np.full(len(x), np.inf)
            for corner, *neighbors in stencil:
                e = x[:, neighbors] - x[:, [corner]]
                length = np.linalg.norm(e, axis=2)
                edges.append(length.ravel())
                det = np.linalg.det(e) / np.prod(length, axis=1)
                worst = np.minimum(worst, det / regular)
            scaled.append(worst)
            det = gmsh.model.mesh.getJacobians(element_type, list(local),
                                               volume)[1]
            det = np.asarray(det).reshape(-1, per_element)
            ratios.append(det.min(axis=1) / np.abs(det).max(axis=1))

    scaled, edges = np.concatenate(scaled), np.concatenate(edges)
    return Quality(len(scaled), len(np.unique(np.concatenate(used))),
                   float(scaled.min()), float(np.median(scaled)),
                   float(np.concatenate(ratios).min()),
                   float(edges.min()), float(edges.max()))
