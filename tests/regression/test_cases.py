#!/usr/bin/env python3
"""The shipped case files, from mesh to results, against closed forms.

Requirements: each case runs as its opening comment says, on two ranks, with the
accuracy stated there; the fluid balance is kept in every step; no case gives a
penalty; what is written is a case again, which gives the same.
"""

from __future__ import annotations

import csv
import math
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.dont_write_bytecode = True

from program_checks import (  # noqa: E402
    MPIEXEC, PROGRAMS, SOURCE, check, finish, history, make_mesh, run_program)

CASES = SOURCE / "miniapps" / "cases"
E, NU, KAPPA = 0.5417, 0.0833, 4.0e-3
H_A = E * (1 - NU) / ((1 + NU) * (1 - 2 * NU))

run_cases: set[str] = set()


def close(value: float, exact: float, tolerance: float, text: str) -> None:
    check(abs(value / exact - 1) <= tolerance,
          f"{text}: {value:.6g}, exact {exact:.6g}, "
          f"{100 * (value / exact - 1):.3f} %")


def confined_stress(t: float, speed: float, end: float, h: float) -> float:
    """Under a platen that moves with this speed until `end`."""
    c = H_A * KAPPA

    def ramp(t: float) -> float:
        if t <= 0:
            return 0.0
        series = sum(math.exp(-(n * math.pi / h)**2 * c * t) / n**2
                     for n in range(1, 200))
        return H_A * speed / h * (t + h * h / c * (1 / 3 - 2 / math.pi**2
                                                   * series))
    return ramp(t) - ramp(t - end)


def reference(file: str, key: str, column: str) -> dict[float, float]:
    with open(SOURCE / "tests" / "reference" / file) as stream:
        rows = csv.DictReader(line for line in stream
                              if not line.startswith("#"))
        return {float(row[key]): float(row[column]) for row in rows}


class Runs:
    def __init__(self, directory: pathlib.Path) -> None:
        self.directory = directory

    def mesh(self, script: str, *arguments: str) -> pathlib.Path:
        file = self.directory / "mesh.msh"
        make_mesh(script, file, *arguments)
        return file

    def __call__(self, case: pathlib.Path, mesh: pathlib.Path,
                 *settings: str, ranks: int = 2) -> list[dict[str, float]]:
        run_cases.add(case.stem)
        output = self.directory / "out"
        command = [MPIEXEC, "-n", str(ranks), PROGRAMS / "synovia",
                   case, "--output", output, "--overwrite",
                   "--set", f'mesh.file="{mesh}"']
        for setting in settings:
            command += ["--set", setting]
        run_program(*command, text=f"{case.name} {' '.join(settings)}")
        rows = history(output)
        # None flows out of a column whose platen rests.
        least = 1e-6 * max(abs(row["fluid.outflow"]) for row in rows)
        worst = max(abs(row["fluid.volume_balance"])
                    / max(abs(row["fluid.outflow"]), least) for row in rows)
        check(worst <= 1e-6, f"fluid balance to {worst:.1e} of the outflow in "
              f"each of {len(rows)} steps")
        return rows


def at(rows: list[dict[str, float]], t: float) -> dict[str, float]:
    found = [row for row in rows if abs(row["t"] - t) < 1e-6]
    check(len(found) == 1, f"a step ends at t = {t:g}")
    return found[0]


def balanced(rows: list[dict[str, float]], pair: str,
             moment_tolerance: float = 1e-10) -> None:
    """Forces and moments that a pair exerts on its two sides cancel."""
    prefix = f"contact.{pair}."
    for kind, tolerance in (("force", 1e-10), ("moment", moment_tolerance)):
        worst = max(row[f"{prefix}{kind}_error"] / abs(row[prefix + "force_z"])
                    for row in rows)
        check(worst <= tolerance, f"{kind}s in balance to {worst:.1e} of the "
              f"force in each of {len(rows)} steps")


