"""The wheel beside Rust, Pinocchio and roboticstoolbox on the same work, in one run. No part of the tests.

    python -m venv bench && bench/bin/pip install . -r tests/python/bench_requirements.txt
    cargo build --release -p pyplatewash --example rust_side
    bench/bin/python -m pytest tests/python/bench_wheel.py --benchmark-columns=median,iqr,rounds

Before every round of ours, Rust does the same once; `ratio` is the median of ours / Rust's, round by round. Unreliable on a
busy machine, but for that ratio.
"""

import os
import statistics
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pinocchio as pin
import pytest
import roboticstoolbox as rtb

import pyplatewash as pw
from wheel_plans import plan

ROOT = Path(__file__).resolve().parents[2]
TARGET = ROOT / os.environ.get("CARGO_TARGET_DIR", "target")
URDF = ROOT / "urdf" / "irb120.urdf"
ROWS, PEER_ROWS, ONE, ROUNDS = 100_000, 2_000, 1_000, 31

Floats = npt.NDArray[np.float64]

robot = pw.Robot.irb120()
rng = np.random.default_rng(20)
Q: Floats = rng.uniform(robot.lower, robot.upper, (ROWS, 6))
SEEDS: Floats = np.clip(Q + rng.uniform(-0.01, 0.01, Q.shape), robot.lower, robot.upper)
TARGETS: Floats = robot.fk(Q)

model = pin.buildModelFromUrdf(str(URDF))
data = model.createData()
frame = model.getFrameId("tool0")
toolbox = rtb.Robot.URDF(str(URDF)).ets(end="tool0")

Rust = Callable[[str], float]


