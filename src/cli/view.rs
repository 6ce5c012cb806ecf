//! `platewash view` and `platewash figures`: a plan file on a page in the browser, or as pictures.

use super::failure::{ExitCode, internal};
use super::files::{Files, check_places};
use super::input_file::{refused, text};
use super::options::Options;
use super::page::{self, ServeArguments};
use super::plan_file::PlanFile;
use super::simulate::SimulationAnswer;
use anyhow::{Error, Result};
use clap::Args;
use platewash::certificate::prove_with;
use platewash::motion::csv::RecordedMotion;
use platewash::motion::plan::Process;
use platewash::server::{Page, Site};
use platewash::viewer::figures::{Figure, FigureData, FigureError, draw};
use platewash::viewer::view::{ExecutedMotion, ViewError, ViewExtras};
use platewash::{Certificate, Failure, paper_spirals};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Longest CSV file that is read \[bytes\].
const MAX_BYTES: u64 = 1 << 28;

/// Arguments of `view`.
#[derive(Debug, Args)]
pub struct ViewArguments {
    /// Plan file
    plan: PathBuf,
    /// CSV of a motion to show instead of a simulation, in the format that run and simulate write
    #[arg(long, value_name = "CSV")]
    executed: Option<PathBuf>,
    #[command(flatten)]
    serve: ServeArguments,
    /// Write the page to a file instead of serving it
    #[arg(long, value_name = "FILE", conflicts_with_all = ["port", "bind", "no_open"])]
    save: Option<PathBuf>,
}

/// Answer of `view`: the address of the page, or its file.
#[derive(Debug, Serialize)]
#[serde(rename_all = "snake_case")]
enum PageAnswer<'a> {
    Url(&'a str),
    Page(&'a Path),
}

/// Proves and simulates a plan file, and shows it until it is told to end.
pub fn view(options: &Options, arguments: &ViewArguments) -> Result<ExitCode> {
    match &arguments.save {
        Some(file) => save(options, arguments, file),
        None => serve(options, arguments),
    }
}

fn save(options: &Options, arguments: &ViewArguments, file: &Path) -> Result<ExitCode> {
    check_places(&[file.to_owned()])?;
    let mut files = Files::new(None, &[]);
    files.add_at(file.to_owned(), html(options, arguments)?);
    files.write(&options.cancel)?;
    options.print(&PageAnswer::Page(file), || format!("{}\n", file.display()))?;
    Ok(ExitCode::Done)
}

fn serve(options: &Options, arguments: &ViewArguments) -> Result<ExitCode> {
    let listener = arguments.serve.listen(options)?;
    let page = html(options, arguments)?;
    let url = listener.url();
    let site = Site::from_page(Page::Fixed(page));
    let server = listener.serve(site).map_err(internal)?;
    options.print(&PageAnswer::Url(&url), || format!("{url}\n"))?;
    arguments.serve.open(options, &url);
    options.say("Ctrl-C ends it");
    options.wait();
    drop(server);
    Ok(ExitCode::Done)
}

/// The page of a plan file, with its certificate, where it can have one, and what the arm makes of it, where that is known.
fn html(options: &Options, arguments: &ViewArguments) -> Result<String> {
    let file = PlanFile::read(options, &arguments.plan)?;
    let (plan, arm) = (&file.plan, &file.arm);
    let recorded = arguments.executed.as_deref().map(recorded).transpose()?;
    let bundle = page::needed_bundle()?;
    let certificate = match plan.process {
        Process::Paper => None,
        Process::Wash => Some(file.prove(options)?),
    };
    let executed = match recorded {
        Some(recorded) => Some(recorded),
        None => {
            let simulated = SimulationAnswer::new(options, plan, arm, &mut |_| {})?;
            if let SimulationAnswer::Refused { refused } = &simulated {
                options.say(&format!("not simulated: {refused}"));
            }
            simulated.executed()
        }
    };
    let region = page::region_of_plan(plan, arm);
    let beside = ViewExtras {
        certificate: certificate.as_ref(),
        executed: executed.as_ref(),
        region: Some(&region),
        ..ViewExtras::default()
    };
    page::html(plan, arm, &beside, &bundle).map_err(|error| match (error.downcast_ref(), &arguments.executed) {
        (Some(ViewError::BeyondEnd { .. }), Some(csv)) => refused(csv, error),
        (Some(_), _) => file.refused(error),
        (None, _) => internal(error),
    })
}

/// The motion of a CSV file.
fn recorded(path: &Path) -> Result<ExecutedMotion> {
    let motion = RecordedMotion::from_csv(&text(path, MAX_BYTES)?).map_err(|e| refused(path, e))?;
    Ok(ExecutedMotion::recorded(&motion))
}

/// Arguments of `figures`.
#[derive(Debug, Args)]
pub struct FiguresArguments {
    /// Plan file
    plan: PathBuf,
    /// Names of the figures to draw, separated by commas: layout, joints, coverage, spiral
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = Figure::named)]
    only: Vec<Figure>,
}

/// Answer of `figures`: the files written, and the parts left out.
#[derive(Debug, Serialize)]
struct FiguresAnswer {
    scenario: String,
    /// Paths of the files.
    written: Vec<PathBuf>,
    left_out: Vec<OmittedFigure>,
}

