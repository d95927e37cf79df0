#!/usr/bin/env python3
"""Pictures of flat-ended indentation (Guo and Spilker 2014, section 3.1).

Reads OUT, the output directory of miniapps/indentation.cpp, and draws

  shear_stress.png    shear stress against radius at three depths, 500 s
  fluid_pressure.png  fluid pressure likewise, with the reference on the axis
  axial_stress.png    axial stress in the deformed bodies, 250 s
  contact_stress.png  axial stress of both bodies along the contact, 250 s
  force.png           force on the indenter against time
  axis_pressure.png   fluid pressure along the axis, 500 s
  indentation.png     all of them

References are those of a rigid, freely draining punch on a layer of infinite
width (tests/reference). Units are mm, N, s, MPa; tension is positive.
"""

from __future__ import annotations

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "lib"))

import missing_module  # noqa: E402,F401

import numpy as np  # noqa: E402

import figure_style as style  # noqa: E402
import plot_script  # noqa: E402
import section  # noqa: E402
from figure_style import plt  # noqa: E402
from synovia_output import (  # noqa: E402
    Output, interpolate, reference)

RADIUS = 0.75           # of the indenter, mm
THICKNESS = 0.75        # of the cartilage, mm
HOLD, HALFWAY = 500.0, 250.0    # s
QUARTERS = 4            # the model is a quarter of the cylinder

LEVELS = {"cartilage_top": "top", "cartilage_middle": "middle",
          "cartilage_bottom": "bottom"}


def exact_label(out: Output) -> str:
    """The references are of infinitesimal strain."""
    physics = out.case().get("physics", {})
    return ("exact, small strain" if physics.get("deformation") == "finite"
            else "exact, rigid punch")


def exact_axis_pressure(time: float) -> dict[str, np.ndarray]:
    """Columns z and p; the table leaves out the surface, where p = 0."""
    table = reference("indent_axis.csv").where("t", time)
    order = np.argsort(table["z"])
    return {"z": np.append(table["z"][order], THICKNESS),
            "p": np.append(table["p"][order], 0.0)}


def mark_rim(axes: plt.Axes) -> None:
    axes.axvline(RADIUS, color=style.GRAY, linewidth=0.7,
                 linestyle=(0, (1, 2)))


def finish_radial(axes: plt.Axes, lines: list, quantity: str) -> None:
    mark_rim(axes)
    axes.axhline(0, color=style.GRAY, linewidth=0.6)
    axes.set(xlabel="radius $r$ (mm)", ylabel=quantity,
             xlim=(0, max(line["x"].max() for line in lines)))
    axes.legend(loc="best")


def shear_stress(axes: plt.Axes, out: Output) -> None:
    lines = []
    for name, label in LEVELS.items():
        line = out.line(name, HOLD)
        lines.append(line)
        axes.plot(line["x"], 1e3 * line["sxz"],
                  label=f"{label}, $z$ = {line['z'][0]:.3g} mm")
    finish_radial(axes, lines, r"shear stress $\sigma_{rz}$ (kPa)")
    axes.set_title(f"Shear stress, {HOLD:g} s")


def fluid_pressure(axes: plt.Axes, out: Output) -> None:
    exact = exact_axis_pressure(HOLD)
    lines = []
    for name, label in LEVELS.items():
        line = out.line(name, HOLD)
        lines.append(line)
        z = line["z"][0]
        axes.plot(line["x"], 1e3 * line["p"],
                  label=f"{label}, $z$ = {z:.3g} mm")
        axes.plot(0, 1e3 * interpolate(z, exact, "z", "p"), "k_",
                  markersize=12, clip_on=False, zorder=4,
                  label=exact_label(out) if len(lines) == len(LEVELS)
                  else None)
    finish_radial(axes, lines, "fluid pressure $p$ (kPa)")
    axes.set_title(f"Fluid pressure, {HOLD:g} s")


def axial_stress(axes: plt.Axes, out: Output) -> None:
    """The section y = 0 after its displacement, over the initial outline."""
    grid = out.fields("bodies", HALFWAY)
    section.require_fields(
        grid, ("displacement", "total_stress", "attribute"), out.directory)
    sections = section.cut(section.bodies_of(grid), normal=1, at=0.0)

    # The stress at the rim has no bound; the colors are for the rest of it.
    on_axis = reference("indent_surface.csv").where("t", HALFWAY)["szz"][0]
    section.draw_section(
        axes, sections, [0, 2],
        [1e3 * part["total_stress"][:, 2] for part in sections],
        r"$\sigma_{zz}$ (kPa)", cmap="viridis", vmin=2e3 * on_axis, vmax=0)
    axes.set(xlabel="$x$ (mm)", ylabel="$z$ (mm)",
             title=f"Axial stress, {HALFWAY:g} s, true displacement")
    axes.plot([], [], label="before", **section.BEFORE)
    axes.legend(loc="upper right")


