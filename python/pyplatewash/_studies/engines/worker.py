"""What a worker of any engine does: rows of a study, one after the other, from what was sent to it alone."""

from __future__ import annotations

import threading
import time
from collections import OrderedDict
from dataclasses import dataclass

from ... import __version__, _core
from ..._errors import EngineError

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
