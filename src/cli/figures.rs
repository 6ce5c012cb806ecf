//! `platewash figures`: a plan as pictures.

use super::failure::{ExitCode, Failure};
use super::options::Options;
use super::output;
use super::plan_file::PlanFile;
use super::progress::Progress;
use super::{execution, paper_claims, region, text};
use clap::Args;
use platewash::certificate::prove_with;
use platewash::viewer::figures::{Figure, Ideal, Sheet, Subject, draw};
use platewash::workcell::layout::TaskRegion;
use platewash::workcell::plan::Process;
use platewash::{Certificate, Execution, SimulationReport};
use rayon::prelude::*;
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
    /// Names of the figures to draw, separated by commas: layout, cleaning, transit, moment, joints, coverage, spiral, sheet, flow
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = Figure::named)]
    pub only: Vec<Figure>,
    /// Time in seconds of the figure "moment"
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true)]
    pub at: Option<f64>,
}

impl FiguresArguments {
    /// What is asked for, each once, in the order of their names' list.
    fn wanted(&self) -> Vec<Figure> {
        let asked = |figure: &Figure| match self.only.is_empty() {
            true => *figure != Figure::Moment || self.at.is_some(),
            false => self.only.contains(figure),
        };
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
    let place = |figure: Figure, ending: &str| folder.join(format!("{}.{ending}", figure.name()));
    let places = wanted
        .iter()
        .flat_map(|&figure| [place(figure, "svg"), place(figure, "png")]);
    output::check_places(&places.collect::<Vec<_>>())?;
    let file = PlanFile::read(options, &arguments.plan)?;
    let mut left_out = Vec::new();
    let known = Known::of(options, &file, &wanted, &mut left_out)?;
    let subject = known.subject(&file).map_err(|error| file.refused(error))?;
    let sheets = sheets(options, arguments, (&wanted, &subject), &mut left_out).map_err(|error| file.refused(error))?;
    let mut files = Vec::new();
    for (sheet, png) in sheets {
        files.push(output::file(place(sheet.figure, "svg"), sheet.svg));
        files.push(output::bytes(place(sheet.figure, "png"), png));
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

/// Draws what is wanted. What was asked for by name must be drawn; of the others, those that the plan has nothing for are left out.
fn sheets(
    options: &Options,
    arguments: &FiguresArguments,
    (wanted, subject): (&[Figure], &Subject<'_>),
    left_out: &mut Vec<LeftOut>,
) -> Result<Vec<(Sheet, Vec<u8>)>, platewash::viewer::figures::FigureError> {
    let _progress = Progress::new(options.quiet, "drawing");
    let drawn = wanted.par_iter().map(|&figure| {
        let sheet = draw(subject, figure, arguments.at)?;
        let png = sheet.png()?;
        Ok((sheet, png))
    });
    let drawn: Vec<Result<_, platewash::viewer::figures::FigureError>> = drawn.collect();
    let mut sheets = Vec::new();
    for (figure, drawn) in wanted.iter().zip(drawn) {
        match drawn {
            Ok(sheet) => sheets.push(sheet),
            Err(error) if arguments.only.is_empty() && error.is_of_one_figure() => left_out.push(LeftOut {
                what: figure.name().to_owned(),
                why: error.to_string(),
            }),
            Err(error) => return Err(error),
        }
    }
    Ok(sheets)
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
    region: TaskRegion,
    paper: Option<paper_claims::Followed>,
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
        let (mut certificate, mut paper) = (None, None);
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
                match paper_claims::follow(plan, arm, &options.cancel) {
                    Ok(followed) => paper = Some(followed),
                    Err(error) => refuse(file, error.into(), |why| unknown("the paper's claims", why))?,
                }
            }
        }
        let _progress = Progress::new(options.quiet, "simulating");
        let simulated = wanted
            .iter()
            .any(|figure| figure.shows_executed())
            .then(|| execution::tried(plan, arm, &options.cancel, &mut |_| {}));
        let executed = simulated.transpose()?.and_then(|simulated| {
            let refused = |why| unknown("what an arm makes of it", why);
            simulated.map_err(refused).ok()
        });
        Ok(Self {
            certificate,
            executed,
            region: region::of_plan(plan, arm),
            paper,
        })
    }

    fn subject<'a>(&'a self, file: &'a PlanFile<'_>) -> Result<Subject<'a>, platewash::viewer::figures::FigureError> {
        let mut subject = Subject::new(&file.plan, &file.arm)?;
        if let Some(certificate) = &self.certificate {
            subject = subject.proved(certificate);
        }
        if let Some((execution, report)) = &self.executed {
            subject = subject.executed(execution, report)?;
        }
        if let Some(paper) = &self.paper {
            let ideal = paper.ideal.iter().map(|(plate, points)| Ideal {
                plate: *plate,
                points: points.clone(),
            });
            subject = subject.following(ideal.collect());
            subject.claims = paper.claims.clone();
        }
        subject.region_m.clone_from(&self.region.polygon_m);
        subject.base_circle_m = self.region.base_circle_m;
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
