"""The wheel's kinematics: shapes, agreement with Pinocchio, and what is refused."""

# pyright: reportAttributeAccessIssue=false
# (Pinocchio is compiled; its names are hidden from pyright.)
import copy
import pickle
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pinocchio as pin
import pytest

import pyplatewash as pw

Floats = npt.NDArray[np.float64]


@pytest.fixture(scope="module")
def robot() -> pw.Robot:
    return pw.Robot.irb120()


def configurations(robot: pw.Robot, n: int, seed: int = 1) -> Floats:
    return np.random.default_rng(seed).uniform(robot.lower, robot.upper, (n, 6))


def test_poses_and_jacobians_agree_with_pinocchio(robot: pw.Robot, irb120: Any, random_configurations: Floats) -> None:
    data = irb120.createData()
    frame = irb120.getFrameId("tool0")
    poses, jacobians = robot.fk(random_configurations), robot.jacobian(random_configurations)
    local = robot.jacobian(random_configurations, axes="local")
    for k, q in enumerate(random_configurations):
        pin.framesForwardKinematics(irb120, data, q)
        np.testing.assert_allclose(poses[k], data.oMf[frame].homogeneous, atol=1e-12)
        expected = pin.computeFrameJacobian(irb120, data, q, frame, pin.LOCAL_WORLD_ALIGNED)
        np.testing.assert_allclose(jacobians[k], expected, atol=1e-10)
        expected = pin.computeFrameJacobian(irb120, data, q, frame, pin.LOCAL)
        np.testing.assert_allclose(local[k], expected, atol=1e-10)
        np.testing.assert_allclose(robot.fk(q), poses[k], atol=1e-12)
        np.testing.assert_allclose(robot.jacobian(q), jacobians[k], atol=1e-12)


def test_results_keep_the_shape_of_arguments(robot: pw.Robot) -> None:
    for n in (0, 1, 5, 600):
        q = np.zeros((n, 6))
        assert robot.fk(q).shape == (n, 4, 4)
        assert robot.jacobian(q).shape == (n, 6, 6)
        assert np.shape(robot.manipulability(q)) == (n,)
        assert robot.limit_margins(q).shape == (n, 6)
        assert len(robot.ik_batch(robot.fk(q), q)) == n
        assert robot.ik_path(robot.fk(q)).shape == (n, 6)
    assert isinstance(robot.manipulability([0.1] * 6), float)


@pytest.mark.parametrize(
    "make",
    [
        lambda q: q.tolist(),
        lambda q: tuple(map(tuple, q)),
        lambda q: np.asfortranarray(q),
        lambda q: np.repeat(q, 2, axis=0)[::2],
        lambda q: q[::-1][::-1],
        lambda q: q.astype(">f8"),
        lambda q: q.astype(np.longdouble),
        lambda q: np.ascontiguousarray(np.hstack([q, q]))[:, :6],
    ],
)
def test_accepts_any_array_like(robot: pw.Robot, make: Callable[[Floats], Any]) -> None:
    q = configurations(robot, 20)
    np.testing.assert_array_equal(robot.fk(make(q)), robot.fk(q))
    assert robot.fk(np.zeros(6, int)).tolist() == robot.fk([0] * 6).tolist() == robot.fk(range(1)[:0] or [0.0] * 6).tolist()


def test_unaligned_and_read_only_arrays_are_read(robot: pw.Robot) -> None:
    q = configurations(robot, 3)
    raw = np.zeros(q.nbytes + 1, np.uint8)[1:].view(np.float64).reshape(3, 6)
    raw[:] = q
    q.flags.writeable = False
    np.testing.assert_array_equal(robot.fk(raw), robot.fk(q))


@pytest.mark.parametrize("shape", [(), (5,), (7,), (6, 1), (3, 5), (2, 3, 6), (0,)])
def test_a_wrong_shape_is_named_with_the_shape_wanted(robot: pw.Robot, shape: tuple[int, ...]) -> None:
    with pytest.raises(pw.ShapeError) as caught:
        robot.fk(np.zeros(shape))
    assert caught.value.argument == "q" and caught.value.found == shape
    assert "(6,) or (N, 6)" in str(caught.value) and str(shape) in str(caught.value)
    assert isinstance(caught.value, ValueError)


@pytest.mark.parametrize(
    "value",
    ["abc", b"123456", [None] * 6, [1j] * 6, object(), [[1, 2], [3]], {}, {1: 2}, np.zeros(6, "M8[s]"), [True] * 6, None],
)
def test_arrays_without_numbers_raise_type_error(robot: pw.Robot, value: Any) -> None:
    with pytest.raises(TypeError):
        robot.fk(value)


