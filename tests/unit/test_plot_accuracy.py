#!/usr/bin/env python3
# processors: 1
"""Tests of scripts/plot_accuracy.py, with runs that are there already."""

import csv
import dataclasses
import json
import math
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "support"))
sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "scripts"))
sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "scripts/lib"))
sys.dont_write_bytecode = True

import plot_accuracy

from run_main import run_main  # noqa: E402
from synovia_output import reference  # noqa: E402


def run(*arguments: str) -> tuple[int, str]:
    status, out, err = run_main(plot_accuracy.main, *arguments)
    return status, out + err


class PlotAccuracy(unittest.TestCase):

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = pathlib.Path(folder.name)

    def finished(self, order: int) -> list[plot_accuracy.Cost]:
        costs = [plot_accuracy.Cost(order, size, 100 * k, 1000 * k,
                                    0.01 / k**order, 2.0 * k, 1.0 * k)
                 for k, size in enumerate(plot_accuracy.SIZES[order], 1)]
        for cost in costs:
            there = self.out / f"order{order}_size{cost.size:g}_step50_ranks1"
            there.mkdir()
            (there / "cost.json").write_text(
                json.dumps(dataclasses.asdict(cost)))
        return costs

    def test_runs_that_are_there_are_tabled_and_drawn_but_not_made(self):
        costs = self.finished(1) + self.finished(2)
        status, said = run(str(self.out), "--program", __file__, "--launcher",
                           "false", "--orders", "1", "2")
        self.assertEqual(status, 0, said)
        with open(self.out / "accuracy.csv", encoding="utf-8") as stream:
            rows = list(csv.DictReader(stream))
        self.assertEqual([float(row["error"]) for row in rows],
                         [cost.error for cost in costs])
        self.assertEqual([int(row["order"]) for row in rows],
                         [1, 1, 1, 2, 2, 2])
        self.assertTrue((self.out / "accuracy.png").stat().st_size > 10000)

    def test_error_is_that_of_the_force_over_the_largest(self):
        exact = reference("indent_force.csv")
        force = exact["F_permeable"]
        largest = float(force.max())
        lines = [f"t,{plot_accuracy.FORCE}"] + [
            f"{t},{(f + 0.03 * largest * (-1)**k) / 4!r}"
            for k, (t, f) in enumerate(zip(exact["t"].tolist(),
                                           force.tolist()))]
        (self.out / "history.csv").write_text("\n".join(lines) + "\n")
        self.assertTrue(math.isclose(plot_accuracy.force_error(self.out), 0.03,
                                     rel_tol=1e-9))

    def test_what_is_wrong_is_said(self):
        status, said = run(str(self.out), "--program", "/no/such/program")
        self.assertEqual(status, 2)
        self.assertIn("there is no '/no/such/program'", said)
        status, said = run(str(self.out), "--program", __file__, "--launcher",
                           "false", "--orders", "3")
        self.assertEqual(status, 1)
        self.assertIn("exit status 1, see", said)


if __name__ == "__main__":
    unittest.main()
