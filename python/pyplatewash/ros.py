"""Plans in ROS 2: messages where ROS is at hand, bags where it is not.

``Plan.to_joint_trajectory()`` gives a ``trajectory_msgs/JointTrajectory`` in plain dictionaries and lists. This module takes such a
dictionary, or the plan itself. ``write_bag`` needs rosbags (``pip install 'pyplatewash[ros]'``) and no ROS; ``to_message`` needs ROS 2's
Python packages.
"""

from __future__ import annotations

import math
import os
import secrets
import shutil
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ._core import Plan
from ._errors import InputError, InputTypeError, MissingError, ProgramFileError, ProgramNotFoundError
from ._files import not_written

__all__ = ["sample", "to_message", "write_bag"]

_NO_ROSBAGS = "a bag needs rosbags, which is not installed: pip install 'pyplatewash[ros]'"
_NO_ROS = "a message needs ROS 2's Python packages, which are not at hand: source an installation of ROS 2 first"

#: Nanoseconds of a second.
_NS = 10**9

#: Rates of samples that are believed [Hz].
_RATES_HZ = (0.1, 10_000.0)

#: Most samples of a bag.
_MOST_SAMPLES = 1_000_000

_Array = npt.NDArray[np.float64]


def to_message(plan: Plan | dict[str, Any]) -> Any:
    """A ``trajectory_msgs.msg.JointTrajectory`` of a plan, or of what its ``to_joint_trajectory()`` gave.

    Raises MissingError, an ImportError, without ROS 2; InputError for what is no such message.
    """
    knots = _Knots(_given(plan))
    try:
        messages: Any = import_module("trajectory_msgs.msg")
    except ImportError as error:
        raise MissingError(_NO_ROS, name="ros2") from error
    message = messages.JointTrajectory()
    message.joint_names = list(knots.names)
    for q_rad, qd_rad_s, time_ns in zip(knots.q_rad, knots.qd_rad_s, knots.t_ns, strict=True):
        point = messages.JointTrajectoryPoint()
        point.positions = q_rad.tolist()
        point.velocities = qd_rad_s.tolist()
        point.time_from_start.sec, point.time_from_start.nanosec = divmod(time_ns, _NS)
        message.points.append(point)
    return message


def sample(plan: Plan | dict[str, Any], t_s: npt.ArrayLike) -> tuple[_Array, _Array]:
    """Positions [rad] and speeds [rad/s] that joint_trajectory_controller draws between the points, shapes (N, joints), at the times
    ``t_s`` after the goal is taken [s]. Before the first point and after the last one the arm rests there.

    Raises InputError for what is no such message, or times that are not finite.
    """
    try:
        times_s = np.atleast_1d(np.asarray(t_s, dtype=float))
    except (TypeError, ValueError) as error:
        raise InputTypeError(f"t_s: an array of real numbers is needed; found a value of type {type(t_s).__name__}", argument="t_s") from error
    if times_s.ndim != 1 or not np.isfinite(times_s).all():
        raise InputError("t_s: finite numbers in one row are needed", argument="t_s")
    return _Knots(_given(plan)).at(times_s)


