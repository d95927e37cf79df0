"""What a run of a knee found: its bodies by name, forces and slices.

The contact pairs are those of miniapps/cases/knee.toml, and tell which body is
which: each one's fields lie on its destination.
"""

from __future__ import annotations

import dataclasses
import functools
import pathlib
import tomllib

import numpy as np
from scipy.spatial import cKDTree

import knee_views
import report_history
import section
from synovia_output import Output, OutputError

LOADED = 100.0          # the end of the displacement, s
NEAR_ENOUGH = 0.05      # fields may be off by this part of that time
LARGE_STRAIN = 0.1      # for which infinitesimal strain is not meant
SIDES = ("medial", "lateral")
KINDS = ("femur-tibia", "meniscus-femur", "tibia-meniscus")
PAIRS = tuple(f"{kind}-{side}" for kind in KINDS for side in SIDES)
# Of what a pair's fields are: all but the femur have one.
DESTINATIONS = {"femur-tibia": "tibial_cartilage", "tibia-meniscus": "meniscus"}
FEMUR = "femoral_cartilage"
TIBIAE = tuple(f"tibial_cartilage_{side}" for side in SIDES)
FIELDS = ("displacement", "fluid_pressure", "total_stress", "attribute")


@dataclasses.dataclass(frozen=True)
class Slice:
    """Sections of the plane y = at: a meniscus' body, and its neighbors."""

    at: float
    meniscus: object
    others: list
    outwards: float         # the sign of x from the knee's middle to the side

    def share_of_width(self, point: int) -> float:
        """Where a point of the meniscus is: 0 at its inner edge, 1 outside."""
        x = self.outwards * self.meniscus.points[:, 0]
        return (x[point] - x.min()) / np.ptp(x)


class Knee:
    """A run, and its fields when the load is whole.

    A run that has not come that far yet gives those of the latest time.
    """

    def __init__(self, out: Output, loaded: float = LOADED):
        self.out = out
        self.loaded = loaded
        self.history = out.history()
        there = report_history.pair_names(self.history)
        missing = [pair for pair in PAIRS if pair not in there]
        if missing:
            raise OutputError(
                f"'{self.history.file}' has no contact pair "
                f"{', '.join(missing)}; there are: "
                f"{', '.join(there) or 'none at all'}")
        self.times = out.field_times("bodies")
        self.time = self._time()

    def _time(self) -> float:
        time = min(self.times, key=lambda t: abs(t - self.loaded),
                   default=np.inf)
        unfinished = self.times and self.times[-1] < self.loaded
        if abs(time - self.loaded) > self._slack and not unfinished:
            raise OutputError(
                f"'{self.out.directory}' has no fields near t = "
                f"{self.loaded:g}, only at "
                f"{', '.join(f'{t:g}' for t in self.times) or 'no time'}")
        return time

    @functools.cached_property
    def finite(self) -> bool:
        """Whether the run was one of finite deformation."""
        file = pathlib.Path(self.out.directory) / "case.toml"
        if not file.exists():
            return False
        case = tomllib.loads(file.read_text(encoding="utf-8"))
        return case.get("physics", {}).get("deformation") == "finite"

    @property
    def _slack(self) -> float:
        return NEAR_ENOUGH * self.loaded

    def stopped_early(self) -> bool:
        return self.time < self.loaded - self._slack

    @functools.cached_property
    def bodies(self) -> knee_views.Bodies:
        return self.bodies_at(self.time)

    def bodies_at(self, time: float) -> knee_views.Bodies:
        """By the names of their regions, without copies of shared nodes."""
        grid = self._grid(time)
        return {name: section.merged(
                    grid.extract_cells(grid["attribute"] == region))
                for name, region in self._regions.items()}

    def _grid(self, time: float):
        grid = self.out.fields("bodies", time)
        section.require_fields(grid, FIELDS, self.out.directory)
        return grid

    @functools.cached_property
    def _regions(self) -> dict[str, int]:
        """The regions' numbers, which the fields have, by their names."""
        grid = self._grid(self.time)
        trees = {int(body["attribute"][0]): cKDTree(body.points)
                 for body in section.bodies_of(grid)}
        found = {}
        for kind, tissue in DESTINATIONS.items():
            for side in SIDES:
                name = f"contact_{kind}-{side}"
                surface = self.surface(f"{kind}-{side}")
                off = {region: tree.query(surface.points)[0].max()
                       for region, tree in trees.items()}
                region = min(off, key=off.__getitem__)
                if off[region] > 1e-4 * grid.length:
                    raise OutputError(
                        f"the fields '{name}' of '{self.out.directory}' lie "
                        "on no body")
                found[f"{tissue}_{side}"] = region
        femur = trees.keys() - found.values()
        if len(set(found.values())) < len(found) or len(femur) != 1:
            raise OutputError(
                f"the {len(trees)} bodies of '{self.out.directory}' are not a "
                "knee's femoral cartilage, two tibial ones and two menisci")
        return {FEMUR: femur.pop(), **found}

    def surface(self, pair: str, time: float | None = None):
        """The pair's destination, undeformed, with its fields of a time."""
        name = f"contact_{pair}"
        times = self.out.field_times(name)
        if not times:
            raise OutputError(f"the collection '{name}' of "
                              f"'{self.out.directory}' has no times")
        return self.out.fields(name, times[0] if time is None else time)

    @functools.cached_property
    def surfaces(self) -> dict[str, object]:
        return {name: surface_of(body) for name, body in self.bodies.items()}

    def outline(self, pair: str, time: float | None = None
                ) -> list[np.ndarray]:
        """Points on the deformed edges of a pair's destination.

        The coordinates of each edge in turn: lines that needn't be joined.
        """
        surface = self.deformed_surface(
            pair, self.time if time is None else time)
        edges = surface.extract_feature_edges(
            boundary_edges=True, feature_edges=False, manifold_edges=False,
            non_manifold_edges=False)
        strips = edges.strip(join=True)
        return [strips.points[strip] for strip in split_lines(strips.lines)]

    def deformed_surface(self, pair: str, time: float):
        """A pair's destination where it is at a time, with its fields."""
        surface = section.merged(self.surface(pair, time)).extract_surface(
            nonlinear_subdivision=1).triangulate()
        kind, side = pair.rsplit("-", 1)
        tissue = DESTINATIONS.get(kind, "meniscus")
        body = (self.bodies if time == self.time
                else self.bodies_at(time))[f"{tissue}_{side}"]
        nearest = cKDTree(body.points).query(surface.points)[1]
        surface.points += body["displacement"][nearest]
        return surface

    @functools.cached_property
    def slices(self) -> dict[str, Slice]:
        """By side: in the frontal plane halfway between front and back.

        It meets the meniscus, a part of a ring, where its circumference runs
        from front to back, away from the knee's middle and the horns.
        """
        return {side: self._slice(side) for side in SIDES}

    def _slice(self, side: str) -> Slice:
        meniscus = self.bodies[f"meniscus_{side}"]
        at = meniscus.center[1]
        outwards = np.sign(meniscus.center[0] - self.middle_x())
        part = section.cut([meniscus], normal=1, at=at)[0]
        others = [section.cut([self.bodies[name]], normal=1, at=at)[0]
                  for name in (FEMUR, f"tibial_cartilage_{side}")]
        return Slice(at, outermost(part, outwards), others, outwards)

    def middle_x(self) -> float:
        """Between the menisci."""
        return float(np.mean([body.center[0]
                              for body in knee_views.menisci(self.bodies)]))

    def force(self, kinds: tuple[str, ...] = KINDS[:2],
              sides: tuple[str, ...] = SIDES) -> np.ndarray:
        """Compressive, on what the femoral cartilage touches.

        All of it goes through the tibial cartilage (the pairs femur-tibia) or
        the menisci (meniscus-femur) of a side.
        """
        return -np.sum([self.history[f"contact.{kind}-{side}.force_z"]
                        for kind in kinds for side in sides], axis=0)

    def share(self, part: np.ndarray) -> np.ndarray:
        """Of the force, in %; nothing before there is one."""
        force = self.force()
        some = force > 0.01 * force.max()
        return np.divide(100 * part, force, out=np.full(force.shape, np.nan),
                         where=some)

    def strains(self) -> tuple[float, float] | None:
        """The largest principal strain and the smallest det F of the pictures'
        time, where they were recorded."""
        columns = ("strain.max_principal", "strain.min_det_F")
        if any(column not in self.history for column in columns):
            return None
        i = int(np.argmin(np.abs(self.history["t"] - self.time)))
        return tuple(float(self.history[column][i]) for column in columns)

    def peak_pressures(self) -> dict[str, np.ndarray] | None:
        """Of the fluid in each pair's contact, where that was recorded."""
        recorded = all(f"contact.{pair}.peak_pressure" in self.history
                       for pair in PAIRS)
        return self.of_pairs("peak_pressure") if recorded else None

    def of_pairs(self, name: str) -> dict[str, np.ndarray]:
        """A column of each pair."""
        return {pair: self.history[f"contact.{pair}.{name}"] for pair in PAIRS}


