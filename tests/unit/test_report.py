#!/usr/bin/env python3
"""Tests of scripts/report.py, on outputs made up, whole and damaged."""

import base64
import contextlib
import html.parser
import io
import pathlib
import shutil
import sys
import tempfile
import unittest
from xml.etree import ElementTree

try:
    import matplotlib  # noqa: F401
    import numpy as np
    import pyvista
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(242)

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "tests/support")]
sys.dont_write_bytecode = True
import report  # noqa: E402
import report_history  # noqa: E402
from report_history import Units  # noqa: E402
from synovia_output import Table  # noqa: E402
from synthetic_output import box, write_collection, write_csv  # noqa: E402

PAIRS = ("medial.femur", "lateral")
CASE = """# As it ran
title = "Two <b>pairs</b> & more"
[time]
end = 8
[[boundary]]
surfaces = ["bone"]
displacement = [0, 0.02, {times = [0, 4], values = [0, -0.05]}]
"""
LOG = """2026-01-01T10:00:00Z  synovia 0.1.0, MFEM 4.9.0 (release)
2026-01-01T10:00:00Z  order 2, 1234 dofs on 2 ranks, set up in 0.1 s
2026-01-01T10:00:01Z  step 1  t 1  dt 1  seconds 1  failed tries 2, inaccurate 1
2026-01-01T10:00:02Z  step 2  t 2  dt 1  seconds 1  failed tries 1, inaccurate 0
2026-01-01T10:00:03Z  stopped at t = 4; go on with --resume
"""


class Images(html.parser.HTMLParser):
    """The images of a page by their descriptions, and what it refers to."""

    def __init__(self, text: str):
        super().__init__()
        self.images: dict[str, ElementTree.Element] = {}
        self.references: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        named = dict(attributes)
        for key in ("src", "href"):
            if key in named:
                self.references.append(named[key])
        if tag == "img":
            data = base64.b64decode(named["src"].split(",", 1)[1])
            self.images[named["alt"]] = ElementTree.fromstring(data)


def history(steps: int, pairs: tuple = PAIRS) -> dict:
    """Columns whose peaks are known: forces of 10 and 20 at t = 3."""
    t = np.arange(1.0, steps + 1)
    shape = 1 - np.abs(t - 3) / 10
    columns = {"t": t, "dt": np.ones(steps)}
    for i, axis in enumerate("xyz"):
        columns[f"reaction.bone.{axis}"] = i * shape
    for i, pair in enumerate(pairs):
        prefix = f"contact.{pair}."
        for axis, part in zip("xyz", (0.1, 0, -1)):
            columns[f"{prefix}force_{axis}"] = 10 * (i + 1) * part * shape
        columns[f"{prefix}force_error"] = 1e-9 * shape
        columns[f"{prefix}area"] = shape
        columns[f"{prefix}penetration"] = 1e-6 * shape
        columns[f"{prefix}pressure_jump"] = 0 * shape
        columns[f"{prefix}peak_traction"] = 0.7 * shape
        columns[f"{prefix}fluid_exchange"] = 0.01 * shape
    return columns | {
        "fluid.growth": -0.5 * shape, "fluid.outflow": 0.5 * shape,
        "fluid.volume_balance": 2e-8 * shape,
        "fluid.peak_pressure": 0.25 * shape, "solver.newton": 2 + 0 * t,
        "solver.augmentations": t, "solver.linear": 10 * t,
        "solver.most_linear": 9 + 0 * t, "solver.seconds": 0.5 + 0 * t}


def body(low: tuple, high: tuple, region: int) -> pyvista.UnstructuredGrid:
    grid = box(low, high, region)
    r = np.linalg.norm(grid.points - (0, 0, 1), axis=1)
    grid["fluid_pressure"] = np.exp(-r)
    grid["effective_stress"] = grid["total_stress"].copy()
    return grid


def surface() -> pyvista.UnstructuredGrid:
    plane = pyvista.Plane(center=(1, 1, 1), i_size=2, j_size=2,
                          i_resolution=8, j_resolution=8)
    grid = plane.triangulate().cast_to_unstructured_grid()
    r = np.linalg.norm(grid.points[:, :2], axis=1)
    grid["contact_pressure"] = np.maximum(1 - r, 0)
    grid["contact_status"] = (r < 1).astype(float)
    return grid


