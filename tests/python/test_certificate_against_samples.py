"""No dense sample of a certified plan is worse than what its certificate proves.

The samples share nothing with the certificate: SciPy evaluates the knots, Pinocchio the arm, coal the distances, and the
tool path is written down here once more from its definition.
"""

import json
import subprocess

import numpy as np
import pinocchio as pin
import pytest
from scipy.interpolate import CubicHermiteSpline

import urdf_reader
from clearance_reference import Plates, Reference, Tool, bodies

SAMPLES = 6000
CLEARANCE_SAMPLES = 250
COAL_M = 5e-5  # what coal's iteration and ours may differ by


@pytest.fixture(scope="module", params=["kitchen", "kitchen-rim"])
def run(request, platewash, tmp_path_factory):
    """Plan and certificate of a shipped scenario."""
    folder = tmp_path_factory.mktemp(request.param)
    command = [platewash, "run", "--quiet", "--scenario", request.param, "--seed", "7", "--out", folder]
    subprocess.run(command, check=True, capture_output=True)
    return [json.loads((folder / name).read_text()) for name in ("plan.json", "certificate.json")]


@pytest.fixture(scope="module")
def plan(run):
    return run[0]


@pytest.fixture(scope="module")
def promises(run):
    """Promises by name."""
    certificate = run[1]
    assert certificate["verdict"] == "pass"
    return {promise["name"]: promise for promise in certificate["promises"]}


@pytest.fixture(scope="module")
def motion(plan):
    """Times [s] with q, its first two derivatives (to the right of a knot), one row a sample."""
    knots = plan["knots"]
    t, q, qd = (np.array(knots[key]) for key in ("t_s", "q_rad", "qd_rad_s"))
    spline = CubicHermiteSpline(t, q, qd)
    times = np.union1d(np.linspace(0, t[-1], SAMPLES), t[:-1] + 1e-9)
    return times, spline(times), spline(times, 1), spline(times, 2)


@pytest.fixture(scope="module")
def tip(plan, irb120, motion):
    """Position, rotation, velocity and acceleration of the tip at every sample, base frame."""
    model, data = irb120.copy(), None
    w, x, y, z = plan["tip"]["quaternion_wxyz"]
    offset = pin.SE3(pin.Quaternion(w, x, y, z), np.array(plan["tip"]["position_m"]))
    link = model.getFrameId(plan["tip"]["link"])
    parent = model.frames[link]
    frame = model.addFrame(pin.Frame("tip", parent.parentJoint, link, parent.placement * offset, pin.FrameType.OP_FRAME))
    data, world = model.createData(), pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
    rows = []
    for q, v, a in zip(*motion[1:]):
        pin.forwardKinematics(model, data, q, v, a)
        pin.updateFramePlacements(model, data)
        speed = pin.getFrameVelocity(model, data, frame, world).linear
        acceleration = pin.getFrameClassicalAcceleration(model, data, frame, world).linear
        placement = data.oMf[frame]
        rows.append((placement.translation.copy(), placement.rotation[:, 2].copy(), speed.copy(), acceleration.copy()))
    return [np.array(column) for column in zip(*rows)]


def kinds(plan, times):
    """Kind of the segment at every time."""
    ends = np.array([segment["t_end_s"] for segment in plan["segments"]])
    names = np.array([segment["kind"] for segment in plan["segments"]])
    index = np.searchsorted(ends, times, side="right").clip(max=len(ends) - 1)
    return names[index], index


def bound(promises, name):
    return promises[name]["measure"]["bound"]


def test_joints_keep_their_bounds(plan, promises, motion):
    _, q, qd, qdd = motion
    lower, upper = (np.array(plan["limits"][key], float) for key in ("lower_rad", "upper_rad"))
    margin = np.minimum(q - lower, upper - q).min()
    assert bound(promises, "joint_position") - 1e-9 <= margin <= bound(promises, "joint_position") + 0.01
    speed, acceleration = np.abs(qd).max(), np.abs(qdd).max()
    assert np.all(np.abs(qd) <= np.array(plan["limits"]["velocity_rad_s"]) * (1 + 1e-9))
    assert np.all(np.abs(qdd) <= np.array(plan["limits"]["acceleration_rad_s2"]) * (1 + 1e-6))
    assert speed > 0.5 and acceleration > 3, "the motion moves"


