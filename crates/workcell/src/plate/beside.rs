//! Position of two plates relative to each other, seen along the axis of one.

use crate::plate::Plate;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::kitchen_plate;
    use proptest::prelude::*;

    fn raised(plate: Plate, by_m: f64) -> Plate {
        plate.seen_from(&Pose::translation(0.0, 0.0, by_m))
    }

    /// By hand: the plates of the kitchen are 20 mm thick.
    #[test]
    fn plates_lie_beside_over_and_across_each_other() {
        let here = kitchen_plate([0.3, 0.0]);
        let beside = kitchen_plate([0.3, 0.4]);
        assert!(here.is_parallel(&beside) && (here.aside_m(&beside) - 0.4).abs() < 1e-15);
        assert!(here.may_touch_beside(&beside) && beside.may_touch_beside(&here));
        let over = raised(here, 0.0201);
        assert!(
            over.is_over(&here)
                && !here.is_over(&over)
                && !over.may_touch_beside(&here)
                && !here.may_touch_beside(&over)
        );
        let within = raised(here, 0.0199);
        assert!(!within.is_over(&here) && within.may_touch_beside(&here) && !here.may_touch_beside(&within));
        let turned = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 0.5);
        let tilted = beside.seen_from(&Pose::from_parts(Vector3::zeros().into(), turned));
        assert!(!here.is_parallel(&tilted) && !here.may_touch_beside(&tilted) && !tilted.may_touch_beside(&here));
    }

    #[test]
    fn both_faces_of_a_disc_are_back_to_back() {
        let turn = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, -1.2, 0.4));
        let plate = kitchen_plate([0.3, 0.1]).seen_from(&Pose::from_parts(Vector3::new(0.1, 0.2, 0.3).into(), turn));
        let [front, back] = plate.faces().unwrap();
        assert!(front.is_back_of(&back) && back.is_back_of(&front) && !front.is_back_of(&front));
        assert!((back.centre() - plate.world(&Vector3::new(0.0, 0.0, -0.02))).norm() < 1e-15);
        let thinner = Plate {
            thickness_m: 0.009,
            ..back
        };
        assert!(!front.is_back_of(&thinner) && !front.may_touch_beside(&back));
    }

    proptest! {
        /// A rigid motion of both plates does not change their relation, except where rounding decides it.
        #[test]
        fn a_common_motion_of_both_plates_changes_nothing(
            axis in prop::array::uniform3(-1.0..1.0f64), angle in -3.0..3.0f64, place in prop::array::uniform3(-1.0..1.0f64),
            at in prop::array::uniform2(-0.5..0.5f64), higher in -0.05..0.05f64, tilted in any::<bool>(),
        ) {
            prop_assume!(Vector3::from(axis).norm() > 0.1 && (higher.abs() - 0.02).abs() > 1e-6 && higher.abs() > 1e-6);
            let turn = |angle: f64| UnitQuaternion::from_scaled_axis(Vector3::from(axis).normalize() * angle);
            let here = kitchen_plate([0.3, 0.0]);
            let there = raised(kitchen_plate(at), higher);
            let there = if tilted { there.seen_from(&Pose::from_parts(Vector3::zeros().into(), turn(0.7))) } else { there };
            let by = Pose::from_parts(Vector3::from(place).into(), turn(angle));
            let moved = [here, there].map(|plate| plate.seen_from(&by));
            prop_assert_eq!(here.is_over(&there), moved[0].is_over(&moved[1]));
            prop_assert_eq!(here.may_touch_beside(&there), moved[0].may_touch_beside(&moved[1]));
            prop_assert!((here.aside_m(&there) - moved[0].aside_m(&moved[1])).abs() < 1e-12);
        }

        /// A disc reaches as far as its two rims do.
        #[test]
        fn a_disc_reaches_as_far_as_its_rims(way in prop::array::uniform3(-1.0..1.0f64), turn in prop::array::uniform3(-2.0..2.0f64)) {
            prop_assume!(Vector3::from(way).norm() > 0.1);
            let way = Vector3::from(way).normalize();
            let turn = UnitQuaternion::from_scaled_axis(Vector3::from(turn));
            let plate = kitchen_plate([0.2, -0.1]).seen_from(&Pose::from_parts(Vector3::zeros().into(), turn));
            let rim = (0..720).flat_map(|k| {
                let (s, c) = crate::trig::sin_cos(std::f64::consts::PI * f64::from(k) / 360.0);
                [0.0, -0.02].map(|z| plate.world(&Vector3::new(0.145 * c, 0.145 * s, z)).dot(&way))
            });
            let farthest = rim.fold(f64::NEG_INFINITY, f64::max);
            let reach = plate.reach_along_m(&way);
            prop_assert!(farthest <= reach + 1e-12 && reach - farthest < 1e-5, "{farthest} {reach}");
        }
    }
}
