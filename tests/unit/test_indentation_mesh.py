#!/usr/bin/env python3
# processors: 1
"""Tests of meshes/indentation.py."""

import contextlib
import io
import math
import pathlib
import sys
import tempfile
import unittest

import gmsh
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "meshes"))
import indentation  # noqa: E402

A, R, H, TOP = 0.75, 3.0, 0.75, 1.5


def generate(*options: str) -> pathlib.Path:
    """Runs the generator; the file lives until the interpreter ends."""
    folder = tempfile.TemporaryDirectory()
    _KEEP.append(folder)
    file = pathlib.Path(folder.name) / "mesh.msh"
    with contextlib.redirect_stdout(io.StringIO()):
        status = indentation.main(["-o", str(file), *options])
    assert status == 0
    return file


_KEEP: list = []


class Mesh:
    """What a reader finds in the file: elements by name of their group."""

    def __init__(self, file: pathlib.Path):
        gmsh.initialize([""])
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.open(str(file))
        tags, x, _ = gmsh.model.mesh.getNodes()
        self.x = np.zeros((int(max(tags)) + 1, 3))
        self.x[np.asarray(tags, dtype=int)] = np.reshape(x, (-1, 3))
        self.elements: dict[str, np.ndarray] = {}
        self.measure: dict[str, float] = {}
        self.corners: dict[str, np.ndarray] = {}
        for dim, group in gmsh.model.getPhysicalGroups():
            name = gmsh.model.getPhysicalName(dim, group)
            nodes, size = [], 0.0
            for entity in gmsh.model.getEntitiesForPhysicalGroup(dim, group):
                for kind in gmsh.model.mesh.getElementTypes(dim, entity):
                    self.kind = gmsh.model.mesh.getElementProperties(kind)
                    points, weights = gmsh.model.mesh.getIntegrationPoints(
                        kind, "Gauss6")
                    det = gmsh.model.mesh.getJacobians(kind, points,
                                                       entity)[1]
                    det = np.reshape(det, (-1, len(weights)))
                    assert (det > 0).all(), f"tangled element in {name}"
                    size += float((det @ np.asarray(weights)).sum())
                    found = gmsh.model.mesh.getElementsByType(kind, entity)[1]
                    nodes.append(np.reshape(found, (-1, self.kind[3])))
            self.elements[name] = np.concatenate(nodes).astype(int)
            self.corners[name] = self.elements[name][:, :self.kind[5]]
            self.measure[name] = size
        gmsh.finalize()

    def count(self) -> int:
        return sum(len(self.elements[r]) for r in ("cartilage", "indenter"))

    def radius(self, nodes: np.ndarray) -> np.ndarray:
        return np.hypot(self.x[nodes, 0], self.x[nodes, 1])


class IndentationMesh(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.meshes = {
            "tetrahedra": Mesh(generate("--size", "2", "--order", "2")),
            "hexahedra": Mesh(generate("--hex", "--order", "2")),
            "straight 2.2": Mesh(generate("--size", "3", "--format", "2.2")),
            "binary": Mesh(generate("--size", "3", "--binary"))}

    def test_names_are_those_of_the_documentation(self):
        wanted = set(indentation.REGIONS) | set(indentation.SURFACES)
        for name, mesh in self.meshes.items():
            with self.subTest(name):
                self.assertEqual(set(mesh.elements), wanted)

    def test_measures_of_regions_and_surfaces_are_exact_when_curved(self):
        disc, side = math.pi / 4, math.pi / 2
        exact = {"cartilage": disc * R**2 * H,
                 "indenter": disc * A**2 * (TOP - H),
                 "bone": disc * R**2, "cartilage_top": disc * R**2,
                 "cartilage_side": side * R * H,
                 "indenter_bottom": disc * A**2, "indenter_top": disc * A**2,
                 "indenter_side": side * A * (TOP - H),
                 "symmetry_x": R * H + A * (TOP - H),
                 "symmetry_y": R * H + A * (TOP - H)}
        for name, mesh in self.meshes.items():
            with self.subTest(name):
                # Quadratic edges of up to 30 degrees, or straight ones.
                curved = name in ("tetrahedra", "hexahedra")
                tolerance = 2e-4 if curved else 0.06
                for group, value in exact.items():
                    self.assertLess(abs(mesh.measure[group] / value - 1),
                                    tolerance, group)

    def test_bodies_share_no_node_and_do_not_match(self):
        for name, mesh in self.meshes.items():
            with self.subTest(name):
                cartilage = np.unique(mesh.elements["cartilage"])
                indenter = np.unique(mesh.elements["indenter"])
                self.assertEqual(len(np.intersect1d(cartilage, indenter)), 0)
                top = mesh.x[np.unique(mesh.corners["cartilage_top"])]
                bottom = mesh.x[np.unique(mesh.corners["indenter_bottom"])]
                gaps = np.linalg.norm(top[:, None] - bottom[None], axis=2)
                common = int((gaps.min(axis=0) < 1e-9).sum())
                self.assertLess(common, 0.5 * len(bottom))

    def test_rim_is_a_line_of_the_cartilage_top(self):
        for name, mesh in self.meshes.items():
            with self.subTest(name):
                r = mesh.radius(mesh.corners["cartilage_top"])
                inside = (r <= A + 1e-9).all(axis=1)
                outside = (r >= A - 1e-9).all(axis=1)
                self.assertTrue((inside | outside).all())
                self.assertFalse((inside & outside).any())

    def test_elements_are_small_at_the_rim(self):
        for name, mesh in self.meshes.items():
            with self.subTest(name):
                cells = mesh.corners["cartilage"]
                x = mesh.x[cells]
                length = np.linalg.norm(x - np.roll(x, 1, axis=1), axis=2)
                at_rim = ((np.abs(mesh.radius(cells) - A) < 1e-9)
                          & (np.abs(x[:, :, 2] - H) < 1e-9)).any(axis=1)
                self.assertLess(length[at_rim].min(), 0.03 * A, name)
                self.assertGreater(length.max(), 0.25)

    def test_default_is_about_the_size_of_the_paper(self):
        count = Mesh(generate()).count()
        self.assertGreater(count, 19000)
        self.assertLess(count, 27000)

    def test_wrong_arguments_say_what_is_wrong(self):
        for options, text in (
                (["--radius", "0.5"], "smaller than --radius 0.5"),
                (["--size", "0"], "--size: 0 is not positive"),
                (["-o", "/no/such/place/a.msh"], "'/no/such/place'"),
                (["-o", "a.vtk"], "'a.vtk' does not end in .msh")):
            with self.subTest(text):
                errors = io.StringIO()
                with contextlib.redirect_stderr(errors), \
                        self.assertRaises(SystemExit) as stop:
                    indentation.main(options)
                self.assertEqual(stop.exception.code, 2)
                self.assertIn(text, errors.getvalue())


if __name__ == "__main__":
    unittest.main()
