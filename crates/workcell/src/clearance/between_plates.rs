//! The distance of two plates, which do not move.

use super::body::{Body, plate_body};
use super::distance::bracketed;
use super::part::Part;
use crate::plate::Plate;
use nalgebra::Vector6;
use platewash_kinematics::{BodyPoses, RobotModel};

/// How far two plates are apart at least, negative where they share a place \[m\]: those that are parallel, seen along their axis, all others by
/// their bodies; 0 where one lies over the other, or both are faces of one disc. An arm lends its frames, whose base is where both lie.
#[must_use]
pub fn gap_of_plates(robot: &RobotModel, a: &Plate, b: &Plate) -> f64 {
    if a.is_over(b) || b.is_over(a) || a.is_back_of(b) {
        return 0.0;
    }
    if a.is_parallel(b) {
        return a.gap_beside_m(b);
    }
    gap_of_bodies(robot, a, b)
}

/// What the distance of the bodies of two plates is not below \[m\].
fn gap_of_bodies(robot: &RobotModel, a: &Plate, b: &Plate) -> f64 {
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
