"""Time-optimal timing, ours against toppra's: the same path, grid and limits of the joints, in turns.

    cargo build --release --manifest-path benches/peers/Cargo.toml --bin timed_path
    target/python/bin/python benches/peers/timing_against_toppra.py [--rounds 21]

Each round times every path once with both, from its samples to the motion. toppra constrains accelerations at its grid
points and exceeds them between; `exceeds` says by what. `lawful` is the duration of its motion stretched until it holds
them.
"""

import argparse
import json
import statistics
import subprocess
import time
import warnings
from pathlib import Path

import numpy as np
import toppra
import toppra.algorithm
import toppra.constraint
from scipy.interpolate import CubicSpline

ROOT = Path(__file__).resolve().parents[2]
KEYS = ["u", "q_rad", "velocity_rad_s", "acceleration_rad_s2"]


def sampled(case, points: int) -> dict:
    """The case with each piece of its path in equal parts, about so many samples in all; the spline through them is the same."""
    u = np.array(case["u"])
    parts = max(1, round(points / len(u)))
    places = np.arange((len(u) - 1) * parts + 1) / parts
    u = np.interp(places, np.arange(len(u)), u)
    path = CubicSpline(case["u"], case["q_rad"], bc_type="not-a-knot")
    return {**case, "u": u.tolist(), "q_rad": path(u).tolist()}


class Ours:
    def __init__(self, case):
        binary = ROOT / "benches" / "peers" / "target" / "release" / "timed_path"
        self.process = subprocess.Popen([binary], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.process.stdin.write(json.dumps({key: case[key] for key in KEYS}) + "\n")

    def __call__(self):
        self.process.stdin.write("again\n")
        self.process.stdin.flush()
        spent, duration = self.process.stdout.readline().split()
        return float(spent) * 1e-9, float(duration)


class Toppra:
    def __init__(self, case):
        self.u, self.q, velocity, acceleration = (np.array(case[key]) for key in KEYS)
        self.velocity = np.column_stack([-velocity, velocity])
        self.acceleration = np.column_stack([-acceleration, acceleration])

    def motion(self):
        path = toppra.SplineInterpolator(self.u, self.q, bc_type="not-a-knot")
        limits = [
            toppra.constraint.JointVelocityConstraint(self.velocity),
            toppra.constraint.JointAccelerationConstraint(
                self.acceleration, discretization_scheme=toppra.constraint.DiscretizationType.Interpolation
            ),
        ]
        solver = toppra.algorithm.TOPPRA(limits, path, gridpoints=self.u, parametrizer="ParametrizeConstAccel")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return solver.compute_trajectory(0, 0)

    def __call__(self):
        start = time.perf_counter()
        motion = self.motion()
        return time.perf_counter() - start, motion.duration

    def exceeds(self):
        motion = self.motion()
        times = np.linspace(0, motion.duration, 200_000)
        return (np.abs(motion(times, 2)) / self.acceleration[:, 1]).max()


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=21)
    rounds = parser.parse_args().rounds
    toppra.setup_logging("ERROR")
    cases = json.loads((ROOT / "crates/planner/tests/fixtures/timing.json").read_text(encoding="utf-8"))
    print("| path | samples | ours ms | toppra ms | ours / toppra | ours s | toppra s | exceeds | lawful s |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |")
    paths = (case for case in cases if case["tip"] is None)
    for case in (sampled(path, points) for path in paths for points in (500, 1000, 4000)):
        ours, theirs = Ours(case), Toppra(case)
        ours(), theirs()
        spent = [(ours(), theirs()) for _ in range(rounds)]
        (_, duration), (_, other) = spent[0]
        mine, its, ratio = (
            statistics.median(values)
            for values in zip(*((a[0] * 1e3, b[0] * 1e3, a[0] / b[0]) for a, b in spent))
        )
        exceeds = theirs.exceeds()
        lawful = other * np.sqrt(max(exceeds, 1.0))
        print(
            f"| {case['name']} | {len(case['u'])} | {mine:.2f} | {its:.1f} | {ratio:.3f} "
            f"| {duration:.4f} | {other:.4f} | {exceeds:.3f} | {lawful:.4f} |"
        )


if __name__ == "__main__":
    main()
