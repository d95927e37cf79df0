"""What a reader finds in a gmsh file of hexahedra, for tests of generators."""

import pathlib
import unittest

import gmsh
import numpy as np

# Faces of a hexahedron, seen from outside.
FACES = np.array([(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5),
                  (2, 3, 7, 6), (3, 0, 4, 7)])
# Corners, each with its neighbors in right-handed order.
CORNERS = np.array([(0, 1, 3, 4), (1, 2, 0, 5), (2, 3, 1, 6), (3, 0, 2, 7),
                    (4, 7, 5, 0), (5, 4, 6, 1), (6, 5, 7, 2), (7, 6, 4, 3)])


# gmsh's elements of first and second order with their nodes, by dimension.
ELEMENTS = {2: {3: 4, 10: 9}, 3: {5: 8, 12: 27}}


class HexMesh:
    """Points (mm) by node number, hexahedra and quadrangles by name.

    Their nodes begin with the corners.
    """

    def __init__(self, file: pathlib.Path):
        gmsh.initialize([""])
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.open(str(file))
        tags, x, _ = gmsh.model.mesh.getNodes()
        self.x = np.full((int(max(tags)) + 1, 3), np.nan)
        self.x[np.asarray(tags, dtype=int)] = np.reshape(x, (-1, 3))
        self.regions: dict[str, np.ndarray] = {}
        self.surfaces: dict[str, np.ndarray] = {}
        self._volumes: dict[str, float] = {}
        for dim, group in gmsh.model.getPhysicalGroups():
            name = gmsh.model.getPhysicalName(dim, group)
            found = self.surfaces if dim == 2 else self.regions
            parts = []
            for entity in gmsh.model.getEntitiesForPhysicalGroup(dim, group):
                (kind,), _, (nodes,) = gmsh.model.mesh.getElements(dim, entity)
                parts.append(np.reshape(nodes, (-1, ELEMENTS[dim][kind])))
                if dim == 3:
                    at, weights = gmsh.model.mesh.getIntegrationPoints(
                        kind, "Gauss6")
                    _, measure, _ = gmsh.model.mesh.getJacobians(kind, at,
                                                                 entity)
                    self._volumes[name] = float(
                        (np.reshape(measure, (-1, len(weights))) @ weights)
                        .sum())
            found[name] = np.concatenate(parts).astype(int)
        gmsh.finalize()

    def count(self) -> int:
        return sum(len(cells) for cells in self.regions.values())

    def volume(self, region: str) -> float:
        return self._volumes[region]

    def scaled_jacobian(self, region: str) -> float:
        """The smallest at the corners, of elements with straight edges."""
        x = self.x[self.regions[region]]
        worst = np.inf
        for corner, *neighbors in CORNERS:
            e = x[:, neighbors] - x[:, [corner]]
            det = np.linalg.det(e / np.linalg.norm(e, axis=2)[..., None])
            worst = min(worst, float(det.min()))
        return worst


def check_hexahedra(test: unittest.TestCase, mesh: HexMesh,
                    quality: float) -> None:
    """Right-handed, apart from each other, every outer face with one name."""
    owner = np.full(len(mesh.x), -1)
    for number, (region, cells) in enumerate(mesh.regions.items()):
        test.assertGreaterEqual(mesh.scaled_jacobian(region), quality, region)
        test.assertTrue((owner[cells] == -1).all(), f"{region} shares nodes")
        owner[cells] = number
    faces = np.concatenate([cells[:, FACES].reshape(-1, 4)
                            for cells in mesh.regions.values()])
    _, first, count = np.unique(np.sort(faces, axis=1), axis=0,
                                return_index=True, return_counts=True)
    test.assertLessEqual(count.max(), 2)
    outer = {turned(face) for face in faces[first[count == 1]].tolist()}
    named = [turned(face) for quads in mesh.surfaces.values()
             for face in quads[:, :4].tolist()]
    test.assertEqual(len(named), len(set(named)), "faces with two names")
    # Turned as they are seen from outside, too.
    test.assertEqual(set(named), outer)


def turned(face: list) -> tuple:
    """The same face, beginning with its smallest node."""
    start = face.index(min(face))
    return tuple(face[start:] + face[:start])
