#!/usr/bin/env python3
# processors: 1
"""The output directory of a run, and what a run that goes on may differ in.

Requirements: a directory belongs to one run, which other runs are told about;
results of an earlier one are refused, or removed with --overwrite, and nothing
else is. A resumed run is of the same case, and a restarted one says what has
changed. A run says its warnings first, and one that fails at once leaves a log
and nothing in the way of the next. What Ctrl-C prints goes on from anywhere.
All refusals end all ranks.
"""

from __future__ import annotations

import contextlib
import io
import os
import pathlib
import re
import signal
import socket
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.dont_write_bytecode = True

from program_checks import (  # noqa: E402
    MPIEXEC, PROGRAMS, SOURCE, WITHOUT_WAITING, check, descendants, finish,
    history, make_mesh)

import h5py  # noqa: E402
import numpy as np  # noqa: E402

CASE = SOURCE / "miniapps/cases/two_columns.toml"
HEAD = 512   # bytes before the HDF5 file in a checkpoint


class Runs:
    """Runs of two columns in contact, on a coarse mesh, in one directory."""

    def __init__(self, directory: pathlib.Path) -> None:
        self.directory = directory
        self.mesh = directory / "two_columns.msh"
        make_mesh("boxes.py", self.mesh, "two_columns", "--size", "2")

    def command(self, ranks: int, output: str, *more: str, end: float = 20.0,
                settings: tuple[str, ...] = ()) -> list:
        command = [MPIEXEC, "-n", str(ranks), PROGRAMS / "synovia", CASE,
                   "--output", output, *more]
        for setting in (f'mesh.file="{self.mesh}"', "time.step=2",
                        f"time.end={end}", "output.checkpoint_every=5",
                        *settings):
            command += ["--set", setting]
        return command

    def __call__(self, *arguments, env: dict[str, str] | None = None,
                 **more) -> subprocess.CompletedProcess:
        return subprocess.run(self.command(*arguments, **more), text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              cwd=self.directory, timeout=120,
                              env=os.environ | WITHOUT_WAITING | (env or {}))

    def good(self, what: str, *arguments, **more) -> str:
        result = self(*arguments, **more)
        if result.returncode != 0:
            print(result.stdout)
        check(result.returncode == 0, what)
        return result.stdout

    def refused(self, what: str, *arguments, texts: tuple[str, ...],
                **more) -> None:
        """On one rank and on two, by one message and no other change."""
        before = self.contents()
        for ranks in (1, 2):
            result = self(ranks, *arguments, **more)
            said = result.stdout
            if not (result.returncode == 1
                    and said.count("synovia: error: ") == 1
                    and all(text in said for text in texts)):
                print(result.returncode, said)
                check(False, what)
        check(self.contents() == before, what)

    def contents(self) -> dict[pathlib.Path, bytes]:
        return {file: file.read_bytes() for file in
                self.directory.rglob("*")
                if file.is_file() and "history" in file.name}

    @contextlib.contextmanager
    def going_on(self, *arguments, **more):
        """A run that has begun; killed at the end if it is still there."""
        output = self.directory / arguments[1] / "history.csv"
        run = subprocess.Popen(self.command(*arguments, **more), text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               cwd=self.directory)
        try:
            wait_for_steps(run, output, 7)
            yield run
        finally:
            for pid in [*descendants(run.pid), run.pid]:
                with contextlib.suppress(ProcessLookupError):
                    os.kill(pid, signal.SIGKILL)
            run.communicate()


def wait_for_steps(run: subprocess.Popen, file: pathlib.Path,
                   steps: int) -> None:
    give_up = time.monotonic() + 100
    while not file.exists() or file.read_text().count("\n") <= steps:
        if run.poll() is not None:
            print(run.communicate()[0])
            check(False, "the run has ended too early")
        if time.monotonic() > give_up:
            check(False, f"{steps} steps are made in time")
        time.sleep(0.01)


def used(run: Runs) -> None:
    lines = ('output.line=[{name = "old", from = [0.1, 0.1, 0], '
             'to = [0.1, 0.1, 1], points = 3}]',)
    run.good("a run in a new directory", 2, "out", settings=lines)
    out = run.directory / "out"
    check((out / "lines" / "old_t20.csv").exists(), "it writes a line")
    (out / "notes.txt").write_text("mine")
    (out / "fields" / "view.pvsm").write_text("mine")
    run.refused("results are not overwritten, but listed", "out", texts=(
        "the output directory 'out' holds results of a run: history.csv, "
        "history.h5, checkpoint/ (2 files), fields/ (", "lines/ (1 file)",
        "--resume", "--overwrite", "--output"))
    check(run(1, "out", "--resume", "--overwrite").returncode == 1,
          "--resume and --overwrite exclude each other")
    run.good("they are with --overwrite", 2, "out", "--overwrite", end=4.0,
             settings=("output.fields_every=0",))
    check(not (out / "lines").exists()
          and sorted(file.name for file in out.rglob("*") if file.is_file())
          == ["case.toml", "checkpoint_00000002.h5", "history.csv",
              "history.h5", "notes.txt", "run.log", "view.pvsm"],
          "of the earlier run nothing is left, of others all")
    check([row["t"] for row in history(out)] == [2.0, 4.0],
          "the history is that of the new run")


