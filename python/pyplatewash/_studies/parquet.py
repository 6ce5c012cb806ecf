"""Rows of a study as a Parquet data set, written some thousand rows at a time."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from .folder import Row
from .needed import needed
from .table import Column, batches

#: Rows that are in memory at a time, a row group each; rows of a file of a data set.
GROUP_ROWS, FILE_ROWS = 10_000, 1_000_000


def write(path: Path, rows: Iterable[Row], of: list[Column], manifest: dict[str, Any]) -> None:
    """Writes rows to a file whose name ends with ``.parquet``, or else to files ``part-00000.parquet`` … in a folder, which is there.

    The schema has every column, whatever is null in these rows; its metadata has the manifest under ``platewash_manifest``, as JSON.

    Raises MissingError without pyarrow, OSError.
    """
    pa, parquet = imported()
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


def imported() -> tuple[Any, Any]:
    """pyarrow and its Parquet. Raises MissingError."""
    return needed("pyarrow", "a Parquet data set needs", "study"), needed("pyarrow.parquet", "a Parquet data set needs", "study")
