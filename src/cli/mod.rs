//! The command: arguments in, one file a verb, exit codes out.
//!
//! Exit codes: 0 done, 1 internal error, 2 bad usage or input, 3 infeasible, 4 verification failed, 130 interrupted.

mod against;
mod align;
mod angles;
mod bundle;
mod compare;
mod dry_run;
mod edit;
mod execution;
mod exit;
mod export;
mod failure;
mod figures;
mod fk;
mod handed_over;
mod ik;
mod infeasible;
mod interrupt;
mod kept;
mod law;
mod layout;
mod live;
mod motion;
mod options;
mod output;
mod page;
mod pairs;
mod paper;
mod paper_claims;
mod parent;
mod plan;
mod plan_file;
mod progress;
mod refused;
mod region;
mod reproduce;
mod results;
mod robot;
mod run;
mod scenario;
mod serve;
mod simulate;
mod study;
mod study_text;
mod suggest;
mod sweep;
mod text;
mod time_step;
mod tips;
mod tune;
mod validate;
mod verify;
mod view;
mod wash;

use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};
use failure::{ExitCode, Failure};
use options::Options;
use platewash::CancelToken;
use std::ffi::OsString;
use std::io::{ErrorKind, Write};
use std::panic::UnwindSafe;

/// Plan, check and report the washing of plates by a six-axis arm.
///
/// Without a verb the default scenario is run to the end. Messages and progress go to standard error, results to
/// standard output.
#[derive(Debug, Parser)]
#[command(
    name = "platewash",
    version,
    after_help = "Exit codes: 0 done, 1 internal error, 2 bad usage or input, 3 infeasible, 4 verification failed, 130 interrupted."
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
    /// With --live the simulation runs in real time and is shown while it does; files and exit code are what they are without it.
    ///
    /// Owns plan.json, trajectory.csv, executed.csv, certificate.json, report.json, report.txt, page.html and the files of simulate in the
    /// output folder: those that it does not write are removed. A job that cannot be done leaves report.json and report.txt, which say why.
    Run(run::RunArguments),
    /// Place the plates of a scenario and say what is wrong with them.
    Layout,
    /// Plan a scenario and write the plan file and its CSV.
    ///
    /// Owns the files of run in the output folder: those that it does not write are removed. A job that cannot be done leaves
    /// report.json and report.txt, which say why.
    Plan(motion::MotionArguments),
    /// Check a scenario without running it.
    Validate,
    /// Print a shipped scenario, to start one's own from: platewash scenario kitchen > mine.toml
    Scenario(scenario::ScenarioArguments),
    /// Judge a plan file: what is proved about it, and what is not.
    ///
    /// Exit code 0 where it is certified, 4 where it is not. What the job waives (layout.overlap = "report") is no failure, so that the
    /// code is 0: the first line then says PROVED BUT FOR and what, and JSON lists it as `waived`.
    ///
    /// A certificate says that the plan does its own job. Whether that is the job of a scenario is for --against: exit code 4 where a
    /// field differs, and the first line begins with OTHER JOB.
    ///
    /// With --program it is the program of a controller that is judged: code 0 where what it does holds, changed or not, otherwise 4.
    Verify(verify::VerifyArguments),
    /// Compare two plan files: job, cycle time and proved margins.
    ///
    /// Both are proved. Exit code 0 whatever differs and whatever is proved; the first lines say what is.
    Compare(compare::CompareArguments),
    /// Plan and prove the motion of a plan in the air, slower: what to try on the arm first.
    ///
    /// The plan is proved; its plates are raised, the real ones stand below as obstacles, and the same paths are planned and proved in
    /// the same order. Writes plan.json, certificate.json, report.json and report.txt to the folder dry-run in the output folder. Exit
    /// code 3 where that height does not work, with one that was found to, and 4 where a plan is not proved.
    DryRun(dry_run::DryRunArguments),
    /// Find where the arm stands at a table, from points touched with its tip.
    ///
    /// Prints T_world_base with the residual of each point, and points of the drawing in the base frame. Exit code 4 where a residual is
    /// larger than the tolerance.
    Align(align::AlignArguments),
    /// Simulate a plan file under a control law: tracking, torque, and what is really washed.
    ///
    /// Writes simulated.csv, simulation.json and simulation.txt to the output folder, and touches no other file there; the next run
    /// or plan into that folder removes them.
    Simulate(simulate::SimulateArguments),
    /// Show a plan file in three dimensions, on a page in the browser.
    ///
    /// Proves it, simulates it as it states itself, serves the page on the loopback and prints its address. Ctrl-C ends it: exit code
    /// 0, or 130 where there is no page yet.
    View(view::ViewArguments),
    /// Change a scenario on a page in the browser, and see its plan and proof at once.
    ///
    /// Drag plates, change keys in a form or as text; each change is planned and proved by this command, which serves the page on the
    /// loopback and prints its address. Save writes the scenario, its comments and order kept, and beside it NAME.plan.json,
    /// NAME.certificate.json, NAME.report.json, NAME.report.txt and NAME.page.html (in the folder of --out, where given): it owns those
    /// names. Ctrl-C ends it: exit code 0, or 130 where there is no page yet.
    Edit(edit::EditArguments),
    /// Draw a plan file: the workcell from above, the arm while it washes and crosses over, joints, coverage, ideal and executed path,
    /// and what is claimed beside what is proved or measured.
    ///
    /// Each figure is written twice, NAME.svg and NAME.png, which show the same.
    Figures(figures::FiguresArguments),
    /// Write a plan file as a program for a robot's controller: rapid, ros2 and others.
    ///
    /// The plan is proved first. The program is then read back, its motion interpreted and judged again, and written only where that
    /// holds: exit code 4 where it does not. What is written goes to the folder of --out, or to out/TARGET.
    Export(export::ExportArguments),
    /// Simulate a plan file at many frequencies and dampings of a control law.
    Tune(tune::TuneArguments),
    /// Forward kinematics of one or many configurations, with clearances.
    Fk(fk::FkArguments),
    /// Inverse kinematics of one pose.
    Ik(ik::IkArguments),
    /// Show the arm: joints, limits, frames and the pairs checked for clearance.
    ///
    /// With --suggest, find what suits it with the scenario's tool and plates: a home with clearance, and where such plates can be washed, in
    /// numbers and as a picture (region.svg, region.png); and the pairs of links that need no check, as an SRDF that says why
    /// (touching.srdf).
    Robot(robot::RobotArguments),
    /// Plan and prove many layouts of a scenario, one a seed.
    Sweep(sweep::SweepArguments),
    /// Plan and prove scenarios by the thousand, as a study file states them, and keep every row as soon as it is done.
    Study(study::StudyArguments),
    /// Re-measure what the paper's program really does.
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
    answer(arguments, interrupt::token)
}

