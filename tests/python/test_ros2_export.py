"""Plans in ROS 2, read by others' code: YAML, the controller's cubic, bags."""

import json
import pickle
from pathlib import Path

import numpy as np
import pytest
import pyplatewash as pw
import yaml
from pyplatewash import ros
from ros_stand_in import with_ros, without_ros
from ruamel.yaml import YAML
from wheel_plans import plan as planned

NAMES = ["joint_trajectory", "follow_joint_trajectory"]
NS = 10**9
LEAD_IN_NS = NS // 2


@pytest.fixture(scope="module")
def plan() -> pw.Plan:
    return planned(pw.Scenario.load("kitchen").replace(layout={"count": 1}))


@pytest.fixture(scope="module", params=[1.0, 0.3])
def share(request: pytest.FixtureRequest) -> float:
    return request.param


@pytest.fixture(scope="module")
def files(plan: pw.Plan, share: float) -> dict[str, str]:
    return plan.export("ros2", speed_share=share)


@pytest.fixture(scope="module")
def message(plan: pw.Plan, share: float) -> dict:
    return plan.to_joint_trajectory(share)


def nanoseconds(span: dict) -> int:
    return span["sec"] * NS + span["nanosec"]


def test_the_message_equals_the_plan(plan: pw.Plan, share: float, message: dict, files: dict[str, str]) -> None:
    trajectory = plan.trajectory
    assert list(files) == ["joint_trajectory.yaml", "joint_trajectory.json", "follow_joint_trajectory.yaml", "follow_joint_trajectory.json", "play.py"]
    assert message == json.loads(files["joint_trajectory.json"]) == json.loads(files["follow_joint_trajectory.json"])["trajectory"]
    assert set(message) == {"joint_names", "points"} and message["joint_names"] == [f"joint_{k}" for k in range(1, 7)]
    points = message["points"]
    assert len(points) == len(trajectory.t_s) and all(set(point) == {"positions", "velocities", "time_from_start"} for point in points)
    times = np.array([nanoseconds(point["time_from_start"]) - LEAD_IN_NS for point in points])
    np.testing.assert_allclose(times / NS, trajectory.t_s / share, rtol=0, atol=1e-9)
    assert (np.diff(times) > 0).all() and times[0] == 0
    np.testing.assert_allclose([point["positions"] for point in points], trajectory.q_rad, rtol=0, atol=1e-9)
    np.testing.assert_allclose([point["velocities"] for point in points], trajectory.qd_rad_s * share, rtol=0, atol=1e-9)
    assert files == plan.export("ros2", speed_share=share), "the same bytes"


@pytest.mark.parametrize("name", NAMES)
def test_yaml_1_1_and_1_2_read_the_values_of_json(name: str) -> None:
    one_plate = pw.Scenario.load("kitchen").replace(layout={"count": 1})
    files = planned(one_plate).export("ros2", speed_share=0.7)
    stated = json.loads(files[f"{name}.json"])
    newest = YAML(typ="safe", pure=True)
    newest.version = (1, 2)
    text = files[f"{name}.yaml"]
    for read in (yaml.safe_load(text), newest.load(text), yaml.safe_load(files[f"{name}.json"])):
        assert read == stated
        assert types(read) == types(stated)


def types(value: object) -> object:
    """Types all the way down: 1 is equal to 1.0, and ROS 2 takes one of them."""
    if isinstance(value, dict):
        return {key: types(inner) for key, inner in value.items()}
    if isinstance(value, list):
        return [types(inner) for inner in value]
    return type(value)


def controllers_cubic(message: dict, time_ns: int) -> tuple[np.ndarray, np.ndarray]:
    """What joint_trajectory_controller commands at a time after it took the goal: the cubic through both points' positions and speeds,
    by its coefficients, with its own way of telling segments: the left end belongs to a segment, the right one does not."""
    points = message["points"]
    stamps = [nanoseconds(point["time_from_start"]) for point in points]
    segment = next((k for k in range(len(points) - 1) if stamps[k] <= time_ns < stamps[k + 1]), None)
    if segment is None:
        return np.array(points[-1]["positions"]), np.array(points[-1]["velocities"])
    a, b = points[segment], points[segment + 1]
    duration, t = (stamps[segment + 1] - stamps[segment]) / NS, (time_ns - stamps[segment]) / NS
    p, q = np.array(a["positions"]), np.array(b["positions"])
    v, w = np.array(a["velocities"]), np.array(b["velocities"])
    square = (3 * (q - p) / duration - 2 * v - w) / duration
    cube = (2 * (p - q) / duration + v + w) / duration**2
    return p + v * t + square * t**2 + cube * t**3, v + 2 * square * t + 3 * cube * t**2


