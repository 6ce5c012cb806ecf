"""Statements of the plan about itself: 1 to 14 of the certificate that need no bound on the tool's motion."""

from copy import copy

import numpy as np

from .clearance import Part
from .verdict import judged, stated

# Differences that are rounding: of lengths [m], of angles and speeds at rest [rad, rad/s], of overlaps [m].
SAME_M, REST, OVERLAP_M = 1e-9, 1e-9, 1e-6


def answers(arm, plan, motion, clearance):
    yield stated("arm", list(of_arm(arm, plan)))
    yield stated("tool", list(of_tool(plan)))
    yield stated("plates", list(below_floor(plan, plan.plates)))
    if plan.dry_run:
        yield stated("dry_run", list(raised(plan, clearance)))
    yield stated("exclusions", clearance.exclusions() + clearance.still())
    yield stated("wash_paths", list(of_paths(plan)))
    yield stated("segments", list(of_segments(plan)))
    yield stated("every_plate_once", list(once(plan)))
    yield stated("home_to_home", list(from_home(plan)))
    if not plan.is_home:
        yield stated("rest_at_wash_ends", list(at_rest(plan)))
    yield stated("plates_apart", list(apart(plan, clearance, clearance.plate_of)))
    low, high, speed, acceleration = motion.extremes()
    margin = np.minimum(low - arm.lower, arm.upper - high).min(axis=0)
    joint = lambda values: arm.joints[int(np.argmin(values))].name
    yield judged("joint_position", margin.min(), 0.0, "rad", joint(margin), at_least=True)
    limits = np.minimum(plan.limits["joint_acceleration_rad_s2"], arm.acceleration)
    # A limit may be used in full: a part in 10^9 is rounding of the planner's own sums.
    for name, found, most, unit in (
        ("joint_speed", speed, arm.speed, "rad/s"),
        ("joint_acceleration", acceleration, limits, "rad/s^2"),
    ):
        share = (found / most).max(axis=0)
        k = int(np.argmax(share))
        yield judged(name, found[:, k].max(), most[k] * (1 + 1e-9), unit, arm.joints[k].name)


def of_arm(arm, plan):
    if plan.hash != plan.hash_found:
        yield "the plan was changed after it was written: its hash does not match"
    if arm.name != plan.arm["name"]:
        yield f"the plan is of {plan.arm['name']}, the description of {arm.name}"
    if arm.urdf_sha256 != plan.arm["urdf_sha256"]:
        yield "the description is not the plan's (SHA-256)"
    if arm.srdf_sha256 != plan.arm.get("srdf_sha256"):
        yield "the SRDF is not the plan's (SHA-256)"


def of_tool(plan):
    """The tip is the middle of the sponge's far face, its z out of the tool; no body reaches into the sponge."""
    tool = plan.tool
    (r, p), (tip_r, tip_p) = tool.sponge_pose, tool.tip
    face = p + r @ np.array([0, 0, 0.5 * tool.height])
    if np.linalg.norm(face - tip_p) > SAME_M or np.linalg.norm(r[:, 2] - tip_r[:, 2]) > SAME_M:
        yield "the tip is not the middle of the sponge's far face"
    axis, near = r[:, 2], p - r @ np.array([0, 0, 0.5 * tool.height])
    for body in tool.bodies:
        part = Part(body.pose, body.shape)
        in_part = part.r.T @ axis
        top = part.support(in_part[None])[0] @ in_part + axis @ part.p + part.pad
        if top > axis @ near + SAME_M:
            yield f"{body.name} reaches beyond the sponge's near face"


def below_floor(plan, plates):
    """No plate reaches below the floor: a level half-space that is an obstacle of that name."""
    for body in plan.obstacles:
        if body.name != "floor" or body.shape != "half_space":
            continue
        normal, height = body.pose[0][:, 2], body.pose[0][:, 2] @ body.pose[1]
        for k, plate in enumerate(plates):
            across = plate.radius * np.linalg.norm(np.cross(normal, plate.normal))
            centre = normal @ plate.pose[1]
            low = min(centre, centre - plate.thickness * (normal @ plate.normal)) - across - height
            if low < -SAME_M:
                yield f"plate {k + 1} reaches {-1e3 * low:.2f} mm below the floor"


def raised(plan, clearance):
    """In a dry run each plate has its real one as an obstacle below it, by the stated height; these stand where plates can."""
    height, obstacles, real = plan.dry_run["height_m"], {body.name: body for body in plan.obstacles}, []
    for k, plate in enumerate(plan.plates):
        found = obstacles.get(f"real plate {k + 1}")
        down = (0.5 * plate.thickness + height) * plate.normal
        if found is None or not isinstance(found.shape, dict) or found.shape.get("convex", {}).keys() != {"cylinder"}:
            yield f"plate {k + 1} has no real plate below it"
            continue
        disc = found.shape["convex"]["cylinder"]
        sizes = disc["radius_m"] - plate.radius, disc["half_length_m"] - 0.5 * plate.thickness
        off = np.r_[sizes, found.pose[1] + down - plate.pose[1], found.pose[0][:, 2] - plate.normal]
        if not (abs(off) <= SAME_M).all():
            yield f"real plate {k + 1} is not {1e3 * height:g} mm below the raised one"
        lowered = copy(plate)
        lowered.pose = plate.pose[0], plate.pose[1] - height * plate.normal
        real.append(lowered)
    yield from (f"real plates: {words}" for words in below_floor(plan, real))
    names = {f"real plate {k + 1}": k for k in range(len(plan.plates))}
    yield from (f"real plates: {words}" for words in apart(plan, clearance, names))


