#!/usr/bin/env python3
"""Audits what each rank of a parallel run holds and sends, and what grows.

Runs one step of two curved layers in contact (miniapps/scaling, hexahedra of
order 1, block AMG) on 1, 2, 4, ... ranks, on however few cores: counts don't
depend on how long ranks wait for each other, and no time is taken from these
runs but the processor time of the one on one rank. Weak: each rank has the same
share of unknowns. Strong: the same problem on all.

Writes to OUT: weak.csv and strong.csv with a row for each run and rank, audit.md
with a table of each and the exponents b of growth ~ ranks^b, and efficiency.png,
where a model made of the counts goes on to 4,096 ranks. The exit status is 1 if
a bound is exceeded, which is said.
"""

from __future__ import annotations

import argparse
import pathlib
import sys

SCRIPTS = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(SCRIPTS / "lib"))

import missing_module  # noqa: E402,F401

import numpy as np  # noqa: E402

import audit_plots  # noqa: E402
import audit_runs  # noqa: E402
from audit_bounds import Bound, bounds_of  # noqa: E402
from audit_model import Model, exponent  # noqa: E402
from audit_plots import NETWORKS  # noqa: E402
from audit_runs import PHASES, Audit, AuditRunner  # noqa: E402
from benchmark_options import add_runner_options  # noqa: E402
from benchmark_runs import BenchmarkError, Run  # noqa: E402


def make_runs(runner: AuditRunner, cells: dict[int, int],
              table: pathlib.Path) -> list[Audit]:
    """Of so many cells for each number of ranks, in a table as far as made."""
    audits: list[Audit] = []
    for ranks, size in cells.items():
        print(f"{ranks} ranks, --size {size}", flush=True)
        audits.append(runner(Run(ranks, size=size, order=1, steps=1,
                                 solver="block_amg")))
        audit_runs.save(audits, table)
    return audits


def held_table(audits: list[Audit]) -> list[str]:
    """What the rank holds that holds most, with the mean of all in brackets."""
    columns = ("dofs", "contact_faces", "entries", "memory", "memory_mesh",
               "memory_equations", "memory_steps", "memory_shared")
    lines = ["| ranks | " + " | ".join(
        name.replace("_", " ") for name in columns) + " |",
        "|---" * (len(columns) + 1) + "|"]
    for audit in audits:
        cells = [f"{audit.held[name].max():,.0f} ({audit.held[name].mean():,.0f})"
                 for name in columns]
        lines.append(f"| {audit.ranks} | " + " | ".join(cells) + " |")
    return lines


def sent_table(audits: list[Audit], phase: str) -> list[str]:
    """Of the rank that sends most, for each Newton iteration."""
    each = 1.0 if phase == "mesh" else None
    lines = ["| ranks | messages | kB | to ranks | collectives | their kB | "
             "largest over mean of messages |", "|---" * 7 + "|"]
    for audit in audits:
        per = each or audit.number("newton")
        sent = audit.sent[phase, "messages"]
        balance = sent.max() / sent.mean() if sent.any() else 1.0
        lines.append(
            f"| {audit.ranks} | {audit.most_sent(phase, 'messages') / per:.1f} "
            f"| {audit.most_sent(phase, 'bytes') / per / 1e3:.1f} "
            f"| {audit.most_sent(phase, 'destinations'):.0f} "
            f"| {audit.most_sent(phase, 'collectives') / per:.1f} "
            f"| {audit.most_sent(phase, 'collective_bytes') / per / 1e3:.2f} "
            f"| {balance:.2f} |")
    return lines


def work_table(audits: list[Audit]) -> list[str]:
    lines = ["| ranks | unknowns | Newton iterations | linear iterations | "
             "most for one system | force |", "|---" * 6 + "|"]
    for audit in audits:
        lines.append(
            f"| {audit.ranks} | {audit.number('dofs'):,.0f} "
            f"| {audit.row['newton']} | {audit.row['linear']} "
            f"| {audit.row['most_linear']} | {audit.number('force'):.8f} |")
    return lines


def growth_table(audits: list[Audit]) -> list[str]:
    settled = [audit for audit in audits if audit.ranks >= 4]
    ranks = np.array([audit.ranks for audit in settled], dtype=float)

    def power(values: list[float]) -> str:
        return f"{exponent(ranks, np.array(values)):.2f}"

    lines = ["| largest of all ranks | exponent from 4 ranks on |",
             "|---|---|"]
    for name in ("memory", "memory_mesh", "memory_equations", "memory_steps",
                 "memory_shared", "entries", "contact_faces"):
        lines.append(f"| {name.replace('_', ' ')} | "
                     + power([a.held[name].max() for a in settled]) + " |")
    for phase in PHASES:
        for kind in ("messages", "bytes", "collectives", "collective_bytes"):
            per = [1.0 if phase == "mesh" else a.number("newton")
                   for a in settled]
            values = [a.most_sent(phase, kind) / n
                      for a, n in zip(settled, per)]
            if any(values):
                lines.append(f"| {phase}: {kind.replace('_', ' ')} | "
                             f"{power(values)} |")
    return lines


