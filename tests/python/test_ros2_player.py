"""The player of ROS 2 goals: what it refuses, sends and says, with a stand-in for ROS."""

import importlib.util
import json
import subprocess
import sys
from pathlib import Path

import pytest
from ros_stand_in import with_ros, without_ros

NAMES = [f"joint_{k}" for k in range(1, 7)]
START = [0.1, 0.2, -0.3, 0.0, 1.5, 0.0]


def goal() -> dict:
    def point(q, qd, sec, nanosec):
        return {"positions": q, "velocities": qd, "time_from_start": {"sec": sec, "nanosec": nanosec}}

    points = [point(START, [0.0] * 6, 0, 500_000_000), point([v + 0.1 for v in START], [0.1] * 6, 1, 0), point([v + 0.2 for v in START], [0.0] * 6, 2, 1)]
    tolerances = [{"name": name, "position": 0.1} for name in NAMES]
    return {
        "trajectory": {"joint_names": NAMES, "points": points},
        "path_tolerance": tolerances,
        "goal_tolerance": [{"name": name, "position": 0.01} for name in NAMES],
        "goal_time_tolerance": {"sec": 1, "nanosec": 0},
    }


@pytest.fixture
def script(root):
    return root / "crates" / "export" / "src" / "ros2" / "play.py"


@pytest.fixture
def player(script, tmp_path, monkeypatch):
    """The player as a module, from a folder with a goal."""
    beside = tmp_path / "play.py"
    beside.write_text(script.read_text())
    (tmp_path / "follow_joint_trajectory.json").write_text(json.dumps(goal()))
    spec = importlib.util.spec_from_file_location("play", beside)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    module.PATIENCE_S = 0.05
    return module


@pytest.fixture
def stand(monkeypatch):
    stand = with_ros(monkeypatch)
    stand.states = [(NAMES[::-1], START[::-1])]
    return stand


def dry(script):
    return subprocess.run([sys.executable, str(script), "--dry"], capture_output=True, text=True)


def test_ignores_a_module_beside_the_script(player, tmp_path):
    for name in ("json", "argparse", "rclpy"):
        (tmp_path / f"{name}.py").write_text("raise SystemExit('taken')\n")
    done = dry(player.__file__)
    assert "3 points" in done.stdout and "taken" not in done.stdout + done.stderr, done


def test_a_link_to_the_script_sends_the_goal_beside_the_link(player, tmp_path):
    other = tmp_path / "other"
    other.mkdir()
    (other / "play.py").symlink_to(player.__file__)
    shorter = goal()
    shorter["trajectory"]["points"].pop()
    (other / "follow_joint_trajectory.json").write_text(json.dumps(shorter))
    assert "2 points" in dry(other / "play.py").stdout


def test_the_script_compiles_for_humble_and_imports_without_ros(script, player):
    compile(script.read_text(), "play.py", "exec", dont_inherit=True)
    done = subprocess.run([sys.executable, "-I", str(player.__file__), "--help"], capture_output=True, text=True, check=True)
    assert "--dry" in done.stdout and "--action" in done.stdout


def test_sends_the_stated_goal(player, stand, capsys):
    stand.feedback = [[0.0, 0.001, 0.0, 0.0, -0.02, 0.0]]
    assert player.main(["--action", "/arm/follow"]) == 0
    [sent] = stand.goals
    stated = goal()
    assert stand.actions == ["/arm/follow"] and sent.trajectory.joint_names == NAMES
    assert [p.positions for p in sent.trajectory.points] == [p["positions"] for p in stated["trajectory"]["points"]]
    assert [p.velocities for p in sent.trajectory.points] == [p["velocities"] for p in stated["trajectory"]["points"]]
    assert [(p.time_from_start.sec, p.time_from_start.nanosec) for p in sent.trajectory.points] == [(0, 500_000_000), (1, 0), (2, 1)]
    assert [(t.name, t.position) for t in sent.path_tolerance] == [(name, 0.1) for name in NAMES]
    assert [(t.name, t.position) for t in sent.goal_tolerance] == [(name, 0.01) for name in NAMES]
    assert (sent.goal_time_tolerance.sec, sent.goal_time_tolerance.nanosec) == (1, 0)
    said = capsys.readouterr().out
    assert "3 points" in said and "2.000 s" in said and "done: successful" in said and "joint_5 by -1.146 deg" in said
    assert not stand.alive


def test_a_dry_run_sends_nothing(player, stand, capsys):
    assert player.main(["--dry"]) == 0
    assert stand.goals == [] and "nothing was sent" in capsys.readouterr().out


