"""Workers of a Dask cluster."""

from __future__ import annotations

import pickle
import time
from contextlib import suppress
from typing import Any

from ..._errors import EngineError, MissingError, PlatewashError
from .contract import Died, asking
from .here import processors
from .worker import Kit, Made, Share, stop, work

MISSING = "engine 'dask' needs distributed, which is not installed: pip install 'pyplatewash[dask]'"
#: What keeps a program from its own workers, which import it.
GUARD = "a program that calls this states what it does below: if __name__ == '__main__':"
#: Time between two questions of how many workers there are [s].
LOOK_S = 2.0


def _same(kit: Kit) -> Kit:
    return kit


def _packed(kit: Kit, share: Share) -> bytes:
    """What a worker makes, as bytes: Dask would look into a list of rows one by one."""
    return pickle.dumps(work(kit, share))


class Dask:
    """An engine of a cluster that is there, or of one on this machine, which ends with it."""

    depth = 2
    # A worker's death is put down to every share that it had.
    blames_exactly = False

    def __init__(self, kit: Kit, workers: int | None, client: Any, address: str | None) -> None:
        try:
            import distributed as package
        except ModuleNotFoundError as error:
            if error.name is None or error.name.split(".")[0] not in ("distributed", "dask"):
                raise
            raise MissingError(MISSING, name="distributed") from error
        distributed: Any = package
        self._killed = distributed.scheduler.KilledWorker
        self._cluster: Any = None
        self._is_own = client is None
        if client is None and address is None:
            try:
                self._cluster = distributed.LocalCluster(n_workers=workers or processors(), threads_per_worker=1, dashboard_address=None)
            except (OSError, RuntimeError) as error:
                raise EngineError(f"no Dask cluster begins on this machine: {error}; {GUARD}") from error
        try:
            self._client: Any = client or distributed.Client(address or self._cluster)
        except (OSError, ValueError) as error:
            raise EngineError(f"address: no Dask scheduler answers at '{address}': {error}") from error
        self._token = kit.token
        # A task, not data that is scattered: where the workers that have it are lost, it is made again.
        with asking("Dask"):
            self._kit = self._client.submit(_same, kit, key=f"platewash-{kit.token}-kit", pure=False)
        self._sent = 0
        self._looked, self._slots = -LOOK_S, 0
        self._futures: set[Any] = set()

    def slots(self) -> int:
        if time.monotonic() - self._looked >= LOOK_S:
            with asking("Dask"):
                self._slots = sum(self._client.nthreads().values())
            self._looked = time.monotonic()
        return self._slots

    def send(self, share: Share) -> Any:
        self._sent += 1
        with asking("Dask"):
            future = self._client.submit(_packed, self._kit, share, key=f"platewash-{self._token}-{self._sent}", pure=False)
        self._futures.add(future)
        return future

    def rows(self, answer: Any) -> list[Made]:
        self._futures.discard(answer)
        with asking("Dask"):
            error = answer.exception()
        if isinstance(error, self._killed):
            raise Died(str(error))
        if isinstance(error, PlatewashError):
            raise error
        if error is not None:
            raise EngineError(f"Dask gave a share back: {type(error).__name__}: {error}") from error
        with asking("Dask"):
            made: list[Made] = pickle.loads(answer.result())
            answer.release()
        return made

    def stop(self) -> None:
        if self._client.status != "running":
            return
        # Workers answer this beside what they work on; what waits for one is given up where it begins.
        with suppress(Exception):
            self._client.run(stop, self._token, on_error="ignore")

    def close(self) -> None:
        # What a cluster says that is gone was told before.
        for future in [*self._futures, self._kit]:
            with suppress(Exception):
                future.release()
        for mine in [self._client if self._is_own else None, self._cluster]:
            with suppress(Exception):
                if mine is not None:
                    mine.close()