def write_bag(
    plan: Plan | dict[str, Any],
    path: str | os.PathLike[str],
    *,
    rate_hz: float = 50.0,
    start_ns: int = 0,
    trajectory_topic: str = "/joint_trajectory",
    states_topic: str = "/joint_states",
) -> Path:
    """Writes a plan, or what its ``to_joint_trajectory()`` gave, as a bag of ROS 2 in the MCAP format: a new folder at ``path``.

    In it are the ``trajectory_msgs/JointTrajectory``, and what the arm does on it as ``sensor_msgs/JointState``, ``rate_hz`` times a second
    [Hz], from the first point to the last: Foxglove, rerun and others play these. The bag begins at ``start_ns`` [ns] after the epoch; the same
    arguments give the same messages. Gives the folder.

    Raises MissingError, an ImportError, without rosbags; InputError; FileError where the folder is there already or cannot be
    written, and then nothing is left behind.
    """
    knots = _Knots(_given(plan))
    if not isinstance(path, (str, os.PathLike)):
        raise InputTypeError(f"path: a path is needed; found a value of type {type(path).__name__}", argument="path")
    rate = _number("rate_hz", rate_hz)
    if not _RATES_HZ[0] <= rate <= _RATES_HZ[1]:
        raise InputError(f"rate_hz: a number from {_RATES_HZ[0]} to {_RATES_HZ[1]:.0f} is needed; found {rate_hz!r}", argument="rate_hz")
    samples = (knots.t_ns[-1] - knots.t_ns[0]) / _NS * rate
    if samples > _MOST_SAMPLES:
        raise InputError(f"rate_hz: at most {_MOST_SAMPLES} samples are written; {rate_hz} Hz would give {samples:.0f}", argument="rate_hz")
    # Times in messages are 32-bit seconds.
    latest_ns = (2**31 - 1) * _NS - knots.t_ns[-1]
    if isinstance(start_ns, bool) or not isinstance(start_ns, int):
        raise InputTypeError(f"start_ns: an integer is needed; found a value of type {type(start_ns).__name__}", argument="start_ns")
    if not 0 <= start_ns <= latest_ns:
        raise InputError(f"start_ns: an integer from 0 to {latest_ns} is needed; found {start_ns}", argument="start_ns")
    for name, topic in (("trajectory_topic", trajectory_topic), ("states_topic", states_topic)):
        if not isinstance(topic, str):
            raise InputTypeError(f"{name}: a topic's name is needed; found a value of type {type(topic).__name__}", argument=name)
    if trajectory_topic == states_topic:
        raise InputError("states_topic: another name than that of trajectory_topic is needed", argument="states_topic")
    try:
        import rosbags.rosbag2  # noqa: F401
    except ModuleNotFoundError as error:
        if error.name is None or error.name.split(".")[0] != "rosbags":
            raise
        raise MissingError(_NO_ROSBAGS, name="rosbags") from error
    place = Path(path)
    staged = place.parent / f".platewash-{secrets.token_hex(8)}"
    try:
        if place.exists():
            raise FileExistsError(None, "it is there already")
        staged.mkdir()
        # The file in a bag is called after its folder, in its own summary, too.
        _write(knots, staged / place.name, rate, start_ns, (trajectory_topic, states_topic))
        (staged / place.name).rename(place)
    except (OSError, ValueError) as error:
        raise not_written(os.fspath(path), error, ProgramNotFoundError, ProgramFileError) from error
    finally:
        shutil.rmtree(staged, ignore_errors=True)
    return place


def _write(knots: _Knots, folder: Path, rate_hz: float, start_ns: int, topics: tuple[str, str]) -> None:
    from rosbags.rosbag2 import StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore

    # Of these messages Humble's definitions are those of all later ones.
    store = get_typestore(Stores.ROS2_HUMBLE)
    types: Any = store.types
    duration, stamp = types["builtin_interfaces/msg/Duration"], types["builtin_interfaces/msg/Time"]
    trajectory, state = types["trajectory_msgs/msg/JointTrajectory"], types["sensor_msgs/msg/JointState"]

    def header(time_ns: int) -> Any:
        return types["std_msgs/msg/Header"](stamp=stamp(*divmod(time_ns, _NS)), frame_id="")

    nothing = np.zeros(0)
    points = [
        types["trajectory_msgs/msg/JointTrajectoryPoint"](q_rad, qd_rad_s, nothing, nothing, duration(*divmod(time_ns, _NS)))
        for q_rad, qd_rad_s, time_ns in zip(knots.q_rad, knots.qd_rad_s, knots.t_ns, strict=True)
    ]
    # Version 8 of the metadata: the older of those that the writer knows.
    with Writer(folder, version=8, storage_plugin=StoragePlugin.MCAP) as bag:
        connections = [
            bag.add_connection(topic, kind.__msgtype__, typestore=store) for topic, kind in zip(topics, (trajectory, state), strict=True)
        ]
        # At 0 s of the clock it begins at once, whatever the clock of whoever plays it says.
        message = trajectory(header(0), list(knots.names), points)
        bag.write(connections[0], start_ns, store.serialize_cdr(message, message.__msgtype__))
        times_ns = knots.every(1.0 / rate_hz)
        rows = zip(times_ns, *knots.at(np.array(times_ns) / _NS), strict=True)
        for time_ns, q_rad, qd_rad_s in rows:
            message = state(header(start_ns + time_ns), list(knots.names), q_rad, qd_rad_s, nothing)
            bag.write(connections[1], start_ns + time_ns, store.serialize_cdr(message, message.__msgtype__))


