"""Transits past walls, ours against OMPL's RRT-Connect: how many are solved, and how long it takes.

    python3 -m venv target/ompl && target/ompl/bin/pip install ompl==2.0.1 pin==4.1.0
    cargo run --release --manifest-path benches/peers/Cargo.toml --bin wall_transits -- 100 > target/transits.json
    target/ompl/bin/python benches/peers/transits_against_ompl.py target/transits.json [--limit-s 1.0] [--seed 1]

RRT-Connect gets the tops of our transits as its ends, the same joints and limits, the same bodies and pairs with the clearance asked
for, and the limit of time. A configuration is checked by one call of Pinocchio and coal in C++, which OMPL makes through Python; a
straight line by configurations of which no joint moves more than 0.05 rad from one to the next. Its answer is those lines: not smooth,
not timed, not proved. Ours keeps 1 mm more, is the whole motion from plate to plate, and is proved; both of that is in its time.
"""

import argparse
import json
import statistics
import time
from pathlib import Path

import coal
import numpy as np
import pinocchio as pin
from ompl import base, geometric, util

AXES = 6
# Steps of a line, for each joint alone [rad].
STEP_RAD = 0.05


def placed(data) -> pin.SE3:
    return pin.SE3(np.array(data["rotation"]), np.array(data["position_m"]))


def shape(data):
    (kind, sizes), = data["shape"].items()
    match kind:
        case "box":
            return coal.Box(*(2.0 * half for half in sizes["half_m"]))
        case "cylinder":
            return coal.Cylinder(sizes["radius_m"], 2.0 * sizes["half_length_m"])
        case "capsule":
            return coal.Capsule(sizes["radius_m"], 2.0 * sizes["half_length_m"])
        case "sphere":
            return coal.Sphere(sizes["radius_m"])
        case "hull":
            points = coal.StdVec_Vec3s()
            points.extend(np.array(point) for point in sizes["points"])
            return coal.Convex.convexHull(points, False, None)
    raise SystemExit(f"a shape of an unknown kind: {kind}")


class Cell:
    """The arm among its surroundings, as Pinocchio and coal see it."""

    def __init__(self, scene):
        self.model = pin.Model()
        joint = 0
        for k, at in enumerate(scene["joints"]):
            joint = self.model.addJoint(joint, pin.JointModelRZ(), placed(at), f"joint {k + 1}")
        self.limits = np.array(scene["limits_rad"])
        self.geometry = pin.GeometryModel()
        objects, grown = {}, {}
        for body in scene["bodies"]:
            objects[body["name"]] = [self.add(body, k, shape(s), placed(s)) for k, s in enumerate(body["shapes"])]
            if "half_space" in body:
                half = coal.Halfspace(np.array([0.0, 0.0, 1.0]), 0.0)
                objects[body["name"]].append(self.add(body, "plane", half, placed(body["half_space"])))
            grown[body["name"]] = body["grown_m"]
        margins = []
        for a, b in scene["pairs"]:
            for first in objects[a]:
                for second in objects[b]:
                    self.geometry.addCollisionPair(pin.CollisionPair(first, second))
                    margins.append(scene["clearance_m"] + grown[a] + grown[b])
        self.data, self.geometry_data = self.model.createData(), self.geometry.createData()
        for request, margin in zip(self.geometry_data.collisionRequests, margins):
            request.security_margin = margin
        self.asked = 0

    def add(self, body, name, shape, at) -> int:
        name = f"{body['name']}: {name}"
        return self.geometry.addGeometryObject(pin.GeometryObject(name, body["by"], at, shape))

    def is_free(self, q) -> bool:
        self.asked += 1
        return not pin.computeCollisions(self.model, self.data, self.geometry, self.geometry_data, q, True)

    def is_line_free(self, ends) -> bool:
        first, last = ends
        count = int(np.ceil(np.abs(last - first).max() / STEP_RAD))
        return all(self.is_free(first + (last - first) * (k / count)) for k in range(count + 1))


def rrt_connect(cell, ends, limit_s):
    """Seconds, if it finds lines from one end to the other within the limit; otherwise nothing."""
    space = base.RealVectorStateSpace(AXES)
    bounds = base.RealVectorBounds(AXES)
    for joint, (low, high) in enumerate(cell.limits.T):
        bounds.setLow(joint, low)
        bounds.setHigh(joint, high)
    space.setBounds(bounds)
    setup = geometric.SimpleSetup(space)
    q = np.zeros(AXES)

    def is_valid(state):
        for joint in range(AXES):
            q[joint] = state[joint]
        return cell.is_free(q)

    setup.setStateValidityChecker(is_valid)
    information = setup.getSpaceInformation()
    # As a share of the diagonal of the limits.
    information.setStateValidityCheckingResolution(STEP_RAD / space.getMaximumExtent())
    start, goal = space.allocState(), space.allocState()
    for state, end in ((start, ends[0]), (goal, ends[1])):
        for joint in range(AXES):
            state[joint] = end[joint]
    setup.setStartAndGoalStates(start, goal)
    setup.setPlanner(geometric.RRTConnect(information))
    setup.setup()
    begun = time.perf_counter()
    setup.solve(limit_s)
    spent = time.perf_counter() - begun
    return spent if setup.haveExactSolutionPath() else None


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("transits", type=Path)
    parser.add_argument("--limit-s", type=float, default=1.0)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    util.setLogLevel(util.LOG_ERROR)
    util.RNG.setSeed(options.seed)
    cells = json.loads(options.transits.read_text())
    ours, theirs, counts, calls, blocked, straight = [], [], {}, [0, 0.0], 0, 0
    for data in cells:
        cell = Cell(data["scene"])
        for transit in data["transits"]:
            ends = np.array(transit["tops_rad"])
            blocked += not all(cell.is_free(end) for end in ends)
            straight += cell.is_line_free(ends)
            cell.asked, begun = 0, time.perf_counter()
            spent = rrt_connect(cell, ends, options.limit_s)
            calls[0] += cell.asked
            calls[1] += time.perf_counter() - begun
            if transit["proved"]:
                ours.append(transit["planning_ms"] + transit["proving_ms"])
            if spent is not None:
                theirs.append(1e3 * spent)
            found = (transit["proved"], spent is not None)
            counts[found] = counts.get(found, 0) + 1
            if found[0] != found[1]:
                print(f"wall {data['wall']}, {transit['from']} to {transit['to']}: ours {found[0]}, theirs {found[1]}")
    total = sum(counts.values())
    print("| who | transits | solved | median ms, of those solved | slowest ms |")
    print("| --- | ---: | ---: | ---: | ---: |")
    for name, spent in (("platewash, planned and proved", ours), ("RRT-Connect, found", theirs)):
        print(f"| {name} | {total} | {len(spent)} | {statistics.median(spent):.1f} | {max(spent):.1f} |")
    print(f"\n{straight} transits of which a straight line of the joints is free")
    print(f"{blocked} transits with an end that coal finds too near something")
    print(f"a configuration asked of coal: {1e6 * calls[1] / calls[0]:.0f} µs, with OMPL's own work")


if __name__ == "__main__":
    main()
