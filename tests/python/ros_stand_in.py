"""As much of ROS 2's Python packages as the player uses, for tests without ROS: a controller and an arm that are scripted."""

import sys
import types
from typing import Any


class Stand:
    """What the stand-in does, and what it heard."""

    def __init__(self) -> None:
        self.states: list[tuple[list[str], list[float]]] = []
        self.serves = True
        self.accepts = True
        self.status, self.error_code, self.error_string = 4, 0, ""
        self.interrupts: list[int] = []  # at which of the spins after a goal was sent
        self.spins = 0
        self.feedback: list[list[float]] = []
        self.goals: list[Any] = []
        self.actions: list[str] = []
        self.cancelled = 0
        self.alive = False

    def modules(self) -> dict[str, types.ModuleType]:
        """The modules, by name."""
        stand = self

        class Message:
            """Any message: fields come into being when they are named."""

            def __getattr__(self, name: str) -> Any:
                if name.startswith("__"):
                    raise AttributeError(name)
                made = Message()
                setattr(self, name, made)
                return made

        class Future:
            def __init__(self, value: Any, patience: int = 2) -> None:
                self.value, self.patience = value, patience

            def done(self) -> bool:
                return self.patience <= 0

            def result(self) -> Any:
                return self.value

        waiting: list[Future] = []

        def spin_once(node: Any, timeout_sec: float) -> None:
            assert timeout_sec <= 0.1 and stand.alive
            for future in waiting:
                future.patience -= 1
            if stand.states and node.subscriptions:
                names, positions = stand.states.pop(0)
                state = Message()
                state.name, state.position = names, positions
                node.subscriptions[-1](state)
            if stand.goals:
                stand.spins += 1
                if stand.spins in stand.interrupts:
                    raise KeyboardInterrupt

        class Node:
            def __init__(self, name: str) -> None:
                self.subscriptions: list[Any] = []

            def create_subscription(self, kind: Any, topic: str, heard: Any, qos: Any) -> Any:
                self.subscriptions.append(heard)
                return heard

            def destroy_subscription(self, heard: Any) -> None:
                self.subscriptions.remove(heard)

            def destroy_node(self) -> None:
                assert not self.subscriptions

        class Handle:
            accepted = True

            def get_result_async(self) -> Future:
                answer = Message()
                answer.status = stand.status
                answer.result.error_code, answer.result.error_string = stand.error_code, stand.error_string
                waiting.append(Future(answer))
                return waiting[-1]

            def cancel_goal_async(self) -> Future:
                stand.cancelled += 1
                waiting.append(Future(Message()))
                return waiting[-1]

        class ActionClient:
            def __init__(self, node: Any, kind: Any, action: str) -> None:
                stand.actions.append(action)

            def wait_for_server(self, timeout_sec: float) -> bool:
                return stand.serves

            def send_goal_async(self, goal: Any, feedback_callback: Any) -> Future:
                stand.goals.append(goal)
                handle = Handle()
                handle.accepted = stand.accepts
                for errors in stand.feedback:
                    told = Message()
                    told.feedback.joint_names = goal.trajectory.joint_names
                    told.feedback.error.positions = errors
                    feedback_callback(told)
                waiting.append(Future(handle))
                return waiting[-1]

        def init(args: Any, signal_handler_options: Any) -> None:
            assert args == [] and signal_handler_options == "no"
            stand.alive = True

        def try_shutdown() -> None:
            stand.alive = False

        def module(name: str, **names: Any) -> types.ModuleType:
            made = types.ModuleType(name)
            vars(made).update(names)
            return made

        goal = type("FollowJointTrajectory", (), {"Goal": Message})
        return {
            "rclpy": module("rclpy", init=init, try_shutdown=try_shutdown, create_node=Node, spin_once=spin_once),
            "rclpy.signals": module("rclpy.signals", SignalHandlerOptions=types.SimpleNamespace(NO="no")),
            "rclpy.qos": module("rclpy.qos", qos_profile_sensor_data=object()),
            "rclpy.action": module("rclpy.action", ActionClient=ActionClient),
            "sensor_msgs": module("sensor_msgs"),
            "sensor_msgs.msg": module("sensor_msgs.msg", JointState=Message),
            "control_msgs": module("control_msgs"),
            "control_msgs.action": module("control_msgs.action", FollowJointTrajectory=goal),
            "control_msgs.msg": module("control_msgs.msg", JointTolerance=Message),
            "trajectory_msgs": module("trajectory_msgs"),
            "trajectory_msgs.msg": module("trajectory_msgs.msg", JointTrajectoryPoint=Message, JointTrajectory=Trajectory),
        }


class Trajectory:
    """A message with lists of its own."""

    def __init__(self) -> None:
        self.joint_names: list[str] = []
        self.points: list[Any] = []


def without_ros(monkeypatch: Any) -> None:
    """No ROS, whatever is installed."""
    for name in [*Stand().modules()]:
        monkeypatch.setitem(sys.modules, name, None)


def with_ros(monkeypatch: Any) -> Stand:
    """The stand-in in place of ROS."""
    stand = Stand()
    for name, module in stand.modules().items():
        monkeypatch.setitem(sys.modules, name, module)
    return stand
