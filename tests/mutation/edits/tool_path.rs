//! The declared tool path: shapes changed alone, and together with the scenario that asks for them.

use super::nth;
use crate::edit::{Edits, Expected, Kind};
use platewash::Plan;
use platewash::planner::certificate::PromiseName::{Coverage, LineDeviation, Segments, StrokeDeviation, ToolPath};
use platewash::planner::tool_path::SegmentKind::{self, Approach, Retreat, Transition, Wash};
use platewash::planner::tool_path::Shape;
use platewash::workcell::stroke::Stroke;

pub fn add(edits: &mut Edits) {
    list(edits);
    strokes(edits);
    places(edits);
    lines(edits);
    consistent(edits);
}

fn shape(plan: &mut Plan, kind: SegmentKind, n: usize) -> &mut Shape {
    let i = nth(plan, kind, n);
    &mut plan.tool_path[i].shape
}

fn stroke(plan: &mut Plan, n: usize) -> &mut Stroke {
    match shape(plan, Wash, n) {
        Shape::Stroke { stroke, .. } => stroke,
        other => panic!("{other:?}"),
    }
}

fn list(edits: &mut Edits) {
    let mut fails = |what, names: &[_], apply| edits.fails(Kind::ToolPath, what, names, apply);
    fails("one dropped", &[Segments], |p| _ = p.tool_path.remove(4));
    fails("one doubled", &[Segments], |p| {
        p.tool_path.insert(4, p.tool_path[4].clone())
    });
    fails("two exchanged", &[Segments], |p| p.tool_path.swap(1, 2));
    fails("another plate", &[Segments, ToolPath], |p| {
        p.tool_path[2].plate = p.order[1]
    });
    fails("no such plate", &[Segments, ToolPath], |p| p.tool_path[2].plate = 11);
    fails("another kind", &[Segments, ToolPath], |p| {
        p.tool_path[4].kind = Approach
    });
    fails("a wash that is free", &[ToolPath, StrokeDeviation], |p| {
        *shape(p, Wash, 1) = Shape::Free
    });
    fails("an approach that is free", &[ToolPath, LineDeviation], |p| {
        *shape(p, Approach, 1) = Shape::Free
    });
    fails("a transition that is a line", &[ToolPath], |p| {
        *shape(p, Transition, 1) = shape(p, Retreat, 1).clone();
    });
}

fn strokes(edits: &mut Edits) {
    for size in [1e-12, 1e-7] {
        let what = format!("a stroke's radius by {size} m");
        edits.add(Kind::ToolPath, what, Expected::Fails(vec![ToolPath]), move |p, _| {
            stroke(p, 0).radius_m -= size
        });
    }
    let mut fails = |what, apply| edits.fails(Kind::ToolPath, what, &[ToolPath, StrokeDeviation], apply);
    fails("a smaller stroke", |p| stroke(p, 3).radius_m -= 1e-3);
    fails("fewer turns", |p| stroke(p, 1).turns -= 1.0);
    fails("a little fewer turns", |p| stroke(p, 1).turns -= 0.01);
    fails("no ring", |p| stroke(p, 2).closing_ring = false);
    fails("a stroke turned", |p| stroke(p, 1).start_angle_rad += 0.05);
}

fn places(edits: &mut Edits) {
    for (size, expected) in [
        (1e-10, Expected::Harmless),
        (1e-8, Expected::Fails(vec![ToolPath])),
        (5e-4, Expected::Fails(vec![ToolPath, StrokeDeviation])),
    ] {
        edits.add(
            Kind::ToolPath,
            format!("a stroke's centre by {size} m"),
            expected,
            move |p, _| {
                if let Shape::Stroke { centre_m, .. } = shape(p, Wash, 1) {
                    centre_m[1] += size;
                }
            },
        );
    }
    for (size, expected) in [
        (1e-10, Expected::Harmless),
        (1e-5, Expected::Fails(vec![ToolPath])),
        (2e-3, Expected::Fails(vec![ToolPath, LineDeviation])),
    ] {
        edits.add(
            Kind::ToolPath,
            format!("a line's foot by {size} m"),
            expected,
            move |p, _| {
                if let Shape::Line { foot_m, .. } = shape(p, Retreat, 2) {
                    foot_m[0] -= size;
                }
            },
        );
    }
}

