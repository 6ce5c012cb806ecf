//! `platewash export`: a proved plan as a robot program, read back and judged before it is written.

use super::failure::{self, ExitCode, Failure};
use super::options::Options;
use super::plan_file::PlanFile;
use super::progress::Progress;
use super::{output, results};
use anyhow::{anyhow, bail};
use clap::Args;
use nalgebra::{Quaternion, UnitQuaternion};
use platewash::certificate::{CertifyError, Check, Requirement, certify_with};
use platewash::export::dialect::{self, Dialect, ProgramFile};
use platewash::export::judged::Asked;
use platewash::export::{ExportError, ExportSettings, Exported, Refusal, contact_not_judged, export};
use platewash::workcell::dry_run::DryRun;
use platewash::workcell::plan::Plan;
use platewash::{Certified, JointVector, Pose};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Longest name of a file that is looked at beside those that are written.
const MOST_FILES: usize = 10_000;

/// Arguments of `export`.
#[derive(Debug, Args)]
pub struct ExportArguments {
    /// Plan file
    #[arg(value_name = "PLAN")]
    pub plan: PathBuf,
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
    /// Joint positions of the arm now, in degrees; refused if more than half a degree from the plan's start
    #[arg(long, value_name = "J1,…,J6", value_parser = joints, allow_hyphen_values = true)]
    stands: Option<JointVector>,
    /// The controller's tool frame in the flange frame: x, y, z in mm and the quaternion w, x, y, z; refused if it is not the plan's
    #[arg(long, value_name = "X,Y,Z,QW,QX,QY,QZ", value_parser = frame, allow_hyphen_values = true)]
    tip: Option<Pose>,
}

/// What is said of a program that was written.
#[derive(Debug, Serialize)]
struct Answer<'a> {
    target: &'static str,
    /// What must be read first where the plan is a dry run.
    #[serde(skip_serializing_if = "Option::is_none")]
    dry_run: Option<String>,
    files: Vec<&'a Path>,
    points: usize,
    duration_s: f64,
    /// What is proved of the program: the worst over all assumptions about corners.
    checks: Vec<Check>,
    /// What it implies, which is not judged.
    implied: Vec<Check>,
    /// What the controller is asked for, by the size of the corners.
    asked: Vec<CornerAsked>,
    /// What the plan promises of contact: of the program it is not judged.
    #[serde(skip_serializing_if = "Option::is_none")]
    proved_of_the_plan_alone: Option<String>,
}

#[derive(Debug, Serialize)]
struct CornerAsked {
    corner_scale: Option<f64>,
    #[serde(flatten)]
    asked: Asked,
}

/// What is said where there is none.
#[derive(Debug, Serialize)]
struct Refused<'a> {
    refused: &'a str,
    message: String,
}

/// Proves a plan file and writes it as a robot program that is proved, too.
pub fn run(options: &Options, arguments: &ExportArguments) -> Result<ExitCode, Failure> {
    let file = PlanFile::read(options, &arguments.plan)?;
    let certified = match certified(options, &file)? {
        Ok(certified) => certified,
        Err(words) => return uncertified(options, &words),
    };
    let settings = ExportSettings {
        tolerance_m: arguments.tolerance,
        speed_share: arguments.speed_share,
        corner_m: arguments.corner,
        accepted: arguments.accept.clone(),
        stands_rad: arguments.stands,
        tip: arguments.tip,
    };
    let exported = {
        let _progress = Progress::new(options.quiet, "judging the program");
        export(&certified, &file.arm, arguments.to, &settings, &options.cancel)
    };
    match exported {
        Ok(exported) => write(options, arguments.to, &file.plan, &exported),
        Err(ExportError::Refused(refusal)) => {
            let message = format!("{refusal}{}", where_to_mend(&refusal));
            refused(options, refusal.code(), &message, exit_code(&refusal))
        }
        Err(ExportError::Prove(error)) => Err(file.failure(error.into())),
        Err(error) => Err(Failure::internal(error)),
    }
}

/// The plan with its certificate, or why it has none.
pub fn certified(options: &Options, file: &PlanFile<'_>) -> Result<Result<Certified<Plan>, String>, Failure> {
    let _progress = Progress::new(options.quiet, "proving");
    match certify_with(file.plan.clone(), &file.arm, &options.cancel) {
        Ok(certified) => Ok(Ok(certified)),
        Err(CertifyError::Prove(error)) => match error {
            platewash::ProveError::PaperRun => Ok(Err(error.to_string())),
            error => Err(file.failure(error.into())),
        },
        Err(error) => Ok(Err(format!("{error}; platewash verify says more"))),
    }
}

/// Says that a plan has no certificate.
pub fn uncertified(options: &Options, words: &str) -> Result<ExitCode, Failure> {
    refused(options, "uncertified", words, failure::NOT_VERIFIED)
}

fn refused(options: &Options, code: &str, message: &str, exit: u8) -> Result<ExitCode, Failure> {
    let refused = Refused {
        refused: code,
        message: message.to_owned(),
    };
    if options.json {
        output::print(&output::json(&refused)?)?;
    }
    output::message(false, &format!("refused ({code}): {message}"));
    Ok(ExitCode::from(exit))
}

