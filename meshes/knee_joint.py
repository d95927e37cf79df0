"""The bodies of a knee, meshed and fitted together, from its anatomy.

Whatever the anatomy comes from, an image or a few dimensions, these are the
names, and these rules hold: the femur touches the menisci and not the tibial
cartilage; the menisci rest on the tibial cartilage; nothing penetrates; every
outer face has one name; no element is worse than MIN_SCALED_JACOBIAN. Lengths
are in mm; x is to the right, y to the front, z up.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass, field

import numpy as np

import hexahedral_sweep
import mesh_script
import meniscus_wedge
import surface_gap
from cartilage_layer import Layer
from cartilage_outline import FemoralOutline, femoral_plane, star_plane
from gmsh_bodies import Body
from meniscus_wedge import Cover, Fitted, Meniscus

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

MIN_SCALED_JACOBIAN = 0.2

# Edge lengths (mm) and layers at --size 1, which makes 36,000 hexahedra of a
# knee of average size.
FEMORAL_SIZE, TIBIAL_SIZE, MENISCAL_SIZE = 1.0, 0.8, 0.7
CARTILAGE_LAYERS, MENISCAL_LAYERS = 3, 6

# The gap between a meniscus and its neighbours where they touch (mm).
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
    lift: float                  # of the femur (mm)
    frames: dict[str, np.ndarray]   # origins of the menisci
    report: list[str] = field(default_factory=list)


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
    parser.add_argument("--verbose", action="store_true")


def _quads(body: Body, surface: str) -> np.ndarray:
    return hexahedral_sweep.quads_of(body, surface)


def build(anatomy: Anatomy, args: argparse.Namespace) -> Knee:
    """Meshes the bodies; raises ValueError where a rule can't be kept."""
    size = args.size
    layers = max(2, round(CARTILAGE_LAYERS / size))
    bodies = {}

    femoral = femoral_plane(anatomy.femoral_outline, FEMORAL_SIZE * size)
    femoral_columns = anatomy.femur.columns(*femoral.points.T, layers)

    def femur() -> Body:
        return hexahedral_sweep.sweep(femoral.turned_over(), femoral_columns,
                                      "bone", "contact", FEMUR)

    tibial = {}
    clearances = []
    for side, name in TIBIA.items():
        tibial[side] = star_plane(anatomy.tibial_outline[side],
                                  TIBIAL_SIZE * size)
        bodies[name] = hexahedral_sweep.sweep(
            tibial[side], anatomy.tibia[side].columns(*tibial[side].points.T,
                                                      layers),
            "bone", "contact", name)
        gaps = surface_gap.vertical_gaps(
            _quads(bodies[name], f"{name}_contact"),
            _quads(femur(), f"{FEMUR}_contact"))
        if not len(gaps):
            raise ValueError(f"{name} is not below the femoral cartilage")
        clearances.append(gaps.min())
    lift = args.clearance - min(clearances)
    femoral_columns[:, :, 2] += lift
    bodies[FEMUR] = femur()

    roof = Cover(anatomy.femur, femoral, True)
    frames = {}
    for side, name in MENISCUS.items():
        body = anatomy.menisci[side]
        fitted = Fitted(body, Cover(anatomy.tibia[side], tibial[side], False),
                        roof, lift, REACH)
        mesh = meniscus_wedge.plane(fitted, args.inner_edge,
                                    MENISCAL_SIZE * size)
        columns = meniscus_wedge.columns(
            fitted, mesh, max(3, round(MENISCAL_LAYERS / size)))
        bodies[name] = settle(columns, mesh, name,
                              _quads(bodies[TIBIA[side]],
                                       f"{TIBIA[side]}_contact"),
                              _quads(bodies[FEMUR], f"{FEMUR}_contact"))
        frames[side] = origin(bodies[name], side, body)
    bodies = {name: bodies[name] for name in REGIONS}
    knee = Knee(bodies, lift, frames)
    check(knee)
    return knee


