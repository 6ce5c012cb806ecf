//! Re-measures what the paper's program does, over many layouts.
//!
//! Every quantity is measured by running the program's own parts (layout law, spiral, transit, inverse kinematics
//! seeded with the executed configuration, control law), not copied from anywhere. The paper's column says what its text
//! takes for granted: that layouts are found, points reached, nothing touched, and plates covered.
//!
//! Errors are half-widths of 95 % intervals: Wilson's for dead ends, batch means over layouts (up to 20 batches) for
//! everything else, because waypoints of one layout are not independent. Shares of 0 and 100 % state three over the number of
//! layouts, and coverage adds the raster's proven error.

mod law;
mod layout;
mod measure;
mod result;
mod rows;
mod sponges;
mod stall;
mod statistics;
mod table;

pub use law::FrequencyResponse;
pub use measure::reproduce;
pub use result::{ReproduceSettings, Reproduction, Row};
