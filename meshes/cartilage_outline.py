"""Outlines of cartilage in its chart, and quadrangles that fill them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from quad_plane import QuadMesh, disc, join, patch, relax, resample


def star_plane(outline: np.ndarray, size: float, order: int = 1) -> QuadMesh:
    """Fills a closed curve which the middle of its box sees all of.

    The outline is n x 2, counter-clockwise, its edges will be called rim; size
    is the length of the edges (mm).
    """
    low, high = outline.min(axis=0), outline.max(axis=0)
    center, half = 0.5 * (low + high), 0.5 * (high - low)
    scaled = (outline - center) / half
    angle = np.arctan2(scaled[:, 1], scaled[:, 0])
    turn = np.argsort(angle)
    across = 2 * float(np.sqrt(half[0] * half[1])) / size
    core = max(3, round(0.53 * across))
    rings = max(2, round(0.2 * across))
    mesh = disc(core, rings, order)
    points = mesh.points
    radius = np.interp(np.arctan2(points[:, 1], points[:, 0]), angle[turn],
                       np.hypot(*scaled[turn].T), period=2 * np.pi)
    mesh.points = center + half * points * radius[:, None]
    return relax(mesh, 10)


@dataclass
class FemoralOutline:
    """Two arms (condyles) that join in front (trochlea), in (u, v).

    sides are the left arm's outer and inner side and the right arm's inner and
    outer one, as u at each of v. The arms begin at v = ends[0] and ends[1] and
    reach to the shoulder, where the notch's curve runs from the left arm's
    inner side to the right one's; the joint part reaches to the front.
    """

    v: np.ndarray
    sides: list[np.ndarray]
    ends: tuple[float, float]
    shoulder: float
    notch: np.ndarray   # n x 2
    front: float

    def curve(self, side: int, begin: float, end: float) -> np.ndarray:
        v = np.linspace(begin, end, 200)
        return np.column_stack([np.interp(v, self.v, self.sides[side]), v])


def femoral_plane(outline: FemoralOutline, size: float, order: int = 1
                  ) -> QuadMesh:
    """Fills the outline with edges of about this length, named rim."""
    def count(length: float) -> int:
        return order * max(2, round(length / size))

    shoulder, front = outline.shoulder, outline.front
    notch = outline.notch
    corners = [outline.curve(side, shoulder, front)[0] for side in range(4)]
    across = [count(corners[1][0] - corners[0][0]),
              count(1.15 * (notch[-1, 0] - notch[0, 0])),
              count(corners[3][0] - corners[2][0])]
    lines = [np.linspace(corners[0], notch[0], across[0] + 1),
             resample(notch, across[1]),
             np.linspace(notch[-1], corners[3], across[2] + 1)]
    patches = []
    for arm, (west, east) in enumerate(((0, 1), (2, 3))):
        end = outline.ends[arm]
        curves = [outline.curve(side, end, shoulder) for side in (west, east)]
        curves[1 - arm][-1] = notch[0 if arm == 0 else -1]
        up = count(shoulder - end)
        west_line, east_line = (resample(curve, up) for curve in curves)
        patches.append(patch(
            np.linspace(west_line[0], east_line[0], across[2 * arm] + 1),
            lines[2 * arm], west_line, east_line))
    sides = [outline.curve(side, shoulder, front) for side in (0, 3)]
    up = count(front - shoulder)
    west_line, east_line = (resample(side, up) for side in sides)
    south = np.concatenate([lines[0], lines[1][1:], lines[2][1:]])
    # As far apart in front as where they begin.
    share = np.concatenate([[0], np.cumsum(np.linalg.norm(
        np.diff(south, axis=0), axis=1))])
    north = west_line[-1] + (share / share[-1])[:, None] \
        * (east_line[-1] - west_line[-1])
    joint = patch(south, north, west_line, east_line)
    cuts = np.cumsum([0, *across])
    patches += [joint[a:b + 1] for a, b in zip(cuts[:-1], cuts[1:])]
    return relax(join(patches, lambda number, side: "rim", order))
