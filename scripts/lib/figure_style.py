"""How figures look: colors of Okabe and Ito, which all can tell apart."""

from __future__ import annotations

import matplotlib

matplotlib.use("Agg")   # figures go to files, on machines without a screen

import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.ticker import ScalarFormatter  # noqa: E402

BLUE, ORANGE, GREEN, RED, SKY, PINK = (
    "#0072B2", "#E69F00", "#009E73", "#D55E00", "#56B4E9", "#CC79A7")
GRAY = "#666666"

# References are thin, dark and over what is compared with them.
REFERENCE = {"color": "black", "linewidth": 0.9, "linestyle": (0, (4, 2)),
             "zorder": 3}
# So are single values of one, as circles.
POINTS = {"color": "black", "marker": "o", "markersize": 4.5, "zorder": 4,
          "markerfacecolor": "none", "linestyle": "none"}


def use_style() -> None:
    plt.rcParams.update({
        "font.family": "sans-serif", "font.size": 9,
        "axes.titlesize": 9.5, "axes.titlelocation": "left",
        "axes.spines.top": False, "axes.spines.right": False,
        "axes.linewidth": 0.8, "axes.prop_cycle":
            plt.cycler(color=[BLUE, ORANGE, GREEN, RED, SKY, PINK]),
        "axes.formatter.use_mathtext": True,
        "lines.linewidth": 1.6, "legend.frameon": False,
        "legend.fontsize": 8, "legend.handlelength": 2.2,
        "savefig.dpi": 300, "figure.dpi": 100,
        "figure.constrained_layout.use": True})


class PlainTickFormatter(ScalarFormatter):
    """Tick labels as text, and only the power of ten that they share as math:
    parsing labels as math takes a third of the time of a figure."""

    def __init__(self):
        super().__init__(useMathText=False)

    def get_offset(self) -> str:
        self.set_useMathText(True)
        offset = super().get_offset()
        self.set_useMathText(False)
        return offset


def use_plain_ticks(figure) -> None:
    for axes in figure.axes:
        for axis in (axes.xaxis, axes.yaxis):
            if type(axis.get_major_formatter()) is ScalarFormatter:
                axis.set_major_formatter(PlainTickFormatter())
