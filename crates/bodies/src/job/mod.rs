//! A job with its arm, checked: its terms can be computed with, and its bodies can be where they are.
//!
//! | concept | module |
//! | --- | --- |
//! | a job with its arm | `wash_job` |
//! | the check of the bodies; overlaps of plates with each other and with the arm's base | `standing` |
//! | errors | `error` |

mod error;
mod standing;
mod wash_job;

pub use crate::job::error::{End, JobError};
pub use crate::job::standing::{PlateOverlap, check_standing, overlaps_of_fixed_bodies, overlaps_of_plates};
pub use crate::job::wash_job::WashJob;
