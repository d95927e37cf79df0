#!/usr/bin/env python3
"""Mesh of a cylinder of cartilage under a flat-ended porous indenter.

Quarter model, x >= 0 and y >= 0, in millimeters, z up (Guo and Spilker 2014,
section 3.1):

     z                                     regions    cartilage, indenter
     ^                                     surfaces   bone              z = 0
     |  indenter_top                                  cartilage_top     z = h
     +-----------+                                    cartilage_side    r = R
     |           | indenter_side                      indenter_bottom   z = h
     |           |                                    indenter_side     r = a
     +-----------+-----------------------+            indenter_top
     |    cartilage_top          cartilage_side       symmetry_x        x = 0
     +-----------------------------------+--> r       symmetry_y        y = 0
        bone     a                       R

The two bodies share no nodes, and their meshes do not match where they touch.
The contact traction grows like (a^2 - r^2)^(-1/2) towards the indenter's rim,
so that is where the small elements are; the circle r = a on top of the
cartilage is a mesh line, for quadrature not to straddle the singularity.

Sample runs:
  scripts/run_python meshes/indentation.py -o indentation.msh        # 22,000 tets
  scripts/run_python meshes/indentation.py -o coarse.msh --size 1.9  # 5,500
  scripts/run_python meshes/indentation.py -o fine.msh --size 0.55   # 110,000
  scripts/run_python meshes/indentation.py -o curved.msh --order 2
  scripts/run_python meshes/indentation.py -o swept.msh --hex
  scripts/run_python meshes/indentation.py -o bricks.msh --hex --size 1.5 \\
    --rim 0.0034 --growth 1.2                             # 5,096, for order 1
"""

from __future__ import annotations

import argparse
import math
import sys

import mesh_script

import gmsh

import gmsh_bodies
from gmsh_bodies import Body

REGIONS = {"cartilage": 1, "indenter": 2}
SURFACES = {"bone": 1, "cartilage_top": 2, "cartilage_side": 3,
            "indenter_bottom": 4, "indenter_top": 5, "indenter_side": 6,
            "symmetry_x": 7, "symmetry_y": 8}

# Sizes of the mesh for --size 1, as parts of the indenter's radius. In an
# axisymmetric study of the elastic problem with quadratic displacements the
# error of the force came from the rim almost alone: 0.6 % with elements of
# 0.03 there, 0.2 % with 0.01 and stronger grading, at comparable cost.
UNDER = 0.1             # under the indenter
FAR = 0.35              # far from it
GROWTH = 0.28           # of the size with the distance to the rim; scales too
INSIDE = 0.2            # in the indenter, which is far stiffer,
INDENTER = 3.0          # and there coarser at the rim by this factor
GROWTH_INDENTER = 0.35
STEEPEST = 0.5          # growth that leaves well-shaped elements


def tetrahedra(corners: list[tuple[float, float]], sizes: list[str]) -> None:
    """Meshes a body of revolution in a model of its own.

    The corners (r, z) go round the profile, on the axis first and last; the
    size is the least of the formulas, which are in x, y and z.
    """
    occ = gmsh.model.occ
    points = [occ.addPoint(r, 0, z) for r, z in corners]
    lines = [occ.addLine(p, q)
             for p, q in zip(points, points[1:] + points[:1])]
    profile = occ.addPlaneSurface([occ.addCurveLoop(lines)])
    occ.revolve([(2, profile)], 0, 0, 0, 0, 0, 1, math.pi / 2)
    occ.synchronize()

    # MathEval, unlike a size callback, is the same in all versions of gmsh.
    field = gmsh.model.mesh.field
    parts = []
    for formula in sizes:
        parts.append(field.add("MathEval"))
        field.setString(parts[-1], "F", formula)
    least = field.add("Min")
    field.setNumbers(least, "FieldsList", parts)
    field.setAsBackgroundMesh(least)
    for option in ("ExtendFromBoundary", "FromPoints", "FromCurvature"):
        gmsh.option.setNumber(f"Mesh.MeshSize{option}", 0)
    gmsh.model.mesh.generate(3)
    # Debian's gmsh is without Netgen, and asking it all the same breaks it.
    netgen = "Netgen" in gmsh.option.getString("General.BuildOptions")
    for method in ("Netgen", "Netgen", "") if netgen else ("",):
        gmsh.model.mesh.optimize(method)


