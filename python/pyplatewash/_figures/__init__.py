"""Figures of a plan with matplotlib, which is asked for only when one is drawn.

============= ===================== ==========================================
kind          module                axes
============= ===================== ==========================================
``layout``    ``layout.py``         one
``joints``    ``joints.py``         three: position, speed, acceleration
``tip``       ``tip_speed.py``      one
``clearance`` ``clearance.py``      one
``coverage``  ``coverage.py``       one a plate
``spiral``    ``spiral.py``         one a plate
============= ===================== ==========================================
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .. import _core
from .._errors import InputError
from . import clearance, coverage, joints, layout, spiral, tip_speed
from .canvas import add_legend, axes_for
from .subject import Subject

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .._core import Plan

KINDS = {"layout": layout, "joints": joints, "tip": tip_speed, "clearance": clearance, "coverage": coverage, "spiral": spiral}


def figure(plan: Plan, name: Any, ax: Any, of: tuple[Any, Any, Any, Any]) -> Axes | list[Axes]:
    """What ``Plan.figure`` says, ``of`` an execution, a plate, a scenario and an arm; one axes where the kind draws one, or one plate is
    asked for, else a list."""
    (robot, scenario), kind, plate = _core._figure_arguments(plan, name, of)
    if kind not in KINDS:
        raise InputError(f"kind: one of {', '.join(KINDS)} is needed; found {kind!r:.60}", argument="kind")
    execution = of[0]
    subject = Subject.of(plan, robot, execution, plate, scenario)
    panels = KINDS[kind].panels(subject)
    axes = axes_for(panels, ax)
    for panel, one in zip(panels.draw, axes):
        panel(one)
    if panels.finish is not None:
        panels.finish(axes)
    add_legend(panels, axes, ax is not None)
    return axes[0] if panels.single else axes