@pytest.fixture(scope="module")
def rust(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Rust]:
    """Seconds that Rust takes for a piece of work."""
    file = tmp_path_factory.mktemp("rust") / "problems"
    file.write_bytes(np.concatenate([Q, SEEDS]).astype("<f8").tobytes())
    program = TARGET / "release" / "examples" / "rust_side"
    with subprocess.Popen([program, file], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdin and process.stdout

        def ask(work: str) -> float:
            assert process.stdin and process.stdout
            print(work, file=process.stdin, flush=True)
            return float(process.stdout.readline())

        yield ask
        process.stdin.close()


def beside_rust(benchmark: Any, rust: Rust, work: str, ours: Callable[[], Any], calls: int = 1, rounds: int = ROUNDS) -> None:
    """Ours, with Rust's time for the same in the turns between."""
    theirs: list[float] = []
    benchmark.pedantic(ours, setup=lambda: theirs.append(rust(work)), rounds=rounds, iterations=1, warmup_rounds=2)
    seconds = benchmark.stats.stats.data
    pairs = list(zip(seconds, theirs[-len(seconds) :], strict=True))
    ratio = statistics.median(own / calls / other for own, other in pairs)
    extra = statistics.median(own / calls - other for own, other in pairs)
    benchmark.extra_info.update(ratio=ratio, extra_us=1e6 * extra, rust_ms=1e3 * statistics.median(theirs))
    print(f"\n{work}: ours {1e3 * statistics.median(seconds) / calls:.4f} ms, ratio {ratio:.3f}, {1e6 * extra:+.2f} us over Rust's")


@pytest.mark.benchmark(group="fk of 100,000 configurations")
def test_fk_ours(benchmark: Any, rust: Rust) -> None:
    beside_rust(benchmark, rust, "fk", lambda: robot.fk(Q), rounds=201)


@pytest.mark.benchmark(group="fk of 100,000 configurations")
def test_fk_pinocchio(benchmark: Any) -> None:
    def all_rows() -> Floats:
        poses = np.empty((ROWS, 4, 4))
        for k, q in enumerate(Q):
            pin.framesForwardKinematics(model, data, q)
            poses[k] = data.oMf[frame].homogeneous
        return poses

    poses = benchmark.pedantic(all_rows, rounds=5)
    np.testing.assert_allclose(poses, TARGETS, atol=1e-11)


@pytest.mark.benchmark(group="fk of 100,000 configurations")
def test_fk_toolbox(benchmark: Any) -> None:
    poses = benchmark.pedantic(lambda: toolbox.fkine(Q), rounds=5)
    np.testing.assert_allclose(np.array(poses.A), TARGETS, atol=1e-11)


@pytest.mark.benchmark(group="fk, 1,000 calls of one configuration")
def test_fk_one_ours(benchmark: Any, rust: Rust) -> None:
    rows = list(Q[:ONE])
    beside_rust(benchmark, rust, "fk one", lambda: [robot.fk(q) for q in rows], calls=ONE)


@pytest.mark.benchmark(group="fk, 1,000 calls of one configuration")
def test_fk_one_pinocchio(benchmark: Any) -> None:
    def calls() -> None:
        for q in rows:
            pin.framesForwardKinematics(model, data, q)
            data.oMf[frame].homogeneous  # noqa: B018

    rows = list(Q[:ONE])
    benchmark.pedantic(calls, rounds=ROUNDS, warmup_rounds=2)


@pytest.mark.benchmark(group="fk, 1,000 calls of one configuration")
def test_fk_one_toolbox(benchmark: Any) -> None:
    rows = list(Q[:ONE])
    benchmark.pedantic(lambda: [toolbox.eval(q) for q in rows], rounds=ROUNDS, warmup_rounds=2)


@pytest.mark.benchmark(group="ik of 100,000 targets, seeds 0.01 rad off")
def test_ik_warm_ours(benchmark: Any, rust: Rust) -> None:
    beside_rust(benchmark, rust, "ik warm", lambda: robot.ik_batch(TARGETS, SEEDS))
    assert robot.ik_batch(TARGETS, SEEDS).solved.all()


@pytest.mark.benchmark(group="ik of 100,000 targets, one seed")
def test_ik_cold_ours(benchmark: Any, rust: Rust) -> None:
    beside_rust(benchmark, rust, "ik cold", lambda: robot.ik_batch(TARGETS))
    assert robot.ik_batch(TARGETS).solved.all()


def share_solved(q: Floats) -> float:
    """Within 2e-6 of the target in every entry, and within the limits."""
    off = np.abs(robot.fk(q) - TARGETS[: len(q)]).max(axis=(1, 2))
    return float(((off < 2e-6) & (robot.limit_margins(q) >= 0).all(axis=1)).mean())


@pytest.mark.benchmark(group="ik of 2,000 targets, seeds 0.01 rad off")
def test_ik_peers_ours(benchmark: Any) -> None:
    answer = benchmark.pedantic(lambda: robot.ik_batch(TARGETS[:PEER_ROWS], SEEDS[:PEER_ROWS]), rounds=ROUNDS, warmup_rounds=2)
    benchmark.extra_info["solved"] = share_solved(answer.q)


@pytest.mark.benchmark(group="ik of 2,000 targets, seeds 0.01 rad off")
def test_ik_peers_ours_one_by_one(benchmark: Any) -> None:
    def calls() -> Floats:
        return np.array([robot.ik(target, seed).q for target, seed in zip(TARGETS[:PEER_ROWS], SEEDS[:PEER_ROWS], strict=True)])

    benchmark.extra_info["solved"] = share_solved(benchmark.pedantic(calls, rounds=5))


@pytest.mark.benchmark(group="ik of 2,000 targets, seeds 0.01 rad off")
def test_ik_peers_pinocchio(benchmark: Any) -> None:
    """The loop of Pinocchio's own example on inverse kinematics, with full steps and light damping."""

    def one(target: Floats, q: Floats) -> Floats:
        wanted = pin.SE3(target)
        for _ in range(50):
            pin.framesForwardKinematics(model, data, q)
            error = pin.log6(data.oMf[frame].actInv(wanted)).vector
            if np.linalg.norm(error[:3]) < 1e-6 and np.linalg.norm(error[3:]) < 1e-6:
                break
            jacobian = pin.computeFrameJacobian(model, data, q, frame, pin.LOCAL)
            q = q + jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + 1e-12 * np.eye(6), error)
        return q

    def calls() -> Floats:
        return np.array([one(target, seed) for target, seed in zip(TARGETS[:PEER_ROWS], SEEDS[:PEER_ROWS], strict=True)])

    benchmark.extra_info["solved"] = share_solved(benchmark.pedantic(calls, rounds=5))


@pytest.mark.benchmark(group="ik of 2,000 targets, seeds 0.01 rad off")
def test_ik_peers_toolbox(benchmark: Any) -> None:
    def calls() -> Floats:
        pairs = zip(TARGETS[:PEER_ROWS], SEEDS[:PEER_ROWS], strict=True)
        return np.array([toolbox.ik_LM(target, q0=seed, tol=5e-13).q for target, seed in pairs])

    benchmark.extra_info["solved"] = share_solved(benchmark.pedantic(calls, rounds=5))


@pytest.mark.benchmark(group="plan of the kitchen")
def test_plan_ours(benchmark: Any, rust: Rust) -> None:
    beside_rust(benchmark, rust, "plan", lambda: plan("kitchen"))
