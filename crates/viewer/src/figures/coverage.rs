//! Swept area of each plate, or pressed area where the job states what counts as contact, with its dwell time: planned and
//! executed.

use super::axes::{round_above, tick_labels};
use super::error::FigureError;
use super::fields::{Fields, colour_cells};
use super::figure_data::{FigureData, Track, first_of, per_cent, short};
use super::page;
use super::svg::{BAD, Drawing, EXECUTED, GOOD, GREY, LINE, MIDDLE, Rect, SMALL, WORDS, fill, fitted, stroke, width};
use crate::view::PressedRule;
use crate::view::coverage::proved_share;
use platewash_bodies::coverage::reaches;
use platewash_motion::trajectory::PlanSegment;
use platewash_workcell::words::plate_name;

/// Greatest number of plates in one figure: with the planned motion alone, and with the executed one besides.
const MOST: [usize; 2] = [24, 12];

/// Most plates whose executed maps stand below the planned ones.
const IN_ROWS: usize = 4;

/// Cells along an edge of a map.
const CELLS: usize = 100;

/// Steps from little to much, light to dark.
const STEPS: [&str; 8] = [
    "#e5f5f9", "#cdeae6", "#a3d9cf", "#74c2b4", "#48a999", "#278a80", "#0f6b66", "#014d4d",
];

/// Colour of missed places.
const MISSED: &str = EXECUTED;

/// A map: a plate as planned or as executed.
struct Map {
    /// Its place in the order of washing, and the index of the plate.
    place: usize,
    plate: usize,
    is_executed: bool,
    counted: Option<PressedRule>,
    /// Time for which each cell counts \[s\]; `None` outside the rim.
    dwell_s: Vec<Option<f64>>,
}

/// Draws it.
///
/// # Errors
/// [`FigureError::NothingWashed`].
pub(super) fn draw(data: &FigureData<'_>) -> Result<Drawing, FigureError> {
    let washes: Vec<(usize, &PlanSegment)> = data.washes().collect();
    if washes.is_empty() {
        return Err(FigureError::NothingWashed { figure: "coverage" });
    }
    let tracks: Vec<&Track> = [&data.planned].into_iter().chain(&data.followed).collect();
    let plates = washes.len().min(MOST[tracks.len() - 1]);
    let maps: Vec<Map> = tracks
        .iter()
        .enumerate()
        .flat_map(|(of, track)| {
            let shown = washes[..plates].iter().enumerate();
            shown.map(move |(place, (segment, wash))| Map::new(data, place, (&track[*segment], wash.plate), of == 1))
        })
        .collect();
    let (mut drawing, room) = page::begin(&data.texts("Time under the sponge", caption(data, plates)));
    let step_s = step_s(&maps);
    let is_contact = maps.iter().all(|map| map.counted.is_some());
    key(&mut drawing, room, step_s, is_contact);
    let field = Rect::new(room.at[0], room.at[1] + 58.0, room.size[0], room.size[1] - 58.0);
    let in_rows = tracks.len() == 2 && plates <= IN_ROWS;
    let fields = Fields::new(field, maps.len(), in_rows.then_some(plates), 62.0);
    for map in &maps {
        let executed = usize::from(map.is_executed);
        let place = if in_rows {
            executed * plates + map.place
        } else {
            tracks.len() * map.place + executed
        };
        map.draw(&mut drawing, fields.cell(place), data, step_s);
    }
    Ok(drawing)
}

/// Caption: the meaning of the colours, and the requirements.
fn caption(data: &FigureData<'_>, plates: usize) -> String {
    let job = &data.plan.job;
    let sponge = format!("sponge, radius {:.0} mm", 1e3 * job.workcell.tool.sponge.radius_m);
    let least = short(100.0 * job.requirements.coverage);
    let counted = data.counted();
    let promised = counted.iter().flatten().find(|counted| counted.is_promised);
    let meaning = match (promised, &job.requirements.contact) {
        (Some(counted), Some(contact)) => format!(
            "is pressed by {} mm or more, wherever within ±{} mm the plate lies, by the {sponge}. At least {} % of a plate must be.",
            short(1e3 * counted.compression_m),
            short(1e3 * counted.height_error_m),
            short(100.0 * contact.share),
        ),
        _ if counted.iter().all(Option::is_some) => {
            format!("is touched by the {sponge}, pressed or not. At least {least} % of a plate must be.")
        }
        _ => format!(
            "is under the {sponge}; of a profile, is touched by it. At least {least} % of a plate must be swept."
        ),
    };
    let what = match data.followed {
        Some(_) => "Of each plate there is what is planned, and what is executed.",
        None => "Nothing was simulated.",
    };
    let first = first_of(plates, counted.len());
    format!("{first}Each plate along its axis: for how long the middle of each cell {meaning} {what}")
}

