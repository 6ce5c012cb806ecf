"""Shares of flat plates: swept, pressed, contact time and contact dose.

A plate is cut into polar cells. A cell counts in a step only if all of it is under the sponge during the whole step. On each ring these are
cells in a row, so that a step adds its time and its dose at two ends of a row, and sums along the rings do the rest. In a step the
compression w and the speed l along one direction are, up to bounds that are taken off, linear in the place and in time: so the least dose
of a cell is a polynomial of second degree in its place, and only its six coefficients are added.
"""

import numpy as np

from .motion import Steps
from .verdict import judged

# Size of the cells [m], length of the steps [s], and steps that are added at a time.
CELL, STEP, CHUNK = 2.0e-4, 1e-3, 1000
# Allowance for the rounding of sums, as a share of what is asked for.
ROUND = 1e-9


class Cells:
    """The polar cells of a disc."""

    def __init__(self, radius):
        rings = int(np.ceil(radius / CELL))
        self.size = radius / rings
        self.inner = np.arange(rings) * self.size
        self.middle = self.inner + 0.5 * self.size
        self.count = np.ceil(2 * np.pi * (self.inner + self.size) / self.size).astype(int)
        # Each ring has a place more, at which rows that end with it are taken off.
        self.offset = np.concatenate([[0], np.cumsum(self.count + 1)])
        self.area = 0.5 * (2 * np.pi / self.count) * ((self.inner + self.size) ** 2 - self.inner**2)
        half = np.pi / self.count
        corner = lambda r: np.hypot(r * np.cos(half) - self.middle, r * np.sin(half))
        # Greatest distance of a point of a cell from its middle.
        self.reach = np.maximum(corner(self.inner), corner(self.inner + self.size)).max()
        self.total = self.offset[-1]

    def places(self):
        ring = np.repeat(np.arange(len(self.count)), self.count + 1)
        k = np.arange(self.total) - self.offset[ring]
        angle = (k + 0.5) * 2 * np.pi / self.count[ring]
        area = np.where(k < self.count[ring], self.area[ring], 0.0)
        return self.middle[ring] * np.cos(angle), self.middle[ring] * np.sin(angle), area


def rows(cells, centres, radius):
    """Rows of cells whose middles are within discs at both ends of steps: step, ring, first cell, number. `centres` are those of the discs at
    both ends, (2, N, 2); `radius` is that of the discs, (N)."""
    away = np.linalg.norm(centres, axis=2)
    angle = np.arctan2(centres[..., 1], centres[..., 0])
    low, high, whole = [], [], []
    r = cells.middle[None, :]
    for k in range(2):
        d = away[k][:, None]
        with np.errstate(divide="ignore", invalid="ignore"):
            cos = (r**2 + d**2 - radius[:, None] ** 2) / (2 * r * d)
        # Beyond -1 the whole ring is within, beyond 1 none of it.
        inside = r + d <= radius[:, None]
        wide = np.where(abs(r - d) <= radius[:, None], np.arccos(np.clip(cos, -1, 1)), -np.inf)
        turn = angle[k] if k == 0 else angle[0] + (angle[1] - angle[0] + np.pi) % (2 * np.pi) - np.pi
        low.append(np.where(inside, -np.inf, turn[:, None] - wide))
        high.append(np.where(inside, np.inf, turn[:, None] + wide))
        whole.append(inside)
    low, high = np.maximum(*low), np.minimum(*high)
    all_of_it = whole[0] & whole[1]
    unit = 2 * np.pi / cells.count[None, :]
    with np.errstate(invalid="ignore"):
        first = np.ceil(np.where(all_of_it, 0, low) / unit - 0.5 + 1e-9)
        last = np.floor(np.where(all_of_it, 0, high) / unit - 0.5 - 1e-9)
    number = np.where(all_of_it, cells.count[None, :], np.clip(last - first + 1, 0, cells.count[None, :]))
    number = np.where(np.isfinite(number), number, 0).astype(int)
    step, ring = np.nonzero(number)
    number = number[step, ring]
    first = np.where(all_of_it[step, ring], 0, first[step, ring]).astype(int) % cells.count[ring]
    return step, ring, first, number


def add(total, cells, found, weights):
    """Adds the weights (N, W) of steps to the sums (W, cells) at the ends of their rows."""
    step, ring, first, number = found
    end, count, offset = first + number, cells.count[ring], cells.offset[ring]
    wraps = end > count
    places = np.concatenate([offset + first, offset + np.minimum(end, count), offset[wraps], (offset + end - count)[wraps]])
    steps = np.concatenate([step, step, step[wraps], step[wraps]])
    ones = np.ones(len(step))
    signs = np.concatenate([ones, -ones, ones[wraps], -ones[wraps]])
    for k in range(len(total)):
        total[k] += np.bincount(places, weights=signs * weights[steps, k], minlength=cells.total)


def linear(place, axis, speed, omega, along, tool):
    """Coefficients of 1, x, y of compression and of speed along a direction, over the face z = 0 of a plate."""
    w = np.stack([tool.compression + (place * axis).sum(axis=1), -axis[:, 0], -axis[:, 1]], axis=1)
    # along . (v + omega x (x - p)) = along . v + (x - p) . (along x omega)
    lever = np.cross(along, omega)
    l = np.stack([(along * speed).sum(axis=1) - (place * lever).sum(axis=1), lever[:, 0], lever[:, 1]], axis=1)
    return w, l


