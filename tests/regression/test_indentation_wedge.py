#!/usr/bin/env python3
# processors: 1
"""Axisymmetric indentations on a wedge of one element.

Requirements: the angle of the wedge doesn't matter, and springs hold its second
plane; a creep test ends at the depth that relaxation holds with that force; a
flat indenter in contact bears what the punch does; a sphere on a thick layer
bears what Dimitriadis et al. (Biophys J 82:2798-2810, 2002) give for a layer
that is bonded to its base,

  F = 16/9 E sqrt(R) d^(3/2) [1 - 2 a0/pi x + 4 a0^2/pi^2 x^2
                              - 8/pi^3 (a0^3 + 4 pi^2/15 b0) x^3 + ...],

there for nu = 1/2; here for nu = 0, with 4/3 in place of 16/9, a0 = -1.2876,
b0 = 0.6387 and x = sqrt(R d)/h. The next term is below 0.1 % here.
"""

from __future__ import annotations

import math
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))

from python_package import CASES, SOURCE, synovia  # noqa: E402

import numpy as np  # noqa: E402

from program_checks import check, finish  # noqa: E402

DEPTH = 0.075   # mm, of the punch
RELAXED = 0.138361087672    # N, tests/reference/indent_force.csv


def whole_turn(angle: float) -> float:
    """What takes forces of a wedge (degrees) to those of the whole."""
    return 2 * math.pi / math.sin(math.radians(angle))


def wedge(folder: pathlib.Path, *options: str, angle: float = 5
          ) -> synovia.Case:
    case = synovia.Case(CASES / "indentation_wedge.toml")
    case.mesh.file = str(folder / "wedge.msh")
    case.mesh.generator = ["indentation_wedge.py", "--angle", str(angle),
                           *options]
    turn = math.radians(angle)
    case["boundary.symmetry_turned.spring.direction"] = [
        -math.sin(turn), math.cos(turn), 0]
    case.output.fields_every = 0
    case.make_mesh()
    return case


def run(case: synovia.Case, folder: pathlib.Path) -> synovia.Result:
    return case.run(output=folder / "out", overwrite=True)


def near(value: float, exact: float, tolerance: float, text: str) -> None:
    error = value / exact - 1
    check(abs(error) <= tolerance, f"{text}: {value:.5g}, {100 * error:+.2f} % "
          f"from {exact:.5g}")


def angles(folder: pathlib.Path) -> None:
    forces = {}
    for angle in (5.0, 2.5):
        case = wedge(folder, "--size", "3", angle=angle)
        case.time = {"end": 500, "step": 100}
        case.output.fields_every = 5
        result = run(case, folder)
        forces[angle] = whole_turn(angle) * result.force("punch")[-1, 2]
        turn = math.radians(angle)
        normal = np.array([-math.sin(turn), math.cos(turn), 0])
        mesh = result.mesh()
        on = np.abs(mesh.points @ normal) < 1e-6
        check(on.sum() > 50, f"{on.sum()} points on the turned plane")
        off = np.abs(mesh["displacement"][on] @ normal).max() / DEPTH
        check(off < 1e-5, f"it gives way by {off:.1e} of the indentation")
    near(forces[2.5], forces[5.0], 3e-4, "half the angle")


def creep(folder: pathlib.Path) -> None:
    case = wedge(folder, "--size", "2")
    punch = case.boundary["punch"]
    punch.displacement = ["free", "free", "free"]
    punch.force = {"direction": [0, 0, -1],
                   "curve": {"times": [0, 5],
                             "values": [0, RELAXED / whole_turn(5)]}}
    case.time = {"end": 3000, "step": 100, "scheme": "sdirk33"}
    travel = run(case, folder).history["travel.punch"]
    check((np.diff(travel) > -1e-9).all() and travel[0] < 0.8 * travel[-1],
          "the punch creeps")
    near(travel[-1], DEPTH, 6e-3, "depth at rest")


def flat_indenter(folder: pathlib.Path) -> None:
    case = wedge(folder, "--size", "2", "--indenter", "flat")
    del case["boundary.punch"], case["boundary.top"]
    add_indenter(case, 541.7, [0, 500], DEPTH)
    case.time.step = 50
    result = run(case, folder)
    force = -whole_turn(5) * result.force("indenter_top")[:, 2]
    exact = synovia.Table(SOURCE / "tests/reference/indent_force.csv")
    for t in (250, 500, 1500):
        near(force[result.t == t][0], exact.where("t", t)["F_permeable"][0],
             6e-3, f"flat indenter in contact, {t} s")


def sphere(folder: pathlib.Path) -> None:
    radius, thickness, depth, modulus = 10.0, 20.0, 0.1, 1.0
    case = wedge(folder, "--indenter", "sphere", "--sphere-radius", "10",
                 "--indenter-radius", "1.5", "--thickness", "20",
                 "--radius", "100")
    case.material[0].solid = {"E": modulus, "nu": 0.0}
    del case["boundary.punch"], case["boundary.top"]
    # So slowly that the fluid bears nothing.
    add_indenter(case, 1e4, [0, 1e6], depth)
    case.time = {"end": 1e6, "step": 2e5}
    result = run(case, folder)
    force = -whole_turn(5) * result.force("indenter_top")[-1, 2]
    a0, b0 = -1.2876, 0.6387
    x = math.sqrt(radius * depth) / thickness
    layer = (1 - 2 * a0 / math.pi * x + 4 * a0**2 / math.pi**2 * x**2
             - 8 / math.pi**3 * (a0**3 + 4 * math.pi**2 / 15 * b0) * x**3)
    near(force, 4 / 3 * modulus * math.sqrt(radius) * depth**1.5 * layer,
         1e-2, "sphere on a thick layer")


def add_indenter(case: synovia.Case, modulus: float, times: list[float],
                 depth: float) -> None:
    case.material[0].regions = "cartilage"
    case.material.append(regions="indenter", solid={"E": modulus, "nu": 0.125},
                         permeability={"value": 4.0}, solid_fraction=0.95)
    case.boundary.append(
        surfaces="indenter_top", pressure=0,
        displacement=["free", "free", {"times": times, "values": [0, -depth]}])
    case.contact.append(source="indenter_bottom",
                        destination=["punch", "top"])


def main() -> None:
    with tempfile.TemporaryDirectory(prefix="synovia wedge ") as name:
        for test in (angles, creep, flat_indenter, sphere):
            test(pathlib.Path(name))
    finish()


if __name__ == "__main__":
    main()
