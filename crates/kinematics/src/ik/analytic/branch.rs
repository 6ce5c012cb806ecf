//! The eight branches.

use super::arm::AnalyticArm;
use super::error::{AnalyticError, check_finite};
use super::label::{Degenerate, Elbow, Label, OutOfReach, Shoulder};
use super::position::{Bend, Goal, Swing};
use super::wrist::Turn;
use crate::JointVector;
use crate::rotation::Rigid;
use serde::Serialize;
use std::f64::consts::{PI, TAU};

/// A configuration that brings body 6 to the target; limits are not looked at.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Branch {
    /// Joint positions in (−π, π] \[rad\].
    pub q: JointVector,
    /// Its name.
    pub label: Label,
    /// Where it is degenerate.
    pub degenerate: Degenerate,
}

/// The eight branches of one target, each present or out of reach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Branches {
    slots: [Result<Branch, OutOfReach>; 8],
}

impl Branches {
    /// The branches within reach, in the order of [`Label::ALL`].
    pub fn iter(&self) -> impl Iterator<Item = &Branch> {
        self.slots.iter().filter_map(|slot| slot.as_ref().ok())
    }

    /// One branch by its label.
    ///
    /// # Errors
    /// [`OutOfReach`] when the label's shoulder side cannot reach the wrist centre.
    pub fn get(&self, label: Label) -> Result<Branch, OutOfReach> {
        self.slots[label.index()]
    }
}

impl AnalyticArm {
    /// All branches for `target`, `T_base_body6` of the folded chain (the pose of [`Frame`](crate::Frame) on body 6
    /// without offset; its rotation orthonormal to rounding). Free joints keep the value they have in `previous`
    /// \[rad\]. Limits are not looked at.
    ///
    /// # Errors
    /// [`AnalyticError::Target`] and [`AnalyticError::Start`] for input that is not finite.
    pub fn branches(&self, target: &Rigid, previous: &JointVector) -> Result<Branches, AnalyticError> {
        check_finite(target, previous)?;
        Ok(Branches {
            slots: self.all_branches(target, previous).map(|slot| Ok(slot?.0)),
        })
    }

    /// All branches in the order of [`Label::ALL`], each with its wrist.
    pub(super) fn all_branches(
        &self,
        target: &Rigid,
        previous: &JointVector,
    ) -> [Result<(Branch, Turn), OutOfReach>; 8] {
        let goal = self.goal(target);
        let of_side = |shoulder| {
            let (swing, bends) = self.arm_poses(&goal, shoulder, previous)?;
            let turns = bends.map(|bend| self.wrist(&swing, &bend, previous[3]));
            Ok((swing, bends, turns))
        };
        let sides = [Shoulder::Front, Shoulder::Back].map(of_side);
        Label::ALL.map(|label| {
            let (swing, bends, turns) = sides[label.shoulder as usize]?;
            let (bend, turn) = (bends[label.elbow as usize], turns[label.elbow as usize]);
            Ok((self.branch(label, &swing, &bend, &turn), turn))
        })
    }

    fn arm_poses(&self, goal: &Goal, side: Shoulder, previous: &JointVector) -> Result<(Swing, [Bend; 2]), OutOfReach> {
        let swing = self.swing(goal, side, previous[0])?;
        let triangle = self.triangle(&swing)?;
        let bends = [Elbow::Up, Elbow::Down].map(|elbow| self.bend(&triangle, side, elbow, previous[1]));
        Ok((swing, bends))
    }

    fn branch(&self, label: Label, swing: &Swing, bend: &Bend, turn: &Turn) -> Branch {
        let [q4, q5, q6] = self.wrist_joints(turn, label.wrist);
        let q = JointVector::new(swing.q1, bend.q2, bend.q3, q4, q5, q6);
        Branch {
            q: q.map(principal),
            label,
            degenerate: Degenerate {
                shoulder: swing.meets,
                elbow: bend.meets,
                wrist: turn.free,
            },
        }
    }
}

/// The angle in (−π, π] \[rad\], up to rounding.
fn principal(angle: f64) -> f64 {
    if -PI < angle && angle <= PI {
        return angle;
    }
    let turned = angle - TAU * (angle / TAU).round();
    if turned <= -PI { turned + TAU } else { turned }
}
