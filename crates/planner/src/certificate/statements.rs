//! What the plan states about its scenario and its arm, compared with what follows from them.
//!
//! Everything is compared exactly, but for the places on the tool path, which are computed and may differ by rounding.
//! What is judged afterwards uses what follows, never what is stated.

use super::neighbours;
use super::promise::{Discrepancy, Promise, PromiseName, Status};
use crate::plan::{Plan, PlanLimits, TipPose, Tolerances};
use crate::scenario::{OrderRule, Overlap, Program};
use crate::tool_path::{Segment, SegmentKind, Shape};
use platewash_kinematics::{AXES, RobotModel};
use platewash_workcell::clearance::ClearanceModel;
use platewash_workcell::stroke::Stroke;
use platewash_workcell::words::millimetres;
use serde::Serialize;
use serde_json::Value;
use std::f64::consts::TAU;

/// By how much a declared place may differ from where it should be \[m\].
pub(super) const PLACE_M: f64 = 1e-9;

/// All promises about statements.
pub(super) fn promises(plan: &Plan, robot: &RobotModel, clearance: &ClearanceModel) -> Vec<Promise> {
    vec![
        Promise::stated(PromiseName::Arm, arm(plan, robot)),
        Promise::stated(PromiseName::Tool, tool(plan, robot)),
        Promise::stated(PromiseName::Plates, plates(plan)),
        Promise::stated(
            PromiseName::Limits,
            fields("limits", &plan.limits, &PlanLimits::new(&plan.scenario, robot)),
        ),
        Promise::stated(
            PromiseName::Tolerances,
            fields("tolerances", &plan.tolerances, &Tolerances::new(&plan.scenario)),
        ),
        Promise::stated(PromiseName::ClearancePairs, pairs(plan, robot, clearance)),
        Promise::stated(PromiseName::ToolPath, tool_path(plan)),
        every_plate_once(plan),
    ]
}

fn arm(plan: &Plan, robot: &RobotModel) -> Vec<Discrepancy> {
    let mut wrong = Vec::new();
    if plan.robot.name != robot.name() {
        wrong.push(Discrepancy::new(
            "robot.name",
            quoted(&plan.robot.name),
            quoted(robot.name()),
        ));
    }
    if plan.robot.urdf_sha256 != robot.sha256() {
        let stated = quoted(&plan.robot.urdf_sha256);
        wrong.push(Discrepancy::new("robot.urdf_sha256", stated, quoted(robot.sha256())));
    }
    if plan.scenario.job.program != Program::Certified {
        wrong.push(Discrepancy::new("scenario.job.program", "\"paper\"", "\"certified\""));
    }
    wrong
}

fn tool(plan: &Plan, robot: &RobotModel) -> Vec<Discrepancy> {
    let mut wrong = fields("tool", &plan.tool, &plan.scenario.tool);
    wrong.extend(fields("tip", &plan.tip, &TipPose::new(robot, &plan.scenario.tool)));
    wrong
}

fn plates(plan: &Plan) -> Vec<Discrepancy> {
    let section = &plan.scenario.layout;
    let asked = section.positions_m.as_ref().map_or(section.count, Vec::len);
    let mut wrong = Vec::new();
    if plan.plates.len() != asked {
        wrong.push(Discrepancy::new("number of plates", plan.plates.len(), asked));
    }
    for (i, plate) in plan.plates.iter().enumerate() {
        for (field, stated, expected) in [
            ("radius_m", plate.radius_m, section.plate_radius_m),
            ("z_m", plate.z_m, section.plate_height_m),
            ("thickness_m", plate.thickness_m, section.plate_thickness_m),
        ] {
            if stated != expected {
                wrong.push(Discrepancy::new(format!("plates[{i}].{field}"), stated, expected));
            }
        }
        let underside_m = plate.z_m - plate.thickness_m;
        if underside_m < -PLACE_M {
            wrong.push(Discrepancy::new(
                format!("height of the underside of plate {i} over the floor"),
                millimetres(underside_m),
                "none below 0",
            ));
        }
        let given = section.positions_m.as_ref().and_then(|all| all.get(i));
        if let Some(given) = given.filter(|given| **given != [plate.x_m, plate.y_m]) {
            let stated = format!("{:?}", [plate.x_m, plate.y_m]);
            wrong.push(Discrepancy::new(
                format!("place of plates[{i}]"),
                stated,
                format!("{given:?}"),
            ));
        }
    }
    wrong
}

