//! Plates moved, resized, doubled and removed, alone and together with the tool path and the scenario.

use super::tool_path::restate;
use crate::edit::{Edits, Expected, Kind};
use platewash::Plan;
use platewash::planner::certificate::PromiseName::{
    ClearancePairs, ContactHeight, Coverage, EveryPlateOnce, LineDeviation, Plates, PlatesApart, Segments,
    StrokeDeviation, ToolPath,
};
use platewash::planner::scenario::Overlap;

pub fn add(edits: &mut Edits) {
    for (size, expected) in [
        (1e-10, Expected::Harmless),
        (1e-8, Expected::Fails(vec![ToolPath])),
        (1e-3, Expected::Fails(vec![ToolPath])),
        (3e-2, Expected::Fails(vec![ToolPath, Coverage])),
    ] {
        edits.add(Kind::Plates, format!("one by {size} m"), expected, move |p, _| {
            p.plates[1].x_m += size
        });
    }
    alone(edits);
    number(edits);
    shapes(edits);
    consistent(edits);
}

fn alone(edits: &mut Edits) {
    let mut fails = |what, names: &[_], apply| edits.fails(Kind::Plates, what, names, apply);
    fails("one onto another", &[ToolPath, PlatesApart, Coverage], |p| {
        let [a, b] = [p.plates[0], p.plates[1]];
        (p.plates[0].x_m, p.plates[0].y_m) = (b.x_m + 0.3 * (a.x_m - b.x_m), b.y_m + 0.3 * (a.y_m - b.y_m));
    });
    fails("one under the base", &[ToolPath, PlatesApart, Coverage], |p| {
        (p.plates[2].x_m, p.plates[2].y_m) = (0.0, 0.1);
    });
    fails("one far away", &[ToolPath, Coverage], |p| p.plates[2].y_m = 900.0);
    fails("one raised", &[Plates, ToolPath, ContactHeight], |p| {
        p.plates[3].z_m += 1e-3
    });
    fails("one raised a hair", &[Plates, ToolPath], |p| p.plates[3].z_m += 1e-5);
    fails("one shrunk", &[Plates], |p| p.plates[0].radius_m -= 5e-3);
    fails("one grown", &[Plates, Coverage], |p| p.plates[0].radius_m += 0.03);
    fails("one thicker", &[Plates], |p| p.plates[0].thickness_m += 1e-9);
    fails("two exchanged", &[ToolPath, Coverage], |p| p.plates.swap(0, 1));
}

fn number(edits: &mut Edits) {
    let mut fails = |what, names: &[_], apply| edits.fails(Kind::Plates, what, names, apply);
    fails(
        "one doubled",
        &[Plates, ClearancePairs, EveryPlateOnce, PlatesApart, Coverage],
        |p| p.plates.push(p.plates[0]),
    );
    fails(
        "one doubled, and asked for",
        &[ClearancePairs, EveryPlateOnce, PlatesApart, Coverage],
        |p| {
            p.plates.push(p.plates[0]);
            p.scenario.layout.count += 1;
        },
    );
    fails(
        "one more, out of the way",
        &[Plates, ClearancePairs, EveryPlateOnce, Coverage],
        |p| {
            let mut plate = p.plates[0];
            (plate.x_m, plate.y_m) = (-0.6, 0.0);
            p.plates.push(plate);
        },
    );
    fails(
        "the last removed",
        &[Plates, ClearancePairs, EveryPlateOnce, ToolPath],
        |p| _ = p.plates.pop(),
    );
    fails("one never washed, asked for three", &[Segments, ClearancePairs], |p| {
        let gone = p.order.remove(0);
        p.scenario.layout.count -= 1;
        p.plates.remove(gone);
        p.order.iter_mut().for_each(|i| *i -= usize::from(*i > gone));
        let renamed = |i: usize| i.saturating_sub(usize::from(i > gone)).min(2);
        p.tool_path.iter_mut().for_each(|s| s.plate = renamed(s.plate));
        p.segments.iter_mut().for_each(|s| s.plate = renamed(s.plate));
        restate_rest(p);
    });
    fails("asked for one more", &[Plates], |p| p.scenario.layout.count += 1);
    fails("given places that are others", &[Plates], |p| {
        give_places(p);
        p.scenario.layout.positions_m.as_mut().unwrap()[1][0] += 1e-12;
    });
}

/// The tool path without its first plate, as it would be.
fn restate_rest(plan: &mut Plan) {
    plan.tool_path.drain(0..4);
    plan.tool_path[0].kind = platewash::planner::tool_path::SegmentKind::Depart;
}

/// The layout's places given in place of being drawn.
fn give_places(plan: &mut Plan) {
    plan.scenario.layout.region = None;
    plan.scenario.layout.positions_m = Some(plan.plates.iter().map(|p| [p.x_m, p.y_m]).collect());
}

/// Exchanges the names of plates 0 and 1 wherever one is named.
fn rename(plan: &mut Plan) {
    let in_time = plan.segments.iter_mut().map(|s| &mut s.plate);
    let in_space = plan.tool_path.iter_mut().map(|s| &mut s.plate);
    for plate in in_time.chain(in_space).chain(&mut plan.order) {
        *plate = [1, 0, 2, 3][*plate];
    }
}

/// All plates of another shape, as asked.
fn shapes(edits: &mut Edits) {
    let resize = |p: &mut Plan, radius_m: f64| {
        p.scenario.layout.plate_radius_m = radius_m;
        p.plates.iter_mut().for_each(|plate| plate.radius_m = radius_m);
    };
    edits.add(
        Kind::Plates,
        "all smaller, as asked",
        Expected::Harmless,
        move |p, _| resize(p, 0.14),
    );
    edits.add(
        Kind::Plates,
        "all much larger, as asked",
        Expected::Fails(vec![Coverage]),
        move |p, _| resize(p, 0.2),
    );
    edits.harmless(Kind::Plates, "all thinner, as asked", |p| {
        p.scenario.layout.plate_thickness_m = 0.01;
        p.plates.iter_mut().for_each(|plate| plate.thickness_m = 0.01);
    });
}

fn consistent(edits: &mut Edits) {
    edits.harmless(Kind::Plates, "places given as they are", give_places);
    edits.harmless(Kind::Plates, "two renamed everywhere", |p| {
        p.plates.swap(0, 1);
        rename(p);
    });
    edits.fails(
        Kind::Plates,
        "two exchanged in the order and the paths",
        &[StrokeDeviation, LineDeviation],
        |p| {
            rename(p);
            restate(p, |_| ());
        },
    );
    edits.harmless(Kind::Plates, "overlaps would only be told", |p| {
        p.scenario.layout.overlap = Overlap::Report
    });
    for (size, expected) in [
        (1e-6, Expected::Sampled),
        (1e-4, Expected::Sampled),
        (1e-3, Expected::Fails(vec![StrokeDeviation])),
    ] {
        let what = format!("one by {size} m, with its path");
        edits.add(Kind::Plates, what, expected, move |p, _| {
            restate(p, |p| p.plates[2].y_m += size)
        });
    }
    edits.fails(
        Kind::Plates,
        "all raised, with their paths, as asked",
        &[StrokeDeviation, ContactHeight],
        |p| {
            p.scenario.layout.plate_height_m += 1e-3;
            p.plates
                .iter_mut()
                .for_each(|plate| plate.z_m = p.scenario.layout.plate_height_m);
            restate(p, |_| ());
        },
    );
}
