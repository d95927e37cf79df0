#!/usr/bin/env python3
"""Shipped cases in finite deformation with loads times 1e-4.

Requirements: forces, pressures, strains and fluid are those of infinitesimal
deformation to 1e-4; lines and fields of finite deformation have volume ratio,
porosity and logarithmic strains, and those of infinitesimal deformation don't;
a run of finite deformation is not warned of strains beyond linear theory.
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
SMALL = 1e-4
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


def overrides(case: dict, factor: float, finite: bool) -> list[str]:
    """What makes a case one of scaled loads, and of finite deformation."""
    changes = []
    for i, boundary in enumerate(case["boundary"]):
        for key in ("displacement", "pressure", "traction", "normal_traction",
                    "normal_flux"):
            if key in boundary:
                changes.append(f"boundary.{i}.{key}="
                               + inline(scaled(boundary[key], factor)))
    if finite:
        changes.append('physics.deformation="finite"')
        for i, material in enumerate(case["material"]):
            check(material["solid"]["model"] == "isotropic",
                  "the solid has a counterpart in finite deformation")
            solid = {**material["solid"], "model": "neo_hookean"}
            changes.append(f"material.{i}.solid={inline(solid)}")
    return changes


class Run:
    def __init__(self, directory: pathlib.Path, name: str, factor: float,
                 finite: bool) -> None:
        path = SOURCE / "miniapps" / "cases" / f"{name}.toml"
        case = tomllib.loads(path.read_text())
        self.finite = finite
        self.output = directory / f"{name}-{factor}-{finite}"
        settings = ["time.step=62.5", "time.end=500", "output.fields_every=8",
                    f'mesh.file="{directory / (name + ".msh")}"']
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


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        directory = pathlib.Path(folder)
        for name in CASES:
            make_mesh("boxes.py", directory / f"{name}.msh", name)
            check_small(directory, name)
        large = Run(directory, "confined_compression", 2.0, True)
        check("linear theory" not in large.printed and
              "largest logarithmic strain -" in large.printed,
              "20 % of finite strain are no reason to warn")
    finish()


if __name__ == "__main__":
    main()
