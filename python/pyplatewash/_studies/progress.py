"""How far a study is, for who waits."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from types import TracebackType
from typing import Any

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
