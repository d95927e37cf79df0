#!/usr/bin/env python3
# processors: 1
"""Tests of menisci whose rounded edge is a fan of prisms."""

import collections
import pathlib
import sys
import tempfile
import unittest

import gmsh
import numpy as np

ROOT = pathlib.Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "meshes"), str(ROOT / "tests" / "support")]
import knee_from_segmentation  # noqa: E402
from hex_mesh import FACES, turned  # noqa: E402
from run_main import run_main  # noqa: E402
from synthetic_knee import synthetic_labels, write_nrrd  # noqa: E402

PRISM_FACES = [(0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)]
# gmsh's types: the number of nodes, and what a volume has for faces.
NODES = {2: 3, 3: 4, 5: 8, 6: 6}
FACES_OF = {5: FACES.tolist(), 6: PRISM_FACES}
MENISCI = ("meniscus_medial", "meniscus_lateral")


class Fan(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.image = write_nrrd(str(cls.folder / "knee.nrrd"),
                               *synthetic_labels())
        status, cls.out, err = run_main(
            knee_from_segmentation.main,
            cls.image, "--size", "2", "--inner-edge", "1", "--inner-face",
            "fan", "-o", str(cls.folder / "fan.msh"))
        assert status == 0, err
        gmsh.initialize([""])
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.open(str(cls.folder / "fan.msh"))
        tags, x, _ = gmsh.model.mesh.getNodes()
        cls.x = np.full((int(max(tags)) + 1, 3), np.nan)
        cls.x[np.asarray(tags, dtype=int)] = np.reshape(x, (-1, 3))
        cls.elements = {}
        for dim, group in gmsh.model.getPhysicalGroups():
            parts = collections.defaultdict(list)
            for entity in gmsh.model.getEntitiesForPhysicalGroup(dim, group):
                for kind, _, nodes in zip(
                        *gmsh.model.mesh.getElements(dim, entity)):
                    parts[kind] += np.reshape(
                        nodes, (-1, NODES[kind])).astype(int).tolist()
            cls.elements[gmsh.model.getPhysicalName(dim, group)] = parts
        gmsh.finalize()

    def test_menisci_have_prisms_of_positive_volume(self):
        count = 0
        for meniscus in MENISCI:
            prisms = self.x[np.array(self.elements[meniscus][6])]
            for corner, *edges in ((0, 1, 2, 3), (1, 2, 0, 4), (2, 0, 1, 5),
                                   (3, 5, 4, 0), (4, 3, 5, 1), (5, 4, 3, 2)):
                e = prisms[:, edges] - prisms[:, [corner]]
                unit = e / np.linalg.norm(e, axis=2)[..., None]
                self.assertGreater(np.linalg.det(unit).min(), 0.2)
            count += len(prisms)
        self.assertGreater(count, 100)
        self.assertIn(f"hexahedra and {count} prisms", self.out)

    def test_outer_faces_have_one_name_and_are_seen_from_outside(self):
        for meniscus in MENISCI:
            faces = [[cell[i] for i in face]
                     for kind, cells in self.elements[meniscus].items()
                     for cell in cells for face in FACES_OF[kind]]
            shared = collections.Counter(frozenset(face) for face in faces)
            self.assertEqual(max(shared.values()), 2)
            outer = {turned(face) for face in faces
                     if shared[frozenset(face)] == 1}
            named = [turned(face) for name, parts in self.elements.items()
                     if name.startswith(f"{meniscus}_")
                     for cells in parts.values() for face in cells]
            self.assertEqual(len(named), len(set(named)))
            self.assertEqual(set(named), outer)

    def test_second_order_is_refused(self):
        status, _, err = run_main(
            knee_from_segmentation.main,
            self.image, "--size", "2", "--inner-face", "fan",
            "--geometry-order", "2", "-o", str(self.folder / "no.msh"))
        self.assertEqual(status, 1)
        self.assertIn("of first order: leave --geometry-order out", err)
        self.assertFalse((self.folder / "no.msh").exists())


if __name__ == "__main__":
    unittest.main()
