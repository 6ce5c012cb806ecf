"""`prove_motion` against dense samples of distances by coal, on motions of a UR5 among boxes."""

from pathlib import Path

import coal
import numpy as np
import numpy.typing as npt
import pytest
import urdf_reader
from clearance_reference import Body, Reference

import pyplatewash as pw

URDF = Path(__file__).resolve().parents[2] / "crates" / "kinematics" / "tests" / "fixtures" / "ur5_lengths.urdf"
JOINTS = ["shoulder_pan", "shoulder_lift", "elbow", "wrist_1_joint", "wrist_2_joint", "wrist_3_joint"]
START = np.array([0.0, -1.4, 1.2, -1.4, -1.5, 0.0])
#: Required clearance [m].
CLEARANCE_M = 0.005
#: Time between two points [s], and samples of it.
STEP_S, SAMPLES = 2.0, 60

Floats = npt.NDArray[np.float64]


def between(rows: list[Floats], i: int, u: float) -> Floats:
    """Joint positions at the share u of the way from point i to the next one: on a line, cubic or quintic, for as many rows of derivatives."""
    count = len(rows)
    powers = np.arange(2 * count)
    # Each derivative of Σ cₖuᵏ at u = 0 and u = 1, in shares of the step.
    conditions, values = [], []
    for at in (0, 1):
        for order, row in enumerate(rows):
            factors = np.prod([powers - k for k in range(order)], axis=0) if order else np.ones(2 * count)
            conditions.append(factors * (powers >= order) * float(at) ** np.maximum(powers - order, 0))
            values.append(STEP_S**order * row[i + at])
    coefficients = np.linalg.solve(np.array(conditions), np.array(values))
    return u**powers @ coefficients


@pytest.mark.parametrize("seed", range(8))
def test_proves_a_motion_only_where_dense_distances_allow_it(seed: int) -> None:
    rng = np.random.default_rng(seed)
    robot, tree = pw.Robot.load(str(URDF)), urdf_reader.Tree(URDF)
    arm = Reference({link: Body(link, tuple(parts)) for link, parts in urdf_reader.shapes(URDF).items() if parts})
    request, result = coal.DistanceRequest(), coal.DistanceResult()
    for derivatives in (0, 1, 2, 2):
        obstacles, boxes = [], {}
        for name in ("near", "far"):
            angle, radius = rng.uniform(-np.pi, np.pi), rng.uniform(0.35, 0.7)
            at = [radius * np.cos(angle), radius * np.sin(angle), rng.uniform(0.1, 0.7)]
            size = rng.uniform(0.03, 0.12, 3).tolist()
            obstacles.append({"name": name, "shape": "box", "size_m": size, "at_m": at})
            boxes[name] = coal.Box(*size), coal.Transform3s(np.eye(3), np.array(at))
        q = np.cumsum(np.vstack([START + rng.uniform(-0.5, 0.5, 6), rng.uniform(-0.5, 0.5, (3, 6))]), axis=0)
        rows = [q, *(rng.uniform(-0.5, 0.5, (4, 6)) for _ in range(derivatives))]
        proof = pw.prove_motion(q, STEP_S * np.arange(4.0), *rows[1:], robot=robot, obstacles=obstacles, clearance_m=CLEARANCE_M)
        assert proof.interpolation == ["linear", "cubic", "quintic"][derivatives]
        least = np.inf
        for i in range(3):
            for u in np.linspace(0.0, 1.0, SAMPLES):
                arm.move(tree.poses(dict(zip(JOINTS, between(rows, i, u)))))
                for a, b in (bound["pair"] for bound in proof.clearance):
                    if b not in boxes:
                        least = min(least, arm.distance(a, b))
                        continue
                    for shape, pose in zip(arm.geometries[a], arm.transforms[a]):
                        result.clear()
                        least = min(least, coal.distance(shape, pose, *boxes[b], request, result))
        (clearance,) = (rule for rule in proof.rules if rule["requirement"] == "clearance")
        if clearance["status"] == "proved":
            assert least >= CLEARANCE_M - 1e-5
        else:
            assert least <= CLEARANCE_M + 1e-4


def test_refuses_degrees_and_times_that_do_not_increase() -> None:
    q = np.vstack([START, START + 0.1])
    with pytest.raises(pw.PlatewashError, match="degrees"):
        pw.prove_motion(np.degrees(q), robot=pw.Robot.load(str(URDF)))
    with pytest.raises(pw.PlatewashError):
        pw.prove_motion(q, [1.0, 1.0], robot=pw.Robot.load(str(URDF)))
