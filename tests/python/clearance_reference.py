"""Distances between the bodies of a scene by coal, from the URDF primitives, for comparison with ours.

Bodies: the links of the arm, "handle" and "sponge" (fixed to tool0), "plate 1", "plate 2", … and "floor", the
half-space z <= 0. A body is a union of convex primitives; a distance is the least over the pairs of primitives
(negative: penetration). Metres; poses are 4 x 4 matrices.
"""

from dataclasses import dataclass
from pathlib import Path

import coal
import numpy as np

import urdf_reader
from urdf_reader import Shape, pose

FLOOR = "floor"
WORLD = "base_link"


@dataclass(frozen=True)
class Tool:
    """A handle along +z of tool0, ending in a sponge: the free one, longer than the tool by what washing compresses it."""

    length_m: float
    radius_m: float
    sponge_radius_m: float
    sponge_height_m: float
    compression_m: float

    def shapes(self) -> dict[str, Shape]:
        handle = self.length_m - self.sponge_height_m
        free = self.sponge_height_m + self.compression_m
        sponge = handle + free / 2
        return {
            "handle": Shape("handle", "cylinder", (self.radius_m, handle), pose([0, 0, handle / 2])),
            "sponge": Shape("sponge", "cylinder", (self.sponge_radius_m, free), pose([0, 0, sponge])),
        }


@dataclass(frozen=True)
class Plates:
    """Equal upright cylinders whose top faces are `plate_height_m` above the floor."""

    plate_radius_m: float
    plate_height_m: float
    plate_thickness_m: float
    positions_m: tuple[tuple[float, float], ...]

    def shapes(self) -> list[Shape]:
        middle = self.plate_height_m - self.plate_thickness_m / 2
        size = (self.plate_radius_m, self.plate_thickness_m)
        return [
            Shape(f"plate {i}", "cylinder", size, pose([x, y, middle])) for i, (x, y) in enumerate(self.positions_m, 1)
        ]


@dataclass(frozen=True)
class Body:
    """Shapes that move with one link."""

    link: str
    shapes: tuple[Shape, ...]


def bodies(urdf: Path, tool: Tool, plates: Plates) -> dict[str, Body]:
    """Every body of the scene but the floor."""
    found = {link: Body(link, tuple(parts)) for link, parts in urdf_reader.shapes(urdf).items() if parts}
    found |= {name: Body("tool0", (part,)) for name, part in tool.shapes().items()}
    found |= {part.name: Body(WORLD, (part,)) for part in plates.shapes()}
    return found


def geometry(shape: Shape) -> coal.CollisionGeometry:
    match shape.kind, shape.size:
        case "box", (x, y, z):
            return coal.Box(x, y, z)
        case "cylinder", (radius, length):
            return coal.Cylinder(radius, length)
        case "sphere", (radius,):
            return coal.Sphere(radius)
    raise ValueError(f"{shape.name}: no {shape.kind} with {len(shape.size)} sizes")


def lowest(shape: Shape, T_world_shape: np.ndarray) -> float:
    """Least z of a placed primitive, in closed form."""
    height, up = T_world_shape[2, 3], T_world_shape[2, :3]
    match shape.kind, shape.size:
        case "box", size:
            return height - np.abs(up) @ np.array(size) / 2
        case "cylinder", (radius, length):
            return height - abs(up[2]) * length / 2 - radius * np.hypot(up[0], up[1])
        case "sphere", (radius,):
            return height - radius
    raise ValueError(f"{shape.name}: unknown {shape.kind}")


class Reference:
    """Distances in one scene, at one set of link poses after the other."""

    def __init__(self, everything: dict[str, Body]):
        self.bodies = everything
        self.geometries = {name: [geometry(s) for s in body.shapes] for name, body in everything.items()}
        self.request, self.result = coal.DistanceRequest(), coal.DistanceResult()
        self.placed: dict[str, list[np.ndarray]] = {}
        self.transforms: dict[str, list[coal.Transform3s]] = {}

    def move(self, link_poses: dict[str, np.ndarray]) -> None:
        """Places all bodies; the world is the root link, base_link."""
        for name, body in self.bodies.items():
            self.placed[name] = [link_poses[body.link] @ shape.T_link_shape for shape in body.shapes]
            self.transforms[name] = [coal.Transform3s(T[:3, :3], T[:3, 3]) for T in self.placed[name]]

    def floor(self, name: str) -> float:
        """Height of a body's lowest point [m]."""
        return min(lowest(shape, T) for shape, T in zip(self.bodies[name].shapes, self.placed[name]))

    def distance(self, a: str, b: str) -> float:
        """Least distance of two bodies [m]; negative when they overlap."""
        if FLOOR in (a, b):
            return self.floor(b if a == FLOOR else a)
        least = np.inf
        for one, T_one in zip(self.geometries[a], self.transforms[a]):
            for two, T_two in zip(self.geometries[b], self.transforms[b]):
                self.result.clear()
                least = min(least, coal.distance(one, T_one, two, T_two, self.request, self.result))
        return least
