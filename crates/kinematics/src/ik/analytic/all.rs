//! All analytic answers within the limits, and the reasons that the other branches have none.
//!
//! A branch that ends beyond a limit by no more than the uncertainty of its joints is closed onto the limit.

use crate::ik::analytic::branch::{Branch, Degeneracies, Label, OutOfReach};
use crate::ik::analytic::equations::Turn;
use crate::ik::analytic::nearest::{Window, nearest_integer};
use crate::ik::analytic::{AnalyticArm, AnalyticError, CLOSED, LIMIT_ROUNDING_RAD, check_finite};
use crate::rotation::{RigidTransform, rotation_vector};
use crate::trig::sin_cos;
use crate::{AXES, JointLimits, JointVector, LimitViolation};
use nalgebra::{Complex, Matrix6, Vector6};
use serde::Serialize;
use std::f64::consts::TAU;

/// Filter that rejected a branch.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, thiserror::Error)]
pub enum Rejection {
    /// Its shoulder side cannot reach the wrist centre.
    #[error("out of reach: {0}")]
    OutOfReach(OutOfReach),
    /// The joint that misses its limits by most, at the turn that misses by least.
    #[error("joint {} at {} rad is beyond {} rad", .0.joint + 1, .0.position_rad, .0.limit_rad)]
    Limit(LimitViolation),
}

/// Branch within the limits, with every whole turn of its joints that the limits allow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solution {
    /// Name of the branch.
    pub label: Label,
    /// Degeneracies of the branch.
    pub degenerate: Degeneracies,
    /// Lowest value of every joint within the limits \[rad\].
    pub lowest: JointVector,
    /// Number of values, a whole turn apart, that each joint has within its limits. A continuous joint counts as one: the value nearest to
    /// `previous`.
    pub turns: [u32; AXES],
    upper: JointVector,
}

/// Configurations of a [`Solution`]: every combination of turns, joint 6 changing fastest.
#[derive(Debug, Clone)]
pub struct Configurations {
    solution: Solution,
    next: Option<[u32; AXES]>,
}

/// The eight branches of one target under limits, each a solution or the reason that there is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solutions {
    slots: [Result<Solution, Rejection>; 8],
}

impl Solution {
    /// Returns every configuration of this branch within the limits \[rad\].
    #[must_use]
    pub fn configurations(&self) -> Configurations {
        Configurations {
            solution: *self,
            next: Some([0; AXES]),
        }
    }
}

impl Iterator for Configurations {
    type Item = JointVector;

    fn next(&mut self) -> Option<JointVector> {
        let now = self.next?;
        let Solution {
            lowest, upper, turns, ..
        } = &self.solution;
        let mut after = now;
        // Count up, joint 6 first; past the last combination nothing is left.
        self.next = (0..AXES).rev().find(|&i| now[i] + 1 < turns[i]).map(|i| {
            after[i] += 1;
            after[i + 1..].fill(0);
            after
        });
        Some(JointVector::from_fn(|i, _| {
            (lowest[i] + TAU * f64::from(now[i])).min(upper[i])
        }))
    }
}

impl Solutions {
    /// Returns the branches with a configuration within the limits, in the order of [`Label::ALL`].
    pub fn iter(&self) -> impl Iterator<Item = &Solution> {
        self.slots.iter().filter_map(|slot| slot.as_ref().ok())
    }

    /// Returns every configuration within the limits \[rad\]. Branches that meet in a singularity repeat it.
    pub fn configurations(&self) -> impl Iterator<Item = (Label, JointVector)> {
        self.iter()
            .flat_map(|solution| solution.configurations().map(|q| (solution.label, q)))
    }

    /// Returns the branches without one, each with the filter that rejected it.
    pub fn rejections(&self) -> impl Iterator<Item = (Label, Rejection)> {
        let rejection = |(label, slot): (Label, &Result<Solution, Rejection>)| Some((label, slot.err()?));
        Label::ALL.into_iter().zip(&self.slots).filter_map(rejection)
    }

    /// Returns one branch by its label.
    ///
    /// # Errors
    /// [`Rejection`]: the filter that rejected it.
    pub fn get(&self, label: Label) -> Result<Solution, Rejection> {
        self.slots[label.index()]
    }
}

