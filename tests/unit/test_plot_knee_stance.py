#!/usr/bin/env python3
# processors: 1
"""Tests of scripts/plot_knee_stance.py, on an output made up of boxes."""

import contextlib
import io
import pathlib
import sys
import tempfile
import unittest

import matplotlib.image
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / name)
                for name in ("scripts", "scripts/lib", "tests/support",
                             "tests/unit")]
sys.dont_write_bytecode = True
import plot_knee_stance as plot  # noqa: E402
from synovia_output import Output, OutputError  # noqa: E402
from test_plot_knee_body_weight import write_output  # noqa: E402

# Each cycle bears more than the one before it.
TIMES = np.array([0.1, 0.2, 0.35, 0.65, 1.2, 1.35, 1.65, 2.2, 2.3])
RAMP = np.array([0.1, 0.2, 0.8, 1.0, 0.2, 0.9, 1.1, 0.2, 0.3])


class PlotKneeStance(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.temp = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temp.cleanup)
        cls.folder = pathlib.Path(cls.temp.name)
        cls.out = cls.write(TIMES.size)

    @classmethod
    def write(cls, rows: int) -> pathlib.Path:
        out = cls.folder / f"out{rows}"
        out.mkdir()
        write_output(out, TIMES[:rows], RAMP[:rows])
        return out

    def drawn(self, out: pathlib.Path) -> str:
        """What is said; all pictures must show something."""
        folder = self.folder / f"pictures_{out.name}"
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            self.assertEqual(plot.main([str(out), "-o", str(folder)]), 0)
        names = {"pressure_first", "pressure_second", "load", "area", "peak",
                 "shares", "approach", "knee_stance"}
        self.assertEqual({file.stem for file in folder.glob("*.png")}, names)
        for name in names:
            pixels = matplotlib.image.imread(folder / f"{name}.png")
            self.assertGreater(np.ptp(pixels[..., :3]), 0.5)
        return said.getvalue()

    def test_pictures_of_the_first_and_the_last_whole_cycle(self):
        said = self.drawn(self.out)
        self.assertIn("cycle 1, 0.15 s: 80 N, medial 40 %", said)
        self.assertIn("cycle 2, 0.45 s: 110 N", said)
        self.assertNotIn("cycle 3", said)

    def test_one_cycle_is_the_first_and_the_last(self):
        said = self.drawn(self.write(5))
        self.assertIn("cycle 1, 0.45 s: 100 N", said)
        self.assertNotIn("cycle 2", said)

    def test_a_cycle_has_the_times_since_its_beginning(self):
        gait = plot.Gait(Output(self.out))
        self.assertEqual(gait.cycles, 2)
        times, values = gait.phase(1, RAMP)
        np.testing.assert_allclose(times, [0.0, 0.15, 0.45, 1.0])
        np.testing.assert_allclose(values, [0.2, 0.9, 1.1, 0.2])
        self.assertAlmostEqual(gait.field_time(plot.PEAKS[1]), 1.65)

    def test_a_run_within_the_first_cycle_is_refused(self):
        with self.assertRaisesRegex(OutputError, "within the first cycle"):
            plot.Gait(Output(self.write(4)))


if __name__ == "__main__":
    unittest.main()
