#!/usr/bin/env python3
# processors: 1
"""scripts/run, scripts/run_python, options of scripts/test.

Meshes of a case are made when they have to be, by our scripts only and to
where the case says; runs end with the status of synovia; what is wrong is said.
"""

from __future__ import annotations

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["SYNOVIA_SOURCE_DIR"])
CASES = SOURCE / "miniapps" / "cases"
SHIPPED = sorted(case for case in CASES.glob("*.toml")
                 if not case.name.endswith(".frames.toml"))
PATIENCE = 240  # seconds
COARSE = 'mesh.generator=["boxes.py", "two_columns", "--size", "{}"]'


class Scripts(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory(prefix="synovia run ")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "mine").mkdir()
        self.case = self.folder / "mine" / "case.toml"
        shutil.copy(CASES / "two_columns.toml", self.case)
        self.mesh = self.folder / "mine" / "two_columns.msh"

    def start(self, script: str, *arguments: object
              ) -> subprocess.CompletedProcess:
        """A script of scripts/, from the folder."""
        return subprocess.run(
            [str(SOURCE / "scripts" / script), *map(str, arguments)],
            cwd=self.folder, capture_output=True, text=True, timeout=PATIENCE,
            env=os.environ | {"SYNOVIA_PYTHON": sys.executable,
                              "SYNOVIA_CACHE": str(self.folder / "cache")})

    def run_case(self, *arguments: object, status: int = 0, size: str = "4"
                 ) -> subprocess.CompletedProcess:
        done = self.start("run", "mine/case.toml", "--np", 1, "--set",
                          COARSE.format(size), *arguments)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def assert_error(self, done: subprocess.CompletedProcess,
                     *texts: str) -> None:
        said = f"\nstatus {done.returncode}\n{done.stdout}\n{done.stderr}"
        self.assertEqual(done.returncode, 1, said)
        self.assertIn("error: ", done.stderr, said)
        for text in texts:
            self.assertIn(text, done.stderr, said)