def outermost(part, outwards: float):
    """The piece of a section that lies farthest to a side in x."""
    pieces = part.connectivity("all")
    label = pieces.point_data["RegionId"]
    far = max(np.unique(label), key=lambda piece: outwards
              * pieces.points[label == piece, 0].mean())
    return pieces.extract_points(label == far).extract_surface().triangulate()


def load_colors(surfaces: list, values: list[np.ndarray], sign: int,
                 beyond: float = 0.01) -> dict:
    """A map and limits from nothing, dark, to the greatest load, bright.

    sign: of values where there is a load: 1 of a pressure, -1 of a stress.
    Those of the other sign are beyond the colors.
    """
    colors = section.color_range(surfaces, values, beyond)
    size = max(abs(colors["vmin"]), abs(colors["vmax"]))
    return {"cmap": "viridis" if sign > 0 else "viridis_r",
            "vmin": min(0.0, sign * size), "vmax": max(0.0, sign * size)}


def surface_of(body):
    """The deformed surface of a body, with the normal stress on it.

    That is n.sigma.n with the total stress sigma and the undeformed surface's
    normal n, in "normal_stress".
    """
    surface = body.extract_surface(nonlinear_subdivision=1).triangulate()
    surface = surface.compute_normals(
        cell_normals=False, split_vertices=True, feature_angle=40,
        auto_orient_normals=False, consistent_normals=True)
    surface["normal_stress"] = normal_stress(surface["total_stress"],
                                             surface["Normals"])
    return deformed(surface)


def normal_stress(stress: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """Of (n, 6) xx, yy, zz, xy, yz, xz, and (n, 3)."""
    xx, yy, zz, xy, yz, xz = stress.T
    x, y, z = normal.T
    return (xx * x**2 + yy * y**2 + zz * z**2
            + 2 * (xy * x * y + yz * y * z + xz * x * z))


def split_lines(cells: np.ndarray) -> list[np.ndarray]:
    """VTK's list of lengths and numbers of points, as lists of the latter."""
    lines = []
    while cells.size:
        end = cells[0] + 1
        lines.append(cells[1:end])
        cells = cells[end:]
    return lines


def deformed(solid):
    after = solid.copy()
    after.points = solid.points + solid["displacement"]
    return after
