"""What scripts/benchmark varies: one axis at a time around a base point."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable

from benchmark_runs import DEFAULTS, Run

PENALTY = DEFAULTS["penalty_factor"]
# Sizes at which meshes of each order have about as many unknowns as one of
# order 2 and size 1.
RELATIVE_SIZE = {("hex", 1): 2.0, ("hex", 2): 1.0, ("hex", 3): 0.67,
                 ("tet", 1): 2.0, ("tet", 2): 1.0, ("tet", 3): 0.67}


@dataclasses.dataclass(frozen=True)
class Point:
    """A run at a place of an axis."""

    series: str
    x: float
    run: Run


@dataclasses.dataclass(frozen=True)
class Sweep:
    """An axis and its points."""

    name: str
    label: str
    points: tuple[Point, ...]
    logarithmic: bool = True
    measured_by: str = ""    # a column that stands for x in plots, if not x
    base: float = 0.0        # x of the base point, if it is not the first


@dataclasses.dataclass(frozen=True)
class Extent:
    """How far sweeps go. Sizes are cells along an edge, for order 2."""

    base: int
    sizes: tuple[int, ...]
    large: int               # of the strong scaling
    each: int                # one rank's share in the weak scaling
    orders: tuple[tuple[str, int], ...]
    steps: tuple[float, ...]
    permeabilities: tuple[float, ...]
    poissons: tuple[float, ...]
    jumps: tuple[float, ...]
    penalties: tuple[float, ...]
    without_contact: bool    # on every axis, or at the base point alone


def decades(first: int, last: int, stride: int = 1) -> tuple[float, ...]:
    return tuple(10.0 ** i for i in range(first, last + 1, stride))


FULL = Extent(
    base=8, sizes=(6, 8, 12, 16), large=16, each=10,
    orders=(("hex", 1), ("hex", 2), ("hex", 3), ("tet", 1), ("tet", 2),
            ("tet", 3)),
    steps=decades(-3, 3), permeabilities=decades(-9, 1),
    poissons=(0.0, 0.1, 0.2, 0.3, 0.4, 0.45, 0.49), jumps=decades(0, 4),
    penalties=decades(0, 6), without_contact=True)
QUICK = Extent(
    base=4, sizes=(6, 8, 10), large=8, each=4,
    orders=(("hex", 1), ("hex", 2), ("hex", 3), ("tet", 2)),
    steps=(1e-3, 1.0, 1e3), permeabilities=(1e-9, 1e-5, 1e-3, 1e1),
    poissons=(0.0, 0.1, 0.49), jumps=(1.0, 1e2, 1e4),
    penalties=(1.0, 1e3, 1e6), without_contact=False)

# Of both deformations, where a run takes six steps.
FINITE = Extent(
    base=4, sizes=(4, 6), large=6, each=4, orders=FULL.orders,
    steps=(1e-3, 1.0, 1e3), permeabilities=(1e-9, 1e-5, 1e-3, 1e1),
    poissons=(0.0, 0.3, 0.4, 0.45, 0.49), jumps=(1.0, 1e2, 1e4),
    penalties=(1.0, 1e3), without_contact=True)
QUICK_FINITE = Extent(
    base=2, sizes=(2, 3), large=2, each=2, orders=(("hex", 1), ("tet", 2)),
    steps=(1.0, 1e3), permeabilities=(1e-3,), poissons=(0.1, 0.4),
    jumps=(1.0,), penalties=(1.0,), without_contact=True)


def scaled_size(elements: str, order: int, size: int) -> int:
    return max(2, round(RELATIVE_SIZE[elements, order] * size))


def contact_series(extent: Extent, axis: bool) -> Iterable[tuple[str, int]]:
    yield "contact", 1
    if axis and extent.without_contact:
        yield "no contact", 0


def along(extent: Extent, name: str, label: str, values: Iterable[float],
          options: Callable[[float], dict], logarithmic: bool = True,
          without: bool = True) -> Sweep:
    """One option varies, with contact and perhaps without."""
    points = tuple(
        Point(series, value, Run(**{"size": extent.base, "contact": contact}
                                 | options(value)))
        for series, contact in contact_series(extent, without)
        for value in values)
    return Sweep(name, label, points, logarithmic, base=DEFAULTS.get(name, 1.0))


def size_sweep(extent: Extent) -> Sweep:
    """The same unknowns by each order, and by the direct solver."""
    points = []
    for elements, order in extent.orders:
        for size in extent.sizes:
            run = Run(elements=elements, order=order,
                      size=scaled_size(elements, order, size))
            points.append(Point(f"{elements}, order {order}", size, run))
    if extent.without_contact:
        points += [Point("hex, order 2, no contact", size,
                         Run(size=size, contact=0)) for size in extent.sizes]
    return Sweep("size", "unknowns", tuple(points), measured_by="dofs")


def solver_sweep(extent: Extent) -> Sweep:
    """Both solvers as they are used, which spares accuracy while the active
    set changes."""
    points = tuple(
        Point(solver, size, Run(size=size, solver=solver,
                                active_set_tolerance=1e-4, steps=4))
        for solver in ("block_amg", "direct") for size in extent.sizes)
    return Sweep("solver", "unknowns", points, measured_by="dofs")


def strong_sweep(extent: Extent, ranks: Iterable[int]) -> Sweep:
    points = tuple(Point("strong", r, Run(r, size=extent.large))
                   for r in ranks)
    return Sweep("strong", "ranks", points)


def weak_sweep(extent: Extent, ranks: Iterable[int]) -> Sweep:
    points = tuple(
        Point("weak", r, Run(r, size=round(extent.each * r ** (1 / 3))))
        for r in ranks)
    return Sweep("weak", "ranks", points)


# Axes along which iterations have to stay flat.
FLAT = ("size", "permeability", "step", "poisson", "jump", "penalty", "strong",
        "weak")


def make_sweeps(extent: Extent, ranks: Iterable[int]) -> list[Sweep]:
    ranks = tuple(ranks)
    return [
        size_sweep(extent),
        along(extent, "permeability", "permeability (mm⁴/(N s))",
              extent.permeabilities, lambda x: {"permeability": x}),
        along(extent, "step", "time step (s)", extent.steps,
              lambda x: {"step": x}),
        along(extent, "poisson", "Poisson's ratio", extent.poissons,
              lambda x: {"poisson": x}, logarithmic=False),
        along(extent, "jump", "stiffness jump",
              extent.jumps, lambda x: {"jump": x}),
        along(extent, "penalty", "penalty over the default",
              extent.penalties, lambda x: {"penalty_factor": PENALTY * x},
              without=False),
        solver_sweep(extent),
        strong_sweep(extent, ranks),
        weak_sweep(extent, ranks)]
