"""Changed plans, many of them: each requirement is refused by itself, and nothing is confirmed that a dense sample refutes.

    PLATEWASH_BIN=target/release/platewash python checker/tests/mutations.py PLAN.json --each 20

Knots, limits, plates, tool and obstacles are changed at random, and the plan is sealed again; or the arm has narrower limits.
"""

import argparse
import collections
import json
import sys
from pathlib import Path

import numpy as np

sys.path[:0] = [str(Path(__file__).resolve().parent), str(Path(__file__).resolve().parents[1])]

from jobs import irb120, sealed
from platewash_check.check import check
from platewash_check.clearance import Clearance
from platewash_check.motion import Instant, Motion
from platewash_check.plan import Plan
from platewash_check.washing import Washing
from test_command import MUTATIONS


def knots(table, rng):
    """A knot that is moved, or passed at another speed."""
    k, joint = int(rng.integers(1, len(table["knots"]["t_s"]) - 1)), int(rng.integers(0, 6))
    key = str(rng.choice(["q_rad", "qd_rad_s"]))
    table["knots"][key][k][joint] += float(rng.choice([-1, 1]) * 10 ** rng.uniform(-5, -1))


def lower_limit(arm, name, rng):
    """An arm that turns less far, or less fast, at joint 1, 2 or 3."""
    joint = int(rng.integers(0, 3))
    if name == "joint_speed":
        arm.speed[joint] *= rng.uniform(0.02, 0.1)
    else:
        arm.upper[joint], arm.lower[joint] = rng.uniform(-0.2, 0), -3.0


def sampled(arm, plan):
    """Worst values at single moments, every 0.5 ms: what a requirement's bound cannot be better than."""
    motion = Motion(plan.t, plan.q, plan.qd)
    washing = Washing(arm, plan, motion)
    found = collections.defaultdict(lambda: -np.inf)

    def note(name, values):
        found[name] = max(found[name], float(np.max(values)))

    for segment in plan.segments:
        first, last = plan.span(segment)
        t = np.arange(plan.t[first], plan.t[last], 5e-4)
        piece = np.clip(np.searchsorted(plan.t, t, side="right") - 1, first, last - 1)
        state = motion.at(piece, t - plan.t[piece])
        instant = Instant(arm, *state[:3], plan.tool.tip)
        speed, acceleration = (np.linalg.norm(x, axis=1) for x in (instant.speed, instant.acceleration))
        note("joint_speed", abs(state[1]) / arm.speed)
        note("joint_acceleration", abs(state[2]) / np.array(plan.limits["joint_acceleration_rad_s2"]))
        note("joint_position", np.maximum(arm.lower - state[0], state[0] - arm.upper))
        if segment["kind"] != "wash":
            note("tip_speed", speed)
            note("tip_acceleration", acceleration)
        if segment["kind"] in ("approach", "wash", "retreat"):
            place, axis = washing.in_plate(segment, instant)
            note("tilt", np.arctan2(np.linalg.norm(axis[:, :2], axis=1), -axis[:, 2]))
        if segment["kind"] == "wash":
            note("wash_speed", speed)
            note("wash_acceleration", acceleration)
            note("contact_height", abs(place[:, 2]))
    return found


LATE = ("clearance", "swept", "pressed", "contact_time", "contact_dose")


def answers(arm, plan, name):
    """Answers on a plan; those that take long only where they are what was changed."""
    found = {}
    for answer in check(arm, plan):
        if answer.requirement in LATE and name not in LATE:
            break
        found[answer.requirement] = answer
        if answer.requirement == name == "clearance":
            break
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("plan")
    parser.add_argument("--each", type=int, default=20, help="changes of each requirement, and of knots ten times as many")
    options = parser.parse_args()
    text = Path(options.plan).read_text()
    refused, alone, wrong, count = collections.Counter(), collections.Counter(), [], 0
    for name in [*MUTATIONS, "joint_position", "joint_speed", *["knots"] * 10]:
        if name == "arm":
            continue
        for _ in range(options.each):
            count += 1
            rng, table = np.random.default_rng(count), json.loads(text)
            arm = irb120()
            if name in ("joint_position", "joint_speed"):
                lower_limit(arm, name, rng)
            else:
                MUTATIONS.get(name, knots)(table, rng)
            plan = Plan(sealed(table))
            if name != "clearance":
                # It takes longest, and is none of what is changed.
                Clearance.run = lambda self, progress: (np.inf, None, 0.0)
            else:
                Clearance.run = RUN
            found = answers(arm, plan, name)
            faults = [r for r, answer in found.items() if answer.status == "not_confirmed"]
            refused.update(faults)
            alone.update(faults if len(faults) == 1 else ())
            for requirement, seen in sampled(arm, plan).items():
                answer = found.get(requirement)
                most = 1.0 if requirement in ("joint_speed", "joint_acceleration") else answer and answer.limit
                if answer and answer.status == "confirmed" and seen > most * (1 + 2e-9) + 1e-9:
                    wrong.append((count, name, requirement, seen, most))
    print(f"{count} plans; refused: {dict(refused)}")
    print(f"refused alone: {dict(alone)}")
    print(f"confirmed, and refuted by a sample: {wrong}")
    return bool(wrong)


RUN = Clearance.run

if __name__ == "__main__":
    sys.exit(main())
