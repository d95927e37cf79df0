"""Options of scripts that run the miniapps, miniapps/scaling most of all."""

from __future__ import annotations

import argparse
import os
import pathlib


def add_launcher(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--launcher", metavar="COMMAND",
                        default=os.environ.get("MPIEXEC", "mpirun") + " -n",
                        help="what comes before the number of ranks "
                        "(default: $MPIEXEC -n, or mpirun -n)")


def add_runner_options(parser: argparse.ArgumentParser,
                       timeout: float = 3600.0) -> None:
    """launcher, program, output and timeout, as Runner takes them."""
    root = pathlib.Path(__file__).resolve().parents[2]
    add_launcher(parser)
    parser.add_argument("--program", type=pathlib.Path,
                        default=root / "build/miniapps/scaling",
                        help="the miniapp (default: %(default)s)")
    parser.add_argument("-o", "--output", type=pathlib.Path, metavar="OUT",
                        default=pathlib.Path("out/benchmark"),
                        help="default: %(default)s")
    parser.add_argument("--timeout", type=float, default=timeout,
                        metavar="SECONDS", help="for one run (%(default)g)")