def test_fk_passes_nan_on_and_ik_refuses_it(robot: pw.Robot) -> None:
    assert np.isnan(robot.fk([np.nan] * 6)[:3]).all()
    target = robot.fk([0.1] * 6)
    for bad in (np.full((4, 4), np.nan), np.full((4, 4), np.inf), np.zeros((4, 4)), 2 * target, np.diag([1.0, 1, -1, 1])):
        for call in (lambda: robot.ik(bad), lambda: robot.ik_all(bad), lambda: robot.ik_path([bad])):
            with pytest.raises(pw.InputError):
                call()
        assert robot.ik_batch([bad]).causes == {0: "target"}
    with pytest.raises(pw.InputError, match="joint 3"):
        robot.ik(target, [0, 0, np.nan, 0, 0, 0])
    with pytest.raises(pw.InputError, match="seeds: joint 3: a finite number is needed; found NaN"):
        robot.ik_batch([target], [0, 0, np.nan, 0, 0, 0])


@pytest.mark.parametrize("place", [0, 5, 511, 512, 1299])
def test_an_invalid_pose_affects_only_its_row(robot: pw.Robot, place: int) -> None:
    q = configurations(robot, 1300)
    targets, seeds = robot.fk(q), np.clip(q + 1e-3, robot.lower, robot.upper)
    whole = robot.ik_batch(targets, seeds)
    targets[place, 0, 0] = np.nan
    seeds[place - 1, 3] = np.inf
    batch = robot.ik_batch(targets, seeds)
    other = np.ones(1300, bool)
    other[[place, place - 1]] = False
    assert batch.causes == {place: "target", (place - 1) % 1300: "seed"}
    assert whole.solved.all() and (batch.solved == other).all()
    np.testing.assert_array_equal(batch.q[other], whole.q[other])
    assert np.isnan(batch.q[~other]).all() and np.isnan(batch.position_error_m[~other]).all()
    assert (batch.iterations[~other] == 0).all()


def test_a_rounded_pose_stands_for_the_nearest_one(robot: pw.Robot) -> None:
    exact = robot.fk(configurations(robot, 500))
    rounded = exact.round(6)
    off = np.abs(np.swapaxes(rounded[:, :3, :3], 1, 2) @ rounded[:, :3, :3] - np.eye(3)).max(axis=(1, 2))
    assert off.max() > 1e-6  # Such poses are no rotations to one part in a million.
    u, _, vt = np.linalg.svd(rounded[:, :3, :3])
    nearest = rounded.copy()
    nearest[:, :3, :3] = u @ vt
    for k in range(0, 500, 25):
        branches, wanted = robot.ik_all(rounded[k]), robot.ik_all(nearest[k])
        assert len(branches) == len(wanted) > 0
        np.testing.assert_allclose(robot.fk(branches.q), np.broadcast_to(nearest[k], (len(branches), 4, 4)), atol=1e-9)
    assert robot.ik_batch(rounded, np.zeros(6)).solved.all()
    with pytest.raises(pw.InputError, match=r"target: .*columns are [1-9]\.\de-[34] from orthonormal, and up to 1e-5 .*np\.linalg\.svd"):
        robot.ik(exact[0].round(3) + np.array([[3e-4, 0, 0, 0]] + 3 * [[0.0] * 4]))


def test_ik_answers_within_tolerance_and_limits(robot: pw.Robot) -> None:
    q = configurations(robot, 200)
    for one, target in zip(q, robot.fk(q), strict=True):
        answer = robot.ik(target)
        assert (robot.limit_margins(answer.q) >= 0).all()
        np.testing.assert_allclose(robot.fk(answer.q), target, atol=3e-6)
        branches = robot.ik_all(target, one)
        assert len(branches) == len(branches.labels) >= 1
        np.testing.assert_allclose(robot.fk(branches.q), np.broadcast_to(target, (len(branches), 4, 4)), atol=1e-8)
        assert np.abs(branches.q - one).max(axis=1).min() < 1e-6
        assert set(branches.labels) | set(branches.rejections) == set(robot.ik_all(robot.fk([0.1] * 6)).labels) | set(
            robot.ik_all(robot.fk([0.1] * 6)).rejections
        )


def test_a_batch_equals_its_rows(robot: pw.Robot) -> None:
    q = configurations(robot, 3000)
    targets, seeds = robot.fk(q), robot.lower + (robot.upper - robot.lower) * 0.5
    targets[7, :3, 3] += 3.0
    batch = robot.ik_batch(targets, seeds)
    assert not batch.solved[7] and batch.causes == {7: "unreachable"} and batch.solved.sum() == 2999
    near = robot.ik_batch(robot.fk(q), np.clip(q + 1e-3, robot.lower, robot.upper))
    assert near.solved.all() and np.abs(near.q - q).max() < 0.1
    np.testing.assert_allclose(robot.fk(near.q), robot.fk(q), atol=3e-6)
    for k in (0, 7, 99):
        if k != 7:
            np.testing.assert_allclose(batch.q[k], robot.ik(targets[k], seeds).q, atol=1e-9)
    with pytest.raises(pw.ShapeError):
        robot.ik_batch(targets, np.zeros((3, 6)))


