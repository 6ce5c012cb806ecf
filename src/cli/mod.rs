//! The command: arguments in, one file a verb, exit codes out.
//!
//! Exit codes: 0 done, 1 internal error, 2 bad usage or input, 3 infeasible, 4 verification failed, 130 interrupted.

mod align;
pub mod alignment;
mod compare;
mod description;
mod dry_run;
mod edit;
mod export;
mod failure;
mod files;
mod fk;
mod frame_pose;
mod infeasible;
mod input_file;
mod motion;
mod numbers;
mod options;
mod output;
mod page;
mod plan_file;
mod prove_motion;
mod recover;
mod reproduce;
mod robot;
mod run;
mod scenario;
mod simulate;
mod study;
mod sweep;
mod terminal;
mod verify;
mod view;

use anyhow::{Error, Result};
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
pub use description::installed_files;
use failure::ExitCode;
use options::Options;
use platewash::CancelToken;
use std::ffi::OsString;
use std::io::{ErrorKind, Write};
use std::panic::UnwindSafe;

/// Plan, prove, simulate, show and export the washing of plates by a six-axis arm.
///
/// Without a command, the scenario "kitchen" is planned, proved and simulated. Results go to standard output, messages and progress to
/// standard error.
#[derive(Debug, Parser)]
#[command(
    name = "platewash",
    version,
    after_help = "Exit codes: 0 done, 1 internal error, 2 wrong usage or input, 3 no plan found, 4 not proved or not washed, 130 interrupted."
)]
struct Arguments {
    #[command(flatten)]
    options: Options,
    #[command(subcommand)]
    verb: Option<Verb>,
}

#[derive(Debug, Subcommand)]
enum Verb {
    /// Plan, prove and simulate a scenario (the default)
    ///
    /// Writes plan.json, trajectory.csv (planned motion), executed.csv (simulated motion), certificate.json, report.json, report.txt
    /// and page.html to the output folder, and removes files of earlier runs there. If the job cannot be done, report.json and
    /// report.txt say why.
    Run(run::RunArguments),
    /// Place the plates of a scenario and list what is wrong with the layout
    Layout,
    /// Plan a scenario without proving it; write the plan file and its CSV
    ///
    /// Removes files of earlier runs from the output folder. If the job cannot be done, report.json and report.txt say why.
    Plan(motion::MotionArguments),
    /// Check a scenario file without planning it
    Validate,
    /// Print a shipped scenario, as a start for your own: platewash scenario kitchen > mine.toml
    Scenario(scenario::ScenarioArguments),
    /// Prove a plan file, and compare it with a scenario or a robot program
    ///
    /// Exit code 0 if all requirements of the plan's own job are proved, else 4. A requirement that is waived by the job
    /// (layout.overlap = "report") does not count: the first line then says PROVED BUT FOR and names it.
    ///
    /// The proof is about the job in the plan file. --against checks that this job is the one of a scenario: exit code 4 if a field
    /// differs, and the first line begins with OTHER JOB.
    ///
    /// --program judges an exported robot program, changed or not: exit code 0 if its motion keeps the requirements that the answer lists,
    /// else 4.
    Verify(verify::VerifyArguments),
    /// Prove a trajectory of any planner: joint limits, and clearance of every pair of bodies at every moment
    ///
    /// The arm is that of --urdf (default: the IRB 120), with the links of its description and the tool of --tool; the obstacles are those of
    /// --obstacles. Joints are matched by name; --fix holds others still.
    ///
    /// Exit code 0 if the motion is proved, else 4: broken at a stated moment, or not proved. Without times in the trajectory, positions
    /// and clearance are proved for any timing of straight lines. docs/prove-motion.md has the formats and the assumptions.
    ProveMotion(prove_motion::ProveMotionArguments),
    /// Compare two plan files: job, cycle time and proved bounds
    ///
    /// Both plans are proved. The exit code is 0 whatever differs; the first lines say what is proved.
    Compare(compare::CompareArguments),
    /// Plan and prove a slow motion above the plates, to try on the real arm first
    ///
    /// The plan is proved first. Then its plates are raised, the real plates become obstacles, and the same paths are planned and proved
    /// in the same order. Writes plan.json, certificate.json, report.json and report.txt to the folder dry-run in the output folder.
    /// Exit code 3 if no motion was found at that height (the message names a height that works, if one was found), 4 if a plan is not
    /// proved.
    DryRun(dry_run::DryRunArguments),
    /// After a stop: a proved motion from where the arm stands home, and a proved plan of the plates that are left
    ///
    /// The sponge leaves the plate that it is at slowly, along the plate's normal; then the arm goes home, clear of everything. The plates
    /// whose wash had not ended are planned again, in the same order and along the same paths. Writes home.json, rest.json, their
    /// certificates, report.json and report.txt to the folder recovery in the output folder. Exit code 3 if bodies touch where the arm
    /// stands, or no way was found (the message names the bodies), 4 if a plan is not proved.
    Recover(recover::RecoverArguments),
    /// Find where the arm stands at a table, from points touched with its tip
    ///
    /// Prints the mount, the residual of each point, and points of the drawing in the frames of arm and pendant. Exit code 4 if a residual
    /// exceeds the tolerance.
    ///
    /// The pendant counts from the controller's base, which in many descriptions lies apart from the root link. With --urdf, --arm or
    /// --scenario the mount is that of the root link; without, that of the controller's base, as the printed key mount_link says.
    Align(align::AlignArguments),
    /// Simulate a plan file under a control law: tracking, torque, and what is washed
    ///
    /// Writes simulated.csv, simulation.json and simulation.txt to the output folder. The next run or plan into that folder removes
    /// them.
    Simulate(simulate::SimulateArguments),
    /// Show a plan file in 3-D, on a page in the browser
    ///
    /// Proves and simulates the plan, serves the page on this machine and prints its address. Ctrl-C ends it.
    View(view::ViewArguments),
    /// Change a scenario on a page in the browser; each change is planned and proved at once
    ///
    /// Drag plates, or change keys in a form or as text. Save writes the scenario (comments and order kept) and beside it NAME.plan.json,
    /// NAME.certificate.json, NAME.report.json, NAME.report.txt and NAME.page.html. Ctrl-C ends it.
    Edit(edit::EditArguments),
    /// Draw a plan file as SVG: the workcell from above, joints, coverage and spirals
    Figures(view::FiguresArguments),
    /// Export a plan file as a robot program: rapid, ros2, urscript or csv
    ///
    /// The plan is proved first. The program is read back, and its path, joint speeds, clearance, tilt and sweep are proved again; it is
    /// written only if that succeeds, else the exit code is 4. Pressing, landing and accelerations are proved for the plan alone. The files go to the folder of --out, or to out/TARGET.
    Export(export::ExportArguments),
    /// Simulate a plan file at many frequencies and damping ratios of a control law
    Tune(simulate::TuneArguments),
    /// Forward kinematics of one or many configurations, with clearances
    Fk(fk::FkArguments),
    /// Inverse kinematics of one pose
    Ik(fk::IkArguments),
    /// Show the arm: joints, limits, frames and the pairs checked for clearance
    ///
    /// --suggest finds, for the scenario's tool and plates: a home position, where plates can be washed (region.svg), and the
    /// pairs of links that need no check, with reasons (touching.srdf).
    Robot(robot::RobotArguments),
    /// Plan and prove a scenario with many seeds
    Sweep(sweep::SweepArguments),
    /// Plan and prove thousands of scenarios from a study file, and resume after a stop
    Study(study::StudyArguments),
    /// Measure again what the paper's program does
    Reproduce(reproduce::ReproduceArguments),
}

