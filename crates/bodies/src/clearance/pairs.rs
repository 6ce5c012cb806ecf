//! Choice of the pairs of bodies that are checked, with the reasons for excluding others.
//!
//! Pairs of links that need no check are found if there is no list of them, and can be written as an SRDF.
//!
//! Pairs whose distance no joint changes are left out here, and judged once: see [`crate::clearance::still`].

use crate::clearance::body::{Body, BodyKind, is_of_arm, part_pairs, place, world};
use crate::clearance::distance::separation;
use crate::clearance::error::ClearanceError;
use crate::clearance::still::{CARRIER, Still, height_change_m, turn_m};
use platewash_kinematics::{JointVector, RobotModel};
use platewash_workcell::tool::Tool;
use platewash_workcell::{Exclusion, ExclusionReason, Obstacle, ReducedClearance, is_pair};
use serde::Serialize;
use std::fmt::Write;

/// Number of configurations sampled to find pairs that always touch.
const SAMPLES: usize = 64;

/// Returns all pairs (indices of bodies) that can meet, without the excluded ones.
pub(crate) fn choose(bodies: &[Body], exclusions: &[Exclusion]) -> Vec<(usize, usize)> {
    let name = |i: usize| bodies[i].name.as_str();
    let is_excluded = |&(a, b): &(usize, usize)| exclusions.iter().any(|e| is_pair(&e.pair, (name(a), name(b))));
    candidates(bodies).filter(|pair| !is_excluded(pair)).collect()
}

/// Pairs, by the indices of their bodies, each with the part of the required clearance that it need not keep \[m\].
pub(crate) type ReducedPairs = Vec<((usize, usize), f64)>;

/// Returns the pairs that need not keep all of the required clearance.
///
/// # Errors
/// [`ClearanceError::NotReducible`]: a name of no body, or of a body that is not of the arm or its tool; a pair that is not checked, or is
/// stated twice.
pub(crate) fn reduced(
    bodies: &[Body],
    pairs: &[(usize, usize)],
    once: &[Still],
    stated: &[ReducedClearance],
) -> Result<ReducedPairs, ClearanceError> {
    let mut found = ReducedPairs::new();
    let judged = || pairs.iter().copied().chain(once.iter().map(|still| still.pair));
    for ReducedClearance { pair, by_m, at_stop } in stated {
        let refused = |fault| {
            let pair = pair.clone();
            Err(ClearanceError::NotReducible { pair, fault })
        };
        if !at_stop && !pair.iter().all(|name| is_of_arm(bodies, name)) {
            return refused("one of them is not a body of the arm or its tool with a collision shape");
        }
        let is_named = |&(a, b): &(usize, usize)| is_pair(pair, (&bodies[a].name, &bodies[b].name));
        match judged().find(is_named) {
            None => return refused("the pair is not checked"),
            Some(pair) if found.iter().any(|(other, _)| *other == pair) => return refused("it is stated twice"),
            Some(pair) => found.push((pair, *by_m)),
        }
    }
    Ok(found)
}

