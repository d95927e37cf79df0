#!/usr/bin/env python3
# processors: 1
"""Cases of the Python package: read, changed, checked and written."""

from __future__ import annotations

import contextlib
import math
import os
import pathlib
import sys
import tempfile
import tomllib
import unittest
import unittest.mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))

from python_package import CASES, SOURCE, coarse_columns, synovia  # noqa: E402

import numpy as np  # noqa: E402

from synovia.program import ENVIRONMENT, program  # noqa: E402
from synovia.schema import parse, schema  # noqa: E402
from synovia.toml_text import document  # noqa: E402

SHIPPED = sorted(file for file in CASES.glob("*.toml")
                 if not file.name.endswith(".frames.toml"))


class Toml(unittest.TestCase):
    def test_values_come_back(self) -> None:
        tables = [{"number": 1e-5, "large": 1e22, "whole": -2**62, "yes": True},
                  {"text": 'a "b" \\ \x01 \x7f \n \u00e9 \U0001f9b4',
                   "a key": [[1.5, 2], ["x"]], "empty": []}]
        values = {"top": math.inf, "table": {"inner": {"a": [1]},
                                             "list": tables},
                  "tables": tables}
        self.assertEqual(tomllib.loads(document(values)), values)

    def test_what_is_no_value(self) -> None:
        with self.assertRaisesRegex(TypeError, "NoneType is no type of TOML"):
            document({"a": None})


class Schema(unittest.TestCase):
    def test_tree(self) -> None:
        tree = schema()
        time = tree.tables["time"]
        self.assertEqual(time.keys["end"][0].default, "required")
        self.assertEqual(time.keys["end"][0].unit, "time")
        solid = tree.lists["material"].tables["solid"]
        self.assertIn("holmes_mow", solid.keys["model"][0].choices)
        # The same name of several laws.
        self.assertGreater(len(solid.keys["beta"]), 1)
        self.assertIs(solid.lists["solids"], solid)
        self.assertIn("from", tree.tables["output"].lists["line"].keys)

    def test_what_is_no_schema(self) -> None:
        with self.assertRaisesRegex(synovia.SynoviaError, "does not begin"):
            parse("something else\n")


