"""Workers that die at certain rows, for engines that are tested with them."""

import importlib
import os
import pickle
import signal

from pyplatewash._studies.engines import contract, processes
from pyplatewash._studies.engines.contract import Kit, Made, Share

#: The row that nobody survives.
DEADLY = 5


def work(kit: Kit, share: Share) -> list[Made]:
    """As a worker does, but for one row."""
    if DEADLY in share.indices:
        os.kill(os.getpid(), signal.SIGKILL)
    return contract.work(kit, share)


def packed(kit: Kit, share: Share) -> bytes:
    """The same as bytes."""
    return pickle.dumps(work(kit, share))


def lacking(kit: Kit, share: Share) -> bytes:
    """What becomes of a worker without the package."""
    importlib.import_module("pyplatewash.none")
    return packed(kit, share)


def main() -> None:
    """A worker process that works so."""
    vars(processes)["work"] = work
    processes.main()
