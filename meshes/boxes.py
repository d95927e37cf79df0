#!/usr/bin/env python3
"""Meshes of the simple cases in miniapps/cases, in millimeters, z up.

    confined_compression      a column of cartilage, 0.2 x 0.2 x 0.75
        region   cartilage
        surfaces bottom  z = 0, top  z = 0.75, sides_x, sides_y

    unconfined_compression    a quarter of a disc, radius 1.5, 0.25 high
        region   cartilage
        surfaces bottom  z = 0, top  z = 0.25, side  r = 1.5,
                 symmetry_x  x = 0, symmetry_y  y = 0

    two_columns               two columns, 0.3 x 0.3 x 0.75 each, on top of each
        regions  lower, upper                  other, with meshes that don't match
        surfaces lower_bottom, lower_top, lower_sides_x, lower_sides_y, and the
                 same of the upper column

    column_on_plate           a column, 0.4 x 0.4 x 1, on a plate, 0.1 thick,
        regions  plate, column                  with meshes that don't match
        surfaces plate_bottom, plate_top, plate_sides_x, plate_sides_y, and the
                 same of the column

    osteochondral_core        cartilage, 0.4 x 0.4 x 1, on bone, 1 deep, with meshes
        regions  bone, cartilage                that don't match
        surfaces bone_bottom, bone_top, bone_sides_x, bone_sides_y, and the same
                 of the cartilage

    sliding_layer             one half of a layer of cartilage, 1 high, on which a
        region   cartilage                      body slides along x
        surfaces bottom  z = 0, top  z = 1, sides_x  x = -5.6 and 5.6,
                 sides_y  y = 3.6, symmetry_y  y = 0

Hexahedra, finer towards the surface where fluid leaves.

Sample runs:
  scripts/run_python meshes/boxes.py confined_compression -o column.msh
  scripts/run_python meshes/boxes.py unconfined_compression -o disc.msh
  scripts/run_python meshes/boxes.py two_columns -o two_columns.msh
  scripts/run_python meshes/boxes.py two_columns -o coarse.msh --size 2
  scripts/run_python meshes/boxes.py column_on_plate -o plate.msh --size 2
  scripts/run_python meshes/boxes.py osteochondral_core -o core.msh --size 2
  scripts/run_python meshes/boxes.py sliding_layer -o layer.msh
"""

from __future__ import annotations

import argparse
import sys

import mesh_script

import gmsh
import numpy as np

import gmsh_bodies
import indentation
from gmsh_bodies import Body

QUADRANGLE, HEXAHEDRON = 3, 5   # gmsh's types


