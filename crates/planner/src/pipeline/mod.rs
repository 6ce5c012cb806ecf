//! The phases of planning, one after the other.
//!
//! | phase | file |
//! | --- | --- |
//! | data that they share | `shared.rs` |
//! | the order of the plates | `tour.rs` |
//! | each plate: wash path, configurations, timing, the lines over its ends | `visit.rs`, `visits.rs` |
//! | obstructions that keep a plate from being washed | `visits.rs` |
//! | other places for a plate: the nearest one, a map of all; layouts that can be washed; the outlook before planning |
//! `places.rs` |
//! | transits; one motion, and its tilt | `motion.rs` |
//! | all of them | `phases.rs` |

pub(crate) mod motion;
mod phases;
pub(crate) mod places;
pub(crate) mod shared;
mod tour;
mod visit;
mod visits;

pub use crate::pipeline::phases::{check, plan, plan_here, plan_in_order, plan_unexplained, plan_with};
pub use crate::pipeline::places::{draw_washable_layout, nearest_place, plate_outlooks, washable_map};
pub(crate) use crate::pipeline::places::{fill, with_moved_plate};
pub use crate::pipeline::visits::{other_unwashable_plates, unwashable_plates};
