//! `platewash study`: scenarios by the thousand, each planned and proved, every row kept as soon as it is done.

use super::failure::ExitCode;
use super::files::{place, write_to};
use super::options::Options;
use super::output;
use anyhow::{Context, Result, bail};
use clap::{Args, Subcommand};
use platewash::study::{self, AxisValue, Journal, Outcome, Row, RowMaker, Study, StudyError, Summary};
use std::fmt::Write as _;
use std::io::{BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Arguments of `study`.
#[derive(Debug, Args)]
pub struct StudyArguments {
    #[command(subcommand)]
    verb: StudyVerb,
}

#[derive(Debug, Subcommand)]
enum StudyVerb {
    /// Plan and prove the missing rows, and save each row in the folder of --out when it is done
    ///
    /// Call it again to resume after a stop. Exit code 0 if all rows are done, whatever their results; 1 if the program itself failed
    /// on a row.
    Run {
        /// Study file, or the folder of a study
        file: PathBuf,
    },
    /// Summarize a study: outcomes by axis, durations, and the rows to look at
    Show {
        /// Folder of the study
        folder: PathBuf,
    },
    /// Write the rows as JSON Lines in order; the bytes do not depend on how the study was run
    Export {
        /// Folder of the study
        folder: PathBuf,
        /// Output file [default: standard output]
        #[arg(long, value_name = "FILE")]
        to: Option<PathBuf>,
        /// Allow a study that is not finished
        #[arg(long)]
        partial: bool,
    },
    /// Print the scenario of one row, to plan it alone
    Scenario {
        /// Study file, or the folder of a study
        file: PathBuf,
        /// Index of the row, from 0
        #[arg(long, value_name = "N")]
        row: u64,
    },
}

/// Does what is asked of a study.
pub fn run(options: &Options, arguments: &StudyArguments) -> Result<ExitCode> {
    if options.out.is_some() && !matches!(arguments.verb, StudyVerb::Run { .. }) {
        bail!("--out: is of study run alone; export writes where --to says");
    }
    match &arguments.verb {
        StudyVerb::Run { file } => return work(options, file),
        StudyVerb::Show { folder } => {
            let summary = study::summary(folder)?;
            options.print(&summary, || summary_text(&summary, folder))?;
        }
        StudyVerb::Export { folder, to, partial } => export(folder, to.as_deref(), *partial)?,
        StudyVerb::Scenario { file, row } => {
            output::print(&Study::load(file)?.scenario_text(*row)?)?;
        }
    }
    Ok(ExitCode::Done)
}

fn work(options: &Options, file: &Path) -> Result<ExitCode> {
    let folder = options.out.as_deref();
    let folder = folder.context("study run needs --out DIR, where rows are kept")?;
    let study = Arc::new(Study::load(file)?);
    let mut journal = Journal::open(folder, &study)?;
    let (before, rows) = (journal.done(), study.rows());
    if before == rows {
        journal.finish()?;
        let folder = folder.display();
        options.say(&format!("{folder}: the study is finished, all {rows} rows are there"));
    } else {
        if before > 0 {
            options.say(&format!("going on: {before} of {rows} rows are there"));
        }
        let maker = RowMaker::new(study);
        let progress = options.progress("planning and proving");
        let made = study::run(
            &mut journal,
            &options.cancel,
            |index, cancel| maker.row(index, cancel),
            |at| progress.rows(&at),
        );
        drop(progress);
        let done = journal.done();
        if made.is_err() && done < rows {
            options.say(&format!(
                "{done} of {rows} rows are kept; the same command goes on with the others"
            ));
        }
        made?;
    }
    let summary = study::summary(folder)?;
    options.print(&summary, || outcomes(&summary))?;
    Ok(ExitCode::Internal.unless(!summary.outcomes.contains_key(Outcome::Crashed.code())))
}

fn export(folder: &Path, to: Option<&Path>, partial: bool) -> Result<()> {
    let (done, rows) = study::count_rows(folder)?;
    if done < rows && !partial {
        bail!(
            "{}: the study is not finished: {done} of {rows} rows; go on with it, or take what is there: --partial",
            folder.display()
        );
    }
    let Some(to) = to else {
        let out = &mut BufWriter::new(std::io::stdout().lock()) as &mut dyn Write;
        return match study::export(folder, out, Path::new("standard output")) {
            // A reader that has gone away is no error.
            Err(StudyError::Disk { cause, .. }) if cause.kind() == ErrorKind::BrokenPipe => Ok(()),
            written => Ok(written.map(drop)?),
        };
    };
    let cannot = || format!("{}: cannot be written", to.display());
    let place_of = |path: &Path| place(path).with_context(cannot);
    let (file, kept) = (place_of(to)?, place_of(&folder.join("rows.jsonl"))?);
    if kept.parent().is_some_and(|folder| file.starts_with(folder)) {
        bail!("{}: it is in the study's folder, which is kept as it is", cannot());
    }
    write_to(to, |out| Ok(study::export(folder, out, to).map(drop)?))
}

/// One line that counts the rows by outcome.
fn outcomes(of: &Summary) -> String {
    let counts = Outcome::ALL.iter().filter_map(|outcome| {
        let count = of.outcomes.get(outcome.code())?;
        Some(format!("{count} {}", outcome.code()))
    });
    let mut counts = counts.collect::<Vec<_>>().join(", ");
    if counts.is_empty() {
        counts = "no row yet".to_owned();
    }
    let (name, rows) = (&of.manifest.name, of.manifest.rows);
    format!("study {name}: {} of {rows} rows: {counts}\n", of.done)
}

/// Text of the summary of the rows in a folder.
fn summary_text(of: &Summary, folder: &Path) -> String {
    let mut text = outcomes(of);
    for (axis, values) in &of.by_axis {
        let _ = writeln!(text, "\n{axis}");
        for (AxisValue(value), counts) in values {
            let total: u64 = counts.values().sum();
            let proved = counts.get(Outcome::Proved.code()).copied().unwrap_or(0);
            let others = counts.iter().filter(|(code, _)| **code != Outcome::Proved.code());
            let others: String = others.map(|(code, count)| format!(", {count} {code}")).collect();
            let _ = writeln!(text, "  {value}: {proved} of {total} proved{others}");
        }
    }
    if let Some([least, low, middle, high, most]) = of.duration_s {
        let _ = writeln!(
            text,
            "\nduration of what is proved: {least:.2} s least, {low:.2} s at 5 %, {middle:.2} s at 50 %, {high:.2} s at 95 %, {most:.2} s most"
        );
    }
    list(&mut text, of, "not proved, the first of each outcome", &of.not_proved);
    list(&mut text, of, "proved with the least clearance", &of.nearest);
    list(&mut text, of, "proved with the longest motion", &of.slowest);
    if let Some(row) = of.not_proved.iter().chain(&of.nearest).next() {
        let _ = writeln!(
            text,
            "\na row alone, here row {}:\n  platewash study scenario {} --row {} > row.toml && platewash run --scenario row.toml",
            row.index,
            argument(folder),
            row.index
        );
        if !of.manifest.files.is_empty() {
            text.push_str("  (it names files: write row.toml beside the study's scenario; in Python, StudyRows.scenario needs none of them)\n");
        }
    }
    text
}

fn list(text: &mut String, of: &Summary, title: &str, rows: &[Row]) {
    if rows.is_empty() {
        return;
    }
    let _ = writeln!(text, "\n{title}");
    for row in rows {
        let several = (of.manifest.scenarios.len() > 1).then(|| row.scenario.clone());
        let axes = row.axes.iter().map(|(key, value)| format!("{key} = {value}"));
        let axes = several.into_iter().chain(axes).collect::<Vec<_>>().join(", ");
        let duration = row.duration_s.map(|s| format!(", {s:.2} s"));
        let clearance = row.clearance_m.map(|v| format!(", clearance {:.1} mm", 1e3 * v));
        let pair = row.clearance_pair.as_ref().map(|[a, b]| format!(" ({a}, {b})"));
        let reason = row.reason.as_ref().map(|reason| format!(": {reason}"));
        let _ = writeln!(
            text,
            "  row {} ({axes}) {}{}{}{}{}",
            row.index,
            row.outcome.code(),
            duration.unwrap_or_default(),
            clearance.unwrap_or_default(),
            pair.unwrap_or_default(),
            reason.unwrap_or_default()
        );
    }
}

/// A path as a shell takes it, and the command takes it for no option.
fn argument(path: &Path) -> String {
    let mut name = path.display().to_string();
    if name.starts_with('-') {
        name.insert_str(0, "./");
    }
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "/._-".contains(c);
    match name.chars().all(is_plain) {
        true => name,
        false => format!("'{}'", name.replace('\'', "'\\''")),
    }
}