def confined(run: Runs) -> None:
    mesh = run.mesh("boxes.py", "confined_compression")
    rows = run(CASES / "confined_compression.toml", mesh)
    for t in (50, 250, 500, 750):
        close(-at(rows, t)["reaction.top.z"] / 0.04,
              confined_stress(t, 0.075 / 500, 500, 0.75), 1e-3,
              f"stress at {t} s")
    exact = reference("confined_ramp_reaction.csv", "t", "p_base")
    with open(run.directory / "out" / "lines" / "depth_t250.csv") as file:
        base = next(csv.DictReader(file))
    close(float(base["p"]), exact[250.0], 3e-3, "pressure at the base, 250 s")
    again = run(run.directory / "out" / "case.toml", mesh, "time.end=50",
                ranks=1)
    close(again[-1]["reaction.top.z"], at(rows, 50)["reaction.top.z"], 1e-7,
          "the same from the case that was written, on another number of ranks")
    adaptive = run(CASES / "confined_compression.toml", mesh,
                   "time.adaptive=true")
    close(-at(adaptive, 500)["reaction.top.z"] / 0.04,
          confined_stress(500, 0.075 / 500, 500, 0.75), 5e-3,
          "stress with adaptive steps")


def relaxation_and_recovery(run: Runs) -> None:
    mesh = run.mesh("boxes.py", "confined_compression")
    rows = run(CASES / "relaxation_and_recovery.toml", mesh)
    for t in (50, 500, 600, 2500):
        close(-at(rows, t)["reaction.top.z"] / 0.04,
              confined_stress(t, 0.075 / 500, 500, 0.75), 1e-3,
              f"stress at {t} s")
    check({row["t"]: row["step"] for row in rows}
          == {row["t"]: 1 + (row["t"] > 500) + (row["t"] > 2500)
              for row in rows}, "the history says which step it is")
    check(all(row["reaction.top.z"] == 0.0 for row in rows
              if row["step"] == 3), "nothing holds what is released")
    with open(run.directory / "out" / "lines" / "depth_t2550.csv") as file:
        top = list(csv.DictReader(file))[-1]
    series = sum(2 * math.exp(-m * m * H_A * KAPPA * 50 / 0.75**2) / (m * m)
                 for m in ((n + 0.5) * math.pi for n in range(100)))
    close(float(top["uz"]), -0.075 * series, 5e-3,
          "displacement 50 s after the release")


def unconfined(run: Runs) -> None:
    mesh = run.mesh("boxes.py", "unconfined_compression")
    rows = run(CASES / "unconfined_compression.toml", mesh)
    exact = reference("unconfined_ramp_force.csv", "t", "F")
    for t in (100, 250, 500, 700, 1000):
        close(-4 * at(rows, t)["reaction.top.z"], exact[t], 3e-3,
              f"force at {t} s")


NEO_HOOKEAN = ('material.0.solid={model = "neo_hookean", E = 0.5, nu = 0.1}',
               'material.0.permeability={model = "constant", value = 4e-3}')


def confined_finite(run: Runs) -> None:
    mesh = run.mesh("boxes.py", "confined_compression", "--size", "2")
    area = (0.2 / 0.75)**2
    for law, settings in (("holmesmow", ()),
                          ("neohookean_constant", NEO_HOOKEAN)):
        rows = run(CASES / "confined_compression_finite.toml", mesh,
                   "time.end=600", "time.step=25", *settings)
        file = f"finite_confined_{law}.csv"
        stress = reference(file, "t", "stress")
        for t in (100, 250, 500, 600):
            close(at(rows, t)["reaction.top.z"] / area, stress[t], 2e-3,
                  f"stress at {t} s, {law}")
        exact = reference(file, "t", "p_base")
        with open(run.directory / "out" / "lines" / "depth_t250.csv") as depth:
            base = next(csv.DictReader(depth))
        close(float(base["p"]), exact[250.0], 2e-3,
              f"pressure at the base, 250 s, {law}")


