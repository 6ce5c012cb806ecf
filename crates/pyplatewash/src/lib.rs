//! The Python wheel of platewash: the same nouns, NumPy in and out.
//!
//! This crate holds no logic of its own. It reads arguments (`argument`), turns array-likes into slices and back (`arrays`), errors into
//! exceptions (`errors`), and data into dictionaries (`value`), and works without the interpreter lock (`work`). What is plain data on
//! Python's side (`Tool`, `Plate`, settings, records) are Python dataclasses in `python/pyplatewash`.

mod argument;
mod arrays;
mod certificate;
mod clearance;
mod coverage;
mod curves;
mod dry_run;
mod dynamics;
mod errors;
mod exception;
mod export;
mod job;
mod layout;
mod live_cell;
mod motion_proof;
mod page;
mod paper;
mod plain_values;
mod plan;
mod planned;
mod plate;
mod pose;
mod recovery;
mod reproduce;
mod robot;
mod scenario;
mod simulation;
mod study;
mod study_journal;
mod study_worker;
mod sweep;
mod tool;
mod trajectory;
mod value;
mod warnings;
mod work;

use pyo3::prelude::*;

/// The compiled part of pyplatewash; import `pyplatewash` instead.
#[pymodule(gil_used = false)]
mod _core {
    #[pymodule_export]
    use crate::argument::{
        _argument_count, _argument_flag, _argument_number, _argument_path, _argument_shown, _argument_texts,
        _argument_word,
    };
    #[pymodule_export]
    use crate::certificate::{CertificateObject, differences, prove};
    #[pymodule_export]
    use crate::clearance::ClearanceObject;
    #[pymodule_export]
    use crate::coverage::{measure, picture};
    #[pymodule_export]
    use crate::curves::{_paper_spiral, _rings_turns, _wash_curve, _wash_curve_on, cubic_samples, transit_waypoints};
    #[pymodule_export]
    use crate::dynamics::DynamicsObject;
    #[pymodule_export]
    use crate::job::{PaperJobObject, WashJobObject};
    #[pymodule_export]
    use crate::layout::LayoutObject;
    #[pymodule_export]
    use crate::live_cell::{_edit_arguments, CellEditorObject, CellQuestionObject};
    #[pymodule_export]
    use crate::motion_proof::prove_motion;
    #[pymodule_export]
    use crate::page::{_configuration_page, _plan_page, _save};
    #[pymodule_export]
    use crate::page::{_plan_figure, _show_arguments};
    #[pymodule_export]
    use crate::paper::{PaperRunObject, run_paper};
    #[pymodule_export]
    use crate::plain_values::_check;
    #[pymodule_export]
    use crate::plan::PlanObject;
    #[pymodule_export]
    use crate::planned::{PlannedObject, plan};
    #[pymodule_export]
    use crate::plate::_plate_made;
    #[pymodule_export]
    use crate::reproduce::reproduce;
    #[pymodule_export]
    use crate::robot::Robot;
    #[pymodule_export]
    use crate::scenario::{_task_region, ScenarioObject, place_plates};
    #[pymodule_export]
    use crate::simulation::{ExecutionObject, SettingsObject, simulate, tune};
    #[pymodule_export]
    use crate::study::{_study_check, _study_summary, StudyObject};
    #[pymodule_export]
    use crate::study_journal::StudyJournalObject;
    #[pymodule_export]
    use crate::study_worker::StudyWorkerObject;
    #[pymodule_export]
    use crate::sweep::sweep;
    #[pymodule_export]
    use crate::trajectory::TrajectoryObject;
    #[pymodule_export]
    use crate::work::{_program, run_command};
}
