#!/usr/bin/env python3
# processors: 1
"""Tests of scripts/plot_knee.py, on an output made up of boxes."""

import pathlib
import shutil
import sys
import tempfile
import unittest
from unittest import mock

import matplotlib.image
import numpy as np
import pyvista
from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / name)
                for name in ("scripts", "scripts/lib", "tests/support")]
sys.dont_write_bytecode = True
import knee_film  # noqa: E402
import knee_run  # noqa: E402
import knee_views  # noqa: E402
import plot_knee  # noqa: E402
from figure_style import plt  # noqa: E402
from knee_run import PAIRS, Knee  # noqa: E402
from run_main import run_main  # noqa: E402
from synovia_output import Output  # noqa: E402
from synthetic_output import box, write_collection, write_csv  # noqa: E402

# At 100 s, N: half of it before
FORCES = {"femur-tibia-medial": 10.0, "femur-tibia-lateral": 20.0,
          "meniscus-femur-medial": 30.0, "meniscus-femur-lateral": 40.0,
          "tibia-meniscus-medial": 29.0, "tibia-meniscus-lateral": 41.0}
TIMES = (50.0, 100.0, 150.0)
# In another order than that of the case
REGIONS = {"meniscus_lateral": 2, "femoral_cartilage": 5,
           "tibial_cartilage_medial": 7, "meniscus_medial": 8,
           "tibial_cartilage_lateral": 9}


def carved(body, left: float, right: float, y: float):
    """Without the middle row of elements between two x."""
    x = body.cell_centers().points
    hole = (x[:, 0] > left) & (x[:, 0] < right) & (abs(x[:, 1] - y) < 7)
    return body.extract_cells(~hole)


def bodies() -> dict[str, pyvista.UnstructuredGrid]:
    """The medial meniscus is open towards the middle, the lateral one a ring.

    Their middles are at y = 3 and y = 1; the pressure is 0.1 MPa per mm of |x|
    beyond 20 mm.
    """
    grids = {
        "femoral_cartilage": box((-32, -15, 4), (32, 20, 6), 0),
        "tibial_cartilage_medial": box((-32, -15, 0), (-10, 20, 2), 0),
        "tibial_cartilage_lateral": box((10, -15, 0), (32, 20, 2), 0),
        "meniscus_medial": carved(
            box((-30, -12, 2), (-12, 18, 4), 0), -24, 0, 3.0),
        "meniscus_lateral": carved(
            box((12, -14, 2), (30, 16, 4), 0), 15, 24, 1.0)}
    for name, grid in grids.items():
        grid.cell_data["attribute"] = np.full(grid.n_cells, REGIONS[name])
        x = grid.points[:, 0]
        grid["fluid_pressure"] = 0.1 * np.maximum(np.abs(x) - 20, 0)
    return grids


def face(body, z: float) -> pyvista.UnstructuredGrid:
    surface = body.extract_surface()
    flat = abs(surface.cell_centers().points[:, 2] - z) < 1e-6
    return surface.extract_cells(flat)


def write_history(folder: pathlib.Path, pairs: tuple[str, ...] = PAIRS,
                  **more) -> None:
    t = np.array(TIMES)
    ramp = np.array([0.5, 1.0, 1.0])
    columns = {"t": t, "fluid.peak_pressure": 1.2 * ramp}
    for pair in pairs:
        sign = 1 if pair.startswith("tibia-") else -1
        for axis in "xy":
            columns[f"contact.{pair}.force_{axis}"] = 0 * t
        columns[f"contact.{pair}.force_z"] = sign * FORCES[pair] * ramp
        columns[f"contact.{pair}.area"] = 2 * FORCES[pair] * ramp
        columns[f"contact.{pair}.peak_traction"] = 0.1 * FORCES[pair] * ramp
    write_csv(folder / "history.csv", columns | more)


def write_output(folder: pathlib.Path, times: tuple[float, ...] = TIMES
                 ) -> None:
    write_history(folder)
    grids = bodies()
    write_collection(folder, "bodies",
                     {t: list(grids.values()) for t in times})
    for pair in PAIRS:
        kind, side = pair.rsplit("-", 1)
        name = knee_run.DESTINATIONS.get(kind, "meniscus") + "_" + side
        z = 4 if kind == "meniscus-femur" else 2
        write_collection(folder, f"contact_{pair}",
                         {t: [face(grids[name], z)] for t in times})


