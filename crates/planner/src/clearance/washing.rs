//! Clearance while the sponge works on a plate: a quick yes or no, and what stands in the way.
//!
//! Every pair keeps the margin, with one exception: the sponge runs over the rim of its plate, and so comes nearer to the
//! other plates, without touching them. Plates in `working` it may touch.

use super::{BodyKind, ClearanceModel, PairClearance, is_clear, nearest, separation};
use platewash_kinematics::JointVector;

/// What the bodies keep while the sponge washes; touching keeps nothing, not even 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WashingMargins {
    /// Every pair but those below \[m\].
    pub required_m: f64,
    /// The sponge and the plates that it must not touch \[m\].
    pub spared_m: f64,
}

impl ClearanceModel {
    /// Whether at `q` \[rad\] the bodies keep `margins` while the sponge washes the plates in `working`. False for NaN.
    ///
    /// Stops at the first pair that is too near, and asks for a distance only where bounding spheres leave it open.
    #[must_use]
    pub fn keeps_washing(&self, q: &JointVector, working: &[usize], margins: &WashingMargins) -> bool {
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
            self.asked_washing(a, b, working, margins)
                .is_none_or(|required| self.part_pairs(a, b).all(|parts| keeps((a, b), parts, required)))
        })
    }

    /// The nearest of the pairs that [`ClearanceModel::keeps_washing`] finds too near, and what it must keep \[m\]; `None`
    /// where there is none.
    #[must_use]
    pub fn nearest_washing(
        &self,
        q: &JointVector,
        working: &[usize],
        margins: &WashingMargins,
    ) -> Option<(PairClearance, f64)> {
        let placed = self.place(q);
        let too_near = |&(a, b): &(usize, usize)| {
            let required = self.asked_washing(a, b, working, margins)?;
            let parts = self.part_pairs(a, b).map(|(p, r)| (&placed[a][p], &placed[b][r]));
            let found = nearest(parts.map(|(p, r)| separation(p, r)));
            (!is_clear(found.distance, required)).then_some((a, b, found, required))
        };
        let all = self.pairs.iter().filter_map(too_near);
        let (a, b, found, required) = all.min_by(|x, y| x.2.distance.total_cmp(&y.2.distance))?;
        Some((self.describe(a, b, found), required))
    }

    /// The distance that a pair must keep \[m\]; `None` where it may touch.
    fn asked_washing(&self, a: usize, b: usize, working: &[usize], margins: &WashingMargins) -> Option<f64> {
        use BodyKind::{Plate, Sponge};
        match (self.bodies[a].kind, self.bodies[b].kind) {
            _ if self.exempt(a, b, working) => None,
            (Sponge, Plate(_)) | (Plate(_), Sponge) => Some(margins.spared_m),
            _ => Some(margins.required_m),
        }
    }
}
