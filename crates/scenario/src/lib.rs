//! The scenario file: everything that decides a job, in TOML with the unit in every key's name; the jobs that it states; and the
//! keys in the messages of whoever could not carry them out.
//!
//! [`keys`] is the one table of keys, units, ranges and meanings: it checks files and makes
//! `docs/scenario.md`. The defaults are those of the types here.
//!
//! [`Scenario::load`] reads a file, [`Scenario::job`] and [`Scenario::paper_job`] resolve it, with `arm`, `layout`, `place` and `job_on` for
//! whoever wants the steps one by one. [`Draft`] changes a scenario's text key by key. Errors of other crates become a [`Failure`] by `?`; its words name the keys.

mod arm;
mod body_error;
mod body_shape;
mod certified;
mod contact;
mod control;
mod document;
mod draft;
mod error;
mod failure;
mod fits;
mod form;
mod ik;
mod job;
mod key;
pub mod keys;
mod layout;
mod limits;
mod line;
mod listed;
mod lists;
mod load;
mod nearest;
mod obstacle;
mod paths;
mod placement;
mod plant;
mod plate;
mod plates;
mod poses;
mod remedy;
mod resolve;
mod robot;
mod room;
mod scenario;
mod seed;
mod shipped;
mod solids;
mod source;
mod suggest;
mod surroundings;
mod tool;
mod tool_body;
mod tool_on_arm;
mod transition;
mod units;
mod unknown;
mod value;
mod values;
mod wash;
mod work;
mod write;

pub use arm::{ArmError, load_arm, load_description};
pub use body_error::{BodyError, BodyFault, BodySection};
pub use body_shape::{BodyShape, StatedShape};
pub use control::{ControlSection, TIME_STEPS_S};
pub use document::reference;
pub use draft::{Draft, EditError};
pub use error::{Problem, ScenarioError};
pub use failure::Failure;
pub use form::{FormDomain, FormKey, form};
pub use ik::IkSection;
pub use job::{JobSection, OnFailure, Program};
pub use layout::{LayoutSection, RegionName};
pub use limits::LimitsSection;
pub use lists::{LISTS, List};
pub use obstacle::{HeldPlates, MeshPartsName, ObstacleSection};
pub use plant::{PlantSection, plant_keys};
pub use plate::{Faces, PlateSection};
pub use remedy::{MOST_TRIALS, Remedies, Remedy};
pub use robot::{BuiltInArm, RobotSection};
pub use room::{FloorSection, TableSection};
pub use scenario::Scenario;
pub use seed::check_seed;
pub use shipped::{SHIPPED, ShippedScenario};
pub use solids::Solids;
pub use source::{ScenarioSource, source};
pub use suggest::Suggestion;
pub use tool::{ASSUMED_STIFFNESS_KPA, HandleName, ToolSection};
pub use tool_body::{BodyFrame, ToolBodySection};
pub use transition::TransitionSection;
pub use units::Note;
pub use values::values_of;
pub use wash::WashSection;
pub use work::MAX_CONTACT_CHECKS;
