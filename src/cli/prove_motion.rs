//! `platewash prove-motion`: a trajectory of any planner, proved over its whole time.

use super::failure::{ExitCode, internal};
use super::files::Files;
use super::numbers::within;
use super::options::Options;
use super::output::DetailArguments;
use super::page::needed_bundle;
use anyhow::{Context, Result, anyhow, bail};
use clap::{Args, ValueEnum};
use platewash::bodies::assembly;
use platewash::certificate::ProveError;
use platewash::kinematics::AXES;
use platewash::kinematics::urdf::FixedJoints;
use platewash::kinematics::urdf::file::read_text;
use platewash::motion_proof::{self, TrajectoryFile};
use platewash::scenario::{MeshPlaces, Note, ObstacleText, OriginLink, RobotSection, load_arm_with_fixed};
use platewash::viewer::page::html;
use platewash::viewer::view::{ArmMotion, View};
use platewash::workcell::Workcell;
use platewash::{Failure, JointVector, MotionReport, RobotModel, judged_motion, prove_motion};
use serde::Serialize;
use std::fmt;
use std::path::PathBuf;

/// Longest trajectory that is read \[bytes\].
const MAX_BYTES: u64 = 256 << 20;

/// Arguments of `prove-motion`.
#[derive(Debug, Args)]
pub struct ProveMotionArguments {
    /// Trajectory: a table (.csv), or ROS messages with a JointTrajectory: alone, or in those of planners, action clients and rosbridge
    /// (.yaml, .json)
    trajectory: PathBuf,
    /// File with the obstacles: TOML sections [[obstacle]], [floor] and [table] as in a scenario, or a planning scene of MoveIt (.scene)
    /// [default: none, and no floor]
    #[arg(long, value_name = "FILE")]
    obstacles: Option<PathBuf>,
    /// TOML file with the tool: sections [tool] and [[tool_body]] as in a scenario [default: only what the arm's description holds]
    #[arg(long, value_name = "FILE")]
    tool: Option<PathBuf>,
    /// Place of the arm among the obstacles: x, y, z [m], and roll, pitch, yaw [deg] where it is turned [default: at their origin]
    #[arg(long, value_name = "X,Y,Z[,R,P,Y]", value_parser = mount, allow_hyphen_values = true)]
    mount: Option<[[f64; 3]; 2]>,
    /// Link that stands at --mount: root, the root link of the arm's description, or base, from which its controller counts; needed where
    /// these two differ
    #[arg(long, value_name = "LINK", value_parser = origin_link, requires = "mount")]
    mount_link: Option<OriginLink>,
    /// Clearance that every pair of bodies must keep [m], from 0 to 1; with 0 they must not touch
    #[arg(long, value_name = "M", default_value = "0.005", value_parser = clearance, allow_negative_numbers = true)]
    clearance: f64,
    /// Motion between two points [default: quintic where the points have speeds and accelerations, cubic where they have speeds, otherwise
    /// linear]
    #[arg(long, value_enum)]
    interpolation: Option<Interpolation>,
    /// Greatest joint accelerations [rad/s²]: one number, or six between commas [default: those that the description states]
    #[arg(long, value_name = "A,…", value_parser = accelerations, allow_negative_numbers = true)]
    acceleration_limits: Option<[f64; AXES]>,
    /// Write a page that shows the motion and its worst places, a file of HTML
    #[arg(long, value_name = "FILE")]
    page: Option<PathBuf>,
    #[command(flatten)]
    details: DetailArguments,
}

/// Motion of each joint between two points.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Interpolation {
    /// At constant speed: a straight line in joint space
    Linear,
    /// The cubic with the positions and speeds of both points
    Cubic,
    /// The quintic with the positions, speeds and accelerations of both points
    Quintic,
}

impl ProveMotionArguments {
    /// The motion between two points, if it was chosen.
    fn choice(&self) -> Option<motion_proof::Interpolation> {
        self.interpolation.map(|choice| match choice {
            Interpolation::Linear => motion_proof::Interpolation::Linear,
            Interpolation::Cubic => motion_proof::Interpolation::Cubic,
            Interpolation::Quintic => motion_proof::Interpolation::Quintic,
        })
    }

    /// Note on a mesh that comes too near and whose convex parts reach beyond it.
    fn note_on_mesh(&self, options: &Options, report: &MotionReport) -> Option<Note> {
        let pair = report.too_near()?;
        let text = ObstacleText::load(self.obstacles.as_ref()?).ok()?;
        let notes = text.notes_on_meshes(&mesh_places(options));
        let is_it = |note: &Note| matches!(note, Note::LargerThanMesh { body, .. } if pair.contains(body));
        notes.into_iter().find(is_it)
    }
}

