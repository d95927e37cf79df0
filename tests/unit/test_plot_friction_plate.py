#!/usr/bin/env python3
# processors: 1
"""Tests of scripts/plot_friction_plate.py, on an output made from references."""

import pathlib
import sys
import tempfile
import unittest

import matplotlib.image
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "tests/support")]
sys.dont_write_bytecode = True
import plot_friction_plate  # noqa: E402
from run_main import run_main  # noqa: E402
from synovia_output import reference  # noqa: E402
from synthetic_output import write_csv  # noqa: E402

CASE = ('[[contact]]\nname = "plate"\n'
        "friction = {coefficient = 0.2, solid_fraction = 0.1}\n")


class PlotFrictionPlate(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = pathlib.Path(folder.name) / "out"

    def write(self, factor: float, case: str = CASE) -> None:
        exact = reference("friction_creep.csv")
        write_csv(self.out / "history.csv", {
            "t": exact["t"],
            "contact.plate.fluid_load_support": exact["p_over_P"],
            "contact.plate.friction_coefficient":
                factor * 0.2 * (1 - 0.9 * exact["p_over_P"])})
        (self.out / "case.toml").write_text(case)

    def test_pictures_are_drawn_and_numbers_compared(self):
        self.write(1.01)
        status, said, complained = run_main(plot_friction_plate.main, self.out)
        self.assertEqual((status, complained), (0, ""))
        self.assertEqual(said.count("+1.00 %"), 7)
        self.assertIn("friction at 0.5: 0.115371, exact 0.114228", said)
        for name in ("coefficient", "support", "line", "friction_plate"):
            pixels = matplotlib.image.imread(self.out / f"{name}.png")
            self.assertGreater(min(pixels.shape[:2]), 600, name)
            self.assertGreater(np.ptp(pixels), 0.5, name)

    def test_what_is_missing_is_named(self):
        self.write(1.0, case="[time]\nend = 1\n")
        status, _, complained = run_main(plot_friction_plate.main, self.out)
        self.assertEqual(status, 1)
        self.assertIn("no run of friction_plate.toml", complained)
        self.write(1.0)
        (self.out / "history.csv").unlink()
        status, _, complained = run_main(plot_friction_plate.main, self.out)
        self.assertEqual(status, 1)
        self.assertIn("cannot read", complained)


if __name__ == "__main__":
    unittest.main()
