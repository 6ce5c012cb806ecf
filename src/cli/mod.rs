//! The command: arguments in, one file a verb, exit codes out.
//!
//! Exit codes: 0 done, 1 internal error, 2 bad usage or input, 3 infeasible, 4 verification failed.

mod angles;
mod cycle;
mod exit;
mod failure;
mod fk;
mod ik;
mod layout;
mod options;
mod output;
mod plan;
mod plan_file;
mod progress;
mod reproduce;
mod results;
mod robot;
mod run;
mod simulate;
mod sweep;
mod time_step;
mod tune;
mod validate;
mod verify;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use failure::{ExitCode, Failure};
use options::Options;
use std::ffi::OsString;
use std::io::{ErrorKind, Write};

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
    ///
    /// Owns plan.json, trajectory.csv, executed.csv, certificate.json, report.json, report.txt and the files of simulate in the
    /// output folder: those that it does not write are removed. A job that cannot be done leaves report.json and report.txt, which say why.
    Run(run::RunArguments),
    /// Place the plates of a scenario and say what is wrong with them.
    Layout,
    /// Plan a scenario and write the plan file and its CSV.
    ///
    /// Owns the files of run in the output folder: those that it does not write are removed. A job that cannot be done leaves
    /// report.json and report.txt, which say why.
    Plan(plan::PlanArguments),
    /// Check a scenario without running it.
    Validate,
    /// Judge a plan file: what is proved about it, and what is not.
    ///
    /// Exit code 0 where it is certified, 4 where it is not. What the scenario waives (layout.overlap = "report") is no failure, so that the
    /// code is 0: the first line then says CERTIFIED BUT FOR and what, and JSON lists it as `exempt`.
    Verify(verify::VerifyArguments),
    /// Simulate a plan file under a control law: tracking, torque, and what is really washed.
    ///
    /// Writes simulated.csv, simulation.json and simulation.txt to the output folder, and touches no other file there; the next run
    /// or plan into that folder removes them.
    Simulate(simulate::SimulateArguments),
    /// Simulate a plan file at many frequencies and dampings of a control law.
    Tune(tune::TuneArguments),
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

/// Does what the arguments ask, the command's own name first, as the `platewash` program does: results on standard output,
/// messages on standard error. The answer is the exit code.
///
/// It may be called more than once in a process; of the settings for messages the first ones count. A panic is caught
/// and is exit code 1.
pub fn main(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let outcome = std::panic::catch_unwind(|| {
        let parsed = Arguments::command()
            .try_get_matches_from(arguments)
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
    // A caller that is no Rust program does not flush; a reader that has gone away is no error.
    let _ = std::io::stdout().flush();
    let ExitCode(code) = match outcome {
        Ok(Ok(code)) => code,
        Ok(Err(failure)) => failure.report(),
        // The panic's own message is on standard error already.
        Err(_) => ExitCode::from(failure::INTERNAL),
    };
    code
}

fn dispatch(arguments: Arguments) -> Result<ExitCode, Failure> {
    let options = arguments.options;
    let verb = arguments.verb.unwrap_or(Verb::Run(run::RunArguments::default()));
    options.set_up()?.install(|| carry_out(&options, verb))
}

fn carry_out(options: &Options, verb: Verb) -> Result<ExitCode, Failure> {
    match verb {
        Verb::Run(arguments) => run::run(options, &arguments),
        Verb::Layout => layout::run(options),
        Verb::Plan(arguments) => plan::run(options, &arguments),
        Verb::Validate => validate::run(options),
        Verb::Verify(arguments) => verify::run(options, &arguments),
        Verb::Simulate(arguments) => simulate::run(options, &arguments),
        Verb::Tune(arguments) => tune::run(options, &arguments),
        Verb::Fk(arguments) => fk::run(options, &arguments),
        Verb::Ik(arguments) => ik::run(options, &arguments),
        Verb::Robot => robot::run(options),
        Verb::Sweep(arguments) => sweep::run(options, &arguments),
        Verb::Reproduce(arguments) => reproduce::run(options, &arguments),
    }
}
