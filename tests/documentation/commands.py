"""The commands and programs that the documentation shows.

Shell blocks stand in READMEs, under "Sample runs" in the comments of miniapps
and mesh scripts, and at the head of case files.
"""

from __future__ import annotations

import dataclasses
import pathlib
import re
import shlex

LANGUAGES = {"sh", "cpp", "cmake", "toml", "python"}
FENCE = re.compile(r"^```(\w*)$")
# What a command begins with, at the head of a case file.
COMMAND = re.compile(r"(\w+=\$\()?(scripts/|build/|mpirun |synovia )")


class DocumentationError(Exception):
    """Says where the documentation is not as it has to be."""


@dataclasses.dataclass(frozen=True)
class Block:
    """Lines of a file; the note is the comment before a block of a README."""

    file: str
    line: int
    language: str
    text: str
    note: str = ""

    @property
    def place(self) -> str:
        return f"{self.file}:{self.line}"


def readmes(root: pathlib.Path) -> list[str]:
    """All of them, in the order in which they are read."""
    first = ["README.md"] + [f"{folder}/README.md" for folder in
                             ("miniapps", "meshes", "plugin", "tests",
                              "scripts")]
    found = {str(file.relative_to(root))
             for pattern in ("README.md", "*/README.md", "*/*/README.md")
             for file in root.glob(pattern)}
    return first + sorted(found - set(first))


def readme_blocks(root: pathlib.Path, file: str) -> list[Block]:
    blocks = []
    lines = (root / file).read_text(encoding="utf-8").splitlines()
    opening = None
    for i, line in enumerate(lines):
        fence = FENCE.match(line)
        if fence and opening is None:
            opening = i
            if fence[1] not in LANGUAGES:
                raise DocumentationError(
                    f"{file}:{i + 1}: a block of '{fence[1]}'; there are "
                    + ", ".join(sorted(LANGUAGES)))
        elif fence:
            note = re.match(r"<!-- (.*) -->$", lines[opening - 1])
            blocks.append(Block(file, opening + 2,
                                FENCE.match(lines[opening])[1],
                                "\n".join(lines[opening + 1:i]) + "\n",
                                note[1] if note else ""))
            opening = None
    if opening is not None:
        raise DocumentationError(f"{file}:{opening + 1}: a block has no end")
    return blocks


def sample_runs(root: pathlib.Path, file: str) -> list[Block]:
    """What is indented below "Sample runs:" in a comment or docstring."""
    lines = (root / file).read_text(encoding="utf-8").splitlines()
    indent = "//   " if file.endswith(".cpp") else "  "
    titles = [i for i, line in enumerate(lines)
              if re.match(r"(// )?Sample runs?\b.*:$", line)]
    if len(titles) != 1:
        raise DocumentationError(f"{file} has no sample runs, or several")
    first = last = titles[0] + 1
    while lines[last].startswith(indent):
        last += 1
    # In a docstring a backslash is written twice.
    text = "\n".join(line[len(indent):].replace("\\\\", "\\")
                     for line in lines[first:last])
    return [Block(file, first + 1, "sh", text + "\n")]


def case_commands(root: pathlib.Path, file: str) -> list[Block]:
    """Indented commands in the comments of a case file."""
    commands = {i: line[4:] for i, line in enumerate(
        (root / file).read_text(encoding="utf-8").splitlines(), 1)
        if line.startswith("#   ") and COMMAND.match(line[4:])}
    if not commands:
        raise DocumentationError(f"{file} doesn't say how it is run")
    return [Block(file, min(commands), "sh",
                  "".join(text + "\n" for text in commands.values()))]


def cases(root: pathlib.Path) -> list[pathlib.Path]:
    """Without the frames that a mesh script writes beside its mesh."""
    return [file for file in sorted(root.glob("miniapps/cases/*.toml"))
            if not file.name.endswith(".frames.toml")]


def shell_blocks(root: pathlib.Path) -> list[Block]:
    """All of them; each is a shell of its own, in the root directory."""
    blocks = [block for file in readmes(root)
              for block in readme_blocks(root, file) if block.language == "sh"]
    programs = [file for file in sorted(root.glob("meshes/*.py"))
                if file.read_text(encoding="utf-8").startswith("#!")]
    for path in (*sorted(root.glob("miniapps/*.cpp")), *programs):
        blocks += sample_runs(root, str(path.relative_to(root)))
    for path in cases(root):
        blocks += case_commands(root, str(path.relative_to(root)))
    return blocks


def simple_commands(block: Block) -> list[list[str]]:
    """The words of each command of a block, quoted as they were."""
    commands: list[list[str]] = []
    for line in block.text.replace("\\\n", " ").splitlines():
        words = shlex.shlex(line, posix=False, punctuation_chars="&;|")
        words.whitespace_split = True
        words.commenters = "#"
        commands.append([])
        for word in words:
            if word in ("&&", ";"):
                commands.append([])
            elif set(word) <= set("&;|"):
                raise DocumentationError(
                    f"{block.place}: '{word}' between commands")
            else:
                commands[-1].append(word)
    return [command for command in commands if command]
