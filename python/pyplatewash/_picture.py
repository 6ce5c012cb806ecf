"""A small picture of plates from above, in SVG, for tables in notebooks."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from ._values import Floats, Plate

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
