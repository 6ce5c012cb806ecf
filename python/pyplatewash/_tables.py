"""Tables in HTML for notebooks, one function for each kind of object, and a small picture of plates from above, in SVG."""

from __future__ import annotations

import html
import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from . import _core
from ._errors import PlatewashError
from ._values import Floats, Plate

#: Characters of a name that are told.
LONGEST_NAME = 100


def percent(share: float) -> str:
    """A share as a percentage with one decimal, rounded down, so that it is 100 only where nothing but rounding is missing.

    >>> percent(0.4202), percent(0.99994), percent(1.0)
    ('42.0 %', '99.9 %', '100 %')
    """
    return "100 %" if share >= 1 - 1e-9 else f"{math.floor(1e3 * share + 1e-9) / 10:.1f} %"


def quoted(name: str) -> str:
    r"""A name out of a file in quotes, on one line; of a long one the beginning, and its length.

    >>> print(quoted('a"b\nPROVED'))
    "a\"b\nPROVED"
    """
    begins = name[:LONGEST_NAME].replace("\\", "\\\\").replace('"', '\\"')
    shown = "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in begins)
    rest = f"… ({len(name)} characters)" if len(name) > LONGEST_NAME else ""
    return f'"{shown}"{rest}'


#: Edge of the picture [px].
EDGE_PX = 168
#: Most plates and points that are drawn.
MOST_PLATES, MOST_POINTS = 200, 4000
#: Room around the outermost rim, and the half width of the base [m].
ROOM_M, BASE_M = 0.03, 0.03


def from_above(plates: Sequence[Plate], paths: Iterable[Floats] = (), order: Sequence[int] = ()) -> str:
    """Plates, wash paths, each of shape (N, 2) [m], and the base at the origin; x to the right, y up. In colours that can be seen
    on light and dark."""
    shown = list(plates)[:MOST_PLATES]
    reach = [abs(c) + p.radius_m for p in shown for c in (p.x_m, p.y_m)]
    if not all(np.isfinite(reach)):
        return ""
    corners = np.array([(p.x_m + sx * p.radius_m, p.y_m + sy * p.radius_m) for p in shown for sx, sy in ((1, 1), (-1, -1))] + [(-BASE_M, -BASE_M), (BASE_M, BASE_M)])
    low, high = corners.min(axis=0) - ROOM_M, corners.max(axis=0) + ROOM_M
    width, height = high - low
    pixel = max(width, height) / EDGE_PX
    lines = [_plate(plate, pixel) for plate in shown]
    lines += [_path(path, pixel) for path in paths if np.isfinite(path).all() and len(path) > 1]
    lines += [_number(shown[index], visit, pixel) for visit, index in enumerate(order, 1) if index < len(shown)]
    base = f'<path d="M{-BASE_M:g} {BASE_M:g}L0 {-BASE_M:g}L{BASE_M:g} {BASE_M:g}Z" fill="currentColor"/>'
    box = f"{low[0]:.4g} {-high[1]:.4g} {width:.4g} {height:.4g}"
    return (
        f'<svg role="img" aria-label="the plates from above" width="{width / pixel:.0f}" height="{height / pixel:.0f}" viewBox="{box}"'
        f' xmlns="http://www.w3.org/2000/svg">{"".join(lines)}{base}</svg>'
    )


def _plate(plate: Plate, pixel: float) -> str:
    return (
        f'<circle cx="{plate.x_m:.5g}" cy="{-plate.y_m:.5g}" r="{plate.radius_m:.5g}" fill="currentColor" fill-opacity="0.08"'
        f' stroke="currentColor" stroke-opacity="0.6" stroke-width="{pixel:.3g}"/>'
    )


