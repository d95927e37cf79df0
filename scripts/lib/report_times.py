"""What of an output directory belongs to the run whose history it holds."""

from __future__ import annotations

import pathlib
from collections.abc import Callable

import numpy as np

from report_history import pair_names
from synovia_output import Table

# Collections write times with fewer digits than the history.
SAME = 1e-5
MOST_NAMED = 4


class RunTimes:
    """The moments of a run, and what a case says that it writes.

    Fields and lines are written at the ends of steps, each of which has a row
    in the history; others are left from another run.
    """

    def __init__(self, history: Table | None, case: dict):
        self._times = np.array([]) if history is None else \
            history["t"][np.isfinite(history["t"])]
        self._pairs = [] if history is None else pair_names(history)
        self._output = case.get("output")

    def has(self, time: float) -> bool:
        return bool(np.isclose(self._times, time, rtol=SAME, atol=0).any())

    def own_fields(self, name: str, times: list[float],
                   complain: Callable[[str], None]) -> list[float]:
        """Those of a collection that are of this run; complain(text) of the
        others."""
        if times and self._output and self._output.get("fields_every") == 0:
            complain(f"the fields '{name}' are left from another run and are "
                     "not shown: this one wrote none (fields_every = 0)")
            return []
        pair = name.removeprefix("contact_")
        if times and pair != name and pair not in self._pairs:
            complain(f"the fields '{name}' are left from another run and are "
                     "not shown: this one has no such pair")
            return []
        self._complain(f"the fields '{name}'", times, complain)
        return [time for time in times if self.has(time)]

    def own_lines(self, name: str, files: list[tuple[float, pathlib.Path]],
                  complain: Callable[[str], None]
                  ) -> list[tuple[float, pathlib.Path]]:
        """The same for a sampled line."""
        if self._output is not None and name not in [
                line.get("name") for line in self._output.get("line", ())]:
            complain(f"the line '{name}' is left from another run and is not "
                     "shown: this one samples no such line")
            return []
        self._complain(f"the line '{name}'", [time for time, _ in files],
                       complain)
        return [(time, file) for time, file in files if self.has(time)]

    def _complain(self, what: str, times: list[float],
                  complain: Callable[[str], None]) -> None:
        strange = [f"{time:g}" for time in times if not self.has(time)]
        if strange:
            more = len(strange) - MOST_NAMED
            complain(f"{what} at t = {', '.join(strange[:MOST_NAMED])}"
                     + (f" and {more} more times" if more > 0 else "")
                     + " are not shown: the history has no such time, so that "
                     "they are left from another run")
