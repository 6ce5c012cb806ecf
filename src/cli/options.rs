//! Options that every verb takes, those that some verbs do not take, and tips on arguments that the command does not know.

use super::description::{self, Description, installed_files};
use super::failure::internal;
use super::numbers::{seed, within};
use super::output::{Progress, Reader, json, message, print};
use super::terminal::shown;
use anyhow::{Error, Result, anyhow, bail};
use clap::error::{ContextKind, ContextValue};
use clap::parser::ValueSource;
use clap::{ArgMatches, Args, Command, value_parser};
use platewash::kinematics::urdf::{Files, FixedJoints};
use platewash::planner::{PlanError, Watch};
use platewash::scenario::{Note, Program, ReducedClearanceSection, RobotSection, SHIPPED, ScenarioError, form};
use platewash::workcell::words::printable;
use platewash::{CancelToken, RobotModel, Scenario};
use rayon::ThreadPool;
use serde::Serialize;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

/// Stack of a worker thread: the usual size of a main thread's.
const STACK_BYTES: usize = 8 << 20;

/// Interval at which the cancel token is checked.
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
    /// URDF of another six-axis arm; a .xacro file is expanded where xacro is installed
    #[arg(long, global = true, value_name = "FILE")]
    pub urdf: Option<PathBuf>,
    /// Another six-axis arm by name, such as ur5e, whose description is in a package of ROS_PACKAGE_PATH or AMENT_PREFIX_PATH
    #[arg(long, global = true, value_name = "NAME", conflicts_with = "urdf")]
    pub arm: Option<String>,
    /// Argument for the expansion of a .xacro file (may be repeated)
    #[arg(long, global = true, value_name = "NAME:=VALUE")]
    pub xacro_arg: Vec<String>,
    /// Folder that holds the package of package:// mesh names (may be repeated); folders above the URDF and those of ROS are looked at, too
    #[arg(long, global = true, value_name = "DIR")]
    pub package_path: Vec<PathBuf>,
    /// SRDF that lists the link pairs to leave out of the collision check
    #[arg(long, global = true, value_name = "FILE")]
    pub srdf: Option<PathBuf>,
    /// Take the visuals of links without collision shapes as such, meshes as convex hulls
    #[arg(long, global = true)]
    pub visual_shapes: bool,
    /// Links whose meshes count as a few convex parts that enclose them, not as their convex hulls
    #[arg(long, global = true, value_name = "LINK,…", value_delimiter = ',')]
    pub split_links: Vec<String>,
    /// Joint that is not of the arm, such as a gripper's or a rail's, and the position at which it is held still [rad or m] (may be repeated)
    #[arg(long, global = true, value_name = "JOINT=VALUE", value_parser = fixed_joint, allow_hyphen_values = true)]
    pub fix: Vec<(String, f64)>,
    /// Link after joint 6 that carries the tool, and its axis along which the tool leaves it (z if left out) [default: tool0, or what the description tells]
    #[arg(long, global = true, value_name = "LINK[:AXIS]")]
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
    #[arg(long, global = true, value_name = "N", value_parser = value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Source of the files of an arm, with the expanded text of a .xacro file.
    #[arg(skip)]
    pub files: Files,
    /// Tells long work to give up.
    #[arg(skip)]
    pub cancel: CancelToken,
}

impl Options {
    /// Starts logging, unless it is on already, and returns the pool of worker threads.
    pub fn set_up(&self) -> Result<ThreadPool> {
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
        rayon::ThreadPoolBuilder::new()
            .num_threads(self.threads.unwrap_or(0).into())
            .stack_size(STACK_BYTES)
            .build()
            .map_err(internal)
    }

    /// The joints that are held still.
    pub fn fixed(&self) -> FixedJoints {
        self.fix.iter().cloned().collect()
    }

    /// Finds the description of an arm that is given by name, and expands a .xacro file.
    pub fn find_description(&mut self) -> Result<()> {
        let is_again = |k: &usize| self.fix[..*k].iter().any(|(joint, _)| *joint == self.fix[*k].0);
        if let Some(k) = (0..self.fix.len()).find(is_again) {
            bail!("--fix: joint '{}' is stated twice", self.fix[k].0.escape_debug());
        }
        self.files = installed_files();
        let mut description = match (&self.arm, &self.urdf) {
            (Some(name), _) => description::find(name)?,
            (None, Some(file)) => Description {
                file: file.clone(),
                arguments: Vec::new(),
            },
            (None, None) => {
                let needs = [
                    ("--package-path", !self.package_path.is_empty()),
                    ("--srdf", self.srdf.is_some()),
                    ("--visual-shapes", self.visual_shapes),
                    ("--split-links", !self.split_links.is_empty()),
                    ("--xacro-arg", !self.xacro_arg.is_empty()),
                ];
                if let Some((option, _)) = needs.into_iter().find(|(_, is_given)| *is_given) {
                    bail!("{option}: is for another arm; give its description as --urdf FILE, or --arm NAME");
                }
                return Ok(());
            }
        };
        if description
            .file
            .extension()
            .is_some_and(|extension| extension == "xacro")
        {
            description.arguments.extend(self.xacro_arg.iter().cloned());
            let text = description::expand(&description)?;
            self.files = std::mem::take(&mut self.files).with_text(&description.file, &text);
        } else if !self.xacro_arg.is_empty() {
            bail!(
                "--xacro-arg: {} is no .xacro file; leave it out",
                description.file.display()
            );
        }
        self.urdf = Some(description.file);
        Ok(())
    }

