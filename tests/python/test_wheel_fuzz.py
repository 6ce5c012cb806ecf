"""Whatever is thrown at the wheel, it answers or raises an exception with words in it."""

import os
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

import pyplatewash as pw
from wheel_plans import paper_run

ROBOT = pw.Robot.irb120()
DYNAMICS = pw.DynamicsModel(ROBOT)
PLAN = paper_run("paper-appendix").plan()
NUMBERS = st.floats(allow_nan=True, allow_infinity=True) | st.integers(-(2**80), 2**80) | st.sampled_from([1e308, -1e308, 5e-324])
SHAPES = hnp.array_shapes(min_dims=0, max_dims=4, min_side=0, max_side=7) | st.sampled_from([(6,), (3, 6), (0, 6), (4, 4), (2, 4, 4), (5, 2)])
DTYPES = st.one_of(
    hnp.floating_dtypes(), hnp.integer_dtypes(), hnp.unsigned_integer_dtypes(), hnp.complex_number_dtypes(), hnp.boolean_dtypes(),
    hnp.datetime64_dtypes(), hnp.byte_string_dtypes(), hnp.unicode_string_dtypes(), st.just(np.dtype(object)),
)


@st.composite
def arrays(draw: st.DrawFn) -> Any:
    """Arrays of any shape, type and order, often of the right shape."""
    dtype, shape = draw(DTYPES), draw(SHAPES)
    if dtype == object:
        array = np.full(shape, draw(st.sampled_from([None, "x", 1, 2.5, [1]])), dtype=object) if shape else np.array(None, object)
    else:
        array = draw(hnp.arrays(dtype, shape))
    how = draw(st.sampled_from(["as it is", "fortran", "reversed", "read-only", "list"]))
    if how == "fortran":
        return np.asfortranarray(array)
    if how == "reversed":
        return array[..., ::-1] if array.ndim else array
    if how == "read-only":
        array.flags.writeable = False
    return array.tolist() if how == "list" else array


ANYTHING = st.one_of(
    arrays(), NUMBERS, st.none(), st.text(max_size=4), st.binary(max_size=4), st.dictionaries(st.text(max_size=2), NUMBERS, max_size=2),
    st.lists(st.lists(NUMBERS, max_size=7), max_size=4), st.just(ROBOT), st.just(pw.Tool()), st.just(object()), st.just(np.ma.masked),
)
FINITE: dict[str, Any] = {"max_examples": 300 if "PLATEWASH_THOROUGH" in os.environ else 60, "derandomize": True, "database": None, "deadline": None, "suppress_health_check": list(HealthCheck)}

