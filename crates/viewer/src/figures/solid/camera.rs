//! Where a place of the world is seen.

use super::super::ink::drawing::{Rect, Spot};
use nalgebra::{Matrix3, Vector3};
use platewash_kinematics::trig::sin_cos;

/// Nothing nearer to the eye is drawn \[m\].
const NEAREST_M: f64 = 0.05;

/// An eye and a sheet: central projection.
#[derive(Debug, Clone, PartialEq)]
pub struct Camera {
    /// Where the eye is, world frame \[m\].
    pub eye: Vector3<f64>,
    /// Rows: to the right, upwards, away from the eye.
    view: Matrix3<f64>,
    scale: f64,
    shift: [f64; 2],
}

impl Camera {
    /// An eye that looks at a place from an azimuth, counter-clockwise from x, and an elevation \[rad\], at a distance \[m\].
    #[must_use]
    pub fn looking_at(target: Vector3<f64>, [azimuth, elevation]: [f64; 2], distance_m: f64) -> Self {
        let ((sa, ca), (se, ce)) = (sin_cos(azimuth), sin_cos(elevation));
        let towards_eye = Vector3::new(ce * ca, ce * sa, se);
        let right = Vector3::new(-sa, ca, 0.0);
        let up = towards_eye.cross(&right);
        let rows = [right, up, -towards_eye].map(|row| row.transpose());
        Self {
            eye: target + towards_eye * distance_m,
            view: Matrix3::from_rows(&rows),
            scale: 1.0,
            shift: [0.0; 2],
        }
    }

    /// The same, so that these places fill a room of the sheet, in its middle.
    #[must_use]
    pub fn fitted(self, places: impl IntoIterator<Item = Vector3<f64>>, room: Rect) -> Self {
        let plain = Self {
            scale: 1.0,
            shift: [0.0; 2],
            ..self
        };
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for place in places {
            if let Some(spot) = plain.see(&place) {
                low = [low[0].min(spot[0]), low[1].min(spot[1])];
                high = [high[0].max(spot[0]), high[1].max(spot[1])];
            }
        }
        let needs = [high[0] - low[0], high[1] - low[1]];
        if !needs.iter().all(|need| *need > 0.0 && need.is_finite()) {
            return plain;
        }
        let scale = (room.size[0] / needs[0]).min(room.size[1] / needs[1]);
        let middle = room.middle();
        let shift = [0, 1].map(|k| middle[k] - 0.5 * scale * (low[k] + high[k]));
        Self { scale, shift, ..plain }
    }

    /// Where a place is seen; `None` behind the eye, or next to it.
    #[must_use]
    pub fn see(&self, place: &Vector3<f64>) -> Option<Spot> {
        let seen = self.view * (place - self.eye);
        let near = seen.z < NEAREST_M;
        let spot = [seen.x, -seen.y].map(|c| c / seen.z);
        (!near).then(|| [0, 1].map(|k| self.shift[k] + self.scale * spot[k]))
    }

    /// The direction to the right, world frame.
    #[must_use]
    pub fn right(&self) -> Vector3<f64> {
        self.view.row(0).transpose()
    }

    /// The direction upwards on the sheet, world frame.
    #[must_use]
    pub fn up(&self) -> Vector3<f64> {
        self.view.row(1).transpose()
    }

    /// The direction from the place that is looked at to the eye, world frame.
    #[must_use]
    pub fn towards_eye(&self) -> Vector3<f64> {
        -self.view.row(2).transpose()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_to_the_right_and_above_is_seen_there() {
        let places = [[0.0, 0.5, 0.0], [0.0, -0.5, 0.0], [0.0, 0.0, 0.6]].map(Vector3::from);
        let room = Rect::new(10.0, 20.0, 300.0, 200.0);
        // From the front of the arm: its left is to the right.
        let camera = Camera::looking_at(Vector3::zeros(), [0.0, 0.3], 3.0).fitted(places, room);
        let spot = |place: [f64; 3]| camera.see(&Vector3::from(place)).unwrap();
        assert!(spot([0.0, 0.1, 0.0])[0] > spot([0.0; 3])[0]);
        assert!(spot([0.0, 0.0, 0.1])[1] < spot([0.0; 3])[1]);
        for place in places {
            let at = camera.see(&place).unwrap();
            assert!(
                Rect::new(9.9, 19.9, 300.2, 200.2).holds(&Rect { at, size: [0.0; 2] }),
                "{at:?}"
            );
        }
        assert_eq!(camera.see(&(camera.eye + camera.towards_eye())), None);
    }
}
