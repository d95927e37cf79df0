"""Importing this lets a script whose modules are missing say how to run it.

It comes before the modules that not every Python has.
"""

from __future__ import annotations

import os
import pathlib
import shlex
import sys
from types import TracebackType

RUNNER = pathlib.Path(__file__).resolve().parents[1] / "run_python"


def is_missing(error: BaseException) -> bool:
    """Whether it is a module, or a library under one."""
    return isinstance(error, ImportError) or (
        isinstance(error, OSError)
        and "cannot open shared object file" in str(error))


def advise(kind: type[BaseException], error: BaseException,
           trace: TracebackType | None) -> None:
    """Takes the place of sys.excepthook."""
    if not is_missing(error):
        sys.__excepthook__(kind, error, trace)
        return
    command = shlex.join([os.path.relpath(RUNNER), *sys.argv])
    print(f"{os.path.basename(sys.argv[0])}: error: {error}; this Python lacks "
          f"what scripts/requirements.txt lists. Use\n   {command}",
          file=sys.stderr)


sys.excepthook = advise
