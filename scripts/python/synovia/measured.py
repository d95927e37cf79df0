"""What a fit starts from: measured curves, and parameters to be found."""

from __future__ import annotations

import dataclasses
import math
import os
from collections.abc import Callable, Sequence

import numpy as np

from synovia.case import Case
from synovia.errors import SynoviaError
from synovia.output import OutputError, Table
from synovia.results import Result

# A column of the history, or a function that gives values at a result's times.
Quantity = str | Callable[[Result], np.ndarray]


@dataclasses.dataclass(frozen=True)
class Curve:
    """A measured curve, and what of a result it is compared with.

    t, values: shape (points,); quantity times factor is what was measured, such
    as the force of the whole turn from that of a wedge. sigma: the standard
    deviation of the noise, a number or one for each point; if it is left out,
    each curve counts alike, relative to its largest value, and the noise is
    estimated from what the fit leaves.
    """

    t: np.ndarray
    values: np.ndarray
    quantity: Quantity
    factor: float = 1.0
    sigma: float | np.ndarray | None = None
    name: str = ""

    def __post_init__(self) -> None:
        t = np.asarray(self.t, dtype=float)
        values = np.asarray(self.values, dtype=float)
        if t.ndim != 1 or t.shape != values.shape or t.size < 2:
            raise SynoviaError("a curve needs as many values as times, and at "
                               f"least two; there are {values.shape} and "
                               f"{t.shape}")
        if not (np.isfinite(t).all() and np.isfinite(values).all()
                and (np.diff(t) > 0).all()):
            raise SynoviaError("a curve needs finite values at times that "
                               "ascend")
        if self.sigma is None and not values.any():
            raise SynoviaError("a curve is zero everywhere; give its sigma")
        if self.sigma is not None and not (np.asarray(self.sigma) > 0).all():
            raise SynoviaError("sigma is not positive")
        object.__setattr__(self, "t", t)
        object.__setattr__(self, "values", values)

    @classmethod
    def read(cls, file: str | os.PathLike[str], t: str, values: str,
             quantity: Quantity, factor: float = 1.0,
             sigma: float | np.ndarray | None = None, name: str = "") -> Curve:
        """Two columns of a CSV file with a head; # begins comments."""
        table = Table(file)
        return cls(table[t], table[values], quantity, factor, sigma, name)

    @property
    def label(self) -> str:
        """What it is called in texts and plots."""
        return self.name or (self.quantity if isinstance(self.quantity, str)
                             else self.quantity.__name__)

    @property
    def scale(self) -> np.ndarray:
        """What residuals are divided by, shape (points,)."""
        sigma = np.abs(self.values).max() if self.sigma is None else self.sigma
        return np.broadcast_to(np.asarray(sigma, dtype=float), self.t.shape)

    def of(self, result: Result) -> np.ndarray:
        """The result's curve at the measured times, shape (points,).

        Between steps it is interpolated without overshoot.
        """
        from scipy.interpolate import PchipInterpolator
        t = result.t
        values = (result.history[self.quantity]
                  if isinstance(self.quantity, str) else
                  np.asarray(self.quantity(result), dtype=float))
        if values.shape != t.shape:
            raise SynoviaError(f"{self.label} gives {values.shape} values for "
                               f"{t.size} steps")
        slack = 1e-9 * t[-1]
        if self.t[0] < t[0] - slack or self.t[-1] > t[-1] + slack:
            raise OutputError(
                f"{self.label} was measured from t = {self.t[0]:g} to "
                f"{self.t[-1]:g}, and '{result.directory}' has steps from "
                f"{t[0]:g} to {t[-1]:g}: leave the other points out, or change "
                "time.step or time.end")
        between = PchipInterpolator(t, values)
        return self.factor * np.asarray(between(np.clip(self.t, t[0], t[-1])))


@dataclasses.dataclass(frozen=True)
class Parameter:
    """A number that is to be found, and where it stands in the cases.

    paths: one, or several that get the same value. log: its logarithm is
    fitted, as for moduli and permeabilities of unknown magnitude.
    """

    name: str
    paths: str | Sequence[str]
    start: float
    lower: float = -math.inf
    upper: float = math.inf
    log: bool = False

    def __post_init__(self) -> None:
        if not self.lower < self.start < self.upper:
            raise SynoviaError(f"{self.name} starts from {self.start:g}, which "
                               f"is not between {self.lower:g} and "
                               f"{self.upper:g}")
        if self.log and self.start <= 0:
            raise SynoviaError(f"{self.name} starts from {self.start:g}, which "
                               "has no logarithm")

    def put(self, case: Case, value: float) -> None:
        """Into a case."""
        for path in ([self.paths] if isinstance(self.paths, str)
                     else self.paths):
            case[path] = float(value)

    def inner(self, value: float) -> float:
        """The unknown of the optimization: the value or its logarithm."""
        if not self.log:
            return value
        return math.log(value) if value > 0 else -math.inf

    def outer(self, x: float) -> float:
        """The value in the case, of that which the search varies."""
        return math.exp(x) if self.log else float(x)
