"""What stands around a study's places: the arm, and the region that plates may lie in."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from .. import _core
from .._arguments import path, shown
from .._errors import InputTypeError, PlatewashError
from .._studies.folder import Folder
from . import palette

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Regions that go by a name: ranges of x and y [m].
NAMED = {"text": ((0.0, 0.32), (-0.38, 0.32)), "appendix": ((0.0, 0.30), (-0.38, 0.38))}


@dataclass(frozen=True)
class Stand:
    """Where the arm stands, in the world: x, y [m] and azimuth [degrees]; None where that is not known, or differs by row."""

    mount: tuple[float, float, float] | None
    #: A scenario's section of that name, where a region is to be drawn.
    layout: dict[str, Any] | None = None

    @classmethod
    def of(cls, folder: Folder, region: Any) -> Stand:
        """Of a study's rows, or of the scenario whose region is drawn. Raises ScenarioError, InputTypeError."""
        if region is not None:
            if not isinstance(region, (_core.Scenario, str)) and not hasattr(region, "__fspath__"):
                words = f"region: a Scenario, the name of a shipped one or the path of a file is needed; found {shown(region)}"
                raise InputTypeError(words, argument="region")
            scenario = region if isinstance(region, _core.Scenario) else _core.Scenario.load(path("region", region))
            return cls(_mount(scenario), scenario.to_dict().get("layout", {}))
        if any(axis["key"].startswith("robot.mount") for axis in folder.manifest["axes"]) or len(folder.manifest["scenarios"]) > 1:
            return cls(None)
        try:
            return cls(_mount(_core.Study.load(folder.path).scenario(next(folder.each())["index"])))
        except (PlatewashError, StopIteration):
            # The study is damaged, or of another version: what came of the rows is there, and is drawn.
            return cls(None)

    def draw(self, ax: Axes) -> None:
        """World frame."""
        if self.mount is None:
            return
        ax.plot(*self.mount[:2], marker="^", markersize=9, color=palette.EXECUTED, linestyle="none", label="base")
        if self.layout is not None:
            self._region(ax, self.layout)

    def _region(self, ax: Axes, layout: dict[str, Any]) -> None:
        from matplotlib.patches import Circle, Polygon, Wedge
        from matplotlib.transforms import Affine2D

        assert self.mount is not None
        x_m, y_m, turn_deg = self.mount
        to_world = Affine2D().rotate_deg(turn_deg).translate(x_m, y_m)
        style: dict[str, Any] = {"fill": False, "edgecolor": palette.OUTLINE, "linestyle": "-.", "linewidth": 1.1}
        label = "region of plate centres"
        ranges = NAMED.get(layout.get("region", ""), (layout.get("x_m"), layout.get("y_m")))
        if ranges[0] is not None and ranges[1] is not None:
            (left, right), (bottom, top) = ranges[0], ranges[1]
            corners = to_world.transform([(left, bottom), (right, bottom), (right, top), (left, top)])
            ax.add_patch(Polygon(corners, closed=True, label=label, **style))
        if layout.get("rho_m") is not None:
            least, most = layout["rho_m"]
            start, end = layout.get("azimuth_deg") or (0.0, 360.0)
            ax.add_patch(Wedge((x_m, y_m), most, start + turn_deg, end + turn_deg, width=most - least, label=label, **style))
        if layout.get("base_radius_m"):
            words = f"no plate centre within {1e3 * layout['base_radius_m']:g} mm"
            ax.add_patch(Circle((x_m, y_m), layout["base_radius_m"], fill=False, edgecolor=palette.LIMIT, linestyle=":", linewidth=1.4, label=words))


def _mount(scenario: _core.Scenario) -> tuple[float, float, float] | None:
    """None for an arm that does not stand upright."""
    robot = scenario.to_dict().get("robot", {})
    x_m, y_m, _ = robot.get("mount_m", (0.0, 0.0, 0.0))
    roll, pitch, yaw = robot.get("mount_rpy_deg", (0.0, 0.0, 0.0))
    return None if roll or pitch else (x_m, y_m, yaw)
