"""Clearance: every pair of bodies of which one moves keeps its distance at every moment.

For any unit direction n, the gap g = min n.b - max n.a over the points of two bodies is at most their distance. With n fixed to the first
body, n.b(t) of every point leaves its chord by h^2/8 sup |b''| at most, and so does g: the lesser end, less that, bounds the distance over the
whole step. The direction comes from the middle of the step (Gilbert's algorithm); any would do.
"""

import numpy as np

from .motion import COMB, Steps, bell
from .plan import compose, inverse
from .schema import check, expect
from .schema import shape as of_shape

# Allowance for rounding of a distance [m]: see the README.
ROUND = 1e-10
# Steps at the beginning [s], how often they are halved, after how many halvings they are short, and rounds of the search for a direction.
LONGEST, HALVINGS, SHORT, ROUNDS = 16e-3, 8, 3, 40
# Configurations in which pairs of links are tried where there is no SRDF.
CONFIGURATIONS = 64
# Tolerances within which a body is round about joint 6 and a plane is level.
ROUND_M, LEVEL = 1e-4, 1e-9


class Part:
    """A convex body: the farthest point along a direction, of a core that is grown by a radius."""

    def __init__(self, placed, shape):
        self.r, self.p = placed
        check(of_shape, shape, "a shape")
        (self.kind, sizes), = shape.items()
        self.pad = 0.0
        if self.kind == "box":
            self.sizes = np.array(sizes["half_m"], dtype=float)
            self.extent = float(np.linalg.norm(self.sizes))
        elif self.kind == "cylinder":
            self.sizes = np.array([sizes["radius_m"], sizes["half_length_m"]], dtype=float)
            self.extent = float(np.hypot(*self.sizes))
        elif self.kind == "hull":
            self.points = np.array(sizes["points"], dtype=float)
            self.extent = float(np.linalg.norm(self.points, axis=1).max())
        else:
            self.pad, half = float(sizes["radius_m"]), float(sizes.get("half_length_m", 0.0))
            self.points = np.array([[0, 0, -half], [0, 0, half]]) if half else np.zeros((1, 3))
            self.extent = self.pad + half

    def support(self, d):
        """Points of the core that are farthest along directions, in the frame of the part."""
        if self.kind == "box":
            return np.where(d >= 0, self.sizes, -self.sizes)
        if self.kind == "cylinder":
            radius, half = self.sizes
            across = d[:, :2] / np.maximum(np.linalg.norm(d[:, :2], axis=1), 1e-300)[:, None] * radius
            return np.concatenate([across, np.where(d[:, 2:] >= 0, half, -half)], axis=1)
        return self.points[np.argmax(d @ self.points.T, axis=1)]


class Mover:
    """A body: its name, the joint frame that carries it (0: it stands), and its parts or a half-space in that frame."""

    def __init__(self, name, carrier, parts, margin=0.0, plane=None):
        self.name, self.carrier, self.parts, self.margin, self.plane = name, carrier, parts, margin, plane


def bodies(arm, plan):
    """All bodies of a plan, in the frame of the base."""
    all_bodies, to_base = [], inverse(plan.mount)
    for name, shapes in arm.shapes.items():
        all_bodies.append(Mover(name, arm.links[name][0], [Part(*shape) for shape in shapes]))
    tool = plan.tool
    for body in tool.bodies:
        placed = compose(arm.mounting, body.pose)
        all_bodies.append(Mover(body.name, 6, [Part(placed, body.shape)], body.margin))
    # Where it touches nothing, the sponge is as high as it is free.
    high = tool.height + tool.compression
    lower = (np.eye(3), np.array([0, 0, 0.5 * tool.compression]))
    placed = compose(compose(arm.mounting, tool.sponge_pose), lower)
    sponge = {"cylinder": {"radius_m": tool.radius, "half_length_m": 0.5 * high}}
    all_bodies.append(Mover("sponge", 6, [Part(placed, sponge)]))
    for k, plate in enumerate(plan.plates):
        under = (np.eye(3), np.array([0, 0, -0.5 * plate.thickness]))
        disc = {"cylinder": {"radius_m": plate.radius, "half_length_m": 0.5 * plate.thickness}}
        all_bodies.append(Mover(f"plate {k + 1}", 0, [Part(compose(compose(to_base, plate.pose), under), disc)]))
    for body in plan.obstacles:
        placed = compose(to_base, body.pose)
        if body.shape == "half_space":
            all_bodies.append(Mover(body.name, 0, [], body.margin, (placed[0][:, 2], placed[0][:, 2] @ placed[1])))
        elif "convex" in body.shape:
            all_bodies.append(Mover(body.name, 0, [Part(placed, body.shape["convex"])], body.margin))
        else:
            hulls = [{"hull": {"points": points}} for points in body.shape["parts"]]
            all_bodies.append(Mover(body.name, 0, [Part(placed, hull) for hull in hulls], body.margin))
    return all_bodies


