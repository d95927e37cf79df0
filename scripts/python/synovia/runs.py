"""Runs of the program: started, followed, stopped."""

from __future__ import annotations

import contextlib
import os
import pathlib
import re
import signal
import subprocess
from collections.abc import Callable
from typing import TYPE_CHECKING

from synovia import program
from synovia.errors import RunError, Stopped
from synovia.results import Result

if TYPE_CHECKING:
    from synovia.case import Case

INPUT = "input.toml"    # in the output directory: the case as it was given
STEP = re.compile(r"step (\d+)\S*  t (\S+)")
STOPPED = re.compile(r"stopped at t = ([^;\s]+)")
RESULTS = ("history.csv", "checkpoint", "fields", "lines")

# Called with the number of the step and its time.
Show = Callable[[int, float], None]


class Run:
    """A run of a case. Its process has a session of its own.

    Ctrl-C does not get there by itself: wait() asks it to stop, so that it
    saves its state.
    """

    def __init__(self, case: Case, ranks: int,
                 output: str | os.PathLike[str] | None, *,
                 overwrite: bool, resume: bool):
        self.output = pathlib.Path(output or case["output.directory"])
        if not overwrite and not resume:
            self._require_empty()
        self.output.mkdir(parents=True, exist_ok=True)
        file = self.output / INPUT
        case.write(file)
        command = [*program.command(ranks), str(file), "--output",
                   str(self.output)]
        command += ["--overwrite"] if overwrite else []
        command += ["--resume"] if resume else []
        self._said: list[str] = []
        try:
            self._process = subprocess.Popen(
                command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT, text=True,
                env=program.environment(), start_new_session=True)
        except OSError as error:
            raise RunError(f"cannot start '{command[0]}': {error.strerror}; "
                           "MPIEXEC names what starts ranks") from error

    def _require_empty(self) -> None:
        found = [name for name in RESULTS if (self.output / name).exists()]
        if found:
            raise RunError(
                f"'{self.output}' holds results of a run: {', '.join(found)}; "
                "go on with that run by resume=True, remove them by "
                "overwrite=True, or choose another output")

    @property
    def running(self) -> bool:
        return self._process.poll() is None

    def stop(self) -> None:
        """Asks the run to end its step, to save its state, and to stop."""
        # Open MPI's mpirun hands this signal on, and waits for its ranks.
        with contextlib.suppress(ProcessLookupError):
            self._process.send_signal(signal.SIGUSR1)

    def kill(self) -> None:
        """Ends the run at once; what it has written stays."""
        with contextlib.suppress(ProcessLookupError):
            os.killpg(self._process.pid, signal.SIGKILL)

    def wait(self, show: Show | None = None) -> Result:
        """The results, at the end of the run.

        show: called with number and time of steps as they are reported.
        Raises Stopped after Ctrl-C or stop(), and RunError.
        """
        assert self._process.stdout is not None
        interrupted = False
        while True:
            try:
                self._listen(show)
                status = self._process.wait()
                self._process.stdout.close()
                break
            except KeyboardInterrupt:
                if interrupted:
                    self.kill()
                interrupted = True
                self.stop()
        text = "".join(self._said)
        stopped = STOPPED.search(text)
        if stopped:
            raise Stopped(f"stopped at t = {stopped[1]}; run(resume=True, "
                          f"output={str(self.output)!r}) goes on")
        if interrupted:
            raise Stopped(f"stopped; '{self.output}' may hold a checkpoint")
        if status != 0:
            raise RunError(_errors(text)
                           or f"the run ended with exit status {status}")
        return Result(self.output)

    def _listen(self, show: Show | None) -> None:
        for line in self._process.stdout or ():
            self._said.append(line)
            step = STEP.match(line)
            if step and show:
                show(int(step[1]), float(step[2]))


def _errors(text: str) -> str:
    """From the first error on."""
    lines = text.splitlines()
    first = [i for i, line in enumerate(lines) if "error:" in line]
    return "\n".join(lines[first[0]:] if first else lines[-20:])
