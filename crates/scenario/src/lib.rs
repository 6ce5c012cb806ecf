//! The scenario file: everything that decides a job, in TOML with the unit in every key's name; the jobs that it states; and
//! messages with its keys for the failures of these jobs.
//!
//! [`keys`] is the one table of keys, units, ranges and meanings: it checks files and makes
//! `docs/scenario.md`. The defaults are those of the types here.
//!
//! [`Scenario::load`] reads a file, [`Scenario::job`] and [`Scenario::paper_job`] resolve it, with `arm`, `layout`, `place` and `job_on` for
//! callers that need the steps one by one. [`ObstacleText`] reads obstacles or a tool alone, for a motion without plates. [`Draft`] changes a scenario's text key by key. Errors of other crates
//! become a [`Failure`] by `?`; its words name the keys.
//!
//! | concept | module |
//! | --- | --- |
//! | sections, their keys, units, ranges and meanings | `sections`, `keys` |
//! | reading and checking a file | `source`, `load`, `scenario`, `units`, `lossy_path` |
//! | from a scenario to its job | `to_job` |
//! | a plate from a mesh or from probed points | [`measured`] |
//! | changing a text key by key | `draft` |
//! | failures and refusals in the words of the keys | `failure`, `error`, `body_error` |
//! | keys that would mend a job; a home and a region for an arm | `remedy`, `suggest` |
//! | obstacles alone, or a tool alone | `obstacle_file` |

mod body_error;
mod cache;
mod draft;
mod error;
mod failure;
pub mod keys;
mod load;
mod lossy_path;
pub mod measured;
mod obstacle_file;
mod remedy;
mod scenario;
mod sections;
mod source;
mod suggest;
mod to_job;
mod units;

pub use crate::body_error::{BodyError, BodyFault, BodySection};
pub use crate::cache::Cache;
pub use crate::draft::{Draft, EditError};
pub use crate::error::{Problem, ScenarioError, TextKind};
pub use crate::failure::Failure;
pub use crate::keys::document::reference;
pub use crate::keys::form::{FormDomain, FormKey, FormRange, form};
pub use crate::keys::table::{LISTS, List};
pub use crate::keys::value::values_of;
pub use crate::obstacle_file::{MeshPlaces, ObstacleText};
pub use crate::remedy::{MOST_TRIALS, Remedies, Remedy};
pub use crate::scenario::{Scenario, check_seed};
pub use crate::sections::body_shape::{BodyShape, StatedShape};
pub use crate::sections::holder::HolderSection;
pub use crate::sections::layout::{Faces, LayoutSection, PlateSection};
pub use crate::sections::motion::{IkSection, JobSection, LimitsSection, OnFailure, Program, TransitionSection};
pub use crate::sections::obstacle::{HeldPlates, MeshPartsName, ObstacleSection};
pub use crate::sections::robot::{BuiltInArm, OriginLink, ReducedClearanceSection, RobotSection};
pub use crate::sections::room::{FloorSection, TableSection};
pub use crate::sections::simulation::{ControlSection, PlantSection, TIME_STEPS_S, plant_keys};
pub use crate::sections::tool::{ASSUMED_STIFFNESS_KPA, BodyFrame, HandleName, ToolBodySection, ToolSection};
pub use crate::sections::wash::WashSection;
pub use crate::source::{ScenarioSource, source};
pub use crate::suggest::Suggestion;
pub use crate::to_job::arm::{ArmError, load_arm, load_arm_with_fixed};
pub use crate::to_job::plate_files::PlateFiles;
pub use crate::to_job::solids::Solids;
pub use crate::to_job::work::MAX_CONTACT_CHECKS;
pub use crate::units::{MeshAs, Note};
pub use platewash_scenarios::{SHIPPED, ShippedScenario};
