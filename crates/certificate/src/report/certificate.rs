//! What is proved about a plan.
//!
//! Places that are told in the world: what is proved is proved in the frame of the arm's base.

use crate::clearance::pairs::PairBound;
use crate::report::check::{Check, Status};
use crate::report::requirement::Requirement;
use crate::report::rests_on::RestsOn;
use crate::washing::contact::PlateContact;
use crate::washing::coverage::PlateCoverage;
use nalgebra::Point3;
use platewash_kinematics::Pose;
use platewash_workcell::coverage::reaches;
use platewash_workcell::plan::Plan;
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// What a certificate's JSON states as its format. Its keys change with it.
pub const CERTIFICATE_FORMAT: &str = "platewash-certificate/2";

/// What came of the whole plan.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Every requirement is kept, and the plan is as it was written. [`Certificate::waived`] names those that are not proved, only
    /// waived by the job.
    Pass,
    /// A requirement is violated or not proved, or the hash does not match the contents.
    Fail,
}

/// What the hash says. It tells nothing about the motion: whoever changes a plan can seal it again.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct HashFinding {
    /// The hash in the file.
    pub stated: Option<String>,
    /// The hash that belongs to the contents; none for contents that JSON cannot say.
    pub computed: Option<String>,
    /// Whether they are the same: proved or violated.
    pub status: Status,
}

impl HashFinding {
    /// That of a plan.
    #[must_use]
    pub fn of(plan: &Plan) -> Self {
        let computed = plan.seal().ok();
        let is_same = computed.is_some() && plan.hash == computed;
        Self {
            stated: plan.hash.clone(),
            computed,
            status: if is_same { Status::Proved } else { Status::Violated },
        }
    }

    /// The finding in a line.
    #[must_use]
    pub fn words(&self) -> &'static str {
        match (self.status, &self.stated) {
            (Status::Proved, _) => "the hash matches the contents",
            (_, Some(_)) => "the hash does NOT match the contents: the plan was changed after it was written",
            (_, None) => "the hash is missing",
        }
    }
}

/// What is proved about a plan.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Certificate {
    /// [`CERTIFICATE_FORMAT`].
    pub format: String,
    /// Pass, or fail.
    pub verdict: Verdict,
    /// The first line in words: the verdict, the numbers reached and required, what is waived, and what is not kept.
    pub headline: String,
    /// That a dry run was compared with the plan that it tries out, and agrees.
    #[serde(default, skip_serializing_if = "is_false")]
    pub parent_compared: bool,
    /// The requirements that are not kept and that the job waives: [`Status::Waived`].
    pub waived: Vec<Requirement>,
    /// Name of the scenario, as the plan states it.
    pub scenario: String,
    /// Duration of the motion \[s\].
    pub duration_s: f64,
    /// The hash.
    pub hash: HashFinding,
    /// The requirements, one by one.
    pub checks: Vec<Check>,
    /// What is swept, plate by plate in the order of washing.
    pub swept: Vec<PlateCoverage>,
    /// Contact, plate by plate in the order of washing, where the job asks for it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub contact: Vec<PlateContact>,
    /// Clearance, pair by pair and rule by rule.
    pub clearance: Vec<PairBound>,
    /// What the verdict rests on.
    pub rests_on: RestsOn,
}

#[allow(clippy::trivially_copy_pass_by_ref)] // as serde asks for it
fn is_false(flag: &bool) -> bool {
    !flag
}

impl Certificate {
    /// What came of a requirement.
    #[must_use]
    pub fn check(&self, requirement: Requirement) -> Option<&Check> {
        self.checks.iter().find(|check| check.requirement == requirement)
    }

    /// What is guaranteed of a requirement, in its unit; `None` where nothing finite is.
    #[must_use]
    pub fn bound(&self, requirement: Requirement) -> Option<f64> {
        self.check(requirement)?
            .measure?
            .bound
            .filter(|bound| bound.is_finite())
    }

    /// The requirements that are violated or not proved.
    pub fn broken(&self) -> impl Iterator<Item = &Check> {
        self.checks.iter().filter(|check| !check.status.is_kept())
    }

    /// Whether every requirement is kept, and the hash is that of the contents.
    #[must_use]
    pub fn passes(&self) -> bool {
        self.verdict == Verdict::Pass
    }

    /// Number of plates that are proved to be washed: swept to the share required with the sponge on them and, where contact is required,
    /// pressed on the share, for the time and with the dose required. A dry run washes none.
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

/// The world, by the arm's mount in it; `None` where it is the base's own frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct World(Option<Pose>);

impl World {
    /// The world in which an arm is mounted at `T_world_base`.
    pub fn of(mount: &Pose) -> Self {
        Self((*mount != Pose::identity()).then_some(*mount))
    }

    /// The worst places of checks.
    pub fn tell_checks(&self, checks: &mut [Check]) {
        for check in checks {
            self.tell(check.worst.place_m.as_mut());
        }
    }

    /// Where pairs come nearest.
    pub fn tell_pairs(&self, pairs: &mut [PairBound]) {
        for pair in pairs {
            self.tell(pair.place_m.as_mut());
        }
    }

    /// Where plates are pressed most and least.
    pub fn tell_contact(&self, plates: &mut [PlateContact]) {
        for plate in plates {
            for place in plate.places_mut() {
                self.tell(Some(place));
            }
        }
    }

    /// Takes a place from the base frame to the world \[m\].
    fn tell(&self, place: Option<&mut [f64; 3]>) {
        if let (Some(mount), Some(place)) = (&self.0, place) {
            *place = (mount * Point3::from(*place)).into();
        }
    }
}
