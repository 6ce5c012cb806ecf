"""Where the tip of a tool is, and how fast it moves."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from .._core import Robot
from .._values import Floats


def rotation(quaternion_wxyz: npt.ArrayLike) -> Floats:
    """The rotation matrix of a unit quaternion, shape (3, 3)."""
    w, x, y, z = np.asarray(quaternion_wxyz, dtype=float)
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ])


@dataclass(frozen=True)
class Tip:
    """The centre of a sponge's far face, fixed to an arm's flange, and where the arm stands."""

    robot: Robot
    #: In the mounting frame, shape (3,) [m].
    offset_m: Floats
    #: ``T_world_base``: rotation, shape (3, 3), and place, shape (3,) [m].
    mount: tuple[Floats, Floats]

    @classmethod
    def of(cls, robot: Robot, workcell: Any) -> Tip:
        """That of a plan's workcell."""
        mount = rotation(workcell.mount.quaternion_wxyz), np.array(workcell.mount.position_m)
        return cls(robot, np.array(workcell.tool.tip.position_m), mount)

    def places(self, q: Floats) -> Floats:
        """At configurations, shape (N, 6) [rad]: shape (N, 3), world frame [m]."""
        flange = self.robot.fk(q)
        turn, place = self.mount
        in_base = flange[:, :3, 3] + flange[:, :3, :3] @ self.offset_m
        return in_base @ turn.T + place

    def speeds(self, q: Floats, qd: Floats) -> Floats:
        """At configurations and joint speeds, shape (N, 6) each: shape (N,) [m/s]."""
        twist = (self.robot.jacobian(q) @ qd[..., None])[..., 0]
        arm = self.robot.fk(q)[:, :3, :3] @ self.offset_m
        speeds: Floats = np.linalg.norm(twist[:, :3] + np.cross(twist[:, 3:], arm), axis=1)
        return speeds
