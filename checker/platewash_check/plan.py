"""The plan file, and the poses, plates and tool in it."""

import hashlib
import json
import re

import numpy as np
from scipy.spatial.transform import Rotation

from .schema import PLAN, check, expect


def pose(table):
    """A pose as rotation matrix and position."""
    w, x, y, z = table["quaternion_wxyz"]
    return Rotation.from_quat([x, y, z, w]).as_matrix(), np.array(table["position_m"], dtype=float)


def inverse(a):
    r, p = a
    return r.T, -r.T @ p


def compose(a, b):
    return a[0] @ b[0], a[0] @ b[1] + a[1]


def parsed(text):
    """The tables of a JSON text; a key that stands twice and what is no number are refused."""

    def no_repeats(pairs):
        keys = [key for key, _ in pairs]
        for key in keys:
            expect(keys.count(key) == 1, "JSON", f"the key {key!r} once", "it stands twice")
        return dict(pairs)

    refuse = lambda constant: expect(False, "JSON", "a number", constant)
    try:
        return json.loads(text, object_pairs_hook=no_repeats, parse_constant=refuse)
    except (json.JSONDecodeError, RecursionError) as error:
        expect(False, "the plan", "JSON", f"not JSON: {error}")


class Plan:
    """A plan file. Times in seconds, lengths in metres, angles in radians."""

    def __init__(self, text):
        root = parsed(text)
        check(PLAN, root, "the plan")
        self.hash = root["hash"]
        # The file is canonical, so that its hash is that of the text without the member itself.
        rest = re.sub(r'"hash":"[0-9a-f]*",', "", text, count=1)
        self.hash_found = hashlib.sha256(rest.encode()).hexdigest()
        job = root["job"]
        self.limits, self.requirements, self.cell = job["limits"], job["requirements"], job["workcell"]
        self.t, self.q, self.qd = (np.array(root["knots"][key], dtype=float) for key in ("t_s", "q_rad", "qd_rad_s"))
        many = len(self.t) == len(self.q) == len(self.qd) >= 2
        expect(many, "knots", "as many times, positions and speeds, and two at least", len(self.t))
        expect(self.t[0] == 0 and (np.diff(self.t) > 1e-9).all(), "knots.t_s", "times that begin at 0 and ascend", "others")
        self.dry_run, recovery = job.get("dry_run"), job.get("recovery")
        self.left_out = recovery["left_out"] if recovery else []
        self.is_home = recovery is not None and recovery["part"] != "rest"
        self.retreat = recovery["part"]["home"]["retreat"] if self.is_home else None
        asked, count = self.requirements, len(job["plates"])
        if self.dry_run:
            # Nothing is pressed in the air.
            self.requirements = {key: value for key, value in asked.items() if key not in ("contact", "holder")}
        if recovery:
            expect(not self.dry_run, "the job", "a dry run or a recovery", "both")
            ascending = all(a < b for a, b in zip(self.left_out, self.left_out[1:]))
            inside = not self.left_out or self.left_out[-1] < count
            how_many = len(self.left_out) == count if self.is_home else 0 < len(self.left_out) < count
            expect(ascending and inside and how_many, "recovery.left_out", "plates in order: some, or all on the way home", self.left_out)
        if self.is_home:
            none = [key for key in ("contact", "holder", "landing_m_s", "wrist_rad") if key in asked]
            expect(not none and "lifting_m_s" in asked, "requirements", "of a way home: lifting_m_s, and none of a washing", sorted(asked))
            expect(not root["order"] and not root["wash_paths"], "the plan", "no order and no wash paths on the way home", root["order"])
        self.home = np.array(job["home_rad"], dtype=float)
        self.arm, self.mount = self.cell["arm"], pose(self.cell["mount"])
        self.plates = [Plate(plate) for plate in job["plates"]]
        self.tool = Tool(self.cell["tool"])
        self.obstacles = [Body(body) for body in self.cell["obstacles"]]
        self.order, self.segments = root["order"], root["segments"]
        self.path_order = [path["plate"] for path in root["wash_paths"]]
        self.paths = dict(zip(self.path_order, root["wash_paths"]))
        named = self.order + self.path_order + [segment["plate"] for segment in self.segments]
        expect(max(named, default=0) < len(self.plates), "the plan", "no plate that the job does not have", max(named, default=0))
        expect(len(self.paths) == len(self.path_order), "wash_paths", "each plate once", self.path_order)
        before = 0.0
        for k, s in enumerate(self.segments):
            in_order = s["t_start_s"] == before < s["t_end_s"] and np.isin([before, s["t_end_s"]], self.t).all()
            expect(in_order, f"segments[{k}]", "to begin where the one before ends, and to end at a later knot", s)
            before = s["t_end_s"]
        for k, path in enumerate(root["wash_paths"]):
            curve, rings = path["curve"], path["curve"].get("rings")
            length = np.pi * curve["radius_m"] * (curve["turns"] + 2)
            if rings:
                expect(rings["inner_m"] <= curve["radius_m"], f"wash_paths[{k}]", "an inner ring within the outer one", rings)
                length = 2 * np.pi * curve["radius_m"] * (rings.get("laps", 1) * rings["count"] + 1)
            expect(length <= 200, f"wash_paths[{k}]", "a curve of at most 200 m", length)

    def span(self, segment):
        """First and last knot of a segment."""
        return np.searchsorted(self.t, [segment["t_start_s"], segment["t_end_s"]])


class Body:
    """A convex body, several, or a half-space that stands still or is carried; the shape in its own frame."""

    def __init__(self, table):
        self.name, self.pose, self.shape = table["name"], pose(table["pose"]), table["shape"]
        self.margin, self.holds = float(table.get("margin_m", 0.0)), table.get("holds_plates")


class Plate:
    """A flat plate: a disc whose face is at z = 0 of its frame, its foot below."""

    def __init__(self, table):
        self.pose, self.radius, self.thickness = pose(table["pose"]), table["surface"]["radius_m"], table["thickness_m"]
        self.normal = self.pose[0][:, 2]


class Tool:
    """The tool, in the mounting frame."""

    def __init__(self, table):
        expect(table["bodies"], "tool.bodies", "a tool of its own: one that the arm itself holds is not checked", [])
        self.bodies, self.tip = [Body(body) for body in table["bodies"]], pose(table["tip"])
        sponge = table["sponge"]
        self.sponge_pose = pose(sponge["pose"])
        self.radius, self.height = float(sponge["radius_m"]), float(sponge["height_m"])
        self.compression, self.stiffness = float(sponge.get("compression_m", 0.0)), sponge.get("stiffness_pa")
