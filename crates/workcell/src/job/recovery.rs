//! Recovery from a stop: the motion from where the arm stands back home, and the washing of the plates that are left.
//!
//! Both are jobs of their own. The plates of the stopped plan keep their places and their numbers; those that the job leaves out stand there
//! and are not washed.

use crate::words::plate_name;
use platewash_kinematics::words::nonzero_decimals;
use serde::{Deserialize, Serialize};

/// Greatest speed of the sponge where it leaves a plate after a stop \[m/s\].
pub const RETREAT_M_S: f64 = 0.02;

/// Distance by which a pair that is near at the stop may come nearer on the way home \[m\].
pub const NEARER_M: f64 = 1e-4;

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
}
