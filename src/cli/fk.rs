//! `platewash fk` and `platewash ik`: where the arm is and how near it comes to itself and its surroundings, and a configuration for a pose.

use super::failure::ExitCode;
use super::frame_pose::FramePose;
use super::numbers::{JointArguments, Unit, coordinate, joints};
use super::options::Options;
use super::output::{self, Reader};
use super::robot;
use super::terminal::shown;
use anyhow::{Context, Result, anyhow, bail};
use clap::Args;
use clap::builder::RangedU64ValueParser;
use nalgebra::{Quaternion, Rotation3, UnitQuaternion};
use platewash::kinematics::ik::analytic::{Label, Rejection, Solution};
use platewash::kinematics::ik::{AnalyticStarts, IkCause, Method, RandomRestarts, Start};
use platewash::kinematics::model::manipulability;
use platewash::kinematics::rotation::from_rpy;
use platewash::kinematics::words::{fixed, nonzero_decimals};
use platewash::kinematics::{AXES, LimitViolation};
use platewash::{
    Axes, ClearanceModel, Frame, IkError, IkSettings, IkSolver, JointVector, PairClearance, Pose, RobotModel, Scenario,
    ToolFrame,
};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::PathBuf;

/// Largest number of random restarts: seconds of work.
const MOST_RESTARTS: u64 = 10_000;

/// Arguments of `fk`.
#[derive(Debug, Args)]
pub struct FkArguments {
    #[command(flatten)]
    joints: JointArguments,
    /// File with one configuration of six numbers on each line
    #[arg(long, value_name = "FILE")]
    file: Option<PathBuf>,
}

/// Arguments of `ik`.
#[derive(Debug, Args)]
pub struct IkArguments {
    /// Position in the frame of the arm's root link, metres; `platewash robot` says where the pendant counts from another link
    #[arg(long, num_args = 3, required = true, allow_negative_numbers = true, value_names = ["X", "Y", "Z"], value_parser = coordinate)]
    position: Vec<f64>,
    #[command(flatten)]
    orientation: Orientation,
    /// Frame to place at the pose: flange, tool0, matlab_tool0, tip (of the scenario's tool) or a link's name [default: tool0; with
    /// --scenario, its tool_frame]
    #[arg(long, value_name = "NAME")]
    frame: Option<String>,
    /// Start configuration of the search in degrees [default: zeros]
    #[arg(
        long,
        num_args = 6,
        allow_negative_numbers = true,
        value_name = "Q",
        conflicts_with = "seed_rad"
    )]
    seed_deg: Option<Vec<f64>>,
    /// Start configuration of the search in radians
    #[arg(long, num_args = 6, allow_negative_numbers = true, value_name = "Q")]
    seed_rad: Option<Vec<f64>>,
    /// Number of random restarts, at most 10000; --seed seeds them
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = RangedU64ValueParser::<usize>::new().range(..=MOST_RESTARTS))]
    restarts: usize,
    /// Show all branches within the limits, and why the others are not (arms with a closed form)
    #[arg(long, conflicts_with = "restarts")]
    all: bool,
}

/// The orientation of the frame, one way or another.
#[derive(Debug, Args)]
#[group(required = true, multiple = false)]
struct Orientation {
    /// Roll, pitch, yaw (URDF: fixed axes x, y, z) in degrees
    #[arg(long, num_args = 3, allow_negative_numbers = true, value_names = ["R", "P", "Y"], value_parser = coordinate)]
    rpy_deg: Option<Vec<f64>>,
    /// Roll, pitch, yaw in radians
    #[arg(long, num_args = 3, allow_negative_numbers = true, value_names = ["R", "P", "Y"], value_parser = coordinate)]
    rpy_rad: Option<Vec<f64>>,
    /// Quaternion w x y z (it is normalised)
    #[arg(long, num_args = 4, allow_negative_numbers = true, value_names = ["W", "X", "Y", "Z"], value_parser = coordinate)]
    quaternion: Option<Vec<f64>>,
}

#[derive(Serialize)]
struct FkAnswer {
    robot: String,
    configurations: Vec<Configuration>,
}

#[derive(Serialize)]
struct Configuration {
    q_rad: JointVector,
    q_deg: JointVector,
    within_limits: bool,
    beyond_limits: Vec<LimitViolation>,
    limit_margins_rad: JointVector,
    manipulability: f64,
    frames: BTreeMap<String, FramePose>,
    clearance: Vec<PairClearance>,
}

