"""Smooth layers, and the outlines they have in their charts, from tissues."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from cartilage_layer import Chart, Cylinder, Layer, Vertical
from cartilage_outline import FemoralOutline
from circle_fit import circle
from label_image import ImageError, Tissue, crossings
from meniscus_wedge import Meniscus
from smooth_height import SmoothHeight

SPACING = 0.5     # of the rays (mm)
STEP = 0.1        # along them (mm)
MARGIN = 6.0      # how far surfaces go on beyond the tissue (mm)


@dataclass
class Samples:
    """A tissue's first and last points along the rays of a chart."""

    u: np.ndarray
    v: np.ndarray
    first: np.ndarray   # len(u) x len(v), NaN where there is none
    last: np.ndarray

    def thickness(self) -> np.ndarray:
        return np.nan_to_num(self.last - self.first)

    def fit(self, kept: np.ndarray, cutoff: float
            ) -> tuple[SmoothHeight, SmoothHeight]:
        """Smooth first and last surfaces through the samples kept."""
        i, j = np.nonzero(kept)
        u, v = self.u[i], self.v[j]
        box = (u.min() - MARGIN, u.max() + MARGIN,
               v.min() - MARGIN, v.max() + MARGIN)
        return (SmoothHeight(u, v, self.first[i, j], cutoff, box),
                SmoothHeight(u, v, self.last[i, j], cutoff, box))


def sample(tissue: Tissue, chart: Chart) -> Samples:
    u, v, h = chart.coordinates(tissue.points)
    axes = [np.arange(x.min() - 2 * SPACING, x.max() + 2 * SPACING, SPACING)
            for x in (u, v)]
    steps = np.arange(h.min() - 1, h.max() + 1, STEP)
    first = np.full((len(axes[0]), len(axes[1])), np.nan)
    last = first.copy()
    for i, line in enumerate(axes[0]):
        rays = chart.place(np.full((len(axes[1]), 1), line),
                           axes[1][:, None], steps[None, :])
        first[i], last[i] = crossings(tissue.inside(rays), steps)
    return Samples(axes[0], axes[1], first, last)


def tibial_layer(tissue: Tissue, cutoff: float, thinnest: float
                 ) -> tuple[Layer, np.ndarray]:
    """The layer, and its outline, counter-clockwise."""
    samples = sample(tissue, Vertical())
    thick = samples.thickness() > thinnest
    bone, contact = samples.fit(thick, cutoff)
    return (Layer(Vertical(), bone, contact, thinnest),
            star_outline(samples.u, samples.v, thick, tissue.name))


def star_outline(u: np.ndarray, v: np.ndarray, mask: np.ndarray, name: str,
                 harmonics: int = 9) -> np.ndarray:
    """The smoothed outline of a mask that its centre sees all of, 360 points.

    Smoothed by leaving off the higher harmonics of the radius over the angle,
    after the mask was scaled to be as long as it is wide.
    """
    whole = ndimage.binary_fill_holes(ndimage.binary_opening(mask,
                                                             iterations=2))
    i, j = np.nonzero(whole)
    if len(i) < 50:
        raise ImageError(f"{name} is too small or too thin to be meshed")
    points = np.column_stack([u[i], v[j]])
    low, high = points.min(axis=0), points.max(axis=0)
    centre, half = 0.5 * (low + high), 0.5 * (high - low)
    angle = np.linspace(-np.pi, np.pi, 360, endpoint=False)
    ray = np.column_stack([np.cos(angle), np.sin(angle)])
    t = np.arange(0, 1.6, 0.01)
    places = centre + half * ray[:, None] * t[None, :, None]
    value = ndimage.map_coordinates(
        whole.astype(float), [(places[..., 0] - u[0]) / (u[1] - u[0]),
                              (places[..., 1] - v[0]) / (v[1] - v[0])],
        order=1)
    radius = t[len(t) - 1 - np.argmax(value[:, ::-1] > 0.5, axis=1)]
    wave = np.fft.rfft(radius)
    wave[harmonics + 1:] = 0
    radius = np.fft.irfft(wave, len(radius))
    return centre + half * ray * radius[:, None]


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


def _runs(u: np.ndarray, line: np.ndarray) -> list[tuple[float, float]]:
    parts, count = ndimage.label(line)
    found = []
    for part in range(1, count + 1):
        inside = np.flatnonzero(parts == part)
        if u[inside[-1]] - u[inside[0]] > 5:
            found.append((u[inside[0]], u[inside[-1]]))
    return found


def _smooth(values: np.ndarray, known: np.ndarray) -> np.ndarray:
    rows = np.arange(len(values))
    filled = np.interp(rows, rows[known], values[known])
    return ndimage.gaussian_filter1d(filled, 3.0 / SPACING, mode="nearest")


