//! `platewash figures`: a plan as pictures.

use super::failure::{ExitCode, Failure};
use super::options::Options;
use super::plan_file::PlanFile;
use super::progress::Progress;
use super::{execution, output, region, text};
use clap::Args;
use platewash::certificate::prove_with;
use platewash::viewer::figures::{Figure, FigureError, Ideal, Subject, draw};
use platewash::workcell::plan::Process;
use platewash::{Certificate, Execution, SimulationReport, paper_spirals};
use serde::Serialize;
use std::path::PathBuf;

/// Folder that is written to without `--out`.
const DEFAULT_FOLDER: &str = "figures";

/// Arguments of `figures`.
#[derive(Debug, Args)]
pub struct FiguresArguments {
    /// Plan file
    #[arg(value_name = "PLAN")]
    pub plan: PathBuf,
    /// Names of the figures to draw, separated by commas: layout, joints, coverage, spiral
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = Figure::named)]
    pub only: Vec<Figure>,
}

impl FiguresArguments {
    /// What is asked for, each once, in the order of their names' list.
    fn wanted(&self) -> Vec<Figure> {
        let asked = |figure: &Figure| self.only.is_empty() || self.only.contains(figure);
        Figure::ALL.into_iter().filter(asked).collect()
    }
}

/// What is written, and what is not.
#[derive(Debug, Serialize)]
struct Answer {
    scenario: String,
    /// Paths of the files.
    written: Vec<PathBuf>,
    left_out: Vec<LeftOut>,
}

/// A figure that the plan has nothing for, or a part of the others that is not known.
#[derive(Debug, Serialize)]
struct LeftOut {
    what: String,
    why: String,
}

/// Draws a plan file and writes the figures.
pub fn run(options: &Options, arguments: &FiguresArguments) -> Result<ExitCode, Failure> {
    let wanted = arguments.wanted();
    let folder = options.out.clone().unwrap_or_else(|| PathBuf::from(DEFAULT_FOLDER));
    let place = |figure: &Figure| folder.join(format!("{}.svg", figure.name()));
    output::check_places(&wanted.iter().map(place).collect::<Vec<_>>())?;
    let file = PlanFile::read(options, &arguments.plan)?;
    let mut left_out = Vec::new();
    let known = Known::of(options, &file, &wanted, &mut left_out)?;
    let subject = known.subject(&file).map_err(|error| file.refused(error))?;
    let mut files = Vec::new();
    for figure in &wanted {
        match draw(&subject, *figure) {
            Ok(svg) => files.push(output::file(place(figure), svg)),
            // What was asked for by name must be drawn; of the others, those that the plan has nothing for are left out.
            Err(error @ FigureError::NothingWashed { .. }) if arguments.only.is_empty() => left_out.push(LeftOut {
                what: figure.name().to_owned(),
                why: error.to_string(),
            }),
            Err(error) => return Err(file.refused(error)),
        }
    }
    output::write_files(&files, &options.cancel)?;
    let answer = Answer {
        scenario: file.plan.provenance.scenario.clone(),
        written: files.into_iter().map(|(path, _)| path).collect(),
        left_out,
    };
    output::print_either(options.json, &answer, || answer.text())?;
    Ok(ExitCode::SUCCESS)
}

impl Answer {
    fn text(&self) -> String {
        let written = self.written.iter().map(|path| format!("wrote {}\n", path.display()));
        let left_out = self.left_out.iter();
        let left_out = left_out.map(|left| format!("left out: {}, as {}\n", left.what, left.why));
        text::text(&written.chain(left_out).collect::<String>())
    }
}

/// What is known of a plan beside itself.
struct Known {
    certificate: Option<Certificate>,
    executed: Option<(Execution, SimulationReport)>,
    /// Of a plan of the paper's program, what the tip was to follow.
    ideal: Option<Vec<Ideal>>,
}

impl Known {
    /// Proves, simulates and, for a plan of the paper's program, follows it again.
    fn of(
        options: &Options,
        file: &PlanFile<'_>,
        wanted: &[Figure],
        left_out: &mut Vec<LeftOut>,
    ) -> Result<Self, Failure> {
        let (plan, arm) = (&file.plan, &file.arm);
        let mut unknown = |what: &str, why: String| {
            let what = what.to_owned();
            left_out.push(LeftOut { what, why });
        };
        let (mut certificate, mut ideal) = (None, None);
        match plan.process {
            Process::Wash => {
                let _progress = Progress::new(options.quiet, "proving");
                match prove_with(plan, arm, &options.cancel) {
                    Ok(proof) => certificate = Some(proof),
                    Err(error) => refuse(file, error.into(), |why| unknown("the certificate", why))?,
                }
            }
            Process::Paper => {
                let _progress = Progress::new(options.quiet, "following the paper's program");
                match paper_spirals(plan, arm, &options.cancel) {
                    Ok(spirals) => ideal = Some(spirals),
                    Err(error) => refuse(file, error.into(), |why| unknown("the paper's spirals", why))?,
                }
            }
        }
        let _progress = Progress::new(options.quiet, "simulating");
        let simulated = wanted
            .iter()
            .any(|figure| *figure != Figure::Joints)
            .then(|| execution::tried(plan, arm, &options.cancel, &mut |_| {}));
        let executed = simulated.transpose()?.and_then(|simulated| {
            let refused = |why| unknown("what an arm makes of it", why);
            simulated.map_err(refused).ok()
        });
        Ok(Self {
            certificate,
            executed,
            ideal,
        })
    }

    fn subject<'a>(&'a self, file: &'a PlanFile<'_>) -> Result<Subject<'a>, FigureError> {
        let mut subject = Subject::new(&file.plan, &file.arm)?;
        if let Some((execution, report)) = &self.executed {
            subject = subject.executed(execution, report)?;
        }
        if let Some(ideal) = &self.ideal {
            subject.ideal.clone_from(ideal);
        }
        subject.certificate = self.certificate.as_ref();
        subject.region = region::of_plan(&file.plan, &file.arm);
        Ok(subject)
    }
}

/// Ends where the work was given up; otherwise notes why something is not known.
fn refuse(file: &PlanFile<'_>, error: platewash::Failure, note: impl FnOnce(String)) -> Result<(), Failure> {
    if error.is_cancelled() {
        return Err(file.failure(error));
    }
    note(error.to_string());
    Ok(())
}