def test_the_cubic_of_the_controller_gives_the_motion_of_the_plan(plan: pw.Plan, share: float, message: dict) -> None:
    trajectory = plan.trajectory
    last_ns = nanoseconds(message["points"][-1]["time_from_start"])
    times_ns = np.random.default_rng(13).integers(LEAD_IN_NS, last_ns, 3000).tolist() + [LEAD_IN_NS, last_ns]
    drawn = [controllers_cubic(message, time_ns) for time_ns in times_ns]
    q_rad, qd_rad_s = (np.array(rows) for rows in zip(*drawn, strict=True))
    expected_q, expected_qd, _ = trajectory.at((np.array(times_ns) - LEAD_IN_NS) / NS * share)
    np.testing.assert_allclose(q_rad, expected_q, rtol=0, atol=1e-8)
    np.testing.assert_allclose(qd_rad_s, expected_qd * share, rtol=0, atol=1e-6)
    ours = ros.sample(message, np.array(times_ns) / NS)
    np.testing.assert_allclose(ours[0], q_rad, rtol=0, atol=1e-9)
    np.testing.assert_allclose(ours[1][:-2], qd_rad_s[:-2], rtol=0, atol=1e-6)


def test_a_bag_is_read_by_others(plan: pw.Plan, share: float, message: dict, tmp_path: Path) -> None:
    from mcap.reader import make_reader
    from mcap_ros2.decoder import DecoderFactory

    bag = ros.write_bag(message, tmp_path / "bag", rate_hz=20.0, start_ns=1_700_000_000 * NS)
    assert bag == tmp_path / "bag" and sorted(file.name for file in bag.iterdir()) == ["bag.mcap", "metadata.yaml"]
    assert [file.name for file in tmp_path.iterdir()] == ["bag"]
    metadata = yaml.safe_load((bag / "metadata.yaml").read_text())["rosbag2_bagfile_information"]
    assert metadata["storage_identifier"] == "mcap" and metadata["relative_file_paths"] == ["bag.mcap"]
    assert [entry["path"] for entry in metadata["files"]] == ["bag.mcap"]
    with (bag / "bag.mcap").open("rb") as stream:
        read = list(make_reader(stream, decoder_factories=[DecoderFactory()]).iter_decoded_messages())
    assert metadata["message_count"] == len(read)
    trajectories = [(raw, decoded) for _, channel, raw, decoded in read if channel.topic == "/joint_trajectory"]
    states = [(raw, decoded) for _, channel, raw, decoded in read if channel.topic == "/joint_states"]
    assert {schema.name for schema, *_ in read} == {"trajectory_msgs/msg/JointTrajectory", "sensor_msgs/msg/JointState"}
    [(raw, decoded)] = trajectories
    assert raw.log_time == 1_700_000_000 * NS and (decoded.header.stamp.sec, decoded.header.stamp.nanosec) == (0, 0)
    assert list(decoded.joint_names) == message["joint_names"] and len(decoded.points) == len(message["points"])
    for point, stated in zip(decoded.points, message["points"], strict=True):
        assert list(point.positions) == stated["positions"] and list(point.velocities) == stated["velocities"]
        assert list(point.accelerations) == list(point.effort) == []
        assert (point.time_from_start.sec, point.time_from_start.nanosec) == tuple(stated["time_from_start"].values())
    last_ns = nanoseconds(message["points"][-1]["time_from_start"])
    since = [raw.log_time - 1_700_000_000 * NS for raw, _ in states]
    assert since[0] == LEAD_IN_NS and since[-1] == last_ns and max(np.diff(since)) <= NS // 20 + 1
    for (raw, state), time_ns in list(zip(states, since, strict=True))[::7]:
        assert state.header.stamp.sec * NS + state.header.stamp.nanosec == raw.log_time
        q_rad, qd_rad_s = controllers_cubic(message, time_ns)
        assert list(state.name) == message["joint_names"] and list(state.effort) == []
        np.testing.assert_allclose(state.position, q_rad, rtol=0, atol=1e-9)
        np.testing.assert_allclose(state.velocity, qd_rad_s, rtol=0, atol=1e-6)


