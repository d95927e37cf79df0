"""How the bodies of a knee are looked at: a right one, x lateral, y front."""

from __future__ import annotations

import pyvista as pv

import solid_view
from solid_view import Extent, Picture, View

COLORS = {"femoral_cartilage": "#e6cba6", "tibial_cartilage": "#86b4cf",
           "meniscus": "#b5473a"}

POSTERIOR = View(towards=(0, -1, 0), up=(0, 0, 1))
FROM_BEHIND_AND_ABOVE = View(towards=(0, -1, 0.12), up=(0, 0, 1))
SUPERIOR = View(towards=(0, 0, 1), up=(0, 1, 0))
INFERIOR = View(towards=(0, 0, -1), up=(0, 1, 0))

Bodies = dict[str, pv.DataSet]


def mesh(bodies: Bodies, view: View, width: int,
         extent: Extent | None = None) -> Picture:
    """The elements of the bodies, in the colors of their tissues."""
    solids = []
    for name, body in bodies.items():
        # Also curved elements are drawn as one face each, within its edges.
        faces = body.extract_surface(nonlinear_subdivision=0)
        solids.append((faces, {
            "color": color_of(name), "show_edges": True, "line_width": 1,
            "edge_color": "#303030", "ambient": 0.25, "diffuse": 0.75,
            "specular": 0.1}))
    return solid_view.draw(solids, view, width, extent)


def color_of(body: str) -> str:
    return next(color for tissue, color in COLORS.items()
                if body.startswith(tissue))


def without_femur(bodies: Bodies) -> Bodies:
    return {name: body for name, body in bodies.items()
            if not name.startswith("femoral")}


def menisci(bodies: Bodies) -> list[pv.DataSet]:
    return [body for name, body in bodies.items()
            if name.startswith("meniscus")]


def front_half(bodies: Bodies) -> Bodies:
    """Cut in the frontal plane through the middle of the menisci."""
    front = {name: body.clip("-y", origin=(0, middle_y(bodies), 0))
             for name, body in bodies.items()}
    return {name: body for name, body in front.items() if body.n_cells}


def middle_y(bodies: Bodies) -> float:
    """Of the menisci, halfway between their front and their back."""
    centers = [body.center[1] for body in menisci(bodies)]
    return sum(centers) / len(centers)
