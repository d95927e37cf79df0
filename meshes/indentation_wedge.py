#!/usr/bin/env python3
"""Mesh of a wedge, one element wide, of a layer under a punch or indenter.

An axisymmetric problem at the cost of a plane one, in millimeters, z up:

     z                                     regions    cartilage, indenter
     ^                                     surfaces   bone             z = 0
     |   punch        top                             punch   z = h, r < a
     +-----------+-----------------------+            top     z = h, r > a
     |                                   | side       side             r = R
     +-----------------------------------+--> r       symmetry_y       y = 0
        bone     a                       R            symmetry_turned

symmetry_turned is the plane y = 0 turned about the axis by the angle of the
wedge: what a case holds there by springs across it. A rigid flat punch without
friction needs no body at small strains: its surface is moved. --indenter adds a
body in contact, flat or part of a sphere, on r < a: indenter_bottom,
indenter_top, indenter_side.

A wedge has straight sides: its area is sin(angle)/2 r^2, so that forces of the
whole turn are those of the wedge times 2 pi/sin(angle).

Hexahedra, prisms on the axis; under a punch finest at its rim, where the
traction has no bound, under a sphere even.

Sample runs:
  scripts/run_python meshes/indentation_wedge.py -o wedge.msh
  scripts/run_python meshes/indentation_wedge.py -o coarse.msh --size 2
  scripts/run_python meshes/indentation_wedge.py -o ball.msh --indenter sphere
"""

from __future__ import annotations

import argparse
import sys

import mesh_script

import numpy as np

import gmsh_bodies
from gmsh_bodies import PRISM, TRIANGLE, Body
from indentation import graded

QUADRANGLE, HEXAHEDRON = 3, 5   # gmsh's types
REGIONS = {"cartilage": 1, "indenter": 2}
SURFACES = {"bone": 1, "punch": 2, "top": 3, "side": 4, "symmetry_y": 5,
            "symmetry_turned": 6, "indenter_bottom": 7, "indenter_top": 8,
            "indenter_side": 9}
# Sizes with --size 1, as parts of a.
RIM = 0.005     # at the punch's rim
TOP = 0.03      # at the top
EVEN = 0.06     # under a sphere
GROWTH = 1.8    # of sizes away from there
INDENTER = 1.6  # the indenter is that much coarser: it is far stiffer


def ring_sizes(args: argparse.Namespace, coarser: float = 1.0) -> list[float]:
    """Radial sizes from the axis to a."""
    a = args.indenter_radius
    if args.indenter == "sphere":
        count = max(2, round(1 / (EVEN * args.size * coarser)))
        return [a / count] * count
    return graded(a, RIM * args.size * coarser * a, GROWTH)[::-1]


def wedge(r: np.ndarray, z: np.ndarray, angle: float, bottom: str,
          tops: list[str], side: str) -> Body:
    """A body between two planes that meet on the axis.

    z: heights at the radii, shape (levels, radii); the others are names of its
    faces, those of the top one for each ring.
    """
    levels, columns = z.shape[0], z.shape[1] - 1
    # Nodes of the axis come once; those of the two planes follow each other.
    axis = np.stack([np.zeros(levels), np.zeros(levels), z[:, 0]], axis=1)
    radii = np.broadcast_to(r[1:], (levels, columns))
    planes = [np.stack([radii * np.cos(turn), radii * np.sin(turn), z[:, 1:]],
                       axis=2).reshape(-1, 3) for turn in (0.0, angle)]

    def node(i: int, k: int, plane: int) -> int:
        if i == 0:
            return 1 + k
        return levels * (1 + plane * columns) + k * columns + i

    hexahedra: list[int] = []
    prisms: list[int] = []
    faces: dict[str, dict[int, list[int]]] = {}

    def add_face(name: str, nodes: list[int]) -> None:
        corners = list(dict.fromkeys(nodes))    # two coincide on the axis
        kind = TRIANGLE if len(corners) == 3 else QUADRANGLE
        faces.setdefault(name, {}).setdefault(kind, []).extend(corners)

    for k in range(levels - 1):
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
                add_face(bottom, [p, t, s, q])
            if k == levels - 2:
                add_face(tops[i], [u, v, w, x])
            if i == columns - 1:
                add_face(side, [q, s, w, v])
    return Body(
        np.concatenate([axis, *planes]),
        [(HEXAHEDRON, np.array(hexahedra)), (PRISM, np.array(prisms))],
        {name: [(kind, np.array(nodes)) for kind, nodes in parts.items()]
         for name, parts in faces.items()})


def layer(args: argparse.Namespace) -> Body:
    a = args.indenter_radius
    inner = ring_sizes(args)
    outer = graded(args.radius - a, inner[-1], GROWTH)
    r = np.cumsum([0.0, *inner, *outer])
    heights = np.cumsum([0.0, *reversed(graded(
        args.thickness, TOP * args.size * a, GROWTH))])
    return wedge(r, np.repeat(heights[:, None], len(r), axis=1),
                 np.radians(args.angle), "bone",
                 ["punch"] * len(inner) + ["top"] * len(outer), "side")


def indenter(args: argparse.Namespace) -> Body:
    """As high as it is wide; it touches the layer in all points or in one."""
    a = args.indenter_radius
    r = np.cumsum([0.0, *ring_sizes(args, INDENTER)])
    rise = np.zeros_like(r)
    if args.indenter == "sphere":
        rise = args.sphere_radius - np.sqrt(args.sphere_radius**2 - r**2)
    first = (EVEN if args.indenter == "sphere" else TOP) * INDENTER
    part = np.cumsum([0.0, *graded(1.0, first * args.size, GROWTH)])[:, None]
    z = args.thickness + (1 - part) * rise + part * (a + rise[-1])
    return wedge(r, z, np.radians(args.angle), "indenter_bottom",
                 ["indenter_top"] * (len(r) - 1), "indenter_side")


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
    parser.add_argument("--indenter", choices=("none", "flat", "sphere"),
                        default="none", help="a body in contact (default: "
                        "%(default)s, a punch whose surface is moved)")
    parser.add_argument("--sphere-radius", type=mesh_script.positive,
                        default=1.5, help="mm (default: %(default)s)")
    args = parser.parse_args(argv)
    if args.indenter_radius >= args.radius:
        parser.error(f"--indenter-radius {args.indenter_radius:g} must be "
                     f"smaller than --radius {args.radius:g}")
    if args.indenter == "sphere" and args.sphere_radius <= args.indenter_radius:
        parser.error(f"--sphere-radius {args.sphere_radius:g} must be larger "
                     f"than --indenter-radius {args.indenter_radius:g}")
    if args.angle > 30:
        parser.error(f"--angle {args.angle:g} is more than 30")
    mesh_script.check_output(parser, args.output)
    return args


def main(argv: list[str] | None = None) -> int:
    args = parse(argv)

    def build() -> dict[str, int]:
        bodies = {"cartilage": layer(args)}
        if args.indenter != "none":
            bodies["indenter"] = indenter(args)
        regions = {name: REGIONS[name] for name in bodies}
        used = {name for body in bodies.values() for name in body.surfaces}
        gmsh_bodies.assemble(
            "indentation_wedge", bodies, regions,
            {name: tag for name, tag in SURFACES.items() if name in used})
        return regions

    return mesh_script.run("indentation_wedge.py", args.output, build)


if __name__ == "__main__":
    sys.exit(main())
