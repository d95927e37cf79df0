"""What the counts of an audit cost on a machine: a model of parallel efficiency.

The time of a Newton iteration on N ranks with the same share each is

    T(N) = w + m L + b / B + c log2(N) L

with the work w of one rank without messages, m messages and b bytes that the
busiest rank sends, c collectives (a tree of latencies), the latency L and the
bandwidth B of a rank. Counts beyond the measured numbers of ranks follow the
power laws fitted to them; collectives, iterations and messages to neighbors
that have stopped growing stay as they are. Efficiency is T(1)/T(N) for the same
share of unknowns.
"""

from __future__ import annotations

import dataclasses

import numpy as np

from audit_runs import Audit

# Phases of a Newton iteration.
ITERATED = ("assembly", "search", "setup", "iteration", "other")


@dataclasses.dataclass(frozen=True)
class Network:
    """Latency (s) and bandwidth of a rank's share of the adapter (bytes/s)."""

    name: str
    latency: float
    bandwidth: float


def exponent(ranks: np.ndarray, values: np.ndarray) -> float:
    """b of values ~ ranks^b, by least squares; 0 where there are none."""
    good = values > 0.0
    if good.sum() < 2:
        return 0.0
    return float(np.polyfit(np.log(ranks[good]), np.log(values[good]), 1)[0])


@dataclasses.dataclass(frozen=True)
class Law:
    """A count per Newton iteration, beyond the last measured number of ranks."""

    last_ranks: float
    last: float
    power: float

    def __call__(self, ranks: np.ndarray) -> np.ndarray:
        return self.last * (ranks / self.last_ranks) ** self.power


def fit(audits: list[Audit], kind: str, phases=ITERATED) -> Law:
    # Few ranks have fewer neighbors than many.
    settled = [audit for audit in audits if audit.ranks >= 8] or audits
    ranks = np.array([audit.ranks for audit in settled], dtype=float)
    values = np.array([
        sum(audit.most_sent(phase, kind) for phase in phases)
        / audit.number("newton") for audit in settled])
    return Law(ranks[-1], values[-1], max(0.0, exponent(ranks, values)))


@dataclasses.dataclass(frozen=True)
class Model:
    """Of audits with the same share of unknowns for each rank."""

    work: float      # s of one rank and Newton iteration
    messages: Law
    bytes: Law
    collectives: Law

    @classmethod
    def of(cls, audits: list[Audit], memory_speedup: float) -> Model:
        """@memory_speedup: memory bandwidth of a rank there over that here."""
        alone = next(audit for audit in audits if audit.ranks == 1)
        work = alone.number("cpu_seconds") / alone.number("newton")
        return cls(work / memory_speedup, fit(audits, "messages"),
                   fit(audits, "bytes"), fit(audits, "collectives"))

    def parts(self, ranks: np.ndarray, network: Network
              ) -> dict[str, np.ndarray]:
        """Seconds of a Newton iteration by what they are spent for."""
        return {
            "work": np.full_like(ranks, self.work),
            "latency of messages": self.messages(ranks) * network.latency,
            "bandwidth": self.bytes(ranks) / network.bandwidth,
            "collectives": self.collectives(ranks) * network.latency
            * np.log2(ranks)}

    def efficiency(self, ranks: np.ndarray, network: Network) -> np.ndarray:
        return self.work / sum(self.parts(ranks, network).values())
