"""The wheel's jobs: scenarios, layouts, plans, certificates, reports."""

import copy
import json
import math
import pickle
import subprocess
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import pyplatewash as pw
from wheel_plans import paper_run, plan, planned


@pytest.fixture(scope="module")
def kitchen() -> pw.Planned:
    return planned("kitchen")


@pytest.fixture(scope="module")
def run() -> pw.PaperRun:
    return paper_run("paper-appendix")


def test_plans_equal_those_of_the_command_to_the_byte(platewash: Path, tmp_path: Path, kitchen: pw.Planned, run: pw.PaperRun) -> None:
    for scenario, plan in {"kitchen": kitchen.plan, "paper-appendix": run.plan()}.items():
        subprocess.run([platewash, "plan", "--quiet", "--scenario", scenario, "--out", tmp_path], check=True, capture_output=True)
        assert (tmp_path / "plan.json").read_text() == plan.to_json()
        assert (tmp_path / "trajectory.csv").read_text() == plan.to_csv()
        assert pw.Plan.load(tmp_path / "plan.json") == plan
    assert run.to_csv() == run.plan().to_csv() != run.to_csv(executed=True)


def test_the_kitchen_is_proved(kitchen: pw.Planned) -> None:
    plan = kitchen.plan
    certificate = pw.prove(plan)
    assert certificate.proved and certificate.verdict == "pass" and certificate.broken == []
    assert {check.status for check in certificate.checks} == {"proved"}
    assert certificate == pw.prove(plan, pw.Robot.irb120())
    assert str(certificate).startswith(f"{certificate.headline}\n") and certificate.headline.startswith("PROVED: 4 plates in ")
    assert len(str(certificate).splitlines()) < 25 and "\nclearance, at least\n" in certificate.details()
    assert certificate.waived == [] and certificate.plates_washed == 4
    assert certificate.rests_on.requirements == plan.job.requirements == kitchen.job.requirements
    report = kitchen.report()
    assert report.verdict == "washed" and str(report).startswith("PROVED")
    assert len(report.visits) == len(plan.order) == len(plan.wash_paths) == len(plan.plates) == 4
    assert [visit.plate for visit in kitchen.visits] == plan.order and len(kitchen.transits) == 5
    assert kitchen.tour.travel_s <= kitchen.tour.nearest_next_s
    np.testing.assert_array_equal(kitchen.largest_jerk_rad_s3, report.jerk_rad_s3)


def test_accepts_unambiguous_values(tmp_path: Path, kitchen: pw.Planned, run: pw.PaperRun) -> None:
    scenario = pw.Scenario.load("kitchen").replace(layout={"count": 1})
    one = pw.plan(scenario, seed=3)
    assert one == pw.plan(scenario.replace(seed=3).job()) != pw.plan(scenario)
    file = tmp_path / "one.toml"
    file.write_text(scenario.to_toml())
    assert pw.plan(file, seed=3) == pw.plan(str(file), seed=3) == one
    assert pw.plan("kitchen").plan == kitchen.plan
    assert pw.run_paper("paper-appendix").plan() == run.plan()

    assert pw.prove(one) == pw.prove(one.plan)
    assert pw.simulate(one) == pw.simulate(one.plan)
    assert pw.SimulationSettings.of(one) == pw.SimulationSettings.of(one.plan)
    assert pw.differences(one, scenario.replace(seed=3)) == [] != pw.differences(kitchen, "kitchen-roomy")
    assert pw.differences(run.plan(), run.job) == []
    assert pw.ClearanceModel.of(one).bodies == pw.ClearanceModel.of(one.job).bodies

    with pytest.raises(pw.InputError, match=r"seed: is for scenarios: a WashJob's plates are placed"):
        pw.plan(one.job, seed=4)
    with pytest.raises(pw.InputError, match='"paper-appendix" has job.program = "paper"'):
        pw.plan("paper-appendix")
    with pytest.raises(pw.InputError, match='"kitchen" has job.program = "certified"'):
        pw.run_paper("kitchen")
    with pytest.raises(pw.ScenarioError, match="kitchn"):
        pw.plan("kitchn")


