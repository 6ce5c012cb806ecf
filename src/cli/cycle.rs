//! `platewash run` and `plan` of a certified job.

use super::failure::{ExitCode, Failure};
use super::options::Options;
use super::plan::{self, PlanArguments};
use super::progress::Progress;
use super::{output, run};
use platewash::planner::certificate;
use platewash::planner::cycle::CycleReport;
use platewash::{Cycle, Scenario};

/// Plans the cycle and writes the plan and its CSV; nothing is proved.
pub fn plan(options: &Options, scenario: &Scenario, arguments: &PlanArguments) -> Result<ExitCode, Failure> {
    let cycle = carry_out(options, scenario)?;
    let plan = cycle.to_plan()?;
    let files = vec![
        (plan::folder(options).join("plan.json"), plan.to_json()?),
        (plan::csv_file(options, arguments), csv(&cycle, arguments)?),
    ];
    output::write_files(&files)?;
    output::print_either(options.json, &plan.summary, || {
        format!("{}\nnot proved yet: platewash verify\n", plan.summary.headline)
    })?;
    plan::name_files(options, &files);
    Ok(ExitCode::SUCCESS)
}

/// Plans the cycle, proves it, and writes plan, CSV, certificate and report.
pub fn run(options: &Options, scenario: &Scenario, arguments: &PlanArguments) -> Result<ExitCode, Failure> {
    let cycle = carry_out(options, scenario)?;
    let plan = cycle.to_plan()?;
    let certificate = certificate::verify(&plan, &cycle.robot).map_err(Failure::internal)?;
    let report = CycleReport::new(&cycle, certificate);
    let folder = plan::folder(options);
    let text = report.to_string();
    let files = vec![
        (folder.join("plan.json"), plan.to_json()?),
        (plan::csv_file(options, arguments), csv(&cycle, arguments)?),
        (folder.join("certificate.json"), output::json(&report.certificate)?),
        (folder.join("report.json"), output::json(&report)?),
        (folder.join("report.txt"), text.clone()),
    ];
    output::write_files(&files)?;
    output::print_either(options.json, &report, || text)?;
    plan::name_files(options, &files);
    Ok(run::exit_code(report.verdict, scenario.job.on_failure))
}

fn carry_out(options: &Options, scenario: &Scenario) -> Result<Cycle, Failure> {
    let _progress = Progress::new(options.quiet, "planning");
    let cycle = Cycle::plan(scenario)?;
    tracing::info!("planned {} knots", cycle.motion.times().len());
    Ok(cycle)
}

fn csv(cycle: &Cycle, arguments: &PlanArguments) -> Result<String, Failure> {
    let scenario = &cycle.scenario;
    plan::motion_csv(scenario, &cycle.robot, &cycle.motion, &cycle.segments, arguments)
}
