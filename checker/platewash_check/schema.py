"""The form of a plan file: which keys there are, and the range of each number. What is not named here is refused."""

import re

import numpy as np


class Refused(Exception):
    """A file that cannot be read as a plan, or states what this program does not know."""


def expect(true, where, words, found):
    if not true:
        raise Refused(f"{where}: expected {words}, found {found!r}")


def is_number(value):
    return not isinstance(value, bool) and isinstance(value, (int, float)) and np.isfinite(value)


def number(least=-np.inf, most=np.inf, above=None):
    """A finite number in a range; `above` is a number that it must exceed."""
    low = f"above {above:g}" if above is not None else f"from {least:g}"

    def rule(value, where):
        inside = is_number(value) and least <= value <= most and (above is None or value > above)
        expect(inside, where, f"a finite number {low} to {most:g}", value)

    return rule


def whole(least, most):
    """A whole number in a range."""
    inside = lambda value: is_number(value) and isinstance(value, int) and least <= value <= most
    return lambda value, where: expect(inside(value), where, f"a whole number from {least} to {most}", value)


def array(*shape, least=-np.inf, above=-np.inf):
    """Finite numbers in a shape; -1 stands for any length."""
    words = f"finite numbers of the shape {shape}, each at least {least:g}, above {above:g}"

    def rule(value, where, depth=0):
        if depth == len(shape):
            expect(is_number(value) and value >= least and value > above, where, words, value)
            return
        expect(isinstance(value, list) and shape[depth] in (-1, len(value)), where, words, value)
        for k, item in enumerate(value):
            rule(item, f"{where}[{k}]", depth + 1)

    return rule


def one_of(*values):
    return lambda value, where: expect(any(value is v or value == v != True for v in values), where, f"one of {values}", value)


def anything(value, where):
    """What cannot change an answer, or is checked where it is used."""


def check(rule, value, where):
    """Checks a value by a rule: a function, a list of one rule for each item, or a table whose keys with `?` may be missing."""
    if callable(rule):
        rule(value, where)
    elif isinstance(rule, list):
        expect(isinstance(value, list), where, "a list", value)
        for k, item in enumerate(value):
            check(rule[0], item, f"{where}[{k}]")
    else:
        expect(isinstance(value, dict), where, "a table", value)
        for key in rule:
            expect(key in value or key.endswith("?"), where, f"the key {key!r}", sorted(value))
        for key, item in value.items():
            inner = rule.get(key, rule.get(f"{key}?"))
            if inner is None:
                raise Refused(f"{where}: the key {key!r} is not known to this version")
            check(inner, item, f"{where}.{key}")


def unit(value, where):
    array(4)(value, where)
    expect(abs(np.linalg.norm(value) - 1) <= 1e-9, where, "a length of 1", value)


def ascending(value, where):
    array(2, least=0)(value, where)
    expect(value[0] <= value[1], where, "the lesser number first", value)


def name(value, where):
    expect(isinstance(value, str) and value, where, "a name", value)


def shape(value, where):
    """A convex shape: one kind with its sizes."""
    expect(isinstance(value, dict) and len(value) == 1 and next(iter(value)) in SHAPES, where, f"one of {[*SHAPES]}", value)
    for kind, sizes in value.items():
        check(SHAPES[kind], sizes, f"{where}.{kind}")


def obstacle(value, where):
    """A convex shape, several hulls, or a half-space."""
    if value != "half_space":
        several = isinstance(value, dict) and "parts" in value
        check({"parts": [array(-1, 3)]} if several else {"convex": shape}, value, where)
        expect(not several or all(value["parts"]), where, "points in each part", value)


def digest(value, where):
    expect(isinstance(value, str) and re.fullmatch("[0-9a-f]{64}", value), where, "64 digits of lower-case hexadecimal", value)


def part(value, where):
    """The part of a recovery: the plates that are left, or the motion home, with the line along which the sponge leaves a plate."""
    if value != "rest":
        check({"home": {"retreat": anything}}, value, where)
        if value["home"]["retreat"] is not None:
            check({"plate": whole(0, 999), "length_m": number(1e-4, 1e3)}, value["home"]["retreat"], f"{where}.home.retreat")


