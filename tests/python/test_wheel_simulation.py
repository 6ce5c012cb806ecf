"""The wheel's dynamics and simulations: what they are, in which shapes, and what is refused."""

import copy
import pickle
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import pyplatewash as pw
from wheel_plans import paper_run
from wheel_plans import plan as planned

Floats = npt.NDArray[np.float64]
ROBOT = pw.Robot.irb120()
TOOL_M = 0.15  # that of the kitchen


@pytest.fixture(scope="module")
def model() -> pw.DynamicsModel:
    return pw.DynamicsModel(ROBOT, pw.Tool(length_m=0.15))


@pytest.fixture(scope="module")
def plan() -> pw.Plan:
    return planned("kitchen")


@pytest.fixture(scope="module")
def execution(plan: pw.Plan) -> pw.Execution:
    return pw.simulate(plan)


def states(n: int) -> tuple[Floats, Floats, Floats]:
    rng = np.random.default_rng(6)
    return rng.uniform(ROBOT.lower, ROBOT.upper, (n, 6)), rng.normal(size=(n, 6)), rng.normal(size=(n, 6))


def test_one_row_and_many_are_the_same_to_the_bit(model: pw.DynamicsModel) -> None:
    q, qd, qdd = states(3000)
    for call, arguments, item in [
        (model.inverse_dynamics, (q, qd, qdd), (6,)),
        (model.forward_dynamics, (q, qd, qdd), (6,)),
        (model.mass_matrix, (q,), (6, 6)),
        (model.gravity_torque, (q,), (6,)),
        (model.coriolis_torque, (q, qd), (6,)),
        (model.bias_torque, (q, qd), (6,)),
    ]:
        many = call(*arguments)  # type: ignore[operator]
        assert many.shape == (3000, *item)
        for row in (0, 1, 2999):
            one = call(*(argument[row] for argument in arguments))  # type: ignore[operator]
            assert one.shape == item
            np.testing.assert_array_equal(one, many[row])
        assert call(*(argument[:0] for argument in arguments)).shape == (0, *item)  # type: ignore[operator]
    energy = model.energy(q, qd)
    assert np.shape(energy.kinetic_j) == np.shape(energy.total_j) == (3000,)
    one = model.energy(q[7], qd[7])
    assert isinstance(one.kinetic_j, float)
    assert isinstance(energy.kinetic_j, np.ndarray) and one.kinetic_j == energy.kinetic_j[7]


def test_the_equation_of_motion_holds(model: pw.DynamicsModel) -> None:
    q, qd, qdd = states(2000)
    mass = model.mass_matrix(q)
    torque = np.einsum("nij,nj->ni", mass, qdd) + model.coriolis_torque(q, qd) + model.gravity_torque(q)
    np.testing.assert_allclose(torque, model.inverse_dynamics(q, qd, qdd), rtol=1e-11, atol=1e-11)
    np.testing.assert_allclose(model.forward_dynamics(q, qd, torque), qdd, rtol=1e-8, atol=1e-8)
    np.testing.assert_array_equal(model.bias_torque(q, qd), model.inverse_dynamics(q, qd, np.zeros(6)))
    kinetic = 0.5 * np.einsum("ni,nij,nj->n", qd, mass, qd)
    np.testing.assert_allclose(model.energy(q, qd).kinetic_j, kinetic, rtol=1e-12)
    # Gravity is the slope of the potential energy.
    step = 1e-6 * np.eye(6)
    still = np.zeros(6)
    higher = model.energy(q[0] + step, still).potential_j
    lower = model.energy(q[0] - step, still).potential_j
    np.testing.assert_allclose((higher - lower) / 2e-6, model.gravity_torque(q[0]), atol=1e-6)


def test_one_row_broadcasts_to_many(model: pw.DynamicsModel) -> None:
    q, qd, qdd = states(5)
    each = model.inverse_dynamics(q, np.tile(qd[0], (5, 1)), qdd)
    np.testing.assert_array_equal(model.inverse_dynamics(q, qd[0], qdd), each)
    with pytest.raises(pw.ShapeError) as caught:
        model.inverse_dynamics(q, qd, qdd[:4])
    assert caught.value.argument == "qdd" and caught.value.found == (4, 6)
    with pytest.raises(pw.ShapeError):
        model.mass_matrix(np.zeros((2, 5)))
    assert np.isnan(model.gravity_torque([np.nan] + [0.0] * 5)).any()


