#!/usr/bin/env python3
"""Pictures of the glenohumeral joint (Guo and Spilker 2014, section 3.2).

Reads OUT, the output directory of miniapps/cases/glenohumeral.toml, and draws

  displacement.png      axial displacement in the deformed layers, 10 s
  fluid_pressure.png    fluid pressure likewise
  max_principal.png     maximum principal effective stress likewise
  min_principal.png     minimum principal effective stress likewise
  axis_pressure.png     fluid pressure along the axis, at the sampled times
  force.png             contact force against time
  radius.png            radius of the contact against time
  peak_pressure.png     peak fluid pressure against time
  glenohumeral.png      all of them

in the plane y = 0. Units are mm, N, s, MPa; tension is positive. Forces are
those of the whole joint, also where a quarter was modeled.
"""

from __future__ import annotations

import functools
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "lib"))

import missing_module  # noqa: E402,F401

import numpy as np  # noqa: E402

import figure_style as style  # noqa: E402
import plot_script  # noqa: E402
import section  # noqa: E402
from figure_style import plt  # noqa: E402
from synovia_output import Output, OutputError, Table  # noqa: E402

LOADED = 10.0           # the end of the displacement, s
NEAR_ENOUGH = 1.0       # fields may be off by this, s
GLENOID_RADIUS = 26.0   # of the destination's surface, mm
BEYOND = 1.18           # what is shown, over the smaller body's width
PAIR = "contact.joint."


def principal_values(stress: np.ndarray) -> np.ndarray:
    """Ascending eigenvalues of (n, 6) xx, yy, zz, xy, yz, xz."""
    xx, yy, zz, xy, yz, xz = stress.T
    return np.linalg.eigvalsh(np.stack(
        [np.stack(row, axis=-1)
         for row in ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))], axis=-2))


class Joint:
    """A run of the joint."""

    def __init__(self, out: Output):
        self.out = out
        self.history = out.history()
        # The quarter has planes of symmetry.
        self.copies = 4 if "reaction.symmetry_x.x" in self.history else 1
        times = out.field_times("bodies")
        self.time = min(times, key=lambda t: abs(t - LOADED), default=np.inf)
        if abs(self.time - LOADED) > NEAR_ENOUGH:
            raise OutputError(
                f"'{out.directory}' has no fields near t = {LOADED:g}, only "
                f"at {', '.join(f'{t:g}' for t in times) or 'no time'}")

    @functools.cached_property
    def grid(self):
        grid = self.out.fields("bodies", self.time)
        section.require_fields(grid, ("displacement", "fluid_pressure",
                                      "effective_stress", "attribute"),
                               self.out.directory)
        return grid

    @functools.cached_property
    def sections(self) -> list:
        return section.cut(section.bodies_of(self.grid), normal=1, at=0.0)

    @functools.cached_property
    def principal(self) -> list[np.ndarray]:
        """Ascending principal effective stresses of each section."""
        return [principal_values(part["effective_stress"])
                for part in self.sections]

    def force(self) -> np.ndarray:
        """Compressive, of the whole joint."""
        return -self.copies * self.history[f"{PAIR}force_z"]

    def contact_radius(self) -> np.ndarray:
        """Of the circle that bounds a cap of the contact's area."""
        area = self.copies * self.history[f"{PAIR}area"]
        part_of_sphere = area / (4 * np.pi * GLENOID_RADIUS**2)
        return np.sqrt(area / np.pi * (1 - part_of_sphere))

    def axis_lines(self) -> list[tuple[float, Table, Table]]:
        """Times, and the profiles in the glenoid and the humeral layer."""
        lines = self.out.lines()
        glenoid, humeral = (dict(lines.get(name, ())) for name in
                            ("axis_glenoid", "axis_humeral"))
        times = sorted(glenoid.keys() & humeral.keys())
        if not times:
            raise OutputError(f"'{self.out.directory}' has no lines "
                              "axis_glenoid and axis_humeral")
        return [(t, Table(glenoid[t]), Table(humeral[t])) for t in times]


def draw_field(axes: plt.Axes, joint: Joint, values: list, title: str,
               label: str, **colors) -> None:
    section.draw_section(axes, joint.sections, [0, 2], values, label,
                         **(section.color_range(joint.sections, values)
                            | colors))
    narrow = min(joint.sections, key=lambda part: part.bounds[1])
    right = BEYOND * narrow.bounds[1]
    left = -right if joint.copies == 1 else 0.0
    points = np.vstack([part.points for part in joint.sections])
    shown = points[np.abs(points[:, 0]) <= right]
    # The humeral layer goes on beyond the picture's right side.
    axes.set(xlim=(left - 0.01 * right, right),
             ylim=(shown[:, 2].min() - 0.25, shown[:, 2].max() + 0.1),
             xlabel="$x$ (mm)", ylabel="$z$ (mm)",
             title=f"{title}, {joint.time:g} s")
    axes.plot([], [], label="before", **section.BEFORE)
    axes.plot([], [], label="after", **section.AFTER)
    axes.legend(loc="upper left")


def displacement(axes: plt.Axes, joint: Joint) -> None:
    values = [part["displacement"][:, 2] for part in joint.sections]
    size = max(np.abs(value).max() for value in values)
    draw_field(axes, joint, values, "Axial displacement", "$u_z$ (mm)",
               cmap="RdBu_r", vmin=-size, vmax=size)


def fluid_pressure(axes: plt.Axes, joint: Joint) -> None:
    draw_field(axes, joint,
               [part["fluid_pressure"] for part in joint.sections],
               "Fluid pressure", "$p$ (MPa)")


