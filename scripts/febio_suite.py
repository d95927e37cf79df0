#!/usr/bin/env python3
"""Runs models of FEBio's TestSuite and compares them with FEBio's results.

FOLDER has the models, NAME.feb. The folder of --reference has one for each
model that FEBio has run, NAME or NAME_VARIANT: summary.json (steps, iters,
total_s), history.csv (time, largest pressure p_max, and of each condition of
the displacement CONDITION:sum_Rx and so on), final_nodes.csv (node, ux, uy, uz)
and, of rigid bodies, rigid.csv (time, rigid_body_id, x, y, z). A model is run
in the steps that FEBio took, one whose variant begins with nofric without
friction; others are run as they are. The rows of the table are steps and
iterations of Newton's method, seconds, and of each quantity its largest
difference over the history, in parts of its largest value; of nodes that at the
end, in parts of the largest displacement.
"""

from __future__ import annotations

import argparse
import csv
import json
import pathlib
import re
import resource
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterable
from dataclasses import dataclass, field

SCRIPTS = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(SCRIPTS / "lib"))

from feb_sets import displacement_nodes  # noqa: E402
from log_blocks import Block, read_blocks  # noqa: E402

NODES = "nodes:ux;uy;uz;p;Rx;Ry;Rz"
BODIES = "rigid_bodies:x;y;z"
# Times that differ by this part are the same.
SAME_TIME = 1e-6
# The number of a load controller that no model has.
MUST_POINTS = "1000"
# Of the largest of all forces: below it a sum is round-off.
ROUND_OFF = 1e-6

Rows = list[dict[str, str]]


@dataclass
class Outcome:
    """Of one model, in one variant."""

    name: str
    steps: str = ""
    iterations: str = ""
    seconds: str = ""
    differences: dict[str, float] = field(default_factory=dict)
    refusal: str = ""

    def row(self, febio: dict[str, str]) -> str:
        if self.refusal:
            return f"| {self.name} | {self.refusal} | | | |"
        theirs = ", ".join(febio.get(key, "") for key in
                           ("steps", "iterations", "seconds")).strip(", ")
        parts = ", ".join(f"{what} {100 * value:.2g} %" for what, value
                          in self.differences.items())
        return (f"| {self.name} | {self.steps}, {self.iterations}, "
                f"{self.seconds} | {theirs} | {parts} |")