CALLS = {
    "fk": lambda a, b, c: ROBOT.fk(a, b if isinstance(b, str) else None, tool=c),
    "fk of anything": lambda a, b, c: ROBOT.fk(a),
    "jacobian": lambda a, b, c: ROBOT.jacobian(a, axes="base" if b is None else b),
    "manipulability": lambda a, b, c: ROBOT.manipulability(a),
    "limit_margins": lambda a, b, c: ROBOT.limit_margins(a),
    "ik": lambda a, b, c: ROBOT.ik(a, b, settings=c if c is not None else None),
    "ik_all": lambda a, b, c: ROBOT.ik_all(a, b),
    "ik_path": lambda a, b, c: ROBOT.ik_path(a, b),
    "ik_batch": lambda a, b, c: ROBOT.ik_batch(a, b),
    "trajectory": lambda a, b, c: pw.Trajectory(a, b, c),
    "through": lambda a, b, c: pw.Trajectory.through(a, b),
    "at": lambda a, b, c: pw.Trajectory([0.0, 1.0], np.zeros((2, 6)), np.ones((2, 6))).at(a),
    "clearance": lambda a, b, c: pw.ClearanceModel(ROBOT).distances(a),
    "smallest": lambda a, b, c: pw.ClearanceModel(ROBOT).smallest(a, b),
    "model": lambda a, b, c: pw.ClearanceModel(ROBOT, a, b),
    "tool": lambda a, b, c: ROBOT.fk([0.0] * 6, tool=pw.Tool(length_m=a, radius_m=b)),
    "dynamics": lambda a, b, c: pw.DynamicsModel(ROBOT, a, gravity_m_s2=b),
    "tool with mass": lambda a, b, c: pw.DynamicsModel(ROBOT, pw.Tool(length_m=0.1, mass_kg=a, com_m=b, inertia_kg_m2=c)),
    "inverse dynamics": lambda a, b, c: DYNAMICS.inverse_dynamics(a, b, c),
    "inverse dynamics of anything": lambda a, b, c: DYNAMICS.inverse_dynamics(a, [0.0] * 6, a),
    "forward dynamics": lambda a, b, c: DYNAMICS.forward_dynamics(a, a, [0.0] * 6),
    "mass matrix": lambda a, b, c: DYNAMICS.mass_matrix(a),
    "gravity torque": lambda a, b, c: DYNAMICS.gravity_torque(a),
    "coriolis torque": lambda a, b, c: DYNAMICS.coriolis_torque(a, b),
    "bias torque": lambda a, b, c: DYNAMICS.bias_torque(a, b),
    "energy": lambda a, b, c: DYNAMICS.energy(a, b),
    "settings": lambda a, b, c: pw.SimulationSettings(a, control=b, plant=c),
    "settings of numbers": lambda a, b, c: pw.SimulationSettings("pd", control={"rate_hz": a, "joint_kp": b, "joint_kd": c}, plant={"substeps": a}, payload_kg=b),
    "simulate": lambda a, b, c: pw.simulate(PLAN, a, b),
    "simulate anything": lambda a, b, c: pw.simulate(a, b, c),
    "executed csv": lambda a, b, c: pw.simulate(PLAN).to_csv(a),
    "tune": lambda a, b, c: pw.tune(PLAN, a, b, settings=pw.SimulationSettings("pd")),
    "tune anything": lambda a, b, c: pw.tune(PLAN, a, b, c),
    "coverage": lambda a, b, c: pw.coverage(a, b, 0.1, 0.02),
    "coverage of lengths": lambda a, b, c: pw.coverage([[0.0, 0.0]], [0, 0], a, b, cell_m=0.01),
    "raster": lambda a, b, c: pw.coverage_raster(a, b, 0.1, 0.02, cells=9),
    "spiral": lambda a, b, c: pw.PaperSpiral(turns=a, radius_m=b).waypoints(c),
    "wash curve": lambda a, b, c: pw.WashCurve(radius_m=a, turns=b, start_angle_rad=c).sample(1e-3),
    "transit": lambda a, b, c: pw.transit_waypoints(a, b),
    "cubic": lambda a, b, c: pw.cubic_samples(a, 20),
    "from_dict": lambda a, b, c: pw.Scenario.from_dict(a),
    "replace": lambda a, b, c: pw.Scenario.load("kitchen").replace(seed=a, layout=b, tool=c),
    "load": lambda a, b, c: pw.Scenario.load(a),
    "parse": lambda a, b, c: pw.Scenario.parse(a),
    "urdf": lambda a, b, c: pw.Robot.from_urdf(a, srdf=b),
    "plan file": lambda a, b, c: pw.Plan.from_json(a),
    "job": lambda a, b, c: pw.Scenario.load("kitchen").job(a),
    "plan": lambda a, b, c: pw.plan(a),
    "paper": lambda a, b, c: pw.run_paper(a),
    "prove": lambda a, b, c: pw.prove(a, b),
    "differences": lambda a, b, c: pw.differences(PLAN, a),
    "plan csv": lambda a, b, c: PLAN.to_csv(a, b),
    "reproduce": lambda a, b, c: pw.reproduce(a, b, c) if not all(v is None or isinstance(v, int) and 0 < v for v in (a, b)) else None,
}


@pytest.mark.parametrize("call", CALLS.values(), ids=CALLS.keys())
def test_no_call_crashes(call: Any) -> None:
    @settings(**FINITE)
    @given(ANYTHING, ANYTHING, ANYTHING)
    def check(a: Any, b: Any, c: Any) -> None:
        try:
            call(a, b, c)
        except pw.PlatewashError as error:
            assert not isinstance(error, pw.InternalError), error
            assert str(error).strip()

    check()


@settings(**FINITE)
@given(hnp.arrays(float, (6,), elements=st.floats(-1e3, 1e3)), hnp.arrays(float, (3,), elements=st.floats(-2, 2)))
def test_ik_answers_or_states_its_error(q: npt.NDArray[np.float64], shift: npt.NDArray[np.float64]) -> None:
    target = ROBOT.fk(q)
    target[:3, 3] += shift
    try:
        answer = ROBOT.ik(target, q)
        assert (ROBOT.limit_margins(answer.q) >= 0).all()
        np.testing.assert_allclose(ROBOT.fk(answer.q), target, atol=3e-6)
    except pw.IkError as error:
        assert (ROBOT.limit_margins(error.q) >= 0).all()
        assert error.position_error_m is not None and error.orientation_error_rad is not None
        assert error.position_error_m > 1e-6 or error.orientation_error_rad > 1e-6


@settings(**FINITE)
@given(st.recursive(st.none() | st.booleans() | NUMBERS | st.text(max_size=3), lambda x: st.lists(x, max_size=3) | st.dictionaries(st.sampled_from(["seed", "layout", "wash", "turns", "count", "positions_m", "name", "robot", "urdf"]), x, max_size=4), max_leaves=12))
def test_dictionaries_are_scenarios_or_refused(table: Any) -> None:
    try:
        scenario = pw.Scenario.from_dict(table)
        assert pw.Scenario.from_dict(scenario.to_dict()) == scenario
    except pw.PlatewashError as error:
        assert str(error)


def test_rejects_values_that_contain_themselves() -> None:
    endless: list[Any] = []
    endless.append(endless)
    with pytest.raises(pw.InputError, match="nested too deep"):
        pw.Scenario.from_dict({"name": endless})
    with pytest.raises(pw.InputTypeError, match="q"):
        ROBOT.fk(endless)
