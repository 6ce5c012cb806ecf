"""Trajectories of another planner, proved, against dense distances and against checks at samples.

    target/python/bin/python -m pip install ompl==2.0.1 toppra==0.6.10 coal==3.0.3 pin==4.1.0 python-fcl
    target/python/bin/python benches/peers/trajectories_against_coal.py [--count 200] [--seed 1] [--continuous 20] [--json FILE]

The wheel must be installed there (`cargo xtask test --only python` does that). OMPL's time is limited, so that a slower machine finds other paths.

Two arms, the IRB 120 and one with the lengths of a UR5, among ten boxes, cylinders and spheres. OMPL's RRT-Connect plans in joint space
and shortens the path; toppra times a cubic spline through it; it is written as MoveIt writes it: positions, speeds and accelerations every
0.1 s, between which the controller draws quintics. Both sides have the same shapes, out of the same files, and the same pairs.

For each trajectory: the least distance by coal (1 kHz, then refined about each minimum that may be the least), and what is proved for the stated
clearance, for one that is 0.1 mm smaller than that distance (it must be proved), and for one that is 1 µm larger (it must not). Then
whether a check at samples passes where the motion collides: no more than 0.05 rad apart, or 1 % of the extent of the joint space.
"""

import argparse
import json
import statistics
import time
from pathlib import Path

import coal
import fcl
import numpy as np
import pinocchio as pin
import toppra
import toppra.algorithm
import toppra.constraint
from ompl import base, geometric, util

import pyplatewash as pw

ROOT = Path(__file__).resolve().parents[2]
ARMS = {
    "irb120": (ROOT / "urdf/irb120.urdf", ROOT / "urdf/irb120.srdf"),
    "ur5_lengths": (ROOT / "crates/kinematics/tests/fixtures/ur5_lengths.urdf", None),
}
AXES = 6
#: Stated clearance, and the error that is allowed [m].
CLEARANCE_M, ALLOWED_M = 0.005, 1e-4
#: Obstacles of a cell.
OBSTACLES = 10
#: Time between two points of a trajectory [s], and between two samples of the dense check.
POINT_S, DENSE_S = 0.1, 1e-3
#: Samples of the dense check between two at which all pairs are measured, how far from a joint's axis the arm reaches at most [m], and the
#: distance above the least one up to which a minimum is refined [m].
COARSE, REACH_M, NEAR_M = 16, 1.3, 2e-3
#: Steps of the checks at samples: for each joint [rad], and as a share of the space's extent, which is how OMPL states them.
STEP_RAD, SHARE = 0.05, 0.01
#: Greatest joint accelerations [rad/s²].
ACCELERATION = np.full(AXES, 4.0)


