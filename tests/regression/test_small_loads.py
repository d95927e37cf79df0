#!/usr/bin/env python3
# processors: 1
"""Shipped cases in finite deformation with loads times 1e-4.

Requirements: forces, pressures, strains and fluid are those of infinitesimal
deformation to 1e-4, also with contact of flat and of round surfaces; lines and
fields of finite deformation have volume ratio, porosity and logarithmic
strains, and those of infinitesimal deformation don't; a run of finite
deformation is not warned of strains beyond linear theory.
"""

from __future__ import annotations

import csv
import pathlib
import sys
import tempfile
import tomllib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.dont_write_bytecode = True

from program_checks import (  # noqa: E402
    PROGRAMS, SOURCE, check, finish, history, make_mesh, run_program)

CASES = ("confined_compression", "unconfined_compression")
# With contact: what makes a coarse mesh and a few steps, and the columns to
# compare. Forces across the axis and fluid that has long drained are round-off
# of the others.
CONTACT = {
    "two_columns": (
        ("boxes.py", "two_columns", "--size", "2"),
        ("time.step=125", "time.end=500", 'time.scheme="backward_euler"'),
        ("reaction.upper_top.z", "contact.columns.force_z",
         "contact.columns.area", "contact.columns.peak_traction",
         "contact.columns.peak_pressure", "contact.columns.fluid_exchange",
         "fluid.growth", "fluid.peak_pressure", "strain.max_principal")),
    "indentation_finite": (
        ("indentation.py", "--size", "3"),
        ("time.step=250", "time.end=500"),
        ("reaction.bone.x", "reaction.bone.z",
         "contact.indenter-cartilage.force_z",
         "contact.indenter-cartilage.area",
         "contact.indenter-cartilage.peak_traction",
         "contact.indenter-cartilage.fluid_exchange", "fluid.growth",
         "fluid.peak_pressure", "strain.max_principal")),
    "hertz": (
        ("hertz.py", "--size", "1.5"), ("time.step=2e5",),
        ("reaction.lower_bottom.x", "reaction.lower_bottom.z",
         "travel.upper_top", "contact.bodies.force_z", "contact.bodies.area",
         "contact.bodies.peak_traction", "fluid.growth",
         "strain.max_principal"))}
STEPS = ("time.step=62.5", "time.end=500", "output.fields_every=8")
SMALL = 1e-4
# What contact may leave, far below what the loads do.
CONTACT_TOLERANCES = {"gap_tolerance": 1e-11, "pressure_tolerance": 1e-6}
TOLERANCE = 1e-4
FINITE_FIELDS = ("principal_strain", "volume_ratio", "porosity",
                 "largest_stress_direction", "smallest_stress_direction")


def inline(value: object) -> str:
    """A value as TOML has it."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {inline(item)}"
                               for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(inline(item) for item in value) + "]"
    if isinstance(value, str):
        return f'"{value}"'
    return repr(value)


def scaled(load: object, factor: float) -> object:
    """A number, a curve, or a list of them, times a factor."""
    if isinstance(load, list):
        return [scaled(item, factor) for item in load]
    if isinstance(load, dict):
        return {"times": load["times"],
                "values": [factor * value for value in load["values"]]}
    return load if isinstance(load, str) else factor * load


def laws(material: dict, finite: bool) -> dict[str, dict]:
    """The material's laws, or their counterparts in the other deformation."""
    solid, permeability = material["solid"], material["permeability"]
    if finite == (solid["model"] == "neo_hookean"):
        return {}
    check(solid["model"] in ("isotropic", "neo_hookean")
          and permeability["model"] == "constant", "the laws have counterparts")
    return {"solid": {**solid,
                      "model": "neo_hookean" if finite else "isotropic"}}


def overrides(case: dict, factor: float, finite: bool) -> list[str]:
    """What makes a case one of scaled loads, and of this deformation."""
    deformation = "finite" if finite else "infinitesimal"
    changes = [f'physics.deformation="{deformation}"']
    for i, boundary in enumerate(case["boundary"]):
        for key in ("displacement", "pressure", "traction", "normal_traction",
                    "normal_flux"):
            if key in boundary:
                changes.append(f"boundary.{i}.{key}="
                               + inline(scaled(boundary[key], factor)))
        if "force" in boundary:
            curve = scaled(boundary["force"]["curve"], factor)
            changes.append(f"boundary.{i}.force.curve={inline(curve)}")
    for i, material in enumerate(case["material"]):
        changes += [f"material.{i}.{key}={inline(law)}"
                    for key, law in laws(material, finite).items()]
    changes += [f"contact.{i}.{key}={value}"
                for i in range(len(case.get("contact", [])))
                for key, value in CONTACT_TOLERANCES.items()]
    return changes


