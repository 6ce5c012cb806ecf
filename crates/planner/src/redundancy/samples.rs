//! The contact points of a wash path.

use super::settings::CHORD_ERROR_M;
use crate::scene::Contact;
use crate::trig::atan2;
use nalgebra::Vector3;
use platewash_workcell::plate::Plate;
use platewash_workcell::wash_path::WashPath;

/// Contact points, densely along a wash path.
#[derive(Debug, Clone)]
pub(super) struct Samples {
    path: WashPath,
    plate: Plate,
    /// θ \[rad\], ascending.
    pub theta: Vec<f64>,
    /// Contact points \[m\], base frame.
    pub contact: Vec<Contact>,
    /// Length along the wash path up to each \[m\].
    pub length_m: Vec<f64>,
}

impl Samples {
    /// Points of a wash path on its plate, as dense as [`CHORD_ERROR_M`] asks.
    pub fn new(path: &WashPath, plate: &Plate) -> Self {
        let theta = path.curve.parameters(CHORD_ERROR_M);
        let mut samples = Self {
            path: *path,
            plate: *plate,
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
        let point = self.path.contact(&self.plate, theta);
        let normal = self.plate.normal_at(&point);
        Contact { point, normal }
    }

    /// The derivative of the contact point by θ \[m/rad\].
    pub fn first(&self, theta: f64) -> Vector3<f64> {
        let here = self.path.curve.at(theta);
        let (at, first) = (here.position, here.first);
        let n = self.plate.surface.normal(at.norm(), atan2(at.y, at.x));
        // Along the face: n · p′ = 0.
        let rise = 0.0 - (n.x * first.x + n.y * first.y) / n.z;
        self.plate.pose.rotation * Vector3::new(first.x, first.y, rise)
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