fn mesh_places(options: &Options) -> MeshPlaces {
    MeshPlaces {
        package_path: options.package_path.clone(),
        files: options.files.clone(),
    }
}

fn clearance(text: &str) -> Result<f64> {
    within(text, 0.0..=1.0, "must be a number from 0 to 1, in metres")
}

fn accelerations(text: &str) -> Result<[f64; AXES]> {
    let expected = "must be one number above 0, or six between commas";
    let one = |text: &str| within(text, f64::MIN_POSITIVE..=1e6, expected);
    let all: Vec<f64> = text.split(',').map(one).collect::<Result<_>>()?;
    match all[..] {
        [one] => Ok([one; AXES]),
        _ => all.try_into().map_err(|_| anyhow!("{expected}")),
    }
}

/// A place \[m\], and a turn where one is stated: roll, pitch, yaw \[°\].
fn mount(text: &str) -> Result<[[f64; 3]; 2]> {
    let expected = "must be x, y, z in metres from -10 to 10 or these and roll, pitch, yaw in degrees from -360 to 360, between commas";
    let numbers: Vec<&str> = text.split(',').collect();
    let number = |k: usize, most: f64| {
        numbers
            .get(k)
            .map_or(Ok(0.0), |text| within(text, -most..=most, expected))
    };
    if ![3, 6].contains(&numbers.len()) {
        bail!("{expected}");
    }
    Ok([
        [number(0, 10.0)?, number(1, 10.0)?, number(2, 10.0)?],
        [number(3, 360.0)?, number(4, 360.0)?, number(5, 360.0)?],
    ])
}

/// A link from which places are counted.
fn origin_link(text: &str) -> Result<OriginLink> {
    let known = OriginLink::ALL.into_iter().find(|link| link.name() == text);
    known.ok_or_else(|| anyhow!("must be root or base"))
}

/// The arm with the joints that do not move.
fn arm(options: &Options, fixed: &FixedJoints) -> Result<RobotModel> {
    // Others than the description's are the trajectory's.
    let section = RobotSection {
        fixed: FixedJoints::new(),
        ..options.robot_section(RobotSection::default())
    };
    let arm = load_arm_with_fixed(&section, &options.files, fixed).map_err(Failure::from)?;
    options.warn(&Note::of_arm(&arm));
    Ok(arm)
}

/// The arm with its tool among the obstacles.
fn workcell(options: &Options, arguments: &ProveMotionArguments, arm: &RobotModel) -> Result<Workcell> {
    let meshes = mesh_places(options);
    let load = |file: &PathBuf| ObstacleText::load(file).map_err(Failure::from);
    let [mount_m, mount_rpy_deg] = arguments.mount.unwrap_or_default();
    let mount = RobotSection {
        mount_m,
        mount_rpy_deg,
        mount_link: arguments.mount_link,
        ..RobotSection::default()
    };
    if let Some(readings) = mount.ambiguous_mount(arm) {
        bail!("--mount, --mount-link: {readings}");
    }
    let mut cell = assembly::workcell_without_tool(arm, mount.mount(arm), Vec::new())?;
    if let Some(file) = &arguments.tool {
        cell.tool = load(file)?.tool(arm, &meshes).map_err(Failure::from)?;
    }
    if let Some(file) = &arguments.obstacles {
        cell.obstacles = load(file)?.obstacles(arm, &cell.tool, &meshes).map_err(Failure::from)?;
        if cell.obstacles.is_empty() {
            bail!(
                "{}: expected obstacles; found none; for an arm alone leave --obstacles out",
                file.display()
            );
        }
    }
    options.warn(&Note::of_sizes(&cell.tool, &cell.obstacles));
    Ok(cell)
}

/// Reports on the trajectories of a file.
#[derive(Debug, Serialize)]
struct ReportList {
    headline: String,
    /// True where every one is proved.
    proved: bool,
    trajectories: Vec<PlacedReport>,
}

/// Report on a trajectory, and the line of its first point.
#[derive(Debug, Serialize)]
struct PlacedReport {
    line: usize,
    #[serde(flatten)]
    report: MotionReport,
}

