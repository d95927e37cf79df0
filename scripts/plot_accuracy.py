#!/usr/bin/env python3
"""Accuracy against cost: the indentation with orders 1, 2 and 3, on meshes.

Runs miniapps/indentation.cpp with a rigid punch, for which the force is known
(tests/reference/indent_force.csv), on three meshes of hexahedra for each order,
and draws the error of the force against the time of all processors together and
against the number of unknowns. OUT gets

  accuracy.csv   a line for each run: order, size, elements, unknowns, error,
                 processor time of all ranks (s), elapsed time (s)
  accuracy.png   the picture
  <run>/         mesh, history and output of each run

The error is the root mean square over all steps of the force less the exact one,
over the largest exact one. Meshes of all orders are of one family: those of
meshes/indentation.py --hex whose sizes grow by 1.4^size from one element to the
next. Their cartilage is 6 times as wide as the indenter, for the reference has
it infinite. SDIRK33 with steps of 50 s leaves little error in time. Runs that are
there already are not made again, and the picture shows the results so far.

Sample runs, after scripts/setup and a build of the indentation miniapp:
  scripts/run_python scripts/plot_accuracy.py out/accuracy
  scripts/run_python scripts/plot_accuracy.py out/accuracy --ranks 2 --step 25
  scripts/run_python scripts/plot_accuracy.py out/accuracy --orders 1 2
"""

from __future__ import annotations

import argparse
import csv
import dataclasses
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "scripts/lib"))

import missing_module  # noqa: E402,F401

import numpy as np  # noqa: E402
from matplotlib.ticker import LogLocator, NullFormatter  # noqa: E402

import figure_style as style  # noqa: E402
from benchmark_options import add_launcher  # noqa: E402
from figure_style import plt  # noqa: E402
from synovia_output import OutputError, Table, reference  # noqa: E402

# Sizes of the meshes, so that all orders have about as many unknowns.
SIZES = {1: (1.0, 0.7, 0.5), 2: (2.0, 1.5, 1.0), 3: (3.0, 2.0, 1.5)}
GROWTH = 1.4
RADIUS = 4.5    # of the cartilage, mm
QUARTERS = 4    # the model is a quarter of the cylinder
FORCE = "contact.indenter-cartilage.source_force_z"


@dataclasses.dataclass
class Cost:
    """What a run was and took."""

    order: int
    size: float
    elements: int
    unknowns: int
    error: float
    processor_seconds: float
    seconds: float


def run(command: list[str | pathlib.Path], log: pathlib.Path) -> str:
    """Runs it; gives what it printed, which is in the log too."""
    # Threads of its own make BLAS wait busily, which counts as processor time.
    result = subprocess.run(command, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, text=True,
                            env={"OPENBLAS_NUM_THREADS": "1"} | os.environ)
    log.write_text(result.stdout)
    if result.returncode != 0:
        last = (result.stdout.strip().splitlines() or ["it said nothing"])[-1]
        raise OutputError(f"exit status {result.returncode}, see '{log}': "
                          f"{last}")
    return result.stdout


def found(pattern: str, text: str) -> list[int]:
    return [int(number) for number in re.findall(pattern, text)]


def force_error(folder: pathlib.Path) -> float:
    history = Table(folder / "history.csv")
    exact = reference("indent_force.csv")
    force = np.interp(history["t"], exact["t"], exact["F_permeable"])
    error = QUARTERS * history[FORCE] - force
    return float(np.sqrt(np.mean(error**2)) / force.max())


def measure(order: int, size: float, folder: pathlib.Path,
            args: argparse.Namespace) -> Cost:
    """Makes the mesh and the run, or reads what is there of them."""
    summary = folder / "cost.json"
    if summary.exists():
        return Cost(**json.loads(summary.read_text()))
    folder.mkdir(parents=True, exist_ok=True)
    mesh = folder / "mesh.msh"
    said = run([sys.executable, ROOT / "meshes/indentation.py", "--hex",
                "--order", "2", "--size", f"{size:g}", "--growth",
                f"{GROWTH**size:.4g}", "--radius", f"{RADIUS:g}", "-o", mesh],
               folder / "mesh.log")
    elements = sum(found(r": (\d+) elements", said))
    before, started = os.times(), time.monotonic()
    said = run([*shlex.split(args.launcher), str(args.ranks), args.program,
                "--mesh", mesh, "--output", folder, "--overwrite",
                "--order", str(order), "--rigid", "--scheme", "sdirk33",
                "--step", f"{args.step:g}", "--fields-every", "0"], folder / "run.out")
    after = os.times()
    cost = Cost(order, size, elements, found(r"(\d+) dofs", said)[0],
                force_error(folder),
                after.children_user - before.children_user
                + after.children_system - before.children_system,
                time.monotonic() - started)
    summary.write_text(json.dumps(dataclasses.asdict(cost)))
    return cost


