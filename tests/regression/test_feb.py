#!/usr/bin/env python3
# processors: 1
"""Models of FEBio from the file to the result.

Requirements: a column under a small load consolidates as Terzaghi's solution
says; fluid that enters where the solid is free of traction presses on it; a
converted model gives the history of the model itself to 1e-10, on one
rank and on two; a model with what is not known is refused before anything runs,
with the whole list; a rigid platen that a load moves gives the displacement of
the same traction; a hinge turns one rigid body about its axis beside another; a
plate presses an elastic block as its closed form says in one step, and stays
where it is in the next.
"""

from __future__ import annotations

import math
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.dont_write_bytecode = True

from feb_column import FebColumn  # noqa: E402
from program_checks import (  # noqa: E402
    MPIEXEC, PROGRAMS, check, finish, history, run_program)

SYNOVIA = PROGRAMS / "synovia"
QUICK = ("--set", "output.fields_every=0", "--set",
         "output.checkpoint_every=0")
LOAD = 1e-4
MODULUS = 1.0
PERMEABILITY = 1e-3
COUNTS = ("solver.seconds",)

TRACTION = """<Loads>
<surface_load name="press" surface="top" type="normal_traction">
<traction>{value}</traction></surface_load>
</Loads>"""
RIGID_MATERIAL = """<material id="2" name="platen" type="rigid body">
<density>1</density><center_of_mass>0.5,0.5,1</center_of_mass></material>"""
RIGID_TIE = """<bc name="tie" node_set="top_nodes" type="rigid">
<rb>platen</rb></bc>"""
RIGID_LOAD = """<Rigid>
<rigid_bc name="guide" type="rigid_fixed"><rb>platen</rb>
<Rx_dof>1</Rx_dof><Ry_dof>1</Ry_dof><Ru_dof>1</Ru_dof><Rv_dof>1</Rv_dof>
<Rw_dof>1</Rw_dof></rigid_bc>
<rigid_load name="press" type="rigid_force"><rb>platen</rb><dof>Rz</dof>
<value lc="1">{value}</value><load_type>LOAD</load_type></rigid_load>
</Rigid>"""
STEP = ("<interpolate>STEP</interpolate><extend>CONSTANT</extend><points>"
        "<pt>0,0</pt><pt>1,1</pt></points>")


def run(model: pathlib.Path, output: pathlib.Path, *before: str):
    run_program(*before, SYNOVIA, model, "--output", output, *QUICK,
                text=" ".join((*before, "synovia", model.name)))
    return history(output)


def settlement(t: float) -> float:
    """Of the top of a column of height 1 under LOAD (Terzaghi)."""
    rate = math.pi ** 2 / 4 * MODULUS * PERMEABILITY * t
    series = sum(math.exp(-n * n * rate) / (n * n)
                 for n in range(1, 200, 2))
    return LOAD / MODULUS * (1 - 8 / math.pi ** 2 * series)


def largest_difference(one, other) -> float:
    """Between two histories, relative to each column's largest value."""
    worst = 0.0
    for name in one[0]:
        if name in COUNTS:
            continue
        scale = max(abs(row[name]) for row in one)
        if scale > 1e-12:
            worst = max(worst, max(abs(a[name] - b[name]) / scale
                                   for a, b in zip(one, other)))
    return worst


def consolidation(directory: pathlib.Path) -> None:
    model = directory / "consolidation.feb"
    column = FebColumn(layers=20, steps=200, step=2.5, curves=[STEP],
                       materials=RIGID_MATERIAL, boundary=RIGID_TIE,
                       sections=RIGID_LOAD.format(value=-LOAD))
    model.write_text(column.text())
    rows = run(model, directory / "platen")
    worst = max(abs(-row["rigid_body.platen.translation_z"]
                    - settlement(row["t"])) / LOAD for row in rows[10:])
    check(len(rows) == 200, "the model's steps are taken")
    check(worst < 0.01, f"settlement is Terzaghi's within {worst:.2%}")
    check(all(abs(row["reaction.bottom.z"] - LOAD) < 1e-9 * LOAD
              for row in rows), "the support bears the platen's load")

    pressed = directory / "traction.feb"
    pressed.write_text(FebColumn(
        layers=20, steps=200, step=2.5,
        sections=TRACTION.format(value=-LOAD)).text())
    other = run(pressed, directory / "traction")
    worst = max(abs(a["fluid.peak_pressure"] - b["fluid.peak_pressure"])
                for a, b in zip(rows, other)) / LOAD
    check(worst < 1e-6, f"traction and platen press alike: {worst:.1e}")


