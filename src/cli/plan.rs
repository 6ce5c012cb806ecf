//! `platewash plan`: the plan file and its CSV.

use super::exit::Outcome;
use super::failure::{ExitCode, Failure};
use super::motion::MotionArguments;
use super::options::Options;
use super::{infeasible, output, paper, results, wash};
use platewash::certificate::planned_headline;
use platewash::scenario::Program;
use platewash::{PaperReport, Plan, Scenario};
use serde::Serialize;

/// What `plan` says of a plan.
#[derive(Debug, Serialize)]
struct Answer {
    /// Always false: proving is for `run` and `verify`.
    proved: bool,
    headline: String,
    /// Plates in the order of washing.
    plates: usize,
    duration_s: f64,
    #[serde(flatten)]
    waypoints: Option<Waypoints>,
}

/// What the paper's program makes of its waypoints.
#[derive(Debug, Serialize)]
struct Waypoints {
    plates_washed: usize,
    /// Waypoints solved and asked.
    waypoints_reached: [usize; 2],
}

/// Plans the scenario and writes the plan and its CSV; nothing is proved.
pub fn run(options: &Options, arguments: &MotionArguments) -> Result<ExitCode, Failure> {
    let scenario = options.scenario()?;
    results::check_places(options, &["plan.json"], &arguments.csv_file(options))?;
    match scenario.job.program {
        Program::Certified => plan_washing(options, &scenario, arguments),
        Program::Paper => follow_paper(options, &scenario, arguments),
    }
}

fn plan_washing(options: &Options, scenario: &Scenario, arguments: &MotionArguments) -> Result<ExitCode, Failure> {
    let washing = match wash::plan(options, scenario) {
        Ok(washing) => washing,
        Err(failure) => return infeasible::end(options, scenario, failure, arguments.search_time()),
    };
    let files = washing.files(options, scenario, arguments)?;
    results::write(options, &files)?;
    let answer = Answer::of_washing(&washing.planned.plan);
    output::print_either(options.json, &answer, || {
        format!("{}\nplatewash verify proves it\n", answer.headline)
    })?;
    results::name(options, &files);
    Ok(ExitCode::SUCCESS)
}

fn follow_paper(options: &Options, scenario: &Scenario, arguments: &MotionArguments) -> Result<ExitCode, Failure> {
    let followed = match paper::follow(options, scenario) {
        Ok(followed) => followed,
        Err(failure) => return infeasible::end(options, scenario, failure, arguments.search_time()),
    };
    let files = followed.files(options, scenario, arguments)?;
    results::write(options, &files)?;
    let answer = Answer::of_paper(&followed.report);
    output::print_either(options.json, &answer, || {
        let [reached, asked] = followed.report.waypoints_reached();
        let line = format!(
            "{reached} of {asked} waypoints reached, {:.2} s of motion",
            answer.duration_s
        );
        format!("{}\n{line}\n", answer.headline)
    })?;
    results::name(options, &files);
    Ok(Outcome::from(followed.report.verdict).job(scenario.job.on_failure))
}

impl Answer {
    fn of_washing(plan: &Plan) -> Self {
        let (plates, duration_s) = (plan.order.len(), plan.duration_s());
        Self {
            proved: false,
            headline: planned_headline(plan),
            plates,
            duration_s,
            waypoints: None,
        }
    }

    fn of_paper(report: &PaperReport) -> Self {
        Self {
            proved: false,
            headline: format!("PLANNED, NOT PROVED: {}", report.headline),
            plates: report.plates.len(),
            duration_s: report.duration_s,
            waypoints: Some(Waypoints {
                plates_washed: report.plates_washed(),
                waypoints_reached: report.waypoints_reached(),
            }),
        }
    }
}
