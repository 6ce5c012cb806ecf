//! The plan file: a job, and a motion that does it, sealed with a hash. It is all that a verifier needs besides the arm.
//!
//! Formats and kinds of plan files.
//!
//! Why a plan file could not be written or read.

pub(crate) mod reading;

use crate::job::{JobTerms, Planner};
use crate::json::{self, JsonError};
use crate::trajectory::{KnotError, PlanSegment, Trajectory};
use crate::wash_path::WashPath;
use crate::words::{printable, quoted, without_mark};
use platewash_kinematics::words::is_hidden;
use platewash_kinematics::{JointVector, sha256_hex};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fmt;

/// A plan file, `"format": "platewash-plan/2"`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// [`FORMAT`].
    pub format: String,
    /// SHA-256 over the canonical JSON (RFC 8785) of everything else, lower-case hexadecimal.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hash: Option<String>,
    /// What kind of plan it is.
    pub process: Process,
    /// What is asked.
    pub job: JobTerms,
    /// Where it comes from: stated, never judged.
    pub provenance: Provenance,
    /// Plate indices in the order of washing.
    pub order: Vec<usize>,
    /// How each plate is washed, in the order of washing; none for the paper's program.
    pub wash_paths: Vec<WashPath>,
    /// The segments in time.
    pub segments: Vec<PlanSegment>,
    /// The motion: cubic Hermite between knots.
    pub knots: Knots,
}

/// Where a plan comes from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    /// Name of the scenario.
    pub scenario: String,
    /// Version of the program that planned it.
    pub version: String,
}

impl Provenance {
    /// A scenario, planned by this version.
    #[must_use]
    pub fn of(scenario: &str) -> Self {
        Self {
            scenario: scenario.to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
        }
    }
}

/// The knots of a motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Knots {
    /// Times \[s\].
    pub t_s: Vec<f64>,
    /// Positions \[rad\], one row a knot.
    pub q_rad: Vec<JointVector>,
    /// Speeds \[rad/s\], one row a knot.
    pub qd_rad_s: Vec<JointVector>,
}

impl Knots {
    /// No knots at all.
    fn none() -> Self {
        Self {
            t_s: Vec::new(),
            q_rad: Vec::new(),
            qd_rad_s: Vec::new(),
        }
    }

    /// The motion through them.
    ///
    /// # Errors
    /// [`KnotError`] with the first knot that does not fit.
    pub fn motion(&self) -> Result<Trajectory, KnotError> {
        Trajectory::from_knots(self.t_s.clone(), self.q_rad.clone(), self.qd_rad_s.clone())
    }
}

impl From<&Trajectory> for Knots {
    fn from(motion: &Trajectory) -> Self {
        Self {
            t_s: motion.times().to_vec(),
            q_rad: motion.positions().to_vec(),
            qd_rad_s: motion.speeds().to_vec(),
        }
    }
}

/// What a plan says besides its job.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanParts {
    /// Where it comes from.
    pub provenance: Provenance,
    /// Plate indices in the order of washing.
    pub order: Vec<usize>,
    /// How each plate is washed, in the order of washing.
    pub wash_paths: Vec<WashPath>,
    /// The segments in time.
    pub segments: Vec<PlanSegment>,
    /// The motion.
    pub knots: Knots,
}

impl Plan {
    /// The plan of a job, sealed.
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

    /// The same plan with its job in the frame of the arm's base ([`JobTerms::seen_from_base`]), to compute with: its hash is that of
    /// the plan itself.
    #[must_use]
    pub fn seen_from_base(&self) -> Cow<'_, Self> {
        match self.job.seen_from_base() {
            Cow::Borrowed(_) => Cow::Borrowed(self),
            Cow::Owned(job) => Cow::Owned(Self { job, ..self.clone() }),
        }
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

    /// The hash that belongs to the contents.
    ///
    /// # Errors
    /// [`PlanFileError::Unwritable`] for contents that could not be read back: a number that is not finite.
    pub fn seal(&self) -> Result<String, PlanFileError> {
        let open = Self {
            hash: None,
            ..self.clone()
        };
        let canonical = serde_json_canonicalizer::to_vec(&open).map_err(unwritable)?;
        open.check_readable()?;
        Ok(sha256_hex(&canonical))
    }

    /// Refuses contents that would be read back as others.
    fn check_readable(mut self) -> Result<(), PlanFileError> {
        let refuse = |detail: &str| {
            let detail = detail.to_owned();
            Err(PlanFileError::Unwritable { detail })
        };
        // Almost all numbers are here, and all of one kind.
        let Knots { t_s, q_rad, qd_rad_s } = std::mem::replace(&mut self.knots, Knots::none());
        let mut numbers = t_s.iter().chain(q_rad.iter().chain(&qd_rad_s).flatten());
        if !numbers.all(|number| number.is_finite()) {
            return refuse("a number of the knots is not finite");
        }
        // What is not finite is written as `null`, and a whole number of more than 53 bits as its neighbour.
        let rest = serde_json_canonicalizer::to_vec(&self).map_err(unwritable)?;
        if serde_json::from_slice::<Self>(&rest).map_err(unwritable)? != self {
            return refuse("a whole number is above 2^53 − 1, the largest that JSON says exactly");
        }
        Ok(())
    }

