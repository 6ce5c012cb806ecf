"""The wheel's dynamics beside Pinocchio and MuJoCo: many states of all arms, and whole washes under the same law."""

import sys

import numpy as np
import pytest
from conftest import ROOT

import pyplatewash as pw
from wheel_plans import plan

sys.path.insert(0, str(ROOT / "crates" / "simulator" / "tests" / "fixtures"))

import generate_dynamics  # noqa: E402
import mujoco_run  # noqa: E402

STATES = 10_000
LARGEST = 1e-9
#: Gains as torques, for the laws that take none from the mass matrix [N m/rad, N m s/rad].
KP = np.array([400.0, 600.0, 300.0, 60.0, 40.0, 10.0])
KD = np.array([40.0, 60.0, 30.0, 4.0, 2.5, 0.5])
#: Plates that do not push back, whatever the tool's stiffness.
NO_PUSH = {"contact_stiffness_pa": None, "contact_damping_pa_s": None, "contact_force_n": None}


@pytest.fixture(scope="module")
def kitchen():
    return plan("kitchen-spiral")


def off(found: np.ndarray, wanted: np.ndarray) -> float:
    """The largest error of any state, as a share of the largest entry of its reference."""
    found, wanted = (array.reshape(len(array), -1) for array in (found, wanted))
    return (np.abs(found - wanted).max(axis=1) / np.abs(wanted).max(axis=1)).max()


@pytest.mark.parametrize("name", list(generate_dynamics.cases()))
def test_ten_thousand_states_agree_with_pinocchio_and_mujoco(name):
    _, urdf, tool, _ = generate_dynamics.cases()[name]
    robot = pw.Robot.from_urdf(urdf)
    model = pw.DynamicsModel(robot, pw.Tool(**tool) if tool else None)
    reference = generate_dynamics.reference(name, STATES)
    assert robot.joint_names == reference["joints"]
    columns = {key: np.array([state[key] for state in reference["states"]]) for key in reference["states"][0]}
    assert columns["mass"].shape == (STATES, 6, 6)
    q, qd, qdd, torque = (columns[key] for key in ("q", "qd", "qdd", "tau"))
    forward = model.forward_dynamics(q, qd, torque)
    found = {
        "inverse": model.inverse_dynamics(q, qd, qdd),
        "mass": model.mass_matrix(q),
        "gravity": model.gravity_torque(q),
        "bias": model.bias_torque(q, qd),
        "forward": forward,
        "forward_mujoco": forward,
    }
    errors = {key: off(values, columns[key]) for key, values in found.items()}
    assert max(errors.values()) < LARGEST, errors


def test_a_wrong_arm_would_be_noticed():
    _, urdf, _, _ = generate_dynamics.cases()["arm_3"]
    model = pw.DynamicsModel(pw.Robot.from_urdf(urdf), pw.Tool(length_m=0.1, mass_kg=1e-6, mounted_on="link_6"))
    states = generate_dynamics.reference("arm_3", 50)["states"]
    q = np.array([state["q"] for state in states])
    assert off(model.gravity_torque(q), np.array([state["gravity"] for state in states])) > LARGEST


@pytest.mark.parametrize("law", ["pd", "pd_gravity", "computed_torque"])
def test_a_whole_wash_agrees_with_mujoco(kitchen, law):
    settings = pw.SimulationSettings.of(kitchen).replace(law=law, plant=NO_PUSH)
    if law == "computed_torque":
        frequency, damping = settings.control.frequency_rad_s, settings.control.damping_ratio
        kp, kd = frequency**2, 2 * damping * frequency
    else:
        kp, kd = KP, KD
        settings = settings.replace(control={"joint_kp": KP, "joint_kd": KD})
    execution = pw.simulate(kitchen, settings=settings)
    theirs = mujoco_run.run(kitchen.to_dict(), law, kp, kd, settings.control.rate_hz)
    tool = pw.Tool(length_m=0.15)  # that of the kitchen
    robot = pw.Robot.irb120()
    ours = robot.fk(execution.q_rad, tool=tool)[:, :3, 3]
    assert ours.shape == theirs.shape
    apart = np.linalg.norm(ours - theirs, axis=1)
    assert np.sqrt(np.mean(apart**2)) < 1e-4
    # The agreement says something: the law leaves a trace far above it.
    asked = robot.fk(execution.commanded_rad, tool=tool)[:, :3, 3]
    least = {"pd": 1e-2, "pd_gravity": 1e-3, "computed_torque": 1e-9}[law]
    assert np.linalg.norm(ours - asked, axis=1).max() > least > apart.max()


@pytest.mark.parametrize(("law", "stiffness_pa", "end"), [("computed_torque", 11e3, "landing"), ("computed_torque", 44e3, "lifting"), ("pd_gravity", 20e3, "lifting")])
def test_the_force_on_a_plate_agrees_with_mujoco(kitchen, law, stiffness_pa, end):
    """An end of the first plate's wash by MuJoCo's arm, with the foam's law written down once more: one at the rim, one in the middle."""
    settings = pw.SimulationSettings.of(kitchen).replace(law=law, plant=NO_PUSH | {"contact_stiffness_pa": stiffness_pa})
    if law == "computed_torque":
        kp, kd = 60.0**2, 2 * 60.0
        settings = settings.replace(control={"frequency_rad_s": 60.0, "damping_ratio": 1.0})
    else:
        kp, kd = KP * 3, KD
        settings = settings.replace(control={"joint_kp": kp, "joint_kd": kd})
    execution = pw.simulate(kitchen, settings=settings)
    segments = kitchen.segments
    first = next(k for k, segment in enumerate(segments) if segment.kind == "wash")
    turn_s = segments[first].t_start_s if end == "landing" else segments[first].t_end_s
    before_s, after_s = (0.3, 1.0) if end == "landing" else (1.0, 0.3)
    rate_hz = settings.control.rate_hz
    samples = slice(round((turn_s - before_s) * rate_hz), round((turn_s + after_s) * rate_hz))
    foam = mujoco_run.Foam(kitchen.to_dict(), stiffness_pa)
    start = execution.q_rad[samples.start], execution.qd_rad_s[samples.start]
    tips, theirs = mujoco_run.run_on(kitchen.to_dict(), law, kp, kd, rate_hz, foam, samples, start)
    ours, washing = execution.force_n[samples], execution.segment[samples] == first
    assert (theirs[washing] > 0).all() and (ours[washing] > 0).all() and (theirs == 0).any()
    apart = np.abs(ours - theirs)
    print(f"{law} {stiffness_pa}: {theirs[washing].min():.2f} to {theirs[washing].max():.2f} N, apart {apart.max():.4f} N, {(apart[washing] / theirs[washing]).max():.2%}")
    assert (apart[washing] < 0.01 * theirs[washing]).all()
    assert apart.max() < 0.01 * theirs.max()
    at = pw.Robot.irb120().fk(execution.q_rad[samples], tool=pw.Tool(length_m=0.15))[:, :3, 3]
    assert np.linalg.norm(at - tips, axis=1).max() < 1e-4
    pressing, whole = execution.report().plates[0].pressing, execution.segment == first
    forces = execution.force_n[whole]
    np.testing.assert_allclose([pressing.least_n, pressing.mean_n, pressing.most_n], [forces.min(), forces.mean(), forces.max()], rtol=1e-12)
    assert pressing.deepest_m == pytest.approx(execution.compression_m[whole].max())
