#!/usr/bin/env python3
"""Runs two builds of the case driver on short versions of the shipped cases,
one after the other, and compares their histories.

Each column is compared relative to its largest value, components of a vector
relative to that of the vector. Columns that are zero but for round-off don't
count, nor those that say how well the equations are solved (force_error,
moment_error, penetration, pressure_jump, volume_balance) or what work it took
(solver.*): where these differ it is said. Exits with 1 if a case differs by
more than the tolerance, or fails.
"""

from __future__ import annotations

import argparse
import csv
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import tomllib
from dataclasses import dataclass, field

SCRIPTS = pathlib.Path(__file__).resolve().parent
ROOT = SCRIPTS.parent
CASES = ROOT / "miniapps" / "cases"
sys.path.insert(0, str(SCRIPTS / "lib"))

import histories  # noqa: E402
import machine  # noqa: E402
from histories import Comparison  # noqa: E402

# As coarse as the tests have them; other cases keep their meshes.
SIZES = {"glenohumeral": 2.5, "glenohumeral_hexahedra": 2.5, "hertz": 1.5,
         "indentation": 3, "indentation_hexahedra": 3, "knee": 4,
         "meniscus_ring": 1.8}
# The image of a real knee has to be downloaded.
INSTEAD = {"knee_from_segmentation.py": "knee_parametric.py"}
# Lengths of steps, where the case's are so short that little happens in a few.
STEPS = {"knee": 25.0}
# Accuracy of the linear solver, and what remains of it in a history.
TOLERANCES = {"direct": 1e-10, "block_amg": 1e-5, "auto": 1e-10}


class Failure(Exception):
    """Says what can't be run."""


@dataclass
class Settings:
    """What the runs of all cases have in common."""

    programs: tuple[pathlib.Path, pathlib.Path]
    launcher: list[str]
    ranks: int
    steps: int
    repeat: int
    solver: str
    own_meshes: bool
    folder: pathlib.Path


@dataclass
class Result:
    """Of one case, old and new; the times (s) are the least of all runs."""

    comparison: Comparison
    seconds: list[float] = field(default_factory=lambda: [float("inf")] * 2)


def shipped() -> list[str]:
    return sorted(file.stem for file in CASES.glob("*.toml"))


def read_case(case: str) -> dict:
    return tomllib.loads((CASES / f"{case}.toml").read_text(encoding="utf-8"))