/// Keys or options that decide what is refused, as the end of a sentence.
fn where_to_mend(refusal: &Refusal) -> &'static str {
    match refusal {
        Refusal::Load { .. } => " (scenario: tool.mass_kg, tool.com_m, tool.inertia_kg_m2)",
        Refusal::Waived { .. } => " (--accept NAME)",
        _ => "",
    }
}

/// What stands against a plan is a verdict; what stands against what was given beside it is bad input.
fn exit_code(refusal: &Refusal) -> u8 {
    match refusal {
        Refusal::Waived { .. } | Refusal::NotKept { .. } | Refusal::TooClose { .. } => failure::NOT_VERIFIED,
        _ => failure::INPUT,
    }
}

fn write(options: &Options, target: &dyn Dialect, plan: &Plan, exported: &Exported) -> Result<ExitCode, Failure> {
    let dry_run = plan.job.dry_run.as_ref();
    let folder = match &options.out {
        Some(folder) => folder.clone(),
        None => results::folder(options).join(target.name()),
    };
    refuse_others(&folder, target, &exported.files).map_err(Failure::input)?;
    let paths: Vec<_> = exported.files.iter().map(|file| folder.join(&file.name)).collect();
    let files: Vec<_> = paths
        .iter()
        .zip(&exported.files)
        .map(|(path, file)| output::file(path.clone(), &file.text))
        .collect();
    output::check_places(&paths)?;
    output::write_files(&files, &options.cancel)?;
    let judged = &exported.judged;
    let answer = Answer {
        target: target.name(),
        dry_run: dry_run.map(DryRun::words),
        files: paths.iter().map(PathBuf::as_path).collect(),
        points: exported.reading.points.len(),
        duration_s: exported.reading.points.last().map_or(0.0, |point| point.t_s),
        checks: judged.worst(),
        implied: judged.implied(),
        asked: judged
            .cases
            .iter()
            .map(|case| CornerAsked {
                corner_scale: case.corner_scale,
                asked: case.asked,
            })
            .collect(),
        proved_of_the_plan_alone: contact_not_judged(&plan.job.requirements),
    };
    output::print_either(options.json, &answer, || answer.text())?;
    results::name(options, &files);
    Ok(ExitCode::SUCCESS)
}

/// What stands before everything else that is said of a dry run's program.
pub fn before(dry_run: Option<&str>) -> String {
    dry_run.map_or_else(String::new, |words| format!("{words}; "))
}

impl Answer<'_> {
    fn text(&self) -> String {
        let mut text = format!(
            "{}{} program: {} points, {:.3} s; read back and judged: HOLDS\n",
            before(self.dry_run.as_deref()),
            self.target,
            self.points,
            self.duration_s
        );
        for check in &self.checks {
            text += &format!("  {:<20} {}\n", check.requirement.words(), check.detail());
        }
        text += "  not judged: accelerations and stops at the plates, which the controller decides (see the head of the program)\n";
        if let Some(all) = &self.proved_of_the_plan_alone {
            text += &format!("  proved for the plan, not for the program: {all}\n");
        }
        text
    }
}

/// Refuses a folder with programs of the same kind that would stay beside the new one: modules of two plans are none.
fn refuse_others(folder: &Path, target: &dyn Dialect, files: &[ProgramFile]) -> anyhow::Result<()> {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return Ok(());
    };
    for entry in entries.take(MOST_FILES).flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let is_new = files.iter().any(|file| file.name == name);
        let other = ProgramFile {
            name,
            text: String::new(),
        };
        if !is_new && target.is_in(&other) {
            bail!(
                "{}: stands beside the new program, and may be taken for a part of it: remove it, or give --out another folder",
                entry.path().display()
            );
        }
    }
    Ok(())
}

fn target(name: &str) -> Result<&'static dyn Dialect, String> {
    dialect::by_name(name).ok_or_else(|| format!("expected one of {}", dialect::names()))
}

fn waived(name: &str) -> Result<Requirement, String> {
    Requirement::named(name).ok_or_else(|| "no requirement of a certificate has that name".to_owned())
}

/// As many finite numbers as asked, between commas.
fn numbers<const N: usize>(text: &str) -> anyhow::Result<[f64; N]> {
    let all: Result<Vec<f64>, _> = text.split(',').map(|number| number.trim().parse::<f64>()).collect();
    let all = all.map_err(|_| anyhow!("expected {N} numbers between commas"))?;
    let found = all.len();
    let all: [f64; N] = all
        .try_into()
        .map_err(|_| anyhow!("expected {N} numbers between commas; found {found}"))?;
    if !all.iter().all(|number| number.is_finite()) {
        bail!("the numbers must be finite");
    }
    Ok(all)
}

fn joints(text: &str) -> anyhow::Result<JointVector> {
    Ok(JointVector::from(numbers::<6>(text)?.map(f64::to_radians)))
}

fn frame(text: &str) -> anyhow::Result<Pose> {
    let [x, y, z, w, i, j, k] = numbers::<7>(text)?;
    let quaternion = Quaternion::new(w, i, j, k);
    if (quaternion.norm() - 1.0).abs() > 1e-3 {
        bail!(
            "the quaternion (the last four numbers) must have length 1; found {:.4}",
            quaternion.norm()
        );
    }
    let place = nalgebra::Vector3::new(x, y, z) * 1e-3;
    Ok(Pose::from_parts(
        place.into(),
        UnitQuaternion::from_quaternion(quaternion),
    ))
}
