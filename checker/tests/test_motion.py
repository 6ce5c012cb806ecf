"""Bounds on the motion of the tool are never better than a dense sample."""

import numpy as np
import pytest
from jobs import irb120, random_motion
from platewash_check.motion import Ends, Instant, Steps

TIP = (np.eye(3), np.array([0.02, -0.01, 0.15]))


def sample(arm, motion, steps, shares):
    """Instants at shares of each step, one after the other."""
    piece = np.repeat(steps.piece, len(shares))
    u = (steps.start[:, None] + np.outer(steps.end - steps.start, shares)).ravel()
    return Instant(arm, *motion.at(piece, u)[:3], TIP)


@pytest.mark.parametrize("seed", range(12))
def test_bounds_hold_between_the_ends_of_steps(seed):
    arm, rng = irb120(), np.random.default_rng(seed)
    motion = random_motion(rng)
    steps = Steps.cover(motion, 0, len(motion.h), rng.choice([1e-3, 0.02, 0.1]))
    ends = Ends(arm, motion, steps, TIP)
    shares = np.linspace(0, 1, 21)
    dense = sample(arm, motion, steps, shares)
    per_step = lambda values: values.reshape(len(steps), -1)
    norm = lambda values: np.linalg.norm(values, axis=1)
    for name, order in (("speed", 3), ("acceleration", 4)):
        bound = ends.most([norm(getattr(i, name)) for i in ends.at], ends.tip[order])
        found = per_step(norm(getattr(dense, name))).max(axis=1)
        assert (found <= bound * (1 + 1e-12)).all()
        # The bounds of the derivatives themselves.
        assert (found <= ends.tip[order - 2] * (1 + 1e-12)).all()
    assert (per_step(norm(dense.omega)).max(axis=1) <= ends.axis[1] * (1 + 1e-12)).all()
    # Third and fourth derivatives, by differences of the accelerations.
    step = (ends.h / 20)[:, None]
    third = np.diff(dense.acceleration.reshape(len(steps), -1, 3), axis=1) / step[..., None]
    assert (np.linalg.norm(third, axis=2).max(axis=1) <= ends.tip[3] * (1 + 1e-9) + 1e-6).all()
    fourth = np.diff(third, axis=1) / step[..., None]
    assert (np.linalg.norm(fourth, axis=2).max(axis=1) <= ends.tip[4] * (1 + 1e-9) + 1e-3 / step[:, 0] ** 2 * 1e-9).all()
    assert (per_step(dense.levers.max(axis=1)).max(axis=1) <= ends.levers.max(axis=1) + 1e-12).all()


@pytest.mark.parametrize("seed", range(6))
def test_extremes_of_joints_are_those_of_a_dense_sample(seed):
    motion = random_motion(np.random.default_rng(seed), knots=9)
    low, high, speed, acceleration = motion.extremes()
    for piece, h in enumerate(motion.h):
        u = np.linspace(0, h, 2001)
        q, qd, qdd, _ = motion.at(np.full(len(u), piece), u)
        for bound, found in ((-low, (-q).max(0)), (high, q.max(0)), (speed, abs(qd).max(0)), (acceleration, abs(qdd).max(0))):
            assert (found <= bound[piece]).all()
            assert (bound[piece] - found <= 1e-5 * (1 + abs(found))).all()


def test_speeds_and_accelerations_are_derivatives_of_the_tip():
    arm, rng = irb120(), np.random.default_rng(3)
    motion, d = random_motion(rng), 1e-5
    u = np.array([0.03])
    at = lambda shift: Instant(arm, *motion.at(np.array([1]), u + shift)[:3], TIP)
    before, here, after = at(-d), at(0), at(d)
    assert np.allclose((after.tip - before.tip) / (2 * d), here.speed, atol=1e-8)
    assert np.allclose((after.speed - before.speed) / (2 * d), here.acceleration, atol=1e-6)
    assert np.allclose((after.axis - before.axis) / (2 * d), np.cross(here.omega, here.axis), atol=1e-8)
