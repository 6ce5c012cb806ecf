"""Workers of a Ray cluster."""

from __future__ import annotations

import os
import socket
from contextlib import suppress
from typing import Any
from urllib.parse import urlsplit

from ..._errors import EngineError, InputError
from ..table import needed
from .contract import WORKERS, Died, Kit, Made, Share, given_back, processors, work

#: How long somebody is waited for who answers at an address [s].
ANSWER_S = 10.0


class Ray:
    """An engine of a Ray session that is there, of a cluster at an address, or of one on this machine, which ends with it."""

    depth = 2
    # A worker has one task at a time.
    blames_exactly = True

    def __init__(self, kit: Kit, workers: int | None, address: str | None) -> None:
        self._ray = ray = needed("ray", "engine 'ray' needs", "ray")
        self._is_own = not ray.is_initialized()
        if self._is_own:
            # As `ray.init` itself would.
            _begin(ray, workers, address or os.environ.get("RAY_ADDRESS"))
        else:
            _refuse_beside_a_session(workers, address)
        self._died = (ray.exceptions.WorkerCrashedError, ray.exceptions.NodeDiedError, ray.exceptions.OutOfMemoryError)
        self._work = ray.remote(num_cpus=1, max_retries=0)(work)
        self._kit = ray.put(kit)
        self._refs: dict[Any, Any] = {}

    def slots(self) -> int:
        return int(self._ray.cluster_resources().get("CPU", 0))

    def send(self, share: Share) -> Any:
        ref = self._work.remote(self._kit, share)
        future = ref.future()
        self._refs[future] = ref
        return future

    def rows(self, answer: Any) -> list[Made]:
        self._refs.pop(answer, None)
        error = answer.exception()
        if isinstance(error, self._died):
            raise Died(str(error))
        cause = error.cause if isinstance(error, self._ray.exceptions.RayTaskError) else error
        if isinstance(cause, (KeyboardInterrupt, self._ray.exceptions.TaskCancelledError)):
            return []  # It was told to stop.
        if cause is not None:
            raise given_back("Ray", cause) from error
        made: list[Made] = answer.result()
        return made

    def stop(self) -> None:
        for ref in list(self._refs.values()):
            with suppress(Exception):
                self._ray.cancel(ref)

    def close(self) -> None:
        self._refs.clear()
        if self._is_own:
            self._ray.shutdown()


def _begin(ray: Any, workers: int | None, address: str | None) -> None:
    """Begins a session: with the cluster at an address, or with one of this machine."""
    own: dict[str, Any] = {} if address else {"num_cpus": workers or processors(), "include_dashboard": False}
    if address and workers is not None:
        raise InputError(WORKERS, argument="workers")
    try:
        # Ray itself takes minutes to find out that nobody is there.
        place = urlsplit(address if address and "//" in address else f"//{address or ''}")
        if place.hostname and place.port:
            socket.create_connection((place.hostname, place.port), ANSWER_S).close()
        ray.init(address=address, log_to_driver=False, **own)
    except (OSError, ValueError, RuntimeError) as error:
        where = f"address: no Ray cluster answers at '{address}'" if address else "no Ray cluster begins on this machine"
        raise EngineError(f"{where}: {error}") from error


def _refuse_beside_a_session(workers: int | None, address: str | None) -> None:
    for name, given in (("workers", workers), ("address", address)):
        if given is not None:
            words = f"{name}: this process has a Ray session already, whose workers are taken; leave it out, or end the session by ray.shutdown()"
            raise InputError(words, argument=name)
