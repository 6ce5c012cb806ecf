"""Dynamics and plant, ours against Pinocchio's and MuJoCo's: the same arm, tool and states, in turns.

    cargo build --release --manifest-path benches/peers/Cargo.toml --bin timed_dynamics
    target/python/bin/python benches/peers/dynamics_against_others.py [--rounds 41]

needs the wheel beside Pinocchio and MuJoCo, as the environment of the tests has them (`cargo xtask test --only python` makes it).
Each round times everything once; times are medians over the rounds, ratios medians of the ratios within a round. All states are
checked for the same answers first. `bare` is a call of Pinocchio's `rnea` on a model without joints: what it costs to
hand three arrays over and take one back.
"""

import argparse
import json
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import mujoco
import numpy as np
import pinocchio as pin

import pyplatewash as pw

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "crates" / "simulator" / "tests" / "fixtures"))

import generate_dynamics  # noqa: E402
import mujoco_run  # noqa: E402

STATES, STEPS = 2000, 10_000


class Rust:
    """`timed_dynamics`, asked for one kind of work at a time."""

    def __init__(self, work: dict):
        binary = ROOT / "benches" / "peers" / "target" / "release" / "timed_dynamics"
        self.process = subprocess.Popen([binary], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.process.stdin.write(json.dumps(work) + "\n")

    def __call__(self, asked: str) -> tuple[float, np.ndarray]:
        self.process.stdin.write(asked + "\n")
        self.process.stdin.flush()
        spent, *last = (float(word) for word in self.process.stdout.readline().split())
        return spent, np.array(last)


def timed(call, rows) -> float:
    """Nanoseconds of a call."""
    start = time.perf_counter_ns()
    for row in rows:
        call(*row)
    return (time.perf_counter_ns() - start) / len(rows)


class Mujoco:
    """Many steps in one call: semi-implicit Euler, no contacts, no limits."""

    def __init__(self, plan: dict, q: np.ndarray, qd: np.ndarray):
        self.model = mujoco_run.model_of(plan, 1000.0)
        self.data, self.q, self.qd = mujoco.MjData(self.model), q, qd

    def step(self) -> float:
        mujoco.mj_resetData(self.model, self.data)
        self.data.qpos[:], self.data.qvel[:] = self.q, self.qd
        start = time.perf_counter_ns()
        mujoco.mj_step(self.model, self.data, nstep=STEPS)
        return (time.perf_counter_ns() - start) / STEPS


def states(robot: pw.Robot) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    rng = np.random.default_rng(1)
    shape = (STATES, 6)
    return rng.uniform(robot.lower, robot.upper, shape), rng.uniform(-1, 1, shape), rng.uniform(-5, 5, shape)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=41)
    rounds = parser.parse_args().rounds
    scenario = pw.Scenario.load("kitchen")
    robot, plan, section = pw.Robot.irb120(), pw.plan(scenario.job()).plan, scenario.tool
    tool = pw.Tool(**section.to_dict())
    q, qd, qdd = states(robot)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "plan.json"
        plan.save(path)
        work = {"plan": str(path), "q": q.tolist(), "qd": qd.tolist(), "qdd": qdd.tolist(), "steps": STEPS}
        ours = Rust(work)
        answers = {asked: ours(asked)[1] for asked in ("inverse", "forward", "mass", "step", "kitchen")}
    ours_in_python = pw.DynamicsModel(robot, tool)
    other = generate_dynamics.with_tool(pin.buildModelFromXML(robot.urdf), section)
    data, empty = other.createData(), pin.Model()
    nothing, none = empty.createData(), np.zeros(0)
    other_steps = Mujoco(plan.to_dict(), q[0], qd[0])
    # The same answers.
    np.testing.assert_allclose(answers["inverse"], pin.rnea(other, data, q[-1], qd[-1], qdd[-1]), rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(answers["forward"], pin.aba(other, data, q[-1], qd[-1], qdd[-1]), rtol=1e-8, atol=1e-8)
    np.testing.assert_allclose(answers["mass"], pin.crba(other, data, q[-1])[0], rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(ours_in_python.inverse_dynamics(q[-1], qd[-1], qdd[-1]), answers["inverse"], rtol=0)
    rows = list(zip(q, qd, qdd))
    columns = {
        "inverse": lambda: ours("inverse")[0],
        "forward": lambda: ours("forward")[0],
        "mass": lambda: ours("mass")[0],
        "step": lambda: ours("step")[0],
        "kitchen": lambda: ours("kitchen")[0],
        "wheel": lambda: timed(ours_in_python.inverse_dynamics, rows),
        "batch": lambda: timed(ours_in_python.inverse_dynamics, [(q, qd, qdd)]) / STATES,
        "rnea": lambda: timed(lambda *row: pin.rnea(other, data, *row), rows),
        "aba": lambda: timed(lambda *row: pin.aba(other, data, *row), rows),
        "crba": lambda: timed(lambda q, *_: pin.crba(other, data, q), rows),
        "bare": lambda: timed(lambda *_: pin.rnea(empty, nothing, none, none, none), rows),
        "mj_step": other_steps.step,
    }
    measured = [{name: measure() for name, measure in columns.items()} for _ in range(rounds + 1)][1:]
    report(measured, plan.duration_s)


def report(rounds: list[dict], duration_s: float) -> None:
    def median(of) -> float:
        return statistics.median(of(row) for row in rounds)

    def line(name: str, ours: str, theirs: str, less: str | None, aim: str) -> None:
        bare = (lambda row: row[less]) if less else (lambda _: 0.0)
        mine, its = median(lambda row: row[ours]), median(lambda row: row[theirs] - bare(row))
        ratio = median(lambda row: row[ours] / (row[theirs] - bare(row)))
        print(f"| {name} | {mine:.0f} | {its:.0f} | {ratio:.3f} | {aim} |")

    print("| ours beside theirs | ours ns | theirs ns | ours / theirs | aim |")
    print("| --- | ---: | ---: | ---: | ---: |")
    line("a step of the plant, `mj_step`", "step", "mj_step", None, "0.5")
    line("inverse dynamics, `rnea` less a bare call", "inverse", "rnea", "bare", "0.4")
    line("forward dynamics, `aba` less a bare call", "forward", "aba", "bare", "")
    line("mass matrix, `crba` less a bare call", "mass", "crba", "bare", "")
    line("inverse dynamics, one call from Python each, `rnea`", "wheel", "rnea", None, "")
    line("inverse dynamics, a batch of 2000 from Python, `rnea`", "batch", "rnea", None, "")
    kitchen = median(lambda row: row["kitchen"])
    print(f"\nbare call: {median(lambda row: row['bare']):.0f} ns")
    print(f"kitchen: {1e-6 * kitchen:.1f} ms for {duration_s:.2f} s, {duration_s * 1e9 / kitchen:.0f} x real time (aim: 400)")


if __name__ == "__main__":
    main()
