//! Slow and smooth detours, which break nothing but where they lead; and pauses.

use crate::mutation::edit::{Edits, ExpectedResult, Kind};
use crate::mutation::edits::knots::split;
use crate::mutation::edits::time::scale;
use crate::mutation::edits::{knot_at, middle, nth, retime};
use platewash::Plan;
use platewash::motion::trajectory::SegmentKind::{self, Approach, Depart, Return, Transit, Wash};

/// How much slower the plan is made first, so that no speed and no acceleration matters.
const SLOWER: f64 = 5.0;

pub fn add(edits: &mut Edits) {
    for (kind, n, joint, sizes) in [
        (Depart, 0, 1, [0.2, 0.3, 0.4]),
        (Transit, 0, 1, [0.1, 0.2, 0.4]),
        (Transit, 2, 1, [0.15, 0.3, 0.4]),
        (Transit, 1, 4, [-1.0, 0.5, 1.0]),
        (Return, 0, 3, [-0.6, 2.0, 3.0]),
        (Depart, 0, 5, [3.0, -6.9, 7.1]),
    ] {
        for size in sizes {
            let what = format!("{} {n}, joint {} by {size} rad", kind.name(), joint + 1);
            edits.add(Kind::Detour, what, ExpectedResult::Sampled, move |p, _| {
                detour(p, (kind, n), joint, size)
            });
        }
    }
    for size in [1e-4, 1e-3] {
        let what = format!("wash, joint 2 by {size} rad");
        edits.add(Kind::Detour, what, ExpectedResult::Sampled, move |p, _| {
            detour(p, (Wash, 1), 1, size)
        });
    }
    // Back by part of an interval, which the tolerance may allow, and by several.
    for (kind, share, count) in [
        (Approach, 0.3, 1),
        (Approach, 0.6, 1),
        (Approach, 0.4, 2),
        (Approach, 0.5, 6),
        (Wash, 0.01, 1),
        (Wash, 0.04, 1),
        (Wash, 0.5, 1),
        (Wash, 0.5, 20),
    ] {
        let what = format!("{}, {count} knots to and fro, the first at {share}", kind.name());
        edits.add(Kind::Detour, what, ExpectedResult::Sampled, move |p, _| {
            let knot = middle(p, kind);
            scale(p, SLOWER);
            split(p, knot, share);
            to_and_fro(p, knot, knot + count);
        });
    }
    // About its own axis the tool may turn.
    edits.add(
        Kind::Detour,
        "wash, joint 6 by 0.5 rad",
        ExpectedResult::Harmless,
        |p, _| detour(p, (Wash, 2), 5, 0.5),
    );
    edits.harmless(Kind::Time, "a pause on a plate", |p| {
        let time_s = p.segments[nth(p, Wash, 2)].t_start_s;
        pause(p, knot_at(p, time_s));
    });
    edits.sampled(Kind::Time, "a pause in full motion", |p| {
        let segment = p.segments[nth(p, Approach, 2)];
        pause(p, knot_at(p, segment.t_end_s) + 40);
    });
}

/// Makes the plan slow, then adds a smooth bump to a joint along the nth segment of a kind.
fn detour(plan: &mut Plan, (kind, n): (SegmentKind, usize), joint: usize, size_rad: f64) {
    scale(plan, SLOWER);
    let segment = plan.segments[nth(plan, kind, n)];
    let length_s = segment.t_end_s - segment.t_start_s;
    for k in knot_at(plan, segment.t_start_s)..knot_at(plan, segment.t_end_s) {
        let s = (plan.knots.t_s[k] - segment.t_start_s) / length_s;
        plan.knots.q_rad[k][joint] += 16.0 * size_rad * (s * (1.0 - s)).powi(2);
        plan.knots.qd_rad_s[k][joint] += 32.0 * size_rad * s * (1.0 - s) * (1.0 - 2.0 * s) / length_s;
    }
}

/// Runs from a knot to another, back and forward again, at rest where it turns.
fn to_and_fro(plan: &mut Plan, knot: usize, end: usize) {
    let old = plan.knots.clone();
    let length_s = old.t_s[end] - old.t_s[knot];
    retime(plan, |k, t| if k > end { t + 2.0 * length_s } else { t });
    let back = (knot..end).rev().map(|k| (k, -1.0, 2.0 * old.t_s[end] - old.t_s[k]));
    let forth = (knot + 1..=end).map(|k| (k, 1.0, old.t_s[k] + 2.0 * length_s));
    for (place, (k, way, time_s)) in back.chain(forth).enumerate() {
        let turns = if k == knot { 0.0 } else { way };
        plan.knots.t_s.insert(end + 1 + place, time_s);
        plan.knots.q_rad.insert(end + 1 + place, old.q_rad[k]);
        plan.knots.qd_rad_s.insert(end + 1 + place, old.qd_rad_s[k] * turns);
    }
    plan.knots.qd_rad_s[end].fill(0.0);
}

/// Repeats a knot a second later.
fn pause(plan: &mut Plan, knot: usize) {
    retime(plan, |k, t| if k > knot { t + 1.0 } else { t });
    let knots = &mut plan.knots;
    knots.t_s.insert(knot + 1, knots.t_s[knot] + 1.0);
    knots.q_rad.insert(knot + 1, knots.q_rad[knot]);
    knots.qd_rad_s.insert(knot + 1, knots.qd_rad_s[knot]);
}
