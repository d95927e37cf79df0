#!/usr/bin/env python3
"""Usage: gmsh_models.py DIRECTORY

Lets gmsh make the meshes that the tests of the reader of meshes read:
MODEL.VERSION.KIND.orderN[.serendipity].msh. Beside those of curved models,
*.points has points of their elements as gmsh has them, a line each: number of
the element, x, y, z; the points LOCAL_POINTS of each element, in order.
"""

from __future__ import annotations

import itertools
import math
import os
import pathlib
import sys
from typing import Callable

import gmsh

CELLS = ("tetrahedra", "hexahedra", "prisms")
# In gmsh's tetrahedron, prism, hexahedron and pyramid alike.
LOCAL_POINTS = (0.2, 0.1, 0.3, 0.5, 0.25, 0.2)


def group(dimension: int, entities: list[int], tag: int, name: str) -> None:
    gmsh.model.addPhysicalGroup(dimension, entities, tag)
    gmsh.model.setPhysicalName(dimension, tag, name)


def group_all(dimension: int, tag: int, name: str) -> None:
    group(dimension, [e for _, e in gmsh.model.getEntities(dimension)], tag,
          name)


def surfaces_at(z: float) -> list[int]:
    """Those with their centers of mass at a height."""
    return [s for _, s in gmsh.model.getEntities(2)
            if abs(gmsh.model.occ.getCenterOfMass(2, s)[2] - z) < 1e-6]


def set_size(largest: float) -> None:
    gmsh.option.setNumber("Mesh.MeshSizeMax", largest)


def sweep(surface: int, height: float, layers: int, cells: str) -> None:
    """What a sweep of a surface in z makes, with elements of the kind."""
    structure = () if cells == "tetrahedra" else ([layers], [], True)
    gmsh.model.occ.extrude([(2, surface)], 0, 0, height, *structure)
    gmsh.model.occ.synchronize()
    if cells == "hexahedra":
        gmsh.model.mesh.setRecombine(2, surface)


def box(cells: str) -> None:
    """[0,1] x [0,2] x [0,3], of a few elements."""
    set_size(1.0)
    base = gmsh.model.occ.addRectangle(0, 0, 0, 1, 2)
    gmsh.model.occ.synchronize()
    if cells == "hexahedra":
        gmsh.model.mesh.setTransfiniteSurface(base)
    sweep(base, 3.0, 3, cells)
    group(2, surfaces_at(0.0), 1, "bottom")
    group(2, surfaces_at(3.0), 2, "top")
    group(2, surfaces_at(1.5), 3, "sides")
    group_all(3, 1, "box")


def cylinder(cells: str, size: float) -> None:
    """Of radius 1 and height 2."""
    set_size(size)
    gmsh.option.setNumber("Mesh.MeshSizeMin", size)
    base = gmsh.model.occ.addDisk(0, 0, 0, 1, 1)
    sweep(base, 2.0, math.ceil(2.0 / size), cells)
    group(2, surfaces_at(0.0), 11, "bottom")
    group(2, surfaces_at(2.0), 12, "top")
    group(2, surfaces_at(1.0), 13, "mantle")
    group_all(3, 21, "cylinder")


def ball(size: float) -> None:
    """Of radius 1 around the origin."""
    set_size(size)
    gmsh.option.setNumber("Mesh.MeshSizeMin", size)
    gmsh.model.occ.addSphere(0, 0, 0, 1)
    gmsh.model.occ.synchronize()
    group_all(2, 5, "sphere")
    group_all(3, 4, "ball")


def pyramids() -> None:
    """The unit cube of six that meet in its center."""
    volume = gmsh.model.addDiscreteEntity(3)
    corners = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1,
               0, 1, 1, 0.5, 0.5, 0.5]
    gmsh.model.mesh.addNodes(3, volume, list(range(1, 10)), corners)
    gmsh.model.mesh.addElementsByType(
        volume, gmsh.model.mesh.getElementType("Pyramid", 1),
        list(range(1, 7)),
        [1, 2, 3, 4, 9, 8, 7, 6, 5, 9, 1, 5, 6, 2, 9,
         2, 6, 7, 3, 9, 3, 7, 8, 4, 9, 4, 8, 5, 1, 9])
    group_all(3, 1, "cube")


