//! Transits between plates, and from home and back: one smooth path of the joints from rest to rest.
//!
//! A transit leaves a [`LiftLine`] (a plate along its normal, or home) and enters another. Its path parameter is metres of
//! lift along the normals; between their tops it is as long as keeps the joints' pace. Its kinds, in order:
//!
//! | kind | what | file |
//! | --- | --- | --- |
//! | [`TransitKind::Direct`] | a quintic of the joints from top to top, in a few paces | `blend.rs` |
//! | [`TransitKind::Raised`] | the same over a configuration above both | `blend.rs` |
//! | [`TransitKind::Arc`] | an arc round the base | `arc.rs` |
//! | [`TransitKind::Sampled`] | bidirectional random trees, shortened and smoothed | `sampled.rs` |
//!
//! All candidates of the first two that are free are timed and the fastest is taken; the others stand in when none is.
//! Every candidate is looked at in steps of at most [`STEP_RAD`] of a joint; a certificate proves what lies between.

mod arc;
mod blend;
mod error;
mod free_path;
mod kind;
mod lift_line;
mod rules;
mod sampled;
mod search;
#[cfg(test)]
mod tests;
mod too_near;

pub use error::{Blocked, TransitError};
pub use free_path::STEP_RAD;
pub use kind::TransitKind;
pub use lift_line::{LiftLine, LiftLineError};
pub use rules::{BaseArc, TransitRules};
pub use search::{Transit, plan};
pub use too_near::TooNear;
