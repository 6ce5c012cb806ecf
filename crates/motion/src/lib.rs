//! Motions of an arm as data: what a planner returns, and what a file holds.
//!
//! | concept | module |
//! | --- | --- |
//! | a motion by its knots, and its segments | [`trajectory`] |
//! | a controller's motion, interpolated by pieces | [`piecewise`] |
//! | the plan file | [`plan`] |
//! | tables of motions as CSV | [`csv`] |
//! | fields in which two jobs differ | [`differences`] |
//! | jobs of dry runs | [`dry_run`] |

pub mod csv;
pub mod differences;
mod digits;
pub mod dry_run;
pub mod piecewise;
pub mod plan;
pub mod trajectory;
