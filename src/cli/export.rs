//! `platewash export`: a proved plan as a robot program, read back and judged before it is written. And `platewash verify --program`: a program
//! that was handed over, read back: what changed since, and whether it still holds.

use super::failure::{ExitCode, internal};
use super::files::{Files, check_places};
use super::input_file::refused as refused_file;
use super::numbers::between_commas;
use super::options::Options;
use super::output;
use super::plan_file::PlanFile;
use anyhow::{Context, Error, Result, bail, ensure};
use clap::Args;
use nalgebra::{Quaternion, UnitQuaternion};
use platewash::certificate::{CertifyError, Check, Requirement, certify_with};
use platewash::export::dialect::Dialect;
use platewash::export::judgement::{Case, ProgramJudgement};
use platewash::export::program::ProgramFile;
use platewash::export::{
    Change, CompareError, ExportError, ExportSettings, ExportedProgram, Joint3, Refusal, compare, contact_not_judged,
    dialects, export, ros2,
};
use platewash::kinematics::urdf::file::read_bytes;
use platewash::motion::plan::Plan;
use platewash::workcell::dry_run::DryRun;
use platewash::workcell::words::{count_with_noun, printable};
use platewash::{Certified, JointVector, Pose, ProveError};
use serde::Serialize;
use std::ffi::OsStr;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Largest number of files in the output folder that are examined.
const MOST_FILES: usize = 10_000;

/// Longest program file that is read \[bytes\].
const MAX_BYTES: u64 = 1 << 26;

/// Arguments of `export`.
#[derive(Debug, Args)]
pub struct ExportArguments {
    /// Plan file
    plan: PathBuf,
    /// Kind of program: rapid, ros2, urscript or csv
    #[arg(long, value_name = "TARGET", value_parser = target)]
    to: &'static dyn Dialect,
    /// Largest distance between the program's tip path and the plan's, in metres (0.0002 is 0.2 mm)
    #[arg(long, value_name = "M", default_value_t = ExportSettings::default().tolerance_m, allow_negative_numbers = true)]
    tolerance: f64,
    /// Speed of the program as a share of the plan's, above 0 and at most 1
    #[arg(long, value_name = "SHARE", default_value_t = 1.0, allow_negative_numbers = true)]
    speed_share: f64,
    /// Corner radius between points in metres (RAPID zones)
    #[arg(long, value_name = "M", default_value_t = ExportSettings::default().corner_m, allow_negative_numbers = true)]
    corner: f64,
    /// Name of a waived requirement that the program may break too, as in the certificate (may be repeated)
    #[arg(long, value_name = "REQUIREMENT", value_parser = waived)]
    accept: Vec<Requirement>,
    /// Count of axis 3 by the arm's controller (RAPID): with-joint-2 where a parallel linkage makes it rax_3 = joint_3 + joint_2, else
    /// independent. Some arms of ABB are refused without it: see docs/rapid.md, The maker's joints
    #[arg(long, value_name = "COUNT", value_parser = joint_3)]
    joint_3: Option<Joint3>,
    /// Joint positions of the arm now, in degrees; refused if more than half a degree from the plan's start
    #[arg(long, value_name = "J1,…,J6", value_parser = joints, allow_hyphen_values = true)]
    stands: Option<JointVector>,
    /// The controller's tool frame in the flange frame: x, y, z in mm and the quaternion w, x, y, z; refused if it is not the plan's
    #[arg(long, value_name = "X,Y,Z,QW,QX,QY,QZ", value_parser = frame, allow_hyphen_values = true)]
    tip: Option<Pose>,
}

fn target(name: &str) -> Result<&'static dyn Dialect> {
    dialects::by_name(name).with_context(|| format!("expected one of {}", dialects::names()))
}

fn waived(name: &str) -> Result<Requirement> {
    Requirement::named(name).context("no requirement of a certificate has that name")
}

/// Reads a count of axis 3.
pub fn joint_3(name: &str) -> Result<Joint3> {
    Joint3::named(name).with_context(|| format!("expected one of {}", Joint3::ALL.map(Joint3::name).join(", ")))
}

fn joints(text: &str) -> Result<JointVector> {
    Ok(JointVector::from(between_commas::<6>(text)?.map(f64::to_radians)))
}