def of_paths(plan):
    if sorted(plan.paths) != sorted(plan.order) or plan.path_order != plan.order:
        yield "expected a wash path for each plate, in the order of washing"
    for plate, path in plan.paths.items():
        if not path["cone_rad"] <= plan.requirements["tilt_rad"] + 1e-12:
            yield f"the cone of plate {plate + 1} is wider than the tilt limit"


def of_segments(plan):
    """Depart; approach, wash and retreat of each plate, a transit between; return; without gaps, from knot to knot."""
    if plan.is_home:
        expected = [("retreat", plan.retreat["plate"])] if plan.retreat else []
        expected += [("return", segment["plate"]) for segment in plan.segments[-1:]]
    else:
        expected = []
    for plate in plan.order:
        first = "transit" if expected else "depart"
        expected += [(kind, plate) for kind in (first, "approach", "wash", "retreat")]
    expected += [("return", plate) for plate in plan.order[-1:]]
    if not expected or [(s["kind"], s["plate"]) for s in plan.segments] != expected:
        yield "the segments are not those of the order"
        return
    # Each begins where the one before ends, and at a knot: so the plan file is read.
    if plan.segments[-1]["t_end_s"] != plan.t[-1]:
        yield "the segments do not cover the motion"


def once(plan):
    count = len(plan.plates)
    washed = [plate for plate in range(count) if plate not in plan.left_out]
    if sorted(plan.order) != washed:
        yield "not every plate is in the order once"
    elif plan.requirements["as_listed"] and plan.order != washed:
        yield "the plates are not washed as listed"
    tool, tilt = plan.tool, plan.requirements["tilt_rad"]
    sponge = tool.radius / np.cos(tilt)
    for washed, path in plan.paths.items():
        for other in range(count):
            a, b = plan.plates[washed], plan.plates[other]
            if other == washed or np.linalg.norm(np.cross(a.normal, b.normal)) > 1e-9:
                continue
            away = b.pose[1] - a.pose[1]
            between = np.linalg.norm(away - (away @ a.normal) * a.normal) - a.radius - b.radius
            # The sponge sweeps no more than the rim of another plate.
            if path["curve"]["radius_m"] + sponge - a.radius - between > min(sponge, b.radius) + SAME_M:
                yield f"washing plate {washed + 1} also sweeps plate {other + 1}"


def from_home(plan):
    for k, (knot, words) in enumerate(((0, "begins"), (-1, "ends"))):
        if np.abs(plan.q[knot] - plan.home[k]).max() > REST or np.abs(plan.qd[knot]).max() > REST:
            yield f"the motion {words} not at home, or not at rest"


def at_rest(plan):
    for segment in plan.segments:
        if segment["kind"] == "wash" and np.abs(plan.qd[plan.span(segment)]).max() > REST:
            yield f"the arm does not rest at both ends of the wash of plate {segment['plate'] + 1}"


def apart(plan, clearance, plate_of):
    """No two bodies that stand overlap, where one is a plate or the base; `plate_of` has the plates by the names of their bodies. Of a dry
    run's real plates the raised ones are none."""
    if plan.requirements["overlap"] != "fail":
        yield "overlapping plates are only reported in this job, which is not checked"
        return
    others = set(clearance.plate_of) - set(plate_of)
    still = [body for body in clearance.bodies if body.carrier == 0 and body.name not in others]
    for k, a in enumerate(still):
        for b in still[k + 1 :]:
            # The base is the first of a pair with it.
            is_base, plates = a.name in clearance.links, [plate_of[x.name] for x in (a, b) if x.name in plate_of]
            if not plates and not is_base or b.name in clearance.links:
                continue
            other = next((x.name for x in (a, b) if x.name not in plate_of), None)
            held = not is_base and other is not None and holds(plan, other, plates[0])
            is_ground = b.plane is not None and abs(b.plane[1]) <= 1e-9 and b.plane[0][2] >= 1 - 1e-9
            gap = np.inf if held or (is_base and is_ground) else clearance.at_rest(a, b)
            if not gap >= -OVERLAP_M:
                yield f"{a.name} and {b.name} overlap, or are not shown to be apart ({1e3 * gap:.3f} mm)"


def holds(plan, name, plate):
    """True for an obstacle that holds a plate, as the job states."""
    held = next(body.holds for body in plan.obstacles if body.name == name)
    return held is not None and (held == "all" or plate in held)