def round_trip(directory: pathlib.Path) -> None:
    model = directory / "trip.feb"
    model.write_text(FebColumn(
        layers=8, steps=20, step=1.0,
        solid='<solid type="Holmes-Mow"><E>0.7</E><v>0.1</v>'
              "<beta>0.35</beta></solid>",
        permeability='<permeability type="perm-Holmes-Mow"><perm>0.00123'
                     "</perm><M>2.2</M><alpha>2</alpha></permeability>"
                     '<solvent_supply type="Starling"><kp>0.0123</kp>'
                     "<pv>0.07</pv></solvent_supply>",
        stepper='<time_stepper type="default"><dtmin>0.01</dtmin>'
                '<dtmax lc="2">0</dtmax></time_stepper>',
        sections='<Loads><surface_load name="press" surface="top" '
                 'type="pressure"><pressure lc="1">0.3</pressure>'
                 "</surface_load></Loads>"
                 '<Output><logfile><node_data data="uz;Rz;p" '
                 'file="nodes.txt"/><element_data data="sz;J" delim=",">2'
                 "</element_data></logfile></Output>",
        curves=["<interpolate>SMOOTH</interpolate><points><pt>0,0</pt>"
                "<pt>4,0.3</pt><pt>9,1</pt><pt>20,0.8</pt></points>",
                "<interpolate>STEP</interpolate><points><pt>0,0</pt>"
                "<pt>5,1</pt><pt>20,3</pt></points>"]).text())
    direct = run(model, directory / "direct")
    run_program(SYNOVIA, "--convert", model, "-o", directory / "case",
                text="synovia --convert trip.feb")
    case = directory / "case" / "trip.toml"
    check(case.is_file() and (directory / "case" / "trip.msh").is_file(),
          "a case and a mesh are written")
    check("# " in case.read_text().splitlines()[0]
          and "approximated" in case.read_text(),
          "the case says what was not taken as it is")
    converted = run(case, directory / "converted")
    worst = largest_difference(direct, converted)
    check(len(direct) == len(converted) and worst < 1e-10,
          f"the converted model gives the same history: {worst:.1e}")
    for name in "nodes.txt", "element_data.txt":
        logs = [(directory / run / "logs" / name).read_text().splitlines()
                for run in ("direct", "converted")]
        check(logs[0] == logs[1] and len(logs[0]) >= 4 * len(direct),
              f"and the same log {name}")
    check(logs[0][3].startswith("2,-"), "columns are delimited as said")
    check(abs(direct[-1]["fluid.growth"] + direct[-1]["fluid.outflow"]
              - direct[-1]["fluid.supply"]) < 1e-8
          and abs(direct[-1]["fluid.supply"]) > 1e-6,
          "what vessels let in is in the balance")
    run_program(SYNOVIA, case, "--output", directory / "logged", *QUICK,
                "--log", "nodes:uz;Rz;p", "--log", "nodes:x",
                text="synovia trip.toml --log nodes:uz;Rz;p --log nodes:x")
    rows = (directory / "logged" / "logs" / "log_nodes.txt").read_text()
    check(rows.splitlines()[:3] == (directory / "direct" / "logs" / "nodes.txt")
          .read_text().splitlines()[:3] and rows.count("*Step") == len(direct)
          and (directory / "logged" / "logs" / "log_nodes_2.txt").is_file(),
          "--log writes the tables that it names")
    wrong = subprocess.run([SYNOVIA, case, "--log", "nodes:sx", "--check"],
                           capture_output=True, text=True)
    check(wrong.returncode == 1 and 'there is no "sx"' in wrong.stderr,
          "what nodes don't have is refused")
    parallel = run(model, directory / "parallel", MPIEXEC, "-n", "2")
    worst = max(abs(a["reaction.bottom.z"] - b["reaction.bottom.z"])
                for a, b in zip(direct, parallel))
    check(worst < 1e-7, f"two ranks give the same reaction: {worst:.1e}")


