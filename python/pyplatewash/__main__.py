"""The command ``platewash``, also as ``python -m pyplatewash``: the same code as the Rust program."""

from __future__ import annotations

import signal
import sys

from . import _core


def main() -> None:
    """Runs the command with the arguments of this process and ends with its exit code."""
    # Python only notes Ctrl-C, for later; the program answers it itself. One that was started to ignore it, in the background of a
    # shell or by nohup, keeps ignoring it.
    if signal.getsignal(signal.SIGINT) is not signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.exit(_core._program(sys.argv[1:]))


if __name__ == "__main__":
    main()
