#!/usr/bin/env python3
"""Pictures of a knee's mesh, from meshes/knee_*.py.

Reads MESH, a gmsh file with the names which those scripts give, and draws

  posterior      all bodies, seen from behind
  superior       menisci and tibial cartilages, seen from above, front up
  section        all bodies, cut in the frontal plane through the middle of the
                 menisci, seen from behind

side by side into one picture.

Sample run:
  python3 scripts/plot_knee_mesh.py knee.msh -o knee.png
"""

from __future__ import annotations

import argparse
import os
import pathlib
import sys

import gmsh
import matplotlib.image
import numpy as np

# Draw without a screen, and without VTK's complaint that there is none.
if not os.environ.get("DISPLAY"):
    os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")
import pyvista as pv  # noqa: E402

COLOURS = {"femoral_cartilage": "#e6cba6", "tibial_cartilage": "#86b4cf",
           "meniscus": "#b5473a"}
WIDTH = 1600    # pixels of each view before its white margins are cut off
MARGIN = 30     # that stay


def read(file: str) -> dict[str, pv.UnstructuredGrid]:
    """Hexahedra by the name of their region."""
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
                gmsh.model.mesh.getElementsByType(5, entity)[1] for entity in
                gmsh.model.getEntitiesForPhysicalGroup(dim, group)])
            cells = cells.reshape(-1, 8).astype(int)
            bodies[gmsh.model.getPhysicalName(dim, group)] = \
                pv.UnstructuredGrid({pv.CellType.HEXAHEDRON: cells}, points)
    finally:
        gmsh.finalize()
    known = {name: grid.clean() for name, grid in bodies.items()
             if name.startswith(tuple(COLOURS)) and grid.n_cells}
    if not any(name.startswith("meniscus") for name in known):
        raise ValueError(f"'{file}' has no hexahedra of a meniscus")
    return known


def draw(bodies: dict[str, pv.DataSet], towards: tuple, up: tuple
         ) -> np.ndarray:
    """A picture of the bodies from a direction."""
    plotter = pv.Plotter(off_screen=True, window_size=(WIDTH, WIDTH))
    plotter.background_color = "white"
    for name, body in bodies.items():
        colour = next(c for kind, c in COLOURS.items() if name.startswith(kind))
        plotter.add_mesh(body, color=colour, show_edges=True, line_width=1,
                         edge_color="#303030", ambient=0.25, diffuse=0.8,
                         specular=0.1)
    plotter.enable_parallel_projection()
    plotter.enable_anti_aliasing("ssaa")
    plotter.view_vector(towards, up)
    picture = plotter.screenshot(return_img=True)
    plotter.close()
    drawn = (picture < 250).any(axis=2)
    rows, columns = (np.flatnonzero(drawn.any(axis=axis)) for axis in (1, 0))
    return picture[rows[0]:rows[-1] + 1, columns[0]:columns[-1] + 1]


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
    lower = {name: body for name, body in bodies.items()
             if not name.startswith("femoral")}
    menisci = [body for name, body in bodies.items()
               if name.startswith("meniscus")]
    middle = np.mean([body.center for body in menisci], axis=0)
    front = {name: body.clip("-y", origin=middle)
             for name, body in bodies.items()}
    front = {name: body for name, body in front.items() if body.n_cells}
    behind, above = (0, -1, 0.12), (0, 0, 1)
    return [draw(bodies, behind, above), draw(lower, above, (0, 1, 0)),
            draw(front, (0, -1, 0), above)]


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