def permeation(directory: pathlib.Path) -> None:
    """Fluid is pressed in at the top, where the solid is free of traction."""
    for mixture in 0, 1:
        permeation_of(directory, mixture)


def permeation_of(directory: pathlib.Path, mixture: int) -> None:
    flux = LOAD * PERMEABILITY
    name = f"permeation_{mixture}"
    model = directory / f"{name}.feb"
    model.write_text(FebColumn(
        drained="bottom", steps=20, step=2000.0,
        sections='<Loads><surface_load name="in" surface="top" '
                 f'type="fluidflux"><flux>{-flux}</flux>'
                 f"<mixture>{mixture}</mixture></surface_load>"
                 '<surface_load name="free" surface="top" '
                 'type="normal_traction"><traction>0</traction>'
                 "<effective>1</effective></surface_load></Loads>").text())
    last = run(model, directory / name)[-1]
    # The pressure at the top is flux / permeability, and the total traction
    # there its negative, which the support bears.
    check(abs(last["fluid.peak_pressure"] - LOAD) < 1e-3 * LOAD,
          f"pressure {last['fluid.peak_pressure']:.4e} drives the flow")
    check(abs(last["reaction.bottom.z"] - last["fluid.peak_pressure"])
          < 1e-6 * LOAD, "the fluid presses on the solid's surface")


BODY = """<material id="{number}" name="{name}" type="rigid body">
<density>1</density><center_of_mass>0.5,0.5,{z}</center_of_mass></material>"""
TIED = """<bc name="{name}" node_set="{nodes}" type="rigid">
<rb>{name}</rb></bc>"""
HINGE = """<Rigid>
<rigid_bc type="rigid_fixed"><rb>anvil</rb><Rx_dof>1</Rx_dof><Ry_dof>1</Ry_dof>
<Rz_dof>1</Rz_dof><Ru_dof>1</Ru_dof><Rv_dof>1</Rv_dof><Rw_dof>1</Rw_dof>
</rigid_bc>
<rigid_connector name="hinge" type="rigid revolute joint"><body_a>anvil</body_a>
<body_b>platen</body_b><joint_origin>0.5,0.5,0.5</joint_origin>
<rotation_axis>1,0,0</rotation_axis><transverse_axis>0,1,0</transverse_axis>
<prescribed_rotation>1</prescribed_rotation><rotation lc="1">0.2</rotation>
</rigid_connector>
</Rigid>"""
RAMP = ("<interpolate>LINEAR</interpolate><extend>CONSTANT</extend><points>"
        "<pt>0,0</pt><pt>1,1</pt></points>")


def between(text: str, start: str, end: str) -> str:
    begin = text.index(start)
    return text[begin:text.index(end, begin) + len(end)]


def hinge(directory: pathlib.Path) -> None:
    """From one side of the column to the other."""
    column = FebColumn(
        layers=2, steps=2, step=0.5, curves=[RAMP], sections=HINGE,
        materials=BODY.format(number=2, name="platen", z=1)
        + BODY.format(number=3, name="anvil", z=0),
        boundary=TIED.format(name="platen", nodes="top_nodes")
        + TIED.format(name="anvil", nodes="bottom"))
    text = column.text()
    for name in "sides", "support":
        text = text.replace(between(text, f'<bc name="{name}"', "</bc>"), "")
    model = directory / "hinge.feb"
    model.write_text(text)
    output = directory / "hinge"
    run_program(SYNOVIA, model, "--output", output, *QUICK, "--log",
                "rigid_bodies:x;y;z;qx;qy;qz", text="synovia hinge.feb")
    rows = (output / "logs" / "log_rigid_bodies.txt").read_text().splitlines()
    last = next(row for row in reversed(rows) if row.startswith("1 "))
    x, y, z, qx, qy, qz = map(float, last.split()[1:])
    check(abs(qx - math.sin(0.1)) < 1e-8 and abs(qy) + abs(qz) < 1e-8,
          f"the hinge turns its second body about its axis: {qx:.6f}")
    check(abs(x - 0.5) < 1e-8 and abs(y - 0.5 + 0.5 * math.sin(0.2)) < 1e-7
          and abs(z - 0.5 - 0.5 * math.cos(0.2)) < 1e-7,
          "and its origin stays")