def test_reads_every_rotation(robot: pw.Robot) -> None:
    # Half turns and nearly half turns about each axis and between, where three of a quaternion's four formulas break.
    for axis in [*np.eye(3), [1, 1, 0], [0, 1, -1], [1, -1, 1], [1, 2, 3]]:
        for angle in (0, 1e-9, 1e-4, np.pi / 2, np.pi - 1e-4, np.pi - 1e-9, np.pi, -2.0):
            target = pin.SE3(pin.AngleAxis(angle, np.array(axis) / np.linalg.norm(axis)).matrix(), np.array([0.3, 0.1, 0.4])).homogeneous
            branches = robot.ik_all(target)
            np.testing.assert_allclose(robot.fk(branches.q), np.broadcast_to(target, (len(branches), 4, 4)), atol=1e-8)
            batch = robot.ik_batch([target, target])
            assert batch.solved.all() == (len(branches) > 0)


def test_an_unsolved_target_states_cause_and_error(robot: pw.Robot) -> None:
    target = np.eye(4)
    target[0, 3] = 3.0
    with pytest.raises(pw.IkError) as caught:
        robot.ik(target)
    error = pickle.loads(pickle.dumps(caught.value))
    assert error.cause == "unreachable" and error.q.shape == (6,) and error.position_error_m is not None and error.position_error_m > 2
    assert np.linalg.norm(robot.fk(error.q)[:3, 3] - target[:3, 3]) == pytest.approx(error.position_error_m)


def test_a_path_fails_at_its_first_unreachable_waypoint(robot: pw.Robot) -> None:
    start = robot.fk([0.1, 0.3, 0.1, 0.2, 1.0, 0.0])
    targets = np.repeat(start[None], 200, axis=0)
    targets[:, 0, 3] += np.linspace(0, 0.8, 200)
    with pytest.raises(pw.IkPathError) as caught:
        robot.ik_path(targets, [0.1, 0.3, 0.1, 0.2, 1.0, 0.0])
    error = caught.value
    assert error.solved.shape == (error.waypoint, 6) and 0 < error.waypoint < 200
    np.testing.assert_allclose(robot.fk(error.solved), targets[: error.waypoint], atol=3e-6)
    assert np.abs(np.diff(error.solved, axis=0)).max() < 0.5
    np.testing.assert_array_equal(error.q, error.solved[-1])


def test_frames_and_tips(robot: pw.Robot) -> None:
    q = configurations(robot, 1)[0]
    tool0, matlab = robot.fk(q, "tool0"), robot.fk(q, "matlab_tool0")
    np.testing.assert_allclose(tool0[:3, 2], matlab[:3, 0], atol=1e-12)  # z here, x there: both leave the flange.
    tip = robot.fk(q, tool=pw.Tool(length_m=0.15))
    np.testing.assert_allclose(tip[:3, 3], tool0[:3, 3] + 0.15 * tool0[:3, 2], atol=1e-12)
    np.testing.assert_allclose(robot.fk(robot.ik(tip, tool=pw.Tool(length_m=0.15)).q, tool=pw.Tool(length_m=0.15)), tip, atol=3e-6)
    with pytest.raises(pw.InputError, match="no link named 'nose'"):
        robot.fk(q, "nose")
    with pytest.raises(pw.InputError):
        robot.fk(q, "tool0", tool=pw.Tool())
    with pytest.raises(pw.InputError, match="length_m"):
        robot.fk(q, tool=pw.Tool(length_m=np.nan))
    with pytest.raises(TypeError):
        robot.fk(q, tool="hammer")  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]


def test_other_arms_load_and_broken_ones_are_named(irb120_urdf: Path, fixtures: Path, tmp_path: Path) -> None:
    text = irb120_urdf.read_text()
    robot = pw.Robot.from_urdf(text)
    assert pw.Robot.load(irb120_urdf).sha256 == robot.sha256 == pw.Robot.irb120().sha256
    assert robot.urdf == text and robot.srdf is None
    disabled = re.findall(r'<disable_collisions link1="(\w+)" link2="(\w+)"', pw.Robot.irb120().srdf or "")
    assert ("base_link", "link_1") in disabled
    assert pw.Robot.from_urdf(text, srdf=pw.Robot.irb120().srdf) == pw.Robot.irb120()
    assert robot != pw.Robot.irb120()  # The built-in one comes with its SRDF.
    with pytest.raises(pw.UrdfError, match="joint_3"):
        pw.Robot.from_urdf(text.replace('<joint name="joint_3" type="revolute"', '<joint name="joint_3" type="prismatic"'))
    with pytest.raises(pw.UrdfError, match="cannot be read"):
        pw.Robot.load(tmp_path / "none.urdf")
    other = pw.Robot.load(str(fixtures / "arm_1.urdf"))
    assert pickle.loads(pickle.dumps(other)) == other
    with pytest.raises(pw.InputError, match="no analytic"):
        other.ik_all(other.fk([0.1] * 6, "link_6"), frame="link_6")
    with pytest.raises(pw.InputError, match="no link named 'tool0'"):
        other.fk([0.1] * 6)
    with pytest.raises(pw.InputError, match="tool.mounted_on: .* no link with a usual name for a tool behind joint 6"):
        other.fk([0.1] * 6, tool=pw.Tool(length_m=0.1))
    assert other.fk([0.1] * 6, tool=pw.Tool(length_m=0.1, mounted_on="link_6")).shape == (4, 4)


