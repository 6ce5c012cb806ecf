"""`platewash fk --json` states the same clearances to obstacles of every kind as coal finds: boxes, cylinders, capsules, spheres, half-spaces, meshes.

    python tests/python/test_cells_against_coal.py [distances]      at least so many distances, 100000 by default

Distances agree within the tolerance; those to a mesh in parts, which enclose it, are never greater, nor less than to its hull.
"""

import json
import os
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import coal
import numpy as np

import urdf_reader
from clearance_reference import Plates, Reference, bodies
from clearances_said import TOLERANCE_M, TOOL, said

NO_PLATES = Plates(0.145, 0.03, 0.02, ())
SIGNS = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, -1).T
# Corners of a box by SIGNS, as faces of four.
FACES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


@dataclass
class Obstacle:
    """An obstacle as a file states it, and as coal has it: placed geometries, or a plane by a point and a normal."""

    name: str
    keys: dict
    geometries: list = field(default_factory=list)
    plane: tuple | None = None
    margin_m: float = 0.0
    hull: list = field(default_factory=list)


def rpy(angles_deg) -> np.ndarray:
    """Rz(yaw) Ry(pitch) Rx(roll)."""
    (sr, sp, sy), (cr, cp, cy) = np.sin(np.radians(angles_deg)), np.cos(np.radians(angles_deg))
    x = np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    y = np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
    z = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
    return z @ y @ x


def obj(boxes, path: Path) -> None:
    """Boxes (middle, size) as an OBJ file."""
    lines, first = [], 1
    for middle, size in boxes:
        lines += [f"v {x!r} {y!r} {z!r}" for x, y, z in (SIGNS * size / 2 + middle).tolist()]
        lines += ["f " + " ".join(str(first + corner) for corner in face) for face in FACES]
        first += 8
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def scene(rng, folder: Path, index: int) -> list[Obstacle]:
    """One obstacle of each kind, anywhere about the arm."""

    def placed(margin=True):
        azimuth, out = rng.uniform(-np.pi, np.pi), rng.uniform(0.25, 0.9)
        at = [out * np.cos(azimuth), out * np.sin(azimuth), rng.uniform(0.0, 0.8)]
        keys = {"at_m": at, "rpy_deg": rng.uniform(-180, 180, 3).tolist()}
        if margin and rng.random() < 0.3:
            keys["margin_m"] = rng.uniform(0, 0.03)
        return keys, coal.Transform3s(rpy(keys["rpy_deg"]), np.array(at))

    def size(count):
        return rng.uniform(0.02, 0.25, count).tolist()

    everything = []

    def add(kind, keys, sizes, geometries=(), **more):
        name = f"{kind} {index}"
        stated = {"name": name, "shape": kind.split()[0], **keys, **sizes}
        everything.append(Obstacle(name, stated, list(geometries), margin_m=keys.get("margin_m", 0.0), **more))

    keys, at = placed()
    edges = size(3)
    add("box", keys, {"size_m": edges}, [(coal.Box(*edges), at)])
    for kind, geometry in (("cylinder", coal.Cylinder), ("capsule", coal.Capsule)):
        keys, at = placed()
        radius, length = size(2)
        add(kind, keys, {"radius_m": radius, "length_m": length}, [(geometry(radius, length), at)])
    keys, at = placed()
    (radius,) = size(1)
    add("sphere", keys, {"radius_m": radius}, [(coal.Sphere(radius), at)])
    keys, at = placed()
    add("half_space", keys, {}, plane=(np.array(keys["at_m"]), rpy(keys["rpy_deg"])[:, 2]))
    # The hull of a box that is a mesh, mirrored; an angle of two boxes in parts.
    keys, at = placed()
    edges = np.array(size(3))
    obj([(np.zeros(3), edges)], folder / f"box {index}.obj")
    mesh = {"mesh": f"box {index}.obj", "mesh_scale": [1.0, -1.0, 1.0]}
    add("mesh hull", keys, mesh, [(coal.Box(*edges), at)])
    keys, at = placed()
    boxes = [(np.array([0.1, 0, 0]), np.array([0.22, 0.03, 0.1])), (np.array([0, 0.1, 0]), np.array([0.03, 0.22, 0.1]))]
    obj(boxes, folder / f"angle {index}.obj")
    parts = [(coal.Box(*edges), at * coal.Transform3s(np.eye(3), middle)) for middle, edges in boxes]
    around = coal.Transform3s(np.eye(3), np.array([0.0975, 0.0975, 0]))
    hull = [(coal.Box(0.225, 0.225, 0.1), at * around)]
    add("mesh parts", keys, {"mesh": f"angle {index}.obj", "mesh_parts": "decomposed"}, parts, hull=hull)
    return everything


def sections(obstacles: list[Obstacle]) -> str:
    def value(v):
        return json.dumps(v)

    tables = ("[[obstacle]]\n" + "".join(f"{k} = {value(v)}\n" for k, v in o.keys.items()) for o in obstacles)
    return "[layout]\npositions_m = [[5, 5]]\n" + "".join(tables)


