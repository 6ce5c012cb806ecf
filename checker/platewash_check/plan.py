"""The plan file: its fields, strictly, and the shapes and poses in it."""

import hashlib
import json
import re

import numpy as np

FORMAT = "platewash-plan/2"


class Refused(Exception):
    """A file that cannot be read as a plan, or states what this program does not know."""


def only(table, where, required, optional=()):
    """Refuses a table with a key that is missing or not known."""
    if not isinstance(table, dict):
        raise Refused(f"{where}: expected a table, found {type(table).__name__}")
    for key in required:
        if key not in table:
            raise Refused(f"{where}: expected the key {key!r}; it is missing")
    for key in table:
        if key not in required and key not in optional:
            raise Refused(f"{where}: the key {key!r} is not known")
    return table


def numbers(value, where, shape):
    """An array of finite numbers of a shape; -1 stands for any length."""
    try:
        array = np.array(value, dtype=float)
    except (TypeError, ValueError):
        raise Refused(f"{where}: expected numbers") from None
    if array.ndim != len(shape) or any(n not in (-1, m) for n, m in zip(shape, array.shape)):
        raise Refused(f"{where}: expected numbers of the shape {shape}, found {array.shape}")
    if not np.isfinite(array).all():
        raise Refused(f"{where}: expected finite numbers")
    return array


