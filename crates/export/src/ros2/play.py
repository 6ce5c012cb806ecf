#!/usr/bin/env python3
"""Sends the goal beside this script to a joint_trajectory_controller (ROS 2, Humble and later).

    python3 play.py --dry     says what would be sent and whether the arm stands at its start; sends nothing
    python3 play.py           does the same, then sends the goal and waits for what comes of it; Ctrl-C cancels it

The goal is refused, with the joint and the difference, where the arm stands more than 0.5 degrees from its first point. Ends with
0 where the goal succeeded, 1 where it was refused, aborted or cancelled, or could not be checked, 2 for a file that holds no goal.
"""

import sys

# A module of that name beside this script would be taken for Python's own.
if __name__ == "__main__" and not sys.flags.isolated and not getattr(sys.flags, "safe_path", False):
    del sys.path[0]

import argparse
import json
import math
import time
from pathlib import Path

ACTION = "/joint_trajectory_controller/follow_joint_trajectory"
GOAL = "follow_joint_trajectory.json"

# How far a joint may stand from the first point [deg].
MOST_DEG = 0.5

# How long is waited for joint states, for the server, for its word on a goal and for its word on a cancelled one [s].
PATIENCE_S = 5.0

# The least time between two lines on the way [s].
SAY_EVERY_S = 1.0

# What the result's error codes mean.
ERRORS = {
    0: "successful",
    -1: "invalid goal",
    -2: "invalid joints",
    -3: "old header timestamp",
    -4: "path tolerance violated",
    -5: "goal tolerance violated",
}

# action_msgs/GoalStatus.STATUS_SUCCEEDED
SUCCEEDED = 4


class Refused(Exception):
    """The goal is not sent, or not carried out: 1."""


class NoGoal(Exception):
    """The file holds no goal: 2."""


def load(path):
    """The goal of a JSON or YAML file."""
    path = Path(path)
    try:
        text = path.read_text(encoding="utf-8")
        if path.suffix == ".json":
            goal = json.loads(text)
        else:
            import yaml  # ROS 2 brings it along.

            goal = yaml.safe_load(text)
    except (OSError, ValueError) as error:
        raise NoGoal(f"{path}: cannot be read: {error}") from error
    except Exception as error:  # yaml.YAMLError, of a module that may be missing
        raise NoGoal(f"{path}: is no YAML that can be read: {error}") from error
    try:
        check(goal)
    except (AttributeError, KeyError, IndexError, TypeError, ValueError) as error:
        raise NoGoal(f"{path}: holds no FollowJointTrajectory goal: {type(error).__name__}: {error}") from error
    return goal


def check(goal):
    """Refuses what is no goal: the controller checks the rest."""
    trajectory = goal["trajectory"]
    names, points = trajectory["joint_names"], trajectory["points"]
    if not names or not points or len(set(names)) != len(names):
        raise ValueError("joint_names and points must not be empty, nor names the same")
    before = 0
    for index, point in enumerate(points):
        for row in (point["positions"], point["velocities"]):
            if len(row) != len(names) or not all(type(value) is float and math.isfinite(value) for value in row):
                raise ValueError(f"point {index}: a finite float for each of {len(names)} joints is needed")
        span = nanoseconds(point["time_from_start"])
        if span <= before:
            raise ValueError(f"point {index}: times must increase, from above 0")
        before = span
    for tolerance in goal["path_tolerance"] + goal["goal_tolerance"]:
        if tolerance["name"] not in names or type(tolerance["position"]) is not float:
            raise ValueError("a tolerance must name a joint and state a float")
    nanoseconds(goal["goal_time_tolerance"])


def nanoseconds(span):
    """A duration [ns]."""
    sec, nanosec = span["sec"], span["nanosec"]
    if type(sec) is not int or type(nanosec) is not int or sec < 0 or not 0 <= nanosec < 10**9:
        raise ValueError(f"sec and nanosec must be whole numbers, nanosec below 1e9; found {sec} and {nanosec}")
    return sec * 10**9 + nanosec


