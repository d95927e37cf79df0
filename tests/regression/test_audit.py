#!/usr/bin/env python3
# processors: 1
"""The audit of what ranks hold and send, on small problems.

Requirements: the message counter sees each kind of message once, in its phase;
one rank sends nothing; every rank of a run is counted, and all hold the whole
problem together, but none the whole mesh; memory that ranks share is counted
apart; growth is an exponent; a bound that is exceeded is said, and is the exit
status.
"""

from __future__ import annotations

import csv
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.dont_write_bytecode = True

from program_checks import (  # noqa: E402
    MPIEXEC, PROGRAMS, SOURCE, check, finish, run_observed)

sys.path.insert(0, str(SOURCE / "scripts/lib"))

import numpy as np  # noqa: E402

from audit_bounds import Bound  # noqa: E402
from audit_model import Law, Model, Network, exponent  # noqa: E402

# A program that sends what is known.
SENDER = r"""
#include <mpi.h>

int main(int argc, char *argv[])
{
   MPI_Init(&argc, &argv);
   int rank = 0;
   MPI_Comm_rank(MPI_COMM_WORLD, &rank);
   double data[6] = {0.0};
   MPI_Request request = MPI_REQUEST_NULL;
   MPI_Pcontrol(1, "outer");
   if (rank == 0)
   {
      MPI_Send(data, 2, MPI_DOUBLE, 1, 0, MPI_COMM_WORLD);
      MPI_Isend(data, 3, MPI_INT, 1, 1, MPI_COMM_WORLD, &request);
      MPI_Wait(&request, MPI_STATUS_IGNORE);
      MPI_Pcontrol(1, "inner");
      MPI_Send_init(data, 5, MPI_CHAR, 1, 2, MPI_COMM_WORLD, &request);
      for (int i = 0; i < 3; i++)
      {
         MPI_Start(&request);
         MPI_Wait(&request, MPI_STATUS_IGNORE);
      }
      MPI_Request_free(&request);
      MPI_Pcontrol(-1);
      MPI_Send(data, 1, MPI_DOUBLE, MPI_PROC_NULL, 0, MPI_COMM_WORLD);
   }
   else
   {
      MPI_Recv(data, 2, MPI_DOUBLE, 0, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
      MPI_Recv(data, 3, MPI_INT, 0, 1, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
      for (int i = 0; i < 3; i++)
      {
         MPI_Recv(data, 5, MPI_CHAR, 0, 2, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
      }
   }
   MPI_Pcontrol(-1);
   double sum[4];
   MPI_Allreduce(data, sum, 4, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
   MPI_Finalize();
   return 0;
}
"""


