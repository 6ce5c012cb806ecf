"""Questions of a page, each answered on a thread of its own: one of a lane at a time, and always the newest."""

from __future__ import annotations

import atexit
import threading
import weakref
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from . import _core

#: How long a thread that was told to give up is waited for [s]: some milliseconds, unless an observer of the caller's keeps it.
LONGEST_S = 10.0


@dataclass(frozen=True)
class Asked:
    """A question, who asked it, and how often the caller had set the scenario before."""

    #: The page.
    view: str
    #: The page's name for the question.
    number: Any
    #: Kind of work: a page has one of each under way beside one another.
    lane: str
    changes: int
    question: _core.CellQuestion


class Questions:
    """Threads that answer, which are there only while there is something to answer."""

    def __init__(self, answer: Callable[[Asked], None], give_up: Callable[[Asked], None]) -> None:
        """``answer`` is called on a thread; ``give_up`` for a question that a newer one replaced before its turn."""
        self._answer = answer
        self._give_up = give_up
        self._lock = threading.Lock()
        self._running: dict[str, Asked] = {}
        self._next: dict[str, Asked] = {}
        self._threads: dict[str, threading.Thread] = {}
        self._is_closed = False
        _open.add(self)

    @property
    def is_closed(self) -> bool:
        """Whether nothing is answered any more."""
        return self._is_closed

    def ask(self, asked: Asked) -> None:
        """Answers a question; the one of its lane that is under way is given up."""
        replaced = None
        with self._lock:
            if self._is_closed:
                return
            lane = asked.lane
            if lane in self._running:
                self._running[lane].question.cancel()
                replaced = self._next.pop(lane, None)
                self._next[lane] = asked
            else:
                # A daemon: `close` ends it, at the latest when the interpreter ends.
                thread = threading.Thread(target=self._work, args=(asked,), name=f"platewash {lane}", daemon=True)
                self._running[lane], self._threads[lane] = asked, thread
                thread.start()
        if replaced is not None:
            self._give_up(replaced)

    def cancel(self, which: Callable[[Asked], bool] = lambda asked: True) -> None:
        """Gives up questions, those that wait and those under way."""
        with self._lock:
            waiting = [asked for asked in self._next.values() if which(asked)]
            for asked in waiting:
                del self._next[asked.lane]
            for asked in self._running.values():
                if which(asked):
                    asked.question.cancel()
        for asked in waiting:
            self._give_up(asked)

    def close(self) -> None:
        """Gives everything up and waits for the threads, but for the one that calls this."""
        with self._lock:
            self._is_closed = True
            threads = list(self._threads.values())
        self.cancel()
        for thread in threads:
            if thread is not threading.current_thread():
                thread.join(LONGEST_S)

    def _work(self, asked: Asked | None) -> None:
        while asked is not None:
            lane = asked.lane
            self._answer(asked)
            with self._lock:
                asked = self._next.pop(lane, None)
                if asked is None:
                    del self._running[lane], self._threads[lane]
                else:
                    self._running[lane] = asked


_open: weakref.WeakSet[Questions] = weakref.WeakSet()


@atexit.register
def _close_all() -> None:
    """While there is an interpreter to come back to: a thread that finds none ends the process."""
    for questions in list(_open):
        questions.close()
