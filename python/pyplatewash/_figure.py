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


def figure(
    self: _core.Plan,
    kind: Any = "layout",
    *,
    execution: Any = None,
    certificate: Any = None,
    scenario: Any = None,
    robot: Any = None,
) -> Figure:
    """A figure of the plan in SVG, which a notebook shows in the cell whose last line it is.

    ``kind`` is ``"layout"`` (from above), ``"joints"`` (joints, tip and clearance over time), ``"coverage"`` (for how long the sponge is
    over each place of a plate) or ``"spiral"`` (what the tip was to follow, and what it followed). The command's ``figures`` draws the
    same.

    ``execution`` is drawn beside the plan; ``"spiral"`` simulates the plan with its own settings where there is none. ``certificate`` is
    named, else the figure says that nothing is proved. With ``scenario`` the layout shows where plates are drawn. ``robot`` is the arm, by
    default the one that the plan was made for.

    Raises InputError for what does not belong to the plan and for a figure that is none; ProveError for a plan whose arm must be given.
    """
    if execution is None and isinstance(kind, str) and kind == "spiral":
        execution = _core.simulate(self, robot)
    return Figure(_core._plan_figure(self, kind, (execution, certificate, scenario, robot)))
