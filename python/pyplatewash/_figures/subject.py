"""What figures are drawn of: a plan on its arm, and what belongs to it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from .. import _core
from .._errors import InputError
from .._values import Floats
from .._words import quoted
from .tip import Tip

#: Distance of points on a path while the plate is washed [m], and of times otherwise [s].
STEP_S = 0.01


@dataclass(frozen=True)
class Subject:
    """A plan, the arm, an execution if there is one."""

    plan: _core.Plan
    robot: _core.Robot
    execution: _core.Execution | None
    scenario: _core.Scenario | None
    #: The plates that are asked for, in the order of washing.
    plates: tuple[int, ...]
    #: Whether one plate was asked for by its index.
    one_plate: bool

    @classmethod
    def of(
        cls, plan: _core.Plan, robot: _core.Robot, execution: _core.Execution | None, plate: int | None, scenario: _core.Scenario | None
    ) -> Subject:
        """Checks that the parts belong together. Raises InputError."""
        if robot.sha256 != plan.job.workcell.arm.urdf_sha256:
            raise InputError(f"robot: the plan was made for another arm, '{plan.job.workcell.arm.name}'; found '{robot.name}'", argument="robot")
        if execution is not None and execution.plan != plan:
            raise InputError("execution: is one of another plan", argument="execution")
        if plate is not None and plate not in plan.order:
            washed = ", ".join(map(str, plan.order))
            raise InputError(f"plate: one of those that are washed is needed: {washed}; found {plate}", argument="plate")
        plates = tuple(plan.order) if plate is None else (plate,)
        return cls(plan, robot, execution, scenario, plates, plate is not None)

    @cached_property
    def tip(self) -> Tip:
        """The tip of the plan's tool on the arm."""
        return Tip.of(self.robot, self.plan.job.workcell)

    @cached_property
    def document(self) -> dict[str, Any]:
        """What a page shows of it."""
        return _core._plan_view(self.plan, self.robot, self.execution, self.scenario)

    @cached_property
    def motion(self) -> _core.Trajectory:
        """The planned motion."""
        return self.plan.trajectory

    @property
    def title(self) -> str:
        """The scenario and the seed: the name without line breaks and what cannot be seen, at most 40 characters."""
        name = "".join(c if c.isprintable() else " " for c in self.plan.provenance.scenario)
        return f"{quoted(name if len(name) <= 40 else f'{name[:39]}…')}, seed {self.plan.job.seed}"

    def called(self, plate: int) -> str:
        """A plate as titles call it: which one it is in the order of washing, and its index."""
        return f"{self.plan.order.index(plate) + 1}: plate {plate}"

    def wash_of(self, plate: int) -> Any:
        """The segment that washes a plate."""
        return next(s for s in self.plan.segments if s.kind == "wash" and s.plate == plate)

    def planned_tip(self, start_s: float, end_s: float) -> Floats:
        """The planned tip between two times, both included: shape (N, 3), world frame [m]."""
        return self.tip.places(self.motion.at(times(start_s, end_s))[0])

    def rows(self, start_s: float, end_s: float) -> Any:
        """The samples of the execution between two times."""
        assert self.execution is not None
        t_s = self.execution.t_s
        return slice(int(np.searchsorted(t_s, start_s - 1e-9)), int(np.searchsorted(t_s, end_s + 1e-9)))


def times(start_s: float, end_s: float) -> Floats:
    """Times between two, both included, at most ``STEP_S`` apart."""
    return np.linspace(start_s, end_s, max(int(np.ceil((end_s - start_s) / STEP_S)), 1) + 1)
