"""Where the program is, and the environment in which it runs."""

from __future__ import annotations

import functools
import os
import pathlib
import shutil
import subprocess

from synovia.errors import CaseError, SynoviaError

# As scripts/lib/run.env has them; what the environment says comes first.
ENVIRONMENT = {
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_mpi_yield_when_idle": "1",
    "OMPI_MCA_hwloc_base_binding_policy": "none",
    "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}

IN_BUILD = "miniapps/synovia"

_chosen: pathlib.Path | None = None


def use_program(path: str | os.PathLike[str]) -> None:
    """Takes this `synovia` from now on."""
    global _chosen
    file = pathlib.Path(path).expanduser().absolute()
    if not os.access(file, os.X_OK) or file.is_dir():
        raise SynoviaError(f"'{file}' is no program")
    _chosen = file


def program() -> pathlib.Path:
    """The program `synovia`.

    That of use_program(), of $SYNOVIA_PROGRAM, in the build directory
    $SYNOVIA_BUILD_DIR, in $PATH, or in build/ of the working directory or one
    above it, whichever is first.
    """
    if _chosen:
        return _chosen
    named = os.environ.get("SYNOVIA_PROGRAM")
    if not named and "SYNOVIA_BUILD_DIR" in os.environ:
        named = os.path.join(os.environ["SYNOVIA_BUILD_DIR"], IN_BUILD)
    found = shutil.which(named or "synovia")
    if not found and not named:
        here = pathlib.Path.cwd()
        builds = [folder / "build" / IN_BUILD
                  for folder in (here, *here.parents)]
        found = next((str(file) for file in builds if file.exists()), None)
    if not found:
        where = f"'{named}' is no program" if named else \
            "there is no program 'synovia' in $PATH"
        raise SynoviaError(
            f"{where}; build it, and say where it is by the environment's "
            "SYNOVIA_PROGRAM=FILE or synovia.use_program(FILE)")
    return pathlib.Path(found).absolute()


def command(ranks: int) -> list[str]:
    """What starts the program on this many ranks."""
    if not isinstance(ranks, int) or ranks < 1:
        raise SynoviaError(f"ranks = {ranks!r} is not a number of ranks")
    start = [str(program())]
    if ranks > 1:
        start = [os.environ.get("MPIEXEC", "mpirun"), "-n", str(ranks), *start]
    return start


def environment() -> dict[str, str]:
    """For child processes that run the program."""
    return ENVIRONMENT | dict(os.environ)


def ask(*arguments: str) -> str:
    """What the program prints with these arguments, on one rank.

    Raises CaseError with its messages where it refuses them.
    """
    done = subprocess.run([*command(1), *arguments], capture_output=True,
                          text=True, env=environment(), check=False)
    if done.returncode != 0:
        raise CaseError(done.stderr.strip() or done.stdout.strip()
                        or f"exit status {done.returncode}")
    return done.stdout


@functools.lru_cache(maxsize=4)
def _schema_text(path: str, _modified: float) -> str:
    return ask("--dry-schema")


def schema_text() -> str:
    """What --dry-schema prints; asked for once for each build."""
    path = program()
    return _schema_text(str(path), path.stat().st_mtime)


def mesh_scripts() -> pathlib.Path:
    """The folder of the mesh scripts that belong to the program.

    In the source tree of its build, or installed beside it.
    """
    candidates = []
    if "SYNOVIA_SOURCE_DIR" in os.environ:
        candidates.append(pathlib.Path(os.environ["SYNOVIA_SOURCE_DIR"])
                          / "meshes")
    for folder in program().resolve().parents:
        candidates.append(folder / "share" / "synovia" / "meshes")
        cache = folder / "CMakeCache.txt"
        if cache.exists():
            home = [line.split("=", 1)[1] for line in
                    cache.read_text(errors="replace").splitlines()
                    if line.startswith("CMAKE_HOME_DIRECTORY:")]
            candidates += [pathlib.Path(path) / "meshes" for path in home]
    for folder in candidates:
        if (folder / "mesh_script.py").exists():
            return folder
    raise SynoviaError(
        f"no mesh scripts are beside '{program()}'; SYNOVIA_SOURCE_DIR names "
        "a source tree that has them")
