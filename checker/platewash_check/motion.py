"""The motion between knots, a cubic for each joint, and bounds on what it does to a point and an axis of the tool.

For f(t) = exp(q(t) Z) g(t), a vector g turned about a fixed axis by the angle q, the derivatives are sums over Bell polynomials:

    |f^(n)| <= sum_k C(n, k) B_(n-k)(|q'|, |q''|, |q'''|) |g^(k)|,

with the distance of g from the axis in the place of |g| for k = 0. From the last joint to the first this bounds the derivatives of the tip.
"""

from dataclasses import dataclass

import numpy as np

from .plan import compose

EPS = np.finfo(float).eps
COMB = [[1], [1, 1], [1, 2, 1], [1, 3, 3, 1], [1, 4, 6, 4, 1]]


class Motion:
    """Cubic pieces of the joints: q(u) = q0 + v0 u + c2 u^2 + c3 u^3 from each knot on."""

    def __init__(self, t, q, qd):
        self.t, self.h = t, np.diff(t)
        h = self.h[:, None]
        self.q0, self.v0 = q[:-1], qd[:-1]
        m, v1 = np.diff(q, axis=0) / h, qd[1:]
        self.c2 = (3 * m - 2 * self.v0 - v1) / h
        self.c3 = (self.v0 + v1 - 2 * m) / h**2
        # What rounding changes of q', q'' and q''': 100 units in the last place of what is summed.
        size = np.abs(m) + np.abs(self.v0) + np.abs(v1)
        self.rounding = (100 * EPS * size * h, 100 * EPS * size, 100 * EPS * size / h, 100 * EPS * size / h**2)

    def at(self, piece, u):
        """Positions, speeds, accelerations and third derivatives at times u after the beginning of pieces."""
        u = u[:, None]
        q0, v0, c2, c3 = self.q0[piece], self.v0[piece], self.c2[piece], self.c3[piece]
        return (
            q0 + u * (v0 + u * (c2 + u * c3)),
            v0 + u * (2 * c2 + 3 * u * c3),
            2 * c2 + 6 * u * c3,
            6 * c3 + 0 * u,
        )

    def extremes(self):
        """Least and greatest position, greatest speed and greatest acceleration of each joint in each piece, with rounding."""
        h = self.h[:, None] + 0 * self.c2
        with np.errstate(divide="ignore", invalid="ignore"):
            # Both ends, the zeros of the speed v0 + 2 c2 u + 3 c3 u^2, and that of the acceleration.
            root = np.sqrt(np.maximum(self.c2**2 - 3 * self.c3 * self.v0, 0))
            s = -(self.c2 + np.where(self.c2 >= 0, root, -root))
            u = np.array([0 * h, h, s / (3 * self.c3), self.v0 / s, -self.c2 / (3 * self.c3)])
        u = np.clip(np.where(np.isfinite(u), u, 0), 0, h)
        q = self.q0 + u * (self.v0 + u * (self.c2 + u * self.c3))
        low, high = q.min(axis=0), q.max(axis=0)
        speed = abs(self.v0 + u * (2 * self.c2 + 3 * u * self.c3)).max(axis=0)
        acceleration = abs(2 * self.c2 + 6 * u[:2] * self.c3).max(axis=0)
        at_q = self.rounding[0] + EPS * np.maximum(abs(low), abs(high))
        return low - at_q, high + at_q, speed + self.rounding[1], acceleration + self.rounding[2]


@dataclass
class Steps:
    """Stretches of time, each within one piece: the piece, and the times after its beginning."""

    piece: np.ndarray
    start: np.ndarray
    end: np.ndarray

    @staticmethod
    def cover(motion, first, last, longest):
        """Steps over the pieces from `first` up to `last`, none longer than asked."""
        count = np.maximum(np.ceil(motion.h[first:last] / longest), 1).astype(int)
        piece = np.repeat(np.arange(first, last), count)
        k = np.arange(len(piece)) - np.repeat(np.cumsum(count) - count, count)
        n = np.repeat(count, count)
        h = motion.h[piece]
        return Steps(piece, h * k / n, np.where(k + 1 == n, h, h * (k + 1) / n))

    def halves(self, which):
        """The two halves of some steps."""
        piece, start, end = self.piece[which], self.start[which], self.end[which]
        middle = 0.5 * (start + end)
        return Steps(np.r_[piece, piece], np.r_[start, middle], np.r_[middle, end])

    def part(self, which):
        return Steps(self.piece[which], self.start[which], self.end[which])

    def __len__(self):
        return len(self.piece)


