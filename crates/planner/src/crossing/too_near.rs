//! Two bodies nearer than a crossing may bring them.

use platewash_kinematics::JointVector;
use platewash_kinematics::words::told_apart;
use platewash_workcell::clearance::{ClearanceModel, PairClearance};
use std::fmt;

/// What crossings and the rests at home keep beyond `wash.clearance_m`, because they are looked at in steps \[m\].
pub const RESERVE_M: f64 = 1e-3;

/// Two bodies nearer than a crossing may bring them.
#[derive(Debug, Clone, PartialEq)]
pub struct TooNear {
    /// The bodies and their distance.
    pub pair: PairClearance,
    /// The clearance asked for, `wash.clearance_m` \[m\]; [`RESERVE_M`] is kept on top of it.
    pub asked_m: f64,
}

impl TooNear {
    /// The nearest pair of all at `q` \[rad\], where it is too near.
    #[must_use]
    pub fn free(clearance: &ClearanceModel, q: &JointVector, asked_m: f64) -> Option<Self> {
        let pair = clearance.too_near(q, &[], asked_m + RESERVE_M).into_iter().next()?;
        Some(Self { pair, asked_m })
    }

    /// The same on the line over a plate, where the sponge may be near the plates.
    #[must_use]
    pub fn on_line(clearance: &ClearanceModel, q: &JointVector, asked_m: f64) -> Option<Self> {
        let pair = clearance.nearest_washing(q, asked_m + RESERVE_M)?;
        Some(Self { pair, asked_m })
    }
}

/// Distances that differ by less than this are not told apart by their digits \[m\].
const ALIKE_M: f64 = 1e-9;

/// What is kept, before the reserve.
const KEPT: &str = "wash.clearance_m and";

impl fmt::Display for TooNear {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let PairClearance { a, b, distance_m, .. } = &self.pair;
        let mm = |m: f64| 1e3 * m;
        let [distance, required] = told_apart(mm(*distance_m), mm(self.asked_m + RESERVE_M), 2);
        if *distance_m > 0.0 && self.asked_m + RESERVE_M - distance_m < ALIKE_M {
            write!(f, "{a} is a little nearer to {b} than allowed")?;
            return write!(
                f,
                "; {:.2} mm must be kept, {KEPT} {:.2} mm in reserve",
                mm(self.asked_m + RESERVE_M),
                mm(RESERVE_M)
            );
        }
        if *distance_m > 0.0 {
            write!(f, "{a} is {distance} mm from {b}")?;
        } else {
            write!(f, "{a} touches {b}")?;
        }
        write!(
            f,
            "; {required} mm must be kept, {KEPT} {:.2} mm in reserve",
            mm(RESERVE_M)
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scenario;
    use platewash_kinematics::RobotModel;
    use platewash_workcell::layout::Plate;

    /// A plate whose surface is `gap` below the floor of the sponge, under the tool that points straight down.
    #[test]
    fn the_pair_its_distance_and_what_is_required_are_named() {
        let robot = RobotModel::irb120().unwrap();
        let tool = Scenario::load("kitchen").unwrap().tool;
        let q = JointVector::new(0.0, 0.0, 0.0, 0.0, 90.0_f64.to_radians(), 0.0);
        let tip = robot
            .fk(&q)
            .rigid(&platewash_workcell::tool::tip_frame(&robot, &tool))
            .translation;
        for (gap, near) in [(0.0105, true), (0.0112, false)] {
            let plate = Plate {
                x_m: tip.x,
                y_m: tip.y,
                z_m: tip.z - gap,
                radius_m: 0.1,
                thickness_m: 0.02,
            };
            let clearance = ClearanceModel::new(&robot, &tool, &[plate]).unwrap();
            let found = TooNear::free(&clearance, &q, 0.01);
            assert_eq!(found.is_some(), near);
            assert_eq!(
                TooNear::on_line(&clearance, &q, 0.01),
                None,
                "the sponge may be near a plate"
            );
            if let Some(found) = found {
                let message = found.to_string();
                for part in ["sponge", "plate 0", "10.50 mm", "11.00 mm", "1.00 mm in reserve"] {
                    assert!(message.contains(part), "{message}");
                }
            }
        }
    }
}
