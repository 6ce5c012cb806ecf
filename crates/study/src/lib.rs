//! Studies: scenarios × axes, each row planned and proved, and kept as soon as it is done.
//!
//! A study file ([`Study`]) states which rows there are; [`Resolver`] makes one of them a [`Row`], which depends on nothing but the study;
//! [`Journal`] keeps rows in a folder, where a study that was ended goes on; [`run`] works on those that are missing, on rayon's threads.
//! The rows of a study are the same bytes for every number of threads and every order in which they were done.

mod axis;
mod base;
mod done;
mod error;
mod journal;
mod keep;
mod kept;
mod lines;
mod load;
mod made;
mod manifest;
mod named_files;
mod outcome;
mod parts;
mod place;
mod resolve;
mod row;
mod run;
mod statement;
mod study;
mod summary;

pub use axis::{Axis, AxisKind};
pub use base::Base;
pub use error::StudyError;
pub use journal::Journal;
pub use keep::Keep;
pub use kept::{check, counted, export, read_manifest};
pub use made::Made;
pub use manifest::{Manifest, ManifestAxis, ManifestFile, ManifestScenario};
pub use outcome::Outcome;
pub use parts::{PartsFile, StudyParts};
pub use place::Place;
pub use resolve::{Resolver, judged};
pub use row::{ROW_SCHEMA, Row};
pub use run::{Progress, run};
pub use study::{MOST_ROWS, RowAddress, Study};
pub use summary::{AxisValue, Summary, summary};
