//! What of each plate is swept, or pressed where the job says what counts as contact, and for how long: as planned, and as executed.

use super::error::FigureError;
use super::grid::Grid;
use super::ink::axes::Scale;
use super::ink::drawing::{Drawing, Lettering, Rect};
use super::ink::page;
use super::ink::palette::{BAD, GOOD, GREY, INK, LINE, MISSED, STEPS};
use super::ink::style::Style;
use super::subject::Subject;
use super::track::Track;
use super::wording::{number, per_cent};
use crate::view::Counted;
use crate::view::coverage::{proved_share, swept};
use crate::view::tips::Tip;
use platewash_workcell::coverage::reaches;

/// Most maps of one figure.
const MOST: usize = 24;

/// Cells along an edge of a map.
const CELLS: usize = 120;

/// A map: a plate as planned or as executed.
struct Map {
    place: usize,
    plate: usize,
    of: Of,
    counted: Option<Counted>,
    /// For how long each cell counts, as [`crate::view::raster::Raster::dwell_s`] has them \[s\].
    dwell_s: Vec<Option<f64>>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Of {
    Planned,
    Executed,
}

/// Draws it.
///
/// # Errors
/// [`FigureError::NothingWashed`].
pub(super) fn draw(subject: &Subject<'_>) -> Result<Drawing, FigureError> {
    let washes: Vec<_> = subject.washes().collect();
    if washes.is_empty() {
        return Err(FigureError::NothingWashed { figure: "coverage" });
    }
    let both = subject.followed.is_some();
    let plates = washes.len().min(if both { MOST / 2 } else { MOST });
    let counted = washes
        .iter()
        .map(|(_, wash)| counted_on(subject, wash.plate))
        .collect::<Vec<_>>();
    let mut caption = format!(
        "Each plate along its axis: {} {}.",
        meaning(subject, &counted),
        if both {
            "Of each plate there is what is planned, and what is executed"
        } else {
            "Nothing was simulated"
        },
    );
    if plates < washes.len() {
        caption = format!("The first {plates} of {} plates. {caption}", washes.len());
    }
    let (mut drawing, room) = page::begin(&subject.words("Time under the sponge", &caption));
    let maps = maps(subject, plates);
    let most = maps
        .iter()
        .flat_map(|map| map.dwell_s.iter().flatten())
        .copied()
        .fold(0.0, f64::max);
    let step = step_s(&maps, most);
    let words = match counted.iter().all(Option::is_some) {
        true => ["no contact", "time in contact [s]"],
        false => ["missed", "time under the sponge [s]"],
    };
    key(&mut drawing, room, step, words);
    let top = room.at[1] + 52.0;
    let field = Rect::new(room.at[0], top, room.size[0], room.end()[1] - top);
    let places = Places::new(field, plates, both);
    for map in &maps {
        map.draw(&mut drawing, places.of(map), subject, step);
    }
    Ok(drawing)
}

/// What counts on a plate.
fn counted_on(subject: &Subject<'_>, plate: usize) -> Option<Counted> {
    let job = &subject.plan.job;
    job.plates.get(plate).and_then(|plate| Counted::on(plate, job))
}

/// What the colours say, and what is asked for.
fn meaning(subject: &Subject<'_>, counted: &[Option<Counted>]) -> String {
    let job = &subject.plan.job;
    let sponge = 1e3 * job.workcell.tool.sponge.radius_m;
    let swept = number(100.0 * job.requirements.coverage);
    let promised = counted.iter().flatten().find(|counted| counted.is_promised);
    match (promised, &job.requirements.contact) {
        (Some(counted), Some(contact)) => format!(
            "for how long the middle of each cell is pressed by {} mm or more, wherever within ±{} mm the plate lies, by a sponge of radius \
             {sponge:.0} mm. At least {} % of a plate must be.",
            number(1e3 * counted.compression_m),
            number(1e3 * counted.height_error_m),
            number(100.0 * contact.share),
        ),
        _ if counted.iter().all(Option::is_some) => format!(
            "for how long the middle of each cell is touched by the sponge, radius {sponge:.0} mm, pressed or not. At least {swept} % of \
             a plate must be."
        ),
        _ => format!(
            "for how long the middle of each cell is under the sponge, radius {sponge:.0} mm; of a profile, for how long it is touched. At \
             least {swept} % of a plate must be swept."
        ),
    }
}

fn maps(subject: &Subject<'_>, plates: usize) -> Vec<Map> {
    let mut all = Vec::new();
    let tracks: [(Of, Option<&Track>); 2] = [
        (Of::Planned, Some(&subject.planned)),
        (Of::Executed, subject.followed.as_ref()),
    ];
    for (of, track) in tracks {
        let Some(track) = track else { continue };
        for (place, (segment, wash)) in subject.washes().take(plates).enumerate() {
            let plate = &subject.plan.job.plates[wash.plate];
            let tips: Vec<Tip> = track.within(segment).iter().map(Tip::from).collect();
            let counted = counted_on(subject, wash.plate);
            let tool = &subject.plan.job.workcell.tool;
            let raster = swept(plate, tool, counted.as_ref(), std::iter::once(tips), CELLS);
            all.push(Map {
                place,
                plate: wash.plate,
                of,
                counted,
                dwell_s: raster.dwell_s(),
            });
        }
    }
    all
}

/// Time between two colours \[s\]: a round one, so that few cells have more than the last.
fn step_s(maps: &[Map], most: f64) -> f64 {
    let mut all: Vec<f64> = maps
        .iter()
        .flat_map(|map| map.dwell_s.iter().flatten().copied())
        .collect();
    all.retain(|seconds| *seconds > 0.0);
    all.sort_by(f64::total_cmp);
    let usual = all.get(all.len().saturating_sub(1) * 97 / 100).copied().unwrap_or(most);
    let scale = Scale {
        numbers: [0.0, usual.max(1e-6)],
        places: [0.0, 1.0],
    };
    let ticks = scale.ticks(STEPS.len());
    ticks.get(1).copied().unwrap_or(1.0)
}

/// Where maps are.
enum Places {
    /// Planned ones above executed ones.
    Rows([Grid; 2]),
    /// All in one field; of each plate the planned one first.
    Field { grid: Grid, each: usize },
}

impl Places {
    fn new(room: Rect, plates: usize, both: bool) -> Self {
        let under = 56.0;
        if !both || plates > 4 {
            let each = if both { 2 } else { 1 };
            let grid = Grid::new(room, each * plates, under);
            return Self::Field { grid, each };
        }
        let half = 0.5 * room.size[1];
        let rows = [0.0, half].map(|down| Rect::new(room.at[0], room.at[1] + down, room.size[0], half - 8.0));
        Self::Rows(rows.map(|row| Grid::row(row, plates, under)))
    }

