"""A meniscus from a labeled image: its outline and its two surfaces."""

from __future__ import annotations

import numpy as np
from scipy import ndimage

from cartilage_layer import Vertical
from circle_fit import circle
from label_image import ImageError, Tissue
from label_surfaces import SPACING, Samples, sample
from meniscus_wedge import Meniscus, polar

# Thinner tissue is no part of the circle through the meniscus (mm), and at its
# inner side it ends where it is thinner than THINNEST.
THIN, THINNEST = 0.7, 0.5
# It ends at the periphery where it is thinner than this share of the highest
# place on the same ray, and its surfaces are taken from what is farther inside
# than WALL (mm), since voxels round the edges off.
SHARE, WALL = 0.4, 0.8
# Horns end where it is lower or narrower than this (mm).
LEAST_HEIGHT, LEAST_WIDTH = 1.4, 4.0
# The outline over the angle is smoothed so far (degrees).
BLUR = 5


def meniscus(tissue: Tissue, cutoff: float) -> Meniscus:
    """Outline about the center of a circle, and surfaces, of a C in (x, y)."""
    samples = sample(tissue, Vertical())
    thick = samples.thickness() > THIN
    i, j = np.nonzero(thick)
    x, y = samples.u[i], samples.v[j]
    center, _ = circle(np.column_stack([x, y]))
    angles, inner, outer = _arc(*_radii(samples, center), tissue.name)
    angle, radius = polar(center, angles, x, y)
    order = np.argsort(angles)
    thick[i, j] = radius < np.interp(angle, angles[order],
                                     outer[order]) - WALL
    return Meniscus(center, angles, inner, outer, *samples.fit(thick, cutoff))


def _radii(samples: Samples, center: np.ndarray
           ) -> tuple[np.ndarray, np.ndarray]:
    """Inner and outer radius at every degree, NaN where there is no tissue."""
    angles = np.deg2rad(np.arange(360))
    radii = np.arange(1, 45, 0.1)
    rays = center[:, None, None] + radii \
        * np.array([np.cos(angles), np.sin(angles)])[:, :, None]
    heights = ndimage.map_coordinates(
        samples.thickness(), [(rays[0] - samples.u[0]) / SPACING,
                              (rays[1] - samples.v[0]) / SPACING], order=1)
    inner, outer = np.full((2, len(angles)), np.nan)

    def around_highest(inside: np.ndarray, line: np.ndarray) -> np.ndarray:
        parts, _ = ndimage.label(inside)
        return radii[parts == parts[np.argmax(line)]]

    for k, line in enumerate(heights):
        if line.max() > LEAST_HEIGHT:
            body = around_highest(line > THINNEST, line)
            if np.ptp(body) > LEAST_WIDTH:
                inner[k] = body[0]
                outer[k] = around_highest(line > SHARE * line.max(), line)[-1]
    return inner, outer


def _arc(inner: np.ndarray, outer: np.ndarray, name: str
         ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Angles from the anterior horn on, and smooth radii there."""
    found = np.isfinite(inner)
    if found.all():
        raise ImageError(f"{name} is a closed ring: it has no horns")
    # From the end of the longest stretch without tissue on.
    parts, _ = ndimage.label(np.tile(~found, 2))
    longest = 1 + np.argmax(np.bincount(parts)[1:])
    start = np.flatnonzero(parts == longest)[-1] + 1
    arc = (start + np.arange(len(found))) % len(found)
    if found.sum() < 90:
        raise ImageError(f"{name} is no arc of 90 degrees or more")
    arc = arc[:np.flatnonzero(found[arc])[-1] + 1]
    known = np.flatnonzero(found[arc])
    inner, outer = (ndimage.gaussian_filter1d(
        np.interp(np.arange(len(arc)), known, radius[arc][known]), BLUR,
        mode="nearest") for radius in (inner, outer))
    angles = np.deg2rad(start % len(found) + np.arange(len(arc)))
    if np.sin(angles[0]) < np.sin(angles[-1]):
        return angles[::-1], inner[::-1], outer[::-1]
    return angles, inner, outer
