"""Femoral cartilage from a labeled image: a layer and its outline."""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from cartilage_layer import Cylinder, Layer
from cartilage_outline import FemoralOutline
from circle_fit import circle
from label_image import ImageError, Tissue
from label_surfaces import SPACING, largest, sample

# What counts as a notch in a line of the chart (mm).
LEAST_GAP, LEAST_ARM = 2.0, 5.0


def femoral_axis(femur: Tissue) -> Cylinder:
    """The cylinder along x that fits the lower half of the condyles."""
    y, z = femur.points[:, 1], femur.points[:, 2]
    low = z < np.percentile(z, 60)
    (cy, cz), radius = circle(np.column_stack([y[low], z[low]]))
    return Cylinder(float(cy), float(cz), radius)


def femoral_layer(tissue: Tissue, chart: Cylinder, cutoff: float,
                  thinnest: float) -> tuple[Layer, FemoralOutline]:
    samples = sample(tissue, chart)
    thick = ndimage.binary_opening(samples.thickness() > thinnest,
                                   iterations=2)
    bone, contact = samples.fit(thick, cutoff)
    return (Layer(chart, bone, contact, thinnest),
            femoral_outline(samples.u, samples.v, thick))


def _sides(u: np.ndarray, line: np.ndarray) -> list[float]:
    """Where a line of the mask begins and ends, and its notch between these.

    NaN for the notch where there is none, for all where there is nothing.
    """
    inside = np.flatnonzero(line)
    if len(inside) < 2:
        return [np.nan] * 4
    begin, end = u[inside[0]], u[inside[-1]]
    widest = int(np.argmax(np.diff(inside)))
    notch = u[inside[widest]], u[inside[widest + 1]]
    if notch[1] - notch[0] < LEAST_GAP or \
            min(notch[0] - begin, end - notch[1]) < LEAST_ARM:
        notch = np.nan, np.nan
    return [begin, *notch, end]


def _notch_sides(u: np.ndarray, mask: np.ndarray, sides: np.ndarray,
                 both: np.ndarray) -> np.ndarray:
    """Both sides of what is connected to the notch, from its first line on.

    Holes and dents of the mask, which may be wider, are something else.
    """
    rows = np.flatnonzero(both)
    parts, _ = ndimage.label(~mask[:, rows[0]:])
    seed = rows[len(rows) // 2]
    inside = (u > sides[1, seed]) & (u < sides[2, seed])
    notch = np.zeros_like(mask)
    notch[:, rows[0]:] = parts == parts[np.flatnonzero(inside)[0],
                                        seed - rows[0]]
    if notch[0].any() or notch[-1].any():
        raise ImageError("the femoral cartilage's condyles do not join in "
                         "front of the notch")
    found = np.full((2, mask.shape[1]), np.nan)
    for row in np.flatnonzero(notch.any(axis=0)):
        across = np.flatnonzero(notch[:, row])
        found[:, row] = u[across[0] - 1], u[across[-1] + 1]
    return found


def _smooth(values: np.ndarray) -> np.ndarray:
    rows, known = np.arange(len(values)), np.isfinite(values)
    filled = np.interp(rows, rows[known], values[known])
    return ndimage.gaussian_filter1d(filled, 3.0 / SPACING, mode="nearest")


def femoral_outline(u: np.ndarray, v: np.ndarray, mask: np.ndarray
                    ) -> FemoralOutline:
    """The outline of two arms (condyles) that join in front (trochlea).

    The arms end where they have lost 40 % of their width, the front where it
    has lost half of it; those lines are straight.
    """
    mask = largest(mask)
    sides = np.array([_sides(u, line) for line in mask.T]).T
    both = largest(np.isfinite(sides[1]))
    if both.sum() < 10:
        raise ImageError("the femoral cartilage has no two condyles")
    sides[1:3] = _notch_sides(u, mask, sides, both)
    gap = sides[2] - sides[1]
    two = np.isfinite(gap)
    # Where the notch becomes round: an arch this flat meets its sides at about
    # 45 degrees.
    last = np.flatnonzero(two)[-1]
    flat = two & (v[last] + SPACING - v < 0.3 * gap)
    joint = int(np.flatnonzero(flat)[0]) if flat.any() else int(last)
    arms = two & (np.arange(len(v)) <= joint)
    sides[1:3, ~arms] = np.nan
    sides[:, :np.flatnonzero(two)[0]] = np.nan
    ends = []
    for arm in (sides[:2], sides[2:]):
        width = np.where(arms, arm[1] - arm[0], np.nan)
        ends.append(int(np.flatnonzero(width > 0.6 * np.nanmedian(width))[0]))
        arm[:, :ends[-1]] = np.nan
    total = (sides[3] - sides[0])[joint:]
    narrow = ~(total > 0.5 * total[0])
    front = joint + (int(np.argmax(narrow)) if narrow.any()
                     else len(narrow)) - 1
    if front < joint + 5:
        raise ImageError("the femoral cartilage has no front that joins its "
                         "condyles")
    sides[:, front + 1:] = np.nan
    smooth = [_smooth(side) for side in sides]
    return FemoralOutline(v, smooth, (v[ends[0]], v[ends[1]]),
                          float(v[joint]), _notch(u, v, mask, smooth, joint),
                          float(v[front]))


def _notch(u: np.ndarray, v: np.ndarray, mask: np.ndarray,
           sides: list[np.ndarray], joint: int) -> np.ndarray:
    """The curve at the notch's end, from one arm's inner side to the other's.

    It is smoothed by leaving off the higher harmonics of an arch.
    """
    begin, end = sides[1][joint], sides[2][joint]
    inner = np.flatnonzero((u > begin) & (u < end))
    top = [v[joint + np.argmax(mask[i, joint:])] for i in inner]
    share = np.linspace(0, 1, 101)
    arch = np.interp(begin + share * (end - begin), [begin, *u[inner], end],
                     [v[joint], *top, v[joint]]) - v[joint]
    waves = np.sin(np.pi * np.outer(share, np.arange(1, 4)))
    arch = waves @ np.linalg.lstsq(waves, arch, rcond=None)[0]
    return np.column_stack([begin + share * (end - begin), v[joint] + arch])