def support(shape, T, direction) -> float:
    """How far a placed primitive reaches along a unit direction."""
    along = T[:3, :3].T @ direction
    own = {
        "box": lambda x, y, z: np.abs(along) @ np.array([x, y, z]) / 2,
        "cylinder": lambda r, length: abs(along[2]) * length / 2 + r * np.hypot(along[0], along[1]),
        "sphere": lambda r: r,
    }[shape.kind](*shape.size)
    return T[:3, 3] @ direction + own


class Cell:
    """Distances of the arm's and tool's bodies to obstacles by coal."""

    def __init__(self, urdf: Path, obstacles: list[Obstacle]):
        self.reference = Reference(bodies(urdf, TOOL, NO_PLATES))
        self.obstacles = {o.name: o for o in obstacles}
        self.request, self.result = coal.DistanceRequest(), coal.DistanceResult()

    def least(self, body: str, geometries) -> float:
        least = np.inf
        own = zip(self.reference.geometries[body], self.reference.transforms[body])
        for one, T_one in own:
            for two, T_two in geometries:
                self.result.clear()
                least = min(least, coal.distance(one, T_one, two, T_two, self.request, self.result))
        return least

    def distances(self, body: str, obstacle: str) -> tuple[float, float]:
        """What the distance is at least and at most."""
        o = self.obstacles[obstacle]
        if o.plane:
            point, normal = o.plane
            reference = self.reference
            shapes = zip(reference.bodies[body].shapes, reference.placed[body])
            height = min(-support(shape, T, -normal) for shape, T in shapes) - point @ normal
            return height - o.margin_m, height - o.margin_m
        most = self.least(body, o.geometries) - o.margin_m
        return (self.least(body, o.hull) - o.margin_m if o.hull else most), most


def compared(platewash: Path, urdf: Path, folder: Path, configurations, seed: int) -> tuple[int, list[str], float]:
    """How many distances were compared, those that are wrong, the greatest difference where neither overlaps."""
    rng = np.random.default_rng(seed)
    obstacles = scene(rng, folder, seed)
    cell, tree = Cell(urdf, obstacles), urdf_reader.Tree(urdf)
    names = [joint.name for joint in tree.chain("link_6")]
    report = said(platewash, folder, TOOL, sections(obstacles), configurations)
    count, wrong, worst = 0, [], 0.0
    for stated, q in zip(report["configurations"], configurations, strict=True):
        cell.reference.move(tree.poses(dict(zip(names, q))))
        for pair in stated["clearance"]:
            if pair["b"] not in cell.obstacles:
                continue
            count += 1
            found, (least, most) = pair["distance_m"], cell.distances(pair["a"], pair["b"])
            apart = least > TOLERANCE_M
            fits = least - TOLERANCE_M <= found <= most + TOLERANCE_M if apart else found <= max(most, 0.0) + TOLERANCE_M
            if apart and least == most:
                worst = max(worst, abs(found - most))
            if not (np.isfinite(found) and fits):
                wrong.append(f"seed {seed}, {q.tolist()}: {pair}, coal {least:.9f} to {most:.9f}")
    return count, wrong, worst


def several(platewash: Path, urdf: Path, folder: Path, configurations, first: int, cells: int):
    """Some cells; that an obstacle stands in the base is no matter to `fk`."""
    results = [compared(platewash, urdf, folder, configurations, first + k) for k in range(cells)]
    return sum(r[0] for r in results), [w for r in results for w in r[1]], max(r[2] for r in results)


def test_clearances_to_obstacles_agree_with_coal(platewash, irb120_urdf, random_configurations, tmp_path):
    count, wrong, _ = several(platewash, irb120_urdf, tmp_path, np.array(random_configurations)[:60], 1, 4)
    assert count > 8000
    assert not wrong, f"{len(wrong)} of {count} distances differ:\n" + "\n".join(wrong[:10])


def main(wanted: int) -> None:
    """By hand."""
    root = Path(__file__).resolve().parents[2]
    rng = np.random.default_rng(5)
    urdf = root / "urdf" / "irb120.urdf"
    limits = np.array([2.87, 1.91, 1.22, 2.79, 2.09, 6.98])
    platewash = Path(os.environ.get("PLATEWASH_BIN", root / "target" / "release" / "platewash"))
    total, worst, seed = 0, 0.0, 100
    with tempfile.TemporaryDirectory() as folder:
        while total < wanted:
            configurations = rng.uniform(-limits, limits, (250, 6))
            count, wrong, here = compared(platewash, urdf, Path(folder), configurations, seed)
            total, worst, seed = total + count, max(worst, here), seed + 1
            if wrong:
                sys.exit(f"{len(wrong)} of {count} distances differ:\n" + "\n".join(wrong[:10]))
    print(f"{total} distances agree, {worst:.3e} m apart at most")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 100_000)