/// Returns the pairs that no configuration need be checked for, with the reason: those that follow from an arm, its SRDF, its tool and its
/// obstacles.
///
/// With an SRDF these are the pairs of links that it disables; without one, neighbours and pairs that touch in every sampled configuration.
/// Further pairs: the tool and the flange; bodies of the tool that are round about axis 6 and the link that carries joint 6, as they turn
/// on the spot there; the base and the obstacles, which both stand still; a half-space and the body that joint 1 turns about its normal. The
/// distances that do not change are judged once: [`ClearanceModel::still_pairs`], and [`standing_overlaps`] for what stands.
///
/// [`ClearanceModel::still_pairs`]: crate::clearance::ClearanceModel::still_pairs
/// [`standing_overlaps`]: crate::clearance::standing_overlaps
///
/// # Errors
/// [`ClearanceError`] for an invalid shape.
pub fn exclusions(robot: &RobotModel, tool: &Tool, obstacles: &[Obstacle]) -> Result<Vec<Exclusion>, ClearanceError> {
    let bodies = world(robot, tool, obstacles)?;
    let pairs: Vec<_> = candidates(&bodies).collect();
    let moves = |body: &Body| turn_m(body).is_none();
    let mut reasons: Vec<_> = pairs
        .iter()
        .map(|&(a, b)| reason(robot, &bodies[a], &bodies[b], moves))
        .collect();
    if robot.disabled_pairs().is_none() {
        let links = |(a, b): (usize, usize)| [a, b].map(|i| matches!(bodies[i].kind, BodyKind::Link(_)));
        let open = |k: &usize| reasons[*k].is_none() && links(pairs[*k]) == [true; 2];
        let open: Vec<usize> = (0..pairs.len()).filter(open).collect();
        for k in always_touching(robot, &bodies, &pairs, open) {
            reasons[k] = Some(ExclusionReason::AlwaysTouching);
        }
    }
    let named = pairs.iter().zip(reasons).filter_map(|(&(a, b), reason)| {
        let pair = [a, b].map(|i| bodies[i].name.clone());
        reason.map(|reason| Exclusion { pair, reason })
    });
    Ok(named.collect())
}

/// Returns the pairs of bodies that can move relative to each other.
fn candidates(bodies: &[Body]) -> impl Iterator<Item = (usize, usize)> {
    let count = bodies.len();
    let all = (0..count).flat_map(move |a| (a + 1..count).map(move |b| (a, b)));
    all.filter(|&(a, b)| can_meet(&bodies[a], &bodies[b]))
}

fn can_meet(a: &Body, b: &Body) -> bool {
    use BodyKind::{Floor, Link, Obstacle, Plate, Sponge, Tool};
    match (a.kind, b.kind) {
        (Link(i), Link(j)) => i != j,
        (Link(0), Plate(_)) | (Plate(_), Link(0)) => false,
        (Link(_), _) | (_, Link(_)) => true,
        (Tool | Sponge, Floor | Obstacle | Plate(_)) | (Floor | Obstacle | Plate(_), Tool | Sponge) => true,
        _ => false,
    }
}

/// Returns the reason that a pair need not keep clear, as far as the bodies alone decide it. `moves` tells if a body of the tool moves
/// relative to the one that carries joint 6.
fn reason(robot: &RobotModel, first: &Body, second: &Body, moves: impl Fn(&Body) -> bool) -> Option<ExclusionReason> {
    use BodyKind::{Floor, Link, Obstacle, Sponge, Tool};
    match (first.kind, second.kind) {
        (Link(_), Link(_)) => match robot.disabled_pairs() {
            Some(disabled) => disabled
                .contains(&first.name, &second.name)
                .then_some(ExclusionReason::Srdf),
            None => robot
                .share_a_joint(&first.name, &second.name)
                .then_some(ExclusionReason::Neighbours),
        },
        (Link(i), Tool | Sponge) => carrying_reason(i, second, moves),
        (Tool | Sponge, Link(i)) => carrying_reason(i, first, moves),
        (Link(0), Floor | Obstacle) => Some(ExclusionReason::NeitherMoves),
        (Link(1), Floor) => height_change_m(robot, first, second).map(|_| ExclusionReason::KeepsItsHeight),
        _ => None,
    }
}

/// Returns the reason if a link carries a body of the tool, which does not move relative to it.
fn carrying_reason(link: usize, held: &Body, moves: impl Fn(&Body) -> bool) -> Option<ExclusionReason> {
    let still = link > CARRIER || (link == CARRIER && !moves(held));
    still.then_some(ExclusionReason::CarriesTool)
}

