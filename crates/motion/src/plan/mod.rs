//! Plan file: a job and a motion that does it, sealed with a hash. A verifier needs only the file and the arm.
//!
//! `reading.rs` reads it strictly: unknown, missing and repeated keys are refused, and sizes are bounded before anything is read.

mod error;
mod knots;
mod process;
mod reading;

pub use error::{FORMAT, PlanFileError};
pub use knots::Knots;
pub use process::Process;

use crate::trajectory::PlanSegment;
use error::BEFORE;
use knots::NO_KNOTS;
use platewash_kinematics::sha256_hex;
use platewash_kinematics::words::is_hidden;
use platewash_workcell::job::JobTerms;
use platewash_workcell::json;
use platewash_workcell::wash_path::WashPath;
use platewash_workcell::words::without_mark;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Plan file, `"format": "platewash-plan/2"`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Format name, [`FORMAT`].
    pub format: String,
    /// SHA-256 over the canonical JSON (RFC 8785) of everything else, lower-case hexadecimal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hash: Option<String>,
    /// Kind of the plan.
    pub process: Process,
    /// Job of the plan.
    pub job: JobTerms,
    /// Origin of the plan: stated, never judged.
    pub provenance: Provenance,
    /// Plate indices in the order of washing.
    pub order: Vec<usize>,
    /// Wash path of each plate, in the order of washing; empty for the paper's program.
    pub wash_paths: Vec<WashPath>,
    /// Segments in time order.
    pub segments: Vec<PlanSegment>,
    /// Motion: cubic Hermite pieces between knots.
    pub knots: Knots,
}

/// Origin of a plan.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    /// Name of the scenario.
    pub scenario: String,
    /// Version of the program that made the plan.
    pub version: String,
}

impl Provenance {
    /// Returns the provenance of a scenario planned by this version.
    #[must_use]
    pub fn new(scenario: &str) -> Self {
        Self {
            scenario: scenario.to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
        }
    }
}

/// Contents of a plan besides its job.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanParts {
    /// Origin of the plan.
    pub provenance: Provenance,
    /// Plate indices in the order of washing.
    pub order: Vec<usize>,
    /// Wash path of each plate, in the order of washing.
    pub wash_paths: Vec<WashPath>,
    /// Segments in time order.
    pub segments: Vec<PlanSegment>,
    /// Knots of the motion.
    pub knots: Knots,
}

impl Plan {
    /// Seals the plan of a job.
    ///
    /// # Errors
    /// [`PlanFileError::Unwritable`].
    pub fn sealed(job: JobTerms, parts: PlanParts) -> Result<Self, PlanFileError> {
        let mut plan = Self {
            format: FORMAT.to_owned(),
            hash: None,
            process: Process::from(&job.planner),
            job,
            provenance: parts.provenance,
            order: parts.order,
            wash_paths: parts.wash_paths,
            segments: parts.segments,
            knots: parts.knots,
        };
        plan.hash = Some(plan.seal()?);
        Ok(plan)
    }

