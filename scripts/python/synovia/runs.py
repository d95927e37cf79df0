"""Runs of the program: started, followed, stopped."""

from __future__ import annotations

import contextlib
import os
import pathlib
import re
import signal
import subprocess
import threading
from collections.abc import Callable
from typing import TYPE_CHECKING

from synovia import program
from synovia.errors import RunError, Stopped
from synovia.results import Result

if TYPE_CHECKING:
    from synovia.case import Case

INPUT = "input.toml"    # in the output directory: the case as it was given
STEP = re.compile(r"  step (\d+)  t (\S+)  ")
STOPPED = re.compile(r"stopped at t = ([^;\s]+)")
POLL = 0.2          # seconds between looks at the log
LAST_LINES = 20_000 # bytes of the log that hold the newest step
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
        self._listener = threading.Thread(target=self._listen, daemon=True)
        self._listener.start()

    def _require_empty(self) -> None:
        found = [name for name in RESULTS if (self.output / name).exists()]
        if found:
            raise RunError(
                f"'{self.output}' holds results of a run: {', '.join(found)}; "
                "go on with that run by resume=True, remove them by "
                "overwrite=True, or choose another output")

    @property
    def running(self) -> bool:
        """Whether the program has not ended yet."""
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

        show: called with number and time of the newest step.
        Raises Stopped after Ctrl-C or stop(), and RunError.
        """
        interrupted = False
        while True:
            try:
                while self._listener.is_alive():
                    self._listener.join(POLL)
                    self._report(show)
                status = self._process.wait()
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

    def _listen(self) -> None:
        assert self._process.stdout is not None
        with self._process.stdout as said:
            self._said.extend(said)

    def _report(self, show: Show | None) -> None:
        """Of the newest step in the log: the screen has only some of them."""
        if show is None:
            return
        try:
            with open(self.output / "run.log", "rb") as log:
                log.seek(max(0, log.seek(0, os.SEEK_END) - LAST_LINES))
                steps = STEP.findall(log.read().decode(errors="replace"))
        except OSError:     # it has not begun
            return
        if steps:
            show(int(steps[-1][0]), float(steps[-1][1]))


def _errors(text: str) -> str:
    """From the first error on."""
    lines = text.splitlines()
    first = [i for i, line in enumerate(lines) if "error:" in line]
    return "\n".join(lines[first[0]:] if first else lines[-20:])
