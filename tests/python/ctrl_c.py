"""What tests of Ctrl-C share."""

import signal
import sys

import pytest

no_sigint = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGINT for another process")


def heed_ctrl_c() -> None:
    """For ``preexec_fn``: the child heeds Ctrl-C, even where these tests were started to ignore it."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
