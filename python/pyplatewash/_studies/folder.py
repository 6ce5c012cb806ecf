"""A study's folder, as it was at one moment: its manifest, where each row stands in the journal, and how long each took.

Rows are read one by one, from the file, when they are asked for: a folder of N rows takes 16 N bytes.
"""

from __future__ import annotations

import json
import re
from array import array
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NoReturn

import numpy as np
import numpy.typing as npt

from .. import _core
from .._errors import StudyAccessError, StudyError, StudyNotFoundError
from .kind import Kind, is_kind
from .row import Row, problem

#: What a manifest and a row state that this program reads.
MANIFEST_FORMAT, ROW_SCHEMA = "platewash-study-manifest/1", 2
#: Values of an array that are Python's own at a time.
AT_A_TIME = 10_000
#: Most rows of a study.
MOST_ROWS = 10_000_000

_BEGINNING = re.compile(rb'\{"schema":(\d{1,9}),"index":(\d{1,18}),"key":"[0-9a-f]{16}",')
_TIMING = re.compile(rb'\{"index":(\d{1,18}),"wall_s":(\d{1,18}(?:\.\d{1,30})?(?:e-?\d{1,2})?)\}\n')


class Folder:
    """A study's folder."""

    def __init__(self, path: Path) -> None:
        """Raises StudyError for what is no study's folder, or one whose rows are damaged, or were changed since it was finished."""
        self.path = path
        self.rows_file = path / "rows.jsonl"
        self.manifest = _manifest(path / "manifest.json")
        self.rows: int = self.manifest["rows"]
        #: The kind of each axis, by its key.
        self.axes: dict[str, Kind] = {axis["key"]: axis["kind"] for axis in self.manifest["axes"]}
        if "rows_sha256" in self.manifest:
            _core._study_check(path)
        #: Indices of the rows that are there, growing, and where each of them begins in the file [bytes].
        self.indices, self._places = self._scanned()

    @property
    def done(self) -> int:
        """How many rows are there."""
        return len(self.indices)

    def lines(self, indices: npt.NDArray[np.int64] | None = None) -> Iterator[bytes]:
        """Lines of rows, all of them without ``indices``, in the order of their indices."""
        places = self._places if indices is None else self._places[np.searchsorted(self.indices, indices)]
        if not len(places):
            return
        try:
            with open(self.rows_file, "rb") as file:
                here = 0
                for place in one_by_one(places):
                    if here != place:
                        file.seek(place)
                    line = file.readline()
                    here = place + len(line)
                    yield line
        except OSError as error:
            raise refused(self.rows_file, "cannot be read", error) from error

    def row(self, index: int) -> Row | None:
        """A row; None where it is not there."""
        place = int(np.searchsorted(self.indices, index))
        if place == len(self.indices) or self.indices[place] != index:
            return None
        return next(self.each(self.indices[place : place + 1]))

    def each(self, indices: npt.NDArray[np.int64] | None = None) -> Iterator[Row]:
        """Rows, as ``lines``. Raises StudyError for a damaged one, with its line."""
        wanted = self.indices if indices is None else indices
        for index, line in zip(one_by_one(wanted), self.lines(indices)):
            row: Any = None
            try:
                row = json.loads(line, parse_constant=_no_number)
                wrong = problem(row, index, self.axes)
            except (ValueError, RecursionError) as error:
                wrong = str(error)
            if wrong is not None:
                self._damaged(int(self._places[np.searchsorted(self.indices, index)]), f"is no row: {wrong}")
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
                        raise StudyError(f"{file}:{number}: is no timing", source=str(file), line=number)
                    if stated is not None:
                        place = int(np.searchsorted(self.indices, int(stated[1])))
                        if place < self.done and self.indices[place] == int(stated[1]):
                            took[place] = float(stated[2])
        except FileNotFoundError:
            return took
        except (OSError, ValueError) as error:
            if isinstance(error, StudyError):
                raise
            raise refused(file, "cannot be read", error) from error
        return took

    def _scanned(self) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]:
        indices, places = array("q"), array("q")
        here = 0
        try:
            with open(self.rows_file, "rb") as file:
                for line in file:
                    if not line.endswith(b"\n"):
                        break  # Torn, or being written.
                    begins = _BEGINNING.match(line)
                    if begins is None:
                        self._damaged(here, "is no row")
                    if int(begins[1]) != ROW_SCHEMA:
                        self._damaged(here, f"is a row of schema {int(begins[1])}; this program reads schema {ROW_SCHEMA}")
                    if int(begins[2]) >= self.rows:
                        self._damaged(here, f"is row {int(begins[2])}; the study has {self.rows}, counted from 0")
                    indices.append(int(begins[2]))
                    places.append(here)
                    here += len(line)
        except OSError as error:
            raise refused(self.rows_file, "cannot be read", error) from error
        by_index, by_place = np.array(indices, np.int64), np.array(places, np.int64)
        order = np.argsort(by_index, kind="stable")
        by_index, by_place = by_index[order], by_place[order]
        twice = np.flatnonzero(by_index[1:] == by_index[:-1])
        if len(twice):
            self._damaged(int(by_place[twice[0] + 1]), f"row {by_index[twice[0]]} is there before")
        return by_index, by_place

    def _damaged(self, place: int, what: str) -> NoReturn:
        """Raises the error of the line that begins at a place [bytes]."""
        with open(self.rows_file, "rb") as file:
            left, number = place, 1
            while left > 0 and (piece := file.read(min(left, 1 << 20))):
                number += piece.count(b"\n")
                left -= len(piece)
        raise StudyError(f"{self.rows_file}:{number}: {what}", source=str(self.rows_file), line=number)


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