def test_dynamics_depend_on_tool_and_gravity() -> None:
    bare, q = pw.DynamicsModel(ROBOT), np.array([0.1, 0.5, 0.2, 0.3, 0.8, 0.1])
    heavy = pw.DynamicsModel(ROBOT, pw.Tool(length_m=0.2, mass_kg=1.5))
    assert heavy.moving_mass_kg == pytest.approx(bare.moving_mass_kg + 1.5)
    assert pw.DynamicsModel(ROBOT, pw.Tool(length_m=0.0, mass_kg=1.5)) == bare
    # A weight at the flange's height over the tool: its torque is the Jacobian's, transposed.
    light = pw.DynamicsModel(ROBOT, pw.Tool(length_m=0.2, mass_kg=1.5, com_m=0.2, inertia_kg_m2=(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)))
    weight = np.array([0.0, 0.0, 1.5 * 9.81, 0.0, 0.0, 0.0])
    push = ROBOT.jacobian(q, tool=pw.Tool(length_m=0.2)).T @ weight
    np.testing.assert_allclose(light.gravity_torque(q) - bare.gravity_torque(q), push, atol=1e-9)
    assert not pw.DynamicsModel(ROBOT, gravity_m_s2=(0.0, 0.0, 0.0)).gravity_torque(q).any()
    wrong: list[dict[str, Any]] = [{"mass_kg": -1.0}, {"mass_kg": np.nan}, {"inertia_kg_m2": (1.0, 0.0, 0.0, 1.0, 0.0, 3.0)}, {"com_m": np.inf}]
    for bad in wrong:
        with pytest.raises(pw.InputError, match="tool"):
            pw.DynamicsModel(ROBOT, pw.Tool(length_m=0.2, **bad))
    with pytest.raises(pw.InputError, match="gravity"):
        pw.DynamicsModel(ROBOT, gravity_m_s2=(0.0, 0.0, np.nan))


def test_an_arm_without_masses_is_refused_by_name() -> None:
    text = ROBOT.urdf
    start, end = text.index("<inertial>", text.index('<link name="link_3">')), text.index("</inertial>", text.index('<link name="link_3">'))
    massless = pw.Robot.from_urdf(text[:start] + text[end + len("</inertial>") :])
    with pytest.raises(pw.DynamicsError, match="link_3") as caught:
        pw.DynamicsModel(massless)
    assert pickle.loads(pickle.dumps(caught.value)).link == "link_3"


def test_an_execution_equals_the_files_of_the_command(platewash: Path, tmp_path: Path, plan: pw.Plan, execution: pw.Execution) -> None:
    plan.save(tmp_path / "plan.json")
    subprocess.run([platewash, "simulate", tmp_path / "plan.json", "--quiet", "--out", tmp_path], check=True, capture_output=True)
    report = execution.report()
    # A plan's file knows no negative zeros, which equal the positive ones.
    read = pw.simulate(pw.Plan.load(tmp_path / "plan.json"))
    assert read == execution and (tmp_path / "simulated.csv").read_text() == read.to_csv()
    whole = (tmp_path / "simulation.txt").read_text()
    assert whole.startswith(str(report).split("\npayload")[0]) and "\nforce on plates, N" in whole
    assert report.verdict == "washed" and report.law == execution.settings.law == "computed_torque"
    n = len(execution)
    assert execution.t_s.shape == execution.segment.shape == (n,) and execution.t_s[-1] == report.duration_s
    for rows in (execution.q_rad, execution.qd_rad_s, execution.qdd_rad_s2, execution.torque_n_m, execution.commanded_rad):
        assert rows.shape == (n, 6)
    asked = plan.trajectory.at(execution.t_s)[0]
    np.testing.assert_array_equal(execution.commanded_rad, asked)
    off = np.linalg.norm(tips(execution.q_rad) - tips(asked), axis=1)
    assert report.tracking.tip_m.rms == pytest.approx(np.sqrt(np.mean(off**2)), rel=1e-6)
    largest = np.abs(execution.torque_n_m).max(axis=0)
    np.testing.assert_allclose([joint.torque_n_m.max for joint in report.effort.joints], largest)


def tips(q: Floats) -> Floats:
    return ROBOT.fk(q, tool=pw.Tool(length_m=TOOL_M))[:, :3, 3]