    /// The scenario with what the options override.
    pub fn scenario(&self) -> Result<Scenario> {
        Ok(self.warned(self.overridden()?))
    }

    fn warned(&self, scenario: Scenario) -> Scenario {
        self.warn(&scenario.notes());
        scenario
    }

    fn overridden(&self) -> Result<Scenario> {
        let mut scenario = Scenario::load(self.scenario_name())?;
        if let Some(seed) = self.seed {
            scenario.seed = seed;
        }
        scenario.files = self.files.clone();
        if self.urdf.is_some() {
            scenario.robot = self.robot_section(scenario.robot);
            if self.is_for_irb120(&scenario)? {
                (scenario.robot.start_deg, scenario.robot.home_deg) = (None, None);
            }
        }
        scenario.robot.fixed.extend(self.fixed());
        if let Some(link) = &self.tool_mount {
            scenario.tool.mounted_on = Some(link.clone());
        }
        scenario.validate().map_err(|error| self.of_file(error))?;
        let read = scenario.plates_read().map_err(|error| self.of_file(error))?;
        Ok(read.into_owned())
    }

    /// The section with the arm of the options in place of its own.
    pub fn robot_section(&self, section: RobotSection) -> RobotSection {
        RobotSection {
            urdf: self.urdf.clone(),
            srdf: self.srdf.clone(),
            package_path: self.package_path.clone(),
            visual_shapes: self.visual_shapes,
            split_links: self.split_links.clone(),
            fixed: self.fixed(),
            ..section
        }
    }

    /// True where a shipped scenario, whose home and places are the IRB 120's, is to be done by another arm.
    fn is_for_irb120(&self, scenario: &Scenario) -> Result<bool> {
        let is_shipped = SHIPPED.iter().any(|shipped| shipped.name == self.scenario_name());
        if !is_shipped || scenario.job.program != Program::Certified {
            return Ok(false);
        }
        let arm = scenario.arm().map_err(|error| self.failure(error))?;
        let own = RobotModel::irb120()?;
        Ok((arm.folded(), arm.limits()) != (own.folded(), own.limits()))
    }

    /// The scenario, fitted to the arm of the options where no scenario is named.
    pub fn fitted_scenario(&self) -> Result<Scenario> {
        let scenario = self.overridden()?;
        // The scenario that is taken then states a home for the IRB 120, and none for other arms.
        if self.scenario.is_some() || scenario.robot.start_deg.is_some() {
            return Ok(self.warned(scenario));
        }
        let arm = scenario.arm().map_err(|error| self.failure(error))?;
        let fitted = self.during("looking for a home and a region for this arm", || {
            scenario.fitted_to(&arm, &Watch::silent(&self.cancel))
        });
        let Some(fitted) = fitted.map_err(|error| self.failure(error))? else {
            self.say(&format!(
                "no region was found in which this arm washes plates with their faces at {} m; the places of {} are tried",
                scenario.layout.plate_height_m, scenario.name
            ));
            return Ok(self.warned(scenario));
        };
        let fitted = self.warned(fitted);
        let layout = &fitted.layout;
        self.say(&format!(
            "chosen for this arm; to keep or change it, put these lines in place of start_deg, count, region and base_radius_m of \
             a scenario (platewash scenario {} > mine.toml), and name it with --scenario:\n\
             [robot]\nstart_deg = {:?}\n{}\
             {}[layout]\ncount = {}\nrho_m = {:?}\nazimuth_deg = {:?}\nbase_radius_m = {}\nonly_washable = true",
            self.scenario_name(),
            fitted.robot.start_deg.unwrap_or_default(),
            split_text(&fitted),
            reduced_text(&fitted),
            layout.count,
            layout.rho_m.unwrap_or_default(),
            layout.azimuth_deg.unwrap_or_default(),
            layout.base_radius_m,
        ));
        Ok(fitted)
    }