def read_csv(path: pathlib.Path) -> Rows:
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def processor_seconds() -> float:
    """Of the runs so far."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run(program: pathlib.Path, model: pathlib.Path, output: pathlib.Path,
        logs: list[str], extra: list[str]) -> Outcome:
    outcome = Outcome(output.name)
    command = [program, model, "--output", output, "--overwrite",
               "--set", "output.fields_every=0",
               "--set", "output.checkpoint_every=0", *extra]
    for log in logs:
        command += ["--log", log]
    output.parent.mkdir(parents=True, exist_ok=True)
    before = processor_seconds()
    with (output.parent / f"{output.name}.log").open("w+") as log_file:
        result = subprocess.run(command, stdout=log_file,
                                stderr=subprocess.STDOUT)
        taken = processor_seconds() - before
        log_file.seek(0)
        said = log_file.read()
    history = output / "history.csv"
    rows = read_csv(history) if history.is_file() else []
    outcome.steps = str(len(rows))
    outcome.iterations = str(sum(int(float(row["solver.newton"]))
                                 for row in rows))
    outcome.seconds = f"{taken:.1f} s"
    if result.returncode:
        refused = re.search(r"not supported.*?\n((?:  line.*\n)+)", said)
        reasons = (refused.group(1) if refused else said[-300:]).split("\n")
        outcome.refusal = " ".join(" ".join(reasons).split())
        if rows:
            outcome.refusal = f"ends at t = {rows[-1]['t']}: {outcome.refusal}"
    return outcome


def sums(block: Block, nodes: set[int], axis: str) -> float:
    return sum(row[axis] for number, row in block.rows.items()
               if number in nodes)


def largest_difference(pairs: Iterable[tuple[float, float]],
                       floor: float = 0.0) -> float | None:
    """In parts of the largest second value; none if that is round-off."""
    both = list(pairs)
    scale = max((abs(theirs) for _, theirs in both), default=0.0)
    if scale <= floor:
        return None
    return max(abs(ours - theirs) for ours, theirs in both) / scale


def compare(model: pathlib.Path, output: pathlib.Path,
            reference: pathlib.Path) -> dict[str, float]:
    blocks = read_blocks(output / "logs" / "log_nodes.txt")
    theirs = read_csv(reference / "history.csv")
    found: dict[str, float | None] = {}

    def at(t: float, entries: list[Block]) -> Block | None:
        return next((entry for entry in entries if abs(entry.time - t)
                     <= SAME_TIME * max(abs(t), 1e-12)), None)

    pairs = [(block, row) for row in theirs
             if (block := at(float(row["time"]), blocks))]
    found["pressure"] = largest_difference(
        (max(row["p"] for row in block.rows.values()), float(row["p_max"]))
        for block, row in pairs)
    conditions = displacement_nodes(model)
    forces = [key for key in theirs[0] if ":sum_R" in key]
    largest = max(abs(float(row[key])) for row in theirs for key in forces)
    reactions = []
    for key in forces:
        name, _, axis = key.partition(":sum_")
        nodes = conditions[name.rstrip("*")]
        difference = largest_difference(
            ((sums(block, nodes, axis), float(row[key]))
             for block, row in pairs), ROUND_OFF * largest)
        if difference is not None:
            reactions.append(difference)
    found["reactions"] = max(reactions, default=None)
    if (reference / "rigid.csv").is_file():
        bodies = read_blocks(output / "logs" / "log_rigid_bodies.txt")
        rigid = read_csv(reference / "rigid.csv")
        moved = [(block, row) for row in rigid
                 if (block := at(float(row["time"]), bodies))]
        first = rigid[0]
        for axis in "xyz":
            scale = max(abs(float(row[axis]) - float(first[axis]))
                        for row in rigid)
            travel = largest_difference(
                ((block.rows[1][axis] - float(first[axis]),
                  float(row[axis]) - float(first[axis]))
                 for block, row in moved), ROUND_OFF)
            if scale > ROUND_OFF and travel and travel > 1e-9:
                found[f"rigid {axis}"] = travel
    last = blocks[-1].rows
    end = {int(row["node"]): row
           for row in read_csv(reference / "final_nodes.csv")}
    found["nodes"] = largest_difference(
        (row[axis], float(end[number][axis]))
        for number, row in last.items() if number in end
        for axis in ("ux", "uy", "uz"))
    return {what: value for what, value in found.items() if value is not None}


def take_steps(root: ElementTree.Element, ends: list[float]) -> None:
    """Makes them must points, so that loads are those of FEBio at each end."""
    control = root.find("Control")
    if control is None:
        sys.exit("febio_suite.py: error: the steps of a reference are those "
                 "of Control, which the model hasn't")
    data = root.find("LoadData")
    if data is None:
        data = ElementTree.SubElement(root, "LoadData")
    curve = ElementTree.SubElement(data, "load_controller", id=MUST_POINTS,
                                   type="loadcurve")
    points = ElementTree.SubElement(curve, "points")
    for end in ends:
        point = ElementTree.SubElement(points, "pt")
        point.text = f"{end},{ends[-1]}"
    for name in "time_steps", "step_size", "time_stepper":
        if (old := control.find(name)) is not None:
            control.remove(old)
    ElementTree.SubElement(control, "time_steps").text = "1"
    ElementTree.SubElement(control, "step_size").text = str(ends[-1])
    stepper = ElementTree.SubElement(control, "time_stepper")
    longest = ElementTree.SubElement(stepper, "dtmax", lc=MUST_POINTS)
    longest.text = "1"


def leave_friction_out(root: ElementTree.Element) -> None:
    for coefficient in root.iter("fric_coeff"):
        coefficient.text = "0"


def variants(model: pathlib.Path,
             reference: pathlib.Path | None) -> list[pathlib.Path | None]:
    if not reference:
        return [None]
    named = re.compile(re.escape(model.stem) + "(_.*)?")
    found = sorted(path for path in reference.iterdir()
                   if path.is_dir() and named.fullmatch(path.name))
    return [*found] or [None]


def parse(argv: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, metavar="FOLDER")
    parser.add_argument("names", nargs="*", metavar="NAME",
                        help="models, without .feb (default: all)")
    parser.add_argument("--reference", type=pathlib.Path, metavar="FOLDER")
    parser.add_argument("--program", type=pathlib.Path, default=SCRIPTS.parent
                        / "build/miniapps/synovia", help="(%(default)s)")
    parser.add_argument("--set", action="append", default=[],
                        metavar="KEY=VALUE", help="of the case; repeatable")
    parser.add_argument("-o", "--output", type=pathlib.Path,
                        default=pathlib.Path("out/febio_suite"),
                        help="folder of the runs (%(default)s)")
    return parser.parse_intermixed_args(argv)


def main(argv: list[str] | None = None) -> int:
    args = parse(argv)
    extra = [word for entry in args.set for word in ("--set", entry)]
    names = args.names or sorted(path.stem for path
                                 in args.folder.glob("*.feb"))
    print("| model | here: steps, iterations, time | FEBio: steps, iterations, "
          "time | largest differences |\n|---|---|---|---|")
    for name in names:
        model = args.folder / f"{name}.feb"
        if not model.is_file():
            print(f"febio_suite.py: error: there is no {model}",
                  file=sys.stderr)
            return 1
        for reference in variants(model, args.reference):
            label = reference.name if reference else name
            feb = model
            febio: dict[str, str] = {}
            if reference:
                tree = ElementTree.parse(model)
                if label.startswith(f"{name}_nofric"):
                    leave_friction_out(tree.getroot())
                take_steps(tree.getroot(),
                           [float(row["time"]) for row
                            in read_csv(reference / "history.csv")
                            if float(row["time"]) > 0.0])
                feb = args.output / "models" / f"{label}.feb"
                feb.parent.mkdir(parents=True, exist_ok=True)
                tree.write(feb, encoding="unicode")
                summary = json.loads((reference / "summary.json").read_text())
                febio = {"steps": str(summary["steps"]),
                         "iterations": str(summary["iters"]),
                         "seconds": f"{float(summary['total_s']):.1f} s"}
            output = args.output / label
            has_bodies = reference and (reference / "rigid.csv").is_file()
            outcome = run(args.program, feb, output,
                          [NODES, BODIES] if has_bodies else [NODES], extra)
            if reference and not outcome.refusal:
                outcome.differences = compare(feb, output, reference)
            print(outcome.row(febio), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
