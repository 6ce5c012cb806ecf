//! The control law of `simulate` and `tune`.

use anyhow::{Context, ensure};
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use platewash::Plan;
use platewash::workcell::simulation::{ControlLawName, SimulationSettings};

/// The control law, where it is not the plan's.
#[derive(Debug, Args)]
pub struct LawArguments {
    /// Control law [default: the plan's]
    #[arg(long, value_name = "LAW", value_parser = laws())]
    pub law: Option<ControlLawName>,
    /// Sample rate of a torque law in Hz [default: the plan's]
    #[arg(long, value_name = "HZ", value_parser = positive, allow_negative_numbers = true)]
    pub rate: Option<f64>,
}

impl LawArguments {
    /// The settings that the plan states, but for what the arguments say.
    pub fn settings(&self, plan: &Plan) -> SimulationSettings {
        let mut settings = plan.job.simulation.clone();
        settings.law = self.law.unwrap_or(settings.law);
        settings.control.rate_hz = self.rate.unwrap_or(settings.control.rate_hz);
        settings
    }
}

fn laws() -> impl TypedValueParser<Value = ControlLawName> {
    let names = ControlLawName::ALL.map(ControlLawName::name);
    PossibleValuesParser::new(names).try_map(|name| ControlLawName::named(&name).context("no such law"))
}

/// A finite number above 0.
pub fn positive(text: &str) -> anyhow::Result<f64> {
    let expected = "must be a finite number above 0";
    let number: f64 = text.trim().parse().context(expected)?;
    ensure!(number.is_finite() && number > 0.0, expected);
    Ok(number)
}
