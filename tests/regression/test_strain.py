#!/usr/bin/env python3
"""What a run says of its strains.

Requirements: the history has the largest principal strain and the smallest det
F of each step; a run whose strains pass 10 % warns once, with value, region,
place and time, in its output and its log; one whose strains stay below is
silent; the last line names both extremes; all of it is the same on any number
of ranks.
"""

from __future__ import annotations

import pathlib
import re
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.dont_write_bytecode = True

from program_checks import (  # noqa: E402
    MPIEXEC, PROGRAMS, SOURCE, check, finish, history, make_mesh, run_program)

CASE = SOURCE / "miniapps" / "cases" / "two_columns.toml"
EXTREME = r'(-?[\d.]+) in region "(\w+)" at \(([-\d., e]+)\)'
WARNING = (rf"at t = ([\d.]+) the largest principal strain is {EXTREME} and "
           rf"the smallest det F {EXTREME}, as meshed: beyond a strain of 0\.1 "
           r"or a det F of 0\.5 linear theory is no longer valid there")
SUMMARY = (rf"largest principal strain {EXTREME}, t = ([\d.]+); smallest det F "
           rf"{EXTREME}, t = ([\d.]+)")


class Run:
    def __init__(self, directory: pathlib.Path, mesh: pathlib.Path, ranks: int,
                 travel: float) -> None:
        output = directory / f"{ranks}-{travel}"
        self.printed = run_program(
            MPIEXEC, "-n", str(ranks), PROGRAMS / "synovia", CASE, "--output",
            output, "--set", f'mesh.file="{mesh}"', "--set", "time.step=100",
            "--set", "time.end=500", "--set",
            'boundary.3.displacement=["free", "free", {times = [0, 500], '
            f"values = [0, {travel}]}}]", text=f"{travel} mm, {ranks} ranks")
        self.log = (output / "run.log").read_text()
        self.rows = history(output)

    @property
    def warnings(self) -> list[str]:
        return [line for line in self.printed.splitlines()
                if line.startswith("warning: ") and "strain" in line]


def check_history(rows: list[dict[str, float]]) -> None:
    strains = [row["strain.max_principal"] for row in rows]
    ratios = [row["strain.min_det_F"] for row in rows]
    check(strains == sorted(strains, reverse=True) and strains[0] < 0,
          f"compression grows to {strains[-1]:.4f}")
    # The columns are confined: only the strain along z is not zero.
    worst = max(abs(1 + strain - ratio)
                for strain, ratio in zip(strains, ratios))
    check(worst < 1e-6, f"det F is 1 plus the strain to {worst:.1e}")


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        mesh = directory / "two_columns.msh"
        make_mesh("boxes.py", mesh, "two_columns")

        small = Run(directory, mesh, 1, -0.02)
        check(not small.warnings, "strains below 10 % give no warning")
        check_history(small.rows)
        last = small.printed.rstrip().splitlines()[-1]
        check(re.fullmatch(SUMMARY, last) is not None, last)

        runs = [Run(directory, mesh, ranks, -0.3) for ranks in (1, 2, 3)]
        for run in runs:
            check(len(run.warnings) == 1, "strains beyond 10 % warn once")
            found = re.search(WARNING, run.warnings[0])
            check(found is not None, run.warnings[0])
            time, strain, region = found.groups()[:3]
            row = next(row for row in run.rows
                       if abs(row["strain.max_principal"]) > 0.1)
            check(float(time) == row["t"] and abs(
                float(strain) / row["strain.max_principal"] - 1) < 1e-4,
                f"the warning is that of the first such step, in {region}")
            check(run.warnings[0] in run.log, "the log has it too")
            check_history(run.rows)
            last = run.printed.rstrip().splitlines()[-1]
            check(re.match(SUMMARY + ": beyond linear theory", last)
                  is not None and last in run.log, last)
            check(run.warnings == runs[0].warnings,
                  "warnings don't depend on the ranks")
    finish()


if __name__ == "__main__":
    main()
