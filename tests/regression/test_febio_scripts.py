#!/usr/bin/env python3
# processors: 1
"""scripts/febio_suite.py and scripts/febio_friction.py.

Requirements: a model is compared with a result that is its own, and with one
that differs by a percent; one that is refused is listed with the reason. With a
result in other steps than its own it is compared in those, its load along a
curve the same at their ends. The forces on a cube that is sheared under
pressure are those of its closed form, from a table with commas as from a log.
"""

from __future__ import annotations

import csv
import json
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "support"),
                str(HERE.parents[1] / "scripts" / "lib")]
sys.dont_write_bytecode = True

from feb_column import FebColumn  # noqa: E402
from log_blocks import Block, read_blocks  # noqa: E402
from program_checks import PROGRAMS, SOURCE, check, finish  # noqa: E402

SCRIPTS = SOURCE / "scripts"
TRACTION = """<Loads>
<surface_load name="press" surface="top" type="normal_traction">
<traction>-0.01</traction></surface_load>
</Loads>"""
CURVED = TRACTION.replace("<traction>", '<traction lc="1">')
CURVE = """<interpolate>SMOOTH</interpolate><points><pt>0,0</pt><pt>1,0.2</pt>
<pt>2,1</pt><pt>3,0.4</pt><pt>6,0.3</pt></points>"""


def output_of(script: str, *arguments: str | pathlib.Path) -> str:
    run = subprocess.run([sys.executable, SCRIPTS / script, *arguments],
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                         text=True)
    check(run.returncode == 0, f"{script} succeeds: {run.stdout[-300:]}")
    return run.stdout


