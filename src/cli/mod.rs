//! The command: arguments in, one file a verb, exit codes out.
//!
//! Exit codes: 0 done, 1 internal error, 2 bad usage or input, 3 infeasible, 4 verification failed.

mod angles;
mod cycle;
mod failure;
mod fk;
mod ik;
mod layout;
mod options;
mod output;
mod plan;
mod progress;
mod reproduce;
mod robot;
mod run;
mod sweep;
mod validate;
mod verify;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use failure::Failure;
use options::Options;
use std::io::ErrorKind;
use std::process::ExitCode;

/// Plan, check and report the washing of plates by a six-axis arm.
///
/// Without a verb the default scenario is run to the end. Messages and progress go to standard error, results to
/// standard output.
#[derive(Debug, Parser)]
#[command(
    name = "platewash",
    version,
    after_help = "Exit codes: 0 done, 1 internal error, 2 bad usage or input, 3 infeasible, 4 verification failed."
)]
struct Arguments {
    #[command(flatten)]
    options: Options,
    #[command(subcommand)]
    verb: Option<Verb>,
}

#[derive(Debug, Subcommand)]
enum Verb {
    /// Run a scenario to the end: plan, CSV and report (the default).
    Run(run::RunArguments),
    /// Place the plates of a scenario and say what is wrong with them.
    Layout,
    /// Plan a scenario and write the plan file and its CSV.
    Plan(plan::PlanArguments),
    /// Check a scenario without running it.
    Validate,
    /// Judge a plan file: what is proved about it, and what is not.
    Verify(verify::VerifyArguments),
    /// Forward kinematics of one or many configurations, with clearances.
    Fk(fk::FkArguments),
    /// Inverse kinematics of one pose.
    Ik(ik::IkArguments),
    /// Show the arm: joints, limits, frames and the pairs checked for clearance.
    Robot,
    /// Plan and prove many layouts of a scenario, one a seed.
    Sweep(sweep::SweepArguments),
    /// Re-measure what the paper's program really does.
    Reproduce(reproduce::ReproduceArguments),
}

/// Parses the arguments, does what they ask, and maps what went wrong to an exit code.
pub fn main() -> ExitCode {
    let outcome = std::panic::catch_unwind(|| {
        let parsed = Arguments::command()
            .try_get_matches()
            .and_then(|m| Arguments::from_arg_matches(&m));
        match parsed {
            Ok(arguments) => dispatch(arguments),
            Err(e) => {
                let code = u8::try_from(e.exit_code()).unwrap_or(failure::INPUT);
                match e.print() {
                    // A closed pipe is no reason to fail; help that cannot be written is.
                    Err(cannot) if code == 0 && cannot.kind() != ErrorKind::BrokenPipe => {
                        Err(Failure::internal(cannot))
                    }
                    _ => Ok(ExitCode::from(code)),
                }
            }
        }
    });
    match outcome {
        Ok(Ok(code)) => code,
        Ok(Err(failure)) => failure.report(),
        // The panic's own message is on standard error already.
        Err(_) => ExitCode::from(failure::INTERNAL),
    }
}

fn dispatch(arguments: Arguments) -> Result<ExitCode, Failure> {
    let options = arguments.options;
    options.set_up()?;
    match arguments.verb.unwrap_or(Verb::Run(run::RunArguments::default())) {
        Verb::Run(arguments) => run::run(&options, &arguments),
        Verb::Layout => layout::run(&options),
        Verb::Plan(arguments) => plan::run(&options, &arguments),
        Verb::Validate => validate::run(&options),
        Verb::Verify(arguments) => verify::run(&options, &arguments),
        Verb::Fk(arguments) => fk::run(&options, &arguments),
        Verb::Ik(arguments) => ik::run(&options, &arguments),
        Verb::Robot => robot::run(&options),
        Verb::Sweep(arguments) => sweep::run(&options, &arguments),
        Verb::Reproduce(arguments) => reproduce::run(&options, &arguments),
    }
}
