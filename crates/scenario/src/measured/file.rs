//! Measurement in metres, with what converts back to the file.

use crate::measured::axis::Frame;
use crate::measured::body::Extremes;
use crate::measured::error::Place;
use crate::measured::face::Relief;
use crate::measured::plate::MeasuredPlate;
use crate::measured::unit::Unit;
use nalgebra::{Rotation3, UnitQuaternion, Vector3};
use platewash_kinematics::Pose;
use platewash_kinematics::trig::atan2;
use platewash_workcell::surface::Surface;

/// Measurement in metres about its middle, with what converts back.
pub(super) struct File {
    pub(super) middle: Vector3<f64>,
    pub(super) unit: Unit,
    pub(super) unit_is_guessed: bool,
}

impl File {
    pub(super) fn place(&self, frame: &Frame, local: &Vector3<f64>) -> Place {
        let in_file = self.middle + frame.outside(local) / self.unit.length_m();
        Place {
            radius_m: local.xy().norm(),
            azimuth_deg: atan2(local.y, local.x).to_degrees(),
            in_file: in_file.into(),
        }
    }

    pub(super) fn pose(&self, frame: &Frame) -> Pose {
        let rotation = Rotation3::from_matrix_unchecked(frame.turn.transpose());
        let origin = self.middle * self.unit.length_m() + frame.origin;
        Pose::from_parts(origin.into(), UnitQuaternion::from_rotation_matrix(&rotation))
    }

    /// Returns the plate without a body. `extremes` are about the profile before it is raised to their middle.
    pub(super) fn plate(&self, frame: &Frame, surface: Surface, extremes: &Extremes, relief: Relief) -> MeasuredPlate {
        let [high_m, low_m] = [extremes.high.0, extremes.low.0];
        // Both are as far off; the place is that which was farther from the mean.
        let farthest = if high_m > -low_m {
            extremes.high.1
        } else {
            extremes.low.1
        };
        MeasuredPlate {
            surface,
            thickness_m: None,
            least_thickness_m: 0.0,
            foot: None,
            pose: self.pose(frame),
            unit: self.unit,
            unit_is_guessed: self.unit_is_guessed,
            deviation_m: 0.5 * (high_m - low_m),
            worst: self.place(frame, &(farthest - Vector3::z() * extremes.middle_m())),
            out_of_round_m: 0.0,
            relief,
        }
    }
}
