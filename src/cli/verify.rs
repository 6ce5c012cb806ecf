//! `platewash verify`: the certificate of a plan file.

use super::failure::{self, ExitCode, Failure};
use super::options::Options;
use super::output;
use super::plan_file::PlanFile;
use clap::Args;
use platewash::planner::certificate::{self, CertificateVerdict};
use std::path::PathBuf;

/// Arguments of `verify`.
#[derive(Debug, Args)]
pub struct VerifyArguments {
    /// The plan file
    #[arg(value_name = "PLAN")]
    pub plan: PathBuf,
}

/// Judges a plan file for the arm that it names: the built-in one, or that of `--urdf`.
pub fn run(options: &Options, arguments: &VerifyArguments) -> Result<ExitCode, Failure> {
    let file = PlanFile::read(options, &arguments.plan)?;
    let certificate = certificate::verify(&file.plan, &file.robot).map_err(|e| file.refused(e))?;
    output::print_either(options.json, &certificate, || certificate.to_string())?;
    Ok(match certificate.verdict {
        CertificateVerdict::Pass => ExitCode::SUCCESS,
        CertificateVerdict::Fail => ExitCode::from(failure::NOT_VERIFIED),
    })
}