class Cases(unittest.TestCase):
    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory(prefix="synovia case ")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.case = synovia.Case(CASES / "two_columns.toml")

    def test_shipped_cases_come_back(self) -> None:
        self.assertGreater(len(SHIPPED), 10)
        for file in SHIPPED:
            with self.subTest(file.name):
                case = synovia.Case(file)
                copy = self.folder / "copy.toml"
                case.write(copy)
                written = tomllib.loads(copy.read_text(encoding="utf-8"))
                original = tomllib.loads(file.read_text(encoding="utf-8"))
                self.assertEqual(
                    (self.folder / written["mesh"].pop("file")).resolve(),
                    (CASES / original["mesh"].pop("file")).resolve())
                self.assertEqual(written, original)
                self.assertEqual(list(written), list(original))

    def test_attributes_and_paths(self) -> None:
        case = self.case
        self.assertEqual(case.material[0].solid.E, 0.5417)
        self.assertEqual(case.material["upper"].solid.E, 0.5417)
        self.assertEqual(case["contact.columns.source"], ["upper_bottom"])
        case["material.lower.solid.E"] = 0.6
        self.assertEqual(case["material.0.solid.E"], 0.6)
        case.boundary["upper_top"].pressure = 1
        self.assertEqual(case["boundary.3.pressure"], 1)
        case.output.line[0].from_ = np.array([0.1, 0.1, 0.0])
        self.assertEqual(case["output.line.lower.from"], [0.1, 0.1, 0.0])
        case.time = {"end": np.float64(2.0), "step": 1}
        self.assertIs(type(case.time.end), float)
        self.assertNotIn("scheme", case.time)
        del case["contact.columns"]
        self.assertEqual(len(case.contact), 0)

    def test_defaults_are_the_programs(self) -> None:
        empty = synovia.Case()
        self.assertEqual(empty.space.order, 2)
        self.assertEqual(empty.time.scheme, "backward_euler")
        self.assertIsNone(empty.time.end)
        self.assertEqual(str(empty), "")

    def test_a_copy_is_another_one(self) -> None:
        copy = self.case.copy({"material.0.solid.nu": 0.2})
        self.assertEqual(self.case.material[0].solid.nu, 0.0833)
        self.assertEqual(copy.material[0].solid.nu, 0.2)
        self.assertEqual(copy.mesh_file, self.case.mesh_file)
        self.assertNotEqual(copy, self.case)

    def test_completion_and_docstrings(self) -> None:
        self.assertTrue({"material", "time", "run"} <= set(dir(self.case)))
        self.assertIn("from_", dir(self.case.output.line[0]))
        self.assertIn("step", self.case.time._ipython_key_completions_())
        self.assertIn("number (time), required",
                      type(self.case.time).end.__doc__)
        self.assertIn("Poisson's ratio",
                      type(self.case.material[0].solid).__doc__)

    def test_what_is_refused(self) -> None:
        case = self.case
        for change, text in (
                ({"time.stp": 1}, "no key 'time.stp'; did you mean 'step'?"),
                ({"tme.step": 1}, "no key 'tme'; did you mean 'time'?"),
                ({"material.lowr.solid.E": 1},
                 "no entry 'lowr'; did you mean 'lower'?"),
                ({"material.7.solid.E": 1}, "no entry '7'"),
                ({"time.step": "long"},
                 "time.step = 'long' is not of the type: number"),
                ({"time.step": True}, "time.step = True is not"),
                ({"space.order": 2.0}, "space.order = 2.0 is not"),
                ({"time.scheme": "sdirk32"}, "did you mean 'sdirk3"),
                ({"material.0.solid.model": "isotropc"},
                 "material.N.solid.model = \"isotropc\"; did you mean "
                 "'isotropic'?"),
                ({"boundary.0.displacement": [0, 0]}, "is not of the type"),
                ({"boundary.0.displacement": [0, 0, "fre"]},
                 "is not of the type"),
                ({"time": 3}, "time = 3 is not a table; it has end"),
                ({"material": {"regions": "a"}}, "material is a list of"),
                ({"time.end.later": 1}, "time.end is no table")):
            with self.subTest(change), \
                    self.assertRaises(synovia.CaseError) as error:
                case.copy(change)
            self.assertIn(text, str(error.exception))
        with self.assertRaisesRegex(AttributeError, "did you mean 'step'"):
            case.time.stepp
        with self.assertRaisesRegex(synovia.CaseError, "No such file"):
            synovia.Case(self.folder / "none.toml")
        with self.assertRaisesRegex(synovia.CaseError, "this is not TOML"):
            synovia.Case.parse("[mesh")

    def test_check(self) -> None:
        case = coarse_columns(self.folder)
        checked = case.check()
        self.assertIn("lower", checked.text)
        self.assertEqual(checked.warnings, [])
        warned = case.copy({"material.0.solid.nu": 0.4999}).check()
        self.assertIn("nearly incompressible", "".join(warned.warnings))
        with self.assertRaisesRegex(
                synovia.CaseError, "material.0.solid.nu: Poisson's ratio is "
                "0.7; it must be between -1 and 0.5"):
            case.copy({"material.0.solid.nu": 0.7}).check()
        del case.time.end
        with self.assertRaisesRegex(synovia.CaseError, "time.end"):
            case.check()

    def test_meshes(self) -> None:
        self.case.mesh.generator = ["boxs.py"]
        with self.assertRaisesRegex(synovia.CaseError, "there is no '.*boxs"):
            self.case.make_mesh()
        del self.case.mesh.generator
        with self.assertRaisesRegex(synovia.CaseError, "names no mesh script"):
            self.case.make_mesh()


class Program(unittest.TestCase):
    def test_environment_is_that_of_the_scripts(self) -> None:
        lines = (SOURCE / "scripts/lib/run.env").read_text().splitlines()
        self.assertEqual(ENVIRONMENT, dict(
            line.split("=", 1) for line in lines if not line.startswith("#")))

    def test_missing(self) -> None:
        with self.assertRaisesRegex(synovia.SynoviaError, "is no program"):
            synovia.use_program("/nowhere/synovia")

    def test_where_it_is_looked_for(self) -> None:
        with tempfile.TemporaryDirectory() as name:
            build = pathlib.Path(name).resolve() / "build" / "miniapps"
            below = build.parents[1] / "a" / "b"
            build.mkdir(parents=True)
            below.mkdir(parents=True)
            (build / "synovia").touch(0o755)
            for settings, found in (
                    ({"SYNOVIA_PROGRAM": "/bin/true"}, "/bin/true"),
                    ({"SYNOVIA_BUILD_DIR": str(build.parent)},
                     str(build / "synovia")),
                    ({"PATH": str(build)}, str(build / "synovia")),
                    ({}, str(build / "synovia"))):
                with self.subTest(settings), contextlib.chdir(below), \
                        unittest.mock.patch.dict(
                            os.environ, {"PATH": "/bin", **settings},
                            clear=True):
                    self.assertEqual(str(program()), found)
            with unittest.mock.patch.dict(
                    os.environ, {"SYNOVIA_PROGRAM": "/none"}), \
                    self.assertRaisesRegex(synovia.SynoviaError,
                                           "'/none' is no program"):
                program()


if __name__ == "__main__":
    unittest.main()
