"""The timing of joint paths against toppra's, and its limits by SciPy and Pinocchio.

The motions come from crates/planner/tests/fixtures/timing.json (its generator stands beside it). toppra constrains the
path's accelerations on its grid and holds them constant between; the durations compared are those of its finest grid,
stretched until its own motion keeps the limits.
"""

import json
import warnings

import numpy as np
import pinocchio as pin
import pytest
import toppra
import toppra.algorithm
import toppra.constraint
from scipy.interpolate import CubicHermiteSpline, CubicSpline

toppra.setup_logging("ERROR")

# Intervals of toppra's finest grid.
GRID = 4000


def cases(root):
    return json.loads((root / "crates" / "planner" / "tests" / "fixtures" / "timing.json").read_text(encoding="utf-8"))


@pytest.fixture(scope="module", params=["smooth", "wash", "wash, tip limited"])
def case(request, root) -> dict:
    content = next(c for c in cases(root) if c["name"] == request.param)
    return {key: np.array(value) if isinstance(value, list) else value for key, value in content.items()}


@pytest.fixture(scope="module")
def path(case) -> CubicSpline:
    return CubicSpline(case["u"], case["q_rad"], bc_type="not-a-knot")


@pytest.fixture(scope="module")
def motion(case, path) -> CubicHermiteSpline:
    return CubicHermiteSpline(case["t_s"], path(case["knots_u"]), case["qd_rad_s"])


def by_toppra(path: CubicSpline, velocity, acceleration) -> tuple[float, float]:
    """Duration [s] of toppra's motion, and by what it exceeds the limits of acceleration between its grid points."""
    curve = toppra.SplineInterpolator(path.x, path(path.x), bc_type="not-a-knot")
    limits = [
        toppra.constraint.JointVelocityConstraint(np.column_stack([-velocity, velocity])),
        toppra.constraint.JointAccelerationConstraint(
            np.column_stack([-acceleration, acceleration]),
            discretization_scheme=toppra.constraint.DiscretizationType.Interpolation,
        ),
    ]
    grid = np.unique(np.concatenate([np.linspace(path.x[0], path.x[-1], GRID + 1), path.x]))
    solver = toppra.algorithm.TOPPRA(limits, curve, gridpoints=grid, parametrizer="ParametrizeConstAccel")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        timed = solver.compute_trajectory(0, 0)
    times = np.linspace(0, timed.duration, 40 * GRID)
    return timed.duration, (np.abs(timed(times, 2)) / acceleration).max()


def test_no_slower_than_toppra(case, path):
    if case["tip"] is not None:
        pytest.skip("toppra knows no limits of the tip")
    duration, excess = by_toppra(path, case["velocity_rad_s"], case["acceleration_rad_s2"])
    lawful = duration * np.sqrt(max(excess, 1.0))
    ours = case["t_s"][-1]
    print(f"{case['name']}: ours {ours:.4f} s, toppra {duration:.4f} s at {excess:.3f} of its limits")
    assert ours <= 1.01 * lawful
    # And not below what is possible: toppra's constraints are necessary at its grid points.
    assert ours >= 0.99 * duration


def test_joints_keep_their_limits(case, motion):
    ends = np.concatenate([case["t_s"][:-1] + 1e-12, case["t_s"][1:] - 1e-12])
    assert (np.abs(motion(ends, 2)) <= case["acceleration_rad_s2"] * (1 + 1e-6)).all()
    times = np.linspace(0, case["t_s"][-1], 100_000)
    assert (np.abs(motion(times, 1)) <= case["velocity_rad_s"] * (1 + 1e-9)).all()
    assert (case["qd_rad_s"][[0, -1]] == 0).all()


def test_the_motion_stays_on_the_path(case, path, motion):
    u, t, knots = case["knots_u"], case["t_s"], len(case["knots_u"])
    fine = path(np.interp(np.linspace(0, knots - 1, 40 * knots), np.arange(knots), u))
    for k in np.linspace(0, knots - 2, 200).astype(int):
        near = fine[40 * k : 40 * (k + 1) + 40]
        here = motion(0.5 * (t[k] + t[k + 1]))
        # Distance from the polyline through close points of the path.
        step = np.diff(near, axis=0)
        share = np.clip(((here - near[:-1]) * step).sum(1) / (step * step).sum(1), 0, 1)
        off = np.linalg.norm(near[:-1] + share[:, None] * step - here, axis=1).min()
        assert off <= 2e-5


def test_the_tip_keeps_its_limits(case, motion, irb120):
    if case["tip"] is None:
        pytest.skip("no limits of the tip")
    data = irb120.createData()
    frame = irb120.getFrameId("tool0")
    arm = np.array([0, 0, case["tip"]["tool_length_m"]])
    for t in np.linspace(0, case["t_s"][-1], 20_000):
        pin.forwardKinematics(irb120, data, motion(t), motion(t, 1), motion(t, 2))
        pose = pin.updateFramePlacement(irb120, data, frame)
        aligned = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        speed = pin.getFrameVelocity(irb120, data, frame, aligned)
        acceleration = pin.getFrameClassicalAcceleration(irb120, data, frame, aligned)
        lever = pose.rotation @ arm
        w, dw = speed.angular, acceleration.angular
        v = speed.linear + np.cross(w, lever)
        a = acceleration.linear + np.cross(dw, lever) + np.cross(w, np.cross(w, lever))
        assert np.linalg.norm(v) <= case["tip"]["speed_m_s"] * (1 + 1e-9)
        assert np.linalg.norm(a) <= case["tip"]["acceleration_m_s2"] * (1 + 1e-9)
