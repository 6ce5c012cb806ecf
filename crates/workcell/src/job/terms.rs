//! The terms of a job: everything about it but the arm itself.
//!
//! The frame of a job can be changed to that of the arm's base.

use crate::dry_run::DryRun;
use crate::job::kind::{PlanKind, Statement, StatementRule};
use crate::job::measured_shape::MeasuredShape;
use crate::job::planner_settings::{Planner, PlannerSettings};
use crate::job::recovery::Recovery;
use crate::job::requirements::{Limits, Requirements, Treatment};
use crate::job::soil::Soil;
use crate::plate::Plate;
use crate::simulation::SimulationSettings;
use crate::workcell::Workcell;
use platewash_kinematics::JointVector;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Largest seed. Up to here every whole number is a distinct JSON number (RFC 8785 writes them all as doubles), so that no two seeds have
/// the same text in a plan file.
pub const MAX_SEED: u64 = (1 << 53) - 1;

/// The terms of a job: everything about it but the arm itself, as a plan file states it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JobTerms {
    /// Workcell: arm, mount, tool and obstacles.
    pub workcell: Workcell,
    /// Plates, by index.
    pub plates: Vec<Plate>,
    /// Requirements of the washing.
    pub requirements: Requirements,
    /// Limits of joints and tip, in addition to those of the arm's description.
    pub limits: Limits,
    /// Joint positions at the start and at the end \[rad\].
    pub home_rad: [JointVector; 2],
    /// Planner and its settings: hashed, not judged.
    pub planner: Planner,
    /// Seed of every random stream.
    pub seed: u64,
    /// Settings of the simulation: hashed, not judged.
    pub simulation: SimulationSettings,
    /// Parent plan and height of a dry run; left out of files if the job is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dry_run: Option<DryRun>,
    /// Parent plan and plates left out after a stop; left out of files if the job is no recovery.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub recovery: Option<Recovery>,
    /// Kinds of soil on the plates.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub soils: Vec<Soil>,
    /// Measured shapes of plates, for pictures and reports: hashed, not judged.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub measured: Vec<MeasuredShape>,
}

impl JobTerms {
    /// Returns the treatment of the plates by the job.
    #[must_use]
    pub fn treatment(&self) -> Treatment {
        match (&self.dry_run, &self.requirements.contact) {
            _ if self.is_motion_home() => Treatment::SweptInAir,
            (Some(_), _) => Treatment::SweptInAir,
            (None, Some(_)) => Treatment::Washed,
            (None, None) => Treatment::Swept,
        }
    }

    /// Returns true where the job washes a plate. All plates are washed, but those that a recovery leaves out.
    #[must_use]
    pub fn washes(&self, plate: usize) -> bool {
        let left_out = |recovery: &Recovery| recovery.left_out.contains(&plate);
        !self.recovery.as_ref().is_some_and(left_out)
    }

    /// Returns true for the motion from a stop to home, which washes nothing.
    #[must_use]
    pub fn is_motion_home(&self) -> bool {
        self.recovery.as_ref().is_some_and(Recovery::is_motion_home)
    }

    /// Notices of a dry run and of a recovery, which stand before every verdict and caption; each ends with "; ". Empty for other jobs.
    #[must_use]
    pub fn notices(&self) -> String {
        let dry_run = self.dry_run.iter().map(DryRun::words);
        let all = dry_run.chain(self.recovery.iter().map(Recovery::words));
        all.map(|words| words + "; ").collect()
    }

    /// Returns the kind of the job's plan.
    #[must_use]
    pub fn kind(&self) -> PlanKind {
        PlanKind::stated(self.dry_run.as_ref(), self.recovery.as_ref())
    }

    /// Returns the requirements that a proof of the job judges: those of the job, without what only the planner follows.
    #[must_use]
    pub fn judged_requirements(&self) -> Requirements {
        let kind = self.kind();
        let is_judged = |statement| kind.rule(statement) != StatementRule::Planned;
        let wanted = &self.requirements;
        Requirements {
            contact: wanted.contact.filter(|_| is_judged(Statement::Contact)),
            holder: wanted.holder.filter(|_| is_judged(Statement::Holder)),
            ..*wanted
        }
    }

    /// Indices of the plates that are washed, ascending.
    pub fn plates_to_wash(&self) -> impl Iterator<Item = usize> {
        (0..self.plates.len()).filter(|plate| self.washes(*plate))
    }

    /// Returns the settings of the planner; `None` for a run of the paper's program.
    #[must_use]
    pub fn planner_settings(&self) -> Option<&PlannerSettings> {
        match &self.planner {
            Planner::Wash(settings) => Some(settings),
            Planner::Paper(_) => None,
        }
    }

    /// Largest angle of the tool from a plate's normal \[rad\]: the required one, or that of the sponge if it is smaller.
    #[must_use]
    pub fn tilt_max_rad(&self) -> f64 {
        let sponge = self.workcell.tool.sponge.greatest_tilt_rad();
        self.requirements.tilt_rad.min(sponge)
    }

    /// Largest speed of the tip while it washes \[m/s\], never above that for the whole motion.
    #[must_use]
    pub fn wash_speed_m_s(&self) -> f64 {
        self.requirements.wash_speed_m_s.min(self.limits.tip_speed_m_s)
    }

    /// Largest acceleration of the tip while it washes \[m/s²\], never above that for the whole motion.
    #[must_use]
    pub fn wash_acceleration_m_s2(&self) -> f64 {
        let anywhere = self.limits.tip_acceleration_m_s2;
        self.requirements.wash_acceleration_m_s2.min(anywhere)
    }

    /// Returns the terms in the frame of the arm's base: the arm is mounted at the origin, and obstacles and plates are moved accordingly.
    /// Terms whose world frame is that of the base are returned unchanged.
    ///
    /// Joint positions, requirements and limits do not change: a plan, proof or simulation for one is valid for the other.
    #[must_use]
    pub fn seen_from_base(&self) -> Cow<'_, Self> {
        if self.workcell.is_in_base_frame() {
            return Cow::Borrowed(self);
        }
        let to_base = self.workcell.mount.inverse();
        Cow::Owned(Self {
            workcell: self.workcell.seen_from_base().into_owned(),
            plates: self.plates.iter().map(|plate| plate.seen_from(&to_base)).collect(),
            ..self.clone()
        })
    }
}
