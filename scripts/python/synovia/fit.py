"""Parameters of cases from measured curves, by nonlinear least squares."""

from __future__ import annotations

import os
import pathlib
import tempfile
import time
from collections.abc import Sequence

import numpy as np

from synovia.case import Case
from synovia.errors import RunError, Stopped, SynoviaError
from synovia.fitted import Fit
from synovia.measured import Curve, Parameter
from synovia.pool import Job, cores, run_all
from synovia.progress import Line, line
from synovia.results import Result


def fit(case: Case | Sequence[Case],
        data: Curve | Sequence[Curve] | Sequence[Sequence[Curve]],
        parameters: Sequence[Parameter], *, ranks: int = 1,
        processes: int | None = None, tolerance: float = 1e-3,
        step: float = 1e-2, max_iterations: int = 30,
        confidence: float = 0.95, folder: str | os.PathLike[str] | None = None,
        progress: bool | None = None) -> Fit:
    """Finds the parameters with which cases come nearest to measured curves.

    case, data: one case and its curves; or several cases, experiments on the
    same material, with a list of the curves of each.
    processes: runs at once, for finite differences and several cases, by
    default as many as the cores hold.
    tolerance: ends the search when the sum of squared residuals changes less,
    relatively, or the unknowns a hundredth of that.
    step: of finite differences, relative to a parameter.
    confidence: of the intervals, by the Jacobian at the end.
    folder: keeps the runs' outputs.

    Raises SynoviaError where the first runs fail; a later one that does only
    makes the search take shorter steps. Stopped, after Ctrl-C, has the values
    that came nearest so far, to start from.
    """
    from scipy.optimize import least_squares
    cases, curves = _experiments(case, data)
    if not parameters:
        raise SynoviaError("there are no parameters to be found")
    began = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="synovia_fit_") as temporary:
        model = _Model(cases, curves, parameters, ranks,
                       processes or max(1, cores() // ranks),
                       pathlib.Path(folder or temporary), step,
                       line(progress))
        try:
            found = least_squares(
                model.residuals, model.start, jac=model.slopes,
                bounds=model.bounds, x_scale="jac", ftol=tolerance,
                xtol=1e-2 * tolerance, gtol=None, max_nfev=max_iterations)
            jacobian = model.jacobian(found.x)
        except KeyboardInterrupt as stopped:
            raise Stopped("stopped; " + model.nearest()) from stopped
        finally:
            model.line.close()
        return Fit(cases=model.cases_at(found.x), curves=curves,
                   parameters=list(parameters), x=found.x,
                   fitted=model.split(model.values(found.x)),
                   jacobian=jacobian, confidence=confidence,
                   converged=bool(found.success), message=found.message,
                   runs=model.runs, seconds=time.monotonic() - began)


def _experiments(case: Case | Sequence[Case],
                 data: Curve | Sequence[Curve] | Sequence[Sequence[Curve]]
                 ) -> tuple[list[Case], list[list[Curve]]]:
    if isinstance(case, Case):
        one = [data] if isinstance(data, Curve) else list(data)
        return [case], [one]    # type: ignore[list-item]
    cases = list(case)
    lists = [[item] if isinstance(item, Curve) else list(item)
             for item in data]  # type: ignore[union-attr]
    if len(lists) != len(cases) or not all(lists):
        raise SynoviaError(f"there are {len(cases)} cases and curves of "
                           f"{len(lists)}; each case needs at least one")
    return cases, lists


class _Model:
    """Residuals and their Jacobian as functions of the inner unknowns."""

    def __init__(self, cases: list[Case], curves: list[list[Curve]],
                 parameters: Sequence[Parameter], ranks: int, processes: int,
                 folder: pathlib.Path, step: float, shown: Line):
        self.curves = curves
        self.parameters = parameters
        self.line = shown
        self.runs = 0
        self._ranks, self._processes = ranks, processes
        self._folder, self._step = folder, step
        self._cases = [case.copy({"output.fields_every": 0,
                                  "output.checkpoint_every": 0})
                       for case in cases]
        self._originals = cases
        self._known: dict[bytes, np.ndarray] = {}
        self._best: tuple[float, np.ndarray] | None = None
        self.start = np.array([p.inner(p.start) for p in parameters])
        self.bounds = (np.array([p.inner(p.lower) for p in parameters]),
                       np.array([p.inner(p.upper) for p in parameters]))
        self._flat = [curve for own in curves for curve in own]
        self._scale = np.concatenate([curve.scale for curve in self._flat])
        self._measured = np.concatenate([curve.values for curve in self._flat])

    def cases_at(self, x: np.ndarray) -> list[Case]:
        """Copies of the cases as given, with these parameters."""
        return [self._with(case, x) for case in self._originals]

    def _with(self, case: Case, x: np.ndarray) -> Case:
        changed = case.copy()
        for parameter, value in zip(self.parameters, x):
            parameter.put(changed, parameter.outer(value))
        return changed

    def split(self, values: np.ndarray) -> list[np.ndarray]:
        """One array for each curve."""
        ends = np.cumsum([curve.t.size for curve in self._flat])[:-1]
        return np.split(values, ends)

    def values(self, x: np.ndarray) -> np.ndarray:
        """Of all curves at the measured times; NaN where a run failed."""
        return self._evaluate([x])[0]

    def residuals(self, x: np.ndarray) -> np.ndarray:
        values = self.values(x)
        residuals: np.ndarray = (values - self._measured) / self._scale
        misfit = float(np.sqrt(np.mean(residuals**2)))
        if self._best is None or misfit < self._best[0]:
            self._best = misfit, x.copy()
        self.line.write(f"{self._describe(x)}: misfit {misfit:.4g}, "
                        f"{self.runs} runs")
        return residuals

    def nearest(self) -> str:
        """The values that came nearest so far, in words."""
        if self._best is None:
            return "no run has ended"
        return f"{self._describe(self._best[1])} came nearest"

    def slopes(self, x: np.ndarray) -> np.ndarray:
        """The Jacobian by differences to one side, which the search needs."""
        ends = []
        for i in range(len(x)):
            ahead = self._beside(x, i, 1.0)
            ends.append((x, ahead if ahead[i] > x[i]
                         else self._beside(x, i, -1.0)))
        return self._differences(ends)

    def jacobian(self, x: np.ndarray) -> np.ndarray:
        """By central differences, one-sided at a bound."""
        return self._differences([(self._beside(x, i, -1.0),
                                   self._beside(x, i, 1.0))
                                  for i in range(len(x))])

    def _beside(self, x: np.ndarray, i: int, sign: float) -> np.ndarray:
        """With another value of the i-th unknown, within its bounds."""
        size = self._step * (1.0 if self.parameters[i].log
                             else max(abs(x[i]), self._step))
        end = x.copy()
        end[i] = np.clip(x[i] + sign * size, self.bounds[0][i],
                         self.bounds[1][i])
        return end

    def _differences(self, ends: list[tuple[np.ndarray, np.ndarray]]
                     ) -> np.ndarray:
        """A column for each pair of points; all runs go side by side."""
        values = self._evaluate([x for pair in ends for x in pair])
        columns = []
        for i, (start, end) in enumerate(ends):
            change = values[2 * i + 1] - values[2 * i]
            if not np.isfinite(change).all():
                raise SynoviaError(
                    f"runs with {self._describe(start)} or "
                    f"{self._describe(end)} failed: "
                    f"{self.parameters[i].name} can't be varied there")
            columns.append(change / (end[i] - start[i]) / self._scale)
        return np.stack(columns, axis=1)

    def _describe(self, x: np.ndarray) -> str:
        return ", ".join(f"{parameter.name} = {parameter.outer(value):.6g}"
                         for parameter, value in zip(self.parameters, x))

    def _evaluate(self, points: list[np.ndarray]) -> list[np.ndarray]:
        """What the curves are at each point; runs only what isn't known."""
        new = {x.tobytes(): x for x in points
               if x.tobytes() not in self._known}
        jobs = []
        for key, x in new.items():
            for number, case in enumerate(self._cases):
                self.runs += 1
                jobs.append(((key, number), Job(
                    self._with(case, x), self._folder / f"{self.runs:04d}",
                    self._ranks)))
        found: dict[bytes, dict[int, np.ndarray]] = {key: {} for key in new}
        for (key, number), result in run_all(jobs, self._processes):
            found[key][number] = self._measure(number, result, new[key])
        for key, parts in found.items():
            self._known[key] = np.concatenate(
                [parts[number] for number in sorted(parts)])
        return [self._known[x.tobytes()] for x in points]

    def _measure(self, number: int, result: Result | RunError,
                 x: np.ndarray) -> np.ndarray:
        curves = self.curves[number]
        if isinstance(result, RunError):
            if not self._known:
                raise SynoviaError(f"the first run, with {self._describe(x)}, "
                                   f"failed: {result}") from result
            return np.full(sum(curve.t.size for curve in curves), np.nan)
        return np.concatenate([curve.of(result) for curve in curves])
