//! Contents of a page: the document `platewash-view/2`. The page's TypeScript types are made from these.
//!
//! Units are SI and radians. Data are in the world frame unless stated otherwise. Only the parts of a document that repeat the
//! certificate are proved: distances and swept areas over time are sampled for display.
//!
//! | concept | file |
//! | --- | --- |
//! | the document | `document.rs` |
//! | arrays as text | `numbers.rs` |
//! | shapes of links | `body.rs` |
//! | heading of the page; proof | `heading.rs`, `certificate.rs` |
//! | arm; plates and paths | `arm.rs`; `plates.rs` |
//! | planned motion; the tip along it | `motion.rs`; `tips.rs` |
//! | smallest distance over time | `clearance.rs` |
//! | swept or pressed area over time | `coverage.rs`, `pressed.rs`, `raster.rs` |
//! | dirt, until the proved dose is reached | `dirt.rs` |
//! | lists with items left out | `thin.rs` |
//! | executed motion: its data, its display | `execution.rs` |
//! | another program's motion on the same plates | `beside.rs` |
//! | a motion of an arm alone | `arm_motion.rs` |
//!
//! Tool, obstacles, plates, segments and checks are as plan files and certificates state them.

mod arm;
mod arm_motion;
mod beside;
mod body;
mod certificate;
mod clearance;
pub(crate) mod coverage;
mod dirt;
mod document;
mod error;
mod execution;
mod heading;
mod motion;
mod numbers;
mod plates;
pub(crate) mod pressed;
pub(crate) mod raster;
mod thin;
pub(crate) mod tips;

pub use arm::{Arm, Joint, Link};
pub use arm_motion::ArmMotion;
pub use beside::Beside;
pub use body::{Body, Shape};
pub use certificate::{Certificate, Check, Contact};
pub use clearance::Clearance;
pub use coverage::PlateCoverage;
pub use dirt::PlateDirt;
pub use document::{FORMAT, Surroundings, View, ViewExtras};
pub use error::ViewError;
pub use execution::{ExecutedMotion, Execution, ExecutionFacts, Source};
pub use heading::Heading;
pub use motion::Motion;
pub use numbers::{Data, Numbers};
pub use plates::{Plate, WashPath};
pub use pressed::PressedRule;
pub use raster::Marks;