fn frame(text: &str) -> Result<Pose> {
    let [x, y, z, w, i, j, k] = between_commas(text)?;
    let (place, quaternion) = (nalgebra::Vector3::new(x, y, z) * 1e-3, Quaternion::new(w, i, j, k));
    let length = quaternion.norm();
    ensure!(
        (length - 1.0).abs() <= 1e-3,
        "the quaternion (the last four numbers) must have length 1; found {length:.4}"
    );
    let turn = UnitQuaternion::from_quaternion(quaternion);
    Ok(Pose::from_parts(place.into(), turn))
}

/// Caveat in the first line of every program.
const NOT_JUDGED: &str = "not judged: how late the arm follows, and stops";

/// Proof of a program as it stands.
#[derive(Debug, Serialize)]
struct ProgramProofAnswer {
    /// Worst result of each check, over all assumptions about corners.
    checks: Vec<Check>,
    /// Speeds of the tip that the motion implies, which are not judged.
    implied: Vec<Check>,
    /// Promises about contact that are proved for the plan, but not judged for the program.
    #[serde(skip_serializing_if = "Option::is_none")]
    proved_of_the_plan_alone: Option<String>,
}

impl ProgramProofAnswer {
    fn new(judgement: &ProgramJudgement, plan: &Plan) -> Self {
        Self {
            checks: judgement.worst(),
            implied: judgement.implied(),
            proved_of_the_plan_alone: contact_not_judged(&plan.job.judged_requirements()),
        }
    }

    /// One line that says that contact is not judged; empty where the plan promises none.
    fn not_judged(&self) -> String {
        let all = self.proved_of_the_plan_alone.iter();
        all.map(|all| format!("  proved for the plan, not for the program: {all}\n"))
            .collect()
    }
}

/// Answer for a program that was written.
#[derive(Debug, Serialize)]
struct Answer<'a> {
    target: &'static str,
    /// Warning to be read first, where the plan is a dry run.
    #[serde(skip_serializing_if = "Option::is_none")]
    dry_run: Option<String>,
    files: Vec<PathBuf>,
    points: usize,
    duration_s: f64,
    #[serde(flatten)]
    proof: ProgramProofAnswer,
    /// Demands on the controller, by the size of the corners.
    asked: &'a [Case],
}

/// Answer where no program is written.
#[derive(Debug, Serialize)]
struct RefusalAnswer<'a> {
    refused: &'a str,
    message: &'a str,
}

/// Proves a plan file and writes it as a robot program that is proved, too.
pub fn run(options: &Options, arguments: &ExportArguments) -> Result<ExitCode> {
    let file = PlanFile::read(options, &arguments.plan)?;
    let certified = match certified(options, &file)? {
        Ok(certified) => certified,
        Err(words) => return refused(options, "uncertified", &words, ExitCode::NotVerified),
    };
    let settings = ExportSettings {
        tolerance_m: arguments.tolerance,
        speed_share: arguments.speed_share,
        corner_m: arguments.corner,
        accepted: arguments.accept.clone(),
        joint_3: arguments.joint_3,
        stands_rad: arguments.stands,
        tip: arguments.tip,
    };
    let exported = options.during("judging the program", || {
        export(&certified, &file.arm, arguments.to, &settings, &options.cancel)
    });
    match exported {
        Ok(exported) => write(options, arguments.to, &file.plan, &exported),
        Err(ExportError::Refused(refusal)) => {
            let (mend, code) = end_of(&refusal);
            refused(options, refusal.code(), &format!("{refusal}{mend}"), code)
        }
        Err(ExportError::Prove(error)) => Err(file.failure(error.into())),
        Err(error) => Err(internal(error)),
    }
}

/// The plan with its certificate, or why it has none.
fn certified(options: &Options, file: &PlanFile<'_>) -> Result<Result<Certified<Plan>, String>> {
    let _progress = options.progress("proving");
    match certify_with(file.plan.clone(), &file.arm, &options.cancel) {
        Ok(certified) => Ok(Ok(certified)),
        Err(CertifyError::Prove(error @ ProveError::PaperRun)) => Ok(Err(error.to_string())),
        Err(CertifyError::Prove(error)) => Err(file.failure(error.into())),
        Err(error) => Ok(Err(format!("{error}; platewash verify says more"))),
    }
}

fn refused(options: &Options, code: &str, message: &str, exit: ExitCode) -> Result<ExitCode> {
    if options.json {
        let refused = RefusalAnswer { refused: code, message };
        output::print(&output::json(&refused)?)?;
    }
    output::message(&format!("refused ({code}): {message}"));
    Ok(exit)
}

