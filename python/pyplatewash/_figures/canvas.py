"""The axes that maps are drawn on: the caller's, or new ones."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from .._errors import InputError, InputTypeError, MissingError

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: From an axes down to a legend below its labels [in].
BELOW_IN = 0.5
#: Width of a legend's column [in].
LABEL_IN = 2.4

MISSING = "figures need matplotlib, which is not installed: pip install 'pyplatewash[viz]'"


@dataclass(frozen=True)
class Panels:
    """What a figure consists of: a function an axes."""

    #: Draws on its axes; as many as the figure has.
    draw: Sequence[Callable[[Axes], None]]
    #: Size of one axes where they are made new [in].
    size_in: tuple[float, float]
    #: What all axes together are given, once all are drawn.
    finish: Callable[[list[Axes]], None] | None = None
    #: Most axes that stand beside one another.
    columns: int = 4
    #: Whether there is one axes by nature, not one of a list.
    single: bool = False


def axes_for(panels: Panels, given: Any) -> list[Axes]:
    """An axes a panel.

    Raises InputTypeError for what is no axes, InputError for too few or too many, MissingError without matplotlib.
    """
    try:
        import matplotlib.pyplot as plt
    except ImportError as error:
        raise MissingError(MISSING, name="matplotlib") from error
    if given is not None:
        return _checked(given, len(panels.draw))
    count = len(panels.draw)
    columns = min(count, panels.columns)
    rows = -(-count // columns)
    width_in, height_in = panels.size_in
    _, grid = plt.subplots(rows, columns, figsize=(width_in * columns, height_in * rows), squeeze=False, layout="constrained")
    for unused in grid.flat[count:]:
        unused.remove()
    return list(grid.flat[:count])


def add_legend(axes: list[Axes], given: bool) -> None:
    """One legend of what the axes show, if that needs one, below them all; on axes of the caller's, below the first."""
    handles: dict[str, Any] = {}
    for one in axes:
        for handle, label in zip(*one.get_legend_handles_labels()):
            handles.setdefault(label, handle)
    if not handles:
        return
    style: dict[str, Any] = {"fontsize": "small", "frameon": False}
    if given:
        from matplotlib.transforms import ScaledTranslation

        one = axes[0]
        below = one.transAxes + ScaledTranslation(0.0, -BELOW_IN, one.figure.dpi_scale_trans)
        where: dict[str, Any] = {"loc": "upper center", "bbox_to_anchor": (0.5, 0.0), "bbox_transform": below, "borderaxespad": 0.0}
        one.legend(handles.values(), handles.keys(), ncols=min(len(handles), 3), **where, **style)
    else:
        figure = axes[0].figure
        fitting = max(int(figure.get_figwidth() / LABEL_IN), 1)  # type: ignore[union-attr]  # pyright: ignore[reportAttributeAccessIssue]
        figure.legend(handles.values(), handles.keys(), loc="outside lower center", ncols=min(len(handles), fitting, 4), **style)


def _checked(given: Any, count: int) -> list[Axes]:
    from matplotlib.axes import Axes

    if isinstance(given, Axes):
        axes: list[Any] = [given]
    else:
        try:
            axes = list(getattr(given, "flat", given))
        except TypeError:
            axes = [given]
    for one in axes:
        if not isinstance(one, Axes):
            raise InputTypeError(f"ax: an Axes of matplotlib is needed, or a list of them; found a value of type {type(one).__name__}", argument="ax")
        if one.name != "rectilinear":
            raise InputError(f"ax: an Axes with an x and a y is needed; found one of projection '{one.name}'", argument="ax")
    if len(axes) != count:
        raise InputError(f"ax: as many Axes as this figure has are needed: {count}; found {len(axes)}", argument="ax")
    return axes
