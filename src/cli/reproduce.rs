//! `platewash reproduce`: what the paper's program really does, measured.

use super::failure::{ExitCode, Failure};
use super::options::Options;
use super::output;
use super::progress::Progress;
use anyhow::anyhow;
use clap::Args;
use platewash::paper::reproduce::{ReproduceSettings, reproduce};

/// Arguments of `reproduce`.
#[derive(Debug, Args)]
pub struct ReproduceArguments {
    /// Number of layouts to simulate in each of the paper's two regions
    #[arg(long, value_name = "N", default_value_t = ReproduceSettings::default().layouts)]
    layouts: usize,
    /// Number of random layouts to start, to measure how often placing plates fails
    #[arg(long, value_name = "N", default_value_t = ReproduceSettings::default().draws)]
    draws: usize,
}

/// Measures and prints the table; with `--out`, writes `reproduce.json` and `reproduce.txt`.
pub fn run(options: &Options, arguments: &ReproduceArguments) -> Result<ExitCode, Failure> {
    for (name, value, most) in [
        ("--layouts", arguments.layouts, ReproduceSettings::MOST_LAYOUTS),
        ("--draws", arguments.draws, ReproduceSettings::MOST_DRAWS),
    ] {
        if !(1..=most).contains(&value) {
            return Err(Failure::input(anyhow!(
                "{name} must be from 1 to {most}; found {value}"
            )));
        }
    }
    let settings = ReproduceSettings {
        layouts: arguments.layouts,
        draws: arguments.draws,
        seed: options.seed.unwrap_or(ReproduceSettings::default().seed),
    };
    let places = options
        .out
        .as_ref()
        .map(|folder| ["reproduce.json", "reproduce.txt"].map(|name| folder.join(name)));
    output::check_places(places.as_ref().map_or(&[][..], |places| places))?;
    let progress = Progress::new(options.quiet, "measuring dead ends");
    let result = reproduce(&settings, &options.cancel, &|done, total| progress.note(done, total));
    drop(progress);
    let result = result.map_err(platewash::Failure::from)?;
    if let Some([json, text]) = places {
        let files = [output::file(json, output::json(&result)?), output::file(text, &result)];
        output::write_files(&files, &options.cancel)?;
        output::message(
            options.quiet,
            &format!("wrote {}, {}", files[0].0.display(), files[1].0.display()),
        );
    }
    output::print_either(options.json, &result, || result.to_string())?;
    Ok(ExitCode::SUCCESS)
}
