//! The motion: its cubics, and bounds on the joints and the tip over a stretch of time.
//!
//! | concept | module |
//! | --- | --- |
//! | one cubic with its extremes; groups of cubics | `piece`, `timeline` |
//! | positions, speeds and accelerations of the joints | `joints` |
//! | joint 5 keeps from 0 at a plate | `wrist` |
//! | the tip's derivatives; the greatest value of a quantity by halving; its speed, acceleration, tilt and height | `tip`, `bound_tracker`, `tip_limits` |

pub(crate) mod bound_tracker;
pub(crate) mod joints;
pub(crate) mod piece;
pub(crate) mod timeline;
pub(crate) mod tip;
pub(crate) mod tip_limits;
pub(crate) mod wrist;
