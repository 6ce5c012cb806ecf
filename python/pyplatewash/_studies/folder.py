"""A study's folder, as it was at one moment: its manifest, where each row stands in the journal, and how long each took.

Rows are read one by one, from the file, when they are asked for: a folder of N rows takes 16 N bytes.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

from .. import _core
from .._errors import StudyAccessError, StudyError, StudyNotFoundError

#: A row, by the names of ``docs/studies.md``.
Row: TypeAlias = dict[str, Any]
#: The kind of an axis: ``flag``, ``whole``, ``number``, ``text``, ``json`` (anything else, or values of several kinds), or
#: ``{"numbers": N}``, lists of so many.
Kind: TypeAlias = str | dict[str, int]

#: Values of an array that are Python's own at a time.
AT_A_TIME = 10_000

_TIMING = re.compile(rb'\{"index":(\d{1,18}),"wall_s":(\d{1,18}(?:\.\d{1,30})?(?:e-?\d{1,2})?)\}\n')


class Folder:
    """A study's folder."""

    def __init__(self, path: Path) -> None:
        """Raises StudyError for what is no study's folder, or one whose rows are damaged, or were changed since it was finished."""
        self.path = path
        self.rows_file = path / "rows.jsonl"
        #: Indices of the rows that are there, growing, and where each of them begins in the file [bytes].
        self.indices, self._places = (np.frombuffer(numbers, "<i8") for numbers in _core._study_check(path))
        self.manifest: dict[str, Any] = json.loads((path / "manifest.json").read_text(encoding="utf-8"))
        self.rows: int = self.manifest["rows"]
        #: The kind of each axis, by its key.
        self.axes: dict[str, Kind] = {axis["key"]: axis["kind"] for axis in self.manifest["axes"]}

    @property
    def done(self) -> int:
        """How many rows are there."""
        return len(self.indices)

    def lines(self, places: npt.NDArray[np.int64] | None = None) -> Iterator[bytes]:
        """Lines of rows by where they begin, all of them without ``places``, in the order of their indices."""
        try:
            with open(self.rows_file, "rb") as file:
                here = 0
                for place in one_by_one(self._places if places is None else places):
                    if place != here:
                        file.seek(place)
                    line = file.readline()
                    here = place + len(line)
                    yield line
        except OSError as error:
            raise refused(self.rows_file, "cannot be read", error) from error

    def row(self, index: int) -> Row | None:
        """A row; None where it is not there."""
        place = int(np.searchsorted(self.indices, index))
        if place == self.done or self.indices[place] != index:
            return None
        return next(self.each(self._places[place : place + 1]))

    def each(self, places: npt.NDArray[np.int64] | None = None) -> Iterator[Row]:
        """Rows, as ``lines``. Raises StudyError where the file was changed since it was looked at."""
        for line in self.lines(places):
            try:
                row: Row = json.loads(line)
            except ValueError as error:
                raise StudyError(f"{self.rows_file}: was changed meanwhile: {error}", source=str(self.rows_file)) from error
            yield row

    def wall_s(self) -> npt.NDArray[np.float64]:
        """How long each row of ``indices`` took [s]; NaN where that is not known."""
        took = np.full(self.done, np.nan)
        file = self.path / "timings.jsonl"
        try:
            with open(file, "rb") as lines:
                for number, line in enumerate(lines, 1):
                    stated = _TIMING.fullmatch(line)
                    if stated is None and line.endswith(b"\n"):
                        raise StudyError(f"{file}: line {number}: is no timing", source=str(file), line=number)
                    if stated is not None:
                        place = int(np.searchsorted(self.indices, int(stated[1])))
                        if place < self.done and self.indices[place] == int(stated[1]):
                            took[place] = float(stated[2])
        except FileNotFoundError:
            return took
        except OSError as error:
            raise refused(file, "cannot be read", error) from error
        return took


def one_by_one(values: npt.NDArray[Any]) -> Iterator[Any]:
    """The values of an array as Python's own, of which few are there at a time."""
    for start in range(0, len(values), AT_A_TIME):
        yield from values[start : start + AT_A_TIME].tolist()


def refused(file: Path, doing: str, error: OSError | ValueError) -> StudyAccessError:
    """What to raise for a file that the system does not give or take."""
    number, words = (error.errno, error.strerror) if isinstance(error, OSError) else (None, None)
    message = f"{file}: {doing}: {words or error}"
    kind = StudyNotFoundError if isinstance(error, FileNotFoundError) else StudyAccessError
    return kind(message, source=str(file), filename=str(file), errno=number, strerror=message)
