#!/usr/bin/env python3
# processors: 1
"""Tests of scripts/report.py, on outputs made up, whole and damaged."""

import base64
import html.parser
import pathlib
import re
import shutil
import sys
import tempfile
import unittest
from xml.etree import ElementTree

import numpy as np
import pyvista

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "tests/support")]
sys.dont_write_bytecode = True
import report  # noqa: E402
import report_history  # noqa: E402
import report_setup  # noqa: E402
from report_log import RunLog  # noqa: E402
from report_units import Units  # noqa: E402
from run_main import run_main  # noqa: E402
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
2026-01-01T10:00:01Z  step 1  t 1  dt 1  seconds 1  failed tries 2, inaccurate 1; last: the residual grows
2026-01-01T10:00:02Z  step 2  t 2  dt 1  seconds 1  failed tries 1, inaccurate 0
2026-01-01T10:00:03Z  stopped at t = 4; go on with --resume
"""


class Images(html.parser.HTMLParser):
    """The images of a page by their descriptions, and what it refers to."""

    def __init__(self, text: str):
        super().__init__()
        self.images: dict[str, ElementTree.Element] = {}
        # With the texts, which are drawn as outlines, in comments.
        self.sources: dict[str, str] = {}
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
            self.sources[named["alt"]] = data.decode()


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


def words_of(text: str) -> str:
    """A page without its pictures, for messages that can be read."""
    return re.sub(r'src="[^"]*"', "", text)


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
        status, _, complained = run_main(report.main, *arguments)
        return status, complained

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
            "Worst penetration", "Error of the fluid balance",
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
        words = words_of(text)
        for part in ("Reached t (s)</th><td>4 of 8: not finished",
                     "3 failed, 1 inaccurate",
                     "Peak force on the destination (N)",
                     "Largest area (mm²)", "Worst pressure jump (MPa)",
                     "-10 along z at t = 3 s", "-20 along z at t = 3 s",
                     "Peak fluid pressure (MPa)</th><td>0.25 at t = 3 s",
                     "4.0e-08 of the exchanged volume, at t = 2 s: balanced",
                     "2.5 on average, 4 at most, 10 in all",
                     "5.0e-11: balanced",
                     "synovia 0.1.0, MFEM 4.9.0 (release)",
                     "Two &lt;b&gt;pairs&lt;/b&gt; &amp; more",
                     "displacement (mm)</td><td>x: 0; y: 0.02; "
                     "z: 0 at t = 0, -0.05 at t = 4",
                     "go on with --resume"):
            self.assertIn(part, words)
        self.assertNotIn("<b>pairs", words)
        self.assertNotIn("step 2  t 2", words)
        self.assertNotIn("units of the case", words)
        for label in ("time (s)", "force (N)"):
            self.assertIn(f"<!-- {label} -->",
                          page.sources["Contact force on the destination"])

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

    def test_numbers_without_units_say_so(self):
        folder = self.place / "no_units"
        write_csv(folder / "history.csv", history(3, ("joint",)))
        self.assertEqual(self.run_script(folder), (0, ""))
        text = (folder / "report.html").read_text()
        for part in ("Reached t (units of the case)",
                     "Peak traction (units of the case)",
                     "Peak fluid pressure (units of the case)",
                     "--units LENGTH,FORCE,TIME"):
            self.assertIn(part, words_of(text))
        for name, label in (("Contact area", "area"),
                            ("Peak fluid pressure", "pressure"),
                            ("Contact area", "time")):
            self.assertIn(f"<!-- {label} (units of the case) -->",
                          Images(text).sources[name])

    def test_what_the_run_complained_of_comes_first(self):
        folder = self.place / "complaints"
        write_csv(folder / "history.csv", history(2, ()))
        (folder / "run.log").write_text(LOG + "".join(
            f"2026-01-01T10:00:0{i}Z  {text}\n" for i, text in enumerate((
                "warning: nu = 0.499 of <menisci>", "error: an old one",
                "synovia 0.1.0, MFEM 4.9.0 (release)",
                "warning: nu = 0.499 of <menisci>",
                "warning: a load takes 1e-9 gel times",
                "error: the step from t = 2 with dt = 1 failed: the linear "
                "solver did not converge in 300 iterations"))))
        self.assertEqual(self.run_script(folder), (0, ""))
        words = words_of((folder / "report.html").read_text())
        places = [words.find(part) for part in (
            "Error:</b> the step from t = 2 with dt = 1 failed",
            "Warning:</b> nu = 0.499 of &lt;menisci&gt;",
            "Warning:</b> a load takes 1e-9 gel times", "<h2>What to try</h2>",
            "solver.linear=&quot;direct&quot;", "<h2>Summary</h2>")]
        self.assertNotIn(-1, places)
        self.assertEqual(places, sorted(places))
        self.assertEqual(words.count("Warning:</b>"), 2)
        # It was overcome: only the log has it.
        self.assertEqual(words.count("an old one"), 1)

    def test_a_run_without_a_row_has_a_page(self):
        error = ("error: the step from t = 0 with dt = 0.5 failed: the "
                 "contact's active set did not settle in 30 iterations\n")
        header = "t,dt\n"
        for content, more, words in (
                (None, error, "ended in its first step, for the reason above"),
                ("", "", "or the run was ended before it was done"),
                (header, "", "has no rows"), (header + "1", "", "no whole row"),
                (header + "1,x\n", "", "&#x27;x&#x27;"),
                ("a,b\n1,2\n", "", "no column &#x27;t&#x27;")):
            with self.subTest(words):
                folder = self.copy("history.csv")
                if content is not None:
                    (folder / "history.csv").write_text(content)
                with open(folder / "run.log", "a") as log:
                    log.write("2026-01-01T10:00:04Z  " + more if more else "")
                status, complained = self.run_script(folder)
                self.assertEqual(status, 0)
                self.assertIn("history.csv'", complained)
                text = (folder / "report.html").read_text()
                page = words_of(text)
                self.assertFalse(Images(text).images)
                for part in (words, "<h2>No step was completed</h2>",
                             "<h2>What to try</h2>", "--check",
                             "<h2>What was set up</h2>", "bone",
                             "<h2>Case file</h2>", "order 2, 1234 dofs"):
                    self.assertIn(part, page)
                self.assertEqual("Error:</b> the step from t = 0" in page,
                                 bool(more))
                self.assertNotIn("<h2>Summary</h2>", page)

    def test_nothing_of_another_run_is_shown(self):
        folder = self.place / "mixed"
        write_csv(folder / "history.csv", history(3, ("joint",)))
        (folder / "case.toml").write_text(
            '[time]\nend = 3\n[output]\nfields_every = 1\n'
            '[[output.line]]\nname = "axis"\n')
        ranks = [body((0, 0, 0), (2, 2, 1), 1)]
        write_collection(folder, "bodies", {3: ranks, 3.5: ranks, 8: ranks})
        write_collection(folder, "contact_knee", {3: [surface()]})
        for name, time in (("axis", 2), ("axis", 20), ("rim", 2)):
            write_line(folder, name, time)
        status, complained = self.run_script(folder)
        self.assertEqual(status, 0)
        text = (folder / "report.html").read_text()
        for part in (
                "the fields 'bodies' at t = 3.5, 8 are not shown: the history "
                "has no such time, so that they are left from another run",
                "the fields 'contact_knee' are left from another run and are "
                "not shown: this one has no such pair",
                "the line 'axis' at t = 20 are not shown",
                "the line 'rim' is left from another run"):
            self.assertIn(f"report.py: warning: {part}", complained)
        images = Images(text)
        shown = {name for name in images.images
                 if "t = " in name or name.startswith("line")}
        self.assertEqual(shown, {"section at t = 3", "fluid pressure at t = 3",
                                 "line axis"})
        self.assertNotIn("t = 20", images.sources["line axis"])
        with open(folder / "case.toml", "a") as case:
            case.write("[mesh]\n")
        (folder / "case.toml").write_text("[output]\nfields_every = 0\n")
        status, complained = self.run_script(folder)
        self.assertIn("this one wrote none (fields_every = 0)", complained)
        self.assertNotIn("<h2>Fields</h2>",
                         (folder / "report.html").read_text())

    def test_strains_and_what_they_mean(self):
        folder = self.place / "strains"
        for strain, volume, words in (
                (-0.05, 0.94, ()),
                (-0.2, 0.45, ("-20 % at t = 3; beyond 10 %, where the theory "
                              "of small strains", "0.45 at t = 3; below 0.5, a "
                              "body is pressed to half its volume or less")),
                (-1.2, -0.3, ("-0.3 at t = 3; below zero, a body is turned "
                              "inside out",))):
            with self.subTest(strain):
                shape = np.arange(1, 4) / 3
                write_csv(folder / "history.csv", history(3, ()) | {
                    "strain.max_principal": strain * shape,
                    "strain.min_det_F": 1 + (volume - 1) * shape})
                self.assertEqual(self.run_script(folder), (0, ""))
                text = (folder / "report.html").read_text()
                page = words_of(text)
                self.assertIn(f"{100 * strain:g} % at t = 3", page)
                self.assertIn(f"{volume:g} at t = 3", page)
                for part in words:
                    self.assertIn(part, page)
                self.assertEqual("; be" in page.split("</style>")[1],
                                 bool(words))
                self.assertIn("<!-- limit of small strains -->",
                              Images(text).sources["Smallest volume ratio"])
                self.assertIn("Largest principal strain", Images(text).images)

    def test_colors_that_end_below_the_peak_say_so(self):
        """A needle of pressure is left out of the colors, not of the label."""
        folder = self.place / "needle"
        write_csv(folder / "history.csv", history(3, ("joint",)))
        grid = body((0, 0, 0), (2, 2, 2), 1)
        top = np.argmax(grid.points @ (1, -1, 1))
        grid["fluid_pressure"] = np.ones(grid.n_points)
        grid["fluid_pressure"][top] = 87.5
        skin = surface()
        skin["contact_pressure"][0] = 65.5
        skin["contact_status"][:] = 1
        write_collection(folder, "bodies", {3: [grid]})
        write_collection(folder, "contact_joint", {3: [skin]})
        self.assertEqual(self.run_script(folder, "--units", "mm,N,s"), (0, ""))
        sources = Images((folder / "report.html").read_text()).sources
        self.assertIn("(MPa); beyond the arrow to 87.5",
                      sources["fluid pressure at t = 3"])
        self.assertIn("contact pressure (MPa); beyond the arrow to 65.5",
                      sources["contact pressure of joint at t = 3"])

    def test_no_report_without_a_run_or_a_place(self):
        for content, words in ((None, "cannot read"), ("", "has no rows")):
            with self.subTest(words):
                folder = self.copy("history.csv", "case.toml", "run.log")
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
                b",5.000000000000000000e-01\n", b",nan\n", 1),
             "no numbers in: solver.seconds"),
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
        self.assertEqual(Units().label("force", "force"),
                         "force (units of the case)")
        self.assertEqual(Units().label("strain", ""), "strain")
        known = Units.parse("mm,N,s")
        self.assertEqual(known.label("kappa", "permeability"),
                         "kappa (mm⁴/(N s))")
        with self.assertRaises(KeyError):
            known.of("no such kind")

    def test_times_of_phases(self):
        log = RunLog(LOG + "2026-01-01T10:00:09Z  total 20.0 s: linear "
                     "systems 10.5 s, their set-up 5.0 s, assembly 0.9 s\n")
        rows = dict(report_history.work_rows(
            Table(self.out / "history.csv"), log))
        self.assertEqual(rows["Wall time of the run (s)"],
                         "20: linear systems 10.5 (52 %), their set-up 5 "
                         "(25 %), assembly 0.9 (4 %)")

    def test_what_to_try_fits_the_error(self):
        case = {"time": {"step": 0.5}}
        for error, words in (
                ("nothing resists the force on \"top\": it would move by 1e9",
                 "Hold the body"),
                ("the linear solver did not converge in 9 iterations",
                 "solver.linear"),
                ("the surfaces overlap by up to 1", "initial_overlap"),
                ("cannot write 'x': No space left on device", "Make room"),
                ("gap out of tolerance after 30 augmentations",
                 "time.step=0.05")):
            with self.subTest(error):
                texts = report_setup.remedies([error], case)
                self.assertIn(words, texts[0])
                self.assertIn("--check", texts[-1])
        self.assertIn("time.step=...",
                      report_setup.remedies(["Newton's method"], {})[0])


class Materials(unittest.TestCase):
    def test_a_mixture_is_that_of_its_parts(self):
        solid = {"model": "mixture", "solids": [
            {"model": "neo_hookean", "E": 0.075, "nu": 0.3},
            {"model": "fiber_nh", "mu": 50.0}]}
        flow = {"model": "holmes_mow", "value": 4e-3, "M": 2.0, "alpha": 2.0}
        case = {"material": [{"regions": ["meniscus"], "solid": solid,
                              "permeability": flow, "solid_fraction": 0.25}]}
        self.assertEqual(
            report_setup.material_rows(case),
            [("meniscus", "neo hookean; fiber nh", "E = 0.075; mu = 50",
              "nu = 0.3", "holmes mow, 0.004, M = 2, alpha = 2", "0.25")])


if __name__ == "__main__":
    unittest.main()
