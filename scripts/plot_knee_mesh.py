#!/usr/bin/env python3
"""Pictures of a knee's mesh, from meshes/knee_*.py.

Reads MESH, a gmsh file with the names which those scripts give, and draws

  posterior      all bodies, seen from behind
  superior       menisci and tibial cartilages, seen from above, front up
  section        all bodies, cut in the frontal plane through the middle of the
                 menisci, seen from behind

side by side into one picture.

Sample run:
  scripts/run_python scripts/plot_knee_mesh.py knee.msh -o knee.png
"""

from __future__ import annotations

import argparse
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "lib"))

import missing_module  # noqa: E402,F401

import gmsh  # noqa: E402
import matplotlib.image  # noqa: E402
import numpy as np  # noqa: E402

import knee_views  # noqa: E402
from solid_view import pv  # noqa: E402

WIDTH = 1500    # pixels of each view
MARGIN = 15     # around it


# Nodes of gmsh's hexahedra, by their type; the corners come first.
HEXAHEDRA = {5: 8, 12: 27}


def read(file: str) -> dict[str, pv.UnstructuredGrid]:
    """Hexahedra, with straight edges, by the name of their region."""
    gmsh.initialize([""])
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.open(file)
        tags, x, _ = gmsh.model.mesh.getNodes()
        points = np.zeros((int(max(tags)) + 1, 3))
        points[np.asarray(tags, dtype=int)] = np.reshape(x, (-1, 3))
        bodies = {}
        for dim, group in gmsh.model.getPhysicalGroups(3):
            cells = np.concatenate([
                np.reshape(gmsh.model.mesh.getElementsByType(kind, entity)[1],
                           (-1, nodes))[:, :8]
                for entity in gmsh.model.getEntitiesForPhysicalGroup(dim, group)
                for kind, nodes in HEXAHEDRA.items()]).astype(int)
            bodies[gmsh.model.getPhysicalName(dim, group)] = \
                pv.UnstructuredGrid({pv.CellType.HEXAHEDRON: cells}, points)
    finally:
        gmsh.finalize()
    known = {name: grid.clean() for name, grid in bodies.items()
             if name.startswith(tuple(knee_views.COLORS)) and grid.n_cells}
    if not any(name.startswith("meniscus") for name in known):
        raise ValueError(f"'{file}' has no hexahedra of a meniscus")
    return known


def side_by_side(pictures: list[np.ndarray]) -> np.ndarray:
    """With white between them; the lower ones are in the middle."""
    height = max(len(picture) for picture in pictures) + 2 * MARGIN
    parts = []
    for picture in pictures:
        part = np.full((height, picture.shape[1] + 2 * MARGIN, 3), 255,
                       dtype=picture.dtype)
        top = (height - len(picture)) // 2
        part[top:top + len(picture), MARGIN:-MARGIN] = picture
        parts.append(part)
    return np.concatenate(parts, axis=1)


def views(bodies: dict[str, pv.UnstructuredGrid]) -> list[np.ndarray]:
    return [knee_views.mesh(shown, view, WIDTH).pixels for shown, view in (
        (bodies, knee_views.FROM_BEHIND_AND_ABOVE),
        (knee_views.without_femur(bodies), knee_views.SUPERIOR),
        (knee_views.front_half(bodies), knee_views.POSTERIOR))]


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh")
    parser.add_argument("-o", "--output", default="knee.png")
    args = parser.parse_args(argv)
    if not pathlib.Path(args.mesh).is_file():
        parser.error(f"there is no file '{args.mesh}'")
    try:
        picture = side_by_side(views(read(args.mesh)))
    except Exception as error:   # gmsh raises bare Exception
        print(f"plot_knee_mesh.py: error: {error}", file=sys.stderr)
        return 1
    matplotlib.image.imsave(args.output, picture)
    print(f"wrote {args.output}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