/// Keys or options that decide what is refused, as the end of a sentence, and the exit code: what stands against a plan is a verdict; what
/// stands against what was given beside it is bad input.
fn end_of(refusal: &Refusal) -> (&'static str, ExitCode) {
    match refusal {
        Refusal::Load { .. } => (
            " (scenario: tool.mass_kg, tool.com_m, tool.inertia_kg_m2)",
            ExitCode::Input,
        ),
        Refusal::Joint3 { .. } => (" (--joint-3; docs/rapid.md, The maker's joints)", ExitCode::Input),
        Refusal::Waived { .. } => (" (--accept NAME)", ExitCode::NotVerified),
        Refusal::NotKept { .. } | Refusal::TooClose { .. } => ("", ExitCode::NotVerified),
        _ => ("", ExitCode::Input),
    }
}

fn write(options: &Options, target: &dyn Dialect, plan: &Plan, exported: &ExportedProgram) -> Result<ExitCode> {
    let folder = match &options.out {
        Some(folder) => folder.clone(),
        None => options.folder().join(target.name()),
    };
    refuse_other_programs(&folder, target, &exported.files)?;
    let mut files = Files::new(folder, &[]);
    for file in &exported.files {
        files.add(&file.name, &file.text);
    }
    let paths: Vec<_> = files.paths().map(Path::to_owned).collect();
    check_places(&paths)?;
    let judged = &exported.judgement;
    let answer = Answer {
        target: target.name(),
        dry_run: plan.job.dry_run.as_ref().map(DryRun::words),
        files: paths,
        points: exported.reading.points.len(),
        duration_s: exported.reading.points.last().map_or(0.0, |point| point.t_s),
        proof: ProgramProofAnswer::new(judged, plan),
        asked: &judged.cases,
    };
    files.answer(options, &answer, || answer.text())?;
    Ok(ExitCode::Done)
}

/// Beginning of the answer on a dry run's program; empty for any other program.
fn dry_run_prefix(dry_run: Option<String>) -> String {
    dry_run.map_or_else(String::new, |words| words + "; ")
}

impl Answer<'_> {
    fn text(&self) -> String {
        let mut text = format!(
            "{}{} program: {} points, {:.3} s; read back and judged: HOLDS; {NOT_JUDGED}\n",
            dry_run_prefix(self.dry_run.clone()),
            self.target,
            self.points,
            self.duration_s
        );
        for check in &self.proof.checks {
            text += &format!("  {:<20} {}\n", check.requirement.words(), check.detail());
        }
        text += "  not judged: accelerations and stops at the plates, which the controller decides (see the head of the program)\n";
        text + &self.proof.not_judged()
    }
}

/// Refuses a folder with programs of the same kind that would stay beside the new one: modules of two plans are none.
fn refuse_other_programs(folder: &Path, target: &dyn Dialect, files: &[ProgramFile]) -> Result<()> {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return Ok(());
    };
    for entry in entries.take(MOST_FILES).flatten() {
        let other = ProgramFile {
            name: entry.file_name().to_string_lossy().into_owned(),
            text: String::new(),
        };
        if files.iter().all(|file| file.name != other.name) && target.is_in(&other) {
            bail!(
                "{}: stands beside the new program, and may be taken for a part of it: remove it, or give --out another folder",
                entry.path().display()
            );
        }
    }
    Ok(())
}

/// Answer for a program that was handed over.
#[derive(Debug, Serialize)]
struct HandoverAnswer {
    headline: String,
    target: &'static str,
    holds: bool,
    unchanged: bool,
    /// True where the program refuses to start unless the arm stands at the start.
    checks_start: bool,
    /// The files that were read.
    files: Vec<String>,
    changes: Vec<Change>,
    more_changes: usize,
    #[serde(flatten)]
    proof: ProgramProofAnswer,
    /// Settings that change the motion and are not those that were handed over.
    settings: Vec<Change>,
    /// Note where the tool of the program is not the plan's.
    #[serde(skip_serializing_if = "Option::is_none")]
    tool: Option<String>,
}

