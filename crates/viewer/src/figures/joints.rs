//! Joints and tip over time: positions, speeds and accelerations as shares of the limits.

use super::axes::{Axes, ROOM};
use super::figure_data::{FigureData, short};
use super::page::{self, Entry, Sign, legend};
use super::svg::{
    BAD, DOTTED, Drawing, END, HOME, JOINTS, LIFT, MIDDLE, PAPER, Rect, TRANSIT, WASH, fill, stroke, width,
};
use platewash_certificate::ClearanceRule;
use platewash_kinematics::AXES;
use platewash_motion::trajectory::{JointState, SegmentKind};
use platewash_workcell::words::plate_name;
use rayon::prelude::*;

/// Moments that are drawn.
const MOMENTS: usize = 1200;

/// Height of the strip that names the segments of the motion \[px\].
const STRIP: f64 = 26.0;

/// Share of the numbers that a diagram shows, where the others are so much greater that nothing else would be seen.
const USUAL: f64 = 0.985;

/// Draws it.
pub(super) fn draw(data: &FigureData<'_>) -> Drawing {
    let caption = format!(
        "In per cent of the joints' limits; position: −100 % at the lower limit, 100 % at the upper. Limits of acceleration are the job's \
         assumption. Drawn at {MOMENTS} moments, not a proof."
    );
    let (mut drawing, room) = page::begin(&data.texts("Joints and tip", caption));
    let duration = data.motion.duration_s();
    let times: Vec<f64> = (0..=MOMENTS).map(|k| duration * k as f64 / MOMENTS as f64).collect();
    let (left, wide) = (room.at[0] + ROOM[0], room.size[0] - ROOM[0]);
    let end = legend(&mut drawing, [left, room.at[1] - 4.0], wide, &entries(data));
    let panels = panels(data, &times);
    let (top, gap) = (end + STRIP + 14.0, 18.0);
    let height = (room.end()[1] - ROOM[1] - top + gap) / panels.len() as f64 - gap;
    for (k, panel) in panels.iter().enumerate() {
        let frame = Rect::new(left, top + k as f64 * (height + gap), wide, height);
        let axes = Axes::new(frame, [0.0, duration], panel.range);
        if k == 0 {
            segments(&mut drawing, data, &axes);
        }
        let below = (k + 1 == panels.len()).then_some("time [s]");
        panel.draw(&mut drawing, &axes, data, &times, below);
    }
    drawing
}

/// A diagram of the column.
struct Panel {
    name: &'static str,
    range: [f64; 2],
    /// Limits that must not be exceeded.
    limits: Vec<f64>,
    /// Words at its upper edge.
    words: String,
    /// Lines with their looks.
    lines: Vec<(Vec<f64>, String)>,
}

/// The look of a joint's line, as on the page: joints 4 to 6 are dashed, so that colours are not all that tells them from 1 to 3.
fn look(joint: usize) -> String {
    let dashes = if joint < 3 { "" } else { " stroke-dasharray=\"7 4\"" };
    stroke(JOINTS[joint], 1.8) + dashes
}

fn panels(data: &FigureData<'_>, times: &[f64]) -> Vec<Panel> {
    let limits = data.arm.limits();
    let accelerations = &data.plan.job.limits.joint_acceleration_rad_s2;
    let states: Vec<JointState> = times.iter().filter_map(|&t| data.motion.at(t)).collect();
    let of = |value: &dyn Fn(usize, &JointState) -> f64| -> Vec<(Vec<f64>, String)> {
        let line = |joint: usize| states.iter().map(|state| 100.0 * value(joint, state)).collect();
        (0..AXES).map(|joint| (line(joint), look(joint))).collect()
    };
    let position = of(&|joint, state| {
        let (low, high) = (limits.lower[joint], limits.upper[joint]);
        let share = (2.0 * state.q[joint] - low - high) / (high - low);
        // In the middle wherever there is no limit.
        if share.is_finite() { share } else { 0.0 }
    });
    let speed = of(&|joint, state| state.qd[joint] / limits.velocity[joint]);
    let acceleration = of(&|joint, state| state.qdd[joint] / accelerations[joint]);
    let tip = states.iter().map(|state| data.tip_speed(&state.q, &state.qd));
    let mut all = vec![
        Panel::new("position [%]", position, [-100.0, 100.0]),
        Panel::new("speed [%]", speed, [-100.0, 100.0]),
        Panel::new("accel. [%]", acceleration, [-100.0, 100.0]),
        tip_panel(data, tip.collect()),
    ];
    all.extend(clearance_panel(data, times));
    all
}