def tetrahedral_bodies(args: argparse.Namespace) -> dict[str, Body]:
    a, radius, h = args.indenter_radius, args.radius, args.thickness
    top = h + args.indenter_height
    unit = args.size * a
    growth = min(STEEPEST, GROWTH * args.size)
    growth_indenter = min(STEEPEST, GROWTH_INDENTER * args.size)
    r = "Sqrt(x*x+y*y)"
    rim = f"Sqrt(({r}-{a!r})^2+(z-{h!r})^2)"
    outside = f"0.5*({r}-{a!r}+Abs({r}-{a!r}))"

    gmsh.model.add("cartilage")
    tetrahedra([(0, 0), (radius, 0), (radius, h), (a, h), (0, h)],
               [f"{args.rim * unit!r}+{growth!r}*{rim}",
                f"{UNDER * unit!r}+{growth!r}*{outside}",
                f"{FAR * unit!r}"])
    cartilage = take_body("cartilage", args)
    gmsh.model.add("indenter")
    tetrahedra([(0, h), (a, h), (a, top), (0, top)],
               [f"{INDENTER * args.rim * unit!r}+{growth_indenter!r}*{rim}",
                f"{INSIDE * unit!r}"])
    return {"cartilage": cartilage, "indenter": take_body("indenter", args)}


def graded(length: float, first: float, growth: float) -> list[float]:
    """Sizes that add up to the length, the first the smallest."""
    count = max(1, round(math.log(1 + length * (growth - 1) / first)
                         / math.log(growth)))
    sizes = [growth**i for i in range(count)]
    return [length * size / sum(sizes) for size in sizes]


def swept_body(radii: list[float], bottom: float, layers: list[float],
               eighth: int, rim: float, growth: float) -> None:
    """Sweeps an O-grid of a quarter disc upwards.

    The layers are sizes from the bottom up. The grid has `eighth` elements to
    every 45 degrees; its radial sizes start from `rim` at the first of the
    radii, and grow on both sides of it.
    """
    occ = gmsh.model.occ
    axis = occ.addPoint(0, 0, bottom)
    angles = (0.0, math.pi / 4, math.pi / 2)
    # A core whose middle corner lies a little outside the chord of the other
    # two makes neither its own corner nor those of the ring too blunt.
    core = 0.5 * radii[0]
    circles = [[core, 1.1 * core, core]] + [[r] * 3 for r in radii]
    points = [[occ.addPoint(r * math.cos(t), r * math.sin(t), bottom)
               for r, t in zip(circle, angles)] for circle in circles]

    curves: dict[int, tuple[int, float]] = {}   # divisions and their ratio

    def add(curve: int, sizes: list[float]) -> int:
        ratio = sizes[1] / sizes[0] if len(sizes) > 1 else 1.0
        curves[curve] = (len(sizes), ratio)
        return curve

    even = [1.0] * eighth
    spokes = [add(occ.addLine(axis, points[0][end]), even) for end in (0, 2)]
    arcs = [[add(occ.addLine(p, q), even)
             for p, q in zip(points[0], points[0][1:])]]
    for circle in points[1:]:
        arcs.append([add(occ.addCircleArc(p, axis, q), even)
                     for p, q in zip(circle, circle[1:])])
    rays = []
    for inner, outer, r0, r1 in zip(points, points[1:], [core] + radii, radii):
        sizes = graded(r1 - r0, rim, growth)
        if r0 == core:
            sizes.reverse()
        rays.append([add(occ.addLine(p, q), sizes)
                     for p, q in zip(inner, outer)])

    loops = [[spokes[0], arcs[0][0], arcs[0][1], spokes[1]]]
    for ring, lines in enumerate(rays):
        for side in range(2):
            loops.append([lines[side], arcs[ring + 1][side], lines[side + 1],
                          arcs[ring][side]])
    faces = [(2, occ.addPlaneSurface([occ.addCurveLoop(loop)]))
             for loop in loops]
    height = sum(layers)
    heights = [sum(layers[:i + 1]) / height for i in range(len(layers))]
    heights[-1] = 1.0
    occ.extrude(faces, 0, 0, height, [1] * len(layers), heights, True)
    occ.synchronize()
    for curve, (count, ratio) in curves.items():
        gmsh.model.mesh.setTransfiniteCurve(curve, count + 1, "Progression",
                                            ratio)
    for _, face in faces:
        gmsh.model.mesh.setTransfiniteSurface(face)
        gmsh.model.mesh.setRecombine(2, face)
    gmsh.model.mesh.generate(3)


