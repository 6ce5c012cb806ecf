//! `--details`: the whole report, not one screen of it.

use super::text::text;
use clap::Args;
use std::fmt::Display;

/// Last line of a report that leaves something out.
const HINT: &str = "\nmore: --details\n";

/// `--details`.
#[derive(Debug, Args, Default)]
pub struct DetailArguments {
    /// Print the whole report: every requirement, plate, pair of bodies and assumption
    #[arg(long)]
    details: bool,
}

impl DetailArguments {
    /// The report as it is printed.
    pub fn printed(&self, report: &impl Display) -> String {
        let (short, whole) = (text(report), whole(report));
        match self.details || short == whole {
            true => whole,
            false => short + HINT,
        }
    }
}

/// The whole report, as files hold it.
pub fn whole(report: &impl Display) -> String {
    text(&format_args!("{report:#}"))
}