def make_mesh(case: str, settings: Settings) -> pathlib.Path:
    """By the case's generator, in a file of its own."""
    script, *arguments = read_case(case)["mesh"]["generator"]
    script = INSTEAD.get(script, script)
    if case in SIZES and not settings.own_meshes:
        arguments += ["--size", str(SIZES[case])]
    mesh = settings.folder / f"{case}.msh"
    run = subprocess.run(
        [sys.executable, ROOT / "meshes" / script, *arguments, "-o", mesh],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if run.returncode != 0:
        raise Failure(f"{script} made no mesh: {run.stdout.strip()}")
    return mesh


def run_case(case: str, program: pathlib.Path, mesh: pathlib.Path,
             settings: Settings) -> histories.History:
    output = settings.folder / "out"
    step = STEPS.get(case, read_case(case)["time"]["step"])
    overrides = [f'mesh.file="{mesh}"', f"time.step={step!r}"]
    if "step" not in read_case(case):   # which end when they say
        overrides.append(f"time.end={settings.steps * step!r}")
    overrides += [f'solver.linear="{settings.solver}"',
                  "output.fields_every=0", "output.checkpoint_every=0"]
    command = [*settings.launcher, str(settings.ranks), str(program),
               str(CASES / f"{case}.toml"), "--output", str(output),
               "--overwrite"]
    for override in overrides:
        command += ["--set", override]
    run = subprocess.run(command, stdout=subprocess.PIPE,
                         stderr=subprocess.STDOUT, text=True)
    if run.returncode != 0:
        lines = [line for line in run.stdout.splitlines() if "error" in line]
        raise Failure(f"{program}: exit status {run.returncode}: "
                      + (lines or ["it says no error"])[0])
    with open(output / "history.csv", encoding="utf-8") as file:
        return histories.read(csv.DictReader(file))


def compare_case(case: str, settings: Settings) -> Result:
    """Runs old and new in turns, the other first the next time."""
    mesh = make_mesh(case, settings)
    result = None
    for i in range(settings.repeat):
        found = {}
        for which in (0, 1) if i % 2 == 0 else (1, 0):
            found[which] = run_case(case, settings.programs[which], mesh,
                                    settings)
        if result is None:
            result = Result(histories.compare(found[0], found[1]))
        for which, history in found.items():
            result.seconds[which] = min(result.seconds[which],
                                        histories.seconds(history))
    return result


def report(case: str, result: Result, tolerance: float) -> bool:
    """Prints the case's lines; says whether the histories agree."""
    comparison = result.comparison
    worst, column = comparison.worst()
    good = worst <= tolerance and not comparison.errors
    old, new = result.seconds
    print(f"{case:24} {comparison.rows:5} {comparison.columns:7} {worst:10.1e} "
          f"{old:8.2f} {new:8.2f} {new / old:6.2f}  "
          f"{'ok' if good else 'DIFFERS'}")
    for error in comparison.errors:
        print(f"   {error}")
    for name, difference in comparison.beyond(tolerance):
        print(f"   {name}: {difference:.1e} of its largest value")
    if not good and not comparison.errors:
        print(f"   worst: {column}")
    if comparison.added:
        print(f"   new columns: {', '.join(comparison.added)}")
    if comparison.work:
        print("   other work: " + ", ".join(
            f"{name} {a:g} -> {b:g}" for name, a, b in comparison.work))
    sys.stdout.flush()
    return good


def parse(arguments: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="compare_histories", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old", metavar="OLD_PROGRAM", type=pathlib.Path)
    parser.add_argument("new", metavar="NEW_PROGRAM", type=pathlib.Path)
    parser.add_argument("--cases", default=",".join(shipped()),
                        help="separated by commas (default: all)")
    parser.add_argument("--solver", choices=sorted(TOLERANCES),
                        default="direct", help="(default: %(default)s)")
    parser.add_argument("--steps", type=int, default=6,
                        help="of each run (default: %(default)s)")
    parser.add_argument("--ranks", type=int, default=2,
                        help="(default: %(default)s)")
    parser.add_argument("--repeat", type=int, default=1,
                        help="how often each build runs each case; the least "
                        "time counts (default: %(default)s)")
    parser.add_argument("--own-meshes", action="store_true",
                        help="as fine as the cases have them, for times")
    parser.add_argument("--tolerance", type=float,
                        help="(default: " + ", ".join(
                            f"{value:g} with {name}" for name, value
                            in TOLERANCES.items()) + ")")
    options = parser.parse_args(arguments)
    for program in (options.old, options.new):
        if not os.access(program, os.X_OK) or program.is_dir():
            parser.error(f"there is no program '{program}'")
    options.cases = options.cases.split(",")
    for case in options.cases:
        if case not in shipped():
            parser.error(f"there is no case '{case}'; there are "
                         + ", ".join(shipped()))
    for name in ("steps", "ranks", "repeat"):
        if getattr(options, name) < 1:
            parser.error(f"--{name} must be at least 1")
    return options


def main(arguments: list[str]) -> int:
    options = parse(arguments)
    tolerance = options.tolerance or TOLERANCES[options.solver]
    programs = (options.old.resolve(), options.new.resolve())
    launcher = shlex.split(os.environ.get("MPIEXEC", "mpirun")) + ["-n"]
    print(f"old: {programs[0]}\nnew: {programs[1]}\n"
          f"{machine.processor()}, {options.ranks} ranks, {options.steps} "
          f"steps, solver {options.solver}, tolerance {tolerance:g}")
    print(f"{'case':24} {'steps':>5} {'columns':>7} {'difference':>10} "
          f"{'old s':>8} {'new s':>8} {'ratio':>6}", flush=True)
    bad = []
    with tempfile.TemporaryDirectory() as folder:
        settings = Settings(programs, launcher, options.ranks, options.steps,
                            options.repeat, options.solver,
                            options.own_meshes, pathlib.Path(folder))
        for case in options.cases:
            try:
                if not report(case, compare_case(case, settings), tolerance):
                    bad.append(case)
            except Failure as failure:
                print(f"{case:24} FAILED: {re.sub(r' +', ' ', str(failure))}",
                      flush=True)
                bad.append(case)
    print(f"{len(options.cases) - len(bad)} of {len(options.cases)} cases agree"
          + (f"; these don't: {', '.join(bad)}" if bad else ""))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
