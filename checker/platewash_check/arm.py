"""The arm: a chain of six revolute joints and the convex shapes of its links, out of a URDF, and the pairs that an SRDF disables."""

import hashlib
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from .mesh import corners, vertices
from .plan import compose
from .schema import Refused, expect

JOINTS = 6
IDENTITY = (np.eye(3), np.zeros(3))


def parsed(text, what):
    try:
        return ET.fromstring(text)
    except ET.ParseError as error:
        raise Refused(f"{what}: not XML: {error}") from None


def linked(joint, side):
    """Name of the link at a side of a joint."""
    element = joint.find(side)
    expect(element is not None and element.get("link"), f"URDF: joint {joint.get('name')}", f"a {side} link", None)
    return element.get("link")


def floats(text, count, what):
    try:
        values = np.array([float(word) for word in (text or "").split()])
    except ValueError:
        values = np.array([])
    expect(len(values) == count and np.isfinite(values).all(), what, f"{count} finite numbers", text)
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
    turned = Rotation.from_euler("xyz", floats(element.get("rpy", "0 0 0"), 3, f"{what}: origin rpy"))
    return turned.as_matrix(), floats(element.get("xyz", "0 0 0"), 3, f"{what}: origin xyz")


def geometry(element, what, folder):
    """A shape of a link in the words of the plan file."""
    shapes = list(element.find("geometry") if element.find("geometry") is not None else [])
    expect(len(shapes) == 1, what, "one geometry", shapes)
    shape = shapes[0]
    size = lambda key: float(floats(shape.get(key), 1, f"{what}: {key}")[0])
    if shape.tag == "box":
        return {"box": {"half_m": list(0.5 * floats(shape.get("size"), 3, f"{what}: size"))}}
    if shape.tag == "sphere":
        return {"sphere": {"radius_m": size("radius")}}
    if shape.tag == "cylinder":
        return {"cylinder": {"radius_m": size("radius"), "half_length_m": 0.5 * size("length")}}
    if shape.tag == "mesh":
        points = vertices(shape.get("filename"), folder, floats(shape.get("scale", "1 1 1"), 3, f"{what}: scale"))
        return {"hull": {"points": points}}
    raise Refused(f"{what}: a {shape.tag} is not checked by this version")


class Joint:
    """A revolute joint: its frame in that of the joint before, its axis, and its limits."""

    def __init__(self, element, before):
        self.name = element.get("name")
        self.links = [linked(element, side) for side in ("parent", "child")]
        what = f"joint {self.name}"
        self.frame = compose(before, origin(element.find("origin"), what))
        axis = element.find("axis")
        axis = floats(axis.get("xyz") if axis is not None else "1 0 0", 3, f"{what}: axis")
        self.axis = axis / np.linalg.norm(axis)
        limit = element.find("limit")
        expect(limit is not None, what, "limits", None)
        expect(element.find("mimic") is None, what, "no mimic: it is not checked by this version", "one")
        self.speed = float(floats(limit.get("velocity"), 1, f"{what}: velocity")[0])
        # An acceleration of 0 is unknown; so is one that is not stated.
        rates = [floats(limit.get(key, "0"), 1, f"{what}: {key}")[0] for key in ("acceleration", "deceleration")]
        self.acceleration = min([rate for rate in rates if rate > 0], default=np.inf)
        ends = [float(floats(limit.get(key, "0"), 1, f"{what}: {key}")[0]) for key in ("lower", "upper")]
        self.lower, self.upper = ends if element.get("type") == "revolute" else (-np.inf, np.inf)
        soft = element.find("safety_controller")
        for side, pick in (("lower", max), ("upper", min)):
            value = soft.get(f"soft_{side}_limit") if soft is not None else None
            if value is not None:
                setattr(self, side, pick(getattr(self, side), float(floats(value, 1, f"{what}: soft limit")[0])))


class Arm:
    """An arm; every link is fixed to the frame of one of 0 (the base) to 6 joints."""

    def __init__(self, urdf, srdf=None, folder="."):
        """Reads the texts of a description and an SRDF; `folder` is that of the description, to which the files of meshes are relative."""
        self.srdf_sha256 = hashlib.sha256(srdf.encode()).hexdigest() if srdf is not None else None
        root = parsed(urdf, "URDF")
        self.name = root.get("name")
        links = {link.get("name"): link for link in root.findall("link")}
        children = {}
        for joint in root.findall("joint"):
            children.setdefault(linked(joint, "parent"), []).append(joint)
        parents = {linked(joint, "child"): linked(joint, "parent") for joint in root.findall("joint")}
        bases = [name for name in links if name not in parents]
        expect(len(bases) == 1, "URDF", "one root link", bases)
        expect(len(links) == len(root.findall("link")), "URDF", "each link once", sorted(link.get("name") for link in root.findall("link")))
        self.joints, self.links = [], {}
        self._walk(bases[0], IDENTITY, 0, children)
        expect(len(self.joints) == JOINTS, "URDF", f"a chain of {JOINTS} revolute joints", len(self.joints))
        mounted = self.links.get("tool0", (0,))[0] == JOINTS
        expect(mounted, "URDF", "a link tool0 behind the last joint, on which the tool is mounted", sorted(self.links))
        self.mounting = self.links["tool0"][1]
        self.shapes, sealed = {}, hashlib.sha256(urdf.encode())
        order = list(bases)
        for name in order:
            # The links of a parent are in the order of the file.
            order += [below for below in links if parents.get(below) == name]
            for k, element in enumerate(links[name].findall("collision")):
                what = f"link {name}, collision {k}"
                placed = compose(self.links[name][1], origin(element.find("origin"), what))
                shape = geometry(element, what, Path(folder))
                if "hull" in shape:
                    sealed.update(shape["hull"]["points"].astype("<f8").tobytes())
                    shape["hull"]["points"] = corners(shape["hull"]["points"]).tolist()
                self.shapes.setdefault(name, []).append((placed, shape))
        expect(len(order) == len(links), "URDF", "links that all hang together", sorted(set(links) - set(order)))
        self.urdf_sha256 = sealed.hexdigest()
        for key in ("lower", "upper", "speed", "acceleration"):
            setattr(self, key, np.array([getattr(joint, key) for joint in self.joints]))
        self.disabled = set() if srdf is not None else self.neighbours()
        if srdf is not None:
            for element in parsed(srdf, "SRDF"):
                if element.tag == "disable_collisions":
                    self.disabled.add(frozenset((element.get("link1"), element.get("link2"))))
                else:
                    expect("collision" not in element.tag, "SRDF", "no element that this version does not check", element.tag)

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
        expect(len(moving) <= 1, f"URDF: link {link}", "one joint that moves", len(moving))
        for joint in children.get(link, []):
            child, kind = linked(joint, "child"), joint.get("type")
            if kind == "fixed":
                below = compose(placed, origin(joint.find("origin"), f"joint {joint.get('name')}"))
                self._walk(child, below, body, children)
            elif kind in ("revolute", "continuous"):
                expect(body == len(self.joints), f"URDF: joint {joint.get('name')}", "a joint of the chain", "one off it")
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