def unconfined_finite(run: Runs) -> None:
    mesh = run.mesh("boxes.py", "unconfined_compression")
    area = math.pi * 1.5**2 / 4
    for law, settings in (("holmesmow", ()),
                          ("neohookean_constant", NEO_HOOKEAN)):
        rows = run(CASES / "unconfined_compression_finite.toml", mesh,
                   "time.end=600", *settings)
        exact = reference(f"finite_unconfined_{law}.csv", "t", "mean_stress")
        for t in (100, 250, 500, 600):
            close(at(rows, t)["reaction.top.z"] / area, exact[t], 2e-3,
                  f"force at {t} s, {law}")


def two_columns(run: Runs) -> None:
    rows = run(CASES / "two_columns.toml", run.mesh("boxes.py", "two_columns"))
    for t in (100, 250, 500, 750, 1000):
        close(-at(rows, t)["reaction.upper_top.z"] / 0.09,
              confined_stress(t, 0.1 / 500, 500, 1.5), 1e-3, f"stress at {t} s")
    balanced(rows, "columns")


def friction_plate(run: Runs) -> None:
    rows = run(CASES / "friction_plate.toml",
               run.mesh("boxes.py", "column_on_plate"))
    exact = reference("friction_creep.csv", "t", "p_over_P")
    check(len(exact) == 7, "times to compare")
    for t, support in exact.items():
        row = at(rows, t)
        close(row["contact.plate.friction_coefficient"],
              0.3 * (1 - 0.96 * support), 1e-2, f"friction at {t}")
        check(abs(row["contact.plate.fluid_load_support"] - support) <= 5e-3,
              f"fluid load support at {t}")
    check(all(after["contact.plate.dissipation"]
              >= before["contact.plate.dissipation"]
              for before, after in zip(rows, rows[1:])),
          "friction takes energy in each step")
    # Friction acts at either end of a gap that is within its tolerance.
    balanced(rows, "plate", 1e-6)


def core_stresses(times: tuple[float, ...], step: float = 0.625) -> list[float]:
    """Of cartilage on bone in one dimension, by finite volumes, both drained.

    u' = (s + p)/H, so that (s' + p')/H = (k p')' in time and space, with the
    stress s for which the strains add up to what the top has moved.
    """
    layers = ((100 * 0.7 / (1.3 * 0.4), 2.0e-3), (H_A, KAPPA))
    cells = 200     # a layer
    h = 1.0 / cells
    modulus = [m for m, _ in layers for _ in range(cells)]
    kappa = [k for _, k in layers for _ in range(cells)]
    n = 2 * cells
    between = [2 * kappa[0] / h] + [
        2 / (h / a + h / b) for a, b in zip(kappa, kappa[1:])] + [
        2 * kappa[-1] / h]
    flow = [step * between[i] for i in range(n + 1)]

    def solve(right: list[float]) -> list[float]:
        ratio, value = [0.0] * n, [0.0] * n
        for i in range(n):
            below = flow[i] if i else 0.0
            pivot = (h / modulus[i] + flow[i] + flow[i + 1]
                     - (below * ratio[i - 1] if i else 0.0))
            ratio[i] = flow[i + 1] / pivot
            value[i] = (right[i] + (below * value[i - 1] if i else 0.0)) / pivot
        for i in reversed(range(n - 1)):
            value[i] += ratio[i] * value[i + 1]
        return value

    # The pressure that a change of the stress by 1 makes in a step.
    unit = solve([-h / m for m in modulus])
    compliance = sum(h * (1 + p) / m for p, m in zip(unit, modulus))
    pressure, stress, found = [0.0] * n, 0.0, []
    for number in range(1, round(max(times) / step) + 1):
        still = solve([h / m * p for p, m in zip(pressure, modulus)])
        moved = -0.05 * min(1.0, number * step / 500)
        strains = sum(h * (stress + p) / m for p, m in zip(still, modulus))
        change = (moved - strains) / compliance
        stress += change
        pressure = [p + change * q for p, q in zip(still, unit)]
        if any(abs(number * step - t) < 1e-6 for t in times):
            found.append(stress)
    return found


