"""The tables of timings that the documentation shows."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable

import numpy as np
from scipy.interpolate import PchipInterpolator

from benchmark_cases import CaseRunner, Cost
from benchmark_runs import BenchmarkError, Run, Runner
from readme_tables import Table


@dataclasses.dataclass(frozen=True)
class Benchmark:
    """What the tables are measured with."""

    cases: CaseRunner
    scaling: Runner
    quick: bool


@dataclasses.dataclass(frozen=True)
class Febio:
    """A case as FEBio 4.11 was measured with it: PARDISO, two threads."""

    title: str
    case: str
    seconds: int
    newton: str
    factorizations: str
    memory: str     # MB
    finite: dict[str, object]   # settings of what FEBio solves


FEBIO = (Febio("indentation, 5,100 hexahedra, 87 steps",
               "indentation_hexahedra.toml", 393, "393", "393", "456",
               {"material.0.solid.model": "neo_hookean",
                "material.1.solid.model": "neo_hookean",
                "contact.0.source": ["cartilage_top"],
                "contact.0.destination": ["indenter_bottom"],
                "contact.0.configuration": "current"}),
         Febio("glenohumeral, 2,784 hexahedra, 77 steps",
               "glenohumeral_hexahedra.toml", 223, "430", "not known",
               "not known",
               {f"material.{number}.{key}": value for number in (0, 1)
                for key, value in {"solid.model": "holmes_mow",
                                   "solid.beta": 0.35,
                                   "permeability.model": "holmes_mow",
                                   "permeability.M": 2.2,
                                   "permeability.alpha": 2.0}.items()}))
FINITE = {"physics.deformation": "finite"}


def febio_table(measure: Benchmark) -> Table:
    rows = []
    for other in FEBIO:
        mesh = measure.cases.mesh(other.case)
        for title, name, settings in (
                ("", "", {}),
                (", finite deformation", "_finite", FINITE | other.finite)):
            cost = measure.cases(
                other.case, mesh, other.case.removesuffix(".toml") + name,
                settings)
            rows.append((other.title + title, f"{other.seconds} s",
                         f"{cost.seconds:.2g} s",
                         f"{other.newton} and {cost.total('newton')}",
                         f"{other.factorizations} and "
                         f"{cost.total('factorisations')}",
                         f"{other.memory} and 2 x {cost.memory:.0f} MB"))
    return Table("febio", ("", "FEBio", "Synovia", "Newton iterations",
                           "factorizations", "memory"), tuple(rows))


def indentation_table(measure: Benchmark) -> Table:
    case = "indentation.toml"
    cost = measure.cases(case, measure.cases.mesh(case), "indentation", {})
    phases = ("linear systems", "their set-up", "output", "assembly",
              "contact search", "total")
    row = (f"{cost.unknowns:,}", str(cost.steps), str(cost.total("newton")),
           str(cost.total("factorisations")),
           *(f"{cost.phases[phase]:.1f} s" for phase in phases))
    return Table("indentation", ("unknowns", "steps", "Newton iterations",
                                 "factorizations", *phases), (row,))


INDENTER = "contact.indenter-cartilage.source_force_z"
CORNERS = (0.0, 500.0, 1500.0)     # of the indentation's load, s
# Title, scheme, step (s) or error tolerance.
MARCHES = (("backward Euler, fixed", "backward_euler", 25.0),
           ("SDIRK23, fixed", "sdirk23", 25.0),
           ("SDIRK33, fixed", "sdirk33", 50.0),
           ("SDIRK33, fixed", "sdirk33", 25.0),
           ("SDIRK33, fixed", "sdirk33", 12.5),
           ("SDIRK23, adaptive, `time.error_tolerance` 5e-3", "sdirk23", 5e-3),
           ("SDIRK33, adaptive, `time.error_tolerance` 2e-2", "sdirk33", 2e-2))


def errors(cost: Cost, exact: Cost) -> np.ndarray:
    """Of the force at each step, over the largest one.

    Between the reference's steps it is interpolated, but not across corners of
    the load.
    """
    t = np.r_[0.0, exact.history["t"]]
    force = np.r_[0.0, exact.history[INDENTER]]
    found = []
    for first, last in zip(CORNERS, CORNERS[1:]):
        part = (t >= first - 1e-6) & (t <= last + 1e-6)
        here = (cost.history["t"] > first + 1e-6) \
            & (cost.history["t"] <= last + 1e-6)
        found.append(cost.history[INDENTER][here] - PchipInterpolator(
            t[part], force[part], extrapolate=True)(cost.history["t"][here]))
    return np.concatenate(found) / np.abs(force).max()


def adaptive_table(measure: Benchmark) -> Table:
    case = "indentation.toml"
    mesh = measure.cases.mesh(case, "--size", "1.9")

    def march(name: str, scheme: str, number: float) -> Cost:
        settings = {"time.scheme": scheme, "output.fields_every": 0,
                    "output.checkpoint_every": 0}
        if number < 1.0:
            settings |= {"time.adaptive": True, "time.error_tolerance": number}
        else:
            settings |= {"time.step": number}
        return measure.cases(case, mesh, name, settings)

    exact = march("reference", "sdirk33", 5.0)
    rows = []
    for title, scheme, number in MARCHES:
        cost = march(f"{scheme}_{number:g}", scheme, number)
        error = 100 * np.abs(errors(cost, exact))
        rows.append((title, str(cost.steps), str(cost.total("newton")),
                     str(cost.total("factorisations")),
                     f"{error.max():.2f} %",
                     f"{np.sqrt((error**2).mean()):.2g} %"))
    return Table("adaptive", ("", "steps", "Newton iterations",
                              "factorizations", "largest error",
                              "root mean square"), tuple(rows))


# Order, cells along an edge, ranks, and whether it takes minutes.
SCALING = ((1, 16, 2, False), (1, 32, 2, False), (1, 69, 2, True),
           (1, 69, 1, True), (2, 8, 2, False), (2, 16, 2, False),
           (2, 36, 2, True))


def scaling_table(measure: Benchmark) -> Table:
    rows = []
    for order, size, ranks, long in SCALING:
        if long and measure.quick:
            continue
        size = max(2, round(size / measure.cases.coarsen))
        run = Run(ranks, order=order, size=size, steps=1,
                  active_set_tolerance=1e-3)
        print(f"   order {order}, size {size}, {ranks} ranks", flush=True)
        row = measure.scaling(run)
        if row["status"] != "ok":
            raise BenchmarkError(f"scaling, {run.key}: {row['status']}")
        rows.append((str(order), f"{int(row['dofs']):,}", str(ranks),
                     row["newton"], f"{row['linear']}, {row['most_linear']}",
                     f"{float(row['seconds_total']):.2g} s",
                     f"{float(row['memory_sum']) * 2**20 / 1e9:.2g} GB"))
    return Table("scaling", ("order", "unknowns", "ranks", "Newton",
                             "linear, most for one", "time", "memory"),
                 tuple(rows))


TABLES: dict[str, Callable[[Benchmark], Table]] = {
    "febio": febio_table, "indentation": indentation_table,
    "adaptive": adaptive_table, "scaling": scaling_table}
