#!/usr/bin/env python3
# processors: 2
"""Linear iterations of finite deformation beside infinitesimal ones.

Requirements: along each axis both deformations are run, with contact and
without, on the same mesh; runs that are there are not made again; a ratio above
the limit, and a run that fails, is an exit status of 1 and said.
"""

from __future__ import annotations

import csv
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.dont_write_bytecode = True

from program_checks import (  # noqa: E402
    MPIEXEC, PROGRAMS, SOURCE, check, finish)

AXES = {"size", "permeability", "step", "poisson", "jump", "penalty", "strong",
        "weak"}


def deformations(out: pathlib.Path, *arguments: object
                 ) -> subprocess.CompletedProcess:
    return subprocess.run(
        [sys.executable, SOURCE / "scripts/deformations.py", "--quick",
         "--launcher", f"{MPIEXEC} -n", "--program", PROGRAMS / "scaling",
         "--output", out, *map(str, arguments)],
        text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def table(out: pathlib.Path) -> list[list[str]]:
    lines = (out / "deformations.md").read_text(encoding="utf-8").splitlines()
    return [[cell.strip() for cell in line.strip("|").split("|")]
            for line in lines[2:]]


def check_runs(out: pathlib.Path) -> None:
    run = deformations(out, "--compression", 0.1, "--limit", 2)
    check(run.returncode == 0 and "0 failed, 0 with" in run.stdout,
          f"it runs: {run.stdout[-2000:]}")
    rows = table(out)
    check({row[0] for row in rows} == AXES, "all axes have rows")
    check({"contact", "no contact"} <= {row[1] for row in rows},
          "with contact and without")
    for row in rows:
        linear, finite = (float(cell.split(",")[0]) for cell in row[4:6])
        check(0.3 < linear < 10 and abs(float(row[6]) - finite / linear) < 0.02,
              f"{row[:3]}: {linear} and {finite} iterations for a decade")
    with open(out / "deformations.csv", newline="", encoding="utf-8") as file:
        made = list(csv.DictReader(file))
    kinds = [row["run"].split("deformation=")[1].split()[0] for row in made]
    check(kinds.count("finite") == kinds.count("infinitesimal") > 10,
          f"{len(made)} runs of both kinds")
    check({row["steps"] for row in made} == {"6"}, "of six steps")
    first = deformations(out, "--compression", 0.1, "--limit", 2,
                         "--order", 1)
    check(first.returncode == 0 and " order=1 " in first.stdout
          and " order=2 " not in first.stdout,
          "other axes of order 1; that of sizes is there")
    check({row[3] for row in table(out) if row[0] == "poisson"}
          != {row[3] for row in rows if row[0] == "poisson"},
          "with other meshes")
    again = deformations(out, "--compression", 0.1, "--limit", 0.5)
    check(again.returncode == 1 and "0/" not in again.stdout
          and "with a ratio above 0.5" in again.stdout
          and ", 0 with" not in again.stdout,
          "a ratio above the limit is an error, and nothing is run again")


def check_failures(out: pathlib.Path) -> None:
    run = deformations(out, "--compression", 0.1, "--timeout", 1e-3)
    check(run.returncode == 1 and "failed: more than 0.001 s" in run.stdout
          and "0 failed" not in run.stdout, "runs that fail are said")


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        check_runs(pathlib.Path(name) / "out")
        check_failures(pathlib.Path(name) / "failed")
    finish()


if __name__ == "__main__":
    main()
