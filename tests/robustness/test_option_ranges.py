#!/usr/bin/env python3
# processors: 1
"""Options of the miniapps out of range: what they say, before any work.

Each names the option, what it was given and what it may be, and exits with 1;
problems that are too large say how many unknowns they have and what memory they
need. On two ranks the message comes once.
"""

from __future__ import annotations

import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
sys.dont_write_bytecode = True

from program_checks import (  # noqa: E402
    MPIEXEC, PROGRAMS, SOURCE, WITHOUT_WAITING, check, finish)

WRONG = {
    "scaling": (
        ("--step", "-1", "--step is -1; it must be positive"),
        ("--step", "0", "--step is 0; it must be positive"),
        ("--size", "0", "--size is 0; it must be at least 1"),
        ("--upper-size", "-1", "--upper-size is -1; it must be at least 0"),
        ("--refine", "-1", "--refine is -1; it must be from 0 to 20"),
        ("--order", "0", "--order is 0; it must be from 1 to 8"),
        ("--order", "30", "--order is 30; it must be from 1 to 8"),
        ("--steps", "0", "--steps is 0; it must be at least 1"),
        ("--permeability", "0", "--permeability is 0; it must be positive"),
        ("--poisson", "0.5", "--poisson is 0.5; it must be between -1 and 0.5"),
        ("--jump", "-2", "--jump is -2; it must be positive"),
        ("--compression", "-0.1",
         "--compression is -0.1; it must be from 0 to 0.9"),
        ("--compression", "0.95",
         "--compression is 0.95; it must be from 0 to 0.9"),
        ("--penalty-factor", "0", "--penalty-factor is 0; it must be positive"),
        ("--tolerance", "0", "--tolerance is 0; it must be between 0 and 0.1"),
        ("--active-set-tolerance", "1",
         "--active-set-tolerance is 1; it must be from 0 to 0.1"),
        ("--elements", "pyramid", "--elements is hex or tet"),
        ("--deformation", "large", "--deformation is infinitesimal or finite"),
        ("--law", "mow", "--law is neo_hookean or holmes_mow"),
        ("--solver", "magic", "auto, block_amg, direct")),
    "partial_assembly": (
        ("--order", "9", "--order is 9; it must be from 1 to 8"),
        ("--size", "-4", "--size is -4; it must be at least 1"),
        ("--products", "0", "--products is 0; it must be at least 1")),
    "indentation": (
        ("--step", "-1", "--step is -1; it must be positive"),
        ("--end", "0", "--end is 0; it must be positive"),
        ("--check", "-1", "--check is -1; it must be at least 0"),
        # The case that is made of them checks the others.
        ("--fields-every", "-1",
         "output.fields_every: found -1; it must be at least 0"),
        ("--active-set-tolerance", "1",
         "solver.active_set_tolerance: found 1; it must be from 0 to 0.1")),
    "knee": (
        ("--end", "-1", "--end is -1; it must be positive"),
        ("--shear", "0", "the shear modulus along the fibers is 0; it must be"),
        ("--order", "9", "the order of the displacement is 9; it must be"),
        ("--fields-every", "-1",
         "output.fields_every: found -1; it must be at least 0"),
        ("--step", "0", "--step is 0; it must be positive"),
        ("--ramp", "-5", "--ramp is -5; it must be positive"),
        ("--horn", "-1", "--horn is -1; it must be at least 0"),
        ("--horn-across", "-1", "--horn-across is -1; it must be at least 0"))}

TOO_LARGE = (
    (("scaling", "--size", "5000"), "elements before they are split can be"),
    (("scaling", "--size", "300"), "the machine has, in GB, "),
    (("scaling", "--size", "4", "--refine", "20"), "unknowns, at least"),
    (("scaling", "--size", "2000000000"), "unknowns, at least"),
    (("partial_assembly", "--size", "3000", "--order", "8"),
     "unknowns, at least"))


def ranges(program: str) -> set[str]:
    """The options whose ranges a program verifies."""
    text = (SOURCE / "miniapps" / f"{program}.cpp").read_text()
    return set(re.findall(r'(?:Verify\w+|Chosen)\(\s*"(--[-\w]+)"', text))


def run(ranks: int, program: str, *options: str
        ) -> subprocess.CompletedProcess:
    return subprocess.run(
        [MPIEXEC, "-n", str(ranks), PROGRAMS / program, *options],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        env=os.environ | WITHOUT_WAITING, timeout=120)


def main() -> None:
    wrong = [((program, option, value), words)
             for program, options in WRONG.items()
             for option, value, words in options]
    jobs = [(ranks, command, words) for command, words in [*wrong, *TOO_LARGE]
            for ranks in (1, 2)]
    # Starting and ending ranks is mostly waiting.
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        results = pool.map(lambda job: run(job[0], *job[1]), jobs)
        for (ranks, command, words), result in zip(jobs, results):
            errors = [line for line in result.stdout.splitlines()
                      if line.startswith(f"{command[0]}: error: ")]
            good = (result.returncode == 1 and len(errors) == 1
                    and words in errors[0])
            if not good:
                print(result.stdout)
            check(good, f"{' '.join(command)} on {ranks} ranks: {words}")
    check(len(jobs) > 60, f"{len(jobs)} runs")
    for program, options in WRONG.items():
        given = {option for option, _, _ in options}
        left_out = ranges(program) - given
        check(not left_out and len(ranges(program)) >= 3,
              f"{program}: ranges that are not tried: {left_out or 'none'}")
    finish()


if __name__ == "__main__":
    main()