    fn of(&self, map: &Map) -> Rect {
        let executed = usize::from(map.of == Of::Executed);
        match self {
            Self::Rows(rows) => rows[executed].cell(map.place),
            Self::Field { grid, each } => grid.cell(each * map.place + executed),
        }
    }
}

impl Map {
    fn draw(&self, drawing: &mut Drawing, cell: Rect, subject: &Subject<'_>, step: f64) {
        let edge = cell.size[0] / CELLS as f64;
        let mut of_colour: Vec<(&str, Vec<Rect>)> = Vec::new();
        let rows = self.dwell_s.chunks(CELLS).enumerate();
        for (y, row) in rows {
            let top = cell.at[1] + (CELLS - 1 - y) as f64 * edge;
            let mut from = 0;
            for run in row.chunk_by(|a, b| a.map(|s| colour(s, step)) == b.map(|s| colour(s, step))) {
                let rect = Rect::new(cell.at[0] + from as f64 * edge, top, run.len() as f64 * edge, edge);
                from += run.len();
                let Some(colour) = run[0].map(|seconds| colour(seconds, step)) else {
                    continue;
                };
                match of_colour.iter_mut().find(|(other, _)| *other == colour) {
                    Some((_, cells)) => cells.push(rect),
                    None => of_colour.push((colour, vec![rect])),
                }
            }
        }
        let (middle, radius) = (cell.middle(), 0.5 * cell.size[0]);
        drawing.within_circle(middle, radius, |drawing| {
            of_colour
                .iter()
                .for_each(|(colour, cells)| drawing.cells(cells, colour));
        });
        drawing.circle(middle, radius, &Style::fill("none").outlined(LINE, 2.0));
        self.words(drawing, cell, subject);
    }

