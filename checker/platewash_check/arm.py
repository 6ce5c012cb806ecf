"""The arm: a chain of six revolute joints and the convex shapes of its links, out of a URDF, and the pairs that an SRDF disables."""

import hashlib
import xml.etree.ElementTree as ET

import numpy as np

from .plan import Refused, compose

JOINTS = 6
IDENTITY = (np.eye(3), np.zeros(3))


def floats(text, count, what):
    try:
        values = np.array([float(word) for word in (text or "").split()])
    except ValueError:
        values = np.array([])
    if len(values) != count or not np.isfinite(values).all():
        raise Refused(f"{what}: expected {count} finite numbers, found {text!r}")
    return values


def turn(axis, angle):
    """Rotation matrices about a unit axis by an array of angles (Rodrigues)."""
    x, y, z = axis
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = np.asarray(angle)[..., None, None]
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * (k @ k)


def origin(element, what):
    """Pose of an element `origin`: rotations about the fixed axes x, y, z, and a translation."""
    if element is None:
        return IDENTITY
    r, p, y = floats(element.get("rpy", "0 0 0"), 3, f"{what}: origin rpy")
    turned = turn((0, 0, 1), y) @ turn((0, 1, 0), p) @ turn((1, 0, 0), r)
    return turned, floats(element.get("xyz", "0 0 0"), 3, f"{what}: origin xyz")


def geometry(element, what):
    """A shape of a link in the words of the plan file."""
    shapes = list(element.find("geometry") if element.find("geometry") is not None else [])
    if len(shapes) != 1:
        raise Refused(f"{what}: expected one geometry")
    shape = shapes[0]
    size = lambda key: float(floats(shape.get(key), 1, f"{what}: {key}")[0])
    if shape.tag == "box":
        return {"box": {"half_m": list(0.5 * floats(shape.get("size"), 3, f"{what}: size"))}}
    if shape.tag == "sphere":
        return {"sphere": {"radius_m": size("radius")}}
    if shape.tag == "cylinder":
        return {"cylinder": {"radius_m": size("radius"), "half_length_m": 0.5 * size("length")}}
    raise Refused(f"{what}: a {shape.tag} is not checked by this version")


class Joint:
    """A revolute joint: its frame in that of the joint before, its axis, and its limits."""

    def __init__(self, element, before):
        self.name = element.get("name")
        self.links = [element.find(side).get("link") for side in ("parent", "child")]
        what = f"joint {self.name}"
        self.frame = compose(before, origin(element.find("origin"), what))
        axis = element.find("axis")
        axis = floats(axis.get("xyz") if axis is not None else "1 0 0", 3, f"{what}: axis")
        self.axis = axis / np.linalg.norm(axis)
        limit = element.find("limit")
        if limit is None:
            raise Refused(f"{what}: expected limits")
        self.speed = float(floats(limit.get("velocity"), 1, f"{what}: velocity")[0])
        self.lower, self.upper = -np.inf, np.inf
        if element.get("type") == "revolute":
            self.lower = float(floats(limit.get("lower", "0"), 1, f"{what}: lower")[0])
            self.upper = float(floats(limit.get("upper", "0"), 1, f"{what}: upper")[0])
        soft = element.find("safety_controller")
        if soft is not None:
            for key, pick in (("soft_lower_limit", max), ("soft_upper_limit", min)):
                if soft.get(key) is not None:
                    side = "lower" if pick is max else "upper"
                    value = float(floats(soft.get(key), 1, f"{what}: {key}")[0])
                    setattr(self, side, pick(getattr(self, side), value))
        if element.find("mimic") is not None:
            raise Refused(f"{what}: a joint that mimics another one is not checked by this version")


