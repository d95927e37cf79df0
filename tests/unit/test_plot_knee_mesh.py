#!/usr/bin/env python3
# processors: 1
"""Tests of scripts/plot_knee_mesh.py."""

import pathlib
import sys
import tempfile
import unittest

import matplotlib.image
import numpy as np

ROOT = pathlib.Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "meshes"), str(ROOT / "scripts"),
                str(ROOT / "tests" / "support")]
import boxes  # noqa: E402
import knee_parametric  # noqa: E402
import plot_knee_mesh  # noqa: E402
from run_main import run_main  # noqa: E402


class Pictures(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_three_views_with_all_tissues(self):
        mesh, picture = (str(self.folder / name)
                         for name in ("knee.msh", "knee.png"))
        run_main(knee_parametric.main, "-o", mesh, "--size", "2.5")
        status, _, err = run_main(plot_knee_mesh.main, mesh, "-o", picture)
        self.assertEqual(status, 0, err)
        pixels = matplotlib.image.imread(picture)[..., :3]
        blank = (pixels > 0.98).all(axis=2).all(axis=0)
        views = np.flatnonzero(~blank[1:] & blank[:-1])
        self.assertEqual(len(views), 3 + 1)   # tibiae lie apart from above
        red, green, blue = pixels.reshape(-1, 3).T
        for tissue in (red > blue + 0.15, blue > red + 0.1,
                       (red > 2 * green) & (red > 2 * blue)):
            self.assertGreater(tissue.mean(), 0.02)

    def test_what_is_no_knee(self):
        columns = str(self.folder / "columns.msh")
        run_main(boxes.main, "two_columns", "-o", columns)
        status, _, err = run_main(plot_knee_mesh.main, columns)
        self.assertEqual(status, 1)
        self.assertIn("meniscus", err)
        status, _, err = run_main(plot_knee_mesh.main, "none.msh")
        self.assertEqual(status, 2)
        self.assertIn("none.msh", err)


if __name__ == "__main__":
    unittest.main()