def max_principal(axes: plt.Axes, joint: Joint) -> None:
    draw_field(axes, joint, [1e3 * value[:, 2] for value in joint.principal],
               "Maximum principal effective stress", r"$\sigma^E_1$ (kPa)")


def min_principal(axes: plt.Axes, joint: Joint) -> None:
    draw_field(axes, joint, [1e3 * value[:, 0] for value in joint.principal],
               "Minimum principal effective stress", r"$\sigma^E_3$ (kPa)")


def axis_pressure(axes: plt.Axes, joint: Joint) -> None:
    lines = joint.axis_lines()
    colors = plt.get_cmap("viridis")(np.linspace(0, 0.85, len(lines)))
    for (time, *layers), color in zip(lines, colors):
        for layer in layers:
            axes.plot(layer["z"] + layer["uz"], layer["p"], color=color,
                      label=None if layer is layers[1] else f"{time:g} s")
    axes.set(xlabel="deformed $z$ (mm)", ylabel="fluid pressure $p$ (MPa)",
             title="On the axis")
    axes.set_ylim(min(0.0, axes.get_ylim()[0]), None)
    axes.legend(loc="best")


def against_time(axes: plt.Axes, joint: Joint, values: np.ndarray, title: str,
                 label: str) -> None:
    time = joint.history["t"]
    axes.plot(np.r_[0, time], np.r_[0, values])
    axes.axvline(LOADED, color=style.GRAY, linewidth=0.7,
                 linestyle=(0, (1, 2)))
    axes.set(xlabel="time (s)", ylabel=label, xlim=(0, time.max()),
             ylim=(0, None), title=title)


def force(axes: plt.Axes, joint: Joint) -> None:
    against_time(axes, joint, joint.force(), "Contact force", "force (N)")


def radius(axes: plt.Axes, joint: Joint) -> None:
    against_time(axes, joint, joint.contact_radius(), "Contact radius",
                 "radius (mm)")


def peak_pressure(axes: plt.Axes, joint: Joint) -> None:
    against_time(axes, joint, joint.history["fluid.peak_pressure"],
                 "Peak fluid pressure", "$p$ (MPa)")


FIELDS = {"displacement": displacement, "fluid_pressure": fluid_pressure,
          "max_principal": max_principal, "min_principal": min_principal}
CURVES = {"axis_pressure": axis_pressure, "force": force, "radius": radius,
          "peak_pressure": peak_pressure}


def findings(joint: Joint) -> str:
    """What the paper finds, in this run's numbers."""
    lines = []
    history = joint.history
    for t in (1.0, LOADED, float(history["t"][-1])):
        i = int(np.argmin(np.abs(history["t"] - t)))
        lines.append(f"t = {history['t'][i]:g} s: force "
                     f"{joint.force()[i]:.6g} N, contact radius "
                     f"{joint.contact_radius()[i]:.4g} mm, peak pressure "
                     f"{history['fluid.peak_pressure'][i]:.6g} MPa")
    for time, glenoid, humeral in joint.axis_lines():
        # The layers meet at the end of one and the start of the other.
        below, above = np.argmax(glenoid["z"]), np.argmin(humeral["z"])
        p, q = glenoid["p"][below], humeral["p"][above]
        stress = glenoid["szz"][below]
        lines.append(f"on the axis at the contact, {time:g} s: pressure "
                     f"{p:.6g} and {q:.6g} MPa, {-100 * p / stress:.1f} % of "
                     "the normal stress" if stress < 0 else
                     f"no contact on the axis, {time:g} s")
    for name, column, best in (("maximum", 2, np.argmax),
                               ("minimum", 0, np.argmin)):
        for part, values in zip(joint.sections, joint.principal):
            i = best(values[:, column])
            x, _, z = part.points[i]
            lines.append(f"{name} principal effective stress between z = "
                         f"{part.bounds[4]:.3g} and {part.bounds[5]:.3g} mm: "
                         f"{1e3 * values[i, column]:.4g} kPa at r = "
                         f"{abs(x):.3g}, z = {z:.3g} mm")
    return "\n".join(lines)


def draw(joint: Joint, folder: pathlib.Path) -> None:
    style.use_style()
    for panels, size in ((FIELDS, (5.2, 3.6)), (CURVES, (3.6, 2.9))):
        for name, panel in panels.items():
            figure, axes = plt.subplots(figsize=size)
            panel(axes, joint)
            figure.savefig(folder / f"{name}.png", bbox_inches="tight")
            plt.close(figure)
    figure = plt.figure(figsize=(11, 9.6))
    rows = figure.add_gridspec(3, 4, height_ratios=(1.35, 1.35, 1))
    places = [rows[i, j:j + 2] for i in (0, 1) for j in (0, 2)]
    places += [rows[2, j] for j in range(4)]
    for letter, place, panel in zip(
            "abcdefgh", places, (FIELDS | CURVES).values()):
        axes = figure.add_subplot(place)
        panel(axes, joint)
        axes.set_title(f"({letter}) {axes.get_title(loc='left')}")
    figure.savefig(folder / "glenohumeral.png")
    plt.close(figure)


def pictures(out: Output, folder: pathlib.Path) -> str:
    joint = Joint(out)
    draw(joint, folder)
    return findings(joint)


def main(argv: list[str] | None = None) -> int:
    return plot_script.run(argv, __doc__, "glenohumeral", pictures)


if __name__ == "__main__":
    sys.exit(main())
