//! Bundles of moments, of which those far from a point are passed over together.

use crate::contact::moment::Moment;
use crate::contact::sponge_pose::SpongePose;
use nalgebra::Vector3;
use std::ops::Range;

/// Sizes of the bundles of moments, each a part of the one before.
const SIZES: [usize; 3] = [64, 16, 4];

/// Enlargement of the bound of a bundle, far above rounding errors \[m\].
const ENLARGED_M: f64 = 1e-9;

/// Moments in bundles of the sizes `SIZES`; the parts of a bundle follow it.
#[derive(Debug, Clone)]
pub struct Bundles(Vec<Bundle>);

/// Bound on the poses of some consecutive moments and of their neighbours on either side.
#[derive(Debug, Clone)]
struct Bundle {
    /// Pose near all of them.
    pose: SpongePose,
    /// Greatest distance of a tip from that one \[m\].
    tip_m: f64,
    /// Greatest distance of an axis from that one; both are unit vectors.
    axis: f64,
    moments: Range<usize>,
    /// Number of its parts, and of theirs.
    parts: usize,
}

impl Bundles {
    /// Bundles some moments in order.
    #[must_use]
    pub fn new(moments: &[Moment]) -> Self {
        let mut all = Vec::new();
        Bundle::add(&mut all, moments, 0..moments.len(), &SIZES);
        Self(all)
    }

    /// Returns ranges of moments, in order: all others, and their neighbours, have the axis farther than a radius from a point.
    pub fn near<'a>(&'a self, radius_m: f64, point: &'a Vector3<f64>) -> impl Iterator<Item = Range<usize>> + 'a {
        let mut next = 0;
        std::iter::from_fn(move || {
            loop {
                let bundle = self.0.get(next)?;
                next += 1;
                if bundle.is_beyond(radius_m, point) {
                    next += bundle.parts;
                } else if bundle.parts == 0 {
                    return Some(bundle.moments.clone());
                }
            }
        })
    }
}

impl Bundle {
    /// Adds the bundles of a range of moments, and their parts.
    fn add(all: &mut Vec<Self>, moments: &[Moment], within: Range<usize>, sizes: &[usize]) {
        let Some((&size, parts)) = sizes.split_first() else {
            return;
        };
        for start in within.clone().step_by(size) {
            let own = start..(start + size).min(within.end);
            let place = all.len();
            all.push(Self::around(moments, own.clone()));
            Self::add(all, moments, own, parts);
            all[place].parts = all.len() - place - 1;
        }
    }

    /// Bound on some moments, without parts.
    fn around(moments: &[Moment], own: Range<usize>) -> Self {
        let poses = &moments[own.start.saturating_sub(1)..(own.end + 1).min(moments.len())];
        let pose = poses[poses.len() / 2].pose;
        let farthest = |of: fn(&SpongePose) -> Vector3<f64>| {
            let off = poses.iter().map(|moment| (of(&moment.pose) - of(&pose)).norm());
            off.fold(0.0, f64::max)
        };
        Self {
            pose,
            tip_m: farthest(|pose| pose.tip) + ENLARGED_M,
            axis: farthest(|pose| pose.axis),
            moments: own,
            parts: 0,
        }
    }

    /// Checks that a point is farther than a radius from the axes of all moments: ‖(x − tip) × a‖ changes by no more than the tip moves,
    /// and by ‖x − tip‖ times as much as the axis moves.
    fn is_beyond(&self, radius_m: f64, point: &Vector3<f64>) -> bool {
        let away = point - self.pose.tip;
        let (along, squared) = (away.dot(&self.pose.axis), away.norm_squared());
        let reach_m = radius_m + self.tip_m + (squared.sqrt() + self.tip_m) * self.axis;
        squared - along * along > reach_m * reach_m
    }
}
