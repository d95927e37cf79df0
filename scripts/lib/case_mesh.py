"""Makes the mesh of a case by the script that its [mesh] generator names.

usage: case_mesh.py CASE.toml [KEY.PATH=VALUE...]

Nothing is made if the mesh is there, was made by the same command, and isn't
older than the mesh scripts. A mesh that was made otherwise is left as it is.
"""

from __future__ import annotations

import json
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile

import case_settings
from case_settings import CaseSettings

MESHES = pathlib.Path(__file__).resolve().parents[2] / "meshes"
# A section that readers of meshes skip; what comes last says what made it.
MADE_BY = "synovia generator: "
TAIL = 4096     # bytes


class GeneratorError(Exception):
    """Says why a generator can't be used."""


def scripts() -> list[str]:
    """What may be a generator: the programs of meshes/."""
    return sorted(file.name for file in MESHES.glob("*.py")
                  if file.read_bytes().startswith(b"#!"))


def command_of(generator: object) -> list[str]:
    """The name of a script and its arguments, once they are harmless."""
    if not (isinstance(generator, list) and generator
            and all(isinstance(word, str) for word in generator)):
        raise GeneratorError(
            "it must be a list of strings, the name of a script of meshes/ "
            'and its arguments, such as ["boxes.py", "two_columns"]')
    name, *arguments = generator
    if name not in scripts():
        raise GeneratorError(
            f"'{name}' is not a mesh script; those of {MESHES} are: "
            + ", ".join(scripts()))
    for argument in arguments:
        if names_output(argument):
            raise GeneratorError(
                f"'{argument}' would say where the mesh goes; leave it out: "
                "it goes to mesh.file")
    return generator


def names_output(argument: str) -> bool:
    """Whether a mesh script may take this for -o or --output, or a part."""
    if argument.startswith("--"):
        return "--output".startswith(argument.partition("=")[0])
    return argument.startswith("-") and "o" in argument.partition("=")[0]


def made_by(mesh: pathlib.Path) -> list[str] | None:
    """The command that made a mesh, if it was made here."""
    with open(mesh, "rb") as file:
        file.seek(max(0, mesh.stat().st_size - TAIL))
        tail = file.read().decode("utf-8", errors="replace")
    for line in reversed(tail.splitlines()):
        if line.startswith(MADE_BY):
            try:
                return json.loads(line.removeprefix(MADE_BY))
            except ValueError:
                return None
    return None


def is_older(mesh: pathlib.Path) -> bool:
    age = mesh.stat().st_mtime
    return any(file.stat().st_mtime > age for file in MESHES.glob("*.py"))


def make(command: list[str], settings: CaseSettings) -> None:
    """Puts the mesh into place; what else the script writes is left out."""
    mesh = settings.mesh.absolute()
    if not mesh.parent.is_dir():
        raise GeneratorError(f"there is no directory '{mesh.parent}'")
    print(f"synovia: generating {settings.mesh}: {shlex.join(command)}",
          flush=True)
    name, *arguments = command
    with tempfile.TemporaryDirectory(dir=mesh.parent, prefix=".mesh-") as work:
        part = pathlib.Path(work) / mesh.name
        run = subprocess.run(
            [sys.executable, MESHES / name, "-o", part, *arguments],
            cwd=settings.folder.absolute())
        if run.returncode != 0 or not part.exists():
            raise GeneratorError(f"{shlex.join(command)} made no mesh (see "
                                 f"above; exit status {run.returncode})")
        with open(part, "a", encoding="utf-8") as file:
            file.write(f"$Comments\n{MADE_BY}{json.dumps(command)}\n"
                       "$EndComments\n")
        os.replace(part, mesh)


def bring_up_to_date(settings: CaseSettings) -> None:
    mesh = settings.mesh
    command = command_of(settings.generator)
    if mesh.exists():
        before = made_by(mesh)
        if before is None:
            print(f"synovia: {mesh} is taken as it is: scripts/run didn't make "
                  "it. To have it made, remove it", flush=True)
            return
        if before == command and not is_older(mesh):
            return
    make(command, settings)


def main(argv: list[str]) -> int:
    case, *overrides = argv
    settings = case_settings.read(pathlib.Path(case), overrides)
    if not settings or not settings.mesh or settings.generator is None:
        return 0    # synovia says what is missing
    try:
        bring_up_to_date(settings)
    except (GeneratorError, OSError) as error:
        print(f"synovia: error: {case}: mesh.generator: {error}",
              file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
