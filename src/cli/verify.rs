//! `platewash verify`: the certificate of a plan file.

use super::exit::Outcome;
use super::failure::{ExitCode, Failure};
use super::options::Options;
use super::plan_file::PlanFile;
use super::{output, run};
use clap::Args;
use platewash::planner::certificate::{self, CertificateVerdict};
use platewash::planner::scenario::Program;
use std::path::PathBuf;

/// Arguments of `verify`.
#[derive(Debug, Args)]
pub struct VerifyArguments {
    /// The plan file
    #[arg(value_name = "PLAN")]
    pub plan: PathBuf,
    /// Name every pair of bodies, not the ten tightest alone
    #[arg(long)]
    pub all_pairs: bool,
}

/// Judges a plan file for the arm that it names: the built-in one, or that of `--urdf`.
pub fn run(options: &Options, arguments: &VerifyArguments) -> Result<ExitCode, Failure> {
    let file = PlanFile::read(options, &arguments.plan)?;
    let certificate = certificate::verify(&file.plan, &file.robot).map_err(|e| file.refused(e))?;
    output::print_either(options.json, &certificate, || {
        let table = certificate.table(run::pairs(arguments.all_pairs));
        match file.plan.scenario.job.program {
            Program::Certified => table.to_string(),
            Program::Paper => {
                format!("NOT CERTIFIED: the paper's program has no certificate; of what one says:\n{table}")
            }
        }
    })?;
    let outcome = match certificate.verdict {
        CertificateVerdict::Pass => Outcome::Good,
        CertificateVerdict::Fail => Outcome::NotVerified,
    };
    Ok(outcome.answer())
}