def hexahedral_bodies(args: argparse.Namespace) -> dict[str, Body]:
    a, radius, h = args.indenter_radius, args.radius, args.thickness
    # Twice the size keeps the aspect of the flattest elements below ten.
    rim = 2 * args.rim * args.size * a

    gmsh.model.add("cartilage")
    layers = graded(h, 1.2 * rim, args.growth)
    swept_body([a, radius], 0.0, layers[::-1], max(1, round(6 / args.size)),
               rim, args.growth)
    cartilage = take_body("cartilage", args)
    gmsh.model.add("indenter")
    layers = graded(args.indenter_height, 1.5 * rim, 1.6)
    swept_body([a], h, layers, max(1, round(5 / args.size)), 1.5 * rim, 1.6)
    return {"cartilage": cartilage, "indenter": take_body("indenter", args)}


def take_body(region: str, args: argparse.Namespace) -> Body:
    """Takes the body out of the current model, its surfaces named."""
    h, top = args.thickness, args.thickness + args.indenter_height
    horizontal = ({"bone": 0.0, "cartilage_top": h} if region == "cartilage"
                  else {"indenter_bottom": h, "indenter_top": top})
    tolerance = 1e-6 * args.radius
    gmsh.model.mesh.setOrder(args.order)
    volumes = gmsh.model.getEntities(3)
    surfaces: dict[str, list[int]] = {}
    for _, surface in gmsh.model.getBoundary(volumes, combined=True,
                                             oriented=False):
        x = gmsh.model.mesh.getNodes(2, surface, True)[1]
        name = f"{region}_side"
        if max(abs(c) for c in x[0::3]) < tolerance:
            name = "symmetry_x"
        elif max(abs(c) for c in x[1::3]) < tolerance:
            name = "symmetry_y"
        for flat, z in horizontal.items():
            if max(abs(c - z) for c in x[2::3]) < tolerance:
                name = flat
        surfaces.setdefault(name, []).append(surface)
    return gmsh_bodies.extract([tag for _, tag in volumes], surfaces)


def parse(argv: list[str] | None = None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", default="indentation.msh",
                        help="file to write (default: %(default)s)")
    parser.add_argument("--size", type=mesh_script.positive, default=1.0,
                        help="factor on all mesh sizes (default: %(default)s)")
    parser.add_argument("--rim", type=mesh_script.positive, default=0.01,
                        help="size of the cartilage's elements at the "
                        "indenter's rim with --size 1, as a part of a "
                        "(default: %(default)s)")
    parser.add_argument("--order", type=int, choices=(1, 2), default=1,
                        help="order of the geometry; 2 curves the sides "
                        "(default: %(default)s)")
    parser.add_argument("--hex", action="store_true",
                        help="swept hexahedra instead of tetrahedra")
    parser.add_argument("--growth", type=mesh_script.positive, default=1.4,
                        help="ratio of neighboring sizes in the cartilage "
                        "with --hex; displacements of order 1 need less than "
                        "the default, %(default)s")
    parser.add_argument("--format", choices=("2.2", "4.1"), default="4.1",
                        help="of the file (default: %(default)s)")
    parser.add_argument("--binary", action="store_true",
                        help="write a binary file")
    parser.add_argument("--radius", type=mesh_script.positive, default=3.0,
                        help="R of the cartilage, mm (default: %(default)s)")
    parser.add_argument("--thickness", type=mesh_script.positive, default=0.75,
                        help="h of the cartilage, mm (default: %(default)s)")
    parser.add_argument("--indenter-radius", type=mesh_script.positive, default=0.75,
                        help="a, mm (default: %(default)s)")
    parser.add_argument("--indenter-height", type=mesh_script.positive, default=0.75,
                        help="mm (default: %(default)s)")
    parser.add_argument("-v", "--verbose", action="store_true",
                        help="let gmsh talk")
    args = parser.parse_args(argv)
    if args.indenter_radius >= args.radius:
        parser.error(f"--indenter-radius {args.indenter_radius:g} must be "
                     f"smaller than --radius {args.radius:g}")
    if args.growth <= 1.0:
        parser.error(f"--growth {args.growth:g} must be more than 1")
    mesh_script.check_output(parser, args.output)
    return args


def main(argv: list[str] | None = None) -> int:
    args = parse(argv)

    def build() -> dict[str, int]:
        bodies = (hexahedral_bodies(args) if args.hex else
                  tetrahedral_bodies(args))
        gmsh_bodies.assemble("indentation", bodies, REGIONS, SURFACES)
        return REGIONS

    return mesh_script.run("indentation.py", args.output, build, args.verbose,
                           float(args.format), args.binary)


if __name__ == "__main__":
    sys.exit(main())