def rows_of(file: pathlib.Path) -> list[dict[str, str]]:
    with open(file, newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def check_counter(work: pathlib.Path) -> None:
    run_observed(SENDER, "message_counter", "SYNOVIA_MESSAGE_COUNTS",
                 work / "counts")
    counts = [{row.pop("phase"): {name: int(value)
                                  for name, value in row.items()}
               for row in rows_of(work / f"counts.{rank}.csv")}
              for rank in (0, 1)]
    check(counts[0]["outer"] == {"messages": 2, "bytes": 28,
                                 "destinations": 1, "collectives": 0,
                                 "collective_bytes": 0},
          f"sends outside of the inner phase: {counts[0]['outer']}")
    check(counts[0]["inner"]["messages"] == 3
          and counts[0]["inner"]["bytes"] == 15,
          f"persistent sends, each time: {counts[0]['inner']}")
    for rank in (0, 1):
        other = counts[rank]["other"]
        check(other["messages"] == 0 and other["collectives"] == 1
              and other["collective_bytes"] == 32,
              f"rank {rank}: a reduction in no phase: {other}")
    check(counts[1]["outer"]["messages"] == 0, "receiving is not counted")


def audit(out: pathlib.Path, *arguments: str) -> subprocess.CompletedProcess:
    return subprocess.run(
        [sys.executable, SOURCE / "scripts/audit.py", "--most-ranks", "4",
         "--each", "4", "--whole", "6", "--launcher", f"{MPIEXEC} -n",
         "--program", PROGRAMS / "scaling", "--output", out, *arguments],
        text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def check_audit(work: pathlib.Path) -> None:
    out = work / "audit"
    run = audit(out)
    check(run.returncode in (0, 1), f"it runs: {run.stdout}")
    check((run.returncode == 1) == ("EXCEEDED" in run.stdout),
          "its exit status says whether the bounds are kept")
    text = (out / "audit.md").read_text(encoding="utf-8")
    check("relative difference of the force" in text
          and "difference of the contact's area" in text, "it has bounds")
    modeled = [line.split("|") for line in text.splitlines()
               if line.startswith("| InfiniBand")]
    check(len(modeled) == 1 and float(modeled[0][5])
          < float(modeled[0][2]) < 1.0, f"efficiency falls: {modeled}")
    check((out / "efficiency.png").stat().st_size > 10000, "and a picture")
    for name in ("weak", "strong"):
        rows = rows_of(out / f"{name}.csv")
        check([(row["ranks"], row["rank"]) for row in rows]
              == [(str(ranks), str(rank)) for ranks in (1, 2, 4)
                  for rank in range(ranks)], f"{name}: a row a rank")
        alone, *others = rows
        check(all(float(alone[f"{phase}_messages"]) == 0.0
                  for phase in ("assembly", "search", "setup", "iteration",
                                "other")), f"{name}: one rank sends nothing")
        check(all(float(row["iteration_messages"]) > 0.0 for row in others),
              f"{name}: others do")
        check(0.0 < max(float(row["mesh_bytes"]) for row in others) < 1e4,
              f"{name}: rank 0 sends places of cells, not the mesh")
        check(all(float(row["memory_shared"]) > 0.0 for row in others
                  if row["ranks"] == "4"), f"{name}: MPI shares memory")
        check(all(float(row["memory"]) >= float(row["memory_steps"]) > 0.0
                  for row in rows), f"{name}: each rank has its own")
    unknowns = {ranks: sum(float(row["dofs"]) for row in rows
                           if row["ranks"] == ranks)
                for ranks in ("1", "2", "4")}
    check(len(set(unknowns.values())) == 1,
          f"strong: all hold the problem together: {unknowns}")
    mesh = {ranks: max(float(row["memory_mesh"]) for row in rows
                       if row["ranks"] == ranks) for ranks in ("1", "4")}
    check(mesh["4"] < 0.7 * mesh["1"],
          f"strong: no rank of four holds the whole mesh: {mesh}")


def check_errors(work: pathlib.Path) -> None:
    run = audit(work / "none", "--program", str(work / "nowhere"))
    check(run.returncode == 1 and "there is no program" in run.stdout,
          f"a program that is missing: {run.stdout}")
    run = audit(work / "few", "--most-ranks", "2")
    check(run.returncode == 2 and "at least 4" in run.stdout,
          "too few ranks")


def check_model() -> None:
    ranks = np.array([4.0, 8.0, 16.0])
    check(abs(exponent(ranks, 3.0 * ranks ** 0.7) - 0.7) < 1e-12,
          "the exponent of a power")
    network = Network("", 1e-6, 1e9)
    model = Model(0.1, Law(64.0, 1e3, 0.0), Law(64.0, 1e7, 0.5),
                  Law(64.0, 100.0, 0.0))
    parts = model.parts(np.array([256.0]), network)
    check(np.isclose(parts["latency of messages"][0], 1e-3)
          and np.isclose(parts["bandwidth"][0], 0.02)
          and np.isclose(parts["collectives"][0], 8e-4),
          f"what an iteration is spent for: {parts}")
    check(np.isclose(model.efficiency(np.array([256.0]), network)[0],
                     0.1 / 0.1218), "efficiency")
    check(Bound("", 1.0, 1.0).kept and not Bound("", 1.1, 1.0).kept,
          "bounds")


def main() -> None:
    check_model()
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        check_counter(work)
        check_audit(work)
        check_errors(work)
    finish()


if __name__ == "__main__":
    main()