class Arm:
    """An arm; every link is fixed to the frame of one of 0 (the base) to 6 joints."""

    def __init__(self, urdf, srdf=None):
        self.urdf_sha256 = hashlib.sha256(urdf.encode()).hexdigest()
        self.srdf_sha256 = hashlib.sha256(srdf.encode()).hexdigest() if srdf is not None else None
        root = ET.fromstring(urdf)
        self.name = root.get("name")
        links = {link.get("name"): link for link in root.findall("link")}
        children = {}
        for joint in root.findall("joint"):
            children.setdefault(joint.find("parent").get("link"), []).append(joint)
        below = {joint.find("child").get("link") for joint in root.findall("joint")}
        bases = [name for name in links if name not in below]
        if len(bases) != 1:
            raise Refused(f"URDF: expected one root link, found {bases}")
        self.joints, self.links = [], {}
        self._walk(bases[0], IDENTITY, 0, children)
        if len(self.joints) != JOINTS:
            raise Refused(f"URDF: expected a chain of {JOINTS} revolute joints, found {len(self.joints)}")
        if "tool0" not in self.links or self.links["tool0"][0] != JOINTS:
            raise Refused("URDF: expected a link tool0 behind the last joint, on which the tool is mounted")
        self.mounting = self.links["tool0"][1]
        self.shapes = {}
        for name, link in links.items():
            for k, element in enumerate(link.findall("collision")):
                what = f"link {name}, collision {k}"
                placed = compose(self.links[name][1], origin(element.find("origin"), what))
                self.shapes.setdefault(name, []).append((placed, geometry(element, what)))
        for key in ("lower", "upper", "speed"):
            setattr(self, key, np.array([getattr(joint, key) for joint in self.joints]))
        self.disabled = set() if srdf is not None else self.neighbours()
        if srdf is not None:
            for element in ET.fromstring(srdf):
                if element.tag == "disable_collisions":
                    self.disabled.add(frozenset((element.get("link1"), element.get("link2"))))
                elif "collision" in element.tag:
                    raise Refused(f"SRDF: {element.tag} is not checked by this version")

    def neighbours(self):
        """Pairs of links that share one of the six joints; what is fixed to a link without a shape stands for it."""
        pairs = set()
        for joint in self.joints:
            sides = []
            for link in joint.links:
                body = self.links[link][0]
                fixed = [name for name in self.shapes if self.links[name][0] == body]
                sides.append([link] if link in self.shapes else fixed)
            pairs |= {frozenset((a, b)) for a in sides[0] for b in sides[1]}
        return pairs

    def _walk(self, link, placed, body, children):
        self.links[link] = (body, placed)
        moving = [j for j in children.get(link, []) if j.get("type") != "fixed"]
        if len(moving) > 1:
            raise Refused(f"URDF: link {link} carries two joints that move")
        for joint in children.get(link, []):
            child, kind = joint.find("child").get("link"), joint.get("type")
            if kind == "fixed":
                below = compose(placed, origin(joint.find("origin"), f"joint {joint.get('name')}"))
                self._walk(child, below, body, children)
            elif kind in ("revolute", "continuous"):
                if body != len(self.joints):
                    raise Refused(f"URDF: joint {joint.get('name')} is off the chain")
                self.joints.append(Joint(joint, placed))
                self._walk(child, IDENTITY, len(self.joints), children)
            else:
                raise Refused(f"URDF: joint {joint.get('name')}: a {kind} joint is not checked by this version")

    def frames(self, q):
        """Rotations (7, N, 3, 3) and positions (7, N, 3) of the base and of each joint's moving frame, in the frame of the base."""
        n = len(q)
        r, p = [np.broadcast_to(np.eye(3), (n, 3, 3))], [np.zeros((n, 3))]
        for k, joint in enumerate(self.joints):
            o, d = joint.frame
            p.append(p[-1] + r[-1] @ d)
            r.append(r[-1] @ o @ turn(joint.axis, q[:, k]))
        return np.array(r), np.array(p)

    def reaches(self, point):
        """Greatest distance of a point, fixed to the last link, from each joint's axis [m], whatever the other joints do."""
        reach, all_reaches = np.linalg.norm(point), []
        for joint in reversed(self.joints):
            all_reaches.append(reach)
            reach = reach + np.linalg.norm(joint.frame[1])
        return np.array(all_reaches[::-1])
