//! Plans the washing of plates: from a [`WashJob`](platewash_workcell::job::WashJob) to a
//! [`Plan`](platewash_workcell::plan::Plan), from home to home, before anything moves.
//!
//! job → order → per plate: wash path, configurations, timing → transits → one motion. Nothing here judges the result: that is
//! the certificate's, which uses none of it.
//!
//! Conventions (units, frames, order of twists) are those of [`platewash_kinematics`].

mod activity;
mod error;
mod infeasible;
pub mod joint_path;
mod order;
mod outlook;
mod pace;
mod pattern;
mod pipeline;
mod planned;
pub mod redundancy;
pub mod scene;
pub mod suggest;
pub mod timing;
pub mod transit;
mod unwashable;
mod washable_map;
mod watch;

pub use activity::Activity;
pub use error::PlanError;
pub use infeasible::{InfeasiblePart, InfeasiblePlate, InfeasibleReport};
pub use order::{EXACT_UP_TO, Optimality};
pub use outlook::PlateOutlook;
pub use pace::Pace;
pub use pattern::{Promised, Shortfall};
pub use pipeline::{
    check, draw_washable_layout, nearest_place, other_unwashable_plates, outlook, plan, plan_here, plan_in_order,
    plan_unexplained, plan_with, unwashable_plates, washable_map,
};
pub use planned::{Planned, TourSummary, TransitSummary, VisitSummary};
pub use redundancy::Chance;
pub use redundancy::relocation::SEARCHED_M;
pub use unwashable::{PlaceSearch, UnwashablePlate};
pub use washable_map::{MapArea, MapPatch};
pub use watch::{Listener, Watch};

pub(crate) use platewash_kinematics::trig;