/// The smallest distance of all pairs that count, by the rule of the certificate; none where there is no such pair, or no such rule.
fn clearance_panel(data: &FigureData<'_>, times: &[f64]) -> Option<Panel> {
    let rule = ClearanceRule::new(data.plan, data.arm).ok()?;
    let segments = &data.plan.segments;
    let distance = |t: &f64| {
        let segment = segments.partition_point(|segment| segment.t_end_s < *t);
        let nearest = rule.nearest(&data.motion.at(*t)?.q, Some(segment))?;
        Some(1e3 * nearest.distance_m)
    };
    // Where nothing counts, nothing is near.
    let seen: Vec<Option<f64>> = times.par_iter().map(distance).collect();
    let least = seen.iter().flatten().copied().fold(f64::INFINITY, f64::min);
    let margin = 1e3 * data.plan.job.requirements.clearance_m;
    let far = 100.0_f64.max(3.0 * margin);
    let line = seen.iter().map(|distance| distance.unwrap_or(far).min(far)).collect();
    least.is_finite().then(|| Panel {
        name: "gap [mm]",
        range: [least.min(0.0) - 0.08 * far, 1.08 * far],
        limits: vec![margin],
        words: format!("smallest distance, drawn up to {far:.0} mm; {margin:.0} mm must be kept"),
        lines: vec![(line, stroke(TRANSIT, 1.8))],
    })
}

fn tip_panel(data: &FigureData<'_>, speeds: Vec<f64>) -> Panel {
    let terms = &data.plan.job;
    let (anywhere, washing) = (terms.limits.tip_speed_m_s, terms.wash_speed_m_s());
    let panel = Panel::new("tip [m/s]", vec![(speeds, stroke(TRANSIT, 1.8))], [0.0, anywhere]);
    let limits = format!("limits: {anywhere} m/s anywhere, {washing} m/s while it washes");
    let words: Vec<String> = [limits, panel.words]
        .into_iter()
        .filter(|words| !words.is_empty())
        .collect();
    Panel {
        // Room for the words above the limit.
        range: [panel.range[0], 1.32 * panel.range[1]],
        limits: vec![washing, anywhere],
        words: words.join("; "),
        ..panel
    }
}

impl Panel {
    /// A diagram of lines that must stay between two numbers. Its range has both numbers and all lines in it, except values much
    /// greater than nearly all of them.
    fn new(name: &'static str, lines: Vec<(Vec<f64>, String)>, limits: [f64; 2]) -> Self {
        let mut numbers: Vec<f64> = lines.iter().flat_map(|(line, _)| line.iter().copied()).collect();
        numbers.sort_unstable_by(f64::total_cmp);
        let at = |share: f64| numbers[(share * (numbers.len() - 1) as f64) as usize];
        let [low, high] = if numbers.is_empty() { limits } else { [at(0.0), at(1.0)] };
        let with = |low: f64, high: f64| [low.min(limits[0]), high.max(limits[1])];
        let all = with(low, high);
        let usual = if numbers.is_empty() {
            all
        } else {
            with(at(1.0 - USUAL), at(USUAL))
        };
        let is_cut = all[1] - all[0] > 3.0 * (usual[1] - usual[0]);
        let [from, to] = if is_cut { usual } else { all };
        let more = 0.08 * (to - from);
        let range = [from - more, to + more];
        let beyond = [low, high]
            .into_iter()
            .filter(|number| !(range[0]..=range[1]).contains(number));
        let beyond: Vec<String> = beyond.map(|number| short(number.round())).collect();
        Self {
            name,
            range,
            limits: limits.to_vec(),
            words: match beyond.is_empty() {
                true => String::new(),
                false => format!("beyond the frame: up to {}", beyond.join(" and ")),
            },
            lines,
        }
    }

