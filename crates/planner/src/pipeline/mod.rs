//! The phases of planning, one after the other.
//!
//! | phase | file |
//! | --- | --- |
//! | what they share | `shared.rs` |
//! | the order of the plates | `tour.rs` |
//! | each plate: wash path, configurations, timing, the lines over its ends | `visit.rs`, `visits.rs` |
//! | what keeps a plate from being washed | `failing.rs` |
//! | where else it could be washed: the nearest place, a map of all | `nearest_place.rs`, `washable_map.rs` |
//! | transits | `transits.rs` |
//! | one motion, and its tilt | `assemble.rs`, `tilt.rs` |
//! | all of them | `phases.rs` |
//! | layouts that can be washed | `draw_layout.rs` |
//! | what to expect, before any of them | `outlook.rs` |

mod assemble;
mod draw_layout;
mod failing;
mod nearest_place;
mod outlook;
mod phases;
mod shared;
mod tilt;
mod tour;
mod transits;
mod visit;
mod visits;
mod washable_map;

pub use draw_layout::draw_washable_layout;
pub use failing::{other_unwashable_plates, unwashable_plates};
pub use nearest_place::nearest_place;
pub use outlook::outlook;
pub use phases::{check, plan, plan_here, plan_in_order, plan_unexplained, plan_with};
pub use washable_map::washable_map;
