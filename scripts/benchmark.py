#!/usr/bin/env python3
"""Measures Synovia: iterations, times, memory, on any number of ranks.

Runs miniapps/scaling, two curved layers in contact, with one axis varied at a
time around a base point: mesh and order, permeability 1e-9..1e1, time step
1e-3..1e3, Poisson's ratio 0..0.49, stiffness jump 1..1e4, penalty 1..1e6 times
the default, with contact and without, both solvers, and ranks (the same problem
and the same share for each rank).

Writes to OUT: runs.csv with all that each run printed, a table and the plots
(PNG) of each sweep, and index.html, which needs no other file. A run that fails
is a row that says so. Rows that are there are not made again.

Under a batch scheduler, in an allocation: --launcher "srun -n" and --ranks
1,2,4,... (see scripts/benchmark.slurm).
"""

from __future__ import annotations

import argparse
import os
import pathlib
import signal
import sys

SCRIPTS = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(SCRIPTS / "lib"))

import missing_module  # noqa: E402,F401

import benchmark_plots as plots  # noqa: E402
import benchmark_sweeps as sweeps  # noqa: E402
import figure_style as style  # noqa: E402
import machine  # noqa: E402
from benchmark_options import add_runner_options  # noqa: E402
from benchmark_runs import (  # noqa: E402
    BenchmarkError, Row, Runner, Store, write_table)
from benchmark_sweeps import Sweep  # noqa: E402
from report_page import Page, svg  # noqa: E402

COLUMNS = (("dofs", "unknowns"), ("newton", "Newton"),
           ("augmentations", "augmentations"), ("linear", "linear"),
           ("most_linear", "most"), ("mean_linear", "mean"),
           ("setups", "set-ups"), ("factorisations", "factorizations"),
           ("seconds_total", "s"), ("dofs_per_second", "unknowns / s"),
           ("memory_sum", "MiB"))
TITLES = {"size": "Size and order", "permeability": "Permeability",
          "step": "Time step", "poisson": "Poisson's ratio",
          "jump": "Stiffness jump", "penalty": "Penalty",
          "solver": "Solvers", "strong": "Ranks: the same problem",
          "weak": "Ranks: the same share"}


