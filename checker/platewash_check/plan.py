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


def real(value, where, least=-np.inf, most=np.inf, above=None):
    """A finite number within a range; `above` is a number that it must exceed."""
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not np.isfinite(value):
        raise Refused(f"{where}: expected a finite number, found {value!r}")
    if not least <= value <= most or (above is not None and not value > above):
        low = f"above {above:g}" if above is not None else f"from {least:g}"
        raise Refused(f"{where}: expected a number {low} to {most:g}, found {value!r}")
    return float(value)


def whole(value, where, least, most):
    """A whole number within a range."""
    if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= most:
        raise Refused(f"{where}: expected a whole number from {least} to {most}, found {value!r}")
    return value


def numbers(value, where, shape):
    """An array of finite numbers of a shape; -1 stands for any length."""
    leaves = [value]
    while leaves and isinstance(leaves[0], list):
        leaves = [leaf for item in leaves for leaf in (item if isinstance(item, list) else [item])]
    if any(isinstance(leaf, bool) or not isinstance(leaf, (int, float)) for leaf in leaves):
        raise Refused(f"{where}: expected numbers")
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
            if key in job:
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
        self._limits()
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
        self._requirements()
        self.cell = cell
        self.arm = only(cell["arm"], "job.workcell.arm", ("name", "urdf_sha256"), ("srdf_sha256",))
        self.mount = pose(cell["mount"], "job.workcell.mount")
        self.plates = [Plate(p, f"job.plates[{k}]") for k, p in enumerate(job["plates"])]
        self.tool = Tool(cell["tool"])
        self.obstacles = [Body(o, f"job.workcell.obstacles[{k}]") for k, o in enumerate(cell["obstacles"])]
        count = len(self.plates)
        self.order = [whole(k, "order", 0, count - 1) for k in root["order"]]
        self.segments, before = [], 0.0
        for k, s in enumerate(root["segments"]):
            only(s, f"segments[{k}]", ("kind", "plate", "t_start_s", "t_end_s"))
            whole(s["plate"], f"segments[{k}].plate", 0, count - 1)
            real(s["t_start_s"], f"segments[{k}].t_start_s", before, before)
            before = real(s["t_end_s"], f"segments[{k}].t_end_s", above=before)
            if not np.isin([s["t_start_s"], before], self.t).all():
                raise Refused(f"segments[{k}]: expected to begin and end at knots")
            self.segments.append(s)
        self.paths = {}
        for k, path in enumerate(root["wash_paths"]):
            only(path, f"wash_paths[{k}]", ("plate", "curve", "lift_m", "cone_rad"))
            if whole(path["plate"], f"wash_paths[{k}].plate", 0, count - 1) in self.paths:
                raise Refused(f"wash_paths[{k}].plate: expected each plate once")
            curve(path["curve"], f"wash_paths[{k}].curve")
            real(path["lift_m"], f"wash_paths[{k}].lift_m", most=10, above=0)
            real(path["cone_rad"], f"wash_paths[{k}].cone_rad", most=np.pi / 2, above=0)
            self.paths[path["plate"]] = path
        names = [body.name for body in self.tool.bodies + self.obstacles] + ["sponge"]
        names += [f"plate {k + 1}" for k in range(count)]
        self.names = names

    def _limits(self):
        """Limits above 0."""
        limits, where = self.limits, "job.limits"
        six = numbers(limits["joint_acceleration_rad_s2"], f"{where}.joint_acceleration_rad_s2", (6,))
        if not (six > 0).all():
            raise Refused(f"{where}.joint_acceleration_rad_s2: expected numbers above 0")
        for key in ("tip_speed_m_s", "tip_acceleration_m_s2"):
            real(limits[key], f"{where}.{key}", above=0)

    def _requirements(self):
        """Requirements within their ranges."""
        need, where = self.requirements, "job.requirements"
        for key in ("coverage", "clearance_m", "tilt_rad", "wash_speed_m_s", "wash_acceleration_m_s2"):
            real(need[key], f"{where}.{key}", 0, {"coverage": 1, "tilt_rad": np.pi / 2}.get(key, 1e3))
        for key in ("landing_m_s", "lifting_m_s", "wrist_rad"):
            if need.get(key) is not None:
                real(need[key], f"{where}.{key}", above=0)
        if need["overlap"] not in ("fail", "report") or not isinstance(need["as_listed"], bool):
            raise Refused(f"{where}: expected overlap fail or report, and as_listed true or false")
        contact = need.get("contact")
        if contact is not None:
            shares, others = ("share", "time_share", "dose_share"), ("compression_m", "height_error_m", "strain", "time_s", "dose_pa_m")
            only(contact, f"{where}.contact", shares + others + ("force_n",))
            for key in shares + others:
                real(contact[key], f"{where}.contact.{key}", 0, 1 if key in shares else 1e6)
            ascending(contact["force_n"], f"{where}.contact.force_n")
        holder = need.get("holder")
        if holder is not None:
            only(holder, f"{where}.holder", ("sponge_friction",), ("plate_mass_kg", "fixture", "ring"))
            real(holder["sponge_friction"], f"{where}.holder.sponge_friction", 0)
            real(holder.get("plate_mass_kg", 0), f"{where}.holder.plate_mass_kg", 0)
            for key, value in only(holder.get("fixture", {}), f"{where}.holder.fixture", (), ("force_n", "torque_nm")).items():
                real(value, f"{where}.holder.fixture.{key}", above=0)

    def span(self, segment):
        """First and last knot of a segment; both must be knots."""
        where = np.searchsorted(self.t, [segment["t_start_s"], segment["t_end_s"]])
        return where if (where < len(self.t)).all() else None