/// A figure that the plan has no content for, or a part of the other figures that is not known.
#[derive(Debug, Serialize)]
struct OmittedFigure {
    what: String,
    why: String,
}

impl OmittedFigure {
    fn new(what: &str, why: impl ToString) -> Self {
        Self {
            what: what.to_owned(),
            why: why.to_string(),
        }
    }
}

/// Draws a plan file and writes the figures.
pub fn figures(options: &Options, arguments: &FiguresArguments) -> Result<ExitCode> {
    let only = &arguments.only;
    // Each once, in the order of their names' list.
    let mut wanted = Figure::ALL.to_vec();
    wanted.retain(|figure| only.is_empty() || only.contains(figure));
    let name = |figure: &Figure| format!("{}.svg", figure.name());
    let mut files = Files::new(options.folder_or("figures"), &[]);
    let names: Vec<_> = wanted.iter().map(name).collect();
    check_places(&files.places(&names.iter().map(String::as_str).collect::<Vec<_>>()))?;
    let file = PlanFile::read(options, &arguments.plan)?;
    let mut left_out = Vec::new();
    let known = PlanResults::new(options, &file, &wanted, &mut left_out)?;
    let data = known.data(&file).map_err(|error| file.refused(error))?;
    for figure in &wanted {
        match draw(&data, *figure) {
            Ok(svg) => files.add(&name(figure), svg),
            // What was asked for by name must be drawn; of the others, those that the plan has nothing for are left out.
            Err(error @ FigureError::NothingWashed { .. }) if only.is_empty() => {
                left_out.push(OmittedFigure::new(figure.name(), error));
            }
            Err(error) => return Err(file.refused(error)),
        }
    }
    files.write(&options.cancel)?;
    let answer = FiguresAnswer {
        scenario: file.plan.provenance.scenario.clone(),
        written: files.paths().map(Path::to_owned).collect(),
        left_out,
    };
    options.print(&answer, || answer.text())?;
    Ok(ExitCode::Done)
}

impl FiguresAnswer {
    fn text(&self) -> String {
        let written = self.written.iter().map(|path| format!("wrote {}\n", path.display()));
        let left_out = self.left_out.iter();
        let left_out = left_out.map(|left| format!("left out: {}, as {}\n", left.what, left.why));
        written.chain(left_out).collect()
    }
}

/// Results on a plan that figures need, as far as they are known.
struct PlanResults {
    certificate: Option<Certificate>,
    simulated: Option<SimulationAnswer>,
    /// Curves that the tip should follow, for a plan of the paper's program.
    ideal: Option<Vec<platewash::viewer::figures::IdealPath>>,
}

impl PlanResults {
    /// Proves, simulates and, for a plan of the paper's program, follows it again.
    fn new(
        options: &Options,
        file: &PlanFile<'_>,
        wanted: &[Figure],
        left_out: &mut Vec<OmittedFigure>,
    ) -> Result<Self> {
        let (plan, arm) = (&file.plan, &file.arm);
        let (mut certificate, mut ideal) = (None, None);
        match plan.process {
            Process::Wash => {
                let proved = options.during("proving", || prove_with(plan, arm, &options.cancel));
                certificate = known(proved, "the certificate", left_out)?;
            }
            Process::Paper => {
                let follow = || paper_spirals(plan, arm, &options.cancel);
                let spirals = options.during("following the paper's program", follow);
                ideal = known(spirals, "the paper's spirals", left_out)?;
            }
        }
        let mut simulated = None;
        if wanted.iter().any(|figure| *figure != Figure::Joints) {
            simulated = Some(SimulationAnswer::new(options, plan, arm, &mut |_| {})?);
        }
        if let Some(SimulationAnswer::Refused { refused }) = &simulated {
            left_out.push(OmittedFigure::new("what an arm makes of it", refused));
        }
        Ok(Self {
            certificate,
            simulated,
            ideal,
        })
    }

    fn data<'a>(&'a self, file: &'a PlanFile<'_>) -> Result<FigureData<'a>, FigureError> {
        let mut data = FigureData::new(&file.plan, &file.arm)?;
        if let Some(SimulationAnswer::Done { execution, report }) = &self.simulated {
            data = data.executed(execution, report)?;
        }
        if let Some(ideal) = &self.ideal {
            data.ideal.clone_from(ideal);
        }
        data.certificate = self.certificate.as_ref();
        data.region = page::region_of_plan(&file.plan, &file.arm);
        Ok(data)
    }
}

/// Returns a result, or `None` with a note in `left_out` that says why it is missing. An error where the work was cancelled.
fn known<T, E>(found: Result<T, E>, what: &str, left_out: &mut Vec<OmittedFigure>) -> Result<Option<T>>
where
    Failure: From<E>,
{
    match found.map_err(Failure::from) {
        Ok(found) => Ok(Some(found)),
        Err(error) if error.is_cancelled() => Err(Error::from(error)),
        Err(error) => {
            left_out.push(OmittedFigure::new(what, error));
            Ok(None)
        }
    }
}
