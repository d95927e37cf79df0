#!/usr/bin/env python3
# processors: 1
"""Tests of tibial cartilages that thin out towards their rims."""

import pathlib
import sys
import tempfile
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "meshes"), str(ROOT / "tests" / "support")]
import knee_parametric  # noqa: E402
import rim_taper  # noqa: E402
from hex_mesh import HexMesh, check_hexahedra  # noqa: E402
from run_main import run_main  # noqa: E402

SQUARE = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]])
OPTIONS = ("--size", "3", "--inner-edge", "1", "--inner-face", "round")


class Taper(unittest.TestCase):

    def test_distances_are_those_to_the_nearest_side(self):
        points = np.array([[1.0, 2.0], [2.0, 3.75], [4.0, 1.0], [7.0, 8.0]])
        np.testing.assert_allclose(rim_taper.distances(points, SQUARE),
                                   [1.0, 0.25, 0.0, 5.0], atol=1e-15)

    def test_columns_are_shortened_from_above_along_a_parabola(self):
        column = np.array([[0.0, 0.0, 1.0], [0.0, 0.0, 2.0], [1.0, 0.0, 3.0]])
        columns = np.tile(column, (4, 1, 1))
        short = rim_taper.taper(columns, np.array([0.0, 1.0, 2.0, 9.0]), 2.0)
        np.testing.assert_allclose(short[:, 0], columns[:, 0])
        np.testing.assert_allclose(short[:, 2, 2], [1.8, 2.7, 3.0, 3.0])
        np.testing.assert_allclose(short[0, 2], [0.4, 0.0, 1.8])
        np.testing.assert_allclose(short[1, 1, 2], 1.85)


class Knee(unittest.TestCase):

    def mesh(self, folder: str, name: str, *options: str) -> HexMesh:
        file = pathlib.Path(folder) / name
        status, _, err = run_main(knee_parametric.main, *OPTIONS, *options,
                                  "-o", str(file))
        self.assertEqual(status, 0, err)
        return HexMesh(file)

    def test_only_the_contact_side_near_the_rim_is_lowered(self):
        with tempfile.TemporaryDirectory() as folder:
            high = self.mesh(folder, "high.msh")
            low = self.mesh(folder, "low.msh", "--rim-taper", "2")
        check_hexahedra(self, low, 0.2)
        for side in ("medial", "lateral"):
            surfaces = {name: np.unique(low.surfaces[
                f"tibial_cartilage_{side}_{name}"])
                for name in ("bone", "contact", "rim")}
            bone, contact = surfaces["bone"], surfaces["contact"]
            np.testing.assert_array_equal(low.x[bone], high.x[bone])
            drop = (high.x - low.x)[contact]
            edge = np.isin(contact, surfaces["rim"])
            self.assertGreater(edge.sum(), 10)
            self.assertGreater(drop[edge, 2].min(), 0.5)
            rim = low.x[contact[edge]][:, None]
            away = np.linalg.norm(low.x[contact] - rim, axis=2).min(axis=0)
            self.assertGreater((away > 2.5).sum(), 20)
            self.assertLess(np.abs(drop[away > 2.5]).max(), 1e-14)

    def test_widths_that_are_none_are_refused(self):
        for width in ("-1", "nan"):
            status, _, err = run_main(knee_parametric.main, "--rim-taper",
                                      width)
            self.assertEqual(status, 2)
            self.assertIn("--rim-taper", err.splitlines()[-1])


if __name__ == "__main__":
    unittest.main()
