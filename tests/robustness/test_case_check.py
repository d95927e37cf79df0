#!/usr/bin/env python3
# processors: 1
"""Damaged case files and wrong options, through the program itself.

Each ends soon, with exit status 1 and one message on standard error that says
where, or is a case that passes the check. The unit test case_fuzz does the same
to thousands within one process.
"""

from __future__ import annotations

import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import unittest

from test_bad_input import NOISE, TinyMesh, WITHOUT_WAITING, environment

PROGRAM = pathlib.Path(os.environ.get("SYNOVIA_BUILD_DIR", "build"),
                       "miniapps", "synovia")
MPIEXEC = os.environ.get("MPIEXEC", "mpiexec")
CASE = pathlib.Path(__file__).parents[2] / "miniapps/cases/indentation.toml"
PATIENCE = 60   # seconds
MUTANTS = 40


class Driver(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory(prefix="synovia-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "indentation.msh").write_text(TinyMesh().text())
        self.case = self.folder / "case.toml"
        self.case.write_text(CASE.read_text())

    def run_it(self, *arguments: str | pathlib.Path,
               ranks: int = 0) -> subprocess.CompletedProcess:
        command = [str(PROGRAM.resolve()), *map(str, arguments)]
        if ranks:
            command = [MPIEXEC, "-n", str(ranks), *command]
        with subprocess.Popen(command, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True,
                              errors="replace", cwd=self.folder,
                              env=environment() | WITHOUT_WAITING,
                              start_new_session=True) as run:
            try:
                out, err = run.communicate(timeout=PATIENCE)
            except subprocess.TimeoutExpired:
                os.killpg(run.pid, signal.SIGKILL)
                self.fail(f"hangs: {command}")
        for noise in NOISE:
            self.assertNotIn(noise, out + err)
        return subprocess.CompletedProcess(command, run.returncode, out, err)

    def assert_good(self, run: subprocess.CompletedProcess) -> None:
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        self.assertEqual(run.stderr, "")

    def assert_error(self, run: subprocess.CompletedProcess,
                     *texts: str) -> None:
        said = f"\nstatus {run.returncode}\n{run.stdout}\n{run.stderr}"
        self.assertEqual(run.returncode, 1, said)
        self.assertEqual(run.stderr.count("synovia: error: "), 1, said)
        for text in texts:
            self.assertIn(text, run.stderr, said)


class GoodCase(Driver):
    def test_check(self) -> None:
        for ranks in (0, 3):
            run = self.run_it(self.case, "--check", ranks=ranks)
            self.assert_good(run)
            for text in ("cartilage", "indenter_bottom", "H_A", "gel time",
                         "255.7", "indenter-cartilage", "GB of memory"):
                self.assertIn(text, run.stdout)
            self.assertNotIn("warning", run.stdout)
            self.assertFalse((self.folder / "out").exists())

    def test_warnings(self) -> None:
        run = self.run_it(self.case, "--check", "--set",
                          "material.cartilage.permeability.value=4e-15",
                          "--set", "material.indenter.permeability.value=4e-12",
                          "--set", "time.end=100")
        self.assert_good(run)
        self.assertIn("all permeabilities look 1e+12 times too small",
                      run.stdout)
        self.assertIn("hardly any fluid moves", run.stdout)
        self.assertIn("the run ends at 100", run.stdout)
        self.assertIn('"axis" is not sampled at 250', run.stdout)

    def test_warnings_say_where(self) -> None:
        text = self.case.read_text()
        self.case.write_text(text[:text.index("[[output.line]]")])
        said = {}
        for ranks in (0, 2, 3):
            run = self.run_it(self.case, "--check", "--set",
                              "mesh.scale=0.001", ranks=ranks)
            self.assert_good(run)
            (said[ranks],) = (line for line in run.stdout.splitlines()
                              if line.startswith("warning: "))
        self.assertEqual(len(set(said.values())), 1, said)
        for text in ("case.toml:", "mesh.file: the mesh looks 1000 times too "
                     "small", "set mesh.scale = 1"):
            self.assertIn(text, said[0])

    def test_forgotten_symmetry(self) -> None:
        text = self.case.read_text()
        old = """[[boundary]]
surfaces = ["symmetry_y"]
displacement = ["free", 0, "free"]
"""
        self.assertIn(old, text)
        self.case.write_text(text.replace(old, ""))
        run = self.run_it(self.case, "--check", ranks=2)
        self.assert_good(run)
        for text in ('"symmetry_y" of "cartilage" in the plane y = 0',
                     '"indenter" ends there too',
                     'prescribe displacement = ["free", 0, "free"]'):
            self.assertIn(text, run.stdout)
        (row,) = (line for line in run.stdout.splitlines()
                  if line.split()[:1] == ["symmetry_y"])
        self.assertIn("traction-free, sealed", row)

    def test_runs_and_goes_on(self) -> None:
        coarse = ["--set", "space.order=1", "--set", "time.step=50"]
        for ranks, arguments in ((0, ["--set", "time.end=100"]),
                                 (2, ["--set", "time.end=200", "--resume"])):
            self.assert_good(self.run_it(self.case, *coarse, *arguments,
                                         "--output", "here", ranks=ranks))
        history = (self.folder / "here" / "history.csv").read_text()
        times = [float(line.split(",")[0])
                 for line in history.splitlines()[1:]]
        self.assertEqual(times, [50, 100, 150, 200])
        self.assert_error(
            self.run_it(self.case, "--set", "space.order=2", "--output",
                        "here", "--resume"), "checkpoint_")

    def test_never_touched(self) -> None:
        coarse = ["--set", "space.order=1", "--set", "time.step=50"]
        lifted = ('boundary.indenter_top.displacement='
                  '["free", "free", {times = [0, 50, 100], '
                  'values = [0, %s, 0.01]}]')
        says = 'warning: contact pair "indenter-cartilage" never touched'
        run = self.run_it(self.case, *coarse, "--set", lifted % "0.01",
                          "--set", "time.end=50", "--output", "up", ranks=2)
        self.assert_good(run)
        self.assertIn(says, run.stdout)
        self.assertIn(says, (self.folder / "up" / "run.log").read_text())
        # What touched before it went on has touched.
        for arguments in (["time.end=50"], ["time.end=100", "--resume"]):
            run = self.run_it(self.case, *coarse, "--set", lifted % "-0.01",
                              "--set", *arguments, "--output", "down")
            self.assert_good(run)
            self.assertNotIn(says, run.stdout)

    def test_prints(self) -> None:
        schema = self.run_it("--dry-schema")
        self.assert_good(schema)
        self.assertIn("material.N.solid.E", schema.stdout)
        version = self.run_it("--version")
        self.assert_good(version)
        self.assertIn("MFEM", version.stdout)
        self.assertIn("--resume", self.run_it("--help", ranks=2).stdout)


class WrongOptions(Driver):
    def test_options(self) -> None:
        for arguments, texts in (
                ([], ["no case file"]),
                (["--chekc", "case.toml"], ["--chekc", "--check?"]),
                (["case.toml", "other.toml"], ["two case files"]),
                (["case.toml", "--set"], ["--set needs a value"]),
                (["case.toml", "--check=yes"], ["takes no value"]),
                (["case.toml", "--resume", "--restart", "f"], ["exclude"]),
                (["case.toml", "--set", "time.stpe=1"], ["did you mean"]),
                (["case.toml", "--restart", "none.h5"], ["none.h5"]),
                (["none.toml"], ["none.toml: there is no such file"]),
                (["."], ["this is a directory"])):
            with self.subTest(arguments=arguments):
                self.assert_error(self.run_it(*arguments), *texts)

    def test_on_ranks(self) -> None:
        self.assert_error(self.run_it("none.toml", ranks=3),
                          "none.toml: there is no such file")


class WrongCase(Driver):
    def change(self, old: str, new: str) -> None:
        text = self.case.read_text()
        self.assertIn(old, text)
        self.case.write_text(text.replace(old, new, 1))

    def test_names(self) -> None:
        self.change('surfaces = ["bone"]', 'surfaces = ["bones"]')
        self.change('source = ["indenter_bottom"]', 'source = ["indenter"]')
        for ranks in (0, 3):
            self.assert_error(
                self.run_it(self.case, "--check", ranks=ranks),
                "boundary.0.surfaces.0", 'did you mean "bone"?',
                "contact.0.source.0", "cartilage_top")

    def test_region_without_material(self) -> None:
        self.change('regions = ["indenter"]', 'regions = ["cartilage"]')
        self.assert_error(self.run_it(self.case, "--check"), "cartilage")

    def test_nothing_holds_it(self) -> None:
        text = self.case.read_text()
        first = text.index("[[contact]]")
        self.case.write_text(text[:first] + text[text.index("[time]"):])
        self.change('displacement = [0, "free", "free"]', "pressure = 0")
        self.assert_error(self.run_it(self.case, "--check"),
                          'nothing holds "indenter" along x')

    def test_mesh(self) -> None:
        self.assert_error(
            self.run_it(self.case, "--set", 'mesh.file="none.msh"'),
            "mesh.file", "none.msh", "there is no such file")
        (self.folder / "indentation.msh").unlink()
        for ranks in (0, 3):
            self.assert_error(
                self.run_it("case.toml", "--check", ranks=ranks),
                "case.toml:", "mesh.file", "indentation.msh",
                "there is no such file", "scripts/run case.toml",
                "scripts/run_python meshes/indentation.py -o indentation.msh")
        self.change('generator = ["indentation.py"]', "")
        self.assertNotIn("scripts/run",
                         self.run_it("case.toml", "--check").stderr)
        (self.folder / "indentation.msh").write_text("solid\n")
        self.assert_error(self.run_it(self.case, "--check"), "case.toml:",
                          "mesh.file", "$MeshFormat")

    def test_frames(self) -> None:
        text = self.case.read_text()
        for frame, texts in (
                ('{between = ["bone"]}',
                 ["material.1.frame.between",
                  'goes with "cylindrical", not with "cartesian"']),
                ('{type = "cylindrical", between = ["bone"], '
                 'around = ["bone"]}',
                 ["material.1.frame.around", "one of origin, between"]),
                ('{type = "cylindrical", origin = [9, 9, 9], '
                 'between = ["bone"]}',
                 ["material.1.frame.between", "somewhere else too"]),
                ('{type = "cylindrical", around = ["bones"]}',
                 ["material.1.frame.around.0", 'did you mean "bone"?']),
                ('{type = "cylindrical", around = ["symmetry_x"]}',
                 ["material.1", "no circle fits"])):
            with self.subTest(frame=frame):
                self.case.write_text(text)
                self.change('regions = ["indenter"]',
                            f'regions = ["indenter"]\nframe = {frame}')
                self.assert_error(self.run_it(self.case, "--check"), *texts)

    def test_line_out_of_the_mesh(self) -> None:
        self.assert_error(
            self.run_it(self.case, "--check", "--set",
                        "output.line.axis.to=[0, 0, 9]"),
            "output.line.3: line 'axis'")

    def test_damaged(self) -> None:
        text = self.case.read_text()
        text = "\n".join(line for line in text.splitlines()
                         if not line.startswith("#"))
        good = 0
        for seed in range(MUTANTS):
            chance = random.Random(seed)
            damaged = bytearray(text.encode())
            for _ in range(chance.randint(1, 3)):
                at = chance.randrange(len(damaged) - 1)
                way = chance.randrange(4)
                if way == 0:
                    damaged[at] = chance.randrange(256)
                elif way == 1:
                    del damaged[at:at + chance.randint(1, 20)]
                elif way == 2:
                    other = chance.randrange(len(damaged))
                    damaged[at:at] = damaged[other:other + 20]
                else:
                    lines = damaged.split(b"\n")
                    chance.shuffle(lines)
                    damaged = bytearray(b"\n".join(lines))
            self.case.write_bytes(damaged)
            with self.subTest(seed=seed):
                run = self.run_it(self.case, "--check")
                if run.returncode == 0:
                    good += 1
                else:
                    self.assert_error(run, "case.toml")
        self.assertLess(good, MUTANTS)


if __name__ == "__main__":
    if not PROGRAM.exists():
        sys.exit(f"{PROGRAM} is not built; set SYNOVIA_BUILD_DIR")
    unittest.main()