class Frames:
    """Rotations and positions of the joint frames at both ends and in the middle of steps, and bounds on the joints' derivatives."""

    def __init__(self, arm, motion, steps):
        self.h = h = steps.end - steps.start
        times = (steps.start, 0.5 * (steps.start + steps.end), steps.end)
        states = [motion.at(steps.piece, u) for u in times]
        self.at = [arm.frames(state[0]) for state in states]
        q3 = abs(states[0][3]) + motion.rounding[3][steps.piece]
        q2 = np.maximum(abs(states[0][2]), abs(states[2][2])) + motion.rounding[2][steps.piece]
        q1 = np.maximum(abs(states[0][1]), abs(states[2][1])) + h[:, None] ** 2 / 8 * q3 + motion.rounding[1][steps.piece]
        self.bell, self.arm = bell(q1, q2, q3), arm

    def acceleration(self, first, last, extent):
        """Bound on the acceleration of the points of a body carried by joint `last`, seen from what joint `first` carries."""
        g1 = g2 = np.zeros(len(self.h))
        for i in reversed(range(first, last)):
            b1, b2 = self.bell[0][:, i], self.bell[1][:, i]
            g2 = COMB[2][0] * b2 * extent + COMB[2][1] * b1 * g1 + g2
            g1 = b1 * extent + g1
            extent += np.linalg.norm(self.arm.joints[i].frame[1])
        return g2


def lowest(part, frames, k, normal):
    """Least n.x over the points of a part at the moment k, for directions (N, 3) in the frame of the base."""
    r, p = (side[part.carrier] for side in frames.at[k])
    in_part = np.einsum("nji,nj->ni", r @ part.r, normal)
    core = part.support(-in_part)
    return (core * in_part).sum(axis=1) + (normal * (p + r @ part.p)).sum(axis=1) - part.pad


def gap(a, b, frames, k, normal):
    """The gap of two parts along directions: least n.b less greatest n.a."""
    return lowest(b, frames, k, normal) + lowest(a, frames, k, -normal)


def direction(a, b, frames):
    """Directions from a to b in the middle of steps, near those of their nearest points."""
    r, p = frames.at[1]
    place = lambda part: (r[part.carrier] @ part.r, p[part.carrier] + r[part.carrier] @ part.p)
    (ra, pa), (rb, pb) = place(a), place(b)

    def farthest(d):
        # The point of b - a that is farthest along -d.
        of_a = pa + np.einsum("nij,nj->ni", ra, a.support(np.einsum("nji,nj->ni", ra, d)))
        of_b = pb + np.einsum("nij,nj->ni", rb, b.support(np.einsum("nji,nj->ni", rb, -d)))
        return of_b - of_a

    v = pb - pa + 1e-9
    best, found = np.zeros_like(v), np.full(len(v), -np.inf)

    def try_out(n):
        w = farthest(n)
        reached = (w * n).sum(axis=1)
        better = reached > found
        best[better], found[better] = n[better], reached[better]
        return w

    # Between flat faces the search is slow, and the normal of one of them is best.
    for part, turned in ((a, ra), (b, rb)):
        for axis in {"box": (0, 1, 2), "cylinder": (2,)}.get(part.kind, ()):
            for sign in (1, -1):
                try_out(sign * turned[:, :, axis])
    for _ in range(ROUNDS):
        w = try_out(v / np.maximum(np.linalg.norm(v, axis=1), 1e-300)[:, None])
        toward = w - v
        share = -(v * toward).sum(axis=1) / np.maximum((toward**2).sum(axis=1), 1e-300)
        v = v + np.clip(share, 0, 1)[:, None] * toward
    return best / np.maximum(np.linalg.norm(best, axis=1), 1e-300)[:, None]


