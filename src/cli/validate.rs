//! `platewash validate`: a scenario checked, not run.

use super::exit::Outcome;
use super::failure::{ExitCode, Failure};
use super::options::Options;
use super::output;
use platewash::planner::job;
use platewash::planner::layout::{Finding, LayoutError};
use platewash::planner::scenario::{Overlap, Program, UnitNote};
use platewash::planner::words::counted;
use platewash::{Cycle, Layout, PlanError, RobotModel, Scenario};
use serde::Serialize;

#[derive(Serialize)]
struct Answer {
    valid: bool,
    scenario: String,
    robot: String,
    /// What is to be said about the plates.
    findings: Vec<Finding>,
    /// Those of them for which no plan can be proved.
    unprovable: Vec<Finding>,
    /// What was probably meant in another unit.
    notes: Vec<UnitNote>,
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
    let arm = options.arm(&scenario)?;
    let sampling = if scenario.layout.positions_m.is_none() {
        Some(sampling(&scenario, &arm)?)
    } else {
        None
    };
    let (robot, mut findings) = job::check(&scenario)?;
    let mut unprovable = Vec::new();
    scenario.check_work().map_err(|error| options.failure(error.into()))?;
    if scenario.job.program == Program::Certified {
        // What depends on where plates lie is known where they do.
        let drawn_anew = scenario.layout.only_washable && scenario.layout.positions_m.is_none();
        let layout = job::place_plates(&scenario, &robot).ok().filter(|_| !drawn_anew);
        let plates = layout.as_ref().map_or(&[][..], |layout| &layout.plates);
        Cycle::check(&scenario, &robot, plates)?;
        if let Some(layout) = layout {
            findings = layout.findings;
        }
        unprovable = findings
            .iter()
            .filter(|f| breaks_the_proof(f, &scenario))
            .cloned()
            .collect();
    }
    let outcome = if unprovable.is_empty() {
        Outcome::Good
    } else {
        Outcome::NotVerified
    };
    let answer = Answer {
        valid: outcome == Outcome::Good,
        notes: scenario.notes().into_iter().chain(UnitNote::of_arm(&robot)).collect(),
        scenario: scenario.name,
        robot: robot.name().to_owned(),
        unprovable,
        findings,
        sampling,
    };
    output::print_either(options.json, &answer, || text(&answer))?;
    Ok(outcome.answer())
}

/// Whether a certificate fails for a finding, whatever is planned.
fn breaks_the_proof(finding: &Finding, scenario: &Scenario) -> bool {
    scenario.layout.overlap == Overlap::Fail
        && matches!(finding, Finding::PlatesOverlap { .. } | Finding::OverlapsBase { .. })
}

/// Places the plates as `run` does. That another seed may do better is part of the answer; that none can is an error.
fn sampling(scenario: &Scenario, robot: &RobotModel) -> Result<Sampling, Failure> {
    let placed = job::place_plates(scenario, robot);
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
    let verdict = match &answer.unprovable[..] {
        [] => "valid".to_owned(),
        [first, ..] => {
            format!("NOT VALID, {first} and layout.overlap = \"fail\": no plan for these plates can be proved")
        }
    };
    format!(
        "{}: {verdict} (robot {})\n{sampling}{findings}",
        answer.scenario, answer.robot
    )
}
