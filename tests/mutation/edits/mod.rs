//! The edits, by what they touch.

mod asked;
mod detours;
mod exclusions;
mod harmless;
mod knots;
mod obstacles;
mod plates;
mod segments;
mod statements;
mod time;
mod tool;
mod wash_paths;

use crate::mutation::edit::{Edit, Edits};
use platewash::Plan;
use platewash::motion::trajectory::SegmentKind;
use rand::RngExt;
use rand_pcg::Pcg64;
use std::ops::Range;

/// All of them, always in the same order.
pub fn all() -> Vec<Edit> {
    let mut edits = Edits::default();
    knots::add(&mut edits);
    time::add(&mut edits);
    detours::add(&mut edits);
    segments::add(&mut edits);
    wash_paths::add(&mut edits);
    plates::add(&mut edits);
    tool::add(&mut edits);
    obstacles::add(&mut edits);
    exclusions::add(&mut edits);
    asked::add(&mut edits);
    statements::add(&mut edits);
    harmless::add(&mut edits);
    edits.0
}

/// Index of the nth segment of a kind.
fn nth(plan: &Plan, kind: SegmentKind, n: usize) -> usize {
    let all = plan.segments.iter().enumerate().filter(|(_, s)| s.kind == kind);
    all.map(|(i, _)| i).nth(n).unwrap()
}

/// Index of the knot at a time \[s\].
fn knot_at(plan: &Plan, time_s: f64) -> usize {
    plan.knots.t_s.iter().position(|t| *t == time_s).unwrap()
}

/// The knots of a segment but the two at its ends.
fn within(plan: &Plan, segment: usize) -> Range<usize> {
    let segment = plan.segments[segment];
    knot_at(plan, segment.t_start_s) + 1..knot_at(plan, segment.t_end_s)
}

/// The middle knot of the first segment of a kind.
fn middle(plan: &Plan, kind: SegmentKind) -> usize {
    let knots = within(plan, nth(plan, kind, 0));
    knots.start + knots.len() / 2
}

/// A knot within any segment of a kind.
fn some_knot(plan: &Plan, kind: SegmentKind, random: &mut Pcg64) -> usize {
    let count = plan.segments.iter().filter(|s| s.kind == kind).count();
    let segment = nth(plan, kind, random.random_range(0..count));
    random.random_range(within(plan, segment))
}

/// Gives the knots other times, by their indices and old times \[s\]; the segments' ends move with their knots.
fn retime(plan: &mut Plan, time: impl Fn(usize, f64) -> f64) {
    let ends: Vec<_> = plan
        .segments
        .iter()
        .map(|s| [s.t_start_s, s.t_end_s].map(|t| knot_at(plan, t)))
        .collect();
    for (k, t) in plan.knots.t_s.iter_mut().enumerate() {
        *t = time(k, *t);
    }
    for (segment, [start, end]) in plan.segments.iter_mut().zip(ends) {
        (segment.t_start_s, segment.t_end_s) = (plan.knots.t_s[start], plan.knots.t_s[end]);
    }
}