def test_finds_a_changed_plan(kitchen: pw.Planned) -> None:
    table = kitchen.plan.to_dict()
    table["knots"]["q_rad"][100][0] += 0.5
    changed = pw.Plan.from_json(json.dumps(table))
    assert not changed.is_sealed()
    certificate = pw.prove(changed)
    assert not certificate.proved and certificate.broken
    with pytest.raises(pw.PlanFileError):
        pw.Plan.from_json("{}")
    with pytest.raises(pw.PlanFileError):
        pw.Plan.load("/nowhere/plan.json")


def test_a_plate_out_of_reach_is_named_with_what_could_be_done() -> None:
    scenario = pw.Scenario.load("kitchen").replace(layout={"region": None, "positions_m": [[0.7, 0.0]], "count": 1})
    with pytest.raises(pw.PlanError) as caught:
        plan(scenario)
    error = pickle.loads(pickle.dumps(caught.value))
    assert error.plate == 0 and error.cause == "unwashable" and 0 < error.share < 1
    moved = scenario.replace(layout={"positions_m": [error.nearest_m * 0.97]})
    assert pw.prove(plan(moved)).proved


def test_distinguishes_searches_without_result_from_impossible(root: Path, tmp_path: Path) -> None:
    # With axis 6 beside axis 5 there is no closed form.
    text = (root / "crates" / "kinematics" / "tests" / "fixtures" / "ur5_lengths.urdf").read_text()
    arm = tmp_path / "searched.urdf"
    arm.write_text(text.replace('xyz="0 0 0.09465"', 'xyz="0.01 0 0.09465"'))
    assert arm.read_text() != text
    cell = pw.Scenario.load("kitchen").replace(
        robot={"urdf": str(arm), "start_deg": [0.0, -90.0, 90.0, -90.0, -90.0, 0.0]},
        layout={"region": None, "positions_m": [[0.5, 0.0]], "plate_radius_m": 0.11, "plate_height_m": 0.1},
        wash={"path_radius_m": 0.09, "turns": 3.0},
    )
    for x_m, cause in [(0.87, "not_found"), (2.0, "unwashable")]:
        with pytest.raises(pw.PlanError) as caught:
            plan(cell.replace(layout={"positions_m": [[x_m, 0.0]]}))
        assert (caught.value.cause, caught.value.plate) == (cause, 0), caught.value
        assert ("cannot" in str(caught.value)) == (cause == "unwashable"), caught.value


def test_eight_threads_give_the_plan_of_one() -> None:
    seeds = list(range(1, 9))
    alone = [plan("kitchen", seed).hash for seed in seeds]
    with ThreadPoolExecutor(8) as threads:
        assert list(threads.map(lambda seed: plan("kitchen", seed).hash, seeds)) == alone


def test_a_sweep_equals_its_plans() -> None:
    rows = pw.sweep("kitchen", [3, 1])
    assert [row.axes["seed"] for row in rows] == [3, 1] and {row.outcome for row in rows} == {"proved"}
    assert [row.index for row in rows] == [0, 1]
    assert (rows[1].duration_s, rows[1].plan) == (plan("kitchen", 1).duration_s, plan("kitchen", 1).hash)
    with pytest.raises(pw.InputError):
        pw.sweep("paper-text", [1])