def _path(path: Floats, pixel: float) -> str:
    points = path[:: max(len(path) // MOST_POINTS, 1)]
    d = "L".join(f"{x:.4g} {-y:.4g}" for x, y in points)
    return f'<path d="M{d}" fill="none" stroke="#d6409f" stroke-width="{1.2 * pixel:.3g}"/>'


def _number(plate: Plate, visit: int, pixel: float) -> str:
    return (
        f'<text x="{plate.x_m:.5g}" y="{-plate.y_m:.5g}" font-size="{13 * pixel:.3g}" font-family="sans-serif" font-weight="600"'
        f' text-anchor="middle" dominant-baseline="central" fill="currentColor">{visit}</text>'
    )


#: Most characters of a text and most lines of a table.
MOST_CHARACTERS, MOST_LINES = 400, 60

#: Most plates whose wash paths a picture shows.
MOST_PATHS = 24

_CELL = "text-align:left;vertical-align:top;padding:0.15em 0.8em 0.15em 0"
#: A status has a sign of its own, so that it is not told by its colour alone.
_SIGNS = {"proved": "✓", "violated": "✗", "not_proved": "?", "waived": "!", "washed": "✓", "swept": "✓", "not_washed": "✗", "not_swept": "✗"}


def shown(value: object) -> str:
    """A value as the text of a cell: escaped, cut where it is long, and for itself where it is written from right to left."""
    text = value if isinstance(value, str) else str(value)
    text = "".join(c if c.isprintable() or c == "\n" else "\N{REPLACEMENT CHARACTER}" for c in text)
    text = text if len(text) <= MOST_CHARACTERS else f"{text[: MOST_CHARACTERS - 1]}…"
    return f"<bdi>{html.escape(text)}</bdi>"


class Raw(str):
    """Text that is HTML already."""


def status(word: str) -> Raw:
    """A status with its sign."""
    text = f"{_SIGNS.get(word, '')} {html.escape(word.replace('_', ' '))}".strip()
    return Raw(f'<span style="white-space:nowrap">{text}</span>')


def table(rows: Iterable[Sequence[object]], head: Sequence[str] = ()) -> Raw:
    """Rows of cells; the first cell of each names it."""
    lines = list(rows)
    left = len(lines) - MOST_LINES
    if left > 0:
        lines = [*lines[:MOST_LINES], (f"… and {left} more",)]
    cells = ["".join(_cell(cell, "th" if k == 0 else "td") for k, cell in enumerate(row)) for row in lines]
    top = f"<thead><tr>{''.join(_cell(name, 'th') for name in head)}</tr></thead>" if head else ""
    body = "".join(f"<tr>{row}</tr>" for row in cells)
    return Raw(f'<table style="margin:0;border-collapse:collapse">{top}<tbody>{body}</tbody></table>')


def _cell(value: object, tag: str) -> str:
    return f'<{tag} style="{_CELL}">{value if isinstance(value, Raw) else shown(value)}</{tag}>'


def page(title: object, parts: Iterable[str]) -> str:
    """A headline over tables and pictures that stand beside one another."""
    inner = "".join(f"<div>{part}</div>" for part in parts if part)
    return f'<div><strong>{shown(title)}</strong><div style="display:flex;flex-wrap:wrap;gap:1.5em;align-items:flex-start">{inner}</div></div>'


def dry_run(of: _core.Plan) -> str | None:
    """What must be read first of a dry run; None for what is none."""
    stated = getattr(of.job, "dry_run", None)
    return None if stated is None else f"DRY RUN of {stated.parent[:12]}, {1e3 * stated.height_m:g} mm above the plates, nothing is washed"


def plan(of: _core.Plan) -> str:
    """A plan: it says nothing about a proof."""
    hash_ = "none" if of.hash is None else f"{of.hash[:12]}… ({'as sealed' if of.is_sealed() else 'NOT that of the contents'})"
    rows = [
        ("process", of.process),
        ("seed", of.job.seed),
        ("plates", f"{len(of.order)}, in the order {_listed(of.order)}"),
        ("duration", f"{of.duration_s:.2f} s, {len(of.segments)} segments"),
        ("arm", of.job.workcell.arm.name),
        ("hash", hash_),
        ("proof", "none for a run of the paper's program" if of.process == "paper" else "see prove(plan)"),
    ]
    first = dry_run(of)
    return page(f"{'' if first is None else f'{first}; '}Plan of {quoted(of.provenance.scenario)}", [table(rows), plan_picture(of)])


def planned(of: _core.Planned) -> str:
    rows = [(f"{k}: {plate_name(v.plate)}", f"{v.wash_s:.2f} s") for k, v in enumerate(of.visits, 1)]
    tour = of.tour
    whole = [
        ("duration", f"{of.plan.duration_s:.2f} s"),
        ("between plates", f"{tour.travel_s:.2f} s (nearest first: {tour.nearest_next_s:.2f} s)"),
        ("proof", "see prove(planned.plan)"),
    ]
    return page(f"Planned, not proved: {quoted(of.plan.provenance.scenario)}", [table(whole), table(rows, ("wash", "time")), plan_picture(of.plan)])


def certificate(of: _core.Certificate) -> str:
    rows = [(name, status(word), detail, worst) for name, word, detail, worst in of._rows()]
    sign = "✓" if of.proved else "✗"
    return page(f"{sign} {of.headline}", [table(rows, ("requirement", "status", "measure", "worst"))])


def layout(of: _core.Layout) -> str:
    plates = [(k, f"({p.x_m:.4f}, {p.y_m:.4f}) m", f"{1e3 * p.radius_m:g} mm") for k, p in enumerate(of.plates, 1)]
    findings = [(k, str(finding)) for k, finding in enumerate(of.findings, 1)]
    parts = [table(plates, ("plate", "centre", "radius")), table(findings, ("finding", "")) if findings else "", from_above(of.plates)]
    return page(f"Layout: {len(of)} plates, {'no findings' if not findings else f'{len(findings)} findings'}", parts)


def job(of: _core.WashJob | _core.PaperJob) -> str:
    rows = [("program", "the paper's" if isinstance(of, _core.PaperJob) else "certified"), ("seed", of.seed), ("arm", of.robot.name), ("plates", len(of.layout))]
    return page(f"Job {quoted(of.name)}", [table(rows), from_above(of.layout.plates)])


def execution(of: _core.Execution) -> str:
    report = of.report()
    rows = [(plate_name(p.plate), status(p.verdict), percent(p.planned.fraction), percent(p.executed.fraction)) for p in report.plates]
    whole = [
        ("law", of.settings.law),
        ("tip off by", f"{1e3 * report.tracking.tip_m.rms:.3g} mm rms, {1e3 * report.tracking.tip_m.max:.3g} mm at most"),
        ("samples", f"{len(of)}, every {1e3 * of.period_s:g} ms"),
        ("saturated", f"{of.saturated} samples"),
    ]
    title = f"Execution of {quoted(of.plan.provenance.scenario)}: {report.headline}"
    return page(title, [table(whole), table(rows, ("plate", "verdict", "swept as planned", "executed"))])


def paper_run(of: _core.PaperRun) -> str:
    report = of.report()
    rows = [
        (plate_name(p.plate), f"{p.reached} of {p.waypoints}", percent(p.ideal_coverage.fraction), percent(p.executed_coverage.fraction), f"{1e3 * p.tracking_rms_m:.1f} mm")
        for p in report.plates
    ]
    head = ("plate", "waypoints reached", "swept as commanded", "executed", "tip off by, rms")
    paths = [of.targets[of.washing & (of.plate == index), :2] for index in of.order]
    return page(report.headline, [table(rows, head), from_above(of.job.layout.plates, paths, of.order)])


def robot(of: _core.Robot) -> str:
    degrees = np.degrees([of.lower, of.upper, of.velocity])
    rows = [
        (name, f"{low:g} to {high:g} °", f"{speed:g} °/s", "–" if effort is None else f"{effort:g} N·m")
        for name, low, high, speed, effort in zip(of.joint_names, *degrees.round(3), of.effort)
    ]
    return page(f"Robot: {of.name}", [table(rows, ("joint", "position", "speed", "torque"))])


def study_rows(title: str, outcomes: Mapping[str, int], by_axis: Mapping[str, Mapping[str, Mapping[str, int]]]) -> str:
    """How many rows ended how, in all and by the values of axes."""
    codes = list(outcomes)
    parts = [table([("all", *outcomes.values())], ("rows", *codes))]
    for key, values in by_axis.items():
        parts.append(table([(value, *(counts.get(code, 0) for code in codes)) for value, counts in values.items()], (key, *codes)))
    return page(title, parts)


def record(of: Mapping[str, object], text: str | None) -> str:
    """A report as its text; any other record as its keys and values."""
    if text is not None:
        return f'<pre style="white-space:pre-wrap">{html.escape(text)}</pre>'
    return str(table((key, _brief(value)) for key, value in of.items()))


def _brief(value: object) -> object:
    if isinstance(value, Mapping):
        return "{" + ", ".join(map(str, value)) + "}"
    if isinstance(value, list) and len(value) > 8:
        return f"{len(value)} items"
    return value


def plan_picture(of: _core.Plan) -> str:
    """The plates of a plan with their wash paths; nothing for a file whose numbers make no picture."""
    try:
        return from_above(of.plates, wash_paths(of), of.order)
    except (PlatewashError, IndexError):
        return ""


def wash_paths(of: _core.Plan) -> list[Floats]:
    """The curves of a plan's wash paths from above, each of shape (N, 2), world frame [m]; for a run of the paper's program, where its
    motion goes while it washes, if its arm is known."""
    if of.process == "paper":
        if of.robot is None:
            return []
        # At rest in the world, without a tool: the program moves the flange.
        spans = [np.linspace(s.t_start_s, s.t_end_s, 200) for s in of.segments if s.kind == "wash"]
        return [of.robot.fk(of.trajectory.at(t_s)[0])[:, :2, 3] for t_s in spans]
    return of._wash_curves(1.5e-3) if len(of.plates) <= MOST_PATHS else []


def plate_name(index: int) -> str:
    """Name of a plate in words, counted from 1."""
    return f"plate {index + 1}"


def _listed(order: Sequence[int]) -> str:
    """An order of plates in words, counted from 1."""
    return ", ".join(str(index + 1) for index in order[:20]) + (", …" if len(order) > 20 else "")
