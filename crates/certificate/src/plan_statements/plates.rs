//! Checks of the plan's statements about its arm, its tool, its plates and their order.
//!
//! Requirements 1–3, 8 and 11 of `docs/certificate.md`.
//!
//! Plates keep apart from each other and from the base, obstacles from both.

use crate::judged_job::JudgedJob;
use crate::report::check::{Check, Discrepancy};
use crate::report::requirement::Requirement;
use crate::washing::face::PLACE_M;
use crate::washing::reach;
use nalgebra::Vector3;
use platewash_bodies::clearance::{ClearanceError, FixedBody};
use platewash_bodies::job::PlateOverlap;
use platewash_bodies::job::overlaps_of_fixed_bodies;
use platewash_bodies::job::overlaps_of_plates;
use platewash_kinematics::Pose;
use platewash_motion::plan::Plan;
use platewash_workcell::job::Overlap;
use platewash_workcell::words::{millimetres, plate_name, printable};
use platewash_workcell::{ArmId, ObstacleShape};

/// Checks that the plan is for this arm.
pub(crate) fn arm(judged: &JudgedJob<'_>) -> Check {
    let (stated, given) = (&judged.job.workcell.arm, ArmId::new(judged.robot));
    let srdf = |id: &ArmId| id.srdf_sha256.as_ref().map_or("none".to_owned(), |hash| quoted(hash));
    let fixed = |id: &ArmId| match id.fixed.is_empty() {
        true => "none".to_owned(),
        false => id.fixed_words(),
    };
    let fields = [
        ("name", quoted(&stated.name), quoted(&given.name)),
        ("urdf_sha256", quoted(&stated.urdf_sha256), quoted(&given.urdf_sha256)),
        ("srdf_sha256", srdf(stated), srdf(&given)),
        ("fixed", fixed(stated), fixed(&given)),
    ];
    let wrong = fields.into_iter().filter(|(_, stated, given)| stated != given);
    let wrong =
        wrong.map(|(field, stated, given)| Discrepancy::new(format!("job.workcell.arm.{field}"), stated, given));
    Check::stated(Requirement::Arm, wrong.collect())
}

