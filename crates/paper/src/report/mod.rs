//! How a run went: per plate and over the whole, for people and as data.

mod contents;
mod finding;
mod headline;
mod motion;
mod nearness;
mod plate;
mod text;
mod transits;
mod unreached;

pub use contents::PaperReport;
pub use finding::PaperFinding;
pub use motion::{MotionReport, Violation, ViolationKind};
pub use nearness::ClosestApproach;
pub use plate::PlateReport;
pub use transits::TransitReport;
pub use unreached::Unreached;
