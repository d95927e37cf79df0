#!/usr/bin/env python3
# processors: 1
"""pip install ./scripts/python: the package and its types come along."""

from __future__ import annotations

import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))

from program_checks import (  # noqa: E402
    PROGRAMS, SOURCE, check, finish, run_program)

PACKAGE = SOURCE / "scripts" / "python"


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        target = pathlib.Path(name) / "installed"
        # Dependencies are there, and so is what builds the package.
        run_program(sys.executable, "-m", "pip", "install", "--no-deps",
                    "--no-build-isolation", "--disable-pip-version-check",
                    "--target", target, PACKAGE,
                    text="pip install ./scripts/python")
        sources = {file.name for file in (PACKAGE / "synovia").iterdir()
                   if file.name != "__pycache__"}
        installed = {file.name for file in (target / "synovia").iterdir()
                     if file.name != "__pycache__"}
        check("py.typed" in sources, "the types are declared")
        check(sources == installed, f"{len(sources)} files are installed")
        said = subprocess.run(
            [sys.executable, "-c", "import synovia, sys; "
             "print(synovia.__file__, synovia.Case().time.scheme, "
             "'scipy' in sys.modules, 'pyvista' in sys.modules)"],
            env=os.environ | {"PYTHONPATH": str(target)}, cwd=name, text=True,
            capture_output=True, check=False)
        check(said.returncode == 0, f"it is imported {said.stderr}")
        file, scheme, scipy, pyvista = said.stdout.rsplit(maxsplit=3)
        check(pathlib.Path(file).parent == target / "synovia",
              "the installed one")
        check(scheme == "backward_euler", "it asks the program for its schema")
        check((scipy, pyvista) == ("False", "False"),
              "and loads nothing before it is used")
        version = run_program(PROGRAMS / "synovia", "--version").split()[1]
        check((target / f"synovia-{version}.dist-info").exists(),
              f"its version is the program's, {version}")
    finish()


if __name__ == "__main__":
    main()