def ascending(pair, where):
    """Two numbers from 0 on, the first no greater than the second."""
    low, high = numbers(pair, where, (2,))
    if not 0 <= low <= high:
        raise Refused(f"{where}: expected two numbers from 0 on, the lesser first")
    return low, high


def curve(table, where):
    """Checks the numbers of a wash curve."""
    only(table, where, ("radius_m", "turns", "start_angle_rad", "closing_ring"), ("trim_rad", "rings"))
    radius = real(table["radius_m"], f"{where}.radius_m", 1e-4, 10)
    turns = real(table["turns"], f"{where}.turns", 0.25, 200)
    real(table["start_angle_rad"], f"{where}.start_angle_rad", -2 * np.pi, 2 * np.pi)
    real(table.get("trim_rad", 0), f"{where}.trim_rad", 0, 1.5)
    if not isinstance(table["closing_ring"], bool):
        raise Refused(f"{where}.closing_ring: expected true or false")
    length = np.pi * radius * (turns + 2)
    if table.get("rings") is not None:
        rings = only(table["rings"], f"{where}.rings", ("count", "inner_m", "lead_rad", "blend_rad"), ("laps",))
        count = whole(rings["count"], f"{where}.rings.count", 2, 100)
        laps = whole(rings.get("laps", 1), f"{where}.rings.laps", 1, 1000)
        real(rings["inner_m"], f"{where}.rings.inner_m", 0, radius)
        real(rings["lead_rad"], f"{where}.rings.lead_rad", 0, 2 * np.pi)
        real(rings["blend_rad"], f"{where}.rings.blend_rad", 1e-3, 2 * np.pi)
        length = 2 * np.pi * radius * (laps * count + 1)
    if length > 200:
        raise Refused(f"{where}: expected a curve of at most 100 m")


class Body:
    """A convex body, several, or a half-space that stands still or is carried; the shape in its own frame."""

    def __init__(self, table, where):
        only(table, where, ("name", "pose", "shape"), ("margin_m", "holds_plates"))
        self.name, self.pose = table["name"], pose(table["pose"], f"{where}.pose")
        if not isinstance(self.name, str) or not self.name:
            raise Refused(f"{where}.name: expected a name")
        self.margin = real(table.get("margin_m", 0.0), f"{where}.margin_m", 0)
        self.shape, self.holds = table["shape"], table.get("holds_plates")


class Plate:
    """A flat plate: a disc whose face is at z = 0 of its frame, its foot below."""

    def __init__(self, table, where):
        only(table, where, ("pose", "surface", "thickness_m"), ("foot", "terms"))
        surface = only(table["surface"], f"{where}.surface", ("meridian",), ("radius_m", "knots"))
        if surface["meridian"] != "disc" or "knots" in surface or "foot" in table or "terms" in table:
            raise Refused(f"{where}: only flat discs without a foot or terms of their own are checked by this version")
        self.pose = pose(table["pose"], f"{where}.pose")
        self.radius = real(surface.get("radius_m"), f"{where}.surface.radius_m", most=10, above=0)
        self.thickness = real(table["thickness_m"], f"{where}.thickness_m", most=10, above=0)
        self.normal = self.pose[0][:, 2]


class Tool:
    """The tool, in the mounting frame."""

    def __init__(self, table):
        only(table, "tool", ("bodies", "sponge", "tip"), ("mass",))
        if not table["bodies"]:
            raise Refused("tool.bodies: a tool that the arm itself holds is not checked by this version")
        self.bodies = [Body(b, f"tool.bodies[{k}]") for k, b in enumerate(table["bodies"])]
        sponge = only(
            table["sponge"], "tool.sponge", ("height_m", "pose", "radius_m"), ("compression_m", "stiffness_pa")
        )
        self.sponge_pose = pose(sponge["pose"], "tool.sponge.pose")
        self.radius = real(sponge["radius_m"], "tool.sponge.radius_m", most=10, above=0)
        self.height = real(sponge["height_m"], "tool.sponge.height_m", most=10, above=0)
        self.compression = real(sponge.get("compression_m", 0.0), "tool.sponge.compression_m", 0, 10)
        stiffness = sponge.get("stiffness_pa")
        self.stiffness = None if stiffness is None else ascending(stiffness, "tool.sponge.stiffness_pa")
        self.tip = pose(table["tip"], "tool.tip")
