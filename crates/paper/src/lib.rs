//! The paper's program to the letter ("Implementation of a Plate Cleaning Robot using ABB IRB 120"): waypoint after waypoint, each
//! solved and followed by a control law. For reproduction and teaching: it mostly does not wash.
//!
//! [`run`] carries out a [`PaperJob`]; [`PaperRun::report`] judges it, [`PaperRun::plan`] makes a plan file of it, and
//! [`reproduce`] measures the results of the program over many layouts.
//!
//! | concept | module |
//! | --- | --- |
//! | settings besides arm, plates and law | [`settings`] |
//! | order of the plates, spiral, cubics, path of the tip | [`order`], [`spiral`], [`cubic`], [`tool_path`] |
//! | inverse kinematics along it and the motion of the arm | [`tracking`] |
//! | report of a run | [`report`] |
//! | the paper's tables, measured | [`reproduce`](mod@reproduce) |
//!
//! Conventions (units, frames, order of twists) are those of [`platewash_kinematics`].

pub mod cubic;
mod error;
mod job;
pub mod order;
mod part;
pub mod report;
pub mod reproduce;
mod run;
pub mod settings;
pub mod spiral;
pub mod tool_path;
pub mod tracking;
mod work;

pub use error::PaperError;
pub use job::PaperJob;
pub use part::PaperPart;
pub use report::PaperReport;
pub use run::{PaperRun, run, run_with};
pub use settings::{PaperSettings, SettingError};
pub use spiral::PaperSpiral;
pub use tool_path::ToolPath;
pub use work::{MAX_PLATE_CHECKS, MAX_WAYPOINTS, WorkError};
