//! How each plate is washed: paths dropped, exchanged, renamed, and other paths than the tip takes.

use crate::mutation::edit::{Edits, ExpectedResult, Kind};
use platewash::Plan;
use platewash::certificate::Requirement::{LineDeviation, PathDeviation, Reach, WashPaths};
use platewash::workcell::wash_path::WashPath;
use std::f64::consts::TAU;

pub fn add(edits: &mut Edits) {
    list(edits);
    none(edits);
    cones(edits);
    curves(edits);
    lines(edits);
}

fn list(edits: &mut Edits) {
    let unjudged = [WashPaths, PathDeviation, LineDeviation, Reach];
    let mut fails = |what, names: &[_], apply| edits.fails(Kind::WashPaths, what, names, apply);
    fails("one dropped", &unjudged, |p| _ = p.wash_paths.remove(2));
    fails("all dropped", &unjudged, |p| p.wash_paths.clear());
    fails("one doubled", &[WashPaths], |p| p.wash_paths.push(p.wash_paths[0]));
    fails("two exchanged", &[WashPaths], |p| p.wash_paths.swap(1, 2));
    fails("another plate", &unjudged, |p| p.wash_paths[1].plate = p.order[0]);
    fails("no such plate", &unjudged, |p| p.wash_paths[3].plate = 11);
    fails("the plates of two exchanged", &[WashPaths, PathDeviation], |p| {
        let [a, b] = [0, 1].map(|i| p.wash_paths[i].plate);
        (p.wash_paths[0].plate, p.wash_paths[1].plate) = (b, a);
    });
    fails("the curves of two exchanged", &[PathDeviation], |p| {
        let [a, b] = [0, 1].map(|i| p.wash_paths[i].curve);
        (p.wash_paths[0].curve, p.wash_paths[1].curve) = (b, a);
    });
}

/// Numbers with which a path is none; without one, nothing that rests on it is judged.
fn none(edits: &mut Edits) {
    type Change = fn(&mut WashPath);
    let cases: [(&str, Change); 8] = [
        ("no radius", |w| w.curve.radius_m = 0.0),
        ("a radius below 0", |w| w.curve.radius_m *= -1.0),
        ("too few turns", |w| w.curve.turns = 0.2),
        ("too many turns", |w| w.curve.turns = 1e9),
        ("a start many turns away", |w| w.curve.start_angle_rad += 4.0 * TAU),
        ("no lift", |w| w.lift_m = 0.0),
        ("a cone below 0", |w| w.cone_rad = -0.1),
        ("a cone wider than is allowed", |w| w.cone_rad += 1e-6),
    ];
    for (what, change) in cases {
        let names = vec![WashPaths, PathDeviation, LineDeviation, Reach];
        edits.add(Kind::WashPaths, what, ExpectedResult::Fails(names), move |p, _| {
            change(&mut p.wash_paths[1])
        });
    }
}

/// The narrowest cone that a path states is what the tilt is judged by.
fn cones(edits: &mut Edits) {
    for tilt_deg in [0.0, 5.0, 10.0, 13.0, 14.5] {
        let what = format!("a cone of {tilt_deg}°");
        edits.add(Kind::WashPaths, what, ExpectedResult::Sampled, move |p, _| {
            p.wash_paths[0].cone_rad = f64::to_radians(tilt_deg);
        });
    }
}

/// The path is what the plan says it is, and the tip must follow that one.
fn curves(edits: &mut Edits) {
    for size_m in [1e-12, 1e-7, 5e-5, 1.5e-4, 1e-3, 5e-3] {
        for sign in [1.0, -1.0] {
            let what = format!("a radius by {} m", sign * size_m);
            edits.add(Kind::WashPaths, what, ExpectedResult::Sampled, move |p, _| {
                p.wash_paths[3].curve.radius_m += sign * size_m
            });
        }
    }
    for (size_m, names) in [(-2e-3, vec![PathDeviation, Reach]), (2e-3, vec![PathDeviation])] {
        let what = format!("all radii by {size_m} m");
        edits.add(Kind::WashPaths, what, ExpectedResult::Fails(names), move |p, _| {
            all(p, |w| w.curve.radius_m += size_m)
        });
    }
    for size in [1e-9, 1e-5, 1e-3, -0.01, 0.5, -1.0] {
        let what = format!("turns by {size}");
        edits.add(Kind::WashPaths, what, ExpectedResult::Sampled, move |p, _| {
            p.wash_paths[1].curve.turns += size
        });
    }
    for size_rad in [1e-9, 1e-5, -1e-3, 0.05, -0.1] {
        let what = format!("start by {size_rad} rad");
        edits.add(Kind::WashPaths, what, ExpectedResult::Sampled, move |p, _| {
            p.wash_paths[1].curve.start_angle_rad += size_rad
        });
    }
    edits.harmless(Kind::WashPaths, "a start a turn away", |p| {
        let start = &mut p.wash_paths[2].curve.start_angle_rad;
        *start -= TAU.copysign(*start);
    });
    let mut fails = |what, names: &[_], apply| edits.fails(Kind::WashPaths, what, names, apply);
    fails("all turned", &[PathDeviation, LineDeviation], |p| {
        all(p, |w| w.curve.start_angle_rad *= 0.9)
    });
    fails("without its ring", &[PathDeviation], |p| {
        p.wash_paths[2].curve.closing_ring = false
    });
    fails("the ring as a turn more of the spiral", &[PathDeviation], |p| {
        let curve = &mut p.wash_paths[2].curve;
        curve.closing_ring = false;
        curve.turns += 1.0;
    });
}

fn lines(edits: &mut Edits) {
    for size_m in [1e-12, 1e-5, -1e-5, 5e-4, -5e-4, 2e-3, -5e-3, 0.01] {
        let what = format!("a lift by {size_m} m");
        edits.add(Kind::WashPaths, what, ExpectedResult::Sampled, move |p, _| {
            p.wash_paths[2].lift_m += size_m
        });
    }
    let mut fails = |what, apply| edits.fails(Kind::WashPaths, what, &[LineDeviation], apply);
    fails("all lifts higher", |p| all(p, |w| w.lift_m += 0.02));
    fails("a lift of next to nothing", |p| p.wash_paths[0].lift_m = 1e-9);
}

fn all(plan: &mut Plan, change: impl FnMut(&mut WashPath)) {
    plan.wash_paths.iter_mut().for_each(change);
}
