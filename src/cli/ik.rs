//! `platewash ik`: a configuration for one pose.

use super::angles::{Unit, joints};
use super::exit::Outcome;
use super::failure::{ExitCode, Failure};
use super::fk::{FramePose, both_units, clearances, smallest};
use super::options::Options;
use super::output;
use anyhow::{Context, anyhow};
use clap::Args;
use nalgebra::{Quaternion, Rotation3, UnitQuaternion};
use platewash::kinematics::ik::{AnalyticStarts, RandomRestarts};
use platewash::kinematics::rotation::from_rpy;
use platewash::{
    Frame, IkError, IkSettings, IkSolver, JointVector, PairClearance, Pose, RobotModel, Scenario, ToolFrame,
};
use serde::Serialize;

/// Most random restarts: seconds of work.
const MOST_RESTARTS: usize = 10_000;

/// Arguments of `ik`.
#[derive(Debug, Args)]
pub struct IkArguments {
    /// Position in the base frame, metres
    #[arg(long, num_args = 3, required = true, allow_negative_numbers = true, value_names = ["X", "Y", "Z"])]
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
    #[arg(long, value_name = "N", default_value_t = 0)]
    restarts: usize,
}

/// The orientation of the frame, one way or another.
#[derive(Debug, Args)]
#[group(required = true, multiple = false)]
struct Orientation {
    /// Roll, pitch, yaw (URDF: fixed axes x, y, z) in degrees
    #[arg(long, num_args = 3, allow_negative_numbers = true, value_names = ["R", "P", "Y"])]
    rpy_deg: Option<Vec<f64>>,
    /// Roll, pitch, yaw in radians
    #[arg(long, num_args = 3, allow_negative_numbers = true, value_names = ["R", "P", "Y"])]
    rpy_rad: Option<Vec<f64>>,
    /// Quaternion w x y z (it is normalised)
    #[arg(long, num_args = 4, allow_negative_numbers = true, value_names = ["W", "X", "Y", "Z"])]
    quaternion: Option<Vec<f64>>,
}

#[derive(Serialize)]
struct Answer {
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
    method: Option<platewash::kinematics::ik::Method>,
    /// Where the answer was found from, when solved.
    start: Option<platewash::kinematics::ik::Start>,
    /// Every pair at that configuration, as `fk` has them.
    clearance: Vec<PairClearance>,
    /// Why not, when not solved.
    cause: Option<platewash::kinematics::ik::IkCause>,
}

/// Solves one pose; an unreachable one is exit code 3 with the best configuration found.
pub fn run(options: &Options, arguments: &IkArguments) -> Result<ExitCode, Failure> {
    if arguments.restarts > MOST_RESTARTS {
        return Err(Failure::input(anyhow!(
            "--restarts must be from 0 to {MOST_RESTARTS}; found {}",
            arguments.restarts
        )));
    }
    let scenario = options.scenario()?;
    let arm = options.arm(&scenario)?;
    // The default scenario states poses as the paper does; a bare `ik` means ROS-Industrial's tool0.
    let stated = match options.scenario {
        Some(_) => scenario.robot.tool_frame,
        None => ToolFrame::Tool0,
    };
    let name = arguments.frame.as_deref().unwrap_or(stated.name());
    let frame = frame(&arm, &scenario, name).map_err(Failure::input)?;
    let target = target(arguments).map_err(Failure::input)?;
    let seed = seed(arguments).map_err(Failure::input)?;
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
    let solver = IkSolver::new(&arm, frame, settings).map_err(Failure::input)?;
    let mut answer = answer(&solver, &target, &seed, name)?;
    answer.clearance = clearances(options, &scenario, &arm)?.all(&answer.q_rad);
    output::print_either(options.json, &answer, || text(&answer, &arm))?;
    let outcome = if answer.solved {
        Outcome::Good
    } else {
        Outcome::Infeasible
    };
    Ok(outcome.answer())
}

