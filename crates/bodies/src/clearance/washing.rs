//! Early decision on the clearance: a quick yes or no, and the pair that is too near.
//!
//! While the sponge washes every pair keeps the margin, with one exception: the sponge and some plates. It lies on the one
//! that it works on and runs over its rim by up to its radius, where a neighbour may lie ([`Plate::may_touch_beside`]).
//!
//! [`Plate::may_touch_beside`]: platewash_workcell::plate::Plate::may_touch_beside

use crate::clearance::body::{BodyKind, place};
use crate::clearance::distance::{DISTANCE_ROUNDING_M, Separation, bracketed, separation, separation_below};
use crate::clearance::model::{ClearanceModel, nearest};
use crate::clearance::pair_clearance::{PairClearance, is_clear, required_of};
use crate::clearance::part::PlacedPart;
use platewash_kinematics::JointVector;
use platewash_kinematics::rotation::RigidTransform;
use std::cell::OnceCell;

/// Function that computes a distance.
type Measure = fn(&PlacedPart<'_>, &PlacedPart<'_>) -> Separation;

impl ClearanceModel {
    /// True if every pair keeps `required_m` at `q` \[rad\]. False for NaN; touching pairs do not even keep 0.
    #[must_use]
    pub fn keeps_clearance(&self, q: &JointVector, required_m: f64) -> bool {
        self.levels_kept(q, None, &[required_m]) == 1
    }

    /// Number of clearances \[m\], from the first of an ascending list, that every pair keeps at `q` \[rad\], except the sponge and the plates
    /// that it may touch while it works on `working_on`, if on any. None for NaN.
    #[must_use]
    pub fn levels_kept(&self, q: &JointVector, working_on: Option<usize>, required_m: &[f64]) -> usize {
        self.levels_kept_by(q, required_m, |a, b| {
            working_on.is_none_or(|plate| self.counts_washing(plate, a, b))
        })
    }

    /// Returns the nearest of the pairs that [`ClearanceModel::levels_kept`] finds too near while the sponge washes; `None` if there are none.
    #[must_use]
    pub fn nearest_washing(&self, q: &JointVector, working_on: usize, required_m: f64) -> Option<PairClearance> {
        let poses = self.robot.fk(q);
        let placed = place(&self.bodies, &poses);
        let counting = self
            .pairs
            .iter()
            .filter(|&&(a, b)| self.counts_washing(working_on, a, b));
        let too_near = counting.filter_map(|&(a, b)| {
            let required_m = required_of(required_m, self.reduced_by_m(a, b));
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

    /// Stops at the first pair that keeps no level, and computes a distance only where boxes and bounding spheres do not decide: first those
    /// of whole bodies, then those of their parts.
    fn levels_kept_by(&self, q: &JointVector, required: &[f64], counts: impl Fn(usize, usize) -> bool) -> usize {
        let poses = self.robot.fk(q);
        let is_enough = |gap: f64, required: f64| gap > 0.0 && gap >= required;
        let balls: Vec<_> = self.balls.iter().map(|ball| ball.placed(&poses)).collect();
        let is_apart = |a: usize, b: usize, required: f64| {
            let ((here, radius_m), (there, other_m)) = (balls[a], balls[b]);
            is_enough(
                (there - here).norm() - radius_m - other_m - DISTANCE_ROUNDING_M,
                required,
            )
        };
        let frames: Vec<OnceCell<Vec<RigidTransform>>> = vec![OnceCell::new(); self.bodies.len()];
        let rigid = |body: usize, part: usize| {
            let placed = || {
                self.bodies[body]
                    .outer()
                    .iter()
                    .map(|part| part.rigid(&poses))
                    .collect()
            };
            frames[body].get_or_init(placed)[part]
        };
        // Distance of two parts \[m\], or a lower bound of it that is enough for the last level.
        let least_m = |(a, b): (usize, usize), (p, r): (usize, usize), most: f64| {
            let (part, other) = (&self.bodies[a].outer()[p], &self.bodies[b].outer()[r]);
            let (here, there) = (rigid(a, p), rigid(b, r));
            let gap = part.gap_to_sphere(&here, other, &there.translation);
            if is_enough(gap, most) {
                return gap;
            }
            let gap = other.gap_to_sphere(&there, part, &here.translation);
            if is_enough(gap, most) {
                return gap;
            }
            // A pair at this distance or beyond is clear.
            let below = most.max(f64::MIN_POSITIVE);
            let measure = |p: &PlacedPart<'_>, r: &PlacedPart<'_>| separation_below(p, r, below);
            let outer = measure(&part.place_at(&here), &other.place_at(&there)).distance;
            if is_clear(outer, most) {
                return outer;
            }
            match self.within((a, b), (p, r), &poses, measure, below) {
                None => outer,
                Some(inner) => outer.max(inner.map_or(f64::INFINITY, |inner| inner.distance)),
            }
        };
        let mut levels = required;
        for &(a, b) in &self.others {
            let Some(&most) = levels.last() else { return 0 };
            if is_apart(a, b, most) || !counts(a, b) {
                continue;
            }
            let reduced_by_m = self.reduced_by_m(a, b);
            for parts in self.part_pairs(a, b) {
                levels = lowered(levels, reduced_by_m, |most| least_m((a, b), parts, most));
            }
        }
        // Obstacles always count.
        for (a, leaves) in &self.crowd.moving {
            for (p, part) in self.bodies[*a].outer().iter().enumerate() {
                let Some(&most) = levels.last() else { return 0 };
                let placed = part.place(&poses);
                for b in self.crowd.obstacles_near(leaves, &placed, |gap| is_enough(gap, most)) {
                    for r in 0..self.bodies[b].outer().len() {
                        levels = lowered(levels, 0.0, |most| least_m((*a, b), (p, r), most));
                    }
                }
            }
        }
        levels.len()
    }
}

/// The levels of an ascending list that the distance of a pair keeps, which need not keep all of them; it is measured for the last one.
fn lowered(levels: &[f64], reduced_by_m: f64, distance_m: impl Fn(f64) -> f64) -> &[f64] {
    let Some(&most) = levels.last() else { return levels };
    let distance_m = distance_m(most);
    let kept = levels
        .iter()
        .rposition(|level| is_clear(distance_m, required_of(*level, reduced_by_m)));
    &levels[..kept.map_or(0, |last| last + 1)]
}
