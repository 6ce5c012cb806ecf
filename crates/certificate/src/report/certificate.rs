//! The certificate of a plan.
//!
//! Positions in a certificate are in the world frame; the proof uses the frame of the arm's base.

use crate::clearance::pairs::PairBound;
use crate::report::check::{Check, Status};
use crate::report::requirement::Requirement;
use crate::report::verdict_basis::VerdictBasis;
use crate::washing::plate_contact::PlateContact;
use crate::washing::plate_coverage::PlateCoverage;
use nalgebra::Point3;
use platewash_bodies::coverage::reaches;
use platewash_kinematics::Pose;
use platewash_motion::plan::Plan;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// Format name in a certificate's JSON. It changes with the keys.
pub const CERTIFICATE_FORMAT: &str = "platewash-certificate/2";

/// Verdict on the whole plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Every requirement is kept, and the plan is unchanged since it was sealed. [`Certificate::waived`] names the requirements that are
    /// not proved, only waived by the job.
    Pass,
    /// A requirement is violated or not proved, or the hash does not match the contents.
    Fail,
}

/// Check of a plan's hash. It proves nothing about the motion: anybody who changes a plan can seal it again.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct HashFinding {
    /// The hash in the file.
    pub stated: Option<String>,
    /// The hash of the contents; `None` for contents that JSON cannot represent.
    pub computed: Option<String>,
    /// Proved if both are the same, else violated.
    pub status: Status,
}

impl HashFinding {
    /// Checks the hash of a plan.
    #[must_use]
    pub fn check(plan: &Plan) -> Self {
        let computed = plan.seal().ok();
        let is_same = computed.is_some() && plan.hash == computed;
        Self {
            stated: plan.hash.clone(),
            computed,
            status: if is_same { Status::Proved } else { Status::Violated },
        }
    }

    /// Returns the finding as a line of text.
    #[must_use]
    pub fn words(&self) -> &'static str {
        match (self.status, &self.stated) {
            (Status::Proved, _) => "the hash matches the contents",
            (_, Some(_)) => "the hash does NOT match the contents: the plan was changed after it was written",
            (_, None) => "the hash is missing",
        }
    }
}

/// Certificate of a plan: the verdict with everything that was proved.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Certificate {
    /// Format name, [`CERTIFICATE_FORMAT`].
    pub format: String,
    /// Pass, or fail.
    pub verdict: Verdict,
    /// The first line in words: the verdict, the numbers reached and required, the waived and the broken requirements.
    pub headline: String,
    /// True if a dry run was compared with its parent plan, and agrees.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub parent_compared: bool,
    /// Requirements that are not kept and that the job waives: [`Status::Waived`].
    pub waived: Vec<Requirement>,
    /// Name of the scenario, as the plan states it.
    pub scenario: String,
    /// Duration of the motion \[s\].
    pub duration_s: f64,
    /// Check of the hash.
    pub hash: HashFinding,
    /// Checks, one for each requirement.
    pub checks: Vec<Check>,
    /// Swept share of each plate, in the order of washing.
    pub swept: Vec<PlateCoverage>,
    /// Contact with each plate, in the order of washing, where the job has contact requirements.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub contact: Vec<PlateContact>,
    /// Clearance of each pair under each rule.
    pub clearance: Vec<PairBound>,
    /// Basis of the verdict.
    pub rests_on: VerdictBasis,
}

impl Certificate {
    /// Returns the check of a requirement, if it was made.
    #[must_use]
    pub fn check(&self, requirement: Requirement) -> Option<&Check> {
        self.checks.iter().find(|check| check.requirement == requirement)
    }

    /// Returns the proved bound of a requirement, in its unit; `None` where nothing finite is proved.
    #[must_use]
    pub fn bound(&self, requirement: Requirement) -> Option<f64> {
        self.check(requirement)?
            .measure?
            .bound
            .filter(|bound| bound.is_finite())
    }

    /// Returns the checks that are violated or not proved.
    pub fn broken(&self) -> impl Iterator<Item = &Check> {
        self.checks.iter().filter(|check| !check.status.is_kept())
    }

    /// True if every requirement is kept, and the hash is that of the contents.
    #[must_use]
    pub fn passes(&self) -> bool {
        self.verdict == Verdict::Pass
    }

    /// Number of plates that are proved to be washed: swept to the required share with the sponge on them and, where contact is required,
    /// pressed on the required share, for the required time and with the required dose. It is 0 for a dry run.
    #[must_use]
    pub fn plates_washed(&self) -> usize {
        if self.rests_on.dry_run.is_some() {
            return 0;
        }
        let on = self.check(Requirement::ContactHeight);
        if !on.is_some_and(|check| check.status == Status::Proved) {
            return 0;
        }
        let wanted = &self.rests_on.requirements;
        let pressed = |plate| {
            let mut all = self.contact.iter().filter(|contact| contact.plate == plate);
            wanted.contact.is_none() || all.any(PlateContact::is_enough)
        };
        let enough = self
            .swept
            .iter()
            .filter(|swept| reaches(swept.at_least, wanted.coverage));
        let washed = enough.map(|swept| swept.plate).filter(|plate| pressed(*plate));
        washed.collect::<BTreeSet<_>>().len()
    }
}

/// Mount of the arm in the world; `None` where the world frame is that of the base.
#[derive(Debug, Clone, Copy)]
pub(crate) struct World(Option<Pose>);

impl World {
    /// Returns the world in which an arm is mounted at `T_world_base`.
    pub fn from_mount(mount: &Pose) -> Self {
        Self((*mount != Pose::identity()).then_some(*mount))
    }

    /// Transforms the positions of checks, pairs and contact results to the world frame.
    pub fn move_to_world(&self, checks: &mut [Check], pairs: &mut [PairBound], plates: &mut [PlateContact]) {
        let Some(mount) = &self.0 else { return };
        let of_checks = checks.iter_mut().filter_map(|check| check.worst.place_m.as_mut());
        let of_pairs = pairs.iter_mut().filter_map(|pair| pair.place_m.as_mut());
        let of_plates = plates.iter_mut().flat_map(PlateContact::places_mut);
        for place in of_checks.chain(of_pairs).chain(of_plates) {
            *place = (mount * Point3::from(*place)).into();
        }
    }
}
