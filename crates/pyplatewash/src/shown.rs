//! Figures of a plan, and arguments of the methods that show it on a page: checked before any work is done.

use crate::certificate::CertificateObject;
use crate::page::{bundle, height_px, of_the_plan};
use crate::plan::PlanObject;
use crate::robot::Robot;
use crate::scenario::{self, ScenarioObject};
use crate::simulation::{ExecutionObject, Question};
use crate::work::patiently;
use crate::{argument, errors};
use platewash::viewer::figures::{Figure, Subject, draw};
use platewash::workcell::plan::Process;
use platewash::workcell::workcell::ArmId;
use platewash::{Failure, SimulationReport, paper_spirals};
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

/// A figure of a plan as SVG, of an execution, a certificate, a scenario and an arm.
///
/// Raises what `Plan.figure` says.
#[pyfunction]
pub fn _plan_figure<'py>(
    plan: &Bound<'py, PlanObject>,
    kind: Option<&Bound<'py, PyAny>>,
    of: (Maybe<'py>, Maybe<'py>, Maybe<'py>, Maybe<'py>),
) -> PyResult<String> {
    let (py, (execution, certificate, scenario, robot)) = (plan.py(), &of);
    let execution = ExecutionObject::given(execution.as_ref())?.map(|execution| execution.get());
    let certificate = CertificateObject::given(certificate.as_ref())?.map(|certificate| certificate.get());
    let (robot, scenario) = surroundings(plan, scenario.as_ref(), robot.as_ref())?;
    let kind = kind.map_or(Ok("layout".to_owned()), |kind| {
        argument::text("kind", kind, "a figure's name")
    })?;
    let figure = Figure::named(&kind).map_err(|unknown| errors::input(py, "kind", &unknown.to_string()))?;
    let plan = plan.get();
    let (certificate, done) = of_the_plan(py, plan, execution, certificate)?;
    let (plan, arm) = (plan.inner().clone(), robot.get().model().clone());
    let known = &plan.job.workcell.arm;
    if ArmId::of(&arm).urdf_sha256 != known.urdf_sha256 {
        let words = format!(
            "the plan was made for another arm, '{}'; found '{}'",
            known.name,
            arm.name()
        );
        return Err(errors::input(py, "robot", &words));
    }
    let region = scenario.map(|scenario| scenario.inner().task_region());
    let drawn = patiently(py, move |cancel| {
        let report = done.as_ref().map(|done| {
            let Question { plan, arm, settings } = &done.question;
            SimulationReport::new(plan, arm, settings, &done.execution)
        });
        let report = report.transpose()?;
        let ideal = match plan.process {
            // Of a plan that the program would not make again, they are not known.
            Process::Paper => paper_spirals(&plan, &arm, cancel).ok(),
            Process::Wash => None,
        };
        let draw = || {
            let mut subject = Subject::new(&plan, &arm)?;
            if let (Some(done), Some(report)) = (&done, &report) {
                subject = subject.executed(&done.execution, report)?;
            }
            subject.certificate = certificate.as_ref();
            subject.region = region.unwrap_or_default();
            subject.ideal = ideal.unwrap_or(subject.ideal);
            draw(&subject, figure)
        };
        Ok::<_, Failure>(draw())
    })?;
    let drawn = drawn.map_err(|error| errors::failure(py, &error))?;
    drawn.map_err(|error| errors::keyed(py, "plan", &error.to_string()))
}
