//! Commanded and executed path of the tip on each plate: both from above, plate by plate.

use super::axes::{Axes, ROOM};
use super::error::FigureError;
use super::fields::{Fields, colour_cells};
use super::figure_data::{FigureData, first_of, per_cent, short};
use super::page::{self, Entry, Sign, legend};
use super::svg::{DASHED, Drawing, END, EXECUTED, GREY, GROUND, INK, LINE, Rect, Spot, fill, fitted, stroke};
use crate::view::tips::Tip;
use platewash_workcell::plate::Plate;
use platewash_workcell::words::plate_name;

/// Most plates of one figure.
const MOST: usize = 24;

/// Most plates that have room for their errors below.
const FEW: usize = 4;

/// Number of cells along an edge of the reached area of a plate.
const CELLS: usize = 150;

/// Room for words under a plate, and for its errors \[px\].
const UNDER: f64 = 82.0;
const ERRORS: f64 = 290.0;

/// The colour of swept or pressed area, and of the commanded path.
const BAND: &str = "#fbe3d3";
const IDEAL: &str = "#e27fbb";

/// Draws it.
///
/// # Errors
/// [`FigureError::NothingWashed`].
pub(super) fn draw(data: &FigureData<'_>) -> Result<Drawing, FigureError> {
    let panels: Vec<Panel<'_>> = data
        .washes()
        .map(|(segment, wash)| Panel::new(data, segment, wash.plate))
        .collect();
    if panels.is_empty() {
        return Err(FigureError::NothingWashed { figure: "spiral" });
    }
    let shown = &panels[..panels.len().min(MOST)];
    let (mut drawing, room) = page::begin(&data.texts("Ideal and executed path", caption(data, panels.len())));
    let top = legend(&mut drawing, room.at, room.size[0], &entries(data)) + 12.0;
    let field = Rect::new(room.at[0], top, room.size[0], room.end()[1] - top);
    let has_errors = data.report.is_some() && shown.len() <= FEW;
    let fields = match has_errors {
        true => Fields::new(field, shown.len(), Some(shown.len()), UNDER + ERRORS),
        false => Fields::new(field, shown.len(), None, UNDER),
    };
    for (place, panel) in shown.iter().enumerate() {
        let cell = fields.cell(place);
        panel.draw(&mut drawing, cell);
        panel.draw_texts(&mut drawing, cell, place);
        if has_errors {
            let [x, y] = [cell.at[0] + ROOM[0], cell.end()[1] + UNDER + 8.0];
            let frame = Rect::new(x, y, cell.size[0] - ROOM[0], ERRORS - ROOM[1] - 12.0);
            panel.errors(&mut drawing, frame);
        }
    }
    Ok(drawing)
}

fn caption(data: &FigureData<'_>, plates: usize) -> String {
    let what = match data.report {
        Some(report) => format!("under the law “{}”", report.law.name()),
        None => "as planned; nothing was simulated".to_owned(),
    };
    let first = first_of(MOST, plates);
    format!(
        "{first}Each plate along its axis, in the order of washing: what the tip was to follow, and what it followed {what}. Error: distance of \
         the tip from where the plan has it at that time."
    )
}

fn entries(data: &FigureData<'_>) -> Vec<Entry> {
    let followed = if data.report.is_some() { "followed" } else { "planned" };
    vec![
        Entry::new(Sign::Line, stroke(IDEAL, 5.0), "to be followed"),
        Entry::new(Sign::Line, stroke(EXECUTED, 1.6), followed),
        Entry::new(Sign::Field, fill(BAND), coloured_part_text(data)),
        Entry::new(Sign::Line, stroke(LINE, 2.0), "the plate's rim"),
    ]
}

/// Describes the coloured part of a plate.
fn coloured_part_text(data: &FigureData<'_>) -> String {
    let job = &data.plan.job;
    let sponge = format!("a sponge of {:.0} mm", 1e3 * job.workcell.tool.sponge.radius_m);
    let counted = data.counted();
    match counted.iter().flatten().find(|counted| counted.is_promised) {
        Some(counted) => format!(
            "pressed by {} mm or more by {sponge}, the plate within ±{} mm",
            short(1e3 * counted.compression_m),
            short(1e3 * counted.height_error_m),
        ),
        None if counted.iter().all(Option::is_some) => format!("what {sponge} touches on the path followed"),
        None => format!("what {sponge} sweeps on the path followed"),
    }
}

/// A plate with the segment that washes it.
struct Panel<'a> {
    data: &'a FigureData<'a>,
    plate: &'a Plate,
    index: usize,
    segment: usize,
    /// The way that was followed; where nothing was simulated, the planned one.
    way: &'a [Tip],
}

impl<'a> Panel<'a> {
    fn new(data: &'a FigureData<'a>, segment: usize, index: usize) -> Self {
        let track = data.followed.as_ref().unwrap_or(&data.planned);
        Self {
            data,
            plate: &data.plan.job.plates[index],
            index,
            segment,
            way: &track[segment],
        }
    }

