//! Options that every verb takes.

use super::failure::Failure;
use super::output;
use anyhow::{Context, anyhow, ensure};
use clap::Args;
use platewash::planner::PlanError;
use platewash::scenario::{Note, SHIPPED, ScenarioError};
use platewash::workcell::job::MAX_SEED;
use platewash::workcell::words::printable;
use platewash::{CancelToken, RobotModel, Scenario};
use rayon::ThreadPool;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

/// Stack of a worker thread: what a main thread usually has.
const STACK_BYTES: usize = 8 << 20;

/// Time between two looks at whether somebody ends it.
const LOOK: Duration = Duration::from_millis(50);

/// Options that every verb takes.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Common options")]
pub struct Options {
    /// Scenario: a file, or a shipped name (kitchen, kitchen-spiral, kitchen-roomy, kitchen-rim, coupe, rim, deep, dessert, angled-tool, bracket-tool, sink, pedestal, ceiling, wall, rack, sizes, paper-appendix, paper-text) [default: kitchen]
    #[arg(long, global = true, value_name = "FILE|NAME")]
    pub scenario: Option<String>,
    /// Seed that replaces the scenario's, from 0 to 2^53 − 1
    #[arg(long, global = true, value_name = "N", value_parser = seed, allow_negative_numbers = true)]
    pub seed: Option<u64>,
    /// Output folder
    #[arg(long, global = true, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// URDF of another six-axis arm (xacro files must be expanded first)
    #[arg(long, global = true, value_name = "FILE")]
    pub urdf: Option<PathBuf>,
    /// Folder that holds the package of package:// mesh names (may be repeated)
    #[arg(long, global = true, value_name = "DIR", requires = "urdf")]
    pub package_path: Vec<PathBuf>,
    /// SRDF that lists the link pairs to leave out of the collision check
    #[arg(long, global = true, value_name = "FILE", requires = "urdf")]
    pub srdf: Option<PathBuf>,
    /// Link after joint 6 that carries the tool; the tool points along its z axis [default: tool0]
    #[arg(long, global = true, value_name = "LINK")]
    pub tool_mount: Option<String>,
    /// Print the result as JSON
    #[arg(long, global = true)]
    pub json: bool,
    /// Print no messages and no progress
    #[arg(long, short, global = true, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Print more messages (-vv for even more)
    #[arg(long, short, global = true, action = clap::ArgAction::Count)]
    pub verbose: u8,
    /// Number of threads [default: one for each processor]; it does not change results
    #[arg(long, global = true, value_name = "N")]
    pub threads: Option<usize>,
    /// Tells long work to give up.
    #[arg(skip)]
    pub cancel: CancelToken,
}

impl Options {
    /// Starts logging, where it has not begun yet; the threads to work on.
    pub fn set_up(&self) -> Result<ThreadPool, Failure> {
        let level = match (self.quiet, self.verbose) {
            (true, _) => tracing::Level::ERROR,
            (false, 0) => tracing::Level::WARN,
            (false, 1) => tracing::Level::INFO,
            (false, _) => tracing::Level::DEBUG,
        };
        // Only a second call in one process fails: the first one's settings stay.
        let _ = tracing_subscriber::fmt()
            .with_max_level(level)
            .with_writer(std::io::stderr)
            .without_time()
            .with_target(false)
            .try_init();
        let threads = self.threads.unwrap_or(0);
        if self.threads == Some(0) || threads > 1024 {
            return Err(Failure::input(anyhow!(
                "--threads must be from 1 to 1024; found {threads}"
            )));
        }
        rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .stack_size(STACK_BYTES)
            .build()
            .map_err(Failure::internal)
    }

    /// The scenario with what the options override.
    pub fn scenario(&self) -> Result<Scenario, Failure> {
        let mut scenario = Scenario::load(self.scenario_name())?;
        if let Some(seed) = self.seed {
            scenario.seed = seed;
        }
        if let Some(urdf) = &self.urdf {
            scenario.robot.urdf = Some(urdf.clone());
            scenario.robot.srdf.clone_from(&self.srdf);
            scenario.robot.package_path.clone_from(&self.package_path);
        }
        if let Some(link) = &self.tool_mount {
            scenario.tool.mounted_on = Some(link.clone());
        }
        scenario.validate().map_err(|error| self.of_file(error))?;
        self.warn(&scenario.notes());
        Ok(scenario)
    }

    /// The arm of a scenario.
    pub fn arm(&self, scenario: &Scenario) -> Result<Arc<RobotModel>, platewash::Failure> {
        let arm = scenario.arm()?;
        self.warn(&Note::of_arm(&arm));
        Ok(arm)
    }

    /// Says on standard error what was probably meant in another unit.
    pub fn warn(&self, notes: &[Note]) {
        for note in notes {
            output::message(self.quiet, &format!("warning: {note}"));
        }
    }

    /// Why the scenario could not be carried out; what is wrong in it with the file that was given in place of its own name.
    pub fn failure(&self, error: platewash::Failure) -> Failure {
        match error {
            platewash::Failure::Scenario(error) => self.of_file(error).into(),
            other => other.into(),
        }
    }

    /// The failure with the scenario's file in front, where a file was given and the failure is one of what it states.
    pub fn in_file(&self, failure: Failure) -> Failure {
        match (&self.scenario, failure) {
            (Some(file), Failure::Wrong { code, error }) if error.downcast_ref().is_some_and(is_of_job) => {
                let error = error.context(format!("scenario {}", printable(file)));
                Failure::Wrong { code, error }
            }
            (_, failure) => failure,
        }
    }

    /// Waits until it is told to end.
    pub fn wait(&self) {
        while !self.cancel.is_cancelled() {
            std::thread::sleep(LOOK);
        }
    }

    /// What the scenario was called: a file, or a shipped name.
    pub fn scenario_name(&self) -> &str {
        self.scenario.as_deref().unwrap_or(SHIPPED[0].name)
    }

    /// The error with the file that was given in place of the scenario's own name.
    fn of_file(&self, error: ScenarioError) -> ScenarioError {
        ScenarioError {
            source_name: self.scenario_name().to_owned(),
            ..error
        }
    }
}

/// Whether a job was refused for what its scenario states, in a message that does not say which scenario that is.
fn is_of_job(failure: &platewash::Failure) -> bool {
    use platewash::Failure::{Body, Job, NoContact, Plan, Tool};
    match failure {
        Job(_) | NoContact { .. } | Body(_) | Tool(_) => true,
        Plan(error) => matches!(
            error,
            PlanError::Job(_) | PlanError::Home { .. } | PlanError::HomeNotClear { .. } | PlanError::NoTool
        ),
        _ => false,
    }
}

/// A seed as a scenario may state one.
pub fn seed(text: &str) -> anyhow::Result<u64> {
    let expected = || format!("must be a whole number from 0 to {MAX_SEED} (2^53 − 1)");
    let seed = text.parse().with_context(expected)?;
    ensure!(seed <= MAX_SEED, expected());
    Ok(seed)
}