    /// Share of the cells that count, all alike.
    fn share(&self) -> f64 {
        let all = self.dwell_s.iter().flatten();
        let (count, most) = all.fold((0.0, 0.0), |(count, most), seconds| {
            (count + f64::from(u8::from(*seconds > 0.0)), most + 1.0)
        });
        if most > 0.0 { count / most } else { 0.0 }
    }

    fn words(&self, drawing: &mut Drawing, cell: Rect, subject: &Subject<'_>) {
        let [x, y] = [cell.middle()[0], cell.end()[1]];
        let what = match self.of {
            Of::Planned => "planned",
            Of::Executed => "executed",
        };
        let title = format!("{}: plate {}, {what}", self.place + 1, self.plate);
        drawing.text([x, y + 24.0], &title, &Lettering::new(17.0, GREY).centred());
        let outcome = subject.executed.and_then(|(_, report)| {
            let mut all = report.plates.iter();
            all.find(|outcome| outcome.plate == self.plate)
        });
        let promised = self.counted.filter(|counted| counted.is_promised);
        let asked = &subject.plan.job.requirements;
        let required = match (promised, &asked.contact) {
            (Some(_), Some(contact)) => contact.share,
            _ => asked.coverage,
        };
        let proved = subject
            .certificate
            .and_then(|certificate| proved_share(certificate, self.plate, self.counted));
        let (share, words) = match (self.of, proved, outcome) {
            (Of::Planned, Some(proved), _) => (
                proved,
                if promised.is_some() {
                    "pressed, proved: ≥ "
                } else {
                    "swept, proved: ≥ "
                },
            ),
            // What a simulation measures is what is swept; of what is pressed there is the map.
            _ if self.counted.is_some() => (self.share(), "on the map: "),
            (Of::Planned, None, Some(outcome)) => (outcome.planned.lower, "swept: "),
            (Of::Executed, _, Some(outcome)) => (outcome.executed.lower, "swept: "),
            _ => return,
        };
        let colour = if reaches(share, required) { GOOD } else { BAD };
        let how = Lettering::new(19.0, colour).bold().centred();
        drawing.text([x, y + 48.0], &format!("{words}{}", per_cent(share)), &how);
    }
}

fn colour(seconds: f64, step: f64) -> &'static str {
    if seconds <= 0.0 {
        return MISSED;
    }
    let place = (seconds / step).floor() as usize;
    STEPS[place.min(STEPS.len() - 1)]
}

/// What colours mean.
fn key(drawing: &mut Drawing, room: Rect, step: f64, [never, words]: [&str; 2]) {
    let (width, height) = (92.0, 22.0);
    let [mut x, y] = room.at;
    let how = Lettering::new(17.0, INK);
    let small = Lettering::new(16.0, GREY).centred();
    drawing.rect(Rect::new(x, y, 40.0, height), 0.0, &Style::fill(MISSED));
    drawing.text([x + 50.0, y + 0.5 * height + how.drop()], never, &how);
    x += 160.0;
    drawing.text([x, y + 0.5 * height + how.drop()], words, &how);
    x += how.weight.width(words, 17.0) + 22.0;
    let ticks: Vec<f64> = (0..STEPS.len()).map(|k| k as f64 * step).collect();
    for (k, (colour, tick)) in STEPS.into_iter().zip(super::ink::axes::words(&ticks)).enumerate() {
        let at = x + k as f64 * width;
        drawing.rect(Rect::new(at, y, width, height), 0.0, &Style::fill(colour));
        drawing.text([at, y + height + 19.0], &tick, &small);
    }
    let more = Lettering::new(16.0, GREY);
    drawing.text(
        [x + STEPS.len() as f64 * width + 12.0, y + 0.5 * height + more.drop()],
        "and more",
        &more,
    );
}
