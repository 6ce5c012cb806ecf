//! Arguments of the methods that show a plan, which Python's side carries out: checked before any work is done.

use crate::argument::{self, ANY_COUNT};
use crate::certificate::CertificateObject;
use crate::page::{bundle, height_px};
use crate::plan::PlanObject;
use crate::robot::Robot;
use crate::scenario::{self, ScenarioObject};
use crate::simulation::ExecutionObject;
use pyo3::prelude::*;

/// An argument that may be left out.
type Maybe<'py> = Option<Bound<'py, PyAny>>;

/// The arm, and a scenario.
type Surroundings = (Py<Robot>, Option<ScenarioObject>);

/// The arm and the scenario of arguments.
fn surroundings(
    plan: &Bound<'_, PlanObject>,
    scenario: Option<&Bound<'_, PyAny>>,
    robot: Option<&Bound<'_, PyAny>>,
) -> PyResult<Surroundings> {
    let robot = plan.get().robot_for(plan.py(), Robot::given(robot)?)?;
    let scenario = scenario.map(scenario::given).transpose()?;
    Ok((robot, scenario.map(ScenarioObject::from)))
}

/// Arguments of `Plan.show` and `Plan.view`: the arm, the scenario, whether to prove and to simulate, and the height of a cell [px].
///
/// Raises what the methods raise before they prove or simulate.
#[pyfunction]
pub fn _show_arguments<'py>(
    plan: &Bound<'py, PlanObject>,
    beside: (Maybe<'py>, Maybe<'py>, Maybe<'py>, Maybe<'py>),
    prove: Option<&Bound<'py, PyAny>>,
    simulate: Option<&Bound<'py, PyAny>>,
    height: Option<&Bound<'py, PyAny>>,
    path: Option<&Bound<'py, PyAny>>,
) -> PyResult<(Surroundings, [bool; 2], usize)> {
    let (execution, certificate, scenario, robot) = &beside;
    ExecutionObject::given(execution.as_ref())?;
    CertificateObject::given(certificate.as_ref())?;
    let surroundings = surroundings(plan, scenario.as_ref(), robot.as_ref())?;
    let flag = |name, value: Option<&Bound<'py, PyAny>>| value.map_or(Ok(true), |value| argument::flag(name, value));
    let (prove, simulate) = (flag("prove", prove)?, flag("simulate", simulate)?);
    path.map(|path| argument::path("path", path)).transpose()?;
    let height = height_px(height)?;
    bundle(plan.py())?;
    Ok((surroundings, [prove, simulate], height))
}

/// Arguments of `Plan.figure`: the arm, the scenario, the figure's name and the plate.
///
/// Raises InputTypeError, InputError, and ProveError for a plan whose arm must be given.
#[pyfunction]
pub fn _figure_arguments<'py>(
    plan: &Bound<'py, PlanObject>,
    kind: Option<&Bound<'py, PyAny>>,
    of: (Maybe<'py>, Maybe<'py>, Maybe<'py>, Maybe<'py>),
) -> PyResult<(Surroundings, String, Option<usize>)> {
    let (execution, plate, scenario, robot) = &of;
    ExecutionObject::given(execution.as_ref())?;
    let surroundings = surroundings(plan, scenario.as_ref(), robot.as_ref())?;
    let kind = kind.map_or(Ok("layout".to_owned()), |kind| {
        argument::text("kind", kind, "a figure's name")
    })?;
    let plate = plate.as_ref().map(|plate| argument::count("plate", plate, ANY_COUNT));
    Ok((surroundings, kind, plate.transpose()?))
}