/// Does what the arguments ask, the command's own name first, as the `platewash` program does: results on standard output,
/// messages on standard error. The answer is the exit code. Ctrl-C is left to the caller.
///
/// It may be called more than once in a process; of the settings for messages the first ones count. A panic is caught
/// and is exit code 1.
pub fn main(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    main_until(arguments, &CancelToken::new())
}

/// As [`main`], until `cancel` says to give up: long work ends with exit code 130, and `view` and `edit` as at Ctrl-C.
pub fn main_until(arguments: impl IntoIterator<Item = OsString>, cancel: &CancelToken) -> u8 {
    answer(arguments, || cancel.clone())
}

/// The `platewash` program: [`main`], and Ctrl-C tells long work to give up (exit code 130). A second one ends the process at once.
pub fn program(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    answer(arguments, || {
        let token = CancelToken::new();
        heed_signals(&token);
        token
    })
}

/// From now on Ctrl-C and SIGTERM cancel the token. For the program alone: there is one handler a process, and in a library it is the
/// caller's. Where none can be set, the system ends the program at the first Ctrl-C; one that was started to ignore it, in the background of
/// a shell or by nohup, keeps ignoring it.
fn heed_signals(token: &CancelToken) {
    let given_up = token.clone();
    let _ = ctrlc::try_set_handler(move || give_up(&given_up));
    #[cfg(unix)]
    if let Ok(mut signals) = signal_hook::iterator::Signals::new([signal_hook::consts::SIGTERM]) {
        let token = token.clone();
        std::thread::spawn(move || signals.forever().for_each(|_| give_up(&token)));
    }
}

/// Cancels the token; where it is cancelled already, ends the process.
fn give_up(token: &CancelToken) {
    if token.is_cancelled() {
        std::process::exit(ExitCode::Interrupted as i32);
    }
    token.cancel();
}

