//! The world in which plates are washed, what is wanted of a washing, and the words for both.
//!
//! Conventions (units, frames, order of twists) are those of [`platewash_kinematics`]; `docs/conventions.md` has the words.
//!
//! | concept | module |
//! | --- | --- |
//! | mount, arm, tool, obstacles, pairs that are left out | [`Workcell`], [`tool`], [`Obstacle`] |
//! | plates, and where they lie | [`plate`], [`surface`], [`layout`] |
//! | the terms of a job, resolved; the settings of its simulation | [`job`], [`simulation`] |
//! | the wash path on a plate; the arc between plates | [`wash_path`], [`arc`] |
//! | the statement that a job is a dry run | [`dry_run`] |
//! | random streams; values in heaps; cancelling; verdicts; words of messages | [`random`]; [`ranked`]; [`cancel`]; [`verdict`]; [`words`] |
//! | files: JSON, tables of numbers, files that appear whole | [`json`], [`number_table`], [`atomic_file`] |

pub mod arc;
pub mod atomic_file;
pub mod cancel;
pub mod dry_run;
pub mod job;
pub mod json;
pub mod layout;
pub mod number_table;
pub mod obstacle;
pub mod plate;
pub mod pose;
pub mod random;
pub mod ranked;
pub mod simulation;
pub mod surface;
pub mod tool;
pub mod verdict;
pub mod wash_path;
pub mod words;
mod workcell;

pub use crate::obstacle::{Obstacle, ObstacleShape};
pub use crate::workcell::{ArmId, Exclusion, ExclusionReason, MOST_BODIES, ReducedClearance, Workcell, is_pair};