def two_bodies() -> None:
    """That touch without common nodes."""
    set_size(0.5)
    gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
    gmsh.model.occ.addBox(0, 0, 1, 1, 1, 2)
    gmsh.model.occ.synchronize()
    group(3, [1], 1, "lower")
    group(3, [2], 2, "upper")
    group(2, [6], 3, "lower top")
    group(2, [11], 4, "upper bottom")


def overlapping_groups() -> None:
    set_size(0.5)
    gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
    gmsh.model.occ.addBox(2, 0, 0, 1, 1, 3)
    gmsh.model.occ.synchronize()
    group(3, [1], 1, "small")
    group(3, [1, 2], 2, "all")
    group(2, [5, 6], 7, "ends")
    group(2, [5], 8, "bottom")
    gmsh.model.addPhysicalGroup(2, [1], 9)


def shared_face() -> None:
    """Two regions that share the faces between them."""
    set_size(0.5)
    gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
    gmsh.model.occ.addBox(0, 0, 1, 1, 1, 1)
    gmsh.model.occ.fragment([(3, 1)], [(3, 2)])
    gmsh.model.occ.synchronize()
    group(3, [1], 1, "lower")
    group(3, [2], 2, "upper")
    surfaces = [s for _, s in gmsh.model.getEntities(2)]
    group(2, [s for s in surfaces
              if len(gmsh.model.getAdjacencies(2, s)[0]) == 2], 1, "interface")
    group(2, surfaces, 2, "all")


def parametric() -> None:
    box("tetrahedra")
    gmsh.option.setNumber("Mesh.SaveParametric", 1.0)


def partitioned() -> None:
    parametric()
    gmsh.model.mesh.generate(3)
    gmsh.option.setNumber("Mesh.PartitionCreateGhostCells", 1.0)
    gmsh.model.mesh.partition(3)


def square() -> None:
    gmsh.model.occ.addRectangle(0, 0, 0, 1, 1)
    gmsh.model.occ.synchronize()
    group(2, [1], 1, "square")


def hollow_ball() -> None:
    """Of which only the surface is saved."""
    ball(1.0)
    gmsh.model.removePhysicalGroups([(3, 4)])


def ball_without_groups() -> None:
    ball(1.0)
    gmsh.model.removePhysicalGroups()
    gmsh.option.setNumber("Mesh.SaveAll", 1.0)


def ball_and_plate() -> None:
    ball(1.0)
    plate = gmsh.model.occ.addRectangle(5, 5, 5, 1, 1)
    gmsh.model.occ.synchronize()
    group(2, [plate], 9, "plate")


def file_name(model: str, version: float, binary: bool, order: int,
              serendipity: bool) -> str:
    return (f"{model}.v{version}.{'binary' if binary else 'text'}"
            f".order{order}{'.serendipity' if serendipity else ''}")


def save_points(path: pathlib.Path) -> None:
    """Of the elements of the file, as gmsh reads it."""
    gmsh.clear()
    gmsh.open(str(path))
    lines = []
    for numbers in gmsh.model.mesh.getElements(3)[1]:
        for number in numbers:
            _, _, points = gmsh.model.mesh.getJacobian(number, LOCAL_POINTS)
            lines += [f"{number} " + " ".join(f"{x:.17g}" for x in
                                              points[i:i + 3])
                      for i in range(0, len(points), 3)]
    path.with_suffix(".points").write_text("\n".join(lines) + "\n")


