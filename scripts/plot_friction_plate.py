#!/usr/bin/env python3
"""Pictures of a loaded column that slides on a plate as its fluid leaves.

Reads OUT, the output directory of miniapps/cases/friction_plate.toml, and draws

  coefficient.png     coefficient of friction against time
  support.png         share of the load that the fluid bears likewise
  line.png            the coefficient against that share
  friction_plate.png  all of them

with the reference of tests/reference: friction on the solid's share of the load,
mu (1 - (1 - phi) p/P), and the pressure p of confined creep in one dimension.
"""

from __future__ import annotations

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "lib"))

import missing_module  # noqa: E402,F401

import numpy as np  # noqa: E402

import figure_style as style  # noqa: E402
import plot_script  # noqa: E402
from figure_style import plt  # noqa: E402
from synovia_output import Output, OutputError, reference  # noqa: E402

PAIR = "contact.plate."


class Sliding:
    """A run, beside what is exact."""

    def __init__(self, out: Output):
        history = out.history()
        self.time = history["t"]
        self.support = history[PAIR + "fluid_load_support"]
        self.coefficient = history[PAIR + "friction_coefficient"]
        law = self._law(out)
        self.mu, self.phi = law["coefficient"], law.get("solid_fraction", 0.0)
        exact = reference("friction_creep.csv")
        known = exact["t"] <= self.time[-1] * (1 + 1e-9)
        self.exact_time = exact["t"][known]
        self.exact_support = exact["p_over_P"][known]

    @staticmethod
    def _law(out: Output) -> dict[str, float]:
        for pair in out.case().get("contact", []):
            if pair.get("name") == "plate" and "friction" in pair:
                return pair["friction"]
        raise OutputError(f"'{out.directory}' is no run of friction_plate.toml: "
                          "it has no friction of a pair \"plate\"")

    def friction_at(self, support: np.ndarray) -> np.ndarray:
        return self.mu * (1 - (1 - self.phi) * support)

    def draw_coefficient(self, axes: plt.Axes) -> None:
        axes.semilogx(self.time, self.coefficient, label="Synovia")
        axes.plot(self.exact_time, self.friction_at(self.exact_support),
                  label="reference", clip_on=False, **style.POINTS)
        axes.axhline(self.mu, label="without fluid", **style.REFERENCE)
        axes.set(xlabel="time", ylabel="coefficient of friction",
                 ylim=(0, None), title="Coefficient of friction")
        axes.legend()

    def draw_support(self, axes: plt.Axes) -> None:
        axes.semilogx(self.time, self.support, label="Synovia")
        axes.plot(self.exact_time, self.exact_support, label="reference",
                  clip_on=False, **style.POINTS)
        axes.set(xlabel="time", ylabel="share of the load", ylim=(0, 1.05),
                 title="Borne by the fluid")
        axes.legend()

    def draw_line(self, axes: plt.Axes) -> None:
        axes.plot(self.support, self.coefficient, "o", markersize=3.5,
                  label="Synovia, each step")
        share = np.array([0.0, 1.0])
        axes.plot(share, self.friction_at(share),
                  label=r"$\mu\,[1 - (1 - \varphi)\,p/P]$", **style.REFERENCE)
        axes.set(xlabel="borne by the fluid", ylabel="coefficient of friction",
                 xlim=(0, 1.02), ylim=(0, None), title="One on the other")
        axes.legend()

    def compared(self) -> str:
        lines = []
        for t, support in zip(self.exact_time, self.exact_support):
            found = np.interp(t, self.time, self.coefficient)
            wanted = self.friction_at(support)
            lines.append(f"friction at {t:g}: {found:.6f}, exact {wanted:.6f}, "
                         f"{100 * (found / wanted - 1):+.2f} %")
        return "\n".join(lines)


def draw(out: Output, folder: pathlib.Path) -> str:
    sliding = Sliding(out)
    plot_script.draw_row(folder, "friction_plate", {
        "coefficient": sliding.draw_coefficient,
        "support": sliding.draw_support, "line": sliding.draw_line})
    return sliding.compared()


def main(argv: list[str] | None = None) -> int:
    return plot_script.run(argv, __doc__, "friction_plate", draw)


if __name__ == "__main__":
    sys.exit(main())