def test_the_same_plan_gives_the_same_bag(plan: pw.Plan, tmp_path: Path) -> None:
    folders = [tmp_path / "a", tmp_path / "b"]
    for folder in folders:
        folder.mkdir()
    first, second = ros.write_bag(plan, folders[0] / "bag"), ros.write_bag(plan.to_joint_trajectory(), folders[1] / "bag")
    assert (first / "bag.mcap").read_bytes() == (second / "bag.mcap").read_bytes()


SHORT = {
    "joint_names": ["a", "b"],
    "points": [
        {"positions": [0.0, 0.0], "velocities": [0.0, 0.0], "time_from_start": {"sec": 1, "nanosec": 0}},
        {"positions": [1.0, -1.0], "velocities": [0.0, 0.0], "time_from_start": {"sec": 3, "nanosec": 0}},
    ],
}


def changed(**point: object) -> dict:
    return {**SHORT, "points": [SHORT["points"][0], {**SHORT["points"][1], **point}]}


@pytest.mark.parametrize(
    "message",
    [
        {}, {"joint_names": ["a"]}, {**SHORT, "joint_names": ["a"]}, {**SHORT, "joint_names": ["a", "a"]}, {**SHORT, "joint_names": []}, {**SHORT, "points": []},
        {**SHORT, "points": 3}, changed(positions=[1.0]), changed(velocities=[]), changed(positions=[float("nan"), 0.0]), changed(positions=["x", 0.0]),
        changed(time_from_start={"sec": 1, "nanosec": 0}), changed(time_from_start={"sec": 3, "nanosec": NS}), changed(time_from_start={"sec": -3, "nanosec": 0}),
        changed(time_from_start={"sec": 3.0, "nanosec": 0}), changed(time_from_start={"sec": 2**31, "nanosec": 0}), changed(time_from_start={}),
    ],
)  # fmt: skip
def test_rejects_invalid_messages(message: dict, tmp_path: Path) -> None:
    for call in (lambda: ros.write_bag(message, tmp_path / "bag"), lambda: ros.sample(message, [0.0]), lambda: ros.to_message(message)):
        with pytest.raises(pw.InputError, match="^plan: no JointTrajectory: ") as caught:
            call()
        assert caught.value.argument == "plan"
    assert list(tmp_path.iterdir()) == []


def test_bad_arguments_are_refused_by_name_and_nothing_is_left(tmp_path: Path) -> None:
    for name, values in {
        "rate_hz": [0.0, -1.0, float("nan"), float("inf"), "50", None, True, 1e9],
        "start_ns": [-1, 2**63, 1.5, None, True],
        "trajectory_topic": [3, None, "/joint_states"],
        "states_topic": [3],
    }.items():
        for value in values:
            with pytest.raises((pw.InputError, pw.InputTypeError), match=f"^({name}|states_topic): "):
                ros.write_bag(SHORT, tmp_path / "bag", **{name: value})
    long = changed(time_from_start={"sec": 2**30, "nanosec": 0})
    with pytest.raises(pw.InputError, match="^rate_hz: "):
        ros.write_bag(long, tmp_path / "bag", rate_hz=10_000.0)
    with pytest.raises(pw.InputTypeError, match="^plan: "):
        ros.write_bag(3, tmp_path / "bag")
    with pytest.raises(pw.InputTypeError, match="^path: "):
        ros.write_bag(SHORT, 3)
    with pytest.raises(pw.InputTypeError, match="^t_s: "):
        ros.sample(SHORT, "now")
    for times in ([float("nan")], [[0.0]]):
        with pytest.raises(pw.InputError, match="^t_s: "):
            ros.sample(SHORT, times)
    assert list(tmp_path.iterdir()) == []
    (tmp_path / "bag").mkdir()
    with pytest.raises(pw.FileError, match="it is there already") as caught:
        ros.write_bag(SHORT, tmp_path / "bag")
    assert caught.value.filename == str(tmp_path / "bag")
    with pytest.raises(FileNotFoundError):
        ros.write_bag(SHORT, tmp_path / "none" / "bag")
    assert [file.name for file in tmp_path.iterdir()] == ["bag"]