class Run(Scripts):
    def test_mesh_run_report(self) -> None:
        done = self.run_case("--set", "time.end=25")
        self.assertIn("generating mine/two_columns.msh", done.stdout)
        self.assertIn("results are in out/two_columns", done.stdout)
        out = self.folder / "out" / "two_columns"
        rows = (out / "history.csv").read_text().splitlines()
        self.assertEqual(len(rows), 2)
        self.assertIn("Two columns", (out / "report.html").read_text())
        self.assertEqual([file.name for file in self.mesh.parent.iterdir()
                          if file not in (self.case, self.mesh)], [])

        # Elsewhere, and after a run that fails there is no report.
        self.run_case("--output", "other", "--set", "time.end=25",
                      "--set", "solver.max_newton=1",
                      "--set", "time.cut_back=false", status=1)
        self.assertTrue((self.folder / "other" / "run.log").exists())
        self.assertFalse((self.folder / "other" / "report.html").exists())

    def test_mesh_is_made_when_it_has_to_be(self) -> None:
        self.assertIn("generating", self.run_case("--check").stdout)
        self.assertFalse((self.folder / "out").exists())
        self.assertNotIn("generating", self.run_case("--check").stdout)
        self.assertIn("generating", self.run_case("--check", size="3").stdout)
        os.utime(self.mesh, (1, 1))
        self.assertIn("generating", self.run_case("--check", size="3").stdout)
        self.assertGreater(self.mesh.stat().st_mtime, 1)

    def test_mesh_of_somebody_else_is_left_alone(self) -> None:
        made = self.start("run_python", SOURCE / "meshes" / "boxes.py",
                          "two_columns", "-o", self.mesh, "--size", "3")
        self.assertEqual(made.returncode, 0, made.stderr)
        before = self.mesh.read_bytes()
        os.utime(self.mesh, (1, 1))
        self.assertIn("taken as it is", self.run_case("--check").stdout)
        self.assertEqual(self.mesh.read_bytes(), before)

    def test_generators_that_are_none_of_ours(self) -> None:
        program = self.folder / "mine" / "boxes.py"
        program.write_text("#!/bin/sh\ntouch started\n")
        program.chmod(0o755)
        for generator, text in (
                ('["./boxes.py"]', "'./boxes.py' is not a mesh script"),
                (f'["{program}"]', "is not a mesh script"),
                ('["circle_fit.py"]', "those of"),
                ('["boxes.py two_columns"]', "is not a mesh script"),
                ('"boxes.py"', "a list of strings"),
                ('["boxes.py", 3]', "a list of strings"),
                ('["boxes.py", "two_columns", "-o", "a.msh"]', "'-o'"),
                ('["boxes.py", "two_columns", "-oa.msh"]', "'-oa.msh'"),
                ('["indentation.py", "-voa.msh"]', "'-voa.msh'"),
                ('["boxes.py", "two_columns", "--outp=a.msh"]', "--outp"),
                ('["boxes.py", "three_columns"]', "exit status 2")):
            with self.subTest(generator=generator):
                self.assert_error(
                    self.start("run", "mine/case.toml", "--check", "--set",
                               f"mesh.generator={generator}"),
                    "mine/case.toml: mesh.generator: ", text)
        self.assertEqual(sorted(file.name for file in
                                self.folder.rglob("*.*")),
                         ["boxes.py", "case.toml"])

    def test_shipped_cases(self) -> None:
        listed = self.start("run", "--list")
        self.assertEqual(listed.returncode, 0, listed.stderr)
        names = [line.split()[0] for line in listed.stdout.splitlines()]
        self.assertEqual(names, [case.stem for case in SHIPPED])
        for line in listed.stdout.splitlines():
            self.assertGreater(len(line.split()), 1, line)
        checked = self.start("run", "--np=1", "two_columns", "--check", "--set",
                             'mesh.file="here.msh"')
        self.assertEqual(checked.returncode, 0, checked.stderr)
        self.assertTrue((self.folder / "here.msh").exists())

    def test_every_shipped_case_names_a_mesh_script(self) -> None:
        sys.path.insert(0, str(SOURCE / "scripts" / "lib"))
        import case_mesh
        import case_settings
        for case in SHIPPED:
            settings = case_settings.read(case, [])
            with self.subTest(case=case.name):
                # In finite deformation a case may have its namesake's mesh, and
                # cases may share one by the name that its script gives it.
                namesake = case.stem.removesuffix("_finite")
                self.assertIn(settings.mesh.stem, (case.stem, namesake,
                                                   *settings.generator[1:2]))
                self.assertEqual(settings.mesh,
                                 case.with_name(settings.mesh.stem + ".msh"))
                self.assertEqual(case_mesh.command_of(settings.generator),
                                 settings.generator)

    def test_options_of_synovia(self) -> None:
        schema = self.start("run", "--dry-schema")
        self.assertEqual(schema.returncode, 0, schema.stderr)
        self.assertIn("mesh.generator", schema.stdout)
        self.assert_error(self.run_case("--chekc", status=1),
                          "did you mean --check?")

    def test_what_is_wrong(self) -> None:
        for arguments, text in (
                (["nonsense"], "no case file 'nonsense'"),
                (["mine/none.toml"], "no case file 'mine/none.toml'"),
                (["two_columns", "--np", "0"], "--np 0"),
                (["two_columns", "--np"], "--np needs a value"),
                (["two_columns", "--set"], "--set needs a value")):
            with self.subTest(arguments=arguments):
                self.assert_error(self.start("run", *arguments), text)
        self.case.write_text("[mesh\n")
        self.assert_error(self.start("run", "mine/case.toml"),
                          "mine/case.toml:1:", "this is not TOML")


class Python(Scripts):
    def test_runs_scripts(self) -> None:
        self.assert_error(self.start("run_python"), "no script is given")
        done = self.start("run_python", "-c", "import gmsh, sys; sys.exit(5)")
        self.assertEqual(done.returncode, 5, done.stderr)

    def test_other_pythons_name_it(self) -> None:
        for script in ("meshes/boxes.py", "meshes/knee_parametric.py",
                       "scripts/report.py", "scripts/plot_knee_mesh.py"):
            path = os.path.relpath(SOURCE / script, self.folder)
            # Without its site's packages.
            done = subprocess.run(
                [sys.executable, "-S", path, "two columns"], cwd=self.folder,
                capture_output=True, text=True,
                env=os.environ | {"PYTHONPATH": ""})
            runner = os.path.relpath(SOURCE / "scripts/run_python", self.folder)
            with self.subTest(script=script):
                self.assert_error(done, os.path.basename(script) + ": error: ",
                                  "No module named", "requirements.txt",
                                  f"{runner} {path} 'two columns'")


class Test(Scripts):
    """Before anything is set up."""

    def test_wrong_options(self) -> None:
        for arguments, text in (
                (["--compiler"], "--compiler needs a value"),
                (["--build-type", "Fast"], "there is no build type Fast"),
                (["--tidy", "--sanitize"], "--tidy runs nothing")):
            with self.subTest(arguments):
                self.assert_error(self.start("test", *arguments), text)


if __name__ == "__main__":
    unittest.main()
