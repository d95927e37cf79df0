#!/usr/bin/env python3
"""Mesh of an idealized glenohumeral joint: two layers of cartilage on bone.

Guo and Spilker 2014, section 3.2. In millimeters, the axis is z, the layers
touch at (0, 0, t); a quarter, x >= 0 and y >= 0, unless --full:

      .  humeral_bone      .        regions    glenoid, humeral
       ` .             . '          surfaces   glenoid_bone, glenoid_contact,
     `     ` - ... - '     '                   glenoid_rim,
       ` .             . ' humeral_rim         humeral_bone, humeral_contact,
          ` - ... - '                          humeral_rim,
      \\_             _/  humeral_contact       symmetry_x  x = 0
   |\\__ ` ------- ' __/|  glenoid_contact      symmetry_y  y = 0
   \\__ `---------' __/   glenoid_rim
      ` --------- '      glenoid_bone

Glenoid: its contact side is part of a sphere of radius 26, its bone side of one
of 34.5, it is 1.5 thick on the axis and has a rim of radius 11.5, where it is
2.2 thick. Humeral head: both sides are parts of spheres of radius 23.5 with
their centers 1.5 apart along the axis, rim radius 19.1, so that it thins to 0.9.

All elements are of second order with their nodes on the spheres: the facets of
straight ones would overlap by h^2/(8 R), more than the first gaps. They are
tetrahedra, or hexahedra with --hex.

Sample runs:
  scripts/run_python meshes/glenohumeral.py -o glenohumeral.msh   # 16,500 tets
  scripts/run_python meshes/glenohumeral.py -o coarse.msh --size 1.6
  scripts/run_python meshes/glenohumeral.py -o full.msh --full --size 2
  scripts/run_python meshes/glenohumeral.py -o swept.msh --hex    # 2,784 hexes
"""

from __future__ import annotations

import argparse
import sys

import mesh_script

import gmsh
import numpy as np

import curved_layer
import gmsh_bodies
import hexahedral_sweep
import quad_plane
from curved_layer import Surface
from gmsh_bodies import Body

REGIONS = {"glenoid": 1, "humeral": 2}
SURFACES = {"glenoid_bone": 1, "glenoid_contact": 2, "glenoid_rim": 3,
            "humeral_bone": 4, "humeral_contact": 5, "humeral_rim": 6,
            "symmetry_x": 7, "symmetry_y": 8}

# Sizes of the mesh for --size 1 (mm), and layers. The glenoid is the
# destination, and the finer one.
GLENOID = 0.66
HUMERAL = 0.85
GLENOID_LAYERS = 5
HUMERAL_LAYERS = 4
# Names of the lower and the upper surface.
FACES = {"glenoid": ("bone", "contact"), "humeral": ("contact", "bone")}
# Beyond the glenoid's rim the humeral elements grow with the distance.
GROWTH = 0.12
# Hexahedra: edges of the core of a quarter, rings around it, and layers.
GLENOID_HEX = (12, 9, 4)
HUMERAL_HEX = (12, 8, 4)


def names(body: str) -> dict[str, str]:
    lower, upper = FACES[body]
    return {"lower": f"{body}_{lower}", "upper": f"{body}_{upper}",
            "rim": f"{body}_rim", "symmetry_x": "symmetry_x",
            "symmetry_y": "symmetry_y"}


def sides(body: str, args: argparse.Namespace) -> tuple[Surface, Surface]:
    """The lower and the upper surface."""
    sphere = curved_layer.sphere
    if body == "glenoid":
        return (sphere(args.glenoid_bone_radius, 0.0),
                sphere(args.glenoid_radius, args.glenoid_thickness))
    top = args.glenoid_thickness + args.gap
    return (sphere(args.humeral_radius, top),
            sphere(args.humeral_radius, top + args.humeral_thickness))


