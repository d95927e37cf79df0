#!/usr/bin/env python3
# processors: 1
"""Tests of scripts/plot_indentation.py, on an output made from references."""

import pathlib
import shutil
import sys
import tempfile
import unittest

import matplotlib.image
import numpy as np
from matplotlib.collections import LineCollection

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "tests/support")]
sys.dont_write_bytecode = True
import plot_indentation  # noqa: E402
from run_main import run_main  # noqa: E402
from synovia_output import Output, OutputError, reference  # noqa: E402
from synthetic_output import box, write_collection, write_csv  # noqa: E402

RADIUS, THICKNESS, WIDTH = 0.75, 0.75, 3.0


def write_line(folder: pathlib.Path, name: str, t: float, **columns) -> None:
    count = len(next(iter(columns.values())))
    table = {c: np.zeros(count) for c in ("x", "z", "p", "szz", "sxz")}
    write_csv(folder / "lines" / f"{name}_t{t:g}.csv", {**table, **columns})


def write_output(folder: pathlib.Path, factor: float) -> None:
    """What a run leaves whose forces are the exact ones times the factor."""
    exact = reference("indent_force.csv")
    write_csv(folder / "history.csv", {
        "t": exact["t"],
        "reaction.indenter_top.z": -0.25 * factor * exact["F_permeable"]})
    r = np.linspace(0, WIDTH, 61)
    for name, z in (("top", 0.725), ("middle", 0.375), ("bottom", 0.0)):
        write_line(folder, f"cartilage_{name}", 500, x=r, z=0 * r + z,
                   p=0.01 * np.exp(-r), sxz=-0.005 * r * np.exp(-r))
    axis = reference("indent_axis.csv").where("t", 500)
    write_line(folder, "axis", 500, x=0 * axis["z"], z=axis["z"], p=axis["p"])
    surface = reference("indent_surface.csv").where("t", 250)
    for name in ("cartilage", "indenter"):
        write_line(folder, f"contact_{name}", 250, x=surface["r"],
                   szz=surface["szz"])
    both = (box((0, 0, 0), (WIDTH, 1, THICKNESS), 1)
            + box((0, 0, THICKNESS), (RADIUS, 1, 1.5), 2))
    write_collection(folder, "bodies", {250: [both]})


class PlotIndentation(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.temp = tempfile.TemporaryDirectory()
        cls.out = pathlib.Path(cls.temp.name) / "out"
        write_output(cls.out, 1.01)

    @classmethod
    def tearDownClass(cls):
        cls.temp.cleanup()

    def test_all_pictures_are_drawn_and_numbers_compared(self):
        pictures = pathlib.Path(self.temp.name) / "pictures"
        status, said, complained = run_main(
            plot_indentation.main, self.out, "-o", pictures)
        self.assertEqual((status, complained), (0, ""))
        self.assertEqual({p.name for p in pictures.iterdir()},
                         {f"{n}.png" for n in plot_indentation.PANELS}
                         | {"indentation.png"})
        for picture in pictures.iterdir():
            pixels = matplotlib.image.imread(picture)
            self.assertGreater(min(pixels.shape[:2]), 600, picture.name)
            self.assertGreater(np.ptp(pixels), 0.5, picture.name)
        for t in (250, 500, 1500):
            self.assertRegex(said, f"force at {t} s: .*, \\+1.00 %")
        for z, p in ((0, 0.008942), (0.4, 0.006787)):
            self.assertRegex(said, f"z = {z} mm: {p} MPa, exact {p} MPa")

    def test_section_moves_by_the_displacement(self):
        figure, axes = plot_indentation.plt.subplots()
        plot_indentation.axial_stress(axes, Output(self.out))
        limits = axes.dataLim
        self.assertAlmostEqual(limits.x1, WIDTH, places=5)
        highest = [np.concatenate(outline.get_segments())[:, 1].max()
                   for outline in axes.collections
                   if isinstance(outline, LineCollection)]
        for z in (0.75, 0.95 * 0.75, 1.5, 0.95 * 1.5):
            self.assertTrue(np.isclose(highest, z, atol=1e-5).any(), z)
        plot_indentation.plt.close(figure)

    def test_what_is_missing_is_named(self):
        status, _, complained = run_main(
            plot_indentation.main, self.out / "nowhere")
        self.assertEqual(status, 1)
        self.assertIn("there is no directory", complained)
        broken = pathlib.Path(self.temp.name) / "broken"
        for remove, text in (
                ("history.csv", "cannot read '{}/history.csv'"),
                ("lines/axis_t500.csv", "there is no '{}/lines/axis_t500.csv';"
                 " there are: cartilage_bottom_t500.csv"),
                ("fields/bodies/bodies.pvd",
                 "there is no '{}/fields/bodies/bodies.pvd'")):
            with self.subTest(remove):
                shutil.copytree(self.out, broken)
                (broken / remove).unlink()
                status, _, complained = run_main(plot_indentation.main, broken)
                self.assertEqual(status, 1)
                self.assertIn(text.format(broken), complained)
                shutil.rmtree(broken)

    def test_wrong_tables_are_explained(self):
        table = self.out / "table.csv"
        table.write_text("t,f\n1,2\n3")
        history = Output(self.out)
        self.assertEqual(len(reference("mandel.csv")), 5)
        with self.assertRaisesRegex(OutputError, "no fields at t = 3, only "
                                    "at 250"):
            history.fields("bodies", 3.0)
        from synovia_output import Table
        self.assertEqual(list(Table(table)["t"]), [1.0])
        with self.assertRaisesRegex(OutputError, "no column 'g'; there are: "
                                    "t, f"):
            Table(table)["g"]
        with self.assertRaisesRegex(OutputError, "no row with t = 2"):
            Table(table).where("t", 2.0)
        table.write_text("t,f\n1,x\n")
        with self.assertRaisesRegex(OutputError, "table.csv.*'x'"):
            Table(table)


if __name__ == "__main__":
    unittest.main()