class Cell:
    """An arm among obstacles, as Pinocchio and coal see it."""

    def __init__(self, arm: str, rng: np.random.Generator):
        urdf, srdf = ARMS[arm]
        self.arm = arm
        self.robot = pw.Robot.load(str(urdf), srdf=str(srdf) if srdf else None)
        self.model = pin.buildModelFromUrdf(str(urdf))
        self.geometry = pin.buildGeomFromUrdf(self.model, str(urdf), pin.GeometryType.COLLISION)
        self.links: dict[str, list[int]] = {}
        for index, thing in enumerate(self.geometry.geometryObjects):
            self.links.setdefault(thing.name.rsplit("_", 1)[0], []).append(index)
        self.obstacles = [self.obstacle(k, rng) for k in range(OBSTACLES)]
        for obstacle in self.obstacles:
            self.place(obstacle)
        # The pairs are those of the proof.
        rest = pw.prove_motion(np.zeros((2, AXES)), robot=self.robot, obstacles=self.obstacles)
        self.pairs = [tuple(bound["pair"]) for bound in rest.clearance]
        for a, b in self.pairs:
            for one in self.links[a]:
                for two in self.links[b]:
                    self.geometry.addCollisionPair(pin.CollisionPair(one, two))
        self.data, self.geometry_data = self.model.createData(), self.geometry.createData()
        for request in self.geometry_data.distanceRequests:
            request.gjk_tolerance = request.epa_tolerance = 1e-9
        self.lower, self.upper = self.model.lowerPositionLimit, self.model.upperPositionLimit
        self.velocity = self.model.velocityLimit

    def obstacle(self, k: int, rng: np.random.Generator) -> dict:
        angle, radius = rng.uniform(-np.pi, np.pi), rng.uniform(0.25, 0.6)
        at = [radius * np.cos(angle), radius * np.sin(angle), rng.uniform(0.0, 0.9)]
        rpy = rng.uniform(-180.0, 180.0, 3)
        thing = {"name": f"obstacle {k}", "at_m": at, "rpy_deg": rpy.tolist()}
        match k % 3:
            case 0:
                return thing | {"shape": "box", "size_m": rng.uniform(0.02, 0.35, 3).tolist()}
            case 1:
                size = {"radius_m": rng.uniform(0.005, 0.05), "length_m": rng.uniform(0.1, 0.5)}
                return thing | {"shape": "cylinder"} | size
            case _:
                return thing | {"shape": "sphere", "radius_m": rng.uniform(0.02, 0.1)}

    def place(self, obstacle: dict) -> None:
        match obstacle:
            case {"shape": "box", "size_m": size}:
                shape = coal.Box(*size)
            case {"shape": "cylinder", "radius_m": radius, "length_m": length}:
                shape = coal.Cylinder(radius, length)
            case {"radius_m": radius}:
                shape = coal.Sphere(radius)
        turn = pin.rpy.rpyToMatrix(*np.radians(obstacle["rpy_deg"]))
        placement = pin.SE3(turn, np.array(obstacle["at_m"]))
        thing = pin.GeometryObject(obstacle["name"], 0, 0, placement, shape)
        self.links[obstacle["name"]] = [self.geometry.addGeometryObject(thing)]

    def distances(self, q: np.ndarray, pairs=None) -> np.ndarray:
        """Distances of all pairs of shapes, or of some [m]; negative where two overlap, by a depth that coal does not always find."""
        if pairs is None:
            pin.computeDistances(self.model, self.data, self.geometry, self.geometry_data, q)
            return np.array([result.min_distance for result in self.geometry_data.distanceResults])
        pin.updateGeometryPlacements(self.model, self.data, self.geometry, self.geometry_data, q)
        return np.array([pin.computeDistance(self.geometry, self.geometry_data, int(k)).min_distance for k in pairs])

    def distance(self, q: np.ndarray) -> float:
        """Least distance over all pairs [m]."""
        return float(self.distances(q).min())

    def collides(self, q: np.ndarray) -> bool:
        return pin.computeCollisions(self.model, self.data, self.geometry, self.geometry_data, q, True)


def plan(cell: Cell, rng: np.random.Generator) -> np.ndarray | None:
    """A path between two random configurations that are clear, with something between them, by RRT-Connect; None where none is found."""
    ends: list[np.ndarray] = []
    for _ in range(2000):
        q = rng.uniform(np.maximum(cell.lower, -np.pi), np.minimum(cell.upper, np.pi))
        if cell.distance(q) < CLEARANCE_M:
            continue
        if ends and any(cell.collides(ends[0] + share * (q - ends[0])) for share in np.linspace(0.0, 1.0, 50)):
            ends.append(q)
            break
        ends = ends or [q]
    if len(ends) < 2:
        return None
    space = base.RealVectorStateSpace(AXES)
    bounds = base.RealVectorBounds(AXES)
    for joint in range(AXES):
        bounds.setLow(joint, float(cell.lower[joint]))
        bounds.setHigh(joint, float(cell.upper[joint]))
    space.setBounds(bounds)
    setup = geometric.SimpleSetup(space)
    setup.setStateValidityChecker(lambda state: not cell.collides(np.array([state[k] for k in range(AXES)])))
    setup.getSpaceInformation().setStateValidityCheckingResolution(SHARE)
    start, goal = space.allocState(), space.allocState()
    for joint in range(AXES):
        start[joint], goal[joint] = float(ends[0][joint]), float(ends[1][joint])
    setup.setStartAndGoalStates(start, goal)
    setup.setPlanner(geometric.RRTConnect(setup.getSpaceInformation()))
    if setup.solve(1.0) != base.PlannerStatus.EXACT_SOLUTION:
        return None
    setup.simplifySolution(0.5)
    path = setup.getSolutionPath()
    path.interpolate(max(path.getStateCount(), 2 + int(path.length() / 0.25)))
    return np.array([[state[k] for k in range(AXES)] for state in path.getStates()])


