//! Jobs that cannot be done, or for which no way was found: what is said and written of them.

use super::exit::Outcome;
use super::failure::{ExitCode, Failure};
use super::options::Options;
use super::text::text;
use super::{output, results};
use platewash::Scenario;
use platewash::paper::PaperError;
use platewash::planner::{InfeasibleReport, PlanError};
use serde::Serialize;

/// A scenario of which nothing can come.
#[derive(Serialize)]
struct NotValid {
    valid: bool,
    #[serde(flatten)]
    why: InfeasibleReport,
}

/// What is to be said of a scenario that could not be carried out; `None` where the input is at fault.
pub fn report(scenario: &Scenario, failure: &platewash::Failure) -> Option<InfeasibleReport> {
    use platewash::Failure::{Layout, Paper, Plan};
    let new = |error: &PlanError| InfeasibleReport::new(&scenario.name, scenario.seed, error);
    let report = match failure {
        Plan(error) => new(error),
        Layout(error) | Paper(PaperError::Layout(error)) => new(&PlanError::Layout(error.clone())),
        _ => None,
    };
    // With the keys that decide it.
    Some(report?.explained(failure.to_string()))
}

/// The end of a job that was not carried out: where it cannot be done, that is reported in place of what earlier calls left.
pub fn end(options: &Options, scenario: &Scenario, failure: platewash::Failure) -> Result<ExitCode, Failure> {
    let Some(report) = report(scenario, &failure) else {
        return Err(options.failure(failure));
    };
    let folder = results::folder(options);
    let words = text(&report);
    let files = vec![
        output::file(folder.join("report.json"), output::json(&report)?),
        output::file(folder.join("report.txt"), &words),
    ];
    results::write(options, &files)?;
    output::print_either(options.json, &report, || words.clone())?;
    results::name(options, &files);
    Ok(Outcome::from(report.verdict).job(scenario.job.on_failure))
}

/// With `--json`, gives what stands against a scenario (exit code 3) as an answer on standard output too.
pub fn answer(options: &Options, scenario: &Scenario, failure: &Failure) -> Result<(), Failure> {
    let why = failure.of_scenario().filter(|_| options.json);
    if let Some(why) = why.and_then(|failure| report(scenario, failure)) {
        output::print(&output::json(&NotValid { valid: false, why })?)?;
    }
    Ok(())
}
