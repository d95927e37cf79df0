#!/usr/bin/env python3
"""A small idealized knee, from its mesh to its pictures, on two ranks.

Requirements: the program and the case file are the same problem; the femur
touches the menisci first and the tibial cartilages later; all six pairs bear
load; forces, moments and fluid balance; pressures agree across the contact; the
horns sink, and hardly move otherwise; the load relaxes when the femur rests; the
pressure is highest in the inner third of the medial and the inner two thirds of
the lateral meniscus, whose inner edges are sealed.
"""

from __future__ import annotations

import pathlib
import re
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.dont_write_bytecode = True

from program_checks import (  # noqa: E402
    MPIEXEC, PROGRAMS, SOURCE, check, finish, history, make_mesh, run_program)

SIDES = ("medial", "lateral")
PAIRS = [f"{pair}-{side}" for side in SIDES
         for pair in ("femur-tibia", "tibia-meniscus", "meniscus-femur")]
HORNS = [f"spring.meniscus_{side}_horn_{end}." for side in SIDES
         for end in ("anterior", "posterior")]
# Of a horn's springs, N/mm.
STIFFNESS = {"x": 2000.0, "y": 2000.0, "z": 1.0}
THICKNESS = 2.0         # of the cartilage, mm
REACTION = "reaction.femoral_cartilage_bone.z"


def first_touch(rows: list[dict[str, float]], pair: str) -> float:
    return next((row["t"] for row in rows
                 if row[f"contact.{pair}.area"] > 0), float("inf"))


def check_contact(rows: list[dict[str, float]]) -> None:
    loaded = next(row for row in rows if abs(row["t"] - 100) < 1e-6)
    for pair in PAIRS:
        force = loaded[f"contact.{pair}.force_z"]
        check(abs(force) > 0.5 and loaded[f"contact.{pair}.area"] > 10,
              f"{pair} bears {abs(force):.1f} N at 100 s")
    for side in SIDES:
        menisci = first_touch(rows, f"meniscus-femur-{side}")
        tibia = first_touch(rows, f"femur-tibia-{side}")
        check(menisci < tibia <= 100,
              f"{side}: the femur touches the meniscus by {menisci:g} s, the "
              f"tibial cartilage by {tibia:g} s")
    worst = {"force_error": 0.0, "moment_error": 0.0, "penetration": 0.0,
             "pressure_jump": 0.0}
    for row in rows:
        for pair in PAIRS:
            prefix = f"contact.{pair}."
            force = max(sum(row[f"{prefix}force_{d}"]**2
                            for d in "xyz")**0.5, 1e-3)
            scales = {"force_error": force, "moment_error": 10 * force,
                      "penetration": THICKNESS,
                      "pressure_jump": max(row["fluid.peak_pressure"], 1e-9)}
            for name, scale in scales.items():
                worst[name] = max(worst[name], row[prefix + name] / scale)
    check(worst["force_error"] <= 1e-8 and worst["moment_error"] <= 1e-8,
          f"forces and moments of each pair balance to "
          f"{max(worst['force_error'], worst['moment_error']):.1e}")
    check(worst["penetration"] <= 1e-4,
          f"penetration is {worst['penetration']:.1e} of the thickness")
    check(worst["pressure_jump"] <= 0.02,
          f"pressures of facing surfaces differ by "
          f"{worst['pressure_jump']:.1e} of the peak")


def check_supports(rows: list[dict[str, float]]) -> None:
    for row in rows:
        joint = sum(row[f"contact.{pair}.source_force_z"] for pair in PAIRS
                    if "femur" in pair)
        balance = abs(row[REACTION] + joint)
        check(balance <= 1e-6 * max(abs(joint), 1e-3),
              f"{row['t']:g} s: the femur is in balance to {balance:.1e} N")
    loaded = next(row for row in rows if abs(row["t"] - 100) < 1e-6)
    for horn in HORNS:
        # The spring pulls up where its horn went down.
        sideways = 1e3 * max(abs(loaded[horn + d]) / STIFFNESS[d]
                             for d in "xy")
        down = 1e3 * loaded[horn + "z"] / STIFFNESS["z"]
        check(0.1 < sideways < 0.1 * down and down < 800,
              f"{horn[7:-1]} goes down by {down:.0f} micrometers, sideways by "
              f"{sideways:.1f}")
    worst = max(abs(row["fluid.volume_balance"])
                / max(abs(row["fluid.outflow"]), 1e-6) for row in rows)
    check(worst <= 1e-6, f"fluid balance to {worst:.1e} of the outflow")
    at_rest = [abs(row[REACTION]) for row in rows if row["t"] > 100 - 1e-6]
    check(len(at_rest) > 1 and at_rest == sorted(at_rest, reverse=True),
          f"the load relaxes from {at_rest[0]:.1f} to {at_rest[-1]:.1f} N")


def check_peaks(findings: str) -> None:
    for side, most in (("medial", 33), ("lateral", 67)):
        found = re.search(rf"slice of the {side} meniscus, .* the peak at "
                          r"(\d+) % of the width from the inner edge", findings)
        check(found is not None, f"the pictures' {side} slice has a peak")
        check(int(found[1]) <= most,
              f"the pressure of the {side} meniscus is highest at {found[1]} % "
              "of its width from the inner edge")


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        mesh = directory / "knee.msh"
        make_mesh("knee_parametric.py", mesh, "--size", "3")
        printed = run_program(
            MPIEXEC, "-n", "2", PROGRAMS / "knee", "--mesh", mesh, "--output",
            directory / "program", "--step", "10", "--end", "120")
        check("medial tibial cartilage: " in printed,
              "the program says what each side bears")
        check("step 12/12" in printed and "\x1b" not in printed,
              "a log gets whole lines, no terminal's codes")
        rows = history(directory / "program")
        check(len(rows) == 12, "twelve steps")
        check_contact(rows)
        check_supports(rows)

        case, finite = (
            (MPIEXEC, "-n", "2", PROGRAMS / "synovia",
             SOURCE / "miniapps" / "cases" / f"{name}.toml", "--output",
             directory / "case", "--set", f'mesh.file="{mesh}"')
            for name in ("knee", "knee_finite"))
        for one in (case, finite):
            check("warning" not in run_program(*one, "--check"),
                  "nothing is wrong with the case, springs hold the menisci")
        run_program(*case, "--set", "time.step=10", "--set", "time.end=20")
        same = history(directory / "case")[-1]
        difference = abs(same[REACTION] / rows[1][REACTION] - 1)
        check(same["t"] == rows[1]["t"] and difference < 1e-6,
              f"the case file gives the same to {difference:.1e}")

        check_peaks(run_program(
            sys.executable, SOURCE / "scripts" / "plot_knee.py",
            directory / "program", "-o", directory / "pictures"))
        for picture in ("knee.png", "knee.gif"):
            size = (directory / "pictures" / picture).stat().st_size
            check(size > 20000, f"{picture} has {size} bytes")
    finish()


if __name__ == "__main__":
    main()
