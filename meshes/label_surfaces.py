"""Where rays through a tissue enter and leave it, and smooth surfaces there."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import ndimage

from cartilage_layer import Chart
from label_image import Tissue, crossings
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


def largest(mask: np.ndarray) -> np.ndarray:
    """The largest connected part of a mask, or of a line of one."""
    parts, count = ndimage.label(mask)
    if count == 0:
        return mask
    return parts == 1 + np.argmax(np.bincount(parts.ravel())[1:])
