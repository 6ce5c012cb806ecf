"""Small synthetic stand-ins for plans and arms, and dense samples of what the checker bounds."""

import json
from pathlib import Path

import numpy as np
from platewash_check.arm import Arm
from platewash_check.motion import Motion
from platewash_check.plan import Plan

ROOT = Path(__file__).resolve().parents[2]


def irb120():
    """The arm of the repository."""
    read = lambda name: (ROOT / "urdf" / name).read_text(encoding="utf-8")
    return Arm(read("irb120.urdf"), read("irb120.srdf"))


def sealed(table):
    """The text of a plan after a change, with a hash that matches it."""
    import hashlib
    import re

    text = json.dumps(table, separators=(",", ":"), sort_keys=True)
    rest = re.sub(r'"hash":"[0-9a-f]*",', "", text, count=1)
    return text.replace(table["hash"], hashlib.sha256(rest.encode()).hexdigest(), 1)


def random_motion(rng, knots=6):
    """A motion of the arm through random knots."""
    t = np.cumsum(np.r_[0, rng.uniform(0.05, 0.4, knots - 1)])
    return Motion(t, rng.uniform(-1, 1, (knots, 6)), rng.uniform(-1, 1, (knots, 6)))


def plan(path):
    return Plan(Path(path).read_text(encoding="utf-8"))
