"""Runs a script's main() and catches what it says."""

from __future__ import annotations

import contextlib
import io
from typing import Callable


def run_main(main: Callable[[list[str]], int], *arguments: object
             ) -> tuple[int, str, str]:
    """Exit status, output and error output."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        try:
            status = main([str(argument) for argument in arguments])
        except SystemExit as stop:
            status = int(stop.code or 0)
    return status, out.getvalue(), err.getvalue()
