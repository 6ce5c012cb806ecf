//! Obstacles that stay far from a part of arm or tool: many are dismissed together, before pairs are examined one by one.
//!
//! The motion is halved until a part can be displaced by little compared with its distance from the obstacles. The pose and the
//! displacement of the part serve for all obstacles. The bound of an obstacle is the least over all intervals. An obstacle that comes too
//! near at a moment, or that short intervals do not settle, is left to the search over its pair.

use crate::clearance::poses::ArmPoses;
use crate::motion::timeline::{Interval, Timeline};
use platewash_bodies::clearance::ClearanceModel;
use platewash_bodies::clearance::far::MovingPart;
use platewash_workcell::cancel::CancelToken;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Displacement of a part in an interval below which the interval is not halved any more \[m\].
const SETTLED_M: f64 = 4e-3;

/// Returns the pairs of the model, by index, whose distance is never below `needed_m`, with a lower bound on the distance \[m\].
pub(crate) fn far(
    poses: &ArmPoses<'_>,
    cancel: &CancelToken,
    model: &ClearanceModel,
    pairs: &[usize],
    needed_m: f64,
) -> BTreeMap<usize, f64> {
    let timeline = poses.timeline();
    let parts = model.moving_parts(pairs);
    let bounds: Vec<_> = parts
        .par_iter()
        .map(|part| {
            let mut sweep = Sweep {
                poses,
                cancel,
                timeline,
                part,
                needed_m,
                bounds: vec![Some(f64::INFINITY); part.obstacle_count()],
            };
            let all: Vec<_> = (0..part.obstacle_count()).collect();
            for interval in timeline.cover(&(0..timeline.count())) {
                sweep.bound_obstacles(&interval, &all);
            }
            sweep.bounds
        })
        .collect();
    let mut least: BTreeMap<usize, Option<f64>> = BTreeMap::new();
    for (part, bounds) in parts.iter().zip(bounds) {
        for (obstacle, bound) in bounds.into_iter().enumerate() {
            let Some(pair) = part.pair(obstacle) else { continue };
            let entry = least.entry(pair).or_insert(Some(f64::INFINITY));
            *entry = entry.zip(bound).map(|(a, b)| a.min(b));
        }
    }
    let settled = least.into_iter().filter_map(|(pair, bound)| Some((pair, bound?)));
    // Without a motion there is nothing that a bound would be of.
    settled.filter(|(_, bound)| bound.is_finite()).collect()
}

/// Sweep of a part past the obstacles.
struct Sweep<'a> {
    poses: &'a ArmPoses<'a>,
    cancel: &'a CancelToken,
    timeline: &'a Timeline<'a>,
    part: &'a MovingPart<'a>,
    needed_m: f64,
    /// Lower bound on the distance of each obstacle \[m\]; `None` where it does not suffice.
    bounds: Vec<Option<f64>>,
}

impl Sweep<'_> {
    /// Bounds the distance of some obstacles over an interval, formula (24.2) in `docs/certificate.md`.
    fn bound_obstacles(&mut self, interval: &Interval, obstacles: &[usize]) {
        let (_, q) = self.timeline.middle(interval);
        let poses = &*self.poses.middle(interval, &q);
        let displaced_m = self.part.displaced(poses, &self.timeline.extent(interval).drift(&q));
        let mut open = Vec::new();
        for (&obstacle, gap_m) in obstacles.iter().zip(self.part.gaps(poses, obstacles)) {
            let Some(bound) = &mut self.bounds[obstacle] else {
                continue;
            };
            let here = gap_m - displaced_m;
            if here >= self.needed_m {
                *bound = bound.min(here);
            } else if gap_m >= self.needed_m && displaced_m > SETTLED_M {
                open.push(obstacle);
            } else {
                // NaN, too.
                self.bounds[obstacle] = None;
            }
        }
        if open.is_empty() {
            return;
        }
        match self.timeline.halves(interval) {
            Some(halves) if !self.cancel.is_cancelled() => {
                halves.iter().for_each(|half| self.bound_obstacles(half, &open))
            }
            _ => open.into_iter().for_each(|obstacle| self.bounds[obstacle] = None),
        }
    }
}
