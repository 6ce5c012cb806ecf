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


@pytest.fixture(scope="module")
def kitchen():
    return plan("kitchen")


def off(found: np.ndarray, wanted: np.ndarray) -> float:
    """The largest error of any state, as a share of the largest entry of its reference."""
    found, wanted = (array.reshape(len(array), -1) for array in (found, wanted))
    return (np.abs(found - wanted).max(axis=1) / np.abs(wanted).max(axis=1)).max()


@pytest.mark.parametrize("name", list(generate_dynamics.cases()))
def test_ten_thousand_states_are_pinocchios_and_mujocos(name):
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
    model = pw.DynamicsModel(pw.Robot.from_urdf(urdf), pw.Tool(length_m=0.1, mass_kg=1e-6))
    states = generate_dynamics.reference("arm_3", 50)["states"]
    q = np.array([state["q"] for state in states])
    assert off(model.gravity_torque(q), np.array([state["gravity"] for state in states])) > LARGEST


@pytest.mark.parametrize("law", ["pd", "pd_gravity", "computed_torque"])
def test_a_whole_wash_is_mujocos(kitchen, law):
    settings = pw.SimulationSettings.of(kitchen).replace(law=law)
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