def product(w, l):
    """Coefficients of 1, x, y, x^2, x y, y^2 of a product of two linear functions."""
    both = w[:, :, None] * l[:, None, :]
    first, second = [0, 0, 0, 1, 1, 2], [0, 1, 2, 1, 2, 2]
    return both[:, first, second] + np.where(np.equal(first, second), 0, both[:, second, first])


def of_plate(washing, segment):
    """Time [s] and dose [Pa m] of each cell of the plate that a segment washes, with the areas of the cells; least values over all heights of
    the plate."""
    plan, tool = washing.plan, washing.plan.tool
    contact = plan.requirements.get("contact")
    delta = contact["height_error_m"] if contact else 0.0
    least = contact["compression_m"] if contact else 0.0
    stiffness = tool.stiffness[0] if tool.stiffness else 0.0
    cells, free = Cells(plan.plates[segment["plate"]].radius), tool.height + tool.compression
    steps = washing.steps(segment, STEP)
    turned, _ = washing.frames[segment["plate"]]
    total = np.zeros((7, cells.total))
    for begin in range(0, len(steps), CHUNK):
        part = steps.part(slice(begin, begin + CHUNK))
        ends = washing.ends(part)
        h = ends.h
        both = [washing.in_plate(segment, instant) for instant in ends.at]
        speeds = [instant.speed @ turned for instant in ends.at]
        turns = [instant.omega @ turned for instant in ends.at]
        along = speeds[0] + speeds[1]
        along[:, 2] = 0
        along /= np.maximum(np.linalg.norm(along, axis=1), 1e-300)[:, None]
        # Bounds over the step: speeds V, accelerations A, those of the axis, and how far a place in contact is from the tip.
        v = ends.most([np.linalg.norm(instant.speed, axis=1) for instant in ends.at], ends.tip[3])
        far = np.hypot(tool.radius, free) + v * h + delta
        a1, a2, a3 = ends.axis[1], ends.axis[2], ends.axis[3]
        off_w = h**2 / 8 * (ends.tip[2] + 2 * v * a1 + far * a2)
        off_d = h**2 / 8 * (ends.tip[2] + 4 * v * a1 + 2 * far * (a2 + a1**2))
        off_l = h**2 / 8 * (ends.tip[3] + far * a3 + 2 * a2 * v + a1 * ends.tip[2])
        tilt = np.maximum(*(np.linalg.norm(axis[:, :2], axis=1) for _, axis in both)) + h**2 / 8 * a2
        # Where the axis meets the face, and a disc about it all of which is within the sponge's radius of the axis.
        centres = np.stack([(place - axis * (place[:, 2:] / axis[:, 2:]))[:, :2] for place, axis in both])
        radius = tool.radius - off_d - delta * tilt - cells.reach
        w, l = zip(*(linear(p, x, s, o, along, tool) for (p, x), s, o in zip(both, speeds, turns)))
        # The plate may lie lower, and the compression is least somewhere in the cell.
        for k in range(2):
            w[k][:, 0] -= delta + off_w + cells.reach * tilt
            l[k][:, 0] -= off_l + cells.reach * np.linalg.norm(turns[k], axis=1)
        at_centre = [a[:, 0] + (a[:, 1:] * c).sum(axis=1) for a, c in zip(w, centres)]
        presses = np.minimum(*at_centre) - tool.radius * tilt >= (least if contact else -np.inf)
        if not contact:
            presses = np.ones(len(h), dtype=bool)
        # The integral over the step of a product of two functions that are linear in time.
        dose = (product(w[0], l[0]) + product(w[1], l[1])) / 3 + (product(w[0], l[1]) + product(w[1], l[0])) / 6
        weights = np.concatenate([h[:, None], dose * (h * stiffness / free)[:, None]], axis=1)
        weights[~presses] = 0
        add(total, cells, rows(cells, centres, np.where(presses, radius, -1.0)), weights)
    for k in range(len(total)):
        total[k] = sums(total[k], cells)
    x, y, area = cells.places()
    dose = total[1] + total[2] * x + total[3] * y + total[4] * x**2 + total[5] * x * y + total[6] * y**2
    return total[0], dose, area


def sums(values, cells):
    """Sums along each ring: those along all of them, less what was reached at the ring's beginning."""
    running = np.cumsum(values)
    before = np.concatenate([[0], running])[cells.offset[:-1]]
    return running - np.repeat(before, cells.count + 1)


def answers(washing, progress=lambda words: None):
    """26 to 29, the least share over all plates."""
    plan = washing.plan
    if plan.is_home:
        return
    need, contact = plan.requirements, plan.requirements.get("contact")
    asked = {"swept": (need["coverage"], None)}
    if contact:
        asked["pressed"] = (contact["share"], None)
        asked["contact_time"] = (contact["time_share"], contact["time_s"])
        asked["contact_dose"] = (contact["dose_share"], contact["dose_pa_m"])
    found = {name: (np.inf, "") for name in asked}
    for segment in plan.segments:
        if segment["kind"] != "wash":
            continue
        progress(f"what is washed of plate {segment['plate'] + 1}")
        time, dose, area = of_plate(washing, segment)
        whole = np.pi * plan.plates[segment["plate"]].radius ** 2
        for name, (_, least) in asked.items():
            got = dose if name == "contact_dose" else time
            enough = got >= least * (1 + ROUND) if least is not None else time > 0.1 * STEP
            share = area[enough].sum() / whole
            if not share >= found[name][0]:
                found[name] = (share, f"plate {segment['plate'] + 1}")
    for name, (share, words) in found.items():
        yield judged(name, share - ROUND, asked[name][0], "", words, at_least=True)