def timed(cell: Cell, path: np.ndarray):
    """Times, positions, speeds and accelerations of points on a spline through the path, as fast as the limits allow but for 5 %."""
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))])
    keep = np.concatenate([[True], np.diff(along) > 1e-9])
    spline = toppra.SplineInterpolator(along[keep], path[keep])
    velocity, acceleration = 0.95 * cell.velocity, 0.95 * ACCELERATION
    limits = [
        toppra.constraint.JointVelocityConstraint(np.column_stack([-velocity, velocity])),
        toppra.constraint.JointAccelerationConstraint(np.column_stack([-acceleration, acceleration])),
    ]
    motion = toppra.algorithm.TOPPRA(limits, spline, parametrizer="ParametrizeConstAccel").compute_trajectory(0, 0)
    if motion is None:
        return None
    t = np.linspace(0.0, motion.duration, 1 + max(1, int(np.ceil(motion.duration / POINT_S))))
    return t, motion(t), motion(t, 1), motion(t, 2)


class Quintic:
    """The motion that a controller makes of points."""

    def __init__(self, t, q, qd, qdd):
        self.t, h = t, np.diff(t)[:, None]
        dq, v0, v1, a0, a1 = np.diff(q, axis=0), qd[:-1], qd[1:], qdd[:-1], qdd[1:]
        self.c = np.stack(
            [
                q[:-1],
                v0,
                a0 / 2,
                (20 * dq - (8 * v1 + 12 * v0) * h - (3 * a0 - a1) * h**2) / (2 * h**3),
                (-30 * dq + (14 * v1 + 16 * v0) * h + (3 * a0 - 2 * a1) * h**2) / (2 * h**4),
                (12 * dq - 6 * (v1 + v0) * h - (a0 - a1) * h**2) / (2 * h**5),
            ]
        )

    def __call__(self, t: float) -> np.ndarray:
        k = min(max(int(np.searchsorted(self.t, t, side="right")) - 1, 0), len(self.t) - 2)
        u = t - self.t[k]
        return sum(c * u**power for power, c in enumerate(self.c[:, k]))


