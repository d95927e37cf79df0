#!/usr/bin/env python3
"""Mesh of two blocks with round faces that touch: Hertz's contact.

A quarter, x >= 0 and y >= 0, in millimeters, z up. The faces in contact are
the paraboloids z = -r^2/(2 R) and z = r^2/(2 R'), which touch at the origin.
Hexahedra of second order, uniform as far as the contact is expected to reach
and growing from there.

    regions   lower, upper
    surfaces  symmetry_x  x = 0, symmetry_y  y = 0
              lower_contact, lower_bottom, lower_sides
              upper_contact, upper_top, upper_sides

Sample runs:
  scripts/run_python meshes/hertz.py -o hertz.msh
  scripts/run_python meshes/hertz.py -o coarse.msh --size 1.5
"""

from __future__ import annotations

import argparse
import sys

import mesh_script

import numpy as np

import gmsh_bodies
from gmsh_bodies import Body
from lagrange_element import (
    HEXAHEDRON, HEXAHEDRON_NODES, QUADRANGLE, QUADRANGLE_NODES)

# Where the nodes of second order are in an element, in halves of its edges.
NODES = HEXAHEDRON_NODES[2]
# Corners of its faces, outward, by the direction in which they look.
FACES = {(0, 0): (0, 4, 7, 3), (0, 1): (1, 2, 6, 5), (1, 0): (0, 1, 5, 4),
         (1, 1): (3, 7, 6, 2), (2, 0): (0, 3, 2, 1), (2, 1): (4, 5, 6, 7)}


def graded(s: np.ndarray, contact: float, extent: float) -> np.ndarray:
    """From 0..1 to 0..extent, uniform up to 1.3 times the contact radius."""
    part = 0.55
    slope = 1.3 * contact / part
    beyond = np.maximum(s - part, 0.0) / (1.0 - part)
    return slope * s + (extent - slope) * beyond**3


def face_nodes(corners: tuple[int, ...]) -> list[tuple[int, int, int]]:
    """The nine nodes of a face in gmsh's order, in halves of edges."""
    origin, first, _, second = NODES[list(corners)]
    return [tuple(origin + (i * (first - origin) + j * (second - origin)) // 2)
            for i, j in QUADRANGLE_NODES[2]]


def block(cells: int, radius: float, contact: float, extent: float,
          side: str) -> Body:
    """The block below or above the plane z = 0, with cells^3 elements."""
    n = 2 * cells + 1
    s = np.linspace(0.0, 1.0, n)
    x = graded(s, contact, extent)
    sign = -1.0 if side == "lower" else 1.0
    # Depth runs so that elements are right-handed in both blocks.
    depth = s[::-1] if side == "lower" else s
    points = np.array([[a, b, sign * (graded(d, contact, extent)
                                      + (1.0 - d) * (a * a + b * b)
                                      / (2.0 * radius))]
                       for d in depth for b in x for a in x])

    def number(i: int, j: int, k: int) -> int:
        return 1 + i + n * (j + n * k)

    inner = 1 if side == "lower" else 0
    outer = "bottom" if side == "lower" else "top"
    names = {(0, 0): "symmetry_x", (1, 0): "symmetry_y",
             (0, 1): f"{side}_sides", (1, 1): f"{side}_sides",
             (2, inner): f"{side}_contact", (2, 1 - inner): f"{side}_{outer}"}
    hexahedra: list[int] = []
    faces: dict[str, list[int]] = {name: [] for name in names.values()}
    for element in np.ndindex(cells, cells, cells):
        first = 2 * np.array(element)
        hexahedra += [number(*(first + node)) for node in NODES]
        for (axis, end), corners in FACES.items():
            if element[axis] == end * (cells - 1):
                faces[names[axis, end]] += [number(*(first + node))
                                            for node in face_nodes(corners)]
    return Body(points, [(HEXAHEDRON[2], np.array(hexahedra, dtype=np.int64))],
                {name: [(QUADRANGLE[2], np.array(nodes, dtype=np.int64))]
                 for name, nodes in faces.items()})


def parse(argv: list[str] | None = None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", default="hertz.msh",
                        help="file to write (default: %(default)s)")
    parser.add_argument("--size", type=mesh_script.positive, default=1.0,
                        help="factor on all mesh sizes (default: %(default)s)")
    for name, value, text in (
            ("lower-radius", 100.0, "R of the lower block"),
            ("upper-radius", 100.0, "R' of the upper block"),
            ("contact", 1.0, "contact radius that is expected"),
            ("extent", 10.0, "edges of the blocks")):
        parser.add_argument(f"--{name}", type=mesh_script.positive,
                            default=value,
                            help=f"{text}, mm (default: %(default)s)")
    args = parser.parse_args(argv)
    mesh_script.check_output(parser, args.output)
    if args.extent <= 3.0 * args.contact:
        parser.error("--extent must be more than three times --contact")
    if min(args.lower_radius, args.upper_radius) <= 5.0 * args.extent:
        parser.error("the radii must be more than five times --extent: the "
                     "theory is that of half-spaces")
    return args


def main(argv: list[str] | None = None) -> int:
    args = parse(argv)

    def build() -> dict[str, int]:
        # The destination is the finer one.
        bodies = {side: block(max(3, round(cells / args.size)), radius,
                              args.contact, args.extent, side)
                  for side, cells, radius in
                  (("lower", 12, args.lower_radius),
                   ("upper", 9, args.upper_radius))}
        regions = {region: i for i, region in enumerate(bodies, 1)}
        names = dict.fromkeys(name for body in bodies.values()
                              for name in body.surfaces)
        gmsh_bodies.assemble("hertz", bodies, regions,
                             {name: i for i, name in enumerate(names, 1)})
        return regions

    return mesh_script.run("hertz.py", args.output, build)


if __name__ == "__main__":
    sys.exit(main())
