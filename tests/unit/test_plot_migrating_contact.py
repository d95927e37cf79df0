#!/usr/bin/env python3
# processors: 1
"""Tests of scripts/plot_migrating_contact.py, on outputs made up."""

import pathlib
import sys
import tempfile
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "tests/support")]
sys.dont_write_bytecode = True
import plot_migrating_contact  # noqa: E402
from plot_migrating_contact import Run  # noqa: E402
from run_main import run_main  # noqa: E402
from synovia_output import Output  # noqa: E402
from synthetic_output import box, write_collection, write_csv  # noqa: E402

MU, SOLID = 0.3, 0.1
CASE = f"""
[[rigid_body]]
name = "sphere"
shape = {{type = "sphere", center = [0, 0, 11], radius = 10}}

[[contact]]
name = "sphere"
friction = {{coefficient = {MU}, solid_fraction = {SOLID}}}
"""


def write_output(folder: pathlib.Path, last_support: float) -> None:
    """Strokes of 50 s; the friction is that of the law."""
    t = np.arange(0.0, 176.0, 5.0)[1:]
    x = np.interp(t, [0, 25, 75, 125, 175], [0, 2, -2, 2, -2])
    support = np.interp(t, [0, 175], [0.9, last_support])
    write_csv(folder / "history.csv", {
        "t": t, "contact.sphere.fluid_load_support": support,
        "contact.sphere.friction_coefficient":
            MU * (1 - (1 - SOLID) * support),
        "rigid_body.sphere.translation_x": x,
        "rigid_body.sphere.translation_y": 0 * t,
        "rigid_body.sphere.translation_z": 0 * t - 0.1})
    (folder / "case.toml").write_text(CASE)
    bodies = [box((-5, 0, 0), (5, 3, 1), 1), box((-3, 0, 1), (3, 3, 2), 2)]
    for body in bodies:
        body["fluid_pressure"] = body.points[:, 2]
    write_collection(folder, "bodies", {100.0: bodies, 150.0: bodies})


class PlotMigratingContact(unittest.TestCase):

    def setUp(self):
        self.temp = tempfile.TemporaryDirectory()
        self.addCleanup(self.temp.cleanup)
        self.folder = pathlib.Path(self.temp.name)
        self.out = self.folder / "out"
        write_output(self.out, 0.88)

    def test_both_runs_are_drawn(self):
        write_output(self.folder / "resting_contact", 0.2)
        pictures = self.folder / "pictures"
        status, said, complained = run_main(
            plot_migrating_contact.main, self.out, "-o", pictures)
        self.assertEqual((status, complained), (0, ""))
        self.assertEqual({p.name for p in pictures.iterdir()}, {
            f"{name}.png" for name in (
                "load_support", "friction", "correlation",
                "pressure_migrating", "pressure_resting",
                "migrating_contact")})
        # At 150 s, in the middle of the last middle.
        self.assertIn("migrating, last middle, 150 s: the fluid bears 88.3 %",
                      said)
        self.assertIn("resting, last middle, 150 s: the fluid bears 30.0 %",
                      said)

    def test_other_may_be_elsewhere_or_missing(self):
        status, said, _ = run_main(plot_migrating_contact.main, self.out)
        self.assertEqual(status, 0)
        self.assertNotIn("resting", said)
        self.assertFalse((self.out / "pressure_resting.png").exists())
        elsewhere = self.folder / "elsewhere"
        write_output(elsewhere, 0.3)
        status, said, _ = run_main(
            plot_migrating_contact.main, self.out, elsewhere)
        self.assertEqual(status, 0)
        self.assertIn("resting, last middle", said)
        status, _, complained = run_main(
            plot_migrating_contact.main, self.out, self.folder / "nowhere")
        self.assertEqual(status, 1)
        self.assertIn("there is no directory", complained)

    def test_middles_of_strokes(self):
        run = Run("migrating", Output(self.out))
        self.assertEqual(list(run.time[run.middles]), [50.0, 100.0, 150.0])
        self.assertEqual(run.law, (MU, SOLID))

    def test_what_rests_all_the_time_is_refused(self):
        history = self.out / "history.csv"
        header = history.read_text().splitlines()[0]
        history.write_text(header + "\n" + "1,0.9,0.1,0,0,0\n")
        status, _, complained = run_main(plot_migrating_contact.main, self.out)
        self.assertEqual(status, 1)
        self.assertIn("makes no stroke", complained)


if __name__ == "__main__":
    unittest.main()
