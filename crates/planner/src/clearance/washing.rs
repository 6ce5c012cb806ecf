//! Clearance while the sponge works on a plate: a quick yes or no, and what stands in the way.
//!
//! Every pair keeps the margin, with one exception: the sponge runs over the rim of its plate, and so may come as near
//! to the other plates as it likes without touching them. Plates in `working` it may touch.

use super::{BodyKind, ClearanceModel, PairClearance, is_clear, nearest, separation};
use platewash_kinematics::JointVector;

impl ClearanceModel {
    /// Whether at `q` \[rad\] every pair keeps `required_m` while the sponge washes: it may touch the plates in `working` and
    /// must only not touch the others. False for NaN.
    ///
    /// Stops at the first pair that is too near, and asks for a distance only where bounding spheres leave it open.
    #[must_use]
    pub fn keeps_washing(&self, q: &JointVector, working: &[usize], required_m: f64) -> bool {
        let poses = self.robot.fk(q);
        let mut first = Vec::with_capacity(self.bodies.len());
        let mut frames = Vec::with_capacity(4 * self.bodies.len());
        for body in &self.bodies {
            first.push(frames.len());
            frames.extend(body.parts.iter().map(|part| part.rigid(&poses)));
        }
        let keeps = |(a, b): (usize, usize), (p, r): (usize, usize), required: f64| {
            let (part, other) = (&self.bodies[a].parts[p], &self.bodies[b].parts[r]);
            let (here, there) = (&frames[first[a] + p], &frames[first[b] + r]);
            let enough = |gap: f64| gap > 0.0 && gap >= required;
            enough(part.gap_to_sphere(here, other, there))
                || enough(other.gap_to_sphere(there, part, here))
                || is_clear(separation(&part.place(&poses), &other.place(&poses)).distance, required)
        };
        self.pairs.iter().all(|&(a, b)| {
            self.asked_washing(a, b, working, required_m)
                .is_none_or(|required| self.part_pairs(a, b).all(|parts| keeps((a, b), parts, required)))
        })
    }

    /// The pair that [`ClearanceModel::keeps_washing`] finds too near and that is the nearest of them; `None` where it finds none.
    #[must_use]
    pub fn nearest_washing(&self, q: &JointVector, working: &[usize], required_m: f64) -> Option<PairClearance> {
        let placed = self.place(q);
        let mut worst: Option<(usize, usize, super::Separation)> = None;
        for &(a, b) in &self.pairs {
            let Some(required) = self.asked_washing(a, b, working, required_m) else {
                continue;
            };
            let parts = self.part_pairs(a, b).map(|(p, r)| (&placed[a][p], &placed[b][r]));
            let found = nearest(parts.map(|(p, r)| separation(p, r)));
            let nearer =
                |other: &(usize, usize, super::Separation)| found.distance.total_cmp(&other.2.distance).is_lt();
            if !is_clear(found.distance, required) && worst.as_ref().is_none_or(nearer) {
                worst = Some((a, b, found));
            }
        }
        worst.map(|(a, b, found)| self.describe(a, b, found))
    }

    /// The distance that a pair must keep \[m\]; `None` where it may touch.
    fn asked_washing(&self, a: usize, b: usize, working: &[usize], required_m: f64) -> Option<f64> {
        use BodyKind::{Plate, Sponge};
        match (self.bodies[a].kind, self.bodies[b].kind) {
            _ if self.exempt(a, b, working) => None,
            (Sponge, Plate(_)) | (Plate(_), Sponge) => Some(0.0),
            _ => Some(required_m),
        }
    }
}