/// Checks that the tip is the middle of the sponge's far face, with z out of the tool there, so that bounds of the tip hold for the sponge.
/// No body may reach into the sponge, which is all foam. Without bodies there is no tool that could touch anything, and the tip is the
/// arm's own.
pub(crate) fn tool(judged: &JudgedJob<'_>) -> Check {
    let tool = &judged.job.workcell.tool;
    let face = tool.sponge.pose * Pose::translation(0.0, 0.0, tool.sponge.height_m / 2.0);
    let mut wrong = tip_discrepancies(&face, &tool.tip, "the middle of the sponge's far face");
    if !tool.is_present() {
        wrong.extend(tip_discrepancies(
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

/// Returns a discrepancy where the tip is not in the expected position or direction. NaN counts as wrong.
fn tip_discrepancies(expected: &Pose, tip: &Pose, words: &str) -> Vec<Discrepancy> {
    let off_m = (tip.translation.vector - expected.translation.vector).norm();
    let turned = (tip.rotation * Vector3::z() - expected.rotation * Vector3::z()).norm();
    if off_m <= PLACE_M && turned <= PLACE_M {
        return Vec::new();
    }
    let found = format!("{} from it, its axis turned by {turned:.3} rad", millimetres(off_m));
    vec![Discrepancy::new("tip of the tool", found, words)]
}

/// Checks that no plate reaches below the floor, or into another half-space.
pub(crate) fn plates(judged: &JudgedJob<'_>) -> Check {
    let mut wrong = Vec::new();
    for obstacle in &judged.job.workcell.obstacles {
        if obstacle.shape != ObstacleShape::HalfSpace {
            continue;
        }
        let up = obstacle.pose.rotation * Vector3::z();
        let level_m = obstacle.pose.translation.vector.dot(&up);
        for (i, plate) in judged.plates().iter().enumerate() {
            let underside_m = -plate.reach_along_m(&-up) - level_m;
            if underside_m < -PLACE_M {
                let what = format!(
                    "height of the underside of {} over the {}",
                    plate_name(i),
                    printable(&obstacle.name)
                );
                wrong.push(Discrepancy::new(what, millimetres(underside_m), "none below 0"));
            }
        }
    }
    Check::stated(Requirement::Plates, wrong)
}

/// Checks that every plate is in the order once, and that no more than its rim is swept while another one is washed. Overlapping plates are
/// judged in [`crate::plan_statements::plates`]: where the overlap is only reported, so is the double sweeping.
pub(crate) fn every_plate_once(judged: &JudgedJob<'_>, plan: &Plan, upright_cosine: impl Fn(usize) -> f64) -> Check {
    let mut wrong = washed_once(plan);
    let swept = reach::swept(judged, upright_cosine);
    wrong.extend(swept.apart);
    if wrong.is_empty() && judged.job.requirements.overlap == Overlap::Report {
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
        let listed = plan.job.plates_to_wash().nth(i);
        if let Some(listed) = listed.filter(|listed| plan.job.requirements.as_listed && plate != *listed) {
            let asked = format!("{listed}, as plates are washed as they are listed");
            wrong.push(Discrepancy::new(format!("order[{i}]"), plate, asked));
        }
    }
    let asked = |plate| usize::from(plan.job.washes(plate));
    let times = washed
        .iter()
        .enumerate()
        .filter(|(plate, times)| **times != asked(*plate));
    wrong.extend(times.map(|(plate, times)| {
        let what = format!("order: times that {} is washed", plate_name(plate));
        Discrepancy::new(what, times, asked(plate))
    }));
    wrong
}

/// Text from a file, with control characters written out.
fn quoted(text: &str) -> String {
    format!("{text:?}")
}

/// Checks that no two plates overlap, that no level plate lies over the base's footprint, and that no other plate reaches into the base.
/// The check is waived where the job asks for a report only. No obstacle may reach into a plate that it does not hold, or into the base;
/// [`plates`] covers floors.
///
/// # Errors
/// [`ClearanceError`] for a shape that is none.
pub(crate) fn plates_apart(judged: &JudgedJob<'_>) -> Result<Check, ClearanceError> {
    let overlaps = overlaps_of_plates(judged.job, judged.robot);
    let mut wrong: Vec<_> = overlaps.iter().map(discrepancy).collect();
    let obstacles = &judged.job.workcell.obstacles;
    let is_floor = |name: &str| {
        obstacles
            .iter()
            .any(|o| o.name == name && o.shape == ObstacleShape::HalfSpace)
    };
    let is_plate = |name: &String| (0..judged.plates().len()).any(|plate| *name == plate_name(plate));
    let mut reaching = overlaps_of_fixed_bodies(judged.job, judged.robot)?;
    reaching.retain(|found| match &found.body {
        FixedBody::Obstacle(name) => !(is_floor(name) && is_plate(&found.other)),
        FixedBody::Parts(_) | FixedBody::Plate(_) => true,
    });
    let reaches = !reaching.is_empty();
    wrong.extend(reaching.into_iter().map(|found| {
        let what = format!("how far {} reaches into {:?}", found.body, found.other);
        Discrepancy::new(
            what,
            millimetres(found.by_m),
            "no overlap, except with plates that it holds",
        )
    }));
    // Overlapping plates may be waived; an obstacle in a plate may not.
    let waives = judged.job.requirements.overlap == Overlap::Report && !reaches;
    Ok(Check::stated(Requirement::PlatesApart, wrong).waived_if(waives))
}

fn discrepancy(overlap: &PlateOverlap) -> Discrepancy {
    let other = overlap.other.map_or_else(|| "the base".to_owned(), plate_name);
    let what = format!("gap between {} and {other}", plate_name(overlap.plate));
    Discrepancy::new(what, millimetres(-overlap.by_m), "none below 0")
}
