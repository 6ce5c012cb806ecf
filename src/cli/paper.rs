//! The paper's program, with a sign of life.

use super::failure::Failure;
use super::motion::MotionArguments;
use super::options::Options;
use super::output::{self, File};
use super::progress::Progress;
use super::results;
use platewash::paper::run_with;
use platewash::viewer::view::Executed;
use platewash::workcell::csv::MotionTable;
use platewash::workcell::trajectory::PlanSegment;
use platewash::workcell::words::counted;
use platewash::{PaperReport, PaperRun, Scenario, Verdict};

/// A run of the paper's program, judged.
pub struct Followed {
    /// The run.
    pub run: PaperRun,
    /// How it went.
    pub report: PaperReport,
    segments: Vec<PlanSegment>,
}

/// Plans, follows and judges a scenario that is not too much work.
pub fn follow(options: &Options, scenario: &Scenario) -> Result<Followed, platewash::Failure> {
    let _progress = Progress::new(options.quiet, "planning");
    let arm = options.arm(scenario)?;
    let layout = scenario.layout(&arm)?;
    let run = run_with(&scenario.paper_job_on(&arm, layout)?, &options.cancel)?;
    tracing::info!(
        "planned {} waypoints on {}",
        run.tool_path.len(),
        counted(run.job.layout.plates.len(), "plate")
    );
    let report = run.report_with(&options.cancel)?;
    tracing::info!("checked {} violations", report.executed.violations.len());
    let segments = run.segments();
    Ok(Followed { run, report, segments })
}

impl Followed {
    /// The plan file and the planned motion's CSV, not written yet.
    pub fn files<'a>(
        &'a self,
        options: &Options,
        scenario: &Scenario,
        arguments: &MotionArguments,
    ) -> Result<Vec<File<'a>>, Failure> {
        let csv = arguments.table(scenario, &self.run.job.arm, &self.run.planned, &self.segments)?;
        let plan = self.run.plan().and_then(|plan| plan.to_json());
        Ok(vec![
            output::file(
                results::folder(options).join("plan.json"),
                plan.map_err(platewash::Failure::from)?,
            ),
            output::file(arguments.csv_file(options), csv),
        ])
    }

    /// The motion that the control law makes of it, as a page shows it.
    pub fn as_executed(&self) -> Executed {
        let (run, washed) = (&self.run, self.report.verdict == Verdict::Swept);
        Executed::followed(&run.executed, run.job.simulation.law, &self.report.headline, washed)
    }

    /// The motion that the control law makes of it, as CSV.
    pub fn executed<'a>(
        &'a self,
        scenario: &Scenario,
        arguments: &MotionArguments,
    ) -> Result<MotionTable<'a>, Failure> {
        arguments.table(scenario, &self.run.job.arm, &self.run.executed, &self.segments)
    }
}
