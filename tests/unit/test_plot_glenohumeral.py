#!/usr/bin/env python3
# processors: 1
"""Tests of scripts/plot_glenohumeral.py, on an output made up."""

import pathlib
import sys
import tempfile
import unittest

import matplotlib
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "tests/support")]
sys.dont_write_bytecode = True
import plot_glenohumeral  # noqa: E402
import section  # noqa: E402
from plot_glenohumeral import GLENOID_RADIUS, Joint  # noqa: E402
from run_main import run_main  # noqa: E402
from synovia_output import Output  # noqa: E402
from synthetic_output import box, write_collection, write_csv  # noqa: E402

RIM = 5.0   # radius of the contact that is made up, mm


def cap(radius: float) -> float:
    """The area of the glenoid's surface within this radius."""
    return 2 * np.pi * GLENOID_RADIUS * (
        GLENOID_RADIUS - np.sqrt(GLENOID_RADIUS**2 - radius**2))


def layer(low: float, high: float, width: float, region: int):
    grid = box((0, 0, low), (width, width, high), region)
    grid["fluid_pressure"] = grid.points[:, 0]
    # Its greatest principal value is at the side x = width.
    x = grid.points[:, 0]
    grid["effective_stress"] = np.stack(
        [0 * x, 0 * x, 0 * x, 0 * x, 0 * x, 1e-3 * x], axis=1)
    return grid


def write_output(folder: pathlib.Path, saved: float = 10.0,
                 quarter: bool = True) -> None:
    t = np.array([1.0, 10.0, 100.0])
    part = 0.25 if quarter else 1.0
    columns = {"t": t, "contact.joint.force_z": -part * t,
               "contact.joint.area": part * cap(RIM) * np.ones(3),
               "fluid.peak_pressure": 0.1 * t}
    if quarter:
        columns["reaction.symmetry_x.x"] = t
    write_csv(folder / "history.csv", columns)
    for name, z in (("glenoid", (0, 1.5)), ("humeral", (1.5, 3))):
        for time in (1, 10):
            z = np.linspace(*z, 4) if len(z) == 2 else z
            write_csv(folder / "lines" / f"axis_{name}_t{time}.csv",
                      {"z": z, "uz": 0 * z, "p": 0.8 + 0 * z,
                       "szz": -1.0 + 0 * z})
    write_collection(folder, "bodies", {saved: [layer(0, 1.5, 11, 1),
                                                layer(1.5, 3, 19, 2)]})


class PlotGlenohumeral(unittest.TestCase):

    def setUp(self):
        self.temp = tempfile.TemporaryDirectory()
        self.addCleanup(self.temp.cleanup)
        self.out = pathlib.Path(self.temp.name) / "out"

    def test_all_pictures_are_drawn_and_findings_printed(self):
        write_output(self.out)
        pictures = self.out.parent / "pictures"
        status, said, complained = run_main(
            plot_glenohumeral.main, self.out, "-o", pictures)
        self.assertEqual((status, complained), (0, ""))
        panels = plot_glenohumeral.FIELDS | plot_glenohumeral.CURVES
        self.assertEqual({p.name for p in pictures.iterdir()},
                         {f"{n}.png" for n in panels} | {"glenohumeral.png"})
        for picture in pictures.iterdir():
            pixels = matplotlib.image.imread(picture)
            self.assertGreater(min(pixels.shape[:2]), 600, picture.name)
            self.assertGreater(np.ptp(pixels), 0.5, picture.name)
        for words in ("t = 10 s: force 10 N, contact radius 5 mm, peak "
                      "pressure 1 MPa",
                      "10 s: pressure 0.8 and 0.8 MPa, 80.0 % of the normal",
                      "maximum principal effective stress between z = 0 and "
                      "1.5 mm: 11 kPa at r = 11",
                      "minimum principal effective stress between z = 1.5 "
                      "and 3 mm: -19 kPa at r = 19"):
            self.assertIn(words, said)

    def test_the_whole_joint_is_not_multiplied(self):
        write_output(self.out, quarter=False)
        joint = Joint(Output(self.out))
        np.testing.assert_allclose(joint.force(), [1, 10, 100])
        np.testing.assert_allclose(joint.contact_radius(), RIM, rtol=1e-6)

    def test_principal_values_are_those_of_the_tensor(self):
        turn = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
        tensor = turn @ np.diag([-3.0, 0.5, 2.0]) @ turn.T
        voigt = tensor[[0, 1, 2, 0, 1, 0], [0, 1, 2, 1, 2, 2]]
        np.testing.assert_allclose(
            plot_glenohumeral.principal_values(voigt[np.newaxis]),
            [[-3.0, 0.5, 2.0]], atol=1e-12)

    def test_colors_are_not_those_of_a_singular_corner(self):
        grid = layer(0, 1, 1, 1)
        parts = section.cut([grid], normal=1, at=0.0)
        values = [np.where(np.arange(parts[0].n_points) == 0, -1e3,
                           parts[0].points[:, 0])]
        colors = section.color_range(parts, values)
        self.assertEqual(colors["vmin"], 0.0)
        self.assertTrue(0.8 < colors["vmax"] <= 1.0, colors)
        self.assertIn(section.extent(values, colors), ("min", "both"))

    def test_what_is_missing_is_named(self):
        write_output(self.out, saved=20.0)
        status, _, complained = run_main(plot_glenohumeral.main, self.out)
        self.assertEqual(status, 1)
        self.assertIn("no fields near t = 10, only at 20", complained)
        status, _, complained = run_main(
            plot_glenohumeral.main, self.out / "nowhere")
        self.assertEqual(status, 1)
        self.assertIn("there is no directory", complained)


if __name__ == "__main__":
    unittest.main()