/// Time between two colours \[s\]: a round one, so that few cells have more than the last.
fn step_s(maps: &[Map]) -> f64 {
    let all = maps.iter().flat_map(|map| map.dwell_s.iter().flatten().copied());
    let mut all: Vec<f64> = all.filter(|seconds| *seconds > 0.0).collect();
    all.sort_unstable_by(f64::total_cmp);
    let usual = all.get(all.len().saturating_sub(1) * 97 / 100);
    round_above(usual.map_or(1.0, |usual| usual / STEPS.len() as f64))
}

impl Map {
    fn new(
        data: &FigureData<'_>,
        place: usize,
        (way, plate): (&[crate::view::tips::Tip], usize),
        is_executed: bool,
    ) -> Self {
        let of = &data.plan.job.plates[plate];
        Self {
            place,
            plate,
            is_executed,
            counted: PressedRule::on(of, &data.plan.job),
            dwell_s: data.dwell_s(of, way, CELLS),
        }
    }

    fn draw(&self, drawing: &mut Drawing, cell: Rect, data: &FigureData<'_>, step_s: f64) {
        colour_cells(drawing, cell, &self.dwell_s, CELLS, |dwell_s| {
            dwell_s.map(|s| colour(s, step_s))
        });
        drawing.circle(cell.middle(), 0.5 * cell.size[0], &stroke(LINE, 2.0));
        let [x, y] = [cell.middle()[0], cell.end()[1]];
        let what = if self.is_executed { "executed" } else { "planned" };
        let title = format!("{}: {}, {what}", self.place + 1, plate_name(self.plate));
        let size = |words: &str| fitted(words, 18.0, cell.size[0] + 20.0);
        drawing.text([x, y + 24.0], &title, &[&size(&title), &fill(GREY), MIDDLE]);
        if let Some((words, share, required)) = self.share(data) {
            let look = fill(if reaches(share, required) { GOOD } else { BAD });
            let words = format!("{words}{}", per_cent(share));
            drawing.text(
                [x, y + 51.0],
                &words,
                &[&size(&words), "font-weight=\"bold\"", &look, MIDDLE],
            );
        }
    }

    /// Returns the known share that counts: in words, the share, and the share required.
    fn share(&self, data: &FigureData<'_>) -> Option<(&'static str, f64, f64)> {
        let asked = &data.plan.job.requirements;
        let is_promised = self.counted.is_some_and(|counted| counted.is_promised);
        let contact = asked.contact.as_ref().filter(|_| is_promised);
        let required = contact.map_or(asked.coverage, |contact| contact.share);
        if let (false, Some(certificate)) = (self.is_executed, data.certificate)
            && let Some(proved) = proved_share(certificate, self.plate, self.counted)
        {
            let words = if is_promised {
                "pressed, proved: ≥ "
            } else {
                "swept, proved: ≥ "
            };
            return Some((words, proved, required));
        }
        // A simulation measures the swept area; the pressed area is taken from the map.
        if self.counted.is_some() {
            let inside = self.dwell_s.iter().flatten();
            let reached = inside.clone().filter(|seconds| **seconds > 0.0).count();
            return Some(("on the map: ", reached as f64 / inside.count().max(1) as f64, required));
        }
        let mut outcomes = data.report?.plates.iter();
        let outcome = outcomes.find(|outcome| outcome.plate == self.plate)?;
        let measured = if self.is_executed {
            &outcome.executed
        } else {
            &outcome.planned
        };
        Some(("swept: ", measured.lower, required))
    }
}

fn colour(seconds: f64, step_s: f64) -> &'static str {
    let place = (seconds / step_s).floor() as usize;
    if seconds > 0.0 {
        STEPS[place.min(STEPS.len() - 1)]
    } else {
        MISSED
    }
}

/// Draws the key of the colours.
fn key(drawing: &mut Drawing, room: Rect, step_s: f64, is_contact: bool) {
    let [never, what] = match is_contact {
        true => ["no contact", "time in contact [s]"],
        false => ["missed", "time under the sponge [s]"],
    };
    let ([left, y], [wide, high]) = (room.at, [64.0, 22.0]);
    drawing.rect(Rect::new(left, y, 40.0, high), &fill(MISSED));
    drawing.text([left + 50.0, y + 17.0], never, &[WORDS]);
    drawing.text([left + 180.0, y + 17.0], what, &[WORDS]);
    let left = left + 200.0 + width(what, 20.0);
    let starts: Vec<f64> = (0..STEPS.len()).map(|k| k as f64 * step_s).collect();
    for (k, (colour, start)) in STEPS.into_iter().zip(tick_labels(&starts)).enumerate() {
        let x = left + k as f64 * wide;
        drawing.rect(Rect::new(x, y, wide, high), &fill(colour));
        drawing.text([x, y + high + 20.0], &start, &[SMALL, MIDDLE]);
    }
    drawing.text(
        [left + STEPS.len() as f64 * wide + 12.0, y + 17.0],
        "and more",
        &[SMALL],
    );
}