def test_the_papers_run_says_that_it_does_not_wash(run: pw.PaperRun) -> None:
    report = run.report()
    assert report.headline.startswith("NOT SWEPT") and str(report).startswith("NOT SWEPT")
    assert run.targets.shape == run.executed_tip.shape == (len(run), 3)
    assert run.commanded_q.shape == run.executed_q.shape == (len(run), 6)
    assert run.reached.sum() == sum(p.reached for p in report.plates) + report.transitions.reached
    for plate in report.plates:
        mine = run.washing & (run.plate == plate.plate)
        centre = run.job.layout.centres[plate.plate]
        measured = pw.coverage(run.executed_tip[mine, :2], centre, 0.145, report.sponge_radius_m)
        assert measured.fraction == pytest.approx(plate.executed_coverage.fraction, abs=2e-3)
    np.testing.assert_array_equal(run.planned.q_rad[1:], run.commanded_q)
    assert run.to_csv().count("\n") == len(run) + 2
    plan = run.plan()
    assert (plan.process, plan.wash_paths, plan.job.seed) == ("paper", [], run.job.seed)
    with pytest.raises(pw.ProveError, match="the paper's program"):
        pw.prove(plan)


def test_scenarios_are_read_changed_and_refused(tmp_path: Path) -> None:
    scenario = pw.Scenario.load("paper-appendix")
    assert "kitchen" in pw.Scenario.shipped()
    assert pw.Scenario.from_dict(scenario.to_dict()) == scenario == pw.Scenario.parse(scenario.to_toml())
    for section in scenario.to_dict():
        assert section == "job" or getattr(scenario, section) == scenario[section]
    assert scenario["job"].program == "paper"
    changed = scenario.replace(seed=3, tool=pw.Tool(length_m=0.1), layout={"count": np.int64(3)})
    assert (changed.seed, changed.tool.length_m, changed.layout.count) == (3, 0.1, 3)
    assert scenario.seed == 1 and len(pw.place_plates(changed)) == 3
    with pytest.raises(pw.ScenarioError) as caught:
        scenario.replace(wash={"turns": -1})
    assert caught.value.key == "wash.turns" and caught.value.found == "-1"
    with pytest.raises(pw.ScenarioError, match="did you mean 'wash.turns'"):
        scenario.replace(wash={"turnz": 1})
    (tmp_path / "bad.toml").write_text("name = 'x'\nseed = 'y'\n")
    with pytest.raises(pw.ScenarioError) as caught:
        pw.Scenario.load(tmp_path / "bad.toml")
    assert caught.value.line == 2
    with pytest.raises(KeyError):
        scenario["nose"]
    for wrong in (3, [1], {"seed": object()}, {3: 4}, {"seed": 2**80}, {"seed": float("nan")}):
        with pytest.raises(pw.PlatewashError):
            pw.Scenario.from_dict(wrong)


def test_plates_without_room_are_an_error_with_numbers() -> None:
    crowded = pw.Scenario.load("paper-text").replace(layout={"count": 200})
    with pytest.raises(pw.LayoutError) as caught:
        pw.place_plates(crowded)
    error = caught.value
    assert error.cause == "no_room" and error.most_placed is not None and error.upper_bound is not None
    assert error.most_placed < error.upper_bound < 200
    with pytest.raises(pw.LayoutError, match=r"another seed, .*layout\.min_distance_m") as caught:
        pw.place_plates(pw.Scenario.load("kitchen").replace(seed=5, layout={"count": 5}))
    assert caught.value.cause == "not_found"


def test_findings_come_with_words() -> None:
    given = pw.Scenario.load("paper-appendix").replace(layout={"region": None, "positions_m": [[0.3, 0.0], [0.35, 0.0]]})
    kinds = {finding.kind: str(finding) for finding in pw.place_plates(given).findings}
    assert "overlap by 240.0 mm" in kinds["plates_overlap"]
    assert len(given.check()) == len(kinds)


