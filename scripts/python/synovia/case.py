"""Cases: what is read from and written to case files, checked and run."""

from __future__ import annotations

import dataclasses
import os
import pathlib
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, cast

from synovia import program
from synovia.errors import CaseError, SynoviaError
from synovia.progress import RunProgress
from synovia.schema import schema
from synovia.section import Section, as_values, class_of
from synovia.toml_text import document

if TYPE_CHECKING:
    from synovia.results import Result
    from synovia.runs import Run

Path = str | os.PathLike[str]


@dataclasses.dataclass(frozen=True)
class Check:
    """What the program's check says of a case that it takes."""

    text: str

    def _lines(self, kind: str) -> list[str]:
        return [line.removeprefix(kind) for line in self.text.splitlines()
                if line.startswith(kind)]

    @property
    def warnings(self) -> list[str]:
        """Likely mistakes."""
        return self._lines("warning: ")

    @property
    def hints(self) -> list[str]:
        """How contact could be more accurate."""
        return self._lines("hint: ")

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return self.text


class Case(Section):
    """A case of the program: Case(), Case("file.toml"), Case(mesh={...}).

    Its keys are attributes, with completion and docstrings from the program's
    own schema; case["material.0.solid.E"] goes by path, and entries of lists
    by number or by name: case.material["cartilage"].solid.E = 0.5.
    """

    def __new__(cls, *_arguments: Any, **_keys: Any) -> Case:
        return cast(Case, object.__new__(class_of(schema(), Case)))

    def __init__(self, source: Path | Mapping[str, Any] | None = None,
                 **keys: Any):
        """From a file or from values, with more keys.

        The mesh is relative to the file, or else to the working directory.
        """
        folder = pathlib.Path.cwd()
        values: Mapping[str, Any] = {}
        if isinstance(source, Section | Mapping):
            values = as_values(source)
            folder = getattr(source, "_folder", folder)
        elif source is not None:
            file = pathlib.Path(source)
            values = _read(file)
            folder = file.absolute().parent
        object.__setattr__(self, "_folder", folder)
        super().__init__(values, **keys)

    @classmethod
    def parse(cls, text: str) -> Case:
        """From the text of a case file."""
        try:
            return cls(tomllib.loads(text))
        except tomllib.TOMLDecodeError as error:
            raise CaseError(f"this is not TOML: {error}") from error

    @property
    def mesh_file(self) -> pathlib.Path:
        """Absolute."""
        name = self["mesh.file"]
        if name is None:
            raise CaseError("mesh.file is not set")
        folder: pathlib.Path = self._folder
        return folder / str(name)

    def __str__(self) -> str:
        return document(as_values(self))

    __repr__ = __str__

    def copy(self, changes: Mapping[str, Any] | None = None) -> Case:
        """Another one, with changes such as {"material.0.solid.E": 0.5}."""
        made = Case(self)
        for path, value in (changes or {}).items():
            made[path] = value
        return made

    def write(self, file: Path) -> None:
        """As TOML; the mesh is named relative to the file."""
        path = pathlib.Path(file)
        values = as_values(self)
        if "file" in values.get("mesh", {}):
            values["mesh"]["file"] = os.path.relpath(
                self.mesh_file, path.absolute().parent)
        path.write_text(document(values), encoding="utf-8")

    def check(self) -> Check:
        """Lets the program check it all: keys, values, the mesh.

        Raises CaseError with all that is wrong.
        """
        with tempfile.TemporaryDirectory(prefix="synovia_") as folder:
            file = pathlib.Path(folder) / "case.toml"
            self.write(file)
            try:
                return Check(program.ask(str(file), "--check"))
            except CaseError as error:
                raise CaseError(str(error).replace(f"{file}:", "line ")) \
                    from None

    def make_mesh(self) -> pathlib.Path:
        """Lets the script that mesh.generator names make mesh.file."""
        generator = self["mesh.generator"]
        if not generator:
            raise CaseError("mesh.generator names no mesh script")
        script = program.mesh_scripts() / generator[0]
        if not script.exists():
            raise CaseError(f"mesh.generator: there is no '{script}'")
        self.mesh_file.parent.mkdir(parents=True, exist_ok=True)
        done = subprocess.run(
            [sys.executable, str(script), *generator[1:], "-o",
             str(self.mesh_file)], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise SynoviaError(done.stderr.strip())
        return self.mesh_file

    def start(self, ranks: int = 1, output: Path | None = None, *,
              overwrite: bool = False, resume: bool = False) -> Run:
        """Begins to run it, and doesn't wait. See run()."""
        from synovia.runs import Run
        return Run(self, ranks, output, overwrite=overwrite, resume=resume)

    def run(self, ranks: int = 1, output: Path | None = None, *,
            overwrite: bool = False, resume: bool = False,
            progress: bool | None = None) -> Result:
        """Runs it to the end, and gives its results.

        ranks: processes; output: a directory in place of output.directory.
        A directory with results of a run is refused, unless overwrite removes
        them or resume goes on from the newest checkpoint there. progress: shown
        in terminals and notebooks, unless it is False or True.

        Ctrl-C lets the step end, saves the state and raises Stopped: run again
        with resume=True. Raises RunError with the program's messages.
        """
        run = self.start(ranks, output, overwrite=overwrite, resume=resume)
        steps = sum(step["duration"] for step in self["step"])
        with RunProgress(self["time.end"] or steps, progress) as show:
            return run.wait(show)


def _read(file: pathlib.Path) -> dict[str, Any]:
    try:
        return tomllib.loads(file.read_text(encoding="utf-8"))
    except OSError as error:
        raise CaseError(f"cannot read '{file}': {error.strerror}") from error
    except ValueError as error:
        raise CaseError(f"{file}: this is not TOML: {error}") from error
