#!/usr/bin/env python3
"""A case of several steps as the program runs it.

Requirements: --check lists the steps; the history has all columns in all rows;
the end of each step is kept, to go on from with other steps; a run that is
killed or ended between steps and in them is resumed to the same results, on
another number of ranks.
"""

from __future__ import annotations

import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.dont_write_bytecode = True

from program_checks import (  # noqa: E402
    MPIEXEC, PROGRAMS, check, descendants, finish, history, make_mesh,
    run_program)

CASE = """
title = "Two columns in four steps"
[mesh]
file = "two_columns.msh"
[space]
order = 1
[[material]]
regions = ["lower", "upper"]
solid = {{model = "isotropic", E = 0.5417, nu = 0.0833}}
permeability = {{value = 4e-3}}
[[boundary]]
surfaces = "lower_bottom"
displacement = [0, 0, 0]
[[boundary]]
surfaces = ["lower_sides_x", "upper_sides_x"]
displacement = [0, "free", "free"]
[[boundary]]
surfaces = ["lower_sides_y", "upper_sides_y"]
displacement = ["free", 0, "free"]
[[boundary]]
name = "weight"
surfaces = "upper_top"
normal_traction = {{times = [0, 50], values = [0, -0.02]}}
pressure = 0
[[contact]]
name = "columns"
source = "upper_bottom"
destination = "lower_top"
[time]
step = 10
[[step]]
name = "creep"
duration = 100
[[step]]
name = "hold"
duration = {hold}
step = 20
[[step.boundary]]
name = "weight"
pressure = 0
relative = true
displacement = ["free", "free", 0]
[[step]]
name = "press"
duration = 50
[[step.boundary]]
name = "weight"
pressure = 0
relative = true
displacement = ["free", "free", {{times = [0, 50], values = [0, {press}]}}]
[[step]]
name = "lift"
duration = 50
release = ["weight"]
[[step.boundary]]
surfaces = "upper_top"
pressure = 0
displacement = ["free", "free", {{times = [0, 50], values = [-0.05, -0.03]}}]
[solver]
tolerance = 1e-10
[output]
directory = "{output}"
checkpoint_every = {every}
fields_every = 4
"""
END = 300.0
COLUMNS = ("contact.columns.force_z", "reaction.upper_top.z",
           "fluid.peak_pressure")


class Case:
    def __init__(self, directory: pathlib.Path) -> None:
        self.directory = directory
        make_mesh("boxes.py", directory / "two_columns.msh", "two_columns",
                  "--size", "2")

    def write(self, name: str, *, hold: float = 100, press: float = -0.02,
              every: int = 3) -> pathlib.Path:
        file = self.directory / f"{name}.toml"
        file.write_text(CASE.format(output=self.directory / name, hold=hold,
                                    press=press, every=every))
        return file

    def command(self, file: pathlib.Path, ranks: int, *more: str) -> list:
        return [MPIEXEC, "-n", str(ranks), PROGRAMS / "synovia", file, *more]

    def run(self, file: pathlib.Path, ranks: int, *more: str) -> str:
        return run_program(*self.command(file, ranks, *more),
                           text=f"{file.name} {' '.join(map(str, more))}")


def same(found: list[dict[str, float]], whole: list[dict[str, float]],
         text: str, tolerance: float = 1e-8) -> None:
    check([row["t"] for row in found] == [row["t"] for row in whole],
          f"{text}: each time step once, {len(found)} of them")
    for name in COLUMNS:
        scale = max(abs(row[name]) for row in whole)
        change = max(abs(a[name] - b[name]) for a, b in zip(found, whole))
        check(change <= tolerance * scale,
              f"{text}: {name} differs by {change / scale:.1e} of its largest")


def whole_run(case: Case) -> list[dict[str, float]]:
    file = case.write("whole")
    said = case.run(file, 1, "--check")
    check("\nsteps\n" in said and "without weight, upper_top" in said,
          "--check lists the steps, with what they change")
    said = case.run(file, 2)
    check('step "creep": from t = 0 to 100' in said
          and 'step "lift": from t = 250 to 300' in said,
          "the run says which step begins")
    check("never touched" not in said, "the pair that touched is not warned of")
    rows = history(case.directory / "whole")
    check([row["step"] for row in rows] == [1] * 10 + [2] * 5 + [3] * 5 + [4] * 5,
          "the history says which step it is")
    check(all(row["reaction.upper_top.z"] == 0 for row in rows[:10])
          and all(row["reaction.upper_top.z"] < 0 for row in rows[10:20]),
          "a reaction is 0 before there is a support")
    jump = abs(rows[10]["contact.columns.force_z"]
               / rows[9]["contact.columns.force_z"] - 1)
    check(jump < 0.4, f"the force goes on when the top is held, {jump:.2f}")
    cycles = {int(path.name.removeprefix("Cycle")) for path in
              (case.directory / "whole/fields/bodies").glob("Cycle*")}
    check(cycles == {4, 8, 12, 16, 20, 24} | {10, 15, 20, 25},
          "fields of every fourth time step, and of the ends")
    kept = sorted(path.name for path in
                  (case.directory / "whole/checkpoint").glob("step_*"))
    check(kept == [f"step_{name}.h5" for name in
                   ("creep", "hold", "lift", "press")],
          "the end of each step is kept")
    return rows


