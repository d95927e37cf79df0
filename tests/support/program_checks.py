"""What tests that run Synovia's programs have in common.

The environment says where things are.
"""

from __future__ import annotations

import csv
import os
import pathlib
import subprocess
import sys

SOURCE = pathlib.Path(os.environ["SYNOVIA_SOURCE_DIR"])
PROGRAMS = pathlib.Path(os.environ["SYNOVIA_BUILD_DIR"]) / "miniapps"
MPIEXEC = os.environ.get("MPIEXEC", "mpiexec")
# Once a rank has failed, mpiexec waits for the others for a second, twice; ours
# fail together, by themselves.
WITHOUT_WAITING = {"OMPI_MCA_odls_base_sigkill_timeout": "0"}

_passed = 0


def check(condition: bool, text: str) -> None:
    """Says what was checked; ends the test if it does not hold."""
    global _passed
    print(("ok      " if condition else "FAILED  ") + text, flush=True)
    if not condition:
        sys.exit(1)
    _passed += 1


def finish() -> None:
    print(f"all {_passed} checks passed")


def run_program(*command: str | pathlib.Path, text: str | None = None) -> str:
    """What a program prints that must succeed; @a text says what was run."""
    result = subprocess.run(command, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, text=True)
    if result.returncode != 0:
        print(result.stdout)
    check(result.returncode == 0, (text or " ".join(map(str, command)))
          + f": exit status {result.returncode}")
    return result.stdout


def run_observed(source: str, observer: str, variable: str,
                 prefix: pathlib.Path) -> None:
    """Runs a C++ program on two ranks with a library of the miniapps in front
    of MPI, which writes PREFIX.RANK.csv.
    """
    program = prefix.with_name(prefix.name + "_program")
    file = program.with_suffix(".cpp")
    file.write_text(source, encoding="utf-8")
    run_program("mpicxx", file, "-o", program)
    library = PROGRAMS / f"libsynovia_{observer}.so"
    run_program(MPIEXEC, "-n", "2", "env", f"LD_PRELOAD={library}",
                f"{variable}={prefix}", program)


def make_mesh(script: str, file: pathlib.Path, *arguments: str) -> None:
    """The mesh that a script of meshes/ makes."""
    run_program(sys.executable, SOURCE / "meshes" / script, *arguments,
                "-o", file, text=" ".join((script,) + arguments))


def descendants(pid: int) -> list[int]:
    """The processes that one has started, and those that they have."""
    children = []
    for task in pathlib.Path(f"/proc/{pid}/task").glob("*/children"):
        try:
            children += [int(child) for child in task.read_text().split()]
        except OSError:
            pass   # it has just ended
    return children + [d for child in children for d in descendants(child)]


def history(output: pathlib.Path) -> list[dict[str, float]]:
    """The rows of a run's history."""
    with open(output / "history.csv") as file:
        return [{name: float(value) for name, value in row.items()}
                for row in csv.DictReader(file)]