/// The pairs, and that every body of the arm has a shape: what has none keeps clear of nothing.
fn pairs(plan: &Plan, robot: &RobotModel, clearance: &ClearanceModel) -> Vec<Discrepancy> {
    let expected = clearance.pair_names();
    let mut wrong: Vec<_> = (0..=AXES)
        .filter(|&body| {
            !robot
                .links()
                .iter()
                .any(|l| l.frame.body() == body && !l.collision.is_empty())
        })
        .map(|body| {
            let links = robot.links().iter().filter(|l| l.frame.body() == body);
            let names: Vec<_> = links.map(|l| quoted(&l.name)).collect();
            let what = format!("collision geometry of {}", names.join(", "));
            Discrepancy::new(what, "none", "a shape, so that its clearance can be proved")
        })
        .collect();
    if plan.clearance_pairs.len() != expected.len() {
        let stated = plan.clearance_pairs.len();
        wrong.push(Discrepancy::new("number of clearance_pairs", stated, expected.len()));
    }
    let pairs = plan.clearance_pairs.iter().zip(expected).enumerate();
    for (i, ([a, b], (x, y))) in pairs.filter(|(_, ([a, b], (x, y)))| a != x || b != y) {
        let stated = format!("{} and {}", quoted(a), quoted(b));
        wrong.push(Discrepancy::new(
            format!("clearance_pairs[{i}]"),
            stated,
            format!("{} and {}", quoted(x), quoted(y)),
        ));
    }
    wrong
}

/// Every plate is in the order once, and no more than its rim is swept while another one is washed. Plates that overlap are [`super::apart`]'s
/// to judge: where that is only reported, so is what is swept twice.
fn every_plate_once(plan: &Plan) -> Promise {
    let mut wrong = washed_once(plan);
    let swept = neighbours::swept(plan);
    wrong.extend(swept.apart);
    if wrong.is_empty() && plan.scenario.layout.overlap == Overlap::Report && !swept.overlapping.is_empty() {
        let mut promise = Promise::stated(PromiseName::EveryPlateOnce, swept.overlapping);
        promise.status = Status::Exempt;
        return promise;
    }
    Promise::stated(PromiseName::EveryPlateOnce, wrong)
}

fn washed_once(plan: &Plan) -> Vec<Discrepancy> {
    let mut washed = vec![0_usize; plan.plates.len()];
    let mut wrong = Vec::new();
    for (i, &plate) in plan.order.iter().enumerate() {
        match washed.get_mut(plate) {
            Some(times) => *times += 1,
            None => wrong.push(Discrepancy::new(format!("order[{i}]"), plate, "the index of a plate")),
        }
        if plan.scenario.job.order == OrderRule::Given && plate != i {
            let asked = format!("{i}, as job.order = \"given\" asks");
            wrong.push(Discrepancy::new(format!("order[{i}]"), plate, asked));
        }
    }
    let times = washed.iter().enumerate().filter(|(_, times)| **times != 1);
    wrong.extend(
        times.map(|(plate, times)| Discrepancy::new(format!("order: times that plate {plate} is washed"), times, 1)),
    );
    wrong
}

