#!/usr/bin/env python3
# processors: 1
"""scripts/benchmark: a small sweep by the real program, all of them by one that
pretends.

Requirements: tables, plots and the page are written; runs that are there are not
made again; a run that fails, in whatever way, is a row that says so; a launcher
or program that is missing is said at once.
"""

from __future__ import annotations

import csv
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.dont_write_bytecode = True

from program_checks import PROGRAMS, SOURCE, check, finish  # noqa: E402

# Takes the place of the launcher: writes a row, or fails as the options ask.
PRETENDER = '''
import csv, os, sys, time
ranks, program, *words = sys.argv[1:]
words = [w for w in words if w not in ("--contact", "--no-contact")]
options = dict(zip(words[::2], words[1::2]))
jump = float(options["--jump"])
with open(sys.argv[0] + ".count", "a") as log:
    log.write("x")
if jump == 100.0:
    print("scaling: error: no such thing")
    sys.exit(1)
if jump == 10.0:
    time.sleep(60)
if jump == 1000.0:
    os.abort()
names = ("dofs newton augmentations linear most_linear mean_linear setups "
         "factorisations seconds_assembly seconds_search seconds_setup "
         "seconds_solve seconds_total dofs_per_second memory_sum").split()
row = {name: 10 + len(name) for name in names}
row |= {"dofs": int(options["--size"]) ** 3, "ranks": ranks, "converged": 1,
        "reason": ""}
if jump == 10000.0:
    row |= {"converged": 0, "reason": "not, alas"}
if float(options["--poisson"]) == 0.49:
    row["ranks"] = 7
with open(options["--csv"], "w", newline="") as file:
    writer = csv.DictWriter(file, row)
    writer.writeheader()
    writer.writerow(row)
'''
IMAGES = ("iterations", "costs_size", "costs_solver", "ranks")


def benchmark(out: pathlib.Path, *arguments: object):
    return subprocess.run(
        [sys.executable, SOURCE / "scripts/benchmark.py", "-o", out,
         "--program", PROGRAMS / "scaling", *map(str, arguments)],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def rows(file: pathlib.Path) -> list[dict[str, str]]:
    with open(file, newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def check_page(out: pathlib.Path, images: int) -> None:
    page = (out / "index.html").read_text()
    check(page.rstrip().endswith("</html>") and
          page.count("<img") == images, f"a page with {images} plots")


def check_real(directory: pathlib.Path) -> None:
    out = directory / "real"
    result = benchmark(out, "--quick", "--sweep", "poisson")
    print(result.stdout)
    check(result.returncode == 0, "a sweep by the program")
    found = rows(out / "poisson.csv")
    check([row["x"] for row in found] == ["0", "0.1", "0.49"], "its points")
    for row in found:
        check(row["status"] == "ok" and 0 < int(row["most_linear"]) <= 40,
              f"nu = {row['x']}: {row['most_linear']} iterations")
    check_page(out, 1)


def check_pretended(directory: pathlib.Path) -> None:
    pretender = directory / "pretender.py"
    pretender.write_text(PRETENDER)
    out = directory / "pretended"

    def count() -> int:
        return len((directory / "pretender.py.count").read_text())

    arguments = ("--launcher", f"{sys.executable} {pretender}", "--timeout",
                 "5", "--ranks", "1,2,4")
    result = benchmark(out, *arguments)
    check(result.returncode == 0, "all sweeps")
    all_runs = rows(out / "runs.csv")
    check(count() == len(all_runs) > 50, f"{count()} runs, none made twice")
    for name in IMAGES:
        check((out / f"{name}.png").stat().st_size > 10000, f"{name}.png")
    check_page(out, len(IMAGES))
    status = {row["x"]: row["status"] for row in rows(out / "jump.csv")
              if row["series"] == "contact"}
    check(status == {
        "1": "ok", "10": "failed: more than 5 s",
        "100": "failed: scaling: error: no such thing",
        "1000": "failed: signal 6", "10000": "failed: not, alas"},
        f"failures are rows: {status}")
    status = {row["x"]: row["status"] for row in rows(out / "poisson.csv")}
    check("the launcher started 7 ranks, not 1" in status["0.49"],
          status["0.49"])
    growth = {(row["axis"], row["series"]): row
              for row in rows(out / "iterations.csv")}
    check(growth["Stiffness jump", "contact"]["failed"] == "4"
          and growth["Stiffness jump", "contact"]["good"] == "no"
          and growth["Time step", "contact"]["good"] == "yes",
          "axes with failed runs are not good")

    before = count()
    check(benchmark(out, *arguments).returncode == 0 and count() == before,
          "nothing is run again")
    (out / "runs.csv").write_text("".join(
        (out / "runs.csv").read_text().splitlines(keepends=True)[:20]))
    check(benchmark(out, *arguments, "--sweep", "permeability").returncode == 0
          and 0 < count() - before < 22, "what is missing is made up for")


def check_errors(directory: pathlib.Path) -> None:
    out = directory / "wrong"
    for arguments, word in ((["--launcher", "/nowhere/srun -n"], "--launcher"),
                            (["--launcher", "'srun"], "--launcher"),
                            (["--program", "/nowhere/scaling"], "--program"),
                            (["--ranks", "1,two"], "numbers of ranks"),
                            (["--sweep", "weight"], "invalid choice")):
        result = benchmark(out, *arguments)
        check(result.returncode in (1, 2) and word in result.stdout
              and "Traceback" not in result.stdout,
              f"{' '.join(arguments)} is refused: {word}")
    check(not os.path.exists(out / "runs.csv"), "no table without a run")


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        check_real(pathlib.Path(name))
        check_pretended(pathlib.Path(name))
        check_errors(pathlib.Path(name))
    finish()


if __name__ == "__main__":
    main()
