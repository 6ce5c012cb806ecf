//! Assumptions of a verdict: one sentence each.

use crate::points::{Interpolation, PointMotion};
use platewash_certificate::MotionRules;
use platewash_kinematics::RobotModel;
use platewash_workcell::{Exclusion, ExclusionReason, Workcell};
use std::collections::BTreeMap;

/// Sentences on what the verdict rests on.
pub(crate) fn assumptions(
    motion: &PointMotion,
    workcell: &Workcell,
    arm: &RobotModel,
    (rules, stop_s): (&MotionRules, f64),
    excluded: &[Exclusion],
) -> Vec<String> {
    let timed = motion.start.is_some();
    let mut all = vec![
        controller_words(motion.interpolation(), timed).to_owned(),
        "The motion begins at the first point; how the arm gets there is not judged.".to_owned(),
        format!(
            "The collision shapes of the description enclose the arm and what it carries; a mesh of a link counts as its convex hull{}.",
            match arm.split_links() {
                [] => String::new(),
                split => format!(
                    ", but for these, which count as convex parts that enclose it: {}",
                    split.join(", ")
                ),
            }
        ),
    ];
    if motion.simpler() > 0 {
        all.push(
            "Between two points of which one states no accelerations it moves along the cubic, and where one states no speeds along the \
             straight line in joint space, at constant speed."
                .to_owned(),
        );
    }
    if stop_s > 0.0 {
        all.push(
            "Behind the last point each joint brakes on its own, at its stated acceleration limit, until it rests."
                .to_owned(),
        );
    } else if rules.acceleration_rad_s2.is_some() && rules.rests_outside {
        all.push("The arm rests before the first point and after the last.".to_owned());
    }
    let fixed: BTreeMap<_, _> = arm.fixed_joints().iter().chain(&motion.fixed).collect();
    if !fixed.is_empty() {
        let words: Vec<_> = fixed.iter().map(|(name, at)| format!("{name} at {at}")).collect();
        all.push(format!("These joints do not move: {}.", words.join(", ")));
    }
    let names = |names: Vec<&str>| names.join(", ");
    if workcell.tool.is_present() {
        let bodies = workcell.tool.bodies.iter().map(|body| body.name.as_str());
        let bodies = names(bodies.chain(["sponge"]).collect());
        all.push(format!(
            "Behind its flange the arm carries these bodies of a tool: {bodies}."
        ));
    }
    all.push(match &workcell.obstacles[..] {
        [] => "Nothing stands around the arm, no floor either.".to_owned(),
        some => format!(
            "Nothing stands around the arm but these, which do not move: {}.",
            names(some.iter().map(|obstacle| obstacle.name.as_str()).collect())
        ),
    });
    all.extend(arm.controller_base().map(|base| {
        format!(
            "The arm's root link, '{}', stands at the mount; the controller counts from {base}.",
            base.root
        )
    }));
    if timed {
        let words = match rules.acceleration_rad_s2 {
            None => {
                "Speed limits are those of the description; no acceleration limits were stated, and accelerations are not judged."
            }
            Some(_) => "Speed limits are those of the description; acceleration limits are as they were stated.",
        };
        let described = arm.limits().acceleration.iter().flatten().next();
        all.push(match (described, rules.acceleration_rad_s2) {
            (None, _) => words.to_owned(),
            (Some(_), None) => {
                "Speed limits are those of the description, and so are acceleration limits where they are judged; other accelerations are not."
                    .to_owned()
            }
            (Some(_), Some(_)) => {
                "Speed limits are those of the description; acceleration limits are the lesser of those stated and the description's."
                    .to_owned()
            }
        });
    }
    all.extend(excluded_words(excluded));
    all
}

/// Motion that a controller is assumed to make.
fn controller_words(interpolation: Interpolation, timed: bool) -> &'static str {
    match (interpolation, timed) {
        (Interpolation::Linear, true) => {
            "The controller moves every joint at constant speed from each point to the next, a straight line in joint space, and follows it \
             exactly; the speed jumps at the points."
        }
        (Interpolation::Linear, false) => {
            "The arm moves from each point to the next along the straight line in joint space and follows it exactly, at any speed: the \
             points have no times, and speeds are not judged."
        }
        (Interpolation::Cubic, _) => {
            "The controller moves every joint along the cubic that has the positions and the speeds of two neighbouring points, and follows \
             it exactly."
        }
        (Interpolation::Quintic, _) => {
            "The controller moves every joint along the quintic that has the positions, speeds and accelerations of two neighbouring points, \
             and follows it exactly."
        }
    }
}

/// Counts the pairs that are not judged, by their reason.
fn excluded_words(excluded: &[Exclusion]) -> Option<String> {
    let count = |reason| excluded.iter().filter(|pair| pair.reason == reason).count();
    let told = |(reason, words): (ExclusionReason, &str)| match count(reason) {
        0 => None,
        count => Some(format!("{count} {words}")),
    };
    let reasons = [
        (ExclusionReason::Srdf, "by the SRDF"),
        (ExclusionReason::Neighbours, "as neighbours"),
        (
            ExclusionReason::AlwaysTouching,
            "as they touch in every configuration tried",
        ),
        (ExclusionReason::CarriesTool, "as one carries the other"),
        (
            ExclusionReason::NeitherMoves,
            "as neither body moves (none overlap; a floor at height 0 is not compared with the base)",
        ),
        (
            ExclusionReason::KeepsItsHeight,
            "as the link keeps its height over the floor",
        ),
    ];
    let reasons: Vec<_> = reasons.into_iter().filter_map(told).collect();
    (!reasons.is_empty()).then(|| format!("Pairs of bodies that are not judged: {}.", reasons.join(", ")))
}
