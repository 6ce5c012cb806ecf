//! What the tip was to follow on each plate, and what it followed: both from above, plate by plate.

use super::error::FigureError;
use super::grid::Grid;
use super::ink::axes::Axes;
use super::ink::drawing::{Drawing, Lettering, Rect, Spot};
use super::ink::legend::{self, Entry};
use super::ink::page;
use super::ink::palette::{EXECUTED, GREY, GROUND, INK, LINE};
use super::ink::style::Style;
use super::subject::Subject;
use super::track::TrackPoint;
use super::wording::{number, per_cent};
use crate::view::Counted;
use crate::view::coverage::swept;
use crate::view::tips::Tip;
use nalgebra::Vector3;
use platewash_workcell::plate::Plate;

/// Most plates of one figure.
const MOST: usize = 24;

/// Cells along an edge of what is reached of a plate.
const CELLS: usize = 180;

/// Room for words under a plate, and for its errors \[px\].
const UNDER: f64 = 78.0;
const ERRORS: f64 = 290.0;

/// Draws it.
///
/// # Errors
/// [`FigureError::NothingWashed`].
pub(super) fn draw(subject: &Subject<'_>) -> Result<Drawing, FigureError> {
    let washes: Vec<_> = subject.washes().collect();
    if washes.is_empty() {
        return Err(FigureError::NothingWashed { figure: "spiral" });
    }
    let what = match subject.executed {
        Some((_, report)) => format!("under the law “{}”", report.law.name()),
        None => "as planned; nothing was simulated".to_owned(),
    };
    let mut caption = format!(
        "Each plate along its axis, in the order of washing: what the tip was to follow, and what it followed {what}. Error: distance of \
         the tip from where the plan has it at that time."
    );
    if washes.len() > MOST {
        caption = format!("The first {MOST} of {} plates. {caption}", washes.len());
    }
    let (mut drawing, room) = page::begin(&subject.words("Ideal and executed path", &caption));
    let top = legend::row(&mut drawing, room.at, room.size[0], &entries(subject)) + 12.0;
    let shown = &washes[..washes.len().min(MOST)];
    let field = Rect::new(room.at[0], top, room.size[0], room.end()[1] - top);
    // Few plates have room for their errors below.
    let few = subject.executed.is_some() && shown.len() <= 4;
    let grid = if few {
        Grid::row(field, shown.len(), UNDER + ERRORS)
    } else {
        Grid::new(field, shown.len(), UNDER)
    };
    let most_m = subject.executed.map_or(0.0, |(_, report)| {
        let all = shown.iter().filter_map(|(segment, _)| report.segments.get(*segment));
        all.map(|segment| segment.tracking.tip_m.max).fold(0.0, f64::max)
    });
    for (place, &(segment, stretch)) in shown.iter().enumerate() {
        let plate = &subject.plan.job.plates[stretch.plate];
        let panel = Panel {
            subject,
            plate,
            index: stretch.plate,
            segment,
        };
        let cell = grid.cell(place);
        panel.draw(&mut drawing, cell, place);
        if few {
            let below = Rect::new(
                cell.at[0] + 62.0,
                cell.end()[1] + UNDER + 8.0,
                cell.size[0] - 62.0,
                ERRORS - 70.0,
            );
            panel.errors(&mut drawing, below, most_m, place == 0);
        }
    }
    Ok(drawing)
}

fn entries(subject: &Subject<'_>) -> Vec<Entry> {
    let mut all = vec![Entry::line(ideal(), "to be followed")];
    if subject.executed.is_some() {
        all.push(Entry::line(executed(), "followed"));
    } else {
        all.push(Entry::line(executed(), "planned"));
    }
    all.push(Entry::field(band(), reached(subject)));
    all.push(Entry::line(Style::line(LINE, 2.0), "the plate's rim"));
    all
}

