"""What figures over time have in common."""

from __future__ import annotations

from typing import TYPE_CHECKING

from . import palette

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .subject import Subject

#: Beyond so many times the limit, an axis is logarithmic outside of the limits.
FAR = 8.0
#: Most washes that are labelled one by one.
MOST_LABELS = 12


def mark_washes(subject: Subject, ax: Axes) -> None:
    """Shades the time of each wash and says its plate above the axes."""
    plan, spec = subject.plan, ax.get_subplotspec()
    washes = [segment for segment in plan.segments if segment.kind == "wash"]
    above = spec is None or spec.is_first_row()
    if above:
        ax.set_title(subject.title, pad=20.0, parse_math=False)
    for number, wash in enumerate(washes):
        ax.axvspan(wash.t_start_s, wash.t_end_s, color=palette.WASH, alpha=0.08, linewidth=0, label="washing" if number == 0 else None)
        if above and len(washes) <= MOST_LABELS:
            middle = (wash.t_start_s + wash.t_end_s) / 2
            ax.annotate(f"plate {wash.plate}", (middle, 1.02), xycoords=("data", "axes fraction"), ha="center", va="bottom", fontsize="small", annotation_clip=False)
    ax.set_xlim(0.0, plan.duration_s)


def readable(ax: Axes, limit: float) -> None:
    """Makes an axis that goes far beyond its limit logarithmic outside of it, so that what is within can be seen."""
    if max(map(abs, ax.get_ylim())) > FAR * limit:
        ax.set_yscale("symlog", linthresh=limit)
