//! `platewash run`: a scenario to the end.

use super::exit::Outcome;
use super::failure::{ExitCode, Failure};
use super::options::Options;
use super::plan::{self, Followed, PlanArguments};
use super::{cycle, output, results};
use clap::Args;
use platewash::planner::certificate::PairsShown;
use platewash::planner::scenario::Program;

/// Arguments of `run`.
#[derive(Debug, Args, Default)]
pub struct RunArguments {
    #[command(flatten)]
    pub plan: PlanArguments,
    /// Name every pair of bodies in the report, not the ten tightest alone
    #[arg(long)]
    pub all_pairs: bool,
}

impl RunArguments {
    /// The pairs that the report names.
    pub fn pairs(&self) -> PairsShown {
        pairs(self.all_pairs)
    }
}

/// The pairs that a table names, as `--all-pairs` says.
pub fn pairs(all: bool) -> PairsShown {
    if all { PairsShown::All } else { PairsShown::Tightest }
}

/// Plans, follows and judges the scenario; writes the plan, both motions and the report.
pub fn run(options: &Options, arguments: &RunArguments) -> Result<ExitCode, Failure> {
    let scenario = options.scenario()?;
    let folder = plan::folder(options);
    let csv = plan::csv_file(options, &arguments.plan);
    let others = |name: &&str| *name != "trajectory.csv" && !results::SIMULATED.contains(name);
    let names = results::OWNED.into_iter().filter(others);
    results::check_places(&folder, &names.collect::<Vec<_>>(), &csv)?;
    if scenario.job.program == Program::Certified {
        return cycle::run(options, &scenario, arguments);
    }
    let (job, report) = match plan::carry_out(options, &scenario)? {
        Followed::Judged(both) => *both,
        Followed::Infeasible(report) => return plan::infeasible(options, &scenario, &report),
    };
    let text = output::text(&report);
    let segments = platewash::planner::plan::segments(&job);
    let mut files = plan::files(options, &job, &segments, &report, &arguments.plan)?;
    let executed = plan::motion_csv(&scenario, &job.robot, &job.executed, &segments, &arguments.plan)?;
    files.push(output::file(folder.join("executed.csv"), executed));
    files.push(output::file(folder.join("report.json"), output::json(&report)?));
    files.push(output::file(folder.join("report.txt"), &text));
    results::write(&folder, &files)?;
    output::print_either(options.json, &report, || text.clone())?;
    plan::name_files(options, &files);
    Ok(Outcome::from(report.verdict).job(scenario.job.on_failure))
}