PLATE = """<Rigid>
<rigid_bc type="rigid_fixed"><rb>plate</rb><Rx_dof>1</Rx_dof><Ry_dof>1</Ry_dof>
<Ru_dof>1</Ru_dof><Rv_dof>1</Rv_dof><Rw_dof>1</Rw_dof></rigid_bc>
</Rigid>
<Contact><contact name="press" surface_pair="pair" type="sliding-elastic">
<tension>0</tension></contact></Contact>
<Step>
<step id="1" name="press">{times}<Rigid><rigid_load type="rigid_force">
<rb>plate</rb><dof>Rz</dof><value lc="1">-0.1</value></rigid_load></Rigid></step>
<step id="2" name="hold">{times}<Rigid><rigid_bc type="rigid_fixed"><rb>plate</rb>
<Rz_dof>1</Rz_dof></rigid_bc></Rigid></step>
</Step>"""


def elastic_contact(directory: pathlib.Path) -> None:
    """A plate on a block that has no fluid, and can't widen."""
    text = FebColumn(
        layers=2, steps=2, step=0.5, curves=[RAMP],
        materials=BODY.format(number=2, name="plate", z=1)).text()
    times = between(text, "<Control>", "</Control>")
    for old, new in (
            (times, ""),
            (between(text, '<material id="1"', "</material>"),
             '<material id="1" name="tissue" type="neo-Hookean"><E>1</E>'
             "<v>0</v></material>"),
            (between(text, '<bc name="drained"', "/>"), ""),
            ("</Nodes>", '<node id="101">-1,-1,1</node><node id="102">2,-1,1'
             '</node><node id="103">2,2,1</node><node id="104">-1,2,1</node>'
             '</Nodes><Elements type="quad4" name="plate"><elem id="101">'
             "101,102,103,104</elem></Elements>"),
            ("</Mesh>", '<Surface name="below"><quad4 id="1">104,103,102,101'
             '</quad4></Surface><SurfacePair name="pair"><primary>below'
             "</primary><secondary>top</secondary></SurfacePair></Mesh>"),
            ("</MeshDomains>", '<ShellDomain name="plate" mat="plate"/>'
             "</MeshDomains>"),
            ("<LoadData>", PLATE.format(times=times) + "<LoadData>")):
        text = text.replace(old, new, 1)
    model = directory / "elastic.feb"
    model.write_text(text)
    rows = run(model, directory / "elastic")
    # (stretch - 1/stretch)/2 is the nominal stress of E = 1, nu = 0.
    expected = -0.1 + math.sqrt(0.01 + 1.0) - 1.0
    down = [row["rigid_body.plate.translation_z"] for row in rows]
    pressing = next(i for i, row in enumerate(rows) if abs(row["t"] - 1) < 1e-9)
    check(abs(down[pressing] - expected) < 1e-6,
          f"the plate goes down by {-down[pressing]:.6f}")
    check(len(rows) > pressing + 1
          and all(abs(z - expected) < 1e-6 for z in down[pressing:]),
          "and stays there when its load is taken away and it is held")
    check(all(abs(row["reaction.bottom.z"] - 0.1) < 1e-6
              for row in rows[pressing:]), "the support bears as much")


def refusal(directory: pathlib.Path) -> None:
    model = directory / "refused.feb"
    model.write_text(FebColumn(
        solid='<solid type="Fung"/>',
        sections=TRACTION.format(value=-LOAD)
        + '\n<MeshAdaptor><mesh_adaptor type="hex_refine"/></MeshAdaptor>'
    ).text())
    lines = model.read_text().splitlines()
    output = directory / "refused"
    result = subprocess.run([SYNOVIA, model, "--output", output],
                            capture_output=True, text=True)
    check(result.returncode == 1, "what is not known is an error")
    for part, words in (("Fung", "Material/material/solid: \"Fung\" is not "
                         "known"),
                        ("<MeshAdaptor>", "MeshAdaptor: this is not known")):
        number = next(i for i, line in enumerate(lines, 1) if part in line)
        check(f"line {number}: {words}" in result.stderr,
              f"it is named with its line: {words}")
    check(not output.exists(), "nothing is written")


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        consolidation(directory)
        round_trip(directory)
        permeation(directory)
        hinge(directory)
        elastic_contact(directory)
        refusal(directory)
    finish()


if __name__ == "__main__":
    main()
