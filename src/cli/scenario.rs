//! `platewash scenario`, `validate` and `layout`: the text of a shipped scenario, and what is known of one without planning it.

use super::failure::ExitCode;
use super::files::Files;
use super::infeasible;
use super::options::Options;
use anyhow::{Error, Result};
use clap::Args;
use platewash::scenario::{Note, SHIPPED, source};
use platewash::simulator::simulate::PayloadCheck;
use platewash::workcell::layout::{Finding, LayoutSource};
use platewash::workcell::words::{count_with_noun, plate_number};
use platewash::{Failure, Layout, Scenario};
use serde::Serialize;
use std::fmt::Write;

/// Arguments of `scenario`.
#[derive(Debug, Args)]
pub struct ScenarioArguments {
    /// Name of a shipped scenario; without it, all names are listed
    pub name: Option<String>,
}

#[derive(Serialize)]
struct ScenarioEntry {
    name: &'static str,
    about: String,
}

/// Prints a shipped scenario as it is, comments included, or lists the shipped scenarios.
pub fn show(options: &Options, arguments: &ScenarioArguments) -> Result<ExitCode> {
    if let Some(name) = &arguments.name {
        let text = source(name)?.text;
        options.print(&text, || text.clone())?;
        return Ok(ExitCode::Done);
    }
    let all = SHIPPED.iter().map(|shipped| ScenarioEntry {
        name: shipped.name,
        about: shipped.about(),
    });
    let all: Vec<ScenarioEntry> = all.collect();
    let line = |ScenarioEntry { name, about }: &ScenarioEntry| format!("{name:<15} {about}\n");
    options.print(&all, || all.iter().map(line).collect())?;
    Ok(ExitCode::Done)
}

#[derive(Serialize)]
struct ValidAnswer {
    valid: bool,
    scenario: String,
    robot: String,
    /// Findings about the plates.
    findings: Vec<Finding>,
    /// Notes on values that were probably meant in another unit.
    notes: Vec<Note>,
    /// Masses of a tool that is too heavy for the arm, in words; `null` where the arm may carry it, or no payload is known.
    overload: Option<String>,
    /// Result of placing the plates with the seed, where they are sampled.
    sampling: Option<Sampling>,
}

#[derive(Serialize)]
struct Sampling {
    seed: u64,
    layout_found: bool,
    /// Outcome in words.
    outcome: String,
}

/// Checks the scenario, its arm and its plates: given ones are looked over, sampled ones placed with the scenario's seed.
pub fn validate(options: &Options) -> Result<ExitCode> {
    let scenario = options.scenario()?;
    let answer = valid(options, &scenario).or_else(|error| report_invalid(options, &scenario, error))?;
    options.print(&answer, || answer.text())?;
    Ok(ExitCode::Done)
}

/// The error, once `--json` has told what stands against the scenario.
fn report_invalid<T>(options: &Options, scenario: &Scenario, error: Error) -> Result<T> {
    infeasible::answer(options, scenario, &error)?;
    Err(error)
}

fn valid(options: &Options, scenario: &Scenario) -> Result<ValidAnswer> {
    let arm = options.arm(scenario)?;
    let mut sampling = None;
    let listed = scenario.lists_plates();
    // What depends on where plates lie is known where they do.
    let drawn_anew = scenario.layout.only_washable && !listed;
    let drawn = (!listed).then(|| scenario.layout(&arm));
    if let Some(placed) = &drawn {
        sampling = Some(Sampling::measure(scenario, placed)?);
    }
    let (robot, mut findings) = scenario.check().map_err(|error| options.failure(error))?;
    scenario.check_work().map_err(|error| options.failure(error.into()))?;
    if let Some(layout) = drawn.and_then(Result::ok).filter(|_| !drawn_anew) {
        scenario.check_on(&robot, &layout)?;
        findings = layout.findings;
    }
    Ok(ValidAnswer {
        valid: true,
        notes: [scenario.notes(), Note::of_arm(&robot), scenario.notes_on_bodies(&robot)].concat(),
        overload: PayloadCheck::new(&scenario.tool_on(&robot)?, scenario.robot.payload_kg, &robot).overload(),
        scenario: scenario.name.clone(),
        robot: robot.name().to_owned(),
        findings,
        sampling,
    })
}

impl Sampling {
    /// Result of placing the plates as `run` does. A search without success is a result, as another seed may succeed; a proof that no
    /// layout exists is an error.
    fn measure(scenario: &Scenario, placed: &Result<Layout, Failure>) -> Result<Self, Failure> {
        let outcome = match placed {
            Ok(layout) => format!(
                "a layout of {} was found",
                count_with_noun(layout.plates.len(), "plate")
            ),
            Err(Failure::Layout(error)) if error.is_proven() => return Err(error.clone().into()),
            Err(error) => error.to_string(),
        };
        Ok(Self {
            seed: scenario.seed,
            layout_found: placed.is_ok(),
            outcome,
        })
    }
}

impl ValidAnswer {
    fn text(&self) -> String {
        let findings: String = self.findings.iter().map(|f| format!("  - {f}\n")).collect();
        let sampling = self.sampling.as_ref();
        let sampling = sampling.map_or_else(String::new, |s| format!("seed {}: {}\n", s.seed, s.outcome));
        let overload = self.overload.as_ref();
        let overload = overload.map_or_else(String::new, |words| format!("  - OVERLOADED: {words}\n"));
        let (scenario, robot) = (&self.scenario, &self.robot);
        format!("{scenario}: valid (robot {robot})\n{sampling}{findings}{overload}")
    }
}

/// Places the plates; with `--out`, writes `layout.json`.
pub fn layout(options: &Options) -> Result<ExitCode> {
    let scenario = options.scenario()?;
    let robot = options.arm(&scenario)?;
    let placed = scenario.layout(&robot);
    let layout = placed.or_else(|failure| report_invalid(options, &scenario, failure.into()))?;
    let mut files = Files::new(options.out.clone(), &["layout.json"]);
    files.add("layout.json", super::output::json(&layout)?);
    files.answer(options, &layout, || layout_text(&layout))?;
    Ok(ExitCode::Infeasible.unless(!scenario.has_forbidden_overlap(&layout)))
}

fn layout_text(layout: &Layout) -> String {
    let mut text = match layout.source {
        LayoutSource::Sampled { restarts, draws } => {
            let (restarts, draws) = (
                count_with_noun(restarts as usize, "restart"),
                count_with_noun(draws as usize, "draw"),
            );
            format!("sampled, {restarts}, {draws}\n")
        }
        LayoutSource::Explicit => "given\n".to_owned(),
    };
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "{:<6} {:>9} {:>9} {:>9} {:>9}",
        "plate", "x, m", "y, m", "z, m", "radius, m"
    );
    for (i, plate) in layout.plates.iter().enumerate() {
        let (at, radius_m) = (plate.centre(), plate.rim_m());
        let tilted = plate.tilt_words().map(|tilted| format!("  {tilted}"));
        let _ = writeln!(
            text,
            "{:<6} {:>9.4} {:>9.4} {:>9.4} {radius_m:>9.4}{}",
            plate_number(i),
            at.x,
            at.y,
            at.z,
            tilted.unwrap_or_default()
        );
    }
    let findings = layout.findings.iter().map(|finding| format!("  - {finding}\n"));
    text + &findings.collect::<String>()
}
