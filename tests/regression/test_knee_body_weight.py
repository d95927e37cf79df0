#!/usr/bin/env python3
"""The knee under body weight, a coarse idealized one, briefly, on two ranks.

Requirements: a femur that a force presses onto menisci which nothing else holds
but soft springs is caught by them in its first step; forces are in balance, of
the femur and of each pair; no element is inverted; the femur comes down as the
load grows, and creeps on while it is held; contact spreads; menisci bear a part
of the load, and so does the fluid.
"""

from __future__ import annotations

import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.dont_write_bytecode = True

from program_checks import (  # noqa: E402
    MPIEXEC, PROGRAMS, SOURCE, check, finish, history, make_mesh, run_program)

CASE = SOURCE / "miniapps" / "cases" / "knee_body_weight.toml"
SIDES = ("medial", "lateral")
ON_FEMUR = [f"contact.{kind}-{side}." for side in SIDES
            for kind in ("femur-tibia", "meniscus-femur")]
ON_TIBIA = [f"contact.{kind}-{side}." for side in SIDES
            for kind in ("femur-tibia", "tibia-meniscus")]
LOADED, HELD = 0.02, 0.22   # s
SPEED = 700.0               # of the load, N/s


def on_femur(row: dict[str, float], axis: str) -> float:
    return sum(row[f"{pair}source_force_{axis}"] for pair in ON_FEMUR)


def check_balance(row: dict[str, float], load: float) -> None:
    worst = max(abs(row[f"rigid_body.femur.force_{axis}"]
                    + on_femur(row, axis)) for axis in "xyz")
    check(worst <= 1e-8 * load, f"{row['t']:g} s: the femur's forces balance "
          f"to {worst / load:.1e} of the load")
    off = abs(row["rigid_body.femur.force_z"] + load)
    check(off <= 1e-8 * load, f"contact bears the load to {off / load:.1e}")
    worst = max(row[f"{pair}force_error"] for pair in ON_FEMUR + ON_TIBIA)
    check(worst <= 1e-8 * load, f"forces of each pair balance to "
          f"{worst / load:.1e} of the load")


def check_knee(row: dict[str, float]) -> None:
    load = on_femur(row, "z")
    menisci = sum(row[f"contact.meniscus-femur-{side}.source_force_z"]
                  for side in SIDES) / load
    check(0.05 < menisci < 0.95, f"{row['t']:g} s: {100 * menisci:.0f} % of the "
          "load go through the menisci")
    forces = [abs(row[f"{pair}force_z"]) for pair in ON_TIBIA]
    fluid = sum(force * row[f"{pair}fluid_load_support"] for force, pair
                in zip(forces, ON_TIBIA)) / sum(forces)
    check(0.2 < fluid < 1, f"the fluid bears {100 * fluid:.0f} % on the tibia")
    check(row["strain.min_det_F"] > 0.1,
          f"det F is {row['strain.min_det_F']:.2f} at least")


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        make_mesh("knee_parametric.py", directory / "knee.msh", "--size", "4")
        run_program(
            MPIEXEC, "-n", "2", PROGRAMS / "synovia", CASE, "--output",
            directory / "out", "--set", f'mesh.file="{directory}/knee.msh"',
            "--set", f"step.load.duration={LOADED}", "--set", "step.load.step="
            f"{LOADED / 2}", "--set", f"step.hold.duration={HELD - LOADED}",
            "--set", "step.hold.adaptive=false", "--set", "step.hold.step="
            f"{(HELD - LOADED) / 2}",
            "--set", "rigid_body.femur.force=[0, 0, {times = [0, "
            f"{LOADED}], values = [0, {-SPEED * LOADED}]}}]",
            "--set", "output.fields_every=0")
        rows = history(directory / "out")
        check(len(rows) == 4, f"{len(rows)} steps, none was cut")
        for row in rows:
            check_balance(row, SPEED * min(row["t"], LOADED))
            check_knee(row)
        way = [-row["rigid_body.femur.translation_z"] for row in rows]
        check(all(a < b for a, b in zip(way, way[1:])),
              "the femur comes down all the time: "
              + ", ".join(f"{z:.3f}" for z in way) + " mm")
        area = [sum(row[f"{pair}area"] for pair in ON_TIBIA) for row in rows]
        check(area[0] < area[1] <= area[3],
              f"contact spreads from {area[0]:.0f} to {area[3]:.0f} mm^2")
    finish()


if __name__ == "__main__":
    main()
