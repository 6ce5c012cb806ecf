//! The contact points of a stroke on a plate.

use super::settings::CHORD_ERROR_M;
use nalgebra::Vector3;
use platewash_workcell::stroke::Stroke;

/// Contact points, densely along a stroke.
#[derive(Debug, Clone)]
pub(super) struct Samples {
    /// The stroke.
    pub stroke: Stroke,
    /// Its centre at the height of the tip \[m\], base frame.
    pub centre: Vector3<f64>,
    /// θ \[rad\], ascending.
    pub theta: Vec<f64>,
    /// Contact points \[m\], base frame.
    pub contact: Vec<Vector3<f64>>,
    /// Length along the stroke up to each \[m\].
    pub length_m: Vec<f64>,
}

impl Samples {
    /// Points of `stroke` around `centre` \[m\], as dense as [`CHORD_ERROR_M`] asks.
    pub fn new(stroke: &Stroke, centre: Vector3<f64>) -> Self {
        let theta = stroke.parameters(CHORD_ERROR_M);
        let mut samples = Self {
            stroke: *stroke,
            centre,
            contact: Vec::with_capacity(theta.len()),
            length_m: Vec::with_capacity(theta.len()),
            theta,
        };
        let mut length = 0.0;
        for &theta in &samples.theta {
            let contact = samples.at(theta);
            length += samples.contact.last().map_or(0.0, |last| (contact - last).norm());
            samples.contact.push(contact);
            samples.length_m.push(length);
        }
        samples
    }

    /// The contact point at θ \[rad\].
    pub fn at(&self, theta: f64) -> Vector3<f64> {
        let here = self.stroke.at(theta).position;
        self.centre + Vector3::new(here.x, here.y, 0.0)
    }

    /// Its derivative by θ \[m/rad\].
    pub fn first(&self, theta: f64) -> Vector3<f64> {
        let first = self.stroke.at(theta).first;
        Vector3::new(first.x, first.y, 0.0)
    }

    /// Length of the whole stroke \[m\].
    pub fn whole_m(&self) -> f64 {
        self.length_m.last().copied().unwrap_or(0.0)
    }

    /// θ at `count` ≥ 2 points at equal lengths along the stroke, both ends included.
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
