"""Several runs at once, which end together upon Ctrl-C."""

from __future__ import annotations

import dataclasses
import os
import pathlib
import threading
from collections.abc import Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor
from concurrent.futures import wait as wait_for
from typing import TypeVar

from synovia.case import Case
from synovia.errors import RunError, Stopped, SynoviaError
from synovia.results import Result
from synovia.runs import Run


@dataclasses.dataclass(frozen=True)
class Job:
    """A case that is to run on some ranks to an output directory."""

    case: Case
    output: pathlib.Path
    ranks: int = 1
    resume: bool = False


def cores() -> int:
    """How many this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") \
        else os.cpu_count() or 1


Key = TypeVar("Key")


def run_all(jobs: Iterable[tuple[Key, Job]], processes: int
            ) -> Iterator[tuple[Key, Result | RunError]]:
    """Results and errors of jobs by their keys, in the order they come.

    processes: how many run at once. Ctrl-C stops all of them, which saves
    their states, and raises Stopped.
    """
    if processes < 1:
        raise SynoviaError(f"processes = {processes} is less than 1")
    going: set[Run] = set()
    lock = threading.Lock()
    stopping = threading.Event()

    def work(job: Job) -> Result | RunError:
        with lock:
            if stopping.is_set():
                raise Stopped("stopped before it began")
            run = job.case.start(job.ranks, job.output, resume=job.resume,
                                 overwrite=not job.resume)
            going.add(run)
        try:
            return run.wait()
        except RunError as error:
            return error
        finally:
            with lock:
                going.discard(run)

    with ThreadPoolExecutor(processes) as executor:
        futures: dict[Future[Result | RunError], Key] = {
            executor.submit(work, job): key for key, job in jobs}
        try:
            while futures:
                done, _ = wait_for(futures, return_when=FIRST_COMPLETED)
                for future in done:
                    yield futures.pop(future), future.result()
        except BaseException:
            stopping.set()
            _stop(going, lock)
            raise


def _stop(going: set[Run], lock: threading.Lock) -> None:
    with lock:
        for run in going:
            run.stop()


