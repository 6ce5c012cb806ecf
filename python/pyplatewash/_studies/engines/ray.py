"""Workers of a Ray cluster."""

from __future__ import annotations

import os
import socket
import time
from contextlib import suppress
from typing import Any
from urllib.parse import urlsplit

from ..._errors import EngineError, InputError, MissingError, PlatewashError
from .contract import WORKERS, Died, asking
from .here import processors
from .worker import Kit, Made, Share, work

MISSING = "engine 'ray' needs ray, which is not installed: pip install 'pyplatewash[ray]'"
#: Time between two questions of how many processors there are [s].
LOOK_S = 2.0
#: How long somebody is waited for who answers at an address [s].
ANSWER_S = 10.0


class Ray:
    """An engine of a Ray session that is there, of a cluster at an address, or of one on this machine, which ends with it."""

    depth = 2
    # A worker has one task at a time.
    blames_exactly = True

    def __init__(self, kit: Kit, workers: int | None, address: str | None) -> None:
        try:
            import ray as package
        except ModuleNotFoundError as error:
            if error.name is None or error.name.split(".")[0] != "ray":
                raise
            raise MissingError(MISSING, name="ray") from error
        ray: Any = package
        self._ray = ray
        self._is_own = not ray.is_initialized()
        if self._is_own:
            # As `ray.init` itself would.
            _begin(ray, workers, address or os.environ.get("RAY_ADDRESS"))
        else:
            _refuse_beside_a_session(workers, address)
        self._died = (ray.exceptions.WorkerCrashedError, ray.exceptions.NodeDiedError, ray.exceptions.OutOfMemoryError)
        self._work: Any = ray.remote(num_cpus=1, max_retries=0)(work)
        with asking("Ray"):
            self._kit = ray.put(kit)
        self._refs: dict[Any, Any] = {}
        self._looked, self._slots = -LOOK_S, 0

    def slots(self) -> int:
        if time.monotonic() - self._looked >= LOOK_S:
            with asking("Ray"):
                self._slots = int(self._ray.cluster_resources().get("CPU", 0))
            self._looked = time.monotonic()
        return self._slots

    def send(self, share: Share) -> Any:
        with asking("Ray"):
            ref = self._work.remote(self._kit, share)
            future = ref.future()
        self._refs[future] = ref
        return future

    def rows(self, answer: Any) -> list[Made]:
        self._refs.pop(answer, None)
        with asking("Ray"):
            error = answer.exception()
        if isinstance(error, self._died):
            raise Died(str(error))
        if isinstance(error, self._ray.exceptions.TaskCancelledError):
            return []
        if isinstance(error, self._ray.exceptions.RayTaskError):
            if isinstance(error.cause, KeyboardInterrupt):
                return []  # It was told to stop.
            if isinstance(error.cause, PlatewashError):
                raise error.cause
        if error is not None:
            raise EngineError(f"Ray gave a share back: {error}") from error
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
