#!/usr/bin/env python3
"""A report on a run: one web page that needs no other file.

Reads OUT, the output directory of any run (history.csv, and what there is of
case.toml, run.log, lines/ and fields/), and writes OUT/report.html: a summary,
the history of forces, pressures, errors and iterations, sampled lines,
pictures of the fields and the case file. Runs that are not finished will do.
"""

from __future__ import annotations

import argparse
import os
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "lib"))

import missing_module  # noqa: E402,F401

import numpy as np  # noqa: E402

import figure_style as style  # noqa: E402
import report_fields  # noqa: E402
import report_history  # noqa: E402
import section  # noqa: E402
from report_history import Units  # noqa: E402
from report_page import Page, svg  # noqa: E402
from synovia_output import Output, OutputError, Table  # noqa: E402


class Report:
    """Puts a page together; what is damaged is said on it and on stderr."""

    def __init__(self, out: Output, units: Units):
        self.out = out
        self.units = units
        self.history = out.history()
        self.history["t"]   # or it is no history
        self.log = out.text("run.log") or ""
        damage: list[str] = []
        try:
            self.case = out.case()
        except OutputError as error:
            self.case = {}
            damage.append(str(error))
        self.up = report_history.main_direction(self.case, self.history)
        self.page = Page(self.case.get("title") or out.directory.resolve().name,
                         self.versions())
        for text in damage:
            self.warn(text)
        strange = [name for name, values in self.history.items()
                   if not np.isfinite(values).all()]
        if strange:
            self.warn(f"'{self.history.file}' has values that are no numbers "
                      f"in: {', '.join(strange)}")

    def warn(self, text: str) -> None:
        print(f"report.py: warning: {text}", file=sys.stderr)
        self.page.warn(text)

    def versions(self) -> list[str]:
        """What ran, and when; of the last run if there were several."""
        found = re.findall(r"^(\S+)  (synovia .+)$", self.log, re.MULTILINE)
        size = re.findall(r"^\S+  (order \d+, .+)$", self.log, re.MULTILINE)
        lines = [f"{found[-1][1]}; begun {found[-1][0]}"] if found else []
        lines += size[-1:]
        if not self.units.length:
            lines.append("Numbers are in the units of the case.")
        return lines

    def write_summary(self) -> None:
        self.page.heading("Summary")
        self.page.table(report_history.run_rows(
            self.history, self.case, self.log, self.units))
        pairs = report_history.pair_rows(self.history, self.units)
        if pairs:
            self.page.table(pairs, report_history.PAIR_HEADINGS)

    def write_history(self) -> None:
        self.page.heading("History")
        self.page.pictures([
            (title, svg(figure)) for title, figure
            in report_history.plots(self.history, self.units)])

    def write_lines(self) -> None:
        figures = list(report_fields.line_figures(
            self.out, self.up, self.units, self.warn))
        if figures:
            self.page.heading("Sampled lines")
        for name, figure in figures:
            figure.suptitle(name, x=0.01, ha="left", fontsize=9.5)
            self.page.pictures([(f"line {name}", svg(figure))])

    def write_fields(self) -> None:
        names = self.out.collections()
        if not names:
            return
        self.page.heading("Fields")
        if "bodies" in names:
            self.each_time("bodies", self.write_bodies)
        for name in names:
            if name.startswith("contact_"):
                self.each_time(name, self.write_contact)

    def each_time(self, name: str, write) -> None:
        """Calls write(name, grids by time); warns of what can't be read."""
        grids = {}
        key = report_history.key_time(self.history)
        try:
            times = self.out.field_times(name)
        except OutputError as error:
            self.warn(str(error))
            return
        for time in report_fields.picture_times(times, key):
            try:
                grids[time] = self.out.fields(name, time)
            except OutputError as error:
                self.warn(str(error))
        try:
            write(name, grids)
        except OutputError as error:
            self.warn(str(error))

    def write_bodies(self, name: str, grids: dict) -> None:
        if not grids:
            return
        for grid in grids.values():
            section.require_fields(grid, report_fields.BODY_FIELDS,
                                   self.out.directory)
        key = min(grids, key=lambda t: abs(
            t - report_history.key_time(self.history)))
        cut = report_fields.section_plane(grids[key], self.up)
        for time, grid in grids.items():
            figure = report_fields.sections_figure(grid, self.up, cut, time,
                                                   self.units)
            self.page.pictures([(f"section at t = {time:g}", svg(figure))])
        self.page.pictures([
            (f"fluid pressure at t = {key:g}", svg(report_fields.view_figure(
                grids[key], self.up, key, self.units)))])

    def write_contact(self, name: str, grids: dict) -> None:
        pair = name.removeprefix("contact_")
        self.page.pictures([
            (f"contact pressure of {pair} at t = {time:g}",
             svg(report_fields.contact_figure(grid, pair, time, self.units)))
            for time, grid in grids.items()])

    def write_case(self) -> None:
        text = self.out.text("case.toml")
        if text:
            self.page.heading("Case file")
            self.page.literal(text)
        if self.log:
            lines = self.log.splitlines()
            notable = [line for line in lines
                       if not re.match(r"\S+  step \d+  t ", line)]
            self.page.heading("Log, without the steps")
            self.page.literal("\n".join(notable))

    def write(self) -> str:
        """The page's text."""
        self.write_summary()
        self.write_history()
        self.write_lines()
        self.write_fields()
        self.write_case()
        return str(self.page)


def save(text: str, file: pathlib.Path) -> None:
    """Writes the file, whole or not at all."""
    part = file.with_name(file.name + ".part")
    try:
        part.write_text(text, encoding="utf-8")
        os.replace(part, file)
    except OSError as error:
        part.unlink(missing_ok=True)
        raise OutputError(f"cannot write '{file}': {error.strerror}") \
            from error


def main(argv: list[str] | None = None) -> int:
    parser = argparse.ArgumentParser(
        prog="report", description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path, metavar="OUT",
                        help="output directory of the run")
    parser.add_argument("-o", "--output", type=pathlib.Path,
                        help="the page (default: OUT/report.html)")
    parser.add_argument("--units", default="",
                        help="the case's units, to be written on the plots: "
                        "LENGTH,FORCE,TIME, such as mm,N,s")
    args = parser.parse_args(argv)
    file = args.output or args.out / "report.html"
    try:
        units = Units.parse(args.units) if args.units else Units()
        out = Output(args.out)
        if file.is_dir():
            raise OutputError(f"cannot write '{file}': it is a directory")
        # Before the pictures, which take their time
        if not os.access(file.parent, os.W_OK):
            raise OutputError(f"cannot write '{file}': there is no directory "
                              f"'{file.parent}' that may be written to")
        style.use_style()
        save(Report(out, units).write(), file)
    except (OutputError, ValueError) as error:
        print(f"report.py: error: {error}", file=sys.stderr)
        return 1
    print(f"wrote {file}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
