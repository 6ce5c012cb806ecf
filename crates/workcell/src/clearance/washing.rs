//! Clearance decided early: a quick yes or no, and what stands in the way.
//!
//! While the sponge washes every pair keeps the margin, with one exception: the sponge and the plates. It lies on the one
//! that it works on and runs over its rim by up to its radius, where a neighbour may lie.

use super::body::BodyKind;
use super::distance::{bracketed, separation};
use super::model::{ClearanceModel, PairClearance, is_clear, nearest};
use platewash_kinematics::JointVector;

impl ClearanceModel {
    /// Whether at `q` \[rad\] every pair keeps `required_m`. False for NaN; touching keeps nothing, not even 0.
    #[must_use]
    pub fn keeps(&self, q: &JointVector, required_m: f64) -> bool {
        self.all_keep(q, required_m, |_, _| true)
    }

    /// Whether at `q` \[rad\] every pair but the sponge and the plates keeps `required_m`; otherwise as
    /// [`ClearanceModel::keeps`].
    #[must_use]
    pub fn keeps_washing(&self, q: &JointVector, required_m: f64) -> bool {
        self.all_keep(q, required_m, |a, b| self.counts_washing(a, b))
    }

    /// The nearest of the pairs that [`ClearanceModel::keeps_washing`] finds too near; `None` where there is none.
    #[must_use]
    pub fn nearest_washing(&self, q: &JointVector, required_m: f64) -> Option<PairClearance> {
        let placed = self.place(q);
        let counting = self.pairs.iter().filter(|&&(a, b)| self.counts_washing(a, b));
        let too_near = counting.filter_map(|&(a, b)| {
            let parts = || self.part_pairs(a, b).map(|(p, r)| (&placed[a][p], &placed[b][r]));
            let found = nearest(parts().map(|(p, r)| separation(p, r)));
            // Found quickly, named exactly.
            let exactly = || nearest(parts().map(|(p, r)| bracketed(p, r).0));
            (!is_clear(found.distance, required_m)).then(|| (a, b, exactly()))
        });
        let (a, b, found) = too_near.min_by(|x, y| x.2.distance.total_cmp(&y.2.distance))?;
        Some(self.describe(a, b, found))
    }

    /// Whether a pair must keep clear while the sponge washes.
    fn counts_washing(&self, a: usize, b: usize) -> bool {
        use BodyKind::{Plate, Sponge};
        !matches!(
            (self.bodies[a].kind, self.bodies[b].kind),
            (Sponge, Plate(_)) | (Plate(_), Sponge)
        )
    }

    /// Stops at the first pair that is too near, and asks for a distance only where bounding spheres leave it open.
    fn all_keep(&self, q: &JointVector, required: f64, counts: impl Fn(usize, usize) -> bool) -> bool {
        let poses = self.robot.fk(q);
        let mut first = Vec::with_capacity(self.bodies.len());
        let mut frames = Vec::with_capacity(4 * self.bodies.len());
        for body in &self.bodies {
            first.push(frames.len());
            frames.extend(body.parts.iter().map(|part| part.rigid(&poses)));
        }
        let keeps = |(a, b): (usize, usize), (p, r): (usize, usize)| {
            let (part, other) = (&self.bodies[a].parts[p], &self.bodies[b].parts[r]);
            let (here, there) = (&frames[first[a] + p], &frames[first[b] + r]);
            let enough = |gap: f64| gap > 0.0 && gap >= required;
            enough(part.gap_to_sphere(here, other, there))
                || enough(other.gap_to_sphere(there, part, here))
                || is_clear(separation(&part.place(&poses), &other.place(&poses)).distance, required)
        };
        let mut counting = self.pairs.iter().filter(|&&(a, b)| counts(a, b));
        counting.all(|&(a, b)| self.part_pairs(a, b).all(|parts| keeps((a, b), parts)))
    }
}
