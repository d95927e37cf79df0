"""The tables of a case as objects, with the schema's keys as attributes."""

from __future__ import annotations

import inspect
import keyword
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from synovia.errors import CaseError, KeyNameError, suggestion
from synovia.schema import Key, TableSchema
from synovia.toml_text import value_text
from synovia.values import plain, require_valid

NAMES_OF_ENTRIES = ("name", "regions", "surfaces")


class Section:
    """A table of a case.

    Its keys are attributes, or go by path: section["solid.E"]. A key that is
    not set gives the program's default, or None where there is none.
    """

    _schema: TableSchema    # of the class, which class_of() makes
    _values: dict[str, Any]

    def __init__(self, values: Mapping[str, Any] | None = None,
                 **more: Any):
        object.__setattr__(self, "_values", {})
        for name, value in {**(values or {}), **more}.items():
            self._set(_name_of(name), value)

    # Attributes of this object and of a table are one and the same.
    def __setattr__(self, name: str, value: Any) -> None:
        self._set(_name_of(name), value)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return self._get(_name_of(name))

    def __delattr__(self, name: str) -> None:
        del self[_name_of(name)]

    def __getitem__(self, path: str) -> Any:
        name, _, rest = path.partition(".")
        value = self._get(name)
        return value[rest] if rest else value

    def __setitem__(self, path: str, value: Any) -> None:
        name, _, rest = path.partition(".")
        if rest:
            self._require_table(name)
            self._get(name)[rest] = value
        else:
            self._set(name, value)

    def __delitem__(self, path: str) -> None:
        name, _, rest = path.partition(".")
        self._schema.require(name)
        if rest:
            del self._get(name)[rest]
        else:
            self._values.pop(name, None)

    def __contains__(self, name: object) -> bool:
        """Whether the case says it itself."""
        return name in self._values and not _is_empty(self._values[name])

    def __iter__(self) -> Iterator[str]:
        return (name for name in self._values if name in self)

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, (Section, Mapping)) \
            and as_values(self) == as_values(other)

    def __dir__(self) -> list[str]:
        own = [name for name in object.__dir__(self)
               if not name.startswith("_") or name.startswith("__")]
        return sorted({*own, *map(_attribute, self._schema.names())})

    def _ipython_key_completions_(self) -> list[str]:
        return self._schema.names()

    def __repr__(self) -> str:
        return value_text(as_values(self))

    def _set(self, name: str, value: Any) -> None:
        self._schema.require(name)
        where = self._where(name)
        if name in self._schema.tables:
            if not isinstance(value, (Section, Mapping)):
                raise CaseError(f"{where} = {value!r} is not a table; it has "
                                + ", ".join(self._schema.tables[name].names()))
            self._values[name] = class_of(self._schema.tables[name])(
                as_values(value))
        elif name in self._schema.lists:
            self._values[name] = SectionList(self._schema.lists[name], value)
        else:
            value = plain(value)
            require_valid(self._schema.keys[name], value, where)
            self._values[name] = value

    def _get(self, name: str) -> Any:
        self._schema.require(name)
        if name in self._values:
            return self._values[name]
        if name in self._schema.tables:
            return self._values.setdefault(
                name, class_of(self._schema.tables[name])())
        if name in self._schema.lists:
            return self._values.setdefault(
                name, SectionList(self._schema.lists[name]))
        return default_of(self._schema.keys[name])

    def _require_table(self, name: str) -> None:
        self._schema.require(name)
        if name in self._schema.keys:
            raise CaseError(f"{self._where(name)} is no table")

    def _where(self, name: str) -> str:
        return f"{self._schema.path}.{name}" if self._schema.path else name