    /// The arm of a scenario.
    pub fn arm(&self, scenario: &Scenario) -> Result<Arc<RobotModel>, platewash::Failure> {
        let arm = scenario.arm()?;
        self.warn(&Note::of_arm(&arm));
        Ok(arm)
    }

    /// Prints a warning for each value that was probably meant in another unit.
    pub fn warn(&self, notes: &[Note]) {
        for note in notes {
            self.say(&format!("warning: {note}"));
        }
    }

    /// Error for a scenario that could not be carried out. An error in the scenario names the file that was given, not the
    /// scenario's own name.
    pub fn failure(&self, error: platewash::Failure) -> Error {
        match error {
            platewash::Failure::Scenario(error) => self.of_file(error).into(),
            other => other.into(),
        }
    }

    /// The error with the name of the scenario in front, where `--scenario` is given and the error comes from that scenario.
    pub fn in_file(&self, error: Error) -> Error {
        match &self.scenario {
            Some(file) if error.downcast_ref().is_some_and(is_of_job) => {
                error.context(format!("scenario {}", printable(file)))
            }
            _ => error,
        }
    }

    /// A progress display for work that may take long.
    pub fn progress(&self, work: &'static str) -> Progress {
        Progress::new(self.quiet, work)
    }

    /// Returns the result of some work, and shows progress while it runs.
    pub fn during<T>(&self, work: &'static str, make: impl FnOnce() -> T) -> T {
        let _progress = self.progress(work);
        make()
    }

    /// The output folder, or another one.
    pub fn folder_or(&self, default: &str) -> PathBuf {
        self.out.clone().unwrap_or_else(|| default.into())
    }

    /// The output folder.
    pub fn folder(&self) -> PathBuf {
        self.folder_or("out")
    }

    /// Waits until the cancel token is set.
    pub fn wait(&self) {
        while !self.cancel.is_cancelled() {
            std::thread::sleep(LOOK);
        }
    }

    /// Name of the scenario as given: a file, or a shipped name.
    pub fn scenario_name(&self) -> &str {
        self.scenario.as_deref().unwrap_or(SHIPPED[0].name)
    }

    /// The error with the file that was given in place of the scenario's own name.
    fn of_file(&self, error: ScenarioError) -> ScenarioError {
        ScenarioError {
            source_name: self.scenario_name().into(),
            ..error
        }
    }
}

/// A joint and its position.
fn fixed_joint(text: &str) -> Result<(String, f64)> {
    let expected = "must be a joint's name, an equals sign and a number, as in finger_joint=0.02";
    let (name, at) = text.rsplit_once('=').ok_or_else(|| anyhow!("{expected}"))?;
    Ok((name.to_owned(), within(at, -1e3..=1e3, expected)?))
}

/// The line of a scenario's links to split, as a file states it.
fn split_text(scenario: &Scenario) -> String {
    match &scenario.robot.split_links[..] {
        [] => String::new(),
        links => format!("split_links = {links:?}\n"),
    }
}

/// The sections of a scenario's reduced clearances, as a file states them.
fn reduced_text(scenario: &Scenario) -> String {
    let one = |ReducedClearanceSection { a, b, clearance_m }: &ReducedClearanceSection| {
        format!("[[reduced_clearance]]\na = {a:?}\nb = {b:?}\nclearance_m = {clearance_m}\n")
    };
    scenario.reduced_clearance.iter().map(one).collect()
}

/// True where a job was refused because of its scenario, in a message that does not name the scenario.
fn is_of_job(failure: &platewash::Failure) -> bool {
    use platewash::Failure::{Body, Job, NoContact, Plan, Tool};
    match failure.cause() {
        Job(_) | NoContact { .. } | Body(_) | Tool(_) => true,
        Plan(error) => matches!(
            error,
            PlanError::Job(_) | PlanError::Home { .. } | PlanError::HomeNotClear { .. } | PlanError::NoTool
        ),
        _ => false,
    }
}

/// Largest number of keys that a tip names.
const MOST_KEYS: usize = 3;

/// Least number of common first characters, dashes included, for which an unknown option counts as a misspelling of the suggested one.
const NEAR: usize = 6;

/// Reason why verbs on plan files do not take `--scenario`, `--seed` and `--tool-mount`.
pub const PLAN_STATES: &str =
    "the plan file states its job and its seed; leave it out (verify --against compares them with a scenario)";

