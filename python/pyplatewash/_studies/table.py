"""Rows of a study as a table of columns: which there are, of which kind, and what each has of a row.

The columns follow from the study's axes, which its manifest states, never from which rows are done or which of their fields are null.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from .kind import Kind
from .row import Row


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
    own = [_field("index", "whole"), _field("key", "text"), _field("scenario", "text")]
    for key in sorted(axes):
        own += _axis(key, axes[key])
    own += [_field("outcome", "text"), _field("reason", "text"), _within("place", "requirement", "text")]
    own += [_within("place", name, "whole") for name in ("plate", "segment", "waypoint")]
    own += [_within("place", "time_s", "number"), *(_part("place.point_m", _at("place", "point_m"), k, "number") for k in range(3))]
    own += [_field(name, "number") for name in ("duration_s", "swept", "pressed", "clearance_m")]
    own += [_part("clearance_pair", _at("clearance_pair"), k, "text") for k in range(2)]
    return [*own, _field("plan", "text")]


def batches(rows: Iterable[Row], of: list[Column], size: int) -> Iterator[list[list[Any]]]:
    """The values of columns, so many rows at a time."""
    gathered: list[list[Any]] = [[] for _ in of]
    count = 0
    for row in rows:
        for values, column in zip(gathered, of):
            values.append(column.of(row))
        count += 1
        if count == size:
            yield gathered
            gathered, count = [[] for _ in of], 0
    if count:
        yield gathered


def _axis(key: str, kind: Kind) -> list[Column]:
    value = _at("axes", key)
    if isinstance(kind, dict):
        return [_part(key, value, place, "number") for place in range(kind["numbers"])]
    if kind == "json":
        return [Column(key, "text", lambda row: as_json(value(row)))]
    if kind == "number":
        return [Column(key, "number", lambda row: _number(value(row)))]
    return [Column(key, kind, value)]


def as_json(value: Any) -> str:
    """A value as JSON, without spaces."""
    return json.dumps(value, separators=(",", ":"), ensure_ascii=False)


def _field(name: str, kind: str) -> Column:
    value = _at(name)
    return Column(name, kind, (lambda row: _number(value(row))) if kind == "number" else value)


def _within(outer: str, name: str, kind: str) -> Column:
    value = _at(outer, name)
    return Column(f"{outer}.{name}", kind, (lambda row: _number(value(row))) if kind == "number" else value)


def _part(name: str, of: Callable[[Row], Any], place: int, kind: str) -> Column:
    def value(row: Row) -> Any:
        parts = of(row)
        if not isinstance(parts, list) or place >= len(parts):
            return None
        return _number(parts[place]) if kind == "number" else parts[place]

    return Column(f"{name}.{place}", kind, value)


def _at(*names: str) -> Callable[[Row], Any]:
    def value(row: Row) -> Any:
        found: Any = row
        for name in names:
            found = found.get(name) if isinstance(found, dict) else None
        return found

    return value


def _number(value: Any) -> float | None:
    return None if value is None else float(value)