def test_trajectories_are_their_knots(run: pw.PaperRun) -> None:
    motion = run.planned
    q, qd, qdd = motion.at(motion.t_s)
    np.testing.assert_allclose(q, motion.q_rad, atol=1e-12)
    np.testing.assert_allclose(qd, motion.qd_rad_s, atol=1e-7)
    assert [x.shape for x in motion.at(0.5)] == [(6,)] * 3
    extremes = motion.extremes()
    assert extremes["span_s"].shape == (len(motion) - 1, 2)
    times = np.linspace(0, motion.duration_s, 5001)
    dense = motion.at(times)[1]
    assert (np.abs(dense).max(axis=0) <= extremes["speed_rad_s"].max(axis=0) + 1e-9).all()
    for bad in ([0.0, 0.0], [1.0, 2.0], [0.0, np.nan]):
        with pytest.raises(pw.InputError):
            pw.Trajectory(bad, np.zeros((2, 6)), np.zeros((2, 6)))
    with pytest.raises(pw.InputError):
        motion.at(np.nan)
    with pytest.raises(pw.InputError):
        pw.Trajectory.through(np.zeros((3, 6)), 0.0)


def test_outside_its_time_a_motion_rests_at_its_end(kitchen: pw.Planned, run: pw.PaperRun) -> None:
    moving = pw.Trajectory([0.0, 0.5], [[0.2] * 6, [0.9] * 6], [[1.0] * 6, [-2.0] * 6])
    for motion in (kitchen.plan.trajectory, run.planned, moving):
        outside = [-9.0, -1e-9, motion.duration_s + 1e-9, motion.duration_s + 9.0]
        q, qd, qdd = motion.at(outside)
        np.testing.assert_allclose(q, motion.q_rad[[0, 0, -1, -1]], rtol=0, atol=1e-12)
        assert not qd.any() and not qdd.any()
        np.testing.assert_allclose(motion.at([0.0, motion.duration_s])[1], motion.qd_rad_s[[0, -1]], atol=1e-9)


def test_plan_files_need_their_arm(tmp_path: Path) -> None:
    builtin = pw.Robot.irb120()
    (tmp_path / "own.urdf").write_text(builtin.urdf + "<!-- mine -->")
    (tmp_path / "own.srdf").write_text(builtin.srdf or "")
    files = {"urdf": tmp_path / "own.urdf", "srdf": tmp_path / "own.srdf"}
    own = pw.Robot.load(files["urdf"], srdf=files["srdf"])
    scenario = pw.Scenario.load("kitchen").replace(robot=files, layout={"count": 1})
    job = scenario.job()
    plans = [pw.plan(job).plan, pickle.loads(pickle.dumps(pw.plan(job))).plan]
    paper = pw.Scenario.load("paper-appendix").replace(robot=files).paper_job()
    assert pw.run_paper(paper).plan().robot == own == paper.robot == job.robot
    for file in files.values():
        file.unlink()  # A plan that knows its arm needs no file of it, a pickled one neither.
    plans += [pickle.loads(pickle.dumps(plan)) for plan in plans] + [pw.plan(pickle.loads(pickle.dumps(job))).plan]
    settings = pw.SimulationSettings()
    for plan in plans:
        assert plan == plans[0] and plan.robot == own != builtin
        assert pw.prove(plan).proved
    rows = pw.tune(plans[-1], [20.0], settings=settings)
    assert rows[0].verdict == "washed"
    execution = pw.simulate(plans[0], settings=settings)
    assert pickle.loads(pickle.dumps(execution)) == execution
    plans[0].save(tmp_path / "plan.json")
    loaded = pw.Plan.load(tmp_path / "plan.json")
    assert loaded == plans[0] and loaded.robot is None and pickle.loads(pickle.dumps(loaded)).robot is None
    calls: list[Callable[[], object]] = [lambda: pw.prove(loaded), lambda: pw.prove(tmp_path / "plan.json"), lambda: pw.simulate(loaded), lambda: pw.tune(loaded, [20.0]), loaded.to_csv]
    for call in calls:
        with pytest.raises(pw.ProveError, match=r"robot: the plan is for the arm \"irb120\" .*give the arm as robot=Robot\.load") as caught:
            call()
        assert caught.value.argument == "robot"
    assert pw.prove(loaded, own).proved and pw.prove(tmp_path / "plan.json", robot=own).proved
    assert pw.simulate(loaded, own, settings) == execution
    assert loaded.to_csv(robot=own).count("\n") == plans[0].to_csv().count("\n") > 900
    other = pw.prove(loaded, builtin)
    assert not other.proved and "arm" in [check.requirement for check in other.broken]
    kitchen = pw.plan(pw.Scenario.load("kitchen").job()).plan
    assert kitchen.robot == builtin == pw.Plan.from_json(kitchen.to_json()).robot


