//! Plates moved, turned, resized, doubled and removed, alone and together with what names them.

use crate::mutation::edit::{Edits, ExpectedResult, Kind};
use nalgebra::{UnitQuaternion, Vector3};
use platewash::certificate::Requirement::{
    ContactHeight, EveryPlateOnce, LineDeviation, PathDeviation, Plates, PlatesApart, Reach, Segments, Swept, WashPaths,
};
use platewash::motion::trajectory::SegmentKind::Depart;
use platewash::workcell::job::Overlap;
use platewash::{Plan, Plate, Surface};

pub fn add(edits: &mut Edits) {
    moved(edits);
    heights(edits);
    turned(edits);
    number(edits);
    shapes(edits);
    overlaps(edits);
    renamed(edits);
}

fn shift(plan: &mut Plan, plate: usize, [dx, dy]: [f64; 2]) {
    let [x, y] = plan.job.plates[plate].centre_xy();
    plan.job.plates[plate] = plan.job.plates[plate].moved_to([x + dx, y + dy]);
}

/// The path is the plate's: it moves with it.
fn moved(edits: &mut Edits) {
    for (size_m, expected) in [
        (1e-10, ExpectedResult::Harmless),
        (1e-8, ExpectedResult::Harmless),
        (1e-5, ExpectedResult::Sampled),
        (1.5e-4, ExpectedResult::Sampled),
        (3e-4, ExpectedResult::Fails(vec![PathDeviation])),
        (3e-3, ExpectedResult::Fails(vec![PathDeviation, LineDeviation, Reach])),
        (3e-2, ExpectedResult::Fails(vec![PathDeviation, Swept])),
    ] {
        for (way, by) in [("x", [size_m, 0.0]), ("y", [0.0, -size_m])] {
            let what = format!("one by {size_m} m along {way}");
            edits.add(Kind::Plates, what, expected.clone(), move |p, _| shift(p, 1, by));
        }
    }
    let mut fails = |what, names: &[_], apply| edits.fails(Kind::Plates, what, names, apply);
    fails("one onto another", &[PlatesApart, Swept, PathDeviation], |p| {
        let [a, b] = [0, 1].map(|i| p.job.plates[i].centre_xy());
        p.job.plates[0] = p.job.plates[0].moved_to([0, 1].map(|k| b[k] + 0.3 * (a[k] - b[k])));
    });
    fails("one under the base", &[PlatesApart, Swept, PathDeviation], |p| {
        p.job.plates[2] = p.job.plates[2].moved_to([0.0, 0.1])
    });
    fails("one far away", &[Swept, PathDeviation], |p| shift(p, 2, [0.0, 900.0]));
    fails("two exchanged", &[Swept, PathDeviation], |p| p.job.plates.swap(0, 1));
}

fn heights(edits: &mut Edits) {
    let raise = |p: &mut Plan, plate: usize, by: f64| p.job.plates[plate].pose.translation.z += by;
    for size_m in [1e-9, 1e-5, -1e-5, 1.9e-4] {
        let what = format!("one higher by {size_m} m");
        edits.add(Kind::Plates, what, ExpectedResult::Sampled, move |p, _| {
            raise(p, 3, size_m)
        });
    }
    for size_m in [1e-3, -1e-3] {
        let names = vec![ContactHeight, PathDeviation];
        let what = format!("all higher by {size_m} m");
        edits.add(Kind::Plates, what, ExpectedResult::Fails(names), move |p, _| {
            (0..4).for_each(|plate| raise(p, plate, size_m))
        });
    }
    edits.fails(Kind::Plates, "one in the floor", &[Plates], |p| {
        p.job.plates[1].thickness_m = 0.0301
    });
    edits.fails(Kind::Plates, "all in the floor", &[Plates], |p| {
        p.job.plates.iter_mut().for_each(|plate| plate.thickness_m = 0.05)
    });
    edits.harmless(Kind::Plates, "one on the floor", |p| p.job.plates[1].thickness_m = 0.03);
}

/// A round plate may be turned; its path turns with it.
fn turned(edits: &mut Edits) {
    fn turn(plan: &mut Plan, plate: usize, angle_rad: f64) {
        plan.job.plates[plate].pose.rotation = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), angle_rad);
    }
    edits.fails(Kind::Plates, "one turned, with its path", &[PathDeviation], |p| {
        turn(p, 2, 0.3)
    });
    edits.sampled(Kind::Plates, "one turned by a hair, with its path", |p| {
        turn(p, 2, 1e-6)
    });
    edits.harmless(Kind::Plates, "one turned, and its path back", |p| {
        turn(p, 2, 0.3);
        let path = p.wash_paths.iter_mut().find(|path| path.plate == 2).unwrap();
        path.curve.start_angle_rad -= 0.3;
    });
}

