"""Plots of fits."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from synovia.measured import Curve


def _columns(count: int, rows: int, **more: Any
             ) -> tuple[Figure, np.ndarray]:
    import matplotlib.pyplot as plt
    return plt.subplots(rows, count, sharex="col", squeeze=False,
                        layout="constrained",
                        figsize=(4.6 * count, 2.0 + 1.4 * rows), **more)


def _baseline(ax: Axes) -> None:
    ax.axhline(0, color="#666666", linewidth=0.6, zorder=0)


def fits(curves: list[Curve], fitted: list[np.ndarray]) -> Figure:
    """Curves and their fits above residuals, a column for each curve."""
    figure, axes = _columns(len(curves), 2, height_ratios=[2, 1])
    for curve, values, (above, below) in zip(curves, fitted, axes.T):
        above.plot(curve.t, curve.values, ".", color="#666666", markersize=4,
                   label="measured")
        above.plot(curve.t, values, color="#0072B2", label="fit")
        above.set(ylabel=curve.label)
        above.legend(frameon=False, fontsize="small")
        below.plot(curve.t, values - curve.values, ".", color="#D55E00",
                   markersize=4)
        _baseline(below)
        below.set(xlabel="t", ylabel="fit - measured")
    return figure


def sensitivities(curves: list[Curve], changes: dict[str, list[np.ndarray]]
                  ) -> Figure:
    """Changes of each curve by parameters, relative to their change."""
    figure, axes = _columns(len(curves), 1)
    for number, (curve, ax) in enumerate(zip(curves, axes[0])):
        for name, values in changes.items():
            ax.plot(curve.t, values[number], label=name)
        _baseline(ax)
        ax.set(xlabel="t", ylabel=f"p d({curve.label})/dp")
        ax.legend(frameon=False, fontsize="small")
    return figure
