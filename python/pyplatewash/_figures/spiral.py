"""Ideal against executed spiral: the tip over each plate as planned, and as an arm under a control law moves it."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

from .. import _core
from .._records import Record
from . import palette
from .canvas import Panels
from .subject import Subject

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def panels(subject: Subject) -> Panels:
    if subject.execution is None:
        subject = replace(subject, execution=_core.simulate(subject.plan, subject.robot))
    assert subject.execution is not None
    report = subject.execution.report()
    off = {s.plate: s.tip_m for s in report.segments if s.kind == "wash"}
    draw = [partial(_draw, subject, plate, off[plate]) for plate in subject.plates]
    return Panels(draw, size_in=(3.4, 3.9), legend_below=True, single=subject.one_plate)


def _draw(subject: Subject, index: int, off: Record, ax: Axes) -> None:
    from matplotlib.patches import Circle

    assert subject.execution is not None
    plate, wash = subject.plan.plates[index], subject.wash_of(index)
    centre = 1e3 * plate.x_m, 1e3 * plate.y_m
    planned = 1e3 * subject.planned_tip(wash.t_start_s, wash.t_end_s)[:, :2] - centre
    rows = subject.rows(wash.t_start_s, wash.t_end_s)
    executed = 1e3 * subject.tip.places(subject.execution.q_rad[rows])[:, :2] - centre
    ax.add_patch(Circle((0, 0), 1e3 * plate.radius_m, facecolor=palette.FACE, edgecolor=palette.OUTLINE, linewidth=1.2))
    ax.plot(*planned.T, color=palette.WASH, linewidth=2.4, alpha=0.6, label="planned")
    law = subject.execution.settings.law
    ax.plot(*executed.T, color=palette.EXECUTED, linewidth=0.9, label=f"executed ({law})")
    sponge_mm = 1e3 * subject.plan.job.workcell.tool.sponge.radius_m
    ax.add_patch(Circle(tuple(executed[-1]), sponge_mm, facecolor=palette.SWEPT, alpha=0.45, edgecolor=palette.OUTLINE, label="sponge"))
    ax.set_title(f"{subject.called(index)}\noff by {1e3 * off.rms:.3g} mm rms,\n{1e3 * off.max:.3g} mm at most", fontsize="medium")
    ax.set(xlabel="x from its centre [mm]", ylabel="y from its centre [mm]", aspect="equal")
    edge = 1e3 * plate.radius_m * (1.1 if abs(executed).max() < 1.1e3 * plate.radius_m else 1.6)
    ax.set(xlim=(-edge, edge), ylim=(-edge, edge))
