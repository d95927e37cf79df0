"""Layers of cartilage that thin out towards their outline."""

from __future__ import annotations

import numpy as np

# Of the thickness, what is left at the outline.
EDGE = 0.4


def distances(points: np.ndarray, outline: np.ndarray) -> np.ndarray:
    """From each point of the plane, n x 2, to a closed curve, m x 2."""
    begin = outline
    along = np.roll(outline, -1, axis=0) - begin
    away = points[:, None] - begin
    share = np.clip(np.einsum("nmi,mi->nm", away, along)
                    / np.einsum("mi,mi->m", along, along), 0, 1)
    return np.linalg.norm(away - share[..., None] * along,
                          axis=2).min(axis=1)


def taper(columns: np.ndarray, distance: np.ndarray, width: float
          ) -> np.ndarray:
    """Columns whose contact side falls off within this distance of the
    outline, along a parabola that is level where it begins; the bone stays.

    columns is n x levels x 3, from the bone up.
    """
    steepness = np.clip(1 - distance / width, 0, 1)
    share = 1 - (1 - EDGE) * steepness**2
    bone = columns[:, :1]
    return bone + share[:, None, None] * (columns - bone)
