"""Numbers in sentences."""

from __future__ import annotations


def percent(share: float) -> str:
    """A share as a percentage that is 100 only where hardly anything is missed.

    >>> percent(0.4202), percent(0.99994), percent(1.0)
    ('42.02 %', '99.99 %', '100.00 %')
    """
    return f"{100 * share if share >= 0.99995 else min(100 * share, 99.99):.2f} %"
