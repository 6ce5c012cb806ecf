//! `platewash view`: a plan file on a page in the browser.

use super::failure::{ExitCode, Failure};
use super::options::Options;
use super::plan_file::PlanFile;
use super::progress::Progress;
use super::serve::ServeArguments;
use super::{bundle, execution, output, page, region};
use anyhow::anyhow;
use clap::Args;
use platewash::Certificate;
use platewash::certificate::prove_with;
use platewash::kinematics::urdf::file;
use platewash::viewer::server::{Page, Site};
use platewash::viewer::view::{Beside, Executed, ViewError};
use platewash::workcell::csv::RecordedMotion;
use platewash::workcell::plan::Process;
use serde::Serialize;
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// Longest CSV file that is read \[bytes\].
const MAX_BYTES: u64 = 1 << 28;

/// Arguments of `view`.
#[derive(Debug, Args)]
pub struct ViewArguments {
    /// Plan file
    #[arg(value_name = "PLAN")]
    pub plan: PathBuf,
    /// CSV of a motion to show instead of a simulation, in the format that run and simulate write
    #[arg(long, value_name = "CSV")]
    executed: Option<PathBuf>,
    #[command(flatten)]
    serve: ServeArguments,
    /// Write the page to a file instead of serving it
    #[arg(long, value_name = "FILE", conflicts_with_all = ["port", "bind", "no_open"])]
    save: Option<PathBuf>,
}

/// Where the page is.
#[derive(Debug, Serialize)]
#[serde(rename_all = "snake_case")]
enum Answer<'a> {
    Url(&'a str),
    Page(&'a Path),
}

/// Proves and simulates a plan file, and shows it until it is told to end.
pub fn run(options: &Options, arguments: &ViewArguments) -> Result<ExitCode, Failure> {
    match &arguments.save {
        Some(file) => save(options, arguments, file),
        None => serve(options, arguments),
    }
}

fn save(options: &Options, arguments: &ViewArguments, file: &Path) -> Result<ExitCode, Failure> {
    output::check_places(&[file.to_owned()])?;
    let page = html(options, arguments)?;
    output::write_files(&[output::file(file.to_owned(), page)], &options.cancel)?;
    output::print_either(options.json, &Answer::Page(file), || format!("{}\n", file.display()))?;
    Ok(ExitCode::SUCCESS)
}

fn serve(options: &Options, arguments: &ViewArguments) -> Result<ExitCode, Failure> {
    let listener = arguments.serve.listen(options)?;
    let page = html(options, arguments)?;
    let url = listener.url();
    let site = Site::of(Page::Fixed(page));
    let server = listener.serve(site).map_err(Failure::internal)?;
    output::print_either(options.json, &Answer::Url(&url), || format!("{url}\n"))?;
    arguments.serve.open(options, &url);
    output::message(options.quiet, "Ctrl-C ends it");
    options.wait();
    drop(server);
    Ok(ExitCode::SUCCESS)
}

/// The page of a plan file.
fn html(options: &Options, arguments: &ViewArguments) -> Result<String, Failure> {
    let file = PlanFile::read(options, &arguments.plan)?;
    let recorded = arguments.executed.as_deref().map(recorded).transpose()?;
    let bundle = bundle::needed()?;
    let certificate = certificate(options, &file)?;
    let executed = match recorded {
        Some(recorded) => Some(recorded),
        None => simulated(options, &file)?,
    };
    let region = region::of_plan(&file.plan, &file.arm);
    let beside = Beside {
        certificate: certificate.as_ref(),
        executed: executed.as_ref(),
        region: Some(&region),
        ..Beside::default()
    };
    page::html(&file.plan, &file.arm, &beside, &bundle).map_err(|error| {
        match (error.downcast_ref(), &arguments.executed) {
            (Some(ViewError::BeyondEnd { .. }), Some(csv)) => refused(csv, error),
            (Some(_), _) => file.refused(error),
            (None, _) => Failure::internal(error),
        }
    })
}

/// The motion of a CSV file.
fn recorded(path: &Path) -> Result<Executed, Failure> {
    let text = file::read_text(path, MAX_BYTES).map_err(|e| refused(path, format_args!("cannot be read: {e}")))?;
    let motion = RecordedMotion::from_csv(&text).map_err(|e| refused(path, e))?;
    Ok(Executed::recorded(&motion))
}

fn refused(path: &Path, error: impl Display) -> Failure {
    Failure::input(anyhow!("{}: {error}", path.display()))
}

/// The certificate; a run of the paper's program has none.
fn certificate(options: &Options, file: &PlanFile<'_>) -> Result<Option<Certificate>, Failure> {
    if file.plan.process == Process::Paper {
        return Ok(None);
    }
    let _progress = Progress::new(options.quiet, "proving");
    let certificate = prove_with(&file.plan, &file.arm, &options.cancel);
    certificate.map(Some).map_err(|error| file.failure(error.into()))
}

/// What the arm makes of the plan under the settings that it states; none where that cannot be simulated, which a line on standard
/// error explains.
fn simulated(options: &Options, file: &PlanFile<'_>) -> Result<Option<Executed>, Failure> {
    let _progress = Progress::new(options.quiet, "simulating");
    match execution::tried(&file.plan, &file.arm, &options.cancel, &mut |_| {})? {
        Ok((execution, report)) => Ok(Some(Executed::simulated(&execution, &report))),
        Err(words) => {
            output::message(options.quiet, &format!("not simulated: {words}"));
            Ok(None)
        }
    }
}
