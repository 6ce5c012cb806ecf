//! Plan files as input of `verify`, `simulate` and `tune`, with the arm that they are for.

use super::failure::Failure;
use super::options::Options;
use anyhow::anyhow;
use platewash::kinematics::urdf::file;
use platewash::planner::certificate::{self, VerifyError};
use platewash::planner::scenario::{RobotSection, UnitNote};
use platewash::{Plan, RobotModel};
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// Longest plan file that is read \[bytes\]: some million knots.
const MAX_BYTES: u64 = 1 << 28;

/// A plan that was read from a file.
#[derive(Debug)]
pub struct PlanFile {
    path: PathBuf,
    /// The plan.
    pub plan: Plan,
    /// The arm that it names: the built-in one, or that of `--urdf`.
    pub robot: RobotModel,
}

impl PlanFile {
    /// Reads a plan and finds its arm.
    pub fn read(options: &Options, path: &Path) -> Result<Self, Failure> {
        options.refuse_scenario_and_seed()?;
        let text = file::read_text(path, MAX_BYTES).map_err(|e| refused(path, format_args!("cannot be read: {e}")))?;
        let plan = Plan::from_json(&text).map_err(|e| refused(path, e))?;
        let given = options.urdf.as_ref().map(|urdf| RobotSection {
            urdf: Some(urdf.clone()),
            srdf: options.srdf.clone(),
            package_path: options.package_path.clone(),
            ..plan.scenario.robot.clone()
        });
        let robot = certificate::arm(&plan, given.as_ref()).map_err(|error| match error {
            VerifyError::NoDescription { file } => refused(
                path,
                format_args!("the plan is for the arm of \"{file}\": give that description as --urdf FILE"),
            ),
            other => refused(path, other),
        })?;
        options.warn(&plan.scenario.notes());
        options.warn(UnitNote::of_arm(&robot).as_slice());
        let path = path.to_owned();
        Ok(Self { path, plan, robot })
    }

    /// Something in the file that cannot be used.
    pub fn refused(&self, error: impl Display) -> Failure {
        refused(&self.path, error)
    }
}

fn refused(path: &Path, error: impl Display) -> Failure {
    Failure::input(anyhow!("{}: {error}", path.display()))
}
