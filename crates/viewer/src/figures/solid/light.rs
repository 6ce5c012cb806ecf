//! Light: from above, from the left of who looks.

use super::camera::Camera;
use nalgebra::Vector3;

/// Red, green and blue from 0 to 1.
pub type Rgb = [f64; 3];

/// A colour as SVG writes it.
pub(super) fn written(rgb: Rgb) -> String {
    let [r, g, b] = rgb.map(|part| (255.0 * part.clamp(0.0, 1.0)).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Where light comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Light {
    key: Vector3<f64>,
    fill: Vector3<f64>,
    down: Vector3<f64>,
}

impl Light {
    pub(super) fn of(camera: &Camera) -> Self {
        let (right, towards) = (camera.right(), camera.towards_eye());
        let level = Vector3::new(towards.x, towards.y, 0.0);
        let level = if level.norm() > 1e-9 {
            level.normalize()
        } else {
            camera.up()
        };
        let up = Vector3::z();
        Self {
            key: (up * 1.25 - right * 0.7 + level * 0.75).normalize(),
            fill: (right * 0.9 + up * 0.15 + level * 0.4).normalize(),
            down: (up * -1.0 + right * 0.28 - level * 0.12).normalize(),
        }
    }

    /// A colour on a facet with that normal.
    pub(super) fn on(&self, colour: Rgb, normal: &Vector3<f64>) -> Rgb {
        let key = normal.dot(&self.key).max(0.0);
        let fill = normal.dot(&self.fill).max(0.0);
        let above = 0.5 + 0.5 * normal.z;
        let light = 0.55 + 0.5 * key + 0.14 * fill + 0.12 * above;
        colour.map(|part| part * light.min(1.18))
    }

    /// Where the shadow of a place falls on a plane \[m\]: point and normal of it.
    pub(super) fn shadow(&self, place: &Vector3<f64>, (on, normal): (&Vector3<f64>, &Vector3<f64>)) -> Vector3<f64> {
        let falls = (on - place).dot(normal) / self.down.dot(normal);
        place + self.down * falls
    }
}
