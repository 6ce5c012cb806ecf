"""Time and dose of cells are never above those of dense samples of their points."""

import numpy as np
from jobs import irb120, plan
from platewash_check import shares
from platewash_check.motion import Instant, Motion
from platewash_check.washing import Washing


def test_cells_get_no_more_than_their_points(plan_file):
    arm, made = irb120(), plan(plan_file("kitchen"))
    motion = Motion(made.t, made.q, made.qd)
    washing = Washing(arm, made, motion)
    segment = next(s for s in made.segments if s["kind"] == "wash")
    time, dose, area = shares.of_plate(washing, segment)
    plate = made.plates[segment["plate"]]
    cells = shares.Cells(plate.radius)
    assert abs(area.sum() - np.pi * plate.radius**2) < 1e-12
    rng = np.random.default_rng(1)
    radius, angle = plate.radius * np.sqrt(rng.uniform(size=400)), rng.uniform(0, 2 * np.pi, 400)
    points = np.stack([radius * np.cos(angle), radius * np.sin(angle), np.zeros(400)], axis=1)
    ring = np.minimum((radius / cells.size).astype(int), len(cells.count) - 1)
    cell = cells.offset[ring] + (angle / (2 * np.pi) * cells.count[ring]).astype(int)
    tool, contact = made.tool, made.requirements["contact"]
    first, last = made.span(segment)
    # Every 0.2 ms: the plate 1 mm lower, the softest sponge.
    t = np.arange(made.t[first], made.t[last], 2e-4)
    piece = np.clip(np.searchsorted(made.t, t, side="right") - 1, first, last - 1)
    instant = Instant(arm, *motion.at(piece, t - made.t[piece])[:3], tool.tip)
    place, axis = washing.in_plate(segment, instant)
    turned, _ = washing.frames[segment["plate"]]
    speed, omega = instant.speed @ turned, instant.omega @ turned
    found_time, found_dose = np.zeros(400), np.zeros(400)
    for k, point in enumerate(points):
        away = point - [0, 0, contact["height_error_m"]] - place
        along = (away * axis).sum(axis=1)
        w = tool.compression - along
        touches = (np.linalg.norm(away - along[:, None] * axis, axis=1) <= tool.radius) & (w >= contact["compression_m"])
        slides = np.linalg.norm((speed + np.cross(omega, away))[:, :2], axis=1)
        found_time[k] = touches.sum() * 2e-4
        found_dose[k] = (touches * w * slides).sum() * 2e-4 * tool.stiffness[0] / (tool.height + tool.compression)
    assert (time[cell] <= found_time + 1e-3).all()
    assert (dose[cell] <= found_dose * (1 + 1e-3) + 0.05).all()
    # And not much less: cells of 0.2 mm lose about a hundredth.
    assert (dose[cell].sum() >= 0.96 * found_dose.sum()) and (time[cell].sum() >= 0.96 * found_time.sum())


def test_rows_are_the_cells_within_both_discs():
    rng, cells = np.random.default_rng(2), shares.Cells(0.02)
    centres = rng.uniform(-0.02, 0.02, (2, 60, 2))
    centres[1] = centres[0] + rng.uniform(-3e-4, 3e-4, (60, 2))
    radius = rng.uniform(0.001, 0.03, 60)
    step, ring, first, number = shares.rows(cells, centres, radius)
    x, y, area = cells.places()
    total = np.zeros((1, cells.total))
    for k in range(60):
        mine = step == k
        one = np.zeros((1, cells.total))
        shares.add(one, cells, (np.zeros(mine.sum(), int), ring[mine], first[mine], number[mine]), np.ones((1, 1)))
        found = (shares.sums(one[0], cells) > 0.5) & (area > 0)
        inside = (area > 0) & np.all(
            [np.hypot(x - c[k, 0], y - c[k, 1]) <= radius[k] for c in centres], axis=0
        )
        assert not (found & ~inside).any()
        # Those on the edge may be left out, and none in the midst.
        deep = np.all([np.hypot(x - c[k, 0], y - c[k, 1]) <= radius[k] - 1e-7 for c in centres], axis=0)
        assert (found | ~deep | (area == 0)).all()
