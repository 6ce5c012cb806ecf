//! Result of planning: the plan, and a summary of it.

use crate::order::Optimality;
use crate::pace::LimitShares;
use crate::pace::Pace;
use crate::redundancy::TiltChoice;
use crate::transit::TransitKind;
use platewash_kinematics::JointVector;
use platewash_kinematics::words::decimals_down;
use platewash_motion::plan::Plan;
use platewash_workcell::wash_path::WashCurve;
use serde::Serialize;
use std::fmt;

/// A job, planned.
#[derive(Debug, Clone)]
pub struct PlannedJob {
    /// The plan, sealed.
    pub plan: Plan,
    /// One entry a plate, in the order of washing.
    pub visits: Vec<VisitSummary>,
    /// Transits from home, between the plates, and to home.
    pub transits: Vec<TransitSummary>,
    /// Travel time saved by the order.
    pub tour: TourSummary,
    /// Largest jerk of each joint between knots \[rad/s³\]: no plan keeps a limit of it. At knots the acceleration may jump.
    pub largest_jerk: JointVector,
}

/// Washing of one plate.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct VisitSummary {
    /// The plate.
    pub plate: usize,
    /// Source of the tool's tilt.
    pub tilt: TiltChoice,
    /// Lean of the tool across the arm's plane: [`Stance::aside_rad`](crate::placed_arm::Stance::aside_rad) \[rad\]. Left out where it
    /// is 0.
    #[serde(skip_serializing_if = "platewash_workcell::json::is_zero")]
    pub aside_rad: f64,
    /// Largest lean of the tool from the normal of the face \[rad\].
    pub cone_rad: f64,
    /// The curve of the tip.
    pub curve: WashCurve,
    /// Time on the plate \[s\].
    pub wash_s: f64,
    /// Least time of the area, and the shares of that time at each limit.
    pub pace: Pace,
}

/// Kind and duration of one transit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TransitSummary {
    /// Kind of the transit.
    pub kind: TransitKind,
    /// Time from contact to contact, or from or to home \[s\].
    pub duration_s: f64,
    /// Lower bound on the time of any motion between its ends, by the limits of the joints \[s\].
    pub least_s: f64,
    /// Shares of the time at each limit.
    #[serde(flatten)]
    pub limits: LimitShares,
}

/// Estimated travel time of the order, compared with a simple one.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TourSummary {
    /// Travel time estimated for the order taken \[s\]: each joint at its limits from place to place.
    pub travel_s: f64,
    /// The same estimate for an order that always takes the plate reached soonest \[s\].
    pub nearest_next_s: f64,
    /// Proof level of the order under that estimate.
    pub optimality: Option<Optimality>,
}

impl VisitSummary {
    /// The pattern in words: a spiral and its turns, or how many rings.
    #[must_use]
    pub fn pattern(&self) -> String {
        self.curve.words()
    }
}

impl fmt::Display for TransitSummary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "the joints need at least {} s{}",
            decimals_down(self.least_s, 2),
            self.limits
        )
    }
}
