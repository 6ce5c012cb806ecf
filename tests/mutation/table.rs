//! The summary: a line for each kind of edit.

use crate::mutation::edit::{Edit, Kind};
use crate::mutation::judge::Outcome;

/// Prints how many edits of each kind there were and what came of them; `cargo test --test main mutation -- --nocapture` shows it.
pub fn print(edits: &[Edit], outcomes: &[Outcome]) {
    let line = |words: &str, [all, sampled, refused]: [usize; 3]| {
        println!("{words:<18} {all:>5} {sampled:>9} {refused:>8} {:>7}", all - refused);
    };
    println!(
        "{:<18} {:>5} {:>9} {:>8} {:>7}",
        "edit of", "edits", "by sample", "refused", "passed"
    );
    let mut sum = [0; 3];
    for kind in Kind::ALL {
        let of_kind = || edits.iter().zip(outcomes).filter(|(e, _)| e.kind == kind);
        let counts = [
            of_kind().count(),
            of_kind().filter(|(_, o)| !o.sampled.is_empty()).count(),
            of_kind().filter(|(_, o)| !o.refused.is_empty()).count(),
        ];
        line(kind.words(), counts);
        (0..3).for_each(|i| sum[i] += counts[i]);
    }
    line("all", sum);
}
