"""Maps of a study's rows over the table, drawn with matplotlib, which is imported only when one is drawn."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

from . import _arguments, _core
from ._errors import InputError, InputTypeError, MissingError, PlatewashError
from ._studies.folder import Folder, Row
from ._studies.table import as_json

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: The arm.
EXECUTED = "#1b1f24"
#: Rims of plates, and other outlines.
OUTLINE = "#6e7781"
#: A limit, a margin, what is missed.
LIMIT = "#d55e00"
#: Outcomes of rows, what is known to be impossible and what was not found well apart; and rows that ended in several ways.
OUTCOMES = {
    "proved": "#009e73", "not_proved": "#f0e442", "not_found": "#56b4e9", "infeasible": "#d55e00", "error": "#cc79a7", "crashed": "#1b1f24",
}  # fmt: skip
SEVERAL = "#8c959f"
#: Places where nothing is proved.
NOTHING = "#c8ccd1"


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

        ax.plot(*self.foot_m, marker="^", markersize=10, color=EXECUTED, linestyle="none", label="base")
        if self.base_circle_m is not None:
            words = f"no plate centre within {1e3 * self.base_circle_m:g} mm"
            ax.add_patch(Circle(self.foot_m, self.base_circle_m, fill=False, edgecolor=LIMIT, linestyle=":", linewidth=1.4, label=words))
        if self.region_m is not None:
            words = "region of plate centres"
            ax.add_patch(Polygon(self.region_m, closed=True, fill=False, edgecolor=OUTLINE, linestyle="-.", linewidth=1.1, label=words))


#: x and y [m].
Place: TypeAlias = tuple[float, float]


@dataclass
class Tally:
    """The rows at a place."""

    rows: int = 0
    proved: int = 0
    #: Codes of how they ended.
    outcomes: set[str] = field(default_factory=set)
    #: The least of what is proved: clearance [m], and share swept.
    clearance_m: float | None = None
    swept: float | None = None
    #: Of what is proved, in all [s].
    whole_s: float = 0.0

    def add(self, row: Row) -> None:
        self.rows += 1
        self.outcomes.add(row["outcome"])
        if row["outcome"] != "proved":
            return
        self.proved += 1
        self.clearance_m = _least(self.clearance_m, row.get("clearance_m"))
        self.swept = _least(self.swept, row.get("swept"))
        self.whole_s += row.get("duration_s") or 0.0

    @property
    def duration_s(self) -> float | None:
        """Mean of what is proved [s]."""
        return self.whole_s / self.proved if self.proved else None


def gathered(of: Folder, at: str, by: list[str], most: int) -> dict[tuple[Any, ...], dict[Place, Tally]]:
    """Tallies by place, for each combination of values of the axes ``by``, each axis in the order of the study, the last one the fastest.

    Raises InputError for places that are none, and for more combinations than ``most``.
    """
    maps: dict[str, tuple[tuple[Any, ...], dict[Place, Tally]]] = {}
    for row in of.each():
        values = tuple(row["scenario"] if key == "scenario" else row["axes"].get(key) for key in by)
        place = row["axes"].get(at)
        if not isinstance(place, list) or len(place) < 2 or not all(type(v) in (int, float) for v in place[:2]):
            words = f"at: an axis of places is needed, lists with x and y; found {at}, whose value in row {row['index']} is {place!r:.60}"
            raise InputError(words, argument="at")
        _, places = maps.setdefault(repr(values), (values, {}))
        if len(maps) > most:
            raise InputError(f"by: axes with at most {most} combinations of values are needed; found more of {', '.join(by)}", argument="by")
        places.setdefault((float(place[0]), float(place[1])), Tally()).add(row)
    if not maps:
        raise InputError(f"at: rows to draw are needed; {of.path} has none yet", argument="at")
    return {values: places for values, places in sorted(maps.values(), key=_Order([values for values, _ in maps.values()]))}


class _Order:
    """Combinations, ordered by where the study has their values first."""

    def __init__(self, all_: list[tuple[Any, ...]]) -> None:
        self._firsts = [list(dict.fromkeys(map(repr, column))) for column in zip(*all_)]

    def __call__(self, one: tuple[tuple[Any, ...], Any]) -> list[int]:
        return [first.index(repr(value)) for first, value in zip(self._firsts, one[0])]


def _least(one: float | None, other: float | None) -> float | None:
    known = [value for value in (one, other) if value is not None]
    return min(known) if known else None


#: What a map may show: its words on the scale of colours, and what a value is multiplied by.
SCALES = {
    "washable": ("rows that are proved [%]", 100.0),
    "clearance": ("least clearance of what is proved [mm]", 1e3),
    "swept": ("least share swept of what is proved [%]", 100.0),
    "duration": ("mean duration of what is proved [s]", 1.0),
}
VALUES = (*SCALES, "outcome")
#: What the legend says of an outcome, and of places whose rows ended in several ways.
WORDS = {
    "proved": "proved",
    "not_proved": "planned, not proved",
    "not_found": "no way found: there may be one",
    "infeasible": "infeasible: known to be",
    "error": "error: no job",
    "crashed": "crashed",
    "several": "several of these",
}
COLOURS = {**OUTCOMES, "several": SEVERAL}
#: Most maps of a figure, and most cells of one, as a multiple of its places.
MOST_MAPS, MOST_CELLS = 64, 25
#: Most maps beside one another.
MOST_ACROSS = 8
#: Units that keys end with.
UNITS = {"_m": "m", "_deg": "°", "_m_s": "m/s", "_m_s2": "m/s²", "_s": "s", "_n": "N", "_kg": "kg", "_pa": "Pa", "_hz": "Hz", "_rad": "rad"}

#: Left, right, bottom and top [m].
View: TypeAlias = tuple[float, float, float, float]


@dataclass(frozen=True)
class Grid:
    """Places on a grid."""

    #: Rows and columns.
    shape: tuple[int, int]
    extent: View


def draw(of: Folder, given: tuple[Any, Any, Any, Any], ax: Any) -> Axes | list[Axes]:
    """What ``StudyRows.map`` says, of ``at``, ``value``, ``by`` and ``region``."""
    keys = [axis["key"] for axis in of.manifest["axes"]]
    at, value = _arguments.word("at", given[0], keys), _arguments.word("value", given[1], VALUES)
    by = [_arguments.word("by", key, ["scenario", *(k for k in keys if k != at)]) for key in _arguments.texts("by", given[2])]
    if len(set(by)) < len(by):
        raise InputError(f"by: different axes are needed; found {', '.join(by)}", argument="by")
    stand = _stand(of, given[3])
    maps = gathered(of, at, by, MOST_MAPS)
    every = [tally for places in maps.values() for tally in places.values()]
    numbers = [shown for tally in every if (shown := _number(tally, value)) is not None]
    limits = (0.0, 100.0) if value == "washable" else (min(numbers), max(numbers)) if numbers else (0.0, 1.0)
    grid = _grid([place for places in maps.values() for place in places])
    titles = {values: "\n".join(titled(key, one) for key, one in zip(by, values)) for values in maps}
    view = _view([place for places in maps.values() for place in places], grid, stand)
    across = len({as_json(values[-1]) for values in maps}) if by else 1
    lines = [partial(_draw, (places, grid), value, limits, titles[values], (stand, view)) for values, places in maps.items()]
    finish = None if value == "outcome" else partial(_scale, SCALES[value][0], limits)
    panels = Panels(
        lines, size_in=_size_in(view, len(by)), finish=finish, single=not by, columns=across if across <= MOST_ACROSS else 4
    )
    axes = axes_for(panels, ax)
    for panel, one in zip(panels.draw, axes):
        panel(one)
    if ax is None:
        for one in axes:
            one.label_outer()
    if panels.finish is not None:
        panels.finish(axes)
    add_legend(axes, ax is not None)
    return axes[0] if panels.single else axes


def titled(key: str, value: Any) -> str:
    """An axis with its value and unit.

    >>> titled("tool.length_m", 0.1), titled("seed", 3), titled("wash.pattern", "rings")
    ('tool.length 0.1 m', 'seed 3', 'wash.pattern rings')
    """
    shown = value if isinstance(value, str) else as_json(value)
    for ending in sorted(UNITS, key=len, reverse=True):
        if key.endswith(ending) and not isinstance(value, str):
            return f"{key.removesuffix(ending)} {shown} {UNITS[ending]}"
    return f"{key} {shown}"


def _number(tally: Tally, value: str) -> float | None:
    """What a place has on the scale of colours; None where nothing is proved there."""
    if value == "washable":
        return 100.0 * tally.proved / tally.rows
    if value == "outcome" or not tally.proved:
        return None
    found = {"clearance": tally.clearance_m, "swept": tally.swept, "duration": tally.duration_s}[value]
    return None if found is None else SCALES[value][1] * found


def _outcome(tally: Tally) -> str:
    return next(iter(tally.outcomes)) if len(tally.outcomes) == 1 else "several"


def _stand(of: Folder, region: Any) -> Stand | None:
    """Of a study's rows, or of the scenario whose region is drawn; None where the arm's place is not known, or differs by row."""
    if region is not None:
        return Stand(*_core._task_region("region", region))
    if any(axis["key"].startswith("robot.mount") for axis in of.manifest["axes"]) or len(of.manifest["scenarios"]) > 1:
        return None
    try:
        return Stand(_core._task_region("scenario", _core.Study.load(of.path).scenario(next(of.each())["index"]))[0])
    except (PlatewashError, StopIteration):
        # The study is damaged, or of another version: what came of the rows is there, and is drawn.
        return None


def _draw(
    over: tuple[dict[Place, Tally], Grid | None],
    value: str,
    limits: tuple[float, float],
    title: str,
    frame: tuple[Stand | None, View],
    ax: Axes,
) -> None:
    """World frame, x to the right, y up."""
    from matplotlib.colors import ListedColormap

    places, grid = over
    tallies = list(places.values())
    at = np.array(list(places), dtype=float).reshape(-1, 2)
    if value == "outcome":
        for code, colour in COLOURS.items():
            chosen = np.array([_outcome(tally) == code for tally in tallies], dtype=bool)
            if chosen.any():
                _cells(ax, at, grid, np.where(chosen, 0.0, np.nan), cmap=ListedColormap([colour]))
                ax.plot([], [], marker="s", linestyle="none", color=colour, label=WORDS[code])
    else:
        shown = np.array([np.nan if (one := _number(tally, value)) is None else one for tally in tallies], dtype=float)
        _cells(ax, at, grid, shown, cmap="cividis", vmin=limits[0], vmax=limits[1])
        if np.isnan(shown).any():
            _cells(ax, at, grid, np.where(np.isnan(shown), 0.0, np.nan), cmap=ListedColormap([NOTHING]))
            ax.plot([], [], marker="s", linestyle="none", color=NOTHING, label="nothing proved")
    stand, (left, right, bottom, top) = frame
    if stand is not None:
        stand.draw(ax)
    if title:
        ax.set_title(title, fontsize="small", parse_math=False)
    ax.set(xlabel="x [m]", ylabel="y [m]", aspect="equal", xlim=(left, right), ylim=(bottom, top))


def _cells(ax: Axes, at: npt.NDArray[np.float64], grid: Grid | None, values: npt.NDArray[np.float64], **colours: Any) -> None:
    """Colours places that have a value: squares of a grid, else dots."""
    if grid is None:
        chosen = ~np.isnan(values)
        ax.scatter(at[chosen, 0], at[chosen, 1], c=values[chosen], s=14.0, linewidths=0.0, **colours)
        return
    image = np.full(grid.shape, np.nan)
    columns, rows = _cell_of(at, grid)
    image[rows, columns] = values
    ax.imshow(np.ma.masked_invalid(image), origin="lower", extent=grid.extent, interpolation="nearest", zorder=0, **colours)


def _cell_of(at: npt.NDArray[np.float64], grid: Grid) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    left, right, bottom, top = grid.extent
    high, wide = grid.shape
    columns = np.floor((at[:, 0] - left) / (right - left) * wide).astype(np.int64)
    rows = np.floor((at[:, 1] - bottom) / (top - bottom) * high).astype(np.int64)
    return columns, rows


def _grid(places: Sequence[Place]) -> Grid | None:
    """The grid on which places are; None where they are on none."""
    at = np.array(sorted(set(places)), dtype=float).reshape(-1, 2)
    if not len(at):
        return None
    steps = [_step(at[:, k]) for k in range(2)]
    known = [step for step in steps if step is not None]
    dx, dy = (known[0] if step is None else step for step in steps) if known else (0.02, 0.02)
    low, high = at.min(axis=0), at.max(axis=0)
    cells = (at - low) / (dx, dy)
    whole = np.rint(cells).astype(np.int64)
    wide, tall = (whole.max(axis=0) + 1).tolist()
    if np.abs(cells - whole).max() > 1e-3 or wide * tall > MOST_CELLS * len(at) + 64:
        return None
    extent = (float(low[0] - dx / 2), float(high[0] + dx / 2), float(low[1] - dy / 2), float(high[1] + dy / 2))
    return Grid((tall, wide), extent)


def _step(values: npt.NDArray[np.float64]) -> float | None:
    """The least distance of two coordinates; None where there is one alone."""
    apart = np.diff(np.unique(values.round(9)))
    return float(apart.min()) if len(apart) else None


def _view(places: Sequence[Place], grid: Grid | None, stand: Stand | None) -> View:
    """What of the table is shown: all places and the arm's base, with some room."""
    at = np.array([*places, *([] if stand is None else [stand.foot_m])], dtype=float).reshape(-1, 2)
    corners = [] if grid is None else [(grid.extent[0], grid.extent[2]), (grid.extent[1], grid.extent[3])]
    at = np.concatenate([at, np.array(corners, dtype=float).reshape(-1, 2)])
    low, high = at.min(axis=0), at.max(axis=0)
    room = max(0.05 * float((high - low).max()), 0.02)
    return float(low[0] - room), float(high[0] + room), float(low[1] - room), float(high[1] + room)


def _size_in(view: View, lines: int) -> tuple[float, float]:
    """The size of one map with its labels [in], for axes whose edges are those of the view."""
    wide, tall = view[1] - view[0], view[3] - view[2]
    edge_in = 3.4 if lines else 4.2
    inch = edge_in / max(wide, tall)
    return max(wide * inch, 1.3) + (0.9 if lines else 1.6), max(tall * inch, 1.2) + 0.7 + 0.16 * lines


def _scale(words: str, limits: tuple[float, float], axes: list[Axes]) -> None:
    """One scale of colours for all, or one a figure where the caller's axes are in several."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    for figure in dict.fromkeys(ax.figure for ax in axes):
        mine = [ax for ax in axes if ax.figure is figure]
        wide = 0.05 if len(mine) > 1 else 0.1
        figure.colorbar(ScalarMappable(Normalize(*limits), "cividis"), ax=mine, label=words, shrink=0.8, fraction=wide, aspect=30)