@pytest.mark.parametrize(("joint", "off_deg", "refused"), [(2, 0.49, False), (2, -0.51, True), (5, 30.0, True)])
def test_the_start_is_compared_joint_by_joint(player, stand, capsys, joint, off_deg, refused):
    at = list(START)
    at[joint] += off_deg / 57.29577951308232
    stand.states = [(NAMES, at)]
    assert player.main([]) == (1 if refused else 0)
    assert len(stand.goals) == (0 if refused else 1)
    said = capsys.readouterr().err
    assert (f"joint_{joint + 1} is {off_deg:+.3f} deg" in said) == refused


def test_nan_positions_are_not_near_the_start(player, stand, capsys):
    stand.states = [(NAMES, [float("nan")] * 6)]
    assert player.main([]) == 1 and stand.goals == []


def test_combines_joint_states_that_come_in_parts(player, stand):
    stand.states = [(NAMES[:3], START[:3]), (["gripper"], [1.0]), (NAMES[3:], START[3:])]
    assert player.main([]) == 0


def test_reports_missing_joint_states(player, stand, capsys):
    stand.states = [(["joint_a"], [0.0])]
    assert player.main([]) == 1
    assert "heard of: joint_a" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"serves": False}, "nobody serves"),
        ({"accepts": False}, "refused the goal"),
        ({"status": 6, "error_code": -4, "error_string": "late"}, "path tolerance violated (-4) late"),
        ({"status": 5, "error_code": 0}, "did not succeed (status 5)"),
        ({"interrupts": [1]}, "cancelled"),
        ({"interrupts": [3]}, "cancelled"),
        ({"interrupts": [3, 4]}, "interrupted"),
    ],
)
def test_every_other_end_of_a_goal_is_a_failure(player, stand, capsys, change, words):
    vars(stand).update(change)
    assert player.main([]) == 1
    assert words in capsys.readouterr().err
    assert stand.cancelled == bool(stand.interrupts) and not stand.alive


def test_without_ros_nothing_counts_as_checked(player, monkeypatch, capsys):
    without_ros(monkeypatch)
    assert player.main(["--dry"]) == 1
    assert "not checked" in capsys.readouterr().err


def damaged(change) -> str:
    stated = goal()
    change(stated)
    return json.dumps(stated)


@pytest.mark.parametrize(
    "text",
    [
        "", "{", "[]", "null", "3",
        damaged(lambda g: g.pop("trajectory")),
        damaged(lambda g: g.pop("goal_time_tolerance")),
        damaged(lambda g: g["trajectory"]["points"].clear()),
        damaged(lambda g: g["trajectory"].update(joint_names=["a"] * 6)),
        damaged(lambda g: g["trajectory"]["points"][1]["positions"].pop()),
        damaged(lambda g: g["trajectory"]["points"][1]["velocities"].append(0.0)),
        damaged(lambda g: g["trajectory"]["points"][1]["positions"].__setitem__(0, float("nan"))),
        damaged(lambda g: g["trajectory"]["points"][1]["positions"].__setitem__(0, 1)),
        damaged(lambda g: g["trajectory"]["points"][1]["positions"].__setitem__(0, "0.1")),
        damaged(lambda g: g["trajectory"]["points"][2]["time_from_start"].update(sec=1, nanosec=0)),
        damaged(lambda g: g["trajectory"]["points"][0]["time_from_start"].update(nanosec=0)),
        damaged(lambda g: g["trajectory"]["points"][0]["time_from_start"].update(nanosec=10**9)),
        damaged(lambda g: g["trajectory"]["points"][0]["time_from_start"].update(sec=-1)),
        damaged(lambda g: g["path_tolerance"][0].update(name="nobody")),
        damaged(lambda g: g["path_tolerance"][0].update(position=None)),
    ],
)  # fmt: skip
def test_files_without_a_goal_are_refused_before_anything_else(player, stand, tmp_path, capsys, text):
    file = tmp_path / "other.json"
    file.write_text(text)
    assert player.main([str(file)]) == 2
    assert str(file) in capsys.readouterr().err and stand.goals == [] and not stand.alive


def test_reads_yaml_and_reports_a_missing_file(player, stand, tmp_path, capsys):
    file = tmp_path / "goal.yaml"
    file.write_text(json.dumps(goal()))
    assert player.main([str(file)]) == 0
    assert player.main([str(tmp_path / "none.json")]) == 2
    assert "none.json" in capsys.readouterr().err
    file.write_text("a: [")
    assert player.main([str(Path(file))]) == 2
