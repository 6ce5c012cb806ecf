"""Rows of a study as a table of columns, as a frame of pandas and as a Parquet data set."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from importlib import import_module
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .._errors import MissingError
from .folder import Kind, Row

if TYPE_CHECKING:
    import pandas as _pd  # type: ignore[import-untyped]


def needed(module: str, by: str, extra: str) -> Any:
    """A module of a package that ``pyplatewash[extra]`` brings. Raises MissingError where the package is not installed."""
    package = module.split(".")[0]
    try:
        return import_module(module)
    except ModuleNotFoundError as error:
        if error.name is None or error.name.split(".")[0] != package:
            raise
        raise MissingError(f"{by} {package}, which is not installed: pip install 'pyplatewash[{extra}]'", name=package) from error


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


#: Rows that are dictionaries at a time.
BATCH_ROWS = 10_000
#: Most different texts that are kept once for all rows that have them.
MOST_TEXTS = 10_000

TYPES = {"text": "string", "number": "float64", "whole": "Int64", "flag": "boolean"}


def frame(rows: Iterable[Row], of: list[Column], manifest: dict[str, Any]) -> _pd.DataFrame:
    """The frame of rows, by their index. Raises MissingError without pandas."""
    pd = pandas()
    texts: dict[Any, Any] = {}

    def column(values: list[Any], kind: str) -> Any:
        return pd.array([_shared(texts, one) for one in values] if kind == "text" else values, dtype=TYPES[kind])

    def part(values: list[list[Any]]) -> Any:
        return pd.DataFrame({c.name: column(one, c.kind) for c, one in zip(of, values)})

    parts = [part(values) for values in batches(rows, of, BATCH_ROWS)] or [part([[] for _ in of])]
    whole = pd.concat(parts, ignore_index=True)
    whole["index"] = whole["index"].astype("int64")
    whole = whole.set_index("index")
    whole.attrs["manifest"] = manifest
    return whole


def pandas() -> Any:
    """pandas. Raises MissingError."""
    return needed("pandas", "a frame needs", "study")


def _shared(texts: dict[Any, Any], text: Any) -> Any:
    """The same text, which is in memory once for the rows that have it, while there are few."""
    return texts.setdefault(text, text) if len(texts) < MOST_TEXTS else texts.get(text, text)


#: Rows that are in memory at a time, a row group each; rows of a file of a data set.
GROUP_ROWS, FILE_ROWS = 10_000, 1_000_000


def write_parquet(path: Path, rows: Iterable[Row], of: list[Column], manifest: dict[str, Any]) -> None:
    """Writes rows to a file whose name ends with ``.parquet``, or else to files ``part-00000.parquet`` … in a folder, which is there.

    The schema has every column, whatever is null in these rows; its metadata has the manifest under ``platewash_manifest``, as JSON.

    Raises MissingError without pyarrow, OSError.
    """
    pa, parquet = pyarrow()
    types = {"text": pa.string(), "number": pa.float64(), "whole": pa.int64(), "flag": pa.bool_()}
    metadata = {"platewash_manifest": json.dumps(manifest, ensure_ascii=False)}
    schema = pa.schema([pa.field(c.name, types[c.kind], nullable=c.name not in ("index", "key", "scenario", "outcome")) for c in of], metadata)
    part, written = 0, 0
    writer = parquet.ParquetWriter(_file(path, part), schema)
    try:
        for values in batches(rows, of, GROUP_ROWS):
            if written >= FILE_ROWS and path.is_dir():
                writer.close()
                part, written = part + 1, 0
                writer = parquet.ParquetWriter(_file(path, part), schema)
            arrays = [pa.array(column, type=field.type) for column, field in zip(values, schema)]
            writer.write_batch(pa.record_batch(arrays, schema=schema))
            written += len(values[0])
    finally:
        writer.close()


def _file(path: Path, part: int) -> Path:
    return path / f"part-{part:05}.parquet" if path.is_dir() else path


def pyarrow() -> tuple[Any, Any]:
    """pyarrow and its Parquet. Raises MissingError."""
    return needed("pyarrow", "a Parquet data set needs", "study"), needed("pyarrow.parquet", "a Parquet data set needs", "study")
