#!/usr/bin/env python3
"""The scaling miniapp on tiny meshes: the row that it adds to a table.

Requirements: as many unknowns as the mesh has; every order, element and solver
converges; the same forces with either solver, on one rank and on two; contact
forces in balance; volume matrices assembled, hierarchies set up and a kept
factorization made once; few iterations whatever the material and the penalty;
what goes wrong is said.
"""

from __future__ import annotations

import csv
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.dont_write_bytecode = True

from program_checks import MPIEXEC, PROGRAMS, check, finish  # noqa: E402

# columns that are no numbers
WORDS = ("elements", "solver", "deformation", "law", "reason")
SIZE, UPPER = 3, 2    # cells along an edge; 2 and 1 through the thickness


def unknowns(order: int) -> int:
    """Of hexahedra of order k with pressures of order k - 1, or 1."""
    total = 0
    for along, through in ((SIZE, 2), (UPPER, 1)):
        for components, k in ((3, order), (1, max(1, order - 1))):
            total += components * (k * along + 1) ** 2 * (k * through + 1)
    return total


class Runs:
    """Runs that share a table."""

    def __init__(self, table: pathlib.Path) -> None:
        self.table = table
        self.count = 0

    def start(self, ranks: int, *arguments: str):
        return subprocess.run(
            [MPIEXEC, "-n", str(ranks), PROGRAMS / "scaling", *arguments],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def __call__(self, ranks: int, *arguments: str) -> dict[str, float]:
        size = [] if "--size" in arguments else ["--size", str(SIZE)]
        result = self.start(ranks, *size, "--csv", self.table, *arguments)
        if result.returncode != 0:
            print(result.stdout)
        check(result.returncode == 0, f"{ranks} ranks, {' '.join(arguments)}")
        self.count += 1
        with open(self.table, newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        check(len(rows) == self.count, f"the table has {self.count} rows")
        row = rows[-1]
        for name, value in row.items():
            if f"{name:22}{value}" not in result.stdout:
                check(False, f"{name} = {value} is printed")
        return {name: float(value) for name, value in row.items()
                if name not in WORDS} | {"solver": row["solver"]}


def check_row(row: dict, ranks: int) -> None:
    check(row["converged"] == 1 and row["steps"] == 2, "two steps converged")
    check(row["ranks"] == ranks, f"on {ranks} ranks")
    check(row["assemblies"] == 1, "volume matrices assembled once")
    check(0 < row["most_linear"] <= row["linear"], "linear iterations")
    check(row["force"] < 0, f"pressed with {-row['force']:.5f} N")
    check(row["force_error"] < 1e-12,
          f"forces in balance to {row['force_error']:.0e}")
    check(row["contact_area"] > 0.5, f"area {row['contact_area']:.3f} mm^2")
    parts = sum(row[f"seconds_{name}"]
                for name in ("assembly", "search", "setup", "solve"))
    check(0 < parts <= ranks * row["seconds_total"], "times add up")
    check(0 < row["memory_max"] <= row["memory_sum"], "memory is measured")


def check_orders(run: Runs) -> None:
    for order in (1, 2, 3):
        forces = []
        for ranks, solver in ((1, "direct"), (1, "block_amg"),
                              (2, "block_amg")):
            row = run(ranks, "--order", str(order), "--solver", solver)
            check_row(row, ranks)
            check(row["solver"] == solver, f"solved by {solver}")
            check(row["dofs"] == unknowns(order),
                  f"order {order}: {row['dofs']:.0f} unknowns")
            check(row["cells"] == SIZE ** 2 * 2 + UPPER ** 2, "cells")
            # Systems of order 3 take more iterations than a hierarchy has to
            # serve before it may follow the contact.
            most = 0 if solver == "direct" else 5 if order == 3 else 3
            check(min(2, most) <= row["setups"] <= most,
                  "one hierarchy for pressures, one or two for displacements, "
                  "up to four with order 3")
            forces.append(row["force"])
            if solver == "direct":
                check(row["factorisations"] == 1, "one factorization")
        change = max(abs(force / forces[0] - 1.0) for force in forces)
        check(change < 1e-5, f"forces differ by {change:.0e}")


def check_options(run: Runs) -> None:
    row = run(2, "--elements", "tet", "--order", "2")
    check_row(row, 2)
    check(row["dofs"] == unknowns(2), "as many unknowns as with hexahedra")
    fine = run(2, "--refine", "1", "--order", "1")
    check(fine["cells"] == 8 * (SIZE ** 2 * 2 + UPPER ** 2), "split cells")
    row = run(1, "--no-contact", "--steps", "1")
    check(row["newton"] == 1 and row["searches"] == 0,
          "a linear problem without contact")
    # 0.1 E on 4 mm^2, drained and pressed against its bone
    check(abs(row["force"] / -0.2 - 1.0) < 1e-2, f"force {row['force']:.4f} N")


def check_hierarchy(run: Runs) -> None:
    rows = []
    for size in (6, 18):
        options = ["--order", "1", "--steps", "4", "--size", str(size)]
        row = run(2, *options, "--solver", "block_amg")
        rows.append(row)
        check(3 <= row["setups"] < 0.5 * row["newton"],
              f"{row['setups']:.0f} hierarchies for a contact that grows in "
              f"{row['newton']:.0f} iterations")
    growth = rows[1]["mean_linear"] / rows[0]["mean_linear"]
    check(growth < 1.5, f"iterations grow by {growth:.2f} with the mesh")
    direct = run(2, "--order", "1", "--steps", "4", "--size", "6",
                 "--solver", "direct")
    change = abs(direct["force"] / rows[0]["force"] - 1.0)
    check(change < 1e-5, f"forces differ by {change:.0e}")


def check_iterations(run: Runs) -> None:
    block_amg = ["--solver", "block_amg", "--steps", "1"]
    usual = run(1, *block_amg, "--size", "6", "--no-contact")
    for options in (["--poisson", "0.49"], ["--permeability", "1e-9"],
                    ["--jump", "1e4"]):
        row = run(1, *block_amg, "--size", "6", "--no-contact", *options)
        most = row["most_linear"]
        check(most <= min(40, 1.5 * usual["most_linear"]),
              f"{' '.join(options)}: {most:.0f} iterations, "
              f"{usual['most_linear']:.0f} at the base point")
    for factor in ("1e2", "1e8"):
        row = run(1, *block_amg, "--size", "4", "--penalty-factor", factor)
        check(row["most_linear"] <= 25, f"penalty factor {factor}: "
              f"{row['most_linear']:.0f} iterations")


def check_finite(run: Runs) -> None:
    """30 % of the thickness lost in four steps, in either theory."""
    squeeze = ["--size", "4", "--no-contact", "--compression", "0.3",
               "--steps", "4"]
    linear = {ranks: run(ranks, *squeeze, "--solver", "block_amg")
              for ranks in (1, 2)}
    for law in ("neo_hookean", "holmes_mow"):
        finite = ["--deformation", "finite", "--law", law]
        forces = []
        for ranks in (1, 2):
            row = run(ranks, *squeeze, *finite, "--solver", "block_amg")
            check(row["steps"] == 4 and row["newton"] <= 16,
                  f"{law}: {row['newton']:.0f} Newton iterations")
            usual = linear[ranks]["mean_linear"]
            check(row["mean_linear"] <= 1.3 * usual,
                  f"{row['mean_linear']:.1f} iterations, in infinitesimal "
                  f"strain {usual:.1f}")
            check(row["setups"] < row["newton"],
                  f"{row['setups']:.0f} hierarchies")
            forces.append(row["force"])
        row = run(1, *squeeze, *finite, "--solver", "direct",
                  "--active-set-tolerance", "1e-4")
        check(row["steps"] == 4 and row["newton"] <= 16,
              f"{row['newton']:.0f} Newton iterations with inexact systems")
        check(row["assemblies"] <= row["newton"] + 1, "a tangent in each")
        check(row["factorisations"] <= 0.25 * row["newton"],
              f"{row['factorisations']:.0f} factorizations")
        forces.append(row["force"])
        change = max(abs(force / forces[0] - 1.0) for force in forces)
        check(change < 1e-5, f"{law}: forces differ by {change:.0e}")
        check(forces[0] / linear[1]["force"] > 1.1,
              f"{forces[0]:.3f} N, in infinitesimal strain "
              f"{linear[1]['force']:.3f} N")


def check_errors(run: Runs) -> None:
    for arguments, word in ((["--elements", "prism"], "hex or tet"),
                            (["--deformation", "small"], "or finite"),
                            (["--law", "hooke"], "or holmes_mow"),
                            (["--compression", "1"], "--compression is 1"),
                            (["--size", "0"], "--size is 0; it must"),
                            (["--steps", "0"], "--steps"),
                            (["--solver", "magic"], "block_amg"),
                            (["--csv", "/nowhere/row.csv", "--size", "2"],
                             "cannot write"),
                            (["--sise", "2"], "--help")):
        result = run.start(1, *arguments)
        check(result.returncode == 1 and word in result.stdout,
              f"{' '.join(arguments)} is refused: {word}")


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        run = Runs(pathlib.Path(name) / "rows.csv")
        check_orders(run)
        check_options(run)
        check_iterations(run)
        check_finite(run)
        check_hierarchy(run)
        check_errors(run)
    finish()


if __name__ == "__main__":
    main()