def summary(goal):
    """What the goal is, in a sentence."""
    trajectory = goal["trajectory"]
    points = trajectory["points"]
    duration_s = nanoseconds(points[-1]["time_from_start"]) / 1e9
    lead_in_s = nanoseconds(points[0]["time_from_start"]) / 1e9
    return (
        f"{len(points)} points for {', '.join(trajectory['joint_names'])}; {duration_s:.3f} s, of which {lead_in_s:.3f} s lead to the first"
    )


def off_start(goal, stands_rad):
    """How far each joint stands from the first point [deg], for positions by name [rad]."""
    trajectory = goal["trajectory"]
    names, first = trajectory["joint_names"], trajectory["points"][0]["positions"]
    missing = [name for name in names if name not in stands_rad]
    if missing:
        raise Refused(f"the joint states do not name {', '.join(missing)}; they name {', '.join(sorted(stands_rad))}")
    return {name: math.degrees(stands_rad[name] - start) for name, start in zip(names, first)}


def check_start(goal, stands_rad, most_deg=MOST_DEG):
    """Refuses a goal that does not begin where the arm stands."""
    off = off_start(goal, stands_rad)
    far = [f"{name} is {deg:+.3f} deg from it" for name, deg in off.items() if not abs(deg) <= most_deg]
    if far:
        raise Refused(f"the arm does not stand at the start, within {most_deg} deg: {'; '.join(far)}. Move it there first.")
    return max(off.values(), key=abs)


def message(goal):
    """The goal as ROS's message."""
    from control_msgs.action import FollowJointTrajectory
    from control_msgs.msg import JointTolerance
    from trajectory_msgs.msg import JointTrajectoryPoint

    sent = FollowJointTrajectory.Goal()
    trajectory = goal["trajectory"]
    sent.trajectory.joint_names = list(trajectory["joint_names"])
    points = []
    for stated in trajectory["points"]:
        point = JointTrajectoryPoint()
        point.positions = list(stated["positions"])
        point.velocities = list(stated["velocities"])
        point.time_from_start.sec = stated["time_from_start"]["sec"]
        point.time_from_start.nanosec = stated["time_from_start"]["nanosec"]
        points.append(point)
    sent.trajectory.points = points
    for field in ("path_tolerance", "goal_tolerance"):
        tolerances = []
        for stated in goal[field]:
            tolerance = JointTolerance()
            tolerance.name = stated["name"]
            tolerance.position = stated["position"]
            tolerances.append(tolerance)
        setattr(sent, field, tolerances)
    sent.goal_time_tolerance.sec = goal["goal_time_tolerance"]["sec"]
    sent.goal_time_tolerance.nanosec = goal["goal_time_tolerance"]["nanosec"]
    return sent


def joint_states(node, topic, names):
    """Positions by name [rad], from the first message that came after asking and holds all the names."""
    import rclpy
    from rclpy.qos import qos_profile_sensor_data
    from sensor_msgs.msg import JointState

    stands = {}

    def keep(state):
        stands.update(zip(state.name, state.position))

    subscription = node.create_subscription(JointState, topic, keep, qos_profile_sensor_data)
    until = time.monotonic() + PATIENCE_S
    try:
        while not all(name in stands for name in names):
            if time.monotonic() > until:
                raise Refused(f"no joint states of all joints on {topic} for {PATIENCE_S} s; heard of: {', '.join(sorted(stands)) or 'none'}")
            rclpy.spin_once(node, timeout_sec=0.1)
    finally:
        node.destroy_subscription(subscription)
    return stands


def largest_error(feedback):
    """The joint that is farthest from where it shall be, and how far [deg]."""
    errors = zip(feedback.joint_names, feedback.error.positions)
    name, error = max(errors, key=lambda both: abs(both[1]), default=("none", 0.0))
    return name, math.degrees(error)


class Teller:
    """Says every second how far the arm is behind, and remembers the worst."""

    def __init__(self, say=print, clock=time.monotonic):
        self.say, self.clock = say, clock
        self.said, self.worst = -math.inf, ("none", 0.0)

    def __call__(self, feedback_message):
        name, deg = largest_error(feedback_message.feedback)
        if abs(deg) > abs(self.worst[1]):
            self.worst = (name, deg)
        if self.clock() >= self.said + SAY_EVERY_S:
            self.said = self.clock()
            self.say(f"on the way: {name} is {deg:+.3f} deg off")


