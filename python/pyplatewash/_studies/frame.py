"""Rows of a study as a frame of pandas."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from .folder import Row
from .needed import needed
from .table import Column, batches

if TYPE_CHECKING:
    import pandas as _pd  # type: ignore[import-untyped]

#: Rows that are dictionaries at a time.
BATCH_ROWS = 10_000
#: Most different texts that are kept once for all rows that have them.
MOST_TEXTS = 10_000

TYPES = {"text": "string", "number": "float64", "whole": "Int64", "flag": "boolean"}


def frame(rows: Iterable[Row], of: list[Column], manifest: dict[str, Any]) -> _pd.DataFrame:
    """The frame of rows, by their index. Raises MissingError without pandas."""
    pd = imported()
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


def imported() -> Any:
    """pandas. Raises MissingError."""
    return needed("pandas", "a frame needs", "study")


def _shared(texts: dict[Any, Any], text: Any) -> Any:
    """The same text, which is in memory once for the rows that have it, while there are few."""
    return texts.setdefault(text, text) if len(texts) < MOST_TEXTS else texts.get(text, text)
