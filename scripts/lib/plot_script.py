"""What the scripts that draw a run's output directory have in common."""

from __future__ import annotations

import argparse
import pathlib
import sys
from collections.abc import Callable, Mapping

import figure_style as style
from figure_style import plt
from synovia_output import Output, OutputError


def run(argv: list[str] | None, doc: str | None, case: str,
        draw: Callable[[Output, pathlib.Path], str]) -> int:
    """The exit status of plot_<case>.py, whose main picture is <case>.png.

    draw() puts the pictures into a directory, and gives the lines to print.
    """
    args = make_parser(doc).parse_args(argv)
    return drawn(case, args, lambda folder: draw(Output(args.out), folder))


def run_beside(argv: list[str] | None, doc: str | None, case: str, other: str,
               draw: Callable[[list[Output], pathlib.Path], str]) -> int:
    """The same of a run and of one of the case `other`, if it is there.

    That is the second argument, or in the directory `other` beside the first.
    """
    parser = make_parser(doc)
    name = other.split("_")[0].upper()
    parser.add_argument("other", type=pathlib.Path, metavar=name, nargs="?",
                        help=f"output directory of {other}.toml (default: "
                        f"{other} beside OUT, if it is there)")
    args = parser.parse_args(argv)

    def draw_both(folder: pathlib.Path) -> str:
        outs = [Output(args.out)]
        beside = args.other or args.out.resolve().parent / other
        if args.other or beside.is_dir():
            outs.append(Output(beside))
        return draw(outs, folder)
    return drawn(case, args, draw_both)


def draw_row(folder: pathlib.Path, case: str,
             panels: Mapping[str, Callable[[plt.Axes], object]]) -> None:
    """Draws each panel by its name, and all of them, beside each other, by that
    of the case.
    """
    style.use_style()
    for name, panel in panels.items():
        figure, axes = plt.subplots(figsize=(3.6, 2.9))
        panel(axes)
        figure.savefig(folder / f"{name}.png", bbox_inches="tight")
        plt.close(figure)
    figure, all_axes = plt.subplots(1, len(panels), figsize=(9.6, 2.9))
    for axes, panel in zip(all_axes, panels.values()):
        panel(axes)
    figure.savefig(folder / f"{case}.png")
    plt.close(figure)


def make_parser(doc: str | None) -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path, metavar="OUT",
                        help="output directory of the run")
    parser.add_argument("-o", "--output", type=pathlib.Path,
                        help="directory for the pictures (default: OUT)")
    return parser


def drawn(case: str, args: argparse.Namespace,
          draw: Callable[[pathlib.Path], str]) -> int:
    try:
        folder = args.output or args.out
        Output(args.out)
        folder.mkdir(parents=True, exist_ok=True)
        print(draw(folder))
    except (OutputError, OSError) as error:
        print(f"plot_{case}.py: error: {error}", file=sys.stderr)
        return 1
    print(f"wrote {folder / f'{case}.png'} and a picture of each panel")
    return 0
