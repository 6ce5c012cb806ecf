"""Folders of studies, made by hand, for the tests of those who read them."""

import hashlib
import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import pyplatewash as pw

NO_PLACE = {"requirement": None, "plate": None, "segment": None, "waypoint": None, "time_s": None, "point_m": None}

#: Kinds of axes.
KINDS: dict[str, Any] = {"plate[0].at_m": {"numbers": 3}, "robot.model": "text", "tool.length_m": "number", "seed": "whole"}


def row(index: int, axes: Mapping[str, Any], outcome: str = "proved", **fields: Any) -> dict[str, Any]:
    """A row, whose fields are null but for those given."""
    key = hashlib.sha256(repr(sorted(axes.items())).encode()).hexdigest()[:16]
    stated: dict[str, Any] = {"schema": 2, "index": index, "key": key, "scenario": "kitchen", "axes": dict(sorted(axes.items())), "outcome": outcome, "reason": None}
    stated |= {"place": NO_PLACE, "duration_s": None, "swept": None, "pressed": None, "clearance_m": None, "clearance_pair": None, "plan": None}
    return stated | fields


def line(of: Mapping[str, Any]) -> bytes:
    """A row as it stands in the journal."""
    return json.dumps(of, separators=(",", ":"), ensure_ascii=False).encode() + b"\n"


def folder(at: Path, keys: Iterable[str], done: Iterable[Mapping[str, Any]], count: int, *, torn: bytes = b"", **manifest: Any) -> Path:
    """A study's folder with rows in the order in which they were done, of so many in all; `torn` follows them. A mapping of keys has the
    kinds of axes other than usual."""
    at.mkdir()
    kinds = keys if isinstance(keys, Mapping) else KINDS
    axes = [{"key": key, "count": count, "kind": kinds[key]} for key in keys]
    scenarios = [{"name": "kitchen", "sha256": 64 * "0"}]
    stated = {"format": "platewash-study-manifest/1", "name": "by hand", "version": pw.__version__, "row_schema": 2, "rows": count, "study_sha256": 64 * "0"}
    stated |= {"scenarios": scenarios, "axes": axes, "files": [], "file": "study.toml", **manifest}
    (at / "manifest.json").write_text(json.dumps(stated))
    done = list(done)
    (at / "rows.jsonl").write_bytes(b"".join(map(line, done)) + torn)
    (at / "timings.jsonl").write_text("".join(f'{{"index":{one["index"]},"wall_s":{0.25 + one["index"]}}}\n' for one in done[:-1]))
    return at