def write_reference(folder: pathlib.Path, blocks: list[Block],
                    factor: float) -> None:
    """As if another program had found the result, times a factor."""
    folder.mkdir(parents=True)
    (folder / "summary.json").write_text(
        json.dumps({"steps": 5, "iters": 17, "total_s": "1.25"}))
    with (folder / "history.csv").open("w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(["time", "p_max", "support:sum_Rz"])
        for block in blocks:
            rows.writerow([
                block.time,
                factor * max(row["p"] for row in block.rows.values()),
                factor * sum(block.rows[node]["Rz"] for node in range(1, 5))])
    with (folder / "final_nodes.csv").open("w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(["node", "ux", "uy", "uz"])
        for node, row in blocks[-1].rows.items():
            rows.writerow([node, *(factor * row[f"u{axis}"]
                                   for axis in "xyz")])


def suite(directory: pathlib.Path) -> None:
    models = directory / "models"
    models.mkdir()
    (models / "column.feb").write_text(
        FebColumn(layers=3, steps=5, sections=TRACTION).text())
    (models / "growing.feb").write_text(FebColumn(
        sections="<MeshAdaptor><mesh_adaptor/></MeshAdaptor>").text())
    common = (models, "--program", PROGRAMS / "synovia", "--output",
              directory / "out")
    table = output_of("febio_suite.py", *common)
    check(re.search(r"\| column \| 5, \d+, [\d.]+ s \|  \|", table) is not None,
          "steps, iterations and time of a model are in the table")
    check("MeshAdaptor: this is not known" in table, "and why one is refused")
    blocks = read_blocks(directory / "out" / "column" / "logs"
                         / "log_nodes.txt")
    for name, factor in ("same", 1.0), ("other", 1.0 / 1.01):
        write_reference(directory / name / "column", blocks, factor)
        table = output_of("febio_suite.py", *common, "column", "--reference",
                          directory / name)
        check("| 5, 17, 1.2 s |" in table, "the other's work is in the table")
        found = dict(re.findall(r"(\w+) ([\d.e+-]+) %", table))
        check(set(found) == {"pressure", "reactions", "nodes"},
              "differences of all are in the table")
        expected = 100 * (1.0 / factor - 1.0)
        check(all(abs(float(value) - expected) < 1e-6
                  for value in found.values()),
              f"they are {expected:.3g} %: {found}")


def other_steps(directory: pathlib.Path) -> None:
    """A result in 7 steps, compared with a model that has 5 of its own."""
    def write(folder: str, steps: int) -> pathlib.Path:
        models = directory / folder
        models.mkdir()
        (models / "curved.feb").write_text(FebColumn(
            layers=3, steps=steps, step=5.6 / steps, sections=CURVED,
            curves=[CURVE]).text())
        return models

    common = ("--program", PROGRAMS / "synovia", "--output",
              directory / "curved")
    output_of("febio_suite.py", write("seven", 7), *common)
    blocks = read_blocks(directory / "curved" / "curved" / "logs"
                         / "log_nodes.txt")
    check(len(blocks) == 7, "a result has 7 steps")
    write_reference(directory / "of_seven" / "curved", blocks, 1.0)
    table = output_of("febio_suite.py", write("five", 5), *common,
                      "--reference", directory / "of_seven")
    check("| curved | 7, " in table, "these are taken by the other model")
    found = dict(re.findall(r"(\w+) ([\d.e+-]+) %", table))
    check(set(found) == {"pressure", "reactions", "nodes"} and
          all(float(value) < 1e-6 for value in found.values()),
          f"its result is the same: {found}")


def friction(directory: pathlib.Path) -> None:
    """A cube, sheared by g and shortened to l: with E = 1 and nu = 0 its top
    bears g/2 across and (1/l - l)/2 along the normal. Under a pressure p alone
    the law allows its solid share of it."""
    shear, stretch, pressure, fraction = 0.2, 0.7, 0.6, 0.4
    text = FebColumn(layers=1).text()
    text = text.replace("</Mesh>", '<Surface name="plate"><quad4 id="1">'
                        "1,2,3,4</quad4></Surface><SurfacePair name=\"pair\">"
                        "<primary>top</primary><secondary>none</secondary>"
                        "</SurfacePair></Mesh>")
    text = text.replace("<LoadData>", '<Contact><contact surface_pair="pair" '
                        'type="sliding-biphasic"><fric_coeff>0.2</fric_coeff>'
                        f"<contact_frac>{fraction}</contact_frac></contact>"
                        "</Contact><LoadData>")
    # The contact is across y.
    nodes = {}

    def turned(match: re.Match[str]) -> str:
        x, y, z = map(float, match[2].split(","))
        nodes[int(match[1])] = z
        return f'<node id="{match[1]}">{y},{z},{x}</node>'

    text = re.sub(r'<node id="(\d+)">([^<]*)</node>', turned, text)
    model = directory / "cube.feb"
    model.write_text(text)
    def values(*of: float) -> list[list[float]]:
        g, shorter, p = of
        return [[node, g * y, (shorter - 1.0) * y, 0.0, p]
                for node, y in nodes.items()]

    def found(file: pathlib.Path) -> list[float]:
        said = output_of("febio_friction.py", model, file)
        match = re.search(
            r"normal forces ([\d.]+), across ([\d.]+): ([\d.]+) of them; the "
            r"law allows ([\d.]+)", said)
        check(match is not None, f"forces are said: {said}")
        return [float(word) for word in match.groups()]

    table = directory / "nodes.csv"
    log = directory / "log.txt"
    rows = values(shear, stretch, 0.0)
    table.write_text("node,ux,uy,uz,p\n" + "".join(
        ",".join(map(str, row)) + "\n" for row in rows))
    log.write_text("*Step  = 1\n*Time  = 1\n*Data  = ux;uy;uz;p\n" + "".join(
        " ".join(map(str, row)) + "\n" for row in rows))
    pressing = 0.5 * (1.0 / stretch - stretch)
    for file in table, log:
        along, across, part, allowed = found(file)
        check(abs(along - pressing) < 1e-4 and
              abs(across - 0.5 * shear) < 1e-4, f"{along}, {across} are exact")
        check(abs(part - 0.5 * shear / pressing) < 1e-4 and allowed == 0.2,
              "and so is what they are of each other")
    table.write_text("node,ux,uy,uz,p\n" + "".join(
        ",".join(map(str, row)) + "\n"
        for row in values(0.0, 1.0, pressure)))
    along, _, _, allowed = found(table)
    check(abs(along - pressure) < 1e-4 and
          abs(allowed - 0.2 * fraction) < 1e-4,
          f"the law allows {allowed} where the fluid bears all")


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        directory = pathlib.Path(name)
        suite(directory)
        other_steps(directory)
        friction(directory)
    finish()


if __name__ == "__main__":
    main()