def bell(q1, q2, q3):
    """Bell polynomials B_1 to B_4 of bounds on the derivatives of an angle (the fourth derivative of a cubic is 0)."""
    return (
        q1,
        q2 + q1**2,
        q3 + 3 * q1 * q2 + q1**3,
        4 * q1 * q3 + 3 * q2**2 + 6 * q1**2 * q2 + q1**4,
    )


class Ends:
    """The tool's tip and axis at both ends of steps, and bounds on their derivatives in between; in the frame of the base."""

    def __init__(self, arm, motion, steps, tip):
        self.h = steps.end - steps.start
        self.rounding = [values[steps.piece] for values in motion.rounding]
        h = self.h[:, None]
        states = [motion.at(steps.piece, u) for u in (steps.start, steps.end)]
        third = abs(states[0][3]) + self.rounding[3]
        self.q2 = np.maximum(abs(states[0][2]), abs(states[1][2])) + self.rounding[2]
        # The speed is a parabola: it leaves its chord by h^2/8 of its second derivative at most.
        self.q1 = np.maximum(abs(states[0][1]), abs(states[1][1])) + h**2 / 8 * third + self.rounding[1]
        b = bell(self.q1, self.q2, third)
        self.at = [Instant(arm, *state[:3], tip) for state in states]
        reach = arm.reaches(compose(arm.mounting, tip)[1])
        # Derivatives of the tip and of the axis, seen from each joint; the last joint sees them at rest.
        g = [None] + [np.zeros(len(steps))] * 4
        a = [None] + [np.zeros(len(steps))] * 4
        self.levers = np.empty((len(steps), 6))
        for i in reversed(range(6)):
            rho = np.maximum(self.at[0].levers[:, i], self.at[1].levers[:, i]) + self.h**2 / 8 * g[2]
            rho = self.levers[:, i] = np.minimum(rho, reach[i]) * (1 + 1e-12) + 1e-15
            new = lambda d, at_rest: [None] + [
                sum(COMB[n][k] * b[n - k - 1][:, i] * (at_rest if k == 0 else d[k]) for k in range(n)) + d[n]
                for n in range(1, 5)
            ]
            g, a = new(g, rho), new(a, 1.0)
        self.tip, self.axis = g, a

    def most(self, values, second):
        """Bound over each step on a quantity with values at both ends, by a bound on its second derivative."""
        return np.maximum(values[0], values[1]) + self.h**2 / 8 * second


class Instant:
    """The tip, its speed and acceleration, and the tool's axis at configurations; in the frame of the base."""

    def __init__(self, arm, q, qd, qdd, tip):
        r, p = arm.frames(q)
        self.r, self.p = r, p
        mount_r, mount_p = arm.mounting
        self.tip = p[6] + np.einsum("nij,j->ni", r[6], mount_p + mount_r @ tip[1])
        self.axis = np.einsum("nij,j->ni", r[6], mount_r @ tip[0][:, 2])
        n = len(q)
        omega, alpha = np.zeros((n, 3)), np.zeros((n, 3))
        speed, acceleration, here = np.zeros((n, 3)), np.zeros((n, 3)), np.zeros((n, 3))
        self.levers = np.empty((n, 6))
        for i, joint in enumerate(arm.joints):
            away = p[i + 1] - here
            speed, acceleration = carried(speed, acceleration, omega, alpha, away)
            here = p[i + 1]
            z = np.einsum("nij,j->ni", r[i + 1], joint.axis)
            alpha = alpha + z * qdd[:, i : i + 1] + np.cross(omega, z * qd[:, i : i + 1])
            omega = omega + z * qd[:, i : i + 1]
            self.levers[:, i] = np.linalg.norm(np.cross(z, self.tip - here), axis=1)
        self.speed, self.acceleration = carried(speed, acceleration, omega, alpha, self.tip - here)
        self.omega = omega


def carried(speed, acceleration, omega, alpha, away):
    """Speed and acceleration of a point of a moving body, from those of another one."""
    across = np.cross(omega, away)
    return speed + across, acceleration + np.cross(alpha, away) + np.cross(omega, across)
