#!/usr/bin/env python3
"""A report on a run: one web page that needs no other file.

Reads OUT, the output directory of any run (history.csv, case.toml, run.log,
lines/ and fields/, as far as present), and writes OUT/report.html: the errors
and warnings of the run, a summary, the history of forces, pressures, errors and
iterations, sampled lines, pictures of the fields and the case. Runs that are
not finished will do, and those that failed in their first step.
"""

from __future__ import annotations

import argparse
import os
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent / "lib"))

import missing_module  # noqa: E402,F401

import numpy as np  # noqa: E402

import figure_style as style  # noqa: E402
import report_fields  # noqa: E402
import report_history  # noqa: E402
import report_plots  # noqa: E402
import report_setup  # noqa: E402
import section  # noqa: E402
from report_log import RunLog  # noqa: E402
from report_page import Page, svg  # noqa: E402
from report_times import RunTimes  # noqa: E402
from report_units import Units  # noqa: E402
from synovia_output import Output, OutputError, Table  # noqa: E402


class Report:
    """Puts a page together; what is damaged is said on it and on stderr."""

    def __init__(self, out: Output, units: Units):
        self.out = out
        self.units = units
        self.log = RunLog(out.text("run.log") or "")
        case_text = out.text("case.toml")
        damage: list[str] = []
        try:
            self.case = out.case()
        except OutputError as error:
            self.case = {}
            damage.append(str(error))
        self.history: Table | None = None
        try:
            self.history = out.history()
            self.history["t"]   # or it is no history
        except OutputError as error:
            self.history = None
            if not self.log and not case_text:
                raise
            damage.append(str(error))
        self.run = RunTimes(self.history, self.case)
        self.page = Page(self.case.get("title") or out.directory.resolve().name,
                         self.subtitle())
        self.say_problems()
        for text in damage:
            self.warn(text)
        if self.history is not None:
            self.check_history(self.history)

    def warn(self, text: str) -> None:
        print(f"report.py: warning: {text}", file=sys.stderr)
        self.page.warn(text)

    def say_problems(self) -> None:
        """What the run itself complained of."""
        for text in self.log.errors():
            self.page.error(text)
        for text in self.log.warnings():
            self.page.warn(text)

    def check_history(self, history: Table) -> None:
        strange = [name for name, values in history.items()
                   if not np.isfinite(values).all()]
        if strange:
            self.warn(f"'{history.file}' has values that are no numbers "
                      f"in: {', '.join(strange)}")

    def subtitle(self) -> list[str]:
        """What ran, and when; of the last run if there were several."""
        lines = [self.log.versions(), self.log.size()]
        if not self.units.known:
            lines.append("Numbers are in the units of the case, which has no "
                         "names for them; --units LENGTH,FORCE,TIME gives "
                         "them.")
        return lines

    def write_what_to_try(self) -> None:
        errors = self.log.errors()
        if self.history is None:
            self.page.heading("No step was completed")
            self.page.text(
                "The run ended in its first step, for the reason above."
                if errors else
                "The history has no row. Either the first step is being "
                "computed, or the run was ended before it was done: by a "
                "signal, for want of memory, or with the machine. Its log says "
                "nothing of an error.")
        if errors or self.history is None:
            self.page.heading("What to try")
            self.page.list(report_setup.remedies(errors, self.case))

    def write_summary(self, history: Table) -> None:
        self.page.heading("Summary")
        self.page.table(report_history.run_rows(
            history, self.case, self.log, self.units))
        pairs = report_history.pair_rows(history, self.units)
        if pairs:
            self.page.table(pairs, report_history.pair_headings(self.units))

    def write_history(self, history: Table) -> None:
        self.page.heading("History")
        self.page.pictures([
            (title, svg(figure)) for title, figure
            in report_plots.plots(history, self.units)])

    def write_lines(self, up: int) -> None:
        lines = {}
        for name, files in self.out.lines().items():
            own = self.run.own_lines(name, files, self.warn)
            if own:
                lines[name] = own
        figures = list(report_fields.line_figures(lines, up, self.units,
                                                  self.warn))
        if figures:
            self.page.heading("Sampled lines")
        for name, figure in figures:
            figure.suptitle(name, x=0.01, ha="left", fontsize=9.5)
            self.page.pictures([(f"line {name}", svg(figure))])

    def write_fields(self, history: Table, up: int) -> None:
        found = []
        for name in self.out.collections():
            try:
                times = self.out.field_times(name)
            except OutputError as error:
                self.warn(str(error))
            else:
                found.append((name, self.run.own_fields(name, times,
                                                        self.warn)))
        shown = [(name, times) for name, times in found if times]
        if not shown:
            return
        self.page.heading("Fields")
        key = report_history.key_time(history)
        for name, times in shown:
            grids = {}
            for time in report_fields.picture_times(times, key):
                try:
                    grids[time] = self.out.fields(name, time)
                except OutputError as error:
                    self.warn(str(error))
            try:
                if name == "bodies":
                    self.write_bodies(grids, up, key)
                elif name.startswith("contact_"):
                    self.write_contact(name, grids)
            except OutputError as error:
                self.warn(str(error))

    def write_bodies(self, grids: dict, up: int, key: float) -> None:
        if not grids:
            return
        for grid in grids.values():
            section.require_fields(grid, report_fields.BODY_FIELDS,
                                   self.out.directory)
        nearest = min(grids, key=lambda t: abs(t - key))
        cut = report_fields.section_plane(grids[nearest], up)
        for time, grid in grids.items():
            figure = report_fields.sections_figure(grid, up, cut, time,
                                                   self.units)
            self.page.pictures([(f"section at t = {time:g}", svg(figure))])
        self.page.pictures([
            (f"fluid pressure at t = {nearest:g}",
             svg(report_fields.view_figure(grids[nearest], up, nearest,
                                           self.units)))])

    def write_contact(self, name: str, grids: dict) -> None:
        pair = name.removeprefix("contact_")
        self.page.pictures([
            (f"contact pressure of {pair} at t = {time:g}",
             svg(report_fields.contact_figure(grid, pair, time, self.units)))
            for time, grid in grids.items()])

    def write_setup(self) -> None:
        """The case in tables."""
        tables = (
            (report_setup.numerics_rows(self.case, self.units), ()),
            (report_setup.material_rows(self.case),
             report_setup.material_headings(self.units)),
            (report_setup.condition_rows(self.case, self.units),
             report_setup.CONDITION_HEADINGS),
            (report_setup.contact_rows(self.case),
             report_setup.CONTACT_HEADINGS))
        if any(rows for rows, _ in tables):
            self.page.heading("What was set up")
        for rows, headings in tables:
            if rows:
                self.page.table(rows, headings)

    def write_case(self) -> None:
        text = self.out.text("case.toml")
        if text:
            self.page.heading("Case file")
            self.page.literal(text)
        if self.log:
            self.page.heading("Log, without the steps")
            self.page.literal(self.log.without_steps())

    def write(self) -> str:
        """The page's text."""
        self.write_what_to_try()
        if self.history is not None:
            up = report_history.main_direction(self.case, self.history)
            self.write_summary(self.history)
            self.write_history(self.history)
            self.write_lines(up)
            self.write_fields(self.history, up)
        self.write_setup()
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
