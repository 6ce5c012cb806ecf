"""Workers that are processes of this machine: the death of one tells of no other."""

from __future__ import annotations

import os
import pickle
import queue
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from typing import IO, Any

from ..._errors import EngineError
from .contract import Died, Kit, Made, Share, stop, work

#: What a process runs. It imports what this one would, and never the program that calls it.
BEGIN = f"import sys; sys.path[:] = {{path!r}}; from {__name__} import main; main()"
#: What a process says once it has begun: one that dies before tells of no row.
READY = b"ready"
#: How often a process is begun that dies at once.
MOST_STARTS = 3
#: What the end of a process shows as.
FAULTS = (OSError, EOFError, pickle.UnpicklingError, ValueError)
#: How long a process that was told to stop is waited for [s].
LONGEST_S = 10.0


class Processes:
    """An engine of so many processes, each with a thread that asks it. What it is sent and sends back goes through its standard
    input and output, which it does not share with anything else: where this process ends, however it does, they end too."""

    depth = 1
    blames_exactly = True

    def __init__(self, kit: Kit, workers: int) -> None:
        self._kit, self._workers = kit, workers
        self._threads = ThreadPoolExecutor(workers, thread_name_prefix="platewash study")
        self._idle: list[subprocess.Popen[bytes]] = []
        self._all: set[subprocess.Popen[bytes]] = set()
        self._is_stopped = False
        #: For what is begun and what is told to stop.
        self._lock = threading.Lock()

    def slots(self) -> int:
        return self._workers

    def send(self, share: Share) -> Any:
        return self._threads.submit(self._work, share)

    def rows(self, answer: Any) -> list[Made]:
        made: list[Made] = answer.result()
        return made

    def stop(self) -> None:
        with self._lock:
            self._is_stopped = True
            for process in self._all:
                _close(process.stdin)

    def close(self) -> None:
        self.stop()
        self._threads.shutdown(cancel_futures=True)
        for process in list(self._all):
            with suppress(subprocess.TimeoutExpired):
                process.wait(LONGEST_S)
            self._end(process)

    def _work(self, share: Share) -> list[Made]:
        """What a process makes of a share. Raises Died, EngineError where no process begins, and what it raised."""
        process = self._idle.pop() if self._idle else self._begun()
        if process is None:
            return []
        try:
            _write(process.stdin, share)
            answer = _read(process.stdout)
        except FAULTS:
            code = self._end(process)
            if self._is_stopped:
                return []
            raise Died(f"a worker process ended with {code}") from None
        self._idle.append(process)
        if isinstance(answer, BaseException):
            raise answer
        made: list[Made] = answer
        return made

    def _begun(self) -> subprocess.Popen[bytes] | None:
        """A process that has begun; None where it was told to stop."""
        code = None
        for _ in range(MOST_STARTS):
            with self._lock:
                if self._is_stopped:
                    return None
                process = _started()
                self._all.add(process)
            try:
                _write(process.stdin, self._kit)
                if _read(process.stdout) == READY:
                    return process
            except FAULTS:
                pass
            code = self._end(process)
        raise EngineError(f"no worker process begins: '{sys.executable}' ended {MOST_STARTS} times before it was ready, with {code}")

    def _end(self, process: subprocess.Popen[bytes]) -> int:
        """Ends a process that is of no use; how it ended."""
        process.kill()
        with self._lock:
            self._all.discard(process)
        _close(process.stdin)
        _close(process.stdout)
        return process.wait()


def _started() -> subprocess.Popen[bytes]:
    # A session of its own, or on Windows a group (CREATE_NEW_PROCESS_GROUP): Ctrl-C of a terminal is for whoever reads what comes back.
    windows = sys.platform == "win32"
    line = [sys.executable or "python", "-c", BEGIN.format(path=sys.path)]
    try:
        return subprocess.Popen(
            line, stdin=subprocess.PIPE, stdout=subprocess.PIPE, start_new_session=not windows, creationflags=0x200 if windows else 0
        )
    except OSError as error:
        raise EngineError(f"no worker process begins: '{line[0]}': {error.strerror}") from error


def _close(stream: IO[bytes] | None) -> None:
    assert stream is not None
    with suppress(OSError):
        stream.close()


def _write(stream: IO[bytes] | None, what: object) -> None:
    assert stream is not None
    pickle.dump(what, stream)
    stream.flush()


def _read(stream: IO[bytes] | None) -> Any:
    assert stream is not None
    return pickle.load(stream)


def main() -> None:
    """A worker: shares come in until the input ends, rows go out."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # Whatever is printed goes where messages go.
    questions = sys.stdin.buffer
    try:
        kit: Kit = _read(questions)
    except EOFError:
        return  # It was told to stop.
    _write(answers, READY)
    shares: queue.SimpleQueue[Share | None] = queue.SimpleQueue()

    def listen() -> None:
        try:
            while True:
                shares.put(_read(questions))
        except (EOFError, OSError, pickle.UnpicklingError):
            stop(kit.token)
            shares.put(None)

    threading.Thread(target=listen, daemon=True).start()
    while (share := shares.get()) is not None:
        try:
            answer: object = work(kit, share)
        except Exception as error:
            answer = error
        try:
            _write(answers, answer)
        except OSError:
            break  # Nobody reads any more.