#[derive(Serialize)]
struct IkAnswer {
    solved: bool,
    frame: String,
    target: FramePose,
    q_rad: JointVector,
    q_deg: JointVector,
    iterations: usize,
    position_error_m: f64,
    orientation_error_rad: f64,
    orientation_error_deg: f64,
    /// `dls` or `qp`, when solved.
    method: Option<Method>,
    /// Start from which the answer was found, when solved.
    start: Option<Start>,
    /// Every pair at that configuration, as `fk` has them.
    clearance: Vec<PairClearance>,
    /// Cause of the failure, when not solved.
    cause: Option<IkCause>,
}

#[derive(Serialize)]
struct AllBranchesAnswer {
    frame: String,
    target: FramePose,
    branches: Vec<BranchRow>,
    rejections: Vec<RejectionRow>,
}

#[derive(Serialize)]
struct BranchRow {
    /// Shoulder, elbow and wrist.
    branch: String,
    /// Configuration nearest to the seed.
    q_rad: JointVector,
    q_deg: JointVector,
    /// Number of values within the limits, a whole turn apart, of each joint.
    turns: [u32; AXES],
}

/// Branch that has no configuration, with the reason.
#[derive(Serialize)]
struct RejectionRow {
    branch: String,
    reason: String,
}

/// Poses of all frames, limit margins, manipulability and clearances. With `--scenario`, its tool, plates and obstacles count too.
pub fn fk(options: &Options, arguments: &FkArguments) -> Result<ExitCode> {
    let configurations = arguments.joints.configurations(arguments.file.as_ref())?;
    let scenario = options.scenario()?;
    let robot = options.arm(&scenario)?;
    let clearance = clearances(options, &scenario, &robot)?;
    let mut answers = configurations.iter().map(|q| Configuration::new(&robot, &clearance, q));
    if options.json {
        let answer = FkAnswer {
            robot: robot.name().to_owned(),
            configurations: answers.collect(),
        };
        output::print(&output::json(&answer)?)?;
        return Ok(ExitCode::Done);
    }
    // One by one, as long as anybody reads them.
    for answer in &mut answers {
        if output::print(&shown(&answer.text()))? == Reader::Gone {
            break;
        }
    }
    Ok(ExitCode::Done)
}

/// Solves one pose; an unreachable one is exit code 3 with the best configuration found.
pub fn ik(options: &Options, arguments: &IkArguments) -> Result<ExitCode> {
    let scenario = options.scenario()?;
    let arm = options.arm(&scenario)?;
    // The default scenario states poses as the paper does; a bare `ik` means ROS-Industrial's tool0.
    let stated = match options.scenario {
        Some(_) => scenario.robot.tool_frame,
        None => ToolFrame::Tool0,
    };
    let name = arguments.frame.as_deref().unwrap_or(stated.name());
    let frame = frame(&arm, &scenario, name)?;
    let (target, seed) = (arguments.target()?, arguments.seed()?);
    if arguments.all {
        return all_branches(
            options,
            &IkSolver::new(&arm, frame, IkSettings::default())?,
            name,
            &target,
            &seed,
        );
    }
    let restarts = RandomRestarts {
        seed: scenario.seed,
        count: arguments.restarts,
    };
    let settings = IkSettings {
        random_restarts: (arguments.restarts > 0).then_some(restarts),
        analytic_starts: AnalyticStarts::Used,
        position_tolerance_m: scenario.ik.position_tolerance_m,
        orientation_tolerance_rad: scenario.ik.orientation_tolerance_rad,
        ..IkSettings::default()
    };
    let (q_rad, iterations, errors, found, cause) = match IkSolver::new(&arm, frame, settings)?.solve(&target, &seed) {
        Ok(s) => {
            let errors = (s.position_error_m, s.orientation_error_rad);
            (s.q, s.iterations, errors, Some((s.method, s.start)), None)
        }
        Err(IkError::NotSolved(f)) => {
            let errors = (f.position_error_m, f.orientation_error_rad);
            (f.q, f.iterations, errors, None, Some(f.cause))
        }
        Err(other) => return Err(other.into()),
    };
    let (position_error_m, orientation_error_rad) = errors;
    let answer = IkAnswer {
        solved: cause.is_none(),
        frame: name.to_owned(),
        target: (&target).into(),
        q_rad,
        q_deg: q_rad.map(f64::to_degrees),
        iterations,
        position_error_m,
        orientation_error_rad,
        orientation_error_deg: orientation_error_rad.to_degrees(),
        method: found.map(|(method, _)| method),
        start: found.map(|(_, start)| start),
        clearance: clearances(options, &scenario, &arm)?.all(&q_rad),
        cause,
    };
    options.print(&answer, || answer.text(&arm))?;
    Ok(ExitCode::Infeasible.unless(answer.solved))
}