/// Verbs, the options that they do not take, and the reason.
const REFUSED: [(&str, &str, &str); 8] = [
    (
        "verify simulate tune view figures export dry-run compare",
        "scenario tool_mount",
        PLAN_STATES,
    ),
    ("simulate tune view figures export dry-run compare", "seed", PLAN_STATES),
    (
        "align",
        "seed srdf visual_shapes split_links tool_mount out",
        "align needs no more than the points of its file and the links of an arm, and writes no file; leave it out",
    ),
    (
        "prove-motion",
        "scenario seed tool_mount out",
        "prove-motion judges a trajectory without a scenario, and writes no file but that of --page; leave it out",
    ),
    (
        "study",
        "scenario seed urdf arm xacro_arg package_path srdf visual_shapes split_links fix tool_mount",
        "the study file states its scenarios and seeds; leave it out",
    ),
    (
        "sweep",
        "seed",
        "sweep plans one layout for each of --seeds; leave it out",
    ),
    (
        "scenario",
        "scenario seed urdf arm xacro_arg package_path srdf visual_shapes split_links fix tool_mount out",
        "scenario prints a shipped scenario as it is, `platewash scenario NAME`; leave it out",
    ),
    (
        "reproduce",
        "scenario urdf arm xacro_arg package_path srdf visual_shapes split_links fix tool_mount",
        "reproduce measures the paper's own scenarios and arm; leave it out",
    ),
];

/// The command with the options that a verb does not take left out of its help.
pub fn hide(mut command: Command) -> Command {
    let all: Vec<_> = command.get_arguments().cloned().collect();
    for (verbs, options, _) in REFUSED {
        let is_refused = |id: &str| options.split(' ').any(|option| option == id);
        let refused = all.iter().filter(|argument| is_refused(argument.get_id().as_str()));
        let hidden: Vec<_> = refused.map(|argument| argument.clone().hide(true)).collect();
        for verb in verbs.split(' ') {
            command = command.mut_subcommand(verb, |sub| sub.args(&hidden));
        }
    }
    command
}

/// Refuses an option that the verb does not take.
pub fn refuse(matches: &ArgMatches) -> Result<()> {
    let Some((verb, given)) = matches.subcommand() else {
        return Ok(());
    };
    let is_given = |id: &&str| given.value_source(id) == Some(ValueSource::CommandLine);
    for (verbs, options, why) in REFUSED {
        let of_verb = verbs.split(' ').any(|other| other == verb);
        if let Some(id) = options.split(' ').find(|id| of_verb && is_given(id)) {
            bail!("--{}: {why}", id.replace('_', "-"));
        }
    }
    Ok(())
}

/// An error about arguments, with a tip where a scenario stands without `--scenario`, or an option has the name of a scenario's key.
pub fn with_tip(mut error: clap::Error) -> clap::Error {
    let named = |kind| match error.get(kind) {
        Some(ContextValue::String(name)) => Some(name.clone()),
        _ => None,
    };
    let given = named(ContextKind::InvalidArg).or_else(|| named(ContextKind::InvalidSubcommand));
    let known = named(ContextKind::SuggestedArg).unwrap_or_default();
    let is_near = |given: &String| given.chars().zip(known.chars()).take_while(|(a, b)| a == b).count() >= NEAR;
    if let Some(tip) = given.filter(|given| !is_near(given)).and_then(|given| tip(&given)) {
        let _ = error.remove(ContextKind::SuggestedArg);
        let _ = error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![tip.into()]));
    }
    error
}

fn tip(given: &str) -> Option<String> {
    if SHIPPED.iter().any(|shipped| shipped.name == given) || given.ends_with(".toml") {
        return Some(format!("a scenario is given as '--scenario {given}'"));
    }
    if [".urdf", ".xacro"].iter().any(|end| given.ends_with(end)) {
        return Some(format!("the description of an arm is given as '--urdf {given}'"));
    }
    let option = given.strip_prefix("--")?.split('=').next()?.replace('-', "_");
    if ["robot", "model"].contains(&&*option) {
        return Some("another arm is given by its description, '--urdf ARM.urdf', or by name, '--arm NAME'".to_owned());
    }
    let is_named = |path: &&str| {
        let name = path.rsplit('.').next().and_then(|name| name.strip_prefix(&*option));
        name.is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
    };
    let form = form();
    let keys = form.iter().map(|key| key.path).filter(is_named).take(MOST_KEYS);
    let keys: Vec<String> = keys.map(|path| format!("'{path}'")).collect();
    (!keys.is_empty()).then(|| format!("keys are set in the scenario's file: {}", keys.join(", ")))
}

impl Options {
    /// Prints an answer as JSON, or as text.
    pub fn print(&self, answer: &impl Serialize, words: impl FnOnce() -> String) -> Result<Reader> {
        print(&if self.json { json(answer)? } else { shown(&words()) })
    }

    /// Prints a message on standard error, unless `--quiet` is given.
    pub fn say(&self, words: &str) {
        if !self.quiet {
            message(words);
        }
    }
}
