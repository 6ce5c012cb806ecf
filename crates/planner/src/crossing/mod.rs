//! The way between plates, and from home and back: one smooth path of the joints from rest to rest.
//!
//! A crossing leaves a [`Terminal`] (a plate along its normal, or home) and enters another. Its path parameter is metres of
//! lift along the normals; between their tops it is as long as keeps the joints' pace. The routes, in order:
//!
//! | route | what | file |
//! | --- | --- | --- |
//! | [`Route::Direct`] | a quintic of the joints from top to top, in a few paces | `blend.rs` |
//! | [`Route::Raised`] | the same over a configuration above both | `blend.rs` |
//! | [`Route::Arc`] | the paper's arc round the base | `arc.rs` |
//! | [`Route::Sampled`] | bidirectional random trees, shortened and smoothed | `sampled.rs` |
//!
//! All candidates of the first two that are free are timed and the fastest is taken; the others stand in when none is.
//! Every candidate is looked at in steps of at most [`STEP_RAD`] of a joint; a certificate proves what lies between.

mod arc;
mod blend;
mod error;
mod route;
mod sampled;
mod terminal;
#[cfg(test)]
mod tests;
mod too_near;

pub use arc::PaperArc;
pub use error::{Blocked, CrossingError};
pub use route::{Crossing, Route, Scene, Stage, plan};
pub use terminal::{Terminal, TerminalError};
pub use too_near::{RESERVE_M, TooNear};

/// Joint motion between neighbouring configurations that are looked at, at most \[rad\].
pub const STEP_RAD: f64 = 0.02;