    fn draw(&self, drawing: &mut Drawing, axes: &Axes, data: &FigureData<'_>, times: &[f64], below: Option<&str>) {
        let ([_, top], [_, height]) = (axes.frame.at, axes.frame.size);
        axes.draw(drawing, [12, 4], [below, Some(self.name)], |drawing| {
            for (_, wash) in data.washes() {
                let [from, to] = [wash.t_start_s, wash.t_end_s].map(|t| axes.across.at(t));
                drawing.rect(
                    Rect::new(from, top, to - from, height),
                    &(fill(WASH) + " fill-opacity=\"0.07\""),
                );
            }
            for limit in &self.limits {
                axes.limit(drawing, *limit, &(stroke(BAD, 1.4) + DOTTED));
            }
            for (values, look) in &self.lines {
                let spots = times.iter().zip(values).map(|(&t, &value)| axes.at(t, value));
                drawing.lines(&[spots.collect()], look);
            }
        });
        if !self.words.is_empty() {
            let ([right, _], top) = (axes.frame.end(), axes.frame.at[1]);
            let wide = width(&self.words, 17.0);
            drawing.rect(
                Rect::new(right - 16.0 - wide, top + 3.0, wide + 12.0, 23.0),
                &fill(PAPER),
            );
            drawing.text(
                [right - 10.0, top + 20.0],
                &self.words,
                &["font-size=\"17\"", &fill(BAD), END],
            );
        }
    }
}

fn colour(kind: SegmentKind) -> &'static str {
    match kind {
        SegmentKind::Wash => WASH,
        SegmentKind::Approach | SegmentKind::Retreat => LIFT,
        SegmentKind::Transit => TRANSIT,
        SegmentKind::Depart | SegmentKind::Return => HOME,
    }
}

/// Draws the segments of the motion over time, as a strip above the diagrams.
fn segments(drawing: &mut Drawing, data: &FigureData<'_>, axes: &Axes) {
    let top = axes.frame.at[1] - STRIP - 5.0;
    for segment in &data.plan.segments {
        let [from, to] = [segment.t_start_s, segment.t_end_s].map(|t| axes.across.at(t));
        let field = Rect::new(from, top, to - from, STRIP);
        drawing.rect(field, &fill(colour(segment.kind)));
        let words = plate_name(segment.plate);
        if segment.kind == SegmentKind::Wash && width(&words, 17.0) < to - from - 8.0 {
            drawing.text(
                [field.middle()[0], top + 19.0],
                &words,
                &["font-size=\"17\"", &fill(PAPER), MIDDLE],
            );
        }
    }
}

fn entries(data: &FigureData<'_>) -> Vec<Entry> {
    let joint = |k: usize| Entry::new(Sign::Line, look(k), format!("joint {}", k + 1));
    let field = |kind, words| Entry::new(Sign::Field, fill(colour(kind)), words);
    let mut all: Vec<Entry> = (0..AXES).map(joint).collect();
    all.push(Entry::new(Sign::Line, stroke(BAD, 1.8) + DOTTED, "limit"));
    if data.has(SegmentKind::Wash) {
        all.push(field(SegmentKind::Wash, "washes"));
        all.push(field(SegmentKind::Transit, "transits"));
    }
    all.push(field(SegmentKind::Depart, "from and to home"));
    if data.has(SegmentKind::Approach) || data.has(SegmentKind::Retreat) {
        all.push(field(SegmentKind::Approach, "down and up"));
    }
    all
}
