//! Position of two plates relative to each other, seen along the axis of one.

use crate::plate::placed_plate::Plate;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use platewash_kinematics::Pose;

/// Greatest sine of the angle between the axes of two plates that count as parallel.
const PARALLEL: f64 = 1e-9;

/// Greatest difference of heights that count as equal: the rounding of positions \[m\].
const PLACE_M: f64 = 1e-9;

impl Plate {
    /// True if the axis of another plate points the same way.
    #[must_use]
    pub fn is_parallel(&self, other: &Self) -> bool {
        let (here, there) = (self.axis(), other.axis());
        here.cross(&there).norm() <= PARALLEL && here.dot(&there) > 0.0
    }

    /// Distance of the pole of another plate from this one's axis \[m\].
    #[must_use]
    pub fn aside_m(&self, other: &Self) -> f64 {
        let (axis, away) = (self.axis(), other.centre() - self.centre());
        (away - axis * axis.dot(&away)).norm()
    }

    /// Distance between the rims of two plates, seen along this plate's axis \[m\]; negative where one lies over the other.
    #[must_use]
    pub fn gap_beside_m(&self, other: &Self) -> f64 {
        self.aside_m(other) - self.outer_m() - other.outer_m()
    }

    /// True if the plate's axis is the z axis of its frame, so that it lies level.
    #[must_use]
    pub fn is_level(&self) -> bool {
        self.is_parallel(&Self::level_disc([0.0; 3], 1.0, 1.0))
    }

    /// True if all of this plate is above all of another, parallel one, along their axis.
    #[must_use]
    pub fn is_over(&self, other: &Self) -> bool {
        let ([below_m, _], [_, above_m]) = (self.extent_m(), other.extent_m());
        self.is_parallel(other) && below_m - self.higher_m(other) - above_m >= -PLACE_M
    }

    /// True if the highest point of another plate's face is above that of this one, along this one's axis. Also true for a plate that is
    /// not parallel.
    #[must_use]
    pub fn is_below(&self, other: &Self) -> bool {
        if !self.is_parallel(other) {
            return true;
        }
        let [own_m, top_m] = [self, other].map(|plate| plate.surface.height_bounds_m()[1]);
        self.higher_m(other) + top_m - own_m > PLACE_M
    }

    /// True if another plate is the other face of the same disc: each has a part of its thickness, and they lie back to back.
    #[must_use]
    pub fn is_back_of(&self, other: &Self) -> bool {
        let (here, there) = (self.axis(), other.axis());
        let flat = self.surface.is_flat() && self.surface == other.surface && self.foot.or(other.foot).is_none();
        let opposite = here.cross(&there).norm() <= PARALLEL && here.dot(&there) < 0.0;
        let apart_m = self.higher_m(other) + self.thickness_m + other.thickness_m;
        flat && opposite && self.aside_m(other) <= PLACE_M && apart_m.abs() <= PLACE_M
    }

    /// Returns both faces of a flat disc as plates, each with half of its thickness; `None` for any other plate.
    #[must_use]
    pub fn faces(&self) -> Option<[Self; 2]> {
        if !self.surface.is_flat() || self.foot.is_some() {
            return None;
        }
        // Half a turn about x, to the bit.
        let half_turn = UnitQuaternion::new_unchecked(Quaternion::new(0.0, 1.0, 0.0, 0.0));
        let back = Pose::from_parts(Vector3::new(0.0, 0.0, -self.thickness_m).into(), half_turn);
        let thickness_m = 0.5 * self.thickness_m;
        let front = Self { thickness_m, ..*self };
        let pose = self.pose * back;
        Some([front, Self { pose, ..front }])
    }

    /// True if the sponge may touch the rim of another plate while it washes this one: the other one lies beside it, no higher, and not
    /// under it. The sponge keeps clear of all others.
    #[must_use]
    pub fn may_touch_beside(&self, other: &Self) -> bool {
        !self.is_below(other) && !self.is_over(other)
    }

    /// Upper bound on the reach of the body along a direction, from the origin of the frame of its pose \[m\].
    #[must_use]
    pub fn reach_along_m(&self, direction: &Vector3<f64>) -> f64 {
        let cosine = self.axis().dot(direction);
        let [low, high] = self.extent_m();
        let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
        self.centre().dot(direction) + (low * cosine).max(high * cosine) + self.outer_m() * sine
    }

    /// Height of the pole of another plate over this one's pole, along this one's axis \[m\].
    fn higher_m(&self, other: &Self) -> f64 {
        self.axis().dot(&(other.centre() - self.centre()))
    }
}
