"""``Study.run``: computes the rows that a folder lacks, by an engine, and reports progress."""

from __future__ import annotations

import sys
import time
import uuid
from collections.abc import Callable
from pathlib import Path
from types import TracebackType
from typing import Any

from .. import __version__, _core
from .._errors import InputError, InputTypeError
from .engines.contract import WORKERS, Engine, Kit, asking, processors
from .engines.drive import drive
from .rows import StudyRows

#: Time between two lines where there is no bar [s].
EVERY_S = 5.0

Told = Callable[[int, int], object]


class Progress:
    """A bar by tqdm, or lines on standard error where it is not installed; nothing, or a function of the caller's, who is told (done, rows)."""

    def __init__(self, wanted: bool | Told, done: int, rows: int) -> None:
        self._bar: Any = None
        self._told: Told = _silent
        self._began, self._before, self._last = time.monotonic(), done, time.monotonic()
        if callable(wanted):
            self._told = wanted
        elif wanted:
            self._told = self._line
            try:
                from tqdm.auto import tqdm  # type: ignore[import-untyped]
            except ModuleNotFoundError:
                return
            self._bar = tqdm(total=rows, initial=done, unit="row", smoothing=0.05)
            self._told = self._draw

    def __enter__(self) -> Told:
        return self._told

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None) -> None:
        if self._bar is not None:
            self._bar.close()

    def _draw(self, done: int, rows: int) -> None:
        self._bar.update(done - self._bar.n)

    def _line(self, done: int, rows: int) -> None:
        now = time.monotonic()
        if now - self._last < EVERY_S and done < rows:
            return
        self._last = now
        per_s = (done - self._before) / max(now - self._began, 1e-9)
        print(f"study: {done} of {rows} rows, {per_s:.3g} rows/s, {(rows - done) / max(per_s, 1e-9):.0f} s left", file=sys.stderr)


def _silent(done: int, rows: int) -> None:
    """Nobody is told."""


def run(study: _core.Study, out: Path, engine: str, workers: int | None, client: Any, address: str | None, progress: Any) -> StudyRows:
    """As ``Study.run``, whose arguments were read but for ``client`` and ``progress``."""
    _check(engine, workers, client, address, progress)
    journal = _core.StudyJournal(out, study)
    try:
        done, rows = journal.done, len(study)
        if done < rows:
            with Progress(True if progress is None else progress, done, rows) as told:
                if engine in ("threads", "processes"):
                    workers = min(workers or processors(), rows - done)
                if engine == "threads":
                    journal.work(workers or processors(), told)
                else:
                    by_engine(study, journal, engine, workers, client, address, told)
        journal.finish()
    finally:
        journal.close()
    return StudyRows(out)


def by_engine(
    study: _core.Study, journal: _core.StudyJournal, engine: str, workers: int | None, client: Any, address: str | None, told: Any, *, is_empty: bool = False
) -> None:
    """Works on the missing rows with an engine, which is begun and let go."""
    kit = Kit(uuid.uuid4().hex, __version__, study._parts(), is_empty)
    with asking(engine.capitalize()):
        begun = begin(engine, kit, workers, client, address)
    try:
        drive(begun, journal, len(study), told)
    finally:
        begun.close()


def begin(engine: str, kit: Kit, workers: int | None, client: Any, address: str | None) -> Engine:
    """The engine of a name; its package is asked for only now."""
    if engine == "processes":
        from .engines.processes import Processes

        return Processes(kit, workers or processors())
    if engine == "dask":
        from .engines.dask import Dask

        return Dask(kit, workers, client, address)
    from .engines.ray import Ray

    return Ray(kit, workers, address)


def _check(engine: str, workers: int | None, client: Any, address: str | None, progress: Any) -> None:
    if progress is not None and not isinstance(progress, bool) and not callable(progress):
        raise InputTypeError(f"progress: True, False or a function is needed; found a value of type {type(progress).__name__}", argument="progress")
    if address is not None and engine not in ("dask", "ray"):
        raise InputError(f"address: is of a cluster, and engine '{engine}' has none", argument="address")
    if address is not None and not address.strip():
        raise InputError(f"address: the address of a cluster is needed; found {address!r}", argument="address")
    if client is not None:
        if not hasattr(client, "submit") or not hasattr(client, "nthreads"):
            raise InputTypeError(f"client: a distributed.Client is needed; found a value of type {type(client).__name__}", argument="client")
        if engine != "dask" or address is not None:
            raise InputError("client: is for engine 'dask', without an address", argument="client")
    if workers is not None and (client is not None or address is not None):
        raise InputError(WORKERS, argument="workers")
