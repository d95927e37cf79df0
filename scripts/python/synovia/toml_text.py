"""Writes the values of cases as TOML."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping
from typing import Any


def key_text(name: str) -> str:
    return name if re.fullmatch(r"[A-Za-z0-9_-]+", name) else string(name)


def string(text: str) -> str:
    # JSON's escapes are TOML's, but for surrogates.
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def value_text(value: Any) -> str:
    """A value on one line."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        if math.isnan(value) or math.isinf(value):
            return str(value)
        return repr(value)
    if isinstance(value, str):
        return string(value)
    if isinstance(value, list):
        return "[" + ", ".join(map(value_text, value)) + "]"
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{key_text(name)} = {value_text(item)}"
                               for name, item in value.items()) + "}"
    raise TypeError(f"{type(value).__name__} is no type of TOML: {value!r}")


def is_table_list(value: Any) -> bool:
    return isinstance(value, list) and bool(value) \
        and all(isinstance(item, Mapping) for item in value)


def document(values: Mapping[str, Any]) -> str:
    """A file: tables and lists of tables of two levels get headings."""
    blocks = [lines(values, lambda value: not isinstance(value, Mapping)
                    and not is_table_list(value))]
    for name, value in values.items():
        key = key_text(name)
        if isinstance(value, Mapping):
            own = lines(value, lambda item: not is_table_list(item))
            blocks.append(f"[{key}]\n{own}" if own else "")
            for inner, items in value.items():
                if is_table_list(items):
                    blocks += [f"[[{key}.{key_text(inner)}]]\n"
                               + lines(item, lambda _: True)
                               for item in items]
        elif is_table_list(value):
            blocks += [f"[[{key}]]\n" + lines(item, lambda _: True)
                       for item in value]
    return "\n".join(block for block in blocks if block)


def lines(values: Mapping[str, Any], which: Any) -> str:
    return "".join(f"{key_text(name)} = {value_text(value)}\n"
                   for name, value in values.items() if which(value))
