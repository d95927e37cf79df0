#!/usr/bin/env python3
# processors: 1
"""Tests of scripts/plot_confined_compression.py and of the unconfined one, on
outputs made from references."""

import pathlib
import sys
import tempfile
import unittest

import matplotlib.image
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "tests/support")]
sys.dont_write_bytecode = True
import plot_confined_compression  # noqa: E402
import plot_unconfined_compression  # noqa: E402
from run_main import run_main  # noqa: E402
from synovia_output import reference  # noqa: E402
from synthetic_output import write_csv  # noqa: E402

SCALE = 4 / 3


def write_case(folder: pathlib.Path, deformation: str) -> None:
    (folder / "case.toml").write_text(
        f'[mesh]\nscale = {SCALE if deformation == "finite" else 1.0}\n'
        f'[physics]\ndeformation = "{deformation}"\n')


def write_confined(folder: pathlib.Path, finite: bool, factor: float) -> None:
    if finite:
        exact = reference("finite_confined_holmesmow.csv")
        stress = exact["stress"]
    else:
        exact = reference("confined_ramp_reaction.csv")
        stress = -exact["stress_compressive"]
    area = (0.2 * (SCALE if finite else 1.0)) ** 2
    write_csv(folder / "history.csv", {
        "t": exact["t"], "reaction.top.z": factor * area * stress})
    for t in (50, 250):
        if finite:
            row = exact.where("t", t)
            z = np.linspace(0, 1, 5)
            p, u = row["p_base"] * (1 - z), 2 * row["u_mid"] * z
        else:
            row = reference("confined_ramp_profile.csv").where("t", t)
            z, p, u = row["z"], row["p"], row["u"]
        write_csv(folder / "lines" / f"depth_t{t}.csv", {
            "z": z, "p": factor * p, "uz": u})


def write_unconfined(folder: pathlib.Path, finite: bool, factor: float
                     ) -> None:
    if finite:
        exact = reference("finite_unconfined_holmesmow.csv")
        stress, p_axis, edge = (exact["mean_stress"], exact["p_axis"],
                                exact["u_r_side"])
    else:
        exact = reference("unconfined_ramp_force.csv")
        stress, p_axis, edge = (-exact["mean_stress"], exact["p_axis"],
                                exact["ur_edge"])
    write_csv(folder / "history.csv", {
        "t": exact["t"],
        "reaction.top.z": factor * np.pi / 4 * 1.5**2 * stress})
    for t in (50, 250):
        r = np.linspace(0, 1.5, 16)
        here = np.isclose(exact["t"], t)
        p = p_axis[here] * (1 - (r / 1.5) ** 2)
        if not finite:
            table = reference("unconfined_ramp_p.csv").where("t", t)
            p = np.interp(r, table["r"], table["p"])
        write_csv(folder / "lines" / f"radius_t{t}.csv", {
            "x": r, "p": factor * p, "ux": edge[here] * r / 1.5})


CASES = {"confined_compression": (plot_confined_compression, write_confined),
         "unconfined_compression": (plot_unconfined_compression,
                                    write_unconfined)}


class PlotCompression(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def written(self, name: str, finite: bool, factor: float) -> pathlib.Path:
        out = self.folder / f"{name}_{finite}_{factor:g}"
        CASES[name][1](out, finite, factor)
        write_case(out, "finite" if finite else "infinitesimal")
        return out

    def drawn(self, out: pathlib.Path, name: str) -> str:
        status, said, complained = run_main(CASES[name][0].main, out)
        self.assertEqual((status, complained), (0, ""))
        for picture in (name, "stress", "pressure", "displacement"):
            pixels = matplotlib.image.imread(out / f"{picture}.png")
            self.assertGreater(min(pixels.shape[:2]), 600, picture)
            self.assertGreater(np.ptp(pixels), 0.5, picture)
        return said

    def test_what_is_the_reference_does_not_differ(self):
        for name in CASES:
            for finite in (False, True):
                with self.subTest(name, finite=finite):
                    said = self.drawn(self.written(name, finite, 1.0), name)
                    self.assertRegex(said, r"stress: .*, 0\.00 % of that")
                    found = [float(line.split("differs by ")[1].split()[0])
                             for line in said.splitlines()
                             if "differs by" in line]
                    self.assertEqual(len(found), 4)
                    self.assertLess(max(found), 1e-8)

    def test_what_differs_is_said(self):
        for name in CASES:
            for finite in (False, True):
                with self.subTest(name, finite=finite):
                    said = self.drawn(self.written(name, finite, 1.02), name)
                    self.assertRegex(said, r"stress: .*, 2\.00 % of that")
                    self.assertRegex(said, r"p at 250 s: differs by [1-9]")

    def test_what_is_missing_is_named(self):
        for name, (script, _) in CASES.items():
            out = self.written(name, True, 1.0)
            (out / "history.csv").unlink()
            status, _, complained = run_main(script.main, out)
            self.assertEqual(status, 1)
            self.assertIn("cannot read", complained)


if __name__ == "__main__":
    unittest.main()
