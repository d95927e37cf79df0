#!/usr/bin/env python3
"""The partial_assembly miniapp on tiny meshes.

Requirements: assembled and partially assembled products agree to round-off for
each order, on one rank and on two; all times are measured; a wrong order is
said.
"""

from __future__ import annotations

import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.dont_write_bytecode = True

from program_checks import (  # noqa: E402
    MPIEXEC, PROGRAMS, check, finish, run_program)

PROGRAM = PROGRAMS / "partial_assembly"
TIMES = ("setup_assembled", "setup_partial", "product_assembled",
         "product_partial", "sweep")


def main() -> None:
    for ranks, order in ((1, 1), (1, 2), (2, 2), (2, 3)):
        output = run_program(
            MPIEXEC, "-n", str(ranks), PROGRAM, "--size", "3", "--products",
            "2", "--order", str(order), text=f"order {order}, {ranks} ranks")
        row = {name: float(value) for name, value in
               map(str.split, output.splitlines())}
        check(row["ranks"] == ranks and row["order"] == order, "as asked for")
        check(row["difference"] < 1e-12,
              f"products differ by {row['difference']:.0e}")
        check(all(row[name] > 0.0 for name in TIMES), "times are measured")
    refused = subprocess.run([PROGRAM, "--order", "0"], text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    check(refused.returncode != 0 and "--order" in refused.stdout,
          "order 0 is refused")
    finish()


if __name__ == "__main__":
    main()