def killed(case: Case, whole: list[dict[str, float]]) -> None:
    file = case.write("killed", every=1)
    output = case.directory / "killed"
    for ranks, until in ((1, 30.0), (2, 100.0), (3, 160.0), (1, 260.0)):
        with open(os.devnull, "w") as nowhere:
            run = subprocess.Popen(case.command(file, ranks, "--resume"),
                                   stdout=nowhere, stderr=nowhere)
        while run.poll() is None:
            try:
                reached = history(output)[-1]["t"]
            except (OSError, IndexError, TypeError, ValueError):
                reached = 0.0
            if reached >= until:
                break
            time.sleep(0.005)
        for pid in [*descendants(run.pid), run.pid]:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        run.wait()
    case.run(file, 2, "--resume")
    same(history(output), whole, "killed in several steps and resumed")
    said = case.run(file, 1, "--resume")
    check("goes on from t = 300" in said, "at the end nothing is left to do")


def failing(case: Case) -> None:
    """In the first time step of a step."""
    file = case.write("failing")
    finite = ("--set", 'physics.deformation="finite"', "--set",
              'material.0.solid={model="neo_hookean", E=0.5417, nu=0.0833}')
    beyond = 'step.lift.boundary.0.displacement=["free", "free", -2]'
    result = subprocess.run(
        case.command(file, 2, *finite, "--set", beyond),
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    saved = case.directory / "failing/checkpoint/checkpoint_00000020.h5"
    check(result.returncode != 0 and "the step from t = 250 with" in result.stdout
          and f"what came before is in '{saved}'" in result.stdout,
          "a step that fails at its beginning names the end of the one before")
    check("begin up to 1.9" in result.stdout
          and "jump in the first time step" in result.stdout,
          "a displacement that jumps is warned of")
    said = case.run(file, 1, *finite, "--restart", saved)
    check("goes on from t = 250" in said
          and history(case.directory / "failing")[-1]["t"] == END,
          "from there it goes on with another step")


def from_any(case: Case, whole: list[dict[str, float]]) -> None:
    """From the end of a step, with another one after it."""
    other = case.write("other", press=-0.04)
    start = case.directory / "whole/checkpoint/step_hold.h5"
    said = case.run(other, 2, "--restart", start)
    check("changed: " in said and "step.2.boundary.0.displacement" in said
          and 'step "press": from t = 200 to 250' in said,
          "the restarted run says what has changed, and where it goes on")
    rows = history(case.directory / "other")
    check(rows[0]["t"] == 210.0 and rows[-1]["t"] == END,
          "it begins with the step after the one that had ended")
    ratio = (rows[4]["contact.columns.force_z"] - whole[14]["contact.columns.force_z"]) \
        / (whole[19]["contact.columns.force_z"] - whole[14]["contact.columns.force_z"])
    check(abs(ratio - 2) < 0.1, f"twice the way, {ratio:.3f} times the force")
    # In the same directory what came later goes.
    copy = case.directory / "copy"
    shutil.copytree(case.directory / "whole", copy)
    again = case.write("copy")
    case.run(again, 1, "--restart", copy / "checkpoint/step_creep.h5",
             "--set", "output.checkpoint_every=0")
    same(history(copy), whole, "from the end of the first step")
    kept = [path.name for path in (copy / "checkpoint").glob("step_*")]
    check(kept == ["step_creep.h5"], "what was kept of later steps is gone")
    refused = subprocess.run(
        case.command(case.write("whole", hold=60), 1, "--resume"),
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    check(refused.returncode != 0 and "step.1.duration: was 100.0, is 60.0"
          in refused.stdout, "a resumed run with another step is refused")


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        case = Case(pathlib.Path(name))
        whole = whole_run(case)
        killed(case, whole)
        from_any(case, whole)
        failing(case)
    finish()


if __name__ == "__main__":
    main()
