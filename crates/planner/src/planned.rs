//! What planning makes: the plan, and what is to be said of it.

use crate::order::Optimality;
use crate::pace::Pace;
use crate::redundancy::TiltChoice;
use crate::transit::TransitKind;
use platewash_kinematics::JointVector;
use platewash_workcell::plan::Plan;
use platewash_workcell::wash_path::WashCurve;
use serde::Serialize;

/// A job, planned.
#[derive(Debug, Clone)]
pub struct Planned {
    /// The plan, sealed.
    pub plan: Plan,
    /// One entry a plate, in the order of washing.
    pub visits: Vec<VisitSummary>,
    /// From home, between the plates, and home.
    pub transits: Vec<TransitSummary>,
    /// What the order gains.
    pub tour: TourSummary,
    pub(crate) largest_jerk: JointVector,
}

/// How a plate is washed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct VisitSummary {
    /// The plate.
    pub plate: usize,
    /// Where the tilt of the tool comes from.
    pub tilt: TiltChoice,
    /// How far the tool leans across the arm's plane besides: [`Stance::aside_rad`](crate::scene::Stance::aside_rad) \[rad\]. Left out
    /// where it is 0.
    #[serde(skip_serializing_if = "is_zero")]
    pub aside_rad: f64,
    /// How far the tool may lean from the normal of the face \[rad\].
    pub cone_rad: f64,
    /// The curve of the tip.
    pub curve: WashCurve,
    /// Time on the plate \[s\].
    pub wash_s: f64,
    /// How near that is to the least time of the area, and what binds it.
    pub pace: Pace,
}

fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

/// How a transit goes.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TransitSummary {
    /// Its kind.
    pub kind: TransitKind,
    /// Time from contact to contact, or from or to home \[s\].
    pub duration_s: f64,
}

/// What the order gains.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TourSummary {
    /// Travel time estimated for the order taken \[s\]: each joint at its limits from place to place.
    pub travel_s: f64,
    /// The same for always the plate reached soonest \[s\].
    pub nearest_next_s: f64,
    /// Whether the order is known to be the best under that estimate.
    pub optimality: Option<Optimality>,
}

impl VisitSummary {
    /// The pattern in words: a spiral and its turns, or how many rings.
    #[must_use]
    pub fn pattern(&self) -> String {
        match &self.curve.rings {
            Some(rings) => format!("{} rings", rings.count),
            None if self.curve.closing_ring => format!("spiral of {:.2} turns and a ring", self.curve.turns),
            None => format!("spiral of {:.2} turns", self.curve.turns),
        }
    }
}

impl Planned {
    /// Largest jerk of each joint between knots \[rad/s³\]: no plan keeps a limit of it. At knots the acceleration may jump.
    #[must_use]
    pub fn largest_jerk(&self) -> JointVector {
        self.largest_jerk
    }
}