fn number(edits: &mut Edits) {
    let mut fails = |what, names: &[_], apply| edits.fails(Kind::Plates, what, names, apply);
    fails("one doubled", &[EveryPlateOnce, PlatesApart, Swept], |p| {
        p.job.plates.push(p.job.plates[0])
    });
    fails("one more, out of the way", &[EveryPlateOnce, Swept], |p| {
        p.job.plates.push(p.job.plates[0].moved_to([-0.6, 0.0]))
    });
    let gone = [EveryPlateOnce, PathDeviation, LineDeviation];
    fails("the last removed", &gone, |p| _ = p.job.plates.pop());
    fails("one never washed, and not asked for", &[Segments], |p| {
        let gone = p.order.remove(0);
        p.wash_paths.remove(0);
        p.job.plates.remove(gone);
        p.order.iter_mut().for_each(|i| *i -= usize::from(*i > gone));
        let renamed = |i: usize| i.saturating_sub(usize::from(i > gone)).min(2);
        p.wash_paths.iter_mut().for_each(|w| w.plate = renamed(w.plate));
        p.segments.iter_mut().for_each(|s| s.plate = renamed(s.plate));
    });
    edits.sampled(
        Kind::Plates,
        "one never washed, not asked for, on the way to the next",
        |p| {
            let gone = p.order.remove(0);
            p.wash_paths.remove(0);
            p.job.plates.remove(gone);
            // What was done to it is part of the way.
            let departs_s = p.segments[0].t_start_s;
            p.segments.drain(0..4);
            (p.segments[0].kind, p.segments[0].t_start_s) = (Depart, departs_s);
            let plates = p.segments.iter_mut().map(|s| &mut s.plate);
            let named = plates
                .chain(&mut p.order)
                .chain(p.wash_paths.iter_mut().map(|w| &mut w.plate));
            named.for_each(|i| *i -= usize::from(*i > gone));
        },
    );
}

/// Plates of another shape.
fn shapes(edits: &mut Edits) {
    fn resize(plate: &mut Plate, radius_m: f64) {
        plate.surface = Surface::Disc { radius_m };
    }
    for (what, by_m, expected) in [
        ("one a hair smaller", -1e-9, ExpectedResult::Harmless),
        ("one smaller", -5e-3, ExpectedResult::Harmless),
        ("one a hair larger", 1e-9, ExpectedResult::Sampled),
        ("one larger", 0.03, ExpectedResult::Fails(vec![Swept])),
    ] {
        edits.add(Kind::Plates, what, expected, move |p, _| {
            let radius_m = p.job.plates[0].rim_m() + by_m;
            resize(&mut p.job.plates[0], radius_m);
        });
    }
    for (what, radius_m, expected) in [
        ("all smaller", 0.14, ExpectedResult::Harmless),
        ("all larger", 0.15, ExpectedResult::Sampled),
        ("all much larger", 0.2, ExpectedResult::Fails(vec![Swept])),
    ] {
        edits.add(Kind::Plates, what, expected, move |p, _| {
            p.job.plates.iter_mut().for_each(|plate| resize(plate, radius_m))
        });
    }
    edits.fails(
        Kind::Plates,
        "all so small that neighbours are swept",
        &[EveryPlateOnce],
        |p| {
            p.wash_paths.iter_mut().for_each(|w| w.curve.radius_m += 0.12);
            p.job.plates.iter_mut().for_each(|plate| resize(plate, 0.1));
        },
    );
    edits.harmless(Kind::Plates, "all thinner", |p| {
        p.job.plates.iter_mut().for_each(|plate| plate.thickness_m = 0.01)
    });
    edits.harmless(Kind::Plates, "one a hair thicker", |p| {
        p.job.plates[0].thickness_m += 1e-9
    });
}

fn overlaps(edits: &mut Edits) {
    edits.harmless(Kind::Plates, "overlaps would only be told", |p| {
        p.job.requirements.overlap = Overlap::Report
    });
    // A plate that is larger than it looks, and nobody asks for all of it.
    fn grow(plan: &mut Plan) {
        plan.job.requirements.coverage = 0.3;
        let plates = plan.job.plates.iter_mut();
        plates.for_each(|plate| plate.surface = Surface::Disc { radius_m: 0.154 });
    }
    edits.fails(Kind::Plates, "all grown into each other", &[PlatesApart], grow);
    edits.waives(Kind::Plates, "all grown into each other, told", &[PlatesApart], |p| {
        grow(p);
        p.job.requirements.overlap = Overlap::Report;
    });
}

/// Exchanges the indices of plates 1 and 2 wherever one is named.
fn rename(plan: &mut Plan) {
    let in_time = plan.segments.iter_mut().map(|s| &mut s.plate);
    let in_space = plan.wash_paths.iter_mut().map(|path| &mut path.plate);
    for plate in in_time.chain(in_space).chain(&mut plan.order) {
        *plate = [1, 0, 2, 3][*plate];
    }
}

fn renamed(edits: &mut Edits) {
    edits.harmless(Kind::Plates, "two renamed everywhere", |p| {
        p.job.plates.swap(0, 1);
        rename(p);
    });
    edits.fails(
        Kind::Plates,
        "two exchanged in the order and the paths",
        &[PathDeviation, LineDeviation],
        rename,
    );
    edits.fails(
        Kind::Plates,
        "two exchanged in the order alone",
        &[Segments, WashPaths],
        |p| p.order.iter_mut().for_each(|i| *i = [1, 0, 2, 3][*i]),
    );
}