/// Shows every branch for a pose; a pose without one is exit code 3 with the reason of each branch.
fn all_branches(
    options: &Options,
    solver: &IkSolver<'_>,
    frame: &str,
    target: &Pose,
    previous: &JointVector,
) -> Result<ExitCode> {
    let solutions = solver.solve_all(target, previous)?;
    let branch = |solution: &Solution| {
        let q_rad = solution.nearest(previous);
        BranchRow {
            branch: solution.label.to_string(),
            q_rad,
            q_deg: q_rad.map(f64::to_degrees),
            turns: solution.turns,
        }
    };
    let rejection = |(label, reason): (Label, Rejection)| RejectionRow {
        branch: label.to_string(),
        reason: reason.to_string(),
    };
    let answer = AllBranchesAnswer {
        frame: frame.to_owned(),
        target: target.into(),
        branches: solutions.iter().map(branch).collect(),
        rejections: solutions.rejections().map(rejection).collect(),
    };
    options.print(&answer, || answer.text(solver.robot()))?;
    Ok(ExitCode::Infeasible.unless(!answer.branches.is_empty()))
}

/// The pairs that are looked at: those of the arm by itself, and where `--scenario` states a cell those of its tool, plates and obstacles, too.
fn clearances(
    options: &Options,
    scenario: &Scenario,
    robot: &RobotModel,
) -> Result<ClearanceModel, platewash::Failure> {
    if options.scenario.is_none() {
        return robot::bare_clearance(robot);
    }
    let layout = scenario.layout(robot)?;
    let workcell = scenario.workcell(robot, layout.plates.len())?;
    Ok(ClearanceModel::new(robot, &workcell, &layout.plates)?)
}

/// The pair that comes nearest, a line; nothing where no pair is looked at.
fn smallest(clearance: &[PairClearance]) -> String {
    let least = clearance.iter().min_by(|a, b| a.distance_m.total_cmp(&b.distance_m));
    least.map_or_else(String::new, |PairClearance { a, b, distance_m, .. }| {
        format!("smallest clearance: {:.2} mm, {a} – {b}\n", 1e3 * distance_m)
    })
}

impl Configuration {
    fn new(robot: &RobotModel, clearance: &ClearanceModel, q: &JointVector) -> Self {
        let (poses, limits) = (robot.fk(q), robot.limits());
        let links = robot.links().iter().map(|link| (link.name.as_str(), link.frame));
        let tool0 = robot.tool_frame(ToolFrame::MatlabTool0).ok();
        let frames = links.chain(tool0.map(|frame| (ToolFrame::MatlabTool0.name(), frame)));
        Self {
            q_rad: *q,
            q_deg: q.map(f64::to_degrees),
            within_limits: limits.contain(q),
            beyond_limits: limits.violations(q),
            limit_margins_rad: limits.margins(q),
            manipulability: manipulability(&poses.jacobian(&robot.last_link_frame(), Axes::Base)),
            frames: frames
                .map(|(name, frame)| (name.to_owned(), FramePose::from(&poses.pose(&frame))))
                .collect(),
            clearance: clearance.all(q),
        }
    }

    fn text(&self) -> String {
        let mut text = both_units(&self.q_rad);
        let (within, easy) = (if self.within_limits { "yes" } else { "NO" }, self.manipulability);
        // Writing to a String cannot fail.
        let _ = writeln!(text, "within limits: {within}; manipulability {easy:.3e}");
        for beyond in &self.beyond_limits {
            let by = nonzero_decimals((beyond.position_rad - beyond.limit_rad).abs().to_degrees(), 2);
            let _ = writeln!(text, "  {beyond}, by {by}°");
        }
        let _ = writeln!(
            text,
            "\n{:<14} {:>28}   {:>27}   {:>25}",
            "frame", "position, mm", "roll, pitch, yaw, deg", "rad"
        );
        for (name, pose) in &self.frames {
            let [x, y, z] = pose.position_m.map(|v| fixed(1e3 * v, 3));
            let ([r, p, w], [a, b, d]) = (pose.rpy_deg.map(|v| fixed(v, 4)), pose.rpy_rad.map(|v| fixed(v, 5)));
            let _ = writeln!(
                text,
                "{name:<14} {x:>9} {y:>9} {z:>9} {r:>10} {p:>9} {w:>9} {a:>9} {b:>8} {d:>8}"
            );
        }
        if !self.clearance.is_empty() {
            let _ = writeln!(text, "\n{}", smallest(&self.clearance));
        }
        text
    }
}