def grid(x: np.ndarray, y: np.ndarray, z: np.ndarray,
         names: dict[str, tuple[str, str]], prefix: str = "") -> Body:
    """Hexahedra between planes at these coordinates.

    The names are those of the surfaces at the lowest and the highest x, y, z.
    """
    counts = [len(planes) - 1 for planes in (x, y, z)]
    points = np.array([[a, b, c] for c in z for b in y for a in x])

    def node(i: int, j: int, k: int) -> int:
        return 1 + i + len(x) * (j + len(y) * k)

    corners = {"x": ((0, 4, 7, 3), (1, 2, 6, 5)),
               "y": ((0, 1, 5, 4), (3, 7, 6, 2)),
               "z": ((0, 3, 2, 1), (4, 5, 6, 7))}
    hexahedra: list[int] = []
    faces: dict[str, list[int]] = {
        prefix + name: [] for axis in "zxy" for name in names[axis]}
    for k, j, i in np.ndindex(*counts[::-1]):
        c = [node(i + a, j + b, k + d) for d in (0, 1)
             for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        hexahedra += c
        for axis, cell, cells in zip("xyz", (i, j, k), counts):
            for outside, name, face in zip((cell == 0, cell == cells - 1),
                                           names[axis], corners[axis]):
                if outside:
                    faces[prefix + name] += [c[m] for m in face]
    return Body(points, [(HEXAHEDRON, np.array(hexahedra, dtype=np.int64))],
                {name: [(QUADRANGLE, np.array(nodes, dtype=np.int64))]
                 for name, nodes in faces.items()})


def flatter_upwards(bottom: float, height: float, cells: int,
                    grading: float) -> np.ndarray:
    """Planes of elements that become flatter where a grading is above 1."""
    return bottom + height * (1.0 - np.linspace(1.0, 0.0, cells + 1)**grading)


def box(side: float, bottom: float, height: float, cells: tuple[int, int],
        grading: float, prefix: str = "") -> Body:
    """A column of cells[0] x cells[0] x cells[1] hexahedra.

    A grading above 1 makes the elements flatter towards the top.
    """
    across, up = cells
    xy = np.linspace(0.0, side, across + 1)
    return grid(xy, xy, flatter_upwards(bottom, height, up, grading),
                {"x": ("sides_x",) * 2, "y": ("sides_y",) * 2,
                 "z": ("bottom", "top")}, prefix)


def count(number: float, size: float) -> int:
    """How many elements to take instead of `number`."""
    return max(1, round(number / size))


def confined_compression(size: float) -> dict[str, Body]:
    return {"cartilage": box(0.2, 0.0, 0.75, (count(2, size), count(12, size)),
                             1.5)}


def two_columns(size: float) -> dict[str, Body]:
    return {"lower": box(0.3, 0.0, 0.75, (count(3, size), count(8, size)), 1.0,
                         "lower_"),
            "upper": box(0.3, 0.75, 0.75, (count(2, size), count(11, size)),
                         2.0, "upper_")}


def column_on_plate(size: float) -> dict[str, Body]:
    return {"plate": box(0.4, -0.1, 0.1, (count(3, size), 1), 1.0, "plate_"),
            "column": box(0.4, 0.0, 1.0, (count(2, size), count(16, size)),
                          1.5, "column_")}


def osteochondral_core(size: float) -> dict[str, Body]:
    return {"bone": box(0.4, 0.0, 1.0, (count(2, size), count(4, size)), 1.0,
                        "bone_"),
            "cartilage": box(0.4, 1.0, 1.0, (count(3, size), count(12, size)),
                             1.5, "cartilage_")}


def sliding_layer(size: float) -> dict[str, Body]:
    half_length, width = 5.6, 3.6
    # Finer towards the plane of symmetry, where the body slides.
    y = width * np.linspace(0.0, 1.0, count(7, size) + 1)**1.2
    return {"cartilage": grid(
        np.linspace(-half_length, half_length, count(24, size) + 1), y,
        flatter_upwards(0.0, 1.0, count(3, size), 1.5),
        {"x": ("sides_x",) * 2, "y": ("symmetry_y", "sides_y"),
         "z": ("bottom", "top")})}


def unconfined_compression(size: float) -> dict[str, Body]:
    radius, height = 1.5, 0.25
    gmsh.model.add("disc")
    # The sizes grow from the rim, where fluid leaves, inwards.
    indentation.swept_body([radius], 0.0, [height], count(3, size),
                           0.06 * size * radius, 1.5)
    gmsh.model.mesh.setOrder(2)
    surfaces: dict[str, list[int]] = {}
    volumes = gmsh.model.getEntities(3)
    for _, surface in gmsh.model.getBoundary(volumes, combined=True,
                                             oriented=False):
        x, y, z = np.asarray(gmsh.model.mesh.getNodes(2, surface, True)[1]
                             ).reshape(-1, 3).T
        planes = {"symmetry_x": x, "symmetry_y": y, "bottom": z,
                  "top": z - height}
        flat = [name for name, distance in planes.items()
                if np.abs(distance).max() < 1e-9]
        surfaces.setdefault(flat[0] if flat else "side", []).append(surface)
    body = gmsh_bodies.extract([tag for _, tag in volumes], surfaces)
    return {"cartilage": body}


CASES = {function.__name__: function for function in
         (confined_compression, unconfined_compression, two_columns,
           column_on_plate, osteochondral_core, sliding_layer)}


def parse(argv: list[str] | None = None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("case", choices=CASES)
    parser.add_argument("-o", "--output",
                        help="file to write (default: CASE.msh)")
    parser.add_argument("--size", type=mesh_script.positive, default=1.0,
                        help="factor on all mesh sizes (default: %(default)s)")
    args = parser.parse_args(argv)
    args.output = args.output or f"{args.case}.msh"
    mesh_script.check_output(parser, args.output)
    return args


def main(argv: list[str] | None = None) -> int:
    args = parse(argv)

    def build() -> dict[str, int]:
        bodies = CASES[args.case](args.size)
        regions = {region: i for i, region in enumerate(bodies, 1)}
        names = [name for body in bodies.values() for name in body.surfaces]
        gmsh_bodies.assemble(args.case, bodies, regions,
                             {name: i for i, name in enumerate(names, 1)})
        return regions

    return mesh_script.run("boxes.py", args.output, build)


if __name__ == "__main__":
    sys.exit(main())
