"""Tables of numbers in text files, between comments that name them.

    <!-- table: NAME -->
    ...
    <!-- end of table -->
"""

from __future__ import annotations

import dataclasses
import os
import pathlib
import re

END = "<!-- end of table -->"


@dataclasses.dataclass(frozen=True)
class Table:
    name: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]

    def markdown(self, note: str) -> str:
        """The table, and below it where its numbers come from."""
        lines = ["| " + " | ".join(self.columns) + " |",
                 "|" + "---|" * len(self.columns)]
        for row in self.rows:
            if len(row) != len(self.columns):
                raise ValueError(f"{self.name}: a row of {len(row)} cells")
            lines.append("| " + " | ".join(row) + " |")
        return "\n".join([*lines, "", f"*{note}*"]) + "\n"


def begin(name: str) -> str:
    return f"<!-- table: {name} -->"


def replaced(text: str, name: str, content: str) -> str:
    """The text with another table of that name; ValueError if it has none."""
    pattern = re.compile(re.escape(begin(name)) + "\n.*?" + re.escape(END),
                         re.DOTALL)
    new, count = pattern.subn(
        lambda _: f"{begin(name)}\n{content}{END}", text)
    if count != 1:
        raise ValueError(f"there is no one table '{name}' with its end")
    return new


def write(file: pathlib.Path, tables: dict[str, str]) -> list[str]:
    """Replaces those that the file has, and gives their names."""
    text = file.read_text(encoding="utf-8")
    found = [name for name in tables if begin(name) in text]
    for name in found:
        text = replaced(text, name, tables[name])
    if found:
        part = file.with_name(file.name + ".part")
        part.write_text(text, encoding="utf-8")
        os.replace(part, file)
    return found
