"""The circle closest to points in a plane."""

from __future__ import annotations

import numpy as np


def circle(points: np.ndarray) -> tuple[np.ndarray, float]:
    """Center and radius that fit points (n x 2) in the least-squares sense.

    It is the squared distances that are fitted, which makes it linear.
    """
    system = np.column_stack([2 * points, np.ones(len(points))])
    x, y, rest = np.linalg.lstsq(system, (points**2).sum(axis=1),
                                 rcond=None)[0]
    return np.array([x, y]), float(np.sqrt(rest + x**2 + y**2))
