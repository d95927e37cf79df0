#!/usr/bin/env python3
"""MFEM's debug device: data on it can't be read on the host unless it was
fetched, as on a GPU.

Requirements: the scaling miniapp and a case of the driver run on that device, on
one rank and on two, with either solver, and give what they give without it.
"""

from __future__ import annotations

import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.dont_write_bytecode = True

from program_checks import (MPIEXEC, PROGRAMS, SOURCE, check,  # noqa: E402
                            finish, history, make_mesh, run_program)

# What depends on the machine.
MEASURED = ("seconds", "dofs_per_second", "memory", "cpu")
# The residual after a factorization's solution is round-off, which depends on
# the order in which messages of ranks come.
ROUND_OFF = {"direct": ("linear_per_decade",), "block_amg": ()}


def command_on(device: str, ranks: int, *command: str | pathlib.Path):
    return ("env", f"MFEM_DEVICE={device}", MPIEXEC, "-n", str(ranks), *command)


def run(device: str, ranks: int, *command: str | pathlib.Path) -> str:
    arguments = " ".join(map(str, command[1:]))
    return run_program(*command_on(device, ranks, *command),
                       text=f"{device}, {ranks} ranks: {arguments}")


def same(name: str, table: dict[str, float], other: dict[str, float],
         least: int, round_off: tuple[str, ...] = ()) -> None:
    """That two rows agree to round-off in more than @a least numbers."""
    compared = [key for key in table if key not in round_off
                and not any(word in key for word in MEASURED)]
    different = [key for key in compared
                 if abs(table[key] - other[key])
                 > 1e-10 + 1e-8 * abs(table[key])]
    check(len(compared) > least and not different,
          f"{name}: {len(compared)} numbers are the same {different}")


def numbers(output: str) -> dict[str, float]:
    """Of a program that prints a name and a value a line."""
    row = {}
    for line in output.splitlines():
        words = line.split()
        try:
            row[words[0]] = float(words[1])
        except (IndexError, ValueError):
            pass
    return row


def main() -> None:
    scaling = PROGRAMS / "scaling"
    nowhere = subprocess.run(command_on("nowhere", 1, scaling, "-n", "2"),
                             capture_output=True)
    check(nowhere.returncode != 0,
          "MFEM_DEVICE is heeded: there is no device \"nowhere\"")
    for ranks in (1, 2):
        for arguments in (("-o", "1", "-ls", "block_amg"),
                          ("-o", "2", "-ls", "block_amg"),
                          ("-o", "2", "-ls", "direct"),
                          ("-o", "3", "-nc", "-ls", "block_amg")):
            rows = [numbers(run(device, ranks, scaling, "-n", "3",
                                *arguments))
                    for device in ("cpu", "debug")]
            same(" ".join(arguments), *rows, least=15,
                 round_off=ROUND_OFF[arguments[-1]])

    with tempfile.TemporaryDirectory() as directory:
        here = pathlib.Path(directory)
        make_mesh("knee_parametric.py", here / "knee.msh", "--size", "6")
        rows = []
        for device in ("cpu", "debug"):
            run(device, 2, PROGRAMS / "synovia",
                SOURCE / "miniapps" / "cases" / "knee.toml",
                "--set", f'mesh.file="{here}/knee.msh"',
                "--set", "time.step=10", "--set", "time.end=20",
                "--output", here / device)
            rows.append(history(here / device)[-1])
        same("knee", *rows, least=100)
    finish()


if __name__ == "__main__":
    main()
