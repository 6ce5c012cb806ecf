//! `platewash scenario`: the text of a shipped scenario.

use super::failure::{ExitCode, Failure};
use super::options::Options;
use super::output;
use clap::Args;
use platewash::scenario::{SHIPPED, source};
use serde::Serialize;
use std::fmt::Write;

/// Arguments of `scenario`.
#[derive(Debug, Args)]
pub struct ScenarioArguments {
    /// Name of a shipped scenario; without it, all names are listed
    #[arg(value_name = "NAME")]
    pub name: Option<String>,
}

#[derive(Serialize)]
struct Listed {
    name: &'static str,
    about: String,
}

/// Prints a shipped scenario as it is, comments included, or lists the shipped scenarios.
pub fn run(options: &Options, arguments: &ScenarioArguments) -> Result<ExitCode, Failure> {
    match &arguments.name {
        Some(name) => {
            let found = source(name)?;
            output::print_either(options.json, &found.text, || found.text.clone())?;
        }
        None => {
            let all = SHIPPED.iter().map(|shipped| Listed {
                name: shipped.name,
                about: about(shipped.text),
            });
            let all: Vec<Listed> = all.collect();
            output::print_either(options.json, &all, || listed(&all))?;
        }
    }
    Ok(ExitCode::SUCCESS)
}

/// The first sentence of the comment at the head of a scenario.
fn about(text: &str) -> String {
    let lines = text.lines().map_while(|line| line.strip_prefix('#'));
    let words = lines.map(str::trim).collect::<Vec<_>>().join(" ");
    words
        .split_once(". ")
        .map_or(words.clone(), |(first, _)| first.to_owned())
}

fn listed(all: &[Listed]) -> String {
    let mut text = String::new();
    for Listed { name, about } in all {
        let _ = writeln!(text, "{name:<15} {}", about.trim_end_matches('.').replace('`', ""));
    }
    text
}
