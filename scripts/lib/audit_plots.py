"""Pictures of an audit's model."""

from __future__ import annotations

import numpy as np

import figure_style as style
from audit_model import Model, Network
from audit_runs import Audit
from figure_style import plt

# Ranks that share an adapter.
RANKS_ON_NODE = 16
# Squyres, "MPI over 40Gb Ethernet" (2014): Open MPI 1.8.1, back to back; Liu,
# Mamidala, Vishnu & Panda, "Evaluating InfiniBand performance with PCI Express"
# (IEEE Micro 25(1):20-29, 2005): latency, and the link's 8 Gbit/s of data.
NETWORKS = (
    Network("40 Gbit/s Ethernet, usNIC: 1.93 µs, 4.65 GB/s", 1.93e-6,
            4.65e9 / RANKS_ON_NODE),
    Network("InfiniBand 4X SDR: 4.1 µs, 1 GB/s", 4.1e-6,
            1e9 / RANKS_ON_NODE))


def efficiency_figure(audits: list[Audit], memory_speedup: float):
    """Efficiency up to 4,096 ranks, and what a Newton iteration is spent for."""
    style.use_style()
    model = Model.of(audits, memory_speedup)
    ranks = 2.0 ** np.arange(6, 13)
    figure, axes = plt.subplots(1, 1 + len(NETWORKS), figsize=(10.5, 3.3))
    for network in NETWORKS:
        axes[0].plot(ranks, model.efficiency(ranks, network), "o-",
                     markersize=3, label=network.name)
    axes[0].set_title("Modeled efficiency, the same share")
    axes[0].set_ylim(0.0, 1.05)
    axes[0].legend(loc="upper right", fontsize=6.5)
    for axis, network in zip(axes[1:], NETWORKS):
        parts = model.parts(ranks, network)
        axis.stackplot(ranks, *(1e3 * part for part in parts.values()),
                       labels=list(parts), linewidth=0)
        axis.set_title(network.name.split(":")[0])
        axis.set_ylabel("ms a Newton iteration")
        axis.legend(loc="upper left", fontsize=6.5)
    share = audits[-1].held["dofs"].mean()
    for axis in axes:
        axis.set_xscale("log", base=2)
        axis.set_xlabel(f"ranks of {share:,.0f} unknowns, "
                        f"{RANKS_ON_NODE} on a node")
    return figure