    /// Returns the plan with its job in the frame of the arm's base ([`JobTerms::seen_from_base`]), for computations. The hash stays that
    /// of the original plan.
    #[must_use]
    pub fn seen_from_base(&self) -> Cow<'_, Self> {
        match self.job.seen_from_base() {
            Cow::Borrowed(_) => Cow::Borrowed(self),
            Cow::Owned(job) => Cow::Owned(Self { job, ..self.clone() }),
        }
    }

    /// Returns the plan with the requirements that a proof of it judges ([`JobTerms::judged_requirements`]). The hash stays that of the
    /// original plan.
    #[must_use]
    pub fn judged(&self) -> Cow<'_, Self> {
        let requirements = self.job.judged_requirements();
        if requirements == self.job.requirements {
            return Cow::Borrowed(self);
        }
        let mut plan = self.clone();
        plan.job.requirements = requirements;
        Cow::Owned(plan)
    }

    /// Duration of the motion \[s\].
    #[must_use]
    pub fn duration_s(&self) -> f64 {
        self.knots.t_s.last().copied().unwrap_or(0.0)
    }

    /// The wash path of a plate.
    #[must_use]
    pub fn wash_path_of(&self, plate: usize) -> Option<&WashPath> {
        self.wash_paths.iter().find(|path| path.plate == plate)
    }

    /// Computes the hash of the contents.
    ///
    /// # Errors
    /// [`PlanFileError::Unwritable`] for contents that cannot be read back, such as a number that is not finite.
    pub fn seal(&self) -> Result<String, PlanFileError> {
        let open = Self {
            hash: None,
            ..self.without_knots()
        };
        let text = serde_json_canonicalizer::to_string(&open).map_err(unwritable)?;
        self.check_readable(&open, &text)?;
        Ok(sha256_hex(self.with_knots(&text).as_bytes()))
    }

    /// Canonical JSON of a plan, with these knots in place of none. Almost all of a plan's text is numbers of the knots, which the general
    /// writer takes long for.
    fn with_knots(&self, text: &str) -> String {
        text.replacen(NO_KNOTS, &knots::canonical(&self.knots), 1)
    }

    /// The plan without its knots.
    fn without_knots(&self) -> Self {
        Self {
            format: self.format.clone(),
            hash: self.hash.clone(),
            process: self.process,
            job: self.job.clone(),
            provenance: self.provenance.clone(),
            order: self.order.clone(),
            wash_paths: self.wash_paths.clone(),
            segments: self.segments.clone(),
            knots: Knots::default(),
        }
    }

    /// Refuses contents that would change when read back; `text` is that of the plan `around` the knots.
    fn check_readable(&self, around: &Self, text: &str) -> Result<(), PlanFileError> {
        let refuse = |detail: &str| {
            let detail = detail.to_owned();
            Err(PlanFileError::Unwritable { detail })
        };
        // Almost all numbers are here, and all of one kind.
        let Knots { t_s, q_rad, qd_rad_s } = &self.knots;
        let mut numbers = t_s.iter().chain(q_rad.iter().chain(qd_rad_s).flatten());
        if !numbers.all(|number| number.is_finite()) {
            return refuse("a number of the knots is not finite");
        }
        // A number that is not finite is written as `null`, and a whole number of more than 53 bits as its neighbour.
        if serde_json::from_str::<Self>(text).map_err(unwritable)? != *around {
            return refuse("a whole number is above 2^53 − 1, the largest that JSON says exactly");
        }
        Ok(())
    }

    /// True if the stored hash is that of the contents.
    #[must_use]
    pub fn is_sealed(&self) -> bool {
        self.hash.is_some() && self.hash == self.seal().ok()
    }

    /// Returns the file's text: canonical JSON, one line.
    ///
    /// # Errors
    /// [`PlanFileError::Unwritable`].
    pub fn to_json(&self) -> Result<String, PlanFileError> {
        let text = serde_json_canonicalizer::to_string(&self.without_knots()).map_err(unwritable)?;
        Ok(self.with_knots(&text))
    }

    /// Reads the text of a plan file. Every key occurs once, none is unknown and none is missing, so that the plan read has the hash of the
    /// file's contents. The hash is not checked here: see [`Plan::is_sealed`].
    ///
    /// # Errors
    /// [`PlanFileError`] for anything but a plan of this format.
    pub fn from_json(text: &str) -> Result<Self, PlanFileError> {
        let text = without_mark(text);
        reading::check_sizes(text)?;
        let plan: Self = json::read(text).map_err(|error| other_format(text).unwrap_or_else(|| error.into()))?;
        if plan.format != FORMAT {
            return Err(refused(plan.format));
        }
        let planned = Process::from(&plan.job.planner);
        if plan.process != planned {
            let stated = plan.process;
            return Err(PlanFileError::Process { stated, planned });
        }
        reading::check_contents(text, &plan.to_json()?, &plan)?;
        plan.check_names()?;
        Ok(plan)
    }

    /// Refuses names with control or direction characters.
    fn check_names(&self) -> Result<(), PlanFileError> {
        let world = &self.job.workcell;
        let bodies = world
            .tool
            .bodies
            .iter()
            .map(|body| ("job.workcell.tool.bodies", &body.name));
        let obstacles = world
            .obstacles
            .iter()
            .map(|obstacle| ("job.workcell.obstacles", &obstacle.name));
        let mount = world
            .tool
            .mounted_on
            .iter()
            .map(|link| ("job.workcell.tool.mounted_on", link));
        let alone = [
            ("provenance.scenario", &self.provenance.scenario),
            ("job.workcell.arm.name", &world.arm.name),
        ];
        let fixed = world.arm.fixed.keys().map(|joint| ("job.workcell.arm.fixed", joint));
        let mut all = alone
            .into_iter()
            .chain(fixed)
            .chain(mount)
            .chain(bodies)
            .chain(obstacles);
        match all.find(|(_, name)| name.contains(is_hidden)) {
            None => Ok(()),
            Some((key, name)) => Err(PlanFileError::HiddenCharacter {
                key: key.to_owned(),
                found: name.clone(),
            }),
        }
    }
}

/// Key that identifies the format.
#[derive(Deserialize)]
struct Head {
    format: Option<String>,
}

/// Returns an error if a text that is no plan states another format.
fn other_format(text: &str) -> Option<PlanFileError> {
    let format = serde_json::from_str::<Head>(text).ok()?.format?;
    (format != FORMAT).then(|| refused(format))
}

/// Returns the error for a plan of another format.
fn refused(format: String) -> PlanFileError {
    if format == BEFORE {
        return PlanFileError::Before;
    }
    PlanFileError::Format { found: format }
}

fn unwritable(e: serde_json::Error) -> PlanFileError {
    PlanFileError::Unwritable { detail: e.to_string() }
}
