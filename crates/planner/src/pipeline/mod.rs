//! The phases of planning, one after the other.
//!
//! | phase | file |
//! | --- | --- |
//! | what they share | `shared.rs` |
//! | the order of the plates | `tour.rs` |
//! | each plate: wash path, configurations, timing, the lines over its ends | `visit.rs`, `visits.rs` |
//! | what keeps a plate from being washed, and where it could be | `failing.rs` |
//! | transits | `transits.rs` |
//! | one motion, and its tilt | `assemble.rs`, `tilt.rs` |
//! | all of them | `phases.rs` |
//! | layouts that can be washed | `draw_layout.rs` |

mod assemble;
mod draw_layout;
mod failing;
mod phases;
mod shared;
mod tilt;
mod tour;
mod transits;
mod visit;
mod visits;

pub use draw_layout::draw_washable_layout;
pub use phases::{check, plan, plan_with};