def test_jobs_equal_their_scenario() -> None:
    scenario = pw.Scenario.load("kitchen")
    job = scenario.job()
    assert (job.name, job.seed, job.robot) == ("kitchen", 1, pw.Robot.irb120())
    assert job.plates == job.layout.plates == pw.place_plates(scenario).plates
    np.testing.assert_allclose(job.home_rad, np.radians([scenario.robot.start_deg] * 2), rtol=0, atol=1e-15)
    assert job.requirements.coverage == scenario["job"].required_coverage
    assert job.limits.tip_speed_m_s == scenario.limits.tip_speed_m_s
    assert job.simulation.law == "computed_torque" and job.workcell.arm.name == "irb120"
    other = pw.place_plates(scenario.replace(seed=2))
    moved = scenario.job(other)
    assert moved.plates == other.plates != job.plates and moved.layout == other
    assert job.on_plates(other.plates).plates == other.plates and job.on_plates(job.plates).to_dict() == job.to_dict()
    with pytest.raises(pw.InputError, match="plates"):
        job.on_plates([])
    paper = pw.Scenario.load("paper-appendix")
    run = paper.paper_job()
    assert (run.name, run.seed, run.layout) == ("paper-appendix", 1, pw.place_plates(paper))
    assert not run.start_rad.any() and run.settings.spiral.points == paper.wash.points
    assert paper.paper_job(other).layout == other


def test_reports_fields_of_a_plan_of_another_job(kitchen: pw.Planned, tmp_path: Path) -> None:
    scenario = pw.Scenario.load("kitchen")
    kitchen.plan.save(tmp_path / "plan.json")
    assert pw.differences(kitchen.plan, scenario.job()) == [] == pw.differences(tmp_path / "plan.json", kitchen.job)
    asked = scenario.replace(wash={"clearance_m": 0.02}).job()
    (one,) = pw.differences(kitchen.plan, asked)
    assert (one.key, one.found, one.expected) == ("requirements.clearance_m", "0.01", "0.02")
    assert str(one) == "requirements.clearance_m: 0.01; expected 0.02"
    assert pw.prove(kitchen.plan).proved  # It does its job, which is not the one that was asked for.
    moved = pw.differences(kitchen.plan, scenario.replace(seed=2).job())
    assert {"seed", "plates[0].pose.position_m[0]"} <= {each.key for each in moved}
    assert pw.differences(kitchen.plan, pw.Scenario.load("paper-appendix").paper_job())


def test_stacked_clearances_equal_single_ones(kitchen: pw.Planned) -> None:
    model = pw.ClearanceModel(pw.Robot.irb120(), pw.Tool(length_m=0.15), kitchen.plan.plates)
    q = kitchen.plan.trajectory.at(np.linspace(0, kitchen.plan.duration_s, 40))[0]
    distances = model.distances(q)
    assert distances.shape == (40, len(model.pairs))
    for k in (0, 13, 39):
        np.testing.assert_array_equal(model.distances(q[k]), distances[k])
        nearest = model.smallest(q[k])
        assert nearest is not None
        assert nearest.distance_m == distances[k].min()
        assert (nearest.a, nearest.b) in model.pairs
        near = model.too_near(q[k], nearest.distance_m + 1e-9)
        assert near[0].distance_m == nearest.distance_m
    assert pickle.loads(pickle.dumps(model)) == model
    with pytest.raises(pw.InputError, match="row 1"):
        model.distances([[0.0] * 6, [np.nan] * 6])
    with pytest.raises(TypeError):
        pw.ClearanceModel(pw.Robot.irb120(), plates=[3])  # type: ignore[list-item]  # pyright: ignore[reportArgumentType]


