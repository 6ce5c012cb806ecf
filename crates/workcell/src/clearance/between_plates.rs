//! The distance of two plates, which do not move.

use super::body::{Body, plate_body};
use super::distance::bracketed;
use super::part::Part;
use crate::plate::Plate;
use nalgebra::Vector6;
use platewash_kinematics::{BodyPoses, RobotModel};

/// What the distance of the bodies of two plates is not below \[m\]; ≤ 0 where they touch or overlap. An arm lends its frames, whose base
/// is where both lie.
#[must_use]
pub fn gap_of_plates(robot: &RobotModel, a: &Plate, b: &Plate) -> f64 {
    let poses = robot.fk(&Vector6::zeros());
    let [a, b] = [a, b].map(|plate| plate_body(0, plate, None));
    let whole = least(a.outer(), b.outer(), &poses);
    if whole > 0.0 {
        return whole;
    }
    least(parts(&a), parts(&b), &poses)
}

fn parts(body: &Body) -> &[Part] {
    &body.parts
}

fn least(a: &[Part], b: &[Part], poses: &BodyPoses) -> f64 {
    let mut least = f64::INFINITY;
    for part in a {
        let placed = part.place(poses);
        for other in b {
            let other = other.place(poses);
            if placed.sphere_gap(&other) < least {
                let (_, at_least) = bracketed(&placed, &other);
                least = least.min(at_least);
            }
        }
    }
    least
}
