//! Settings of the inverse kinematics, and solvers that are kept between calls.

use crate::{argument, exception};
use platewash::kinematics::ik::{AnalyticStarts, Method, RandomRestarts, Start};
use platewash::{Frame, IkSettings, IkSolution, IkSolver, RobotModel};
use pyo3::prelude::*;
use std::sync::{Arc, Mutex, PoisonError};

/// Number of solvers kept; each holds a list of starts that takes some 100 µs to make.
const KEPT: usize = 8;

/// Largest number of iterations or restarts; nobody waits for more.
const MOST_COUNT: u64 = 1_000_000_000;

/// The solvers used last, the latest at the end.
#[derive(Debug, Default)]
pub struct Solvers(Mutex<Vec<Arc<IkSolver<'static>>>>);

/// Fields of Python's `IkSettings`.
#[derive(Debug)]
struct Fields {
    position_tolerance_m: f64,
    orientation_tolerance_rad: f64,
    max_iterations: usize,
    max_qp_iterations: usize,
    step_bound_rad: f64,
    analytic_starts: bool,
    listed_starts: usize,
    random_restarts: usize,
    random_seed: u64,
}

impl Fields {
    fn read(value: &Bound<'_, PyAny>) -> PyResult<Self> {
        let at = |field| (("settings", "an IkSettings"), value, ("settings", field));
        let number = |field| {
            let (whole, value, place) = at(field);
            argument::field(whole, value, place, argument::number)
        };
        let count = |field, least| {
            let (whole, value, place) = at(field);
            argument::field(whole, value, place, |name, value| {
                argument::count(name, value, [least, MOST_COUNT])
            })
        };
        let (whole, value, place) = at("analytic_starts");
        let analytic_starts = argument::field(whole, value, place, argument::flag)?;
        let (whole, value, place) = at("random_seed");
        Ok(Self {
            position_tolerance_m: number("position_tolerance_m")?,
            orientation_tolerance_rad: number("orientation_tolerance_rad")?,
            max_iterations: count("max_iterations", 1)?,
            max_qp_iterations: count("max_qp_iterations", 0)?,
            step_bound_rad: number("step_bound_rad")?,
            analytic_starts,
            listed_starts: count("listed_starts", 0)?,
            random_restarts: count("random_restarts", 0)?,
            random_seed: argument::field(whole, value, place, argument::seed)?,
        })
    }
}

/// The settings of the argument called `settings`.
///
/// # Errors
/// `InputTypeError` for what is no `IkSettings`, or a field of a wrong type; `InputError` for one out of its range.
pub fn settings(value: &Bound<'_, PyAny>) -> PyResult<IkSettings> {
    let settings = IkSettings::from(Fields::read(value)?);
    settings.validate().map_err(|e| {
        let problem = format!("must be {}; found {}", e.expected, e.found);
        exception::input(value.py(), &format!("settings.{}", e.name), &problem)
    })?;
    Ok(settings)
}

impl From<Fields> for IkSettings {
    fn from(fields: Fields) -> Self {
        let restarts = RandomRestarts {
            seed: fields.random_seed,
            count: fields.random_restarts,
        };
        Self {
            position_tolerance_m: fields.position_tolerance_m,
            orientation_tolerance_rad: fields.orientation_tolerance_rad,
            max_iterations: fields.max_iterations,
            max_qp_iterations: fields.max_qp_iterations,
            step_bound_rad: fields.step_bound_rad,
            analytic_starts: if fields.analytic_starts {
                AnalyticStarts::Used
            } else {
                AnalyticStarts::Unused
            },
            listed_starts: fields.listed_starts,
            random_restarts: (restarts.count > 0).then_some(restarts),
        }
    }
}

impl Solvers {
    /// The solver for a frame of the arm that these are for, kept from an earlier call or new.
    pub fn solver(
        &self,
        py: Python<'_>,
        robot: &RobotModel,
        frame: Frame,
        settings: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Arc<IkSolver<'static>>> {
        let settings = match settings {
            None => IkSettings::default(),
            Some(given) => self::settings(given)?,
        };
        let mut kept = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let same = |s: &Arc<IkSolver<'static>>| *s.frame() == frame && *s.settings() == settings;
        if let Some(found) = kept.iter().rev().find(|s| same(s)) {
            return Ok(found.clone());
        }
        let new =
            IkSolver::new(robot, frame, settings).map_err(|e| exception::input(py, "settings", &e.to_string()))?;
        let new = Arc::new(new.into_owned());
        if kept.len() >= KEPT {
            kept.remove(0);
        }
        kept.push(new.clone());
        Ok(new)
    }
}

/// Method that answered, and the start from which the answer was found, in words.
pub fn origin(solution: &IkSolution) -> (&'static str, String) {
    let method = match solution.method {
        Method::Dls => "dls",
        Method::Qp => "qp",
    };
    let start = match solution.start {
        Start::Seed => "seed".to_owned(),
        Start::Analytic => "analytic".to_owned(),
        Start::Listed(k) => format!("listed {k}"),
        Start::Random(k) => format!("random {k}"),
    };
    (method, start)
}
