"""Lower bounds on distances are never above what coal finds at single moments, and not far below."""

import numpy as np
import pytest
from jobs import irb120, random_motion
from platewash_check.clearance import Part, bound_over

coal = pytest.importorskip("coal")


def turned(rng):
    q, r = np.linalg.qr(rng.normal(size=(3, 3)))
    q = q * np.sign(np.diag(r))
    return q if np.linalg.det(q) > 0 else -q


def random_part(rng, carrier, near):
    kind = rng.choice(["box", "sphere", "capsule", "cylinder", "hull"])
    shape = {
        "box": {"half_m": list(rng.uniform(0.01, 0.2, 3))},
        "sphere": {"radius_m": rng.uniform(0.01, 0.1)},
        "capsule": {"radius_m": rng.uniform(0.01, 0.05), "half_length_m": rng.uniform(0.01, 0.2)},
        "cylinder": {"radius_m": rng.uniform(0.01, 0.2), "half_length_m": rng.uniform(0.005, 0.2)},
        "hull": {"points": rng.uniform(-0.1, 0.1, (12, 3)).tolist()},
    }[kind]
    part = Part((turned(rng), rng.uniform(-near, near, 3)), {str(kind): shape})
    part.carrier = carrier
    return part, str(kind), shape


def in_coal(kind, shape):
    if kind == "box":
        return coal.Box(*(2 * np.array(shape["half_m"])))
    if kind == "sphere":
        return coal.Sphere(shape["radius_m"])
    if kind == "capsule":
        return coal.Capsule(shape["radius_m"], 2 * shape["half_length_m"])
    if kind == "cylinder":
        return coal.Cylinder(shape["radius_m"], 2 * shape["half_length_m"])
    points = coal.StdVec_Vec3s()
    for point in shape["points"]:
        points.append(np.array(point))
    return coal.Convex.convexHull(points, True, "")


def distance(a, b, poses):
    request, result = coal.DistanceRequest(), coal.DistanceResult()
    transforms = [coal.Transform3s(r, p) for r, p in poses]
    return coal.distance(a, transforms[0], b, transforms[1], request, result)


@pytest.mark.parametrize("seed", range(40))
def test_bounds_are_below_the_distances_of_coal(seed):
    arm, rng = irb120(), np.random.default_rng(seed)
    motion = random_motion(rng, knots=4)
    first = int(rng.integers(0, 4))
    last = int(rng.integers(first + 1, 7))
    (a, *of_a), (b, *of_b) = random_part(rng, first, 0.6), random_part(rng, last, 0.05)
    bodies = in_coal(*of_a), in_coal(*of_b)
    found = []
    for piece, h in enumerate(motion.h):
        u = np.linspace(0, h, 60)
        r, p = arm.frames(motion.at(np.full(len(u), piece), u)[0])
        for k in range(len(u)):
            place = lambda part: (r[part.carrier][k] @ part.r, p[part.carrier][k] + r[part.carrier][k] @ part.p)
            found.append(distance(*bodies, (place(a), place(b))))
    least = min(found)
    # Asked for so much that every step is halved as often as may be: the bound is as tight as it gets.
    required = max(least, 0) - 1e-3
    bound, _ = bound_over(arm, motion, a, b, [(0, len(motion.h))], required)
    assert bound <= max(least, 0) + 1e-6
    if least > 0.01:
        assert bound >= required, (least, bound)