    /// Whether the stored hash is that of the contents.
    #[must_use]
    pub fn is_sealed(&self) -> bool {
        self.hash.is_some() && self.hash == self.seal().ok()
    }

    /// The file's text: canonical JSON, one line.
    ///
    /// # Errors
    /// [`PlanFileError::Unwritable`].
    pub fn to_json(&self) -> Result<String, PlanFileError> {
        serde_json_canonicalizer::to_string(self).map_err(unwritable)
    }

    /// Reads a plan file's text: every key once, none unknown, none left out, so that what is read is all that the file says and the
    /// hash of the one is that of the other. The hash is not checked here: see [`Plan::is_sealed`].
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

    /// Refuses names that do not read as what they say.
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
        let mut all = alone.into_iter().chain(mount).chain(bodies).chain(obstacles);
        match all.find(|(_, name)| name.contains(is_hidden)) {
            None => Ok(()),
            Some((key, name)) => Err(PlanFileError::HiddenCharacter {
                key: key.to_owned(),
                found: name.clone(),
            }),
        }
    }
}

/// What tells formats apart.
#[derive(Deserialize)]
struct Head {
    format: Option<String>,
}

/// That a text which is no plan says that it has another format.
fn other_format(text: &str) -> Option<PlanFileError> {
    let format = serde_json::from_str::<Head>(text).ok()?.format?;
    (format != FORMAT).then(|| refused(format))
}

/// That a plan has another format.
fn refused(format: String) -> PlanFileError {
    if format == BEFORE {
        return PlanFileError::Before;
    }
    PlanFileError::Format { found: format }
}

fn unwritable(e: serde_json::Error) -> PlanFileError {
    PlanFileError::Unwritable { detail: e.to_string() }
}

/// The format that this version writes and reads.
pub const FORMAT: &str = "platewash-plan/2";

/// The format before it.
pub(crate) const BEFORE: &str = "platewash-plan/1";

/// Kinds of plans.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Process {
    /// A washing, planned as a whole from home to home; what a certificate is about.
    Wash,
    /// A run of the paper's program: waypoint after waypoint. There is no certificate for it.
    Paper,
}

impl fmt::Display for Process {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Wash => "wash",
            Self::Paper => "paper",
        })
    }
}

impl From<&Planner> for Process {
    fn from(planner: &Planner) -> Self {
        match planner {
            Planner::Wash(_) => Self::Wash,
            Planner::Paper(_) => Self::Paper,
        }
    }
}

/// Why a plan file could not be written or read.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlanFileError {
    /// A number in it is not finite, which JSON cannot say.
    #[error("plan cannot be written as JSON: {detail}")]
    Unwritable {
        /// The serialiser's words.
        detail: String,
    },
    /// Not a plan file.
    #[error("not a plan file: {0}")]
    Unreadable(#[from] JsonError),
    /// A key that no plan has.
    #[error("unknown key '{key}': a plan states what this program knows and nothing else")]
    UnknownKey {
        /// Its place, e.g. `wash_paths[2].extra`.
        key: String,
    },
    /// A key that is left out. Nothing is filled in: the hash is that of what the file says.
    #[error("'{key}' is missing: a plan states every value, defaults too; plan the scenario again")]
    MissingKey {
        /// Its place, e.g. `job.requirements.coverage`.
        key: String,
    },
    /// A value that says something else than what would be read.
    #[error("'{key}' is {found}; expected {read}")]
    Inexact {
        /// Its place.
        key: String,
        /// What the file says.
        found: String,
        /// What a plan file would say.
        read: String,
    },
    /// The format before this one.
    #[error(
        "this is a {BEFORE}: it carries a scenario, and this version reads {FORMAT}, which carries the resolved job; plan its \
         scenario again (platewash plan)"
    )]
    Before,
    /// The process and the planner contradict each other.
    #[error("process is \"{stated}\", and the job was planned as \"{planned}\"; a plan states one process")]
    Process {
        /// What the plan states.
        stated: Process,
        /// What its job says.
        planned: Process,
    },
    /// Lists that are longer than those of any job.
    #[error("the plan is too large: {detail}")]
    TooLarge {
        /// Which list, and where.
        detail: String,
    },
    /// A name that does not read as what it says.
    #[error("'{key}' is {}, a name with a control or direction character (escaped here): plan the scenario with another name", quoted(.found))]
    HiddenCharacter {
        /// Its place.
        key: String,
        /// The name.
        found: String,
    },
    /// Another format.
    #[error("plan format must be \"{FORMAT}\"; found \"{}\"", printable(.found))]
    Format {
        /// The format found.
        found: String,
    },
}
