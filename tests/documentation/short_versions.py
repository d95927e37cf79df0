"""How the documentation's commands are made short for a test.

Rule: a program gets options behind its own, which make its mesh as coarse as
the program's tests have it, a case's displacement linear, and its run a few long
steps to the same end, in finite deformation with a tenth of the load. The
command at the head of a case stops after the check: other tests run all cases.
What can't run in a test is listed with its reason, and what stands in for it.
"""

from __future__ import annotations

import json
import pathlib
import re
import shlex
import tomllib

from commands import Block, DocumentationError, simple_commands

CASE_FILES = "miniapps/cases/"
CASES = pathlib.Path(__file__).resolve().parents[2] / CASE_FILES
STEPS = 2       # of a case's run
COARSE = {
    "boxes.py": "3", "glenohumeral.py": "2.5", "hertz.py": "1.5",
    "indentation.py": "3", "indentation_wedge.py": "4",
    "knee_from_segmentation.py": "3",
    "knee_parametric.py": "5", "meniscus_ring.py": "1.8"}
KNEE = ["knee_parametric.py", "--size", COARSE["knee_parametric.py"]]
# In finite deformation a tenth of the load: a few long steps are then enough.
LIGHT = {
    "indentation_finite.toml": [
        'boundary.indenter_top.displacement=["free", "free", '
        '{times = [0, 500], values = [0, -0.0075]}]'],
    "knee_finite.toml": [
        "boundary.femoral_cartilage_bone.displacement=[0, 0, "
        "{times = [0, 60], values = [0, -0.048]}]"],
    "knee_body_weight.toml": [
        "rigid_body.femur.force=[0, 0, {times = [0, 1], values = [0, -7]}]",
        "step.hold.duration=1"],
    "knee_stance.toml": [
        "rigid_body.femur.force=[0, 0, {times = [0, 0.2], values = [0, -4]}]",
        'rigid_body.femur.rotation=[0, "free", "free"]',
        "step.gait.duration=0.02",
        "step.gait.rigid_body.femur.force=[0, 0, -4]",
        'step.gait.rigid_body.femur.rotation=[0, "free", "free"]'],
    "glenohumeral_finite.toml": [
        "boundary.humeral_bone.displacement=[0, 0, "
        "{times = [0, 10], values = [0, -0.02]}]"],
    "glenohumeral_ligaments.toml": [
        "joint.shoulder.flexion={times = [10, 20], values = [0, 0.01]}"],
    "migrating_contact.toml": [
        "rigid_body.sphere.translation=[{times = [0, 402], "
        'values = [0, 0.25]}, 0, "free"]'],
    "resting_contact.toml": [
        "rigid_body.sphere.translation=[{times = [0, 402], "
        'values = [0, 0.025]}, 0, "free"]']}

# Other options that make a program quick; scripts/run without a case is the
# indentation, whose pictures show what it is after 250 s.
SMALL = {
    "indentation": {"--step": "250", "--fields-every": "1"},
    "scripts/run": {"--step": "250", "--fields-every": "1"},
    "knee": {"--step": "50", "--end": "50"},
    "scaling": {"--size": "2", "--steps": "1"},
    "partial_assembly": {"--size": "2"},
    "scripts/benchmark": {"--sweep": "jump"},
    "scripts/benchmark --audit": {"--most-ranks": "4", "--each": "4",
                                  "--whole": "8"},
    "scripts/benchmark --deformations": {"--compression": "0.1",
                                         "--limit": "2"},
    "scripts/benchmark --roofline": {"--size": "4"},
    "scripts/benchmark --tables": {"--table": "scaling", "--coarsen": "6"}}
# Of MFEM's parser, which takes an option only once.
LONG_NAMES = {"-s": "--steps", "-n": "--size", "-dt": "--step"}
AS_THEY_ARE = {
    "cd", "cmake", "columns", "cp", "own_law", "scripts/report", "scripts/setup",
    "plot_glenohumeral.py", "plot_knee.py", "plot_knee_mesh.py"}
# Commands that don't run here, to the letter, and why.
NOT_RUN = {
    "cmake -S . -B build -DMFEM_DIR=/path/to/mfem":
        "the path stands for one of the reader",
    "cmake --build build": "all is built when tests run",
    "ctest --test-dir build": "would run this test",
    "cmake --install build --prefix /where/you/like":
        "the path stands for one of the reader",
    "pip install ./scripts/python":
        "would change the tests' Python; test_python_install does it elsewhere",
    "scripts/test --sanitize": "builds all of it a second time",
    "scripts/test --compiler clang++-14 --build-type Debug":
        "builds all of it a second time",
    "scripts/test --tidy": "builds and checks all of it by another compiler",
    "sbatch scripts/benchmark.slurm": "needs a cluster",
    "sbatch scripts/run.slurm CASE.toml --output out/case": "needs a cluster",
    "scripts/packaging/make_deb out/packages":
        "builds all of it a second time; test_packaging makes a package",
    "scripts/packaging/install_deb out/packages/synovia_*.deb":
        "would change this machine",
    "scripts/packaging/first_run indentation": "needs the package installed",
    "docker build -f scripts/packaging/Dockerfile -t synovia .":
        "needs a container's tools",
    "spack repo add scripts/packaging/spack_repo/synovia": "needs Spack",
    "spack dev-build synovia@0.1.0": "needs Spack",
    "scripts/compare_histories ../before/build/miniapps/synovia "
    "build/miniapps/synovia": "needs a second build",
    "scripts/run_python scripts/plot_accuracy.py out/accuracy":
        "measures for an hour",
}
# Programs in whose place another runs, and why.
INSTEAD = {
    "scripts/get_knee_image": "downloads 93 MB; a made-up image is taken",
    "scripts/test": "runs this test; ctest lists what it would run",
}