def at_once(run: Runs) -> None:
    with run.going_on(2, "busy", end=1e5, settings=("output.fields_every=0",)):
        checkpoint = run.directory / "busy/checkpoint/checkpoint_00000005.h5"
        for more in ((), ("--overwrite",), ("--resume",),
                     ("--restart", str(checkpoint))):
            before = history(run.directory / "busy")
            for ranks in (1, 2):
                result = run(ranks, "busy", *more, end=1e5)
                check(result.returncode == 1 and re.search(
                    r"error: the output directory 'busy' is that of a run in "
                    rf"progress \(process \d+ on {socket.gethostname()}, since "
                    r"20\d\d-", result.stdout) is not None,
                    f"a second run at once {' '.join(more[:1])} on {ranks} "
                    "ranks is refused")
            check(history(run.directory / "busy")[:len(before)] == before,
                  "the first one's history is as it was")
    reached = history(run.directory / "busy")[-1]["t"]
    run.good("killed, it can be resumed", 2, "busy", "--resume",
             end=reached + 4, settings=("output.fields_every=0",))


def without_locks(run: Runs) -> None:
    """On a file system that has none: stands for NFS without its daemon."""
    source = run.directory / "no_locks.c"
    source.write_text("#include <errno.h>\n"
                      "int flock(int file, int operation)\n"
                      "{ (void)file; (void)operation;"
                      " errno = ENOLCK; return -1; }\n")
    library = run.directory / "no_locks.so"
    subprocess.run(["cc", "-shared", "-fPIC", "-o", library, source],
                   check=True)
    said = run.good("a run where there are no locks", 2, "unlocked", end=4.0,
                    env={"LD_PRELOAD": str(library)})
    check(said.count("warning: 'unlocked' can't be locked: No locks available")
          == 1, "warns of it")


def changed(run: Runs) -> None:
    run.good("a run to go on with", 1, "first")
    newest = "first/checkpoint/checkpoint_00000010.h5"
    stiffer = {"settings": ("material.0.solid.E=0.7",), "end": 30.0}
    run.refused("another material is not resumed", "first", "--resume",
                texts=(f"the checkpoint '{newest}' is of another case:",
                       "material.0.solid.E: was 0.5417, is 0.7",
                       f"--restart {newest}"), **stiffer)
    for option in (("--resume",), ("--restart", newest)):
        run.refused(f"an end before the checkpoint is none {option[0]}",
                    "first", *option, end=10.0, texts=(
                        "time.end: the run would end at 10, before the "
                        f"checkpoint '{newest}', which is of t = 20",))
    run.good("another end, step, scheme and output is resumed", 2, "first",
             "--resume", end=24.0, settings=(
                 "time.step=1", 'time.scheme="sdirk23"', "solver.max_newton=30",
                 "output.fields_every=0", 'title="longer"'))
    check([row["t"] for row in history(run.directory / "first")]
          == [*range(2, 21, 2), 21, 22, 23, 24], "and goes on with one history")
    log = (run.directory / "first" / "run.log").read_text()
    check("changed: time.end: was 20.0, is 24.0" in log, "the log has what is "
          "new")

    older = "first/checkpoint/checkpoint_00000010.h5"
    said = run.good("another material is restarted", 2, "first", "--restart",
                    older, **stiffer)
    log = (run.directory / "first" / "run.log").read_text()
    changes = [line for line in said.splitlines()
               if line.startswith("changed: ")]
    check("changed: material.0.solid.E: was 0.5417, is 0.7" in changes
          and all(change in log for change in changes)
          and len(changes) == 2, f"the log lists what has changed: {changes}")
    check([row["t"] for row in history(run.directory / "first")]
          == [*range(2, 31, 2)], "later rows of the run before are gone")
    run.refused("a restart does not mix with results of another run", "out",
                "--restart", older, texts=("holds results of a run",), end=30.0)
    run.refused("--overwrite does not remove the checkpoint itself", "first",
                "--restart", older, "--overwrite", end=30.0,
                texts=("would remove the checkpoint",))
    run.good("a restart in place of another run", 1, "out", "--restart", older,
             "--overwrite", **stiffer)
    check(history(run.directory / "out") != []
          and history(run.directory / "out")[0]["t"] == 22,
          "begins a history of its own")


