"""Rounding, checked: random moments again in ball arithmetic, whose balls hold the true values (python-flint, optional)."""

import numpy as np

from .motion import Instant
from .plan import Refused
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


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def add(*vectors):
    return [sum(parts[1:], parts[0]) for parts in zip(*vectors)]


def times(matrix, vector):
    return [sum((a * b for a, b in zip(row[1:], vector[1:])), row[0] * vector[0]) for row in matrix]


def tip(arm, frame, joints, ball):
    """Tip, axis, speed and acceleration, by turning and shifting from the last joint to the first: f = exp(q Z) g, and its derivatives."""
    exact = lambda array: [[ball(x) for x in row] for row in np.atleast_2d(array)]
    mount_r, mount_p = arm.mounting
    place = add(exact(mount_p)[0], times(exact(mount_r), exact(frame[1])[0]))
    axis = times(exact(mount_r), exact(frame[0][:, 2])[0])
    zero = [ball(0)] * 3
    point, way = [place, zero, zero], [axis, zero, zero]
    for joint, (q, qd, qdd) in reversed(list(zip(arm.joints, joints))):
        z = exact(joint.axis)[0]
        r, d = exact(joint.frame[0]), exact(joint.frame[1])[0]
        point, way = (turned(z, q, qd, qdd, g) for g in (point, way))
        point = [add(times(r, point[0]), d), times(r, point[1]), times(r, point[2])]
        way = [times(r, part) for part in way]
    return point[0], way[0], point[1], point[2]


def turned(z, q, qd, qdd, g):
    """exp(q Z) g and its first two derivatives."""
    about = lambda v: cross(z, v)
    scaled = lambda s, v: [s * x for x in v]
    s, c = q.sin(), q.cos()
    # Rodrigues: v + sin q Z v + (1 - cos q) Z Z v.
    turn = lambda v: add(v, scaled(s, about(v)), scaled(1 - c, about(about(v))))
    first = add(g[1], scaled(qd, about(g[0])))
    second = add(g[2], scaled(2 * qd, about(g[1])), scaled(qdd, about(g[0])), scaled(qd * qd, about(about(g[0]))))
    return [turn(g[0]), turn(first), turn(second)]
