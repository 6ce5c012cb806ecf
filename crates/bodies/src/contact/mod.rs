//! Contact model: the pressure of a sponge on a plate as an elastic foundation.
//!
//! The sponge is a cylinder of radius s whose free face lies c beyond the tip, across the tool's axis a (a unit vector out of the tool).
//! Columns of foam along the axis give way independently of each other: where a point x of the face of a plate lies within the cylinder,
//! the column over it is compressed by
//!
//! w(x) = c + (tip − x)·a,
//!
//! and presses with p = E w / H, H the free height, in the direction of its compression (Elandt et al. 2019 call it a pressure field;
//! Winkler 1867). Without friction the plate pushes back along its normal n: of a column of the cross-section dA, p n / (−a·n) dA.
//!
//! A plate that lies higher by e along its axis ẑ compresses each column by −e ẑ·a more, and lies −e (ẑ − a (ẑ·a)) to the side.
//!
//! All quantities are in the frame of the plate, lengths in metres. `foundation.rs` and `sponge_pose.rs` have the sponge and where it
//! is, `moment.rs` the moments of a wash. `columns.rs` has the sponge's face in columns: forces, and the greatest compression; `plate_load.rs`
//! the same over a stretch of time, `level.rs` on a flat face; `parts.rs` bounds a part of the sponge's face; `sampler.rs` measures the contact
//! time and dose of single points of the plate's face; `bundles.rs` passes over moments far from a point.

mod bundles;
mod columns;
mod foundation;
mod interval;
mod level;
mod moment;
mod parts;
mod plate_load;
mod sampler;
mod sponge_pose;

pub use crate::contact::bundles::Bundles;
pub use crate::contact::columns::{Column, Columns, Load};
pub use crate::contact::foundation::Foundation;
pub use crate::contact::interval::{at_least_0, both};
pub use crate::contact::level::{Level, LevelPress};
pub use crate::contact::moment::{Drift, Moment};
pub use crate::contact::parts::Bends;
pub use crate::contact::plate_load::{HolderVolumes, PlateLoad, Press, SpongeState, TouchRegion};
pub use crate::contact::sampler::{ContactSampler, Dwell};
pub use crate::contact::sponge_pose::SpongePose;
