"""The cell from above: plates with their wash paths, the way between them, the base."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .._values import Floats
from . import palette
from .around import Stand
from .canvas import Panels
from .subject import Subject

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def panels(subject: Subject) -> Panels:
    return Panels([lambda ax: draw(subject, ax)], size_in=(7.2, 5.6), legend_title="numbers: order of washing", single=True)


def draw(subject: Subject, ax: Axes) -> None:
    """World frame, x to the right, y up."""
    from matplotlib.patches import Circle

    plan = subject.plan
    for visit, index in enumerate(plan.order, 1):
        plate = plan.plates[index]
        ax.add_patch(Circle((plate.x_m, plate.y_m), plate.radius_m, facecolor=palette.FACE, edgecolor=palette.OUTLINE, linewidth=1.2))
        ax.annotate(
            str(visit), (plate.x_m, plate.y_m), ha="center", va="center", fontsize="large", fontweight="bold", zorder=5,
            bbox={"boxstyle": "circle,pad=0.25", "facecolor": "white", "edgecolor": palette.OUTLINE, "alpha": 0.9},
        )  # fmt: skip
    _ways(subject, ax)
    _around(subject).draw(ax)
    plates = f"{len(plan.order)} plate{'s' if len(plan.order) != 1 else ''}"
    ax.set_title(f"{subject.title}: {plates} in {plan.duration_s:.1f} s", parse_math=False)
    ax.set(xlabel="x [m]", ylabel="y [m]", aspect="equal")
    ax.autoscale_view()
    ax.margins(0.04)


def _ways(subject: Subject, ax: Axes) -> None:
    """The tip's way, segment by segment: washing, and between plates."""
    washing: list[Floats] = []
    between: list[Floats] = []
    for segment in subject.plan.segments:
        points = subject.planned_tip(segment.t_start_s, segment.t_end_s)[:, :2]
        (washing if segment.kind == "wash" else between).append(points)
    ax.plot(*_joined(between), color=palette.TRANSIT, linewidth=1.1, linestyle=(0, (5, 2)), label="between plates")
    ax.plot(*_joined(washing), color=palette.WASH, linewidth=1.3, label="wash path")
    if subject.execution is not None:
        tip = subject.tip.places(subject.execution.q_rad[::10])
        ax.plot(tip[:, 0], tip[:, 1], color=palette.EXECUTED, linewidth=0.7, label="executed")


def _around(subject: Subject) -> Stand:
    x_m, y_m = subject.tip.mount[1][:2]
    if subject.scenario is None:
        return Stand((x_m, y_m))
    around = subject.document["surroundings"]
    return Stand((x_m, y_m), around["base_circle_m"], around["region_m"])


def _joined(pieces: list[Floats]) -> Floats:
    """Pieces as one line with gaps, shape (2, N)."""
    gap = np.full((1, 2), np.nan)
    return np.concatenate([part for piece in pieces for part in (piece, gap)] or [gap]).T
