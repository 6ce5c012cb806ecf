//! The time step of CSV files.

use super::failure::Failure;
use anyhow::{Context, anyhow, ensure};
use clap::Args;
use platewash::scenario::TIME_STEPS_S;
use platewash::workcell::csv::{CsvError, MAX_ROWS, check_step};

/// `--dt`.
#[derive(Debug, Args, Default)]
pub struct TimeStep {
    /// Time step of the CSV files in seconds, 0.000001 to 10 [default: the scenario's control.dt_s]
    #[arg(long, value_name = "S", value_parser = time_step, allow_negative_numbers = true)]
    pub dt: Option<f64>,
}

impl TimeStep {
    /// The time step \[s\], by default the one that is stated, if it gives not too many rows for `duration_s` of motion; the step that
    /// is suggested otherwise is accepted when it is typed in.
    pub fn or(&self, stated_s: f64, duration_s: f64) -> Result<f64, Failure> {
        let dt_s = self.dt.unwrap_or(stated_s);
        self.check(duration_s, dt_s).map_err(Failure::input)?;
        Ok(dt_s)
    }

    fn check(&self, duration_s: f64, dt_s: f64) -> anyhow::Result<()> {
        let (key, instead) = match self.dt {
            Some(_) => ("--dt", ""),
            None => ("control.dt_s", ", there or as --dt"),
        };
        let [_, most] = TIME_STEPS_S;
        let as_most = check_step(duration_s, most);
        as_most.map_err(|_| {
            anyhow!(
                "no time step up to {most} s gives at most {MAX_ROWS} rows of CSV for {duration_s:.0} s of motion: wash.speed_m_s, \
                 wash.acceleration_m_s2 and the keys of [limits] decide how long it takes"
            )
        })?;
        check_step(duration_s, dt_s).map_err(|error: CsvError| anyhow!("{key}: {error}{instead}"))
    }
}

fn time_step(text: &str) -> anyhow::Result<f64> {
    let [least, most] = TIME_STEPS_S;
    let expected = || format!("must be a positive number of seconds, from {least} to {most}");
    let dt_s: f64 = text.trim().parse().with_context(expected)?;
    ensure!((least..=most).contains(&dt_s), expected());
    Ok(dt_s)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Whatever is refused: the step suggested, typed in, is accepted, by the parser and by the table.
        #[test]
        fn a_suggested_step_is_accepted_as_an_option(mantissa in 1.0..10.0_f64, exponent in 0..7_i32, asked in -6.0..1.0_f64) {
            let duration_s = mantissa * 10_f64.powi(exponent);
            let dt = time_step(&10_f64.powf(asked).to_string()).ok();
            let Err(error) = (TimeStep { dt }).check(duration_s, dt.unwrap_or(1.0)) else { return Ok(()) };
            let message = error.to_string();
            if message.starts_with("no time step") {
                prop_assert!(duration_s > 0.99e7);
                return Ok(());
            }
            let suggested = message.split("at least ").nth(1).and_then(|s| s.split(' ').next()).unwrap();
            let dt_s = time_step(suggested).unwrap();
            prop_assert!(TimeStep { dt: Some(dt_s) }.check(duration_s, dt_s).is_ok(), "{message}");
        }
    }

    #[test]
    fn steps_out_of_the_range_of_the_key_are_refused() {
        for text in ["0", "-1", "1e-9", "1e9", "nan", "inf", "x"] {
            let message = time_step(text).unwrap_err().to_string();
            assert!(message.contains("from 0.000001 to 10"), "{text}: {message}");
        }
        assert_eq!((time_step("1e-6").unwrap(), time_step("10").unwrap()), (1e-6, 10.0));
    }
}