def write_line(folder: pathlib.Path, name: str, time: float) -> None:
    s = np.linspace(0, 1, 5)
    write_csv(folder / "lines" / f"{name}_t{time:g}.csv",
              {column: s for column in ("s", "x", "y", "z", "p", "ux", "uy",
                                        "uz", "sxx", "syy", "szz", "esxx",
                                        "esyy", "eszz")})


def write_output(folder: pathlib.Path) -> None:
    """An unfinished run of two pairs, with everything that a run may write."""
    write_csv(folder / "history.csv", history(4))
    (folder / "case.toml").write_text(CASE)
    (folder / "run.log").write_text(LOG)
    for time in (1, 4):
        write_line(folder, "axis", time)
    ranks = [body((0, 0, 0), (2, 2, 1), 1), body((0, 0, 1), (2, 2, 2), 2)]
    write_collection(folder, "bodies", {2: ranks, 4: ranks})
    for pair in PAIRS:
        write_collection(folder, f"contact_{pair}", {2: [surface()]})


class Report(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.temp = tempfile.TemporaryDirectory()
        cls.place = pathlib.Path(cls.temp.name)
        cls.out = cls.place / "out"
        cls.out.mkdir()
        write_output(cls.out)

    @classmethod
    def tearDownClass(cls):
        cls.temp.cleanup()

    def run_script(self, *arguments) -> tuple[int, str]:
        """The exit status, and what went to stderr."""
        complained = io.StringIO()
        with contextlib.redirect_stdout(io.StringIO()), \
                contextlib.redirect_stderr(complained):
            status = report.main([str(a) for a in arguments])
        return status, complained.getvalue()

    def copy(self, *without: str) -> pathlib.Path:
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.place)) / "out"
        shutil.copytree(self.out, folder)
        for name in without:
            target = folder / name
            shutil.rmtree(target) if target.is_dir() else target.unlink()
        return folder

    def test_page_shows_everything_and_needs_no_other_file(self):
        file = self.place / "page.html"
        status, complained = self.run_script(self.out, "-o", file,
                                             "--units", "mm,N,s")
        self.assertEqual((status, complained), (0, ""))
        text = file.read_text()
        page = Images(text)
        self.assertTrue(all(r.startswith("data:image/svg+xml;base64,")
                            for r in page.references), page.references)
        self.assertLessEqual({
            "Contact force on the destination", "Reactions of the supports",
            "Contact area", "Peak fluid pressure", "Peak contact traction",
            "Worst penetration", "Fluid balance, over the exchanged volume",
            "Iterations of each step", "Step length", "line axis",
            "section at t = 2", "section at t = 4", "fluid pressure at t = 2",
            *(f"contact pressure of {p} at t = 2" for p in PAIRS)},
            set(page.images))
        # All zeros have no place on a logarithmic scale.
        self.assertNotIn("Worst pressure jump in contact", page.images)
        for name, image in page.images.items():
            self.assertGreater(len(list(image.iter())), 40, name)
        for name in ("section at t = 2", "fluid pressure at t = 2"):
            self.assertTrue(list(page.images[name].iter(
                "{http://www.w3.org/2000/svg}image")), name)
        for words in ("4 s of 8: not finished", "3 failed, 1 inaccurate",
                      "-10 N along z at t = 3", "-20 N along z at t = 3",
                      "0.25 MPa at t = 3", "4.0e-08 of the exchanged volume",
                      "2.5 on average, 4 at most, 10 in all", "5.0e-11",
                      "synovia 0.1.0, MFEM 4.9.0 (release)",
                      "Two &lt;b&gt;pairs&lt;/b&gt; &amp; more",
                      "go on with --resume"):
            self.assertIn(words, text)
        self.assertNotIn("<b>", text)
        self.assertNotIn("step 2  t 2", text)

    def test_what_is_there_will_do(self):
        folder = self.place / "least"
        for columns in ({"t": [1.0]}, history(1, ()), history(1)):
            with self.subTest(len(columns)):
                write_csv(folder / "history.csv", columns)
                status, complained = self.run_script(folder)
                self.assertEqual((status, complained), (0, ""))
                text = (folder / "report.html").read_text()
                self.assertIn("<h1>least</h1>", text)
                self.assertEqual(bool(Images(text).images), len(columns) > 1)
                self.assertEqual("Pair" in text, "Worst penetration" in text)

    def test_many_pairs(self):
        folder = self.place / "many"
        pairs = tuple(f"pair_{i}" for i in range(12))
        write_csv(folder / "history.csv", history(5, pairs))
        self.assertEqual(self.run_script(folder), (0, ""))
        text = (folder / "report.html").read_text()
        for pair in pairs:
            self.assertIn(f"<td>{pair}</td>", text)

    def test_no_report_without_a_history_or_a_place(self):
        header = "t,dt\n"
        for content, words in ((None, "cannot read"), ("", "has no rows"),
                               (header, "has no rows"),
                               (header + "1", "has no whole row"),
                               (header + "1,x\n", "'x'"),
                               ("a,b\n1,2\n", "no column 't'")):
            with self.subTest(words):
                folder = self.copy("history.csv")
                file = folder / "history.csv"
                if content is not None:
                    file.write_text(content)
                status, complained = self.run_script(folder)
                self.assertEqual(status, 1)
                self.assertRegex(complained, f"^report.py: error: .*{file}.*")
                self.assertIn(words, complained)
                self.assertFalse((folder / "report.html").exists())
        nowhere = self.place / "nowhere"
        for arguments, words in (
                ((nowhere,), f"there is no directory '{nowhere}'"),
                ((self.out, "-o", nowhere / "a.html"),
                 f"cannot write '{nowhere / 'a.html'}'"),
                ((self.out, "-o", self.place), "is a directory"),
                ((self.out, "--units", "mm,N"), "not LENGTH,FORCE,TIME")):
            with self.subTest(words):
                status, complained = self.run_script(*arguments)
                self.assertEqual(status, 1)
                self.assertIn(words, complained)

    def test_what_is_damaged_is_said_and_the_rest_is_shown(self):
        def cut(data: bytes) -> bytes:
            return data[:len(data) // 2]

        damages = (
            ("case.toml", lambda data: data + b"=\n", "case.toml'"),
            ("history.csv", lambda data: data.replace(
                b"1.000000000000000000e+00", b"nan", 1),
             "no numbers in: t"),
            ("lines/axis_t4.csv", lambda data: b"s,p\n1,2\n",
             "no column 'uz'"),
            ("fields/bodies/Cycle0/proc0.vtu", lambda data: data.replace(
                b"effective_stress", b"stress"), "effective_stress not found"),
            ("fields/bodies/Cycle1/proc1.vtu", cut, "proc1.vtu' is cut short"),
            ("fields/contact_lateral/Cycle0/data.pvtu", cut,
             "data.pvtu' is cut short"),
            ("fields/contact_medial.femur/contact_medial.femur.pvd", cut,
             "medial.femur.pvd' is damaged"))
        folder = self.copy()
        for name, change, _ in damages:
            file = folder / name
            before = file.read_bytes()
            file.write_bytes(change(before))
            self.assertNotEqual(file.read_bytes(), before, name)
        status, complained = self.run_script(folder)
        self.assertEqual(status, 0)
        text = (folder / "report.html").read_text()
        self.assertEqual(text.count('class="warning"'), len(damages))
        for name, _, words in damages:
            self.assertRegex(complained, f"report.py: warning: .*{words}")
        images = Images(text).images
        self.assertIn("Contact area", images)
        self.assertIn("line axis", images)
        self.assertFalse([name for name in images if " at t = " in name])

    def test_numbers_of_the_summary(self):
        file = self.place / "numbers.csv"
        write_csv(file, {"t": [1, 2, 3], "fluid.growth": [-1, -0.5, 0],
                         "fluid.outflow": [1, 0.5, 0],
                         "fluid.volume_balance": [1e-7, 1e-7, 1e-12],
                         "contact.a.force_x": [0, 1, 2],
                         "contact.a.force_y": [0, 0, -5],
                         "contact.a.force_z": [0, 1, np.nan]})
        table = Table(file)
        np.testing.assert_allclose(report_history.balance_error(table),
                                   [1e-7, 2e-7, 0])
        np.testing.assert_allclose(report_history.pair_force(table, "a"),
                                   [0, 0, -5])
        self.assertEqual(report_history.main_direction({}, table), 1)
        self.assertEqual(report_history.main_direction(
            {"boundary": [{"displacement": ["free", 0, -0.1]}]}, table), 2)
        self.assertEqual(report_history.key_time(table), 3)
        self.assertEqual(Units.parse("m, N,s").of("pressure"), "Pa")
        self.assertEqual(Units().label("force", "force"), "force")


if __name__ == "__main__":
    unittest.main()
