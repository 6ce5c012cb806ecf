//! Joints and tip over time: positions, speeds and accelerations as shares of what is allowed.

use super::ink::axes::{Axes, grouped, minus};
use super::ink::drawing::{Drawing, Lettering, Rect};
use super::ink::font::Weight;
use super::ink::legend::{self, Entry};
use super::ink::page;
use super::ink::palette::{BAD, INK, LIFT, PAPER, SIX, TRANSIT, WASH};
use super::ink::style::Style;
use super::subject::Subject;
use platewash_certificate::ClearanceRule;
use platewash_kinematics::AXES;
use platewash_workcell::segment::SegmentKind;
use platewash_workcell::trajectory::JointState;
use rayon::prelude::*;

/// Moments that are drawn.
const MOMENTS: usize = 1600;

/// Room for numbers and names to the left of the diagrams \[px\].
const LEFT: f64 = 104.0;

const LIMIT_DASHES: &[f64] = &[10.0, 6.0];

/// Draws it.
pub(super) fn draw(subject: &Subject<'_>) -> Drawing {
    let caption = "Position: 0 % is a joint's lowest, 100 % its highest. Speed and acceleration: shares of the joint's limits; those of \
                   acceleration are the job's assumption. Drawn at 1600 moments, not a proof.";
    let (mut drawing, room) = page::begin(&subject.words("Joints and tip", caption));
    let lines = Moments::of(subject);
    let top = legend::row(
        &mut drawing,
        [room.at[0] + LEFT, room.at[1] - 4.0],
        room.size[0] - LEFT,
        &entries(subject),
    ) + 8.0;
    let strip = 26.0;
    let frame = Rect::new(
        room.at[0] + LEFT,
        top,
        room.size[0] - LEFT,
        room.end()[1] - top - 50.0 - strip,
    );
    let panels = panels(subject, &lines);
    let gap = 16.0;
    let height = (frame.size[1] - gap * panels.len() as f64) / panels.len() as f64;
    let duration = subject.motion.duration_s();
    let mut last = None;
    for (k, panel) in panels.iter().enumerate() {
        let place = Rect::new(
            frame.at[0],
            frame.at[1] + k as f64 * (height + gap),
            frame.size[0],
            height,
        );
        let axes = Axes::new(place, [0.0, duration], panel.range);
        panel.draw(&mut drawing, &axes, &lines.times);
        last = Some(axes);
    }
    if let Some(axes) = last {
        segments(&mut drawing, subject, &axes, strip);
        let below = Axes {
            frame: Rect::new(
                axes.frame.at[0],
                axes.frame.at[1],
                axes.frame.size[0],
                axes.frame.size[1] + strip + 6.0,
            ),
            ..axes
        };
        below.numbers_below(&mut drawing, &axes.across.ticks(12));
        below.name_below(&mut drawing, "time [s]");
    }
    drawing
}

/// The motion at the moments that are drawn.
struct Moments {
    times: Vec<f64>,
    states: Vec<JointState>,
    tip: Vec<f64>,
}

impl Moments {
    fn of(subject: &Subject<'_>) -> Self {
        let duration = subject.motion.duration_s();
        let time = |k: usize| duration * k as f64 / MOMENTS as f64;
        let times: Vec<f64> = (0..=MOMENTS).map(time).collect();
        let states: Vec<JointState> = times.iter().filter_map(|&t| subject.motion.at(t)).collect();
        let tip = states
            .iter()
            .map(|state| subject.tip_speed(&state.q, &state.qd))
            .collect();
        Self { times, states, tip }
    }

    fn of_joint(&self, joint: usize, value: impl Fn(&JointState) -> f64) -> (Vec<f64>, Style) {
        (self.states.iter().map(value).collect(), Style::line(SIX[joint], 1.7))
    }
}

/// A diagram of the column.
struct Panel {
    name: &'static str,
    range: [f64; 2],
    /// What must not be exceeded.
    limits: Vec<f64>,
    /// What is said of it at its upper edge.
    words: Vec<String>,
    lines: Vec<(Vec<f64>, Style)>,
}

