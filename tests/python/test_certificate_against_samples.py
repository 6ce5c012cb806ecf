"""No dense sample of a proved plan is worse than what its certificate proves.

The samples share nothing with the certificate: SciPy evaluates the knots, Pinocchio the arm, coal the distances, and the
wash curve is written down here once more from its definition.
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
STOPS = 4
COAL_M = 5e-5  # what coal's iteration and ours may differ by


@pytest.fixture(scope="module", params=["kitchen-spiral", "kitchen-rim"])
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
def checks(run):
    """Checks by the name of their requirement."""
    certificate = run[1]
    assert certificate["verdict"] == "pass"
    return {check["requirement"]: check for check in certificate["checks"]}


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
    tip = plan["job"]["workcell"]["tool"]["tip"]
    w, x, y, z = tip["quaternion_wxyz"]
    offset = pin.SE3(pin.Quaternion(w, x, y, z), np.array(tip["position_m"]))
    flange = model.getFrameId("tool0")
    parent = model.frames[flange]
    frame = model.addFrame(pin.Frame("tip", parent.parentJoint, flange, parent.placement * offset, pin.FrameType.OP_FRAME))
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


def bound(checks, name):
    return checks[name]["measure"]["bound"]


def test_joints_keep_their_bounds(plan, checks, irb120, motion):
    _, q, qd, qdd = motion
    margin = np.minimum(q - irb120.lowerPositionLimit, irb120.upperPositionLimit - q).min()
    assert bound(checks, "joint_position") - 1e-9 <= margin <= bound(checks, "joint_position") + 0.01
    speed, acceleration = np.abs(qd).max(), np.abs(qdd).max()
    assert np.all(np.abs(qd) <= irb120.velocityLimit * (1 + 1e-9))
    assert np.all(np.abs(qdd) <= np.array(plan["job"]["limits"]["joint_acceleration_rad_s2"]) * (1 + 1e-6))
    assert speed > 0.5 and acceleration > 3, "the motion moves"


def test_the_tip_keeps_its_bounds(plan, checks, motion, tip):
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
        proved = bound(checks, name)
        assert values.max() <= proved * (1 + 1e-6), name
        assert values.max() >= 0.9 * proved, f"{name}: the bound is far above what happens"


def wash_curve(plan, path, theta):
    """The spiral and ring from its definition in the plan, world frame [m]."""
    shape = path["curve"]
    radius, whole, blend = shape["radius_m"], 2 * np.pi * shape["turns"], 1.0
    rate = radius / (whole - blend / 2)
    x = np.clip((theta - (whole - blend)) / blend, 0, 1)
    r = np.where(theta <= whole - blend, rate * theta, rate * (whole - blend + blend * (x - x**4 * (2.5 - 3 * x + x * x))))
    angle = shape["start_angle_rad"] + theta
    centre = np.array(plan["job"]["plates"][path["plate"]]["pose"]["position_m"])
    return centre + np.stack([r * np.cos(angle), r * np.sin(angle), np.zeros_like(r)], axis=-1)


def test_the_tip_follows_the_wash_curve(plan, checks, motion, tip):
    _, index = kinds(plan, motion[0])
    worst = 0.0
    paths = {path["plate"]: path for path in plan["wash_paths"]}
    for k, segment in enumerate(plan["segments"]):
        if segment["kind"] != "wash":
            continue
        path = paths[segment["plate"]]
        theta = np.linspace(0, 2 * np.pi * (path["curve"]["turns"] + path["curve"]["closing_ring"]), 60_000)
        curve = wash_curve(plan, path, theta)
        step = np.linalg.norm(np.diff(curve, axis=0), axis=1).max()
        at = 0
        for p in tip[0][index == k]:
            # The ring passes the spiral's end again: look ahead only.
            ahead = slice(at, at + 2000)
            distances = np.linalg.norm(curve[ahead] - p, axis=1)
            at += int(distances.argmin())
            worst = max(worst, distances.min())
        assert at > 0.99 * len(theta), "the whole curve is washed"
    assert worst <= bound(checks, "path_deviation") + step / 2
    assert worst <= checks["path_deviation"]["measure"]["limit"] == 2e-4


def check_clearances(plan, certificate, motion, irb120_urdf, samples):
    """No sampled distance of a pair is less than the certificate proves; the number of pairs."""
    held, lying = plan["job"]["workcell"]["tool"], plan["job"]["plates"]
    handle = held["bodies"][0]["shape"]["cylinder"]["radius_m"]
    sponge = held["sponge"]
    tool = Tool(held["tip"]["position_m"][2], handle, sponge["radius_m"], sponge["height_m"], sponge["compression_m"])
    centres = [plate["pose"]["position_m"] for plate in lying]
    plates = Plates(lying[0]["surface"]["radius_m"], centres[0][2], lying[0]["thickness_m"], tuple((x, y) for x, y, _ in centres))
    reference, tree = Reference(bodies(irb120_urdf, tool, plates)), urdf_reader.Tree(irb120_urdf)
    joints = [joint.name for joint in tree.chain("link_6")]
    names, _ = kinds(plan, motion[0])
    rules = {tuple(row["pair"]): row["at_least_m"] for row in certificate["clearance"] if row["rule"] in ("clearance", "reduced")}
    for k in np.linspace(0, len(motion[0]) - 1, samples).astype(int):
        reference.move(tree.poses(dict(zip(joints, motion[1][k]))))
        for (a, b), proved in rules.items():
            sponge_on_plate = a == "sponge" and b.startswith("plate") and names[k] in ("approach", "wash", "retreat")
            if not sponge_on_plate:
                assert reference.distance(a, b) >= proved - COAL_M, f"{a} and {b} at {motion[0][k]:.3f} s"
    return len(rules)


def test_no_sample_is_closer_than_proved(run, plan, checks, motion, irb120_urdf):
    assert check_clearances(plan, run[1], motion, irb120_urdf, CLEARANCE_SAMPLES) > 40
    assert bound(checks, "clearance") >= 0.01


def test_no_way_home_after_a_stop_is_closer_than_proved(platewash, run, plan, motion, irb120_urdf, tmp_path):
    (tmp_path / "plan.json").write_text(json.dumps(plan))
    rng = np.random.default_rng(69)
    for k in rng.integers(0, len(motion[0]), STOPS):
        stands = np.degrees(motion[1][k]) + rng.uniform(-2.0, 2.0, 6)
        asked = [platewash, "recover", "plan.json", "--stopped-s", str(motion[0][k]), "--at-deg", *map(str, stands), "--quiet"]
        subprocess.run(asked, check=True, capture_output=True, cwd=tmp_path)
        home, certificate = [json.loads((tmp_path / "out" / "recovery" / f"home{end}.json").read_text()) for end in ("", ".certificate")]
        assert certificate["verdict"] == "pass"
        knots = home["knots"]
        spline = CubicHermiteSpline(*(np.array(knots[key]) for key in ("t_s", "q_rad", "qd_rad_s")))
        assert np.abs(np.degrees(spline(0.0)) - stands).max() < 1e-9
        times = np.linspace(0, knots["t_s"][-1], 2 * CLEARANCE_SAMPLES)
        assert check_clearances(home, certificate, (times, spline(times)), irb120_urdf, 60) > 40
