"""What the values of an axis have in common, as a manifest states it."""

from __future__ import annotations

from typing import Any, TypeAlias

#: ``flag``, ``whole``, ``number``, ``text``, ``json`` (anything else, or values of several kinds), or ``{"numbers": N}``, lists of so many.
Kind: TypeAlias = str | dict[str, int]

#: Most numbers of a list, which has a column for each.
MOST_NUMBERS = 10_000


def is_kind(stated: Any) -> bool:
    """Whether this is a kind."""
    if isinstance(stated, dict):
        numbers = stated.get("numbers")
        return len(stated) == 1 and type(numbers) is int and 0 < numbers <= MOST_NUMBERS
    return stated in ("flag", "whole", "number", "text", "json")


def fits(kind: Kind, value: Any) -> bool:
    """Whether a value is of the kind."""
    if isinstance(kind, dict):
        return isinstance(value, list) and len(value) == kind["numbers"] and all(type(part) in (int, float) for part in value)
    if kind == "flag":
        return isinstance(value, bool)
    if kind == "whole":
        return type(value) is int and -(2**63) <= value < 2**63
    if kind == "number":
        return type(value) in (int, float)
    return isinstance(value, str) or kind == "json"
