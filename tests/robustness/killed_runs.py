"""Runs that are killed on their way."""

from __future__ import annotations

import os
import pathlib
import signal
import subprocess
import time

from program_checks import descendants, history


def wait_for(run: subprocess.Popen, output: pathlib.Path, t: float) -> None:
    """Until the run's history has got to a time, or the run has ended."""
    file = output / "history.csv"
    while run.poll() is None:
        try:
            last = history(output)[-1]["t"] if file.exists() else 0.0
        except (IndexError, TypeError, ValueError):
            last = 0.0   # it is being written
        if last >= t:
            return
        time.sleep(0.005)


def kill(run: subprocess.Popen) -> str:
    """Kills all its ranks with SIGKILL; gives what it has printed."""
    for pid in [*descendants(run.pid), run.pid]:
        try:
            os.kill(pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
    return run.communicate()[0]