def checksum(data: bytes) -> int:
    """Of checkpoints, see plugin/io/positional_sum.hpp."""
    words = np.frombuffer(data.ljust(-(-len(data) // 8) * 8, b"\0"), "<u8")
    mixed = words + (np.arange(1, len(words) + 1, dtype=np.uint64)
                     * np.uint64(0x9E3779B97F4A7C15))
    for shift, factor in ((30, 0xBF58476D1CE4E5B9), (27, 0x94D049BB133111EB)):
        mixed = (mixed ^ (mixed >> np.uint64(shift))) * np.uint64(factor)
    return int((mixed ^ (mixed >> np.uint64(31))).sum(dtype=np.uint64))


def without_case(run: Runs) -> None:
    run.good("a run whose checkpoint gets an older form", 1, "older", end=10.0)
    file = run.directory / "older/checkpoint/checkpoint_00000005.h5"
    stream = io.BytesIO(file.read_bytes()[HEAD:])
    with h5py.File(stream, "r+") as contents:
        del contents["texts/case"]
        del contents["texts/surfaces"]
    image = stream.getvalue()
    head = (f"synovia checkpoint 2\nbytes {len(image)}\n"
            f"sum {checksum(image):x}\n").encode()
    file.write_bytes(head.ljust(HEAD, b"\0") + image)
    run.refused("a checkpoint without its case is not resumed", "older",
                "--resume", texts=("does not hold its case",
                                   "--restart older/checkpoint/"))
    said = run.good("but restarted", 2, "older", "--restart", str(file))
    check("warning: the checkpoint does not hold its case" in said,
          "with a warning")


def without_checkpoint(run: Runs) -> None:
    none = ("output.checkpoint_every=0",)
    run.good("a run without checkpoints", 1, "bare", settings=none, end=4.0)
    run.refused("is not begun again by --resume with another material", "bare",
                "--resume", settings=(*none, "material.0.solid.E=0.7"),
                texts=("the run in 'bare' is of another case:",
                       "material.0.solid.E: was 0.5417, is 0.7",
                       "--overwrite"))
    said = run.good("but with its own", 1, "bare", "--resume", settings=none,
                    end=6.0)
    check("begins at the start" in said
          and len(history(run.directory / "bare")) == 3, "at the start")


def failed(run: Runs) -> None:
    result = run(2, "failed", settings=("solver.max_newton=1",
                                        "solver.max_augmentations=1",
                                        "time.cut_back=false"))
    out = run.directory / "failed"
    log = (out / "run.log").read_text()
    check(result.returncode == 1
          and len(re.findall(r"^\S+  error: the step from t = 0 ", log,
                             re.MULTILINE)) == 1
          and (out / "case.toml").exists() and not (out / "history.csv").exists(),
          "a run that fails in its first step leaves a log with the error")
    run.good("and nothing in the way of the next", 1, "failed", end=4.0)


def warned(run: Runs) -> None:
    text = "loads change until 500, and the run ends at "
    said = run.good("a run with a warning", 2, "warned")
    first = said.find("step 1/")
    log = run.directory / "warned" / "run.log"
    check(said.count(text + "20") == 1 and said.find(text) < first
          and log.read_text().count(text + "20") == 1,
          "says it before its first step, once, and in the log")
    said = run.good("a resumed one", 1, "warned", "--resume", end=24.0)
    check(said.count(text + "24") == 1
          and log.read_text().count(text + "24") == 1,
          "says it too")


def miniapp(run: Runs) -> None:
    """The programs that are written in C++ do the same."""
    mesh = run.directory / "indentation.msh"
    make_mesh("indentation.py", mesh, "--size", "1.9")
    command = [MPIEXEC, "-n", "2", PROGRAMS / "indentation", "--mesh", mesh,
               "--output", "indentation", "--order", "1", "--fields-every", "0",
               "--end", "300"]
    output = run.directory / "indentation"

    def start(*more: str) -> subprocess.Popen:
        return subprocess.Popen([*command, *more], text=True,
                                stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, cwd=run.directory)

    stopped = start("--step", "2")
    wait_for_steps(stopped, output / "history.csv", 3)
    for pid in descendants(stopped.pid):
        os.kill(pid, signal.SIGINT)
    text, _ = stopped.communicate(timeout=60)
    said = re.search(r"stopped at t = (\S+); go on with:\n(.+)\n", text)
    if not said:
        print(text)
    check(said is not None, "indentation: Ctrl-C says how to go on")
    # Longer steps, for the time that they take.
    result = subprocess.run(["bash", "-c", said[2] + " --set time.step=50"],
                            cwd="/", text=True, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, timeout=120)
    if result.returncode != 0:
        print(result.stdout)
    check(result.returncode == 0 and history(output)[-1]["t"] == 300
          and f"goes on from t = {said[1]}," in result.stdout,
          f"indentation: {said[2]} goes on")
    for option, status, message in (
            ((), 1, "holds results of a run: history.csv"),
            (("--resume", "--overwrite"), 1, "exclude each other"),
            (("--resume",), 0, "goes on from t = 300"),
            (("--overwrite",), 0, "step 6/6")):
        again = start("--step", "50", *option)
        text, _ = again.communicate(timeout=120)
        if message not in text:
            print(text)
        check(again.returncode == status and message in text,
              f"indentation {' '.join(option)}: '{message}'")


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        run = Runs(pathlib.Path(name))
        used(run)
        at_once(run)
        without_locks(run)
        changed(run)
        without_case(run)
        without_checkpoint(run)
        failed(run)
        warned(run)
        miniapp(run)
    finish()


if __name__ == "__main__":
    main()
