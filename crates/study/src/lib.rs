//! Studies: scenarios × axes, each row planned and proved, and kept as soon as it is done.
//!
//! A study file ([`Study`]) states which rows there are; [`RowMaker`] makes one of them a [`Row`], which depends on nothing but the study;
//! [`Journal`] keeps rows in a folder, where a study that was ended goes on; [`run`] works on those that are missing, on rayon's threads.
//! The rows of a study are the same bytes for every number of threads and every order in which they were done.
//!
//! | concept | module |
//! | --- | --- |
//! | the study: its axes and rows; its file; reading it | `study`, `axis`; `study_file`; `study_reader` |
//! | one row, planned and proved | `row_maker`, `row` |
//! | many rows at once | `run` |
//! | a study of seeds alone, without a folder | `sweep` |
//! | the folder: which rows are done, and how it goes on after a stop | `journal`, `lines`, `manifest`, `folder_reader` |
//! | summary; errors | `summary`, `error` |

mod axis;
mod error;
mod folder_reader;
mod journal;
mod lines;
mod manifest;
mod row;
mod row_maker;
mod run;
mod study;
mod study_file;
mod study_reader;
mod summary;
mod sweep;

pub use axis::{Axis, AxisKind};
pub use error::StudyError;
pub use folder_reader::{Places, check, count_rows, export, read_manifest};
pub use journal::Journal;
pub use manifest::{Manifest, ManifestAxis, ManifestFile, ManifestScenario};
pub use row::{Outcome, Place, PlanChoice, ROW_SCHEMA, Row, RowWithPlan};
pub use row_maker::{RowMaker, judged};
pub use run::{Progress, run};
pub use study::{Base, MOST_ROWS, PartsFile, RowAddress, Study, StudyParts};
pub use summary::{AxisValue, Summary, summary};
pub use sweep::sweep;
