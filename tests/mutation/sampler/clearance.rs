//! Distances of all pairs at single configurations.

use crate::mutation::sampler::LINE_M;
use crate::mutation::sampler::findings::Findings;
use crate::mutation::sampler::motion::{Piece, pieces, within};
use crate::mutation::sampler::paths::{is_at_plate, path_of, segment_of};
use platewash::certificate::Requirement;
use platewash::workcell::words::plate_name;
use platewash::workcell::{Exclusion, ExclusionReason, ObstacleShape};
use platewash::{ClearanceModel, JointVector, Plan, RobotModel, Workcell};
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
        let model = ClearanceModel::new(robot, &world(origin, origin, robot), &origin.job.plates).unwrap();
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
        let (job, was) = (&plan.job, &self.origin.job);
        let world = world(plan, self.origin, self.robot);
        let model = ClearanceModel::new(self.robot, &world, &job.plates).unwrap();
        let same_bodies = job.workcell.tool == was.workcell.tool
            && job.workcell.obstacles == was.workcell.obstacles
            && job.plates == was.plates;
        let pairs: Vec<_> = model.pair_names().iter().map(|pair| Pair::new(plan, *pair)).collect();
        let limit = job.requirements.clearance_m;
        let mut look = |q: &JointVector, segment: Option<usize>| {
            let known = self.known.get(&key(q)).filter(|_| same_bodies);
            let found = known.cloned().unwrap_or_else(|| all(&model, q));
            let may = |plate: usize| segment.is_none_or(|i| may_touch(plan, i, plate));
            let counts = found
                .iter()
                .zip(&pairs)
                .filter(|(_, pair)| !pair.sponge_on.is_some_and(may));
            let (waived, judged): (Vec<_>, Vec<_>) = counts.partition(|(_, pair)| pair.waived);
            let least = judged.iter().map(|(d, _)| **d).fold(f64::INFINITY, f64::min);
            findings.at_least(Requirement::Clearance, least, limit, DISTANCE_M);
            waived.iter().for_each(|(d, _)| findings.waived(**d));
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

/// What is known of a pair.
struct Pair {
    /// The plate of a pair of the sponge and a plate.
    sponge_on: Option<usize>,
    /// Whether the job leaves it out.
    waived: bool,
}

impl Pair {
    fn new(plan: &Plan, (a, b): (&str, &str)) -> Self {
        let plate = (0..plan.job.plates.len()).find(|plate| b == plate_name(*plate));
        let stated = plan.job.workcell.exclusions.iter();
        let mut stated = stated.map(|e| e.pair.each_ref().map(String::as_str));
        Self {
            sponge_on: plate.filter(|_| a == "sponge"),
            waived: stated.any(|pair| pair == [a, b] || pair == [b, a]),
        }
    }
}

/// The world of a plan with what need not keep clear, whatever the plan says: of links what its origin leaves out; the wrist and what
/// it carries; what stands still; link 1 over the floor.
fn world(plan: &Plan, origin: &Plan, robot: &RobotModel) -> Workcell {
    let now = &plan.job.workcell;
    let links: Vec<_> = robot.links().iter().map(|link| link.name.as_str()).collect();
    let is_link = |name: &String| links.contains(&name.as_str());
    let before = origin.job.workcell.exclusions.iter();
    let of_links = before.filter(|e| e.pair.iter().all(is_link)).cloned();
    let pair = |a: &str, b: &str| Exclusion {
        pair: [a, b].map(str::to_owned),
        reason: ExclusionReason::Srdf,
    };
    let carried = now.tool.bodies.iter().map(|body| body.name.as_str()).chain(["sponge"]);
    let carried = carried.flat_map(|body| ["link_5", "link_6"].map(|link| pair(link, body)));
    let still = now.obstacles.iter().map(|obstacle| pair("base_link", &obstacle.name));
    let floors = now.obstacles.iter().filter(|o| o.shape == ObstacleShape::HalfSpace);
    let floors = floors.map(|floor| pair("link_1", &floor.name));
    Workcell {
        exclusions: of_links.chain(carried).chain(still).chain(floors).collect(),
        ..now.clone()
    }
}

/// Whether the sponge may touch a plate during a segment: the one that it works on, or one that no part of it is farther from than
/// the clearance wherever on its own path it is.
fn may_touch(plan: &Plan, segment: usize, plate: usize) -> bool {
    let (segment, job) = (&plan.segments[segment], &plan.job);
    let Some(own) = job.plates.get(segment.plate).filter(|_| is_at_plate(segment.kind)) else {
        return false;
    };
    let Some(path) = path_of(plan, segment.plate) else {
        return segment.plate == plate;
    };
    let (other, sponge) = (&job.plates[plate], &job.workcell.tool.sponge);
    let sponge_m = sponge.radius_m.hypot(sponge.height_m);
    let reach_m = path.curve.radius_m + LINE_M + sponge_m + job.requirements.clearance_m;
    let ([x, y], [u, v]) = (own.centre_xy(), other.centre_xy());
    // Of a plate that is higher than the one worked on the sponge keeps clear.
    let is_higher = other.centre().z - own.centre().z > 1e-9;
    segment.plate == plate || !is_higher && (x - u).hypot(y - v) - other.rim_m() <= reach_m
}

fn key(q: &JointVector) -> [u64; 6] {
    std::array::from_fn(|i| q[i].to_bits())
}

fn all(model: &ClearanceModel, q: &JointVector) -> Vec<f64> {
    model.all(q).into_iter().map(|pair| pair.distance_m).collect()
}