def test_the_raster_keeps_the_bounds() -> None:
    path = pw.PaperSpiral(closing_ring=True).waypoints((0.1, 0.2))
    exact = pw.coverage(path, (0.1, 0.2), 0.145, 0.02)
    raster = pw.coverage_raster(path, (0.1, 0.2), 0.145, 0.02, cells=300)
    inside = (raster.x_m[None] - 0.1) ** 2 + (raster.y_m[:, None] - 0.2) ** 2 <= 0.145**2
    swept = (raster.state == raster.SWEPT)[inside].mean()
    missed = (raster.state == raster.MISSED)[inside].mean()
    assert swept <= exact.upper + 0.01 and 1 - missed >= exact.lower - 0.01
    left, right, bottom, top = raster.extent
    assert (left, right, bottom, top) == pytest.approx((-0.045, 0.245, 0.055, 0.345))
    assert exact.lower <= exact.fraction <= exact.upper


def test_curves_have_their_stated_properties() -> None:
    spiral = pw.PaperSpiral().waypoints((0.25, -0.25))
    np.testing.assert_allclose(np.linalg.norm(spiral - (0.25, -0.25), axis=1), np.linspace(0, 0.145, 55), atol=1e-15)
    through = pw.transit_waypoints((0.3, 0.0, 0.08), (0.0, 0.3, 0.08), radius_m=0.4, height_m=0.3)
    assert through.shape == (7, 3) and (through[1:6, 2] == 0.3).all()
    for kind in ("zero_velocity", "c2_spline"):
        curve = pw.cubic_samples(through, 61, kind)
        np.testing.assert_allclose(curve[::10], through, atol=1e-12)
    theta, points = pw.WashCurve(radius_m=0.12, turns=3.0).sample(1e-4)
    assert (np.diff(theta) > 0).all() and np.linalg.norm(points[-1]) == pytest.approx(0.12)
    for call in (
        lambda: pw.PaperSpiral(points=10**12).waypoints(),
        lambda: pw.PaperSpiral(turns=np.inf).waypoints(),
        lambda: pw.WashCurve(radius_m=0.1, turns=3).sample(0.0),
        lambda: pw.cubic_samples(np.zeros((2, 3)), 5, "quintic"),  # type: ignore[arg-type]  # pyright: ignore[reportArgumentType]
        lambda: pw.cubic_samples(np.full((2, 3), np.nan), 5),
        lambda: pw.coverage(np.zeros((3, 2)), (0, 0), 0.1, 0.02, cell_m=1e-12),
        lambda: pw.coverage_raster(np.zeros((3, 2)), (0, 0), 0.1, 0.02, cells=10**6),
    ):
        with pytest.raises(pw.InputError):
            call()


def test_reproduce_equals_that_of_the_command(platewash: Path) -> None:
    ours = pw.reproduce(layouts=4, draws=200, seed=2)
    theirs = subprocess.run(
        [platewash, "reproduce", "--quiet", "--json", "--layouts", "4", "--draws", "200", "--seed", "2"],
        check=True,
        capture_output=True,
    )
    assert ours.to_dict() == json.loads(theirs.stdout)
    assert str(ours).startswith("The paper's program, measured")


def test_copies_and_pickles_are_equal(kitchen: pw.Planned, run: pw.PaperRun) -> None:
    plan = kitchen.plan
    things = [kitchen, kitchen.job, plan, pw.prove(plan), kitchen.job.layout, plan.trajectory, plan.provenance]
    things += [run, run.job, run.plan(), run.report(), pw.Scenario.load("kitchen"), kitchen.job.simulation]
    things += [pw.coverage_raster(np.zeros((3, 2)), (0, 0), 0.1, 0.02, cells=5), pw.Coverage(0.5, 0.4, 0.6)]
    for thing in things:
        assert pickle.loads(pickle.dumps(thing)) == thing == copy.copy(thing) == copy.deepcopy(thing)
        assert thing != 3 and type(thing).__name__ in repr(thing)


