"""Runs of miniapps/scaling that count what each rank holds and sends."""

from __future__ import annotations

import csv
import dataclasses
import os
import pathlib
import tempfile

import numpy as np

from benchmark_runs import BenchmarkError, Run, Runner

PHASES = ("mesh", "assembly", "search", "setup", "iteration", "other")
COUNTS = ("messages", "bytes", "destinations", "collectives",
          "collective_bytes")
# Memory is what a rank has for itself; memory_shared is what MPI shares between
# the ranks of one machine.
HELD = ("dofs", "elements", "contact_faces", "entries", "memory",
        "memory_mesh", "memory_equations", "memory_steps", "memory_shared")


@dataclasses.dataclass(frozen=True)
class Audit:
    """A run: arrays with an entry for each rank."""

    ranks: int
    row: dict[str, str]
    held: dict[str, np.ndarray]
    sent: dict[tuple[str, str], np.ndarray]   # by phase and kind of count

    def number(self, column: str) -> float:
        return float(self.row[column])

    def most_sent(self, phase: str, kind: str) -> float:
        return float(self.sent[phase, kind].max())


def read_row(file: pathlib.Path) -> list[dict[str, str]]:
    try:
        with open(file, newline="", encoding="utf-8") as stream:
            return list(csv.DictReader(stream))
    except OSError as error:
        raise BenchmarkError(f"a rank has not written '{file.name}': "
                             f"{error.strerror}") from error


def read_held(prefix: pathlib.Path, ranks: int) -> dict[str, np.ndarray]:
    rows = [read_row(prefix.with_name(f"{prefix.name}.{rank}.csv"))[0]
            for rank in range(ranks)]
    held = {name: np.array([float(row[name]) for row in rows])
            for name in rows[0]}
    # Libraries take their part before anything is computed.
    held["memory"] = held["memory_peak"] - held["memory_at_start"]
    return held


def read_sent(prefix: pathlib.Path, ranks: int
              ) -> dict[tuple[str, str], np.ndarray]:
    sent = {(phase, kind): np.zeros(ranks) for phase in PHASES
            for kind in COUNTS}
    for rank in range(ranks):
        for row in read_row(prefix.with_name(f"{prefix.name}.{rank}.csv")):
            for kind in COUNTS:
                sent[row["phase"], kind][rank] = float(row[kind])
    return sent


class AuditRunner:
    """Makes runs with the message counter loaded."""

    def __init__(self, program: pathlib.Path, launcher: str, timeout: float,
                 directory: pathlib.Path):
        self.runner = Runner(program, launcher, timeout, directory)
        self.directory = directory

    def __call__(self, run: Run) -> Audit:
        with tempfile.TemporaryDirectory(dir=self.directory) as name:
            held = pathlib.Path(name) / "held"
            sent = pathlib.Path(name) / "sent"
            self.runner.load("message_counter", "SYNOVIA_MESSAGE_COUNTS", sent)
            row = self.runner(run, "--rank-records", str(held))
            if row["status"] != "ok":
                raise BenchmarkError(f"{run.ranks} ranks: {row['status']}")
            return Audit(run.ranks, row, read_held(held, run.ranks),
                         read_sent(sent, run.ranks))


def save(audits: list[Audit], file: pathlib.Path) -> None:
    """A row for each run and rank."""
    part = file.with_name(file.name + ".part")
    with open(part, "w", newline="", encoding="utf-8") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        keys = list(audits[0].sent)
        writer.writerow(["ranks", "rank", *HELD,
                         *(f"{phase}_{kind}" for phase, kind in keys)])
        for audit in audits:
            for rank in range(audit.ranks):
                writer.writerow([
                    audit.ranks, rank,
                    *(f"{audit.held[name][rank]:g}" for name in HELD),
                    *(f"{audit.sent[key][rank]:g}" for key in keys)])
    os.replace(part, file)
