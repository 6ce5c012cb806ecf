//! Plan files as input, with the arm that they are for.

use super::failure::not_verified;
use super::input_file::{refused, text};
use super::options::Options;
use anyhow::{Error, Result, bail, ensure};
use platewash::certificate::prove_with;
use platewash::scenario::{Note, RobotSection, load_arm};
use platewash::workcell::ArmId;
use platewash::{Certificate, Failure, Plan, RobotModel};
use std::fmt::Display;
use std::path::Path;
use std::sync::Arc;

/// Longest plan file that is read \[bytes\]: some million knots.
const MAX_BYTES: u64 = 1 << 28;

/// A plan that was read from a file, with its arm.
#[derive(Debug)]
pub struct PlanFile<'a> {
    path: &'a Path,
    /// The plan.
    pub plan: Plan,
    /// The arm that it is for.
    pub arm: Arc<RobotModel>,
}

impl<'a> PlanFile<'a> {
    /// Reads a plan and finds its arm.
    pub fn read(options: &Options, path: &'a Path) -> Result<Self> {
        Self::with_arm(options, path, read(path)?, None)
    }

    /// A plan that was read, with its arm: that of `--urdf`, the one given besides, or the built-in one.
    pub fn with_arm(options: &Options, path: &'a Path, plan: Plan, besides: Option<&Arc<RobotModel>>) -> Result<Self> {
        let arm = find_arm(options, &plan.job.workcell.arm, besides).map_err(|error| refused(path, error))?;
        options.warn(&Note::of_arm(&arm));
        Ok(Self { path, plan, arm })
    }

    /// The certificate of the plan.
    pub fn prove(&self, options: &Options) -> Result<Certificate> {
        let proved = options.during("proving", || prove_with(&self.plan, &self.arm, &options.cancel));
        proved.map_err(|error| self.failure(error.into()))
    }

    /// The certificate of the plan, which must be proved: what is asked for is `made` of proved plans alone.
    pub fn prove_as_parent(&self, options: &Options, made: &str) -> Result<Certificate> {
        let proved = self.prove(options)?;
        let (passes, first) = (proved.passes(), &proved.headline);
        match passes {
            true => Ok(proved),
            false => Err(self.not_verified(format_args!("a {made} is one of a proved plan; this one is {first}"))),
        }
    }

    /// Something in the file that cannot be used.
    pub fn refused(&self, error: impl Display) -> Error {
        refused(self.path, error)
    }

    /// Something in the file that is not as it was written, or not proved.
    pub fn not_verified(&self, error: impl Display) -> Error {
        not_verified(self.refused(error))
    }

    /// Error for a plan that could not be judged or simulated; it names the file, unless the work was cancelled.
    pub fn failure(&self, error: Failure) -> Error {
        match error.is_cancelled() {
            true => error.into(),
            false => self.refused(error),
        }
    }
}

/// The plan of a file.
pub fn read(path: &Path) -> Result<Plan> {
    if path.extension().is_some_and(|extension| extension == "toml") {
        let name = path.display();
        bail!("{name}: is not a plan file; 'platewash plan --scenario {name}' makes one from a scenario");
    }
    Plan::from_json(&text(path, MAX_BYTES)?).map_err(|e| refused(path, e))
}

/// The arm of a plan. A plan carries the hashes of its description and its SRDF alone.
fn find_arm(options: &Options, wanted: &ArmId, besides: Option<&Arc<RobotModel>>) -> Result<Arc<RobotModel>> {
    let is_stated = |(joint, at): &(String, f64)| wanted.fixed.get(joint) == Some(at);
    ensure!(
        options.fix.iter().all(is_stated),
        "--fix: the plan states which joints are held still ({}); leave it out",
        match wanted.fixed.is_empty() {
            true => "none".to_owned(),
            false => wanted.fixed_words(),
        }
    );
    if options.urdf.is_some() {
        let section = RobotSection {
            fixed: wanted.fixed.clone(),
            ..options.robot_section(RobotSection::default())
        };
        let arm = load_arm(&section, &options.files)?;
        refuse_other(wanted, &ArmId::new(&arm))?;
        return Ok(Arc::new(arm));
    }
    let is_it = |arm: &&Arc<RobotModel>| is_same_arm(wanted, &ArmId::new(arm));
    if let Some(arm) = besides.filter(is_it) {
        return Ok(arm.clone());
    }
    let built_in = Arc::new(RobotModel::irb120()?);
    if is_it(&&built_in) {
        return Ok(built_in);
    }
    let srdf = wanted.srdf_sha256.as_ref();
    let srdf = srdf.map_or_else(String::new, |hash| {
        format!(", and its SRDF (SHA-256 {hash}) as --srdf FILE")
    });
    bail!(
        "the plan is for the arm \"{}\" (URDF SHA-256 {}): give that description as --urdf FILE{srdf}",
        wanted.name,
        wanted.urdf_sha256
    );
}

fn is_same_arm(wanted: &ArmId, given: &ArmId) -> bool {
    (&wanted.urdf_sha256, &wanted.srdf_sha256) == (&given.urdf_sha256, &given.srdf_sha256)
}

/// Refuses an arm of another description or with another SRDF.
fn refuse_other(wanted: &ArmId, given: &ArmId) -> Result<()> {
    ensure!(
        wanted.urdf_sha256 == given.urdf_sha256,
        "the plan is for the arm \"{}\" (URDF SHA-256 {}); --urdf describes \"{}\" ({})",
        wanted.name,
        wanted.urdf_sha256,
        given.name,
        given.urdf_sha256
    );
    match (&wanted.srdf_sha256, &given.srdf_sha256) {
        (Some(wanted), None) => bail!("the plan was made with an SRDF (SHA-256 {wanted}): give it as --srdf FILE"),
        (None, Some(_)) => bail!("the plan was made without an SRDF: leave out --srdf"),
        (Some(wanted), Some(given)) if wanted != given => {
            bail!("the plan was made with the SRDF of SHA-256 {wanted}; that of --srdf is {given}")
        }
        _ => Ok(()),
    }
}
