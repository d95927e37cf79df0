"""Prints a case's output directory.

usage: case_output.py CASE.toml [KEY.PATH=VALUE...]
"""

from __future__ import annotations

import pathlib
import sys

import case_settings

if __name__ == "__main__":
    settings = case_settings.read(pathlib.Path(sys.argv[1]), sys.argv[2:])
    if settings:
        print(settings.output)
