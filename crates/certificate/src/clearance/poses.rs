//! Poses of the arm at the ends and in the middle of intervals. All pairs of bodies are examined at the same moments: each pose is computed
//! when it is first needed and kept. It depends on arm and motion alone, so that it is the same whoever asks first.

use crate::motion::timeline::{Interval, Timeline};
use platewash_kinematics::{BodyPoses, JointVector, RobotModel};
use std::borrow::Cow;
use std::sync::OnceLock;

/// Number of nodes of the halvings of a piece whose middles are kept: five levels.
const KEPT: usize = 32;

/// Poses along a motion.
#[derive(Debug)]
pub(crate) struct ArmPoses<'a> {
    robot: &'a RobotModel,
    timeline: &'a Timeline<'a>,
    pieces: Vec<PiecePoses>,
}

/// Poses at the ends of a piece, and in the middle of its halvings.
#[derive(Debug, Default)]
struct PiecePoses {
    ends: [OnceLock<Box<BodyPoses>>; 2],
    middles: OnceLock<Box<[OnceLock<BodyPoses>; KEPT]>>,
}

impl<'a> ArmPoses<'a> {
    /// Returns the poses of an arm along a motion, none of which is known yet.
    pub fn new(robot: &'a RobotModel, timeline: &'a Timeline<'a>) -> Self {
        let pieces = (0..timeline.count()).map(|_| PiecePoses::default()).collect();
        Self {
            robot,
            timeline,
            pieces,
        }
    }

    /// The motion.
    pub fn timeline(&self) -> &'a Timeline<'a> {
        self.timeline
    }

    /// Returns the poses in the middle of an interval, where the joints are at `q` \[rad\].
    pub fn middle(&self, interval: &Interval, q: &JointVector) -> Cow<'_, BodyPoses> {
        match *interval {
            Interval::Pieces { first, end, .. } if end - first > 1 => self.end(first + (end - first) / 2, 0, q),
            Interval::Pieces { first, .. } => self.within(first, 1, q),
            Interval::Within { piece, node, .. } => self.within(piece, node, q),
        }
    }

    /// Returns the poses at both ends of an interval.
    pub fn ends(&self, interval: &Interval) -> [Cow<'_, BodyPoses>; 2] {
        let [from, to] = &self.timeline.ends(interval);
        match *interval {
            Interval::Pieces { first, end, .. } => [self.end(first, 0, from), self.end(end - 1, 1, to)],
            Interval::Within { node: 0, .. } => [from, to].map(|q| Cow::Owned(self.robot.fk(q))),
            Interval::Within { piece, node, .. } => {
                // A half begins, or ends, in the middle of the last whole that it is not the first, or the last, part of.
                let (before, after) = (node >> node.trailing_zeros() >> 1, node >> node.trailing_ones() >> 1);
                let at = |whole: u64, end, q| match whole {
                    0 => self.end(piece, end, q),
                    _ => self.within(piece, whole, q),
                };
                [at(before, 0, from), at(after, 1, to)]
            }
        }
    }

    fn end(&self, piece: usize, end: usize, q: &JointVector) -> Cow<'_, BodyPoses> {
        let known = &self.pieces[piece].ends[end];
        Cow::Borrowed(known.get_or_init(|| Box::new(self.robot.fk(q))))
    }

    fn within(&self, piece: usize, node: u64, q: &JointVector) -> Cow<'_, BodyPoses> {
        if node == 0 || node >= KEPT as u64 {
            return Cow::Owned(self.robot.fk(q));
        }
        let middles = &self.pieces[piece].middles;
        let known = middles.get_or_init(|| Box::new(std::array::from_fn(|_| OnceLock::new())));
        Cow::Borrowed(known[node as usize].get_or_init(|| self.robot.fk(q)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::piece::Piece;
    use platewash_motion::piecewise::MotionPiece;
    use proptest::prelude::*;

    proptest! {
        /// Down a way through the halvings, to parts without a number, and twice: the first time computes the poses, the second finds them.
        #[test]
        fn kept_poses_are_those_of_the_joints(way in prop_oneof![prop::collection::vec(0..2usize, 80), Just(vec![0; 80])], last in 0..3usize) {
            let robot = RobotModel::irb120().unwrap();
            let q = |k: usize| JointVector::from_fn(|joint, _| 0.1 * (k + joint) as f64);
            // So long that a part without a number can still be halved.
            let line = |k: usize| MotionPiece::line([k as f64 * 1e12, (k + 1) as f64 * 1e12], [q(k), q(k + 1)]);
            let pieces: Vec<_> = (0..3).map(|k| Piece::from(&line(k))).collect();
            let timeline = Timeline::new(&pieces);
            let poses = ArmPoses::new(&robot, &timeline);
            for whole in [0..3, last..last + 1, 0..3, last..last + 1] {
                let mut interval = timeline.cover(&whole)[0];
                for half in &way {
                    let (_, middle) = timeline.middle(&interval);
                    prop_assert_eq!(&*poses.middle(&interval, &middle), &robot.fk(&middle));
                    for (kept, q) in poses.ends(&interval).iter().zip(timeline.ends(&interval)) {
                        prop_assert_eq!(&**kept, &robot.fk(&q));
                    }
                    let Some(halves) = timeline.halves(&interval) else { break };
                    interval = halves[*half];
                }
            }
        }
    }
}
