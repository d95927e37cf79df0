#!/usr/bin/env python3
"""The indentation miniapp on a coarse mesh, from the mesh to the forces.

Requirements: the force within 1 % of the exact one; the gap closed and the
pressure continuous; the same answers on any number of ranks, with any penalty
and either solver; few augmentations.
"""

from __future__ import annotations

import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.dont_write_bytecode = True

from program_checks import (  # noqa: E402
    MPIEXEC, PROGRAMS, check, finish, history, make_mesh, run_program)

THICKNESS = 0.75
FORCE = "contact.indenter-cartilage.source_force_z"
PEAK = "fluid.peak_pressure"


class Runs:
    """Runs of the miniapp on one mesh."""

    def __init__(self, directory: pathlib.Path) -> None:
        self.directory = directory
        self.mesh = directory / "indentation.msh"
        make_mesh("indentation.py", self.mesh, "--size", "1.9")

    def __call__(self, ranks: int, *arguments: str) -> list[dict[str, float]]:
        output = self.directory / "out"
        run_program(
            MPIEXEC, "-n", str(ranks), PROGRAMS / "indentation",
            "--mesh", self.mesh, "--output", output, "--overwrite",
            "--fields-every", "0", *arguments, text=f"{ranks} ranks, {' '.join(arguments)}")
        return history(output)


def difference(rows: list, others: list, column: str) -> float:
    """The largest relative difference."""
    check(len(rows) == len(others) > 0, "as many steps")
    return max(abs(a[column] / b[column] - 1.0) for a, b in zip(rows, others))


def check_contact(rows: list[dict[str, float]]) -> None:
    pair = "contact.indenter-cartilage."
    for row in rows:
        if (row[pair + "penetration"] > 1e-4 * THICKNESS
                or row[pair + "pressure_jump"] > 1e-2 * row[PEAK]
                or row[pair + "force_error"] > 1e-10 * row[FORCE]
                or abs(row["fluid.volume_balance"])
                > 1e-6 * abs(row["fluid.outflow"])):
            check(False, f"contact at t = {row['t']}: {row}")
    check(True, "gap, pressure jump, forces and fluid in balance in each of "
          f"{len(rows)} steps")
    augmentations = sum(row["solver.augmentations"] for row in rows)
    check(augmentations <= 3 * len(rows),
          f"{augmentations / len(rows):.2f} augmentations a step")


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        run = Runs(pathlib.Path(name))
        rows = run(2, "--check", "0.01")
        check(abs(rows[-1]["t"] - 1500.0) < 1e-9, "the run went to its end")
        check_contact(rows)

        short = ["--end", "100"]
        for ranks in (1, 3, 4):
            others = run(ranks, *short)
            for column in (FORCE, PEAK, "reaction.bone.z"):
                change = difference(others, rows[:4], column)
                check(change < 1e-6, f"{column} on {ranks} ranks differs by "
                      f"{change:.1e}")
        for factor in ("10", "10000"):
            others = run(2, "--penalty-factor", factor, *short)
            for column in (FORCE, PEAK):
                change = difference(others, rows[:4], column)
                check(change < 1e-3, f"{column} with penalty factor {factor} "
                      f"differs by {change:.1e}")
        for factor in ("10", "100", "10000"):
            others = run(2, "--solver", "block_amg", "--penalty-factor", factor,
                         "--active-set-tolerance", "0", "--end", "50")
            change = difference(others, rows[:2], FORCE)
            check(change < 1e-3, f"multigrid, penalty factor {factor}: the same "
                  f"force, to {change:.1e}")
            most = max(row["solver.most_linear"] for row in others)
            check(most <= 40, f"a linear system takes {most:.0f} iterations")
    finish()


if __name__ == "__main__":
    main()
