//! A job as its arm sees it: the world in the frame of the arm's base.

use super::terms::JobTerms;
use std::borrow::Cow;

impl JobTerms {
    /// The same terms in the frame of the arm's base: the arm is mounted at the origin, obstacles and plates are where the arm has
    /// them. Terms whose world is that frame are returned as they are.
    ///
    /// Joint positions, requirements and limits do not change: what is planned, proved or simulated for the one is for the other.
    #[must_use]
    pub fn seen_from_base(&self) -> Cow<'_, Self> {
        if self.workcell.is_in_base_frame() {
            return Cow::Borrowed(self);
        }
        let to_base = self.workcell.mount.inverse();
        Cow::Owned(Self {
            workcell: self.workcell.seen_from_base().into_owned(),
            plates: self.plates.iter().map(|plate| plate.seen_from(&to_base)).collect(),
            ..self.clone()
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::fixtures::kitchen;
    use nalgebra::{UnitQuaternion, Vector3};
    use platewash_kinematics::Pose;
    use std::borrow::Cow;

    #[test]
    fn a_job_on_the_floor_is_what_its_arm_sees() {
        assert!(matches!(kitchen().terms().seen_from_base(), Cow::Borrowed(_)));
    }

    /// By hand: a base at (1, 2, 0.5), turned by a quarter about z, has what is at (1.3, 2, 0.53) at (0, −0.3, 0.03).
    #[test]
    fn plates_and_obstacles_are_where_the_arm_has_them() {
        let mut terms = kitchen().terms().clone();
        let quarter = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::FRAC_PI_2);
        terms.workcell.mount = Pose::from_parts(Vector3::new(1.0, 2.0, 0.5).into(), quarter);
        terms.plates[0].pose = Pose::translation(1.3, 2.0, 0.53);
        let seen = terms.seen_from_base();
        assert_eq!(seen.workcell.mount, Pose::identity());
        assert!((seen.plates[0].centre() - Vector3::new(0.0, -0.3, 0.03)).norm() < 1e-12);
        assert!((seen.workcell.obstacles[0].pose.translation.vector - Vector3::new(-2.0, 1.0, -0.5)).norm() < 1e-12);
        assert_eq!(seen.home_rad, terms.home_rad);
    }
}
