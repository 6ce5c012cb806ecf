"""Rows of a study as a table of columns: which there are, of which kind, and what each has of a row.

The columns follow from the study's axes, which its manifest states, never from which rows are done or which of their fields are null.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import islice
from typing import Any

from .folder import Kind, Row

#: Fields of rows and their kinds, before the axes and behind them. One within another is called by both, and a part of a list by its place.
BEFORE = {"index": "whole", "key": "text", "scenario": "text"}
BEHIND = {"outcome": "text", "reason": "text", "place.requirement": "text", "place.plate": "whole", "place.segment": "whole", "place.waypoint": "whole"}
BEHIND |= {"place.time_s": "number", "place.point_m.0": "number", "place.point_m.1": "number", "place.point_m.2": "number", "duration_s": "number"}
BEHIND |= {"swept": "number", "pressed": "number", "clearance_m": "number", "clearance_pair.0": "text", "clearance_pair.1": "text", "plan": "text"}


@dataclass(frozen=True)
class Column:
    """A column: its name, its kind, and its value in a row, ``None`` where there is none."""

    name: str
    #: ``text``, ``number`` (a float), ``whole`` (an integer) or ``flag``.
    kind: str
    of: Callable[[Row], Any]


def columns(axes: Mapping[str, Kind]) -> list[Column]:
    """The columns of rows with these axes: ``index``, ``key``, ``scenario``, the axes, then the fields of rows in their order. A field
    within another is called by both, as ``place.plate``, and parts of a list by their place from 0, as ``plate[0].at_m.0``."""
    before, behind = ([_column(name, kind, *name.split(".")) for name, kind in fields.items()] for fields in (BEFORE, BEHIND))
    return before + [column for key in sorted(axes) for column in _axis(key, axes[key])] + behind


def batches(rows: Iterable[Row], of: list[Column], size: int) -> Iterator[list[list[Any]]]:
    """The values of columns, so many rows at a time."""
    left = iter(rows)
    while some := list(islice(left, size)):
        yield [[column.of(row) for row in some] for column in of]


def _axis(key: str, kind: Kind) -> list[Column]:
    if isinstance(kind, dict):
        return [_column(f"{key}.{place}", "number", "axes", key, place) for place in range(kind["numbers"])]
    if kind == "json":
        return [Column(key, "text", lambda row: as_json(row["axes"][key]))]
    return [_column(key, kind, "axes", key)]


def as_json(value: Any) -> str:
    """A value as JSON, without spaces."""
    return json.dumps(value, separators=(",", ":"), ensure_ascii=False)


def _column(name: str, kind: str, *steps: str | int) -> Column:
    """The column of what a row has behind these steps."""

    def value(row: Row) -> Any:
        found: Any = row
        for step in steps:
            if found is not None:
                found = found[int(step)] if isinstance(found, list) else found.get(step)
        return float(found) if kind == "number" and found is not None else found

    return Column(name, kind, value)
