"""What the tool does to flat plates: speeds, tilt, contact height, path deviation, contact speed, strain and contact force.

Each quantity f is evaluated at both ends of steps. Between them |f| <= max of the ends + h^2/8 sup |f''|; where that is not within the limit,
the step is halved.
"""

import numpy as np

from .motion import Ends, Steps
from .plan import compose, inverse
from .verdict import judged, not_checked, stated

# Tolerances of the certificate: of the tip about its path and over the face, and about the lines to its ends [m].
PATH_M, LINE_M = 2e-4, 1e-3
# Allowance for rounding of lengths [m], speeds [m/s], accelerations [m/s^2] and angles [rad]: see the README.
ROUND = 1e-11

HALVINGS = 14


def norm(values):
    return np.linalg.norm(values, axis=-1)


def worse(a, b):
    """The greater of two bounds with their moments; what is no number is worst."""
    return a if b[0] <= a[0] or a[0] != a[0] else b


class Curve:
    """The curve of a wash path on a flat face: the radius as a function of the angle theta from its start."""

    def __init__(self, table):
        self.radius, self.start = table["radius_m"], table["start_angle_rad"]
        rings = table.get("rings")
        closing = table["closing_ring"]
        turn = 2 * np.pi * (rings or {}).get("laps", 1) - table.get("trim_rad", 0.0)
        self.stages = []
        if rings:
            pitch = (self.radius - rings["inner_m"]) / (rings["count"] - 1)
            at = 0.0
            for k in range(rings["count"] - 1):
                share = (k + 1) ** (-3 / 8)
                ring = max(2 * np.pi * rings.get("laps", 1) - rings["lead_rad"] * share, 0.0)
                blend = rings["blend_rad"] * share
                self.stages.append((at + ring, blend, rings["inner_m"] + k * pitch, pitch))
                at += ring + blend
            # Greatest slope and bend of the blend of seventh degree.
            narrow = min(stage[1] for stage in self.stages)
            self.first, self.second = 2.1875 * abs(pitch) / narrow, 7.5132 * abs(pitch) / narrow**2
            self.last = at
        else:
            self.last = 2 * np.pi * table["turns"]
            self.rate = self.radius / (self.last - 0.5)
            self.first, self.second = self.rate, 1.875 * self.rate
        self.end = self.last + (turn if closing else 0.0)

    def distance(self, theta):
        """Distance from the centre."""
        if self.stages:
            radius = np.full_like(theta, self.radius)
            for begins, blend, inner, pitch in reversed(self.stages):
                x = np.clip((theta - begins) / blend, 0, 1)
                rise = x**4 * (35 - 84 * x + 70 * x**2 - 20 * x**3)
                radius = np.where(theta < begins + blend, inner + pitch * rise, radius)
            return radius
        # The rate falls to 0 over the last radian as 1 - x^3 (10 - 15 x + 6 x^2).
        x = np.clip(theta - (self.last - 1), 0, 1)
        grown = np.minimum(theta, self.last - 1) + x - x**4 * (2.5 - 3 * x + x**2)
        return np.where(theta >= self.last, self.radius, self.rate * grown)

    def at(self, theta):
        radius, angle = self.distance(theta), self.start + theta
        return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1)

    def bend(self):
        """Bound on the second derivative of the point by theta: |r''| + r + 2 |r'|."""
        return self.second + self.radius + 2 * self.first


