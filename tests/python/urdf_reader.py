"""A small URDF reader of our own, so that the references share no code with what they check.

Poses are 4 x 4 matrices; `T_a_b` maps coordinates in b to a. Metres and radians.
"""

import xml.etree.ElementTree as ET
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation


@dataclass(frozen=True)
class Shape:
    """A primitive of a link. `size`: box (x, y, z) · cylinder (radius, length) · sphere (radius,)."""

    name: str
    kind: str
    size: tuple[float, ...]
    T_link_shape: np.ndarray


@dataclass(frozen=True)
class Joint:
    name: str
    kind: str
    parent: str
    child: str
    T_parent_joint: np.ndarray
    axis: np.ndarray


def numbers(text: str) -> np.ndarray:
    return np.array([float(word) for word in text.split()])


def pose(translation, rotation=None) -> np.ndarray:
    T = np.eye(4)
    T[:3, 3] = translation
    if rotation is not None:
        T[:3, :3] = rotation
    return T


def origin(element: ET.Element) -> np.ndarray:
    """Pose of <origin>; rpy turns about the fixed x, then y, then z."""
    found = element.find("origin")
    if found is None:
        return np.eye(4)
    rpy = numbers(found.get("rpy", "0 0 0"))
    return pose(numbers(found.get("xyz", "0 0 0")), Rotation.from_euler("xyz", rpy).as_matrix())


def shape(element: ET.Element) -> Shape:
    geometry = element.find("geometry")[0]
    keys = {"box": ("size",), "cylinder": ("radius", "length"), "sphere": ("radius",)}[geometry.tag]
    size = tuple(float(v) for key in keys for v in geometry.get(key).split())
    return Shape(element.get("name", ""), geometry.tag, size, origin(element))


def shapes(path: Path, kind: str = "collision") -> dict[str, list[Shape]]:
    """Link name → its collision (or visual) primitives, in file order."""
    links = ET.parse(path).getroot().findall("link")
    return {link.get("name"): [shape(e) for e in link.findall(kind)] for link in links}


def joints(path: Path) -> list[Joint]:
    """Joints in file order, axes normalised."""
    result = []
    for element in ET.parse(path).getroot().findall("joint"):
        axis = element.find("axis")
        direction = np.array([1.0, 0.0, 0.0]) if axis is None else numbers(axis.get("xyz"))
        result.append(
            Joint(
                element.get("name"),
                element.get("type"),
                element.find("parent").get("link"),
                element.find("child").get("link"),
                origin(element),
                direction / np.linalg.norm(direction),
            )
        )
    return result


class Tree:
    """The links and joints of one file, read once and posed many times."""

    def __init__(self, path: Path):
        self.joints = joints(path)
        self.by_child = {joint.child: joint for joint in self.joints}
        (self.root,) = {joint.parent for joint in self.joints} - set(self.by_child)

    def chain(self, tip: str) -> list[Joint]:
        """Joints from the root to `tip`."""
        found = []
        while tip in self.by_child:
            found.append(self.by_child[tip])
            tip = found[-1].parent
        return found[::-1]

    def poses(self, q: dict[str, float]) -> dict[str, np.ndarray]:
        """T_root_link of every link; `q` maps the names of moving joints to angles."""
        known = {self.root: np.eye(4)}
        for child in self.by_child:
            for joint in self.chain(child):
                if joint.child not in known:
                    turn = Rotation.from_rotvec(joint.axis * q.get(joint.name, 0.0)).as_matrix()
                    known[joint.child] = known[joint.parent] @ joint.T_parent_joint @ pose(np.zeros(3), turn)
        return known

    def jacobian(self, q: dict[str, float], tip: str) -> np.ndarray:
        """Geometric Jacobian of `tip`: root axes, linear rows first, one column a moving joint."""
        placed = self.poses(q)
        end = placed[tip][:3, 3]
        columns = []
        for joint in self.chain(tip):
            if joint.kind != "fixed":
                # The axis is invariant under the joint's own rotation.
                axis = placed[joint.child][:3, :3] @ joint.axis
                columns.append(np.concatenate([np.cross(axis, end - placed[joint.child][:3, 3]), axis]))
        return np.array(columns).T


def axis_ends(cylinder: Shape) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper end point of a cylinder's axis, in its link."""
    half = cylinder.T_link_shape[:3, 2] * cylinder.size[1] / 2
    centre = cylinder.T_link_shape[:3, 3]
    return centre - half, centre + half


def segments(parts: list[Shape]) -> list[tuple[np.ndarray, np.ndarray, float]] | None:
    """Link shapes as (start, end, radius) if they are spheres and capsules only, else None.

    A capsule is a cylinder NAME followed by the spheres NAME_start and NAME_end.
    """
    found, index = [], 0
    while index < len(parts):
        part = parts[index]
        following = [p.name for p in parts[index + 1 : index + 3]]
        if part.kind == "sphere":
            centre = part.T_link_shape[:3, 3]
            found.append((centre, centre, part.size[0]))
            index += 1
        elif part.kind == "cylinder" and following == [f"{part.name}_start", f"{part.name}_end"]:
            found.append((*axis_ends(part), part.size[0]))
            index += 3
        else:
            return None
    return found