/// Compares the files of a program with the one that is made of the plan, and judges them as they stand.
pub fn verify_program(options: &Options, plan: &Path, program: &[PathBuf]) -> Result<ExitCode> {
    let files = with_siblings(program)
        .iter()
        .map(|path| read(path))
        .collect::<Result<Vec<_>>>()?;
    let file = PlanFile::read(options, plan)?;
    let certified = match certified(options, &file)? {
        Ok(certified) => certified,
        Err(words) => return refused(options, "uncertified", &words, ExitCode::NotVerified),
    };
    let compared = options.during("judging the program", || {
        compare(&certified, &file.arm, &files, &options.cancel)
    });
    let compared = compared.map_err(|error| match error {
        CompareError::Prove(error) => file.failure(error.into()),
        error => Error::from(error),
    })?;
    let (holds, unchanged) = (compared.holds(), compared.is_unchanged());
    let changed = match (unchanged, compared.changes.len() + compared.more_changes) {
        (true, _) => "as it was handed over".to_owned(),
        (false, count) => format!("CHANGED in {}", count_with_noun(count, "place")),
    };
    let verdict = match (holds, compared.checks_start) {
        (true, true) => "HOLDS",
        (true, false) => "HOLDS, START NOT CHECKED",
        (false, _) => "DOES NOT HOLD",
    };
    let mut settings: String = compared
        .settings
        .iter()
        .map(|change| format!("; {} {} ({} handed over)", change.what, change.found, change.expected))
        .collect();
    if compared.tool.is_some() {
        settings += "; tool or load not the plan's";
    }
    let answer = HandoverAnswer {
        headline: format!(
            "{}{verdict}{}: {} program, tip within {} mm of the plan{settings}; {changed}; {NOT_JUDGED}",
            dry_run_prefix(file.plan.job.dry_run.as_ref().map(DryRun::words)),
            certified.certificate().but_for(),
            compared.dialect,
            1e3 * compared.tolerance_m
        ),
        target: compared.dialect,
        holds,
        unchanged,
        checks_start: compared.checks_start,
        files: files.into_iter().map(|file| file.name).collect(),
        proof: ProgramProofAnswer::new(&compared.judgement, &file.plan),
        changes: compared.changes,
        more_changes: compared.more_changes,
        settings: compared.settings,
        tool: compared.tool.as_ref().map(ToString::to_string),
    };
    options.print(&answer, || answer.text())?;
    Ok(ExitCode::NotVerified.unless(holds))
}

/// The files of a program, and those beside them that can be sent in their place: of a ROS 2 program, all that `export` writes.
fn with_siblings(program: &[PathBuf]) -> Vec<PathBuf> {
    let mut all = program.to_vec();
    let is_own = |path: &&PathBuf| {
        let name = path.file_name().and_then(OsStr::to_str);
        name.is_some_and(|name| ros2::FILES.contains(&name))
    };
    for path in program.iter().filter(is_own) {
        for sibling in ros2::FILES.map(|name| path.with_file_name(name)) {
            if sibling.exists() && !all.contains(&sibling) {
                all.push(sibling);
            }
        }
    }
    all
}

fn read(path: &Path) -> Result<ProgramFile> {
    let name = path.file_name().unwrap_or(path.as_os_str());
    let bytes = read_bytes(path, MAX_BYTES).map_err(|e| refused_file(path, format_args!("cannot be read: {e}")))?;
    Ok(ProgramFile::from_bytes(&name.to_string_lossy(), bytes)?)
}

impl HandoverAnswer {
    fn text(&self) -> String {
        let files: Vec<_> = self.files.iter().map(|name| printable(name)).collect();
        let mut text = format!("{}\n  read: {}\n", self.headline, files.join(", "));
        // A text that grows cannot fail to be written.
        for change in &self.changes {
            let Change {
                place,
                what,
                found,
                expected,
            } = change;
            let _ = writeln!(text, "  {place}: {what}: {found}; handed over: {expected}");
        }
        if self.more_changes > 0 {
            let _ = writeln!(text, "  and {} more", self.more_changes);
        }
        if !self.unchanged {
            text +=
                "  only the motion is judged; changed checks before the start, messages and comments are only named\n";
        }
        if !self.checks_start {
            text += "  the start is not checked as it was exported: the program starts to move farther from it, or wherever the arm stands\n";
        }
        for Change {
            place,
            what,
            found,
            expected,
        } in &self.settings
        {
            let _ = writeln!(
                text,
                "  {what:<20} {:<9} {found}; handed over: {expected}; {place}; it changes the motion, which is not judged with it",
                "NOT KEPT"
            );
        }
        if let Some(tool) = &self.tool {
            let _ = writeln!(text, "  {:<20} {:<9} {tool}", "tool", "NOT KEPT");
        }
        for check in &self.proof.checks {
            let status = if check.status.is_kept() { "kept" } else { "NOT KEPT" };
            let (name, detail) = (check.requirement.words(), check.detail());
            let _ = writeln!(text, "  {name:<20} {status:<9} {detail}; {}", check.worst);
        }
        text + &self.proof.not_judged()
    }
}
