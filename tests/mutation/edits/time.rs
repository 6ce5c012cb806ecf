//! Time scaled, squeezed and stretched.

use crate::mutation::edit::{Edits, ExpectedResult, Kind};
use crate::mutation::edits::{middle, nth, retime, within};
use platewash::Plan;
use platewash::certificate::Requirement::{JointAcceleration, WashSpeed};
use platewash::motion::trajectory::SegmentKind::{self, Approach, Depart, Retreat, Transit, Wash};
use std::ops::Range;

pub fn add(edits: &mut Edits) {
    for factor in [0.9999, 0.99, 0.9, 0.5, 0.1] {
        let what = format!("all times {factor}");
        let names = vec![JointAcceleration, WashSpeed];
        edits.add(Kind::Time, what, ExpectedResult::Fails(names), move |p, _| {
            scale(p, factor)
        });
    }
    for factor in [1.0001, 1.5, 20.0] {
        edits.add(
            Kind::Time,
            format!("all times {factor}"),
            ExpectedResult::Harmless,
            move |p, _| scale(p, factor),
        );
    }
    for factor in [0.97, 1.05] {
        let what = format!("all times {factor}, the knots' speeds as they were");
        edits.add(Kind::Time, what, ExpectedResult::Sampled, move |p, _| {
            retime(p, |_, t| t * factor)
        });
    }
    for (kind, factor) in [
        (Wash, 0.999),
        (Wash, 0.9),
        (Wash, 0.2),
        (Transit, 0.9),
        (Approach, 0.5),
        (Wash, 1.5),
        (Depart, 3.0),
    ] {
        let what = format!("one interval {factor}, {}", kind.name());
        edits.add(Kind::Time, what, ExpectedResult::Sampled, move |p, _| {
            let knot = middle(p, kind);
            stretch(p, knot..knot + 1, factor);
        });
    }
    for (kind, factor) in [
        (Wash, 0.95),
        (Transit, 0.9),
        (Transit, 0.5),
        (Retreat, 0.7),
        (Depart, 1.3),
    ] {
        let what = format!("a whole segment {factor}, {}", kind.name());
        edits.add(Kind::Time, what, ExpectedResult::Sampled, move |p, _| {
            whole(p, kind, factor)
        });
    }
    for by_s in [1e-7, 1e-4, 2e-3] {
        let what = format!("one knot {by_s} s later");
        edits.add(Kind::Time, what, ExpectedResult::Sampled, move |p, _| {
            let late = middle(p, Wash);
            retime(p, |k, t| if k == late { t + by_s } else { t });
        });
    }
}

/// The same way, faster or slower.
pub fn scale(plan: &mut Plan, factor: f64) {
    retime(plan, |_, t| t * factor);
    plan.knots.qd_rad_s.iter_mut().for_each(|v| *v /= factor);
}

/// Makes the pieces after some knots longer or shorter; what follows is later or earlier.
fn stretch(plan: &mut Plan, pieces: Range<usize>, factor: f64) {
    let old = plan.knots.t_s.clone();
    retime(plan, |k, t| {
        let within = old[k.clamp(pieces.start, pieces.end)] - old[pieces.start];
        t + (factor - 1.0) * within
    });
}

/// A segment that begins and ends at rest, all of it faster or slower.
fn whole(plan: &mut Plan, kind: SegmentKind, factor: f64) {
    let knots = within(plan, nth(plan, kind, 0));
    plan.knots.qd_rad_s[knots.clone()].iter_mut().for_each(|v| *v /= factor);
    stretch(plan, knots.start - 1..knots.end, factor);
}