/// Does what the arguments ask; `token` makes what tells long work to give up.
fn answer(arguments: impl IntoIterator<Item = OsString>, token: impl FnOnce() -> CancelToken + UnwindSafe) -> u8 {
    let arguments: Vec<OsString> = arguments.into_iter().map(without_exponent).collect();
    let outcome = std::panic::catch_unwind(|| match parsed(arguments) {
        Ok((arguments, taken)) => taken
            .and_then(|()| dispatch(arguments, token))
            .map_or_else(|error| failure::report(&error) as u8, |code| code as u8),
        Err(refused) => report_arguments(refused),
    });
    // A caller that is no Rust program does not flush; a reader that has gone away is no error.
    let _ = std::io::stdout().flush();
    // The panic's own message is on standard error already.
    outcome.unwrap_or(ExitCode::Internal as u8)
}

/// The arguments, and why they are refused, where one is of another verb.
fn parsed(arguments: Vec<OsString>) -> Result<(Arguments, Result<()>), clap::Error> {
    let matches = options::hide(Arguments::command()).try_get_matches_from(arguments)?;
    Ok((Arguments::from_arg_matches(&matches)?, options::refuse(&matches)))
}

/// Prints what is wrong with the arguments, or the help that was asked for; the exit code.
fn report_arguments(refused: clap::Error) -> u8 {
    let code = u8::try_from(refused.exit_code()).unwrap_or(ExitCode::Input as u8);
    match options::with_tip(refused).print() {
        // A closed pipe is no reason to fail; help that cannot be written is.
        Err(cannot) if code == 0 && cannot.kind() != ErrorKind::BrokenPipe => {
            failure::report(&Error::new(cannot)) as u8
        }
        _ => code,
    }
}

/// A negative number without its exponent, as clap takes `-1e-9` for an option; every other argument as it is.
fn without_exponent(argument: OsString) -> OsString {
    let text = argument
        .to_str()
        .filter(|text| text.starts_with('-') && text.contains(['e', 'E']));
    match text
        .and_then(|text| text.parse().ok())
        .filter(|number: &f64| number.is_finite())
    {
        Some(number) => number.to_string().into(),
        None => argument,
    }
}

fn dispatch(arguments: Arguments, token: impl FnOnce() -> CancelToken) -> Result<ExitCode> {
    let mut options = arguments.options;
    let verb = arguments.verb.unwrap_or(Verb::Run(run::RunArguments::default()));
    if !verb.is_soon_done() {
        options.cancel = token();
    }
    options.find_description()?;
    options
        .set_up()?
        .install(|| carry_out(&options, verb))
        .map_err(|error| options.in_file(error))
}

impl Verb {
    /// True where the verb ends soon and does not check the cancel token: a signal ends the process.
    fn is_soon_done(&self) -> bool {
        match self {
            Self::Robot(arguments) => !arguments.suggest,
            Self::Layout | Self::Validate | Self::Scenario(_) | Self::Align(_) | Self::Fk(_) | Self::Ik(_) => true,
            _ => false,
        }
    }
}

fn carry_out(options: &Options, verb: Verb) -> Result<ExitCode> {
    match verb {
        Verb::Run(arguments) => run::run(options, &arguments),
        Verb::Layout => scenario::layout(options),
        Verb::Plan(arguments) => run::plan(options, &arguments),
        Verb::Validate => scenario::validate(options),
        Verb::Scenario(arguments) => scenario::show(options, &arguments),
        Verb::Verify(arguments) => verify::run(options, &arguments),
        Verb::ProveMotion(arguments) => prove_motion::run(options, &arguments),
        Verb::Compare(arguments) => compare::run(options, &arguments),
        Verb::DryRun(arguments) => dry_run::run(options, &arguments),
        Verb::Recover(arguments) => recover::run(options, &arguments),
        Verb::Align(arguments) => align::run(options, &arguments),
        Verb::Simulate(arguments) => simulate::simulate(options, &arguments),
        Verb::View(arguments) => view::view(options, &arguments),
        Verb::Edit(arguments) => edit::run(options, &arguments),
        Verb::Export(arguments) => export::run(options, &arguments),
        Verb::Tune(arguments) => simulate::tune(options, &arguments),
        Verb::Figures(arguments) => view::figures(options, &arguments),
        Verb::Fk(arguments) => fk::fk(options, &arguments),
        Verb::Ik(arguments) => fk::ik(options, &arguments),
        Verb::Robot(arguments) => robot::run(options, &arguments),
        Verb::Sweep(arguments) => sweep::run(options, &arguments),
        Verb::Study(arguments) => study::run(options, &arguments),
        Verb::Reproduce(arguments) => reproduce::run(options, &arguments),
    }
}
