#!/usr/bin/env python3
"""Mesh of a wedge, one element wide, of a layer under a flat-ended punch.

An axisymmetric problem at the cost of a plane one, in millimeters, z up:

     z                                     region     cartilage
     ^                                     surfaces   bone             z = 0
     |   punch        top                             punch   z = h, r < a
     +-----------+-----------------------+            top     z = h, r > a
     |                                   | side       side             r = R
     +-----------------------------------+--> r       symmetry_y       y = 0
        bone     a                       R            symmetry_turned

symmetry_turned is the plane y = 0 turned about the axis by the angle of the
wedge: what a case holds there by springs across it.

A wedge has straight sides: its area is sin(angle)/2 r^2, so that forces of the
whole turn are those of the wedge times 2 pi/sin(angle).

Hexahedra, prisms on the axis, finest at the punch's rim, where the traction has
no bound.

Sample runs:
  scripts/run_python meshes/indentation_wedge.py -o wedge.msh
  scripts/run_python meshes/indentation_wedge.py -o coarse.msh --size 2
"""

from __future__ import annotations

import argparse
import sys

import mesh_script

import numpy as np

import gmsh_bodies
from gmsh_bodies import Body
from indentation import graded

TRIANGLE, QUADRANGLE, HEXAHEDRON, PRISM = 2, 3, 5, 6    # gmsh's types
REGIONS = {"cartilage": 1}
SURFACES = {"bone": 1, "punch": 2, "top": 3, "side": 4, "symmetry_y": 5,
            "symmetry_turned": 6}
RIM = 0.005      # size at the punch's rim with --size 1, as a part of a
TOP = 0.03      # size at the top
GROWTH = 1.8    # of sizes away from there


def coordinates(args: argparse.Namespace) -> tuple[np.ndarray, np.ndarray]:
    """Radii and heights of the nodes, ascending."""
    a = args.indenter_radius
    rim = RIM * args.size * a
    inner = np.cumsum([0.0, *reversed(graded(a, rim, GROWTH))])
    outer = a + np.cumsum(graded(args.radius - a, rim, GROWTH))
    heights = np.cumsum([0.0, *reversed(graded(
        args.thickness, TOP * args.size * a, GROWTH))])
    return np.concatenate([inner, outer]), heights


def wedge(args: argparse.Namespace) -> Body:
    r, z = coordinates(args)
    turn = np.radians(args.angle)
    # Nodes of the axis come once; those of the two planes follow each other.
    axis = np.array([[0.0, 0.0, height] for height in z])
    planes = [np.array([[radius * np.cos(angle), radius * np.sin(angle), height]
                        for height in z for radius in r[1:]])
              for angle in (0.0, turn)]
    columns = len(r) - 1

    def node(i: int, k: int, plane: int) -> int:
        if i == 0:
            return 1 + k
        return len(z) * (1 + plane * columns) + k * columns + i

    hexahedra: list[int] = []
    prisms: list[int] = []
    faces: dict[str, dict[int, list[int]]] = {name: {} for name in SURFACES}

    def add_face(name: str, nodes: list[int]) -> None:
        corners = list(dict.fromkeys(nodes))    # two coincide on the axis
        kind = TRIANGLE if len(corners) == 3 else QUADRANGLE
        faces[name].setdefault(kind, []).extend(corners)

    for k in range(len(z) - 1):
        for i in range(columns):
            rings = [[node(i, level, 0), node(i + 1, level, 0),
                      node(i + 1, level, 1), node(i, level, 1)]
                     for level in (k, k + 1)]
            if i == 0:
                prisms += rings[0][:3] + rings[1][:3]
            else:
                hexahedra += rings[0] + rings[1]
            (p, q, s, t), (u, v, w, x) = rings
            add_face("symmetry_y", [p, q, v, u])
            add_face("symmetry_turned", [t, x, w, s])
            if k == 0:
                add_face("bone", [p, t, s, q])
            if k == len(z) - 2:
                inside = r[i + 1] < args.indenter_radius * (1 + 1e-9)
                add_face("punch" if inside else "top", [u, v, w, x])
            if i == columns - 1:
                add_face("side", [q, s, w, v])
    return Body(
        np.concatenate([axis, *planes]),
        [(HEXAHEDRON, np.array(hexahedra)), (PRISM, np.array(prisms))],
        {name: [(kind, np.array(nodes)) for kind, nodes in parts.items()]
         for name, parts in faces.items()})


def parse(argv: list[str] | None = None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", default="indentation_wedge.msh",
                        help="file to write (default: %(default)s)")
    parser.add_argument("--size", type=mesh_script.positive, default=1.0,
                        help="factor on all mesh sizes (default: %(default)s)")
    parser.add_argument("--angle", type=mesh_script.positive, default=5.0,
                        help="of the wedge, degrees (default: %(default)s)")
    parser.add_argument("--radius", type=mesh_script.positive, default=3.0,
                        help="R of the layer, mm (default: %(default)s)")
    parser.add_argument("--thickness", type=mesh_script.positive, default=0.75,
                        help="h of the layer, mm (default: %(default)s)")
    parser.add_argument("--indenter-radius", type=mesh_script.positive,
                        default=0.75, help="a, mm (default: %(default)s)")
    args = parser.parse_args(argv)
    if args.indenter_radius >= args.radius:
        parser.error(f"--indenter-radius {args.indenter_radius:g} must be "
                     f"smaller than --radius {args.radius:g}")
    if args.angle > 30:
        parser.error(f"--angle {args.angle:g} is more than 30")
    mesh_script.check_output(parser, args.output)
    return args


def main(argv: list[str] | None = None) -> int:
    args = parse(argv)

    def build() -> dict[str, int]:
        gmsh_bodies.assemble("indentation_wedge", {"cartilage": wedge(args)},
                             REGIONS, SURFACES)
        return REGIONS

    return mesh_script.run("indentation_wedge.py", args.output, build)


if __name__ == "__main__":
    sys.exit(main())
