//! Search for the answer nearest to a start.

use crate::ik::analytic::branch::{Degeneracies, Label};
use crate::ik::analytic::closed_form::ClosedForm;
use crate::ik::analytic::window::{NearestConfiguration, Window};
use crate::joints::JointVector;
use crate::rotation::RigidTransform;

/// The search for the nearest answer.
pub(crate) struct Search<'a, F> {
    form: &'a F,
    target: &'a RigidTransform,
    pub window: &'a Window<'a>,
    pub best: Option<NearestConfiguration>,
    /// Squared distance of the best answer \[rad²\].
    pub least: f64,
}

impl<'a, F: ClosedForm> Search<'a, F> {
    #[inline]
    pub fn new(form: &'a F, target: &'a RigidTransform, window: &'a Window<'a>) -> Self {
        Self {
            form,
            target,
            window,
            best: None,
            least: f64::INFINITY,
        }
    }

    /// Takes the configuration if it is nearer than the best. One beyond a limit must be movable onto it.
    #[inline]
    pub fn offer(&mut self, q: JointVector, label: Label, degenerate: Degeneracies) -> Option<()> {
        if self.window.squared_distance(q.as_slice()) >= self.least {
            return None;
        }
        let q = self.form.moved_within_limits(self.target, q, self.window.limits)?;
        self.least = self.window.squared_distance(q.as_slice());
        self.best = Some(NearestConfiguration {
            q,
            label,
            degenerate,
            distance_rad: self.least.sqrt(),
        });
        Some(())
    }
}
