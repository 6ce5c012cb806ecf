//! A job with its arm.

use crate::job::error::{End, JobError};
use crate::job::standing::check_standing;
use platewash_kinematics::RobotModel;
use platewash_workcell::ArmId;
use platewash_workcell::job::{JobTerms, TermsError};
use platewash_workcell::plate::Plate;
use std::borrow::Cow;
use std::sync::Arc;

/// A job with its arm.
#[derive(Debug, Clone)]
pub struct WashJob {
    name: String,
    arm: Arc<RobotModel>,
    terms: JobTerms,
    /// Terms in the frame of the arm's base, if that is not the world frame.
    from_base: Option<Box<JobTerms>>,
}

impl WashJob {
    /// Joins the terms with the arm that they are for.
    ///
    /// # Errors
    /// [`JobError`]: terms that cannot be computed with, another arm, an end configuration beyond its limits, or obstacles that reach into
    /// plates or the arm's base.
    pub fn new(arm: Arc<RobotModel>, terms: JobTerms) -> Result<Self, JobError> {
        terms.validate()?;
        let given = ArmId::new(&arm);
        if terms.workcell.arm != given {
            let job = Box::new(terms.workcell.arm.clone());
            let given = Box::new(given);
            return Err(JobError::OtherArm { job, given });
        }
        for (end, q) in [End::Start, End::End].into_iter().zip(&terms.home_rad) {
            if let Some(violation) = arm.limits().violation(q) {
                return Err(JobError::Home { end, violation });
            }
        }
        let described = arm.limits().acceleration;
        for (joint, (limit, found)) in described.iter().zip(terms.limits.joint_acceleration_rad_s2).enumerate() {
            if let Some(limit) = limit.filter(|limit| found > *limit) {
                let name = "limits.joint_acceleration_rad_s2";
                let joint = &arm.joints()[joint].name;
                let expected = format!("at most {limit} rad/s² for {joint}, as the arm's description states");
                return Err(TermsError::Number { name, expected, found }.into());
            }
        }
        check_standing(&terms, &arm)?;
        let from_base = match terms.seen_from_base() {
            Cow::Borrowed(_) => None,
            Cow::Owned(seen) => Some(Box::new(seen)),
        };
        Ok(Self {
            name: "unnamed".to_owned(),
            arm,
            terms,
            from_base,
        })
    }

    /// Returns the job under the name of a scenario, for reports and the plan's provenance.
    #[must_use]
    pub fn named(self, name: &str) -> Self {
        let name = name.to_owned();
        Self { name, ..self }
    }

    /// Name of the job.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The arm.
    #[must_use]
    pub fn arm(&self) -> &RobotModel {
        &self.arm
    }

    /// The arm, shared.
    #[must_use]
    pub fn shared_arm(&self) -> Arc<RobotModel> {
        self.arm.clone()
    }

    /// Terms of the job.
    #[must_use]
    pub fn terms(&self) -> &JobTerms {
        &self.terms
    }

    /// Terms in the frame of the arm's base ([`JobTerms::seen_from_base`]), for computations.
    #[must_use]
    pub fn seen_from_base(&self) -> &JobTerms {
        self.from_base.as_deref().unwrap_or(&self.terms)
    }

    /// Returns the same job with other plates.
    ///
    /// # Errors
    /// [`JobError`] for invalid plates.
    pub fn on_plates(&self, plates: Vec<Plate>) -> Result<Self, JobError> {
        let terms = JobTerms {
            plates,
            ..self.terms.clone()
        };
        Ok(Self::new(self.arm.clone(), terms)?.named(&self.name))
    }
}
