#!/usr/bin/env python3
"""Runs of finite deformation that are killed, and go on.

Requirements: a run with contact that slides, one that rubs and one with a free
rigid body and ligaments are killed by SIGKILL halfway, and go on from their
checkpoints to the history of the whole run, on as many ranks and on others: to
1e-10 where both solve every system to the end, and to 1e-6 by default.
"""

from __future__ import annotations

import pathlib
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.dont_write_bytecode = True

from killed_runs import kill, wait_for  # noqa: E402
from program_checks import (  # noqa: E402
    MPIEXEC, PROGRAMS, SOURCE, check, finish, history, make_mesh)

RANKS, OTHER_RANKS = 2, 3
BETWEEN = 3
# A run that goes on has other factors than the whole one had by then: a system
# that isn't solved to the end leaves something else of itself and of the gaps.
# What these leave is less than what is asked for.
SOLVED = ("solver.tolerance=1e-12",
          "solver.tuning.newton.kept_tangent=0",
          "solver.tuning.newton.largest_forcing=1e-6",
          "solver.tuning.newton.final_accuracy=1e-3",
          "solver.tuning.contact.drift_of_tolerance=0",
          "solver.tuning.contact.drift_of_gap=0",
          "solver.tuning.contact.drift_of_area=0",
          "contact.indenter-cartilage.gap_tolerance=1e-11",
          "contact.indenter-cartilage.pressure_tolerance=1e-10")
BY_DEFAULT, IF_SOLVED = 1e-6, 1e-10
# Columns of work and of errors are no results.
NO_RESULTS = ("solver.", "_error", "volume_balance", "penetration",
              ".pressure_jump")
ANGLES = ("flexion", "abduction", "internal_rotation")
FLOWS = ("fluid_exchange", "growth", "outflow")
WAYS = ("lateral", "anterior", "distraction")


@dataclass
class Case:
    file: str
    mesh: tuple[str, ...]
    settings: tuple[str, ...]
    tolerance: float = BY_DEFAULT

    @property
    def name(self) -> str:
        return self.file + ("_solved" if self.tolerance == IF_SOLVED else "")

    def command(self, directory: pathlib.Path, ranks: int,
                output: pathlib.Path, *more: str) -> list:
        settings = (f'mesh.file="{directory / self.name}.msh"',
                    f"output.checkpoint_every={BETWEEN}",
                    "output.fields_every=0", *self.settings)
        return [MPIEXEC, "-n", str(ranks), PROGRAMS / "synovia",
                SOURCE / f"miniapps/cases/{self.file}.toml",
                *(word for setting in settings
                  for word in ("--set", setting)), "--output", output, *more]


INDENTATION = ("space.order=1", "time.end=300", "output.line=[]")

CASES = (
    Case("indentation_finite", ("indentation.py", "--size", "4"), INDENTATION),
    Case("indentation_finite", ("indentation.py", "--size", "4"),
         INDENTATION + SOLVED, IF_SOLVED),
    Case("friction_plate", ("boxes.py", "column_on_plate", "--size", "2"),
         ("time.end=0.5",)),
    Case("glenohumeral_ligaments",
         ("glenohumeral.py", "--full", "--hex", "--size", "4"),
         ("time.end=14",)),
)


def kind(column: str) -> str:
    """What a column is measured with: the vector of a component, the angles
    and the ways of a joint, the flows of fluid, reactions.
    """
    prefix, _, last = column.rpartition(".")
    if last in FLOWS:
        return "flow"
    if column.startswith("reaction."):
        return "reaction"
    if last in ANGLES + WAYS:
        return prefix + (".angles" if last in ANGLES else ".ways")
    return column[:-1] if column[-2:] in ("_x", "_y", "_z", ".x", ".y",
                                          ".z") else column


def difference(found: list[dict[str, float]],
               whole: list[dict[str, float]]) -> tuple[float, str]:
    """The largest one, in parts of the largest value of its kind."""
    columns = [column for column in whole[0]
               if not any(part in column for part in NO_RESULTS)]
    scale: dict[str, float] = {}
    for row in whole:
        for column in columns:
            scale[kind(column)] = max(scale.get(kind(column), 0.0),
                                      abs(row[column]))
    return max((max(abs(a[column] - b[column]) for a, b in zip(found, whole))
                / (scale[kind(column)] or 1.0), column) for column in columns)


def compare(output: pathlib.Path, whole: list[dict[str, float]],
            tolerance: float, text: str) -> None:
    found = history(output)
    check(len(found) == len(whole), f"{text}: each of {len(whole)} steps once")
    largest, column = difference(found, whole)
    check(largest <= tolerance, f"{text}: {column} differs most, by "
          f"{largest:.1e} of its largest")


def run(command: list, text: str) -> None:
    result = subprocess.run(command, text=True, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, timeout=600)
    if result.returncode != 0:
        print(result.stdout)
    check(result.returncode == 0, text)


def killed_and_resumed(case: Case, directory: pathlib.Path) -> None:
    make_mesh(case.mesh[0], directory / f"{case.name}.msh", *case.mesh[1:])
    output = directory / case.name
    run(case.command(directory, RANKS, output), f"{case.name}, undisturbed")
    whole = history(output)
    killed = directory / f"{case.name}_killed"
    process = subprocess.Popen(
        case.command(directory, RANKS, killed), text=True,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    wait_for(process, killed, whole[len(whole) // 2]["t"])
    kill(process)
    rows = len(history(killed))
    check(process.returncode != 0 and len(whole) // 2 < rows < len(whole),
          f"killed after {rows} of {len(whole)} steps")
    moved = directory / f"{case.name}_moved"
    shutil.copytree(killed, moved)
    for ranks, there in ((RANKS, killed), (OTHER_RANKS, moved)):
        run(case.command(directory, ranks, there, "--resume"),
            f"{case.name} goes on, on {ranks} ranks")
        compare(there, whole, case.tolerance, f"{case.name}, on {ranks} ranks")


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        for case in CASES:
            killed_and_resumed(case, pathlib.Path(name))
    finish()


if __name__ == "__main__":
    main()
