//! Suggestions for an arm with its tool that has no layout yet: a home with clearance, and the region in which plates can be
//! washed.

mod home;
mod region;
mod sector;

pub use crate::near_pair::NearPair;
pub use crate::suggest::home::{SuggestedHome, near_pairs, suggest_home};
pub use crate::suggest::region::{RegionSquare, Sector, SuggestedRegion, place_in_front, suggest_region};
pub use crate::suggest::sector::suggest_sector;
