"""The outcome of a fit: values, intervals, sensitivities, plots."""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING

import numpy as np

from synovia.case import Case
from synovia.errors import SynoviaError, suggestion
from synovia.measured import Curve, Parameter

if TYPE_CHECKING:
    from matplotlib.figure import Figure

# Above, two parameters are as good as one: the data do not tell them apart.
INSEPARABLE = 0.99


@dataclasses.dataclass(frozen=True)
class Fit:
    """Parameters that fit measured curves.

    fitted: what the cases give at the measured times, an array for each curve
    of all experiments; jacobian: of the residuals over the scales of the curves
    by the inner unknowns x, shape (points, parameters).
    """

    cases: list[Case]
    curves: list[list[Curve]]
    parameters: list[Parameter]
    x: np.ndarray
    fitted: list[np.ndarray]
    jacobian: np.ndarray
    confidence: float
    converged: bool
    message: str
    runs: int
    seconds: float

    @property
    def values(self) -> dict[str, float]:
        """Of each parameter by its name, in the units of the case."""
        return {parameter.name: parameter.outer(x)
                for parameter, x in zip(self.parameters, self.x)}

    def __getitem__(self, name: str) -> float:
        return self.values[self.parameters[self._number(name)].name]

    @property
    def residuals(self) -> list[np.ndarray]:
        """Case minus measurement in the units of each curve."""
        return [fitted - curve.values
                for fitted, curve in zip(self.fitted, self._flat)]

    @property
    def covariance(self) -> np.ndarray:
        """Of the inner unknowns: (J^T J)^-1 times the variance of the noise.

        That is 1 where all curves have a sigma, and otherwise estimated from
        the residuals. Infinite where the data say nothing of a parameter.
        """
        count = len(self.parameters)
        _, sizes, directions = np.linalg.svd(self.jacobian,
                                             full_matrices=False)
        if sizes[-1] <= 1e-10 * sizes[0]:
            return np.full((count, count), np.inf)
        inverse = (directions.T / sizes**2) @ directions
        return np.asarray(inverse * self.noise**2)

    @property
    def noise(self) -> float:
        """Standard deviation of what the fit leaves, over the scales.

        About 1 where sigma is right and the model too; it counts as 1 then.
        """
        if all(curve.sigma is not None for curve in self._flat):
            return 1.0
        return self._left

    @property
    def _left(self) -> float:
        points = sum(fitted.size for fitted in self.fitted)
        freedoms = points - len(self.parameters)
        if freedoms < 1:
            raise SynoviaError(f"{points} points do not suffice for the "
                               f"confidence of {len(self.parameters)} "
                               "parameters")
        return float(np.sqrt(sum(
            np.sum((left / curve.scale)**2)
            for left, curve in zip(self.residuals, self._flat)) / freedoms))

    @property
    def intervals(self) -> dict[str, tuple[float, float]]:
        """Of each parameter, by the linear theory, with the confidence asked.

        Those of a parameter that is fitted by its logarithm are not symmetric.
        """
        from scipy.stats import norm, t
        level = 0.5 * (1 + self.confidence)
        points = sum(fitted.size for fitted in self.fitted)
        quantile = norm.ppf(level) if self.noise == 1.0 \
            else t.ppf(level, points - len(self.parameters))
        width = quantile * np.sqrt(np.diag(self.covariance))
        with np.errstate(over="ignore"):
            return {parameter.name: (_outer(parameter, x - w),
                                     _outer(parameter, x + w))
                    for parameter, x, w in zip(self.parameters, self.x, width)}

    @property
    def correlation(self) -> np.ndarray:
        """Of the parameters, shape (parameters, parameters)."""
        covariance = self.covariance
        sizes = np.sqrt(np.diag(covariance))
        with np.errstate(invalid="ignore"):
            return covariance / np.outer(sizes, sizes)

    def sensitivity(self, name: str) -> list[np.ndarray]:
        """p times the derivative of each curve by p, in the curve's units.

        What a change by 1 % does is a hundredth of it.
        """
        number = self._number(name)
        factor = 1.0 if self.parameters[number].log else self.x[number]
        column = self.jacobian[:, number] * factor
        ends = np.cumsum([curve.t.size for curve in self._flat])[:-1]
        return [part * curve.scale for part, curve
                in zip(np.split(column, ends), self._flat)]

    @property
    def doubts(self) -> list[str]:
        """What to know before the values are used."""
        found = [] if self.converged else \
            [f"the search has not converged: {self.message}"]
        correlation = self.correlation
        for i, first in enumerate(self.parameters):
            value = first.outer(self.x[i])
            if np.isclose(value, [first.lower, first.upper], rtol=1e-3).any():
                found.append(f"{first.name} is at a bound")
            for j, second in enumerate(self.parameters[:i]):
                if not abs(correlation[i, j]) < INSEPARABLE:
                    found.append(f"the data hardly tell {second.name} and "
                                 f"{first.name} apart")
        if self.noise == 1.0 and self._left > 2.0:
            found.append(f"residuals are {self._left:.1f} times sigma: the "
                         "model does not describe the data so well")
        return found

    @property
    def _flat(self) -> list[Curve]:
        return [curve for own in self.curves for curve in own]

    def _number(self, name: str) -> int:
        names = [parameter.name for parameter in self.parameters]
        if name not in names:
            raise SynoviaError(f"there is no parameter '{name}'"
                               + suggestion(name, names))
        return names.index(name)

    def plot(self) -> Figure:
        """Curves and their fits above residuals, a column for each curve."""
        from synovia.fit_plots import fits
        return fits(self._flat, self.fitted)

    def plot_sensitivities(self) -> Figure:
        """How each curve depends on each parameter."""
        from synovia.fit_plots import sensitivities
        return sensitivities(self._flat, {
            parameter.name: self.sensitivity(parameter.name)
            for parameter in self.parameters})

    def _table(self) -> list[tuple[str, str, str]]:
        return [(name, f"{value:.5g}", f"{low:.5g} to {high:.5g}")
                for (name, value), (low, high)
                in zip(self.values.items(), self.intervals.values())]

    def __str__(self) -> str:
        lines = [f"{name} = {value}, {100 * self.confidence:g} %: {interval}"
                 for name, value, interval in self._table()]
        lines.append(f"{self.runs} runs, {self.seconds:.0f} s")
        return "\n".join(lines + [f"warning: {text}" for text in self.doubts])

    __repr__ = __str__

    def _repr_html_(self) -> str:
        rows = "".join(f"<tr><td>{name}</td><td>{value}</td><td>{interval}"
                       "</td></tr>" for name, value, interval in self._table())
        return (f"<table><tr><th></th><th>value</th><th>"
                f"{100 * self.confidence:g} % interval</th></tr>{rows}</table>"
                + "".join(f"<p>warning: {text}</p>" for text in self.doubts))


def _outer(parameter: Parameter, x: float) -> float:
    return float(np.exp(x)) if parameter.log else float(x)
