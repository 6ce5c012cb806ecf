//! `platewash study`: scenarios by the thousand, each planned and proved, every row kept as soon as it is done.

use super::failure::{self, ExitCode, Failure};
use super::options::Options;
use super::progress::Progress;
use super::{output, study_text};
use anyhow::{Context, anyhow};
use clap::{Args, Subcommand};
use platewash::study::{self, Journal, Resolver, Study, StudyError};
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
pub fn run(options: &Options, arguments: &StudyArguments) -> Result<ExitCode, Failure> {
    let is_run = matches!(arguments.verb, StudyVerb::Run { .. });
    if options.out.is_some() && !is_run {
        return Err(Failure::input(anyhow!(
            "--out: is of study run alone; export writes where --to says"
        )));
    }
    match &arguments.verb {
        StudyVerb::Run { file } => work(options, file),
        StudyVerb::Show { folder } => show(options, folder),
        StudyVerb::Export { folder, to, partial } => export(folder, to.as_deref(), *partial),
        StudyVerb::Scenario { file, row } => {
            output::print(&Study::load(file)?.scenario_text(*row)?)?;
            Ok(ExitCode::SUCCESS)
        }
    }
}

fn work(options: &Options, file: &Path) -> Result<ExitCode, Failure> {
    let folder = options
        .out
        .as_deref()
        .context("study run needs --out DIR, where rows are kept");
    let folder = folder.map_err(Failure::input)?;
    let study = Arc::new(Study::load(file)?);
    let mut journal = Journal::open(folder, &study)?;
    let (before, rows) = (journal.done(), study.rows());
    if before == rows {
        journal.finish()?;
        output::message(
            options.quiet,
            &format!("{}: the study is finished, all {rows} rows are there", folder.display()),
        );
    } else {
        if before > 0 {
            output::message(options.quiet, &format!("going on: {before} of {rows} rows are there"));
        }
        let resolver = Resolver::new(study);
        let progress = Progress::new(options.quiet, "planning and proving");
        let made = study::run(
            &mut journal,
            &options.cancel,
            |index, cancel| resolver.row(index, cancel),
            |at| progress.rows(&at),
        );
        drop(progress);
        if made.is_err() && journal.done() < rows {
            let kept = format!(
                "{} of {rows} rows are kept; the same command goes on with the others",
                journal.done()
            );
            output::message(options.quiet, &kept);
        }
        made?;
    }
    let summary = study::summary(folder)?;
    output::print_either(options.json, &summary, || study_text::outcomes(&summary))?;
    Ok(match summary.outcomes.get("crashed") {
        Some(_) => ExitCode::from(failure::INTERNAL),
        None => ExitCode::SUCCESS,
    })
}

fn show(options: &Options, folder: &Path) -> Result<ExitCode, Failure> {
    let summary = study::summary(folder)?;
    output::print_either(options.json, &summary, || study_text::shown(&summary, folder))?;
    Ok(ExitCode::SUCCESS)
}

fn export(folder: &Path, to: Option<&Path>, partial: bool) -> Result<ExitCode, Failure> {
    let (done, rows) = study::counted(folder)?;
    if done < rows && !partial {
        return Err(Failure::input(anyhow!(
            "{}: the study is not finished: {done} of {rows} rows; go on with it, or take what is there: --partial",
            folder.display()
        )));
    }
    match to {
        Some(to) => {
            let cannot = || format!("{}: cannot be written", to.display());
            let places = output::place(to).and_then(|to| Ok((to, output::place(&folder.join("rows.jsonl"))?)));
            let (place, kept) = places.with_context(cannot).map_err(Failure::input)?;
            if kept.parent().is_some_and(|folder| place.starts_with(folder)) {
                return Err(Failure::input(anyhow!(
                    "{}: it is in the study's folder, which is kept as it is",
                    cannot()
                )));
            }
            output::write_to(to, |out| Ok(study::export(folder, out, to)?))?;
        }
        None => {
            let out = &mut BufWriter::new(std::io::stdout().lock()) as &mut dyn Write;
            match study::export(folder, out, Path::new("standard output")) {
                // A reader that has gone away is no error.
                Err(StudyError::Disk { cause, .. }) if cause.kind() == ErrorKind::BrokenPipe => {}
                written => drop(written?),
            }
        }
    }
    Ok(ExitCode::SUCCESS)
}
