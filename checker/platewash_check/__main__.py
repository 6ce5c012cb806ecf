"""`python -m platewash_check PLAN.json`: confirms a plan, requirement by requirement."""

import argparse
import json
import math
import signal
import sys
import time
from dataclasses import asdict
from pathlib import Path

from .arm import Arm
from .check import check
from .plan import Plan
from .schema import Refused
from .verdict import CONFIRMED

DONE, BAD_INPUT, NOT_CONFIRMED = 0, 2, 4


def text(path):
    try:
        return Path(path).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise Refused(f"{path}: cannot be read: {error}") from None


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="platewash_check", description=__doc__)
    parser.add_argument("plan", help="plan file, as `platewash run` writes it")
    parser.add_argument("--urdf", default="urdf/irb120.urdf", help="description of the arm [default: %(default)s]")
    parser.add_argument("--srdf", help="SRDF of the arm [default: the file beside the description with the ending .srdf]")
    parser.add_argument("--json", action="store_true", help="print the answers as JSON")
    parser.add_argument("--exact", type=int, metavar="N", help="evaluate N random moments again in ball arithmetic")
    options = parser.parse_args(arguments)
    began = time.time()
    if hasattr(signal, "SIGPIPE"):
        # Whoever reads the answers may stop early.
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)

    def progress(words):
        if sys.stderr.isatty():
            print(f"\r{words:<60}", end="", file=sys.stderr)

    try:
        beside = Path(options.urdf).with_suffix(".srdf")
        srdf = options.srdf or (str(beside) if beside.exists() else None)
        arm = Arm(text(options.urdf), text(srdf) if srdf else None, Path(options.urdf).parent)
        answers = list(check(arm, Plan(text(options.plan)), progress, options.exact or 0))
    except Refused as refused:
        print(f"error: {refused}", file=sys.stderr)
        return BAD_INPUT
    progress("")
    open_ones = [answer for answer in answers if answer.status != CONFIRMED]
    first = "CONFIRMED" if not open_ones else "NOT CONFIRMED"
    count = f"{len(answers) - len(open_ones)} of {len(answers)} requirements confirmed in {time.time() - began:.1f} s"
    if options.json:
        # JSON has no infinity: a bound that is none is left out.
        finite = lambda x: None if isinstance(x, float) and not math.isfinite(x) else x
        rows = [{key: finite(value) for key, value in asdict(answer).items()} for answer in answers]
        table = {"confirmed": not open_ones, "headline": f"{first}: {count}", "answers": rows}
        said = json.dumps(table)
    else:
        said = "\n".join([f"{first}: {count}"] + [answer.line() for answer in answers])
    print(said, flush=True)
    return DONE if not open_ones else NOT_CONFIRMED


if __name__ == "__main__":
    sys.exit(main())
