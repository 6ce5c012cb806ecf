"""How fast the tip moves, beside what it may."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from . import palette
from .canvas import Panels
from .subject import Subject
from .time import mark_washes, readable

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def panels(subject: Subject) -> Panels:
    return Panels([lambda ax: draw(subject, ax)], size_in=(9.0, 3.2), single=True)


def draw(subject: Subject, ax: Axes) -> None:
    plan, knots = subject.plan, subject.motion.t_s
    t_s = np.sort(np.concatenate([knots, (knots[1:] + knots[:-1]) / 2]))
    q, qd, _ = subject.motion.at(t_s)
    ax.plot(t_s, subject.tip.speeds(q, qd), color=palette.TRANSIT, linewidth=1.2, label="planned")
    if subject.execution is not None:
        done = subject.execution
        ax.plot(done.t_s, subject.tip.speeds(done.q_rad, done.qd_rad_s), color=palette.EXECUTED, linewidth=0.7, linestyle=(0, (2, 2)), label="executed")
    ax.axhline(plan.job.limits.tip_speed_m_s, color=palette.LIMIT, linestyle="--", linewidth=1.0, label="limit")
    washes = [segment for segment in plan.segments if segment.kind == "wash"]
    for number, wash in enumerate(washes):
        ax.plot(
            [wash.t_start_s, wash.t_end_s], 2 * [plan.job.requirements.wash_speed_m_s],
            color=palette.WASH, linestyle="--", linewidth=1.4, label="limit while washing" if number == 0 else None,
        )  # fmt: skip
    ax.set_ylim(bottom=0.0)
    readable(ax, plan.job.limits.tip_speed_m_s)
    mark_washes(subject, ax)
    ax.set(xlabel="time [s]", ylabel="speed of the tip [m/s]")
