"""A line that says how far a run has got, in a terminal or in a notebook."""

from __future__ import annotations

import sys
import time
from types import TracebackType
from typing import Any, Protocol, TextIO

WIDTH = 30  # of the bar, in characters


class Line(Protocol):
    """A line of text that is written anew each time."""

    def write(self, text: str) -> None: ...

    def close(self) -> None: ...


class NoLine:
    def write(self, text: str) -> None:
        pass

    def close(self) -> None:
        pass


class TerminalLine:
    def __init__(self, stream: TextIO | None = None):
        self._stream = stream or sys.stderr
        self._length = 0

    def write(self, text: str) -> None:
        self._stream.write("\r" + text.ljust(self._length))
        self._stream.flush()
        self._length = len(text)

    def close(self) -> None:
        """The line vanishes."""
        if self._length:
            self._stream.write("\r" + " " * self._length + "\r")
            self._stream.flush()


class NotebookLine:
    def __init__(self) -> None:
        self._display: Any = None

    def write(self, text: str) -> None:
        from IPython.display import display
        data = {"text/plain": text}
        if self._display is None:
            self._display = display(data, raw=True, display_id=True)
        else:
            self._display.update(data, raw=True)

    def close(self) -> None:
        pass


def in_notebook() -> bool:
    """Whether a kernel of Jupyter runs this."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython else None
    return shell is not None and hasattr(shell, "kernel")


def line(wanted: bool | None) -> Line:
    """Where somebody may look; None lets the surroundings decide."""
    if wanted is False:
        return NoLine()
    if in_notebook():
        return NotebookLine()
    if wanted or sys.stderr.isatty():
        return TerminalLine()
    return NoLine()


class RunProgress:
    """Of a run: called with the number of a step and its time."""

    def __init__(self, end: float, wanted: bool | None):
        self._end = end
        self._line = line(wanted)
        self._began = time.monotonic()

    def __enter__(self) -> RunProgress:
        return self

    def __exit__(self, _kind: type[BaseException] | None,
                 _error: BaseException | None,
                 _trace: TracebackType | None) -> None:
        self._line.close()

    def __call__(self, step: int, t: float) -> None:
        part = min(max(t / self._end, 0.0), 1.0) if self._end > 0 else 1.0
        seconds = time.monotonic() - self._began
        left = seconds * (1 - part) / part if part > 0 else 0.0
        bar = "#" * round(WIDTH * part)
        self._line.write(
            f"[{bar:.<{WIDTH}}] t = {t:g} of {self._end:g}, step {step}, "
            f"{seconds:.0f} s, about {left:.0f} s left")
