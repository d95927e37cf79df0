"""What the scripts that draw a run's output directory have in common."""

from __future__ import annotations

import argparse
import pathlib
import sys
from collections.abc import Callable

from synovia_output import Output, OutputError


def run(argv: list[str] | None, doc: str | None, case: str,
        draw: Callable[[Output, pathlib.Path], str]) -> int:
    """The exit status of plot_<case>.py, whose main picture is <case>.png.

    draw() puts the pictures into a directory, and gives the lines to print.
    """
    parser = argparse.ArgumentParser(
        description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path, metavar="OUT",
                        help="output directory of the run")
    parser.add_argument("-o", "--output", type=pathlib.Path,
                        help="directory for the pictures (default: OUT)")
    args = parser.parse_args(argv)
    try:
        folder = args.output or args.out
        out = Output(args.out)
        folder.mkdir(parents=True, exist_ok=True)
        print(draw(out, folder))
    except (OutputError, OSError) as error:
        print(f"plot_{case}.py: error: {error}", file=sys.stderr)
        return 1
    print(f"wrote {folder / f'{case}.png'} and a picture of each panel")
    return 0
