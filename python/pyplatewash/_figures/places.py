"""What came of a study's rows, place by place."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, TypeAlias

from .._errors import InputError
from .._studies.folder import Folder, Row

#: x and y [m].
Place: TypeAlias = tuple[float, float]


@dataclass
class Tally:
    """The rows at a place."""

    rows: int = 0
    proved: int = 0
    #: Codes of how they ended.
    outcomes: set[str] = field(default_factory=set)
    #: The least of what is proved: clearance [m], and share swept.
    clearance_m: float | None = None
    swept: float | None = None
    #: Of what is proved, in all [s].
    whole_s: float = 0.0

    def add(self, row: Row) -> None:
        self.rows += 1
        self.outcomes.add(row["outcome"])
        if row["outcome"] != "proved":
            return
        self.proved += 1
        self.clearance_m = _least(self.clearance_m, row.get("clearance_m"))
        self.swept = _least(self.swept, row.get("swept"))
        self.whole_s += row.get("duration_s") or 0.0

    @property
    def duration_s(self) -> float | None:
        """Mean of what is proved [s]."""
        return self.whole_s / self.proved if self.proved else None


def gathered(of: Folder, at: str, by: list[str], most: int) -> dict[tuple[Any, ...], dict[Place, Tally]]:
    """Tallies by place, for each combination of values of the axes ``by``, each axis in the order of the study, the last one the fastest.

    Raises InputError for places that are none, and for more combinations than ``most``.
    """
    maps: dict[str, tuple[tuple[Any, ...], dict[Place, Tally]]] = {}
    for row in of.each():
        values = tuple(row["scenario"] if key == "scenario" else row["axes"].get(key) for key in by)
        place = row["axes"].get(at)
        if not isinstance(place, list) or len(place) < 2 or not all(type(v) in (int, float) for v in place[:2]):
            words = f"at: an axis of places is needed, lists with x and y; found {at}, whose value in row {row['index']} is {place!r:.60}"
            raise InputError(words, argument="at")
        _, places = maps.setdefault(repr(values), (values, {}))
        if len(maps) > most:
            raise InputError(f"by: axes with at most {most} combinations of values are needed; found more of {', '.join(by)}", argument="by")
        places.setdefault((float(place[0]), float(place[1])), Tally()).add(row)
    if not maps:
        raise InputError(f"at: rows to draw are needed; {of.path} has none yet", argument="at")
    return {values: places for values, places in sorted(maps.values(), key=_Order([values for values, _ in maps.values()]))}


class _Order:
    """Combinations, ordered by where the study has their values first."""

    def __init__(self, all_: list[tuple[Any, ...]]) -> None:
        self._firsts = [list(dict.fromkeys(map(repr, column))) for column in zip(*all_)]

    def __call__(self, one: tuple[tuple[Any, ...], Any]) -> list[int]:
        return [first.index(repr(value)) for first, value in zip(self._firsts, one[0])]


def _least(one: float | None, other: float | None) -> float | None:
    known = [value for value in (one, other) if value is not None]
    return min(known) if known else None
