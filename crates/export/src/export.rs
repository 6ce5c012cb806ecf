//! A certified plan becomes a program, which is read back and judged before it is handed over.

use crate::dialect::language::Dialect;
use crate::dialect::start_within::start_within_deg;
use crate::joint_3::Joint3;
use crate::judgement::{self, ProgramJudgement};
use crate::points::Source;
use crate::program::{Program, ProgramFile};
use crate::reading::Reading;
use crate::refusal::Refusal;
use crate::settings::ExportSettings;
use crate::{header, tool_frame};
use platewash_certificate::{Certified, ProveError};
use platewash_kinematics::words::distinct_decimals;
use platewash_kinematics::{AXES, JointVector, RobotModel};
use platewash_motion::plan::Plan;
use platewash_motion_proof::ReadError;
use platewash_workcell::ArmId;
use platewash_workcell::cancel::CancelToken;

/// Largest difference between a point that was read back and the one that was written \[°\], and between their times \[s\].
const READ_WITHIN: (f64, f64) = (1e-4, 1e-4);

/// A program that may be handed over.
#[derive(Debug, Clone, PartialEq)]
pub struct ExportedProgram {
    /// Files of the program.
    pub files: Vec<ProgramFile>,
    /// Proof of the program.
    pub judgement: ProgramJudgement,
    /// Program as read back.
    pub reading: Reading,
}

/// Reason that there is no program.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The plan is not handed over.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// The motion cannot be judged, or the work was given up.
    #[error(transparent)]
    Prove(#[from] ProveError),
    /// The program that was written does not match the intended one: a fault of platewash.
    #[error("the {dialect} program that was written does not read back: {reason}")]
    Unfaithful {
        /// The dialect.
        dialect: &'static str,
        /// Difference, and its place.
        reason: String,
    },
}

/// A certified plan of an arm as a program of a dialect.
///
/// # Errors
/// [`ExportError`]; [`Refusal`] where the plan, its job or the motion of the program is refused.
pub fn export(
    certified: &Certified<Plan>,
    arm: &RobotModel,
    dialect: &dyn Dialect,
    settings: &ExportSettings,
    cancel: &CancelToken,
) -> Result<ExportedProgram, ExportError> {
    let plan = certified.plan();
    check(certified, arm, dialect, settings)?;
    dialect.accepts(&plan.job, arm)?;
    let exported = written(certified, arm, dialect, settings, cancel)?;
    exported.judgement.accepted()?;
    Ok(exported)
}

/// Writes the program again as it was handed over, without the checks on the plan that came before: an edited one is compared
/// with it.
pub(crate) fn again(
    certified: &Certified<Plan>,
    arm: &RobotModel,
    dialect: &dyn Dialect,
    settings: &ExportSettings,
    cancel: &CancelToken,
) -> Result<ExportedProgram, ExportError> {
    settings.check(dialect, arm)?;
    written(certified, arm, dialect, settings, cancel)
}

/// Checks the requirements that hold for every dialect.
fn check(
    certified: &Certified<Plan>,
    arm: &RobotModel,
    dialect: &dyn Dialect,
    settings: &ExportSettings,
) -> Result<(), Refusal> {
    settings.check(dialect, arm)?;
    let job = &certified.plan().job;
    let (expected, found) = (&job.workcell.arm, ArmId::new(arm));
    if *expected != found {
        return Err(Refusal::OtherArm {
            expected: expected.name.clone(),
            found: found.name,
        });
    }
    let waived = certified.certificate().waived.iter();
    let waived: Vec<_> = waived
        .filter(|requirement| !settings.accepted.contains(requirement))
        .collect();
    if !waived.is_empty() {
        let waived = waived.into_iter().map(|requirement| requirement.words()).collect();
        return Err(Refusal::Waived { waived });
    }
    if let Some(stands) = &settings.stands_rad {
        let joint_3 = settings.joint_3.unwrap_or_default();
        check_start(stands, joint_3, &job.home_rad[0], start_within_deg(job))?;
    }
    settings
        .tip
        .as_ref()
        .map_or(Ok(()), |tip| tool_frame::check(tip, &job.workcell.tool.tip))
}