fn panels(subject: &Subject<'_>, moments: &Moments) -> Vec<Panel> {
    let limits = subject.arm.limits();
    let terms = &subject.plan.job;
    let of = |value: &dyn Fn(usize, &JointState) -> f64| {
        (0..AXES)
            .map(|joint| moments.of_joint(joint, |state| 100.0 * value(joint, state)))
            .collect::<Vec<_>>()
    };
    let position = of(&|joint, state| {
        let [low, high] = limits.sampling_range(joint);
        (state.q[joint] - low) / (high - low)
    });
    let speed = of(&|joint, state| state.qd[joint] / limits.velocity[joint]);
    let acceleration = of(&|joint, state| state.qdd[joint] / terms.limits.joint_acceleration_rad_s2[joint]);
    let mut all = vec![
        Panel::new("position [%]", position, [0.0, 100.0]),
        Panel::new("speed [%]", speed, [-100.0, 100.0]),
        Panel::new("accel. [%]", acceleration, [-100.0, 100.0]),
    ];
    all.push(tip_panel(subject, moments));
    all.extend(clearance_panel(subject, &moments.times));
    all
}

/// The smallest distance of all pairs that count, by the rule of the certificate; none where there is no such pair, or no such rule.
fn clearance_panel(subject: &Subject<'_>, times: &[f64]) -> Option<Panel> {
    let rule = ClearanceRule::new(subject.plan, subject.arm).ok()?;
    let segments = &subject.plan.segments;
    let distance = |t: &f64| {
        let segment = segments.partition_point(|segment| segment.t_end_s < *t);
        let nearest = rule.nearest(&subject.motion.at(*t)?.q, Some(segment))?;
        Some(1e3 * nearest.distance_m)
    };
    // Where nothing counts, nothing is near.
    let seen: Vec<Option<f64>> = times.par_iter().map(distance).collect();
    let least = seen.iter().flatten().copied().fold(f64::INFINITY, f64::min);
    let margin = 1e3 * subject.plan.job.requirements.clearance_m;
    let far = 100.0_f64.max(3.0 * margin);
    let line: Vec<f64> = seen.iter().map(|distance| distance.unwrap_or(far).min(far)).collect();
    least.is_finite().then(|| Panel {
        name: "gap [mm]",
        range: [least.min(0.0) - 0.04 * far, far],
        limits: vec![margin],
        words: vec![format!(
            "smallest distance, drawn up to {far:.0} mm; {margin:.0} mm must be kept"
        )],
        lines: vec![(line, Style::line(INK, 1.7))],
    })
}

fn tip_panel(subject: &Subject<'_>, moments: &Moments) -> Panel {
    let terms = &subject.plan.job;
    let (anywhere, washing) = (terms.limits.tip_speed_m_s, terms.wash_speed_m_s());
    let lines = vec![(moments.tip.clone(), Style::line(INK, 1.7))];
    let mut panel = Panel::new("tip [m/s]", lines, [0.0, anywhere]);
    // Room for the words above the limit.
    panel.range = [0.0, panel.range[1] + 0.32 * (panel.range[1] - panel.range[0])];
    panel.limits = vec![washing, anywhere];
    panel.words.insert(
        0,
        format!("limits: {anywhere} m/s anywhere, {washing} m/s while it washes"),
    );
    panel
}

/// Share of the numbers that a diagram shows, where the others are so much greater that nothing else would be seen.
const USUAL: f64 = 0.985;

