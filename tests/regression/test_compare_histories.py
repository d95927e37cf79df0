#!/usr/bin/env python3
# processors: 1
"""scripts/compare_histories.py: builds that agree, that differ, that fail.

A build that differs is a script that starts the same program with another
material.
"""

from __future__ import annotations

import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "support"),
                str(HERE.parents[1] / "scripts" / "lib")]
sys.dont_write_bytecode = True

import histories  # noqa: E402
from program_checks import PROGRAMS, SOURCE, check, finish  # noqa: E402

SYNOVIA = PROGRAMS / "synovia"


def compare(*arguments: str | pathlib.Path) -> tuple[int, str]:
    run = subprocess.run(
        [sys.executable, SOURCE / "scripts" / "compare_histories.py",
         *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        text=True)
    return run.returncode, run.stdout


def pretender(folder: pathlib.Path, name: str, body: str) -> pathlib.Path:
    file = folder / name
    file.write_text(f"#!/bin/sh\n{body}\n")
    file.chmod(0o755)
    return file


def programs(folder: pathlib.Path) -> None:
    case = ("--cases", "two_columns", "--steps", "2", "--ranks", "1")
    status, text = compare(SYNOVIA, SYNOVIA, *case, "--repeat", "2")
    check(status == 0 and "1 of 1 cases agree" in text,
          "a build agrees with itself")
    row = next(line.split() for line in text.splitlines()
               if line.startswith("two_columns"))
    check(row[1] == "2" and int(row[2]) > 20 and float(row[4]) > 0
          and float(row[5]) > 0 and row[-1] == "ok",
          f"steps, columns and times are listed: {' '.join(row)}")

    softer = pretender(folder, "softer",
                       f'exec {SYNOVIA} "$@" --set material.0.solid.E=0.5416')
    status, text = compare(SYNOVIA, softer, *case)
    check(status == 1 and "0 of 1 cases agree; these don't: two_columns"
          in text, "another material is noticed")
    check("of its largest value" in text and "reaction." in text,
          "columns that differ are named")
    status, text = compare(SYNOVIA, softer, *case, "--tolerance", "0.1")
    check(status == 0, "a tolerance may be given")

    fails = pretender(folder, "fails", "echo error: no memory; exit 3")
    status, text = compare(SYNOVIA, fails, *case)
    check(status == 1 and "FAILED" in text and "no memory" in text,
          "a run that fails is told with its error")
    for arguments, complaint in (
            ((SYNOVIA, folder / "none"), "there is no program"),
            ((SYNOVIA, SYNOVIA, "--cases", "elbow"),
             "there is no case 'elbow'; there are confined_compression"),
            ((SYNOVIA, SYNOVIA, "--steps", "0"),
             "--steps must be at least 1")):
        status, text = compare(*arguments)
        check(status == 2 and complaint in text, complaint)


def columns() -> None:
    old = {"t": [1.0, 2.0], "force_x": [0.0, 1e-9], "force_y": [2.0, 4.0],
           "outflow": [1e-20, -1e-20], "pair.penetration": [1e-6, 1e-7],
           "solver.newton": [3.0, 4.0], "solver.seconds": [1.0, 1.0]}
    new = {name: list(values) for name, values in old.items()}
    new["outflow"] = [5e-20, 0.0]
    new["pair.penetration"] = [0.0, 0.0]
    new["solver.newton"] = [3.0, 5.0]
    new["force_x"] = [0.0, 3e-9]
    new["added"] = [0.0, 0.0]
    found = histories.compare(old, new)
    check(set(found.differences) == {"t", "force_x", "force_y"},
          "round-off and remainders don't count")
    check(abs(found.differences["force_x"] - 2e-9 / 4.0) < 1e-15,
          "components are relative to their vector")
    check(found.work == [("solver.newton", 7.0, 8.0)]
          and found.added == ["added"] and not found.errors,
          "other work and new columns are told")
    new["force_y"] = [2.0, float("nan")]
    check(histories.compare(old, new).beyond(1.0)[0][0] == "force_y",
          "what is no number differs")
    del new["force_y"]
    check(histories.compare(old, new).errors
          == ["columns are missing: force_y"], "missing columns are errors")
    check(histories.compare(old, {"t": [1.0]}).errors[-1]
          == "2 steps became 1", "missing steps are errors")


def main() -> None:
    columns()
    with tempfile.TemporaryDirectory() as folder:
        programs(pathlib.Path(folder))
    finish()


if __name__ == "__main__":
    main()