def test_seeds_are_whole_numbers_that_a_plan_file_can_tell_apart() -> None:
    largest = 2**53 - 1
    scenario = pw.Scenario.load("kitchen")
    assert scenario.replace(seed=largest).seed == largest
    expected = rf"seed must be a whole number from 0 to {largest} \(2\^53 − 1\); found {largest + 1}"
    with pytest.raises(pw.ScenarioError, match=expected):
        scenario.replace(seed=largest + 1)
    with pytest.raises(pw.InputError, match=f"seed: .*{largest} is needed; found {largest + 1}"):
        pw.reproduce(seed=largest + 1)
    with pytest.raises(pw.InputError, match=str(largest)):
        pw.sweep(scenario, [1, largest + 1])


def test_states_waived_requirements_first() -> None:
    layout = {"positions_m": [[0.36, -0.1], [0.36, 0.11]], "overlap": "report"}
    certificate = pw.prove(plan(pw.Scenario.load("kitchen").replace(layout=layout)))
    assert certificate.proved and certificate.waived == ["every_plate_once", "plates_apart"]
    assert str(certificate).startswith("PROVED BUT FOR every plate once, ")


def test_a_plan_file_is_read_strictly(kitchen: pw.Planned) -> None:
    table = kitchen.plan.to_dict()
    assert pw.Plan.from_json(json.dumps(table)) == kitchen.plan
    table["wash_paths"][2]["soap"] = 1
    with pytest.raises(pw.PlanFileError, match=r"wash_paths\[2\]\.soap|unknown key 'soap'"):
        pw.Plan.from_json(json.dumps(table))
    del table["wash_paths"][2]["soap"], table["job"]["requirements"]["coverage"]
    with pytest.raises(pw.PlanFileError, match="coverage"):
        pw.Plan.from_json(json.dumps(table))
    with pytest.raises(pw.PlanFileError, match="platewash-plan/1.*plan its scenario again"):
        pw.Plan.from_json('{"format": "platewash-plan/1"}')


def test_a_dry_run_equals_that_of_the_command(platewash: Path, tmp_path: Path, kitchen: pw.Planned) -> None:
    dry = kitchen.plan.dry_run(height_m=0.03, speed_m_s=0.2)
    (tmp_path / "plan.json").write_text(kitchen.plan.to_json(), encoding="utf-8", newline="")
    asked = ["dry-run", "plan.json", "--height", "0.03", "--speed", "0.2", "--quiet"]
    subprocess.run([platewash, *asked], cwd=tmp_path, check=True, capture_output=True)
    assert dry.to_json() == (tmp_path / "out" / "dry-run" / "plan.json").read_text(encoding="utf-8")
    parent = kitchen.plan.hash
    assert parent is not None and dry.job.dry_run.parent == parent and dry.order == kitchen.plan.order
    first = f"DRY RUN of {parent[:12]}"
    certificate = pw.prove(dry)
    assert certificate.proved and certificate.plates_washed == 0 and certificate.headline.startswith(first)
    assert f"dry run of {parent[:12]}" in repr(dry) and "dry run" in repr(certificate)
    for noun in (dry, certificate):
        assert first in noun._repr_html_()
    for noun in (kitchen.plan, pw.prove(kitchen.plan)):
        assert "dry run" not in (repr(noun) + noun._repr_html_()).lower()
    assert pickle.loads(pickle.dumps(dry)) == dry