/// Compares where the arm stands, in the joints of the program, with the start of the plan; sizes are those of the description's joints.
fn check_start(stands: &JointVector, joint_3: Joint3, start: &JointVector, most_deg: f64) -> Result<(), Refusal> {
    let off_deg = (joint_3.convert_back(stands) - start).map(f64::to_degrees);
    let off = |joint: &usize| off_deg[*joint].abs();
    let worst = (0..AXES).max_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(0);
    if off(&worst) <= most_deg {
        return Ok(());
    }
    Err(Refusal::Start {
        joint: worst,
        found_deg: stands[worst].to_degrees(),
        expected_deg: stands[worst].to_degrees() - off_deg[worst],
        most_deg,
    })
}

/// The program with its proof at its head; it is judged before its header is known.
fn written(
    certified: &Certified<Plan>,
    arm: &RobotModel,
    dialect: &dyn Dialect,
    settings: &ExportSettings,
    cancel: &CancelToken,
) -> Result<ExportedProgram, ExportError> {
    let plan = certified.plan();
    let source = Source::new(plan, arm).map_err(ProveError::from)?;
    let points = source.points(dialect.points(), settings)?;
    let unfaithful = |reason: String| ExportError::Unfaithful {
        dialect: dialect.name(),
        reason,
    };
    let text = |judgement: Option<&ProgramJudgement>| {
        let program = Program {
            name: name_of(plan),
            plan,
            arm,
            points: points.clone(),
            speed_share: settings.speed_share,
            corner_m: settings.corner_m,
            joint_3: settings.joint_3.unwrap_or_default(),
            header: header::lines(certified, &source, dialect, settings, (&points, judgement)),
        };
        let files = dialect.write(&program);
        let reading = dialect
            .read(&files, arm)
            .map_err(|e: ReadError| unfaithful(e.to_string()))?;
        match differs(&program, &reading) {
            Some(reason) => Err(unfaithful(reason)),
            None => Ok((files, reading)),
        }
    };
    let (_, reading) = text(None)?;
    let judged = judgement::judge(certified, &reading, arm, settings.tolerance_m, cancel)?;
    let (files, reading) = text(Some(&judged))?;
    Ok(ExportedProgram {
        files,
        judgement: judged,
        reading,
    })
}

/// Returns the first difference between the program written and the one read back.
fn differs(program: &Program<'_>, reading: &Reading) -> Option<String> {
    let (written, read) = (program.points.len(), reading.points.len());
    if written != read {
        return Some(format!("{written} points were written, {read} read"));
    }
    if let Some(stated) = reading
        .speed_share
        .filter(|stated| (program.speed_share - stated).abs() > 1e-6)
    {
        let [share, stated] = distinct_decimals(program.speed_share, stated, 6);
        return Some(format!("the speed share is {share}, read as {stated}"));
    }
    let share = program.speed_share;
    let both = program.points.iter().zip(&reading.points);
    both.into_iter().find_map(|(point, read)| {
        let (most_deg, most_s) = READ_WITHIN;
        let off_deg = (point.q_rad - read.q_rad).amax().to_degrees();
        let off_s = (point.t_s - read.t_s * share).abs();
        let far = off_deg.is_nan() || off_deg > most_deg || off_s.is_nan() || off_s > most_s;
        far.then(|| format!("{}: {off_deg:.2e}° and {off_s:.2e} s off", read.place))
    })
}

/// Name of a plan's program: of its scenario, and of a dry run alone does it begin with that, however long the scenario's name is.
fn name_of(plan: &Plan) -> String {
    let scenario = &plan.provenance.scenario;
    if plan.job.dry_run.is_some() {
        let washing = scenario.strip_suffix("-dry-run").unwrap_or(scenario);
        return identifier(&format!("dry run {washing}"));
    }
    let name = identifier(scenario);
    match name.contains("dry_run") {
        true => identifier(&format!("wash {name}")),
        false => name,
    }
}

/// A name that every dialect takes: a letter, then letters, digits and `_`, 20 at most.
fn identifier(name: &str) -> String {
    const LONGEST: usize = 20;
    let letter = |c: char| {
        if c.is_ascii_alphanumeric() {
            c.to_ascii_lowercase()
        } else {
            '_'
        }
    };
    let plain: String = name.chars().map(letter).collect();
    let plain = plain.trim_matches('_');
    let named = match plain.chars().next() {
        Some(first) if first.is_ascii_alphabetic() => plain.to_owned(),
        _ => format!("wash_{plain}"),
    };
    named
        .chars()
        .take(LONGEST)
        .collect::<String>()
        .trim_end_matches('_')
        .to_owned()
}