def femoral_outline(u: np.ndarray, v: np.ndarray, mask: np.ndarray
                    ) -> FemoralOutline:
    """The outline of two arms (condyles) that join in front (trochlea).

    The arms end where they have lost 40 % of their width, the front where it
    has lost half of it; those lines are straight.
    """
    parts, count = ndimage.label(mask)
    mask = parts == 1 + np.argmax(np.bincount(parts.ravel())[1:])
    rows = [_runs(u, mask[:, j]) for j in range(len(v))]
    two = np.array([len(r) == 2 for r in rows])
    if two.sum() < 10:
        raise ImageError("the femoral cartilage has no two condyles")
    gap = np.array([r[1][0] - r[0][1] if len(r) == 2 else 0 for r in rows])
    parts, count = ndimage.label(two)
    two = parts == 1 + np.argmax(np.bincount(parts)[1:])
    # Where the notch becomes round: an arch this flat meets its sides at about
    # 45 degrees.
    last = np.flatnonzero(two)[-1]
    flat = two & (v[last] + SPACING - v < 0.3 * gap)
    joint = int(np.flatnonzero(flat)[0]) if flat.any() else int(last)
    sides = [np.full(len(v), np.nan) for _ in range(4)]
    for j, r in enumerate(rows):
        if two[j] and j <= joint:
            values = [*r[0], *r[1]]
        elif j > joint and r:
            values = [r[0][0], np.nan, np.nan, r[-1][1]]
        else:
            continue
        for side, value in zip(sides, values):
            side[j] = value
    ends = []
    for a, b in ((0, 1), (2, 3)):
        width = sides[b] - sides[a]
        width[joint + 1:] = np.nan
        wide = width > 0.6 * np.nanmedian(width)
        ends.append(int(np.flatnonzero(wide)[0]))
        for side in (sides[a], sides[b]):
            side[:ends[-1]] = np.nan
    total = sides[3] - sides[0]
    wide = total[joint:] > 0.5 * total[joint]
    front = joint + int(np.argmin(wide) if not wide.all() else len(wide)) - 1
    for side in (sides[0], sides[3]):
        side[front + 1:] = np.nan
    smooth = [_smooth(side, np.isfinite(side)) for side in sides]
    inner = (u > smooth[1][joint]) & (u < smooth[2][joint])
    apex = np.array([v[joint:][np.argmax(mask[i, joint:])]
                     for i in np.flatnonzero(inner)])
    notch = np.column_stack([
        np.concatenate([[smooth[1][joint]], u[inner], [smooth[2][joint]]]),
        np.concatenate([[v[joint]], apex, [v[joint]]])])
    # Smoothed by leaving off the higher harmonics of an arch.
    s = np.linspace(0, 1, 101)
    arch = np.interp(notch[0, 0] + s * np.ptp(notch[:, 0]), notch[:, 0],
                     notch[:, 1]) - v[joint]
    waves = np.sin(np.pi * np.outer(s, np.arange(1, 4)))
    arch = waves @ np.linalg.lstsq(waves, arch, rcond=None)[0]
    notch = np.column_stack([notch[0, 0] + s * np.ptp(notch[:, 0]),
                             v[joint] + arch])
    return FemoralOutline(v, smooth, (v[ends[0]], v[ends[1]]),
                          float(v[joint]), notch, float(v[front]))


def meniscus(tissue: Tissue, cutoff: float
             ) -> Meniscus:
    """Outline about the centre of a circle, and surfaces, of a C in (x, y)."""
    samples = sample(tissue, Vertical())
    thickness = samples.thickness()
    i, j = np.nonzero(thickness > 0.7)
    x, y = samples.u[i], samples.v[j]
    centre, _ = circle(np.column_stack([x, y]))
    angles = np.deg2rad(np.arange(0, 360, 1.0))
    radii = np.arange(1, 45, 0.1)
    rays = centre[:, None, None] + radii \
        * np.array([np.cos(angles), np.sin(angles)])[:, :, None]
    profile = ndimage.map_coordinates(
        thickness, [(rays[0] - samples.u[0]) / SPACING,
                    (rays[1] - samples.v[0]) / SPACING], order=1)
    inner, outer = np.full((2, len(angles)), np.nan)
    for k, line in enumerate(profile):
        parts, _ = ndimage.label(line > 0.4 * line.max())
        wall = parts == parts[np.argmax(line)]
        parts, _ = ndimage.label(line > 0.5)
        body = parts == parts[np.argmax(line)]
        if line.max() > 1.4 and np.ptp(radii[body]) > 4:
            inner[k], outer[k] = radii[body][0], radii[wall][-1]
    found = np.isfinite(inner)
    if found.all():
        raise ImageError(f"{tissue.name} is a closed ring: it has no horns")
    # From the end of the longest stretch without tissue on.
    parts, _ = ndimage.label(np.tile(~found, 2))
    longest = 1 + np.argmax(np.bincount(parts)[1:])
    start = np.flatnonzero(parts == longest)[-1] + 1
    arc = (start + np.arange(len(angles))) % len(angles)
    arc = arc[:np.flatnonzero(found[arc])[-1] + 1]
    if len(arc) < 90:
        raise ImageError(f"{tissue.name} is no arc of 90 degrees or more")
    inner, outer = (ndimage.gaussian_filter1d(
        np.interp(np.arange(len(arc)), np.flatnonzero(found[arc]),
                  r[arc][found[arc]]), 5, mode="nearest")
        for r in (inner, outer))
    turned = angles[start % len(angles)] + np.deg2rad(np.arange(len(arc)))
    # Heights beside the wall are those of the wall.
    angle = np.arctan2(y - centre[1], x - centre[0])
    middle = turned[len(turned) // 2]
    angle = middle + (angle - middle + np.pi) % (2 * np.pi) - np.pi
    kept = np.zeros_like(thickness, dtype=bool)
    kept[i, j] = np.hypot(x - centre[0], y - centre[1]) \
        < np.interp(angle, turned, outer) - 0.8
    first, last = samples.fit(kept, cutoff)
    if np.sin(turned[0]) < np.sin(turned[-1]):
        turned, inner, outer = turned[::-1], inner[::-1], outer[::-1]
    return Meniscus(centre, turned, inner, outer, first, last)
