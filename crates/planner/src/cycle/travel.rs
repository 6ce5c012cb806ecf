//! Travel times between plates, estimated before any crossing is planned.

use super::arm::Arm;
use super::tour::TravelTimes;
use super::visit;
use crate::scenario::Scenario;
use crate::timing::MotionLimits;
use nalgebra::Vector3;
use platewash_kinematics::{AXES, JointVector};
use platewash_workcell::layout::Plate;

/// Times between homes and plates: a stroke ends towards where the arm goes next, and the next one begins at its centre. A
/// contact point that the posture policy does not reach counts as the plate's centre, and that as home.
pub(super) fn times(
    scenario: &Scenario,
    arm: &Arm<'_>,
    plates: &[Plate],
    homes: &[JointVector; 2],
    limits: &MotionLimits,
) -> TravelTimes {
    let [start, home] = homes;
    let centres: Vec<Vector3<f64>> = plates.iter().map(|p| visit::centre(p, scenario)).collect();
    let entries: Vec<JointVector> = centres
        .iter()
        .map(|centre| arm.configuration(*centre, start).unwrap_or(*start))
        .collect();
    let home_tip = arm.cell.robot.fk(home).rigid(&arm.cell.tip).translation;
    let exit = |plate: usize, towards: &Vector3<f64>| {
        let stroke = visit::stroke(scenario, &centres[plate], towards);
        let end = stroke.at(stroke.end()).position;
        let contact = centres[plate] + Vector3::new(end.x, end.y, 0.0);
        arm.configuration(contact, &entries[plate]).unwrap_or(entries[plate])
    };
    let all = 0..plates.len();
    TravelTimes {
        out: entries.iter().map(|q| least_time(start, q, limits)).collect(),
        between: all
            .clone()
            .map(|a| {
                let to = |b: usize| least_time(&exit(a, &centres[b]), &entries[b], limits);
                all.clone().map(|b| if a == b { 0.0 } else { to(b) }).collect()
            })
            .collect(),
        back: all.map(|a| least_time(&exit(a, &home_tip), home, limits)).collect(),
    }
}

/// Least time from rest to rest of the joint that takes longest \[s\]: full acceleration, the speed limit, full deceleration.
fn least_time(from: &JointVector, to: &JointVector, limits: &MotionLimits) -> f64 {
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
