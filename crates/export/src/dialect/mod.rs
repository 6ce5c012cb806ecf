//! A dialect is a language of robot programs. CONTRIBUTING.md says what another one needs.

pub(crate) mod language;
pub(crate) mod start_within;

pub use language::{Dialect, Points};
pub use platewash_motion_proof::ReadError;
pub use start_within::{START_WITHIN, START_WITHIN_DEG, start_within_deg};
