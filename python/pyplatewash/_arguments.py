"""Arguments of functions that are written in Python, checked: what is wrong with one is told by its name."""

from __future__ import annotations

import operator
import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from ._errors import InputError, InputTypeError


def found(value: object) -> str:
    """A value in an error message."""
    if isinstance(value, (bool, int, float, str)):
        return f"found {value!r:.60} ({type(value).__name__})"
    return f"found a value of type {type(value).__name__}"


def path(name: str, value: object) -> Path:
    """A path. Raises InputTypeError, InputError for a text that can be none."""
    if isinstance(value, bytes) or not isinstance(value, (str, os.PathLike)):
        raise InputTypeError(f"{name}: a path is needed; {found(value)}", argument=name)
    given = Path(value)
    text = str(given)
    if "\0" in text or not text.isprintable() and any("\ud800" <= c <= "\udfff" for c in text):
        raise InputError(f"{name}: a path is needed; found a text that can be none", argument=name)
    return given


def flag(name: str, value: object) -> bool:
    """True or False. Raises InputTypeError."""
    if not isinstance(value, bool):
        raise InputTypeError(f"{name}: True or False is needed; {found(value)}", argument=name)
    return value


def whole(name: str, value: object, least: int, most: int) -> int:
    """A whole number from ``least`` to ``most``. Raises InputTypeError, InputError for one beyond them."""
    wanted = f"{name}: an integer from {least} to {most} is needed"
    if isinstance(value, bool):
        raise InputTypeError(f"{wanted}; {found(value)}", argument=name)
    try:
        number = operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        raise InputTypeError(f"{wanted}; {found(value)}", argument=name) from None
    if not least <= number <= most:
        raise InputError(f"{wanted}; {found(number)[:120]}", argument=name)
    return number


def word(name: str, value: object, words: Iterable[str]) -> str:
    """One of some words. Raises InputTypeError, InputError for another one."""
    listed = list(words)
    wanted = f"{name}: one of {', '.join(listed)} is needed"
    if not isinstance(value, str):
        raise InputTypeError(f"{wanted}; {found(value)}", argument=name)
    if value not in listed:
        raise InputError(f"{wanted}; found {value!r:.60}", argument=name)
    return value


def texts(name: str, value: Any) -> list[str]:
    """Texts, or one. Raises InputTypeError."""
    if isinstance(value, str):
        return [value]
    if isinstance(value, (list, tuple)):
        for place, one in enumerate(value):
            if not isinstance(one, str):
                raise InputTypeError(f"{name}[{place}]: a text is needed; {found(one)}", argument=name)
        return list(value)
    raise InputTypeError(f"{name}: a list of texts is needed; {found(value)}", argument=name)