def draw(costs: list[Cost], file: pathlib.Path) -> None:
    style.use_style()
    figure, panels = plt.subplots(1, 2, figsize=(6.6, 2.9), sharey=True)
    for axes, quantity, label in (
            (panels[0], "processor_seconds", "processor time (s)"),
            (panels[1], "unknowns", "unknowns")):
        for order, mark in ((1, "o"), (2, "s"), (3, "^")):
            these = sorted((getattr(cost, quantity), 100 * cost.error)
                           for cost in costs if cost.order == order)
            if these:
                axes.loglog(*zip(*these), marker=mark, markersize=5,
                            color=plt.rcParams["axes.prop_cycle"].by_key()
                            ["color"][order - 1],
                            label=f"order {order}"
                            + (", stabilized" if order == 1 else ""))
        axes.set_xlabel(label)
        axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axes.xaxis.set_major_formatter("{x:,g}")
        axes.xaxis.set_minor_formatter(NullFormatter())
        axes.grid(True, which="major", color="#dddddd", linewidth=0.6)
    panels[0].set_ylabel("error of the force (%)")
    panels[0].yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    panels[0].yaxis.set_major_formatter("{x:g}")
    panels[0].yaxis.set_minor_formatter(NullFormatter())
    panels[0].set_ylim(top=1.6 * 100 * max(cost.error for cost in costs))
    panels[1].legend()
    figure.savefig(file)
    plt.close(figure)


def write_table(costs: list[Cost], file: pathlib.Path) -> None:
    with open(file, "w", newline="", encoding="utf-8") as stream:
        table = csv.writer(stream)
        table.writerow(field.name for field in dataclasses.fields(Cost))
        table.writerows(dataclasses.astuple(cost) for cost in costs)


def parse(argv: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path, metavar="OUT",
                        help="directory for the results")
    parser.add_argument("--orders", type=int, nargs="+", choices=SIZES,
                        default=list(SIZES), help="default: 1 2 3")
    parser.add_argument("--ranks", type=int, default=1,
                        help="default: %(default)s, which wastes no processor "
                        "time on waiting")
    parser.add_argument("--step", type=float, default=50.0,
                        help="of SDIRK33 (s, default: %(default)s)")
    add_launcher(parser)
    parser.add_argument("--program", type=pathlib.Path,
                        default=ROOT / "build/miniapps/indentation",
                        help="default: build/miniapps/indentation")
    args = parser.parse_args(argv)
    if not args.program.exists():
        parser.error(f"there is no '{args.program}': build it first")
    if shutil.which(shlex.split(args.launcher)[0]) is None:
        parser.error(f"there is no '{args.launcher}'")
    if not (args.ranks > 0 and args.step > 0):
        parser.error("--ranks and --step must be positive")
    return args


def main(argv: list[str] | None = None) -> int:
    args = parse(argv)
    costs = []
    try:
        for order in args.orders:
            for size in SIZES[order]:
                name = f"order{order}_size{size:g}_step{args.step:g}" \
                    f"_ranks{args.ranks}"
                cost = measure(order, size, args.out / name, args)
                print(f"{name}: {cost.elements} elements, {cost.unknowns} "
                      f"unknowns, error {100 * cost.error:.3g} %, "
                      f"{cost.processor_seconds:.0f} s of processors, "
                      f"{cost.seconds:.0f} s", flush=True)
                costs.append(cost)
                write_table(costs, args.out / "accuracy.csv")
                draw(costs, args.out / "accuracy.png")
    except (OutputError, OSError) as error:
        print(f"plot_accuracy.py: error: {error}", file=sys.stderr)
        return 1
    print(f"wrote {args.out / 'accuracy.csv'} and accuracy.png")
    return 0


if __name__ == "__main__":
    sys.exit(main())
