#!/usr/bin/env python3
# processors: 1
"""The Python package says what its functions take and give.

Requirements: mypy finds nothing, in its strict mode; all that `import synovia`
gives has docstrings, and so has what is public in it.
"""

from __future__ import annotations

import inspect
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))

from program_checks import check, finish  # noqa: E402
from python_package import PACKAGE, synovia  # noqa: E402

CACHE = pathlib.Path(os.environ["SYNOVIA_BUILD_DIR"]) / "mypy_cache"


def mypy(*arguments: object) -> tuple[int, str]:
    run = subprocess.run(
        [sys.executable, "-m", "mypy", "--cache-dir", CACHE, *arguments],
        cwd=PACKAGE, text=True, stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT)
    return run.returncode, run.stdout


def check_types() -> None:
    status, text = mypy()
    print(text)
    check(status == 0, "mypy finds nothing in the package")
    with tempfile.TemporaryDirectory() as folder:
        user = pathlib.Path(folder) / "user.py"
        user.write_text("import synovia\n"
                        "result = synovia.Result('out')\n"
                        "wrong: int = result.history\n")
        status, text = mypy(user)
        check(status == 1 and "Table" in text,
              f"it knows what users get: {text.strip()}")


def public_members(owner: type) -> dict[str, object]:
    """What a class defines itself, without what it inherits."""
    return {name: member for name, member in vars(owner).items()
            if not name.startswith("_")
            and (inspect.isfunction(member)
                 or isinstance(member, (property, classmethod, staticmethod)))}


def check_docstrings() -> None:
    for name in synovia.__all__:
        thing = getattr(synovia, name)
        check(bool(inspect.getdoc(thing)), f"{name} has a docstring")
        if not inspect.isclass(thing):
            continue
        without = [member for member, value in public_members(thing).items()
                   if not inspect.getdoc(value)]
        check(not without, f"and so have its members: {without}")


def main() -> None:
    check_docstrings()
    check_types()
    finish()


if __name__ == "__main__":
    main()