    fn draw(&self, drawing: &mut Drawing, cell: Rect) {
        let job = &self.data.plan.job;
        let (rim, sponge) = (self.plate.rim_m(), job.workcell.tool.sponge.radius_m);
        // A sponge on the rim is in the frame; a path that goes farther is cut, and its distance stated.
        let half = 1.03 * (rim + sponge);
        let axes = Axes::new(cell, [-half, half], [-half, half]);
        let pixels = |length: f64| length * cell.size[0] / (2.0 * half);
        let (middle, radius) = (cell.middle(), pixels(rim));
        let spot = |at| {
            let local = self.plate.local(at);
            axes.at(local.x, local.y)
        };
        let line: Vec<Spot> = self.way.iter().map(|tip| spot(&tip.at)).collect();
        let dwell_s = self.data.dwell_s(self.plate, self.way, CELLS);
        drawing.within(cell, |drawing| {
            drawing.circle(middle, radius, &fill(GROUND));
            let face = Rect::new(middle[0] - radius, middle[1] - radius, 2.0 * radius, 2.0 * radius);
            let is_reached = |seconds: &Option<f64>| seconds.is_some_and(|seconds| seconds > 0.0);
            colour_cells(drawing, face, &dwell_s, CELLS, |seconds| {
                is_reached(seconds).then_some(BAND)
            });
            drawing.circle(middle, radius, &stroke(LINE, 2.0));
            for ideal in self.data.ideal.iter().filter(|ideal| ideal.plate == self.index) {
                drawing.lines(&[ideal.points.iter().map(spot).collect()], &stroke(IDEAL, 5.0));
            }
            drawing.lines(std::slice::from_ref(&line), &stroke(EXECUTED, 1.6));
            // The sponge where the wash ends.
            if let Some(end) = line.last() {
                drawing.circle(*end, pixels(sponge), &(stroke(INK, 1.4) + DASHED));
            }
        });
        drawing.rect(cell, &stroke("#d5dae0", 1.0));
    }

    /// Distance of the tip from where the plan has it, over the time of the wash.
    fn errors(&self, drawing: &mut Drawing, frame: Rect) {
        let data = self.data;
        let (Some(report), [from, .., to]) = (data.report, self.way) else {
            return;
        };
        let tips = crate::view::tips::Tips::new(data.plan, data.arm, &data.motion);
        let off = |tip: &Tip| Some((tip.t_s - from.t_s, 1e3 * (tip.at - tips.at(tip.t_s)?.at).norm()));
        let errors: Vec<(f64, f64)> = self.way.iter().filter_map(off).collect();
        // One scale for all plates.
        let washes = data.washes().filter_map(|(segment, _)| report.segments.get(segment));
        let most = washes.map(|wash| 1e3 * wash.tracking.tip_m.max).fold(1e-6, f64::max);
        let most = errors.iter().map(|(_, error)| *error).fold(most, f64::max);
        let axes = Axes::new(frame, [0.0, (to.t_s - from.t_s).max(1e-6)], [0.0, 1.1 * most]);
        axes.draw(
            drawing,
            [4, 4],
            [Some("time of the wash [s]"), Some("error [mm]")],
            |drawing| {
                let line = errors.iter().map(|&(t, error)| axes.at(t, error));
                drawing.lines(&[line.collect()], &stroke(EXECUTED, 1.6));
            },
        );
    }

    fn draw_texts(&self, drawing: &mut Drawing, cell: Rect, place: usize) {
        let [x, y] = [cell.at[0], cell.end()[1]];
        let mut text = |at: Spot, words: &str, size: f64, share: f64, look: &[&str]| {
            let size = fitted(words, size, share * cell.size[0]);
            drawing.text(at, words, &[&[size.as_str()], look].concat());
        };
        let [bold, grey] = [fill(INK) + " font-weight=\"bold\"", fill(GREY)];
        text(
            [x, y + 24.0],
            &format!("{}: {}", place + 1, plate_name(self.index)),
            20.0,
            0.42,
            &[&bold],
        );
        let Some(report) = self.data.report else {
            return;
        };
        if let Some(outcome) = report.plates.iter().find(|outcome| outcome.plate == self.index) {
            let words = format!("{} swept", per_cent(outcome.executed.lower));
            text([cell.end()[0], y + 24.0], &words, 20.0, 0.56, &[&bold, END]);
        }
        if let Some(tracking) = report.segments.get(self.segment) {
            let [rms, max] = [tracking.tracking.tip_m.rms, tracking.tracking.tip_m.max].map(millimetres);
            let words = format!("error ≤ {max} mm, {rms} mm rms");
            text([x, y + 50.0], &words, 18.0, 1.0, &[&grey]);
        }
        if self.data.is_paper() {
            let local = self.way.iter().map(|tip| self.plate.local(&tip.at).xy().norm());
            let [far, rim] = [local.fold(0.0, f64::max), self.plate.rim_m()].map(|metres| 1e3 * metres);
            let words = format!("≤ {far:.0} mm from the centre (rim {rim:.0})");
            text([x, y + 72.0], &words, 18.0, 1.0, &[&grey]);
        }
    }
}

/// A length with as many decimals as it is worth.
fn millimetres(length_m: f64) -> String {
    match 1e3 * length_m {
        l if l >= 10.0 => format!("{l:.0}"),
        l if l >= 0.1 => format!("{l:.2}"),
        l => format!("{l:.3}"),
    }
}
