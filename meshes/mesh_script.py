"""What the mesh scripts share: options, and the way from a model to a file.

They import it first: it says how to run them where modules are missing.
"""

from __future__ import annotations

import argparse
import math
import os
import pathlib
import sys
from typing import Callable

sys.path.append(str(
    pathlib.Path(__file__).resolve().parents[1] / "scripts" / "lib"))

import missing_module  # noqa: E402,F401
import gmsh  # noqa: E402

import mesh_quality  # noqa: E402


def positive(text: str) -> float:
    """For options that are lengths or factors."""
    value = float(text)
    if not (math.isfinite(value) and value > 0):
        raise argparse.ArgumentTypeError(f"{text} is not positive")
    return value


def not_negative(text: str) -> float:
    value = float(text)
    if not (math.isfinite(value) and value >= 0):
        raise argparse.ArgumentTypeError(f"{text} is negative or not finite")
    return value


def check_output(parser: argparse.ArgumentParser, output: str) -> None:
    folder = os.path.dirname(os.path.abspath(output))
    if not os.path.isdir(folder):
        parser.error(f"--output: there is no directory '{folder}'")
    if not output.endswith(".msh"):
        parser.error(f"--output: '{output}' does not end in .msh")


def add_geometry_order(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--geometry-order", type=int, choices=(1, 2), default=1,
                        help="1: straight edges; 2: nodes between the corners, "
                             "which lie on the surfaces too (default "
                             "%(default)s)")


def run(script: str, output: str, build: Callable[[], dict[str, int]],
        verbose: bool = False, version: float = 4.1,
        binary: bool = False) -> int:
    """Writes the model that build() makes, after a report on its quality.

    build() gives the tags of the volumes by region. The return value is the
    exit status of the script.
    """
    gmsh.initialize([""])
    try:
        gmsh.option.setNumber("General.Terminal", int(verbose))
        gmsh.option.setNumber("General.NumThreads", 1)
        worst = 1.0
        for region, tag in build().items():
            quality = mesh_quality.measure([tag])
            worst = min(worst, quality.min_scaled_jacobian,
                        quality.min_jacobian_ratio)
            print(f"{region}: {quality}")
        if worst <= 0:
            print(f"{script}: error: the mesh has a tangled element; choose a "
                  "smaller --size, or other dimensions", file=sys.stderr)
            return 1
        gmsh.option.setNumber("Mesh.MshFileVersion", version)
        gmsh.option.setNumber("Mesh.Binary", int(binary))
        gmsh.write(output)
    except Exception as error:   # gmsh raises bare Exception
        print(f"{script}: error: {error}", file=sys.stderr)
        return 1
    finally:
        gmsh.finalize()
    print(f"wrote {output}")
    return 0
