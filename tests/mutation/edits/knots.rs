//! Knots moved, exchanged, dropped and added.

use crate::mutation::edit::{Edits, ExpectedResult, Kind};
use crate::mutation::edits::{middle, nth, some_knot, within};
use crate::mutation::sampler::pieces;
use platewash::Plan;
use platewash::certificate::Requirement::{HomeToHome, RestAtWashEnds, Segments};
use platewash::motion::trajectory::SegmentKind::{self, Approach, Depart, Retreat, Return, Transit, Wash};
use rand::RngExt;
use rand_pcg::Pcg64;

const KINDS: [SegmentKind; 6] = [Depart, Approach, Wash, Retreat, Transit, Return];

pub fn add(edits: &mut Edits) {
    moved(edits);
    speeds(edits);
    exchanged(edits);
    dropped(edits);
    added(edits);
}

/// Either sign of a size.
fn signed(size: f64, random: &mut Pcg64) -> f64 {
    if random.random_range(0..2) == 0 { size } else { -size }
}

fn moved(edits: &mut Edits) {
    for kind in KINDS {
        for size in [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1] {
            let what = format!("{} by {size} rad", kind.name());
            edits.add(Kind::KnotMoved, what, ExpectedResult::Sampled, move |p, random| {
                let knot = some_knot(p, kind, random);
                p.knots.q_rad[knot][random.random_range(0..6)] += signed(size, random);
            });
        }
    }
    for kind in [Depart, Transit, Return] {
        for size in [0.5, 2.0] {
            let what = format!("{} by {size} rad", kind.name());
            edits.add(Kind::KnotMoved, what, ExpectedResult::Sampled, move |p, random| {
                let knot = some_knot(p, kind, random);
                p.knots.q_rad[knot][random.random_range(1..5)] += signed(size, random);
            });
        }
    }
    edits.fails(Kind::KnotMoved, "the first", &[HomeToHome], |p| {
        p.knots.q_rad[0][5] += 1e-6
    });
    edits.fails(Kind::KnotMoved, "the last", &[HomeToHome], |p| {
        p.knots.q_rad.last_mut().unwrap()[0] -= 1e-3;
    });
    edits.sampled(Kind::KnotMoved, "where a wash begins", |p| {
        let knot = within(p, nth(p, Wash, 1)).start - 1;
        p.knots.q_rad[knot][1] += 1e-4;
    });
}

fn speeds(edits: &mut Edits) {
    for kind in KINDS {
        for size in [1e-4, 1e-2, 1.0] {
            let what = format!("{} by {size} rad/s", kind.name());
            edits.add(Kind::KnotSpeed, what, ExpectedResult::Sampled, move |p, random| {
                let knot = some_knot(p, kind, random);
                p.knots.qd_rad_s[knot][random.random_range(0..6)] += signed(size, random);
            });
        }
    }
    edits.fails(Kind::KnotSpeed, "where a wash begins", &[RestAtWashEnds], |p| {
        let knot = within(p, nth(p, Wash, 1)).start - 1;
        p.knots.qd_rad_s[knot][3] = 1e-6;
    });
    edits.fails(Kind::KnotSpeed, "where a wash ends", &[RestAtWashEnds], |p| {
        let knot = within(p, nth(p, Wash, 2)).end;
        p.knots.qd_rad_s[knot][0] = -1e-3;
    });
    edits.fails(Kind::KnotSpeed, "at the end", &[HomeToHome], |p| {
        p.knots.qd_rad_s.last_mut().unwrap()[2] = 1e-3;
    });
}

/// Exchanges what the arm does at two knots; their times stay.
fn exchange(plan: &mut Plan, a: usize, b: usize) {
    plan.knots.q_rad.swap(a, b);
    plan.knots.qd_rad_s.swap(a, b);
}

fn exchanged(edits: &mut Edits) {
    for kind in [Wash, Transit, Approach] {
        let what = format!("neighbours, {}", kind.name());
        edits.add(Kind::KnotOrder, what, ExpectedResult::Sampled, move |p, random| {
            let knot = some_knot(p, kind, random);
            exchange(p, knot, knot + 1);
        });
    }
    edits.sampled(Kind::KnotOrder, "of two plates", |p| {
        let [a, b] = [0, 1].map(|n| within(p, nth(p, Wash, n)).start + 200);
        exchange(p, a, b);
    });
    edits.sampled(Kind::KnotOrder, "a stretch run backwards", |p| {
        let start = middle(p, Wash);
        (0..20).for_each(|i| exchange(p, start + i, start + 39 - i));
        p.knots.qd_rad_s[start..start + 40].iter_mut().for_each(|v| *v = -*v);
    });
}

/// Drops knots; their times go with them.
fn drop_knots(plan: &mut Plan, from: usize, count: usize) {
    let knots = &mut plan.knots;
    knots.t_s.drain(from..from + count);
    knots.q_rad.drain(from..from + count);
    knots.qd_rad_s.drain(from..from + count);
}

fn dropped(edits: &mut Edits) {
    for (kind, count) in [
        (Depart, 1),
        (Wash, 1),
        (Transit, 1),
        (Retreat, 1),
        (Wash, 3),
        (Wash, 12),
        (Return, 12),
        (Wash, 150),
    ] {
        let what = format!("{count}, {}", kind.name());
        edits.add(Kind::KnotDropped, what, ExpectedResult::Sampled, move |p, _| {
            drop_knots(p, middle(p, kind), count);
        });
    }
    edits.fails(Kind::KnotDropped, "between segments", &[Segments], |p| {
        drop_knots(p, within(p, nth(p, Wash, 1)).end, 1);
    });
    edits.fails(Kind::KnotDropped, "the last", &[Segments, HomeToHome], |p| {
        drop_knots(p, p.knots.t_s.len() - 1, 1);
    });
}

/// Adds a knot on the motion, at a share of the piece after a knot.
pub fn split(plan: &mut Plan, knot: usize, share: f64) {
    let piece = pieces(&plan.knots)[knot];
    let u = share * piece.length_s;
    let knots = &mut plan.knots;
    knots.t_s.insert(knot + 1, piece.start_s + u);
    knots.q_rad.insert(knot + 1, piece.position(u));
    knots.qd_rad_s.insert(knot + 1, piece.speed(u));
}

fn added(edits: &mut Edits) {
    for (kind, share) in KINDS.into_iter().zip([0.5, 0.3, 0.7, 0.5, 0.125, 0.9]) {
        let what = format!("on the motion, {}", kind.name());
        edits.add(Kind::KnotAdded, what, ExpectedResult::Harmless, move |p, random| {
            split(p, some_knot(p, kind, random), share);
        });
    }
    for size in [1e-5, 1e-2] {
        let what = format!("{size} rad off the motion");
        edits.add(Kind::KnotAdded, what, ExpectedResult::Sampled, move |p, random| {
            let knot = some_knot(p, Wash, random);
            split(p, knot, 0.5);
            p.knots.q_rad[knot + 1][2] += signed(size, random);
        });
    }
}
