#!/usr/bin/env python3
"""Compares linear iterations of finite deformation with infinitesimal ones.

Runs miniapps/scaling along the axes of scripts/benchmark, with the layers losing
a part of their thickness, in infinitesimal strain and in finite deformation:
mesh and order, permeability, time step, Poisson's ratio, stiffness jump, penalty
and ranks, with contact and without. What is compared are linear iterations for a
decade of the residual, as both stop at other tolerances.

Writes OUT/deformations.csv with all that each run printed, and the table,
OUT/deformations.md. A ratio above --limit, or a run that fails, is an exit status
of 1. Runs that are there are not made again.
"""

from __future__ import annotations

import argparse
import dataclasses
import pathlib
import sys

SCRIPTS = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(SCRIPTS / "lib"))

from benchmark_options import add_runner_options  # noqa: E402
from benchmark_runs import BenchmarkError, Run, Runner, Store  # noqa: E402
from benchmark_sweeps import (  # noqa: E402
    FINITE, FLAT, QUICK_FINITE, Extent, make_sweeps, scaled_size)

LIMIT = 1.3
STEPS = 6
RANKS = (1, 2)


@dataclasses.dataclass(frozen=True)
class Pair:
    """The same problem in both deformations."""

    axis: str
    series: str
    x: float
    infinitesimal: Run
    finite: Run


def pairs_of(extent: Extent, compression: float, order: int) -> list[Pair]:
    """The axis of sizes has all orders, the others this one."""
    pairs = []
    for sweep in make_sweeps(extent, RANKS):
        for point in sweep.points if sweep.name in FLAT else ():
            options = point.run.options | {"compression": compression,
                                           "steps": STEPS}
            if sweep.name != "size":
                options["order"] = order
                options["size"] = scaled_size("hex", order, options["size"])
            pairs.append(Pair(sweep.name, point.series, point.x, *(
                Run(point.run.ranks, **options | {"deformation": deformation})
                for deformation in ("infinitesimal", "finite"))))
    return pairs


def make_runs(pairs: list[Pair], runner: Runner, store: Store) -> None:
    runs = {run.key: run for pair in pairs
            for run in (pair.infinitesimal, pair.finite)}
    missing = [run for key, run in runs.items() if key not in store]
    print(f"{len(runs)} runs, {len(runs) - len(missing)} of them are there")
    for i, run in enumerate(missing, 1):
        print(f"{i}/{len(missing)}  {run.key}", flush=True)
        store.add(run, runner(run))


class Comparison:
    """What both runs of a pair took."""

    def __init__(self, pair: Pair, store: Store):
        self.pair = pair
        self.rows = [store[pair.infinitesimal.key], store[pair.finite.key]]

    @property
    def failures(self) -> list[str]:
        return [row["status"] for row in self.rows if row["status"] != "ok"]

    @property
    def ratio(self) -> float:
        linear, finite = (float(row["linear_per_decade"]) for row in self.rows)
        return finite / linear

    def cells(self) -> list[str]:
        pair = self.pair
        cells = [pair.axis, pair.series, f"{pair.x:g}"]
        if self.failures:
            return [*cells, "; ".join(self.failures), "", "", ""]
        return [*cells, self.rows[1]["dofs"],
                *(f"{float(row['linear_per_decade']):.2f}, "
                  f"{row['most_linear']}" for row in self.rows),
                f"{self.ratio:.2f}"]


def table_of(comparisons: list[Comparison]) -> str:
    lines = ["| axis | series | | unknowns | infinitesimal | finite | ratio |",
             "|---" * 7 + "|"]
    lines += ["| " + " | ".join(comparison.cells()) + " |"
              for comparison in comparisons]
    return "\n".join(lines) + "\n"


def parse(argv: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="benchmark --deformations", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true",
                        help="few small runs")
    parser.add_argument("--compression", type=float, default=0.3,
                        metavar="PART", help="of the layers' thickness that "
                        "they lose (default: %(default)s)")
    parser.add_argument("--order", type=int, choices=(1, 2, 3), default=2,
                        help="of all axes but that of sizes, which has all "
                        "(default: %(default)s)")
    parser.add_argument("--limit", type=float, default=LIMIT, metavar="RATIO",
                        help="the largest that is good (default: %(default)s)")
    add_runner_options(parser)
    return parser.parse_args(argv)


def main(argv: list[str] | None = None) -> int:
    args = parse(argv)
    pairs = pairs_of(QUICK_FINITE if args.quick else FINITE, args.compression,
                     args.order)
    try:
        args.output.mkdir(parents=True, exist_ok=True)
        store = Store(args.output / "deformations.csv")
        make_runs(pairs, Runner(args.program, args.launcher, args.timeout,
                                args.output), store)
        comparisons = [Comparison(pair, store) for pair in pairs]
        text = table_of(comparisons)
        (args.output / "deformations.md").write_text(text, encoding="utf-8")
    except (BenchmarkError, OSError) as error:
        print(f"benchmark --deformations: error: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("benchmark --deformations: stopped; the same command goes on "
              "from here", file=sys.stderr)
        return 130
    print(text, end="")
    failed = sum(bool(c.failures) for c in comparisons)
    above = sum(not c.failures and c.ratio > args.limit for c in comparisons)
    print(f"{len(comparisons)} pairs of runs: {failed} failed, {above} with a "
          f"ratio above {args.limit:g}")
    return 1 if failed or above else 0


if __name__ == "__main__":
    sys.exit(main())
