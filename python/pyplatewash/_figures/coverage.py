"""For how long the sponge is over each place of a plate, and what it misses: sampled to look at, not the proof."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

from .. import _core
from .._words import percent
from . import palette
from .canvas import Panels
from .document import array
from .subject import Subject

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: A masked array.
Masked: TypeAlias = npt.NDArray[Any]

#: In a raster of first moments: never, and outside the rim.
NEVER, OUTSIDE = 65535, 65534


def panels(subject: Subject) -> Panels:
    document = subject.document if subject.execution is None else subject.document["execution"]
    swept = {one["plate"]: one for one in document["coverage"]}
    shares = fractions(subject)
    maps = {plate: dwell_s(swept[plate]) for plate in subject.plates}
    longest_s = max(float(dwell.max()) if np.ma.count(dwell) else 0.0 for dwell, _ in maps.values())
    draw = [partial(_draw, subject, plate, (swept[plate]["half_m"], *maps[plate]), (shares[plate], longest_s)) for plate in subject.plates]
    return Panels(draw, size_in=(3.2, 3.7), finish=_scale, legend_below=True, single=subject.one_plate)


def fractions(subject: Subject) -> dict[int, float]:
    """The measured share of each plate that is swept: as the execution's report has it, or of the planned path."""
    if subject.execution is not None:
        return {p.plate: p.executed.fraction for p in subject.execution.report().plates}
    sponge_m = subject.plan.job.workcell.tool.sponge.radius_m
    shares = {}
    for index in subject.plates:
        plate, wash = subject.plan.plates[index], subject.wash_of(index)
        path = subject.planned_tip(wash.t_start_s, wash.t_end_s)[:, :2]
        shares[index] = _core.coverage(path, (plate.x_m, plate.y_m), plate.radius_m, sponge_m).fraction
    return shares


def dwell_s(swept: Mapping[str, Any]) -> tuple[Masked, Masked]:
    """Time under the sponge [s], and whether it never is; both masked outside the rim, shape (M, M), rows for y."""
    first, dwell = array(swept["first"]), array(swept["dwell"]).astype(float) * swept["dwell_step_s"]
    never = first == NEVER
    return np.ma.masked_array(dwell, (first == OUTSIDE) | never), np.ma.masked_array(never.astype(float), ~never)


def _draw(subject: Subject, index: int, swept: tuple[float, Masked, Masked], measured: tuple[float, float], ax: Axes) -> None:
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Circle

    (half_m, dwell, never), (share, longest_s) = swept, measured
    half = 1e3 * half_m
    box: dict[str, Any] = {"origin": "lower", "extent": (-half, half, -half, half), "interpolation": "nearest"}
    ax.imshow(dwell, cmap="cividis", vmin=0.0, vmax=longest_s, **box)
    ax.imshow(never, cmap=ListedColormap([palette.MISSED]), **box)
    ax.add_patch(Circle((0, 0), half, fill=False, edgecolor=palette.OUTLINE, linewidth=1.2))
    if np.ma.count(never):
        ax.plot([], [], marker="s", linestyle="none", color=palette.MISSED, label="never under the sponge")
    done = "planned" if subject.execution is None else "executed"
    ax.set_title(f"{subject.called(index)}\n{percent(share)} swept, {done}", fontsize="medium")
    ax.set(xlabel="x from its centre [mm]", ylabel="y from its centre [mm]", aspect="equal")
    edge = 1.04 * half
    ax.set(xlim=(-edge, edge), ylim=(-edge, edge))


def _scale(axes: list[Axes]) -> None:
    """One scale of colours for all, or one a figure where the caller's axes are in several."""
    for figure in dict.fromkeys(ax.figure for ax in axes):
        mine = [ax for ax in axes if ax.figure is figure]
        figure.colorbar(mine[0].images[0], ax=mine, label="time under the sponge [s]", shrink=0.8)
