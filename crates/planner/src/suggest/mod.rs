//! What suits an arm with its tool, for whoever has none of it yet: a home with clearance, and where plates can be washed.

mod home;
mod region;

pub use crate::suggest::home::{SuggestedHome, suggest_home};
pub use crate::suggest::region::{RegionSquare, Sector, SuggestedRegion, place_in_front, suggest_region};