fn answer(solver: &IkSolver<'_>, target: &Pose, seed: &JointVector, name: &str) -> Result<Answer, Failure> {
    let mut answer = Answer {
        solved: false,
        frame: name.to_owned(),
        target: target.into(),
        q_rad: *seed,
        q_deg: *seed,
        iterations: 0,
        position_error_m: 0.0,
        orientation_error_rad: 0.0,
        orientation_error_deg: 0.0,
        method: None,
        start: None,
        clearance: Vec::new(),
        cause: None,
    };
    match solver.solve(target, seed) {
        Ok(s) => {
            (answer.solved, answer.method, answer.start) = (true, Some(s.method), Some(s.start));
            (answer.q_rad, answer.iterations) = (s.q, s.iterations);
            (answer.position_error_m, answer.orientation_error_rad) = (s.position_error_m, s.orientation_error_rad);
        }
        Err(IkError::NotSolved(f)) => {
            answer.cause = Some(f.cause);
            (answer.q_rad, answer.iterations) = (f.q, f.iterations);
            (answer.position_error_m, answer.orientation_error_rad) = (f.position_error_m, f.orientation_error_rad);
        }
        Err(other) => return Err(Failure::input(other)),
    }
    answer.q_deg = answer.q_rad.map(f64::to_degrees);
    answer.orientation_error_deg = answer.orientation_error_rad.to_degrees();
    Ok(answer)
}

fn text(answer: &Answer, arm: &RobotModel) -> String {
    let head = match answer.cause {
        None => format!("solved for {} of {}", answer.frame, arm.name()),
        Some(cause) => format!(
            "NOT solved for {} of {}: {cause}; best configuration found:",
            answer.frame,
            arm.name()
        ),
    };
    let how = match (answer.method, answer.start) {
        (Some(method), Some(start)) => format!(", by {method:?} from {start:?}").to_lowercase(),
        _ => String::new(),
    };
    format!(
        "{head}\n{}{}error {:.3e} m, {:.3e} rad ({:.3e}°); {} iterations{how}\n",
        both_units(&answer.q_rad),
        smallest(&answer.clearance),
        answer.position_error_m,
        answer.orientation_error_rad,
        answer.orientation_error_deg,
        answer.iterations
    )
}

fn frame(arm: &RobotModel, scenario: &Scenario, name: &str) -> anyhow::Result<Frame> {
    match ToolFrame::ALL.into_iter().find(|f| f.name() == name) {
        Some(known) => Ok(arm.tool_frame(known)?),
        None if name == "tip" => Ok(scenario.tool_on(arm)?.tip_frame(arm)),
        None => Ok(arm.frame(name)?),
    }
}

fn target(arguments: &IkArguments) -> anyhow::Result<Pose> {
    let position: [f64; 3] = finite(&arguments.position).context("--position")?;
    let Orientation {
        rpy_deg,
        rpy_rad,
        quaternion,
    } = &arguments.orientation;
    let rotation = match (rpy_deg, rpy_rad, quaternion) {
        (Some(rpy), ..) => from_rpy(finite::<3>(rpy).context("--rpy-deg")?.map(f64::to_radians)),
        (_, Some(rpy), _) => from_rpy(finite(rpy).context("--rpy-rad")?),
        (.., Some(wxyz)) => {
            let [w, x, y, z] = finite(wxyz).context("--quaternion")?;
            let quaternion = Quaternion::new(w, x, y, z);
            let unit = UnitQuaternion::try_new(quaternion, 1e-9);
            *unit
                .ok_or_else(|| anyhow!("--quaternion must not be zero"))?
                .to_rotation_matrix()
                .matrix()
        }
        (None, None, None) => return Err(anyhow!("give --rpy-deg, --rpy-rad or --quaternion")),
    };
    let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rotation));
    Ok(Pose::from_parts(nalgebra::Vector3::from(position).into(), rotation))
}

/// Largest number of a pose that is taken, either way \[m, rad, °\].
const MOST: f64 = 36_000.0;

fn finite<const N: usize>(values: &[f64]) -> anyhow::Result<[f64; N]> {
    let array = <[f64; N]>::try_from(values).map_err(|_| anyhow!("{N} numbers are needed; found {}", values.len()))?;
    match array.iter().find(|v| !(0.0..=MOST).contains(&v.abs())) {
        Some(found) => Err(anyhow!("numbers must be from -{MOST} to {MOST}; found {found:?}")),
        None => Ok(array),
    }
}

fn seed(arguments: &IkArguments) -> anyhow::Result<JointVector> {
    match (&arguments.seed_deg, &arguments.seed_rad) {
        (Some(values), _) => joints(values, Unit::Degrees).context("--seed-deg"),
        (None, Some(values)) => joints(values, Unit::Radians).context("--seed-rad"),
        (None, None) => Ok(JointVector::zeros()),
    }
}
