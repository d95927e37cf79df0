"""What run.log says: its runs, warnings and errors, and what took the time."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Iterable

_LINE = re.compile(r"(\d{4}-\d\d-\d\dT\S+)  (.*)")
_PROBLEM = re.compile(r"(warning|error): (.*)", re.DOTALL)


@dataclasses.dataclass
class Line:
    """What was said, and when; of several lines if the text has them."""

    time: str
    text: str


def _lines(text: str) -> list[Line]:
    found: list[Line] = []
    for row in text.splitlines():
        match = _LINE.fullmatch(row)
        if match:
            found.append(Line(*match.groups()))
        elif found:
            found[-1].text += "\n" + row
        else:
            found.append(Line("", row))
    return found


class RunLog:
    """A log of one run, or of several, each of which went on from the last."""

    def __init__(self, text: str):
        self.lines = _lines(text)
        starts = [i for i, line in enumerate(self.lines)
                  if re.match(r"synovia \S+, ", line.text)]
        self._last = starts[-1] if starts else 0

    def __bool__(self) -> bool:
        return bool(self.lines)

    def _problems(self, kind: str, lines: Iterable[Line]) -> list[str]:
        """Each once, in order."""
        texts = [match[2] for line in lines
                 if (match := _PROBLEM.fullmatch(line.text))
                 and match[1] == kind]
        return list(dict.fromkeys(texts))

    def warnings(self) -> list[str]:
        return self._problems("warning", self.lines)

    def errors(self) -> list[str]:
        """Those of the last run: the ones before were overcome."""
        return self._problems("error", self.lines[self._last:])

    def versions(self) -> str:
        """What ran last, and when; empty if it isn't said."""
        if not self.lines or not self.lines[self._last].text.startswith(
                "synovia "):
            return ""
        line = self.lines[self._last]
        return f"{line.text}; begun {line.time}"

    def size(self) -> str:
        """Order, unknowns and ranks of the last run, or nothing."""
        found = [line.text for line in self.lines
                 if re.match(r"order \d+, ", line.text)]
        return found[-1] if found else ""

    def tried_again(self) -> tuple[int, int]:
        """How many tries of steps failed, and were too inaccurate."""
        def total(pattern: str) -> int:
            return sum(int(n) for line in self.lines
                       for n in re.findall(pattern, line.text))
        return total(r"failed tries (\d+)"), total(r", inaccurate (\d+)")

    def phases(self) -> tuple[float, dict[str, float]] | None:
        """Seconds in all and by phase, of the last run that came to its end."""
        for line in reversed(self.lines):
            match = re.match(r"total ([0-9.]+) s: (.*)", line.text)
            if match:
                parts = re.findall(r"([^,]+?) ([0-9.]+) s(?:, |$)", match[2])
                return float(match[1]), {name: float(seconds)
                                         for name, seconds in parts}
        return None

    def without_steps(self) -> str:
        return "\n".join(f"{line.time}  {line.text}" for line in self.lines
                         if not re.match(r"step \d+  t ", line.text))
