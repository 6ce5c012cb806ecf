//! `platewash run`: a scenario to the end.

use super::failure::{self, ExitCode, Failure};
use super::options::Options;
use super::plan::{self, PlanArguments};
use super::{cycle, output, results};
use clap::Args;
use platewash::Verdict;
use platewash::planner::scenario::{OnFailure, Program};

/// Arguments of `run`.
#[derive(Debug, Args, Default)]
pub struct RunArguments {
    #[command(flatten)]
    pub plan: PlanArguments,
}

/// Plans, follows and judges the scenario; writes the plan, both motions and the report.
pub fn run(options: &Options, arguments: &RunArguments) -> Result<ExitCode, Failure> {
    let scenario = options.scenario()?;
    if scenario.job.program == Program::Certified {
        return cycle::run(options, &scenario, &arguments.plan);
    }
    let (job, report) = plan::carry_out(options, &scenario)?;
    let folder = plan::folder(options);
    let text = output::text(&report);
    let mut files = plan::files(options, &job, &report, &arguments.plan)?;
    let segments = platewash::planner::plan::segments(&job);
    let executed = plan::motion_csv(&scenario, &job.robot, &job.executed, &segments, &arguments.plan)?;
    files.push((folder.join("executed.csv"), executed));
    files.push((folder.join("report.json"), output::json(&report)?));
    files.push((folder.join("report.txt"), text.clone()));
    results::write(&folder, &files)?;
    output::print_either(options.json, &report, || text)?;
    plan::name_files(options, &files);
    Ok(exit_code(report.verdict, scenario.job.on_failure))
}

/// The exit code of a finished job.
pub fn exit_code(verdict: Verdict, on_failure: OnFailure) -> ExitCode {
    ExitCode::from(match (on_failure, verdict) {
        (OnFailure::Report, _) | (_, Verdict::Washed) => 0,
        (OnFailure::Fail, Verdict::Infeasible | Verdict::NotFound) => failure::INFEASIBLE,
        (OnFailure::Fail, Verdict::NotVerified) => failure::NOT_VERIFIED,
    })
}