def tetrahedral_bodies(args: argparse.Namespace) -> dict[str, Body]:
    def layers(count: int) -> int:
        return max(1, round(count / args.size))

    def humeral_size(r: float) -> float:
        beyond = max(0.0, r - args.glenoid_width)
        return HUMERAL * args.size + GROWTH * beyond

    glenoid = curved_layer.disc(args.glenoid_width, args.full,
                                lambda r: GLENOID * args.size)
    humeral = curved_layer.disc(args.humeral_width, args.full, humeral_size)
    return {body: curved_layer.sweep(disc, *sides(body, args), layers(count),
                                     names(body))
            for body, disc, count in (("glenoid", glenoid, GLENOID_LAYERS),
                                      ("humeral", humeral, HUMERAL_LAYERS))}


def hexahedral_bodies(args: argparse.Namespace) -> dict[str, Body]:
    def body(name: str, width: float, counts: tuple[int, ...]) -> Body:
        core, rings, layers = (max(1, round(n / args.size)) for n in counts)
        mesh = (quad_plane.disc(2 * core, rings, 2) if args.full else
                quad_plane.quarter_disc(core, rings, 2))
        mesh.points = width * mesh.points
        x, y = mesh.points.T[:, :, None]
        lower, upper = (side(x, y) for side in sides(name, args))
        share = np.linspace(0, 1, 2 * layers + 1)
        columns = np.stack(np.broadcast_arrays(
            x, y, (1 - share) * lower + share * upper), axis=-1)
        return hexahedral_sweep.sweep(mesh, columns, *FACES[name], name)

    return {"glenoid": body("glenoid", args.glenoid_width, GLENOID_HEX),
            "humeral": body("humeral", args.humeral_width, HUMERAL_HEX)}


def parse(argv: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter)

    parser.add_argument("-o", "--output", default="glenohumeral.msh")
    parser.add_argument("--size", type=mesh_script.positive, default=1.0,
                        help="factor on all element sizes")
    parser.add_argument("--full", action="store_true",
                        help="the whole joint instead of a quarter")
    parser.add_argument("--hex", action="store_true",
                        help="swept hexahedra instead of tetrahedra")
    for name, default, text in (
            ("--glenoid-radius", 26.0, "of the contact side"),
            ("--glenoid-bone-radius", 34.5, "of the bone side"),
            ("--glenoid-thickness", 1.5, "on the axis"),
            ("--glenoid-width", 11.5, "radius of the rim"),
            ("--humeral-radius", 23.5, "of both sides"),
            ("--humeral-thickness", 1.5, "on the axis"),
            ("--humeral-width", 19.1, "radius of the rim")):
        parser.add_argument(name, type=mesh_script.positive, default=default,
                            help=f"{text} (mm, default {default})")
    parser.add_argument("--gap", type=float, default=0.0,
                        help="between the layers on the axis (mm)")
    parser.add_argument("--verbose", action="store_true")
    args = parser.parse_args(argv)
    for width, radius in (("glenoid_width", "glenoid_radius"),
                          ("glenoid_width", "glenoid_bone_radius"),
                          ("humeral_width", "humeral_radius")):
        if getattr(args, width) >= 0.98 * getattr(args, radius):
            parser.error(f"--{width} must be less than 0.98 of --{radius}"
                         .replace("_", "-"))
    mesh_script.check_output(parser, args.output)
    return args


def main(argv: list[str] | None = None) -> int:
    args = parse(argv)

    def build() -> dict[str, int]:
        surfaces = {name: tag for name, tag in SURFACES.items()
                    if not args.full or not name.startswith("symmetry")}
        bodies = (hexahedral_bodies(args) if args.hex else
                  tetrahedral_bodies(args))
        gmsh_bodies.assemble("glenohumeral", bodies, REGIONS, surfaces)
        return REGIONS

    return mesh_script.run("glenohumeral.py", args.output, build, args.verbose,
                           binary=True)


if __name__ == "__main__":
    sys.exit(main())
