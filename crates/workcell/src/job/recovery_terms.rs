//! Jobs of a recovery, out of the job of the stopped plan.

use crate::job::recovery::{RETREAT_M_S, Recovery};
use crate::job::requirements::Requirements;
use crate::job::terms::JobTerms;
use crate::workcell::{ReducedClearance, is_pair};
use platewash_kinematics::JointVector;

impl JobTerms {
    /// Greatest speed of the sponge where it leaves a plate after a stop of this job \[m/s\].
    #[must_use]
    pub fn retreat_speed_m_s(&self) -> f64 {
        let asked = self.requirements.lifting_m_s;
        asked.map_or(RETREAT_M_S, |asked| asked.min(RETREAT_M_S))
    }

    /// Returns the job of a recovery, out of this job of the stopped plan.
    ///
    /// For a motion home, `at` is where the arm stands \[rad\], and `near` has the clearances of the pairs that are too near there. The rest
    /// takes neither.
    #[must_use]
    pub fn recovered(&self, recovery: Recovery, at: JointVector, near: Vec<ReducedClearance>) -> Self {
        let mut terms = Self {
            recovery: Some(recovery),
            ..self.clone()
        };
        if !terms.is_motion_home() {
            return terms;
        }
        terms.home_rad = [at, self.home_rad[0]];
        terms.requirements = Requirements {
            contact: None,
            holder: None,
            landing_m_s: None,
            lifting_m_s: Some(self.retreat_speed_m_s()),
            wrist_rad: None,
            ..self.requirements
        };
        let pairs = &mut terms.workcell.reduced_clearances;
        pairs
            .retain(|ReducedClearance { pair: [a, b], .. }| !near.iter().any(|at_stop| is_pair(&at_stop.pair, (a, b))));
        pairs.extend(near);
        terms
    }
}
