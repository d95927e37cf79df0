#!/usr/bin/env python3
"""Finds the friction in a result of a model of FEBio, whoever computed it.

MODEL.feb (format 4.0) has one biphasic material of neo-Hookean hex8 elements,
and contact sliding-biphasic of it with fric_coeff. NODES has the displacement
and fluid pressure of its nodes: a file with commas headed by node,ux,uy,uz,p, or
a table in logs/ of a run here, of which the last step counts. Stresses follow
from these, and from stresses what the contact does to each node of its surface:
forces along the mean normal there, and across. Printed are their sums, how far
the nodes inside are from equilibrium, which says how exact the sums are, and
what the law allows across, fric_coeff (|t_n| - (1 - contact_frac) p) per area.
"""

from __future__ import annotations

import argparse
import pathlib
import sys
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass

SCRIPTS = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(SCRIPTS / "lib"))

import missing_module  # noqa: E402, F401

import numpy as np  # noqa: E402

from feb_sets import numbers  # noqa: E402
from log_blocks import read_blocks  # noqa: E402

CORNERS = np.array([[-1, -1, -1], [1, -1, -1], [1, 1, -1], [-1, 1, -1],
                    [-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]])
POINTS = CORNERS / np.sqrt(3.0)

Nodes = dict[int, np.ndarray]


@dataclass
class Slab:
    """The biphasic body, and its side of the contact."""

    places: Nodes
    elements: list[list[int]]
    facets: list[list[int]]
    shear: float
    lame: float
    coefficient: float
    solid_fraction: float


def read_slab(model: pathlib.Path) -> Slab:
    root = ElementTree.parse(model).getroot()

    def number(parent: ElementTree.Element, path: str) -> float:
        return float(parent.findtext(path) or 0.0)

    material = next(entry for entry in root.iterfind("Material/material")
                    if entry.get("type") == "biphasic")
    young, poisson = (number(material, f"solid/{name}") for name in "Ev")
    parts = {domain.get("name") for domain
             in root.iterfind("MeshDomains/SolidDomain")
             if domain.get("mat") == material.get("name")}
    elements = [numbers(entry.text) for part in root.iterfind("Mesh/Elements")
                if part.get("name") in parts for entry in part]
    members = {node for element in elements for node in element}
    contact = next(entry for entry in root.iterfind("Contact/contact")
                   if entry.get("type") == "sliding-biphasic")
    pair = next(entry for entry in root.iterfind("Mesh/SurfacePair")
                if entry.get("name") == contact.get("surface_pair"))
    surfaces = [[numbers(facet.text) for facet in surface]
                for surface in root.iterfind("Mesh/Surface")
                if surface.get("name") in {side.text for side in pair}]
    return Slab(
        places={int(node.get("id", "0")): np.array(
            [float(x) for x in (node.text or "").split(",")])
            for node in root.iterfind("Mesh/Nodes/node")},
        elements=elements,
        facets=next(facets for facets in surfaces
                    if all(node in members for node in facets[0])),
        shear=young / (2.0 * (1.0 + poisson)),
        lame=young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)),
        coefficient=number(contact, "fric_coeff"),
        solid_fraction=number(contact, "contact_frac"))


def read_nodes(path: pathlib.Path) -> tuple[Nodes, dict[int, float]]:
    """Displacements and pressures."""
    if path.read_text().startswith("*Step"):
        rows = read_blocks(path)[-1].rows
    else:
        head, *lines = path.read_text().splitlines()
        names = head.split(",")
        table = [dict(zip(names, map(float, line.split(","))))
                 for line in lines]
        rows = {int(row["node"]): row for row in table}
    return ({node: np.array([row["ux"], row["uy"], row["uz"]])
             for node, row in rows.items()},
            {node: row["p"] for node, row in rows.items()})


def slopes(point: np.ndarray) -> np.ndarray:
    factors = 1.0 + CORNERS * point
    return np.stack([CORNERS[:, i] * factors[:, (i + 1) % 3]
                     * factors[:, (i + 2) % 3] / 8.0 for i in range(3)], axis=1)


def nodal_forces(slab: Slab, moved: Nodes, pressure: dict[int, float]) -> Nodes:
    """What holds each node against the stress."""
    forces = {node: np.zeros(3) for node in slab.places}
    for element in slab.elements:
        before = np.array([slab.places[node] for node in element])
        now = np.array([moved[node] for node in element])
        fluid = np.array([pressure[node] for node in element])
        for point in POINTS:
            by_point = slopes(point)
            present = now.T @ by_point
            gradient = present @ np.linalg.inv(before.T @ by_point)
            volume = np.linalg.det(gradient)
            stress = (slab.shear * (gradient @ gradient.T - np.eye(3))
                      + slab.lame * np.log(volume) * np.eye(3)) / volume
            shapes = np.prod(1.0 + CORNERS * point, axis=1) / 8.0
            stress -= (shapes @ fluid) * np.eye(3)
            shares = (by_point @ np.linalg.inv(present)) @ stress
            shares *= np.linalg.det(present)
            for node, share in zip(element, shares):
                forces[node] += share
    return forces


def normal_areas(slab: Slab, moved: Nodes) -> Nodes:
    """Of the surface around each of its nodes."""
    areas: Nodes = {}
    for facet in slab.facets:
        a, b, c, d = (moved[node] for node in facet)
        share = np.cross(c - a, d - b) / 8.0
        for node in facet:
            areas[node] = areas.get(node, np.zeros(3)) + share
    return areas


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("model", type=pathlib.Path, metavar="MODEL.feb")
    parser.add_argument("nodes", type=pathlib.Path, metavar="NODES")
    args = parser.parse_args(argv)
    slab = read_slab(args.model)
    displacement, pressure = read_nodes(args.nodes)
    moved = {node: place + displacement[node]
             for node, place in slab.places.items() if node in displacement}
    forces = nodal_forces(slab, moved, pressure)
    areas = normal_areas(slab, moved)
    along = across = allowed = 0.0
    total = np.zeros(3)
    for node, area in areas.items():
        size = float(np.linalg.norm(area))
        normal = area / size
        force = forces[node]
        pressing = -float(force @ normal)
        # What holds the node in the plane of a two-dimensional model is none
        # of the contact's.
        rest = force + pressing * normal
        rest[2] = 0.0
        total += force
        if pressing > 0.0:
            along += pressing
            across += float(np.linalg.norm(rest))
            allowed += slab.coefficient * max(
                0.0, pressing
                - (1.0 - slab.solid_fraction) * pressure[node] * size)
    inside = {node for element in slab.elements for node in element}
    free = [forces[node][:2] for node in inside - set(areas)]
    held = sorted(float(np.linalg.norm(force)) for force in free)
    print(f"forces of the contact: {total[0]:.5g}, {total[1]:.5g}")
    print(f"normal forces {along:.5g}, across {across:.5g}: "
          f"{across / along:.4f} of them; the law allows "
          f"{allowed / along:.4f}, and without fluid {slab.coefficient:g}")
    print(f"equilibrium of half of the other nodes within "
          f"{held[len(held) // 2]:.1g}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
