"""``Study.run``: the rows that a folder lacks, by an engine."""

from __future__ import annotations

import uuid
from pathlib import Path
from typing import Any

from .. import __version__, _core
from .._errors import InputError, InputTypeError
from .engines.contract import WORKERS, Engine, asking, processors
from .engines.drive import drive
from .engines.worker import Kit
from .progress import Progress
from .rows import StudyRows


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
