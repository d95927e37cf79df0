"""The meniscus: a wedge along an arc, fitted between femur and tibia."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy import ndimage
from scipy.interpolate import interp1d
from scipy.spatial import cKDTree

from cartilage_layer import Height, Layer
from gmsh_bodies import Body
from meniscus_fan import add_fan
from meniscus_tip import add_tip
from quad_plane import QuadMesh, join, patch, relax, resample
from smooth_height import SmoothHeight

# The surfaces are fitted in two passes. Each closes gaps below its first number
# (mm), which an image of this resolution can't tell from contact, and then
# leaves out waves shorter than the second (mm), since a meniscus would leave
# its neighbor with a sharp bend otherwise. What the first pass opens by that,
# the second one closes again.
PASSES = ((0.35, 4.5), (0.15, 2.5))
# Left between surfaces that were closed, for their facets (mm).
MARGIN = 0.02
SPACING = 0.5   # of the grid on which surfaces are fitted (mm)
# Steps to where a leaning column meets a surface; each takes an error to less
# than a third, where surfaces rise by 45 degrees towards each other.
LEANING_STEPS = 8


@dataclass(frozen=True)
class InnerFace:
    """The face at the inner edge, and what is beside it.

    lean: from 0, an upright face, to 1, one that meets both surfaces at right
    angles and is hollow by a tenth of a millimeter at most for that. An upright
    face meets a surface at up to 125 degrees, where stress is singular as the
    one is free and the other slides along its neighbor, and leans over the more
    the wedge is pressed flat, until it lies on the tibia.
    first: width of the elements there over that of all on average.
    tip: adds the rounded edge that goes on from there, if any: of hexahedra,
    see meniscus_tip, or of prisms, see meniscus_fan.
    """

    lean: float
    first: float
    tip: Callable[[Body, np.ndarray, int, str], Body] | None = None


INNER_FACES = {"upright": InnerFace(0.0, 1.0), "normal": InnerFace(1.0, 0.5),
               "round": InnerFace(1.0, 0.7, add_tip),
               "fan": InnerFace(1.0, 0.7, add_fan)}


@dataclass
class Meniscus:
    """Radii over the angle about a center, from the anterior horn on.

    angles increase or decrease monotonically (rad); the inner radius is where
    the tissue ends. The surfaces are heights z(x, y), in mm.
    """

    center: np.ndarray     # 2
    angles: np.ndarray
    inner: np.ndarray
    outer: np.ndarray
    inferior: Height
    superior: Height

    def place(self, radius: np.ndarray) -> np.ndarray:
        ray = np.column_stack([np.cos(self.angles), np.sin(self.angles)])
        return self.center + radius[:, None] * ray


def polar(center: np.ndarray, angles: np.ndarray, x: np.ndarray, y: np.ndarray
          ) -> tuple[np.ndarray, np.ndarray]:
    """Angle, within pi of the middle one of the angles, and radius."""
    dx, dy = x - center[0], y - center[1]
    middle = angles[len(angles) // 2]
    turn = (np.arctan2(dy, dx) - middle + np.pi) % (2 * np.pi)
    return middle + turn - np.pi, np.hypot(dx, dy)


class Cover:
    """A layer's contact side as z(x, y), seen along z.

    Beside the layer the surface goes on and bends away, by d^2/9 at the
    distance d (mm), so that what is fitted to it leaves it smoothly.
    """

    def __init__(self, layer: Layer, plane: QuadMesh, from_below: bool):
        self._layer = layer
        corners = plane.quads[:, :4]
        self._tree = cKDTree(plane.points[np.unique(corners)])
        edges = plane.points[corners] \
            - plane.points[np.roll(corners, 1, axis=1)]
        self._size = float(np.linalg.norm(edges, axis=2).max())
        self._sign = 1.0 if from_below else -1.0

    def __call__(self, x: np.ndarray, y: np.ndarray, near: np.ndarray
                 ) -> np.ndarray:
        """The height closest to `near`, NaN where there is none within 12."""
        def above(z: np.ndarray) -> np.ndarray:
            place = np.stack(np.broadcast_arrays(x, y, z), axis=-1)
            u, v, h = self._layer.chart.coordinates(place)
            return h - self._layer.contact(u, v)

        steps = np.arange(-12.0, 12.01, 0.75)
        values = np.array([above(near + step) for step in steps])
        change = values[:-1] * values[1:] <= 0
        distance = np.where(change, np.abs(steps[:-1] + 0.375)[:, None], np.inf)
        which = np.argmin(distance, axis=0)
        low, high = near + steps[which], near + steps[which + 1]
        sign = np.sign(values[which, np.arange(len(x))])
        for _ in range(20):
            middle = 0.5 * (low + high)
            same = sign * above(middle) > 0
            low, high = (np.where(same, middle, low),
                         np.where(same, high, middle))
        z = 0.5 * (low + high)
        u, v, _ = self._layer.chart.coordinates(np.stack([x, y, z], axis=-1))
        beside = self._tree.query(np.column_stack([u, v]))[0] - self._size
        bend = np.maximum(beside, 0.0)**2 / 9.0
        return np.where(np.isfinite(distance.min(axis=0)),
                        z + self._sign * bend, np.nan)


def closed(gap: np.ndarray, below: float) -> np.ndarray:
    """What becomes of a gap: nothing of a small one, and large ones stay."""
    share = 1 / (1 + np.exp(-np.clip((gap / below - 1) / 0.4, -50, 50)))
    return MARGIN + gap * share


def opened(gap: np.ndarray) -> np.ndarray:
    """What becomes of a gap that may be negative: it is MARGIN at least nearly,
    and hardly changes where it is more than that.
    """
    return 0.5 * (gap + np.sqrt(gap**2 + 4 * MARGIN**2))


class Fitted:
    """The meniscus between its neighbors; the femur is lifted by `lift` (mm).
    """

    def __init__(self, body: Meniscus, tibia: Cover, femur: Cover, lift: float,
                 reach: float):
        self.body, self._reach = body, reach
        self._tibia, self._femur, self._lift = tibia, femur, lift
        x, y = self._around()
        low, high = body.inferior(x, y), body.superior(x, y)
        floor, roof = tibia(x, y, low), femur(x, y, high)
        on_floor, on_roof = np.isfinite(floor), np.isfinite(roof)
        roof = roof + lift
        high = np.where(on_roof, high + lift, high)
        box = (x.min() - 1, x.max() + 1, y.min() - 1, y.max() + 1)
        for below, rounding in PASSES:
            low = np.where(on_floor, floor + closed(low - floor, below), low)
            high = np.where(on_roof, roof - closed(roof - high, below), high)
            self.inferior = SmoothHeight(x, y, low, rounding, box, SPACING)
            self.superior = SmoothHeight(x, y, high, rounding, box, SPACING)
            low, high = self.inferior(x, y), self.superior(x, y)

    def _around(self) -> tuple[np.ndarray, np.ndarray]:
        """Points of a grid on the meniscus and a little beyond."""
        body = self.body
        rim = body.place(body.outer)
        x, y = (line.ravel() for line in np.meshgrid(
            *(np.arange(a - 2, b + 2, 0.8 * SPACING)
              for a, b in zip(rim.min(axis=0), rim.max(axis=0)))))
        angle, radius = polar(body.center, body.angles, x, y)
        order = np.argsort(body.angles)
        angles = body.angles[order]
        beside = radius * np.maximum(angle - angles[-1], angles[0] - angle)
        kept = (beside < 1.5) \
            & (radius < np.interp(angle, angles, body.outer[order]) + 1.5) \
            & (radius > np.interp(angle, angles, body.inner[order])
               - self._reach)
        return x[kept], y[kept]

    def sides(self, x: np.ndarray, y: np.ndarray
              ) -> tuple[np.ndarray, np.ndarray]:
        """z of the inferior and the superior surface, clear of the neighbors.
        """
        low, high = self.inferior(x, y), self.superior(x, y)
        gap = low - self._tibia(x, y, low)
        low = np.where(np.isfinite(gap), low + opened(gap) - gap, low)
        gap = self._femur(x, y, high - self._lift) + self._lift - high
        high = np.where(np.isfinite(gap), high + gap - opened(gap), high)
        return low, high

    def leans(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """How far the normals of the two surfaces go sideways, by height:
        2 x n x 2.
        """
        return np.array([[-side(x, y, 1, 0), -side(x, y, 0, 1)]
                         for side in (self.inferior, self.superior)]
                        ).transpose(0, 2, 1)

    def inner(self, edge: float) -> np.ndarray:
        """The radius where the wedge is as thick as its inner edge should be.

        At most the reach inside of where the tissue ends.
        """
        body = self.body
        share = np.linspace(0, 1, 60)
        begin, end = body.inner - self._reach, body.outer - 2.0
        r = begin[:, None] + (end - begin)[:, None] * share
        x = body.center[0] + r * np.cos(body.angles)[:, None]
        y = body.center[1] + r * np.sin(body.angles)[:, None]
        thin = self.superior(x, y) - self.inferior(x, y) < edge
        last = len(share) - 1 - np.argmax(thin[:, ::-1], axis=1)
        found = np.where(thin.any(axis=1),
                         r[np.arange(len(r)), last], begin)
        step = np.median(body.outer) * abs(body.angles[1] - body.angles[0])
        found = ndimage.maximum_filter1d(found, 1 + 2 * round(1.0 / step))
        return ndimage.gaussian_filter1d(found, 2.0 / step, mode="nearest")


def plane(fitted: Fitted, edge: float, face: InnerFace, size: float,
          order: int = 1) -> QuadMesh:
    """Quadrangles from the inner edge to the periphery, from horn to horn."""
    outer = fitted.body.place(fitted.body.outer)
    inner = fitted.body.place(fitted.inner(edge))
    long = np.linalg.norm(np.diff(0.5 * (inner + outer), axis=0), axis=1).sum()
    wide = np.median(np.linalg.norm(outer - inner, axis=1))
    along = order * max(8, round(long / size))
    across = order * max(3, round(wide / size))
    south, north = resample(inner, along), resample(outer, along)
    names = {"south": "inner", "north": "periphery",
             "west": "horn_anterior", "east": "horn_posterior"}
    mesh = join([patch(south, north,
                       np.linspace(south[0], north[0], across + 1),
                       np.linspace(south[-1], north[-1], across + 1))],
                lambda number, side: names[side], order)
    mesh = relax(mesh, 20)
    mesh.points = _graded(mesh.points.reshape(along + 1, -1, 2), face.first,
                          order)
    x = mesh.points[mesh.quads]
    across, up = x[:, 1] - x[:, 0], x[:, 3] - x[:, 0]
    turn = np.median(across[:, 0] * up[:, 1] - across[:, 1] * up[:, 0])
    return mesh if turn > 0 else mesh.turned_over()


def _graded(rows: np.ndarray, first: float, order: int) -> np.ndarray:
    """Points on the rows, each from the inner edge to the periphery; the first
    elements are that much as wide as they are on average.
    """
    count = (rows.shape[1] - 1) // order
    even = np.linspace(0, 1, count + 1)
    uniform = np.linspace(0, 1, rows.shape[1])
    at = np.interp(uniform, even, first * even + (1 - first) * even**2)
    return interp1d(uniform, rows, axis=1)(at).reshape(-1, 2)


def columns(fitted: Fitted, mesh: QuadMesh, face: InnerFace, layers: int
            ) -> np.ndarray:
    """Lines of nodes from the inferior to the superior surface: as the face at
    the inner edge, upright at the periphery.
    """
    lower, upper = (face.lean * _nearness(mesh)[:, None]
                    * fitted.leans(*mesh.points.T))
    low, high = fitted.sides(*mesh.points.T)

    def places(share: float) -> np.ndarray:
        """Where a line is that leans as lower at 0, as upper at 1."""
        return mesh.points + (high - low)[:, None] * (
            lower * (share - 0.5 * share**2 - 0.375)
            + upper * (0.5 * share**2 - 0.125))

    for _ in range(LEANING_STEPS):
        low, high = (fitted.sides(*places(end).T)[end] for end in (0, 1))
    return np.stack([np.column_stack([places(share),
                                      low + share * (high - low)])
                     for share in np.linspace(0, 1, layers + 1)], axis=1)


def rows(mesh: QuadMesh, columns: np.ndarray) -> np.ndarray:
    """Nodes of a sweep of the columns over a plane(): along the inner edge,
    away from it, and up.
    """
    n, levels = columns.shape[:2]
    along = len(np.unique(mesh.edges["inner"]))
    return np.arange(n).reshape(along, -1)[:, :, None] + n * np.arange(levels)


def _nearness(mesh: QuadMesh) -> np.ndarray:
    """1 at the inner edge, 0 at the periphery, in between by the distances."""
    inner, outer = (cKDTree(mesh.points[np.unique(mesh.edges[name])])
                    .query(mesh.points)[0] for name in ("inner", "periphery"))
    return outer / (inner + outer)
