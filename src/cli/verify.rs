//! `platewash verify`: the certificate of a plan file.

use super::failure::{self, ExitCode, Failure};
use super::options::Options;
use super::output;
use anyhow::anyhow;
use clap::Args;
use platewash::Plan;
use platewash::kinematics::urdf::file;
use platewash::planner::certificate::{self, CertificateVerdict};
use platewash::planner::scenario::RobotSection;
use std::path::PathBuf;

/// Longest plan file that is read \[bytes\]: some million knots.
const MAX_BYTES: u64 = 1 << 28;

/// Arguments of `verify`.
#[derive(Debug, Args)]
pub struct VerifyArguments {
    /// The plan file
    #[arg(value_name = "PLAN")]
    pub plan: PathBuf,
}

/// Judges a plan file for the arm that it names: the built-in one, or that of `--urdf`.
pub fn run(options: &Options, arguments: &VerifyArguments) -> Result<ExitCode, Failure> {
    let name = arguments.plan.display();
    let text = file::read_text(&arguments.plan, MAX_BYTES)
        .map_err(|e| Failure::input(anyhow!("{name}: cannot be read: {e}")))?;
    let refused = |error: &dyn std::fmt::Display| Failure::input(anyhow!("{name}: {error}"));
    let plan = Plan::from_json(&text).map_err(|e| refused(&e))?;
    let given = options.urdf.as_ref().map(|urdf| RobotSection {
        urdf: Some(urdf.clone()),
        srdf: options.srdf.clone(),
        package_path: options.package_path.clone(),
        ..plan.scenario.robot.clone()
    });
    let robot = certificate::arm(&plan, given.as_ref()).map_err(|e| refused(&e))?;
    let certificate = certificate::verify(&plan, &robot).map_err(|e| refused(&e))?;
    output::print_either(options.json, &certificate, || certificate.to_string())?;
    Ok(match certificate.verdict {
        CertificateVerdict::Pass => ExitCode::SUCCESS,
        CertificateVerdict::Fail => ExitCode::from(failure::NOT_VERIFIED),
    })
}