def osteochondral_core(run: Runs) -> None:
    rows = run(CASES / "osteochondral_core.toml",
               run.mesh("boxes.py", "osteochondral_core"))
    times = (100, 250, 500, 750, 1000)
    for t, stress in zip(times, core_stresses(times)):
        row = at(rows, t)
        close(row["reaction.cartilage_top.z"] / 0.16, stress, 1e-3,
              f"stress at {t} s")
        close(row["tie.tidemark.force_z"] / 0.16,
              -row["reaction.cartilage_top.z"] / 0.16, 1e-6,
              f"the tie bears the stress at {t} s")
        check(t > 500 or row["tie.tidemark.fluid_exchange"] < 0,
              f"fluid flows into the bone at {t} s")
    for row in rows:
        check(row["tie.tidemark.displacement_jump"] <= 1e-6
              and row["tie.tidemark.moment_error"] <= 1e-9
              and row["tie.tidemark.force_error"] <= 1e-12,
              f"the tie holds and is in balance at {row['t']} s")


def sliding_sphere(run: Runs) -> None:
    """The first half of both cases of the sphere, on a coarse mesh."""
    mesh = run.mesh("boxes.py", "sliding_layer", "--size", "1.5")
    support, friction = "fluid_load_support", "friction_coefficient"
    change: dict[str, dict[str, float]] = {}
    last: dict[str, dict[str, float]] = {}
    for case in ("migrating_contact", "resting_contact"):
        rows = run(CASES / f"{case}.toml", mesh, "time.end=227")
        first, last[case] = at(rows, 27), at(rows, 227)
        change[case] = {name: last[case][f"contact.sphere.{name}"]
                        / first[f"contact.sphere.{name}"]
                        for name in (support, friction)}
        for row in rows:
            # Before it slides, friction is towards the middle.
            if row["t"] < 4:
                continue
            law = 0.284 * (1 - 0.983 * row["contact.sphere.fluid_load_support"])
            ratio = row["contact.sphere.friction_coefficient"] / law
            check(0.95 < ratio < 1.12, f"friction at {row['t']:g} s is "
                  f"{ratio:.3f} times that of the solid's share")
        check(all(after["contact.sphere.dissipation"]
                  >= before["contact.sphere.dissipation"]
                  for before, after in zip(rows, rows[1:])),
              "friction takes energy in each step")
        check(all(abs(row["contact.sphere.source_force_z"] / 0.5 - 1) < 1e-4
                  for row in rows if row["t"] >= 2), "the layer bears the load")
        balanced(rows, "sphere", 1e-2)
    # From the end of the first stroke on.
    stays, falls = change["migrating_contact"], change["resting_contact"]
    check(0.93 < stays[support] < 1.02, "where contact migrates the fluid's "
          f"share stays: {stays[support]:.3f} times the first one")
    check(falls[support] < 0.75, "where it rests the share falls: "
          f"{falls[support]:.3f} times the first one")
    check(0.98 < stays[friction] < 1.07, "where it migrates friction stays: "
          f"{stays[friction]:.3f} times the first one")
    check(falls[friction] > 1.25, "where it rests friction grows: "
          f"{falls[friction]:.3f} times the first one")
    rests, migrates = (last[case][f"contact.sphere.{support}"]
                       for case in ("resting_contact", "migrating_contact"))
    check(rests < 0.85 * migrates, "in the end the fluid bears "
          f"{100 * rests:.0f} % where contact rests, {100 * migrates:.0f} % "
          "where it migrates")


def hertz(run: Runs) -> None:
    rows = run(CASES / "hertz.toml", run.mesh("hertz.py", "--size", "1.5"))
    last = rows[-1]
    close(-last["contact.bodies.force_z"], 0.003663, 1e-6,
          "contact force, which the driving force makes")
    close(-last["reaction.upper_top.z"], 0.003663, 1e-6, "driving force")
    close(last["contact.bodies.peak_traction"], 0.0069958, 5e-2,
          "peak pressure on the coarse mesh")
    close(last["contact.bodies.area"], math.pi / 4, 5e-2, "contact area")
    balanced(rows, "bodies")