/// Does what the arguments ask; `token` makes what tells long work to give up.
fn answer(arguments: impl IntoIterator<Item = OsString>, token: impl FnOnce() -> CancelToken + UnwindSafe) -> u8 {
    let arguments: Vec<OsString> = arguments.into_iter().map(without_exponent).collect();
    let outcome = std::panic::catch_unwind(|| {
        let matches = refused::hide(Arguments::command()).try_get_matches_from(arguments);
        let parsed =
            matches.and_then(|matches| Ok((Arguments::from_arg_matches(&matches)?, refused::refuse(&matches))));
        match parsed {
            Ok((arguments, taken)) => taken.and_then(|()| dispatch(arguments, token)),
            Err(e) => {
                let code = u8::try_from(e.exit_code()).unwrap_or(failure::INPUT);
                match tips::with_tip(e).print() {
                    // A closed pipe is no reason to fail; help that cannot be written is.
                    Err(cannot) if code == 0 && cannot.kind() != ErrorKind::BrokenPipe => Err(Failure::input(cannot)),
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

/// A negative number without its exponent, as clap takes `-1e-9` for an option; every other argument as it is.
fn without_exponent(argument: OsString) -> OsString {
    let text = argument
        .to_str()
        .filter(|text| text.starts_with('-') && text.contains(['e', 'E']));
    match text
        .and_then(|text| text.parse::<f64>().ok())
        .filter(|number| number.is_finite())
    {
        Some(number) => number.to_string().into(),
        None => argument,
    }
}

fn dispatch(arguments: Arguments, token: impl FnOnce() -> CancelToken) -> Result<ExitCode, Failure> {
    let mut options = arguments.options;
    let verb = arguments.verb.unwrap_or(Verb::Run(run::RunArguments::default()));
    if verb.gives_up() {
        options.cancel = token();
    }
    options
        .set_up()?
        .install(|| carry_out(&options, verb))
        .map_err(|failure| options.in_file(failure))
}

impl Verb {
    /// Whether it looks at the token that tells it to give up; others are done soon, and the system ends them.
    fn gives_up(&self) -> bool {
        match self {
            Self::Run(_) | Self::Plan(_) | Self::Verify(_) | Self::Simulate(_) | Self::Tune(_) => true,
            Self::View(_)
            | Self::Edit(_)
            | Self::Export(_)
            | Self::Compare(_)
            | Self::DryRun(_)
            | Self::Figures(_)
            | Self::Sweep(_)
            | Self::Study(_)
            | Self::Reproduce(_) => true,
            Self::Robot(arguments) => arguments.suggest,
            Self::Layout | Self::Validate | Self::Scenario(_) | Self::Align(_) | Self::Fk(_) | Self::Ik(_) => false,
        }
    }
}

fn carry_out(options: &Options, verb: Verb) -> Result<ExitCode, Failure> {
    match verb {
        Verb::Run(arguments) => run::run(options, &arguments),
        Verb::Layout => layout::run(options),
        Verb::Plan(arguments) => plan::run(options, &arguments),
        Verb::Validate => validate::run(options),
        Verb::Scenario(arguments) => scenario::run(options, &arguments),
        Verb::Verify(arguments) => verify::run(options, &arguments),
        Verb::Compare(arguments) => compare::run(options, &arguments),
        Verb::DryRun(arguments) => dry_run::run(options, &arguments),
        Verb::Align(arguments) => align::run(options, &arguments),
        Verb::Simulate(arguments) => simulate::run(options, &arguments),
        Verb::View(arguments) => view::run(options, &arguments),
        Verb::Edit(arguments) => edit::run(options, &arguments),
        Verb::Export(arguments) => export::run(options, &arguments),
        Verb::Tune(arguments) => tune::run(options, &arguments),
        Verb::Figures(arguments) => figures::run(options, &arguments),
        Verb::Fk(arguments) => fk::run(options, &arguments),
        Verb::Ik(arguments) => ik::run(options, &arguments),
        Verb::Robot(arguments) if arguments.suggest => suggest::run(options),
        Verb::Robot(_) => robot::run(options),
        Verb::Sweep(arguments) => sweep::run(options, &arguments),
        Verb::Study(arguments) => study::run(options, &arguments),
        Verb::Reproduce(arguments) => reproduce::run(options, &arguments),
    }
}
