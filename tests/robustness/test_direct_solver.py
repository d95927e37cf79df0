#!/usr/bin/env python3
"""Factorizations by either library, and those that memory does not suffice for.

Requirements: solver.direct = "umfpack" comes to the results of "mumps" on one
rank, and on more is refused before anything runs; a factorization that needs
more memory than solver.direct_memory_limit ends the run, after cut-backs, with
how much is missing and with the last good state saved, from which the run goes
on with a higher limit to the results of a run without one; a single one that
fails is cut back, and the run goes on to its end.
"""

from __future__ import annotations

import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.dont_write_bytecode = True

from program_checks import (  # noqa: E402
    MPIEXEC, PROGRAMS, SOURCE, WITHOUT_WAITING, check, finish, history,
    make_mesh)

STEP, HALF, END = 20.0, 100.0, 200.0
FORCE = "contact.columns.force_z"


class Case:
    """Two columns in contact, on a coarse mesh."""

    def __init__(self, directory: pathlib.Path) -> None:
        self.mesh = directory / "two_columns.msh"
        make_mesh("boxes.py", self.mesh, "two_columns", "--size", "2")

    def run(self, output: pathlib.Path, *more: str, ranks: int = 1,
            end: float = END, failing: int = 0) -> subprocess.CompletedProcess:
        """With @a failing, this factorization fails, counted from 1."""
        fault = ["env", f"FAILING_FACTORIZATION={failing}",
                 f"LD_PRELOAD={os.environ['FAILING_FACTORIZATION_LIBRARY']}"]
        return subprocess.run(
            [MPIEXEC, "-n", str(ranks), *(fault if failing else ()),
             PROGRAMS / "synovia",
             SOURCE / "miniapps/cases/two_columns.toml",
             "--set", f'mesh.file="{self.mesh}"',
             "--set", f"time.step={STEP}", "--set", f"time.end={end}",
             "--set", 'time.scheme="backward_euler"',
             "--set", "output.checkpoint_every=1",
             "--set", "output.fields_every=0", "--set", "output.line=[]",
             "--output", output, *more],
            text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            env=os.environ | WITHOUT_WAITING)


def same(some: pathlib.Path, others: pathlib.Path) -> float:
    """Largest difference of the forces, relative to the largest force."""
    a, b = history(some), history(others)
    check([row["t"] for row in a] == [row["t"] for row in b],
          f"{len(a)} steps, at the same times")
    largest = max(abs(row[FORCE]) for row in b)
    return max(abs(x[FORCE] - y[FORCE]) for x, y in zip(a, b)) / largest


def test_libraries(case: Case, directory: pathlib.Path) -> None:
    for library in ("mumps", "umfpack"):
        run = case.run(directory / library, "--set",
                       f'solver.direct="{library}"')
        check(run.returncode == 0, f"{library}: runs on one rank")
    difference = same(directory / "umfpack", directory / "mumps")
    check(difference < 1e-7, f"same forces: {difference:.1e}")
    refused = directory / "refused"
    run = case.run(refused, "--set", 'solver.direct="umfpack"', ranks=2)
    check(run.returncode == 1 and not refused.exists(),
          "umfpack on two ranks: refused before anything runs")
    check("solver.direct: UMFPACK works on one rank, and there are 2: run on "
          "one, or use MUMPS" in run.stdout, run.stdout.strip())


def test_memory(case: Case, directory: pathlib.Path, ranks: int) -> None:
    whole, parts = directory / f"whole{ranks}", directory / f"parts{ranks}"
    check(case.run(whole, ranks=ranks).returncode == 0, f"{ranks} ranks: runs")
    check(case.run(parts, ranks=ranks, end=HALF).returncode == 0, "half of it")
    too_little = ("--resume", "--set", "solver.direct_memory_limit=1")
    run = case.run(parts, *too_little, "--set", "time.cut_back=false",
                   ranks=ranks)
    check(run.returncode == 1, "with too little memory it fails")
    for part in (f"the step from t = {HALF:g} with dt = {STEP:g} failed: "
                 "MUMPS could not factorize the matrix (",
                 " unknowns): it needs about ", " MB on a rank, ",
                 " MB more than direct_memory_limit (1 MB) allows; what came "
                 "before is in '"):
        check(part in run.stdout, f"says: {part.strip()}")
    check(history(parts)[-1]["t"] == HALF, "nothing is lost")
    run = case.run(parts, "--resume", "--set",
                   "solver.direct_memory_limit=4000", ranks=ranks)
    check(run.returncode == 0, "with more it goes on")
    difference = same(parts, whole)
    check(difference < 1e-7, f"same forces: {difference:.1e}")

    cut = directory / f"cut{ranks}"
    check(case.run(cut, ranks=ranks, end=HALF).returncode == 0, "half of it")
    run = case.run(cut, *too_little, ranks=ranks)
    check(run.returncode == 1 and " allows (tried 11 times; a step is not cut "
          "below min_step = 0.02); what came before is in '" in run.stdout,
          "the step is cut back until it fails for good")
    check(case.run(cut, "--resume", ranks=ranks).returncode == 0
          and history(cut)[-1]["t"] == END, "without a limit it goes on")


def test_recovery(case: Case, directory: pathlib.Path, ranks: int) -> None:
    """A factorization that fails once, where the second half begins."""
    failed = directory / f"failed{ranks}"
    check(case.run(failed, ranks=ranks, end=HALF).returncode == 0,
          "half of it")
    run = case.run(failed, "--resume", ranks=ranks, failing=1)
    check(run.returncode == 0, f"{ranks} ranks: runs to its end")
    tries = re.findall(r" t (\S+)  dt (\S+) .* failed tries (\d+)",
                       (failed / "run.log").read_text())
    check(tries == [(f"{HALF + STEP / 2:g}", f"{STEP / 2:g}", "1")],
          f"one step was cut back, after one try: {tries}")
    # The same steps without a fault: they end where a line is asked for.
    whole = directory / f"halved{ranks}"
    check(case.run(whole, "--set", 'output.line=[{name = "stop", '
                   "from = [0.15, 0.15, 0], to = [0.15, 0.15, 0.75], "
                   f"times = [{HALF + STEP / 2}, {HALF + STEP}]}}]",
                   ranks=ranks).returncode == 0, "without a fault")
    difference = same(failed, whole)
    check(difference < 1e-7, f"same forces: {difference:.1e}")


def test_estimate(case: Case, directory: pathlib.Path) -> None:
    """The columns that a kept factorization collects count."""
    run = case.run(directory / "checked", "--check", "--set",
                   "solver.renew_after=100000")
    found = re.search(r": (\d+) displacements, (\d+) pressures on 1 rank, "
                      r"about ([\d.]+) GB", run.stdout)
    check(found is not None, "--check says how much memory it takes")
    unknowns, gigabytes = int(found[1]) + int(found[2]), float(found[3])
    columns = 8e-9 * 10 * 100000 * unknowns
    check(columns < gigabytes < 1.1 * columns + 0.2,
          f"{gigabytes} GB, of which columns take {columns:.1f}")


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        case = Case(directory)
        test_estimate(case, directory)
        test_libraries(case, directory)
        for ranks in (1, 2):
            test_memory(case, directory, ranks)
            test_recovery(case, directory, ranks)
    finish()


if __name__ == "__main__":
    main()