impl AnalyticArm {
    /// Returns all configurations within `limits` that bring body 6 to `target` (`T_base_body6`, as for [`AnalyticArm::branches`]):
    /// branches and whole turns of their joints. Free joints keep their value in `previous` \[rad\] (set to the nearer limit if it is
    /// outside) as far as the limits allow.
    ///
    /// # Errors
    /// [`AnalyticError::Target`] and [`AnalyticError::Start`] for input that is not finite. It is no error if no branch is within the
    /// limits: [`Solutions::rejections`] gives the reasons.
    pub fn solve_all(
        &self,
        target: &RigidTransform,
        previous: &JointVector,
        limits: &JointLimits,
    ) -> Result<Solutions, AnalyticError> {
        check_finite(target, previous)?;
        let window = Window::new(limits, previous);
        let kept = self.all_within(target, &window);
        if kept.iter().next().is_some() {
            return Ok(kept);
        }
        let goal = self.goal(target);
        let moved = self
            .critical_turns(&goal, &window)
            .map(|q1| self.all_within(target, &window.anchored(q1)))
            .find(|solutions| solutions.iter().next().is_some());
        Ok(moved.unwrap_or(kept))
    }

    pub(crate) fn all_within(&self, target: &RigidTransform, window: &Window<'_>) -> Solutions {
        let slots = self.all_branches(target, &window.anchor).map(|slot| match slot {
            Ok((branch, turn)) => self.solution(target, &branch, &turn, window),
            Err(miss) => Err(Rejection::OutOfReach(miss)),
        });
        Solutions { slots }
    }

    /// Returns the branch with its turns, or its worst joint.
    fn solution(
        &self,
        target: &RigidTransform,
        branch: &Branch,
        turn: &Turn,
        window: &Window<'_>,
    ) -> Result<Solution, Rejection> {
        let rejected = || {
            let misses = (0..AXES).map(|joint| window.miss(joint, branch.q[joint]));
            let worst = misses.fold(window.miss(0, branch.q[0]), |a, b| if b.0 > a.0 { b } else { a });
            Rejection::Limit(worst.1)
        };
        let q = self.branch_within(target, branch, turn, window).ok_or_else(rejected)?;
        let mut lowest = q;
        let mut turns = [1; AXES];
        for joint in 0..AXES {
            (lowest[joint], turns[joint]) = turns_within(q[joint], window.limits, joint);
        }
        Ok(Solution {
            label: branch.label,
            degenerate: branch.degenerate,
            lowest,
            turns,
            upper: window.limits.upper,
        })
    }

    /// Returns the branch's configuration nearest to the start, within the limits.
    fn branch_within(
        &self,
        target: &RigidTransform,
        branch: &Branch,
        turn: &Turn,
        window: &Window<'_>,
    ) -> Option<JointVector> {
        let [q1, q2, q3] = [0, 1, 2].map(|joint| window.value(joint, branch.q[joint]));
        let [q4, q5, q6] = self.wrist_within(turn, branch.label.wrist, window)?;
        let q = JointVector::new(q1?, q2?, q3?, q4, q5, q6);
        self.moved_within_limits(target, q, window.limits)
    }
}

/// Returns the lowest of the values a whole turn apart within the limits, and their number. `q` is one of them.
fn turns_within(q: f64, limits: &JointLimits, joint: usize) -> (f64, u32) {
    let (lower, upper) = (limits.lower[joint], limits.upper[joint]);
    if !(lower.is_finite() && upper.is_finite()) {
        return (q, 1);
    }
    let fit = |room: f64| ((room + LIMIT_ROUNDING_RAD) / TAU).floor().max(0.0);
    let (below, above) = (fit(q - lower), fit(upper - q));
    ((q - TAU * below).max(lower), nearest_integer(below + above) as u32 + 1)
}

/// Greatest number of Gauss–Newton steps.
const STEPS: usize = 6;
/// Greatest correction of a joint \[rad\]: one that moves farther has left the branch, as it may near a singularity.
const FARTHEST_RAD: f64 = 0.05;
/// Damping: keeps the normal matrix definite where the free joints are singular.
const DAMPING: f64 = 1e-16;
/// Regularity times distance beyond the limit above which nothing within the limit near by meets the pose to [`CLOSED`]: moving
/// by δ costs a pose error of about the regularity times δ, unless both are so small that the curvature counts.
const HOPELESS: f64 = 50.0 * CLOSED;