class PlotKnee(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.temp = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temp.cleanup)
        cls.place = pathlib.Path(cls.temp.name)
        cls.out = cls.place / "out"
        write_output(cls.out)
        # Small pictures show as much of what is made up.
        for module in (plot_knee, knee_film):
            small = mock.patch.object(module, "WIDTH", 200)
            small.start()
            cls.addClassCleanup(small.stop)

    def knee(self) -> Knee:
        return Knee(Output(self.out))

    def copy(self, *without: str) -> pathlib.Path:
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.place)) / "out"
        shutil.copytree(self.out, folder)
        for name in without:
            shutil.rmtree(folder / name)
        return folder

    def refused(self, folder: pathlib.Path, words: str) -> None:
        """One line, and no picture of what is wrong."""
        status, said, complained = run_main(plot_knee.main, folder)
        self.assertEqual((status, said), (1, ""))
        self.assertIn(words, complained)
        self.assertEqual(len(complained.splitlines()), 1, complained)
        self.assertFalse(list(folder.glob("*.png")))

    def test_all_pictures_are_drawn_and_findings_printed(self):
        pictures = self.place / "pictures"
        status, said, complained = run_main(
            plot_knee.main, self.out, "-o", pictures)
        self.assertEqual((status, complained), (0, ""))
        self.assertEqual({p.name for p in pictures.iterdir()},
                         {f"{name}.png" for name in plot_knee.PANELS}
                         | {"knee.png", "knee.gif"})
        for picture in pictures.glob("*.png"):
            pixels = matplotlib.image.imread(picture)[..., :3]
            self.assertGreater(min(pixels.shape[:2]), 400, picture.name)
            self.assertGreater((pixels < 0.9).any(axis=2).mean(), 0.01,
                               picture.name)
        film = Image.open(pictures / "knee.gif")
        self.assertEqual(film.n_frames, len(TIMES))
        first = np.asarray(film.convert("RGB")).copy()
        film.seek(2)
        changed = (first != np.asarray(film.convert("RGB"))).any(axis=2)
        # Only the time does: pressure and displacement were the same.
        self.assertTrue(changed.any())
        self.assertLess(np.flatnonzero(changed.any(axis=1)).max(),
                        0.2 * len(changed))
        self.assertEqual(list(first[-1, 0]), [255, 255, 255])
        for words in ("t = 100 s: force 100 N, medial 40.0 %, through the "
                      "menisci 70.0 %; contact area 340 mm^2, peak pressure "
                      "1.2 MPa",
                      "slice of the medial meniscus, y = 3 mm: pressure 0.4 "
                      "to 1 MPa, the peak at 100 % of the width from the "
                      "inner edge, sigma_zz 0 to 0.02 MPa",
                      "slice of the lateral meniscus, y = 1 mm: pressure 0.4"):
            self.assertIn(words, said)
        self.assertNotIn("yet", said)

    def test_forces_are_those_on_what_the_femur_touches(self):
        knee = self.knee()
        np.testing.assert_allclose(knee.force(), [50, 100, 100])
        parts = plot_knee.force_parts(knee)
        self.assertEqual({name: part[1] for name, part in parts.items()},
                         {"medial": 40, "lateral": 60, "menisci": 70,
                          "cartilage on cartilage": 30})
        np.testing.assert_allclose(knee.share(parts["medial"]), 40)

    def test_bodies_are_found_by_what_the_pairs_lie_on(self):
        for name, body in self.knee().bodies.items():
            self.assertEqual(set(body["attribute"]), {REGIONS[name]}, name)

    def test_slices_are_of_the_bodies_far_from_the_horns(self):
        slices = self.knee().slices
        for side, at, bounds in (("medial", 3, (-30, -24)),
                                 ("lateral", 1, (24, 30))):
            cut = slices[side]
            self.assertAlmostEqual(cut.at, at, places=5)
            np.testing.assert_allclose(cut.meniscus.bounds,
                                       (*bounds, at, at, 2, 4), atol=1e-3)
            heights = [part.bounds[4:] for part in cut.others]
            np.testing.assert_allclose(heights, [(4, 6), (0, 2)], atol=1e-3)

    def test_normal_stress_is_that_of_the_tensor(self):
        random = np.random.default_rng(1)
        tensor = random.normal(size=(3, 3))
        tensor += tensor.T
        normal = random.normal(size=3)
        voigt = tensor[[0, 1, 2, 0, 1, 0], [0, 1, 2, 1, 2, 2]]
        self.assertAlmostEqual(
            knee_run.normal_stress(voigt[np.newaxis], normal[np.newaxis])[0],
            normal @ tensor @ normal)
        # sigma_zz = 0.01 (z - 2) is all of the stress there is.
        surface = self.knee().surfaces["femoral_cartilage"]
        stress, normals = surface["normal_stress"], surface["Normals"]
        level, upright = abs(normals[:, 2]) > 0.99, abs(normals[:, 2]) < 0.01
        np.testing.assert_allclose(stress[upright], 0, atol=1e-12)
        np.testing.assert_allclose(np.unique(stress[level].round(9)),
                                   [0.02, 0.04])
        # After the displacement, whose z is -0.05 z
        np.testing.assert_allclose(surface.bounds[4:], [3.8, 5.7], rtol=1e-6)

    def test_from_below_lateral_is_on_the_left(self):
        knee = self.knee()
        for body in knee.surfaces.values():
            body["fluid_pressure"] = np.where(body.points[:, 0] > 25, 1.0, 0)
        view = knee_views.INFERIOR
        picture = plot_knee.field_picture(
            knee, (knee_run.FEMUR,), view, "fluid_pressure")
        figure, axes = plt.subplots()
        self.addCleanup(plt.close, figure)
        plot_knee.show(axes, picture, view)
        low, high = axes.get_xlim()
        self.assertGreater(low, high)
        row = picture.pixels[len(picture.pixels) // 2].astype(int)
        yellow = np.flatnonzero(row[:, 0] > row[:, 2] + 50)
        x = low + (yellow + 0.5) / len(row) * (high - low)
        # At the corners of elements there is a gradient.
        self.assertTrue(20 < x.min() < 32 and 30 < x.max() < 33, x)

    def test_colors_go_from_nothing_to_the_load(self):
        part = self.knee().slices["medial"].meniscus
        values = np.linspace(-0.1, 1.0, part.n_points)
        pressure = knee_run.load_colors([part], [values], 1)
        self.assertEqual((pressure["cmap"], pressure["vmin"]), ("viridis", 0))
        self.assertTrue(0.9 < pressure["vmax"] <= 1, pressure)
        stress = knee_run.load_colors([part], [-values], -1)
        self.assertEqual((stress["cmap"], stress["vmax"]), ("viridis_r", 0))
        self.assertAlmostEqual(stress["vmin"], -pressure["vmax"])

    def test_pressures_of_pairs_replace_tractions(self):
        self.assertIsNone(self.knee().peak_pressures())
        folder = self.copy()
        t = np.array(TIMES)
        write_history(folder, **{f"contact.{pair}.peak_pressure": 0.01 * t
                                 for pair in PAIRS})
        for out, label in ((self.out, "peak pressure, traction (MPa)"),
                           (folder, "peak fluid pressure (MPa)")):
            figure = plt.figure()
            self.addCleanup(plt.close, figure)
            plot_knee.peak_pressure(figure, Knee(Output(out)))
            self.assertEqual(figure.axes[0].get_ylabel(), label)
        drawn = [line.get_ydata()[-1] for line in figure.axes[0].lines
                 if len(line.get_ydata()) == len(t) + 1]
        np.testing.assert_allclose(drawn, 6 * [1.5] + [1.2])

    def test_strains_beyond_the_theory_are_noted(self):
        self.assertEqual(plot_knee.strain_note(self.knee()), "")
        folder = self.copy()
        for strain, noted in ((-0.08, False), (-0.3, True)):
            write_history(folder, **{
                "strain.max_principal": np.array([0.01, strain, 2 * strain]),
                "strain.min_det_F": np.array([1.0, 0.75, 0.4])})
            said = plot_knee.findings(Knee(Output(folder)))
            self.assertEqual("the largest principal strain is -0.30, the "
                             "smallest det F 0.75." in said, noted)
            self.assertEqual("Infinitesimal strain" in said, noted)

    def test_a_run_that_stopped_early_is_drawn_as_far_as_it_came(self):
        folder = self.place / "early"
        write_output(folder, times=(20.0, 50.0))
        knee = Knee(Output(folder))
        self.assertEqual(knee.time, 50)
        said = plot_knee.findings(knee).splitlines()
        self.assertEqual(said[0], "there are no fields at t = 100 s yet: the "
                         "pictures are of t = 50 s, the latest")
        self.assertIn("t = 50 s: force 50 N", said[1])
        figure = plt.figure()
        self.addCleanup(plt.close, figure)
        plot_knee.draw_panel(figure, knee, "meniscal_slices")
        self.assertEqual(figure.get_suptitle(), "Frontal slices, 50 s")

    def test_what_is_missing_is_named(self):
        self.refused(self.place / "nowhere", "there is no directory")
        folder = self.place / "far"
        write_output(folder, times=(20.0, 130.0))
        self.refused(folder, "no fields near t = 100, only at 20, 130")
        self.refused(self.copy("fields/bodies"), "bodies.pvd'")
        self.refused(self.copy("fields/contact_femur-tibia-lateral"),
                     "contact_femur-tibia-lateral.pvd'")
        folder = self.copy()
        write_history(folder, PAIRS[1:])
        self.refused(folder, "has no contact pair femur-tibia-medial; there "
                     "are: femur-tibia-lateral, ")

    def test_what_is_no_knee_is_refused(self):
        folder = self.copy("fields/bodies")
        grids = bodies()
        del grids["femoral_cartilage"]
        write_collection(folder, "bodies", {100.0: list(grids.values())})
        self.refused(folder, "the 4 bodies of")
        del grids["meniscus_medial"]
        shutil.rmtree(folder / "fields/bodies")
        write_collection(folder, "bodies", {100.0: list(grids.values())})
        self.refused(folder, "'contact_tibia-meniscus-medial' of")


if __name__ == "__main__":
    unittest.main()
