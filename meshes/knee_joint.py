"""The bodies of a knee, meshed and fitted together, from its anatomy.

Whatever the anatomy comes from, an image or a few dimensions, these are the
names, and these rules hold: the femur touches the menisci and not the tibial
cartilage; the menisci rest on the tibial cartilage; nothing penetrates; every
outer face has one name. knee_checks.py measures them. Lengths are in mm; x is
to the right, y to the front, z up.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

import mesh_script
import meniscus_wedge
import rim_taper
import surface_gap
from cartilage_layer import Layer
from cartilage_outline import FemoralOutline, femoral_plane, star_plane
from circle_fit import circle
from gmsh_bodies import Body
from hexahedral_sweep import quads_of, sweep
from meniscus_wedge import Cover, Fitted, InnerFace, Meniscus
from quad_plane import QuadMesh

FEMUR = "femoral_cartilage"
SIDES = ("medial", "lateral")
TIBIA = {side: f"tibial_cartilage_{side}" for side in SIDES}
MENISCUS = {side: f"meniscus_{side}" for side in SIDES}

REGIONS = {name: tag for tag, name in enumerate(
    [FEMUR, *TIBIA.values(), *MENISCUS.values()], 1)}
SURFACES = {name: tag for tag, name in enumerate(
    [f"{body}_{side}" for body in (FEMUR, *TIBIA.values())
     for side in ("bone", "contact", "rim")]
    + [f"{body}_{side}" for body in MENISCUS.values()
       for side in ("superior", "inferior", "periphery", "inner",
                    "horn_anterior", "horn_posterior")], 1)}

# Edge lengths (mm) and layers at --size 1, which makes 35,000 hexahedra or so
# of a knee of average size.
FEMORAL_SIZE, TIBIAL_SIZE, MENISCAL_SIZE = 1.0, 0.8, 0.7
CARTILAGE_LAYERS, MENISCAL_LAYERS = 3, 6

# The gap between a meniscus and its neighbors where they touch (mm).
TOUCH = 1e-3
# How far beyond its image a meniscus may go on to become thin (mm).
REACH = 1.5


@dataclass
class Anatomy:
    femur: Layer
    femoral_outline: FemoralOutline
    tibia: dict[str, Layer]
    tibial_outline: dict[str, np.ndarray]   # n x 2, counter-clockwise
    menisci: dict[str, Meniscus]


@dataclass
class Knee:
    bodies: dict[str, Body]
    lift: float                     # of the femur (mm)
    frames: dict[str, np.ndarray]   # origins, by side (mm)


def add_options(parser: argparse.ArgumentParser, output: str) -> None:
    parser.add_argument("-o", "--output", default=output)
    parser.add_argument("--size", type=mesh_script.positive, default=1.0,
                        help="factor on all element sizes")
    parser.add_argument("--clearance", type=mesh_script.positive, default=0.15,
                        help="least gap between femoral and tibial cartilage "
                             "(mm, default %(default)s)")
    parser.add_argument("--inner-edge", type=mesh_script.positive, default=0.5,
                        help="thickness of the menisci at their inner edge "
                             "(mm, default %(default)s)")
    parser.add_argument("--inner-face", default="upright",
                        choices=meniscus_wedge.INNER_FACES,
                        help="of the menisci: upright, or normal to both of "
                             "their surfaces, with smaller elements beside it, "
                             "or such a one with a rounded edge in front of "
                             "it, of hexahedra or a fan of prisms, for finite "
                             "deformation (default %(default)s)")
    parser.add_argument("--rim-taper", type=mesh_script.not_negative,
                        default=0.0,
                        help="width along the rim of the tibial cartilages "
                             "where they thin out (mm, default %(default)s: "
                             "their side is as high as they are thick)")
    mesh_script.add_geometry_order(parser)
    parser.add_argument("--verbose", action="store_true")


def build(anatomy: Anatomy, args: argparse.Namespace) -> Knee:
    """Meshes the bodies; raises ValueError where they are not in their places.
    """
    size, order = args.size, args.geometry_order
    layers = order * max(2, round(CARTILAGE_LAYERS / size))
    bodies = {}

    femoral = femoral_plane(anatomy.femoral_outline, FEMORAL_SIZE * size,
                            order)
    femoral_columns = anatomy.femur.columns(*femoral.points.T, layers)

    def femur() -> Body:
        return sweep(femoral.turned_over(), femoral_columns, "bone",
                     "contact", FEMUR)

    tibial = {}
    clearances = []
    for side, name in TIBIA.items():
        tibial[side] = star_plane(anatomy.tibial_outline[side],
                                  TIBIAL_SIZE * size, order)
        points = tibial[side].points
        columns = anatomy.tibia[side].columns(*points.T, layers)
        if args.rim_taper > 0:
            columns = rim_taper.taper(
                columns,
                rim_taper.distances(points, anatomy.tibial_outline[side]),
                args.rim_taper)
        bodies[name] = sweep(tibial[side], columns, "bone", "contact", name)
        gaps = surface_gap.vertical_gaps(
            quads_of(bodies[name], f"{name}_contact"),
            quads_of(femur(), f"{FEMUR}_contact"))
        if not len(gaps):
            raise ValueError(f"{name} is not below the femoral cartilage")
        clearances.append(gaps.min())
    lift = args.clearance - min(clearances)
    femoral_columns[:, :, 2] += lift
    bodies[FEMUR] = femur()

    roof = Cover(anatomy.femur, femoral, True)
    face = meniscus_wedge.INNER_FACES[args.inner_face]
    frames = {}
    for side, name in MENISCUS.items():
        body = anatomy.menisci[side]
        fitted = Fitted(body, Cover(anatomy.tibia[side], tibial[side], False),
                        roof, lift, REACH)
        mesh = meniscus_wedge.plane(fitted, args.inner_edge, face,
                                    MENISCAL_SIZE * size, order)
        columns = meniscus_wedge.columns(
            fitted, mesh, face,
            order * max(3, round(MENISCAL_LAYERS / size)))
        bodies[name] = settle(
            columns, name, lambda: meniscus_body(mesh, columns, name, face),
            quads_of(bodies[TIBIA[side]], f"{TIBIA[side]}_contact"),
            quads_of(bodies[FEMUR], f"{FEMUR}_contact"))
        frames[side] = origin(bodies[name], side, body)
    return Knee({name: bodies[name] for name in REGIONS}, lift, frames)


def meniscus_body(mesh: QuadMesh, columns: np.ndarray, name: str,
                  face: InnerFace) -> Body:
    wedge = sweep(mesh, columns, "inferior", "superior", name)
    if not face.tip:
        return wedge
    return face.tip(wedge, meniscus_wedge.rows(mesh, columns), mesh.order,
                    name)


def settle(columns: np.ndarray, name: str, body: Callable[[], Body],
           tibia: np.ndarray, femur: np.ndarray) -> Body:
    """The meniscus of these columns, its two sides moved along z until they
    touch."""
    share = np.linspace(0, 1, columns.shape[1])
    below = surface_gap.vertical_gaps(
        tibia, quads_of(body(), f"{name}_inferior"))
    above = surface_gap.vertical_gaps(
        quads_of(body(), f"{name}_superior"), femur)
    if not len(below) or not len(above):
        raise ValueError(f"{name} is not between femoral and tibial cartilage")
    columns[:, :, 2] += (1 - share) * (TOUCH - below.min()) \
        + share * (above.min() - TOUCH)
    return body()


def origin(body: Body, side: str, meniscus: Meniscus) -> np.ndarray:
    """Where the axis of the circumferential fibers is.

    Medial: midway between the horns. Lateral: the middle of the meniscus, the
    center of the circle that fits it.
    """
    horns = [quads_of(body, f"{MENISCUS[side]}_horn_{end}")[:, :4]
             .mean(axis=(0, 1)) for end in ("anterior", "posterior")]
    if side == "medial":
        return 0.5 * (horns[0] + horns[1])
    center, _ = circle(meniscus.place(0.5 * (meniscus.inner
                                             + meniscus.outer)))
    return np.array([*center, body.points[:, 2].mean()])


def frame_lines(knee: Knee) -> list[str]:
    """Lines of TOML: the cylindrical frames of the menisci."""
    lines = []
    for side in SIDES:
        place = ", ".join(f"{c + 0.0:.4f}" for c in
                          np.round(knee.frames[side], 4))
        lines += [f"[{MENISCUS[side]}]",
                  f'frame = {{type = "cylindrical", origin = [{place}], '
                  "axis = [0, 0, 1]}"]
    return lines
