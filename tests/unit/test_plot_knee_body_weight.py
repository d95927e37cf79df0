#!/usr/bin/env python3
# processors: 1
"""Tests of scripts/plot_knee_body_weight.py, on an output made up of boxes."""

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
import knee_run  # noqa: E402
import plot_knee_body_weight as plot  # noqa: E402
import tibial_contact as tibia  # noqa: E402
from knee_run import PAIRS, Knee  # noqa: E402
from synovia_output import Output  # noqa: E402
from synthetic_output import write_collection, write_csv  # noqa: E402
from test_plot_knee import FORCES, bodies, face  # noqa: E402

TIMES = np.array([0.5, 1.0, 600.0])
RAMP = np.array([0.5, 1.0, 1.0])
SUPPORT = {"femur-tibia-medial": 0.9, "femur-tibia-lateral": 0.8,
           "tibia-meniscus-medial": 0.6, "tibia-meniscus-lateral": 0.5}


def write_output(folder: pathlib.Path, times: np.ndarray = TIMES,
                 ramp: np.ndarray = RAMP) -> None:
    """The knee's forces times the ramp, and fields of all times but the first.
    """
    columns = {"t": times, "fluid.peak_pressure": 1.2 * ramp,
               "rigid_body.femur.rotation_x": 0.2 * ramp,
               "rigid_body.femur.translation_z": -0.5 * ramp}
    for pair in PAIRS:
        sign = 1 if pair.startswith("tibia-") else -1
        columns |= {
            f"contact.{pair}.force_x": 0 * times,
            f"contact.{pair}.force_y": 0 * times,
            f"contact.{pair}.force_z": sign * FORCES[pair] * ramp,
            f"contact.{pair}.area": 2 * FORCES[pair] * ramp,
            f"contact.{pair}.peak_traction": 0.1 * FORCES[pair] * ramp,
            f"contact.{pair}.fluid_load_support":
                np.full(len(times), SUPPORT.get(pair, 0.0))}
    write_csv(folder / "history.csv", columns)
    grids = bodies()
    write_collection(folder, "bodies", {t: list(grids.values())
                                        for t in times[1:]})
    for pair in PAIRS:
        kind, side = pair.rsplit("-", 1)
        name = knee_run.DESTINATIONS.get(kind, "meniscus") + "_" + side
        surface = face(grids[name], 4 if kind == "meniscus-femur" else 2)
        surface["contact_pressure"] = np.maximum(
            0.1 * FORCES[pair] - 0.05 * abs(surface.points[:, 1]), 0)
        write_collection(folder, f"contact_{pair}",
                         {t: [surface] for t in times[1:]})


class PlotKneeBodyWeight(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.temp = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temp.cleanup)
        cls.out = pathlib.Path(cls.temp.name) / "out"
        cls.out.mkdir()
        write_output(cls.out)

    def knee(self) -> Knee:
        return Knee(Output(self.out), plot.LOADED)

    def test_pictures_and_findings(self):
        folder = pathlib.Path(self.temp.name) / "pictures"
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            status = plot.main([str(self.out), "-o", str(folder)])
        self.assertEqual(status, 0)
        names = {"pressure_loaded", "pressure_held", "area", "peak",
                 "shares", "approach", "knee_body_weight"}
        self.assertEqual({file.stem for file in folder.glob("*.png")}, names)
        for name in names:
            pixels = matplotlib.image.imread(folder / f"{name}.png")
            self.assertGreater(np.ptp(pixels[..., :3]), 0.5)
        self.assertIn("t = 1 s: 100 N, medial 40 %, by way of the menisci 70 %",
                      said.getvalue())

    def test_what_lies_on_the_tibia(self):
        knee = self.knee()
        on_tibia = [pair for pair in FORCES if "tibia" in pair]
        total = sum(FORCES[pair] for pair in on_tibia)
        np.testing.assert_allclose(tibia.area(knee), 2 * total * RAMP)
        np.testing.assert_allclose(tibia.peak_stress(knee), 4.1 * RAMP)
        fluid = sum(FORCES[pair] * SUPPORT[pair] for pair in on_tibia)
        np.testing.assert_allclose(tibia.fluid_share(knee),
                                   100 * fluid / total)

    def test_maps_have_the_pressure_of_each_surface(self):
        maps = tibia.pressure_maps(self.knee(), 1.0)
        self.assertEqual(set(maps), set(SUPPORT))
        for pair, (_, _, pressure) in maps.items():
            self.assertLessEqual(pressure.max(), 0.1 * FORCES[pair] + 1e-6)
            self.assertGreater(pressure.max(), 0.05 * FORCES[pair])


if __name__ == "__main__":
    unittest.main()
