//! The world in which plates are washed, and the words for it.
//!
//! Conventions (units, frames, order of twists) are those of [`platewash_kinematics`]; `docs/conventions.md` has the words.
//!
//! | concept | module |
//! | --- | --- |
//! | mount, arm, tool, obstacles, pairs that are left out | [`workcell`], [`tool`], [`tool_chain`], [`obstacle`] |
//! | plates, and where they lie | [`plate`], [`surface`], [`layout`] |
//! | jobs and their simulation settings, resolved | [`job`], [`simulation`] |
//! | the wash path on a plate; the arc between plates | [`wash_path`], [`arc`] |
//! | a motion and its segments; a controller's motion; tables of both as CSV | [`trajectory`], [`piecewise`], [`csv`] |
//! | the plan file; fields in which two jobs differ | [`plan`]; [`differences`] |
//! | dry runs of a plan in the air; the mount of the arm at the table | [`dry_run`]; [`align`] |
//! | distances between bodies | [`clearance`] |
//! | the share of a plate that is swept | [`coverage`] |
//! | the pressure of a sponge on a plate | [`contact`] |
//! | mass, centre and inertia of shapes | [`uniform`] |
//! | random streams; values in heaps; cancelling; verdicts; words of messages | [`random`]; [`ranked`]; [`cancel`]; [`verdict`]; [`words`] |
//! | files: JSON, tables of numbers, files that appear whole | [`json`], [`number_table`], [`atomic_file`] |

pub mod align;
pub mod arc;
pub mod atomic_file;
pub mod cancel;
pub mod clearance;
pub mod contact;
pub mod coverage;
pub mod csv;
pub mod differences;
pub mod dry_run;
pub mod fixtures;
pub mod job;
pub mod json;
pub mod layout;
pub mod number_table;
pub mod obstacle;
pub mod piecewise;
pub mod plan;
pub mod plate;
pub mod pose;
pub mod random;
pub mod ranked;
pub mod simulation;
pub mod surface;
pub mod tool;
pub mod tool_chain;
pub mod trajectory;
pub mod uniform;
pub mod verdict;
pub mod wash_path;
pub mod words;
pub mod workcell;

pub(crate) use platewash_kinematics::trig;
