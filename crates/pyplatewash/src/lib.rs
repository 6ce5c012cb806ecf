//! The Python wheel of platewash: the same nouns, NumPy in and out.
//!
//! This crate holds no logic of its own. It reads arguments (`argument`), turns array-likes into slices and back (`arrays`), errors into exceptions
//! (`errors`), and data into dictionaries (`value`), and works without the interpreter lock (`work`). What is plain data on
//! Python's side (`Tool`, `Plate`, settings, records) are Python dataclasses in `python/pyplatewash`.

mod argument;
mod arrays;
mod certificate;
mod clearance;
mod command;
mod coverage;
mod curves;
mod cycle;
mod dynamics;
mod errors;
mod job;
mod layout;
mod notes;
mod plan;
mod pose;
mod reproduce;
mod robot;
mod scenario;
mod simulation;
mod tool;
mod trajectory;
mod value;
mod work;

use pyo3::prelude::*;

/// The compiled part of pyplatewash; import `pyplatewash` instead.
#[pymodule(gil_used = false)]
mod _core {
    #[pymodule_export]
    use crate::certificate::{CertificateObject, verify};
    #[pymodule_export]
    use crate::clearance::ClearanceObject;
    #[pymodule_export]
    use crate::command::run_command;
    #[pymodule_export]
    use crate::coverage::{measure, picture};
    #[pymodule_export]
    use crate::curves::{_spiral, _stroke, cubic_samples, transition_waypoints};
    #[pymodule_export]
    use crate::cycle::{CycleObject, plan, sweep};
    #[pymodule_export]
    use crate::dynamics::DynamicsObject;
    #[pymodule_export]
    use crate::job::JobObject;
    #[pymodule_export]
    use crate::layout::{LayoutObject, place_plates};
    #[pymodule_export]
    use crate::plan::PlanObject;
    #[pymodule_export]
    use crate::reproduce::reproduce;
    #[pymodule_export]
    use crate::robot::{IkSolutionRecord, Robot};
    #[pymodule_export]
    use crate::scenario::ScenarioObject;
    #[pymodule_export]
    use crate::simulation::{ExecutionObject, SetupObject, simulate, tune};
    #[pymodule_export]
    use crate::tool::_check;
    #[pymodule_export]
    use crate::trajectory::TrajectoryObject;
}
