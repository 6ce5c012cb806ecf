//! A plate in its place: a face to be washed, the body below it, and its pose.

use crate::plate::bounds::{GREATEST_M, LEAST_PLATE_M};
use crate::plate::terms::PlateTerms;
use crate::pose;
use crate::surface::Surface;
use nalgebra::{Point3, Vector3};
use platewash_kinematics::Pose;
use platewash_kinematics::trig::atan2;
use platewash_kinematics::words::rounded;
use serde::{Deserialize, Serialize};
use ts_rs::TS;

/// A plate.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
#[ts(optional_fields)]
pub struct Plate {
    /// Face to be washed.
    pub surface: Surface,
    /// Thickness from the face along the axis \[m\]. For clearance it also applies along the normal, where that reaches farther down.
    pub thickness_m: f64,
    /// Ring that the plate stands on, if it has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub foot: Option<Foot>,
    /// Pose in the world frame, `T_world_plate`: origin at the pole of the face, z along its axis, out of the plate.
    #[serde(with = "pose")]
    #[ts(as = "pose::PoseFields")]
    pub pose: Pose,
    /// Terms of this plate, where they differ from those of its job.
    #[serde(default, skip_serializing_if = "PlateTerms::are_those_of_the_job")]
    #[ts(as = "Option<PlateTerms>")]
    pub terms: PlateTerms,
}

/// Ring below a plate that it stands on, as the cylinder that encloses it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, TS)]
#[serde(deny_unknown_fields)]
pub struct Foot {
    /// Outer radius \[m\].
    pub radius_m: f64,
    /// Height below the body under the pole \[m\].
    pub height_m: f64,
}

impl Foot {
    /// Checks that the foot has a valid size and is no wider than the rim of its plate \[m\].
    #[must_use]
    pub fn is_sound(&self, rim_m: f64) -> bool {
        let is_size = |size: f64| size > LEAST_PLATE_M && size <= GREATEST_M;
        is_size(self.radius_m) && is_size(self.height_m) && self.radius_m <= rim_m
    }
}

impl Plate {
    /// Returns a flat round plate that lies level, with the centre of its face at `centre_m` \[m\].
    #[must_use]
    pub fn level_disc(centre_m: [f64; 3], radius_m: f64, thickness_m: f64) -> Self {
        let [x, y, z] = centre_m;
        Self {
            surface: Surface::Disc { radius_m },
            thickness_m,
            foot: None,
            pose: Pose::translation(x, y, z),
            terms: PlateTerms::default(),
        }
    }

    /// Returns the plate with the pole of its face moved to another x and y \[m\], at the same height.
    #[must_use]
    pub fn moved_to(mut self, [x, y]: [f64; 2]) -> Self {
        self.pose.translation.x = x;
        self.pose.translation.y = y;
        self
    }

    /// Returns the plate in another frame. `by` takes the frame of its pose to the other one.
    #[must_use]
    pub fn seen_from(&self, by: &Pose) -> Self {
        Self {
            pose: by * self.pose,
            ..*self
        }
    }

    /// Pole of the face, world frame \[m\].
    #[must_use]
    pub fn centre(&self) -> Vector3<f64> {
        self.pose.translation.vector
    }

    /// Pole of the face seen from above, world frame \[m\].
    #[must_use]
    pub fn centre_xy(&self) -> [f64; 2] {
        [self.pose.translation.x, self.pose.translation.y]
    }

    /// Radius of the rim \[m\].
    #[must_use]
    pub fn rim_m(&self) -> f64 {
        self.surface.rim_m()
    }

    /// Axis of the face, out of the plate, world frame.
    #[must_use]
    pub fn axis(&self) -> Vector3<f64> {
        self.pose.rotation * Vector3::z()
    }

    /// Converts a point from the world frame to the plate frame \[m\].
    #[must_use]
    pub fn local(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.pose.inverse_transform_point(&Point3::from(*point)).coords
    }

    /// Converts a point from the plate frame to the world frame \[m\].
    #[must_use]
    pub fn world(&self, point: &Vector3<f64>) -> Vector3<f64> {
        self.pose.transform_point(&Point3::from(*point)).coords
    }

    /// Height of a point of the world over the face, along its axis \[m\].
    #[must_use]
    pub fn height_of(&self, point: &Vector3<f64>) -> f64 {
        let local = self.local(point);
        local.z - self.surface.height_m(local.xy().norm())
    }

    /// Normal of the face at the place under a point of the world, seen along the axis; world frame.
    #[must_use]
    pub fn normal_at(&self, point: &Vector3<f64>) -> Vector3<f64> {
        let local = self.local(point);
        let phi = platewash_kinematics::trig::atan2(local.y, local.x);
        self.pose.rotation * self.surface.normal(local.xy().norm(), phi).into_inner()
    }

    /// Range of the face and the body along the axis, relative to the pole \[m\].
    #[must_use]
    pub fn extent_m(&self) -> [f64; 2] {
        let [least, most] = self.surface.height_bounds_m();
        let below = self.foot.map_or(0.0, |foot| foot.height_m);
        let grown_m = self.deviation_m();
        [
            (-self.thickness_m - below).min(least - self.thickness_m) - grown_m,
            most + grown_m,
        ]
    }

    /// Greatest distance of the real plate from its face and its body \[m\].
    #[must_use]
    pub fn deviation_m(&self) -> f64 {
        self.terms.deviation_m.unwrap_or(0.0)
    }

    /// Radius of the body \[m\]: that of the rim, or more if the real plate deviates.
    #[must_use]
    pub fn outer_m(&self) -> f64 {
        self.rim_m() + self.deviation_m()
    }

    /// Checks that the plate has a valid size and pose.
    #[must_use]
    pub fn is_sound(&self) -> bool {
        let sizes = [self.rim_m(), self.thickness_m];
        let places = self.pose.translation.vector;
        let is_size = |size: f64| size > LEAST_PLATE_M && size <= GREATEST_M;
        sizes.into_iter().all(is_size)
            && self.foot.is_none_or(|foot| foot.is_sound(self.rim_m()))
            && places.iter().all(|place| place.abs() <= GREATEST_M)
            && pose::is_sound(&self.pose)
            && self.terms.is_sound()
    }
}

/// Significant digits of an angle.
pub(crate) const DIGITS: usize = 9;

/// Factor for rounding the components of a direction.
pub(crate) const PARTS: f64 = 1e9;

impl Plate {
    /// Describes the tilt of a plate that does not lie level: `tilted by 60°, axis (0.433012702, 0.75, 0.5)`, in the frame of its pose.
    /// Returns `None` for a level plate.
    #[must_use]
    pub fn tilt_words(&self) -> Option<String> {
        if self.is_level() {
            return None;
        }
        let axis = self.axis();
        // A zero has no sign.
        let told = |part: &f64| ((PARTS * part).round() / PARTS + 0.0).to_string();
        let tilt_deg = atan2(axis.xy().norm(), axis.z).to_degrees();
        let parts: Vec<_> = axis.iter().map(told).collect();
        Some(format!(
            "tilted by {}°, axis ({})",
            rounded(tilt_deg, DIGITS),
            parts.join(", ")
        ))
    }
}