def done(node, future, patience_s=math.inf):
    """Waits until something is known, and says whether it is. In short steps, so that Ctrl-C is heard."""
    import rclpy

    until = time.monotonic() + patience_s
    while not future.done() and time.monotonic() < until:
        rclpy.spin_once(node, timeout_sec=0.1)
    return future.done()


def ending(node, accepting):
    """What came of a goal that was sent."""
    if not done(node, accepting, PATIENCE_S):
        raise Refused("the controller did not answer; it may have taken the goal all the same")
    handle = accepting.result()
    if not handle.accepted:
        raise Refused("the controller refused the goal; its log says why")
    print("the controller took the goal")
    result = handle.get_result_async()
    done(node, result)
    return result.result()


def cancel(node, accepting):
    """Cancels a goal that was sent, taken or about to be."""
    if not done(node, accepting, PATIENCE_S):
        raise Refused("the controller did not answer, and nothing could be cancelled: the arm may be moving")
    handle = accepting.result()
    if handle.accepted and not done(node, handle.cancel_goal_async(), PATIENCE_S):
        raise Refused("the controller did not answer that it cancels: the arm may be moving")


def send(node, action, goal):
    """Sends a goal and waits for what comes of it."""
    from control_msgs.action import FollowJointTrajectory
    from rclpy.action import ActionClient

    client = ActionClient(node, FollowJointTrajectory, action)
    if not client.wait_for_server(timeout_sec=PATIENCE_S):
        raise Refused(f"nobody serves the action {action}; `ros2 action list` names those that there are")
    teller = Teller()
    accepting = client.send_goal_async(message(goal), feedback_callback=teller)
    try:
        told = ending(node, accepting)
    except KeyboardInterrupt:
        cancel(node, accepting)
        raise Refused("cancelled") from None
    name, deg = teller.worst
    code = told.result.error_code
    words = f"{ERRORS.get(code, 'unknown code')} ({code}) {told.result.error_string}".rstrip()
    ended = f"{words}; farthest off, as far as feedback says: {name} by {deg:+.3f} deg"
    if told.status != SUCCEEDED or code != 0:
        raise Refused(f"the goal did not succeed (status {told.status}): {ended}")
    print(f"done: {ended}")


def play(goal, arguments):
    """Checks the start, and sends the goal unless it is a dry run."""
    try:
        import rclpy
        from rclpy.signals import SignalHandlerOptions
    except ImportError as error:
        raise Refused(f"the start was not checked and nothing was sent: {error}; source ROS 2 first") from error
    # Ctrl-C is heard here, and not by rclpy, which would stop before the goal could be cancelled.
    rclpy.init(args=[], signal_handler_options=SignalHandlerOptions.NO)
    try:
        node = rclpy.create_node("platewash_player")
        try:
            stands = joint_states(node, arguments.joint_states, goal["trajectory"]["joint_names"])
            print(f"the arm stands at the start, {abs(check_start(goal, stands)):.3f} deg away at most")
            if arguments.dry:
                print("dry run: nothing was sent")
            else:
                send(node, arguments.action, goal)
        finally:
            node.destroy_node()
    finally:
        rclpy.try_shutdown()


def main(arguments=None):
    """The script; gives its exit code."""
    parser = argparse.ArgumentParser(description="Sends a FollowJointTrajectory goal to a joint_trajectory_controller.")
    parser.add_argument("goal", nargs="?", default=Path(__file__).absolute().parent / GOAL, help=f"JSON or YAML, by default {GOAL}")
    parser.add_argument("--action", default=ACTION, help="the controller's action, by default %(default)s")
    parser.add_argument("--joint-states", default="/joint_states", help="where the arm's state is heard, by default %(default)s")
    parser.add_argument("--dry", action="store_true", help="check, and send nothing")
    arguments = parser.parse_args(arguments)
    try:
        goal = load(arguments.goal)
        print(summary(goal))
        play(goal, arguments)
    except (Refused, NoGoal) as error:
        print(f"play.py: {error}", file=sys.stderr)
        return 2 if isinstance(error, NoGoal) else 1
    except KeyboardInterrupt:
        print("play.py: interrupted; if a goal was sent, the arm may be moving", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
