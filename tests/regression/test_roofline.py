#!/usr/bin/env python3
# processors: 1
"""The comparison of linear iterations with what memory can move.

Requirements: work is timed without what is nested in it, and its bytes add up;
only that of linear iterations counts; the rate is that of all ranks together;
the table begins with what takes most beyond reading, has all work of an
iteration, and no work reads faster than memory; what can't be read is an error.
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

sys.path.insert(0, str(SOURCE / "scripts"))

from roofline import Work, read_ranks, table_of  # noqa: E402

# A program whose work takes a known time.
WORKER = r"""
#include <mpi.h>
#include <unistd.h>

int main(int argc, char *argv[])
{
   MPI_Init(&argc, &argv);
   int rank = 0;
   MPI_Comm_rank(MPI_COMM_WORLD, &rank);
   MPI_Pcontrol(2, "outside", 1.0);
   MPI_Pcontrol(-2);
   MPI_Pcontrol(1, "iteration");
   for (int i = 0; i < 2; i++)
   {
      MPI_Pcontrol(2, "outer", 100.0);
      MPI_Pcontrol(2, "inner", 10.0 + rank);
      usleep(rank == 0 ? 100000 : 200000);
      MPI_Pcontrol(-2);
      usleep(50000);
      MPI_Pcontrol(-2);
   }
   MPI_Pcontrol(-1);
   MPI_Finalize();
   return 0;
}
"""


def check_clock(work: pathlib.Path) -> None:
    run_observed(WORKER, "work_clock", "SYNOVIA_WORK_TIMES", work / "times")
    with open(work / "times.1.csv", newline="", encoding="utf-8") as stream:
        rows = {(row["phase"], row["work"]): row
                for row in csv.DictReader(stream)}
    check(("other", "outside") in rows, "work outside of all phases is apart")
    works = read_ranks(work / "times")
    check(set(works) == {"outer", "outer inner", "waiting", "vectors",
                         "memory"}, f"names: {sorted(works)}")
    inner = works["outer inner"]
    check(inner.calls == 2 and inner.bytes == 2 * (10.0 + 11.0),
          f"calls, and the bytes of both ranks: {inner}")
    check(0.4 <= inner.seconds < 0.6, f"the slower rank's time: {inner}")
    outer = works["outer"]
    check(outer.bytes == 400.0 and 0.1 <= outer.seconds < 0.25,
          f"what is nested counts apart: {outer}")
    check(0.2 <= works["waiting"].seconds < 0.4,
          f"the faster rank waits: {works['waiting']}")
    check(works["vectors"].seconds < 0.05, "nothing is left for the rest")
    rate = works["memory"].bytes / works["memory"].seconds
    check(1e9 < rate < 1e12, f"memory moves {rate:g} B/s")


def check_table() -> None:
    works = {"memory": Work(1, 1.0, 1e9), "small": Work(2, 2.0, 1.9e9),
             "large": Work(4, 3.0, 1e9), "vectors": Work(1, 0.5, 0.0)}
    rows = [[cell.strip() for cell in line.strip("|").split("|")]
            for line in table_of(works).splitlines()[4:]]
    check([row[0] for row in rows] == ["large", "vectors", "small"],
          f"most beyond reading first: {rows}")
    check(rows[0][1:] == ["4", "750.00", "250.0", "33 %", "55 %", "36 %"],
          f"shares: {rows[0]}")
    check(rows[1][3:5] == ["", ""], "no rate where no bytes are known")


def roofline(out: pathlib.Path, *arguments: object
             ) -> subprocess.CompletedProcess:
    return subprocess.run(
        [sys.executable, SOURCE / "scripts/roofline.py", "--size", "6",
         "--launcher", f"{MPIEXEC} -n", "--program", PROGRAMS / "scaling",
         "--output", out, *map(str, arguments)],
        text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def check_program(work: pathlib.Path) -> None:
    out = work / "out"
    run = roofline(out)
    check(run.returncode == 0, f"it runs: {run.stdout}")
    table = (out / "roofline.md").read_text(encoding="utf-8")
    check(table in run.stdout, "it says what it writes")
    for name in ("displacement cycle", "displacement solve", "pressure cycle",
                 "displacement residual", "pressure solve", "jacobian",
                 "waiting", "vectors"):
        check(f"| {name} |" in table, f"it has a row for {name}")
    check([file.name for file in out.iterdir()] == ["roofline.md"],
          "nothing else is left")
    run = roofline(out, "--from", work / "none")
    check(run.returncode == 1 and "there are no files" in run.stdout,
          f"no files: {run.stdout}")
    (work / "cut.0.csv").write_text("phase,work,calls,seconds,bytes\n",
                                    encoding="utf-8")
    run = roofline(out, "--from", work / "cut")
    check(run.returncode == 1 and "is not whole" in run.stdout,
          f"a file that was cut: {run.stdout}")


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        check_clock(pathlib.Path(name))
        check_program(pathlib.Path(name))
    check_table()
    finish()


if __name__ == "__main__":
    main()
