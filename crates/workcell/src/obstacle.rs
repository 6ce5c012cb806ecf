//! Obstacles around an arm.

use crate::pose;
use nalgebra::{Point3, Vector3};
use platewash_kinematics::Pose;
use platewash_kinematics::geometry::Shape;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// Greatest margin of an obstacle \[m\].
const GREATEST_MARGIN_M: f64 = 1.0;

/// Fixed body that must not be touched.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Obstacle {
    /// Name, for messages.
    pub name: String,
    /// Shape in the obstacle's frame.
    pub shape: ObstacleShape,
    /// Pose in the world frame, `T_world_obstacle`.
    #[serde(with = "pose")]
    #[ts(as = "pose::PoseFields")]
    pub pose: Pose,
    /// Margin added around the shape, beyond the clearance that the job requires \[m\]. Distances to the obstacle are measured from the
    /// grown shape. Left out of files if it is 0.
    #[serde(default, skip_serializing_if = "crate::json::is_zero")]
    pub margin_m: f64,
    /// Indices of the plates that it holds, in ascending order. It may touch these and reach into them. Left out of files if empty.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub holds_plates: Vec<usize>,
}

/// Shape of an obstacle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, TS)]
#[serde(rename_all = "snake_case")]
pub enum ObstacleShape {
    /// Half-space z ≤ 0.
    HalfSpace,
    /// Convex body.
    Convex(Shape),
    /// Union of the convex hulls of some lists of points \[m\].
    Parts(#[ts(as = "Vec<Vec<[f64; 3]>>")] Vec<Vec<Point3<f64>>>),
}

impl ObstacleShape {
    /// Longest side of the box around the body, along its axes \[m\]; `None` for a half-space.
    #[must_use]
    pub fn extent_m(&self) -> Option<f64> {
        match self {
            Self::HalfSpace => None,
            Self::Convex(shape) => Some(shape.extent_m()),
            Self::Parts(parts) => {
                let points = parts.iter().flatten().copied().collect();
                Some(Shape::Hull { points }.extent_m())
            }
        }
    }
}

/// Greatest angle \[rad\] and greatest distance \[m\] from a level plane at height 0 that are rounding.
const LEVEL: f64 = 1e-9;
const SAME_HEIGHT_M: f64 = 1e-9;

/// True if a plane with a unit normal through a point \[m\] is level at height 0, with its normal up: the ground under an arm at the origin.
#[must_use]
pub fn is_ground_plane(normal: &Vector3<f64>, point: &Vector3<f64>) -> bool {
    normal.z > 0.0 && normal.xy().norm() <= LEVEL && normal.dot(point).abs() <= SAME_HEIGHT_M
}

impl Obstacle {
    /// Returns an obstacle without a margin that holds no plates.
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

    /// Returns the floor of the room: the half-space z ≤ 0.
    #[must_use]
    pub fn floor() -> Self {
        Self::new("floor", ObstacleShape::HalfSpace, Pose::identity())
    }

    /// Returns the reason that the obstacle is invalid in a job with `plates` plates, if there is one.
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

    /// True for a level floor at height 0, wherever its frame stands in the plane: in the frame of an arm's base, the ground that the arm
    /// stands on.
    #[must_use]
    pub fn is_ground(&self) -> bool {
        let up = self.pose.rotation * Vector3::z();
        self.shape == ObstacleShape::HalfSpace && is_ground_plane(&up, &self.pose.translation.vector)
    }
}

/// Reason that an obstacle is invalid.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ObstacleFault {
    /// The pose is not finite, or not normalised.
    #[error("its pose must be finite, its quaternion of length 1")]
    Pose,
    /// The margin is out of range.
    #[error("margin_m must be from 0 to {GREATEST_MARGIN_M}; found {found}")]
    Margin {
        /// Margin found \[m\].
        found: f64,
    },
    /// There are no parts, or one has no points.
    #[error("it has no parts, or one without points")]
    NoParts,
    /// The obstacle holds a plate that does not exist.
    #[error("it holds the plate with index {plate}; there are {plates}, counted from 0")]
    NoPlate {
        /// Index of the plate.
        plate: usize,
        /// Number of plates.
        plates: usize,
    },
    /// The obstacle holds a plate twice, or the list is not ascending.
    #[error("the plates that it holds must be named once each, the least first")]
    HeldTwice,
}
