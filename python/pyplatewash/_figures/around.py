"""What stands around plates, seen from above: the arm, and where plates are drawn."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from . import palette

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True)
class Stand:
    """The arm, and where plates are drawn, in the world [m]."""

    #: Foot of the arm's mount: x and y.
    foot_m: tuple[float, float]
    #: Radius about it that the centres of plates keep away from.
    base_circle_m: float | None = None
    #: Outline of the region of their centres.
    region_m: Sequence[tuple[float, float]] | None = None

    def draw(self, ax: Axes) -> None:
        """World frame."""
        from matplotlib.patches import Circle, Polygon

        ax.plot(*self.foot_m, marker="^", markersize=10, color=palette.EXECUTED, linestyle="none", label="base")
        if self.base_circle_m is not None:
            words = f"no plate centre within {1e3 * self.base_circle_m:g} mm"
            ax.add_patch(Circle(self.foot_m, self.base_circle_m, fill=False, edgecolor=palette.LIMIT, linestyle=":", linewidth=1.4, label=words))
        if self.region_m is not None:
            words = "region of plate centres"
            ax.add_patch(Polygon(self.region_m, closed=True, fill=False, edgecolor=palette.OUTLINE, linestyle="-.", linewidth=1.1, label=words))
