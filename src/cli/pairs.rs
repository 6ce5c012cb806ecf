//! The pairs of bodies that a table names.

use clap::Args;
use platewash::certificate::PairsShown;

/// `--all-pairs`.
#[derive(Debug, Args, Default)]
pub struct PairArguments {
    /// Name every pair of bodies, not the ten tightest alone
    #[arg(long)]
    all_pairs: bool,
}

impl PairArguments {
    /// The pairs asked for.
    pub fn shown(&self) -> PairsShown {
        if self.all_pairs {
            PairsShown::All
        } else {
            PairsShown::Tightest
        }
    }
}
