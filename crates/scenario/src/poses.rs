//! Poses as files state them: a place, and roll, pitch and yaw in degrees.

use platewash_kinematics::Pose;
use platewash_kinematics::rotation::{Rigid, from_rpy};

/// The pose at a place \[m\], turned by roll, pitch and yaw about fixed axes in the order x, y, z \[deg\], as in URDF.
#[must_use]
pub(crate) fn pose(at_m: [f64; 3], rpy_deg: [f64; 3]) -> Pose {
    Pose::from(&Rigid {
        rotation: from_rpy(rpy_deg.map(f64::to_radians)),
        translation: at_m.into(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_turn_is_none_to_the_bit() {
        let at = [0.1, -0.2, 0.3];
        assert_eq!(pose(at, [0.0; 3]), Pose::translation(0.1, -0.2, 0.3));
        // z turned about x by 30° is (0, −½, √¾), and that about z by 90° is (½, 0, √¾).
        let turned = pose([0.0; 3], [30.0, 0.0, 90.0]) * Pose::translation(0.0, 0.0, 1.0);
        let expected = Pose::translation(0.5, 0.0, 0.75_f64.sqrt()).translation;
        assert!((turned.translation.vector - expected.vector).norm() < 1e-15, "{turned}");
    }
}