impl IkAnswer {
    fn text(&self, arm: &RobotModel) -> String {
        let of = format!("solved for {} of {}", self.frame, arm.name());
        let head = match self.cause {
            None => of,
            Some(cause) => format!("NOT {of}: {cause}; best configuration found:"),
        };
        let how = match (self.method, self.start) {
            (Some(method), Some(start)) => format!(", by {method:?} from {start:?}").to_lowercase(),
            _ => String::new(),
        };
        format!(
            "{head}\n{}{}error {:.3e} m, {:.3e} rad ({:.3e}°); {} iterations{how}\n",
            both_units(&self.q_rad),
            smallest(&self.clearance),
            self.position_error_m,
            self.orientation_error_rad,
            self.orientation_error_deg,
            self.iterations
        )
    }
}

impl AllBranchesAnswer {
    fn text(&self, arm: &RobotModel) -> String {
        let mut text = format!(
            "{} branches for {} of {}: the configuration nearest to the seed, deg\n",
            self.branches.len(),
            self.frame,
            arm.name()
        );
        let names = self.branches.iter().map(|row| row.branch.len());
        let names = names.chain(self.rejections.iter().map(|row| row.branch.len()));
        let wide = names.max().unwrap_or_default();
        // Writing to a String cannot fail.
        for row in &self.branches {
            let joints = columns(&row.q_deg, 6);
            let more: f64 = row.turns.iter().map(|turns| f64::from(*turns)).product();
            let more = match more {
                1.0 => String::new(),
                _ => format!("   (one of {more} with whole turns)"),
            };
            let _ = writeln!(text, "{:<wide$}{joints}{more}", row.branch);
        }
        for RejectionRow { branch, reason } in &self.rejections {
            let _ = writeln!(text, "{branch:<wide$} none: {reason}");
        }
        text
    }
}

/// Joint positions in degrees and radians, two lines.
fn both_units(q: &JointVector) -> String {
    format!(
        "q, deg {}\nq, rad {}\n",
        columns(&q.map(f64::to_degrees), 6),
        columns(q, 9)
    )
}

/// Numbers in columns.
fn columns(v: &JointVector, digits: usize) -> String {
    v.iter().map(|x| format!(" {:>12}", fixed(*x, digits))).collect()
}

fn frame(arm: &RobotModel, scenario: &Scenario, name: &str) -> Result<Frame> {
    match ToolFrame::ALL.into_iter().find(|f| f.name() == name) {
        Some(known) => Ok(arm.tool_frame(known)?),
        None if name == "tip" => Ok(scenario.tool_on(arm)?.tip_frame(arm)),
        None => Ok(arm.frame(name)?),
    }
}

/// The numbers as an array of length `N`; refuses any other count.
fn array<const N: usize>(numbers: &[f64]) -> Result<[f64; N]> {
    <[f64; N]>::try_from(numbers).map_err(|_| anyhow!("{N} numbers are needed; found {}", numbers.len()))
}

impl IkArguments {
    fn target(&self) -> Result<Pose> {
        let given = &self.orientation;
        let rotation = match (&given.rpy_deg, &given.rpy_rad, &given.quaternion) {
            (Some(rpy), ..) => from_rpy(array::<3>(rpy).context("--rpy-deg")?.map(f64::to_radians)),
            (_, Some(rpy), _) => from_rpy(array(rpy).context("--rpy-rad")?),
            (.., Some(wxyz)) => {
                let [w, x, y, z] = array(wxyz).context("--quaternion")?;
                let unit = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-9);
                let unit = unit.context("--quaternion must not be zero")?;
                *unit.to_rotation_matrix().matrix()
            }
            (None, None, None) => bail!("give --rpy-deg, --rpy-rad or --quaternion"),
        };
        let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rotation));
        let position = nalgebra::Vector3::from(array::<3>(&self.position).context("--position")?);
        Ok(Pose::from_parts(position.into(), rotation))
    }

    fn seed(&self) -> Result<JointVector> {
        match (&self.seed_deg, &self.seed_rad) {
            (Some(values), _) => joints(values, Unit::Degrees).context("--seed-deg"),
            (None, Some(values)) => joints(values, Unit::Radians).context("--seed-rad"),
            (None, None) => Ok(JointVector::zeros()),
        }
    }
}