def test_settings_are_checked(robot: pw.Robot) -> None:
    target = robot.fk([0.1] * 6)
    loose = robot.ik(target, settings=pw.IkSettings(position_tolerance_m=1e-3, analytic_starts=False))
    assert loose.position_error_m <= 1e-3
    with pytest.raises(pw.InputError, match="position_tolerance_m"):
        robot.ik(target, settings=pw.IkSettings(position_tolerance_m=-1))
    with pytest.raises(TypeError):
        robot.ik(target, settings=3)  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]


def test_copies_and_pickles_are_equal(robot: pw.Robot) -> None:
    answer = robot.ik(robot.fk([0.1] * 6))
    batch = robot.ik_batch(robot.fk([[0.1] * 6]))
    branches = robot.ik_all(robot.fk([0.1] * 6))
    for thing in (robot, answer, batch, branches, pw.Tool(), pw.Plate(x_m=0.3, y_m=0), pw.Plate(x_m=0.3, y_m=0, profile="deep230", foot=pw.Foot(radius_m=0.05, height_m=0.004)), pw.IkSettings(), pw.PaperSpiral()):
        assert pickle.loads(pickle.dumps(thing)) == thing == copy.copy(thing) == copy.deepcopy(thing)
        assert thing != 3 and not thing == "x"
        assert type(thing).__name__ in repr(thing)
    assert hash(pickle.loads(pickle.dumps(robot))) == hash(robot)


GRIPPER = """<link name="left"/><link name="right"/>
<joint name="finger" type="prismatic"><parent link="flange"/><child link="left"/><axis xyz="0 1 0"/><limit lower="0" upper="0.05" velocity="1"/></joint>
<joint name="other" type="prismatic"><parent link="flange"/><child link="right"/><axis xyz="0 1 0"/><mimic joint="finger" multiplier="-1"/></joint>
<link name="cylinder"/><joint name="balancer" type="continuous"><parent link="link_1"/><child link="cylinder"/><mimic joint="joint_2" multiplier="-0.25"/></joint>
</robot>"""


def test_joints_that_are_not_of_the_arm_are_held_still(robot: pw.Robot, tmp_path: Path) -> None:
    text = robot.urdf.replace("</robot>", GRIPPER)
    path = tmp_path / "arm.urdf"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(pw.UrdfError, match="joint 'finger' is prismatic"):
        pw.Robot.from_urdf(text)
    arm = pw.Robot.from_urdf(text, fixed={"finger": 0.02})
    with pytest.warns(UserWarning, match="links that are not judged, as joints carry them that follow an axis: 'cylinder'"):
        assert arm == pw.Robot.load(path, fixed={"finger": 0.02})
    assert arm.fixed_joints == {"finger": 0.02, "other": -0.02}
    assert arm.left_out_links == ["cylinder"]
    assert "cylinder" not in arm.link_names
    q = np.full(6, 0.1)
    apart = np.linalg.inv(arm.fk(q, "right")) @ arm.fk(q, "left")
    np.testing.assert_allclose(apart[:3, 3], [0.0, 0.04, 0.0], atol=1e-12)
    copy = pickle.loads(pickle.dumps(arm))
    assert copy == arm
    assert copy.fixed_joints == arm.fixed_joints
    assert arm != pw.Robot.from_urdf(text, fixed={"finger": 0.01})
    for wrong, words in [({"joint_1": 0.0, "finger": 0.0}, "joint_1.*one of the six axes"), ({"finger": 0.06}, "beyond its limits"), ({"finger": 0.0, "thumb": 0.0}, "no joint of that name")]:
        with pytest.raises(pw.UrdfError, match=words):
            pw.Robot.from_urdf(text, fixed=wrong)
    for bad in ["finger", {"finger": "0"}, {1: 0.0}, [("finger", 0.0)]]:
        with pytest.raises(TypeError, match="fixed"):
            pw.Robot.from_urdf(text, fixed=bad)  # type: ignore[arg-type]