def contact_stress(axes: plt.Axes, out: Output) -> None:
    exact = reference("indent_surface.csv").where("t", HALFWAY)
    inside = exact["r"] < RADIUS
    for name, label, look in (
            ("contact_cartilage", "cartilage", {"linewidth": 2.4}),
            ("contact_indenter", "indenter", {"linewidth": 1.2})):
        line = out.line(name, HALFWAY)
        axes.plot(line["x"], 1e3 * line["szz"], label=label, **look)
    axes.plot(exact["r"][inside], 1e3 * exact["szz"][inside],
              label=exact_label(out), **style.REFERENCE)
    mark_rim(axes)
    # The stress at the rim has no bound, here and in the exact solution.
    axes.set(xlabel="radius $r$ (mm)", xlim=(0, 1.04 * RADIUS),
             ylim=(4e3 * exact["szz"][0], 0),
             ylabel=r"axial stress $\sigma_{zz}$ (kPa)",
             title=f"Along the contact, {HALFWAY:g} s")
    axes.legend(loc="lower left")


def force(axes: plt.Axes, out: Output) -> None:
    time, value = force_history(out)
    exact = reference("indent_force.csv")
    axes.plot(time, value, label="Synovia")
    axes.plot(np.r_[0, exact["t"]], np.r_[0, exact["F_permeable"]],
              label=exact_label(out), **style.REFERENCE)
    axes.set(xlabel="time (s)", ylabel="force (N)", xlim=(0, time.max()),
             ylim=(0, None), title="Force on the indenter")
    axes.legend(loc="lower right")


def force_history(out: Output) -> tuple[np.ndarray, np.ndarray]:
    """Times and the compressive force on the whole cylinder, from rest.

    The reaction is the force of the support on the body.
    """
    history = out.history()
    return (np.r_[0, history["t"]],
            np.r_[0, -QUARTERS * history["reaction.indenter_top.z"]])


def axis_pressure(axes: plt.Axes, out: Output) -> None:
    line = out.line("axis", HOLD)
    exact = exact_axis_pressure(HOLD)
    axes.plot(1e3 * line["p"], line["z"], label="Synovia")
    axes.plot(1e3 * exact["p"], exact["z"], label=exact_label(out),
              **style.REFERENCE)
    axes.set(xlabel="fluid pressure $p$ (kPa)",
             ylabel="height over bone $z$ (mm)", xlim=(0, None),
             ylim=(0, line["z"].max()), title=f"On the axis, {HOLD:g} s")
    axes.legend(loc="lower left")


PANELS = {"shear_stress": shear_stress, "fluid_pressure": fluid_pressure,
          "axial_stress": axial_stress, "contact_stress": contact_stress,
          "force": force, "axis_pressure": axis_pressure}


def compare(out: Output) -> str:
    """The numbers behind the pictures, against the exact ones."""
    lines = []
    time, value = force_history(out)
    exact = reference("indent_force.csv")
    for t in (HALFWAY, HOLD, 1500.0):
        if t <= time.max():
            wanted = exact.where("t", t)["F_permeable"][0]
            found = np.interp(t, time, value)
            lines.append(f"force at {t:g} s: {found:.6f} N, exact {wanted:.6f}"
                         f" N, {100 * (found / wanted - 1):+.2f} %")
    axis = out.line("axis", HOLD)
    at = exact_axis_pressure(HOLD)
    for z in (0.4, 0.0):    # rows of the table, exact to its last digit
        wanted = interpolate(z, at, "z", "p")
        found = interpolate(z, axis, "z", "p")
        lines.append(f"pressure on the axis at {HOLD:g} s, z = {z:g} mm: "
                     f"{found:.6f} MPa, exact {wanted:.6f} MPa, "
                     f"{100 * (found / wanted - 1):+.2f} %")
    return "\n".join(lines)


def draw(out: Output, folder: pathlib.Path) -> None:
    style.use_style()
    for name, panel in PANELS.items():
        wide = name == "axial_stress"
        figure, axes = plt.subplots(figsize=(5.2, 3.4) if wide else (3.6, 2.9))
        panel(axes, out)
        figure.savefig(folder / f"{name}.png", bbox_inches="tight")
        plt.close(figure)
    figure = plt.figure(figsize=(11, 6.4))
    for i, (name, panel) in enumerate(PANELS.items()):
        axes = figure.add_subplot(2, 3, i + 1)
        panel(axes, out)
        axes.set_title(f"({'abcdef'[i]}) {axes.get_title(loc='left')}")
    figure.savefig(folder / "indentation.png")
    plt.close(figure)


def pictures(out: Output, folder: pathlib.Path) -> str:
    draw(out, folder)
    return compare(out)


def main(argv: list[str] | None = None) -> int:
    return plot_script.run(argv, __doc__, "indentation", pictures)


if __name__ == "__main__":
    sys.exit(main())
