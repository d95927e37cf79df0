#!/usr/bin/env python3
# processors: 1
"""Wrong input, full disks and Ctrl-C: what the indentation miniapp says.

Every wrong input must end with a status other than zero, soon, and with one
line on standard error that says what is wrong, where, and what to do: on one
rank and on three. The meshes are written here: two boxes of hexahedra.
"""

from __future__ import annotations

import csv
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.dont_write_bytecode = True

from program_checks import WITHOUT_WAITING  # noqa: E402

PROGRAM = pathlib.Path(os.environ.get("SYNOVIA_BUILD_DIR", "build"),
                       "miniapps", "indentation")
MPIEXEC = os.environ.get("MPIEXEC", "mpiexec")
# Seconds after which a run hangs.
PATIENCE = 60
# What no user should have to read.
NOISE = ("terminate called", "MFEM abort", "Verification failed", "Backtrace",
         "Segmentation fault", "Signal:", "internal error")

SURFACES = ("bone", "symmetry_x", "symmetry_y", "cartilage_top",
            "cartilage_side", "indenter_bottom", "indenter_top",
            "indenter_side")
REGIONS = ("cartilage", "indenter")


class TinyMesh:
    """The quarter model with square bodies, as text of MSH 2.2."""

    LAYER = ([0.0, 0.4, 0.75, 1.6, 3.0], [0.0, 0.4, 0.75, 1.6, 3.0],
             [0.0, 0.45, 0.75])
    INDENTER = ([0.0, 0.4, 0.75], [0.0, 0.4, 0.75], [0.75, 1.5])

    def __init__(self, lift: float = 0.0) -> None:
        self.nodes: list[list[float]] = []
        self.elements: list[tuple[int, str, list[int]]] = []
        self._body("cartilage", self.LAYER, 0.0,
                   {"x0": "symmetry_x", "y0": "symmetry_y", "z0": "bone",
                    "z1": "cartilage_top"})
        self._body("indenter", self.INDENTER, lift,
                   {"x0": "symmetry_x", "y0": "symmetry_y",
                    "z0": "indenter_bottom", "z1": "indenter_top"})

    def _body(self, region: str, lines: tuple, lift: float,
              names: dict[str, str]) -> None:
        first = len(self.nodes)
        n = [len(line) for line in lines]

        def node(i: int, j: int, k: int) -> int:
            return first + i + n[0] * (j + n[1] * k)

        def face(side: str, *corners: tuple[int, int, int]) -> None:
            self.elements.append((3, names.get(side, f"{region}_side"),
                                  [node(*corner) for corner in corners]))

        for z in lines[2]:
            for y in lines[1]:
                for x in lines[0]:
                    self.nodes.append([x, y, z + lift])
        last = [count - 2 for count in n]
        for k in range(n[2] - 1):
            for j in range(n[1] - 1):
                for i in range(n[0] - 1):
                    c = [(i + a, j + b, k + d) for d in (0, 1)
                         for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
                    self.elements.append((5, region, [node(*p) for p in c]))
                    if i == 0:
                        face("x0", c[0], c[4], c[7], c[3])
                    if i == last[0]:
                        face("x1", c[1], c[2], c[6], c[5])
                    if j == 0:
                        face("y0", c[0], c[1], c[5], c[4])
                    if j == last[1]:
                        face("y1", c[3], c[7], c[6], c[2])
                    if k == 0:
                        face("z0", c[0], c[3], c[2], c[1])
                    if k == last[2]:
                        face("z1", c[4], c[5], c[6], c[7])

    def nearest(self, x: float, y: float, z: float) -> int:
        return min(range(len(self.nodes)), key=lambda i: sum(
            (a - b)**2 for a, b in zip(self.nodes[i], (x, y, z))))

    def glue(self, points: list[list[float]]) -> None:
        """Gives the bodies a common node at each of the points."""
        for point in points:
            layer, indenter = (i for i, x in enumerate(self.nodes)
                               if x == point)
            for _, _, nodes in self.elements:
                nodes[:] = [layer if n == indenter else n for n in nodes]

    def text(self, renamed: dict[str, str] | None = None,
             without: str = "") -> str:
        """The file; `without` leaves out a surface with its name."""
        renamed = renamed or {}
        names = [(2, s) for s in SURFACES] + [(3, r) for r in REGIONS]
        tags = {name: i for i, (_, name) in enumerate(names, 1)}
        elements = [e for e in self.elements if e[1] != without]
        names = [(d, name) for d, name in names if name != without]
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat",
                 "$PhysicalNames", str(len(names))]
        lines += [f'{d} {tags[name]} "{renamed.get(name, name)}"'
                  for d, name in names]
        lines += ["$EndPhysicalNames", "$Nodes", str(len(self.nodes))]
        lines += [f"{i} {x!r} {y!r} {z!r}"
                  for i, (x, y, z) in enumerate(self.nodes, 1)]
        lines += ["$EndNodes", "$Elements", str(len(elements))]
        lines += [f"{i} {kind} 2 {tags[name]} {tags[name]} "
                  + " ".join(str(n + 1) for n in nodes)
                  for i, (kind, name, nodes) in enumerate(elements, 1)]
        return "\n".join(lines + ["$EndElements", ""])