def test_the_tip_keeps_its_bounds(plan, promises, motion, tip):
    names, _ = kinds(plan, motion[0])
    washing = names == "wash"
    working = np.isin(names, ["approach", "wash", "retreat"])
    speed, acceleration = (np.linalg.norm(rows, axis=1) for rows in tip[2:])
    for name, values in {
        "tip_speed": speed[~washing],
        "tip_acceleration": acceleration[~washing],
        "wash_speed": speed[washing],
        "wash_acceleration": acceleration[washing],
        "tilt": np.arccos(np.clip(-tip[1][working][:, 2], -1, 1)),
    }.items():
        proved = bound(promises, name)
        assert values.max() <= proved * (1 + 1e-6), name
        assert values.max() >= 0.9 * proved, f"{name}: the bound is far above what happens"


def stroke(shape, theta):
    """The spiral and ring from its definition in the plan, base frame [m]."""
    radius, whole, blend = shape["radius_m"], 2 * np.pi * shape["turns"], 1.0
    rate = radius / (whole - blend / 2)
    x = np.clip((theta - (whole - blend)) / blend, 0, 1)
    r = np.where(theta <= whole - blend, rate * theta, rate * (whole - blend + blend * (x - x**4 * (2.5 - 3 * x + x * x))))
    angle = shape["start_angle_rad"] + theta
    centre = np.array(shape["centre_m"])
    return centre + np.stack([r * np.cos(angle), r * np.sin(angle), np.zeros_like(r)], axis=-1)


def test_the_tip_follows_the_stroke(plan, promises, motion, tip):
    _, index = kinds(plan, motion[0])
    worst = 0.0
    for k, shape in enumerate(plan["tool_path"]):
        if shape["kind"] != "wash":
            continue
        theta = np.linspace(0, 2 * np.pi * (shape["turns"] + shape["closing_ring"]), 60_000)
        curve = stroke(shape, theta)
        step = np.linalg.norm(np.diff(curve, axis=0), axis=1).max()
        at = 0
        for p in tip[0][index == k]:
            # The ring passes the spiral's end again: look ahead only.
            ahead = slice(at, at + 2000)
            distances = np.linalg.norm(curve[ahead] - p, axis=1)
            at += int(distances.argmin())
            worst = max(worst, distances.min())
        assert at > 0.99 * len(theta), "the whole stroke is washed"
    assert worst <= bound(promises, "stroke_deviation") + step / 2
    assert worst <= plan["tolerances"]["path_m"]


def test_nothing_comes_closer_than_proved(run, plan, promises, motion, irb120_urdf):
    tool = Tool(*(plan["tool"][key] for key in ("length_m", "radius_m", "sponge_radius_m", "sponge_height_m")))
    one = plan["plates"][0]
    plates = Plates(one["radius_m"], one["z_m"], one["thickness_m"], tuple((p["x_m"], p["y_m"]) for p in plan["plates"]))
    reference, tree = Reference(bodies(irb120_urdf, tool, plates)), urdf_reader.Tree(irb120_urdf)
    joints = [joint.name for joint in tree.chain("link_6")]
    names, _ = kinds(plan, motion[0])
    rules = {}
    for row in run[1]["clearance"]:
        if row["rule"] == "clearance":
            rules[tuple(row["pair"])] = row["at_least_m"]
    assert len(rules) > 40
    picked = np.linspace(0, len(motion[0]) - 1, CLEARANCE_SAMPLES).astype(int)
    for k in picked:
        reference.move(tree.poses(dict(zip(joints, motion[1][k]))))
        for (a, b), proved in rules.items():
            sponge_on_plate = a == "sponge" and b.startswith("plate") and names[k] in ("approach", "wash", "retreat")
            if not sponge_on_plate:
                assert reference.distance(a, b) >= proved - COAL_M, f"{a} and {b} at {motion[0][k]:.3f} s"
    assert bound(promises, "clearance") >= 0.01
