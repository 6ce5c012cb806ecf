"""Rows of a study through an engine, and back into its folder, which nobody else writes."""

from __future__ import annotations

import queue
import time
import warnings
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from ... import _core
from .contract import Died, Engine, Share, asking

#: How long a share shall take [s]: the way to a worker and back takes some milliseconds.
SHARE_S = 2.0
#: After so long a worker begins no further row of its share [s]: rows differ.
LONGEST_S = 3 * SHARE_S
#: Most rows of a share.
MOST_ROWS = 1000
#: How much of a share's mean counts for the next [-].
NEWEST = 0.3
#: How often a row may kill the worker that works on it alone.
MOST_DEATHS = 2
#: How long rows are waited for that workers have made when they are told to stop [s].
LAST_S = 5.0
#: How long workers may be lacking before that is said [s].
LACKING_S = 10.0
#: Time between two looks for signals [s], and between two questions of how many workers there are.
LOOK_S, ASK_S = 0.2, 2.0


@dataclass
class Shares:
    """The rows that are still to be sent: those that came back undone, then the others in order; and those that are sent alone."""

    missing: Callable[[int], list[int]]
    #: How many there are, but for those that are sent alone.
    left: int
    again: deque[int] = field(default_factory=deque)
    suspects: deque[int] = field(default_factory=deque)
    mean_s: float | None = None

    def size(self, lanes: int) -> int:
        """How many rows the next share has, of which so many are under way at a time: one until it is known how long rows take; towards
        the end fewer, so that all workers end at about the same time."""
        if self.mean_s is None:
            return 1
        by_time = int(SHARE_S / max(self.mean_s, 1e-9))
        return max(1, min(by_time, MOST_ROWS, self.left // (2 * max(lanes, 1))))

    def next(self, lanes: int) -> Share | None:
        """The next share; None where there is nothing to send."""
        most = self.size(lanes)
        indices = [self.again.popleft() for _ in range(min(most, len(self.again)))]
        if len(indices) < most:
            indices += self.missing(most - len(indices))
        self.left -= len(indices)
        return Share(tuple(indices), LONGEST_S) if indices else None

    def took(self, rows: int, seconds: float, undone: Sequence[int]) -> None:
        """Learns from a share that came back."""
        self.again.extend(undone)
        self.left += len(undone)
        if rows:
            mean_s = seconds / rows
            self.mean_s = mean_s if self.mean_s is None else (1 - NEWEST) * self.mean_s + NEWEST * mean_s


def drive(engine: Engine, journal: _core.StudyJournal, rows: int, told: Callable[[int, int], object]) -> None:
    """Works on the rows that the folder lacks. Ended by an exception, Ctrl-C among them, it keeps what the workers had made."""
    driver = _Driver(engine, journal, rows, told)
    try:
        driver.work()
    except BaseException:
        engine.stop()
        driver.drain()
        raise


class _Driver:
    def __init__(self, engine: Engine, journal: _core.StudyJournal, rows: int, told: Callable[[int, int], object]) -> None:
        self._engine, self._name = engine, type(engine).__name__
        self._asked, self._slots = -ASK_S, 0
        self._journal = journal
        self._rows = rows
        self._told = told
        self._shares = Shares(journal.missing, rows - journal.done)
        # What was sent, by its number.
        self._sent = 0
        self._flying: dict[int, tuple[Any, Share]] = {}
        self._ended: queue.SimpleQueue[int] = queue.SimpleQueue()
        # Whether a row is at work that nobody else may be beside.
        self._is_alone = False
        self._deaths: dict[int, int] = {}
        # When there were workers last, or it was said that there are none.
        self._staffed: float | None = time.monotonic()

    def work(self) -> None:
        while self._send():
            try:
                ended = self._ended.get(timeout=LOOK_S)
            except queue.Empty:
                self._look()
                continue
            self._take(ended)

    def _workers(self) -> int:
        if time.monotonic() - self._asked >= ASK_S:
            with asking(self._name):
                self._slots = self._engine.slots()
            self._asked = time.monotonic()
        return self._slots

    def _look(self) -> None:
        """Says once that there are no workers; some may come."""
        if self._workers() > 0:
            self._staffed = time.monotonic()
        elif self._staffed is not None and time.monotonic() - self._staffed >= LACKING_S:
            self._staffed = None
            warnings.warn("study: the cluster has no workers; they are waited for", RuntimeWarning, stacklevel=2)

    def drain(self) -> None:
        """Keeps what comes back within some seconds."""
        until = time.monotonic() + LAST_S
        while self._flying and time.monotonic() < until:
            try:
                self._take(self._ended.get(timeout=LOOK_S))
            except queue.Empty:
                continue
            except Exception:  # The first fault is the one that is told.
                continue

    def _send(self) -> bool:
        """Sends what workers are free for; whether anything is under way."""
        lanes = max(self._workers(), 1) * self._engine.depth
        while len(self._flying) < lanes and not self._is_alone:
            share = self._share(lanes)
            if share is None:
                break
            self._sent += 1
            with asking(self._name):
                answer = self._engine.send(share)
            self._flying[self._sent] = answer, share
            answer.add_done_callback(partial(self._is_done, self._sent))
        return bool(self._flying)

    def _share(self, lanes: int) -> Share | None:
        """What is sent next. A row that may have killed a worker goes by itself: at once where nobody else is blamed for it, else when
        all others are done."""
        suspects = self._shares.suspects
        if self._engine.blames_exactly:
            return Share((suspects.popleft(),), LONGEST_S) if suspects else self._shares.next(lanes)
        share = self._shares.next(lanes)
        if share is None and suspects and not self._flying:
            self._is_alone = True
            share = Share((suspects.popleft(),), LONGEST_S)
        return share

    def _is_done(self, number: int, _answer: object) -> None:
        self._ended.put(number)

    def _take(self, number: int) -> None:
        answer, share = self._flying.pop(number)
        self._is_alone = False
        try:
            with asking(self._name):
                made = self._engine.rows(answer)
        except Died:
            self._died(share)
            return
        for line, wall_s, plan in made:
            self._journal.append(line, wall_s, plan)
        self._shares.took(len(made), sum(wall_s for _, wall_s, _ in made), share.indices[len(made) :])
        self._told(self._journal.done, self._rows)

    def _died(self, share: Share) -> None:
        if len(share.indices) > 1:
            self._shares.suspects.extend(share.indices)
            return
        index = next(iter(share.indices))
        self._deaths[index] = self._deaths.get(index, 0) + 1
        if self._deaths[index] < MOST_DEATHS:
            self._shares.suspects.append(index)
            return
        self._journal.killed(index)
        self._told(self._journal.done, self._rows)
