#!/usr/bin/env python3
# processors: 1
"""scripts/benchmark --tables, on coarse meshes and with numbers made up.

Requirements: a table has what the runs took, with commit and machine; it goes
between the comments of its name and nowhere else; every table has its place in
the READMEs; errors are those of the force against the reference, on either side
of the load's corners; what can't be measured is said.
"""

from __future__ import annotations

import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.dont_write_bytecode = True

from program_checks import PROGRAMS, SOURCE, check, finish  # noqa: E402

import numpy as np

sys.path.insert(0, str(SOURCE / "scripts" / "lib"))
import benchmark_cases  # noqa: E402
import benchmark_tables  # noqa: E402
import readme_tables  # noqa: E402
from benchmark_cases import Cost  # noqa: E402

LAST_LINE = ("total 16.3 s: linear systems 3.2 s, their set-up 7.2 s, contact "
             "search 0.1 s, assembly 0.7 s, output 3.5 s")


def benchmark(*arguments: str) -> subprocess.CompletedProcess:
    return subprocess.run(
        [SOURCE / "scripts" / "benchmark", "--tables", "--programs",
         PROGRAMS, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        text=True, env=os.environ | {"SYNOVIA_PYTHON": sys.executable})


def measured(folder: pathlib.Path) -> None:
    run = benchmark("--table", "febio", "--table", "scaling", "--quick",
                    "--coarsen", "6", "--output", str(folder))
    if run.returncode != 0:
        print(run.stdout + run.stderr)
    check(run.returncode == 0, "two tables on coarse meshes")
    text = (folder / "tables.md").read_text()
    for name in ("febio", "scaling"):
        check(readme_tables.begin(name) in text, f"the table {name}")
    rows = [line for line in text.splitlines() if line.startswith("| ")]
    febio = [row for row in rows if "hexahedra" in row]
    check(len(febio) == 4 and "393 s" in febio[0] and "223 s" in febio[2]
          and all("finite deformation" in row for row in febio[1::2])
          and all("2 x " in row for row in febio),
          "both cases beside FEBio's times, in both theories")
    check(len(rows) == 5 + 1 + 4, "four sizes without a million unknowns")
    note = [line for line in text.splitlines() if line.startswith("*Measured")]
    check(len(note) == 2 and all(
        word in note[0] for word in ("commit", "cores of", "GiB", "MFEM")),
        f"where the numbers come from: {note[0]}")


def refused(folder: pathlib.Path) -> None:
    run = benchmark("--write-tables", "--coarsen", "2", "--output",
                    str(folder))
    check(run.returncode == 2 and "--coarsen" in run.stderr,
          "coarse meshes don't get into the READMEs")
    run = subprocess.run(
        [sys.executable, SOURCE / "scripts" / "benchmark_tables.py",
         "--programs", str(folder), "--output", str(folder)],
        stderr=subprocess.PIPE, text=True)
    check(run.returncode == 1 and "there is no program" in run.stderr,
          "a directory without programs")


def phases() -> None:
    found = benchmark_cases.phases_in("step 6\n" + LAST_LINE + "\n")
    check(found == {"total": 16.3, "linear systems": 3.2, "their set-up": 7.2,
                    "contact search": 0.1, "assembly": 0.7, "output": 3.5},
          "phases of a run's last line")
    check(benchmark_cases.larger_size(["--hex", "--size", "1.5"], 2.0)[-1]
          == "3", "a mesh twice as coarse")


def march(times: np.ndarray, force) -> Cost:
    return Cost(1.0, 1.0, 1, {}, {
        "t": times, benchmark_tables.INDENTER: force(times)})


def compared() -> None:
    def force(t: np.ndarray) -> np.ndarray:
        return np.where(t <= 500.0, t / 500.0, 1.0 - (t - 500.0) / 4000.0)

    exact = march(np.arange(5.0, 1501.0, 5.0), force)
    times = np.array([33.0, 333.0, 500.0, 503.0, 777.0, 1500.0])
    same = benchmark_tables.errors(march(times, force), exact)
    check(len(same) == len(times) and np.abs(same).max() < 1e-12,
          "no error between the reference's steps and at the load's corner")
    off = benchmark_tables.errors(
        march(times, lambda t: force(t) + 0.01), exact)
    check(np.allclose(off, 0.01), "errors are over the largest force")


def placed(folder: pathlib.Path) -> None:
    table = readme_tables.Table("one", ("a", "b"), (("1", "2"),))
    file = folder / "text.md"
    begin, end = readme_tables.begin("one"), readme_tables.END
    file.write_text(f"before\n{begin}\n| old |\n{end}\nafter\n")
    found = readme_tables.write(file, {"one": table.markdown("here"),
                                       "two": "nothing"})
    check(found == ["one"] and file.read_text()
          == f"before\n{begin}\n| a | b |\n|---|---|\n| 1 | 2 |\n\n*here*\n"
             f"{end}\nafter\n", "a table in its place")
    readmes = [SOURCE / "README.md", SOURCE / "scripts" / "README.md"]
    for name in benchmark_tables.TABLES:
        for readme in readmes:
            text = readme.read_text()
            if readme_tables.begin(name) in text:
                readme_tables.replaced(text, name, "")
        check(any(readme_tables.begin(name) in readme.read_text()
                  for readme in readmes), f"the READMEs have a place for "
              f"the table {name}")


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        phases()
        compared()
        placed(folder)
        refused(folder)
        measured(folder)
    finish()


if __name__ == "__main__":
    main()
