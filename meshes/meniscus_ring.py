#!/usr/bin/env python3
"""Mesh of an axisymmetric joint: a full ring of meniscus, hexahedra.

The idealized knee compartment, in millimeters, about the z axis: a spherical
layer of femoral cartilage, radius 25, on a ring whose section is a wedge, on a
flat disc of tibial cartilage.

        femoral_cartilage_bone           regions   femoral_cartilage,
      .                        .                   tibial_cartilage, meniscus
       ` - .   _contact  . - '  _rim     surfaces  of cartilage: _bone, _contact,
    |\\_      `  - - '      _/|                     _rim; of the meniscus:
    |___\\                /___|                     _superior, _inferior,
    ----------------------------                   _periphery, _inner
    |    tibial_cartilage      |         origin    on the axis, on top of the
    ----------------------------                   tibial cartilage

The whole turn, or a quarter (symmetry_x: x = 0, symmetry_y: y = 0), or another
wedge, which begins at symmetry_y and ends at symmetry_turned, and which leaves
out the axis (surface axis, radius --hole).

The femur touches the meniscus, and is clear of the tibia.

Sample runs:
  scripts/run_python meshes/meniscus_ring.py -o ring.msh                    # 16,000
  scripts/run_python meshes/meniscus_ring.py -o quarter.msh --angle 90
  scripts/run_python meshes/meniscus_ring.py -o wedge.msh --angle 5 --size 0.25
"""

from __future__ import annotations

import argparse
import sys

import mesh_script

import numpy as np

import gmsh_bodies
import knee_checks
import knee_joint
from gmsh_bodies import Body
from hexahedral_sweep import quads_of, sweep
from quad_plane import QuadMesh, disc, join, quarter_disc, radii_of_disc

FEMUR, TIBIA, MENISCUS = "femoral_cartilage", "tibial_cartilage", "meniscus"
REGIONS = {FEMUR: 1, TIBIA: 2, MENISCUS: 3}

# Edge length (mm) and layers at --size 1.
SIZE, CARTILAGE_LAYERS, MENISCAL_LAYERS = 0.8, 3, 6


def inner_radius(args: argparse.Namespace) -> float:
    """Of the meniscus, where it is as thick as its inner edge should be."""
    drop = args.inner_edge - args.clearance
    return float(np.sqrt(drop * (2 * args.femoral_radius - drop)))


def radii(stops: list[float], size: float, order: int) -> np.ndarray:
    """Of the nodes, the stops among them."""
    pieces = [np.linspace(a, b, order * max(1, round((b - a) / size)) + 1)[1:]
              for a, b in zip(stops[:-1], stops[1:]) if a < b]
    return np.concatenate([stops[:1], *pieces])


def around(args: argparse.Namespace, size: float, angle: float) -> int:
    """How many elements there are over an angle (degrees)."""
    return max(1, round(np.radians(angle) * 0.6 * args.meniscal_radius / size))


def sector(r: np.ndarray, args: argparse.Namespace, size: float,
           names: dict[str, str]) -> QuadMesh:
    """Quadrangles with nodes at these radii, over the angle to be meshed."""
    angle, order = args.angle, args.geometry_order
    turn = np.radians(np.linspace(
        0, angle, order * around(args, size, angle) + 1))
    r = r[:, None]
    patch = np.stack(np.broadcast_arrays(r * np.cos(turn), r * np.sin(turn)),
                     axis=-1)
    if angle == 360:
        patch[:, -1] = patch[:, 0]
    end = "symmetry_x" if angle == 90 else "symmetry_turned"
    names = {"south": "symmetry_y", "north": end, **names}
    return join([patch], lambda number, side: names[side], order)


def plate(args: argparse.Namespace, size: float) -> QuadMesh:
    """A disc, or the part of it that is to be meshed.

    From the meniscus's inner edge on it is made of circles, two of which are
    the meniscus's edges: there the fluid begins to drain.
    """
    inner, order = inner_radius(args), args.geometry_order
    core = max(2, round(0.5 * around(args, size, 90)))
    rings = max(2, round(0.8 * inner / size))
    outer = radii([inner, args.meniscal_radius, args.width], size, order)[1:]
    if args.angle not in (90, 360):
        r = inner * radii_of_disc(core, rings, order)
        r = args.hole + (inner - args.hole) / inner * r
        return sector(np.concatenate([r, outer]), args, size,
                      {"west": "axis", "east": "rim"})
    mesh = disc(2 * core, rings, order, outer / inner) if args.angle == 360 \
        else quarter_disc(core, rings, order, outer / inner)
    mesh.points = inner * mesh.points
    return mesh


