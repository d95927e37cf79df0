#!/usr/bin/env python3
"""The knee in gait, a coarse one, through the load and the first flexion, on two
ranks.

Requirements: the femur flexes as prescribed, in a step that gives its freedoms
anew, with a curve that repeats; forces are in balance, of the femur and of each
pair; no element is inverted; menisci bear a part of the load, and so does the
fluid.
"""

from __future__ import annotations

import pathlib
import sys
import tempfile

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parents[1] / "support"),
                str(pathlib.Path(__file__).resolve().parent)]
sys.dont_write_bytecode = True

import numpy as np  # noqa: E402

from program_checks import (  # noqa: E402
    MPIEXEC, PROGRAMS, SOURCE, check, finish, history, make_mesh, run_program)
from test_knee_body_weight import check_balance, check_knee  # noqa: E402

CASE = SOURCE / "miniapps" / "cases" / "knee_stance.toml"
LOADED, FLEXED = 0.2, 0.4   # s
BEGIN, TURNED = 0.087266, 0.16  # flexion, rad
FIRST, SECOND = 8.0, 14.0   # force, N


def check_row(row: dict[str, float]) -> None:
    t = row["t"]
    check_balance(row, np.interp(t, [0, LOADED, FLEXED], [0, FIRST, SECOND]))
    flexion = np.interp(t, [0, LOADED, FLEXED], [0, BEGIN, TURNED])
    off = abs(row["rigid_body.femur.rotation_x"] - flexion)
    # The femur may also turn about its other axes.
    check(off <= 1e-3 * flexion, f"it is flexed by {flexion:.3f} rad, "
          f"{off:.1e} off")
    check_knee(row)


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        make_mesh("knee_parametric.py", directory / "knee.msh", "--size", "4")
        period = FLEXED - LOADED
        curve = f"times = [0, {period}, {2 * period}], repeat = 3, values = "
        run_program(
            MPIEXEC, "-n", "2", PROGRAMS / "synovia", CASE, "--output",
            directory / "out", "--set", f'mesh.file="{directory}/knee.msh"',
            "--set", "time.step=0.1", "--set",
            f"rigid_body.femur.force=[0, 0, {{times = [0, {LOADED}], "
            f"values = [0, {-FIRST}]}}]",
            "--set", f"step.gait.duration={period}",
            "--set", "step.gait.rigid_body.femur.force=[0, 0, "
            f"{{{curve}[{-FIRST}, {-SECOND}, {-FIRST}]}}]",
            "--set", "step.gait.rigid_body.femur.rotation=["
            f'{{{curve}[{BEGIN}, {TURNED}, {BEGIN}]}}, "free", "free"]',
            "--set", "output.fields_every=0")
        rows = history(directory / "out")
        check(abs(rows[-1]["t"] - FLEXED) < 1e-9, "the run goes to its end")
        for row in rows:
            check_row(row)
    finish()


if __name__ == "__main__":
    main()