def efficiency_table(audits: list[Audit], memory_speedup: float) -> list[str]:
    """By the model, and what a Newton iteration waits for most at last."""
    ranks = 2.0 ** np.arange(6, 13, 2)
    model = Model.of(audits, memory_speedup)
    lines = ["| network | " + " | ".join(f"{n:.0f} ranks" for n in ranks)
             + f" | most beside work, {ranks[-1]:.0f} ranks |",
             "|---" * (len(ranks) + 2) + "|"]
    for network in NETWORKS:
        parts = model.parts(ranks, network)
        del parts["work"]
        most = max(parts, key=lambda name: parts[name][-1])
        lines.append(f"| {network.name} | " + " | ".join(
            f"{value:.2f}" for value in model.efficiency(ranks, network))
            + f" | {most}, {1e3 * parts[most][-1]:.0f} ms |")
    return lines


def report(weak: list[Audit], strong: list[Audit], bounds: list[Bound],
           memory_speedup: float) -> str:
    parts = ["# What each rank holds and sends", ""]
    for title, audits in (("The same share for each rank", weak),
                          ("The same problem", strong)):
        parts += [f"## {title}", "", *work_table(audits), "",
                  "Held by the rank with the largest part (mean): numbers, and "
                  "memory in MiB above what the program has at its start. What "
                  "MPI shares between ranks is apart: each rank that sees it "
                  "counts it whole, and it grows with the ranks of one "
                  "machine.", "",
                  *held_table(audits), ""]
        for phase in PHASES:
            parts += [f"Phase {phase}, "
                      + ("once" if phase == "mesh" else "a Newton iteration")
                      + ":", "", *sent_table(audits, phase), ""]
    parts += ["## Growth with the same share", "", *growth_table(weak), "",
              "## Modeled efficiency, the same share", "",
              *efficiency_table(weak, memory_speedup), "",
              "## Bounds", "", "| what | value | bound | |",
              "|---|---|---|---|"]
    parts += [f"| {bound.what} | {bound.value:.3g} | {bound.limit:.3g} | "
              f"{'kept' if bound.kept else 'EXCEEDED'} |" for bound in bounds]
    return "\n".join(parts) + "\n"


def doublings(most: int) -> list[int]:
    ranks = [1]
    while 2 * ranks[-1] <= most:
        ranks.append(2 * ranks[-1])
    return ranks


def parse(argv: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="benchmark --audit", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--most-ranks", type=int, default=64, metavar="N",
                        help="the largest number (default: %(default)s)")
    parser.add_argument("--each", type=int, default=10, metavar="CELLS",
                        help="cells along an edge for one rank, in the weak "
                        "scaling (default: %(default)s)")
    parser.add_argument("--whole", type=int, default=24, metavar="CELLS",
                        help="the same of the strong scaling (default: "
                        "%(default)s)")
    parser.add_argument("--memory-speedup", type=float, default=1.0,
                        metavar="FACTOR", help="memory bandwidth of a rank on "
                        "the modeled machine over that of one here")
    add_runner_options(parser)
    args = parser.parse_args(argv)
    if args.most_ranks < 4 or args.each < 2 or args.whole < 2:
        parser.error("--most-ranks is at least 4, cells are at least 2")
    return args


def main(argv: list[str] | None = None) -> int:
    args = parse(argv)
    numbers = doublings(args.most_ranks)
    try:
        args.output.mkdir(parents=True, exist_ok=True)
        runner = AuditRunner(args.program, args.launcher, args.timeout,
                             args.output)
        weak = make_runs(runner, {
            ranks: round(args.each * ranks ** (1.0 / 3.0))
            for ranks in numbers}, args.output / "weak.csv")
        strong = make_runs(runner, {ranks: args.whole for ranks in numbers},
                           args.output / "strong.csv")
    except (BenchmarkError, OSError) as error:
        print(f"benchmark --audit: error: {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("benchmark --audit: stopped", file=sys.stderr)
        return 130
    bounds = bounds_of(weak, strong)
    text = report(weak, strong, bounds, args.memory_speedup)
    (args.output / "audit.md").write_text(text, encoding="utf-8")
    audit_plots.efficiency_figure(weak, args.memory_speedup).savefig(
        args.output / "efficiency.png")
    print(text[text.index("## Growth"):])
    print(f"wrote {args.output / 'audit.md'}")
    return 0 if all(bound.kept for bound in bounds) else 1


if __name__ == "__main__":
    sys.exit(main())
