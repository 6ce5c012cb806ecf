//! Errors of the library as exceptions of `pyplatewash`.

mod file;
mod ik;
mod job;
mod simulation;

pub use crate::errors::file::{FileKind, SystemWord, study, system_file, unread};
pub use crate::errors::ik::{cause, ik, ik_path};
pub use crate::errors::job::{arm_needed, dry_run, failure, no_dry_run, no_recovery, recovery, scenario};
pub use crate::errors::simulation::dynamics;