def bound_over(arm, motion, a, b, spans, required):
    """Lower bound on the distance of two parts over spans of pieces, and the moment of the least. Steps are halved where it is less than
    required."""
    extent = float(np.linalg.norm(b.p)) + b.extent
    least, when = np.inf, 0.0
    for first, last in spans:
        steps = Steps.cover(motion, first, last, LONGEST)
        for round in range(HALVINGS + 1):
            frames = Frames(arm, motion, steps)
            slack = frames.h**2 / 8 * frames.acceleration(a.carrier if a is not None else 0, b.carrier, extent) + ROUND
            bound = first_bound(a, b, frames, slack, required)
            again = ~(bound >= required) & (round < HALVINGS)
            # Where the gap itself is too small in a short step, shorter ones do not help.
            again &= (bound + slack >= required) | (round < SHORT)
            if (~again).any():
                k = np.flatnonzero(~again)[np.argmin(bound[~again])]
                if bound[k] < least or bound[k] != bound[k]:
                    least, when = bound[k], motion.t[steps.piece[k]] + steps.start[k]
            if not again.any():
                break
            steps = steps.halves(again)
    return least, when


def first_bound(a, b, frames, slack, required):
    if isinstance(a, Plane):
        normal = np.broadcast_to(a.normal, (len(slack), 3))
        return np.minimum(*(lowest(b, frames, k, normal) for k in (0, 2))) - a.height - slack
    # Balls about both parts are enough where they are far apart.
    r, p = frames.at[1]
    place = lambda part: p[part.carrier] + r[part.carrier] @ part.p
    toward = place(b) - place(a)
    bound = along(a, b, frames, toward, slack)
    near = ~(bound >= required)
    if near.any():
        part = Selection(frames, near)
        bound[near] = np.maximum(bound[near], along(a, b, part, direction(a, b, part), slack[near]))
    return bound


def along(a, b, frames, n, slack):
    """Bound over steps by the gaps at both ends along directions that are fixed to the first part."""
    n = n / np.maximum(np.linalg.norm(n, axis=1), 1e-300)[:, None]
    local = np.einsum("nji,nj->ni", frames.at[1][0][a.carrier], n)
    turned = lambda k: np.einsum("nij,nj->ni", frames.at[k][0][a.carrier], local)
    return np.minimum(*(gap(a, b, frames, k, turned(k)) for k in (0, 2))) - slack


class Selection:
    """Some of the steps of frames."""

    def __init__(self, frames, which):
        self.h = frames.h[which]
        self.at = [(r[:, which], p[:, which]) for r, p in frames.at]


class Still:
    """Frames of an arm that stands, in some configurations."""

    def __init__(self, arm, q):
        self.at = [arm.frames(q)] * 3


class Plane:
    """The half-space behind a plane; it stands."""

    carrier = 0

    def __init__(self, normal, height):
        self.normal, self.height = normal, height


def is_round(arm, body):
    """True for a body of which each part is round about joint 6."""
    axis = arm.joints[5].axis
    for part in body.parts:
        off = part.p - axis * (axis @ part.p)
        if part.kind not in ("cylinder", "capsule", "sphere") or np.linalg.norm(off) > ROUND_M:
            return False
        if part.kind != "sphere" and np.linalg.norm(np.cross(part.r[:, 2], axis)) > ROUND_M:
            return False
    return True