def held(value, where):
    if value != "all":
        check([whole(0, 999)], value, where)


SIZE = number(most=1e4, above=0)
SHAPES = {
    "box": {"half_m": array(3, above=0)},
    "sphere": {"radius_m": SIZE},
    "capsule": {"radius_m": SIZE, "half_length_m": SIZE},
    "cylinder": {"radius_m": SIZE, "half_length_m": SIZE},
    "hull": {"points": array(-1, 3)},
}
LENGTH, SHARE, FREE = number(most=10, above=0), number(0, 1), number(0, 1e6)
POSITIVE, SWITCH = number(above=0), one_of(True, False)
POSE = {"position_m": array(3), "quaternion_wxyz": unit}
BODY = {"name": name, "pose": POSE, "shape": shape, "margin_m?": number(0)}
OBSTACLE = {**BODY, "shape": obstacle, "holds_plates?": held}
SPONGE = {"height_m": LENGTH, "pose": POSE, "radius_m": LENGTH, "compression_m?": number(0, 10), "stiffness_pa?": ascending}
CONTACT = {
    **dict.fromkeys(("share", "time_share", "dose_share"), SHARE),
    **dict.fromkeys(("compression_m", "height_error_m", "strain", "time_s", "dose_pa_m"), FREE),
    "force_n": ascending,
}
REQUIREMENTS = {
    "coverage": SHARE,
    **dict.fromkeys(("clearance_m", "wash_speed_m_s", "wash_acceleration_m_s2"), number(0, 1e3)),
    "tilt_rad": number(0, np.pi / 2),
    "overlap": one_of("fail", "report"),
    "as_listed": SWITCH,
    **dict.fromkeys(("landing_m_s?", "lifting_m_s?", "wrist_rad?"), POSITIVE),
    "contact?": CONTACT,
    "holder?": {
        "sponge_friction": number(0),
        "plate_mass_kg?": number(0),
        "fixture?": {"force_n": POSITIVE, "torque_nm": POSITIVE},
        "ring?": anything,
    },
}
CURVE = {
    "radius_m": number(1e-4, 10),
    "turns": number(0.25, 200),
    "start_angle_rad": number(-2 * np.pi, 2 * np.pi),
    "closing_ring": SWITCH,
    "trim_rad?": number(0, 1.5),
    "rings?": {
        "count": whole(2, 100),
        "inner_m": number(0, 10),
        "lead_rad": number(0, 2 * np.pi),
        "blend_rad": number(1e-3, 2 * np.pi),
        "laps?": whole(1, 1000),
    },
}
PLAN = {
    "format": one_of("platewash-plan/2"),
    "process": one_of("wash"),
    "hash": name,
    "provenance?": anything,
    "order": [whole(0, 999)],
    "knots": {"t_s": array(-1), "q_rad": array(-1, 6), "qd_rad_s": array(-1, 6)},
    "segments": [{"kind": name, "plate": whole(0, 999), "t_start_s": number(0), "t_end_s": number(0)}],
    "wash_paths": [{"plate": whole(0, 999), "curve": CURVE, "lift_m": LENGTH, "cone_rad": number(most=np.pi / 2, above=0)}],
    "job": {
        "home_rad": array(2, 6),
        "limits": {"joint_acceleration_rad_s2": array(6, above=0), **dict.fromkeys(("tip_speed_m_s", "tip_acceleration_m_s2"), POSITIVE)},
        "plates": [{"pose": POSE, "surface": {"meridian": one_of("disc"), "radius_m": LENGTH}, "thickness_m": LENGTH}],
        "requirements": REQUIREMENTS,
        "workcell": {
            "arm": {"name": name, "urdf_sha256": name, "srdf_sha256?": name},
            "exclusions": [{"pair": [name], "reason": name}],
            "mount": POSE,
            "obstacles": [OBSTACLE],
            "tool": {"bodies": [BODY], "sponge": SPONGE, "tip": POSE, "mass?": anything},
            "reduced_clearances?": anything,
        },
        "dry_run?": {"parent": digest, "height_m": number(most=1e3, above=0)},
        "recovery?": {"parent": digest, "left_out": [whole(0, 999)], "part": part},
        **dict.fromkeys(("planner?", "seed?", "simulation?"), anything),
    },
}
