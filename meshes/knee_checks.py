"""Measures whether a knee's mesh keeps its rules, and says how well."""

from __future__ import annotations

import numpy as np

import surface_gap
from gmsh_bodies import Body
from hexahedral_sweep import (
    hexahedra_of, prisms_of, quads_of, scaled_jacobian)
from knee_joint import FEMUR, MENISCUS, SIDES, TIBIA, Knee
from lagrange_element import middle

MIN_SCALED_JACOBIAN = 0.2


def check_quality(bodies: dict[str, Body]) -> None:
    elements = [(name, of(body)) for name, body in bodies.items()
                for of in (hexahedra_of, prisms_of)]
    for name, x in elements:
        quality = scaled_jacobian(x)
        if quality.min(initial=1.0) < MIN_SCALED_JACOBIAN:
            x = x[np.argmin(quality)]
            place = ", ".join(f"{c:.1f}" for c in x.mean(axis=0))
            raise ValueError(
                f"an element of {name} at ({place}) has a scaled Jacobian of "
                f"{quality.min():.2f}, less than {MIN_SCALED_JACOBIAN}: choose "
                "another --size, or smoother surfaces")


def check(knee: Knee) -> list[str]:
    """Lines of a report; raises ValueError where a rule is broken."""
    bodies = knee.bodies
    check_quality(bodies)
    quads = {surface: quads_of(body, surface)
             for body in bodies.values() for surface in body.surfaces}
    report = [f"femur lifted by {knee.lift:.3f} mm", *_gaps(quads)]
    _check_apart(bodies)
    report.append("no node or middle of an outer face is inside another body")
    for surface in quads:
        if surface.endswith(("contact", "superior", "inferior")):
            turns = surface_gap.normal_turns(quads[surface])
            half, most = np.percentile(turns, (50, 99))
            report.append(f"normals of neighboring faces, {surface}: median "
                          f"{half:.1f}, 99 % below {most:.1f}, max "
                          f"{turns.max():.1f} degrees")
    return report


def _gaps(quads: dict[str, np.ndarray]) -> list[str]:
    """Gaps along z of all pairs that may touch."""
    pairs = []
    for side in SIDES:
        pairs += [(TIBIA[side] + "_contact", FEMUR + "_contact"),
                  (TIBIA[side] + "_contact", MENISCUS[side] + "_inferior"),
                  (MENISCUS[side] + "_superior", FEMUR + "_contact")]
    report = []
    for lower, upper in pairs:
        gaps = surface_gap.vertical_gaps(quads[lower], quads[upper])
        tenth, half = np.percentile(gaps, (10, 50))
        report.append(f"gap {lower} - {upper}: min {gaps.min():.4f} mm, "
                      f"10 % below {tenth:.3f}, 50 % below {half:.3f}")
        if gaps.min() < 0:
            raise ValueError(f"{lower} and {upper} overlap by "
                             f"{-gaps.min():.4f} mm")
    return report


def _check_apart(bodies: dict[str, Body]) -> None:
    """No node or middle of an outer face is inside another body."""
    for name, body in bodies.items():
        faces = np.concatenate([quads_of(body, s) for s in body.surfaces])
        points = np.concatenate([np.unique(faces.reshape(-1, 3), axis=0),
                                 middle(faces)])
        for other, hexahedra in bodies.items():
            if other == name:
                continue
            inside = surface_gap.points_inside(points, hexahedra_of(hexahedra))
            if inside.any():
                place = ", ".join(f"{c:.1f}" for c in points[inside][0])
                raise ValueError(f"{name} and {other} overlap at "
                                 f"{inside.sum()} points, such as ({place})")
