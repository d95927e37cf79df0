"""What was measured, and on what: for tables of timings."""

from __future__ import annotations

import datetime
import os
import pathlib
import platform
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]


def output_of(*command: str | pathlib.Path) -> str:
    """What a command prints; nothing if it can't be run or fails."""
    try:
        return subprocess.run(command, stdout=subprocess.PIPE, check=True,
                              stderr=subprocess.DEVNULL, text=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return ""


def processor() -> str:
    try:
        for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    except OSError:
        pass
    return platform.processor() or platform.machine()


def memory() -> str:
    size = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    return f"{size / 2**30:.0f} GiB"


def commit() -> str:
    """Of the sources; "-dirty" says that they have been changed since."""
    found = output_of("git", "-C", ROOT, "describe", "--always", "--dirty",
                      "--exclude", "*").strip()
    return f"commit {found}" if found else "sources without a commit"


def blas(program: pathlib.Path) -> str:
    """The library that a program finds at run time, with its version."""
    for line in output_of("ldd", program).splitlines():
        found = re.match(r"\s*lib(?:open|mkl_\w*|bl)\w*\.so\S* => (\S+)", line)
        if found and "blas" in line:
            file = os.path.realpath(found[1])
            # Debian's alternatives: .../openblas-serial/libblas.so.3
            kind = pathlib.Path(file).parent.name if "blas" in \
                pathlib.Path(file).parent.name else pathlib.Path(file).name
            package = output_of("dpkg-query", "--search", file).split(":")[0]
            version = output_of("dpkg-query", "--show",
                                "--showformat=${Version}", package) \
                if package else ""
            return f"{kind} {version.split('+')[0]}".strip()
    return "unknown BLAS"


def versions(program: pathlib.Path) -> list[str]:
    """Of the libraries, as `synovia --version` lists them."""
    return [line.removeprefix("MPI ") for line in
            output_of(program, "--version").splitlines()[1:]]


def description(program: pathlib.Path) -> str:
    """One sentence; @a program is the case driver."""
    cores = len(os.sched_getaffinity(0))
    parts = [commit(), datetime.date.today().isoformat(),
             f"{cores} cores of {processor()}", memory(),
             *versions(program), blas(program)]
    return ", ".join(parts)
