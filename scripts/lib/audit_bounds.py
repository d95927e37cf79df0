"""How much an audit may grow with the number of ranks."""

from __future__ import annotations

import dataclasses

from audit_runs import Audit


@dataclasses.dataclass(frozen=True)
class Bound:
    """A value that is at most so much."""

    what: str
    value: float
    limit: float

    @property
    def kept(self) -> bool:
        return self.value <= self.limit


def surface(audit: Audit) -> float:
    """Unknowns of a share's surface, if it were a cube."""
    return 6.0 * (audit.held["dofs"].max() / 4.0) ** (2.0 / 3.0) * 4.0


def row_bytes(audit: Audit) -> float:
    """Of an average row of the displacement's matrix: values and columns."""
    return 12.0 * audit.held["entries"].sum() / audit.held["dofs"].sum()


def growth(audits: list[Audit], column: str) -> float:
    return audits[-1].number(column) / audits[0].number(column)


def difference(audits: list[Audit], column: str) -> float:
    """The largest from the first one, as a part of it."""
    first = audits[0].number(column)
    return max(abs(audit.number(column) / first - 1.0) for audit in audits)


def bounds_of(weak: list[Audit], strong: list[Audit]) -> list[Bound]:
    """The weak ones and the strong ones, each from 1 rank on."""
    few = next(audit for audit in weak if audit.ranks == 4)
    most = weak[-1]
    bounds = [
        Bound(f"growth of the memory of the rank that has most, 4 to "
              f"{most.ranks} ranks, the same share",
              most.held["memory"].max() / few.held["memory"].max(), 1.3),
        Bound(f"growth of the linear iterations of a step, 1 to "
              f"{strong[-1].ranks} ranks, the same problem",
              growth(strong, "linear"), 1.2),
        Bound("relative difference of the force, the same problem",
              difference(strong, "force"), 1e-6),
        Bound("relative difference of the contact's area, the same problem",
              difference(strong, "contact_area"), 1e-6),
        # Neighbors of a cube, and ranks of the other body.
        Bound("ranks that one rank sends to in assembly, the same share",
              most.most_sent("assembly", "destinations"), 40.0)]
    newton = most.number("newton")
    # Set-up and assembly send rows of matrices, the others values.
    for phase, calls, each, size, limit in (
            ("assembly", newton, "Newton iteration", row_bytes(most), 1.0),
            ("setup", newton, "Newton iteration", row_bytes(most), 1.0),
            ("search", newton, "Newton iteration", 8.0, 20.0),
            ("iteration", most.number("linear"), "linear iteration", 8.0,
             20.0),
            ("other", newton, "Newton iteration", 8.0, 20.0)):
        what = "rows" if size != 8.0 else "unknowns"
        bounds.append(Bound(
            f"bytes that one rank sends, phase {phase}, each {each}, over "
            f"those of its surface's {what}",
            most.most_sent(phase, "bytes") / calls / (size * surface(most)),
            limit))
    return bounds