def test_each_step_agrees_with_the_plant() -> None:
    plan = planned("kitchen-spiral")  # its plates do not push back
    execution = pw.simulate(plan)
    model = pw.DynamicsModel(ROBOT, pw.Tool(length_m=TOOL_M, mass_kg=plan.job.workcell.tool.mass.mass_kg))
    q, qd, qdd = execution.q_rad[:-1], execution.qd_rad_s[:-1], execution.qdd_rad_s2[:-1]
    np.testing.assert_allclose(model.forward_dynamics(q, qd, execution.torque_n_m[:-1]), qdd, rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(execution.qd_rad_s[1:], qd + qdd * execution.period_s, rtol=1e-12, atol=1e-15)


def test_control_laws_differ_as_expected(plan: pw.Plan) -> None:
    rms = {}
    for law in ("pd", "pd_gravity", "computed_torque"):
        settings = pw.SimulationSettings.of(plan).replace(law=law, control={"frequency_rad_s": 20.0}, plant={"contact_stiffness_pa": None})
        report = pw.simulate(plan, settings=settings).report()
        rms[law] = report.tracking.tip_m.rms
        assert report.law == law and (report.verdict == "washed") == (law != "pd"), report.headline
    assert rms["pd"] > 10 * rms["pd_gravity"] > 100 * rms["computed_torque"]


def test_settings_are_read_changed_and_refused(plan: pw.Plan) -> None:
    settings = pw.SimulationSettings.of(plan)
    assert settings == pw.SimulationSettings("computed_torque", control=settings.control, plant=settings.plant) == settings.replace()
    other = settings.replace(law="pd", control={"rate_hz": 2000, "joint_kp": np.full(6, 300.0), "joint_kd": [9] * 6}, plant={"integrator": "rk4"})
    assert (other.law, other.period_s, other.plant.integrator, other.control.joint_kp) == ("pd", 5e-4, "rk4", [300.0] * 6)
    assert other.replace(control={"joint_kp": None, "joint_kd": None}).control == settings.replace(control={"rate_hz": 2000}).control
    assert settings.law == "computed_torque"
    with pytest.raises(pw.InputError, match="pd_gravity"):
        pw.SimulationSettings("pid")  # type: ignore[arg-type]
    with pytest.raises(pw.InputError, match="law"):
        pw.SimulationSettings("pd", control={"law": "pd"})
    with pytest.raises(pw.ScenarioError) as caught:
        settings.replace(control={"frequency_rad_s": -1})
    assert caught.value.key == "control.frequency_rad_s" and caught.value.found == "-1"
    with pytest.raises(pw.ScenarioError, match="did you mean 'plant.substeps'"):
        settings.replace(plant={"substep": 2})
    with pytest.raises(pw.ScenarioError, match="joint_kd"):
        settings.replace(control={"joint_kp": [1.0] * 6})
    rated = settings.replace(payload_kg=0.2)
    assert settings.payload_kg is None and rated.payload_kg == rated.replace(law="pd").payload_kg == 0.2
    assert pw.simulate(plan, settings=rated).report().verdict == "overloaded"
    with pytest.raises(pw.ScenarioError, match="payload_kg"):
        settings.replace(payload_kg=-1.0)


def test_states_why_a_plan_cannot_be_simulated(plan: pw.Plan) -> None:
    settings = pw.SimulationSettings.of(plan)
    with pytest.raises(pw.SimulationError) as caught:
        pw.simulate(plan, settings=settings.replace(law="pd_gravity", control={"frequency_rad_s": 900.0}))
    error = pickle.loads(pickle.dumps(caught.value))
    assert error.cause == "unstable" and error.q.shape == (6,)
    assert error.least_rate_hz > 1000 and error.highest_frequency_rad_s < 900
    pw.simulate(plan, settings=settings.replace(law="pd_gravity", control={"frequency_rad_s": 0.99 * error.highest_frequency_rad_s}))
    other = pw.Robot.from_urdf(ROBOT.urdf.replace("</robot>", "<!-- another one --></robot>"))
    with pytest.raises(pw.SimulationError) as caught:
        pw.simulate(plan, robot=other)
    assert caught.value.cause == "other_arm"
    with pytest.raises(pw.SimulationError) as caught:
        pw.simulate(plan, settings=settings.replace(plant={"substeps": 1000}, control={"rate_hz": 10000}))
    assert caught.value.cause == "too_long"
    with pytest.raises(pw.InputError, match="dt_s"):
        pw.simulate(plan).to_csv(0.0)


def test_tune_equals_its_simulations(plan: pw.Plan) -> None:
    settings = pw.SimulationSettings.of(plan).replace(law="pd_gravity")
    rows = pw.tune(plan, [15.0, 900.0], [0.7, 1.0], settings=settings)
    assert [(row.frequency_rad_s, row.damping_ratio) for row in rows] == [(15, 0.7), (15, 1), (900, 0.7), (900, 1)]
    assert [row.verdict for row in rows[2:]] == ["refused"] * 2 and "Hz" in rows[2].reason
    report = pw.simulate(plan, settings=settings.replace(control={"frequency_rad_s": 15.0, "damping_ratio": 0.7})).report()
    assert rows[0].tip_rms_m == report.tracking.tip_m.rms and rows[0].work_j == report.effort.work_j
    with pytest.raises(pw.InputError, match="no frequency"):
        pw.tune(plan, [15.0], settings=settings.replace(law="exact"))
    with pytest.raises(pw.InputError, match="at most"):
        pw.tune(plan, np.ones(200), np.ones(200))
    assert pw.tune(plan, []) == []


def test_all_objects_pickle_copy_and_compare(model: pw.DynamicsModel, execution: pw.Execution) -> None:
    for thing in (model, execution, execution.settings, execution.settings.replace(law="pd", plant={"torque_limit_n_m": [9.0] * 6}), model.energy([0.0] * 6, [1.0] * 6)):
        again = pickle.loads(pickle.dumps(thing))
        assert again == thing and copy.copy(thing) == copy.deepcopy(thing) == thing
        assert not thing == 3 and repr(thing) == repr(again)
    assert pw.DynamicsModel(ROBOT) != model
    assert execution.settings != execution.settings.replace(law="pd")


def test_threads_give_the_simulation_of_one(plan: pw.Plan, execution: pw.Execution) -> None:
    with ThreadPoolExecutor(4) as threads:
        assert all(again == execution for again in threads.map(lambda _: pw.simulate(plan), range(4)))


def test_the_papers_job_runs_under_its_own_law() -> None:
    plan = paper_run("paper-appendix").plan()
    execution = pw.simulate(plan)
    assert execution.settings.law == "paper" and execution.torque_limit_n_m is None and not execution.torque_n_m.any()
    report = execution.report()
    assert report.verdict == "not_swept" and report.effort is None and str(report).startswith("NOT SWEPT")


def test_plates_push_back_with_stated_stiffness(plan: pw.Plan) -> None:
    none = pw.SimulationSettings.of(plan).replace(plant={"contact_stiffness_pa": None, "contact_damping_pa_s": None, "contact_force_n": None})
    free = pw.simulate(plan, settings=none)
    assert free.force_n is None and free.compression_m is None and free.report().plates[0].pressing is None
    foam = none.replace(plant={"contact_stiffness_pa": 20e3})
    assert foam.plant.contact_stiffness_pa == 20e3 and foam == copy.deepcopy(foam) == pickle.loads(pickle.dumps(foam)) != none
    assert foam.replace(plant={"contact_stiffness_pa": None}) == none
    damped = foam.replace(plant={"contact_damping_pa_s": 50})
    assert damped.plant.contact_damping_pa_s == 50.0 and pickle.loads(pickle.dumps(damped)) == damped
    execution = pw.simulate(plan, settings=foam)
    force, compression = execution.force_n, execution.compression_m
    assert force is not None and compression is not None and force.shape == compression.shape == execution.t_s.shape
    assert ((force > 0) == (compression > 0)).all() and 1.0 < force.max() < 40.0
    report = execution.report()
    for outcome in report.plates:
        pressing = outcome.pressing
        assert 0 <= pressing.least_n < pressing.mean_n < pressing.most_n and 0 < pressing.strain < 0.6
        assert [at.higher_m for at in pressing.planned] == [-0.002, -0.001, 0.0, 0.001, 0.002]
        means = [at.mean_n for at in pressing.planned]
        assert means == sorted(means) and means[0] > 0
    assert execution.to_csv(0.1).splitlines()[0].endswith(",tau6_n_m,force_n")
    kinematic = pw.simulate(plan, settings=foam.replace(law="exact"))
    assert kinematic.force_n is None
    with pytest.raises(pw.ScenarioError, match="contact_force_n"):
        foam.replace(plant={"contact_force_n": 5.0})
    with pytest.raises(pw.ScenarioError, match="contact_damping_pa_s"):
        none.replace(plant={"contact_damping_pa_s": 5.0})
    with pytest.raises(pw.ScenarioError, match="contact_stiffness_pa"):
        none.replace(plant={"contact_stiffness_pa": 0.0})
    with pytest.raises(pw.SimulationError, match="must be within tool.sponge_stiffness_kpa, 11 to 44 kPa"):
        pw.simulate(plan, settings=foam.replace(plant={"contact_stiffness_pa": 1e9}))
    stiff = planned(pw.Scenario.load("kitchen-spiral").replace(tool={"sponge_stiffness_kpa": [11, 1e6]}))
    with pytest.raises(pw.SimulationError, match="is not stable") as caught:
        pw.simulate(stiff, settings=foam.replace(plant={"contact_stiffness_pa": 1e9}, control={"rate_hz": 200.0}))
    substeps, rate_hz = caught.value.least_substeps, caught.value.least_rate_hz
    assert caught.value.cause == "stiff_contact" and substeps is not None and rate_hz is not None
    assert substeps > 1 and rate_hz > 200.0
