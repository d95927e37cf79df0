"""How figures look: colors of Okabe and Ito, which all can tell apart."""

from __future__ import annotations

import matplotlib

matplotlib.use("Agg")   # figures go to files, on machines without a screen

import matplotlib.pyplot as plt  # noqa: E402

BLUE, ORANGE, GREEN, RED, SKY, PINK = (
    "#0072B2", "#E69F00", "#009E73", "#D55E00", "#56B4E9", "#CC79A7")
GRAY = "#666666"

# References are thin, dark and over what is compared with them.
REFERENCE = {"color": "black", "linewidth": 0.9, "linestyle": (0, (4, 2)),
             "zorder": 3}


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