def make_bodies(args: argparse.Namespace) -> dict[str, Body]:
    size = SIZE * args.size
    order = args.geometry_order
    layers = order * max(2, round(CARTILAGE_LAYERS / args.size))
    share = np.linspace(0, 1, layers + 1)[None, :, None]
    middle = args.femoral_radius + args.clearance

    def on_sphere(xy: np.ndarray, radius: float) -> np.ndarray:
        """Where the line from the middle to the contact side meets a sphere."""
        down = np.sqrt(args.femoral_radius**2 - (xy**2).sum(axis=1))
        ray = np.column_stack([xy, -down]) / args.femoral_radius
        return np.array([0, 0, middle]) + radius * ray

    mesh = plate(args, size)
    bone = on_sphere(mesh.points,
                     args.femoral_radius - args.femoral_thickness)
    contact = on_sphere(mesh.points, args.femoral_radius)
    # Seen from above, the contact side of the femur is the lower one.
    bodies = {FEMUR: sweep(
        mesh, contact[:, None] + share * (bone - contact)[:, None],
        "contact", "bone", FEMUR)}

    top = np.column_stack([mesh.points, np.zeros(len(mesh.points))])
    down = np.array([0, 0, args.tibial_thickness])
    bodies[TIBIA] = sweep(
        mesh, top[:, None] - (1 - share) * down, "bone", "contact", TIBIA)

    ring = sector(radii([inner_radius(args), args.meniscal_radius], size,
                        order), args, size,
                  {"west": "inner", "east": "periphery"})
    layers = order * max(3, round(MENISCAL_LAYERS / args.size))
    share = np.linspace(0, 1, layers + 1)
    high = on_sphere(ring.points, args.femoral_radius)
    columns = np.repeat(high[:, None], len(share), axis=1)
    columns[:, :, 2] *= share
    bodies[MENISCUS] = knee_joint.settle(
        columns, MENISCUS,
        lambda: sweep(ring, columns, "inferior", "superior", MENISCUS),
        quads_of(bodies[TIBIA], f"{TIBIA}_contact"),
        quads_of(bodies[FEMUR], f"{FEMUR}_contact"))
    return bodies


def parse(argv: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", default="meniscus_ring.msh")
    parser.add_argument("--size", type=mesh_script.positive, default=1.0,
                        help="factor on all element sizes")
    parser.add_argument("--angle", type=mesh_script.positive, default=360.0,
                        help="degrees: 360, 90, or up to 45")
    for name, default, text in (
            ("--femoral-radius", 25.0, "of the femur's contact side"),
            ("--femoral-thickness", 2.0, "of the femoral cartilage"),
            ("--tibial-thickness", 2.5, "of the tibial cartilage"),
            ("--width", 18.0, "radius of both layers' rims"),
            ("--meniscal-radius", 15.0, "of the meniscus's periphery"),
            ("--inner-edge", 0.5, "thickness of the meniscus there"),
            ("--clearance", 0.15, "between the layers on the axis"),
            ("--hole", 0.05, "radius left out of wedges on the axis")):
        parser.add_argument(name, type=mesh_script.positive, default=default,
                            help=f"{text} (mm, default {default})")
    mesh_script.add_geometry_order(parser)
    parser.add_argument("--verbose", action="store_true")
    args = parser.parse_args(argv)
    if args.angle not in (90, 360) and args.angle > 45:
        parser.error("--angle must be 360, 90, or at most 45")
    if args.width >= 0.95 * args.femoral_radius:
        parser.error("--width must be less than 0.95 of --femoral-radius")
    if args.femoral_thickness >= 0.5 * args.femoral_radius:
        parser.error("--femoral-thickness must be less than half of "
                     "--femoral-radius")
    if args.meniscal_radius > args.width:
        parser.error("--meniscal-radius must not be more than --width")
    if args.inner_edge <= args.clearance:
        parser.error("--inner-edge must be more than --clearance")
    drop = args.inner_edge - args.clearance
    if drop * (2 * args.femoral_radius - drop) > 0.7 * args.meniscal_radius**2:
        parser.error("--inner-edge leaves no room for the wedge")
    if args.hole >= 0.5 * inner_radius(args):
        parser.error("--hole must be less than half of the meniscus's inner "
                     "radius")
    mesh_script.check_output(parser, args.output)
    return args


def main(argv: list[str] | None = None) -> int:
    args = parse(argv)

    def build() -> dict[str, int]:
        bodies = make_bodies(args)
        knee_checks.check_quality(bodies)
        names = sorted({s for body in bodies.values() for s in body.surfaces})
        gmsh_bodies.assemble("meniscus_ring", bodies, REGIONS,
                             {name: i for i, name in enumerate(names, 1)})
        return REGIONS

    return mesh_script.run("meniscus_ring.py", args.output, build,
                           args.verbose, binary=True)


if __name__ == "__main__":
    sys.exit(main())
