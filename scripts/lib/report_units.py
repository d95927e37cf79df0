"""Units of the numbers in a report."""

from __future__ import annotations

import dataclasses

# Of a case whose units nobody named.
OF_CASE = "units of the case"
DIMENSIONLESS = ""


@dataclasses.dataclass(frozen=True)
class Units:
    """Names of the case's units of length, force and time, or none."""

    length: str = ""
    force: str = ""
    time: str = ""

    @staticmethod
    def parse(text: str) -> Units:
        """From "mm,N,s"; a ValueError for anything else."""
        parts = [part.strip() for part in text.split(",")]
        if len(parts) != 3 or not all(parts):
            raise ValueError(f"'{text}' is not LENGTH,FORCE,TIME, such as "
                             "mm,N,s")
        return Units(*parts)

    @property
    def known(self) -> bool:
        return bool(self.length)

    def of(self, kind: str) -> str:
        """The unit of a kind of quantity; empty for pure numbers."""
        if kind == DIMENSIONLESS:
            return ""
        if not self.known:
            return OF_CASE
        length, force, time = self.length, self.force, self.time
        pressure = {("mm", "N"): "MPa", ("m", "N"): "Pa"}.get(
            (length, force), f"{force}/{length}²")
        return {"length": length, "force": force, "time": time,
                "pressure": pressure, "area": f"{length}²",
                "flow": f"{length}³/{time}",
                "permeability": f"{length}⁴/({force} {time})",
                "stiffness": f"{force}/{length}",
                "velocity": f"{length}/{time}"}[kind]

    def label(self, name: str, kind: str) -> str:
        """Of an axis, a bar or a column."""
        unit = self.of(kind)
        return f"{name} ({unit})" if unit else name

    def value(self, number: float, kind: str) -> str:
        """A number on its own."""
        unit = self.of(kind)
        return f"{number:.4g}" + (f" {unit}" if self.known and unit else
                                  f" ({unit})" if unit else "")

    def at(self, time: float) -> str:
        """A moment; its unit goes without saying where nobody named it."""
        return f"t = {time:.6g}" + (f" {self.time}" if self.known else "")