def rotation(wxyz):
    """The rotation matrix of a unit quaternion (w, x, y, z)."""
    w, x, y, z = wxyz
    return np.array(
        [
            [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
        ]
    )


def pose(table, where):
    """A pose as rotation matrix and position."""
    only(table, where, ("position_m", "quaternion_wxyz"))
    wxyz = numbers(table["quaternion_wxyz"], f"{where}.quaternion_wxyz", (4,))
    if abs(np.linalg.norm(wxyz) - 1) > 1e-9:
        raise Refused(f"{where}.quaternion_wxyz: expected a length of 1")
    return rotation(wxyz / np.linalg.norm(wxyz)), numbers(table["position_m"], f"{where}.position_m", (3,))


def inverse(a):
    r, p = a
    return r.T, -r.T @ p


def compose(a, b):
    return a[0] @ b[0], a[0] @ b[1] + a[1]


class Plan:
    """A plan file. Times in seconds, lengths in metres, angles in radians."""

    def __init__(self, text):
        def no_repeats(pairs):
            keys = [key for key, _ in pairs]
            for key in keys:
                if keys.count(key) > 1:
                    raise Refused(f"the key {key!r} stands twice")
            return dict(pairs)

        def refuse(constant):
            raise Refused(f"found {constant}, which is no number")

        try:
            root = json.loads(text, object_pairs_hook=no_repeats, parse_constant=refuse)
        except (json.JSONDecodeError, RecursionError) as error:
            raise Refused(f"not JSON: {error}") from None
        only(
            root,
            "the plan",
            ("format", "hash", "job", "knots", "order", "process", "segments", "wash_paths"),
            ("provenance",),
        )
        if root["format"] != FORMAT:
            raise Refused(f"format: expected {FORMAT}, found {root['format']!r}")
        if root["process"] != "wash":
            raise Refused(f"process: only plans of washing are checked, found {root['process']!r}")
        self.root, self.hash = root, root["hash"]
        # The file is canonical, so that its hash is that of the text without the member itself.
        rest = re.sub(r'"hash":"[0-9a-f]*",', "", text, count=1)
        self.hash_found = hashlib.sha256(rest.encode()).hexdigest()
        job = only(
            root["job"],
            "job",
            ("home_rad", "limits", "plates", "requirements", "workcell"),
            ("planner", "seed", "simulation", "soils", "measured", "dry_run", "recovery"),
        )
        for key in ("dry_run", "recovery", "soils", "measured"):
            if job.get(key):
                raise Refused(f"job.{key}: plans with it are not checked by this version")
        self.job = job
        knots = only(root["knots"], "knots", ("t_s", "q_rad", "qd_rad_s"))
        self.t = numbers(knots["t_s"], "knots.t_s", (-1,))
        self.q = numbers(knots["q_rad"], "knots.q_rad", (-1, 6))
        self.qd = numbers(knots["qd_rad_s"], "knots.qd_rad_s", (-1, 6))
        if not len(self.t) == len(self.q) == len(self.qd) >= 2:
            raise Refused("knots: expected as many times, positions and speeds, and two at least")
        if self.t[0] != 0 or not (np.diff(self.t) > 1e-9).all():
            raise Refused("knots.t_s: expected times that begin at 0 and ascend")
        self.home = numbers(job["home_rad"], "job.home_rad", (2, 6))
        self.limits = only(
            job["limits"], "job.limits", ("joint_acceleration_rad_s2", "tip_speed_m_s", "tip_acceleration_m_s2")
        )
        self.requirements = only(
            job["requirements"],
            "job.requirements",
            (
                "coverage",
                "clearance_m",
                "tilt_rad",
                "wash_speed_m_s",
                "wash_acceleration_m_s2",
                "overlap",
                "as_listed",
            ),
            ("landing_m_s", "lifting_m_s", "wrist_rad", "contact", "holder"),
        )
        cell = only(
            job["workcell"],
            "job.workcell",
            ("arm", "exclusions", "mount", "obstacles", "tool"),
            ("reduced_clearances",),
        )
        self.cell = cell
        self.arm = only(cell["arm"], "job.workcell.arm", ("name", "urdf_sha256"), ("srdf_sha256",))
        self.mount = pose(cell["mount"], "job.workcell.mount")
        self.plates = [Plate(p, f"job.plates[{k}]") for k, p in enumerate(job["plates"])]
        self.tool = Tool(cell["tool"])
        self.obstacles = [Body(o, f"job.workcell.obstacles[{k}]") for k, o in enumerate(cell["obstacles"])]
        self.order = [int(k) for k in root["order"]]
        self.segments = [
            only(s, f"segments[{k}]", ("kind", "plate", "t_start_s", "t_end_s"))
            for k, s in enumerate(root["segments"])
        ]
        self.paths = {}
        for k, path in enumerate(root["wash_paths"]):
            only(path, f"wash_paths[{k}]", ("plate", "curve", "lift_m", "cone_rad"))
            if path["plate"] in self.paths or path["plate"] not in range(len(self.plates)):
                raise Refused(f"wash_paths[{k}].plate: expected each plate once")
            self.paths[path["plate"]] = path

    def span(self, segment):
        """First and last knot of a segment; both must be knots."""
        where = np.searchsorted(self.t, [segment["t_start_s"], segment["t_end_s"]])
        return where if (where < len(self.t)).all() else None


class Body:
    """A convex body, several, or a half-space that stands still or is carried; the shape in its own frame."""

    def __init__(self, table, where):
        only(table, where, ("name", "pose", "shape"), ("margin_m", "holds_plates"))
        self.name, self.pose = table["name"], pose(table["pose"], f"{where}.pose")
        self.margin = float(table.get("margin_m", 0.0))
        self.shape, self.holds = table["shape"], table.get("holds_plates")


class Plate:
    """A flat plate: a disc whose face is at z = 0 of its frame, its foot below."""

    def __init__(self, table, where):
        only(table, where, ("pose", "surface", "thickness_m"), ("foot", "terms"))
        surface = only(table["surface"], f"{where}.surface", ("meridian",), ("radius_m", "knots"))
        if surface["meridian"] != "disc" or table.get("foot") or table.get("terms"):
            raise Refused(f"{where}: only flat discs without a foot or terms of their own are checked by this version")
        self.pose = pose(table["pose"], f"{where}.pose")
        self.radius, self.thickness = float(surface["radius_m"]), float(table["thickness_m"])
        self.normal = self.pose[0][:, 2]


class Tool:
    """The tool, in the mounting frame."""

    def __init__(self, table):
        only(table, "tool", ("bodies", "sponge", "tip"), ("mass", "carried_by"))
        self.bodies = [Body(b, f"tool.bodies[{k}]") for k, b in enumerate(table["bodies"])]
        sponge = only(
            table["sponge"], "tool.sponge", ("height_m", "pose", "radius_m"), ("compression_m", "stiffness_pa")
        )
        self.sponge_pose = pose(sponge["pose"], "tool.sponge.pose")
        self.radius, self.height = float(sponge["radius_m"]), float(sponge["height_m"])
        self.compression = float(sponge.get("compression_m", 0.0))
        self.stiffness = sponge.get("stiffness_pa")
        self.tip = pose(table["tip"], "tool.tip")