/// What the coloured part of a plate is.
fn reached(subject: &Subject<'_>) -> String {
    let job = &subject.plan.job;
    let sponge = 1e3 * job.workcell.tool.sponge.radius_m;
    let washed = || subject.washes().filter_map(|(_, wash)| job.plates.get(wash.plate));
    let counted: Vec<Option<Counted>> = washed().map(|plate| Counted::on(plate, job)).collect();
    match counted.iter().flatten().find(|counted| counted.is_promised) {
        Some(counted) => format!(
            "pressed by {} mm or more by a sponge of {sponge:.0} mm, the plate within ±{} mm",
            number(1e3 * counted.compression_m),
            number(1e3 * counted.height_error_m),
        ),
        None if counted.iter().all(Option::is_some) => {
            format!("what a sponge of {sponge:.0} mm touches on the path followed")
        }
        None => format!("what a sponge of {sponge:.0} mm sweeps on the path followed"),
    }
}

fn ideal() -> Style {
    Style::line("#e27fbb", 5.0)
}

fn executed() -> Style {
    Style::line(EXECUTED, 1.6)
}

/// What is swept or pressed.
const BAND: &str = "#fbe3d3";

fn band() -> Style {
    Style::fill(BAND)
}

struct Panel<'a> {
    subject: &'a Subject<'a>,
    plate: &'a Plate,
    index: usize,
    segment: usize,
}

