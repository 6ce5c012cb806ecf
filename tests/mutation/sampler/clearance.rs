//! Distances of all pairs at single configurations.

use super::LINE_M;
use super::findings::Findings;
use super::hermite::{Piece, pieces};
use super::moments::within;
use super::schedule::{is_at_plate, segment_of};
use platewash::planner::certificate::PromiseName;
use platewash::{ClearanceModel, JointVector, Plan, RobotModel};
use std::collections::HashMap;

/// What the distances of single configurations are right to \[m\].
const DISTANCE_M: f64 = 3e-5;

/// Pieces that are looked at between their knots, at most.
const MOST_FINE: usize = 300;

/// Distances along a plan, shared by all plans that come of it by edits.
pub struct Distances<'a> {
    robot: &'a RobotModel,
    origin: &'a Plan,
    pieces: Vec<Piece>,
    /// By the bits of the configuration.
    known: HashMap<[u64; 6], Vec<f64>>,
}

impl<'a> Distances<'a> {
    pub fn new(origin: &'a Plan, robot: &'a RobotModel) -> Self {
        let model = ClearanceModel::new(robot, &origin.scenario.tool, &origin.plates).unwrap();
        let every_second = origin.knots.q_rad.iter().step_by(2);
        Self {
            robot,
            origin,
            pieces: pieces(&origin.knots),
            known: every_second.map(|q| (key(q), all(&model, q))).collect(),
        }
    }

    /// At every second knot, at some times \[s\], and within pieces that the original plan does not have.
    pub fn look(&self, plan: &Plan, pieces: &[Piece], is_sound: bool, also_at: &[f64], findings: &mut Findings) {
        let model = ClearanceModel::new(self.robot, &plan.scenario.tool, &plan.plates).unwrap();
        let same_bodies = plan.scenario.tool == self.origin.scenario.tool && plan.plates == self.origin.plates;
        let names = model.pair_names();
        // The plate of each pair of the sponge and a plate.
        let touching: Vec<Option<usize>> = names
            .iter()
            .map(|(a, b)| b.strip_prefix("plate ").filter(|_| *a == "sponge")?.parse().ok())
            .collect();
        let limit = plan.scenario.wash.clearance_m;
        let mut look = |q: &JointVector, segment: Option<usize>| {
            let known = self.known.get(&key(q)).filter(|_| same_bodies);
            let found = known.cloned().unwrap_or_else(|| all(&model, q));
            let may = |plate: usize| segment.is_none_or(|i| may_touch(plan, i, plate));
            let counts = found.iter().zip(&touching).filter(|(_, plate)| !plate.is_some_and(may));
            let least = counts.map(|(d, _)| *d).fold(f64::INFINITY, f64::min);
            findings.at_least(PromiseName::Clearance, least, limit, DISTANCE_M);
        };
        let changed = self.changed(pieces);
        let fine = changed.iter().filter(|c| **c).count() < MOST_FINE;
        for (k, piece) in pieces.iter().enumerate() {
            let segment = is_sound.then(|| segment_of(plan, piece));
            let mut times = within(piece, also_at);
            times.extend((k % 2 == 0).then_some(0.0));
            if changed[k] && fine {
                times.extend([0.25, 0.5, 0.75, 1.0].map(|s| s * piece.length_s));
            }
            times.into_iter().for_each(|u| look(&piece.position(u), segment));
        }
    }

    /// Which pieces the original plan does not have, up to a shift by a few knots.
    fn changed(&self, pieces: &[Piece]) -> Vec<bool> {
        let known = |k: usize, piece: &Piece| {
            let near = k.saturating_sub(3)..(k + 4).min(self.pieces.len());
            near.into_iter().any(|i| self.pieces[i].moves_like(piece))
        };
        pieces.iter().enumerate().map(|(k, piece)| !known(k, piece)).collect()
    }
}

/// Whether the sponge may touch a plate during a segment: the one that it works on, or one that no part of it is farther from than
/// the clearance wherever on its own stroke it is.
fn may_touch(plan: &Plan, segment: usize, plate: usize) -> bool {
    let (segment, tool, wash) = (&plan.segments[segment], &plan.scenario.tool, &plan.scenario.wash);
    let Some(own) = plan.plates.get(segment.plate).filter(|_| is_at_plate(segment.kind)) else {
        return false;
    };
    let other = &plan.plates[plate];
    let sponge_m = tool.sponge_radius_m.hypot(tool.sponge_height_m);
    let reach_m = wash.path_radius_m + LINE_M + sponge_m + wash.clearance_m;
    segment.plate == plate || (own.x_m - other.x_m).hypot(own.y_m - other.y_m) - other.radius_m <= reach_m
}

fn key(q: &JointVector) -> [u64; 6] {
    std::array::from_fn(|i| q[i].to_bits())
}

fn all(model: &ClearanceModel, q: &JointVector) -> Vec<f64> {
    model.all(q).into_iter().map(|pair| pair.distance_m).collect()
}