def name_of(word: str) -> str:
    """What a program is called in the tables."""
    path = pathlib.PurePath(word)
    return str(path) if path.parts[0] == "scripts" and not path.suffix \
        else path.name


class ShortCommand:
    """A command, and what is run in its place: nothing if `why` says so."""

    def __init__(self, words: list[str], folder: pathlib.Path,
                 image: pathlib.Path, place: str, only_check: bool = False):
        self.text = " ".join(words)
        self.why = NOT_RUN.get(self.text, "")
        self.program = ""
        self.short: str | None = None
        if self.why:
            return
        assignment = re.fullmatch(r"(\w+)=\$\((scripts/get_knee_image)\)",
                                  self.text)
        if assignment:
            self.program = assignment[2]
            self.short = f"{assignment[1]}={shlex.quote(str(image))}"
            return
        start = launchers(words)
        self.program = name_of(words[start])
        arguments = [shlex.split(word)[0] for word in words[start + 1:]]
        if self.program == "scripts/test":
            self.short = shlex.join(
                ["ctest", "--test-dir", "build", "-N", *arguments])
            return
        options = options_for(self.program, arguments, folder)
        if options is None:
            raise DocumentationError(
                f"{place}: no short version of '{self.program}' is known; "
                "tests/documentation/short_versions.py lists them")
        if self.program == "scripts/run" and "--np" not in arguments:
            # Two of these run side by side, on as many cores.
            options = [*options, ("--np", "1")]
        self.short = " ".join(with_options(words, options)
                              + ["--check"] * only_check)


def launchers(words: list[str]) -> int:
    """How many words come before the program."""
    count = 0
    while re.match(r"\w+=", words[count]):
        count += 1
    if words[count] == "mpirun":
        count += 3
    return count + words[count].endswith("scripts/run_python")


def with_options(words: list[str], options: list[tuple[str, str]]
                 ) -> list[str]:
    """Options that are there get another value, but for --set."""
    words = list(words)
    names = [LONG_NAMES.get(word, word) for word in words]
    for option, value in options:
        if option in names and option != "--set":
            words[names.index(option) + 1] = shlex.quote(value)
        else:
            words += [option, shlex.quote(value)]
    return words


def options_for(program: str, arguments: list[str], folder: pathlib.Path
                ) -> list[tuple[str, str]] | None:
    if program in AS_THEY_ARE or {"--list", "--dry-schema", "--version",
                                  "--help"} & set(arguments):
        return []
    case = case_of(program, arguments)
    if case:
        return case_options(folder / case, arguments, program == "scripts/run")
    if program in SMALL:
        which = " ".join([program, *(
            word for word in arguments
            if word in ("--audit", "--deformations", "--roofline",
                        "--tables"))])
        return list(SMALL[which].items())
    if program in COARSE:
        return [("--size", COARSE[program])]
    return None


def case_of(program: str, arguments: list[str]) -> str | None:
    """The case file that a command runs."""
    if program not in ("synovia", "scripts/run") or not arguments:
        return None
    files = [word for word in arguments if word.endswith(".toml")]
    if files:
        return files[0]
    if program == "scripts/run" and not arguments[0].startswith("-"):
        return f"miniapps/cases/{arguments[0]}.toml"
    return None


def case_options(file: pathlib.Path, arguments: list[str],
                 makes_mesh: bool) -> list[tuple[str, str]]:
    if not file.exists():   # a copy that isn't made yet
        file = CASES / file.name
    case = tomllib.loads(file.read_text(encoding="utf-8"))
    settings = dict(word.split("=", 1) for option, word
                    in zip(arguments, arguments[1:]) if option == "--set")
    steps = sum(step["duration"] for step in case.get("step", ()))
    end = float(settings.get("time.end", case["time"].get("end", steps)))
    options = [f"time.step={end / STEPS:g}", "output.fields_every=1"]
    if "space.order" not in settings:
        options.append("space.order=1")
    options += LIGHT.get(file.name, [])
    if makes_mesh:
        script, *own = case["mesh"]["generator"]
        # The image of a real knee has to be downloaded.
        generator = (KNEE if script == "knee_from_segmentation.py" else
                     with_options([script, *own],
                                  [("--size", COARSE[script])]))
        options.append(f"mesh.generator={json.dumps(generator)}")
    return [("--set", option) for option in options]


def shorten(block: Block, root: pathlib.Path, image: pathlib.Path
            ) -> list[ShortCommand]:
    commands = []
    folder = root
    for words in simple_commands(block):
        commands.append(ShortCommand(words, folder, image, block.place,
                                     block.file.startswith(CASE_FILES)))
        if words[0] == "cd":
            folder = folder / words[1]
    return commands
