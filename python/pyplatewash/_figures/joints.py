"""The joints over time, as shares of their limits."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from .._values import Floats
from . import palette
from .canvas import Panels
from .subject import Subject
from .time import mark_washes, readable

if TYPE_CHECKING:
    from matplotlib.axes import Axes

TITLES = ("position", "speed", "acceleration")


def panels(subject: Subject) -> Panels:
    planned = _planned(subject)
    executed = _executed(subject)
    draw = [partial(_draw, subject, k, planned, executed) for k in range(3)]
    return Panels(draw, size_in=(9.0, 2.6), stacked=True)


def shares(subject: Subject, q: Floats, qd: Floats, qdd: Floats) -> tuple[Floats, Floats, Floats]:
    """Shares of the limits in percent, shape (N, 6) each: 0 is the middle of a joint's range, ±100 its ends; NaN without a limit."""
    lower, upper = subject.robot.lower, subject.robot.upper
    with np.errstate(invalid="ignore"):
        position = (q - (lower + upper) / 2) / ((upper - lower) / 2)
        position[:, ~np.isfinite(lower + upper)] = np.nan
    acceleration = np.array(subject.plan.job.limits.joint_acceleration_rad_s2, dtype=float)
    return 100 * position, 100 * qd / subject.robot.velocity, 100 * qdd / acceleration


def _planned(subject: Subject) -> tuple[Floats, tuple[Floats, ...]]:
    """At all knots, from both sides, since accelerations jump there, and halfway between."""
    knots = subject.motion.t_s
    t_s = np.sort(np.concatenate([knots, np.nextafter(knots[1:], -np.inf), (knots[1:] + knots[:-1]) / 2]))
    return t_s, shares(subject, *subject.motion.at(t_s))


def _executed(subject: Subject) -> tuple[Floats, tuple[Floats, ...]] | None:
    if subject.execution is None:
        return None
    done = subject.execution
    return done.t_s, shares(subject, done.q_rad, done.qd_rad_s, done.qdd_rad_s2)


def _draw(
    subject: Subject, k: int, planned: tuple[Floats, tuple[Floats, ...]], executed: tuple[Floats, tuple[Floats, ...]] | None, ax: Axes
) -> None:
    for joint, colour in enumerate(palette.JOINTS):
        without = "" if np.isfinite(planned[1][k][:, joint]).any() else " (no limit)"
        ax.plot(planned[0], planned[1][k][:, joint], color=colour, linewidth=1.1, label=f"joint {joint + 1}{without}")
        if executed is not None:
            label = "executed: dotted" if joint == 5 else None
            ax.plot(executed[0], executed[1][k][:, joint], color=colour, linewidth=1.6, linestyle=(0, (1, 1.5)), label=label)
    for sign in (-100.0, 100.0):
        ax.axhline(sign, color=palette.LIMIT, linestyle="--", linewidth=1.0, label="limit" if sign > 0 else None)
    readable(ax, 100.0)
    mark_washes(subject, ax)
    ax.set_ylabel(f"{TITLES[k]} [% of limit]")
    if k == 2:
        ax.set_xlabel("time [s]")
