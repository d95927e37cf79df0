#!/usr/bin/env python3
"""Runs that are killed, interrupted, or run out of disk, and what is left.

Requirements: kill -9 at any moment costs at most the steps since the last
checkpoint, and the run goes on from there, on any number of ranks, to the same
results; Ctrl-C ends it with a checkpoint, says how to go on, and gives an exit
status of its own; a full disk is reported and spoils no checkpoint.
"""

from __future__ import annotations

import os
import pathlib
import random
import re
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.dont_write_bytecode = True

from killed_runs import kill, wait_for  # noqa: E402
from program_checks import (  # noqa: E402
    MPIEXEC, PROGRAMS, SOURCE, check, descendants, finish, history)

STEP, END, BETWEEN = 2.0, 200.0, 5
KILLS = 10
FORCE = "contact.columns.force_z"
PEAK = "fluid.peak_pressure"


class Case:
    """Two columns in contact, on a coarse mesh."""

    def __init__(self, directory: pathlib.Path) -> None:
        self.mesh = directory / "two_columns.msh"
        subprocess.run([sys.executable, SOURCE / "meshes/boxes.py",
                        "two_columns", "--size", "2", "-o", self.mesh],
                       check=True, stdout=subprocess.DEVNULL)

    def command(self, ranks: int, output: pathlib.Path, *more: str) -> list:
        return [MPIEXEC, "-n", str(ranks), PROGRAMS / "synovia",
                SOURCE / "miniapps/cases/two_columns.toml",
                "--set", f'mesh.file="{self.mesh}"',
                "--set", f"time.step={STEP}", "--set", f"time.end={END}",
                "--set", 'time.scheme="backward_euler"',
                "--set", f"output.checkpoint_every={BETWEEN}",
                "--set", "output.fields_every=0",
                "--output", output, *more]

    def run(self, ranks: int, output: pathlib.Path,
            *more: str) -> subprocess.CompletedProcess:
        return subprocess.run(self.command(ranks, output, *more), text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              timeout=300)

    def start(self, ranks: int, output: pathlib.Path, *more: str,
              cwd: pathlib.Path | None = None) -> subprocess.Popen:
        return subprocess.Popen(self.command(ranks, output, *more), text=True,
                                cwd=cwd, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT)


def compare(output: pathlib.Path, whole: list[dict[str, float]],
            text: str) -> None:
    found = history(output)
    check([row["t"] for row in found] == [row["t"] for row in whole],
          f"{text}: each step once, {len(found)} of them")
    for name in (FORCE, PEAK):
        scale = max(abs(row[name]) for row in whole)
        change = max(abs(a[name] - b[name]) for a, b in zip(found, whole))
        check(change <= 1e-8 * scale,
              f"{text}: {name} differs by {change / scale:.1e} of its largest")


def killed(case: Case, directory: pathlib.Path,
           whole: list[dict[str, float]]) -> None:
    """Kills it again and again, on changing numbers of ranks."""
    output = directory / "killed"
    chance = random.Random(5)
    reached = 0.0
    resumed = 0
    for attempt in range(KILLS):
        run = case.start(1 + attempt % 3, output, "--resume")
        wait_for(run, output,
                 reached + chance.randrange(1, 2 * BETWEEN) * STEP)
        time.sleep(chance.uniform(0.0, 0.05))
        text = kill(run)
        at = re.search(r"goes on from t = ([0-9.e+]+)", text)
        if at:
            resumed += 1
            check(reached - float(at.group(1)) <= BETWEEN * STEP,
                  f"kill {attempt}: the run before had got to {reached:g}, this "
                  f"one went on from {at.group(1)}")
        else:
            check(reached < (BETWEEN + 1) * STEP,
                  f"kill {attempt}: from the start, with {reached:g} reached")
        reached = max(reached, history(output)[-1]["t"])
    check(resumed > KILLS / 2, f"{resumed} runs went on from a checkpoint")
    result = case.run(2, output, "--resume")
    check(result.returncode == 0, "the last run gets to the end")
    compare(output, whole, f"killed {KILLS} times")


def interrupted(case: Case, directory: pathlib.Path,
                whole: list[dict[str, float]]) -> None:
    # A name that a shell would take apart.
    output = directory / "it's $HOME & more"
    run = case.start(2, pathlib.Path(output.name), cwd=directory)
    wait_for(run, output, 2 * BETWEEN * STEP)
    # To the ranks themselves: mpirun passes it on, but gives them one second,
    # which is short for a step on a busy machine.
    for pid in descendants(run.pid):
        os.kill(pid, signal.SIGINT)
    text, _ = run.communicate(timeout=60)
    check(run.returncode not in (0, None),
          f"Ctrl-C: the exit status is {run.returncode}")
    said = re.search(r"stopped at t = ([0-9.e+]+); go on with:\n(.+)\n", text)
    if not said:
        print(text)
    check(said is not None and said[2].startswith("mpirun -n 2 ")
          and said[2].endswith(" --resume"),
          "Ctrl-C: it says where it stopped and how to go on")
    at = float(said[1])
    check(0 < at < END and history(output)[-1]["t"] == at,
          f"Ctrl-C: the step at {at:g} is complete")
    result = subprocess.run(["bash", "-c", said[2]], cwd="/", text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                            timeout=300)
    if result.returncode != 0:
        print(result.stdout)
    check(result.returncode == 0
          and f"goes on from t = {at:g}" in result.stdout,
          f"Ctrl-C: {said[2]}, pasted into a shell elsewhere, goes on")
    compare(output, whole, "Ctrl-C")


def full_disk(case: Case, directory: pathlib.Path,
              whole: list[dict[str, float]]) -> None:
    disk = directory / "disk"
    disk.mkdir()
    # What a run needs twice over, most of it taken by others at first.
    size = sum(file.stat().st_size for file in
               (directory / "whole").rglob("*") if file.is_file())
    mounted = subprocess.run(
        ["mount", "-t", "tmpfs", "-o", f"size={2 * size + 65536}", "tmpfs", disk],
        stderr=subprocess.DEVNULL).returncode == 0
    if not mounted:
        print("skipped: no permission to mount a small disk")
        return
    try:
        hog = disk / "hog"
        hog.write_bytes(b"x" * (3 * size // 2 + 65536))
        output = disk / "out"
        result = case.run(2, output)
        check("No space left on device" in result.stdout,
              "full disk: it is reported")
        hog.unlink()
        result = case.run(2, output, "--resume")
        check(result.returncode == 0,
              "full disk: with room again, the run goes on to its end")
        found = {row["t"]: row for row in history(output)}
        check(all(abs(found[row["t"]][FORCE] - row[FORCE])
                  <= 1e-8 * abs(whole[-1][FORCE])
                  for row in whole if row["t"] in found)
              and END in found, "full disk: and to the same results")
    finally:
        subprocess.run(["umount", disk], check=True)


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        case = Case(directory)
        result = case.run(2, directory / "whole")
        if result.returncode != 0:
            print(result.stdout)
        check(result.returncode == 0, "a run undisturbed")
        whole = history(directory / "whole")
        check(len(whole) == round(END / STEP), "all its steps are there")
        killed(case, directory, whole)
        interrupted(case, directory, whole)
        full_disk(case, directory, whole)
    finish()


if __name__ == "__main__":
    main()
