//! `platewash reproduce`: what the paper's program really does, measured.

use super::failure::ExitCode;
use super::files::Files;
use super::options::Options;
use anyhow::Result;
use clap::Args;
use clap::builder::RangedU64ValueParser;
use platewash::paper::reproduce::{ReproduceSettings, reproduce};

/// Arguments of `reproduce`.
#[derive(Debug, Args)]
pub struct ReproduceArguments {
    /// Number of layouts to simulate in each of the paper's two regions
    #[arg(long, value_name = "N", default_value_t = ReproduceSettings::default().layouts, value_parser = RangedU64ValueParser::<usize>::new().range(1..=ReproduceSettings::MOST_LAYOUTS as u64))]
    layouts: usize,
    /// Number of random layouts to start, to measure how often placing plates fails
    #[arg(long, value_name = "N", default_value_t = ReproduceSettings::default().draws, value_parser = RangedU64ValueParser::<usize>::new().range(1..=ReproduceSettings::MOST_DRAWS as u64))]
    draws: usize,
}

/// Measures and prints the table; with `--out`, writes `reproduce.json` and `reproduce.txt`.
pub fn run(options: &Options, arguments: &ReproduceArguments) -> Result<ExitCode> {
    let settings = ReproduceSettings {
        layouts: arguments.layouts,
        draws: arguments.draws,
        seed: options.seed.unwrap_or(ReproduceSettings::default().seed),
    };
    let mut files = Files::new(options.out.clone(), &["reproduce.json", "reproduce.txt"]);
    files.check()?;
    let progress = options.progress("measuring dead ends");
    let result = reproduce(&settings, &options.cancel, &|done, total| progress.layouts(done, total));
    drop(progress);
    let result = result.map_err(platewash::Failure::from)?;
    files.add_report("reproduce", &result)?;
    files.answer(options, &result, || result.to_string())?;
    Ok(ExitCode::Done)
}