def environment() -> dict[str, str]:
    result = dict(os.environ)
    for line in (pathlib.Path(__file__).parents[2] / "scripts" / "lib" /
                 "run.env").read_text().splitlines():
        if line[:1].isupper():
            key, value = line.split("=", 1)
            result.setdefault(key, value)
    return result


class Case(unittest.TestCase):
    ranks = 1

    def setUp(self) -> None:
        folder = tempfile.TemporaryDirectory(prefix="synovia-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, text: str, name: str = "tiny.msh") -> pathlib.Path:
        path = self.folder / name
        path.write_text(text)
        return path

    def command(self, *options: str,
                mesh: pathlib.Path | None = None) -> list[str]:
        """A short run, but for the options."""
        if mesh is None:
            mesh = self.write(TinyMesh().text())
        words = {"--mesh": str(mesh), "--output": str(self.folder / "out"),
                 "--order": "1", "--step": "25", "--end": "50",
                 "--fields-every": "0"}
        # No option may be given twice.
        words = {k: v for k, v in words.items() if k not in options}
        return [MPIEXEC, "-n", str(self.ranks), str(PROGRAM.resolve()),
                *(word for pair in words.items() for word in pair), *options]

    def run_to_end(self, command: list[str]) -> subprocess.CompletedProcess:
        with subprocess.Popen(command, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True,
                              cwd=self.folder,
                              env=environment() | WITHOUT_WAITING,
                              start_new_session=True) as run:
            try:
                out, err = run.communicate(timeout=PATIENCE)
            except subprocess.TimeoutExpired:
                os.killpg(run.pid, signal.SIGKILL)
                out, err = run.communicate()
                self.fail(f"hangs: {command}\n{out}\n{err}")
        return subprocess.CompletedProcess(command, run.returncode, out, err)

    def assert_error(self, run: subprocess.CompletedProcess,
                     *texts: str) -> None:
        said = f"\nstatus {run.returncode}\n{run.stdout}\n{run.stderr}"
        self.assertNotEqual(run.returncode, 0, said)
        lines = [line for line in run.stderr.splitlines()
                 if line.startswith("indentation: error: ")]
        self.assertEqual(len(lines), 1, said)
        for text in texts:
            self.assertIn(text, lines[0], said)
        for noise in NOISE:
            self.assertNotIn(noise, run.stderr + run.stdout, said)

    def assert_rejects(self, *texts: str, options: tuple[str, ...] = (),
                       mesh: pathlib.Path | None = None) -> None:
        self.assert_error(self.run_to_end(self.command(*options, mesh=mesh)),
                          *texts)


class GoodInput(Case):
    """The mesh and the options below are right if nothing is wrong."""

    def test_runs(self) -> None:
        run = self.run_to_end(self.command("--fields-every", "1"))
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        self.assertTrue((self.folder / "out" / "history.csv").exists())


class BadMesh(Case):
    def test_missing(self) -> None:
        self.assert_rejects("nowhere.msh", "no such file",
                            mesh=self.folder / "nowhere.msh")

    def test_directory(self) -> None:
        self.assert_rejects(str(self.folder), "directory", mesh=self.folder)

    def test_empty(self) -> None:
        self.assert_rejects("tiny.msh", mesh=self.write(""))

    def test_not_a_mesh(self) -> None:
        self.assert_rejects("tiny.msh", "$MeshFormat",
                            mesh=self.write("solid cube\nendsolid\n"))

    def test_cut_in_nodes(self) -> None:
        text = TinyMesh().text()
        cut = text.index("$Nodes") + 300
        self.assert_rejects("tiny.msh", "cut off", "line",
                            mesh=self.write(text[:cut]))

    def test_cut_in_elements(self) -> None:
        text = TinyMesh().text()
        cut = text.index("$Elements") + 300
        self.assert_rejects("tiny.msh", "cut off", "line",
                            mesh=self.write(text[:cut]))

    def test_damaged_number(self) -> None:
        text = TinyMesh().text().replace("1.6", "1x6", 1)
        self.assert_rejects("tiny.msh", "line", "1x6", mesh=self.write(text))

    def test_without_bone(self) -> None:
        self.assert_rejects(
            "bone", "cartilage_top", "indenter_bottom",
            mesh=self.write(TinyMesh().text(without="bone")))

    def test_misspelt_surface(self) -> None:
        text = TinyMesh().text(renamed={"bone": "bones"})
        self.assert_rejects('"bone"', 'did you mean "bones"?',
                            mesh=self.write(text))

    def test_misspelt_region(self) -> None:
        text = TinyMesh().text(renamed={"indenter": "indentor"})
        self.assert_rejects('"indenter"', 'did you mean "indentor"?',
                            mesh=self.write(text))

    def test_tangled(self) -> None:
        mesh = TinyMesh()
        mesh.nodes[mesh.nearest(1.6, 1.6, 0.45)][2] = 2.0
        self.assert_rejects("tiny.msh", "tangled", '"cartilage"', "element",
                            mesh=self.write(mesh.text()))

    def test_two_nodes_swapped(self) -> None:
        mesh = TinyMesh()
        a, b = mesh.nearest(0.4, 0.4, 0.45), mesh.nearest(1.6, 0.4, 0.45)
        mesh.nodes[a], mesh.nodes[b] = mesh.nodes[b], mesh.nodes[a]
        self.assert_rejects("tiny.msh", "tangled", '"cartilage"',
                            mesh=self.write(mesh.text()))

    def test_common_nodes(self) -> None:
        mesh = TinyMesh()
        mesh.glue([[0.75, 0.75, 0.75]])
        self.assert_rejects("indenter-cartilage", "share vertices",
                            "without common nodes",
                            mesh=self.write(mesh.text()))

    def test_common_faces(self) -> None:
        mesh = TinyMesh()
        mesh.glue([[x, y, 0.75] for x in mesh.INDENTER[0]
                   for y in mesh.INDENTER[1]])
        self.assert_rejects('"indenter_bottom" is empty',
                            "nodes of their own",
                            mesh=self.write(mesh.text()))

    def test_out_of_reach(self) -> None:
        self.assert_rejects(
            "indenter-cartilage", "search radius of 0.75", "search_radius",
            mesh=self.write(TinyMesh(lift=2.0).text()))


class BadNumbers(Case):
    def test_values(self) -> None:
        for option, value, texts in (
                ("--young", "0", ("Young's modulus is 0",)),
                ("--young", "-1", ("Young's modulus is -1",)),
                ("--poisson", "0.5", ("Poisson's ratio is 0.5", "-1 and 0.5")),
                ("--permeability", "0", ("permeability is 0",)),
                ("--permeability", "-1", ("permeability is -1",)),
                ("--step", "0", ("--step is 0",)),
                ("--step", "-5", ("--step is -5",)),
                ("--end", "0", ("--end is 0",)),
                ("--order", "0", ("order of the displacement is 0",)),
                ("--penalty-factor", "-1", ("penalty_factor is -1",))):
            with self.subTest(option=option, value=value):
                self.assert_rejects(*texts, "must", options=(option, value))

    def test_names(self) -> None:
        self.assert_rejects('"euler"', "backward_euler", "sdirk23", "sdirk33",
                            options=("--scheme", "euler"))
        self.assert_rejects('"petsc"', "auto", "block_amg", "direct",
                            options=("--solver", "petsc"))

    def test_unknown_option(self) -> None:
        for options, text in ((("--speed", "5"), "--speed"),
                              (("--step",), "--step"),
                              (("--step", "fast"), "fast"),
                              (("--step", "nan"), "nan"),
                              (("--young", "inf"), "inf"),
                              (("--end", "5", "--end", "6"), "--end")):
            with self.subTest(options=options):
                self.assert_rejects(text, "--help", options=options)


class BadOutput(Case):
    def test_file_in_the_way(self) -> None:
        path = self.write("", "file")
        self.assert_rejects("file/out", "Not a directory",
                            options=("--output", str(path / "out")))

    def test_output_is_a_file(self) -> None:
        path = self.write("", "file")
        self.assert_rejects("'" + str(path) + "'",
                            options=("--output", str(path)))

    @unittest.skipUnless(os.path.isdir("/proc/self"), "there is no /proc")
    def test_no_files_there(self) -> None:
        self.assert_rejects("/proc/synovia",
                            options=("--output", "/proc/synovia"))


class FullDisk(Case):
    def full_disk(self, size: str, *options: str) -> None:
        """Writes onto a small tmpfs in a name space of its own."""
        disk = self.folder / "disk"
        disk.mkdir(exist_ok=True)
        command = self.command(*options, "--output", str(disk / "out"))
        script = (f'mount -t tmpfs -o size={size} tmpfs "$0" || exit 99\n'
                  'exec "$@"')
        for unshare in (["unshare", "-m"], ["unshare", "-rm"]):
            if not shutil.which("unshare"):
                break
            run = self.run_to_end([*unshare, "sh", "-c", script, str(disk),
                                   *command])
            if run.returncode not in (1, 99) or "unshare" not in run.stderr:
                break
        else:
            self.skipTest("may not mount a small file system")
        if run.returncode == 99:
            self.skipTest("may not mount a small file system")
        self.assert_error(run, "cannot write", str(disk / "out"),
                          "No space left on device")

    def test_fields(self) -> None:
        self.full_disk("32k", "--fields-every", "1")

    def test_history(self) -> None:
        self.full_disk("24k", "--step", "1", "--end", "1500")


class Interrupt(Case):
    def test_history_is_whole(self) -> None:
        history = self.folder / "out" / "history.csv"
        command = self.command("--step", "0.5", "--end", "1500")
        with subprocess.Popen(command, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL, cwd=self.folder,
                              env=environment(),
                              start_new_session=True) as run:
            try:
                give_up = time.monotonic() + PATIENCE
                while (not history.exists() or
                       history.read_text().count("\n") < 5):
                    self.assertIsNone(run.poll(), "ended by itself")
                    self.assertLess(time.monotonic(), give_up)
                    time.sleep(0.05)
                run.send_signal(signal.SIGINT)
                status = run.wait(timeout=10)
            finally:
                if run.poll() is None:
                    os.killpg(run.pid, signal.SIGKILL)
        self.assertNotEqual(status, 0)
        text = history.read_text()
        self.assertTrue(text.endswith("\n"))
        header, *rows = csv.reader(text.splitlines())
        self.assertGreaterEqual(len(rows), 4)
        for i, row in enumerate(rows, 1):
            self.assertEqual(len(row), len(header))
            values = dict(zip(header, map(float, row)))
            self.assertAlmostEqual(values["t"], 0.5 * i)


def on_three_ranks(case: type[Case]) -> type[Case]:
    return type(case.__name__ + "OnThreeRanks", (case,), {"ranks": 3})


GoodInputOnThreeRanks = on_three_ranks(GoodInput)
BadMeshOnThreeRanks = on_three_ranks(BadMesh)
BadNumbersOnThreeRanks = on_three_ranks(BadNumbers)
BadOutputOnThreeRanks = on_three_ranks(BadOutput)
FullDiskOnThreeRanks = on_three_ranks(FullDisk)
InterruptOnThreeRanks = on_three_ranks(Interrupt)

if __name__ == "__main__":
    if not PROGRAM.exists():
        sys.exit(f"{PROGRAM} is not built; set SYNOVIA_BUILD_DIR")
    unittest.main()
