"""Rounding, checked: random moments again in ball arithmetic, whose balls hold the true values (python-flint, optional)."""

import numpy as np

from .motion import Instant
from .schema import Refused
from .verdict import judged
from .washing import ROUND

BITS = 160


def answer(arm, plan, motion, count, seed=0):
    """The greatest difference between this program's numbers and the true ones at random moments, as a share of what is allowed for."""
    try:
        import flint
    except ImportError:
        raise Refused("--exact needs python-flint: pip install python-flint") from None
    flint.ctx.prec = BITS
    rng = np.random.default_rng(seed)
    piece = rng.integers(0, len(motion.h), count)
    u = rng.uniform(size=count) * motion.h[piece]
    state = motion.at(piece, u)
    found = Instant(arm, *state[:3], plan.tool.tip)
    ball = lambda x: flint.arb(float(x))
    worst = 0.0
    for k in range(count):
        knots = motion.t[piece[k] : piece[k] + 2]
        h, at = ball(knots[1]) - ball(knots[0]), ball(u[k])
        i = piece[k]
        ends = np.stack([plan.q[i], plan.q[i + 1], plan.qd[i], plan.qd[i + 1]], axis=1)
        joints = [cubic(h, at, *map(ball, values)) for values in ends]
        true = tip(arm, plan.tool.tip, joints, ball)
        allowed = [np.full(3, ROUND), np.full(3, ROUND)]
        for order, values in ((1, "speed"), (2, "acceleration")):
            slack = (found.levers[k] * motion.rounding[order][piece[k]]).sum()
            allowed.append(np.full(3, ROUND + slack))
        for values, exact, most in zip((found.tip, found.axis, found.speed, found.acceleration), true, allowed):
            for axis in range(3):
                off = abs(ball(values[k, axis]) - exact[axis]).upper()
                worst = max(worst, float(off) / most[axis])
    return judged("rounding", worst, 1.0, "", f"of what is allowed for, at {count} random moments")


def cubic(h, u, q0, q1, v0, v1):
    """Position, speed and acceleration of a joint."""
    m = (q1 - q0) / h
    c2, c3 = (3 * m - 2 * v0 - v1) / h, (v0 + v1 - 2 * m) / (h * h)
    return q0 + u * (v0 + u * (c2 + u * c3)), v0 + u * (2 * c2 + 3 * u * c3), 2 * c2 + 6 * u * c3


def tip(arm, frame, joints, ball):
    """Tip, axis, speed and acceleration, by turning and shifting from the last joint to the first: f = exp(q Z) g, and its derivatives."""
    exact = np.frompyfunc(ball, 1, 1)
    mount_r, mount_p = (exact(part) for part in arm.mounting)
    zero = exact(np.zeros(3))
    point, way = [mount_p + mount_r @ exact(frame[1]), zero, zero], [mount_r @ exact(frame[0][:, 2]), zero, zero]
    for joint, (q, qd, qdd) in reversed(list(zip(arm.joints, joints))):
        r, d = (exact(part) for part in joint.frame)
        point, way = ([r @ part for part in turned(exact(joint.axis), q, qd, qdd, g)] for g in (point, way))
        point[0] = point[0] + d
    return point[0], way[0], point[1], point[2]


def turned(z, q, qd, qdd, g):
    """exp(q Z) g and its first two derivatives."""
    about = lambda v: np.cross(z, v)
    # Rodrigues: v + sin q Z v + (1 - cos q) Z Z v.
    turn = lambda v: v + q.sin() * about(v) + (1 - q.cos()) * about(about(v))
    first = g[1] + qd * about(g[0])
    second = g[2] + 2 * qd * about(g[1]) + qdd * about(g[0]) + qd * qd * about(about(g[0]))
    return [turn(g[0]), turn(first), turn(second)]
