#!/usr/bin/env python3
# processors: 1
"""Runs of the Python package: results, plots, Ctrl-C, resume, sweeps."""

from __future__ import annotations

import contextlib
import io
import os
import pathlib
import signal
import sys
import tempfile
import threading
import time
import unittest
import unittest.mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))

from python_package import coarse_columns, synovia  # noqa: E402

import numpy as np  # noqa: E402

from synovia.sweep_table import SweepTable  # noqa: E402

E = "material.0.solid.E"


class Runs(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory(prefix="synovia runs ")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.case = coarse_columns(self.folder)
        self.out = self.folder / "out"

    def interrupt_when(self, file: pathlib.Path, rows: int) -> None:
        """Ctrl-C as soon as a history has so many rows."""
        def wait() -> None:
            while not file.exists() or file.read_text().count("\n") <= rows:
                time.sleep(0.01)
            signal.pthread_kill(threading.main_thread().ident, signal.SIGINT)
        threading.Thread(target=wait, daemon=True).start()

    def test_results(self) -> None:
        shown = io.StringIO()
        with contextlib.redirect_stderr(shown):
            result = self.case.run(ranks=2, progress=True)
        self.assertIn("t = 1000 of 1000, step 40", shown.getvalue())
        self.assertEqual(result.t.shape, (40,))
        self.assertEqual(result.t[-1], 1000)
        force = result.force("columns")
        self.assertEqual(force.shape, (40, 3))
        np.testing.assert_allclose(force[:, 2], result.force("upper_top")[:, 2],
                                   rtol=1e-6)
        with self.assertRaisesRegex(synovia.OutputError, "columns, lower_b"):
            result.force("column")
        self.assertEqual(len(result.warnings), 1)
        self.assertIn("0.1", result.warnings[0])
        self.assertEqual(result.line("lower", 250)["p"].shape, (16,))
        self.assertEqual(result.lines["lower"], [250, 500])
        np.testing.assert_array_equal(result.line("lower")["p"],
                                      result.line("lower", 500)["p"])
        self.assertEqual(set(result.fields), {"bodies", "contact_columns"})
        self.assertEqual(result.fields["bodies"], [250, 500, 750, 1000])
        self.assertEqual(result.case.solver.linear, "auto")
        self.assertIn("step 40", result.log)

        mesh = result.mesh(500)
        self.assertEqual(mesh["fluid_pressure"].shape, (mesh.n_points,))
        moved = result.mesh(500, deformed=True)
        np.testing.assert_allclose(moved.points - mesh.points,
                                   mesh["displacement"], atol=1e-6)

        with self.assertRaisesRegex(synovia.RunError, "resume=True"):
            self.case.run()
        before = (self.out / "history.csv").read_bytes()
        self.case.run(resume=True)
        self.assertEqual((self.out / "history.csv").read_bytes(), before)
        self.case.run(overwrite=True)

    def test_plots(self) -> None:
        self.case.time.end = 500
        result = self.case.run()
        self.assertEqual(len(result.plot("contact.*.force_?").lines), 4)
        labels = [line.get_label() for line in result.plot_forces().lines]
        self.assertIn("contact.columns.force_z", labels)
        labels = [line.get_label() for line in result.plot_pressures().lines]
        self.assertIn("fluid.peak_pressure", labels)
        self.assertEqual(len(result.plot_line("lower").lines), 2)
        with self.assertRaisesRegex(synovia.OutputError, "there are: lower"):
            result.plot_line("lowest")
        with self.assertRaisesRegex(synovia.OutputError, "no column 'conta"):
            result.plot("contact.*.nothing")
        picture = result.picture()
        self.assertGreater(np.ptp(picture.pixels), 100)
        self.assertTrue(picture._repr_png_().startswith(b"\x89PNG"))
        with self.assertRaisesRegex(synovia.OutputError, "did you mean 'fl"):
            result.picture("fluid_presure")
        page = result._repr_html_()
        self.assertIn("Two columns in contact", page)
        self.assertIn("data:image/png;base64,", page)

    def test_errors(self) -> None:
        with self.assertRaisesRegex(synovia.RunError, "Poisson's ratio"):
            self.case.copy({"material.0.solid.nu": 0.6}).run()
        with self.assertRaisesRegex(synovia.SynoviaError, "ranks = 0"):
            self.case.run(ranks=0)
        with unittest.mock.patch.dict(os.environ, MPIEXEC="/no/mpirun"), \
                self.assertRaisesRegex(synovia.RunError, "start '/no/mpirun'"):
            self.case.run(ranks=2, overwrite=True)

    def test_started_and_stopped(self) -> None:
        self.case.time.step = 0.5
        run = self.case.start(ranks=2)
        while not (self.out / "history.csv").exists():
            time.sleep(0.01)
        self.assertTrue(run.running)
        run.stop()
        with self.assertRaisesRegex(synovia.Stopped, "stopped at t = "):
            run.wait()
        self.assertFalse(run.running)
        self.assertLess(synovia.Result(self.out).t[-1], 1000)
        run = self.case.start(resume=True)
        run.kill()
        with self.assertRaisesRegex(synovia.RunError, "exit status -9"):
            run.wait()

    def test_ctrl_c_and_resume(self) -> None:
        whole = self.case.run(output=self.folder / "whole").history
        self.case.time.step = 0.5
        for ranks in (1, 2):
            out = self.folder / f"stopped on {ranks}"
            with self.subTest(ranks=ranks):
                self.interrupt_when(out / "history.csv", 5)
                with self.assertRaisesRegex(
                        synovia.Stopped, r"stopped at t = [0-9.]+; run\("):
                    self.case.run(ranks, out)
                at = synovia.Result(out).t[-1]
                self.assertLess(at, 1000)
                longer = self.case.copy({"time.step": 25})
                result = longer.run(ranks, out, resume=True)
                self.assertEqual(result.t[-1], 1000)
                self.assertGreater((result.t == at).sum(), 0)
                self.assertAlmostEqual(
                    result.force("columns")[-1, 2]
                    / whole["contact.columns.force_z"][-1], 1, places=3)

    def test_sweep(self) -> None:
        table = self.folder / "sweep.csv"
        parameters = {E: [0.4, 0.5417, 0.7], "time.scheme": [
            "backward_euler", "sdirk33"]}
        quantities = {"force": "contact.columns.force_z",
                      "peak": lambda result:
                          result.history["fluid.peak_pressure"].max()}
        self.case.time.end = 3000
        self.case.time.step = 100

        def sweep(**more: object) -> SweepTable:
            return synovia.sweep(self.case, parameters, quantities, table,
                                 processes=2, **more)

        found = sweep()
        self.assertEqual(list(found), ["run", E, "time.scheme", "force",
                                       "peak", "error"])
        np.testing.assert_array_equal(found[E], np.repeat([0.4, 0.5417, 0.7],
                                                          2))
        # At rest the force goes with the modulus.
        ends = found["force"][found["time.scheme"] == "sdirk33"]
        np.testing.assert_allclose(ends / ends[0], [1, 0.5417 / 0.4, 0.7 / 0.4],
                                   rtol=1e-3)
        self.assertTrue((found["peak"] > 0.01).all())
        self.assertIn("backward_euler", found._repr_html_())

        # Rows that are missing, one cut short, are made; no other.
        lines = table.read_text().splitlines(keepends=True)
        table.write_text("".join(lines[:-2]) + lines[-2][:5])
        kept = [(self.folder / "sweep" / name / "history.csv").stat().st_mtime
                for name in ("0000", "0001")]
        again = sweep()
        self.assertEqual([row for row in again["force"]],
                         [row for row in found["force"]])
        self.assertEqual(kept, [
            (self.folder / "sweep" / name / "history.csv").stat().st_mtime
            for name in ("0000", "0001")])

        self.case.time.end = 900
        with self.assertRaisesRegex(synovia.SynoviaError, "of another case"):
            sweep()

    def test_sweep_with_failures(self) -> None:
        self.case.time.step = 250
        table = synovia.sweep(
            self.case, {"material.0.solid.nu": [0.1, 0.6]},
            ["fluid.peak_pressure"], self.folder / "sweep.csv")
        self.assertTrue(np.isfinite(table["fluid.peak_pressure"][0]))
        self.assertTrue(np.isnan(table["fluid.peak_pressure"][1]))
        self.assertIn("Poisson's ratio is 0.6", table["error"][1])
        with self.assertRaisesRegex(synovia.CaseError, "did you mean"):
            synovia.sweep(self.case, {"material.0.solid.E_": [1]}, [])
        with self.assertRaisesRegex(synovia.SynoviaError, "as many values"):
            synovia.sweep(self.case, {E: [1, 2], "time.step": [1]}, [],
                          combine="zip")

    def test_sweep_stopped(self) -> None:
        table = self.folder / "sweep.csv"
        self.case.time.step = 1
        self.interrupt_when(self.folder / "sweep" / "0000" / "history.csv", 5)
        with self.assertRaisesRegex(synovia.Stopped, "0 of 2 runs"):
            synovia.sweep(self.case, {E: [0.5, 0.6]}, ["fluid.peak_pressure"],
                          table, processes=1)
        at = synovia.Result(self.folder / "sweep" / "0000").t[-1]
        self.assertLess(at, 1000)
        synovia.sweep(self.case, {E: [0.5, 0.6]}, ["fluid.peak_pressure"],
                      table, processes=1)
        self.assertIn(f"goes on from t = {at:g}",
                      synovia.Result(self.folder / "sweep" / "0000").log)


if __name__ == "__main__":
    unittest.main()