def dense_least(cell: Cell, motion: Quintic) -> tuple[float, float]:
    """Least distance over the motion [m], and its time [s]: at 1 kHz, refined by a golden section about each low minimum.

    At a sample only those pairs are measured that may be nearest there: a pair's distance changes by no more than REACH_M times the sum of
    the joints' speeds since the coarse sample before or after.
    """
    count = COARSE * max(1, int(np.ceil(motion.t[-1] / (COARSE * DENSE_S))))
    times = np.linspace(0.0, motion.t[-1], 1 + count)
    q = np.array([motion(t) for t in times])
    change = REACH_M * np.abs(np.diff(q, axis=0)).sum(axis=1).max() * COARSE
    coarse = np.array([cell.distances(q[k]) for k in range(0, count + 1, COARSE)])
    distances = np.full(count + 1, np.inf)
    distances[::COARSE] = coarse.min(axis=1)
    for k in np.setdiff1d(np.arange(count + 1), np.arange(0, count + 1, COARSE)):
        nearest = np.minimum(coarse[k // COARSE], coarse[k // COARSE + 1])
        near = np.flatnonzero(nearest - change < distances.min() + NEAR_M)
        distances[k] = cell.distances(q[k], near).min() if len(near) else np.inf
    least, at = distances.min(), times[distances.argmin()]
    minima = [k for k in range(1, count) if distances[k] <= min(distances[k - 1], distances[k + 1])]
    for k in (k for k in minima if distances[k] < least + NEAR_M):
        nearest = np.minimum(coarse[(k - 1) // COARSE], coarse[min(k // COARSE + 1, len(coarse) - 1)])
        near = np.flatnonzero(nearest - change < distances[k])

        def distance(t: float) -> float:
            return float(cell.distances(motion(t), near).min())

        low, high = times[k - 1], times[k + 1]
        for _ in range(30):
            a, b = high - 0.618034 * (high - low), low + 0.618034 * (high - low)
            low, high = (low, b) if distance(a) < distance(b) else (a, high)
        found = distance(0.5 * (low + high))
        if found < least:
            least, at = found, 0.5 * (low + high)
    return float(least), float(at)


def samples(cell: Cell, motion: Quintic, by_share: bool) -> list[np.ndarray]:
    """Every point, and as many between as keep each joint's step within 0.05 rad, or that of all joints within 1 % of the space's extent."""
    extent = float(np.linalg.norm(cell.upper - cell.lower))
    found = []
    for k in range(len(motion.t) - 1):
        step = np.abs(motion(motion.t[k + 1]) - motion(motion.t[k]))
        count = np.linalg.norm(step) / (SHARE * extent) if by_share else step.max() / STEP_RAD
        found += [motion(t) for t in np.linspace(motion.t[k], motion.t[k + 1], max(1, int(np.ceil(count))), endpoint=False)]
    return [*found, motion(motion.t[-1])]


class Continuous:
    """Continuous collision detection of FCL: each link from one point of the trajectory to the next, along a screw."""

    def __init__(self, cell: Cell):
        self.cell = cell
        self.objects = []
        for thing in cell.geometry.geometryObjects:
            shape = thing.geometry
            match shape:
                case coal.Box():
                    made = fcl.Box(*(2.0 * shape.halfSide))
                case coal.Cylinder():
                    made = fcl.Cylinder(shape.radius, 2.0 * shape.halfLength)
                case coal.Sphere():
                    made = fcl.Sphere(shape.radius)
                case coal.Capsule():
                    made = fcl.Capsule(shape.radius, 2.0 * shape.halfLength)
            self.objects.append(made)

    def placed(self, q: np.ndarray) -> list:
        cell = self.cell
        pin.updateGeometryPlacements(cell.model, cell.data, cell.geometry, cell.geometry_data, q)
        return [fcl.Transform(M.rotation, M.translation) for M in cell.geometry_data.oMg]

    def finds_collision(self, points: np.ndarray) -> bool:
        request = fcl.ContinuousCollisionRequest(
            ccd_motion_type=fcl.CCDMotionType.CCDM_SCREW, ccd_solver_type=fcl.CCDSolverType.CCDC_CONSERVATIVE_ADVANCEMENT
        )
        poses = [self.placed(q) for q in points]
        hit = False
        for before, after in zip(poses, poses[1:]):
            for pair in self.cell.geometry.collisionPairs:
                result = fcl.ContinuousCollisionResult()
                one = fcl.CollisionObject(self.objects[pair.first], before[pair.first])
                two = fcl.CollisionObject(self.objects[pair.second], before[pair.second])
                fcl.continuousCollide(one, after[pair.first], two, after[pair.second], request, result)
                hit |= result.is_collide
        return hit


def clearance_status(cell: Cell, points, clearance_m: float) -> str:
    t, q, *rates = points
    proof = pw.prove_motion(q, t, *rates, robot=cell.robot, obstacles=cell.obstacles, clearance_m=clearance_m)
    (rule,) = (rule for rule in proof.rules if rule["requirement"] == "clearance")
    return rule["status"]


def clock(work, repeats: int = 5) -> tuple[float, object]:
    """The least processor time of some repeats, over all threads [ms], and the answer."""
    times = []
    for _ in range(repeats):
        start = time.process_time()
        answer = work()
        times.append(1e3 * (time.process_time() - start))
    return min(times), answer


def judge(cell: Cell, name: str, points, with_continuous: bool) -> dict:
    motion = Quintic(*points)
    least, at = dense_least(cell, motion)
    prove_ms, status = clock(lambda: clearance_status(cell, points, CLEARANCE_M))
    step_ms, by_step = clock(lambda: any(cell.collides(q) for q in samples(cell, motion, by_share=False)))
    share_ms, by_share = clock(lambda: any(cell.collides(q) for q in samples(cell, motion, by_share=True)))
    row = {
        "name": name,
        "duration_s": float(points[0][-1]),
        "points": len(points[0]),
        "least_m": least,
        "at_s": at,
        "status": status,
        "prove_ms": prove_ms,
        "step_ms": step_ms,
        "share_ms": share_ms,
        "collides": least <= 0.0,
        "step_finds": by_step,
        "share_finds": by_share,
    }
    if with_continuous:
        row["continuous_ms"], row["continuous_finds"] = clock(lambda: Continuous(cell).finds_collision(points[1]), repeats=1)
    wrong = []
    if status == "proved" and least < CLEARANCE_M:
        wrong.append("proved too much")
    if status != "proved" and least > CLEARANCE_M + ALLOWED_M:
        wrong.append("proved too little")
    if least > ALLOWED_M:
        if clearance_status(cell, points, least - ALLOWED_M) != "proved":
            wrong.append("0.1 mm of room are not enough")
        if clearance_status(cell, points, least + 1e-6) == "proved":
            wrong.append("proved 1 µm more than there is")
    return row | {"wrong": wrong}


def print_table(rows: list[dict]) -> None:
    columns = [("prove_ms", "proof"), ("step_ms", "0.05 rad"), ("share_ms", "1 % of the extent"), ("continuous_ms", "FCL, continuous")]
    print(f"{'processor time':<22}{'median':>10}{'95 %':>10}{'most':>10}  [ms]")
    for key, word in columns:
        found = sorted(row[key] for row in rows if key in row)
        if found:
            print(f"{word:<22}{statistics.median(found):>10.2f}{found[int(0.95 * (len(found) - 1))]:>10.2f}{found[-1]:>10.2f}")


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--continuous", type=int, default=20, help="trajectories that FCL checks, too")
    parser.add_argument("--json", type=Path)
    arguments = parser.parse_args()
    util.setLogLevel(util.LogLevel.LOG_ERROR)
    util.RNG.setSeed(arguments.seed)
    rows: list[dict] = []
    seed = arguments.seed
    while len(rows) < arguments.count:
        rng = np.random.default_rng(seed)
        arm = list(ARMS)[seed % len(ARMS)]
        cell = Cell(arm, rng)
        for k in range(4):
            path = plan(cell, rng)
            points = None if path is None else timed(cell, path)
            if points is not None and len(rows) < arguments.count:
                rows.append(judge(cell, f"{arm}/{seed}/{k}", points, len(rows) < arguments.continuous))
                row = rows[-1]
                if arguments.json:
                    arguments.json.write_text(json.dumps(rows, indent=1))
                print(f"{row['name']:<18} {row['duration_s']:6.2f} s {1e3 * row['least_m']:9.3f} mm {row['status']:<11}{row['prove_ms']:8.2f} ms {row['wrong']}", flush=True)
        seed += 1
    wrong = [row for row in rows if row["wrong"]]
    missed = {way: [row for row in rows if row["collides"] and not row[f"{way}_finds"]] for way in ("step", "share")}
    print(f"\n{len(rows)} trajectories, {sum(row['collides'] for row in rows)} collide, {sum(row['status'] == 'proved' for row in rows)} proved, {len(wrong)} wrong")
    for way, words in (("step", "0.05 rad"), ("share", "1 % of the extent")):
        print(f"pass at samples every {words} and collide between: {len(missed[way])}")
        for row in missed[way]:
            print(f"  {row['name']}: {1e3 * row['least_m']:.3f} mm at {row['at_s']:.4f} s, {row['status']}")
    print_table(rows)
    raise SystemExit(1 if wrong else 0)


if __name__ == "__main__":
    main()