impl AnalyticArm {
    /// Returns `q` within the limits, if it is so up to rounding or the free joints can make up for the rest. On a rounded arm all joints
    /// are corrected, as the closed form holds only nearly.
    #[inline]
    pub(crate) fn moved_within_limits(
        &self,
        target: &RigidTransform,
        q: JointVector,
        limits: &JointLimits,
    ) -> Option<JointVector> {
        if self.rounding.is_none() && limits.contain(&q) {
            return Some(q);
        }
        self.move_within_limits(target, q, limits)
    }

    #[cold]
    fn move_within_limits(&self, target: &RigidTransform, q: JointVector, limits: &JointLimits) -> Option<JointVector> {
        let mut here = limits.clamp(&q);
        let beyond = (here - q).amax();
        if self.rounding.is_none() {
            if beyond <= LIMIT_ROUNDING_RAD {
                return Some(here);
            }
            if self.regularity(&q) * beyond > HOPELESS {
                return None;
            }
        }
        for _ in 0..STEPS {
            let (error, mut jacobian) = self.error_and_jacobian(target, &here);
            let (linear, angular) = (error.fixed_rows::<3>(0).norm(), error.fixed_rows::<3>(3).norm());
            if linear <= CLOSED && angular <= CLOSED {
                return ((here - q).amax() <= FARTHEST_RAD).then_some(here);
            }
            // Joints that stand on a limit stay there.
            for joint in (0..AXES).filter(|&i| here[i] == limits.lower[i] || here[i] == limits.upper[i]) {
                jacobian.column_mut(joint).fill(0.0);
            }
            let normal = jacobian.tr_mul(&jacobian) + Matrix6::from_diagonal_element(DAMPING);
            here = limits.clamp(&(here + normal.cholesky()?.solve(&jacobian.tr_mul(&error))));
        }
        None
    }

    /// Returns |det J| up to a constant factor: `|sin ψ · X / (L₂ + L₃) · sin(q₅ + α₅)|`, zero at full stretch or fold, with the wrist
    /// centre beside axis 1, and with axes 4 and 6 parallel.
    fn regularity(&self, q: &JointVector) -> f64 {
        let [upper, fore] = self.lengths;
        let [sign_2, sign_3] = self.signs;
        let (s, c) = sin_cos(sign_2 * q[1]);
        let upper_arm = self.upper_at_zero * Complex::new(c, s);
        let (s, c) = sin_cos(self.bend_at_zero + sign_3 * q[2]);
        let out = self.shoulder_offset + (upper_arm * (Complex::new(c, s) * fore + upper)).im;
        let (wrist, _) = sin_cos(q[4] + self.wrist_at_zero[0]);
        (s * out / (upper + fore) * wrist).abs()
    }

    /// Returns `(p* − p, log(R* Rᵀ))` of body 6 and its geometric Jacobian, in base axes \[m, rad\].
    fn error_and_jacobian(&self, target: &RigidTransform, q: &JointVector) -> (Vector6<f64>, Matrix6<f64>) {
        let mut body = RigidTransform::identity();
        let bodies: [RigidTransform; AXES] = std::array::from_fn(|i| {
            let (s, c) = sin_cos(q[i]);
            body = body.then(&self.folded[i]).turned_about_z(s, c);
            body
        });
        let linear = target.translation - body.translation;
        let angular = rotation_vector(&(target.rotation * body.rotation.transpose()));
        let mut jacobian = Matrix6::zeros();
        for (i, joint) in bodies.iter().enumerate() {
            let z = joint.rotation.column(2).into_owned();
            let lever = z.cross(&(body.translation - joint.translation));
            jacobian.fixed_view_mut::<3, 1>(0, i).copy_from(&lever);
            jacobian.fixed_view_mut::<3, 1>(3, i).copy_from(&z);
        }
        let error = Vector6::new(linear.x, linear.y, linear.z, angular.x, angular.y, angular.z);
        (error, jacobian)
    }
}
