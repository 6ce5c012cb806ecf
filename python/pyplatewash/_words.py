"""Numbers and names in sentences."""

from __future__ import annotations

import math

#: Characters of a name that are told.
LONGEST_NAME = 100


def percent(share: float) -> str:
    """A share as a percentage with one decimal, rounded down, so that it is 100 only where nothing but rounding is missing.

    >>> percent(0.4202), percent(0.99994), percent(1.0)
    ('42.0 %', '99.9 %', '100 %')
    """
    return "100 %" if share >= 1 - 1e-9 else f"{math.floor(1e3 * share + 1e-9) / 10:.1f} %"


def quoted(name: str) -> str:
    r"""A name out of a file in quotes, on one line; of a long one the beginning, and its length.

    >>> print(quoted('a"b\nPROVED'))
    "a\"b\nPROVED"
    """
    begins = name[:LONGEST_NAME].replace("\\", "\\\\").replace('"', '\\"')
    shown = "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in begins)
    rest = f"… ({len(name)} characters)" if len(name) > LONGEST_NAME else ""
    return f'"{shown}"{rest}'
