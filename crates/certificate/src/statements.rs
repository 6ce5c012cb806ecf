//! What the plan states about its arm, its tool, its plates and their order, compared with what must be so.

use crate::check::{Check, Discrepancy};
use crate::face::PLACE_M;
use crate::neighbours;
use crate::requirement::Requirement;
use crate::subject::Subject;
use nalgebra::Vector3;
use platewash_kinematics::Pose;
use platewash_workcell::job::Overlap;
use platewash_workcell::plan::Plan;
use platewash_workcell::words::{millimetres, printable};
use platewash_workcell::workcell::{ArmId, ObstacleShape};

/// The plan is for this arm.
pub(crate) fn arm(subject: &Subject<'_>) -> Check {
    let (stated, given) = (&subject.job.workcell.arm, ArmId::of(subject.robot));
    let srdf = |id: &ArmId| id.srdf_sha256.as_ref().map_or("none".to_owned(), |hash| quoted(hash));
    let fields = [
        ("name", quoted(&stated.name), quoted(&given.name)),
        ("urdf_sha256", quoted(&stated.urdf_sha256), quoted(&given.urdf_sha256)),
        ("srdf_sha256", srdf(stated), srdf(&given)),
    ];
    let wrong = fields.into_iter().filter(|(_, stated, given)| stated != given);
    let wrong =
        wrong.map(|(field, stated, given)| Discrepancy::new(format!("job.workcell.arm.{field}"), stated, given));
    Check::stated(Requirement::Arm, wrong.collect())
}

/// The tip is the middle of the sponge's far face, and z leaves the tool there: what is proved of the tip tells of the sponge. All of the
/// sponge is foam: no body reaches into it. Without
/// bodies there is no tool that could touch anything, and the tip is the arm's own.
pub(crate) fn tool(subject: &Subject<'_>) -> Check {
    let tool = &subject.job.workcell.tool;
    let face = tool.sponge.pose * Pose::translation(0.0, 0.0, tool.sponge.height_m / 2.0);
    let mut wrong = off(&face, &tool.tip, "the middle of the sponge's far face");
    if !tool.is_present() {
        wrong.extend(off(
            &Pose::identity(),
            &tool.tip,
            "the mounting frame, as the tool has no body",
        ));
    }
    wrong.extend(tool.in_sponge().map(|(body, by_m)| {
        let what = format!("end of the body {} of the tool", quoted(&body.name));
        let found = format!("{} within the sponge", millimetres(by_m));
        Discrepancy::new(what, found, "behind the sponge, all of which counts as foam")
    }));
    Check::stated(Requirement::Tool, wrong)
}

/// A tip that is not where it should be, or points elsewhere. NaN is nowhere.
fn off(expected: &Pose, tip: &Pose, words: &str) -> Vec<Discrepancy> {
    let off_m = (tip.translation.vector - expected.translation.vector).norm();
    let turned = (tip.rotation * Vector3::z() - expected.rotation * Vector3::z()).norm();
    if off_m <= PLACE_M && turned <= PLACE_M {
        return Vec::new();
    }
    let found = format!("{} from it, its axis turned by {turned:.3} rad", millimetres(off_m));
    vec![Discrepancy::new("tip of the tool", found, words)]
}

/// No plate reaches below the floor, or into another half-space.
pub(crate) fn plates(subject: &Subject<'_>) -> Check {
    let mut wrong = Vec::new();
    for obstacle in &subject.job.workcell.obstacles {
        if obstacle.shape != ObstacleShape::HalfSpace {
            continue;
        }
        let up = obstacle.pose.rotation * Vector3::z();
        let level_m = obstacle.pose.translation.vector.dot(&up);
        for (i, plate) in subject.plates().iter().enumerate() {
            let underside_m = -plate.reach_along_m(&-up) - level_m;
            if underside_m < -PLACE_M {
                let what = format!(
                    "height of the underside of plate {i} over the {}",
                    printable(&obstacle.name)
                );
                wrong.push(Discrepancy::new(what, millimetres(underside_m), "none below 0"));
            }
        }
    }
    Check::stated(Requirement::Plates, wrong)
}

/// Every plate is in the order once, and no more than its rim is swept while another one is washed. Plates that overlap are
/// [`crate::apart`]'s to judge: where that is only reported, so is what is swept twice.
pub(crate) fn every_plate_once(subject: &Subject<'_>, plan: &Plan, upright_cosine: impl Fn(usize) -> f64) -> Check {
    let mut wrong = washed_once(plan);
    let swept = neighbours::swept(subject, upright_cosine);
    wrong.extend(swept.apart);
    if wrong.is_empty() && subject.job.requirements.overlap == Overlap::Report {
        return Check::stated(Requirement::EveryPlateOnce, swept.overlapping).waived_if(true);
    }
    Check::stated(Requirement::EveryPlateOnce, wrong)
}

fn washed_once(plan: &Plan) -> Vec<Discrepancy> {
    let mut washed = vec![0_usize; plan.job.plates.len()];
    let mut wrong = Vec::new();
    for (i, &plate) in plan.order.iter().enumerate() {
        match washed.get_mut(plate) {
            Some(times) => *times += 1,
            None => wrong.push(Discrepancy::new(format!("order[{i}]"), plate, "the index of a plate")),
        }
        if plan.job.requirements.as_listed && plate != i {
            let asked = format!("{i}, as plates are washed as they are listed");
            wrong.push(Discrepancy::new(format!("order[{i}]"), plate, asked));
        }
    }
    let times = washed.iter().enumerate().filter(|(_, times)| **times != 1);
    wrong.extend(
        times.map(|(plate, times)| Discrepancy::new(format!("order: times that plate {plate} is washed"), times, 1)),
    );
    wrong
}

/// Text from a file, with control characters written out.
fn quoted(text: &str) -> String {
    format!("{text:?}")
}
