//! `platewash validate`: a scenario checked, not run.

use super::failure::Failure;
use super::options::Options;
use super::output;
use platewash::planner::job;
use platewash::planner::layout::Finding;
use serde::Serialize;
use std::process::ExitCode;

#[derive(Serialize)]
struct Answer {
    valid: bool,
    scenario: String,
    robot: String,
    findings: Vec<Finding>,
}

/// Checks the scenario, its arm and whether its plates have room in principle.
pub fn run(options: &Options) -> Result<ExitCode, Failure> {
    let scenario = options.scenario()?;
    let (robot, findings) = job::check(&scenario)?;
    let answer = Answer {
        valid: true,
        scenario: scenario.name,
        robot: robot.name().to_owned(),
        findings,
    };
    output::print_either(options.json, &answer, || {
        let findings: String = answer.findings.iter().map(|f| format!("  - {f}\n")).collect();
        format!("{}: valid (robot {})\n{findings}", answer.scenario, answer.robot)
    })?;
    Ok(ExitCode::SUCCESS)
}
