//! What is required and what is proved of it; of a run of the paper's program, what the paper takes for granted and what was measured.

use super::error::FigureError;
use super::ink::drawing::{Drawing, Lettering, Rect};
use super::ink::page;
use super::ink::palette::{BAD, GOOD, GREY, INK, OPEN};
use super::ink::table::{self, Cell, Column, Side};
use super::subject::{Claim, Subject};
use super::wording;
use platewash_certificate::{Check, Requirement, Status};
use platewash_kinematics::words::rounded;

/// Significant digits of what is asked for or assumed.
const DIGITS: usize = 6;

/// Draws it.
///
/// # Errors
/// [`FigureError::NothingKnown`] where there is neither a certificate nor a claim.
pub(super) fn draw(subject: &Subject<'_>) -> Result<Drawing, FigureError> {
    if subject.is_paper() {
        return claims(subject);
    }
    let certificate = subject.certificate.ok_or(FigureError::NothingKnown)?;
    let caption =
        "Proved: it holds at every moment, not at samples; the true extreme lies between what was seen and the bound. \
                   docs/certificate.md says how, and on what assumptions."
            .to_owned()
            + &counted(subject);
    let (mut drawing, room) = page::begin(&subject.words("Requirements", &caption));
    let headings = ["requirement", "required", "proved", "worst", ""];
    let columns = columns(room.size[0], headings, [0.17, 0.33, 0.13, 0.24, 0.13]);
    let rows: Vec<Vec<Cell>> = certificate.checks.iter().map(requirement).collect();
    table::draw(&mut drawing, room, LEADING, &columns, &rows);
    Ok(drawing)
}

/// What counts as contact, for how long, with what dose, and wherever what is assumed may lie; empty where nothing is promised of it.
fn counted(subject: &Subject<'_>) -> String {
    let job = &subject.plan.job;
    let Some(contact) = &job.requirements.contact else {
        return String::new();
    };
    let stiffness = job
        .workcell
        .tool
        .sponge
        .stiffness_pa
        .map_or_else(String::new, |range_pa| {
            let [softest, stiffest] = range_pa.map(|pa| rounded(1e-3 * pa, DIGITS));
            format!(", sponges of {softest} to {stiffest} kPa")
        });
    format!(
        " Contact: pressed by {} mm; time: {} s; dose: {} Pa·m; of plates up to ±{} mm off{stiffness} (assumed).",
        rounded(1e3 * contact.compression_m, DIGITS),
        rounded(contact.time_s, DIGITS),
        rounded(contact.dose_pa_m, DIGITS),
        rounded(1e3 * contact.height_error_m, DIGITS)
    )
}

fn claims(subject: &Subject<'_>) -> Result<Drawing, FigureError> {
    if subject.claims.is_empty() {
        return Err(FigureError::NothingKnown);
    }
    let caption = "Left what the paper takes for granted, right what this one run of its program measured. `platewash reproduce` measures hundreds of \
                   layouts (docs/reproduce.md).";
    let (mut drawing, room) = page::begin(&subject.words("Claimed and measured", caption));
    let headings = ["", "the paper takes for granted", "measured here", ""];
    let columns = columns(room.size[0], headings, [0.25, 0.24, 0.41, 0.1]);
    let used = Rect::new(room.at[0], room.at[1], room.size[0], room.size[1] - 64.0);
    let rows: Vec<Vec<Cell>> = subject.claims.iter().map(claim).collect();
    table::draw(&mut drawing, used, LEADING, &columns, &rows);
    let holding = subject.claims.iter().filter(|claim| claim.holds).count();
    let words = format!("{holding} of {} hold", subject.claims.len());
    let colour = if holding == subject.claims.len() { GOOD } else { BAD };
    drawing.text(
        [room.at[0] + 10.0, room.end()[1] - 22.0],
        &words,
        &Lettering::new(30.0, colour).bold(),
    );
    Ok(drawing)
}

/// Least and greatest height of a line \[px\].
const LEADING: [f64; 2] = [20.0, 52.0];

fn columns<const N: usize>(width: f64, headings: [&'static str; N], shares: [f64; N]) -> [Column; N] {
    std::array::from_fn(|k| Column {
        heading: headings[k],
        width: shares[k] * width,
        side: Side::Left,
    })
}

fn grey(words: String) -> Cell {
    Cell {
        colour: GREY,
        ..Cell::new(words)
    }
}

fn claim(claim: &Claim) -> Vec<Cell> {
    let (word, colour) = if claim.holds {
        ("✓ holds", GOOD)
    } else {
        ("✗ does not", BAD)
    };
    vec![
        Cell::marked(claim.about.clone(), INK),
        grey(claim.claimed.clone()),
        Cell::new(claim.measured.clone()),
        Cell::marked(word, colour),
    ]
}

fn requirement(check: &Check) -> Vec<Cell> {
    let [required, proved] = match &check.measure {
        Some(measure) => {
            let [bound, limit] = wording::measure(measure);
            [limit, bound]
        }
        None => [stated(check.requirement).to_owned(), statements(check)],
    };
    let (sign, colour) = match check.status {
        Status::Proved => ("✓", GOOD),
        Status::Violated => ("✗", BAD),
        Status::NotProved | Status::Waived => ("–", OPEN),
    };
    vec![
        Cell::marked(check.requirement.words(), INK),
        grey(required),
        Cell::new(proved),
        grey(wording::place(&check.worst)),
        Cell::marked(format!("{sign} {}", wording::status(check.status)), colour),
    ]
}

/// What is required where it is no number.
fn stated(requirement: Requirement) -> &'static str {
    match requirement {
        Requirement::Arm => "the plan is for this arm, its SRDF included",
        Requirement::Tool => "the tip is the middle of the sponge's face",
        Requirement::Plates => "none reaches below the floor",
        Requirement::DryRun => "the real plates stand below, as obstacles",
        Requirement::Exclusions => "pairs left out follow from arm and SRDF",
        Requirement::WashPaths => "each plate has one that can be judged",
        Requirement::Segments => "they follow one another, home to home",
        Requirement::EveryPlateOnce => "each is washed once, as the order says",
        Requirement::HomeToHome => "at rest in the home positions at both ends",
        Requirement::RestAtWashEnds => "the arm rests where a wash begins and ends",
        Requirement::PlatesApart => "no plate overlaps another or the base",
        _ => "as stated",
    }
}

fn statements(check: &Check) -> String {
    match &check.discrepancies[..] {
        [] if check.status == Status::Proved => "it is so".to_owned(),
        [] => "not judged".to_owned(),
        [first, ..] => first.to_string(),
    }
}
