"""Contract of an engine: the workers to which shares of rows are sent, and the work that each of them does."""

from __future__ import annotations

import os
import threading
import time
from collections import OrderedDict
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, Protocol

from ... import __version__, _core
from ..._errors import EngineError, PlatewashError

#: Most studies that a worker keeps at hand; those of a cluster live long.
MOST_KEPT = 4

#: The line of a row, the seconds that it took, and its plan where the study keeps it.
Made = tuple[bytes, float, "bytes | None"]


@dataclass(frozen=True)
class Kit:
    """What a worker needs of a study, sent to each once."""

    #: Name of this call of ``run``.
    token: str
    #: Version of the package that made it.
    version: str
    #: The study.
    parts: bytes
    #: Whether rows are kept empty: what an engine costs by itself is measured so.
    is_empty: bool = False


@dataclass(frozen=True)
class Share:
    """Rows that a worker is given at once."""

    indices: tuple[int, ...]
    #: After so long no further row is begun [s].
    longest_s: float


_lock = threading.Lock()
_kept: OrderedDict[str, _core.StudyWorker] = OrderedDict()
_stopped: OrderedDict[str, None] = OrderedDict()


def work(kit: Kit, share: Share) -> list[Made]:
    """Makes rows, until the time is up or it is told to stop: those that it made, at least one unless it was stopped."""
    worker = _worker(kit)
    began, made = time.monotonic(), []
    for index in share.indices:
        one = worker.unplanned(index) if kit.is_empty else worker.make(index)
        if one is None:
            break
        made.append(one)
        if time.monotonic() - began >= share.longest_s:
            break
    return made


def stop(token: str) -> None:
    """Gives up what belongs to a call of ``run``, now and whatever of it comes."""
    with _lock:
        _stopped[token] = None
        while len(_stopped) > 100 * MOST_KEPT:
            _stopped.popitem(last=False)
        worker = _kept.get(token)
    if worker is not None:
        worker.stop()


def _worker(kit: Kit) -> _core.StudyWorker:
    if kit.version != __version__:
        raise EngineError(f"a worker has pyplatewash {__version__}, and the study was sent by {kit.version}: install the same version everywhere")
    with _lock:
        worker = _kept.get(kit.token)
        if worker is None:
            worker = _kept[kit.token] = _core.StudyWorker(kit.parts)
            if kit.token in _stopped:
                worker.stop()
            while len(_kept) > MOST_KEPT:
                _kept.popitem(last=False)
        _kept.move_to_end(kit.token)
        return worker


#: Why a number of workers is refused.
WORKERS = "workers: is for workers that are begun here; a cluster that is there has its own"


class Died(Exception):
    """The worker process died while it had the share; the rows are not there."""


@contextmanager
def asking(cluster: str) -> Iterator[None]:
    """Tells as EngineError what the package of a cluster raises when it is asked: the cluster is gone, or the way to it was closed."""
    try:
        yield
    except (PlatewashError, Died):
        raise
    except Exception as error:
        raise EngineError(f"the {cluster} cluster does not answer any more: {type(error).__name__}: {error}") from error


def given_back(cluster: str, error: BaseException) -> PlatewashError:
    """What to raise for the fault with which a share came back."""
    return error if isinstance(error, PlatewashError) else EngineError(f"{cluster} gave a share back: {type(error).__name__}: {error}")


def processors() -> int:
    """The processors that this process may use."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:
        return os.cpu_count() or 1


class Engine(Protocol):
    """Workers. What is not for a share of rows to say, such as a cluster that is gone, raises EngineError or what its package raises."""

    #: Shares that are sent for each worker: more than one where the way to it takes long.
    depth: int
    #: Whether a worker's death tells of no other share than the one that it worked on.
    blames_exactly: bool

    def slots(self) -> int:
        """How many workers there are now."""
        ...

    def send(self, share: Share) -> Any:
        """Sends a share to whoever is free next: a future of the engine's, with ``add_done_callback``."""
        ...

    def rows(self, answer: Any) -> list[Made]:
        """What came of a share that ended. Raises Died; KeyboardInterrupt never."""
        ...

    def stop(self) -> None:
        """Tells all workers to give up; what they have made comes back soon."""
        ...

    def close(self) -> None:
        """Lets the workers go; ends those that this engine began."""
        ...