def test_states_why_there_is_no_dry_run(kitchen: pw.Planned, run: pw.PaperRun) -> None:
    plan = kitchen.plan
    for height_m in (0.0, -1.0, 0.01, math.nan, math.inf, 1e4):
        with pytest.raises(pw.InputError) as refused:
            plan.dry_run(height_m=height_m)
        assert refused.value.argument == "height_m"
    for speed_m_s in (0.0, -1.0, 2.0, math.nan, math.inf):
        with pytest.raises(pw.InputError) as refused:
            plan.dry_run(speed_m_s=speed_m_s)
        assert refused.value.argument == "speed_m_s"
    with pytest.raises(pw.InputTypeError):
        plan.dry_run("0.05")  # type: ignore[arg-type]
    edited = pw.Plan.from_json(plan.to_json().replace('"coverage":0.995', '"coverage":0.5'))
    for none, words in [(plan.dry_run(), "itself a dry run"), (run.plan(), "the paper's program"), (edited, "changed after it was written")]:
        with pytest.raises(pw.PlanError, match=words) as caught:
            none.dry_run()
        assert caught.value.stage == "dry_run"
    with pytest.raises(pw.PlanError) as caught:
        plan.dry_run(height_m=0.0103)
    assert (caught.value.stage, caught.value.plate) == ("plan", plan.order[0])


def in_wash(plan: pw.Plan, turn: int) -> tuple[float, np.ndarray]:
    """Time in the middle of a wash [s], and where the plan has the arm then [rad]."""
    wash = [segment for segment in plan.segments if segment.kind == "wash"][turn]
    time_s = 0.5 * (wash.t_start_s + wash.t_end_s)
    return time_s, plan.trajectory.at(time_s)[0]


def test_a_recovery_equals_that_of_the_command(platewash: Path, tmp_path: Path, kitchen: pw.Planned) -> None:
    plan = kitchen.plan
    time_s, q = in_wash(plan, 2)
    degrees = [f"{angle:.2f}" for angle in np.degrees(q) + 1.0]
    recovery = plan.recover(np.radians([float(angle) for angle in degrees]), time_s)
    (tmp_path / "plan.json").write_text(plan.to_json(), encoding="utf-8", newline="")
    asked = ["recover", "plan.json", "--at-deg", *degrees, "--stopped-s", str(time_s), "--quiet"]
    subprocess.run([platewash, *asked], cwd=tmp_path, check=True, capture_output=True)
    home, rest, stop, near = recovery
    assert rest is not None
    for made, name in ((home, "home"), (rest, "rest")):
        assert made.to_json() == (tmp_path / "out" / "recovery" / f"{name}.json").read_text(encoding="utf-8")
        assert made.job.recovery.parent == plan.hash and pw.prove(made).proved
    assert (stop.time_s, stop.is_stated, stop.washed, stop.at_plate) == (time_s, True, plan.order[:2], plan.order[2])
    assert rest.order == plan.order[2:] and near == []
    assert pw.prove(rest).plates_washed == 2 and pw.prove(home).plates_washed == 0
    assert pickle.loads(pickle.dumps(home)) == home
    # By the joints alone, and at the end, where all were washed.
    assert plan.recover(q).rest == rest
    assert plan.recover(plan.job.home_rad[1], plan.duration_s).rest is None


def test_states_why_there_is_no_recovery(kitchen: pw.Planned, run: pw.PaperRun) -> None:
    plan = kitchen.plan
    _, q = in_wash(plan, 0)
    for stopped_s in (-1.0, 1e9, math.nan, math.inf):
        with pytest.raises(pw.InputError) as refused:
            plan.recover(q, stopped_s)
        assert refused.value.argument == "stopped_s"
    deep = q + np.array([0.0, 0.15, 0.0, 0.0, 0.0, 0.0])
    edited = pw.Plan.from_json(plan.to_json().replace('"coverage":0.995', '"coverage":0.5'))
    home = plan.recover(q).home
    cases = [(plan, deep, "touch"), (plan, q + 9.0, "joint"), (run.plan(), q, "paper's program"), (edited, q, "changed after"), (home, q, "stopped first")]
    for stopped, at, words in cases:
        with pytest.raises((pw.PlanError, pw.ProveError), match=words):
            stopped.recover(at)
