"""Whether a value is of the type that the schema has for its key."""

from __future__ import annotations

import numbers
import re
from collections.abc import Callable, Mapping
from typing import Any

from synovia.errors import CaseError, suggestion
from synovia.schema import Key


def plain(value: Any) -> Any:
    """NumPy's numbers and arrays, and tuples, as Python's own."""
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if isinstance(value, Mapping):
        return {str(name): plain(item) for name, item in value.items()}
    return value


def is_number(value: Any) -> bool:
    return isinstance(value, numbers.Real) and not isinstance(value, bool)


def is_integer(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


def is_string(value: Any) -> bool:
    return isinstance(value, str)


def is_name(value: Any) -> bool:
    return is_string(value) or is_integer(value)


def is_curve(value: Any) -> bool:
    return is_number(value) or (
        isinstance(value, Mapping)
        and all(is_list(value.get(name), is_number)
                for name in ("times", "values")))


def is_list(value: Any, of: Callable[[Any], bool],
            length: int | None = None) -> bool:
    return isinstance(value, list) and all(map(of, value)) \
        and length in (None, len(value))


CHECKS: dict[str, Callable[[Any], bool]] = {
    "number": is_number,
    "integer": is_integer,
    "string": is_string,
    "boolean": lambda value: isinstance(value, bool),
    "curve": is_curve,
    'number or "auto"': lambda value: value == "auto" or is_number(value),
    "name or list of names":
        lambda value: is_name(value) or is_list(value, is_name),
    "list of numbers": lambda value: is_list(value, is_number),
    "list of integers": lambda value: is_list(value, is_integer),
    "list of strings": lambda value: is_list(value, is_string),
    "list of 3 numbers": lambda value: is_list(value, is_number, 3),
    "list of 3 curves": lambda value: is_list(value, is_curve, 3),
    'list of 3: curve or "free"':
        lambda value: is_list(
            value, lambda item: item == "free" or is_curve(item), 3)}


def choices_of(key: Key) -> list[str]:
    """The words that may stand there; none where others may, too."""
    if key.choices:
        return list(key.choices)
    words = re.findall(r'"([^"]*)"', key.type)
    return words if re.fullmatch(r'("[^"]*"(, | or )?)+', key.type) else []


def require_valid(keys: list[Key], value: Any, where: str) -> None:
    """Raises CaseError for a value of the wrong type.

    keys: those of one name, such as of several laws. Ranges are the program's
    to check, and so are types that this does not know.
    """
    for key in keys:
        choices = choices_of(key)
        if choices:
            if value in choices:
                return
        elif key.type not in CHECKS or CHECKS[key.type](value):
            return
    choices = choices_of(keys[0])
    if choices and is_string(value):
        raise CaseError(f"{where} = \"{value}\"" + suggestion(value, choices))
    types = " or ".join(dict.fromkeys(key.type for key in keys))
    raise CaseError(f"{where} = {value!r} is not of the type: {types}")
