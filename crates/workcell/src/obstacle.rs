//! What stands around an arm.

use crate::pose;
use nalgebra::Point3;
use platewash_kinematics::Pose;
use platewash_kinematics::geometry::Shape;
use serde::{Deserialize, Serialize};

/// The greatest margin \[m\].
const GREATEST_MARGIN_M: f64 = 1.0;

/// Something that stands still and must not be touched.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Obstacle {
    /// Its name, in messages.
    pub name: String,
    /// Its shape.
    pub shape: ObstacleShape,
    /// `T_world_obstacle`.
    #[serde(with = "pose")]
    pub pose: Pose,
    /// How far it is grown for what moves, beyond the clearance that the job asks for \[m\]: distances to it are those to all that is
    /// within this of its shape. Left out of files where it is 0.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub margin_m: f64,
    /// The plates that it holds, by their index, growing: these it may touch and reach into. Left out of files where there is none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub holds_plates: Vec<usize>,
}

/// Shape of an obstacle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ObstacleShape {
    /// All of z ≤ 0.
    HalfSpace,
    /// A convex body.
    Convex(Shape),
    /// The convex hulls of some lists of points, all together \[m\].
    Parts(Vec<Vec<Point3<f64>>>),
}

impl Obstacle {
    /// A shape that stands somewhere, without a margin and holding nothing.
    #[must_use]
    pub fn new(name: &str, shape: ObstacleShape, pose: Pose) -> Self {
        Self {
            name: name.to_owned(),
            shape,
            pose,
            margin_m: 0.0,
            holds_plates: Vec::new(),
        }
    }

    /// The floor of the room: all of z ≤ 0.
    #[must_use]
    pub fn floor() -> Self {
        Self::new("floor", ObstacleShape::HalfSpace, Pose::identity())
    }

    /// Why nothing could be worked out with it among so many plates, if so.
    #[must_use]
    pub fn fault(&self, plates: usize) -> Option<ObstacleFault> {
        if !pose::is_sound(&self.pose) {
            return Some(ObstacleFault::Pose);
        }
        if !(0.0..=GREATEST_MARGIN_M).contains(&self.margin_m) {
            let found = self.margin_m;
            return Some(ObstacleFault::Margin { found });
        }
        let shapeless = |hulls: &Vec<Vec<_>>| hulls.is_empty() || hulls.iter().any(Vec::is_empty);
        if matches!(&self.shape, ObstacleShape::Parts(hulls) if shapeless(hulls)) {
            return Some(ObstacleFault::NoParts);
        }
        let held = &self.holds_plates;
        if let Some(&plate) = held.iter().find(|plate| **plate >= plates) {
            return Some(ObstacleFault::NoPlate { plate, plates });
        }
        let grows = held.windows(2).all(|pair| pair[0] < pair[1]);
        (!grows).then_some(ObstacleFault::HeldTwice)
    }

    /// Whether it is the level plane at height 0, as the floor of a room that nothing is said about.
    #[must_use]
    pub fn is_plain_floor(&self) -> bool {
        self.shape == ObstacleShape::HalfSpace && self.pose == Pose::identity() && self.margin_m == 0.0
    }
}

/// Why an obstacle is none.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ObstacleFault {
    /// It is nowhere.
    #[error("its pose must be finite, its quaternion of length 1")]
    Pose,
    /// A margin that is none.
    #[error("margin_m must be from 0 to {GREATEST_MARGIN_M}; found {found}")]
    Margin {
        /// What it is.
        found: f64,
    },
    /// No parts, or one without points.
    #[error("it has no parts, or one without points")]
    NoParts,
    /// It holds a plate that is not there.
    #[error("it holds plate {plate}; there are {plates}, counted from 0")]
    NoPlate {
        /// Index of the plate.
        plate: usize,
        /// How many there are.
        plates: usize,
    },
    /// It holds a plate twice, or its list does not grow.
    #[error("the plates that it holds must be named once each, the least first")]
    HeldTwice,
}

fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    type Change = fn(&mut Obstacle);

    #[test]
    fn obstacles_that_are_none_say_why() {
        let cases: [(&str, Change); 10] = [
            ("pose", |o| o.pose.translation.x = f64::NAN),
            ("pose", |o| o.pose.translation.z = f64::INFINITY),
            ("pose", |o| {
                o.pose.rotation = nalgebra::UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(2.0, 0.0, 0.0, 0.0))
            }),
            ("margin_m", |o| o.margin_m = -1e-9),
            ("margin_m", |o| o.margin_m = f64::NAN),
            ("margin_m", |o| o.margin_m = 1.1),
            ("no parts", |o| o.shape = ObstacleShape::Parts(Vec::new())),
            ("without points", |o| o.shape = ObstacleShape::Parts(vec![Vec::new()])),
            ("it holds plate 2; there are 2", |o| o.holds_plates = vec![0, 2]),
            ("once each", |o| o.holds_plates = vec![1, 1]),
        ];
        for (words, change) in cases {
            let mut obstacle = Obstacle::floor();
            assert_eq!(obstacle.fault(2), None);
            change(&mut obstacle);
            let said = obstacle.fault(2).unwrap().to_string();
            assert!(said.contains(words), "{words}: {said}");
        }
    }

    #[test]
    fn files_state_what_says_something_alone_and_read_it_back() {
        let plain = serde_json::to_string(&Obstacle::floor()).unwrap();
        assert!(
            !plain.contains("margin_m") && !plain.contains("holds_plates"),
            "{plain}"
        );
        let corner = |x: f64| Point3::new(x, 0.5, -0.25);
        let parts = ObstacleShape::Parts(vec![vec![corner(0.0)], vec![corner(1.0), corner(2.0)]]);
        let mut rack = Obstacle::new("rack", parts, Pose::translation(1.0, 2.0, 3.0));
        (rack.margin_m, rack.holds_plates) = (0.01, vec![0, 3]);
        for obstacle in [Obstacle::floor(), rack] {
            let text = serde_json::to_string(&obstacle).unwrap();
            assert_eq!(serde_json::from_str::<Obstacle>(&text).unwrap(), obstacle);
        }
    }
}
