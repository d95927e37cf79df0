"""Runs of miniapps/scaling, kept in a table so that none is made twice."""

from __future__ import annotations

import csv
import os
import pathlib
import shlex
import signal
import subprocess
import tempfile
from collections.abc import Mapping

# Exit status of the program when it did not converge, with a row that says so.
NOT_CONVERGED = 3
# Options of the program in the order of their columns, with the base point's
# values.
DEFAULTS = {
    "elements": "hex", "size": 8, "refine": 0, "order": 2,
    "permeability": 1e-3, "step": 1.0, "steps": 2, "poisson": 0.1,
    "jump": 1.0, "penalty_factor": 100.0, "contact": 1, "solver": "block_amg",
    "active_set_tolerance": 0.0, "deformation": "infinitesimal",
    "compression": 0.0}

Row = dict[str, str]


class BenchmarkError(Exception):
    """Says what the user can put right."""


def text_of(value: object) -> str:
    return f"{value:.10g}" if isinstance(value, float) else str(value)


class Run:
    """What the program is to compute, on how many ranks."""

    def __init__(self, ranks: int = 1, **options: object):
        unknown = sorted(set(options) - set(DEFAULTS))
        if unknown:
            raise ValueError(f"there are no options {', '.join(unknown)}")
        self.ranks = ranks
        self.options = DEFAULTS | options

    @property
    def key(self) -> str:
        """The same for runs that would give the same row."""
        parts = [f"{name}={text_of(value)}"
                 for name, value in self.options.items()]
        return " ".join([f"ranks={self.ranks}", *parts])

    def arguments(self) -> list[str]:
        words = []
        for name, value in self.options.items():
            if name == "contact":
                words.append("--contact" if value else "--no-contact")
            else:
                words += ["--" + name.replace("_", "-"), text_of(value)]
        return words


def last_line(text: str) -> str:
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    errors = [line for line in lines if "error" in line.lower()]
    return (errors or lines or ["it wrote nothing"])[-1]


class Runner:
    """Starts the program by an MPI launcher."""

    def __init__(self, program: pathlib.Path, launcher: str, timeout: float,
                 directory: pathlib.Path):
        if not os.access(program, os.X_OK) or program.is_dir():
            raise BenchmarkError(f"there is no program '{program}'; build the "
                                 "target scaling, or see --program")
        try:
            self.launcher = shlex.split(launcher)
        except ValueError as error:
            raise BenchmarkError(f"--launcher '{launcher}': {error}") from error
        self.program = program.resolve()
        self.timeout = timeout
        # Ranks may run on other machines, which see no local /tmp.
        self.directory = directory
        # Words before the program's name, such as env with variables.
        self.prefix: list[str] = []

    def load(self, observer: str, variable: str, prefix: pathlib.Path) -> None:
        """Loads a library of the miniapps in front of MPI from now on, which
        writes PREFIX.RANK.csv if the variable has the prefix.
        """
        library = self.program.parent / f"libsynovia_{observer}.so"
        if not library.exists():
            raise BenchmarkError(f"there is no library '{library}'; build the "
                                 f"target synovia_{observer}")
        # Through env, so that a launcher of any kind hands them on.
        self.prefix = ["env", f"LD_PRELOAD={library}", f"{variable}={prefix}"]

    def __call__(self, run: Run, *more: str) -> Row:
        """The row that the program writes, with a status: "ok" or what failed.
        More options of the program may follow those of the run.

        A launcher that can't be started is an error, since no run will do.
        """
        with tempfile.TemporaryDirectory(dir=self.directory) as name:
            table = pathlib.Path(name) / "row.csv"
            command = [*self.launcher, str(run.ranks), *self.prefix,
                       str(self.program), *run.arguments(), "--csv",
                       str(table), *more]
            status, output = self._execute(command)
            row = self._row(table)
        if row is None:
            return {"status": status or f"failed: {last_line(output)}"}
        if row["converged"] != "1":
            status = f"failed: {row['reason']}"
        elif not status and row["ranks"] != str(run.ranks):
            status = (f"failed: the launcher started {row['ranks']} ranks, "
                      f"not {run.ranks}")
        return {"status": status or "ok"} | row

    def _execute(self, command: list[str]) -> tuple[str, str]:
        """What went wrong with the process itself, if anything; its output."""
        try:
            process = subprocess.Popen(
                command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                text=True, errors="replace", start_new_session=True)
        except OSError as error:
            raise BenchmarkError(f"cannot start '{command[0]}': "
                                 f"{error.strerror}; see --launcher") from error
        try:
            output, _ = process.communicate(timeout=self.timeout)
        except subprocess.TimeoutExpired:
            self._end(process)
            return f"failed: more than {self.timeout:g} s", ""
        except BaseException:
            self._end(process)
            raise
        if process.returncode < 0:
            return f"failed: signal {-process.returncode}", output
        if process.returncode not in (0, NOT_CONVERGED):
            return f"failed: {last_line(output)}", output
        return "", output

    @staticmethod
    def _end(process: subprocess.Popen) -> None:
        """Lets the launcher end its ranks, which it cannot when it is killed."""
        os.killpg(process.pid, signal.SIGTERM)
        try:
            process.communicate(timeout=10)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()

    @staticmethod
    def _row(table: pathlib.Path) -> Row | None:
        if not table.exists():
            return None
        with open(table, newline="", encoding="utf-8") as stream:
            return next(csv.DictReader(stream), None)


def write_table(file: pathlib.Path, rows: list[Row]) -> None:
    """Writes a table, whole or not at all; empty cells where a row has none."""
    columns = list(dict.fromkeys(name for row in rows for name in row))
    part = file.with_name(file.name + ".part")
    try:
        with open(part, "w", newline="", encoding="utf-8") as stream:
            writer = csv.DictWriter(stream, columns, restval="",
                                    lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)
        os.replace(part, file)
    except OSError as error:
        part.unlink(missing_ok=True)
        raise BenchmarkError(f"cannot write '{file}': {error.strerror}") \
            from error


class Store(Mapping):
    """Rows by the key of their run, in a file that follows each change."""

    def __init__(self, file: pathlib.Path):
        self.file = file
        self._rows: dict[str, Row] = {}
        if not file.exists():
            return
        try:
            with open(file, newline="", encoding="utf-8") as stream:
                for row in csv.DictReader(stream):
                    self._rows[row["run"]] = row
        except (OSError, KeyError, csv.Error) as error:
            raise BenchmarkError(f"'{file}' is no table of runs: {error!r}") \
                from error

    def add(self, run: Run, row: Row) -> None:
        self._rows[run.key] = {"run": run.key} | row
        write_table(self.file, list(self._rows.values()))

    def __getitem__(self, key: str) -> Row:
        return self._rows[key]

    def __iter__(self):
        return iter(self._rows)

    def __len__(self) -> int:
        return len(self._rows)
