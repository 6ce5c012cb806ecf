//! `platewash prove-motion`: a trajectory of any planner, proved over its whole time.

use super::failure::ExitCode;
use super::numbers::within;
use super::options::{Options, installed_files};
use super::output::DetailArguments;
use anyhow::{Context, Result, anyhow, bail};
use clap::{Args, ValueEnum};
use platewash::certificate::ProveError;
use platewash::export::trajectory::{self, TrajectoryFile};
use platewash::kinematics::AXES;
use platewash::kinematics::urdf::file::read_text;
use platewash::scenario::{Note, ObstacleText, load_arm};
use platewash::{Failure, JointVector, prove_motion};
use std::path::PathBuf;

/// Longest trajectory that is read \[bytes\].
const MAX_BYTES: u64 = 256 << 20;

/// Arguments of `prove-motion`.
#[derive(Debug, Args)]
pub struct ProveMotionArguments {
    /// Trajectory: a table (.csv), or a ROS message JointTrajectory, RobotTrajectory or FollowJointTrajectory goal (.yaml, .json)
    trajectory: PathBuf,
    /// TOML file with the obstacles: sections [[obstacle]], [floor] and [table] as in a scenario [default: none, and no floor]
    #[arg(long, value_name = "FILE")]
    obstacles: Option<PathBuf>,
    /// Clearance that every pair of bodies must keep [m], from 0 to 1; with 0 they must not touch
    #[arg(long, value_name = "M", default_value = "0.005", value_parser = clearance, allow_negative_numbers = true)]
    clearance: f64,
    /// Motion between two points [default: quintic where the points have speeds and accelerations, cubic where they have speeds, otherwise
    /// linear]
    #[arg(long, value_enum)]
    interpolation: Option<Interpolation>,
    /// Greatest joint accelerations [rad/s²]: one number, or six between commas [default: not judged]
    #[arg(long, value_name = "A,…", value_parser = accelerations, allow_negative_numbers = true)]
    acceleration_limits: Option<[f64; AXES]>,
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

/// Judges a trajectory of an arm among obstacles.
pub fn run(options: &Options, arguments: &ProveMotionArguments) -> Result<ExitCode> {
    let arm = load_arm(&options.robot_section(), &installed_files()).map_err(Failure::from)?;
    options.warn(&Note::of_arm(&arm));
    let obstacles = match &arguments.obstacles {
        Some(file) => ObstacleText::load(file)
            .map_err(Failure::from)?
            .obstacles(&arm, &options.package_path)?,
        None => Vec::new(),
    };
    let path = &arguments.trajectory;
    let name = path.display().to_string();
    let text = read_text(path, MAX_BYTES).with_context(|| format!("{name}: cannot be read"))?;
    let file = TrajectoryFile::read(&name, text, &arm)?;
    let choice = arguments.interpolation.map(|choice| match choice {
        Interpolation::Linear => trajectory::Interpolation::Linear,
        Interpolation::Cubic => trajectory::Interpolation::Cubic,
        Interpolation::Quintic => trajectory::Interpolation::Quintic,
    });
    let motion = file.motion(&arm, choice)?;
    let limits = arguments.acceleration_limits.map(JointVector::from);
    if limits.is_some() && motion.start_s.is_none() {
        bail!("--acceleration-limits: {name} has no times, so nothing is known of accelerations; leave it out");
    }
    let proved = options.during("proving the motion", || {
        prove_motion(&motion, &arm, obstacles, arguments.clearance, limits, &options.cancel)
    });
    let report = proved.map_err(|error| match error {
        ProveError::Cancelled(cancelled) => cancelled.into(),
        other => anyhow!(other).context(name),
    })?;
    options.print(&report, || arguments.details.printed(&report))?;
    Ok(ExitCode::NotVerified.unless(report.proved))
}
