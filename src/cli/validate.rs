//! `platewash validate`: a scenario checked, not run.

use super::failure::{ExitCode, Failure};
use super::options::Options;
use super::{infeasible, output};
use platewash::scenario::Note;
use platewash::simulator::simulate::PayloadCheck;
use platewash::workcell::layout::{Finding, LayoutError};
use platewash::workcell::words::counted;
use platewash::{Layout, Scenario};
use serde::Serialize;

#[derive(Serialize)]
struct Answer {
    valid: bool,
    scenario: String,
    robot: String,
    /// What is to be said about the plates.
    findings: Vec<Finding>,
    /// What was probably meant in another unit.
    notes: Vec<Note>,
    /// That the arm may not carry the tool, by what; `null` where it may, or no payload is known.
    overload: Option<String>,
    /// What the seed gives, for plates that are sampled.
    sampling: Option<Sampling>,
}

#[derive(Serialize)]
struct Sampling {
    seed: u64,
    layout_found: bool,
    /// In words.
    outcome: String,
}

/// Checks the scenario, its arm and its plates: given ones are looked over, sampled ones placed with the scenario's seed.
pub fn run(options: &Options) -> Result<ExitCode, Failure> {
    let scenario = options.scenario()?;
    let checked = check(options, &scenario);
    if let Err(failure) = &checked {
        infeasible::answer(options, &scenario, failure)?;
    }
    checked
}

fn check(options: &Options, scenario: &Scenario) -> Result<ExitCode, Failure> {
    let arm = options.arm(scenario)?;
    let mut sampling = None;
    let listed = scenario.lists_plates();
    // What depends on where plates lie is known where they do.
    let drawn_anew = scenario.layout.only_washable && !listed;
    let drawn = (!listed).then(|| scenario.layout(&arm));
    if let Some(placed) = &drawn {
        sampling = Some(Sampling::of(scenario, placed)?);
    }
    let (robot, mut findings) = scenario.check().map_err(|error| options.failure(error))?;
    scenario.check_work().map_err(|error| options.failure(error.into()))?;
    if let Some(layout) = drawn.and_then(Result::ok).filter(|_| !drawn_anew) {
        scenario.check_on(&robot, &layout)?;
        findings = layout.findings;
    }
    let overload = PayloadCheck::new(&scenario.tool_on(&robot)?, scenario.robot.payload_kg, &robot).overload();
    let answer = Answer {
        valid: true,
        notes: [scenario.notes(), Note::of_arm(&robot), scenario.notes_on_meshes()].concat(),
        overload,
        scenario: scenario.name.clone(),
        robot: robot.name().to_owned(),
        findings,
        sampling,
    };
    output::print_either(options.json, &answer, || text(&answer))?;
    Ok(ExitCode::SUCCESS)
}

impl Sampling {
    /// What placing the plates as `run` does gives. That another seed may do better is part of the answer; that none can is an error.
    fn of(scenario: &Scenario, placed: &Result<Layout, LayoutError>) -> Result<Self, Failure> {
        if let Some(proven) = placed.as_ref().err().filter(|e| e.is_proven()) {
            return Err(platewash::Failure::from(proven.clone()).into());
        }
        Ok(Self {
            seed: scenario.seed,
            layout_found: placed.is_ok(),
            outcome: outcome(placed),
        })
    }
}

fn outcome(placed: &Result<Layout, LayoutError>) -> String {
    match placed {
        Ok(layout) => format!("a layout of {} was found", counted(layout.plates.len(), "plate")),
        Err(error) => platewash::Failure::from(error.clone()).to_string(),
    }
}

fn text(answer: &Answer) -> String {
    let findings: String = answer.findings.iter().map(|f| format!("  - {f}\n")).collect();
    let sampling = answer.sampling.as_ref();
    let sampling = sampling.map_or_else(String::new, |s| format!("seed {}: {}\n", s.seed, s.outcome));
    let overload = answer.overload.as_ref();
    let overload = overload.map_or_else(String::new, |words| format!("  - OVERLOADED: {words}\n"));
    format!(
        "{}: valid (robot {})\n{sampling}{findings}{overload}",
        answer.scenario, answer.robot
    )
}
