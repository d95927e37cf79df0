#!/usr/bin/env python3
# processors: 1
"""Shipped cases in finite deformation with loads times 1e-4 or less.

Requirements: forces, pressures, strains and fluid are those of infinitesimal
deformation to 1e-4, also with contact of flat and of round surfaces, and with
ties, springs and steps; with curved layers that touch all over, but for a part
that falls with the square of the mesh's size; so are those of other laws that
have the same moduli at small strain; lines and fields of finite deformation have volume
ratio, porosity and logarithmic strains, and those of infinitesimal deformation
don't; a run of finite deformation is not warned of strains beyond linear
theory.

Isotropic solids have counterparts in both deformations, and permeabilities of
finite deformation are constant at small strain. What has no counterpart:

  friction (friction_plate, migrating_contact, resting_contact): there is none
  in infinitesimal deformation; friction_plate is run without

  fibers that are slack in compression (migrating_contact, resting_contact,
  knee_finite, knee_body_weight, knee_stance): bilinear at any load, which no
  law of infinitesimal deformation is

  the law of menisci, which are stiff along fibers in tension and in compression
  (meniscus_ring, knee): no law of finite deformation is; and with 1e-4 of the
  travel nothing holds them, as gaps are larger

  ligaments (glenohumeral_ligaments): their prestrain and their toe don't become
  smaller with the loads

glenohumeral and indentation are left out, as glenohumeral_finite and
indentation_finite are run with their laws.
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

SMALL = 1e-4
# Cases without contact: what makes their meshes, and the factor on loads. The
# permeability of those that are compressed by 20 and 30 % changes by 1e-4 with
# the usual one.
CASES = {
    "confined_compression": ("confined_compression", SMALL),
    "confined_compression_finite": ("confined_compression", 0.1 * SMALL),
    "unconfined_compression": ("unconfined_compression", SMALL),
    "unconfined_compression_finite": ("unconfined_compression", 0.1 * SMALL)}
# With contact, ties, springs or steps: what makes a coarse mesh and a few
# steps, and the columns to compare. Forces across the axis and fluid that has
# long drained are round-off of the others.
CONTACT = {
    "two_columns": (
        ("boxes.py", "two_columns", "--size", "2"),
        ("time.step=125", "time.end=500", 'time.scheme="backward_euler"'),
        ("reaction.upper_top.z", "contact.columns.force_z",
         "contact.columns.area", "contact.columns.peak_traction",
         "contact.columns.peak_pressure", "contact.columns.fluid_exchange",
         "fluid.growth", "fluid.peak_pressure", "strain.max_principal")),
    "osteochondral_core": (
        ("boxes.py", "osteochondral_core", "--size", "2"),
        ("time.step=125", "time.end=500"),
        ("reaction.cartilage_top.z", "tie.tidemark.force_z",
         "tie.tidemark.fluid_exchange", "fluid.growth", "fluid.outflow",
         "fluid.peak_pressure", "strain.max_principal")),
    "relaxation_and_recovery": (
        ("boxes.py", "confined_compression", "--size", "2"),
        ("time.step=125", "step.hold.step=1000", "step.recover.step=100"),
        ("reaction.bottom.z", "fluid.growth", "fluid.outflow",
         "fluid.peak_pressure", "strain.max_principal")),
    "indentation_finite": (
        ("indentation.py", "--size", "3"),
        ("time.step=250", "time.end=500"),
        ("reaction.bone.x", "reaction.bone.z",
         "contact.indenter-cartilage.force_z",
         "contact.indenter-cartilage.area",
         "contact.indenter-cartilage.peak_traction",
         "contact.indenter-cartilage.fluid_exchange", "fluid.growth",
         "fluid.peak_pressure", "strain.max_principal")),
    "indentation_hexahedra": (
        ("indentation.py", "--hex", "--size", "3", "--rim", "0.02"),
        ("time.step=250", "time.end=500"),
        ("reaction.bone.x", "reaction.bone.z",
         "contact.indenter-cartilage.force_z",
         "contact.indenter-cartilage.area",
         "contact.indenter-cartilage.peak_traction",
         "contact.indenter-cartilage.fluid_exchange", "fluid.growth",
         "fluid.peak_pressure", "strain.max_principal")),
    "indentation_wedge": (
        ("indentation_wedge.py", "--size", "3"),
        ("time.step=125", "time.end=500"),
        ("reaction.bone.z", "reaction.punch.z", "reaction.symmetry_y.y",
         "spring.symmetry_turned.y", "fluid.growth", "fluid.outflow",
         "fluid.peak_pressure", "strain.max_principal")),
    "hertz": (
        ("hertz.py", "--size", "1.5"), ("time.step=2e5",),
        ("reaction.lower_bottom.x", "reaction.lower_bottom.z",
         "travel.upper_top", "contact.bodies.force_z", "contact.bodies.area",
         "contact.bodies.peak_traction", "fluid.growth",
         "strain.max_principal")),
    "friction_plate": (
        ("boxes.py", "column_on_plate", "--size", "2"),
        ("contact.plate.friction={}", "time.adaptive=false", "time.step=0.5",
         "time.stops=[]", "time.end=2"),
        ("reaction.plate_bottom.z", "contact.plate.force_z",
         "contact.plate.area", "contact.plate.peak_traction",
         "contact.plate.peak_pressure", "fluid.growth", "fluid.outflow",
         "fluid.peak_pressure", "strain.max_principal"))}
# Joints, by the options and sizes of their meshes. Both layers have the same
# radius, and overlap by less than their meshes are off, so that they touch
# everywhere: with the shipped ones the travel is far less than gaps around a
# vertex are. At any load, the theories differ then by a part that is of the
# square of the sizes.
JOINTS = {"glenohumeral_finite": ((), (3.0,)),
          "glenohumeral_hexahedra": (("--hex",), (2.0, 1.0))}
CONFORMING = ("--glenoid-radius", "23.5", "--gap", "-0.001")
JOINT_STEPS = ("time.step=5", "time.end=20",
               'contact.joint.initial_overlap="remove"',
               "output.fields_every=0", "output.line=[]")
JOINT_COLUMNS = (
    "reaction.glenoid_bone.x", "reaction.glenoid_bone.z",
    "reaction.humeral_bone.z", "contact.joint.force_z", "contact.joint.area",
    "contact.joint.peak_traction", "contact.joint.peak_pressure",
    "contact.joint.fluid_exchange", "fluid.growth", "fluid.peak_pressure",
    "strain.max_principal")
OF_MESH = 2e-3
# Laws of finite deformation with moduli of unconfined_compression.toml.
MODULI = "E = 0.5417, nu = 0.0833"
LAWS = (
    f'solid={{model = "holmes_mow", {MODULI}, beta = 0.5}}',
    f'solid={{model = "saint_venant_kirchhoff", {MODULI}}}',
    'permeability={model = "holmes_mow", value = 4e-3, M = 2.2, alpha = 2}',
    'permeability={model = "exponential", value = 4e-3, M = 2.2}',
    'permeability={model = "referential_isotropic", k0 = 1e-3, k1 = 2e-3, '
    'k2 = 1e-3, M = 2.2, alpha = 2}')
STEPS = ("time.step=62.5", "time.end=500", "output.fields_every=8")
# What contact and ties may leave, far below what the loads do.
TOLERANCES = {
    "contact": {"gap_tolerance": 1e-11, "pressure_tolerance": 1e-6},
    "tie": {"displacement_tolerance": 1e-11, "pressure_tolerance": 1e-6}}
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
    model = solid.get("model", "isotropic")
    check(model in ("isotropic", "neo_hookean", "holmes_mow")
          and permeability["model"] in ("constant", "holmes_mow"),
          "the laws have counterparts")
    if finite:
        return {} if model != "isotropic" else {
            "solid": {"model": "neo_hookean", "E": solid["E"],
                      "nu": solid["nu"]}}
    return {"solid": {"model": "isotropic", "E": solid["E"],
                      "nu": solid["nu"]},
            "permeability": {"model": "constant",
                             "value": permeability["value"]}}


def boundaries(case: dict) -> list[tuple[str, dict]]:
    """All of them, also those of steps, and their paths."""
    tables = [("", case)] + [(f"step.{i}.", step)
                             for i, step in enumerate(case.get("step", []))]
    return [(f"{path}boundary.{i}", boundary) for path, table in tables
            for i, boundary in enumerate(table.get("boundary", []))]


def overrides(case: dict, factor: float, finite: bool) -> list[str]:
    """What makes a case one of scaled loads, and of this deformation."""
    deformation = "finite" if finite else "infinitesimal"
    changes = [f'physics.deformation="{deformation}"']
    for path, boundary in boundaries(case):
        for key in ("displacement", "pressure", "traction", "normal_traction",
                    "normal_flux"):
            if key in boundary:
                changes.append(f"{path}.{key}="
                               + inline(scaled(boundary[key], factor)))
        if "force" in boundary:
            curve = scaled(boundary["force"]["curve"], factor)
            changes.append(f"{path}.force.curve={inline(curve)}")
    for i, material in enumerate(case["material"]):
        changes += [f"material.{i}.{key}={inline(law)}"
                    for key, law in laws(material, finite).items()]
    changes += [f"{kind}.{i}.{key}={value}"
                for kind, tolerances in TOLERANCES.items()
                for i in range(len(case.get(kind, [])))
                for key, value in tolerances.items()]
    return changes


class Run:
    def __init__(self, directory: pathlib.Path, name: str, factor: float,
                 finite: bool, steps: tuple[str, ...] = STEPS) -> None:
        path = SOURCE / "miniapps" / "cases" / f"{name}.toml"
        case = tomllib.loads(path.read_text())
        self.finite = finite
        self.output = directory / f"{name}-{factor}-{finite}"
        settings = [f'mesh.file="{directory / (name + ".msh")}"', *steps]
        command = [PROGRAMS / "synovia", path, "--output", self.output,
                   "--overwrite"]
        for setting in overrides(case, factor, finite) + settings:
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


def check_small(directory: pathlib.Path, name: str, factor: float) -> None:
    linear = Run(directory, name, factor, False)
    finite = Run(directory, name, factor, True)
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


def check_joint(directory: pathlib.Path, name: str, options: tuple[str, ...],
                sizes: tuple[float, ...]) -> None:
    found = []
    for size in sizes:
        make_mesh("glenohumeral.py", directory / f"{name}.msh", *options,
                  *CONFORMING, "--size", str(size))
        linear = Run(directory, name, SMALL, False, JOINT_STEPS)
        finite = Run(directory, name, SMALL, True, JOINT_STEPS)
        check(len(linear.rows) == len(finite.rows) == 4, "both take 4 steps")
        found.append([difference(finite.rows, linear.rows, column)
                      for column in JOINT_COLUMNS])
        worst = max(found[-1])
        check(worst < OF_MESH, f"size {size:g}: they differ by {worst:.1e}")
    for size, finer, coarse, fine in zip(sizes, sizes[1:], found, found[1:]):
        for column, much, less in zip(JOINT_COLUMNS, coarse, fine):
            # Four times as much with elements twice as large.
            check(less < max(0.5 * much, TOLERANCE),
                  f"{column}: {much:.1e} with {size:g}, {less:.1e} with "
                  f"{finer:g}")


def check_laws(directory: pathlib.Path) -> None:
    """Other laws of finite deformation, with the mesh that is there."""
    name = "unconfined_compression"
    steps = ("time.step=125", "time.end=500", "output.fields_every=0",
             "output.line=[]")
    linear = Run(directory, name, SMALL, False, steps)
    for law in LAWS:
        finite = Run(directory, name, SMALL, True,
                     steps + (f"material.0.{law}",))
        worst = max(difference(finite.rows, linear.rows, column) for column in
                    ("reaction.top.z", "fluid.growth", "fluid.outflow",
                     "fluid.peak_pressure", "strain.max_principal"))
        check(worst < TOLERANCE,
              f"{law.split(',')[0]}}} differs by {worst:.1e}")


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        directory = pathlib.Path(folder)
        for name, (mesh, factor) in CASES.items():
            make_mesh("boxes.py", directory / f"{name}.msh", mesh)
            check_small(directory, name, factor)
        check_laws(directory)
        for name, (mesh, steps, columns) in CONTACT.items():
            make_mesh(mesh[0], directory / f"{name}.msh", *mesh[1:])
            check_contact(directory, name, steps, columns)
        for name, (options, sizes) in JOINTS.items():
            check_joint(directory, name, options, sizes)
        large = Run(directory, "confined_compression", 2.0, True)
        check("linear theory" not in large.printed and
              "largest logarithmic strain -" in large.printed,
              "20 % of finite strain are no reason to warn")
    finish()


if __name__ == "__main__":
    main()
