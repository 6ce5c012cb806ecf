"""`ClearanceModel.of`: the cell of a job, wherever its arm is mounted and whatever stands around."""

import copy
import json
import pickle
import subprocess
from pathlib import Path

import numpy as np
import pytest

import pyplatewash as pw
from wheel_plans import paper_run, scenario

CELLS = ["pedestal", "ceiling", "wall", "sink", "rack", "sizes", "angled-tool", "bracket-tool", "kitchen"]
RNG = np.random.default_rng(8)
Q = np.radians(RNG.uniform([-160, -100, -100, -150, -110, -180], [160, 100, 60, 150, 110, 180], (12, 6)))


@pytest.fixture(scope="module")
def jobs() -> dict[str, pw.WashJob]:
    return {name: scenario(name).job() for name in CELLS}


@pytest.mark.parametrize("name", CELLS)
def test_distances_of_a_jobs_cell_are_those_of_the_command(name: str, jobs: dict[str, pw.WashJob], platewash: Path, tmp_path: Path) -> None:
    model = pw.ClearanceModel.of(jobs[name])
    (tmp_path / "q.txt").write_text("\n".join(" ".join(map(repr, row)) for row in Q.tolist()) + "\n")
    command = [str(platewash), "fk", "--rad", "--file", "q.txt", "--scenario", name, "--json"]
    stated = json.loads(subprocess.run(command, cwd=tmp_path, check=True, capture_output=True).stdout)["configurations"]
    for row, one in zip(model.distances(Q), stated, strict=True):
        assert [(pair["a"], pair["b"]) for pair in one["clearance"]] == model.pairs
        np.testing.assert_array_equal(row, [pair["distance_m"] for pair in one["clearance"]])


def test_body_names_are_those_of_the_cell(jobs: dict[str, pw.WashJob]) -> None:
    for job in jobs.values():
        model, workcell = pw.ClearanceModel.of(job), job.workcell
        around = [obstacle.name for obstacle in workcell.obstacles]
        held = [*(body.name for body in workcell.tool.bodies), "sponge"]
        plates = [f"plate {k}" for k in range(1, len(job.plates) + 1)]
        assert model.bodies[-len(held + around + plates) :] == held + around + plates
        assert {name for pair in model.pairs for name in pair} <= set(model.bodies)
        assert f"{len(model.bodies)} bodies, {len(model.pairs)} pairs" in repr(model)


@pytest.mark.parametrize("name", ["pedestal", "ceiling", "wall"])
def test_positions_are_in_the_world_frame(name: str, jobs: dict[str, pw.WashJob]) -> None:
    """Half-way between a body and the floor is half its height over it."""
    job = jobs[name]
    floor = next(obstacle for obstacle in job.workcell.obstacles if obstacle.name == "floor")
    height = floor.pose.position_m[2] + floor.to_dict().get("margin_m", 0.0)
    over = [pair for q in Q for pair in pw.ClearanceModel.of(job).too_near(q, 5.0) if pair.b == "floor" and pair.distance_m > 0]
    assert len(over) > 20
    for pair in over:
        assert pair.place_m[2] == pytest.approx(height + pair.distance_m / 2, abs=1e-9)


def test_a_plain_model_has_arm_tool_and_plates() -> None:
    """To the last pair: what a job leaves out is what a model of its arm, tool and plates leaves out."""
    run = paper_run("paper-appendix")
    plain = pw.ClearanceModel(pw.Robot.irb120(), plates=run.job.layout.plates)
    for source in (run.job, run.plan()):
        model = pw.ClearanceModel.of(source)
        assert model.pairs == plain.pairs
        np.testing.assert_array_equal(model.distances(Q), plain.distances(Q))


def test_models_of_jobs_are_copied_pickled_and_compared(jobs: dict[str, pw.WashJob]) -> None:
    rack = pw.ClearanceModel.of(jobs["rack"])
    for again in (copy.copy(rack), copy.deepcopy(rack), pickle.loads(pickle.dumps(rack)), pw.ClearanceModel.of(jobs["rack"])):
        assert again == rack and again.pairs == rack.pairs
        np.testing.assert_array_equal(again.distances(Q), rack.distances(Q))
    assert rack != pw.ClearanceModel.of(jobs["sink"]) and rack != pw.ClearanceModel(pw.Robot.irb120())


def test_rejects_invalid_jobs_by_name(tmp_path: Path) -> None:
    for wrong in (3, pw.Robot.irb120(), None):
        with pytest.raises(pw.InputTypeError, match="job: a WashJob, a PaperJob, a Plan, what plan\(\) returns, or the path of a plan file is needed"):
            pw.ClearanceModel.of(wrong)  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
    with pytest.raises(FileNotFoundError):
        pw.ClearanceModel.of(tmp_path / "none.json")


def test_rejects_a_plan_with_an_invalid_obstacle(jobs: dict[str, pw.WashJob]) -> None:
    plan = pw.plan(jobs["kitchen"]).plan.to_json()
    broken = plan.replace('"name":"floor",', '"margin_m":7.5,"name":"floor",')
    assert broken != plan
    with pytest.raises(pw.PlatewashError, match="obstacle 'floor': margin_m must be from 0 to 1"):
        pw.ClearanceModel.of(pw.Plan.from_json(broken))