def _manifest(file: Path) -> dict[str, Any]:
    try:
        text = file.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise StudyError(f"{file}: is no manifest: {error}", source=str(file)) from error
    except (OSError, ValueError) as error:
        raise refused(file, "cannot be read, so that this is no study's folder", error) from error
    try:
        manifest = json.loads(text, parse_constant=_no_number)
    except (ValueError, RecursionError) as error:
        raise StudyError(f"{file}: is no manifest: {error}", source=str(file)) from error
    wrong = _manifest_problem(manifest)
    if wrong is not None:
        raise StudyError(f"{file}: {wrong}", source=str(file))
    return dict(manifest)


def _manifest_problem(manifest: Any) -> str | None:
    if not isinstance(manifest, dict) or manifest.get("format") != MANIFEST_FORMAT:
        stated = manifest.get("format") if isinstance(manifest, dict) else None
        return f"format must be {MANIFEST_FORMAT}; found {stated!r:.60}"
    if manifest.get("row_schema") != ROW_SCHEMA:
        return f"row_schema must be {ROW_SCHEMA}; found {manifest.get('row_schema')!r:.60}"
    rows = manifest.get("rows")
    if type(rows) is not int or not 0 < rows <= MOST_ROWS:
        return f"rows must be an integer from 1 to {MOST_ROWS}; found {rows!r:.60}"
    for name, part in (("axes", "key"), ("scenarios", "name")):
        listed = manifest.get(name)
        if not isinstance(listed, list) or not all(isinstance(one, dict) and isinstance(one.get(part), str) for one in listed):
            return f"{name} must be a list, each with its {part}"
        if len({one[part] for one in listed}) < len(listed):
            return f"{name} must be a list of different ones; found one twice"
    wrong = [axis for axis in manifest["axes"] if not is_kind(axis.get("kind"))]
    if wrong:
        return f"axes: the kind of {wrong[0]['key']} must be one that docs/studies.md names; found {wrong[0].get('kind')!r:.60}"
    return None


def _no_number(word: str) -> NoReturn:
    raise ValueError(f"{word} is no number of JSON")
