"""A layer of cartilage between two smooth surfaces over a chart.

A chart has coordinates u and v along the layer and h across it, all in mm. The
nodes of a column lie on a normal of the surface in the middle, so that elements
are upright wherever the layer slopes in its chart.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Callable, Protocol

import numpy as np

Height = Callable[[np.ndarray, np.ndarray], np.ndarray]

# Standard deviation of what normals are averaged over (mm).
BLUR = 2.0


class Chart(Protocol):
    def place(self, u: np.ndarray, v: np.ndarray, h: np.ndarray
              ) -> np.ndarray: ...

    def coordinates(self, x: np.ndarray
                    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]: ...


class Vertical:
    """(u, v, h) = (x, y, z)."""

    def place(self, u, v, h):
        return np.stack(np.broadcast_arrays(u, v, h), axis=-1)

    def coordinates(self, x):
        return x[..., 0], x[..., 1], x[..., 2]


@dataclass
class Cylinder:
    """About an axis along x: h is the distance from it, v = radius * angle.

    The angle is 0 at the front, -pi/2 below and -pi behind; it lies between
    -3/2 pi and pi/2, so that only the top is cut. Seen from the axis, u and v
    are right-handed with h outwards for -v; see Layer.columns.
    """

    y: float
    z: float
    radius: float

    def place(self, u, v, h):
        angle = v / self.radius
        return np.stack(np.broadcast_arrays(
            u, self.y + h * np.cos(angle), self.z + h * np.sin(angle)),
            axis=-1)

    def coordinates(self, x):
        y, z = x[..., 1] - self.y, x[..., 2] - self.z
        angle = np.arctan2(z, y)
        angle = np.where(angle > np.pi / 2, angle - 2 * np.pi, angle)
        return x[..., 0], self.radius * angle, np.hypot(y, z)


@dataclass
class Layer:
    chart: Chart
    bone: Height
    contact: Height
    thinnest: float   # mm

    def middle(self, u: np.ndarray, v: np.ndarray) -> np.ndarray:
        return self.chart.place(u, v, 0.5 * (self.bone(u, v)
                                             + self.contact(u, v)))

    def normals(self, u: np.ndarray, v: np.ndarray) -> np.ndarray:
        """Unit normals of the middle surface, towards the contact side."""
        e = 0.05
        n = np.cross(self.middle(u + e, v) - self.middle(u - e, v),
                     self.middle(u, v + e) - self.middle(u, v - e))
        up = self.chart.place(u, v, np.full_like(u, 21.0)) \
            - self.chart.place(u, v, np.full_like(u, 20.0))
        n *= np.sign(np.einsum("ij,ij->i", n, up))[:, None]
        return n / np.linalg.norm(n, axis=1)[:, None]

    def directions(self, u: np.ndarray, v: np.ndarray) -> np.ndarray:
        """The mean normals of the surroundings, as wide as the layer is thick.

        Normals themselves may meet within the layer where it is bent sharply.
        """
        offsets = np.linspace(-1.5, 1.5, 7) * BLUR
        n = sum(np.exp(-0.5 * (a**2 + b**2) / BLUR**2)
                * self.normals(u + a, v + b) for a in offsets for b in offsets)
        return n / np.linalg.norm(n, axis=1)[:, None]

    def _reach(self, start: np.ndarray, direction: np.ndarray,
               surface: Height) -> np.ndarray:
        """Distance along the direction to a surface, by the secant method."""

        def above(t: np.ndarray) -> np.ndarray:
            u, v, h = self.chart.coordinates(start + t[:, None] * direction)
            return h - surface(u, v)

        t, step = np.zeros(len(start)), 1e-3
        for _ in range(25):
            f = above(t)
            slope = (above(t + step) - f) / step
            t = t - np.clip(f / np.maximum(slope, 0.2), -0.5, 0.5)
        return t

    def columns(self, u: np.ndarray, v: np.ndarray, layers: int
                ) -> np.ndarray:
        """Nodes from the bone to the contact side, n x (layers + 1) x 3.

        Where the layer is thinner than the thinnest it may be, the bone side
        gives way, and smoothly so.
        """
        start, n = self.middle(u, v), self.directions(u, v)
        top = self._reach(start, n, self.contact)
        thickness = top - self._reach(start, n, self.bone)
        excess = thickness - self.thinnest
        thickness = self.thinnest + 0.5 * (excess
                                           + np.sqrt(excess**2 + 0.04))
        share = np.linspace(0, 1, layers + 1)
        t = top[:, None] - thickness[:, None] * (1 - share)
        return start[:, None] + t[:, :, None] * n[:, None]