def glenohumeral(run: Runs) -> None:
    mesh = run.mesh("glenohumeral.py", "--size", "2.5")
    joint(run(CASES / "glenohumeral.toml", mesh, "time.end=2",
              "time.step=0.5"))


def glenohumeral_hexahedra(run: Runs) -> None:
    mesh = run.mesh("glenohumeral.py", "--hex", "--size", "2")
    # Displacements of order 1 on curved elements have no rigid rotations, so
    # that moments (mm) balance as the mesh gets finer only.
    joint(run(CASES / "glenohumeral_hexahedra.toml", mesh, "time.end=5"), 1e-2)


def joint(rows: list[dict[str, float]],
          moment_tolerance: float = 1e-10) -> None:
    last = rows[-1]
    check(last["contact.joint.force_z"] < 0, "the joint bears a load")
    check(0.65 < last["contact.joint.fluid_load_support"] < 1.0,
          f"{100 * last['contact.joint.fluid_load_support']:.0f} % of the load "
          "is borne by the fluid")
    augmentations = sum(row["solver.augmentations"] for row in rows)
    check(augmentations <= 3 * len(rows),
          f"{augmentations / len(rows):.2f} augmentations a step")
    balanced(rows, "joint", moment_tolerance)


def meniscus_ring(run: Runs) -> None:
    mesh = run.mesh("meniscus_ring.py", "--angle", "90", "--size", "1.4")
    rows = run(CASES / "meniscus_ring.toml", mesh, "time.end=50",
               "time.step=10")
    last = rows[-1]
    for pair in ("femur-tibia", "tibia-meniscus", "meniscus-femur"):
        check(abs(last[f"contact.{pair}.force_z"]) > 1, f"{pair} bears a load")
        balanced([last], pair)
    close(last["reaction.symmetry_x.x"], last["reaction.symmetry_y.y"], 1e-2,
          "both planes of symmetry hold as much")


def indentation(run: Runs) -> None:
    mesh = run.mesh("indentation.py", "--size", "1.9")
    rows = run(CASES / "indentation.toml", mesh, "time.end=250")
    close(4 * at(rows, 250)["contact.indenter-cartilage.source_force_z"],
          0.0802910477, 1e-2, "force at 250 s")
    augmentations = sum(row["solver.augmentations"] for row in rows)
    check(augmentations <= 3 * len(rows),
          f"{augmentations / len(rows):.2f} augmentations a step")
    for name in ("axis_t250", "contact_cartilage_t250",
                 "contact_indenter_t250"):
        check((run.directory / "out" / "lines" / f"{name}.csv").exists(),
              f"lines/{name}.csv")


def indentation_hexahedra(run: Runs) -> None:
    mesh = run.mesh("indentation.py", "--hex", "--size", "1.5", "--rim",
                    "0.0034", "--growth", "1.2")
    rows = run(CASES / "indentation_hexahedra.toml", mesh, "time.end=250")
    close(4 * at(rows, 250)["contact.indenter-cartilage.source_force_z"],
          0.0802910477, 3e-3, "force at 250 s")


def indentation_finite(run: Runs) -> None:
    mesh = run.mesh("indentation.py", "--size", "2.5")
    rows = run(CASES / "indentation_finite.toml", mesh)
    # Of the exact force of small displacements, times how much more another
    # program finds in finite deformation.
    for t, force in ((500, 0.1602), (1500, 0.1489)):
        close(-4 * at(rows, t)["reaction.indenter_top.z"], force, 5e-3,
              f"force at {t} s, finite deformation")
    least = min(row["strain.min_det_F"] for row in rows)
    check(least > 0.2, f"det F of {least:.2f} at least")
    newton = sum(row["solver.newton"] for row in rows)
    check(newton <= 4 * len(rows), f"{newton / len(rows):.1f} Newton "
          "iterations a step")
    balanced(rows, "indenter-cartilage")