class Clearance:
    """The answers on clearance, and on the pairs that are left out."""

    def __init__(self, arm, plan, motion):
        self.arm, self.plan, self.motion = arm, plan, motion
        self.bodies = bodies(arm, plan)
        names = [body.name for body in self.bodies]
        for name in names:
            expect(names.count(name) == 1, "the names of bodies", "each name once", name)
        self.plate_of = {f"plate {k + 1}": k for k in range(len(plan.plates))}
        for body in self.bodies:
            for part in body.parts:
                part.carrier = body.carrier
        self.links = set(arm.shapes)
        self.tool = {body.name for body in plan.tool.bodies} | {"sponge"}
        self.touching = self.always_touching() if arm.srdf_sha256 is None else set()

    def reason(self, a, b):
        """The reason for which a pair is left out, recomputed; None for one that is judged."""
        names, first = {a.name, b.name}, self.arm.joints[0]
        if a.carrier == b.carrier == 0:
            return "neither_moves"
        if names <= self.links and frozenset(names) in self.arm.disabled:
            return "srdf" if self.arm.srdf_sha256 else "neighbours"
        if frozenset(names) in self.touching:
            return "always_touching"
        for carried, link in ((a, b), (b, a)):
            if carried.name in self.tool and link.name in self.links:
                if link.carrier == 6 or (link.carrier == 5 and is_round(self.arm, carried)):
                    return "carries_tool"
        for plane, link in ((a, b), (b, a)):
            if plane.plane is not None and link.carrier == 1 and link.name in self.links:
                if np.linalg.norm(np.cross(plane.plane[0], first.frame[0] @ first.axis)) <= LEVEL:
                    return "keeps_its_height"
        return None

    def always_touching(self):
        """Pairs of links that no direction separates in any of 64 configurations drawn evenly between the joints' limits."""
        arm = self.arm
        low, high = np.maximum(arm.lower, -np.pi), np.minimum(arm.upper, np.pi)
        q = np.random.default_rng(0).uniform(low, high, (CONFIGURATIONS, 6))
        frames = Still(arm, q)
        links = [body for body in self.bodies if body.name in self.links]
        found = set()
        for k, a in enumerate(links):
            for b in links[k + 1 :]:
                gaps = [gap(x, y, frames, 1, direction(x, y, frames)) for x in a.parts for y in b.parts]
                if a.carrier != b.carrier and (np.min(gaps, axis=0) <= 0).all():
                    found.add(frozenset((a.name, b.name)))
        return found

    def pairs(self):
        for k, a in enumerate(self.bodies):
            for b in self.bodies[k + 1 :]:
                if a.carrier == b.carrier and a.carrier > 0:
                    if {a.name, b.name} <= self.tool or {a.name, b.name} <= self.links:
                        continue
                yield (a, b) if a.carrier <= b.carrier else (b, a)

    def exclusions(self):
        """Pairs that the plan leaves out for another reason than this program finds, or none."""
        found = {}
        for a, b in self.pairs():
            reason = self.reason(a, b)
            # Plates are no bodies of the cell, and obstacles alone no pairs of the arm.
            names = {a.name, b.name}
            if reason and names & (self.links | self.tool) and not names & set(self.plate_of):
                found[frozenset((a.name, b.name))] = reason
        stated = {frozenset(e["pair"]): e["reason"] for e in self.plan.cell["exclusions"]}
        words = lambda p: " and ".join(sorted(p))
        faults = [f"{words(p)} are left out" for p in stated if stated[p] != found.get(p)]
        return faults + [f"{words(p)} are not named among the pairs that are left out" for p in found if p not in stated]

    def free_spans(self, plate):
        """Spans of pieces in which the sponge keeps clear of a plate: all but those in which it may touch it."""
        touched = lambda s: s["kind"] in ("approach", "wash", "retreat") and self.may_touch(s["plate"], plate)
        return [tuple(self.plan.span(s)) for s in self.plan.segments if not touched(s)]

    def may_touch(self, washed, other):
        """True for the plate that is washed, and for a parallel neighbour that is no higher and whose rim is near the wash path."""
        plan = self.plan
        if washed == other or plan.is_home:
            return washed == other
        a, b = plan.plates[washed], plan.plates[other]
        away = b.pose[1] - a.pose[1]
        height = away @ a.normal
        if np.linalg.norm(np.cross(a.normal, b.normal)) > LEVEL or a.normal @ b.normal < 0 or height > LEVEL:
            return False
        tool = plan.tool
        radius = plan.paths[washed]["curve"]["radius_m"]
        near = radius + 1e-3 + np.hypot(tool.radius, tool.height) + plan.requirements["clearance_m"]
        return np.linalg.norm(away - height * a.normal) - b.radius <= near

    def run(self, progress=lambda share: None):
        """Least bound over all pairs that are judged, beyond what is required, with the pair and the moment."""
        required, plan = self.plan.requirements["clearance_m"], self.plan
        whole = [(0, len(self.motion.h))]
        judged_pairs = [pair for pair in self.pairs() if self.reason(*pair) is None]
        least = (np.inf, None, 0.0)
        for n, (a, b) in enumerate(judged_pairs):
            progress(n / len(judged_pairs))
            plate = next((self.plate_of[x.name] for x in (a, b) if x.name in self.plate_of), None)
            spans = whole
            if plate is not None and "sponge" in (a.name, b.name):
                spans = self.free_spans(plate)
            margin = a.margin + b.margin
            sides = [Plane(*a.plane)] if a.plane is not None else a.parts
            for x in sides:
                for y in b.parts:
                    bound, when = bound_over(self.arm, self.motion, x, y, spans, required + margin)
                    if not bound > -np.inf:
                        # What is no number is no bound, whatever else is found.
                        return (-np.inf, (a.name, b.name), when)
                    if bound - margin < least[0]:
                        least = (bound - margin, (a.name, b.name), when)
        return least

    def still(self):
        """Pairs whose distance no joint changes: link 1 over a level plane keeps the clearance; the ground under the arm is only not to be
        reached into."""
        faults = []
        mount_r, mount_p = self.arm.mounting
        out = mount_r[:, 2]
        for body in self.bodies:
            # A round tool stands against the flange; beside the link before it only what reaches behind the flange could come too near.
            if body.name in self.tool and is_round(self.arm, body):
                along = lambda part: part.support((part.r.T @ -out)[None])[0] @ (part.r.T @ out) + out @ part.p - part.pad
                if min(along(part) for part in body.parts) < out @ mount_p - ROUND_M:
                    faults.append(f"{body.name} reaches behind the flange, beside the link that carries it: not checked by this version")
        for a, b in self.pairs():
            if self.reason(a, b) != "keeps_its_height":
                continue
            plane, link = (a, b) if a.plane is not None else (b, a)
            low = self.at_rest(plane, link)
            (_, _, up), height = plane.plane
            need = 0.0 if abs(height) <= 1e-9 and up >= 1 - 1e-9 else self.plan.requirements["clearance_m"] + plane.margin
            if not low >= need:
                faults.append(f"{link.name} keeps {1e3 * low:.2f} mm from {plane.name}, {1e3 * need:.2f} mm needed")
        return faults

    def at_rest(self, a, b):
        """Lower bound on the distance of two bodies with all joints at 0; below 0 where they overlap, or are not shown to be apart."""
        frames, least = Still(self.arm, np.zeros((1, 6))), np.inf
        for x, y in ((a, b), (b, a)):
            if x.plane is not None:
                normal, height = x.plane
                return min(lowest(part, frames, 1, normal[None])[0] for part in y.parts) - height
        for x in a.parts:
            for y in b.parts:
                least = min(least, gap(x, y, frames, 1, direction(x, y, frames))[0])
        return least
