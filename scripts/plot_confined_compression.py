#!/usr/bin/env python3
"""Pictures of confined compression, in either deformation.

Reads OUT, the output directory of miniapps/cases/confined_compression.toml or
confined_compression_finite.toml, and draws

  stress.png          compressive stress on the platen against time
  pressure.png        fluid pressure through the thickness, at the sampled times
  displacement.png    displacement likewise
  confined_compression.png    all of them

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

WIDTH = 0.2     # of the column as the mesh script makes it, mm
FINITE = "finite_confined_holmesmow.csv"


def exact_stress(finite: bool) -> tuple[np.ndarray, np.ndarray]:
    table = reference(FINITE if finite else "confined_ramp_reaction.csv")
    return table["t"], (-table["stress"] if finite
                        else table["stress_compressive"])


def exact_pressure(finite: bool, t: float) -> Profile:
    if finite:
        return np.zeros(1), reference(FINITE).where("t", t)["p_base"]
    table = reference("confined_ramp_profile.csv").where("t", t)
    return table["z"], table["p"]


def exact_displacement(finite: bool, t: float) -> Profile:
    if finite:
        return np.full(1, 0.5), reference(FINITE).where("t", t)["u_mid"]
    table = reference("confined_ramp_profile.csv").where("t", t)
    return table["z"], table["u"]


def draw(out: Output, folder: pathlib.Path) -> str:
    finite = compression.is_finite(out)
    area = (WIDTH * out.case()["mesh"].get("scale", 1.0)) ** 2
    return compression.draw(folder, "confined_compression", {
        "stress": compression.Course(
            "reaction.top.z", -1.0 / area, exact_stress(finite)),
        "pressure": compression.Profiles(
            "depth", "z", "p", "height over the base $Z$ (mm)",
            "fluid pressure $p$ (kPa)", 1e3,
            lambda t: exact_pressure(finite, t)),
        "displacement": compression.Profiles(
            "depth", "z", "uz", "height over the base $Z$ (mm)",
            r"displacement $u_z$ ($\mu$m)", 1e3,
            lambda t: exact_displacement(finite, t))}, out)


def main(argv: list[str] | None = None) -> int:
    return plot_script.run(argv, __doc__, "confined_compression", draw)


if __name__ == "__main__":
    sys.exit(main())