def test_samples_rest_before_and_after(tmp_path: Path) -> None:
    q_rad, qd_rad_s = ros.sample(SHORT, [0.0, 2.0, 9.0])
    np.testing.assert_allclose(q_rad, [[0.0, 0.0], [0.5, -0.5], [1.0, -1.0]])
    np.testing.assert_allclose(qd_rad_s, [[0.0, 0.0], [0.75, -0.75], [0.0, 0.0]])


def test_a_message_needs_ros(monkeypatch: pytest.MonkeyPatch) -> None:
    without_ros(monkeypatch)
    with pytest.raises(pw.MissingError) as caught:
        ros.to_message(SHORT)
    assert caught.value.name == "ros2"
    with_ros(monkeypatch)
    message = ros.to_message(SHORT)
    assert message.joint_names == ["a", "b"] and message.points[1].positions == [1.0, -1.0] and message.points[1].velocities == [0.0, 0.0]
    assert (message.points[1].time_from_start.sec, message.points[1].time_from_start.nanosec) == (3, 0)


def test_a_bag_needs_rosbags(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setitem(__import__("sys").modules, "rosbags.rosbag2", None)
    with pytest.raises(pw.MissingError, match=r"pyplatewash\[ros\]") as caught:
        ros.write_bag(SHORT, tmp_path / "bag")
    assert caught.value.name == "rosbags" and list(tmp_path.iterdir()) == []


def test_files_are_written_all_or_none(plan: pw.Plan, tmp_path: Path) -> None:
    out = tmp_path / "robot"
    with pytest.raises(FileNotFoundError) as missing:
        plan.export("ros2", out / "new")
    assert isinstance(missing.value, pw.FileError) and list(tmp_path.iterdir()) == []
    files = plan.export("ros2", out)
    assert {file.name: file.read_bytes().decode() for file in out.iterdir()} == files
    before = {file.name: file.read_bytes() for file in out.iterdir()}
    (out / "play.py").unlink()
    (out / "play.py").mkdir()
    with pytest.raises(pw.FileError, match=r"play\.py: cannot be written: there is a folder") as caught:
        plan.export("ros2", out, speed_share=0.5)
    assert caught.value.filename == str(out / "play.py")
    assert {file.name: file.read_bytes() for file in out.iterdir() if file.is_file()} == {k: v for k, v in before.items() if k != "play.py"}


def test_states_why_a_program_is_not_exported(plan: pw.Plan) -> None:
    start = plan.trajectory.q_rad[0]
    assert plan.export("ros2", stands_rad=start + np.radians(0.4)) == plan.export("ros2")
    away = start.copy()
    away[2] += np.radians(0.6)
    with pytest.raises(pw.ExportError, match=r"joint 3 stands at 0\.6000°") as caught:
        plan.export("ros2", stands_rad=away)
    assert caught.value.code == "start"
    again = pickle.loads(pickle.dumps(caught.value))
    assert (type(again), str(again), again.code) == (pw.ExportError, str(caught.value), "start")
    with pytest.raises(pw.ExportError) as caught:
        plan.export("ros2", tip=np.eye(4))
    assert caught.value.code == "frame"
    with pytest.raises(pw.ExportError) as caught:
        pw.run_paper(pw.Scenario.load("paper-appendix").paper_job()).plan().to_joint_trajectory()
    assert caught.value.code == "uncertified"
    # A plan that was changed and sealed no more.
    text = plan.to_json()
    knot = repr(float(plan.trajectory.t_s[5]))
    assert knot in text
    with pytest.raises(pw.ExportError) as caught:
        pw.Plan.from_json(text.replace(knot, knot[:-1], 1)).export("ros2")
    assert caught.value.code == "uncertified"
    wrong = {"speed_share": 1.5, "tolerance_m": -1.0, "corner_m": float("nan"), "accept": ["nothing"], "joint_3": "with-joint-2"}
    for name, value in wrong.items():
        with pytest.raises(pw.InputError, match=f"^{name}") as refused:
            plan.export("ros2", **{name: value})
        assert refused.value.argument is not None and refused.value.argument.startswith(name)
    with pytest.raises(pw.InputError, match='^to: one of .*"ros2"'):
        plan.export("karel")
