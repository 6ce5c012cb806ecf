"""A row of a study as ``docs/studies.md`` states it: what its fields are, and what is wrong with one that is none."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

from .kind import Kind, fits

#: A row, by the names of ``docs/studies.md``.
Row: TypeAlias = dict[str, Any]

#: Codes of outcomes.
OUTCOMES = ("proved", "not_proved", "infeasible", "not_found", "error", "crashed")


def _is_number(value: Any) -> bool:
    return type(value) in (int, float)


def _is_whole(value: Any) -> bool:
    return type(value) is int and abs(value) < 2**63


def _is_text(value: Any) -> bool:
    return isinstance(value, str)


def _is_point(value: Any) -> bool:
    return isinstance(value, list) and len(value) == 3 and all(map(_is_number, value))


def _is_pair(value: Any) -> bool:
    return isinstance(value, list) and len(value) == 2 and all(map(_is_text, value))


Check: TypeAlias = tuple[Callable[[Any], bool], str]

NUMBER: Check = (_is_number, "a number or null")
WHOLE: Check = (_is_whole, "an integer or null")
TEXT: Check = (_is_text, "a text or null")

#: Fields that may be null, or missing.
ROW: dict[str, Check] = {
    "reason": TEXT,
    "duration_s": NUMBER,
    "swept": NUMBER,
    "pressed": NUMBER,
    "clearance_m": NUMBER,
    "clearance_pair": (_is_pair, "two texts or null"),
    "plan": TEXT,
}
PLACE: dict[str, Check] = {
    "requirement": TEXT,
    "plate": WHOLE,
    "waypoint": WHOLE,
    "segment": WHOLE,
    "time_s": NUMBER,
    "point_m": (_is_point, "three numbers or null"),
}


def problem(row: Any, index: int, axes: Mapping[str, Kind]) -> str | None:
    """What is wrong with the row of an index, of a study with these axes; None where nothing is."""
    if not isinstance(row, dict) or row.get("index") != index:
        return f"index must be {index}: the file was changed meanwhile"
    if row.get("outcome") not in OUTCOMES:
        return f"outcome must be one of {', '.join(OUTCOMES)}; found {row.get('outcome')!r:.60}"
    for name in ("axes", "place"):
        if not isinstance(row.get(name), dict):
            return f"{name} must be an object; found {row.get(name)!r:.60}"
    for name in ("key", "scenario"):
        if not isinstance(row.get(name), str):
            return f"{name} must be a text; found {row.get(name)!r:.60}"
    if row["axes"].keys() != axes.keys():
        return f"axes must be those of manifest.json, {', '.join(axes) or 'none'}; found {', '.join(row['axes']) or 'none':.200}"
    for key, kind in axes.items():
        if not fits(kind, row["axes"][key]):
            return f"axes: {key} must be of the kind that manifest.json states, {kind}; found {row['axes'][key]!r:.60}"
    for prefix, fields, of in (("", ROW, row), ("place.", PLACE, row["place"])):
        for name, (is_one, words) in fields.items():
            value = of.get(name)
            if value is not None and not is_one(value):
                return f"{prefix}{name} must be {words}; found {value!r:.60}"
    return None
