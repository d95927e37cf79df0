#!/usr/bin/env python3
"""An axisymmetric joint in three dimensions against a thin wedge of it.

Requirements: a quarter of a ring of meniscus between a spherical and a flat
layer, meshed with a core of quadrangles around the axis, bears what a wedge of
five degrees bears, one element wide, and has the same pressures: within 2 %. As
the meniscus's inner edge is sealed and its periphery drains, the pressure is
highest in the inner third, and not much lower at the edge itself.

Peaks of the traction are not compared: that of femur and tibia is at the last
vertices before the meniscus, which the two meshes have at different distances.
"""

from __future__ import annotations

import math
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "scripts"
                       / "lib"))
sys.dont_write_bytecode = True

import numpy as np  # noqa: E402

import section  # noqa: E402
from synovia_output import Output  # noqa: E402

from program_checks import (  # noqa: E402
    MPIEXEC, PROGRAMS, SOURCE, check, finish, history, make_mesh, run_program)

CASE = SOURCE / "miniapps" / "cases" / "meniscus_ring.toml"
PAIRS = ("femur-tibia", "tibia-meniscus", "meniscus-femur")
ANGLE = 5   # of the wedge, degrees
WITHIN = 0.02


def wedge_settings() -> list[str]:
    """Stiff springs hold the wedge at its inclined plane of symmetry."""
    with open(CASE) as file:
        surfaces = [line for line in file if line.startswith("surfaces = ")]
    number = surfaces.index('surfaces = ["symmetry_x"]\n')
    turn = math.radians(ANGLE)
    return [f"boundary.{number}.{setting}" for setting in (
        'surfaces=["symmetry_turned"]',
        'displacement=["free", "free", "free"]',
        "spring={stiffness = 1e6, direction = "
        f"[{-math.sin(turn)!r}, {math.cos(turn)!r}, 0]}}")]


def compress(directory: pathlib.Path, angle: int, ranks: int,
        *settings: str) -> dict[str, float]:
    """The last row of the history; forces are those of the whole turn."""
    mesh = directory / f"{angle}.msh"
    make_mesh("meniscus_ring.py", mesh, "--angle", str(angle),
              "--geometry-order", "2", "--size", "0.8")
    command = [MPIEXEC, "-n", str(ranks), PROGRAMS / "synovia", CASE,
               "--output", directory / str(angle)]
    for setting in (f'mesh.file="{mesh}"', "time.step=10", "time.end=50",
                    *settings):
        command += ["--set", setting]
    run_program(*command, text=f"{angle} degrees")
    row = history(directory / str(angle))[-1]
    return {name: value * (360 / angle if "force_" in name
                           or name.startswith("reaction.") else 1)
            for name, value in row.items()}


def check_meniscus(directory: pathlib.Path) -> None:
    """Where its pressure is highest, from the inner edge to the periphery."""
    output = Output(directory)
    grid = output.fields("bodies", output.field_times("bodies")[-1])
    rings = [body for body in section.bodies_of(grid)
             if np.hypot(*body.points[:, :2].T).min() > 1.0]
    check(len(rings) == 1, "one body, the meniscus, is clear of the axis")
    radius = np.hypot(*rings[0].points[:, :2].T)
    share = (radius - radius.min()) / np.ptp(radius)
    pressure = rings[0]["fluid_pressure"]
    at_peak = share[pressure.argmax()]
    check(at_peak < 1 / 3, f"the meniscus's pressure is highest at "
          f"{100 * at_peak:.0f} % of its width from the inner edge")
    at_edge = pressure[share < 1e-3].max() / pressure.max()
    check(at_edge > 0.5,
          f"at the sealed edge it is {100 * at_edge:.0f} % of that")
    at_periphery = abs(pressure[share > 1 - 1e-3]).max() / pressure.max()
    check(at_periphery < 0.01,
          f"at the periphery, which drains, {100 * at_periphery:.1f} %")


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        wedge = compress(directory, ANGLE, 1, *wedge_settings())
        quarter = compress(directory, 90, 2)
        check_meniscus(directory / "90")
    for column in ("reaction.femoral_cartilage_bone.z", "fluid.peak_pressure",
                   *(f"contact.{pair}.{what}" for pair in PAIRS
                     for what in ("force_z", "peak_pressure"))):
        check(abs(wedge[column]) > 0.1, f"{column} of the wedge is "
              f"{wedge[column]:.4g}")
        error = quarter[column] / wedge[column] - 1
        check(abs(error) <= WITHIN,
              f"{column} of the quarter differs by {100 * error:.2f} %")
    finish()


if __name__ == "__main__":
    main()