class Washing:
    """The motion of the tool beside each plate, and the answers about it."""

    def __init__(self, arm, plan, motion):
        self.arm, self.plan, self.motion = arm, plan, motion
        self.frames = [compose(inverse(plan.mount), plate.pose) for plate in plan.plates]

    def steps(self, segment, longest):
        first, last = self.plan.span(segment)
        return Steps.cover(self.motion, first, last, longest)

    def ends(self, steps):
        return Ends(self.arm, self.motion, steps, self.plan.tool.tip)

    def most(self, steps, evaluate, limit):
        """Greatest value over steps: `evaluate` gives the values at both ends, a bound on the second derivative and, if it is not where an end
        is beyond the limit, where shorter steps do not help. Halves what is not within the limit. Returns the bound and the moment of the
        worst step."""
        worst = (-np.inf, 0.0)
        for round in range(HALVINGS + 1):
            values, second, *hopeless = evaluate(steps, self.ends(steps))
            ends = np.maximum(values[0], values[1])
            bound = ends + (steps.end - steps.start) ** 2 / 8 * second + ROUND
            again = (bound > limit) & ~(hopeless[0] if hopeless else ends > limit) & (round < HALVINGS)
            worst = worse(worst, self.greatest(steps, np.where(again, -np.inf, bound)))
            if not again.any() or not np.isfinite(bound).all():
                break
            steps = steps.halves(again)
        return worst

    def greatest(self, steps, bound):
        """The greatest of some bounds and its moment."""
        k = np.argmax(bound)
        return bound[k], self.motion.t[steps.piece[k]] + steps.start[k]

    def over(self, kinds, longest, evaluate, limit):
        """The greatest value over all segments of some kinds; `evaluate` also gets the segment."""
        worst = (-np.inf, 0.0)
        for segment in self.plan.segments:
            if segment["kind"] in kinds:
                worst = worse(worst, self.most(self.steps(segment, longest), lambda s, e: evaluate(segment, e), limit))
        return worst

    def in_plate(self, segment, instant):
        """Tip and axis of the tool in the frame of the segment's plate."""
        r, p = self.frames[segment["plate"]]
        return (instant.tip - p) @ r, instant.axis @ r

    def answers(self):
        yield from self.speeds()
        if self.plan.is_home:
            yield from self.leaves_plate()
        else:
            yield from self.beside_plates()

    def speeds(self):
        """15 to 18: speed and acceleration of the tip."""
        need, limits = self.plan.requirements, self.plan.limits
        free = ("depart", "approach", "retreat", "transit", "return")
        orders = (("speed", "speed_m_s", "m/s", 3), ("acceleration", "acceleration_m_s2", "m/s^2", 4))
        for of, kinds, longest, (quantity, key, unit, order) in (
            (*where, which) for where in (("tip", free, 4e-3), ("wash", ("wash",), 2e-3)) for which in orders
        ):
            if of == "wash" and self.plan.is_home:
                continue
            limit = min(limits[f"tip_{key}"], need[f"wash_{key}"] if of == "wash" else np.inf)

            def evaluate(_, ends):
                # What rounding of the joints' speeds and accelerations moves at the tip's levers.
                slack = (ends.levers * ends.rounding[order - 2]).sum(axis=1)
                return [norm(getattr(instant, quantity)) + slack for instant in ends.at], ends.tip[order]

            bound, when = self.over(kinds, longest, evaluate, limit)
            yield judged(f"{of}_{quantity}", bound, limit, unit, f"at {when:.4f} s")

    def beside_plates(self):
        plan, tool = self.plan, self.plan.tool
        need, contact = plan.requirements, plan.requirements.get("contact")
        delta = contact["height_error_m"] if contact else 0.0
        near = ("approach", "wash", "retreat")
        curves = {plate: Curve(path["curve"]) for plate, path in plan.paths.items()}

        # 19: the sine of the angle between the axis and the normal; the axis points into the face.
        limit = min([need["tilt_rad"], np.arctan2(tool.height, tool.radius)] + [p["cone_rad"] for p in plan.paths.values()])

        def sine(segment, ends):
            axes = [self.in_plate(segment, instant)[1] for instant in ends.at]
            across = [np.where(axis[:, 2] < 0, norm(axis[:, :2]), np.inf) for axis in axes]
            return across, ends.axis[2]

        bound, when = self.over(near, 4e-3, sine, np.sin(limit))
        tilt = np.arcsin(bound) if bound <= 1 else np.inf
        yield judged("tilt", tilt, limit, "rad", f"at {when:.4f} s")
        cos, tan = np.cos(tilt), np.tan(tilt)

        # 20: the height of the tip over the face in the wash.
        height = lambda segment, ends: ([abs(self.in_plate(segment, i)[0][:, 2]) for i in ends.at], ends.tip[2])
        off, when = self.over(("wash",), 4e-3, height, PATH_M)
        yield judged("contact_height", off, PATH_M, "m", f"at {when:.4f} s")

        # 25: the sponge's reach beyond the rim is that of the path, its tolerance, and the tilted sponge.
        reach, at = -np.inf, 0
        for plate, curve in curves.items():
            far = lambda s, e: ([norm(self.in_plate(s, i)[0][:, :2]) for i in e.at], e.tip[2])
            most = curve.radius + PATH_M
            for segment in plan.segments:
                if segment["kind"] in near and segment["plate"] == plate:
                    found, when = self.most(self.steps(segment, 4e-3), lambda s, e: far(segment, e), most)
                    reach, at = worse((reach, at), (found - most, when))
        yield judged("reach", reach, 0.0, "m", f"beyond what the paths imply, at {at:.4f} s")

        yield self.path_deviation(curves)

        # 23: approach and retreat stay near the normals over the ends of the path.
        def beside(segment, ends):
            curve = curves[segment["plate"]]
            foot = curve.at(np.array([0.0 if segment["kind"] == "approach" else curve.end]))[0]
            return [norm(self.in_plate(segment, i)[0][:, :2] - foot) for i in ends.at], ends.tip[2]

        bound, when = self.over(("approach", "retreat"), 4e-3, beside, LINE_M)
        yield judged("line_deviation", bound, LINE_M, "m", f"at {when:.4f} s")

        yield self.contact_speed(tilt, delta)

        # 32: joint 5 stays on one side of 0.
        if need.get("wrist_rad") is not None:
            low, high, _, _ = self.motion.extremes()
            spans = [plan.span(s) for s in plan.segments if s["kind"] in near]
            fifth = [(low[i:j, 4].min(), -high[i:j, 4].max()) for i, j in spans]
            # A visit is continuous: where it is away from 0 in each part, it stays on one side.
            away = min(max(pair) for pair in fifth)
            yield judged("wrist", away, need["wrist_rad"], "rad", at_least=True)

        if contact:
            # 30, 31: the compression is linear across the sponge, m +- k at its rim.
            low_z = lambda s, e: ([-self.in_plate(s, i)[0][:, 2] for i in e.at], e.tip[2])
            below, _ = self.over(near, 4e-3, low_z, PATH_M)
            k, free = tool.radius * tan, tool.height + tool.compression
            m = tool.compression + (delta + max(below, 0.0)) / cos
            yield judged("strain", (m + k) / free, contact["strain"], "")
            area = np.pi * tool.radius**2
            volume = area * m if m >= k else 0.5 * area * (m + k)
            soft, hard = tool.stiffness
            least = tool.compression - (delta + off) / cos
            lost = 0.0
            for plate, curve in curves.items():
                radius = tool.radius / cos + (delta + off) * tan
                lost = max(lost, outside(radius, curve.radius + PATH_M, plan.plates[plate].radius) * (m + k))
            force = soft / free * (area * max(least, 0.0) - lost), hard / free * volume
            low, high = contact["force_n"]
            worst = judged("contact_force", force[1], high, "N", f"and at least {force[0]:.4g} N of {low:g} N")
            yield worst if force[0] >= low else judged("contact_force", force[0], low, "N", at_least=True)
            if need.get("holder"):
                # The axis meets the face up to that far from below the tip.
                aside = (delta + tool.compression + max(below, off, 0.0)) * tan
                yield self.stays(need["holder"], m, k, tilt, hard / free, curves, aside)

    def leaves_plate(self):
        """20, 21, 23 on the way home after a stop: the sponge, which is at the face, leaves it slowly along the normal."""
        if not self.plan.retreat:
            return
        tool, segment = self.plan.tool, self.plan.segments[0]
        steps = self.steps(segment, 4e-3)
        across = lambda s, e: ([norm(self.in_plate(segment, i)[1][:, :2]) for i in e.at], e.axis[2])
        sine, _ = self.most(steps, across, np.sin(np.pi / 4))
        tilt = np.arcsin(sine) if sine <= 1 else np.inf
        place, axis = (values[0] for values in self.in_plate(segment, self.ends(steps.part(slice(1))).at[0]))
        over = place[2] - 1e-3 + tool.height * np.cos(tilt) - tool.radius * np.sin(tilt)
        at_face = axis[2] < 0 and tilt <= np.pi / 4 and over >= 0
        yield stated("contact_height", [] if at_face else ["the retreat does not begin at the face"])
        yield self.contact_speed(tilt, 0.0)
        beside = lambda s, e: ([norm(self.in_plate(segment, i)[0][:, :2] - place[:2]) for i in e.at], e.tip[2])
        bound, when = self.most(steps, beside, LINE_M)
        yield judged("line_deviation", bound, LINE_M, "m", f"at {when:.4f} s")

    def stays(self, holder, m, k, tilt, stiffness, curves, aside):
        """33: a fixture takes the greatest force across the plate's axis and the greatest torque about it."""
        if "fixture" not in holder:
            return not_checked("plate_stays", "plates on a ring are not checked by this version")
        plan, friction, s = self.plan, holder["sponge_friction"], self.plan.tool.radius
        # The volume pressed in, of a sponge pressed all over, or partly; the torque by Cauchy and Schwarz, or by the farthest point.
        slant, away = s / np.cos(tilt), max(curve.radius for curve in curves.values()) + PATH_M + aside
        volume, partly = np.pi * s**2 * max(m, 0.0), np.pi * s**2 * k
        lever = volume * away**2 + 0.5 * np.pi * s**2 * k * slant * away + 0.5 * volume * slant**2
        torque = friction * stiffness * max(np.sqrt(volume * lever), partly * (away + slant))
        force = friction * stiffness * max(volume, partly) / np.cos(tilt)
        inclined = max(np.sqrt(max(1 - plate.normal[2] ** 2, 0.0)) for plate in plan.plates)
        force += 9.81 * holder.get("plate_mass_kg", 0.0) * inclined
        fixture = holder["fixture"]
        words = f"of the fixture: {force:.4g} N across the axis, {torque:.4g} N m about it"
        return judged("plate_stays", max(force / fixture["force_n"], torque / fixture["torque_nm"]), 1.0, "", words)

    def path_deviation(self, curves):
        """22: the tip follows the whole path in order. An angle theta(t) that never falls is chosen at each moment; the tip is compared with
        the curve there."""
        worst, faults = (-np.inf, 0.0), []
        for segment in self.plan.segments:
            if segment["kind"] != "wash":
                continue
            curve = curves[segment["plate"]]
            steps = self.steps(segment, 1e-3)
            ends = self.ends(steps)
            tip = [self.in_plate(segment, i)[0] for i in ends.at]
            places = np.vstack([tip[0], tip[1][-1:]])
            theta = nearest(curve, places[:, :2])
            on_curve = np.concatenate([curve.at(theta), np.zeros((len(theta), 1))], axis=1)
            off = norm(places - on_curve)
            step = np.diff(theta)
            bound = np.maximum(off[:-1], off[1:]) + ends.h**2 / 8 * ends.tip[2] + step**2 / 8 * curve.bend() + ROUND
            worst = worse(worst, self.greatest(steps, bound))
            if theta[0] != 0 or theta[-1] != curve.end or (step < 0).any():
                faults.append(f"the path of plate {segment['plate'] + 1} is not followed from end to end")
        if faults:
            return stated("path_deviation", faults)
        return judged("path_deviation", worst[0], PATH_M, "m", f"at {worst[1]:.4f} s")

    def contact_speed(self, tilt, delta):
        """21: no touching point of the sponge is faster than the limit while it comes down and leaves."""
        tool, need = self.plan.tool, self.plan.requirements
        ratio, when, worst = -np.inf, 0.0, (-np.inf, 0.0)
        for segment in self.plan.segments:
            if segment["kind"] not in ("approach", "retreat"):
                continue
            stated_limit = need.get("landing_m_s" if segment["kind"] == "approach" else "lifting_m_s")
            is_free = need.get("landing_m_s") is not None or need.get("lifting_m_s") is not None
            limit = stated_limit if stated_limit is not None else need["wash_speed_m_s"]
            b = tool.compression if is_free else 0.0
            raised = delta if is_free else 0.0
            # Without a bound on the tilt every touching point may be anywhere: nothing is confirmed.
            arm_m = np.hypot(tool.radius, max(b, tool.radius * np.tan(tilt) + 1e-3)) if tilt < 1.5 else np.inf

            def evaluate(steps, ends):
                values, heights = [], []
                for instant in ends.at:
                    place, axis = self.in_plate(segment, instant)
                    heights.append(place[:, 2] + b * axis[:, 2] - tool.radius * norm(axis[:, :2]) - raised)
                    across = norm(np.cross(instant.speed, instant.omega))
                    values.append(
                        np.sqrt(norm(instant.speed) ** 2 + 2 * arm_m * across + (arm_m * norm(instant.omega)) ** 2)
                    )
                lowest = np.minimum(*heights) - ends.h**2 / 8 * (ends.tip[2] + (b + tool.radius) * ends.axis[2]) - ROUND
                second = ends.tip[3] + arm_m * ends.axis[3]
                touches = lowest <= 0
                # Shorter steps help, unless an end touches and is too fast.
                hopeless = np.any([(height <= 0) & (value > limit) for height, value in zip(heights, values)], axis=0)
                return [np.where(touches, value, 0.0) for value in values], np.where(touches, second, 0.0), hopeless

            bound, at = self.most(self.steps(segment, 4e-3), evaluate, limit)
            if worse((ratio, 0), (bound / limit, 1))[1]:
                ratio, when, worst = bound / limit, at, (bound, limit)
        return judged("contact_speed", *worst, "m/s", f"at {when:.4f} s")