/// Returns those of some pairs, by index, that touch in every sampled configuration. Neighbouring links of a description without a list
/// often do by design.
pub(crate) fn always_touching(
    robot: &RobotModel,
    bodies: &[Body],
    pairs: &[(usize, usize)],
    mut open: Vec<usize>,
) -> Vec<usize> {
    for k in 0..SAMPLES {
        let placed = place(bodies, &robot.fk(&spread(robot, k)));
        open.retain(|&pair| {
            let (a, b) = pairs[pair];
            let touch = |(p, r): (usize, usize)| separation(&placed[a][p], &placed[b][r]).distance <= 0.0;
            part_pairs(&bodies[a], &bodies[b]).any(touch)
        });
    }
    open
}

/// Returns evenly spread configurations within the limits: an additive sequence on the generalised golden ratio (Roberts 2018), the first
/// one the middle of the limits.
fn spread(robot: &RobotModel, k: usize) -> JointVector {
    // The positive root of x⁷ = x + 1.
    const PHI: f64 = 1.112_775_684_278_705_5;
    JointVector::from_fn(|joint, _| {
        let [lower, upper] = robot.limits().sampling_range(joint);
        let step = (0..=joint).fold(1.0, |step, _| step / PHI);
        lower + (upper - lower) * (0.5 + k as f64 * step).fract()
    })
}

/// Pairs of links that need no check, for an arm without an SRDF.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct TouchingPairs {
    /// Pairs whose links share a joint.
    pub neighbours: Vec<[String; 2]>,
    /// Other pairs, which touch in every sampled configuration.
    pub always_touching: Vec<[String; 2]>,
    /// Number of configurations sampled.
    pub samples: usize,
    robot: String,
}

impl TouchingPairs {
    /// Finds the pairs of an arm, independently of its SRDF.
    ///
    /// # Errors
    /// [`ClearanceError`] for an invalid shape.
    pub fn find(robot: &RobotModel) -> Result<Self, ClearanceError> {
        let found = exclusions(&robot.clone().without_disabled_pairs(), &Tool::none(robot), &[])?;
        let of = |reason: ExclusionReason| {
            let found = found.iter().filter(move |e: &&Exclusion| e.reason == reason);
            found.map(|e| e.pair.clone()).collect()
        };
        Ok(Self {
            neighbours: of(ExclusionReason::Neighbours),
            always_touching: of(ExclusionReason::AlwaysTouching),
            samples: SAMPLES,
            robot: robot.name().to_owned(),
        })
    }

    /// Returns the list as an SRDF, with the reason of each pair in a comment.
    #[must_use]
    pub fn srdf(&self) -> String {
        let name = escaped(&self.robot);
        let mut text = format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<robot name=\"{name}\">\n");
        let always = format!(
            "touch in each of {} configurations spread over the limits of the joints: look whether the real links may",
            self.samples
        );
        for (pairs, why, reason) in [
            (&self.neighbours, "adjacent: the links share a joint", "Adjacent"),
            (&self.always_touching, &*always, "Default"),
        ] {
            if !pairs.is_empty() {
                // Writing to a String cannot fail.
                let _ = writeln!(text, "  <!-- {why} -->");
            }
            for [a, b] in pairs {
                let [a, b] = [a, b].map(|link| escaped(link));
                let _ = writeln!(
                    text,
                    "  <disable_collisions link1=\"{a}\" link2=\"{b}\" reason=\"{reason}\"/>"
                );
            }
        }
        text + "</robot>\n"
    }
}

/// Escapes text for an attribute of XML.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    use platewash_kinematics::DisabledPairs;

    #[test]
    fn names_are_written_as_xml_has_them() {
        let pairs = TouchingPairs {
            neighbours: vec![["a<b".to_owned(), "c\"&d".to_owned()]],
            always_touching: Vec::new(),
            samples: 64,
            robot: "r&d".to_owned(),
        };
        let read = DisabledPairs::parse(&pairs.srdf()).unwrap();
        assert!(read.contains("a<b", "c\"&d"));
    }
}