impl Panel<'_> {
    fn draw(&self, drawing: &mut Drawing, cell: Rect, place: usize) {
        let (rim, sponge) = (self.plate.rim_m(), self.subject.plan.job.workcell.tool.sponge.radius_m);
        let followed = self.followed();
        let farthest = followed.iter().map(|at| at.norm()).fold(0.0, f64::max);
        // A sponge on the rim is in the frame; what goes farther is cut, and its distance stated.
        let half = 1.03 * (rim + sponge);
        let axes = Axes::new(cell, [-half, half], [-half, half]);
        let spot = |at: &Vector3<f64>| axes.at(at.x, at.y);
        let pixels = |length: f64| length * cell.size[0] / (2.0 * half);
        let middle = axes.at(0.0, 0.0);
        let line: Vec<Spot> = followed.iter().map(spot).collect();
        drawing.within_rect(cell, |drawing| {
            drawing.circle(middle, pixels(rim), &Style::fill(GROUND));
            drawing.within_circle(middle, pixels(rim), |drawing| {
                match Counted::on(self.plate, &self.subject.plan.job) {
                    Some(counted) => self.pressed(drawing, &axes, &counted),
                    None => drawing.polyline(&line, &Style::line(BAND, pixels(2.0 * sponge))),
                }
            });
            drawing.circle(middle, pixels(rim), &Style::fill("none").outlined(LINE, 2.0));
            for ideal in self.subject.ideal.iter().filter(|ideal| ideal.plate == self.index) {
                let points: Vec<Spot> = ideal.points.iter().map(|at| spot(&self.plate.local(at))).collect();
                drawing.polyline(&points, &self::ideal());
            }
            drawing.polyline(&line, &executed());
            // The sponge where the wash ends.
            if let Some(end) = line.last() {
                let style = Style::fill("none").outlined(INK, 1.4).dashed(&[4.0, 3.0]);
                drawing.circle(*end, pixels(sponge), &style);
            }
        });
        drawing.rect(cell, 0.0, &Style::fill("none").outlined("#d5dae0", 1.0));
        self.words(drawing, cell, place, farthest);
    }

    /// The track that was followed; where nothing was simulated, the planned one.
    fn track(&self) -> &[TrackPoint] {
        let track = self.subject.followed.as_ref().unwrap_or(&self.subject.planned);
        track.within(self.segment)
    }

    /// What counts as pressed on the way that was followed.
    fn pressed(&self, drawing: &mut Drawing, axes: &Axes, counted: &Counted) {
        let rim = self.plate.rim_m();
        let way: Vec<Tip> = self.track().iter().map(Tip::from).collect();
        let tool = &self.subject.plan.job.workcell.tool;
        let raster = swept(self.plate, tool, Some(counted), std::iter::once(way), CELLS);
        let edge = |index: usize| rim * (2.0 * index as f64 / CELLS as f64 - 1.0);
        let mut cells = Vec::new();
        for (row, seconds) in raster.dwell_s().chunks(CELLS).enumerate() {
            let mut from = 0;
            for run in seconds.chunk_by(|a, b| is_some_time(a) == is_some_time(b)) {
                let to = from + run.len();
                if run.first().is_some_and(is_some_time) {
                    let (low, high) = (axes.at(edge(from), edge(row)), axes.at(edge(to), edge(row + 1)));
                    cells.push(Rect::new(low[0], high[1], high[0] - low[0], low[1] - high[1]));
                }
                from = to;
            }
        }
        drawing.cells(&cells, BAND);
    }

    /// The way of the tip along the plate's axis, plate frame \[m\].
    fn followed(&self) -> Vec<Vector3<f64>> {
        self.track()
            .iter()
            .map(|point| flat(self.plate.local(&point.at)))
            .collect()
    }

    /// Distance of the tip from where the plan has it, over the time of the wash.
    fn errors(&self, drawing: &mut Drawing, frame: Rect, most_m: f64, first: bool) {
        let Some(followed) = &self.subject.followed else { return };
        let points = followed.within(self.segment);
        let [Some(from), Some(to)] = [points.first(), points.last()] else {
            return;
        };
        let at = |t: f64| {
            self.subject
                .motion
                .at(t)
                .map(|state| self.subject.tip_pose(&state.q).translation.vector)
        };
        let off = |point: &TrackPoint| Some((point.t_s - from.t_s, 1e3 * (point.at - at(point.t_s)?).norm()));
        let errors: Vec<(f64, f64)> = points.iter().filter_map(off).collect();
        let most = errors.iter().map(|(_, error)| *error).fold(1e3 * most_m, f64::max);
        let axes = Axes::new(frame, [0.0, (to.t_s - from.t_s).max(1e-6)], [0.0, 1.1 * most.max(1e-6)]);
        let (across, up) = (axes.across.ticks(4), axes.up.ticks(4));
        axes.grid(drawing, &across, &up);
        let line: Vec<Spot> = errors.iter().map(|&(t, error)| axes.at(t, error)).collect();
        drawing.within_rect(frame, |drawing| drawing.polyline(&line, &executed()));
        axes.outline(drawing);
        axes.numbers_below(drawing, &across);
        axes.numbers_left(drawing, &up);
        axes.name_below(drawing, "time of the wash [s]");
        if first {
            axes.name_left(drawing, "error [mm]", 50.0);
        }
    }

    fn words(&self, drawing: &mut Drawing, cell: Rect, place: usize, farthest: f64) {
        let [x, y] = [cell.at[0], cell.end()[1]];
        let big = Lettering::new(18.0, INK).bold();
        let small = Lettering::new(16.0, GREY);
        drawing.text([x, y + 24.0], &format!("{}: plate {}", place + 1, self.index), &big);
        let reach = format!(
            "at most {:.0} mm from the centre, of {:.0}",
            1e3 * farthest.min(10.0),
            1e3 * self.plate.rim_m()
        );
        let Some((_, report)) = self.subject.executed else {
            return;
        };
        if let Some(outcome) = report.plates.iter().find(|outcome| outcome.plate == self.index) {
            let words = format!("{} swept", per_cent(outcome.executed.lower));
            drawing.text([cell.end()[0], y + 24.0], &words, &big.to_the_left());
        }
        if let Some(tracking) = report.segments.get(self.segment) {
            let tip = &tracking.tracking.tip_m;
            let words = format!(
                "error {} mm rms, {} mm at most",
                millimetres(tip.rms),
                millimetres(tip.max)
            );
            drawing.text([x, y + 47.0], &small.weight.fitted(&words, 16.0, cell.size[0]), &small);
        }
        if self.subject.is_paper() {
            drawing.text([x, y + 68.0], &small.weight.fitted(&reach, 16.0, cell.size[0]), &small);
        }
    }
}

/// Whether a cell counts for some time.
fn is_some_time(seconds: &Option<f64>) -> bool {
    seconds.is_some_and(|seconds| seconds > 0.0)
}

fn flat(at: Vector3<f64>) -> Vector3<f64> {
    Vector3::new(at.x, at.y, 0.0)
}

/// A length with as many decimals as it is worth.
fn millimetres(length_m: f64) -> String {
    let length = 1e3 * length_m;
    match length {
        l if l >= 10.0 => format!("{l:.0}"),
        l if l >= 0.1 => format!("{l:.2}"),
        l => format!("{l:.3}"),
    }
}
