"""What an engine is: somebody else's workers, to whom shares of rows are sent."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Protocol

from ..._errors import EngineError, PlatewashError
from .worker import Made, Share

#: Why a number of workers is refused.
WORKERS = "workers: is for workers that are begun here; a cluster that is there has its own"


class Died(Exception):
    """The worker process died while it had the share; the rows are not there."""


@contextmanager
def asking(cluster: str) -> Iterator[None]:
    """Tells as EngineError what the package of a cluster raises when it is asked: the cluster is gone, or the way to it was closed."""
    try:
        yield
    except (PlatewashError, Died):
        raise
    except Exception as error:
        raise EngineError(f"the {cluster} cluster does not answer any more: {type(error).__name__}: {error}") from error


def given_back(cluster: str, error: BaseException) -> PlatewashError:
    """What to raise for the fault with which a share came back."""
    return error if isinstance(error, PlatewashError) else EngineError(f"{cluster} gave a share back: {type(error).__name__}: {error}")


def processors() -> int:
    """The processors that this process may use."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:
        return os.cpu_count() or 1


class Engine(Protocol):
    """Workers. What is not for a share of rows to say, such as a cluster that is gone, raises EngineError or what its package raises."""

    #: Shares that are sent for each worker: more than one where the way to it takes long.
    depth: int
    #: Whether a worker's death tells of no other share than the one that it worked on.
    blames_exactly: bool

    def slots(self) -> int:
        """How many workers there are now."""
        ...

    def send(self, share: Share) -> Any:
        """Sends a share to whoever is free next: a future of the engine's, with ``add_done_callback``."""
        ...

    def rows(self, answer: Any) -> list[Made]:
        """What came of a share that ended. Raises Died; KeyboardInterrupt never."""
        ...

    def stop(self) -> None:
        """Tells all workers to give up; what they have made comes back soon."""
        ...

    def close(self) -> None:
        """Lets the workers go; ends those that this engine began."""
        ...