/// Each segment's shape against the scenario and its plate. The angle at which a stroke leaves the centre is free,
/// within a turn. The scenario must ask for a sponge that touches.
fn tool_path(plan: &Plan) -> Vec<Discrepancy> {
    let off = plan.scenario.height_off_contact_m();
    let off = off.map(|height_m| Discrepancy::new("scenario.wash.height_m", height_m, "0, so that the sponge touches"));
    let mut wrong: Vec<_> = off.into_iter().collect();
    let mut start_angle = 0.0;
    for (i, segment) in plan.tool_path.iter().enumerate() {
        if let Some(Segment {
            shape: Shape::Stroke { stroke, .. },
            ..
        }) = plan
            .tool_path
            .get(i + usize::from(segment.kind == SegmentKind::Approach))
        {
            start_angle = stroke.start_angle_rad;
        }
        let Some(expected) = shape(plan, segment, start_angle) else {
            wrong.push(Discrepancy::new(
                format!("tool_path[{i}].plate"),
                segment.plate,
                "the index of a plate",
            ));
            continue;
        };
        if start_angle.abs() > TAU {
            let what = format!("tool_path[{i}].start_angle_rad");
            wrong.push(Discrepancy::new(what, start_angle, "within a turn of 0"));
        }
        if !agree(&segment.shape, &expected) {
            wrong.extend(fields(&format!("tool_path[{i}]"), &segment.shape, &expected));
        }
    }
    wrong
}

/// The shape that a segment should have.
fn shape(plan: &Plan, segment: &Segment, start_angle_rad: f64) -> Option<Shape> {
    let plate = plan.plates.get(segment.plate)?;
    let wash = &plan.scenario.wash;
    let stroke = Stroke {
        radius_m: wash.path_radius_m,
        turns: wash.turns,
        start_angle_rad,
        closing_ring: wash.closing_ring,
    };
    let height = plate.z_m + wash.height_m;
    let line = |theta: f64| {
        let end = stroke.at(theta).position;
        Shape::Line {
            foot_m: [plate.x_m + end.x, plate.y_m + end.y, height],
            normal: [0.0, 0.0, 1.0],
            height_m: wash.lift_m,
        }
    };
    Some(match segment.kind {
        SegmentKind::Depart | SegmentKind::Transition | SegmentKind::Return => Shape::Free,
        SegmentKind::Approach => line(0.0),
        SegmentKind::Retreat => line(stroke.end()),
        SegmentKind::Wash => Shape::Stroke {
            centre_m: [plate.x_m, plate.y_m, height],
            normal: [0.0, 0.0, 1.0],
            stroke,
        },
    })
}

/// Whether two shapes are the same but for the rounding of places.
fn agree(stated: &Shape, expected: &Shape) -> bool {
    let near = |a: &[f64; 3], b: &[f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() <= PLACE_M);
    match (stated, expected) {
        (
            Shape::Line {
                foot_m,
                normal,
                height_m,
            },
            Shape::Line {
                foot_m: foot,
                normal: up,
                height_m: height,
            },
        ) => near(foot_m, foot) && normal == up && height_m == height,
        (
            Shape::Stroke {
                centre_m,
                normal,
                stroke,
            },
            Shape::Stroke {
                centre_m: centre,
                normal: up,
                stroke: asked,
            },
        ) => near(centre_m, centre) && normal == up && stroke == asked,
        _ => stated == expected,
    }
}

/// The fields of two values that differ, by their names in the file.
pub(super) fn fields(prefix: &str, stated: &impl Serialize, expected: &impl Serialize) -> Vec<Discrepancy> {
    let value = |v: Result<Value, serde_json::Error>| v.unwrap_or(Value::Null);
    let (stated, expected) = (
        value(serde_json::to_value(stated)),
        value(serde_json::to_value(expected)),
    );
    let (Value::Object(stated), Value::Object(expected)) = (&stated, &expected) else {
        return Vec::new();
    };
    let keys: std::collections::BTreeSet<_> = stated.keys().chain(expected.keys()).collect();
    let say = |v: Option<&Value>| v.map_or("nothing".to_owned(), |v| shortened(&v.to_string()));
    keys.into_iter()
        .map(|key| (key, stated.get(key), expected.get(key)))
        .filter(|(_, stated, expected)| stated != expected)
        .map(|(key, stated, expected)| Discrepancy::new(format!("{prefix}.{key}"), say(stated), say(expected)))
        .collect()
}

/// The beginning of a long text.
fn shortened(text: &str) -> String {
    const MOST: usize = 80;
    match text.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}

/// Text from a file, with control characters written out.
fn quoted(text: &str) -> String {
    format!("{text:?}")
}