impl ReportList {
    fn new(reports: impl Iterator<Item = (usize, MotionReport)>) -> Self {
        let trajectories: Vec<_> = reports.map(|(line, report)| PlacedReport { line, report }).collect();
        let count = trajectories.len();
        let at_fault = trajectories
            .iter()
            .enumerate()
            .find(|(_, placed)| !placed.report.proved);
        let headline = match at_fault {
            None => {
                let remarks = trajectories.iter().enumerate().flat_map(|(k, placed)| {
                    let of_one = placed.report.remarks().into_iter();
                    of_one.map(move |words| format!("; trajectory {}: {words}", k + 1))
                });
                format!(
                    "PROVED: {count} trajectories, each by itself; how the arm gets from the end of one to the start of the next is not \
                     judged{}",
                    remarks.collect::<String>()
                )
            }
            Some((k, PlacedReport { line, report })) => {
                let (verdict, words) = report
                    .headline
                    .split_once(": ")
                    .unwrap_or(("NOT PROVED", &report.headline));
                format!("{verdict}: trajectory {} of {count} (line {line}): {words}", k + 1)
            }
        };
        Self {
            proved: at_fault.is_none(),
            headline,
            trajectories,
        }
    }
}

impl fmt::Display for ReportList {
    /// Writes the first line of each; with `{:#}` each report.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.headline)?;
        for (k, PlacedReport { line, report }) in self.trajectories.iter().enumerate() {
            let place = format!("trajectory {} (line {line})", k + 1);
            match f.alternate() {
                true => writeln!(f, "\n{place}\n{report:#}")?,
                false => writeln!(f, "  {place}: {}", report.headline)?,
            }
        }
        Ok(())
    }
}

/// Judges the trajectories of an arm among obstacles.
pub fn run(options: &Options, arguments: &ProveMotionArguments) -> Result<ExitCode> {
    let fixed = options.fixed();
    let arm = arm(options, &fixed)?;
    let cell = workcell(options, arguments, &arm)?;
    let path = &arguments.trajectory;
    let name = path.display().to_string();
    let text = read_text(path, MAX_BYTES).with_context(|| format!("{name}: cannot be read"))?;
    let files = TrajectoryFile::read_all(&name, &text, &arm, &fixed)?;
    let limits = arguments.acceleration_limits.map(JointVector::from);
    let judge = |file: &TrajectoryFile| -> Result<_> {
        let motion = file.motion(&arm, arguments.choice())?;
        if limits.is_some() && motion.start.is_none() {
            bail!("--acceleration-limits: {name} has no times, so nothing is known of accelerations; leave it out");
        }
        let proved = options.during("proving the motion", || {
            prove_motion(&motion, &cell, &arm, arguments.clearance, limits, &options.cancel)
        });
        let mut report = proved.map_err(|error| match error {
            ProveError::Cancelled(cancelled) => cancelled.into(),
            other => anyhow!(other).context(name.clone()),
        })?;
        if let Some(note) = arguments.note_on_mesh(options, &report) {
            report.note(&note.to_string());
        }
        Ok((motion, report))
    };
    if arguments.page.is_some() && files.len() > 1 {
        bail!(
            "--page: {name}: a page shows one motion; found {}: give one of them in a file of its own",
            files.len()
        );
    }
    let mut all = files.iter().map(judge).collect::<Result<Vec<_>>>()?;
    if all.len() > 1 {
        let lines = files.iter().map(|file| file.lines.first().copied().unwrap_or(1));
        let reports = ReportList::new(lines.zip(all.into_iter().map(|(_, report)| report)));
        options.print(&reports, || arguments.details.printed(&reports))?;
        return Ok(ExitCode::NotVerified.unless(reports.proved));
    }
    let Some((motion, report)) = all.pop() else {
        bail!("{name}: expected a trajectory; found none");
    };
    if let Some(file) = &arguments.page {
        let shown = ArmMotion {
            name: &name,
            motion: &judged_motion(&motion, &arm, limits.as_ref()),
            workcell: &cell,
            robot: &arm,
            clearance_m: arguments.clearance,
            headline: &report.headline,
            proved: report.proved,
            checks: &report.checks,
            excluded: &report.excluded,
            assumptions: &report.assumptions,
        };
        let page = html(&View::of_arm_motion(&shown).map_err(internal)?, &needed_bundle()?).map_err(internal)?;
        let mut files = Files::new(None, &[]);
        files.add_at(file.clone(), page);
        files.write(&options.cancel)?;
    }
    options.print(&report, || arguments.details.printed(&report))?;
    Ok(ExitCode::NotVerified.unless(report.proved))
}
