//! Two bodies nearer than a transit may bring them.

use crate::placed_arm::{Stretch, Surroundings};
use platewash_bodies::clearance::PairClearance;
use platewash_kinematics::JointVector;
use platewash_kinematics::words::distinct_decimals;
use std::fmt;

/// Two bodies nearer than a transit may bring them.
#[derive(Debug, Clone, PartialEq)]
pub struct ClearanceShortfall {
    /// The bodies and their distance.
    pub pair: PairClearance,
    /// The clearance asked for \[m\].
    pub asked_m: f64,
    /// Reserve kept on top of it \[m\]: [`Stretch::reserve_m`].
    pub reserve_m: f64,
}

impl ClearanceShortfall {
    /// The nearest of the pairs that count at `q` \[rad\], where it is too near.
    #[must_use]
    pub fn at(surroundings: &dyn Surroundings, q: &JointVector, stretch: Stretch, asked_m: f64) -> Option<Self> {
        let reserve_m = stretch.reserve_m();
        let pair = surroundings.too_near(q, stretch, asked_m + reserve_m)?;
        Some(Self {
            asked_m: pair.required_m(asked_m),
            pair,
            reserve_m,
        })
    }

    /// Returns true where the bodies are nearer than the job asks: no proof allows that. The reserve beyond it is the planner's own.
    #[must_use]
    pub fn is_below_asked(&self) -> bool {
        self.pair.distance_m < self.asked_m - ALIKE_M
    }
}

/// Distances that differ by less than this get no further digits \[m\].
const ALIKE_M: f64 = 1e-9;

/// Words of both messages that stand before the reserve.
const KEPT: &str = "the clearance asked for and";

impl fmt::Display for ClearanceShortfall {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let PairClearance { a, b, distance_m, .. } = &self.pair;
        let notes = self.pair.notes();
        let mm = |m: f64| 1e3 * m;
        let [distance, required] = distinct_decimals(mm(*distance_m), mm(self.asked_m + self.reserve_m), 2);
        if *distance_m > 0.0 && self.asked_m + self.reserve_m - distance_m < ALIKE_M {
            write!(f, "{a} is a little nearer to {b} than allowed{notes}")?;
            return write!(
                f,
                "; {:.2} mm must be kept: {KEPT} {:.2} mm in reserve",
                mm(self.asked_m + self.reserve_m),
                mm(self.reserve_m)
            );
        }
        if *distance_m > 0.0 {
            write!(f, "{a} is {distance} mm from {b}{notes}")?;
        } else {
            write!(f, "{a} touches {b}{notes}")?;
        }
        write!(
            f,
            "; {required} mm must be kept: {KEPT} {:.2} mm in reserve",
            mm(self.reserve_m)
        )
    }
}