class Run:
    def __init__(self, directory: pathlib.Path, name: str, factor: float,
                 finite: bool, steps: tuple[str, ...] = STEPS) -> None:
        path = SOURCE / "miniapps" / "cases" / f"{name}.toml"
        case = tomllib.loads(path.read_text())
        self.finite = finite
        self.output = directory / f"{name}-{factor}-{finite}"
        settings = [f'mesh.file="{directory / (name + ".msh")}"', *steps]
        command = [PROGRAMS / "synovia", path, "--output", self.output]
        for setting in settings + overrides(case, factor, finite):
            command += ["--set", setting]
        self.printed = run_program(
            *command, text=f"{name}, loads times {factor:g}, "
            + ("finite" if finite else "infinitesimal"))
        self.rows = history(self.output)

    def line(self) -> list[dict[str, float]]:
        """The last line of the run."""
        files = sorted((self.output / "lines").glob("*_t500.csv"))
        with open(files[0]) as file:
            return [{name: float(value) for name, value in row.items()}
                    for row in csv.DictReader(file)]

    def field_names(self) -> str:
        files = sorted((self.output / "fields").rglob("*.pvtu"))
        return files[-1].read_text()


def difference(some: list[dict[str, float]], others: list[dict[str, float]],
               column: str, offset: float = 0.0) -> float:
    """The largest difference in a column, as a part of its largest value."""
    largest = max(abs(row[column] - offset) for row in others)
    return max(abs(a[column] - b[column])
               for a, b in zip(some, others)) / largest


def check_small(directory: pathlib.Path, name: str) -> None:
    linear = Run(directory, name, SMALL, False)
    finite = Run(directory, name, SMALL, True)
    check(len(linear.rows) == len(finite.rows) >= 8,
          f"both take {len(linear.rows)} steps")
    columns = [(column, 0.0) for column in linear.rows[0]
               if column in ("reaction.top.z", "reaction.bottom.z",
                             "fluid.growth", "fluid.outflow",
                             "fluid.peak_pressure", "strain.max_principal")]
    check(len(columns) == 6, "the history has the columns to compare")
    for column, offset in columns + [("strain.min_det_F", 1.0)]:
        error = difference(finite.rows, linear.rows, column, offset)
        check(error < TOLERANCE, f"{column} differs by {error:.1e}")
    for column in ("p", "uz", "szz", "eszz"):
        error = difference(finite.line(), linear.line(), column)
        check(error < TOLERANCE, f"{column} along the line by {error:.1e}")
    worst = 0.0
    for row in finite.line():
        strains = row["strain1"] + row["strain2"] + row["strain3"]
        worst = max(worst, abs(row["J"] - 1 - strains),
                    abs(row["porosity"] - 0.8 - 0.2 * strains))
    check(worst < 1e-9, f"J and porosity follow the strains to {worst:.1e}")
    check("J" not in linear.line()[0], "infinitesimal lines have no J")
    names = finite.field_names()
    check(all(f'"{field}"' in names for field in FINITE_FIELDS),
          "fields of finite deformation")
    check("porosity" not in linear.field_names(), "infinitesimal ones have none")


def check_contact(directory: pathlib.Path, name: str, steps: tuple[str, ...],
                  columns: tuple[str, ...]) -> None:
    steps += ("output.fields_every=0", "output.line=[]")
    linear = Run(directory, name, SMALL, False, steps)
    finite = Run(directory, name, SMALL, True, steps)
    check(len(linear.rows) == len(finite.rows) >= 2,
          f"both take {len(linear.rows)} steps")
    for column in columns:
        error = difference(finite.rows, linear.rows, column)
        check(error < TOLERANCE, f"{column} differs by {error:.1e}")


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        directory = pathlib.Path(folder)
        for name in CASES:
            make_mesh("boxes.py", directory / f"{name}.msh", name)
            check_small(directory, name)
        for name, (mesh, steps, columns) in CONTACT.items():
            make_mesh(mesh[0], directory / f"{name}.msh", *mesh[1:])
            check_contact(directory, name, steps, columns)
        large = Run(directory, "confined_compression", 2.0, True)
        check("linear theory" not in large.printed and
              "largest logarithmic strain -" in large.printed,
              "20 % of finite strain are no reason to warn")
    finish()


if __name__ == "__main__":
    main()