def nearest(curve, places):
    """Angles at which the curve is near points, ascending from 0 to its end. The choice decides how tight the bound is, not its validity."""
    grid = np.linspace(0, curve.end, 40_000)
    points = curve.at(grid)
    theta, k, window = np.empty(len(places)), 0, 400
    for n, place in enumerate(places):
        part = points[k : k + window] - place
        k += int(np.argmin((part**2).sum(axis=1)))
        theta[n] = grid[k]
    # Between two points of the grid, the foot on their chord.
    i = np.clip(np.searchsorted(grid, theta), 1, len(grid) - 2)
    chord = points[i + 1] - points[i - 1]
    share = ((places - points[i - 1]) * chord).sum(axis=1) / np.maximum((chord**2).sum(axis=1), 1e-30)
    theta = grid[i - 1] + np.clip(share, 0, 1) * (grid[i + 1] - grid[i - 1])
    theta[0], theta[-1] = 0.0, curve.end
    return np.minimum(np.maximum.accumulate(theta), curve.end)


def outside(radius, away, rim):
    """Area of a disc, whose centre is `away` from that of a rim, beyond the rim."""
    if away + radius <= rim:
        return 0.0
    if away >= rim + radius:
        return np.pi * radius**2
    if radius - away >= rim:
        return np.pi * (radius**2 - rim**2)
    a = np.arccos((away**2 + radius**2 - rim**2) / (2 * away * radius))
    b = np.arccos((away**2 + rim**2 - radius**2) / (2 * away * rim))
    lens = radius**2 * (a - np.sin(2 * a) / 2) + rim**2 * (b - np.sin(2 * b) / 2)
    return np.pi * radius**2 - lens