class SectionList:
    """A list of tables; entries go by number from 0, or by name."""

    def __init__(self, schema: TableSchema,
                 entries: Iterable[Section | Mapping[str, Any]] = ()):
        self._schema = schema
        self._entries: list[Section] = []
        if isinstance(entries, (str, Mapping, Section)) \
                or not isinstance(entries, Iterable):
            raise CaseError(f"{schema.path.removesuffix('.N')} is a list of "
                            f"tables, not {entries!r}")
        for entry in entries:
            self.append(entry)

    def append(self, entry: Section | Mapping[str, Any] | None = None,
               **keys: Any) -> Section:
        """Adds a table of these keys, and gives it."""
        values = {**(as_values(entry) if entry is not None else {}), **keys}
        section = class_of(self._schema)(values)
        self._entries.append(section)
        return section

    def __getitem__(self, which: int | str) -> Any:
        if isinstance(which, str):
            name, _, rest = which.partition(".")
            section = self._entries[self._number(name)]
            return section[rest] if rest else section
        return self._entries[which]

    def __setitem__(self, which: int | str, value: Any) -> None:
        if isinstance(which, str):
            name, _, rest = which.partition(".")
            if rest:
                self._entries[self._number(name)][rest] = value
                return
            which = self._number(name)
        self._entries[which] = class_of(self._schema)(as_values(value))

    def __delitem__(self, which: int | str) -> None:
        if isinstance(which, str):
            name, _, rest = which.partition(".")
            if rest:
                del self._entries[self._number(name)][rest]
                return
            which = self._number(name)
        del self._entries[which]

    def __iter__(self) -> Iterator[Section]:
        return iter(self._entries)

    def __len__(self) -> int:
        return len(self._entries)

    def __repr__(self) -> str:
        return "[" + ",\n ".join(map(repr, self._entries)) + "]"

    def _number(self, name: str) -> int:
        if name.isdigit() and int(name) < len(self._entries):
            return int(name)
        found = [i for i, entry in enumerate(self._entries)
                 if name in _names_of(entry)]
        if not found:
            path = self._schema.path.removesuffix(".N")
            known = [*map(str, range(len(self._entries))),
                     *(known for entry in self._entries
                       for known in _names_of(entry))]
            raise KeyNameError(f"{path} has no entry '{name}'"
                               + suggestion(name, known))
        return found[0]


def as_values(section: Section | SectionList | Mapping[str, Any]) -> Any:
    """The dictionaries, lists and values that it consists of."""
    if isinstance(section, SectionList):
        return [as_values(entry) for entry in section]
    if isinstance(section, Section):
        return {name: as_values(section._values[name]) for name in section}
    if isinstance(section, Mapping):
        return {name: as_values(value) for name, value in section.items()}
    return section


def default_of(keys: list[Key]) -> Any:
    """What the program takes where a case says nothing; None for nothing."""
    text = keys[0].default
    if text in ("-", "required"):
        return None
    return tomllib.loads(f"value = {text}")["value"]


_classes: dict[int, type[Section]] = {}


def class_of(schema: TableSchema, base: type[Section] = Section
             ) -> type[Section]:
    """A class whose attributes are the table's keys, with docstrings."""
    # By identity, which lasts: a class keeps its schema.
    known = _classes.get(id(schema))
    if known is not None and issubclass(known, base):
        return known
    members: dict[str, Any] = {
        "_schema": schema, "__module__": __name__,
        "__doc__": inspect.cleandoc(base.__doc__ or "") + "\n\n"
        + schema.describe()}
    for name in schema.names():
        members[_attribute(name)] = _property(name, schema)
    title = "".join(part.capitalize() for part in
                    schema.path.replace(".N", "").split(".")) or base.__name__
    made = type(title, (base,), members)
    _classes[id(schema)] = made
    return made


def _property(name: str, schema: TableSchema) -> property:
    def get(self: Section) -> Any:
        return self._get(name)

    def put(self: Section, value: Any) -> None:
        self._set(name, value)

    inner = schema.tables.get(name) or schema.lists.get(name)
    if inner is None:
        doc = "\n".join(key.describe() for key in schema.keys[name])
    else:
        doc = f"{inner.path}: " + ", ".join(inner.names())
    return property(get, put, doc=doc)


def _attribute(name: str) -> str:
    return name + "_" if keyword.iskeyword(name) else name


def _name_of(attribute: str) -> str:
    bare = attribute.removesuffix("_")
    return bare if keyword.iskeyword(bare) else attribute


def _is_empty(value: Any) -> bool:
    return isinstance(value, (Section, SectionList)) and len(value) == 0


def _names_of(entry: Section) -> list[str]:
    names: list[str] = []
    for key in NAMES_OF_ENTRIES:
        if key in entry:
            value = entry[key]
            names += map(str, value if isinstance(value, list) else [value])
    return names
