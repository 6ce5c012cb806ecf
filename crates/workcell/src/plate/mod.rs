//! A plate is a face to be washed, the body below it, and its pose.
//!
//! | concept | module |
//! | --- | --- |
//! | a plate in its place, its axis in words; its terms | `placed_plate`; `terms` |
//! | convex parts that enclose its body | `solid` |
//! | plates beside each other, and two faces of one | `beside` |
//! | sizes and places that a plate can have | `bounds` |

mod beside;
mod bounds;
mod placed_plate;
mod solid;
mod terms;

pub use crate::plate::bounds::{GREATEST_M, LEAST_PLATE_M};
pub use crate::plate::placed_plate::{Foot, Plate};
pub use crate::plate::solid::PlateParts;
pub use crate::plate::terms::PlateTerms;
