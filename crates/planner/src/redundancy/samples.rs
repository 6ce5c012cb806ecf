//! The contact points of a wash path.

use super::settings::CHORD_ERROR_M;
use crate::scene::{AxisRule, Contact};
use nalgebra::{Vector2, Vector3};
use platewash_workcell::plate::Plate;
use platewash_workcell::wash_path::WashPath;

/// Contact points, densely along a wash path.
#[derive(Debug, Clone)]
pub(super) struct Samples {
    path: WashPath,
    plate: Plate,
    axis: AxisRule,
    /// θ \[rad\], ascending.
    pub theta: Vec<f64>,
    /// Contact points \[m\], base frame.
    pub contact: Vec<Contact>,
    /// Length along the wash path up to each \[m\].
    pub length_m: Vec<f64>,
}

impl Samples {
    /// Points of a wash path on its plate, as dense as [`CHORD_ERROR_M`] asks, with the axis by its share of the slope.
    pub fn new(path: &WashPath, plate: &Plate, axis_share: f64) -> Self {
        let theta = path.curve.parameters(&plate.surface, CHORD_ERROR_M);
        let mut samples = Self {
            path: *path,
            plate: *plate,
            axis: AxisRule::new(&plate.surface, axis_share),
            contact: Vec::with_capacity(theta.len()),
            length_m: Vec::with_capacity(theta.len()),
            theta,
        };
        let mut length = 0.0;
        for &theta in &samples.theta {
            let contact = samples.at(theta);
            let before = samples.contact.last();
            length += before.map_or(0.0, |last| (contact.point - last.point).norm());
            samples.contact.push(contact);
            samples.length_m.push(length);
        }
        samples
    }

    /// The contact point at θ \[rad\].
    pub fn at(&self, theta: f64) -> Contact {
        let here = self.path.curve.on(&self.plate.surface, theta);
        let (point, normal) = (self.plate.world(&here.position), self.plate.pose.rotation * here.normal);
        if self.plate.surface.is_flat() {
            return Contact::on_normal(point, normal);
        }
        let [arc_m, ..] = self.path.curve.arc(theta);
        let [c, s] = self.axis.direction(arc_m);
        let out = here.position.xy().try_normalize(0.0).unwrap_or_else(Vector2::x);
        let axis = self.plate.pose.rotation * Vector3::new(-s * out.x, -s * out.y, c);
        Contact { point, normal, axis }
    }

    /// The derivative of the contact point by θ \[m/rad\].
    pub fn first(&self, theta: f64) -> Vector3<f64> {
        let here = self.path.curve.on(&self.plate.surface, theta);
        self.plate.pose.rotation * here.first
    }

    /// Length of the whole wash path \[m\].
    pub fn whole_m(&self) -> f64 {
        self.length_m.last().copied().unwrap_or(0.0)
    }

    /// θ at `count` ≥ 2 points at equal lengths along the wash path, both ends included.
    pub fn evenly(&self, count: usize) -> Vec<f64> {
        let last = count.saturating_sub(1).max(1);
        let whole = self.whole_m();
        let mut piece = 0;
        let at = |k: usize| {
            let length = whole * k as f64 / last as f64;
            while piece + 2 < self.length_m.len() && self.length_m[piece + 1] < length {
                piece += 1;
            }
            let ends = [piece, (piece + 1).min(self.theta.len() - 1)];
            let [from, to] = ends.map(|i| self.length_m[i]);
            let share = ((length - from) / (to - from).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
            let [from, to] = ends.map(|i| self.theta[i]);
            from + (to - from) * share
        };
        (0..=last).map(at).collect()
    }
}
