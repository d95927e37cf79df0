#!/usr/bin/env python3
"""Measures the tables of timings in README.md and scripts/README.md.

    febio        two cases on hexahedra of order 1, beside FEBio's times
    indentation  the default indentation, by phases
    adaptive     the indentation with fixed and adaptive steps
    scaling      one step of two curved layers, up to a million unknowns

Writes OUT/tables.md: each table with commit, date, processor, memory and
versions of libraries. --write-tables puts them into the READMEs as well,
between the comments that name them. Times mean something on an idle machine
only. Meshes are made by meshes/, so that this Python needs gmsh and scipy.
"""

from __future__ import annotations

import argparse
import pathlib
import sys

SCRIPTS = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(SCRIPTS / "lib"))

import machine  # noqa: E402
import readme_tables  # noqa: E402
from benchmark_cases import CaseRunner  # noqa: E402
from benchmark_options import add_launcher  # noqa: E402
from benchmark_runs import BenchmarkError, Runner  # noqa: E402
from benchmark_tables import TABLES, Benchmark  # noqa: E402

READMES = (SCRIPTS.parent / "README.md", SCRIPTS / "README.md")


def factor(text: str) -> float:
    value = float(text)
    if not value >= 1.0:
        raise argparse.ArgumentTypeError(f"{text} is less than 1")
    return value


def parse(argv: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="benchmark --tables", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true",
                        help="leave out a million unknowns: about five "
                        "minutes on two cores")
    parser.add_argument("--table", action="append", choices=TABLES,
                        help="only this one; may be repeated")
    parser.add_argument("--write-tables", action="store_true",
                        help="put the tables into the READMEs")
    parser.add_argument("--coarsen", type=factor, default=1.0,
                        metavar="FACTOR", help="elements so much larger: to "
                        "see whether everything runs")
    add_launcher(parser)
    parser.add_argument("--programs", type=pathlib.Path, metavar="DIRECTORY",
                        default=SCRIPTS.parent / "build/miniapps",
                        help="where they are (default: %(default)s)")
    parser.add_argument("-o", "--output", type=pathlib.Path, metavar="OUT",
                        default=pathlib.Path("out/benchmark"),
                        help="default: %(default)s")
    args = parser.parse_args(argv)
    if args.write_tables and args.coarsen != 1.0:
        parser.error("--write-tables is for meshes as they are, without "
                     "--coarsen")
    return args


def main(argv: list[str] | None = None) -> int:
    args = parse(argv)
    names = args.table or list(TABLES)
    try:
        folder = args.output / "tables"
        folder.mkdir(parents=True, exist_ok=True)
        measure = Benchmark(
            CaseRunner(args.programs / "synovia", args.launcher,
                       folder.resolve(), args.coarsen),
            Runner(args.programs / "scaling", args.launcher, 1800.0, folder),
            args.quick)
        note = "Measured: " \
            + machine.description(args.programs / "synovia") + "."
        texts = {}
        for name in names:
            print(name, flush=True)
            texts[name] = TABLES[name](measure).markdown(note)
        file = args.output / "tables.md"
        file.write_text("\n".join(f"{readme_tables.begin(name)}\n{text}"
                                  for name, text in texts.items()),
                        encoding="utf-8")
        print(f"wrote {file}")
        for readme in READMES if args.write_tables else ():
            found = readme_tables.write(readme, texts)
            print(f"wrote {', '.join(found) or 'nothing'} into {readme}")
    except (BenchmarkError, OSError, ValueError) as error:
        print(f"benchmark: error: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("benchmark: stopped", file=sys.stderr)
        return 130
    return 0


if __name__ == "__main__":
    sys.exit(main())
