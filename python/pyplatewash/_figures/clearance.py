"""The smallest distance of all pairs of bodies that count, over time: sampled to look at, not the proof."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .._errors import InputError
from . import palette
from .canvas import Panels
from .document import array
from .subject import Subject
from .time import mark_washes

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def panels(subject: Subject) -> Panels:
    if subject.document["clearance"] is None:
        raise InputError("kind: the plan has no bodies that must keep clear of one another", argument="kind")
    return Panels([lambda ax: draw(subject, ax)], size_in=(9.0, 3.2), single=True)


def draw(subject: Subject, ax: Axes) -> None:
    found = subject.document["clearance"]
    t_s, distance_mm = array(found["t_s"]), 1e3 * array(found["distance_m"])
    ax.plot(t_s, distance_mm, color=palette.TRANSIT, linewidth=1.2, label="planned")
    ax.axhline(1e3 * found["margin_m"], color=palette.LIMIT, linestyle="--", linewidth=1.0, label="required")
    least = int(np.argmin(distance_mm))
    names = " – ".join(found["names"][body] for body in array(found["pair"])[least])
    ax.plot(t_s[least], distance_mm[least], marker="o", linestyle="none", color=palette.EXECUTED, label=f"least: {distance_mm[least]:.1f} mm\n{names}")
    mark_washes(subject, ax)
    ax.set(xlabel="time [s]", ylabel="least distance [mm]")
    ax.set_ylim(bottom=min(0.0, 1.05 * distance_mm[least]))
