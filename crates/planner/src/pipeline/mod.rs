//! The phases of planning, one after the other.
//!
//! | phase | file |
//! | --- | --- |
//! | data that they share | `shared.rs` |
//! | the order of the plates | `tour.rs` |
//! | each plate: wash path, configurations, timing, the lines over its ends | `visit.rs`, `visits.rs` |
//! | obstructions that keep a plate from being washed | `visits.rs` |
//! | other places for a plate: the nearest one, a map of all | `places.rs`, `place_map.rs` |
//! | layouts that can be washed; the outlook before planning | `layouts.rs`, `outlook.rs` |
//! | transits; one motion, and its tilt | `motion.rs` |
//! | all of them | `phases.rs` |

pub(crate) mod layouts;
pub(crate) mod motion;
pub(crate) mod outlook;
mod phases;
pub(crate) mod place_map;
pub(crate) mod places;
pub(crate) mod shared;
mod tour;
mod visit;
mod visits;

pub use crate::pipeline::layouts::draw_washable_layout;
pub use crate::pipeline::outlook::plate_outlooks;
pub use crate::pipeline::phases::{check, plan, plan_here, plan_in_order, plan_unexplained, plan_with};
pub(crate) use crate::pipeline::place_map::fill;
pub use crate::pipeline::place_map::washable_map;
pub use crate::pipeline::places::nearest_place;
pub(crate) use crate::pipeline::places::with_moved_plate;
pub use crate::pipeline::visits::{other_unwashable_plates, unwashable_plates};