def indentation_wedge(run: Runs) -> None:
    rows = run(CASES / "indentation_wedge.toml",
               run.mesh("indentation_wedge.py"), ranks=1)
    exact = reference("indent_force.csv", "t", "F_permeable")
    turn = 2 * math.pi / math.sin(math.radians(5))
    for t in (100, 250, 500, 1500):
        close(-turn * at(rows, t)["reaction.punch.z"], exact[t], 3e-3,
              f"force at {t} s")


def glenohumeral_finite(run: Runs) -> None:
    mesh = run.mesh("glenohumeral.py", "--size", "2.5")
    joint(run(CASES / "glenohumeral_finite.toml", mesh, "time.end=2",
              "time.step=0.5"))


def glenohumeral_ligaments(run: Runs) -> None:
    mesh = run.mesh("glenohumeral.py", "--full", "--hex", "--size", "2.5")
    rows = run(CASES / "glenohumeral_ligaments.toml", mesh, "time.end=20",
               "time.step=2")
    pressed, flexed = at(rows, 10), at(rows, 20)
    worst = max(abs(row["joint.shoulder.flexion"]
                    - 0.01 * max(0.0, row["t"] - 10)) for row in rows)
    check(worst < 1e-8, f"flexion is as prescribed, to {worst:.1e}")
    for name in ("front", "back", "left", "right"):
        close(pressed[f"ligament.{name}.force"],
              pressed["ligament.front.force"], 1e-2,
              f"before flexion the {name} ligament bears as much as the others")
    check(flexed["ligament.front.force"] > 5, "the front ligament is taut, "
          f"{flexed['ligament.front.force']:.2f} N")
    check(flexed["ligament.back.force"] == 0, "the back ligament is slack")
    check(flexed["joint.shoulder.flexion_moment"] > 1, "a moment of "
          f"{flexed['joint.shoulder.flexion_moment']:.1f} N mm flexes it")
    for row in (pressed, flexed):
        bones = [[row[f"rigid_body.{name}.force_{axis}"] for axis in "xyz"]
                 for name in ("scapula", "humerus")]
        check(all(abs(a + b) < 1e-7 * abs(bones[1][2])
                  for a, b in zip(*bones)), "the bones' forces are opposite")
        close(row["contact.joint.source_force_z"], -bones[1][2], 1e-6,
              "contact bears what the humerus exerts")
    # What has slid over the edge of a face by little stays with it until the
    # next search: forces of both sides may be 0.01 mm from one line.
    balanced(rows, "joint", moment_tolerance=1e-2)
    newton = sum(row["solver.newton"] for row in rows)
    check(newton <= 9 * len(rows),
          f"{newton / len(rows):.1f} Newton iterations a step")


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        run = Runs(pathlib.Path(name))
        for case in (confined, relaxation_and_recovery, unconfined,
                     confined_finite,
                     unconfined_finite, two_columns, osteochondral_core,
                     friction_plate, sliding_sphere, hertz, indentation,
                     indentation_hexahedra, indentation_finite,
                     indentation_wedge, glenohumeral, glenohumeral_hexahedra,
                     glenohumeral_finite, glenohumeral_ligaments,
                     meniscus_ring):
            case(run)
    shipped = [case for case in sorted(CASES.glob("*.toml"))
               if not case.name.endswith(".frames.toml")]
    for case in shipped:
        check("penalty" not in case.read_text(), f"{case.name}: no penalty")
    # test_knee.py runs the one and checks the other, test_knee_body_weight.py
    # and test_knee_stance.py run the others.
    check(run_cases | {"knee", "knee_finite", "knee_body_weight", "knee_stance"}
          == {case.stem for case in shipped} | {"case"},
          "all cases were run")
    finish()


if __name__ == "__main__":
    main()
