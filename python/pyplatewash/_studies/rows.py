"""The rows of a study, to read: one by one, as a frame, as a data set, as maps of the table."""

from __future__ import annotations

import copy
import errno
import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from .. import _arguments, _core
from .._errors import NoKeyError, StudyError
from .._records import Record
from .._files import staged
from . import table
from .folder import Folder, Row, one_by_one, refused
from .table import Column, columns

if TYPE_CHECKING:
    import pandas as _pd  # type: ignore[import-untyped]
    from matplotlib.axes import Axes


class StudyRows:
    """The rows in a study's folder, of one that is finished or under way, as they are when this is made: make it anew to see what was added.

    Iteration gives the rows that are there, as dictionaries, in the order of their indices; ``docs/studies.md`` says what each field
    means. Nothing but where a row stands is kept in memory: 16 bytes each. A last line that is torn, or is being written, is left out.

    Raises StudyError for what is no study's folder, for damaged lines, by their file and line, and for rows that were changed since the
    study was finished; what cannot be read at all is a FileError, too.
    """

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self._of = Folder(_arguments.path("folder", folder))

    @property
    def folder(self) -> Path:
        """The folder."""
        return self._of.path

    @property
    def manifest(self) -> dict[str, Any]:
        """What tells this study from others: ``manifest.json``."""
        return copy.deepcopy(self._of.manifest)

    @property
    def axes(self) -> list[str]:
        """Keys of the axes."""
        return list(self._of.axes)

    @property
    def rows(self) -> int:
        """How many rows the study has."""
        return self._of.rows

    @property
    def done(self) -> int:
        """How many of them are there."""
        return self._of.done

    @property
    def finished(self) -> bool:
        """Whether all of them are there."""
        return self.done == self.rows

    def __len__(self) -> int:
        return self.done

    def __iter__(self) -> Iterator[dict[str, Any]]:
        return self._of.each()

    def __repr__(self) -> str:
        return f"StudyRows({str(self.folder)!r}, {self.done} of {self.rows} rows)"

    def _repr_html_(self) -> str:
        from .._tables import study_rows

        told = self.summary().to_dict()
        return study_rows(f"Study {self.manifest['name']}: {told['done']} of {self.rows} rows", told["outcomes"], told["by_axis"])

    def row(self, index: int) -> dict[str, Any]:
        """A row by its index, from 0. Raises InputError for one that the study has not, NoKeyError for one that is not done."""
        number = _arguments.count("index", index, 0, self.rows - 1)
        row = self._of.row(number)
        if row is None:
            raise NoKeyError(f"index: row {number} of {self.folder} is not done yet", argument="index")
        return row

    def summary(self) -> Record:
        """What the rows come to, as ``platewash study show --json`` says: ``outcomes``, ``by_axis``, ``duration_s``, rows to look at."""
        return _core._study_summary(self.folder)

    def plan(self, index: int) -> _core.Plan:
        """The plan of a row, where the study keeps it.

        Raises NoKeyError where it does not; StudyError for a plan that is not the row's, by its hash; PlanError for what is none.
        """
        row = self.row(index)
        file = self.folder / "plans" / f"{row['index']}.json"
        if not file.is_file():
            why = "it has none" if row.get("plan") is None else "the study does not keep it, or it was taken away"
            raise NoKeyError(f"index: there is no plan of row {row['index']} in {file.parent}: {why}", argument="index")
        plan = _core.Plan.load(file)
        if plan.hash != row["plan"] or not plan.is_sealed():
            found = plan.hash if plan.hash != row["plan"] else "this one over other contents"
            raise StudyError(f"{file}: is not the plan of row {row['index']}, whose hash is {row['plan']}; found {found}", source=str(file))
        return plan

    def scenario(self, index: int) -> _core.Scenario:
        """The scenario of a row, to plan it alone: that of the study, with the values of the row. The folder holds all that it takes.

        Raises StudyError or ScenarioError where the values of the row are no scenario: its outcome is ``error``.
        """
        number = self.row(index)["index"]
        return _core.Study.load(self.folder).scenario(number)

    def export(self, path: str | os.PathLike[str], *, partial: bool = False) -> None:
        """Writes the rows as JSON Lines in the order of their indices, whole or not at all: the same bytes as ``platewash study export``, and
        for every engine and number of workers. A study that is not finished is refused without ``partial``.

        Raises StudyError; FileError where the file cannot be written.
        """
        place = self._ready(path, partial)
        _free(place, self.folder, as_folder=False)
        try:
            with staged(place) as beside:
                with open(beside, "xb") as out:
                    out.writelines(self._of.lines())
        except StudyError:
            raise
        except (OSError, ValueError) as error:
            raise refused(place, "cannot be written", error) from error

    def to_frame(self, *, timings: bool = True) -> _pd.DataFrame:
        """The rows as a frame of pandas, by ``index``: one column per axis, by its key, and one per field.

        Lists are spread over columns of numbers by their place: ``plate[0].at_m.0`` is x, ``.1`` y and ``.2`` z, so that they can be
        sorted by, joined and drawn; so are ``clearance_pair.0``, ``.1`` and ``place.point_m.0`` … ``.2``. What a field has within it is called
        by both: ``place.requirement``. Lists of anything else but numbers, and axes of values of several kinds, are texts of JSON. There
        are the same columns, of the same types, whichever rows are done and whatever is null in them; ``wall_s`` is how long a row took [s],
        missing where nobody knows, unless ``timings`` is False. ``frame.attrs["manifest"]`` is the manifest.

        Raises MissingError, an ImportError, without pandas.
        """
        with_timings = _arguments.flag("timings", timings)
        table.pandas()
        return table.frame(self._timed(with_timings), self._columns(with_timings), self.manifest)

    def to_parquet(self, path: str | os.PathLike[str], *, timings: bool = True, partial: bool = False) -> None:
        """Writes the rows as a Parquet data set, some thousand in memory at a time: a file where the name ends with ``.parquet``, else a folder,
        which is made, of files of a million rows. It is there whole or not at all.

        Columns are those of ``to_frame`` and ``index``; the schema's metadata has the manifest, under ``platewash_manifest``. Without
        ``timings``, the same rows make the same data. A study that is not finished is refused without ``partial``.

        Raises MissingError, an ImportError, without pyarrow; StudyError; FileError where it cannot be written, or the folder has files.
        """
        with_timings = _arguments.flag("timings", timings)
        place = self._ready(path, partial)
        table.pyarrow()
        as_folder = place.suffix != ".parquet"
        _free(place, self.folder, as_folder)
        of = self._columns(with_timings)
        try:
            with staged(place, as_folder=as_folder) as beside:
                table.write_parquet(beside, self._timed(with_timings), of, self._of.manifest)
        except StudyError:
            raise
        except (OSError, ValueError) as error:
            raise refused(place, "cannot be written", error) from error

    def map(
        self,
        at: str,
        value: Literal["washable", "clearance", "swept", "duration", "outcome"] = "washable",
        *,
        by: str | Sequence[str] = (),
        region: _core.Scenario | str | os.PathLike[str] | None = None,
        ax: Any = None,
    ) -> Axes | list[Axes]:
        """A map of the table from above, by matplotlib: at each place of the axis ``at``, a list with x and y as ``plate[0].at_m``, what came of
        the rows there, for all values of the other axes together.

        ``value`` is ``"washable"``, the share of rows that are proved; ``"clearance"`` or ``"swept"``, the least that is proved;
        ``"duration"``, the mean of what is proved; or ``"outcome"``, where all rows at a place ended alike. Places without rows stay
        blank; where rows are, but nothing proved, they are grey. ``by`` names axes, ``scenario`` among them: there is a map for each
        combination of their values, on one scale. ``region`` is a scenario whose region of plate centres is outlined. ``ax`` is an Axes, or
        as many as there are maps.

        The answer is the Axes, or a list where ``by`` is given. Raises InputError; MissingError, an ImportError, without matplotlib.
        """
        from .._figures import draw

        return draw(self._of, (at, value, by, region), ax)

    def _ready(self, path: Any, partial: Any) -> Path:
        place, allowed = _arguments.path("path", path), _arguments.flag("partial", partial)
        if not (self.finished or allowed):
            raise StudyError(
                f"{self.folder}: the study is not finished: {self.done} of {self.rows} rows; go on with it, or take what is there: partial=True",
                source=str(self.folder),
            )
        _core._study_check(self.folder)
        return place

    def _columns(self, timings: bool) -> list[Column]:
        took = [Column("wall_s", "number", lambda row: row["wall_s"])] if timings else []
        return [*columns(self._of.axes), *took]

    def _timed(self, timings: bool) -> Iterator[Row]:
        if not timings:
            yield from self
            return
        for row, wall_s in zip(self, one_by_one(self._of.wall_s())):
            # None where it is not known.
            row["wall_s"] = wall_s if wall_s == wall_s else None
            yield row


def _free(place: Path, kept: Path, as_folder: bool) -> None:
    """Raises FileError for a place that a file, or a folder, cannot take; in the study's folder there is none."""
    try:
        if kept.resolve() in place.resolve().parents:
            raise FileExistsError(errno.EEXIST, "it is in the study's folder, which is kept as it is")
        taken = place.exists() and (not place.is_dir() or next(place.iterdir(), None) is not None if as_folder else not place.is_file())
    except (OSError, ValueError) as error:
        raise refused(place, "cannot be written", error) from error
    if taken:
        why = "there is a file of that name, or a folder with files" if as_folder else f"it is {'a folder' if place.is_dir() else 'no regular file'}"
        raise refused(place, "cannot be written", FileExistsError(errno.EEXIST, why))
