"""From the anatomy of a knee to its mesh file, report and frames."""

from __future__ import annotations

import argparse
from typing import Callable

import gmsh_bodies
import knee_checks
import knee_joint
import mesh_script
from hexahedral_sweep import hexahedra_of, prisms_of
from knee_joint import Anatomy


def write(script: str, args: argparse.Namespace,
          anatomy: Callable[[], tuple[Anatomy, list[str]]]) -> int:
    """Writes args.output and, beside it, the frames; gives the exit status.

    anatomy() also gives lines that say where it comes from.
    """
    frames = args.output.removesuffix(".msh") + ".frames.toml"

    def build() -> dict[str, int]:
        body, lines = anatomy()
        knee = knee_joint.build(body, args)
        report = knee_checks.check(knee)
        gmsh_bodies.assemble("knee", knee.bodies, knee_joint.REGIONS,
                             knee_joint.SURFACES)
        toml = knee_joint.frame_lines(knee)
        with open(frames, "w", encoding="utf-8") as file:
            file.write("\n".join([f"# {line}" for line in lines] + toml) + "\n")
        hexahedra, prisms = (
            sum(len(elements(body)) for body in knee.bodies.values())
            for elements in (hexahedra_of, prisms_of))
        count = f"{hexahedra} hexahedra"
        if prisms:
            count += f" and {prisms} prisms"
        for line in [*lines, count, *report, *toml]:
            print(line)
        return knee_joint.REGIONS

    status = mesh_script.run(script, args.output, build, args.verbose,
                             binary=True)
    if status == 0:
        print(f"wrote {frames}")
    return status
