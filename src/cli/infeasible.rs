//! Jobs that cannot be done, or for which no way was found: what is said and written of them.

use super::failure::ExitCode;
use super::files::{Files, RESULTS};
use super::options::Options;
use super::output::{self, full_report};
use anyhow::{Error, Result};
use platewash::planner::{InfeasibleReport, PlanError, Watch, other_unwashable_plates};
use platewash::scenario::Remedies;
use platewash::workcell::cancel::system_clock;
use platewash::{Certificate, Failure, RobotModel, Scenario};
use serde::Serialize;
use std::fmt;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Work that the progress display names during the search.
const LOOKING: &str = "searching for keys whose change helps";

/// JSON answer for a scenario that cannot be carried out.
#[derive(Serialize)]
struct InvalidAnswer {
    valid: bool,
    #[serde(flatten)]
    why: InfeasibleReport,
}

/// Answer for a job that cannot be done.
#[derive(Serialize)]
struct InfeasibleAnswer {
    #[serde(flatten)]
    why: InfeasibleReport,
    /// Changes that were tried as remedies, one key each.
    remedies: Remedies,
}

impl fmt::Display for InfeasibleAnswer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.why.fmt(f)
    }
}

/// The report with all plates that cannot be washed, and with the keys whose change helps.
fn in_full(
    options: &Options,
    scenario: &Scenario,
    failure: &Failure,
    why: InfeasibleReport,
    search_time: Duration,
) -> Result<InfeasibleAnswer, Failure> {
    // No keys are tried for the paper's program.
    let Some(error) = failure.plan_error().filter(|_| !matches!(failure, Failure::Paper(_))) else {
        let remedies = Remedies::default();
        return Ok(InfeasibleAnswer { why, remedies });
    };
    let progress = options.progress(LOOKING);
    let watch = progress.watch(&options.cancel);
    let arm = scenario.arm()?;
    let start = Instant::now();
    let (why, others) = match error.as_ref() {
        PlanError::Unwashable(first) => {
            let job = scenario.job_on(&arm, &scenario.place(&arm, &watch)?)?;
            // The other half of the time is left for the search for remedies.
            let is_over = watch.cancel.within(search_time / 2, system_clock);
            let others = Watch {
                cancel: &is_over,
                ..watch
            };
            match other_unwashable_plates(&job, first, &others) {
                Err(PlanError::Cancelled(_)) if !options.cancel.is_cancelled() => {
                    (why, "; there was no time to check the other plates fully")
                }
                others => (why.with_plates(&others?), ""),
            }
        }
        _ => (why, ""),
    };
    let left = search_time.saturating_sub(start.elapsed());
    let remedies = scenario.remedies(&arm, &error, &watch, left)?;
    let reason = format!("{}{others}{remedies}", why.reason);
    let why = why.explained(reason);
    Ok(InfeasibleAnswer { why, remedies })
}

/// Keys with which a plan would be proved; `None` where it is.
pub fn remedies_of_proof(
    options: &Options,
    scenario: &Scenario,
    (arm, certificate): (&Arc<RobotModel>, &Certificate),
    search_time: Duration,
) -> Result<Option<Remedies>> {
    if certificate.passes() {
        return Ok(None);
    }
    let progress = options.progress(LOOKING);
    let watch = progress.watch(&options.cancel);
    let remedies = scenario.remedies_of_proof(arm, certificate, &watch, search_time)?;
    Ok(Some(remedies))
}

/// Ends a job that was not carried out. Where the job cannot be done, a report replaces the files of earlier calls.
pub fn end(options: &Options, scenario: &Scenario, error: Error, search_time: Duration) -> Result<ExitCode> {
    let failure: Failure = error.downcast()?;
    let Some(report) = failure.report(&scenario.name, scenario.seed) else {
        return Err(options.failure(failure));
    };
    let report = in_full(options, scenario, &failure, report, search_time)?;
    let mut files = Files::new(options.folder(), &RESULTS);
    files.add_report("report", &report)?;
    files.answer(options, &report, || full_report(&report))?;
    Ok(ExitCode::from(report.why.verdict).job(scenario.job.on_failure))
}

/// Prints the report on a scenario that cannot be carried out (exit code 3) on standard output, with `--json` only.
pub fn answer(options: &Options, scenario: &Scenario, error: &Error) -> Result<()> {
    let failure: Option<&Failure> = error.downcast_ref().filter(|_| options.json);
    if let Some(why) = failure.and_then(|failure| failure.report(&scenario.name, scenario.seed)) {
        output::print(&output::json(&InvalidAnswer { valid: false, why })?)?;
    }
    Ok(())
}