def _given(plan: Any) -> Any:
    return plan.to_joint_trajectory() if isinstance(plan, Plan) else plan


def _number(name: str, value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise InputTypeError(f"{name}: a number is needed; found a value of type {type(value).__name__}", argument=name)
    return float(value)


class _Knots:
    """The points of a message, as arrays."""

    def __init__(self, message: Any) -> None:
        if not isinstance(message, dict):
            needed = "a Plan, or a dictionary as its to_joint_trajectory() gives it, is needed"
            raise InputTypeError(f"plan: {needed}; found a value of type {type(message).__name__}", argument="plan")
        try:
            self.names: list[str] = list(message["joint_names"])
            points = list(message["points"])
            self.t_ns: list[int] = [_nanoseconds(point["time_from_start"]) for point in points]
            self.q_rad: _Array = np.array([point["positions"] for point in points], dtype=float)
            self.qd_rad_s: _Array = np.array([point["velocities"] for point in points], dtype=float)
        except (KeyError, IndexError, TypeError, ValueError) as error:
            raise _no_message(f"{type(error).__name__}: {error}") from error
        shape = (len(points), len(self.names))
        if not points or not self.names or any(not isinstance(name, str) for name in self.names) or len(set(self.names)) < len(self.names):
            raise _no_message("points, and names of joints, each once, are needed")
        if self.q_rad.shape != shape or self.qd_rad_s.shape != shape:
            raise _no_message(f"{shape[1]} positions and as many velocities are needed in each of {shape[0]} points")
        if not (np.isfinite(self.q_rad).all() and np.isfinite(self.qd_rad_s).all()):
            raise _no_message("positions and velocities must be finite")
        late = next((k for k in range(1, len(points)) if self.t_ns[k] <= self.t_ns[k - 1]), None)
        if late is not None:
            raise _no_message(f"time_from_start of point {late} must be after that of the point before it")

    def every(self, step_s: float) -> list[int]:
        """Times from the first point to the last, both among them [ns]."""
        first, last = self.t_ns[0], self.t_ns[-1]
        count = math.ceil((last - first) / (step_s * _NS))
        return [first + round(k * step_s * _NS) for k in range(count)] + [last]

    def at(self, t_s: _Array) -> tuple[_Array, _Array]:
        """Positions and speeds, of the cubic that has those of both points beside it."""
        times_s = np.array(self.t_ns) / _NS
        if len(times_s) == 1:
            return np.repeat(self.q_rad, len(t_s), axis=0), np.zeros((len(t_s), len(self.names)))
        inside = np.clip(t_s, times_s[0], times_s[-1])
        k = np.clip(np.searchsorted(times_s, inside, side="right") - 1, 0, len(times_s) - 2)
        h = (times_s[k + 1] - times_s[k])[:, None]
        s = (inside - times_s[k])[:, None] / h
        q, step, v, w = self.q_rad[k], self.q_rad[k + 1] - self.q_rad[k], h * self.qd_rad_s[k], h * self.qd_rad_s[k + 1]
        # q + s v + s² (3 step − 2 v − w) + s³ (v + w − 2 step)
        a, b = 3.0 * step - 2.0 * v - w, v + w - 2.0 * step
        resting = (t_s != inside)[:, None]
        return q + s * (v + s * (a + s * b)), np.where(resting, 0.0, (v + s * (2.0 * a + s * 3.0 * b)) / h)


def _nanoseconds(span: Any) -> int:
    sec, nanosec = span["sec"], span["nanosec"]
    if type(sec) is not int or type(nanosec) is not int or not (0 <= sec < 2**31 and 0 <= nanosec < _NS):
        raise ValueError(f"sec and nanosec must be whole numbers from 0, nanosec below 1e9; found {sec!r} and {nanosec!r}")
    return sec * _NS + nanosec


def _no_message(problem: str) -> InputError:
    return InputError(f"plan: no JointTrajectory: {problem}", argument="plan")
