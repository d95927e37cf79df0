"""Runs of case files, with what they cost."""

from __future__ import annotations

import csv
import dataclasses
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import time
import tomllib

import numpy as np

from benchmark_runs import BenchmarkError, last_line

ROOT = pathlib.Path(__file__).resolve().parents[2]
CASES = ROOT / "miniapps" / "cases"


@dataclasses.dataclass(frozen=True)
class Cost:
    """What a run took, and its history by column."""

    seconds: float
    memory: float               # MB, of the rank with most of it
    unknowns: int
    phases: dict[str, float]    # s, by name
    history: dict[str, np.ndarray]

    @property
    def steps(self) -> int:
        return len(self.history["t"])

    def total(self, column: str) -> int:
        return int(self.history[f"solver.{column}"].sum())


def read_history(file: pathlib.Path) -> dict[str, np.ndarray]:
    with open(file, newline="", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    return {name: np.array([float(row[name]) for row in rows])
            for name in rows[0]}


def phases_in(log: str) -> dict[str, float]:
    """Of a run's last line: "total 4 s: linear systems 0.8 s, ..."."""
    lines = re.findall(r"total ([\d.]+) s: (.*)", log)
    if not lines:
        raise BenchmarkError("the log of a run doesn't say how long it took")
    total, parts = lines[-1]
    return {"total": float(total)} | {
        name: float(seconds) for name, seconds
        in re.findall(r"([a-z][a-z -]*?) ([\d.]+) s(?:,|$)", parts)}


def larger_size(arguments: list[str], factor: float) -> list[str]:
    """A mesh script's arguments with --size times the factor."""
    sizes = [float(value) for option, value
             in zip(arguments, arguments[1:]) if option == "--size"]
    size = factor * (sizes[-1] if sizes else 1.0)
    return [*arguments, "--size", f"{size:g}"]


class CaseRunner:
    """Makes meshes and runs cases on two ranks, each run from the start."""

    def __init__(self, program: pathlib.Path, launcher: str,
                 folder: pathlib.Path, coarsen: float):
        if not os.access(program, os.X_OK):
            raise BenchmarkError(f"there is no program '{program}'")
        self.program = program.resolve()
        self.launcher = shlex.split(launcher)
        self.folder = folder
        self.coarsen = coarsen

    def mesh(self, case: str, *arguments: str) -> pathlib.Path:
        """What the case's generator makes, with more arguments."""
        file = CASES / case
        setup = tomllib.loads(file.read_text(encoding="utf-8"))
        script, *own = setup["mesh"]["generator"]
        words = larger_size([*own, *arguments], self.coarsen)
        mesh = self.folder / f"{file.stem}{'_'.join(arguments)}.msh"
        self._execute([sys.executable, str(ROOT / "meshes" / script), *words,
                       "-o", str(mesh)])
        return mesh

    def __call__(self, case: str, mesh: pathlib.Path, name: str,
                 settings: dict[str, object]) -> Cost:
        out = self.folder / name
        shutil.rmtree(out, ignore_errors=True)
        command = [*self.launcher, "2", str(self.program), str(CASES / case),
                   "--output", str(out)]
        for key, value in ({"mesh.file": str(mesh)} | settings).items():
            command += ["--set", f"{key}={json.dumps(value)}"]
        print(f"   {name}", flush=True)
        seconds, memory = self._execute(command)
        log = (out / "run.log").read_text(encoding="utf-8")
        return Cost(seconds, memory, int(re.search(r"(\d+) dofs", log)[1]),
                    phases_in(log), read_history(out / "history.csv"))

    @staticmethod
    def _execute(command: list[str]) -> tuple[float, float]:
        """Wall time (s), and the memory of the largest process (MB)."""
        start = time.monotonic()
        try:
            with subprocess.Popen(command, stdout=subprocess.PIPE, text=True,
                                  stderr=subprocess.STDOUT,
                                  errors="replace") as process:
                output = process.stdout.read()
                _, status, used = os.wait4(process.pid, 0)
                process.returncode = os.waitstatus_to_exitcode(status)
        except OSError as error:
            raise BenchmarkError(f"cannot start '{command[0]}': "
                                 f"{error.strerror}") from error
        if process.returncode != 0:
            raise BenchmarkError(f"{shlex.join(command)}: {last_line(output)}")
        return time.monotonic() - start, used.ru_maxrss * 1024 / 1e6
