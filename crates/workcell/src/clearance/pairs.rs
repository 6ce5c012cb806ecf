//! Which pairs of bodies are checked, and why the others are not.

use super::body::{Body, BodyKind, part_pairs, place, world};
use super::distance::separation;
use super::error::ClearanceError;
use crate::tool::Tool;
use crate::workcell::{Exclusion, ExclusionReason, Obstacle};
use platewash_kinematics::{JointVector, RobotModel};

/// Configurations sampled to find pairs that always touch.
const SAMPLES: usize = 64;

/// Bodies of the arm from here on carry the tool: it is not checked against them.
const WRIST: usize = 5;

/// All pairs (indices of bodies) that can meet, but for those excluded.
pub(super) fn choose(bodies: &[Body], exclusions: &[Exclusion]) -> Vec<(usize, usize)> {
    let name = |i: usize| &bodies[i].name;
    let is_excluded = |&(a, b): &(usize, usize)| {
        let pair = [name(a), name(b)];
        let names = |e: &Exclusion| {
            let [x, y] = &e.pair;
            pair == [x, y] || pair == [y, x]
        };
        exclusions.iter().any(names)
    };
    candidates(bodies).filter(|pair| !is_excluded(pair)).collect()
}

/// The pairs that need not keep clear, with the reason: those that follow from an arm, its SRDF, its tool and what stands around it.
///
/// With an SRDF the pairs of links that it disables; without one, neighbours and pairs that touch in every configuration sampled.
/// The tool and the wrist that carries it; the base, which moves as little as the obstacles; what joint 1 turns about the vertical,
/// over the floor.
///
/// # Errors
/// [`ClearanceError`] for a shape that is none.
pub fn exclusions(robot: &RobotModel, tool: &Tool, obstacles: &[Obstacle]) -> Result<Vec<Exclusion>, ClearanceError> {
    let bodies = world(robot, tool, obstacles)?;
    let pairs: Vec<_> = candidates(&bodies).collect();
    let mut reasons: Vec<_> = pairs
        .iter()
        .map(|&(a, b)| reason(robot, &bodies[a], &bodies[b]))
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

/// The pairs of bodies that can move relative to each other.
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

/// Why a pair need not keep clear, as far as the bodies alone tell.
fn reason(robot: &RobotModel, first: &Body, second: &Body) -> Option<ExclusionReason> {
    use BodyKind::{Floor, Link, Obstacle, Sponge, Tool};
    match (first.kind, second.kind) {
        (Link(i), Link(j)) => match robot.disabled_pairs() {
            Some(disabled) => disabled
                .contains(&first.name, &second.name)
                .then_some(ExclusionReason::Srdf),
            None => (i.abs_diff(j) <= 1).then_some(ExclusionReason::Neighbours),
        },
        (Link(i), Tool | Sponge) | (Tool | Sponge, Link(i)) => (i >= WRIST).then_some(ExclusionReason::CarriesTool),
        (Link(0), Floor | Obstacle) => Some(ExclusionReason::NeitherMoves),
        (Link(1), Floor) => axis_1_is_vertical(robot).then_some(ExclusionReason::KeepsItsHeight),
        _ => None,
    }
}

/// Whether what joint 1 moves keeps its height over the floor.
fn axis_1_is_vertical(robot: &RobotModel) -> bool {
    let [axis_1, ..] = robot.fk(&JointVector::zeros()).joint_axes();
    axis_1.z.abs() > 1.0 - 1e-12
}

/// Of some pairs, by their index, those that touch in every configuration sampled: neighbouring links of a description without a list
/// often do by design.
fn always_touching(robot: &RobotModel, bodies: &[Body], pairs: &[(usize, usize)], mut open: Vec<usize>) -> Vec<usize> {
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

/// Evenly spread configurations within the limits: an additive sequence on the generalised golden ratio
/// (Roberts 2018), the first one the middle of the limits.
fn spread(robot: &RobotModel, k: usize) -> JointVector {
    // The positive root of x⁷ = x + 1.
    const PHI: f64 = 1.112_775_684_278_705_5;
    JointVector::from_fn(|joint, _| {
        let [lower, upper] = robot.limits().sampling_range(joint);
        let step = (0..=joint).fold(1.0, |step, _| step / PHI);
        lower + (upper - lower) * (0.5 + k as f64 * step).fract()
    })
}
