#!/usr/bin/env python3
"""Compares the work of linear iterations with what memory can move.

Runs two curved layers in contact (miniapps/scaling, hexahedra of order 1, block
AMG) with a library that times each piece of work in an iteration and adds up the
bytes of the matrices and factors that it reads. Reading these once at the rate
at which all ranks together read memory is the least that it can take. The table,
OUT/roofline.md, is in the order of what each piece takes beyond that; the first
row is what an improvement gains most from. Ranks wait for each other after each
piece: "waiting" is what they are out of balance.

--from PREFIX makes the table from the files of any run, PREFIX.RANK.csv, as
LD_PRELOAD=libsynovia_work_clock.so SYNOVIA_WORK_TIMES=PREFIX writes them.
"""

from __future__ import annotations

import argparse
import csv
import dataclasses
import pathlib
import sys
import tempfile

SCRIPTS = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(SCRIPTS / "lib"))

from benchmark_options import add_runner_options  # noqa: E402
from benchmark_runs import BenchmarkError, Run, Runner  # noqa: E402

ITERATION = "iteration"
MEMORY = "memory"
# What an iteration does beside named work: FGMRES and its vectors.
VECTORS = "vectors"


@dataclasses.dataclass
class Work:
    """One rank's, or that of all."""

    calls: int
    seconds: float
    bytes: float


def read_rank(file: pathlib.Path) -> dict[str, Work]:
    """Work in linear iterations, and reading memory, by name."""
    works = {}
    try:
        with open(file, newline="", encoding="utf-8") as stream:
            for row in csv.DictReader(stream):
                if row["phase"] in (ITERATION, MEMORY):
                    name = (MEMORY if row["phase"] == MEMORY
                            else row["work"] or VECTORS)
                    works[name] = Work(int(row["calls"]),
                                       float(row["seconds"]),
                                       float(row["bytes"]))
    except (OSError, KeyError, ValueError) as error:
        raise BenchmarkError(f"cannot read '{file}': {error}") from error
    if MEMORY not in works:
        raise BenchmarkError(f"'{file}' is not whole: was the run stopped?")
    return works


def read_ranks(prefix: pathlib.Path) -> dict[str, Work]:
    """The longest time of all ranks, and the bytes of all together."""
    files = sorted(prefix.parent.glob(prefix.name + ".*.csv"))
    if not files:
        raise BenchmarkError(f"there are no files '{prefix}.RANK.csv'")
    everyone: dict[str, Work] = {}
    for file in files:
        for name, work in read_rank(file).items():
            total = everyone.setdefault(name, Work(0, 0.0, 0.0))
            total.calls = max(total.calls, work.calls)
            total.seconds = max(total.seconds, work.seconds)
            total.bytes += work.bytes
    return everyone


def table_of(works: dict[str, Work]) -> str:
    memory = works[MEMORY]
    rate = memory.bytes / memory.seconds
    work_done = {name: work for name, work in works.items()
                 if name != MEMORY and work.seconds > 0.0}
    whole = sum(work.seconds for work in work_done.values())
    if whole == 0.0:
        raise BenchmarkError("the run has no linear iterations")

    def beyond(work: Work) -> float:
        return work.seconds - work.bytes / rate

    lines = [f"All ranks together read {rate / 1e9:.1f} GB/s of memory; linear "
             f"iterations took {whole:.2f} s.", "",
             "| work | calls | ms each | MB each | of memory's rate | of the "
             "iterations' time | of it beyond reading |", "|---" * 7 + "|"]
    for name, work in sorted(work_done.items(),
                             key=lambda item: -beyond(item[1])):
        known = work.bytes > 0.0
        megabytes = f"{work.bytes / work.calls / 1e6:.1f}" if known else ""
        share = (f"{100 * work.bytes / work.seconds / rate:.0f} %" if known
                 else "")
        lines.append(
            f"| {name} | {work.calls} "
            f"| {1e3 * work.seconds / work.calls:.2f} | {megabytes} | {share} "
            f"| {100 * work.seconds / whole:.0f} % "
            f"| {100 * beyond(work) / whole:.0f} % |")
    return "\n".join(lines) + "\n"


def run_layers(args: argparse.Namespace) -> dict[str, Work]:
    runner = Runner(args.program, args.launcher, args.timeout, args.output)
    with tempfile.TemporaryDirectory(dir=args.output) as name:
        prefix = pathlib.Path(name) / "times"
        runner.load("work_clock", "SYNOVIA_WORK_TIMES", prefix)
        row = runner(Run(args.ranks, size=args.size, order=1, steps=1,
                         solver="block_amg"))
        if row["status"] != "ok":
            raise BenchmarkError(row["status"])
        print(f"{row['dofs']} unknowns, {row['linear']} linear iterations")
        return read_ranks(prefix)


def parse(argv: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="benchmark --roofline", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--from", dest="prefix", type=pathlib.Path,
                        metavar="PREFIX", help="files of a run that was made")
    parser.add_argument("--ranks", type=int, default=2, metavar="N",
                        help="default: %(default)s")
    parser.add_argument("--size", type=int, default=60, metavar="CELLS",
                        help="cells along an edge of the lower layer (default: "
                        "%(default)s)")
    add_runner_options(parser)
    args = parser.parse_args(argv)
    if args.ranks < 1 or args.size < 2:
        parser.error("--ranks is at least 1, --size at least 2")
    return args


def main(argv: list[str] | None = None) -> int:
    args = parse(argv)
    try:
        args.output.mkdir(parents=True, exist_ok=True)
        works = read_ranks(args.prefix) if args.prefix else run_layers(args)
        text = table_of(works)
        (args.output / "roofline.md").write_text(text, encoding="utf-8")
    except (BenchmarkError, OSError) as error:
        print(f"benchmark --roofline: error: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("benchmark --roofline: stopped", file=sys.stderr)
        return 130
    print(text, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
