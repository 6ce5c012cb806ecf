//! Segments in time dropped, doubled, renamed and cut elsewhere; the order.

use crate::mutation::edit::{Edits, Kind};
use crate::mutation::edits::{nth, within};
use platewash::Plan;
use platewash::certificate::Requirement::{
    EveryPlateOnce, LineDeviation, PathDeviation, RestAtWashEnds, Segments, WashPaths,
};
use platewash::motion::trajectory::SegmentKind::{Approach, Retreat, Transit, Wash};

pub fn add(edits: &mut Edits) {
    list(edits);
    boundaries(edits);
    order(edits);
}

fn list(edits: &mut Edits) {
    let mut fails = |what, apply| edits.fails(Kind::Segments, what, &[Segments], apply);
    fails("the first dropped", |p| _ = p.segments.remove(0));
    fails("a transit dropped", |p| _ = p.segments.remove(nth(p, Transit, 1)));
    fails("a transit dropped, the next longer", |p| {
        let gone = p.segments.remove(nth(p, Transit, 1));
        let next = p.segments.iter().position(|s| s.t_start_s == gone.t_end_s).unwrap();
        p.segments[next].t_start_s = gone.t_start_s;
    });
    fails("the last dropped", |p| _ = p.segments.pop());
    fails("the plate of the return", |p| {
        p.segments.last_mut().unwrap().plate = p.order[0]
    });
    fails("all dropped", |p| p.segments.clear());
    fails("one doubled", |p| p.segments.insert(2, p.segments[2]));
    fails("two exchanged", |p| p.segments.swap(2, 3));
    fails("a transit named wash", |p| {
        let i = nth(p, Transit, 0);
        p.segments[i].kind = Wash;
    });
    fails("a wash named retreat", |p| {
        let i = nth(p, Wash, 2);
        p.segments[i].kind = Retreat;
    });
    fails("another plate", |p| {
        let i = nth(p, Wash, 2);
        p.segments[i].plate = p.order[0];
    });
    fails("a plate that is none", |p| {
        let i = nth(p, Approach, 1);
        p.segments[i].plate = 9;
    });
}

/// Ends a segment, and begins the next, some knots later or earlier.
fn cut(plan: &mut Plan, segment: usize, by: isize) {
    let knot = within(plan, segment).end.checked_add_signed(by).unwrap();
    let time = plan.knots.t_s[knot];
    plan.segments[segment].t_end_s = time;
    plan.segments[segment + 1].t_start_s = time;
}

fn boundaries(edits: &mut Edits) {
    let mut fails = |what, names: &[_], apply| edits.fails(Kind::Segments, what, names, apply);
    fails("an end off its knot", &[Segments], |p| p.segments[2].t_end_s += 1e-9);
    fails("a gap", &[Segments], |p| p.segments[5].t_start_s += 1e-9);
    fails("an end far away", &[Segments], |p| {
        p.segments.last_mut().unwrap().t_end_s = 1e300
    });
    fails("a wash begins a knot late", &[RestAtWashEnds], |p| {
        cut(p, nth(p, Approach, 1), 1)
    });
    fails("a wash begins a knot early", &[RestAtWashEnds], |p| {
        cut(p, nth(p, Approach, 1), -1)
    });
    fails("a wash ends early", &[RestAtWashEnds, PathDeviation], |p| {
        cut(p, nth(p, Wash, 0), -30)
    });
    fails("a wash takes in the retreat", &[RestAtWashEnds, PathDeviation], |p| {
        let knots = within(p, nth(p, Retreat, 0)).len();
        cut(p, nth(p, Wash, 0), isize::try_from(knots).unwrap());
    });
    fails("a retreat ends half-way", &[LineDeviation], |p| {
        let half = within(p, nth(p, Retreat, 1)).len() / 2;
        cut(p, nth(p, Retreat, 1), -isize::try_from(half).unwrap());
    });
    fails("a retreat takes in some of the transit", &[LineDeviation], |p| {
        cut(p, nth(p, Retreat, 1), 20)
    });
    fails("an approach begins late", &[LineDeviation], |p| {
        cut(p, nth(p, Transit, 0), 6)
    });
    edits.sampled(Kind::Segments, "an approach begins a knot late", |p| {
        cut(p, nth(p, Transit, 0), 1)
    });
    edits.sampled(Kind::Segments, "a retreat ends a knot late", |p| {
        cut(p, nth(p, Retreat, 0), 1)
    });
}

fn order(edits: &mut Edits) {
    let mut fails = |what, names: &[_], apply| edits.fails(Kind::Order, what, names, apply);
    fails("two exchanged", &[Segments, WashPaths], |p| p.order.swap(0, 1));
    fails("reversed", &[Segments, WashPaths], |p| p.order.reverse());
    fails("one twice", &[Segments, WashPaths, EveryPlateOnce], |p| {
        p.order[1] = p.order[0]
    });
    fails("one too many", &[Segments, WashPaths, EveryPlateOnce], |p| {
        p.order.push(0)
    });
    fails("no such plate", &[Segments, WashPaths, EveryPlateOnce], |p| {
        p.order[3] = 7
    });
    fails("one missing", &[Segments, WashPaths, EveryPlateOnce], |p| {
        _ = p.order.pop()
    });
    fails("none", &[Segments, WashPaths, EveryPlateOnce], |p| p.order.clear());
    fails("another than is asked", &[EveryPlateOnce], |p| {
        p.job.requirements.as_listed = true
    });
    edits.harmless(Kind::Order, "as listed, all renamed so", |p| {
        let order = p.order.clone();
        let listed = |plate: usize| order.iter().position(|i| *i == plate).unwrap();
        p.job.plates = order.iter().map(|i| p.job.plates[*i]).collect();
        p.segments.iter_mut().for_each(|s| s.plate = listed(s.plate));
        p.wash_paths.iter_mut().for_each(|w| w.plate = listed(w.plate));
        p.order.sort_unstable();
        p.job.requirements.as_listed = true;
    });
}