fn lines(edits: &mut Edits) {
    fn line(p: &mut Plan) -> (&mut [f64; 3], &mut f64) {
        match shape(p, Approach, 2) {
            Shape::Line { normal, height_m, .. } => (normal, height_m),
            other => panic!("{other:?}"),
        }
    }
    let mut fails = |what, names: &[_], apply| edits.fails(Kind::ToolPath, what, names, apply);
    fails("a line shorter", &[ToolPath, LineDeviation], |p| *line(p).1 -= 5e-3);
    fails("a line a hair longer", &[ToolPath], |p| *line(p).1 += 1e-5);
    fails("a line that leans", &[ToolPath, LineDeviation], |p| {
        *line(p).0 = [0.6, 0.0, 0.8]
    });
    fails("a line downwards", &[ToolPath, LineDeviation], |p| {
        *line(p).0 = [0.0, 0.0, -1.0]
    });
}

/// The scenario asks for another path, and the plan states it: the motion is no longer the one asked for.
fn consistent(edits: &mut Edits) {
    let mut fails = |what, names: &[_], apply| edits.fails(Kind::ToolPath, what, names, apply);
    fails("a smaller stroke, asked alone", &[ToolPath], |p| {
        p.scenario.wash.path_radius_m -= 0.01
    });
    fails(
        "a smaller stroke, asked and stated",
        &[StrokeDeviation, LineDeviation],
        |p| {
            restate(p, |p| p.scenario.wash.path_radius_m -= 2e-3);
        },
    );
    fails("more turns, asked and stated", &[StrokeDeviation], |p| {
        restate(p, |p| p.scenario.wash.turns += 1.0)
    });
    fails("a higher lift, asked and stated", &[LineDeviation], |p| {
        restate(p, |p| p.scenario.wash.lift_m += 0.01)
    });
    fails("turned strokes, stated", &[StrokeDeviation, LineDeviation], |p| {
        (0..4).for_each(|n| stroke(p, n).start_angle_rad -= 0.1);
        restate(p, |_| ());
    });
    fails("more coverage than there can be", &[Coverage], |p| {
        p.scenario.job.required_coverage = 1.0;
        p.limits.coverage = 1.0;
        p.scenario.tool.sponge_radius_m = 0.012;
        p.tool = p.scenario.tool.clone();
    });
    edits.sampled(Kind::ToolPath, "a lift a hair higher, asked and stated", |p| {
        restate(p, |p| p.scenario.wash.lift_m += 1e-5);
    });
    let mut off = |what, apply| edits.fails(Kind::ToolPath, what, &[ToolPath], apply);
    off("a hair off the plates, asked and stated", |p| {
        restate(p, |p| p.scenario.wash.height_m += 1e-5);
    });
    off("off the plates, asked and stated", |p| {
        restate(p, |p| p.scenario.wash.height_m += 3e-4);
    });
}

/// Works the tool path out again, with the angles at which the strokes start as they are.
pub fn restate(plan: &mut Plan, ask: impl Fn(&mut Plan)) {
    ask(plan);
    let wash = plan.scenario.wash.clone();
    for n in 0..plan.order.len() {
        let plate = plan.plates[plan.order[n]];
        let height = plate.z_m + wash.height_m;
        let new = Stroke {
            radius_m: wash.path_radius_m,
            turns: wash.turns,
            start_angle_rad: stroke(plan, n).start_angle_rad,
            closing_ring: wash.closing_ring,
        };
        let line = |theta: f64| {
            let end = new.at(theta).position;
            Shape::Line {
                foot_m: [plate.x_m + end.x, plate.y_m + end.y, height],
                normal: [0.0, 0.0, 1.0],
                height_m: wash.lift_m,
            }
        };
        *shape(plan, Approach, n) = line(0.0);
        *shape(plan, Wash, n) = Shape::Stroke {
            centre_m: [plate.x_m, plate.y_m, height],
            normal: [0.0, 0.0, 1.0],
            stroke: new,
        };
        *shape(plan, Retreat, n) = line(new.end());
    }
}
