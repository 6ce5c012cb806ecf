//! Which pairs of bodies are checked.

use super::{BodyKind, ClearanceModel, separation};
use platewash_kinematics::{JointVector, RobotModel};

/// Configurations sampled to find pairs that always touch.
const SAMPLES: usize = 64;

/// Bodies of the arm from here on carry the tool: handle and sponge are not checked against them.
const WRIST: usize = 5;

/// All pairs (indices of bodies) that must keep clear of each other.
pub(super) fn choose(model: &ClearanceModel) -> Vec<(usize, usize)> {
    let count = model.bodies.len();
    let all = (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b)));
    let mut pairs: Vec<_> = all.filter(|&(a, b)| can_meet(model, a, b)).collect();
    if model.robot.disabled_pairs().is_none() {
        drop_always_touching(model, &mut pairs);
    }
    pairs
}

fn can_meet(model: &ClearanceModel, a: usize, b: usize) -> bool {
    use BodyKind::{Floor, Handle, Link, Plate, Sponge};
    let (first, second) = (&model.bodies[a], &model.bodies[b]);
    match (first.kind, second.kind) {
        (Link(i), Link(j)) => match model.robot.disabled_pairs() {
            Some(disabled) => i != j && !disabled.contains(&first.name, &second.name),
            None => i.abs_diff(j) > 1,
        },
        (Link(i), Handle | Sponge) | (Handle | Sponge, Link(i)) => i < WRIST,
        (Link(0), Floor | Plate(_)) => false,
        (Link(1), Floor) => !axis_1_is_vertical(&model.robot),
        (Link(_) | Handle | Sponge, Floor | Plate(_)) => true,
        _ => false,
    }
}

/// Whether what joint 1 moves keeps its height over the floor.
fn axis_1_is_vertical(robot: &RobotModel) -> bool {
    let [axis_1, ..] = robot.fk(&JointVector::zeros()).joint_axes();
    axis_1.z.abs() > 1.0 - 1e-12
}

/// Neighbouring links of a description without a list often touch by design.
fn drop_always_touching(model: &ClearanceModel, pairs: &mut Vec<(usize, usize)>) {
    let mut always = vec![true; pairs.len()];
    for k in 0..SAMPLES {
        let placed = model.place(&spread(&model.robot, k));
        for (&(a, b), always) in pairs.iter().zip(&mut always).filter(|(_, always)| **always) {
            let touch = |(p, r): (usize, usize)| separation(&placed[a][p], &placed[b][r]).distance <= 0.0;
            *always = model.part_pairs(a, b).any(touch);
        }
    }
    let mut always = always.into_iter();
    let is_link = |i: usize| matches!(model.bodies[i].kind, BodyKind::Link(_));
    pairs.retain(|&(a, b)| !(always.next().unwrap_or(false) && is_link(a) && is_link(b)));
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
