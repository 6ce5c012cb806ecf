"""Workers of a Dask cluster."""

from __future__ import annotations

import pickle
from contextlib import suppress
from typing import Any

from ..._errors import EngineError
from ..table import needed
from .contract import Died, Kit, Made, Share, given_back, processors, stop, work

#: What keeps a program from its own workers, which import it.
GUARD = "a program that calls this states what it does below: if __name__ == '__main__':"


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
        distributed = needed("distributed", "engine 'dask' needs", "dask")
        self._killed = distributed.scheduler.KilledWorker
        self._token = kit.token
        self._workers = workers or processors()
        self._cluster: Any = None
        #: What ends with this engine.
        self._own: list[Any] = []
        if client is None and address is None:
            try:
                self._cluster = distributed.LocalCluster(n_workers=self._workers, threads_per_worker=1, dashboard_address=None)
            except (OSError, RuntimeError) as error:
                raise EngineError(f"no Dask cluster begins on this machine: {error}; {GUARD}") from error
            self._own.append(self._cluster)
        if client is None:
            try:
                client = distributed.Client(address or self._cluster)
            except (OSError, ValueError) as error:
                raise EngineError(f"address: no Dask scheduler answers at '{address}': {error}") from error
            self._own.insert(0, client)
        self._client = client
        # A task, not data that is scattered: where the workers that have it are lost, it is made again.
        self._kit = client.submit(_same, kit, pure=False)

    def slots(self) -> int:
        if self._cluster is not None:
            # A local cluster gives up a worker that is not there 15 s after it died: because it died again, or begins slowly.
            self._cluster.scale(self._workers)
        return sum(self._client.nthreads().values())

    def send(self, share: Share) -> Any:
        return self._client.submit(_packed, self._kit, share, pure=False)

    def rows(self, answer: Any) -> list[Made]:
        error = answer.exception()
        if isinstance(error, self._killed):
            raise Died(str(error))
        if error is not None:
            raise given_back("Dask", error) from error
        made: list[Made] = pickle.loads(answer.result())
        return made

    def stop(self) -> None:
        # Workers answer this beside what they work on; what waits for one is given up where it begins. Who is gone was told before.
        with suppress(Exception):
            if self._client.status == "running":
                self._client.run(stop, self._token, on_error="ignore")

    def close(self) -> None:
        self._kit = None
        for mine in self._own:
            with suppress(Exception):
                mine.close()