class Benchmark:
    """Makes the runs that are missing and writes what all of them show."""

    def __init__(self, wanted: list[Sweep], out: pathlib.Path):
        self.sweeps = wanted
        self.out = out
        self.store = Store(out / "runs.csv")

    def make_runs(self, runner: Runner, retry: bool) -> None:
        runs = {p.run.key: p.run for sweep in self.sweeps
                for p in sweep.points}
        missing = [run for key, run in runs.items() if key not in self.store
                   or retry and self.store[key]["status"] != "ok"]
        print(f"{len(runs)} runs, {len(runs) - len(missing)} of them are there")
        for i, run in enumerate(missing, 1):
            print(f"{i}/{len(missing)}  {run.key}", flush=True)
            row = runner(run)
            self.store.add(run, row)
            print("   " + self._summary(row), flush=True)

    @staticmethod
    def _summary(row: Row) -> str:
        if row["status"] != "ok":
            return row["status"]
        return (f"{row['dofs']} unknowns, at most {row['most_linear']} "
                f"iterations, {float(row['seconds_total']):.1f} s")

    def rows(self, sweep: Sweep) -> list[Row]:
        return [{"sweep": sweep.name, "series": point.series,
                 "x": f"{point.x:g}"} | self.store[point.run.key]
                for point in sweep.points if point.run.key in self.store]

    def write(self) -> None:
        style.use_style()
        page = Page("Synovia: measurements",
                    [f"{machine.processor()}, {os.cpu_count()} processors",
                     "Two curved layers in contact, miniapps/scaling. Linear "
                     "systems are solved to a relative tolerance of 1e-8; "
                     "where solvers are compared, to 1e-4 while the active set "
                     "changes, as other programs do it."])
        self._write_growth(page)
        for name, figure in self._figures():
            if figure is not None:
                figure.savefig(self.out / f"{name}.png")
                page.pictures([(name, svg(figure))])
        for sweep in self.sweeps:
            self._write_sweep(page, sweep)
        part = self.out / "index.html.part"
        part.write_text(str(page), encoding="utf-8")
        os.replace(part, self.out / "index.html")

    def _figures(self):
        by_name = {sweep.name: sweep for sweep in self.sweeps}
        yield "iterations", plots.iterations_figure(self.sweeps, self.store)
        for name in ("size", "solver"):
            if name in by_name:
                yield f"costs_{name}", plots.costs_figure(by_name[name],
                                                          self.store)
        if "strong" in by_name and "weak" in by_name:
            yield "ranks", plots.ranks_figure(by_name["strong"],
                                              by_name["weak"], self.store)

    def _write_growth(self, page: Page) -> None:
        page.heading("Iterations of a linear system along each axis")
        page.text(f"They should be at most {plots.MOST}, and grow by a factor "
                  f"of at most {plots.MOST_GROWTH:g} from the base point of an "
                  "axis, which is the smallest mesh or number of ranks, or "
                  "else 1e-3 mm^4/(N s), 1 s, 0.1, 1 and 1.")
        rows = []
        for growth in plots.growths(self.sweeps, self.store):
            rows.append((TITLES[growth.sweep], growth.series,
                         str(growth.least), str(growth.base),
                         str(growth.most),
                         f"{growth.factor:.2f}", str(growth.failed),
                         "yes" if growth.good else "no"))
            if growth.failed:
                page.warn(f"{TITLES[growth.sweep]}, {growth.series}: "
                          f"{growth.failed} runs failed")
        page.table(rows, ("axis", "series", "least", "at the base point",
                          "most", "growth", "failed runs",
                          "within the limits"))
        write_table(self.out / "iterations.csv", [
            dict(zip(("axis", "series", "least", "base", "most", "growth",
                      "failed", "good"), row)) for row in rows])

    def _write_sweep(self, page: Page, sweep: Sweep) -> None:
        rows = self.rows(sweep)
        if not rows:
            return
        write_table(self.out / f"{sweep.name}.csv", rows)
        page.heading(TITLES[sweep.name])
        page.table([self._cells(row) for row in rows],
                   ("series", "x", *(title for _, title in COLUMNS)))

    @staticmethod
    def _cells(row: Row) -> list[str]:
        cells = [row["series"], row["x"]]
        if row["status"] != "ok":
            return [*cells, row["status"]]
        return cells + [f"{float(row[name]):.4g}" if float(row[name]) < 1e4
                        else f"{float(row[name]):,.0f}" for name, _ in COLUMNS]


def rank_list(text: str) -> list[int]:
    try:
        ranks = sorted({int(part) for part in text.split(",")})
    except ValueError:
        ranks = []
    if not ranks or ranks[0] < 1:
        raise argparse.ArgumentTypeError(
            f"'{text}' is not a list of numbers of ranks, such as 1,2,4")
    return ranks


def parse(argv: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="benchmark", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true",
                        help="few small runs: under five minutes on two cores")
    parser.add_argument("--ranks", type=rank_list, default=[1, 2],
                        metavar="LIST", help="for the scaling (default: 1,2)")
    parser.add_argument("--sweep", action="append", choices=TITLES,
                        help="only this one; may be repeated")
    add_runner_options(parser, timeout=1800.0)
    parser.add_argument("--retry", action="store_true",
                        help="make runs that failed again")
    return parser.parse_args(argv)


def main(argv: list[str] | None = None) -> int:
    args = parse(argv)
    # A scheduler's way to say what Ctrl-C says.
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    extent = sweeps.QUICK if args.quick else sweeps.FULL
    wanted = [sweep for sweep in sweeps.make_sweeps(extent, args.ranks)
              if not args.sweep or sweep.name in args.sweep]
    try:
        args.output.mkdir(parents=True, exist_ok=True)
        runner = Runner(args.program, args.launcher, args.timeout,
                        args.output)
        benchmark = Benchmark(wanted, args.output)
        benchmark.make_runs(runner, args.retry)
        benchmark.write()
    except (BenchmarkError, OSError) as error:
        print(f"benchmark.py: error: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("benchmark.py: stopped; the same command goes on from here",
              file=sys.stderr)
        return 130
    print(f"wrote {args.output / 'index.html'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
