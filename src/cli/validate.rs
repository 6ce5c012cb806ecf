//! `platewash validate`: a scenario checked, not run.

use super::failure::{ExitCode, Failure};
use super::options::Options;
use super::output;
use platewash::planner::layout::{Finding, LayoutError};
use platewash::planner::scenario::Program;
use platewash::planner::words::counted;
use platewash::planner::{job, robot};
use platewash::{Cycle, Layout, PlanError, Scenario};
use serde::Serialize;

#[derive(Serialize)]
struct Answer {
    valid: bool,
    scenario: String,
    robot: String,
    findings: Vec<Finding>,
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
    let sampling = if scenario.layout.positions_m.is_none() {
        Some(sampling(&scenario)?)
    } else {
        None
    };
    let (robot, findings) = job::check(&scenario)?;
    scenario.check_work().map_err(|error| options.failure(error.into()))?;
    if scenario.job.program == Program::Certified {
        // What depends on where plates lie is known where they do.
        let drawn_anew = scenario.layout.only_washable && scenario.layout.positions_m.is_none();
        let layout = job::place_plates(&scenario, &robot).ok().filter(|_| !drawn_anew);
        let plates = layout.as_ref().map_or(&[][..], |layout| &layout.plates);
        Cycle::check(&scenario, &robot, plates)?;
    }
    let answer = Answer {
        valid: true,
        scenario: scenario.name,
        robot: robot.name().to_owned(),
        findings,
        sampling,
    };
    output::print_either(options.json, &answer, || text(&answer))?;
    Ok(ExitCode::SUCCESS)
}

/// Places the plates as `run` does. That another seed may do better is part of the answer; that none can is an error.
fn sampling(scenario: &Scenario) -> Result<Sampling, Failure> {
    let robot = robot::load(&scenario.robot)?;
    let placed = job::place_plates(scenario, &robot);
    if let Some(proven) = placed.as_ref().err().filter(|e| e.is_proven()) {
        return Err(PlanError::from(proven.clone()).into());
    }
    Ok(Sampling {
        seed: scenario.seed,
        layout_found: placed.is_ok(),
        outcome: outcome(&placed),
    })
}

fn outcome(placed: &Result<Layout, LayoutError>) -> String {
    match placed {
        Ok(layout) => format!("a layout of {} was found", counted(layout.plates.len(), "plate")),
        Err(error) => format!("{error}; another seed may do better"),
    }
}

fn text(answer: &Answer) -> String {
    let findings: String = answer.findings.iter().map(|f| format!("  - {f}\n")).collect();
    let sampling = answer.sampling.as_ref();
    let sampling = sampling.map_or_else(String::new, |s| format!("seed {}: {}\n", s.seed, s.outcome));
    format!(
        "{}: valid (robot {})\n{sampling}{findings}",
        answer.scenario, answer.robot
    )
}
