"""A figure of a plan in SVG: in a notebook's cell, in a file."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import Any

from . import _core


@dataclass(frozen=True)
class Figure:
    """A figure in SVG that needs nothing else. A notebook shows it in the cell whose last line it is.

    >>> Figure("<svg></svg>")
    Figure(1 kB)
    """

    #: The whole file.
    svg: str = field(repr=False)

    def __post_init__(self) -> None:
        _core._check("figure", self)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the figure to a file. Raises FileError."""
        _core._save(self.svg, path)

    def _repr_svg_(self) -> str:
        return self.svg

    def __repr__(self) -> str:
        return f"Figure({max(round(len(self.svg) / 1e3), 1)} kB)"


def figure(plan: _core.Plan, kind: Any, of: tuple[Any, Any, Any, Any]) -> Figure:
    """What ``Plan.figure`` says, of an execution, a certificate, a scenario and an arm."""
    execution, *others = of
    if execution is None and isinstance(kind, str) and kind == "spiral":
        execution = _core.simulate(plan, of[3])
    return Figure(_core._plan_figure(plan, kind, (execution, *others)))