def append_views(path: pathlib.Path) -> None:
    """Of the elements: "around", which is e_z x x at their centers, and their
    numbers."""
    numbers: list[int] = []
    around: list[list[float]] = []
    for kind, tags in zip(*gmsh.model.mesh.getElements(3)[:2]):
        centers = gmsh.model.mesh.getBarycenters(kind, -1, False, True)
        numbers += [int(tag) for tag in tags]
        around += [[-y, x, 0.0] for x, y in zip(centers[::3], centers[1::3])]
    gmsh.option.setNumber("PostProcessing.SaveMesh", 0)
    for name, data in (("around", around),
                       ("number", [[number] for number in numbers])):
        view = gmsh.view.add(name)
        gmsh.view.addModelData(view, 0, gmsh.model.getCurrent(),
                               "ElementData", numbers, data,
                               numComponents=len(data[0]))
        gmsh.view.write(view, str(path), append=True)


def save(directory: pathlib.Path, model: str, build: Callable[[], None],
         version: float = 4.1, binary: bool = False, order: int = 1,
         serendipity: bool = False, points: bool = False,
         views: bool = False) -> None:
    gmsh.initialize(["gmsh"], False)
    gmsh.option.setNumber("General.Terminal", 0)
    # It complains of what it lacks for cubic prisms, which is not needed.
    gmsh.option.setNumber("General.AbortOnError", 0)
    gmsh.option.setNumber("Mesh.MshFileVersion", version)
    gmsh.option.setNumber("Mesh.Binary", binary)
    gmsh.option.setNumber("Mesh.SecondOrderIncomplete", serendipity)
    build()
    if not gmsh.model.mesh.getElementTypes(3).size:
        gmsh.model.mesh.generate(3)
    if order > 1:
        gmsh.model.mesh.setOrder(order)
    path = directory / (file_name(model, version, binary, order, serendipity)
                        + ".msh")
    # Tests that run at the same time see all of a mesh or the one before.
    fresh = path.with_suffix(f".{os.getpid()}.msh")
    gmsh.write(str(fresh))
    if views:
        append_views(fresh)
    fresh.replace(path)
    if points:
        save_points(path)
    gmsh.finalize()


def save_all(directory: pathlib.Path) -> None:
    formats = [{"version": version, "binary": binary}
               for version, binary in itertools.product((2.2, 4.1),
                                                        (False, True))]
    for cells in CELLS:
        for kind, order in itertools.product(formats, (1, 2, 3)):
            save(directory, f"box_{cells}", lambda: box(cells), order=order,
                 **kind)
        for size, orders in ((0.4, (1, 2)), (0.7, (2,)), (0.8, (2,)),
                             (0.9, (1, 2, 3))):
            for order in orders:
                save(directory, f"cylinder_{cells}_{size}",
                     lambda: cylinder(cells, size), order=order,
                     points=size == 0.9)
        save(directory, f"cylinder_{cells}_0.9", lambda: cylinder(cells, 0.9),
             order=2, serendipity=True, points=True)
    save(directory, "cylinder_hexahedra_0.9", lambda: cylinder(CELLS[1], 0.9),
         order=3, serendipity=True)
    for order in (2, 3):
        save(directory, "ball_0.5", lambda: ball(0.5), order=order)
    save(directory, "ball_1", lambda: ball(1.0), order=4, points=True)
    for order, serendipity in itertools.product((1, 2), (False, True)):
        save(directory, "pyramids", pyramids, order=order,
             serendipity=serendipity, points=True)
    for kind in formats:
        save(directory, "overlapping_groups", overlapping_groups, **kind)
        for cells in CELLS:
            save(directory, f"cylinder_{cells}_views",
                 lambda: cylinder(cells, 0.5), views=True, **kind)
    for build in (parametric, partitioned):
        for binary in (False, True):
            save(directory, build.__name__, build, binary=binary)
    for build in (two_bodies, shared_face, square, hollow_ball,
                  ball_without_groups, ball_and_plate):
        save(directory, build.__name__, build)


def main() -> None:
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        print(__doc__)
        sys.exit(0 if sys.argv[1:] in (["-h"], ["--help"]) else 2)
    directory = pathlib.Path(sys.argv[1])
    directory.mkdir(parents=True, exist_ok=True)
    save_all(directory)


if __name__ == "__main__":
    main()
