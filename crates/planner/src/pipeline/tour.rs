//! The order of the plates, by travel times estimated before any transit is planned.

use crate::error::PlanError;
use crate::order::TravelTimes;
use crate::pipeline::shared::Pipeline;
use crate::placed_arm::PlacedArm;
use crate::planned_job::TourSummary;
use crate::timing::MotionLimits;
use nalgebra::Vector3;
use platewash_kinematics::{AXES, JointVector};
use platewash_workcell::cancel::Cancelled;
use platewash_workcell::job::OrderRule;

impl Pipeline<'_> {
    /// Returns the plates in the order of washing, and the gain of that order.
    pub fn order(&self, placed: &PlacedArm<'_>) -> Result<(Vec<usize>, TourSummary), PlanError> {
        let times = self.travel_times(placed)?;
        let nearest = times.nearest_next();
        let nearest_next_s = times.duration_s(&nearest);
        let (order, optimality) = match (&self.asked_order, self.settings.order) {
            (Some(asked), _) => (asked.clone(), None),
            (None, OrderRule::Given) => ((0..self.plates.len()).collect(), None),
            (None, OrderRule::Nearest) => (nearest, None),
            (None, OrderRule::Fastest) => {
                let (order, optimality) = times.best(self.watch.cancel)?;
                (order, Some(optimality))
            }
        };
        let tour = TourSummary {
            travel_s: times.duration_s(&order),
            nearest_next_s,
            optimality,
        };
        Ok((order, tour))
    }

    /// Times between homes and plates: a wash path ends towards where the arm goes next, and the next one begins at its plate's
    /// centre. A contact point that the tilt policy does not reach counts as the plate's centre, and that as home.
    fn travel_times(&self, placed: &PlacedArm<'_>) -> Result<TravelTimes, Cancelled> {
        let ([start, home], limits) = (&self.terms.home_rad, &self.transit);
        let centres: Vec<Vector3<f64>> = self.plates.iter().map(|plate| plate.centre()).collect();
        let at = |plate: usize, point, near: &_| {
            let found = self.configuration_at(placed, &self.plates[plate], point, near);
            found.unwrap_or(*near)
        };
        let mut entries: Vec<JointVector> = Vec::with_capacity(centres.len());
        for (plate, centre) in centres.iter().enumerate() {
            placed.check_cancelled()?;
            entries.push(at(plate, *centre, &self.near_rad));
        }
        let exit = |plate: usize, towards: &Vector3<f64>| {
            let [_, foot] = self.widest_path(plate, towards).feet(&self.plates[plate]);
            at(plate, foot, &entries[plate])
        };
        let home_tip = self.home_tip(placed, home);
        let mut times = TravelTimes {
            out: entries.iter().map(|q| least_time(start, q, limits)).collect(),
            between: Vec::with_capacity(centres.len()),
            back: Vec::with_capacity(centres.len()),
        };
        for a in 0..centres.len() {
            let mut row = Vec::with_capacity(centres.len());
            for (b, centre) in centres.iter().enumerate() {
                placed.check_cancelled()?;
                row.push(if a == b {
                    0.0
                } else {
                    least_time(&exit(a, centre), &entries[b], limits)
                });
            }
            times.between.push(row);
            times.back.push(least_time(&exit(a, &home_tip), home, limits));
        }
        Ok(times)
    }
}

/// Least time from rest to rest of the joint that takes longest \[s\]: full acceleration, the speed limit, full deceleration.
pub(crate) fn least_time(from: &JointVector, to: &JointVector, limits: &MotionLimits) -> f64 {
    let time = |joint: usize| {
        let (way, v, a) = (
            (to[joint] - from[joint]).abs(),
            limits.velocity[joint],
            limits.acceleration[joint],
        );
        if way * a >= v * v {
            way / v + v / a
        } else {
            2.0 * (way / a).sqrt()
        }
    };
    (0..AXES).map(time).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: 1 rad at 4 rad/s² takes 2 √(1/4) s; 3 rad at most 2 rad/s take 3/2 + 2/4 s.
    #[test]
    fn the_slowest_joint_counts() {
        let limits = MotionLimits {
            velocity: JointVector::repeat(2.0),
            acceleration: JointVector::repeat(4.0),
            tip: None,
        };
        let at = |a: f64, b: f64| JointVector::new(a, b, 0.0, 0.0, 0.0, 0.0);
        assert_eq!(least_time(&at(0.0, 0.0), &at(1.0, -0.5), &limits), 1.0);
        assert_eq!(least_time(&at(0.0, 0.0), &at(1.0, -3.0), &limits), 2.0);
        assert_eq!(least_time(&at(0.5, 0.0), &at(0.5, 0.0), &limits), 0.0);
    }
}
