"""Workers of a Ray cluster."""

from __future__ import annotations

import time
from typing import Any

from ..._errors import EngineError, MissingError, PlatewashError
from .contract import Died
from .worker import Kit, Made, Share, work

MISSING = "engine 'ray' needs ray, which is not installed: pip install 'pyplatewash[ray]'"
#: Time between two questions of how many processors there are [s].
LOOK_S = 2.0


class Ray:
    """An engine of a Ray session that is there, of a cluster at an address, or of one on this machine, which ends with it."""

    depth = 2
    # A worker has one task at a time.
    blames_exactly = True

    def __init__(self, kit: Kit, workers: int, address: str | None) -> None:
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
            try:
                own: dict[str, Any] = {} if address else {"num_cpus": workers, "include_dashboard": False}
                ray.init(address=address, log_to_driver=False, **own)
            except (ConnectionError, ValueError, RuntimeError) as error:
                raise EngineError(f"address: no Ray cluster answers at '{address}': {error}") from error
        self._died = (ray.exceptions.WorkerCrashedError, ray.exceptions.NodeDiedError, ray.exceptions.OutOfMemoryError)
        self._work: Any = ray.remote(num_cpus=1, max_retries=0)(work)
        self._kit = ray.put(kit)
        self._refs: dict[Any, Any] = {}
        self._looked, self._slots = -LOOK_S, 0

    def slots(self) -> int:
        if time.monotonic() - self._looked >= LOOK_S:
            self._slots = int(self._ray.cluster_resources().get("CPU", 0))
            self._looked = time.monotonic()
        return self._slots

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
            self._ray.cancel(ref)

    def close(self) -> None:
        self._refs.clear()
        if self._is_own:
            self._ray.shutdown()