impl Panel {
    /// A diagram of lines that must stay between two numbers: a range with both in it and all lines, but for what is much greater than
    /// nearly all of them.
    fn new(name: &'static str, lines: Vec<(Vec<f64>, Style)>, limits: [f64; 2]) -> Self {
        let mut numbers: Vec<f64> = lines.iter().flat_map(|(line, _)| line.iter().copied()).collect();
        numbers.sort_by(f64::total_cmp);
        let at = |share: f64| {
            numbers
                .get((share * numbers.len() as f64) as usize)
                .or(numbers.last())
                .copied()
                .unwrap_or(0.0)
        };
        let (low, high) = (at(0.0), at(1.0));
        let (usual_low, usual_high) = (at(1.0 - USUAL).min(limits[0]), at(USUAL).max(limits[1]));
        let all = [low.min(limits[0]), high.max(limits[1])];
        let cut = all[1] - all[0] > 3.0 * (usual_high - usual_low);
        let [from, to] = if cut { [usual_low, usual_high] } else { all };
        let more = 0.08 * (to - from);
        let range = [from - more, to + more];
        let beyond = [low, high]
            .into_iter()
            .filter(|number| !(range[0]..=range[1]).contains(number));
        let beyond: Vec<String> = beyond.map(|number| minus(&grouped(number))).collect();
        let words = match beyond.is_empty() {
            true => Vec::new(),
            false => vec![format!("beyond the frame: up to {}", beyond.join(" and "))],
        };
        Self {
            name,
            range,
            limits: limits.to_vec(),
            words,
            lines,
        }
    }
}

impl Panel {
    fn draw(&self, drawing: &mut Drawing, axes: &Axes, times: &[f64]) {
        let across = axes.across.ticks(12);
        let up = axes.up.ticks(4);
        axes.grid(drawing, &across, &up);
        let [left, right] = axes.across.places;
        for limit in &self.limits {
            let y = axes.up.at(*limit);
            drawing.line([left, y], [right, y], &Style::line(BAD, 1.4).dashed(LIMIT_DASHES));
        }
        drawing.within_rect(axes.frame, |drawing| {
            for (values, style) in &self.lines {
                let spots: Vec<_> = times.iter().zip(values).map(|(&t, &value)| axes.at(t, value)).collect();
                drawing.polyline(&spots, style);
            }
        });
        if !self.words.is_empty() {
            let (how, words) = (Lettering::new(15.0, BAD).to_the_left(), self.words.join("; "));
            let width = how.weight.width(&words, how.size);
            let ground = Rect::new(right - 16.0 - width, axes.frame.at[1] + 3.0, width + 12.0, 21.0);
            drawing.rect(ground, 3.0, &Style::fill(PAPER).see_through(0.85));
            drawing.text([right - 10.0, axes.frame.at[1] + 19.0], &words, &how);
        }
        axes.outline(drawing);
        axes.numbers_left(drawing, &up);
        axes.name_left(drawing, self.name, 84.0);
    }
}

/// What the arm does over time, as a strip under the diagrams.
fn segments(drawing: &mut Drawing, subject: &Subject<'_>, axes: &Axes, height: f64) {
    let top = axes.frame.end()[1] + 5.0;
    for segment in &subject.plan.segments {
        let [from, to] = [segment.t_start_s, segment.t_end_s].map(|t| axes.across.at(t));
        let colour = match segment.kind {
            SegmentKind::Wash => WASH,
            SegmentKind::Approach | SegmentKind::Retreat => LIFT,
            SegmentKind::Depart | SegmentKind::Transit | SegmentKind::Return => TRANSIT,
        };
        let field = Rect::new(from, top, to - from, height);
        drawing.rect(field, 0.0, &Style::fill(colour).see_through(0.85));
        let words = format!("plate {}", segment.plate);
        if segment.kind == SegmentKind::Wash && Weight::Bold.width(&words, 15.0) < to - from - 8.0 {
            let how = Lettering::new(15.0, PAPER).bold().centred();
            drawing.text([field.middle()[0], field.middle()[1] + how.drop()], &words, &how);
        }
    }
}

fn entries(subject: &Subject<'_>) -> Vec<Entry> {
    let joints = (0..AXES).map(|joint| Entry::line(Style::line(SIX[joint], 2.6), format!("joint {}", joint + 1)));
    let mut all: Vec<Entry> = joints.collect();
    all.push(Entry::line(Style::line(BAD, 1.8).dashed(LIMIT_DASHES), "limit"));
    let field = |colour| Style::fill(colour).see_through(0.85);
    all.push(Entry::field(field(WASH), "washes"));
    all.push(Entry::field(field(TRANSIT), "transits"));
    if subject
        .plan
        .segments
        .iter()
        .any(|segment| segment.kind == SegmentKind::Approach)
    {
        all.push(Entry::field(field(LIFT), "down and up"));
    }
    all
}
