//! A plate's axis in words.

use super::Plate;
use crate::trig::atan2;
use platewash_kinematics::words::rounded;

/// Significant digits of an angle.
const DIGITS: usize = 9;

/// What a part of a direction is told in.
const PARTS: f64 = 1e9;

impl Plate {
    /// How a plate stands that does not lie level: `tilted by 60°, axis (0.433012702, 0.75, 0.5)`, in the frame of its pose.
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

#[cfg(test)]
mod tests {
    use crate::fixtures::kitchen;
    use nalgebra::{UnitQuaternion, Vector3};

    #[test]
    fn a_tilted_plate_says_how_and_a_level_one_nothing() {
        let mut plate = kitchen().terms().plates[0];
        assert_eq!(plate.tilt_words(), None);
        let mut turned = |axis: Vector3<f64>, deg: f64| {
            plate.pose.rotation = UnitQuaternion::from_scaled_axis(axis * deg.to_radians());
            plate.tilt_words()
        };
        let said = turned(Vector3::y(), 60.0);
        assert_eq!(said.as_deref(), Some("tilted by 60°, axis (0.866025404, 0, 0.5)"));
        let said = turned(Vector3::x(), 180.0);
        assert_eq!(said.as_deref(), Some("tilted by 180°, axis (0, 0, -1)"));
        // About its own axis a plate is round.
        assert_eq!(turned(Vector3::z(), 30.0), None);
    }
}
