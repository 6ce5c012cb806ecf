//! Early decision on the clearance: a quick yes or no, and the pair that is too near.
//!
//! While the sponge washes every pair keeps the margin, with one exception: the sponge and some plates. It lies on the one
//! that it works on and runs over its rim by up to its radius, where a neighbour may lie ([`Plate::may_touch_beside`]).
//!
//! [`Plate::may_touch_beside`]: crate::plate::Plate::may_touch_beside

use crate::clearance::body::{BodyKind, place};
use crate::clearance::distance::{Separation, bracketed, separation};
use crate::clearance::model::{ClearanceModel, PairClearance, is_clear, nearest};
use crate::clearance::part::PlacedPart;
use platewash_kinematics::{BodyPoses, JointVector};

/// Function that computes a distance.
type Measure = fn(&PlacedPart<'_>, &PlacedPart<'_>) -> Separation;

impl ClearanceModel {
    /// True if every pair keeps `required_m` at `q` \[rad\]. False for NaN; touching pairs do not even keep 0.
    #[must_use]
    pub fn keeps_clearance(&self, q: &JointVector, required_m: f64) -> bool {
        self.all_keep(q, required_m, |_, _| true)
    }

    /// True if every pair keeps `required_m` at `q` \[rad\], except the sponge and the plates that it may touch while it works on
    /// `working_on`; otherwise as [`ClearanceModel::keeps_clearance`].
    #[must_use]
    pub fn keeps_washing(&self, q: &JointVector, working_on: usize, required_m: f64) -> bool {
        self.all_keep(q, required_m, |a, b| self.counts_washing(working_on, a, b))
    }

    /// Returns the nearest of the pairs that [`ClearanceModel::keeps_washing`] finds too near; `None` if there are none.
    #[must_use]
    pub fn nearest_washing(&self, q: &JointVector, working_on: usize, required_m: f64) -> Option<PairClearance> {
        let poses = self.robot.fk(q);
        let placed = place(&self.bodies, &poses);
        let counting = self
            .pairs
            .iter()
            .filter(|&&(a, b)| self.counts_washing(working_on, a, b));
        let too_near = counting.filter_map(|&(a, b)| {
            let found = |measure: Measure| {
                let parts = self.part_pairs(a, b);
                nearest(parts.filter_map(|(p, r)| {
                    let outer = measure(&placed[a][p], &placed[b][r]);
                    if is_clear(outer.distance, required_m) {
                        return Some(outer);
                    }
                    let within = self.within((a, b), (p, r), &poses, measure, f64::INFINITY);
                    within.unwrap_or(Some(outer))
                }))
            };
            // Found quickly, named exactly.
            let exactly = || found(|p, r| bracketed(p, r).0);
            (!is_clear(found(separation).distance, required_m)).then(|| (a, b, exactly()))
        });
        let (a, b, found) = too_near.min_by(|x, y| x.2.distance.total_cmp(&y.2.distance))?;
        Some(self.describe(a, b, found))
    }

    /// True if a pair must keep clear while the sponge washes a plate.
    fn counts_washing(&self, working_on: usize, a: usize, b: usize) -> bool {
        use BodyKind::{Plate, Sponge};
        match (self.bodies[a].kind, self.bodies[b].kind) {
            (Sponge, Plate(plate)) | (Plate(plate), Sponge) => !self.may_touch(working_on, plate),
            _ => true,
        }
    }

    /// Stops at the first pair that is too near, and computes a distance only where boxes and bounding spheres do not decide.
    fn all_keep(&self, q: &JointVector, required: f64, counts: impl Fn(usize, usize) -> bool) -> bool {
        let poses = self.robot.fk(q);
        let is_enough = |gap: f64| gap > 0.0 && gap >= required;
        let mut first = Vec::with_capacity(self.bodies.len());
        let mut frames = Vec::with_capacity(4 * self.bodies.len());
        for body in &self.bodies {
            first.push(frames.len());
            // Few obstacles are examined, if any.
            let looked_at = body.outer().iter().filter(|_| body.kind != BodyKind::Obstacle);
            frames.extend(looked_at.map(|part| part.rigid(&poses)));
        }
        let rigid = |body: usize, part: usize| match &self.bodies[body] {
            stands if stands.kind == BodyKind::Obstacle => stands.outer()[part].rigid(&poses),
            _ => frames[first[body] + part],
        };
        let keeps = |(a, b): (usize, usize), (p, r): (usize, usize)| {
            let (part, other) = (&self.bodies[a].outer()[p], &self.bodies[b].outer()[r]);
            let (here, there) = (rigid(a, p), rigid(b, r));
            is_enough(part.gap_to_sphere(&here, other, &there.translation))
                || is_enough(other.gap_to_sphere(&there, part, &here.translation))
                || is_clear(separation(&part.place(&poses), &other.place(&poses)).distance, required)
                || self.parts_keep((a, b), (p, r), &poses, required)
        };
        let mut counting = self.others.iter().filter(|&&(a, b)| counts(a, b));
        // Obstacles always count.
        let keeps_from_obstacles = |(a, leaves): &(usize, Vec<bool>)| {
            self.bodies[*a].outer().iter().enumerate().all(|(p, part)| {
                let placed = part.place(&poses);
                let mut near = self.crowd.obstacles_near(leaves, &placed, is_enough);
                near.all(|b| (0..self.bodies[b].outer().len()).all(|r| keeps((*a, b), (p, r))))
            })
        };
        counting.all(|&(a, b)| self.part_pairs(a, b).all(|parts| keeps((a, b), parts)))
            && self.crowd.moving.iter().all(keeps_from_obstacles)
    }

    /// True if the parts of a body with a tree are clear of a part of another one; false if neither body has one.
    fn parts_keep(&self, bodies: (usize, usize), parts: (usize, usize), poses: &BodyPoses, required: f64) -> bool {
        // A pair at this distance or beyond is clear.
        let below = required.max(f64::MIN_POSITIVE);
        let found = self.within(bodies, parts, poses, separation, below);
        found.is_some_and(|found| found.is_none_or(|found| is_clear(found.distance, required)))
    }
}
