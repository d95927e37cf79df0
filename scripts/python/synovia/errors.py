"""Errors that say what is wrong, where, and what to do."""

from __future__ import annotations

import difflib
from collections.abc import Iterable


class SynoviaError(Exception):
    """Any error of this package."""


class CaseError(SynoviaError):
    """A case that is wrong: a key, a value, or what the program says of it."""


class KeyNameError(CaseError, AttributeError, KeyError):
    """A key that cases do not have."""

    def __str__(self) -> str:   # KeyError would quote it
        return str(self.args[0])


class RunError(SynoviaError):
    """A run that failed; its log has more."""


class Stopped(KeyboardInterrupt):
    """A run that was stopped by Ctrl-C, after it had saved its last state."""


def suggestion(name: str, known: Iterable[str]) -> str:
    """What to add to a complaint about an unknown name.

    The nearest of the known ones, or a list of all of them.
    """
    names = sorted(set(known))
    near = difflib.get_close_matches(name, names, n=1, cutoff=0.6)
    if near:
        return f"; did you mean '{near[0]}'?"
    return f"; there are: {', '.join(names)}" if names else ""
