//! `platewash layout`: the plates and what is wrong with them.

use super::exit::Outcome;
use super::failure::{ExitCode, Failure};
use super::options::Options;
use super::{infeasible, output};
use platewash::workcell::layout::{Layout, LayoutSource};
use platewash::workcell::words::counted;
use std::fmt::Write;

/// Places the plates; with `--out`, writes `layout.json`.
pub fn run(options: &Options) -> Result<ExitCode, Failure> {
    let scenario = options.scenario()?;
    let robot = options.arm(&scenario)?;
    let placed = scenario.layout(&robot).map_err(platewash::Failure::from);
    let placed = placed.map_err(Failure::from);
    if let Err(failure) = &placed {
        infeasible::answer(options, &scenario, failure)?;
    }
    let layout = placed?;
    if let Some(folder) = &options.out {
        let file = folder.join("layout.json");
        output::write_files(&[output::file(file.clone(), output::json(&layout)?)], &options.cancel)?;
        output::message(options.quiet, &format!("wrote {}", file.display()));
    }
    output::print_either(options.json, &layout, || text(&layout))?;
    let outcome = match scenario.forbids(&layout) {
        true => Outcome::Infeasible,
        false => Outcome::Good,
    };
    Ok(outcome.answer())
}

fn text(layout: &Layout) -> String {
    let mut text = match layout.source {
        LayoutSource::Sampled { restarts, draws } => {
            let (restarts, draws) = (counted(restarts as usize, "restart"), counted(draws as usize, "draw"));
            format!("sampled, {restarts}, {draws}\n")
        }
        LayoutSource::Explicit => "given\n".to_owned(),
    };
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "{:<6} {:>9} {:>9} {:>9} {:>9}",
        "plate", "x, m", "y, m", "z, m", "radius, m"
    );
    for (i, plate) in layout.plates.iter().enumerate() {
        let (at, radius_m) = (plate.centre(), plate.rim_m());
        let tilted = plate
            .tilt_words()
            .map_or_else(String::new, |tilted| format!("  {tilted}"));
        let _ = writeln!(
            text,
            "{i:<6} {:>9.4} {:>9.4} {:>9.4} {radius_m:>9.4}{tilted}",
            at.x, at.y, at.z
        );
    }
    for finding in &layout.findings {
        let _ = writeln!(text, "  - {finding}");
    }
    text
}
