//! `platewash simulate`: a plan under a control law, and what is left of the wash.

use super::details::{DetailArguments, whole};
use super::exit::Outcome;
use super::failure::{ExitCode, Failure};
use super::law::{LawArguments, positive};
use super::options::Options;
use super::plan_file::PlanFile;
use super::progress::Progress;
use super::time_step::TimeStep;
use super::{execution, output, results};
use clap::Args;
use platewash::Plan;
use platewash::simulator::simulate::table;
use platewash::workcell::simulation::SimulationSettings;
use std::path::PathBuf;

/// Arguments of `simulate`.
#[derive(Debug, Args)]
pub struct SimulateArguments {
    /// Plan file
    #[arg(value_name = "PLAN")]
    pub plan: PathBuf,
    #[command(flatten)]
    pub law: LawArguments,
    /// Natural frequency in rad/s [default: the plan's]
    #[arg(long, value_name = "RAD/S", value_parser = positive, allow_negative_numbers = true)]
    pub frequency: Option<f64>,
    /// Damping ratio [default: the plan's]
    #[arg(long, value_name = "RATIO", value_parser = positive, allow_negative_numbers = true)]
    pub damping: Option<f64>,
    #[command(flatten)]
    pub time_step: TimeStep,
    #[command(flatten)]
    pub details: DetailArguments,
}

impl SimulateArguments {
    fn settings(&self, plan: &Plan) -> SimulationSettings {
        let mut settings = self.law.settings(plan);
        let control = &mut settings.control;
        if self.frequency.is_some() || self.damping.is_some() {
            // A frequency or a damping that is asked for is not overruled by gains of the plan.
            (control.joint_kp, control.joint_kd) = (None, None);
        }
        control.frequency_rad_s = self.frequency.unwrap_or(control.frequency_rad_s);
        control.damping_ratio = self.damping.unwrap_or(control.damping_ratio);
        settings
    }
}

/// Simulates a plan file, judges the execution, and writes it as CSV and the report.
pub fn run(options: &Options, arguments: &SimulateArguments) -> Result<ExitCode, Failure> {
    let folder = results::folder(options);
    let places = results::SIMULATED.map(|name| folder.join(name));
    output::check_places(&places)?;
    let file = PlanFile::read(options, &arguments.plan)?;
    let (plan, settings) = (&file.plan, arguments.settings(&file.plan));
    let stated_s = plan.job.simulation.control.dt_s;
    let dt_s = arguments
        .time_step
        .or(stated_s, execution::lasts_at_most_s(plan, &settings))?;
    let (execution, report) = {
        let _progress = Progress::new(options.quiet, "simulating");
        execution::carry_out(plan, &file.arm, &settings, &options.cancel).map_err(|e| file.failure(e.into()))?
    };
    let csv = table(&execution, plan, &file.arm, dt_s)?;
    let [motion, data, sheet] = places.clone();
    let files = [
        output::file(motion, csv),
        output::file(data, output::json(&report)?),
        output::file(sheet, whole(&report)),
    ];
    output::replace(&files, &places, &options.cancel)?;
    output::print_either(options.json, &report, || arguments.details.printed(&report))?;
    results::name(options, &files);
    Ok(Outcome::from(report.verdict).answer())
}
