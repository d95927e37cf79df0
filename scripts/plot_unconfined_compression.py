#!/usr/bin/env python3
"""Pictures of unconfined compression, in either deformation.

Reads OUT, the output directory of miniapps/cases/unconfined_compression.toml or
unconfined_compression_finite.toml, and draws

  stress.png          mean compressive stress on the platen against time
  pressure.png        fluid pressure along the radius, at the sampled times
  displacement.png    radial displacement likewise
  unconfined_compression.png  all of them

with the references of tests/reference. Stresses are nominal: forces over the
area as meshed. Units are mm, N, s, MPa.
"""

from __future__ import annotations

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "lib"))

import missing_module  # noqa: E402,F401

import numpy as np  # noqa: E402

import compression  # noqa: E402
import plot_script  # noqa: E402
from compression import Profile  # noqa: E402
from synovia_output import Output, reference  # noqa: E402

RADIUS = 1.5    # mm
QUARTER = np.pi / 4 * RADIUS**2
FINITE = "finite_unconfined_holmesmow.csv"
RAMP = "unconfined_ramp_force.csv"


def exact_stress(finite: bool) -> tuple[np.ndarray, np.ndarray]:
    table = reference(FINITE if finite else RAMP)
    return table["t"], (-1.0 if finite else 1.0) * table["mean_stress"]


def exact_pressure(finite: bool, t: float) -> Profile:
    if finite:
        return np.zeros(1), reference(FINITE).where("t", t)["p_axis"]
    table = reference("unconfined_ramp_p.csv").where("t", t)
    return table["r"], table["p"]


def exact_displacement(finite: bool, t: float) -> Profile:
    name, column = (FINITE, "u_r_side") if finite else (RAMP, "ur_edge")
    return np.full(1, RADIUS), reference(name).where("t", t)[column]


def draw(out: Output, folder: pathlib.Path) -> str:
    finite = compression.is_finite(out)
    return compression.draw(folder, "unconfined_compression", {
        "stress": compression.Course(
            "reaction.top.z", -1.0 / QUARTER, exact_stress(finite)),
        "pressure": compression.Profiles(
            "radius", "x", "p", "radius $R$ (mm)", "fluid pressure $p$ (kPa)",
            1e3, lambda t: exact_pressure(finite, t)),
        "displacement": compression.Profiles(
            "radius", "x", "ux", "radius $R$ (mm)",
            r"radial displacement $u_r$ ($\mu$m)", 1e3,
            lambda t: exact_displacement(finite, t))}, out)


def main(argv: list[str] | None = None) -> int:
    return plot_script.run(argv, __doc__, "unconfined_compression", draw)


if __name__ == "__main__":
    sys.exit(main())
