#!/usr/bin/env python3
# processors: 1
"""Fits of the Python package.

Noise that is added to an indentation's curve does not hide its parameters: they
lie in the intervals of confidence. Exact solutions of two experiments at once
give theirs. Intervals are those of linear regression where a model is linear.
"""

from __future__ import annotations

import math
import pathlib
import signal
import sys
import tempfile
import threading
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))

from python_package import CASES, SOURCE, synovia  # noqa: E402

import numpy as np  # noqa: E402
import scipy.stats  # noqa: E402

from synovia import Curve, Fit, Parameter  # noqa: E402

E, NU, KAPPA = 0.5417, 0.0833, 4.0e-3
SOLID, PERMEABILITY = "material.0.solid", "material.0.permeability.value"
REFERENCE = SOURCE / "tests" / "reference"


def parameters() -> list[Parameter]:
    return [Parameter("E", f"{SOLID}.E", 1.0, 0.05, 10, log=True),
            Parameter("nu", f"{SOLID}.nu", 0.2, 0.0, 0.45),
            Parameter("k", PERMEABILITY, 1e-3, 1e-5, 1, log=True)]


class Fits(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory(prefix="synovia fit ")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def case(self, name: str, size: str, **time: object) -> synovia.Case:
        case = synovia.Case(CASES / f"{name}.toml")
        case.mesh.file = str(self.folder / f"{name}.msh")
        case.mesh.generator = [*case.mesh.generator, "--size", size]
        for key, value in time.items():
            case.time[key] = value
        del case["output.line"]
        case.make_mesh()
        return case

    def test_noisy_indentation(self) -> None:
        case = self.case("indentation_wedge", "4", scheme="sdirk23", step=20,
                         end=600)
        # Much faster than the fluid can leave, which tells E and nu apart.
        case["boundary.punch.displacement"] = [
            "free", "free", {"times": [0, 20], "values": [0, -0.075]}]
        case["output.fields_every"] = 0
        turn = 2 * math.pi / math.sin(math.radians(5))
        result = case.run(output=self.folder / "exact")
        force = -turn * result.force("punch")[:, 2]
        noise = 0.01 * force.max()
        chance = np.random.default_rng(2026)
        measured = Curve(result.t, force + noise * chance.standard_normal(
            force.size), "reaction.punch.z", factor=-turn)
        found = synovia.fit(case, measured, parameters(), confidence=0.95)
        print(found)
        self.assertTrue(found.converged)
        for name, truth in (("E", E), ("nu", NU), ("k", KAPPA)):
            low, high = found.intervals[name]
            self.assertTrue(low < truth < high, f"{name}: {low} to {high}")
        # Intervals that say nothing would hold anything.
        for name, width in (("E", 0.3), ("k", 0.5)):
            low, high = found.intervals[name]
            self.assertLess(high / low - 1, width, name)
        low, high = found.intervals["nu"]
        self.assertLess(high - low, 0.3)
        self.assertAlmostEqual(found.noise / 0.01, 1, delta=0.4)
        # F = E f(E k t), so that E dF/dE - k dF/dk is F itself.
        np.testing.assert_allclose(
            found.sensitivity("E")[0] - found.sensitivity("k")[0],
            found.fitted[0], rtol=5e-3)
        self.assertEqual(len(found.plot().axes), 2)
        self.assertEqual(len(found.plot_sensitivities().axes[0].lines), 4)
        self.assertIn("95 % interval", found._repr_html_())

    def test_two_experiments(self) -> None:
        cases = [self.case("confined_compression", "2", step=50),
                 self.case("unconfined_compression", "3", step=50)]
        files = [("confined_ramp_reaction.csv", "stress_compressive", -1/0.04),
                 ("unconfined_ramp_force.csv", "F", -4.0)]
        curves = []
        for case, (file, column, factor) in zip(cases, files):
            table = synovia.Table(REFERENCE / file)
            of = np.isin(table["t"], np.arange(50, case.time.end + 1, 50))
            self.assertGreater(of.sum(), 8)
            curves.append([Curve(table["t"][of], table[column][of],
                                 "reaction.top.z", factor=factor)])
        found = synovia.fit(cases, curves, parameters())
        print(found)
        for name, truth in (("E", E), ("k", KAPPA)):
            self.assertAlmostEqual(found[name] / truth, 1, delta=0.02)
        self.assertAlmostEqual(found["nu"], NU, delta=0.01)
        self.assertEqual(found.cases[1][PERMEABILITY], found["k"])
        self.assertEqual(cases[1][PERMEABILITY], KAPPA)
        self.assertEqual(len(found.plot().axes), 4)

    def test_stopped(self) -> None:
        case = self.case("confined_compression", "4", step=50)
        t = np.array([250.0, 500.0, 750.0])
        third = self.folder / "runs" / "0003" / "history.csv"

        def interrupt() -> None:
            while not third.exists():
                time.sleep(0.01)
            signal.pthread_kill(threading.main_thread().ident, signal.SIGINT)
        threading.Thread(target=interrupt, daemon=True).start()
        with self.assertRaisesRegex(
                synovia.Stopped, "E = 1, nu = 0.2, k = 0.001 came nearest"):
            synovia.fit(case, Curve(t, -t, "reaction.top.z"), parameters(),
                        processes=1, folder=self.folder / "runs")

    def test_what_is_wrong(self) -> None:
        case = self.case("confined_compression", "4", step=250)
        t = np.array([250.0, 500.0, 750.0])
        curve = Curve(t, t, "reaction.top.z")
        for call, text in (
                (lambda: Curve(t, t[:2], "a"), "as many values as times"),
                (lambda: Curve(t[::-1], t, "a"), "times that ascend"),
                (lambda: Curve(t, 0 * t, "a"), "zero everywhere"),
                (lambda: Parameter("E", "a", 2, 0, 1), "not between 0 and 1"),
                (lambda: Parameter("E", "a", -1, log=True), "no logarithm"),
                (lambda: synovia.fit(case, curve, []), "no parameters"),
                (lambda: synovia.fit([case], [curve, curve], parameters()),
                 "1 cases and curves of 2"),
                (lambda: synovia.fit(
                    case, curve, [Parameter("E", f"{SOLID}.e", 1)]),
                 "no key 'material.N.solid.e'"),
                (lambda: synovia.fit(
                    case, curve, [Parameter("nu", f"{SOLID}.nu", 0.7)]),
                 "nu = 0.7, failed: .*Poisson's ratio"),
                (lambda: synovia.fit(
                    case, Curve(t + 1, t, "reaction.top.z"), parameters()),
                 "measured from t = 251 to 751"),
                (lambda: synovia.fit(
                    case, Curve(t, t, "reaction.tip.z"), parameters()),
                 "no column 'reaction.tip.z'")):
            with self.subTest(text), \
                    self.assertRaisesRegex(synovia.SynoviaError, text):
                call()


class Intervals(unittest.TestCase):
    """Of a straight line a + b t, whose closed form is known."""

    def setUp(self) -> None:
        chance = np.random.default_rng(7)
        self.t = np.linspace(0, 4, 30)
        self.values = 1 + 2 * self.t + 0.1 * chance.standard_normal(30)

    def line(self, sigma: float | None, jacobian: np.ndarray | None = None
             ) -> Fit:
        curve = Curve(self.t, self.values, "line", sigma=sigma)
        matrix = np.stack([np.ones_like(self.t), self.t], axis=1)
        x = np.linalg.lstsq(matrix, self.values, rcond=None)[0]
        return Fit(cases=[], curves=[[curve]],
                   parameters=[Parameter("a", "a", 1), Parameter("b", "b", 1)],
                   x=x, fitted=[matrix @ x],
                   jacobian=matrix / curve.scale[:, None]
                   if jacobian is None else jacobian,
                   confidence=0.9, converged=True, message="", runs=1,
                   seconds=0.0)

    def test_estimated_noise(self) -> None:
        fit = self.line(None)
        known = scipy.stats.linregress(self.t, self.values)
        quantile = scipy.stats.t.ppf(0.95, 28)
        for name, center, error in (
                ("a", known.intercept, known.intercept_stderr),
                ("b", known.slope, known.stderr)):
            np.testing.assert_allclose(
                fit.intervals[name], [center - quantile * error,
                                      center + quantile * error], rtol=1e-9)
        self.assertEqual(fit.doubts, [])

    def test_known_noise(self) -> None:
        fit = self.line(0.1)
        error = 0.1 / np.sqrt(np.sum((self.t - self.t.mean())**2))
        low, high = fit.intervals["b"]
        self.assertAlmostEqual((high - low) / 2,
                               scipy.stats.norm.ppf(0.95) * error, 9)
        self.assertIn("times sigma", self.line(0.001).doubts[0])

    def test_inseparable(self) -> None:
        matrix = np.stack([self.t, 2 * self.t], axis=1)
        fit = self.line(None, matrix)
        self.assertIn("the data hardly tell a and b apart", fit.doubts)
        self.assertEqual(fit.intervals["a"], (-np.inf, np.inf))


if __name__ == "__main__":
    unittest.main()
