"""The keys of case files, as the program itself lists them (--dry-schema).

A key is a path such as material.N.solid.E, in which N counts the entries of a
list of tables. The tree of tables tells what may stand where.
"""

from __future__ import annotations

import dataclasses
import functools
import re

from synovia import program
from synovia.errors import KeyNameError, SynoviaError, suggestion

COLUMNS = ("key", "type", "default", "unit", "meaning")


@dataclasses.dataclass
class Key:
    """A key and what may stand there."""

    path: str                   # such as material.N.solid.E
    type: str                   # in words
    default: str                # as written in a file; "required" or "-"
    unit: str                   # "-" for none
    meaning: str
    choices: dict[str, str] = dataclasses.field(default_factory=dict)

    @property
    def name(self) -> str:
        return self.path.rpartition(".")[2]

    def describe(self) -> str:
        """A paragraph for a docstring."""
        lines = [f"{self.name}: {self.type}"]
        if self.unit != "-":
            lines[0] += f" ({self.unit})"
        if self.default != "-":
            lines[0] += (", required" if self.default == "required"
                         else f", default {self.default}")
        lines.append(f"    {self.meaning}")
        lines += [f'    "{choice}": {meaning}'
                  for choice, meaning in self.choices.items()]
        return "\n".join(lines)


@dataclasses.dataclass
class TableSchema:
    """What a table of a case may hold."""

    path: str
    keys: dict[str, list[Key]] = dataclasses.field(default_factory=dict)
    tables: dict[str, TableSchema] = dataclasses.field(default_factory=dict)
    lists: dict[str, TableSchema] = dataclasses.field(default_factory=dict)

    def names(self) -> list[str]:
        return [*self.keys, *self.tables, *self.lists]

    def require(self, name: str) -> None:
        """Raises KeyNameError for a name that can't stand here."""
        if name not in self.keys and name not in self.tables \
                and name not in self.lists:
            where = f"{self.path}.{name}" if self.path else name
            raise KeyNameError(f"there is no key '{where}'"
                               + suggestion(name, self.names()))

    def describe(self) -> str:
        """All that may stand here, for a docstring."""
        parts = [key.describe() for keys in self.keys.values()
                 for key in keys]
        parts += [f"{name}: table of {', '.join(table.names())}"
                  for name, table in self.tables.items()]
        parts += [f"{name}: list of tables of {', '.join(table.names())}"
                  for name, table in self.lists.items()]
        return "\n".join(parts)


def parse(text: str) -> TableSchema:
    """The tree of what --dry-schema prints."""
    lines = text.splitlines()
    if not lines or tuple(lines[0].split()) != COLUMNS:
        raise SynoviaError("the program's --dry-schema does not begin with "
                           + ", ".join(COLUMNS))
    starts = [lines[0].index(column) for column in COLUMNS]
    ends = [*starts[1:], None]
    root = TableSchema("")
    previous: Key | None = None
    for line in lines[1:]:
        if not line.strip():
            break
        path, kind, default, unit, meaning = (
            line[start:end].strip() for start, end in zip(starts, ends))
        key = Key(path, kind, default, unit, meaning)
        # A law of a key's list comes as a row whose type is its name.
        if previous and previous.path == key.path \
                and previous.type == "word" \
                and re.fullmatch(r'"[^"]*"', key.type):
            previous.choices[key.type.strip('"')] = key.meaning
            continue
        _insert(root, key)
        previous = key
    _share_solids(root)
    return root


def _insert(root: TableSchema, key: Key) -> None:
    table = root
    parts = key.path.split(".")
    i = 0
    while i < len(parts) - 1:
        name = parts[i]
        in_list = parts[i + 1] == "N"
        group = table.lists if in_list else table.tables
        i += 2 if in_list else 1
        table = group.setdefault(name, TableSchema(".".join(parts[:i])))
    table.keys.setdefault(parts[-1], []).append(key)


def _share_solids(table: TableSchema) -> None:
    """A list of tables "with the keys of solids" holds what its table does."""
    for name, keys in list(table.keys.items()):
        if keys[0].type == "list of tables":
            del table.keys[name]
            table.lists[name] = table
    for inner in [*table.tables.values(), *table.lists.values()]:
        if inner is not table:
            _share_solids(inner)


@functools.lru_cache(maxsize=4)
def _parsed(text: str) -> TableSchema:
    return parse(text)


def schema() -> TableSchema:
    """The program's own."""
    return _parsed(program.schema_text())