def settle(columns: np.ndarray, mesh, name: str, tibia: np.ndarray,
           femur: np.ndarray) -> Body:
    """The meniscus, its two sides moved along z until they touch."""
    def body() -> Body:
        return hexahedral_sweep.sweep(mesh, columns, "inferior", "superior",
                                      name)

    share = np.linspace(0, 1, columns.shape[1])
    below = surface_gap.vertical_gaps(
        tibia, _quads(body(), f"{name}_inferior"))
    above = surface_gap.vertical_gaps(
        _quads(body(), f"{name}_superior"), femur)
    if not len(below) or not len(above):
        raise ValueError(f"{name} is not between femoral and tibial cartilage")
    columns[:, :, 2] += (1 - share) * (TOUCH - below.min()) \
        + share * (above.min() - TOUCH)
    return body()


def origin(body: Body, side: str, meniscus: Meniscus) -> np.ndarray:
    """Where the axis of the circumferential fibres is.

    Medial: midway between the horns. Lateral: the middle of the meniscus, the
    centre of the circle that fits its outline.
    """
    horns = [_quads(body, f"{MENISCUS[side]}_horn_{end}").mean(axis=(0, 1))
             for end in ("anterior", "posterior")]
    if side == "medial":
        return 0.5 * (horns[0] + horns[1])
    rim = meniscus.place(0.5 * (meniscus.inner + meniscus.outer))
    a = np.column_stack([2 * rim, np.ones(len(rim))])
    centre = np.linalg.lstsq(a, (rim**2).sum(axis=1), rcond=None)[0][:2]
    return np.array([*centre, body.points[:, 2].mean()])


def check_quality(bodies: dict[str, Body]) -> None:
    for name, body in bodies.items():
        quality = hexahedral_sweep.scaled_jacobian(body)
        if quality.min() < MIN_SCALED_JACOBIAN:
            x = hexahedral_sweep.corners_of(body)[np.argmin(quality)]
            place = ", ".join(f"{c:.1f}" for c in x.mean(axis=0))
            raise ValueError(
                f"an element of {name} at ({place}) has a scaled Jacobian of "
                f"{quality.min():.2f}, less than {MIN_SCALED_JACOBIAN}: choose "
                "another --size, or smoother surfaces")


def check(knee: Knee) -> None:
    """Measures that the rules are kept; raises ValueError otherwise."""
    bodies, report = knee.bodies, knee.report
    check_quality(bodies)
    report.append(f"femur lifted by {knee.lift:.3f} mm")
    pairs = []
    for side in SIDES:
        pairs += [(TIBIA[side] + "_contact", FEMUR + "_contact"),
                  (TIBIA[side] + "_contact", MENISCUS[side] + "_inferior"),
                  (MENISCUS[side] + "_superior", FEMUR + "_contact")]
    quads = {surface: hexahedral_sweep.quads_of(body, surface)
             for body in bodies.values() for surface in body.surfaces}
    for lower, upper in pairs:
        gaps = surface_gap.vertical_gaps(quads[lower], quads[upper])
        near = np.percentile(gaps, (10, 50))
        report.append(f"gap {lower} - {upper}: min {gaps.min():.4f} mm, "
                      f"10 % below {near[0]:.3f}, 50 % below {near[1]:.3f}")
        if gaps.min() < 0:
            raise ValueError(f"{lower} and {upper} overlap by "
                             f"{-gaps.min():.4f} mm")
    for a, body in bodies.items():
        for b, other in bodies.items():
            if a == b:
                continue
            faces = np.concatenate([quads[s] for s in body.surfaces])
            points = np.concatenate([np.unique(faces.reshape(-1, 3), axis=0),
                                     faces.mean(axis=1)])
            inside = surface_gap.points_inside(
                points, hexahedral_sweep.corners_of(other))
            if inside.any():
                place = ", ".join(f"{c:.1f}" for c in points[inside][0])
                raise ValueError(f"{a} and {b} overlap: {inside.sum()} points, "
                                 f"one of them ({place})")
    report.append("no surface point of a body is inside another one")
    for surface in quads:
        if surface.endswith(("contact", "superior", "inferior")):
            turns = surface_gap.normal_turns(quads[surface])
            p50, p99 = np.percentile(turns, (50, 99))
            report.append(f"normals of neighbouring faces, {surface}: median "
                          f"{p50:.1f}, 99 % below {p99:.1f}, max "
                          f"{turns.max():.1f} degrees")


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
