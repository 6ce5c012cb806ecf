//! Plans the washing of plates: from a [`WashJob`](platewash_bodies::job::WashJob) to a
//! [`Plan`](platewash_motion::plan::Plan), from home to home, before anything moves.
//!
//! job → order → per plate: wash path, configurations, timing → transits → one motion. Nothing here judges the result: that is
//! the certificate's, which uses none of it.
//!
//! Conventions (units, frames, order of twists) are those of [`platewash_kinematics`].
//!
//! | concept | module |
//! | --- | --- |
//! | the phases, one after the other | `pipeline` |
//! | the order of the plates | `order` |
//! | the curve on each plate | `pattern` |
//! | tilt, yaw and branch of the arm along it | `redundancy` |
//! | the arm, its tool and what is around them | `placed_arm` |
//! | transits between plates | `transit`, `joint_path` |
//! | timing as fast as the limits allow | `timing` |
//! | the result; the time of a wash against the least | `planned_job`, `pace` |
//! | going on after a stop | `recovery` |
//! | a job that cannot be done, and where its plates could lie | `infeasible`, `unwashable_plate`, `outlook`, `washable_map`, `suggest` |
//! | errors; the caller that waits | `error`, `near_pair`, `out_of_range`; `watch` |

mod error;
mod infeasible;
pub mod joint_path;
mod near_pair;
mod order;
mod out_of_range;
mod outlook;
mod pace;
mod pattern;
mod pipeline;
pub mod placed_arm;
mod planned_job;
mod recovery;
pub mod redundancy;
pub mod suggest;
pub mod timing;
pub mod transit;
mod unwashable_plate;
mod washable_map;
mod watch;

pub use crate::error::PlanError;
pub use crate::infeasible::{InfeasiblePart, InfeasiblePlate, InfeasibleReport};
pub use crate::order::{EXACT_UP_TO, Optimality};
pub use crate::out_of_range::OutOfRange;
pub use crate::outlook::PlateOutlook;
pub use crate::pace::Pace;
pub use crate::pattern::{ContactPromise, Shortfall};
pub use crate::pipeline::{
    check, draw_washable_layout, nearest_place, other_unwashable_plates, plan, plan_here, plan_in_order,
    plan_unexplained, plan_with, plate_outlooks, unwashable_plates, washable_map,
};
pub use crate::planned_job::{PlannedJob, TourSummary, TransitSummary, VisitSummary};
pub use crate::recovery::{Recovered, RecoveryError, Stop, recover};
pub use crate::redundancy::Chance;
pub use crate::redundancy::places::SEARCHED_M;
pub use crate::unwashable_plate::{PlaceSearch, UnwashablePlate};
pub use crate::washable_map::{MapArea, MapPatch};
pub use crate::watch::{Activity, Listener, Watch};
