"""Workers that are processes of this machine, each of its own: the death of one tells of no other."""

from __future__ import annotations

import os
import pickle
import queue
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from typing import IO, Any

from .contract import Died
from .worker import Kit, Made, Share, stop, work

#: What a process runs, which imports what this one would.
BEGIN = f"import sys; sys.path[:] = {{path!r}}; from {__name__} import main; main()"
#: How long a process that was told to stop is waited for [s].
LONGEST_S = 10.0


class Processes:
    """An engine of so many processes. What it is sent and sends back goes through its standard input and output, which it
    does not share with anything else: where this process ends, however it does, they end too."""

    depth = 1
    blames_exactly = True

    def __init__(self, kit: Kit, workers: int) -> None:
        self._workers = workers
        self._kit = kit
        self._seats: queue.SimpleQueue[_Seat] = queue.SimpleQueue()
        self._all = [_Seat(kit) for _ in range(workers)]
        for seat in self._all:
            self._seats.put(seat)
        self._threads = ThreadPoolExecutor(workers, thread_name_prefix="platewash study")

    def slots(self) -> int:
        return self._workers

    def send(self, share: Share) -> Any:
        return self._threads.submit(self._work, share)

    def rows(self, answer: Any) -> list[Made]:
        made: list[Made] = answer.result()
        return made

    def stop(self) -> None:
        for seat in self._all:
            seat.stop()

    def close(self) -> None:
        self.stop()
        self._threads.shutdown(cancel_futures=True)
        for seat in self._all:
            seat.end()

    def _work(self, share: Share) -> list[Made]:
        seat = self._seats.get()
        try:
            return seat.work(share)
        finally:
            self._seats.put(seat)


class _Seat:
    """A place for a process: one that died is followed by another."""

    def __init__(self, kit: Kit) -> None:
        self._kit = kit
        self._process: subprocess.Popen[bytes] | None = None
        self._is_stopped = False
        self._lock = threading.Lock()

    def work(self, share: Share) -> list[Made]:
        """What the process makes of a share. Raises Died, and what it raised."""
        with self._lock:
            if self._is_stopped:
                return []
            process = self._process or self._begun()
        try:
            _write(process.stdin, share)
            answer = _read(process.stdout)
        except (OSError, EOFError, pickle.UnpicklingError, ValueError):
            process.kill()
            process.wait()
            with self._lock:
                self._process = None
            if self._is_stopped:
                return []
            raise Died(f"a worker process ended with {process.returncode}") from None
        if isinstance(answer, BaseException):
            raise answer
        made: list[Made] = answer
        return made

    def stop(self) -> None:
        """Nothing more is begun; what is under way comes back soon."""
        with self._lock:
            self._is_stopped = True
            process = self._process
        if process is not None and process.stdin is not None:
            try:
                process.stdin.close()
            except OSError:
                pass

    def end(self) -> None:
        """Waits for the process."""
        process = self._process
        if process is None:
            return
        try:
            process.wait(LONGEST_S)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
        if process.stdout is not None:
            process.stdout.close()

    def _begun(self) -> subprocess.Popen[bytes]:
        line = [sys.executable, "-c", BEGIN.format(path=sys.path)]
        # A session of its own, or on Windows a group (CREATE_NEW_PROCESS_GROUP): Ctrl-C of a terminal is for whoever reads what comes back.
        windows = sys.platform == "win32"
        process = subprocess.Popen(
            line, stdin=subprocess.PIPE, stdout=subprocess.PIPE, start_new_session=not windows, creationflags=0x200 if windows else 0
        )
        self._process = process
        _write(process.stdin, self._kit)
        return process


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
    kit: Kit = _read(questions)
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
