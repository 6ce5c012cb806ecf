//! Transits between plates, and from home and back: one smooth path of the joints from rest to rest.
//!
//! A transit leaves a [`LiftLine`] (a plate along its normal, or home) and enters another. Its path parameter is metres of
//! lift along the normals; between their tops it is as long as keeps the joints' pace. Its kinds, in order:
//!
//! | kind | path | file |
//! | --- | --- | --- |
//! | [`TransitKind::Direct`] | a quintic of the joints from top to top, in a few paces | `lift_line.rs` |
//! | [`TransitKind::Raised`] | the same over a configuration above both | `lift_line.rs` |
//! | [`TransitKind::Arc`] | an arc round the base | `lift_line.rs` |
//! | [`TransitKind::Sampled`] | bidirectional random trees, shortened and smoothed | `sampled.rs` |
//!
//! All candidates of the first two that are free are timed and the fastest is taken; the others stand in when none is.
//! Every candidate is checked in steps of at most [`STEP_RAD`] of a joint; a certificate proves the motion between them.

mod error;
mod lift_line;
mod rules;
mod sampled;
mod search;
mod shortfall;
pub use crate::transit::error::{TransitError, TransitObstruction};
pub use crate::transit::lift_line::{LiftLine, LiftLineError};
pub use crate::transit::rules::{BaseArc, STEP_RAD, TransitKind, TransitRules};
pub use crate::transit::search::{Transit, plan};
pub use crate::transit::shortfall::ClearanceShortfall;
