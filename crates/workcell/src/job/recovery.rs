//! Recovery from a stop: the motion from where the arm stands back home, and the washing of the plates that are left.
//!
//! Both are jobs of their own. The plates of the stopped plan keep their places and their numbers; those that the job leaves out stand there
//! and are not washed.

use crate::dry_run::is_hash;
use crate::job::error::TermsError;
use crate::job::requirements::{Planner, Requirements};
use crate::job::terms::{JobTerms, within};
use crate::plate::GREATEST_M;
use crate::words::plate_name;
use crate::workcell::{ReducedClearance, is_pair};
use platewash_kinematics::JointVector;
use platewash_kinematics::words::nonzero_decimals;
use serde::{Deserialize, Serialize};

/// Greatest speed of the sponge where it leaves a plate after a stop \[m/s\].
pub const RETREAT_M_S: f64 = 0.02;

/// Distance by which a pair that is near at the stop may come nearer on the way home \[m\].
pub const NEARER_M: f64 = 1e-4;

/// Least length of a retreat \[m\].
const LEAST_RETREAT_M: f64 = 1e-4;

/// Greatest speed of the sponge where it leaves a plate after a stop of a job \[m/s\].
#[must_use]
pub fn retreat_speed_m_s(stopped: &JobTerms) -> f64 {
    let asked = stopped.requirements.lifting_m_s;
    asked.map_or(RETREAT_M_S, |asked| asked.min(RETREAT_M_S))
}

/// Statement that a job goes on after a stop of another plan.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Recovery {
    /// Hash of the plan that was stopped. It is stated; comparing takes that plan.
    pub parent: String,
    /// Plates that are not washed, by index, ascending.
    pub left_out: Vec<usize>,
    /// Part of the recovery that the job is.
    pub part: RecoveryPart,
}

/// Part of a recovery.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum RecoveryPart {
    /// The motion from where the arm stands to home. No plate is washed.
    Home {
        /// Line along which the sponge leaves the plate that it is at; `None` where it is clear of all.
        retreat: Option<RetreatLine>,
    },
    /// Washing of the plates that are left, from home to home.
    Rest,
}

/// Line along the normal of a plate, from the tip on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RetreatLine {
    /// Index of the plate.
    pub plate: usize,
    /// Length \[m\].
    pub length_m: f64,
}

impl Recovery {
    /// Returns true for the motion home.
    #[must_use]
    pub fn is_motion_home(&self) -> bool {
        matches!(self.part, RecoveryPart::Home { .. })
    }

    /// Line along which the sponge leaves a plate, if there is one.
    #[must_use]
    pub fn retreat(&self) -> Option<RetreatLine> {
        match self.part {
            RecoveryPart::Home { retreat } => retreat,
            RecoveryPart::Rest => None,
        }
    }

    /// Returns the job of the recovery, out of that of the stopped plan.
    ///
    /// For a motion home, `at` is where the arm stands \[rad\], and `near` has the clearances of the pairs that are too near there. The rest
    /// takes neither.
    #[must_use]
    pub fn terms(self, stopped: &JobTerms, at: JointVector, near: Vec<ReducedClearance>) -> JobTerms {
        let mut terms = JobTerms {
            recovery: Some(self),
            ..stopped.clone()
        };
        if !terms.is_motion_home() {
            return terms;
        }
        terms.home_rad = [at, stopped.home_rad[0]];
        terms.requirements = Requirements {
            contact: None,
            holder: None,
            landing_m_s: None,
            lifting_m_s: Some(retreat_speed_m_s(stopped)),
            wrist_rad: None,
            ..stopped.requirements
        };
        let pairs = &mut terms.workcell.reduced_clearances;
        pairs
            .retain(|ReducedClearance { pair: [a, b], .. }| !near.iter().any(|at_stop| is_pair(&at_stop.pair, (a, b))));
        pairs.extend(near);
        terms
    }

    /// Returns the notice that stands before the verdict in reports.
    #[must_use]
    pub fn words(&self) -> String {
        match self.part {
            RecoveryPart::Home { retreat: None } => "RECOVERY: from the stop home, nothing is washed".to_owned(),
            RecoveryPart::Home {
                retreat: Some(RetreatLine { plate, length_m }),
            } => format!(
                "RECOVERY: from the stop home, nothing is washed; the sponge may touch {} until it is {} mm up",
                plate_name(plate),
                nonzero_decimals(1e3 * length_m, 1)
            ),
            RecoveryPart::Rest => {
                let names: Vec<_> = self.left_out.iter().map(|plate| plate_name(*plate)).collect();
                format!("REST of a stopped plan, without {}", names.join(", "))
            }
        }
    }

    /// Checks that the statement fits the job.
    pub(crate) fn validate(&self, job: &JobTerms) -> Result<(), TermsError> {
        let refused = |fault| Err(TermsError::Recovery { fault });
        let count = job.plates.len();
        if !is_hash(&self.parent) {
            return refused("parent must be the hash of a plan, 64 digits of lower-case hexadecimal");
        }
        if matches!(job.planner, Planner::Paper(_)) {
            return refused("a run of the paper's program cannot be one");
        }
        let ascends = self.left_out.windows(2).all(|pair| pair[0] < pair[1]);
        if !ascends || self.left_out.last().is_some_and(|last| *last >= count) {
            return refused("left_out must list indices of plates, ascending");
        }
        match self.part {
            RecoveryPart::Rest if self.left_out.is_empty() || self.left_out.len() == count => {
                refused("the rest leaves out some plates and not all")
            }
            RecoveryPart::Home { .. } if self.left_out.len() != count => {
                refused("the motion home leaves out all plates")
            }
            RecoveryPart::Home { retreat: Some(line) } if line.plate >= count => {
                refused("retreat.plate must be the index of a plate")
            }
            RecoveryPart::Home { retreat: Some(line) } => within(
                "recovery.part.home.retreat.length_m",
                line.length_m,
                [LEAST_RETREAT_M, GREATEST_M],
            ),
            _ => Ok(()),
        }
    }
}
