#!/usr/bin/env python3
# processors: 1
"""A load that bodies in contact can't bear.

Requirements: a run of finite deformation ends with the last good state saved,
and says which element can't follow, where, and why; from that state a run with
another load goes on.
"""

from __future__ import annotations

import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.dont_write_bytecode = True

from program_checks import (  # noqa: E402
    PROGRAMS, SOURCE, check, finish, history, make_mesh)

END = 1000.0
# With a fraction of solid of 0.5, pores are closed once the two columns of
# 0.75 mm each are half as high.
TOO_MUCH, CLOSED = -1.2, -0.75
REASON = re.compile(
    r"the step from t = (?P<time>[0-9.]+) with dt = [0-9.e-]+ failed: "
    r"the body has no pores left, as its solid fraction is 0\.5 at "
    r"\([^)]+\), as meshed, in element \d+ of \"(upper|lower)\": "
    r"det F = 0\.\d+.* "
    r"\(tried \d+ times; a step is not cut below min_step = 5\); "
    r"what came before is in '(?P<file>[^']+checkpoint_\d+\.h5)'")


def run(mesh: pathlib.Path, output: pathlib.Path, top: str,
        *more: str) -> subprocess.CompletedProcess:
    settings = [
        f'mesh.file="{mesh}"', 'physics.deformation="finite"',
        'material.0.solid={model="neo_hookean", E=0.5417, nu=0.0833}',
        "material.0.solid_fraction=0.5",
        f'boundary.upper_top.displacement=["free", "free", {top}]',
        'time.scheme="backward_euler"', f"time.end={END}", "time.step=50",
        "time.min_step=5", "output.fields_every=0", "output.line=[]"]
    return subprocess.run(
        [PROGRAMS / "synovia", SOURCE / "miniapps/cases/two_columns.toml",
         *(word for setting in settings for word in ("--set", setting)),
         "--output", output, *more], stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, text=True)


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        mesh = directory / "two_columns.msh"
        make_mesh("boxes.py", mesh, "two_columns", "--size", "2")
        output = directory / "out"
        result = run(mesh, output,
                     f"{{times=[0, {END}], values=[0, {TOO_MUCH}]}}")
        said = REASON.search(result.stdout)
        if not said:
            print(result.stdout)
        check(result.returncode != 0, "the run fails")
        check(said is not None, "it says which element, where and why")
        rows = history(output)
        last = rows[-1]
        reached = TOO_MUCH * last["t"] / END
        check(last["t"] == float(said["time"])
              and 0.8 * CLOSED > reached > CLOSED,
              f"the last good state is of t = {last['t']:g}, at {reached:g} mm")
        check(last["contact.columns.force_z"] < 0.0
              and 0.5 < last["strain.min_det_F"] < 0.6,
              f"columns in contact, and det F > {last['strain.min_det_F']:g}")
        back = (f"{{times=[{last['t']}, {END}], values=[{reached}, 0]}}")
        result = run(mesh, directory / "back", back, "--restart", said["file"])
        if result.returncode != 0:
            print(result.stdout)
        after = history(directory / "back")
        check(result.returncode == 0 and after[0]["t"] > last["t"]
              and after[-1]["t"] == END
              and after[-1]["strain.min_det_F"] > 0.8,
              "from there a run that takes the load off gets to its end")
    finish()


if __name__ == "__main__":
    main()
